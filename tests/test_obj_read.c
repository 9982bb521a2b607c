// What the OBJ reader takes, warns about and refuses. Numbers are those of test_obj_numbers.c.
//
//     cc -I. tests/test_obj_read.c -o build/test_obj_read -lm && build/test_obj_read

#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/obj.h"
#include "lib/same.h"
#include "lib/test.h"

// ------------------------------------------------------------------------------ forms of v and f

#define QUAD V4 "f 1 2 3 4\n"
#define TWO QUAD "f 1 2 3\n"
#define VT4 "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
#define UVS V4 VT4 "f 1/1 2/2 3/3 4/4\n"

// Each text is another way to write the same mesh, without a warning.
typedef struct same_text {
    const char *text, *plain;
} same_text;

static void check_same_texts(const same_text *pairs, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        subdiv_mesh a, b;
        subdiv_error error, plain_error;
        test_context = pairs[i].text;
        CHECK_EQUAL(load(&b, pairs[i].plain, &plain_error), SUBDIV_OK);
        CHECK_EQUAL(load(&a, pairs[i].text, &error), SUBDIV_OK);
        CHECK_EQUAL(error.warning_count, 0);
        CHECK(same_mesh(&a, &b));
        subdiv_mesh_free(&a);
        subdiv_mesh_free(&b);
    }
    test_context = "";
}

#define CHECK_SAME_TEXTS(pairs) check_same_texts(pairs, sizeof(pairs) / sizeof *(pairs))

static void test_plain_quad(void)
{
    subdiv_mesh mesh;
    subdiv_error error;
    static const float P[] = {0,0,0, 1,0,0, 1,1,0, 0,1,0};
    CHECK_EQUAL(load(&mesh, TWO, &error), SUBDIV_OK);
    CHECK_EQUAL(mesh.vertex_count, 4);
    CHECK_EQUAL(mesh.face_count, 2);
    if (test_bad) return;
    CHECK(memcmp(mesh.positions, P, sizeof P) == 0);
    CHECK_EQUAL(size_of_face(&mesh, 0), 4);
    CHECK_EQUAL(size_of_face(&mesh, 1), 3);
    for (int i = 0; i < 7; i++) CHECK_EQUAL(mesh.face_vertices[i], i % 4);
    CHECK_EQUAL(mesh.boundary, SUBDIV_BOUNDARY_EDGE);
    CHECK_EQUAL(mesh.crease_count + mesh.corner_count + mesh.hole_count, 0);
    CHECK(mesh.cage_faces == NULL);
    subdiv_mesh_free(&mesh);
    CHECK(mesh_is_zero(&mesh));
}

static void test_face_forms(void)
{
    static const same_text pairs[] = {
        {V4 "f 1//1 2//2 3//3 4//4\n", QUAD},
        {V4 "f 1/ 2/ 3/ 4/\n", QUAD},
        {V4 "f 1// 2// 3// 4//\n", QUAD},
        {V4 "f 1 2/ 3// 4//4\n", QUAD},
        {V4 "f 1//9 2//-9 3//0 4\n", QUAD},
        {V4 "f 1//99999999999999999999 2//-2147483648 3 4\n", QUAD},
        {V4 "vt 0 0\nvn 0 0 1\nf 1 2 3 4\n", QUAD},
        {V4 "f -4 -3 -2 -1\n", QUAD},
        {V4 "f -4// -3//-1 -2/ -1\n", QUAD},
        {V4 VT4 "f 1/1/1 2/2/2 3/3/3 4/4/4\n", UVS},
        {V4 VT4 "f 1/1/ 2/2/ 3/3/ 4/4/\n", UVS},
        {V4 VT4 "f 1/1 2/2/ 3/3/3 4/4/-7\n", UVS},
        {V4 VT4 "f -4/-4 -3/-3/0 -2/3 4/-1\n", UVS},
        {V4 VT4 "f\t1/+1   2/02 3/3\\\n4/4\n", UVS},
        {"f 1/1 2/2 3/3 4/4\n" VT4 V4, UVS},
        {"vt 0 0\n" V4 "f 1/-1 2/2 3/3 4/4\nvt 1 0\nvt 1 1\nvt 0 1\n", UVS},
        {VT4 "vt 7 7\n" V4 "f 1/1 2/2 3/3 4/4\n", V4 VT4 "vt 7 7\nf 1/1 2/2 3/3 4/4\n"},
        {V4 "f +1 +2 +3 +4\n", QUAD},
        {V4 "f 01 0002 3 4\n", QUAD},
        {V4 "f 000000001 0000000002 00000000000000000000000003 4\n", QUAD},
        {V4 "f 1 -3 3 -1\n", QUAD},
        {V4 "fo 1 2 3 4\n", QUAD},
        {V4 "f\t1  2\t\t3 4 \t\n", QUAD},
        {"f 1 2 3 4\n" V4, QUAD},
        {"v 0 0 0\nf 1 2 3 4\nv 1 0 0\nv 1 1 0\nv 0 1 0\n", QUAD},
        {"v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf -4 -3 -2 -1\n",
         V4 "f 1 2 3\nf 1 2 3 4\n"},
        {"v 5 5 5\n" V4 "f -4 -3 -2 -1\nv 6 6 6\nf -5 -4 -1\n",
         "v 5 5 5\n" V4 "v 6 6 6\nf 2 3 4 5\nf 2 3 6\n"},
        {V4 "f 1 2 3 4\nf 1 1 2 3\nf 2 2 2\nf 1 2 3 4\nf 4 3 2 1\n",
         V4 "f 1 2 3 4\nf 1/ 1/ 2/ 3/\nf 2 -3 2\nf 1 2 3 4\nf -1 -2 -3 -4\n"},
    };
    CHECK_SAME_TEXTS(pairs);
}

#define RED "v 0 0 0 1 0 0\nv 1 0 0 .5 .25 1e-3\nv 1 1 0 1 1 1\nv 0 1 0 0 0 0\nf 1 2 3 4\n"

