// The same cage under the rules that were tried for the vertex points of Catmull-Clark: how far a
// vertex follows its neighbours makes a surface pointed or round.
#include "gallery.h"

static void weights(void *user, int valence, double w[3])
{
    (void)user;
    (void)valence;
    w[0] = 0.75;                                        // v hardly moves
    w[1] = 0.125;
    w[2] = 0.125;
}

int main(int argc, char **argv)
{
    static const char *const labels[] = {"cage", "standard", "averaged", "Doo-Sabin",
                                         "a rule of your own"};
    shape cage;
    subdiv_mesh fine[4];
    panel panels[5] = {{0}};
    shape_box(&cage, SUBDIV_CATMULL_CLARK, 1, 1, 1);
    panels[0].mesh = &cage.mesh;
    panels[0].flat = 1;
    panels[0].edges = 0.75f;
    for (int i = 0; i < 4; i++) {
        cage.mesh.vertex_rule = (subdiv_vertex_rule)(i % 3);
        cage.mesh.vertex_weights = i == 3 ? weights : NULL;
        fine[i] = refined(&cage, 5, 0);
        panels[i + 1].mesh = &fine[i];
    }
    for (int i = 0; i < 5; i++) panels[i].label = labels[i], panels[i].material = 4;
    int failed = png_row(argc, argv, "vertex_rules", &cage.mesh, 30, 28, 5, panels);
    for (int i = 0; i < 4; i++) subdiv_mesh_free(&fine[i]);
    return failed;
}
