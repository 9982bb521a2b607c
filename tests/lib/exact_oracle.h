// The limit surface at any place, the slow way and in doubles, independent of the library: the two
// rings of faces around the place are refined again and again by the papers' masks, the two rings
// around the child that has the place are kept; then the limit masks at the corners of the last
// one. What lies between the corners is straight: with a face of size h, positions are as exact as
// h * h is small, first derivatives as h is.
//
//     oracle_open(&o, &cage);
//     oracle_evaluate(o, face, corner, u, v, ORACLE_DEPTH, out);   out: the point, d/du, d/dv
//     oracle_close(o);
#ifndef EXACT_ORACLE_H
#define EXACT_ORACLE_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "subdiv.h"

enum {
    ORACLE_DEPTH = 26,
    ORACLE_MOST_FACES = 2048,
    ORACLE_MOST = 8192                // vertices, edges, face-vertices
};

// Faces and edges know each other; a boundary is an edge that is sharp forever. At the rim there
// are vertices without all their faces. What is computed there is wrong, and not used.
typedef struct oracle_mesh {
    int    vertex_count, edge_count, face_count;
    double points[ORACLE_MOST][3];
    float  corner[ORACLE_MOST];                   // sharpness of vertices
    int    ends[ORACLE_MOST][2];
    float  crease[ORACLE_MOST];                   // sharpness of edges
    int    start[ORACLE_MOST_FACES + 1];          // first face-vertex
    int    vertices[ORACLE_MOST], edges[ORACLE_MOST];   // of face-vertices: edge i begins at i
} oracle_mesh;

// What edges and faces add up to at a vertex.
typedef struct oracle_ring {
    int    faces, sharp, child_sharp, semi, fading;     // faces; edges
    float  semi_sum, fading_sum;                        // of sharpness
    double neighbours[3], opposite[3], crease[3], child_crease[3];
} oracle_ring;

typedef struct oracle {
    subdiv_scheme scheme;
    int chaikin, smooth_triangles, overflow;
    oracle_mesh cage, part, level;
    oracle_ring rings[ORACLE_MOST];
    float halves[ORACLE_MOST][2];     // sharpness of an edge's children at its ends
    int   edge_faces[ORACLE_MOST];
    int   map[ORACLE_MOST], edge_map[ORACLE_MOST];
    unsigned char marks[ORACLE_MOST];
    unsigned char bare[ORACLE_MOST];  // of the cage's vertices: their faces have no surface
} oracle;

static inline int oracle_size(const oracle_mesh *m, int f)
{
    return m->start[f + 1] - m->start[f];
}

// The face-vertex so many after h in its face f.
static inline int oracle_turn(const oracle_mesh *m, int f, int h, int by)
{
    const int n = oracle_size(m, f);
    return m->start[f] + (h - m->start[f] + by + n) % n;
}

static inline void oracle_add(double *sum, double w, const double *p)
{
    for (int k = 0; k < 3; k++) sum[k] += w * p[k];
}

// ----------------------------------------------------------------------------------- sharpness

static inline float oracle_fade(float s)
{
    return s >= SUBDIV_INFINITE ? SUBDIV_INFINITE : s > 1 ? s - 1 : 0;
}

static inline int oracle_is_semi(float s)
{
    return s > 0 && s < SUBDIV_INFINITE;
}

// Of the child of an edge at a vertex with this ring.
static inline float oracle_half(const oracle *o, float s, const oracle_ring *r)
{
    if (!o->chaikin || !oracle_is_semi(s)) return oracle_fade(s);
    if (r->semi > 1) s = 0.75f * s + 0.25f * ((r->semi_sum - s) / (float)(r->semi - 1));
    return s > 1 ? s - 1 : 0;
}

static inline void oracle_meet_edge(oracle *o, const oracle_mesh *m, int e, int end)
{
    oracle_ring *r = &o->rings[m->ends[e][end]];
    const double *other = m->points[m->ends[e][1 - end]];
    const float s = m->crease[e], child = oracle_half(o, s, r);
    o->halves[e][end] = child;
    oracle_add(r->neighbours, 1, other);
    if (s > 0) oracle_add(r->crease, 1, other);
    if (child > 0) oracle_add(r->child_crease, 1, other);
    r->sharp += s > 0;
    r->child_sharp += child > 0;
    if (o->chaikin ? s > 0 && child <= 0 : s > 0 && s <= 1) {
        r->fading++;
        r->fading_sum += s;
    }
}

