// Time grows with the mesh and the result alone, whatever there is much of: faces at an edge, fans
// at a vertex, copies of a face, sides, valence, entries of a list. Runs every function on a cage
// with N of something and on one with 4 N. Counts operations, not seconds: how often each block of
// code runs, which is the same every time. No block may run more than 6 times as often.
//
// Some results are square themselves: the stencils of level 2 around a vertex of valence N, or in a
// polygon of N sides, have N entries each. Of them a block may run a few times for each entry.
//
//     cc -O1 -fsanitize-coverage=trace-pc -U_FORTIFY_SOURCE -Dmemcpy=counted_memcpy
//        -Dmemset=counted_memset -DSUBDIV_IMPLEMENTATION -x c -c subdiv.h -o build/counted.o
//     cc -I. tests/test_growth.c build/counted.o -o build/test_growth -lm && build/test_growth
//
//     build/test_growth 1          all kinds of lists, UVs and rules on all cages; 2: half of them
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#define SUBDIV_IMPLEMENTED
#include "subdiv.h"
#define CAGE_SCALE 8
#include "lib/cages.h"
#include "lib/test.h"

enum { MANY = 80 };                   // N
enum { BYTES = 64 };                  // copied or cleared: one operation
enum { FEW = 60 };                    // times that a block may run for each of the 4 N, or for each
                                      // item of a result that is square, for reasons of its own

// --------------------------------------------------------------------------- counting operations

typedef struct block {                // of code
    const char *at;
    uint64_t runs[2];                 // with N and with 4 N
} block;

enum { BLOCKS = 1 << 15 };            // more than the header has
static block blocks[BLOCKS];          // a hash table
static int counting = -1;             // 0: N; 1: 4 N; -1: not

static void count_block(const void *at, uint64_t times)
{
    size_t i = ((size_t)(uintptr_t)at * 0x9e3779b1u >> 8) % BLOCKS;
    if (counting < 0) return;
    while (blocks[i].at && blocks[i].at != (const char *)at) i = (i + 1) % BLOCKS;
    blocks[i].at = (const char *)at;
    blocks[i].runs[counting] += times;
}

void __sanitizer_cov_trace_pc(void);
void *counted_memcpy(void *to, const void *from, size_t size);
void *counted_memset(void *to, int byte, size_t size);

void __sanitizer_cov_trace_pc(void)
{
    count_block(__builtin_return_address(0), 1);
}

void *counted_memcpy(void *to, const void *from, size_t size)
{
    count_block(__builtin_return_address(0), size / BYTES);
    return memcpy(to, from, size);
}

void *counted_memset(void *to, int byte, size_t size)
{
    count_block(__builtin_return_address(0), size / BYTES);
    return memset(to, byte, size);
}

// ------------------------------------------------------------------------------------- cages

static test_cage cage;
static float uvs[2 * CAGE_FACE_VERTICES];
static int   face_uvs[CAGE_FACE_VERTICES];
static char *statements[CAGE_FACES];
static int   statement_faces[CAGE_FACES];

static void new_vertices(int n)
{
    for (int i = 0; i < n; i++) cage_vertex(&cage, 0, 0, 0);
}

static void book(subdiv_scheme scheme, int n)
{
    build_fins(&cage, scheme, n, 1);
}

static void long_book(subdiv_scheme scheme, int n)
{
    build_fins(&cage, scheme, n / 4, 4);
}

// Faces at an edge, wound either way.
static void turned_book(subdiv_scheme scheme, int n)
{
    cage_clear(&cage, scheme);
    new_vertices(n + 2);
    for (int i = 0; i < n; i++) cage_triangle(&cage, i % 2, 1 - i % 2, i + 2);
}

// Sheets at a vertex from one edge with many faces to another.
static void through(subdiv_scheme scheme, int n)
{
    cage_clear(&cage, scheme);
    new_vertices(3);
    for (int i = 0; i < n; i++) {
        int v = cage.mesh.vertex_count;
        new_vertices(3);
        cage_quad(&cage, 1, 0, v, v + 1);
        cage_quad(&cage, v, 0, 2, v + 2);
    }
}

