// Refinement in doubles as the papers and OpenSubdiv's rules say it, independent of the library:
// one level at a time, each level a whole mesh, each point by the mask of its rule. Nothing is fast.
//
//     slow_mesh *m = slow_cage(&cage, 0);              see slow_cage.h
//     slow_mesh *uvs = slow_uvs(m, &cage);
//     slow_step(&m, &uvs);                             one level on
//     slow_free(m), slow_free(uvs);
//
// The papers are those that the opening comment of subdiv.h names.
#ifndef SLOW_H
#define SLOW_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "order.h"

// A child has the number of its parent: vertex v becomes vertex v, edge e vertex vertex_count + e
// and face f vertex vertex_count + edge_count + f. Halves of edge e are edges 2 e and 2 e + 1.
typedef struct slow_mesh {
    int loop, linear, chaikin, smooth_triangles;    // the rules
    subdiv_vertex_rule rule;
    int vertex_count, edge_count, face_count;
    double (*points)[3];              // of UVs, the third is 0
    float *corner;                    // sharpness of vertices
    int  (*ends)[2];                  // of edges
    float *crease;                    // sharpness of edges
    float (*half)[2];                 // what is left of it one level down, at either end
    int   *start;                     // [face_count + 1]  first face-vertex of each face
    int   *vertices, *edges;          // of face-vertices; edge i of a face leads on from vertex i
    order_place *places;              // of faces: where each lies in the order of the result
    unsigned char *odd_edge, *odd_vertex;     // of the cage alone: not manifold
    unsigned char *hidden, *dropped;          // its faces: holes; those without a surface
    int   *twin;                      // of UVs alone: the edge of the mesh that each is, or -1;
    int   *partner;                   // the vertex that this one fades with, or -1;
    int   *home;                      // the vertex of the cage that each has the value of
} slow_mesh;

// What is forever sharp by its shape is not in the lists of the result.
static const float slow_by_shape = 11;

static inline void *slow_new(int count, size_t size)
{
    void *memory = calloc((size_t)count + 1, size);
    if (!memory) abort();
    return memory;
}

static inline slow_mesh *slow_mesh_new(const slow_mesh *rules, int vertices, int edges, int faces,
                                       int face_vertices)
{
    slow_mesh *m = (slow_mesh *)slow_new(1, sizeof *m);
    if (rules) {
        m->loop = rules->loop;
        m->linear = rules->linear;
        m->chaikin = rules->chaikin;
        m->smooth_triangles = rules->smooth_triangles;
        m->rule = rules->rule;
    }
    m->points = (double (*)[3])slow_new(vertices, sizeof *m->points);
    m->corner = (float *)slow_new(vertices, sizeof *m->corner);
    m->ends = (int (*)[2])slow_new(edges, sizeof *m->ends);
    m->crease = (float *)slow_new(edges, sizeof *m->crease);
    m->half = (float (*)[2])slow_new(edges, sizeof *m->half);
    m->start = (int *)slow_new(faces, sizeof *m->start);
    m->places = (order_place *)slow_new(faces, sizeof *m->places);
    m->vertices = (int *)slow_new(face_vertices, sizeof *m->vertices);
    m->edges = (int *)slow_new(face_vertices, sizeof *m->edges);
    return m;
}

static inline void slow_free(slow_mesh *m)
{
    if (!m) return;
    free(m->points), free(m->corner), free(m->ends), free(m->crease), free(m->half);
    free(m->start), free(m->places), free(m->vertices), free(m->edges);
    free(m->odd_edge), free(m->odd_vertex), free(m->hidden), free(m->dropped);
    free(m->twin), free(m->partner), free(m->home), free(m);
}

static inline int slow_size(const slow_mesh *m, int f)
{
    return m->start[f + 1] - m->start[f];
}

// The face-vertex so many after h in its face f.
static inline int slow_turn(const slow_mesh *m, int f, int h, int by)
{
    const int n = slow_size(m, f);
    return m->start[f] + (h - m->start[f] + by + n) % n;
}