static inline void oracle_find_rings(oracle *o, const oracle_mesh *m)
{
    memset(o->rings, 0, sizeof *o->rings * (size_t)m->vertex_count);
    memset(o->edge_faces, 0, sizeof *o->edge_faces * (size_t)m->edge_count);
    for (int e = 0; e < m->edge_count; e++) {
        for (int i = 0; i < 2 && oracle_is_semi(m->crease[e]); i++) {
            o->rings[m->ends[e][i]].semi++;
            o->rings[m->ends[e][i]].semi_sum += m->crease[e];
        }
    }
    for (int e = 0; e < m->edge_count; e++)
        for (int i = 0; i < 2; i++) oracle_meet_edge(o, m, e, i);
    for (int f = 0; f < m->face_count; f++) {
        for (int h = m->start[f]; h < m->start[f + 1]; h++) {
            oracle_ring *r = &o->rings[m->vertices[h]];
            r->faces++;
            o->edge_faces[m->edges[h]]++;
            oracle_add(r->opposite, 1, m->points[m->vertices[oracle_turn(m, f, h, 2)]]);
        }
    }
}

// --------------------------------------------------------------------------------------- masks

typedef enum oracle_rule { ORACLE_SMOOTH, ORACLE_CREASE, ORACLE_CORNER } oracle_rule;

static inline oracle_rule oracle_rule_of(float corner, int sharp_edges)
{
    if (corner > 0 || sharp_edges > 2) return ORACLE_CORNER;
    return sharp_edges == 2 ? ORACLE_CREASE : ORACLE_SMOOTH;
}

static inline double oracle_loop_weight(int n)
{
    const double c = 0.375 + cos(8 * atan(1.0) / n) / 4;
    return (0.625 - c * c) / n;
}

// Adds w times the vertex point of a rule. sum: of the child points of the faces.
static inline void oracle_vertex_point(const oracle *o, const double *p, const oracle_ring *r,
                                       const double *sum, oracle_rule rule, const double *crease,
                                       double w, double *out)
{
    const double n = r->faces;
    if (rule == ORACLE_CORNER) {
        oracle_add(out, w, p);
    } else if (rule == ORACLE_CREASE) {
        oracle_add(out, 0.75 * w, p);
        oracle_add(out, 0.125 * w, crease);
    } else if (o->scheme == SUBDIV_LOOP) {
        const double b = oracle_loop_weight(r->faces);
        oracle_add(out, w * (1 - n * b), p);
        oracle_add(out, w * b, r->neighbours);
    } else {
        oracle_add(out, w * (n - 2) / n, p);
        oracle_add(out, w / (n * n), r->neighbours);
        oracle_add(out, w / (n * n), sum);
    }
}

static inline void oracle_blend_vertex(oracle *o, const oracle_mesh *m, int v, const double *sum,
                                       oracle_mesh *to)
{
    const oracle_ring *r = &o->rings[v];
    const float child_corner = oracle_fade(m->corner[v]);
    const oracle_rule rule = oracle_rule_of(m->corner[v], r->sharp);
    const oracle_rule child = oracle_rule_of(child_corner, r->child_sharp);
    double *out = to->points[v], w = 0;
    to->corner[v] = child_corner;
    memset(out, 0, sizeof to->points[v]);
    if (o->scheme == SUBDIV_BILINEAR || r->faces == 0) {
        oracle_add(out, 1, m->points[v]);
        return;
    }
    if (rule != ORACLE_SMOOTH && rule != child) {
        const int ends = m->corner[v] > 0 && child_corner <= 0, count = r->fading + ends;
        const double total = (double)(r->fading_sum + (ends ? m->corner[v] : 0));
        if (count > 0) w = fmin(1, total / count);
        oracle_vertex_point(o, m->points[v], r, sum, child, r->child_crease, 1 - w, out);
    } else {
        w = 1;
    }
    oracle_vertex_point(o, m->points[v], r, sum, rule, r->crease, w, out);
}

