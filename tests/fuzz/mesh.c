// Any mesh struct, legal or wild, through every public function. The bytes make the mesh, the
// options, and the ranges, windows, strides, locations and rates of the calls.
//
//     clang -g -O1 -DLIBFUZZER -fsanitize=fuzzer,address,undefined -I. tests/fuzz/mesh.c
//     cc -I. tests/fuzz/mesh.c -o fuzz_mesh -lm && ./fuzz_mesh 300 tests/fuzz/seeds/mesh/*

#include "fuzz.h"
#include "cage.h"

// ------------------------------------------------------------------------------------- the options

static subdiv_options how;

// Lends threads that take the jobs in the wrong order.
static void run_backwards(void *user, void (*job)(void *, int), void *context, int count)
{
    REQUIRE(user == &how && count > 1);
    while (count-- > 0) job(context, count);
}

static subdiv_options options(int threads)
{
    subdiv_options opt = fresh_options();
    subdiv_error *to = opt.error;
    opt = how;
    opt.error = to;
    opt.user = &how;
    opt.run = threads ? run_backwards : NULL;
    return opt;
}

// How far the values of the cage reach, as sums of them may; infinite if one is not a number.
static float reach_of(const float *values, size_t count)
{
    float most = 0;
    for (size_t i = 0; i < count; i++)
        most = values[i] == values[i] ? fmaxf(most, fabsf(values[i])) : HUGE_VALF;
    return most;
}

static float reach(void)
{
    return reach_of(c.positions, 3 * (size_t)c.vertices);
}

// How far results reach from values up to most: rules of one's own may go beyond them.
static float bound(float most)
{
    return (c.mesh.vertex_weights ? 10000 : 4) * most;
}

static int same_result(const subdiv_mesh *a, const subdiv_mesh *b)
{
    int normals = !a->normals ? 0 : a->face_normals ? a->normal_count : a->vertex_count;
    int sum = a->face_normals ? (int)face_vertex_sum(a) : 0;
    return same_mesh(a, b) && !a->normals == !b->normals && !a->face_normals == !b->face_normals &&
           same_bytes(a->normals, b->normals, 3 * normals, sizeof(float)) &&
           same_bytes(a->face_normals, b->face_normals, sum, sizeof(int)) &&
           same_bytes(a->cage_faces, b->cage_faces, a->face_count, sizeof(int));
}

// ------------------------------------------------------------------------------------ refinement

static void refine_again(const subdiv_mesh *fine, int levels)
{
    subdiv_info info;
    subdiv_mesh twice, once;
    subdiv_options opt = options(0);
    REQUIRE(settled(subdiv_inspect(&info, fine, &opt)));
    if (opt.limit && lent.vertex_weights) return;      // new valences may have weights of no limit
    REQUIRE(settled_mesh(subdiv_refine(&twice, fine, 1, &opt), &twice));
    REQUIRE(settled_mesh(subdiv_refine(&once, &lent, levels + 1, &opt), &once));
    REQUIRE(settled(subdiv_inspect(&info, &lent, &opt)));
    if (!info.nonmanifold_edge_count && lent.scheme != SUBDIV_LOOP && !opt.limit &&
        lent.boundary != SUBDIV_BOUNDARY_NONE &&
        (!lent.hole_count || opt.keep_holes) && reach() < 1e6f && reach() > 1e-6f) {
        REQUIRE(once.vertex_count == twice.vertex_count && once.face_count == twice.face_count);
        REQUIRE(points_apart(once.positions, twice.positions, once.vertex_count, 3) <
                1e-5 * (double)reach());
    }
    subdiv_mesh_free(&once);
    subdiv_mesh_free(&twice);
}

static void door_refine(bytes *b)
{
    int levels = below(b, 4), fit = 0;
    subdiv_mesh fine, other;
    subdiv_surface *surface = (subdiv_surface *)&fine;
    subdiv_options opt = options(0);
    memset(&fine, 0x55, sizeof fine);
    memset(&other, 0, sizeof other);
    int made = settled_mesh(subdiv_refine(&fine, &lent, levels, &opt), &fine);
    opt = options(1);
    int prepared = settled(subdiv_prepare(&surface, &lent, levels, &opt));
    if (prepared)
        fit = settled_mesh(subdiv_surface_mesh(&other, surface, lent.positions, &opt), &other);
    else REQUIRE(!surface);
    REQUIRE(made == (prepared && fit));
    if (made) {
        REQUIRE(same_result(&fine, &other));
        REQUIRE(all_in(fine.cage_faces, (size_t)fine.face_count, 0, lent.face_count));
        REQUIRE(fine.vertex_count == subdiv_surface_vertex_count(surface));
        REQUIRE(fine.face_count == subdiv_surface_face_count(surface));
        REQUIRE(reach_of(fine.positions, 3 * (size_t)fine.vertex_count) <= bound(reach()));
        if (levels < 2) refine_again(&fine, levels);
    }
    subdiv_surface_free(surface);
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&other);
}

