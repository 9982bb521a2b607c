// How a face becomes four: Catmull-Clark cuts quads (and any other polygon into quads), Loop
// triangles.
#include "gallery.h"

int main(int argc, char **argv)
{
    static const char *const titles[] = {"a quad", "a pentagon", "a triangle", "Loop: a triangle"};
    if (!svg_begin(argc, argv, "split", 920, 260)) return 1;
    for (int i = 0; i < 4; i++) {
        const svg_place at = {115 + 230 * i, i < 2 ? 115 : 130, 90};
        const int sides[] = {4, 5, 3, 3};
        shape ring, s;
        shape_fan(&ring, SUBDIV_LOOP, sides[i]);        // its outer vertices are the polygon
        s = ring;
        shape_begin(&s, i < 3 ? SUBDIV_BILINEAR : SUBDIV_LOOP);
        s.mesh.face_size = sides[i];
        s.mesh.face_count = 1;
        s.mesh.vertex_count = sides[i];
        for (int k = 0; k < sides[i]; k++) {
            s.faces[k] = sides[i] - 1 - k;
            for (int j = 0; j < 3; j++) s.positions[3 * k + j] = ring.positions[3 * (k + 1) + j];
        }
        subdiv_options linear = {0};
        subdiv_mesh fine;
        linear.linear = 1;
        if (subdiv_refine(&fine, &s.mesh, 1, &linear)) return 1;
        svg_mesh(&fine, at, 1.5, CORAL, "#fff");
        svg_mesh(&s.mesh, at, 3, INK, "none");
        for (int v = 0; v < fine.vertex_count; v++)
            svg_dot(at.x + at.scale * (double)fine.positions[3 * v],
                    at.y - at.scale * (double)fine.positions[3 * v + 1], 5,
                    v < sides[i] ? INK : v < 2 * sides[i] ? CORAL : TEAL);
        svg_text(at.x, 238, 14, INK, titles[i]);
        subdiv_mesh_free(&fine);
    }
    return svg_end();
}
