// Stencils: each weight beside what evaluation makes of unit vectors, sums of the cage's positions
// beside refinement, the masks of the papers as fractions; and what explain says of every rule.
//
//     cc -I. tests/test_stencils.c -o build/test_stencils -lm && build/test_stencils
#include <float.h>
#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/test.h"

static char where[96];

static void say_where(const char *what, unsigned seed, int level)
{
    snprintf(where, sizeof where, "%s, seed %u, level %d", what, seed, level);
    test_context = where;
}

// In order, and as many weights as there should be.
static void check_shape(const subdiv_stencils *s, int points, int inputs)
{
    CHECK_EQUAL(s->count, points);
    CHECK_EQUAL(s->offsets[0], 0);
    for (int i = 0; i < s->count; i++) {
        CHECK(s->offsets[i] <= s->offsets[i + 1]);
        for (size_t k = s->offsets[i]; k < s->offsets[i + 1]; k++) {
            CHECK(s->indices[k] >= 0 && s->indices[k] < inputs);
            CHECK(k == s->offsets[i] || s->indices[k - 1] < s->indices[k]);
        }
    }
}

static void check_sums(const subdiv_stencils *s)
{
    for (int i = 0; i < s->count; i++) {
        double sum = 0, du = 0, dv = 0, largest = 1;
        for (size_t k = s->offsets[i]; k < s->offsets[i + 1]; k++) {
            sum += (double)s->weights[k];
            if (!s->du) continue;
            du += (double)s->du[k];
            dv += (double)s->dv[k];
            largest = fmax(largest, fabs((double)s->du[k]));
            largest = fmax(largest, fabs((double)s->dv[k]));
        }
        CHECK_NEAR(sum, 1, 1e-6);
        CHECK_NEAR(du, 0, 1e-6 * largest);
        CHECK_NEAR(dv, 0, 1e-6 * largest);
    }
}

// Each stencil written out, [inputs] floats a point, is what evaluation makes of unit vectors.
static void check_weights(const subdiv_stencils *s, const float *weights, const float *expected,
                          int inputs, double tolerance)
{
    float *row = malloc(sizeof(float) * (size_t)inputs);
    for (int i = 0; i < s->count && row; i++) {
        for (int v = 0; v < inputs; v++) row[v] = 0;
        for (size_t k = s->offsets[i]; k < s->offsets[i + 1]; k++) row[s->indices[k]] = weights[k];
        for (int v = 0; v < inputs; v++)
            CHECK_NEAR(row[v], expected[(size_t)i * (size_t)inputs + (size_t)v], tolerance);
    }
    free(row);
}

static float *units(int count)
{
    float *in = calloc((size_t)count * (size_t)count, sizeof(float));
    for (int v = 0; v < count && in; v++) in[(size_t)v * (size_t)(count + 1)] = 1;
    return in;
}

