// A tessellation written a second time: where its points have to stand, by THE ORDER OF THE RESULT
// with a rate for each edge; and each face of the cage drawn as a plane polygon, which its parts
// have to cover once.
//
//     plan_make(&p, &cage, rates, face_rates);
//     check_tessellation(&fine, &p, hidden);
//     plan_free(&p);
#ifndef PLAN_H
#define PLAN_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "subdiv.h"
#include "cages.h"
#include "order.h"
#include "random_cage.h"
#include "test.h"

// ----------------------------------------------------------------- where the points have to stand

typedef struct plan {
    const subdiv_mesh *cage;
    order order;                          // of 1 level: faces and edges
    int  *edge_rates, *edge_first;        // [edges]
    int  *columns, *rows;                 // [faces] of n-gons: of each of the quads
    int  *inside_first;                   // [faces]
    unsigned char *dropped;               // [faces] without a surface, by boundary "none"
    int   point_count;
} plan;

static int *ints(int count)
{
    return (int *)calloc((size_t)count + 1, sizeof(int));
}

static int larger(int a, int b)
{
    return a > b ? a : b;
}

static int side_rate(const plan *p, int f, int side)
{
    return p->edge_rates[p->order.face_edges[p->order.face_start[f] + side]];
}

// The grid of a face, as the header has it; face_rate 0: by its edges.
static void plan_face(plan *p, int f, int face_rate)
{
    int size = order_face_size(&p->order, f), rate = 1, columns, rows, regular = 1;
    int ngon = order_is_ngon(&p->order, f), least = p->cage->scheme == SUBDIV_LOOP ? 3 : 2;
    for (int i = 0; i < size; i++) rate = larger(rate, side_rate(p, f, i));
    columns = rows = face_rate ? face_rate : rate;
    if (!ngon && least == 2 && !face_rate) {
        columns = larger(side_rate(p, f, 0), side_rate(p, f, 2));
        rows = larger(side_rate(p, f, 1), side_rate(p, f, 3));
    }
    if (ngon) columns = rows = (rows + 1) / 2;
    for (int i = 0; i < size; i++)
        regular &= side_rate(p, f, i) == (ngon ? 2 * columns : i % 2 ? rows : columns);
    for (int i = 0; i < 2; i++) {
        int *pieces = i ? &rows : &columns;
        int one = least == 2 && size == 4 && *pieces == 1 && side_rate(p, f, i) == 1 &&
                  side_rate(p, f, i + 2) == 1;
        if (!regular && !ngon && !one) *pieces = larger(*pieces, least);
    }
    p->columns[f] = columns;
    p->rows[f] = rows;
}

// The faces that are left out of the result, as refinement has it.
static void find_hidden(const subdiv_mesh *cage, int holes, unsigned char *hidden)
{
    subdiv_mesh fine, shape = *cage;
    if (!holes) shape.hole_count = 0;
    memset(hidden, 1, (size_t)cage->face_count);
    CHECK_EQUAL(subdiv_refine(&fine, &shape, 1, NULL), SUBDIV_OK);
    for (int i = 0; i < fine.face_count; i++) hidden[fine.cage_faces[i]] = 0;
    subdiv_mesh_free(&fine);
}

// Points are where there is a surface.
static void plan_points(plan *p)
{
    int count = p->cage->vertex_count, faces = p->cage->face_count;
    int *seen = ints(p->order.edge_count);
    for (int f = 0; f < faces; f++)
        for (int h = p->order.face_start[f]; h < p->order.face_start[f + 1]; h++)
            seen[p->order.face_edges[h]] |= !p->dropped[f];
    for (int e = 0; e < p->order.edge_count; e++) {
        p->edge_first[e] = count;
        count += seen[e] ? p->edge_rates[e] - 1 : 0;
    }
    for (int f = 0; f < faces; f++) {
        int c = p->columns[f], r = p->rows[f], size = order_face_size(&p->order, f);
        p->inside_first[f] = count;
        if (p->dropped[f]) continue;
        if (p->cage->scheme == SUBDIV_LOOP) count += (c - 1) * (c - 2) / 2;
        else count += size == 4 ? (c - 1) * (r - 1) : 1 + size * (c - 1) * c;
    }
    p->point_count = count;
    free(seen);
}

