// Curves: the same bits as boundaries and creases of surfaces, the closed forms of their splines,
// and the ways to call them.
//
//     cc -I. tests/test_curves.c -o build/test_curves -lm && build/test_curves

#include <limits.h>
#include <stdlib.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/test.h"

enum { MOST = 4096 };

static const char *const rule_names[] = { "B-spline", "Chaikin" };
static const char *const end_names[] = { "kept", "cut", "closed" };

static float numbers(unsigned *seed)
{
    *seed = *seed * 1664525 + 1013904223;
    return (float)(*seed >> 8) / (1 << 23) - 1;
}

// Runs a check for every kind of curve.
static void for_all(void (*check)(subdiv_curve_rule, subdiv_curve_ends))
{
    char name[32];
    for (int rule = 0; rule < 2; rule++)
        for (int ends = 0; ends < 3; ends++) {
            snprintf(name, sizeof name, "%s, %s", rule_names[rule], end_names[ends]);
            test_context = name;
            check((subdiv_curve_rule)rule, (subdiv_curve_ends)ends);
        }
}

// ------------------------------------------------------------------- as on the edges of surfaces

enum { CHANNELS = 5, SIDE = 5 };        // a grid of SIDE x SIDE faces or twice as many triangles

// Compares a curve with the points of a refined surface on a way of n edges from vertex to vertex.
static void check_on_surface(const test_cage *cage, const float *values, const int *way, int n,
                             subdiv_curve_ends ends, int levels, int limit)
{
    subdiv_options opt = {0};
    opt.limit = limit;
    subdiv_surface *surface;
    order o;
    static float in[CHANNELS * MOST], out[(CHANNELS + 1) * MOST];
    int points = ends == SUBDIV_ENDS_CLOSED ? n : n + 1, different = 0;
    for (int i = 0; i < points; i++)
        memcpy(in + CHANNELS * i, values + CHANNELS * way[i], CHANNELS * sizeof *in);
    CHECK_EQUAL(subdiv_curve(SUBDIV_CURVE_B_SPLINE, ends, levels, CHANNELS, points, in, 0, out,
                             CHANNELS + 1, &opt), SUBDIV_OK);
    if (subdiv_prepare(&surface, &cage->mesh, levels, &opt) ||
        !order_make(&o, &cage->mesh, levels, NULL)) abort();
    size_t count = (size_t)subdiv_surface_vertex_count(surface);
    float *fine = (float *)malloc(CHANNELS * count * sizeof *fine);
    if (!fine || subdiv_evaluate(surface, CHANNELS, values, 0, fine, 0, NULL, &opt)) abort();
    int *edges = (int *)malloc(2 * sizeof(int) * (size_t)subdiv_surface_edge_count(surface));
    if (!edges) abort();
    subdiv_surface_edges(surface, edges);
    for (int i = 0; i < n; i++) {
        int a = way[i], b = way[(i + 1) % points], e = 0, low = a < b ? a : b;
        while (edges[2 * e] != low || edges[2 * e + 1] != a + b - low) e++;
        for (int t = 0; t < o.n; t++) {
            int on_edge = a < b ? t : o.n - t;
            int point = t ? cage->mesh.vertex_count + e * (o.n - 1) + on_edge - 1 : a;
            different += memcmp(out + (CHANNELS + 1) * (i * o.n + t), fine + CHANNELS * point,
                                CHANNELS * sizeof *fine) != 0;
        }
    }
    CHECK_EQUAL(different, 0);
    free(edges);
    free(fine);
    order_free(&o);
    subdiv_surface_free(surface);
}

