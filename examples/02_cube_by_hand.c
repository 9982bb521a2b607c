// Fills in a cube by hand and refines it by 0 to 3 levels. The four edges of the top are creases:
// three stay sharp for two levels, the last one forever. The program prints how the mesh grows and
// where one vertex of the top goes. It writes build/cube.obj, level 3.
//
//     cc -O2 -I. examples/02_cube_by_hand.c -o build/02_cube_by_hand -lm && build/02_cube_by_hand
//
//     level 0:    8 vertices,   6 faces,  4 creases, vertex 4 at (-1, -1, 1)
//     level 1:   26 vertices,  24 faces,  8 creases, vertex 4 at (-0.75, -0.75, 1)
//     level 2:   98 vertices,  96 faces,  4 creases, vertex 4 at (-0.6875, -0.6875, 1)
//     level 3:  386 vertices, 384 faces,  8 creases, vertex 4 at (-0.65625, -0.65625, 0.888889)

#include <stdio.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

static float P[] = {-1,-1,-1, 1,-1,-1, 1,1,-1, -1,1,-1, -1,-1,1, 1,-1,1, 1,1,1, -1,1,1};
static int   F[] = {0,3,2,1, 4,5,6,7, 0,1,5,4, 1,2,6,5, 2,3,7,6, 3,0,4,7};
static int   E[] = {4,5, 5,6, 6,7, 7,4};
static float S[] = {2, 2, 2, SUBDIV_INFINITE};

int main(void)
{
    subdiv_mesh cube = {0};
    cube.vertex_count = 8;
    cube.positions = P;
    cube.face_count = 6;
    cube.face_size = 4;
    cube.face_vertices = F;
    cube.crease_count = 4;
    cube.crease_vertices = E;
    cube.crease_sharpness = S;

    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    for (int level = 0; level <= 3 && error.code == SUBDIV_OK; level++) {
        subdiv_mesh fine = {0};
        if (subdiv_refine(&fine, &cube, level, &opt)) break;
        const float *p = fine.positions + 3 * 4;        // vertex 4 of the cage is vertex 4 here
        printf("level %d: %4d vertices, %3d faces, %2d creases, vertex 4 at (%g, %g, %g)\n", level,
               fine.vertex_count, fine.face_count, fine.crease_count,
               (double)p[0], (double)p[1], (double)p[2]);
        if (level == 3) subdiv_save_obj(&fine, "build/cube.obj", &opt);
        subdiv_mesh_free(&fine);
    }
    if (error.code) printf("%s\n", error.message);
    return (int)error.code;
}
