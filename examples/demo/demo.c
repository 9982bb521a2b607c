// The main job, shown: loads each cage, refines it, saves the result as OBJ, and draws the cage and
// its levels 1, 2 and 4 side by side.
//
//     cd examples/demo && cc -O2 -I../.. demo.c render.c picture.c -o ../../build/demo -lm
//     build/demo CAGES OUTPUT         the directory of the cages, and where the results go
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

#include "render.h"

#include <stdio.h>
#include <string.h>

enum { PANEL_WIDTH = 304, PANEL_HEIGHT = 270, ROW_HEIGHT = PANEL_HEIGHT + 34, MAX_FACES = 4096 };
enum { LEVELS = 5, SHOWN = 4, SAVED_LEVEL = 2, HERO_ROWS = 2 };

static const render_material materials[] = {
    {"white",   0.97f, 0.96f, 0.94f, 0.30f}, {"black",   0.13f, 0.13f, 0.16f, 0.80f},
    {"coral",   0.93f, 0.40f, 0.30f, 0.10f}, {"cream",   1.00f, 0.80f, 0.66f, 0.05f},
    {"chrome",  0.81f, 0.81f, 0.80f, 0.35f}, {"leather", 0.16f, 0.50f, 0.50f, 0.06f},
    {"glass",   0.10f, 0.14f, 0.34f, 1.20f}, {"red",     0.90f, 0.26f, 0.20f, 0.30f},
    {"rose",    0.90f, 0.42f, 0.60f, 0.06f}, {"petal",   0.95f, 0.58f, 0.72f, 0.06f},
    {"blush",   1.00f, 0.76f, 0.82f, 0.06f}, {"leaf",    0.36f, 0.62f, 0.40f, 0.10f},
    {"yellow",  0.98f, 0.78f, 0.28f, 0.10f}, {"blue",    0.26f, 0.48f, 0.76f, 0.15f},
    {"belly",   0.88f, 0.93f, 0.96f, 0.10f}, {"sucker",  0.80f, 0.32f, 0.32f, 0.10f}
};

typedef struct exhibit {
    const char   *name;
    subdiv_scheme scheme;             // OBJ has no tag for it
    float         yaw, pitch, lift;
} exhibit;

static const exhibit exhibits[] = {   // the first ones go into the hero picture
    {"octopus", SUBDIV_CATMULL_CLARK, 16, 20, 0},
    {"camera",  SUBDIV_CATMULL_CLARK, 30, 22, 0},
    {"lotus",   SUBDIV_CATMULL_CLARK, 15, 34, 0},
    {"whale",   SUBDIV_LOOP,          56, 12, 0.35f}
};

// The library passes over the usemtl lines of OBJ, so they are read here: a material for each face
// of the cage. The faces of a result know the face of the cage that they come from.
static int read_materials(unsigned char *face_materials, const char *path)
{
    char line[256], name[64];
    int face = 0, current = 0;
    FILE *file = fopen(path, "r");
    if (!file) return 0;
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "usemtl %63s", name) == 1) {
            for (int i = 0; i < (int)(sizeof materials / sizeof *materials); i++) {
                if (!strcmp(materials[i].name, name)) current = i;
            }
        } else if (line[0] == 'f' && face < MAX_FACES) {
            face_materials[face++] = (unsigned char)current;
        }
    }
    fclose(file);
    return face;
}

static int draw_panel(render_picture *picture, int column, const subdiv_mesh *mesh, int level,
                      const render_view *view, render_style style)
{
    static const float edge_width[LEVELS]   = {1.2f, 0.9f, 0.7f, 0, 0};
    static const float edge_opacity[LEVELS] = {0.75f, 0.40f, 0.24f, 0, 0};
    static const float crease_width[LEVELS] = {2.2f, 1.6f, 1.1f, 0.7f, 0.7f};
    char label[64];
    const char *faces = mesh->scheme == SUBDIV_LOOP ? "triangles" : "quads";
    int left = column * PANEL_WIDTH;
    if (level) snprintf(label, sizeof label, "level %d   %d %s", level, mesh->face_count, faces);
    else snprintf(label, sizeof label, "cage   %d %s", mesh->face_count, faces);
    render_text(picture, (float)left + PANEL_WIDTH / 2, PANEL_HEIGHT + 12, 10, label);
    style.flat = level == 0;
    style.edge_width = edge_width[level];
    style.edge_opacity = edge_opacity[level];
    style.crease_width = crease_width[level];
    return render_mesh(picture, left, 0, PANEL_WIDTH, PANEL_HEIGHT, mesh, view, &style);
}

