// Any mesh struct, legal or wild, through every public function. The bytes make the mesh, the
// options, and the ranges, windows, strides, locations and rates that the functions are called with.
//
//     clang -g -O1 -DLIBFUZZER -fsanitize=fuzzer,address,undefined -I. tests/fuzz/mesh.c -o fuzz_mesh
//     cc -I. tests/fuzz/mesh.c -o fuzz_mesh -lm && ./fuzz_mesh 300 tests/fuzz/seeds/mesh/*

#include "fuzz.h"

// ---------------------------------------------------------------------------------- a mesh of bytes

enum { VERTICES = 48, FACES = 32, FACE_VERTICES = 256, TAGS = 16, UVS = 64, STATEMENTS = 4 };

typedef struct cage {
    subdiv_mesh mesh;                     // its arrays are those below
    int   vertices, faces, sum;           // before the mesh becomes wild; sum of the sizes
    int   creases, corners, holes, uvs, statements;
    float positions[3 * VERTICES], colors[3 * VERTICES], normals[3 * VERTICES];
    int   face_sizes[FACES], face_vertices[FACE_VERTICES], face_uvs[FACE_VERTICES];
    int   crease_vertices[2 * TAGS], corner_vertices[TAGS], hole[TAGS];
    float crease_sharpness[TAGS], corner_sharpness[TAGS], uv[2 * UVS];
    int   statement_faces[STATEMENTS];
    char *statement[STATEMENTS];
} cage;

static cage c;
static subdiv_mesh lent;                  // what the library gets: arrays that end where they end
static int wild;                          // something in the mesh or the arguments may be an error
static subdiv_options how;
static double weights_of_rule[2];

static void add_face(int size, const int *vertices)
{
    if (c.faces == FACES || c.sum + size > FACE_VERTICES) return;
    c.face_sizes[c.faces++] = size;
    memcpy(c.face_vertices + c.sum, vertices, (size_t)size * sizeof(int));
    c.sum += size;
}

static void add_quad(int triangles, int v0, int v1, int v2, int v3)
{
    const int v[4] = { v0, v1, v2, v3 }, w[3] = { v0, v2, v3 };
    add_face(triangles ? 3 : 4, v);
    if (triangles) add_face(3, w);
}

// A grid, which may be closed to a tube or a torus.
static void add_grid(bytes *b, int triangles)
{
    int w = 1 + below(b, 4), h = 1 + below(b, 4), closed = below(b, 4);
    int columns = w + !(closed & 1), rows = h + !(closed & 2);
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            int right = (x + 1) % columns, row = y * columns, next = (y + 1) % rows * columns;
            add_quad(triangles, row + x, row + right, next + right, next + x);
        }
    c.vertices = columns * rows;
}

// Faces around vertex 0, a full circle or less.
static void add_fan(bytes *b, int triangles)
{
    int count = 1 + below(b, 16), open = below(b, 2), step = 2 - triangles, rim = count * step;
    for (int i = 0; i < count; i++) {
        int v[4] = { 0, 1 + i * step, 2 + i * step, 1 + (i * step + 2) % (rim + open) };
        if (triangles) v[2] = 1 + (i + 1) % (rim + open);
        add_face(3 + !triangles, v);
    }
    c.vertices = 1 + rim + open;
}

// A polygon and what stands on its sides, with another one on top or without.
static void add_prism(bytes *b, int triangles)
{
    int n = 3 + below(b, 8), v[16];
    for (int i = 0; i < n; i++) {
        add_quad(triangles, i, (i + 1) % n, n + (i + 1) % n, n + i);
        v[i] = n + i;
    }
    if (below(b, 2)) add_face(triangles ? 3 : n, v);
    c.vertices = 2 * n;
}

static void add_soup(bytes *b, int triangles)
{
    c.vertices = 1 + below(b, VERTICES);
    for (int count = below(b, 12); count > 0; count--) {
        int size = triangles ? 3 : 3 + below(b, 6), v[8];
        for (int i = 0; i < size; i++) v[i] = below(b, c.vertices);
        add_face(size, v);
    }
}

// Makes the mesh odd in one place.
static void edit(bytes *b)
{
    int f = below(b, c.faces), start = 0, size = c.faces ? c.face_sizes[f] : 0;
    for (int i = 0; i < f; i++) start += c.face_sizes[i];
    int *v = c.face_vertices + start;
    switch (size ? below(b, 4) : 4) {
    case 0:
        v[below(b, size)] = below(b, c.vertices);
        break;
    case 1:
        for (int i = 0, j = size - 1; i < j; i++, j--) {
            int vertex = v[i];
            v[i] = v[j];
            v[j] = vertex;
        }
        break;
    case 2:
        add_face(size, v);
        break;
    case 3:
        c.sum -= c.face_sizes[--c.faces];
    }
}

static float a_sharpness(bytes *b)
{
    static const float usual[] = { 1, 2, 10, 0.5f, 2.75f, 9.99f, 11, 0, -1, 1e9f };
    int i = below(b, 12);
    float s = i < 10 ? usual[i] : any_float(b);
    return s == s || wild ? s : 1;
}

