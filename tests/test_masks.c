// The masks, measured. With one coordinate 1 at one vertex of a cage and 0 at all others, the
// refined coordinate of a point is the weight of that vertex in its mask. Three coordinates measure
// three vertices at once, so a few refinements give the whole matrix of weights, which is compared
// with the formulas of the literature written out below.
//
//     cc -I. tests/test_masks.c -o build/test_masks -lm && build/test_masks
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/test.h"

static test_cage cage;

// ----------------------------------------------------------------------------------- measuring

// What one level makes of a mesh. expect is the mask being put together for the next check.
static struct {
    const subdiv_mesh *mesh;
    edge_list edges;
    subdiv_mesh fine;
    int    rows;
    float *weights;                   // [rows][mesh->vertex_count]
    double expect[4 * CAGE_VERTICES];
} probe;

static void probe_end(void)
{
    edges_free(&probe.edges);
    subdiv_mesh_free(&probe.fine);
    free(probe.weights);
    memset(&probe, 0, sizeof probe);
}

// The weights of every point sum to 1.
static void check_sums(void)
{
    for (int row = 0; row < probe.rows; row++) {
        double sum = 0;
        for (int v = 0; v < probe.mesh->vertex_count; v++)
            sum += (double)probe.weights[row * probe.mesh->vertex_count + v];
        CHECK_NEAR(sum, 1, 1e-6);
    }
}

// Measures the weights of one level of a mesh that stays in place until probe_end.
static void probe_start(const subdiv_mesh *m)
{
    subdiv_mesh unit = *m;
    int columns = m->vertex_count;
    if (columns > 4 * CAGE_VERTICES) abort();
    probe.mesh = m;
    probe.edges = edges_make(m);
    unit.positions = malloc(sizeof(float) * 3 * (size_t)columns);
    if (!unit.positions) abort();
    for (int v = 0; v < columns; v += 3) {
        memset(unit.positions, 0, sizeof(float) * 3 * (size_t)columns);
        for (int d = 0; d < 3 && v + d < columns; d++) unit.positions[3 * (v + d) + d] = 1;
        subdiv_mesh_free(&probe.fine);
        CHECK_EQUAL(subdiv_refine(&probe.fine, &unit, 1, NULL), SUBDIV_OK);
        probe.rows = probe.fine.vertex_count;
        if (!probe.weights)
            probe.weights = calloc((size_t)(probe.rows * columns + 1), sizeof(float));
        for (int row = 0; row < probe.rows; row++)
            for (int d = 0; d < 3 && v + d < columns; d++)
                probe.weights[row * columns + v + d] = probe.fine.positions[3 * row + d];
    }
    free(unit.positions);
    check_sums();
}

// Compares a measured row with the mask in expect, and starts a new mask. A measured weight may be
// the sum of as many floats as the mask has weights, each rounded by 3e-8 at most.
static void check_row(const char *what, int at, int row)
{
    int columns = probe.mesh->vertex_count, terms = 0;
    for (int v = 0; v < columns; v++) terms += probe.expect[v] != 0;
    if (row < 0 || row >= probe.rows) TEST_REPORT("%s %d: no point %d", what, at, row);
    else {
        for (int v = 0; v < columns; v++) {
            double is = (double)probe.weights[row * columns + v];
            if (!(fabs(is - probe.expect[v]) <= fmax(1e-7, terms * 3e-8)))
                TEST_REPORT("%s %d: the weight of vertex %d is %.9g, not %.9g", what, at, v, is,
                            probe.expect[v]);
        }
    }
    memset(probe.expect, 0, sizeof probe.expect);
}

static void check_vertex(int v)
{
    check_row("vertex point", v, v);
}

// The number that one level gives to the edge point.
static int edge_point(int a, int b)
{
    return probe.mesh->vertex_count + edges_find(&probe.edges, a, b);
}

static void check_edge(int a, int b)
{
    check_row("edge point", edges_find(&probe.edges, a, b), edge_point(a, b));
}

// A face has one point inside, its face point.
static void check_face(int f)
{
    check_row("face point", f, probe.mesh->vertex_count + probe.edges.count + f);
}

// -------------------------------------------------------------------- the masks of the literature
// Each adds its mask, times a factor, to what is expected.

static void add_vertex(double factor, int v)
{
    probe.expect[v] += factor;
}

// The average of the vertices of the face [CC78].
static void add_face_point(double factor, int f)
{
    int size = face_size(probe.mesh, f);
    for (int i = 0; i < size; i++) add_vertex(factor / size, face_vertices(probe.mesh, f)[i]);
}

static void add_edge_middle(double factor, int a, int b)
{
    add_vertex(factor / 2, a);
    add_vertex(factor / 2, b);
}

// The vertex of a triangle that is on neither end of an edge.
static void add_opposite(double factor, int f, int a, int b)
{
    for (int i = 0; i < 3; i++) {
        int v = face_vertices(probe.mesh, f)[i];
        if (v != a && v != b) add_vertex(factor, v);
    }
}

// Catmull-Clark: the average of the ends and the two face points [CC78].
// Loop: 3/8 of the ends, 1/8 of the opposite vertices [Loop87].
static void add_smooth_edge(double factor, int a, int b)
{
    int loop = probe.mesh->scheme == SUBDIV_LOOP;
    double end = loop ? 3.0 / 8 : 1.0 / 4;
    add_vertex(factor * end, a);
    add_vertex(factor * end, b);
    for (int f = 0; f < probe.mesh->face_count; f++) {
        if (!face_has(probe.mesh, f, a) || !face_has(probe.mesh, f, b)) continue;
        if (loop) add_opposite(factor / 8, f, a, b);
        else add_face_point(factor / 4, f);
    }
}

static int valence(int v)
{
    int n = 0;
    for (int i = 0; i < 2 * probe.edges.count; i++) n += probe.edges.ends[i] == v;
    return n;
}

// (F + 2 R + (n - 3) V) / n: F the average of the face points, R that of the middles of the edges,
// n the valence [CC78].
static void add_catmull_clark_vertex(double factor, int v)
{
    int n = valence(v);
    const int *ends = probe.edges.ends;
    for (int f = 0; f < probe.mesh->face_count; f++)
        if (face_has(probe.mesh, f, v)) add_face_point(factor / n / n, f);
    for (int e = 0; e < probe.edges.count; e++)
        if (ends[2 * e] == v || ends[2 * e + 1] == v)
            add_edge_middle(factor * 2 / n / n, ends[2 * e], ends[2 * e + 1]);
    add_vertex(factor * (n - 3) / n, v);
}

