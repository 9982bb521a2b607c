// What the OBJ writer writes: that it reads back to the same mesh, its text, files and callbacks.
//
//     cc -I. tests/test_obj_write.c -o build/test_obj_write -lm && build/test_obj_write

#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/obj.h"
#include "lib/same.h"
#include "lib/test.h"

static const char *scratch = "build/test_obj_write.obj";

// -------------------------------------------------------------------------------- round trips

static float  wavy_P[3 * 9];
static int    wavy_sizes[] = {4, 3, 3, 5, 3};
static int    wavy_F[] = {0,1,4,3, 1,2,4, 2,5,4, 3,4,7,8,6, 4,5,7};
static int    wavy_E[] = {0,1, 4,1, 3,4, 4,7};
static float  wavy_S[] = {0.1f, 2.7f, 9.75f, 10.0f};
static int    wavy_C[] = {0, 8, 4};
static float  wavy_CS[] = {1.3f, 10.0f, 0.7f};
static int    wavy_H[] = {1, 4};

static int    wavy_line_sizes[] = {2, 4}, wavy_L[] = {8,0, 3,5,4,3};
static float  wavy_UV[2 * 7], wavy_colors[3 * 9];
static int    wavy_face_uvs[] = {0,1,2,3, 1,2,3, 2,4,3, 5,6,0,1,2, 6,6,6};
static int    wavy_statement_faces[] = {0, 0, 2, 5};
static char   wavy_mtllib[] = "mtllib a b.mtl", wavy_group[] = "g";
static char   wavy_material[] = "usemtl \xc3\xa4", wavy_smoothing[] = "s 1";
static char  *wavy_statements[] = {wavy_mtllib, wavy_group, wavy_material, wavy_smoothing};

static subdiv_mesh wavy_mesh(void)
{
    subdiv_mesh m = {0};
    for (int i = 0; i < 3 * 9; i++) wavy_P[i] = random_float();
    for (int i = 0; i < 2 * 7; i++) wavy_UV[i] = random_float();
    for (int i = 0; i < 3 * 9; i++) wavy_colors[i] = random_float();
    m.vertex_count = 9;     m.positions = wavy_P;
    m.face_count = 5;       m.face_sizes = wavy_sizes;      m.face_vertices = wavy_F;
    m.crease_count = 4;     m.crease_vertices = wavy_E;     m.crease_sharpness = wavy_S;
    m.corner_count = 3;     m.corner_vertices = wavy_C;     m.corner_sharpness = wavy_CS;
    m.hole_count = 2;       m.holes = wavy_H;
    m.uv_count = 7;         m.uvs = wavy_UV;                m.face_uvs = wavy_face_uvs;
    m.colors = wavy_colors;
    m.statement_count = 4;  m.statement_faces = wavy_statement_faces;
    m.statements = wavy_statements;
    m.line_count = 2;       m.line_sizes = wavy_line_sizes; m.line_vertices = wavy_L;
    return m;
}

static void check_round_trip(const subdiv_mesh *mesh)
{
    subdiv_mesh back;
    subdiv_error error;
    size_t size, again_size;
    char *text = save_text(mesh, &size, NULL);
    CHECK_EQUAL(load_bytes(&back, text, size, &error), SUBDIV_OK);
    CHECK_EQUAL(error.warning_count, 0);
    CHECK(same_mesh(mesh, &back));
    back.normals = mesh->normals;     // not read from files
    char *again = save_text(&back, &again_size, NULL);
    CHECK_EQUAL(again_size, size);
    CHECK(again_size == size && memcmp(text, again, size) == 0);
    subdiv_mesh_free(&back);
    free(again);
    free(text);
}

