// Meshes filled by hand may have UVs at some vertices of a face only. Such a face has no UVs: random
// cages with such faces give what they give when those faces have no UVs at all, by every call.
//
//     cc -I. tests/test_partial_uvs.c -o build/test_partial_uvs -lm && build/test_partial_uvs
#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/random_cage.h"
#include "lib/same.h"
#include "lib/test.h"

enum { CAGES = 600 };

static unsigned random_state;

static int below(int n)               // 0 <= result < n
{
    random_state = random_state * 1664525u + 1013904223u;
    return (int)((random_state >> 8) % (unsigned)n);
}

typedef struct pair {                 // a cage with partial UVs, and the same without those
    random_cage *cage;
    subdiv_mesh  partial, whole;
    int         *indices;             // of the second
} pair;

// Takes UVs from some vertices of some faces; from all vertices of those in the second mesh.
static void make_pair(pair *p, unsigned seed)
{
    static const float triangle[6] = { 0, 0, 1, 0, 0, 1 };
    p->cage = random_cage_new(seed, RANDOM_ALL);
    p->partial = p->cage->mesh;
    random_state = seed;
    int count = 0, h = 0;
    for (int f = 0; f < p->partial.face_count; f++) count += size_of_face(&p->partial, f);
    if (p->partial.uv_count == 0) {           // then three UVs anywhere
        p->partial.uv_count = 3;
        p->partial.uvs = p->cage->uvs;
        p->partial.face_uvs = p->cage->face_uvs;
        memcpy(p->cage->uvs, triangle, sizeof triangle);
        for (int i = 0; i < count; i++) p->cage->face_uvs[i] = below(3);
    }
    p->indices = (int *)malloc(((size_t)count + 1) * sizeof(int));
    memcpy(p->indices, p->cage->face_uvs, (size_t)count * sizeof(int));
    for (int f = 0; f < p->partial.face_count; f++) {
        int size = size_of_face(&p->partial, f), lose = below(4) == 0;
        for (int i = 0; i < size && lose; i++, h++) {
            p->indices[h] = -1;
            if (i == 0 || below(size - 1) == 0) p->cage->face_uvs[h - i + (i + f) % size] = -1;
        }
        h += lose ? 0 : size;
    }
    p->whole = p->partial;
    p->whole.face_uvs = p->indices;
}

static void free_pair(pair *p)
{
    free(p->indices);
    random_cage_free(p->cage);
}

static int same_result(const subdiv_mesh *a, const subdiv_mesh *b)
{
    return same_mesh(a, b) && !a->normals == !b->normals &&
           same_bytes(a->normals, b->normals, a->normals ? 3 * a->vertex_count : 0, sizeof(float));
}

static void check_refine(const pair *p, int levels, int limit)
{
    subdiv_options opt = {0};
    subdiv_mesh a, b;
    opt.limit = limit;
    subdiv_result first = subdiv_refine(&a, &p->partial, levels, &opt);
    CHECK_EQUAL(first, subdiv_refine(&b, &p->whole, levels, &opt));
    CHECK(same_result(&a, &b));
    subdiv_mesh_free(&a);
    subdiv_mesh_free(&b);
}

static void check_tessellate(const pair *p, int rate)
{
    subdiv_tessellation how = {0};
    subdiv_mesh a, b;
    how.rate = rate;
    CHECK_EQUAL(subdiv_tessellate(&a, &p->partial, &how, NULL),
                subdiv_tessellate(&b, &p->whole, &how, NULL));
    CHECK(same_result(&a, &b));
    subdiv_mesh_free(&a);
    subdiv_mesh_free(&b);
}