static void test_vertex_forms(void)
{
    static const same_text pairs[] = {
        {"v 0 0 0 1\nv 1 0 0 0.5\nv 1 1 0 2\nv 0 1 0 1\nf 1 2 3 4\n", QUAD},
        {"v 0 0 0 .1 .2 .3 .4 .5\nv 1 0 0 1 1\nv 1 1 0 0\nv 0 1 0 1 1 1 1 1 1 1 1\nf 1 2 3 4\n",
         QUAD},
        {"v .0 0. +0\nv 1e0 0e5 0E-5\nv 1.000 10e-1 0.0\nv 000 .1e+1 0\nf 1 2 3 4\n", QUAD},
        {"v 0 0 0e999999999999\nv 1 0 0\nv 1 1 0\nv 0 1 1e-99999999999\nf 1 2 3 4\n", QUAD},
        {"v\t0\t0\t0\n  v 1 0 0\n\tv 1 1 0\n \t v 0 1 0\n f 1 2 3 4\n", QUAD},
        {"v  0  0 0 \nv   1 0   0\nv 1 1 0  \r\nv 0 1 0\t\nf  1  2 3   4  \r\n", QUAD},
        {"v 0 0 0 1 0 0 1\nv 1 0 0 .5 .25 1e-3 0.5\nv 1 1 0 1 1 1 0\nv 0 1 0 0 0 0 7\nf 1 2 3 4\n",
         RED},
        {"v 0 0 0 1 0 0\nv 1 0 0 .5 .25 .001\nv 1 1 0\nv 0 1 0 0 0 0\nf 1 2 3 4\n", RED},
        {"v 0 0 0 1 1 1\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n",
         "v 0 0 0 1 1 1\nv 1 0 0 1 1 1\nv 1 1 0 1 1 1\nv 0 1 0 1 1 1\nf 1 2 3 4\n"},
        {"v 0 0 0\nv 1 0 0 1\nv 1 1 0\nv 0 1 0 1 1 1\nf 1 2 3 4\n",
         "v 0 0 0 1 1 1\nv 1 0 0 1 1 1\nv 1 1 0 1 1 1\nv 0 1 0 1 1 1\nf 1 2 3 4\n"},
        {"v 0 0 0 1 0 0#red\nv 1 0 0 .5 .25 \\\n1e-3\nv 1 1 0 1 1 1 # white\n"
         "v 0 1 0 0 0 0\nf 1 2 3 4\n", RED},
        {V4 "vt\t0 0\nvt 1\nvt 1 1 0.5 # w\nvt 0 1 1 2 3\nf 1/1 2/2 3/3 4/4\n", UVS},
        {V4 "vt 0\nvt +1e0 .0\n  vt 1 1 -1e30\\\n0\nvt -0e9 1.\nf 1/1 2/2 3/3 4/4\n",
         V4 "vt 0 0\nvt 1 0\nvt 1 1\nvt -0 1\nf 1/1 2/2 3/3 4/4\n"},
    };
    CHECK_SAME_TEXTS(pairs);
}

static void test_lines(void)
{
    static const same_text pairs[] = {
        {"v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 3 4\r\n", QUAD},
        {"v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3 4\r", QUAD},
        {"v 0 0 0\rv 1 0 0\nv 1 1 0\r\nv 0 1 0\n\rf 1 2 3 4", QUAD},
        {"\xef\xbb\xbf" QUAD, QUAD},
        {"\xef\xbb\xbf# written by an editor\n" QUAD, QUAD},
        {V4 "f 1 2 3 4", QUAD},
        {V4 "f 1 2 3 4 # the only face\n", QUAD},
        {"v 0 0 0 # first\nv 1 0 0\t# second\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n#\n# v 9 9 9\n", QUAD},
        {"\n\n \n\t\n\f\n" V4 "\n\r\n\r\rf 1 2 3 4\n\n\n", QUAD},
        {"v\f0 0 0\nv\v1 0 0\nv 1\f1 0\f\nv 0 1 0\v\nf\f1 2\v3 4\n", QUAD},
        {QUAD "\x1a", QUAD},
        {QUAD "\x1a\n", QUAD},
        {QUAD "\r\n\x1a\r\n", QUAD},
        {V4 "f 1 2 \\\n3 4\n", QUAD},
        {V4 "f 1 2 \\\r\n3 4\r\n", QUAD},
        {V4 "f 1 2 \\\r3 4\r", QUAD},
        {V4 "f 1 2\\\n 3 4\n", QUAD},
        {V4 "f 1 2\\\n3 4\n", QUAD},
        {V4 "f \\\n\\\n1 \\\n 2 \\\n 3 \\\n 4\n", QUAD},
        {V4 "f \\\n1 2 3 4 \\\n\n", QUAD},
        {V4 "f 1 2 3 4 \\", QUAD},
        {V4 "f 1 2 3 4\\\n", QUAD},
        {V4 "f 1 2 3 4 \\\r\n", QUAD},
        {"v 0 \\\n0 0\nv 1 0\\\n\t0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", QUAD},
        {"# a comment \\\n" QUAD, QUAD},
        {V4 "f 1 2 3 4 # a comment \\\nf 1 2 3\n", TWO},
    };
    CHECK_SAME_TEXTS(pairs);
}

// What is not kept: one warning for each kind, which names the first line and the count.
typedef struct other {
    const char *text;
    int warning_count;
    const char *warning;
} other;

static void test_other_keywords(void)
{
    static const other cases[] = {
        {QUAD "vn 0 0 1\nvn nan x\nvn\n", 0, ""},
        {QUAD "p 1\np 1 2\np 99\n", 1, "line 6: 3 points (p)"},
        {QUAD "l 1\nl # 2 3\n", 2, "line 6: skipped: a line has 2 vertices or more, not 1"},
        {"vp 1 2\ncstype bspline\ndeg 3 3\n" V4 "curv 0 1 1 2\nsurf 0 1 0 1 9 9\nparm u 0 1\nend\n"
         "f 1 2 3 4\n", 1, "line 1: 7 free-form"},
        {V4 "vertex 1 2 3\ncall x.obj\nf 1 2 3 4\nfoo bar\nface 1 2\nlod 3\nbevel on\n", 1,
         "line 5: 6 statements with unknown"},
        {QUAD "V 1 2 3\nF 1 2 3\nT crease 2/1/0 0 1 2\ntrace_obj x\n", 1, "line 6: 4 statements"},
        {"foo \\\nv 9 9 9\n" QUAD "p 1\nend\nfoo # \\\nend", 3, "line 8: 1 points"},
        {"vt 0 0\nvt 0\n" QUAD, 0, ""},
    };
    subdiv_mesh plain;
    subdiv_error error;
    CHECK_EQUAL(load(&plain, QUAD, &error), SUBDIV_OK);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        subdiv_mesh mesh;
        test_context = cases[i].text;
        CHECK_EQUAL(load(&mesh, cases[i].text, &error), SUBDIV_OK);
        CHECK_EQUAL(error.warning_count, cases[i].warning_count);
        if (strncmp(error.warning, cases[i].warning, strlen(cases[i].warning)) != 0)
            TEST_REPORT("\"%s\" does not begin with \"%s\"", error.warning, cases[i].warning);
        CHECK(same_mesh(&mesh, &plain));
        subdiv_mesh_free(&mesh);
    }
    test_context = "";
    subdiv_mesh_free(&plain);
}

// ----------------------------------------------------------------------------- UVs and statements

// The UV indices of the faces that a text gives, a face each: "0 1 2;3 4 -1;".
typedef struct uv_case {
    const char *text;
    int uv_count;
    const char *face_uvs;
    int warning_count;
    const char *warning;
} uv_case;

static void list_uvs(const subdiv_mesh *m, char *text)
{
    const int *uv = m->face_uvs;
    *text = 0;
    for (int f = 0; f < m->face_count && uv; f++)
        for (int i = 0; i < size_of_face(m, f); i++, uv++)
            sprintf(text + strlen(text), "%d%c", *uv, i + 1 < size_of_face(m, f) ? ' ' : ';');
}