// (1 - n beta) V + beta times each neighbour, beta = (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n, n the
// valence [Loop87].
static void add_loop_vertex(double factor, int v)
{
    int n = valence(v);
    const int *ends = probe.edges.ends;
    double c = 3.0 / 8 + cos(8 * atan(1.0) / n) / 4, beta = (5.0 / 8 - c * c) / n;
    add_vertex(factor * (1 - n * beta), v);
    for (int e = 0; e < probe.edges.count; e++)
        if (ends[2 * e] == v || ends[2 * e + 1] == v)
            add_vertex(factor * beta, ends[2 * e] == v ? ends[2 * e + 1] : ends[2 * e]);
}

static void add_smooth_vertex(double factor, int v)
{
    if (probe.mesh->scheme == SUBDIV_LOOP) add_loop_vertex(factor, v);
    else add_catmull_clark_vertex(factor, v);
}

// The cubic B-spline along the crease that runs from a over v to b [HDD94].
static void add_crease_vertex(double factor, int v, int a, int b)
{
    add_vertex(factor / 8, a);
    add_vertex(factor * 3 / 4, v);
    add_vertex(factor / 8, b);
}

// ------------------------------------------------------------------- meshes without any sharpness

static int count_faces_at(int v)
{
    int n = 0;
    for (int f = 0; f < probe.mesh->face_count; f++) n += face_has(probe.mesh, f, v);
    return n;
}

// The vertex point of a vertex of a manifold mesh without sharpness, boundary rule edge.
static void check_untagged_vertex(int v)
{
    int ends[2] = {-1, -1}, found = 0;
    if (count_faces_at(v) == 0) {
        add_vertex(1, v);
        check_vertex(v);
        return;
    }
    for (int e = 0; e < probe.edges.count; e++) {
        const int *q = probe.edges.ends + 2 * e;
        if (probe.edges.faces[e] == 1 && (q[0] == v || q[1] == v) && found < 2)
            ends[found++] = q[0] == v ? q[1] : q[0];
    }
    if (found) add_crease_vertex(1, v, ends[0], ends[1]);
    else add_smooth_vertex(1, v);
    check_vertex(v);
}

static void check_untagged(const subdiv_mesh *m)
{
    probe_start(m);
    if (m->scheme != SUBDIV_LOOP)
        for (int f = 0; f < m->face_count; f++) add_face_point(1, f), check_face(f);
    for (int e = 0; e < probe.edges.count; e++) {
        int a = probe.edges.ends[2 * e], b = probe.edges.ends[2 * e + 1];
        if (probe.edges.faces[e] == 1) add_edge_middle(1, a, b);
        else add_smooth_edge(1, a, b);
        check_edge(a, b);
    }
    for (int v = 0; v < m->vertex_count; v++) check_untagged_vertex(v);
    probe_end();
}

// The first level of a cage and, if it is small, the second.
static void check_smooth_cage(const char *name)
{
    subdiv_mesh fine = {0};
    test_context = name;
    check_untagged(&cage.mesh);
    CHECK_EQUAL(subdiv_refine(&fine, &cage.mesh, 1, NULL), SUBDIV_OK);
    if (fine.vertex_count && fine.vertex_count < 150) check_untagged(&fine);
    subdiv_mesh_free(&fine);
}

static void test_smooth_catmull_clark(void)
{
    for (int n = 3; n <= 12; n++) build_prism(&cage, n), check_smooth_cage("prism");
    for (int n = 3; n <= 9; n++)
        build_bipyramid(&cage, SUBDIV_CATMULL_CLARK, n), check_smooth_cage("bipyramid");
    build_torus(&cage, SUBDIV_CATMULL_CLARK, 4, 3), check_smooth_cage("torus");
    build_grid(&cage, SUBDIV_CATMULL_CLARK, 3, 2), check_smooth_cage("grid");
    build_tetrahedron(&cage, SUBDIV_CATMULL_CLARK), check_smooth_cage("tetrahedron");
    build_icosahedron(&cage, SUBDIV_CATMULL_CLARK), check_smooth_cage("icosahedron");
}

static void test_smooth_loop(void)
{
    for (int n = 3; n <= 12; n++)
        build_bipyramid(&cage, SUBDIV_LOOP, n), check_smooth_cage("bipyramid");
    build_torus(&cage, SUBDIV_LOOP, 4, 3), check_smooth_cage("torus");
    build_grid(&cage, SUBDIV_LOOP, 3, 2), check_smooth_cage("grid");
    build_tetrahedron(&cage, SUBDIV_LOOP), check_smooth_cage("tetrahedron");
    build_icosahedron(&cage, SUBDIV_LOOP), check_smooth_cage("icosahedron");
}

// Valence 2 to 12 and far beyond inside, 2 to 7 on the boundary.
static void test_valences(void)
{
    for (int scheme = SUBDIV_CATMULL_CLARK; scheme <= SUBDIV_LOOP; scheme++) {
        for (int n = 3; n <= 12; n++)
            build_fan(&cage, (subdiv_scheme)scheme, n, 1), check_smooth_cage("fan");
        build_fan(&cage, (subdiv_scheme)scheme, 70, 1), check_smooth_cage("fan of 70");
        for (int n = 1; n <= 6; n++)
            build_fan(&cage, (subdiv_scheme)scheme, n, 0), check_smooth_cage("half fan");
    }
}

static void test_valence_two(void)
{
    build_pillow(&cage, SUBDIV_CATMULL_CLARK);
    probe_start(&cage.mesh);
    for (int v = 1; v <= 2; v++) add_smooth_edge(1, 0, v), check_edge(0, v);
    add_catmull_clark_vertex(1, 0), check_vertex(0);
    add_crease_vertex(1, 1, 3, 4), check_vertex(1);
    probe_end();

    build_pillow(&cage, SUBDIV_LOOP);
    probe_start(&cage.mesh);
    for (int v = 0; v < 3; v++) add_loop_vertex(1, v), check_vertex(v);
    add_smooth_edge(1, 0, 1), check_edge(0, 1);
    probe_end();
}

