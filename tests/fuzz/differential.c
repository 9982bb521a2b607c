// The library against the slow reference of tests/lib/slow.h: structured random cages with every
// option, refined by 0 to 4 levels. Faces, points, UVs and the sharpness that is left are the same;
// so are the limit, samples and stencils at some places. The first four bytes seed a generator of
// cages, the others make its decisions.
//
//     clang -g -O1 -fsanitize=fuzzer,address,undefined -DLIBFUZZER -I. tests/fuzz/differential.c
//         -o build/fuzz_differential && build/fuzz_differential tests/fuzz/seeds/differential
#include "fuzz.h"
#include "tests/lib/cages.h"
#include "tests/lib/exact_oracle.h"
#include "tests/lib/random_cage.h"

enum { MOST_FACES = 5000, PLACES = 3 };

static const double tolerance = 1e-6;             // of the extent, of positions and of UVs
static const double sharpness_tolerance = 1e-5;   // Chaikin adds up in the order of the edges

typedef struct comparison {
    random_cage *random;
    const subdiv_mesh *cage;
    subdiv_options opt;
    int levels;
    subdiv_mesh fine;
    slow_mesh *start, *start_uvs;     // the cage and its UVs, slow
    slow_mesh *slow, *slow_uvs;       // after as many levels
    order order;                      // unless levels is 0
    int *ours;                        // of vertices of slow
} comparison;

static void require_near(const comparison *c, const char *what, int i, const float *ours,
                         const double *exact, int dimensions, double allowed)
{
    for (int k = 0; k < dimensions; k++)
        if (!(fabs((double)ours[k] - exact[k]) <= allowed)) {
            fprintf(stderr, "%s %d is (%.7g %.7g), not (%.7g %.7g): level %d, scheme %d\n", what, i,
                    (double)ours[0], (double)ours[1], exact[0], exact[1], c->levels,
                    (int)c->cage->scheme);
            abort();
        }
}

// ------------------------------------------------------------------------------------------ order

// Has a face no faces in the result? Level 0 is a copy, with all of them.
static int is_left_out(const comparison *c, int face)
{
    return c->levels > 0 && c->start->hidden[face] && !c->opt.keep_holes;
}

static int is_listed_hole(const comparison *c, int face)
{
    return c->levels > 0 ? c->start->hidden[face] : is_hole(c->cage, face);
}

// The number of a fine face, and its points.
static int fine_face(const comparison *c, order_place place, int *points)
{
    if (c->levels > 0) {
        order_face_points(&c->order, place, points);
        return order_face(&c->order, place);
    }
    const slow_mesh *m = c->start;
    for (int i = 0; i < slow_size(m, place.face); i++)
        points[i] = m->vertices[m->start[place.face] + i];
    return place.face;
}

// One to one: vertices of the reference and points of the result.
static void match_vertices(comparison *c)
{
    const slow_mesh *m = c->slow;
    int points[RANDOM_MAX_SIZE], *theirs = (int *)slow_new(m->vertex_count, sizeof *theirs);
    c->ours = (int *)slow_new(m->vertex_count, sizeof *c->ours);
    REQUIRE(c->fine.vertex_count == m->vertex_count);
    for (int v = 0; v < m->vertex_count; v++)
        c->ours[v] = theirs[v] = v < c->cage->vertex_count ? v : -1;
    for (int f = 0; f < m->face_count; f++) {
        fine_face(c, m->places[f], points);
        for (int i = 0; i < slow_size(m, f); i++) {
            const int v = m->vertices[m->start[f] + i], p = points[i];
            REQUIRE(p >= 0 && p < m->vertex_count);
            if (c->ours[v] < 0 && theirs[p] < 0) c->ours[v] = p, theirs[p] = v;
            REQUIRE(c->ours[v] == p && theirs[p] == v);
        }
    }
    for (int v = 0; v < m->vertex_count; v++) REQUIRE(c->ours[v] >= 0);
    free(theirs);
}

// ---------------------------------------------------------------------------------------- results