// Sheets at a vertex that begin and end at the same edge.
static void rings(subdiv_scheme scheme, int n)
{
    cage_clear(&cage, scheme);
    new_vertices(2 + 2 * n);
    for (int i = 0; i < n; i++) {
        int a = 2 + i, b = 2 + n + i;
        cage_triangle(&cage, 0, 1, a);
        cage_triangle(&cage, 0, a, b);
        cage_triangle(&cage, 0, b, 1);
    }
}

static void fins(subdiv_scheme scheme, int n)
{
    cage_clear(&cage, scheme);
    new_vertices(1);
    for (int i = 0; i < n; i++) {
        int v = cage.mesh.vertex_count;
        new_vertices(5);
        cage_quad(&cage, 0, v, v + 1, v + 2);
        cage_quad(&cage, 0, v + 2, v + 3, v + 4);
    }
}

static void single_fins(subdiv_scheme scheme, int n)
{
    cage_clear(&cage, scheme);
    new_vertices(1);
    for (int i = 0; i < n; i++) {
        int v = cage.mesh.vertex_count;
        new_vertices(2);
        cage_triangle(&cage, 0, v, v + 1);
    }
}

static void copies(subdiv_scheme scheme, int n)
{
    cage_clear(&cage, scheme);
    new_vertices(4);
    for (int i = 0; i < n; i++) cage_quad(&cage, 0, 1, 2, 3);
}

static void triangles(subdiv_scheme scheme, int n)
{
    cage_clear(&cage, scheme);
    new_vertices(3);
    for (int i = 0; i < n; i++) cage_triangle(&cage, 0, 1, 2);
}

static void turned_copies(subdiv_scheme scheme, int n)
{
    cage_clear(&cage, scheme);
    new_vertices(5);
    for (int i = 0; i < n; i++) {
        int a = i % 5, b = (i + 1 + i / 5 % 3) % 5, c = (i + 4) % 5;
        if (a != b && b != c) cage_triangle(&cage, a, b, c);
    }
}

static void wheel(subdiv_scheme scheme, int n)
{
    build_fan(&cage, scheme, n, 1);
}

static void half_wheel(subdiv_scheme scheme, int n)
{
    build_fan(&cage, scheme, n, 0);
}

// Three copies of each face around a vertex.
static void thick_wheel(subdiv_scheme scheme, int n)
{
    build_fan(&cage, scheme, n, 1);
    int count = face_vertex_count(&cage.mesh), faces = cage.mesh.face_count;
    if (3 * count > CAGE_FACE_VERTICES || 3 * faces > CAGE_FACES) abort();
    for (int i = count; i < 3 * count; i++) cage.face_vertices[i] = cage.face_vertices[i - count];
    for (int i = faces; i < 3 * faces; i++) cage.face_sizes[i] = cage.face_sizes[i - faces];
    cage.mesh.face_count *= 3;
}

// Vertices with many faces in pairs: each edge of the one leads to the other.
static void bipyramid(subdiv_scheme scheme, int n)
{
    build_bipyramid(&cage, scheme, n);
}

// Two faces of many sides, back to back; and one more along them.
static void polygons(subdiv_scheme scheme, int n)
{
    static int sides[CAGE_FACE_VERTICES];
    cage_clear(&cage, scheme);
    new_vertices(n);
    for (int i = 0; i < n; i++) sides[i] = i;
    cage_face(&cage, n, sides);
    for (int i = 0; i < n; i++) sides[i] = n - 1 - i;
    cage_face(&cage, n, sides);
    new_vertices(n);
    for (int i = 0; i < n; i++) sides[i] = i % 2 ? n + i : i;
    cage_face(&cage, n, sides);
}

static void polygon(subdiv_scheme scheme, int n)
{
    static int sides[CAGE_FACE_VERTICES];
    cage_clear(&cage, scheme);
    new_vertices(n);
    for (int i = 0; i < n; i++) sides[i] = i;
    cage_face(&cage, n, sides);
}