// The numbers that the papers and every text book give, as numbers.
static void test_known_weights(void)
{
    build_fan(&cage, SUBDIV_LOOP, 3, 1);
    probe_start(&cage.mesh);
    add_vertex(7.0 / 16, 0);
    for (int i = 1; i <= 3; i++) add_vertex(3.0 / 16, i);
    check_vertex(0);
    probe_end();

    build_fan(&cage, SUBDIV_LOOP, 6, 1);
    probe_start(&cage.mesh);
    add_vertex(10.0 / 16, 0);
    for (int i = 1; i <= 6; i++) add_vertex(1.0 / 16, i);
    check_vertex(0);
    probe_end();

    build_fan(&cage, SUBDIV_CATMULL_CLARK, 4, 1);
    probe_start(&cage.mesh);
    add_vertex(36.0 / 64, 0);
    for (int i = 1; i <= 4; i++) add_vertex(6.0 / 64, i), add_vertex(1.0 / 64, 4 + i);
    check_vertex(0);
    probe_end();

    build_fan(&cage, SUBDIV_CATMULL_CLARK, 3, 1);
    probe_start(&cage.mesh);
    add_vertex(5.0 / 12, 0);
    for (int i = 1; i <= 3; i++) add_vertex(6.0 / 36, i), add_vertex(1.0 / 36, 3 + i);
    check_vertex(0);
    probe_end();
}

static void test_bilinear(void)
{
    static const int octagon[] = {0, 1, 2, 3, 4, 5, 6, 7};
    cage_clear(&cage, SUBDIV_BILINEAR);
    for (int i = 0; i < 9; i++) cage_vertex(&cage, i, i * i, i % 3);
    cage_face(&cage, 8, octagon);
    cage_triangle(&cage, 1, 0, 8);
    cage_crease(&cage, 0, 1, 1.5);
    cage_corner(&cage, 2, 0.5);
    cage.mesh.triangles = SUBDIV_TRIANGLES_SMOOTH;
    probe_start(&cage.mesh);
    for (int f = 0; f < 2; f++) add_face_point(1, f), check_face(f);
    for (int v = 0; v < 9; v++) add_vertex(1, v), check_vertex(v);
    for (int e = 0; e < probe.edges.count; e++) {
        int a = probe.edges.ends[2 * e], b = probe.edges.ends[2 * e + 1];
        add_edge_middle(1, a, b), check_edge(a, b);
    }
    probe_end();
}

// ------------------------------------------------------------------- sharp and semi-sharp vertices

// The vertex point of the centre of a fan of so many faces. spoke[i] is the sharpness of the edge
// from the centre 0 to vertex i; the point is weight times the mask of the rule before the level
// and 1 - weight times the mask of the rule after it. A crease runs through the two vertices named.
enum rule { SMOOTH, CREASE, CORNER };

typedef struct vertex_case {
    const char *name;
    int    faces, closed, chaikin;
    double spoke[6], corner;
    double weight;
    int    before[3], after[3];
} vertex_case;

static const vertex_case vertex_cases[] = {
    // Without sharpness that fades, one mask is all there is.
    {"dart",                   5, 1, 0, {0, 10},             0,  1, {SMOOTH}, {SMOOTH}},
    {"semi-sharp dart",        5, 1, 0, {0, 0.5},            0,  1, {SMOOTH}, {SMOOTH}},
    {"crease",                 5, 1, 0, {0, 10, 0, 10},      0,  1, {CREASE, 1, 3}, {CREASE, 1, 3}},
    {"crease from 12",         5, 1, 0, {0, 12, 0, 99},      0,  1, {CREASE, 1, 3}, {CREASE, 1, 3}},
    {"neighbouring crease",    5, 1, 0, {0, 10, 0, 0, 0, 10}, 0, 1, {CREASE, 1, 5}, {CREASE, 1, 5}},
    {"long-lived crease",      5, 1, 0, {0, 0, 2.5, 0, 3},   0,  1, {CREASE, 2, 4}, {CREASE, 2, 4}},
    {"three creases",          5, 1, 0, {0, 10, 10, 0, 10},  0,  1, {CORNER}, {CORNER}},
    {"all creases",            5, 1, 0, {0, 2, 3, 4, 5, 10}, 0,  1, {CORNER}, {CORNER}},
    {"corner",                 5, 1, 0, {0},                10,  1, {CORNER}, {CORNER}},
    {"semi-sharp corner",      5, 1, 0, {0},               1.5,  1, {CORNER}, {CORNER}},
    {"corner on crease",       5, 1, 0, {0, 10, 0, 10},     10,  1, {CORNER}, {CORNER}},
    {"boundary",               3, 0, 0, {0},                 0,  1, {CREASE, 1, 4}, {CREASE, 1, 4}},
    {"boundary corner",        3, 0, 0, {0},                10,  1, {CORNER}, {CORNER}},
    {"boundary and crease",    3, 0, 0, {0, 0, 10},          0,  1, {CORNER}, {CORNER}},
    {"tagged boundary",        3, 0, 0, {0, 0.5, 0, 0, 0.2}, 0,  1, {CREASE, 1, 4}, {CREASE, 1, 4}},
    {"negative sharpness",     5, 1, 0, {0, -1, 0, -1},     -2,  1, {SMOOTH}, {SMOOTH}},

    // What fades: the average of the sharpnesses that go to 0 is the weight, [DKT98] and [OSD].
    {"fading crease",          5, 1, 0, {0, 0.3, 0, 0.3},    0, .3, {CREASE, 1, 3}, {SMOOTH}},
    {"crease of 1",            5, 1, 0, {0, 1, 0, 1},        0,  1, {CREASE, 1, 3}, {SMOOTH}},
    {"uneven crease",          5, 1, 0, {0, 0.2, 0, 0.8},    0, .5, {CREASE, 1, 3}, {SMOOTH}},
    {"crease fading to dart",  5, 1, 0, {0, 0.4, 0, 1.5},    0, .4, {CREASE, 1, 3}, {SMOOTH}},
    {"crease fading at 10",    5, 1, 0, {0, 0.4, 0, 10},     0, .4, {CREASE, 1, 3}, {SMOOTH}},
    {"three fade",             5, 1, 0, {0, .3, .6, 0, .9},  0, .6, {CORNER}, {SMOOTH}},
    {"one of three fades",     5, 1, 0, {0, 10, .7, 0, 10},  0, .7, {CORNER}, {CREASE, 1, 4}},
    {"two of three fade",      5, 1, 0, {0, .2, 3, 0, .8},   0, .5, {CORNER}, {SMOOTH}},
    {"two of four fade",       5, 1, 0, {0, .25, 2, .75, 3}, 0, .5, {CORNER}, {CREASE, 2, 4}},
    {"one of four fades",      5, 1, 0, {0, .25, 2, 4, 3},   0,  1, {CORNER}, {CORNER}},
    {"fading corner",          5, 1, 0, {0},                .6, .6, {CORNER}, {SMOOTH}},
    {"corner of 1",            5, 1, 0, {0},                 1,  1, {CORNER}, {SMOOTH}},
    {"fading corner, crease",  5, 1, 0, {0, 10, 0, 10},     .6, .6, {CORNER}, {CREASE, 1, 3}},
    {"fading corner, dart",    5, 1, 0, {0, 0, 0, 10},      .6, .6, {CORNER}, {SMOOTH}},
    {"corner before crease",   5, 1, 0, {0, 1.5, 0, 1.5},   .4, .4, {CORNER}, {CREASE, 1, 3}},
    {"corner with crease",     5, 1, 0, {0, .9, 0, .9},     .3, .7, {CORNER}, {SMOOTH}},
    {"crease before corner",   5, 1, 0, {0, .9, 0, .9},    1.5,  1, {CORNER}, {CORNER}},
    {"boundary, fading edge",  3, 0, 0, {0, 0, .35},         0, .35, {CORNER}, {CREASE, 1, 4}},
    {"boundary, two fading",   3, 0, 0, {0, 0, .25, .75},    0, .5, {CORNER}, {CREASE, 1, 4}},
    {"boundary, edge of 1.5",  3, 0, 0, {0, 0, 1.5},         0,  1, {CORNER}, {CORNER}},
    {"boundary fading corner", 3, 0, 0, {0},               .25, .25, {CORNER}, {CREASE, 1, 4}},
    {"one face fading corner", 1, 0, 0, {0},               .25, .25, {CORNER}, {CREASE, 1, 2}},

    // Chaikin averages along the crease first: 1.2 and 0.05 both fade, 1.6 and 0.6 leave 0.35 and
    // 0, and 0.9 beside two of 3 leaves 0.425, so that it does not fade here.
    {"chaikin fades",          5, 1, 1, {0, 1.2, 0, .05},  0, .625, {CREASE, 1, 3}, {SMOOTH}},
    {"chaikin to dart",        5, 1, 1, {0, 1.6, 0, .6},   0,  .6, {CREASE, 1, 3}, {SMOOTH}},
    {"chaikin stays",          5, 1, 1, {0, .9, 3, 3},     0,   1, {CORNER}, {CORNER}},
    {"chaikin keeps a crease", 5, 1, 1, {0, .8, 0, 1.9},   0,   1, {CREASE, 1, 3}, {CREASE, 1, 3}},
    {"chaikin beside 10",      5, 1, 1, {0, .8, 0, 10},    0,  .8, {CREASE, 1, 3}, {SMOOTH}},
    {"chaikin corner",         5, 1, 1, {0},              .6,  .6, {CORNER}, {SMOOTH}},
};

