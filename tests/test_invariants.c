// What refinement must not change, over simple and many random cages: affine maps, planes, labels,
// winding, the Euler characteristic, manifolds, boundaries, one call or several, and its input.
//
//     cc -I. tests/test_invariants.c -o build/test_invariants -lm && build/test_invariants
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/same.h"
#include "lib/test.h"

// ----------------------------------------------------------------------------------- the cages

enum { FIXED_CAGES = 17 };

static void build_fixed(test_cage *c, int i)
{
    switch (i) {
    case 0: build_prism(c, 4); break;
    case 1: build_prism(c, 3); break;
    case 2: build_prism(c, 7); break;
    case 3: build_tetrahedron(c, SUBDIV_CATMULL_CLARK); break;
    case 4: build_tetrahedron(c, SUBDIV_LOOP); break;
    case 5: build_icosahedron(c, SUBDIV_LOOP); break;
    case 6: build_icosahedron(c, SUBDIV_BILINEAR); break;
    case 7: build_torus(c, SUBDIV_CATMULL_CLARK, 3, 3); break;
    case 8: build_torus(c, SUBDIV_LOOP, 4, 3); break;
    case 9: build_grid(c, SUBDIV_CATMULL_CLARK, 4, 3); break;
    case 10: build_grid(c, SUBDIV_LOOP, 3, 3); break;
    case 11: build_fan(c, SUBDIV_CATMULL_CLARK, 7, 1); break;
    case 12: build_fan(c, SUBDIV_LOOP, 9, 1); break;
    case 13: build_pillow(c, SUBDIV_CATMULL_CLARK); break;
    case 14: build_bipyramid(c, SUBDIV_LOOP, 4); break;
    case 15: build_bow_tie(c, SUBDIV_CATMULL_CLARK); break;
    default: build_fins(c, SUBDIV_CATMULL_CLARK, 3, 2); break;
    }
}

// Checks the simple cages and so many random ones.
static void for_cages(unsigned count, int features, void (*check)(const subdiv_mesh *, unsigned))
{
    static test_cage fixed;
    static char context[64];
    test_context = context;
    for (unsigned i = 0; i < FIXED_CAGES; i++) {
        sprintf(context, "simple cage %u", i);
        build_fixed(&fixed, (int)i);
        check(&fixed.mesh, i);
    }
    for (unsigned seed = 1; seed <= count; seed++) {
        random_cage *c = random_cage_new(seed, features);
        if (!c) abort();
        sprintf(context, "random cage %u", seed);
        check(&c->mesh, seed);
        random_cage_free(c);
    }
}

// Refines with holes kept, so that the result has all its faces.
static int refine(subdiv_mesh *fine, const subdiv_mesh *m, int levels)
{
    subdiv_options opt = {0};
    opt.keep_holes = 1;
    CHECK_EQUAL(subdiv_refine(fine, m, levels, &opt), SUBDIV_OK);
    return fine->vertex_count > 0;
}

// --------------------------------------------------------------------------- how exact floats are

static double largest(const float *values, int count)
{
    double most = 0;
    for (int i = 0; i < count; i++) most = fmax(most, fabs((double)values[i]));
    return most;
}

// How far one refinement can be from the exact one. Each point is an average with weights that are
// not negative, so no level makes coordinates larger. An average of k numbers up to m, whether of
// the numbers or of their differences up to 2 m, is wrong by at most (k + 2) 2 m 2^-24 in floats:
// k roundings of sums, one each of weights and products. k is no more than the vertices of all the
// faces at a vertex, counting at least 4 for each, as these faces have after a level. The errors
// of the levels add up.
static double float_error(const subdiv_mesh *m, int levels)
{
    int most = 16, *terms = int_array(m->vertex_count, 0);
    for (int f = 0; f < m->face_count; f++) {
        int size = face_size(m, f), counts = size < 4 ? 4 : size;
        if (counts > most) most = counts;
        for (int i = 0; i < size; i++) terms[face_vertices(m, f)[i]] += counts;
    }
    for (int v = 0; v < m->vertex_count; v++) if (terms[v] > most) most = terms[v];
    free(terms);
    return levels * (most + 2) * 2 * largest(m->positions, 3 * m->vertex_count) / (1 << 24);
}

