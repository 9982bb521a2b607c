// Cages, drawings and rows of pictures: see gallery.h.
#include "gallery.h"
#include "render.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --------------------------------------------------------------------------------- cages

void shape_begin(shape *s, subdiv_scheme scheme)
{
    memset(s, 0, sizeof *s);
    s->mesh.scheme = scheme;
    s->mesh.face_size = scheme == SUBDIV_LOOP ? 3 : 4;
    s->mesh.positions = s->positions;
    s->mesh.face_vertices = s->faces;
    s->mesh.crease_vertices = s->creases;
    s->mesh.crease_sharpness = s->sharpness;
}

int shape_vertex(shape *s, double x, double y, double z)
{
    float *p = s->positions + 3 * s->mesh.vertex_count;
    p[0] = (float)x;
    p[1] = (float)y;
    p[2] = (float)z;
    return s->mesh.vertex_count++;
}

void shape_face(shape *s, int a, int b, int c, int d)
{
    const int v[4] = {a, b, c, d};
    int size = s->mesh.face_size, *face = s->faces + size * s->mesh.face_count++;
    for (int i = 0; i < size; i++) face[i] = v[i];
}

// A quad, or two triangles.
static void shape_quad(shape *s, int a, int b, int c, int d)
{
    shape_face(s, a, b, c, d);
    if (s->mesh.face_size == 3) shape_face(s, a, c, d, 0);
}

void shape_crease(shape *s, int a, int b, float sharpness)
{
    int i = s->mesh.crease_count++;
    s->creases[2 * i] = a;
    s->creases[2 * i + 1] = b;
    s->sharpness[i] = sharpness;
}

void shape_grid(shape *s, subdiv_scheme scheme, int columns, int rows)
{
    shape_begin(s, scheme);
    for (int r = 0; r <= rows; r++)
        for (int c = 0; c <= columns; c++) {
            double shear = scheme == SUBDIV_LOOP ? 0.5 * (rows / 2.0 - r) : 0;
            double height = scheme == SUBDIV_LOOP ? 0.866 : 1;
            shape_vertex(s, c - columns / 2.0 - shear, height * (r - rows / 2.0), 0);
        }
    for (int r = 0; r < rows; r++)
        for (int c = 0; c < columns; c++) {
            int a = r * (columns + 1) + c, d = a + columns + 1;
            shape_face(s, a, a + 1, scheme == SUBDIV_LOOP ? d : d + 1, d);
            if (scheme == SUBDIV_LOOP) shape_face(s, a + 1, d + 1, d, 0);
        }
}

void shape_fan(shape *s, subdiv_scheme scheme, int valence)
{
    shape_begin(s, scheme);
    shape_vertex(s, 0, 0, 0);
    for (int i = 0; i < valence; i++) {
        double a = 6.283185307 * i / valence, b = a + 3.141592654 / valence;
        shape_vertex(s, sin(a), cos(a), 0);
        if (scheme != SUBDIV_LOOP) shape_vertex(s, 1.25 * sin(b), 1.25 * cos(b), 0);
    }
    for (int i = 0; i < valence; i++) {
        int next = (i + 1) % valence;
        if (scheme == SUBDIV_LOOP) shape_face(s, 0, 1 + next, 1 + i, 0);
        else shape_face(s, 0, 1 + 2 * next, 2 + 2 * i, 1 + 2 * i);
    }
}

void shape_box(shape *s, subdiv_scheme scheme, double x, double y, double z)
{
    static const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    shape_begin(s, scheme);
    for (int i = 0; i < 8; i++)
        shape_vertex(s, i & 1 ? x : -x, i & 2 ? y : -y, i & 4 ? z : -z);
    for (int i = 0; i < 6; i++) shape_quad(s, faces[i][0], faces[i][1], faces[i][2], faces[i][3]);
}

// Rings of vertices, each of a radius at a height, from below; closed by a vertex at either end.
void shape_loft(shape *s, subdiv_scheme scheme, int sides, int count, const double (*rings)[2])
{
    shape_begin(s, scheme);
    for (int r = 0; r < count; r++)
        for (int i = 0; i < sides; i++) {
            double a = 6.283185307 * i / sides;
            shape_vertex(s, rings[r][0] * sin(a), rings[r][1], rings[r][0] * cos(a));
        }
    for (int r = 0; r + 1 < count; r++)
        for (int i = 0; i < sides; i++) {
            int a = r * sides + i, b = r * sides + (i + 1) % sides;
            shape_quad(s, a, b, b + sides, a + sides);
        }
}

