// The limit surface at any (face, u, v). The references: the formula of the bicubic B-spline; the
// limit points of refined meshes; for derivatives, how much values change; near an extraordinary
// vertex, the eigenvalues of the papers.
//
//     cc -I. tests/test_exact.c -o build/test_exact -lm -pthread && build/test_exact
#include <stdlib.h>

static size_t most_cell_polynomials = (size_t)1 << 24;
#define SDV_CELL_POLYNOMIALS most_cell_polynomials
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#define CAGE_SCALE 2
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/ready.h"
#include "lib/test.h"

// ---------------------------------------------------------------------------------- evaluation

// All there is at one place.
typedef struct sample {
    float p[3], du[3], dv[3], duu[3], duv[3], dvv[3], normal[3];
} sample;

static sample evaluate(const ready *r, int face, int corner, double u, double v)
{
    sample s;
    subdiv_location at = { face, corner, (float)u, (float)v };
    subdiv_derivatives out = { s.p, s.du, s.dv, s.duu, s.duv, s.dvv, s.normal, 0 };
    memset(&s, 0, sizeof s);
    CHECK_EQUAL(subdiv_evaluate_at(r->surface, 3, r->scratch, 1, &at, &out, NULL), SUBDIV_OK);
    return s;
}

static double length(const float *a)
{
    return sqrt((double)a[0] * (double)a[0] + (double)a[1] * (double)a[1] +
                (double)a[2] * (double)a[2]);
}

