// Comparing meshes field by field. Include it after subdiv.h.
#ifndef SAME_H
#define SAME_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

static inline int mesh_is_zero(const subdiv_mesh *m)
{
    return !m->vertex_count && !m->positions && !m->face_count && !m->face_size && !m->face_sizes &&
           !m->face_vertices && !m->crease_count && !m->crease_vertices && !m->crease_sharpness &&
           !m->corner_count && !m->corner_vertices && !m->corner_sharpness && !m->hole_count &&
           !m->holes && !m->uv_count && !m->uvs && !m->face_uvs && !m->colors && !m->normals &&
           !m->statement_count && !m->statement_faces && !m->statements &&
           !m->line_count && !m->line_sizes && !m->line_vertices &&
           m->scheme == (subdiv_scheme)0 && m->boundary == (subdiv_boundary)0 &&
           m->creasing == (subdiv_creasing)0 && m->triangles == (subdiv_triangles)0 &&
           m->uv_rule == (subdiv_uv_rule)0 && m->vertex_rule == (subdiv_vertex_rule)0 &&
           !m->vertex_weights && !m->vertex_user && !m->cage_faces && !m->memory &&
           !m->left_handed;
}

static int size_of_face(const subdiv_mesh *m, int f)
{
    return m->face_size ? m->face_size : m->face_sizes[f];
}

static int same_bytes(const void *a, const void *b, int count, size_t size)
{
    return count == 0 || memcmp(a, b, (size_t)count * size) == 0;
}

static int same_statements(const subdiv_mesh *a, const subdiv_mesh *b)
{
    if (a->statement_count != b->statement_count) return 0;
    for (int i = 0; i < a->statement_count; i++)
        if (a->statement_faces[i] != b->statement_faces[i] ||
            strcmp(a->statements[i], b->statements[i]) != 0) return 0;
    return 1;
}

// Bit by bit the same cage, however the sizes of its faces are stored. Normals are not compared:
// they are not read from files.
static inline int same_mesh(const subdiv_mesh *a, const subdiv_mesh *b)
{
    if (a->vertex_count != b->vertex_count || a->face_count != b->face_count ||
        a->crease_count != b->crease_count || a->corner_count != b->corner_count ||
        a->hole_count != b->hole_count || a->line_count != b->line_count ||
        a->scheme != b->scheme || a->boundary != b->boundary ||
        a->creasing != b->creasing || a->triangles != b->triangles || a->uv_rule != b->uv_rule ||
        a->vertex_rule != b->vertex_rule || a->vertex_weights != b->vertex_weights ||
        a->left_handed != b->left_handed)
        return 0;
    int total = 0, on_lines = 0;
    if (!same_bytes(a->line_sizes, b->line_sizes, a->line_count, sizeof(int))) return 0;
    for (int i = 0; i < a->line_count; i++) on_lines += a->line_sizes[i];
    for (int f = 0; f < a->face_count; f++) {
        if (size_of_face(a, f) != size_of_face(b, f)) return 0;
        total += size_of_face(a, f);
    }
    return same_bytes(a->positions, b->positions, 3 * a->vertex_count, sizeof(float)) &&
           same_bytes(a->face_vertices, b->face_vertices, total, sizeof(int)) &&
           same_bytes(a->crease_vertices, b->crease_vertices, 2 * a->crease_count, sizeof(int)) &&
           same_bytes(a->crease_sharpness, b->crease_sharpness, a->crease_count, sizeof(float)) &&
           same_bytes(a->corner_vertices, b->corner_vertices, a->corner_count, sizeof(int)) &&
           same_bytes(a->corner_sharpness, b->corner_sharpness, a->corner_count, sizeof(float)) &&
           same_bytes(a->holes, b->holes, a->hole_count, sizeof(int)) &&
           same_bytes(a->uvs, b->uvs, 2 * a->uv_count, sizeof(float)) &&
           same_bytes(a->face_uvs, b->face_uvs, a->uv_count ? total : 0, sizeof(int)) &&
           same_bytes(a->colors, b->colors, a->colors ? 3 * a->vertex_count : 0, sizeof(float)) &&
           same_bytes(a->line_vertices, b->line_vertices, on_lines, sizeof(int)) &&
           same_statements(a, b);
}

static inline int by_value(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

// How far points [dimensions * count] lie along a direction, sorted.
static inline float *sorted_along(const float *points, int count, int dimensions,
                                  const float *direction)
{
    float *along = (float *)malloc(sizeof *along * ((size_t)count + 1));
    if (!along) abort();
    for (int i = 0; i < count; i++) {
        double sum = 0;
        for (int k = 0; k < dimensions; k++)
            sum += (double)points[dimensions * i + k] * (double)direction[k];
        along[i] = (float)sum;
    }
    qsort(along, (size_t)count, sizeof *along, by_value);
    return along;
}

// The largest difference between two lists of points along three directions, each list sorted: no
// more than that between the points themselves, in whatever order each list has them.
static inline double points_apart(const float *a, const float *b, int count, int dimensions)
{
    static const float directions[3][3] = { { 1, 0.3f, -0.7f }, { -0.2f, 1, 0.6f },
                                            { 0.5f, -0.4f, 1 } };
    double worst = 0;
    for (int k = 0; k < 3; k++) {
        float *x = sorted_along(a, count, dimensions, directions[k]);
        float *y = sorted_along(b, count, dimensions, directions[k]);
        for (int i = 0; i < count; i++) worst = fmax(worst, fabs((double)x[i] - (double)y[i]));
        free(x), free(y);
    }
    return worst;
}

#endif
