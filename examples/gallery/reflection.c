// Reflection lines show what shading hides. Around a regular vertex the surface is C2 and they are
// smooth; at an extraordinary one it is C1 and they bend; at a crease they break.
#include "gallery.h"

#include <math.h>
#include <stdlib.h>

// Parallel lights above, as the eye sees them in each face.
static unsigned char *stripes(const subdiv_mesh *mesh)
{
    static const float eye[3] = {0.25f, 0.75f, 0.60f};
    const int *numbers = mesh->face_normals ? mesh->face_normals : mesh->face_vertices;
    unsigned char *materials = malloc((size_t)mesh->face_count);
    for (int f = 0; f < mesh->face_count && materials; f++) {
        float n[3] = {0, 0, 0}, dot = 0;
        for (int i = 0; i < 12; i++) n[i % 3] += mesh->normals[3 * numbers[4 * f + i / 3] + i % 3];
        for (int k = 0; k < 3; k++) dot += n[k] * eye[k] / 16;
        materials[f] = sinf(60 * dot * (0.8f * n[0] + 0.6f * n[2])) > 0 ? 3 : 2;
    }
    return materials;
}

int main(int argc, char **argv)
{
    static const char *const labels[] = {"valence 4, C2", "valence 3, C1", "valence 7, C1",
                                         "a crease"};
    static const int valences[] = {4, 3, 7, 4};
    shape cage;
    subdiv_mesh fine[4];
    panel panels[4] = {{0}};
    unsigned char *materials[4];
    for (int i = 0; i < 4; i++) {
        shape_fan(&cage, SUBDIV_CATMULL_CLARK, valences[i]);
        for (int v = 0; v < cage.mesh.vertex_count; v++) {      // a dome, its top is up
            float *p = cage.positions + 3 * v, z = p[1];
            p[1] = v == 0 ? 0.8f : v % 2 ? 0.4f : -0.1f;
            p[2] = -z;
        }
        if (i == 3) shape_crease(&cage, 0, 1, 10), shape_crease(&cage, 0, 5, 10);
        fine[i] = refined(&cage, 7, 1);
        panels[i].mesh = &fine[i];
        panels[i].label = labels[i];
        panels[i].materials = materials[i] = stripes(&fine[i]);
        if (!materials[i]) return 1;
    }
    int failed = png_row(argc, argv, "reflection", &fine[0], 20, 48, 4, panels);
    for (int i = 0; i < 4; i++) subdiv_mesh_free(&fine[i]), free(materials[i]);
    return failed;
}