// ------------------------------------------------------------------------------- affine maps

// Translations, linear maps and their sums go through refinement unchanged. The third map flattens
// the cage to a plane, the fourth to a point: a plane stays that plane, and weights sum to 1.
static const struct { double a[9], t[3]; } maps[] = {
    {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {3, -7, 20}},
    {{0.5, -1, 2, 0.25, 1.5, -0.75, -1, 0.3, 0.2}, {0, 1, -2}},
    {{1, 0, 0, 0, 1, 0, 0.5, -1, 0}, {0, 0, 0.25}},
    {{0, 0, 0, 0, 0, 0, 0, 0, 0}, {1, -2, 3}}
};

static double mapped(int map, const float *p, int d)
{
    double sum = maps[map].t[d];
    for (int i = 0; i < 3; i++) sum += maps[map].a[3 * d + i] * (double)p[i];
    return sum;
}

static void check_affine(const subdiv_mesh *m, unsigned seed)
{
    int levels = 1 + (int)(seed % 3), map = (int)(seed / 3 % 4);
    subdiv_mesh moved = *m, fine = {0}, other = {0};
    float *positions = malloc(sizeof(float) * 3 * (size_t)m->vertex_count);
    double allowed, norm = 0;
    if (!positions) abort();
    for (int i = 0; i < 3 * m->vertex_count; i++)
        positions[i] = (float)mapped(map, m->positions + i / 3 * 3, i % 3);
    moved.positions = positions;
    for (int d = 0; d < 3; d++) {
        const double *a = maps[map].a + 3 * d;
        norm = fmax(norm, fabs(a[0]) + fabs(a[1]) + fabs(a[2]));
    }
    // Either result has its error, the first one magnified; the moved cage is rounded to floats.
    allowed = norm * float_error(m, levels) + float_error(&moved, levels)
            + largest(positions, 3 * m->vertex_count) / (1 << 24);
    if (refine(&fine, m, levels) && refine(&other, &moved, levels)) {
        CHECK_EQUAL(fine.vertex_count, other.vertex_count);
        for (int i = 0; i < 3 * fine.vertex_count; i++)
            CHECK_NEAR(other.positions[i], mapped(map, fine.positions + i / 3 * 3, i % 3), allowed);
    }
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&other);
    free(positions);
}

static void test_affine_maps(void)
{
    for_cages(240, RANDOM_ALL, check_affine);
}

// ------------------------------------------------------------------------------ comparing results

// Takes down where a point goes; a point that has gone elsewhere already is an error.
static void map_point(int *map, int from, int to)
{
    if (map[from] >= 0 && map[from] != to)
        TEST_REPORT("point %d is both %d and %d of the other", from, map[from], to);
    map[from] = to;
}

// The same sharpness at the edges and vertices that the map says are the same.
static void check_same_sharpness(const subdiv_mesh *a, const subdiv_mesh *b, const int *map)
{
    edge_list e = edges_make(a), g = edges_make(b);
    float *of_a = calloc((size_t)e.count + 1, sizeof *of_a);
    float *of_b = calloc((size_t)g.count + 1, sizeof *of_b);
    if (!of_a || !of_b) abort();
    for (int i = 0; i < a->crease_count; i++) {
        int at = edges_find(&e, a->crease_vertices[2 * i], a->crease_vertices[2 * i + 1]);
        if (at >= 0) of_a[at] = a->crease_sharpness[i];
        else TEST_REPORT("crease %d is no edge", i);
    }
    for (int i = 0; i < b->crease_count; i++) {
        int at = edges_find(&g, b->crease_vertices[2 * i], b->crease_vertices[2 * i + 1]);
        if (at >= 0) of_b[at] = b->crease_sharpness[i];
        else TEST_REPORT("crease %d of the other is no edge", i);
    }
    CHECK_EQUAL(e.count, g.count);
    for (int i = 0; i < e.count; i++) {
        int at = edges_find(&g, map[e.ends[2 * i]], map[e.ends[2 * i + 1]]);
        if (at < 0) TEST_REPORT("edge %d %d is missing", e.ends[2 * i], e.ends[2 * i + 1]);
        else CHECK_NEAR(of_a[i], of_b[at], 1e-5);
    }
    CHECK_EQUAL(a->corner_count, b->corner_count);
    for (int i = 0; i < a->corner_count; i++)
        CHECK_NEAR(corner_sharpness(a, a->corner_vertices[i]),
                   corner_sharpness(b, map[a->corner_vertices[i]]), 1e-6);
    edges_free(&e), edges_free(&g);
    free(of_a), free(of_b);
}

