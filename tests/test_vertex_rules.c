// The rules for smooth vertices, against the formulas written out here and against one ring of
// points that is refined by them in doubles until it has arrived.
//
//     cc -I. tests/test_vertex_rules.c -o build/test_vertex_rules -lm && build/test_vertex_rules
#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/same.h"
#include "lib/test.h"
#include "lib/three.h"

// ------------------------------------------------------------------------------------- the rules

typedef struct rule {
    const char *name;
    subdiv_scheme scheme;
    subdiv_vertex_rule rule;
    subdiv_vertex_weights weights;
    int keeps;                        // the standard weights at regular vertices
} rule;

static void standard_quads(void *user, int n, double w[3])
{
    (void)user;
    w[0] = (n - 3.0) / n;
    w[1] = 2.0 / n;
    w[2] = 1.0 / n;
}

static void standard_triangles(void *user, int n, double w[3])
{
    double c = 0.375 + cos(8 * atan(1.0) / n) / 4;
    (void)user;
    w[1] = n == 6 ? 0.375 : 0.625 - c * c;
    w[0] = 1 - w[1];
}

// Changes from valence to valence.
static void mine_quads(void *user, int n, double w[3])
{
    (void)user;
    w[1] = 0.3 + 0.05 * (n % 4);
    w[2] = 0.45 - 0.1 * (n % 3);
    w[0] = 1 - w[1] - w[2];
}

static void mine_triangles(void *user, int n, double w[3])
{
    (void)user;
    w[1] = 0.3 + 0.05 * (n % 4);
    w[0] = 1 - w[1];
}

// Extraordinary vertices stay, as spikes.
static void spikes_quads(void *user, int n, double w[3])
{
    w[0] = 1;
    if (n == 4) standard_quads(user, n, w);
}

static void spikes_triangles(void *user, int n, double w[3])
{
    w[0] = 1;
    if (n == 6) standard_triangles(user, n, w);
}

static const rule rules[] = {
    { "averaged", SUBDIV_CATMULL_CLARK, SUBDIV_VERTEX_AVERAGED, NULL, 1 },
    { "doo-sabin", SUBDIV_CATMULL_CLARK, SUBDIV_VERTEX_DOO_SABIN, NULL, 0 },
    { "mine, quads", SUBDIV_CATMULL_CLARK, SUBDIV_VERTEX_STANDARD, mine_quads, 0 },
    { "spikes, quads", SUBDIV_CATMULL_CLARK, SUBDIV_VERTEX_STANDARD, spikes_quads, 1 },
    { "warren", SUBDIV_LOOP, SUBDIV_VERTEX_WARREN, NULL, 1 },
    { "five-eighths", SUBDIV_LOOP, SUBDIV_VERTEX_FIVE_EIGHTHS, NULL, 1 },
    { "mine, triangles", SUBDIV_LOOP, SUBDIV_VERTEX_STANDARD, mine_triangles, 0 },
    { "spikes, triangles", SUBDIV_LOOP, SUBDIV_VERTEX_STANDARD, spikes_triangles, 1 } };

enum { RULES = sizeof rules / sizeof *rules };

static subdiv_mesh with_rule(const subdiv_mesh *cage, const rule *r)
{
    subdiv_mesh mesh = *cage;
    mesh.vertex_rule = r->rule;
    mesh.vertex_weights = r->weights;
    return mesh;
}

// The weights of v, R and Q, as the papers have them.
static void weights_of(const rule *r, int n, double w[3])
{
    w[0] = w[1] = w[2] = 0;
    if (r->weights) {
        r->weights(NULL, n, w);
    } else if (r->rule == SUBDIV_VERTEX_AVERAGED) {
        w[0] = 0.25, w[1] = 0.5, w[2] = 0.25;
    } else if (r->rule == SUBDIV_VERTEX_DOO_SABIN) {
        w[0] = (n - 2.0) / n, w[1] = 1.0 / n, w[2] = 1.0 / n;
    } else {
        double b = r->rule == SUBDIV_VERTEX_WARREN && n == 3 ? 3.0 / 16 : 3.0 / (8 * n);
        w[0] = 1 - n * b, w[1] = n * b;
    }
}

// Runs a check of random cages with all the rules of their schemes.
static void each_cage(int features, int seeds, int faces,
                      void (*check)(const subdiv_mesh *, const rule *))
{
    static char context[80];
    test_context = context;
    for (unsigned seed = 1; seed <= (unsigned)seeds; seed++) {
        random_cage *c = random_cage_new(seed, features);
        for (int i = 0; i < RULES && c->mesh.face_count <= faces; i++) {
            subdiv_mesh mesh = with_rule(&c->mesh, &rules[i]);
            sprintf(context, "random cage %u, %s", seed, rules[i].name);
            if (mesh.scheme == rules[i].scheme) check(&mesh, &rules[i]);
        }
        random_cage_free(c);
    }
}

enum { SMOOTH = RANDOM_NGONS | RANDOM_BOUNDARIES | RANDOM_LOOP };

