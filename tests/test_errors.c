// Every way to call the library wrongly: the code, the face or vertex that is named, the message,
// and an output that is left zeroed.
//
//     cc -I. tests/test_errors.c -o build/test_errors -lm && build/test_errors

#include <limits.h>
#include <stdlib.h>
#include <time.h>

#include <float.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/test.h"
#include "lib/same.h"

// ---------------------------------------------------------------- a good mesh, broken one by one

// A triangle, a quad and a pentagon around vertex 0, with creases, corners, a hole, UVs, colours,
// normals and statements. All arrays are made anew for each case, so that a case may write to them.
static float P[3 * 9], S[2], CS[2], UV[2 * 3], colors[3 * 9], N[3 * 9];
static int   sizes[3], F[12], E[4], C[2], H[1], face_uvs[12], statement_faces[3];
static int   line_sizes[2], L[5];
static char *statements[3];

static subdiv_mesh good_mesh(void)
{
    static const float good_P[] = {0,0,0, 1,0,0, 0,1,0, -1,1,0, -1,0,0, -1,-1,0, 0,-1,0, 1,-1,0,
                                   5,5,5};
    static const int good_F[] = {0,1,2, 0,2,3,4, 0,4,5,6,7}, good_E[] = {0,2, 4,0};
    memcpy(P, good_P, sizeof P);
    memcpy(F, good_F, sizeof F);
    memcpy(E, good_E, sizeof E);
    sizes[0] = 3; sizes[1] = 4; sizes[2] = 5;
    S[0] = 1; S[1] = 2.5f;
    C[0] = 3; C[1] = 8; CS[0] = 1; CS[1] = 10;
    H[0] = 1;
    static const int good_face_uvs[] = {0,1,2, -1,-1,-1,-1, 2,1,0,0,1}, good_faces[] = {0, 2, 3};
    static char group[] = "g", material[] = "usemtl a b", smoothing[] = "s 1";
    memcpy(face_uvs, good_face_uvs, sizeof face_uvs);
    memcpy(statement_faces, good_faces, sizeof statement_faces);
    static const int good_L[] = {8,3, 1,2,1};
    memcpy(L, good_L, sizeof L);
    line_sizes[0] = 2; line_sizes[1] = 3;
    statements[0] = group; statements[1] = material; statements[2] = smoothing;
    for (int i = 0; i < 6; i++) UV[i] = (float)i;
    for (int i = 0; i < 27; i++) colors[i] = N[i] = 0.5f;
    subdiv_mesh m = {0};
    m.vertex_count = 9;     m.positions = P;
    m.face_count = 3;       m.face_sizes = sizes;           m.face_vertices = F;
    m.crease_count = 2;     m.crease_vertices = E;          m.crease_sharpness = S;
    m.corner_count = 2;     m.corner_vertices = C;          m.corner_sharpness = CS;
    m.hole_count = 1;       m.holes = H;
    m.uv_count = 3;         m.uvs = UV;                     m.face_uvs = face_uvs;
    m.colors = colors;      m.normals = N;
    m.statement_count = 3;  m.statement_faces = statement_faces;
    m.statements = statements;
    m.line_count = 2;       m.line_sizes = line_sizes;      m.line_vertices = L;
    return m;
}

