// Face-varying values: the rules one by one, seams that fade, and the other doors. Random cages with
// UVs are compared with the slow reference by tests/fuzz/differential.c.
//
//     cc -I. tests/test_uv.c -o build/test_uv -lm && build/test_uv
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/same.h"
#include "lib/test.h"

enum { RULES = 6 };

// ----------------------------------------------------------------------------------- the cages

// Checks so many random cages that have UVs, each by every rule.
static void for_cages(unsigned count, int features, void (*check)(subdiv_mesh *, unsigned))
{
    static char context[64];
    int seen = 0;
    test_context = context;
    for (unsigned seed = 1; seed <= count; seed++) {
        random_cage *c = random_cage_new(seed, features);
        if (!c) abort();
        for (int rule = 0; rule < RULES && c->mesh.uv_count; rule++, seen++) {
            sprintf(context, "random cage %u, rule %d", seed, rule);
            c->mesh.uv_rule = (subdiv_uv_rule)rule;
            check(&c->mesh, seed);
        }
        random_cage_free(c);
    }
    CHECK(seen > 0);
}

static subdiv_options keep_holes(void)
{
    subdiv_options opt = {0};
    opt.keep_holes = 1;
    return opt;
}

// Refines with holes kept, so that the result has all its faces.
static int refine(subdiv_mesh *fine, const subdiv_mesh *m, int levels)
{
    subdiv_options opt = keep_holes();
    CHECK_EQUAL(subdiv_refine(fine, m, levels, &opt), SUBDIV_OK);
    return fine->vertex_count > 0;
}

static void *array(int count, size_t size)
{
    void *made = calloc((size_t)count + 1, size);
    if (!made) abort();
    return made;
}

// The value of a face-vertex in one direction.
static double uv_at(const subdiv_mesh *m, int h, int d)
{
    return (double)m->uvs[2 * m->face_uvs[h] + d];
}

// Takes the values of some faces away.
static void drop_values(subdiv_mesh *m, unsigned seed)
{
    for (int f = (int)(seed % 4); f < m->face_count; f += 5)
        for (int i = 0; i < face_size(m, f); i++)
            m->face_uvs[face_vertices(m, f) - m->face_vertices + i] = -1;
}

// -------------------------------------------------------------------------------- what must hold

// The face-vertex of a cage face's fine faces whose position is nearest.
static int find_nearest(const subdiv_mesh *fine, int cage_face, const float *p)
{
    int best = 0;
    double least = 1e30;
    for (int f = 0; f < fine->face_count; f++) {
        if (fine->cage_faces[f] != cage_face) continue;
        for (int h = f * fine->face_size; h < (f + 1) * fine->face_size; h++) {
            const float *q = fine->positions + 3 * fine->face_vertices[h];
            double x = (double)(p[0] - q[0]), y = (double)(p[1] - q[1]), z = (double)(p[2] - q[2]);
            if (x * x + y * y + z * z >= least) continue;
            least = x * x + y * y + z * z;
            best = h;
        }
    }
    CHECK(least < 1e-8);
    return best;
}

// Refining by 2 is refining by 1 twice: in each face of the cage the same UVs at the same points.
static void check_steps(subdiv_mesh *m, unsigned seed)
{
    int count = face_vertex_count(m), *kept = NULL;
    subdiv_mesh once = {0}, half = {0}, twice = {0};
    if (seed % 4 == 0) {
        kept = array(count, sizeof(int));
        memcpy(kept, m->face_uvs, sizeof(int) * (size_t)count);
        drop_values(m, seed);
    }
    if (refine(&once, m, 2) && refine(&half, m, 1) && refine(&twice, &half, 1)) {
        CHECK_EQUAL(once.face_count, twice.face_count);
        for (int h = 0; h < face_vertex_count(&twice); h++) {
            int f = half.cage_faces[twice.cage_faces[h / twice.face_size]];
            int g = find_nearest(&once, f, twice.positions + 3 * twice.face_vertices[h]);
            CHECK_EQUAL(once.face_uvs[g] < 0, twice.face_uvs[h] < 0);
            for (int d = 0; d < 2 && once.face_uvs[g] >= 0 && twice.face_uvs[h] >= 0; d++)
                CHECK_NEAR(uv_at(&twice, h, d), uv_at(&once, g, d), 1e-5);
        }
    }
    subdiv_mesh_free(&once);
    subdiv_mesh_free(&half);
    subdiv_mesh_free(&twice);
    if (kept) memcpy(m->face_uvs, kept, sizeof(int) * (size_t)count);
    free(kept);
}