// The boundary runs as its faces do. A crease runs as the first face at each of its edges does:
// from the last column to the first, above row 1 of the grid.
static void check_surface(subdiv_scheme scheme)
{
    static test_cage cage;
    static float values[CHANNELS * CAGE_VERTICES];
    unsigned seed = 1;
    int boundary[4 * SIDE], crease[SIDE + 1], row = SIDE + 1;
    build_grid(&cage, scheme, SIDE, SIDE);
    for (int i = 0; i < CHANNELS * cage.mesh.vertex_count; i++) values[i] = numbers(&seed);
    for (int i = 0; i < SIDE; i++) {
        boundary[i] = i;
        boundary[SIDE + i] = i * row + SIDE;
        boundary[2 * SIDE + i] = SIDE * row + SIDE - i;
        boundary[3 * SIDE + i] = (SIDE - i) * row;
    }
    for (int i = 0; i <= SIDE; i++) crease[i] = 2 * row + SIDE - i;
    for (int i = 0; i < SIDE; i++)
        cage_crease(&cage, crease[i], crease[i + 1], (double)SUBDIV_INFINITE);
    for (int k = 0; k < 10; k++) {
        int levels = k / 2 + 1, limit = k % 2;
        check_on_surface(&cage, values, crease, SIDE, SUBDIV_ENDS_KEPT, levels, limit);
        cage.mesh.crease_count = 0;
        check_on_surface(&cage, values, boundary, 4 * SIDE, SUBDIV_ENDS_CLOSED, levels, limit);
        cage.mesh.crease_count = SIDE;
    }
}

static void curve_is_boundary_and_crease_of_quads(void)
{
    check_surface(SUBDIV_CATMULL_CLARK);
}

static void curve_is_boundary_and_crease_of_triangles(void)
{
    check_surface(SUBDIV_LOOP);
}

// --------------------------------------------------------------------------------------- splines

// The spline of n points at t, where point i has the middle of its influence at i.
static double spline(subdiv_curve_rule rule, subdiv_curve_ends ends, const float *p, int n,
                     double t)
{
    int middle = (int)floor(rule == SUBDIV_CURVE_CHAIKIN ? t + 0.5 : t);
    double u = t - middle, q[4], c = 0.5 - u, d = 0.5 + u, v = 1 - u;
    for (int k = 0; k < 4; k++) {
        int i = middle - 1 + k, inside = i < 0 ? 0 : i > n - 1 ? n - 1 : i;
        q[k] = (double)p[ends == SUBDIV_ENDS_CLOSED ? (i + n) % n : inside];
        if (ends == SUBDIV_ENDS_KEPT && rule == SUBDIV_CURVE_B_SPLINE && i != inside)
            q[k] = 2 * q[k] - (double)p[i < 0 ? 1 : n - 2];     // straight on
    }
    if (rule == SUBDIV_CURVE_CHAIKIN)
        return q[0] * c * c / 2 + q[1] * (0.75 - u * u) + q[2] * d * d / 2;
    return (q[0] * v * v * v + q[1] * (3 * u * u * u - 6 * u * u + 4) +
            q[2] * (3 * v * v * v - 6 * v * v + 4) + q[3] * u * u * u) / 6;
}

static void check_spline(subdiv_curve_rule rule, subdiv_curve_ends ends)
{
    unsigned seed = 2;
    float in[9], out[MOST];
    subdiv_options opt = {0};
    opt.limit = 1;
    for (int n = 4; n <= 9; n++)
        for (int levels = 0; levels < 7; levels++) {
            for (int i = 0; i < n; i++) in[i] = numbers(&seed);
            int count = subdiv_curve_point_count(rule, ends, n, levels), half = 1 << levels;
            int cut = ends == SUBDIV_ENDS_CUT ? half - 1 : 0, open = ends != SUBDIV_ENDS_CLOSED;
            CHECK_EQUAL(subdiv_curve(rule, ends, levels, 1, n, in, 0, out, 0, &opt), SUBDIV_OK);
            for (int i = open; i < count - open; i++) {
                double at = rule == SUBDIV_CURVE_CHAIKIN ? (i + cut + 0.5) / half - 0.5
                                                         : (double)(i + cut) / half;
                CHECK_NEAR(out[i], spline(rule, ends, in, n, at), 2e-6);
            }
            if (ends != SUBDIV_ENDS_KEPT) continue;
            CHECK(out[0] == in[0]);
            CHECK(out[count - 1] == in[n - 1]);
        }
}

static void limits_are_splines(void)
{
    for_all(check_spline);
}

// -------------------------------------------------------------------------------------- by hand

static void check_numbers(subdiv_curve_rule rule, subdiv_curve_ends ends, int limit, int levels,
                          int count, const double *expected)
{
    const float in[] = { 0, 8, 0 };
    float out[16];
    subdiv_options opt = {0};
    opt.limit = limit;
    CHECK_EQUAL(subdiv_curve_point_count(rule, ends, 3, levels), count);
    CHECK_EQUAL(subdiv_curve(rule, ends, levels, 1, 3, in, 0, out, 0, &opt), SUBDIV_OK);
    for (int i = 0; i < count; i++) CHECK_NEAR(out[i], expected[i], 1e-6);
}

