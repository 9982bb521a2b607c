// The closed form against the masks: refining k levels at once is refining one level k times, each
// made by masks or by patches of one level alone. Where nothing is semi-sharp the masks are also
// written here a second time, in doubles.
//
//     cc -I. tests/test_patches.c -o build/test_patches -lm && build/test_patches

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/test.h"

// One level of masks: from the values [3 * vertex_count] of a mesh, those of the next level.
typedef void (*one_level)(const subdiv_mesh *m, const double *in, double *out);

// ------------------------------------------------------------------------ the masks, once more

typedef struct ring {                 // of a vertex
    int    faces, edges, sharp, corner;
    double face_sum[3];               // of face points
    double edge_sum[3];               // of neighbours
    double sharp_sum[3];              // of neighbours across sharp edges
} ring;

static void add(double *to, const double *from)
{
    for (int d = 0; d < 3; d++) to[d] += from[d];
}

static void *zeros(size_t count, size_t size)
{
    void *a = calloc(count + 1, size);
    if (!a) abort();
    return a;
}

// What is sharp forever: boundaries and what the lists say.
static void find_sharp(const subdiv_mesh *m, const edge_list *e, int *sharp, ring *rings)
{
    for (int i = 0; i < m->crease_count; i++) {
        int at = edges_find(e, m->crease_vertices[2 * i], m->crease_vertices[2 * i + 1]);
        if (at >= 0) sharp[at] = m->crease_sharpness[i] >= SUBDIV_INFINITE;
    }
    for (int i = 0; i < e->count; i++) if (e->faces[i] == 1) sharp[i] = 1;
    for (int i = 0; i < m->corner_count; i++)
        rings[m->corner_vertices[i]].corner = m->corner_sharpness[i] >= SUBDIV_INFINITE;
}

static void find_rings(const subdiv_mesh *m, const edge_list *e, const int *sharp,
                       const double *in, const double *face_points, ring *rings)
{
    for (int j = 0; j < face_vertex_count(m); j++) {
        ring *r = &rings[m->face_vertices[j]];
        r->faces++;
        add(r->face_sum, face_points + 3 * e->face[j]);
    }
    for (int k = 0; k < 2 * e->count; k++) {
        ring *r = &rings[e->ends[k]];
        const double *other = in + 3 * e->ends[k ^ 1];
        r->edges++;
        add(r->edge_sum, other);
        r->sharp += sharp[k / 2];
        if (sharp[k / 2]) add(r->sharp_sum, other);
    }
}

static void vertex_point(const subdiv_mesh *m, const ring *r, const double *p, double *out)
{
    int pinned = m->boundary == SUBDIV_BOUNDARY_EDGE_AND_CORNER && r->faces == 1;
    double n = r->edges, c = 0.375 + 0.25 * cos(8 * atan(1.0) / n), beta = (0.625 - c * c) / n;
    for (int d = 0; d < 3; d++) {
        double smooth = m->scheme == SUBDIV_LOOP
            ? (1 - n * beta) * p[d] + beta * r->edge_sum[d]
            : (r->face_sum[d] / n + (p[d] + r->edge_sum[d] / n) + (n - 3) * p[d]) / n;
        out[d] = smooth;
        if (r->sharp == 2) out[d] = 0.75 * p[d] + r->sharp_sum[d] / 8;
        if (m->scheme == SUBDIV_BILINEAR || pinned || r->corner || r->sharp > 2) out[d] = p[d];
    }
}

// faces: what the two faces beside add, face points or under Loop the vertices of both triangles.
static void edge_point(const subdiv_mesh *m, const double *a, const double *b, int sharp,
                       const double *faces, double *out)
{
    for (int d = 0; d < 3; d++) {
        double sum = a[d] + b[d], opposite = faces[d] - 2 * sum;
        if (sharp || m->scheme == SUBDIV_BILINEAR) out[d] = sum / 2;
        else if (m->scheme == SUBDIV_LOOP) out[d] = 0.375 * sum + 0.125 * opposite;
        else out[d] = (sum + faces[d]) / 4;
    }
}