// A face that has one vertex again and again: in a row, with others between, and as the same edges.
static void repeats(subdiv_scheme scheme, int n)
{
    static int sides[CAGE_FACE_VERTICES];
    cage_clear(&cage, scheme);
    new_vertices(n);
    for (int i = 0; i < n; i++) sides[i] = i < 3 ? i : 3;
    cage_face(&cage, n, sides);
    for (int i = 0; i < n; i++) sides[i] = i % 2 ? 0 : i;
    cage_face(&cage, n, sides);
    for (int i = 0; i < n; i++) sides[i] = i % 3;
    cage_face(&cage, n, sides);
    for (int i = 0; i < n; i++) sides[i] = 0;
    cage_face(&cage, n, sides);
}

static void small_repeats(subdiv_scheme scheme, int n)
{
    cage_clear(&cage, scheme);
    new_vertices(3);
    for (int i = 0; i < n; i++) {
        cage_triangle(&cage, 0, 0, 1);
        cage_triangle(&cage, 1, 1, 1);
        cage_quad(&cage, 0, 1, 0, 2);
    }
}

// Faces of many sizes, next to each other at a vertex.
static void sizes(subdiv_scheme scheme, int n)
{
    int sides[CAGE_FACES], first, used = 0;
    cage_clear(&cage, scheme);
    new_vertices(1);
    for (int size = 3; used < 4 * n; used += size++) {
        first = cage.mesh.vertex_count - (used > 0);
        new_vertices(size - (used > 0));
        sides[0] = 0;
        for (int i = 1; i < size; i++) sides[i] = first + i - 1;
        cage_face(&cage, size, sides);
    }
}

static void alone(subdiv_scheme scheme, int n)
{
    cage_clear(&cage, scheme);
    new_vertices(n);
}

static void strip(subdiv_scheme scheme, int n)
{
    build_grid(&cage, scheme, n, 1);
}

// Faces without a common vertex.
static void apart(subdiv_scheme scheme, int n)
{
    cage_clear(&cage, scheme);
    new_vertices(4 * n);
    for (int i = 0; i < n; i++) cage_quad(&cage, 4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3);
}

static const struct { const char *name; void (*build)(subdiv_scheme scheme, int n); } kinds[] = {
    { "book", book }, { "long book", long_book }, { "turned book", turned_book },
    { "through", through }, { "rings", rings }, { "fins", fins }, { "single fins", single_fins },
    { "copies", copies }, { "triangles", triangles }, { "turned copies", turned_copies },
    { "wheel", wheel }, { "half wheel", half_wheel }, { "thick wheel", thick_wheel },
    { "bipyramid", bipyramid }, { "polygons", polygons }, { "polygon", polygon },
    { "repeats", repeats }, { "small repeats", small_repeats }, { "sizes", sizes },
    { "alone", alone }, { "strip", strip }, { "apart", apart }
};
enum { KINDS = sizeof kinds / sizeof *kinds };

// What a cage may have on top. Each edge of each face is in the list of creases, which so names an
// edge once for each of its faces; or every other one, with many values; or all lists name one item
// n times.
enum { NO_LISTS, EVERY_EDGE, EVERY_OTHER, SAME_ENTRIES, LISTS };
enum { NO_UVS, ONE_VALUE, SAME_AS_VERTICES, ALL_DIFFERENT, BY_TURNS, UV_KINDS };

