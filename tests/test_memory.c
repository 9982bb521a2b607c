// Every allocation fails once: the answer is SUBDIV_ERROR_MEMORY, the output is zeroed, nothing
// leaks and nothing is freed twice. The user pointer reaches every call of the allocator.
//
//     cc -I. tests/test_memory.c -o build/test_memory -lm && build/test_memory

#include <stdlib.h>

static void *heap_malloc(size_t size, void *user);
static void  heap_free(void *pointer, void *user);

#define SUBDIV_MALLOC(size, user)  heap_malloc(size, user)
#define SUBDIV_FREE(pointer, user) heap_free(pointer, user)

#define SDV_FULL_LEVELS 2              // so that level 3 has frames, as deep ones do
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/test.h"
#include "lib/same.h"

// ------------------------------------------------------------------------- the allocator's books

enum { HEAP_BLOCKS = 1024 };

typedef struct heap {
    int    calls, fail_at;            // call number fail_at fails; 0: none
    int    failures;
    int    live, wrong;               // blocks in use; frees of what is not in use
    void  *blocks[HEAP_BLOCKS];
} heap;

static heap main_heap;
static int  foreign_calls;            // with another user pointer

static void *heap_malloc(size_t size, void *user)
{
    heap *h = &main_heap;
    if (user != h) foreign_calls++;
    if (++h->calls == h->fail_at) {
        h->failures++;
        return NULL;
    }
    void *block = malloc(size ? size : 1);
    if (block) memset(block, 0xa5, size);           // nobody may count on zeros
    for (int i = 0; block && i < HEAP_BLOCKS; i++) {
        if (h->blocks[i]) continue;
        h->blocks[i] = block;
        h->live++;
        return block;
    }
    free(block);
    h->wrong++;
    return NULL;
}

static void heap_free(void *pointer, void *user)
{
    heap *h = &main_heap;
    if (user != h) foreign_calls++;
    if (pointer == NULL) return;
    for (int i = 0; i < HEAP_BLOCKS; i++) {
        if (h->blocks[i] != pointer) continue;
        h->blocks[i] = NULL;
        h->live--;
        free(pointer);
        return;
    }
    h->wrong++;
}

// ------------------------------------------------------------------------------------ the calls

static char obj_text[200000];         // a cage that makes every growing array grow
static size_t obj_size;

static void write_line(const char *format, int a, int b, int c)
{
    int n = snprintf(obj_text + obj_size, sizeof obj_text - obj_size, format, a, b, c);
    obj_size += (size_t)n;
}

// A strip of coloured quads with UVs that ends in a pentagon and a triangle without, with
// statements, two warnings, and tags of each kind.
static void make_obj_text(void)
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
    write_line("f %d %d %d", COUNT - 5, COUNT - 3, COUNT - 1), write_line(" %d %d\n", COUNT - 2,
                                                                         COUNT - 4, 0);
    write_line("f %d %d %d\n", COUNT - 1, COUNT, COUNT - 2);
    for (int i = 0; i + 9 < COUNT; i += 2) write_line("t crease 2/1/0 %d %d %d\n", i, i + 2, i % 3);
    for (int i = 0; i + 9 < COUNT; i += 7) write_line("t corner 1/1/0 %d %d\n", i, i % 11, 0);
    for (int i = 0; i + 9 < COUNT / 2; i += 5) write_line("t hole 1/0/0 %d\n", i, 0, 0);
    write_line("t hole 1/0/0 %d\n", 999999, 0, 0);
}

typedef struct cursor {
    size_t at;
} cursor;

static size_t read_text(void *user, void *bytes, size_t size)
{
    cursor *c = (cursor *)user;
    size_t n = obj_size - c->at;
    if (n > size) n = size;
    memcpy(bytes, obj_text + c->at, n);
    c->at += n;
    return n;
}

static size_t write_away(void *user, const void *bytes, size_t size)
{
    (void)user;
    (void)bytes;
    return size;
}

// Every call below: does its work once and reports the result; a failed output must be zeroed.
// cage is a good one, made without failures.
typedef subdiv_result (*call)(const subdiv_mesh *cage, const subdiv_options *opt);

