// Limit positions, tangents and normals. The references: one vertex and the points around it,
// refined by the papers' masks in doubles until they lie in a plane; planes; the same surface from
// another level; evaluation without normals.
//
//     cc -I. tests/test_limit.c -o build/test_limit -lm -pthread && build/test_limit
#include <stdlib.h>


#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/same.h"
#include "lib/test.h"

typedef struct vec { double x[3]; } vec;

static vec of_floats(const float *p)
{
    vec v = { { (double)p[0], (double)p[1], (double)p[2] } };
    return v;
}

static vec add(vec a, double w, vec b)              // a + w b
{
    for (int k = 0; k < 3; k++) a.x[k] += w * b.x[k];
    return a;
}

static double dot(vec a, vec b)
{
    return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}

static vec cross(vec a, vec b)
{
    vec c = { { a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2],
                a.x[0] * b.x[1] - a.x[1] * b.x[0] } };
    return c;
}

static vec unit(vec a)
{
    vec zero = { { 0, 0, 0 } };
    return add(zero, 1 / sqrt(dot(a, a)), a);
}

static double largest_of(vec a)
{
    return fmax(fabs(a.x[0]), fmax(fabs(a.x[1]), fabs(a.x[2])));
}

// --------------------------------------------------------------------------- one ring of points

enum { MOST = 24 };

// A vertex, its neighbours e and, of quads, the vertices f across the faces. Closed and smooth; or
// open, between the ends e[0] and e[faces] of a crease.
typedef struct ring {
    int loop, closed, faces, edges;
    vec v, e[MOST + 1], f[MOST];
} ring;

static ring refine_quads(const ring *r)
{
    ring out = *r;
    int n = r->faces;
    vec zero = { { 0, 0, 0 } }, sum = zero;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 3; k++)
            out.f[i].x[k] = (r->v.x[k] + r->e[i].x[k] + r->e[(i + 1) % r->edges].x[k] +
                             r->f[i].x[k]) / 4;
    for (int i = 0; i < r->edges; i++) {
        int before = (i + n - 1) % n, smooth = r->closed || (i > 0 && i < n);
        vec middle = add(add(zero, 0.5, r->v), 0.5, r->e[i]);
        vec faces = add(add(zero, 0.25, out.f[before]), 0.25, out.f[i % n]);
        out.e[i] = smooth ? add(faces, 0.5, middle) : middle;
        sum = add(add(sum, 2.0 / n, middle), 1.0 / n, out.f[i % n]);
    }
    if (r->closed) out.v = add(add(zero, 1.0 / n, sum), (n - 3.0) / n, r->v);
    else out.v = add(add(add(zero, 0.75, r->v), 0.125, r->e[0]), 0.125, r->e[n]);
    return out;
}

static ring refine_triangles(const ring *r)
{
    ring out = *r;
    int n = r->faces;
    double c = 0.375 + cos(8 * atan(1.0) / n) / 4, b = (0.625 - c * c) / n;
    vec zero = { { 0, 0, 0 } };
    out.v = add(zero, 1 - n * b, r->v);
    for (int i = 0; i < r->edges; i++) {
        int smooth = r->closed || (i > 0 && i < n);
        vec before = r->e[(i + r->edges - 1) % r->edges], after = r->e[(i + 1) % r->edges];
        vec ends = add(add(zero, 0.5, r->v), 0.5, r->e[i]);
        out.e[i] = smooth ? add(add(add(zero, 0.75, ends), 0.125, before), 0.125, after) : ends;
        out.v = add(out.v, b, r->e[i]);
    }
    if (!r->closed) out.v = add(add(add(zero, 0.75, r->v), 0.125, r->e[0]), 0.125, r->e[n]);
    return out;
}

static ring refine_ring(const ring *r)
{
    return r->loop ? refine_triangles(r) : refine_quads(r);
}

// Moves the vertex to 0 and makes everything so large that it is of size 1.
static void centre_ring(ring *r)
{
    double size = 0;
    vec *all[2] = { r->e, r->f }, zero = { { 0, 0, 0 } };
    int counts[2] = { r->edges, r->loop ? 0 : r->faces };
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < counts[k]; i++)
            size = fmax(size, largest_of(all[k][i] = add(all[k][i], -1, r->v)));
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < counts[k]; i++) all[k][i] = add(zero, 1 / size, all[k][i]);
    r->v = zero;
}

static vec ring_limit(ring r)
{
    for (int i = 0; i < 200; i++) r = refine_ring(&r);
    return r.v;
}

// So many steps that what shrinks fast is gone.
static void shrink_ring(ring *r)
{
    for (int i = 0; i < 2000; i++) {
        centre_ring(r);
        *r = refine_ring(r);
    }
    centre_ring(r);
}