static void level_of_masks(const subdiv_mesh *m, const double *in, double *out)
{
    edge_list e = edges_make(m);
    int total = face_vertex_count(m), *sharp = zeros((size_t)e.count, sizeof *sharp);
    ring *rings = zeros((size_t)m->vertex_count, sizeof *rings);
    double *face_points = zeros(3 * (size_t)m->face_count, sizeof *face_points);
    double *beside = zeros(3 * (size_t)e.count, sizeof *beside);
    double *edge_points = out + 3 * m->vertex_count;
    for (int j = 0; j < total; j++) add(face_points + 3 * e.face[j], in + 3 * m->face_vertices[j]);
    for (int i = 0; i < 3 * m->face_count && m->scheme != SUBDIV_LOOP; i++)
        face_points[i] /= face_size(m, i / 3);
    for (int j = 0; j < total; j++) add(beside + 3 * e.of[j], face_points + 3 * e.face[j]);
    find_sharp(m, &e, sharp, rings);
    find_rings(m, &e, sharp, in, face_points, rings);
    for (int v = 0; v < m->vertex_count; v++)
        vertex_point(m, &rings[v], in + 3 * v, out + 3 * v);
    for (int i = 0; i < e.count; i++)
        edge_point(m, in + 3 * e.ends[2 * i], in + 3 * e.ends[2 * i + 1], sharp[i],
                   beside + 3 * i, edge_points + 3 * i);
    if (m->scheme != SUBDIV_LOOP)
        memcpy(edge_points + 3 * e.count, face_points, sizeof(double) * 3 * (size_t)m->face_count);
    edges_free(&e);
    free(sharp), free(rings), free(face_points), free(beside);
}

// ------------------------------------------------------------------------- one level, k times

static void level_of_library(const subdiv_mesh *m, const double *in, double *out)
{
    subdiv_mesh from = *m, fine = {0};
    float *positions = zeros(3 * (size_t)m->vertex_count, sizeof *positions);
    for (int i = 0; i < 3 * m->vertex_count; i++) positions[i] = (float)in[i];
    from.positions = positions;
    CHECK_EQUAL(subdiv_refine(&fine, &from, 1, NULL), SUBDIV_OK);
    for (int i = 0; i < 3 * fine.vertex_count; i++) out[i] = (double)fine.positions[i];
    subdiv_mesh_free(&fine);
    free(positions);
}

// Brings the values of one level over so many into the order of all of them at once.
static void reorder(const subdiv_mesh *cage, const subdiv_mesh *coarse, int levels,
                    const double *values, double *out)
{
    order whole, first, second;
    int at = 0;
    CHECK(order_make(&whole, cage, levels + 1, NULL));
    CHECK(order_make(&first, cage, levels, NULL));
    CHECK(order_make(&second, coarse, 1, NULL));
    for (int i = 0; i < 3 * whole.point_count; i++) out[i] = nan("");
    for (int f = 0; f < cage->face_count; f++) {
        order_place face = {0, 0, 0, 0, 0};
        face.face = f;
        do {
            order_place p = {0, 0, 0, 0, 0};
            p.face = at++;
            do {
                order_place to = place_within(face, 2, p.row, p.column);
                memcpy(out + 3 * place_point(&whole, to), values + 3 * place_point(&second, p),
                       3 * sizeof(double));
            } while (place_next_point(&second, &p));
        } while (place_next_face(&first, &face));
    }
    order_free(&whole), order_free(&first), order_free(&second);
}

static double box_size(const subdiv_mesh *m)
{
    double size = 0;
    for (int d = 0; d < 3; d++) {
        double low = 1e30, high = -1e30;
        for (int v = 0; v < m->vertex_count; v++) {
            low = fmin(low, (double)m->positions[3 * v + d]);
            high = fmax(high, (double)m->positions[3 * v + d]);
        }
        size = fmax(size, high - low);
    }
    return size;
}

static void check_near_all(const subdiv_mesh *whole, const double *values, int levels,
                           double allowed)
{
    for (int i = 0; i < 3 * whole->vertex_count; i++) {
        double off = fabs((double)whole->positions[i] - values[i]);
        if (!(off <= allowed)) {
            TEST_REPORT("level %d: point %d is off by %g", levels, i / 3, off);
            return;
        }
    }
}

// The results of 1, 2, ... levels against the steps so far.
static void check_steps(const subdiv_mesh *cage, int levels, one_level step)
{
    subdiv_mesh coarse = *cage, whole = {0};
    subdiv_options opt = {0};
    double *values = zeros(3 * (size_t)cage->vertex_count, sizeof *values);
    opt.keep_holes = 1;
    for (int i = 0; i < 3 * cage->vertex_count; i++) values[i] = (double)cage->positions[i];
    for (int k = 1; k <= levels; k++) {
        CHECK_EQUAL(subdiv_refine(&whole, cage, k, &opt), SUBDIV_OK);
        if (!whole.vertex_count) break;
        double *stepped = zeros(3 * (size_t)whole.vertex_count, sizeof *stepped);
        double *next = zeros(3 * (size_t)whole.vertex_count, sizeof *next);
        step(&coarse, values, stepped);
        if (k == 1) memcpy(next, stepped, sizeof *next * 3 * (size_t)whole.vertex_count);
        else reorder(cage, &coarse, k - 1, stepped, next);
        check_near_all(&whole, next, k, 1e-6 * box_size(cage));
        free(values), free(stepped);
        values = next;
        if (k > 1) subdiv_mesh_free(&coarse);
        coarse = whole;
    }
    if (coarse.memory) subdiv_mesh_free(&coarse);
    free(values);
}

