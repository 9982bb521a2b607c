// Evaluation anywhere on the limit surface against exact_oracle.h, which refines around the place
// in doubles: random cages with every feature, all valences; whether faces meet smoothly;
// derivatives against differences.
//
//     cc -I. tests/test_exact_oracle.c -o build/test_exact_oracle -lm -pthread &&
//     build/test_exact_oracle
#include <stdio.h>
#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/exact_oracle.h"
#include "lib/random_cage.h"
#include "lib/test.h"

enum { FEATURES = RANDOM_ALL, PLACES = 16, MOST_PLACES = 512 };

static const double position_tolerance = 1e-6;    // of the extent of the cage
static const double derivative_tolerance = 1e-4;  // of the larger of the two

static char context[96];

typedef struct vec { double x[3]; } vec;

static vec of_floats(const float *p)
{
    vec v = { { (double)p[0], (double)p[1], (double)p[2] } };
    return v;
}

static vec of_doubles(const double *p)
{
    vec v = { { p[0], p[1], p[2] } };
    return v;
}

static vec add(vec a, double w, vec b)              // a + w b
{
    for (int k = 0; k < 3; k++) a.x[k] += w * b.x[k];
    return a;
}

static vec cross(vec a, vec b)
{
    vec c = { { a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2],
                a.x[0] * b.x[1] - a.x[1] * b.x[0] } };
    return c;
}

static double length(vec a)
{
    return sqrt(a.x[0] * a.x[0] + a.x[1] * a.x[1] + a.x[2] * a.x[2]);
}

// -------------------------------------------------------------------------- many places at once

// Places on one surface and what is there.
typedef struct sampler {
    const subdiv_mesh *cage;
    double extent;
    subdiv_surface *surface;
    void  *scratch;
    int    count;
    subdiv_location at[MOST_PLACES];
    float  values[MOST_PLACES][21];               // point, du, dv, duu, duv, dvv, normal
} sampler;

static int open_sampler(sampler *s, const subdiv_mesh *cage)
{
    memset(s, 0, sizeof *s);
    s->cage = cage;
    s->extent = mesh_extent(cage);
    CHECK_EQUAL(subdiv_prepare(&s->surface, cage, SUBDIV_EXACT, NULL), SUBDIV_OK);
    if (!s->surface) return 0;
    s->scratch = malloc(subdiv_scratch_size(s->surface, 3));
    CHECK_EQUAL(subdiv_evaluate_begin(s->surface, 3, cage->positions, 0, s->scratch, NULL),
                SUBDIV_OK);
    return 1;
}

static void close_sampler(sampler *s)
{
    free(s->scratch);
    subdiv_surface_free(s->surface);
}

static void add_place(sampler *s, int face, int corner, double u, double v)
{
    const subdiv_location at = { face, corner, (float)u, (float)v };
    if (s->count < MOST_PLACES) s->at[s->count++] = at;
}

static void evaluate_places(sampler *s)
{
    subdiv_derivatives out = {0};
    float *first = s->values[0];
    out.points = first;
    out.du = first + 3;
    out.dv = first + 6;
    out.duu = first + 9;
    out.duv = first + 12;
    out.dvv = first + 15;
    out.normals = first + 18;
    out.stride = 21;
    CHECK_EQUAL(subdiv_evaluate_at(s->surface, 3, s->scratch, s->count, s->at, &out, NULL),
                SUBDIV_OK);
}

// The point 0, its derivatives 1 to 5, or the normal 6 of place i.
static vec value(const sampler *s, int i, int which)
{
    return of_floats(s->values[i] + 3 * which);
}

static int is_ngon(const subdiv_mesh *cage, int face)
{
    return cage->scheme != SUBDIV_LOOP && face_size(cage, face) != 4;
}

