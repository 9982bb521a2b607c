// Evaluation of prepared surfaces: channels and strides, ranges of faces, windows, threads, linear
// data, streamed OBJ and allocations. The reference is surface_mesh or one whole call.
//
//     cc -I. tests/test_evaluate.c -o build/test_evaluate -lm -pthread && build/test_evaluate
#include <pthread.h>
#include <stdlib.h>

#include <string.h>

static int allocations, filling;      // each byte of what is allocated is this

static void *count_malloc(size_t size)
{
    void *memory = size >> 30 ? NULL : malloc(size);       // no mesh here needs a gigabyte
    allocations++;
    if (memory) memset(memory, filling, size);
    return memory;
}

#define SUBDIV_MALLOC(size, user)  ((void)(user), count_malloc(size))
#define SUBDIV_FREE(pointer, user) ((void)(user), free(pointer))

#define SDV_JOB_POINTS 4               // jobs of a few points, so that small cages take many
#define SDV_FULL_LEVELS 2              // so that shallow levels have frames, as deep ones do
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/same.h"
#include "lib/test.h"

// ----------------------------------------------------------------------------------- the cages

static unsigned random_state;

static int below(int n)               // 0 <= result < n
{
    random_state = random_state * 1664525u + 1013904223u;
    return (int)((random_state >> 8) % (unsigned)n);
}

typedef struct prepared {
    subdiv_surface *surface;
    subdiv_options  opt;
    int levels, points, faces;        // of the result; of the cage
} prepared;

typedef void (*cage_check)(const subdiv_mesh *m, const prepared *p);

// Prepares a cage for a few levels, with whatever options there are, and checks it.
static void check_prepared(const subdiv_mesh *m, unsigned seed, cage_check check)
{
    prepared p;
    int size = face_vertex_count(m), most = 1;
    memset(&p, 0, sizeof p);
    random_state = seed;
    while (most < 4 && size << 2 * most <= 8000) most++;
    p.levels = below(8) ? 1 + below(most) : 0;
    p.opt.keep_holes = below(2);
    p.opt.linear = below(6) == 0;
    p.opt.limit = below(4) == 0;
    CHECK_EQUAL(subdiv_prepare(&p.surface, m, p.levels, &p.opt), SUBDIV_OK);
    if (!p.surface) return;
    p.points = subdiv_surface_vertex_count(p.surface);
    p.faces = subdiv_surface_cage_face_count(p.surface);
    check(m, &p);
    subdiv_surface_free(p.surface);
}

static void for_cages(unsigned count, cage_check check)
{
    static char context[64];
    test_context = context;
    for (unsigned seed = 1; seed <= count; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        if (!c) abort();
        sprintf(context, "random cage %u", seed);
        static float colors[3 * RANDOM_MAX_VERTICES];
        for (int i = 0; i < 3 * c->mesh.vertex_count; i++) colors[i] = random_real(c, 0, 1);
        if (seed % 3 == 0) c->mesh.colors = colors;
        check_prepared(&c->mesh, seed, check);
        random_cage_free(c);
    }
}

// ---------------------------------------------------------------------------------- the values

// Floats that nobody has written yet: all bits set, which no evaluation makes.
static float *blank(size_t count)
{
    float *a = malloc(sizeof *a * (count + 1));
    if (!a) abort();
    memset(a, 0xff, sizeof *a * (count + 1));
    return a;
}

static int is_blank(const float *a, int count)
{
    for (size_t i = 0; i < sizeof *a * (size_t)count; i++)
        if (((const unsigned char *)a)[i] != 0xff) return 0;
    return 1;
}

// Values at every vertex of the cage; what lies between them is blank.
static float *make_values(const subdiv_mesh *m, int channels, int stride)
{
    float *values = blank((size_t)stride * (size_t)m->vertex_count);
    for (int v = 0; v < m->vertex_count; v++)
        for (int c = 0; c < channels; c++)
            values[stride * v + c] = (float)(below(2001) - 1000) / 128.0f;
    return values;
}

// All points in one call.
static float *evaluate(const prepared *p, int channels, const float *in, int in_stride,
                       int out_stride, void *scratch)
{
    float *out = blank((size_t)out_stride * (size_t)p->points);
    CHECK_EQUAL(subdiv_evaluate(p->surface, channels, in, in_stride, out, out_stride, scratch,
                                &p->opt), SUBDIV_OK);
    return out;
}

// Scratch memory, aligned as float and no better, whose end is blank.
typedef struct scratch_memory {
    float *memory;
    void  *scratch;
    size_t size;
} scratch_memory;

static scratch_memory new_scratch(const prepared *p, int channels)
{
    scratch_memory s;
    s.size = subdiv_scratch_size(p->surface, channels);
    s.memory = blank(s.size / sizeof(float) + 9);
    s.scratch = s.memory + 1;
    return s;
}

