// subdiv: the command line. Refines the cage in an OBJ file, or tells what the cage is made of.
//
//     parts="examples/subdiv_cli.c examples/cli/*.c examples/demo/render.c examples/demo/picture.c"
//     cc -O2 -I. $parts -o build/subdiv -lm -pthread
//     x86_64-w64-mingw32-gcc -O2 -I. $parts -o build/subdiv.exe
//
//     build/subdiv --levels 3 --time examples/cages/whale.obj build/whale.obj
//
//     load 0.108 ms 6.34 ns/vertex
//     prepare 2.705 ms 158.25 ns/vertex
//     refine 0.693 ms 40.52 ns/vertex
//     save 7.781 ms 455.17 ns/vertex

#define SUBDIV_IMPLEMENTATION
#include "cli/cli.h"

#include <ctype.h>
#include <limits.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

// ------------------------------------------------------------------------------ command line

// A list of names stands in the order of the library's enum, so that the place of a name in the
// list is the value of the enum.
typedef struct option {
    char        letter;               // 0: none
    const char *name;
    const char *values;               // NULL: a switch; "N": a whole number; "DEG", "S": a
                                      // number; other capitals: text; else names between bars
    const char *help;
} option;

static const option options[OPTION_COUNT] = {
    {'s', "scheme", "catmull-clark|loop|bilinear", "how to refine"},
    {'l', "levels", "N", "how often, 1 when not given; 0 copies"},
    {'b', "boundary", "edge|edge-and-corner|none", "what happens at the boundary"},
    {'c', "creasing", "uniform|chaikin", "how sharpness fades"},
    {'t', "triangles", "catmull-clark|smooth", "triangles of a Catmull-Clark cage"},
    {0, "vertex-rule", "standard|averaged|doo-sabin|warren|five-eighths",
     "how smooth vertices move; averaged and doo-sabin: Catmull-Clark, the last two: Loop"},
    {'u', "uv", "corners-only|corners-plus1|corners-plus2|boundaries|all|none",
     "what happens to UVs at seams and boundaries"},
    {'L', "limit", NULL, "put the points on the limit surface, with normals"},
    {0, "tessellate", "N", "instead of levels: cut every edge into N pieces, on the limit surface"},
    {0, "curve", "b-spline|chaikin",
     "refine the polylines of the file instead, those whose last vertex is the first as closed"},
    {'j', "threads", "N", "how many threads refine, 1 when not given; the result is the same"},
    {0, "crease-angle", "DEG", "make edges sharp where faces meet at more than DEG degrees"},
    {0, "crease-smoothing-groups", NULL, "make the borders of smoothing groups sharp"},
    {0, "crease-seams", NULL, "make UV seams sharp"},
    {0, "crease-sharpness", "S", "of these three: for S levels, forever when not given"},
    {0, "eval", "SAMPLES",
     "print the limit surface instead, px py pz ux uy uz vx vy vz (point and derivatives), at\n"
     "          each line 'face u v' or 'face/corner u v' of SAMPLES, counted from 0; # starts a\n"
     "          comment. From a face's first vertex u goes to the second one, v to the last; a\n"
     "          corner of a polygon stands for the quad there"},
    {'o', "folder", "FOLDER", "save each of any number of INPUTs as FOLDER/name.obj"},
    {0, "picture", "FILE.png",
     "draw the result; if OUTPUT is named, too, the cage beside it. Creases are orange,\n"
     "          those that never fade red"},
    {0, "html", "FILE.html",
     "save a page on which the result and each level before it can be turned in a browser"},
    {0, "stream", NULL,
     "refine and save piece by piece, in little memory; large results are always saved so"},
    {0, "part", "K/N",
     "save only part K of N of the OBJ file, from 1, as with --stream. The N parts, joined in\n"
     "          order (cat), are the whole file: N processes share the work"},
    {0, "no-tags", NULL, "save no tags for creases, corners, holes and rules"},
    {0, "no-uvs", NULL, "read no UVs, for instance because they are broken"},
    {0, "merge-materials", NULL,
     "bring faces of the same material (usemtl) together, in the order of the materials"},
    {0, "triangulate", NULL, "Loop: cut larger faces into triangles first"},
    {0, "keep-holes", NULL, "keep the faces of holes, tagged as holes"},
    {0, "info", NULL, "print what the cage is made of, and what is odd about it"},
    {0, "explain", "N|all",
     "print the rule and the mask of point N of the cage refined once; all: a line of data for\n"
     "          each point"},
    {0, "time", NULL, "print how long each step takes, when it ends"},
    {'h', "help", NULL, "print this"},
    {0, "version", NULL, "print the version"},
};

