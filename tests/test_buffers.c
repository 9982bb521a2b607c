// Vertex buffers: of random cages with creases, UVs and polygons, on every level.
//
//     cc -I. tests/test_buffers.c -o build/test_buffers -lm && build/test_buffers
#include <stdio.h>
#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/random_cage.h"
#include "lib/test.h"

enum { CAGES = 200, STRIDE = 13 };

static char context[64];

static int index_of(const subdiv_buffer *b, int i)
{
    const unsigned short *two = (const unsigned short *)b->indices;
    const int *four = (const int *)b->indices;
    return b->index_size == 2 ? two[i] : four[i];
}

// Each triangle's vertices have what the face-vertices that it was cut from have.
static void check_indices(const subdiv_buffer *b, const subdiv_mesh *mesh)
{
    int at = 0, h = 0;
    for (int f = 0; f < mesh->face_count; f++) {
        int size = mesh->face_size ? mesh->face_size : mesh->face_sizes[f];
        for (int i = 2; i < size; i++)
            for (int k = 0; k < 3; k++, at++) {
                int v = index_of(b, at), from = h + (k ? i - 2 + k : 0);
                const int *normals = mesh->face_normals ? mesh->face_normals : mesh->face_vertices;
                CHECK(v >= 0 && v < b->vertex_count);
                CHECK_EQUAL(b->points[v], mesh->face_vertices[from]);
                CHECK_EQUAL(b->normals[v], normals[from]);
                CHECK_EQUAL(b->uvs[v], mesh->uv_count ? mesh->face_uvs[from] : -1);
            }
        h += size;
    }
    CHECK_EQUAL(at, b->index_count);
}

static int compare(const void *a, const void *b)
{
    return memcmp(a, b, 3 * sizeof(int));
}

// Vertex i is point i and has normal i, as long as there are such; and no vertex is there twice.
static void check_vertices(const subdiv_buffer *b)
{
    size_t count = (size_t)b->vertex_count;
    int (*all)[3] = (int (*)[3])malloc(count * sizeof *all);
    for (int v = 0; v < b->vertex_count; v++) {
        if (v < b->point_count) CHECK_EQUAL(b->points[v], v);
        if (v < b->normal_count) CHECK_EQUAL(b->normals[v], v);
        all[v][0] = b->points[v];
        all[v][1] = b->normals[v];
        all[v][2] = b->uvs[v];
    }
    qsort(all, count, sizeof *all, compare);
    for (size_t v = 1; v < count; v++) CHECK(compare(all[v - 1], all[v]) != 0);
    free(all);
}

// The normals of face-vertices of a surface are those of its mesh.
static void check_face_normals(const subdiv_surface *surface, const subdiv_mesh *fine)
{
    int count = 0, *normals;
    for (int f = 0; f < fine->face_count; f++)
        count += fine->face_sizes ? fine->face_sizes[f] : fine->face_size;
    normals = (int *)malloc(((size_t)count + 1) * sizeof *normals);
    normals[count] = -7;
    CHECK_EQUAL(subdiv_surface_face_normals(surface, normals, NULL), SUBDIV_OK);
    const int *expected = fine->face_normals ? fine->face_normals : fine->face_vertices;
    for (int i = 0; i < count; i++) CHECK_EQUAL(normals[i], expected[i]);
    CHECK_EQUAL(normals[count], -7);
    free(normals);
}

// Writes vertices into one array: position, normal, UV and color, with gaps.
static subdiv_vertices lay_out(float *data, const subdiv_mesh *mesh)
{
    subdiv_vertices out = {0};
    out.positions = data + 1;
    out.normals = mesh->normals ? data + 4 : NULL;
    out.uvs = mesh->uv_count ? data + 7 : NULL;
    out.colors = mesh->colors ? data + 10 : NULL;
    out.stride = STRIDE;
    return out;
}

static float *fill(const subdiv_buffer *b, const subdiv_mesh *mesh)
{
    float *data = (float *)calloc((size_t)b->vertex_count, STRIDE * sizeof *data);
    subdiv_vertices out = lay_out(data, mesh);
    CHECK_EQUAL(subdiv_fill_buffer(b, mesh, &out, NULL), SUBDIV_OK);
    for (int v = 0; v < b->vertex_count; v++) {
        const float *at = data + STRIDE * v;
        CHECK(memcmp(at + 1, mesh->positions + 3 * b->points[v], 12) == 0);
        if (out.normals) CHECK(memcmp(at + 4, mesh->normals + 3 * b->normals[v], 12) == 0);
        if (out.uvs && b->uvs[v] < 0) CHECK(at[7] == 0 && at[8] == 0);
        else if (out.uvs) CHECK(memcmp(at + 7, mesh->uvs + 2 * b->uvs[v], 8) == 0);
        if (out.colors) CHECK(memcmp(at + 10, mesh->colors + 3 * b->points[v], 12) == 0);
        CHECK(at[0] == 0);
    }
    return data;
}

