// Prints hashes of the bits of all kinds of results, for tests/bits.sh to compare between
// compilers, their options and platforms. The cages are OBJ files, fans of faces and random ones.
//
//     cc -I. tests/bits.c -o build/bits -lm && build/bits examples/cages/*.obj

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { READ, REFINED, EVALUATED, LIMIT, EXACT, TESSELLATED, STENCILS, CREASES, CURVES, WRITTEN,
       KINDS };
static const char *const names[KINDS] = { "read", "refined", "evaluated", "limit", "exact",
                                          "tessellated", "stencils", "creases", "curves",
                                          "written" };
static unsigned long long sums[KINDS];

static void add(int kind, unsigned bits)
{
    sums[kind] = (sums[kind] ^ bits) * 1099511628211u;
}

static void add_floats(int kind, const float *values, size_t count)
{
    for (size_t i = 0; values && i < count; i++) {
        unsigned bits;
        memcpy(&bits, values + i, sizeof bits);
        add(kind, bits);
    }
}

static void add_ints(int kind, const int *values, int count)
{
    for (int i = 0; values && i < count; i++) add(kind, (unsigned)values[i]);
}

static void add_mesh(int kind, const subdiv_mesh *m)
{
    const size_t points = 3 * (size_t)m->vertex_count;
    int total = 0;
    for (int f = 0; f < m->face_count; f++) total += face_size(m, f);
    add_floats(kind, m->positions, points);
    add_floats(kind, m->normals, points);
    add_floats(kind, m->colors, points);
    add_floats(kind, m->uvs, 2 * (size_t)m->uv_count);
    add_floats(kind, m->crease_sharpness, (size_t)m->crease_count);
    add_ints(kind, m->crease_vertices, 2 * m->crease_count);
    add_ints(kind, m->face_vertices, total);
}

// The mesh refined, or on the limit surface; and the text of its file.
static void add_refined(const subdiv_mesh *m, int levels, int limit)
{
    subdiv_mesh fine;
    subdiv_options opt;
    size_t size;
    memset(&opt, 0, sizeof opt);
    opt.limit = limit;
    if (subdiv_refine(&fine, m, levels, &opt)) abort();
    add_mesh(limit ? LIMIT : REFINED, &fine);
    if (subdiv_save_obj_memory(&fine, NULL, 0, &size, NULL)) abort();
    char *text = (char *)malloc(size);
    if (!text || subdiv_save_obj_memory(&fine, text, size, &size, NULL)) abort();
    for (size_t i = 0; i < size; i++) add(WRITTEN, (unsigned char)text[i]);
    free(text);
    subdiv_mesh_free(&fine);
}

// Evaluates so many channels, each made from the positions.
static void add_evaluated(const subdiv_mesh *m, int levels, int channels, int linear)
{
    subdiv_surface *surface = NULL;
    subdiv_options opt;
    const size_t wide = (size_t)channels;
    memset(&opt, 0, sizeof opt);
    opt.linear = linear;
    if (subdiv_prepare(&surface, m, levels, &opt)) abort();
    const size_t points = (size_t)subdiv_surface_vertex_count(surface);
    float *in = (float *)malloc(wide * sizeof(float) * (size_t)m->vertex_count);
    float *out = (float *)malloc(wide * sizeof(float) * points);
    if (!in || !out) abort();
    for (int i = 0; i < channels * m->vertex_count; i++)
        in[i] = m->positions[(3 * (i / channels) + i % channels) % (3 * m->vertex_count)];
    if (subdiv_evaluate(surface, channels, in, 0, out, 0, NULL, NULL)) abort();
    add_floats(EVALUATED, out, wide * points);
    subdiv_surface_free(surface);
    free(in);
    free(out);
}

static void add_stencils(subdiv_stencils *stencils)
{
    const size_t count = stencils->offsets[stencils->count];
    add_ints(STENCILS, stencils->indices, (int)count);
    add_floats(STENCILS, stencils->weights, count);
    add_floats(STENCILS, stencils->du, count);
    add_floats(STENCILS, stencils->dv, count);
    if (stencils->duv) add_floats(STENCILS, stencils->duv, count);
    subdiv_stencils_free(stencils);
}

static void add_refined_stencils(const subdiv_mesh *m)
{
    subdiv_surface *surface = NULL;
    subdiv_stencils stencils;
    subdiv_options opt;
    memset(&opt, 0, sizeof opt);
    opt.limit = 1;
    if (subdiv_prepare(&surface, m, 1, &opt)) abort();
    const int count = subdiv_surface_vertex_count(surface);
    if (subdiv_refined_stencils(&stencils, surface, 0, count, NULL)) abort();
    add_stencils(&stencils);
    subdiv_surface_free(surface);
}