// rates: of the edges; face_rates: or NULL.
static void plan_make(plan *p, const subdiv_mesh *cage, const int *rates, const int *face_rates)
{
    memset(p, 0, sizeof *p);
    p->cage = cage;
    CHECK(order_make(&p->order, cage, 1, NULL));
    int edges = p->order.edge_count, faces = cage->face_count;
    int **arrays[] = { &p->edge_rates, &p->edge_first, &p->columns, &p->rows, &p->inside_first };
    for (int i = 0; i < 5; i++) *arrays[i] = ints(i < 2 ? edges : faces);
    p->dropped = (unsigned char *)calloc((size_t)faces + 1, 1);
    find_hidden(cage, 0, p->dropped);
    for (int e = 0; e < edges; e++) p->edge_rates[e] = rates[e];
    for (int f = 0; f < faces; f++) plan_face(p, f, face_rates ? face_rates[f] : 0);
    plan_points(p);
}

static void plan_free(plan *p)
{
    int *arrays[] = { p->edge_rates, p->edge_first, p->columns, p->rows, p->inside_first };
    for (int i = 0; i < 5; i++) free(arrays[i]);
    free(p->dropped);
    order_free(&p->order);
}

// Point k of a side of a face, counted from the vertex where that side begins.
static int plan_side_point(const plan *p, int f, int side, int k)
{
    int a = order_face_vertex(&p->order, f, side), b = order_face_vertex(&p->order, f, side + 1);
    int e = p->order.face_edges[p->order.face_start[f] + side], rate = p->edge_rates[e];
    if (k == 0) return a;
    if (k == rate) return b;
    return p->edge_first[e] + (a <= b ? k : rate - k) - 1;
}

// Where a point is on its face: its quad if the face is an n-gon, and u, v.
typedef struct spot {
    int quad;
    double u, v;
} spot;

static spot side_spot(const plan *p, int f, int side, double t)
{
    int size = order_face_size(&p->order, f);
    spot s = { 0, 0, 0 };
    if (order_is_ngon(&p->order, f)) {
        s.quad = t <= 0.5 ? side : (side + 1) % size;
        if (t <= 0.5) s.u = 2 * t;
        else s.v = 2 - 2 * t;
    } else if (p->cage->scheme == SUBDIV_LOOP) {
        s.u = side == 0 ? t : side == 1 ? 1 - t : 0;
        s.v = side == 1 ? t : side == 2 ? 1 - t : 0;
    } else {
        s.u = side == 0 ? t : side == 1 ? 1 : side == 2 ? 1 - t : 0;
        s.v = side == 1 ? t : side == 2 ? 1 : side == 3 ? 1 - t : 0;
    }
    return s;
}

static spot inside_spot(const plan *p, int f, int k)
{
    int c = p->columns[f], r = p->rows[f], size = order_face_size(&p->order, f), row = 1, left = k;
    spot s = { 0, 1, 1 };
    if (p->cage->scheme == SUBDIV_LOOP) {
        while (left >= c - 1 - row) left -= c - 1 - row++;
        s.u = (left + 1.0) / c;
        s.v = (double)row / c;
    } else if (size == 4) {
        s.u = (k % (c - 1) + 1.0) / c;
        s.v = (k / (c - 1) + 1.0) / r;
    } else if (k > 0 && k <= size * (c - 1)) {          // a spoke, from the centre
        s.quad = (k - 1) / (c - 1);
        s.v = (c - 1.0 - (k - 1) % (c - 1)) / c;
    } else if (k > 0) {
        left = k - 1 - size * (c - 1);
        s.quad = left / ((c - 1) * (c - 1));
        left %= (c - 1) * (c - 1);
        s.u = (left % (c - 1) + 1.0) / c;
        s.v = (left / (c - 1) + 1.0) / c;
    }
    return s;
}