static void small_curves(void)
{
    const subdiv_curve_rule spline3 = SUBDIV_CURVE_B_SPLINE, chaikin = SUBDIV_CURVE_CHAIKIN;
    const subdiv_curve_ends kept = SUBDIV_ENDS_KEPT, cut = SUBDIV_ENDS_CUT;
    const subdiv_curve_ends closed = SUBDIV_ENDS_CLOSED;
    const double a[] = { 0, 4, 6, 4, 0 }, b[] = { 4, 6, 4 }, c[] = { 1, 4, 6, 4, 1, 0 };
    const double d[] = { 0, 2, 6, 6, 2, 0 }, e[] = { 2, 6, 6, 2 }, f[] = { 0, 2, 6, 6, 2, 0 };
    const double g[] = { 0, 16.0 / 3, 0 }, h[] = { 0, 6, 0 }, i[] = { 1, 6, 1 };
    check_numbers(spline3, kept, 0, 1, 5, a);
    check_numbers(spline3, cut, 0, 1, 3, b);
    check_numbers(spline3, closed, 0, 1, 6, c);
    check_numbers(chaikin, kept, 0, 1, 6, d);
    check_numbers(chaikin, cut, 0, 1, 4, e);
    check_numbers(chaikin, closed, 0, 1, 6, f);
    check_numbers(spline3, kept, 1, 0, 3, g);
    check_numbers(spline3, cut, 1, 0, 3, g);
    check_numbers(chaikin, kept, 1, 0, 3, h);
    check_numbers(chaikin, closed, 1, 0, 3, i);
}

// ---------------------------------------------------------------------------- what holds for all

static void check_invariants(subdiv_curve_rule rule, subdiv_curve_ends ends)
{
    enum { POINTS = 6, LEVELS = 3, STRIDE = 5 };
    subdiv_options limit = { 0 };
    const subdiv_options *ways[] = { NULL, &limit };
    static float in[2 * MOST], moved[2 * MOST], room[STRIDE * MOST], other[2 * MOST];
    static float twice[2 * MOST], *out = room + STRIDE;
    unsigned seed = 3;
    for (int i = 0; i < 2 * POINTS; i++) in[i] = numbers(&seed);
    for (int i = 0; i < 2 * POINTS; i += 2) {           // turned and moved
        moved[i] = 0.6f * in[i] - 0.8f * in[i + 1] + 3;
        moved[i + 1] = 0.8f * in[i] + 0.6f * in[i + 1] - 2;
    }
    for (int w = 0; w < 2; w++) {
        int count = subdiv_curve_point_count(rule, ends, POINTS, LEVELS);
        for (int i = 0; i < STRIDE * MOST; i++) room[i] = 7;
        subdiv_curve(rule, ends, LEVELS, 2, POINTS, in, 0, out, STRIDE, ways[w]);
        for (int i = 0; i < STRIDE * MOST; i++)         // only these floats are written,
            if (i < STRIDE || i >= STRIDE * (count + 1) || i % STRIDE > 1) CHECK(room[i] == 7);

        int first = subdiv_curve_point_count(rule, ends, POINTS, 1), different = 0;
        subdiv_curve(rule, ends, 1, 2, POINTS, in, 2, twice, 2, NULL);
        subdiv_curve(rule, ends, LEVELS - 1, 2, first, twice, 2, twice, 2, ways[w]);
        for (int i = 0; i < 2 * count; i++)             // the same in two calls, and in place,
            different += memcmp(&twice[i], &out[STRIDE * (i / 2) + i % 2], sizeof *out) != 0;
        CHECK_EQUAL(different, 0);
        CHECK_EQUAL(subdiv_curve_point_count(rule, ends, first, LEVELS - 1), count);

        subdiv_curve(rule, ends, LEVELS, 2, POINTS, moved, 0, other, 0, ways[w]);
        for (int i = 0; i < count; i++) {               // and the moved curve of moved points
            float x = out[STRIDE * i], y = out[STRIDE * i + 1];
            CHECK_NEAR(other[2 * i], 0.6f * x - 0.8f * y + 3, 2e-6);
            CHECK_NEAR(other[2 * i + 1], 0.8f * x + 0.6f * y - 2, 2e-6);
        }
    }
}

