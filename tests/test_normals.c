// subdiv_normals and subdiv_normals_by_angle on random cages: each face-vertex has the mean normal
// of the faces that are joined to its own around its vertex, across edges that are no creases.
//
//     cc -I. tests/test_normals.c -o build/test_normals -lm && build/test_normals
#include <stdio.h>
#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/random_cage.h"
#include "lib/test.h"

enum { FEATURES = RANDOM_ALL & ~RANDOM_DEGENERATE, CAGES = 300 };

static char context[64];

// The face-vertices of a mesh, one by one.
static int face[RANDOM_MAX_FACES * RANDOM_MAX_SIZE], next[RANDOM_MAX_FACES * RANDOM_MAX_SIZE];
static int before[RANDOM_MAX_FACES * RANDOM_MAX_SIZE], count;
static double area[RANDOM_MAX_FACES][3];

static void list_face_vertices(const subdiv_mesh *mesh)
{
    count = 0;
    for (int f = 0; f < mesh->face_count; f++) {
        int size = mesh->face_size ? mesh->face_size : mesh->face_sizes[f], first = count;
        memset(area[f], 0, sizeof area[f]);
        for (int i = 0; i < size; i++, count++) {
            const float *p = mesh->positions + 3 * mesh->face_vertices[first + i];
            const float *q = mesh->positions + 3 * mesh->face_vertices[first + (i + 1) % size];
            face[count] = f;
            next[count] = first + (i + 1) % size;
            before[count] = first + (i + size - 1) % size;
            for (int k = 0; k < 3; k++)
                area[f][k] += (double)p[(k + 1) % 3] * q[(k + 2) % 3] -
                              (double)p[(k + 2) % 3] * q[(k + 1) % 3];
        }
    }
}

static double length(const double *a)
{
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

// Is the edge of h smooth, and does g run back along it?
static int joins(const subdiv_mesh *mesh, int h, int g, double degrees)
{
    const int *v = mesh->face_vertices;
    int a = v[h], b = v[next[h]], uses = 0;
    float sharpness = 0;
    if (v[g] != b || v[next[g]] != a) return 0;
    for (int i = 0; i < count; i++)
        uses += (v[i] == a && v[next[i]] == b) || (v[i] == b && v[next[i]] == a);
    for (int i = 0; i < mesh->crease_count; i++) {
        const int *ends = mesh->crease_vertices + 2 * i;
        if ((ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a))
            sharpness = mesh->crease_sharpness[i];              // the later one wins
    }
    const double *m = area[face[h]], *n = area[face[g]];
    double cosine = (m[0] * n[0] + m[1] * n[1] + m[2] * n[2]) / (length(m) * length(n));
    return uses == 2 && sharpness < SUBDIV_INFINITE &&
           acos(fmax(fmin(cosine, 1), -1)) * 57.29578 <= degrees;
}

// Sums the normals of the faces on the side of h, and marks its face-vertices there.
static void sum_side(const subdiv_mesh *mesh, int h, double degrees, unsigned char *seen, double *n)
{
    seen[h] = 1;
    for (int k = 0; k < 3; k++) n[k] += area[face[h]][k];
    for (int g = 0; g < count; g++) {
        if (mesh->face_vertices[g] != mesh->face_vertices[h] || seen[g]) continue;
        if (joins(mesh, h, before[g], degrees) || joins(mesh, g, before[h], degrees))
            sum_side(mesh, g, degrees, seen, n);
    }
}

static void check_normals(const subdiv_mesh *mesh, double degrees)
{
    static unsigned char seen[RANDOM_MAX_FACES * RANDOM_MAX_SIZE];
    list_face_vertices(mesh);
    for (int h = 0; h < count && !test_bad; h++) {
        double n[3] = { 0, 0, 0 };
        const float *normal = mesh->normals + 3 * (mesh->face_normals ? mesh->face_normals[h]
                                                                     : mesh->face_vertices[h]);
        memset(seen, 0, (size_t)count);
        sum_side(mesh, h, degrees, seen, n);
        if (length(n) < 1e-3) continue;                   // rounding decides
        for (int k = 0; k < 3; k++) CHECK_NEAR(normal[k], n[k] / length(n), 1e-4);
    }
}

// Each normal is that of a face-vertex, but for those of vertices without faces.
static void check_numbers(const subdiv_mesh *mesh)
{
    unsigned char *used = (unsigned char *)calloc((size_t)mesh->normal_count, 1);
    for (int h = 0; h < count; h++) used[mesh->face_normals[h]] |= 1;
    for (int h = 0; h < count; h++) used[mesh->face_vertices[h]] |= 2;
    for (int i = 0; i < mesh->normal_count; i++)
        CHECK(i < mesh->vertex_count ? used[i] != 2 : used[i] == 1);
    free(used);
}

static void test_creases(void)
{
    for (unsigned seed = 1; seed <= CAGES; seed++) {
        random_cage *c = random_cage_new(seed, FEATURES);
        snprintf(context, sizeof context, "seed %u", seed);
        test_context = context;
        CHECK_EQUAL(subdiv_normals(&c->mesh, NULL), SUBDIV_OK);
        check_normals(&c->mesh, 181);
        if (c->mesh.face_normals) check_numbers(&c->mesh);
        else CHECK_EQUAL(c->mesh.normal_count, c->mesh.vertex_count);
        float *normals = c->mesh.normals;                 // filled where they are
        CHECK_EQUAL(subdiv_normals(&c->mesh, NULL), SUBDIV_OK);
        CHECK(c->mesh.normals == normals);
        subdiv_mesh_free(&c->mesh);
        random_cage_free(c);
    }
}

static void test_angles(void)
{
    for (unsigned seed = 1; seed <= CAGES; seed++) {
        random_cage *c = random_cage_new(seed, FEATURES);
        float degrees = (float)(seed % 4) * 30 + 0.5f;
        snprintf(context, sizeof context, "seed %u, %g degrees", seed, (double)degrees);
        test_context = context;
        CHECK_EQUAL(subdiv_normals_by_angle(&c->mesh, degrees, NULL), SUBDIV_OK);
        check_normals(&c->mesh, (double)degrees);
        subdiv_mesh_free(&c->mesh);
        random_cage_free(c);
    }
    CHECK_EQUAL(subdiv_normals_by_angle(NULL, 30, NULL), SUBDIV_ERROR_ARGUMENT);
}

int main(void)
{
    RUN(test_creases);
    RUN(test_angles);
    return test_end("normals");
}
