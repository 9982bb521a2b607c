// Creases from angles, smoothing groups and UV seams, against plain loops over all faces; and what
// happens to the lists that are there.
//
//     cc -I. tests/test_creases.c -o build/test_creases -lm && build/test_creases

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/same.h"
#include "lib/test.h"

// ------------------------------------------------------------------- the oracle: edges by hand

enum { MAX_EDGES = 4096 };

// An edge with two faces that run along it in opposite directions: face-vertex i of face f and
// face-vertex j of face g are its ends a and b, in this order and turned.
typedef struct pair {
    int a, b, f, i, g, j;
} pair;

typedef struct pairs {
    int  count;
    pair list[MAX_EDGES];
} pairs;

static int at(const subdiv_mesh *m, int f, int i)
{
    return face_vertices(m, f)[i % face_size(m, f)];
}

// All edges that have exactly two uses, by two faces, one each way; in the order of the faces.
static void find_pairs(const subdiv_mesh *m, pairs *p)
{
    p->count = 0;
    for (int f = 0; f < m->face_count; f++) {
        for (int i = 0; i < face_size(m, f); i++) {
            const int *v = m->face_vertices;
            int a = at(m, f, i), b = at(m, f, i + 1), uses = 0;
            pair found = {0};
            for (int g = 0; g < m->face_count; v += face_size(m, g++)) {
                for (int j = 0; j < face_size(m, g); j++) {
                    int c = v[j], d = v[(j + 1) % face_size(m, g)];
                    uses += (a == c && b == d) || (a == d && b == c);
                    if (a != d || b != c || g <= f) continue;
                    found.a = a, found.f = f, found.i = i;
                    found.b = b, found.g = g, found.j = j;
                }
            }
            if (uses == 2 && found.g > f && a != b && p->count < MAX_EDGES)
                p->list[p->count++] = found;
        }
    }
}

