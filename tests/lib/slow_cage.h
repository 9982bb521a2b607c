// The cage as slow.h refines it: its edges, what of it is sharp, and the mesh of its UVs.
#ifndef SLOW_CAGE_H
#define SLOW_CAGE_H

#include "slow.h"

// --------------------------------------------------------------------------------------- the cage

static inline int slow_joins(const slow_mesh *m, int e, int a, int b)
{
    return (m->ends[e][0] == a && m->ends[e][1] == b) || (m->ends[e][0] == b && m->ends[e][1] == a);
}

// Edges as the faces first meet them. An edge that a face has a second time, and one from a vertex
// to itself, is one more. Not manifold, odd, are these, the edges of three faces or more, and those
// that two faces follow in the same direction.
static inline void slow_find_edges(slow_mesh *m, int *face_count)
{
    for (int f = 0; f < m->face_count; f++) {
        for (int h = m->start[f]; h < m->start[f + 1]; h++) {
            const int a = m->vertices[h], b = m->vertices[slow_turn(m, f, h, 1)];
            int e = 0, again = 0;
            while (e < m->edge_count && (a == b || !slow_joins(m, e, a, b))) e++;
            const int found = e < m->edge_count;
            for (int g = m->start[f]; g < h; g++) again |= found && m->edges[g] == e;
            if (again || (found && (m->ends[e][0] == a || face_count[e] > 1))) m->odd_edge[e] = 1;
            if (!found || again) {
                e = m->edge_count++;
                slow_set_edge(m, e, a, b, 0);
                m->odd_edge[e] = (unsigned char)(again || a == b);
            }
            face_count[e]++;
            m->edges[h] = e;
        }
    }
}

// What is at a vertex of the cage. A sheet: faces joined there at edges that are manifold.
typedef struct slow_vertex {
    int faces, edges, boundary, odd, sheets, through;   // through: each sheet has both odd edges
} slow_vertex;

static inline slow_vertex slow_look_at(const slow_mesh *m, int v, const int *face_count)
{
    slow_vertex at = { 0, 0, 0, 0, 0, 1 };
    const int corners = m->start[m->face_count];
    int (*edges)[2] = (int (*)[2])slow_new(corners, sizeof *edges);     // of each face here
    int *sheet = (int *)slow_new(corners, sizeof *sheet);
    for (int f = 0; f < m->face_count; f++)
        for (int h = m->start[f]; h < m->start[f + 1]; h++)
            if (m->vertices[h] == v) {
                edges[at.faces][0] = m->edges[h];
                edges[at.faces][1] = m->edges[slow_turn(m, f, h, -1)];
                sheet[at.faces] = at.faces;
                at.faces++;
            }
    for (int e = 0; e < m->edge_count; e++) {
        const int times = (m->ends[e][0] == v) + (m->ends[e][1] == v);
        at.edges += times;
        at.boundary += times && face_count[e] < 2;
        at.odd += times && m->odd_edge[e];
    }
    for (int i = 0; i < at.faces; i++)
        for (int j = 0; j < 4 * i; j++) {
            const int e = edges[i][j % 2], from = sheet[i], to = sheet[j / 4];
            if (m->odd_edge[e] || e != edges[j / 4][j / 2 % 2]) continue;
            for (int k = 0; k < at.faces; k++) if (sheet[k] == from) sheet[k] = to;
        }
    for (int i = 0; i < at.faces; i++) {
        int ways = 0, first = -1;                       // different odd edges of the sheet of i
        for (int j = 0; j < 2 * at.faces; j++) {
            const int e = edges[j / 2][j % 2];
            if (sheet[j / 2] != sheet[i] || !m->odd_edge[e] || e == first) continue;
            first = e;
            ways++;
        }
        at.through &= ways >= 2;
        at.sheets += sheet[i] == i;
    }
    free(edges), free(sheet);
    return at;
}

static inline float slow_listed(float s)
{
    return s > SUBDIV_INFINITE ? SUBDIV_INFINITE : s > 0 ? s : 0;
}

