// Makes every public call that computes something, on one cage and with one set of options. Include
// it after subdiv.h.
#ifndef EVERY_CALL_H
#define EVERY_CALL_H

#include <stdlib.h>
#include <string.h>

typedef struct every {
    const subdiv_mesh *cage;
    const subdiv_options *opt;
    int levels;
    void (*after)(const char *call);  // called after each public call
    unsigned long long sum;           // of all results
} every;

static inline void every_add(every *e, const void *bytes, size_t size)
{
    const unsigned char *b = (const unsigned char *)bytes;
    for (size_t i = 0; b && i < size; i++) e->sum = (e->sum ^ b[i]) * 1099511628211u;
}

// Makes the call, reports it and adds its result to the sum. True if it went well.
#define EVERY(e, call) every_result(e, #call, call)

static inline int every_result(every *e, const char *call, subdiv_result result)
{
    e->after(call);
    every_add(e, &result, sizeof result);
    return result == SUBDIV_OK;
}

static inline void *every_room(every *e, size_t size)
{
    void *room = calloc(size + 1, 1);
    if (!room) abort();
    every_add(e, &size, sizeof size);
    return room;
}

static inline void every_keep(every *e, void *room, size_t size)
{
    every_add(e, room, size);
    free(room);
}

static inline void every_mesh(every *e, subdiv_mesh *m)
{
    size_t v = 3 * sizeof(float) * (size_t)m->vertex_count, f = sizeof(int) * (size_t)m->face_count;
    every_add(e, m->positions, v);
    if (m->face_normals) v = 3 * sizeof(float) * (size_t)m->normal_count;
    every_add(e, m->normals, v);
    if (m->face_normals) every_add(e, m->face_normals, (size_t)m->face_size * f);
    every_add(e, m->face_vertices, (size_t)m->face_size * f);
    every_add(e, m->cage_faces, f);
    every_add(e, m->uvs, 2 * sizeof(float) * (size_t)m->uv_count);
    every_add(e, m->crease_sharpness, sizeof(float) * (size_t)m->crease_count);
    subdiv_mesh_free(m);
}

static inline void every_buffer(every *e, const subdiv_surface *surface, const subdiv_mesh *m)
{
    subdiv_buffer b;
    subdiv_vertices out = {0};
    if (!EVERY(e, subdiv_make_buffer(&b, m, 4, e->opt))) return;
    size_t size = 8 * sizeof(float) * (size_t)b.vertex_count;
    out.positions = (float *)every_room(e, size);
    out.normals = out.positions + 3;
    out.uvs = m->uv_count ? out.positions + 6 : NULL;
    out.stride = 8;
    EVERY(e, subdiv_fill_buffer(&b, m, &out, e->opt));
    EVERY(e, subdiv_evaluate_buffer(&b, surface, e->cage->positions, &out, NULL, e->opt));
    every_add(e, b.indices, (size_t)b.index_count * (size_t)b.index_size);
    every_keep(e, out.positions, size);
    subdiv_buffer_free(&b);
}

// Where the points and face-vertices of a limit mesh are, and which normals the latter have.
static inline void every_place(every *e, const subdiv_surface *surface, const subdiv_mesh *m)
{
    size_t corners = 0, points = sizeof(subdiv_location) * (size_t)m->vertex_count;
    for (int f = 0; f < m->face_count; f++)
        corners += (size_t)(m->face_size ? m->face_size : m->face_sizes[f]);
    subdiv_location *at = (subdiv_location *)every_room(e, points);
    subdiv_location *of = (subdiv_location *)every_room(e, corners * sizeof *of);
    int *normals = (int *)every_room(e, corners * sizeof *normals);
    EVERY(e, subdiv_surface_locations(surface, at, of, e->opt));
    EVERY(e, subdiv_surface_face_normals(surface, normals, e->opt));
    every_keep(e, at, points);
    every_keep(e, of, corners * sizeof *of);
    every_keep(e, normals, corners * sizeof *normals);
}