// ------------------------------------------------------------------------- refinement into arrays

static float *make_values(bytes *b, int stride, int count)
{
    float *values = (float *)need((size_t)stride * (size_t)count * sizeof(float));
    for (int i = 0; i < stride * count; i++) values[i] = (float)(take(b) + i % 7) / 16;
    return values;
}

// An array without values; what stands between those that a call writes has to stay.
static float *make_out(int stride, int count)
{
    size_t size = (size_t)stride * (size_t)count * sizeof(float);
    float *out = (float *)need(size);
    memset(out, 0x7e, size);
    return out;
}

// What a call wrote is the whole, from a point on; between it there is what was there before.
static void check_part(const float *part, const float *whole, int first, int count, int stride,
                       int channels)
{
    uint32_t bits;
    for (int i = 0; i < count; i++) {
        REQUIRE(memcmp(part + (size_t)i * (size_t)stride,
                       whole + (size_t)(first + i) * (size_t)channels,
                       (size_t)channels * sizeof(float)) == 0);
        for (int k = channels; k < stride; k++) {
            memcpy(&bits, part + (size_t)i * (size_t)stride + k, sizeof bits);
            REQUIRE(bits == 0x7e7e7e7e);
        }
    }
}

// Makes part of the points, from all faces in two ranges.
static void make_part(const subdiv_surface *s, int channels, const void *scratch, bytes *b,
                      const float *whole)
{
    int faces = subdiv_surface_cage_face_count(s), points = subdiv_surface_vertex_count(s);
    int first = below(b, points + 1), count = below(b, points - first + 1);
    int cut = below(b, faces + 1), stride = channels + below(b, 3);
    float *out = make_out(stride, count);
    subdiv_options opt = options(below(b, 2));
    REQUIRE(settled(subdiv_evaluate_faces(s, channels, scratch, cut, faces - cut, first, count, out,
                                          stride, &opt)));
    REQUIRE(settled(subdiv_evaluate_faces(s, channels, scratch, 0, cut, first, count, out,
                                          stride, &opt)));
    check_part(out, whole, first, count, stride, channels);
    REQUIRE(!settled(subdiv_evaluate_faces(s, channels, scratch, 0, faces + 1, 0, points, out,
                                           stride, &opt)) && error.code == SUBDIV_ERROR_INDEX);
    free(out);
}

// Sums up values, a channel of in, by stencil i, with indices below count. largest: of its weights.
static double sum_stencil(const subdiv_stencils *s, int i, const float *in, int stride, int count,
                          double *largest)
{
    double sum = 0, value = 0;
    *largest = 1;
    for (size_t k = s->offsets[i]; k < s->offsets[i + 1]; k++) {
        int last = k > s->offsets[i] ? s->indices[k - 1] : -1;
        REQUIRE(all_in(s->indices + k, 1, last + 1, count));
        sum += (double)s->weights[k];
        *largest = fmax(*largest, fabs((double)s->weights[k]));
        value += (double)s->weights[k] * (double)in[(size_t)s->indices[k] * (size_t)stride];
    }
    REQUIRE(s->offsets[i] == s->offsets[i + 1] || fabs(sum - 1) <= 1e-6 * *largest);
    return value;
}

// The stencils of some points sum up the values to those points.
static void check_stencils(const subdiv_surface *s, int inputs, const float *in, int stride,
                           const float *whole, int channels, bytes *b)
{
    int points = subdiv_surface_vertex_count(s), first = below(b, points + 1);
    int count = below(b, points - first + 1);
    double largest;
    subdiv_stencils made;
    subdiv_options opt = options(0);
    memset(&made, 0x55, sizeof made);
    REQUIRE(settled(subdiv_refined_stencils(&made, s, first, count, &opt)));
    REQUIRE(made.count == count && made.offsets[0] == 0);
    for (int i = 0; i < count; i++) {
        double value = sum_stencil(&made, i, in, stride, inputs, &largest);
        double point = (double)whole[(size_t)(first + i) * (size_t)channels];
        REQUIRE(fabs(value - point) <= 1e-4 * largest);
    }
    subdiv_stencils_free(&made);
    REQUIRE(is_zero(&made, sizeof made));
}