// The same points, where the map says, one to one; the second mesh may be mirrored.
static void check_same_points(const subdiv_mesh *a, const subdiv_mesh *b, const int *map,
                              int mirrored, double allowed)
{
    int *hit = int_array(b->vertex_count, 0);
    CHECK_EQUAL(a->vertex_count, b->vertex_count);
    for (int v = 0; v < a->vertex_count; v++) {
        const float *p = a->positions + 3 * v, *q = b->positions + 3 * map[v];
        if (map[v] < 0 || map[v] >= b->vertex_count || hit[map[v]]++) {
            TEST_REPORT("point %d has no point of its own", v);
            continue;
        }
        CHECK_NEAR(mirrored ? -p[0] : p[0], q[0], allowed);
        CHECK_NEAR(p[1], q[1], allowed);
        CHECK_NEAR(p[2], q[2], allowed);
    }
    free(hit);
}

// ------------------------------------------------------------------------- labels and winding

// Another way to write down the same cage.
typedef struct labels {
    int vertex[CAGE_VERTICES], face[CAGE_FACES];       // the new numbers
    int turn[CAGE_FACES];                              // old place of the new first vertex
    int flip;                                          // mirrored at x = 0, faces wound back
} labels;

static unsigned random_number(unsigned *state, int below)
{
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) % (unsigned)below;
}

static void shuffle(int *a, int count, unsigned *state)
{
    for (int i = 0; i < count; i++) a[i] = i;
    for (int i = count - 1; i > 0; i--) {
        int j = (int)random_number(state, i + 1), t = a[i];
        a[i] = a[j], a[j] = t;
    }
}

static void relabel_faces(test_cage *to, const subdiv_mesh *m, const labels *l)
{
    int old[CAGE_FACES], q[CAGE_FACE_VERTICES];
    for (int f = 0; f < m->face_count; f++) old[l->face[f]] = f;
    for (int i = 0; i < m->face_count; i++) {
        int f = old[i], size = face_size(m, f);
        for (int j = 0; j < size; j++) {
            int from = l->turn[f] + (l->flip ? size - j : j);
            q[j] = l->vertex[face_vertices(m, f)[from % size]];
        }
        cage_face(to, size, q);
    }
}

static void relabel(test_cage *to, const subdiv_mesh *m, const labels *l)
{
    cage_clear(to, m->scheme);
    to->mesh.boundary = m->boundary;
    to->mesh.creasing = m->creasing;
    to->mesh.triangles = m->triangles;
    to->mesh.vertex_count = m->vertex_count;
    for (int v = 0; v < m->vertex_count; v++)
        for (int d = 0; d < 3; d++)
            to->positions[3 * l->vertex[v] + d] = (l->flip && d == 0 ? -1.0f : 1.0f)
                                                * m->positions[3 * v + d];
    relabel_faces(to, m, l);
    for (int i = 0; i < m->crease_count; i++)
        cage_crease(to, l->vertex[m->crease_vertices[2 * i + 1]],
                    l->vertex[m->crease_vertices[2 * i]], (double)m->crease_sharpness[i]);
    for (int i = 0; i < m->corner_count; i++)
        cage_corner(to, l->vertex[m->corner_vertices[i]], (double)m->corner_sharpness[i]);
    for (int i = 0; i < m->hole_count; i++) cage_hole(to, l->face[m->holes[i]]);
}