static inline void every_stencils(every *e, subdiv_stencils *s)
{
    size_t count = s->offsets ? s->offsets[s->count] : 0;
    every_add(e, s->indices, count * sizeof(int));
    every_add(e, s->weights, count * sizeof(float));
    every_add(e, s->du, count * sizeof(float));
    subdiv_stencils_free(s);
}

// All points at once, and in two parts.
static inline void every_evaluation(every *e, const subdiv_surface *surface, int channels,
                                    const float *in)
{
    int faces = subdiv_surface_cage_face_count(surface), half = faces / 2;
    int points = subdiv_surface_vertex_count(surface);
    size_t size = sizeof(float) * (size_t)channels * (size_t)points;
    float *all = (float *)every_room(e, size), *parts = (float *)every_room(e, size);
    void *scratch = every_room(e, subdiv_scratch_size(surface, channels));
    EVERY(e, subdiv_evaluate(surface, channels, in, 0, all, 0, NULL, e->opt));
    EVERY(e, subdiv_evaluate_begin(surface, channels, in, 0, scratch, e->opt));
    EVERY(e, subdiv_evaluate_faces(surface, channels, scratch, half, faces - half, 0, points, parts,
                                   0, e->opt));
    EVERY(e, subdiv_evaluate_faces(surface, channels, scratch, 0, half, 0, points, parts, 0,
                                   e->opt));
    free(scratch);
    every_keep(e, all, size), every_keep(e, parts, size);
}

static inline void every_limit(every *e, const subdiv_surface *surface)
{
    int faces = subdiv_surface_cage_face_count(surface);
    int points = subdiv_surface_vertex_count(surface);
    size_t size = 12 * sizeof(float) * (size_t)points;
    float *out = (float *)every_room(e, size);
    void *scratch = every_room(e, subdiv_scratch_size(surface, 3));
    subdiv_limit limit = { out, out + 3, out + 6, 12, NULL };
    EVERY(e, subdiv_evaluate_limit(surface, e->cage->positions, 0, &limit, scratch, e->opt));
    every_add(e, out, size);
    EVERY(e, subdiv_evaluate_limit_faces(surface, scratch, 0, faces, 0, points, &limit, e->opt));
    free(scratch);
    every_keep(e, out, size);
}

// What every surface of a result has, of positions or of face-varying values.
static inline void every_surface(every *e, subdiv_surface *surface, int channels, const float *in)
{
    size_t faces = sizeof(int) * (size_t)subdiv_surface_face_count(surface);
    size_t ends = 2 * sizeof(int) * (size_t)subdiv_surface_edge_count(surface);
    int *face_vertices = (int *)every_room(e, 4 * faces);
    int *cage_faces = (int *)every_room(e, faces), *edges = (int *)every_room(e, ends);
    subdiv_stencils stencils;
    every_evaluation(e, surface, channels, in);
    EVERY(e, subdiv_surface_faces(surface, face_vertices, cage_faces, e->opt));
    subdiv_surface_edges(surface, edges);
    EVERY(e, subdiv_refined_stencils(&stencils, surface, 0, subdiv_surface_vertex_count(surface),
                                     e->opt));
    every_stencils(e, &stencils);
    every_keep(e, face_vertices, 4 * faces);
    every_keep(e, cage_faces, faces), every_keep(e, edges, ends);
}

static inline size_t every_write(void *user, const void *bytes, size_t size)
{
    every_add((every *)user, bytes, size);
    return size;
}