// What is true of the sizes and faces of a result. inputs: the numbers that a value may have.
static void check_surface(const subdiv_surface *s)
{
    int points = subdiv_surface_vertex_count(s), faces = subdiv_surface_face_count(s);
    int size = subdiv_surface_face_size(s), edges = subdiv_surface_edge_count(s);
    int *vertices = (int *)need((size_t)size * (size_t)faces * sizeof(int));
    int *of = (int *)need((size_t)faces * sizeof(int));
    int *ends = (int *)need(2 * (size_t)edges * sizeof(int));
    subdiv_options opt = options(0);
    if (settled(subdiv_surface_faces(s, vertices, of, &opt))) {
        REQUIRE(all_in(vertices, (size_t)size * (size_t)faces, -1, points));
        REQUIRE(all_in(of, (size_t)faces, 0, lent.face_count));
    } else REQUIRE(size == 0);
    subdiv_surface_edges(s, ends);
    REQUIRE(all_in(ends, 2 * (size_t)edges, 0, points));
    for (int e = 0; e < edges; e++) REQUIRE(ends[2 * e] <= ends[2 * e + 1]);
    for (int f = 0, last = 0; f <= subdiv_surface_cage_face_count(s); f++) {
        int inside = subdiv_first_inside(s, f);
        REQUIRE(inside >= last && inside <= points);
        last = inside;
    }
    free(vertices), free(of), free(ends);
}

static void evaluate(const subdiv_surface *s, int inputs, bytes *b)
{
    int channels = 1 + below(b, 9), in_stride = channels + below(b, 3);
    int points = subdiv_surface_vertex_count(s);
    size_t size = subdiv_scratch_size(s, channels);
    float *in = make_values(b, in_stride, inputs), *whole = make_out(channels, points);
    float *again = make_out(channels, points);
    void *scratch = need(size);
    subdiv_options opt = options(0);
    memset(scratch, 0xff, size);
    check_surface(s);
    REQUIRE(settled(subdiv_evaluate(s, channels, in, in_stride, whole, 0, NULL, &opt)));
    REQUIRE(all_within(whole, (size_t)channels * (size_t)points, bound(17)));
    opt = options(1);
    REQUIRE(settled(subdiv_evaluate(s, channels, in, in_stride, again, channels, scratch, &opt)));
    check_part(again, whole, 0, points, channels, channels);
    memset(scratch, 0xff, size);
    REQUIRE(settled(subdiv_evaluate_begin(s, channels, in, in_stride, scratch, &opt)));
    make_part(s, channels, scratch, b, whole);
    make_part(s, channels, scratch, b, whole);
    check_stencils(s, inputs, in, in_stride, whole, channels, b);
    free(in), free(whole), free(again), free(scratch);
}

static void door_evaluate(bytes *b)
{
    subdiv_surface *s = (subdiv_surface *)&lent;
    subdiv_options opt = options(0);
    if (settled(subdiv_prepare(&s, &lent, below(b, 4), &opt))) evaluate(s, lent.vertex_count, b);
    else REQUIRE(!s);
    subdiv_surface_free(s);
}

static void door_values(bytes *b)
{
    int count = below(b, 2 + c.vertices), *indices = (int *)need((size_t)c.sum * sizeof(int));
    int levels = below(b, 4), gaps = below(b, 2);
    subdiv_uv_rule rule = (subdiv_uv_rule)below(b, 6 + wild);
    subdiv_surface *s = (subdiv_surface *)&lent;
    subdiv_options opt = options(0);
    for (int i = 0; i < c.sum; i++)
        indices[i] = wild && chance(b, 64) ? any_int(b)
                   : gaps && chance(b, 8) ? -1 : c.face_vertices[i] % (count ? count : 1);
    if (settled(subdiv_prepare_face_varying(&s, &lent, count, indices, rule, levels, &opt)))
        evaluate(s, count, b);
    else REQUIRE(!s);
    subdiv_surface_free(s);
    free(indices);
}

// -------------------------------------------------------------------------------------- the limit

// A vertex buffer has the points and normals of the mesh, as long as none of them moves.
static void draw(const subdiv_surface *s, const subdiv_mesh *fine, bytes *b)
{
    int size = below(b, 2) ? 2 : 4, stride = 3 + below(b, 3);
    subdiv_buffer buffer;
    subdiv_options opt = options(0);
    memset(&buffer, 0x55, sizeof buffer);
    if (!settled(subdiv_make_buffer(&buffer, fine, size, &opt))) {
        REQUIRE(error.code == SUBDIV_ERROR_TOO_LARGE && is_zero(&buffer, sizeof buffer));
        return;
    }
    int count = buffer.vertex_count, normals = subdiv_surface_normal_count(s);
    float *p = make_out(stride, count), *n = make_out(stride, count), *t = make_out(stride, count);
    float *moved = make_out(stride, count), *turned = make_out(stride, count);
    subdiv_vertices out = { p, n, fine->uv_count ? t : NULL, NULL, stride };
    subdiv_vertices again = { moved, turned, NULL, NULL, stride };
    REQUIRE(count >= fine->vertex_count && buffer.index_size == size);
    REQUIRE(all_in(buffer.points, (size_t)count, 0, fine->vertex_count));
    REQUIRE(all_in(buffer.normals, (size_t)count, 0, normals));
    for (int i = 0; i < buffer.index_count; i++)
        REQUIRE((size == 2 ? ((unsigned short *)buffer.indices)[i] : ((int *)buffer.indices)[i]) <
                count);
    REQUIRE(settled(subdiv_fill_buffer(&buffer, fine, &out, &opt)));
    REQUIRE(settled(subdiv_evaluate_buffer(&buffer, s, lent.positions, &again, NULL, &opt)));
    REQUIRE(memcmp(p, moved, (size_t)stride * (size_t)count * sizeof *p) == 0);
    REQUIRE(memcmp(n, turned, (size_t)stride * (size_t)count * sizeof *n) == 0);
    free(p), free(n), free(t), free(moved), free(turned);
    subdiv_buffer_free(&buffer);
    REQUIRE(is_zero(&buffer, sizeof buffer));
}