// Says what is wrong with the command line.
static int misused(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs("subdiv: ", stderr);
    vfprintf(stderr, format, arguments);
    fputs(", try subdiv --help\n", stderr);
    va_end(arguments);
    return MISUSED;
}

// The place of a text among names between bars, or -1.
static int find_name(const char *names, const char *text)
{
    size_t length = strlen(text);
    for (int place = 0; ; place++) {
        size_t n = strcspn(names, "|");
        if (n == length && memcmp(names, text, n) == 0) return place;
        if (names[n] == 0) return -1;
        names += n + 1;
    }
}

// A whole number from 0 to INT_MAX, or -1.
int read_number(const char *text)
{
    int value = 0;
    if (*text == 0) return -1;
    for (; *text; text++) {
        int digit = *text - '0';
        if (digit < 0 || digit > 9 || value > (INT_MAX - digit) / 10) return -1;
        value = 10 * value + digit;
    }
    return value;
}

// Stores a number from 0 to 180 degrees, or a sharpness above 0: from 10 on all are forever.
static int set_number(command *cmd, int id, const char *text)
{
    char *end;
    double x = strtod(text, &end);
    int is_number = end != text && *end == 0 && strspn(text, "+-.0123456789eE") == strlen(text);
    if (id == CREASE_ANGLE && !(is_number && x >= 0 && x <= 180))
        return misused("--%s needs a number from 0 to 180, not '%s'", options[id].name, text);
    if (id == CREASE_SHARPNESS && !(is_number && x > 0))
        return misused("--%s needs a number above 0, not '%s'", options[id].name, text);
    if (id == CREASE_SHARPNESS && x > (double)SUBDIV_INFINITE) x = (double)SUBDIV_INFINITE;
    cmd->numbers[id] = (float)x;
    cmd->given[id] = 1;
    return DONE;
}

// Stores K and N of K/N, and that the part is streamed.
static int set_part(command *cmd, const char *text)
{
    char first[16] = "";
    const char *slash = strchr(text, '/');
    if (slash && (size_t)(slash - text) < sizeof first)
        memcpy(first, text, (size_t)(slash - text));
    int part = read_number(first), count = slash ? read_number(slash + 1) : -1;
    if (part < 1 || part > count)
        return misused("--part needs K/N, part K from 1 to N, not '%s'", text);
    cmd->given[PART] = part;
    cmd->part_count = count;
    cmd->given[STREAM] = 1;
    return DONE;
}

// Stores the value of an option. value is NULL when the command line holds none.
static int set_option(command *cmd, int id, const char *value)
{
    const option *o = &options[id];
    if (o->values == NULL) {
        if (value) return misused("--%s takes no value", o->name);
        cmd->given[id] = 1;
        return DONE;
    }
    if (value == NULL) return misused("--%s needs a value", o->name);
    if (id == CREASE_ANGLE || id == CREASE_SHARPNESS) return set_number(cmd, id, value);
    if (id == PART) return set_part(cmd, value);
    if (id == EVAL || id == FOLDER || id == PICTURE || id == HTML) {
        cmd->texts[id] = value;
        cmd->given[id] = 1;
        return DONE;
    }
    if (id == EXPLAIN && strcmp(value, "all") == 0) {
        cmd->given[id] = EXPLAIN_ALL;
        return DONE;
    }
    int number = o->values[0] == 'N';
    int read = number ? read_number(value) : find_name(o->values, value);
    int least = id == THREADS || id == TESSELLATE;
    if (number && read < least)
        return misused("--%s needs a whole number from %d up, not '%s'", o->name, least, value);
    if (read < 0) return misused("--%s is one of %s, not '%s'", o->name, o->values, value);
    cmd->given[id] = read;
    return DONE;
}