static void test_steps(void)
{
    for_cages(150, RANDOM_MANIFOLD | RANDOM_UVS, check_steps);
}

// -------------------------------------------------------------------------------- rule by rule

enum {
    PLUS1 = 1 << SUBDIV_UV_CORNERS_PLUS1, PLUS2 = 1 << SUBDIV_UV_CORNERS_PLUS2,
    STRAIGHT = 1 << SUBDIV_UV_BOUNDARIES | 1 << SUBDIV_UV_ALL,
    BY_ALL = (1 << RULES) - 1, BY_ALL_BUT_NONE = BY_ALL - (1 << SUBDIV_UV_NONE)
};

// The values around vertex 4 of four quads: each either stays where it is, or moves along the curve
// of the seam.
static void test_rules(void)
{
    static const struct {
        const char *name;
        int groups[4];                      // of the faces: each has values of its own
        int dart, crease;                   // a seam from vertex 3 to 4 alone; a crease 1-4
        int value, ends[2], stays;          // stays: the rules by which it does
    } cases[] = {
        {"two and two", {0, 0, 1, 1}, 0, 0, 4, {3, 5}, STRAIGHT},
        {"two, one, one", {0, 0, 1, 2}, 0, 0, 4, {3, 5}, PLUS1 | PLUS2 | STRAIGHT},
        {"one of three", {0, 0, 1, 2}, 0, 0, 13, {12, 16}, BY_ALL_BUT_NONE},
        {"one of one and three", {0, 1, 1, 1}, 0, 0, 4, {1, 3}, BY_ALL_BUT_NONE},
        {"three of one and three", {0, 1, 1, 1}, 0, 0, 13, {10, 12}, PLUS2 | STRAIGHT},
        {"with a crease", {0, 0, 1, 1}, 0, 1, 4, {3, 5}, BY_ALL},
        {"beside a crease", {0, 0, 1, 1}, 0, 1, 13, {12, 14}, PLUS1 | PLUS2 | STRAIGHT},
        {"dart", {0, 0, 0, 0}, 1, 0, 4, {3, 12}, PLUS2 | STRAIGHT},
    };
    static test_cage c;
    float uvs[2 * 27];
    int face_uvs[16];
    for (int i = 0; i < 54; i++) uvs[i] = (float)((i * 37 + i * i * 11) % 101) / 101;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const int *ends = cases[i].ends;
        build_grid(&c, SUBDIV_CATMULL_CLARK, 2, 2);
        if (cases[i].crease) cage_crease(&c, 1, 4, SUBDIV_INFINITE);
        for (int h = 0; h < 16; h++)
            face_uvs[h] = c.face_vertices[h] + 9 * cases[i].groups[h / 4];
        if (cases[i].dart) face_uvs[8] = 12;        // vertex 3 of face 2
        c.mesh.uv_count = 27;
        c.mesh.uvs = uvs;
        c.mesh.face_uvs = face_uvs;
        for (int rule = 0; rule < RULES; rule++) {
            subdiv_mesh fine = {0};
            char name[64];
            sprintf(name, "%s, rule %d", cases[i].name, rule);
            test_context = name;
            c.mesh.uv_rule = (subdiv_uv_rule)rule;
            if (!refine(&fine, &c.mesh, 1)) return;
            for (int d = 0; d < 2; d++) {
                double own = (double)uvs[2 * cases[i].value + d];
                double both = (double)uvs[2 * ends[0] + d] + (double)uvs[2 * ends[1] + d];
                double curve = 0.75 * own + 0.125 * both;
                CHECK_NEAR(fine.uvs[2 * cases[i].value + d],
                           cases[i].stays >> rule & 1 ? own : curve, 1e-6);
            }
            subdiv_mesh_free(&fine);
        }
    }
    test_context = "";
}

// ------------------------------------------------------------------------------- seams that fade

typedef struct split_cage {
    test_cage cage;
    float uvs[36];
    int   face_uvs[16];
} split_cage;