// By the lists, the later of two entries; the first edge between two vertices.
static inline void slow_read_lists(slow_mesh *m, const subdiv_mesh *cage)
{
    for (int i = 0; i < cage->crease_count; i++) {
        const int a = cage->crease_vertices[2 * i], b = cage->crease_vertices[2 * i + 1];
        int e = 0;
        while (e < m->edge_count && !slow_joins(m, e, a, b)) e++;
        if (e < m->edge_count) m->crease[e] = slow_listed(cage->crease_sharpness[i]);
    }
    for (int i = 0; i < cage->corner_count; i++)
        m->corner[cage->corner_vertices[i]] = slow_listed(cage->corner_sharpness[i]);
    for (int i = 0; i < cage->hole_count; i++) m->hidden[cage->holes[i]] = 1;
}

// By the shape: boundaries and what is not manifold are sharp forever, but for a vertex through
// which a crease of two odd edges runs. Boundary rule "none" drops the faces at a boundary that the
// lists do not make sharp.
static inline void slow_look_at_shape(slow_mesh *m, const subdiv_mesh *cage, const int *face_count)
{
    unsigned char *open = (unsigned char *)slow_new(m->vertex_count, 1);
    for (int e = 0; e < m->edge_count; e++) {
        if (m->crease[e] >= SUBDIV_INFINITE) continue;
        if (face_count[e] < 2) open[m->ends[e][0]] = open[m->ends[e][1]] = 1;
        if (face_count[e] < 2 || m->odd_edge[e]) m->crease[e] = slow_by_shape;
    }
    for (int f = 0; f < m->face_count; f++)
        for (int h = m->start[f]; h < m->start[f + 1]; h++)
            if (open[m->vertices[h]] && cage->boundary == SUBDIV_BOUNDARY_NONE &&
                cage->scheme != SUBDIV_BILINEAR) m->hidden[f] = m->dropped[f] = 1;
    for (int v = 0; v < m->vertex_count; v++) {
        const slow_vertex at = slow_look_at(m, v, face_count);
        const int through = at.odd == 2 && at.boundary == 0 && at.faces > at.edges && at.through;
        const int single = at.faces == 1 && at.edges == 2 &&
                           cage->boundary == SUBDIV_BOUNDARY_EDGE_AND_CORNER;
        m->odd_vertex[v] = at.odd > 0 || at.sheets != 1;
        if (m->corner[v] < SUBDIV_INFINITE && (single || (m->odd_vertex[v] && !through)))
            m->corner[v] = slow_by_shape;
    }
    free(open);
}

static inline slow_mesh *slow_cage(const subdiv_mesh *cage, int linear)
{
    int corners = 0;
    for (int f = 0; f < cage->face_count; f++)
        corners += cage->face_size ? cage->face_size : cage->face_sizes[f];
    slow_mesh *m = slow_mesh_new(NULL, cage->vertex_count, corners, cage->face_count, corners);
    int *face_count = (int *)slow_new(corners, sizeof *face_count);
    m->odd_edge = (unsigned char *)slow_new(corners, 1);
    m->odd_vertex = (unsigned char *)slow_new(cage->vertex_count, 1);
    m->hidden = (unsigned char *)slow_new(cage->face_count, 1);
    m->dropped = (unsigned char *)slow_new(cage->face_count, 1);
    m->loop = cage->scheme == SUBDIV_LOOP;
    m->linear = cage->scheme == SUBDIV_BILINEAR || linear;
    m->chaikin = cage->creasing == SUBDIV_CREASING_CHAIKIN;
    m->smooth_triangles = cage->triangles == SUBDIV_TRIANGLES_SMOOTH;
    m->rule = cage->vertex_rule;
    m->vertex_count = cage->vertex_count;
    m->face_count = cage->face_count;
    for (int f = 0; f < cage->face_count; f++) {
        m->start[f + 1] = m->start[f] + (cage->face_size ? cage->face_size : cage->face_sizes[f]);
        m->places[f].face = f;
    }
    for (int h = 0; h < corners; h++) m->vertices[h] = cage->face_vertices[h];
    for (int i = 0; i < 3 * cage->vertex_count; i++)
        m->points[i / 3][i % 3] = (double)cage->positions[i];
    slow_find_edges(m, face_count);
    slow_read_lists(m, cage);
    slow_look_at_shape(m, cage, face_count);
    free(face_count);
    return m;
}

// --------------------------------------------------------------------------------------------- UVs