// Smooth: what is left lies in the tangent plane. On a crease one tangent is along it, and shrinks
// at another rate than what is the same on both halves of the faces.
static vec ring_normal(ring r)
{
    vec sum = { { 0, 0, 0 } }, along = add(r.e[0], -1, r.e[r.faces]);
    ring half = r;
    if (r.closed) {
        shrink_ring(&r);
        for (int i = 0; i < r.faces; i++) sum = add(sum, 1, cross(r.e[i], r.e[(i + 1) % r.edges]));
        return unit(sum);
    }
    for (int i = 0; i <= r.faces; i++) half.e[i] = add(r.e[i], 1, r.e[r.faces - i]);
    for (int i = 0; i < r.faces; i++) half.f[i] = add(r.f[i], 1, r.f[r.faces - 1 - i]);
    half.v = add(r.v, 1, r.v);
    shrink_ring(&half);
    return unit(cross(along, half.e[(r.faces + 1) / 2]));
}

// -------------------------------------------------------------------------------- against rings

static void shake(test_cage *c, unsigned seed)
{
    for (int i = 0; i < 3 * c->mesh.vertex_count; i++) {
        seed = seed * 1664525u + 1013904223u;
        c->positions[i] += (float)(seed >> 16) / 65536.0f * 0.3f - 0.15f;
    }
}

// The points around vertex 0 of a fan, on level 1: spoke i of the fan is edge 0-(i+1) of the cage.
// From spoke first on, so many faces.
static ring fan_ring(const subdiv_mesh *cage, int first, int faces, int closed)
{
    subdiv_mesh fine = {0};
    edge_list e = edges_make(cage);
    ring r;
    int spokes = 0, points = cage->vertex_count;
    memset(&r, 0, sizeof r);
    CHECK_EQUAL(subdiv_refine(&fine, cage, 1, NULL), SUBDIV_OK);
    while (edges_find(&e, 0, spokes + 1) >= 0) spokes++;
    r.loop = cage->scheme == SUBDIV_LOOP;
    r.closed = closed;
    r.faces = faces;
    r.edges = closed ? faces : faces + 1;
    r.v = of_floats(fine.positions);
    for (int i = 0; i < r.edges; i++)
        r.e[i] = of_floats(fine.positions +
                           3 * (points + edges_find(&e, 0, 1 + (first + i) % spokes)));
    for (int i = 0; i < faces && !r.loop; i++)
        r.f[i] = of_floats(fine.positions +
                           3 * (points + e.count + (first + i) % cage->face_count));
    edges_free(&e);
    subdiv_mesh_free(&fine);
    return r;
}

static double normal_error(const float *n, vec reference)
{
    return largest_of(add(of_floats(n), -1, reference));
}

// Vertex 0 of level 1 against one ring, or its two sides.
static void check_fan(const subdiv_mesh *cage, const ring *r, const ring *other)
{
    subdiv_mesh fine = {0};
    subdiv_options opt = {0};
    vec p = ring_limit(*r);
    opt.limit = 1;
    CHECK_EQUAL(subdiv_refine(&fine, cage, 1, &opt), SUBDIV_OK);
    for (int k = 0; k < 3; k++) CHECK_NEAR(fine.positions[k], p.x[k], 4e-7);
    double error = normal_error(fine.normals, ring_normal(*r));
    if (other) error = fmin(error, normal_error(fine.normals, ring_normal(*other)));
    CHECK_NEAR(error, 0, 1e-5);
    subdiv_mesh_free(&fine);
}

static void test_smooth_vertices(void)
{
    static test_cage c;
    static char context[64];
    test_context = context;
    for (int i = 6; i < 2 * MOST; i++) {
        int n = i / 2;
        sprintf(context, "valence %d, %s", n, i & 1 ? "Loop" : "Catmull-Clark");
        build_fan(&c, i & 1 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, n, 1);
        shake(&c, (unsigned)i);
        ring r = fan_ring(&c.mesh, 0, n, 1);
        check_fan(&c.mesh, &r, NULL);
    }
}

static void test_boundary_vertices(void)
{
    static test_cage c;
    static char context[64];
    test_context = context;
    for (int i = 0; i < 24; i++) {
        int faces = 1 + i / 2;
        sprintf(context, "%d faces, %s", faces, i & 1 ? "Loop" : "Catmull-Clark");
        build_fan(&c, i & 1 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, faces, 0);
        shake(&c, (unsigned)i);
        ring r = fan_ring(&c.mesh, 0, faces, 0);
        check_fan(&c.mesh, &r, NULL);
    }
}

