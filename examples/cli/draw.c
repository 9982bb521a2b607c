// --picture: draws the result, or the cage and the result, with the renderer of the demo.
#include "cli.h"
#include "../demo/render.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>

enum { WIDTH = 640, HEIGHT = 560, FOOT = 44, MATERIALS = 64 };
enum { MOST_CASTING = 60000 };        // faces; a finer mesh has the shadow of a coarser one

typedef struct drawing {
    render_picture  picture;
    render_view     view;
    render_material materials[MATERIALS];
    unsigned char  *face_materials;   // of the cage
    frame           box;
    subdiv_mesh     cage, caster;     // the cage without its holes; what casts the shadow
    shape           coarse, fine;     // the cage and the result
} drawing;

static subdiv_result take_materials(drawing *d, const subdiv_mesh *cage, const subdiv_options *opt)
{
    materials all;
    subdiv_result result = find_materials(&all, cage, opt);
    if (result) return result;
    for (int i = 0; i < MATERIALS; i++) {
        render_material *m = &d->materials[i];
        float rgb[3];
        material_color(i, rgb);
        m->red = rgb[0];
        m->green = rgb[1];
        m->blue = rgb[2];
        m->gloss = 0.12f;
    }
    d->face_materials = (unsigned char *)malloc((size_t)cage->face_count + 1);
    if (!d->face_materials) result = set_error(opt, SUBDIV_ERROR_MEMORY, "out of memory");
    for (int f = 0; f < cage->face_count && !result; f++)
        d->face_materials[f] = (unsigned char)(all.of_faces[f] % MATERIALS);
    free(all.memory);
    return result;
}

// Makes the mesh that casts the shadow, if the result is too fine for that.
static subdiv_result make_caster(drawing *d, const work *w, const subdiv_options *opt)
{
    int levels = 1;
    if (w->fine.face_count <= MOST_CASTING) return SUBDIV_OK;
    for (int faces = w->cage.face_count; faces <= MOST_CASTING / 16; faces *= 4) levels++;
    subdiv_result result = subdiv_refine(&d->caster, &w->cage, levels, opt);
    return result ? result : place_points(d->caster.positions, &d->caster, &d->box, opt);
}

static subdiv_result make_shapes(drawing *d, const work *w, int pieces, int beside,
                                 const subdiv_options *opt)
{
    subdiv_options plain = {0};
    plain.error = opt->error;
    plain.triangulate = opt->triangulate;
    subdiv_result result = take_materials(d, &w->cage, opt);
    if (!result) result = frame_mesh(&d->box, &w->fine, opt);
    if (!result && beside) result = subdiv_refine(&d->cage, &w->cage, 0, &plain);
    if (!result && beside) result = frame_mesh(&d->box, &d->cage, opt);
    if (!result && beside)
        result = make_shape(&d->coarse, &d->cage, &d->box, &w->cage, w->surface, 1, opt);
    if (!result)
        result = make_shape(&d->fine, &w->fine, &d->box, &w->cage, w->surface, pieces, opt);
    return result ? result : make_caster(d, w, opt);
}

// Draws a mesh into a panel. Edges fade where they are dense.
static int draw_panel(drawing *d, int left, const subdiv_mesh *mesh, int is_cage,
                      const char *label)
{
    float edge = sqrtf(WIDTH * HEIGHT / (1 + (float)mesh->face_count)), clear = (edge - 4) / 40;
    render_style style = {0};
    style.materials = d->materials;
    style.face_materials = d->face_materials;
    style.flat = is_cage;
    style.edge_width = clear > 0 ? 0.9f : 0;
    style.edge_opacity = clear < 0.5f ? clear : 0.5f;
    style.crease_width = is_cage ? 2.4f : 1.8f;
    style.line_width = 2.4f;
    style.caster = d->caster.face_count && !is_cage ? &d->caster : NULL;
    render_text(&d->picture, (float)left + WIDTH / 2, HEIGHT + 14, 13, label);
    return render_mesh(&d->picture, left, 0, WIDTH, HEIGHT, mesh, &d->view, &style);
}

static int draw_panels(drawing *d, const command *cmd, int beside)
{
    char label[80];
    int width = beside ? 2 * WIDTH : WIDTH, curve = cmd->given[CURVE] >= 0;
    const subdiv_mesh *cage = &d->coarse.mesh, *fine = &d->fine.mesh;
    const char *parts = curve ? "points" : "faces";
    int count = curve ? fine->vertex_count : fine->face_count;
    int ok = render_picture_new(&d->picture, width, HEIGHT + FOOT);
    render_view_fit(&d->view, beside ? cage : fine, 30, 22, WIDTH, HEIGHT);
    if (beside) {
        snprintf(label, sizeof label, "cage   %d %s",
                 curve ? cage->vertex_count : cage->face_count, parts);
        ok = ok && draw_panel(d, 0, cage, 1, label);
    }
    if (cmd->given[TESSELLATE] > 0)
        snprintf(label, sizeof label, "%d pieces an edge   %d faces", pieces_of(cmd), count);
    else snprintf(label, sizeof label, "level %d   %d %s", levels_of(cmd), count, parts);
    return ok && draw_panel(d, width - WIDTH, fine, 0, label);
}

int draw_picture(work *w, const command *cmd, const subdiv_options *opt)
{
    drawing d = {0};
    output out = {0};
    int beside = cmd->output != NULL, failed = 0;
    begin_step("picture");
    subdiv_result result = make_shapes(&d, w, pieces_of(cmd), beside, opt);
    if (!result && !draw_panels(&d, cmd, beside))
        result = set_error(opt, SUBDIV_ERROR_MEMORY, "out of memory");
    if (result) failed = report(cmd->input, opt);
    if (!failed) failed = open_output(&out, cmd->texts[PICTURE]);
    if (!failed) {
        errno = 0;
        if (!render_write_png(&d.picture, out.file)) result = set_write_error(opt);
        failed = close_output(&out, result, cmd->input, opt);
    }
    if (!failed) end_step(w->fine.vertex_count);
    render_picture_free(&d.picture);
    free_shape(&d.coarse);
    free_shape(&d.fine);
    subdiv_mesh_free(&d.cage);
    subdiv_mesh_free(&d.caster);
    free(d.face_materials);
    return failed;
}
