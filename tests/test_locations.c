// Where the points and face-vertices of results are: the exact surface has the same point and
// normal there. And tangents for normal maps: beside B-splines in doubles and the derivatives.
//
//     cc -I. tests/test_locations.c -o build/test_locations -lm && build/test_locations
#include <stdio.h>
#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/ready.h"
#include "lib/test.h"

enum { CAGES = 250, RANDOM_SMOOTH = RANDOM_MANIFOLD & ~RANDOM_CORNERS & ~RANDOM_BILINEAR };

static char context[64];

// The surface has the point there; whether it has the normal.
static int check_place(const ready *e, subdiv_location at, const float *expected,
                       const float *normal, double extent)
{
    float point[3], n[3];
    subdiv_derivatives out = {0};
    out.points = point;
    out.normals = n;
    CHECK_EQUAL(subdiv_evaluate_at(e->surface, 3, e->scratch, 1, &at, &out, NULL), SUBDIV_OK);
    for (int k = 0; k < 3; k++) CHECK_NEAR(point[k], expected[k], 2e-5 * extent);
    double dot = 0, length = 0;
    for (int k = 0; k < 3; k++) {
        dot += (double)(normal[k] * n[k]);
        length += (double)(normal[k] * normal[k]);
    }
    return length < 0.5 || dot > 0.999;
}