static subdiv_result keep_nothing(subdiv_mesh *mesh, subdiv_result result)
{
    if (result) CHECK(mesh_is_zero(mesh));
    subdiv_mesh_free(mesh);
    return result;
}

static subdiv_result call_load_memory(const subdiv_mesh *cage, const subdiv_options *opt)
{
    subdiv_mesh mesh;
    (void)cage;
    memset(&mesh, 0x55, sizeof mesh);
    return keep_nothing(&mesh, subdiv_load_obj_memory(&mesh, obj_text, obj_size, opt));
}

static subdiv_result call_load_callback(const subdiv_mesh *cage, const subdiv_options *opt)
{
    subdiv_mesh mesh;
    cursor c = {0};
    (void)cage;
    memset(&mesh, 0x55, sizeof mesh);
    return keep_nothing(&mesh, subdiv_load_obj_callback(&mesh, read_text, &c, opt));
}

static subdiv_result refine_as(const subdiv_mesh *cage, subdiv_scheme scheme, int levels,
                               const subdiv_options *opt)
{
    subdiv_mesh mesh, other = *cage;
    other.scheme = scheme;
    memset(&mesh, 0x55, sizeof mesh);
    return keep_nothing(&mesh, subdiv_refine(&mesh, &other, levels, opt));
}

static subdiv_result call_copy(const subdiv_mesh *cage, const subdiv_options *opt)
{
    return refine_as(cage, SUBDIV_CATMULL_CLARK, 0, opt);
}

static subdiv_result call_refine(const subdiv_mesh *cage, const subdiv_options *opt)
{
    return refine_as(cage, SUBDIV_CATMULL_CLARK, 2, opt);
}

// The last faces of the strip, with its pentagon and its triangle.
static subdiv_result call_frames(const subdiv_mesh *cage, const subdiv_options *opt)
{
    subdiv_mesh other = *cage;
    other.face_count = 40;
    other.face_sizes += cage->face_count - other.face_count;
    for (int f = 0; f < cage->face_count - other.face_count; f++) {
        other.face_vertices += cage->face_sizes[f];
        other.face_uvs += cage->face_sizes[f];
    }
    other.statement_count = other.hole_count = 0;
    return refine_as(&other, SUBDIV_CATMULL_CLARK, 3, opt);
}

static subdiv_result call_bilinear(const subdiv_mesh *cage, const subdiv_options *opt)
{
    return refine_as(cage, SUBDIV_BILINEAR, 2, opt);
}

static subdiv_result call_loop(const subdiv_mesh *cage, const subdiv_options *opt)
{
    subdiv_options triangulate = *opt;
    triangulate.triangulate = 1;
    triangulate.keep_holes = 1;
    return refine_as(cage, SUBDIV_LOOP, 2, &triangulate);
}

static subdiv_result call_chaikin(const subdiv_mesh *cage, const subdiv_options *opt)
{
    subdiv_mesh other = *cage;
    other.creasing = SUBDIV_CREASING_CHAIKIN;
    other.boundary = SUBDIV_BOUNDARY_NONE;
    return refine_as(&other, SUBDIV_CATMULL_CLARK, 2, opt);
}

static subdiv_result call_prepare(const subdiv_mesh *cage, const subdiv_options *opt)
{
    subdiv_surface *surface = (subdiv_surface *)&main_heap;
    subdiv_mesh mesh;
    subdiv_result result = subdiv_prepare(&surface, cage, 2, opt);
    if (result) {
        CHECK(surface == NULL);
        return result;
    }
    memset(&mesh, 0x55, sizeof mesh);
    result = keep_nothing(&mesh, subdiv_surface_mesh(&mesh, surface, cage->positions, opt));
    subdiv_surface_free(surface);
    return result;
}

static subdiv_result limit_as(const subdiv_mesh *cage, subdiv_scheme scheme, int levels,
                              const subdiv_options *opt)
{
    subdiv_options limit = *opt;
    limit.limit = limit.triangulate = 1;
    return refine_as(cage, scheme, levels, &limit);
}