static void add_tags(bytes *b)
{
    for (c.creases = c.sum ? below(b, TAGS) : 0; c.mesh.crease_count < c.creases; ) {
        int i = c.mesh.crease_count++, at = below(b, c.sum - 1);
        c.crease_vertices[2 * i] = c.face_vertices[at];
        c.crease_vertices[2 * i + 1] = c.face_vertices[at + 1];
        c.crease_sharpness[i] = a_sharpness(b);
    }
    for (c.corners = below(b, 4); c.mesh.corner_count < c.corners; c.mesh.corner_count++) {
        c.corner_vertices[c.mesh.corner_count] = below(b, c.vertices);
        c.corner_sharpness[c.mesh.corner_count] = a_sharpness(b);
    }
    for (c.holes = c.faces ? below(b, 4) : 0; c.mesh.hole_count < c.holes; c.mesh.hole_count++)
        c.hole[c.mesh.hole_count] = below(b, c.faces);
}

// UVs like the vertices, with some edited; or any at all, with or without gaps.
static void add_uvs(bytes *b)
{
    int kind = below(b, 4), gaps = below(b, 2);
    if (!kind) return;
    c.mesh.uv_count = c.uvs = VERTICES + below(b, UVS - VERTICES);
    for (int i = 0; i < c.sum; i++)
        c.face_uvs[i] = kind < 3 ? c.face_vertices[i] : below(b, c.uvs + gaps) - gaps;
    for (int i = kind == 2 && c.sum ? below(b, 16) : 0; i > 0; i--)
        c.face_uvs[below(b, c.sum)] = below(b, c.uvs + gaps) - gaps;
    for (int i = 0; i < 2 * c.uvs; i++) c.uv[i] = (float)(i * i % 37) / 37;
}

static void add_statements(bytes *b)
{
    static char texts[8][12] = { "g a", "usemtl b c", "s 1", "s off", "o", "mtllib \\", "s 2", "sx" };
    for (c.statements = below(b, STATEMENTS + 1); c.mesh.statement_count < c.statements; ) {
        int i = c.mesh.statement_count++, last = i ? c.statement_faces[i - 1] : 0;
        c.statement_faces[i] = last + below(b, c.faces - last + 1);
        c.statement[i] = texts[below(b, 7 + wild)];
    }
}

static float any_finite(bytes *b)
{
    float x = any_float(b);
    return x - x == 0 ? x : 1;
}

static void add_values(bytes *b)
{
    static const float scales[] = { 1, 1, 1, 1e-30f, 3e37f, 1, 1, 1 };
    int kind = below(b, 8), colors = below(b, 2);
    for (int i = 0; i < 3 * c.vertices; i++) {
        float x = (float)(i * i % 29) / 8 + (float)(take(b) - 128) / 64;
        c.positions[i] = kind == 7 ? any_finite(b) : scales[kind] * x + (kind == 6 ? 1e5f : 0);
        c.colors[i] = x;
        c.normals[i] = i % 3 == 1;
    }
    if (colors) c.mesh.colors = c.colors;
    if (below(b, 2)) c.mesh.normals = c.normals;
}

// Averages at regular vertices as the standard does not: weights of bytes, which sum to 1.
static void own_weights(void *user, int valence, double weights[3])
{
    const double *w = (const double *)user;
    REQUIRE(user == weights_of_rule && valence > 0);
    REQUIRE(weights[0] == 0 && weights[1] == 0 && weights[2] == 0);
    weights[1] = w[0] / valence;
    weights[2] = c.mesh.scheme == SUBDIV_LOOP ? 0 : w[1] / valence;
    weights[0] = 1 - weights[1] - weights[2];
}

static void set_rules(bytes *b)
{
    subdiv_mesh *m = &c.mesh;
    m->boundary = (subdiv_boundary)below(b, 3);
    m->creasing = (subdiv_creasing)below(b, 2);
    m->triangles = (subdiv_triangles)below(b, 2);
    m->uv_rule = (subdiv_uv_rule)below(b, 6);
    if (below(b, 4) == 3) m->vertex_rule = (subdiv_vertex_rule)below(b, 5);
    if (below(b, 8) != 7) return;
    weights_of_rule[0] = (double)below(b, 64) / 16;
    weights_of_rule[1] = (double)below(b, 64) / 16;
    m->vertex_weights = own_weights;
    m->vertex_user = weights_of_rule;
}

// Breaks one thing. A count that is larger than its array would be a lie, not an error.
static void poke(bytes *b)
{
    subdiv_mesh *m = &c.mesh;
    int *counts[] = { &m->vertex_count, &m->face_count, &m->crease_count, &m->corner_count,
                      &m->hole_count, &m->uv_count, &m->statement_count, &m->face_size };
    int *indices[] = { m->face_vertices, m->face_uvs, m->crease_vertices, m->corner_vertices,
                       m->holes, m->statement_faces, m->face_sizes };
    float *numbers[] = { m->positions, m->uvs, m->colors, m->normals, m->crease_sharpness };
    int i;
    switch (below(b, 6)) {
    case 0:
        i = below(b, 8);
        *counts[i] = below(b, 2) ? below(b, *counts[i]) : -1 - take(b);
        break;
    case 1: case 2:
        i = below(b, 7);
        if (indices[i]) indices[i][below(b, i < 2 ? c.sum : i == 6 ? c.faces : 4)] = any_int(b);
        break;
    case 3:
        i = below(b, 5);
        if (numbers[i]) numbers[i][below(b, i < 1 ? 3 * c.vertices : 4)] = any_float(b);
        break;
    case 4:
        i = below(b, 6);
        if (i == 0) m->scheme = (subdiv_scheme)any_int(b);
        if (i == 1) m->boundary = (subdiv_boundary)any_int(b);
        if (i == 2) m->creasing = (subdiv_creasing)any_int(b);
        if (i == 3) m->triangles = (subdiv_triangles)any_int(b);
        if (i == 4) m->uv_rule = (subdiv_uv_rule)any_int(b);
        if (i == 5) m->vertex_rule = (subdiv_vertex_rule)any_int(b);
        break;
    default:
        i = below(b, 8);
        if (i == 0) m->positions = NULL;
        if (i == 1) m->face_vertices = NULL;
        if (i == 2) m->face_sizes = NULL;
        if (i == 3) m->crease_sharpness = NULL;
        if (i == 4) m->corner_vertices = NULL;
        if (i == 5) m->holes = NULL;
        if (i == 6) m->face_uvs = NULL;
        if (i == 7) m->statements = NULL;
    }
}