static void test_faces_without_uvs(void)
{
    static const uv_case cases[] = {
        {QUAD, 0, "", 0, ""},
        {VT4 QUAD, 0, "", 0, ""},
        {UVS, 4, "0 1 2 3;", 0, ""},
        {UVS "f 1 2 3\n", 4, "0 1 2 3;-1 -1 -1;", 1, "line 10: 1 of 2 faces have no UVs"},
        {V4 VT4 "f 1 2 3\nf 2 3 4\nf 1/4 2/3 3/2\nf 1 3 4\n", 4,
         "-1 -1 -1;-1 -1 -1;3 2 1;-1 -1 -1;", 1, "line 9: 3 of 4 faces"},
        {V4 VT4 "f 1/1 2/2 3\nf 1 2/1 3/1\nf 1/1 2 3/4 4/2\nf 4/4 3/3 1/1\n", 4,
         "-1 -1 -1;-1 -1 -1;-1 -1 -1 -1;3 2 0;", 1, "line 9: 3 of 4 faces have a vt at some"},
        {V4 VT4 "f 1 2 3\nf 1/1 2/1 3\nf 1/4 2/3 3/2\nf 2 3 4\n", 4,
         "-1 -1 -1;-1 -1 -1;3 2 1;-1 -1 -1;", 2, "line 10: 1 of 4 faces have a vt at some"},
        {V4 VT4 "f 1/1 2/2 3//\n", 0, "", 1, "line 9: 1 of 1 faces have a vt at some"},
        {V4 "vt 0 0\nvn 0 0 1\nf 1 2/1 3//1 4/1/1\n", 0, "", 1, "line 7: 1 of 1 faces have a vt at some"},
        {V4 VT4 "f 1/1 2/2\nf 1/3 2/2 3/1\nf 4/1\n", 4, "2 1 0;", 2, "line 9: skipped: a face"},
        {"f 1/1 2/2 3\nf 3/3 2/2 1/1\n" V4 VT4, 4, "-1 -1 -1;2 1 0;", 1, "line 1: 1 of 2 faces"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        subdiv_mesh mesh;
        subdiv_error error;
        char text[256];
        test_context = cases[i].text;
        CHECK_EQUAL(load(&mesh, cases[i].text, &error), SUBDIV_OK);
        CHECK_EQUAL(mesh.uv_count, cases[i].uv_count);
        CHECK_EQUAL(mesh.uvs != NULL, cases[i].uv_count > 0);
        list_uvs(&mesh, text);
        CHECK_TEXT(text, cases[i].face_uvs);
        CHECK_EQUAL(error.warning_count, cases[i].warning_count);
        if (strncmp(error.warning, cases[i].warning, strlen(cases[i].warning)) != 0)
            TEST_REPORT("\"%s\" does not begin with \"%s\"", error.warning, cases[i].warning);
        subdiv_mesh_free(&mesh);
    }
    test_context = "";
}

// The statements of a mesh with their faces, a line each: "0 g a\n2 s 1\n".
static void list_statements(const subdiv_mesh *m, char *text)
{
    *text = 0;
    for (int i = 0; i < m->statement_count; i++)
        sprintf(text + strlen(text), "%d %s\n", m->statement_faces[i], m->statements[i]);
}

static void test_statements(void)
{
    static const same_text cases[] = {
        {QUAD, ""},
        {"mtllib a.mtl b.mtl\no thing\n" V4 "g a b\ns off\nusemtl red\nf 1 2 3\ng\ns 1\nf 1 2 3 4\n"
         "s 0\n",
         "0 mtllib a.mtl b.mtl\n0 o thing\n0 g a b\n0 s off\n0 usemtl red\n1 g\n1 s 1\n2 s 0\n"},
        {V4 "usemtl\tMaterial #25 \t\r\n  g   left  side \nf 1 2 3\n"
         "o \xc3\xa9t\xc3\xa9 \xe2\x98\x83\n",
         "0 usemtl Material #25\n0 g left  side\n1 o \xc3\xa9t\xc3\xa9 \xe2\x98\x83\n"},
        {V4 "g a \\\n b\\\r\nc\nf 1 2 3\ns \\\n\nf 1 2 3\nmtllib C:\\dir\\ \no x # y \\\n"
         "f 1 2 4\ng z\\",
         "0 g a   b c\n1 s\n2 mtllib C:\\dir\\\n2 o x\n3 g z\n"},
        {V4 "usemtl red # bright\nusemtl a#b #\ng # none\ng# none\no ## x\no \\\n# x\nf 1 2 3\n"
         "s off# x\ns 1 #2\no #2 #3\t#\n",
         "0 usemtl red\n0 usemtl a#b\n0 g\n0 g\n0 o\n0 o\n1 s off\n1 s 1\n1 o #2 #3\n"},
        {V4 "f 1 2 3\nf 1 2\ng a\nf 1\nf 1 2 3\ns 1", "1 g a\n2 s 1\n"},
        {V4 "group a\nusemtls b\nf 1 2 3\nusemtl", "1 usemtl\n"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        subdiv_mesh mesh;
        subdiv_error error;
        char text[512];
        test_context = cases[i].text;
        CHECK_EQUAL(load(&mesh, cases[i].text, &error), SUBDIV_OK);
        list_statements(&mesh, text);
        CHECK_TEXT(text, cases[i].plain);
        subdiv_mesh_free(&mesh);
    }
    test_context = "";
}

// The polylines of a mesh, a line each: "0 1\n2 3 2\n".
static void test_polylines(void)
{
    static const same_text cases[] = {
        {QUAD, ""},
        {QUAD "l 1 2\n", "0 1\n"},
        {V4 "l 1/1 -1/9 3/ # x\nl \\\n 4 +3\nl 3\nf 1 2 3 4\nl -4 -3 -2 -4",
         "0 3 2\n3 2\n0 1 2 0\n"},
        {"l 4 1 1\n" V4, "3 0 0\n"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        subdiv_mesh mesh;
        subdiv_error error;
        char text[64] = "";
        test_context = cases[i].text;
        CHECK_EQUAL(load(&mesh, cases[i].text, &error), SUBDIV_OK);
        const int *v = mesh.line_vertices;
        for (int k = 0; k < mesh.line_count; k++)
            for (int j = 0; j < mesh.line_sizes[k]; j++, v++)
                sprintf(text + strlen(text), "%d%c", *v, j + 1 < mesh.line_sizes[k] ? ' ' : '\n');
        CHECK_TEXT(text, cases[i].plain);
        subdiv_mesh_free(&mesh);
    }
    test_context = "";
}

static void test_long_lines(void)
{
    enum { MEGABYTE = 1 << 20, SIDES = 100000 };
    char *text = (char *)malloc(4 * MEGABYTE), piece[64];
    size_t size = 0;
    subdiv_mesh mesh, plain;
    subdiv_error error;
    append(text, &size, "# ");
    memset(text + size, 'v', MEGABYTE);
    size += MEGABYTE;
    append(text, &size, "\n" V4 "f 1 2 3 4 # ");
    memset(text + size, ' ', MEGABYTE);
    size += MEGABYTE;
    append(text, &size, "\nf 1 2 3");
    CHECK_EQUAL(load_bytes(&mesh, text, size, &error), SUBDIV_OK);
    CHECK_EQUAL(load(&plain, TWO, &error), SUBDIV_OK);
    CHECK(same_mesh(&mesh, &plain));
    subdiv_mesh_free(&plain);
    subdiv_mesh_free(&mesh);

    size = 0;
    for (int i = 0; i < SIDES; i++) {
        snprintf(piece, sizeof piece, "v %d 0 %d\n", i, i % 7);
        append(text, &size, piece);
    }
    append(text, &size, "f");
    for (int i = SIDES; i > 0; i--) {
        snprintf(piece, sizeof piece, i % 10 ? " %d" : " \\\n %d", i);
        append(text, &size, piece);
    }
    CHECK_EQUAL(load_bytes(&mesh, text, size, &error), SUBDIV_OK);
    CHECK_EQUAL(mesh.face_count, 1);
    if (mesh.face_count == 1) CHECK_EQUAL(size_of_face(&mesh, 0), SIDES);
    for (int i = 0; i < SIDES && !test_bad; i++) {
        CHECK_EQUAL(mesh.face_vertices[i], SIDES - 1 - i);
        CHECK(mesh.positions[3 * i] == (float)i);
    }
    subdiv_mesh_free(&mesh);
    free(text);
}

// A text of several blocks, of lines of every kind in any order, read in blocks of other sizes.
static void test_block_borders(void)
{
    static const char *const lines[] = {
        "v 1 2.5 -3\n", "v\t1e3 .5 0 # x\n", "v 1 2 3 .5 .5 .5\r\n", "vt .25 1\n", "vt 1\r",
        "f 1 2 3\n", "f 1/1 2/1 3/1\n", "f -1 -2 \\\n-3\r\n", "f 3//3 2//2 1//1 1//7 \n", "g a b\n",
        "usemtl red\n", "# a comment \\\n", "\n", "\r\n", "s 1\r", "l 1 2\n", "vn 0 0 1\n",
        "t crease 2/1/0 0 1 2\n",
        "  f 1/1/1 2/1/1 3/1/1 2/1/1 1/1/1\n", "v 0.1234567890123456789 1 1\n", "f 1 2\n", "\\\n\n",
    };
    enum { LINES = 60000, KINDS = sizeof lines / sizeof *lines };
    char *text = (char *)malloc(LINES * 40);
    size_t size = 0;
    append(text, &size, "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\n");
    for (int i = 0; i < LINES; i++) append(text, &size, lines[random_bits() % KINDS]);
    append(text, &size, "f 1 2 77777");         // how many lines there are, and vertices
    size_t steps[] = {size, 1, 11, 4096, 262142, 262143, 100003};
    for (int bad = 0; bad < 2; bad++) {
        subdiv_mesh first = {0};
        subdiv_error first_error = {0};
        for (int k = 0; k < 7; k++) {
            pieces p = {text, bad ? size : size - 11, 0, steps[k]};
            subdiv_mesh mesh;
            subdiv_error error = {0};
            subdiv_options opt = {0};
            opt.error = &error;
            CHECK_EQUAL(subdiv_load_obj_callback(&mesh, read_piece, &p, &opt),
                        bad ? SUBDIV_ERROR_INDEX : SUBDIV_OK);
            if (k == 0) {
                first = mesh;
                first_error = error;
                continue;
            }
            CHECK(same_mesh(&mesh, &first));
            CHECK_EQUAL(error.line, first_error.line);
            CHECK_EQUAL(error.warning_count, first_error.warning_count);
            CHECK_TEXT(error.message, first_error.message);
            CHECK_TEXT(error.warning, first_error.warning);
            subdiv_mesh_free(&mesh);
        }
        if (!bad) CHECK(first.face_count > LINES / 6 && first.vertex_count > LINES / 10);
        if (!bad) CHECK(first.uv_count > 0 && first.colors && first.statement_count > LINES / 10);
        subdiv_mesh_free(&first);
    }
    free(text);
}

// Groups cost no more the more there are.
static void test_many_groups(void)
{
    enum { GROUPS = 60000 };
    char *text = (char *)malloc(GROUPS * 48), piece[64];
    subdiv_mesh mesh;
    size_t size = 0;
    append(text, &size, V4);
    for (int i = 0; i < GROUPS; i++) {
        snprintf(piece, sizeof piece, "g group %d\nusemtl m%d\nf 1 2 3\n", i, i);
        append(text, &size, piece);
    }
    CHECK_EQUAL(subdiv_load_obj_memory(&mesh, text, size, NULL), SUBDIV_OK);
    CHECK_EQUAL(mesh.statement_count, 2 * GROUPS);
    for (int i = 0; i < mesh.statement_count && !test_bad; i++) {
        snprintf(piece, sizeof piece, i % 2 ? "usemtl m%d" : "g group %d", i / 2);
        CHECK_TEXT(mesh.statements[i], piece);
        CHECK_EQUAL(mesh.statement_faces[i], i / 2);
    }
    subdiv_mesh_free(&mesh);
    free(text);
}

// ---------------------------------------------------------------------------------------- tags

// What a tag adds to the cage: creases as text "0-1:2.5 ", corners "2:3 ", holes "1 ".
typedef struct tag_case {
    const char *tag, *creases, *corners, *holes;
} tag_case;

static void list_tags(const subdiv_mesh *m, char *creases, char *corners, char *holes)
{
    *creases = *corners = *holes = 0;
    for (int i = 0; i < m->crease_count && i < 8; i++)
        sprintf(creases + strlen(creases), "%d-%d:%g ", m->crease_vertices[2 * i],
                m->crease_vertices[2 * i + 1], (double)m->crease_sharpness[i]);
    for (int i = 0; i < m->corner_count && i < 8; i++)
        sprintf(corners + strlen(corners), "%d:%g ", m->corner_vertices[i],
                (double)m->corner_sharpness[i]);
    for (int i = 0; i < m->hole_count && i < 8; i++)
        sprintf(holes + strlen(holes), "%d ", m->holes[i]);
}

static void test_crease_corner_hole_tags(void)
{
    static const tag_case cases[] = {
        {"t crease 2/1/0 0 1 2.5\n", "0-1:2.5 ", "", ""},
        {"t  crease\t2/1/0  1  0  2.5 # bent\n", "1-0:2.5 ", "", ""},
        {"t crease 2/1/0 0 1 \\\n 2.5\n", "0-1:2.5 ", "", ""},
        {"t crease 2/1/0 0 1 1\nt crease 2/1/0 1 2 20\n", "0-1:1 1-2:20 ", "", ""},
        {"t crease 4/1/0 0 1 2 3 1.5\n", "0-1:1.5 2-3:1.5 ", "", ""},
        {"t crease 4/2/0 0 1 2 3 1.5 2\n", "0-1:1.5 2-3:2 ", "", ""},
        {"t crease 3/2/0 0 1 2 1.5 2\n", "0-1:1.5 1-2:2 ", "", ""},
        {"t crease 4/3/0 0 1 2 3 1.5 2 3\n", "0-1:1.5 1-2:2 2-3:3 ", "", ""},
        {"t crease 6/3/0 0 1 1 2 2 3 1 2 3\n", "0-1:1 1-2:2 2-3:3 ", "", ""},
        {"t corner 1/1/0 2 3\n", "", "2:3 ", ""},
        {"t corner 2/2/0 2 0 3 .5\n", "", "2:3 0:0.5 ", ""},
        {"t corner 2/1/0 2 0 3\n", "", "2:3 0:3 ", ""},
        {"t hole 1/0/0 1\n", "", "", "1 "},
        {"t hole 2/0/0 1 0\n", "", "", "1 0 "},
        {"t hole 1/0/0 1\nt corner 1/1/0 4 9\nt crease 2/1/0 4 0 1\n", "4-0:1 ", "4:9 ", "1 "},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        // The same tags behind the faces and before everything.
        for (int first = 0; first < 2; first++) {
            char text[512], creases[256], corners[256], holes[256];
            subdiv_mesh mesh;
            subdiv_error error;
            test_context = cases[i].tag;
            sprintf(text, "%s%s", first ? cases[i].tag : CAGE, first ? CAGE : cases[i].tag);
            CHECK_EQUAL(load(&mesh, text, &error), SUBDIV_OK);
            CHECK_EQUAL(error.warning_count, 0);
            list_tags(&mesh, creases, corners, holes);
            CHECK_TEXT(creases, cases[i].creases);
            CHECK_TEXT(corners, cases[i].corners);
            CHECK_TEXT(holes, cases[i].holes);
            subdiv_mesh_free(&mesh);
        }
    }
    test_context = "";
}

typedef struct rule_case {
    const char *tag;
    subdiv_boundary boundary;
    subdiv_creasing creasing;
    subdiv_triangles triangles;
    subdiv_uv_rule uv_rule;
} rule_case;

static void test_rule_tags(void)
{
    static const rule_case cases[] = {
        {"", (subdiv_boundary)0, (subdiv_creasing)0, (subdiv_triangles)0, (subdiv_uv_rule)0},
#define BOUNDARY(k, rule) {"t interpolateboundary 1/0/0 " k "\n", rule, (subdiv_creasing)0, \
                           (subdiv_triangles)0, (subdiv_uv_rule)0}
        BOUNDARY("0", SUBDIV_BOUNDARY_NONE),
        BOUNDARY("1", SUBDIV_BOUNDARY_EDGE_AND_CORNER),
        BOUNDARY("2", SUBDIV_BOUNDARY_EDGE),
        BOUNDARY("0\nt interpolateboundary 1/0/0 1", SUBDIV_BOUNDARY_EDGE_AND_CORNER),
        BOUNDARY("1\nt interpolateboundary 1/0/0 2", SUBDIV_BOUNDARY_EDGE),
#define UV(k, rule) {"t facevaryinginterpolateboundary 1/0/0 " k "\n", (subdiv_boundary)0, \
                     (subdiv_creasing)0, (subdiv_triangles)0, rule}
        UV("0", SUBDIV_UV_NONE),
        UV("1", SUBDIV_UV_CORNERS_ONLY),
        UV("2", SUBDIV_UV_CORNERS_PLUS1),
        UV("3", SUBDIV_UV_CORNERS_PLUS2),
        UV("4", SUBDIV_UV_BOUNDARIES),
        UV("5", SUBDIV_UV_ALL),
#define CREASING(name, rule) {"t creasemethod 0/0/1 " name "\n", (subdiv_boundary)0, rule, \
                              (subdiv_triangles)0, (subdiv_uv_rule)0}
        CREASING("chaikin", SUBDIV_CREASING_CHAIKIN),
        CREASING("normal", SUBDIV_CREASING_UNIFORM),
        CREASING("chaikin\nt creasemethod 0/0/1 normal", SUBDIV_CREASING_UNIFORM),
#define TRIANGLES(name, rule) {"t smoothtriangles 0/0/1 " name "\n", (subdiv_boundary)0, \
                               (subdiv_creasing)0, rule, (subdiv_uv_rule)0}
        TRIANGLES("smooth", SUBDIV_TRIANGLES_SMOOTH),
        TRIANGLES("catmark", SUBDIV_TRIANGLES_CATMULL_CLARK),
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        subdiv_mesh mesh;
        subdiv_error error;
        test_context = cases[i].tag;
        sprintf(text, "%s%s", CAGE, cases[i].tag);
        CHECK_EQUAL(load(&mesh, text, &error), SUBDIV_OK);
        CHECK_EQUAL(error.warning_count, 0);
        CHECK_EQUAL(mesh.boundary, cases[i].boundary);
        CHECK_EQUAL(mesh.creasing, cases[i].creasing);
        CHECK_EQUAL(mesh.triangles, cases[i].triangles);
        CHECK_EQUAL(mesh.uv_rule, cases[i].uv_rule);
        subdiv_mesh_free(&mesh);
    }
    test_context = "";
}