subdiv_mesh refined(const shape *s, int levels, int limit)
{
    subdiv_mesh fine;
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    opt.limit = limit;
    if (subdiv_refine(&fine, &s->mesh, levels, &opt) == SUBDIV_OK) return fine;
    fprintf(stderr, "%s\n", error.message);
    exit(1);
}

// ------------------------------------------------------------------------------ drawings

static FILE *svg;

int svg_begin(int argc, char **argv, const char *name, int width, int height)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s.svg", argc > 1 ? argv[1] : ".", name);
    svg = fopen(path, "w");
    if (!svg) {
        perror(path);
        return 0;
    }
    printf("%s\n", path);
    fprintf(svg, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" "
            "height=\"%d\" font-family=\"Helvetica, Arial, sans-serif\">\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"#f6f4f0\"/>\n", width, height, width,
            height);
    return 1;
}

int svg_end(void)
{
    fputs("</svg>\n", svg);
    return fclose(svg) != 0;
}

void svg_line(double ax, double ay, double bx, double by, double width, const char *colour)
{
    fprintf(svg, "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"%s\" stroke-width=\"%g\" "
            "stroke-linecap=\"round\"/>\n", ax, ay, bx, by, colour, width);
}

void svg_dot(double x, double y, double radius, const char *colour)
{
    fprintf(svg, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%g\" fill=\"%s\"/>\n", x, y, radius, colour);
}

void svg_text(double x, double y, double size, const char *colour, const char *text)
{
    fprintf(svg, "<text x=\"%.1f\" y=\"%.1f\" font-size=\"%g\" fill=\"%s\" "
            "text-anchor=\"middle\">%s</text>\n", x, y + size / 3, size, colour, text);
}

void svg_label(double x, double y, const char *text, const char *colour)
{
    double width = 10 + 7 * (double)strlen(text);
    fprintf(svg, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"20\" rx=\"10\" "
            "fill=\"#fff\" stroke=\"%s\" stroke-width=\"1.5\"/>\n", x - width / 2, y - 10, width,
            colour);
    svg_text(x, y, 12.5, INK, text);
}

void svg_curve(const float *points, int count, int closed, double width, const char *colour)
{
    fprintf(svg, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"%g\" stroke-linejoin=\"round\" "
            "stroke-linecap=\"round\" d=\"", colour, width);
    for (int i = 0; i < count; i++)
        fprintf(svg, "%c%.2f %.2f", i ? 'L' : 'M', (double)points[2 * i],
                (double)points[2 * i + 1]);
    fputs(closed ? "Z\"/>\n" : "\"/>\n", svg);
}

void svg_mesh(const subdiv_mesh *mesh, svg_place at, double width, const char *colour,
              const char *fill)
{
    fprintf(svg, "<path fill=\"%s\" stroke=\"%s\" stroke-width=\"%g\" stroke-linejoin=\"round\" "
            "d=\"", fill, colour, width);
    for (int i = 0; i < mesh->face_size * mesh->face_count; i++) {
        const float *p = mesh->positions + 3 * mesh->face_vertices[i];
        fprintf(svg, "%c%.1f %.1f%s", i % mesh->face_size ? 'L' : 'M',
                at.x + at.scale * (double)p[0], at.y - at.scale * (double)p[1],
                (i + 1) % mesh->face_size ? "" : "Z");
    }
    fputs("\"/>\n", svg);
    for (int i = 0; i < mesh->crease_count; i++) {
        const float *a = mesh->positions + 3 * mesh->crease_vertices[2 * i];
        const float *b = mesh->positions + 3 * mesh->crease_vertices[2 * i + 1];
        svg_line(at.x + at.scale * (double)a[0], at.y - at.scale * (double)a[1],
                 at.x + at.scale * (double)b[0], at.y - at.scale * (double)b[1], 3, CORAL);
    }
}

