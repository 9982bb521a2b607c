// The functions of the library in plain mode, and how often they have asked for a mask.
#ifndef PLAIN_H
#define PLAIN_H

#include "subdiv.h"

typedef struct plain_mode {
    subdiv_result (*refine)(subdiv_mesh *fine, const subdiv_mesh *cage, int levels,
                            const subdiv_options *opt);
    subdiv_result (*prepare)(subdiv_surface **surface, const subdiv_mesh *cage, int levels,
                             const subdiv_options *opt);
    void (*surface_free)(subdiv_surface *surface);
    size_t (*scratch_size)(const subdiv_surface *surface, int channels);
    subdiv_result (*evaluate_begin)(const subdiv_surface *surface, int channels, const float *in,
                                    int in_stride, void *scratch, const subdiv_options *opt);
    subdiv_result (*evaluate_faces)(const subdiv_surface *surface, int channels,
                                    const void *scratch, int first_face, int face_count,
                                    int first_point, int point_count, float *out, int out_stride,
                                    const subdiv_options *opt);
    subdiv_result (*refined_stencils)(subdiv_stencils *stencils, const subdiv_surface *surface,
                                      int first_point, int point_count, const subdiv_options *opt);

    void (*forget_calls)(void);
    int  (*calls)(const char *function);        // since then
} plain_mode;

extern const plain_mode plain;

#endif