static inline void slow_add(double *sum, double w, const double *p)
{
    for (int k = 0; k < 3; k++) sum[k] += w * p[k];
}

// ------------------------------------------------------------------------- sharpness [DKT98] [OSD]

static inline int slow_is_semi(float s)
{
    return s > 0 && s < SUBDIV_INFINITE;
}

static inline float slow_fade(float s)
{
    return s >= SUBDIV_INFINITE ? s : s > 1 ? s - 1 : 0;
}

// Chaikin: three quarters of the edge's own sharpness and one of the mean of the other semi-sharp
// edges at that end. A half of an edge of UVs fades as the half of the mesh's edge that it is.
static inline void slow_fade_edges(slow_mesh *m, const slow_mesh *mesh)
{
    float *sum = (float *)slow_new(m->vertex_count, sizeof *sum);
    int *count = (int *)slow_new(m->vertex_count, sizeof *count);
    for (int e = 0; e < m->edge_count; e++)
        for (int i = 0; i < 2 && slow_is_semi(m->crease[e]); i++) {
            sum[m->ends[e][i]] += m->crease[e];
            count[m->ends[e][i]]++;
        }
    for (int e = 0; e < m->edge_count; e++)
        for (int i = 0; i < 2; i++) {
            const int v = m->ends[e][i];
            float s = m->crease[e];
            if (m->chaikin && slow_is_semi(s) && count[v] > 1)
                s = 0.75f * s + 0.25f * ((sum[v] - s) / (float)(count[v] - 1));
            m->half[e][i] = slow_is_semi(m->crease[e]) ? (s > 1 ? s - 1 : 0) : s;
            if (m->twin && slow_is_semi(m->crease[e])) m->half[e][i] = mesh->half[m->twin[e]][i];
        }
    free(sum), free(count);
}

// A sharp vertex is a corner; so is one with three sharp edges or more.
typedef enum slow_rule { SLOW_SMOOTH, SLOW_CREASE, SLOW_CORNER } slow_rule;

static inline slow_rule slow_rule_of(float corner, int sharp_edges)
{
    if (corner > 0 || sharp_edges > 2) return SLOW_CORNER;
    return sharp_edges == 2 ? SLOW_CREASE : SLOW_SMOOTH;
}

// ------------------------------------------------------------------------------------------- masks

// What is around a vertex. Now, and one level down: how many edges are sharp, and the sum of the
// points at their other ends.
typedef struct slow_ring {
    int    faces, sharp[2], ending, seam_left;      // ending: edges that fade until the next level
    float  ending_sum;                              // of their sharpness
    double neighbours[3], face_points[3], crease[2][3];
} slow_ring;

static inline slow_ring *slow_rings(const slow_mesh *m, const slow_mesh *mesh,
                                    const double (*face_points)[3])
{
    slow_ring *rings = (slow_ring *)slow_new(m->vertex_count, sizeof *rings);
    for (int e = 0; e < m->edge_count; e++)
        for (int i = 0; i < 2; i++) {
            slow_ring *r = &rings[m->ends[e][i]];
            const double *other = m->points[m->ends[e][1 - i]];
            const float s = m->crease[e], left = m->half[e][i];
            slow_add(r->neighbours, 1, other);
            if (s > 0) slow_add(r->crease[0], 1, other);
            if (left > 0) slow_add(r->crease[1], 1, other);
            r->sharp[0] += s > 0;
            r->sharp[1] += left > 0;
            r->ending += s > 0 && left <= 0;
            if (left <= 0) r->ending_sum += s;
            r->seam_left |= m->twin && m->twin[e] >= 0 && s >= SUBDIV_INFINITE &&
                            slow_is_semi(mesh->half[m->twin[e]][i]);
        }
    for (int f = 0; f < m->face_count; f++)
        for (int h = m->start[f]; h < m->start[f + 1]; h++) {
            rings[m->vertices[h]].faces++;
            slow_add(rings[m->vertices[h]].face_points, 1, face_points[f]);
        }
    return rings;
}

