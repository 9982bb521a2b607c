// What other programs have in another way: faces that are clockwise, creases as chains, UVs without
// indices, sharpness below 0.
//
//     cc -I. tests/test_conventions.c -o build/test_conventions -lm && build/test_conventions
#include <stdio.h>
#include <limits.h>
#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/test.h"

enum { CAGES = 150, MOST_TEXT = 1 << 22 };

static char context[64];
static char text[2][MOST_TEXT];

static random_cage *cage_of(unsigned seed, unsigned features)
{
    random_cage *c = random_cage_new(seed, features);
    snprintf(context, sizeof context, "seed %u", seed);
    test_context = context;
    return c;
}

// --------------------------------------------------------------------------------- left-handed

// Two meshes are the same but for their normals, which are opposite.
static void check_opposite(const subdiv_mesh *left, const subdiv_mesh *right)
{
    int count = right->face_normals ? right->normal_count : right->vertex_count;
    CHECK(left->left_handed && !right->left_handed);
    CHECK_EQUAL(left->vertex_count, right->vertex_count);
    CHECK_EQUAL(left->face_count, right->face_count);
    if (test_bad) return;
    CHECK(memcmp(left->positions, right->positions, 12 * (size_t)right->vertex_count) == 0);
    for (int h = 0; h < (right->face_count ? face_vertex_count(right) : 0); h++)
        CHECK_EQUAL(left->face_vertices[h], right->face_vertices[h]);
    CHECK(!left->normals == !right->normals && !left->face_normals == !right->face_normals);
    for (int i = 0; i < (right->normals ? 3 * count : 0); i++)
        CHECK(left->normals[i] == -right->normals[i]);
}

static size_t save(const subdiv_mesh *mesh, char *to)
{
    size_t size = 0;
    CHECK_EQUAL(subdiv_save_obj_memory(mesh, to, MOST_TEXT - 1, &size, NULL), SUBDIV_OK);
    to[size] = 0;
    return size;
}

