// Puts the points of the refined octopus on the limit surface, with its exact normals. The program
// prints, for each level, how far the points were from there and how wrong their usual normals
// were, those weighted by the areas of faces. It writes level 3 to build/octopus_limit.obj.
//
//     cc -O2 -I. examples/06_limit_normals.c -o build/06_limit_normals -lm && build/06_limit_normals
//
//     level 1: at most 0.04703 away, normals at most 12.8 degrees off

#include <math.h>
#include <stdio.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

static double distance(const float *a, const float *b)
{
    double x = (double)(a[0] - b[0]), y = (double)(a[1] - b[1]), z = (double)(a[2] - b[2]);
    return sqrt(x * x + y * y + z * z);
}

int main(void)
{
    subdiv_mesh cage = {0};
    subdiv_options opt = {0};
    opt.limit = 1;
    subdiv_result r = subdiv_load_obj(&cage, "examples/cages/octopus.obj", NULL);
    for (int level = 1; level <= 3 && !r; level++) {
        subdiv_mesh fine = {0}, limit = {0};
        double away = 0, off = 0;
        r = subdiv_refine(&fine, &cage, level, NULL);
        if (!r) r = subdiv_normals(&fine, NULL);
        if (!r) r = subdiv_refine(&limit, &cage, level, &opt);
        for (int i = 0; i < 3 * fine.vertex_count && !r; i += 3) {
            away = fmax(away, distance(fine.positions + i, limit.positions + i));
            off = fmax(off, distance(fine.normals + i, limit.normals + i));
        }
        if (!r) printf("level %d: at most %.5f away, normals at most %.1f degrees off\n", level,
                       away, 2 * asin(fmin(off / 2, 1)) * 57.29578);
        if (!r && level == 3) r = subdiv_save_obj(&limit, "build/octopus_limit.obj", NULL);
        subdiv_mesh_free(&fine);
        subdiv_mesh_free(&limit);
    }
    puts(subdiv_result_string(r));
    subdiv_mesh_free(&cage);
    return (int)r;
}