static inline void every_refinement(every *e)
{
    const subdiv_mesh *cage = e->cage;
    subdiv_options limit = *e->opt;
    subdiv_surface *surface;
    subdiv_mesh fine;
    EVERY(e, subdiv_refine(&fine, cage, e->levels, e->opt));
    every_mesh(e, &fine);
    if (EVERY(e, subdiv_prepare(&surface, cage, e->levels, e->opt))) {
        EVERY(e, subdiv_surface_mesh(&fine, surface, cage->positions, e->opt));
        every_mesh(e, &fine);
        EVERY(e, subdiv_stream_obj_callback(surface, cage->positions, every_write, e, e->opt));
        every_surface(e, surface, 3, cage->positions);
    }
    subdiv_surface_free(surface);
    limit.limit = 1;
    if (EVERY(e, subdiv_prepare(&surface, cage, e->levels, &limit))) {
        EVERY(e, subdiv_surface_mesh(&fine, surface, cage->positions, e->opt));
        every_buffer(e, surface, &fine);
        every_place(e, surface, &fine);
        limit.part = 1, limit.part_count = 3;
        EVERY(e, subdiv_stream_obj_callback(surface, cage->positions, every_write, e, &limit));
        every_mesh(e, &fine);
        every_limit(e, surface);
        every_surface(e, surface, 3, cage->positions);
    }
    subdiv_surface_free(surface);
    if (!cage->uv_count) return;
    if (EVERY(e, subdiv_prepare_face_varying(&surface, cage, cage->uv_count, cage->face_uvs,
                                             cage->uv_rule, e->levels, e->opt)))
        every_surface(e, surface, 2, cage->uvs);
    subdiv_surface_free(surface);
}

// Locations on all faces in turn: in the middle, on edges, at vertices and near them.
static inline subdiv_location *every_location(const subdiv_mesh *cage, int count)
{
    static const float at[] = { 0, 1e-6f, 0.01f, 0.3f, 0.4999f, 0.5f };
    subdiv_location *l = (subdiv_location *)calloc((size_t)count + 1, sizeof *l);
    if (!l) abort();
    for (int i = 0; i < count; i++) {
        l[i].face = i % cage->face_count;
        int k = i / cage->face_count;
        int size = cage->face_size ? cage->face_size : cage->face_sizes[l[i].face];
        if (size != 4 && cage->scheme != SUBDIV_LOOP) l[i].corner = k % size;
        l[i].u = at[k % 6], l[i].v = at[k / 6 % 5];
    }
    return l;
}

static inline void every_exact(every *e)
{
    enum { COUNT = 4096 };
    const subdiv_mesh *cage = e->cage;
    subdiv_tessellation how = { 0 };
    subdiv_surface *surface;
    subdiv_stencils stencils;
    subdiv_mesh fine;
    how.rate = 4 * e->levels + 1;
    EVERY(e, subdiv_tessellate(&fine, cage, &how, e->opt));
    every_mesh(e, &fine);
    if (EVERY(e, subdiv_prepare(&surface, cage, SUBDIV_EXACT, e->opt)) && cage->face_count) {
        subdiv_location *locations = every_location(cage, COUNT);
        size_t size = 21 * sizeof(float) * COUNT;
        float *p = (float *)every_room(e, size);
        void *scratch = every_room(e, subdiv_scratch_size(surface, 3));
        subdiv_derivatives points = { p, p + 3, p + 6, p + 9, p + 12, p + 15, p + 18, 21 };
        EVERY(e, subdiv_evaluate_begin(surface, 3, cage->positions, 0, scratch, e->opt));
        EVERY(e, subdiv_evaluate_at(surface, 3, scratch, COUNT, locations, &points, e->opt));
        EVERY(e, subdiv_tangents_at(surface, scratch, COUNT, locations, p + 17, 21, e->opt));
        EVERY(e, subdiv_stencils_at(&stencils, surface, COUNT, locations, e->opt));
        every_stencils(e, &stencils);
        EVERY(e, subdiv_surface_tessellate(&fine, surface, cage->positions, &how, e->opt));
        every_mesh(e, &fine);
        free(scratch), free(locations);
        every_keep(e, p, size);
    }
    subdiv_surface_free(surface);
}