static void make_cage(bytes *b)
{
    subdiv_mesh *m = &c.mesh;
    memset(&c, 0, sizeof c);
    m->scheme = (subdiv_scheme)below(b, 3);
    int shape = below(b, 5), triangles = m->scheme == SUBDIV_LOOP && !chance(b, 8);
    if (shape == 0) add_grid(b, triangles);
    else if (shape == 1) add_fan(b, triangles);
    else if (shape == 2) add_prism(b, triangles);
    else add_soup(b, triangles);
    for (int edits = below(b, 4); edits > 0; edits--) edit(b);
    if (chance(b, 4) && c.vertices < VERTICES) c.vertices++;            // one without faces
    set_rules(b);
    add_tags(b);
    add_uvs(b);
    add_statements(b);
    add_values(b);
    int sizes = 0;
    for (int f = 0; f < c.faces; f++) sizes |= c.face_sizes[f] != c.face_sizes[0];
    m->vertex_count = c.vertices;
    m->face_count = c.faces;
    m->face_size = sizes || chance(b, 8) ? 0 : c.face_sizes[0];
    m->positions = c.positions;
    m->face_sizes = c.face_sizes;
    m->face_vertices = c.face_vertices;
    m->crease_vertices = c.crease_vertices;
    m->crease_sharpness = c.crease_sharpness;
    m->corner_vertices = c.corner_vertices;
    m->corner_sharpness = c.corner_sharpness;
    m->holes = c.hole;
    m->uvs = c.uv;
    m->face_uvs = c.face_uvs;
    m->statement_faces = c.statement_faces;
    m->statements = c.statement;
    for (int pokes = wild ? 1 + below(b, 3) : 0; pokes > 0; pokes--) poke(b);
}

#define ARRAYS(DO)                                                                          \
    DO(positions, 3 * c.vertices) DO(colors, 3 * c.vertices) DO(normals, 3 * c.vertices)    \
    DO(face_sizes, c.faces) DO(face_vertices, c.sum) DO(face_uvs, c.sum)                    \
    DO(crease_vertices, 2 * c.creases) DO(crease_sharpness, c.creases)                      \
    DO(corner_vertices, c.corners) DO(corner_sharpness, c.corners) DO(holes, c.holes)       \
    DO(uvs, 2 * c.uvs) DO(statement_faces, c.statements) DO(statements, c.statements)

static void lend(void)
{
    lent = c.mesh;
#define LEND(name, count) lent.name = copy_of(c.mesh.name, (size_t)(count), sizeof *lent.name);
    ARRAYS(LEND)
}

// Inputs are as they were.
static void take_back(void)
{
#define COMPARE(name, count) if (lent.name) REQUIRE(                                        \
        same_bytes(lent.name, c.mesh.name, count, sizeof *lent.name));                      \
    free(lent.name); lent.name = c.mesh.name;
    ARRAYS(COMPARE)
    REQUIRE(memcmp(&lent, &c.mesh, sizeof lent) == 0);
}

// ------------------------------------------------------------------------------------- the options

// Lends threads that take the jobs in the wrong order.
static void run_backwards(void *user, void (*job)(void *, int), void *context, int count)
{
    REQUIRE(user == &how && count > 1);
    while (count-- > 0) job(context, count);
}

static subdiv_options options(int threads)
{
    subdiv_options opt = fresh_options();
    subdiv_error *to = opt.error;
    opt = how;
    opt.error = to;
    opt.user = &how;
    opt.run = threads ? run_backwards : NULL;
    return opt;
}

// How far the values of the cage reach, as sums of them may; infinite if one is not a number.
static float reach_of(const float *values, size_t count)
{
    float most = 0;
    for (size_t i = 0; i < count; i++)
        most = values[i] == values[i] ? fmaxf(most, fabsf(values[i])) : HUGE_VALF;
    return most;
}

static float reach(void)
{
    return reach_of(c.positions, 3 * (size_t)c.vertices);
}

// How far results reach from values up to most: rules of one's own may go beyond them.
static float bound(float most)
{
    return (c.mesh.vertex_weights ? 10000 : 4) * most;
}

static int same_result(const subdiv_mesh *a, const subdiv_mesh *b)
{
    return same_mesh(a, b) && !a->normals == !b->normals && !a->cage_faces == !b->cage_faces &&
           same_bytes(a->normals, b->normals, a->normals ? 3 * a->vertex_count : 0, sizeof(float)) &&
           same_bytes(a->cage_faces, b->cage_faces, a->cage_faces ? a->face_count : 0, sizeof(int));
}

// ----------------------------------------------------------------------------- refinement as a mesh