static int on_cage(const subdiv_location *at, int faces)
{
    int whole = at->face < 0 || faces != lent.face_count;       // Loop's triangles, of larger faces
    int size = whole ? 3 : size_of_face(&lent, at->face);
    return at->face < faces && at->corner >= 0 && at->corner < size && at->u >= 0 && at->u <= 1 &&
           at->v >= 0 && at->v <= 1;
}

// Where the points and face-vertices of a result are, and which normals the latter have.
static void place(const subdiv_surface *s, const subdiv_mesh *fine)
{
    int faces = subdiv_surface_cage_face_count(s), sum = (int)face_vertex_sum(fine);
    subdiv_location *at = (subdiv_location *)need((size_t)fine->vertex_count * sizeof *at);
    subdiv_location *of_faces = (subdiv_location *)need((size_t)sum * sizeof *of_faces);
    int *normals = (int *)need((size_t)sum * sizeof *normals);
    subdiv_options opt = options(0);
    REQUIRE(settled(subdiv_surface_locations(s, at, of_faces, &opt)));
    for (int i = 0; i < fine->vertex_count; i++)
        REQUIRE(at[i].face >= -1 && on_cage(at + i, faces));
    for (int i = 0; i < sum; i++) REQUIRE(of_faces[i].face >= 0 && on_cage(of_faces + i, faces));
    opt = options(1);
    REQUIRE(settled(subdiv_surface_face_normals(s, normals, &opt)));
    REQUIRE(same_bytes(normals, fine->face_normals ? fine->face_normals : fine->face_vertices, sum,
                       sizeof(int)));
    free(at), free(of_faces), free(normals);
}

static void door_limit(bytes *b)
{
    subdiv_surface *s = NULL;
    subdiv_options opt = options(0);
    how.limit = opt.limit = 1;
    if (!settled(subdiv_prepare(&s, &lent, below(b, 4), &opt))) return;
    int points = subdiv_surface_vertex_count(s), faces = subdiv_surface_cage_face_count(s);
    int first = below(b, points + 1), count = below(b, points - first + 1);
    int stride = 6 + below(b, 3);
    int others = subdiv_surface_normal_count(s) - points;
    float *p = make_out(3, points), *n = make_out(3, points), *t = make_out(6, points);
    float *sides = make_out(3, others), *part_sides = make_out(stride, others);
    float *part_p = make_out(stride, count), *part_n = make_out(stride, count);
    float *part_t = make_out(stride, count);
    void *scratch = need(subdiv_scratch_size(s, 3));
    subdiv_limit whole = { p, n, t, 0, sides };
    subdiv_limit part = { part_p, part_n, part_t, stride, part_sides };
    subdiv_mesh fine;
    if (lent.positions && reach() < 1e30f) {
        REQUIRE(settled(subdiv_evaluate_limit(s, lent.positions, 0, &whole, NULL, &opt)));
        REQUIRE(settled(subdiv_evaluate_begin(s, 3, lent.positions, 3, scratch, &opt)));
        opt = options(1);
        REQUIRE(settled(subdiv_evaluate_limit_faces(s, scratch, 0, faces, first, count, &part,
                                                    &opt)));
        check_part(part_p, p, first, count, stride, 3);
        check_part(part_n, n, first, count, stride, 3);
        check_part(part_t, t, first, count, stride, 6);
        check_part(part_sides, sides, 0, others, stride, 3);
        for (int i = 0; i < others; i++) REQUIRE(is_normal(sides + 3 * (size_t)i));
        for (int i = 0; i < points; i++) REQUIRE(is_normal(n + 3 * (size_t)i));
        REQUIRE(all_within(p, 3 * (size_t)points, bound(reach())));
        REQUIRE(all_within(t, 6 * (size_t)points, FLT_MAX));
        if (settled_mesh(subdiv_surface_mesh(&fine, s, lent.positions, &opt), &fine)) {
            REQUIRE(same_bytes(fine.positions, p, 3 * points, sizeof(float)));
            REQUIRE(same_bytes(fine.normals, n, 3 * points, sizeof(float)));
            REQUIRE(same_bytes(fine.normals + 3 * points, sides, 3 * others, sizeof(float)));
            draw(s, &fine, b);
            place(s, &fine);
        }
        subdiv_mesh_free(&fine);
    }
    free(p), free(n), free(t), free(part_p), free(part_n), free(part_t), free(scratch);
    free(sides), free(part_sides);
    evaluate(s, lent.vertex_count, b);
    subdiv_surface_free(s);
}

