// Tessellation: where the points stand, that the faces fit together without gaps, folds and flat
// faces, what is on the points. The references: the order written a second time, with rates; each
// face of the cage drawn as a plane polygon, which its parts have to cover once; refinement.
//
//     cc -I. tests/test_tessellate.c -o build/test_tessellate -lm && build/test_tessellate
#include <limits.h>
#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/plan.h"
#include "lib/random_cage.h"
#include "lib/same.h"
#include "lib/test.h"

// ------------------------------------------------------------------------------- random cages

static unsigned state;

static int below(int n)
{
    state = state * 1664525u + 1013904223u;
    return (int)((state >> 8) % (unsigned)n);
}

static int random_rate(void)
{
    static const int rates[] = { 1, 1, 1, 2, 2, 3, 4, 5, 6, 8, 9, 17 };
    return rates[below(12)];
}

// A point of a face beside exact evaluation where it has to be: the same place and, inside, where
// the surface has one, the same normal.
static void check_place(const subdiv_mesh *fine, const plan *p, const subdiv_surface *surface,
                        const void *scratch, int f, int point, double size)
{
    float place[3], normal[3];
    subdiv_derivatives out = { place, NULL, NULL, NULL, NULL, NULL, normal, 0 };
    spot s = { 0, 0, 0 };
    CHECK(find_spot(p, f, point, &s));
    subdiv_location at = { f, s.quad, (float)s.u, (float)s.v };
    CHECK_EQUAL(subdiv_evaluate_at(surface, 3, scratch, 1, &at, &out, NULL), SUBDIV_OK);
    double off = 0, along = 0, length = 0;
    for (int k = 0; k < 3; k++) {
        length += (double)normal[k] * (double)normal[k];
        off = fmax(off, fabs((double)fine->positions[3 * point + k] - (double)place[k]));
        along += (double)fine->normals[3 * point + k] * (double)normal[k];
    }
    if (off > 2e-6 * size || (point >= p->inside_first[0] && along < length - 1e-3))
        TEST_REPORT("point %d of face %d, quad %d at %g %g: off by %g, normals by %g", point, f,
                    s.quad, s.u, s.v, off / size, 1 - along);
}

static void check_places(const subdiv_mesh *fine, const plan *p, const subdiv_surface *surface)
{
    void *scratch = malloc(subdiv_scratch_size(surface, 3));
    double size = 0;
    for (int i = 0; i < 3 * p->cage->vertex_count; i++)
        size = fmax(size, fabs((double)p->cage->positions[i]));
    CHECK_EQUAL(subdiv_evaluate_begin(surface, 3, p->cage->positions, 0, scratch, NULL), SUBDIV_OK);
    for (int f = 0; f < p->cage->face_count; f++) {
        if (p->dropped[f]) continue;
        int end = f + 1 < p->cage->face_count ? p->inside_first[f + 1] : p->point_count;
        for (int i = p->inside_first[f]; i < end; i++)
            check_place(fine, p, surface, scratch, f, i, size);
        for (int i = 0; i < order_face_size(&p->order, f); i++)
            for (int k = 0; k < side_rate(p, f, i); k++)
                check_place(fine, p, surface, scratch, f, plan_side_point(p, f, i, k), size);
    }
    free(scratch);
}

// Behind the normals of the points stand those of the other sides of creases, each for some face.
static void check_sides(const subdiv_mesh *fine)
{
    const int sides = fine->normal_count - fine->vertex_count, corners = face_vertex_count(fine);
    int *used = ints(sides);
    for (int h = 0; h < corners && fine->face_normals; h++) {
        const int normal = fine->face_normals[h], side = normal - fine->vertex_count;
        CHECK(side < sides && (side >= 0 || normal == fine->face_vertices[h]));
        if (side >= 0 && side < sides) used[side] = 1;
    }
    for (int i = 0; i < sides; i++) CHECK(used[i]);
    free(used);
}

static void check_cage(const subdiv_mesh *cage, int with_faces)
{
    unsigned char hidden[RANDOM_MAX_FACES];
    plan any;
    int edges = 0, *rates, *face_rates = ints(cage->face_count);
    subdiv_mesh fine;
    subdiv_surface *surface;
    CHECK_EQUAL(subdiv_prepare(&surface, cage, SUBDIV_EXACT, NULL), SUBDIV_OK);
    edges = subdiv_surface_edge_count(surface);
    rates = ints(edges);
    for (int e = 0; e < edges; e++) rates[e] = random_rate();
    for (int f = 0; f < cage->face_count; f++) face_rates[f] = with_faces ? below(7) : 0;
    find_hidden(cage, 1, hidden);
    plan_make(&any, cage, rates, face_rates);
    CHECK_EQUAL(any.order.edge_count, edges);
    for (int triangles = 0; triangles < 2; triangles++) {
        subdiv_tessellation how = {0};
        how.edge_rates = rates;
        how.face_rates = with_faces ? face_rates : NULL;
        how.triangles = triangles;
        subdiv_result r = subdiv_surface_tessellate(&fine, surface, cage->positions, &how, NULL);
        CHECK_EQUAL(r, SUBDIV_OK);
        if (triangles) CHECK_EQUAL(fine.face_size, 3);
        check_tessellation(&fine, &any, hidden);
        if (!triangles) check_places(&fine, &any, surface);
        if (!memchr(hidden, 1, (size_t)cage->face_count)) check_sides(&fine);
        subdiv_mesh_free(&fine);
    }
    plan_free(&any);
    subdiv_surface_free(surface);
    free(rates);
    free(face_rates);
}