static void refine_again(const subdiv_mesh *fine, int levels)
{
    subdiv_info info;
    subdiv_mesh twice, once;
    subdiv_options opt = options(0);
    REQUIRE(settled(subdiv_inspect(&info, fine, &opt)));
    REQUIRE(settled_mesh(subdiv_refine(&twice, fine, 1, &opt), &twice));
    REQUIRE(settled_mesh(subdiv_refine(&once, &lent, levels + 1, &opt), &once));
    REQUIRE(settled(subdiv_inspect(&info, &lent, &opt)));
    if (!info.nonmanifold_edge_count && lent.boundary != SUBDIV_BOUNDARY_NONE && !opt.limit &&
        (!lent.hole_count || opt.keep_holes) && reach() < 1e6f && reach() > 1e-6f) {
        REQUIRE(once.vertex_count == twice.vertex_count && once.face_count == twice.face_count);
        REQUIRE(points_apart(once.positions, twice.positions, once.vertex_count, 3) <
                1e-5 * (double)reach());
    }
    subdiv_mesh_free(&once);
    subdiv_mesh_free(&twice);
}

static void door_refine(bytes *b)
{
    int levels = below(b, 4), fit = 0;
    subdiv_mesh fine, other;
    subdiv_surface *surface = (subdiv_surface *)&fine;
    subdiv_options opt = options(0);
    memset(&fine, 0x55, sizeof fine);
    memset(&other, 0, sizeof other);
    int made = settled_mesh(subdiv_refine(&fine, &lent, levels, &opt), &fine);
    opt = options(1);
    int prepared = settled(subdiv_prepare(&surface, &lent, levels, &opt));
    if (prepared)
        fit = settled_mesh(subdiv_surface_mesh(&other, surface, lent.positions, &opt), &other);
    else REQUIRE(!surface);
    REQUIRE(made == (prepared && fit));
    if (made) {
        REQUIRE(same_result(&fine, &other));
        REQUIRE(all_in(fine.cage_faces, (size_t)fine.face_count, 0, lent.face_count));
        REQUIRE(fine.vertex_count == subdiv_surface_vertex_count(surface));
        REQUIRE(fine.face_count == subdiv_surface_face_count(surface));
        REQUIRE(reach_of(fine.positions, 3 * (size_t)fine.vertex_count) <= bound(reach()));
        if (levels < 2) refine_again(&fine, levels);
    }
    subdiv_surface_free(surface);
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&other);
}

// ------------------------------------------------------------------------- refinement into arrays

static float *make_values(bytes *b, int stride, int count)
{
    float *values = (float *)need((size_t)stride * (size_t)count * sizeof(float));
    for (int i = 0; i < stride * count; i++) values[i] = (float)(take(b) + i % 7) / 16;
    return values;
}

// An array without values; what stands between those that a call writes has to stay.
static float *make_out(int stride, int count)
{
    size_t size = (size_t)stride * (size_t)count * sizeof(float);
    float *out = (float *)need(size);
    memset(out, 0x7e, size);
    return out;
}

// What a call wrote is the whole, from a point on; between it there is what was there before.
static void check_part(const float *part, const float *whole, int first, int count, int stride,
                       int channels)
{
    uint32_t bits;
    for (int i = 0; i < count; i++) {
        REQUIRE(memcmp(part + (size_t)i * (size_t)stride,
                       whole + (size_t)(first + i) * (size_t)channels,
                       (size_t)channels * sizeof(float)) == 0);
        for (int k = channels; k < stride; k++) {
            memcpy(&bits, part + (size_t)i * (size_t)stride + k, sizeof bits);
            REQUIRE(bits == 0x7e7e7e7e);
        }
    }
}

// Makes part of the points, from all faces in two ranges.
static void make_part(const subdiv_surface *s, int channels, const void *scratch, bytes *b,
                      const float *whole)
{
    int faces = subdiv_surface_cage_face_count(s), points = subdiv_surface_vertex_count(s);
    int first = below(b, points + 1), count = below(b, points - first + 1), cut = below(b, faces + 1);
    int stride = channels + below(b, 3);
    float *out = make_out(stride, count);
    subdiv_options opt = options(below(b, 2));
    REQUIRE(settled(subdiv_evaluate_faces(s, channels, scratch, cut, faces - cut, first, count, out,
                                          stride, &opt)));
    REQUIRE(settled(subdiv_evaluate_faces(s, channels, scratch, 0, cut, first, count, out,
                                          stride, &opt)));
    check_part(out, whole, first, count, stride, channels);
    REQUIRE(subdiv_evaluate_faces(s, channels, scratch, 0, faces + 1, 0, points, out, stride, &opt) ==
            SUBDIV_ERROR_INDEX);
    free(out);
}

// The stencils of some points sum up the values to those points.
static void check_stencils(const subdiv_surface *s, int inputs, const float *in, int stride,
                           const float *whole, int channels, bytes *b)
{
    int points = subdiv_surface_vertex_count(s), first = below(b, points + 1);
    int count = below(b, points - first + 1);
    subdiv_stencils made;
    subdiv_options opt = options(0);
    memset(&made, 0x55, sizeof made);
    REQUIRE(settled(subdiv_refined_stencils(&made, s, first, count, &opt)));
    REQUIRE(made.count == count && made.offsets[0] == 0);
    for (int i = 0; i < count; i++) {
        double sum = 0, value = 0, most = 0;
        for (size_t k = made.offsets[i]; k < made.offsets[i + 1]; k++) {
            REQUIRE(all_in(made.indices + k, 1, k > made.offsets[i] ? made.indices[k - 1] + 1 : 0,
                           inputs));
            sum += (double)made.weights[k];
            most = fmax(most, fabs((double)made.weights[k]));
            value += (double)made.weights[k] *
                     (double)in[(size_t)made.indices[k] * (size_t)stride];
        }
        REQUIRE(fabs(sum - 1) <= 1e-6 * fmax(most, 1));
        REQUIRE(fabs(value - (double)whole[(size_t)(first + i) * (size_t)channels]) <=
                1e-4 * fmax(most, 1));
    }
    subdiv_stencils_free(&made);
    REQUIRE(is_zero(&made, sizeof made));
}