// [Loop87]: what each of n neighbours weighs.
static inline double slow_loop_weight(subdiv_vertex_rule rule, int n)
{
    const double c = 0.375 + cos(8 * atan(1.0) / n) / 4;
    if (rule == SUBDIV_VERTEX_WARREN && n == 3) return 0.1875;
    if (rule == SUBDIV_VERTEX_WARREN || rule == SUBDIV_VERTEX_FIVE_EIGHTHS) return 0.375 / n;
    return (0.625 - c * c) / n;
}

// [CC78]: q Q + r R + (1 - q - r) v. Q: the mean of the face points around v, R: of the midpoints.
static inline void slow_catmull_clark(const slow_mesh *m, int v, const slow_ring *ring, double w,
                                      double *out)
{
    const double n = ring->faces;
    double q = 1 / n, r = 2 / n;
    if (m->rule == SUBDIV_VERTEX_AVERAGED) q = 0.25, r = 0.5;
    if (m->rule == SUBDIV_VERTEX_DOO_SABIN) r = 1 / n;
    slow_add(out, w * q / n, ring->face_points);
    slow_add(out, w * r / (2 * n), ring->neighbours);
    slow_add(out, w * (r / 2 + 1 - q - r), m->points[v]);
}

// Adds w times the vertex point of a rule: now, or one level down.
static inline void slow_add_vertex(const slow_mesh *m, int v, const slow_ring *ring, slow_rule rule,
                                   int down, double w, double *out)
{
    if (rule == SLOW_CORNER) {
        slow_add(out, w, m->points[v]);
    } else if (rule == SLOW_CREASE) {                              // a cubic B-spline [HDD94]
        slow_add(out, w * 0.75, m->points[v]);
        slow_add(out, w * 0.125, ring->crease[down]);
    } else if (m->loop) {
        const double b = slow_loop_weight(m->rule, ring->faces);
        slow_add(out, w * (1 - ring->faces * b), m->points[v]);
        slow_add(out, w * b, ring->neighbours);
    } else {
        slow_catmull_clark(m, v, ring, w, out);
    }
}

// Where the rule of a crease or corner changes until the next level, the two are blended: the first
// weighs the mean of the sharpness that fades. A vertex of UVs with a partner has the rule of that;
// it changes a level later where its seam stays semi-sharp.
static inline void slow_vertex_point(const slow_mesh *m, int v, const slow_ring *rings, double *out)
{
    const slow_ring *own = &rings[v];
    const slow_ring *r = m->partner && m->partner[v] >= 0 ? &rings[m->partner[v]] : own;
    const float left = slow_fade(m->corner[v]);
    const int fades = m->corner[v] > 0 && left <= 0;
    slow_rule now = slow_rule_of(m->corner[v], r->sharp[0]), next = slow_rule_of(left, r->sharp[1]);
    double w = 0;
    if (r != own && own->seam_left) next = now;
    if (m->linear || own->faces == 0) now = next = SLOW_CORNER;
    if (r->ending + fades > 0)
        w = (double)(r->ending_sum + (fades ? m->corner[v] : 0)) / (r->ending + fades);
    if (now == SLOW_SMOOTH || now == next || w > 1) w = 1;
    slow_add_vertex(m, v, own, now, 0, w, out);
    if (w < 1) slow_add_vertex(m, v, own, next, 1, 1 - w, out);
}

