// The lecture as a program: one level of Catmull-Clark and of Loop subdivision, with boundaries,
// creases and corners. Read it from top to bottom. Only the end uses subdiv.h, to compare: on the
// demo's cages, all points of level 1 and the cage's vertices on level 2. It prints how many points
// level 1 has and the largest difference, divided by the largest coordinate: mere rounding.
//
//     cc -O2 -I. examples/00_lecture.c -o build/00_lecture -lm && build/00_lecture
//
//     examples/cages/camera.obj   Catmull-Clark   904 points  6.6e-08

#include <math.h>
#include <stdio.h>

// ------------------------------------------------------------------------ 1. A mesh is arrays
// Vertices have numbers. A face is a list of these, counter-clockwise. The lists stand one after
// the other: that of face f is face_vertices[first[f]] to face_vertices[first[f + 1] - 1].

enum { MOST = 1 << 16 };                // of anything
typedef struct point { double x[3]; } point;

typedef struct edge {
    int    a, b;                        // the vertices at its ends, the lower-numbered one first
    int    faces[2];                    // twice the same: it is on the boundary
    int    before;                      // the edge found before with the same a, or -1
    double sharpness;                   // for how many levels it stays a crease; boundary: forever
} edge;

typedef struct mesh {
    int    vertex_count, face_count, edge_count;
    point  vertices[MOST];
    double sharpness[MOST];             // of each vertex: for how many levels it stays a corner
    int    newest[MOST];                // of each vertex: the last edge found with it as a, or -1
    int    first[MOST], face_vertices[MOST];
    int    face_edges[MOST];            // of each entry of face_vertices: the edge to the next one
    edge   edges[MOST];
} mesh;

// ------------------------------------------------------------- 2. Faces have edges in common
// Two vertices of a face, one after the other, are an edge. One other face at most has it, too.

static int find_edge(const mesh *m, int a, int b)
{
    int e = m->newest[a < b ? a : b];
    while (e >= 0 && m->edges[e].a + m->edges[e].b != a + b) e = m->edges[e].before;
    return e;
}

static void find_edges(mesh *m)
{
    m->edge_count = 0;
    for (int v = 0; v < m->vertex_count; v++) m->newest[v] = -1;
    for (int f = 0; f < m->face_count; f++)
        for (int i = m->first[f]; i < m->first[f + 1]; i++) {
            int next = i + 1 < m->first[f + 1] ? i + 1 : m->first[f];
            int a = m->face_vertices[i], b = m->face_vertices[next];
            int e = find_edge(m, a, b), low = a < b ? a : b;
            edge boundary = { low, a + b - low, { f, f }, m->newest[low], HUGE_VAL };
            if (e < 0) m->edges[e = m->newest[low] = m->edge_count++] = boundary;
            else m->edges[e].faces[1] = f, m->edges[e].sharpness = 0;
            m->face_edges[i] = e;
        }
}

// ---------------------------------------------------------------------------------- 3. Masks
// A point of the finer mesh is a sum of points around it. Their weights add up to 1.
static point plus(point a, point b)
{
    for (int k = 0; k < 3; k++) a.x[k] += b.x[k];
    return a;
}

static point times(double w, point a)
{
    for (int k = 0; k < 3; k++) a.x[k] *= w;
    return a;
}

// Face point [Catmull, Clark 1978]: the mean of the face's n vertices.
//
//     1/n----1/n
//      |  F  |               F = (v1 + ... + vn) / n
//     1/n----1/n
static point face_point(const mesh *m, int f)
{
    point sum = { { 0, 0, 0 } };
    for (int i = m->first[f]; i < m->first[f + 1]; i++)
        sum = plus(sum, m->vertices[m->face_vertices[i]]);
    return times(1.0 / (m->first[f + 1] - m->first[f]), sum);
}

// Edge point on a crease or boundary: the midpoint.
//
//     1/2---E---1/2          E = (a + b) / 2
static point crease_edge(point a, point b)
{
    return times(1.0 / 2, plus(a, b));
}

// Smooth edge point [Catmull, Clark 1978]. f and g: the face points on its two sides.
//
//        f
//     a--E--b                E = (a + b + f + g) / 4
//        g
static point catmull_clark_edge(point a, point b, point f, point g)
{
    return times(1.0 / 4, plus(plus(a, b), plus(f, g)));
}

// Smooth edge point [Loop 1987]. c and d: the vertices opposite the edge.
//
//          1/8
//         /   \              E = (3a + 3b + c + d) / 8
//     3/8---E---3/8
//         \   /
//          1/8
static point loop_edge(point a, point b, point c, point d)
{
    return times(1.0 / 8, plus(times(3, plus(a, b)), plus(c, d)));
}