// What is true of the sizes and faces of a result. inputs: the numbers that a value may have.
static void check_surface(const subdiv_surface *s)
{
    int points = subdiv_surface_vertex_count(s), faces = subdiv_surface_face_count(s);
    int size = subdiv_surface_face_size(s), edges = subdiv_surface_edge_count(s);
    int *vertices = (int *)need((size_t)size * (size_t)faces * sizeof(int));
    int *of = (int *)need((size_t)faces * sizeof(int));
    int *ends = (int *)need(2 * (size_t)edges * sizeof(int));
    subdiv_options opt = options(0);
    if (settled(subdiv_surface_faces(s, vertices, of, &opt))) {
        REQUIRE(all_in(vertices, (size_t)size * (size_t)faces, -1, points));
        REQUIRE(all_in(of, (size_t)faces, 0, lent.face_count));
    } else REQUIRE(size == 0);
    subdiv_surface_edges(s, ends);
    REQUIRE(all_in(ends, 2 * (size_t)edges, 0, points));
    for (int e = 0; e < edges; e++) REQUIRE(ends[2 * e] <= ends[2 * e + 1]);
    for (int f = 0, last = 0; f <= subdiv_surface_cage_face_count(s); f++) {
        int inside = subdiv_first_inside(s, f);
        REQUIRE(inside >= last && inside <= points);
        last = inside;
    }
    free(vertices), free(of), free(ends);
}

static void evaluate(const subdiv_surface *s, int inputs, bytes *b)
{
    int channels = 1 + below(b, 9), in_stride = channels + below(b, 3);
    int points = subdiv_surface_vertex_count(s);
    size_t size = subdiv_scratch_size(s, channels);
    float *in = make_values(b, in_stride, inputs), *whole = make_out(channels, points);
    float *again = make_out(channels, points);
    void *scratch = need(size);
    subdiv_options opt = options(0);
    memset(scratch, 0xff, size);
    check_surface(s);
    REQUIRE(settled(subdiv_evaluate(s, channels, in, in_stride, whole, 0, NULL, &opt)));
    REQUIRE(all_within(whole, (size_t)channels * (size_t)points, bound(17)));
    opt = options(1);
    REQUIRE(settled(subdiv_evaluate(s, channels, in, in_stride, again, channels, scratch, &opt)));
    check_part(again, whole, 0, points, channels, channels);
    memset(scratch, 0xff, size);
    REQUIRE(settled(subdiv_evaluate_begin(s, channels, in, in_stride, scratch, &opt)));
    make_part(s, channels, scratch, b, whole);
    make_part(s, channels, scratch, b, whole);
    check_stencils(s, inputs, in, in_stride, whole, channels, b);
    free(in), free(whole), free(again), free(scratch);
}

static void door_evaluate(bytes *b)
{
    subdiv_surface *s = (subdiv_surface *)&lent;
    subdiv_options opt = options(0);
    if (settled(subdiv_prepare(&s, &lent, below(b, 4), &opt))) evaluate(s, lent.vertex_count, b);
    else REQUIRE(!s);
    subdiv_surface_free(s);
}

static void door_values(bytes *b)
{
    int count = below(b, 2 + c.vertices), *indices = (int *)need((size_t)c.sum * sizeof(int));
    int levels = below(b, 4), gaps = below(b, 2);
    subdiv_surface *s = (subdiv_surface *)&lent;
    subdiv_options opt = options(0);
    for (int i = 0; i < c.sum; i++)
        indices[i] = wild && chance(b, 64) ? any_int(b)
                   : gaps && chance(b, 8) ? -1 : c.face_vertices[i] % (count ? count : 1);
    int made = settled(subdiv_prepare_face_varying(&s, &lent, count, indices,
                                                   (subdiv_uv_rule)below(b, 6 + wild), levels, &opt));
    if (made) evaluate(s, count, b);
    else REQUIRE(!s);
    subdiv_surface_free(s);
    free(indices);
}

// -------------------------------------------------------------------------------------- the limit

static void door_limit(bytes *b)
{
    subdiv_surface *s = NULL;
    subdiv_options opt = options(0);
    how.limit = opt.limit = 1;
    if (!settled(subdiv_prepare(&s, &lent, below(b, 4), &opt))) return;
    int points = subdiv_surface_vertex_count(s), faces = subdiv_surface_cage_face_count(s);
    int first = below(b, points + 1), count = below(b, points - first + 1), stride = 6 + below(b, 3);
    float *p = make_out(3, points), *n = make_out(3, points), *t = make_out(6, points);
    float *part_p = make_out(stride, count), *part_n = make_out(stride, count);
    float *part_t = make_out(stride, count);
    void *scratch = need(subdiv_scratch_size(s, 3));
    subdiv_limit whole = { p, n, t, 0 }, part = { part_p, part_n, part_t, stride };
    subdiv_mesh fine;
    if (lent.positions && reach() < 1e30f) {
        REQUIRE(settled(subdiv_evaluate_limit(s, lent.positions, 0, &whole, NULL, &opt)));
        REQUIRE(settled(subdiv_evaluate_begin(s, 3, lent.positions, 3, scratch, &opt)));
        opt = options(1);
        REQUIRE(settled(subdiv_evaluate_limit_faces(s, scratch, 0, faces, first, count, &part,
                                                    &opt)));
        check_part(part_p, p, first, count, stride, 3);
        check_part(part_n, n, first, count, stride, 3);
        check_part(part_t, t, first, count, stride, 6);
        for (int i = 0; i < points; i++) REQUIRE(is_normal(n + 3 * (size_t)i));
        REQUIRE(all_within(p, 3 * (size_t)points, bound(reach())));
        REQUIRE(all_within(t, 6 * (size_t)points, FLT_MAX));
        if (settled_mesh(subdiv_surface_mesh(&fine, s, lent.positions, &opt), &fine)) {
            REQUIRE(same_bytes(fine.positions, p, 3 * points, sizeof(float)));
            REQUIRE(same_bytes(fine.normals, n, 3 * points, sizeof(float)));
        }
        subdiv_mesh_free(&fine);
    }
    free(p), free(n), free(t), free(part_p), free(part_n), free(part_t), free(scratch);
    evaluate(s, lent.vertex_count, b);
    subdiv_surface_free(s);
}

