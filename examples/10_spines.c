// Grows nine spines on each face of the octopus. A spine stands at a location (face, u, v) of the
// limit surface, along the normal there. Its length is a fourth channel of the cage's vertices,
// evaluated with their positions. The program also walks into a vertex where five faces meet and
// prints how the normal tends to that of the vertex. It writes build/octopus_spines.obj: look at it
// together with build/octopus_limit.obj of 06_limit_normals.
//
//     cc -O2 -I. examples/10_spines.c -o build/10_spines -lm && build/10_spines
//
//     u = v = 0.1    normal (0.6941646, -0.6351256, 0.3387491)
//     u = v = 0      normal (0.6128654, -0.7834415, 0.1030309)
//     6120 spines: no error

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

enum { PER_SIDE = 3, PER_FACE = PER_SIDE * PER_SIDE };

// Writes the four points of a spine: three around its foot, across the normal, and its tip.
static void put_spine(const float *foot, const float *du, const float *normal, float *points)
{
    float scale = 0.012f / sqrtf(du[0] * du[0] + du[1] * du[1] + du[2] * du[2]);
    for (int k = 0; k < 3; k++) {
        int l = (k + 1) % 3, m = (k + 2) % 3;
        float along = scale * du[k], across = scale * (normal[l] * du[m] - normal[m] * du[l]);
        points[k] = foot[k] + along;
        points[3 + k] = foot[k] - 0.5f * along + 0.866f * across;
        points[6 + k] = foot[k] - 0.5f * along - 0.866f * across;
        points[9 + k] = foot[k] + foot[3] * normal[k];
    }
}

// Makes the spines of one face. Evaluation only reads: faces could go to threads.
static subdiv_result grow(const subdiv_surface *surface, const void *scratch, int face,
                          float *points)
{
    subdiv_location at[PER_FACE];
    float feet[4 * PER_FACE], du[4 * PER_FACE], normals[3 * PER_FACE];
    subdiv_derivatives out = {0};
    out.points = feet;
    out.du = du;
    out.normals = normals;
    for (int i = 0; i < PER_FACE; i++) {
        at[i].face = face;
        at[i].corner = 0;
        at[i].u = ((float)(i % PER_SIDE) + 0.5f) / PER_SIDE;
        at[i].v = ((float)(i / PER_SIDE) + 0.5f) / PER_SIDE;
    }
    subdiv_result r = subdiv_evaluate_at(surface, 4, scratch, PER_FACE, at, &out, NULL);
    for (int i = 0; i < PER_FACE && !r; i++)
        put_spine(feet + 4 * i, du + 4 * i, normals + 3 * i, points + 12 * i);
    return r;
}

// Vertex 1 is at u = v = 0 of face 1.
static subdiv_result go_to_vertex(const subdiv_surface *surface, const void *scratch)
{
    subdiv_result r = SUBDIV_OK;
    float steps[] = { 0.1f, 1e-2f, 1e-4f, 1e-8f, 0 }, n[3];
    subdiv_derivatives out = {0};
    out.normals = n;
    for (int i = 0; i < 5 && !r; i++) {
        subdiv_location at = { 1, 0, steps[i], steps[i] };
        r = subdiv_evaluate_at(surface, 4, scratch, 1, &at, &out, NULL);
        printf("u = v = %-6g normal (%.7f, %.7f, %.7f)\n", (double)steps[i],
               (double)n[0], (double)n[1], (double)n[2]);
    }
    return r;
}

int main(void)
{
    subdiv_mesh cage = {0}, spines = {0};
    subdiv_surface *surface = NULL;
    subdiv_result r = subdiv_load_obj(&cage, "examples/cages/octopus.obj", NULL);
    if (!r) r = subdiv_prepare(&surface, &cage, SUBDIV_EXACT, NULL);
    if (r) return puts(subdiv_result_string(r)), 1;
    int count = PER_FACE * cage.face_count;
    static const int sides[9] = { 0,1,3, 1,2,3, 2,0,3 };
    float *values = (float *)malloc(4 * sizeof(float) * (size_t)cage.vertex_count);
    void *scratch = malloc(subdiv_scratch_size(surface, 4));
    spines.vertex_count = 4 * count;
    spines.face_count = 3 * count;
    spines.face_size = 3;
    spines.positions = (float *)malloc(12 * sizeof(float) * (size_t)count);
    spines.face_vertices = (int *)malloc(9 * sizeof(int) * (size_t)count);
    if (!values || !scratch || !spines.positions || !spines.face_vertices) return 1;
    for (int i = 0; i < 4 * cage.vertex_count; i++)         // the longest ones on top
        values[i] = i % 4 < 3 ? cage.positions[i / 4 * 3 + i % 4]
                              : 0.03f + 0.1f * fmaxf(0, cage.positions[i / 4 * 3 + 1]);
    r = subdiv_evaluate_begin(surface, 4, values, 0, scratch, NULL);
    if (!r) r = go_to_vertex(surface, scratch);
    for (int f = 0; f < cage.face_count && !r; f++)
        r = grow(surface, scratch, f, spines.positions + 12 * PER_FACE * f);
    for (int i = 0; i < 9 * count; i++) spines.face_vertices[i] = i / 9 * 4 + sides[i % 9];
    if (!r) r = subdiv_save_obj(&spines, "build/octopus_spines.obj", NULL);
    printf("%d spines: %s\n", count, subdiv_result_string(r));
    free(values);
    free(scratch);
    free(spines.positions);
    free(spines.face_vertices);
    subdiv_surface_free(surface);
    subdiv_mesh_free(&cage);
    return (int)r;
}
