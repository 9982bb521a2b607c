// The library behind the page, as WebAssembly: a cage, the surface prepared for it, and what the
// page draws. The page calls these functions and looks into this memory; build.sh compiles it.
#define SUBDIV_STATIC
#define SUBDIV_IMPLEMENTATION
#define SUBDIV_NO_STDIO
#define SUBDIV_NO_EXACT
#include "subdiv.h"

#define EXPORT __attribute__((visibility("default"), used))

enum { STRIDE = 6 };                        // floats of a vertex: position and normal

static subdiv_error     error;
static subdiv_mesh      cage;               // as loaded, but its creases are those of the page
static subdiv_surface  *surface;
static subdiv_mesh      fine;
static subdiv_buffer    buffer;
static subdiv_explanation explanation;
static float *vertices;                     // [STRIDE * buffer.vertex_count]
static void  *scratch;
static int   *wire, *triangle_faces;        // [8 * face_count], [triangles]
static int   *edges;                        // [2 * edge_count]
static float *edge_sharpness;               // [edge_count]
static int   *edge_creases;                 // [edge_count]: where in the cage's creases, or -1
static int    edge_count, crease_room, limit;
static char   text[1 << 16];

// ------------------------------------------------------------------------------- memory

EXPORT void *take(size_t size)    { return malloc(size); }
EXPORT void give(void *memory)    { free(memory); }
EXPORT char *message(void)        { return error.message; }
EXPORT char *warning(void)        { return error.warning_count ? error.warning : ""; }

static void *array(size_t count, size_t size)
{
    return calloc(count ? count : 1, size);
}

static void forget(void)
{
    subdiv_surface_free(surface);
    subdiv_mesh_free(&fine);
    subdiv_buffer_free(&buffer);
    subdiv_explanation_free(&explanation);
    free(vertices), free(scratch), free(wire), free(triangle_faces);
    free(edges), free(edge_sharpness), free(edge_creases);
    surface = NULL;
    vertices = NULL, scratch = NULL, wire = triangle_faces = NULL;
    edges = NULL, edge_sharpness = NULL, edge_creases = NULL;
    edge_count = 0;
}

// --------------------------------------------------------------------------------- cage

// Takes the creases into arrays of the page, which grow with each edge that is sharpened.
static int own_creases(void)
{
    int *ends = array(2 * (size_t)cage.crease_count + 64, sizeof *ends);
    float *sharpness = array((size_t)cage.crease_count + 32, sizeof *sharpness);
    if (!ends || !sharpness) return 0;
    for (int i = 0; i < cage.crease_count; i++) {
        ends[2 * i] = cage.crease_vertices[2 * i];
        ends[2 * i + 1] = cage.crease_vertices[2 * i + 1];
        sharpness[i] = cage.crease_sharpness[i];
    }
    if (crease_room) free(cage.crease_vertices), free(cage.crease_sharpness);
    crease_room = cage.crease_count + 32;
    cage.crease_vertices = ends;
    cage.crease_sharpness = sharpness;
    return 1;
}

EXPORT int load(const char *obj, size_t size)
{
    subdiv_mesh loaded;
    subdiv_options opt = {0};
    opt.error = &error;
    error.warning_count = 0;
    if (subdiv_load_obj_memory(&loaded, obj, size, &opt)) return error.code;
    if (crease_room) free(cage.crease_vertices), free(cage.crease_sharpness);
    crease_room = 0;
    subdiv_mesh_free(&cage);
    cage = loaded;
    return own_creases() ? SUBDIV_OK : SUBDIV_ERROR_MEMORY;
}

// Writes the cage into memory that the page gives back. Returns NULL for an error.
EXPORT char *save(size_t *size)
{
    subdiv_options opt = {0};
    opt.error = &error;
    if (subdiv_save_obj_memory(&cage, NULL, 0, size, &opt)) return NULL;
    char *obj = malloc(*size + 1);
    if (obj && subdiv_save_obj_memory(&cage, obj, *size + 1, size, &opt)) free(obj), obj = NULL;
    return obj;
}

EXPORT void set(int scheme, int boundary, int creasing, int rule, int triangles)
{
    cage.scheme = (subdiv_scheme)scheme;
    cage.boundary = (subdiv_boundary)boundary;
    cage.creasing = (subdiv_creasing)creasing;
    cage.vertex_rule = (subdiv_vertex_rule)rule;
    cage.triangles = (subdiv_triangles)triangles;
}