// Two creases meet in an interior vertex, with any number of faces on either side.
static void test_crease_vertices(void)
{
    static test_cage c;
    static char context[64];
    test_context = context;
    for (int i = 0; i < 2 * 6 * 6; i++) {
        int right = 1 + i / 2 % 6, left = 1 + i / 12, n = right + left;
        sprintf(context, "%d and %d faces, %s", right, left, i & 1 ? "Loop" : "Catmull-Clark");
        if (n < 3) continue;
        build_fan(&c, i & 1 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, n, 1);
        shake(&c, (unsigned)i);
        cage_crease(&c, 0, 1, SUBDIV_INFINITE);
        cage_crease(&c, 0, 1 + right, SUBDIV_INFINITE);
        ring r = fan_ring(&c.mesh, 0, right, 0), l = fan_ring(&c.mesh, right, left, 0);
        check_fan(&c.mesh, &r, &l);
    }
}

// At a dart, the limit is where refinement leads, and normals close by tend to the one there.
static void test_darts(void)
{
    static test_cage c;
    for (int n = 6; n < 22; n++) {
        subdiv_mesh fine = {0};
        subdiv_options opt = {0};
        subdiv_surface *exact;
        float scratch[20000], point[3], normal[3];
        subdiv_derivatives out = {0};
        opt.limit = 1;
        out.points = point;
        out.normals = normal;
        build_fan(&c, n & 1 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, n / 2, 1);
        shake(&c, (unsigned)n);
        cage_crease(&c, 0, 2, SUBDIV_INFINITE);
        CHECK_EQUAL(subdiv_refine(&fine, &c.mesh, 1, &opt), SUBDIV_OK);
        CHECK_EQUAL(subdiv_prepare(&exact, &c.mesh, SUBDIV_EXACT, NULL), SUBDIV_OK);
        CHECK(subdiv_scratch_size(exact, 3) <= sizeof scratch);
        CHECK_EQUAL(subdiv_evaluate_begin(exact, 3, c.mesh.positions, 0, scratch, NULL), SUBDIV_OK);
        for (int f = 0; f < c.mesh.face_count; f++) {
            subdiv_location place = { f, 0, 1e-18f, 5e-19f };
            CHECK_EQUAL(subdiv_evaluate_at(exact, 3, scratch, 1, &place, &out, NULL), SUBDIV_OK);
            for (int k = 0; k < 3; k++) CHECK_NEAR(point[k], fine.positions[k], 4e-7);
            CHECK_NEAR(normal_error(normal, of_floats(fine.normals)), 0, 2e-3);
        }
        subdiv_mesh_free(&fine);
        subdiv_surface_free(exact);
    }
}

// Three fins along a line through the middle of a closed fan, which is no side of their crease: the
// middle is a corner, and has the normal of the fan's first waves.
static void test_fan_beside_a_crease(void)
{
    static test_cage c;
    for (int loop = 0; loop <= 1; loop++) {
        subdiv_mesh fine = {0};
        subdiv_options opt = {0};
        build_fan(&c, loop ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, 5, 1);
        int a = cage_vertex(&c, 0, -1, 2), b = cage_vertex(&c, 0, 1, 2);
        for (int i = 0; i < 3; i++) {
            int p = cage_vertex(&c, i, -1, 3), q = cage_vertex(&c, i, 0, 3);
            cage_quad(&c, a, 0, q, p);
            cage_quad(&c, 0, b, cage_vertex(&c, i, 1, 3), q);
        }
        shake(&c, 7);
        opt.limit = 1;
        CHECK_EQUAL(subdiv_refine(&fine, &c.mesh, 1, &opt), SUBDIV_OK);
        vec v = of_floats(c.mesh.positions);
        CHECK_NEAR(largest_of(add(of_floats(fine.positions), -1, v)), 0, 0);
        ring r = fan_ring(&c.mesh, 0, 5, 1);
        CHECK_NEAR(normal_error(fine.normals, ring_normal(r)), 0, 1e-5);
        subdiv_mesh_free(&fine);
    }
}

// Two quads back to back, with the right limit and the normal in the middle of theirs.
static void test_valence_two(void)
{
    static test_cage c;
    subdiv_mesh fine = {0}, one = {0};
    subdiv_options opt = {0};
    build_pillow(&c, SUBDIV_CATMULL_CLARK);
    shake(&c, 1);
    opt.limit = 1;
    CHECK_EQUAL(subdiv_refine(&fine, &c.mesh, 1, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refine(&one, &c.mesh, 1, NULL), SUBDIV_OK);
    edge_list e = edges_make(&c.mesh);
    ring r;
    memset(&r, 0, sizeof r);
    r.closed = 1;
    r.faces = r.edges = 2;
    r.v = of_floats(one.positions);
    r.e[0] = of_floats(one.positions + 3 * (c.mesh.vertex_count + edges_find(&e, 0, 2)));
    r.e[1] = of_floats(one.positions + 3 * (c.mesh.vertex_count + edges_find(&e, 0, 1)));
    for (int i = 0; i < 2; i++)
        r.f[i] = of_floats(one.positions + 3 * (c.mesh.vertex_count + e.count + i));
    vec p = ring_limit(r);
    for (int k = 0; k < 3; k++) CHECK_NEAR(fine.positions[k], p.x[k], 4e-7);
    vec n = unit(cross(add(r.e[0], -1, r.e[1]), add(r.f[0], -1, r.f[1])));
    CHECK_NEAR(normal_error(fine.normals, n), 0, 1e-5);
    edges_free(&e);
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&one);
}