static void add_rule(double factor, const int *rule)
{
    if (rule[0] == SMOOTH) add_smooth_vertex(factor, 0);
    else if (rule[0] == CREASE) add_crease_vertex(factor, 0, rule[1], rule[2]);
    else add_vertex(factor, 0);
}

static void test_sharp_vertices(void)
{
    for (size_t i = 0; i < 2 * sizeof vertex_cases / sizeof *vertex_cases; i++) {
        const vertex_case *t = vertex_cases + i / 2;
        test_context = t->name;
        build_fan(&cage, i % 2 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, t->faces, t->closed);
        cage.mesh.creasing = t->chaikin ? SUBDIV_CREASING_CHAIKIN : SUBDIV_CREASING_UNIFORM;
        for (int s = 1; s < 6; s++)
            if (t->spoke[s] != 0) cage_crease(&cage, s % 2 ? s : 0, s % 2 ? 0 : s, t->spoke[s]);
        if (t->corner != 0) cage_corner(&cage, 0, t->corner);
        probe_start(&cage.mesh);
        add_rule(t->weight, t->before);
        add_rule(1 - t->weight, t->after);
        check_vertex(0);
        probe_end();
    }
}

// Of several entries for an edge or vertex the last one counts.
static void test_later_entry_wins(void)
{
    build_fan(&cage, SUBDIV_CATMULL_CLARK, 5, 1);
    cage_crease(&cage, 0, 1, 10);
    cage_crease(&cage, 0, 3, 0.5);
    cage_crease(&cage, 1, 0, 0.5);
    cage_corner(&cage, 0, 10);
    cage_corner(&cage, 0, 0);
    probe_start(&cage.mesh);
    add_crease_vertex(0.5, 0, 1, 3), add_smooth_vertex(0.5, 0), check_vertex(0);
    add_edge_middle(0.5, 0, 1), add_smooth_edge(0.5, 0, 1), check_edge(0, 1);
    probe_end();
}

// ------------------------------------------------------------------------------- semi-sharp edges

static void check_edge_blend(int a, int b, double weight)
{
    add_edge_middle(weight, a, b);
    add_smooth_edge(1 - weight, a, b);
    check_edge(a, b);
}

static void test_sharp_edges(void)
{
    static const double sharpness[] = {0, 0.1, 0.25, 0.7, 0.999, 1, 1.5, 9.5, 10, 50};
    for (int i = 0; i < 20; i++) {
        double s = sharpness[i / 2];
        build_fan(&cage, i % 2 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, 4, 1);
        cage_crease(&cage, 2, 0, s);
        probe_start(&cage.mesh);
        check_edge_blend(0, 2, s < 1 ? s : 1);
        check_edge_blend(0, 1, 0);
        probe_end();
    }
}

