// One, two and three sharp edges at a vertex: a dart, where a crease fades out; a crease, which
// runs through; a corner, where the vertex stays. Sharp edges are red.
#include "gallery.h"

int main(int argc, char **argv)
{
    static const char *const labels[] = {"cage", "smooth", "dart", "crease", "corner"};
    static const int others[] = {5, 6, 3};              // of vertex 7, in front at the top
    shape cage[4];
    subdiv_mesh fine[4];
    panel panels[5] = {{0}};
    for (int i = 0; i < 4; i++) {
        shape_box(&cage[i], SUBDIV_CATMULL_CLARK, 1, 1, 1);
        for (int k = 0; k < i; k++) shape_crease(&cage[i], 7, others[k], SUBDIV_INFINITE);
        fine[i] = refined(&cage[i], 5, 1);
        panels[i + 1].mesh = &fine[i];
    }
    panels[0].mesh = &cage[3].mesh;
    panels[0].flat = 1;
    panels[0].edges = 0.75f;
    for (int i = 0; i < 5; i++) panels[i].label = labels[i], panels[i].material = 1;
    int failed = png_row(argc, argv, "features", &cage[0].mesh, 38, 28, 5, panels);
    for (int i = 0; i < 4; i++) subdiv_mesh_free(&fine[i]);
    return failed;
}
