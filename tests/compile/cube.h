// The check that every program here makes, in C and in C++: one level of a cube has 26 vertices,
// and vertex 0 goes from (-1, -1, -1) to 5/9 of that. Include it after subdiv.h.
#ifndef CUBE_H
#define CUBE_H

#include <string.h>

static int cube_is_right(void)
{
    float P[] = {-1,-1,-1, 1,-1,-1, 1,1,-1, -1,1,-1, -1,-1,1, 1,-1,1, 1,1,1, -1,1,1};
    int   F[] = {0,3,2,1, 4,5,6,7, 0,1,5,4, 1,2,6,5, 2,3,7,6, 3,0,4,7};
    subdiv_mesh cube, fine;
    memset(&cube, 0, sizeof cube);
    cube.vertex_count = 8;
    cube.positions = P;
    cube.face_count = 6;
    cube.face_size = 4;
    cube.face_vertices = F;
    if (subdiv_refine(&fine, &cube, 1, NULL)) return 0;
    float error = fine.positions[0] + 5.0f / 9;
    int right = fine.vertex_count == 26 && fine.face_count == 24 && error * error < 1e-12f;
    subdiv_mesh_free(&fine);
    return right;
}

#endif