static void test_round_trip_of_every_rule(void)
{
    for (int rules = 0; rules < 3 * 2 * 2 * 6; rules++) {
        for (int tags = 0; tags < 2; tags++) {
            subdiv_mesh mesh = wavy_mesh();
            mesh.boundary = (subdiv_boundary)(rules % 3);
            mesh.creasing = (subdiv_creasing)(rules / 3 % 2);
            mesh.triangles = (subdiv_triangles)(rules / 6 % 2);
            mesh.uv_rule = (subdiv_uv_rule)(rules / 12);
            if (!tags) mesh.crease_count = mesh.corner_count = mesh.hole_count = 0;
            check_round_trip(&mesh);
        }
    }
}

static void test_round_trip_of_one_face_size(void)
{
    subdiv_mesh mesh = wavy_mesh();
    mesh.face_sizes = NULL;
    mesh.face_size = 3;
    mesh.face_count = 6;
    check_round_trip(&mesh);
    mesh.normals = mesh.positions;
    check_round_trip(&mesh);
    mesh.face_size = 18;
    mesh.face_count = 1;
    mesh.hole_count = 0;
    mesh.statement_count = 2;
    check_round_trip(&mesh);
    mesh.face_count = 0;
    mesh.crease_count = 0;
    mesh.uv_count = 0;
    check_round_trip(&mesh);
}

// With and without UVs, colours, normals, statements and lines, in all combinations.
static void test_round_trip_of_data(void)
{
    for (int set = 0; set < 32; set++) {
        subdiv_mesh mesh = wavy_mesh();
        if (set & 1) mesh.uv_count = 0;
        if (set & 2) mesh.colors = NULL;
        if (set & 4) mesh.statement_count = 0;
        if (set & 8) mesh.normals = mesh.positions;
        if (set & 16) mesh.line_count = 0;
        check_round_trip(&mesh);
    }
}

// The text of a triangle, a triangle without UVs and a quad, in every form.
static void test_written_text(void)
{
    static float P[] = {0,0,0, 1,0,0, 1,1,0, 0,1,0.5f}, UV[] = {0,0, 0.25f,-1};
    static float colors[] = {1,0,0, 0,1,0, 0,0,1, 1,1,1}, N[] = {0,0,1, 0,0,1, 0,0,1, 0,-1,0};
    static int sizes[] = {3, 3, 4}, F[] = {0,1,2, 1,2,3, 0,1,2,3};
    static int face_uvs[] = {0,1,0, 1,-1,1, 1,1,0,0}, faces[] = {0, 1, 1, 3};
    char g[] = "g a", path[] = "mtllib C:\\x\\", s1[] = "s 1", o[] = "o end";
    char *statements[] = {g, path, s1, o};
    static const char *const texts[] = {
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3\nf 2 3 4\nf 1 2 3 4\n",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nvt 0 0\nvt 0.25 -1\n"
        "f 1/1 2/2 3/1\nf 2 3 4\nf 1/2 2/2 3/1 4/1\n",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 -1 0\n"
        "f 1//1 2//2 3//3\nf 2//2 3//3 4//4\nf 1//1 2//2 3//3 4//4\n",
        "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0.5 1 1 1\nvt 0 0\nvt 0.25 -1\n"
        "vn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 -1 0\n"
        "g a\nf 1/1/1 2/2/2 3/1/3\nmtllib C:\\x\\ \ns 1\nf 2//2 3//3 4//4\n"
        "f 1/2/1 2/2/2 3/1/3 4/1/4\no end\n",
    };
    for (int k = 0; k < 4; k++) {
        subdiv_mesh m = {0}, back;
        subdiv_error error;
        size_t size;
        m.vertex_count = 4;     m.positions = P;
        m.face_count = 3;       m.face_sizes = sizes;       m.face_vertices = F;
        m.uv_count = k % 2 * 2; m.uvs = UV;                 m.face_uvs = face_uvs;
        m.normals = k >= 2 ? N : NULL;
        m.colors = k == 3 ? colors : NULL;
        m.statement_count = k == 3 ? 4 : 0;
        m.statement_faces = faces;
        m.statements = statements;
        char *text = save_text(&m, &size, NULL);
        CHECK_TEXT(text, texts[k]);
        CHECK_EQUAL(load_bytes(&back, text, size, &error), SUBDIV_OK);
        CHECK_EQUAL(error.warning_count, k % 2);
        CHECK_EQUAL(back.uv_count, m.uv_count);
        CHECK(same_statements(&m, &back));
        for (int i = 3; i < 6 && back.face_uvs; i++) CHECK_EQUAL(back.face_uvs[i], -1);
        subdiv_mesh_free(&back);
        free(text);
    }
}