static void add_lists(int how, int n)
{
    const subdiv_mesh *m = &cage.mesh;
    int h = 0;
    for (int f = 0; f < m->face_count; f++) {
        int size = m->face_sizes[f];
        for (int i = 0; i < size; i++) {
            int a = m->face_vertices[h + i], b = m->face_vertices[h + (i + 1) % size];
            if (how == EVERY_EDGE) cage_crease(&cage, a, b, f % 3 ? 1.5 : SUBDIV_INFINITE);
            if (how == EVERY_OTHER && (f + i) % 2) cage_crease(&cage, a, b, f % 40 / 16.0);
        }
        h += size;
        if (how == EVERY_EDGE && f % 3 == 0) cage_hole(&cage, f);
    }
    for (int v = 0; v < m->vertex_count && how == EVERY_EDGE; v++) cage_corner(&cage, v, v % 3);
    for (int i = 0; i < n && how == SAME_ENTRIES && m->face_count; i++) {
        cage_crease(&cage, m->face_vertices[0], m->face_vertices[1], i % 3);
        cage_crease(&cage, 0, 0, 1);                      // no edge
        cage_corner(&cage, 0, i % 3);
        cage_hole(&cage, 0);
    }
}

static void add_uvs(int how)
{
    subdiv_mesh *m = &cage.mesh;
    int count = face_vertex_count(m), h = 0;
    m->uvs = uvs;
    m->face_uvs = face_uvs;
    m->uv_count = how == NO_UVS ? 0 : how == ALL_DIFFERENT && count ? count : m->vertex_count + 1;
    for (int i = 0; i < 2 * m->uv_count; i++) uvs[i] = (float)(i * 37 % 101);
    for (int f = 0; f < m->face_count; f++)
        for (int i = 0; i < m->face_sizes[f]; i++, h++)
            face_uvs[h] = how == ONE_VALUE ? 0 : how == BY_TURNS ? f % 2 :
                          how == ALL_DIFFERENT ? h : m->face_vertices[h];
}

static void add_statements(void)
{
    static char texts[2][8] = { "s 1", "s off" };
    cage.mesh.statements = statements;
    cage.mesh.statement_faces = statement_faces;
    for (int f = 0; f < cage.mesh.face_count; f++) {
        statements[f] = texts[f % 2];
        statement_faces[f] = f;
    }
    cage.mesh.statement_count = cage.mesh.face_count;
}

// Positions as if at random, so that faces are no thinner where there are more of them.
static void add_positions(void)
{
    unsigned state = 1;
    for (int i = 0; i < 3 * cage.mesh.vertex_count; i++) {
        state = state * 1664525u + 1013904223u;
        cage.positions[i] = (float)(state >> 8);
    }
}

// variant picks the rules. A mesh whose faces have one size says so.
static const subdiv_mesh *build(int kind, int scheme, int lists, int uv, int variant, int n)
{
    subdiv_mesh *m = &cage.mesh;
    kinds[kind].build((subdiv_scheme)scheme, n);
    add_lists(lists, n);
    add_uvs(uv);
    add_statements();
    add_positions();
    m->boundary = (subdiv_boundary)(variant % 3);
    m->creasing = (subdiv_creasing)(variant % 2);
    m->triangles = (subdiv_triangles)(variant / 2 % 2);
    m->uv_rule = (subdiv_uv_rule)(variant % 6);
    int same = m->face_count > 0;
    for (int f = 0; f < m->face_count; f++) same &= m->face_sizes[f] == m->face_sizes[0];
    if (same) m->face_size = m->face_sizes[0];
    return m;
}

// --------------------------------------------------------------------------------- functions
// Each calls one public function, or what it needs besides, and returns the size of what it makes.

static subdiv_options options;
static subdiv_error error;

static size_t size_of_mesh(const subdiv_mesh *m)
{
    size_t corners = 0;
    for (int f = 0; f < m->face_count; f++) corners += (size_t)face_size(m, f);
    return (size_t)m->vertex_count + (size_t)m->uv_count + corners;
}

static size_t refine(const subdiv_mesh *m, int levels)
{
    subdiv_mesh fine;
    CHECK_EQUAL(subdiv_refine(&fine, m, levels, &options), SUBDIV_OK);
    size_t size = size_of_mesh(&fine);
    subdiv_mesh_free(&fine);
    return size;
}

static size_t refine_limit(const subdiv_mesh *m, int levels)
{
    options.limit = 1;
    size_t size = refine(m, levels);
    options.limit = 0;
    return size;
}