// ----------------------------------------------------------------------------------- planes

static void check_plane(const subdiv_mesh *cage, int levels, vec normal, double distance)
{
    subdiv_mesh fine = {0};
    subdiv_options opt = {0};
    opt.limit = 1;
    CHECK_EQUAL(subdiv_refine(&fine, cage, levels, &opt), SUBDIV_OK);
    for (int v = 0; v < fine.vertex_count; v++) {
        CHECK_NEAR(dot(of_floats(fine.positions + 3 * v), normal), distance, 3e-6);
        CHECK_NEAR(normal_error(fine.normals + 3 * v, normal), 0, 1e-4);
    }
    subdiv_mesh_free(&fine);
}

// Grids that are shaken in their plane, with creases, corners and boundaries.
static void test_planes_stay_planes(void)
{
    static test_cage c;
    static char context[64];
    test_context = context;
    for (int i = 0; i < 3 * 2 * 5; i++) {
        subdiv_scheme scheme = (subdiv_scheme)(i % 3);
        vec x = { { 0.6, 0, 0.8 } }, y = { { 0, 1, 0 } };
        sprintf(context, "scheme %d, boundary %d, level %d", i % 3, i / 3 % 2, i / 6);
        build_grid(&c, scheme, 4, 3);
        shake(&c, (unsigned)i);
        for (int v = 0; v < c.mesh.vertex_count; v++) {
            float *p = c.positions + 3 * v;
            vec q = add(add(y, (double)p[0] - 1, y), 0, y);
            q = add(add(q, -dot(q, y), y), (double)p[0], x);
            q = add(add(q, (double)p[1], y), 0.5, cross(x, y));
            for (int k = 0; k < 3; k++) p[k] = (float)q.x[k];
        }
        c.mesh.boundary = (subdiv_boundary)(i / 3 % 2);
        cage_crease(&c, 6, 7, 1.5);
        cage_crease(&c, 7, 8, SUBDIV_INFINITE);
        cage_corner(&c, 11, SUBDIV_INFINITE);
        check_plane(&c.mesh, i / 6, cross(x, y), 0.5);
    }
}

// ------------------------------------------------------------------------ the same from elsewhere

// The limit of a level's points is the limit of the same points two levels down, with the sharpness
// that is left.
static void check_levels(const subdiv_mesh *m)
{
    subdiv_mesh first = {0}, here = {0}, below = {0};
    subdiv_options opt = {0};
    CHECK_EQUAL(subdiv_refine(&first, m, 1, NULL), SUBDIV_OK);
    opt.limit = 1;
    CHECK_EQUAL(subdiv_refine(&here, m, 1, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refine(&below, &first, 2, &opt), SUBDIV_OK);
    for (int i = 0; i < 3 * here.vertex_count; i++)
        CHECK_NEAR(here.positions[i], below.positions[i], 4e-6);
    subdiv_mesh_free(&first), subdiv_mesh_free(&here), subdiv_mesh_free(&below);
}

static void test_limit_of_other_levels(void)
{
    static char context[64];
    test_context = context;
    for (unsigned seed = 1; seed <= 300; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_MANIFOLD & ~RANDOM_HOLES & ~RANDOM_RULES);
        if (!c) abort();
        sprintf(context, "random cage %u", seed);
        check_levels(&c->mesh);
        random_cage_free(c);
    }
}

static int same_limit(const subdiv_mesh *a, const subdiv_mesh *b, int count)
{
    return same_bytes(a->positions, b->positions, 3 * count, sizeof(float)) &&
           same_bytes(a->normals, b->normals, 3 * count, sizeof(float));
}

static void test_level_zero(void)
{
    subdiv_options opt = {0};
    opt.limit = 1;
    for (unsigned seed = 1; seed <= 100; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        subdiv_mesh zero = {0}, one = {0};
        if (!c) abort();
        CHECK_EQUAL(subdiv_refine(&zero, &c->mesh, 0, &opt), SUBDIV_OK);
        CHECK_EQUAL(subdiv_refine(&one, &c->mesh, 1, &opt), SUBDIV_OK);
        CHECK_EQUAL(zero.vertex_count, c->mesh.vertex_count);
        CHECK_EQUAL(zero.face_count, c->mesh.face_count);
        CHECK(same_limit(&zero, &one, zero.vertex_count));
        memcpy(zero.positions, c->mesh.positions, 3 * sizeof(float) * (size_t)zero.vertex_count);
        CHECK(same_mesh(&zero, &c->mesh));
        subdiv_mesh_free(&zero), subdiv_mesh_free(&one);
        CHECK(mesh_is_zero(&zero));
        random_cage_free(c);
    }
}