// ------------------------------------------------------------------------------------- anywhere

enum { LOCATIONS = 8 };

static float a_parameter(bytes *b)
{
    static const float usual[] = { 0, 1, 0.5f, 0.25f, 0.75f, 1e-5f, 1e-20f, 0.99999994f };
    int i = below(b, 16);
    return i < 8 ? usual[i] : i == 8 && wild ? any_float(b) : (float)take(b) / 255;
}

static subdiv_location a_location(bytes *b, int faces)
{
    subdiv_location at = { below(b, faces), 0, a_parameter(b), a_parameter(b) };
    if (lent.scheme == SUBDIV_LOOP && !wild) at.v = fminf(at.v, 1 - at.u);
    else if (faces == c.faces && c.face_sizes[at.face] != 4) at.corner = below(b, c.face_sizes[at.face]);
    if (wild && chance(b, 8)) at.face = any_int(b);
    if (wild && chance(b, 8)) at.corner = any_int(b);
    return at;
}

// The points and their stencils, all at once and one by one. inputs: vertices or values of in.
static void sample(const subdiv_surface *s, int inputs, const float *in, int channels, bytes *b)
{
    enum { MOST = 8 };
    float values[6][MOST * LOCATIONS], normals[3 * LOCATIONS], one[MOST], one_normal[3];
    subdiv_location at[LOCATIONS];
    int count = 1 + below(b, LOCATIONS), faces = subdiv_surface_cage_face_count(s);
    size_t size = subdiv_scratch_size(s, channels);
    void *scratch = need(size);
    subdiv_derivatives out = { values[0], values[1], values[2], values[3], values[4], values[5],
                               channels > 2 ? normals : NULL, 0 };
    subdiv_stencils made;
    subdiv_options opt = options(1);
    for (int i = 0; i < count; i++) at[i] = a_location(b, faces);
    if (faces == 0 && !wild) count = 0;
    memset(scratch, 0xff, size);
    REQUIRE(settled(subdiv_evaluate_begin(s, channels, in, 0, scratch, &opt)));
    int good = settled(subdiv_evaluate_at(s, channels, scratch, count, at, &out, &opt));
    REQUIRE(good || (wild && (error.code == SUBDIV_ERROR_INDEX ||
                              error.code == SUBDIV_ERROR_ARGUMENT)));
    memset(&made, 0x55, sizeof made);
    REQUIRE(settled(subdiv_stencils_at(&made, s, count, at, &opt)) == good);
    if (!good) REQUIRE(is_zero(&made, sizeof made));
    float most = reach_of(in, (size_t)channels * (size_t)inputs);
    for (int i = 0; i < count && good; i++) {
        subdiv_derivatives out_one = { one, NULL, NULL, NULL, NULL, NULL,
                                       channels > 2 ? one_normal : NULL, 0 };
        REQUIRE(settled(subdiv_evaluate_at(s, channels, scratch, 1, at + i, &out_one, &opt)));
        REQUIRE(memcmp(one, values[0] + i * channels, (size_t)channels * sizeof(float)) == 0);
        REQUIRE(all_within(one, (size_t)channels, bound(most)));
        if (channels > 2) {
            REQUIRE(is_normal(one_normal));
            REQUIRE(memcmp(one_normal, normals + 3 * i, sizeof one_normal) == 0);
        }
        double value = 0, largest = 0, sum = 0;
        for (size_t k = made.offsets[i]; k < made.offsets[i + 1]; k++) {
            REQUIRE(all_in(made.indices + k, 1, k > made.offsets[i] ? made.indices[k - 1] + 1 : 0,
                           inputs));
            value += (double)made.weights[k] * (double)in[channels * made.indices[k]];
            sum += (double)made.weights[k];
            largest = fmax(largest, fabs((double)made.weights[k]));
        }
        REQUIRE(fabs(value - (double)one[0]) <= 1e-5 * fmax(1, largest) * (double)most);
        REQUIRE(made.offsets[i] == made.offsets[i + 1] || fabs(sum - 1) <= 1e-6 * fmax(1, largest));
    }
    subdiv_stencils_free(&made);
    free(scratch);
}