// Gives an edge a sharpness; the surface has to be rebuilt.
EXPORT int sharpen(int edge, float sharpness)
{
    int i = edge_creases[edge];
    if (i < 0) {
        if (cage.crease_count == crease_room && !own_creases()) return SUBDIV_ERROR_MEMORY;
        i = edge_creases[edge] = cage.crease_count++;
        cage.crease_vertices[2 * i] = edges[2 * edge];
        cage.crease_vertices[2 * i + 1] = edges[2 * edge + 1];
    }
    cage.crease_sharpness[i] = edge_sharpness[edge] = sharpness;
    return SUBDIV_OK;
}

// ------------------------------------------------------------------------------ surface

// New positions on the same topology: all that happens while a vertex is dragged.
EXPORT int evaluate(void)
{
    subdiv_options opt = {0};
    subdiv_vertices out = {0};
    opt.error = &error;
    out.positions = vertices;
    out.normals = limit ? vertices + 3 : NULL;
    out.stride = STRIDE;
    return (int)subdiv_evaluate_buffer(&buffer, surface, cage.positions, &out, scratch, &opt);
}

static int size_of(const subdiv_mesh *mesh, int face)
{
    return mesh->face_size ? mesh->face_size : mesh->face_sizes[face];
}

// Lists the face of the cage that each triangle is a part of, and the edges of all faces. Returns
// how many faces' sides there are.
static int list_faces(void)
{
    int triangle = 0, side = 0;
    const int *face = fine.face_vertices;
    for (int f = 0; f < fine.face_count; face += size_of(&fine, f), f++) {
        int size = size_of(&fine, f);
        for (int i = 2; i < size; i++) triangle_faces[triangle++] = fine.cage_faces[f];
        for (int i = 0; i < size; i++, side++) {
            wire[2 * side] = face[i];
            wire[2 * side + 1] = face[(i + 1) % size];
        }
    }
    return side;
}

// Finds the creases of the edges, of several at one edge the last: first and next list the edges
// by their lower-numbered vertices, counted from 1.
static void find_creases(int *first, int *next)
{
    for (int e = 0; e < edge_count; e++) {
        next[e] = first[edges[2 * e]];
        first[edges[2 * e]] = e + 1;
        edge_creases[e] = -1;
    }
    for (int i = 0; i < cage.crease_count; i++) {
        int a = cage.crease_vertices[2 * i], b = cage.crease_vertices[2 * i + 1];
        int e = first[a < b ? a : b] - 1;
        while (e >= 0 && edges[2 * e + 1] != (a < b ? b : a)) e = next[e] - 1;
        if (e < 0) continue;
        edge_creases[e] = i;
        edge_sharpness[e] = cage.crease_sharpness[i];
    }
}

static int list_edges(const subdiv_mesh *plain, const subdiv_options *opt)
{
    subdiv_surface *once;
    if (subdiv_prepare(&once, plain, 1, opt)) return 0;
    edge_count = subdiv_surface_edge_count(once);
    edges = array(2 * (size_t)edge_count, sizeof *edges);
    edge_sharpness = array((size_t)edge_count, sizeof *edge_sharpness);
    edge_creases = array((size_t)edge_count, sizeof *edge_creases);
    int *first = array((size_t)cage.vertex_count, sizeof *first);
    int *next = array((size_t)edge_count, sizeof *next);
    int made = edges && edge_sharpness && edge_creases && first && next;
    if (made) {
        subdiv_surface_edges(once, edges);
        find_creases(first, next);
    }
    subdiv_surface_free(once);
    free(first), free(next);
    return made;
}

// Prepares the surface for what the cage is now. UVs are left out, as nothing here shows them.
EXPORT int rebuild(int levels, int on_limit)
{
    subdiv_mesh plain = cage;
    subdiv_options opt = {0};
    plain.uv_count = 0;
    plain.uvs = NULL;
    plain.face_uvs = NULL;
    opt.error = &error;
    opt.triangulate = 1;
    opt.limit = limit = on_limit;
    forget();
    if (!list_edges(&plain, &opt)) return error.code ? (int)error.code : SUBDIV_ERROR_MEMORY;
    if (subdiv_prepare(&surface, &plain, levels, &opt) ||
        subdiv_surface_mesh(&fine, surface, cage.positions, &opt) ||
        subdiv_make_buffer(&buffer, &fine, 4, &opt)) return (int)error.code;
    size_t sides = (size_t)buffer.index_count / 3 + 2 * (size_t)fine.face_count;
    vertices = array(STRIDE * (size_t)buffer.vertex_count, sizeof *vertices);
    scratch = malloc(subdiv_scratch_size(surface, 3) + 1);
    wire = array(2 * sides, sizeof *wire);
    triangle_faces = array((size_t)buffer.index_count / 3, sizeof *triangle_faces);
    if (!vertices || !scratch || !wire || !triangle_faces) return SUBDIV_ERROR_MEMORY;
    list_faces();
    return evaluate();
}

