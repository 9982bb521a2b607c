// Refines a cube by two levels with each rule for UVs. The UVs are an unfolded cross: seven edges
// of the cube are seams, so its 8 vertices have 14 values. The program prints where two values go.
// Only the last rule rounds off the outer corner of the cross. The inner corner curves, unless the
// rule keeps it. Positions are the same under all rules. Compare uv_*.obj, which the program writes
// to the folder you name, or else to build.
//
//     cc -O2 -I. examples/04_uv_seams.c -o build/04_uv_seams -lm && build/04_uv_seams
//
//     rule            vertices  UVs  outer corner      inner corner      file
//     corners only          98  125  (1.0000, 0.3333)  (0.2109, 0.7188)  build/uv_corners_only.obj
//     corners plus 2        98  125  (1.0000, 0.3333)  (0.2500, 0.6667)  build/uv_corners_plus2.obj
//     none                  98  125  (0.9609, 0.3854)  (0.2109, 0.7188)  build/uv_none.obj

#include <stdio.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

static float P[] = {-1,-1,-1, 1,-1,-1, 1,1,-1, -1,1,-1, -1,-1,1, 1,-1,1, 1,1,1, -1,1,1};
static int   F[] = {0,1,5,4, 1,2,6,5, 2,3,7,6, 3,0,4,7, 4,5,6,7, 3,2,1,0};

// The cross, in units of a quarter by a third:       12 13          four sides in a row; above and
// the value of each place. 0 and 4, 5 and 9 are    5  6  7  8  9    below the second one the top
// the two ends of the row, which meet.             0  1  2  3  4    and the bottom
//                                                    10 11
static const float places[] = {0,1, 1,1, 2,1, 3,1, 4,1, 0,2, 1,2, 2,2, 3,2, 4,2,
                               1,0, 2,0, 1,3, 2,3};
static int UV_F[] = {0,1,6,5, 1,2,7,6, 2,3,8,7, 3,4,9,8, 12,6,7,13, 11,2,1,10};

int main(int argc, char **argv)
{
    const char *folder = argc > 1 ? argv[1] : "build";
    static const char *const names[] = {"corners only", "corners plus 1", "corners plus 2",
                                        "boundaries", "all", "none"};
    static const char *const files[] = {"corners_only", "corners_plus1", "corners_plus2",
                                        "boundaries", "all", "none"};
    float uvs[28];
    for (int i = 0; i < 28; i++) uvs[i] = places[i] / (i % 2 ? 3.0f : 4.0f);
    subdiv_mesh cube = {0};
    cube.vertex_count = 8;
    cube.positions = P;
    cube.face_count = 6;
    cube.face_size = 4;
    cube.face_vertices = F;
    cube.uv_count = 14;
    cube.uvs = uvs;
    cube.face_uvs = UV_F;

    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    printf("rule            vertices  UVs  outer corner      inner corner      file\n");
    for (int rule = 0; rule < 6 && !error.code; rule++) {
        subdiv_mesh fine = {0};
        cube.uv_rule = (subdiv_uv_rule)rule;
        if (subdiv_refine(&fine, &cube, 2, &opt)) break;
        char file[256];
        const float *a = fine.uvs + 2 * 4, *b = fine.uvs + 2 * 6;   // value i stays value i
        snprintf(file, sizeof file, "%s/uv_%s.obj", folder, files[rule]);
        printf("%-14s  %8d  %3d  (%.4f, %.4f)  (%.4f, %.4f)  %s\n", names[rule], fine.vertex_count,
               fine.uv_count, (double)a[0], (double)a[1], (double)b[0], (double)b[1], file);
        subdiv_save_obj(&fine, file, &opt);
        subdiv_mesh_free(&fine);
    }
    if (error.code) printf("%s\n", error.message);
    return (int)error.code;
}