// A crease through the centre of a fan level by level: each is refined on its own and hands the
// sharpness that is left to the next. lives[i] is the weight of the crease at level i.
static void check_fading(subdiv_scheme scheme, double sharpness, int edges, const double *lives)
{
    subdiv_mesh mesh = {0};
    int a = 1, b = 3;
    build_fan(&cage, scheme, 5, 1);
    if (edges) cage_crease(&cage, 0, 1, sharpness), cage_crease(&cage, 3, 0, sharpness);
    else cage_corner(&cage, 0, sharpness);
    CHECK_EQUAL(subdiv_refine(&mesh, &cage.mesh, 0, NULL), SUBDIV_OK);
    for (int level = 0; level < 4 && mesh.vertex_count; level++) {
        double left = sharpness >= 10 ? 10 : fmax(sharpness - level, 0);
        subdiv_mesh next;
        probe_start(&mesh);
        if (edges) {
            CHECK_NEAR(fmin(crease_sharpness(&mesh, 0, a), 10), left, 1e-6);
            CHECK_NEAR(fmin(crease_sharpness(&mesh, 0, b), 10), left, 1e-6);
            check_edge_blend(0, a, lives[level]);
        } else CHECK_NEAR(fmin(corner_sharpness(&mesh, 0), 10), left, 1e-6);
        if (edges) add_crease_vertex(lives[level], 0, a, b);
        else add_vertex(lives[level], 0);
        add_smooth_vertex(1 - lives[level], 0);
        check_vertex(0);
        a = edge_point(0, a), b = edge_point(0, b);
        probe_end();
        memset(&next, 0, sizeof next);
        CHECK_EQUAL(subdiv_refine(&next, &mesh, 1, NULL), SUBDIV_OK);
        subdiv_mesh_free(&mesh);
        mesh = next;
    }
    subdiv_mesh_free(&mesh);
}

static void test_fading(void)
{
    static const struct { double sharpness, lives[4]; } cases[] = {
        {0.25, {0.25, 0, 0, 0}}, {1, {1, 0, 0, 0}}, {1.5, {1, 0.5, 0, 0}},
        {2.3, {1, 1, 0.3, 0}}, {3, {1, 1, 1, 0}}, {3.75, {1, 1, 1, 0.75}},
        {9.5, {1, 1, 1, 1}}, {10, {1, 1, 1, 1}}, {25, {1, 1, 1, 1}}};
    for (int i = 0; i < 36; i++) {
        const double *lives = cases[i / 4].lives;
        subdiv_scheme scheme = i % 2 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK;
        check_fading(scheme, cases[i / 4].sharpness, i / 2 % 2, lives);
    }
}

// ------------------------------------------------------------------------------------- Chaikin

// The sharpness of the two halves of an edge, at its end a and at its end b, in the result.
static void check_halves(int a, int b, double at_a, double at_b)
{
    int middle = edge_point(a, b);
    CHECK_NEAR(crease_sharpness(&probe.fine, a, middle), at_a, 1e-6);
    CHECK_NEAR(crease_sharpness(&probe.fine, b, middle), at_b, 1e-6);
}

// Along one crease: next to a neighbour the child is 3/4 of its parent and 1/4 of the neighbour,
// less 1 [DKT98]; where nothing semi-sharp goes on, its parent less 1.
static void test_chaikin_chain(void)
{
    static const double s[] = {3, 4.5, 2, 0.5, 0.25, 10, 1.5};
    for (int scheme = SUBDIV_CATMULL_CLARK; scheme <= SUBDIV_LOOP; scheme++) {
        build_grid(&cage, (subdiv_scheme)scheme, 7, 2);
        cage.mesh.creasing = SUBDIV_CREASING_CHAIKIN;
        for (int i = 0; i < 7; i++) cage_crease(&cage, 8 + i, 9 + i, s[i]);
        probe_start(&cage.mesh);
        for (int i = 0; i < 7; i++) {
            double left = i > 0 && s[i - 1] < 10 ? (3 * s[i] + s[i - 1]) / 4 : s[i];
            double right = i < 6 && s[i + 1] < 10 ? (3 * s[i] + s[i + 1]) / 4 : s[i];
            if (s[i] < 10) check_halves(8 + i, 9 + i, fmax(left - 1, 0), fmax(right - 1, 0));
            else check_halves(8 + i, 9 + i, 10, 10);
        }
        probe_end();
    }
}

// Where more than two meet, the neighbours count by their average [OSD].
static void test_chaikin_junction(void)
{
    for (int scheme = SUBDIV_CATMULL_CLARK; scheme <= SUBDIV_LOOP; scheme++) {
        build_fan(&cage, (subdiv_scheme)scheme, 5, 1);
        cage.mesh.creasing = SUBDIV_CREASING_CHAIKIN;
        cage_crease(&cage, 0, 1, 2);
        cage_crease(&cage, 2, 0, 3);
        cage_crease(&cage, 0, 3, 4);
        cage_crease(&cage, 0, 5, 10);
        probe_start(&cage.mesh);
        check_halves(0, 1, (3 * 2 + (3 + 4) / 2.0) / 4 - 1, 1);
        check_halves(0, 2, (3 * 3 + (2 + 4) / 2.0) / 4 - 1, 2);
        check_halves(0, 3, (3 * 4 + (2 + 3) / 2.0) / 4 - 1, 3);
        check_halves(0, 5, 10, 10);
        probe_end();
    }
}

// Vertices fade by 1 a level under Chaikin as well.
static void test_chaikin_corner(void)
{
    build_fan(&cage, SUBDIV_CATMULL_CLARK, 5, 1);
    cage.mesh.creasing = SUBDIV_CREASING_CHAIKIN;
    cage_corner(&cage, 0, 2.5);
    cage_corner(&cage, 1, 0.5);
    cage_crease(&cage, 0, 1, 7);
    probe_start(&cage.mesh);
    CHECK_NEAR(corner_sharpness(&probe.fine, 0), 1.5, 1e-6);
    CHECK_NEAR(corner_sharpness(&probe.fine, 1), 0, 0);
    probe_end();
}

