// One surface: whichever call is asked, a place on the limit has the same point and normal. Random
// cages through subdiv_refine with opt->limit, subdiv_evaluate_at from every face, a tessellation
// and both kinds of stencils, on every level; then the same cage far from the origin. The normal of
// each face-vertex is that of its own face, also where two meet at a crease. (That
// subdiv_evaluate_at is right, test_exact_oracle.c shows.)
//
//     cc -I. tests/test_doors.c -o build/test_doors -lm && build/test_doors
#include <stdio.h>
#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/order.h"
#include "lib/random_cage.h"
#include "lib/test.h"

enum { FEATURES = RANDOM_ALL & ~RANDOM_DEGENERATE & ~RANDOM_UVS, CAGES = 400, LEVELS = 4 };

static const double point_tolerance = 1e-6;       // of the extent of the cage
static const double normal_tolerance = 0.04;      // degrees; hardly any is turned by more than 0.01

static char context[96];

static double distance(const float *a, const float *b)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += pow((double)a[k] - (double)b[k], 2);
    return sqrt(sum);
}

// The angle between unit vectors in degrees; between 0 and a vector 180.
static double angle(const float *a, const float *b)
{
    static const float zero[3] = { 0, 0, 0 };
    int none = (distance(a, zero) < 0.5) + (distance(b, zero) < 0.5);
    if (none) return none == 2 ? 0 : 180;
    return 2 * asin(fmin(1, distance(a, b) / 2)) * 180 / 3.14159265358979323846;
}

// All that the doors say of the points of one result.
typedef struct doors {
    const subdiv_mesh *cage;
    order  order;
    int    levels;
    double size, tolerance;             // the extent; of points, relative to it
    subdiv_mesh fine, tiles;
    subdiv_surface *exact;
    void  *scratch;
    double *worst;                      // [points] how far off it is, for any face; -1: no face
    double turned;                      // degrees: the most that a face-vertex's normal is
} doors;