// 2 area times the normal: triangles from the mean of the vertices.
static double area_normal(const subdiv_mesh *m, int f, double n[3])
{
    int size = face_size(m, f);
    double o[3] = {0};
    for (int i = 0; i < size; i++)
        for (int k = 0; k < 3; k++) o[k] += m->positions[3 * at(m, f, i) + k] / (double)size;
    n[0] = n[1] = n[2] = 0;
    for (int i = 0; i < size; i++) {
        double p[3], q[3];
        for (int k = 0; k < 3; k++) {
            p[k] = m->positions[3 * at(m, f, i) + k] - o[k];
            q[k] = m->positions[3 * at(m, f, i + 1) + k] - o[k];
        }
        n[0] += p[1] * q[2] - p[2] * q[1];
        n[1] += p[2] * q[0] - p[0] * q[2];
        n[2] += p[0] * q[1] - p[1] * q[0];
    }
    return sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

static double degrees_between(const subdiv_mesh *m, int f, int g)
{
    double a[3], b[3], u = area_normal(m, f, a), v = area_normal(m, g, b);
    if (u < 1e-9 || v < 1e-9) return 0;
    double cosine = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / u / v;
    return acos(cosine > 1 ? 1 : cosine < -1 ? -1 : cosine) * 180 / 3.14159265358979323846;
}

static int sharp_angle(const subdiv_mesh *m, const pair *p, double degrees)
{
    return degrees_between(m, p->f, p->g) > degrees;
}

static int group_of(const subdiv_mesh *m, int f)
{
    int group = 0, value;
    for (int i = 0; i < m->statement_count && m->statement_faces[i] <= f; i++) {
        if (strcmp(m->statements[i], "s off") == 0) group = 0;
        else if (sscanf(m->statements[i], "s %d", &value) == 1) group = value;
    }
    return group;
}

static int sharp_group(const subdiv_mesh *m, const pair *p, double unused)
{
    int a = group_of(m, p->f);
    (void)unused;
    return a == 0 || a != group_of(m, p->g);
}

// The UV of a face-vertex as text, so that equal values are equal texts.
static void uv_text(const subdiv_mesh *m, int f, int i, char text[64])
{
    int k = (int)(face_vertices(m, f) - m->face_vertices) + i % face_size(m, f);
    int uv = m->face_uvs[k];
    if (uv < 0) strcpy(text, "none");
    else snprintf(text, 64, "%g %g", m->uvs[2 * uv], m->uvs[2 * uv + 1]);
}

static int sharp_seam(const subdiv_mesh *m, const pair *p, double unused)
{
    char a[64], b[64], c[64], d[64];
    (void)unused;
    uv_text(m, p->f, p->i, a);
    uv_text(m, p->g, p->j + 1, b);
    uv_text(m, p->f, p->i + 1, c);
    uv_text(m, p->g, p->j, d);
    return strcmp(a, b) != 0 || strcmp(c, d) != 0;
}

typedef int (*is_sharp)(const subdiv_mesh *m, const pair *p, double degrees);

static int listed(const subdiv_mesh *m, int a, int b)
{
    for (int i = m->crease_count - 1; i >= 0; i--) {
        const int *e = m->crease_vertices + 2 * i;
        if ((e[0] == a && e[1] == b) || (e[0] == b && e[1] == a)) return i;
    }
    return -1;
}

// Is after's list the one of before, raised where an edge is sharp, and the other sharp edges?
static void check_lists(const subdiv_mesh *before, const subdiv_mesh *after, is_sharp sharp,
                        double degrees, float sharpness)
{
    static pairs p;
    float raised[RANDOM_MAX_CREASES];
    int next = before->crease_count;
    find_pairs(before, &p);
    for (int i = 0; i < next; i++) raised[i] = before->crease_sharpness[i];
    for (int k = 0; k < p.count; k++) {
        if (!sharp(before, &p.list[k], degrees)) continue;
        int i = listed(before, p.list[k].a, p.list[k].b);
        if (i >= 0 && raised[i] < sharpness) raised[i] = sharpness;
        if (i >= 0) continue;
        CHECK(next < after->crease_count);
        if (next >= after->crease_count) return;
        CHECK_EQUAL(listed(after, p.list[k].a, p.list[k].b), next);
        CHECK(after->crease_sharpness[next] == sharpness);
        next++;
    }
    CHECK_EQUAL(after->crease_count, next);
    CHECK(same_bytes(after->crease_vertices, before->crease_vertices, 2 * before->crease_count,
                     sizeof(int)));
    CHECK(same_bytes(after->crease_sharpness, raised, before->crease_count, sizeof(float)));
}

// -------------------------------------------------------------------------------- random cages

typedef struct extras {               // what random cages do not have
    int   face_uvs[RANDOM_MAX_FACES * RANDOM_MAX_SIZE];
    float uvs[2 * 16];
    int   statement_faces[16];
    char *statements[16];
} extras;

static void add_extras(random_cage *c, extras *x)
{
    static const char *const texts[] = {"s 1", "s 2", "s 12", "s off", "usemtl s 1", "g s", "s 0"};
    subdiv_mesh *m = &c->mesh;
    // Few values under more indices; most face-vertices at a vertex agree.
    m->uv_count = 16;
    m->uvs = x->uvs;
    m->face_uvs = x->face_uvs;
    for (int i = 0; i < 32; i++) x->uvs[i] = (float)(i % 8 / 2) * 0.25f;
    for (int i = 0; i < face_vertex_count(m); i++) {
        x->face_uvs[i] = m->face_vertices[i] % 4 + 4 * random_below(c, 4);
        if (random_chance(c, 8)) x->face_uvs[i] = random_below(c, 17) - 1;
    }
    m->statement_faces = x->statement_faces;
    m->statements = x->statements;
    for (int f = 0; f <= m->face_count && m->statement_count < 16; f++) {
        while (random_chance(c, 30) && m->statement_count < 16) {
            x->statement_faces[m->statement_count] = f;
            x->statements[m->statement_count++] = (char *)(size_t)texts[random_below(c, 7)];
        }
    }
}

// How sharp edges are in the cage counts all: how often the question was answered each way.
static void count_answers(const subdiv_mesh *m, is_sharp sharp, double degrees, int answers[2])
{
    static pairs p;
    find_pairs(m, &p);
    for (int k = 0; k < p.count; k++) answers[sharp(m, &p.list[k], degrees) != 0]++;
}

// Is an edge so close to the angle that rounding may decide?
static int is_close(const subdiv_mesh *m, double degrees)
{
    static pairs p;
    find_pairs(m, &p);
    for (int k = 0; k < p.count; k++)
        if (fabs(degrees_between(m, p.list[k].f, p.list[k].g) - degrees) < 0.002) return 1;
    return 0;
}

static void test_random_cages(void)
{
    static extras x;
    int answers[3][2] = {{0}};
    for (unsigned seed = 0; seed < 400; seed++) {
        char name[32];
        snprintf(name, sizeof name, "seed %u", seed);
        test_context = name;
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        if (!c) return;
        memset(&x, 0, sizeof x);
        add_extras(c, &x);
        float degrees = random_real(c, 1, 179), sharpness = random_sharpness(c);
        subdiv_mesh before = c->mesh, mesh = before;
        subdiv_error error = {0};
        subdiv_options opt = {0};
        opt.error = &error;

        if (!is_close(&before, degrees)) {
            CHECK_EQUAL(subdiv_crease_by_angle(&mesh, degrees, sharpness, &opt), SUBDIV_OK);
            check_lists(&before, &mesh, sharp_angle, degrees, sharpness);
            count_answers(&before, sharp_angle, degrees, answers[0]);
            subdiv_mesh_free(&mesh);
            mesh = before;
        }
        CHECK_EQUAL(subdiv_crease_by_uv_seams(&mesh, sharpness, &opt), SUBDIV_OK);
        check_lists(&before, &mesh, sharp_seam, 0, sharpness);
        count_answers(&before, sharp_seam, 0, answers[1]);
        subdiv_mesh_free(&mesh);
        mesh = before;

        CHECK_EQUAL(error.warning_count, 0);
        CHECK_EQUAL(subdiv_crease_by_smoothing_groups(&mesh, sharpness, &opt), SUBDIV_OK);
        if (error.warning_count) {
            CHECK_EQUAL(mesh.crease_count, before.crease_count);
        } else {
            check_lists(&before, &mesh, sharp_group, 0, sharpness);
            count_answers(&before, sharp_group, 0, answers[2]);
        }
        subdiv_mesh_free(&mesh);
        random_cage_free(c);
    }
    for (int i = 0; i < 6; i++) CHECK(answers[i / 2][i % 2] > 1000);
}

// ------------------------------------------------------------------------------- known shapes

static int crease_count_at(const test_cage *c, float degrees)
{
    subdiv_mesh mesh = c->mesh;
    CHECK_EQUAL(subdiv_crease_by_angle(&mesh, degrees, SUBDIV_INFINITE, NULL), SUBDIV_OK);
    int count = mesh.crease_count;
    subdiv_mesh_free(&mesh);
    return count;
}

// A cube, moved by m (three rows), scaled and shifted.
static void build_cube(test_cage *c, const double m[9], double scale, double shift)
{
    static const int faces[6][4] = {
        {0,4,6,2}, {1,3,7,5}, {0,1,5,4}, {2,6,7,3}, {0,2,3,1}, {4,5,7,6}
    };
    cage_clear(c, SUBDIV_CATMULL_CLARK);
    for (int v = 0; v < 8; v++) {
        double p[3], x = v & 1 ? 1 : -1, y = v & 2 ? 1 : -1, z = v & 4 ? 1 : -1;
        for (int k = 0; k < 3; k++)
            p[k] = scale * (m[3 * k] * x + m[3 * k + 1] * y + m[3 * k + 2] * z) + shift;
        cage_vertex(c, p[0], p[1], p[2]);
    }
    for (int f = 0; f < 6; f++) cage_face(c, 4, faces[f]);
}

static void test_cube(void)
{
    static test_cage c;
    const double scales[] = {1, 1e-40, 1e-30, 1e30, 1e38};
    for (int turn = 0; turn < 100; turn++) {
        double a = turn * 0.7, b = turn * 0.31;
        const double m[9] = {cos(a), -sin(a) * cos(b), sin(a) * sin(b),
                             sin(a), cos(a) * cos(b), -cos(a) * sin(b), 0, sin(b), cos(b)};
        build_cube(&c, m, turn < 5 ? scales[turn] : 1, turn & 1 ? turn / 10 : 0);
        CHECK_EQUAL(crease_count_at(&c, 0), 12);
        CHECK_EQUAL(crease_count_at(&c, 30), 12);
        CHECK_EQUAL(crease_count_at(&c, 89.99f), 12);
        CHECK_EQUAL(crease_count_at(&c, 90), 0);
        CHECK_EQUAL(crease_count_at(&c, 91), 0);
        CHECK_EQUAL(crease_count_at(&c, 180), 0);
    }
}

// Two n-gons and n sides; its rims, by name: edges between the lower n and between the upper n.
static void test_cylinder(void)
{
    static test_cage c;
    for (int n = 5; n <= 16; n++) {
        build_prism(&c, n);
        float side = 360.0f / (float)n;
        CHECK_EQUAL(crease_count_at(&c, side - 0.1f), 3 * n);
        CHECK_EQUAL(crease_count_at(&c, side), 2 * n);
        CHECK_EQUAL(crease_count_at(&c, 89), 2 * n);
        CHECK_EQUAL(crease_count_at(&c, 91), 0);
        subdiv_mesh mesh = c.mesh;
        CHECK_EQUAL(subdiv_crease_by_angle(&mesh, 80, 2.5f, NULL), SUBDIV_OK);
        for (int i = 0; i < mesh.crease_count; i++) {
            const int *e = mesh.crease_vertices + 2 * i;
            double length = 0;
            for (int k = 0; k < 3; k++)
                length += pow(c.positions[3 * e[0] + k] - c.positions[3 * e[1] + k], 2);
            CHECK(c.positions[3 * e[0] + 2] == c.positions[3 * e[1] + 2]);
            CHECK_NEAR(sqrt(length), 2 * sin(3.14159265358979 / n), 1e-5);
            CHECK(mesh.crease_sharpness[i] == 2.5f);
        }
        subdiv_mesh_free(&mesh);
    }
}

// A flat grid, tilted, far from the origin: rounding alone makes no crease at 0.1 degrees. Folded
// by 10 degrees along its middle row, exactly that row is one.
static void test_sheet(void)
{
    static test_cage c;
    for (int fold = 0; fold < 2; fold++) {
        build_grid(&c, SUBDIV_CATMULL_CLARK, 6, 6);
        for (int v = 0; v < c.mesh.vertex_count; v++) {
            float *p = c.positions + 3 * v, y = p[1] - 3;
            p[2] = 0.3f * p[0];
            if (fold && y > 0) p[1] = 3 + y * (float)cos(0.1745), p[2] += y * (float)sin(0.1745);
            for (int k = 0; k < 3; k++) p[k] += 100;
        }
        CHECK_EQUAL(crease_count_at(&c, 0.1f), fold ? 6 : 0);
        CHECK_EQUAL(crease_count_at(&c, 180), 0);
    }
}

// A face whose vertices lie in a line, exactly or but for rounding, has no normal: no creases.
static void test_no_area(void)
{
    static test_cage c;
    const int left[] = {0, 1, 2, 3}, sliver[] = {1, 4, 2};
    cage_clear(&c, SUBDIV_CATMULL_CLARK);
    cage_vertex(&c, 10, 0, 0);
    cage_vertex(&c, 11, 0, 0);
    cage_vertex(&c, 11, 1, 0);
    cage_vertex(&c, 10, 1, 0);
    cage_vertex(&c, 11, 0.3, 0);
    cage_face(&c, 4, left);
    cage_face(&c, 3, sliver);
    CHECK_EQUAL(crease_count_at(&c, 1), 0);
    c.positions[3 * 4 + 2] = 2e-7f;
    CHECK_EQUAL(crease_count_at(&c, 1), 0);
    c.positions[3 * 4 + 2] = 1e-4f;                 // a thin wall, upright
    CHECK_EQUAL(crease_count_at(&c, 1), 1);
}

// What is rounding grows with the largest coordinate: far away a thin wall has no area, whichever
// axis leads there and whichever vertex the wall begins with.
static void test_no_area_far_away(void)
{
    static test_cage c;
    const int left[] = {0, 1, 2, 3};
    for (int i = 0; i < 12; i++) {
        const int axis = i / 3, first = i % 3, far = axis < 3;
        const int ring[] = {1, 4, 2, 1, 4}, *wall = ring + first;
        cage_clear(&c, SUBDIV_CATMULL_CLARK);
        cage_vertex(&c, 0, 0, 0);
        cage_vertex(&c, 1, 0, 0);
        cage_vertex(&c, 1, 1, 0);
        cage_vertex(&c, 0, 1, 0);
        cage_vertex(&c, 1, 0.25, 1.0 / 4096);
        cage_face(&c, 4, left);
        cage_face(&c, 3, wall);
        for (int v = 0; v < 5 && far; v++) c.positions[3 * v + axis] += 1024;
        CHECK_EQUAL(crease_count_at(&c, 1), !far);
    }
}

// Boundary and non-manifold edges are sharp anyway, also faces that are wound against each other.
static void test_sharp_by_shape(void)
{
    static test_cage c;
    build_fins(&c, SUBDIV_CATMULL_CLARK, 3, 1);
    CHECK_EQUAL(crease_count_at(&c, 0), 0);
    build_bow_tie(&c, SUBDIV_CATMULL_CLARK);
    CHECK_EQUAL(crease_count_at(&c, 0), 0);
    const int up[] = {0, 1, 2}, along[] = {0, 1, 3};
    cage_clear(&c, SUBDIV_CATMULL_CLARK);
    for (int v = 0; v < 4; v++) cage_vertex(&c, v, v * v, v * v * v);
    cage_face(&c, 3, up);
    cage_face(&c, 3, along);
    CHECK_EQUAL(crease_count_at(&c, 0), 0);
}

// ------------------------------------------------------------------------------ smoothing groups

// A strip of five quads. Its inner edges are 2-3, 4-5, 6-7, 8-9: bit i of the result is edge i.
static int strip_creases(const char *const *statements, const int *faces, int count, int *warnings)
{
    static test_cage c;
    cage_clear(&c, SUBDIV_CATMULL_CLARK);
    for (int v = 0; v < 12; v++) cage_vertex(&c, v / 2, v % 2, 0);
    for (int f = 0; f < 5; f++) cage_quad(&c, 2 * f, 2 * f + 2, 2 * f + 3, 2 * f + 1);
    char *texts[8];
    int before[8], bits = 0;
    for (int i = 0; i < count; i++) texts[i] = (char *)(size_t)statements[i], before[i] = faces[i];
    subdiv_mesh mesh = c.mesh;
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    mesh.statement_count = count;
    mesh.statements = texts;
    mesh.statement_faces = before;
    CHECK_EQUAL(subdiv_crease_by_smoothing_groups(&mesh, 3, &opt), SUBDIV_OK);
    for (int i = 0; i < mesh.crease_count; i++) {
        const int *e = mesh.crease_vertices + 2 * i;
        int low = e[0] < e[1] ? e[0] : e[1];
        CHECK(mesh.crease_sharpness[i] == 3);
        CHECK(low % 2 == 0 && low > 0 && low < 10 && e[0] + e[1] == 2 * low + 1);
        bits |= 1 << (low / 2 - 1);
    }
    subdiv_mesh_free(&mesh);
    *warnings = error.warning_count;
    return bits;
}

static void test_smoothing_groups(void)
{
    static const struct {
        const char *statements[8];
        int faces[8], count, creases, warnings;
    } cases[] = {
        {{"s 1"}, {0}, 1, 0, 0},                                    // one smooth surface
        {{"s off"}, {0}, 1, 15, 0},                                 // flat
        {{"s 0"}, {0}, 1, 15, 0},
        {{"s null"}, {0}, 1, 15, 0},
        {{"s"}, {0}, 1, 15, 0},
        {{0}, {0}, 0, 0, 1},                                        // nothing said
        {{"usemtl s 1", "g s", "o off", "mtllib s 1"}, {0, 0, 2, 3}, 4, 0, 1},
        {{"s 1", "s 2"}, {0, 2}, 2, 2, 0},                          // a step between faces 1 and 2
        {{"s 1", "s 2", "s 1"}, {0, 2, 3}, 3, 2 | 4, 0},
        {{"s 1"}, {2}, 1, 1 | 2, 0},                                // before: none
        {{"s 1", "s off"}, {0, 4}, 2, 8, 0},
        {{"s 1", "s 2", "s 3"}, {1, 1, 1}, 3, 1, 0},                // the last one counts
        {{"s 01", "s 1 ", "s\t1", "s  1"}, {0, 1, 2, 3}, 4, 0, 0},  // the same group
        {{"s 1", "s 11", "s 10", "s 1x", "s 4294967297"}, {0, 1, 2, 3, 4}, 5, 15, 0},
        {{"s 1", "g left", "usemtl stone", "s 1"}, {0, 1, 2, 3}, 4, 0, 0},
        {{"s 1", "s 2"}, {0, 5}, 2, 0, 0},                          // behind the last face
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char name[32];
        int warnings;
        snprintf(name, sizeof name, "case %d", (int)i);
        test_context = name;
        CHECK_EQUAL(strip_creases(cases[i].statements, cases[i].faces, cases[i].count, &warnings),
                    cases[i].creases);
        CHECK_EQUAL(warnings, cases[i].warnings);
    }
}

// --------------------------------------------------------------------------------------- UV seams

// A cube whose sides unfold to a cross: faces in the order of build_cube share UVs along the five
// edges at which the cross holds together; the other seven are seams.
static void test_unfolded_cube(void)
{
    static test_cage c;
    static const double one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    // Of each face, the cells of the cross: the corner of the square on which each vertex lies.
    static const int cross[6][4][2] = {
        {{0,1}, {1,1}, {1,2}, {0,2}}, {{3,1}, {3,2}, {2,2}, {2,1}}, {{1,0}, {2,0}, {2,1}, {1,1}},
        {{1,3}, {1,2}, {2,2}, {2,3}}, {{4,1}, {4,2}, {3,2}, {3,1}}, {{1,1}, {2,1}, {2,2}, {1,2}}
    };
    int face_uvs[24];
    float uvs[2 * 25];
    build_cube(&c, one, 1, 0);
    for (int i = 0; i < 25; i++) uvs[2 * i] = (float)(i / 5), uvs[2 * i + 1] = (float)(i % 5);
    for (int f = 0; f < 6; f++)
        for (int i = 0; i < 4; i++) face_uvs[4 * f + i] = 5 * cross[f][i][0] + cross[f][i][1];
    subdiv_mesh mesh = c.mesh;
    mesh.uv_count = 25;
    mesh.uvs = uvs;
    mesh.face_uvs = face_uvs;
    CHECK_EQUAL(subdiv_crease_by_uv_seams(&mesh, 1, NULL), SUBDIV_OK);
    CHECK_EQUAL(mesh.crease_count, 7);
    CHECK_EQUAL(listed(&mesh, 4, 5), -1);           // between the middle of the cross and below
    CHECK_EQUAL(listed(&mesh, 5, 7), -1);
    CHECK(listed(&mesh, 0, 1) >= 0);
    subdiv_mesh_free(&mesh);
}

// Two quads at edge 1-2: a difference at either end makes a seam, an index of its own does not.
static void test_seam_values(void)
{
    static test_cage c;
    static const struct { int uvs[8], creases; } cases[] = {
        {{0,1,2,3, 1,4,5,2}, 0}, {{0,1,2,3, 6,4,5,7}, 0}, {{0,1,2,3, 1,4,5,8}, 1},
        {{0,1,2,3, 8,4,5,2}, 1}, {{0,1,2,3, -1,-1,-1,-1}, 1}, {{0,1,2,3, 1,4,5,-1}, 1},
        {{-1,-1,-1,-1, -1,-1,-1,-1}, 0}, {{-1,1,2,3, 1,-1,-1,2}, 0}, {{0,-1,2,3, 1,4,5,2}, 1}
    };
    float uvs[2 * 9] = {0,0, 1,0, 1,1, 0,1, 2,0, 2,1, 1,-0.0f, 1,1, 1,0.99f};
    cage_clear(&c, SUBDIV_CATMULL_CLARK);
    for (int v = 0; v < 6; v++) cage_vertex(&c, v, v % 2, 0);
    cage_quad(&c, 0, 1, 2, 3);
    cage_quad(&c, 1, 4, 5, 2);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int face_uvs[8];
        subdiv_mesh mesh = c.mesh;
        memcpy(face_uvs, cases[i].uvs, sizeof face_uvs);
        mesh.uv_count = 9;
        mesh.uvs = uvs;
        mesh.face_uvs = face_uvs;
        CHECK_EQUAL(subdiv_crease_by_uv_seams(&mesh, 1, NULL), SUBDIV_OK);
        CHECK_EQUAL(mesh.crease_count, cases[i].creases);
        subdiv_mesh_free(&mesh);
    }
    subdiv_mesh mesh = c.mesh;
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    CHECK_EQUAL(subdiv_crease_by_uv_seams(&mesh, 1, &opt), SUBDIV_OK);
    CHECK_EQUAL(error.warning_count, 1);
    CHECK(mesh.memory == NULL && mesh.crease_count == 0);
}

