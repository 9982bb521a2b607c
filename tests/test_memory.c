// Everything fails once: each allocation, alone and with all after it; each read and each write;
// each argument. The call then gives a code and a message, zeroes its outputs, leaves its inputs as
// they were, to the byte, and nothing on the heap. The user pointer reaches the allocator.
//
//     cc -I. tests/test_memory.c -o build/test_memory -lm && build/test_memory [CAGES]

#define _POSIX_C_SOURCE 200809L       // symlink, mkfifo and more
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#ifndef _WIN32
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

static void *heap_malloc(size_t size, void *user);
static void  heap_free(void *pointer, void *user);

#define SUBDIV_MALLOC(size, user)  heap_malloc(size, user)
#define SUBDIV_FREE(pointer, user) heap_free(pointer, user)

#define SDV_FULL_LEVELS 2              // so that level 3 has frames, as deep ones do
#define SDV_SEPARATE 1                 // each array is a block, which can fail
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/random_cage.h"
#include "lib/test.h"
#include "lib/same.h"

// ------------------------------------------------------------------------- the allocator's books

typedef struct block {                // the head of each block
    struct block *next, *previous;
    size_t size, mark;
} block;

static struct heap {
    block  blocks;                    // in a ring
    int    live, calls;
    int    first, last;               // these calls fail, counted from 1; 0: none
    int    wrong, foreign;            // frees of what is no block; other user pointers
} heap = { { &heap.blocks, &heap.blocks, 0, 0 }, 0, 0, 0, 0, 0, 0 };

enum { LIVE = 0x600d };

static void *heap_malloc(size_t size, void *user)
{
    heap.foreign += user != &heap;
    heap.calls++;
    if (heap.calls >= heap.first && heap.calls <= heap.last) return NULL;
    block *b = (block *)malloc(sizeof *b + size);
    if (!b) return NULL;
    memset(b + 1, 0xa5, size);                      // nobody may count on zeros
    b->size = size;
    b->mark = LIVE;
    b->next = &heap.blocks;
    b->previous = heap.blocks.previous;
    b->next->previous = b->previous->next = b;
    heap.live++;
    return b + 1;
}

static void heap_free(void *pointer, void *user)
{
    heap.foreign += user != &heap;
    if (!pointer) return;
    block *b = (block *)pointer - 1;
    if (b->mark != LIVE) {
        heap.wrong++;
        return;
    }
    b->next->previous = b->previous;
    b->previous->next = b->next;
    b->mark = 0;
    heap.live--;
    free(b);
}

// The sum of all bytes on the heap: cages, surfaces and what else a call may read but not write.
static unsigned long long heap_sum(void)
{
    unsigned long long sum = 0, word;
    for (const block *b = heap.blocks.next; b != &heap.blocks; b = b->next) {
        const char *bytes = (const char *)(b + 1);
        for (size_t i = 0; i + sizeof word <= b->size; i += sizeof word) {
            memcpy(&word, bytes + i, sizeof word);
            sum = (sum ^ word) * 0x9E3779B97F4A7C15u;
            sum ^= sum >> 29;
        }
        for (size_t i = b->size / sizeof word * sizeof word; i < b->size; i++)
            sum = (sum ^ (unsigned char)bytes[i]) * 0x9E3779B97F4A7C15u;
    }
    return sum;
}

// Does a step of a sequence, unless one has failed. A step that fails leaves the heap as it was.
#define TRY(step) do {                                                  \
        if (result) break;                                              \
        unsigned long long before = heap_sum();                         \
        result = (step);                                                \
        if (result) CHECK(heap_sum() == before);                        \
    } while (0)

static int is_filled(const void *bytes, size_t size, int value)
{
    for (size_t i = 0; i < size; i++)
        if (((const unsigned char *)bytes)[i] != value) return 0;
    return 1;
}

#define FILL(object) memset(&(object), 0x55, sizeof(object))
#define IS_ZERO(object) is_filled(&(object), sizeof(object), 0)

// ------------------------------------------------------------------------------------ the cages

static char *obj_text;                // what is loaded
static size_t obj_size, obj_capacity;

static void write_line(const char *format, int a, int b, int c)
{
    if (obj_capacity - obj_size < 100) obj_text = (char *)realloc(obj_text, obj_capacity += 200000);
    if (!obj_text) abort();
    obj_size += (size_t)snprintf(obj_text + obj_size, 100, format, a, b, c);
}

// A strip of coloured quads with UVs that ends in a pentagon and a triangle without, with
// statements, two warnings, and tags of each kind. It makes every growing array grow.
static void make_strip(void)
{
    enum { COUNT = 1500 };
    obj_size = 0;
    for (int i = 0; i < COUNT; i++) write_line("v %d %d %d 1 .5 0\n", i / 2, i % 2, i % 5);
    for (int i = 0; i < COUNT; i++) write_line("vt %d %d\n", i, i % 7, 0);
    for (int i = 1; i + 7 < COUNT; i += 2) {
        if (i % 5 == 0) write_line("usemtl m%d\n", i, 0, 0);
        write_line("f -%d/1 %d/%d", COUNT + 1 - i, i + 2, i + 2);
        write_line(" %d/3 %d/2\n", i + 3, i + 1, 0);
    }
    write_line("f %d %d %d", COUNT - 5, COUNT - 3, COUNT - 1);
    write_line(" %d %d\n", COUNT - 2, COUNT - 4, 0);
    write_line("f %d %d %d\n", COUNT - 1, COUNT, COUNT - 2);
    for (int i = 0; i + 9 < COUNT; i += 2) write_line("t crease 2/1/0 %d %d %d\n", i, i + 2, i % 3);
    for (int i = 0; i + 9 < COUNT; i += 7) write_line("t corner 1/1/0 %d %d\n", i, i % 11, 0);
    for (int i = 0; i + 9 < COUNT / 2; i += 5) write_line("t hole 1/0/0 %d\n", i, 0, 0);
    write_line("t hole 1/0/0 %d\n", 999999, 0, 0);
}

static void weigh(void *user, int valence, double weights[3])
{
    weights[0] = *(double *)user;
    weights[1] = weights[2] = (1 - weights[0]) / 2;
    if (valence == 3) weights[1] += weights[2], weights[2] = 0;
}

static void weigh_loop(void *user, int valence, double weights[3])
{
    (void)valence;
    weights[0] = *(double *)user;
    weights[1] = 1 - weights[0];
}

// A random cage with colours, statements and, sometimes, a vertex rule, on the heap.
static subdiv_mesh new_cage(unsigned seed, const subdiv_options *opt)
{
    static char group[] = "g a", smooth[] = "s 1", material[] = "usemtl stone";
    static float colors[3 * RANDOM_MAX_VERTICES];
    static double weight = 0.45;
    char *statements[3] = { group, smooth, material };
    random_cage *c = random_cage_new(seed, RANDOM_ALL);
    subdiv_mesh cage = {0}, mesh = c->mesh;
    int places[3] = { 0, mesh.face_count / 2, mesh.face_count };
    for (int i = 0; i < 3 * mesh.vertex_count; i++) colors[i] = (float)(i % 9) / 8;
    if (seed % 2) mesh.colors = colors;
    if (seed % 3) {
        mesh.statement_count = 3;
        mesh.statement_faces = places;
        mesh.statements = statements;
    }
    if (seed % 8 == 1 && mesh.scheme != SUBDIV_BILINEAR) {
        mesh.vertex_weights = mesh.scheme == SUBDIV_LOOP ? weigh_loop : weigh;
        mesh.vertex_user = &weight;
    }
    CHECK_EQUAL(subdiv_refine(&cage, &mesh, 0, opt), SUBDIV_OK);
    random_cage_free(c);
    return cage;
}

// ------------------------------------------------------------------------------------ the calls
// Each does its work once and returns the result. The cage is on the heap.

typedef struct trial {
    const subdiv_mesh *cage;
    int level;                        // 0 to 3
    int odd;                          // a bit to choose by
} trial;

typedef subdiv_result (*call)(const trial *t, const subdiv_options *opt);

static subdiv_result keep_nothing(subdiv_mesh *mesh, subdiv_result result)
{
    if (result) CHECK(mesh_is_zero(mesh));
    subdiv_mesh_free(mesh);
    return result;
}

static subdiv_result call_refine(const trial *t, const subdiv_options *opt)
{
    subdiv_mesh fine;
    FILL(fine);
    return keep_nothing(&fine, subdiv_refine(&fine, t->cage, t->level, opt));
}

static subdiv_result prepare(subdiv_surface **surface, const trial *t, int levels,
                             const subdiv_options *opt)
{
    FILL(*surface);
    subdiv_result result = subdiv_prepare(surface, t->cage, levels, opt);
    if (result) CHECK(*surface == NULL);
    return result;
}

static subdiv_result call_surface_mesh(const trial *t, const subdiv_options *opt)
{
    subdiv_mesh fine;
    subdiv_surface *surface;
    subdiv_result result = prepare(&surface, t, t->level, opt);
    memset(&fine, 0, sizeof fine);
    TRY(subdiv_surface_mesh(&fine, surface, t->cage->positions, opt));
    result = keep_nothing(&fine, result);
    subdiv_surface_free(surface);
    return result;
}

