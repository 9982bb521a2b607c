// subdiv: refines the cage in an OBJ file, or tells what it is made of.
//
//     cc -O2 -I. examples/subdiv_cli.c -o build/subdiv -lm
//     build/subdiv --levels 3 --time examples/cages/whale.obj build/whale.obj
//
//     load 0.139 ms 8.15 ns/vertex
//     prepare 2.936 ms 171.77 ns/vertex
//     refine 1.218 ms 71.24 ns/vertex
//     save 8.541 ms 499.68 ns/vertex

#define _POSIX_C_SOURCE 200809L       // clock_gettime, where the system has it

#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

enum { DONE = 0, FAILED = 1, MISUSED = 2 };   // what the program returns

// ------------------------------------------------------------------------------ command line

enum {
    SCHEME, LEVELS, BOUNDARY, CREASING, TRIANGLES, UV, LIMIT, THREADS,
    TRIANGULATE, INFO, TIME, HELP, VERSION, OPTION_COUNT
};

// A list of names stands in the order of the library's enum, so that the place of a name in the
// list is the value of the enum.
typedef struct option {
    char        letter;               // 0: none
    const char *name;
    const char *values;               // NULL: a switch; "N": a number; else names between bars
    const char *help;
} option;

static const option options[OPTION_COUNT] = {
    {'s', "scheme", "catmull-clark|loop|bilinear", "how to refine"},
    {'l', "levels", "N", "how often, 1 when not given; 0 copies"},
    {'b', "boundary", "edge|edge-and-corner|none", "what happens at the boundary"},
    {'c', "creasing", "uniform|chaikin", "how sharpness fades"},
    {'t', "triangles", "catmull-clark|smooth", "triangles of a Catmull-Clark cage"},
    {'u', "uv", "corners-only|corners-plus1|corners-plus2|boundaries|all|none",
     "not in this release"},
    {'L', "limit", NULL, "not in this release"},
    {'j', "threads", "N", "not in this release"},
    {0, "triangulate", NULL, "Loop: cut larger faces into triangles first"},
    {0, "info", NULL, "print what the cage is made of"},
    {0, "time", NULL, "print how long each step takes"},
    {'h', "help", NULL, "print this"},
    {0, "version", NULL, "print the version"},
};

typedef struct command {
    int         given[OPTION_COUNT];  // the value of each option; -1: not given
    const char *input, *output;       // NULL: not given
} command;

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
static int read_number(const char *text)
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
    int number = strcmp(o->values, "N") == 0;
    int read = number ? read_number(value) : find_name(o->values, value);
    if (number && (read < 0 || (id == THREADS && read < 1)))
        return misused("--%s needs a whole number, not '%s'", o->name, value);
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

static int read_command(command *cmd, int argc, char **argv)
{
    int only_files = 0;
    for (int id = 0; id < OPTION_COUNT; id++) cmd->given[id] = -1;
    for (int i = 1; i < argc; i++) {
        const char *text = argv[i];
        if (!only_files && strcmp(text, "--") == 0) {
            only_files = 1;
        } else if (!only_files && text[0] == '-' && text[1]) {
            int result = read_option(cmd, argc, argv, &i);
            if (result) return result;
        } else if (cmd->input == NULL) {
            cmd->input = text;
        } else if (cmd->output == NULL) {
            cmd->output = text;
        } else {
            return misused("%s is one file too many", text);
        }
    }
    if (cmd->given[HELP] == 1 || cmd->given[VERSION] == 1) return DONE;
    for (int id = UV; id <= THREADS; id++)
        if (cmd->given[id] >= 0) return misused("--%s is not in this release", options[id].name);
    if (cmd->input == NULL) return misused("no INPUT.obj is named");
    if (cmd->given[INFO] == 1 && cmd->output && strcmp(cmd->output, "-") == 0)
        return misused("--info and OUTPUT - would share standard output");
    return DONE;
}

// ------------------------------------------------------------------------------------- output

// Everything on standard output has to arrive: a full disk is an error as any other.
static int flush_output(void)
{
    if (fflush(stdout) == 0 && !ferror(stdout)) return DONE;
    fputs("subdiv: standard output: writing failed\n", stderr);
    return FAILED;
}

static int print_help(void)
{
    puts("usage: subdiv [options] INPUT.obj [OUTPUT.obj]\n"
         "Refines a cage by subdivision. INPUT - is standard input; without OUTPUT, or with\n"
         "OUTPUT -, the result goes to standard output. Options win over the file's own tags.\n");
    for (int id = 0; id < OPTION_COUNT; id++) {
        const option *o = &options[id];
        char letter[] = "-?, ";
        letter[1] = o->letter;
        printf("  %s--%s%s%s\n          %s\n", o->letter ? letter : "    ", o->name,
               o->values ? " " : "", o->values ? o->values : "", o->help);
    }
    return flush_output();
}

