// --html: a page that shows the result and the levels before it in any browser, without a network.
// The page is in viewer.c and viewer_draw.c. Here are its meshes: numbers of four bytes, as base64.
#include "cli.h"

#include <stdlib.h>
#include <string.h>

enum { MEGABYTE = 1000000, MOST_MEGABYTES = 100 };

// ---------------------------------------------------------------------------------------- base64

typedef struct encoder {
    FILE    *file;
    int      failed;                  // to be written
    size_t   size;                    // bytes in all; the file holds none that are too many
    int      waiting;                 // bytes in group: 0 to 2
    unsigned group;
    size_t   used;
    char     text[1 << 14];
} encoder;

static void flush(encoder *e)
{
    e->size += e->used;
    if (!e->failed && e->size <= (size_t)MOST_MEGABYTES * MEGABYTE &&
        write_file(e->file, e->text, e->used) != e->used) e->failed = 1;
    e->used = 0;
}

static void put_text(encoder *e, const char *text)
{
    for (; *text; text++) {
        if (e->used == sizeof e->text) flush(e);
        e->text[e->used++] = *text;
    }
}

static void put_byte(encoder *e, unsigned byte)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    e->group = e->group << 8 | byte;
    if (++e->waiting < 3) return;
    if (e->used + 4 > sizeof e->text) flush(e);
    for (int shift = 18; shift >= 0; shift -= 6)
        e->text[e->used++] = digits[e->group >> shift & 63];
    e->waiting = 0;
    e->group = 0;
}

// Writes ints or floats, the lowest byte first.
static void put_words(encoder *e, const void *words, size_t count)
{
    unsigned word;
    for (size_t i = 0; i < count; i++) {
        memcpy(&word, (const char *)words + i * sizeof word, sizeof word);
        for (int shift = 0; shift < 32; shift += 8) put_byte(e, word >> shift & 255);
    }
}

static void end_words(encoder *e)
{
    size_t missing = e->waiting ? 3 - (size_t)e->waiting : 0;
    for (size_t i = 0; i < missing; i++) put_byte(e, 0);
    memset(e->text + e->used - missing, '=', missing);
}

static void put_array(encoder *e, const char *before, const void *words, size_t count)
{
    put_text(e, before);
    put_words(e, words, count);
    end_words(e);
    put_text(e, "\"");
}

static void put_number(encoder *e, const char *before, int number)
{
    char text[16];
    put_text(e, before);
    snprintf(text, sizeof text, "%d", number);
    put_text(e, text);
}

// ---------------------------------------------------------------------------------------- meshes

// Runs of faces: a material, and how many faces in a row have it.
static void put_materials(encoder *e, const subdiv_mesh *mesh, const materials *all)
{
    int pair[2] = {0, 0};
    put_text(e, ",\n\"materials\":\"");
    for (int f = 0; f < mesh->face_count; f++) {
        int material = all->of_faces[mesh->cage_faces ? mesh->cage_faces[f] : f];
        if (pair[1] && material != pair[0]) {
            put_words(e, pair, 2);
            pair[1] = 0;
        }
        pair[0] = material;
        pair[1]++;
    }
    put_words(e, pair, 2);
    end_words(e);
    put_text(e, "\"");
}

// Four lists: the creases that fade, the creases that never do, and the same of corners, each as an
// edge from its vertex to itself.
static void put_creases(encoder *e, const subdiv_mesh *mesh)
{
    put_text(e, ",\n\"creases\":[");
    for (int list = 0; list < 4; list++) {
        int corners = list >= 2, count = corners ? mesh->corner_count : mesh->crease_count;
        const int *vertices = corners ? mesh->corner_vertices : mesh->crease_vertices;
        const float *sharpness = corners ? mesh->corner_sharpness : mesh->crease_sharpness;
        put_text(e, list ? "\",\"" : "\"");
        for (int i = 0; i < count; i++) {
            int forever = sharpness[i] >= SUBDIV_INFINITE;
            if (sharpness[i] <= 0 || forever != list % 2) continue;
            put_words(e, vertices + (corners ? i : 2 * i), 1);
            put_words(e, vertices + (corners ? i : 2 * i + 1), 1);
        }
        end_words(e);
    }
    put_text(e, "\"]");
}

// The polylines, as edges.
static void put_polylines(encoder *e, const char *before, const subdiv_mesh *mesh)
{
    const int *v = mesh->line_vertices;
    put_text(e, before);
    for (int i = 0; i < mesh->line_count; v += mesh->line_sizes[i++])
        for (int k = 1; k < mesh->line_sizes[i]; k++) put_words(e, v + k - 1, 2);
    end_words(e);
    put_text(e, "\"");
}