// ------------------------------------------------------------------------------------- anywhere

enum { LOCATIONS = 8 };

static float a_parameter(bytes *b)
{
    static const float usual[] = { 0, 1, 0.5f, 0.25f, 0.75f, 1e-5f, 1e-20f, 0.99999994f };
    int i = below(b, 16);
    return i < 8 ? usual[i] : i == 8 && wild ? any_float(b) : (float)take(b) / 255;
}

static subdiv_location a_location(bytes *b, int faces)
{
    subdiv_location at = { below(b, faces), 0, a_parameter(b), a_parameter(b) };
    int size = faces == c.faces ? c.face_sizes[at.face] : 4;
    if (lent.scheme == SUBDIV_LOOP && !wild) at.v = fminf(at.v, 1 - at.u);
    else if (size != 4) at.corner = below(b, size);
    if (wild && chance(b, 8)) at.face = any_int(b);
    if (wild && chance(b, 8)) at.corner = any_int(b);
    return at;
}

// The points and their stencils, all at once and one by one. inputs: vertices or values of in.
static void sample(const subdiv_surface *s, int inputs, const float *in, int channels, bytes *b)
{
    enum { MOST = 8 };
    float values[6][MOST * LOCATIONS], normals[3 * LOCATIONS], one[MOST], one_normal[3];
    float tangents[4 * LOCATIONS];
    subdiv_location at[LOCATIONS];
    int count = 1 + below(b, LOCATIONS), faces = subdiv_surface_cage_face_count(s);
    size_t size = subdiv_scratch_size(s, channels);
    void *scratch = need(size);
    subdiv_derivatives out = { values[0], values[1], values[2], values[3], values[4], values[5],
                               channels > 2 ? normals : NULL, 0 };
    subdiv_stencils made;
    subdiv_options opt = options(1);
    for (int i = 0; i < count; i++) at[i] = a_location(b, faces);
    if (faces == 0 && !wild) count = 0;
    memset(scratch, 0xff, size);
    REQUIRE(settled(subdiv_evaluate_begin(s, channels, in, 0, scratch, &opt)));
    int good = settled(subdiv_evaluate_at(s, channels, scratch, count, at, &out, &opt));
    REQUIRE(good || (wild && (error.code == SUBDIV_ERROR_INDEX ||
                              error.code == SUBDIV_ERROR_ARGUMENT)));
    memset(&made, 0x55, sizeof made);
    REQUIRE(settled(subdiv_stencils_at(&made, s, count, at, &opt)) == good);
    if (!good) REQUIRE(is_zero(&made, sizeof made));
    float most = reach_of(in, (size_t)channels * (size_t)inputs);
    int any = good && channels == 3 && settled(subdiv_tangents_at(s, scratch, count, at, tangents,
                                                                  0, &opt));
    for (int i = 0; i < 4 * count && any; i += 4)
        REQUIRE(tangents[i + 3] == 0 ? is_zero(tangents + i, 12)
                                     : fabsf(tangents[i + 3]) == 1 && is_normal(tangents + i));
    for (int i = 0; i < count && good; i++) {
        subdiv_derivatives out_one = { one, NULL, NULL, NULL, NULL, NULL,
                                       channels > 2 ? one_normal : NULL, 0 };
        REQUIRE(settled(subdiv_evaluate_at(s, channels, scratch, 1, at + i, &out_one, &opt)));
        REQUIRE(memcmp(one, values[0] + i * channels, (size_t)channels * sizeof(float)) == 0);
        REQUIRE(all_within(one, (size_t)channels, bound(most)));
        if (channels > 2) {
            REQUIRE(is_normal(one_normal));
            REQUIRE(memcmp(one_normal, normals + 3 * i, sizeof one_normal) == 0);
        }
        double largest, value = sum_stencil(&made, i, in, channels, inputs, &largest);
        REQUIRE(fabs(value - (double)one[0]) <= 1e-5 * largest * (double)most + FLT_MIN);
    }
    subdiv_stencils_free(&made);
    free(scratch);
}

