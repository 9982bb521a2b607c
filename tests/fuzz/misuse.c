// Misuse of the API: calls in any order, with NULL, negative counts, wrong ranges, buffers that are
// too small and surfaces that were prepared for something else. A call is an error if it has to be,
// writes then nothing but zeros, and never more than the arrays that it was given.
//
//     clang -g -O1 -DLIBFUZZER -fsanitize=fuzzer,address,undefined -I. tests/fuzz/misuse.c
//     cc -I. tests/fuzz/misuse.c -o fuzz_misuse -lm && ./fuzz_misuse 300 tests/fuzz/seeds/misuse/*

#include "fuzz.h"

enum { SURFACES = 4, STRIDE = 8, CHANNELS = 5, CALLS = 24 };

// A cube of triangles and quads, with some of everything.
static float P[] = { -1,-1,-1, 1,-1,-1, 1,1,-1, -1,1,-1, -1,-1,1, 1,-1,1, 1,1,1, -1,1,1, 3,3,3 };
static float S[] = { 2, 10 }, CS[] = { 1.5f }, UV[] = { 0,0, 1,0, 1,1, 0,1 };
static int sizes[] = { 4, 4, 4, 4, 4, 3, 3 }, E[] = { 4,5, 5,6 };
static int corners[] = { 0 }, holes[] = { 3 };
static int F[] = { 0,3,2,1, 4,5,6,7, 0,1,5,4, 1,2,6,5, 2,3,7,6, 3,0,4, 3,4,7 };
static int face_uvs[] = { 0,1,2,3, 0,1,2,3, 0,1,2,3, -1,-1,-1,-1, 0,1,2,3, 0,1,2, 0,2,3 };
static int statement_faces[] = { 0, 2 };
static char group[] = "g a", smooth[] = "s 1", *statements[] = { group, smooth };
enum { VERTICES = 9, FACES = 7, FACE_VERTICES = 26 };

typedef struct slot {
    subdiv_surface *surface;              // or NULL
    int points, faces, edges;             // of the result; of the cage
    int limit, exact, values;             // what it was prepared for
} slot;

static bytes input, *b = &input;
static slot slots[SURFACES];
static subdiv_mesh cage;
static int spoiled;                       // arguments of the call that make it an error
static subdiv_options plain, *opt;        // opt: of this call, or NULL

static void begin_call(void)
{
    plain = fresh_options();
    plain.triangulate = 1;
    opt = below(b, 8) == 7 ? NULL : &plain;
    spoiled = 0;
}

// Are the numbers of an array still those of floats?
static int untouched(const float *numbers, int points)
{
    for (int i = 0; i < STRIDE * points; i++) if (numbers[i] != 0.5f) return 0;
    return 1;
}

// What holds after each call. Returns whether it succeeded.
static int end_call(subdiv_result result)
{
    if (opt) settled(result);
    if (spoiled) REQUIRE(result != SUBDIV_OK);
    return result == SUBDIV_OK;
}

// Either a pointer that is needed, or NULL.
static void *needed(void *pointer)
{
    if (below(b, 8) < 7) return pointer;
    spoiled++;
    return NULL;
}

// A number that is right, or one of [low, high) that is not.
static int spoil(int right, int low, int high)
{
    int n = below(b, 6) == 5 ? any_int(b) : right;
    if (n >= low && n < high) return n;
    spoiled++;
    return n;
}

static const slot *a_slot(void)
{
    return &slots[below(b, SURFACES)];
}

// Levels that are right, or too many even for this little cage.
static int spoil_levels(int right, int low)
{
    int levels = spoil(right, low, 4);
    return levels > 3 ? levels | 32 : levels;
}

static int a_stride(int channels)         // at most STRIDE, or it would be a lie
{
    int stride = below(b, 4) ? 0 : any_int(b);
    if (stride > STRIDE) stride = STRIDE;
    spoiled += stride && stride < channels;
    return stride;
}