// ------------------------------------------------------------------------------ regular cages

// Moves the vertices of a cage from their regular places, so that no term of a curve is 0.
static void shake(test_cage *c, unsigned seed)
{
    for (int i = 0; i < 3 * c->mesh.vertex_count; i++) {
        seed = seed * 1664525u + 1013904223u;
        c->positions[i] += (float)(seed >> 16) / 65536.0f * 0.4f - 0.2f;
    }
}

enum { ACROSS = 6 };                  // faces along each side of a torus, lines of its grid

// Sharpens a whole line of the torus: along rows, along columns, and under Loop along diagonals.
static void sharpen_line(test_cage *c, int direction, int line, double sharpness)
{
    for (int i = 0; i < ACROSS; i++) {
        int x = direction == 1 ? line : i, y = direction == 0 ? line : i;
        if (direction == 2) x = (i + line) % ACROSS;
        int to_x = (x + (direction != 1)) % ACROSS, to_y = (y + (direction != 0)) % ACROSS;
        cage_crease(c, x + ACROSS * y, to_x + ACROSS * to_y, sharpness);
    }
}

// Faces with every set of sharp sides. Where lines cross there is a corner.
static void sharpen_lines(test_cage *c, int set, double sharpness)
{
    for (int i = 0; i < 4; i++) if (set >> i & 1) sharpen_line(c, i / 2, 2 + i % 2, sharpness);
    if (set & 16) sharpen_line(c, 2, 0, sharpness);
    if (set & 32) sharpen_line(c, 2, 1, sharpness);
}

static void test_sharp_sides(void)
{
    static test_cage c;
    static char context[64];
    test_context = context;
    for (int set = 0; set < 80; set++) {
        subdiv_scheme scheme = set < 64 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK;
        sprintf(context, "%s lines %d", scheme == SUBDIV_LOOP ? "Loop" : "Catmull-Clark", set % 64);
        build_torus(&c, scheme, ACROSS, ACROSS);
        shake(&c, (unsigned)set);
        sharpen_lines(&c, set % 64, SUBDIV_INFINITE);
        check_steps(&c.mesh, set % 16 ? 4 : 6, level_of_masks);
    }
}

// Grids down to a single face, whose sides are all boundaries.
static void test_boundaries(void)
{
    static test_cage c;
    static char context[64];
    test_context = context;
    for (int i = 0; i < 2 * 2 * 16; i++) {
        subdiv_scheme scheme = i & 1 ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK;
        int width = 1 + i / 4 % 4, height = 1 + i / 16;
        sprintf(context, "%d by %d, %s", width, height, i & 1 ? "Loop" : "Catmull-Clark");
        build_grid(&c, scheme, width, height);
        shake(&c, (unsigned)i);
        if (i & 2) c.mesh.boundary = SUBDIV_BOUNDARY_EDGE_AND_CORNER;
        check_steps(&c.mesh, 5, level_of_masks);
    }
}

// A triangle with corners alone, and triangles around a vertex from all sides: every face of the
// fan between two creases is its first, its middle and its last.
static void test_triangle_fans(void)
{
    static test_cage c;
    static char context[64];
    test_context = context;
    for (int i = 0; i < 24; i++) {
        sprintf(context, "fan of %d", 1 + i % 8);
        build_fan(&c, SUBDIV_LOOP, 1 + i % 8 + 2 * (i >= 16), i >= 16);
        shake(&c, (unsigned)i);
        if (i & 8) c.mesh.boundary = SUBDIV_BOUNDARY_EDGE_AND_CORNER;
        if (i & 1) cage_corner(&c, 0, SUBDIV_INFINITE);
        if (i % 3 == 0) cage_crease(&c, 0, 1, SUBDIV_INFINITE);
        check_steps(&c.mesh, 5, level_of_masks);
    }
}