// At the corners of faces there are the vertices of the limit.
static void meet_limit(const subdiv_surface *s)
{
    subdiv_mesh limit;
    subdiv_options opt = options(0);
    opt.limit = 1;
    void *scratch = need(subdiv_scratch_size(s, 3));
    REQUIRE(settled_mesh(subdiv_refine(&limit, &lent, 0, &opt), &limit));
    REQUIRE(settled(subdiv_evaluate_begin(s, 3, lent.positions, 3, scratch, &opt)));
    const int *v = lent.face_vertices;
    for (int f = 0; f < lent.face_count; v += size_of_face(&lent, f++))
        for (int i = 0; i < size_of_face(&lent, f); i++) {
            static const float u[4] = { 0, 1, 1, 0 }, w[4] = { 0, 0, 1, 1 };
            int size = size_of_face(&lent, f), quad = size == 4, loop = lent.scheme == SUBDIV_LOOP;
            subdiv_location at = { f, quad || loop ? 0 : i, quad || loop ? u[i] : 0, quad ? w[i] : 0 };
            float p[3], n[3];
            subdiv_derivatives out = { p, NULL, NULL, NULL, NULL, NULL, n, 0 };
            if (loop) at.u = i == 1, at.v = i == 2;
            REQUIRE(settled(subdiv_evaluate_at(s, 3, scratch, 1, &at, &out, &opt)));
            if (is_zero(p, sizeof p) && is_zero(n, sizeof n)) continue;         // no surface
            for (int k = 0; k < 3; k++)
                REQUIRE(fabsf(p[k] - limit.positions[3 * v[i] + k]) <= 1e-5f * reach());
        }
    subdiv_mesh_free(&limit);
    free(scratch);
}

static void door_exact(bytes *b)
{
    int channels = 1 + below(b, 8), values = below(b, 4) == 3;
    subdiv_surface *s = (subdiv_surface *)&lent;
    subdiv_options opt = options(0);
    subdiv_result result = values && c.sum ?
        subdiv_prepare_face_varying(&s, &lent, c.vertices, lent.face_vertices,
                                    (subdiv_uv_rule)below(b, 6), SUBDIV_EXACT, &opt) :
        subdiv_prepare(&s, &lent, SUBDIV_EXACT, &opt);
    if (settled(result)) {
        float *in = make_values(b, channels, c.vertices);
        sample(s, c.vertices, in, channels, b);
        free(in);
        int cut = lent.scheme == SUBDIV_LOOP && c.sum != 3 * c.faces;
        if (!wild && !values && !cut && !how.linear && reach() < 1e30f) meet_limit(s);
    } else REQUIRE(!s);
    subdiv_surface_free(s);
}

// ---------------------------------------------------------------------------------- tessellation

static int last_edge;

static int rate_of_edge(void *user, int edge, const float *a, const float *middle, const float *b)
{
    REQUIRE(edge > last_edge && all_within(a, 3, FLT_MAX) && all_within(middle, 3, FLT_MAX) &&
            all_within(b, 3, FLT_MAX));
    last_edge = edge;
    return (edge * 7 + *(const int *)user) % 6;
}

static int a_rate(bytes *b)
{
    return wild && chance(b, 16) ? any_int(b) : below(b, 6);
}

static int *some_rates(bytes *b, int count)
{
    int *rates = below(b, 2) ? (int *)need((size_t)count * sizeof(int)) : NULL;
    for (int i = 0; i < count && rates; i++) rates[i] = a_rate(b);
    return rates;
}

static void door_tessellate(bytes *b)
{
    subdiv_surface *s = (subdiv_surface *)&lent;
    subdiv_mesh fine, other;
    subdiv_tessellation tiles = {0};
    subdiv_options opt = options(0);
    int salt = take(b), prepared = settled(subdiv_prepare(&s, &lent, SUBDIV_EXACT, &opt)), made = 0;
    int *edges = some_rates(b, prepared ? subdiv_surface_edge_count(s) : 0);
    int *faces = some_rates(b, c.faces);
    tiles.rate = a_rate(b);
    tiles.edge_rates = prepared ? edges : NULL;
    tiles.face_rates = faces;
    tiles.edge_rate = below(b, 4) ? NULL : rate_of_edge;
    tiles.user = &salt;
    tiles.triangles = below(b, 2);
    memset(&fine, 0x55, sizeof fine);
    memset(&other, 0, sizeof other);
    heap_most = 1u << 22;
    last_edge = -1;
    int whole = settled_mesh(subdiv_tessellate(&fine, &lent, &tiles, &opt), &fine);
    last_edge = -1;
    opt = options(1);
    if (prepared)
        made = settled_mesh(subdiv_surface_tessellate(&other, s, lent.positions, &tiles, &opt), &other);
    REQUIRE(made == whole);
    if (whole) {
        REQUIRE(same_result(&fine, &other));
        REQUIRE(all_in(fine.cage_faces, (size_t)fine.face_count, 0, lent.face_count));
        REQUIRE(reach_of(fine.positions, 3 * (size_t)fine.vertex_count) <= bound(reach()));
    }
    heap_most = 1u << 28;
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&other);
    subdiv_surface_free(s);
    free(edges), free(faces);
}

// ----------------------------------------------------------------------------------------- tools

static int reported[SUBDIV_ODDITY_COUNT];

static void report(void *user, const subdiv_finding *finding)
{
    REQUIRE(user == reported && finding->kind >= 0 && finding->kind < SUBDIV_ODDITY_COUNT);
    REQUIRE(finding->face >= -1 && finding->face < lent.face_count);
    REQUIRE(finding->other_face >= -1 && finding->other_face < lent.face_count);
    REQUIRE(finding->vertex >= -1 && finding->vertex < lent.vertex_count);
    REQUIRE(finding->other_vertex >= -1 && finding->other_vertex < lent.vertex_count);
    REQUIRE(finding->text[0]);
    for (int k = finding->kind + 1; k < SUBDIV_ODDITY_COUNT; k++) REQUIRE(!reported[k]);
    reported[finding->kind]++;
}