// ------------------------------------------------------------------------------------ one level

// The number of edges at a vertex, or 0 if one of them is no edge of two faces.
static int valence_of(const edge_list *e, int v)
{
    int n = 0;
    for (int i = 0; i < e->count; i++) {
        if (e->ends[2 * i] != v && e->ends[2 * i + 1] != v) continue;
        if (e->faces[i] != 2) return 0;
        n++;
    }
    return n;
}

static void expect_vertex(const subdiv_mesh *m, const edge_list *e, const double *w, int n, int v,
                          double *out)
{
    for (int k = 0; k < 3; k++) out[k] = w[0] * (double)m->positions[3 * v + k];
    for (int i = 0; i < e->count; i++) {
        const int *ends = e->ends + 2 * i;
        if (ends[0] != v && ends[1] != v) continue;
        for (int k = 0; k < 3; k++) {
            double a = (double)m->positions[3 * ends[0] + k];
            double b = (double)m->positions[3 * ends[1] + k];
            double other = ends[0] == v ? b : a;
            out[k] += w[1] / n * (m->scheme == SUBDIV_LOOP ? other : (a + b) / 2);
        }
    }
    for (int f = 0; f < m->face_count && m->scheme != SUBDIV_LOOP; f++) {
        int size = face_size(m, f);
        if (!face_has(m, f, v)) continue;
        for (int i = 0; i < 3 * size; i++)
            out[i % 3] += w[2] / n / size *
                          (double)m->positions[3 * face_vertices(m, f)[i / 3] + i % 3];
    }
}

// Smooth vertices follow the formula; all other points are those of the standard rule.
static void check_one_level(const subdiv_mesh *cage, const rule *r)
{
    subdiv_mesh fine = {0}, standard = {0}, plain = *cage;
    edge_list e = edges_make(cage);
    plain.vertex_rule = SUBDIV_VERTEX_STANDARD;
    plain.vertex_weights = NULL;
    CHECK_EQUAL(subdiv_refine(&fine, cage, 1, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refine(&standard, &plain, 1, NULL), SUBDIV_OK);
    CHECK(fine.vertex_rule == r->rule && fine.vertex_weights == r->weights);
    for (int v = 0; v < fine.vertex_count; v++) {
        int n = v < cage->vertex_count ? valence_of(&e, v) : 0;
        double w[3], expect[3];
        if (n == 0) {
            CHECK(same_bytes(fine.positions + 3 * v, standard.positions + 3 * v, 3, sizeof(float)));
            continue;
        }
        weights_of(r, n, w);
        expect_vertex(cage, &e, w, n, v, expect);
        for (int k = 0; k < 3; k++)
            CHECK_NEAR(fine.positions[3 * v + k], expect[k], 2e-6 * mesh_reach(cage));
    }
    edges_free(&e);
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&standard);
}

static void test_formulas(void)
{
    each_cage(SMOOTH, 60, 512, check_one_level);
}

// Where a crease of sharpness 1/2 fades away, half of the vertex point is smooth.
static void test_blend(void)
{
    static test_cage c;
    for (int i = 0; i < RULES; i++) {
        subdiv_mesh fine[4] = {{0}};
        test_context = rules[i].name;
        build_bipyramid(&c, rules[i].scheme, 7);
        for (int k = 0; k < 4; k++) {
            subdiv_mesh mesh = k & 1 ? with_rule(&c.mesh, &rules[i]) : c.mesh;
            CHECK_EQUAL(subdiv_refine(&fine[k], &mesh, 1, NULL), SUBDIV_OK);
            for (int j = 0; j < 7 && k == 1; j++) cage_crease(&c, 2 + j, 2 + (j + 1) % 7, 0.5);
        }
        for (int j = 6; j < 27; j++) {
            double d = (double)fine[1].positions[j] - (double)fine[0].positions[j];
            CHECK_NEAR(fine[3].positions[j] - fine[2].positions[j], d / 2, 1e-6);
        }
        for (int k = 0; k < 4; k++) subdiv_mesh_free(&fine[k]);
    }
}

static void check_levels(const subdiv_mesh *cage, const rule *r)
{
    CHECK(cage->vertex_rule == r->rule && cage->vertex_weights == r->weights);
    check_three_times_one(cage);
}

static void test_three_times_one(void)
{
    each_cage(RANDOM_MANIFOLD, 60, 60, check_levels);
}

// ------------------------------------------------------------------------------------- the limit

enum { MOST = 64 };

typedef struct ring {                 // v, the neighbours and, of quads, the vertices across
    int loop, n;
    double v[3], e[MOST][3], f[MOST][3];
} ring;