// Evaluates so many channels of ones, with no scratch memory. Failures leave out alone.
static subdiv_result evaluate(const subdiv_surface *surface, int values, int channels,
                              const subdiv_limit *limit, const subdiv_options *opt)
{
    size_t size = (size_t)channels * (size_t)subdiv_surface_vertex_count(surface);
    float *in = (float *)malloc((size_t)(values * channels) * sizeof *in + 1);
    float *out = (float *)malloc(2 * size * sizeof *out + 1);
    subdiv_limit to = { out, out + size, NULL, 0, NULL };
    subdiv_result result = SUBDIV_OK;
    for (int i = 0; i < values * channels; i++) in[i] = 1;
    memset(out, 0x55, 2 * size * sizeof *out);
    if (limit) TRY(subdiv_evaluate_limit(surface, in, 0, &to, NULL, opt));
    else TRY(subdiv_evaluate(surface, channels, in, 0, out, 0, NULL, opt));
    CHECK(is_filled(out, size * sizeof *out, 0x55) == (result || size == 0));
    free(in), free(out);
    return result;
}

static subdiv_result call_evaluate(const trial *t, const subdiv_options *opt)
{
    subdiv_surface *surface;
    const subdiv_limit limit = {0};
    subdiv_result result = prepare(&surface, t, t->level, opt);
    TRY(evaluate(surface, t->cage->vertex_count, 5, NULL, opt));
    if (opt->limit) TRY(evaluate(surface, t->cage->vertex_count, 3, &limit, opt));
    subdiv_surface_free(surface);
    return result;
}

// Values of the faces' own at every other face.
static subdiv_result call_values(const trial *t, const subdiv_options *opt)
{
    static int indices[RANDOM_MAX_FACES * RANDOM_MAX_SIZE];
    const subdiv_mesh *cage = t->cage;
    int count = 0, values = cage->vertex_count, levels = t->odd ? SUBDIV_EXACT : t->level;
    subdiv_surface *surface;
    subdiv_result result = SUBDIV_OK;
    for (int f = 0; f < cage->face_count; f++)
        for (int i = 0; i < sdv_face_size(cage, f); i++, count++)
            indices[count] = f % 2 ? values++ : f % 5 == 4 ? -1 : cage->face_vertices[count];
    FILL(surface);
    TRY(subdiv_prepare_face_varying(&surface, cage, values, indices,
                                    (subdiv_uv_rule)(t->level + t->odd), levels, opt));
    if (result) CHECK(surface == NULL);
    if (!t->odd) TRY(evaluate(surface, values, 2, NULL, opt));
    subdiv_surface_free(surface);
    return result;
}

enum { PLACES = 32 };

// Places in the middle of faces, and close to their vertices.
static int list_places(subdiv_location *at, const subdiv_mesh *cage, int loop)
{
    static const float u[4] = { 0, 1, 1, 0 }, v[4] = { 0, 0, 1, 1 };
    int count = 0;
    for (int f = 0; f < cage->face_count; f++) {
        int size = sdv_face_size(cage, f), ngon = !loop && size != 4;
        for (int i = 0; i < (loop ? 3 : size) && count < PLACES; i++) {
            subdiv_location middle = { f, ngon ? i : 0, 0.4f, 0.3f }, near_vertex = middle;
            near_vertex.u = ngon || loop ? 1e-4f : u[i] * 0.9998f + 1e-4f;
            near_vertex.v = ngon || loop ? 1e-5f : v[i] * 0.9998f + 1e-4f;
            at[count++] = middle;
            at[count++] = near_vertex;
        }
    }
    return count;
}

static subdiv_result call_exact(const trial *t, const subdiv_options *opt)
{
    subdiv_location at[PLACES];
    float points[3 * PLACES], normals[3 * PLACES], tangents[4 * PLACES];
    const subdiv_mesh *cage = t->cage;
    subdiv_derivatives out = { points, NULL, NULL, t->odd ? points : NULL, NULL, NULL, normals, 0 };
    subdiv_stencils stencils;
    subdiv_surface *surface;
    subdiv_result result = prepare(&surface, t, SUBDIV_EXACT, opt);
    if (result) return result;
    int count = list_places(at, cage, cage->scheme == SUBDIV_LOOP);
    void *scratch = malloc(subdiv_scratch_size(surface, 3));
    TRY(subdiv_evaluate_begin(surface, 3, cage->positions, 0, scratch, opt));
    TRY(subdiv_evaluate_at(surface, 3, scratch, count, at, &out, opt));
    if (cage->uv_count) TRY(subdiv_tangents_at(surface, scratch, count, at, tangents, 0, opt));
    free(scratch);
    FILL(stencils);
    if (result) memset(&stencils, 0, sizeof stencils);
    TRY(subdiv_stencils_at(&stencils, surface, count, at, opt));
    if (result) CHECK(IS_ZERO(stencils));
    subdiv_stencils_free(&stencils);
    subdiv_surface_free(surface);
    return result;
}

// A failure leaves the vertices as they were.
static subdiv_result call_buffers(const trial *t, const subdiv_options *opt)
{
    subdiv_mesh fine = {0};
    subdiv_buffer buffer = {0};
    subdiv_vertices out = {0};
    subdiv_surface *surface;
    subdiv_result result = prepare(&surface, t, t->level, opt);
    TRY(subdiv_surface_mesh(&fine, surface, t->cage->positions, opt));
    TRY((FILL(buffer), subdiv_make_buffer(&buffer, &fine, 4, opt)));
    if (result) CHECK(IS_ZERO(buffer));
    size_t size = 3 * sizeof(float) * (size_t)buffer.vertex_count;
    out.positions = (float *)malloc(size + 1);
    memset(out.positions, 0x55, size);
    TRY(subdiv_evaluate_buffer(&buffer, surface, t->cage->positions, &out, NULL, opt));
    CHECK(size == 0 || is_filled(out.positions, size, 0x55) == (result != SUBDIV_OK));
    free(out.positions);
    subdiv_buffer_free(&buffer);
    subdiv_mesh_free(&fine);
    subdiv_surface_free(surface);
    return result;
}

static subdiv_result call_stencils(const trial *t, const subdiv_options *opt)
{
    subdiv_stencils stencils;
    subdiv_surface *surface;
    subdiv_result result = prepare(&surface, t, t->level, opt);
    memset(&stencils, 0, sizeof stencils);
    TRY((FILL(stencils), subdiv_refined_stencils(&stencils, surface, 0,
                                                 subdiv_surface_vertex_count(surface), opt)));
    if (result) CHECK(IS_ZERO(stencils));
    subdiv_stencils_free(&stencils);
    subdiv_surface_free(surface);
    return result;
}

static subdiv_result call_explain(const trial *t, const subdiv_options *opt)
{
    char text[8192];
    subdiv_result result = SUBDIV_OK;
    subdiv_explanation points;
    TRY((FILL(points), subdiv_explain_points(&points, t->cage, opt)));
    if (result) CHECK(IS_ZERO(points));
    subdiv_explanation_free(&points);
    for (int point = 0; point <= t->cage->vertex_count && !result; point += 9) {
        TRY((FILL(text), subdiv_explain(text, sizeof text, t->cage, point, opt)));
        CHECK((text[0] != 0) == (result == SUBDIV_OK));
    }
    return result;
}

static int rate_of_edge(void *user, int edge, const float *a, const float *middle, const float *b)
{
    (void)user;
    return 1 + edge % 3 + (a[0] < middle[0]) + (middle[0] < b[0]);
}

static subdiv_result call_tessellate(const trial *t, const subdiv_options *opt)
{
    subdiv_mesh fine;
    subdiv_tessellation how = {0};
    how.edge_rate = t->odd ? rate_of_edge : NULL;
    how.rate = 1 + t->level;
    how.triangles = t->level == 2;
    FILL(fine);
    return keep_nothing(&fine, subdiv_tessellate(&fine, t->cage, &how, opt));
}

// Evaluation at a vertex with so many faces takes memory of its own.
static subdiv_result call_fan(const trial *t, const subdiv_options *opt)
{
    enum { FACES = 40 };
    static int triangles[3 * FACES];
    static float positions[3 * (FACES + 1)];
    trial fan_trial = *t;
    subdiv_mesh fan = {0};
    for (int i = 0; i < FACES; i++) {
        triangles[3 * i + 1] = 1 + i;
        triangles[3 * i + 2] = 1 + (i + 1) % FACES;
        positions[3 * i + 3] = (float)cos(i * 0.157079632679);
        positions[3 * i + 4] = (float)sin(i * 0.157079632679);
    }
    fan.vertex_count = 1 + FACES;
    fan.positions = positions;
    fan.face_count = FACES;
    fan.face_size = 3;
    fan.face_vertices = triangles;
    fan_trial.cage = &fan;
    subdiv_result result = call_exact(&fan_trial, opt);
    return result ? result : call_tessellate(&fan_trial, opt);
}

// A mesh that was to be changed stays as it was.
#define TRY_CHANGE(mesh, step) do {                                     \
        if (result) break;                                              \
        subdiv_mesh mesh_before = (mesh);                               \
        TRY(step);                                                      \
        if (result) CHECK(memcmp(&(mesh), &mesh_before, sizeof(mesh)) == 0); \
    } while (0)

static subdiv_result call_normals(const trial *t, const subdiv_options *opt)
{
    subdiv_mesh mesh = *t->cage;
    subdiv_result result = SUBDIV_OK;
    mesh.memory = NULL;
    TRY_CHANGE(mesh, subdiv_normals(&mesh, opt));
    mesh.normals = NULL;
    TRY_CHANGE(mesh, subdiv_normals_by_angle(&mesh, 20, opt));
    subdiv_mesh_free(&mesh);
    return result;
}