static void test_random_cages(void)
{
    char name[40];
    for (unsigned seed = 1; seed <= 200; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL & ~RANDOM_UVS);
        snprintf(name, sizeof name, "seed %u", seed);
        test_context = name;
        state = seed;
        check_cage(&c->mesh, seed % 2);
        random_cage_free(c);
    }
}

// ------------------------------------------------------------------------------ beside refinement

static double furthest(const float *a, const float *b, int count)
{
    double most = 0;
    for (int i = 0; i < count; i++) most = fmax(most, fabs((double)a[i] - (double)b[i]));
    return most;
}

// Rate 2^k is the limit of k levels: the same points at the same places, the same faces.
static void check_power(const subdiv_mesh *cage, int levels, int keep_holes, int normals)
{
    subdiv_mesh fine, refined;
    subdiv_options opt = {0};
    subdiv_tessellation how = {0};
    opt.limit = 1;
    opt.keep_holes = keep_holes;
    how.rate = 1 << levels;
    CHECK_EQUAL(subdiv_tessellate(&fine, cage, &how, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refine(&refined, cage, levels, &opt), SUBDIV_OK);
    CHECK_EQUAL(fine.vertex_count, refined.vertex_count);
    CHECK_EQUAL(fine.face_count, refined.face_count);
    CHECK_EQUAL(fine.hole_count, refined.hole_count);
    CHECK_EQUAL(fine.uv_count, refined.uv_count);
    int same = fine.vertex_count == refined.vertex_count && fine.face_count == refined.face_count;
    if (same && fine.face_count) CHECK_EQUAL(fine.face_size, refined.face_size);
    if (same && fine.face_count && fine.face_size == refined.face_size) {
        int count = fine.face_count * fine.face_size;
        CHECK(same_bytes(fine.face_vertices, refined.face_vertices, count, sizeof(int)));
        CHECK(same_bytes(fine.cage_faces, refined.cage_faces, fine.face_count, sizeof(int)));
        CHECK(same_bytes(fine.holes, refined.holes, fine.hole_count, sizeof(int)));
        if (fine.uv_count)
            CHECK(same_bytes(fine.face_uvs, refined.face_uvs, count, sizeof(int)));
    }
    if (same) CHECK_NEAR(furthest(fine.positions, refined.positions, 3 * fine.vertex_count), 0,
                         1e-6 * mesh_reach(cage));
    if (same && normals)
        CHECK_NEAR(furthest(fine.normals, refined.normals, 3 * fine.vertex_count), 0, 1e-4);
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&refined);
}

static void test_powers_of_two(void)
{
    char name[40];
    for (unsigned seed = 1; seed <= 100; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        snprintf(name, sizeof name, "seed %u", seed);
        test_context = name;
        c->mesh.crease_count = 0;                     // what is semi-sharp would have to fade first
        for (int i = 0; i < c->mesh.corner_count; i++) c->corner_sharpness[i] = SUBDIV_INFINITE;
        if (c->mesh.boundary == SUBDIV_BOUNDARY_NONE) c->mesh.boundary = SUBDIV_BOUNDARY_EDGE;
        check_power(&c->mesh, 1 + (int)(seed % 3), seed % 2, 0);
        random_cage_free(c);
    }
}

// Where there are no folds, the same normals, too.
static void test_normals(void)
{
    for (int levels = 1; levels <= 3; levels++) {
        test_cage c;
        build_torus(&c, SUBDIV_CATMULL_CLARK, 5, 7);
        check_power(&c.mesh, levels, 0, 1);
        build_torus(&c, SUBDIV_LOOP, 6, 5);
        check_power(&c.mesh, levels, 0, 1);
        build_prism(&c, 5);
        check_power(&c.mesh, levels, 0, 1);
        build_icosahedron(&c, SUBDIV_LOOP);
        check_power(&c.mesh, levels, 0, 1);
        build_grid(&c, SUBDIV_CATMULL_CLARK, 3, 4);
        check_power(&c.mesh, levels, 0, 1);
    }
}

// --------------------------------------------------------------------------------- what is on it

