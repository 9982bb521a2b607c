// Refines a channel of three quads by four levels, with five values of sharpness for its two bends
// and with two boundary rules. The program prints where two vertices go: an end of a bend, from
// (-1, -1, -1), and a free corner, from (-1, -1, 1). The sharper the crease, the nearer the bend
// stays to its place. Only edge-and-corner keeps the free corner. Compare build/creases_*.obj.
//
//     cc -O2 -I. examples/03_creases.c -o build/03_creases -lm && build/03_creases
//
//     sharpness  rule             bend                    free corner             file
//             1  edge             (-1.000 -0.836 -0.836)  (-0.668 -1.000 0.668)   build/crea...
//             1  edge-and-corner  (-1.000 -0.836 -0.836)  (-1.000 -1.000 1.000)   build/crea...

#include <stdio.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

static float P[] = {-1,-1,-1, 1,-1,-1, 1,1,-1, -1,1,-1, -1,-1,1, 1,-1,1, 1,1,1, -1,1,1};
static int   F[] = {0,3,2,1, 0,1,5,4, 2,3,7,6};
static int   E[] = {0,1, 2,3};                          // the two bends

static int refine_channel(float sharpness, subdiv_boundary boundary, const subdiv_options *opt)
{
    const char *rule = boundary == SUBDIV_BOUNDARY_EDGE ? "edge" : "edge-and-corner";
    float S[] = {sharpness, sharpness};
    subdiv_mesh channel = {0}, fine = {0};
    channel.vertex_count = 8;
    channel.positions = P;
    channel.face_count = 3;
    channel.face_size = 4;
    channel.face_vertices = F;
    channel.crease_count = 2;
    channel.crease_vertices = E;
    channel.crease_sharpness = S;
    channel.boundary = boundary;

    if (subdiv_refine(&fine, &channel, 4, opt) == SUBDIV_OK) {
        const float *a = fine.positions, *b = fine.positions + 3 * 4;
        char file[64];
        snprintf(file, sizeof file, "build/creases_%g_%s.obj", (double)sharpness, rule);
        printf("%9g  %-15s  (%.3f %.3f %.3f)  (%.3f %.3f %.3f)   %s\n", (double)sharpness, rule,
               (double)a[0], (double)a[1], (double)a[2],
               (double)b[0], (double)b[1], (double)b[2], file);
        subdiv_save_obj(&fine, file, opt);
    }
    subdiv_mesh_free(&fine);
    return opt->error->code != SUBDIV_OK;
}

int main(void)
{
    const float sharpness[] = {0, 0.5f, 1, 2.5f, SUBDIV_INFINITE};
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    printf("sharpness  rule             bend                    free corner             file\n");
    for (int i = 0; i < 5 && !error.code; i++)
        if (!refine_channel(sharpness[i], SUBDIV_BOUNDARY_EDGE, &opt))
            refine_channel(sharpness[i], SUBDIV_BOUNDARY_EDGE_AND_CORNER, &opt);
    if (error.code) printf("%s\n", error.message);
    return (int)error.code;
}
