// The limit surface at any place, the slow way: slow.h refines the two rings of faces around the
// place, the two rings around the child that has the place are kept, and so on. Masks average, so
// the limit lies between the points of those rings: when they are close enough, it is known.
//
//     slow_mesh *m = slow_cage(&cage, 0);
//     oracle_evaluate(m, face, corner, u, v, out);     out: the point, d/du, d/dv
//
// Both derivatives are differences over the last face: as exact as it is small.
#ifndef EXACT_ORACLE_H
#define EXACT_ORACLE_H

#include "slow_cage.h"

enum { ORACLE_MOST_LEVELS = 120 };

// Keeps the faces of two rings around face f, which becomes the face returned.
static inline int oracle_keep_rings(slow_mesh **mesh, int f)
{
    slow_mesh *m = *mesh;
    const int corners = m->start[m->face_count];
    slow_mesh *to = slow_mesh_new(m, m->vertex_count, m->edge_count, m->face_count, corners);
    int *ring = (int *)slow_new(m->vertex_count, sizeof *ring);         // 1: of f, 2: one face on
    int *vertex = (int *)slow_new(m->vertex_count, sizeof *vertex);     // here, from 1
    int *edge = (int *)slow_new(m->edge_count, sizeof *edge), kept = 0;
    for (int h = m->start[f]; h < m->start[f + 1]; h++) ring[m->vertices[h]] = 1;
    for (int pass = 1; pass < 3; pass++)
        for (int g = 0; g < m->face_count; g++) {
            int keep = 0, first = to->start[to->face_count];
            for (int h = m->start[g]; h < m->start[g + 1]; h++) {
                const int r = ring[m->vertices[h]];
                keep |= r > 0 && r <= pass;
            }
            if (g == f && pass == 2) kept = to->face_count;
            for (int h = m->start[g]; h < m->start[g + 1] && keep; h++) {
                const int v = m->vertices[h], e = m->edges[h];
                if (!ring[v]) ring[v] = pass + 1;
                if (pass == 1) continue;
                if (!vertex[v]) vertex[v] = ++to->vertex_count;
                if (!edge[e]) edge[e] = ++to->edge_count;
                to->vertices[first + h - m->start[g]] = vertex[v] - 1;
                to->edges[first + h - m->start[g]] = edge[e] - 1;
            }
            if (!keep || pass == 1) continue;
            to->start[++to->face_count] = first + slow_size(m, g);
        }
    for (int v = 0; v < m->vertex_count; v++) {
        if (!vertex[v]) continue;
        memcpy(to->points[vertex[v] - 1], m->points[v], sizeof m->points[v]);
        to->corner[vertex[v] - 1] = m->corner[v];
    }
    for (int e = 0; e < m->edge_count; e++)
        if (edge[e]) slow_set_edge(to, edge[e] - 1, vertex[m->ends[e][0]] - 1,
                                   vertex[m->ends[e][1]] - 1, m->crease[e]);
    free(ring), free(vertex), free(edge);
    *mesh = to;
    return kept;
}

// The child of face f that has the place, which becomes the place in it. step: how du of the
// child's parameters has to be multiplied.
static inline int oracle_child(const slow_mesh *m, int f, int corner, double uv[2], double *step)
{
    double *u = &uv[0], *v = &uv[1];
    if (m->loop) {
        const int i = *u >= 0.5 ? 1 : *v >= 0.5 ? 2 : *u + *v <= 0.5 ? 0 : 3;
        const double sign = i == 3 ? -1 : 1;
        *u = sign * (2 * *u - (i == 1 || i == 3));
        *v = sign * (2 * *v - (i == 2 || i == 3));
        *step *= 2 * sign;
        return 4 * f + i;
    }
    if (slow_size(m, f) != 4) return m->start[f] + corner;
    const int right = *u >= 0.5, up = *v >= 0.5;
    *u = 2 * *u - right;
    *v = 2 * *v - up;
    *step *= 2;
    return m->start[f] + (up ? 3 - right : right);
}

// The largest extent of the points.
static inline double oracle_extent(const slow_mesh *m)
{
    double largest = 0;
    for (int k = 0; k < 3; k++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int v = 0; v < m->vertex_count; v++) {
            low = fmin(low, m->points[v][k]);
            high = fmax(high, m->points[v][k]);
        }
        largest = fmax(largest, high - low);
    }
    return largest;
}

static inline void oracle_evaluate(const slow_mesh *cage, int face, int corner, double u, double v,
                                   double out[3][3])
{
    double uv[2] = { u, v }, step = 1, small_enough = 1e-8 * oracle_extent(cage);
    slow_mesh *m = (slow_mesh *)cage, *fine;
    int f = oracle_keep_rings(&m, face);
    for (int l = 0; l < 1 || (l < ORACLE_MOST_LEVELS && oracle_extent(m) > small_enough); l++) {
        fine = slow_refine(m, NULL);
        f = oracle_child(m, f, corner, uv, &step);
        slow_free(m);
        m = fine;
        f = oracle_keep_rings(&m, f);
        slow_free(fine);
    }
    u = uv[0];
    v = uv[1];
    const double quad[3][4] = { { (1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v },
                                { v - 1, 1 - v, v, -v }, { u - 1, -u, u, 1 - u } };
    const double triangle[3][4] = { { 1 - u - v, u, v, 0 }, { -1, 1, 0, 0 }, { -1, 0, 1, 0 } };
    memset(out, 0, 9 * sizeof out[0][0]);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < slow_size(m, f); i++)
            slow_add(out[k], (m->loop ? triangle : quad)[k][i] * (k ? step : 1),
                     m->points[m->vertices[m->start[f] + i]]);
    slow_free(m);
}

#endif