// What is written is counter-clockwise: read again, it has the opposite normals.
static void check_obj(const subdiv_mesh *left)
{
    subdiv_mesh again = {0}, mine = *left;
    mine.normals = NULL;
    mine.face_normals = NULL;
    mine.memory = NULL;
    CHECK_EQUAL(subdiv_load_obj_memory(&again, text[0], save(&mine, text[0]), NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_normals(&mine, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_normals(&again, NULL), SUBDIV_OK);
    CHECK_EQUAL(again.normal_count, mine.normal_count);
    for (int i = 0, h = 0; i < mine.face_count && !test_bad; h += face_size(&mine, i++)) {
        const int *a = mine.face_vertices + h, *b = again.face_vertices + h;
        for (int k = 0, size = face_size(&mine, i); k < size; k++) {
            CHECK_EQUAL(a[k], b[(size - k) % size]);
            if (mine.uv_count)
                CHECK_EQUAL(mine.face_uvs[h + k], again.face_uvs[h + (size - k) % size]);
        }
    }
    subdiv_mesh_free(&mine);
    subdiv_mesh_free(&again);
}

// Of two buffers, triangles are turned and normals are opposite.
static void check_buffers(const subdiv_mesh *left, const subdiv_mesh *right)
{
    subdiv_buffer b[2];
    CHECK_EQUAL(subdiv_make_buffer(&b[0], left, 4, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_make_buffer(&b[1], right, 4, NULL), SUBDIV_OK);
    CHECK_EQUAL(b[0].vertex_count, b[1].vertex_count);
    const int *v = (const int *)b[0].indices, *w = (const int *)b[1].indices;
    for (int i = 0; i < b[1].index_count; i += 3)
        CHECK(v[i] == w[i] && v[i + 1] == w[i + 2] && v[i + 2] == w[i + 1]);
    subdiv_buffer_free(&b[0]);
    subdiv_buffer_free(&b[1]);
}

static size_t keep_text(void *user, const void *bytes, size_t size)
{
    size_t *used = (size_t *)user;
    if (*used + size >= MOST_TEXT) return 0;
    memcpy(text[1] + *used, bytes, size);
    *used += size;
    return size;
}

static void check_left(const subdiv_mesh *cage, int levels)
{
    subdiv_mesh right = *cage, left = right, l = {0}, r = {0};
    subdiv_surface *surface = NULL;
    subdiv_options opt = {0};
    opt.limit = levels > 0;
    left.left_handed = 5;
    CHECK_EQUAL(subdiv_refine(&l, &left, levels, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refine(&r, &right, levels, &opt), SUBDIV_OK);
    check_opposite(&l, &r);
    check_buffers(&l, &r);
    check_obj(&l);
    size_t used = 0;
    CHECK_EQUAL(subdiv_prepare(&surface, &left, levels, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_stream_obj_callback(surface, left.positions, keep_text, &used, &opt),
                SUBDIV_OK);
    subdiv_mesh_free(&l);
    CHECK_EQUAL(subdiv_refine(&l, &left, levels, &opt), SUBDIV_OK);
    CHECK_EQUAL(save(&l, text[0]), used);
    CHECK(memcmp(text[0], text[1], used) == 0);
    subdiv_surface_free(surface);
    subdiv_mesh_free(&l);
    subdiv_mesh_free(&r);
    CHECK_EQUAL(subdiv_tessellate(&l, &left, NULL, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_tessellate(&r, &right, NULL, NULL), SUBDIV_OK);
    check_opposite(&l, &r);
    subdiv_mesh_free(&l);
    subdiv_mesh_free(&r);
    CHECK_EQUAL(subdiv_normals(&left, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_normals(&right, NULL), SUBDIV_OK);
    check_opposite(&left, &right);
    subdiv_mesh_free(&left);
    subdiv_mesh_free(&right);
}

// Anywhere, also at vertices: points and derivatives are the same, normals opposite.
static void check_left_anywhere(const subdiv_mesh *right)
{
    subdiv_mesh left = *right;
    subdiv_surface *surfaces[2] = { NULL, NULL };
    float all[2][12];
    left.left_handed = 1;
    for (int k = 0; k < 2; k++)
        CHECK_EQUAL(subdiv_prepare(&surfaces[k], k ? right : &left, SUBDIV_EXACT, NULL), SUBDIV_OK);
    size_t size = subdiv_scratch_size(surfaces[0], 3);
    void *scratch[2] = { malloc(size), malloc(size) };
    for (int k = 0; k < 2; k++)
        subdiv_evaluate_begin(surfaces[k], 3, right->positions, 0, scratch[k], NULL);
    for (int f = 0; f < right->face_count; f++)
        for (int i = 0; i < 6; i++) {
            static const float u[6] = { 0, 0.25f, 0, 1e-4f, 1e-6f, 0.3f };
            subdiv_location at = { f, 0, u[i], u[5 - i] };
            for (int k = 0; k < 2; k++) {
                subdiv_derivatives out = {0};
                out.points = all[k];
                out.du = all[k] + 3;
                out.dv = all[k] + 6;
                out.normals = all[k] + 9;
                CHECK_EQUAL(subdiv_evaluate_at(surfaces[k], 3, scratch[k], 1, &at, &out, NULL),
                            SUBDIV_OK);
            }
            CHECK(memcmp(all[0], all[1], 9 * sizeof(float)) == 0);
            for (int c = 9; c < 12; c++) CHECK(all[0][c] == -all[1][c]);
        }
    for (int k = 0; k < 2; k++) {
        free(scratch[k]);
        subdiv_surface_free(surfaces[k]);
    }
}

static void test_left_handed(void)
{
    for (unsigned seed = 1; seed <= CAGES; seed++) {
        random_cage *c = cage_of(seed, RANDOM_ALL & ~RANDOM_DEGENERATE);
        check_left(&c->mesh, (int)(seed % 3));
        check_left_anywhere(&c->mesh);
        random_cage_free(c);
    }
}

// ----------------------------------------------------------------------------------- sharpness

// Sharpness below 0 is 0, as in OpenSubdiv, but told.
static void test_negative_sharpness(void)
{
    static test_cage c;
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nt crease 2/1/0 0 1 -2\n";
    subdiv_error error = {0};
    subdiv_options opt = {0};
    subdiv_mesh fine, none;
    opt.error = &error;
    build_fan(&c, SUBDIV_CATMULL_CLARK, 4, 1);
    CHECK_EQUAL(subdiv_refine(&none, &c.mesh, 2, &opt), SUBDIV_OK);
    cage_crease(&c, 0, 1, -0.0);
    cage_crease(&c, 0, 3, -1);
    cage_corner(&c, 2, -0.5);
    CHECK_EQUAL(error.warning_count, 0);
    CHECK_EQUAL(subdiv_refine(&fine, &c.mesh, 2, &opt), SUBDIV_OK);
    CHECK(memcmp(fine.positions, none.positions, 12 * (size_t)none.vertex_count) == 0);
    CHECK_EQUAL(error.warning_count, 2);
    CHECK_TEXT(error.warning, "crease 1: edge 0-3 has a sharpness below 0");
    subdiv_mesh_free(&none);
    subdiv_mesh_free(&fine);
    error.warning_count = 0;
    CHECK_EQUAL(subdiv_load_obj_memory(&fine, obj, sizeof obj - 1, &opt), SUBDIV_OK);
    CHECK_TEXT(error.warning, "line 5: a sharpness below 0 is read as 0");
    CHECK(fine.crease_count == 1 && fine.crease_sharpness[0] == 0);
    subdiv_mesh_free(&fine);
}

// -------------------------------------------------------------------------------------- chains

static void test_chains(void)
{
    static test_cage c;
    const int lengths[] = { 3, 2, 4 }, vertices[] = { 1, 0, 3, 0, 2, 1, 0, 7, 2 };
    const float each[] = { 1, 2, 3, 4, 5, 6 };
    const int ends[] = { 5, 1, 1, 0, 0, 3, 0, 2, 1, 0 };  // 0-7 and 7-2 are no edges
    const float by_chain[] = { 9, 1, 1, 2, 3 }, by_edge[] = { 9, 1, 2, 3, 4 };
    for (int own = 0; own < 2; own++) {
        subdiv_error error = {0};
        subdiv_options opt = {0};
        opt.error = &error;
        build_fan(&c, SUBDIV_CATMULL_CLARK, 4, 1);
        cage_crease(&c, 5, 1, 9);
        CHECK_EQUAL(subdiv_crease_chains(&c.mesh, 3, lengths, vertices, own ? 6 : 3, each, &opt),
                    SUBDIV_OK);
        CHECK_EQUAL(c.mesh.crease_count, 5);
        CHECK(memcmp(c.mesh.crease_vertices, ends, sizeof ends) == 0);
        CHECK(memcmp(c.mesh.crease_sharpness, own ? by_edge : by_chain, sizeof by_edge) == 0);
        CHECK_EQUAL(error.warning_count, 2);
        CHECK_TEXT(error.warning, "chain 2: no edge joins vertices 0 and 7");
        subdiv_mesh_free(&c.mesh);
    }
}

static void test_wrong_chains(void)
{
    static test_cage c;
    static const struct {
        int lengths[2], vertices[5], count;
        float sharpness[3];
        const char *message;
    } wrong[] = {
        { { 2, 1 }, { 0, 1, 2 }, 2, { 1, 1 }, "chain 1 has 1 vertices" },
        { { 2, 3 }, { 0, 1, 2, 0, 12 }, 2, { 1, 1 },
          "chain 1: vertex 12 does not exist (the mesh has 9)" },
        { { 2, 3 }, { 0, 1, 2, 0, 3 }, 2, { 1, NAN },
          "chain 1: the sharpness at 0 is not a number" },
        { { 2, 3 }, { 0, 1, 2, 0, 3 }, 3, { 1, 1, NAN },
          "chain 1: the sharpness at 1 is not a number" },
        { { 2, 3 }, { 0, 1, 2, 0, 3 }, 4, { 1, 1, 1 },
          "sharpness_count is 4, but there are 2 chains with 3 edges" },
        { { INT_MAX, INT_MAX }, { 0, 1, 2, 0, 3 }, 4, { 1, 1, 1 },
          "sharpness_count is 4, but there are 2 chains with 2147483647 edges" }
    };
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    build_fan(&c, SUBDIV_CATMULL_CLARK, 4, 1);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        CHECK(subdiv_crease_chains(&c.mesh, 2, wrong[i].lengths, wrong[i].vertices, wrong[i].count,
                                   wrong[i].sharpness, &opt) != SUBDIV_OK);
        CHECK_TEXT(error.message, wrong[i].message);
        CHECK(c.mesh.crease_count == 0 && c.mesh.memory == NULL);
    }
    for (int i = 0; i < 10; i++) {                  // each vertex of each chain has to exist
        const int lengths[] = { 2, 3 }, place = i / 2, bad = i % 2 ? -1 : c.mesh.vertex_count;
        const float sharpness[] = { 1, 1 };
        int vertices[] = { 0, 1, 2, 0, 3 };
        vertices[place] = bad;
        CHECK_EQUAL(subdiv_crease_chains(&c.mesh, 2, lengths, vertices, 2, sharpness, &opt),
                    SUBDIV_ERROR_INDEX);
        CHECK_EQUAL(error.vertex, bad);
        CHECK_EQUAL(error.message[6] - '0', place >= 2);
        CHECK(c.mesh.crease_count == 0 && c.mesh.memory == NULL);
    }
    CHECK_EQUAL(subdiv_crease_chains(&c.mesh, 0, NULL, NULL, 0, NULL, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_crease_chains(&c.mesh, 1, NULL, NULL, 1, NULL, &opt), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_crease_chains(&c.mesh, -1, NULL, NULL, 0, NULL, &opt),
                SUBDIV_ERROR_ARGUMENT);
}

// --------------------------------------------------------------------------------------- seams

// UVs without indices, joined, make the UVs of the indexed mesh: those of each face-vertex have the
// same bits.
static void test_joined_uvs(void)
{
    for (unsigned seed = 1; seed <= CAGES; seed++) {
        random_cage *c = cage_of(seed, RANDOM_ALL);
        subdiv_mesh apart = c->mesh, fine[2];
        int count = face_vertex_count(&c->mesh), *firsts = (int *)malloc(4 * (size_t)count + 4);
        float *uvs = (float *)malloc(8 * (size_t)count + 8);
        for (int i = 0; i < c->mesh.uv_count; i++) c->mesh.uvs[2 * i] += (float)i;  // all differ
        for (int h = 0, known; h < count && c->mesh.uv_count; h++) {
            known = c->mesh.face_uvs[h];
            for (int k = 0; k < 2; k++) uvs[2 * h + k] = known < 0 ? 0 : c->mesh.uvs[2 * known + k];
            if (uvs[2 * h] == 0 && h % 2) uvs[2 * h] = -0.0f;
        }
        CHECK_EQUAL(subdiv_join_values(firsts, 2, c->mesh.uv_count ? count : 0, uvs, NULL),
                    SUBDIV_OK);
        for (int h = 0; h < count && c->mesh.uv_count; h++)
            if (c->mesh.face_uvs[h] < 0) firsts[h] = -1;
        if (c->mesh.uv_count) {
            apart.uv_count = count;
            apart.uvs = uvs;
            apart.face_uvs = firsts;
        }
        CHECK_EQUAL(subdiv_refine(&fine[0], &c->mesh, 2, NULL), SUBDIV_OK);
        CHECK_EQUAL(subdiv_refine(&fine[1], &apart, 2, NULL), SUBDIV_OK);
        CHECK(!fine[0].uv_count == !fine[1].uv_count);
        for (int h = 0; h < 4 * fine[0].face_count && fine[0].uv_count && !test_bad; h++) {
            if (h >= fine[0].face_size * fine[0].face_count) break;
            int i = fine[0].face_uvs[h], j = fine[1].face_uvs[h];
            CHECK(i < 0 ? j < 0 : j >= 0);
            if (i < 0) continue;
            CHECK(memcmp(fine[0].uvs + 2 * i, fine[1].uvs + 2 * j, 8) == 0);
        }
        subdiv_mesh_free(&fine[0]);
        subdiv_mesh_free(&fine[1]);
        free(firsts);
        free(uvs);
        random_cage_free(c);
    }
}

static int are_equal(const float *a, const float *b, int channels)
{
    for (int c = 0; c < channels; c++)
        if (a[c] != b[c]) return 0;
    return 1;
}

// Beside the slow way, for any number of channels. 0 equals -0.
static void test_join_values(void)
{
    enum { COUNT = 200 };
    float values[3 * COUNT];
    int firsts[COUNT];
    unsigned state = 1;
    for (int channels = 1; channels <= 3; channels++) {
        for (int i = 0; i < channels * COUNT; i++) {
            values[i] = (float)((state = state * 1103515245u + 12345u) >> 28) - 7;
            if (values[i] == 0 && i % 3) values[i] = -0.0f;
        }
        CHECK_EQUAL(subdiv_join_values(firsts, channels, COUNT, values, NULL), SUBDIV_OK);
        for (int i = 0, first; i < COUNT; i++) {
            for (first = 0; !are_equal(values + channels * first, values + channels * i, channels);
                 first++);
            CHECK_EQUAL(firsts[i], first);
        }
    }
    CHECK_EQUAL(subdiv_join_values(NULL, 2, 0, NULL, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_join_values(firsts, 0, 1, values, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_join_values(firsts, 1, -1, values, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_join_values(NULL, 1, 1, values, NULL), SUBDIV_ERROR_ARGUMENT);
}

int main(void)
{
    RUN(test_left_handed);
    RUN(test_negative_sharpness);
    RUN(test_chains);
    RUN(test_wrong_chains);
    RUN(test_joined_uvs);
    RUN(test_join_values);
    return test_end("conventions");
}
