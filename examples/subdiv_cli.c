// subdiv: the command line. Refines the cage in an OBJ file, or tells what the cage is made of.
//
//     cc -O2 -I. examples/subdiv_cli.c -o build/subdiv -lm -pthread
//     x86_64-w64-mingw32-gcc -O2 -I. examples/subdiv_cli.c -o build/subdiv.exe       (no --threads)
//
//     build/subdiv --levels 3 --time examples/cages/whale.obj build/whale.obj
//
//     load 0.108 ms 6.34 ns/vertex
//     prepare 2.705 ms 158.25 ns/vertex
//     refine 0.693 ms 40.52 ns/vertex
//     save 7.781 ms 455.17 ns/vertex

#define _XOPEN_SOURCE 700             // clock_gettime, realpath and more, where there are pthreads

#include <errno.h>
#include <float.h>
#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifndef _WIN32
#define HAS_PTHREADS
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

enum { DONE = 0, FAILED = 1, MISUSED = 2 };   // what the program returns
enum { LARGE = 1 << 24 };                     // vertices; results with more are streamed
enum { MAX_THREADS = 256 };
enum { EXPLAIN_ALL = INT_MAX };               // no point has this number

// ------------------------------------------------------------------------------ command line

enum {
    SCHEME, LEVELS, BOUNDARY, CREASING, TRIANGLES, VERTEX_RULE, UV, LIMIT, TESSELLATE, CURVE,
    THREADS,
    CREASE_ANGLE, CREASE_GROUPS, CREASE_SEAMS, CREASE_SHARPNESS,
    EVAL, STREAM, TRIANGULATE, KEEP_HOLES, INFO, EXPLAIN, TIME, HELP, VERSION, OPTION_COUNT
};

// A list of names stands in the order of the library's enum, so that the place of a name in the
// list is the value of the enum.
typedef struct option {
    char        letter;               // 0: none
    const char *name;
    const char *values;               // NULL: a switch; "N": a whole number; "DEG", "S": a
                                      // number; "SAMPLES": a file; else names between bars
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
    {0, "stream", NULL, "refine and save piece by piece, in little memory; large results always"},
    {0, "triangulate", NULL, "Loop: cut larger faces into triangles first"},
    {0, "keep-holes", NULL, "keep the faces of holes, tagged as holes"},
    {0, "info", NULL, "print what the cage is made of, and what is odd about it"},
    {0, "explain", "N|all", "print the rule and the mask of point N of the cage refined once; all: a\n"
     "          line of data for each point"},
    {0, "time", NULL, "print how long each step takes"},
    {'h', "help", NULL, "print this"},
    {0, "version", NULL, "print the version"},
};

