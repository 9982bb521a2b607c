// THE ORDER OF THE RESULT, as the opening comment of subdiv.h promises it, written a second time
// and independent of the library: given a cage and a number of levels, the index of every point
// and of every face. A quad, or a triangle under Loop, has one grid of points; any other polygon
// has one for the quad at each of its vertices.
#ifndef ORDER_H
#define ORDER_H

#include <stdlib.h>
#include <string.h>

#include "subdiv.h"

typedef struct order {
    const subdiv_mesh *cage;
    int  n;                           // 2^levels: steps along an edge of the cage
    int  edge_count, point_count, face_count;
    int *face_start;                  // [cage faces + 1]   first face-vertex of each face
    int *first_point;                 // [cage faces + 1]   first point inside each face
    int *first_face;                  // [cage faces + 1]   first fine face of each face
    int *face_edges;                  // [face-vertices]    the edge from each face-vertex
    int *memory;
} order;

// One fine face: its cage face, the quad of an n-gon (0 for other faces), and row and column in
// that grid. A triangle turned by half shares row and column with the upright one before it.
typedef struct order_place {
    int face, quad, row, column, turned;
} order_place;

static inline int order_face_size(const order *o, int face)
{
    return o->face_start[face + 1] - o->face_start[face];
}

static inline int order_face_vertex(const order *o, int face, int i)
{
    return o->cage->face_vertices[o->face_start[face] + i % order_face_size(o, face)];
}

static inline int order_is_ngon(const order *o, int face)
{
    return o->cage->scheme != SUBDIV_LOOP && order_face_size(o, face) != 4;
}

// Steps along a side of the face's grid, or of each of its grids.
static inline int order_grid(const order *o, int face)
{
    return order_is_ngon(o, face) ? o->n / 2 : o->n;
}

// Numbers the edges as the faces first meet them. An edge that a face uses a second time, or whose
// ends are one vertex, is an edge of its own, which no other face will share.
// scratch: [cage vertices + 3 * face-vertices]
static inline void order_number_edges(order *o, int *scratch)
{
    const int vertex_count = o->cage->vertex_count;
    const int use_count = o->face_start[o->cage->face_count];
    int *newest = scratch;                // [vertices]  newest edge with this lower end, or -1
    int *older = newest + vertex_count;   // [edges]     the one before, or -1
    int *other = older + use_count;       // [edges]     the higher end
    int *last = other + use_count;        // [edges]     the last face that used it

    for (int v = 0; v < vertex_count; v++) newest[v] = -1;
    for (int f = 0; f < o->cage->face_count; f++) {
        for (int i = 0; i < order_face_size(o, f); i++) {
            const int a = order_face_vertex(o, f, i), b = order_face_vertex(o, f, i + 1);
            const int low = a < b ? a : b, high = a < b ? b : a;
            int e = newest[low];
            while (e >= 0 && other[e] != high) e = older[e];

            const int shared = e >= 0 && last[e] != f;
            if (!shared) {
                const int is_new_pair = e < 0 && a != b;
                e = o->edge_count++;
                if (is_new_pair) {
                    older[e] = newest[low];
                    other[e] = high;
                    newest[low] = e;
                }
            }
            last[e] = f;
            o->face_edges[o->face_start[f] + i] = e;
        }
    }
}

static inline int order_points_inside(const order *o, int face)
{
    const int n = o->n, m = n / 2, size = order_face_size(o, face);
    if (o->cage->scheme == SUBDIV_LOOP) return (n - 1) * (n - 2) / 2;
    if (size == 4) return (n - 1) * (n - 1);
    return 1 + size * (m - 1) + size * (m - 1) * (m - 1);
}

static inline int order_faces_inside(const order *o, int face)
{
    const int grid = order_grid(o, face);
    return grid * grid * (order_is_ngon(o, face) ? order_face_size(o, face) : 1);
}

static inline void order_free(order *o)
{
    free(o->memory);
    memset(o, 0, sizeof *o);
}