// The limit surface at a vertex, close to it and farther away, on all faces.
static void add_exact(const subdiv_mesh *m)
{
    subdiv_surface *surface = NULL;
    subdiv_stencils stencils;
    float out[6][4], normal[4], tangents[3][4];
    subdiv_derivatives to = { out[0], out[1], out[2], out[3], out[4], out[5], normal, 4 };
    if (subdiv_prepare(&surface, m, SUBDIV_EXACT, NULL)) abort();
    void *scratch = malloc(subdiv_scratch_size(surface, 3));
    if (!scratch || subdiv_evaluate_begin(surface, 3, m->positions, 0, scratch, NULL)) abort();
    for (int f = 0; f < m->face_count; f++) {
        const int corner = face_size(m, f) > 4 ? f % 5 : 0;
        const subdiv_location at[3] = { { f, corner, 0, 0 },
                                        { f, 0, 0.001f * (float)(f % 4), 1e-4f },
                                        { f, 0, (float)(f % 7) / 15, (float)(f % 9) / 17 } };
        for (int i = 0; i < 3; i++) {
            if (subdiv_evaluate_at(surface, 3, scratch, 1, &at[i], &to, NULL)) abort();
            for (int k = 0; k < 6; k++) add_floats(EXACT, out[k], 3);
            add_floats(EXACT, normal, 3);
        }
        if (f % 8) continue;
        if (subdiv_stencils_at(&stencils, surface, 1, at + f % 16 / 8 * 2, NULL)) abort();
        add_stencils(&stencils);
        if (!m->uv_count) continue;
        if (subdiv_tangents_at(surface, scratch, 3, at, tangents[0], 0, NULL)) abort();
        add_floats(EXACT, tangents[0], 12);
    }
    subdiv_surface_free(surface);
    free(scratch);
}

static void add_tessellated(const subdiv_mesh *m, int rate)
{
    subdiv_tessellation how;
    subdiv_mesh fine;
    memset(&how, 0, sizeof how);
    how.rate = rate;
    if (subdiv_tessellate(&fine, m, &how, NULL)) abort();
    add_mesh(TESSELLATED, &fine);
    subdiv_mesh_free(&fine);
}

// The edges that bend, and the normals of vertices.
static void add_creases(const subdiv_mesh *m, float degrees)
{
    subdiv_mesh creased = *m;
    creased.memory = NULL;
    if (subdiv_crease_by_angle(&creased, degrees, 1.5f, NULL)) abort();
    add_ints(CREASES, creased.crease_vertices, 2 * creased.crease_count);
    if (subdiv_normals(&creased, NULL)) abort();
    add_floats(CREASES, creased.normals, 3 * (size_t)m->vertex_count);
    subdiv_mesh_free(&creased);
}

// A closed curve through the vertices, refined and put on its limit.
static void add_curve(const subdiv_mesh *m, subdiv_curve_rule rule)
{
    const subdiv_curve_ends ends = SUBDIV_ENDS_CLOSED;
    const int count = subdiv_curve_point_count(rule, ends, m->vertex_count, 3);
    float *out = (float *)malloc(3 * sizeof(float) * (size_t)count);
    subdiv_options opt;
    memset(&opt, 0, sizeof opt);
    opt.limit = 1;
    if (!out || subdiv_curve(rule, ends, 3, 3, m->vertex_count, m->positions, 0, out, 0, &opt))
        abort();
    add_floats(CURVES, out, 3 * (size_t)count);
    free(out);
}

static void add_cage(const subdiv_mesh *m, int i)
{
    add_curve(m, i % 2 ? SUBDIV_CURVE_CHAIKIN : SUBDIV_CURVE_B_SPLINE);
    add_refined(m, 1 + i % 2, 0);
    add_refined(m, i % 3, 1);
    add_evaluated(m, 1 + i % 4, i % 4 ? 3 : 1 + i / 4 % 9, i % 11 == 0);
    add_creases(m, 30);
    if (i % 3 == 0) add_exact(m);
    if (i % 3 == 1) add_tessellated(m, 1 + i % 5);
    if (i % 3 == 2) add_refined_stencils(m);
}

static void round_all(float *values, int count)
{
    for (int i = 0; i < count; i++) values[i] = floorf(values[i] * 4096 + 0.5f) / 4096;
}

// Rounds to multiples of 2^-12, so that a cage is the same whatever becomes of the sums and cosines
// that made it.
static void round_cage(const subdiv_mesh *m)
{
    round_all(m->positions, 3 * m->vertex_count);
    round_all(m->crease_sharpness, m->crease_count);
    round_all(m->corner_sharpness, m->corner_count);
    round_all(m->uvs, 2 * m->uv_count);
}

// A vertex with many faces, smooth, with a dart, a crease, a corner, and on the boundary.
static void add_fan(subdiv_scheme scheme, int faces, int closed)
{
    static test_cage c;
    for (int creases = 0; creases < 4; creases++) {
        build_fan(&c, scheme, faces, closed);
        for (int i = 0; i < creases; i++)
            cage_crease(&c, 0, 2 + i * faces / 4, i == 1 ? 1.5 : (double)SUBDIV_INFINITE);
        round_cage(&c.mesh);
        add_cage(&c.mesh, faces + creases);
    }
}

int main(int count, char **paths)
{
    for (int i = 1; i < count; i++) {
        subdiv_mesh cage;
        if (subdiv_load_obj(&cage, paths[i], NULL)) abort();
        add_mesh(READ, &cage);
        for (int k = 0; k < 3; k++) add_cage(&cage, 12 + k);
        subdiv_mesh_free(&cage);
    }
    for (int n = 3; n < 80; n += 1 + n / 2) {
        add_fan(SUBDIV_CATMULL_CLARK, n, n % 2);
        add_fan(SUBDIV_LOOP, n, n % 2);
    }
    for (unsigned seed = 1; seed <= 99; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        if (!c) abort();
        round_cage(&c->mesh);
        add_cage(&c->mesh, (int)seed);
        random_cage_free(c);
    }
    for (int i = 0; i < KINDS; i++) printf("%-12s %016llx\n", names[i], sums[i]);
    return 0;
}