// Whether a place is near a corner of its unit square or triangle: what is not regular is there,
// or on an edge.
static int is_near_corner(const subdiv_mesh *cage, const subdiv_location *at)
{
    for (int i = 0; i < (cage->scheme == SUBDIV_LOOP ? 3 : 4); i++) {
        const float u = i == 1 || (i == 2 && cage->scheme != SUBDIV_LOOP);
        const float v = i == 3 || i == 2;
        if (fabsf(at->u - u) < 0.0625f && fabsf(at->v - v) < 0.0625f) return 1;
    }
    return 0;
}

// --------------------------------------------------------------------------- against the oracle

static void check_place(const sampler *s, const slow_mesh *o, int i)
{
    const subdiv_location *at = &s->at[i];
    double exact[3][3];
    oracle_evaluate(o, at->face, at->corner, (double)at->u, (double)at->v, exact);
    const double size = fmax(length(of_doubles(exact[1])), length(of_doubles(exact[2])));
    for (int which = 0; which < 3; which++) {
        const vec ours = value(s, i, which), difference = add(ours, -1, of_doubles(exact[which]));
        const double allowed = position_tolerance * s->extent
                             + (which ? derivative_tolerance * size + 2e-6 * s->extent : 0);
        if (which && is_near_corner(s->cage, at)) continue;
        if (!(length(difference) <= allowed))
            TEST_REPORT("%s at face %d, corner %d, u %g, v %g is (%.7g %.7g %.7g), "
                        "exactly (%.7g %.7g %.7g)", which == 0 ? "point" : which == 1 ? "du" : "dv",
                        at->face, at->corner, (double)at->u, (double)at->v, ours.x[0], ours.x[1],
                        ours.x[2], exact[which][0], exact[which][1], exact[which][2]);
    }
}

// Anywhere, on edges, near vertices and n-gon centres, and where faces were split.
static void choose_place(random_cage *random, sampler *s)
{
    const int f = random_below(random, s->cage->face_count), loop = s->cage->scheme == SUBDIV_LOOP;
    const int corner = is_ngon(s->cage, f) ? random_below(random, face_size(s->cage, f)) : 0;
    double uv[2];
    for (int k = 0; k < 2; k++) {
        const double tiny = pow(0.5, random_below(random, 24));
        uv[k] = (double)random_real(random, 0, 1);
        switch (random_below(random, 8)) {
        case 0: uv[k] = random_below(random, 2); break;
        case 1: uv[k] *= tiny; break;
        case 2: uv[k] = 1 - tiny; break;
        case 3: uv[k] = random_below(random, 17) / 16.0; break;
        default: break;
        }
    }
    if (loop && uv[0] + uv[1] > 1) {
        const double u = uv[0];
        uv[0] = 1 - uv[1];
        uv[1] = 1 - u;
    }
    add_place(s, f, corner, uv[0], uv[1]);
}

// The first seeds, and some that were not right once: creases through vertices where fins meet.
static unsigned seed_number(int i)
{
    static const unsigned chosen[] = { 730, 756, 3193 };
    return i < 3 ? chosen[i] : (unsigned)i - 2;
}

static void test_random_cages(void)
{
    static sampler s;
    test_context = context;
    for (int i = 0; i < 200; i++) {
        const unsigned seed = seed_number(i);
        random_cage *random = random_cage_new(seed, FEATURES);
        sprintf(context, "seed %u", seed);
        CHECK(random != NULL);
        if (!random || !open_sampler(&s, &random->mesh)) return;
        slow_mesh *o = slow_cage(&random->mesh, 0);
        for (int k = 0; k < PLACES; k++) choose_place(random, &s);
        evaluate_places(&s);
        for (int k = 0; k < s.count; k++)
            if (!o->dropped[s.at[k].face]) check_place(&s, o, k);
        close_sampler(&s);
        slow_free(o);
        random_cage_free(random);
    }
}

static void shake(test_cage *c, unsigned seed)
{
    for (int i = 0; i < 3 * c->mesh.vertex_count; i++) {
        seed = seed * 1664525u + 1013904223u;
        c->positions[i] += (float)(seed >> 16) / 65536.0f * 0.3f - 0.15f;
    }
}