// levels: at least 1. hidden: [cage faces], not 0 for the holes, whose faces are left out; or NULL.
// The cage must outlive the order. Returns 0 without memory.
static inline int order_make(order *o, const subdiv_mesh *cage, int levels,
                             const unsigned char *hidden)
{
    const int face_count = cage->face_count;
    int use_count = 0;
    for (int f = 0; f < face_count; f++)
        use_count += cage->face_size ? cage->face_size : cage->face_sizes[f];
    const size_t ints = 3 * ((size_t)face_count + 1) + (size_t)use_count;
    const size_t scratch_ints = (size_t)cage->vertex_count + 3 * (size_t)use_count;
    int *scratch = (int *)malloc(sizeof(int) * scratch_ints);

    memset(o, 0, sizeof *o);
    o->memory = (int *)malloc(sizeof(int) * ints);
    if (!o->memory || !scratch) {
        free(scratch);
        order_free(o);
        return 0;
    }
    o->cage = cage;
    o->n = 1 << levels;
    o->face_start = o->memory;
    o->first_point = o->face_start + face_count + 1;
    o->first_face = o->first_point + face_count + 1;
    o->face_edges = o->first_face + face_count + 1;

    o->face_start[0] = 0;
    for (int f = 0; f < face_count; f++)
        o->face_start[f + 1] = o->face_start[f]
                             + (cage->face_size ? cage->face_size : cage->face_sizes[f]);
    order_number_edges(o, scratch);
    free(scratch);

    o->first_point[0] = cage->vertex_count + o->edge_count * (o->n - 1);
    o->first_face[0] = 0;
    for (int f = 0; f < face_count; f++) {
        const int visible = !hidden || !hidden[f];
        o->first_point[f + 1] = o->first_point[f] + order_points_inside(o, f);
        o->first_face[f + 1] = o->first_face[f] + (visible ? order_faces_inside(o, f) : 0);
    }
    o->point_count = o->first_point[face_count];
    o->face_count = o->first_face[face_count];
    return 1;
}

// The point so many steps along edge i of a face, from vertex i (0) to the next one (n).
static inline int order_edge_point(const order *o, int face, int i, int step)
{
    const int a = order_face_vertex(o, face, i), b = order_face_vertex(o, face, i + 1);
    const int edge = o->face_edges[o->face_start[face] + i];
    if (step == 0) return a;
    if (step == o->n) return b;
    return o->cage->vertex_count + edge * (o->n - 1) + (a <= b ? step : o->n - step) - 1;
}

static inline int order_quad_point(const order *o, int face, int row, int column)
{
    const int n = o->n;
    if (row == 0) return order_edge_point(o, face, 0, column);
    if (column == n) return order_edge_point(o, face, 1, row);
    if (row == n) return order_edge_point(o, face, 2, n - column);
    if (column == 0) return order_edge_point(o, face, 3, n - row);
    return o->first_point[face] + (row - 1) * (n - 1) + column - 1;
}

static inline int order_triangle_point(const order *o, int face, int row, int column)
{
    const int n = o->n;
    if (row == 0) return order_edge_point(o, face, 0, column);
    if (row + column == n) return order_edge_point(o, face, 1, row);
    if (column == 0) return order_edge_point(o, face, 2, n - row);
    // The rows below hold n-2, n-3, ... points.
    return o->first_point[face] + (row - 1) * (n - 1) - row * (row - 1) / 2 + column - 1;
}

// Inside an n-gon come the centre, m-1 points on each spoke outward, then the quads.
static inline int order_ngon_point(const order *o, int face, int quad, int row, int column)
{
    const int m = o->n / 2, size = order_face_size(o, face);
    const int before = (quad + size - 1) % size;
    const int centre = o->first_point[face];
    const int first_quad = centre + 1 + size * (m - 1);
    if (row == 0) return order_edge_point(o, face, quad, column);
    if (column == 0) return order_edge_point(o, face, before, o->n - row);
    if (row == m && column == m) return centre;
    if (column == m) return centre + 1 + quad * (m - 1) + (m - row) - 1;
    if (row == m) return centre + 1 + before * (m - 1) + (m - column) - 1;
    return first_quad + (quad * (m - 1) + row - 1) * (m - 1) + column - 1;
}

// The index of a grid point; row and column from 0 to order_grid, together no more under Loop.
static inline int order_point(const order *o, int face, int quad, int row, int column)
{
    if (o->cage->scheme == SUBDIV_LOOP) return order_triangle_point(o, face, row, column);
    if (order_is_ngon(o, face)) return order_ngon_point(o, face, quad, row, column);
    return order_quad_point(o, face, row, column);
}

// The index of a fine face, which must not be part of a hole.
static inline int order_face(const order *o, order_place p)
{
    const int grid = order_grid(o, p.face), first = o->first_face[p.face];
    if (o->cage->scheme == SUBDIV_LOOP)          // the rows before hold 2n-1, 2n-3, ... triangles
        return first + p.row * (2 * grid - p.row) + 2 * p.column + p.turned;
    return first + (p.quad * grid + p.row) * grid + p.column;
}

// The points of a fine face in their promised order; returns how many.
static inline int order_face_points(const order *o, order_place p, int points[4])
{
    const int is_triangle = o->cage->scheme == SUBDIV_LOOP;
    const int rows[3][4] = { {0, 0, 1, 1}, {0, 0, 1, 0}, {1, 1, 0, 0} };
    const int columns[3][4] = { {0, 1, 1, 0}, {0, 1, 0, 0}, {1, 0, 1, 0} };
    const int kind = !is_triangle ? 0 : p.turned ? 2 : 1, size = is_triangle ? 3 : 4;
    for (int i = 0; i < size; i++)
        points[i] = order_point(o, p.face, p.quad, p.row + rows[kind][i],
                                p.column + columns[kind][i]);
    return size;
}

#endif