static void invariants(void)
{
    for_all(check_invariants);
}

// The mirrored curve is that of the points backwards.
static void check_backwards(subdiv_curve_rule rule, subdiv_curve_ends ends)
{
    enum { POINTS = 7 };
    float in[POINTS], back[POINTS], out[MOST], mirrored[MOST];
    unsigned seed = 4;
    for (int i = 0; i < POINTS; i++) in[i] = back[POINTS - 1 - i] = numbers(&seed);
    int count = subdiv_curve_point_count(rule, ends, POINTS, 4);
    subdiv_curve(rule, ends, 4, 1, POINTS, in, 0, out, 0, NULL);
    subdiv_curve(rule, ends, 4, 1, POINTS, back, 0, mirrored, 0, NULL);
    // A closed B-spline begins with a vertex point, and ends with that of the edge before it.
    int shifted = ends == SUBDIV_ENDS_CLOSED && rule == SUBDIV_CURVE_B_SPLINE;
    int end = shifted ? 2 * count - 16 : count - 1;
    for (int i = 0; i < count; i++)
        CHECK_NEAR(out[i], mirrored[(end - i + count) % count], 1e-6);
}

static void backwards(void)
{
    for_all(check_backwards);
}

// Every point of one, open or closed, is this point.
static void single_point(void)
{
    for (int k = 0; k < 8; k++) {
        const float in[] = { 3 };
        float out[16];
        subdiv_options opt = {0};
        subdiv_curve_rule rule = (subdiv_curve_rule)(k % 2);
        subdiv_curve_ends ends = k / 2 % 2 ? SUBDIV_ENDS_CLOSED : SUBDIV_ENDS_KEPT;
        opt.limit = k / 4;
        int count = subdiv_curve_point_count(rule, ends, 1, 3);
        CHECK_EQUAL(count, rule == SUBDIV_CURVE_B_SPLINE && ends == SUBDIV_ENDS_KEPT ? 1 : 8);
        CHECK_EQUAL(subdiv_curve(rule, ends, 3, 1, 1, in, 0, out, 0, &opt), SUBDIV_OK);
        for (int i = 0; i < count; i++) CHECK(out[i] == 3);
    }
}

// Level 0 has the lines of its cage, other levels have none.
static void lines_of_meshes(void)
{
    static test_cage cage;
    int sizes[] = { 3, 2 }, vertices[] = { 0, 1, 2, 2, 3 };
    build_grid(&cage, SUBDIV_CATMULL_CLARK, 1, 1);
    cage.mesh.line_count = 2;
    cage.mesh.line_sizes = sizes;
    cage.mesh.line_vertices = vertices;
    for (int k = 0; k < 4; k++) {
        subdiv_mesh fine;
        subdiv_options opt = {0};
        opt.limit = k / 2;
        CHECK_EQUAL(subdiv_refine(&fine, &cage.mesh, k % 2, &opt), SUBDIV_OK);
        CHECK_EQUAL(fine.line_count, k % 2 ? 0 : 2);
        CHECK(k % 2 || memcmp(fine.line_sizes, sizes, sizeof sizes) == 0);
        CHECK(k % 2 || memcmp(fine.line_vertices, vertices, sizeof vertices) == 0);
        CHECK(fine.line_sizes != sizes && fine.line_vertices != vertices);
        subdiv_mesh_free(&fine);
    }
}

// ---------------------------------------------------------------------------------------- errors