// A vertex of so many faces, closed or on a boundary, alone or with a crease through it.
static void build_vertex(test_cage *c, int i, int faces)
{
    static const double sharpness[4] = { 0, 0, SUBDIV_INFINITE, 1.5 };
    const int kind = i % 4;
    build_fan(c, i & 4 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, faces, kind != 1);
    if (kind >= 2) cage_crease(c, 0, 1, sharpness[kind]);
    if (kind >= 2) cage_crease(c, 0, 1 + faces / 2, sharpness[kind]);
    shake(c, (unsigned)(8 * faces + i));
    sprintf(context, "%d faces, %s, kind %d", faces, i & 4 ? "Loop" : "Catmull-Clark", kind);
}

// Is a normal that of the exact derivatives? Near the vertex they have the exact direction only as
// far as the oracle's last face is small beside the distance.
static void check_normal(const sampler *s, const slow_mesh *o, int i)
{
    const subdiv_location *at = &s->at[i];
    double exact[3][3];
    oracle_evaluate(o, at->face, at->corner, (double)at->u, (double)at->v, exact);
    const vec n = cross(of_doubles(exact[1]), of_doubles(exact[2]));
    const double angle = length(cross(value(s, i, 6), n)) / length(n);
    if (!(angle <= 1e-3))
        TEST_REPORT("the normal at face %d, u %g, v %g is off by %g", at->face, (double)at->u,
                    (double)at->v, angle);
    CHECK_NEAR(length(value(s, i, 6)), 1, 1e-6);
}

static void test_valences(void)
{
    static sampler s;
    static test_cage c;
    test_context = context;
    for (int faces = 3; faces <= 50; faces += faces < 8 ? 1 : 7) {
        for (int kind = 0; kind < 8; kind++) {
            build_vertex(&c, kind, faces);
            if (!open_sampler(&s, &c.mesh)) return;
            slow_mesh *o = slow_cage(&c.mesh, 0);
            for (int i = 0; i < 8; i++) {
                const double r = pow(0.5, 0.5 + 1.5 * i), part = 0.09 + 0.11 * i;
                add_place(&s, i % faces, 0, r * part, r * (1 - part));
            }
            evaluate_places(&s);
            for (int i = 0; i < s.count; i++) check_place(&s, o, i);
            for (int i = 0; i < s.count; i++) check_normal(&s, o, i);
            close_sampler(&s);
            slow_free(o);
        }
    }
}

// ------------------------------------------------------------------------------------ continuity

// The place t of the way along edge i of a face.
static void add_edge_place(sampler *s, int face, int i, double t)
{
    const int n = face_size(s->cage, face);
    const double quads[4][2] = { { t, 0 }, { 1, t }, { 1 - t, 1 }, { 0, 1 - t } };
    const double triangles[3][2] = { { t, 0 }, { 1 - t, t }, { 0, 1 - t } };
    const double *uv = s->cage->scheme == SUBDIV_LOOP ? triangles[i % 3] : quads[i % 4];
    if (!is_ngon(s->cage, face)) add_place(s, face, 0, uv[0], uv[1]);
    else if (t <= 0.5) add_place(s, face, i, 2 * t, 0);
    else add_place(s, face, (i + 1) % n, 0, 2 * (1 - t));
}

// Do places i and i + 1 have one point, and one normal as far as the derivatives span a plane?
static void check_meeting(const sampler *s, int i, int smooth)
{
    double size = 0, area = HUGE_VAL;
    for (int k = i; k < i + 2; k++) {
        size = fmax(size, fmax(length(value(s, k, 1)), length(value(s, k, 2))));
        area = fmin(area, length(cross(value(s, k, 1), value(s, k, 2))));
    }
    const double gap = length(add(value(s, i, 0), -1, value(s, i + 1, 0)));
    const double angle = length(add(value(s, i, 6), -1, value(s, i + 1, 6)));
    const double allowed = 1e-4 * size * size + 2e-6 * s->extent * size;
    if (!(gap <= position_tolerance * s->extent) || (smooth && !(angle * area <= allowed)))
        TEST_REPORT("faces %d and %d, corners %d and %d, at %g %g: %g apart, normals by %g",
                    s->at[i].face, s->at[i + 1].face, s->at[i].corner, s->at[i + 1].corner,
                    (double)s->at[i].u, (double)s->at[i].v, gap, angle);
}

