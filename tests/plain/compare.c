// Random cages in plain mode and as ever: the same faces and tags, and points, UVs, limits and
// weights of stencils that differ by rounding. And in plain mode every point asks for its mask.
#include <stdlib.h>

#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/same.h"
#include "lib/test.h"
#include "plain.h"

enum { CAGES = 250 };

static const double rounding = 2e-6;  // of the extent

typedef struct evaluation {           // what is asked of a cage
    const subdiv_mesh *cage;
    subdiv_options opt;
    int levels;
} evaluation;

static void for_cages(int features, void (*check)(const evaluation *))
{
    static char context[64];
    test_context = context;
    for (unsigned seed = 1; seed <= CAGES; seed++) {
        random_cage *c = random_cage_new(seed, features);
        evaluation e;
        if (!c) abort();
        memset(&e, 0, sizeof e);
        e.cage = &c->mesh;
        e.levels = (int)(seed % 4) + (face_vertex_count(&c->mesh) < 40);
        e.opt.keep_holes = seed / 4 % 2;
        e.opt.limit = seed / 8 % 2;
        e.opt.linear = seed / 16 % 8 == 7;
        sprintf(context, "random cage %u, %d levels", seed, e.levels);
        check(&e);
        random_cage_free(c);
    }
}

static double size_of(const float *values, int count)
{
    double size = 0;
    for (int i = 0; i < count; i++) size = fmax(size, fabs((double)values[i]));
    return size;
}

static void check_floats(const float *a, const float *b, int count, double allowed)
{
    double worst = 0;
    for (int i = 0; i < count; i++) worst = fmax(worst, fabs((double)a[i] - (double)b[i]));
    CHECK_NEAR(worst, 0, allowed);
}

// -------------------------------------------------------------------------------------- results

// Points and UVs are close; with those of one mesh, the other is the same.
static void check_mesh(const evaluation *e)
{
    const subdiv_mesh *cage = e->cage;
    subdiv_mesh a = {0}, b = {0};
    CHECK_EQUAL(subdiv_refine(&a, cage, e->levels, &e->opt), SUBDIV_OK);
    CHECK_EQUAL(plain.refine(&b, cage, e->levels, &e->opt), SUBDIV_OK);
    CHECK_EQUAL(a.vertex_count, b.vertex_count);
    CHECK_EQUAL(a.uv_count, b.uv_count);
    if (a.vertex_count == b.vertex_count && a.uv_count == b.uv_count) {
        size_t points = 3 * sizeof(float) * (size_t)a.vertex_count;
        check_floats(a.positions, b.positions, 3 * a.vertex_count,
                     rounding * size_of(cage->positions, 3 * cage->vertex_count));
        check_floats(a.uvs, b.uvs, 2 * a.uv_count,
                     rounding * size_of(cage->uvs, 2 * cage->uv_count));
        if (points) memcpy(b.positions, a.positions, points);
        if (a.uv_count) memcpy(b.uvs, a.uvs, 2 * sizeof(float) * (size_t)a.uv_count);
        CHECK(same_mesh(&a, &b));
        CHECK(same_bytes(a.cage_faces, b.cage_faces, a.face_count, sizeof(int)));
    }
    subdiv_mesh_free(&a);
    subdiv_mesh_free(&b);
}

static void test_meshes(void)
{
    for_cages(RANDOM_ALL, check_mesh);
}

// ---------------------------------------------------------------------------------- limit normals