static double distance(const float *a, const float *b)
{
    float d[3] = { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
    return length(d);
}

// -------------------------------------------------------------------------------- regular faces

// The cubic B-spline at t of p[0..3] and its derivatives: the basis functions of the textbooks.
static double spline(const double *p, double t, int derivative)
{
    double s = 1 - t;
    double b[3][4] = {
        { s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
          (3 * s * s * s - 6 * s * s + 4) / 6, t * t * t / 6 },
        { -s * s / 2, (3 * t * t - 4 * t) / 2, (-3 * s * s + 4 * s) / 2, t * t / 2 },
        { s, 3 * t - 2, 3 * s - 2, t } };
    double sum = 0;
    for (int i = 0; i < 4; i++) sum += b[derivative][i] * p[i];
    return sum;
}

static double bicubic(double p[4][4], double u, double v, int du, int dv)
{
    double rows[4];
    for (int i = 0; i < 4; i++) rows[i] = spline(p[i], u, du);
    return spline(rows, v, dv);
}

static void test_bicubic(void)
{
    test_cage c;
    build_grid(&c, SUBDIV_CATMULL_CLARK, 3, 3);
    for (int i = 0; i < 3 * c.mesh.vertex_count; i++)
        c.positions[i] = (float)((i * 37 + i * i * 11) % 64) / 16;
    ready r = get_ready(&c.mesh, NULL);
    const int *q = face_vertices(&c.mesh, 4), step[2] = { q[1] - q[0], q[3] - q[0] };
    for (int i = 0; i < 81; i++) {
        double u = i % 9 / 8.0, v = i / 9 / 8.0;
        sample s = evaluate(&r, 4, 0, u, v);
        for (int k = 0; k < 3; k++) {
            double p[4][4];
            for (int a = 0; a < 16; a++)
                p[a / 4][a % 4] = (double)c.positions[3 * (q[0] + (a % 4 - 1) * step[0] +
                                                          (a / 4 - 1) * step[1]) + k];
            CHECK_NEAR(s.p[k], bicubic(p, u, v, 0, 0), 2e-6);
            CHECK_NEAR(s.du[k], bicubic(p, u, v, 1, 0), 5e-6);
            CHECK_NEAR(s.dv[k], bicubic(p, u, v, 0, 1), 5e-6);
            CHECK_NEAR(s.duu[k], bicubic(p, u, v, 2, 0), 1e-5);
            CHECK_NEAR(s.duv[k], bicubic(p, u, v, 1, 1), 1e-5);
            CHECK_NEAR(s.dvv[k], bicubic(p, u, v, 0, 2), 1e-5);
        }
    }
    put_away(&r);
}

// ------------------------------------------------------------------------- against refined meshes

enum { DEEP = 4, DROPPED = 2 };         // DROPPED: a face without a surface, by boundary "none"

// Sharpness that is gone on level DEEP - 1, or infinite.
static void tame_sharpness(random_cage *c)
{
    for (int i = 0; i < c->mesh.crease_count; i++)
        if (c->crease_sharpness[i] < SUBDIV_INFINITE)
            c->crease_sharpness[i] = fminf(c->crease_sharpness[i], DEEP - 1.25f);
    for (int i = 0; i < c->mesh.corner_count; i++)
        if (c->corner_sharpness[i] < SUBDIV_INFINITE)
            c->corner_sharpness[i] = fminf(c->corner_sharpness[i], DEEP - 1.25f);
}

// Does any infinite crease of the lists meet v? Where one ends >>limit has another limit; that is
// fewer vertices than are left out.
static int at_infinite_crease(const subdiv_mesh *m, int v)
{
    for (int i = 0; i < m->crease_count; i++)
        if (m->crease_sharpness[i] >= SUBDIV_INFINITE &&
            (m->crease_vertices[2 * i] == v || m->crease_vertices[2 * i + 1] == v)) return 1;
    return 0;
}

static int is_at_crease(const subdiv_mesh *m, const order *o, order_place p)
{
    int at = place_point(o, p);
    return at < m->vertex_count && at_infinite_crease(m, at);
}

static void compare_with_limit(const subdiv_mesh *m, int level, subdiv_options opt, double *worst)
{
    subdiv_mesh fine;
    opt.limit = 1;
    CHECK_EQUAL(subdiv_refine(&fine, m, level, &opt), SUBDIV_OK);
    ready r = get_ready(m, &opt);
    order grid, *o = &grid;
    CHECK(order_make(o, m, level, NULL));
    double size = mesh_reach(m);
    for (int f = 0; f < m->face_count; f++) {
        if (r.surface->hole[f] == DROPPED) continue;
        order_place p = { f, 0, 0, 0, 0 };
        do {
            double n = order_grid(o, f);
            sample s = evaluate(&r, f, p.quad, p.column / n, p.row / n);
            double off = distance(s.p, fine.positions + 3 * place_point(o, p)) / size;
            if (is_at_crease(m, o, p)) continue;
            *worst = fmax(*worst, off);
            if (off > 1e-6)
                TEST_REPORT("face %d.%d row %d column %d is off by %g", f, p.quad, p.row, p.column,
                            off);
        } while (place_next_point(o, &p));
    }
    order_free(o);
    put_away(&r);
    subdiv_mesh_free(&fine);
}

// ------------------------------------------------------------------------------------ derivatives

// A polynomial of degree 4 changes as much as Simpson's rule makes of its derivative, exactly.
static void check_change(const float *a, const float *b, const float *da, const float *dm,
                         const float *db, double h, double size)
{
    for (int k = 0; k < 3; k++) {
        double sum = h / 6 * ((double)da[k] + 4 * (double)dm[k] + (double)db[k]);
        CHECK_NEAR((double)b[k] - (double)a[k], sum, size);
    }
}

// In the cells of a grid that no irregular vertex touches, along u (du = 1) or v.
static void check_cell(const ready *r, int f, int corner, double u, double v, double h, int along_u,
                       double size)
{
    double du = along_u ? h : 0, dv = along_u ? 0 : h;
    sample a = evaluate(r, f, corner, u, v), b = evaluate(r, f, corner, u + du, v + dv);
    sample m = evaluate(r, f, corner, u + du / 2, v + dv / 2);
    double first = fmax(size, h * fmax(length(a.duu), length(a.dvv)));
    if (along_u) {
        check_change(a.p, b.p, a.du, m.du, b.du, h, 2e-6 * size);
        check_change(a.du, b.du, a.duu, m.duu, b.duu, h, 2e-5 * first);
        check_change(a.dv, b.dv, a.duv, m.duv, b.duv, h, 2e-5 * first);
    } else {
        check_change(a.p, b.p, a.dv, m.dv, b.dv, h, 2e-6 * size);
        check_change(a.dv, b.dv, a.dvv, m.dvv, b.dvv, h, 2e-5 * first);
        check_change(a.du, b.du, a.duv, m.duv, b.duv, h, 2e-5 * first);
    }
}

static void check_derivatives(random_cage *c, int level)
{
    const subdiv_mesh *m = &c->mesh;
    int loop = m->scheme == SUBDIV_LOOP;
    ready r = get_ready(m, NULL);
    order grid, *o = &grid;
    CHECK(order_make(o, m, level, NULL));
    for (int f = 0; f < m->face_count; f++)
        for (int quad = 0; quad < (order_is_ngon(o, f) ? order_face_size(o, f) : 1); quad++) {
            int n = order_grid(o, f);
            for (int i = 0; i < n * n; i++) {
                int row = i / n, column = i % n, middle = row > 0 && row + 1 < n;
                double h = 1.0 / n, u = column * h, v = (row + 0.5) * h;
                // A row through the middle of cells; under Loop along edges inside the grid.
                if (loop ? row == 0 || row + column + 1 >= n || column == 0 : !middle) continue;
                if (loop) v = row * h;
                check_cell(&r, f, quad, u, v, h, 1, 4 * mesh_reach(m));
                check_cell(&r, f, quad, v, u, h, 0, 4 * mesh_reach(m));
            }
        }
    order_free(o);
    put_away(&r);
}

static void test_derivatives(void)
{
    char context[64];
    for (unsigned seed = 1; seed <= 100; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        tame_sharpness(c);
        snprintf(context, sizeof context, "seed %u", seed);
        test_context = context;
        check_derivatives(c, DEEP);
        random_cage_free(c);
    }
}

// ------------------------------------------------------------------------ extraordinary vertices

static double pi(void)
{
    return 4 * atan(1.0);
}

// The next to largest eigenvalue of refinement around a vertex of valence n [CC78], [Loop87].
static double eigenvalue(int n, int loop)
{
    double c = cos(2 * pi() / n);
    if (loop) return 0.375 + c / 4;
    return (5 + c + cos(pi() / n) * sqrt(2 * (9 + c))) / 16;
}

// The library's own cosines: at least as good as its comment says, and exact at quarters.
static void test_cosines(void)
{
    const long double bound = LDBL_MANT_DIG > DBL_MANT_DIG ? DBL_EPSILON : 16 * DBL_EPSILON;
    for (int n = 1; n < 300; n++) {
        for (int k = 0; k <= n; k++) {
            long double angle = 2 * acosl(-1) * k / n;
            CHECK(fabsl(cosl(angle) - sdv_cosine(k, n)) <= bound);
            CHECK(fabsl(sinl(angle) - sdv_sine(k, n)) <= bound);
        }
    }
    for (int k = 0; k <= 4; k++) {
        CHECK(sdv_cosine(k, 4) == (k % 2 ? 0 : k == 2 ? -1 : 1));
        CHECK(sdv_sine(k, 4) == (k % 2 ? 2 - k : 0));
    }
}

// A closed fan that is a hill.
static void build_hill(test_cage *c, int loop, int n)
{
    build_fan(c, loop ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, n, 1);
    for (int v = 0; v < c->mesh.vertex_count; v++) {
        float *p = c->positions + 3 * v;
        p[2] = 1 - 0.5f * (p[0] * p[0] + p[1] * p[1]) + 0.2f * p[0];
    }
}

// Which corner of a face is the vertex 0, and a place near it, as seen from there.
static void near_vertex(const subdiv_mesh *m, int f, double x, double y, double *u, double *v)
{
    const int *q = face_vertices(m, f);
    double z = 1 - x - y;
    int at = 0;
    while (q[at] != 0) at++;
    if (face_size(m, f) == 3) {
        *u = at == 0 ? x : at == 1 ? z : y;
        *v = at == 0 ? y : at == 1 ? x : z;
    } else {
        *u = at == 0 ? x : at == 1 ? 1 - y : at == 2 ? 1 - x : y;
        *v = at == 0 ? y : at == 1 ? x : at == 2 ? 1 - y : 1 - x;
    }
}

static void check_vertex(int loop, int n)
{
    static const double near[4] = { 1e-3, 1e-6, 1e-12, 1e-30 };
    test_cage c;
    char context[64];
    build_hill(&c, loop, n);
    ready r = get_ready(&c.mesh, NULL);
    sample at[64];
    for (int f = 0; f < n; f++) {
        double u, v;
        near_vertex(&c.mesh, f, 0, 0, &u, &v);
        at[f] = evaluate(&r, f, 0, u, v);
        // Every face has the same vertex.
        CHECK_NEAR(distance(at[f].p, at[0].p), 0, 1e-6);
        CHECK_NEAR(distance(at[f].normal, at[0].normal), 0, 1e-5);
        CHECK_NEAR(length(at[f].normal), 1, 1e-6);
        CHECK(at[f].normal[2] > 0.5f);
        CHECK_NEAR(at[f].duu[0], 0, 0);
    }
    for (int i = 0; i < 4; i++)
        for (int f = 0; f < n; f++) {
            double u, v, far = near[i] * (n > 12 ? 30 : 3);
            snprintf(context, sizeof context, "%s %d, %g", loop ? "Loop" : "quads", n, near[i]);
            test_context = context;
            near_vertex(&c.mesh, f, near[i], near[i] / 3, &u, &v);
            if (u > 0.9 || v > 0.9) continue;              // floats do not get near there
            sample s = evaluate(&r, f, 0, u, v);
            CHECK_NEAR(distance(s.p, at[0].p), 0, 2 * pow(far, 0.6) + 1e-6);
            // In the worst case the normal turns as (second / first eigenvalue)^levels.
            CHECK_NEAR(distance(s.normal, at[0].normal), 0, 3 * pow(far, n < 8 ? 0.1 : 0.01));
            // Beside the next face: the same point and normal.
            near_vertex(&c.mesh, f, near[i], 0, &u, &v);
            s = evaluate(&r, f, 0, u, v);
            near_vertex(&c.mesh, (f + n - 1) % n, 0, near[i], &u, &v);
            if (u > 0.9 || v > 0.9) continue;
            sample t = evaluate(&r, (f + n - 1) % n, 0, u, v);
            CHECK_NEAR(distance(s.p, t.p), 0, 1e-6);
            CHECK_NEAR(distance(s.normal, t.normal), 0, 1e-4);
        }
    put_away(&r);
    test_context = "";
}

static void test_vertices(void)
{
    static const int valences[] = { 3, 4, 5, 6, 7, 8, 11, 16, 31, 50 };
    for (int i = 0; i < 10; i++) {
        check_vertex(0, valences[i]);
        check_vertex(1, valences[i]);
    }
}

// On a regular fan the first derivative along an edge changes by twice the eigenvalue from one
// level to the next, and du at the vertex is what it tends to. Points stand where du leads.
static void check_eigenvalue(int loop, int n)
{
    test_cage c;
    char context[64];
    build_fan(&c, loop ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, n, 1);
    ready r = get_ready(&c.mesh, NULL);
    double expected = 2 * eigenvalue(n, loop), before = 0;
    snprintf(context, sizeof context, "%s %d", loop ? "Loop" : "quads", n);
    test_context = context;
    int f = 0;
    while (face_vertices(&c.mesh, f)[0] != 0) f++;
    for (int level = 60; level < 100; level++) {
        sample s = evaluate(&r, f, 0, ldexp(1, -level), 0);
        double now = length(s.du);
        if (before > 0) CHECK_NEAR(now / before, expected, 1e-4 * expected);
        before = now;
    }
    sample s = evaluate(&r, f, 0, 0, 0), beside = evaluate(&r, f, 0, ldexp(1, -60), 0);
    for (int level = 4; level < 12; level++) {
        sample there = evaluate(&r, f, 0, ldexp(1, -level), 0);
        float sum[3], way = (float)distance(there.p, s.p), size = (float)length(there.du);
        for (int k = 0; k < 3; k++) sum[k] = (there.p[k] - s.p[k]) / way + there.du[k] / size;
        CHECK_NEAR(length(sum), 2, 0.02);
    }
    CHECK(length(s.du) > 0);
    for (int k = 0; k < 3 && n < 8; k++)           // with higher valence it tends too slowly
        CHECK_NEAR((double)s.du[k] / length(s.du), (double)beside.du[k] / length(beside.du), 1e-5);
    for (int level = 4; level < 24; level += 4) {  // second derivatives: how the first change
        double u = ldexp(1, -level), v = 0.75 * u, h = u / 32;
        sample at = evaluate(&r, f, 0, u, v);
        sample left = evaluate(&r, f, 0, u - h, v), below = evaluate(&r, f, 0, u, v - h);
        sample right = evaluate(&r, f, 0, u + h, v), above = evaluate(&r, f, 0, u, v + h);
        double size = length(at.duu) + length(at.duv) + length(at.dvv) + 1e-4 * length(at.du) / h;
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR((right.du[k] - left.du[k]) / (2 * h), at.duu[k], 0.02 * size);
            CHECK_NEAR((above.du[k] - below.du[k]) / (2 * h), at.duv[k], 0.02 * size);
            CHECK_NEAR((above.dv[k] - below.dv[k]) / (2 * h), at.dvv[k], 0.02 * size);
        }
    }
    put_away(&r);
    test_context = "";
}

