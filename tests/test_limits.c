// The largest results and the longest lists: what fits 2^31 - 1 works, also beyond 2^30, and what
// does not is refused.
//
//     cc -O2 -I. tests/test_limits.c -o build/test_limits -lm && build/test_limits
#if defined(__linux__) && !defined(_DEFAULT_SOURCE)
#define _DEFAULT_SOURCE
#endif
#include <limits.h>
#include <stdlib.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/test.h"

// ------------------------------------------------------- 2,131,230,721 points, a window at a time

// A strip of quads: on level 12 there are 127 * 2^24 faces. One more quad would make 2^31.
enum { QUADS = 127, LEVELS = 12, N = 1 << LEVELS, WINDOW = 3000 };

static float positions[6 * (QUADS + 2)];
static int face_vertices[4 * (QUADS + 1)];

static subdiv_mesh strip(int quads)
{
    subdiv_mesh m = {0};
    m.vertex_count = 2 * (quads + 1), m.positions = positions;
    m.face_count = quads, m.face_size = 4, m.face_vertices = face_vertices;
    for (int i = 0; i <= quads; i++) {
        float *low = positions + 3 * i, *high = positions + 3 * (quads + 1 + i);
        low[0] = high[0] = (float)i, low[1] = 0, high[1] = 1;
        low[2] = (float)sin(i), high[2] = (float)cos(2 * i);
    }
    for (int f = 0; f < quads; f++) {
        int *q = face_vertices + 4 * f;
        q[0] = f, q[1] = f + 1, q[2] = quads + f + 2, q[3] = quads + f + 1;
    }
    return m;
}

static subdiv_mesh cage;
static subdiv_surface *surface, *exact;
static void *scratch, *exact_scratch;

static void *begin(const subdiv_surface *s)
{
    void *memory = malloc(subdiv_scratch_size(s, 3));
    if (!memory) abort();
    CHECK(subdiv_scratch_size(s, 3) < 200000000);
    CHECK_EQUAL(subdiv_evaluate_begin(s, 3, positions, 0, memory, NULL), SUBDIV_OK);
    return memory;
}

// Compares the points of a window with the same ones of the exact surface, that are found by face,
// u and v.
static void check_window(int face, int first, const subdiv_location *at)
{
    static float window[3 * WINDOW], points[3 * WINDOW];
    subdiv_limit limit = {0};
    subdiv_derivatives out = {0};
    limit.positions = window, out.points = points;
    memset(window, 0, sizeof window);
    CHECK_EQUAL(subdiv_evaluate_limit_faces(surface, scratch, face, 1, first, WINDOW, &limit, NULL),
                SUBDIV_OK);
    CHECK_EQUAL(subdiv_evaluate_at(exact, 3, exact_scratch, WINDOW, at, &out, NULL), SUBDIV_OK);
    for (int i = 0; i < 3 * WINDOW; i++) CHECK_NEAR(window[i], points[i], 3e-5);
}

// Point number i inside a face stands in row i / (N - 1) + 1.
static void check_inside(int face, int from)
{
    static subdiv_location at[WINDOW];
    for (int i = 0; i < WINDOW; i++) {
        at[i].face = face;
        at[i].u = (float)((from + i) % (N - 1) + 1) / N;
        at[i].v = (float)((from + i) / (N - 1) + 1) / N;
    }
    check_window(face, subdiv_first_inside(surface, face) + from, at);
}

// The points inside edge 0-1 of face 0, the first edge, come after those of the cage.
static void check_first_edge(void)
{
    static subdiv_location at[WINDOW];
    for (int i = 0; i < WINDOW; i++) at[i].u = (float)(i + 1) / N;
    check_window(0, cage.vertex_count, at);
}

static void test_windows(void)
{
    const int inside = (N - 1) * (N - 1);
    subdiv_options limit = {0};
    cage = strip(QUADS);
    limit.limit = 1;
    CHECK_EQUAL(subdiv_prepare(&surface, &cage, LEVELS, &limit), SUBDIV_OK);
    CHECK_EQUAL(subdiv_prepare(&exact, &cage, SUBDIV_EXACT, NULL), SUBDIV_OK);
    if (!surface || !exact) return;
    CHECK_EQUAL(subdiv_surface_face_count(surface), 127LL << 24);
    CHECK_EQUAL(subdiv_surface_vertex_count(surface), (127LL * N + 1) * (N + 1));
    CHECK_EQUAL(subdiv_first_inside(surface, QUADS), subdiv_surface_vertex_count(surface));
    scratch = begin(surface), exact_scratch = begin(exact);
    check_first_edge();
    check_inside(0, 0);
    check_inside(QUADS / 2, inside / 2);
    check_inside(QUADS - 1, inside - WINDOW);
    free(scratch), free(exact_scratch);
    subdiv_surface_free(surface), subdiv_surface_free(exact);
}

