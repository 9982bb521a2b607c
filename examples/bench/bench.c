// bench: how long subdiv.h takes and how much memory, beside OpenSubdiv and the machine itself.
//
//     bench [FILE[:LEVEL][:SCHEME] ...]        SCHEME is catmull-clark, loop or bilinear
//
// FILE is an OBJ file, or torus or torus-triangles, of about a million faces each. Without LEVEL it
// is refined as far as 3 million vertices allow. Without arguments: both tori and examples/cages.
//
//     cc -O3 -I. examples/bench/bench.c -o build/bench -lpthread -lm          (POSIX)
//
// To compare, add -DBENCH_PEER and link opensubdiv.cpp with -losdCPU. Runs of ours, theirs
// and the machine's alternate, so that whatever slows the machine slows all three.

#define _POSIX_C_SOURCE 200809L

#include <limits.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "bench.h"

#ifndef BENCH_FLAGS
#define BENCH_FLAGS "flags unknown"   // the compiler's options, for the heading
#endif
#if defined(__clang__)
#define BENCH_COMPILER "clang " __clang_version__
#elif defined(__GNUC__)
#define BENCH_COMPILER "gcc " __VERSION__
#else
#define BENCH_COMPILER "unknown compiler"
#endif

enum { TORUS_SIDE = 1024, MOST_VERTICES = 3000000 };
enum { SAMPLE_COUNT = 1 << 17, TESSELLATION_RATE = 8 };
enum { MIN_RUNS = 3, MAX_RUNS = 15 };
static const double stage_seconds = 2;    // a stage ends after this time, or after its MAX_RUNS

// The rows and columns of the table. PEAK is in bytes, all others in seconds.
enum {
    COLD, WARM, PREPARE, FACES, CHAINED, STENCILS, FLOAT4, THREADED, NORMALS, NORMALS_CHAINED,
    BUFFER, SURFACES, SAMPLE, SAMPLE_DERIVATIVES, TESSELLATE, PEAK, ROW_COUNT
};
enum { OURS, THEIRS, LIMIT, COLUMN_COUNT };

static const char *row_names[ROW_COUNT] = {
    "one-shot, fresh memory", "one-shot, re-used memory", "prepare", "faces",
    "evaluate xyz | chained", "evaluate xyz | stencils", "evaluate xyzw | stencils",
    "evaluate xyz, 2 threads", "limit + normals | Limit", "limit + normals | chained",
    "buffer (refine + loop)", "surfaces ready", "sample P", "sample P, du, dv", "tessellate",
    "peak memory, bytes"
};

#ifdef BENCH_PEER
static const peer_library *const library = &opensubdiv;
#else
static const peer_library *const library = NULL;
#endif

typedef struct table {
    double samples[ROW_COUNT][COLUMN_COUNT][MAX_RUNS];
    int    counts[ROW_COUNT][COLUMN_COUNT];
} table;

typedef struct bench {
    const char *name;
    subdiv_mesh cage;
    int         levels;
    int         vertex_count, face_count, face_size;    // of the result
    int         tessellated_count;                      // points of all faces of the cage
    peer       *rival;                                  // NULL: none is linked in
    int         warming_up;                             // runs do not count yet
    table       table;
} bench;