// Four quads with a seam from left to right; the edge between the upper two is semi-sharp.
//
//      6---7---8       values 9 more than the vertices
//      |   s   |
//      3===4===5       below: values as the vertices
//      |   |   |
//      0---1---2
//
static void build_split(split_cage *c, double sharpness, double seam)
{
    build_grid(&c->cage, SUBDIV_CATMULL_CLARK, 2, 2);
    cage_crease(&c->cage, 4, 7, sharpness);
    cage_crease(&c->cage, 3, 4, seam);
    for (int i = 0; i < 18; i++) {
        c->uvs[2 * i] = (float)(i % 3 + 0.1 * (i % 5));
        c->uvs[2 * i + 1] = (float)(i / 3 + 0.1 * (i % 7));
    }
    for (int h = 0; h < 16; h++)
        c->face_uvs[h] = c->cage.face_vertices[h] + (h < 8 ? 0 : 9);
    c->cage.mesh.uv_count = 18;
    c->cage.mesh.uvs = c->uvs;
    c->cage.mesh.face_uvs = c->face_uvs;
}

// Half of the sharpness is gone: the value is a blend, half corner and half crease.
static double half_faded(const subdiv_mesh *m, int value, int d)
{
    return 0.875 * (double)m->uvs[2 * value + d] +
           0.0625 * ((double)m->uvs[2 * value - 2 + d] + (double)m->uvs[2 * value + 2 + d]);
}

// The upper value of vertex 4 is sharp by the crease, the lower one along with it by "plus 1". It
// fades as the upper one does, but while the seam is semi-sharp it waits until that has.
static void test_sharp_along(void)
{
    static const float seams[] = {0, 0.75f, 1, 1.25f, 5, SUBDIV_INFINITE};
    static split_cage c;
    for (int rule = SUBDIV_UV_CORNERS_PLUS1; rule <= SUBDIV_UV_CORNERS_PLUS2; rule++) {
        for (int i = 0; i < 6; i++) {
            subdiv_mesh fine = {0}, finer = {0};
            build_split(&c, 0.5, (double)seams[i]);
            c.cage.mesh.uv_rule = (subdiv_uv_rule)rule;
            if (!refine(&fine, &c.cage.mesh, 1) || !refine(&finer, &c.cage.mesh, 2)) return;
            for (int d = 0; d < 2; d++) {
                double moved = half_faded(&c.cage.mesh, 4, d), own = (double)c.uvs[8 + d];
                double below = seams[i] > 1 && seams[i] < SUBDIV_INFINITE ? own : moved;
                CHECK_NEAR(fine.uvs[26 + d], half_faded(&c.cage.mesh, 13, d), 1e-6);
                CHECK_NEAR(fine.uvs[8 + d], below, 1e-6);
                double ends = ((double)c.uvs[6 + d] + (double)c.uvs[10 + d]) / 2 + own;
                CHECK_NEAR(finer.uvs[8 + d], 0.75 * below + 0.125 * ends, 1e-6);
            }
            subdiv_mesh_free(&fine);
            subdiv_mesh_free(&finer);
        }
    }
}

// And as long as the crease stays, also where it makes the upper faces closed forms at once.
static void test_sharp_along_patches(void)
{
    static split_cage c;
    for (int i = 1; i < 24; i++) {
        build_split(&c, 0.25 * i, i % 3);
        c.cage.mesh.uv_rule = SUBDIV_UV_CORNERS_PLUS1;
        check_steps(&c.cage.mesh, 1);
    }
}

// Chaikin's averages reach across a seam, to and from a crease that ends there.
static void test_chaikin_at_seams(void)
{
    static split_cage c;
    for (int i = 1; i < 16; i++) {
        build_split(&c, 0.25 * i, 2.5);
        c.cage.mesh.creasing = SUBDIV_CREASING_CHAIKIN;
        check_steps(&c.cage.mesh, 1);
    }
}