static int ask_rate(void *user, int edge, const float *a, const float *middle, const float *b)
{
    (void)user, (void)a, (void)middle, (void)b;
    return 1 + edge % 3;
}

// By rates of the faces, or of the edges, for which the library asks.
static size_t tessellate(const subdiv_mesh *m, int ask)
{
    static int rates[CAGE_FACES];
    subdiv_mesh fine;
    subdiv_tessellation how = { 0 };
    if (ask) how.edge_rate = ask_rate;
    else how.face_rates = rates;
    for (int f = 0; f < m->face_count; f++) rates[f] = f % 4;
    CHECK_EQUAL(subdiv_tessellate(&fine, m, &how, &options), SUBDIV_OK);
    size_t size = size_of_mesh(&fine);
    subdiv_mesh_free(&fine);
    return size;
}

// Evaluates five channels, face by face.
static size_t in_pieces(const subdiv_mesh *m, int levels)
{
    subdiv_surface *s;
    CHECK_EQUAL(subdiv_prepare(&s, m, levels, &options), SUBDIV_OK);
    size_t count = (size_t)subdiv_surface_vertex_count(s);
    float *out = (float *)malloc((5 * count + 1) * sizeof *out);
    float *in = (float *)calloc(5 * (size_t)m->vertex_count, sizeof *in);
    void *scratch = malloc(subdiv_scratch_size(s, 5) + 1);
    int *ends = (int *)malloc((2 * (size_t)subdiv_surface_edge_count(s) + 1) * sizeof *ends);
    subdiv_surface_edges(s, ends);
    subdiv_evaluate_begin(s, 5, in, 0, scratch, &options);
    for (int f = 0; f < subdiv_surface_cage_face_count(s); f++) {
        int first = subdiv_first_inside(s, f), next = subdiv_first_inside(s, f + 1);
        subdiv_evaluate_faces(s, 5, scratch, f, 1, first, next - first, out, 0, &options);
    }
    subdiv_surface_free(s);
    free(ends), free(in), free(out), free(scratch);
    return count;
}

// What draws a limit mesh, and where its points are.
static size_t buffers(const subdiv_mesh *m, int levels)
{
    subdiv_surface *s;
    subdiv_mesh fine;
    subdiv_buffer b;
    options.limit = 1;
    CHECK_EQUAL(subdiv_prepare(&s, m, levels, &options), SUBDIV_OK);
    options.limit = 0;
    CHECK_EQUAL(subdiv_surface_mesh(&fine, s, m->positions, &options), SUBDIV_OK);
    CHECK_EQUAL(subdiv_make_buffer(&b, &fine, 4, &options), SUBDIV_OK);
    size_t count = (size_t)fine.vertex_count, size = size_of_mesh(&fine) + (size_t)b.vertex_count;
    subdiv_location *at = (subdiv_location *)malloc(count * sizeof *at);
    CHECK_EQUAL(subdiv_surface_locations(s, at, NULL, &options), SUBDIV_OK);
    free(at);
    subdiv_buffer_free(&b);
    subdiv_mesh_free(&fine);
    subdiv_surface_free(s);
    return size;
}

// Values that are all equal, or not even equal to themselves.
static size_t join(const subdiv_mesh *m, int numbers)
{
    int count = 3 * m->vertex_count, *firsts = (int *)malloc((size_t)count * sizeof *firsts);
    float *values = (float *)malloc((size_t)count * sizeof *values);
    for (int i = 0; i < count; i++) values[i] = numbers ? 1 : (float)NAN;
    CHECK_EQUAL(subdiv_join_values(firsts, 1, count, values, &options), SUBDIV_OK);
    CHECK_EQUAL(firsts[count - 1], numbers ? 0 : count - 1);
    free(firsts), free(values);
    return (size_t)count;
}