// Both they and what they leave of 1 are floats.
static const double edge_places[] = {
    0.296875, 0.5, 0.703125, 0.953125, 1.0 / 64, 1.0 / 1024, 1.0 / 131072, 0
};
enum { EDGE_PLACES = sizeof edge_places / sizeof *edge_places };

// Every edge with two faces, and the edges between the quads of an n-gon. An edge that is sharp
// forever has two normals; one that is sharp for a while has one.
static void check_all_edges(sampler *s, const slow_mesh *cage)
{
    int *first_face = (int *)slow_new(cage->edge_count, sizeof *first_face);
    int *first_edge = (int *)slow_new(cage->edge_count, sizeof *first_edge);
    for (int e = 0; e < cage->edge_count; e++) first_face[e] = -1;
    for (int f = 0; f < cage->face_count; f++) {
        for (int i = 0, n = slow_size(cage, f); i < n; i++) {
            const int h = cage->start[f] + i, e = cage->edges[h], g = first_face[e];
            const int same = g >= 0 && cage->vertices[cage->start[g] + first_edge[e]]
                                    == cage->vertices[h];
            if (cage->dropped[f]) continue;
            s->count = 0;
            for (int k = 0; k < EDGE_PLACES && g >= 0; k++) {
                const double t = edge_places[k];
                add_edge_place(s, f, i, t);
                add_edge_place(s, g, first_edge[e], same ? t : 1 - t);
            }
            const int edge_count = s->count;
            for (int k = 0; k < EDGE_PLACES && is_ngon(s->cage, f); k++) {
                add_place(s, f, i, 1, edge_places[k]);
                add_place(s, f, (i + 1) % n, edge_places[k], 1);
            }
            evaluate_places(s);
            for (int k = 0; k < s->count; k += 2) {
                const int at_vertex = edge_places[k / 2 % EDGE_PLACES] == 0;
                const int smooth = k < edge_count ? cage->crease[e] < SUBDIV_INFINITE : 1;
                check_meeting(s, k, smooth && !at_vertex);
            }
            first_face[e] = f;
            first_edge[e] = i;
        }
    }
    free(first_face), free(first_edge);
}

static void test_edges(void)
{
    static sampler s;
    test_context = context;
    for (int i = 0; i < 120; i++) {
        const unsigned seed = seed_number(i);
        random_cage *random = random_cage_new(seed, FEATURES & ~RANDOM_BILINEAR);
        sprintf(context, "seed %u", seed);
        CHECK(random != NULL);
        if (!random || !open_sampler(&s, &random->mesh)) return;
        slow_mesh *o = slow_cage(&random->mesh, 0);
        check_all_edges(&s, o);
        close_sampler(&s);
        slow_free(o);
        random_cage_free(random);
    }
}

// All faces of a smooth vertex give it the same point and normal; so do places on both sides of
// each edge, however near to it.
static void test_smooth_vertices(void)
{
    static sampler s;
    static test_cage c;
    static const double distances[] = { 0, 1e-30, 1e-12, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2, 0.1 };
    test_context = context;
    for (int faces = 3; faces <= 50; faces++) {
        for (int loop = 0; loop < 2; loop++) {
            build_vertex(&c, 4 * loop, faces);
            if (!open_sampler(&s, &c.mesh)) return;
            for (size_t k = 0; k < sizeof distances / sizeof *distances; k++) {
                const int some = distances[k] > 0 && distances[k] < 1e-8 ? 2 : faces;
                s.count = 0;
                for (int f = 0; f < some; f++) {
                    add_place(&s, f, 0, 0, distances[k]);
                    add_place(&s, (f + 1) % faces, 0, distances[k], 0);
                }
                evaluate_places(&s);
                for (int i = 0; i < s.count; i += 2) {
                    const double angle = length(cross(value(&s, i, 6), value(&s, i + 1, 6)));
                    const double gap = length(add(value(&s, i, 0), -1, value(&s, i + 1, 0)));
                    CHECK_NEAR(length(value(&s, i, 6)), 1, 1e-6);
                    CHECK_NEAR(gap, 0, position_tolerance * s.extent);
                    if (!(angle < 1e-4))
                        TEST_REPORT("normals %g apart at distance %g", angle, distances[k]);
                    const double turn = length(cross(value(&s, 0, 6), value(&s, i, 6)));
                    if (k == 0) CHECK_NEAR(turn, 0, 1e-5);
                }
            }
            close_sampler(&s);
        }
    }
}