static void *scratch_for(const slot *s, int channels)
{
    size_t size = s->surface && channels > 0 ? subdiv_scratch_size(s->surface, channels) : 0;
    void *scratch = need(size);
    memset(scratch, below(b, 2) ? 0xff : 0x3f, size);
    return scratch;
}

static float *floats(int points)
{
    size_t count = STRIDE * (size_t)points;
    float *out = (float *)need(count * sizeof(float));
    for (size_t i = 0; i < count; i++) out[i] = 0.5f;
    return out;
}

// ------------------------------------------------------------------------------- making surfaces

static void prepare(void)
{
    slot *s = &slots[below(b, SURFACES)], made = {0};
    int levels = below(b, 4) - 1, values = below(b, 4) == 3, count, rule;
    subdiv_surface *surface = (subdiv_surface *)&cage, **to = (subdiv_surface **)needed(&surface);
    const subdiv_mesh *of = (const subdiv_mesh *)needed(&cage);
    int *indices = face_uvs;
    plain.limit = below(b, 2);
    plain.linear = below(b, 4) == 3;
    cage.scheme = (subdiv_scheme)below(b, 3);
    levels = spoil_levels(levels, -1);
    made.limit = opt && plain.limit && levels >= 0 && !values;
    made.exact = levels == SUBDIV_EXACT;
    made.values = values;
    subdiv_result result;
    if (values) {
        count = spoil(4, 4, VERTICES + 1);
        if (count > VERTICES) count = 3;  // not enough for the indices
        rule = spoil(2, 0, 6);
        indices = (int *)needed(indices);
        result = subdiv_prepare_face_varying(to, of, count, indices, (subdiv_uv_rule)rule, levels,
                                             opt);
    } else result = subdiv_prepare(to, of, levels, opt);
    if (!end_call(result)) {
        if (to) REQUIRE(!surface);
        return;
    }
    made.surface = surface;
    made.points = subdiv_surface_vertex_count(surface);
    made.faces = subdiv_surface_cage_face_count(surface);
    made.edges = subdiv_surface_edge_count(surface);
    subdiv_surface_free(s->surface);
    *s = made;
}

static void make_mesh(void)
{
    const slot *s = a_slot();
    subdiv_mesh fine, *to = (subdiv_mesh *)needed(&fine);
    subdiv_tessellation how = {0};
    const float *positions = (const float *)needed(P);
    int kind = below(b, 5);
    const subdiv_mesh *of = kind < 2 ? (const subdiv_mesh *)needed(&cage) : NULL;
    subdiv_result result;
    memset(&fine, 0x55, sizeof fine);
    how.rate = kind == 1 || kind == 3 ? spoil(2, 0, 2000) : 0;
    if (how.rate > 100) spoiled++;        // the heap is small
    if (kind < 2 && !positions) spoiled--;
    if (kind >= 2) spoiled += !s->surface || s->values || s->exact != (kind == 3);
    if (kind == 0) result = subdiv_refine(to, of, spoil_levels(1, 0), opt);
    else if (kind == 1) result = subdiv_tessellate(to, of, &how, opt);
    else if (kind == 3) result = subdiv_surface_tessellate(to, s->surface, positions, &how, opt);
    else result = subdiv_surface_mesh(to, s->surface, positions, opt);
    if (end_call(result)) check_mesh(&fine);
    else if (to) REQUIRE(mesh_is_zero(&fine));
    if (to) subdiv_mesh_free(&fine);
}

// A mesh is not refined into itself.
static void refine_itself(void)
{
    subdiv_mesh before = cage;
    subdiv_result result = below(b, 2) ? subdiv_refine(&cage, &cage, 1, opt)
                                       : subdiv_tessellate(&cage, &cage, NULL, opt);
    spoiled = 1;
    end_call(result);
    REQUIRE(memcmp(&before, &cage, sizeof cage) == 0);
}

// --------------------------------------------------------------------------- using them, or not so