// Locations of all faces, under Loop of one; of an n-gon one in each corner. At a vertex, or close
// by, a location may take as long as the valence: so there are few of these.
static int find_locations(const subdiv_mesh *m, subdiv_location *at)
{
    int count = 0, faces = m->scheme == SUBDIV_LOOP ? 1 : m->face_count;
    for (int f = 0; f < faces && f < m->face_count; f++) {
        int size = face_size(m, f), ngon = size != 4 && m->scheme != SUBDIV_LOOP;
        for (int i = 0; i < (ngon ? size : 1); i++, count++) {
            at[count].face = f;
            at[count].corner = i;
            at[count].u = at[count].v = count > 8 ? 0.3f : count % 3 ? 0.3f / 100 : 0;
        }
    }
    return count;
}

static subdiv_location locations[CAGE_FACE_VERTICES];

static size_t samples(const subdiv_mesh *m, int unused)
{
    static float points[3 * CAGE_FACE_VERTICES], normals[3 * CAGE_FACE_VERTICES];
    subdiv_surface *s;
    subdiv_derivatives out = { points, NULL, NULL, NULL, NULL, NULL, normals, 0 };
    (void)unused;
    subdiv_prepare(&s, m, SUBDIV_EXACT, &options);
    void *scratch = malloc(subdiv_scratch_size(s, 3) + 1);
    int count = find_locations(m, locations);
    subdiv_evaluate_begin(s, 3, m->positions, 0, scratch, &options);
    CHECK_EQUAL(subdiv_evaluate_at(s, 3, scratch, count, locations, &out, &options), SUBDIV_OK);
    subdiv_surface_free(s);
    free(scratch);
    return (size_t)count;
}

// Evaluates UVs; for SUBDIV_EXACT it prepares alone.
static size_t values(const subdiv_mesh *m, int levels)
{
    subdiv_surface *s;
    if (!m->uv_count) return 0;
    CHECK_EQUAL(subdiv_prepare_face_varying(&s, m, m->uv_count, m->face_uvs, m->uv_rule, levels,
                                            &options), SUBDIV_OK);
    size_t count = levels < 0 ? 0 : (size_t)subdiv_surface_vertex_count(s);
    float *out = (float *)malloc((2 * count + 1) * sizeof *out);
    if (levels >= 0) subdiv_evaluate(s, 2, m->uvs, 0, out, 0, NULL, &options);
    subdiv_surface_free(s);
    free(out);
    return count;
}

// Of so many levels; of the limit, if less than 0.
static size_t stencils(const subdiv_mesh *m, int levels)
{
    subdiv_surface *s;
    subdiv_stencils made;
    options.limit = levels < 0;
    CHECK_EQUAL(subdiv_prepare(&s, m, levels < 0 ? -levels : levels, &options), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refined_stencils(&made, s, 0, subdiv_surface_vertex_count(s), &options),
                SUBDIV_OK);
    size_t size = made.offsets[made.count];
    options.limit = 0;
    subdiv_stencils_free(&made);
    subdiv_surface_free(s);
    return size;
}

static size_t exact_stencils(const subdiv_mesh *m, int unused)
{
    subdiv_surface *s;
    subdiv_stencils made;
    (void)unused;
    subdiv_prepare(&s, m, SUBDIV_EXACT, &options);
    int count = find_locations(m, locations);
    if (count > 9) count = 9;
    CHECK_EQUAL(subdiv_stencils_at(&made, s, count, locations, &options), SUBDIV_OK);
    size_t size = made.offsets[made.count];
    subdiv_stencils_free(&made);
    subdiv_surface_free(s);
    return size;
}

// Explains a vertex, an edge or a face.
static size_t explain(const subdiv_mesh *m, int which)
{
    static char text[400 * CAGE_FACE_VERTICES];
    subdiv_surface *s;
    options.error = NULL;
    subdiv_prepare(&s, m, 1, &options);
    int points = subdiv_surface_vertex_count(s), edges = subdiv_surface_edge_count(s);
    int point = which == 0 ? 0 : which == 1 ? m->vertex_count : m->vertex_count + edges;
    subdiv_surface_free(s);
    options.error = &error;
    text[0] = 0;
    if (point >= points) return 0;
    CHECK_EQUAL(subdiv_explain(text, sizeof text, m, point, &options), SUBDIV_OK);
    return strlen(text);
}

