// Where the points and face-vertices of results are: the exact surface has the same point and
// normal there. And tangents for normal maps: beside B-splines in doubles and the derivatives.
//
//     cc -I. tests/test_locations.c -o build/test_locations -lm && build/test_locations
#include <stdio.h>
#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/test.h"

enum { CAGES = 250, RANDOM_SMOOTH = RANDOM_MANIFOLD & ~RANDOM_CORNERS & ~RANDOM_BILINEAR };

static char context[64];

typedef struct exact_surface {
    subdiv_surface *surface;
    void *scratch;
} exact_surface;

static exact_surface open_exact(const subdiv_mesh *cage, const subdiv_options *opt)
{
    exact_surface e = { NULL, NULL };
    CHECK_EQUAL(subdiv_prepare(&e.surface, cage, SUBDIV_EXACT, opt), SUBDIV_OK);
    e.scratch = malloc(subdiv_scratch_size(e.surface, 3));
    CHECK_EQUAL(subdiv_evaluate_begin(e.surface, 3, cage->positions, 0, e.scratch, NULL),
                SUBDIV_OK);
    return e;
}

static void close_exact(exact_surface *e)
{
    free(e->scratch);
    subdiv_surface_free(e->surface);
}

// The surface has the point there; whether it has the normal.
static int check_place(const exact_surface *e, subdiv_location at, const float *expected,
                       const float *normal, double extent)
{
    float point[3], n[3];
    subdiv_derivatives out = {0};
    out.points = point;
    out.normals = n;
    CHECK_EQUAL(subdiv_evaluate_at(e->surface, 3, e->scratch, 1, &at, &out, NULL), SUBDIV_OK);
    for (int k = 0; k < 3; k++) CHECK_NEAR(point[k], expected[k], 2e-5 * extent);
    double dot = 0, length = 0;
    for (int k = 0; k < 3; k++) {
        dot += (double)(normal[k] * n[k]);
        length += (double)(normal[k] * normal[k]);
    }
    return length < 0.5 || dot > 0.999;
}

// smooth: no corner is a spike, so that normals are the same, too.
static void check_locations(const subdiv_mesh *cage, int levels, int smooth,
                            const subdiv_options *opt)
{
    subdiv_surface *surface = NULL;
    subdiv_mesh fine;
    exact_surface e = open_exact(cage, opt);
    double extent = mesh_extent(cage) + 1e-3 * mesh_reach(cage);
    int bad = 0, all = 0;
    CHECK_EQUAL(subdiv_prepare(&surface, cage, levels, opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_surface_mesh(&fine, surface, cage->positions, opt), SUBDIV_OK);
    size_t points = (size_t)fine.vertex_count, corners = (size_t)face_vertex_count(&fine);
    subdiv_location *p = (subdiv_location *)malloc((points + 1) * sizeof *p);
    subdiv_location *h = (subdiv_location *)malloc((corners + 1) * sizeof *h);
    h[corners].face = -77;
    CHECK_EQUAL(subdiv_surface_locations(surface, p, h, NULL), SUBDIV_OK);
    CHECK_EQUAL(h[corners].face, -77);
    unsigned char *used = (unsigned char *)calloc(points, 1);
    for (size_t i = 0, f = 0, left = 0; i < corners && !test_bad; i++, left--) {
        if (left == 0) left = (size_t)face_size(&fine, (int)f++);
        int v = fine.face_vertices[i], n = fine.face_normals ? fine.face_normals[i] : v;
        used[v] = 1;
        if (cage->scheme != SUBDIV_LOOP) CHECK_EQUAL(h[i].face, fine.cage_faces[f - 1]);
        bad += !check_place(&e, h[i], fine.positions + 3 * v, fine.normals + 3 * n, extent);
        all++;
    }
    for (size_t i = 0; i < points && !test_bad; i++) {
        CHECK(p[i].face >= 0 || !used[i]);
        if (p[i].face < 0) continue;
        if (levels == 0 && !used[i]) continue;
        bad += !check_place(&e, p[i], fine.positions + 3 * i, fine.normals + 3 * i, extent);
        all++;
    }
    if (smooth && bad) TEST_REPORT("%d normals of %d differ", bad, all);
    free(used);
    free(p);
    free(h);
    close_exact(&e);
    subdiv_mesh_free(&fine);
    subdiv_surface_free(surface);
}

static void test_random_cages(void)
{
    for (unsigned seed = 1; seed <= CAGES; seed++) {
        int smooth = seed % 3 == 0, all = RANDOM_ALL & ~RANDOM_DEGENERATE;
        random_cage *c = random_cage_new(seed, smooth ? RANDOM_SMOOTH : all);
        subdiv_options opt = {0};
        snprintf(context, sizeof context, "seed %u", seed);
        test_context = context;
        opt.limit = opt.triangulate = 1;
        int levels = (int)(seed % 4), none = c->mesh.boundary == SUBDIV_BOUNDARY_NONE;
        opt.keep_holes = seed % 2 && !none;
        if (levels == 0 && none) levels = 1;              // has faces without a surface
        check_locations(&c->mesh, levels, smooth, &opt);
        random_cage_free(c);
    }
}

int main(void)
{
    RUN(test_random_cages);
    return test_end("locations");
}