// Without its holes a result has the other faces' UVs unchanged.
static void check_holes(subdiv_mesh *m, unsigned seed)
{
    subdiv_mesh all = {0}, seen = {0};
    int k = 0;
    (void)seed;
    if (!refine(&all, m, 1)) return;
    CHECK_EQUAL(subdiv_refine(&seen, m, 1, NULL), SUBDIV_OK);
    CHECK_EQUAL(seen.uv_count, all.uv_count);
    CHECK(same_bytes(seen.uvs, all.uvs, 2 * all.uv_count, sizeof(float)));
    for (int f = 0; f < all.face_count; f++) {
        int size = all.face_size;
        if (is_hole(&all, f)) continue;
        if (k < seen.face_count)
            CHECK(same_bytes(seen.face_uvs + k * size, all.face_uvs + f * size, size, sizeof(int)));
        k++;
    }
    CHECK_EQUAL(k, seen.face_count);
    subdiv_mesh_free(&all);
    subdiv_mesh_free(&seen);
}

static void test_holes(void)
{
    for_cages(100, RANDOM_ALL, check_holes);
}

// ------------------------------------------------------------------------------ the second door

enum { WIDTH = 5 };

// Runs the jobs in the opposite order.
static void run_backwards(void *user, void (*job)(void *context, int i), void *context, int count)
{
    (void)user;
    while (count-- > 0) job(context, count);
}

// The faces backwards and in small pieces.
static void evaluate_pieces(const subdiv_surface *surface, const float *in, float *out)
{
    int faces = subdiv_surface_cage_face_count(surface);
    int points = subdiv_surface_vertex_count(surface);
    void *scratch = array(1, subdiv_scratch_size(surface, WIDTH));
    CHECK_EQUAL(subdiv_evaluate_begin(surface, WIDTH, in, 0, scratch, NULL), SUBDIV_OK);
    for (int f = faces - 1; f >= 0; f--)
        CHECK_EQUAL(subdiv_evaluate_faces(surface, WIDTH, scratch, f, 1, 0, points, out, 0, NULL),
                    SUBDIV_OK);
    free(scratch);
}

// Channels 1 and 2 of the surface are the UVs of the mesh, bit by bit, and its faces are its own.
static void check_surface(const subdiv_surface *surface, const subdiv_mesh *m,
                          const subdiv_mesh *fine)
{
    int points = subdiv_surface_vertex_count(surface), count = face_vertex_count(fine);
    float *in = array(WIDTH * m->uv_count, sizeof(float));
    float *out = array(WIDTH * points, sizeof(float));
    float *other = array(WIDTH * points, sizeof(float));
    int *faces = array(count, sizeof(int));
    subdiv_options opt = {0};
    opt.run = run_backwards;
    for (int i = 0; i < WIDTH * m->uv_count; i++)
        in[i] = i % WIDTH == 1 || i % WIDTH == 2 ? m->uvs[i / WIDTH * 2 + i % WIDTH - 1] : (float)i;
    CHECK_EQUAL(points, fine->uv_count);
    CHECK_EQUAL(subdiv_surface_face_count(surface), fine->face_count);
    CHECK_EQUAL(subdiv_surface_faces(surface, faces, NULL, NULL), SUBDIV_OK);
    CHECK(same_bytes(faces, fine->face_uvs, count, sizeof(int)));
    CHECK_EQUAL(subdiv_evaluate(surface, WIDTH, in, 0, out, 0, NULL, NULL), SUBDIV_OK);
    for (int i = 0; i < points; i++)
        CHECK(same_bytes(out + WIDTH * i + 1, fine->uvs + 2 * i, 2, sizeof(float)));
    CHECK_EQUAL(subdiv_evaluate(surface, WIDTH, in, 0, other, 0, NULL, &opt), SUBDIV_OK);
    CHECK(same_bytes(out, other, WIDTH * points, sizeof(float)));
    memset(other, 0, sizeof(float) * WIDTH * (size_t)points);
    evaluate_pieces(surface, in, other);
    if (subdiv_surface_cage_face_count(surface) > 0)
        CHECK(same_bytes(out, other, WIDTH * points, sizeof(float)));
    free(in), free(out), free(other), free(faces);
}