static size_t explain_points(const subdiv_mesh *m, int unused)
{
    subdiv_explanation e;
    (void)unused;
    CHECK_EQUAL(subdiv_explain_points(&e, m, &options), SUBDIV_OK);
    size_t size = sizeof *e.points * (size_t)e.count + sizeof(float) * e.masks.offsets[e.count];
    subdiv_explanation_free(&e);
    return size;
}

static void take_finding(void *user, const subdiv_finding *finding)
{
    *(size_t *)user += strlen(finding->text);
}

static size_t check(const subdiv_mesh *m, int unused)
{
    size_t size = 0;
    int counts[SUBDIV_ODDITY_COUNT];
    (void)unused;
    CHECK_EQUAL(subdiv_check(counts, m, take_finding, &size, &options), SUBDIV_OK);
    return size;
}

static size_t inspect(const subdiv_mesh *m, int unused)
{
    subdiv_info info;
    (void)unused;
    CHECK_EQUAL(subdiv_inspect(&info, m, &options), SUBDIV_OK);
    return 1;
}

static size_t creases(const subdiv_mesh *m, int how)
{
    subdiv_mesh copy = *m;
    copy.memory = NULL;
    if (how == 0) subdiv_crease_by_angle(&copy, 5, 1, &options);
    if (how == 1) subdiv_crease_by_smoothing_groups(&copy, 1, &options);
    if (how == 2) subdiv_crease_by_uv_seams(&copy, 1, &options);
    int chains = m->face_count > 0, sides = chains ? face_size(m, 0) : 0;
    const float sharpness = 1;
    if (how == 3) subdiv_crease_chains(&copy, chains, &sides, m->face_vertices, chains, &sharpness,
                                       &options);
    CHECK_EQUAL(error.code, SUBDIV_OK);
    size_t count = (size_t)copy.crease_count;
    subdiv_mesh_free(&copy);
    return count;
}

static size_t normals(const subdiv_mesh *m, int by_angle)
{
    subdiv_mesh copy = *m;
    copy.memory = NULL;
    if (by_angle) subdiv_normals_by_angle(&copy, 5, &options);
    else subdiv_normals(&copy, &options);
    CHECK_EQUAL(error.code, SUBDIV_OK);
    size_t count = (size_t)copy.normal_count;
    subdiv_mesh_free(&copy);
    return count;
}

typedef struct obj_text {
    char  *at;
    size_t size, read, step;          // step: the bytes that one read gets, at most
} obj_text;

static size_t read_some(void *user, void *bytes, size_t size)
{
    obj_text *t = (obj_text *)user;
    if (size > t->step) size = t->step;
    if (size > t->size - t->read) size = t->size - t->read;
    memcpy(bytes, t->at + t->read, size);
    t->read += size;
    return size;
}

static size_t obj(const subdiv_mesh *m, int step)
{
    obj_text t = { NULL, 0, 0, (size_t)step };
    subdiv_mesh read;
    CHECK_EQUAL(subdiv_save_obj_memory(m, NULL, 0, &t.size, &options), SUBDIV_OK);
    t.at = (char *)malloc(t.size + 1);
    CHECK_EQUAL(subdiv_save_obj_memory(m, t.at, t.size, &t.size, &options), SUBDIV_OK);
    CHECK_EQUAL(subdiv_load_obj_callback(&read, read_some, &t, &options), SUBDIV_OK);
    subdiv_mesh_free(&read);
    free(t.at);
    return t.size;
}

static size_t take_text(void *user, const void *bytes, size_t size)
{
    (void)bytes;
    *(size_t *)user += size;
    return size;
}