static int print_version(void)
{
    printf("subdiv %d.%d\n", SUBDIV_VERSION / 100, SUBDIV_VERSION % 100);
    return flush_output();
}

// How many faces there are of each size.
static int print_face_sizes(const subdiv_mesh *mesh, int max_face_size)
{
    int *count = (int *)calloc((size_t)max_face_size + 1, sizeof *count);
    if (count == NULL) {
        fputs("subdiv: out of memory\n", stderr);
        return FAILED;
    }
    for (int f = 0; f < mesh->face_count; f++)
        count[mesh->face_size ? mesh->face_size : mesh->face_sizes[f]]++;
    for (int size = 3; size <= max_face_size; size++)
        if (count[size]) printf("  of %-21d%d\n", size, count[size]);
    free(count);
    return DONE;
}

// A float with the fewest digits that tell it from others, behind a blank.
static void print_float(float value)
{
    char text[32];
    for (int digits = 6; digits <= 9; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, (double)value);
        if ((float)atof(text) == value) break;
    }
    printf(" %s", text);
}

static void print_bounding_box(const subdiv_mesh *mesh)
{
    float low[3], high[3];
    for (int k = 0; k < 3; k++) low[k] = high[k] = mesh->positions[k];
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++) {
        float x = mesh->positions[i];
        if (x < low[i % 3]) low[i % 3] = x;
        if (x > high[i % 3]) high[i % 3] = x;
    }
    printf("%-25s", "bounding box");
    for (int k = 0; k < 3; k++) print_float(low[k]);
    printf(" to");
    for (int k = 0; k < 3; k++) print_float(high[k]);
    printf("\n");
}

static int print_info(const subdiv_mesh *mesh, const subdiv_info *info)
{
    const struct { const char *name; int value; } rows[] = {
        {"boundary edges", info->boundary_edge_count},
        {"non-manifold edges", info->nonmanifold_edge_count},
        {"non-manifold vertices", info->nonmanifold_vertex_count},
        {"isolated vertices", info->isolated_vertex_count},
        {"extraordinary vertices", info->extraordinary_vertex_count},
        {"largest valence", info->max_valence},
        {"creases", info->crease_count},
        {"creases that never fade", info->infinite_crease_count},
        {"corners", info->corner_count},
        {"holes", info->hole_count},
        {"components", info->component_count},
    };
    printf("%-26s%d\n%-26s%d\n%-26s%d\n", "vertices", info->vertex_count, "edges",
           info->edge_count, "faces", info->face_count);
    if (print_face_sizes(mesh, info->max_face_size)) return FAILED;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        printf("%-26s%d\n", rows[i].name, rows[i].value);
    print_bounding_box(mesh);
    return flush_output();
}

// ---------------------------------------------------------------------------------------- run

static double milliseconds(void)
{
#if defined(CLOCK_MONOTONIC)
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
#elif defined(TIME_UTC)
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
#else
    return 1e3 * (double)clock() / CLOCKS_PER_SEC;
#endif
}

static size_t read_stdin(void *user, void *bytes, size_t size)
{
    (void)user;
    size_t n = fread(bytes, 1, size, stdin);
    return n == 0 && ferror(stdin) ? (size_t)-1 : n;
}

static size_t write_stdout(void *user, const void *bytes, size_t size)
{
    (void)user;
    return fwrite(bytes, 1, size, stdout);
}

// Loads the cage and lets the options win over the tags of the file.
static subdiv_result load(subdiv_mesh *cage, const command *cmd, const subdiv_options *opt)
{
    subdiv_result result = strcmp(cmd->input, "-") == 0
        ? subdiv_load_obj_callback(cage, read_stdin, NULL, opt)
        : subdiv_load_obj(cage, cmd->input, opt);
    const int *given = cmd->given;
    if (given[SCHEME] >= 0) cage->scheme = (subdiv_scheme)given[SCHEME];
    if (given[BOUNDARY] >= 0) cage->boundary = (subdiv_boundary)given[BOUNDARY];
    if (given[CREASING] >= 0) cage->creasing = (subdiv_creasing)given[CREASING];
    if (given[TRIANGLES] >= 0) cage->triangles = (subdiv_triangles)given[TRIANGLES];
    return result;
}