// Each of these is skipped with one warning that names its line, 8.
static void test_skipped_with_warning(void)
{
    static const char *const bad[] = {
        "t\n", "t crease\n", "t crease x\n", "t crease 2\n", "t crease 2/1\n", "t crease 2/1/0\n",
        "t crease 2/1/0 0 99 1\n", "t crease 2/1/0 0 5 1\n", "t crease 2/1/0 -1 1 2\n",
        "t crease 2/1/0 0 1\n", "t crease 2/1/0 0\n", "t crease 2/1/0 0 x 2\n",
        "t crease 2/1/0 0 1 x\n", "t crease 2/1/0 0 1 nan\n", "t crease 2/0/0 0 1\n",
        "t crease 1/1/0 0 2\n", "t crease 0/1/0 2\n", "t crease 5/2/0 0 1 2 3 4 1 2\n",
        "t crease 2000000000/1/0 0 1 2\n", "t crease 2/2000000000/0 0 1 2\n",
        "t crease -1/-1/-1 0 1 2\n", "t crease 2/1/0 0 99999999999999999999 1\n",
        "t crease 99999999999999999999/1/0 0 1 2\n", "t crease 2/1/0 0 4294967297 1\n",
        "t crease 2/1/0 0 18446744073709551617 1\n", "t crease 18446744073709551618/1/0 0 1 1\n",
        "t corner 1/1/0 5 1\n", "t corner 1/1/0 -1 1\n", "t corner 1/1/0 1\n",
        "t corner 0/1/0 1\n", "t corner 3/2/0 0 1 2 1 1\n", "t corner 1/0/0 1\n",
        "t hole 1/0/0 2\n", "t hole 1/0/0 -1\n", "t hole 1/0/0\n", "t hole 1/0/0 x\n",
        "t interpolateboundary 1/0/0 3\n", "t interpolateboundary 1/0/0 -1\n",
        "t interpolateboundary 1/0/0\n", "t interpolateboundary 0/0/0\n",
        "t facevaryinginterpolateboundary 1/0/0 6\n", "t facevaryinginterpolateboundary 1/0/0\n",
        "t creasemethod 0/0/1 other\n", "t creasemethod 0/0/1\n", "t creasemethod 0/0/0\n",
        "t smoothtriangles 0/0/1 other\n", "t smoothtriangles 0/0/1\n",
        "f 1 2\n", "f 1\n", "f\n", "f \n", "f 1 2 # 3\n", "fo 3 4\n",
    };
    subdiv_mesh plain;
    subdiv_error error;
    CHECK_EQUAL(load(&plain, CAGE, &error), SUBDIV_OK);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char text[512];
        subdiv_mesh mesh;
        test_context = bad[i];
        sprintf(text, "%s%s%s", CAGE, bad[i], "# the end\n");
        CHECK_EQUAL(load(&mesh, text, &error), SUBDIV_OK);
        CHECK_EQUAL(error.warning_count, 1);
        CHECK(strstr(error.warning, "8") != NULL);
        CHECK(same_mesh(&mesh, &plain));
        subdiv_mesh_free(&mesh);
    }
    test_context = "";
    subdiv_mesh_free(&plain);
}