static void no_vertices(subdiv_mesh *m)     { m->vertex_count = 0; }
static void fewer_vertices(subdiv_mesh *m)  { m->vertex_count = -1; }
static void fewer_faces(subdiv_mesh *m)     { m->face_count = -1; }
static void fewer_creases(subdiv_mesh *m)   { m->crease_count = -1; }
static void fewer_corners(subdiv_mesh *m)   { m->corner_count = INT_MIN; }
static void fewer_holes(subdiv_mesh *m)     { m->hole_count = -2; }
static void negative_size(subdiv_mesh *m)   { m->face_size = -4; }
static void no_faces(subdiv_mesh *m)        { m->face_count = 0;  m->face_size = -4; }
static void no_pairs(subdiv_mesh *m)        { m->face_count = 0;  m->face_size = 2; }
static void null_sizes(subdiv_mesh *m)      { m->face_sizes = NULL; }
static void null_faces(subdiv_mesh *m)      { m->face_vertices = NULL; }
static void null_creases(subdiv_mesh *m)    { m->crease_vertices = NULL; }
static void null_sharpness(subdiv_mesh *m)  { m->crease_sharpness = NULL; }
static void null_corners(subdiv_mesh *m)    { m->corner_vertices = NULL; }
static void null_corner_s(subdiv_mesh *m)   { m->corner_sharpness = NULL; }
static void null_holes(subdiv_mesh *m)      { m->holes = NULL; }
static void face_index(subdiv_mesh *m)      { m->face_vertices[5] = 912; }
static void face_index_1(subdiv_mesh *m)    { m->face_vertices[11] = 9; }
static void face_negative(subdiv_mesh *m)   { m->face_vertices[0] = -1; }
static void face_minimum(subdiv_mesh *m)    { m->face_vertices[11] = INT_MIN; }
static void crease_index(subdiv_mesh *m)    { m->crease_vertices[3] = 77; }
static void crease_negative(subdiv_mesh *m) { m->crease_vertices[0] = -3; }
static void corner_index(subdiv_mesh *m)    { m->corner_vertices[1] = 9; }
static void corner_negative(subdiv_mesh *m) { m->corner_vertices[0] = -1; }
static void hole_index(subdiv_mesh *m)      { m->holes[0] = 3; }
static void hole_negative(subdiv_mesh *m)   { m->holes[0] = -1; }
static void size_0(subdiv_mesh *m)          { m->face_sizes[0] = 0; }
static void size_1(subdiv_mesh *m)          { m->face_sizes[1] = 1; }
static void size_2(subdiv_mesh *m)          { m->face_sizes[2] = 2; }
static void size_below_0(subdiv_mesh *m)    { m->face_sizes[2] = -5; }
static void all_sizes_2(subdiv_mesh *m)     { m->face_size = 2; }
static void all_sizes_1(subdiv_mesh *m)     { m->face_size = 1; }
static void sharpness_nan(subdiv_mesh *m)   { m->crease_sharpness[1] = (float)NAN; }
static void corner_nan(subdiv_mesh *m)      { m->corner_sharpness[1] = (float)NAN; }
static void scheme_3(subdiv_mesh *m)        { m->scheme = (subdiv_scheme)3; }
static void scheme_huge(subdiv_mesh *m)     { m->scheme = (subdiv_scheme)0x7fffffff; }
static void boundary_3(subdiv_mesh *m)      { m->boundary = (subdiv_boundary)3; }
static void creasing_2(subdiv_mesh *m)      { m->creasing = (subdiv_creasing)2; }
static void triangles_2(subdiv_mesh *m)     { m->triangles = (subdiv_triangles)2; }
static void uv_rule_6(subdiv_mesh *m)       { m->uv_rule = (subdiv_uv_rule)6; }
static void fewer_uvs(subdiv_mesh *m)       { m->uv_count = -1; }
static void null_uvs(subdiv_mesh *m)        { m->uvs = NULL; }
static void null_face_uvs(subdiv_mesh *m)   { m->face_uvs = NULL; }
static void uv_index(subdiv_mesh *m)        { m->face_uvs[7] = 3; }
static void uv_index_1(subdiv_mesh *m)      { m->face_uvs[11] = INT_MAX; }
static void uv_below(subdiv_mesh *m)        { m->face_uvs[4] = -2; }
static void fewer_lines(subdiv_mesh *m)     { m->statement_count = -3; }
static void null_lines(subdiv_mesh *m)      { m->statements = NULL; }
static void null_places(subdiv_mesh *m)     { m->statement_faces = NULL; }
static void null_line(subdiv_mesh *m)       { m->statements[1] = NULL; }
static void uv_nan(subdiv_mesh *m)          { m->uvs[3] = (float)NAN; }
static void color_inf(subdiv_mesh *m)       { m->colors[3 * 7 + 2] = HUGE_VALF; }
static void normal_minus(subdiv_mesh *m)    { m->normals[3 * 8] = -HUGE_VALF; }
static void line_falls(subdiv_mesh *m)      { m->statement_faces[2] = 1; }
static void line_below(subdiv_mesh *m)      { m->statement_faces[0] = -1; }
static void line_behind(subdiv_mesh *m)     { m->statement_faces[2] = 4; }
static char two_lines[] = "g a\nv 1 2 3", other_line[] = "v 1 2 3", near_line[] = "usemtls a";
static void line_is_two(subdiv_mesh *m)     { m->statements[1] = two_lines; }
static void line_is_other(subdiv_mesh *m)   { m->statements[0] = other_line; }
static void line_is_near(subdiv_mesh *m)    { m->statements[2] = near_line; }
static void polyline_count(subdiv_mesh *m)  { m->line_count = -4; }
static void null_polylines(subdiv_mesh *m)  { m->line_vertices = NULL; }
static void null_line_sizes(subdiv_mesh *m) { m->line_sizes = NULL; }
static void polyline_of_1(subdiv_mesh *m)   { m->line_sizes[1] = 1; }
static void polyline_index(subdiv_mesh *m)  { m->line_vertices[4] = 9; }
static void polyline_below(subdiv_mesh *m)  { m->line_vertices[0] = -1; }

