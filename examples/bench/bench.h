// What bench.c asks of the library it compares with; opensubdiv.cpp answers. bench.c is built
// with BENCH_PEER defined when that is linked in.
#ifndef BENCH_H
#define BENCH_H

#include "subdiv.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct peer peer;             // a cage and what was made of it

typedef struct peer_library {
    const char *name;

    // The cage in the form that the library reads; cage must outlive it.
    peer *(*open)(const subdiv_mesh *cage, int levels);
    void  (*close)(peer *p);

    // One refinement: prepare makes the topology of all levels, 0 when refused, with what normals
    // needs of the last one if limit is not 0; result makes the positions and face-vertices of the
    // last one, in plain arrays, and returns how many vertices; discard frees everything.
    int   (*prepare)(peer *p, int limit);
    int   (*result)(peer *p);
    void  (*discard)(peer *p);

    // Evaluation, after prepare. tables makes what the other two need. They return all points of
    // the last level: chained goes through the levels, for 3 channels; stencils through one table
    // of weights, for 3 or 4.
    void         (*tables)(peer *p);
    const float *(*chained)(peer *p, const float *in);
    const float *(*stencils)(peer *p, int channels, const float *in);

    // Limit positions and unit normals of what chained has made, after prepare with limit.
    void (*normals)(peer *p);

    // The limit surface anywhere, without prepare: surfaces makes all of them ready, 0 when
    // refused. locate takes the places, and sample evaluates there. tessellate begins with the
    // topology of the cage and goes through its faces, so many steps along each edge. Derivatives
    // are left out where du and dv are NULL. discard frees everything.
    int  (*surfaces)(peer *p);
    void (*locate)(peer *p, int count, const subdiv_location *at);
    void (*sample)(peer *p, float *points, float *du, float *dv);
    void (*tessellate)(peer *p, int rate, float *points, float *du, float *dv);
} peer_library;

extern const peer_library opensubdiv;

#ifdef __cplusplus
}
#endif

#endif