static void check_surface(const subdiv_surface *surface, int inputs)
{
    int points = subdiv_surface_vertex_count(surface);
    float *in = units(inputs), *out = malloc(sizeof(float) * (size_t)points * (size_t)inputs);
    subdiv_stencils stencils;
    CHECK_EQUAL(subdiv_evaluate(surface, inputs, in, 0, out, 0, NULL, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refined_stencils(&stencils, surface, 0, points, NULL), SUBDIV_OK);
    check_shape(&stencils, points, inputs);
    check_sums(&stencils);
    check_weights(&stencils, stencils.weights, out, inputs, 1e-6);
    subdiv_stencils_free(&stencils);
    CHECK(stencils.memory == NULL && stencils.offsets == NULL);
    free(in), free(out);
}

static void test_random_cages(void)
{
    for (unsigned seed = 0; seed < 60; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        for (int level = 0; level <= 3 - (c->mesh.vertex_count > 60); level++) {
            subdiv_surface *surface;
            say_where("random", seed, level);
            CHECK_EQUAL(subdiv_prepare(&surface, &c->mesh, level, NULL), SUBDIV_OK);
            check_surface(surface, c->mesh.vertex_count);
            subdiv_surface_free(surface);
        }
        random_cage_free(c);
    }
}

static void test_face_varying(void)
{
    for (unsigned seed = 0; seed < 60; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        for (int level = 0; level <= 2 && c->mesh.uv_count > 0; level++) {
            subdiv_surface *surface;
            say_where("face-varying", seed, level);
            CHECK_EQUAL(subdiv_prepare_face_varying(&surface, &c->mesh, c->mesh.uv_count,
                                                    c->mesh.face_uvs, c->mesh.uv_rule, level,
                                                    NULL), SUBDIV_OK);
            check_surface(surface, c->mesh.uv_count);
            subdiv_surface_free(surface);
        }
        random_cage_free(c);
    }
}

// Positions and tangents of three unit vectors at a time, as x, y and z.
static void check_limit(const subdiv_surface *surface, int inputs)
{
    int points = subdiv_surface_vertex_count(surface);
    subdiv_stencils stencils;
    float *in = calloc(3 * (size_t)inputs, sizeof(float));
    size_t size = sizeof(float) * (size_t)points;
    float *p = malloc(3 * size), *t = malloc(6 * size), *w[3];
    size *= (size_t)inputs;
    for (int k = 0; k < 3; k++) w[k] = malloc(size);
    subdiv_limit out = { p, NULL, t, 0, NULL };
    for (int v = 0; v < inputs; v += 3) {
        for (int k = 0; k < 3 && v + k < inputs; k++) in[3 * (v + k) + k] = 1;
        CHECK_EQUAL(subdiv_evaluate_limit(surface, in, 0, &out, NULL, NULL), SUBDIV_OK);
        for (int k = 0; k < 3 && v + k < inputs; k++) in[3 * (v + k) + k] = 0;
        for (int i = 0; i < points; i++) {
            for (int k = 0; k < 3 && v + k < inputs; k++) {
                size_t at = (size_t)i * (size_t)inputs + (size_t)(v + k);
                w[0][at] = p[3 * i + k];
                w[1][at] = t[6 * i + k];
                w[2][at] = t[6 * i + 3 + k];
            }
        }
    }
    CHECK_EQUAL(subdiv_refined_stencils(&stencils, surface, 0, points, NULL), SUBDIV_OK);
    check_shape(&stencils, points, inputs);
    check_sums(&stencils);
    check_weights(&stencils, stencils.weights, w[0], inputs, 1e-6);
    check_weights(&stencils, stencils.du, w[1], inputs, 1e-5);
    check_weights(&stencils, stencils.dv, w[2], inputs, 1e-5);
    subdiv_stencils_free(&stencils);
    for (int k = 0; k < 3; k++) free(w[k]);
    free(in), free(p), free(t);
}

static void test_limits(void)
{
    subdiv_options opt = {0};
    opt.limit = 1;
    for (unsigned seed = 0; seed < 40; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        for (int level = 0; level <= 2 && c->mesh.vertex_count < 90; level++) {
            subdiv_surface *surface;
            say_where("limit", seed, level);
            CHECK_EQUAL(subdiv_prepare(&surface, &c->mesh, level, &opt), SUBDIV_OK);
            check_limit(surface, c->mesh.vertex_count);
            subdiv_surface_free(surface);
        }
        random_cage_free(c);
    }
}

// Parts of the result have the same stencils as the whole.
static void test_parts(void)
{
    for (int limit = 0; limit < 2; limit++) {
        random_cage *c = random_cage_new(3, RANDOM_ALL);
        subdiv_options opt = {0};
        subdiv_stencils all, part;
        subdiv_surface *surface;
        opt.limit = limit;
        CHECK_EQUAL(subdiv_prepare(&surface, &c->mesh, 3, &opt), SUBDIV_OK);
        int points = subdiv_surface_vertex_count(surface);
        CHECK_EQUAL(subdiv_refined_stencils(&all, surface, 0, points, &opt), SUBDIV_OK);
        for (int first = 0; first < points; first += 1 + points / 23) {
            int count = first % 7 < points - first ? first % 7 : points - first;
            CHECK_EQUAL(subdiv_refined_stencils(&part, surface, first, count, &opt), SUBDIV_OK);
            CHECK_EQUAL(part.count, count);
            for (int i = 0; i < count; i++) {
                size_t from = part.offsets[i], to = part.offsets[i + 1];
                size_t start = all.offsets[first + i];
                CHECK_EQUAL(to - from, all.offsets[first + i + 1] - start);
                for (size_t k = 0; k < to - from; k++) {
                    CHECK_EQUAL(part.indices[from + k], all.indices[start + k]);
                    CHECK_NEAR(part.weights[from + k], all.weights[start + k], 1e-7);
                }
            }
            subdiv_stencils_free(&part);
        }
        subdiv_stencils_free(&all);
        subdiv_surface_free(surface);
        random_cage_free(c);
    }
}

// ------------------------------------------------------------------------------------- anywhere

// Places on each face, or on each quad of an n-gon: its vertex, its middle, near its vertices and
// edges, on its edges.
static int places_of(const subdiv_mesh *mesh, subdiv_location *at, int most)
{
    static const float places[9][2] = { {0, 0}, {0.5f, 0.25f}, {1e-5f, 3e-6f}, {0.875f, 0.1f},
                                        {0.3f, 0}, {0, 1}, {0.04f, 0.03f}, {0.26f, 0.73f}, {1, 0} };
    int count = 0;
    for (int f = 0; f < mesh->face_count; f++) {
        int size = mesh->face_size ? mesh->face_size : mesh->face_sizes[f];
        int corners = mesh->scheme == SUBDIV_LOOP || size == 4 ? 1 : size;
        for (int i = 0; i < 9 && count < most; i++) {
            subdiv_location place = { f, (f + i) % corners, places[i][0], places[i][1] };
            at[count++] = place;
        }
    }
    return count;
}

// Each location's stencils beside evaluation of unit vectors. Derivatives have the size of their
// weights as the measure.
static void check_locations(const subdiv_surface *surface, const subdiv_mesh *mesh, int inputs)
{
    static subdiv_location at[400];
    int count = places_of(mesh, at, 400);
    size_t size = sizeof(float) * (size_t)count * (size_t)inputs;
    float *in = units(inputs), *out[6];
    void *scratch = malloc(subdiv_scratch_size(surface, inputs));
    subdiv_stencils s;
    for (int k = 0; k < 6; k++) out[k] = malloc(size);
    subdiv_derivatives values = { out[0], out[1], out[2], out[3], out[4], out[5], NULL, 0 };
    CHECK_EQUAL(subdiv_evaluate_begin(surface, inputs, in, 0, scratch, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_evaluate_at(surface, inputs, scratch, count, at, &values, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_stencils_at(&s, surface, count, at, NULL), SUBDIV_OK);
    check_shape(&s, count, inputs);
    const float *all[6] = { s.weights, s.du, s.dv, s.duu, s.duv, s.dvv };
    for (int k = 0; k < 6; k++) {
        const float *weights = all[k];
        for (int i = 0; i < s.count; i++) {
            const float *expected = out[k] + (size_t)i * (size_t)inputs;
            double sum = 0, wanted = 0, largest = 1;
            size_t j = s.offsets[i];
            for (int v = 0; v < inputs; v++) {
                wanted += (double)expected[v];
                largest = fmax(largest, fabs((double)expected[v]));
            }
            for (int v = 0; v < inputs; v++) {
                int there = j < s.offsets[i + 1] && s.indices[j] == v;
                double weight = there ? (double)weights[j++] : 0;
                sum += weight;
                CHECK_NEAR(weight, expected[v], (k > 2 ? 1e-5 : k ? 5e-6 : 1e-6) * largest);
            }
            CHECK_NEAR(sum, k ? 0 : floor(wanted + 0.5), 1e-6 * largest);
        }
    }
    subdiv_stencils_free(&s);
    for (int k = 0; k < 6; k++) free(out[k]);
    free(in), free(scratch);
}

static void test_anywhere(void)
{
    for (unsigned seed = 0; seed < 50; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        const subdiv_mesh *mesh = &c->mesh;
        subdiv_surface *surface;
        say_where("anywhere", seed, -1);
        CHECK_EQUAL(subdiv_prepare(&surface, mesh, SUBDIV_EXACT, NULL), SUBDIV_OK);
        check_locations(surface, mesh, mesh->vertex_count);
        subdiv_surface_free(surface);
        if (mesh->uv_count > 0) {
            CHECK_EQUAL(subdiv_prepare_face_varying(&surface, mesh, mesh->uv_count,
                                                    mesh->face_uvs, mesh->uv_rule, SUBDIV_EXACT,
                                                    NULL), SUBDIV_OK);
            check_locations(surface, mesh, mesh->uv_count);
            subdiv_surface_free(surface);
        }
        random_cage_free(c);
    }
}

// Levels beyond those that are made whole, whose grids have frames of work points alone.
static void test_deep_levels(void)
{
    for (int i = 0; i < 6; i++) {
        static test_cage c;
        subdiv_surface *surface;
        subdiv_stencils s;
        subdiv_mesh fine;
        build_prism(&c, 3);
        if (i % 2) build_grid(&c, SUBDIV_LOOP, 2, 1);
        CHECK_EQUAL(subdiv_prepare(&surface, &c.mesh, 5 + i / 2, NULL), SUBDIV_OK);
        CHECK_EQUAL(subdiv_surface_mesh(&fine, surface, c.positions, NULL), SUBDIV_OK);
        for (int first = 0; first < fine.vertex_count; first += 1 + fine.vertex_count / 7) {
            const int left = fine.vertex_count - first, count = left < 300 ? left : 300;
            CHECK_EQUAL(subdiv_refined_stencils(&s, surface, first, count, NULL), SUBDIV_OK);
            for (int k = 0; k < 3 * count; k++) {
                double sum = 0;
                for (size_t j = s.offsets[k / 3]; j < s.offsets[k / 3 + 1]; j++)
                    sum += (double)s.weights[j] * (double)c.positions[3 * s.indices[j] + k % 3];
                CHECK_NEAR(sum, fine.positions[3 * first + k], 2e-6);
            }
            subdiv_stencils_free(&s);
        }
        subdiv_mesh_free(&fine);
        subdiv_surface_free(surface);
    }
}

// The derivatives of the four cubic B-splines at t.
static double spline(int i, double t, int derivative)
{
    static const double c[4][4] = { {1,-3,3,-1}, {4,0,-6,3}, {1,3,3,-3}, {0,0,0,1} };
    const double *a = c[i];
    if (derivative == 0) return (a[0] + t * (a[1] + t * (a[2] + t * a[3]))) / 6;
    return (derivative == 1 ? a[1] + t * (2 * a[2] + t * 3 * a[3]) : 2 * a[2] + 6 * t * a[3]) / 6;
}

// Weights up to the rounding of the largest one are left out, others not: for each part of a
// regular stencil alone, whose weights are products of B-splines.
static void test_rounding(void)
{
    test_cage c;
    subdiv_surface *surface;
    subdiv_location at[480];
    subdiv_stencils s;
    build_grid(&c, SUBDIV_CATMULL_CLARK, 3, 3);
    for (int i = 0; i < 480; i++) {
        const subdiv_location place = { 4, 0, (float)exp2(-i / 16.0), (float)(i % 3) / 3 };
        at[i] = place;
    }
    CHECK_EQUAL(subdiv_prepare(&surface, &c.mesh, SUBDIV_EXACT, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_stencils_at(&s, surface, 480, at, NULL), SUBDIV_OK);
    const int *q = face_vertices(&c.mesh, 4), right = q[1] - q[0], up = q[3] - q[0];
    const float *parts[6] = { s.weights, s.du, s.dv, s.duu, s.duv, s.dvv };
    static const int du[6] = { 0, 1, 0, 2, 1, 0 }, dv[6] = { 0, 0, 1, 0, 1, 2 };
    for (int i = 0; i < 6 * 480; i++) {
        const int at_i = i / 6, part = i % 6;
        double exact[16], largest = 0;
        for (int k = 0; k < 16; k++) {
            exact[k] = spline(k % 4, (double)at[at_i].u, du[part]) *
                       spline(k / 4, (double)at[at_i].v, dv[part]);
            largest = fmax(largest, fabs(exact[k]));
        }
        for (int k = 0; k < 16; k++) {
            const int vertex = q[0] + (k % 4 - 1) * right + (k / 4 - 1) * up;
            const double size = fabs(exact[k]) / (largest * (double)FLT_EPSILON);
            double weight = 0;
            for (size_t j = s.offsets[at_i]; j < s.offsets[at_i + 1]; j++)
                if (s.indices[j] == vertex) weight = (double)parts[part][j];
            if (size > 1.05) CHECK_NEAR(weight, exact[k], 1e-3 * fabs(exact[k]));
            if (size < 0.95) CHECK(weight == 0);
        }
    }
    subdiv_stencils_free(&s);
    subdiv_surface_free(surface);
}

// At a vertex of any valence n the weights of du are a wave, 4 cos(i a) at edge i and what belongs
// to it at the faces, times a scale that is the sum of edges^2 / 4 + faces^2: at a regular vertex
// that makes it the derivative. That holds around the vertex on level 1; the cage is one step
// before, which multiplies the wave by its eigenvalue and u by 2.
static void test_tangent_sizes(void)
{
    const subdiv_location at = { 0, 0, 0, 0 };
    for (int n = 3; n <= 12; n++) {
        test_cage c;
        subdiv_surface *surface;
        subdiv_stencils s;
        double size = 0, largest = 0, cosine = cos(8 * atan(1.0) / n);
        double eigenvalue = (5 + cosine + sqrt((9 + cosine) * (1 + cosine))) / 16;
        build_fan(&c, SUBDIV_CATMULL_CLARK, n, 1);
        CHECK_EQUAL(subdiv_prepare(&surface, &c.mesh, SUBDIV_EXACT, NULL), SUBDIV_OK);
        CHECK_EQUAL(subdiv_stencils_at(&s, surface, 1, &at, NULL), SUBDIV_OK);
        for (size_t k = 0; k < s.offsets[1]; k++) {
            const double w = (double)s.du[k];
            int on_edge = 0;
            for (int f = 0; f < n; f++) {
                const int *q = face_vertices(&c.mesh, f);       // from vertex 0 on
                on_edge |= q[1] == s.indices[k] || q[3] == s.indices[k];
            }
            size += on_edge ? w * w / 4 : w * w;
            if (on_edge) largest = fmax(largest, w);
        }
        CHECK_NEAR(4 * size, 2 * eigenvalue * largest, 1e-6);
        if (n == 4) CHECK_NEAR(largest, 1.0 / 3, 1e-6);
        subdiv_stencils_free(&s);
        subdiv_surface_free(surface);
    }
}

// ----------------------------------------------------------------------- around irregular vertices

// Quads, triangles under Catmull-Clark, Loop; and what the vertex 0 of their faces is. Each face
// starts one vertex later than the one before.
enum { QUADS, TRIANGLES, LOOP, SHAPES };
enum { SMOOTH, DART, CREASE, CORNER, BOUNDARY, BOUNDARY_CORNER, VERTICES };
enum { MOST_FACES = 2000 };

typedef struct wheel {
    subdiv_mesh mesh;
    float positions[3 * (2 * MOST_FACES + 2)];
    int   faces[4 * MOST_FACES], crease[4];
} wheel;

static void build_wheel(wheel *w, int shape, int vertex, int n)
{
    static float forever[2] = { SUBDIV_INFINITE, SUBDIV_INFINITE };
    int open = vertex >= BOUNDARY, spokes = n + open, size = shape == QUADS ? 4 : 3;
    subdiv_mesh *m = &w->mesh;
    memset(w, 0, sizeof *w);
    m->scheme = shape == LOOP ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK;
    m->vertex_count = 1 + spokes + (shape == QUADS ? n : 0);
    m->positions = w->positions;
    m->face_count = n;
    m->face_size = size;
    m->face_vertices = w->faces;
    for (int f = 0; f < n; f++) {
        int face[4] = { 0, 1 + f, 1 + spokes + f, 1 + (f + 1) % spokes };
        if (shape != QUADS) face[2] = face[3];
        for (int i = 0; i < size; i++) w->faces[size * f + i] = face[(f + i) % size];
    }
    w->crease[1] = 1;
    w->crease[3] = 1 + n / 2;
    m->crease_count = vertex == DART ? 1 : vertex == CREASE ? 2 : 0;
    m->corner_count = vertex == CORNER || vertex == BOUNDARY_CORNER;
    m->crease_vertices = m->corner_vertices = w->crease;
    m->crease_sharpness = m->corner_sharpness = forever;
    for (int i = 0; i < 3 * m->vertex_count; i++)
        w->positions[i] = (float)(i * 7919 % 127) / 64 - 1;
}

// At vertex 0, near it, on its edges; floats are not so near to other corners of the face.
static int places_at_wheel(const wheel *w, int shape, subdiv_location *at)
{
    static const float places[9][2] = { {0, 0}, {1e-9f, 3e-10f}, {0, 1e-9f}, {1e-9f, 0},
                                        {3e-6f, 2e-5f}, {0, 1e-3f}, {0.05f, 0.06f}, {0.26f, 0.14f},
                                        {0.4f, 0} };
    int n = w->mesh.face_count, size = w->mesh.face_size, count = 0;
    const int faces[3] = { 0, n / 2, n - 1 };
    for (int i = 0; i < (n > 100 ? 9 : 27); i++) {
        float x = places[i % 9][0], y = places[i % 9][1];
        int f = faces[i / 9], corner = 0;
        while (w->faces[size * f + corner]) corner++;
        subdiv_location here = { f, 0, x, y };
        if (shape == TRIANGLES) here.corner = corner;
        if (shape == LOOP && corner == 1) here.u = 1 - x - y, here.v = x;
        if (shape == LOOP && corner == 2) here.u = y, here.v = 1 - x - y;
        if (shape == QUADS && corner == 1) here.u = 1 - y, here.v = x;
        if (shape == QUADS && corner == 2) here.u = 1 - x, here.v = 1 - y;
        if (shape == QUADS && corner == 3) here.u = y, here.v = 1 - x;
        at[count++] = here;
    }
    return count;
}

// Sums of the values beside evaluation.
static void check_wheel(const wheel *w, int shape)
{
    subdiv_location at[27];
    float out[6][3 * 27];
    subdiv_derivatives values = { out[0], out[1], out[2], out[3], out[4], out[5], NULL, 0 };
    subdiv_surface *surface;
    subdiv_stencils s;
    int count = places_at_wheel(w, shape, at);
    CHECK_EQUAL(subdiv_prepare(&surface, &w->mesh, SUBDIV_EXACT, NULL), SUBDIV_OK);
    void *scratch = malloc(subdiv_scratch_size(surface, 3));
    CHECK_EQUAL(subdiv_evaluate_begin(surface, 3, w->positions, 0, scratch, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_evaluate_at(surface, 3, scratch, count, at, &values, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_stencils_at(&s, surface, count, at, NULL), SUBDIV_OK);
    check_shape(&s, count, w->mesh.vertex_count);
    check_sums(&s);
    for (int i = 0; i < 3 * s.count; i++) {
        double sum[6] = { 0 }, point = 0, derivative = 0, second = 0;
        for (size_t j = s.offsets[i / 3]; j < s.offsets[i / 3 + 1]; j++) {
            double value = (double)w->positions[3 * s.indices[j] + i % 3];
            sum[0] += (double)s.weights[j] * value;
            sum[1] += (double)s.du[j] * value;
            sum[2] += (double)s.dv[j] * value;
            sum[3] += (double)s.duu[j] * value;
            sum[4] += (double)s.duv[j] * value;
            sum[5] += (double)s.dvv[j] * value;
            second += fabs((double)s.duu[j]) + fabs((double)s.duv[j]) + fabs((double)s.dvv[j]);
            point += fabs((double)s.weights[j]);
            derivative += fabs((double)s.du[j]) + fabs((double)s.dv[j]);
        }
        CHECK_NEAR(sum[0], out[0][i], 2e-6 * point);
        CHECK_NEAR(sum[1], out[1][i], 1e-6 * derivative);
        CHECK_NEAR(sum[2], out[2][i], 1e-6 * derivative);
        for (int k = 3; k < 6; k++) CHECK_NEAR(sum[k], out[k][i], 2e-6 * second);
    }
    subdiv_stencils_free(&s);
    subdiv_surface_free(surface);
    free(scratch);
}

static void test_valences(void)
{
    static const int valences[] = { 3, 4, 5, 6, 7, 8, 9, 10, 13, 19, 28, 41, 60, MOST_FACES };
    static wheel w;
    for (int i = 0; i < 14; i++)
        for (int shape = 0; shape < SHAPES; shape++)
            for (int vertex = 0; vertex < VERTICES; vertex++) {
                int n = valences[i];
                snprintf(where, sizeof where, "valence %d, shape %d, vertex %d", n, shape, vertex);
                test_context = where;
                build_wheel(&w, shape, vertex, n);
                check_wheel(&w, shape);
            }
}

// ------------------------------------------------------------------------------------ the papers

// So many weights p/q of a point and no others; and of its tangents' sizes.
typedef struct share { int count; double p, q; } share;

static void check_shares(const subdiv_stencils *s, const float *weights, int i,
                         const share *shares, int count)
{
    int total = 0, found = 0;
    for (int j = 0; j < count; j++) {
        int same = 0;
        for (size_t k = s->offsets[i]; k < s->offsets[i + 1]; k++)
            same += fabs(fabs((double)weights[k]) - shares[j].p / shares[j].q) < 1e-7;
        CHECK_EQUAL(same, shares[j].count);
        total += shares[j].count;
        found += same;
    }
    CHECK_EQUAL(found, total);
    CHECK_EQUAL(s->offsets[i + 1] - s->offsets[i], total);
}

#define SHARES(s, w, i, ...) do {                                                       \
        const share list[] = { __VA_ARGS__ };                                           \
        check_shares(s, w, i, list, (int)(sizeof list / sizeof *list));                 \
    } while (0)

static subdiv_stencils stencils_of(const subdiv_mesh *mesh, int levels, int limit)
{
    subdiv_stencils s;
    subdiv_surface *surface;
    subdiv_options opt = {0};
    opt.limit = limit;
    CHECK_EQUAL(subdiv_prepare(&surface, mesh, levels, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refined_stencils(&s, surface, 0, subdiv_surface_vertex_count(surface), &opt),
                SUBDIV_OK);
    subdiv_surface_free(surface);
    return s;
}

static void test_papers(void)
{
    static test_cage c;
    build_torus(&c, SUBDIV_CATMULL_CLARK, 6, 5);
    subdiv_stencils s = stencils_of(&c.mesh, 1, 0);
    SHARES(&s, s.weights, 0, { 1, 9, 16 }, { 4, 3, 32 }, { 4, 1, 64 });
    SHARES(&s, s.weights, 30, { 2, 3, 8 }, { 4, 1, 16 });
    SHARES(&s, s.weights, 90, { 4, 1, 4 });
    subdiv_stencils_free(&s);
    for (int level = 0; level <= 2; level++) {
        s = stencils_of(&c.mesh, level, 1);
        if (level < 2) SHARES(&s, s.weights, 0, { 1, 4, 9 }, { 4, 1, 9 }, { 4, 1, 36 });
        for (int v = 0; v < 30; v++) CHECK_EQUAL(s.offsets[v + 1] - s.offsets[v], 9);
        subdiv_stencils_free(&s);
    }
    s = stencils_of(&c.mesh, 1, 1);
    SHARES(&s, s.du, 0, { 2, 2, 1 }, { 4, 1, 2 }, { 3, 0, 1 });
    subdiv_stencils_free(&s);

    build_torus(&c, SUBDIV_LOOP, 6, 6);
    s = stencils_of(&c.mesh, 1, 0);
    SHARES(&s, s.weights, 0, { 1, 5, 8 }, { 6, 1, 16 });
    SHARES(&s, s.weights, 40, { 2, 3, 8 }, { 2, 1, 8 });
    subdiv_stencils_free(&s);
    s = stencils_of(&c.mesh, 1, 1);
    SHARES(&s, s.weights, 0, { 1, 1, 2 }, { 6, 1, 12 });
    subdiv_stencils_free(&s);

    build_prism(&c, 4);
    cage_crease(&c, 0, 1, 10), cage_crease(&c, 1, 2, 10), cage_corner(&c, 7, 10);
    s = stencils_of(&c.mesh, 1, 0);
    SHARES(&s, s.weights, 1, { 1, 3, 4 }, { 2, 1, 8 });
    SHARES(&s, s.weights, 4, { 1, 5, 12 }, { 3, 1, 6 }, { 3, 1, 36 });
    SHARES(&s, s.weights, 7, { 1, 1, 1 });
    subdiv_stencils_free(&s);
    s = stencils_of(&c.mesh, 1, 1);
    SHARES(&s, s.weights, 1, { 1, 2, 3 }, { 2, 1, 6 });
    subdiv_stencils_free(&s);
}

// --------------------------------------------------------------------------------------- explain

static char text[100000];

static void check_says(const char *words)
{
    if (!strstr(text, words)) TEST_REPORT("\"%s\" is missing in\n%s", words, text);
}

static void explain(const subdiv_mesh *mesh, int point)
{
    CHECK_EQUAL(subdiv_explain(text, sizeof text, mesh, point, NULL), SUBDIV_OK);
}

// What the table of the text makes of the cage's positions.
static void sum_of_table(const float *positions, double *sum)
{
    double total = 0;
    sum[0] = sum[1] = sum[2] = 0;
    for (const char *line = text; *line; line = strchr(line, '\n') + 1) {
        char *end;
        const char *word = strstr(line, "  vert");
        if (strncmp(line, "    ", 4) || !strchr("-0123456789", line[4])) continue;
        if (!word || word > strchr(line, '\n')) continue;
        word += 2;
        double weight = strtod(line, &end);
        if (*end == '/') weight /= strtod(end + 1, NULL);
        for (const char *p = word + strcspn(word, " \n"); ;) {
            long v = strtol(p, &end, 10);           // also from lines that go on
            if (end == p) break;
            if (memchr(p, '\n', (size_t)(end - p)) && strncmp(strchr(p, '\n') + 1, "        ", 8))
                break;
            total += weight;
            for (int k = 0; k < 3; k++) sum[k] += weight * (double)positions[3 * v + k];
            p = end;
        }
    }
    CHECK_NEAR(total, 1, 1e-6);
}

static void check_lines(void)
{
    for (const char *line = text; *line; ) {
        const char *end = strchr(line, '\n');
        CHECK(end != NULL);
        if (!end) return;
        if (end - line > 80) TEST_REPORT("%.*s", (int)(end - line), line);
        CHECK(end == line || end[-1] != ' ');
        line = end + 1;
    }
}

// The words begin with the point, and end with a full stop before each formula, mask and table.
static void check_words(int point)
{
    char start[64];
    snprintf(start, sizeof start, "Point %d of the mesh refined once is the ", point);
    CHECK(strncmp(text, start, strlen(start)) == 0);
    const char *formula = strstr(text, "\n\n    "), *mask = strstr(text, "\n\nIts mask");
    CHECK(formula && (formula[-1] == '.' || formula[-1] == ':'));
    CHECK(mask && mask > formula);
    int parts = 0;                                  // a picture at most, the table, papers
    for (const char *p = mask; p && (p = strstr(p + 1, "\n\n")) != NULL; ) parts++;
    CHECK(parts <= 3);
    check_lines();
}

static void test_explained_masks(void)
{
    for (unsigned seed = 0; seed < 80; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        subdiv_options opt = {0};
        subdiv_mesh fine;
        opt.linear = seed % 9 == 8;
        CHECK_EQUAL(subdiv_refine(&fine, &c->mesh, 1, &opt), SUBDIV_OK);
        for (int i = 0; i < fine.vertex_count; i += 1 + fine.vertex_count / 200) {
            double sum[3];
            say_where("explain", seed, i);
            CHECK_EQUAL(subdiv_explain(text, sizeof text, &c->mesh, i, &opt), SUBDIV_OK);
            check_words(i);
            sum_of_table(c->positions, sum);
            for (int k = 0; k < 3; k++) CHECK_NEAR(sum[k], fine.positions[3 * i + k], 2e-6);
        }
        subdiv_mesh_free(&fine);
        random_cage_free(c);
    }
}

static void test_explained_catmull_clark(void)
{
    static test_cage c;
    build_torus(&c, SUBDIV_CATMULL_CLARK, 6, 5);
    explain(&c.mesh, 7);
    check_says("is the vertex point of vertex 7.\nVertex 7 is interior, of valence 4, and smooth.");
    check_says("\n   1/64 ----- 3/32 ----- 1/64\n     |          |          |\n"
               "   3/32 ----- 9/16 ----- 3/32\n");
    check_says("\n    9/16    vertex 7\n    3/32    vertices 1 6 8 13\n");
    check_says("[CC78] Catmull, Clark: ");
    explain(&c.mesh, 30);
    check_says("Edge 0-1 is smooth, between the faces 0 and 24.");
    check_says("(a + b + f + g) / 4  [CC78]");
    check_says("    3/8 --- E ---- 3/8\n");
    explain(&c.mesh, 90);
    check_says("Face 0 has 4 vertices; its face point is their mean.");
    check_says("\n    1/4     vertices 0 1 6 7\n");

    build_prism(&c, 4);
    cage_crease(&c, 0, 1, 0.25), cage_crease(&c, 1, 2, 0.25);
    cage_crease(&c, 2, 3, 2.5), cage_corner(&c, 7, 3);
    explain(&c.mesh, 1);
    check_says("Vertex 1 is on a crease: it moves along the curve of the edges\n"
               "1-2 and 1-0, a cubic B-spline.\nOn the next level it is smooth.");
    check_says("V = 1/4 C + 3/4 S  [DKT98]\n    C = (a + 6 v + b) / 8  [HDD94]\n"
               "    S = (n-2)/n v + ");
    check_says("\n    1/2     vertex 1\n    5/32    vertices 0 2\n    1/8     vertex ");
    explain(&c.mesh, 3);
    check_says("Vertex 3 is a dart: the crease 3-2 ends there.\nIt moves as if it were smooth.");
    check_says("\n    5/12    vertex 3\n");
    explain(&c.mesh, 7);
    check_says("Vertex 7 is a corner, of sharpness 3.\n");
    explain(&c.mesh, 8);
    check_says("Edge 0-1 is a crease, of sharpness 0.25.\nIt ends before the next level, and so ");
    check_says("E = 1/4 C + 3/4 S  [DKT98]\n    C = (a + b) / 2\n");
    explain(&c.mesh, 10);
    check_says("Edge 2-3 is a crease, of sharpness 2.5.\n");
    check_says("\n    1/2 --- E ---- 1/2\n");
}

static void test_explained_shapes(void)
{
    static test_cage c;
    build_grid(&c, SUBDIV_CATMULL_CLARK, 2, 2);
    c.mesh.boundary = SUBDIV_BOUNDARY_EDGE_AND_CORNER;
    explain(&c.mesh, 0);
    check_says("Vertex 0 is a corner: it has one face, and the rule is \"edge and corner\".\n");
    explain(&c.mesh, 1);
    check_says("Vertex 1 is on the boundary: ");
    check_says("\n    1/8 ------ 3/4 ------ 1/8\n");
    explain(&c.mesh, 9);
    check_says("is on the boundary, which is a crease.");
    c.mesh.scheme = SUBDIV_BILINEAR;
    explain(&c.mesh, 4);
    check_says("Refinement is linear: vertex 4 stays where it is.\n\n    V = v\n\nIts mask");

    build_fins(&c, SUBDIV_CATMULL_CLARK, 3, 2);
    explain(&c.mesh, 1);
    check_says("Vertex 1 is on a crease");
    explain(&c.mesh, 0);
    check_says("Vertex 0 is a corner: the surface is non-manifold there.");
    explain(&c.mesh, c.mesh.vertex_count);
    check_says("Edge 0-1 is non-manifold, and so a crease.");

    build_fan(&c, SUBDIV_CATMULL_CLARK, 5, 1);
    for (int i = 1; i <= 3; i++) cage_crease(&c, 0, i, 10);
    cage_vertex(&c, 9, 9, 9);
    explain(&c.mesh, 0);
    check_says("Vertex 0 is a corner: 3 sharp edges meet there.");
    explain(&c.mesh, c.mesh.vertex_count - 1);
    check_says("has no faces: it stays where it is.");
    explain(&c.mesh, c.mesh.vertex_count);
    check_says("is a crease, sharp forever.");

    build_bipyramid(&c, SUBDIV_CATMULL_CLARK, 5);
    explain(&c.mesh, 7);
    check_says("E = (a + b + f + g) / 4  [CC78]");
    explain(&c.mesh, 22);
    check_says("\n         1/3\n         / \\\n");
    c.mesh.triangles = SUBDIV_TRIANGLES_SMOOTH;
    explain(&c.mesh, 7);
    check_says("E = 3/100 (a + b) + 47/100 (f + g)  [OSD]");
}

static void test_explained_loop(void)
{
    static test_cage c;
    build_torus(&c, SUBDIV_LOOP, 6, 6);
    explain(&c.mesh, 0);
    check_says("b = (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n = 1/16 for n = 6\n");
    check_says("   1/16 ------ 5/8 ----- 1/16\n");
    explain(&c.mesh, 36);
    check_says("E = (3 a + 3 b + c + d) / 8  [Loop87]");
    check_says("\n    3/8     vertices 0 1\n    1/8     vertices ");
    build_tetrahedron(&c, SUBDIV_LOOP);
    explain(&c.mesh, 0);
    check_says("= 3/16 for n = 3\n");
    check_says("\n    7/16    vertex 0\n    3/16    vertices 1 2 3\n");
    for (int n = 5; n <= 24; n++) {                 // most of these weights are no fractions
        build_fan(&c, SUBDIV_LOOP, n, 1);
        explain(&c.mesh, 0);
        const char *table = strstr(text, "Its mask");
        CHECK(table && (strchr(table, '/') != NULL) == (n == 6));
    }
}

// All the pictures: each is followed by a blank line and the table, whose weights are its own.
static void test_explained_pictures(void)
{
    static const struct { int cage, point; const char *mask; } cases[] = {
        { 0, 90, "    1/4 ------ 1/4\n"
                 "     |          |\n"
                 "     |    F     |\n"
                 "     |          |\n"
                 "    1/4 ------ 1/4\n\n"
                 "    1/4     vertices 0 1 6 7\n\n" },
        { 1, 22, "         1/3\n"
                 "         / \\\n"
                 "        / F \\\n"
                 "       /     \\\n"
                 "    1/3 ----- 1/3\n\n"
                 "    1/3     vertices 0 2 3\n\n" },
        { 0, 30, "   1/16 --------- 1/16\n"
                 "     |              |\n"
                 "    3/8 --- E ---- 3/8\n"
                 "     |              |\n"
                 "   1/16 --------- 1/16\n\n"
                 "    3/8     vertices 0 1\n"
                 "    1/16    vertices 6 7 24 25\n\n" },
        { 2, 36, "           1/8\n"
                 "        /      \\\n"
                 "       /        \\\n"
                 "    3/8 --- E ---- 3/8\n"
                 "       \\        /\n"
                 "        \\      /\n"
                 "           1/8\n\n"
                 "    3/8     vertices 0 1\n"
                 "    1/8     vertices 7 30\n\n" },
        { 3, 1,  "    1/8 ------ 3/4 ------ 1/8\n\n"
                 "    3/4     vertex 1\n"
                 "    1/8     vertices 0 2\n\n" },
        { 3, 9,  "    1/2 --- E ---- 1/2\n\n"
                 "    1/2     vertices 0 1\n" },
        { 0, 7,  "   1/64 ----- 3/32 ----- 1/64\n"
                 "     |          |          |\n"
                 "   3/32 ----- 9/16 ----- 3/32\n"
                 "     |          |          |\n"
                 "   1/64 ----- 3/32 ----- 1/64\n\n"
                 "    9/16    vertex 7\n"
                 "    3/32    vertices 1 6 8 13\n"
                 "    1/64    vertices 0 2 12 14\n\n" },
        { 2, 0,  "        1/16 ----- 1/16\n"
                 "        /    \\     /    \\\n"
                 "   1/16 ------ 5/8 ----- 1/16\n"
                 "        \\    /     \\    /\n"
                 "        1/16 ----- 1/16\n\n"
                 "    5/8     vertex 0\n"
                 "    1/16    vertices 1 5 6 7 30 35\n\n" },
        { 4, 4,  "    1       vertex 4\n" }
    };
    static test_cage c[5];
    build_torus(&c[0], SUBDIV_CATMULL_CLARK, 6, 5);
    build_bipyramid(&c[1], SUBDIV_CATMULL_CLARK, 5);
    build_torus(&c[2], SUBDIV_LOOP, 6, 6);
    build_grid(&c[3], SUBDIV_CATMULL_CLARK, 2, 2);
    build_grid(&c[4], SUBDIV_BILINEAR, 2, 2);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        explain(&c[cases[i].cage].mesh, cases[i].point);
        const char *mask = strstr(text, "add up to 1.\n\n");
        if (!mask || strncmp(mask + 14, cases[i].mask, strlen(cases[i].mask)) != 0)
            TEST_REPORT("\"%s\" is not in\n%s", cases[i].mask, text);
    }
}

static void sum_of(const subdiv_stencils *s, int i, const float *positions, double *sum)
{
    sum[0] = sum[1] = sum[2] = 0;
    for (size_t k = s->offsets[i]; k < s->offsets[i + 1]; k++)
        for (int j = 0; j < 3; j++)
            sum[j] += (double)s->weights[k] * (double)positions[3 * s->indices[k] + j];
}

// The weight of a vertex in a mask.
static double weight_in(const subdiv_stencils *masks, int i, int vertex)
{
    double sum = 0;
    for (size_t k = masks->offsets[i]; k < masks->offsets[i + 1]; k++)
        if (masks->indices[k] == vertex) sum += (double)masks->weights[k];
    return sum;
}

// Where a single sharp rule holds, it says what the mask is: by the vertices that the data name.
static void check_rule(const subdiv_explanation *e, int i)
{
    const subdiv_point *p = &e->points[i];
    const int *ends = p->ends, rule = p->weight < 1 ? -1 : (int)p->rule;
    CHECK(p->weight >= 0 && p->weight <= 1);
    if (p->kind == SUBDIV_EDGE_POINT && rule == SUBDIV_CREASE)
        for (int k = 0; k < 2; k++)
            CHECK_NEAR(weight_in(&e->masks, i, ends[k]), ends[0] == ends[1] ? 1 : 0.5, 1e-6);
    if (p->kind != SUBDIV_VERTEX_POINT) return;
    if (rule == SUBDIV_CORNER) CHECK_NEAR(weight_in(&e->masks, i, p->parent), 1, 1e-6);
    if (rule != SUBDIV_CREASE || ends[0] == ends[1]) return;
    if (ends[0] == p->parent || ends[1] == p->parent) return;
    CHECK_NEAR(weight_in(&e->masks, i, p->parent), 0.75, 1e-6);
    for (int k = 0; k < 2; k++) CHECK_NEAR(weight_in(&e->masks, i, ends[k]), 0.125, 1e-6);
}

// The text names the vertex, edge or face of the data, and weighs the cage's vertices as they do.
static void check_same_as_text(const subdiv_explanation *e, int i, const float *positions)
{
    const subdiv_point *p = &e->points[i];
    double sum[3], told[3];
    char words[80];
    if (p->kind == SUBDIV_VERTEX_POINT) sprintf(words, "vertex point of vertex %d.", p->parent);
    if (p->kind == SUBDIV_EDGE_POINT)
        sprintf(words, "edge point of edge %d-%d.", p->ends[0], p->ends[1]);
    if (p->kind == SUBDIV_FACE_POINT) sprintf(words, "face point of face %d.", p->parent);
    check_says(words);
    sum_of_table(positions, told);
    sum_of(&e->masks, i, positions, sum);
    for (int k = 0; k < 3; k++) CHECK_NEAR(told[k], sum[k], 2e-6);
}

// The masks of all points, applied to the cage, make the points of the mesh refined once: also of a
// mesh that was refined before.
static void check_points(const subdiv_mesh *cage, const subdiv_options *opt)
{
    subdiv_explanation e;
    subdiv_mesh fine;
    int counts[3] = { 0, 0, 0 };
    CHECK_EQUAL(subdiv_refine(&fine, cage, 1, opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_explain_points(&e, cage, opt), SUBDIV_OK);
    CHECK_EQUAL(e.count, fine.vertex_count);
    CHECK_EQUAL(e.masks.count, fine.vertex_count);
    for (int i = 0; i < e.count; i++) {
        const subdiv_point *p = &e.points[i];
        double sum[3];
        CHECK_EQUAL(p->parent, counts[p->kind]++);
        sum_of(&e.masks, i, cage->positions, sum);
        for (int k = 0; k < 3; k++) CHECK_NEAR(sum[k], fine.positions[3 * i + k], 2e-6);
        check_rule(&e, i);
        if (i % (1 + e.count / 50)) continue;
        CHECK_EQUAL(subdiv_explain(text, sizeof text, cage, i, opt), SUBDIV_OK);
        check_same_as_text(&e, i, cage->positions);
    }
    CHECK_EQUAL(counts[0], cage->vertex_count);
    CHECK_EQUAL(counts[2], cage->scheme == SUBDIV_LOOP ? 0 : cage->face_count);
    subdiv_explanation_free(&e);
    CHECK(!e.points && !e.masks.weights);
    subdiv_mesh_free(&fine);
}

static void test_explained_points(void)
{
    for (unsigned seed = 0; seed < 80; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        subdiv_options opt = {0};
        subdiv_mesh finer;
        say_where("explain", seed, 0);
        opt.linear = seed % 9 == 8;
        check_points(&c->mesh, &opt);
        opt.keep_holes = 1;
        CHECK_EQUAL(subdiv_refine(&finer, &c->mesh, 1, &opt), SUBDIV_OK);
        if (finer.face_count < 200) check_points(&finer, &opt);
        subdiv_mesh_free(&finer);
        random_cage_free(c);
    }
}

// How a crease that ends, the boundary and a single face look as data.
static void test_explained_data(void)
{
    static test_cage c;
    subdiv_explanation e;
    subdiv_options opt = {0};
    build_prism(&c, 4);
    cage_crease(&c, 0, 1, 0.25), cage_crease(&c, 1, 2, 0.25), cage_corner(&c, 7, 3);
    opt.limit = 1;                                  // masks are those of refinement all the same
    CHECK_EQUAL(subdiv_explain_points(&e, &c.mesh, &opt), SUBDIV_OK);
    const subdiv_point *p = &e.points[1];
    CHECK(p->rule == SUBDIV_CREASE && p->next == SUBDIV_SMOOTH && p->reason == SUBDIV_SHARP_EDGES);
    CHECK(p->ends[0] + p->ends[1] == 2 && p->sharp_edges == 2 && p->valence == 3);
    CHECK_NEAR(p->weight, 0.25, 0);
    CHECK_NEAR(weight_in(&e.masks, 1, 1), 0.5, 1e-6);
    p = &e.points[7];
    CHECK(p->rule == SUBDIV_CORNER && p->next == SUBDIV_CORNER && p->sharpness == 3);
    CHECK_EQUAL(p->reason, SUBDIV_OWN_SHARPNESS);
    p = &e.points[8];
    CHECK(p->kind == SUBDIV_EDGE_POINT && p->ends[0] == 0 && p->ends[1] == 1 && p->valence == 2);
    CHECK(p->rule == SUBDIV_CREASE && p->next == SUBDIV_SMOOTH && p->weight == 0.25);
    CHECK(p->faces[0] >= 0 && p->faces[1] > p->faces[0]);
    subdiv_explanation_free(&e);

    build_grid(&c, SUBDIV_CATMULL_CLARK, 2, 2);
    c.mesh.boundary = SUBDIV_BOUNDARY_EDGE_AND_CORNER;
    CHECK_EQUAL(subdiv_explain_points(&e, &c.mesh, NULL), SUBDIV_OK);
    CHECK(e.points[0].reason == SUBDIV_SINGLE_FACE && e.points[0].rule == SUBDIV_CORNER);
    CHECK(e.points[1].reason == SUBDIV_BOUNDARY && e.points[1].rule == SUBDIV_CREASE);
    CHECK(e.points[4].reason == SUBDIV_NOTHING_SHARP && e.points[4].valence == 4);
    CHECK(e.points[9].reason == SUBDIV_BOUNDARY && e.points[9].faces[1] == -1);
    CHECK(e.points[e.count - 1].kind == SUBDIV_FACE_POINT && e.points[e.count - 1].valence == 4);
    subdiv_explanation_free(&e);
}

// Wherever the text is cut off, nothing is written beyond its room. All points of a single quad
// have a picture.
static void test_explained_room(void)
{
    static test_cage c;
    build_grid(&c, SUBDIV_CATMULL_CLARK, 1, 1);
    for (int point = 0; point < 9; point++) {
        explain(&c.mesh, point);
        const size_t size = strlen(text);
        for (size_t room = 1; room <= size; room++) {
            memset(text, '#', size + 64);
            CHECK_EQUAL(subdiv_explain(text, room, &c.mesh, point, NULL), SUBDIV_ERROR_TOO_LARGE);
            CHECK_EQUAL(strlen(text), 0);
            for (size_t k = room; k < size + 64; k++) CHECK(text[k] == '#');
        }
        CHECK_EQUAL(subdiv_explain(text, size + 1, &c.mesh, point, NULL), SUBDIV_OK);
        CHECK_EQUAL(strlen(text), size);
    }
}

// ---------------------------------------------------------------------------------------- errors

static int is_zero(const subdiv_stencils *s)
{
    subdiv_stencils zero;
    memset(&zero, 0, sizeof zero);
    return memcmp(s, &zero, sizeof zero) == 0;
}

static void test_errors(void)
{
    static test_cage c;
    subdiv_surface *surface;
    subdiv_stencils s;
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    build_prism(&c, 4);
    CHECK_EQUAL(subdiv_prepare(&surface, &c.mesh, 1, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refined_stencils(NULL, surface, 0, 1, &opt), SUBDIV_ERROR_ARGUMENT);
    memset(&s, 0x55, sizeof s);
    CHECK_EQUAL(subdiv_refined_stencils(&s, NULL, 0, 1, &opt), SUBDIV_ERROR_ARGUMENT);
    CHECK(is_zero(&s));
    const int bad[4][2] = { { -1, 1 }, { 0, 27 }, { 26, 1 }, { 3, -1 } };
    for (int i = 0; i < 4; i++) {
        memset(&s, 0x55, sizeof s);
        CHECK_EQUAL(subdiv_refined_stencils(&s, surface, bad[i][0], bad[i][1], &opt),
                    SUBDIV_ERROR_INDEX);
        CHECK_TEXT(error.message, "the result has 26 points");
        CHECK(is_zero(&s));
    }
    subdiv_location at = { 0, 0, 0.5f, 0.5f };
    memset(&s, 0x55, sizeof s);
    CHECK_EQUAL(subdiv_stencils_at(&s, surface, 1, &at, &opt), SUBDIV_ERROR_ARGUMENT);
    CHECK(strstr(error.message, "SUBDIV_EXACT") != NULL);
    CHECK(is_zero(&s));
    CHECK_EQUAL(subdiv_refined_stencils(&s, surface, 26, 0, &opt), SUBDIV_OK);
    CHECK_EQUAL(s.count, 0);
    subdiv_stencils_free(&s);
    subdiv_stencils_free(&s);
    subdiv_stencils_free(NULL);
    subdiv_surface_free(surface);

    CHECK_EQUAL(subdiv_prepare(&surface, &c.mesh, SUBDIV_EXACT, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refined_stencils(&s, surface, 0, 1, &opt), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_stencils_at(NULL, surface, 1, &at, &opt), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_stencils_at(&s, NULL, 1, &at, &opt), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_stencils_at(&s, surface, 1, NULL, &opt), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_stencils_at(&s, surface, -1, &at, &opt), SUBDIV_ERROR_ARGUMENT);
    at.face = 6;
    CHECK_EQUAL(subdiv_stencils_at(&s, surface, 1, &at, &opt), SUBDIV_ERROR_INDEX);
    CHECK(is_zero(&s));
    CHECK_EQUAL(subdiv_stencils_at(&s, surface, 0, NULL, &opt), SUBDIV_OK);
    CHECK_EQUAL(s.count, 0);
    subdiv_stencils_free(&s);
    subdiv_surface_free(surface);

    CHECK_EQUAL(subdiv_explain(NULL, 9, &c.mesh, 0, &opt), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_explain(text, 0, &c.mesh, 0, &opt), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_explain(text, sizeof text, NULL, 0, &opt), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_explain(text, sizeof text, &c.mesh, -1, &opt), SUBDIV_ERROR_INDEX);
    CHECK_EQUAL(subdiv_explain(text, sizeof text, &c.mesh, 26, &opt), SUBDIV_ERROR_INDEX);
    CHECK_TEXT(text, "");
    CHECK_TEXT(error.message, "refined once, the mesh has no point 26, but 0 to 7 of vertices, "
                              "8 to 19 of edges, 20 to 25 of faces");
    CHECK_EQUAL(subdiv_explain(text, 100, &c.mesh, 0, &opt), SUBDIV_ERROR_TOO_LARGE);
    CHECK_TEXT(text, "");
    subdiv_explanation e;
    c.mesh.scheme = SUBDIV_LOOP;
    CHECK_EQUAL(subdiv_explain(text, sizeof text, &c.mesh, 0, &opt), SUBDIV_ERROR_NOT_TRIANGLE);
    CHECK_EQUAL(subdiv_explain_points(&e, &c.mesh, &opt), SUBDIV_ERROR_NOT_TRIANGLE);
    CHECK(e.count == 0 && !e.points && !e.masks.weights && !e.memory);
    opt.triangulate = 1;
    CHECK_EQUAL(subdiv_explain(text, sizeof text, &c.mesh, 26, &opt), SUBDIV_ERROR_INDEX);
    CHECK_EQUAL(subdiv_explain(text, sizeof text, &c.mesh, 25, &opt), SUBDIV_OK);
}

int main(void)
{
    RUN(test_explained_catmull_clark);
    RUN(test_explained_shapes);
    RUN(test_explained_loop);
    RUN(test_explained_pictures);
    RUN(test_explained_data);
    RUN(test_explained_room);
    RUN(test_random_cages);
    RUN(test_face_varying);
    RUN(test_limits);
    RUN(test_parts);
    RUN(test_anywhere);
    RUN(test_deep_levels);
    RUN(test_rounding);
    RUN(test_tangent_sizes);
    RUN(test_valences);
    RUN(test_papers);
    RUN(test_explained_points);
    RUN(test_explained_masks);
    RUN(test_errors);
    return test_end("stencils");
}