static void free_scratch(scratch_memory *s)
{
    CHECK(is_blank(s->memory, 1));
    CHECK(is_blank((float *)((char *)s->scratch + s->size), 8));
    free(s->memory);
}

// ------------------------------------------------------------------------------ what is promised

static void check_mesh(const subdiv_mesh *m, const prepared *p)
{
    subdiv_mesh fine = {0};
    int *faces, *parents, *again, size = subdiv_surface_face_size(p->surface);
    float *out = evaluate(p, 3, m->positions, 0, 3, NULL);
    CHECK_EQUAL(subdiv_surface_mesh(&fine, p->surface, m->positions, &p->opt), SUBDIV_OK);
    CHECK_EQUAL(p->points, fine.vertex_count);
    CHECK_EQUAL(p->faces, m->face_count);
    CHECK_EQUAL(subdiv_surface_face_count(p->surface), fine.face_count);
    CHECK_EQUAL(size, fine.face_size);
    CHECK(p->levels == 0 || size == (m->scheme == SUBDIV_LOOP ? 3 : 4));
    CHECK(same_bytes(out, fine.positions, 3 * p->points, sizeof(float)));
    faces = int_array(size * fine.face_count, -1), again = int_array(size * fine.face_count, -1);
    parents = int_array(fine.face_count, -1);
    if (size == 0 && fine.face_count) {
        CHECK_EQUAL(subdiv_surface_faces(p->surface, faces, parents, NULL), SUBDIV_ERROR_ARGUMENT);
    } else {
        CHECK_EQUAL(subdiv_surface_faces(p->surface, faces, parents, NULL), SUBDIV_OK);
        CHECK_EQUAL(subdiv_surface_faces(p->surface, again, NULL, NULL), SUBDIV_OK);
        CHECK(same_bytes(faces, fine.face_vertices, size * fine.face_count, sizeof(int)));
        CHECK(same_bytes(again, faces, size * fine.face_count, sizeof(int)));
        CHECK(same_bytes(parents, fine.cage_faces, fine.face_count, sizeof(int)));
    }
    free(out), free(faces), free(again), free(parents);
    subdiv_mesh_free(&fine);
    CHECK(mesh_is_zero(&fine));
}

static void test_same_as_mesh(void)
{
    for_cages(400, check_mesh);
}

static void check_first_inside(const subdiv_mesh *m, const prepared *p)
{
    order o;
    if (p->levels == 0) {
        for (int f = 0; f <= p->faces; f++)
            CHECK_EQUAL(subdiv_first_inside(p->surface, f), p->points);
        return;
    }
    CHECK(order_make(&o, m, p->levels, NULL));
    for (int f = 0; f <= p->faces; f++)
        CHECK_EQUAL(subdiv_first_inside(p->surface, f), o.first_point[f]);
    order_free(&o);
}

static void test_first_inside(void)
{
    for_cages(200, check_first_inside);
}

// Any number of channels in any strides: each as if it were alone, and nothing between them.
static void check_channels(const subdiv_mesh *m, const prepared *p)
{
    int channels = 1 + below(9), wide = below(2);
    int in_stride = channels + below(4) * wide, stride = channels + below(4) * wide;
    float *in = make_values(m, channels, in_stride);
    scratch_memory s = new_scratch(p, channels);
    float *out = evaluate(p, channels, in, in_stride, stride, below(2) ? s.scratch : NULL);
    float *same = evaluate(p, channels, in, in_stride, stride, s.scratch);
    CHECK(same_bytes(out, same, stride * p->points, sizeof(float)));
    CHECK(is_blank(out + (size_t)stride * (size_t)p->points, 1));
    for (int c = 0; c < channels; c++) {
        float *alone = evaluate(p, 1, in + c, in_stride, 1, NULL);
        for (int i = 0; i < p->points; i++)
            if (!same_bytes(out + stride * i + c, alone + i, 1, sizeof(float))) {
                TEST_REPORT("channel %d of %d differs at point %d", c, channels, i);
                break;
            }
        free(alone);
    }
    for (int i = 0; i < p->points; i++)
        if (!is_blank(out + stride * i + channels, stride - channels)) {
            TEST_REPORT("%d channels are written beyond at point %d", channels, i);
            break;
        }
    free(in), free(out), free(same);
    free_scratch(&s);
}

static void test_channels(void)
{
    for_cages(400, check_channels);
}

// ------------------------------------------------------------------------------- linear data

