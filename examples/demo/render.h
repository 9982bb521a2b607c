// A small software renderer for the demo: a mesh becomes a picture with soft light and shadows, and
// a picture becomes a PNG file. C99 and libm alone. render.c draws, picture.c has text and PNG.
#ifndef RENDER_H
#define RENDER_H

#include "subdiv.h"

#include <stdio.h>

typedef struct render_picture {
    int    width, height;
    float *rgb;                       // [3 * width * height]  0 to 1, as shown on a screen
} render_picture;

typedef struct render_material {
    const char *name;                 // as in the usemtl lines of the OBJ file
    float red, green, blue;           // 0 to 1, as shown on a screen
    float gloss;                      // 0 dull ... 1 polished
} render_material;

typedef struct render_view {          // a camera, and where its picture goes
    float eye[3], right[3], up[3], back[3];
    float scale, x, y;                // pixel = (x + scale * right / depth, y - scale * up / depth)
} render_view;

typedef struct render_style {
    const render_material *materials;
    const unsigned char   *face_materials;  // of each face of the cage, into materials
    int   flat;                       // 1: facets, 0: the mesh's normals or, if it has none, means
                                      // of its faces' that are broken at creases
    float edge_width, edge_opacity;   // of all edges, in pixels and 0 to 1
    float crease_width;               // of the sharp edges; corners become dots of thrice this
    float lift;                       // height of the mesh above the ground
    const subdiv_mesh *caster;        // casts the shadows, a coarser level say; NULL: the mesh
    float line_width;                 // of polylines, in pixels
} render_style;

// A picture with the backdrop alone. Returns 0 when out of memory.
int  render_picture_new(render_picture *picture, int width, int height);
void render_picture_free(render_picture *picture);

// Looks at a mesh from yaw degrees around (0 is from +z) and pitch degrees above, and frames it in
// a panel of this size. The same view serves all levels: they lie inside their cage.
void render_view_fit(render_view *view, const subdiv_mesh *mesh, float yaw, float pitch,
                     int width, int height);

// Draws a mesh into the panel at left, top. Returns 0 when out of memory.
int  render_mesh(render_picture *picture, int left, int top, int width, int height,
                 const subdiv_mesh *mesh, const render_view *view, const render_style *style);

// Writes text (lower case, digits, a few signs) centred at x, its baseline at y.
void render_text(render_picture *picture, float x, float y, float size, const char *text);

// Writes a PNG file. Returns 0 on failure.
int  render_write_png(const render_picture *picture, FILE *file);
int  render_save_png(const render_picture *picture, const char *path);

#endif