// Holes count the faces of the file, also those that are skipped.
static void test_holes_after_a_skipped_face(void)
{
    subdiv_mesh mesh;
    subdiv_error error;
    const char text[] = V4 "f 1 2 3\nf 4\nf 1 2 3 4\nf 1 2 4\nt hole 2/0/0 2 3\nt hole 1/0/0 0\n";
    CHECK_EQUAL(load(&mesh, text, &error), SUBDIV_OK);
    CHECK_EQUAL(error.warning_count, 1);
    CHECK_EQUAL(mesh.hole_count, 3);
    if (test_bad) return;
    CHECK_EQUAL(mesh.holes[0], 1);
    CHECK_EQUAL(mesh.holes[1], 2);
    CHECK_EQUAL(mesh.holes[2], 0);
    subdiv_mesh_free(&mesh);
    CHECK_EQUAL(load(&mesh, V4 "f 1 2 3\nf 4\nf 1 2 3 4\nt hole 1/0/0 1\n", &error), SUBDIV_OK);
    CHECK_EQUAL(error.warning_count, 2);
    CHECK_EQUAL(mesh.hole_count, 0);
    subdiv_mesh_free(&mesh);
}

// Warnings add up over calls and the first one stays.
static void test_warnings_add_up(void)
{
    subdiv_mesh mesh, fine;
    subdiv_error error = {0};
    subdiv_options opt = {0};
    const char text[] = CAGE "t hole x\nf 1 2\nt crease 2/1/0 0 77 1\nt crease 2/1/0 2 4 1\n";
    opt.error = &error;
    CHECK_EQUAL(subdiv_load_obj_memory(&mesh, text, sizeof text - 1, &opt), SUBDIV_OK);
    CHECK_EQUAL(error.warning_count, 3);
    CHECK(strstr(error.warning, "t hole x") != NULL);
    CHECK_EQUAL(subdiv_refine(&fine, &mesh, 1, &opt), SUBDIV_OK);
    CHECK_EQUAL(error.warning_count, 4);            // vertices 2 and 4 share no edge
    CHECK(strstr(error.warning, "t hole x") != NULL);
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&mesh);
}