static subdiv_result call_limit(const subdiv_mesh *cage, const subdiv_options *opt)
{
    return limit_as(cage, SUBDIV_CATMULL_CLARK, 2, opt);
}

static subdiv_result call_limit_loop(const subdiv_mesh *cage, const subdiv_options *opt)
{
    return limit_as(cage, SUBDIV_LOOP, 1, opt);
}

static subdiv_result call_limit_zero(const subdiv_mesh *cage, const subdiv_options *opt)
{
    return limit_as(cage, SUBDIV_CATMULL_CLARK, 0, opt);
}

static subdiv_result stencils_as(const subdiv_mesh *cage, int limit, const subdiv_options *opt)
{
    subdiv_surface *surface;
    subdiv_options with = *opt;
    subdiv_stencils stencils, zero;
    with.limit = limit;
    subdiv_result result = subdiv_prepare(&surface, cage, 2, &with);
    if (result) return result;
    memset(&zero, 0, sizeof zero);
    memset(&stencils, 0x55, sizeof stencils);
    result = subdiv_refined_stencils(&stencils, surface, 0, 1500, opt);
    if (result) CHECK(memcmp(&stencils, &zero, sizeof zero) == 0);
    subdiv_stencils_free(&stencils);
    subdiv_surface_free(surface);
    return result;
}

static subdiv_result call_stencils(const subdiv_mesh *cage, const subdiv_options *opt)
{
    return stencils_as(cage, 0, opt);
}

static subdiv_result call_limit_stencils(const subdiv_mesh *cage, const subdiv_options *opt)
{
    return stencils_as(cage, 1, opt);
}

// On a face of the strip and, in a nest, at its pentagon.
static subdiv_result call_stencils_at(const subdiv_mesh *cage, const subdiv_options *opt)
{
    subdiv_surface *surface;
    subdiv_stencils stencils, zero;
    subdiv_location at[2] = { { 40, 0, 0.25f, 0.5f }, { cage->face_count - 2, 3, 0.9999f, 1 } };
    subdiv_result result = subdiv_prepare(&surface, cage, SUBDIV_EXACT, opt);
    if (result) return result;
    memset(&zero, 0, sizeof zero);
    memset(&stencils, 0x55, sizeof stencils);
    result = subdiv_stencils_at(&stencils, surface, 2, at, opt);
    if (result) CHECK(memcmp(&stencils, &zero, sizeof zero) == 0);
    subdiv_stencils_free(&stencils);
    subdiv_surface_free(surface);
    return result;
}

static subdiv_result call_explain(const subdiv_mesh *cage, const subdiv_options *opt)
{
    char text[4096] = "";
    subdiv_mesh other = *cage;
    subdiv_options triangulate = *opt;
    triangulate.triangulate = 1;
    other.scheme = SUBDIV_LOOP;
    other.creasing = SUBDIV_CREASING_CHAIKIN;
    subdiv_result result = subdiv_explain(text, sizeof text, &other, 12, &triangulate);
    CHECK((text[0] != 0) == (result == SUBDIV_OK));
    return result;
}

static int rate_of_edge(void *user, int edge, const float *a, const float *middle, const float *b)
{
    (void)user;
    return 1 + edge % 3 + (a[0] < middle[0]) + (middle[0] < b[0]);
}

// The first faces of the cage, with UVs, colours and statements.
static subdiv_result tessellate_as(const subdiv_mesh *cage, subdiv_scheme scheme,
                                   const subdiv_options *opt)
{
    subdiv_mesh mesh, other = *cage;
    subdiv_tessellation how = {0};
    subdiv_options triangulate = *opt;
    triangulate.triangulate = 1;
    other.scheme = scheme;
    other.face_count = 40;
    other.crease_count = other.corner_count = other.statement_count = 5;
    other.hole_count = 1;
    how.edge_rate = rate_of_edge;
    memset(&mesh, 0x55, sizeof mesh);
    return keep_nothing(&mesh, subdiv_tessellate(&mesh, &other, &how, &triangulate));
}