// In each frame a buffer has the bits of the mesh.
static void check_frames(const subdiv_buffer *b, const subdiv_surface *surface,
                         const subdiv_mesh *cage, const subdiv_mesh *fine)
{
    size_t size = subdiv_scratch_size(surface, 3);
    size_t bytes = (size_t)b->vertex_count * STRIDE * sizeof(float);
    void *scratch = malloc(size);
    float *still = fill(b, fine), *moved = (float *)malloc(bytes), *frame;
    float *positions = (float *)malloc(3 * sizeof(float) * (size_t)cage->vertex_count);
    subdiv_mesh mesh;
    for (int i = 0; i < 3 * cage->vertex_count; i++)
        positions[i] = cage->positions[(i + 3) % (3 * cage->vertex_count)];
    memcpy(moved, still, bytes);
    subdiv_vertices out = lay_out(moved, fine);
    CHECK_EQUAL(subdiv_evaluate_buffer(b, surface, cage->positions, &out, scratch, NULL),
                SUBDIV_OK);
    CHECK(memcmp(moved, still, bytes) == 0);
    CHECK_EQUAL(subdiv_evaluate_buffer(b, surface, positions, &out, scratch, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_surface_mesh(&mesh, surface, positions, NULL), SUBDIV_OK);
    frame = fill(b, &mesh);
    CHECK(memcmp(moved, frame, bytes) == 0);
    subdiv_mesh_free(&mesh);
    free(scratch);
    free(still);
    free(moved);
    free(frame);
    free(positions);
}

static void test_random_cages(void)
{
    for (unsigned seed = 1; seed <= CAGES; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        subdiv_surface *surface = NULL;
        subdiv_mesh fine = {0};
        subdiv_buffer b[2];
        subdiv_options opt = {0};
        opt.limit = seed % 3 > 0;
        opt.one_normal = seed % 5 == 0;
        opt.keep_holes = seed % 7 == 0;
        snprintf(context, sizeof context, "seed %u", seed);
        test_context = context;
        if (seed % 2) c->mesh.colors = c->mesh.positions;
        c->mesh.normal_count = 5;                         // says nothing without face_normals
        CHECK_EQUAL(subdiv_prepare(&surface, &c->mesh, (int)(seed % 4), &opt), SUBDIV_OK);
        CHECK_EQUAL(subdiv_surface_mesh(&fine, surface, c->mesh.positions, &opt), SUBDIV_OK);
        CHECK_EQUAL(subdiv_surface_normal_count(surface), fine.normal_count);
        CHECK(opt.limit ? fine.normal_count >= fine.vertex_count : fine.normal_count == 0);
        if (opt.limit) check_face_normals(surface, &fine);
        for (int k = 0; k < 2; k++) {
            CHECK_EQUAL(subdiv_make_buffer(&b[k], &fine, 4 - 2 * k, NULL), SUBDIV_OK);
            check_indices(&b[k], &fine);
        }
        check_vertices(&b[0]);
        check_frames(&b[1], surface, &c->mesh, &fine);
        for (int k = 0; k < 2; k++) subdiv_buffer_free(&b[k]);
        subdiv_mesh_free(&fine);
        subdiv_surface_free(surface);
        random_cage_free(c);
    }
}

static void test_errors(void)
{
    float p[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    int v[3] = { 0, 1, 2 }, odd[3] = { 0, 2, 1 };
    subdiv_mesh mesh = {0}, other;
    subdiv_buffer b;
    subdiv_surface *surface;
    subdiv_vertices out = {0};
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    mesh.vertex_count = 3;
    mesh.positions = p;
    mesh.face_count = 1;
    mesh.face_size = 3;
    mesh.face_vertices = v;
    CHECK_EQUAL(subdiv_make_buffer(NULL, &mesh, 4, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_make_buffer(&b, NULL, 4, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_make_buffer(&b, &mesh, 3, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK(b.memory == NULL && b.vertex_count == 0);
    other = mesh;
    other.normals = p;
    other.normal_count = 3;
    other.face_normals = odd;
    CHECK_EQUAL(subdiv_make_buffer(&b, &other, 4, NULL), SUBDIV_ERROR_ARGUMENT);
    other.vertex_count = 65537;
    other.positions = other.normals = NULL;
    CHECK_EQUAL(subdiv_make_buffer(&b, &other, 2, NULL), SUBDIV_ERROR_TOO_LARGE);
    CHECK_EQUAL(subdiv_make_buffer(&b, &mesh, 4, NULL), SUBDIV_OK);
    out.normals = p;
    CHECK_EQUAL(subdiv_fill_buffer(&b, &mesh, &out, &opt), SUBDIV_ERROR_ARGUMENT);
    CHECK(strcmp(error.message, "the mesh has no normals") == 0);
    out.normals = NULL;
    out.uvs = p;
    CHECK_EQUAL(subdiv_fill_buffer(&b, &mesh, &out, &opt), SUBDIV_ERROR_ARGUMENT);
    CHECK(strcmp(error.message, "the mesh has no UVs") == 0);
    out.uvs = NULL;
    out.stride = 2;
    out.positions = p;
    CHECK_EQUAL(subdiv_fill_buffer(&b, &mesh, &out, NULL), SUBDIV_ERROR_ARGUMENT);
    out.stride = 0;
    CHECK_EQUAL(subdiv_fill_buffer(&b, &other, &out, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_evaluate_buffer(&b, NULL, p, &out, NULL, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_prepare(&surface, &mesh, 1, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_evaluate_buffer(&b, surface, p, &out, NULL, NULL), SUBDIV_ERROR_ARGUMENT);
    subdiv_surface_free(surface);
    CHECK_EQUAL(subdiv_prepare(&surface, &mesh, 0, NULL), SUBDIV_OK);
    out.normals = p;
    CHECK_EQUAL(subdiv_evaluate_buffer(&b, surface, p, &out, NULL, NULL), SUBDIV_ERROR_ARGUMENT);
    subdiv_surface_free(surface);
    subdiv_buffer_free(&b);
    subdiv_buffer_free(&b);
    subdiv_buffer_free(NULL);
}

int main(void)
{
    RUN(test_random_cages);
    RUN(test_errors);
    return test_end("buffers");
}
