// What --picture shows of a mesh: its shape, wherever it is and however large, and the
// creases of its cage.
#include "cli.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Marks the vertices that faces and polylines have. Returns NULL when out of memory.
static char *find_used(const subdiv_mesh *mesh)
{
    char *used = (char *)calloc((size_t)mesh->vertex_count + 1, 1);
    const int *vertex = mesh->face_vertices;
    for (int f = 0; f < mesh->face_count && used; f++)
        for (int i = mesh->face_size ? mesh->face_size : mesh->face_sizes[f]; i > 0; i--)
            used[*vertex++] = 1;
    vertex = mesh->line_vertices;
    for (int i = 0; i < mesh->line_count && used; i++)
        for (int k = mesh->line_sizes[i]; k > 0; k--) used[*vertex++] = 1;
    return used;
}

subdiv_result frame_mesh(frame *box, const subdiv_mesh *mesh, const subdiv_options *opt)
{
    char *used = find_used(mesh);
    if (used == NULL) return set_error(opt, SUBDIV_ERROR_MEMORY, "out of memory");
    for (size_t v = 0; v < (size_t)mesh->vertex_count; v++) {
        for (size_t k = 0; k < 3 && used[v]; k++) {
            double x = (double)mesh->positions[3 * v + k];
            if (!box->is_full || x < box->low[k]) box->low[k] = x;
            if (!box->is_full || x > box->high[k]) box->high[k] = x;
        }
        if (used[v]) box->is_full = 1;
    }
    free(used);
    return SUBDIV_OK;
}

// A crease of the cage or an edge of its surface, from its lower-numbered vertex.
typedef struct segment { int low, high, edge; } segment;

static int compare_segments(const void *a, const void *b)
{
    const segment *s = (const segment *)a, *t = (const segment *)b;
    if (s->low != t->low) return s->low < t->low ? -1 : 1;
    return (s->high > t->high) - (s->high < t->high);
}

// Lists the edges of a surface, sorted by their vertices. NULL when out of memory.
static segment *sorted_edges(const subdiv_surface *surface)
{
    size_t count = (size_t)subdiv_surface_edge_count(surface);
    segment *edges = (segment *)malloc((count + 1) * sizeof *edges);
    int *ends = (int *)malloc((2 * count + 1) * sizeof *ends);
    if (edges && ends) {
        subdiv_surface_edges(surface, ends);
        for (size_t e = 0; e < count; e++) {
            edges[e].low = ends[2 * e];
            edges[e].high = ends[2 * e + 1];
            edges[e].edge = (int)e;
        }
        qsort(edges, count, sizeof *edges, compare_segments);
    } else {
        free(edges);
        edges = NULL;
    }
    free(ends);
    return edges;
}

// Gives the mesh, whose cage's edges have so many pieces, the creases of the cage: by THE ORDER OF
// THE RESULT, the points inside the edges come behind the cage's vertices.
static void mark_creases(subdiv_mesh *mesh, const subdiv_mesh *cage, const segment *edges,
                         size_t edge_count, int pieces)
{
    mesh->crease_count = 0;
    for (int c = 0; c < cage->crease_count; c++) {
        const int *ends = cage->crease_vertices + 2 * (size_t)c;
        segment crease = {ends[0] < ends[1] ? ends[0] : ends[1],
                          ends[0] < ends[1] ? ends[1] : ends[0], 0};
        const segment *found = &crease;
        if (edges)
            found = (const segment *)bsearch(&crease, edges, edge_count, sizeof *edges,
                                             compare_segments);
        if (found == NULL || cage->crease_sharpness[c] <= 0) continue;
        int inside = cage->vertex_count + found->edge * (pieces - 1);
        for (int i = 0; i < pieces; i++, mesh->crease_count++) {
            int *v = mesh->crease_vertices + 2 * (size_t)mesh->crease_count;
            v[0] = i == 0 ? crease.low : inside + i - 1;
            v[1] = i + 1 == pieces ? crease.high : inside + i;
            mesh->crease_sharpness[mesh->crease_count] = cage->crease_sharpness[c];
        }
    }
}

subdiv_result place_points(float *to, const subdiv_mesh *mesh, const frame *box,
                           const subdiv_options *opt)
{
    double centre[3], radius = 0;
    char *used = find_used(mesh);
    if (used == NULL) return set_error(opt, SUBDIV_ERROR_MEMORY, "out of memory");
    for (int k = 0; k < 3; k++) {
        centre[k] = (box->low[k] + box->high[k]) / 2;
        radius += (box->high[k] - centre[k]) * (box->high[k] - centre[k]);
    }
    radius = sqrt(radius);
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++) {
        double x = (double)mesh->positions[i] - centre[i % 3];
        to[i] = used[i / 3] && radius > 0 ? (float)(x / radius) : 0;
    }
    free(used);
    return SUBDIV_OK;
}

subdiv_result make_shape(shape *s, const subdiv_mesh *mesh, const frame *box,
                         const subdiv_mesh *cage, const subdiv_surface *surface, int pieces,
                         const subdiv_options *opt)
{
    size_t creases = surface ? (size_t)cage->crease_count * (size_t)pieces : 0;
    segment *edges = sorted_edges(surface);
    subdiv_result result = SUBDIV_OK;
    s->mesh = *mesh;
    s->mesh.memory = NULL;            // mesh keeps it
    if (s->mesh.normals == NULL) result = subdiv_normals(&s->mesh, opt);
    s->positions = (float *)malloc(3 * sizeof(float) * ((size_t)mesh->vertex_count + 1));
    s->creases = (int *)malloc((2 * sizeof(int) + sizeof(float)) * (creases + 1));
    if (!result && (!edges || !s->positions || !s->creases))
        result = set_error(opt, SUBDIV_ERROR_MEMORY, "out of memory");
    if (!result && box) result = place_points(s->positions, mesh, box, opt);
    if (!result) {
        if (box) s->mesh.positions = s->positions;
        s->mesh.crease_vertices = s->creases;
        s->mesh.crease_sharpness = (float *)(s->creases + 2 * creases);
        mark_creases(&s->mesh, cage, edges, (size_t)subdiv_surface_edge_count(surface), pieces);
        s->mesh.corner_count = surface ? cage->corner_count : 0;
        s->mesh.corner_vertices = cage->corner_vertices;
        s->mesh.corner_sharpness = cage->corner_sharpness;
    }
    free(edges);
    return result;
}

void free_shape(shape *s)
{
    subdiv_mesh_free(&s->mesh);       // the normals
    free(s->positions);
    free(s->creases);
}