// The value of channel d at a place of a cage face, straight between its vertices; the quads of an
// n-gon lie between a vertex, the middles of two edges and the centre.
static double straight(const order *o, order_place p, const float *in, int d)
{
    const int n = order_grid(o, p.face), size = order_face_size(o, p.face);
    double x = (double)p.column / n, y = (double)p.row / n, q[4], centre = 0;
    for (int i = 0; i < size; i++)
        centre += (double)in[3 * order_face_vertex(o, p.face, i) + d] / size;
    for (int i = 0; i < 4; i++)
        q[i] = (double)in[3 * order_face_vertex(o, p.face, p.quad + i) + d];
    if (o->cage->scheme == SUBDIV_LOOP) return q[0] + x * (q[1] - q[0]) + y * (q[2] - q[0]);
    if (order_is_ngon(o, p.face)) {
        int before = (p.quad + size - 1) % size;
        q[1] = (q[0] + q[1]) / 2;
        q[3] = (q[0] + (double)in[3 * order_face_vertex(o, p.face, before) + d]) / 2;
        q[2] = centre;
    }
    return (1 - y) * ((1 - x) * q[0] + x * q[1]) + y * ((1 - x) * q[3] + x * q[2]);
}

static void check_straight(const subdiv_mesh *m, const prepared *p)
{
    order o;
    subdiv_surface *linear = NULL;
    subdiv_options opt = p->opt;
    int levels = p->levels ? p->levels : 1, points;
    float *out;
    opt.linear = 1;
    opt.limit = 0;
    CHECK_EQUAL(subdiv_prepare(&linear, m, levels, &opt), SUBDIV_OK);
    if (!linear) return;
    CHECK(order_make(&o, m, levels, NULL));
    points = subdiv_surface_vertex_count(linear);
    CHECK_EQUAL(points, o.point_count);
    out = blank(3 * (size_t)points);
    CHECK_EQUAL(subdiv_evaluate(linear, 3, m->positions, 3, out, 3, NULL, &opt), SUBDIV_OK);
    for (int f = 0; f < m->face_count; f++) {
        order_place at = {0, 0, 0, 0, 0};
        at.face = f;
        do {
            for (int d = 0; d < 3; d++)
                CHECK_NEAR(out[3 * place_point(&o, at) + d],
                           straight(&o, at, m->positions, d), 4e-6);
        } while (place_next_point(&o, &at));
    }
    CHECK(same_bytes(out, m->positions, 3 * m->vertex_count, sizeof(float)));
    order_free(&o);
    subdiv_surface_free(linear);
    free(out);
}

static void test_linear_is_straight(void)
{
    for_cages(300, check_straight);
}

// The bilinear scheme by another name, except under Loop.
static void check_bilinear(const subdiv_mesh *m, const prepared *p)
{
    subdiv_mesh smooth = *m, flat = *m, one = {0}, two = {0};
    subdiv_options opt = p->opt;
    if (m->scheme == SUBDIV_LOOP) return;
    smooth.scheme = SUBDIV_CATMULL_CLARK;
    flat.scheme = SUBDIV_BILINEAR;
    opt.linear = 0;
    CHECK_EQUAL(subdiv_refine(&two, &flat, p->levels, &opt), SUBDIV_OK);
    opt.linear = 1;
    CHECK_EQUAL(subdiv_refine(&one, &smooth, p->levels, &opt), SUBDIV_OK);
    CHECK_EQUAL(one.vertex_count, two.vertex_count);
    CHECK(same_bytes(one.positions, two.positions, 3 * one.vertex_count, sizeof(float)));
    subdiv_mesh_free(&one);
    subdiv_mesh_free(&two);
}

static void test_linear_is_bilinear(void)
{
    for_cages(200, check_bilinear);
}

// ------------------------------------------------------------------------- what is not written

// A result does not depend on what was in the memory that it was made in.
static void check_filling(const subdiv_mesh *m, const prepared *p)
{
    static const int fillings[3] = { 0, 0x3f, 0xbf };         // floats: 0, 0.75, -0.37
    subdiv_mesh fine[3];
    subdiv_stencils stencils = {0};
    for (int i = 0; i < 3; i++) {
        filling = fillings[i];
        CHECK_EQUAL(subdiv_refine(&fine[i], m, p->levels, &p->opt), SUBDIV_OK);
        CHECK_EQUAL(subdiv_refined_stencils(&stencils, p->surface, 0, p->points, NULL), SUBDIV_OK);
        subdiv_stencils_free(&stencils);
        CHECK(i == 0 || same_mesh(&fine[0], &fine[i]));
    }
    for (int i = 0; i < 3; i++) subdiv_mesh_free(&fine[i]);
    for (int i = 0; i < 3; i++) {
        subdiv_tessellation how = {0};
        how.rate = 3;
        filling = fillings[i];
        CHECK_EQUAL(subdiv_tessellate(&fine[i], m, &how, NULL), SUBDIV_OK);
        CHECK(i == 0 || same_mesh(&fine[0], &fine[i]));
    }
    for (int i = 0; i < 3; i++) subdiv_mesh_free(&fine[i]);
}