// Reads --name, --name=value, --name value, -n, -nvalue and -n value at argument *i.
static int read_option(command *cmd, int argc, char **argv, int *i)
{
    const char *text = argv[*i], *value = NULL;
    int is_long = text[1] == '-', id = 0;
    size_t length = is_long ? strcspn(text + 2, "=") : 1;
    for (; id < OPTION_COUNT; id++) {
        const option *o = &options[id];
        if (is_long && strlen(o->name) == length && memcmp(o->name, text + 2, length) == 0) break;
        if (!is_long && o->letter && o->letter == text[1]) break;
    }
    if (id == OPTION_COUNT) return misused("there is no option %s", text);
    if (is_long && text[2 + length] == '=') value = text + 2 + length + 1;
    if (!is_long && text[2]) value = text + 2;
    if (value == NULL && options[id].values && *i + 1 < argc) value = argv[++*i];
    return set_option(cmd, id, value);
}

// Whether a path ends so, in small letters or capitals.
static int ends_with(const char *path, const char *end)
{
    size_t length = strlen(path), size = strlen(end);
    if (length < size) return 0;
    for (size_t i = 0; i < size; i++)
        if (tolower((unsigned char)path[length - size + i]) != end[i]) return 0;
    return 1;
}

// Tells the format by the extension; a name without one, such as - or /dev/null, is OBJ.
static int find_format(const char *path)
{
    const char *name = path ? file_name(path) : "";
    const char *dot = strrchr(name, '.');
    if (ends_with(name, ".ply")) return PLY;
    if (ends_with(name, ".stl")) return STL;
    if (ends_with(name, ".glb")) return GLB;
    return dot == NULL || dot == name || ends_with(name, ".obj") ? OBJ : UNKNOWN;
}

// Whether the command shows the result, on a picture or a page.
static int shows_result(const command *cmd)
{
    return cmd->given[PICTURE] == 1 || cmd->given[HTML] == 1;
}

// The option by which the command streams.
static const char *stream_option(const command *cmd)
{
    return cmd->given[PART] > 0 ? "--part" : "--stream";
}

// Refuses options that do not go together.
static int check_options(const command *cmd)
{
    const int *given = cmd->given;
    int streams = given[STREAM] == 1, prints = given[EXPLAIN] >= 0, shows = shows_result(cmd);
    const char *stream = stream_option(cmd);
    if (given[TESSELLATE] > 0 && (given[LEVELS] >= 0 || streams))
        return misused("--tessellate goes without --levels and %s", stream);
    if (given[CURVE] >= 0 && (given[TESSELLATE] > 0 || streams || prints || given[EVAL] == 1))
        return misused("--curve is not for surfaces: no --tessellate, %s, --explain, --eval",
                       stream);
    if (shows && (streams || prints))
        return misused("--picture and --html show the whole result: no %s, --explain", stream);
    if (given[PART] > 0 && (prints || given[INFO] == 1 || given[FOLDER] == 1))
        return misused("--part saves one file: no --explain, --info or -o beside it");
    if (given[CREASE_SHARPNESS] == 1 && given[CREASE_ANGLE] < 0 && given[CREASE_GROUPS] < 0 &&
        given[CREASE_SEAMS] < 0)
        return misused("--crease-sharpness needs one of the other crease options");
    if (given[PICTURE] == 1 && !ends_with(cmd->texts[PICTURE], ".png"))
        return misused("--picture needs a name that ends in .png, not '%s'", cmd->texts[PICTURE]);
    if (given[HTML] == 1 && !ends_with(cmd->texts[HTML], ".html"))
        return misused("--html needs a name that ends in .html, not '%s'", cmd->texts[HTML]);
    return DONE;
}