// At the corners of faces there are the vertices of the limit.
static void meet_limit(const subdiv_surface *s)
{
    subdiv_mesh limit;
    subdiv_options opt = options(0);
    opt.limit = 1;
    void *scratch = need(subdiv_scratch_size(s, 3));
    REQUIRE(settled_mesh(subdiv_refine(&limit, &lent, 0, &opt), &limit));
    REQUIRE(settled(subdiv_evaluate_begin(s, 3, lent.positions, 3, scratch, &opt)));
    const int *v = lent.face_vertices;
    for (int f = 0; f < lent.face_count; v += size_of_face(&lent, f++))
        for (int i = 0; i < size_of_face(&lent, f); i++) {
            static const float u[4] = { 0, 1, 1, 0 }, w[4] = { 0, 0, 1, 1 };
            int loop = lent.scheme == SUBDIV_LOOP, quad = size_of_face(&lent, f) == 4;
            subdiv_location at = { f, quad || loop ? 0 : i, quad ? u[i] : 0, quad ? w[i] : 0 };
            float p[3], n[3];
            subdiv_derivatives out = { p, NULL, NULL, NULL, NULL, NULL, n, 0 };
            if (loop) at.u = i == 1, at.v = i == 2;
            REQUIRE(settled(subdiv_evaluate_at(s, 3, scratch, 1, &at, &out, &opt)));
            if (is_zero(p, sizeof p) && is_zero(n, sizeof n)) continue;         // no surface
            for (int k = 0; k < 3; k++)
                REQUIRE(fabsf(p[k] - limit.positions[3 * v[i] + k]) <= 1e-5f * reach() + FLT_MIN);
        }
    subdiv_mesh_free(&limit);
    free(scratch);
}

static void door_exact(bytes *b)
{
    int channels = 1 + below(b, 8), values = below(b, 4) == 3;
    subdiv_surface *s = (subdiv_surface *)&lent;
    subdiv_options opt = options(0);
    subdiv_result result = values && c.sum ?
        subdiv_prepare_face_varying(&s, &lent, c.vertices, lent.face_vertices,
                                    (subdiv_uv_rule)below(b, 6), SUBDIV_EXACT, &opt) :
        subdiv_prepare(&s, &lent, SUBDIV_EXACT, &opt);
    if (settled(result)) {
        float *in = make_values(b, channels, c.vertices);
        sample(s, c.vertices, in, channels, b);
        free(in);
        int cut = lent.scheme == SUBDIV_LOOP && c.sum != 3 * c.faces;
        if (!wild && !values && !cut && !how.linear && reach() < 1e30f) meet_limit(s);
    } else REQUIRE(!s);
    subdiv_surface_free(s);
}

// ---------------------------------------------------------------------------------- tessellation

static int last_edge;

static int rate_of_edge(void *user, int edge, const float *a, const float *middle, const float *b)
{
    REQUIRE(edge > last_edge && all_within(a, 3, FLT_MAX) && all_within(middle, 3, FLT_MAX) &&
            all_within(b, 3, FLT_MAX));
    last_edge = edge;
    return (edge * 7 + *(const int *)user) % 6;
}

// Rates that make billions of points, but not too many, would only take long.
static int a_rate(bytes *b)
{
    int rate = wild && chance(b, 16) ? any_int(b) : below(b, 6);
    return rate > 65535 ? INT_MAX : rate;
}

static int *some_rates(bytes *b, int count)
{
    int *rates = below(b, 2) ? (int *)need((size_t)count * sizeof(int)) : NULL;
    for (int i = 0; i < count && rates; i++) rates[i] = a_rate(b);
    return rates;
}

static void door_tessellate(bytes *b)
{
    subdiv_surface *s = (subdiv_surface *)&lent;
    subdiv_mesh fine, other;
    subdiv_tessellation tiles = {0};
    subdiv_options opt = options(0);
    int salt = take(b), prepared = settled(subdiv_prepare(&s, &lent, SUBDIV_EXACT, &opt)), made = 0;
    int *edges = some_rates(b, prepared ? subdiv_surface_edge_count(s) : 0);
    int *faces = some_rates(b, c.faces);
    tiles.rate = a_rate(b);
    tiles.edge_rates = prepared ? edges : NULL;
    tiles.face_rates = faces;
    tiles.edge_rate = below(b, 4) ? NULL : rate_of_edge;
    tiles.user = &salt;
    tiles.triangles = below(b, 2);
    memset(&fine, 0x55, sizeof fine);
    memset(&other, 0, sizeof other);
    heap_most = 1u << 22;
    last_edge = -1;
    subdiv_result result = subdiv_tessellate(&fine, &lent, &tiles, &opt);
    int whole = settled_mesh(result, &fine), refused = result == SUBDIV_ERROR_MEMORY;
    last_edge = -1;
    opt = options(1);
    result = !prepared ? SUBDIV_OK :
        subdiv_surface_tessellate(&other, s, lent.positions, &tiles, &opt);
    if (prepared) made = settled_mesh(result, &other);
    REQUIRE(made == whole || refused || result == SUBDIV_ERROR_MEMORY);
    if (whole && made) {
        REQUIRE(same_result(&fine, &other));
        REQUIRE(all_in(fine.cage_faces, (size_t)fine.face_count, 0, lent.face_count));
        REQUIRE(reach_of(fine.positions, 3 * (size_t)fine.vertex_count) <= bound(reach()));
    }
    heap_most = 1u << 28;
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&other);
    subdiv_surface_free(s);
    free(edges), free(faces);
}