// From the ends and what is across: face points, or under Loop the third vertices. A sharp edge has
// its middle; one that turns smooth a blend, by its sharpness. A triangle under Catmull-Clark may
// weigh 0.47 instead of 1/4 [OSD]: two faces weigh the mean of theirs, each.
static inline void slow_edge_point(const slow_mesh *m, int e, const double *across, int triangles,
                                   double *out)
{
    double face = m->loop ? 0.125 : 0.25, w = fmin(1, (double)m->crease[e]);
    if (m->smooth_triangles && !m->loop) face += triangles * 0.11;
    if (m->linear || (m->half[e][0] > 0 && m->half[e][1] > 0)) w = 1;
    for (int i = 0; i < 2; i++)
        slow_add(out, w / 2 + (1 - w) * (1 - 2 * face) / 2, m->points[m->ends[e][i]]);
    slow_add(out, (1 - w) * face, across);
}

static inline void slow_refine_points(const slow_mesh *m, const slow_mesh *mesh, slow_mesh *to)
{
    const int first_edge = m->vertex_count, first_face = first_edge + m->edge_count;
    double (*face_points)[3] = (double (*)[3])slow_new(m->face_count, sizeof *face_points);
    double (*across)[3] = (double (*)[3])slow_new(m->edge_count, sizeof *across);
    int *triangles = (int *)slow_new(m->edge_count, sizeof *triangles);
    for (int f = 0; f < m->face_count; f++) {
        const int n = slow_size(m, f);
        for (int h = m->start[f]; h < m->start[f + 1]; h++)
            slow_add(face_points[f], 1.0 / n, m->points[m->vertices[h]]);
        for (int h = m->start[f]; h < m->start[f + 1]; h++) {
            const double *third = m->points[m->vertices[slow_turn(m, f, h, 2)]];
            slow_add(across[m->edges[h]], 1, m->loop ? third : face_points[f]);
            triangles[m->edges[h]] += n == 3;
        }
        if (!m->loop) slow_add(to->points[first_face + f], 1, face_points[f]);
    }
    for (int e = 0; e < m->edge_count; e++)
        slow_edge_point(m, e, across[e], triangles[e], to->points[first_edge + e]);
    slow_ring *rings = slow_rings(m, mesh, (const double (*)[3])face_points);
    for (int v = 0; v < m->vertex_count; v++) {
        slow_vertex_point(m, v, rings, to->points[v]);
        to->corner[v] = slow_fade(m->corner[v]);
    }
    free(rings), free(face_points), free(across), free(triangles);
}

// -------------------------------------------------------------------------------------- refinement

// The half of face-vertex h's edge (or of the edge before) at h's vertex.
static inline int slow_half_edge(const slow_mesh *m, int f, int h, int before)
{
    const int e = m->edges[before ? slow_turn(m, f, h, -1) : h];
    if (m->ends[e][0] == m->ends[e][1]) return 2 * e + before;
    return 2 * e + (m->ends[e][0] != m->vertices[h]);
}

static inline void slow_set_edge(slow_mesh *m, int e, int a, int b, float sharpness)
{
    m->ends[e][0] = a;
    m->ends[e][1] = b;
    m->crease[e] = sharpness;
}

// Adds a face, whose vertex and edge 0 become those number turn.
static inline void slow_set_face(slow_mesh *m, int size, int turn, const int *v, const int *e,
                                 order_place place)
{
    const int start = m->start[m->face_count];
    for (int i = 0; i < size; i++) {
        m->vertices[start + (i + turn) % size] = v[i];
        m->edges[start + (i + turn) % size] = e[i];
    }
    m->places[m->face_count++] = place;
    m->start[m->face_count] = start + size;
}

// A quad at each vertex. Those of a quad have its axes. Edges inside lead from the centre.
static inline void slow_refine_polygon(const slow_mesh *m, int f, slow_mesh *to)
{
    const int V = m->vertex_count, first = 2 * m->edge_count, n = slow_size(m, f);
    const int centre = V + m->edge_count + f;
    for (int i = 0; i < n; i++) {
        const int h = m->start[f] + i, before = slow_turn(m, f, h, -1);
        const int v[4] = { m->vertices[h], V + m->edges[h], centre, V + m->edges[before] };
        const int e[4] = { slow_half_edge(m, f, h, 0), first + h, first + before,
                           slow_half_edge(m, f, h, 1) };
        order_place place = m->places[f];
        place.row = 2 * place.row + (n == 4 && i >= 2);
        place.column = 2 * place.column + (n == 4 && (i == 1 || i == 2));
        if (n != 4) place.quad = i;
        slow_set_edge(to, first + h, centre, v[1], 0);
        slow_set_face(to, 4, n == 4 ? i : 0, v, e, place);
    }
}