// sum: of the child points of the edge's faces under Catmull-Clark, of the vertices across under
// Loop; triangles: how many of the faces are some.
static inline void oracle_edge_point(oracle *o, const oracle_mesh *m, int e, const double *sum,
                                     int triangles, double *out)
{
    const float s = m->crease[e];
    const int n = o->edge_faces[e], loop = o->scheme == SUBDIV_LOOP;
    double w = s > 1 ? 1 : (double)s, face = loop ? 0.25 / n : 0.5 / n;
    if ((o->halves[e][0] > 0 && o->halves[e][1] > 0) || o->scheme == SUBDIV_BILINEAR) w = 1;
    if (!loop && n == 2 && triangles && o->smooth_triangles) face = triangles == 2 ? 0.47 : 0.36;
    for (int i = 0; i < 2; i++)
        oracle_add(out, 0.5 * w + (1 - w) * 0.5 * (1 - n * face), m->points[m->ends[e][i]]);
    oracle_add(out, (1 - w) * face, sum);
}

// The limit of a vertex all of whose faces are there and have one size.
static inline void oracle_limit_point(const oracle *o, const oracle_mesh *m, int v, double *out)
{
    const oracle_ring *r = &o->rings[v];
    const oracle_rule rule = oracle_rule_of(m->corner[v], r->sharp);
    const double *p = m->points[v];
    const int n = r->faces;
    memset(out, 0, 3 * sizeof *out);
    if (rule == ORACLE_CORNER || o->scheme == SUBDIV_BILINEAR) {
        oracle_add(out, 1, p);
    } else if (rule == ORACLE_CREASE) {
        oracle_add(out, 2.0 / 3, p);
        oracle_add(out, 1.0 / 6, r->crease);
    } else if (o->scheme == SUBDIV_LOOP) {
        const double w = 1 / (n + 0.375 / oracle_loop_weight(n));
        oracle_add(out, 1 - n * w, p);
        oracle_add(out, w, r->neighbours);
    } else {
        oracle_add(out, n / (n + 5.0), p);
        oracle_add(out, 4 / (n * (n + 5.0)), r->neighbours);
        oracle_add(out, 1 / (n * (n + 5.0)), r->opposite);
    }
}

// ---------------------------------------------------------------------------------- refinement

// Children: of vertices, of edges; of faces, unless Loop, come last.
static inline void oracle_refine_points(oracle *o, const oracle_mesh *m, oracle_mesh *to)
{
    static double vertex_sums[ORACLE_MOST][3], edge_sums[ORACLE_MOST][3];
    static int triangles[ORACLE_MOST];
    const int loop = o->scheme == SUBDIV_LOOP, first_face = m->vertex_count + m->edge_count;
    memset(vertex_sums, 0, sizeof *vertex_sums * (size_t)m->vertex_count);
    memset(edge_sums, 0, sizeof *edge_sums * (size_t)m->edge_count);
    memset(triangles, 0, sizeof *triangles * (size_t)m->edge_count);
    to->vertex_count = first_face + (loop ? 0 : m->face_count);
    memset(to->points, 0, sizeof *to->points * (size_t)to->vertex_count);
    memset(to->corner, 0, sizeof *to->corner * (size_t)to->vertex_count);
    for (int f = 0; f < m->face_count; f++) {
        const int n = oracle_size(m, f);
        double *point = to->points[first_face + f];
        for (int h = m->start[f]; h < m->start[f + 1] && !loop; h++)
            oracle_add(point, 1.0 / n, m->points[m->vertices[h]]);
        for (int h = m->start[f]; h < m->start[f + 1]; h++) {
            const double *across = m->points[m->vertices[oracle_turn(m, f, h, 2)]];
            oracle_add(edge_sums[m->edges[h]], 1, loop ? across : point);
            if (!loop) oracle_add(vertex_sums[m->vertices[h]], 1, point);
            triangles[m->edges[h]] += n == 3;
        }
    }
    for (int v = 0; v < m->vertex_count; v++) oracle_blend_vertex(o, m, v, vertex_sums[v], to);
    for (int e = 0; e < m->edge_count; e++)
        oracle_edge_point(o, m, e, edge_sums[e], triangles[e], to->points[m->vertex_count + e]);
}

static inline void oracle_set_edge(oracle_mesh *to, int e, int a, int b, float sharpness)
{
    to->ends[e][0] = a;
    to->ends[e][1] = b;
    to->crease[e] = sharpness;
}