// Refuses files that do not go with the options.
static int check_files(const command *cmd)
{
    const int *given = cmd->given;
    const char *output = cmd->output;
    int folder = given[FOLDER] == 1, shows = shows_result(cmd);
    if (cmd->file_count == 0) return misused("no INPUT.obj is named");
    if (cmd->file_count > 2 && !folder)
        return misused("%s is one file too many; -o FOLDER takes any number", cmd->files[2]);
    if (folder && find_format(cmd->texts[FOLDER]) != OBJ)
        return misused("-o names a folder, not '%s': OUTPUT comes after INPUT",
                       cmd->texts[FOLDER]);
    if (folder && (shows || given[EVAL] == 1 || given[INFO] == 1 ||
                   given[EXPLAIN] >= 0))
        return misused("-o FOLDER saves results and no more: no --info, --picture or the like");
    if (given[EVAL] == 1 && (output || shows || given[INFO] == 1 || given[LEVELS] >= 0 ||
                             given[LIMIT] == 1 || given[STREAM] == 1 || given[TESSELLATE] > 0))
        return misused("--eval prints: no OUTPUT, --info, --levels, --limit, --tessellate or %s "
                       "beside it", stream_option(cmd));
    if (given[EVAL] == 1 && strcmp(cmd->texts[EVAL], "-") == 0 && strcmp(cmd->input, "-") == 0)
        return misused("--eval - and INPUT - would share standard input");
    if (given[INFO] == 1 && output && strcmp(output, "-") == 0)
        return misused("--info and OUTPUT - would share standard output");
    if (given[EXPLAIN] >= 0 && output)
        return misused("--explain writes to standard output alone");
    if (!folder && find_format(output) == UNKNOWN)
        return misused("%s: the formats are .obj, .ply, .stl and .glb", output);
    if (find_format(output) != OBJ && (given[STREAM] == 1 || given[CURVE] >= 0))
        return misused("%s: %s and --curve write .obj alone", output, stream_option(cmd));
    if (output && given[PART] > 0 && is_same_file(output, cmd->input))
        return misused("a part would replace its cage, %s", output);
    if (given[HTML] == 1 && is_same_file(cmd->texts[HTML], cmd->input))
        return misused("the page would replace its cage, %s", cmd->input);
    if (given[HTML] == 1 && output && strcmp(cmd->texts[HTML], output) == 0)
        return misused("the page and OUTPUT would be the same file, %s", output);
    return DONE;
}

// Refuses inputs that would become the same file in the folder, or are in it.
static int check_names(const command *cmd)
{
    const char *folder = cmd->texts[FOLDER];
    char path[4096];
    for (int i = 0; i < cmd->file_count; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, file_name(cmd->files[i]));
        if (is_same_file(path, cmd->files[i]))
            return misused("a result would replace its cage, %s", path);
        for (int j = 0; j < i; j++)
            if (strcmp(file_name(cmd->files[i]), file_name(cmd->files[j])) == 0)
                return misused("%s and %s would be the same file in %s", cmd->files[j],
                               cmd->files[i], folder);
    }
    return DONE;
}

static int read_command(command *cmd, int argc, char **argv)
{
    int only_files = 0;
    for (int id = 0; id < OPTION_COUNT; id++) cmd->given[id] = -1;
    cmd->files = argv + 1;            // files take the places of the arguments that have been read
    for (int i = 1; i < argc; i++) {
        char *text = argv[i];
        if (!only_files && strcmp(text, "--") == 0) {
            only_files = 1;
        } else if (!only_files && text[0] == '-' && text[1]) {
            int result = read_option(cmd, argc, argv, &i);
            if (result) return result;
        } else {
            cmd->files[cmd->file_count++] = text;
        }
    }
    if (cmd->given[HELP] == 1 || cmd->given[VERSION] == 1) return DONE;
    if (cmd->file_count > 0) cmd->input = cmd->files[0];
    if (cmd->file_count > 1 && cmd->given[FOLDER] < 0) cmd->output = cmd->files[1];
    int result = check_options(cmd);
    if (result == DONE) result = check_files(cmd);
    return result || cmd->given[FOLDER] < 0 ? result : check_names(cmd);
}