// smooth: no corner is a spike, so that normals are the same, too.
static void check_locations(const subdiv_mesh *cage, int levels, int smooth,
                            const subdiv_options *opt)
{
    subdiv_surface *surface = NULL;
    subdiv_mesh fine;
    ready e = get_ready(cage, opt);
    double extent = mesh_extent(cage) + 1e-3 * mesh_reach(cage);
    int bad = 0, all = 0;
    CHECK_EQUAL(subdiv_prepare(&surface, cage, levels, opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_surface_mesh(&fine, surface, cage->positions, opt), SUBDIV_OK);
    size_t points = (size_t)fine.vertex_count, corners = (size_t)face_vertex_count(&fine);
    subdiv_location *p = (subdiv_location *)malloc((points + 1) * sizeof *p);
    subdiv_location *h = (subdiv_location *)malloc((corners + 1) * sizeof *h);
    h[corners].face = -77;
    CHECK_EQUAL(subdiv_surface_locations(surface, p, h, NULL), SUBDIV_OK);
    CHECK_EQUAL(h[corners].face, -77);
    unsigned char *used = (unsigned char *)calloc(points, 1);
    for (size_t i = 0, f = 0, left = 0; i < corners && !test_bad; i++, left--) {
        if (left == 0) left = (size_t)face_size(&fine, (int)f++);
        int v = fine.face_vertices[i], n = fine.face_normals ? fine.face_normals[i] : v;
        used[v] = 1;
        if (cage->scheme != SUBDIV_LOOP) CHECK_EQUAL(h[i].face, fine.cage_faces[f - 1]);
        bad += !check_place(&e, h[i], fine.positions + 3 * v, fine.normals + 3 * n, extent);
        all++;
    }
    for (size_t i = 0; i < points && !test_bad; i++) {
        CHECK(p[i].face >= 0 || !used[i]);
        if (p[i].face < 0) continue;
        if (levels == 0 && !used[i]) continue;
        bad += !check_place(&e, p[i], fine.positions + 3 * i, fine.normals + 3 * i, extent);
        all++;
    }
    if (smooth && bad) TEST_REPORT("%d normals of %d differ", bad, all);
    free(used);
    free(p);
    free(h);
    put_away(&e);
    subdiv_mesh_free(&fine);
    subdiv_surface_free(surface);
}

static void test_random_cages(void)
{
    for (unsigned seed = 1; seed <= CAGES; seed++) {
        int smooth = seed % 3 == 0, all = RANDOM_ALL & ~RANDOM_DEGENERATE;
        random_cage *c = random_cage_new(seed, smooth ? RANDOM_SMOOTH : all);
        subdiv_options opt = {0};
        snprintf(context, sizeof context, "seed %u", seed);
        test_context = context;
        opt.limit = opt.triangulate = 1;
        int levels = (int)(seed % 4), none = c->mesh.boundary == SUBDIV_BOUNDARY_NONE;
        opt.keep_holes = seed % 2 && !none;
        if (levels == 0 && none) levels = 1;              // has faces without a surface
        check_locations(&c->mesh, levels, smooth, &opt);
        random_cage_free(c);
    }
}

// ------------------------------------------------------------------------------------ tangents

// The tangent that derivatives of a point and of its UVs make, in doubles: the sum of a du and b dv
// along which the first UV grows by 1 and the second by 0. Returns w, or 0 if there is none.
static double expect_tangent(const double *du, const double *dv, const double *uv_du,
                             const double *uv_dv, const double *normal, double *t)
{
    double det = uv_du[0] * uv_dv[1] - uv_dv[0] * uv_du[1];
    double a = uv_dv[1] / det, b = -uv_du[1] / det, along = 0, length = 0, w = 0, other[3];
    for (int k = 0; k < 3; k++) {
        t[k] = a * du[k] + b * dv[k];
        along += t[k] * normal[k];
        other[k] = (uv_du[0] * dv[k] - uv_dv[0] * du[k]) / det;
    }
    for (int k = 0; k < 3; k++) t[k] -= along * normal[k];
    for (int k = 0; k < 3; k++) length += t[k] * t[k];
    for (int k = 0; k < 3; k++) t[k] /= sqrt(length);
    for (int k = 0; k < 3; k++) {
        int l = (k + 1) % 3, m = (k + 2) % 3;
        w += (normal[l] * t[m] - normal[m] * t[l]) * other[k];
    }
    return w > 0 ? 1 : -1;
}

// A uniform cubic B-spline and its derivative, by de Boor's basis.
static void basis(double x, double *b, double *d)
{
    double y = 1 - x;
    b[0] = y * y * y / 6, b[1] = (3 * x * x * x - 6 * x * x + 4) / 6;
    b[2] = (3 * y * y * y - 6 * y * y + 4) / 6, b[3] = x * x * x / 6;
    d[0] = -y * y / 2, d[1] = (3 * x * x - 4 * x) / 2;
    d[2] = -(3 * y * y - 4 * y) / 2, d[3] = x * x / 2;
}

enum { ROWS = 5, COLUMNS = 6 };

// The derivatives of a spline over the torus, of so many channels of a vertex.
static void spline(const float *values, int width, int row, int column, double u, double v,
                   double *du, double *dv)
{
    double bu[4], bv[4], cu[4], cv[4];
    basis(u, bu, cu);
    basis(v, bv, cv);
    for (int c = 0; c < width; c++) {
        du[c] = dv[c] = 0;
        for (int i = 0; i < 16; i++) {
            int r = (row + i / 4 + ROWS - 1) % ROWS, k = (column + i % 4 + COLUMNS - 1) % COLUMNS;
            double value = (double)values[width * (r * COLUMNS + k) + c];
            du[c] += value * cu[i % 4] * bv[i / 4];
            dv[c] += value * bu[i % 4] * cv[i / 4];
        }
    }
}

// Each face of the torus is vertex (row, column), the next of the row, and the two above.
static void test_splines(void)
{
    static float p[3 * ROWS * COLUMNS], uvs[2 * ROWS * COLUMNS];
    static int faces[4 * ROWS * COLUMNS];
    subdiv_mesh torus = {0};
    unsigned state = 7;
    torus.vertex_count = torus.uv_count = torus.face_count = ROWS * COLUMNS;
    torus.face_size = 4;
    torus.positions = p;
    torus.uvs = uvs;
    torus.face_vertices = torus.face_uvs = faces;
    for (int i = 0; i < 3 * ROWS * COLUMNS; i++)
        p[i] = (float)((state = state * 1103515245u + 12345u) >> 16) / 65536;
    for (int i = 0; i < 2 * ROWS * COLUMNS; i++)
        uvs[i] = (float)((state = state * 1103515245u + 12345u) >> 16) / 65536;
    for (int f = 0; f < ROWS * COLUMNS; f++) {
        int r = f / COLUMNS, c = f % COLUMNS, above = (r + 1) % ROWS * COLUMNS;
        int next = (c + 1) % COLUMNS;
        faces[4 * f] = f, faces[4 * f + 1] = r * COLUMNS + next;
        faces[4 * f + 2] = above + next, faces[4 * f + 3] = above + c;
    }
    for (int left = 0; left < 2; left++) {
        torus.left_handed = left;
        ready e = get_ready(&torus, NULL);
        for (int i = 0; i < 9 * ROWS * COLUMNS; i++) {
            int f = i / 9;
            subdiv_location at = { f, 0, (float)(i % 3) / 2, (float)(i / 3 % 3) / 2 };
            float tangent[4];
            double du[3], dv[3], uv_du[2], uv_dv[2], n[3], t[3], length = 0;
            CHECK_EQUAL(subdiv_tangents_at(e.surface, e.scratch, 1, &at, tangent, 0, NULL),
                        SUBDIV_OK);
            spline(p, 3, f / COLUMNS, f % COLUMNS, (double)at.u, (double)at.v, du, dv);
            spline(uvs, 2, f / COLUMNS, f % COLUMNS, (double)at.u, (double)at.v, uv_du, uv_dv);
            for (int k = 0; k < 3; k++) {
                int l = (k + 1) % 3, m = (k + 2) % 3;
                n[k] = (du[l] * dv[m] - du[m] * dv[l]) * (left ? -1 : 1);
                length += n[k] * n[k];
            }
            for (int k = 0; k < 3; k++) n[k] /= sqrt(length);
            CHECK_NEAR(tangent[3], expect_tangent(du, dv, uv_du, uv_dv, n, t), 0);
            for (int k = 0; k < 3; k++) CHECK_NEAR(tangent[k], t[k], 1e-4);
        }
        put_away(&e);
    }
}

// Tangents of any cage are those of its derivatives and of the derivatives of its UVs.
static void check_tangents(const subdiv_mesh *cage, const ready *e, int count,
                           const subdiv_location *at, const float *tangents)
{
    subdiv_surface *uv = NULL;
    subdiv_options opt = {0};
    opt.triangulate = 1;
    CHECK_EQUAL(subdiv_prepare_face_varying(&uv, cage, cage->uv_count, cage->face_uvs,
                                            cage->uv_rule, SUBDIV_EXACT, &opt), SUBDIV_OK);
    void *scratch = malloc(subdiv_scratch_size(uv, 2));
    CHECK_EQUAL(subdiv_evaluate_begin(uv, 2, cage->uvs, 0, scratch, NULL), SUBDIV_OK);
    for (int i = 0; i < count && !test_bad; i++, tangents += 4) {
        float f[13];
        double d[13], t[3], size = 0;
        subdiv_derivatives of = {0}, uv_of = {0};
        of.du = f, of.dv = f + 3, of.normals = f + 6, uv_of.du = f + 9, uv_of.dv = f + 11;
        CHECK_EQUAL(subdiv_evaluate_at(e->surface, 3, e->scratch, 1, at + i, &of, NULL), SUBDIV_OK);
        CHECK_EQUAL(subdiv_evaluate_at(uv, 2, scratch, 1, at + i, &uv_of, NULL), SUBDIV_OK);
        for (int k = 0; k < 13; k++) d[k] = (double)f[k];
        for (int k = 0; k < 3; k++) size += (double)(tangents[k] * tangents[k]);
        double det = d[9] * d[12] - d[10] * d[11], wide = fabs(d[9] * d[12]) + fabs(d[10] * d[11]);
        int none = (f[6] == 0 && f[7] == 0 && f[8] == 0) || fabs(det) < 1e-6 * wide || wide == 0;
        CHECK(none ? size == 0 && tangents[3] == 0 : fabs(size - 1) < 1e-5);
        if (none || fabs(det) < 1e-3 * wide) continue;
        double w = expect_tangent(d, d + 3, d + 9, d + 11, d + 6, t), dot = 0, du = 0, dv = 0;
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(tangents[k], t[k], 1e-4);
            dot += d[k] * d[3 + k], du += d[k] * d[k], dv += d[3 + k] * d[3 + k];
        }
        if (dot * dot < (1 - 1e-6) * du * dv) CHECK_NEAR(tangents[3], w, 0);    // not parallel
    }
    subdiv_surface_free(uv);
    free(scratch);
}

