// For tests: the exact surface of a cage, ready to be evaluated.
#ifndef READY_H
#define READY_H

#include <stdlib.h>

#include "subdiv.h"
#include "test.h"

// A surface that is ready for three channels.
typedef struct ready {
    subdiv_surface *surface;
    void *scratch;
} ready;

static inline ready get_ready(const subdiv_mesh *cage, const subdiv_options *opt)
{
    ready r = { NULL, NULL };
    CHECK_EQUAL(subdiv_prepare(&r.surface, cage, SUBDIV_EXACT, opt), SUBDIV_OK);
    r.scratch = malloc(subdiv_scratch_size(r.surface, 3));
    CHECK_EQUAL(subdiv_evaluate_begin(r.surface, 3, cage->positions, 0, r.scratch, opt), SUBDIV_OK);
    return r;
}

static inline void put_away(ready *r)
{
    subdiv_surface_free(r->surface);
    free(r->scratch);
}

#endif