// ----------------------------------------------------------------------------------------- tools

static int reported[SUBDIV_ODDITY_COUNT];

static void report(void *user, const subdiv_finding *finding)
{
    REQUIRE(user == reported && finding->kind >= 0 && finding->kind < SUBDIV_ODDITY_COUNT);
    REQUIRE(finding->face >= -1 && finding->face < lent.face_count);
    REQUIRE(finding->other_face >= -1 && finding->other_face < lent.face_count);
    REQUIRE(finding->vertex >= -1 && finding->vertex < lent.vertex_count);
    REQUIRE(finding->other_vertex >= -1 && finding->other_vertex < lent.vertex_count);
    REQUIRE(finding->text[0]);
    for (int k = finding->kind + 1; k < SUBDIV_ODDITY_COUNT; k++) REQUIRE(!reported[k]);
    reported[finding->kind]++;
}

static void look(void)
{
    subdiv_info info;
    int counts[SUBDIV_ODDITY_COUNT];
    subdiv_options opt = options(0);
    memset(&info, 0x55, sizeof info);
    memset(counts, 0x55, sizeof counts);
    memset(reported, 0, sizeof reported);
    int good = settled(subdiv_inspect(&info, &lent, &opt));
    REQUIRE(settled(subdiv_check(counts, &lent, report, reported, &opt)) == good);
    REQUIRE(memcmp(counts, reported, sizeof counts) == 0);
    if (good) {
        REQUIRE(info.vertex_count == lent.vertex_count && info.face_count == lent.face_count);
        REQUIRE(info.triangle_count + info.quad_count + info.ngon_count == info.face_count);
        REQUIRE(info.infinite_crease_count <= info.crease_count);
        REQUIRE(info.crease_count <= info.edge_count && info.hole_count <= info.face_count);
        REQUIRE(info.isolated_vertex_count == counts[SUBDIV_ODD_UNUSED_VERTEX]);
    } else REQUIRE(is_zero(&info, sizeof info) && is_zero(counts, sizeof counts));
}

static void explain(bytes *b)
{
    int point = wild && chance(b, 4) ? any_int(b) : below(b, 1000);
    size_t capacity = chance(b, 4) ? (size_t)take(b) : 1u << 15;
    char *text = (char *)need(capacity);
    subdiv_options opt = options(0);
    memset(text, 'x', capacity);
    if (settled(subdiv_explain(text, capacity, &lent, point, &opt))) {
        REQUIRE(memchr(text, 0, capacity) && text[0]);
        for (const char *line = text; *line; line++) {
            size_t length = strcspn(line, "\n");
            REQUIRE(length <= 80 && line[length] == '\n');
            line += length;
        }
    } else REQUIRE(capacity == 0 || text[0] == 0);
    free(text);
    subdiv_explanation e;
    if (!settled(subdiv_explain_points(&e, &lent, &opt))) {
        REQUIRE(is_zero(&e, sizeof e));
        return;
    }
    REQUIRE(e.count == e.masks.count && e.count >= lent.vertex_count);
    for (int i = 0; i < e.count; i++) {
        REQUIRE(e.points[i].parent >= 0 && e.points[i].weight >= 0 && e.points[i].weight <= 1);
        REQUIRE(e.masks.offsets[i] < e.masks.offsets[i + 1]);
    }
    subdiv_explanation_free(&e);
}