// The vertices of a buffer have tangents beside their other attributes.
static void test_tangents(void)
{
    enum { STRIDE = 12 };
    for (unsigned seed = 1; seed <= CAGES; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL & ~RANDOM_DEGENERATE & ~RANDOM_CORNERS);
        subdiv_options opt = {0};
        subdiv_surface *surface = NULL;
        subdiv_mesh fine;
        subdiv_buffer b;
        snprintf(context, sizeof context, "seed %u", seed);
        test_context = context;
        opt.limit = opt.triangulate = 1;
        c->mesh.left_handed = (int)seed % 2;
        CHECK_EQUAL(subdiv_prepare(&surface, &c->mesh, 1, &opt), SUBDIV_OK);
        CHECK_EQUAL(subdiv_surface_mesh(&fine, surface, c->mesh.positions, &opt), SUBDIV_OK);
        CHECK_EQUAL(subdiv_make_buffer(&b, &fine, 4, NULL), SUBDIV_OK);
        size_t count = (size_t)b.vertex_count, all = (size_t)fine.face_size *
                                                     (size_t)fine.face_count;
        subdiv_location *where = (subdiv_location *)calloc(all + 1, sizeof *where), *at;
        at = (subdiv_location *)malloc(count * sizeof *at);
        float *data = (float *)malloc(count * STRIDE * sizeof *data);
        float *dense = (float *)malloc(count * 4 * sizeof *dense);
        CHECK_EQUAL(subdiv_surface_locations(surface, NULL, where, NULL), SUBDIV_OK);
        for (size_t i = 0; i < count; i++) {
            int h = b.face_vertices[i];
            at[i] = where[h];
            if (h == 0) continue;
            CHECK_EQUAL(fine.face_vertices[h], b.points[i]);
            CHECK_EQUAL(fine.face_normals ? fine.face_normals[h] : b.points[i], b.normals[i]);
            CHECK_EQUAL(fine.uv_count ? fine.face_uvs[h] : -1, b.uvs[i]);
        }
        ready e = get_ready(&c->mesh, &opt);
        CHECK_EQUAL(subdiv_tangents_at(e.surface, e.scratch, b.vertex_count, at, data + 8, STRIDE,
                                       NULL), c->mesh.uv_count ? SUBDIV_OK : SUBDIV_ERROR_ARGUMENT);
        for (size_t i = 0; i < count; i++)
            memcpy(dense + 4 * i, data + STRIDE * i + 8, 4 * sizeof(float));
        if (c->mesh.uv_count) check_tangents(&c->mesh, &e, b.vertex_count, at, dense);
        put_away(&e);
        free(where), free(at), free(data), free(dense);
        subdiv_buffer_free(&b);
        subdiv_mesh_free(&fine);
        subdiv_surface_free(surface);
        random_cage_free(c);
    }
}