// Three triangles like their parent, one at each vertex, and the middle one, turned by half. Edge i
// inside is the one that cuts off vertex i.
static inline void slow_refine_triangle(const slow_mesh *m, int f, slow_mesh *to)
{
    const int V = m->vertex_count, first = 2 * m->edge_count + m->start[f];
    const int turned = m->places[f].turned, on = turned ? -1 : 1;
    int v[3], e[3];
    order_place middle = m->places[f];
    middle.row = 2 * middle.row + turned;
    middle.column = 2 * middle.column + turned;
    for (int i = 0; i < 3; i++) {
        const int h = m->start[f] + i;
        const int corner[3] = { m->vertices[h], V + m->edges[h],
                                V + m->edges[slow_turn(m, f, h, -1)] };
        const int around[3] = { slow_half_edge(m, f, h, 0), first + i,
                                slow_half_edge(m, f, h, 1) };
        order_place place = middle;
        place.row += i == 2 ? on : 0;
        place.column += i == 1 ? on : 0;
        slow_set_edge(to, first + i, corner[1], corner[2], 0);
        slow_set_face(to, 3, i, corner, around, place);
        v[i] = V + m->edges[m->start[f] + (i + 1) % 3];
        e[i] = first + (i + 2) % 3;
    }
    middle.turned = !turned;
    slow_set_face(to, 3, 0, v, e, middle);
}

// mesh: where m is of UVs, what they lie on, on the same level and already refined.
static inline slow_mesh *slow_refine(slow_mesh *m, const slow_mesh *mesh)
{
    const int corners = m->start[m->face_count], edges = 2 * m->edge_count + corners;
    const int vertices = m->vertex_count + m->edge_count + (m->loop ? 0 : m->face_count);
    const int faces = m->loop ? 4 * m->face_count : corners;
    slow_mesh *to = slow_mesh_new(m, vertices, edges, faces, 4 * corners);
    to->vertex_count = vertices;
    to->edge_count = edges;
    slow_fade_edges(m, mesh);
    slow_refine_points(m, mesh, to);
    for (int e = 0; e < m->edge_count; e++)
        for (int i = 0; i < 2; i++)
            slow_set_edge(to, 2 * e + i, m->ends[e][i], m->vertex_count + e, m->half[e][i]);
    for (int f = 0; f < m->face_count; f++) {
        if (m->loop) slow_refine_triangle(m, f, to);
        else slow_refine_polygon(m, f, to);
    }
    if (!mesh) return to;
    to->twin = (int *)slow_new(edges, sizeof *to->twin);
    to->partner = (int *)slow_new(vertices, sizeof *to->partner);
    for (int e = 0; e < edges; e++)
        to->twin[e] = e / 2 < m->edge_count && m->twin[e / 2] >= 0 ? 2 * m->twin[e / 2] + e % 2
                                                                   : -1;
    for (int v = 0; v < vertices; v++)
        to->partner[v] = v < m->vertex_count ? m->partner[v] : -1;
    return to;
}

static inline void slow_step(slow_mesh **mesh, slow_mesh **uvs)
{
    slow_mesh *fine = slow_refine(*mesh, NULL), *fine_uvs = *uvs ? slow_refine(*uvs, *mesh) : NULL;
    slow_free(*mesh), slow_free(*uvs);
    *mesh = fine;
    *uvs = fine_uvs;
}

#endif