static void test_tags_only_when_needed(void)
{
    subdiv_mesh mesh = wavy_mesh();
    subdiv_options opt = {0};
    size_t size;
    char *text = save_text(&mesh, &size, &opt);
    CHECK(strstr(text, "\nt crease 2/1/0 0 1 0.1\n") != NULL);
    CHECK(strstr(text, "\nt corner 1/1/0 8 10\n") != NULL);
    CHECK(strstr(text, "\nt hole 1/0/0 4\n") != NULL);
    CHECK(strstr(text, "\nt interpolateboundary 1/0/0 2\n") != NULL);
    free(text);
    opt.no_tags = 1;
    text = save_text(&mesh, &size, &opt);
    CHECK(strstr(text, "\nt ") == NULL && strstr(text, "\nf ") != NULL);
    free(text);
    mesh.crease_count = mesh.corner_count = mesh.hole_count = 0;
    text = save_text(&mesh, &size, NULL);
    CHECK(strstr(text, "\nt ") == NULL && strstr(text, "\nf ") != NULL);
    free(text);
}

static void test_infinite_sharpness_is_written(void)
{
    subdiv_mesh mesh = wavy_mesh(), back;
    subdiv_error error;
    float crease[4] = {1e30f, 12.5f, HUGE_VALF, 1}, corner[3] = {1e30f, 10.5f, HUGE_VALF};
    size_t size;
    mesh.crease_sharpness = crease;
    mesh.corner_sharpness = corner;
    char *text = save_text(&mesh, &size, NULL);
    CHECK(strstr(text, "t crease 2/1/0 0 1 10\n") && strstr(text, "t crease 2/1/0 3 4 10\n"));
    CHECK(strstr(text, "t corner 1/1/0 8 10\n") && strstr(text, "t corner 1/1/0 4 10\n"));
    CHECK_EQUAL(load_bytes(&back, text, size, &error), SUBDIV_OK);
    CHECK_EQUAL(error.warning_count, 0);
    CHECK_EQUAL(back.crease_count, 4);
    CHECK_EQUAL(back.corner_count, 3);
    for (int i = 0; i < 3 && !test_bad; i++) {
        CHECK(back.crease_sharpness[i] >= SUBDIV_INFINITE);
        CHECK(back.corner_sharpness[i] >= SUBDIV_INFINITE);
    }
    subdiv_mesh_free(&back);
    free(text);
}

static void test_locale_does_not_matter(void)
{
    static const char *const names[] = {
        "de_DE.UTF-8", "de_DE.utf8", "de_DE", "German_Germany.1252", "fr_FR.UTF-8", "fr_FR.utf8",
        "fr_FR", "nl_NL.UTF-8", "it_IT.UTF-8", "es_ES.UTF-8", "da_DK.UTF-8", "ru_RU.UTF-8",
    };
    subdiv_mesh mesh = wavy_mesh(), back;
    size_t size, comma_size;
    const char *name = NULL;
    char *text = save_text(&mesh, &size, NULL);
    for (size_t i = 0; i < sizeof names / sizeof *names && name == NULL; i++) {
        name = setlocale(LC_ALL, names[i]);
        if (name && strcmp(localeconv()->decimal_point, ",") != 0) name = NULL;
    }
    if (name == NULL) printf("test_obj_write: no locale with a decimal comma here, test skipped\n");
    char *comma_text = save_text(&mesh, &comma_size, NULL);
    CHECK_TEXT(comma_text, text);
    CHECK_EQUAL(subdiv_load_obj_memory(&back, text, size, NULL), SUBDIV_OK);
    CHECK(same_mesh(&mesh, &back));
    subdiv_mesh_free(&back);
    setlocale(LC_ALL, "C");
    free(comma_text);
    free(text);
}