typedef struct broken {
    const char   *name;
    void        (*make)(subdiv_mesh *m);
    subdiv_result code;
    int           face, vertex;
    const char   *token;              // which the message holds
} broken;

#define BROKEN(make, code, face, vertex, token) \
    {#make, make, SUBDIV_ERROR_##code, face, vertex, token}

static const broken broken_meshes[] = {
    BROKEN(no_vertices,     EMPTY,     -1, -1, "no vertices"),
    BROKEN(fewer_vertices,  ARGUMENT,  -1, -1, "-1"),
    BROKEN(fewer_faces,     ARGUMENT,  -1, -1, "-1"),
    BROKEN(fewer_creases,   ARGUMENT,  -1, -1, "-1"),
    BROKEN(fewer_corners,   ARGUMENT,  -1, -1, "-2147483648"),
    BROKEN(fewer_holes,     ARGUMENT,  -1, -1, "-2"),
    BROKEN(no_faces,        ARGUMENT,  -1, -1, "face_size is -4"),
    BROKEN(no_pairs,        ARGUMENT,  -1, -1, "face_size is 2"),
    BROKEN(null_sizes,      ARGUMENT,  -1, -1, "face_size"),
    BROKEN(null_faces,      ARGUMENT,  -1, -1, "face_vertices"),
    BROKEN(null_creases,    ARGUMENT,  -1, -1, "crease_vertices"),
    BROKEN(null_sharpness,  ARGUMENT,  -1, -1, "crease_sharpness"),
    BROKEN(null_corners,    ARGUMENT,  -1, -1, "corner_vertices"),
    BROKEN(null_corner_s,   ARGUMENT,  -1, -1, "corner_sharpness"),
    BROKEN(null_holes,      ARGUMENT,  -1, -1, "holes"),
    BROKEN(face_index,      INDEX,      1, 912, "face 1: vertex 912 "),
    BROKEN(face_index_1,    INDEX,      2, 9, "face 2: vertex 9 "),
    BROKEN(face_negative,   INDEX,      0, -1, "face 0: vertex -1 "),
    BROKEN(face_minimum,    INDEX,      2, INT_MIN, "face 2: vertex -2147483648 "),
    BROKEN(crease_index,    INDEX,     -1, 77, "crease 1: vertex 77 "),
    BROKEN(crease_negative, INDEX,     -1, -3, "crease 0: vertex -3 "),
    BROKEN(corner_index,    INDEX,     -1, 9, "corner 1: vertex 9 "),
    BROKEN(corner_negative, INDEX,     -1, -1, "corner 0: vertex -1 "),
    BROKEN(hole_index,      INDEX,      3, -1, "hole 0: face 3 "),
    BROKEN(hole_negative,   INDEX,     -1, -1, "hole 0: face -1 "),
    BROKEN(size_0,          FACE,       0, -1, "face 0 has 0 "),
    BROKEN(size_1,          FACE,       1, -1, "face 1 has 1 "),
    BROKEN(size_2,          FACE,       2, -1, "face 2 has 2 "),
    BROKEN(size_below_0,    FACE,       2, -1, "2"),
    BROKEN(all_sizes_2,     FACE,       0, -1, "2"),
    BROKEN(all_sizes_1,     FACE,       0, -1, "1"),
    BROKEN(negative_size,   FACE,       0, -1, "-4"),
    BROKEN(sharpness_nan,   NOT_FINITE, -1, 4, "crease 1: the sharpness"),
    BROKEN(corner_nan,      NOT_FINITE, -1, 8, "corner 1: the sharpness"),
    BROKEN(scheme_3,        ARGUMENT,  -1, -1, "scheme"),
    BROKEN(scheme_huge,     ARGUMENT,  -1, -1, "scheme"),
    BROKEN(boundary_3,      ARGUMENT,  -1, -1, "boundary"),
    BROKEN(creasing_2,      ARGUMENT,  -1, -1, "creasing"),
    BROKEN(triangles_2,     ARGUMENT,  -1, -1, "triangles"),
    BROKEN(uv_rule_6,       ARGUMENT,  -1, -1, "uv_rule"),
    BROKEN(fewer_uvs,       ARGUMENT,  -1, -1, "uvs"),
    BROKEN(null_uvs,        ARGUMENT,  -1, -1, "uvs"),
    BROKEN(null_face_uvs,   ARGUMENT,  -1, -1, "face_uvs"),
    BROKEN(uv_index,        INDEX,      2, -1, "face 2: UV 3 "),
    BROKEN(uv_index_1,      INDEX,      2, -1, "face 2: UV 2147483647 "),
    BROKEN(uv_below,        INDEX,      1, -1, "face 1: UV -2 "),
    BROKEN(fewer_lines,     ARGUMENT,  -1, -1, "-3"),
    BROKEN(null_lines,      ARGUMENT,  -1, -1, "statements"),
    BROKEN(null_places,     ARGUMENT,  -1, -1, "statement_faces"),
    BROKEN(null_line,       ARGUMENT,  -1, -1, "statement 1"),
    BROKEN(line_falls,      INDEX,      1, -1, "statement 2"),
    BROKEN(line_below,      INDEX,     -1, -1, "statement 0"),
    BROKEN(line_behind,     INDEX,      4, -1, "statement 2"),
    BROKEN(line_is_two,     ARGUMENT,  -1, -1, "statement 1"),
    BROKEN(line_is_other,   ARGUMENT,  -1, -1, "statement 0"),
    BROKEN(line_is_near,    ARGUMENT,  -1, -1, "statement 2"),
    BROKEN(uv_nan,          NOT_FINITE, -1, -1, "UV 1"),
    BROKEN(color_inf,       NOT_FINITE, -1, 7, "color 7"),
    BROKEN(normal_minus,    NOT_FINITE, -1, 8, "normal 8"),
    BROKEN(polyline_count,  ARGUMENT,  -1, -1, "line_sizes"),
    BROKEN(null_polylines,  ARGUMENT,  -1, -1, "line_vertices"),
    BROKEN(null_line_sizes, ARGUMENT,  -1, -1, "line_sizes"),
    BROKEN(polyline_of_1,   ARGUMENT,  -1, -1, "polyline 1 has 1 vertices"),
    BROKEN(polyline_index,  INDEX,     -1, 9, "polyline 1: vertex 9"),
    BROKEN(polyline_below,  INDEX,     -1, -1, "polyline 0: vertex -1"),
};

static void check_error(const subdiv_error *error, const broken *b)
{
    CHECK_EQUAL(error->code, b->code);
    CHECK_EQUAL(error->line, 0);
    CHECK_EQUAL(error->face, b->face);
    CHECK_EQUAL(error->vertex, b->vertex);
    CHECK_EQUAL(error->warning_count, 0);
    if (strstr(error->message, b->token) == NULL)
        TEST_REPORT("\"%s\" does not name %s", error->message, b->token);
}

// An error as a careless caller leaves it: everything in it has to be written anew.
static subdiv_error stale_error(void)
{
    subdiv_error error = {0};
    error.code = SUBDIV_ERROR_IO;
    error.line = error.face = error.vertex = 4242;
    strcpy(error.message, "stale");
    return error;
}

static size_t write_nothing(void *user, const void *bytes, size_t size)
{
    (void)bytes;
    ++*(int *)user;
    return size;
}

// The positions are no business of prepare; they belong to subdiv_surface_mesh.
static void check_broken(const broken *b, int topology)
{
    subdiv_mesh fine, cage = good_mesh();
    subdiv_surface *surface = (subdiv_surface *)&cage;
    subdiv_info info, zero_info;
    subdiv_options opt = {0};
    b->make(&cage);

    subdiv_error error = stale_error();
    opt.error = &error;
    memset(&fine, 0x55, sizeof fine);
    CHECK_EQUAL(subdiv_refine(&fine, &cage, 1, &opt), b->code);
    CHECK(mesh_is_zero(&fine));
    check_error(&error, b);
    CHECK_EQUAL(subdiv_refine(&fine, &cage, 0, NULL), b->code);

    if (topology) {
        error = stale_error();
        CHECK_EQUAL(subdiv_prepare(&surface, &cage, 1, &opt), b->code);
        CHECK(surface == NULL);
        check_error(&error, b);
    }

    error = stale_error();
    memset(&info, 0x55, sizeof info);
    memset(&zero_info, 0, sizeof zero_info);
    CHECK_EQUAL(subdiv_inspect(&info, &cage, &opt), b->code);
    CHECK(memcmp(&info, &zero_info, sizeof info) == 0);
    check_error(&error, b);

    error = stale_error();
    CHECK_EQUAL(subdiv_check(NULL, &cage, NULL, NULL, &opt), b->code);
    check_error(&error, b);

    subdiv_mesh before = cage;
    error = stale_error();
    CHECK_EQUAL(subdiv_crease_by_angle(&cage, 30, 1, &opt), b->code);
    CHECK(memcmp(&cage, &before, sizeof cage) == 0);
    check_error(&error, b);
}

static void test_broken_meshes(void)
{
    for (size_t i = 0; i < sizeof broken_meshes / sizeof *broken_meshes; i++) {
        test_context = broken_meshes[i].name;
        check_broken(&broken_meshes[i], 1);
    }
    test_context = "";
}

static void null_positions(subdiv_mesh *m)  { m->positions = NULL; }
static void position_nan(subdiv_mesh *m)    { m->positions[3 * 4 + 1] = (float)NAN; }
static void position_inf(subdiv_mesh *m)    { m->positions[3 * 8 + 2] = HUGE_VALF; }
static void position_minus(subdiv_mesh *m)  { m->positions[0] = -HUGE_VALF; }

static const broken broken_positions[] = {
    BROKEN(null_positions, ARGUMENT,   -1, -1, "positions"),
    BROKEN(position_nan,   NOT_FINITE, -1, 4, "4"),
    BROKEN(position_inf,   NOT_FINITE, -1, 8, "8"),
    BROKEN(position_minus, NOT_FINITE, -1, 0, "0"),
};

static void test_broken_positions(void)
{
    for (size_t i = 0; i < sizeof broken_positions / sizeof *broken_positions; i++) {
        const broken *b = &broken_positions[i];
        subdiv_mesh fine, cage = good_mesh();
        subdiv_surface *surface = NULL;
        subdiv_error error = stale_error();
        subdiv_options opt = {0};
        opt.error = &error;
        test_context = b->name;
        check_broken(b, 0);
        cage = good_mesh();
        b->make(&cage);
        CHECK_EQUAL(subdiv_prepare(&surface, &cage, 1, &opt), SUBDIV_OK);
        CHECK_EQUAL(error.code, SUBDIV_OK);
        if (surface == NULL) continue;
        memset(&fine, 0x55, sizeof fine);
        CHECK_EQUAL(subdiv_surface_mesh(&fine, surface, cage.positions, &opt), b->code);
        CHECK(mesh_is_zero(&fine));
        check_error(&error, b);
        subdiv_surface_free(surface);
    }
    test_context = "";
}

// The writer refuses what could not be read again, before it writes anything.
// However many there are, the first one that is wrong is named.
static void test_first_of_many(void)
{
    enum { VERTICES = 400, FACES = 300, LAST = 4 * FACES - 1 };
    static float positions[3 * VERTICES];
    static int faces[4 * FACES];
    subdiv_mesh fine, m = {0};
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    m.vertex_count = VERTICES;      m.positions = positions;
    m.face_count = FACES;           m.face_vertices = faces;        m.face_size = 4;
    for (int i = 0; i <= LAST; i++) faces[i] = i % VERTICES;
    for (int at = 0; at <= LAST; at += 1 + at % 20) {
        faces[LAST] = at % 2 ? VERTICES : -1;
        faces[at] = at % 3 ? -1 : VERTICES;
        CHECK_EQUAL(subdiv_refine(&fine, &m, 0, &opt), SUBDIV_ERROR_INDEX);
        CHECK_EQUAL(error.face, at / 4);
        faces[at] = at % VERTICES;
        faces[LAST] = LAST % VERTICES;
        positions[3 * VERTICES - 1] = positions[at] = HUGE_VALF;
        CHECK_EQUAL(subdiv_refine(&fine, &m, 0, &opt), SUBDIV_ERROR_NOT_FINITE);
        CHECK_EQUAL(error.vertex, at / 3);
        positions[3 * VERTICES - 1] = positions[at] = 0;
    }
}

static void test_broken_meshes_are_not_saved(void)
{
    const broken *lists[] = {broken_meshes, broken_positions};
    const size_t counts[] = {sizeof broken_meshes / sizeof *broken_meshes,
                             sizeof broken_positions / sizeof *broken_positions};
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < counts[k]; i++) {
            const broken *b = &lists[k][i];
            subdiv_mesh mesh = good_mesh();
            subdiv_error error = stale_error();
            subdiv_options opt = {0};
            size_t size = 99;
            int calls = 0;
            opt.error = &error;
            test_context = b->name;
            b->make(&mesh);
            CHECK_EQUAL(subdiv_save_obj_callback(&mesh, write_nothing, &calls, &opt), b->code);
            CHECK_EQUAL(calls, 0);
            check_error(&error, b);
            CHECK_EQUAL(subdiv_save_obj_memory(&mesh, NULL, 0, &size, &opt), b->code);
            CHECK_EQUAL(size, 0);
        }
    }
    test_context = "";
}

