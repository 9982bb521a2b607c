// --curve: refines the polylines of the cage.
#include "cli.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

// A polyline of the cage is closed if it ends with its first vertex.
typedef struct polyline {
    subdiv_curve_ends ends;
    int size, count;                  // its vertices, and the points that they become
} polyline;

static polyline polyline_of(const command *cmd, const int *vertices, int size)
{
    polyline line = { SUBDIV_ENDS_KEPT, size, 0 };
    if (vertices[0] == vertices[size - 1]) line.ends = SUBDIV_ENDS_CLOSED, line.size--;
    line.count = subdiv_curve_point_count((subdiv_curve_rule)cmd->given[CURVE], line.ends,
                                          line.size, levels_of(cmd));
    return line;
}

// Refines values of the cage's vertices in place: those of the polyline become those of its points.
static void refine_polyline(const command *cmd, polyline line, const int *vertices,
                            const float *values, float *points, const subdiv_options *opt)
{
    for (int i = 0; i < line.size; i++)
        memcpy(points + 3 * i, values + 3 * (size_t)vertices[i], 3 * sizeof *points);
    subdiv_curve((subdiv_curve_rule)cmd->given[CURVE], line.ends, levels_of(cmd), 3, line.size,
                 points, 3, points, 3, opt);
}

// Gives fine arrays for so many points and polylines that have so many vertices.
static subdiv_result make_room_for_curves(work *w, size_t points, size_t vertices,
                                          const subdiv_options *opt)
{
    const subdiv_mesh *cage = &w->cage;
    subdiv_error *error = opt->error;
    if (cage->line_count == 0) strcpy(error->message, "there are no polylines (l) to refine");
    if (cage->line_count == 0) return SUBDIV_ERROR_EMPTY;
    w->points = points > INT_MAX ? NULL : (float *)malloc(3 * points * sizeof *w->points + 1);
    w->colors = !w->points || !cage->colors ? NULL
              : (float *)malloc(3 * points * sizeof *w->colors + 1);
    w->numbers = (int *)malloc(((size_t)cage->line_count + vertices) * sizeof *w->numbers);
    if (!w->points || !w->numbers || (cage->colors && !w->colors)) {
        strcpy(error->message, "the curves have too many points");
        return SUBDIV_ERROR_TOO_LARGE;
    }
    w->fine.vertex_count = (int)points;
    w->fine.positions = w->points;
    w->fine.colors = w->colors;
    w->fine.line_count = cage->line_count;
    w->fine.line_sizes = w->numbers;
    w->fine.line_vertices = w->numbers + cage->line_count;
    return SUBDIV_OK;
}

// Makes fine of the refined polylines.
subdiv_result refine_curves(work *w, const command *cmd, const subdiv_options *opt)
{
    const subdiv_mesh *cage = &w->cage;
    const int *v = cage->line_vertices;
    size_t points = 0, vertices = 0;
    for (int i = 0; i < cage->line_count; v += cage->line_sizes[i++]) {
        polyline line = polyline_of(cmd, v, cage->line_sizes[i]);
        points += line.count ? (size_t)line.count : (size_t)INT_MAX + 1;
        vertices += (size_t)line.count + (line.ends == SUBDIV_ENDS_CLOSED);
    }
    // A point takes 12 bytes of a page, a piece of a line 8.
    subdiv_result result = cmd->given[HTML] != 1 ? SUBDIV_OK
                         : check_page(cmd, 12 * (double)points + 8 * (double)vertices, opt);
    if (!result) result = make_room_for_curves(w, points, vertices, opt);
    int *to = w->fine.line_vertices, first = 0;
    v = cage->line_vertices;
    for (int i = 0; i < cage->line_count && !result; v += cage->line_sizes[i++]) {
        polyline line = polyline_of(cmd, v, cage->line_sizes[i]);
        size_t at = 3 * (size_t)first;
        refine_polyline(cmd, line, v, cage->positions, w->points + at, opt);
        if (w->colors) refine_polyline(cmd, line, v, cage->colors, w->colors + at, opt);
        for (int k = 0; k < line.count; k++) *to++ = first + k;
        if (line.ends == SUBDIV_ENDS_CLOSED) *to++ = first;
        w->fine.line_sizes[i] = line.count + (line.ends == SUBDIV_ENDS_CLOSED);
        first += line.count;
    }
    return result;
}