// ------------------------------------------------------------------------------------- output

static int print_help(void)
{
    puts("usage: subdiv [options] INPUT.obj [OUTPUT]\n"
         "       subdiv [options] -o FOLDER INPUT.obj...\n"
         "Refines a cage by subdivision. INPUT - is standard input. OUTPUT is a .obj, .ply, .stl\n"
         "or .glb; without it, or with OUTPUT -, OBJ goes to standard output, unless --picture\n"
         "or --html shows the result. Options win over the file's own tags.\n");
    for (int id = 0; id < OPTION_COUNT; id++) {
        const option *o = &options[id];
        char letter[] = "-?, ";
        letter[1] = o->letter;
        printf("  %s--%s%s%s\n          %s\n", o->letter ? letter : "    ", o->name,
               o->values ? " " : "", o->values ? o->values : "", o->help);
    }
    puts("\nexamples:\n"
         "  subdiv -l 3 cage.obj fine.obj                     three levels of Catmull-Clark\n"
         "  subdiv -L -l 4 --picture look.png cage.obj        a picture of the limit surface\n"
         "  subdiv -s loop --triangulate cage.obj fine.glb    Loop subdivision, for a game engine");
    return flush_output();
}

static int print_version(void)
{
    printf("subdiv %d.%d\n", SUBDIV_VERSION / 100, SUBDIV_VERSION % 100);
    return flush_output();
}

// ---------------------------------------------------------------------------------------- run

// Names the file, where the message does not: of standard input, and once the cage is read.
static void print_message(const char *kind, const char *file, const char *message)
{
    int named = strncmp(message, file, strlen(file)) == 0;
    end_progress();
    fprintf(stderr, "subdiv: %s%s%s%s", kind, named ? "" : file, named ? "" : ": ", message);
}

int report(const char *file, const subdiv_options *opt)
{
    int quads = opt->error->code == SUBDIV_ERROR_NOT_TRIANGLE;
    print_message("", file, opt->error->message);
    fputs(quads ? "; --triangulate cuts larger faces\n" : "\n", stderr);
    return FAILED;
}

// Adds the creases that the options ask for.
static int add_creases(subdiv_mesh *cage, const command *cmd, const subdiv_options *opt)
{
    const int *given = cmd->given;
    float degrees = cmd->numbers[CREASE_ANGLE], sharpness = cmd->numbers[CREASE_SHARPNESS];
    if (given[CREASE_SHARPNESS] < 0) sharpness = SUBDIV_INFINITE;
    if ((given[CREASE_ANGLE] == 1 && subdiv_crease_by_angle(cage, degrees, sharpness, opt)) ||
        (given[CREASE_GROUPS] == 1 && subdiv_crease_by_smoothing_groups(cage, sharpness, opt)) ||
        (given[CREASE_SEAMS] == 1 && subdiv_crease_by_uv_seams(cage, sharpness, opt)))
        return report(cmd->input, opt);
    return DONE;
}

// Prints the explanation of a point, however long it is.
static int explain(const subdiv_mesh *cage, const command *cmd, const subdiv_options *opt)
{
    subdiv_result result = SUBDIV_ERROR_TOO_LARGE;
    for (size_t size = 4096; result == SUBDIV_ERROR_TOO_LARGE && size < LARGE; size *= 2) {
        char *text = (char *)malloc(size);
        if (text == NULL) {
            fputs("subdiv: out of memory\n", stderr);
            return FAILED;
        }
        result = subdiv_explain(text, size, cage, cmd->given[EXPLAIN], opt);
        fputs(text, stdout);
        free(text);
    }
    return result ? report(cmd->input, opt) : flush_output();
}