static void errors(void)
{
    const struct {
        int rule, ends, levels, channels, points, in, stride, out;
        subdiv_result result;
        const char *message;
    } calls[] = {
        { 0, 0, 1, 2, 3, 1, 0, 0, SUBDIV_ERROR_ARGUMENT, "an argument is NULL" },
        { 0, 0, 1, 2, 3, 0, 0, 1, SUBDIV_ERROR_ARGUMENT, "an argument is NULL" },
        { 0, 0, 1, 0, 3, 1, 0, 1, SUBDIV_ERROR_ARGUMENT, "channels is 0" },
        { 0, 0, 1, 2, 3, 1, 1, 1, SUBDIV_ERROR_ARGUMENT,
          "a stride of 1 floats is less than 2 channels" },
        { 2, 0, 1, 2, 3, 1, 0, 1, SUBDIV_ERROR_ARGUMENT,
          "no curve has rule 2, ends 0 and 3 points on level 1" },
        { -1, 0, 1, 2, 3, 1, 0, 1, SUBDIV_ERROR_ARGUMENT,
          "no curve has rule -1, ends 0 and 3 points on level 1" },
        { 0, 3, 1, 2, 3, 1, 0, 1, SUBDIV_ERROR_ARGUMENT,
          "no curve has rule 0, ends 3 and 3 points on level 1" },
        { 1, 1, 1, 2, 2, 1, 0, 1, SUBDIV_ERROR_ARGUMENT,
          "no curve has rule 1, ends 1 and 2 points on level 1" },
        { 0, 0, -1, 2, 3, 1, 0, 1, SUBDIV_ERROR_ARGUMENT,
          "no curve has rule 0, ends 0 and 3 points on level -1" },
        { 0, 0, 1, 2, -3, 1, 0, 1, SUBDIV_ERROR_ARGUMENT,
          "no curve has rule 0, ends 0 and -3 points on level 1" },
        { 0, 1, 1, 2, 0, 1, 0, 1, SUBDIV_ERROR_EMPTY, "the curve has no points" },
        { 0, 2, 30, 2, 2, 1, 0, 1, SUBDIV_ERROR_TOO_LARGE, "30 levels are too many of 2 points" },
        { 0, 1, 31, 2, 3, 1, 0, 1, SUBDIV_ERROR_TOO_LARGE, "31 levels are too many of 3 points" }
    };
    float in[8] = { 0 }, out[16];
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++) {
        subdiv_curve_rule rule = (subdiv_curve_rule)calls[i].rule;
        subdiv_curve_ends ends = (subdiv_curve_ends)calls[i].ends;
        for (int k = 0; k < 16; k++) out[k] = 7;
        CHECK_EQUAL(subdiv_curve(rule, ends, calls[i].levels, calls[i].channels, calls[i].points,
                                 calls[i].in ? in : NULL, calls[i].stride,
                                 calls[i].out ? out : NULL, 0, &opt), calls[i].result);
        CHECK_TEXT(error.message, calls[i].message);
        CHECK_EQUAL(error.code, calls[i].result);
        for (int k = 0; k < 16; k++) CHECK(out[k] == 7);
        if (i < 4) continue;
        CHECK_EQUAL(subdiv_curve_point_count(rule, ends, calls[i].points, calls[i].levels), 0);
    }
}

static void counts(void)
{
    const subdiv_curve_rule spline3 = SUBDIV_CURVE_B_SPLINE, chaikin = SUBDIV_CURVE_CHAIKIN;
    const subdiv_curve_ends kept = SUBDIV_ENDS_KEPT, closed = SUBDIV_ENDS_CLOSED;
    CHECK_EQUAL(subdiv_curve_point_count(chaikin, closed, INT_MAX / 2, 1), INT_MAX - 1);
    CHECK_EQUAL(subdiv_curve_point_count(chaikin, kept, INT_MAX / 2 + 1, 1), 0);
    CHECK_EQUAL(subdiv_curve_point_count(spline3, kept, INT_MAX / 2 + 1, 1), INT_MAX);
    CHECK_EQUAL(subdiv_curve_point_count(spline3, kept, 2, 30), (1 << 30) + 1);
    CHECK_EQUAL(subdiv_curve_point_count(spline3, kept, 3, 30), 0);
    CHECK_EQUAL(subdiv_curve_point_count(spline3, SUBDIV_ENDS_CUT, 3, 30), 3);
}

int main(void)
{
    RUN(curve_is_boundary_and_crease_of_quads);
    RUN(curve_is_boundary_and_crease_of_triangles);
    RUN(limits_are_splines);
    RUN(small_curves);
    RUN(invariants);
    RUN(backwards);
    RUN(single_point);
    RUN(lines_of_meshes);
    RUN(errors);
    RUN(counts);
    return test_end("curves");
}