// Where each point of one result is in the other.
static void map_labels(int *map, const subdiv_mesh *m, const subdiv_mesh *other, const labels *l,
                       int levels)
{
    order o, p;
    CHECK(order_make(&o, m, levels, NULL));
    CHECK(order_make(&p, other, levels, NULL));
    for (int v = 0; v < m->vertex_count; v++) map[v] = l->vertex[v];
    for (int f = 0; f < m->face_count; f++) {
        order_place at = {0, 0, 0, 0, 0};
        at.face = f;
        do {
            order_place to = at;
            to.face = l->face[f];
            for (int i = 0; i < l->turn[f]; i++) to = place_rotate(&p, to);
            if (l->flip) to = place_flip(&p, to);
            map_point(map, place_point(&o, at), place_point(&p, to));
        } while (place_next_point(&o, &at));
    }
    order_free(&o), order_free(&p);
}

static void check_labels(const subdiv_mesh *m, unsigned seed)
{
    static test_cage other;
    static labels l;
    int levels = 1 + (int)(seed % 2), *map;
    unsigned state = seed;
    subdiv_mesh fine = {0}, fine_other = {0};
    shuffle(l.vertex, m->vertex_count, &state);
    shuffle(l.face, m->face_count, &state);
    for (int f = 0; f < m->face_count; f++)
        l.turn[f] = (int)random_number(&state, face_size(m, f));
    l.flip = (int)random_number(&state, 2);
    relabel(&other, m, &l);
    if (refine(&fine, m, levels) && refine(&fine_other, &other.mesh, levels)) {
        map = int_array(fine.vertex_count, -1);
        map_labels(map, m, &other.mesh, &l, levels);
        check_same_points(&fine, &fine_other, map, l.flip, 2 * float_error(m, levels));
        check_same_sharpness(&fine, &fine_other, map);
        CHECK_EQUAL(fine.hole_count, fine_other.hole_count);
        free(map);
    }
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&fine_other);
}

static void test_labels_and_winding(void)
{
    for_cages(300, RANDOM_ALL & ~RANDOM_DEGENERATE, check_labels);
}

// The vertex at the mirrored position, which must be there.
static int mirror_vertex(const subdiv_mesh *m, int v, double allowed)
{
    const float *p = m->positions + 3 * v;
    for (int w = 0; w < m->vertex_count; w++) {
        const float *q = m->positions + 3 * w;
        double off = fmax(fabs((double)p[0] + (double)q[0]), fabs((double)p[1] - (double)q[1]));
        if (fmax(off, fabs((double)p[2] - (double)q[2])) <= allowed) return w;
    }
    TEST_REPORT("vertex %d has no mirror image", v);
    return v;
}

// Tags every fourth edge and vertex, and their mirror images alike.
static void tag_symmetrically(test_cage *c)
{
    edge_list e = edges_make(&c->mesh);
    for (int i = 0; i < e.count; i += 4) {
        int a = e.ends[2 * i], b = e.ends[2 * i + 1];
        double sharpness = 0.4 + 0.7 * (i % 5);
        cage_crease(c, a, b, sharpness);
        cage_crease(c, mirror_vertex(&c->mesh, a, 1e-6), mirror_vertex(&c->mesh, b, 1e-6),
                    sharpness);
    }
    for (int v = 0; v < c->mesh.vertex_count; v += 4) {
        cage_corner(c, v, 0.3 + v % 3);
        cage_corner(c, mirror_vertex(&c->mesh, v, 1e-6), 0.3 + v % 3);
    }
    edges_free(&e);
}