// A mirrored crease is a B-spline curve only without anything that fades: lines that end.
static void test_fading_lines(void)
{
    static test_cage c;
    static char context[64];
    const double off[] = { -1, -0.5, -1e-3, 0, 1e-3, 0.5, 1 };
    test_context = context;
    for (int i = 0; i < 2 * 2 * 7 * 4; i++) {
        int levels = 2 + i % 4, chaikin = i / 4 % 2, loop = i / 8 % 2;
        double sharpness = levels + off[i / 16];
        sprintf(context, "lines of %g, %s", sharpness, loop ? "Loop" : "Catmull-Clark");
        build_torus(&c, loop ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, ACROSS, ACROSS);
        shake(&c, (unsigned)i);
        c.mesh.creasing = chaikin ? SUBDIV_CREASING_CHAIKIN : SUBDIV_CREASING_UNIFORM;
        sharpen_line(&c, 0, 1, sharpness);
        sharpen_line(&c, 1, 4, levels + off[(i / 16 + 3) % 7]);
        sharpen_line(&c, 1 + loop, 1, SUBDIV_INFINITE);
        cage_crease(&c, 21, 22, sharpness);
        cage_corner(&c, 31, sharpness);
        check_steps(&c.mesh, levels, level_of_library);
    }
}

// Semi-sharp lines that go straight through, alone, on both sides of a face and crossing, on a torus
// and to the boundary of a grid: lines of each level's own sharpness.
static void test_semi_sharp_lines(void)
{
    static test_cage c;
    static char context[64];
    const double some[] = { 0.3, 1, 1.5, 2, 2.75, 3, 3.2 };
    test_context = context;
    for (int i = 0; i < 2 * 7 * 8; i++) {
        double s = some[i / 2 % 7], t = some[(i / 2 + i / 14) % 7];
        int lines = 1 + i / 14 % 3, torus = i % 2, chaikin = i / 28 % 2, width = ACROSS;
        sprintf(context, "lines %d of %g and %g%s", lines, s, t, chaikin ? ", Chaikin" : "");
        if (torus) build_torus(&c, SUBDIV_CATMULL_CLARK, width, width);
        else build_grid(&c, SUBDIV_CATMULL_CLARK, width, width);
        width += !torus;
        c.mesh.boundary = SUBDIV_BOUNDARY_EDGE_AND_CORNER;
        shake(&c, (unsigned)i);
        c.mesh.creasing = chaikin ? SUBDIV_CREASING_CHAIKIN : SUBDIV_CREASING_UNIFORM;
        for (int k = 0; k < ACROSS; k++) {
            int next = (k + 1) % width;
            for (int line = 2; line <= 3 && lines & 1; line++)
                cage_crease(&c, k + width * line, next + width * line, s);
            if (lines & 2) cage_crease(&c, 4 + width * k, 4 + width * next, t);
        }
        check_steps(&c.mesh, 4, level_of_library);
    }
}

// Two quads, or under Loop three triangles, that close around a vertex, and a fin on one of their
// edges: as many faces as beside a crease, but the same edge on either side.
static void test_fin_on_a_fan(void)
{
    static test_cage c;
    for (int loop = 0; loop <= 1; loop++) {
        build_fan(&c, loop ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, 2 + loop, 1);
        int a = cage_vertex(&c, 1, 0, 1);
        if (loop) cage_triangle(&c, 0, 1, a);
        else cage_quad(&c, 0, 1, a, cage_vertex(&c, 0, 0, 1));
        shake(&c, 1);
        check_steps(&c.mesh, 5, level_of_library);
    }
}

// ------------------------------------------------------------------------------- random cages

// What a result cannot tell the next call: faces wound against each other and, under Loop, two
// triangles with the same three vertices, whose inner edges would look shared.
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

// As many levels as a test can afford.
static int affordable(const subdiv_mesh *m, int most)
{
    int levels = 1, faces = m->scheme == SUBDIV_LOOP ? 2 * m->face_count : face_vertex_count(m);
    while (levels < most && faces << 2 * levels <= 60000) levels++;
    return levels;
}

static void for_random_cages(unsigned count, int features, void (*check)(random_cage *, unsigned))
{
    static char context[64];
    test_context = context;
    for (unsigned seed = 1; seed <= count; seed++) {
        random_cage *c = random_cage_new(seed, features);
        if (!c) abort();
        sprintf(context, "random cage %u", seed);
        if (!has_hidden_edges(&c->mesh)) check(c, seed);
        random_cage_free(c);
    }
}

static void check_random(random_cage *c, unsigned seed)
{
    (void)seed;
    check_steps(&c->mesh, affordable(&c->mesh, 5), level_of_library);
}

static void test_random_cages(void)
{
    for_random_cages(300, RANDOM_ALL & ~RANDOM_DEGENERATE, check_random);
}