static void getters(void)
{
    const slot *s = a_slot();
    int size = subdiv_surface_face_size(s->surface), count = subdiv_surface_face_count(s->surface);
    int *vertices = (int *)need(sizeof(int) * (size_t)size * (size_t)count);
    int *of = (int *)need(sizeof(int) * (size_t)count);
    int *ends = (int *)need(2 * sizeof(int) * (size_t)s->edges);
    spoiled += !s->surface;
    REQUIRE(s->surface || (!size && !count && !subdiv_scratch_size(NULL, 3)));
    REQUIRE((subdiv_surface_normal_count(s->surface) > 0) == s->limit);
    spoiled += s->exact || size == 0;
    int *to = (int *)needed(vertices);
    end_call(subdiv_surface_faces(s->surface, to, below(b, 2) ? of : NULL, opt));
    spoiled = !s->surface || s->exact || s->values;
    subdiv_location *places = (subdiv_location *)need(sizeof *places * (size_t)s->points);
    end_call(subdiv_surface_locations(s->surface, below(b, 2) ? places : NULL, NULL, opt));
    free(places);
    if (size) {                           // of level 0 there are others
        spoiled = !s->limit;
        to = (int *)needed(vertices);
        end_call(subdiv_surface_face_normals(s->surface, to, opt));
    }
    subdiv_surface_edges(s->surface, ends);
    REQUIRE(s->exact || all_in((int[]){ subdiv_first_inside(s->surface, any_int(b)) }, 1, 0,
                               s->points + 1));
    free(vertices), free(of), free(ends);
}

static void evaluate(void)
{
    const slot *s = a_slot();
    int channels = 1 + below(b, CHANNELS), in_stride = a_stride(channels), kind = below(b, 2);
    int out_stride = kind ? a_stride(channels) : 0;
    float *in = floats(VERTICES), *out = floats(s->points);
    void *scratch = scratch_for(s, channels), *lent = kind ? below(b, 2) ? scratch : NULL
                                                          : needed(scratch);
    const float *from = (const float *)needed(in);
    float *to = kind ? (float *)needed(out) : NULL;
    if (below(b, 16) == 15) {
        channels = any_int(b);            // without scratch, or it would be a lie
        lent = NULL;
        in_stride = out_stride = 0;
        spoiled++;
        if (channels > 0) channels |= 1 << 28;
    }
    spoiled += !s->surface || (kind && s->exact);
    int good = end_call(kind ?
        subdiv_evaluate(s->surface, channels, from, in_stride, to, out_stride, lent, opt) :
        subdiv_evaluate_begin(s->surface, channels, from, in_stride, lent, opt));
    REQUIRE((good || untouched(out, s->points)) && untouched(in, VERTICES));
    free(in), free(out), free(scratch);
}

// Returns how many of all there are from a first one on, which may be a wrong one.
static int rest(int all, int first) { return first < 0 ? all : all - first; }

// Of the points and faces that there are, or not; from scratch that nobody filled.
static void evaluate_part(void)
{
    const slot *s = a_slot();
    int limit = below(b, 2), channels = limit ? 3 : 1 + below(b, CHANNELS);
    int stride = a_stride(channels);
    float *p = floats(s->points), *n = floats(s->points), *t = floats(s->points);
    void *scratch = scratch_for(s, channels), *from = needed(scratch);
    int face = spoil(0, 0, s->faces + 1), left = rest(s->faces, face);
    int faces = spoil(left, 0, left + 1);
    int point = spoil(0, 0, s->points + 1);
    int points = spoil(rest(s->points, point), 0, rest(s->points, point) + 1);
    subdiv_limit where = { p, n, below(b, 2) ? t : NULL, stride, NULL }, *to = &where;
    if (limit) {
        to = (subdiv_limit *)needed(to);
        spoiled += to && to->tangents && stride && stride < 6;
    }
    spoiled += !s->surface || s->exact || (limit && !s->limit);
    int good = end_call(limit ?
        subdiv_evaluate_limit_faces(s->surface, from, face, faces, point, points, to, opt) :
        subdiv_evaluate_faces(s->surface, channels, from, face, faces, point, points,
                              (float *)needed(p), stride, opt));
    REQUIRE(good || (untouched(p, s->points) && untouched(n, s->points)));
    free(p), free(n), free(t), free(scratch);
}