static subdiv_result call_tessellate(const subdiv_mesh *cage, const subdiv_options *opt)
{
    return tessellate_as(cage, SUBDIV_CATMULL_CLARK, opt);
}

// Evaluation at a vertex with so many faces takes memory of its own.
static subdiv_result call_tessellate_fan(const subdiv_mesh *cage, const subdiv_options *opt)
{
    enum { FACES = 90 };
    static int triangles[3 * FACES];
    subdiv_mesh mesh, fan = {0};
    for (int i = 0; i < FACES; i++) {
        triangles[3 * i + 1] = 1 + i;
        triangles[3 * i + 2] = 1 + (i + 1) % FACES;
    }
    fan.vertex_count = 1 + FACES;
    fan.positions = cage->positions;
    fan.face_count = FACES;
    fan.face_size = 3;
    fan.face_vertices = triangles;
    memset(&mesh, 0x55, sizeof mesh);
    return keep_nothing(&mesh, subdiv_tessellate(&mesh, &fan, NULL, opt));
}

static subdiv_result call_tessellate_loop(const subdiv_mesh *cage, const subdiv_options *opt)
{
    return tessellate_as(cage, SUBDIV_LOOP, opt);
}

// For a copy of the cage; a failure has to leave it as it was.
static subdiv_result call_normals(const subdiv_mesh *cage, const subdiv_options *opt)
{
    subdiv_mesh mesh = *cage, before = mesh;
    mesh.memory = before.memory = NULL;
    subdiv_result result = subdiv_normals(&mesh, opt);
    CHECK((mesh.normals != NULL) == (result == SUBDIV_OK));
    if (result) CHECK(memcmp(&mesh, &before, sizeof mesh) == 0);
    subdiv_mesh_free(&mesh);
    return result;
}

static subdiv_result call_inspect(const subdiv_mesh *cage, const subdiv_options *opt)
{
    subdiv_info info, zero;
    memset(&zero, 0, sizeof zero);
    subdiv_result result = subdiv_inspect(&info, cage, opt);
    if (result) CHECK(memcmp(&info, &zero, sizeof info) == 0);
    return result;
}

// Adds to a copy of the cage, twice; a failure has to leave it as it was, with what it owns.
static subdiv_result call_creases(const subdiv_mesh *cage, const subdiv_options *opt)
{
    static char smooth[] = "s 1";
    static int face_uvs[sizeof obj_text / 2];
    char *statements[1] = {smooth};
    int statement_faces[1] = {9};
    float uv[2] = {0, 0};
    subdiv_mesh mesh = *cage, before;
    mesh.memory = NULL;
    mesh.crease_count = 0;
    mesh.uv_count = mesh.statement_count = 1;
    mesh.uvs = uv;
    mesh.face_uvs = face_uvs;
    mesh.statements = statements;
    mesh.statement_faces = statement_faces;
    face_uvs[100] = -1;

    subdiv_result result = subdiv_crease_by_angle(&mesh, 1, 2, opt);
    before = mesh;
    if (!result) CHECK(mesh.crease_count > 500);
    if (!result) result = subdiv_crease_by_smoothing_groups(&mesh, 3, opt);
    if (!result) CHECK(mesh.memory != before.memory);
    if (!result) before = mesh;
    if (!result) result = subdiv_crease_by_uv_seams(&mesh, 4, opt);
    if (!result) CHECK(mesh.memory != before.memory);
    if (result) CHECK(memcmp(&mesh, &before, sizeof mesh) == 0);
    subdiv_mesh_free(&mesh);
    return result;
}