// ---------------------------------------------------------------------------- the list, and errors

static const double straight[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

// What is listed stays where it is, the larger sharpness wins, of two entries the later counts.
static void test_existing_creases(void)
{
    static test_cage c;
    build_cube(&c, straight, 1, 0);
    const int E[] = {0,1, 0,7, 1,0, 2,3, 6,4, 5,5};
    const float S[] = {1, 4, 2, 9, -3, 1};
    for (int i = 0; i < 6; i++) cage_crease(&c, E[2 * i], E[2 * i + 1], S[i]);
    subdiv_mesh mesh = c.mesh;
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    CHECK_EQUAL(subdiv_crease_by_angle(&mesh, 30, 5, &opt), SUBDIV_OK);
    CHECK_EQUAL(error.warning_count, 0);            // refinement tells of creases without an edge
    CHECK_EQUAL(mesh.crease_count, 6 + 9);
    CHECK(memcmp(mesh.crease_vertices, E, sizeof E) == 0);
    const float raised[] = {1, 4, 5, 9, 5, 1};
    CHECK(memcmp(mesh.crease_sharpness, raised, sizeof raised) == 0);
    CHECK(memcmp(c.crease_vertices, E, sizeof E) == 0);
    CHECK(memcmp(c.crease_sharpness, S, sizeof S) == 0);

    // Again: nothing new but the sharpness; lists may follow one another, one free does for all.
    CHECK_EQUAL(subdiv_crease_by_angle(&mesh, 30, 7, &opt), SUBDIV_OK);
    CHECK_EQUAL(mesh.crease_count, 6 + 9);
    CHECK(crease_sharpness(&mesh, 4, 5) == 7 && crease_sharpness(&mesh, 2, 3) == 9);
    CHECK_EQUAL(subdiv_crease_by_angle(&mesh, 30, SUBDIV_INFINITE, &opt), SUBDIV_OK);
    CHECK(crease_sharpness(&mesh, 2, 3) == SUBDIV_INFINITE);
    subdiv_mesh_free(&mesh);
    CHECK(mesh_is_zero(&mesh));
}

// A mesh of the library's own gets its list beside its block, and its copy one of its own.
static void test_owners(void)
{
    static test_cage c;
    subdiv_mesh fine, by_hand, refined, expected;
    build_cube(&c, straight, 1, 0);
    CHECK_EQUAL(subdiv_refine(&fine, &c.mesh, 0, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_crease_by_angle(&fine, 30, 2.5f, NULL), SUBDIV_OK);
    for (int degrees = 80; degrees < 100; degrees += 5) {
        subdiv_mesh copy = fine;
        copy.memory = NULL;
        copy.crease_count = 0;
        CHECK_EQUAL(subdiv_crease_by_angle(&copy, (float)degrees, 1, NULL), SUBDIV_OK);
        CHECK_EQUAL(copy.crease_count, degrees < 90 ? 12 : 0);
        subdiv_mesh_free(&copy);
    }
    for (int i = 0; i < fine.crease_count; i++)
        cage_crease(&c, fine.crease_vertices[2 * i + 1], fine.crease_vertices[2 * i], 2.5);
    by_hand = c.mesh;
    CHECK_EQUAL(by_hand.crease_count, 12);
    CHECK_EQUAL(subdiv_refine(&refined, &fine, 3, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refine(&expected, &by_hand, 3, NULL), SUBDIV_OK);
    CHECK(same_mesh(&refined, &expected));
    subdiv_mesh_free(&refined);
    subdiv_mesh_free(&expected);
    subdiv_mesh_free(&fine);
}

static subdiv_mesh good_mesh;         // for the errors: each case breaks one thing
static test_cage   good_cage;
static int         good_uvs[24], good_faces[2];
static float       uv_values[2];
static char       *good_texts[2];

static void make_good_mesh(void)
{
    static char one[] = "s 1", two[] = "s 2";
    build_cube(&good_cage, straight, 1, 0);
    good_mesh = good_cage.mesh;
    memset(good_uvs, 0, sizeof good_uvs);
    good_faces[0] = 1, good_faces[1] = 4;
    good_texts[0] = one, good_texts[1] = two;
    good_mesh.uv_count = 1, good_mesh.uvs = uv_values, good_mesh.face_uvs = good_uvs;
    good_mesh.statement_count = 2, good_mesh.statements = good_texts;
    good_mesh.statement_faces = good_faces;
}

enum { BY_ANGLE = 1, BY_GROUPS = 2, BY_SEAMS = 4, BY_ALL = 7 };

// The functions named have to fail with the code and leave the mesh alone; the others to work.
static void check_fails(int functions, subdiv_result code, float degrees, float sharpness)
{
    for (int i = 0; i < 3; i++) {
        subdiv_error error = {0};
        subdiv_options opt = {0};
        subdiv_mesh mesh = good_mesh;
        opt.error = &error;
        subdiv_result result = i == 0 ? subdiv_crease_by_angle(&mesh, degrees, sharpness, &opt)
                             : i == 1 ? subdiv_crease_by_smoothing_groups(&mesh, sharpness, &opt)
                                      : subdiv_crease_by_uv_seams(&mesh, sharpness, &opt);
        CHECK_EQUAL(result, functions >> i & 1 ? code : SUBDIV_OK);
        CHECK_EQUAL(error.code, result);
        CHECK_EQUAL(error.message[0] != 0, result != SUBDIV_OK);
        if (result) CHECK(memcmp(&mesh, &good_mesh, sizeof mesh) == 0);
        else subdiv_mesh_free(&mesh);
    }
    make_good_mesh();
}

static void test_errors(void)
{
    const float nan = (float)NAN;
    CHECK_EQUAL(subdiv_crease_by_angle(NULL, 30, 1, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_crease_by_smoothing_groups(NULL, 1, NULL), SUBDIV_ERROR_ARGUMENT);
    CHECK_EQUAL(subdiv_crease_by_uv_seams(NULL, 1, NULL), SUBDIV_ERROR_ARGUMENT);
    make_good_mesh();
    check_fails(0, SUBDIV_OK, 30, 1);
    check_fails(0, SUBDIV_OK, 0, HUGE_VALF);
    check_fails(0, SUBDIV_OK, 180, -1);
    check_fails(BY_ANGLE, SUBDIV_ERROR_ARGUMENT, -1, 1);
    check_fails(BY_ANGLE, SUBDIV_ERROR_ARGUMENT, 180.1f, 1);
    check_fails(BY_ANGLE, SUBDIV_ERROR_ARGUMENT, nan, 1);
    check_fails(BY_ALL, SUBDIV_ERROR_NOT_FINITE, 30, nan);
    good_mesh.vertex_count = 0;
    check_fails(BY_ALL, SUBDIV_ERROR_EMPTY, 30, 1);
    good_cage.face_vertices[7] = 8;
    check_fails(BY_ALL, SUBDIV_ERROR_INDEX, 30, 1);
    good_cage.face_sizes[2] = 2;
    check_fails(BY_ALL, SUBDIV_ERROR_FACE, 30, 1);
    good_cage.positions[4] = nan;
    check_fails(BY_ANGLE, SUBDIV_ERROR_NOT_FINITE, 30, 1);
    good_mesh.positions = NULL;
    check_fails(BY_ANGLE, SUBDIV_ERROR_ARGUMENT, 30, 1);
    good_mesh.statement_count = -1;
    check_fails(BY_ALL, SUBDIV_ERROR_ARGUMENT, 30, 1);
    good_mesh.statements = NULL;
    check_fails(BY_ALL, SUBDIV_ERROR_ARGUMENT, 30, 1);
    good_mesh.statement_faces = NULL;
    check_fails(BY_ALL, SUBDIV_ERROR_ARGUMENT, 30, 1);
    good_texts[1] = NULL;
    check_fails(BY_ALL, SUBDIV_ERROR_ARGUMENT, 30, 1);
    good_faces[0] = 5;
    check_fails(BY_ALL, SUBDIV_ERROR_INDEX, 30, 1);
    good_faces[1] = 7;
    check_fails(BY_ALL, SUBDIV_ERROR_INDEX, 30, 1);
    good_faces[0] = -1;
    check_fails(BY_ALL, SUBDIV_ERROR_INDEX, 30, 1);
    good_mesh.uv_count = -1;
    check_fails(BY_ALL, SUBDIV_ERROR_ARGUMENT, 30, 1);
    good_mesh.uvs = NULL;
    check_fails(BY_ALL, SUBDIV_ERROR_ARGUMENT, 30, 1);
    good_mesh.face_uvs = NULL;
    check_fails(BY_ALL, SUBDIV_ERROR_ARGUMENT, 30, 1);
    good_uvs[23] = 1;
    check_fails(BY_ALL, SUBDIV_ERROR_INDEX, 30, 1);
    good_uvs[0] = -2;
    check_fails(BY_ALL, SUBDIV_ERROR_INDEX, 30, 1);
}

// Vertices alone, with UVs that no face uses.
static void test_no_faces(void)
{
    make_good_mesh();
    good_mesh.face_count = good_mesh.statement_count = 0;
    good_mesh.face_uvs = NULL;
    check_fails(0, SUBDIV_OK, 30, 1);
}

int main(void)
{
    RUN(test_random_cages);
    RUN(test_cube);
    RUN(test_cylinder);
    RUN(test_sheet);
    RUN(test_no_area);
    RUN(test_no_area_far_away);
    RUN(test_sharp_by_shape);
    RUN(test_smoothing_groups);
    RUN(test_unfolded_cube);
    RUN(test_seam_values);
    RUN(test_existing_creases);
    RUN(test_owners);
    RUN(test_errors);
    RUN(test_no_faces);
    return test_end("test_creases");
}