static void test_eigenvalues(void)
{
    for (int n = 3; n <= 50; n += n < 8 ? 1 : 7) {
        check_eigenvalue(0, n);
        check_eigenvalue(1, n);
    }
}

// ------------------------------------------------------------------------------------- continuity

// Everywhere, with sharpness of any size: one point of the refined mesh is one point of the
// surface, from whichever face it is seen; what is beside a vertex is beside its point.
static void check_continuous(random_cage *c, const subdiv_options *opt)
{
    const subdiv_mesh *m = &c->mesh;
    ready r = get_ready(m, opt);
    order grid, *o = &grid;
    CHECK(order_make(o, m, 3, NULL));
    sample *seen = (sample *)calloc((size_t)o->point_count, sizeof *seen);
    unsigned char *known = (unsigned char *)calloc((size_t)o->point_count, 1);
    double size = mesh_reach(m);
    for (int f = 0; f < m->face_count; f++) {
        if (r.surface->hole[f] == DROPPED) continue;
        order_place p = { f, 0, 0, 0, 0 };
        do {
            double n = order_grid(o, f);
            int at = place_point(o, p);
            sample s = evaluate(&r, f, p.quad, p.column / n, p.row / n);
            if (known[at]) CHECK_NEAR(distance(s.p, seen[at].p), 0, 1e-6 * size);
            known[at] = 1;
            seen[at] = s;
            double u = p.column ? p.column / n - 1e-7 : 1e-9, v = p.row ? p.row / n - 1e-7 : 1e-9;
            sample t = evaluate(&r, f, p.quad, u, v);
            CHECK_NEAR(distance(s.p, t.p), 0, 3e-4 * size);     // at worst (1e-7)^0.6
        } while (place_next_point(o, &p));
    }
    free(seen);
    free(known);
    order_free(o);
    put_away(&r);
}

static void test_continuous(void)
{
    char context[64];
    for (unsigned seed = 1; seed <= 60; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        subdiv_options opt;
        memset(&opt, 0, sizeof opt);
        opt.linear = seed % 13 == 0;
        snprintf(context, sizeof context, "seed %u", seed);
        test_context = context;
        check_continuous(c, &opt);
        random_cage_free(c);
    }
}

// ---------------------------------------------------------------------------------- shared points

enum { PLACES = 9 };                  // along an edge

// A surface of positions or values that is ready for two channels.
typedef struct shared_surface {
    const subdiv_mesh *mesh;
    subdiv_surface *surface;
    const unsigned char *hole;
    void *scratch;
} shared_surface;

// The place after t of the edge that leads on from vertex i of a face, as callers find it.
static subdiv_location on_edge(const subdiv_mesh *m, int f, int i, float t)
{
    int size = face_size(m, f), loop = m->scheme == SUBDIV_LOOP, half = t > 0.5f;
    float quad[4][2] = { { t, 0 }, { 1, t }, { 1 - t, 1 }, { 0, 1 - t } };
    float triangle[3][2] = { { t, 0 }, { 1 - t, t }, { 0, 1 - t } };
    const float *uv = loop ? triangle[i % 3] : quad[i % 4];
    subdiv_location whole = { f, 0, uv[0], uv[1] }, part = { f, i, 2 * t, 0 };
    subdiv_location next = { f, (i + 1) % size, 0, 2 * (1 - t) };
    return loop || size == 4 ? whole : half ? next : part;
}

// Are the points of two lists the same bits? The derivatives asked for as well change nothing.
static void check_same_points(const shared_surface *s, subdiv_location at[2][PLACES], int count)
{
    float p[2][2 * PLACES], du[2 * PLACES];
    subdiv_derivatives to[2] = { { p[0], NULL, NULL, NULL, NULL, NULL, NULL, 0 },
                                 { p[1], du, NULL, NULL, NULL, NULL, NULL, 0 } };
    for (int i = 0; i < 2; i++)
        CHECK_EQUAL(subdiv_evaluate_at(s->surface, 2, s->scratch, count, at[i], &to[i], NULL),
                    SUBDIV_OK);
    CHECK(memcmp(p[0], p[1], 2 * sizeof(float) * (size_t)count) == 0);
}

// The first face-vertex of a face in the topology of the surface; -1: it has no surface.
static int first_corner(const shared_surface *s, int f)
{
    const int *own = s->surface->own_face;
    if (s->hole[f] == DROPPED || (own && own[f] < 0)) return -1;
    return sdv_face_start(&s->surface->order.cage, own ? own[f] : f);
}

// Vertex i of face f and the edge that leads on from there beside those of face g.
static void check_shared_by(const shared_surface *s, const float *t, int f, int i, int g)
{
    const sdv_level *cage = &s->surface->order.cage;
    int h = first_corner(s, f) + i, first = first_corner(s, g), next = sdv_next(cage, h);
    const int *v = cage->face_vertices;
    subdiv_location at[2][PLACES];
    for (int j = 0; j < face_size(s->mesh, g) && first >= 0; j++) {
        int k = first + j, same = v[k] == v[h];
        at[0][0] = on_edge(s->mesh, f, i, 0);
        at[1][0] = on_edge(s->mesh, g, j, 0);
        if (same) check_same_points(s, at, 1);
        if (v[h] == v[next] || cage->face_edges[h] != cage->face_edges[k]) continue;
        for (int place = 0; place < PLACES; place++) {
            at[0][place] = on_edge(s->mesh, f, i, t[place]);
            at[1][place] = on_edge(s->mesh, g, j, same ? t[place] : 1 - t[place]);
        }
        check_same_points(s, at, PLACES);
    }
}

// The spoke between the quads of an n-gon at vertices i and i + 1, and its centre.
static void check_spoke(const shared_surface *s, const float *t, int f, int i)
{
    subdiv_location at[2][PLACES];
    for (int k = 0; k < PLACES; k++) {
        int after = (i + 1) % face_size(s->mesh, f);
        subdiv_location first = { f, i, 1, t[k] }, next = { f, after, t[k], 1 };
        at[0][k] = first;
        at[1][k] = next;
    }
    check_same_points(s, at, PLACES);
}

