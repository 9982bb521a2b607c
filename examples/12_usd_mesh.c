// Refines a mesh as USD has it: clockwise faces (orientation = "leftHanded"), chains of creases,
// UVs without indices, one for each face-vertex, and USD's rules for boundaries and UVs. The cube
// has a sharp top, a semi-sharp edge down its side, and the UVs of a net that looks like a cross.
// The program prints what it is made of and the normal in the middle of the top, which points up.
// It writes the surface to build/usd_mesh.obj, where faces are counter-clockwise.
//
//     cc -O2 -I. examples/12_usd_mesh.c -o build/12_usd_mesh -lm && build/12_usd_mesh
//
//     5 creases, 24 UVs of which 14 differ: 7 edges are seams
//     the middle of the top has normal 0 0 1
//     386 points, 384 faces, 418 normals

#include <stdio.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

// point3f[] points, int[] faceVertexCounts and faceVertexIndices
static float points[] = { -1,-1,-1, 1,-1,-1, 1,1,-1, -1,1,-1, -1,-1,1, 1,-1,1, 1,1,1, -1,1,1 };
static int counts[] = { 4, 4, 4, 4, 4, 4 };
static int indices[] = { 0,1,2,3, 4,7,6,5, 0,4,5,1, 1,5,6,2, 2,6,7,3, 3,7,4,0 };

// int[] creaseLengths and creaseIndices, float[] creaseSharpnesses: one for each edge of all chains
static const int lengths[] = { 5, 2 }, chains[] = { 4,5,6,7,4, 0,4 };
static const float sharpnesses[] = { 10, 10, 10, 10, 2.5f };

// texCoord2f[] primvars:st (interpolation = "faceVarying"): the bottom, the top, four sides
static float st[] = {
    1,1, 2,1, 2,0, 1,0,    1,2, 1,3, 2,3, 2,2,    1,1, 1,2, 2,2, 2,1,
    2,1, 2,2, 3,2, 3,1,    3,1, 3,2, 4,2, 4,1,    4,1, 4,2, 5,2, 5,1 };

int main(void)
{
    subdiv_mesh cage = {0}, seams = {0}, fine = {0};
    subdiv_options opt = {0};
    int uvs[24], differ = 0;
    cage.vertex_count = 8;
    cage.positions = points;
    cage.face_count = 6;
    cage.face_sizes = counts;
    cage.face_vertices = indices;
    cage.left_handed = 1;
    cage.boundary = SUBDIV_BOUNDARY_EDGE_AND_CORNER;      // interpolateBoundary = "edgeAndCorner"
    cage.uv_rule = SUBDIV_UV_CORNERS_PLUS1;               // faceVaryingLinearInterpolation
    subdiv_result r = subdiv_join_values(uvs, 2, 24, st, NULL);
    cage.uv_count = 24;
    cage.uvs = st;
    cage.face_uvs = uvs;                                  // equal UVs now have one index
    for (int i = 0; i < 24 && !r; i++) differ += uvs[i] == i;

    seams = cage;                                         // a copy whose seams become creases
    if (!r) r = subdiv_crease_by_uv_seams(&seams, 1, NULL);
    if (!r) r = subdiv_crease_chains(&cage, 2, lengths, chains, 5, sharpnesses, NULL);
    if (!r) printf("%d creases, %d UVs of which %d differ: %d edges are seams\n",
                   cage.crease_count, cage.uv_count, differ, seams.crease_count);
    opt.limit = 1;
    if (!r) r = subdiv_refine(&fine, &cage, 3, &opt);
    if (r) return puts(subdiv_result_string(r)), 1;
    const float *n = fine.normals + 3 * fine.face_normals[4 * (64 + 27) + 2];
    printf("the middle of the top has normal %g %g %g\n", (double)n[0], (double)n[1], (double)n[2]);
    printf("%d points, %d faces, %d normals\n", fine.vertex_count, fine.face_count,
           fine.normal_count);
    r = subdiv_save_obj(&fine, "build/usd_mesh.obj", NULL);
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&seams);
    subdiv_mesh_free(&cage);
    return (int)r;
}
