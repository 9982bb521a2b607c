// The masks of Catmull-Clark and Loop, asked of the library and drawn on the mesh: the weights of
// the vertices of the cage in one new point.
#include "gallery.h"

int main(int argc, char **argv)
{
    const svg_place at[2][3] = {{{150, 130, 100}, {460, 130, 100}, {770, 130, 80}},
                                {{150, 390, 90}, {460, 390, 110}, {770, 390, 90}}};
    shape s;
    if (!svg_begin(argc, argv, "masks", 920, 540)) return 1;
    shape_grid(&s, SUBDIV_CATMULL_CLARK, 1, 1);
    svg_mask(&s.mesh, 8, at[0][0], "Catmull-Clark: face point");
    shape_grid(&s, SUBDIV_CATMULL_CLARK, 2, 1);
    svg_mask(&s.mesh, 7, at[0][1], "edge point (odd)");
    shape_grid(&s, SUBDIV_CATMULL_CLARK, 2, 2);
    svg_mask(&s.mesh, 4, at[0][2], "vertex point (even)");
    shape_grid(&s, SUBDIV_LOOP, 1, 1);
    svg_mask(&s.mesh, 5, at[1][1], "edge point (odd)");
    shape_fan(&s, SUBDIV_LOOP, 6);
    svg_mask(&s.mesh, 0, at[1][2], "vertex point (even)");
    svg_text(150, 390, 14, INK, "Loop has no face points");
    return svg_end();
}