// The child of face-vertex h's edge (or of the edge before) at h's vertex. Children of edge e are
// 2 e and 2 e + 1; the edges inside the faces follow, one for each face-vertex.
static inline int oracle_edge_child(const oracle_mesh *m, int f, int h, int before)
{
    const int e = m->edges[before ? oracle_turn(m, f, h, -1) : h];
    return 2 * e + (m->ends[e][0] != m->vertices[h]);
}

static inline void oracle_set_face(oracle_mesh *to, int size, int turn, const int *v, const int *e)
{
    const int start = to->start[to->face_count++];
    for (int i = 0; i < size; i++) {
        to->vertices[start + (i + turn) % size] = v[i];
        to->edges[start + (i + turn) % size] = e[i];
    }
    to->start[to->face_count] = start + size;
}

// The child at each vertex of a face. That of a quad has the axes of its parent.
static inline void oracle_refine_polygon(const oracle_mesh *m, int f, oracle_mesh *to)
{
    const int V = m->vertex_count, first = 2 * m->edge_count, n = oracle_size(m, f);
    const int centre = V + m->edge_count + f;
    for (int i = 0; i < n; i++) {
        const int h = m->start[f] + i, before = oracle_turn(m, f, h, -1);
        const int v[4] = { m->vertices[h], V + m->edges[h], centre, V + m->edges[before] };
        const int e[4] = { oracle_edge_child(m, f, h, 0), first + h, first + before,
                           oracle_edge_child(m, f, h, 1) };
        oracle_set_edge(to, first + h, centre, v[1], 0);
        oracle_set_face(to, 4, n == 4 ? i : 0, v, e);
    }
}

// Three children like their parent, and the middle one, turned by half. Edge i inside is the one
// that cuts off vertex i.
static inline void oracle_refine_triangle(const oracle_mesh *m, int f, oracle_mesh *to)
{
    const int V = m->vertex_count, first = 2 * m->edge_count + m->start[f];
    int v[3], e[3];
    for (int i = 0; i < 3; i++) {
        const int h = m->start[f] + i;
        const int corner[3] = { m->vertices[h], V + m->edges[h],
                                V + m->edges[oracle_turn(m, f, h, -1)] };
        const int around[3] = { oracle_edge_child(m, f, h, 0), first + i,
                                oracle_edge_child(m, f, h, 1) };
        oracle_set_edge(to, first + i, corner[1], corner[2], 0);
        oracle_set_face(to, 3, i, corner, around);
        v[i] = V + m->edges[m->start[f] + (i + 1) % 3];
        e[i] = first + (i + 2) % 3;
    }
    oracle_set_face(to, 3, 0, v, e);
}

static inline void oracle_refine(oracle *o, const oracle_mesh *m, oracle_mesh *to)
{
    const int loop = o->scheme == SUBDIV_LOOP, corners = m->start[m->face_count];
    to->edge_count = 2 * m->edge_count + corners;
    o->overflow |= to->edge_count > ORACLE_MOST || 4 * corners > ORACLE_MOST
                || 4 * m->face_count > ORACLE_MOST_FACES || corners > ORACLE_MOST_FACES;
    if (o->overflow) return;
    oracle_find_rings(o, m);
    oracle_refine_points(o, m, to);
    for (int e = 0; e < m->edge_count; e++)
        for (int i = 0; i < 2; i++)
            oracle_set_edge(to, 2 * e + i, m->ends[e][i], m->vertex_count + e, o->halves[e][i]);
    to->face_count = to->start[0] = 0;
    for (int f = 0; f < m->face_count; f++) {
        if (loop) oracle_refine_triangle(m, f, to);
        else oracle_refine_polygon(m, f, to);
    }
}

// ------------------------------------------------------------------------------------ two rings

static inline int oracle_number(int *map, int i, int *count)
{
    if (map[i] < 0) map[i] = (*count)++;
    return map[i];
}

// Marks the vertices of face f, then twice those of the faces that have a marked one. Marks count
// down, so that the faces of the last ring do not mark more.
static inline void oracle_mark_rings(oracle *o, const oracle_mesh *m, int f)
{
    memset(o->marks, 0, (size_t)m->vertex_count);
    for (int h = m->start[f]; h < m->start[f + 1]; h++) o->marks[m->vertices[h]] = 2;
    for (int g = 0; g < m->face_count; g++) {
        int near = 0;
        for (int h = m->start[g]; h < m->start[g + 1]; h++) near |= o->marks[m->vertices[h]] == 2;
        for (int h = m->start[g]; h < m->start[g + 1] && near; h++)
            if (!o->marks[m->vertices[h]]) o->marks[m->vertices[h]] = 1;
    }
}