static void compare_faces(const comparison *c, int face_count)
{
    const slow_mesh *m = c->slow;
    const subdiv_mesh *fine = &c->fine;
    unsigned char *hole = (unsigned char *)slow_new(fine->face_count, 1);
    int *start = (int *)slow_new(fine->face_count, sizeof *start);
    int points[RANDOM_MAX_SIZE], holes = 0;
    REQUIRE(fine->face_count == face_count);
    for (int i = 0; i < fine->hole_count; i++) hole[fine->holes[i]] = 1;
    for (int f = 0; f < face_count; f++) start[f + 1] = start[f] + face_size(fine, f);
    for (int f = 0; f < m->face_count; f++) {
        const order_place place = m->places[f];
        if (is_left_out(c, place.face)) continue;
        const int size = slow_size(m, f), g = fine_face(c, place, points);
        REQUIRE(face_size(fine, g) == size && fine->cage_faces[g] == place.face);
        REQUIRE(hole[g] == is_listed_hole(c, place.face));
        holes += hole[g];
        for (int i = 0; i < size; i++) REQUIRE(fine->face_vertices[start[g] + i] == points[i]);
    }
    REQUIRE(c->levels == 0 || fine->hole_count == holes);
    free(hole), free(start);
}

static void compare_points(const comparison *c, double extent)
{
    for (int v = 0; v < c->slow->vertex_count; v++)
        require_near(c, "point", c->ours[v], c->fine.positions + 3 * c->ours[v],
                     c->slow->points[v], 3, tolerance * extent);
}

typedef struct sharp { int a, b; float s; } sharp;            // an edge, or with b -1 a vertex

static int by_ends(const void *x, const void *y)
{
    const sharp *p = (const sharp *)x, *q = (const sharp *)y;
    return p->a != q->a ? (p->a > q->a) - (p->a < q->a) : (p->b > q->b) - (p->b < q->b);
}

static void add_sharp(sharp *list, int *count, int a, int b, float s)
{
    const sharp one = { b >= 0 && b < a ? b : a, b >= 0 && b < a ? a : b, s };
    if (s > 0 && s <= SUBDIV_INFINITE) list[(*count)++] = one;
}

// Edges of hidden faces alone are not listed.
static int list_sharp(const comparison *c, sharp *list)
{
    const slow_mesh *m = c->slow;
    unsigned char *seen = (unsigned char *)slow_new(m->edge_count, 1);
    int count = 0;
    for (int f = 0; f < m->face_count; f++)
        for (int h = m->start[f]; h < m->start[f + 1]; h++)
            seen[m->edges[h]] |= !is_left_out(c, m->places[f].face);
    for (int e = 0; e < m->edge_count; e++)
        if (seen[e]) add_sharp(list, &count, c->ours[m->ends[e][0]], c->ours[m->ends[e][1]],
                               m->crease[e]);
    for (int v = 0; v < m->vertex_count; v++) add_sharp(list, &count, c->ours[v], -1, m->corner[v]);
    free(seen);
    return count;
}

// What is missing in a list has sharpness 0.
static void compare_sharpness(const comparison *c)
{
    const subdiv_mesh *fine = &c->fine;
    const int most = fine->crease_count + fine->corner_count;
    sharp *ours = (sharp *)slow_new(most, sizeof *ours);
    sharp *theirs = (sharp *)slow_new(c->slow->edge_count + c->slow->vertex_count, sizeof *theirs);
    int count = 0, their_count = list_sharp(c, theirs), i = 0, j = 0;
    for (int k = 0; k < fine->crease_count; k++)
        add_sharp(ours, &count, fine->crease_vertices[2 * k], fine->crease_vertices[2 * k + 1],
                  fine->crease_sharpness[k]);
    for (int k = 0; k < fine->corner_count; k++)
        add_sharp(ours, &count, fine->corner_vertices[k], -1, fine->corner_sharpness[k]);
    REQUIRE(count == most);
    qsort(ours, (size_t)count, sizeof *ours, by_ends);
    qsort(theirs, (size_t)their_count, sizeof *theirs, by_ends);
    while (i < count || j < their_count) {
        const int order = i == count ? 1 : j == their_count ? -1 : by_ends(&ours[i], &theirs[j]);
        const float s = order <= 0 ? ours[i].s : 0, t = order >= 0 ? theirs[j].s : 0;
        REQUIRE(fabs((double)s - (double)t) <= sharpness_tolerance);
        i += order <= 0;
        j += order >= 0;
    }
    free(ours), free(theirs);
}

