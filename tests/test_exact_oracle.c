// Evaluation anywhere on the limit surface against exact_oracle.h, which refines around the place
// in doubles; the oracle itself against limits of refined meshes.
//
//     cc -I. tests/test_exact_oracle.c -o build/test_exact_oracle -lm -pthread &&
//     build/test_exact_oracle
#include <stdio.h>
#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "cages.h"
#include "exact_oracle.h"
#include "random_cage.h"
#include "test.h"

static char context[96];

static double extent(const subdiv_mesh *mesh)
{
    double largest = 0;
    for (int k = 0; k < 3; k++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int v = 0; v < mesh->vertex_count; v++) {
            low = fmin(low, (double)mesh->positions[3 * v + k]);
            high = fmax(high, (double)mesh->positions[3 * v + k]);
        }
        largest = fmax(largest, high - low);
    }
    return largest;
}

// ---------------------------------------------------------------------------- the oracle itself

// One random point of each of some faces of the refined mesh.
static void check_dyadic_points(random_cage *random, int levels)
{
    const subdiv_mesh *cage = &random->mesh;
    subdiv_mesh fine = {0};
    subdiv_options opt = {0};
    order grid;
    oracle *o;
    opt.limit = 1;
    CHECK(order_make(&grid, cage, levels, NULL));
    CHECK(oracle_open(&o, cage));
    CHECK_EQUAL(subdiv_refine(&fine, cage, levels, &opt), SUBDIV_OK);
    for (int i = 0; i < 8 && !test_bad; i++) {
        const int f = random_below(random, cage->face_count), n = order_grid(&grid, f);
        const int quad = order_is_ngon(&grid, f) ? random_below(random, face_size(cage, f)) : 0;
        const int row = random_below(random, n + 1), loop = cage->scheme == SUBDIV_LOOP;
        const int column = random_below(random, n + 1 - (loop ? row : 0));
        const int point = order_point(&grid, f, quad, row, column);
        double out[3][3];
        CHECK(oracle_evaluate(o, f, quad, (double)column / n, (double)row / n, levels, out));
        for (int k = 0; k < 3; k++)
            CHECK_NEAR(fine.positions[3 * point + k], out[0][k], 1e-6 * extent(cage));
    }
    oracle_close(o);
    order_free(&grid);
    subdiv_mesh_free(&fine);
}

static void test_oracle(void)
{
    test_context = context;
    for (unsigned seed = 1; seed <= 600; seed++) {
        random_cage *random = random_cage_new(seed, RANDOM_ALL & ~RANDOM_DEGENERATE);
        sprintf(context, "seed %u", seed);
        if (random) check_dyadic_points(random, 1 + (int)seed % 4);
        CHECK(random != NULL);
        random_cage_free(random);
    }
}

int main(void)
{
    RUN(test_oracle);
    return test_end("exact_oracle");
}