static void refine_ring(ring *r, const double *w)
{
    int n = r->n;
    ring from = *r;
    for (int k = 0; k < 3; k++) {
        double mean = 0, centre = 0;
        for (int i = 0; i < n && !r->loop; i++)
            r->f[i][k] = (from.v[k] + from.e[i][k] + from.e[(i + 1) % n][k] + from.f[i][k]) / 4;
        for (int i = 0; i < n; i++) {
            int before = (i + n - 1) % n, after = (i + 1) % n;
            if (r->loop)
                r->e[i][k] = (3 * (from.v[k] + from.e[i][k]) + from.e[before][k] +
                              from.e[after][k]) / 8;
            else
                r->e[i][k] = (from.v[k] + from.e[i][k] + r->f[before][k] + r->f[i][k]) / 4;
            mean += (r->loop ? from.e[i][k] : (from.v[k] + from.e[i][k]) / 2) / n;
            centre += r->loop ? 0 : r->f[i][k] / n;
        }
        r->v[k] = w[0] * from.v[k] + w[1] * mean + w[2] * centre;
    }
}

// Moves the vertex to 0 and makes the ring of size 1; returns the size it had.
static double centre_ring(ring *r)
{
    double size = 0;
    for (int i = 0; i < r->n; i++)
        for (int k = 0; k < 3; k++) {
            size = fmax(size, fabs(r->e[i][k] -= r->v[k]));
            if (!r->loop) size = fmax(size, fabs(r->f[i][k] -= r->v[k]));
        }
    for (int i = 0; i < r->n; i++)
        for (int k = 0; k < 3; k++) r->e[i][k] /= size, r->f[i][k] /= size;
    r->v[0] = r->v[1] = r->v[2] = 0;
    return size;
}

// Refines a ring until it has arrived. Returns how far the normals of its triangles are apart then,
// as 1 - cosine or, in a needle too thin for doubles, 3; and how much the ring has shrunk.
static double ring_limit(ring *r, const double *w, double *point, double *normal, double *size)
{
    double apart = 0;
    *size = 1;
    memcpy(point, r->v, sizeof r->v);
    for (int i = 0; i < 400; i++) {
        *size *= centre_ring(r);
        refine_ring(r, w);
        for (int k = 0; k < 3; k++) point[k] += *size * r->v[k];
    }
    centre_ring(r);
    for (int i = 0; i < r->n; i++) {
        const double *a = r->e[i], *b = r->e[(i + 1) % r->n];
        double c[3], length, along = 0;
        for (int k = 0; k < 3; k++)
            c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
        length = sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
        for (int k = 0; k < 3; k++) {
            if (i == 0) normal[k] = c[k] / length;
            along += normal[k] * c[k] / length;
        }
        apart = fmax(apart, length > 1e-12 ? 1 - along : 3);
    }
    return apart;
}

// The ring of the face-vertex at, counter-clockwise. 0 if it does not close.
static int find_ring(const subdiv_mesh *m, const edge_list *e, int at, ring *r)
{
    int j = at;
    memset(r, 0, sizeof *r);
    r->loop = m->scheme == SUBDIV_LOOP;
    for (int k = 0; k < 3; k++) r->v[k] = (double)m->positions[3 * m->face_vertices[at] + k];
    do {
        int next = e->next[j];
        for (int k = 0; k < 3; k++) {
            r->e[r->n][k] = (double)m->positions[3 * m->face_vertices[next] + k];
            r->f[r->n][k] = (double)m->positions[3 * m->face_vertices[e->next[next]] + k];
        }
        r->n++;
        j = edges_twin(e, m, e->previous[j]);
    } while (j >= 0 && j != at && r->n < MOST);
    return j == at;
}

static int is_zero(const float *p, int count)
{
    for (int i = 0; i < count; i++)
        if (p[i] != 0) return 0;
    return 1;
}

static int spikes;                    // found so far

// The limit of level 1 against the rings around all its inner vertices.
static void check_limit(const subdiv_mesh *cage, const rule *r)
{
    subdiv_mesh fine = {0}, limit = {0};
    subdiv_options opt = {0};
    CHECK_EQUAL(subdiv_refine(&fine, cage, 1, &opt), SUBDIV_OK);
    opt.limit = 1;
    CHECK_EQUAL(subdiv_refine(&limit, cage, 1, &opt), SUBDIV_OK);
    edge_list e = edges_make(&fine);
    for (int j = 0; j < face_vertex_count(&fine); j++) {
        int v = fine.face_vertices[j];
        const float *normal = limit.normals + 3 * v;
        double w[3], p[3], n[3], shrunk;
        ring around;
        if (!find_ring(&fine, &e, j, &around)) continue;
        weights_of(r, around.n, w);
        int plane = ring_limit(&around, w, p, n, &shrunk) < 1e-9;
        for (int k = 0; k < 3; k++)
            CHECK_NEAR(limit.positions[3 * v + k], p[k], 1e-5 * mesh_reach(cage));
        if (around.n == 2) continue;              // two faces back to back
        spikes += !plane;
        if (!plane) CHECK(is_zero(normal, 3));
        for (int k = 0; k < 3 && plane && !is_zero(normal, 3); k++)
            CHECK_NEAR(normal[k], n[k], 1e-3);
    }
    edges_free(&e);
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&limit);
}

