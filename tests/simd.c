// Prints a sum of the bits of many results, for tests/simd.sh to compare between ways to compile.

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/random_cage.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static unsigned long long add_bits(unsigned long long sum, const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        unsigned bits;
        memcpy(&bits, values + i, sizeof bits);
        sum = (sum ^ bits) * 1099511628211u;
    }
    return sum;
}

// Evaluates 1 to 9 channels, each made from the positions.
static unsigned long long add_cage(unsigned long long sum, const subdiv_mesh *m, unsigned seed)
{
    subdiv_surface *surface = NULL;
    subdiv_options opt;
    const int channels = seed % 4 == 0 ? 1 + (int)(seed / 4 % 9) : 3;
    const size_t wide = (size_t)channels;
    memset(&opt, 0, sizeof opt);
    opt.linear = seed % 11 == 0;
    if (subdiv_prepare(&surface, m, 1 + (int)(seed % 4), &opt)) abort();
    const size_t points = (size_t)subdiv_surface_vertex_count(surface);
    float *in = (float *)malloc(wide * sizeof(float) * (size_t)m->vertex_count);
    float *out = (float *)malloc(wide * sizeof(float) * points);
    if (!in || !out) abort();
    for (int i = 0; i < channels * m->vertex_count; i++)
        in[i] = m->positions[(3 * (i / channels) + i % channels) % (3 * m->vertex_count)];
    if (subdiv_evaluate(surface, channels, in, 0, out, 0, NULL, NULL)) abort();
    sum = add_bits(sum, out, wide * points);
    subdiv_surface_free(surface);
    free(in);
    free(out);
    return sum;
}

// Positions and normals on the limit surface.
static unsigned long long add_limit(unsigned long long sum, const subdiv_mesh *m, unsigned seed)
{
    subdiv_mesh fine;
    subdiv_options opt;
    memset(&opt, 0, sizeof opt);
    opt.limit = 1;
    if (subdiv_refine(&fine, m, (int)(seed % 4), &opt)) abort();
    sum = add_bits(sum, fine.positions, 3 * (size_t)fine.vertex_count);
    sum = add_bits(sum, fine.normals, 3 * (size_t)fine.vertex_count);
    subdiv_mesh_free(&fine);
    return sum;
}

// The limit surface at places on all faces.
static unsigned long long add_exact(unsigned long long sum, const subdiv_mesh *m, unsigned seed)
{
    subdiv_surface *surface = NULL;
    float out[6][4], normal[4];
    subdiv_derivatives to = { out[0], out[1], out[2], out[3], out[4], out[5], normal, 4 };
    if (subdiv_prepare(&surface, m, SUBDIV_EXACT, NULL)) abort();
    void *scratch = malloc(subdiv_scratch_size(surface, 3));
    if (!scratch || subdiv_evaluate_begin(surface, 3, m->positions, 0, scratch, NULL)) abort();
    for (int f = 0; f < m->face_count; f++) {
        subdiv_location at = { f, 0, (float)(seed % 8) / 16, (float)(f % 9) / 17 };
        if (subdiv_evaluate_at(surface, 3, scratch, 1, &at, &to, NULL)) abort();
        for (int k = 0; k < 6; k++) sum = add_bits(sum, out[k], 3);
        sum = add_bits(sum, normal, 3);
    }
    subdiv_surface_free(surface);
    free(scratch);
    return sum;
}

int main(void)
{
    unsigned long long sum = 14695981039346656037u;
    for (unsigned seed = 1; seed <= 400; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        if (!c) abort();
        // Rounded, so that the cage is the same whatever the compiler makes of cos and sin.
        for (int i = 0; i < 3 * c->mesh.vertex_count; i++)
            c->positions[i] = floorf(c->positions[i] * 4096) / 4096;
        sum = add_cage(sum, &c->mesh, seed);
        sum = add_limit(sum, &c->mesh, seed);
        if (seed % 8 == 0) sum = add_exact(sum, &c->mesh, seed);
        random_cage_free(c);
    }
    printf("%016llx\n", sum);
    return 0;
}