const char *fraction(double number, char text[32])
{
    for (int q = 1; q <= 600; q++) {
        double p = floor(number * q + 0.5);
        if (p < 1 || fabs(number * q - p) > 1e-5) continue;
        snprintf(text, 32, q > 1 ? "%.0f/%d" : "%.0f", p, q);
        return text;
    }
    snprintf(text, 32, "%.3f", number);
    return text;
}

// The new point is a coral dot, or a coral rim where a vertex of the cage moves.
void svg_mask(const subdiv_mesh *cage, int point, svg_place at, const char *title)
{
    subdiv_explanation e;
    double x = 0, y = 0;
    if (subdiv_explain_points(&e, cage, NULL)) exit(1);
    size_t first = e.masks.offsets[point], end = e.masks.offsets[point + 1];
    svg_mesh(cage, at, 1.5, GREY, "#fff");
    for (size_t k = first; k < end; k++) {
        x += (double)(e.masks.weights[k] * cage->positions[3 * e.masks.indices[k]]);
        y += (double)(e.masks.weights[k] * cage->positions[3 * e.masks.indices[k] + 1]);
    }
    for (int v = 0; v < cage->vertex_count; v++)
        svg_dot(at.x + at.scale * (double)cage->positions[3 * v],
                at.y - at.scale * (double)cage->positions[3 * v + 1], 3, GREY);
    svg_dot(at.x + at.scale * x, at.y - at.scale * y, 7, CORAL);
    for (size_t k = first; k < end; k++) {
        const float *p = cage->positions + 3 * e.masks.indices[k];
        char text[32];
        svg_label(at.x + at.scale * (double)p[0], at.y - at.scale * (double)p[1],
                  fraction((double)e.masks.weights[k], text),
                  e.masks.indices[k] == point ? CORAL : INK);
    }
    svg_text(at.x, at.y + 120, 14, INK, title);
    subdiv_explanation_free(&e);
}

// ---------------------------------------------------------------------- shaded pictures

enum { PANEL_WIDTH = 236, PANEL_HEIGHT = 220, ROW_HEIGHT = PANEL_HEIGHT + 34 };

static const render_material materials[] = {
    {"coral", 0.93f, 0.40f, 0.30f, 0.10f}, {"teal",  0.16f, 0.62f, 0.60f, 0.10f},
    {"white", 0.97f, 0.96f, 0.94f, 0.30f}, {"dark",  0.13f, 0.13f, 0.18f, 0.60f},
    {"amber", 0.98f, 0.74f, 0.28f, 0.10f}, {"blue",  0.26f, 0.48f, 0.76f, 0.15f}
};

int png_row(int argc, char **argv, const char *name, const subdiv_mesh *fit, float yaw, float pitch,
            int count, const panel *panels)
{
    char path[512];
    render_picture picture;
    render_view view;
    snprintf(path, sizeof path, "%s/%s.png", argc > 1 ? argv[1] : ".", name);
    int ok = render_picture_new(&picture, count * PANEL_WIDTH, ROW_HEIGHT);
    render_view_fit(&view, fit, yaw, pitch, PANEL_WIDTH, PANEL_HEIGHT);
    for (int i = 0; i < count && ok; i++) {
        const subdiv_mesh *mesh = panels[i].mesh;
        unsigned char *same = malloc((size_t)mesh->face_count);
        render_style style = {materials, same, 0, 0, 0, 0, 0, NULL, 0};
        subdiv_mesh own = *mesh;
        own.cage_faces = NULL;                          // materials are of the mesh's own faces
        if (same) memset(same, panels[i].material, (size_t)mesh->face_count);
        if (panels[i].materials) style.face_materials = panels[i].materials;
        style.flat = panels[i].flat;
        style.edge_opacity = panels[i].edges;
        style.edge_width = panels[i].edges > 0 ? 0.8f : 0;
        style.crease_width = panels[i].flat ? 2.2f : 1.2f;
        ok = same && render_mesh(&picture, i * PANEL_WIDTH, 0, PANEL_WIDTH, PANEL_HEIGHT, &own,
                                  &view, &style);
        render_text(&picture, ((float)i + 0.5f) * PANEL_WIDTH, PANEL_HEIGHT + 12, 10,
                    panels[i].label);
        free(same);
    }
    ok = ok && render_save_png(&picture, path);
    printf(ok ? "%s\n" : "%s: not written\n", path);
    render_picture_free(&picture);
    return !ok;
}