static size_t stream(const subdiv_mesh *m, int levels)
{
    subdiv_surface *s;
    size_t size = 0;
    CHECK_EQUAL(subdiv_prepare(&s, m, levels, &options), SUBDIV_OK);
    CHECK_EQUAL(subdiv_stream_obj_callback(s, m->positions, take_text, &size, &options), SUBDIV_OK);
    subdiv_surface_free(s);
    return size;
}

static const struct { const char *name; size_t (*make)(const subdiv_mesh *m, int how); int how; }
calls[] = {
    { "refine", refine, 0 }, { "refine", refine, 2 }, { "refine", refine, 4 },
    { "limit", refine_limit, 0 }, { "limit", refine_limit, 1 },
    { "tessellate", tessellate, 0 }, { "tessellate", tessellate, 1 }, { "pieces", in_pieces, 1 },
    { "samples", samples, 0 }, { "values", values, SUBDIV_EXACT }, { "values", values, 0 },
    { "values", values, 1 }, { "stencils", stencils, 1 }, { "stencils", stencils, 2 },
    { "stencils", stencils, -1 }, { "exact stencils", exact_stencils, 0 },
    { "explain points", explain_points, 0 },
    { "explain", explain, 0 }, { "explain", explain, 1 }, { "explain", explain, 2 },
    { "check", check, 0 }, { "inspect", inspect, 0 }, { "creases", creases, 0 },
    { "creases", creases, 1 }, { "creases", creases, 2 }, { "creases", creases, 3 },
    { "normals", normals, 0 }, { "normals", normals, 1 }, { "buffers", buffers, 1 },
    { "join", join, 0 }, { "join", join, 1 },
    { "obj", obj, 1 << 20 }, { "obj", obj, 1 }, { "stream", stream, 1 }
};
enum { CALLS = sizeof calls / sizeof *calls };

// -------------------------------------------------------------------------------- the rule

// made: the sizes of the results. To know where a block is, link with -no-pie: addr2line tells.
static void check_growth(const size_t *made)
{
    double growth = (double)(made[1] + 4 * MANY) / (double)(made[0] + MANY), all = 0;
    double few = FEW * (growth > 6 ? (double)made[1] : 4 * MANY);
    for (int i = 0; i < BLOCKS; i++) {
        double before = (double)blocks[i].runs[0], after = (double)blocks[i].runs[1];
        all += after;
        if (after > few && after > 6 * before)
            TEST_REPORT("the block at %p runs %.0f times, then %.0f", (const void *)blocks[i].at,
                        before, after);
    }
    CHECK(all > MANY || made[1] == 0);            // or nothing is counted
}

// One cage, by all functions.
static void check_cage(int kind, int scheme, int lists, int uv, int variant)
{
    char name[128];
    for (int c = 0; c < CALLS; c++) {
        size_t made[2];
        snprintf(name, sizeof name, "%s, scheme %d, lists %d, UVs %d, variant %d: %s %d",
                 kinds[kind].name, scheme, lists, uv, variant % 6, calls[c].name, calls[c].how);
        test_context = name;
        memset(blocks, 0, sizeof blocks);
        options.triangulate = scheme == SUBDIV_LOOP;
        for (int i = 0; i < 2; i++) {
            const subdiv_mesh *m = build(kind, scheme, lists, uv, variant, i ? 4 * MANY : MANY);
            counting = i;
            made[i] = calls[c].make(m, calls[c].how);
            counting = -1;
        }
        check_growth(made);
    }
}

static int stride = 53;               // of the cages with all that they may have

static void test_cages(void)
{
    int variant = 0;
    options.error = &error;
    for (int kind = 0; kind < KINDS; kind++)
        for (int scheme = 0; scheme < 3; scheme++)
            for (int lists = 0; lists < LISTS; lists++)
                for (int uv = 0; uv < UV_KINDS; uv++, variant++)
                    if (variant % stride == 0)
                        check_cage(kind, scheme, lists, uv, variant);
}

int main(int count, char **arguments)
{
    if (count > 1 && atoi(arguments[1]) > 0) stride = atoi(arguments[1]);
    RUN(test_cages);
    return test_end("growth");
}