// UVs are a mesh of their own: the faces that have a UV at each vertex, cut open along seams. Its
// vertices are the pairs of a vertex of the cage and a value there. A seam is an edge whose faces
// differ at either end, or only some of which have UVs. Seams are boundaries.
typedef struct slow_cut {
    const slow_mesh *m;
    const int *values;                // of face-vertices
    unsigned char *has;               // of faces
    unsigned char *seam, *boundary;   // of edges, and of their ends; boundary: of the cage itself
    unsigned char *at_seam, *at_boundary;
    int *own, *value;                 // of face-vertices: the vertex here; of those: their value
    int *values_at, *faces_at;        // of vertices of the cage: how many
    int *size, *forever, *semi;       // of vertices here: faces, infinitely sharp edges, semi-sharp
} slow_cut;

// Do the face of h and that of k, which share an edge there, differ at its ends?
static inline int slow_differ(const slow_cut *c, int f, int h, int g, int k)
{
    const int turn = c->m->vertices[h] != c->m->vertices[k];
    if (!c->has[f] || !c->has[g]) return c->has[f] != c->has[g];
    return c->values[h] != c->values[slow_turn(c->m, g, k, turn)] ||
           c->values[slow_turn(c->m, f, h, 1)] != c->values[slow_turn(c->m, g, k, 1 - turn)];
}

static inline void slow_cut_new(slow_cut *c, const slow_mesh *m, const int *values)
{
    const int corners = m->start[m->face_count];
    c->m = m;
    c->values = values;
    c->has = (unsigned char *)slow_new(m->face_count, 1);
    c->seam = (unsigned char *)slow_new(2 * m->edge_count, 1);
    c->boundary = c->seam + m->edge_count;
    c->at_seam = (unsigned char *)slow_new(2 * m->vertex_count, 1);
    c->at_boundary = c->at_seam + m->vertex_count;
    c->own = (int *)slow_new(5 * corners, sizeof *c->own);
    c->value = c->own + corners;
    c->size = c->value + corners;
    c->forever = c->size + corners;
    c->semi = c->forever + corners;
    c->values_at = (int *)slow_new(2 * m->vertex_count, sizeof *c->values_at);
    c->faces_at = c->values_at + m->vertex_count;
    for (int h = 0; h < corners; h++) c->faces_at[m->vertices[h]]++;
}

static inline void slow_find_seams(slow_cut *c)
{
    const slow_mesh *m = c->m;
    int *first = (int *)slow_new(m->edge_count, sizeof *first);
    int *face = (int *)slow_new(m->edge_count, sizeof *face);
    for (int e = 0; e < m->edge_count; e++) face[e] = -1;
    for (int f = 0; f < m->face_count; f++) {
        c->has[f] = 1;
        for (int h = m->start[f]; h < m->start[f + 1]; h++) c->has[f] &= c->values[h] >= 0;
    }
    for (int f = 0; f < m->face_count; f++)
        for (int h = m->start[f]; h < m->start[f + 1]; h++) {
            const int e = m->edges[h];
            c->boundary[e] = face[e] < 0;
            if (face[e] >= 0) c->seam[e] |= (unsigned char)slow_differ(c, f, h, face[e], first[e]);
            if (face[e] < 0) face[e] = f, first[e] = h;
        }
    for (int e = 0; e < m->edge_count; e++)
        for (int i = 0; i < 2; i++) {
            c->at_seam[m->ends[e][i]] |= c->seam[e];
            c->at_boundary[m->ends[e][i]] |= c->boundary[e];
        }
    free(first), free(face);
}

// The vertex of the UVs' mesh for face-vertex h.
static inline int slow_uv_vertex(slow_cut *c, slow_mesh *uvs, const subdiv_mesh *cage, int h)
{
    const int v = c->m->vertices[h];
    int i = 0;
    while (i < uvs->vertex_count && (uvs->home[i] != v || c->value[i] != c->values[h])) i++;
    if (i == uvs->vertex_count) {
        uvs->vertex_count++;
        uvs->home[i] = v;
        uvs->partner[i] = -1;
        uvs->corner[i] = c->m->corner[v];
        for (int k = 0; k < 2; k++) uvs->points[i][k] = (double)cage->uvs[2 * c->values[h] + k];
        c->value[i] = c->values[h];
        c->values_at[v]++;
    }
    c->size[i]++;
    return i;
}