static inline void every_curve(every *e)
{
    int count = e->cage->vertex_count;
    int made = subdiv_curve_point_count(SUBDIV_CURVE_CHAIKIN, SUBDIV_ENDS_CLOSED, count, 2);
    size_t size = 3 * sizeof(float) * (size_t)made;
    float *points = (float *)every_room(e, size);
    EVERY(e, subdiv_curve(SUBDIV_CURVE_CHAIKIN, SUBDIV_ENDS_CLOSED, 2, 3, count,
                          e->cage->positions, 3, points, 3, e->opt));
    every_keep(e, points, size);
}

static inline size_t every_read(void *user, void *bytes, size_t size)
{
    const char **text = (const char **)user;
    size_t left = strlen(*text), got = left < size ? left : size;
    memcpy(bytes, *text, got);
    *text += got;
    return got;
}

static inline void every_file(every *e)
{
    const char *nowhere = "/dev/null", *text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    subdiv_surface *surface;
    subdiv_mesh loaded;
    EVERY(e, subdiv_load_obj_callback(&loaded, every_read, &text, e->opt));
    every_mesh(e, &loaded);
    EVERY(e, subdiv_load_obj(&loaded, nowhere, e->opt));        // an error: there is nothing in it
    EVERY(e, subdiv_save_obj_callback(e->cage, every_write, e, e->opt));
    EVERY(e, subdiv_save_obj(e->cage, nowhere, e->opt));
    if (EVERY(e, subdiv_prepare(&surface, e->cage, e->levels, e->opt)))
        EVERY(e, subdiv_stream_obj(surface, e->cage->positions, nowhere, e->opt));
    subdiv_surface_free(surface);
}

static inline void every_tool(every *e)
{
    subdiv_mesh copy = *e->cage, loaded;
    subdiv_info info;
    subdiv_explanation points;
    int counts[SUBDIV_ODDITY_COUNT];
    const int two = 2, ends[2] = { 0, 1 };
    const float sharpness = 4;
    size_t size = 0;
    char *text = (char *)every_room(e, 1 << 16);
    copy.memory = NULL;
    EVERY(e, subdiv_inspect(&info, e->cage, e->opt));
    every_add(e, &info, sizeof info);
    EVERY(e, subdiv_check(counts, e->cage, NULL, NULL, e->opt));
    every_add(e, counts, sizeof counts);
    if (EVERY(e, subdiv_explain_points(&points, e->cage, e->opt)))
        every_add(e, points.masks.weights, sizeof(float) * points.masks.offsets[points.count]);
    subdiv_explanation_free(&points);
    EVERY(e, subdiv_explain(text, 1 << 16, e->cage, e->cage->vertex_count / 2, e->opt));
    every_keep(e, text, strlen(text));
    EVERY(e, subdiv_normals(&copy, e->opt));
    EVERY(e, subdiv_normals_by_angle(&copy, 30, e->opt));
    EVERY(e, subdiv_crease_by_angle(&copy, 20, 1, e->opt));
    EVERY(e, subdiv_crease_by_uv_seams(&copy, 2, e->opt));
    EVERY(e, subdiv_crease_by_smoothing_groups(&copy, 3, e->opt));
    EVERY(e, subdiv_crease_chains(&copy, 1, &two, ends, 1, &sharpness, e->opt));
    EVERY(e, subdiv_join_values(counts, 1, 3, copy.positions, e->opt));
    every_add(e, counts, sizeof counts);
    EVERY(e, subdiv_save_obj_memory(&copy, NULL, 0, &size, e->opt));
    text = (char *)every_room(e, size);
    EVERY(e, subdiv_save_obj_memory(&copy, text, size, &size, e->opt));
    EVERY(e, subdiv_load_obj_memory(&loaded, text, size, e->opt));
    every_mesh(e, &loaded), every_mesh(e, &copy);
    every_keep(e, text, size);
}

// Returns a sum of all results.
static inline unsigned long long every_call(const subdiv_mesh *cage, int levels,
                                            const subdiv_options *opt,
                                            void (*after)(const char *call))
{
    every e = { cage, opt, levels, after, 1 };
    every_refinement(&e);
    every_exact(&e);
    every_curve(&e);
    every_file(&e);
    every_tool(&e);
    return e.sum;
}

#endif
