// What the OBJ reader takes, warns about and refuses, and what the writer writes.
//
//     cc -I. tests/test_obj.c -o build/test_obj -lm && build/test_obj

#include <errno.h>
#include <float.h>
#include <limits.h>
#include <locale.h>
#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "test.h"
#include "same.h"

// ------------------------------------------------------------------------------------- loading

static unsigned random_state = 2463534242u;

static unsigned random_bits(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 17;
    random_state ^= random_state << 5;
    return random_state;
}

static float from_bits(unsigned bits)
{
    float f;
    memcpy(&f, &bits, sizeof f);
    return f;
}

static unsigned to_bits(float f)
{
    unsigned bits;
    memcpy(&bits, &f, sizeof bits);
    return bits;
}

// A text handed out in pieces of at most step bytes; call number fail_at fails (0: none).
typedef struct pieces {
    const char *text;
    size_t size, at, step;
    int calls, fail_at;
} pieces;

static size_t read_piece(void *user, void *bytes, size_t size)
{
    pieces *p = (pieces *)user;
    size_t n = p->size - p->at;
    if (++p->calls == p->fail_at) return (size_t)-1;
    if (n > p->step) n = p->step;
    if (n > size) n = size;
    if (n) memcpy(bytes, p->text + p->at, n);
    p->at += n;
    return n;
}

// Loads a text from memory, and in pieces of 1 and of 7 bytes; all must agree.
static subdiv_result load_bytes(subdiv_mesh *mesh, const char *text, size_t size,
                                subdiv_error *error)
{
    subdiv_options opt = {0};
    memset(error, 0, sizeof *error);
    opt.error = error;
    memset(mesh, 0x55, sizeof *mesh);
    subdiv_result result = subdiv_load_obj_memory(mesh, text, size, &opt);
    CHECK_EQUAL(error->code, result);
    if (result) CHECK(mesh_is_zero(mesh));
    for (size_t step = 1; step <= 7; step += 6) {
        pieces p = {text, size, 0, step, 0, 0};
        subdiv_mesh other;
        subdiv_error other_error = {0};
        memset(&other, 0x55, sizeof other);
        opt.error = &other_error;
        CHECK_EQUAL(subdiv_load_obj_callback(&other, read_piece, &p, &opt), result);
        CHECK(same_mesh(mesh, &other));
        CHECK_EQUAL(other_error.code, error->code);
        CHECK_EQUAL(other_error.line, error->line);
        CHECK_EQUAL(other_error.warning_count, error->warning_count);
        CHECK_TEXT(other_error.message, error->message);
        CHECK_TEXT(other_error.warning, error->warning);
        subdiv_mesh_free(&other);
    }
    return result;
}

static subdiv_result load(subdiv_mesh *mesh, const char *text, subdiv_error *error)
{
    return load_bytes(mesh, text, strlen(text), error);
}

// ------------------------------------------------------------------------------ forms of v and f

#define V4 "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
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
        {QUAD "l 1 2\np 1\nl 1/1 2/2\np 99\n", 1, "line 6: 4 points and lines"},
        {"vp 1 2\ncstype bspline\ndeg 3 3\n" V4 "curv 0 1 1 2\nsurf 0 1 0 1 9 9\nparm u 0 1\nend\n"
         "f 1 2 3 4\n", 1, "line 1: 7 free-form"},
        {V4 "vertex 1 2 3\ncall x.obj\nf 1 2 3 4\nfoo bar\nface 1 2\nlod 3\nbevel on\n", 1,
         "line 5: 6 statements with unknown"},
        {QUAD "V 1 2 3\nF 1 2 3\nT crease 2/1/0 0 1 2\ntrace_obj x\n", 1, "line 6: 4 statements"},
        {"foo \\\nv 9 9 9\n" QUAD "l 1 2\nend\nfoo # \\\nend", 3, "line 8: 1 points"},
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
        {V4 VT4 "f 1/1 2/2\nf 1/3 2/2 3/1\nf 4/1\n", 4, "2 1 0;", 2, "line 9: a face with 2"},
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