static int open_doors(doors *d, const subdiv_mesh *cage, int levels)
{
    subdiv_options opt = {0};
    subdiv_tessellation how = {0};
    memset(d, 0, sizeof *d);
    d->cage = cage;
    d->levels = levels;
    d->size = mesh_extent(cage);
    d->tolerance = point_tolerance + 1.2e-7 * fabs((double)cage->positions[0]) / d->size;
    opt.limit = 1;
    how.rate = 1 << levels;
    CHECK(order_make(&d->order, cage, levels ? levels : 1, NULL));
    CHECK_EQUAL(subdiv_refine(&d->fine, cage, levels, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_tessellate(&d->tiles, cage, &how, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_prepare(&d->exact, cage, SUBDIV_EXACT, NULL), SUBDIV_OK);
    if (test_bad) return 0;
    d->scratch = malloc(subdiv_scratch_size(d->exact, 3));
    d->worst = malloc((size_t)d->fine.vertex_count * sizeof *d->worst);
    CHECK_EQUAL(subdiv_evaluate_begin(d->exact, 3, cage->positions, 0, d->scratch, NULL),
                SUBDIV_OK);
    for (int i = 0; i < d->fine.vertex_count; i++) d->worst[i] = -1;
    return 1;
}

static void close_doors(doors *d)
{
    free(d->scratch);
    free(d->worst);
    order_free(&d->order);
    subdiv_mesh_free(&d->fine);
    subdiv_mesh_free(&d->tiles);
    subdiv_surface_free(d->exact);
}

// Finds the point and the normal at a place of a face. Returns 0 if there is no surface.
static int look(const doors *d, int face, int corner, double u, double v, float *p, float *n)
{
    const subdiv_location at = { face, corner, (float)u, (float)v };
    static const float zero[3] = { 0, 0, 0 };
    subdiv_derivatives out = {0};
    out.points = p;
    out.normals = n;
    CHECK_EQUAL(subdiv_evaluate_at(d->exact, 3, d->scratch, 1, &at, &out, NULL), SUBDIV_OK);
    return memcmp(p, zero, sizeof zero) || memcmp(n, zero, sizeof zero);
}

// Compares a point of the result with the place that a face has for it.
static void meet(doors *d, int point, int face, int corner, double u, double v)
{
    float p[3], n[3];
    if (!look(d, face, corner, u, v, p, n)) return;
    d->worst[point] = fmax(d->worst[point], distance(p, d->fine.positions + 3 * point) / d->size);
}

// Compares the normal of a mesh's face-vertex with that of its face at (u, v).
static void meet_normal(doors *d, const subdiv_mesh *mesh, size_t h, int face, int corner, double u,
                        double v)
{
    float p[3], n[3];
    int i = mesh->face_normals ? mesh->face_normals[h] : mesh->face_vertices[h];
    int spoke = order_is_ngon(&d->order, face) && (u > 0.999 || v > 0.999);
    if (spoke && d->cage->scheme == SUBDIV_BILINEAR) return;       // it has one of two normals
    if (!look(d, face, corner, u, v, p, n)) return;
    CHECK(i >= 0 && i < mesh->normal_count);
    d->turned = fmax(d->turned, angle(n, mesh->normals + 3 * i));
}

// Compares the normals of all face-vertices, each seen from its own face.
static void meet_normals(doors *d, const subdiv_mesh *mesh)
{
    static const int columns[3][4] = { { 0, 1, 1, 0 }, { 0, 1, 0, 0 }, { 1, 0, 1, 0 } };
    static const int rows[3][4] = { { 0, 0, 1, 1 }, { 0, 0, 1, 0 }, { 1, 1, 0, 0 } };
    int loop = d->cage->scheme == SUBDIV_LOOP, fine = 0;
    size_t h = 0;
    for (int f = 0; f < d->cage->face_count; f++) {
        int ngon = order_is_ngon(&d->order, f), n = order_grid(&d->order, f);
        int size = face_size(d->cage, f), quads = ngon ? size : 1;
        if (fine >= mesh->face_count || mesh->cage_faces[fine] != f) continue;       // a hole
        for (int i = 0; i < size && d->levels == 0; i++)
            meet_normal(d, mesh, h++, f, ngon ? i : 0, ngon ? 0 : columns[loop][i],
                        ngon ? 0 : rows[loop][i]);
        fine += d->levels ? order_faces_inside(&d->order, f) : 1;
        for (int k = 0; k < quads * n * n && d->levels; k++) {
            int quad = k / (n * n), row = k / n % n, column = k % n;
            for (int t = 0; t <= loop && (!loop || row + column + t < n); t++)     // 1: turned
                for (int i = 0; i < 4 - loop; i++)
                    meet_normal(d, mesh, h++, f, quad, (column + columns[loop + t][i]) / (double)n,
                                (row + rows[loop + t][i]) / (double)n);
        }
    }
    CHECK_EQUAL(fine, mesh->face_count);
}

static void meet_faces(doors *d)
{
    static const double corner_u[2][4] = { { 0, 1, 1, 0 }, { 0, 1, 0, 0 } };
    static const double corner_v[2][4] = { { 0, 0, 1, 1 }, { 0, 0, 1, 0 } };
    int loop = d->cage->scheme == SUBDIV_LOOP;
    for (int f = 0; f < d->cage->face_count; f++) {
        int ngon = order_is_ngon(&d->order, f);
        double steps = order_grid(&d->order, f);
        order_place p = { f, 0, 0, 0, 0 };
        for (int i = 0; i < face_size(d->cage, f) && d->levels == 0; i++)
            meet(d, order_face_vertex(&d->order, f, i), f, ngon ? i : 0,
                 ngon ? 0 : corner_u[loop][i], ngon ? 0 : corner_v[loop][i]);
        if (d->levels == 0) continue;
        do meet(d, place_point(&d->order, p), f, ngon ? p.quad : 0, p.column / steps,
                p.row / steps);
        while (place_next_point(&d->order, &p));
    }
}

// A stencil's point against that of the result.
static void check_stencils(const doors *d)
{
    subdiv_options opt = {0};
    subdiv_surface *surface;
    subdiv_stencils s = {0};
    opt.limit = 1;
    CHECK_EQUAL(subdiv_prepare(&surface, d->cage, d->levels, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refined_stencils(&s, surface, 0, d->fine.vertex_count, NULL), SUBDIV_OK);
    for (int i = 0; i < s.count; i++) {
        double p[3] = { 0, 0, 0 };
        for (size_t k = s.offsets[i]; k < s.offsets[i + 1]; k++)
            for (int c = 0; c < 3; c++)
                p[c] += (double)s.weights[k] * (double)d->cage->positions[3 * s.indices[k] + c];
        for (int c = 0; c < 3; c++)
            CHECK_NEAR(d->fine.positions[3 * i + c], p[c], 2 * d->tolerance * d->size);
    }
    subdiv_stencils_free(&s);
    subdiv_surface_free(surface);
}

static void check_doors(doors *d)
{
    // Rounding turns a normal the more the smaller the faces are: at level 4 a few in a million.
    double turned = normal_tolerance * (1 << d->levels > 4 ? 4 : 1);
    int same = d->tiles.vertex_count == d->fine.vertex_count;       // not so: polygons at level 0
    for (int i = 0; i < d->fine.vertex_count; i++) {
        if (d->worst[i] < 0) continue;                    // no face with a surface
        CHECK_NEAR(d->worst[i], 0, d->tolerance);
        if (!same) continue;
        CHECK_NEAR(distance(d->fine.positions + 3 * i, d->tiles.positions + 3 * i) / d->size, 0,
                   d->tolerance);
    }
    meet_normals(d, &d->fine);
    if (same) meet_normals(d, &d->tiles);
    CHECK_NEAR(d->turned, 0, turned);
}

static void run_cage(const subdiv_mesh *cage, int levels)
{
    doors d;
    if (open_doors(&d, cage, levels)) {
        meet_faces(&d);
        check_doors(&d);
        if (levels < 3) check_stencils(&d);
    }
    close_doors(&d);
}

static void test_random_cages(void)
{
    for (unsigned seed = 1; seed <= CAGES; seed++) {
        random_cage *c = random_cage_new(seed, FEATURES);
        snprintf(context, sizeof context, "seed %u", seed);
        test_context = context;
        run_cage(&c->mesh, (int)(seed % (LEVELS + 1)));
        random_cage_free(c);
    }
}

// Every valence, with everything that can be sharp at a vertex.
static void test_stars(void)
{
    static const double sharpness[] = { 0.5, 1, 2.5, 4, 9.5, SUBDIV_INFINITE };
    for (int scheme = 0; scheme < 2; scheme++)
        for (int faces = 1; faces <= 12; faces++)
            for (int kind = 0; kind < 24; kind++) {
                static test_cage c;
                int closed = faces > 2 && kind % 2, creases = kind / 2 % 4;
                build_fan(&c, scheme ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, faces, closed);
                for (int i = 0; i < creases && i < faces; i++)
                    cage_crease(&c, 0, 1 + (scheme ? 1 : 2) * (i * faces / creases),
                                sharpness[(kind + i * 5 + faces) % 6]);
                if (kind >= 16) cage_corner(&c, 0, sharpness[(kind + faces) % 6]);
                c.mesh.creasing = kind % 3 ? SUBDIV_CREASING_UNIFORM : SUBDIV_CREASING_CHAIKIN;
                snprintf(context, sizeof context, "scheme %d, %d faces, kind %d", scheme, faces,
                         kind);
                test_context = context;
                run_cage(&c.mesh, kind % 3);
            }
}

// A translation that is exact in floats moves the points and turns no normal.
static void test_far_away(void)
{
    for (unsigned seed = 1; seed <= 60; seed++) {
        random_cage *c = random_cage_new(seed, FEATURES);
        subdiv_mesh *m = &c->mesh, here = {0}, there = {0};
        subdiv_options opt = {0};
        opt.limit = 1;
        snprintf(context, sizeof context, "seed %u, far away", seed);
        test_context = context;
        for (int i = 0; i < 3 * m->vertex_count; i++)     // on a grid that is as fine far away
            m->positions[i] = floorf(64 * m->positions[i]) / 64;
        CHECK_EQUAL(subdiv_refine(&here, m, 2, &opt), SUBDIV_OK);
        for (int i = 0; i < m->vertex_count; i++) m->positions[3 * i] += 131072;
        CHECK_EQUAL(subdiv_refine(&there, m, 2, &opt), SUBDIV_OK);
        for (int i = 0; i < here.vertex_count && !test_bad; i++)
            CHECK_NEAR(angle(here.normals + 3 * i, there.normals + 3 * i), 0, normal_tolerance);
        run_cage(m, 2);
        subdiv_mesh_free(&here);
        subdiv_mesh_free(&there);
        random_cage_free(c);
    }
}

int main(void)
{
    RUN(test_random_cages);
    RUN(test_stars);
    RUN(test_far_away);
    return test_end("doors");
}