static void evaluate_limit(void)
{
    const slot *s = a_slot();
    float *in = floats(VERTICES), *p = floats(s->points);
    int in_stride = a_stride(3);
    subdiv_limit where = { p, NULL, NULL, a_stride(3), NULL };
    spoiled += !s->surface || !s->limit || s->exact;
    int good = end_call(subdiv_evaluate_limit(s->surface, (const float *)needed(in), in_stride,
                                              (const subdiv_limit *)needed(&where), NULL, opt));
    REQUIRE(good || untouched(p, s->points));
    free(in), free(p);
}

// Locations, from scratch that nobody filled.
static void anywhere(void)
{
    const slot *s = a_slot();
    int channels = 1 + below(b, CHANNELS), stride = a_stride(channels), kind = below(b, 3);
    int face = spoil(0, 0, s->faces), corner = spoil(0, 0, 1), count = spoil(2, 0, 3);
    subdiv_location at[2] = { { face, corner, 0.25f, 0.5f }, { face, corner, 0, 1e-6f } };
    const subdiv_location *from = at;
    float *p = floats(2), *n = floats(2);
    subdiv_derivatives where = { p, p, p, p, p, p, NULL, stride };
    subdiv_stencils made;
    void *scratch = scratch_for(s, kind == 2 ? 3 : channels);
    if (count > 2) count = -count;        // or it would be a lie
    if (count == 0) spoiled = stride && stride < channels;      // then there is no location
    if (count) from = (const subdiv_location *)needed(at);
    if (below(b, 2)) where.normals = n;
    if (kind == 1) {
        spoiled -= stride && stride < channels;
        spoiled += !s->surface || !s->exact;
        memset(&made, 0x55, sizeof made);
        int good = end_call(subdiv_stencils_at(&made, s->surface, count, from, opt));
        if (!good) REQUIRE(is_zero(&made, sizeof made));
        subdiv_stencils_free(&made);
        subdiv_stencils_free(&made);
    } else if (kind == 2) {
        spoiled -= stride && stride < channels;
        spoiled += !s->surface || !s->exact || s->values || (stride && stride < 4);
        end_call(subdiv_tangents_at(s->surface, needed(scratch), count, from, p, stride, opt));
    } else {
        void *lent = needed(scratch);
        subdiv_derivatives *to = (subdiv_derivatives *)needed(&where);
        spoiled += to && to->normals && (channels < 3 || (stride && stride < 3));
        spoiled += !s->surface || !s->exact;
        end_call(subdiv_evaluate_at(s->surface, channels, lent, count, from, to, opt));
    }
    free(p), free(n), free(scratch);
}

static void stencils(void)
{
    const slot *s = a_slot();
    subdiv_stencils made, *to = (subdiv_stencils *)needed(&made);
    int point = spoil(0, 0, s->points + 1);
    int left = rest(s->points, point), points = spoil(left, 0, left + 1);
    memset(&made, 0x55, sizeof made);
    spoiled += !s->surface || s->exact;
    int good = end_call(subdiv_refined_stencils(to, s->surface, point, points, opt));
    if (to && !good) REQUIRE(is_zero(&made, sizeof made));
    if (to) subdiv_stencils_free(&made);
}