static double length(const double *a)
{
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

// How far a normal may turn, whose tangents are off by rounding of a cage of this size.
static double turn_of(const float *t, double size)
{
    const float *s = t + 3;
    double a[3] = { (double)t[0], (double)t[1], (double)t[2] };
    double b[3] = { (double)s[0], (double)s[1], (double)s[2] };
    double c[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                    a[0] * b[1] - a[1] * b[0] };
    return 8 * rounding * size * (length(a) + length(b)) / length(c);
}

static int normals;

// Not of linear surfaces, which are bent between the quads of an n-gon: there either side will do.
static void check_normals(const evaluation *e)
{
    subdiv_mesh a = {0}, b = {0};
    subdiv_surface *surface = NULL;
    subdiv_options opt = e->opt;
    subdiv_limit out = {0};
    double size = size_of(e->cage->positions, 3 * e->cage->vertex_count);
    if (opt.linear || e->cage->scheme == SUBDIV_BILINEAR) return;
    opt.limit = 1;
    CHECK_EQUAL(subdiv_refine(&a, e->cage, e->levels, &opt), SUBDIV_OK);
    CHECK_EQUAL(plain.refine(&b, e->cage, e->levels, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_prepare(&surface, e->cage, e->levels, &opt), SUBDIV_OK);
    out.tangents = malloc(6 * sizeof(float) * ((size_t)a.vertex_count + 1));
    CHECK_EQUAL(subdiv_evaluate_limit(surface, e->cage->positions, 0, &out, NULL, NULL), SUBDIV_OK);
    CHECK_EQUAL(a.normal_count, b.normal_count);
    CHECK(a.face_normals ? memcmp(a.face_normals, b.face_normals, (size_t)a.face_size *
          (size_t)a.face_count * sizeof(int)) == 0 : !b.face_normals);
    for (int i = 0; i < a.vertex_count && a.vertex_count == b.vertex_count; i++) {
        double turn = turn_of(out.tangents + 6 * i, size);
        if (!(turn < 0.05)) continue;                       // too short, or almost parallel
        normals++;
        check_floats(a.normals + 3 * i, b.normals + 3 * i, 3, turn);
    }
    free(out.tangents);
    subdiv_surface_free(surface);
    subdiv_mesh_free(&a);
    subdiv_mesh_free(&b);
}

static void test_normals(void)
{
    for_cages(RANDOM_ALL, check_normals);
    CHECK(normals > 50000);
}

// --------------------------------------------------------------------------------------- stencils

// Adds the weights of stencil i, or with sign -1 subtracts them.
static void add_stencil(const subdiv_stencils *s, int i, double sign, double *weights)
{
    for (size_t k = s->offsets[i]; k < s->offsets[i + 1]; k++)
        weights[s->indices[k]] += sign * (double)s->weights[k];
}

static void check_stencils(const evaluation *e)
{
    subdiv_surface *surface = NULL, *other = NULL;
    subdiv_stencils a = {0}, b = {0};
    double *weights = calloc((size_t)e->cage->vertex_count, sizeof *weights), worst = 0;
    CHECK_EQUAL(subdiv_prepare(&surface, e->cage, e->levels, &e->opt), SUBDIV_OK);
    CHECK_EQUAL(plain.prepare(&other, e->cage, e->levels, &e->opt), SUBDIV_OK);
    int points = subdiv_surface_vertex_count(surface);
    CHECK_EQUAL(subdiv_refined_stencils(&a, surface, 0, points, NULL), SUBDIV_OK);
    CHECK_EQUAL(plain.refined_stencils(&b, other, 0, points, NULL), SUBDIV_OK);
    for (int i = 0; i < a.count && i < b.count; i++) {
        add_stencil(&a, i, 1, weights);
        add_stencil(&b, i, -1, weights);
        for (int v = 0; v < e->cage->vertex_count; v++) {
            worst = fmax(worst, fabs(weights[v]));
            weights[v] = 0;
        }
    }
    CHECK_EQUAL(a.count, b.count);
    CHECK_NEAR(worst, 0, rounding);
    free(weights);
    subdiv_stencils_free(&a);
    subdiv_stencils_free(&b);
    subdiv_surface_free(surface);
    plain.surface_free(other);
}

static void test_stencils(void)
{
    for_cages(RANDOM_ALL & ~RANDOM_UVS, check_stencils);
}

// ----------------------------------------------------------------------------------- face by face

// In plain mode, too, every point belongs to one face, the first that has it.
static void check_faces(const evaluation *e)
{
    const float *in = e->cage->positions;
    subdiv_mesh fine = {0};
    subdiv_surface *surface = NULL;
    CHECK_EQUAL(plain.refine(&fine, e->cage, e->levels, &e->opt), SUBDIV_OK);
    CHECK_EQUAL(plain.prepare(&surface, e->cage, e->levels, &e->opt), SUBDIV_OK);
    float *out = calloc(3 * (size_t)fine.vertex_count + 1, sizeof *out);
    void *scratch = malloc(plain.scratch_size(surface, 3) + 1);
    CHECK_EQUAL(plain.evaluate_begin(surface, 3, in, 0, scratch, NULL), SUBDIV_OK);
    for (int f = e->cage->face_count - 1; f >= 0; f--)
        CHECK_EQUAL(plain.evaluate_faces(surface, 3, scratch, f, 1, 0, fine.vertex_count, out, 0,
                                         NULL), SUBDIV_OK);
    CHECK(same_bytes(out, fine.positions, 3 * fine.vertex_count, sizeof(float)));
    free(out);
    free(scratch);
    plain.surface_free(surface);
    subdiv_mesh_free(&fine);
}

static void test_faces(void)
{
    for_cages(RANDOM_ALL & ~RANDOM_UVS, check_faces);
}

// ------------------------------------------------------------------------------------------ masks

// Each point of each level asks for one mask, a vertex point also for the smooth one of its scheme,
// and each point of a limit for a limit mask, and for the masks of the way there if it fades. (So
// does each other side of a crease: here there is one normal a point.)
static void check_masks(const evaluation *e)
{
    const subdiv_mesh *cage = e->cage;
    subdiv_mesh fine = {0};
    subdiv_options opt = e->opt;
    opt.one_normal = 1;
    int loop = cage->scheme == SUBDIV_LOOP, levels = e->levels ? e->levels : e->opt.limit;
    int size = face_vertex_count(cage), *has_face = int_array(cage->vertex_count, 0);
    int alone = cage->vertex_count, vertices = 0, edges = 0, faces = 0;
    for (int h = 0; h < size; h++) alone -= has_face[cage->face_vertices[h]]++ == 0;
    int v = cage->vertex_count - alone, f = cage->face_count;
    for (int i = 0; i < levels; i++) {
        subdiv_surface *next = NULL;
        CHECK_EQUAL(subdiv_prepare(&next, cage, i + 1, NULL), SUBDIV_OK);
        vertices += v;
        faces += loop ? 0 : f;
        edges -= loop ? v : v + f;
        v = subdiv_surface_vertex_count(next) - alone;
        edges += v;
        f = loop || i > 0 ? 4 * f : size;
        subdiv_surface_free(next);
    }
    plain.forget_calls();
    CHECK_EQUAL(plain.refine(&fine, cage, e->levels, &opt), SUBDIV_OK);
    int linear = cage->scheme == SUBDIV_BILINEAR || e->opt.linear;
    CHECK_EQUAL(plain.calls("sdv_limit_mask"), e->opt.limit && !linear ? v : 0);
    if (e->opt.limit) {
        CHECK(plain.calls("sdv_face_weight") >= faces && plain.calls("sdv_edge_mask") >= edges);
        CHECK(plain.calls("sdv_vertex_mask") >= vertices);
    } else {
        CHECK_EQUAL(plain.calls("sdv_face_weight"), faces);
        CHECK_EQUAL(plain.calls("sdv_edge_mask"), edges);
        CHECK_EQUAL(plain.calls("sdv_vertex_mask"), vertices);
        CHECK_EQUAL(plain.calls(loop ? "sdv_loop_vertex" : "sdv_catmull_clark_vertex"), vertices);
    }
    subdiv_mesh_free(&fine);
    free(has_face);
}

static void test_masks(void)
{
    for_cages(RANDOM_ALL & ~RANDOM_UVS, check_masks);
}

int main(void)
{
    RUN(test_meshes);
    RUN(test_normals);
    RUN(test_stencils);
    RUN(test_faces);
    RUN(test_masks);
    return test_end("plain");
}