// The edge point is the middle as long as both halves stay sharp. Where one fades, the sharpness is
// the weight, and never more than 1 even where it is greater.
static void test_chaikin_edges(void)
{
    for (int scheme = SUBDIV_CATMULL_CLARK; scheme <= SUBDIV_LOOP; scheme++) {
        build_fan(&cage, (subdiv_scheme)scheme, 5, 1);
        cage.mesh.creasing = SUBDIV_CREASING_CHAIKIN;
        cage_crease(&cage, 0, 1, 1.2);
        cage_crease(&cage, 0, 3, 0.05);
        probe_start(&cage.mesh);
        check_halves(0, 1, 0, 0.2);
        check_edge_blend(0, 1, 1);
        check_edge_blend(0, 3, 0.05);
        probe_end();

        build_grid(&cage, (subdiv_scheme)scheme, 3, 2);
        cage.mesh.creasing = SUBDIV_CREASING_CHAIKIN;
        cage_crease(&cage, 4, 5, 3);
        cage_crease(&cage, 5, 6, 0.9);
        cage_crease(&cage, 6, 7, 3);
        probe_start(&cage.mesh);
        check_halves(5, 6, 0.425, 0.425);
        check_edge_blend(5, 6, 1);      // 0.9 would not be a crease if it faded by 1
        probe_end();

        build_grid(&cage, (subdiv_scheme)scheme, 3, 2);
        cage.mesh.creasing = SUBDIV_CREASING_CHAIKIN;
        cage_crease(&cage, 4, 5, 3);
        cage_crease(&cage, 5, 6, 0.9);
        probe_start(&cage.mesh);
        check_halves(5, 6, 0.425, 0);
        check_edge_blend(5, 6, 0.9);
        probe_end();
    }
}

// ------------------------------------------------------------------------------ smooth triangles

// Between two triangles the face points weigh 0.47 each and the ends 0.03; between a triangle and
// another face the average of 0.47 and 1/4 [OSD]. All other masks are those of Catmull-Clark.
static void add_smooth_triangle_edge(double factor, int a, int b, int triangles)
{
    double face = triangles == 2 ? 0.47 : triangles == 1 ? (0.47 + 0.25) / 2 : 0.25;
    add_vertex(factor * (0.5 - face), a);
    add_vertex(factor * (0.5 - face), b);
    for (int f = 0; f < probe.mesh->face_count; f++)
        if (face_has(probe.mesh, f, a) && face_has(probe.mesh, f, b))
            add_face_point(factor * face, f);
}

// The quad 0 1 2 3 with a triangle on each side 0-1 and 1-2, and another one, 1 4 5, between these.
static void build_triangles(void)
{
    cage_clear(&cage, SUBDIV_CATMULL_CLARK);
    for (int v = 0; v < 6; v++) cage_vertex(&cage, v, v % 3, 0);
    cage_quad(&cage, 0, 1, 2, 3);
    cage_triangle(&cage, 1, 0, 4);
    cage_triangle(&cage, 2, 1, 5);
    cage_triangle(&cage, 1, 4, 5);
    cage.mesh.triangles = SUBDIV_TRIANGLES_SMOOTH;
}

static void test_smooth_triangles(void)
{
    build_triangles();
    cage_crease(&cage, 1, 5, 0.25);
    probe_start(&cage.mesh);
    add_smooth_triangle_edge(1, 0, 1, 1), check_edge(0, 1);
    add_smooth_triangle_edge(1, 1, 2, 1), check_edge(1, 2);
    add_smooth_triangle_edge(1, 1, 4, 2), check_edge(1, 4);
    add_edge_middle(0.25, 1, 5), add_smooth_triangle_edge(0.75, 1, 5, 2), check_edge(1, 5);
    add_edge_middle(1, 0, 4), check_edge(0, 4);
    add_edge_middle(1, 4, 5), check_edge(4, 5);
    add_smooth_vertex(1, 1), check_vertex(1);
    for (int f = 0; f < 4; f++) add_face_point(1, f), check_face(f);
    probe_end();

    build_triangles();
    cage.mesh.triangles = SUBDIV_TRIANGLES_CATMULL_CLARK;
    probe_start(&cage.mesh);
    add_smooth_edge(1, 0, 1), check_edge(0, 1);
    add_smooth_edge(1, 1, 4), check_edge(1, 4);
    probe_end();
}

// Two quads, and Loop, do not know of the rule; a pentagon beside a triangle counts as a quad does.
static void test_smooth_triangles_elsewhere(void)
{
    static const int pentagon[] = {0, 1, 2, 3, 4};
    build_grid(&cage, SUBDIV_CATMULL_CLARK, 3, 3);
    cage.mesh.triangles = SUBDIV_TRIANGLES_SMOOTH;
    check_smooth_cage("grid");
    build_icosahedron(&cage, SUBDIV_LOOP);
    cage.mesh.triangles = SUBDIV_TRIANGLES_SMOOTH;
    check_smooth_cage("icosahedron");

    cage_clear(&cage, SUBDIV_CATMULL_CLARK);
    for (int v = 0; v < 6; v++) cage_vertex(&cage, v, v % 3, 0);
    cage_face(&cage, 5, pentagon);
    cage_triangle(&cage, 1, 0, 5);
    cage.mesh.triangles = SUBDIV_TRIANGLES_SMOOTH;
    probe_start(&cage.mesh);
    add_smooth_triangle_edge(1, 0, 1, 1), check_edge(0, 1);
    probe_end();
}

// ------------------------------------------------------------------------------------ boundaries

// A vertex with a single face follows the boundary curve under edge and under none, and is a corner
// under edge and corner. A boundary vertex with more faces is never a corner by itself.
static void test_boundary_corners(void)
{
    for (int i = 0; i < 6; i++) {
        build_grid(&cage, i % 2 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, 2, 2);
        cage.mesh.boundary = (subdiv_boundary)(i / 2);
        probe_start(&cage.mesh);
        if (cage.mesh.boundary == SUBDIV_BOUNDARY_EDGE_AND_CORNER) add_vertex(1, 2);
        else add_crease_vertex(1, 2, 1, 5);
        check_vertex(2);                            // a single face under both schemes
        add_crease_vertex(1, 1, 0, 2), check_vertex(1);
        if (cage.mesh.scheme == SUBDIV_LOOP) add_crease_vertex(1, 0, 1, 3), check_vertex(0);
        add_edge_middle(1, 0, 1), check_edge(0, 1);
        add_smooth_vertex(1, 4), check_vertex(4);
        probe_end();
    }
}

// How many fine faces each cage face has, by cage_faces.
static void check_visible(const int *expected, int each)
{
    int seen[CAGE_FACES] = {0};
    subdiv_mesh fine = {0};
    CHECK_EQUAL(subdiv_refine(&fine, &cage.mesh, 1, NULL), SUBDIV_OK);
    for (int f = 0; f < fine.face_count; f++) seen[fine.cage_faces[f]]++;
    for (int f = 0; f < cage.mesh.face_count; f++) CHECK_EQUAL(seen[f], each * expected[f]);
    subdiv_mesh_free(&fine);
}