// A cage that is its own mirror image refines to its own mirror image.
static void test_mirror_symmetry(void)
{
    static test_cage c;
    for (int i = 0; i < 16; i++) {
        subdiv_mesh fine = {0};
        switch (i / 2) {
        case 0: build_torus(&c, SUBDIV_CATMULL_CLARK, 6, 3); break;
        case 1: build_torus(&c, SUBDIV_CATMULL_CLARK, 4, 5); break;
        case 2: build_bipyramid(&c, SUBDIV_CATMULL_CLARK, 6); break;
        case 3: build_bipyramid(&c, SUBDIV_LOOP, 10); break;
        case 4: build_fan(&c, SUBDIV_CATMULL_CLARK, 6, 1); break;
        case 5: build_fan(&c, SUBDIV_LOOP, 8, 1); break;
        case 6: build_fan(&c, SUBDIV_LOOP, 5, 0); break;
        default: build_prism(&c, 8); break;
        }
        c.mesh.creasing = i % 2 ? SUBDIV_CREASING_CHAIKIN : SUBDIV_CREASING_UNIFORM;
        tag_symmetrically(&c);
        if (!refine(&fine, &c.mesh, 2)) continue;
        for (int v = 0; v < fine.vertex_count; v++) mirror_vertex(&fine, v, 2e-6);
        subdiv_mesh_free(&fine);
    }
}

// ---------------------------------------------------------------------------------- topology

// Is there what a result cannot tell the next call? That is an edge of two faces that are wound
// against each other, and, under Loop, two triangles with the same three vertices: each would have
// edges of its own between the three edge points, but to the next call these look shared.
static int has_hidden_edges(const subdiv_mesh *m)
{
    edge_list e = edges_make(m);
    int found = 0;
    for (int i = 0; i < e.count; i++)
        found |= e.faces[i] == 2 && (e.half[2 * i] < 0 || e.half[2 * i + 1] < 0);
    edges_free(&e);
    for (int f = 0; f < m->face_count && m->scheme == SUBDIV_LOOP; f++) {
        const int *q = face_vertices(m, f);
        for (int g = 0; g < f; g++)
            found |= face_has(m, g, q[0]) && face_has(m, g, q[1]) && face_has(m, g, q[2]);
    }
    return found;
}

static int euler_characteristic(const subdiv_mesh *m)
{
    edge_list e = edges_make(m);
    int result = m->vertex_count - e.count + m->face_count;
    edges_free(&e);
    return result;
}

static int boundary_length(const subdiv_mesh *m)
{
    edge_list e = edges_make(m);
    int result = boundary_edge_count(&e);
    edges_free(&e);
    return result;
}

static void check_topology(const subdiv_mesh *m, unsigned seed)
{
    int euler = euler_characteristic(m), boundary = boundary_length(m), manifold = is_manifold(m);
    (void)seed;
    if (has_hidden_edges(m)) return;
    for (int levels = 0; levels <= 3; levels++) {
        int split = m->scheme == SUBDIV_LOOP ? 4 * m->face_count : face_vertex_count(m);
        subdiv_mesh fine = {0};
        if (!refine(&fine, m, levels)) return;
        if (levels == 0) CHECK_EQUAL(fine.face_count, m->face_count);
        else CHECK_EQUAL(fine.face_count, split << 2 * (levels - 1));
        CHECK_EQUAL(euler_characteristic(&fine), euler);
        CHECK_EQUAL(boundary_length(&fine), boundary << levels);
        CHECK_EQUAL(is_manifold(&fine), manifold);
        subdiv_mesh_free(&fine);
    }
}

static void test_topology(void)
{
    for_cages(200, RANDOM_ALL & ~RANDOM_DEGENERATE, check_topology);
}

// ----------------------------------------------------------------------- one call or several

// Where each point of b levels over a levels is in the result of a + b levels at once.
static void map_steps(int *map, const subdiv_mesh *m, int a, const subdiv_mesh *middle, int b)
{
    order whole, first, second;
    int at = 0;
    CHECK(order_make(&whole, m, a + b, NULL));
    CHECK(order_make(&first, m, a, NULL));
    CHECK(order_make(&second, middle, b, NULL));
    for (int v = 0; v < m->vertex_count; v++) map[v] = v;
    for (int f = 0; f < m->face_count; f++) {
        order_place face = {0, 0, 0, 0, 0};
        face.face = f;
        do {
            order_place p = {0, 0, 0, 0, 0};
            p.face = at++;
            do {
                order_place to = place_within(face, 1 << b, p.row, p.column);
                map_point(map, place_point(&second, p), place_point(&whole, to));
            } while (place_next_point(&second, &p));
        } while (place_next_face(&first, &face));
    }
    order_free(&whole), order_free(&first), order_free(&second);
}