typedef struct command {
    int         given[OPTION_COUNT];  // the value of each option; -1: not given
    float       numbers[OPTION_COUNT];    // of those with any number
    const char *input, *output, *samples;     // NULL: not given
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
    if (id == EVAL) {
        cmd->samples = value;
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
    if (cmd->given[LIMIT] == 1 && cmd->given[STREAM] == 1)
        return misused("--stream writes no normals, so not with --limit");
    if (cmd->given[TESSELLATE] > 0 && (cmd->given[LEVELS] >= 0 || cmd->given[STREAM] == 1))
        return misused("--tessellate has no levels and is no stream");
    if (cmd->given[CURVE] >= 0 && (cmd->given[TESSELLATE] > 0 || cmd->given[STREAM] == 1 ||
                                   cmd->given[EXPLAIN] >= 0 || cmd->samples))
        return misused("--curve is not for surfaces: no --tessellate, --stream, --explain, --eval");
    if (cmd->input == NULL) return misused("no INPUT.obj is named");
    if (cmd->given[CREASE_SHARPNESS] == 1 && cmd->given[CREASE_ANGLE] < 0 &&
        cmd->given[CREASE_GROUPS] < 0 && cmd->given[CREASE_SEAMS] < 0)
        return misused("--crease-sharpness needs one of the other crease options");
    if (cmd->samples && (cmd->output || cmd->given[INFO] == 1 || cmd->given[LEVELS] >= 0 ||
                         cmd->given[LIMIT] == 1 || cmd->given[STREAM] == 1 ||
                         cmd->given[TESSELLATE] > 0))
        return misused("--eval prints: no OUTPUT, --info, --levels, --limit, --tessellate or "
                       "--stream beside it");
    if (cmd->samples && strcmp(cmd->samples, "-") == 0 && strcmp(cmd->input, "-") == 0)
        return misused("--eval - and INPUT - would share standard input");
    if (cmd->given[INFO] == 1 && cmd->output && strcmp(cmd->output, "-") == 0)
        return misused("--info and OUTPUT - would share standard output");
    if (cmd->given[EXPLAIN] >= 0 && cmd->output)
        return misused("--explain writes to standard output alone");
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

// How many statements there are of each kind.
static void print_statements(const subdiv_mesh *mesh)
{
    static const char *const words[] = {"g", "o", "s", "usemtl", "mtllib"};
    printf("%-26s%d\n", "statements", mesh->statement_count);
    for (int k = 0; k < 5; k++) {
        size_t size = strlen(words[k]);
        int count = 0;
        for (int i = 0; i < mesh->statement_count; i++)
            count += strncmp(mesh->statements[i], words[k], size) == 0 &&
                     strchr(" \t", mesh->statements[i][size]) != NULL;
        if (count) printf("  %-24s%d\n", words[k], count);
    }
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

enum { SHOWN = 10 };                  // findings of each kind

typedef struct findings {
    int  counts[SUBDIV_ODDITY_COUNT];
    int  line_counts[SUBDIV_ODDITY_COUNT];
    char lines[SUBDIV_ODDITY_COUNT][SHOWN][256];
} findings;

static void keep_finding(void *user, const subdiv_finding *finding)
{
    findings *all = (findings *)user;
    int *count = &all->line_counts[finding->kind];
    if (*count == SHOWN) return;
    snprintf(all->lines[finding->kind][(*count)++], sizeof **all->lines, "%s", finding->text);
}

static void print_findings(const findings *all)
{
    int total = 0;
    for (int kind = 0; kind < SUBDIV_ODDITY_COUNT; kind++) total += all->counts[kind];
    printf("%-26s%d\n", "oddities", total);
    if (total) printf("  (faces, vertices and tags are counted from 0)\n");
    for (int kind = 0; kind < SUBDIV_ODDITY_COUNT; kind++) {
        for (int i = 0; i < all->line_counts[kind]; i++) printf("  %s\n", all->lines[kind][i]);
        if (all->counts[kind] > SHOWN) printf("  and %d more\n", all->counts[kind] - SHOWN);
    }
}

static int print_info(const subdiv_mesh *mesh, const subdiv_info *info, const findings *odd)
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
        {"polylines", mesh->line_count},
        {"components", info->component_count},
        {"UVs", mesh->uv_count},
        {"vertices with colours", mesh->colors ? mesh->vertex_count : 0},
    };
    printf("%-26s%d\n%-26s%d\n%-26s%d\n", "vertices", info->vertex_count, "edges",
           info->edge_count, "faces", info->face_count);
    if (print_face_sizes(mesh, info->max_face_size)) return FAILED;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        printf("%-26s%d\n", rows[i].name, rows[i].value);
    print_statements(mesh);
    print_bounding_box(mesh);
    print_findings(odd);
    return flush_output();
}

// ------------------------------------------------------------------------------------ threads

#ifdef HAS_PTHREADS

typedef struct pool {
    pthread_mutex_t mutex;            // of all that follows
    pthread_cond_t  work, done;       // there are jobs; none is running any more
    pthread_t       threads[MAX_THREADS];
    int             thread_count, quit;
    void          (*job)(void *context, int i);
    void           *context;
    int             next, count, running;
} pool;

// Does jobs until all have been taken. The mutex is locked, but not during a job.
static void take_jobs(pool *p)
{
    while (p->next < p->count) {
        int i = p->next++;
        p->running++;
        pthread_mutex_unlock(&p->mutex);
        p->job(p->context, i);
        pthread_mutex_lock(&p->mutex);
        p->running--;
    }
}

static void *thread_main(void *user)
{
    pool *p = (pool *)user;
    pthread_mutex_lock(&p->mutex);
    while (!p->quit) {
        take_jobs(p);
        if (p->running == 0) pthread_cond_signal(&p->done);
        pthread_cond_wait(&p->work, &p->mutex);
    }
    pthread_mutex_unlock(&p->mutex);
    return NULL;
}

// A subdiv_run: the caller takes jobs as the threads do, then waits for theirs.
static void run_jobs(void *user, void (*job)(void *context, int i), void *context, int count)
{
    pool *p = (pool *)user;
    pthread_mutex_lock(&p->mutex);
    p->job = job;
    p->context = context;
    p->next = 0;
    p->count = count;
    pthread_cond_broadcast(&p->work);
    take_jobs(p);
    while (p->running > 0) pthread_cond_wait(&p->done, &p->mutex);
    pthread_mutex_unlock(&p->mutex);
}

// Starts count - 1 threads, or as many as there can be: whatever is missing, the others do.
static void start_threads(pool *p, int count, subdiv_options *opt)
{
    pthread_mutex_init(&p->mutex, NULL);
    pthread_cond_init(&p->work, NULL);
    pthread_cond_init(&p->done, NULL);
    for (; p->thread_count < count - 1 && p->thread_count < MAX_THREADS; p->thread_count++)
        if (pthread_create(&p->threads[p->thread_count], NULL, thread_main, p)) break;
    if (p->thread_count == 0) return;
    opt->run = run_jobs;
    opt->user = p;
}

static void end_threads(pool *p)
{
    pthread_mutex_lock(&p->mutex);
    p->quit = 1;
    pthread_cond_broadcast(&p->work);
    pthread_mutex_unlock(&p->mutex);
    for (int i = 0; i < p->thread_count; i++) pthread_join(p->threads[i], NULL);
    pthread_cond_destroy(&p->done);
    pthread_cond_destroy(&p->work);
    pthread_mutex_destroy(&p->mutex);
}

#else

typedef struct pool {
    int thread_count;
} pool;

static void start_threads(pool *p, int count, subdiv_options *opt)
{
    (void)p;
    (void)count;
    (void)opt;
}

static void end_threads(pool *p)
{
    (void)p;
}

#endif

// ---------------------------------------------------------------------------------------- run

static double milliseconds(void)
{
#if defined(HAS_PTHREADS)
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
#elif defined(TIME_UTC)
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
#else
    return 1e3 * (double)clock() / CLOCKS_PER_SEC;      // Windows: of the wall, not the processor
#endif
}

static size_t read_stdin(void *user, void *bytes, size_t size)
{
    (void)user;
    size_t n = fread(bytes, 1, size, stdin);
    return n == 0 && ferror(stdin) ? (size_t)-1 : n;
}

static size_t write_file(void *user, const void *bytes, size_t size)
{
    return fwrite(bytes, 1, size, (FILE *)user);
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
    if (given[VERTEX_RULE] >= 0) cage->vertex_rule = (subdiv_vertex_rule)given[VERTEX_RULE];
    if (given[UV] >= 0) cage->uv_rule = (subdiv_uv_rule)given[UV];
    return result;
}

// Names the file, where the message does not: of standard input, and once the cage is read.
static void print_message(const char *kind, const char *file, const char *message)
{
    int named = strncmp(message, file, strlen(file)) == 0;
    fprintf(stderr, "subdiv: %s%s%s%s", kind, named ? "" : file, named ? "" : ": ", message);
}

static int report(const char *file, const subdiv_options *opt)
{
    print_message("", file, opt->error->message);
    fputc('\n', stderr);
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

// Inspects the cage; its warnings count only if no refinement is going to repeat them.
static int inspect(const subdiv_mesh *cage, const command *cmd, const subdiv_options *opt)
{
    subdiv_info info;
    findings odd = {{0}, {0}, {{{0}}}};
    subdiv_error before = *opt->error;
    if (subdiv_inspect(&info, cage, opt) ||
        subdiv_check(odd.counts, cage, keep_finding, &odd, opt)) return report(cmd->input, opt);
    if (cmd->output) *opt->error = before;
    return print_info(cage, &info, &odd);
}

// Prints what all points are, with their masks, a line each.
static int explain_all(const subdiv_mesh *cage, const command *cmd, const subdiv_options *opt)
{
    static const char *const kinds[] = { "vertex", "edge", "face" };
    static const char *const rules[] = { "smooth", "dart", "crease", "corner" };
    static const char *const reasons[] = { "nothing-sharp", "linear", "no-faces", "boundary",
        "non-manifold", "single-face", "own-sharpness", "sharp-edges" };
    subdiv_explanation e;
    if (subdiv_explain_points(&e, cage, opt)) return report(cmd->input, opt);
    puts("# point, what of: its rule, the next level's, the share of the first, why | its mask");
    for (int i = 0; i < e.count; i++) {
        const subdiv_point *p = &e.points[i];
        printf("%d %s ", i, kinds[p->kind]);
        if (p->kind == SUBDIV_EDGE_POINT) printf("%d-%d", p->ends[0], p->ends[1]);
        else printf("%d", p->parent);
        printf(": %s %s %g %s |", rules[p->rule], rules[p->next], p->weight, reasons[p->reason]);
        for (size_t k = e.masks.offsets[i]; k < e.masks.offsets[i + 1]; k++)
            printf(" %d:%.9g", e.masks.indices[k], (double)e.masks.weights[k]);
        putchar('\n');
    }
    subdiv_explanation_free(&e);
    return flush_output();
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

// A file that is being written. Under its final name it is always whole: until then it has another
// one, and is removed if writing fails or the program is stopped. Written in place is only what is
// no regular file, such as a device, or in a folder that takes no new files.
typedef struct output {
    FILE       *file;
    const char *path;                 // NULL or "-": standard output
    char        real[4096];           // the path behind links
    char        beside[4096 + 32];    // the name until the file is whole
} output;

static const char *volatile unfinished;   // beside, while that file is open

#ifdef _WIN32
static FILE *open_beside(output *o)
{
    snprintf(o->beside, sizeof o->beside, "%s.tmp", o->path);
    unfinished = o->beside;
    return fopen(o->beside, "wb");
}

// Here rename does not replace. If it fails now, the file is still there under its other name.
static int rename_output(const output *o)
{
    remove(o->path);
    return rename(o->beside, o->path);
}
#else
static FILE *open_beside(output *o)
{
    struct stat old;
    if (strncmp(o->path, "/dev/", 5) != 0 && realpath(o->path, o->real)) o->path = o->real;
    int exists = lstat(o->path, &old) == 0;
    if (exists && (!S_ISREG(old.st_mode) || access(o->path, W_OK))) return NULL;
    snprintf(o->beside, sizeof o->beside, "%s.%ld.tmp", o->path, (long)getpid());
    unfinished = o->beside;
    FILE *file = fopen(o->beside, "wb");
    if (file && exists) chmod(o->beside, old.st_mode & 0777);
    return file;
}

static int rename_output(const output *o)
{
    return rename(o->beside, o->path);
}

// Ends the program after Ctrl-C, or when nobody reads what it writes, without a word.
static void stop(int number)
{
    const char *name = unfinished;
    (void)number;
    if (name) unlink(name);
    _exit(FAILED);
}
#endif

static void catch_signals(void)
{
#ifndef _WIN32
    const int numbers[] = {SIGHUP, SIGINT, SIGPIPE, SIGTERM};
    for (int i = 0; i < 4; i++)
        if (signal(numbers[i], stop) == SIG_IGN && numbers[i] != SIGPIPE)
            signal(numbers[i], SIG_IGN);
#endif
}

static int fail_output(const char *path)
{
    fprintf(stderr, "subdiv: %s: %s\n", path, strerror(errno));
    return FAILED;
}

static int open_output(output *o, const char *path)
{
    o->path = path;
    o->file = stdout;
    if (path == NULL || strcmp(path, "-") == 0) return DONE;
    errno = 0;
    o->file = strlen(path) < sizeof o->real ? open_beside(o) : NULL;
    if (o->file == NULL) unfinished = NULL;
    if (o->file == NULL && errno != ENOSPC) o->file = fopen(o->path, "wb");
    if (o->file == NULL) return fail_output(path);
    setvbuf(o->file, NULL, _IONBF, 0);                // the library writes large blocks
    return DONE;
}

// Looks at how writing ended.
static int close_output(output *o, subdiv_result result, const command *cmd,
                        const subdiv_options *opt)
{
    if (o->file == stdout)
        return result && result != SUBDIV_ERROR_IO ? report(cmd->input, opt) : flush_output();
    int failed = fclose(o->file) != 0 || result;
    if (!failed && unfinished) failed = rename_output(o) != 0;
    if (failed && !result) fail_output(cmd->output);
    if (failed && unfinished) remove(o->beside);
    unfinished = NULL;
    if (result) return report(cmd->output, opt);
    return failed ? FAILED : DONE;
}

// What a run needs and main frees.
typedef struct work {
    subdiv_mesh     cage, fine;
    subdiv_surface *surface;
    float          *points, *colors;  // of curves, and the sizes and vertices of their polylines:
    int            *numbers;          // fine has these arrays
    double          ms[4];            // of each step so far
    const char     *steps[4];
    int             step_count;
    double          start;            // of the running step
} work;

static void end_step(work *w, const char *step)
{
    double now = milliseconds();
    w->steps[w->step_count] = step;
    w->ms[w->step_count++] = now - w->start;
    w->start = now;
}

static void print_times(const work *w, int vertex_count)
{
    for (int i = 0; i < w->step_count; i++)
        fprintf(stderr, "%s %.3f ms %.2f ns/vertex\n", w->steps[i], w->ms[i],
                1e6 * w->ms[i] / vertex_count);
}

static int levels_of(const command *cmd)
{
    return cmd->given[LEVELS] >= 0 ? cmd->given[LEVELS] : 1;
}

// A polyline of the cage is closed if it ends with its first vertex.
typedef struct polyline {
    subdiv_curve_ends ends;
    int size, count;                  // its vertices, and the points that they become
} polyline;

static polyline polyline_of(const command *cmd, const int *vertices, int size)
{
    polyline line = { SUBDIV_ENDS_KEPT, size, 0 };
    if (vertices[0] == vertices[size - 1]) line.ends = SUBDIV_ENDS_CLOSED, line.size--;
    line.count = subdiv_curve_point_count((subdiv_curve_rule)cmd->given[CURVE], line.ends,
                                          line.size, levels_of(cmd));
    return line;
}

// Refines values of the cage's vertices in place: those of the polyline become those of its points.
static void refine_polyline(const command *cmd, polyline line, const int *vertices,
                            const float *values, float *points, const subdiv_options *opt)
{
    for (int i = 0; i < line.size; i++)
        memcpy(points + 3 * i, values + 3 * (size_t)vertices[i], 3 * sizeof *points);
    subdiv_curve((subdiv_curve_rule)cmd->given[CURVE], line.ends, levels_of(cmd), 3, line.size,
                 points, 3, points, 3, opt);
}

// Gives fine arrays for so many points and polylines that have so many vertices.
static subdiv_result make_room_for_curves(work *w, size_t points, size_t vertices,
                                          const subdiv_options *opt)
{
    const subdiv_mesh *cage = &w->cage;
    subdiv_error *error = opt->error;
    if (cage->line_count == 0) strcpy(error->message, "there are no polylines (l) to refine");
    if (cage->line_count == 0) return SUBDIV_ERROR_EMPTY;
    w->points = points > INT_MAX ? NULL : (float *)malloc(3 * points * sizeof *w->points + 1);
    w->colors = !w->points || !cage->colors ? NULL
              : (float *)malloc(3 * points * sizeof *w->colors + 1);
    w->numbers = (int *)malloc(((size_t)cage->line_count + vertices) * sizeof *w->numbers);
    if (!w->points || !w->numbers || (cage->colors && !w->colors)) {
        strcpy(error->message, "the curves have too many points");
        return SUBDIV_ERROR_TOO_LARGE;
    }
    w->fine.vertex_count = (int)points;
    w->fine.positions = w->points;
    w->fine.colors = w->colors;
    w->fine.line_count = cage->line_count;
    w->fine.line_sizes = w->numbers;
    w->fine.line_vertices = w->numbers + cage->line_count;
    return SUBDIV_OK;
}

// Makes fine of the refined polylines.
static subdiv_result refine_curves(work *w, const command *cmd, const subdiv_options *opt)
{
    const subdiv_mesh *cage = &w->cage;
    const int *v = cage->line_vertices;
    size_t points = 0, vertices = 0;
    for (int i = 0; i < cage->line_count; v += cage->line_sizes[i++]) {
        polyline line = polyline_of(cmd, v, cage->line_sizes[i]);
        points += line.count ? (size_t)line.count : (size_t)INT_MAX + 1;
        vertices += (size_t)line.count + (line.ends == SUBDIV_ENDS_CLOSED);
    }
    subdiv_result result = make_room_for_curves(w, points, vertices, opt);
    int *to = w->fine.line_vertices, first = 0;
    v = cage->line_vertices;
    for (int i = 0; i < cage->line_count && !result; v += cage->line_sizes[i++]) {
        polyline line = polyline_of(cmd, v, cage->line_sizes[i]);
        size_t at = 3 * (size_t)first;
        refine_polyline(cmd, line, v, cage->positions, w->points + at, opt);
        if (w->colors) refine_polyline(cmd, line, v, cage->colors, w->colors + at, opt);
        for (int k = 0; k < line.count; k++) *to++ = first + k;
        if (line.ends == SUBDIV_ENDS_CLOSED) *to++ = first;
        w->fine.line_sizes[i] = line.count + (line.ends == SUBDIV_ENDS_CLOSED);
        first += line.count;
    }
    return result;
}

// Frees the cage and what was prepared as soon as they are no longer needed.
static int refine_then_save(work *w, const command *cmd, const subdiv_options *opt)
{
    subdiv_tessellation how = {0};
    how.rate = cmd->given[TESSELLATE];
    subdiv_result result = cmd->given[CURVE] >= 0 ? refine_curves(w, cmd, opt) : how.rate > 0
        ? subdiv_surface_tessellate(&w->fine, w->surface, w->cage.positions, &how, opt)
        : subdiv_surface_mesh(&w->fine, w->surface, w->cage.positions, opt);
    subdiv_surface_free(w->surface);
    w->surface = NULL;
    subdiv_mesh_free(&w->cage);
    if (result) return report(cmd->input, opt);
    end_step(w, "refine");
    output out = {0};
    if (open_output(&out, cmd->output)) return FAILED;
    result = subdiv_save_obj_callback(&w->fine, write_file, out.file, opt);
    if (close_output(&out, result, cmd, opt)) return FAILED;
    end_step(w, "save");
    return DONE;
}

static int stream(work *w, const command *cmd, const subdiv_options *opt)
{
    output out = {0};
    if (open_output(&out, cmd->output)) return FAILED;
    subdiv_result result = subdiv_stream_obj_callback(w->surface, w->cage.positions, write_file,
                                                      out.file, opt);
    if (close_output(&out, result, cmd, opt)) return FAILED;
    end_step(w, "refine+save");
    return DONE;
}

// Places to evaluate, and the lines they stand on.
typedef struct samples {
    subdiv_location *at;
    int             *lines;
    int              count, capacity;
} samples;

static int bad_sample(const command *cmd, int line, const char *text)
{
    fprintf(stderr, "subdiv: %s:%d: %s\n", cmd->samples, line, text);
    return FAILED;
}

static int add_sample(samples *all, subdiv_location at, int line)
{
    if (all->count == all->capacity) {
        size_t capacity = 2 * (size_t)all->capacity + 1024;
        void *places = realloc(all->at, capacity * sizeof *all->at);
        if (places) all->at = (subdiv_location *)places;
        void *lines = realloc(all->lines, capacity * sizeof *all->lines);
        if (lines) all->lines = (int *)lines;
        if (!places || !lines || capacity > INT_MAX / 16) return FAILED;
        all->capacity = (int)capacity;
    }
    all->at[all->count] = at;
    all->lines[all->count++] = line;
    return DONE;
}

// Reads face u v or face/corner u v. Returns whether there is nothing else on the line.
static int read_sample(char *text, subdiv_location *at)
{
    char *words[4], *corner, *end_u, *end_v;
    int count = 0;
    for (char *p = strtok(text, " \t\r\n"); p && count < 4; p = strtok(NULL, " \t\r\n"))
        words[count++] = p;
    if (count != 3) return 0;
    corner = strchr(words[0], '/');
    if (corner) *corner++ = 0;
    at->face = read_number(words[0]);
    at->corner = corner ? read_number(corner) : 0;
    at->u = (float)strtod(words[1], &end_u);
    at->v = (float)strtod(words[2], &end_v);
    return at->face >= 0 && at->corner >= 0 && *end_u == 0 && *end_v == 0;
}

static int read_samples(FILE *file, const command *cmd, samples *all)
{
    char buffer[256], *text = buffer;
    for (int line = 1; fgets(buffer, sizeof buffer, file); line++, text = buffer) {
        subdiv_location at;
        int is_full = strlen(text) + 1 == sizeof buffer;
        if (strchr(text, '\n') == NULL && !feof(file))
            return bad_sample(cmd, line, is_full ? "too long" : "has a byte 0");
        if (line == 1 && strncmp(text, "\xEF\xBB\xBF", 3) == 0) text += 3;  // byte order mark
        text[strcspn(text, "#")] = 0;                                   // a comment
        if (text[strspn(text, " \t\r\n")] == 0) continue;
        if (!read_sample(text, &at))
            return bad_sample(cmd, line, "not 'face u v' or 'face/corner u v'");
        if (add_sample(all, at, line)) return bad_sample(cmd, line, "out of memory");
    }
    return ferror(file) ? bad_sample(cmd, 0, "reading failed") : DONE;
}

// What the library writes as three vertices, v x y z, is one line here.
static int print_sample_lines(char *text, size_t size)
{
    size_t end = 0;
    int vertices = 0;
    for (size_t i = 0; i < size; i++) {
        if (text[i] == 'v') i++;
        else text[end++] = (char)(text[i] == '\n' && ++vertices % 3 ? ' ' : text[i]);
    }
    fwrite(text, 1, end, stdout);
    return flush_output();
}

// Writes the numbers [9 * count] as the library does.
static int print_samples(float *numbers, const samples *all, const command *cmd)
{
    subdiv_mesh points = {0};
    size_t size = 0;
    points.vertex_count = 3 * all->count;
    points.positions = numbers;
    for (int i = 0; i < 9 * all->count; i++)
        if (!(fabsf(numbers[i]) <= FLT_MAX))
            return bad_sample(cmd, all->lines[i / 9], "its numbers are too large for floats");
    if (all->count == 0) return DONE;
    subdiv_save_obj_memory(&points, NULL, 0, &size, NULL);
    char *text = (char *)malloc(size);
    int result = FAILED;
    if (text && subdiv_save_obj_memory(&points, text, size, &size, NULL) == SUBDIV_OK)
        result = print_sample_lines(text, size);
    else fputs("subdiv: out of memory\n", stderr);
    free(text);
    return result;
}

// Names the line of the first sample that the library refuses.
static int report_samples(const work *w, const void *scratch, const samples *all,
                          const command *cmd, const subdiv_options *opt)
{
    const subdiv_derivatives nothing = {0};
    int i = 0;
    while (i + 1 < all->count && subdiv_evaluate_at(w->surface, 3, scratch, 1, &all->at[i],
                                                    &nothing, opt) == SUBDIV_OK) i++;
    subdiv_evaluate_at(w->surface, 3, scratch, 1, &all->at[i], &nothing, opt);
    const char *reason = strchr(opt->error->message, ':');
    return bad_sample(cmd, all->lines[i], reason ? reason + 2 : opt->error->message);
}

static int evaluate(work *w, const samples *all, const command *cmd, const subdiv_options *opt)
{
    if (subdiv_prepare(&w->surface, &w->cage, SUBDIV_EXACT, opt)) return report(cmd->input, opt);
    end_step(w, "prepare");
    void *scratch = malloc(subdiv_scratch_size(w->surface, 3));
    float *numbers = (float *)malloc(9 * sizeof(float) * ((size_t)all->count + 1));
    int result = FAILED;
    if (scratch && numbers) {
        subdiv_derivatives out = {0};
        out.points = numbers;
        out.du = numbers + 3;
        out.dv = numbers + 6;
        out.stride = 9;
        if (subdiv_evaluate_begin(w->surface, 3, w->cage.positions, 0, scratch, opt))
            result = report(cmd->input, opt);
        else if (subdiv_evaluate_at(w->surface, 3, scratch, all->count, all->at, &out, opt))
            result = report_samples(w, scratch, all, cmd, opt);
        else result = print_samples(numbers, all, cmd);
        end_step(w, "evaluate");
    } else {
        fputs("subdiv: out of memory\n", stderr);
    }
    free(scratch);
    free(numbers);
    return result;
}

static int run_samples(work *w, const command *cmd, const subdiv_options *opt)
{
    samples all = { NULL, NULL, 0, 0 };
    int is_stdin = strcmp(cmd->samples, "-") == 0;
    FILE *file = is_stdin ? stdin : fopen(cmd->samples, "r");
    int result = FAILED;
    if (!file) fprintf(stderr, "subdiv: %s: cannot be opened\n", cmd->samples);
    else result = read_samples(file, cmd, &all);
    if (file && !is_stdin) fclose(file);
    end_step(w, "samples");
    if (result == DONE) result = evaluate(w, &all, cmd, opt);
    free(all.at);
    free(all.lines);
    return result;
}

// Load, tell, refine, save.
static int run(work *w, const command *cmd, const subdiv_options *opt)
{
    int info = cmd->given[INFO] == 1, timed = cmd->given[TIME] == 1;
    w->start = milliseconds();
    if (load(&w->cage, cmd, opt)) return report(cmd->input, opt);
    if (add_creases(&w->cage, cmd, opt)) return FAILED;
    end_step(w, "load");
    if (cmd->given[EXPLAIN] == EXPLAIN_ALL) return explain_all(&w->cage, cmd, opt);
    if (cmd->given[EXPLAIN] >= 0) return explain(&w->cage, cmd, opt);
    if (info && inspect(&w->cage, cmd, opt)) return FAILED;
    if (info && cmd->output == NULL) {
        if (timed) print_times(w, w->cage.vertex_count);
        return DONE;
    }
    int levels = levels_of(cmd);
    if (cmd->given[TESSELLATE] > 0) levels = SUBDIV_EXACT;
    w->start = milliseconds();
    if (cmd->samples) {
        if (run_samples(w, cmd, opt)) return FAILED;
        if (timed) print_times(w, w->cage.vertex_count);
        return DONE;
    }
    if (cmd->given[CURVE] >= 0) {
        if (refine_then_save(w, cmd, opt)) return FAILED;
        if (timed) print_times(w, w->fine.vertex_count);
        return DONE;
    }
    if (w->cage.line_count > 0 && levels != 0 && opt->error->warning_count++ == 0)
        snprintf(opt->error->warning, sizeof opt->error->warning,
                 "%d polylines are left out: --curve refines them", w->cage.line_count);
    if (subdiv_prepare(&w->surface, &w->cage, levels, opt)) return report(cmd->input, opt);
    end_step(w, "prepare");
    int vertex_count = subdiv_surface_vertex_count(w->surface);
    int streams = cmd->given[STREAM] == 1 || (vertex_count > LARGE && !opt->limit);
    if (streams ? stream(w, cmd, opt) : refine_then_save(w, cmd, opt)) return FAILED;
    if (timed) print_times(w, streams ? vertex_count : w->fine.vertex_count);
    return DONE;
}

static void print_warnings(const command *cmd, const subdiv_error *error)
{
    if (error->warning_count == 0) return;
    print_message("warning: ", cmd->input, error->warning);
    if (error->warning_count > 1) fprintf(stderr, " (and %d more)", error->warning_count - 1);
    fputc('\n', stderr);
}

int main(int argc, char **argv)
{
    command cmd = {{0}, {0}, NULL, NULL, NULL};
    int result = read_command(&cmd, argc, argv);
    if (result) return result;
    catch_signals();
    if (cmd.given[HELP] == 1) return print_help();
    if (cmd.given[VERSION] == 1) return print_version();

    work w = {0};
    pool threads = {0};
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.triangulate = cmd.given[TRIANGULATE] == 1;
    opt.keep_holes = cmd.given[KEEP_HOLES] == 1;
    opt.limit = cmd.given[LIMIT] == 1;
    opt.error = &error;
    start_threads(&threads, cmd.given[THREADS], &opt);
    result = run(&w, &cmd, &opt);
    end_threads(&threads);
    subdiv_mesh_free(&w.fine);
    free(w.points);
    free(w.colors);
    free(w.numbers);
    subdiv_surface_free(w.surface);
    subdiv_mesh_free(&w.cage);
    if (result == DONE) print_warnings(&cmd, &error);
    return result;
}