// ------------------------------------------------------------------------------------ refusals

typedef struct refusal {
    const char *text;
    subdiv_result code;
    int line;
    const char *tokens[2];            // which the message holds
} refusal;

// As much as a message holds of what it is about.
#define DIGITS40 "9876543210987654321098765432109876543210"

static const refusal refusals[] = {
    {V4 "f 1 2 3 4\nf 1 2 9\n", SUBDIV_ERROR_INDEX, 6, {"9", "4"}},
    {V4 "f 1 2 5\n", SUBDIV_ERROR_INDEX, 5, {"5", "4"}},
    {V4 "vt 0 0\nf 1/1 2/2 3/1\n", SUBDIV_ERROR_INDEX, 6, {"vt 2", "1"}},
    {"f 1 2 5\n" V4, SUBDIV_ERROR_INDEX, 1, {"5", "4"}},
    {"f 1 2 3\n", SUBDIV_ERROR_EMPTY, 0, {"no vertices", ""}},
    {"v 0 0 0\nf -1 -2 -3\nv 1 0 0\nv 1 1 0\n", SUBDIV_ERROR_INDEX, 2, {"-2", "1"}},
    {V4 "f -1 -2 -5\n", SUBDIV_ERROR_INDEX, 5, {"-5", "4"}},
    {V4 "\n\nf 1 0 2\n", SUBDIV_ERROR_INDEX, 7, {"0", ""}},
    {V4 "f 1 2 4294967297\n", SUBDIV_ERROR_INDEX, 5, {"4294967297", ""}},
    {V4 "f 1 2 2147483648\n", SUBDIV_ERROR_INDEX, 5, {"2147483648", ""}},
    {V4 "f 1 2 2147483647\n", SUBDIV_ERROR_INDEX, 5, {"2147483647", "4"}},
    {V4 "f 1 2 -2147483648\n", SUBDIV_ERROR_INDEX, 5, {"-2147483648", ""}},
    {V4 "f 1 2 99999999999999999999\n", SUBDIV_ERROR_INDEX, 5, {"99999999999999999999", ""}},
    {V4 "f 1 2 -99999999999999999999\n", SUBDIV_ERROR_INDEX, 5, {"-99999999999999999999", ""}},
    {V4 "f 1 2 18446744073709551617\n", SUBDIV_ERROR_INDEX, 5, {"18446744073709551617", ""}},
    {V4 "f 1 2 -18446744073709551615\n", SUBDIV_ERROR_INDEX, 5, {"-18446744073709551615", ""}},
    {"v " DIGITS40 "x 0 0\n", SUBDIV_ERROR_SYNTAX, 1, {"\"" DIGITS40 "...\" is", ""}},
    {"v " DIGITS40 "\n", SUBDIV_ERROR_NOT_FINITE, 1, {"\"" DIGITS40 "\" is", ""}},
    {V4 "f 1 2 \\\n 3\nf 1 2 9\n", SUBDIV_ERROR_INDEX, 7, {"9", "4"}},
    {V4 "f 1 \\\r\n2 \\\r\n9\r\n", SUBDIV_ERROR_INDEX, 5, {"9", "4"}},
    {V4 "l 1 5\n", SUBDIV_ERROR_INDEX, 5, {"5", "4"}},
    {"v 0 0 0\nl -1 -2\nv 1 0 0\n", SUBDIV_ERROR_INDEX, 2, {"-2", "1"}},
    {V4 "l 1 2 x\n", SUBDIV_ERROR_SYNTAX, 5, {"x", "a line"}},
    {V4 "l 1 2/x\n", SUBDIV_ERROR_SYNTAX, 5, {"2/x", "a line"}},
    {V4 "l 1//2 2//2\n", SUBDIV_ERROR_SYNTAX, 5, {"1//2", "a line"}},
    {V4 "f 1.0 2 3\n", SUBDIV_ERROR_SYNTAX, 5, {"1.0", ""}},
    {V4 "f a b c\n", SUBDIV_ERROR_SYNTAX, 5, {"a", ""}},
    {V4 "f 1 2 x 3\n", SUBDIV_ERROR_SYNTAX, 5, {"x", ""}},
    {V4 "f 1 / 1 2 3\n", SUBDIV_ERROR_SYNTAX, 5, {"/", ""}},
    {V4 "f 1 2 3 /4\n", SUBDIV_ERROR_SYNTAX, 5, {"/4", ""}},
    {V4 "f 1 2 3-4\n", SUBDIV_ERROR_SYNTAX, 5, {"3-4", ""}},
    {V4 "f 1 2 - 3\n", SUBDIV_ERROR_SYNTAX, 5, {"-", ""}},
    {V4 "f 1 2 + 3\n", SUBDIV_ERROR_SYNTAX, 5, {"+", ""}},
    {V4 "f 1 2 --3\n", SUBDIV_ERROR_SYNTAX, 5, {"--3", ""}},
    {V4 "f 1,2,3\n", SUBDIV_ERROR_SYNTAX, 5, {"1,2,3", ""}},
    {V4 "f 1 x\n", SUBDIV_ERROR_SYNTAX, 5, {"x", ""}},
    {"v 0 0 0\nv\n", SUBDIV_ERROR_SYNTAX, 2, {"", ""}},
    {"v 0 0 0\nv 1\n", SUBDIV_ERROR_SYNTAX, 2, {"", ""}},
    {"v 0 0 0\r\nv 1 2\r\nv 1 2 3\r\n", SUBDIV_ERROR_SYNTAX, 2, {"", ""}},
    {"v 0 0 0\rv 1 2 # 3\rv 1 2 3\r", SUBDIV_ERROR_SYNTAX, 2, {"", ""}},
    {"v 0 abc 0\n", SUBDIV_ERROR_SYNTAX, 1, {"abc", ""}},
    {"v 0 0 0\nv 0,5 0,25 0\n", SUBDIV_ERROR_SYNTAX, 2, {"0,5", ""}},
    {"v 0 1e 0\n", SUBDIV_ERROR_SYNTAX, 1, {"1e", ""}},
    {"v 0 1e+ 0\n", SUBDIV_ERROR_SYNTAX, 1, {"1e+", ""}},
    {"v 0 1e5.5 0\n", SUBDIV_ERROR_SYNTAX, 1, {"1e5.5", ""}},
    {"v 0 . 0\n", SUBDIV_ERROR_SYNTAX, 1, {".", ""}},
    {"v 0 - 0\n", SUBDIV_ERROR_SYNTAX, 1, {"-", ""}},
    {"v 0 --1 0\n", SUBDIV_ERROR_SYNTAX, 1, {"--1", ""}},
    {"v 0 e5 0\n", SUBDIV_ERROR_SYNTAX, 1, {"e5", ""}},
    {"v 0 .e5 0\n", SUBDIV_ERROR_SYNTAX, 1, {".e5", ""}},
    {"v 0 1.2.3 0\n", SUBDIV_ERROR_SYNTAX, 1, {"1.2.3", ""}},
    {"v 0 0x10 0\n", SUBDIV_ERROR_SYNTAX, 1, {"0x10", ""}},
    {"v 0 1f 0\n", SUBDIV_ERROR_SYNTAX, 1, {"1f", ""}},
    {"v 0 nan 0\n", SUBDIV_ERROR_SYNTAX, 1, {"nan", ""}},
    {"v 0 0 0\nv 0 -NaN 0\n", SUBDIV_ERROR_SYNTAX, 2, {"-NaN", ""}},
    {"v 0 inf 0\n", SUBDIV_ERROR_SYNTAX, 1, {"inf", ""}},
    {"v 0 0 -Infinity\n", SUBDIV_ERROR_SYNTAX, 1, {"-Infinity", ""}},
    {"v 0 0 -1.#IND\n", SUBDIV_ERROR_SYNTAX, 1, {"-1.#IND", ""}},
    {"v 0 0 1e400\n", SUBDIV_ERROR_NOT_FINITE, 1, {"1e400", ""}},
    {"v 0 0 1e999999999\n", SUBDIV_ERROR_NOT_FINITE, 1, {"1e999999999", ""}},
    {"v 0 0 -1e99999999999999999999\n", SUBDIV_ERROR_NOT_FINITE, 1, {"-1e9999999999999999", ""}},
    {"v 0 0 1e18446744073709551617\n", SUBDIV_ERROR_NOT_FINITE, 1, {"1e18446744073709551617", ""}},
    {"v 0 0 3.4028236e38\n", SUBDIV_ERROR_NOT_FINITE, 1, {"3.4028236e38", ""}},
    {"v 0 0 0 x\n", SUBDIV_ERROR_SYNTAX, 1, {"x", ""}},
    {"v 0 0 0 1 0 nan\n", SUBDIV_ERROR_SYNTAX, 1, {"nan", ""}},
    {"v 0 0 0 1 0 1e39\n", SUBDIV_ERROR_NOT_FINITE, 1, {"1e39", ""}},
    {V4 "vt\n", SUBDIV_ERROR_SYNTAX, 5, {"vt", ""}},
    {V4 "vt # 0 0\n", SUBDIV_ERROR_SYNTAX, 5, {"vt", ""}},
    {V4 "vt 0 x\n", SUBDIV_ERROR_SYNTAX, 5, {"x", ""}},
    {V4 "vt 0,5 0,25\n", SUBDIV_ERROR_SYNTAX, 5, {"0,5", ""}},
    {V4 "vt 0 1 -inf\n", SUBDIV_ERROR_SYNTAX, 5, {"-inf", ""}},
    {V4 "vt 0 1e40\n", SUBDIV_ERROR_NOT_FINITE, 5, {"1e40", ""}},
    {V4 "vt 0 0\nf 1/1 2/1 3/7\n", SUBDIV_ERROR_INDEX, 6, {"vt 7", "1"}},
    {"f 1/1 2/1 3/7\nvt 0 0\n" V4, SUBDIV_ERROR_INDEX, 1, {"vt 7", "1"}},
    {V4 "vt 0 0\nf 1/0 2/1 3/1\n", SUBDIV_ERROR_INDEX, 6, {"vt 0", ""}},
    {V4 "vt 0 0\nf 1/1 2/-2 3/1\n", SUBDIV_ERROR_INDEX, 6, {"vt -2", "1"}},
    {V4 "f 1/-1 2/-1 3/-1\nvt 0 0\n", SUBDIV_ERROR_INDEX, 5, {"vt -1", "0"}},
    {V4 "f 1/1 2/2 3/3 4/4\n", SUBDIV_ERROR_INDEX, 5, {"vt 1", "0"}},
    {V4 "vt 0 0\nf 1/1/1 2/1/1 3/2147483648/1\n", SUBDIV_ERROR_INDEX, 6, {"2147483648", ""}},
    {V4 "vt 0 0\nf 1/1 2/1 3/4294967297\n", SUBDIV_ERROR_INDEX, 6, {"4294967297", ""}},
    {V4 "vt 0 0\nf 1/1 2/1 3/99999999999999999999\n", SUBDIV_ERROR_INDEX, 6,
     {"99999999999999999999", ""}},
    {V4 "vt 0 0\nf 1/1 2/1\nf 1/2 3\n", SUBDIV_ERROR_INDEX, 7, {"vt 2", "1"}},
    {V4 "vt 0 0\nf 1/1.0 2/1 3/1\n", SUBDIV_ERROR_SYNTAX, 6, {"1/1.0", ""}},
    {V4 "vt 0 0\nf 1/x 2/1 3/1\n", SUBDIV_ERROR_SYNTAX, 6, {"1/x", ""}},
    {V4 "vt 0 0\nf 1/1/x 2/1 3/1\n", SUBDIV_ERROR_SYNTAX, 6, {"1/1/x", ""}},
    {V4 "vt 0 0\nf 1/1/1/1 2/1 3/1\n", SUBDIV_ERROR_SYNTAX, 6, {"1/1/1/1", ""}},
    {V4 "vt 0 0\nf 1/- 2/1 3/1\n", SUBDIV_ERROR_SYNTAX, 6, {"1/-", ""}},
    {V4 "vt 0 0\nf 1/1\\ 2/1 3/1\n", SUBDIV_ERROR_SYNTAX, 6, {"1/1\\", ""}},
    {"", SUBDIV_ERROR_EMPTY, 0, {"no vertices", ""}},
    {"\n", SUBDIV_ERROR_EMPTY, 0, {"no vertices", ""}},
    {"# nothing\n# here\n", SUBDIV_ERROR_EMPTY, 0, {"no vertices", ""}},
    {"\xef\xbb\xbf", SUBDIV_ERROR_EMPTY, 0, {"no vertices", ""}},
    {"<!DOCTYPE html>\n<html><body>404</body></html>\n", SUBDIV_ERROR_EMPTY, 0,
     {"no vertices", ""}},
    {"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n", SUBDIV_ERROR_SYNTAX, 1,
     {"Git LFS", ""}},
    {"V 0 0 0\nV 1 0 0\n", SUBDIV_ERROR_EMPTY, 0, {"no vertices", ""}},
};