int levels_of(const command *cmd)
{
    return cmd->given[LEVELS] >= 0 ? cmd->given[LEVELS] : 1;
}

int pieces_of(const command *cmd)
{
    return cmd->given[TESSELLATE] > 0 ? cmd->given[TESSELLATE] : 1 << levels_of(cmd);
}

static int save(work *w, const command *cmd, const subdiv_options *opt)
{
    output out = {0};
    begin_step("save");
    if (open_output(&out, cmd->output)) return FAILED;
    subdiv_result result = save_mesh(&w->fine, find_format(cmd->output), out.file, opt);
    if (close_output(&out, result, cmd->input, opt)) return FAILED;
    end_step(w->fine.vertex_count);
    return DONE;
}

// Frees the cage and what was prepared as soon as they are no longer needed.
static int refine_then_save(work *w, const command *cmd, const subdiv_options *opt)
{
    subdiv_tessellation how = {0};
    int shows = shows_result(cmd);
    how.rate = cmd->given[TESSELLATE];
    begin_step("refine");
    subdiv_result result = cmd->given[CURVE] >= 0 ? refine_curves(w, cmd, opt) : how.rate > 0
        ? subdiv_surface_tessellate(&w->fine, w->surface, w->cage.positions, &how, opt)
        : subdiv_surface_mesh(&w->fine, w->surface, w->cage.positions, opt);
    if (result) return report(cmd->input, opt);
    end_step(w->fine.vertex_count);
    if (shows && w->fine.face_count == 0 && w->fine.line_count == 0) {
        set_error(opt, SUBDIV_ERROR_EMPTY, w->cage.line_count ? "there are no faces to show; "
                  "--curve refines polylines" : "there are no faces to show");
        return report(cmd->input, opt);
    }
    if (cmd->given[PICTURE] == 1 && draw_picture(w, cmd, opt)) return FAILED;
    if (cmd->given[HTML] == 1 && write_page(w, cmd, opt)) return FAILED;
    subdiv_surface_free(w->surface);
    w->surface = NULL;
    subdiv_mesh_free(&w->cage);
    return shows && cmd->output == NULL ? DONE : save(w, cmd, opt);
}

// Refines and saves piece by piece.
static int stream(work *w, const command *cmd, const subdiv_options *opt)
{
    output out = {0};
    begin_step("refine+save");
    if (open_output(&out, cmd->output)) return FAILED;
    subdiv_result result = subdiv_stream_obj_callback(w->surface, w->cage.positions, write_file,
                                                      out.file, opt);
    if (close_output(&out, result, cmd->input, opt)) return FAILED;
    end_step(subdiv_surface_vertex_count(w->surface));
    return DONE;
}

// Prepares a surface, refines and saves.
static int refine(work *w, const command *cmd, const subdiv_options *opt)
{
    int levels = levels_of(cmd);
    int is_mesh = find_format(cmd->output) != OBJ || shows_result(cmd);
    if (cmd->given[TESSELLATE] > 0) levels = SUBDIV_EXACT;
    if (w->cage.line_count > 0 && levels != 0 && opt->error->warning_count++ == 0)
        snprintf(opt->error->warning, sizeof opt->error->warning,
                 "%d polylines are left out: --curve refines them", w->cage.line_count);
    begin_step("prepare");
    if (subdiv_prepare(&w->surface, &w->cage, levels, opt)) return report(cmd->input, opt);
    int vertex_count = subdiv_surface_vertex_count(w->surface);
    end_step(levels == SUBDIV_EXACT ? w->cage.vertex_count : vertex_count);
    // A point and its normal take 24 bytes of a page, a corner of a face 4.
    double corners = (double)subdiv_surface_face_count(w->surface) *
                     (w->cage.scheme == SUBDIV_LOOP ? 3 : 4);
    if (cmd->given[HTML] == 1 && levels != SUBDIV_EXACT &&
        check_page(cmd, 24.0 * vertex_count + 4 * corners, opt)) return report(cmd->input, opt);
    if (cmd->given[STREAM] == 1 || (vertex_count > LARGE && !is_mesh))
        return stream(w, cmd, opt);
    return refine_then_save(w, cmd, opt);
}