// Keeps the faces of two rings around face f; returns its new number.
static inline int oracle_keep_rings(oracle *o, const oracle_mesh *m, int f, oracle_mesh *to)
{
    int new_face = 0;
    oracle_mark_rings(o, m, f);
    for (int v = 0; v < m->vertex_count; v++) o->map[v] = -1;
    for (int e = 0; e < m->edge_count; e++) o->edge_map[e] = -1;
    to->vertex_count = to->edge_count = to->face_count = to->start[0] = 0;
    for (int g = 0; g < m->face_count; g++) {
        int near = 0, at = to->start[to->face_count];
        for (int h = m->start[g]; h < m->start[g + 1]; h++) near |= o->marks[m->vertices[h]];
        if (!near) continue;
        for (int h = m->start[g]; h < m->start[g + 1]; h++, at++) {
            const int v = m->vertices[h], e = m->edges[h];
            to->vertices[at] = oracle_number(o->map, v, &to->vertex_count);
            to->edges[at] = oracle_number(o->edge_map, e, &to->edge_count);
            memcpy(to->points[to->vertices[at]], m->points[v], sizeof m->points[v]);
            to->corner[to->vertices[at]] = m->corner[v];
            to->crease[to->edges[at]] = m->crease[e];
        }
        if (g == f) new_face = to->face_count;
        to->start[++to->face_count] = at;
    }
    for (int e = 0; e < m->edge_count; e++)
        for (int i = 0; i < 2 && o->edge_map[e] >= 0; i++)
            to->ends[o->edge_map[e]][i] = o->map[m->ends[e][i]];
    return new_face;
}

// ------------------------------------------------------------------------------------- the cage

// Edges as the faces first meet them; an edge that a face has twice, and one from a vertex to
// itself, is one more. odd: of each edge, whether it is not manifold.
static inline void oracle_find_edges(oracle *o, unsigned char *odd)
{
    oracle_mesh *m = &o->cage;
    memset(o->edge_faces, 0, sizeof o->edge_faces);
    for (int f = 0; f < m->face_count; f++) {
        for (int h = m->start[f]; h < m->start[f + 1]; h++) {
            const int a = m->vertices[h], b = m->vertices[oracle_turn(m, f, h, 1)];
            int e = 0, again = 0;
            while (e < m->edge_count && (a == b || !((m->ends[e][0] == a && m->ends[e][1] == b) ||
                                                     (m->ends[e][0] == b && m->ends[e][1] == a))))
                e++;
            for (int g = m->start[f]; g < h && e < m->edge_count; g++) again |= m->edges[g] == e;
            if (again) odd[e] = 1;
            if (again) e = m->edge_count;
            if (e == m->edge_count) {
                oracle_set_edge(m, m->edge_count++, a, b, 0);
                odd[e] = again || a == b;
            } else if (m->ends[e][0] == a || o->edge_faces[e] > 1) {
                odd[e] = 1;
            }
            o->edge_faces[e]++;
            m->edges[h] = e;
        }
    }
}

// Are the faces at v one fan? Grows it from the first of them over edges at v.
static inline int oracle_is_fan(const oracle *o, int v, int *face_count)
{
    const oracle_mesh *m = &o->cage;
    static unsigned char edge_in[ORACLE_MOST], face_in[ORACLE_MOST_FACES];
    int found = 0, grown = 1;
    *face_count = 0;
    memset(edge_in, 0, (size_t)m->edge_count);
    memset(face_in, 0, (size_t)m->face_count);
    while (grown) {
        grown = 0;
        for (int f = 0; f < m->face_count; f++) {
            for (int h = m->start[f]; h < m->start[f + 1] && !face_in[f]; h++) {
                const int out = m->edges[h], in = m->edges[oracle_turn(m, f, h, -1)];
                if (m->vertices[h] != v || (found && !edge_in[out] && !edge_in[in])) continue;
                edge_in[out] = edge_in[in] = face_in[f] = 1;
                found++;
                grown = 1;
            }
        }
    }
    for (int h = 0; h < m->start[m->face_count]; h++) *face_count += m->vertices[h] == v;
    return found == *face_count;
}