// A 4 by 4 grid under boundary none: sharpened is the boundary edge that stays unsharp, -1 for all
// of them unsharp, -2 for none.
static void boundary_none_grid(subdiv_scheme scheme, int unsharp, double sharpness)
{
    edge_list e;
    int at = 0;
    build_grid(&cage, scheme, 4, 4);
    cage.mesh.boundary = SUBDIV_BOUNDARY_NONE;
    e = edges_make(&cage.mesh);
    for (int i = 0; i < e.count && unsharp != -1; i++)
        if (e.faces[i] == 1 && at++ != unsharp)
            cage_crease(&cage, e.ends[2 * i], e.ends[2 * i + 1], sharpness);
    edges_free(&e);
}

// Faces with a vertex at an unsharpened boundary edge vanish; with all of it sharpened none do.
static void test_boundary_none(void)
{
    for (int unsharp = -2; unsharp < 16; unsharp++) {
        int expected[CAGE_FACES];
        edge_list e;
        boundary_none_grid(SUBDIV_CATMULL_CLARK, unsharp, 10);
        e = edges_make(&cage.mesh);
        for (int f = 0; f < 16; f++) {
            expected[f] = 1;
            for (int i = 0; i < e.count; i++) {
                int a = e.ends[2 * i], b = e.ends[2 * i + 1];
                if (e.faces[i] != 1 || crease_sharpness(&cage.mesh, a, b) >= 10) continue;
                if (face_has(&cage.mesh, f, a) || face_has(&cage.mesh, f, b)) expected[f] = 0;
            }
        }
        edges_free(&e);
        check_visible(expected, 4);
    }
}

static void test_boundary_none_limits(void)
{
    static const int inner[16] = {0, 0, 0, 0,  0, 1, 1, 0,  0, 1, 1, 0};
    static const int all[16] = {1, 1, 1, 1,  1, 1, 1, 1,  1, 1, 1, 1,  1, 1, 1, 1};
    boundary_none_grid(SUBDIV_CATMULL_CLARK, -1, 0);
    check_visible(inner, 4);
    boundary_none_grid(SUBDIV_CATMULL_CLARK, -2, 9.9);        // not sharp enough
    check_visible(inner, 4);
    boundary_none_grid(SUBDIV_CATMULL_CLARK, -2, 40);
    check_visible(all, 4);
    boundary_none_grid(SUBDIV_BILINEAR, -1, 0);               // bilinear knows no boundary rule
    check_visible(all, 4);
    boundary_none_grid(SUBDIV_CATMULL_CLARK, -1, 0);
    for (int v = 0; v < 25; v++) cage_corner(&cage, v, 10);   // corners do not help
    check_visible(inner, 4);
}

// The faces that vanish still shape the surface, by the masks of boundary edge.
static void test_boundary_none_masks(void)
{
    boundary_none_grid(SUBDIV_CATMULL_CLARK, -1, 0);
    probe_start(&cage.mesh);
    for (int v = 0; v < 25; v++) check_untagged_vertex(v);
    for (int f = 0; f < 16; f++) add_face_point(1, f), check_face(f);
    probe_end();
    build_torus(&cage, SUBDIV_CATMULL_CLARK, 3, 3);
    cage.mesh.boundary = SUBDIV_BOUNDARY_NONE;
    check_smooth_cage("torus");
}

// Holes shape the surface as any face does, and only their faces are missing.
static void test_holes(void)
{
    int expected[CAGE_FACES];
    for (int i = 0; i < 2; i++) {
        build_torus(&cage, i ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, 4, 3);
        for (int f = 0; f < cage.mesh.face_count; f++) expected[f] = f % 3 != 1;
        for (int f = 1; f < cage.mesh.face_count; f += 3) cage_hole(&cage, f);
        check_visible(expected, 4);
        check_untagged(&cage.mesh);
    }
}

// ---------------------------------------------------------------------------------- non-manifold

// Three sheets along the line 0-1-2-3.
static void test_fins(void)
{
    for (int i = 0; i < 2; i++) {
        build_fins(&cage, i ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, 3, 3);
        probe_start(&cage.mesh);
        for (int v = 0; v < 3; v++) add_edge_middle(1, v, v + 1), check_edge(v, v + 1);
        add_vertex(1, 0), check_vertex(0);                // boundaries meet here: a corner
        add_crease_vertex(1, 1, 0, 2), check_vertex(1);   // inside the line it is a crease [OSD]
        add_crease_vertex(1, 2, 1, 3), check_vertex(2);
        add_vertex(1, 3), check_vertex(3);
        probe_end();

        build_fins(&cage, i ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, 3, 1);
        probe_start(&cage.mesh);
        add_edge_middle(1, 0, 1), check_edge(0, 1);
        add_vertex(1, 0), check_vertex(0);
        add_vertex(1, 1), check_vertex(1);
        probe_end();
    }
}

static unsigned random_state;

static int below(int n)                                   // 0 <= result < n
{
    random_state = random_state * 1664525u + 1013904223u;
    return (int)((random_state >> 8) % (unsigned)n);
}

// Adds a sheet of faces at vertex 0, wound either way, from one of its neighbours to another.
static void add_sheet(int from, int to)
{
    int turned = below(2), least = from == to ? 3 : 1, faces = least + below(3);
    for (int i = 0, a = from, b; i < faces; i++, a = b) {
        b = i + 1 < faces ? cage_vertex(&cage, i, below(9), below(9)) : to;
        int first = turned ? b : a, last = turned ? a : b;
        if (cage.mesh.scheme == SUBDIV_LOOP) cage_triangle(&cage, 0, first, last);
        else cage_quad(&cage, 0, first, cage_vertex(&cage, below(9), i, 3), last);
    }
}