// UVs that run straight: at every vertex of every face what its place on the cage face says. Faces
// of the cage that share an edge and its UVs share the UVs inside the edge, all others do not.
static void check_straight_uvs(const subdiv_mesh *cage)
{
    plan p;
    subdiv_mesh fine;
    subdiv_tessellation how = {0};
    order probe;
    double off = 0, values[2 * RANDOM_MAX_SIZE];
    CHECK(order_make(&probe, cage, 1, NULL));
    int *rates = ints(probe.edge_count), missing = 0;
    for (int e = 0; e < probe.edge_count; e++) rates[e] = random_rate();
    plan_make(&p, cage, rates, NULL);
    how.edge_rates = rates;
    CHECK_EQUAL(subdiv_tessellate(&fine, cage, &how, NULL), SUBDIV_OK);
    for (int i = 0, h = 0; i < fine.face_count; i++) {
        int f = fine.cage_faces[i], size = order_face_size(&p.order, f);
        int odd = repeats_vertex(&p, f);
        const int *uvs = cage->face_uvs + p.order.face_start[f];
        for (int k = 0; k < 2 * size; k++) values[k] = (double)cage->uvs[2 * uvs[k / 2] + k % 2];
        for (int k = 0; k < face_size(&fine, i); k++, h++) {
            spot s;
            if (odd) continue;
            missing += !find_spot(&p, f, fine.face_vertices[h], &s);
            for (int c = 0; c < 2; c++)
                off = fmax(off, fabs(at_spot(&p, f, s, values + c, 2) -
                                     (double)fine.uvs[2 * fine.face_uvs[h] + c]));
        }
    }
    CHECK_EQUAL(missing, 0);
    CHECK_NEAR(off, 0, 1e-6);
    subdiv_mesh_free(&fine);
    plan_free(&p);
    order_free(&probe);
    free(rates);
}

static void test_straight_uvs(void)
{
    char name[40];
    int tried = 0;
    for (unsigned seed = 1; seed <= 150; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        snprintf(name, sizeof name, "seed %u", seed);
        test_context = name;
        c->mesh.uv_rule = SUBDIV_UV_ALL;
        state = seed;
        if (c->mesh.uv_count) check_straight_uvs(&c->mesh);
        tried += c->mesh.uv_count > 0;
        random_cage_free(c);
    }
    CHECK(tried > 40);
}

// UVs that are the x and y of the positions, and colours that are the positions, move as they do.
// Face 1 has no UVs, so neither have its parts.
static void test_data_follows(void)
{
    enum { SIZE = 6 };
    test_cage c;
    subdiv_mesh fine;
    subdiv_tessellation how = {0};
    float uvs[2 * CAGE_VERTICES];
    int face_uvs[CAGE_FACE_VERTICES], without = 0;
    build_torus(&c, SUBDIV_CATMULL_CLARK, SIZE, SIZE);
    subdiv_mesh *m = &c.mesh;
    for (int v = 0; v < m->vertex_count; v++)
        for (int k = 0; k < 2; k++) uvs[2 * v + k] = m->positions[3 * v + k];
    memcpy(face_uvs, m->face_vertices, sizeof(int) * 4 * SIZE * SIZE);
    m->uv_count = m->vertex_count;
    m->uvs = uvs;
    m->face_uvs = face_uvs;
    m->uv_rule = SUBDIV_UV_NONE;
    m->colors = m->positions;
    how.rate = 5;
    for (int open = 0; open < 2; open++) {
        for (int i = 0; open && i < 4; i++) face_uvs[4 + i] = -1;
        CHECK_EQUAL(subdiv_tessellate(&fine, m, &how, NULL), SUBDIV_OK);
        CHECK(same_bytes(fine.colors, fine.positions, 3 * fine.vertex_count, sizeof(float)));
        for (int i = 0; i < 4 * fine.face_count; i++) {
            const float *uv = fine.uvs + 2 * fine.face_uvs[i];
            const float *p = fine.positions + 3 * fine.face_vertices[i];
            CHECK((fine.face_uvs[i] < 0) == (open && fine.cage_faces[i / 4] == 1));
            without += fine.face_uvs[i] < 0;
            if (!open) CHECK(uv[0] == p[0] && uv[1] == p[1]);
        }
        subdiv_mesh_free(&fine);
    }
    CHECK_EQUAL(without, 4 * 5 * 5);
}

// UVs at the vertices are where many levels take them, seams and all.
static void test_uv_limit(void)
{
    char name[40];
    int tried = 0;
    for (unsigned seed = 1; seed <= 60; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        subdiv_mesh *m = &c->mesh, fine, far;
        snprintf(name, sizeof name, "seed %u", seed);
        test_context = name;
        m->crease_count = m->corner_count = 0;
        if (m->boundary == SUBDIV_BOUNDARY_NONE) m->boundary = SUBDIV_BOUNDARY_EDGE;
        if (m->uv_count && m->face_count < 40) {
            CHECK_EQUAL(subdiv_tessellate(&fine, m, NULL, NULL), SUBDIV_OK);
            CHECK_EQUAL(subdiv_refine(&far, m, 6, NULL), SUBDIV_OK);
            CHECK_NEAR(furthest(fine.uvs, far.uvs, 2 * m->uv_count), 0, 3e-3);
            subdiv_mesh_free(&fine);
            subdiv_mesh_free(&far);
            tried++;
        }
        random_cage_free(c);
    }
    CHECK(tried > 10);
}