// The same values at each vertex of each face; equal indices where the vertices are equal.
static void compare_uvs(const comparison *c, double extent)
{
    const slow_mesh *m = c->slow_uvs;
    const subdiv_mesh *fine = &c->fine;
    const int size = c->cage->scheme == SUBDIV_LOOP ? 3 : 4, corners = size * fine->face_count;
    unsigned char *met = (unsigned char *)slow_new(corners, 1);
    int points[RANDOM_MAX_SIZE], *ours = (int *)slow_new(m->vertex_count, sizeof *ours);
    int *theirs = (int *)slow_new(fine->uv_count, sizeof *theirs);
    for (int f = 0; f < m->face_count; f++) {
        const int g = is_left_out(c, m->places[f].face) ? -1 : fine_face(c, m->places[f], points);
        for (int i = 0; i < size && g >= 0; i++) {
            const int uv = fine->face_uvs[size * g + i], v = m->vertices[m->start[f] + i];
            met[size * g + i] = 1;
            REQUIRE(uv >= 0 && uv < fine->uv_count);
            if (!ours[v] && !theirs[uv]) ours[v] = uv + 1, theirs[uv] = v + 1;
            REQUIRE(ours[v] == uv + 1 && theirs[uv] == v + 1);
            require_near(c, "UV", uv, fine->uvs + 2 * uv, m->points[v], 2, tolerance * extent);
        }
    }
    for (int i = 0; i < corners; i++) REQUIRE(met[i] || fine->face_uvs[i] == -1);
    free(met), free(ours), free(theirs);
}

// ------------------------------------------------------------------------- anywhere on the surface

typedef struct spot {                 // a place, and the lines of a grid that it is on
    subdiv_location at;
    int row, column;
} spot;

static int is_ngon(const slow_mesh *m, int f)
{
    return !m->loop && slow_size(m, f) != 4;
}

// On a point of the mesh refined so often, or for levels -1 anywhere.
static spot choose_spot(random_cage *random, const slow_mesh *m, int levels)
{
    const int f = random_below(random, m->face_count), ngon = is_ngon(m, f);
    const int steps = levels < 0 ? 1 << random_below(random, 20) : (1 << levels) / (1 + ngon);
    spot s = { { f, 0, 0, 0 }, 0, 0 };
    if (ngon) s.at.corner = random_below(random, slow_size(m, f));
    s.row = random_below(random, steps + 1);
    s.column = random_below(random, steps + 1 - (m->loop ? s.row : 0));
    if (steps) s.at.u = (float)s.column / (float)steps;
    if (steps) s.at.v = (float)s.row / (float)steps;
    return s;
}

static int point_at(const comparison *c, const spot *s)
{
    const slow_mesh *m = c->start;
    const int face = s->at.face;
    int corner = s->row ? m->loop || s->column ? 2 : 3 : s->column;
    if (c->levels > 0) return order_point(&c->order, face, s->at.corner, s->row, s->column);
    if (is_ngon(m, face)) corner = s->at.corner;
    return m->vertices[m->start[face] + corner];
}

// Points of the result on the limit.
static void compare_limits(const comparison *c, double extent)
{
    for (int i = 0; i < PLACES; i++) {
        const spot s = choose_spot(c->random, c->start, c->levels);
        const int point = point_at(c, &s);
        double exact[3][3];
        if (c->start->dropped[s.at.face]) continue;
        oracle_evaluate(c->start, s.at.face, s.at.corner, (double)s.at.u, (double)s.at.v, exact);
        require_near(c, "limit point", point, c->fine.positions + 3 * point, exact[0], 3,
                     tolerance * extent);
    }
}