// Fills a buffer from the mesh that it was made of, or from any surface.
static void fill_buffer(const subdiv_buffer *buffer, const subdiv_mesh *fine)
{
    const slot *s = a_slot();
    int normals = s->limit ? subdiv_surface_normal_count(s->surface) : s->points;
    float *p = floats(buffer->vertex_count), *n = floats(buffer->vertex_count);
    begin_call();
    subdiv_vertices out = { p, below(b, 2) ? n : NULL, NULL, NULL, a_stride(3) };
    const subdiv_vertices *to = (const subdiv_vertices *)needed(&out);
    const subdiv_buffer *of = (const subdiv_buffer *)needed((void *)(size_t)buffer);
    int good;
    if (below(b, 2)) {
        const subdiv_mesh *from = (const subdiv_mesh *)needed((void *)(size_t)fine);
        spoiled += out.normals && !fine->normals;
        good = end_call(subdiv_fill_buffer(of, from, to, opt));
    } else {
        const float *positions = (const float *)needed(P);
        spoiled += !s->surface || s->exact || s->values || (out.normals && !s->limit) ||
                   s->points != buffer->point_count || normals != buffer->normal_count;
        good = end_call(subdiv_evaluate_buffer(of, s->surface, positions, to, NULL, opt));
    }
    REQUIRE(good || (untouched(p, buffer->vertex_count) && untouched(n, buffer->vertex_count)));
    free(p), free(n);
}

static void draw(void)
{
    const slot *s = a_slot();
    subdiv_mesh fine, other = {0};
    subdiv_buffer made, *to = (subdiv_buffer *)needed(&made);
    int size = spoil(4, 4, 5);
    if (size == 2) spoiled--;
    if (!s->surface || s->exact || s->values) return;
    REQUIRE(subdiv_surface_mesh(&fine, s->surface, P, NULL) == SUBDIV_OK);
    const subdiv_mesh *of = (const subdiv_mesh *)needed(below(b, 16) ? &fine : &other);
    spoiled += of == &other;
    memset(&made, 0x55, sizeof made);
    if (end_call(subdiv_make_buffer(to, of, size, opt))) {
        fill_buffer(&made, &fine);
        fill_buffer(&made, &fine);
    } else if (to) REQUIRE(is_zero(&made, sizeof made));
    if (to) subdiv_buffer_free(&made);
    subdiv_mesh_free(&fine);
}

static void curve(void)
{
    int rule = spoil(1, 0, 2), ends = spoil(2, 0, 3), levels = spoil_levels(2, 0);
    int count = spoil(VERTICES, 3, VERTICES + 1);
    int channels = 1 + below(b, CHANNELS), in_stride = a_stride(channels);
    int out_stride = a_stride(channels);
    float *in = floats(VERTICES), *out = floats(8 * VERTICES);
    if (count > VERTICES) count |= 1 << 30;                     // or it would be a lie
    if (levels == 0 && count > VERTICES) levels = 2;
    if (count == 1 || count == 2) spoiled -= ends != SUBDIV_ENDS_CUT;
    const float *from = (const float *)needed(in);
    int good = end_call(subdiv_curve((subdiv_curve_rule)rule, (subdiv_curve_ends)ends, levels,
                                     channels, count, from, in_stride, (float *)needed(out),
                                     out_stride, opt));
    REQUIRE(untouched(in, VERTICES) && (good || untouched(out, 8 * VERTICES)));
    free(in), free(out);
}

// ------------------------------------------------------------------------------------ other tools