// -------------------------------------------------------------------------------------- schemes

static void test_loop_needs_triangles(void)
{
    subdiv_mesh fine, cage = good_mesh();
    subdiv_surface *surface = NULL;
    subdiv_info info;
    subdiv_error error = stale_error();
    subdiv_options opt = {0};
    opt.error = &error;
    cage.scheme = SUBDIV_LOOP;
    memset(&fine, 0x55, sizeof fine);
    CHECK_EQUAL(subdiv_refine(&fine, &cage, 1, &opt), SUBDIV_ERROR_NOT_TRIANGLE);
    CHECK(mesh_is_zero(&fine));
    CHECK_EQUAL(error.code, SUBDIV_ERROR_NOT_TRIANGLE);
    CHECK_EQUAL(error.face, 1);
    CHECK_EQUAL(error.vertex, -1);
    CHECK(strstr(error.message, "1") != NULL);
    error = stale_error();
    CHECK_EQUAL(subdiv_prepare(&surface, &cage, 1, &opt), SUBDIV_ERROR_NOT_TRIANGLE);
    CHECK(surface == NULL);
    CHECK_EQUAL(error.face, 1);
    cage.face_size = 4;
    CHECK_EQUAL(subdiv_refine(&fine, &cage, 1, &opt), SUBDIV_ERROR_NOT_TRIANGLE);
    CHECK_EQUAL(error.face, 0);

    CHECK_EQUAL(subdiv_inspect(&info, &cage, &opt), SUBDIV_OK);
    CHECK_EQUAL(error.code, SUBDIV_OK);
    CHECK_EQUAL(error.face, -1);
    CHECK_TEXT(error.message, "");
    cage.face_size = 3;
    CHECK_EQUAL(subdiv_refine(&fine, &cage, 1, &opt), SUBDIV_OK);
    subdiv_mesh_free(&fine);
    cage.face_size = 0;
    opt.triangulate = 1;
    CHECK_EQUAL(subdiv_refine(&fine, &cage, 1, &opt), SUBDIV_OK);
    CHECK_EQUAL(fine.face_size, 3);
    subdiv_mesh_free(&fine);
}