// Pointers and counts for the page: see page.js.
EXPORT int *describe(void)
{
    static int about[19];
    int i = 0;
    about[i++] = cage.vertex_count;
    about[i++] = (int)(size_t)cage.positions;
    about[i++] = cage.face_count;
    about[i++] = edge_count;
    about[i++] = (int)(size_t)edges;
    about[i++] = (int)(size_t)edge_sharpness;
    about[i++] = buffer.vertex_count;
    about[i++] = (int)(size_t)vertices;
    about[i++] = buffer.index_count;
    about[i++] = (int)(size_t)buffer.indices;
    about[i++] = 2 * (buffer.index_count / 3 + 2 * fine.face_count);
    about[i++] = (int)(size_t)wire;
    about[i++] = (int)(size_t)triangle_faces;
    about[i++] = fine.vertex_count;
    about[i++] = fine.face_count;
    about[i++] = cage.line_count;
    about[i++] = cage.boundary;
    about[i++] = cage.creasing;
    about[i++] = cage.triangles;
    return about;
}

EXPORT int face_size(int face)    { return size_of(&cage, face); }
EXPORT int *face_vertices(void)   { return cage.face_vertices; }
EXPORT int *line_vertices(void)   { return cage.line_vertices; }
EXPORT int line_size(void)        { return cage.line_count ? cage.line_sizes[0] : 0; }

// The material of each face, as the OBJ file names them: text of statement i, or NULL.
EXPORT char *statement(int i, int *face)
{
    if (i >= cage.statement_count) return NULL;
    *face = cage.statement_faces[i];
    return cage.statements[i];
}

// ----------------------------------------------------------------------------- pointing

typedef struct point { double x, y, z; } point;

static point minus(point a, point b)
{
    return (point){ a.x - b.x, a.y - b.y, a.z - b.z };
}

static point cross(point a, point b)
{
    return (point){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static double dot(point a, point b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static point vertex(int i)
{
    const float *at = vertices + STRIDE * (size_t)((const unsigned *)buffer.indices)[i];
    return (point){ at[0], at[1], at[2] };
}

// Whether the surface is in front of a point; if it is less than 1 % of the way nearer, it is not.
EXPORT int hidden(float x, float y, float z, float eye_x, float eye_y, float eye_z)
{
    point eye = { eye_x, eye_y, eye_z }, way = minus((point){ x, y, z }, eye);
    for (int i = 0; i < buffer.index_count; i += 3) {
        point a = vertex(i), u = minus(vertex(i + 1), a), v = minus(vertex(i + 2), a);
        point w = minus(eye, a), p = cross(way, v), q = cross(w, u);
        double area = dot(u, p), s = dot(w, p) / area, t = dot(way, q) / area;
        double there = dot(v, q) / area;
        if (s >= 0 && t >= 0 && s + t <= 1 && there > 0 && there < 0.99) return 1;
    }
    return 0;
}

// ------------------------------------------------------------------------------ explain

EXPORT char *explain(int point)
{
    subdiv_options opt = {0};
    opt.error = &error;
    opt.triangulate = 1;
    if (subdiv_explain(text, sizeof text, &cage, point, &opt)) return error.message;
    return text;
}

// The mask of a point of level 1: its size, and where the vertices and weights are.
EXPORT int mask(int point, int **indices, float **weights)
{
    subdiv_options opt = {0};
    opt.error = &error;
    opt.triangulate = 1;
    if (!explanation.count && subdiv_explain_points(&explanation, &cage, &opt)) return 0;
    if (point < 0 || point >= explanation.count) return 0;
    size_t first = explanation.masks.offsets[point];
    *indices = explanation.masks.indices + first;
    *weights = explanation.masks.weights + first;
    return (int)(explanation.masks.offsets[point + 1] - first);
}

// ------------------------------------------------------------------------------- curves

EXPORT int curve_count(int rule, int ends, int count, int levels)
{
    return subdiv_curve_point_count((subdiv_curve_rule)rule, (subdiv_curve_ends)ends, count,
                                    levels);
}

EXPORT int curve(int rule, int ends, int levels, int on_limit, int channels, int count,
                 const float *in, float *out)
{
    subdiv_options opt = {0};
    opt.error = &error;
    opt.limit = on_limit;
    return (int)subdiv_curve((subdiv_curve_rule)rule, (subdiv_curve_ends)ends, levels, channels,
                             count, in, 0, out, 0, &opt);
}