static const char *scratch = "build/test_obj_read.obj";

static int write_file(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL) return 0;
    size_t written = fwrite(bytes, 1, size, file);
    return fclose(file) == 0 && written == size;
}

static void check_message(const subdiv_error *error, const refusal *r)
{
    CHECK_EQUAL(error->code, r->code);
    CHECK_EQUAL(error->line, r->line);
    for (int k = 0; k < 2; k++)
        if (strstr(error->message, r->tokens[k]) == NULL)
            TEST_REPORT("\"%s\" does not name \"%s\"", error->message, r->tokens[k]);
}

static void test_refusals(void)
{
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
        subdiv_mesh mesh;
        subdiv_error error;
        test_context = refusals[i].text;
        CHECK_EQUAL(load(&mesh, refusals[i].text, &error), refusals[i].code);
        check_message(&error, &refusals[i]);
        CHECK_EQUAL(error.face, -1);
        CHECK_EQUAL(error.vertex, -1);
        subdiv_mesh_free(&mesh);
    }
    test_context = "";
}

// From a file, the message begins with its name and line: with the last 100 bytes of a long name.
static void test_refusals_of_a_file(void)
{
    char long_path[256] = "build/";
    while (strlen(long_path) < 140) strcat(long_path, "./");
    strcat(long_path, "test_obj_read.obj");
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
        subdiv_mesh mesh;
        subdiv_error error = {0};
        subdiv_options opt = {0};
        char place[512];
        const char *path = i % 2 ? long_path : scratch, *cut = i % 2 ? "..." : "";
        const char *name = i % 2 ? path + strlen(path) - 100 : path;
        opt.error = &error;
        test_context = refusals[i].text;
        CHECK(write_file(path, refusals[i].text, strlen(refusals[i].text)));
        memset(&mesh, 0x55, sizeof mesh);
        CHECK_EQUAL(subdiv_load_obj(&mesh, path, &opt), refusals[i].code);
        CHECK(mesh_is_zero(&mesh));
        subdiv_mesh_free(&mesh);
        check_message(&error, &refusals[i]);
        if (refusals[i].line) sprintf(place, "%s%s:%d: ", cut, name, refusals[i].line);
        else sprintf(place, "%s%s: ", cut, name);
        if (strncmp(error.message, place, strlen(place)) != 0)
            TEST_REPORT("\"%s\" does not begin with \"%s\"", error.message, place);
    }
    remove(scratch);
    test_context = "";
}