static size_t count_corners(const subdiv_mesh *mesh)
{
    size_t count = (size_t)mesh->face_size * (size_t)mesh->face_count;
    for (int f = 0; f < mesh->face_count && !mesh->face_size; f++)
        count += (size_t)mesh->face_sizes[f];
    return count;
}

// Writes a mesh in which each edge of the cage has become so many.
static subdiv_result put_step(encoder *e, const subdiv_mesh *mesh, const char *label,
                              const work *w, const materials *all, int pieces,
                              const subdiv_options *opt)
{
    shape s = {0};
    subdiv_result result = make_shape(&s, mesh, NULL, &w->cage, w->surface, pieces, opt);
    size_t points = (size_t)mesh->vertex_count, corners = count_corners(mesh);
    if (!result) {
        int sides = s.mesh.face_normals != NULL;
        put_text(e, "{\"label\":\"");
        put_text(e, label);
        put_number(e, "\",\"pointCount\":", mesh->vertex_count);
        put_number(e, ",\"faceCount\":", mesh->face_count);
        put_array(e, ",\n\"points\":\"", mesh->positions, 3 * points);
        if (mesh->colors) put_array(e, ",\n\"colors\":\"", mesh->colors, 3 * points);
        put_array(e, ",\n\"normals\":\"", s.mesh.normals,
                  3 * (sides ? (size_t)s.mesh.normal_count : points));
        if (mesh->face_size) put_number(e, ",\n\"size\":", mesh->face_size);
        else put_array(e, ",\n\"sizes\":\"", mesh->face_sizes, (size_t)mesh->face_count);
        put_array(e, ",\n\"faces\":\"", mesh->face_vertices, corners);
        if (sides) put_array(e, ",\n\"sides\":\"", s.mesh.face_normals, corners);
        put_materials(e, mesh, all);
        put_creases(e, &s.mesh);
        put_number(e, ",\n\"lineCount\":", mesh->line_count);
        if (mesh->line_count) put_polylines(e, ",\n\"polylines\":\"", mesh);
        put_text(e, "}");
    }
    free_shape(&s);
    return result;
}

// Makes a level. at is all zeros; free_level frees it.
static subdiv_result make_level(work *at, const work *w, const command *cmd, int level,
                                const subdiv_options *opt)
{
    command less = *cmd;
    if (cmd->given[CURVE] < 0) return subdiv_refine(&at->fine, &w->cage, level, opt);
    less.given[LEVELS] = level;
    at->cage = w->cage;
    return refine_curves(at, &less, opt);
}

static void free_level(work *at)
{
    subdiv_mesh_free(&at->fine);
    free(at->points);
    free(at->colors);
    free(at->numbers);
}

// The steps of the slider: the levels up to the result; of a tessellation, level 0 and that.
static subdiv_result put_steps(encoder *e, const work *w, const command *cmd,
                               const materials *all, const subdiv_options *opt)
{
    int cut = cmd->given[TESSELLATE], levels = cut > 0 ? 1 : levels_of(cmd);
    int warnings = opt->error->warning_count;         // each level has those of the cage again
    subdiv_result result = SUBDIV_OK;
    char label[80];
    for (int level = 0; level < levels && !result && !e->failed; level++) {
        work at = {0};
        snprintf(label, sizeof label, "level %d", level);
        result = make_level(&at, w, cmd, level, opt);
        if (!result) result = put_step(e, &at.fine, label, w, all, 1 << level, opt);
        put_text(e, ",\n");
        free_level(&at);
    }
    snprintf(label, sizeof label, cut > 0 ? "%d pieces an edge" : "level %d",
             cut > 0 ? cut : levels);
    if (!result) result = put_step(e, &w->fine, label, w, all, pieces_of(cmd), opt);
    opt->error->warning_count = warnings;
    return result;
}

// The edges of the cage or, for curves, its polylines. They are drawn over each step.
static subdiv_result put_cage(encoder *e, const work *w, const subdiv_options *opt)
{
    size_t count = (size_t)subdiv_surface_edge_count(w->surface);
    int *ends = (int *)malloc((2 * count + 1) * sizeof *ends);
    if (ends == NULL) return set_error(opt, SUBDIV_ERROR_MEMORY, "out of memory");
    subdiv_surface_edges(w->surface, ends);
    put_array(e, "\"cage\":{\"points\":\"", w->cage.positions, 3 * (size_t)w->cage.vertex_count);
    if (w->surface) put_array(e, ",\n\"edges\":\"", ends, 2 * count);
    else put_polylines(e, ",\n\"edges\":\"", &w->cage);
    put_text(e, "},\n");
    free(ends);
    return SUBDIV_OK;
}