// ----------------------------------------------------------------------------------- in pieces

static unsigned random_state;

static int below(int n)               // 0 <= result < n
{
    random_state = random_state * 1664525u + 1013904223u;
    return (int)((random_state >> 8) % (unsigned)n);
}

static float *floats(size_t count)
{
    float *a = (float *)malloc((count + 1) * sizeof *a);
    if (!a) abort();
    memset(a, 0xff, (count + 1) * sizeof *a);
    return a;
}

static void run_backwards(void *user, void (*job)(void *, int), void *context, int count)
{
    (void)user;
    for (int i = count - 1; i >= 0; i--) job(context, i);
}

// Positions, normals and tangents between each other, face by face and in windows, are those of
// separate calls; positions are those of subdiv_evaluate.
static void check_pieces(const subdiv_surface *s, const float *in)
{
    int points = subdiv_surface_vertex_count(s), faces = subdiv_surface_cage_face_count(s);
    size_t n = (size_t)points;
    float *p = floats(3 * n), *q = floats(3 * n), *normals = floats(3 * n), *t = floats(6 * n);
    float *mixed = floats(13 * n), *scratch = floats(subdiv_scratch_size(s, 3) / sizeof(float));
    subdiv_limit dense = { p, normals, t, 0, NULL }, only = { NULL, NULL, NULL, 0, NULL };
    subdiv_options opt = {0};
    opt.run = run_backwards;
    CHECK_EQUAL(subdiv_evaluate(s, 3, in, 0, q, 0, NULL, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_evaluate_limit(s, in, 0, &dense, scratch, &opt), SUBDIV_OK);
    CHECK(same_bytes(p, q, 3 * points, sizeof(float)));
    memset(q, 0xff, 3 * n * sizeof(float));
    only.normals = q;
    CHECK_EQUAL(subdiv_evaluate_limit(s, in, 3, &only, NULL, NULL), SUBDIV_OK);
    CHECK(same_bytes(normals, q, 3 * points, sizeof(float)));
    for (int first = 0, count; first < points; first += count) {
        float *part = mixed + 13 * (size_t)first;
        subdiv_limit out = { part + 7, NULL, part + 1, 13, NULL };
        subdiv_limit out_normals = { NULL, part + 10, NULL, 13, NULL };
        count = 1 + below(points - first);
        for (int f = faces - 1; f >= 0; f--) {
            CHECK_EQUAL(subdiv_evaluate_limit_faces(s, scratch, f, 1, first, count, &out, NULL),
                        SUBDIV_OK);
            CHECK_EQUAL(subdiv_evaluate_limit_faces(s, scratch, f, 1, first, count, &out_normals,
                                                    NULL), SUBDIV_OK);
        }
    }
    for (int i = 0; i < points; i++) {
        const float *part = mixed + 13 * i;
        vec a = of_floats(t + 6 * i), b = of_floats(t + 6 * i + 3);
        vec m = of_floats(normals + 3 * i), c = cross(a, b);
        CHECK(same_bytes(part, mixed + 13 * n, 1, sizeof(float)));      // nobody wrote there
        CHECK(same_bytes(part + 7, p + 3 * i, 3, sizeof(float)));
        CHECK(same_bytes(part + 10, normals + 3 * i, 3, sizeof(float)));
        CHECK(same_bytes(part + 1, t + 6 * i, 6, sizeof(float)));
        double least = 1e-12 * dot(a, a) * dot(b, b);                   // parallel but for rounding
        vec far = of_floats(p + 3 * i), near = add(far, -1, of_floats(in));
        double origin = 1.6e-11 * fmax(dot(far, far), dot(near, near));
        double fold = 1e-10 * (dot(a, a) + dot(b, b)) + origin;
        if (dot(m, m) == 0 && fmin(dot(a, a), dot(b, b)) <= 1.01 * fold) continue;
        if (dot(c, c) > 1.01 * least) CHECK_NEAR(largest_of(add(unit(c), -1, m)), 0, 1e-6);
        else if (dot(c, c) <= 0.99 * least) CHECK(dot(m, m) == 0);
    }
    free(p), free(q), free(normals), free(t), free(mixed), free(scratch);
}

static void test_pieces(void)
{
    static char context[64];
    test_context = context;
    for (unsigned seed = 1; seed <= 200; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        subdiv_surface *s = NULL;
        subdiv_options opt = {0};
        if (!c) abort();
        random_state = seed;
        sprintf(context, "random cage %u", seed);
        opt.limit = 1;
        opt.linear = seed % 8 == 0;
        CHECK_EQUAL(subdiv_prepare(&s, &c->mesh, (int)(seed % 4), &opt), SUBDIV_OK);
        if (s) check_pieces(s, c->mesh.positions);
        subdiv_surface_free(s);
        random_cage_free(c);
    }
}

// The normals of tangents whose products floats cannot hold, or that are almost parallel: in
// floats they would have no or few digits.
static void test_sizes_and_skews(void)
{
    static test_cage c;
    static char context[64];
    static const int exponents[] = { -110, -60, -35, 0, 30, 60, 110 };
    test_context = context;
    for (int i = 0; i < 2 * 3 * 7; i++) {
        subdiv_surface *s = NULL;
        subdiv_options opt = {0};
        float *p = c.positions, skew = (float)(i / 2 % 3 * 200);
        double scale = ldexp(1, exponents[i / 6]);
        sprintf(context, "size 2^%d, skew %g, %s", exponents[i / 6], (double)skew,
                i & 1 ? "Loop" : "Catmull-Clark");
        build_torus(&c, i & 1 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, 5, 4);
        shake(&c, (unsigned)i);
        for (int v = 0; v < c.mesh.vertex_count; v++, p += 3) {
            p[0] += skew * p[1];
            for (int k = 0; k < 3; k++) p[k] *= (float)scale;
        }
        opt.limit = 1;
        CHECK_EQUAL(subdiv_prepare(&s, &c.mesh, 1 + i % 3, &opt), SUBDIV_OK);
        if (s) check_pieces(s, c.positions);
        subdiv_surface_free(s);
    }
}

// Half a million away from the origin, with coordinates that floats hold exactly there as well:
// normals are the same, and points are where they were, in steps of 1/16, which floats have there.
static void check_moved(random_cage *c)
{
    const float far[3] = { 262144, -524288, 131072 };
    subdiv_mesh here = {0}, there = {0}, *m = &c->mesh;
    subdiv_options opt = {0};
    opt.limit = 1;
    for (int i = 0; i < 3 * m->vertex_count; i++)
        m->positions[i] = floorf(m->positions[i] * 16 + 0.5f) / 16;
    CHECK_EQUAL(subdiv_refine(&here, m, 2, &opt), SUBDIV_OK);
    for (int i = 0; i < 3 * m->vertex_count; i++) m->positions[i] += far[i % 3];
    CHECK_EQUAL(subdiv_refine(&there, m, 2, &opt), SUBDIV_OK);
    for (int v = 0; v < here.vertex_count; v++) {
        const float *a = here.normals + 3 * v, *b = there.normals + 3 * v;
        float length = a[0] * a[0] + a[1] * a[1] + a[2] * a[2], dot = 0;
        for (int k = 0; k < 3; k++) {
            dot += a[k] * b[k];
            CHECK_NEAR(there.positions[3 * v + k] - far[k], here.positions[3 * v + k], 0.032);
        }
        if (length > 0.5f) CHECK_NEAR(dot, 1, 1e-5);
    }
    subdiv_mesh_free(&here);
    subdiv_mesh_free(&there);
}

static void test_far_away(void)
{
    static char context[64];
    test_context = context;
    for (unsigned seed = 1; seed <= 100; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_MANIFOLD);
        sprintf(context, "random cage %u", seed);
        check_moved(c);
        random_cage_free(c);
    }
}