// A strip whose UVs on the left mirror those on the right: where the sides have indices of their
// own, each triangle of a buffer has vertices of one handedness.
static void test_mirrored_uvs(void)
{
    enum { COUNT = 10, SIDES = 12, FACES = 4 };
    static float p[3 * COUNT], uvs[2 * SIDES], tangents[4 * 64];
    static int vertices[4 * FACES], sides[4 * FACES];
    static subdiv_location where[4 * 16], at[64];
    subdiv_mesh strip = {0}, fine;
    subdiv_surface *surface = NULL;
    subdiv_options opt = {0};
    subdiv_buffer b;
    for (int v = 0; v < COUNT; v++) {
        p[3 * v] = (float)(v % 5 - 2), p[3 * v + 1] = (float)(v / 5);
        uvs[2 * v] = fabsf(p[3 * v]), uvs[2 * v + 1] = p[3 * v + 1];
    }
    uvs[2 * COUNT + 3] = 1;                           // 10 and 11 are 2 and 7 of the right side
    for (int f = 0; f < FACES; f++) {
        int face[4] = { f, f + 1, f + 6, f + 5 };
        memcpy(vertices + 4 * f, face, sizeof face);
        for (int i = 0; i < 4; i++)
            sides[4 * f + i] = f >= 2 && face[i] % 5 == 2 ? COUNT + face[i] / 5 : face[i];
    }
    strip.vertex_count = COUNT, strip.positions = p;
    strip.face_count = FACES, strip.face_size = 4, strip.face_vertices = vertices;
    strip.uv_count = SIDES, strip.uvs = uvs, strip.face_uvs = sides;
    opt.limit = 1;
    for (int rule = SUBDIV_UV_CORNERS_ONLY; rule <= SUBDIV_UV_ALL; rule++) {
        strip.uv_rule = (subdiv_uv_rule)rule;
        CHECK_EQUAL(subdiv_prepare(&surface, &strip, 1, &opt), SUBDIV_OK);
        CHECK_EQUAL(subdiv_surface_mesh(&fine, surface, p, &opt), SUBDIV_OK);
        CHECK_EQUAL(subdiv_make_buffer(&b, &fine, 4, NULL), SUBDIV_OK);
        CHECK_EQUAL(b.vertex_count, 27 + 3);
        CHECK_EQUAL(subdiv_surface_locations(surface, NULL, where, NULL), SUBDIV_OK);
        for (int i = 0; i < b.vertex_count; i++) at[i] = where[b.face_vertices[i]];
        ready e = get_ready(&strip, &opt);
        CHECK_EQUAL(subdiv_tangents_at(e.surface, e.scratch, b.vertex_count, at, tangents, 0,
                                       NULL), SUBDIV_OK);
        for (int i = 0; i < b.index_count; i++) {
            const int *triangle = (const int *)b.indices + i - i % 3;
            float x = 0;
            for (int k = 0; k < 3; k++) x += fine.positions[3 * b.points[triangle[k]]];
            CHECK(tangents[4 * triangle[i % 3] + 3] == (x > 0 ? 1.0f : -1.0f));
        }
        put_away(&e);
        subdiv_buffer_free(&b);
        subdiv_mesh_free(&fine);
        subdiv_surface_free(surface);
    }
}

int main(void)
{
    RUN(test_random_cages);
    RUN(test_mirrored_uvs);
    RUN(test_splines);
    RUN(test_tangents);
    return test_end("locations");
}