// --------------------------------------------------------------------------------------- levels

// The code, and that there is an answer at once and none in the output.
static subdiv_result refused_levels(const subdiv_mesh *cage, int levels)
{
    subdiv_mesh fine;
    subdiv_error error = stale_error();
    subdiv_options opt = {0};
    opt.error = &error;
    clock_t start = clock();
    memset(&fine, 0x55, sizeof fine);
    subdiv_result result = subdiv_refine(&fine, cage, levels, &opt);
    CHECK(result != SUBDIV_OK);
    CHECK(mesh_is_zero(&fine));
    CHECK_EQUAL(error.code, result);
    CHECK_EQUAL(error.face, -1);
    CHECK_EQUAL(error.vertex, -1);
    CHECK(error.message[0] && strcmp(error.message, "stale") != 0);
    CHECK((double)(clock() - start) < 0.2 * CLOCKS_PER_SEC);
    return result;
}

static void test_levels(void)
{
    static float cube_P[] = {-1,-1,-1, 1,-1,-1, 1,1,-1, -1,1,-1, -1,-1,1, 1,-1,1, 1,1,1, -1,1,1};
    static int cube_F[] = {0,3,2,1, 4,5,6,7, 0,1,5,4, 1,2,6,5, 2,3,7,6, 3,0,4,7};
    static int tetrahedron_F[] = {0,1,2, 0,2,3, 0,3,1, 1,3,2};
    const int too_many[] = {15, 16, 17, 20, 30, 31, 32, 33, 63, 64, 65, 1000, INT_MAX - 1, INT_MAX};
    subdiv_mesh cube = {0}, tetrahedron = {0};
    cube.vertex_count = 8;
    cube.positions = cube_P;
    cube.face_count = 6;
    cube.face_size = 4;
    cube.face_vertices = cube_F;
    tetrahedron = cube;
    tetrahedron.vertex_count = 4;
    tetrahedron.face_count = 4;
    tetrahedron.face_size = 3;
    tetrahedron.face_vertices = tetrahedron_F;
    tetrahedron.scheme = SUBDIV_LOOP;
    CHECK_EQUAL(refused_levels(&cube, -1), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(refused_levels(&cube, INT_MIN), SUBDIV_ERROR_ARGUMENT);
    for (size_t i = 0; i < sizeof too_many / sizeof *too_many; i++) {
        CHECK_EQUAL(refused_levels(&cube, too_many[i]), SUBDIV_ERROR_TOO_LARGE);
        CHECK_EQUAL(refused_levels(&tetrahedron, too_many[i]), SUBDIV_ERROR_TOO_LARGE);
    }
    cube.scheme = SUBDIV_BILINEAR;
    CHECK_EQUAL(refused_levels(&cube, INT_MAX), SUBDIV_ERROR_TOO_LARGE);
}

// Without faces there is nothing to grow, at any level.
static void test_levels_of_a_mesh_without_faces(void)
{
    subdiv_mesh fine, cage = good_mesh();
    cage.face_count = cage.statement_count = 0;
    cage.crease_count = 0;
    cage.hole_count = 0;
    for (int levels = 0; levels <= 30; levels += 3) {
        CHECK_EQUAL(subdiv_refine(&fine, &cage, levels, NULL), SUBDIV_OK);
        CHECK_EQUAL(fine.vertex_count, 9);
        CHECK_EQUAL(fine.face_count, 0);
        CHECK(same_bytes(fine.positions, P, 3 * fine.vertex_count, sizeof(float)));
        subdiv_mesh_free(&fine);
    }
}

// A mesh that no memory could hold is refused before its arrays are read.
static void test_sizes_that_overflow(void)
{
    subdiv_mesh cage = good_mesh();
    cage.crease_count = cage.corner_count = cage.hole_count = 0;
    cage.face_size = INT_MAX;
    cage.face_count = INT_MAX;
    CHECK_EQUAL(refused_levels(&cage, 0), SUBDIV_ERROR_TOO_LARGE);
    CHECK_EQUAL(refused_levels(&cage, 1), SUBDIV_ERROR_TOO_LARGE);
}

// ------------------------------------------------------------------------ freeing and the error

// Freeing leaves the caller's arrays alone, and freeing twice is harmless.
static void test_free(void)
{
    subdiv_mesh cage = good_mesh(), fine;
    CHECK_EQUAL(subdiv_refine(&fine, &cage, 1, NULL), SUBDIV_OK);
    CHECK(fine.memory != NULL);
    subdiv_mesh_free(&fine);
    CHECK(mesh_is_zero(&fine));
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&cage);
    CHECK(mesh_is_zero(&cage));
    CHECK_EQUAL(F[11], 7);
}