static void check_channels(subdiv_mesh *m, unsigned seed)
{
    int levels = 1 + (int)(seed % 3);
    subdiv_surface *surface = NULL;
    subdiv_mesh fine = {0};
    subdiv_options opt = {0};
    if (seed % 4 == 0) drop_values(m, seed);
    opt.keep_holes = (int)(seed % 2);
    CHECK_EQUAL(subdiv_refine(&fine, m, levels, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_prepare_face_varying(&surface, m, m->uv_count, m->face_uvs, m->uv_rule,
                                            levels, &opt), SUBDIV_OK);
    if (surface && fine.uv_count) check_surface(surface, m, &fine);
    subdiv_surface_free(surface);
    subdiv_mesh_free(&fine);
}

static void test_channels(void)
{
    for_cages(120, RANDOM_ALL, check_channels);
}

// --------------------------------------------------------------------------------- triangulate

// A surface of the UVs alone has their faces, and those of the cage that these are parts of.
static void check_value_faces(const subdiv_mesh *m, const subdiv_mesh *fine,
                              const subdiv_options *opt)
{
    subdiv_surface *uvs;
    int count = fine->face_count, *faces, *of;
    if (!fine->uv_count) return;
    faces = calloc(3 * (size_t)count + 1, sizeof(int));
    of = calloc((size_t)count + 1, sizeof(int));
    CHECK_EQUAL(subdiv_prepare_face_varying(&uvs, m, m->uv_count, m->face_uvs, m->uv_rule, 1, opt),
                SUBDIV_OK);
    CHECK_EQUAL(subdiv_surface_faces(uvs, faces, of, opt), SUBDIV_OK);
    CHECK(same_bytes(faces, fine->face_uvs, 3 * count, sizeof(int)));
    CHECK(same_bytes(of, fine->cage_faces, count, sizeof(int)));
    subdiv_surface_free(uvs);
    free(faces), free(of);
}

// UVs are cut with the faces: as if the cage had been cut by hand.
static void check_cut(subdiv_mesh *m, unsigned seed)
{
    subdiv_mesh cut, fine = {0}, other = {0};
    subdiv_options opt = {0};
    int count = face_vertex_count(m), k = 0;
    (void)seed;
    m->scheme = SUBDIV_LOOP;
    m->hole_count = 0;
    cut = *m;
    cut.face_vertices = array(3 * count, sizeof(int));
    cut.face_uvs = array(3 * count, sizeof(int));
    cut.face_size = 3;
    for (int f = 0, start = 0; f < m->face_count; start += face_size(m, f++)) {
        for (int i = 2; i < face_size(m, f); i++) {
            const int from[] = {start, start + i - 1, start + i};
            for (int j = 0; j < 3; j++, k++) {
                cut.face_vertices[k] = m->face_vertices[from[j]];
                cut.face_uvs[k] = m->face_uvs[from[j]];
            }
        }
    }
    cut.face_count = k / 3;
    opt.triangulate = 1;
    CHECK_EQUAL(subdiv_refine(&fine, m, 1, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refine(&other, &cut, 1, NULL), SUBDIV_OK);
    CHECK(same_mesh(&fine, &other));
    check_value_faces(m, &fine, &opt);
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&other);
    free(cut.face_vertices), free(cut.face_uvs);
}

static void test_triangulate(void)
{
    for_cages(100, RANDOM_MANIFOLD | RANDOM_UVS, check_cut);
}

// ---------------------------------------------------------------------- colours and statements

static void check_colors(subdiv_mesh *m, unsigned seed)
{
    subdiv_mesh fine = {0};
    if (m->uv_rule != SUBDIV_UV_CORNERS_ONLY) return;
    m->colors = m->positions;
    if (refine(&fine, m, (int)(seed % 4))) {
        CHECK(fine.colors != NULL && fine.colors != fine.positions);
        for (int i = 0; i < 3 * fine.vertex_count && fine.colors; i++)
            CHECK_NEAR(fine.colors[i], fine.positions[i], 0);
    }
    subdiv_mesh_free(&fine);
    m->colors = NULL;
    if (refine(&fine, m, 1)) CHECK(fine.colors == NULL);
    subdiv_mesh_free(&fine);
}

static void test_colors(void)
{
    for_cages(100, RANDOM_ALL, check_colors);
}

// Statements stand before the first fine face of their face, also where faces before it are holes.
static void test_statements(void)
{
    static test_cage c;
    static char one[] = "g one", two[] = "usemtl two", three[] = "s off", last[] = "o end";
    char *statements[] = {one, two, three, last};
    int faces[] = {0, 3, 3, 6};
    subdiv_mesh fine = {0};
    build_prism(&c, 4);
    cage_hole(&c, 1);
    c.mesh.statement_count = 4;
    c.mesh.statement_faces = faces;
    c.mesh.statements = statements;
    for (int levels = 1; levels < 4; levels++) {
        int each = 1 << (2 * levels);
        CHECK_EQUAL(subdiv_refine(&fine, &c.mesh, levels, NULL), SUBDIV_OK);
        CHECK_EQUAL(fine.statement_count, 4);
        for (int i = 0; i < fine.statement_count; i++) {
            int holes = faces[i] > 1;
            CHECK_TEXT(fine.statements[i], statements[i]);
            CHECK(fine.statements[i] != statements[i]);
            CHECK_EQUAL(fine.statement_faces[i], (faces[i] - holes) * each);
        }
        subdiv_mesh_free(&fine);
    }
}

// -------------------------------------------------------------------------------------- errors

static void check_refused(const subdiv_mesh *m, subdiv_result expected, const char *text)
{
    subdiv_error error = {0};
    subdiv_options opt = {0};
    subdiv_mesh fine;
    opt.error = &error;
    memset(&fine, 1, sizeof fine);
    CHECK_EQUAL(subdiv_refine(&fine, m, 1, &opt), expected);
    CHECK_EQUAL(error.code, expected);
    if (!strstr(error.message, text)) TEST_REPORT("no \"%s\" in \"%s\"", text, error.message);
    CHECK(mesh_is_zero(&fine));
}

static void check_door_refused(const subdiv_mesh *m, int count, const int *indices, int rule,
                               subdiv_result expected)
{
    subdiv_error error = {0};
    subdiv_options opt = {0};
    static int other;
    subdiv_surface *surface = (subdiv_surface *)(void *)&other;
    opt.error = &error;
    CHECK_EQUAL(subdiv_prepare_face_varying(&surface, m, count, indices, (subdiv_uv_rule)rule, 1,
                                            &opt), expected);
    CHECK_EQUAL(error.code, expected);
    CHECK(error.message[0] != 0);
    CHECK(surface == NULL);
}

static void test_errors(void)
{
    static test_cage c;
    float uvs[16] = {0};
    int values[24];
    subdiv_mesh bad;
    build_prism(&c, 4);
    memcpy(values, c.face_vertices, sizeof values);
    c.mesh.uv_count = 8;
    c.mesh.uvs = uvs;
    c.mesh.face_uvs = values;
    values[9] = 8;
    check_refused(&c.mesh, SUBDIV_ERROR_INDEX, "face 2");
    check_door_refused(&c.mesh, 8, values, 0, SUBDIV_ERROR_INDEX);
    values[9] = -2;
    check_refused(&c.mesh, SUBDIV_ERROR_INDEX, "-2");
    check_door_refused(&c.mesh, 8, values, 0, SUBDIV_ERROR_INDEX);
    values[9] = 0;
    uvs[7] = (float)NAN;
    check_refused(&c.mesh, SUBDIV_ERROR_NOT_FINITE, "UV 3");
    uvs[7] = 0;
    bad = c.mesh, bad.uvs = NULL;
    check_refused(&bad, SUBDIV_ERROR_ARGUMENT, "uvs");
    bad = c.mesh, bad.face_uvs = NULL;
    check_refused(&bad, SUBDIV_ERROR_ARGUMENT, "face_uvs");
    check_door_refused(&c.mesh, 8, NULL, 0, SUBDIV_ERROR_ARGUMENT);
    check_door_refused(&c.mesh, 0, values, 0, SUBDIV_ERROR_ARGUMENT);
    check_door_refused(&c.mesh, 8, values, RULES, SUBDIV_ERROR_ARGUMENT);
    check_door_refused(NULL, 8, values, 0, SUBDIV_ERROR_ARGUMENT);
}

int main(void)
{
    RUN(test_steps);
    RUN(test_rules);
    RUN(test_sharp_along);
    RUN(test_sharp_along_patches);
    RUN(test_chaikin_at_seams);
    RUN(test_holes);
    RUN(test_channels);
    RUN(test_triangulate);
    RUN(test_colors);
    RUN(test_statements);
    RUN(test_errors);
    return test_end("uv");
}