// Everywhere, also at a vertex of high valence, whose nest is too large for the stack.
static subdiv_result call_exact(const subdiv_mesh *mesh, const subdiv_options *opt)
{
    static float positions[3 * 42], values[3 * 42];
    static int faces[20 * 4], face_uvs[20 * 4];
    float p[3], normal[3];
    subdiv_mesh cage = *mesh;
    subdiv_surface *surface = NULL;
    subdiv_location at[2] = { { 0, 0, 0, 0 }, { 3, 0, 1e-5f, 1e-6f } };
    subdiv_derivatives out = { p, NULL, NULL, NULL, NULL, NULL, normal, 3 };
    memset(&cage, 0, sizeof cage);
    for (int i = 0; i < 40; i++) {
        positions[3 * (i + 1)] = (float)cos(i * 0.1570796);
        positions[3 * (i + 1) + 1] = (float)sin(i * 0.1570796);
    }
    for (int f = 0; f < 20; f++) {
        int quad[4] = { 0, 1 + 2 * f, 2 + 2 * f, 1 + (2 * f + 2) % 40 };
        memcpy(faces + 4 * f, quad, sizeof quad);
        memcpy(face_uvs + 4 * f, quad, sizeof quad);
    }
    face_uvs[5] = 41;
    cage.vertex_count = 41;
    cage.positions = positions;
    cage.face_count = 20;
    cage.face_size = 4;
    cage.face_vertices = faces;
    subdiv_result result = subdiv_prepare(&surface, &cage, SUBDIV_EXACT, opt);
    if (result) CHECK(surface == NULL);
    if (!result) {
        void *scratch = malloc(subdiv_scratch_size(surface, 3));
        result = subdiv_evaluate_begin(surface, 3, positions, 0, scratch, opt);
        if (!result) result = subdiv_evaluate_at(surface, 3, scratch, 1, at, &out, opt);
        if (!result) result = subdiv_evaluate_at(surface, 3, scratch, 1, at + 1, &out, opt);
        free(scratch);
    }
    subdiv_surface_free(surface);
    surface = NULL;
    if (!result)
        result = subdiv_prepare_face_varying(&surface, &cage, 42, face_uvs, SUBDIV_UV_CORNERS_ONLY,
                                             SUBDIV_EXACT, opt);
    if (!result) {
        void *scratch = malloc(subdiv_scratch_size(surface, 3));
        result = subdiv_evaluate_begin(surface, 3, values, 0, scratch, opt);
        free(scratch);
    }
    subdiv_surface_free(surface);
    return result;
}

static subdiv_result call_check(const subdiv_mesh *cage, const subdiv_options *opt)
{
    int counts[SUBDIV_ODDITY_COUNT];
    subdiv_result result = subdiv_check(counts, cage, NULL, NULL, opt);
    for (int i = 0; i < SUBDIV_ODDITY_COUNT && result; i++) CHECK_EQUAL(counts[i], 0);
    return result;
}

static subdiv_result call_save_memory(const subdiv_mesh *cage, const subdiv_options *opt)
{
    size_t size = 0;
    return subdiv_save_obj_memory(cage, NULL, 0, &size, opt);
}

static subdiv_result call_save_callback(const subdiv_mesh *cage, const subdiv_options *opt)
{
    return subdiv_save_obj_callback(cage, write_away, NULL, opt);
}

static const char *const path = "build/test_memory.scratch.obj";

static subdiv_result call_files(const subdiv_mesh *cage, const subdiv_options *opt)
{
    subdiv_mesh mesh;
    subdiv_result result = subdiv_save_obj(cage, path, opt);
    if (result) return result;
    memset(&mesh, 0x55, sizeof mesh);
    result = subdiv_load_obj(&mesh, path, opt);
    if (result == SUBDIV_OK) CHECK(same_mesh(cage, &mesh));
    return keep_nothing(&mesh, result);
}

// ------------------------------------------------------------------------------------ the tests

