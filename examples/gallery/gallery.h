// What the programs of the gallery share: small cages, drawings as SVG, rows of shaded pictures as
// PNG. Each program draws one picture of examples/README.md, and make gallery runs them all. To
// build one alone:
//
//     cc -I. -Iexamples/demo -DSUBDIV_STATIC -DSUBDIV_IMPLEMENTATION
//         examples/gallery/sharpness.c examples/gallery/gallery.c
//         examples/demo/render.c examples/demo/picture.c -o sharpness -lm && ./sharpness .
#ifndef GALLERY_H
#define GALLERY_H

#include "subdiv.h"

#include <stdio.h>

// ---- cages

typedef struct shape {                // a mesh with room for its arrays
    subdiv_mesh mesh;
    float positions[3 * 256], sharpness[64];
    int   faces[4 * 256], creases[2 * 64];
} shape;

void shape_begin(shape *s, subdiv_scheme scheme);           // faces get 4 vertices, of Loop 3
int  shape_vertex(shape *s, double x, double y, double z);  // returns its number
void shape_face(shape *s, int a, int b, int c, int d);      // d: of quads alone
void shape_crease(shape *s, int a, int b, float sharpness);
void shape_grid(shape *s, subdiv_scheme scheme, int columns, int rows);  // flat, unit squares
void shape_fan(shape *s, subdiv_scheme scheme, int valence);    // flat, around vertex 0
void shape_box(shape *s, subdiv_scheme scheme, double x, double y, double z);
void shape_loft(shape *s, subdiv_scheme scheme, int sides, int count, const double (*rings)[2]);

// ---- drawings, in pixels with y downward; colours as in SVG

#define INK   "#3d3d42"
#define GREY  "#b8b2a6"
#define CORAL "#e2583e"
#define AMBER "#f0a01e"
#define TEAL  "#23908c"

int  svg_begin(int argc, char **argv, const char *name, int width, int height);
int  svg_end(void);                   // returns what main returns
void svg_line(double ax, double ay, double bx, double by, double width, const char *colour);
void svg_dot(double x, double y, double radius, const char *colour);
void svg_text(double x, double y, double size, const char *colour, const char *text); // centred
void svg_label(double x, double y, const char *text, const char *colour);   // on a white pill
void svg_curve(const float *points, int count, int closed, double width, const char *colour);

typedef struct svg_place { double x, y, scale; } svg_place;     // where the mesh's origin goes

void svg_mesh(const subdiv_mesh *mesh, svg_place at, double width, const char *colour,
              const char *fill);
void svg_mask(const subdiv_mesh *cage, int point, svg_place at, const char *title);
const char *fraction(double number, char text[32]);

// ---- shaded pictures

typedef struct panel {                // one in the row
    const subdiv_mesh *mesh;
    const char *label;
    int    flat;                      // facets instead of smooth normals
    float  edges;                     // how dark they are, 0 to 1
    int    material;                  // 0 coral, 1 teal, 2 white, 3 dark, 4 amber, 5 blue
    const unsigned char *materials;   // of each face of mesh instead, or NULL
} panel;

// Draws a row of panels; all look at fit in the same way. Returns what main returns.
int png_row(int argc, char **argv, const char *name, const subdiv_mesh *fit, float yaw, float pitch,
            int count, const panel *panels);

// Refines or ends the program with a message.
subdiv_mesh refined(const shape *s, int levels, int limit);

#endif