// Inspects the cage; its warnings count only if no refinement is going to repeat them.
static int inspect(const subdiv_mesh *cage, const command *cmd, const subdiv_options *opt)
{
    subdiv_info info;
    subdiv_error before = *opt->error;
    if (subdiv_inspect(&info, cage, opt)) {
        fprintf(stderr, "subdiv: %s\n", opt->error->message);
        return FAILED;
    }
    if (cmd->output) *opt->error = before;
    return print_info(cage, &info);
}

// Saves the result. What a failed write has left of OUTPUT is emptied, not removed: OUTPUT may be
// a device.
static int save(const subdiv_mesh *fine, const command *cmd, const subdiv_options *opt)
{
    if (cmd->output == NULL || strcmp(cmd->output, "-") == 0) {
        subdiv_result result = subdiv_save_obj_callback(fine, write_stdout, NULL, opt);
        if (result == SUBDIV_OK || result == SUBDIV_ERROR_IO) return flush_output();
    } else if (subdiv_save_obj(fine, cmd->output, opt) == SUBDIV_OK) {
        return DONE;
    } else if (opt->error->code == SUBDIV_ERROR_IO) {
        FILE *file = fopen(cmd->output, "wb");
        if (file) fclose(file);
    }
    fprintf(stderr, "subdiv: %s\n", opt->error->message);
    return FAILED;
}

// Frees the cage as soon as it is no longer needed. Writes the times to ms.
static int refine(subdiv_mesh *fine, subdiv_mesh *cage, int levels, double *ms,
                  const subdiv_options *opt)
{
    subdiv_surface *surface = NULL;
    double start = milliseconds();
    subdiv_result result = subdiv_prepare(&surface, cage, levels, opt);
    double middle = milliseconds();
    if (result == SUBDIV_OK) result = subdiv_surface_mesh(fine, surface, cage->positions, opt);
    double end = milliseconds();
    subdiv_surface_free(surface);
    subdiv_mesh_free(cage);
    ms[0] = middle - start;
    ms[1] = end - middle;
    if (result == SUBDIV_OK) return DONE;
    fprintf(stderr, "subdiv: %s\n", opt->error->message);
    return FAILED;
}

static void print_times(const double *ms, int count, int vertex_count)
{
    static const char *const names[] = {"load", "prepare", "refine", "save"};
    for (int i = 0; i < count; i++)
        fprintf(stderr, "%s %.3f ms %.2f ns/vertex\n", names[i], ms[i], 1e6 * ms[i] / vertex_count);
}

static void print_warnings(const subdiv_error *error)
{
    if (error->warning_count == 0) return;
    fprintf(stderr, "subdiv: warning: %s", error->warning);
    if (error->warning_count > 1) fprintf(stderr, " (and %d more)", error->warning_count - 1);
    fputc('\n', stderr);
}

// Load, tell, refine, save.
static int run(subdiv_mesh *cage, subdiv_mesh *fine, const command *cmd, const subdiv_options *opt)
{
    double ms[4], start = milliseconds();   // of load, prepare, refine, save
    if (load(cage, cmd, opt)) {
        fprintf(stderr, "subdiv: %s\n", opt->error->message);
        return FAILED;
    }
    ms[0] = milliseconds() - start;
    int info = cmd->given[INFO] == 1, timed = cmd->given[TIME] == 1;
    if (info && inspect(cage, cmd, opt)) return FAILED;
    if (info && cmd->output == NULL) {
        if (timed) print_times(ms, 1, cage->vertex_count);
        return DONE;
    }
    int levels = cmd->given[LEVELS] >= 0 ? cmd->given[LEVELS] : 1;
    if (refine(fine, cage, levels, ms + 1, opt)) return FAILED;
    start = milliseconds();
    if (save(fine, cmd, opt)) return FAILED;
    ms[3] = milliseconds() - start;
    if (timed) print_times(ms, 4, fine->vertex_count);
    return DONE;
}

int main(int argc, char **argv)
{
    command cmd = {{0}, NULL, NULL};
    int result = read_command(&cmd, argc, argv);
    if (result) return result;
#ifdef SIGPIPE
    signal(SIGPIPE, SIG_IGN);         // a reader that goes away is a failed write, with a message
#endif
    if (cmd.given[HELP] == 1) return print_help();
    if (cmd.given[VERSION] == 1) return print_version();

    subdiv_mesh cage = {0}, fine = {0};
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.triangulate = cmd.given[TRIANGULATE] == 1;
    opt.error = &error;
    result = run(&cage, &fine, &cmd, &opt);
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&cage);
    if (result == DONE) print_warnings(&error);
    return result;
}