// A statement stands before the first part of its face, or of the next one that has any.
static void test_statements(void)
{
    static char one[] = "g one", two[] = "usemtl two", end[] = "g end";
    char *statements[] = { one, two, two, end };
    int faces[] = { 0, 2, 3, 6 }, hole = 2;
    test_cage c;
    subdiv_mesh fine;
    subdiv_tessellation how = {0};
    build_prism(&c, 4);
    c.mesh.statement_count = 4;
    c.mesh.statements = statements;
    c.mesh.statement_faces = faces;
    c.mesh.hole_count = 1;
    c.mesh.holes = &hole;
    how.rate = 3;
    CHECK_EQUAL(subdiv_tessellate(&fine, &c.mesh, &how, NULL), SUBDIV_OK);
    CHECK_EQUAL(fine.statement_count, 4);
    CHECK_EQUAL(fine.statement_faces[0], 0);
    CHECK_EQUAL(fine.statement_faces[1], 18);
    CHECK_EQUAL(fine.statement_faces[2], 18);
    CHECK_EQUAL(fine.statement_faces[3], 45);
    CHECK_TEXT(fine.statements[3], "g end");
    subdiv_mesh_free(&fine);
}

// -------------------------------------------------------------------------------------- the rates

// What the callback is asked: edge by edge, points of the limit. The middles of the edges are the
// points behind the vertices of one level.
typedef struct asked {
    int calls, wrong;
    const int *answers, *ends;
    const subdiv_mesh *limit;
} asked;

static int answer(void *user, int edge, const float *a, const float *middle, const float *b)
{
    asked *s = (asked *)user;
    const float *points = s->limit->positions;
    const int at[3] = { s->ends[2 * edge], 8 + edge, s->ends[2 * edge + 1] };
    const float *given[3] = { a, middle, b };
    s->wrong += edge != s->calls;
    for (int i = 0; i < 3; i++) s->wrong += furthest(given[i], points + 3 * at[i], 3) > 1e-6;
    return s->answers[s->calls++];
}