// ----------------------------------------------------------------------------------- differences

// A place, often near vertex 0 of its face, and those beside it, by h along u and along v: all in
// one polynomial patch.
static void add_cross(random_cage *random, sampler *s)
{
    const int f = random_below(random, s->cage->face_count);
    const int corner = is_ngon(s->cage, f) ? random_below(random, face_size(s->cage, f)) : 0;
    const int most = s->cage->scheme == SUBDIV_LOOP ? 12 : 25;
    const double scale = pow(0.5, random_chance(random, 50) ? random_below(random, 10) : 0);
    const double h = scale / 256, u = scale * (2 * random_below(random, most) + 7) / 64;
    const double v = scale * (2 * random_below(random, most) + 7.25) / 64;
    add_place(s, f, corner, u, v);
    add_place(s, f, corner, u - h, v);
    add_place(s, f, corner, u + h, v);
    add_place(s, f, corner, u, v - h);
    add_place(s, f, corner, u, v + h);
}

// Derivative which of place i against differences of the derivative below it.
static void check_difference(const sampler *s, int i, int which)
{
    static const int below[6] = { 0, 0, 0, 1, 1, 2 }, side[6] = { 0, 1, 3, 1, 3, 3 };
    const int low = i + side[which], high = low + 1;
    const double step = (double)(side[which] == 1 ? s->at[high].u - s->at[low].u
                                                  : s->at[high].v - s->at[low].v);
    const vec zero = { { 0, 0, 0 } }, ours = value(s, i, which);
    const vec difference = add(value(s, high, below[which]), -1, value(s, low, below[which]));
    const vec error = add(add(zero, 1 / step, difference), -1, ours);
    double size = 0, above = which < 3 ? s->extent : 0;
    for (int k = which < 3 ? 1 : 3; k < (which < 3 ? 3 : 6); k++) size += length(value(s, i, k));
    for (int k = 1; k < 3 && which >= 3; k++) above += length(value(s, i, k));
    if (!(length(error) <= 1e-3 * size + 3e-7 * above / step))
        TEST_REPORT("derivative %d at face %d, corner %d, u %g, v %g is (%g %g %g), off by %g",
                    which, s->at[i].face, s->at[i].corner, (double)s->at[i].u,
                    (double)s->at[i].v, ours.x[0], ours.x[1], ours.x[2], length(error));
}

static void test_differences(void)
{
    static sampler s;
    test_context = context;
    for (unsigned seed = 1; seed <= 200; seed++) {
        random_cage *random = random_cage_new(seed, FEATURES & ~(RANDOM_CREASES | RANDOM_CORNERS));
        sprintf(context, "seed %u", seed);
        CHECK(random != NULL);
        if (!random || !open_sampler(&s, &random->mesh)) return;
        for (int i = 0; i < PLACES; i++) add_cross(random, &s);
        evaluate_places(&s);
        for (int i = 0; i < s.count; i += 5)
            for (int which = 1; which < 6; which++) check_difference(&s, i, which);
        close_sampler(&s);
        random_cage_free(random);
    }
}

int main(void)
{
    RUN(test_random_cages);
    RUN(test_valences);
    RUN(test_edges);
    RUN(test_smooth_vertices);
    RUN(test_differences);
    return test_end("exact_oracle");
}
