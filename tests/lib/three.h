// Refining once three times is refining three times at once. Include it after subdiv.h.
#ifndef THREE_H
#define THREE_H

#include "cages.h"
#include "same.h"
#include "test.h"

static inline void check_three_times_one(const subdiv_mesh *cage)
{
    subdiv_mesh whole = {0}, half = {0}, next = {0};
    subdiv_options opt = {0};
    opt.triangulate = opt.keep_holes = 1;
    CHECK_EQUAL(subdiv_refine(&whole, cage, 3, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refine(&half, cage, 1, &opt), SUBDIV_OK);
    for (int i = 0; i < 2; i++) {
        CHECK(half.vertex_rule == cage->vertex_rule);
        CHECK(half.vertex_weights == cage->vertex_weights);
        CHECK_EQUAL(subdiv_refine(&next, &half, 1, &opt), SUBDIV_OK);
        subdiv_mesh_free(&half);
        half = next;
    }
    // Where faces have more than one edge in common, the first level takes them apart.
    if (whole.vertex_count == half.vertex_count)
        CHECK(points_apart(whole.positions, half.positions, whole.vertex_count, 3) <=
              2e-6 * mesh_reach(cage));
    subdiv_mesh_free(&whole);
    subdiv_mesh_free(&half);
}

#endif
