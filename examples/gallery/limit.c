// Refinement against the limit: each level comes closer, and the limit masks go there at once, from
// any level.
#include "gallery.h"

int main(int argc, char **argv)
{
    static const char *const labels[] = {"cage", "level 1", "level 2", "level 3", "the limit"};
    static const double rings[][2] = {{0.75, 0}, {1, 0.1}, {1.3, 0.9}, {0.55, 1.7}, {0.8, 2.3}};
    shape cage;
    subdiv_mesh mesh[5];
    panel panels[5] = {{0}};
    shape_loft(&cage, SUBDIV_CATMULL_CLARK, 6, 5, rings);
    for (int i = 0; i < 5; i++) {
        mesh[i] = refined(&cage, i < 4 ? i : 5, i == 4);
        panels[i].mesh = &mesh[i];
        panels[i].label = labels[i];
        panels[i].material = 1;
        panels[i].flat = i < 4;
        panels[i].edges = i < 4 ? 0.6f - 0.15f * (float)i : 0;
    }
    int failed = png_row(argc, argv, "limit", &cage.mesh, 20, 22, 5, panels);
    for (int i = 0; i < 5; i++) subdiv_mesh_free(&mesh[i]);
    return failed;
}