static void tools(void)
{
    subdiv_info info;
    subdiv_mesh copy = cage, *of = (subdiv_mesh *)needed(&copy);
    int counts[SUBDIV_ODDITY_COUNT], good;
    char text[4096];
    size_t capacity = below(b, 2) ? sizeof text : (size_t)below(b, 40);
    float sharpness = below(b, 4) ? 1 : any_float(b), degrees = below(b, 4) ? 1 : any_float(b);
    memset(&info, 0x55, sizeof info);
    memset(text, 'x', sizeof text);
    copy.memory = NULL;
    int kind = below(b, 8), nan = sharpness != sharpness;
    switch (kind) {
    case 0:
        good = end_call(subdiv_inspect((subdiv_info *)needed(&info), of, opt));
        if (!good) REQUIRE(is_zero(&info, sizeof info) || info.vertex_count == 0x55555555);
        break;
    case 1:
        good = end_call(subdiv_check(below(b, 2) ? counts : NULL, of, NULL, NULL, opt));
        break;
    case 2:
        spoiled += capacity < 40;
        good = end_call(subdiv_explain((char *)needed(text), capacity, of, spoil(3, 0, 22), opt));
        REQUIRE(good || !capacity || text[0] == 0 || text[0] == 'x');
        for (size_t i = capacity; i < sizeof text; i++) REQUIRE(text[i] == 'x');
        break;
    case 3:
        end_call(subdiv_normals(of, opt));
        break;
    case 4:
        spoiled += nan || !(degrees >= 0 && degrees <= 180);
        end_call(subdiv_crease_by_angle(of, degrees, sharpness, opt));
        break;
    case 5:
        spoiled += nan;
        end_call(subdiv_crease_by_smoothing_groups(of, sharpness, opt));
        break;
    case 6:
        spoiled += !(degrees >= 0 && degrees <= 180);
        end_call(subdiv_normals_by_angle(of, degrees, opt));
        break;
    default:
        spoiled += nan;
        end_call(subdiv_crease_by_uv_seams(of, sharpness, opt));
    }
    if (of && copy.memory) subdiv_mesh_free(&copy);
    if (copy.memory == NULL && kind > 2 && spoiled && of)
        REQUIRE(memcmp(&copy, &cage, sizeof cage) == 0);
    subdiv_mesh_free(NULL);
    subdiv_stencils_free(NULL);
    subdiv_surface_free(NULL);
}

static void chains(void)
{
    subdiv_mesh copy = cage, *of = (subdiv_mesh *)needed(&copy);
    int size = spoil(2, 2, 3), count = spoil(1, 1, 2);
    float sharpness = below(b, 4) ? 1 : any_float(b);
    const int *ends = size > 2 ? NULL : (const int *)needed(E);     // or it would be a lie
    if (count > 1) spoiled--, count = 1;
    spoiled += sharpness != sharpness;
    copy.memory = NULL;
    end_call(subdiv_crease_chains(of, count, &size, ends, 1, &sharpness, opt));
    if (spoiled) REQUIRE(memcmp(&copy, &cage, sizeof cage) == 0);
    subdiv_mesh_free(&copy);
}

static void explain_points(void)
{
    subdiv_explanation points, *to = (subdiv_explanation *)needed(&points);
    memset(&points, 0x55, sizeof points);
    int good = end_call(subdiv_explain_points(to, (const subdiv_mesh *)needed(&cage), opt));
    if (to && !good) REQUIRE(is_zero(&points, sizeof points));
    if (to) subdiv_explanation_free(&points);
}

static void join(void)
{
    int firsts[4] = { 9, 9, 9, 9 }, channels = spoil(2, 1, 3), count = spoil(4, 0, 5);
    int *to = (int *)needed(firsts);
    const float *values = (const float *)needed(UV);
    if (count > 4) count = -count;        // or it would be a lie
    if (channels > 2) channels = -channels;
    if (count == 0) spoiled = channels < 1;
    end_call(subdiv_join_values(to, channels, count, values, opt));
    if (spoiled) REQUIRE(firsts[0] == 9 && firsts[3] == 9);
}

// -------------------------------------------------------------------------------------------- OBJ

static size_t no_read(void *user, void *to, size_t size)
{
    (void)to;
    return user && size ? (size_t)-1 : 0;
}

static size_t no_write(void *user, const void *from, size_t size)
{
    (void)from;
    return user ? size : size - 1;
}