// Loads one cage and does what the command says.
static int run(work *w, const command *cmd, const subdiv_options *opt)
{
    int info = cmd->given[INFO] == 1;
    int shows = shows_result(cmd);
    begin_step("load");
    if (load(w, cmd, opt)) return report(cmd->input, opt);
    if (add_creases(&w->cage, cmd, opt)) return FAILED;
    end_step(w->cage.vertex_count);
    if (cmd->given[EXPLAIN] == EXPLAIN_ALL) return explain_all(&w->cage, cmd, opt);
    if (cmd->given[EXPLAIN] >= 0) return explain(&w->cage, cmd, opt);
    if (info && inspect(&w->cage, cmd, opt)) return FAILED;
    if (info && cmd->output == NULL && !shows) return DONE;
    if (cmd->given[EVAL] == 1) return run_samples(w, cmd, opt);
    return cmd->given[CURVE] >= 0 ? refine_then_save(w, cmd, opt) : refine(w, cmd, opt);
}

static void print_warnings(const command *cmd, const subdiv_error *error)
{
    if (error->warning_count == 0) return;
    print_message("warning: ", cmd->input, error->warning);
    if (error->warning_count > 1) fprintf(stderr, " (and %d more)", error->warning_count - 1);
    fputc('\n', stderr);
}

// Runs the command for one input, and frees everything.
static int run_input(const command *cmd, subdiv_options opt)
{
    work w = {0};
    subdiv_error error = {0};
    opt.error = &error;
    int result = run(&w, cmd, &opt);
    subdiv_mesh_free(&w.fine);
    free(w.points);
    free(w.colors);
    free(w.numbers);
    subdiv_surface_free(w.surface);
    subdiv_mesh_free(&w.cage);
    free(w.merged);
    if (result == DONE) print_warnings(cmd, &error);
    return result;
}

// -o: runs the command for each input. One that fails does not keep the others.
static int run_folder(command *cmd, const subdiv_options *opt)
{
    char path[4096];
    int result = DONE;
    if (make_folder(cmd->texts[FOLDER])) return FAILED;
    for (int i = 0; i < cmd->file_count; i++) {
        const char *folder = cmd->texts[FOLDER], *name = file_name(cmd->files[i]);
        if ((size_t)snprintf(path, sizeof path, "%s/%s", folder, name) >= sizeof path)
            return misused("%s/%s is too long a name", folder, name);
        cmd->input = cmd->files[i];
        cmd->output = path;
        if (run_input(cmd, *opt)) result = FAILED;
    }
    return result;
}

int main(int argc, char **argv)
{
    command cmd = {0};
    int result = read_command(&cmd, argc, argv);
    if (result) return result;
    catch_signals();
    if (cmd.given[HELP] == 1) return print_help();
    if (cmd.given[VERSION] == 1) return print_version();
    show_steps(cmd.given[TIME] == 1);

    subdiv_options opt = {0};
    opt.triangulate = cmd.given[TRIANGULATE] == 1;
    opt.keep_holes = cmd.given[KEEP_HOLES] == 1;
    opt.limit = cmd.given[LIMIT] == 1;
    opt.no_tags = cmd.given[NO_TAGS] == 1;
    if (cmd.given[PART] > 0) opt.part = cmd.given[PART] - 1, opt.part_count = cmd.part_count;
    start_threads(cmd.given[THREADS], &opt);
    result = cmd.given[FOLDER] == 1 ? run_folder(&cmd, &opt) : run_input(&cmd, opt);
    end_threads();
    return result;
}
