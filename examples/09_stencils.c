// Writes a point of a surface as a weighted sum of the cage's vertices. The program prints the
// weights that make vertex 0 of the octopus after two levels, and on the limit surface with its two
// tangents. It prints the sums beside the points, which are equal. Last, it explains the weights
// after one level.
//
//     cc -O2 -I. examples/09_stencils.c -o build/09_stencils -lm && build/09_stencils
//
//         vertex   0   0.472656
//         vertex   1   0.107422
//         the sum     -0.149842  0.216163  0.671941
//         the point   -0.149842  0.216163  0.671941

#include <stdio.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

static void print_stencil(const subdiv_stencils *s, int i, const subdiv_mesh *cage)
{
    double sum[3] = {0};
    for (size_t k = s->offsets[i]; k < s->offsets[i + 1]; k++) {
        int v = s->indices[k];
        printf("    vertex %3d  %9.6f", v, (double)s->weights[k]);
        if (s->du) printf("  %9.6f  %9.6f", (double)s->du[k], (double)s->dv[k]);
        printf("\n");
        for (int c = 0; c < 3; c++) sum[c] += (double)(s->weights[k] * cage->positions[3 * v + c]);
    }
    printf("    the sum     %9.6f %9.6f %9.6f\n", sum[0], sum[1], sum[2]);
}

int main(void)
{
    subdiv_mesh cage = {0};
    subdiv_result r = subdiv_load_obj(&cage, "examples/cages/octopus.obj", NULL);
    for (int limit = 0; limit < 2 && !r; limit++) {
        subdiv_surface *surface = NULL;
        subdiv_stencils stencils = {0};
        subdiv_mesh fine = {0};
        subdiv_options opt = {0};
        opt.limit = limit;
        r = subdiv_prepare(&surface, &cage, 2, &opt);
        if (!r) r = subdiv_refined_stencils(&stencils, surface, 0, 1, &opt);
        if (!r) r = subdiv_surface_mesh(&fine, surface, cage.positions, &opt);
        printf(limit ? "on the limit surface: point, first and second tangent\n" : "level 2\n");
        if (!r) print_stencil(&stencils, 0, &cage);
        if (!r) printf("    the point   %9.6f %9.6f %9.6f\n", (double)fine.positions[0],
                       (double)fine.positions[1], (double)fine.positions[2]);
        subdiv_mesh_free(&fine);
        subdiv_stencils_free(&stencils);
        subdiv_surface_free(surface);
    }
    char text[4000] = "";
    if (!r) r = subdiv_explain(text, sizeof text, &cage, 0, NULL);
    printf("\n%s\n%s\n", text, subdiv_result_string(r));
    subdiv_mesh_free(&cage);
    return (int)r;
}