static void check_shared(random_cage *c, shared_surface *s, const float *in)
{
    const subdiv_mesh *m = s->mesh;
    s->scratch = malloc(subdiv_scratch_size(s->surface, 2));
    CHECK_EQUAL(subdiv_evaluate_begin(s->surface, 2, in, 0, s->scratch, NULL), SUBDIV_OK);
    for (int f = 0; f < m->face_count; f++)
        for (int i = 0; i < face_size(m, f) && first_corner(s, f) >= 0; i++) {
            float t[PLACES] = { 0, 1, 0.5f, 0.3f, 1.0f / 3 };
            for (int k = 5; k < PLACES; k++) t[k] = random_real(c, 0.001f, 0.999f);
            for (int g = 0; g <= f; g++) check_shared_by(s, t, f, i, g);
            if (m->scheme != SUBDIV_LOOP && face_size(m, f) != 4) check_spoke(s, t, f, i);
        }
    free(s->scratch);
}

// What faces share, they evaluate to the same bits: points of an edge at t and 1 - t, vertices,
// spokes of n-gons; with creases, on non-manifold edges, and between seams of values.
static void test_shared(void)
{
    char context[64];
    for (unsigned seed = 1; seed <= 60; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        const subdiv_mesh *m = &c->mesh;
        shared_surface points = { m, NULL, NULL, NULL }, values = points;
        float in[2 * RANDOM_MAX_VERTICES];
        snprintf(context, sizeof context, "seed %u", seed);
        test_context = context;
        for (int i = 0; i < 2 * m->vertex_count; i++) in[i] = random_real(c, -1, 1);
        CHECK_EQUAL(subdiv_prepare(&points.surface, m, SUBDIV_EXACT, NULL), SUBDIV_OK);
        points.hole = values.hole = points.surface->hole;
        check_shared(c, &points, in);
        if (m->uv_count) {
            CHECK_EQUAL(subdiv_prepare_face_varying(&values.surface, m, m->uv_count, m->face_uvs,
                                                    (subdiv_uv_rule)(seed % 6), SUBDIV_EXACT, NULL),
                        SUBDIV_OK);
            check_shared(c, &values, m->uvs);
        }
        subdiv_surface_free(points.surface);
        subdiv_surface_free(values.surface);
        random_cage_free(c);
    }
}

// ---------------------------------------------------------------------------------- hard places

// In a mesh of quads: where a vertex is in a face, or -1.
static int corner_of(const subdiv_mesh *m, int f, int vertex)
{
    for (int i = 0; i < 4; i++) if (m->face_vertices[4 * f + i] == vertex) return i;
    return -1;
}

// The other end of the edge that goes straight on from b, coming from a.
static int straight_on(const subdiv_mesh *m, int a, int b)
{
    for (int f = 0; f < m->face_count; f++) {
        int at = corner_of(m, f, b);
        for (int k = 1; k <= 3 && at >= 0; k += 2) {
            int to = m->face_vertices[4 * f + (at + k) % 4], beside = to == a;
            for (int g = 0; g < m->face_count; g++)
                beside |= corner_of(m, g, a) >= 0 && corner_of(m, g, b) >= 0 &&
                          corner_of(m, g, to) >= 0;
            if (!beside) return to;
        }
    }
    return -1;
}

// A semi-sharp line that passes a smooth extraordinary vertex, touching the faces around it.
static void test_passing_creases(void)
{
    static const float sharpness[] = { 0.4f, 1, 1.7f, 2.5f };
    double worst = 0;
    for (int k = 0; k < 12; k++) {
        test_cage c;
        subdiv_mesh fine;
        subdiv_options opt = {0};
        enum { EDGES = 5 };
        int line[EDGES + 1], ends[2 * EDGES];
        float sharp[EDGES];
        build_hill(&c, 0, 3 + 2 * (k / 4));
        CHECK_EQUAL(subdiv_refine(&fine, &c.mesh, 2, NULL), SUBDIV_OK);
        int f = 0, at;
        while (corner_of(&fine, f, 0) < 0) f++;
        at = corner_of(&fine, f, 0);
        line[1] = fine.face_vertices[4 * f + (at + 2) % 4];         // from across this face
        line[2] = fine.face_vertices[4 * f + (at + 1) % 4];         // over a neighbour of vertex 0
        line[0] = straight_on(&fine, line[2], line[1]);
        for (int i = 2; i < EDGES; i++) line[i + 1] = straight_on(&fine, line[i - 1], line[i]);
        for (int i = 0; i < EDGES; i++) {
            ends[2 * i] = line[i];
            ends[2 * i + 1] = line[i + 1];
            sharp[i] = sharpness[k % 4];
        }
        fine.crease_count = EDGES;
        fine.crease_vertices = ends;
        fine.crease_sharpness = sharp;
        compare_with_limit(&fine, DEEP, opt, &worst);
        subdiv_mesh_free(&fine);
    }
    CHECK(worst > 0);
}

// Creases that go straight on through a grid: on both sides of faces, of the same sharpness or not,
// and across. Then as many of them as there are kinds of strips to number, and more.
static void test_parallel_creases(void)
{
    static const double some[] = { 0.3, 0.5, 1, 1.5, 2, 2.75 };
    static test_cage c;
    subdiv_options opt = {0};
    double worst = 0;
    for (int i = 0; i < 2 * 6 * 6; i++) {
        build_grid(&c, SUBDIV_CATMULL_CLARK, 3, 5);
        c.mesh.creasing = i % 2 ? SUBDIV_CREASING_CHAIKIN : SUBDIV_CREASING_UNIFORM;
        for (int v = 0; v < c.mesh.vertex_count; v++) c.positions[3 * v + 2] = (float)(v * v % 5);
        for (int k = 0; k < 3; k++) {
            cage_crease(&c, 8 + k, 9 + k, some[i / 2 % 6]);
            cage_crease(&c, 12 + k, 13 + k, some[(i / 2 + (i / 12 == 5)) % 6]);
        }
        for (int k = 0; k < 5 && i >= 12; k++)
            cage_crease(&c, 4 * k + 1, 4 * k + 5, some[i / 12]);
        compare_with_limit(&c.mesh, DEEP, opt, &worst);
    }
    build_grid(&c, SUBDIV_CATMULL_CLARK, 1, 260);
    for (int k = 2; k < 260; k += 2) cage_crease(&c, 2 * k, 2 * k + 1, k / 260.0);
    compare_with_limit(&c.mesh, 2, opt, &worst);
    CHECK(worst > 0);
}

// A grid that is flat and evenly spaced (by numbers that floats have) stays so with a straight
// crease of any sharpness: its second derivatives are 0, also in the thousandth of a face beside
// it.
static void test_long_creases(void)
{
    static const float sharpness[] = { 0.3f, 1, 2.5f, 4, 5.5f, 7.5f, 8.5f, 9, 9.5f, 9.9f };
    static const float along[3] = { 48103 / 65536.0f, -20382 / 65536.0f, 7 };
    static const float across[3] = { 20382 / 65536.0f, 48103 / 65536.0f, 1001 / 1024.0f };
    enum { N = 8, ROW = 4 };
    for (int k = 0; k < 10; k++) {
        test_cage c;
        build_grid(&c, SUBDIV_CATMULL_CLARK, N, N);
        for (int v = 0; v < c.mesh.vertex_count; v++)
            for (int i = 0; i < 3; i++)
                c.positions[3 * v + i] = (float)(v % (N + 1)) * along[i] +
                                         (float)(v / (N + 1)) * across[i];
        for (int i = 0; i < N; i++)
            cage_crease(&c, ROW * (N + 1) + i, ROW * (N + 1) + i + 1, sharpness[k]);
        ready r = get_ready(&c.mesh, NULL);
        double worst = 0;
        for (int i = 0; i < 300; i++) {
            int above = i % 2, face = (above ? ROW : ROW - 1) * N + 3;
            double far = ldexp(0.5 + i % 7 / 14.0, -(i % 13));
            sample s = evaluate(&r, face, 0, 0.1 + i % 5 / 6.0, above ? far : 1 - far);
            CHECK_NEAR(distance(s.du, along), 0, 1e-5);
            CHECK_NEAR(distance(s.dv, across), 0, 1e-5);
            worst = fmax(worst, fmax(length(s.duu), fmax(length(s.duv), length(s.dvv))));
        }
        CHECK_NEAR(worst, 0, 1e-3);
        put_away(&r);
    }
}