// Of any point of the face. Returns 0 if it is none.
static int find_spot(const plan *p, int f, int point, spot *s)
{
    int size = order_face_size(&p->order, f), V = p->cage->vertex_count;
    int end = f + 1 < p->cage->face_count ? p->inside_first[f + 1] : p->point_count;
    if (point >= p->inside_first[f] && point < end) {
        *s = inside_spot(p, f, point - p->inside_first[f]);
        return 1;
    }
    for (int i = 0; i < size; i++) {
        int e = p->order.face_edges[p->order.face_start[f] + i], rate = p->edge_rates[e];
        int k = point - p->edge_first[e] + 1;
        if (order_face_vertex(&p->order, f, i) > order_face_vertex(&p->order, f, i + 1))
            k = rate - k;
        if (point < V ? point != order_face_vertex(&p->order, f, i) : k <= 0 || k >= rate) continue;
        *s = side_spot(p, f, i, point < V ? 0 : (double)k / rate);
        return 1;
    }
    return 0;
}

// ----------------------------------------------------------------------- each face of the cage

// Vertex i of a face drawn in the plane; of an n-gon, from i = size on the middles of its edges.
static void draw_vertex(const plan *p, int f, int i, double xy[2])
{
    static const double square[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
    static const double triangle[3][2] = { { 0, 0 }, { 1, 0 }, { 0, 1 } };
    int size = order_face_size(&p->order, f);
    const double turn = 8 * atan(1.0), half = i < size ? 1 : 0.5;
    double a[2] = { cos(turn * i / size), sin(turn * i / size) };
    double b[2] = { cos(turn * (i + 1) / size), sin(turn * (i + 1) / size) };
    for (int k = 0; k < 2; k++) {
        if (p->cage->scheme == SUBDIV_LOOP) xy[k] = triangle[i][k];
        else if (size == 4) xy[k] = square[i][k];
        else xy[k] = half * a[k] + (1 - half) * b[k];
    }
}

// A value at a spot, from values [stride] at the vertices: bilinear; in a triangle linear.
static double at_spot(const plan *p, int f, spot s, const double *values, int stride)
{
    int size = order_face_size(&p->order, f), q = s.quad;
    double corner[4] = { 0, 0, 0, 0 };
    const double *v = values;
    if (p->cage->scheme == SUBDIV_LOOP)
        return v[0] * (1 - s.u - s.v) + v[stride] * s.u + v[2 * stride] * s.v;
    for (int i = 0; i < size; i++)
        corner[size == 4 ? i : 2] += v[i * stride] / (size == 4 ? 1 : size);
    if (size != 4) {
        corner[0] = v[q * stride];
        corner[1] = (corner[0] + v[(q + 1) % size * stride]) / 2;
        corner[3] = (corner[0] + v[(q + size - 1) % size * stride]) / 2;
    }
    return (corner[0] * (1 - s.u) + corner[1] * s.u) * (1 - s.v) +
           (corner[3] * (1 - s.u) + corner[2] * s.u) * s.v;
}

// Twice the area of a face of the result in the drawing of its cage face.
static double drawn_area(const plan *p, int f, const int *points, int size)
{
    double xy[2 * RANDOM_MAX_SIZE], at[8][2], area = 0;
    for (int i = 0; i < order_face_size(&p->order, f); i++) draw_vertex(p, f, i, xy + 2 * i);
    for (int i = 0; i < size; i++) {
        spot s = { 0, 0, 0 };
        if (!find_spot(p, f, points[i], &s)) return -1;
        for (int k = 0; k < 2; k++) at[i][k] = at_spot(p, f, s, xy + k, 2);
    }
    for (int i = 0; i < size; i++) {
        const double *a = at[i], *b = at[(i + 1) % size];
        area += a[0] * b[1] - a[1] * b[0];
    }
    return area;
}

typedef struct directed { int low, high, way; } directed;

static int compare_directed(const void *a, const void *b)
{
    const directed *d = (const directed *)a, *e = (const directed *)b;
    if (d->low != e->low) return d->low < e->low ? -1 : 1;
    if (d->high != e->high) return d->high < e->high ? -1 : 1;
    return e->way - d->way;
}

static directed direct(int a, int b)
{
    directed d = { a < b ? a : b, a < b ? b : a, a < b ? 1 : -1 };
    return d;
}

static int repeats_vertex(const plan *p, int f)
{
    int size = order_face_size(&p->order, f);
    for (int i = 0; i < size; i++)
        for (int j = 0; j < i; j++)
            if (order_face_vertex(&p->order, f, i) == order_face_vertex(&p->order, f, j)) return 1;
    return 0;
}

// The parts of face f, count faces of the result: with the face's outline run backwards each edge
// is there twice, once in each direction; so the outline is that of the cage's edges, point by
// point, and there is no hole. All parts are turned as the face is and have an area; together
// they have that of the face, so they cover it once.
static void check_patch(const plan *p, int f, const int *vertices, const int *sizes, int count)
{
    int total = 0, sides = order_face_size(&p->order, f), odd = repeats_vertex(p, f);
    int n = 0, bad = 0;
    double area = 0, whole = 0, xy[2 * RANDOM_MAX_SIZE + 2], least = 1;
    for (int i = 0; i < count; i++) total += sizes[i];
    for (int i = 0; i < sides; i++) total += side_rate(p, f, i);
    directed *edges = (directed *)calloc((size_t)total + 1, sizeof *edges);
    for (int i = 0; i < count; vertices += sizes[i++]) {
        double part = odd ? 1 : drawn_area(p, f, vertices, sizes[i]);
        area += part;
        if (part < least) least = part;
        for (int k = 0; k < sizes[i]; k++) {
            int a = vertices[k], b = vertices[(k + 1) % sizes[i]], c = vertices[(k + 2) % sizes[i]];
            bad += !odd && (a == b || a == c);
            edges[n++] = direct(a, b);
        }
    }
    for (int i = 0; i < sides; i++)
        for (int k = 0; k < side_rate(p, f, i); k++)
            edges[n++] = direct(plan_side_point(p, f, i, k + 1), plan_side_point(p, f, i, k));
    qsort(edges, (size_t)n, sizeof *edges, compare_directed);
    for (int i = 0, j; i < n; i = j) {
        int net = 0;
        for (j = i; j < n && edges[j].low == edges[i].low && edges[j].high == edges[i].high; j++)
            net += edges[j].way;
        bad += edges[i].low != edges[i].high && (net != 0 || (!odd && j - i != 2));
    }
    CHECK_EQUAL(bad, 0);
    for (int i = 0; i < sides; i++) draw_vertex(p, f, i, xy + 2 * i);
    for (int i = 0; i < sides; i++) {
        int j = (i + 1) % sides;
        whole += xy[2 * i] * xy[2 * j + 1] - xy[2 * i + 1] * xy[2 * j];
    }
    if (!odd) CHECK(least > 0);
    if (!odd) CHECK_NEAR(area, whole, 1e-9);
    free(edges);
}

static int sizes_match(const subdiv_mesh *fine, const plan *p)
{
    return fine->vertex_count == p->point_count && (fine->face_size == 3 || fine->face_size == 4 ||
                                                    (fine->face_size == 0 && fine->face_sizes));
}

// All patches, in order; hidden faces have none.
static void check_tessellation(const subdiv_mesh *fine, const plan *p, const unsigned char *hidden)
{
    int *sizes = ints(fine->face_count), at = 0;
    const int *vertices = fine->face_vertices;
    CHECK(sizes_match(fine, p));
    for (int i = 0; i < fine->face_count; i++) sizes[i] = face_size(fine, i);
    for (int f = 0; f < p->cage->face_count; f++) {
        int first = at, used = 0;
        for (; at < fine->face_count && fine->cage_faces[at] == f; at++) used += sizes[at];
        CHECK((at == first) == (hidden && hidden[f]));
        if (at > first) check_patch(p, f, vertices, sizes + first, at - first);
        if (used) vertices += used;
    }
    CHECK_EQUAL(at, fine->face_count);
    free(sizes);
}

#endif