static void test_success_clears_the_error(void)
{
    subdiv_mesh cage = good_mesh(), fine;
    subdiv_error error = stale_error();
    subdiv_options opt = {0};
    opt.error = &error;
    CHECK_EQUAL(subdiv_refine(&fine, &cage, 1, &opt), SUBDIV_OK);
    CHECK_EQUAL(error.code, SUBDIV_OK);
    CHECK_EQUAL(error.line, 0);
    CHECK_EQUAL(error.face, -1);
    CHECK_EQUAL(error.vertex, -1);
    CHECK_TEXT(error.message, "");
    subdiv_mesh_free(&fine);
}

static void test_result_strings(void)
{
    for (int a = 0; a < SUBDIV_RESULT_COUNT; a++)
        for (int b = 0; b < a; b++)
            CHECK(strcmp(subdiv_result_string((subdiv_result)a),
                         subdiv_result_string((subdiv_result)b)) != 0);
    CHECK_TEXT(subdiv_result_string(SUBDIV_OK), "no error");
    CHECK_TEXT(subdiv_result_string(SUBDIV_ERROR_INDEX), "index out of range");
    CHECK(subdiv_result_string(SUBDIV_RESULT_COUNT) != NULL);
    CHECK(subdiv_result_string((subdiv_result)0x7fffffff) != NULL);
    CHECK(subdiv_result_string((subdiv_result)-1) != NULL);
}