// Appends to a text that is large enough.
static void append(char *text, size_t *size, const char *piece)
{
    size_t n = strlen(piece);
    memcpy(text + *size, piece, n);
    *size += n;
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
            pieces p = {text, bad ? size : size - 11, 0, steps[k], 0, 0};
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

#define CAGE V4 "v 0 0 1\nf 1 2 3 4\nf 1 5 2\n"

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
    {V4 "f 1 2 \\\n 3\nf 1 2 9\n", SUBDIV_ERROR_INDEX, 7, {"9", "4"}},
    {V4 "f 1 \\\r\n2 \\\r\n9\r\n", SUBDIV_ERROR_INDEX, 5, {"9", "4"}},
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

static const char *scratch = "build/test_obj.scratch.obj";

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

// From a file, the message begins with its name and line.
static void test_refusals_of_a_file(void)
{
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
        subdiv_mesh mesh;
        subdiv_error error = {0};
        subdiv_options opt = {0};
        char place[128];
        opt.error = &error;
        test_context = refusals[i].text;
        CHECK(write_file(scratch, refusals[i].text, strlen(refusals[i].text)));
        memset(&mesh, 0x55, sizeof mesh);
        CHECK_EQUAL(subdiv_load_obj(&mesh, scratch, &opt), refusals[i].code);
        CHECK(mesh_is_zero(&mesh));
        subdiv_mesh_free(&mesh);
        check_message(&error, &refusals[i]);
        if (refusals[i].line) sprintf(place, "%s:%d: ", scratch, refusals[i].line);
        else sprintf(place, "%s: ", scratch);
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
    const struct { const char *text; size_t size; int line; } cases[] = {
        {nul_in_line, sizeof nul_in_line - 1, 2}, {nuls, sizeof nuls, 1},
        {in_comment, sizeof in_comment - 1, 2}, {at_end, sizeof at_end - 1, 2},
        {utf16, sizeof utf16 - 1, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        subdiv_mesh mesh;
        subdiv_error error;
        test_context = i == 0 ? "0 in a line" : i == 1 ? "all 0" : i == 2 ? "0 in a comment"
                     : i == 3 ? "0 at the end" : "UTF-16";
        CHECK_EQUAL(load_bytes(&mesh, cases[i].text, cases[i].size, &error), SUBDIV_ERROR_SYNTAX);
        CHECK_EQUAL(error.line, cases[i].line);
        CHECK(strstr(error.message, "not an OBJ file") != NULL);
        subdiv_mesh_free(&mesh);
    }
    test_context = "";
}

// ----------------------------------------------------------------------------- reading numbers

static float random_float(void)
{
    for (;;) {
        float f = from_bits(random_bits());
        if (f - f == 0) return f;     // finite
    }
}

// Numbers as text with the values that they must have, three to a line, checked when full.
enum { NUMBERS = 3 * 4096, NUMBER_LENGTH = 1024 };

static char  number_text[NUMBERS * NUMBER_LENGTH / 8];
static size_t number_size;
static float number_value[NUMBERS];
static int   number_count;

static void check_numbers(void)
{
    subdiv_mesh mesh = {0};
    for (; number_count % 3; number_count++) {
        append(number_text, &number_size, " 0");
        number_value[number_count] = 0;
    }
    CHECK_EQUAL(subdiv_load_obj_memory(&mesh, number_text, number_size, NULL), SUBDIV_OK);
    CHECK_EQUAL(mesh.vertex_count, number_count / 3);
    for (int i = 0; i < 3 * mesh.vertex_count; i++)
        if (to_bits(mesh.positions[i]) != to_bits(number_value[i]))
            TEST_REPORT("read %.9g (%08x), not %.9g (%08x)", (double)mesh.positions[i],
                        to_bits(mesh.positions[i]), (double)number_value[i],
                        to_bits(number_value[i]));
    subdiv_mesh_free(&mesh);
    number_count = 0;
    number_size = 0;
}

static void expect_number(const char *text, float value)
{
    append(number_text, &number_size, number_count % 3 ? " " : "\nv ");
    append(number_text, &number_size, text);
    number_value[number_count++] = value;
    if (number_count == NUMBERS || number_size > sizeof number_text - 8 * NUMBER_LENGTH)
        check_numbers();
}

// As strtof reads it; what is too large for a float is tested elsewhere.
static void expect_as_strtof(const char *text)
{
    float value = strtof(text, NULL);
    if (value - value == 0) expect_number(text, value);
}

static void test_read_random_numbers(void)
{
    char text[NUMBER_LENGTH];
    for (int i = 0; i < 100000; i++) {
        float f = random_float();
        snprintf(text, sizeof text, "%.9g", (double)f);
        expect_number(text, f);
        snprintf(text, sizeof text, "%.17g", (double)f);
        expect_number(text, f);
        double between = (double)f * (1 + (double)random_bits() * 0x1p-56);
        snprintf(text, sizeof text, "%.*e", (int)(random_bits() % 30), between);
        expect_as_strtof(text);
    }
    check_numbers();
}

// Digits without an exponent, as people and programs write them.
static void test_read_plain_numbers(void)
{
    char text[NUMBER_LENGTH];
    for (int i = 0; i < 50000; i++) {
        double x = ((double)random_bits() - 0x1p31) / (double)(1u << random_bits() % 32);
        snprintf(text, sizeof text, "%.*f", (int)(random_bits() % 25), x);
        expect_as_strtof(text);
        snprintf(text, sizeof text, "%u%u.%u%u", random_bits(), random_bits(), random_bits(),
                 random_bits());
        expect_as_strtof(text);
        snprintf(text, sizeof text, ".%0*u", (int)(random_bits() % 40), random_bits());
        expect_as_strtof(text);
        snprintf(text, sizeof text, "%ue%d", random_bits(), (int)(random_bits() % 90) - 60);
        expect_as_strtof(text);
    }
    check_numbers();
}

// Changes the digits of %e text (mantissa, then e) to a number a little nearer to zero.
static void lower(char *text)
{
    char *last = strchr(text, 'e') - 1;
    while (*last == '0' || *last == '.') last--;
    *last = (char)(*last - 1);
    for (char *p = last + 1; *p != 'e'; p++)
        if (*p == '0') *p = '9';
}

// Exactly between two neighbours a number goes to the even one; however late a digit decides, it
// decides. Both neighbours and the middle are exact in double.
static void test_read_halfway(void)
{
    char text[NUMBER_LENGTH], above[2 * NUMBER_LENGTH];
    for (int i = 0; i < 20000; i++) {
        unsigned bits = random_bits() & 0x7fffffffu;
        if (i % 8 == 0) bits &= 0x007fffffu;        // denormals
        if (i % 8 == 1) bits &= 0x7f800000u;        // powers of two
        if (bits >= 0x7f7fffffu) continue;
        float low = from_bits(bits), high = from_bits(bits + 1);
        double middle = ((double)low + (double)high) / 2;
        snprintf(text, sizeof text, "%.180e", middle);
        expect_number(text, bits % 2 ? high : low);
        snprintf(above, sizeof above, "%s%s", "-", text);
        expect_number(above, bits % 2 ? -high : -low);
        size_t mantissa = strcspn(text, "e");
        snprintf(above, sizeof above, "%.*s%0*d1%s", (int)mantissa, text,
                 (int)(1 + random_bits() % 100), 0, text + mantissa);
        expect_number(above, high);
        lower(text);
        expect_number(text, low);
    }
    check_numbers();
}

static void test_read_special_numbers(void)
{
    expect_number("7.038531e-26", from_bits(0x15ae43fdu));
    expect_number("3.4028235e38", FLT_MAX);
    expect_number("3.40282346638528859811704183484516925440e+38", FLT_MAX);
    expect_number("340282356779733661637539395458142568447", FLT_MAX);
    expect_number("-340282356779733661637539395458142568447.9999", -FLT_MAX);
    expect_number("1.17549435e-38", FLT_MIN);
    expect_number("1.1754942e-38", from_bits(0x007fffffu));
    expect_number("1e-45", from_bits(1));
    expect_number("1.4e-45", from_bits(1));
    expect_number("7.0064923216240854e-46", from_bits(1));
    expect_number("7.0064923216240853e-46", 0.0f);
    expect_number("7e-46", 0.0f);
    expect_number("1e-400", 0.0f);
    expect_number("-1e-400", -0.0f);
    expect_number("1e-99999999999999999999", 0.0f);
    expect_number("1e-18446744073709551617", 0.0f);
    expect_number("-0", -0.0f);
    expect_number("-0.0e5", -0.0f);
    expect_number("0e99999999999999999999", 0.0f);
    expect_number("16777217", 16777216.0f);
    expect_number("16777219", 16777220.0f);
    expect_number("16777217.000000000000000000000000001", 16777218.0f);
    expect_number("1e10", 1e10f);
    expect_number("1e11", 1e11f);
    expect_number("9007199254740993", 9007199254740992.0f);
    expect_number("18446744073709551616", 18446744073709551616.0f);
    expect_number("0.000000000000000000000000000000000000000000001e45", 1.0f);
    expect_number("1000000000000000000000000000000000000000000000e-45", 1.0f);
    check_numbers();
}

static void expect_long_number(char *text, size_t length, const char *ending, float value)
{
    subdiv_mesh mesh = {0};
    size_t size = 4 + length;
    memcpy(text, "v 0 ", 4);
    append(text, &size, ending);
    append(text, &size, " 7\n");
    CHECK_EQUAL(subdiv_load_obj_memory(&mesh, text, size, NULL), SUBDIV_OK);
    if (mesh.vertex_count == 1) {
        CHECK_EQUAL(to_bits(mesh.positions[1]), to_bits(value));
        CHECK(mesh.positions[2] == 7);
    }
    subdiv_mesh_free(&mesh);
}

static void test_read_100000_digits(void)
{
    enum { DIGITS = 100000 };
    char *text = (char *)malloc(DIGITS + 64), *number = text + 4;
    memset(number, '0', DIGITS);
    number[0] = '1';
    expect_long_number(text, DIGITS, "e-99999", 1.0f);
    number[0] = '0';
    number[1] = '.';
    expect_long_number(text, DIGITS - 1, "1e99998", 1.0f);
    expect_long_number(text, DIGITS, "", 0.0f);
    memset(number, '3', DIGITS);
    number[1] = '.';
    expect_long_number(text, DIGITS, "", 10.0f / 3);
    memset(number, '9', DIGITS);
    expect_long_number(text, DIGITS, "e-99962", 1e38f);
    // A 1 after so many zeros still lifts the number above the middle of two floats.
    memset(number, '0', DIGITS);
    memcpy(number, "16777217.", 9);
    expect_long_number(text, DIGITS, "1", 16777218.0f);
    expect_long_number(text, DIGITS, "0", 16777216.0f);
    free(text);
}

// ----------------------------------------------------------------------------- writing numbers

// Saves to memory that the caller frees.
static char *save_text(const subdiv_mesh *mesh, size_t *size, const subdiv_options *opt)
{
    CHECK_EQUAL(subdiv_save_obj_memory(mesh, NULL, 0, size, opt), SUBDIV_OK);
    char *text = (char *)malloc(*size + 1);
    size_t again = 0;
    CHECK_EQUAL(subdiv_save_obj_memory(mesh, text, *size, &again, opt), SUBDIV_OK);
    CHECK_EQUAL(again, *size);
    text[*size] = 0;
    return text;
}

// Digits of a number from the first to the last that is not 0.
static int count_digits(const char *text)
{
    int count = 0, significant = 0;
    for (; *text && *text != 'e' && *text != 'E'; text++) {
        if (*text < '0' || *text > '9') continue;
        if (*text != '0' || count) count++;
        if (*text != '0') significant = count;
    }
    return significant;
}

// Does a number with so many digits read back as f? Besides the nearest one, which can lie outside
// where the gap below f is half the gap above, its two neighbours.
static int digits_suffice(float f, int digits)
{
    char text[64], nearest[64];
    snprintf(nearest, sizeof nearest, "%.*e", digits - 1, fabs((double)f));
    long mantissa = 0;
    for (const char *p = nearest; *p != 'e'; p++)
        if (*p != '.') mantissa = 10 * mantissa + *p - '0';
    int exponent = atoi(strchr(nearest, 'e') + 1) - (digits - 1);
    for (long m = mantissa - 1; m <= mantissa + 1; m++) {
        snprintf(text, sizeof text, "%lde%d", m, exponent);
        if (strtof(text, NULL) == fabsf(f)) return 1;
    }
    return 0;
}

// Writes the numbers and takes the text apart again.
static void check_written(float *values, int count)
{
    subdiv_mesh mesh = {0}, back = {0};
    size_t size;
    mesh.vertex_count = count / 3;
    mesh.positions = values;
    char *text = save_text(&mesh, &size, NULL);
    CHECK_EQUAL(subdiv_load_obj_memory(&back, text, size, NULL), SUBDIV_OK);
    CHECK_EQUAL(back.vertex_count, mesh.vertex_count);
    int i = 0;
    for (char *token = strtok(text, " \n"); token; token = strtok(NULL, " \n")) {
        if (strcmp(token, "v") == 0) continue;
        if (i >= count) break;
        float f = values[i];
        if (to_bits(strtof(token, NULL)) != to_bits(f) || to_bits(back.positions[i]) != to_bits(f))
            TEST_REPORT("%.9g is written as %s", (double)f, token);
        int digits = count_digits(token);
        if (digits > 1 && digits_suffice(f, digits - 1))
            TEST_REPORT("%.9g is written as %s, but %d digits suffice", (double)f, token,
                        digits - 1);
        i++;
    }
    CHECK_EQUAL(i, count);
    subdiv_mesh_free(&back);
    free(text);
}

static void test_write_random_numbers(void)
{
    enum { COUNT = 3 * 20000 };
    float *values = (float *)malloc(COUNT * sizeof *values);
    for (int round = 0; round < 3; round++) {
        for (int i = 0; i < COUNT; i++) {
            values[i] = random_float();
            if (round == 1) values[i] = from_bits(random_bits() & 0x807fffffu);     // denormals
            if (round == 2) values[i] = (float)((int)random_bits() / 1000) / 1000;
        }
        check_written(values, COUNT);
    }
    free(values);
}

static void test_write_special_numbers(void)
{
    enum { COUNT = 3 * 1024 };
    static float values[COUNT];
    int n = 0;
    for (unsigned exponent = 0; exponent < 255; exponent++)         // powers of two, neighbours
        for (int k = -1; k <= 1; k++)
            if (exponent || k >= 0) values[n++] = from_bits((exponent << 23) + (unsigned)k);
    for (unsigned bits = 0; bits < 24; bits++) values[n++] = from_bits(1u << bits);
    for (int k = -45; k <= 38; k++) {
        char text[16];
        snprintf(text, sizeof text, "1e%d", k);
        values[n++] = strtof(text, NULL);
        values[n++] = -0.9f * strtof(text, NULL);
    }
    for (int k = 0; k <= 100; k++) values[n++] = (float)k / 10;
    values[n++] = FLT_MAX;
    values[n++] = -FLT_MAX;
    values[n++] = -0.0f;
    values[n++] = 16777216.0f;
    values[n++] = from_bits(0x15ae43fdu);
    CHECK(n <= COUNT - 3);
    check_written(values, n - n % 3 + 3);
}

static void test_write_indices(void)
{
    sdv_figures *figures = (sdv_figures *)malloc(sizeof *figures);
    sdv_make_figures(figures);
    for (unsigned i = 0; i < 300000; i++) {
        char text[64], expected[32];
        int number = i < 120000 ? (int)i : (int)(random_bits() >> (1 + i % 31));
        *sdv_write_index(figures, text, i == 299999 ? INT_MAX : number) = 0;
        snprintf(expected, sizeof expected, "%d", i == 299999 ? INT_MAX : number);
        CHECK_TEXT(text, expected);
    }
    free(figures);
}

// Every so many bit patterns: written, they are what strtof makes of the text, and what we read.
// OBJ_SWEEP=1 in the environment looks at all of them.
static void test_sweep(void)
{
    enum { COUNT = 3 * 100000 };
    const char *setting = getenv("OBJ_SWEEP");
    unsigned long long step = setting && atoi(setting) > 0 ? (unsigned)atoi(setting) : 2039;
    float *values = (float *)malloc(COUNT * sizeof *values);
    for (unsigned long long bits = 0; bits >> 32 == 0 && !test_bad;) {
        subdiv_mesh mesh = {0}, back;
        size_t size;
        int count = 0;
        for (; count < COUNT && bits >> 32 == 0; bits += step) {
            values[count] = from_bits((unsigned)bits);
            count += values[count] - values[count] == 0;            // finite
        }
        while (count % 3) values[count++] = 0;
        mesh.vertex_count = count / 3;
        mesh.positions = values;
        if (count == 0) break;
        char *text = save_text(&mesh, &size, NULL), *p = text;
        CHECK_EQUAL(subdiv_load_obj_memory(&back, text, size, NULL), SUBDIV_OK);
        for (int i = 0; i < count && back.vertex_count == count / 3; i++) {
            if (i % 3 == 0) p += strspn(p, "v\n");
            float f = strtof(p, &p);
            if (to_bits(f) != to_bits(values[i]) || to_bits(back.positions[i]) != to_bits(f))
                TEST_REPORT("%08x is written as %08x and read as %08x", to_bits(values[i]),
                            to_bits(f), to_bits(back.positions[i]));
        }
        subdiv_mesh_free(&back);
        free(text);
    }
    free(values);
}

// What a reader sees matters too: small numbers without an exponent, nothing superfluous.
static void test_write_short_texts(void)
{
    static float P[] = {0, 1, -1, 0.5f, 10, 0.1f, 1e20f, 100, -2.25f};
    subdiv_mesh mesh = {0};
    size_t size;
    mesh.vertex_count = 3;
    mesh.positions = P;
    char *text = save_text(&mesh, &size, NULL);
    CHECK(strstr(text, "v 0 1 -1\n") != NULL);
    CHECK(strstr(text, "v 0.5 10 0.1\n") != NULL || strstr(text, "v .5 10 .1\n") != NULL);
    CHECK(strstr(text, " 100 -2.25\n") != NULL);
    free(text);
}

// -------------------------------------------------------------------------------- round trips

static float  wavy_P[3 * 9];
static int    wavy_sizes[] = {4, 3, 3, 5, 3};
static int    wavy_F[] = {0,1,4,3, 1,2,4, 2,5,4, 3,4,7,8,6, 4,5,7};
static int    wavy_E[] = {0,1, 4,1, 3,4, 4,7};
static float  wavy_S[] = {0.1f, 2.7f, 9.75f, 10.0f};
static int    wavy_C[] = {0, 8, 4};
static float  wavy_CS[] = {1.3f, 10.0f, 0.7f};
static int    wavy_H[] = {1, 4};

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

// With and without UVs, colours, normals and statements, in all combinations.
static void test_round_trip_of_data(void)
{
    for (int set = 0; set < 16; set++) {
        subdiv_mesh mesh = wavy_mesh();
        if (set & 1) mesh.uv_count = 0;
        if (set & 2) mesh.colors = NULL;
        if (set & 4) mesh.statement_count = 0;
        if (set & 8) mesh.normals = mesh.positions;
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
    if (name == NULL) printf("test_obj: no locale with a decimal comma here, test skipped\n");
    char *comma_text = save_text(&mesh, &comma_size, NULL);
    CHECK_TEXT(comma_text, text);
    CHECK_EQUAL(subdiv_load_obj_memory(&back, text, size, NULL), SUBDIV_OK);
    CHECK(same_mesh(&mesh, &back));
    subdiv_mesh_free(&back);
    setlocale(LC_ALL, "C");
    free(comma_text);
    free(text);
}

// -------------------------------------------------------------------------- callbacks and files

static void test_failing_read(void)
{
    subdiv_options opt = {0};
    subdiv_error error = {0};
    opt.error = &error;
    for (int k = 1; k <= 40; k++) {
        pieces p = {CAGE, sizeof CAGE - 1, 0, 2, 0, k};
        subdiv_mesh mesh;
        memset(&mesh, 0x55, sizeof mesh);
        subdiv_result result = subdiv_load_obj_callback(&mesh, read_piece, &p, &opt);
        CHECK_EQUAL(p.calls >= k, result == SUBDIV_ERROR_IO);
        CHECK_EQUAL(error.code, result);
        if (result) CHECK(mesh_is_zero(&mesh));
        subdiv_mesh_free(&mesh);
    }
}

// Keeps what is written; call number fail_at keeps keep bytes less than it should.
typedef struct sink {
    char  *text;
    size_t size, capacity, keep;
    int    calls, fail_at;
} sink;

static size_t write_sink(void *user, const void *bytes, size_t size)
{
    sink *s = (sink *)user;
    if (++s->calls == s->fail_at) {
        errno = ENOSPC;
        return size - (s->keep < size ? s->keep : size);
    }
    if (size <= s->capacity - s->size) memcpy(s->text + s->size, bytes, size);
    s->size += size;
    return size;
}

static void test_failing_write(void)
{
    enum { COUNT = 30000 };
    static float P[3 * COUNT];
    subdiv_mesh mesh = {0};
    subdiv_error error = {0};
    subdiv_options opt = {0};
    size_t size;
    opt.error = &error;
    for (int i = 0; i < 3 * COUNT; i++) P[i] = random_float();
    mesh.vertex_count = COUNT;
    mesh.positions = P;
    char *text = save_text(&mesh, &size, NULL);

    sink all = {(char *)malloc(size), 0, size, 0, 0, 0};
    CHECK_EQUAL(subdiv_save_obj_callback(&mesh, write_sink, &all, &opt), SUBDIV_OK);
    CHECK_EQUAL(all.size, size);
    CHECK(all.size == size && memcmp(all.text, text, size) == 0);
    CHECK(all.calls >= 2);
    for (int k = 1; k <= all.calls; k++) {
        for (size_t keep = 1; keep < 1000000; keep *= 999) {        // one byte less, or everything
            sink s = {all.text, 0, size, keep, 0, k};
            CHECK_EQUAL(subdiv_save_obj_callback(&mesh, write_sink, &s, &opt), SUBDIV_ERROR_IO);
            CHECK_EQUAL(error.code, SUBDIV_ERROR_IO);
            CHECK(strstr(error.message, strerror(ENOSPC)) != NULL);
            CHECK_EQUAL(s.calls, k);
        }
    }
    free(all.text);
    free(text);
}

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
    CHECK_EQUAL(subdiv_load_obj(&back, "build", &opt), SUBDIV_ERROR_IO);    // a folder
    CHECK(strstr(error.message, "build") != NULL);
    CHECK_EQUAL(subdiv_save_obj(&mesh, "build", &opt), SUBDIV_ERROR_IO);
    CHECK_EQUAL(subdiv_save_obj(&mesh, "build/none/of/these.obj", &opt), SUBDIV_ERROR_IO);
    CHECK(strstr(error.message, "build/none/of/these.obj") != NULL);
    FILE *full = fopen("/dev/full", "wb");
    if (full) {
        fclose(full);
        CHECK_EQUAL(subdiv_save_obj(&mesh, "/dev/full", &opt), SUBDIV_ERROR_IO);
        CHECK(strstr(error.message, "/dev/full") != NULL);
        CHECK(strstr(error.message, strerror(ENOSPC)) != NULL);
    }
}

static void test_null_arguments(void)
{
    subdiv_mesh mesh = wavy_mesh(), out;
    subdiv_error error = {0};
    subdiv_options opt = {0};
    sink s = {NULL, 0, 0, 0, 0, 0};
    pieces p = {CAGE, sizeof CAGE - 1, 0, 9, 0, 0};
    size_t size = 0;
    char text[8];
    opt.error = &error;
#define REFUSED(call) do { error.code = SUBDIV_OK; CHECK_EQUAL(call, SUBDIV_ERROR_ARGUMENT); \
                           CHECK_EQUAL(error.code, SUBDIV_ERROR_ARGUMENT); } while (0)
    REFUSED(subdiv_load_obj_memory(NULL, CAGE, sizeof CAGE - 1, &opt));
    REFUSED(subdiv_load_obj_callback(NULL, read_piece, &p, &opt));
    REFUSED(subdiv_load_obj(NULL, scratch, &opt));
    memset(&out, 0x55, sizeof out);
    REFUSED(subdiv_load_obj_memory(&out, NULL, 5, &opt));
    CHECK(mesh_is_zero(&out));
    memset(&out, 0x55, sizeof out);
    REFUSED(subdiv_load_obj_callback(&out, NULL, &p, &opt));
    CHECK(mesh_is_zero(&out));
    memset(&out, 0x55, sizeof out);
    REFUSED(subdiv_load_obj(&out, NULL, &opt));
    CHECK(mesh_is_zero(&out));
    REFUSED(subdiv_save_obj_memory(NULL, text, sizeof text, &size, &opt));
    REFUSED(subdiv_save_obj_memory(&mesh, NULL, 8, &size, &opt));
    REFUSED(subdiv_save_obj_memory(&mesh, text, sizeof text, NULL, &opt));
    REFUSED(subdiv_save_obj_callback(NULL, write_sink, &s, &opt));
    REFUSED(subdiv_save_obj_callback(&mesh, NULL, &s, &opt));
    REFUSED(subdiv_save_obj(NULL, scratch, &opt));
    REFUSED(subdiv_save_obj(&mesh, NULL, &opt));
#undef REFUSED
    CHECK_EQUAL(subdiv_load_obj(NULL, NULL, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(s.calls + p.calls, 0);
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
    RUN(test_plain_quad);
    RUN(test_face_forms);
    RUN(test_vertex_forms);
    RUN(test_lines);
    RUN(test_other_keywords);
    RUN(test_faces_without_uvs);
    RUN(test_statements);
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
    RUN(test_read_random_numbers);
    RUN(test_read_plain_numbers);
    RUN(test_read_halfway);
    RUN(test_read_special_numbers);
    RUN(test_read_100000_digits);
    RUN(test_write_random_numbers);
    RUN(test_write_special_numbers);
    RUN(test_write_short_texts);
    RUN(test_write_indices);
    RUN(test_sweep);
    RUN(test_round_trip_of_every_rule);
    RUN(test_round_trip_of_one_face_size);
    RUN(test_round_trip_of_data);
    RUN(test_written_text);
    RUN(test_tags_only_when_needed);
    RUN(test_infinite_sharpness_is_written);
    RUN(test_locale_does_not_matter);
    RUN(test_failing_read);
    RUN(test_failing_write);
    RUN(test_small_buffer);
    RUN(test_files);
    RUN(test_null_arguments);
    RUN(test_long_faces_are_written);
    return test_end("test_obj");
}