// Does every sheet of faces at v reach both edges there that are not manifold? Spreads from each of
// the two over edges at v that are manifold.
static inline int oracle_sheets_lead_through(const oracle *o, const unsigned char *odd, int v)
{
    const oracle_mesh *m = &o->cage;
    static unsigned char in[2][ORACLE_MOST];                // edges and, behind, face-vertices
    int found[2] = { -1, -1 }, all = 1;
    for (int e = 0; e < m->edge_count; e++)
        if (odd[e] && (m->ends[e][0] == v || m->ends[e][1] == v)) found[found[0] >= 0] = e;
    for (int i = 0, grown = 1; i < 2; i++, grown = 1) {
        static unsigned char edge_in[ORACLE_MOST];
        memset(in[i], 0, sizeof in[i]);
        memset(edge_in, 0, sizeof edge_in);
        edge_in[found[i]] = 1;
        while (grown) {
            grown = 0;
            for (int f = 0; f < m->face_count; f++)
                for (int h = m->start[f]; h < m->start[f + 1]; h++) {
                    const int out = m->edges[h], back = m->edges[oracle_turn(m, f, h, -1)];
                    if (m->vertices[h] != v || in[i][h] || !(edge_in[out] || edge_in[back])) continue;
                    in[i][h] = 1;
                    grown = 1;
                    if (!odd[out]) edge_in[out] = 1;
                    if (!odd[back]) edge_in[back] = 1;
                }
        }
    }
    for (int h = 0; h < m->start[m->face_count]; h++)
        all &= m->vertices[h] != v || (in[0][h] && in[1][h]);
    return all;
}

// Boundaries and what is not manifold are sharp forever, but a vertex where fins pass through.
static inline void oracle_sharpen(oracle *o, const subdiv_mesh *cage)
{
    static unsigned char odd[ORACLE_MOST];
    oracle_mesh *m = &o->cage;
    oracle_find_edges(o, odd);
    for (int i = 0; i < cage->crease_count; i++) {
        const int a = cage->crease_vertices[2 * i], b = cage->crease_vertices[2 * i + 1];
        for (int e = 0; e < m->edge_count; e++) {
            if (!((m->ends[e][0] == a && m->ends[e][1] == b) ||
                  (m->ends[e][0] == b && m->ends[e][1] == a))) continue;
            m->crease[e] = cage->crease_sharpness[i];
            break;
        }
    }
    for (int i = 0; i < cage->corner_count; i++)
        m->corner[cage->corner_vertices[i]] = cage->corner_sharpness[i];
    for (int e = 0; e < m->edge_count; e++) {
        const int open = o->edge_faces[e] < 2 && m->crease[e] < SUBDIV_INFINITE;
        if (open && cage->boundary == SUBDIV_BOUNDARY_NONE && cage->scheme != SUBDIV_BILINEAR)
            o->bare[m->ends[e][0]] = o->bare[m->ends[e][1]] = 1;
        if (o->edge_faces[e] < 2 || odd[e]) m->crease[e] = SUBDIV_INFINITE;
    }
    for (int v = 0; v < m->vertex_count; v++) {
        int faces, edges = 0, boundary = 0, odd_edges = 0;
        const int fan = oracle_is_fan(o, v, &faces);
        for (int e = 0; e < m->edge_count; e++) {
            if (m->ends[e][0] != v && m->ends[e][1] != v) continue;
            edges++;
            boundary += o->edge_faces[e] < 2;
            odd_edges += odd[e];
        }
        const int through = odd_edges == 2 && boundary == 0 && faces > edges
                         && oracle_sheets_lead_through(o, odd, v);
        if ((odd_edges || !fan) && !through) m->corner[v] = SUBDIV_INFINITE;
        if (cage->boundary == SUBDIV_BOUNDARY_EDGE_AND_CORNER && faces == 1 && edges == 2)
            m->corner[v] = SUBDIV_INFINITE;
    }
}

// Boundary rule "none" leaves no surface to faces at a boundary that is not sharp.
static inline int oracle_is_bare(const oracle *o, int f)
{
    for (int h = o->cage.start[f]; h < o->cage.start[f + 1]; h++)
        if (o->bare[o->cage.vertices[h]]) return 1;
    return 0;
}