static void test_filling(void)
{
    for_cages(100, check_filling);
}

// ---------------------------------------------------------------------------------- deep levels

static double size_of(const float *values, int count)
{
    double size = 1;
    for (int i = 0; i < count; i++) size = fmax(size, fabs((double)values[i]));
    return size;
}

// Refined by all levels at once, and by two at a time, which needs no frames. Where faces have more
// than one edge in common, the first step takes them apart.
static int compared;

static void check_deep(const subdiv_mesh *m, const prepared *p)
{
    int levels = face_vertex_count(m) < 40 ? 6 : 5, first = levels - 2;
    subdiv_mesh whole = {0}, half = {0}, twice = {0};
    subdiv_options opt = p->opt, then = p->opt;
    opt.keep_holes = then.keep_holes = 1;
    opt.limit = then.limit = 0;
    CHECK_EQUAL(subdiv_refine(&whole, m, levels, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refine(&half, m, 2, &opt), SUBDIV_OK);
    for (int left = first; left > 0; left -= 2) {
        CHECK_EQUAL(subdiv_refine(&twice, &half, left < 2 ? left : 2, &then), SUBDIV_OK);
        subdiv_mesh_free(&half);
        half = twice;
    }
    if (whole.vertex_count == half.vertex_count && whole.uv_count == half.uv_count) {
        int points = whole.vertex_count, uvs = whole.uv_count;
        CHECK(points_apart(whole.positions, half.positions, points, 3) <=
              2e-6 * size_of(m->positions, 3 * m->vertex_count));
        CHECK(points_apart(whole.uvs, half.uvs, uvs, 2) <= 2e-6 * size_of(m->uvs, 2 * m->uv_count));
        compared++;
    }
    subdiv_mesh_free(&whole);
    subdiv_mesh_free(&half);
}

static void test_deep_levels(void)
{
    compared = 0;
    for_cages(80, check_deep);
    CHECK(compared >= 75);
}

// In the end each level doubles the scratch memory, as it does the points on the edges of the cage.
static void check_scratch_size(const subdiv_mesh *m, const prepared *p)
{
    size_t before = 0;
    for (int levels = 6; levels <= 9; levels++) {
        subdiv_surface *surface = NULL;
        CHECK_EQUAL(subdiv_prepare(&surface, m, levels, &p->opt), SUBDIV_OK);
        size_t size = surface ? subdiv_scratch_size(surface, 3) : 0;
        CHECK(levels == 6 || (double)size <= 2.3 * (double)before);
        before = size;
        subdiv_surface_free(surface);
    }
}

static void test_scratch_size(void)
{
    for_cages(20, check_scratch_size);
}

// ------------------------------------------------------------------------- ranges and windows

// An evaluation that has begun, and its result as a whole.
typedef struct evaluation {
    const prepared *p;
    int channels, stride;
    scratch_memory s;
    float *whole, *part;              // [stride * points]
} evaluation;

static evaluation begin(const subdiv_mesh *m, const prepared *p)
{
    evaluation e;
    float *in;
    e.p = p;
    e.channels = 1 + below(9);
    e.stride = e.channels + below(2);
    e.s = new_scratch(p, e.channels);
    in = make_values(m, e.channels, e.channels);
    e.whole = evaluate(p, e.channels, in, 0, e.stride, NULL);
    e.part = blank((size_t)e.stride * (size_t)p->points);
    CHECK_EQUAL(subdiv_evaluate_begin(p->surface, e.channels, in, 0, e.s.scratch, &p->opt),
                SUBDIV_OK);
    free(in);
    return e;
}

static void end(evaluation *e)
{
    free(e->whole), free(e->part);
    free_scratch(&e->s);
}

// Evaluates a range into fresh memory and counts how often each point has been written so far.
static void run_range(evaluation *e, int first, int count, int *written)
{
    size_t floats = (size_t)e->stride * (size_t)e->p->points;
    memset(e->part, 0xff, sizeof(float) * floats);
    CHECK_EQUAL(subdiv_evaluate_faces(e->p->surface, e->channels, e->s.scratch, first, count, 0,
                                      e->p->points, e->part, e->stride, &e->p->opt), SUBDIV_OK);
    for (int i = 0; i < e->p->points; i++) {
        const float *point = e->part + e->stride * i;
        if (is_blank(point, e->stride)) continue;
        written[i]++;
        if (same_bytes(point, e->whole + e->stride * i, e->stride, sizeof(float))) continue;
        TEST_REPORT("faces %d to %d: point %d has other bits", first, first + count - 1, i);
        return;
    }
}

// All faces, range by range in any order, with a few empty ones: every point is written once.
static void check_ranges(const subdiv_mesh *m, const prepared *p)
{
    evaluation e = begin(m, p);
    int *written = int_array(p->points, 0), *starts = int_array(p->faces + 2, 0), ranges = 0;
    int longest = below(3) ? 1 + below(p->faces) : 1, backwards = below(3);
    for (int f = 0; f < p->faces; f += 1 + below(longest)) starts[ranges++] = f;
    starts[ranges] = p->faces;
    for (int i = 0; i < ranges; i++) {
        int r = backwards ? ranges - 1 - i : (i + ranges / 2) % ranges;
        run_range(&e, starts[r], starts[r + 1] - starts[r], written);
        if (below(4) == 0) run_range(&e, starts[r], 0, written);
    }
    for (int i = 0; i < p->points; i++)
        if (written[i] != 1) {
            TEST_REPORT("point %d is written %d times", i, written[i]);
            break;
        }
    free(written), free(starts);
    end(&e);
}

static void test_ranges(void)
{
    for_cages(400, check_ranges);
}

static void check_window(evaluation *e, int first_face, int faces, int first, int count)
{
    float *all, *window = blank((size_t)e->stride * (size_t)(count + 2));
    int *written = int_array(e->p->points, 0);
    run_range(e, first_face, faces, written);
    CHECK_EQUAL(subdiv_evaluate_faces(e->p->surface, e->channels, e->s.scratch, first_face, faces,
                                      first, count, window + e->stride, e->stride, NULL),
                SUBDIV_OK);
    all = e->part + (size_t)e->stride * (size_t)first;
    CHECK(same_bytes(window + e->stride, all, e->stride * count, sizeof(float)));
    CHECK(is_blank(window, e->stride));
    CHECK(is_blank(window + e->stride * (count + 1), e->stride));
    free(window), free(written);
}

// Some points of some faces, as they are among all.
static void check_windows(const subdiv_mesh *m, const prepared *p)
{
    evaluation e = begin(m, p);
    for (int i = 0; i < 12; i++) {
        int face = below(p->faces), faces = below(p->faces - face + 1);
        int first = below(p->points), most = p->points - first;
        int count = below(most + 1 > 40 && i % 2 ? 40 : most + 1);
        if (i % 3 == 0) face = 0, faces = p->faces;
        check_window(&e, face, faces, first, count);
    }
    end(&e);
}

static void test_windows(void)
{
    for_cages(300, check_windows);
}

// The points inside a cage face need that face alone.
static void check_inside(const subdiv_mesh *m, const prepared *p)
{
    evaluation e = begin(m, p);
    for (int f = 0; f < p->faces; f++) {
        int first = subdiv_first_inside(p->surface, f);
        int count = subdiv_first_inside(p->surface, f + 1) - first;
        float *inside = blank((size_t)e.stride * (size_t)count);
        CHECK_EQUAL(subdiv_evaluate_faces(p->surface, e.channels, e.s.scratch, f, 1, first, count,
                                          inside, e.stride, NULL), SUBDIV_OK);
        CHECK(same_bytes(inside, e.whole + (size_t)e.stride * (size_t)first, e.stride * count,
                         sizeof(float)));
        free(inside);
    }
    end(&e);
}

static void test_inside_of_faces(void)
{
    for_cages(200, check_inside);
}

// ---------------------------------------------------------------------------------------- threads

typedef struct crew {
    int threads;                      // 0: the caller alone, last job first
    int calls, jobs;
    pthread_mutex_t lock;
    int next, count;
    void (*job)(void *, int);
    void *context;
} crew;

static void *work(void *user)
{
    crew *c = user;
    for (;;) {
        pthread_mutex_lock(&c->lock);
        int i = c->next < c->count ? c->next++ : -1;
        pthread_mutex_unlock(&c->lock);
        if (i < 0) return NULL;
        c->job(c->context, i);
    }
}

static void run_crew(void *user, void (*job)(void *, int), void *context, int count)
{
    crew *c = user;
    pthread_t threads[8];
    c->calls++;
    c->jobs += count;
    c->job = job, c->context = context;
    c->next = 0, c->count = count;
    for (int i = count - 1; i >= 0 && c->threads == 0; i--) job(context, i);
    for (int i = 0; i < c->threads; i++)
        if (pthread_create(&threads[i], NULL, work, c)) abort();
    for (int i = 0; i < c->threads; i++) pthread_join(threads[i], NULL);
}

static void start_crew(crew *c, int threads, subdiv_options *opt)
{
    memset(c, 0, sizeof *c);
    c->threads = threads;
    if (pthread_mutex_init(&c->lock, NULL)) abort();
    opt->run = run_crew;
    opt->user = c;
}

static int same_result(const subdiv_mesh *a, const subdiv_mesh *b)
{
    return same_mesh(a, b) && same_bytes(a->cage_faces, b->cage_faces, a->face_count, sizeof(int));
}

// One crew does all that takes threads, and gives what the caller alone gives.
static void check_crew(const subdiv_mesh *m, const prepared *p, crew *c, int threads)
{
    subdiv_mesh alone = {0}, together = {0}, refined = {0};
    prepared q = *p;
    int channels = 1 + below(9), jobs_of_all = 0;
    float *in = make_values(m, channels, channels);
    float *out = evaluate(p, channels, in, 0, channels, NULL), *same;
    CHECK_EQUAL(subdiv_surface_mesh(&alone, p->surface, m->positions, &p->opt), SUBDIV_OK);
    start_crew(c, threads, &q.opt);
    same = evaluate(&q, channels, in, 0, channels, NULL);
    CHECK(same_bytes(out, same, channels * p->points, sizeof(float)));
    if (p->levels && p->faces > 1) CHECK(c->jobs > c->calls && c->calls > 0);
    jobs_of_all = c->jobs;
    CHECK_EQUAL(subdiv_surface_mesh(&together, p->surface, m->positions, &q.opt), SUBDIV_OK);
    if (p->levels && p->faces > 1) CHECK(c->jobs > jobs_of_all);
    CHECK_EQUAL(subdiv_refine(&refined, m, p->levels, &q.opt), SUBDIV_OK);
    CHECK(same_result(&alone, &together));
    CHECK(same_result(&alone, &refined));
    pthread_mutex_destroy(&c->lock);
    subdiv_mesh_free(&alone), subdiv_mesh_free(&together), subdiv_mesh_free(&refined);
    free(in), free(out), free(same);
}

static void check_threads(const subdiv_mesh *m, const prepared *p)
{
    static const int threads[4] = { 0, 1, 2, 7 };
    crew c;
    check_crew(m, p, &c, threads[below(4)]);
}

static void test_threads(void)
{
    for_cages(200, check_threads);
}

// Enough vertices for the work points to be shared out, too.
static void test_threads_on_large_cages(void)
{
    static const int threads[4] = { 0, 1, 2, 7 };
    for (int i = 0; i < 8; i++) {
        static test_cage small;
        subdiv_mesh large = {0};
        crew c;
        prepared p;
        memset(&p, 0, sizeof p);
        if (i % 2) build_bipyramid(&small, SUBDIV_LOOP, 5);
        else build_prism(&small, 5);
        cage_crease(&small, 0, i % 2 ? 2 : 1, 5.5);
        CHECK_EQUAL(subdiv_refine(&large, &small.mesh, i % 2 ? 6 : 5, NULL), SUBDIV_OK);
        p.levels = 2;
        CHECK_EQUAL(subdiv_prepare(&p.surface, &large, p.levels, &p.opt), SUBDIV_OK);
        if (!p.surface) return;
        p.points = subdiv_surface_vertex_count(p.surface);
        p.faces = large.face_count;
        check_crew(&large, &p, &c, threads[i / 2]);
        CHECK(c.calls > 2);
        subdiv_surface_free(p.surface);
        subdiv_mesh_free(&large);
    }
}

// ----------------------------------------------------------------------------- streamed OBJ

typedef struct text {
    char  *bytes;                     // NULL: only the sum is kept
    size_t size, capacity;
    unsigned long long sum;           // of all bytes
} text;

static size_t keep_text(void *user, const void *bytes, size_t size)
{
    text *t = user;
    for (size_t i = 0; i < size; i++)
        t->sum = (t->sum ^ ((const unsigned char *)bytes)[i]) * 1099511628211u;
    if (t->bytes && t->size + size <= t->capacity) memcpy(t->bytes + t->size, bytes, size);
    t->size += size;
    return size;
}

static text new_text(size_t capacity)
{
    text t;
    memset(&t, 0, sizeof t);
    t.sum = 14695981039346656037u;
    t.capacity = capacity;
    t.bytes = capacity ? malloc(capacity) : NULL;
    return t;
}

// Streams the text in so many parts, one behind the other; each of them up to so many bytes.
static void stream_parts(const subdiv_surface *surface, const float *positions, int parts,
                         size_t most, text *out, const subdiv_options *opt)
{
    subdiv_options of_part = *opt;
    of_part.part_count = parts;
    for (int part = 0; part < parts; part++) {
        size_t before = out->size;
        of_part.part = part;
        CHECK_EQUAL(subdiv_stream_obj_callback(surface, positions, keep_text, out, &of_part),
                    SUBDIV_OK);
        CHECK(out->size - before <= most);
    }
}

static void check_stream(const subdiv_mesh *m, const prepared *p)
{
    subdiv_mesh fine = {0}, cage = *m;
    float factor = below(4) ? 1 : 0x1p122f;                     // sums would overflow
    subdiv_options opt = p->opt;
    text saved = {0}, streamed = {0};
    crew c;
    cage.positions = blank(3 * (size_t)m->vertex_count);
    for (int i = 0; i < 3 * m->vertex_count; i++) cage.positions[i] = factor * m->positions[i];
    saved = new_text(1 << 22), streamed = new_text(1 << 22);
    opt.no_tags = below(4) == 0;
    CHECK_EQUAL(subdiv_refine(&fine, &cage, p->levels, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_save_obj_callback(&fine, keep_text, &saved, &opt), SUBDIV_OK);
    CHECK(saved.bytes && streamed.bytes && saved.size <= saved.capacity);
    start_crew(&c, below(3), &opt);
    if (below(2))
        CHECK_EQUAL(subdiv_stream_obj_callback(p->surface, cage.positions, keep_text, &streamed,
                                               &opt), SUBDIV_OK);
    else stream_parts(p->surface, cage.positions, 1 + below(12), saved.size, &streamed, &opt);
    pthread_mutex_destroy(&c.lock);
    CHECK_EQUAL(saved.size, streamed.size);
    if (saved.size == streamed.size)
        CHECK(same_bytes(saved.bytes, streamed.bytes, (int)saved.size, 1));
    free(saved.bytes), free(streamed.bytes), free(cage.positions);
    subdiv_mesh_free(&fine);
}

static void test_stream(void)
{
    for_cages(300, check_stream);
}

// More points than the library holds at once, in parts that share the work.
static void test_large_stream(void)
{
    static test_cage cage;
    subdiv_mesh fine = {0};
    subdiv_surface *surface = NULL;
    text saved = new_text(0), streamed = new_text(0);
    subdiv_options opt = {0};
    opt.limit = 1;
    build_prism(&cage, 5);
    cage_crease(&cage, 0, 1, 2.5);
    cage_crease(&cage, 1, 2, SUBDIV_INFINITE);
    cage_hole(&cage, 3);
    CHECK_EQUAL(subdiv_prepare(&surface, &cage.mesh, 9, &opt), SUBDIV_OK);
    if (!surface) return;
    CHECK_EQUAL(subdiv_surface_mesh(&fine, surface, cage.positions, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_save_obj_callback(&fine, keep_text, &saved, NULL), SUBDIV_OK);
    stream_parts(surface, cage.positions, 2, saved.size / 10 * 7, &streamed, &opt);
    CHECK_EQUAL(saved.size, streamed.size);
    CHECK(saved.sum == streamed.sum);
    subdiv_surface_free(surface);
    subdiv_mesh_free(&fine);
}

// A cage of many vertices with colours.
static void test_stream_of_a_large_cage(void)
{
    static test_cage prism;
    float colors[3 * 10];
    subdiv_mesh cage = {0}, fine = {0};
    subdiv_surface *surface = NULL;
    text saved = new_text(0), streamed = new_text(0);
    for (int i = 0; i < 30; i++) colors[i] = (float)(i % 7) / 7;
    build_prism(&prism, 5);
    prism.mesh.colors = colors;
    CHECK_EQUAL(subdiv_refine(&cage, &prism.mesh, 5, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_prepare(&surface, &cage, 1, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_surface_mesh(&fine, surface, cage.positions, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_save_obj_callback(&fine, keep_text, &saved, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_stream_obj_callback(surface, cage.positions, keep_text, &streamed, NULL),
                SUBDIV_OK);
    CHECK(saved.size == streamed.size && saved.sum == streamed.sum);
    subdiv_surface_free(surface);
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&cage);
}

// ----------------------------------------------------------------------- polygons under Loop

// With triangulate the prepared faces are the triangles, but results name the polygons.
static void test_triangulated(void)
{
    static test_cage cage;
    prepared p;
    int *parents;
    memset(&p, 0, sizeof p);
    build_prism(&cage, 5);
    cage.mesh.scheme = SUBDIV_LOOP;
    cage_hole(&cage, 1);
    p.levels = 2;
    p.opt.triangulate = 1;
    CHECK_EQUAL(subdiv_prepare(&p.surface, &cage.mesh, p.levels, &p.opt), SUBDIV_OK);
    if (!p.surface) return;
    p.points = subdiv_surface_vertex_count(p.surface);
    p.faces = subdiv_surface_cage_face_count(p.surface);
    CHECK_EQUAL(p.faces, 3 + 3 + 5 * 2);
    CHECK_EQUAL(subdiv_first_inside(p.surface, p.faces), p.points);
    parents = int_array(subdiv_surface_face_count(p.surface), -1);
    int *faces = int_array(3 * subdiv_surface_face_count(p.surface), -1);
    CHECK_EQUAL(subdiv_surface_faces(p.surface, faces, parents, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_surface_face_count(p.surface), 16 * (3 + 5 * 2));
    for (int i = 0; i < subdiv_surface_face_count(p.surface); i++)
        CHECK_EQUAL(parents[i], i < 48 ? 0 : 2 + (i - 48) / 32);
    for (int i = 0; i < 20; i++) {
        random_state = (unsigned)i;
        check_ranges(&cage.mesh, &p);
        check_stream(&cage.mesh, &p);
    }
    free(parents), free(faces);
    subdiv_surface_free(p.surface);
}

// Without faces there is nothing to refine, but the vertices are there.
static void test_no_faces(void)
{
    float positions[6] = { 1, 2, 3, 4, 5, 6 };
    subdiv_mesh cage = {0};
    prepared p;
    memset(&p, 0, sizeof p);
    cage.vertex_count = 2;
    cage.positions = positions;
    for (p.levels = 0; p.levels <= 30; p.levels += p.levels < 3 ? 1 : 9) {
        p.surface = NULL;
        CHECK_EQUAL(subdiv_prepare(&p.surface, &cage, p.levels, NULL), SUBDIV_OK);
        if (!p.surface) return;
        p.points = subdiv_surface_vertex_count(p.surface);
        CHECK_EQUAL(p.points, 2);
        CHECK_EQUAL(subdiv_surface_face_count(p.surface), 0);
        CHECK_EQUAL(subdiv_surface_cage_face_count(p.surface), 0);
        CHECK_EQUAL(subdiv_first_inside(p.surface, 0), 2);
        float *out = evaluate(&p, 3, positions, 3, 3, NULL);
        CHECK(same_bytes(out, positions, 6, sizeof(float)));
        check_stream(&cage, &p);
        free(out);
        subdiv_surface_free(p.surface);
    }
}

// ------------------------------------------------------------------------------- allocations

static void check_allocations(const subdiv_mesh *m, const prepared *p)
{
    evaluation e = begin(m, p);
    float *in = make_values(m, e.channels, e.channels);
    crew c;
    prepared q = *p;
    start_crew(&c, 2, &q.opt);
    allocations = 0;
    for (int i = 0; i < 2; i++) {
        const subdiv_options *opt = i ? &q.opt : NULL;
        subdiv_evaluate(p->surface, e.channels, in, 0, e.part, e.stride, e.s.scratch, opt);
        subdiv_evaluate_begin(p->surface, e.channels, in, 0, e.s.scratch, opt);
        subdiv_evaluate_faces(p->surface, e.channels, e.s.scratch, 0, p->faces, 0, p->points,
                              e.part, e.stride, opt);
    }
    CHECK_EQUAL(allocations, 0);
    subdiv_evaluate(p->surface, e.channels, in, 0, e.part, e.stride, NULL, NULL);
    CHECK(allocations <= 1 && (allocations || !e.s.size));
    pthread_mutex_destroy(&c.lock);
    free(in);
    end(&e);
}

// Nor does filling a vertex buffer allocate, frame by frame.
static void check_buffer_allocations(const subdiv_mesh *m, const prepared *p)
{
    subdiv_mesh fine = {0};
    subdiv_buffer buffer;
    subdiv_vertices out = {0};
    CHECK_EQUAL(subdiv_surface_mesh(&fine, p->surface, m->positions, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_make_buffer(&buffer, &fine, 4, NULL), SUBDIV_OK);
    void *scratch = malloc(subdiv_scratch_size(p->surface, 3) + 1);
    out.positions = (float *)malloc(3 * sizeof(float) * (size_t)buffer.vertex_count + 1);
    allocations = 0;
    CHECK_EQUAL(subdiv_evaluate_buffer(&buffer, p->surface, m->positions, &out, scratch, NULL),
                SUBDIV_OK);
    CHECK_EQUAL(allocations, 0);
    free(scratch), free(out.positions);
    subdiv_buffer_free(&buffer), subdiv_mesh_free(&fine);
}

static void test_allocations(void)
{
    for_cages(60, check_allocations);
    for_cages(60, check_buffer_allocations);
}

int main(void)
{
    RUN(test_same_as_mesh);
    RUN(test_first_inside);
    RUN(test_channels);
    RUN(test_linear_is_straight);
    RUN(test_linear_is_bilinear);
    RUN(test_filling);
    RUN(test_deep_levels);
    RUN(test_scratch_size);
    RUN(test_ranges);
    RUN(test_windows);
    RUN(test_inside_of_faces);
    RUN(test_threads);
    RUN(test_threads_on_large_cages);
    RUN(test_stream);
    RUN(test_large_stream);
    RUN(test_stream_of_a_large_cage);
    RUN(test_triangulated);
    RUN(test_no_faces);
    RUN(test_allocations);
    return test_end("evaluate");
}
