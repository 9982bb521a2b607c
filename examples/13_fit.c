// Finds the cage whose limit surface passes through given points: here through the vertices of the
// octopus, which subdivision would otherwise round off. Each limit point is a stencil, a weighted
// sum of the cage's vertices, so the cage solves a sparse linear system. Conjugate gradients do, on
// the normal equations, for each coordinate. The program prints how far the surface is from the
// points before and after, and writes both to build/octopus_limit.obj and build/octopus_fit.obj.
//
//     cc -O2 -I. examples/13_fit.c -o build/13_fit -lm && build/13_fit
//
//     before: 0.164945 away
//     after:  0.000000 away

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

// Sets out to the sums of the stencils, or adds up the transposed ones: what each vertex gives.
static void multiply(const subdiv_stencils *s, int transposed, const double *in, double *out)
{
    memset(out, 0, sizeof(double) * (size_t)s->count);
    for (int i = 0; i < s->count; i++)
        for (size_t k = s->offsets[i]; k < s->offsets[i + 1]; k++) {
            int v = s->indices[k];
            if (transposed) out[v] += (double)s->weights[k] * in[i];
            else out[i] += (double)s->weights[k] * in[v];
        }
}

static double dot(const double *a, const double *b, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

// Solves A x = b by conjugate gradients on A'A x = A'b. room has 4 n numbers.
static void solve(const subdiv_stencils *a, const double *b, double *x, double *room)
{
    int n = a->count;
    double *rest = room, *gradient = rest + n, *way = gradient + n, *step = way + n;
    multiply(a, 0, x, rest);
    for (int i = 0; i < n; i++) rest[i] = b[i] - rest[i];
    multiply(a, 1, rest, gradient);
    memcpy(way, gradient, sizeof(double) * (size_t)n);
    double size = dot(gradient, gradient, n), first = size;
    for (int turn = 0; turn < 1000 && size > 1e-20 * first; turn++) {
        multiply(a, 0, way, step);
        double length = size / dot(step, step, n), before = size;
        for (int i = 0; i < n; i++) x[i] += length * way[i], rest[i] -= length * step[i];
        multiply(a, 1, rest, gradient);
        size = dot(gradient, gradient, n);
        for (int i = 0; i < n; i++) way[i] = gradient[i] + size / before * way[i];
    }
}

// Writes the limit surface of a cage, and returns how far its first points are from the targets.
static double distance(const subdiv_mesh *cage, const float *targets, const char *path)
{
    subdiv_mesh fine = {0};
    subdiv_options opt = {0};
    double largest = 0;
    opt.limit = 1;
    if (subdiv_refine(&fine, cage, 3, &opt) || subdiv_save_obj(&fine, path, &opt)) return HUGE_VAL;
    for (int i = 0; i < 3 * cage->vertex_count; i++)
        largest = fmax(largest, fabs((double)fine.positions[i] - (double)targets[i]));
    subdiv_mesh_free(&fine);
    return largest;
}

int main(void)
{
    subdiv_mesh cage = {0};
    subdiv_surface *surface = NULL;
    subdiv_stencils limit = {0};
    subdiv_options opt = {0};
    opt.limit = 1;                                        // level 0: the limits of the vertices
    subdiv_result r = subdiv_load_obj(&cage, "examples/cages/octopus.obj", NULL);
    if (!r) r = subdiv_prepare(&surface, &cage, 0, &opt);
    if (!r) r = subdiv_refined_stencils(&limit, surface, 0, cage.vertex_count, &opt);
    if (r) return puts(subdiv_result_string(r)), 1;

    int n = limit.count;
    double *b = (double *)malloc(6 * sizeof(double) * (size_t)n), *x = b + n;
    float *targets = (float *)malloc(3 * sizeof(float) * (size_t)n);
    if (!b || !targets) return 1;
    memcpy(targets, cage.positions, 3 * sizeof(float) * (size_t)n);
    printf("before: %f away\n", distance(&cage, targets, "build/octopus_limit.obj"));
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < n; i++) b[i] = x[i] = (double)targets[3 * i + c];
        solve(&limit, b, x, x + n);
        for (int i = 0; i < n; i++) cage.positions[3 * i + c] = (float)x[i];
    }
    printf("after:  %f away\n", distance(&cage, targets, "build/octopus_fit.obj"));
    free(targets);
    free(b);
    subdiv_stencils_free(&limit);
    subdiv_surface_free(surface);
    subdiv_mesh_free(&cage);
    return 0;
}