// Vertex point on a crease or boundary: on the cubic B-spline curve along it.
//
//     1/8---6/8---1/8        V = (a + 6v + b) / 8
static point crease_vertex(point v, point a_plus_b)
{
    return times(1.0 / 8, plus(times(6, v), a_plus_b));
}

// Smooth vertex point [Catmull, Clark 1978]. The valence n is the number of edges. Q is the mean of
// the face points f, R that of the midpoints of the edges, (v + e) / 2.
//
//     f----e----f
//     |    |    |
//     e----V----e            V = (Q + 2R + (n - 3) v) / n
//     |    |    |
//     f----e----f
static point catmull_clark_vertex(int n, point v, point q, point r)
{
    return times(1.0 / n, plus(plus(q, times(2, r)), times(n - 3, v)));
}

// Smooth vertex point [Loop 1987]. beta(6) = 1/16.
//
//       B---B
//      / \ / \               V = (1 - n beta) v + beta (sum of the neighbours)
//     B---V---B
//      \ / \ /               beta(n) = (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n
//       B---B
static point loop_vertex(int n, point v, point neighbours)
{
    double c = 3.0 / 8 + cos(2 * 3.14159265358979323846 / n) / 4, beta = (5.0 / 8 - c * c) / n;
    return plus(times(1 - n * beta, v), times(beta, neighbours));
}

// ----------------------------------------------------------------- 4. Which mask, how sharp
// Sharpness falls by 1 a level [DeRose, Kass, Truong 1998]: what is above 0 is sharp now, what is
// above 1 also on the next level. Where sharp becomes smooth, a point is a blend of the two.
static point blend(double weight, point sharp, point smooth)
{
    return plus(times(weight, sharp), times(1 - weight, smooth));
}

static point opposite(const mesh *m, const edge *e, int side)
{
    int i = m->first[e->faces[side]];
    while (m->face_vertices[i] == e->a || m->face_vertices[i] == e->b) i++;
    return m->vertices[m->face_vertices[i]];
}

static point edge_point(const mesh *m, int loop, const edge *e, const point *faces)
{
    point a = m->vertices[e->a], b = m->vertices[e->b], smooth;
    if (e->sharpness > 1) return crease_edge(a, b);
    if (loop) smooth = loop_edge(a, b, opposite(m, e, 0), opposite(m, e, 1));
    else smooth = catmull_clark_edge(a, b, faces[e->faces[0]], faces[e->faces[1]]);
    return blend(e->sharpness, crease_edge(a, b), smooth);
}

// The rule of a vertex follows from how many of its edges are sharper than level, 0 or 1. Two are a
// crease. Three or more are a corner, which stays where it is. With fewer, it is smooth.
static point vertex_by_rule(const mesh *m, int loop, int v, const point *faces, int level)
{
    point p = m->vertices[v], edges = { { 0, 0, 0 } }, along = edges, q = edges;    // sums
    int n = 0, sharp = 0;
    for (const edge *e = m->edges; e < m->edges + m->edge_count; e++) {
        if (e->a != v && e->b != v) continue;
        point neighbour = m->vertices[e->a + e->b - v];
        edges = plus(edges, neighbour);
        q = plus(q, plus(faces[e->faces[0]], faces[e->faces[1]]));      // each face twice
        n++;
        if (e->sharpness > level) along = plus(along, neighbour), sharp++;
    }
    if (n == 0 || sharp > 2 || m->sharpness[v] > level) return p;
    if (sharp == 2) return crease_vertex(p, along);
    if (loop) return loop_vertex(n, p, edges);
    return catmull_clark_vertex(n, p, times(0.5 / n, q), crease_edge(p, times(1.0 / n, edges)));
}

// The mean sharpness of what ends before the next level is the weight of this level's rule.
static point vertex_point(const mesh *m, int loop, int v, const point *faces)
{
    double s = m->sharpness[v], sum = s > 1 ? 0 : s, count = sum > 0;
    for (const edge *e = m->edges; e < m->edges + m->edge_count; e++)
        if ((e->a == v || e->b == v) && e->sharpness > 0 && e->sharpness <= 1)
            sum += e->sharpness, count++;
    return blend(count > 0 ? sum / count : 1, vertex_by_rule(m, loop, v, faces, 0),
                 vertex_by_rule(m, loop, v, faces, 1));
}