// The edge there from face-vertex h on; its ends are in the order of the cage's edge.
static inline int slow_uv_edge(slow_cut *c, slow_mesh *uvs, int f, int h)
{
    const int e = c->m->edges[h], next = slow_turn(c->m, f, h, 1);
    const int turn = c->m->vertices[h] != c->m->ends[e][0];
    int i = 0;
    while (i < uvs->edge_count && (c->seam[e] || uvs->twin[i] != e)) i++;
    if (i < uvs->edge_count) return i;
    slow_set_edge(uvs, uvs->edge_count++, c->own[turn ? next : h], c->own[turn ? h : next],
                  c->seam[e] ? SUBDIV_INFINITE : c->m->crease[e]);
    uvs->twin[i] = e;
    for (int k = 0; k < 2; k++) {
        c->forever[uvs->ends[i][k]] += uvs->crease[i] >= SUBDIV_INFINITE;
        c->semi[uvs->ends[i][k]] += slow_is_semi(uvs->crease[i]);
    }
    return i;
}

// The six rules, for vertex i. Two values at a vertex may make each other sharp: forever, or as
// long as one of them is semi-sharp.
static inline void slow_uv_rule(const slow_cut *c, slow_mesh *uvs, subdiv_uv_rule rule, int i)
{
    const int v = uvs->home[i], count = c->values_at[v], cut = c->at_seam[v];
    const int plus = rule == SUBDIV_UV_CORNERS_PLUS1 || rule == SUBDIV_UV_CORNERS_PLUS2;
    int other = i, sharp = c->m->odd_vertex[v] && (cut || count > 1);
    for (int k = 0; k < uvs->vertex_count && count == 2; k++)
        if (k != i && uvs->home[k] == v) other = k;
    if (rule != SUBDIV_UV_NONE) sharp |= c->size[i] == 1;
    if (rule == SUBDIV_UV_BOUNDARIES) sharp |= cut || c->at_boundary[v];
    if (plus) sharp |= count > 2 || (count == 2 && (c->forever[i] > 2 || c->forever[other] > 2));
    if (rule == SUBDIV_UV_CORNERS_PLUS2) {
        sharp |= count == 2 && c->size[other] == 1;
        sharp |= cut && c->size[i] == c->faces_at[v] && !c->at_boundary[v];      // a dart
    }
    if (sharp) uvs->corner[i] = SUBDIV_INFINITE;
    else if (plus && count == 2 && c->semi[other] && !c->semi[i] && uvs->corner[i] <= 0)
        uvs->partner[i] = other;
}

static inline slow_mesh *slow_uvs(const slow_mesh *m, const subdiv_mesh *cage)
{
    const int corners = m->start[m->face_count];
    slow_cut c;
    if (!cage->uv_count) return NULL;
    slow_mesh *uvs = slow_mesh_new(m, corners, corners, m->face_count, corners);
    uvs->linear |= cage->uv_rule == SUBDIV_UV_ALL;
    uvs->rule = SUBDIV_VERTEX_STANDARD;
    uvs->twin = (int *)slow_new(corners, sizeof *uvs->twin);
    uvs->partner = (int *)slow_new(corners, sizeof *uvs->partner);
    uvs->home = (int *)slow_new(corners, sizeof *uvs->home);
    slow_cut_new(&c, m, cage->face_uvs);
    slow_find_seams(&c);
    for (int f = 0; f < m->face_count; f++) {
        const int n = slow_size(m, f), first = m->start[f], start = uvs->start[uvs->face_count];
        if (!c.has[f]) continue;
        for (int h = first; h < first + n; h++) c.own[h] = slow_uv_vertex(&c, uvs, cage, h);
        for (int h = first; h < first + n; h++) {
            uvs->vertices[start + h - first] = c.own[h];
            uvs->edges[start + h - first] = slow_uv_edge(&c, uvs, f, h);
        }
        uvs->places[uvs->face_count++] = m->places[f];
        uvs->start[uvs->face_count] = start + n;
    }
    for (int i = 0; i < uvs->vertex_count; i++) slow_uv_rule(&c, uvs, cage->uv_rule, i);
    free(c.has), free(c.seam), free(c.at_seam), free(c.own), free(c.values_at);
    return uvs;
}

#endif
