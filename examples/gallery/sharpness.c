// A cube whose top has creases of sharpness 0, 1, 2, 3 and forever: for so many levels their edges
// are split as if they were curves, then they turn smooth.
#include "gallery.h"

int main(int argc, char **argv)
{
    static const char *const labels[] = {"sharpness 0", "sharpness 1", "sharpness 2", "sharpness 3",
                                         "forever"};
    static const int top[] = {2, 6, 7, 3};
    shape cage;
    subdiv_mesh fine[5];
    panel panels[5] = {{0}};
    for (int i = 0; i < 5; i++) {
        shape_box(&cage, SUBDIV_CATMULL_CLARK, 1, 1, 1);
        for (int k = 0; k < 4 && i > 0; k++)
            shape_crease(&cage, top[k], top[(k + 1) % 4], i < 4 ? (float)i : SUBDIV_INFINITE);
        fine[i] = refined(&cage, 5, 1);
        panels[i].mesh = &fine[i];
        panels[i].label = labels[i];
    }
    int failed = png_row(argc, argv, "sharpness", &fine[4], 30, 28, 5, panels);
    for (int i = 0; i < 5; i++) subdiv_mesh_free(&fine[i]);
    return failed;
}