static subdiv_result call_creases(const trial *t, const subdiv_options *opt)
{
    const int two = 2, ends[2] = { 0, 1 };
    const float sharpness = 5, three[3] = { 1, 2, 1 };
    int joined[3];
    subdiv_mesh mesh = *t->cage;
    subdiv_result result = SUBDIV_OK;
    mesh.memory = NULL;
    TRY_CHANGE(mesh, subdiv_crease_by_angle(&mesh, 1, 2, opt));
    TRY_CHANGE(mesh, subdiv_crease_by_smoothing_groups(&mesh, 3, opt));
    TRY_CHANGE(mesh, subdiv_crease_by_uv_seams(&mesh, 4, opt));
    TRY_CHANGE(mesh, subdiv_crease_chains(&mesh, 1, &two, ends, 1, &sharpness, opt));
    TRY(subdiv_join_values(joined, 1, 3, three, opt));
    subdiv_mesh_free(&mesh);
    return result;
}

static void count_finding(void *user, const subdiv_finding *finding)
{
    *(int *)user += finding->text[0] != 0;
}

static subdiv_result call_inspect(const trial *t, const subdiv_options *opt)
{
    int counts[SUBDIV_ODDITY_COUNT], findings = 0;
    subdiv_info info;
    subdiv_result result = SUBDIV_OK;
    FILL(info);
    TRY(subdiv_inspect(&info, t->cage, opt));
    if (result) {
        CHECK(IS_ZERO(info));
        return result;
    }
    FILL(counts);
    TRY(subdiv_check(counts, t->cage, count_finding, &findings, opt));
    if (result) CHECK(IS_ZERO(counts));
    for (int i = 0; i < SUBDIV_ODDITY_COUNT; i++) findings -= counts[i];
    CHECK_EQUAL(findings, 0);
    return result;
}

// -------------------------------------------------------------------------- reading and writing

typedef struct pipe_end {             // of which one call fails
    size_t at, step;                  // bytes read; of each call at most
    int    calls, fail_at;
    size_t lost;                      // what the failing write loses
} pipe_end;

static size_t read_text(void *user, void *bytes, size_t size)
{
    pipe_end *p = (pipe_end *)user;
    size_t n = obj_size - p->at;
    if (++p->calls == p->fail_at) return (size_t)-1;
    if (n > size) n = size;
    if (n > p->step) n = p->step;
    memcpy(bytes, obj_text + p->at, n);
    p->at += n;
    return n;
}

static size_t write_away(void *user, const void *bytes, size_t size)
{
    pipe_end *p = (pipe_end *)user;
    (void)bytes;
    if (++p->calls != p->fail_at) return size;
    errno = ENOSPC;
    return size - (p->lost < size ? p->lost : size);
}

static subdiv_result load(subdiv_read read, void *user, const subdiv_options *opt)
{
    subdiv_mesh mesh;
    FILL(mesh);
    if (!read) return keep_nothing(&mesh, subdiv_load_obj_memory(&mesh, obj_text, obj_size, opt));
    return keep_nothing(&mesh, subdiv_load_obj_callback(&mesh, read, user, opt));
}

static subdiv_result call_load(const trial *t, const subdiv_options *opt)
{
    pipe_end p = { 0, 4096, 0, 0, 0 };
    return t->odd ? load(NULL, NULL, opt) : load(read_text, &p, opt);
}

static subdiv_result write_to(pipe_end *p, const trial *t, const subdiv_options *opt)
{
    size_t size = 7;
    subdiv_surface *surface;
    subdiv_options part = *opt;
    subdiv_result result = SUBDIV_OK;
    part.part_count = 3, part.part = 1 + t->odd;
    TRY(subdiv_save_obj_callback(t->cage, write_away, p, opt));
    TRY(subdiv_save_obj_memory(t->cage, NULL, 0, &size, opt));
    CHECK((size == 0 || p->calls == p->fail_at) == (result != SUBDIV_OK));
    if (result) return result;
    result = prepare(&surface, t, t->level, opt);
    TRY(subdiv_stream_obj_callback(surface, t->cage->positions, write_away, p, opt));
    TRY(subdiv_stream_obj_callback(surface, t->cage->positions, write_away, p, &part));
    subdiv_surface_free(surface);
    return result;
}

static subdiv_result call_write(const trial *t, const subdiv_options *opt)
{
    pipe_end p = {0};
    return write_to(&p, t, opt);
}

static const char path[] = "build/test_memory.obj", beside[] = "build/test_memory.obj.0.tmp";

static void write_path(const char *name, const char *text)
{
    FILE *file = fopen(name, "wb");
    if (!file) abort();
    fputs(text, file);
    fclose(file);
}

// Is this the file's text, and is there nothing beside it?
static int path_has(const char *text)
{
    char found[100] = "";
    FILE *file = fopen(path, "rb"), *other = fopen(beside, "rb");
    if (other) fclose(other);
    if (!file) return 0;
    size_t size = fread(found, 1, sizeof found - 1, file);
    fclose(file);
    return !other && size == strlen(text) && memcmp(found, text, size) == 0;
}

// A file stays as it was until the new one is whole.
static subdiv_result call_files(const trial *t, const subdiv_options *opt)
{
    subdiv_mesh mesh;
    subdiv_surface *surface;
    subdiv_result result = prepare(&surface, t, t->level, opt);
    for (int i = 0; i < 2 && !result; i++) {
        write_path(path, "kept");
        if (i) TRY(subdiv_stream_obj(surface, t->cage->positions, path, opt));
        else TRY(subdiv_save_obj(t->cage, path, opt));
        CHECK(path_has("kept") == (result != SUBDIV_OK));
    }
    FILL(mesh);
    if (result) memset(&mesh, 0, sizeof mesh);
    TRY(subdiv_load_obj(&mesh, path, opt));
    subdiv_surface_free(surface);
    return keep_nothing(&mesh, result);
}

// ------------------------------------------------------------------------------- out of memory

// Lends the caller's own thread, and has it do the last job first.
static void run_backward(void *user, void (*job)(void *context, int i), void *context, int count)
{
    heap.foreign += user != &heap;
    while (count--) job(context, count);
}

static int cages = 5;                 // random ones

static void check_error(const subdiv_error *error, subdiv_result code)
{
    CHECK_EQUAL(error->code, code);
    CHECK(error->message[0] && strcmp(error->message, "stale") != 0);
}

static int failed_allocations;

// Runs a call once to count its allocations; then with each of them failing, alone and with all
// later ones.
static void check_call(call run, const trial *t, subdiv_options opt)
{
    subdiv_error error = {0};
    opt.error = &error;
    heap.calls = heap.first = heap.last = 0;
    CHECK_EQUAL(run(t, &opt), SUBDIV_OK);
    int count = heap.calls, live = heap.live;
    subdiv_mesh before = *t->cage;
    unsigned long long sum = heap_sum();
    for (int k = 1; k <= 2 * count; k++) {
        heap.calls = 0;
        heap.first = (k + 1) / 2;
        heap.last = k % 2 ? heap.first : INT_MAX;
        error.code = SUBDIV_OK;
        strcpy(error.message, "stale");
        CHECK_EQUAL(run(t, &opt), SUBDIV_ERROR_MEMORY);
        check_error(&error, SUBDIV_ERROR_MEMORY);
        CHECK_EQUAL(heap.live, live);
        CHECK(heap_sum() == sum && memcmp(&before, t->cage, sizeof before) == 0);
    }
    heap.first = heap.last = 0;
    failed_allocations += 2 * count;
}

// Options that change what is allocated, by the bits of a number.
static subdiv_options options_of(unsigned bits)
{
    subdiv_options opt = {0};
    opt.user = &heap;
    opt.triangulate = 1;
    opt.keep_holes = bits & 1;
    opt.limit = bits >> 1 & 1;
    opt.linear = (bits >> 2 & 3) == 3;
    opt.run = bits >> 4 & 1 ? run_backward : NULL;
    return opt;
}

static const struct { const char *name; call run; int exact; } calls[] = {
    { "refine", call_refine, 0 },         { "surface_mesh", call_surface_mesh, 0 },
    { "evaluate", call_evaluate, 0 },     { "values", call_values, 0 },
    { "exact", call_exact, 1 },           { "stencils", call_stencils, 0 },
    { "explain", call_explain, 0 },       { "tessellate", call_tessellate, 1 },
    { "normals", call_normals, 0 },       { "creases", call_creases, 0 },
    { "inspect", call_inspect, 0 },       { "write", call_write, 0 },
    { "files", call_files, 0 },           { "buffers", call_buffers, 0 },
};

static void test_random_cages(void)
{
    static char context[100];
    for (unsigned seed = 1; seed <= (unsigned)cages; seed++) {
        subdiv_options opt = options_of(0);
        subdiv_mesh cage = new_cage(seed, &opt);
        for (unsigned i = 0; i < sizeof calls / sizeof *calls; i++) {
            unsigned bits = (seed + i) * 0x9E3779B9u >> 16;
            trial t = { &cage, (int)(bits >> 5 & 3), (int)(bits >> 7 & 1) };
            if (calls[i].exact && cage.vertex_weights) continue;          // has no exact surface
            snprintf(context, sizeof context, "%s of cage %u", calls[i].name, seed);
            test_context = context;
            check_call(calls[i].run, &t, options_of(bits));
        }
        subdiv_mesh_free(&cage);
    }
    CHECK_EQUAL(heap.live, 0);
}