// Changes copies of the struct: a failure leaves them as they were, and the arrays stay.
static void change(bytes *b)
{
    subdiv_mesh with = lent, before;
    float angle = chance(b, 4) ? any_float(b) : (float)take(b), sharpness = a_sharpness(b);
    const int ends[] = { 0, lent.vertex_count - 1, 0 }, three = 3;
    for (int i = 0; i < 6; i++) {
        subdiv_options opt = options(0);
        with.normals = i % 5 ? with.normals : NULL;
        before = with;
        subdiv_result result = i == 0 ? subdiv_normals(&with, &opt)
                             : i == 1 ? subdiv_crease_by_angle(&with, angle, sharpness, &opt)
                             : i == 2 ? subdiv_crease_by_smoothing_groups(&with, sharpness, &opt)
                             : i == 3 ? subdiv_crease_by_uv_seams(&with, sharpness, &opt)
                             : i == 4 ? subdiv_crease_chains(&with, 1, &three, ends, 1, &sharpness,
                                                             &opt)
                             : subdiv_normals_by_angle(&with, angle, &opt);
        if (!settled(result)) {
            REQUIRE(memcmp(&with, &before, sizeof with) == 0);
            continue;
        }
        REQUIRE(with.crease_count >= before.crease_count);
        REQUIRE(all_in(with.crease_vertices, 2 * (size_t)with.crease_count, 0, with.vertex_count));
        for (int n = 0; n < with.normal_count && i % 5 == 0; n++)
            REQUIRE(is_normal(with.normals + 3 * (size_t)n));
    }
    subdiv_mesh_free(&with);
    REQUIRE(mesh_is_zero(&with));
}

// A curve through some vertices stays among them.
static void bend(bytes *b)
{
    subdiv_curve_rule rule = (subdiv_curve_rule)below(b, 2 + wild);
    subdiv_curve_ends ends = (subdiv_curve_ends)below(b, 3 + wild);
    int levels = below(b, 5) - wild, count = below(b, c.vertices + 1), stride = 3 + below(b, 2);
    int made = subdiv_curve_point_count(rule, ends, count, levels);
    float *out = make_out(stride, made);
    subdiv_options opt = options(0);
    subdiv_result result = subdiv_curve(rule, ends, levels, 3, count, c.positions, 3, out, stride,
                                        &opt);
    REQUIRE(settled(result) == (made > 0));
    for (int i = 0; i < made && reach() < 1e30f; i++)
        REQUIRE(all_within(out + (size_t)i * (size_t)stride, 3, 1.001f * reach()));
    free(out);
}

static void join(void)
{
    int firsts[VERTICES];
    subdiv_options opt = options(0);
    REQUIRE(settled(subdiv_join_values(firsts, 3, c.vertices, c.positions, &opt)));
    for (int i = 0; i < c.vertices; i++)
        REQUIRE(firsts[i] >= 0 && firsts[i] <= i && firsts[firsts[i]] == firsts[i]);
}

static void door_tools(bytes *b)
{
    look();
    explain(b);
    change(b);
    bend(b);
    join();
}

// ------------------------------------------------------------------------------------------- OBJ

static size_t save(const subdiv_mesh *mesh, char **text)
{
    size_t size = 7, again = 7;
    subdiv_options opt = options(0);
    *text = NULL;
    if (!settled(subdiv_save_obj_memory(mesh, NULL, 0, &size, &opt))) {
        REQUIRE(size == 0);
        return 0;
    }
    *text = (char *)need(size);
    REQUIRE(settled(subdiv_save_obj_memory(mesh, *text, size, &again, &opt)) && size == again);
    return size;
}

// What was written and read is written again as the same text; but for normals, which are not read,
// and UVs that no face has.
static void door_obj(void)
{
    subdiv_mesh again, first = lent;
    char *text, *second;
    first.normals = NULL;
    size_t size = save(&first, &text);
    subdiv_options opt = options(0);
    memset(&again, 0x55, sizeof again);
    if (!text) return;
    REQUIRE(settled_mesh(subdiv_load_obj_memory(&again, text, size, &opt), &again));
    if (first.uv_count && !again.uv_count) {
        first.uv_count = 0;
        free(text);
        size = save(&first, &text);
    }
    REQUIRE(save(&again, &second) == size && memcmp(text, second, size) == 0);
    free(text), free(second);
    subdiv_mesh_free(&again);
}

// ------------------------------------------------------------------------------------------- all

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bytes from = { data, data + size }, *b = &from;
    int door = take(b), flags = take(b);
    memset(&how, 0, sizeof how);
    how.triangulate = flags & 1;
    how.keep_holes = flags >> 1 & 1;
    how.linear = (flags & 12) == 12;
    how.limit = flags >> 4 & 1;
    how.one_normal = flags >> 6 & 1;
    how.no_tags = flags >> 5 & 1;
    wild = flags >> 7 & 1;
    make_cage(b);
    lend();
    if (door % 8 == 0) door_refine(b);
    if (door % 8 == 1) door_evaluate(b);
    if (door % 8 == 2) door_values(b);
    if (door % 8 == 3) door_limit(b);
    if (door % 8 == 4) door_exact(b);
    if (door % 8 == 5) door_tessellate(b);
    if (door % 8 == 6) door_tools(b);
    if (door % 8 == 7) door_obj();
    take_back();
    REQUIRE(heap_live == 0);
    return 0;
}

#include "replay.h"