// What decides about an edge: the callback, edge_rates, the faces, rate.
static void test_rates(void)
{
    enum { EDGES = 12 };
    static const int face_rates[6] = { 0, 0, 0, 0, 5, 7 };
    static const int edge_rates[EDGES] = { 2, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 };
    static const int answers[EDGES] = { 4, 0, 6, 0, 0, 0, 0, 0, 0, 0, 0, 0 };
    int expected[EDGES], ends[2 * EDGES];
    test_cage c;
    plan p;
    subdiv_mesh fine, limit;
    subdiv_surface *surface;
    subdiv_options opt = {0};
    subdiv_tessellation how = {0};
    asked heard = {0};
    build_prism(&c, 4);
    opt.limit = 1;
    CHECK_EQUAL(subdiv_refine(&limit, &c.mesh, 1, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_prepare(&surface, &c.mesh, SUBDIV_EXACT, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_surface_edge_count(surface), EDGES);
    subdiv_surface_edges(surface, ends);

    for (int given = 0; given < 16; given++) {
        memset(&how, 0, sizeof how);
        if (given & 1) how.rate = 3;
        if (given & 2) how.face_rates = face_rates;
        if (given & 4) how.edge_rates = edge_rates;
        if (given & 8) how.edge_rate = answer;
        how.user = &heard;
        heard.calls = 0;
        heard.answers = answers;
        heard.ends = ends;
        heard.limit = &limit;
        order o;
        CHECK(order_make(&o, &c.mesh, 1, NULL));
        for (int e = 0; e < EDGES; e++) expected[e] = 0;
        for (int h = 0; h < 24 && (given & 2); h++)
            expected[o.face_edges[h]] = larger(expected[o.face_edges[h]], face_rates[h / 4]);
        for (int e = 0; e < EDGES; e++) {
            if (expected[e] == 0) expected[e] = given & 1 ? 3 : 1;
            if ((given & 4) && edge_rates[e]) expected[e] = edge_rates[e];
            if ((given & 8) && answers[e]) expected[e] = answers[e];
        }
        order_free(&o);
        plan_make(&p, &c.mesh, expected, given & 2 ? face_rates : NULL);
        subdiv_result r = subdiv_surface_tessellate(&fine, surface, c.positions, &how, NULL);
        CHECK_EQUAL(r, SUBDIV_OK);
        CHECK_EQUAL(heard.calls, given & 8 ? EDGES : 0);
        check_tessellation(&fine, &p, NULL);
        plan_free(&p);
        subdiv_mesh_free(&fine);
    }
    CHECK_EQUAL(heard.wrong, 0);
    subdiv_surface_free(surface);
    subdiv_mesh_free(&limit);
}

// The edges of random cages, as the order's own numbering has them.
static void test_edges(void)
{
    for (unsigned seed = 1; seed <= 100; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        const subdiv_mesh *m = &c->mesh;
        subdiv_surface *surface;
        order o;
        CHECK(order_make(&o, m, 1, NULL));
        CHECK_EQUAL(subdiv_prepare(&surface, m, SUBDIV_EXACT, NULL), SUBDIV_OK);
        int count = subdiv_surface_edge_count(surface), *ends = ints(2 * count);
        CHECK_EQUAL(count, o.edge_count);
        subdiv_surface_edges(surface, ends);
        for (int f = 0; f < m->face_count; f++)
            for (int i = 0; i < order_face_size(&o, f); i++) {
                int a = order_face_vertex(&o, f, i), b = order_face_vertex(&o, f, i + 1);
                const int *e = ends + 2 * o.face_edges[o.face_start[f] + i];
                CHECK(e[0] == (a < b ? a : b) && e[1] == (a < b ? b : a));
            }
        free(ends);
        order_free(&o);
        subdiv_surface_free(surface);
        random_cage_free(c);
    }
}

static void build_square(test_cage *c)
{
    static const int quad[4] = { 0, 1, 2, 3 };
    cage_clear(c, SUBDIV_CATMULL_CLARK);
    for (int k = 0; k < 4; k++) cage_vertex(c, k == 1 || k == 2, k >= 2, 0);
    cage_face(c, 4, quad);
}

// The picture in the header, face by face.
static void test_picture(void)
{
    static const int rates[4] = { 3, 4, 4, 4 };
    static const int sizes[21] = { 4, 4, 4, 4, 3, 3, 3, 3, 3, 3, 4, 4, 3, 3, 4, 4, 3, 3, 4, 4, 3 };
    static const int faces[] = {
        15, 16, 19, 18,  16, 17, 20, 19,  18, 19, 22, 21,  19, 20, 23, 22,
        0, 4, 15,  4, 16, 15,  4, 5, 16,  5, 17, 16,  5, 1, 17,
        1, 6, 17,  6, 7, 20, 17,  7, 8, 23, 20,  8, 2, 23,
        2, 9, 23,  9, 10, 22, 23,  10, 11, 21, 22,  11, 3, 21,
        3, 14, 21,  14, 13, 18, 21,  13, 12, 15, 18,  12, 0, 15 };
    test_cage c;
    subdiv_mesh fine;
    subdiv_tessellation how = {0};
    build_square(&c);
    how.edge_rates = rates;
    CHECK_EQUAL(subdiv_tessellate(&fine, &c.mesh, &how, NULL), SUBDIV_OK);
    CHECK_EQUAL(fine.vertex_count, 24);
    CHECK_EQUAL(fine.face_count, 21);
    CHECK_EQUAL(fine.face_size, 0);
    if (fine.face_count == 21 && fine.face_sizes) {
        CHECK(same_bytes(fine.face_sizes, sizes, 21, sizeof(int)));
        CHECK(same_bytes(fine.face_vertices, faces, (int)(sizeof faces / sizeof *faces),
                         sizeof(int)));
    }
    subdiv_mesh_free(&fine);
}

// Across a rate of 1 the two other sides of a quad are joined, whichever they are, without points
// inside: by as few triangles as there can be. Unless the face has a rate of its own.
static void test_rate_of_one(void)
{
    static const int rates[] = { 1, 2, 3, 4, 5, 7, 100, 101 };
    for (int i = 0; i < 256; i++) {
        const int face_rate = 3, first = rates[i % 8], second = rates[i / 8 % 8], turn = i / 64 % 2;
        const int r[4] = { turn ? 1 : first, turn ? first : 1, turn ? 1 : second, turn ? second : 1 };
        const int points = r[0] + r[1] + r[2] + r[3];
        test_cage c;
        plan p;
        subdiv_mesh fine;
        subdiv_tessellation how = {0};
        build_square(&c);
        how.edge_rates = r;
        how.triangles = 1;
        if (i >= 128) how.face_rates = &face_rate;
        plan_make(&p, &c.mesh, r, how.face_rates);
        CHECK_EQUAL(subdiv_tessellate(&fine, &c.mesh, &how, NULL), SUBDIV_OK);
        CHECK_EQUAL(fine.vertex_count, points + (i < 128 ? 0 : 4));
        if (i < 128) CHECK_EQUAL(fine.face_count, points - 2);
        check_tessellation(&fine, &p, NULL);
        subdiv_mesh_free(&fine);
        plan_free(&p);
    }
}

// One quad, one triangle, one pentagon with edges as different as can be.
static void test_extreme_rates(void)
{
    static const int rates[][5] = { { 300, 1, 7, 3, 2 },    { 1, 1, 1, 1, 1 }, { 2, 2, 2, 2, 2 },
                                    { 1, 1000, 1, 1000, 1 }, { 2, 2, 2, 1, 2 }, { 1, 1, 2, 1, 1 },
                                    { 99, 98, 3, 1, 57 },    { 3, 3, 3, 3, 3 }, { 3, 2, 3, 2, 3 } };
    for (int size = 3; size <= 5; size++) {
        for (int i = 0; i < 18; i++) {
            const int vertices[5] = { 0, 1, 2, 3, 4 }, face_rate = i >= 9 ? 1 + i % 9 : 0;
            test_cage c;
            plan p;
            subdiv_mesh fine;
            subdiv_tessellation how = {0};
            cage_clear(&c, size == 3 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK);
            for (int k = 0; k < size; k++) cage_vertex(&c, cos(1.2 * k), sin(1.2 * k), 0.1 * k);
            cage_face(&c, size, vertices);
            how.edge_rates = rates[i % 9];
            if (face_rate) how.face_rates = &face_rate;
            plan_make(&p, &c.mesh, rates[i % 9], &face_rate);
            CHECK_EQUAL(subdiv_tessellate(&fine, &c.mesh, &how, NULL), SUBDIV_OK);
            check_tessellation(&fine, &p, NULL);
            subdiv_mesh_free(&fine);
            plan_free(&p);
        }
    }
}

// ------------------------------------------------------------------------------ the whole surface

// A closed cage stays closed: each edge of the result has two faces that run along it in opposite
// directions, and the Euler characteristic is the cage's.
static void check_closed(const subdiv_mesh *cage, int euler)
{
    subdiv_surface *surface;
    subdiv_mesh fine;
    subdiv_tessellation how = {0};
    CHECK_EQUAL(subdiv_prepare(&surface, cage, SUBDIV_EXACT, NULL), SUBDIV_OK);
    int *rates = ints(subdiv_surface_edge_count(surface)), n = 0, edges = 0, alone = 0;
    for (int e = 0; e < subdiv_surface_edge_count(surface); e++) rates[e] = 2 + random_rate();
    how.edge_rates = rates;
    CHECK_EQUAL(subdiv_surface_tessellate(&fine, surface, cage->positions, &how, NULL), SUBDIV_OK);
    directed *all = (directed *)calloc((size_t)face_vertex_count(&fine) + 1, sizeof *all);
    const int *v = fine.face_vertices;
    for (int f = 0; f < fine.face_count; v += face_size(&fine, f++))
        for (int k = 0, size = face_size(&fine, f); k < size; k++)
            all[n++] = direct(v[k], v[(k + 1) % size]);
    qsort(all, (size_t)n, sizeof *all, compare_directed);
    for (int i = 0; i < n; i += 2, edges++)
        alone += i + 1 == n || all[i].low != all[i + 1].low || all[i].high != all[i + 1].high ||
                 all[i].way + all[i + 1].way != 0;
    CHECK_EQUAL(alone, 0);
    CHECK_EQUAL(fine.vertex_count - edges + fine.face_count, euler);
    subdiv_mesh_free(&fine);
    subdiv_surface_free(surface);
    free(all);
    free(rates);
}

static void test_closed(void)
{
    test_cage c;
    build_torus(&c, SUBDIV_CATMULL_CLARK, 4, 5);
    check_closed(&c.mesh, 0);
    build_torus(&c, SUBDIV_LOOP, 5, 4);
    check_closed(&c.mesh, 0);
    build_prism(&c, 5);
    check_closed(&c.mesh, 2);
    build_bipyramid(&c, SUBDIV_CATMULL_CLARK, 7);
    check_closed(&c.mesh, 2);
    build_icosahedron(&c, SUBDIV_LOOP);
    check_closed(&c.mesh, 2);
    build_pillow(&c, SUBDIV_LOOP);
    check_closed(&c.mesh, 2);
}

// Backwards, as if every job ran on a thread of its own.
static void run_backwards(void *user, void (*job)(void *context, int i), void *context, int count)
{
    (void)user;
    for (int i = count - 1; i >= 0; i--) job(context, i);
}

static int rate_by_length(void *user, int edge, const float *a, const float *middle, const float *b)
{
    double length = 0;
    (void)edge;
    for (int k = 0; k < 3; k++)
        length += fabs((double)(middle[k] - a[k])) + fabs((double)(b[k] - middle[k]));
    return 1 + (int)(length / *(const double *)user);
}

static void test_any_threads(void)
{
    for (unsigned seed = 1; seed <= 30; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        subdiv_mesh fine[2];
        subdiv_options opt = {0};
        subdiv_tessellation how = {0};
        double size = 0.05;
        how.edge_rate = rate_by_length;
        how.user = &size;
        for (int i = 0; i < 2; i++, opt.run = run_backwards)
            CHECK_EQUAL(subdiv_tessellate(&fine[i], &c->mesh, &how, &opt), SUBDIV_OK);
        CHECK(same_mesh(&fine[0], &fine[1]));
        CHECK(same_bytes(fine[0].normals, fine[1].normals, 3 * fine[0].vertex_count,
                         sizeof(float)));
        for (int i = 0; i < 2; i++) subdiv_mesh_free(&fine[i]);
        random_cage_free(c);
    }
}

// Vertices without faces stay, and cages of nothing else are themselves.
static void test_isolated(void)
{
    float positions[15] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 7, 8, 9, 0, 0, 1 };
    int triangle[3] = { 0, 1, 2 };
    for (int scheme = 0; scheme < 3; scheme++) {
        for (int faces = 0; faces < 2; faces++) {
            subdiv_mesh cage = {0}, fine;
            subdiv_tessellation how = {0};
            cage.scheme = (subdiv_scheme)scheme;
            cage.vertex_count = 5;
            cage.positions = positions;
            cage.face_count = faces;
            cage.face_size = 3;
            cage.face_vertices = triangle;
            how.rate = 4;
            CHECK_EQUAL(subdiv_tessellate(&fine, &cage, &how, NULL), SUBDIV_OK);
            CHECK_EQUAL(fine.face_count, !faces ? 0 : scheme == SUBDIV_LOOP ? 16 : 12);
            CHECK(same_bytes(fine.positions + 9, positions + 9, 6, sizeof(float)));
            CHECK_EQUAL(fine.normals[9] != 0 || fine.normals[10] != 0 || fine.normals[11] != 0, 0);
            subdiv_mesh_free(&fine);
        }
    }
}

// Coordinates near the largest float.
static void test_huge(void)
{
    test_cage c;
    subdiv_mesh small, huge;
    subdiv_tessellation how = {0};
    const float factor = 1.5e38f;
    build_prism(&c, 5);
    how.rate = 3;
    CHECK_EQUAL(subdiv_tessellate(&small, &c.mesh, &how, NULL), SUBDIV_OK);
    for (int i = 0; i < 3 * c.mesh.vertex_count; i++) c.positions[i] *= factor;
    CHECK_EQUAL(subdiv_tessellate(&huge, &c.mesh, &how, NULL), SUBDIV_OK);
    for (int i = 0; i < 3 * small.vertex_count; i++)
        CHECK_NEAR((double)huge.positions[i] / (double)factor, small.positions[i], 1e-5);
    CHECK_NEAR(furthest(huge.normals, small.normals, 3 * small.vertex_count), 0, 1e-4);
    subdiv_mesh_free(&small);
    subdiv_mesh_free(&huge);
}

// --------------------------------------------------------------------------------------- errors

static int minus_seven(void *user, int edge, const float *a, const float *middle, const float *b)
{
    (void)user;
    (void)a;
    (void)middle;
    (void)b;
    return edge == 5 ? -7 : 1;
}

typedef struct wrong {
    const char *name, *token;
    subdiv_result code;
    int face;
} wrong;

static void test_errors(void)
{
    static const wrong cases[] = { { "rate", "-1", SUBDIV_ERROR_ARGUMENT, -1 },
                                   { "edge", "edge 3: the rate is -2", SUBDIV_ERROR_ARGUMENT, -1 },
                                   { "face", "face 4: the rate is -3", SUBDIV_ERROR_ARGUMENT, 4 },
                                   { "asked", "edge 5: the rate is -7", SUBDIV_ERROR_ARGUMENT, -1 },
                                   { "huge edges", "vertices", SUBDIV_ERROR_TOO_LARGE, -1 },
                                   { "huge faces", "vertices", SUBDIV_ERROR_TOO_LARGE, -1 },
                                   { "many faces", "faces", SUBDIV_ERROR_TOO_LARGE, -1 } };
    static const int edge_rates[12] = { 1, 1, 1, -2 }, face_rates[6] = { 1, 1, 1, 1, -3, 1 };
    static const int huge[12] = { 1, 1, 1, 1, 1, 1, INT_MAX, INT_MAX };
    static const int largest[6] = { 1, INT_MAX, 1, 1, 1, 1 };
    test_cage c;
    build_prism(&c, 4);
    for (int i = 0; i < 7; i++) {
        subdiv_mesh fine;
        subdiv_error error = {0};
        subdiv_options opt = {0};
        subdiv_tessellation how = {0};
        memset(&fine, 0x55, sizeof fine);
        opt.error = &error;
        if (i == 0) how.rate = -1;
        if (i == 1) how.edge_rates = edge_rates;
        if (i == 2) how.face_rates = face_rates;
        if (i == 3) how.edge_rate = minus_seven;
        if (i == 4) how.edge_rates = huge;
        if (i == 5) how.face_rates = largest;
        if (i == 6) how.triangles = 1;
        if (i == 6) how.rate = 15000;                  // 1.35e9 points, 2.7e9 triangles
        test_context = cases[i].name;
        CHECK_EQUAL(subdiv_tessellate(&fine, &c.mesh, &how, &opt), cases[i].code);
        CHECK_EQUAL(error.code, cases[i].code);
        CHECK_EQUAL(error.face, cases[i].face);
        CHECK(strstr(error.message, cases[i].token) != NULL);
        CHECK(mesh_is_zero(&fine));
    }
}

// An n-gon and a triangle of rates whose squares do not fit in 64 bits.
static void test_too_large(void)
{
    for (int size = 3; size <= 5; size++) {
        const int vertices[5] = { 0, 1, 2, 3, 4 };
        test_cage c;
        subdiv_mesh fine;
        subdiv_tessellation how = {0};
        cage_clear(&c, size == 3 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK);
        for (int k = 0; k < size; k++) cage_vertex(&c, k, k * k, 0);
        cage_face(&c, size, vertices);
        for (how.rate = 70000; how.rate > 0 && how.rate <= INT_MAX / 2; how.rate *= 2)
            CHECK_EQUAL(subdiv_tessellate(&fine, &c.mesh, &how, NULL), SUBDIV_ERROR_TOO_LARGE);
        how.rate = INT_MAX;
        CHECK_EQUAL(subdiv_tessellate(&fine, &c.mesh, &how, NULL), SUBDIV_ERROR_TOO_LARGE);
    }
}

static void test_wrong_surfaces(void)
{
    test_cage c;
    subdiv_mesh fine;
    subdiv_surface *level, *values;
    build_prism(&c, 4);
    CHECK_EQUAL(subdiv_prepare(&level, &c.mesh, 2, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_prepare_face_varying(&values, &c.mesh, c.mesh.vertex_count,
                                            c.mesh.face_vertices, SUBDIV_UV_ALL, SUBDIV_EXACT,
                                            NULL), SUBDIV_OK);
    const subdiv_surface *surfaces[] = { level, values, NULL };
    for (int i = 0; i < 3; i++) {
        memset(&fine, 0x55, sizeof fine);
        CHECK_EQUAL(subdiv_surface_tessellate(&fine, surfaces[i], c.positions, NULL, NULL),
                    SUBDIV_ERROR_ARGUMENT);
        CHECK(mesh_is_zero(&fine));
    }
    CHECK_EQUAL(subdiv_tessellate(&c.mesh, &c.mesh, NULL, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_tessellate(NULL, &c.mesh, NULL, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_tessellate(&fine, NULL, NULL, NULL), SUBDIV_ERROR_ARGUMENT);
    c.positions[4] = (float)NAN;
    CHECK_EQUAL(subdiv_tessellate(&fine, &c.mesh, NULL, NULL), SUBDIV_ERROR_NOT_FINITE);
    CHECK(mesh_is_zero(&fine));
    subdiv_surface_free(level);
    subdiv_surface_free(values);
}

// A vertex has the same normal at any rate, also where the surface has no tangent plane.
static void test_vertex_normals(void)
{
    static const int rates[3] = { 1, 3, 8 };
    for (unsigned seed = 100; seed < 200; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        subdiv_mesh fine[3];
        for (int i = 0; i < 3; i++) {
            subdiv_tessellation how;
            memset(&how, 0, sizeof how);
            how.rate = rates[i];
            CHECK_EQUAL(subdiv_tessellate(&fine[i], &c->mesh, &how, NULL), SUBDIV_OK);
        }
        for (int i = 0; i < 2; i++)
            CHECK_NEAR(furthest(fine[i].normals, fine[2].normals, 3 * c->mesh.vertex_count), 0,
                       1e-3);
        for (int i = 0; i < 3; i++) subdiv_mesh_free(&fine[i]);
        random_cage_free(c);
    }
}

int main(void)
{
    RUN(test_random_cages);
    RUN(test_powers_of_two);
    RUN(test_normals);
    RUN(test_vertex_normals);
    RUN(test_straight_uvs);
    RUN(test_data_follows);
    RUN(test_uv_limit);
    RUN(test_statements);
    RUN(test_rates);
    RUN(test_edges);
    RUN(test_picture);
    RUN(test_rate_of_one);
    RUN(test_extreme_rates);
    RUN(test_closed);
    RUN(test_any_threads);
    RUN(test_isolated);
    RUN(test_huge);
    RUN(test_errors);
    RUN(test_too_large);
    RUN(test_wrong_surfaces);
    return test_end("test_tessellate");
}
