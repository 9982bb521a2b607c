// Catmull-Clark beside Loop on one shape. Loop needs triangles, and how quads are split shows;
// Catmull-Clark of the triangles shows it, too.
#include "gallery.h"

int main(int argc, char **argv)
{
    static const char *const labels[] = {"quads", "Catmull-Clark", "split", "Loop",
                                         "Catmull-Clark, split"};
    shape quads, triangles;
    subdiv_mesh fine[3];
    panel panels[5] = {{0}};
    shape_box(&quads, SUBDIV_CATMULL_CLARK, 1, 0.7, 1);
    shape_box(&triangles, SUBDIV_LOOP, 1, 0.7, 1);
    fine[0] = refined(&quads, 4, 1);
    fine[1] = refined(&triangles, 4, 1);
    panels[0].mesh = &quads.mesh;
    panels[1].mesh = &fine[0];
    panels[2].mesh = &triangles.mesh;
    panels[3].mesh = &fine[1];
    triangles.mesh.scheme = SUBDIV_CATMULL_CLARK;
    fine[2] = refined(&triangles, 4, 1);
    panels[4].mesh = &fine[2];
    for (int i = 0; i < 5; i++) {
        panels[i].label = labels[i];
        panels[i].material = i == 1 || i == 0 ? 5 : 0;
        panels[i].flat = i % 2 == 0 && i < 4;
        panels[i].edges = panels[i].flat ? 0.75f : 0.22f;
    }
    int failed = png_row(argc, argv, "schemes", &quads.mesh, 30, 24, 5, panels);
    for (int i = 0; i < 3; i++) subdiv_mesh_free(&fine[i]);
    return failed;
}