// ----------------------------------------------------------------------------- memory and files

static void test_small_buffer(void)
{
    subdiv_mesh mesh = wavy_mesh();
    subdiv_error error = {0};
    subdiv_options opt = {0};
    size_t size;
    opt.error = &error;
    char *text = save_text(&mesh, &size, NULL), *buffer = (char *)malloc(size + 1);
    for (size_t capacity = 1; capacity < size; capacity++) {
        size_t told = 0;
        memset(buffer, '~', size + 1);
        CHECK_EQUAL(subdiv_save_obj_memory(&mesh, buffer, capacity, &told, &opt),
                    SUBDIV_ERROR_TOO_LARGE);
        CHECK_EQUAL(error.code, SUBDIV_ERROR_TOO_LARGE);
        CHECK_EQUAL(told, size);
        CHECK_EQUAL(buffer[capacity], '~');
    }
    memset(buffer, '~', size + 1);
    CHECK_EQUAL(subdiv_save_obj_memory(&mesh, buffer, size, &size, &opt), SUBDIV_OK);
    CHECK(memcmp(buffer, text, size) == 0);
    CHECK_EQUAL(buffer[size], '~');
    free(buffer);
    free(text);
}

static void test_files(void)
{
    subdiv_mesh mesh = wavy_mesh(), back = {0};
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    CHECK_EQUAL(subdiv_save_obj(&mesh, scratch, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_load_obj(&back, scratch, &opt), SUBDIV_OK);
    CHECK(same_mesh(&mesh, &back));
    subdiv_mesh_free(&back);
    remove(scratch);

    memset(&back, 0x55, sizeof back);
    CHECK_EQUAL(subdiv_load_obj(&back, scratch, &opt), SUBDIV_ERROR_IO);    // just removed
    CHECK(mesh_is_zero(&back));
    CHECK(strstr(error.message, scratch) != NULL);
    CHECK(strstr(error.message, strerror(ENOENT)) != NULL);
}

// A face that is longer than any buffer: all of it is written, in every form.
static void test_long_faces_are_written(void)
{
    enum { SIZE = 20000 };
    static float positions[3 * SIZE], normals[3 * SIZE], uvs[2 * SIZE];
    static int vertices[SIZE], face_uvs[SIZE];
    static char text[24 * SIZE + 120 * SIZE];
    for (int form = 0; form < 4; form++) {
        subdiv_mesh mesh = {0}, back = {0};
        size_t size = 0;
        mesh.vertex_count = mesh.face_size = SIZE;
        mesh.face_count = 1;
        mesh.positions = positions;
        mesh.face_vertices = vertices;
        for (int i = 0; i < SIZE; i++) vertices[i] = i, face_uvs[i] = SIZE - 1 - i;
        mesh.uv_count = form & 1 ? SIZE : 0;
        mesh.uvs = form & 1 ? uvs : NULL;
        mesh.face_uvs = form & 1 ? face_uvs : NULL;
        mesh.normals = form & 2 ? normals : NULL;
        CHECK_EQUAL(subdiv_save_obj_memory(&mesh, text, sizeof text, &size, NULL), SUBDIV_OK);
        CHECK_EQUAL(subdiv_load_obj_memory(&back, text, size, NULL), SUBDIV_OK);
        mesh.normals = NULL;
        CHECK(same_mesh(&mesh, &back));
        subdiv_mesh_free(&back);
    }
}

int main(void)
{
    RUN(test_round_trip_of_every_rule);
    RUN(test_round_trip_of_one_face_size);
    RUN(test_round_trip_of_data);
    RUN(test_written_text);
    RUN(test_tags_only_when_needed);
    RUN(test_infinite_sharpness_is_written);
    RUN(test_locale_does_not_matter);
    RUN(test_small_buffer);
    RUN(test_files);
    RUN(test_long_faces_are_written);
    return test_end("obj_write");
}