static void test_binary_is_refused(void)
{
    static const char nul_in_line[] = "v 0 0 0\nv 1 0\0 0\n", nuls[64] = {0};
    static const char in_comment[] = "v 0 0 0\n# \0\n", at_end[] = "v 0 0 0\nv 1 1 1\0";
    static const char utf16[] = "\xff\xfe" "v\0 \0" "0\0 \0" "0\0 \0" "0\0\n\0";
    static const char big_endian[] = "\xfe\xff" "\0v\0 \0" "0\0 \0" "0\0 \0" "0\0\n";
    const struct { const char *text; size_t size; int line; } cases[] = {
        {nul_in_line, sizeof nul_in_line - 1, 2}, {nuls, sizeof nuls, 1},
        {in_comment, sizeof in_comment - 1, 2}, {at_end, sizeof at_end - 1, 2},
        {utf16, sizeof utf16 - 1, 1}, {big_endian, sizeof big_endian - 1, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        subdiv_mesh mesh;
        subdiv_error error;
        test_context = i == 0 ? "0 in a line" : i == 1 ? "all 0" : i == 2 ? "0 in a comment"
                     : i == 3 ? "0 at the end" : "UTF-16";
        CHECK_EQUAL(load_bytes(&mesh, cases[i].text, cases[i].size, &error), SUBDIV_ERROR_SYNTAX);
        CHECK_EQUAL(error.line, cases[i].line);
        CHECK(strstr(error.message, i < 4 ? "not an OBJ file" : "UTF-16") != NULL);
        subdiv_mesh_free(&mesh);
    }
    test_context = "";
}

int main(void)
{
    RUN(test_plain_quad);
    RUN(test_face_forms);
    RUN(test_vertex_forms);
    RUN(test_lines);
    RUN(test_other_keywords);
    RUN(test_faces_without_uvs);
    RUN(test_statements);
    RUN(test_polylines);
    RUN(test_long_lines);
    RUN(test_block_borders);
    RUN(test_many_groups);
    RUN(test_crease_corner_hole_tags);
    RUN(test_rule_tags);
    RUN(test_skipped_with_warning);
    RUN(test_holes_after_a_skipped_face);
    RUN(test_warnings_add_up);
    RUN(test_refusals);
    RUN(test_refusals_of_a_file);
    RUN(test_binary_is_refused);
    return test_end("obj_read");
}