// ------------------------------------------------------------------------------------------ page

static void put_lines(encoder *e, const char *const *lines)
{
    for (; *lines; lines++) {
        put_text(e, *lines);
        put_text(e, "\n");
    }
}

// The name of the input, without .obj. What HTML would take for markup becomes a number, and so
// does each byte of a name that is not UTF-8.
static void put_title(encoder *e, const char *input)
{
    const char *name = strcmp(input, "-") == 0 ? "standard input" : file_name(input);
    size_t size = strlen(name);
    int utf8 = is_utf8(name);
    if (size > 4 && strcmp(name + size - 4, ".obj") == 0) size -= 4;
    for (size_t i = 0; i < size; i++) {
        unsigned c = (unsigned char)name[i];
        char text[2] = {name[i], 0};
        if (c < 32 || strchr("&<>\"'", name[i]) || (c > 126 && !utf8)) {
            put_number(e, "&#", (int)c);
            put_text(e, ";");
        } else put_text(e, text);
    }
}

static subdiv_result put_page(encoder *e, const work *w, const command *cmd,
                              const materials *all, const subdiv_options *opt)
{
    char color[64];
    put_text(e, "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>");
    put_title(e, cmd->input);
    put_text(e, "</title>\n");
    put_lines(e, viewer_page);
    put_number(e, "<script id=\"data\" type=\"application/json\">\n{\"limit\":", opt->limit);
    put_text(e, ",\"paints\":[");
    for (int i = 0; i < all->count; i++) {
        float rgb[3];
        material_color(i, rgb);
        snprintf(color, sizeof color, "%s[%.3f,%.3f,%.3f]", i ? "," : "", (double)rgb[0],
                 (double)rgb[1], (double)rgb[2]);
        put_text(e, color);
    }
    put_text(e, "],\n");
    subdiv_result result = put_cage(e, w, opt);
    put_text(e, "\"steps\":[");
    if (!result) result = put_steps(e, w, cmd, all, opt);
    put_text(e, "]}\n</script>\n<script>\n");
    put_lines(e, viewer_script);
    put_lines(e, viewer_draw);
    put_text(e, "</script>\n</html>\n");
    flush(e);
    return result;
}

// Refuses a page of so many bytes, exactly or at least.
static subdiv_result check_size(const command *cmd, double bytes, const char *exactly,
                                const subdiv_options *opt)
{
    char message[160];
    if (bytes <= (double)MOST_MEGABYTES * MEGABYTE) return SUBDIV_OK;
    snprintf(message, sizeof message, "the page would have %s%.0f MB, %d are allowed: %s", exactly,
             bytes / MEGABYTE, MOST_MEGABYTES,
             cmd->given[TESSELLATE] > 0 ? "take fewer pieces" : "take fewer levels");
    return set_error(opt, SUBDIV_ERROR_TOO_LARGE, message);
}

subdiv_result check_page(const command *cmd, double bytes, const subdiv_options *opt)
{
    return check_size(cmd, 4.0 / 3 * bytes, "at least ", opt);      // base64 takes a third more
}

static subdiv_result check_written(const encoder *e, const command *cmd, const subdiv_options *opt)
{
    return e->failed ? set_write_error(opt) : check_size(cmd, (double)e->size, "", opt);
}

int write_page(const work *w, const command *cmd, const subdiv_options *opt)
{
    encoder *e = (encoder *)calloc(1, sizeof *e);
    output out = {0};
    materials all = {0};
    int failed = 0;
    begin_step("page");
    subdiv_result result = find_materials(&all, &w->cage, opt);
    if (!result && e == NULL) result = set_error(opt, SUBDIV_ERROR_MEMORY, "out of memory");
    if (result) failed = report(cmd->input, opt);
    if (!failed) failed = open_output(&out, cmd->texts[HTML]);
    if (!failed) {
        e->file = out.file;
        result = put_page(e, w, cmd, &all, opt);
        if (!result) result = check_written(e, cmd, opt);
        failed = close_output(&out, result, cmd->input, opt);
    }
    if (!failed) end_step(w->fine.vertex_count);
    free(all.memory);
    free(e);
    return failed;
}