// Powers of 2 change nothing but the size, as far up as positions may go, also beside a crease of
// nearly 10.
static void test_sizes(void)
{
    enum { N = 8, POWER = 115 };
    test_cage c;
    build_grid(&c, SUBDIV_CATMULL_CLARK, N, N);
    for (int v = 0; v < c.mesh.vertex_count; v++) {
        c.positions[3 * v] = (float)sin(0.4 * (v % (N + 1)));
        c.positions[3 * v + 1] = (float)sin(0.3 * (v / (N + 1)));
        c.positions[3 * v + 2] = (float)cos(0.7 * v);
    }
    for (int i = 0; i < N; i++)
        cage_crease(&c, 4 * (N + 1) + i, 4 * (N + 1) + i + 1, 9.5f);
    ready small = get_ready(&c.mesh, NULL);
    for (int i = 0; i < 3 * c.mesh.vertex_count; i++)
        c.positions[i] = ldexpf(c.positions[i], POWER);
    ready large = get_ready(&c.mesh, NULL);
    for (int i = 0; i < 300; i++) {
        double far = ldexp(0.5 + i % 7 / 14.0, -(i % 13)), u = 0.1 + i % 5 / 6.0;
        sample a = evaluate(&small, 4 * N + 3, 0, u, far);
        sample b = evaluate(&large, 4 * N + 3, 0, u, far);
        for (int k = 0; k < 3; k++) {
            CHECK(ldexpf(a.p[k], POWER) == b.p[k]);
            CHECK(ldexpf(a.du[k], POWER) == b.du[k]);
            CHECK(ldexpf(a.dv[k], POWER) == b.dv[k]);
        }
    }
    put_away(&small);
    put_away(&large);
}

// At a vertex on the boundary with a single face the edges become parallel; a flat polygon has its
// normal there all the same, however near.
static void test_single_faces(void)
{
    for (int n = 3; n <= 6; n++) {
        test_cage c;
        build_fan(&c, n == 3 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, 1, 0);
        int corners[6] = { 0, 1, 2, 3, 4, 5 };
        c.mesh.vertex_count = c.mesh.face_size = n;
        c.mesh.face_count = 1;
        c.mesh.face_sizes = NULL;
        c.mesh.face_vertices = corners;
        for (int i = 0; i < n; i++) {
            c.positions[3 * i] = (float)cos(6.283185307 * i / n + 0.3);
            c.positions[3 * i + 1] = (float)sin(6.283185307 * i / n + 0.3);
            c.positions[3 * i + 2] = 0;
        }
        ready r = get_ready(&c.mesh, NULL);
        for (int k = 0; k < 120; k++) {
            sample s = evaluate(&r, 0, 0, ldexp(0.9, -k), ldexp(0.07 * (k % 12), -k));
            CHECK_NEAR(s.normal[2], 1, 1e-5);
        }
        put_away(&r);
    }
}

// -------------------------------------------------------------------------------------- channels

enum { MANY = 5000 };

// A third of them where polynomials meet, a third close to vertex 0.
static void random_places(random_cage *c, subdiv_location *at)
{
    const subdiv_mesh *m = &c->mesh;
    for (int i = 0; i < MANY; i++) {
        int f = random_below(c, m->face_count), size = face_size(m, f);
        at[i].face = f;
        at[i].corner = m->scheme == SUBDIV_LOOP || size == 4 ? 0 : random_below(c, size);
        at[i].u = random_real(c, 0, 1);
        at[i].v = random_real(c, 0, 1);
        if (i % 3 == 0) {
            at[i].u = floorf(at[i].u * 17) / 16;
            at[i].v = floorf(at[i].v * 17) / 16;
        } else if (i % 3 == 1) {
            float closer = ldexpf(1, -random_below(c, 100));
            at[i].u *= closer;
            at[i].v *= closer;
        }
        if (m->scheme == SUBDIV_LOOP && at[i].u + at[i].v > 1) {
            at[i].u = 1 - at[i].u;
            at[i].v = 1 - at[i].v;
        }
    }
}

static void run_backwards(void *user, void (*job)(void *context, int i), void *context, int count)
{
    (void)user;
    for (int i = count; i-- > 0; ) job(context, i);
}

// Whatever is asked for alone, also from a surface of its own, has the same bits.
static void check_alone(const subdiv_surface *surface, int channels, const void *scratch,
                        const subdiv_location *at, float (*all)[11 * MANY])
{
    static float dense[8 * MANY];
    for (int d = 0; d < 6 + (channels >= 3); d++) {
        subdiv_derivatives out = {0};
        float **asked[7] = { &out.points, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv,
                             &out.normals };
        *asked[d] = dense;
        CHECK_EQUAL(subdiv_evaluate_at(surface, channels, scratch, MANY, at, &out, NULL),
                    SUBDIV_OK);
        size_t count = d < 6 ? (size_t)channels : 3;
        for (int i = 0; i < MANY; i++)
            CHECK(memcmp(dense + count * (size_t)i, all[d] + 11 * i, sizeof(float) * count) == 0);
    }
}