static void test_limit(void)
{
    spikes = 0;
    each_cage(SMOOTH, 24, 24, check_limit);
    CHECK(spikes > 100);
}

// Of every shape of the limit, in closed form: five-eighths alone makes spikes, at valence 3.
static void test_tangent_planes(void)
{
    static test_cage c;
    subdiv_options opt = {0};
    opt.limit = 1;
    for (int i = 0; i < RULES; i++)
        for (int n = 3; n <= 40; n++) {
            static char context[80];
            subdiv_mesh limit = {0};
            sprintf(context, "%s, valence %d", rules[i].name, n);
            test_context = context;
            build_fan(&c, rules[i].scheme, n, 1);
            subdiv_mesh mesh = with_rule(&c.mesh, &rules[i]);
            CHECK_EQUAL(subdiv_refine(&limit, &mesh, 1, &opt), SUBDIV_OK);
            int spike = rules[i].weights == spikes_quads ? n != 4 :
                        rules[i].weights == spikes_triangles ? n != 6 :
                        rules[i].rule == SUBDIV_VERTEX_FIVE_EIGHTHS && n == 3;
            CHECK_EQUAL(is_zero(limit.normals, 3), spike);
            subdiv_mesh_free(&limit);
        }
}

typedef struct any_weights {          // of the extraordinary vertices of a fan
    int    loop;
    double w[3];
} any_weights;

static void any(void *user, int n, double w[3])
{
    any_weights *a = (any_weights *)user;
    if (n == (a->loop ? 6 : 4)) (a->loop ? standard_triangles : standard_quads)(NULL, n, w);
    else memcpy(w, a->w, sizeof a->w);
}

// Any weights: whether there is a limit, and a tangent plane. Cases that a ring decides too slowly
// are left out.
static void test_any_weights(void)
{
    static test_cage c;
    static char context[80];
    unsigned random = 1;
    int counts[3] = { 0, 0, 0 };
    test_context = context;
    for (int i = 0; i < 600; i++) {
        any_weights a = { i % 2, { 0, 0, 0 } };
        subdiv_mesh fine = {0}, limit = {0};
        subdiv_options opt = {0};
        double p[3], n[3], shrunk;
        ring around;
        for (int k = 1; k < 3 - a.loop; k++) {
            random = random * 1664525u + 1013904223u;
            a.w[k] = (random >> 8) / 16777216.0 * 3 - 1;
        }
        if (i % 10 == 0) {                        // the eigenvalues are complex
            a.w[2] = 4 * a.w[2] + 4;
            a.w[1] = 1.5 - 1.5 * a.w[2] + 0.2 * a.w[1];
        }
        a.w[0] = 1 - a.w[1] - a.w[2];
        build_fan(&c, a.loop ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK, 3 + i / 2 % 9, 1);
        for (int k = 0; k < 3 * c.mesh.vertex_count; k++) c.positions[k] += 0.02f * (float)(k % 7);
        c.mesh.vertex_weights = any;
        c.mesh.vertex_user = &a;
        if (c.mesh.face_count == (a.loop ? 6 : 4)) continue;
        sprintf(context, "weights %d: %g %g %g", i, a.w[0], a.w[1], a.w[2]);
        CHECK_EQUAL(subdiv_refine(&fine, &c.mesh, 1, &opt), SUBDIV_OK);
        edge_list e = edges_make(&fine);
        CHECK(find_ring(&fine, &e, e.half[2 * edges_find(&e, 0, fine.face_vertices[1])], &around));
        double apart = ring_limit(&around, a.w, p, n, &shrunk);
        int decided = fabs(log(shrunk)) > 15 && (apart < 1e-9 || apart > 2);
        opt.limit = 1;
        subdiv_result result = subdiv_refine(&limit, &c.mesh, 1, &opt);
        if (decided) CHECK_EQUAL(result, shrunk < 1 ? SUBDIV_OK : SUBDIV_ERROR_ARGUMENT);
        for (int k = 0; k < 3 && decided && !result; k++)
            CHECK_NEAR(limit.positions[k], p[k], 1e-5);
        if (decided && !result) CHECK_EQUAL(is_zero(limit.normals, 3), apart > 2);
        if (decided) counts[shrunk > 1 ? 0 : apart > 2 ? 1 : 2]++;
        edges_free(&e);
        subdiv_mesh_free(&fine);
        subdiv_mesh_free(&limit);
    }
    for (int k = 0; k < 3; k++) CHECK(counts[k] > 30);
}

// ------------------------------------------------------------------------------------- the doors

static void sum_stencil(const subdiv_stencils *s, const subdiv_mesh *cage, int i,
                        const float *weights, double *out)
{
    out[0] = out[1] = out[2] = 0;
    for (size_t k = s->offsets[i]; k < s->offsets[i + 1]; k++)
        for (int d = 0; d < 3; d++)
            out[d] += (double)weights[k] * (double)cage->positions[3 * s->indices[k] + d];
}