static void test_errors(void)
{
    static test_cage c;
    subdiv_surface *s = NULL, *plain = NULL;
    subdiv_error error = {0};
    subdiv_options opt = {0};
    float scratch[4096], out[512];
    subdiv_limit to = { out, NULL, NULL, 0, NULL };
    build_prism(&c, 4);
    opt.error = &error;
    CHECK_EQUAL(subdiv_prepare(&plain, &c.mesh, 1, &opt), SUBDIV_OK);
    opt.limit = 1;
    CHECK_EQUAL(subdiv_prepare(&s, &c.mesh, 1, &opt), SUBDIV_OK);
    CHECK(subdiv_scratch_size(s, 3) <= sizeof scratch);
    CHECK_EQUAL(subdiv_evaluate_limit(plain, c.positions, 3, &to, scratch, &opt),
                SUBDIV_ERROR_ARGUMENT);
    CHECK(strstr(error.message, "opt->limit") != NULL);
    CHECK_EQUAL(subdiv_evaluate_limit(NULL, c.positions, 3, &to, scratch, &opt),
                SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_evaluate_limit(s, NULL, 3, &to, scratch, &opt), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_evaluate_limit(s, c.positions, 2, &to, scratch, &opt),
                SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_evaluate_limit(s, c.positions, 3, NULL, scratch, &opt),
                SUBDIV_ERROR_ARGUMENT);
    to.stride = 2;
    CHECK_EQUAL(subdiv_evaluate_limit(s, c.positions, 3, &to, scratch, &opt),
                SUBDIV_ERROR_ARGUMENT);
    to.stride = 5;
    to.tangents = out;
    CHECK_EQUAL(subdiv_evaluate_limit(s, c.positions, 3, &to, scratch, &opt),
                SUBDIV_ERROR_ARGUMENT);
    to.stride = 0;
    CHECK_EQUAL(subdiv_evaluate_begin(s, 3, c.positions, 3, scratch, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_evaluate_limit_faces(s, NULL, 0, 6, 0, 26, &to, &opt),
                SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_evaluate_limit_faces(s, scratch, 0, 7, 0, 26, &to, &opt),
                SUBDIV_ERROR_INDEX);
    CHECK_EQUAL(subdiv_evaluate_limit_faces(s, scratch, 0, 6, 1, 26, &to, &opt),
                SUBDIV_ERROR_INDEX);
    CHECK_EQUAL(subdiv_evaluate_limit_faces(s, scratch, 0, 6, 0, 26, &to, &opt), SUBDIV_OK);
    subdiv_surface_free(s);
    CHECK_EQUAL(subdiv_prepare(&s, &c.mesh, SUBDIV_EXACT, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_evaluate_limit(s, c.positions, 3, &to, NULL, &opt), SUBDIV_ERROR_ARGUMENT);
    CHECK(strstr(error.message, "SUBDIV_EXACT") != NULL);
    subdiv_surface_free(s);
    subdiv_surface_free(plain);
}

// ------------------------------------------------------------------------- area-weighted normals

static void test_normals_of_a_mesh(void)
{
    static test_cage c;
    float mine[3 * 12];
    build_grid(&c, SUBDIV_CATMULL_CLARK, 2, 1);           // a roof over vertices 1 and 4
    c.positions[3 * 1 + 2] = c.positions[3 * 4 + 2] = 1;
    c.positions[3 * 2] = c.positions[3 * 5] = 4;          // its right side is steeper by 3 : 1
    cage_vertex(&c, 9, 9, 9);
    CHECK_EQUAL(subdiv_normals(&c.mesh, NULL), SUBDIV_OK);
    CHECK(c.mesh.normals && c.mesh.memory);
    vec left = { { -1, 0, 1 } }, right = { { 1, 0, 3 } };  // as long as the areas
    for (int v = 0; v < 6; v++) {
        vec n = v % 3 == 0 ? left : v % 3 == 2 ? right : add(left, 1, right);
        CHECK_NEAR(normal_error(c.mesh.normals + 3 * v, unit(n)), 0, 1e-7);
    }
    for (int k = 0; k < 3; k++) CHECK(c.mesh.normals[3 * 6 + k] == 0);
    memset(mine, 0xff, sizeof mine);                      // not finite
    c.mesh.normals = mine;                                // filled where they are
    void *memory = c.mesh.memory;
    CHECK_EQUAL(subdiv_normals(&c.mesh, NULL), SUBDIV_OK);
    CHECK(c.mesh.normals == mine && c.mesh.memory == memory);
    CHECK_NEAR(normal_error(mine, unit(left)), 0, 1e-7);
    c.face_vertices[3] = 99;
    CHECK_EQUAL(subdiv_normals(&c.mesh, NULL), SUBDIV_ERROR_INDEX);
    CHECK_EQUAL(subdiv_normals(NULL, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK(c.mesh.normals == mine && c.mesh.memory == memory);
    subdiv_mesh_free(&c.mesh);
}

// ------------------------------------------------------------------------------- beside others

// Copies of a cage beside each other, in one mesh. Of the k-th one crease is of another sharpness.
enum { COPIES = 6 };

typedef struct crowd {
    subdiv_mesh mesh;
    float positions[3 * COPIES * RANDOM_MAX_VERTICES];
    float crease_sharpness[COPIES * RANDOM_MAX_CREASES];
    float corner_sharpness[COPIES * RANDOM_MAX_CORNERS];
    int   face_sizes[COPIES * RANDOM_MAX_FACES], crease_vertices[2 * COPIES * RANDOM_MAX_CREASES];
    int   face_vertices[COPIES * RANDOM_MAX_FACES * RANDOM_MAX_SIZE];
    int   corner_vertices[COPIES * RANDOM_MAX_CORNERS];
} crowd;

static void join_crowd(crowd *all, const subdiv_mesh *m)
{
    subdiv_mesh *mesh = &all->mesh;
    const int first = mesh->vertex_count, corners = face_vertex_count(m);
    for (int i = 0; i < 3 * m->vertex_count; i++) all->positions[3 * first + i] = m->positions[i];
    for (int i = 0; i < corners; i++)
        all->face_vertices[face_vertex_count(mesh) + i] = first + m->face_vertices[i];
    for (int f = 0; f < m->face_count; f++)
        all->face_sizes[mesh->face_count++] = m->face_size ? m->face_size : m->face_sizes[f];
    for (int i = 0; i < m->crease_count; i++, mesh->crease_count++) {
        int *ends = all->crease_vertices + 2 * mesh->crease_count;
        for (int k = 0; k < 2; k++) ends[k] = first + m->crease_vertices[2 * i + k];
        all->crease_sharpness[mesh->crease_count] = m->crease_sharpness[i];
    }
    for (int i = 0; i < m->corner_count; i++, mesh->corner_count++) {
        all->corner_vertices[mesh->corner_count] = first + m->corner_vertices[i];
        all->corner_sharpness[mesh->corner_count] = m->corner_sharpness[i];
    }
    mesh->vertex_count += m->vertex_count;
}

static void begin_crowd(crowd *all, const subdiv_mesh *m)
{
    all->mesh = *m;
    all->mesh.vertex_count = all->mesh.face_count = all->mesh.face_size = 0;
    all->mesh.crease_count = all->mesh.corner_count = 0;
    all->mesh.hole_count = all->mesh.uv_count = all->mesh.statement_count = 0;
    all->mesh.line_count = 0;
    all->mesh.positions = all->positions;
    all->mesh.face_sizes = all->face_sizes;
    all->mesh.face_vertices = all->face_vertices;
    all->mesh.crease_vertices = all->crease_vertices;
    all->mesh.crease_sharpness = all->crease_sharpness;
    all->mesh.corner_vertices = all->corner_vertices;
    all->mesh.corner_sharpness = all->corner_sharpness;
}

static void join_copy(crowd *all, const subdiv_mesh *m, int copy)
{
    const int first = all->mesh.crease_count;
    join_crowd(all, m);
    if (copy && m->crease_count)
        all->crease_sharpness[first + copy % m->crease_count] = 0.5f + 0.75f * (float)copy;
}

// The limit of level 0 of a mesh: of each face-vertex point and normal. Returns how many.
static int limit_at_corners(const subdiv_mesh *m, float (*out)[6])
{
    subdiv_mesh fine;
    subdiv_options opt = {0};
    opt.limit = opt.keep_holes = 1;
    CHECK_EQUAL(subdiv_refine(&fine, m, 0, &opt), SUBDIV_OK);
    int count = face_vertex_count(&fine);
    for (int h = 0; h < count; h++) {
        const int normal = fine.face_normals ? fine.face_normals[h] : fine.face_vertices[h];
        memcpy(out[h], fine.positions + 3 * fine.face_vertices[h], 3 * sizeof(float));
        memcpy(out[h] + 3, fine.normals + 3 * normal, 3 * sizeof(float));
    }
    subdiv_mesh_free(&fine);
    return count;
}

// What is beside a cage changes nothing in its limit.
static void test_beside_others(void)
{
    static crowd all, one;
    static float together[COPIES * RANDOM_MAX_FACES * RANDOM_MAX_SIZE][6];
    static float alone[RANDOM_MAX_FACES * RANDOM_MAX_SIZE][6];
    for (unsigned seed = 1; seed <= 100; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        subdiv_mesh *m = &c->mesh;
        begin_crowd(&all, m);
        for (int copy = 0; copy < COPIES; copy++) join_copy(&all, m, copy);
        int count = limit_at_corners(&all.mesh, together) / COPIES;
        for (int copy = 0; copy < COPIES; copy++) {
            begin_crowd(&one, m);
            join_copy(&one, m, copy);
            CHECK_EQUAL(limit_at_corners(&one.mesh, alone), count);
            CHECK(memcmp(alone, together + copy * count, sizeof *alone * (size_t)count) == 0);
        }
        random_cage_free(c);
    }
}

int main(void)
{
    RUN(test_smooth_vertices);
    RUN(test_boundary_vertices);
    RUN(test_crease_vertices);
    RUN(test_darts);
    RUN(test_fan_beside_a_crease);
    RUN(test_valence_two);
    RUN(test_planes_stay_planes);
    RUN(test_limit_of_other_levels);
    RUN(test_level_zero);
    RUN(test_pieces);
    RUN(test_sizes_and_skews);
    RUN(test_far_away);
    RUN(test_errors);
    RUN(test_normals_of_a_mesh);
    RUN(test_beside_others);
    return test_end("limit");
}