static void add_up(const subdiv_stencils *stencils, int i, const float *values, int dimensions,
                   float *sum)
{
    double exact[3] = { 0, 0, 0 };
    for (size_t k = stencils->offsets[i]; k < stencils->offsets[i + 1]; k++)
        for (int d = 0; d < dimensions; d++)
            exact[d] += (double)stencils->weights[k]
                      * (double)values[dimensions * stencils->indices[k] + d];
    for (int d = 0; d < dimensions; d++) sum[d] = (float)exact[d];
}

// The stencils of some points of the result give these points.
static void compare_stencils(const comparison *c, double reach)
{
    subdiv_surface *surface;
    subdiv_stencils stencils;
    const int first = random_below(c->random, c->fine.vertex_count);
    const int rest = c->fine.vertex_count - first;
    REQUIRE(!subdiv_prepare(&surface, c->cage, c->levels, &c->opt));
    REQUIRE(!subdiv_refined_stencils(&stencils, surface, first, rest < 9 ? rest : 9, &c->opt));
    for (int i = 0; i < stencils.count; i++) {
        float sum[3];
        double point[3];
        add_up(&stencils, i, c->cage->positions, 3, sum);
        for (int k = 0; k < 3; k++) point[k] = (double)c->fine.positions[3 * (first + i) + k];
        require_near(c, "stencil", first + i, sum, point, 3, 2 * tolerance * reach);
    }
    subdiv_stencils_free(&stencils);
    subdiv_surface_free(surface);
}

// Samples anywhere, and their stencils, of positions or UVs.
static void compare_samples(const comparison *c, subdiv_surface *surface, const slow_mesh *m,
                            const float *values, int dimensions, double extent)
{
    subdiv_location at[PLACES];
    subdiv_derivatives out = {0};
    subdiv_stencils stencils;
    float points[3 * PLACES], sum[3];
    double exact[3][3];
    int faces[PLACES];
    for (int i = 0; i < PLACES; i++) {
        const spot s = choose_spot(c->random, m, -1);
        at[i] = s.at;
        faces[i] = s.at.face;
        at[i].face = m->places[s.at.face].face;
    }
    void *scratch = malloc(subdiv_scratch_size(surface, dimensions) + 1);
    REQUIRE(!subdiv_evaluate_begin(surface, dimensions, values, 0, scratch, &c->opt));
    out.points = points;
    REQUIRE(!subdiv_evaluate_at(surface, dimensions, scratch, PLACES, at, &out, &c->opt));
    REQUIRE(!subdiv_stencils_at(&stencils, surface, PLACES, at, &c->opt));
    for (int i = 0; i < PLACES; i++) {
        if (c->start->dropped[at[i].face]) continue;
        oracle_evaluate(m, faces[i], at[i].corner, (double)at[i].u, (double)at[i].v, exact);
        require_near(c, "sample of face", at[i].face, points + dimensions * i, exact[0], dimensions,
                     tolerance * extent);
        add_up(&stencils, i, values, dimensions, sum);
        require_near(c, "stencil of face", at[i].face, sum, exact[0], dimensions,
                     2 * tolerance * extent);
    }
    subdiv_stencils_free(&stencils);
    free(scratch);
    subdiv_surface_free(surface);
}

// How UVs fade may depend on the mesh that they lie on. The oracle, which looks at a part of them
// alone, knows those where it does not.
static int stands_alone(const slow_mesh *uvs)
{
    int alone = uvs->face_count > 0;
    for (int v = 0; v < uvs->vertex_count; v++) alone &= uvs->partner[v] < 0;
    for (int e = 0; e < uvs->edge_count && uvs->chaikin; e++)
        alone &= !slow_is_semi(uvs->crease[e]);
    return alone;
}

static void compare_exact(const comparison *c, double extent, double uv_extent)
{
    const subdiv_mesh *cage = c->cage;
    subdiv_surface *surface;
    if (cage->vertex_rule == SUBDIV_VERTEX_DOO_SABIN) return;      // makes no spline
    REQUIRE(!subdiv_prepare(&surface, cage, SUBDIV_EXACT, &c->opt));
    compare_samples(c, surface, c->start, cage->positions, 3, extent);
    if (!c->start_uvs || !stands_alone(c->start_uvs)) return;
    REQUIRE(!subdiv_prepare_face_varying(&surface, cage, cage->uv_count, cage->face_uvs,
                                         cage->uv_rule, SUBDIV_EXACT, &c->opt));
    compare_samples(c, surface, c->start_uvs, cage->uvs, 2, uv_extent);
}