// A text that makes all arrays grow, and a vertex with many faces.
static void test_large(void)
{
    subdiv_mesh none = {0};
    for (int odd = 0; odd < 2; odd++) {
        trial t = { &none, 1, odd };
        check_call(call_load, &t, options_of(0));
        if (odd) check_call(call_fan, &t, options_of(0));
    }
    CHECK_EQUAL(heap.live, 0);
}

// ----------------------------------------------------------------------------- failing transfers

static void test_failing_reads(void)
{
    subdiv_error error = {0};
    subdiv_options opt = options_of(0);
    pipe_end p = { 0, 1000, 0, 0, 0 };
    opt.error = &error;
    CHECK_EQUAL(load(read_text, &p, &opt), SUBDIV_OK);
    int count = p.calls;
    CHECK(count > 40);
    for (int k = 1; k <= count; k++) {
        pipe_end bad = { 0, 1000, 0, k, 0 };
        strcpy(error.message, "stale");
        CHECK_EQUAL(load(read_text, &bad, &opt), SUBDIV_ERROR_IO);
        check_error(&error, SUBDIV_ERROR_IO);
        CHECK_EQUAL(bad.calls, k);
        CHECK_EQUAL(heap.live, 0);
    }
}

// A byte is lost, or all.
static void test_failing_writes(void)
{
    subdiv_error error = {0};
    for (unsigned seed = 1; seed <= (unsigned)cages; seed++) {
        subdiv_options opt = options_of(seed);
        subdiv_mesh cage = new_cage(seed, &opt), before = cage;
        const trial t = { &cage, (int)seed % 4, 0 };
        pipe_end p = {0};
        opt.error = &error;
        CHECK_EQUAL(write_to(&p, &t, &opt), SUBDIV_OK);
        unsigned long long sum = heap_sum();
        for (int k = 1; k <= 2 * p.calls; k++) {
            pipe_end bad = { 0, 0, 0, (k + 1) / 2, k % 2 ? 1 : (size_t)-1 };
            strcpy(error.message, "stale");
            CHECK_EQUAL(write_to(&bad, &t, &opt), SUBDIV_ERROR_IO);
            check_error(&error, SUBDIV_ERROR_IO);
            CHECK(strstr(error.message, strerror(ENOSPC)) != NULL);
            CHECK_EQUAL(bad.calls, bad.fail_at);
            CHECK(heap_sum() == sum && memcmp(&before, &cage, sizeof cage) == 0);
        }
        subdiv_mesh_free(&cage);
        CHECK_EQUAL(heap.live, 0);
    }
}

// An error that is found half-way cleans up as well.
static void test_bad_texts(void)
{
    static const char *const endings[] = { "f 1 2 99999\n", "f 1 x\n", "v 1 2\n", "v 1 nan 2\n" };
    subdiv_options opt = options_of(0);
    for (int i = 0; i < 4; i++) {
        size_t before = obj_size;
        write_line(endings[i], 0, 0, 0);
        heap.calls = 0;
        CHECK(load(NULL, NULL, &opt) != SUBDIV_OK);
        obj_size = before;
        CHECK(heap.calls > 0);
        CHECK_EQUAL(heap.live, 0);
    }
}

// -------------------------------------------------------------------------------- files on disk

#ifndef _WIN32
static subdiv_error file_error;