static inline void oracle_close(oracle *o)
{
    free(o);
}

// Returns 0 without memory and for cages that are too large. The positions are copied.
static inline int oracle_open(oracle **result, const subdiv_mesh *cage)
{
    int corners = 0;
    for (int f = 0; f < cage->face_count; f++)
        corners += cage->face_size ? cage->face_size : cage->face_sizes[f];
    const int fits = cage->vertex_count <= ORACLE_MOST && cage->face_count <= ORACLE_MOST_FACES
                  && corners <= ORACLE_MOST;
    oracle *o = *result = fits ? (oracle *)calloc(1, sizeof *o) : NULL;
    if (!o) return 0;
    oracle_mesh *m = &o->cage;
    o->scheme = cage->scheme;
    o->chaikin = cage->creasing == SUBDIV_CREASING_CHAIKIN;
    o->smooth_triangles = cage->triangles == SUBDIV_TRIANGLES_SMOOTH;
    m->vertex_count = cage->vertex_count;
    m->face_count = cage->face_count;
    for (int f = 0; f < cage->face_count; f++)
        m->start[f + 1] = m->start[f] + (cage->face_size ? cage->face_size : cage->face_sizes[f]);
    memcpy(m->vertices, cage->face_vertices, sizeof(int) * (size_t)m->start[m->face_count]);
    for (int i = 0; i < 3 * cage->vertex_count; i++)
        m->points[i / 3][i % 3] = (double)cage->positions[i];
    oracle_sharpen(o, cage);
    return 1;
}

// ---------------------------------------------------------------------------------- evaluation

// The child of face f of o->part that has the place, which becomes the place in it. step: how du of
// the child's parameters has to be multiplied.
static inline int oracle_child(const oracle *o, int f, int corner, double uv[2], double *step)
{
    const int size = oracle_size(&o->part, f);
    double *u = &uv[0], *v = &uv[1];
    if (o->scheme == SUBDIV_LOOP) {
        const int i = *u >= 0.5 ? 1 : *v >= 0.5 ? 2 : *u + *v <= 0.5 ? 0 : 3;
        const double sign = i == 3 ? -1 : 1;
        *u = sign * (2 * *u - (i == 1 || i == 3));
        *v = sign * (2 * *v - (i == 2 || i == 3));
        *step *= 2 * sign;
        return 4 * f + i;
    }
    if (size != 4) return o->part.start[f] + corner;
    const int right = *u >= 0.5, up = *v >= 0.5;
    *u = 2 * *u - right;
    *v = 2 * *v - up;
    *step *= 2;
    return o->part.start[f] + (up ? 3 - right : right);
}

// out: the point, d/du and d/dv. depth: levels, at least 1. With few levels, what is still sharp on
// the last one counts as sharp forever. Returns 0 if there is too much around the place.
static inline int oracle_evaluate(oracle *o, int face, int corner, double u, double v, int depth,
                                  double out[3][3])
{
    double uv[2] = { u, v }, step = 1, p[4][3];
    int f = oracle_keep_rings(o, &o->cage, face, &o->part);
    memset(out, 0, 9 * sizeof out[0][0]);
    for (int l = 0; l < depth; l++) {
        oracle_refine(o, &o->part, &o->level);
        if (o->overflow) return 0;
        f = oracle_child(o, f, corner, uv, &step);
        f = oracle_keep_rings(o, &o->level, f, &o->part);
    }
    oracle_find_rings(o, &o->part);
    for (int i = 0; i < oracle_size(&o->part, f); i++)
        oracle_limit_point(o, &o->part, o->part.vertices[o->part.start[f] + i], p[i]);
    u = uv[0];
    v = uv[1];
    const int loop = o->scheme == SUBDIV_LOOP;
    const double quad[3][4] = { { (1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v },
                                { v - 1, 1 - v, v, -v }, { u - 1, -u, u, 1 - u } };
    const double triangle[3][4] = { { 1 - u - v, u, v, 0 }, { -1, 1, 0, 0 }, { -1, 0, 1, 0 } };
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < (loop ? 3 : 4); i++)
            oracle_add(out[k], (loop ? triangle : quad)[k][i] * (k ? step : 1), p[i]);
    return 1;
}

#endif