// Any number of channels, strides and order of jobs: the bits of one channel after the other.
static void check_channels(random_cage *c, int channels)
{
    static float in[8 * RANDOM_MAX_VERTICES], one[RANDOM_MAX_VERTICES];
    static float out[7][11 * MANY], alone[6][MANY], dense[8];
    static subdiv_location at[MANY];
    const subdiv_mesh *m = &c->mesh;
    subdiv_options opt;
    memset(&opt, 0, sizeof opt);
    opt.run = run_backwards;
    subdiv_surface *surface = NULL;
    random_places(c, at);
    CHECK_EQUAL(subdiv_prepare(&surface, m, SUBDIV_EXACT, NULL), SUBDIV_OK);
    char *scratch = (char *)malloc(subdiv_scratch_size(surface, channels) + 4);
    for (int i = 0; i < channels * m->vertex_count; i++) in[i] = random_real(c, -1, 1);
    subdiv_derivatives to = { out[0], out[1], out[2], out[3], out[4], out[5], out[6], 11 };
    if (channels < 3) to.normals = NULL;
    CHECK_EQUAL(subdiv_evaluate_begin(surface, channels, in, 0, scratch + 4, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_evaluate_at(surface, channels, scratch + 4, MANY, at, &to, &opt), SUBDIV_OK);
    check_alone(surface, channels, scratch + 4, at, out);
    for (int i = 0; i < MANY; i++) {                            // one by one: the same bits
        subdiv_derivatives single = { dense, NULL, NULL, NULL, NULL, NULL, NULL, 0 };
        CHECK_EQUAL(subdiv_evaluate_at(surface, channels, scratch + 4, 1, &at[i], &single, NULL),
                    SUBDIV_OK);
        CHECK(memcmp(dense, out[0] + 11 * i, sizeof(float) * (size_t)channels) == 0);
    }
    for (int k = 0; k < channels; k++) {
        for (int v = 0; v < m->vertex_count; v++) one[v] = in[v * channels + k];
        subdiv_derivatives some = { alone[0], alone[1], alone[2], alone[3], alone[4], alone[5],
                                    NULL, 0 };
        CHECK_EQUAL(subdiv_evaluate_begin(surface, 1, one, 0, scratch, NULL), SUBDIV_OK);
        CHECK_EQUAL(subdiv_evaluate_at(surface, 1, scratch, MANY, at, &some, NULL), SUBDIV_OK);
        for (int d = 0; d < 6; d++)
            for (int i = 0; i < MANY; i++)
                CHECK(memcmp(&alone[d][i], &out[d][11 * i + k], sizeof(float)) == 0);
    }
    free(scratch);
    subdiv_surface_free(surface);
}

static void test_channels(void)
{
    for (int i = 0; i < 8; i++) {
        random_cage *c = random_cage_new((unsigned)(900 + i), RANDOM_ALL & ~RANDOM_HOLES);
        c->mesh.boundary = SUBDIV_BOUNDARY_EDGE;
        check_channels(c, 1 + i);
        random_cage_free(c);
    }
}

// Nothing is written beside scratch, wherever that begins.
static void check_scratch(const subdiv_mesh *m, int channels)
{
    static float in[8 * RANDOM_MAX_VERTICES];
    subdiv_surface *surface = NULL;
    CHECK_EQUAL(subdiv_prepare(&surface, m, SUBDIV_EXACT, NULL), SUBDIV_OK);
    size_t size = subdiv_scratch_size(surface, channels), room = size + 256;
    unsigned char *memory = (unsigned char *)malloc(room);
    for (size_t first = 64; first < 128; first += 20) {
        memset(memory, 0x55, room);
        CHECK_EQUAL(subdiv_evaluate_begin(surface, channels, in, 0, memory + first, NULL),
                    SUBDIV_OK);
        for (size_t i = 0; i < first; i++) CHECK(memory[i] == 0x55);
        for (size_t i = first + size; i < room; i++) CHECK(memory[i] == 0x55);
    }
    free(memory);
    subdiv_surface_free(surface);
}

static void test_scratch(void)
{
    for (int i = 0; i < 16; i++) {
        random_cage *c = random_cage_new((unsigned)(1100 + i), RANDOM_ALL);
        check_scratch(&c->mesh, 1 + i % 8);
        c->mesh.face_count = c->mesh.crease_count = c->mesh.hole_count = c->mesh.uv_count = 0;
        check_scratch(&c->mesh, 1 + i % 8);
        random_cage_free(c);
    }
}

// -------------------------------------------------------------------------------------- batches

// Of many locations the first one that does not exist is named, in any order of jobs.
static void check_first_refused(random_cage *c, const subdiv_surface *surface, const void *scratch)
{
    static subdiv_location at[MANY];
    static float p[3 * MANY];
    const float odd[4] = { -0.001f, 1.001f, HUGE_VALF, -HUGE_VALF };
    const float nan = HUGE_VALF - HUGE_VALF;
    const subdiv_derivatives out = { p, NULL, NULL, NULL, NULL, NULL, NULL, 0 };
    const subdiv_mesh *m = &c->mesh;
    for (int round = 0; round < 40; round++) {
        char text[32];
        subdiv_error error;
        subdiv_options opt;
        memset(&opt, 0, sizeof opt);
        opt.error = &error;
        opt.run = run_backwards;
        random_places(c, at);
        int count = 1 + random_below(c, round % 2 ? 40 : MANY), first = random_below(c, count);
        for (int i = first; i < count; i += 1 + random_below(c, MANY / 4)) {
            int f = at[i].face, size = m->scheme == SUBDIV_LOOP ? 4 : face_size(m, f);
            switch (random_below(c, 6)) {
            case 0: at[i].face = random_below(c, 2) ? -1 - f : m->face_count + f; break;
            case 1: at[i].corner = random_below(c, 2) ? -1 : size == 4 ? 1 : size; break;
            case 2: at[i].u = odd[random_below(c, 4)]; break;
            case 3: at[i].v = odd[random_below(c, 4)]; break;
            case 4: at[i].u = nan; break;
            default: at[i].v = nan;
            }
        }
        CHECK(subdiv_evaluate_at(surface, 3, scratch, count, at, &out, &opt) != SUBDIV_OK);
        snprintf(text, sizeof text, "location %d:", first);
        CHECK(strncmp(error.message, text, strlen(text)) == 0);
    }
}

// Those outside of their faces by rounding are on them.
static void check_rounded(random_cage *c, const subdiv_surface *surface, const void *scratch)
{
    static subdiv_location at[2][MANY];
    static float p[2][3 * MANY];
    random_places(c, at[0]);
    for (int i = 0; i < MANY; i++) {
        if (i % 4 == 0) at[0][i].u = at[0][i].v = 0;
        if (i % 4 == 1) at[0][i].u = 1, at[0][i].v = 0;
        at[1][i] = at[0][i];
        if (i % 4 == 0) at[1][i].u = -9e-7f, at[1][i].v = -0.0f;
        if (i % 4 == 1) at[1][i].u = 1 + 9e-7f, at[1][i].v = -1e-30f;
    }
    for (int k = 0; k < 2; k++) {
        const subdiv_derivatives out = { p[k], NULL, NULL, NULL, NULL, NULL, NULL, 0 };
        CHECK_EQUAL(subdiv_evaluate_at(surface, 3, scratch, MANY, at[k], &out, NULL), SUBDIV_OK);
    }
    CHECK(memcmp(p[0], p[1], sizeof p[0]) == 0);
}

static void test_batches(void)
{
    for (int i = 0; i < 8; i++) {
        random_cage *c = random_cage_new((unsigned)(950 + i), RANDOM_ALL & ~RANDOM_HOLES);
        subdiv_surface *surface = NULL;
        c->mesh.boundary = SUBDIV_BOUNDARY_EDGE;
        CHECK_EQUAL(subdiv_prepare(&surface, &c->mesh, SUBDIV_EXACT, NULL), SUBDIV_OK);
        void *scratch = malloc(subdiv_scratch_size(surface, 3));
        CHECK_EQUAL(subdiv_evaluate_begin(surface, 3, c->mesh.positions, 0, scratch, NULL),
                    SUBDIV_OK);
        check_first_refused(c, surface, scratch);
        check_rounded(c, surface, scratch);
        free(scratch);
        subdiv_surface_free(surface);
        random_cage_free(c);
    }
}

// Many cubes in the same place: a location close to a vertex has the same bits on all of them, also
// where the numbers of nests and their faces have more bits than a queue sorts by.
static void test_many_nests(void)
{
    enum { CUBES = 600, FACES = 6 * CUBES };
    static const int cube[24] = { 0,1,3,2, 4,6,7,5, 0,4,5,1, 2,3,7,6, 0,2,6,4, 1,5,7,3 };
    static float positions[24 * CUBES], p[2][3 * FACES];
    static int faces[4 * FACES];
    static subdiv_location at[FACES];
    const subdiv_derivatives out = { p[0], p[1], NULL, NULL, NULL, NULL, NULL, 0 };
    subdiv_mesh m;
    memset(&m, 0, sizeof m);
    for (int i = 0; i < 24 * CUBES; i++) positions[i] = (float)(i % 24 / 3 >> i % 3 & 1);
    for (int i = 0; i < 4 * FACES; i++) faces[i] = i / 24 * 8 + cube[i % 24];
    m.vertex_count = 8 * CUBES;
    m.positions = positions;
    m.face_count = FACES;
    m.face_size = 4;
    m.face_vertices = faces;
    ready r = get_ready(&m, NULL);
    for (int corner = 0; corner < 4; corner++) {
        for (int f = 0; f < FACES; f++) {
            const float u = f % 6 * 1e-3f + 1e-6f, v = 1e-4f;
            const subdiv_location place = { f, 0, corner % 2 ? 1 - u : u, corner / 2 ? 1 - v : v };
            at[f] = place;
        }
        CHECK_EQUAL(subdiv_evaluate_at(r.surface, 3, r.scratch, FACES, at, &out, NULL), SUBDIV_OK);
        for (int d = 0; d < 2; d++)
            CHECK(memcmp(p[d], p[d] + 18, sizeof p[d] - 18 * sizeof(float)) == 0);
    }
    put_away(&r);
}

// With more polynomials than cells can number, their leaves find the others. Each face of a nest has
// three on every level whose polynomials are kept.
enum { NEST_DEPTH = 4 };

static void test_many_polynomials(void)
{
    static subdiv_location at[MANY];
    static float p[2][3 * MANY];
    for (int i = 0; i < 200; i++) {
        random_cage *c = random_cage_new((unsigned)(1 + i % 20), RANDOM_ALL & ~RANDOM_HOLES);
        c->mesh.boundary = SUBDIV_BOUNDARY_EDGE;
        random_places(c, at);
        for (int k = 0; k < 2; k++) {
            const subdiv_derivatives out = { p[k], NULL, NULL, NULL, NULL, NULL, NULL, 0 };
            subdiv_surface *surface = NULL;
            CHECK_EQUAL(subdiv_prepare(&surface, &c->mesh, SUBDIV_EXACT, NULL), SUBDIV_OK);
            void *scratch = malloc(subdiv_scratch_size(surface, 3));
            subdiv_evaluate_begin(surface, 3, c->mesh.positions, 0, scratch, NULL);
            CHECK_EQUAL(subdiv_evaluate_at(surface, 3, scratch, MANY, at, &out, NULL), SUBDIV_OK);
            size_t count = (size_t)surface->exact->polynomial_count +
                           3 * NEST_DEPTH * (size_t)surface->exact->nest_face_count;
            most_cell_polynomials = k ? (size_t)1 << 24 : (size_t)i * count / 200;
            free(scratch);
            subdiv_surface_free(surface);
        }
        for (int k = 0; k < 3 * MANY; k++) CHECK_NEAR(p[0][k], p[1][k], 1e-4);
        random_cage_free(c);
    }
}

// A pentagon without values beside a quad that has some: it has five corners all the same.
static void test_without_values(void)
{
    float positions[21] = { 0,0,0, 1,0,0, 1,1,0, 0,1,0, 2,0,0, 3,1,0, 2,2,0 }, p[32 * 2];
    float values[8] = { 1, 2, 3, 4, 5, 6, 7, 9 };
    int sizes[2] = { 5, 4 }, corners[9] = { 1, 4, 5, 6, 2, 0, 1, 2, 3 };
    int value_corners[9] = { -1, -1, -1, -1, -1, 0, 1, 2, 3 };
    subdiv_mesh m;
    subdiv_surface *surface = NULL;
    subdiv_location at[32];
    const subdiv_derivatives out = { p, NULL, NULL, NULL, NULL, NULL, NULL, 0 };
    memset(&m, 0, sizeof m);
    m.vertex_count = 7;
    m.positions = positions;
    m.face_count = 2;
    m.face_sizes = sizes;
    m.face_vertices = corners;
    CHECK_EQUAL(subdiv_prepare_face_varying(&surface, &m, 4, value_corners, SUBDIV_UV_CORNERS_ONLY,
                                            SUBDIV_EXACT, NULL), SUBDIV_OK);
    void *scratch = malloc(subdiv_scratch_size(surface, 2));
    CHECK_EQUAL(subdiv_evaluate_begin(surface, 2, values, 0, scratch, NULL), SUBDIV_OK);
    for (int i = 0; i < 32; i++) {
        subdiv_location place = { i % 6 == 5, i % 6 % 5, 0.3f, 0.6f };
        at[i] = place;
        p[2 * i] = p[2 * i + 1] = 7;
    }
    CHECK_EQUAL(subdiv_evaluate_at(surface, 2, scratch, 32, at, &out, NULL), SUBDIV_OK);
    for (int i = 0; i < 32; i++) {
        CHECK(i % 6 == 5 ? p[2 * i] > 1 && p[2 * i] < 7 : p[2 * i] == 0);
        CHECK(i % 6 == 5 ? p[2 * i + 1] > 2 && p[2 * i + 1] < 9 : p[2 * i + 1] == 0);
    }
    at[7].corner = -1;
    CHECK_EQUAL(subdiv_evaluate_at(surface, 2, scratch, 32, at, &out, NULL), SUBDIV_ERROR_INDEX);
    at[7].corner = 4;
    at[5].corner = 1;
    CHECK_EQUAL(subdiv_evaluate_at(surface, 2, scratch, 32, at, &out, NULL), SUBDIV_ERROR_INDEX);
    free(scratch);
    subdiv_surface_free(surface);
}

// ---------------------------------------------------------------------------------- face-varying

// Values are a surface of their own: at the points of the refined one they have its values in the
// limit, which boundaries and seams, corners of all rules, are refined towards.
static void check_values(const subdiv_mesh *m, subdiv_uv_rule rule)
{
    subdiv_surface *exact = NULL, *fine = NULL;
    CHECK_EQUAL(subdiv_prepare_face_varying(&exact, m, m->uv_count, m->face_uvs, rule, SUBDIV_EXACT,
                                            NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_prepare_face_varying(&fine, m, m->uv_count, m->face_uvs, rule, 7, NULL),
                SUBDIV_OK);
    int faces = subdiv_surface_face_count(fine), size = subdiv_surface_face_size(fine);
    float *uvs = (float *)malloc(sizeof(float) * 2 * (size_t)(subdiv_surface_vertex_count(fine)));
    int *corners = (int *)malloc(sizeof(int) * (size_t)size * (size_t)faces);
    void *scratch = malloc(subdiv_scratch_size(exact, 2));
    CHECK_EQUAL(subdiv_evaluate(fine, 2, m->uvs, 0, uvs, 0, NULL, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_surface_faces(fine, corners, NULL, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_evaluate_begin(exact, 2, m->uvs, 0, scratch, NULL), SUBDIV_OK);
    order grid, *o = &grid;
    CHECK(order_make(o, m, 7, NULL));
    for (int f = 0; f < m->face_count && m->hole_count == 0; f++) {
        order_place p = { f, 0, 0, 0, 0 };
        do {
            int n = order_grid(o, f), *q = corners + (size_t)size * (size_t)order_face(o, p);
            float uv[2] = { 7, 7 };
            subdiv_location at = { f, p.quad, (float)p.column / (float)n, (float)p.row / (float)n };
            subdiv_derivatives out = { uv, NULL, NULL, NULL, NULL, NULL, NULL, 0 };
            if (p.turned || (p.row + 3 * p.column) % 13) continue;
            CHECK_EQUAL(subdiv_evaluate_at(exact, 2, scratch, 1, &at, &out, NULL), SUBDIV_OK);
            CHECK_NEAR(uv[0], q[0] < 0 ? 0 : uvs[2 * q[0]], 2e-3);      // 4^-7 of their bends
            CHECK_NEAR(uv[1], q[0] < 0 ? 0 : uvs[2 * q[0] + 1], 2e-3);
        } while (place_next_face(o, &p));
    }
    order_free(o);
    free(scratch);
    free(uvs);
    free(corners);
    subdiv_surface_free(exact);
    subdiv_surface_free(fine);
}

static void test_values(void)
{
    char context[64];
    int checked = 0;
    for (unsigned seed = 1; checked < 24; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL & ~RANDOM_HOLES);
        c->mesh.boundary = SUBDIV_BOUNDARY_EDGE;
        for (int i = 0; i < c->mesh.crease_count; i++)
            if (c->crease_sharpness[i] < SUBDIV_INFINITE)
                c->crease_sharpness[i] = fminf(c->crease_sharpness[i], DEEP - 1.25f);
        snprintf(context, sizeof context, "seed %u", seed);
        test_context = context;
        if (c->mesh.uv_count && c->mesh.face_count < 40)
            check_values(&c->mesh, (subdiv_uv_rule)(checked++ % 6));
        random_cage_free(c);
    }
}

// A seam along the middle row of a sheet; a semi-sharp crease leads to it on one side. By these
// rules the values on the other side are semi-sharp with it.
static void test_values_across_a_seam(void)
{
    enum { N = 4, VALUES = (N + 1) * (N + 1) };
    test_cage c;
    float uvs[4 * VALUES];
    int face_uvs[4 * N * N];
    for (int i = 0; i < 4; i++) {
        const int above = i % 2;
        build_grid(&c, SUBDIV_CATMULL_CLARK, N, N);
        for (int k = 0; k < 4 * VALUES; k++) uvs[k] = (float)(k * 37 % 64) / 64;
        for (int k = 0; k < 4 * N * N; k++)
            face_uvs[k] = c.mesh.face_vertices[k] + (k < 2 * N * N ? 0 : VALUES);
        for (int k = 0; k < 2; k++) {
            const int row = above ? 2 + k : k, vertex = row * (N + 1) + 2;
            cage_crease(&c, vertex, vertex + N + 1, 1.75);
        }
        c.mesh.uv_count = 2 * VALUES;
        c.mesh.uvs = uvs;
        c.mesh.face_uvs = face_uvs;
        check_values(&c.mesh, i < 2 ? SUBDIV_UV_CORNERS_PLUS1 : SUBDIV_UV_CORNERS_PLUS2);
    }
}

// ----------------------------------------------------------------------------------------- errors

// One location that is refused, behind a good one: code, message, and nothing written.
static void check_refused(const subdiv_mesh *cage, subdiv_location bad, subdiv_result code,
                          const char *text)
{
    subdiv_surface *surface = NULL;
    subdiv_error error;
    subdiv_options opt;
    float p[6] = { 5, 5, 5, 5, 5, 5 };
    subdiv_location at[2] = { { 0, 0, 0, 0 }, { 0, 0, 0, 0 } };
    subdiv_derivatives out = { p, NULL, NULL, NULL, NULL, NULL, NULL, 0 };
    memset(&opt, 0, sizeof opt);
    memset(&error, 0, sizeof error);
    opt.error = &error;
    at[1] = bad;
    CHECK_EQUAL(subdiv_prepare(&surface, cage, SUBDIV_EXACT, &opt), SUBDIV_OK);
    void *scratch = malloc(subdiv_scratch_size(surface, 3));
    CHECK_EQUAL(subdiv_evaluate_begin(surface, 3, cage->positions, 0, scratch, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_evaluate_at(surface, 3, scratch, 2, at, &out, &opt), code);
    CHECK_TEXT(error.message, text);
    for (int i = 0; i < 6; i++) CHECK(p[i] == 5);
    free(scratch);
    subdiv_surface_free(surface);
}

static void test_locations(void)
{
    test_cage c;
    const float nan = (float)(HUGE_VAL - HUGE_VAL);
    const subdiv_location none = { 8, 0, 0, 0 }, below = { -1, 0, 0, 0 }, corner = { 2, 1, 0, 0 };
    const subdiv_location sixth = { 0, 6, 0, 0 }, beside = { 2, 0, 0.5f, 1.001f };
    const subdiv_location unknown = { 2, 0, nan, 0 }, outside = { 0, 0, 0.6f, 0.6f };
    build_prism(&c, 6);
    check_refused(&c.mesh, none, SUBDIV_ERROR_INDEX,
                  "location 1: face 8 does not exist (of 8)");
    check_refused(&c.mesh, below, SUBDIV_ERROR_INDEX,
                  "location 1: face -1 does not exist (of 8)");
    check_refused(&c.mesh, corner, SUBDIV_ERROR_INDEX, "location 1: face 2 has no corner 1");
    check_refused(&c.mesh, sixth, SUBDIV_ERROR_INDEX, "location 1: face 0 has no corner 6");
    check_refused(&c.mesh, beside, SUBDIV_ERROR_ARGUMENT, "location 1: u, v are not on the face");
    check_refused(&c.mesh, unknown, SUBDIV_ERROR_ARGUMENT, "location 1: u, v are not on the face");
    build_tetrahedron(&c, SUBDIV_LOOP);
    check_refused(&c.mesh, outside, SUBDIV_ERROR_ARGUMENT, "location 1: u, v are not on the face");
}

// What belongs to other surfaces is refused, too; without a surface there are zeros.
static void test_refused(void)
{
    test_cage c;
    float p[300];
    subdiv_surface *exact = NULL, *other = NULL;
    subdiv_mesh fine;
    subdiv_location at = { 0, 0, 0.5f, 0.5f };
    subdiv_derivatives out = { p, NULL, NULL, NULL, NULL, NULL, NULL, 0 }, wrong = out;
    subdiv_limit limit = { p, NULL, NULL, 0, NULL };
    build_grid(&c, SUBDIV_CATMULL_CLARK, 3, 3);
    c.mesh.boundary = SUBDIV_BOUNDARY_NONE;
    CHECK_EQUAL(subdiv_prepare(&exact, &c.mesh, SUBDIV_EXACT, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_prepare(&other, &c.mesh, -2, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_prepare(&other, &c.mesh, 1, NULL), SUBDIV_OK);
    void *scratch = malloc(subdiv_scratch_size(exact, 3));
    subdiv_evaluate_begin(exact, 3, c.positions, 0, scratch, NULL);
    CHECK_EQUAL(subdiv_evaluate_at(exact, 3, scratch, 1, &at, &out, NULL), SUBDIV_OK);
    for (int k = 0; k < 3; k++) CHECK(p[k] == 0);
    at.face = 4;
    CHECK_EQUAL(subdiv_evaluate_at(exact, 3, scratch, 1, &at, &out, NULL), SUBDIV_OK);
    CHECK_NEAR(p[0], 1.5, 1e-6);
    CHECK_EQUAL(subdiv_evaluate_at(other, 3, scratch, 1, &at, &out, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_evaluate_at(exact, 3, scratch, -1, &at, &out, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_evaluate_at(exact, 3, scratch, 1, NULL, &out, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_evaluate_at(exact, 3, scratch, 1, &at, NULL, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_evaluate_at(exact, 3, NULL, 1, &at, &out, NULL), SUBDIV_ERROR_ARGUMENT);
    wrong.stride = 2;
    CHECK_EQUAL(subdiv_evaluate_at(exact, 3, scratch, 1, &at, &wrong, NULL), SUBDIV_ERROR_ARGUMENT);
    wrong = out;
    wrong.normals = p + 9;
    CHECK_EQUAL(subdiv_evaluate_at(exact, 2, scratch, 1, &at, &wrong, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_evaluate(exact, 3, c.positions, 0, p, 0, NULL, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_evaluate_limit(exact, c.positions, 0, &limit, NULL, NULL),
                SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_surface_mesh(&fine, exact, c.positions, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_surface_faces(exact, (int *)p, NULL, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_surface_vertex_count(exact), 0);
    CHECK_EQUAL(subdiv_surface_cage_face_count(exact), 9);
    free(scratch);
    subdiv_surface_free(exact);
    subdiv_surface_free(other);
}

int main(void)
{
    RUN(test_bicubic);
    RUN(test_derivatives);
    RUN(test_vertices);
    RUN(test_cosines);
    RUN(test_eigenvalues);
    RUN(test_continuous);
    RUN(test_shared);
    RUN(test_passing_creases);
    RUN(test_parallel_creases);
    RUN(test_long_creases);
    RUN(test_sizes);
    RUN(test_single_faces);
    RUN(test_channels);
    RUN(test_scratch);
    RUN(test_batches);
    RUN(test_many_nests);
    RUN(test_many_polynomials);
    RUN(test_without_values);
    RUN(test_values);
    RUN(test_values_across_a_seam);
    RUN(test_locations);
    RUN(test_refused);
    return test_end("test_exact");
}