// ----------------------------------------------------------------------- 5. One level finer
// First come the points of vertices, then those of edges (e) and of faces (F). A face becomes a
// quad at each of its vertices; under Loop a triangle there, and one in the middle.
//
//     3---e2--2          2
//     |   |   |         / \            0 e0 F e3, 1 e1 F e0, 2 e2 F e1, 3 e3 F e2
//     e3--F---e1       e2--e1
//     |   |   |       / \ / \          0 e0 e2, 1 e1 e0, 2 e2 e1, e0 e1 e2
//     0---e0--1      0---e0--1
static void refine(mesh *fine, const mesh *m, int loop)
{
    int edge0 = m->vertex_count, face0 = edge0 + m->edge_count;         // their first points
    int size = loop ? 3 : 4, *v = fine->face_vertices;
    point *faces = fine->vertices + face0;
    for (int f = 0; f < m->face_count; f++) faces[f] = face_point(m, f);
    for (int i = 0; i < edge0; i++) fine->vertices[i] = vertex_point(m, loop, i, faces);
    for (int i = 0; i < MOST; i++) fine->sharpness[i] = fmax(m->sharpness[i] - 1, 0);
    for (int e = 0; e < m->edge_count; e++)
        fine->vertices[edge0 + e] = edge_point(m, loop, &m->edges[e], faces);
    for (int f = 0; f < m->face_count; f++) {
        int first = m->first[f], end = m->first[f + 1];
        for (int i = first; i < end; i++) {
            *v++ = m->face_vertices[i];
            *v++ = edge0 + m->face_edges[i];
            if (!loop) *v++ = face0 + f;
            *v++ = edge0 + m->face_edges[i > first ? i - 1 : end - 1];
        }
        for (int i = first; i < end && loop; i++) *v++ = edge0 + m->face_edges[i];
    }
    fine->face_count = (int)(v - fine->face_vertices) / size;
    for (int f = 0; f < fine->face_count; f++) fine->first[f + 1] = size * (f + 1);
    fine->vertex_count = loop ? face0 : face0 + m->face_count;
    find_edges(fine);
    for (int i = 0; i < 2 * m->edge_count; i++) {       // the two halves of each edge
        const edge *e = &m->edges[i / 2];
        int half = find_edge(fine, i % 2 ? e->b : e->a, edge0 + i / 2);
        fine->edges[half].sharpness = fmax(e->sharpness - 1, 0);
    }
}

// ---------------------------------------------------------------- 6. The same with subdiv.h
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

static void copy(mesh *m, const subdiv_mesh *c)
{
    m->vertex_count = c->vertex_count;
    m->face_count = c->face_count;
    for (int f = 0; f < m->face_count; f++) m->first[f + 1] = c->face_size * (f + 1);
    for (int i = 0; i < m->first[m->face_count]; i++) m->face_vertices[i] = c->face_vertices[i];
    find_edges(m);
    for (int i = 0; i < MOST; i++) m->sharpness[i] = 0;
    for (int i = 0; i < 3 * m->vertex_count; i++)
        m->vertices[i / 3].x[i % 3] = (double)c->positions[i];
    for (int i = 0; i < c->corner_count; i++)
        m->sharpness[c->corner_vertices[i]] = (double)c->corner_sharpness[i];
    for (int i = 0; i < c->crease_count; i++) {
        int e = find_edge(m, c->crease_vertices[2 * i], c->crease_vertices[2 * i + 1]);
        m->edges[e].sharpness = (double)c->crease_sharpness[i];
    }
}

int main(void)
{
    static const char *const cages[] = { "examples/cages/camera.obj", "examples/cages/lotus.obj",
                                         "examples/cages/octopus.obj", "examples/cages/whale.obj" };
    static mesh lecture[3];
    subdiv_options opt = {0};
    opt.triangulate = 1;                // Loop needs triangles
    for (int i = 0; i < 8; i++) {
        subdiv_mesh cage, m;
        double size = 0, worst = 0;
        if (subdiv_load_obj(&cage, cages[i % 4], NULL)) return 1;
        cage.scheme = i < 4 ? SUBDIV_CATMULL_CLARK : SUBDIV_LOOP;
        for (int level = 0; level < 3; level++) {
            if (subdiv_refine(&m, &cage, level, &opt)) return 1;
            if (level == 0) copy(&lecture[0], &m);
            else refine(&lecture[level], &lecture[level - 1], i >= 4);
            for (int k = 0; k < 3 * (level < 2 ? m.vertex_count : cage.vertex_count); k++) {
                double x = lecture[level].vertices[k / 3].x[k % 3];
                worst = fmax(worst, fabs(x - (double)m.positions[k]));
                size = fmax(size, fabs(x));
            }
            subdiv_mesh_free(&m);
        }
        printf("%-28s%-14s%5d points  %.1e\n", cages[i % 4], i < 4 ? "Catmull-Clark" : "Loop",
               lecture[1].vertex_count, worst / size);
        subdiv_mesh_free(&cage);
        if (!(worst < 1e-6 * size)) return 1;
    }
    return 0;
}