static subdiv_result save_as(const char *name)
{
    float positions[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    int face[3] = { 0, 1, 2 };
    subdiv_mesh mesh = {0};
    subdiv_options opt = options_of(0);
    opt.error = &file_error;
    mesh.vertex_count = mesh.face_size = 3;
    mesh.face_count = 1;
    mesh.positions = positions;
    mesh.face_vertices = face;
    subdiv_result result = subdiv_save_obj(&mesh, name, &opt);
    CHECK((result == SUBDIV_OK) == !file_error.message[0]);
    if (result) CHECK(strstr(file_error.message, name) == file_error.message);
    return result;
}

static const char saved_text[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

static int mode_of(const char *name)
{
    struct stat status;
    return lstat(name, &status) ? -1 : (int)status.st_mode;
}

// What a name stands for stays: permissions, links and what they lead to, devices, pipes, folders.
static void test_kinds_of_files(void)
{
    const char *link = "build/test_memory.link", *pipe = "build/test_memory.pipe";
    write_path(path, "kept");
    CHECK(!chmod(path, 0640));
    write_path(beside, "of another writer");
    CHECK_EQUAL(save_as(path), SUBDIV_OK);
    CHECK_EQUAL(mode_of(path) & 0777, 0640);
    CHECK(mode_of(beside) > 0);
    remove(beside);
    CHECK(path_has(saved_text));

    remove(link), remove(pipe);
    write_path(path, "kept");
    CHECK(!symlink("test_memory.obj", link) && !mkfifo(pipe, 0600));
    CHECK_EQUAL(save_as(link), SUBDIV_OK);
    CHECK(S_ISLNK(mode_of(link)) && path_has(saved_text));
    remove(path);
    CHECK_EQUAL(save_as(link), SUBDIV_OK);          // to a file that is not there yet
    CHECK(S_ISLNK(mode_of(link)) && path_has(saved_text));
    remove(link);
    CHECK(!symlink("/dev/full", link));             // a mistake replaces the link, not the device
    CHECK_EQUAL(save_as(link), mode_of("/dev/full") > 0 ? SUBDIV_ERROR_IO : SUBDIV_OK);
    CHECK(!file_error.message[0] || strstr(file_error.message, strerror(ENOSPC)));
    CHECK(S_ISLNK(mode_of(link)));
    char text[100] = "";
    int reader = open(pipe, O_RDONLY | O_NONBLOCK);
    CHECK_EQUAL(save_as(pipe), SUBDIV_OK);
    CHECK(read(reader, text, sizeof text) == (int)strlen(saved_text) && !strcmp(text, saved_text));
    CHECK(S_ISFIFO(mode_of(pipe)));
    close(reader);
    CHECK_EQUAL(save_as("build"), SUBDIV_ERROR_IO);
    remove(link), remove(pipe), remove(path);
}

// A full disk leaves the old file.
static void test_full_disk(void)
{
    struct rlimit before, small;
    CHECK(!getrlimit(RLIMIT_FSIZE, &before));
    small = before;
    small.rlim_cur = 20;
    write_path(path, "kept");
    signal(SIGXFSZ, SIG_IGN);
    CHECK(!setrlimit(RLIMIT_FSIZE, &small));
    CHECK_EQUAL(save_as(path), SUBDIV_ERROR_IO);
    setrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, SIG_DFL);
    CHECK(path_has("kept"));
    remove(path);
}

// Read-only files stay. In a folder that takes no new files, others are written in place.
static void test_read_only(void)
{
    static const struct { mode_t folder, file; subdiv_result result; } cases[] = {
        { 0777, 0444, SUBDIV_ERROR_IO }, { 0555, 0444, SUBDIV_ERROR_IO },
        { 0555, 0666, SUBDIV_OK } };
    const char *folder = "build/test_memory.folder", *file = "build/test_memory.folder/a.obj";
    const char *none = "build/test_memory.folder/b.obj";
    int is_root = geteuid() == 0;                   // may write anything: be somebody else
    struct stat status;
    CHECK(!mkdir(folder, 0755));
    write_path(file, "kept");
    for (int i = 0; i < 3; i++) {
        subdiv_result result = cases[i].result;
        CHECK(!chmod(file, cases[i].file) && !chmod(folder, cases[i].folder));
        if (is_root) CHECK(!seteuid(65534));
        int is_there = access(file, F_OK) == 0;     // the folders above may hide it from others
        if (is_there) CHECK_EQUAL(save_as(file), result);
        if (is_there && i) CHECK_EQUAL(save_as(none), SUBDIV_ERROR_IO);
        if (is_root) CHECK(!seteuid(0));
        CHECK(!stat(file, &status));
        if (is_there) CHECK_EQUAL(status.st_size, result ? 4 : (off_t)strlen(saved_text));
    }
    chmod(folder, 0755);
    remove(file), remove(none), remove(folder);
}
#endif

// ------------------------------------------------------------------------------ wrong arguments

// All that a call may write to. What is not passed, and each array, stays as it was; what else is
// passed is zeroed.
static struct outputs {
    subdiv_mesh fine;
    subdiv_surface *made;
    subdiv_stencils stencils;
    subdiv_explanation explanation;
    subdiv_buffer buffer;
    subdiv_info info;
    int   counts[SUBDIV_ODDITY_COUNT];
    size_t size;
    char  text[64];
    float out[6 * 400];
    int   ints[6 * 400];
} o;
static pipe_end sink;

static int is_kept(const char *call, const char *name, const void *output, size_t size)
{
    const char *found = strstr(call, name);
    size_t length = strlen(name);
    int passed = found && strchr(",)", found[length]);
    return is_filled(output, size, passed ? 0 : 0x55);
}

#define KEPT(name, output) CHECK(is_kept(call, name, &(output), sizeof(output)))

static void check_outputs(const char *call)
{
    KEPT("&o.fine", o.fine);
    KEPT("&o.made", o.made);
    KEPT("&o.stencils", o.stencils);
    KEPT("&o.explanation", o.explanation);
    KEPT("&o.buffer", o.buffer);
    KEPT("&o.info", o.info);
    KEPT("o.counts", o.counts);
    KEPT("&o.size", o.size);
    CHECK(o.text[0] == (strstr(call, "(o.text, ") && !strstr(call, "(o.text, 0") ? 0 : 0x55));
    CHECK(is_filled(o.text + 1, sizeof o.text - 1, 0x55));
    CHECK(is_filled(o.out, sizeof o.out, 0x55));
    CHECK(is_filled(o.ints, sizeof o.ints, 0x55));
    CHECK_EQUAL(sink.calls, 0);
}

static subdiv_error error;
static subdiv_options with_error, *const opt = &with_error;

#define WRONG(result, call) do {                                        \
        unsigned long long before = heap_sum();                         \
        int live = heap.live;                                           \
        error.code = SUBDIV_OK;                                         \
        strcpy(error.message, "stale");                                 \
        FILL(o);                                                        \
        test_context = #call;                                           \
        CHECK_EQUAL(call, SUBDIV_ERROR_##result);                         \
        check_error(&error, SUBDIV_ERROR_##result);                       \
        check_outputs(#call);                                           \
        CHECK(heap_sum() == before && heap.live == live);               \
        FILL(o);                                                        \
        opt->error = NULL;                                              \
        CHECK_EQUAL(call, SUBDIV_ERROR_##result);                         \
        opt->error = &error;                                            \
    } while (0)

// A cage, and surfaces of all kinds.
static struct kinds {
    subdiv_mesh cage;
    float *positions;
    subdiv_surface *copy, *plain, *limit, *exact, *values, *exact_values;
    subdiv_mesh fine;                 // of plain, and what draws it
    subdiv_buffer buffer;
    void *scratch;                    // enough for any
    int faces, points;                // of plain
} k;

static void make_kinds(void)
{
    k.cage = new_cage(10, opt);
    const subdiv_mesh *cage = &k.cage;
    k.positions = cage->positions;
    CHECK_EQUAL(subdiv_prepare(&k.copy, cage, 0, opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_prepare(&k.plain, cage, 1, opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_prepare(&k.exact, cage, SUBDIV_EXACT, opt), SUBDIV_OK);
    for (int exact = 0; exact < 2; exact++)
        CHECK_EQUAL(subdiv_prepare_face_varying(exact ? &k.exact_values : &k.values, cage,
                                                cage->vertex_count, cage->face_vertices,
                                                SUBDIV_UV_ALL, exact ? SUBDIV_EXACT : 1, opt),
                    SUBDIV_OK);
    with_error.limit = 1;
    CHECK_EQUAL(subdiv_prepare(&k.limit, cage, 1, opt), SUBDIV_OK);
    with_error.limit = 0;
    CHECK_EQUAL(subdiv_surface_mesh(&k.fine, k.plain, k.positions, opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_make_buffer(&k.buffer, &k.fine, 4, opt), SUBDIV_OK);
    k.scratch = malloc(1 << 20);
    k.faces = subdiv_surface_cage_face_count(k.plain);
    k.points = subdiv_surface_vertex_count(k.plain);
    CHECK(6 * k.points < (int)(sizeof o.out / sizeof *o.out));
    CHECK_EQUAL(subdiv_evaluate_begin(k.plain, 3, k.positions, 0, k.scratch, opt), SUBDIV_OK);
}

static void free_kinds(void)
{
    subdiv_surface *all[] = { k.copy, k.plain, k.limit, k.exact, k.values, k.exact_values };
    for (int i = 0; i < 6; i++) subdiv_surface_free(all[i]);
    subdiv_buffer_free(&k.buffer);
    subdiv_mesh_free(&k.fine);
    subdiv_mesh_free(&k.cage);
    free(k.scratch);
    CHECK_EQUAL(heap.live, 0);
}

static void wrong_preparation(void)
{
    const subdiv_mesh *cage = &k.cage;
    const int values = cage->vertex_count, *indices = cage->face_vertices;
    const subdiv_uv_rule all = SUBDIV_UV_ALL;
    WRONG(ARGUMENT, subdiv_refine(NULL, cage, 1, opt));
    WRONG(ARGUMENT, subdiv_refine(&o.fine, NULL, 1, opt));
    WRONG(ARGUMENT, subdiv_refine(&o.fine, cage, -1, opt));
    WRONG(ARGUMENT, subdiv_refine(&o.fine, cage, INT_MIN, opt));
    WRONG(TOO_LARGE, subdiv_refine(&o.fine, cage, INT_MAX, opt));
    WRONG(ARGUMENT, subdiv_refine(&k.cage, cage, 1, opt));
    WRONG(ARGUMENT, subdiv_prepare(NULL, cage, 1, opt));
    WRONG(ARGUMENT, subdiv_prepare(&o.made, NULL, 1, opt));
    WRONG(ARGUMENT, subdiv_prepare(&o.made, cage, -2, opt));
    WRONG(TOO_LARGE, subdiv_prepare(&o.made, cage, 31, opt));
    WRONG(ARGUMENT, subdiv_prepare_face_varying(NULL, cage, values, indices, all, 1, opt));
    WRONG(ARGUMENT, subdiv_prepare_face_varying(&o.made, NULL, values, indices, all, 1, opt));
    WRONG(ARGUMENT, subdiv_prepare_face_varying(&o.made, cage, 0, indices, all, 1, opt));
    WRONG(ARGUMENT, subdiv_prepare_face_varying(&o.made, cage, INT_MIN, indices, all, 1, opt));
    WRONG(ARGUMENT, subdiv_prepare_face_varying(&o.made, cage, values, NULL, all, 1, opt));
    WRONG(INDEX, subdiv_prepare_face_varying(&o.made, cage, 1, indices, all, 1, opt));
    WRONG(ARGUMENT, subdiv_prepare_face_varying(&o.made, cage, values, indices,
                                                (subdiv_uv_rule)6, 1, opt));
    WRONG(ARGUMENT, subdiv_prepare_face_varying(&o.made, cage, values, indices, all, -2, opt));
    WRONG(ARGUMENT, subdiv_surface_mesh(NULL, k.plain, k.positions, opt));
    WRONG(ARGUMENT, subdiv_surface_mesh(&o.fine, NULL, k.positions, opt));
    WRONG(ARGUMENT, subdiv_surface_mesh(&o.fine, k.plain, NULL, opt));
    WRONG(ARGUMENT, subdiv_surface_mesh(&o.fine, k.copy, NULL, opt));
    WRONG(ARGUMENT, subdiv_surface_mesh(&o.fine, k.exact, k.positions, opt));
    WRONG(ARGUMENT, subdiv_surface_mesh(&o.fine, k.values, k.positions, opt));
    WRONG(ARGUMENT, subdiv_surface_mesh(&o.fine, k.exact_values, k.positions, opt));
    WRONG(ARGUMENT, subdiv_surface_faces(NULL, o.ints, o.ints, opt));
    WRONG(ARGUMENT, subdiv_surface_faces(k.plain, NULL, o.ints, opt));
    WRONG(ARGUMENT, subdiv_surface_faces(k.copy, o.ints, NULL, opt));     // of several sizes
    WRONG(ARGUMENT, subdiv_surface_faces(k.exact, o.ints, NULL, opt));
}

static void wrong_evaluation(void)
{
    float *in = k.positions, *out = o.out;
    void *work = k.scratch;
    const subdiv_limit to = { o.out, NULL, NULL, 0, NULL }, narrow = { o.out, NULL, NULL, 2, NULL };
    const subdiv_limit tangents = { NULL, NULL, o.out, 5, NULL };
    const subdiv_limit negative = { o.out, NULL, NULL, -3, NULL };
    const int ranges[][4] = {         // first face, faces, first point, points: 8 too many is any
        { -1, 1, 0, 1 }, { 0, -1, 0, 1 }, { 0, k.faces + 1, 0, 1 }, { k.faces, 1, 0, 1 },
        { k.faces + 1, 0, 0, 1 }, { 1, INT_MAX, 0, 1 }, { INT_MAX, INT_MAX, 0, 1 },
        { INT_MIN, INT_MIN, 0, 1 }, { 0, 1, -1, 1 }, { 0, 1, 0, -1 }, { 0, 1, 1, k.points },
        { 0, 1, k.points, 1 }, { 0, 1, k.points + 1, 0 }, { 0, 1, 1, INT_MAX },
        { 0, 1, INT_MAX, INT_MAX }, { 0, 1, INT_MIN, INT_MIN } };
    WRONG(ARGUMENT, subdiv_evaluate(NULL, 3, in, 0, out, 0, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate(k.plain, 3, NULL, 0, out, 0, NULL, opt));
    WRONG(ARGUMENT, subdiv_evaluate(k.plain, 3, in, 0, NULL, 0, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate(k.plain, 0, in, 0, out, 0, NULL, opt));
    WRONG(ARGUMENT, subdiv_evaluate(k.plain, INT_MIN, in, 0, out, 0, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate(k.plain, 3, in, 2, out, 0, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate(k.plain, 3, in, 0, out, -3, NULL, opt));
    WRONG(ARGUMENT, subdiv_evaluate(k.exact, 3, in, 0, out, 0, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate_begin(NULL, 3, in, 0, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate_begin(k.plain, 3, NULL, 0, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate_begin(k.exact, 3, in, 0, NULL, opt));
    WRONG(ARGUMENT, subdiv_evaluate_begin(k.plain, -1, in, 0, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate_begin(k.plain, 3, in, 1, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate_faces(NULL, 3, work, 0, 1, 0, 1, out, 0, opt));
    WRONG(ARGUMENT, subdiv_evaluate_faces(k.plain, 3, NULL, 0, 1, 0, 1, out, 0, opt));
    WRONG(ARGUMENT, subdiv_evaluate_faces(k.plain, 3, work, 0, 1, 0, 1, NULL, 0, opt));
    WRONG(ARGUMENT, subdiv_evaluate_faces(k.plain, 0, work, 0, 1, 0, 1, out, 0, opt));
    WRONG(ARGUMENT, subdiv_evaluate_faces(k.plain, 3, work, 0, 1, 0, 1, out, 2, opt));
    WRONG(ARGUMENT, subdiv_evaluate_faces(k.exact, 3, work, 0, 1, 0, 0, out, 0, opt));
    WRONG(ARGUMENT, subdiv_evaluate_limit(NULL, in, 0, &to, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate_limit(k.limit, NULL, 0, &to, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate_limit(k.limit, in, 2, &to, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate_limit(k.limit, in, 0, NULL, NULL, opt));
    WRONG(ARGUMENT, subdiv_evaluate_limit(k.limit, in, 0, &narrow, NULL, opt));
    WRONG(ARGUMENT, subdiv_evaluate_limit(k.limit, in, 0, &tangents, NULL, opt));
    WRONG(ARGUMENT, subdiv_evaluate_limit(k.limit, in, 0, &negative, NULL, opt));
    WRONG(ARGUMENT, subdiv_evaluate_limit(k.plain, in, 0, &to, NULL, opt));
    WRONG(ARGUMENT, subdiv_evaluate_limit(k.exact, in, 0, &to, NULL, opt));
    WRONG(ARGUMENT, subdiv_evaluate_limit_faces(NULL, work, 0, 1, 0, 1, &to, opt));
    WRONG(ARGUMENT, subdiv_evaluate_limit_faces(k.limit, NULL, 0, 1, 0, 1, &to, opt));
    WRONG(ARGUMENT, subdiv_evaluate_limit_faces(k.limit, work, 0, 1, 0, 1, NULL, opt));
    WRONG(ARGUMENT, subdiv_evaluate_limit_faces(k.plain, work, 0, 1, 0, 1, &to, opt));
    WRONG(ARGUMENT, subdiv_surface_face_normals(NULL, o.ints, opt));
    WRONG(ARGUMENT, subdiv_surface_face_normals(k.limit, NULL, opt));
    WRONG(ARGUMENT, subdiv_surface_face_normals(k.plain, o.ints, opt));
    WRONG(ARGUMENT, subdiv_surface_face_normals(k.exact, o.ints, opt));
    WRONG(ARGUMENT, subdiv_surface_face_normals(k.values, o.ints, opt));
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        const int *r = ranges[i];
        WRONG(INDEX, subdiv_evaluate_faces(k.plain, 3, work, r[0], r[1], r[2], r[3], out, 0, opt));
        WRONG(INDEX, subdiv_evaluate_limit_faces(k.limit, work, r[0], r[1], r[2], r[3], &to, opt));
        if (i < 8) continue;
        WRONG(INDEX, subdiv_refined_stencils(&o.stencils, k.plain, r[2], r[3], opt));
    }
}

static void wrong_buffers(void)
{
    subdiv_mesh fewer = k.fine, none = k.fine;
    const subdiv_mesh *cage = &k.cage, *fine = &k.fine;
    const subdiv_buffer *b = &k.buffer;
    const subdiv_vertices to = { o.out, NULL, NULL, NULL, 0 };
    const subdiv_vertices narrow = { o.out, NULL, NULL, NULL, 2 };
    const subdiv_vertices narrow_uvs = { NULL, NULL, o.out, NULL, 1 };
    const subdiv_vertices negative = { NULL, NULL, NULL, NULL, -1 };
    const subdiv_vertices uvs = { NULL, NULL, o.out, NULL, 0 };
    const subdiv_vertices normals = { NULL, o.out, NULL, NULL, 0 };
    const subdiv_vertices colors = { NULL, NULL, NULL, o.out, 0 };
    const float *p = k.positions;
    void *work = k.scratch;
    WRONG(ARGUMENT, subdiv_make_buffer(NULL, fine, 4, opt));
    WRONG(ARGUMENT, subdiv_make_buffer(&o.buffer, NULL, 4, opt));
    WRONG(ARGUMENT, subdiv_make_buffer(&o.buffer, fine, 0, opt));
    WRONG(ARGUMENT, subdiv_make_buffer(&o.buffer, fine, -4, opt));
    WRONG(ARGUMENT, subdiv_fill_buffer(NULL, fine, &to, opt));
    WRONG(ARGUMENT, subdiv_fill_buffer(b, NULL, &to, opt));
    WRONG(ARGUMENT, subdiv_fill_buffer(b, fine, NULL, opt));
    WRONG(ARGUMENT, subdiv_fill_buffer(b, fine, &narrow, opt));
    WRONG(ARGUMENT, subdiv_fill_buffer(b, fine, &narrow_uvs, opt));
    WRONG(ARGUMENT, subdiv_fill_buffer(b, fine, &negative, opt));
    WRONG(ARGUMENT, subdiv_fill_buffer(b, fine, &normals, opt));
    WRONG(ARGUMENT, subdiv_fill_buffer(b, fine, &colors, opt));
    WRONG(ARGUMENT, subdiv_fill_buffer(b, cage, &to, opt));
    CHECK(fine->uv_count > 1);
    fewer.uv_count--, none.uvs = NULL;              // of the same points
    WRONG(ARGUMENT, subdiv_fill_buffer(b, &fewer, &uvs, opt));
    WRONG(ARGUMENT, subdiv_fill_buffer(b, &none, &uvs, opt));
    WRONG(ARGUMENT, subdiv_evaluate_buffer(NULL, k.plain, p, &to, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate_buffer(b, NULL, p, &to, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate_buffer(b, k.plain, NULL, &to, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate_buffer(b, k.plain, p, NULL, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate_buffer(b, k.plain, p, &narrow, NULL, opt));
    WRONG(ARGUMENT, subdiv_evaluate_buffer(b, k.plain, p, &negative, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate_buffer(b, k.plain, p, &normals, NULL, opt));
    WRONG(ARGUMENT, subdiv_evaluate_buffer(b, k.copy, p, &to, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate_buffer(b, k.exact, p, &to, work, opt));
    WRONG(ARGUMENT, subdiv_evaluate_buffer(b, k.values, p, &to, work, opt));
}

// rule, ends, levels, points: of no curve.
static void wrong_curves(void)
{
    static const struct { int rule, ends, levels, count; } bad[] = {
        { 2, 0, 1, 5 }, { -1, 0, 1, 5 }, { 0, 3, 1, 5 }, { 0, -1, 1, 5 }, { 0, 0, -1, 5 },
        { 1, 0, INT_MIN, 5 }, { 0, 0, 1, -1 }, { 1, 2, 1, INT_MIN }, { 0, 1, 1, 2 }, { 1, 1, 0, 1 },
        { 0, 0, 1, 0 }, { 0, 0, 31, 5 }, { 1, 2, INT_MAX, 1 }, { 1, 0, 1, INT_MAX } };
    const float *in = k.positions;
    float *out = o.out;
    for (int i = 0; i < (int)(sizeof bad / sizeof *bad); i++) {
        subdiv_curve_rule rule = (subdiv_curve_rule)bad[i].rule;
        subdiv_curve_ends ends = (subdiv_curve_ends)bad[i].ends;
        int levels = bad[i].levels, count = bad[i].count;
        CHECK_EQUAL(subdiv_curve_point_count(rule, ends, count, levels), 0);
        if (i < 10) WRONG(ARGUMENT, subdiv_curve(rule, ends, levels, 3, count, in, 0, out, 0, opt));
        if (i == 10) WRONG(EMPTY, subdiv_curve(rule, ends, levels, 3, count, in, 0, out, 0, opt));
        if (i > 10)
            WRONG(TOO_LARGE, subdiv_curve(rule, ends, levels, 3, count, in, 0, out, 0, opt));
    }
    const subdiv_curve_rule rule = SUBDIV_CURVE_CHAIKIN;
    const subdiv_curve_ends ends = SUBDIV_ENDS_KEPT;
    WRONG(ARGUMENT, subdiv_curve(rule, ends, 1, 0, 5, in, 0, out, 0, opt));
    WRONG(ARGUMENT, subdiv_curve(rule, ends, 1, INT_MIN, 5, in, 0, out, 0, opt));
    WRONG(ARGUMENT, subdiv_curve(rule, ends, 1, 3, 5, NULL, 0, out, 0, opt));
    WRONG(ARGUMENT, subdiv_curve(rule, ends, 1, 3, 5, in, 0, NULL, 0, opt));
    WRONG(ARGUMENT, subdiv_curve(rule, ends, 1, 3, 5, in, 2, out, 0, opt));
    WRONG(ARGUMENT, subdiv_curve(rule, ends, 1, 3, 5, in, 0, out, -3, opt));
}

static void wrong_places(void)
{
    static const float nan = (float)NAN;
    const subdiv_location at = { 0, 0, 0.5f, 0.5f };
    const subdiv_derivatives to = { o.out, NULL, NULL, NULL, NULL, NULL, NULL, 0 };
    const subdiv_derivatives narrow = { o.out, NULL, NULL, NULL, NULL, NULL, NULL, 2 };
    const subdiv_derivatives negative = { o.out, NULL, NULL, NULL, NULL, NULL, NULL, -9 };
    const subdiv_derivatives normals = { NULL, NULL, NULL, NULL, NULL, NULL, o.out, 0 };
    const subdiv_location bad[] = { { -1, 0, 0, 0 }, { INT_MAX, 0, 0, 0 }, { k.faces, 0, 0, 0 },
        { 0, -1, 0, 0 }, { 0, INT_MAX, 0, 0 }, { 0, 0, -0.1f, 0 }, { 0, 0, 0, 1.1f },
        { 0, 0, nan, 0 } };
    const subdiv_surface *exact = k.exact;
    void *work = k.scratch;
    memset(work, 0, subdiv_scratch_size(exact, 3));
    WRONG(ARGUMENT, subdiv_evaluate_at(exact, 3, work, 1, &at, &to, opt));
    CHECK_EQUAL(subdiv_evaluate_begin(exact, 3, k.positions, 0, work, opt), SUBDIV_OK);
    WRONG(ARGUMENT, subdiv_evaluate_at(NULL, 3, work, 1, &at, &to, opt));
    WRONG(ARGUMENT, subdiv_evaluate_at(k.plain, 3, work, 1, &at, &to, opt));
    WRONG(ARGUMENT, subdiv_evaluate_at(exact, 0, work, 1, &at, &to, opt));
    WRONG(ARGUMENT, subdiv_evaluate_at(exact, 3, NULL, 1, &at, &to, opt));
    WRONG(ARGUMENT, subdiv_evaluate_at(exact, 3, work, -1, &at, &to, opt));
    WRONG(ARGUMENT, subdiv_evaluate_at(exact, 3, work, 1, NULL, &to, opt));
    WRONG(ARGUMENT, subdiv_evaluate_at(exact, 3, work, 1, &at, NULL, opt));
    WRONG(ARGUMENT, subdiv_evaluate_at(exact, 3, work, 1, &at, &narrow, opt));
    WRONG(ARGUMENT, subdiv_evaluate_at(exact, 3, work, 1, &at, &negative, opt));
    WRONG(ARGUMENT, subdiv_evaluate_at(exact, 2, work, 1, &at, &normals, opt));
    WRONG(ARGUMENT, subdiv_tangents_at(NULL, work, 1, &at, o.out, 0, opt));
    WRONG(ARGUMENT, subdiv_tangents_at(k.plain, work, 1, &at, o.out, 0, opt));
    WRONG(ARGUMENT, subdiv_tangents_at(k.plain, work, 0, NULL, o.out, 0, opt));
    WRONG(ARGUMENT, subdiv_tangents_at(k.exact_values, work, 1, &at, o.out, 0, opt));
    WRONG(ARGUMENT, subdiv_tangents_at(exact, NULL, 1, &at, o.out, 0, opt));
    WRONG(ARGUMENT, subdiv_tangents_at(exact, work, -1, &at, o.out, 0, opt));
    WRONG(ARGUMENT, subdiv_tangents_at(exact, work, 1, NULL, o.out, 0, opt));
    WRONG(ARGUMENT, subdiv_tangents_at(exact, work, 1, &at, NULL, 0, opt));
    WRONG(ARGUMENT, subdiv_tangents_at(exact, work, 1, &at, o.out, 3, opt));
    WRONG(ARGUMENT, subdiv_surface_locations(NULL, NULL, NULL, opt));
    WRONG(ARGUMENT, subdiv_surface_locations(exact, NULL, NULL, opt));
    WRONG(ARGUMENT, subdiv_surface_locations(k.values, NULL, NULL, opt));
    WRONG(ARGUMENT, subdiv_stencils_at(NULL, exact, 1, &at, opt));
    WRONG(ARGUMENT, subdiv_stencils_at(&o.stencils, NULL, 1, &at, opt));
    WRONG(ARGUMENT, subdiv_stencils_at(&o.stencils, k.plain, 1, &at, opt));
    WRONG(ARGUMENT, subdiv_stencils_at(&o.stencils, exact, -1, &at, opt));
    WRONG(ARGUMENT, subdiv_stencils_at(&o.stencils, exact, 1, NULL, opt));
    for (int i = 0; i < 8; i++) {
        if (i < 5) WRONG(INDEX, subdiv_evaluate_at(exact, 3, work, 1, bad + i, &to, opt));
        else WRONG(ARGUMENT, subdiv_evaluate_at(exact, 3, work, 1, bad + i, &to, opt));
        if (i < 5) WRONG(INDEX, subdiv_stencils_at(&o.stencils, exact, 1, bad + i, opt));
        else WRONG(ARGUMENT, subdiv_stencils_at(&o.stencils, exact, 1, bad + i, opt));
    }
    WRONG(ARGUMENT, subdiv_refined_stencils(NULL, k.plain, 0, 1, opt));
    WRONG(ARGUMENT, subdiv_refined_stencils(&o.stencils, NULL, 0, 1, opt));
    WRONG(ARGUMENT, subdiv_refined_stencils(&o.stencils, exact, 0, 0, opt));
}

static void wrong_tools(void)
{
    static const subdiv_tessellation low = { -1, NULL, NULL, NULL, NULL, 0 };
    static const subdiv_tessellation high = { INT_MAX, NULL, NULL, NULL, NULL, 0 };
    const subdiv_mesh *cage = &k.cage;
    subdiv_mesh *mesh = &k.cage;
    const float nan = (float)NAN;
    const int two = 2, ends[2] = { 0, 1 }, beyond[2] = { 0, k.cage.vertex_count };
    WRONG(ARGUMENT, subdiv_tessellate(NULL, cage, NULL, opt));
    WRONG(ARGUMENT, subdiv_tessellate(&o.fine, NULL, NULL, opt));
    WRONG(ARGUMENT, subdiv_tessellate(&k.cage, cage, NULL, opt));
    WRONG(ARGUMENT, subdiv_tessellate(&o.fine, cage, &low, opt));
    WRONG(TOO_LARGE, subdiv_tessellate(&o.fine, cage, &high, opt));
    WRONG(ARGUMENT, subdiv_surface_tessellate(NULL, k.exact, k.positions, NULL, opt));
    WRONG(ARGUMENT, subdiv_surface_tessellate(&o.fine, NULL, k.positions, NULL, opt));
    WRONG(ARGUMENT, subdiv_surface_tessellate(&o.fine, k.plain, k.positions, NULL, opt));
    WRONG(ARGUMENT, subdiv_surface_tessellate(&o.fine, k.exact_values, k.positions, NULL, opt));
    WRONG(ARGUMENT, subdiv_surface_tessellate(&o.fine, k.exact, NULL, NULL, opt));
    WRONG(ARGUMENT, subdiv_surface_tessellate(&o.fine, k.exact, k.positions, &low, opt));
    WRONG(ARGUMENT, subdiv_explain_points(NULL, cage, opt));
    WRONG(ARGUMENT, subdiv_explain_points(&o.explanation, NULL, opt));
    WRONG(ARGUMENT, subdiv_explain(NULL, 64, cage, 0, opt));
    WRONG(ARGUMENT, subdiv_explain(o.text, 0, cage, 0, opt));
    WRONG(TOO_LARGE, subdiv_explain(o.text, 1, cage, 0, opt));
    WRONG(ARGUMENT, subdiv_explain(o.text, 64, NULL, 0, opt));
    WRONG(INDEX, subdiv_explain(o.text, 64, cage, -1, opt));
    WRONG(INDEX, subdiv_explain(o.text, 64, cage, k.points, opt));
    WRONG(INDEX, subdiv_explain(o.text, 64, cage, INT_MAX, opt));
    WRONG(INDEX, subdiv_explain(o.text, 64, cage, INT_MIN, opt));
    WRONG(ARGUMENT, subdiv_inspect(NULL, cage, opt));
    WRONG(ARGUMENT, subdiv_inspect(&o.info, NULL, opt));
    WRONG(ARGUMENT, subdiv_check(o.counts, NULL, count_finding, NULL, opt));
    WRONG(ARGUMENT, subdiv_normals(NULL, opt));
    WRONG(ARGUMENT, subdiv_normals_by_angle(NULL, 30, opt));
    WRONG(ARGUMENT, subdiv_normals_by_angle(mesh, -1, opt));
    WRONG(ARGUMENT, subdiv_normals_by_angle(mesh, 181, opt));
    WRONG(ARGUMENT, subdiv_normals_by_angle(mesh, nan, opt));
    WRONG(ARGUMENT, subdiv_crease_by_angle(NULL, 30, 1, opt));
    WRONG(ARGUMENT, subdiv_crease_by_angle(mesh, -1, 1, opt));
    WRONG(ARGUMENT, subdiv_crease_by_angle(mesh, 181, 1, opt));
    WRONG(ARGUMENT, subdiv_crease_by_angle(mesh, nan, 1, opt));
    WRONG(NOT_FINITE, subdiv_crease_by_angle(mesh, 30, nan, opt));
    WRONG(ARGUMENT, subdiv_crease_by_smoothing_groups(NULL, 1, opt));
    WRONG(NOT_FINITE, subdiv_crease_by_smoothing_groups(mesh, nan, opt));
    WRONG(ARGUMENT, subdiv_crease_by_uv_seams(NULL, 1, opt));
    WRONG(NOT_FINITE, subdiv_crease_by_uv_seams(mesh, nan, opt));
    WRONG(ARGUMENT, subdiv_crease_chains(NULL, 1, &two, ends, 1, &nan, opt));
    WRONG(ARGUMENT, subdiv_crease_chains(mesh, -1, &two, ends, -1, &nan, opt));
    WRONG(ARGUMENT, subdiv_crease_chains(mesh, 1, NULL, ends, 1, &nan, opt));
    WRONG(ARGUMENT, subdiv_crease_chains(mesh, 1, &two, NULL, 1, &nan, opt));
    WRONG(ARGUMENT, subdiv_crease_chains(mesh, 1, &two, ends, 1, NULL, opt));
    WRONG(ARGUMENT, subdiv_crease_chains(mesh, 1, &two, ends, 3, &nan, opt));
    WRONG(ARGUMENT, subdiv_crease_chains(mesh, 1, ends, ends, 1, &nan, opt));       // of 0 vertices
    WRONG(NOT_FINITE, subdiv_crease_chains(mesh, 1, &two, ends, 1, &nan, opt));
    WRONG(INDEX, subdiv_crease_chains(mesh, 1, &two, beyond, 1, &nan, opt));
    WRONG(ARGUMENT, subdiv_join_values(NULL, 3, 1, k.positions, opt));
    WRONG(ARGUMENT, subdiv_join_values(o.ints, 0, 1, k.positions, opt));
    WRONG(ARGUMENT, subdiv_join_values(o.ints, 3, -1, k.positions, opt));
    WRONG(ARGUMENT, subdiv_join_values(o.ints, 3, 1, NULL, opt));
}

static void wrong_texts(void)
{
    const subdiv_mesh *cage = &k.cage;
    const float *p = k.positions;
    write_path(path, "kept");
    WRONG(ARGUMENT, subdiv_load_obj_memory(NULL, obj_text, obj_size, opt));
    WRONG(ARGUMENT, subdiv_load_obj_memory(&o.fine, NULL, 5, opt));
    WRONG(EMPTY, subdiv_load_obj_memory(&o.fine, NULL, 0, opt));
    WRONG(ARGUMENT, subdiv_load_obj_callback(NULL, read_text, &sink, opt));
    WRONG(ARGUMENT, subdiv_load_obj_callback(&o.fine, NULL, &sink, opt));
    WRONG(ARGUMENT, subdiv_load_obj(NULL, path, opt));
    WRONG(ARGUMENT, subdiv_load_obj(&o.fine, NULL, opt));
    WRONG(IO, subdiv_load_obj(&o.fine, "build/none/of/these.obj", opt));
    WRONG(IO, subdiv_load_obj(&o.fine, "build", opt));
    WRONG(ARGUMENT, subdiv_save_obj_memory(NULL, o.text, 64, &o.size, opt));
    WRONG(ARGUMENT, subdiv_save_obj_memory(cage, NULL, 64, &o.size, opt));
    WRONG(ARGUMENT, subdiv_save_obj_memory(cage, o.out, 64, NULL, opt));
    WRONG(ARGUMENT, subdiv_save_obj_callback(NULL, write_away, &sink, opt));
    WRONG(ARGUMENT, subdiv_save_obj_callback(cage, NULL, &sink, opt));
    WRONG(ARGUMENT, subdiv_save_obj(NULL, path, opt));
    WRONG(ARGUMENT, subdiv_save_obj(cage, NULL, opt));
    WRONG(IO, subdiv_save_obj(cage, "", opt));
    WRONG(IO, subdiv_save_obj(cage, "build/none/of/these.obj", opt));
    WRONG(ARGUMENT, subdiv_stream_obj_callback(NULL, p, write_away, &sink, opt));
    WRONG(ARGUMENT, subdiv_stream_obj_callback(k.copy, NULL, write_away, &sink, opt));
    WRONG(ARGUMENT, subdiv_stream_obj_callback(k.plain, NULL, write_away, &sink, opt));
    WRONG(ARGUMENT, subdiv_stream_obj_callback(k.plain, p, NULL, &sink, opt));
    WRONG(ARGUMENT, subdiv_stream_obj_callback(k.exact, p, write_away, &sink, opt));
    WRONG(ARGUMENT, subdiv_stream_obj_callback(k.values, p, write_away, &sink, opt));
    WRONG(ARGUMENT, subdiv_stream_obj(NULL, p, path, opt));
    WRONG(ARGUMENT, subdiv_stream_obj(k.copy, NULL, path, opt));
    WRONG(ARGUMENT, subdiv_stream_obj(k.plain, NULL, path, opt));
    WRONG(ARGUMENT, subdiv_stream_obj(k.plain, p, NULL, opt));
    WRONG(ARGUMENT, subdiv_stream_obj(k.exact, p, path, opt));
    WRONG(ARGUMENT, subdiv_stream_obj(k.values, p, path, opt));
    WRONG(IO, subdiv_stream_obj(k.plain, p, "build/none/of/these.obj", opt));
    for (int part = -1; part < 4; part++) {
        subdiv_options of_part = *opt;
        of_part.part = part, of_part.part_count = part < 0 ? 2 : part < 3 ? part : -3;
        if (part == 0) continue;                                // no parts
        WRONG(ARGUMENT, subdiv_stream_obj_callback(k.copy, p, write_away, &sink, &of_part));
        WRONG(ARGUMENT, subdiv_stream_obj(k.plain, p, path, &of_part));
    }
    k.positions[7] = HUGE_VALF;
    for (int part = 0; part < 9; part++) {                      // also a part without points
        subdiv_options of_part = *opt;
        of_part.part = part, of_part.part_count = 9;
        WRONG(ARGUMENT, subdiv_stream_obj_callback(k.copy, NULL, write_away, &sink, &of_part));
        WRONG(NOT_FINITE, subdiv_stream_obj_callback(k.copy, p, write_away, &sink, &of_part));
        WRONG(NOT_FINITE, subdiv_stream_obj_callback(k.plain, p, write_away, &sink, &of_part));
        WRONG(NOT_FINITE, subdiv_stream_obj(k.copy, p, path, &of_part));
    }
    k.positions[7] = 0.5f;
    CHECK(path_has("kept"));
    remove(path);
}

// No surface has no parts; numbers out of range are taken for the nearest, or have no answer.
static void check_numbers(void)
{
    FILL(o);
    CHECK_EQUAL(subdiv_surface_vertex_count(NULL) + subdiv_surface_face_count(NULL) +
                subdiv_surface_face_size(NULL) + subdiv_surface_cage_face_count(NULL) +
                subdiv_surface_edge_count(NULL) + subdiv_first_inside(NULL, 0) +
                subdiv_surface_normal_count(NULL), 0);
    CHECK_EQUAL(subdiv_scratch_size(NULL, 3), 0);
    subdiv_surface_edges(NULL, o.ints);
    subdiv_surface_edges(k.plain, NULL);
    subdiv_surface_edges(k.copy, o.ints);           // level 0 has none
    CHECK_EQUAL(subdiv_evaluate_faces(k.plain, 3, k.scratch, k.faces, 0, k.points, 0, o.out, 0,
                                      opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_evaluate_faces(k.copy, 3, k.scratch, 0, 0, 0, k.cage.vertex_count, o.out, 0,
                                      opt), SUBDIV_OK);                     // level 0, no face
    CHECK_EQUAL(subdiv_surface_locations(k.plain, NULL, NULL, opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_join_values(NULL, 1, 0, NULL, opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_crease_chains(&k.cage, 0, NULL, NULL, 0, NULL, opt), SUBDIV_OK);
    CHECK(is_filled(&o, sizeof o, 0x55));
    const subdiv_surface *all[] = { k.copy, k.plain, k.limit, k.exact, k.values, k.exact_values };
    for (int i = 0; i < 6; i++) {
        int faces = subdiv_surface_cage_face_count(all[i]);
        CHECK_EQUAL(subdiv_scratch_size(all[i], 0) + subdiv_scratch_size(all[i], INT_MIN), 0);
        CHECK(subdiv_scratch_size(all[i], INT_MAX) > INT_MAX);
        CHECK_EQUAL(subdiv_first_inside(all[i], -1), subdiv_first_inside(all[i], 0));
        CHECK_EQUAL(subdiv_first_inside(all[i], INT_MAX), subdiv_first_inside(all[i], faces));
        CHECK_EQUAL(subdiv_first_inside(all[i], faces), subdiv_surface_vertex_count(all[i]));
    }
    subdiv_surface_free(NULL);
    subdiv_mesh_free(NULL);
    subdiv_stencils_free(NULL);
    subdiv_explanation_free(NULL);
    subdiv_buffer_free(NULL);
}

static void test_wrong_arguments(void)
{
    with_error = options_of(0);
    with_error.error = &error;
    make_kinds();
    wrong_preparation();
    wrong_evaluation();
    wrong_places();
    wrong_buffers();
    wrong_curves();
    wrong_tools();
    wrong_texts();
    check_numbers();
    free_kinds();
}

int main(int argc, char **argv)
{
    if (argc > 1) cages = atoi(argv[1]);
    make_strip();
    RUN(test_wrong_arguments);
    RUN(test_bad_texts);
    RUN(test_failing_reads);
    RUN(test_failing_writes);
#ifndef _WIN32
    RUN(test_kinds_of_files);
    RUN(test_full_disk);
    RUN(test_read_only);
#endif
    RUN(test_large);
    RUN(test_random_cages);
    remove(path);
    free(obj_text);
    if (heap.wrong || heap.foreign) test_failed++;
    printf("%d allocations failed\n", failed_allocations);
    return test_end("test_memory");
}