// Everything sharp is sharp forever, as the masks above know it.
static void check_forever(random_cage *c, unsigned seed)
{
    (void)seed;
    c->mesh.triangles = SUBDIV_TRIANGLES_CATMULL_CLARK;
    for (int i = 0; i < c->mesh.crease_count; i++)
        c->crease_sharpness[i] = c->crease_sharpness[i] < 1 ? 0 : SUBDIV_INFINITE;
    for (int i = 0; i < c->mesh.corner_count; i++)
        c->corner_sharpness[i] = c->corner_sharpness[i] < 1 ? 0 : SUBDIV_INFINITE;
    check_steps(&c->mesh, affordable(&c->mesh, 5), level_of_masks);
}

static void test_forever_sharp(void)
{
    for_random_cages(300, RANDOM_MANIFOLD, check_forever);
}

// Sharpness just below, at and above the number of levels, at every edge and corner.
static void check_around_levels(random_cage *c, unsigned seed)
{
    const float off[] = { -1, -0.999f, -0.5f, -0.001f, 0, 0.001f, 0.5f, 1 };
    int levels = affordable(&c->mesh, 2 + (int)(seed % 4));
    for (int i = 0; i < c->mesh.crease_count; i++)
        if (!random_chance(c, 20))
            c->crease_sharpness[i] = (float)levels + off[random_below(c, 8)];
    for (int i = 0; i < c->mesh.corner_count; i++)
        if (!random_chance(c, 20))
            c->corner_sharpness[i] = (float)levels + off[random_below(c, 8)];
    check_steps(&c->mesh, levels, level_of_library);
}

static void test_sharpness_around_levels(void)
{
    for_random_cages(300, RANDOM_ALL & ~RANDOM_DEGENERATE, check_around_levels);
}

// Faces whose vertices have other valences than the regular one, and two of them such a valence.
// Sharp: a corner, the end of a crease, a crease, three of them, for a while or forever.
static void sharpen_vertex(test_cage *c, int n, int set, double sharpness)
{
    if (set == 1) cage_corner(c, 0, sharpness);
    for (int i = 0; i < set - 1 && i < 3; i++) {
        edge_list e = edges_make(&c->mesh);
        int found = 0;
        for (int k = 0; k < e.count; k++)
            if ((e.ends[2 * k] == 0 || e.ends[2 * k + 1] == 0) && found++ == i)
                cage_crease(c, e.ends[2 * k], e.ends[2 * k + 1], sharpness + n % 2);
        edges_free(&e);
    }
}

static void check_valence(const subdiv_mesh *m, int chaikin, one_level step)
{
    subdiv_mesh cage = *m;
    cage.creasing = chaikin ? SUBDIV_CREASING_CHAIKIN : SUBDIV_CREASING_UNIFORM;
    check_steps(&cage, 3, step);
}

static void test_valences(void)
{
    static const double sharpness[] = { 0.5, 1, 2.5, SUBDIV_INFINITE };
    static test_cage c;
    static char context[64];
    test_context = context;
    for (int i = 0; i < 2 * 6 * 5 * 4; i++) {
        int loop = i % 2, n = 3 + i / 2 % 6, set = i / 12 % 5;
        double s = sharpness[i / 60];
        subdiv_mesh quads = {0};
        sprintf(context, "%s, valence %d, set %d, sharpness %g", loop ? "Loop" : "Catmull-Clark", n,
                set, s);
        if (loop) build_bipyramid(&c, SUBDIV_LOOP, n);
        else build_prism(&c, n);
        shake(&c, (unsigned)i);
        sharpen_vertex(&c, n, set, loop ? s : s + 1);
        if (!loop) CHECK_EQUAL(subdiv_refine(&quads, &c.mesh, 1, NULL), SUBDIV_OK);
        one_level step = s >= SUBDIV_INFINITE && set != 2 ? level_of_masks : level_of_library;
        for (int chaikin = 0; chaikin < 2; chaikin++)
            check_valence(loop ? &c.mesh : &quads, chaikin, step);
        subdiv_mesh_free(&quads);
    }
}

int main(void)
{
    RUN(test_sharp_sides);
    RUN(test_boundaries);
    RUN(test_triangle_fans);
    RUN(test_fading_lines);
    RUN(test_semi_sharp_lines);
    RUN(test_fin_on_a_fan);
    RUN(test_valences);
    RUN(test_random_cages);
    RUN(test_forever_sharp);
    RUN(test_sharpness_around_levels);
    return test_end("patches");
}