// --------------------------------------------------------------------------------------- the cage

// Rules for vertices, faces that lack UVs, and sharpness below 0, besides what random cages have.
static void add_options(comparison *c)
{
    random_cage *random = c->random;
    subdiv_mesh *m = &random->mesh;
    const int pick = random_below(random, 6), corners = face_vertex_count(m);
    if (m->scheme == SUBDIV_CATMULL_CLARK && pick < 2)
        m->vertex_rule = pick ? SUBDIV_VERTEX_AVERAGED : SUBDIV_VERTEX_DOO_SABIN;
    if (m->scheme == SUBDIV_LOOP && pick < 2)
        m->vertex_rule = pick ? SUBDIV_VERTEX_WARREN : SUBDIV_VERTEX_FIVE_EIGHTHS;
    for (int i = random_below(random, 8); i >= 6 && m->uv_count; i--)
        random->face_uvs[random_below(random, corners)] = -1;
    if (m->crease_count && random_below(random, 8) == 7)
        m->crease_sharpness[random_below(random, m->crease_count)] = -1;
    c->levels = random_below(random, 5);
    while (c->levels > 0 && m->face_count << 2 * c->levels > MOST_FACES) c->levels--;
    c->opt.keep_holes = random_below(random, 2);
    c->opt.limit = random_below(random, 4) == 3;
    c->opt.linear = random_below(random, 8) == 7;
}

static double uv_extent(const subdiv_mesh *m)
{
    double largest = 0;
    for (int k = 0; k < 2 && m->uv_count; k++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int i = 0; i < m->uv_count; i++) {
            low = fmin(low, (double)m->uvs[2 * i + k]);
            high = fmax(high, (double)m->uvs[2 * i + k]);
        }
        largest = fmax(largest, high - low);
    }
    return largest;
}

static void compare(comparison *c)
{
    const subdiv_mesh *cage = c->cage;
    const double extent = mesh_extent(cage), of_uvs = uv_extent(cage);
    c->slow = slow_cage(cage, c->opt.linear);
    c->slow_uvs = slow_uvs(c->slow, cage);
    c->start = slow_cage(cage, c->opt.linear);
    c->start_uvs = slow_uvs(c->start, cage);
    for (int l = 0; l < c->levels; l++) slow_step(&c->slow, &c->slow_uvs);
    REQUIRE(!subdiv_refine(&c->fine, cage, c->levels, &c->opt));
    int face_count = cage->face_count;
    if (c->levels > 0) {
        REQUIRE(order_make(&c->order, cage, c->levels,
                           c->opt.keep_holes ? NULL : c->start->hidden));
        face_count = c->order.face_count;
    }
    match_vertices(c);
    compare_faces(c, face_count);
    if (c->opt.limit) compare_limits(c, extent);
    else compare_points(c, extent);
    if (c->levels > 0) compare_sharpness(c);
    if (c->slow_uvs && c->levels > 0) compare_uvs(c, of_uvs);
    compare_stencils(c, mesh_reach(cage));
    compare_exact(c, mesh_reach(cage), of_uvs);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    comparison c;
    unsigned seed = 0;
    for (int i = 0; i < 4 && size > 0; i++, size--) seed = seed << 8 | *data++;
    memset(&c, 0, sizeof c);
    c.random = random_cage_of(seed, RANDOM_ALL | RANDOM_LONG_SEAMS, data, size);
    REQUIRE(c.random);
    add_options(&c);
    c.cage = &c.random->mesh;
    compare(&c);
    slow_free(c.slow), slow_free(c.slow_uvs), slow_free(c.start), slow_free(c.start_uvs);
    order_free(&c.order);
    free(c.ours);
    subdiv_mesh_free(&c.fine);
    random_cage_free(c.random);
    return 0;
}

#include "replay.h"