static void test_crease_without_an_edge_is_a_warning(void)
{
    subdiv_mesh cage = good_mesh(), fine, plain;
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    cage.crease_count = 1;
    CHECK_EQUAL(subdiv_refine(&plain, &cage, 2, &opt), SUBDIV_OK);
    CHECK_EQUAL(error.warning_count, 0);
    cage.crease_count = 2;
    E[2] = 1; E[3] = 3;
    CHECK_EQUAL(subdiv_refine(&fine, &cage, 2, &opt), SUBDIV_OK);
    CHECK_EQUAL(error.warning_count, 1);
    CHECK(strstr(error.warning, "1") != NULL && strstr(error.warning, "3") != NULL);
    CHECK(same_mesh(&fine, &plain));
    subdiv_mesh_free(&fine);
    E[2] = E[3] = 4;
    CHECK_EQUAL(subdiv_refine(&fine, &cage, 2, &opt), SUBDIV_OK);
    CHECK_EQUAL(error.warning_count, 2);
    CHECK(strstr(error.warning, "1") != NULL && strstr(error.warning, "3") != NULL);
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&plain);
}

// Huge coordinates give finite results, also where neighbours have both signs: a sheet of n x n
// quads (Loop: triangles) like a chessboard; those of a smaller sheet, times a power of two.
static void check_huge(subdiv_scheme scheme, float size)
{
    enum { n = 6 };
    float points[3 * (n + 1) * (n + 1)];
    int faces[6 * n * n], *f = faces;
    for (int i = 0; i < 3 * (n + 1) * (n + 1); i++) {
        int place = i / 3, sign = (place / (n + 1) + place % (n + 1)) & 1;
        points[i] = sign ? size : -size;
    }
    for (int i = 0; i < n * n; i++) {
        int v[4] = { i / n * (n + 1) + i % n, 0, 0, 0 };
        v[1] = v[0] + 1;
        v[2] = v[1] + n + 1;
        v[3] = v[0] + n + 1;
        for (int j = 0; j < (scheme == SUBDIV_LOOP ? 3 : 4); j++) *f++ = v[j];
        for (int j = 2; j < 5 && scheme == SUBDIV_LOOP; j++) *f++ = v[j & 3];
    }
    subdiv_mesh cage = {0}, fine, small;
    cage.vertex_count = (n + 1) * (n + 1);
    cage.positions = points;
    cage.face_size = scheme == SUBDIV_LOOP ? 3 : 4;
    cage.face_count = (int)(f - faces) / cage.face_size;
    cage.face_vertices = faces;
    cage.scheme = scheme;
    for (int levels = 0; levels <= 5; levels++) {
        subdiv_options opt = {0};
        opt.limit = levels < 2;
        CHECK_EQUAL(subdiv_refine(&fine, &cage, levels, &opt), SUBDIV_OK);
        for (int i = 0; i < 3 * cage.vertex_count; i++) points[i] /= 65536;
        CHECK_EQUAL(subdiv_refine(&small, &cage, levels, &opt), SUBDIV_OK);
        for (int i = 0; i < 3 * cage.vertex_count; i++) points[i] *= 65536;
        for (int i = 0; i < 3 * fine.vertex_count; i++)
            CHECK(fine.positions[i] == small.positions[i] * 65536);
        subdiv_mesh_free(&fine);
        subdiv_mesh_free(&small);
    }
}

static void test_huge_coordinates(void)
{
    for (float size = FLT_MAX; size > 1e34f; size /= 2) {
        check_huge(SUBDIV_CATMULL_CLARK, size);
        check_huge(SUBDIV_LOOP, size);
        check_huge(SUBDIV_BILINEAR, size);
    }
}

int main(void)
{
    RUN(test_broken_meshes);
    RUN(test_broken_positions);
    RUN(test_first_of_many);
    RUN(test_broken_meshes_are_not_saved);
    RUN(test_loop_needs_triangles);
    RUN(test_levels);
    RUN(test_levels_of_a_mesh_without_faces);
    RUN(test_free);
    RUN(test_success_clears_the_error);
    RUN(test_result_strings);
    RUN(test_crease_without_an_edge_is_a_warning);
    RUN(test_sizes_that_overflow);
    RUN(test_huge_coordinates);
    return test_end("test_errors");
}
