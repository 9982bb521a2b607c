// What happens at the boundary: its masks, and the three rules on a flat patch.
#include "gallery.h"

int main(int argc, char **argv)
{
    static const char *const titles[] = {"edge: a smooth curve", "edge and corner",
                                         "none: its faces are dropped"};
    const svg_place masks[] = {{235, 115, 100}, {685, 115, 100}};
    shape s;
    if (!svg_begin(argc, argv, "boundary", 920, 540)) return 1;
    shape_grid(&s, SUBDIV_CATMULL_CLARK, 2, 1);
    svg_mask(&s.mesh, 6, masks[0], "edge point on the boundary");
    svg_mask(&s.mesh, 1, masks[1], "vertex point on the boundary");
    for (int rule = 0; rule < 3; rule++) {
        const svg_place at = {160 + 300 * rule, 390, 60};
        shape_grid(&s, SUBDIV_CATMULL_CLARK, 3, 3);
        s.mesh.boundary = (subdiv_boundary)rule;
        subdiv_mesh fine = refined(&s, 3, 0);
        svg_mesh(&s.mesh, at, 1.5, GREY, "none");
        svg_mesh(&fine, at, 0.8, INK, "#fff");
        svg_text(at.x, at.y + 122, 14, INK, titles[rule]);
        subdiv_mesh_free(&fine);
    }
    return svg_end();
}