// What a surface of values makes, and its faces. There are so many unused values before the others;
// what becomes of these is left out.
static float *evaluate_values(const pair *p, const int *indices, int unused, int levels, int *count)
{
    subdiv_surface *surface;
    int total = 0, uvs = p->partial.uv_count;
    for (int f = 0; f < p->partial.face_count; f++) total += size_of_face(&p->partial, f);
    int *moved = (int *)malloc(((size_t)total + 1) * sizeof(int));
    for (int i = 0; i < total; i++) moved[i] = indices[i] < 0 ? -1 : indices[i] + unused;
    subdiv_result result = subdiv_prepare_face_varying(&surface, &p->partial, uvs + unused, moved,
                                                       p->partial.uv_rule, levels, NULL);
    free(moved);
    *count = 0;
    if (result) return NULL;
    int points = subdiv_surface_vertex_count(surface);
    int faces = subdiv_surface_face_size(surface) * subdiv_surface_face_count(surface);
    float *in = (float *)calloc((size_t)(uvs + unused) + 1, 2 * sizeof(float));
    memcpy(in + 2 * unused, p->partial.uvs, sizeof(float) * 2 * (size_t)uvs);
    *count = 2 * (points - unused) + faces;
    float *values = (float *)malloc(((size_t)(2 * points + faces) + 1) * sizeof(float));
    int *vertices = (int *)malloc(((size_t)faces + 1) * sizeof(int));
    subdiv_evaluate(surface, 2, in, 0, values, 0, NULL, NULL);
    memmove(values, values + 2 * unused, sizeof(float) * 2 * (size_t)(points - unused));
    subdiv_surface_faces(surface, vertices, NULL, NULL);
    for (int i = 0; i < faces; i++)
        values[2 * (points - unused) + i] = (float)(vertices[i] < 0 ? -1 : vertices[i] - unused);
    free(vertices);
    free(in);
    subdiv_surface_free(surface);
    return values;
}

static void check_values(const pair *p, int levels)
{
    int first, second;
    float *a = evaluate_values(p, p->partial.face_uvs, 0, levels, &first);
    float *b = evaluate_values(p, p->indices, levels, levels, &second);
    CHECK_EQUAL(first, second);
    CHECK(first != second || same_bytes(a, b, first, sizeof(float)));
    free(a);
    free(b);
}

// The surface of values anywhere.
static void check_samples(const pair *p)
{
    float points[2][2 * 64];
    memset(points, 0, sizeof points);
    for (int k = 0; k < 2; k++) {
        subdiv_surface *surface;
        subdiv_location at[64];
        subdiv_derivatives out = {0};
        if (subdiv_prepare_face_varying(&surface, &p->partial, p->partial.uv_count,
                                        k ? p->indices : p->partial.face_uvs, p->partial.uv_rule,
                                        SUBDIV_EXACT, NULL)) continue;
        void *scratch = malloc(subdiv_scratch_size(surface, 2));
        subdiv_evaluate_begin(surface, 2, p->partial.uvs, 0, scratch, NULL);
        memset(at, 0, sizeof at);
        for (int i = 0; i < 64; i++) at[i].face = i % p->partial.face_count;
        for (int i = 0; i < 64; i++) at[i].u = at[i].v = (float)(i % 9) / 18;
        out.points = points[k];
        CHECK_EQUAL(subdiv_evaluate_at(surface, 2, scratch, 64, at, &out, NULL), SUBDIV_OK);
        free(scratch);
        subdiv_surface_free(surface);
    }
    CHECK(memcmp(points[0], points[1], sizeof points[0]) == 0);
}

static void test_random_cages(void)
{
    char context[32];
    for (unsigned seed = 1; seed <= CAGES; seed++) {
        pair p;
        make_pair(&p, seed);
        snprintf(context, sizeof context, "cage %u", seed);
        test_context = context;
        check_refine(&p, 1, 0);
        check_refine(&p, 2 + below(2), below(2));
        check_tessellate(&p, 1 + below(4));
        check_values(&p, 1 + below(3));
        check_samples(&p);
        free_pair(&p);
    }
}

// Two quads that share an edge with equal values; the second has a UV at three of its vertices.
static void test_shared_edge(void)
{
    float positions[] = { 0,0,0, 1,0,0, 1,1,0, 0,1,0, 2,0,0, 2,1,0 };
    float uvs[] = { 0,0, 1,0, 1,1, 0,1, 2,0, 2,1 };
    int faces[] = { 0,1,2,3, 1,4,5,2 }, face_uvs[] = { 0,1,2,3, 1,-1,5,2 };
    subdiv_mesh cage = {0}, fine;
    cage.vertex_count = cage.uv_count = 6;
    cage.positions = positions;
    cage.face_count = 2;
    cage.face_size = 4;
    cage.face_vertices = faces;
    cage.uvs = uvs;
    cage.face_uvs = face_uvs;
    CHECK_EQUAL(subdiv_refine(&fine, &cage, 1, NULL), SUBDIV_OK);
    CHECK_EQUAL(fine.face_count, 8);
    for (int i = 0; i < 32 && fine.face_count == 8; i++)
        CHECK(i < 16 ? fine.face_uvs[i] >= 0 : fine.face_uvs[i] == -1);
    subdiv_mesh_free(&fine);
}

int main(void)
{
    RUN(test_shared_edge);
    RUN(test_random_cages);
    return test_end("partial_uvs");
}