// Hole by hole of the cage, as many faces marked as holes.
static void check_same_holes(const subdiv_mesh *m, const subdiv_mesh *middle,
                             const subdiv_mesh *steps, const subdiv_mesh *whole)
{
    int *count = int_array(m->face_count, 0);
    CHECK_EQUAL(steps->hole_count, whole->hole_count);
    for (int i = 0; i < steps->hole_count; i++)
        count[middle->cage_faces[steps->cage_faces[steps->holes[i]]]]++;
    for (int i = 0; i < whole->hole_count; i++) count[whole->cage_faces[whole->holes[i]]]--;
    for (int f = 0; f < m->face_count; f++) CHECK_EQUAL(count[f], 0);
    free(count);
}

static void check_steps(const subdiv_mesh *m, unsigned seed)
{
    int a = 1 + (int)(seed % 2), b = 1 + (int)(seed / 2 % 2), *map;
    subdiv_mesh middle = {0}, steps = {0}, whole = {0};
    if (has_hidden_edges(m)) return;
    if (refine(&middle, m, a) && refine(&steps, &middle, b) && refine(&whole, m, a + b)) {
        map = int_array(steps.vertex_count, -1);
        map_steps(map, m, a, &middle, b);
        check_same_points(&steps, &whole, map, 0, 2 * float_error(m, a + b));
        check_same_sharpness(&steps, &whole, map);
        check_same_holes(m, &middle, &steps, &whole);
        free(map);
    }
    subdiv_mesh_free(&middle);
    subdiv_mesh_free(&steps);
    subdiv_mesh_free(&whole);
}

static void test_steps(void)
{
    for_cages(300, RANDOM_ALL & ~RANDOM_DEGENERATE, check_steps);
}

static int same_result(const subdiv_mesh *a, const subdiv_mesh *b)
{
    return same_mesh(a, b) && same_bytes(a->cage_faces, b->cage_faces, a->face_count, sizeof(int));
}

// prepare does not need the positions, and surface_mesh takes any.
static void check_prepared(const subdiv_mesh *m, unsigned seed)
{
    int levels = (int)(seed % 4);
    subdiv_surface *surface = NULL;
    subdiv_options opt = {0};
    subdiv_mesh bare = *m, moved = *m;
    float *positions = malloc(sizeof(float) * 3 * (size_t)m->vertex_count);
    if (!positions) abort();
    for (int i = 0; i < 3 * m->vertex_count; i++)
        positions[i] = m->positions[i] * m->positions[i] - 0.3f * (float)(i % 5);
    moved.positions = positions;
    bare.positions = NULL;
    opt.keep_holes = (int)(seed / 4 % 2);
    CHECK_EQUAL(subdiv_prepare(&surface, &bare, levels, &opt), SUBDIV_OK);
    for (int round = 0; round < 3 && surface; round++) {
        const subdiv_mesh *from = round == 1 ? &moved : m;
        subdiv_mesh one = {0}, two = {0};
        CHECK_EQUAL(subdiv_surface_mesh(&one, surface, from->positions, &opt), SUBDIV_OK);
        CHECK_EQUAL(subdiv_refine(&two, from, levels, &opt), SUBDIV_OK);
        CHECK(one.vertex_count >= m->vertex_count);
        CHECK(same_result(&one, &two));
        subdiv_mesh_free(&one);
        subdiv_mesh_free(&two);
        CHECK(mesh_is_zero(&one));
    }
    subdiv_surface_free(surface);
    free(positions);
}

static void test_prepared(void)
{
    for_cages(200, RANDOM_ALL, check_prepared);
}