// Runs a call once to count its allocations, then once for each of them that fails.
static int check_call(call run)
{
    subdiv_mesh cage;
    subdiv_error error = {0};
    subdiv_options opt = {0};
    memset(&main_heap, 0, sizeof main_heap);
    foreign_calls = 0;
    opt.user = &main_heap;
    opt.error = &error;
    CHECK_EQUAL(subdiv_load_obj_memory(&cage, obj_text, obj_size, &opt), SUBDIV_OK);
    CHECK_EQUAL(error.warning_count, 2);
    int live = main_heap.live;
    CHECK_EQUAL(live, 1);             // a mesh is one block

    main_heap.calls = 0;
    CHECK_EQUAL(run(&cage, &opt), SUBDIV_OK);
    CHECK_EQUAL(main_heap.live, live);
    int count = main_heap.calls;
    for (int k = 1; k <= count; k++) {
        main_heap.calls = main_heap.failures = 0;
        main_heap.fail_at = k;
        CHECK_EQUAL(run(&cage, &opt), SUBDIV_ERROR_MEMORY);
        CHECK_EQUAL(error.code, SUBDIV_ERROR_MEMORY);
        CHECK(strstr(error.message, "memory") != NULL);
        CHECK_EQUAL(main_heap.failures, 1);
        CHECK_EQUAL(main_heap.live, live);
    }
    main_heap.fail_at = 0;
    subdiv_mesh_free(&cage);
    CHECK_EQUAL(main_heap.live, 0);
    CHECK_EQUAL(main_heap.wrong, 0);
    CHECK_EQUAL(foreign_calls, 0);
    return count;
}

static void test_load(void)
{
    CHECK(check_call(call_load_memory) > 0);
    CHECK(check_call(call_load_callback) > 0);
}

static void test_refine(void)
{
    CHECK(check_call(call_copy) > 0);
    CHECK(check_call(call_refine) > 0);
    CHECK(check_call(call_frames) > 0);
    CHECK(check_call(call_bilinear) > 0);
    CHECK(check_call(call_loop) > 0);
    CHECK(check_call(call_chaikin) > 0);
}

static void test_limit(void)
{
    CHECK(check_call(call_limit) > 0);
    CHECK(check_call(call_limit_loop) > 0);
    CHECK(check_call(call_limit_zero) > 0);
    CHECK_EQUAL(check_call(call_normals), 2);
}

static void test_tessellate(void)
{
    CHECK(check_call(call_tessellate) > 0);
    CHECK(check_call(call_tessellate_loop) > 0);
    CHECK(check_call(call_tessellate_fan) > 0);
}

static void test_prepare(void)
{
    CHECK(check_call(call_prepare) > 1);
}

static void test_exact(void)
{
    CHECK(check_call(call_exact) > 2);
}

static void test_stencils(void)
{
    CHECK(check_call(call_stencils) > 1);
    CHECK(check_call(call_limit_stencils) > 1);
    CHECK(check_call(call_stencils_at) > 1);
    CHECK(check_call(call_explain) > 1);
}

static void test_inspect(void)
{
    CHECK(check_call(call_inspect) > 0);
}

static void test_creases(void)
{
    CHECK(check_call(call_creases) > 3);
}

static void test_check(void)
{
    CHECK(check_call(call_check) > 0);
}

static void test_save(void)
{
    check_call(call_save_memory);
    check_call(call_save_callback);
    CHECK(check_call(call_files) > 0);
    remove(path);
}

// Errors found half-way have to clean up as well.
static void test_errors_do_not_leak(void)
{
    static const char *const endings[] = {"f 1 2 99999\n", "f 1 x\n", "v 1 2\n", "v 1 nan 2\n"};
    subdiv_options opt = {0};
    opt.user = &main_heap;
    memset(&main_heap, 0, sizeof main_heap);
    for (int i = 0; i < 4; i++) {
        subdiv_mesh mesh;
        size_t before = obj_size, n = strlen(endings[i]);
        memcpy(obj_text + obj_size, endings[i], n);
        obj_size += n;
        CHECK(subdiv_load_obj_memory(&mesh, obj_text, obj_size, &opt) != SUBDIV_OK);
        obj_size = before;
        CHECK(main_heap.calls > 0);
        CHECK_EQUAL(main_heap.live, 0);
    }
    CHECK_EQUAL(main_heap.wrong, 0);
}

int main(void)
{
    make_obj_text();
    RUN(test_load);
    RUN(test_refine);
    RUN(test_limit);
    RUN(test_tessellate);
    RUN(test_prepare);
    RUN(test_exact);
    RUN(test_stencils);
    RUN(test_inspect);
    RUN(test_creases);
    RUN(test_check);
    RUN(test_save);
    RUN(test_errors_do_not_leak);
    return test_end("test_memory");
}