static int draw(render_picture *picture, const exhibit *e, const subdiv_mesh *mesh,
                const unsigned char *face_materials)
{
    static const int levels[SHOWN] = {0, 1, 2, 4};
    render_style style = {materials, face_materials, 0, 0, 0, 0, e->lift, NULL, 0};
    render_view view;
    int ok = render_picture_new(picture, SHOWN * PANEL_WIDTH, ROW_HEIGHT);
    render_view_fit(&view, mesh, e->yaw, e->pitch, PANEL_WIDTH, PANEL_HEIGHT);
    for (int i = 0; i < SHOWN && ok; i++) {
        int level = levels[i];
        style.caster = level == 4 ? mesh + 3 : NULL;   // level 3 casts the same shadow, faster
        ok = draw_panel(picture, i, mesh + level, level, &view, style);
    }
    return ok;
}

// Loads, refines, saves and draws one cage. Returns 0 on failure.
static int show(render_picture *picture, const exhibit *e, const char *cages, const char *output)
{
    static unsigned char face_materials[MAX_FACES];
    char in[512], obj[512], png[512];
    subdiv_mesh cage = {0}, mesh[LEVELS] = {{0}};
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    snprintf(in, sizeof in, "%s/%s.obj", cages, e->name);
    snprintf(obj, sizeof obj, "%s/%s_level%d.obj", output, e->name, SAVED_LEVEL);
    snprintf(png, sizeof png, "%s/%s.png", output, e->name);
    subdiv_result failed = subdiv_load_obj(&cage, in, &opt);
    cage.scheme = e->scheme;
    for (int i = 0; i < LEVELS && !failed; i++) failed = subdiv_refine(mesh + i, &cage, i, &opt);
    if (!failed) failed = subdiv_save_obj(mesh + SAVED_LEVEL, obj, &opt);
    if (failed) printf("%s\n", error.message);
    else printf("%s\n", obj);
    int ok = !failed && read_materials(face_materials, in) == cage.face_count &&
             draw(picture, e, mesh, face_materials) && render_save_png(picture, png);
    if (ok) printf("%s\n", png);
    else if (!failed) printf("%s: cannot be drawn\n", png);
    for (int i = 0; i < LEVELS; i++) subdiv_mesh_free(mesh + i);
    subdiv_mesh_free(&cage);
    return ok;
}

int main(int argc, char **argv)
{
    char path[512];
    render_picture hero = {0};
    if (argc != 3) { printf("usage: %s CAGES OUTPUT\n", argv[0]); return 1; }
    int ok = render_picture_new(&hero, SHOWN * PANEL_WIDTH, HERO_ROWS * ROW_HEIGHT);
    for (int i = 0; i < (int)(sizeof exhibits / sizeof *exhibits) && ok; i++) {
        render_picture picture = {0};
        size_t size = (size_t)SHOWN * PANEL_WIDTH * ROW_HEIGHT * 3;
        ok = show(&picture, exhibits + i, argv[1], argv[2]);
        if (ok && i < HERO_ROWS) {
            memcpy(hero.rgb + (size_t)i * size, picture.rgb, size * sizeof(float));
        }
        render_picture_free(&picture);
    }
    snprintf(path, sizeof path, "%s/hero.png", argv[2]);
    ok = ok && render_save_png(&hero, path);
    printf(ok ? "%s\n" : "%s: not written\n", path);
    render_picture_free(&hero);
    return !ok;
}
