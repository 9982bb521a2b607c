// Finds the cage whose limit surface passes through given points: here through the vertices of the
// octopus, which subdivision would otherwise round off. Each limit point is a stencil, a weighted
// sum of the cage's vertices, so the cage solves a sparse linear system: conjugate gradients do, on
// the normal equations, for each coordinate. The program prints how far the surface is from the
// points before and after, and writes it to build/octopus_fit.obj.
//
//     cc -O2 -I. examples/13_fit.c -o build/13_fit -lm && build/13_fit
//
//     before: 0.164944 away
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
            int v = s->indices[k], to = transposed ? v : i, from = transposed ? i : v;
            out[to] += (double)s->weights[k] * in[from];
        }
}

static double dot(const double *a, const double *b, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

// Sets rest to b - A x and returns its largest number.
static double find_rest(const subdiv_stencils *a, const double *b, const double *x, double *rest)
{
    double largest = 0;
    multiply(a, 0, x, rest);
    for (int i = 0; i < a->count; i++) {
        rest[i] = b[i] - rest[i];
        largest = fmax(largest, fabs(rest[i]));
    }
    return largest;
}

// Solves A x = b by conjugate gradients on A'A x = A'b. rest is b - A x; room has 3 n numbers.
static void solve(const subdiv_stencils *a, double *x, double *rest, double *room)
{
    int n = a->count;
    double *gradient = room, *way = room + n, *step = way + n, size = 0, least = 0;
    for (int turn = 0; turn < 1000; turn++) {
        double before = size;
        multiply(a, 1, rest, gradient);
        size = dot(gradient, gradient, n);
        if (turn == 0) least = 1e-20 * size;
        if (size <= least) return;
        for (int i = 0; i < n; i++) way[i] = gradient[i] + (turn ? size / before * way[i] : 0);
        multiply(a, 0, way, step);
        double length = size / dot(step, step, n);
        for (int i = 0; i < n; i++) x[i] += length * way[i], rest[i] -= length * step[i];
    }
}

int main(void)
{
    subdiv_mesh cage = {0}, fine = {0};
    subdiv_surface *surface = NULL;
    subdiv_stencils limit = {0};
    subdiv_options opt = {0};
    double before = 0, after = 0;
    opt.limit = 1;                                        // level 0: the limits of the vertices
    subdiv_result r = subdiv_load_obj(&cage, "examples/cages/octopus.obj", NULL);
    if (!r) r = subdiv_prepare(&surface, &cage, 0, &opt);
    if (!r) r = subdiv_refined_stencils(&limit, surface, 0, cage.vertex_count, &opt);
    int n = limit.count;
    double *b = (double *)malloc(6 * sizeof(double) * (size_t)n + 1), *x = b + n, *rest = x + n;
    for (int c = 0; c < 3 && b; c++) {
        for (int i = 0; i < n; i++) b[i] = x[i] = (double)cage.positions[3 * i + c];
        before = fmax(before, find_rest(&limit, b, x, rest));
        solve(&limit, x, rest, rest + n);
        after = fmax(after, find_rest(&limit, b, x, rest));
        for (int i = 0; i < n; i++) cage.positions[3 * i + c] = (float)x[i];
    }
    if (!r) r = subdiv_refine(&fine, &cage, 3, &opt);
    if (!r) r = subdiv_save_obj(&fine, "build/octopus_fit.obj", &opt);
    if (r) puts(subdiv_result_string(r));
    else printf("before: %f away\nafter:  %f away\n", before, after);
    free(b);
    subdiv_mesh_free(&fine);
    subdiv_stencils_free(&limit);
    subdiv_surface_free(surface);
    subdiv_mesh_free(&cage);
    return r != SUBDIV_OK;
}