static double seconds(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

// The processor's time for this thread: what else runs on the machine costs little of it.
static double now(void)
{
    return seconds(CLOCK_THREAD_CPUTIME_ID);
}

static double wall(void)
{
    return seconds(CLOCK_MONOTONIC);
}

static void add_sample(bench *b, int row, int column, double value)
{
    int *count = &b->table.counts[row][column];
    if (!b->warming_up && *count < MAX_RUNS) b->table.samples[row][column][(*count)++] = value;
}

static void *allocate(size_t size)
{
    void *memory = malloc(size);
    if (memory == NULL) {
        fputs("bench: out of memory\n", stderr);
        exit(1);
    }
    return memory;
}

// Ends the program, or the child process that measures, when the library refuses.
static void expect(const bench *b, subdiv_result result)
{
    if (result == SUBDIV_OK) return;
    fprintf(stderr, "bench: %s: %s\n", b->name, subdiv_result_string(result));
    exit(1);
}

// ------------------------------------------------------------------------------------- threads

// One more thread, which shares the jobs of a call with the caller. Jobs are as short as a few
// microseconds, so they are dealt without the lock.
typedef struct pool {
    pthread_t       thread;
    pthread_mutex_t lock;
    pthread_cond_t  start, end;
    void          (*job)(void *context, int i);
    void           *context;
    int             next, count;              // of the jobs
    int             calls, busy, closing;     // busy: the thread is among the jobs
} pool;

static void do_jobs(pool *p)
{
    for (int i; (i = __atomic_fetch_add(&p->next, 1, __ATOMIC_RELAXED)) < p->count; )
        p->job(p->context, i);
}

static void *help_out(void *user)
{
    pool *p = (pool *)user;
    int calls = 0;
    pthread_mutex_lock(&p->lock);
    while (!p->closing) {
        if (calls == p->calls) {
            pthread_cond_wait(&p->start, &p->lock);
            continue;
        }
        calls = p->calls;
        p->busy = 1;
        pthread_mutex_unlock(&p->lock);
        do_jobs(p);
        pthread_mutex_lock(&p->lock);
        p->busy = 0;
        pthread_cond_signal(&p->end);
    }
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

// Called with the lock held.
static void await_thread(pool *p)
{
    while (p->busy) pthread_cond_wait(&p->end, &p->lock);
}

static void pool_run(void *user, void (*job)(void *context, int i), void *context, int count)
{
    pool *p = (pool *)user;
    pthread_mutex_lock(&p->lock);
    await_thread(p);                          // it may have come too late for the last call
    p->job = job;
    p->context = context;
    p->next = 0;
    p->count = count;
    p->calls++;
    pthread_cond_signal(&p->start);
    pthread_mutex_unlock(&p->lock);
    do_jobs(p);
    pthread_mutex_lock(&p->lock);
    await_thread(p);
    pthread_mutex_unlock(&p->lock);
}

static void pool_open(pool *p)
{
    memset(p, 0, sizeof *p);
    pthread_mutex_init(&p->lock, NULL);
    pthread_cond_init(&p->start, NULL);
    pthread_cond_init(&p->end, NULL);
    if (pthread_create(&p->thread, NULL, help_out, p) != 0) {
        fputs("bench: no second thread\n", stderr);
        exit(1);
    }
}

static void pool_close(pool *p)
{
    pthread_mutex_lock(&p->lock);
    p->closing = 1;
    pthread_cond_signal(&p->start);
    pthread_mutex_unlock(&p->lock);
    pthread_join(p->thread, NULL);
    pthread_cond_destroy(&p->end);
    pthread_cond_destroy(&p->start);
    pthread_mutex_destroy(&p->lock);
}

// -------------------------------------------------------------------------------------- meshes

// Quads round both circles of a torus, or each of them cut into two triangles.
static void make_torus(subdiv_mesh *mesh, int rows, int columns, int triangles)
{
    const double turn = 6.283185307179586;
    mesh->vertex_count = rows * columns;
    mesh->face_size = triangles ? 3 : 4;
    mesh->face_count = rows * columns * (triangles ? 2 : 1);
    mesh->positions = (float *)allocate(3 * sizeof(float) * (size_t)mesh->vertex_count);
    mesh->face_vertices = (int *)allocate(sizeof(int) * (size_t)mesh->face_size
                                          * (size_t)mesh->face_count);
    float *p = mesh->positions;
    int *f = mesh->face_vertices;
    for (int r = 0; r < rows; r++) {
        for (int c = 0; c < columns; c++) {
            double u = turn * r / rows, v = turn * c / columns;
            *p++ = (float)((3 + cos(v)) * cos(u));
            *p++ = (float)((3 + cos(v)) * sin(u));
            *p++ = (float)sin(v);
            int below = (r + 1) % rows * columns, right = (c + 1) % columns;
            int quad[4] = {r * columns + c, below + c, below + right, r * columns + right};
            for (int i = 0; i < mesh->face_size; i++) *f++ = quad[i];
            for (int i = 0; triangles && i < 3; i++) *f++ = quad[(i + 2) % 4];
        }
    }
}

// A mesh of make_torus is freed here, the library's own by the library.
static void free_cage(subdiv_mesh *cage)
{
    if (cage->memory == NULL) {
        free(cage->positions);
        free(cage->face_vertices);
    }
    subdiv_mesh_free(cage);
}

static int cage_face_size(const subdiv_mesh *cage, int f)
{
    return cage->face_size ? cage->face_size : cage->face_sizes[f];
}

// The points of a grid on face f, or on each quad of an n-gon, edges and vertices included.
static int count_grid(const bench *b, int f)
{
    int size = cage_face_size(&b->cage, f), n = TESSELLATION_RATE;
    if (b->face_size == 3) return (n + 1) * (n + 2) / 2;
    return size == 4 ? (n + 1) * (n + 1) : size * (n / 2 + 1) * (n / 2 + 1);
}

// Takes so many levels, and counts what the result has. Returns 0 when it is more than the most.
static int take_levels(bench *b, int levels, int most)
{
    subdiv_info info;
    expect(b, subdiv_inspect(&info, &b->cage, NULL));
    int loop = b->cage.scheme == SUBDIV_LOOP;
    long long vertices = info.vertex_count, edges = info.edge_count, faces = info.face_count;
    long long face_vertices = 0;
    for (int f = 0; f < b->cage.face_count; f++)
        face_vertices += cage_face_size(&b->cage, f);
    for (int l = 0; l < levels; l++) {
        vertices += loop ? edges : edges + faces;
        edges = 2 * edges + (loop ? 3 * faces : face_vertices);
        faces = loop ? 4 * faces : face_vertices;
        face_vertices = (loop ? 3 : 4) * faces;
        if (vertices > most || faces > INT_MAX) return 0;
    }
    b->levels = levels;
    b->vertex_count = (int)vertices;
    b->face_count = (int)faces;
    b->face_size = loop ? 3 : 4;
    b->tessellated_count = 0;
    for (int f = 0; f < b->cage.face_count; f++)
        b->tessellated_count += count_grid(b, f);
    return 1;
}

// Cuts the last :part off text when it is a level or the name of a scheme. Returns 0 if it is not.
static int cut_part(char *text, int *level, subdiv_scheme *scheme)
{
    static const char *names[] = {"catmull-clark", "loop", "bilinear"};
    char *part = strrchr(text, ':');
    if (part == NULL) return 0;
    int found = 0;
    for (int i = 0; i < 3; i++) {
        if (strcmp(part + 1, names[i]) != 0) continue;
        *scheme = (subdiv_scheme)i;
        found = 1;
    }
    if (part[1] >= '1' && part[1] <= '9' && part[2] == 0) {
        *level = part[1] - '0';
        found = 1;
    }
    if (found) *part = 0;
    return found;
}

// Returns whether it could. The name is cut to the file's.
static int open_bench(bench *b, char *text)
{
    subdiv_error error = {0};
    subdiv_options opt = {0};
    subdiv_scheme scheme = SUBDIV_CATMULL_CLARK;
    int level = 0;
    opt.error = &error;
    memset(b, 0, sizeof *b);
    while (cut_part(text, &level, &scheme)) continue;
    b->name = text;
    if (strcmp(text, "torus") == 0 || strcmp(text, "torus-triangles") == 0) {
        int triangles = text[5] == '-';
        make_torus(&b->cage, triangles ? TORUS_SIDE / 2 : TORUS_SIDE, TORUS_SIDE, triangles);
    } else if (subdiv_load_obj(&b->cage, text, &opt)) {
        fprintf(stderr, "bench: %s\n", error.message);
        return 0;
    }
    b->cage.uv_count = 0;                     // OpenSubdiv refines positions alone
    b->cage.colors = NULL;
    b->cage.scheme = scheme;
    int fits = take_levels(b, level ? level : 1, INT_MAX);
    while (fits && level == 0 && take_levels(b, b->levels + 1, MOST_VERTICES)) continue;
    if (!fits) fprintf(stderr, "bench: %s: too many vertices at level %d\n", b->name, level);
    if (fits && library) b->rival = library->open(&b->cage, b->levels);
    return fits;
}

static void close_bench(bench *b)
{
    if (b->rival) library->close(b->rival);
    free_cage(&b->cage);
}

// ------------------------------------------------------------------------------------ measuring

// A call that the compiler cannot leave out.
static void *(*volatile fill)(void *, int, size_t) = memset;

// Whether a stage goes on after so many rounds.
static int go_on(int rounds, double start)
{
    return rounds < MIN_RUNS || (rounds < MAX_RUNS && wall() - start < stage_seconds);
}

static size_t position_bytes(const bench *b, int channels)
{
    return (size_t)channels * sizeof(float) * (size_t)b->vertex_count;
}

static size_t face_bytes(const bench *b)
{
    return (size_t)b->face_size * sizeof(int) * (size_t)b->face_count;
}

// Positions, faces and cage_faces.
static size_t result_bytes(const bench *b)
{
    return position_bytes(b, 3) + face_bytes(b) + sizeof(int) * (size_t)b->face_count;
}

// Runs work in a process of its own, whose memory is fresh and as the system gives it, and takes
// over the samples that it adds.
static int in_child(bench *b, void (*work)(bench *b))
{
    int ends[2];
    fflush(stdout);
#ifdef __GLIBC__
    malloc_trim(0);
#endif
    if (pipe(ends) != 0) return 0;
    pid_t child = fork();
    if (child < 0) return 0;
    if (child == 0) {
        work(b);
        _exit(write(ends[1], &b->table, sizeof b->table) == (ssize_t)sizeof b->table ? 0 : 1);
    }
    close(ends[1]);
    table result;
    size_t size = 0;
    for (ssize_t got = 1; got > 0 && size < sizeof result; size += got > 0 ? (size_t)got : 0)
        got = read(ends[0], (char *)&result + size, sizeof result - size);
    close(ends[0]);
    waitpid(child, NULL, 0);
    if (size < sizeof result) return 0;
    b->table = result;
    return 1;
}

// The largest size of this process in memory so far.
static double peak_bytes(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
    return (double)usage.ru_maxrss;
#else
    return 1024 * (double)usage.ru_maxrss;
#endif
}

static void cold_ours(bench *b)
{
    subdiv_mesh fine;
    double before = peak_bytes(), start = now();
    expect(b, subdiv_refine(&fine, &b->cage, b->levels, NULL));
    add_sample(b, COLD, OURS, now() - start);
    add_sample(b, PEAK, OURS, peak_bytes() - before);
}

static void cold_theirs(bench *b)
{
    double before = peak_bytes(), start = now();
    if (!library->prepare(b->rival, 0)) return;
    int vertex_count = library->result(b->rival);
    add_sample(b, COLD, THEIRS, now() - start);
    add_sample(b, PEAK, THEIRS, peak_bytes() - before);
    if (vertex_count != b->vertex_count)
        fprintf(stderr, "bench: %s: %d vertices from %s\n", b->name, vertex_count, library->name);
}

static void cold_limit(bench *b)
{
    double start = now();
    fill(allocate(result_bytes(b)), 1, result_bytes(b));
    add_sample(b, COLD, LIMIT, now() - start);
    add_sample(b, PEAK, LIMIT, (double)result_bytes(b));
}

static void warm_limit(bench *b, int row, void *memory, size_t size)
{
    double start = now();
    fill(memory, row, size);
    add_sample(b, row, LIMIT, now() - start);
}

// What is freed stays with the process, so that the next run uses it again.
static void keep_memory(void)
{
#ifdef __GLIBC__
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, -1);
#endif
}

static void warm_refine(bench *b)
{
    keep_memory();
    void *memory = allocate(result_bytes(b));
    double begin = wall();
    for (int round = -1; go_on(round, begin); round++) {
        b->warming_up = round < 0;
        subdiv_mesh fine;
        double start = now();
        expect(b, subdiv_refine(&fine, &b->cage, b->levels, NULL));
        add_sample(b, WARM, OURS, now() - start);
        subdiv_mesh_free(&fine);

        subdiv_surface *surface;
        start = now();
        expect(b, subdiv_prepare(&surface, &b->cage, b->levels, NULL));
        add_sample(b, PREPARE, OURS, now() - start);
        subdiv_surface_free(surface);

        start = now();
        if (b->rival && library->prepare(b->rival, 0)) {
            add_sample(b, PREPARE, THEIRS, now() - start);
            library->result(b->rival);
            add_sample(b, WARM, THEIRS, now() - start);
            library->discard(b->rival);
        }
        warm_limit(b, WARM, memory, result_bytes(b));
    }
}

// ----------------------------------------------------------------------------------- evaluation

typedef struct animation {
    subdiv_surface *surface;
    float *in;                        // [4 * vertex_count of the cage]   x y z and a weight
    float *out;                       // [4 * vertex_count]
    int   *faces;                     // [face_size * face_count]
    void  *scratch;                   // for 4 channels
    subdiv_options threads;
} animation;

static void evaluate_ours(bench *b, animation *a, int row, int channels, const subdiv_options *opt)
{
    const float *in = channels == 3 ? b->cage.positions : a->in;
    double start = opt ? wall() : now();
    expect(b, subdiv_evaluate(a->surface, channels, in, 0, a->out, 0, a->scratch, opt));
    add_sample(b, row, OURS, (opt ? wall() : now()) - start);
    warm_limit(b, row, a->out, position_bytes(b, channels));
}

static void evaluate_theirs(bench *b, const animation *a)
{
    double start = now();
    library->chained(b->rival, b->cage.positions);
    double chained = now();
    library->stencils(b->rival, 3, b->cage.positions);
    double stencils = now();
    library->stencils(b->rival, 4, a->in);
    double end = now();
    add_sample(b, CHAINED, THEIRS, chained - start);
    add_sample(b, STENCILS, THEIRS, stencils - chained);
    add_sample(b, FLOAT4, THEIRS, end - stencils);
}

// Theirs starts from the points of the last level, or from the cage as ours.
static void normals_theirs(bench *b)
{
    double start = now();
    library->chained(b->rival, b->cage.positions);
    double chained = now();
    library->normals(b->rival);
    double end = now();
    add_sample(b, NORMALS, THEIRS, end - chained);
    add_sample(b, NORMALS_CHAINED, THEIRS, end - start);
}

static void open_animation(bench *b, animation *a, pool *threads)
{
    subdiv_options none = {0};
    expect(b, subdiv_prepare(&a->surface, &b->cage, b->levels, NULL));
    a->in = (float *)allocate(4 * sizeof(float) * (size_t)b->cage.vertex_count);
    a->out = (float *)allocate(position_bytes(b, 4));
    a->faces = (int *)allocate(face_bytes(b));
    a->scratch = allocate(subdiv_scratch_size(a->surface, 4));
    a->threads = none;
    a->threads.run = pool_run;
    a->threads.user = threads;
    for (int v = 0; v < b->cage.vertex_count; v++) {
        memcpy(a->in + 4 * (size_t)v, b->cage.positions + 3 * (size_t)v, 3 * sizeof(float));
        a->in[4 * (size_t)v + 3] = 1;
    }
}

static void close_animation(animation *a)
{
    free(a->scratch);
    free(a->faces);
    free(a->out);
    free(a->in);
    subdiv_surface_free(a->surface);
}

static void evaluate(bench *b)
{
    pool threads;
    animation a;
    keep_memory();
    pool_open(&threads);
    open_animation(b, &a, &threads);
    int compare = b->rival && library->prepare(b->rival, 0);
    if (compare) library->tables(b->rival);
    double begin = wall();
    for (int round = -1; go_on(round, begin); round++) {
        b->warming_up = round < 0;
        evaluate_ours(b, &a, CHAINED, 3, NULL);
        evaluate_ours(b, &a, STENCILS, 3, NULL);
        evaluate_ours(b, &a, FLOAT4, 4, NULL);
        evaluate_ours(b, &a, THREADED, 3, &a.threads);
        if (compare) evaluate_theirs(b, &a);

        double start = now();
        expect(b, subdiv_surface_faces(a.surface, a.faces, NULL, NULL));
        add_sample(b, FACES, OURS, now() - start);
        warm_limit(b, FACES, a.faces, face_bytes(b));
    }
    if (compare) library->discard(b->rival);
    close_animation(&a);
    pool_close(&threads);
}

static void limit_normals(bench *b)
{
    subdiv_options opt = {0};
    subdiv_surface *surface;
    subdiv_limit out = {0};
    keep_memory();
    opt.limit = 1;
    expect(b, subdiv_prepare(&surface, &b->cage, b->levels, &opt));
    void *scratch = allocate(subdiv_scratch_size(surface, 3));
    out.positions = (float *)allocate(position_bytes(b, 6));
    out.normals = out.positions + 3 * (size_t)b->vertex_count;
    int compare = b->rival && library->prepare(b->rival, 1);
    double begin = wall();
    for (int round = -1; go_on(round, begin); round++) {
        b->warming_up = round < 0;
        double start = now();
        expect(b, subdiv_evaluate_limit(surface, b->cage.positions, 0, &out, scratch, NULL));
        double end = now();
        add_sample(b, NORMALS, OURS, end - start);
        add_sample(b, NORMALS_CHAINED, OURS, end - start);
        warm_limit(b, NORMALS, out.positions, position_bytes(b, 6));
        warm_limit(b, NORMALS_CHAINED, out.positions, position_bytes(b, 6));
        if (compare) normals_theirs(b);
    }
    if (compare) library->discard(b->rival);
    free(out.positions);
    free(scratch);
    subdiv_surface_free(surface);
}

// Without buffers: refines, then writes the vertices in a plain loop.
static void refill_plainly(bench *b, const subdiv_buffer *buffer, const subdiv_options *opt,
                           float *data)
{
    subdiv_mesh fine;
    double start = now();
    expect(b, subdiv_refine(&fine, &b->cage, b->levels, opt));
    for (int i = 0; i < buffer->vertex_count; i++, data += 6)
        for (int k = 0; k < 3; k++) {
            data[k] = fine.positions[3 * buffer->points[i] + k];
            data[3 + k] = fine.normals[3 * buffer->normals[i] + k];
        }
    add_sample(b, BUFFER, THEIRS, now() - start);
    subdiv_mesh_free(&fine);
}

static void refill_buffer(bench *b)
{
    subdiv_options opt = {0};
    subdiv_surface *surface;
    subdiv_mesh fine;
    subdiv_buffer buffer;
    subdiv_vertices out = {0};
    keep_memory();
    opt.limit = 1;
    expect(b, subdiv_prepare(&surface, &b->cage, b->levels, &opt));
    expect(b, subdiv_surface_mesh(&fine, surface, b->cage.positions, &opt));
    expect(b, subdiv_make_buffer(&buffer, &fine, 4, NULL));
    subdiv_mesh_free(&fine);
    void *scratch = allocate(subdiv_scratch_size(surface, 3));
    size_t size = 6 * sizeof(float) * (size_t)buffer.vertex_count;
    out.positions = (float *)allocate(size);
    out.normals = out.positions + 3;
    out.stride = 6;
    double begin = wall();
    for (int round = -1; go_on(round, begin); round++) {
        b->warming_up = round < 0;
        double start = now();
        expect(b, subdiv_evaluate_buffer(&buffer, surface, b->cage.positions, &out, scratch, NULL));
        add_sample(b, BUFFER, OURS, now() - start);
        refill_plainly(b, &buffer, &opt, out.positions);
        warm_limit(b, BUFFER, out.positions, size);
    }
    free(out.positions);
    free(scratch);
    subdiv_buffer_free(&buffer);
    subdiv_surface_free(surface);
}

// ---------------------------------------------------------------------------- the limit surface

typedef struct places {
    int    count;
    subdiv_location *at;
    float *out[3];                    // [3 * count] each: points, du, dv
} places;

static void make_places(places *p, int count)
{
    p->count = count;
    p->at = (subdiv_location *)allocate(sizeof(subdiv_location) * (size_t)count);
    for (int k = 0; k < 3; k++) p->out[k] = (float *)allocate(12 * (size_t)count);
}

static void free_places(places *p)
{
    for (int k = 0; k < 3; k++) free(p->out[k]);
    free(p->at);
}

static unsigned next_random(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

// Random faces, and places in them, in an order that no memory likes.
static void choose_places(const bench *b, places *p)
{
    unsigned state = 1;
    for (int i = 0; i < p->count; i++) {
        subdiv_location *at = &p->at[i];
        at->face = (int)(next_random(&state) % (unsigned)b->cage.face_count);
        int size = cage_face_size(&b->cage, at->face), ngon = b->face_size == 4 && size != 4;
        at->corner = ngon ? (int)(next_random(&state) % (unsigned)size) : 0;
        at->u = (float)next_random(&state) / 16777216.0f;
        at->v = (float)next_random(&state) / 16777216.0f;
        if (b->face_size == 3 && at->u + at->v > 1) {
            at->u = 1 - at->u;
            at->v = 1 - at->v;
        }
    }
}

static void evaluate_places(const bench *b, const subdiv_surface *surface, const void *scratch,
                            const places *p, int derivatives)
{
    subdiv_derivatives out = {0};
    out.points = p->out[0];
    if (derivatives) out.du = p->out[1];
    if (derivatives) out.dv = p->out[2];
    expect(b, subdiv_evaluate_at(surface, 3, scratch, p->count, p->at, &out, NULL));
}

static void *open_surface(bench *b, subdiv_surface **surface)
{
    expect(b, subdiv_prepare(surface, &b->cage, SUBDIV_EXACT, NULL));
    void *scratch = allocate(subdiv_scratch_size(*surface, 3));
    expect(b, subdiv_evaluate_begin(*surface, 3, b->cage.positions, 0, scratch, NULL));
    return scratch;
}

static void close_surface(subdiv_surface *surface, void *scratch)
{
    free(scratch);
    subdiv_surface_free(surface);
}

static void sample_places(bench *b, const subdiv_surface *surface, const void *scratch,
                          const places *p, int row, int compare)
{
    int derivatives = row == SAMPLE_DERIVATIVES;
    double start = now();
    evaluate_places(b, surface, scratch, p, derivatives);
    double middle = now();
    if (compare) library->sample(b->rival, p->out[0], derivatives ? p->out[1] : NULL, p->out[2]);
    double end = now();
    add_sample(b, row, OURS, middle - start);
    if (compare) add_sample(b, row, THEIRS, end - middle);
}

static void sample_surfaces(bench *b)
{
    subdiv_surface *surface;
    places p;
    keep_memory();
    make_places(&p, SAMPLE_COUNT);
    choose_places(b, &p);
    void *scratch = open_surface(b, &surface);
    int compare = b->rival && library->surfaces(b->rival);
    if (compare) library->locate(b->rival, p.count, p.at);
    double begin = wall();
    for (int round = -1; go_on(round, begin); round++) {
        b->warming_up = round < 0;
        sample_places(b, surface, scratch, &p, SAMPLE, compare);
        sample_places(b, surface, scratch, &p, SAMPLE_DERIVATIVES, compare);
    }
    if (compare) library->discard(b->rival);
    close_surface(surface, scratch);
    free_places(&p);
}

static void tessellate_ours(bench *b)
{
    subdiv_mesh fine;
    subdiv_tessellation how = {0};
    how.rate = TESSELLATION_RATE;
    double start = now();
    expect(b, subdiv_tessellate(&fine, &b->cage, &how, NULL));
    add_sample(b, TESSELLATE, OURS, now() - start);
    subdiv_mesh_free(&fine);
}

static void surfaces_ours(bench *b)
{
    subdiv_surface *surface;
    double start = now();
    void *scratch = open_surface(b, &surface);
    add_sample(b, SURFACES, OURS, now() - start);
    close_surface(surface, scratch);
}

static void tessellate_theirs(bench *b, const places *p)
{
    double start = now();
    library->tessellate(b->rival, TESSELLATION_RATE, p->out[0], p->out[1], p->out[2]);
    add_sample(b, TESSELLATE, THEIRS, now() - start);
    library->discard(b->rival);
    start = now();
    if (library->surfaces(b->rival)) {
        add_sample(b, SURFACES, THEIRS, now() - start);
        library->discard(b->rival);
    }
}

static void tessellate(bench *b)
{
    places p;
    keep_memory();
    make_places(&p, b->tessellated_count);
    double begin = wall();
    for (int round = -1; go_on(round, begin); round++) {
        b->warming_up = round < 0;
        tessellate_ours(b);
        surfaces_ours(b);
        if (b->rival) tessellate_theirs(b, &p);
    }
    free_places(&p);
}

// -------------------------------------------------------------------------------------- report

static int compare_numbers(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print_heading(void)
{
    printf("subdiv.h");
    if (library) printf(" and %s", library->name);
    printf("\n%ld cores, %s, %s\n\n", sysconf(_SC_NPROCESSORS_ONLN), BENCH_COMPILER, BENCH_FLAGS);
    printf(
        "Nanoseconds (for memory bytes) per vertex of the result; medians and minima. One thread,\n"
        "in the processor's time for it; two threads by the wall clock.\n"
        "one-shot    from cage to positions and faces; freeing them is not counted. Fresh memory:\n"
        "            each run in a new process. Re-used: what earlier runs have freed\n"
        "prepare     what evaluation needs; theirs: Create and RefineUniform, without stencils\n"
        "faces       the indices alone, into the caller's array\n"
        "evaluate    new positions (and a 4th channel), into the caller's array; theirs: chained\n"
        "            PrimvarRefiner::Interpolate, or StencilTable::UpdateValues\n"
        "limit +     limit positions and unit normals from new positions of the cage; theirs:\n"
        "  normals   PrimvarRefiner::Limit with two tangents and their product, from the refined\n"
        "            points alone, or from the cage by chained Interpolate as well\n"
        "buffer      positions and normals in a vertex buffer from new positions of the cage;\n"
        "            theirs: subdiv_refine to the limit and a plain loop that writes the vertices\n"
        "sample      the limit surface at random places, per place, surfaces ready; theirs: Bfr\n"
        "tessellate  from the cage, %d steps along each edge of it: ours, a mesh with normals;\n"
        "            theirs, points and two tangents on each face. Per point of all faces' grids\n"
        "memory      rise of the resident set of a new process at its peak, the result included\n"
        "speed-up    theirs / ours\n"
        "limit       memset of the bytes that ours writes, in memory of the same kind\n"
        "ratio       ours / limit\n\n", TESSELLATION_RATE);
}

// The samples of a cell in order; returns how many.
static int sort_cell(bench *b, int row, int column)
{
    int count = b->table.counts[row][column];
    qsort(b->table.samples[row][column], (size_t)count, sizeof(double), compare_numbers);
    return count;
}

static double median(const bench *b, int row, int column)
{
    return b->table.samples[row][column][b->table.counts[row][column] / 2];
}

static void print_row(bench *b, int row)
{
    int tessellated = row == SURFACES || row == TESSELLATE;
    int sampled = row == SAMPLE || row == SAMPLE_DERIVATIVES;
    double scale = (row == PEAK ? 1 : 1e9) / (sampled ? SAMPLE_COUNT : tessellated
                                              ? b->tessellated_count : b->vertex_count);
    size_t length = strcspn(row_names[row], b->rival ? "" : "|");   // theirs is behind the bar
    printf("  %-25.*s", (int)length, row_names[row]);
    for (int column = OURS; column <= THEIRS; column++) {
        if (sort_cell(b, row, column) == 0) {
            printf("%9s%9s", "-", "-");
            continue;
        }
        printf("%9.2f%9.2f", scale * median(b, row, column),
               scale * b->table.samples[row][column][0]);
    }
    double ours = median(b, row, OURS);
    if (b->table.counts[row][THEIRS] > 0) printf("%9.1fx", median(b, row, THEIRS) / ours);
    else printf("%10s", "-");
    if (sort_cell(b, row, LIMIT) > 0)
        printf("%9.2f%9.1fx", scale * median(b, row, LIMIT), ours / median(b, row, LIMIT));
    putchar('\n');
}

static void print_bench(bench *b)
{
    static const char *schemes[] = {"Catmull-Clark", "Loop", "bilinear"};
    printf("%s, %s, level %d: %d vertices, %d faces\n", b->name, schemes[b->cage.scheme],
           b->levels, b->vertex_count, b->face_count);
    printf("  %-25s%9s%9s%9s%9s%10s%9s%10s\n", "", "subdiv.h", "min", library ? "theirs" : "-",
           "min", "speed-up", "limit", "ratio");
    for (int row = 0; row < ROW_COUNT; row++)
        if (sort_cell(b, row, OURS) > 0
            && (b->rival || (row != STENCILS && row != NORMALS_CHAINED))) print_row(b, row);
    putchar('\n');
}

// Returns whether it could.
static int run_bench(char *text)
{
    bench b;
    int ok = open_bench(&b, text);
    double begin = wall();
    for (int round = 0; ok && go_on(round, begin); round++) {
        ok = in_child(&b, cold_ours);
        if (ok && b.rival) in_child(&b, cold_theirs);
        if (ok) in_child(&b, cold_limit);
    }
    ok = ok && in_child(&b, warm_refine) && in_child(&b, evaluate) && in_child(&b, limit_normals)
        && in_child(&b, refill_buffer) && in_child(&b, sample_surfaces)
        && in_child(&b, tessellate);
    if (ok) print_bench(&b);
    else fprintf(stderr, "bench: %s was not measured\n", b.name);
    close_bench(&b);
    return ok;
}

int main(int argc, char **argv)
{
    char built_in[][64] = {
        "torus:1", "torus-triangles:1:loop", "examples/cages/octopus.obj:1",
        "examples/cages/octopus.obj:2", "examples/cages/camera.obj:2",
        "examples/cages/whale.obj:2:loop", "examples/cages/camera.obj",
        "examples/cages/lotus.obj", "examples/cages/octopus.obj", "examples/cages/whale.obj:loop"
    };
    int ok = 1;
    print_heading();
    for (int i = 1; i < argc; i++) ok &= run_bench(argv[i]);
    for (size_t i = 0; argc < 2 && i < sizeof built_in / sizeof *built_in; i++)
        ok &= run_bench(built_in[i]);
    return !ok;
}