// A crease of non-manifold edges runs through a vertex if three sheets or more lead from the one to
// the other and there is no other sheet: none that ends where it began, closes around the vertex or
// has a boundary. Else the vertex is a corner. The sheets are in random order.
static void test_sheets(void)
{
    enum { STARS = 2000 };
    int through = 0;
    random_state = 1;
    for (int i = 0; i < STARS; i++) {
        int left[3], others[4] = { 0, 0, 0, 0 }, all = 0;      // others: of each kind
        cage_clear(&cage, below(2) ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK);
        for (int v = 0; v < 3; v++) cage_vertex(&cage, v, below(9), below(9));
        left[0] = 3 + below(4);                           // sheets from 1 to 2
        for (int k = 0; k < 4; k++) all += others[k] = below(4) == 0;
        for (int rest = left[0] + all; rest > 0; rest--) {
            int k = 3, pick = below(rest);
            for (; k >= 0 && pick >= others[k]; k--) pick -= others[k];
            if (k < 0) left[0]--, below(2) ? add_sheet(1, 2) : add_sheet(2, 1);
            else others[k] = 0;
            int a = k >= 2 ? cage_vertex(&cage, 7, k, i % 5) : k + 1;
            if (k >= 0 && k < 3) add_sheet(a, a);
            if (k == 3) add_sheet(1, a);
        }
        probe_start(&cage.mesh);
        if (all) add_vertex(1, 0);
        else add_crease_vertex(1, 0, 1, 2);
        check_vertex(0);
        probe_end();
        through += !all;
    }
    CHECK(through > STARS / 5 && through < STARS / 2);
}

static void test_bow_tie(void)
{
    for (int i = 0; i < 2; i++) {
        build_bow_tie(&cage, i ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK);
        probe_start(&cage.mesh);
        add_vertex(1, 0), check_vertex(0);
        if (i) add_crease_vertex(1, 1, 0, 3), check_vertex(1);
        else add_crease_vertex(1, 1, 0, 2), check_vertex(1);
        probe_end();
    }
}

// A fourth sheet along a part of the line brings its boundary to the middle of it: a corner [OSD].
static void test_ending_fin(void)
{
    for (int i = 0; i < 2; i++) {
        int a, b;
        build_fins(&cage, i ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, 3, 2);
        a = cage_vertex(&cage, 1, 0.5, 1), b = cage_vertex(&cage, 0, 0.5, 1);
        cage_quad(&cage, 0, 1, a, b);
        probe_start(&cage.mesh);
        add_vertex(1, 1), check_vertex(1);
        probe_end();
    }
}

// Closed cones that meet in a vertex have no sharp edges there, but more than one fan: a corner.
// So has a cone with a single face at its tip.
static void test_cones(void)
{
    for (int i = 0; i < 4; i++) {
        int v[3];
        build_tetrahedron(&cage, i % 2 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK);
        for (int k = 0; k < 3; k++) v[k] = cage_vertex(&cage, 2, k == 1, k == 2);
        cage_triangle(&cage, 0, v[0], v[1]);
        if (i < 2) {
            cage_triangle(&cage, 0, v[1], v[2]);
            cage_triangle(&cage, 0, v[2], v[0]);
            cage_triangle(&cage, v[0], v[2], v[1]);
        }
        probe_start(&cage.mesh);
        add_vertex(1, 0), check_vertex(0);
        add_smooth_vertex(1, 1), check_vertex(1);
        probe_end();
    }
}

// Faces wound against each other make the edge between them sharp and its ends corners [OSD].
static void test_twisted_edge(void)
{
    cage_clear(&cage, SUBDIV_CATMULL_CLARK);
    for (int v = 0; v < 6; v++) cage_vertex(&cage, v / 2, v % 2, 0);
    cage_quad(&cage, 0, 2, 3, 1);
    cage_quad(&cage, 2, 4, 5, 3);
    probe_start(&cage.mesh);
    add_smooth_edge(1, 2, 3), check_edge(2, 3);           // wound alike: nothing special
    probe_end();

    cage.mesh.face_count = 1;
    cage_quad(&cage, 2, 3, 5, 4);
    probe_start(&cage.mesh);
    add_edge_middle(1, 2, 3), check_edge(2, 3);
    add_vertex(1, 2), check_vertex(2);
    add_vertex(1, 3), check_vertex(3);
    add_crease_vertex(1, 0, 1, 2), check_vertex(0);
    probe_end();

    build_grid(&cage, SUBDIV_CATMULL_CLARK, 2, 2);        // the upper two faces turned over
    cage.mesh.face_count = 2;
    cage_quad(&cage, 3, 6, 7, 4);
    cage_quad(&cage, 4, 7, 8, 5);
    probe_start(&cage.mesh);
    add_edge_middle(1, 3, 4), check_edge(3, 4);
    add_smooth_edge(1, 4, 7), check_edge(4, 7);
    add_vertex(1, 4), check_vertex(4);                    // though two such edges run through
    probe_end();
}

static void test_isolated_vertices(void)
{
    subdiv_mesh fine = {0};
    build_torus(&cage, SUBDIV_CATMULL_CLARK, 3, 3);
    cage_vertex(&cage, 5, -6, 7.25);
    check_smooth_cage("torus and vertex");
    for (int levels = 1; levels <= 3; levels++) {
        CHECK_EQUAL(subdiv_refine(&fine, &cage.mesh, levels, NULL), SUBDIV_OK);
        for (int d = 27; d < 30 && fine.vertex_count > 9; d++)
            CHECK_NEAR(fine.positions[d], cage.positions[d], 0);
        subdiv_mesh_free(&fine);
    }
}

int main(void)
{
    RUN(test_smooth_catmull_clark);
    RUN(test_smooth_loop);
    RUN(test_valences);
    RUN(test_valence_two);
    RUN(test_known_weights);
    RUN(test_bilinear);
    RUN(test_sharp_vertices);
    RUN(test_later_entry_wins);
    RUN(test_sharp_edges);
    RUN(test_fading);
    RUN(test_chaikin_chain);
    RUN(test_chaikin_junction);
    RUN(test_chaikin_corner);
    RUN(test_chaikin_edges);
    RUN(test_smooth_triangles);
    RUN(test_smooth_triangles_elsewhere);
    RUN(test_boundary_corners);
    RUN(test_boundary_none);
    RUN(test_boundary_none_limits);
    RUN(test_boundary_none_masks);
    RUN(test_holes);
    RUN(test_fins);
    RUN(test_ending_fin);
    RUN(test_sheets);
    RUN(test_bow_tie);
    RUN(test_cones);
    RUN(test_twisted_edge);
    RUN(test_isolated_vertices);
    return test_end("masks");
}