// Level 0: the cage itself, each face a part of itself.
static void check_copy(const subdiv_mesh *m, unsigned seed)
{
    subdiv_mesh copy = {0};
    edge_list e = edges_make(m);
    (void)seed;
    if (refine(&copy, m, 0)) {
        CHECK_EQUAL(copy.vertex_count, m->vertex_count);
        CHECK_EQUAL(copy.face_count, m->face_count);
        CHECK(same_bytes(copy.positions, m->positions, 3 * m->vertex_count, sizeof(float)));
        CHECK(same_bytes(copy.face_vertices, m->face_vertices, face_vertex_count(m), sizeof(int)));
        for (int f = 0; f < m->face_count; f++) {
            CHECK_EQUAL(face_size(&copy, f), face_size(m, f));
            CHECK_EQUAL(copy.cage_faces[f], f);
            if (is_hole(m, f)) CHECK(is_hole(&copy, f));
        }
        for (int i = 0; i < e.count; i++) {
            int a = e.ends[2 * i], b = e.ends[2 * i + 1];
            if (a != b && e.faces[i] == 2)
                CHECK_NEAR(crease_sharpness(&copy, a, b), crease_sharpness(m, a, b), 0);
        }
        for (int v = 0; v < m->vertex_count; v++)
            if (corner_sharpness(m, v) > 0)
                CHECK_NEAR(corner_sharpness(&copy, v), corner_sharpness(m, v), 0);
        CHECK_EQUAL(copy.scheme, m->scheme);
        CHECK_EQUAL(copy.boundary, m->boundary);
        CHECK_EQUAL(copy.creasing, m->creasing);
        CHECK_EQUAL(copy.triangles, m->triangles);
    }
    subdiv_mesh_free(&copy);
    edges_free(&e);
}

static void test_level_zero(void)
{
    for_cages(200, RANDOM_ALL & ~(RANDOM_NONMANIFOLD | RANDOM_DEGENERATE), check_copy);
}

// --------------------------------------------------------------------------------- the input

static unsigned long long checksum(const void *bytes, size_t size, unsigned long long sum)
{
    const unsigned char *b = bytes;
    for (size_t i = 0; i < size; i++) sum = (sum ^ b[i]) * 1099511628211u;
    return sum;
}

static unsigned long long mesh_checksum(const subdiv_mesh *m)
{
    unsigned long long sum = checksum(m, sizeof *m, 14695981039346656037u);
    sum = checksum(m->positions, sizeof(float) * 3 * (size_t)m->vertex_count, sum);
    if (m->face_sizes) sum = checksum(m->face_sizes, sizeof(int) * (size_t)m->face_count, sum);
    sum = checksum(m->face_vertices, sizeof(int) * (size_t)face_vertex_count(m), sum);
    sum = checksum(m->crease_vertices, sizeof(int) * 2 * (size_t)m->crease_count, sum);
    sum = checksum(m->crease_sharpness, sizeof(float) * (size_t)m->crease_count, sum);
    sum = checksum(m->corner_vertices, sizeof(int) * (size_t)m->corner_count, sum);
    sum = checksum(m->corner_sharpness, sizeof(float) * (size_t)m->corner_count, sum);
    return checksum(m->holes, sizeof(int) * (size_t)m->hole_count, sum);
}

static void check_untouched(const subdiv_mesh *m, unsigned seed)
{
    unsigned long long before = mesh_checksum(m);
    subdiv_mesh fine = {0};
    CHECK_EQUAL(subdiv_refine(&fine, m, (int)(seed % 4), NULL), SUBDIV_OK);
    subdiv_mesh_free(&fine);
    CHECK(mesh_checksum(m) == before);
}

static void test_cage_untouched(void)
{
    for_cages(200, RANDOM_ALL, check_untouched);
}

int main(void)
{
    RUN(test_affine_maps);
    RUN(test_labels_and_winding);
    RUN(test_mirror_symmetry);
    RUN(test_topology);
    RUN(test_steps);
    RUN(test_prepared);
    RUN(test_level_zero);
    RUN(test_cage_untouched);
    return test_end("invariants");
}