static void test_one_more(void)
{
    subdiv_mesh fine;
    cage = strip(QUADS + 1);
    CHECK_EQUAL(subdiv_refine(&fine, &cage, LEVELS, NULL), SUBDIV_ERROR_TOO_LARGE);
    cage = strip(QUADS);
    CHECK_EQUAL(subdiv_refine(&fine, &cage, LEVELS + 1, NULL), SUBDIV_ERROR_TOO_LARGE);
}

// Quads without neighbours have more vertices than faces: 66049 each on level 8, of 65536 faces. So
// many as have 2^31 - 30,000 vertices fit, and one more does not.
static void test_many_vertices(void)
{
    enum { MOST = 32513, EACH = 257 * 257 };
    static float places[12 * (MOST + 1)];
    static int vertices[4 * (MOST + 1)];
    subdiv_error error = {0};
    subdiv_options opt = {0};
    subdiv_mesh quads = {0};
    opt.error = &error;
    for (int i = 0; i < 4 * (MOST + 1); i++) vertices[i] = i;
    quads.positions = places, quads.face_vertices = vertices, quads.face_size = 4;
    quads.vertex_count = 4 * MOST, quads.face_count = MOST;
    CHECK_EQUAL(subdiv_prepare(&surface, &quads, 8, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_surface_vertex_count(surface), (long long)MOST * EACH);
    subdiv_surface_free(surface);
    quads.vertex_count = 4 * (MOST + 1), quads.face_count = MOST + 1;
    CHECK_EQUAL(subdiv_prepare(&surface, &quads, 8, &opt), SUBDIV_ERROR_TOO_LARGE);
    CHECK(surface == NULL && strstr(error.message, "more than 2147483647 vertices"));
}

// ------------------------------------------------------------------------------------ long lists

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>

// Zeros that take no memory until something else is written: one megabyte of a file, mapped over
// and over. (Fresh pages take the system longer than all other tests take.)
static void *zeros(size_t size)
{
    const size_t part = (size_t)1 << 20;
    FILE *file = sizeof size < 8 ? NULL : tmpfile();
    char *p = (char *)MAP_FAILED;
    if (file && !ftruncate(fileno(file), (off_t)part))
        p = (char *)mmap(NULL, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    int failed = p == (char *)MAP_FAILED;
    for (size_t at = 0; at < size && !failed; at += part)
        failed = mmap(p + at, size - at < part ? size - at : part, PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_FIXED | MAP_NORESERVE, fileno(file), 0) == MAP_FAILED;
    if (file) fclose(file);
    return failed ? NULL : p;
}

// A list with more than 2^30 creases: the last one has a vertex that does not exist.
static void test_many_creases(void)
{
    const size_t count = ((size_t)1 << 30) + 10;
    int *ends = (int *)zeros(2 * count * sizeof *ends);
    float *sharpness = (float *)zeros(count * sizeof *sharpness);
    subdiv_error error = {0};
    subdiv_options opt = {0};
    subdiv_mesh fine;
    opt.error = &error;
    cage = strip(1);
    if (ends && sharpness) {
        ends[2 * count - 1] = 99;
        cage.crease_count = (int)count;
        cage.crease_vertices = ends, cage.crease_sharpness = sharpness;
        CHECK_EQUAL(subdiv_refine(&fine, &cage, 1, &opt), SUBDIV_ERROR_INDEX);
        CHECK(strstr(error.message, "crease 1073741833") != NULL);
        CHECK_EQUAL(error.vertex, 99);
    } else puts("no room for 2^30 creases");
    if (ends) munmap(ends, 2 * count * sizeof *ends);
    if (sharpness) munmap(sharpness, count * sizeof *sharpness);
}

// A face-vertex more than 2^30: refused, and nothing is built.
static void test_many_faces(void)
{
    const size_t size = (((size_t)1 << 28) + 1) * 4 * sizeof(int);
    int *zero = (int *)zeros(size);
    subdiv_mesh fine;
    subdiv_buffer buffer;
    cage = strip(1);
    cage.face_count = (1 << 28) + 1;
    cage.face_vertices = zero;
    if (zero) {
        CHECK_EQUAL(subdiv_refine(&fine, &cage, 1, NULL), SUBDIV_ERROR_TOO_LARGE);
        cage.face_count = 1;                    // of 2^30 vertices: 2^30 - 2 triangles
        cage.face_size = 1 << 30;
        CHECK_EQUAL(subdiv_make_buffer(&buffer, &cage, 4, NULL), SUBDIV_ERROR_TOO_LARGE);
        munmap(zero, size);
    } else puts("no room for 2^30 face-vertices");
}
#endif

int main(void)
{
    RUN(test_windows);
    RUN(test_one_more);
    RUN(test_many_vertices);
#ifdef __linux__
    RUN(test_many_creases);
    RUN(test_many_faces);
#endif
    return test_end("test_limits");
}