static void look(void)
{
    subdiv_info info;
    int counts[SUBDIV_ODDITY_COUNT];
    subdiv_options opt = options(0);
    memset(&info, 0x55, sizeof info);
    memset(counts, 0x55, sizeof counts);
    memset(reported, 0, sizeof reported);
    int good = settled(subdiv_inspect(&info, &lent, &opt));
    REQUIRE(settled(subdiv_check(counts, &lent, report, reported, &opt)) == good);
    REQUIRE(memcmp(counts, reported, sizeof counts) == 0);
    if (good) {
        REQUIRE(info.vertex_count == lent.vertex_count && info.face_count == lent.face_count);
        REQUIRE(info.triangle_count + info.quad_count + info.ngon_count == info.face_count);
        REQUIRE(info.infinite_crease_count <= info.crease_count);
        REQUIRE(info.crease_count <= info.edge_count && info.hole_count <= info.face_count);
        REQUIRE(info.isolated_vertex_count == counts[SUBDIV_ODD_UNUSED_VERTEX]);
    } else REQUIRE(is_zero(&info, sizeof info) && is_zero(counts, sizeof counts));
}

static void explain(bytes *b)
{
    int point = wild && chance(b, 4) ? any_int(b) : below(b, 1000);
    size_t capacity = chance(b, 4) ? (size_t)take(b) : 1u << 15;
    char *text = (char *)need(capacity);
    subdiv_options opt = options(0);
    memset(text, 'x', capacity);
    if (settled(subdiv_explain(text, capacity, &lent, point, &opt))) {
        REQUIRE(memchr(text, 0, capacity) && text[0]);
        for (const char *line = text; *line; line++) {
            size_t length = strcspn(line, "\n");
            REQUIRE(length <= 80 && line[length] == '\n');
            line += length;
        }
    } else REQUIRE(capacity == 0 || text[0] == 0);
    free(text);
}

// Changes copies of the struct: a failure leaves them as they were, and the arrays stay.
static void change(bytes *b)
{
    subdiv_mesh with = lent, before;
    float angle = chance(b, 4) ? any_float(b) : (float)take(b), sharpness = a_sharpness(b);
    for (int i = 0; i < 4; i++) {
        subdiv_options opt = options(0);
        with.normals = i ? with.normals : NULL;
        before = with;
        subdiv_result result = i == 0 ? subdiv_normals(&with, &opt)
                             : i == 1 ? subdiv_crease_by_angle(&with, angle, sharpness, &opt)
                             : i == 2 ? subdiv_crease_by_smoothing_groups(&with, sharpness, &opt)
                                      : subdiv_crease_by_uv_seams(&with, sharpness, &opt);
        if (!settled(result)) {
            REQUIRE(memcmp(&with, &before, sizeof with) == 0);
            continue;
        }
        REQUIRE(with.crease_count >= before.crease_count);
        REQUIRE(all_in(with.crease_vertices, 2 * (size_t)with.crease_count, 0, with.vertex_count));
        for (int v = 0; v < with.vertex_count && i == 0; v++)
            REQUIRE(is_normal(with.normals + 3 * (size_t)v));
    }
    subdiv_mesh_free(&with);
    REQUIRE(mesh_is_zero(&with));
}

static void door_tools(bytes *b)
{
    look();
    explain(b);
    change(b);
}

// ------------------------------------------------------------------------------------------- OBJ

static size_t save(const subdiv_mesh *mesh, char **text)
{
    size_t size = 7, again = 7;
    subdiv_options opt = options(0);
    *text = NULL;
    if (!settled(subdiv_save_obj_memory(mesh, NULL, 0, &size, &opt))) {
        REQUIRE(size == 0);
        return 0;
    }
    *text = (char *)need(size);
    REQUIRE(settled(subdiv_save_obj_memory(mesh, *text, size, &again, &opt)) && size == again);
    return size;
}

// What was written and read is written again as the same text; but for normals, which are not read,
// and UVs that no face has.
static void door_obj(void)
{
    subdiv_mesh again, first = lent;
    char *text, *second;
    first.normals = NULL;
    size_t size = save(&first, &text);
    subdiv_options opt = options(0);
    memset(&again, 0x55, sizeof again);
    if (!text) return;
    REQUIRE(settled_mesh(subdiv_load_obj_memory(&again, text, size, &opt), &again));
    if (first.uv_count && !again.uv_count) {
        first.uv_count = 0;
        free(text);
        size = save(&first, &text);
    }
    REQUIRE(save(&again, &second) == size && memcmp(text, second, size) == 0);
    free(text), free(second);
    subdiv_mesh_free(&again);
}

// ------------------------------------------------------------------------------------------- all

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bytes from = { data, data + size }, *b = &from;
    int door = take(b), flags = take(b);
    memset(&how, 0, sizeof how);
    how.triangulate = flags & 1;
    how.keep_holes = flags >> 1 & 1;
    how.linear = (flags & 12) == 12;
    how.limit = flags >> 4 & 1;
    how.no_tags = flags >> 5 & 1;
    wild = flags >> 7 & 1;
    make_cage(b);
    lend();
    if (door % 8 == 0) door_refine(b);
    if (door % 8 == 1) door_evaluate(b);
    if (door % 8 == 2) door_values(b);
    if (door % 8 == 3) door_limit(b);
    if (door % 8 == 4) door_exact(b);
    if (door % 8 == 5) door_tessellate(b);
    if (door % 8 == 6) door_tools(b);
    if (door % 8 == 7) door_obj();
    take_back();
    REQUIRE(heap_live == 0);
    return 0;
}

#include "replay.h"