// evaluate_limit and stencils against the mesh of limit points.
static void check_stencils(const subdiv_mesh *cage, const rule *r)
{
    subdiv_surface *surface = NULL;
    subdiv_mesh mesh = {0};
    subdiv_stencils s = {0};
    subdiv_options opt = {0};
    (void)r;
    opt.limit = 1;
    CHECK_EQUAL(subdiv_prepare(&surface, cage, 2, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_surface_mesh(&mesh, surface, cage->positions, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refined_stencils(&s, surface, 0, mesh.vertex_count, &opt), SUBDIV_OK);
    float *all = malloc(sizeof(float) * 12 * (size_t)mesh.vertex_count);
    subdiv_limit out = { all, all + 3, all + 6, 12, NULL };
    CHECK_EQUAL(subdiv_evaluate_limit(surface, cage->positions, 0, &out, NULL, &opt), SUBDIV_OK);
    for (int i = 0; i < mesh.vertex_count; i++) {
        const float *p = all + 12 * i;
        double sums[3][3], size = mesh_reach(cage);
        sum_stencil(&s, cage, i, s.weights, sums[0]);
        sum_stencil(&s, cage, i, s.du, sums[1]);
        sum_stencil(&s, cage, i, s.dv, sums[2]);
        CHECK(same_bytes(p + 3, mesh.normals + 3 * i, 3, sizeof(float)));
        CHECK(same_bytes(p, mesh.positions + 3 * i, 3, sizeof(float)));
        for (int k = 0; k < 3; k++) CHECK_NEAR(p[k], sums[0][k], 1e-5 * size);
        for (int k = 0; k < 6; k++) CHECK_NEAR(p[6 + k], sums[1 + k / 3][k % 3], 1e-4 * size);
        if (is_zero(p + 6, 6)) CHECK(is_zero(p + 3, 3));
    }
    free(all);
    subdiv_stencils_free(&s);
    subdiv_mesh_free(&mesh);
    subdiv_surface_free(surface);
}

// Tessellation and evaluation anywhere against the limit, or their refusal.
static void check_exact(const subdiv_mesh *cage, const rule *r)
{
    subdiv_surface *surface = NULL;
    subdiv_mesh limit = {0}, tiles = {0};
    subdiv_tessellation how = {0};
    subdiv_options opt = {0};
    subdiv_error error = {0};
    opt.error = &error;
    how.rate = 4;
    if (!r->keeps) {
        CHECK_EQUAL(subdiv_prepare(&surface, cage, SUBDIV_EXACT, &opt), SUBDIV_ERROR_ARGUMENT);
        CHECK(strstr(error.message, r->weights ? "vertex_weights" : r->name) != NULL);
        CHECK_EQUAL(subdiv_tessellate(&tiles, cage, &how, &opt), SUBDIV_ERROR_ARGUMENT);
        CHECK(surface == NULL && mesh_is_zero(&tiles));
        return;
    }
    CHECK_EQUAL(subdiv_prepare(&surface, cage, SUBDIV_EXACT, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_tessellate(&tiles, cage, &how, &opt), SUBDIV_OK);
    opt.limit = 1;
    CHECK_EQUAL(subdiv_refine(&limit, cage, 2, &opt), SUBDIV_OK);
    CHECK_EQUAL(tiles.vertex_count, limit.vertex_count);
    float *scratch = malloc(subdiv_scratch_size(surface, 3) + 1);
    CHECK_EQUAL(subdiv_evaluate_begin(surface, 3, cage->positions, 0, scratch, NULL), SUBDIV_OK);
    edge_list e = edges_make(cage);
    for (int f = 0, h = 0; f < cage->face_count; f++)
        for (int i = 0, n = face_size(cage, f); i < n; i++, h++) {
            int v = cage->face_vertices[h], whole = n == (r->scheme == SUBDIV_LOOP ? 3 : 4);
            subdiv_location at = { f, whole ? 0 : i, (float)(whole && (i == 1 || i == 2)),
                                   (float)(whole && i >= 2) };
            subdiv_derivatives out = {0};
            float p[3], normal[3], d[6];
            if (r->scheme == SUBDIV_LOOP) at.u = (float)(i == 1), at.v = (float)(i == 2);
            out.points = p, out.normals = normal, out.du = d, out.dv = d + 3;
            CHECK_EQUAL(subdiv_evaluate_at(surface, 3, scratch, 1, &at, &out, NULL), SUBDIV_OK);
            for (int k = 0; k < 3; k++) {
                CHECK_NEAR(p[k], limit.positions[3 * v + k], 1e-5 * mesh_reach(cage));
                CHECK_NEAR(p[k], tiles.positions[3 * v + k], 1e-5 * mesh_reach(cage));
            }
            if (valence_of(&e, v) < 3) continue;
            CHECK_EQUAL(is_zero(normal, 3), is_zero(limit.normals + 3 * v, 3));
            CHECK_EQUAL(is_zero(tiles.normals + 3 * v, 3), is_zero(limit.normals + 3 * v, 3));
            for (int k = 0; k < 3; k++) {
                CHECK_NEAR(normal[k], limit.normals[3 * v + k], 1e-3);
                CHECK_NEAR(tiles.normals[3 * v + k], limit.normals[3 * v + k], 1e-3);
            }
        }
    for (int i = 0; i < 3 * limit.vertex_count; i++) {
        CHECK_NEAR(tiles.positions[i], limit.positions[i], 1e-5 * mesh_reach(cage));
        if (i >= 3 * cage->vertex_count) CHECK_NEAR(tiles.normals[i], limit.normals[i], 1e-3);
    }
    edges_free(&e);
    free(scratch);
    subdiv_mesh_free(&limit);
    subdiv_mesh_free(&tiles);
    subdiv_surface_free(surface);
}

static void check_explain(const subdiv_mesh *cage, const rule *r)
{
    static const char *const formulas[] = { NULL, "Q/4 + R/2 + v/4  [CC78]",
        "Q/n + R/n + (n-2)/n v  [DS78]", "b = 3/(8n), or 3/16 for n = 3", "5/8 v + 3/(8n)" };
    edge_list e = edges_make(cage);
    char text[8192];
    for (int v = 0; v < cage->vertex_count; v++) {
        CHECK_EQUAL(subdiv_explain(text, sizeof text, cage, v, NULL), SUBDIV_OK);
        int n = valence_of(&e, v), paper = strstr(text, "[CC78]") || strstr(text, "[Loop87]");
        if (!r->weights) CHECK_EQUAL(strstr(text, formulas[r->rule]) != NULL, n > 0);
        else if (n > 0) CHECK_EQUAL(paper, r->keeps && n == (r->scheme == SUBDIV_LOOP ? 6 : 4));
    }
    edges_free(&e);
}

static void test_doors(void)
{
    each_cage(SMOOTH, 30, 40, check_stencils);
    each_cage(SMOOTH, 30, 40, check_exact);
    each_cage(SMOOTH, 30, 40, check_explain);
}

// -------------------------------------------------------------------------------- what is the same

// All points and normals of a few results have the same bits.
static void check_same(const subdiv_mesh *a, const subdiv_mesh *b)
{
    for (int k = 0; k < 3; k++) {
        subdiv_mesh x = {0}, y = {0};
        subdiv_options opt = {0};
        subdiv_tessellation how = {0};
        opt.limit = k == 1;
        opt.triangulate = 1;
        how.rate = 3;
        if (k < 2) CHECK_EQUAL(subdiv_refine(&x, a, 3, &opt), SUBDIV_OK);
        else CHECK_EQUAL(subdiv_tessellate(&x, a, &how, &opt), SUBDIV_OK);
        if (k < 2) CHECK_EQUAL(subdiv_refine(&y, b, 3, &opt), SUBDIV_OK);
        else CHECK_EQUAL(subdiv_tessellate(&y, b, &how, &opt), SUBDIV_OK);
        CHECK_EQUAL(x.vertex_count, y.vertex_count);
        CHECK(same_bytes(x.positions, y.positions, 3 * x.vertex_count, sizeof(float)));
        if (x.normals) CHECK(same_bytes(x.normals, y.normals, 3 * x.vertex_count, sizeof(float)));
        subdiv_mesh_free(&x);
        subdiv_mesh_free(&y);
    }
}

static void test_regular(void)
{
    static test_cage c;
    for (int i = 0; i < RULES; i++) {
        if (!rules[i].keeps) continue;
        test_context = rules[i].name;
        build_torus(&c, rules[i].scheme, 7, 5);
        cage_crease(&c, 0, 1, 2.5);
        cage_corner(&c, 12, SUBDIV_INFINITE);
        subdiv_mesh mesh = with_rule(&c.mesh, &rules[i]);
        check_same(&mesh, &c.mesh);
    }
}

static void test_standard_weights(void)
{
    static char context[40];
    test_context = context;
    for (unsigned seed = 1; seed <= 60; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        subdiv_mesh mesh = c->mesh;
        sprintf(context, "random cage %u", seed);
        mesh.vertex_weights = mesh.scheme == SUBDIV_LOOP ? standard_triangles : standard_quads;
        if (mesh.face_count <= 60) check_same(&mesh, &c->mesh);
        random_cage_free(c);
    }
}

// UVs stay those of the standard rule, and so do all face-varying values.
static void check_uvs(const subdiv_mesh *cage, const rule *r)
{
    subdiv_mesh fine[2] = {{0}}, plain = *cage;
    const subdiv_mesh *both[2] = { cage, &plain };
    subdiv_options opt = {0};
    float *values[2] = { NULL, NULL };
    int count[2] = { 0, 0 };
    (void)r;
    plain.vertex_rule = SUBDIV_VERTEX_STANDARD;
    plain.vertex_weights = NULL;
    opt.triangulate = 1;
    for (int i = 0; i < 2; i++) {
        subdiv_surface *surface = NULL;
        CHECK_EQUAL(subdiv_refine(&fine[i], both[i], 3, &opt), SUBDIV_OK);
        if (!cage->uv_count) continue;
        CHECK_EQUAL(subdiv_prepare_face_varying(&surface, both[i], cage->uv_count, cage->face_uvs,
                                                SUBDIV_UV_NONE, 2, &opt), SUBDIV_OK);
        count[i] = 2 * subdiv_surface_vertex_count(surface);
        values[i] = malloc(sizeof(float) * ((size_t)count[i] + 1));
        CHECK_EQUAL(subdiv_evaluate(surface, 2, cage->uvs, 0, values[i], 0, NULL, &opt), SUBDIV_OK);
        subdiv_surface_free(surface);
        CHECK_EQUAL(subdiv_prepare_face_varying(&surface, both[i], cage->uv_count, cage->face_uvs,
                                                SUBDIV_UV_NONE, SUBDIV_EXACT, &opt), SUBDIV_OK);
        subdiv_surface_free(surface);
    }
    CHECK_EQUAL(fine[0].uv_count, fine[1].uv_count);
    CHECK(same_bytes(fine[0].uvs, fine[1].uvs, 2 * fine[0].uv_count, sizeof(float)));
    CHECK_EQUAL(count[0], count[1]);
    CHECK(same_bytes(values[0], values[1], count[0], sizeof(float)));
    for (int i = 0; i < 2; i++) free(values[i]), subdiv_mesh_free(&fine[i]);
}

static void test_uvs(void)
{
    each_cage(RANDOM_MANIFOLD | RANDOM_UVS, 40, 60, check_uvs);
}

// ----------------------------------------------------------------------------------- the callback

typedef struct asked {
    int calls, times[16];             // for each valence
    double weights[3];
} asked;

static void ask(void *user, int valence, double w[3])
{
    asked *a = (asked *)user;
    a->calls++;
    if (valence < 16) a->times[valence]++;
    memcpy(w, a->weights, sizeof a->weights);
    if (valence == 4) standard_quads(NULL, valence, w);
}

static asked quarter(void)
{
    asked a = { 0, { 0 }, { 0.25, 0.5, 0.25 } };
    return a;
}

static void test_when_called(void)
{
    static test_cage c;
    subdiv_surface *surface = NULL;
    subdiv_mesh fine = {0};
    subdiv_options opt = {0};
    asked a = quarter();
    build_prism(&c, 5);                             // vertices of valence 3; pentagons and quads
    for (int i = 0; i < 5; i++) cage_crease(&c, i, (i + 1) % 5, SUBDIV_INFINITE);
    cage_corner(&c, 5, 2);
    for (int i = 6; i < 10; i++) cage_corner(&c, i, SUBDIV_INFINITE);
    c.mesh.vertex_weights = ask;
    c.mesh.vertex_user = &a;
    CHECK_EQUAL(subdiv_prepare(&surface, &c.mesh, 0, NULL), SUBDIV_OK);
    CHECK_EQUAL(a.calls, 0);
    subdiv_surface_free(surface);
    for (int k = 0; k < 3; k++) {
        a = quarter();
        opt.limit = k == 1;
        CHECK_EQUAL(subdiv_prepare(&surface, &c.mesh, k < 2 ? 3 : SUBDIV_EXACT, &opt), SUBDIV_OK);
        CHECK_EQUAL(a.calls, 3);
        CHECK(a.times[3] == 1 && a.times[4] == 1 && a.times[5] == 1);
        if (k < 2)
            CHECK_EQUAL(subdiv_surface_mesh(&fine, surface, c.positions, &opt), SUBDIV_OK);
        else
            CHECK_EQUAL(subdiv_surface_tessellate(&fine, surface, c.positions, NULL, &opt),
                        SUBDIV_OK);
        CHECK_EQUAL(a.calls, 3);
        CHECK(k == 2 || (fine.vertex_weights == ask && fine.vertex_user == &a));
        subdiv_mesh_free(&fine);
        subdiv_surface_free(surface);
    }
    cage_corner(&c, 5, SUBDIV_INFINITE);
    a = quarter();
    CHECK_EQUAL(subdiv_refine(&fine, &c.mesh, 1, NULL), SUBDIV_OK);
    CHECK(a.calls == 2 && a.times[3] == 0);
    subdiv_mesh_free(&fine);
    a = quarter();
    opt.linear = 1;
    CHECK_EQUAL(subdiv_refine(&fine, &c.mesh, 1, &opt), SUBDIV_OK);
    CHECK_EQUAL(a.calls, 0);
    subdiv_mesh_free(&fine);
}

static void test_errors(void)
{
    static const double bad[][3] = { { 0.25, 0.5, 0.2 }, { (double)NAN, 0.5, 0.25 },
                                     { 0, (double)INFINITY, 0 }, { 0, 1, 1e300 } };
    static const subdiv_result codes[] = { SUBDIV_ERROR_ARGUMENT, SUBDIV_ERROR_NOT_FINITE,
                                           SUBDIV_ERROR_NOT_FINITE, SUBDIV_ERROR_NOT_FINITE };
    static test_cage c;
    subdiv_mesh fine = {0}, mesh;
    subdiv_error error = {0};
    subdiv_options opt = {0};
    asked a = quarter();
    char text[4096];
    opt.error = &error;
    build_prism(&c, 7);
    for (int i = 0; i < RULES; i++)
        for (int s = SUBDIV_CATMULL_CLARK; s <= SUBDIV_BILINEAR; s++) {
            mesh = with_rule(&c.mesh, &rules[i]);
            mesh.scheme = (subdiv_scheme)s;
            opt.triangulate = 1;
            if (rules[i].weights || rules[i].scheme == mesh.scheme) continue;
            CHECK_EQUAL(subdiv_refine(&fine, &mesh, 1, &opt), SUBDIV_ERROR_ARGUMENT);
            CHECK(strstr(error.message, rules[i].name) != NULL);
            CHECK_EQUAL(subdiv_explain(text, sizeof text, &mesh, 0, &opt), SUBDIV_ERROR_ARGUMENT);
        }
    for (int value = -1; value <= 5; value += 6) {
        mesh = c.mesh;
        mesh.vertex_rule = (subdiv_vertex_rule)value;
        CHECK_EQUAL(subdiv_refine(&fine, &mesh, 1, &opt), SUBDIV_ERROR_ARGUMENT);
        CHECK(strstr(error.message, "vertex_rule") != NULL);
    }
    mesh = c.mesh;
    mesh.vertex_weights = ask;
    mesh.vertex_user = &a;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        memcpy(a.weights, bad[i], sizeof a.weights);
        CHECK_EQUAL(subdiv_refine(&fine, &mesh, 1, &opt), codes[i]);
        CHECK(strstr(error.message, "valence 3") != NULL);
        CHECK(mesh_is_zero(&fine));
        CHECK_EQUAL(subdiv_explain(text, sizeof text, &mesh, 0, &opt), codes[i]);
    }
}

// Formulas of weights that no paper has may be long: no line of an explanation is.
static void awkward(void *user, int n, double w[3])
{
    (void)user;
    w[1] = 0.1 + 1.0 / (7 + n);
    w[2] = 0.1 + 1.0 / (9 + n);
    w[0] = 1 - w[1] - w[2];
}

static void test_lines(void)
{
    static test_cage c;
    char text[32768];
    for (int n = 3; n <= 60; n++)
        for (int sharp = 0; sharp < 4; sharp++) {
            build_fan(&c, SUBDIV_CATMULL_CLARK, n, 1);
            c.mesh.vertex_weights = awkward;
            for (int i = 0; i < 2 && sharp; i++)
                cage_crease(&c, 0, 1 + 2 * i, 0.123f + 0.25f * (float)sharp);
            CHECK_EQUAL(subdiv_explain(text, sizeof text, &c.mesh, 0, NULL), SUBDIV_OK);
            CHECK(strstr(text, "(f1 + ... + fn)") != NULL);
            for (const char *line = text; *line; line++) {
                size_t length = strcspn(line, "\n");
                CHECK(length <= 80);
                line += length;
            }
        }
}

// Weights far from the mean throw the vertex to and fro, further each time: it has points on every
// level, but no limit.
static void test_no_limit(void)
{
    static const double away[2][3] = { { -3, 2, 2 }, { 2.5, -0.5, -1 } };
    static test_cage c;
    subdiv_mesh fine = {0};
    subdiv_surface *surface = NULL;
    subdiv_error error = {0};
    subdiv_options opt = {0};
    asked a = quarter();
    opt.error = &error;
    build_prism(&c, 5);
    c.mesh.vertex_weights = ask;
    c.mesh.vertex_user = &a;
    for (int i = 0; i < 2; i++) {
        memcpy(a.weights, away[i], sizeof a.weights);
        opt.limit = 0;
        CHECK_EQUAL(subdiv_refine(&fine, &c.mesh, 2, &opt), SUBDIV_OK);
        subdiv_mesh_free(&fine);
        CHECK_EQUAL(subdiv_prepare(&surface, &c.mesh, SUBDIV_EXACT, &opt), SUBDIV_ERROR_ARGUMENT);
        CHECK(strstr(error.message, "valence 3") && strstr(error.message, "no limit"));
        opt.limit = 1;
        for (int levels = 0; levels < 3; levels++) {
            CHECK_EQUAL(subdiv_refine(&fine, &c.mesh, levels, &opt), SUBDIV_ERROR_ARGUMENT);
            CHECK(strstr(error.message, "valence 3") && strstr(error.message, "no limit"));
        }
    }
}

int main(void)
{
    RUN(test_formulas);
    RUN(test_blend);
    RUN(test_three_times_one);
    RUN(test_limit);
    RUN(test_tangent_planes);
    RUN(test_any_weights);
    RUN(test_doors);
    RUN(test_regular);
    RUN(test_standard_weights);
    RUN(test_uvs);
    RUN(test_when_called);
    RUN(test_errors);
    RUN(test_no_limit);
    RUN(test_lines);
    return test_end("vertex_rules");
}