static void load(void)
{
    subdiv_mesh mesh, *to = (subdiv_mesh *)needed(&mesh);
    subdiv_result result;
    memset(&mesh, 0x55, sizeof mesh);
    switch (below(b, 3)) {
    case 0:
        result = subdiv_load_obj_memory(to, needed("v 1 2 3\n"), 8, opt);
        break;
    case 1:
        result = subdiv_load_obj_callback(to, no_read, below(b, 2) ? &mesh : NULL, opt);
        spoiled++;
        break;
    default:
        result = subdiv_load_obj(to, (const char *)needed("no folder/no file"), opt);
        spoiled++;
    }
    int good = end_call(result);
    if (to && !good) REQUIRE(mesh_is_zero(&mesh));
    if (to) subdiv_mesh_free(&mesh);
}

static void save(void)
{
    const slot *s = a_slot();
    char text[2048];
    size_t size = 99, capacity = below(b, 2) ? sizeof text : (size_t)below(b, 256), *to = &size;
    void *memory = text, *user = below(b, 2) ? &size : NULL;
    const subdiv_mesh *of = (const subdiv_mesh *)needed(&cage);
    const float *positions = P;
    subdiv_result result;
    memset(text, 'x', sizeof text);
    int kind = below(b, 5);
    if (kind > 2 && !of) spoiled--;
    if (kind > 2) spoiled += !s->surface || s->values || s->exact;
    if (kind > 2) positions = (const float *)needed(P);
    switch (kind) {
    case 0:
        if (capacity) memory = needed(memory);
        spoiled += capacity && capacity < 256;
        to = (size_t *)needed(&size);
        result = subdiv_save_obj_memory(of, memory, capacity, to, opt);
        if (result && result != SUBDIV_ERROR_TOO_LARGE && to) REQUIRE(size == 0);
        for (size_t i = capacity; i < sizeof text; i++) REQUIRE(text[i] == 'x');
        break;
    case 1:
        spoiled += !user;
        result = subdiv_save_obj_callback(of, below(b, 4) ? no_write : (spoiled++, (subdiv_write)0),
                                          user, opt);
        break;
    case 2:
        spoiled++;
        result = subdiv_save_obj(of, (const char *)needed("no folder/no file"), opt);
        break;
    case 3:
        plain.part_count = user ? 3 : 0;  // a part may have nothing to write, and not fail at it
        plain.part = opt && user ? spoil(below(b, 3), 0, 3) : 0;
        spoiled += !user;
        result = subdiv_stream_obj_callback(s->surface, positions, no_write, user, opt);
        break;
    default:
        spoiled++;
        result = subdiv_stream_obj(s->surface, positions, (const char *)needed("no folder/no file"),
                                   opt);
    }
    end_call(result);
}

// -------------------------------------------------------------------------------------------- all

static subdiv_mesh new_cage(void)
{
    subdiv_mesh m = {0};
    m.vertex_count = VERTICES;    m.positions = P;
    m.face_count = FACES;         m.face_sizes = sizes;       m.face_vertices = F;
    m.crease_count = 2;           m.crease_vertices = E;      m.crease_sharpness = S;
    m.corner_count = 1;           m.corner_vertices = corners; m.corner_sharpness = CS;
    m.hole_count = 1;             m.holes = holes;
    m.uv_count = 4;               m.uvs = UV;                 m.face_uvs = face_uvs;
    m.colors = P;
    m.statement_count = 2;        m.statement_faces = statement_faces;
    m.statements = statements;
    return m;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    void (*const calls[])(void) = { prepare, make_mesh, evaluate, evaluate_part, anywhere, stencils,
                                    tools, prepare, evaluate_limit, load, save, getters, prepare,
                                    refine_itself, draw, curve, chains,
                                    explain_points, join };
    b->at = data;
    b->end = data + size;
    cage = new_cage();
    heap_most = 1u << 20;
    for (int i = 0; i < CALLS && b->at < b->end; i++) {
        begin_call();
        calls[below(b, sizeof calls / sizeof *calls)]();
    }
    for (int i = 0; i < SURFACES; i++) {
        slot none = {0};
        subdiv_surface_free(slots[i].surface);
        slots[i] = none;
    }
    REQUIRE(heap_live == 0);
    return 0;
}

#include "replay.h"
