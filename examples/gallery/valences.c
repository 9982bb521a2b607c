// Regular and extraordinary vertices, valence 3 to 8, with the mask of the vertex in the middle and
// what three steps make of its surroundings. Quads are regular at 4, triangles at 6.
#include "gallery.h"

int main(int argc, char **argv)
{
    if (!svg_begin(argc, argv, "valences", 930, 420)) return 1;
    for (int loop = 0; loop < 2; loop++)
        for (int n = 3; n <= 8; n++) {
            const svg_place at = {80 + 154 * (n - 3), 88 + 195 * loop, loop ? 72 : 56};
            shape s;
            char title[32];
            shape_fan(&s, loop ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, n);
            subdiv_mesh fine = refined(&s, 3, 0);
            int regular = n == (loop ? 6 : 4);
            svg_mesh(&s.mesh, at, 1.2, GREY, "none");
            svg_mesh(&fine, at, 0.8, regular ? TEAL : INK, "#fff");
            svg_dot(at.x, at.y, 5, regular ? TEAL : CORAL);
            snprintf(title, sizeof title, regular ? "valence %d, regular" : "valence %d", n);
            svg_text(at.x, at.y + 96, 13, regular ? TEAL : INK, title);
            subdiv_mesh_free(&fine);
        }
    svg_text(465, 400, 13, INK, "above Catmull-Clark, below Loop");
    return svg_end();
}
