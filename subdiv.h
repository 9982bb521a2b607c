/* subdiv.h - v0.1 - subdivision surfaces in one C header - MIT or public domain, see the end

   In goes a cage: a mesh of polygons, with creases, corners and holes if you like. Out comes the
   mesh refined by Catmull-Clark, Loop or bilinear subdivision, as smooth as you ask. The rules are
   those of the papers below and of OpenSubdiv, which the tests compare with, vertex by vertex.

   DO THIS
   -------
   In ONE C or C++ file, to create the implementation:

       #define SUBDIV_IMPLEMENTATION
       #include "subdiv.h"

   Everywhere else just #include "subdiv.h". C99 or C++11, the standard library alone (-lm).

   QUICK START: one call
   ---------------------
       #include <stdio.h>
       #define SUBDIV_IMPLEMENTATION
       #include "subdiv.h"

       int main(void)
       {
           subdiv_mesh cage = {0}, fine = {0};
           subdiv_error error = {0};
           subdiv_options opt = {0};
           opt.error = &error;
           if (subdiv_load_obj(&cage, "cage.obj", &opt) ||
               subdiv_refine(&fine, &cage, 2, &opt) ||
               subdiv_save_obj(&fine, "fine.obj", &opt)) printf("%s\n", error.message);
           subdiv_mesh_free(&fine);
           subdiv_mesh_free(&cage);
           return (int)error.code;
       }

   BY HAND: a cube with a sharp top
   --------------------------------
       float P[] = {-1,-1,-1, 1,-1,-1, 1,1,-1, -1,1,-1, -1,-1,1, 1,-1,1, 1,1,1, -1,1,1};
       int   F[] = {0,3,2,1, 4,5,6,7, 0,1,5,4, 1,2,6,5, 2,3,7,6, 3,0,4,7};
       int   E[] = {4,5, 5,6, 6,7, 7,4};               // the four edges of the top
       float S[] = {2, 2, 2, SUBDIV_INFINITE};         // how many levels each stays sharp

       subdiv_mesh cube = {0};
       cube.vertex_count = 8;  cube.positions = P;
       cube.face_count   = 6;  cube.face_size = 4;  cube.face_vertices    = F;
       cube.crease_count = 4;  cube.crease_vertices = E;  cube.crease_sharpness = S;

   CONTENTS                     search for the tag, for instance >>masks
   --------
   Public:   >>config    macros you may define        >>types    mesh, options, errors
             >>refine    the one call, in two steps   >>obj      reading and writing OBJ
             >>inspect   what a cage is made of
   Inside:   >>platform  >>memory  >>errors  >>validate      the ground everything stands on
             >>level     a mesh with its edges and sharpness: the state of refinement
             >>cage      from polygons to level 0: edges, boundaries, what is non-manifold
             >>sharpness how creases and corners fade  (start here: rules, then masks)
             >>masks     THE LECTURE: face, edge and vertex points of every scheme
             >>rows      the masks of a whole level as rows of weights
             >>split     the faces, edges and sharpness of the next level
             >>order     where each point of the result stands
             >>prepare   all levels of a cage          >>evaluate  values through the rows
             >>numbers   text to float and back        >>obj-read  >>obj-write

   WORDS
   -----
   cage            the mesh you start from            level      how often it has been refined
   face-vertex     one vertex of one face: what others call a face corner or a half-edge
   valence         number of edges at a vertex; 4 is regular for quads, 6 for triangles
   extraordinary   an interior vertex of another valence
   boundary        an edge with one face              non-manifold  an edge with three or more,
                   or a vertex whose faces are not one fan
   face point, edge point, vertex point    what a face, an edge, a vertex becomes one level down
   even, odd       Loop's names: even = vertex points, odd = edge points
   mask            the weights that make such a point from the points around it
   sharpness       how many levels an edge or vertex stays sharp; 0 smooth, >= 10 forever
   crease          a sharp edge                       corner     a sharp vertex
   dart            a vertex where one crease ends     semi-sharp 0 < sharpness < 10
   limit           the smooth surface that refinement tends to

   THE ORDER OF THE RESULT, a promise
   ----------------------------------
   With n = 2^levels:
   * the vertices of the cage come first: vertex i stays vertex i;
   * then the n-1 points inside each edge of the cage, from its lower-numbered end to the other,
     edge by edge, in the order in which the faces first meet them (face 0's edge 0-1, 1-2, ...);
   * then the points inside each face, face by face:

       a quad                3 . . . 2       a triangle under Loop      2
       row by row from       . 7 8 9 .       row by row from            . .
       edge 0-1 to 2-3,      . 4 5 6 .       edge 0-1 to corner 2       . 3 .
       each from edge 3-0    . 1 2 3 .                                  . 1 2 .
       to 1-2                0 . . . 1                                  0 . . . 1

       any other polygon under Catmull-Clark or bilinear: its centre; then the inside of each
       spoke, from the centre to the middle of edge i; then the inside of each quad at vertex i,
       whose corners are vertex i, the middle of edge i, the centre, the middle of edge i-1, and
       whose rows run as those of a quad;
   * the fine faces of cage face f are one contiguous range, in the order of f, row by row (an
     n-gon: quad by quad; in a row of triangles those like the parent and those turned by half
     alternate). The fine face in row r and column c is (r,c) (r,c+1) (r+1,c+1) (r+1,c). A triangle
     is (r,c) (r,c+1) (r+1,c), a turned one (r+1,c+1) (r+1,c) (r,c+1). Faces that are holes are
     left out; their points stay.

   WHAT IT DOES NOT DO (yet)
   -------------------------
   UVs and other face-varying data, limit positions and normals, evaluation at (u, v). Never: GPU
   code, hierarchical edits, hidden threads, global state, printing, exit().

   WHERE IT DIFFERS FROM OPENSUBDIV
   --------------------------------
   * Chaikin creasing: an edge with sharpness > 1 whose end turns smooth is weighted by at most 1;
     OpenSubdiv extrapolates (its weight there is the sharpness itself).
   * The boundary default is edge, theirs is none. Indices are checked. Valence has no limit.

   MEMORY, THREADS, LIMITS
   -----------------------
   A mesh made by the library is one block, freed by subdiv_mesh_free; arrays that you filled in
   are never written nor freed. The library keeps no state: different threads may work at
   once. The same input gives the same bits. Up to 2^31-1 vertices and faces; what does not fit is
   refused before anything is built. Errors leave the output zeroed.

   REFERENCES
   ----------
   [CC78]  Catmull, Clark: Recursively generated B-spline surfaces on arbitrary topological meshes
   [Loop87] Loop: Smooth subdivision surfaces based on triangles
   [HDD94] Hoppe, DeRose, et al.: Piecewise smooth surface reconstruction
   [DKT98] DeRose, Kass, Truong: Subdivision surfaces in character animation
   [OSD]   OpenSubdiv 3.5, Sdc and Far: the rules where the papers are silent

   VERSION LOG
   -----------
   0.1  Catmull-Clark, Loop and bilinear refinement, creases, corners, holes, OBJ. */

#ifndef SUBDIV_H
#define SUBDIV_H

// -------------------------------------------------------------------------------- >>config
// Define these before the #include, in the file with SUBDIV_IMPLEMENTATION:
//
//     SUBDIV_STATIC                  everything static: private to that file
//     SUBDIV_DEF                     your own decoration of the public functions
//     SUBDIV_MALLOC(size, user)      both or neither; user is opt->user. Memory must be aligned
//     SUBDIV_FREE(pointer, user)     as malloc's
//     SUBDIV_ASSERT(condition)       checks of the library's own logic, assert by default
//     SUBDIV_NO_STDIO                no FILE: OBJ through memory and callbacks alone

#define SUBDIV_VERSION 1              // 100 * major + minor

#include <stddef.h>

#ifndef SUBDIV_DEF
#if defined(SUBDIV_STATIC)
#define SUBDIV_DEF static
#elif defined(__cplusplus)
#define SUBDIV_DEF extern "C"
#else
#define SUBDIV_DEF extern
#endif
#endif

// --------------------------------------------------------------------------------- >>types

#define SUBDIV_INFINITE 10.0f         // this sharpness or more never fades

// Code and text of every result.
#define SUBDIV_RESULTS(X)                                          \
    X(SUBDIV_OK,                 "no error")                       \
    X(SUBDIV_ERROR_ARGUMENT,     "invalid argument")               \
    X(SUBDIV_ERROR_EMPTY,        "no vertices")                    \
    X(SUBDIV_ERROR_INDEX,        "index out of range")             \
    X(SUBDIV_ERROR_FACE,         "face with fewer than 3 vertices")\
    X(SUBDIV_ERROR_NOT_TRIANGLE, "Loop needs triangles")           \
    X(SUBDIV_ERROR_NOT_FINITE,   "number not finite")              \
    X(SUBDIV_ERROR_TOO_LARGE,    "too large")                      \
    X(SUBDIV_ERROR_MEMORY,       "out of memory")                  \
    X(SUBDIV_ERROR_IO,           "reading or writing failed")      \
    X(SUBDIV_ERROR_SYNTAX,       "not a valid OBJ file")

#define SUBDIV_X(code, text) code,
typedef enum subdiv_result { SUBDIV_RESULTS(SUBDIV_X) SUBDIV_RESULT_COUNT } subdiv_result;
#undef SUBDIV_X

typedef enum subdiv_scheme {
    SUBDIV_CATMULL_CLARK,             // any polygons; quads after one level [CC78]
    SUBDIV_LOOP,                      // triangles [Loop87]
    SUBDIV_BILINEAR                   // splits as Catmull-Clark, but smooths nothing
} subdiv_scheme;

typedef enum subdiv_boundary {
    SUBDIV_BOUNDARY_EDGE,             // the boundary is a smooth curve, a B-spline
    SUBDIV_BOUNDARY_EDGE_AND_CORNER,  // and passes through vertices that have a single face
    SUBDIV_BOUNDARY_NONE              // faces that touch an unsharpened boundary become holes
} subdiv_boundary;

typedef enum subdiv_creasing {
    SUBDIV_CREASING_UNIFORM,          // sharpness falls by 1 a level
    SUBDIV_CREASING_CHAIKIN           // and is averaged along the crease [DKT98]
} subdiv_creasing;

typedef enum subdiv_triangles {
    SUBDIV_TRIANGLES_CATMULL_CLARK,
    SUBDIV_TRIANGLES_SMOOTH           // rounder where a Catmull-Clark cage has triangles [OSD]
} subdiv_triangles;

typedef enum subdiv_uv_rule {         // kept for OBJ tags; UVs themselves are not refined yet
    SUBDIV_UV_CORNERS_ONLY,
    SUBDIV_UV_CORNERS_PLUS1,
    SUBDIV_UV_CORNERS_PLUS2,
    SUBDIV_UV_BOUNDARIES,
    SUBDIV_UV_ALL,
    SUBDIV_UV_NONE
} subdiv_uv_rule;

// A mesh: the cage that goes in and the result that comes out. Zero it, fill what you have. The
// mesh says what the surface is; the options say what to compute.
typedef struct subdiv_mesh {
    int    vertex_count;
    float *positions;                 // [3 * vertex_count]   x y z, finite

    int    face_count;
    int    face_size;                 // all faces have this many vertices; or 0: see face_sizes
    int   *face_sizes;                // [face_count]         vertices of each face, at least 3
    int   *face_vertices;             // [sum of sizes]       counted from 0, counter-clockwise

    int    crease_count;
    int   *crease_vertices;           // [2 * crease_count]   the ends of an edge, either order
    float *crease_sharpness;          // [crease_count]       levels; the later of two entries wins
    int    corner_count;
    int   *corner_vertices;           // [corner_count]
    float *corner_sharpness;          // [corner_count]
    int    hole_count;
    int   *holes;                     // [hole_count]         faces that shape the surface unseen

    subdiv_scheme    scheme;
    subdiv_boundary  boundary;
    subdiv_creasing  creasing;
    subdiv_triangles triangles;
    subdiv_uv_rule   uv_rule;

    int  *cage_faces;                 // [face_count]         results only: the face of the cage
                                      //                      that each face is a part of
    void *memory;                     // the library's one block, or NULL: the arrays are yours
} subdiv_mesh;

// What went wrong and where. Zero it once; every call given it writes code, place and message
// anew, while warnings (something odd was skipped) add up, and the first one is kept.
typedef struct subdiv_error {
    subdiv_result code;
    int  line;                        // of the OBJ file, from 1; 0 = none
    int  face, vertex;                // of the mesh, from 0; -1 = none
    char message[256];                // "cage.obj:44: vertex 912 does not exist (...)"
    int  warning_count;
    char warning[256];
} subdiv_error;

// How to compute. NULL and {0} are right for most people.
typedef struct subdiv_options {
    int           triangulate;        // Loop: cut larger faces into fans instead of refusing them
    int           keep_holes;         // keep the faces of holes, listed in the result's holes
    int           no_tags;            // OBJ: write no crease, corner, hole and rule tags
    subdiv_error *error;
    void         *user;               // handed to SUBDIV_MALLOC and SUBDIV_FREE
} subdiv_options;

// The text of a result, such as "index out of range". Never NULL.
SUBDIV_DEF const char *subdiv_result_string(subdiv_result result);

// Frees what the library made and zeroes the mesh. Arrays of your own are left alone.
SUBDIV_DEF void subdiv_mesh_free(subdiv_mesh *mesh);

// -------------------------------------------------------------------------------- >>refine

// Refines a cage: fine = the mesh after so many levels, 0 copies. In THE ORDER OF THE RESULT, with
// cage_faces filled, positions in floats, and the sharpness that is left in the crease and corner
// lists, so that fine is a cage again: refine by 2 is refine by 1 twice. (Three things a mesh
// cannot tell the next call: holes, unless kept by the option; an edge along which the faces are
// wound against each other; a vertex twice in a row in a face.)
//
// A crease between vertices that share no edge is skipped with a warning. Levels multiply the
// faces by 4 each. Errors: ARGUMENT, EMPTY, INDEX, FACE, NOT_TRIANGLE, NOT_FINITE, TOO_LARGE (more
// than 2^31-1 vertices or faces), MEMORY.
SUBDIV_DEF subdiv_result subdiv_refine(subdiv_mesh *fine, const subdiv_mesh *cage, int levels,
                                       const subdiv_options *opt);

// The same in two steps. prepare looks at everything but the positions, for a request of so many
// levels; the cage may be freed afterwards. surface_mesh makes the result for the given
// positions [3 * cage vertex_count], as often as you like, also from several threads at once.
typedef struct subdiv_surface subdiv_surface;

SUBDIV_DEF subdiv_result subdiv_prepare(subdiv_surface **surface, const subdiv_mesh *cage,
                                        int levels, const subdiv_options *opt);
SUBDIV_DEF subdiv_result subdiv_surface_mesh(subdiv_mesh *fine, const subdiv_surface *surface,
                                             const float *positions, const subdiv_options *opt);
SUBDIV_DEF void subdiv_surface_free(subdiv_surface *surface);

// ------------------------------------------------------------------------------- >>inspect

// What a cage is made of.
typedef struct subdiv_info {
    int vertex_count, edge_count, face_count;
    int triangle_count, quad_count, ngon_count;  // faces of 3, of 4, of more vertices
    int max_face_size, max_valence;
    int boundary_edge_count;             // edges with one face
    int nonmanifold_edge_count;          // three or more faces, faces wound against each other,
                                         // an edge twice in one face, or both ends the same vertex
    int nonmanifold_vertex_count;        // at such an edge, or whose faces are not one fan
    int isolated_vertex_count;           // without faces
    int extraordinary_vertex_count;      // interior, valence not 4 (Loop: 6)
    int crease_count;                    // edges that the crease list makes sharp, and how many
    int infinite_crease_count;           // of them forever
    int corner_count;                    // vertices that the corner list makes sharp
    int hole_count;                      // faces marked as holes
    int component_count;                 // pieces that share no vertex, isolated vertices apart
} subdiv_info;

// Counts. Errors as subdiv_refine; a Loop cage may hold any faces.
SUBDIV_DEF subdiv_result subdiv_inspect(subdiv_info *info, const subdiv_mesh *mesh,
                                        const subdiv_options *opt);

// ----------------------------------------------------------------------------------- >>obj

// Reads the v and f of a Wavefront OBJ file in all their forms, polygons of any size, lines of any
// length, and OpenSubdiv's tags (counted from 0):
//
//     t crease 2/1/0 v0 v1 sharpness       t hole 1/0/0 face         t smoothtriangles 0/0/1 smooth
//     t corner 1/1/0 v sharpness           t creasemethod 0/0/1 chaikin
//     t interpolateboundary 1/0/0 k        k: 0 none, 1 edge and corner, 2 edge
//     t facevaryinginterpolateboundary 1/0/0 k      k: 0 none, 1 to 3 corners, 4 boundaries, 5 all
//
// UVs, normals, groups and materials are passed over. Faces with fewer than three vertices and
// tags that make no sense are skipped with a warning; what would change the mesh is an error that
// names line and token. Errors: IO, SYNTAX, INDEX, NOT_FINITE, EMPTY, TOO_LARGE, MEMORY.
SUBDIV_DEF subdiv_result subdiv_load_obj_memory(subdiv_mesh *mesh, const void *text, size_t size,
                                                const subdiv_options *opt);

// Stores up to size bytes, more than 0, and returns how many; 0 at the end, (size_t)-1 on failure.
typedef size_t (*subdiv_read)(void *user, void *bytes, size_t size);

SUBDIV_DEF subdiv_result subdiv_load_obj_callback(subdiv_mesh *mesh, subdiv_read read, void *user,
                                                  const subdiv_options *opt);

// Writes v, f and, if there is anything to tell, the tags. Numbers have the fewest digits that
// read back as the same float, in any locale. Errors: ARGUMENT, INDEX, FACE, NOT_FINITE, IO.
//
// To memory: *size becomes the bytes of the whole text, without a terminating 0. Call with
// capacity 0 for the size alone; a capacity that is too small is error TOO_LARGE.
SUBDIV_DEF subdiv_result subdiv_save_obj_memory(const subdiv_mesh *mesh, void *text,
                                                size_t capacity, size_t *size,
                                                const subdiv_options *opt);

// Takes size bytes and returns how many it kept; fewer than size is a failure.
typedef size_t (*subdiv_write)(void *user, const void *bytes, size_t size);

SUBDIV_DEF subdiv_result subdiv_save_obj_callback(const subdiv_mesh *mesh, subdiv_write write,
                                                  void *user, const subdiv_options *opt);

#ifndef SUBDIV_NO_STDIO
SUBDIV_DEF subdiv_result subdiv_load_obj(subdiv_mesh *mesh, const char *path,
                                         const subdiv_options *opt);
SUBDIV_DEF subdiv_result subdiv_save_obj(const subdiv_mesh *mesh, const char *path,
                                         const subdiv_options *opt);
#endif

// ------------------------------------------ End of the public API. You can stop reading here.
#endif // SUBDIV_H

#if defined(SUBDIV_IMPLEMENTATION) && !defined(SUBDIV_IMPLEMENTED)
#define SUBDIV_IMPLEMENTED

// ------------------------------------------------------------------------------ >>platform

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>
#ifndef SUBDIV_NO_STDIO
#include <errno.h>
#include <stdio.h>
#endif

#if defined(SUBDIV_MALLOC) != defined(SUBDIV_FREE)
#error "subdiv.h: define both SUBDIV_MALLOC and SUBDIV_FREE, or neither"
#endif
#ifndef SUBDIV_MALLOC
#include <stdlib.h>
#define SUBDIV_MALLOC(size, user) ((void)(user), malloc(size))
#define SUBDIV_FREE(pointer, user) ((void)(user), free(pointer))
#endif
#ifndef SUBDIV_ASSERT
#include <assert.h>
#define SUBDIV_ASSERT(condition) assert(condition)
#endif

#define SDV_NEW(context, arena, type, count) \
    ((type *)sdv_new(context, arena, (size_t)(count), sizeof(type)))

// -------------------------------------------------------------------------------- >>memory
// Scratch memory is an arena, a chain of blocks freed together. A failed allocation is remembered
// in the context, so a function may ask for several arrays and look at context->result once.

typedef struct sdv_block {
    struct sdv_block *next;
    void *user;
} sdv_block;

typedef struct sdv_arena {
    sdv_block *blocks;
} sdv_arena;

typedef struct sdv_context {            // one call of the library
    subdiv_result result;               // the first error; nothing is done after it
    subdiv_error *error;
    void         *user;
    const char   *name;                 // of the OBJ file, for messages, or NULL
} sdv_context;

static void sdv_fail(sdv_context *context, subdiv_result code, const char *format, ...);

static sdv_block *sdv_allocate(sdv_context *context, size_t size)
{
    sdv_block *block = NULL;
    if (size <= (size_t)PTRDIFF_MAX - sizeof(sdv_block))
        block = (sdv_block *)SUBDIV_MALLOC(size + sizeof(sdv_block), context->user);
    if (!block) {
        sdv_fail(context, SUBDIV_ERROR_MEMORY, "out of memory");
        return NULL;
    }
    block->next = NULL;
    block->user = context->user;
    return block;
}

// Room for count items, not cleared. Never NULL while context->result is SUBDIV_OK.
static void *sdv_new(sdv_context *context, sdv_arena *arena, size_t count, size_t item)
{
    if (context->result) return NULL;
    if (count > (size_t)PTRDIFF_MAX / item) {
        sdv_fail(context, SUBDIV_ERROR_MEMORY, "out of memory");
        return NULL;
    }
    sdv_block *block = sdv_allocate(context, count * item);
    if (!block) return NULL;
    block->next = arena->blocks;
    arena->blocks = block;
    return block + 1;
}

static void sdv_arena_free(sdv_arena *arena)
{
    while (arena->blocks) {
        sdv_block *block = arena->blocks;
        arena->blocks = block->next;
        SUBDIV_FREE(block, block->user);
    }
}

SUBDIV_DEF void subdiv_mesh_free(subdiv_mesh *mesh)
{
    if (!mesh) return;
    if (mesh->memory) {
        sdv_block *block = (sdv_block *)mesh->memory;
        SUBDIV_FREE(block, block->user);
    }
    memset(mesh, 0, sizeof *mesh);
}

// -------------------------------------------------------------------------------- >>errors

SUBDIV_DEF const char *subdiv_result_string(subdiv_result result)
{
#define SUBDIV_X(code, text) text,
    static const char *const texts[] = { SUBDIV_RESULTS(SUBDIV_X) };
#undef SUBDIV_X
    int i = (int)result;
    return i >= 0 && i < SUBDIV_RESULT_COUNT ? texts[i] : "unknown result";
}

static sdv_context sdv_begin(const subdiv_options *opt)
{
    sdv_context context = { SUBDIV_OK, NULL, NULL, NULL };
    if (opt) {
        context.error = opt->error;
        context.user = opt->user;
    }
    if (context.error) {
        context.error->code = SUBDIV_OK;
        context.error->line = 0;
        context.error->face = context.error->vertex = -1;
        context.error->message[0] = 0;
    }
    return context;
}

typedef struct sdv_text {               // a fixed buffer that text is added to until it is full
    char *text;
    size_t size, capacity;
} sdv_text;

static void sdv_put(sdv_text *out, const char *text, size_t size)
{
    for (size_t i = 0; i < size && out->size + 1 < out->capacity; i++)
        out->text[out->size++] = text[i];
    out->text[out->size] = 0;
}

// The decimal digits of a number, at most 20, written backwards from end; returns the first.
static char *sdv_digits(char *end, uint64_t number)
{
    do {
        *--end = (char)('0' + number % 10);
        number /= 10;
    } while (number);
    return end;
}

static void sdv_put_int(sdv_text *out, int number)
{
    char digits[24];
    uint64_t size = number < 0 ? (uint64_t)-(int64_t)number : (uint64_t)number;
    char *first = sdv_digits(digits + sizeof digits, size);
    if (number < 0) *--first = '-';
    sdv_put(out, first, (size_t)(digits + sizeof digits - first));
}

// printf for messages, without locale or stdio. %d: int; %s: text; %t: pointer and int, so many
// bytes, cut short after 40.
static void sdv_format(sdv_text *out, const char *format, va_list args)
{
    for (const char *p = format; *p; p++) {
        if (*p != '%') {
            sdv_put(out, p, 1);
            continue;
        }
        p++;
        if (*p == 'd') {
            sdv_put_int(out, va_arg(args, int));
        } else if (*p == 's') {
            const char *text = va_arg(args, const char *);
            sdv_put(out, text, strlen(text));
        } else {
            const char *text = va_arg(args, const char *);
            int size = va_arg(args, int);
            sdv_put(out, text, (size_t)(size < 40 ? size : 40));
            if (size > 40) sdv_put(out, "...", 3);
        }
    }
}

// "cage.obj:44: ", where the message belongs to a line. Of a long path the end is kept.
static void sdv_put_place(sdv_text *out, const char *name, int line)
{
    if (name) {
        size_t size = strlen(name), skip = size > 100 ? size - 100 : 0;
        if (skip) sdv_put(out, "...", 3);
        sdv_put(out, name + skip, size - skip);
        sdv_put(out, ":", 1);
    } else if (line) {
        sdv_put(out, "line ", 5);
    }
    if (line) {
        sdv_put_int(out, line);
        sdv_put(out, ":", 1);
    }
    if (name || line) sdv_put(out, " ", 1);
}

static void sdv_fail_at(sdv_context *context, subdiv_result code, int line, int face, int vertex,
                        const char *format, va_list args)
{
    if (context->result) return;
    context->result = code;
    if (!context->error) return;
    subdiv_error *error = context->error;
    error->code = code;
    error->line = line;
    error->face = face;
    error->vertex = vertex;
    sdv_text out = { error->message, 0, sizeof error->message };
    sdv_put_place(&out, context->name, line);
    sdv_format(&out, format, args);
}

static void sdv_fail(sdv_context *context, subdiv_result code, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    sdv_fail_at(context, code, 0, -1, -1, format, args);
    va_end(args);
}

static void sdv_fail_line(sdv_context *context, subdiv_result code, int line,
                          const char *format, ...)
{
    va_list args;
    va_start(args, format);
    sdv_fail_at(context, code, line, -1, -1, format, args);
    va_end(args);
}

static void sdv_fail_mesh(sdv_context *context, subdiv_result code, int face, int vertex,
                          const char *format, ...)
{
    va_list args;
    va_start(args, format);
    sdv_fail_at(context, code, 0, face, vertex, format, args);
    va_end(args);
}

static void sdv_warn(sdv_context *context, int line, const char *format, ...)
{
    subdiv_error *error = context->error;
    if (!error || error->warning_count == INT_MAX || error->warning_count++ > 0) return;
    va_list args;
    va_start(args, format);
    sdv_text out = { error->warning, 0, sizeof error->warning };
    sdv_put_place(&out, context->name, line);
    sdv_format(&out, format, args);
    va_end(args);
}

// ------------------------------------------------------------------------------ >>validate
// Everything behind this section may trust the mesh: all arrays there, all indices in range.

static int sdv_face_size(const subdiv_mesh *mesh, int face)
{
    return mesh->face_size ? mesh->face_size : mesh->face_sizes[face];
}

// All faces together, in face-vertices.
static size_t sdv_face_vertex_count(const subdiv_mesh *mesh)
{
    if (mesh->face_size) return (size_t)mesh->face_count * (size_t)mesh->face_size;
    size_t count = 0;
    for (int f = 0; f < mesh->face_count; f++) count += (size_t)mesh->face_sizes[f];
    return count;
}

static void sdv_check_array(sdv_context *context, const char *name, int count, const void *array)
{
    if (count < 0)
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "%s: the count is %d", name, count);
    else if (count > 0 && !array)
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "%s is NULL, its count %d", name, count);
}

static void sdv_check_rules(sdv_context *context, const subdiv_mesh *mesh)
{
    const struct { const char *name; int value, count; } rules[] = {
        { "scheme",    (int)mesh->scheme,    SUBDIV_BILINEAR + 1 },
        { "boundary",  (int)mesh->boundary,  SUBDIV_BOUNDARY_NONE + 1 },
        { "creasing",  (int)mesh->creasing,  SUBDIV_CREASING_CHAIKIN + 1 },
        { "triangles", (int)mesh->triangles, SUBDIV_TRIANGLES_SMOOTH + 1 },
        { "uv_rule",   (int)mesh->uv_rule,   SUBDIV_UV_NONE + 1 }
    };
    for (int i = 0; i < 5; i++)
        if (rules[i].value < 0 || rules[i].value >= rules[i].count)
            sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "%s has no value %d",
                     rules[i].name, rules[i].value);
}

static void sdv_check_faces(sdv_context *context, const subdiv_mesh *mesh)
{
    const int *v = mesh->face_vertices;
    for (int f = 0; f < mesh->face_count && !context->result; f++) {
        int size = sdv_face_size(mesh, f);
        if (size < 3) {
            sdv_fail_mesh(context, SUBDIV_ERROR_FACE, f, -1, "face %d has %d vertices", f, size);
            return;
        }
        for (int i = 0; i < size; i++, v++)
            if (*v < 0 || *v >= mesh->vertex_count)
                sdv_fail_mesh(context, SUBDIV_ERROR_INDEX, f, *v,
                              "face %d: vertex %d does not exist (the mesh has %d)",
                              f, *v, mesh->vertex_count);
    }
}

// The vertices of creases or corners, and their sharpness: any number, infinity included.
static void sdv_check_sharp(sdv_context *context, const subdiv_mesh *mesh, const char *what,
                            int count, int ends, const int *vertices, const float *sharpness)
{
    for (int i = 0; i < count && !context->result; i++) {
        for (int j = 0; j < ends; j++) {
            int v = vertices[ends * i + j];
            if (v < 0 || v >= mesh->vertex_count)
                sdv_fail_mesh(context, SUBDIV_ERROR_INDEX, -1, v,
                              "%s %d: vertex %d does not exist (the mesh has %d)",
                              what, i, v, mesh->vertex_count);
        }
        if (sharpness[i] != sharpness[i])
            sdv_fail_mesh(context, SUBDIV_ERROR_NOT_FINITE, -1, vertices[ends * i],
                          "%s %d: the sharpness is not a number", what, i);
    }
}

static void sdv_check_positions(sdv_context *context, const float *positions, int count,
                                float limit)
{
    if (count > 0 && !positions) {
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "positions is NULL");
        return;
    }
    for (int v = 0; v < count; v++) {
        const float *p = positions + 3 * (size_t)v;
        for (int i = 0; i < 3; i++)
            if (!(p[i] >= -limit && p[i] <= limit)) {
                sdv_fail_mesh(context, SUBDIV_ERROR_NOT_FINITE, -1, v,
                              "vertex %d: coordinate %d is not finite, or too large", v, i);
                return;
            }
    }
}

// Everything but the positions.
static void sdv_check_mesh(sdv_context *context, const subdiv_mesh *mesh)
{
    if (!mesh) {
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "the mesh is NULL");
        return;
    }
    if (mesh->vertex_count == 0) sdv_fail(context, SUBDIV_ERROR_EMPTY, "the mesh has no vertices");
    sdv_check_array(context, "positions", mesh->vertex_count, mesh);
    sdv_check_array(context, "face_vertices", mesh->face_count, mesh->face_vertices);
    if (mesh->face_size == 0)
        sdv_check_array(context, "face_sizes", mesh->face_count, mesh->face_sizes);
    sdv_check_array(context, "crease_vertices", mesh->crease_count, mesh->crease_vertices);
    sdv_check_array(context, "crease_sharpness", mesh->crease_count, mesh->crease_sharpness);
    sdv_check_array(context, "corner_vertices", mesh->corner_count, mesh->corner_vertices);
    sdv_check_array(context, "corner_sharpness", mesh->corner_count, mesh->corner_sharpness);
    sdv_check_array(context, "holes", mesh->hole_count, mesh->holes);
    sdv_check_rules(context, mesh);
    if (context->result) return;

    sdv_check_faces(context, mesh);
    sdv_check_sharp(context, mesh, "crease", mesh->crease_count, 2, mesh->crease_vertices,
                    mesh->crease_sharpness);
    sdv_check_sharp(context, mesh, "corner", mesh->corner_count, 1, mesh->corner_vertices,
                    mesh->corner_sharpness);
    for (int i = 0; i < mesh->hole_count && !context->result; i++)
        if (mesh->holes[i] < 0 || mesh->holes[i] >= mesh->face_count)
            sdv_fail_mesh(context, SUBDIV_ERROR_INDEX, mesh->holes[i], -1,
                          "hole %d: face %d does not exist (the mesh has %d)",
                          i, mesh->holes[i], mesh->face_count);
}

static void sdv_check_all(sdv_context *context, const subdiv_mesh *mesh)
{
    sdv_check_mesh(context, mesh);
    if (!context->result)
        sdv_check_positions(context, mesh->positions, mesh->vertex_count, FLT_MAX);
}

// --------------------------------------------------------------------------------- >>level
// A level is a mesh with its edges and how sharp everything is: all that refinement needs to know,
// and all that the next level inherits.
//
// A face-vertex h is a place in face_vertices. Edge face_edges[h] leads from there to the next
// vertex of the face. An edge-end k = 2 * edge + 0 or 1 is a place in edge_vertices; k ^ 1 is the
// edge's other end. Any number of faces may share an edge, and any number of fans a vertex.

typedef struct sdv_lists {              // one list per vertex or edge, one after the other
    int *starts;                        // [lists + 1]  list i is items[starts[i] .. starts[i+1]-1]
    int *items;
} sdv_lists;

typedef struct sdv_level {
    int vertex_count, edge_count, face_count, face_vertex_count;
    int face_size;                      // of all faces; 0: see face_starts
    int   *face_starts;                 // [face_count + 1]     the first face-vertex of each face
    int   *face_of;                     // [face_vertex_count]  (both for face_size 0 alone)
    int   *face_vertices;               // [face_vertex_count]
    int   *face_edges;                  // [face_vertex_count]
    int   *edge_vertices;               // [2 * edge_count]
    float *edge_sharpness;              // [edge_count]
    float *vertex_sharpness;            // [vertex_count]
    float *end_sharpness;               // [2 * edge_count]     one level down: the halves of edges
    float *next_sharpness;              // [vertex_count]       one level down: the vertices

    sdv_lists vertex_faces;             // at each vertex: its face-vertices
    sdv_lists vertex_edges;             // at each vertex: its edge-ends
    sdv_lists edge_faces;               // at each edge: the face-vertices that it leads on from
} sdv_level;

static int sdv_face_start(const sdv_level *level, int face)
{
    return level->face_size ? face * level->face_size : level->face_starts[face];
}

static int sdv_face_end(const sdv_level *level, int face)
{
    return level->face_size ? (face + 1) * level->face_size : level->face_starts[face + 1];
}

static int sdv_face_of(const sdv_level *level, int h)
{
    if (level->face_size == 4) return h >> 2;
    if (level->face_size == 3) return h / 3;
    return level->face_of[h];
}

// The face-vertex so many places after h in its face.
static int sdv_around(const sdv_level *level, int h, int steps)
{
    int face = sdv_face_of(level, h), start = sdv_face_start(level, face);
    int size = sdv_face_end(level, face) - start;
    return start + (h - start + steps) % size;
}

static int sdv_previous(const sdv_level *level, int h)
{
    int face = sdv_face_of(level, h);
    return h > sdv_face_start(level, face) ? h - 1 : sdv_face_end(level, face) - 1;
}

// lists[i] = the places in keys that hold i, in order.
static sdv_lists sdv_invert(sdv_context *context, sdv_arena *arena,
                            const int *keys, int key_count, int list_count)
{
    sdv_lists lists;
    lists.starts = SDV_NEW(context, arena, int, (size_t)list_count + 1);
    lists.items = SDV_NEW(context, arena, int, key_count);
    if (context->result) return lists;

    memset(lists.starts, 0, ((size_t)list_count + 1) * sizeof(int));
    for (int i = 0; i < key_count; i++) lists.starts[keys[i]]++;
    int end = 0;
    for (int i = 0; i < list_count; i++) lists.starts[i] = end += lists.starts[i];
    lists.starts[list_count] = end;
    for (int i = key_count - 1; i >= 0; i--) lists.items[--lists.starts[keys[i]]] = i;
    return lists;
}

static int sdv_list_size(const sdv_lists *lists, int i)
{
    return lists->starts[i + 1] - lists->starts[i];
}

// Who meets whom: fills the lists of a level whose faces and edges are known.
static void sdv_level_connect(sdv_context *context, sdv_arena *arena, sdv_level *level)
{
    level->vertex_faces = sdv_invert(context, arena, level->face_vertices,
                                     level->face_vertex_count, level->vertex_count);
    level->vertex_edges = sdv_invert(context, arena, level->edge_vertices,
                                     2 * level->edge_count, level->vertex_count);
    level->edge_faces = sdv_invert(context, arena, level->face_edges,
                                   level->face_vertex_count, level->edge_count);
}

// ---------------------------------------------------------------------------------- >>cage
// From polygons to level 0: find the edges, what is non-manifold, and what is sharp: by the
// user's lists, by being a boundary, by being non-manifold.

// Sharpness that follows from the shape and is not the user's. Forever like every sharpness from
// 10 on, but not written into results: the next call finds it again.
#define SDV_IMPLIED 11.0f

typedef struct sdv_cage {
    sdv_level level;
    unsigned char *edge_odd;            // [edge_count]    non-manifold edges
    unsigned char *vertex_odd;          // [vertex_count]  non-manifold vertices
    unsigned char *hole;                // [face_count]
    int *chain_first;                   // [vertex_count]  edges by their end of smaller valence:
    int *chain_next;                    // [edge_count]    -1 ends a chain
    int *face_total;                    // [vertex_count]  face-vertices at each vertex
} sdv_cage;

// The chain that holds an edge between a and b: that of the end with fewer faces, so that a
// vertex of huge valence makes no long chain.
static int sdv_chain(const sdv_cage *cage, int a, int b)
{
    int less = cage->face_total[a] - cage->face_total[b];
    return less < 0 || (less == 0 && a < b) ? a : b;
}

// The first edge between a and b, or -1.
static int sdv_find_edge(const sdv_cage *cage, int a, int b)
{
    const int *ends = cage->level.edge_vertices;
    int e = cage->chain_first[sdv_chain(cage, a, b)];
    while (e >= 0 && !(ends[2 * e] == a && ends[2 * e + 1] == b) &&
                     !(ends[2 * e] == b && ends[2 * e + 1] == a)) e = cage->chain_next[e];
    return e;
}

// A new edge from a to b; behind an equal one in the chain, so that that one stays the first.
static int sdv_add_edge(sdv_cage *cage, int a, int b, int equal)
{
    int e = cage->level.edge_count++;
    int *link = equal >= 0 ? &cage->chain_next[equal] : &cage->chain_first[sdv_chain(cage, a, b)];
    cage->chain_next[e] = *link;
    *link = e;
    cage->level.edge_vertices[2 * e] = a;
    cage->level.edge_vertices[2 * e + 1] = b;
    cage->edge_odd[e] = 0;
    return e;
}

// Numbers the edges in the order in which the faces meet them. An edge is odd (non-manifold) when
// three or more faces share it, when two faces run along it in the same direction, when both its
// ends are the same vertex, or when one face has it twice: then each time is an edge of its own.
static void sdv_cage_edges(sdv_cage *cage, int *last_face, int *uses)
{
    sdv_level *level = &cage->level;
    for (int f = 0; f < level->face_count; f++) {
        int end = sdv_face_end(level, f);
        for (int h = sdv_face_start(level, f); h < end; h++) {
            int a = level->face_vertices[h];
            int b = level->face_vertices[h + 1 < end ? h + 1 : sdv_face_start(level, f)];
            int found = sdv_find_edge(cage, a, b), e = found;
            if (found < 0 || a == b || last_face[found] == f) {
                e = sdv_add_edge(cage, a, b, found);
                uses[e] = 0;
                if (a == b) cage->edge_odd[e] = 1;
                else if (found >= 0) cage->edge_odd[found] = cage->edge_odd[e] = 1;
            } else if (uses[e] > 1 || level->edge_vertices[2 * e] == a) {
                cage->edge_odd[e] = 1;
            }
            level->face_edges[h] = e;
            last_face[e] = f;
            uses[e]++;
        }
    }
}

// Do the faces at v, whose edges are all manifold, form one fan? From a boundary edge if there is
// one, step from face to face until all edges are met, or an edge too early.
static int sdv_is_fan(const sdv_level *level, int v)
{
    int faces = sdv_list_size(&level->vertex_faces, v);
    int edges = sdv_list_size(&level->vertex_edges, v);
    if (faces == 0 || edges < 2 || edges - faces > 1) return 0;

    int h = level->vertex_faces.items[level->vertex_faces.starts[v]];
    int first = level->face_edges[h];
    if (edges > faces) {
        first = -1;
        for (int i = level->vertex_edges.starts[v]; i < level->vertex_edges.starts[v + 1]; i++) {
            int e = level->vertex_edges.items[i] >> 1;
            if (sdv_list_size(&level->edge_faces, e) != 1) continue;
            first = e;
            h = level->edge_faces.items[level->edge_faces.starts[e]];
            if (level->face_vertices[h] == v) break;
            h = sdv_around(level, h, 1);
        }
        if (first < 0) return 0;
    }

    int edge = first;
    for (int met = 1, met_faces = 1; met < edges; met++) {
        int next = level->face_edges[sdv_previous(level, h)];
        if (next == edge || next == first) return 0;
        if (met_faces < faces) {
            const int *two = level->edge_faces.items + level->edge_faces.starts[next];
            if (sdv_list_size(&level->edge_faces, next) < 2) return 0;
            h = sdv_face_of(level, two[0]) == sdv_face_of(level, h) ? two[1] : two[0];
            met_faces++;
        }
        edge = next;
    }
    return 1;
}

static void sdv_find_odd_vertices(sdv_cage *cage)
{
    const sdv_level *level = &cage->level;
    memset(cage->vertex_odd, 0, (size_t)level->vertex_count);
    for (int k = 0; k < 2 * level->edge_count; k++)
        if (cage->edge_odd[k >> 1]) cage->vertex_odd[level->edge_vertices[k]] = 1;
    for (int v = 0; v < level->vertex_count; v++)
        if (!cage->vertex_odd[v]) cage->vertex_odd[v] = (unsigned char)!sdv_is_fan(level, v);
}

// The user's creases and corners. A crease that is no edge is skipped.
static void sdv_user_sharpness(sdv_context *context, sdv_cage *cage, const subdiv_mesh *mesh)
{
    sdv_level *level = &cage->level;
    for (int e = 0; e < level->edge_count; e++) level->edge_sharpness[e] = 0;
    for (int v = 0; v < level->vertex_count; v++) level->vertex_sharpness[v] = 0;
    for (int i = 0; i < mesh->crease_count; i++) {
        int a = mesh->crease_vertices[2 * i], b = mesh->crease_vertices[2 * i + 1];
        int e = sdv_find_edge(cage, a, b);
        float s = mesh->crease_sharpness[i];
        if (e < 0) sdv_warn(context, 0, "crease %d: no edge joins vertices %d and %d", i, a, b);
        else level->edge_sharpness[e] = s > SUBDIV_INFINITE ? SUBDIV_INFINITE : s > 0 ? s : 0;
    }
    for (int i = 0; i < mesh->corner_count; i++) {
        float s = mesh->corner_sharpness[i];
        level->vertex_sharpness[mesh->corner_vertices[i]] =
            s > SUBDIV_INFINITE ? SUBDIV_INFINITE : s > 0 ? s : 0;
    }
}

// Boundary "none": every face at a vertex with an unsharpened boundary edge becomes a hole.
static void sdv_open_boundary(sdv_cage *cage)
{
    const sdv_level *level = &cage->level;
    for (int k = 0; k < 2 * level->edge_count; k++) {
        int e = k >> 1, v = level->edge_vertices[k];
        if (sdv_list_size(&level->edge_faces, e) != 1) continue;
        if (level->edge_sharpness[e] >= SUBDIV_INFINITE) continue;
        for (int i = level->vertex_faces.starts[v]; i < level->vertex_faces.starts[v + 1]; i++)
            cage->hole[sdv_face_of(level, level->vertex_faces.items[i])] = 1;
    }
}

static int sdv_is_odd_crease(const sdv_cage *cage, int v)
{
    const sdv_level *level = &cage->level;
    int odd = 0, boundary = 0;
    for (int i = level->vertex_edges.starts[v]; i < level->vertex_edges.starts[v + 1]; i++) {
        int e = level->vertex_edges.items[i] >> 1;
        odd += cage->edge_odd[e];
        boundary += sdv_list_size(&level->edge_faces, e) < 2;
    }
    return odd == 2 && boundary == 0 &&
           sdv_list_size(&level->vertex_faces, v) > sdv_list_size(&level->vertex_edges, v);
}

// What is sharp by shape [OSD]: boundary and non-manifold edges; under "edge and corner" the
// vertices with one face; non-manifold vertices, but for a non-manifold edge that runs through.
static void sdv_implied_sharpness(sdv_cage *cage, subdiv_boundary boundary)
{
    sdv_level *level = &cage->level;
    for (int e = 0; e < level->edge_count; e++)
        if (level->edge_sharpness[e] < SUBDIV_INFINITE &&
            (cage->edge_odd[e] || sdv_list_size(&level->edge_faces, e) < 2))
            level->edge_sharpness[e] = SDV_IMPLIED;
    for (int v = 0; v < level->vertex_count; v++) {
        if (level->vertex_sharpness[v] >= SUBDIV_INFINITE) continue;
        int single = sdv_list_size(&level->vertex_faces, v) == 1 &&
                     sdv_list_size(&level->vertex_edges, v) == 2;
        if ((single && boundary == SUBDIV_BOUNDARY_EDGE_AND_CORNER) ||
            (cage->vertex_odd[v] && !sdv_is_odd_crease(cage, v)))
            level->vertex_sharpness[v] = SDV_IMPLIED;
    }
}

// Faces, as face-vertices; starts and faces of face-vertices where sizes are not all 3 or all 4.
static void sdv_cage_faces(sdv_context *context, sdv_arena *arena, sdv_cage *cage,
                           const subdiv_mesh *mesh)
{
    sdv_level *level = &cage->level;
    size_t total = sdv_face_vertex_count(mesh);
    if (total > INT_MAX / 2) {
        sdv_fail(context, SUBDIV_ERROR_TOO_LARGE, "the faces have too many vertices together");
        return;
    }
    level->vertex_count = mesh->vertex_count;
    level->face_count = mesh->face_count;
    level->face_vertex_count = (int)total;
    level->face_size = mesh->face_size == 3 || mesh->face_size == 4 ? mesh->face_size : 0;
    level->face_vertices = mesh->face_vertices;
    if (level->face_size) return;

    level->face_starts = SDV_NEW(context, arena, int, (size_t)level->face_count + 1);
    level->face_of = SDV_NEW(context, arena, int, level->face_vertex_count);
    if (context->result) return;
    int h = 0;
    for (int f = 0; f < level->face_count; f++) {
        level->face_starts[f] = h;
        for (int i = sdv_face_size(mesh, f); i > 0; i--) level->face_of[h++] = f;
    }
    level->face_starts[level->face_count] = h;
}

// Level 0 of a valid mesh, whose face_vertices it borrows.
static void sdv_cage_build(sdv_context *context, sdv_arena *arena, sdv_cage *cage,
                           const subdiv_mesh *mesh)
{
    sdv_level *level = &cage->level;
    memset(cage, 0, sizeof *cage);
    sdv_cage_faces(context, arena, cage, mesh);
    if (context->result) return;
    size_t most = (size_t)level->face_vertex_count, vertices = (size_t)level->vertex_count;
    level->face_edges = SDV_NEW(context, arena, int, most);
    level->edge_vertices = SDV_NEW(context, arena, int, 2 * most);
    cage->edge_odd = SDV_NEW(context, arena, unsigned char, most);
    cage->vertex_odd = SDV_NEW(context, arena, unsigned char, vertices);
    cage->hole = SDV_NEW(context, arena, unsigned char, level->face_count);
    cage->chain_first = SDV_NEW(context, arena, int, vertices);
    cage->chain_next = SDV_NEW(context, arena, int, most);
    cage->face_total = SDV_NEW(context, arena, int, vertices);
    sdv_arena scratch = { NULL };
    int *last_face = SDV_NEW(context, &scratch, int, most);
    int *uses = SDV_NEW(context, &scratch, int, most);
    if (!context->result) {
        for (size_t v = 0; v < vertices; v++) cage->chain_first[v] = -1;
        memset(cage->face_total, 0, vertices * sizeof(int));
        for (size_t h = 0; h < most; h++) cage->face_total[level->face_vertices[h]]++;
        sdv_cage_edges(cage, last_face, uses);
    }
    sdv_arena_free(&scratch);
    level->edge_sharpness = SDV_NEW(context, arena, float, level->edge_count);
    level->vertex_sharpness = SDV_NEW(context, arena, float, vertices);
    sdv_level_connect(context, arena, level);
    if (context->result) return;

    sdv_find_odd_vertices(cage);
    memset(cage->hole, 0, (size_t)level->face_count);
    for (int i = 0; i < mesh->hole_count; i++) cage->hole[mesh->holes[i]] = 1;
    sdv_user_sharpness(context, cage, mesh);
    if (mesh->boundary == SUBDIV_BOUNDARY_NONE && mesh->scheme != SUBDIV_BILINEAR)
        sdv_open_boundary(cage);
    sdv_implied_sharpness(cage, mesh->boundary);
}

// ----------------------------------------------------------------------------- >>sharpness
// How creases and corners fade from level to level [DKT98], and what is left of them at a vertex.

// Uniform: one less each level. What is infinite stays.
static float sdv_fade(float sharpness)
{
    if (sharpness >= SUBDIV_INFINITE) return sharpness;
    return sharpness > 1 ? sharpness - 1 : 0;
}

// Chaikin, for the half of an edge at edge-end k, whose vertex is v: a quarter of the sharpness
// comes from the other semi-sharp edges at v.
//
//     s' = max(0, 3/4 s + 1/4 mean(others) - 1)
static float sdv_fade_chaikin(const sdv_level *level, int k)
{
    float s = level->edge_sharpness[k >> 1], sum = 0;
    int v = level->edge_vertices[k], count = 0;
    if (s <= 0 || s >= SUBDIV_INFINITE) return sdv_fade(s);
    for (int i = level->vertex_edges.starts[v]; i < level->vertex_edges.starts[v + 1]; i++) {
        float other = level->edge_sharpness[level->vertex_edges.items[i] >> 1];
        if (other <= 0 || other >= SUBDIV_INFINITE) continue;
        sum += other;
        count++;
    }
    if (count > 1) s = 0.75f * s + 0.25f * ((sum - s) / (float)(count - 1));
    return s > 1 ? s - 1 : 0;
}

// What the edges' halves and the vertices inherit. Sharp vertices fade uniformly in either case.
static void sdv_level_fade(sdv_level *level, subdiv_creasing creasing)
{
    for (int k = 0; k < 2 * level->edge_count; k++)
        level->end_sharpness[k] = creasing == SUBDIV_CREASING_CHAIKIN ?
            sdv_fade_chaikin(level, k) : sdv_fade(level->edge_sharpness[k >> 1]);
    for (int v = 0; v < level->vertex_count; v++)
        level->next_sharpness[v] = sdv_fade(level->vertex_sharpness[v]);
}

// The rule for a vertex is the number of its sharp edges.
typedef enum sdv_rule { SDV_SMOOTH, SDV_DART, SDV_CREASE, SDV_CORNER } sdv_rule;

static sdv_rule sdv_vertex_rule(float vertex_sharpness, int sharp_edges)
{
    return vertex_sharpness > 0 || sharp_edges > 2 ? SDV_CORNER : (sdv_rule)sharp_edges;
}

// A vertex between two levels: its rule now and on the next level. When they differ, the vertex
// point is a blend, weight of this level's rule against 1 - weight of the next one's.
typedef struct sdv_fading {
    sdv_rule rule, next;
    double weight;                      // mean sharpness of what fades away here, at most 1
} sdv_fading;

static sdv_fading sdv_vertex_fading(const sdv_level *level, int v, subdiv_creasing creasing)
{
    float sharpness = level->vertex_sharpness[v], sum = 0;
    int now = 0, next = 0, count = 0;
    if (sharpness > 0 && level->next_sharpness[v] <= 0) {
        sum = sharpness;
        count = 1;
    }
    for (int i = level->vertex_edges.starts[v]; i < level->vertex_edges.starts[v + 1]; i++) {
        int k = level->vertex_edges.items[i];
        float s = level->edge_sharpness[k >> 1], half = level->end_sharpness[k];
        now += s > 0;
        next += half > 0;
        if (s > 0 && (creasing == SUBDIV_CREASING_CHAIKIN ? half <= 0 : s <= 1)) {
            sum += s;
            count++;
        }
    }
    float mean = count ? sum / (float)count : 0;
    sdv_fading fading;
    fading.rule = sdv_vertex_rule(sharpness, now);
    fading.next = sdv_vertex_rule(level->next_sharpness[v], next);
    fading.weight = mean < 1 ? mean : 1;
    return fading;
}

// --------------------------------------------------------------------------------- >>masks
// Every rule of refinement, once. A mask is a set of weights that sum to 1; refinement takes
// the points around and adds them up with these weights, whatever the points are.

typedef struct sdv_mask {
    double self;                        // the vertex itself; for an edge point: each of its ends
    double edge;                        // each vertex at the other end of an edge
    double face;                        // each face point (Loop: each vertex opposite the edge)
    double crease;                      // on top of edge: the two neighbours along the crease
} sdv_mask;

// Face point [CC78]: the mean of the face's n vertices.
//
//     1/n----1/n
//      |  F  |               F = (v0 + v1 + ... ) / n
//     1/n----1/n
static double sdv_face_point(int n)
{
    return 1.0 / n;
}

// Edge point on a crease or boundary, and everywhere under bilinear: the midpoint.
//
//     1/2---E---1/2          E = (a + b) / 2
static sdv_mask sdv_crease_edge(void)
{
    sdv_mask mask = { 0.5, 0, 0, 0 };
    return mask;
}

// Smooth edge point, Catmull-Clark [CC78]: the mean of the two ends and the two face points. With
// any other number of faces the face points share their half [OSD].
//
//        f0
//     a--E--b                E = (a + b + f0 + f1) / 4
//        f1
static sdv_mask sdv_catmull_clark_edge(int faces)
{
    sdv_mask mask = { 0.25, 0, 0.5 / faces, 0 };
    return mask;
}

// The same beside one or two triangles, with the rule "smooth" [OSD]: w = 0.47 for each triangle
// and 1/4 for each other face; the face points weigh the mean of the two w, the ends the rest.
static sdv_mask sdv_smooth_triangle_edge(int triangles)
{
    double face = 0.5 * (0.47 * triangles + 0.25 * (2 - triangles));
    sdv_mask mask = { 0.5 - face, 0, face, 0 };
    return mask;
}

// Smooth odd point, Loop [Loop87]: 3/8 for the ends of the edge, 1/8 for the vertices opposite.
//
//          1/8
//         /   \              E = (3a + 3b + c + d) / 8
//     3/8---E---3/8
//         \   /
//          1/8
static sdv_mask sdv_loop_edge(int faces)
{
    sdv_mask mask = { 0.375, 0, 0.25 / faces, 0 };
    return mask;
}

// Corner: stays where it is.
static sdv_mask sdv_corner_vertex(void)
{
    sdv_mask mask = { 1, 0, 0, 0 };
    return mask;
}

// Vertex point on a crease or boundary: the cubic B-spline curve along it [HDD94].
//
//     1/8---3/4---1/8        V = (a + 6v + b) / 8
static sdv_mask sdv_crease_vertex(void)
{
    sdv_mask mask = { 0.75, 0, 0, 0.125 };
    return mask;
}

// Smooth vertex point, Catmull-Clark, valence n [CC78]. With F the mean of the face points, R the
// mean of the edges' midpoints, V = (F + 2R + (n - 3) v) / n. Midpoints are half v:
//
//     f----e----f
//     |    |    |            V = (n-2)/n v + 1/n^2 (sum of e) + 1/n^2 (sum of f)
//     e----V----e
//     |    |    |            e: the neighbours' old positions; f: the new face points
//     f----e----f
static sdv_mask sdv_catmull_clark_vertex(int n)
{
    double w = 1.0 / ((double)n * n);
    sdv_mask mask = { (n - 2.0) / n, w, w, 0 };
    return mask;
}

// Smooth even point, Loop, valence n [Loop87]:
//
//       b---b
//      / \ / \               V = (1 - n b) v + b (sum of neighbours)
//     b---V---b
//      \ / \ /               b = (5/8 - (3/8 + cos(2 pi/n) / 4)^2) / n,  1/16 for n = 6
//       b---b
static sdv_mask sdv_loop_vertex(int n)
{
    double c = 0.375 + 0.25 * cos(6.283185307179586477 / n);
    double b = n == 6 ? 0.0625 : (0.625 - c * c) / n;
    sdv_mask mask = { 1 - n * b, b, 0, 0 };
    return mask;
}

// Between sharp and smooth [DKT98]: linear in the sharpness.
static sdv_mask sdv_blend(double weight, sdv_mask sharp, sdv_mask smooth)
{
    sdv_mask mask;
    mask.self = weight * sharp.self + (1 - weight) * smooth.self;
    mask.edge = weight * sharp.edge + (1 - weight) * smooth.edge;
    mask.face = weight * sharp.face + (1 - weight) * smooth.face;
    mask.crease = weight * sharp.crease + (1 - weight) * smooth.crease;
    return mask;
}

// The mask of a rule at a vertex with so many faces. A dart is smooth.
static sdv_mask sdv_rule_mask(subdiv_scheme scheme, sdv_rule rule, int faces)
{
    if (rule == SDV_CORNER || scheme == SUBDIV_BILINEAR) return sdv_corner_vertex();
    if (rule == SDV_CREASE) return sdv_crease_vertex();
    return scheme == SUBDIV_LOOP ? sdv_loop_vertex(faces) : sdv_catmull_clark_vertex(faces);
}

static sdv_mask sdv_vertex_mask(subdiv_scheme scheme, sdv_fading fading, int faces)
{
    sdv_mask mask = sdv_rule_mask(scheme, fading.rule, faces);
    if (fading.rule < SDV_CREASE || fading.rule == fading.next) return mask;
    return sdv_blend(fading.weight, mask, sdv_rule_mask(scheme, fading.next, faces));
}

// The mask of an edge's edge point: sharp while both its halves stay sharp, a blend where one of
// them turns smooth. triangles: how many of its two faces are, under the rule "smooth"; else 0.
static sdv_mask sdv_edge_mask(subdiv_scheme scheme, float sharpness, int stays_sharp,
                              int faces, int triangles)
{
    if (scheme == SUBDIV_BILINEAR || (sharpness > 0 && stays_sharp)) return sdv_crease_edge();
    sdv_mask smooth = scheme == SUBDIV_LOOP ? sdv_loop_edge(faces) :
                      triangles ? sdv_smooth_triangle_edge(triangles) :
                      sdv_catmull_clark_edge(faces);
    return sdv_blend(sharpness < 1 ? sharpness : 1, sdv_crease_edge(), smooth);
}

// ---------------------------------------------------------------------------------- >>rows
// The masks of a level written out: row i says which points to add with which weights. A step
// from level to level is two sets of rows, and evaluation knows nothing else:
//
//     face rows:  the level's vertices                   -> its face points
//     point rows: the level's vertices and face points   -> vertex points, then edge points
//
// The next level's vertices are the vertex points, face points and edge points, in this order.

typedef struct sdv_rows {
    int     count;
    size_t *starts;                     // [count + 1], and one more while they are written
    int    *indices;                    // [starts[count]]
    float  *weights;                    // [starts[count]]
} sdv_rows;

typedef struct sdv_step {
    int      vertex_count, face_point_count, edge_count;
    sdv_rows faces, points;
    int     *targets;                   // [vertex_count + face_point_count + edge_count] where the
                                        // points stand in the result; NULL: in the level's order
} sdv_step;

static void sdv_rows_new(sdv_context *context, sdv_arena *arena, sdv_rows *rows,
                         int count, size_t entries)
{
    rows->count = 0;
    rows->starts = SDV_NEW(context, arena, size_t, (size_t)count + 2);
    rows->indices = SDV_NEW(context, arena, int, entries);
    rows->weights = SDV_NEW(context, arena, float, entries);
    if (!context->result) rows->starts[0] = rows->starts[1] = 0;
}

// Adds to the row that is being written; sdv_end_row goes on to the next.
static void sdv_add(sdv_rows *rows, int index, double weight)
{
    size_t end = rows->starts[rows->count + 1]++;
    rows->indices[end] = index;
    rows->weights[end] = (float)weight;
}

static void sdv_end_row(sdv_rows *rows)
{
    rows->count++;
    rows->starts[rows->count + 1] = rows->starts[rows->count];
}

static void sdv_face_rows(const sdv_level *level, sdv_rows *rows)
{
    for (int f = 0; f < level->face_count; f++) {
        int start = sdv_face_start(level, f), end = sdv_face_end(level, f);
        double weight = sdv_face_point(end - start);
        for (int h = start; h < end; h++) sdv_add(rows, level->face_vertices[h], weight);
        sdv_end_row(rows);
    }
}

// The neighbours along a crease are the other ends of the two edges that are sharp: now, or on
// the next level where a corner turns into a crease.
static void sdv_vertex_row(const sdv_level *level, const subdiv_mesh *rules, int v, sdv_rows *rows)
{
    sdv_fading fading = sdv_vertex_fading(level, v, rules->creasing);
    sdv_mask mask = sdv_vertex_mask(rules->scheme, fading, sdv_list_size(&level->vertex_faces, v));
    if (mask.self != 0) sdv_add(rows, v, mask.self);
    for (int i = level->vertex_edges.starts[v]; i < level->vertex_edges.starts[v + 1]; i++) {
        int k = level->vertex_edges.items[i];
        float s = fading.rule == SDV_CREASE ? level->edge_sharpness[k >> 1]
                                            : level->end_sharpness[k];
        double weight = mask.edge + (s > 0 ? mask.crease : 0);
        if (weight != 0) sdv_add(rows, level->edge_vertices[k ^ 1], weight);
    }
    if (mask.face == 0) return;
    for (int i = level->vertex_faces.starts[v]; i < level->vertex_faces.starts[v + 1]; i++) {
        int f = sdv_face_of(level, level->vertex_faces.items[i]);
        sdv_add(rows, level->vertex_count + f, mask.face);
    }
}

static int sdv_is_triangle(const sdv_level *level, int face)
{
    return sdv_face_end(level, face) - sdv_face_start(level, face) == 3;
}

static void sdv_edge_row(const sdv_level *level, const subdiv_mesh *rules, int e, sdv_rows *rows)
{
    const int *faces = level->edge_faces.items + level->edge_faces.starts[e];
    int count = sdv_list_size(&level->edge_faces, e), triangles = 0;
    if (count == 2 && rules->triangles == SUBDIV_TRIANGLES_SMOOTH)
        triangles = sdv_is_triangle(level, sdv_face_of(level, faces[0])) +
                    sdv_is_triangle(level, sdv_face_of(level, faces[1]));
    int stays_sharp = level->end_sharpness[2 * e] > 0 && level->end_sharpness[2 * e + 1] > 0;
    sdv_mask mask = sdv_edge_mask(rules->scheme, level->edge_sharpness[e], stays_sharp,
                                  count, triangles);
    sdv_add(rows, level->edge_vertices[2 * e], mask.self);
    sdv_add(rows, level->edge_vertices[2 * e + 1], mask.self);
    if (mask.face == 0) return;
    for (int i = 0; i < count; i++) {
        int opposite = rules->scheme == SUBDIV_LOOP ?
            level->face_vertices[sdv_previous(level, faces[i])] :
            level->vertex_count + sdv_face_of(level, faces[i]);
        sdv_add(rows, opposite, mask.face);
    }
}

static void sdv_step_build(sdv_context *context, sdv_arena *arena, sdv_step *step,
                           const sdv_level *level, const subdiv_mesh *rules)
{
    size_t ends = 2 * (size_t)level->edge_count, corners = (size_t)level->face_vertex_count;
    step->vertex_count = level->vertex_count;
    step->face_point_count = rules->scheme == SUBDIV_LOOP ? 0 : level->face_count;
    step->edge_count = level->edge_count;
    step->targets = NULL;
    sdv_rows_new(context, arena, &step->faces, step->face_point_count, corners);
    sdv_rows_new(context, arena, &step->points, level->vertex_count + level->edge_count,
                 (size_t)level->vertex_count + 2 * (ends + corners));
    if (context->result) return;

    if (step->face_point_count) sdv_face_rows(level, &step->faces);
    for (int v = 0; v < level->vertex_count; v++) {
        sdv_vertex_row(level, rules, v, &step->points);
        sdv_end_row(&step->points);
    }
    for (int e = 0; e < level->edge_count; e++) {
        sdv_edge_row(level, rules, e, &step->points);
        sdv_end_row(&step->points);
    }
}

// --------------------------------------------------------------------------------- >>split
// The next level. Its edges are those inside the faces, one for each face-vertex of this level,
// then the two halves of each edge; a half leads from the edge point to the vertex.

// The half of edge e at vertex v. If both its ends are v: the first or second.
static int sdv_half(const sdv_level *level, int e, int v, int which)
{
    const int *ends = level->edge_vertices + 2 * (size_t)e;
    if (ends[0] != ends[1]) which = ends[1] == v;
    return level->face_vertex_count + 2 * e + which;
}

static void sdv_split_edges(const sdv_level *level, sdv_level *next, int first_edge_point)
{
    for (int v = 0; v < next->vertex_count; v++)
        next->vertex_sharpness[v] = v < level->vertex_count ? level->next_sharpness[v] : 0;
    for (int e = 0; e < level->face_vertex_count; e++) next->edge_sharpness[e] = 0;
    for (int k = 0; k < 2 * level->edge_count; k++) {
        int half = level->face_vertex_count + k;
        next->edge_vertices[2 * half] = first_edge_point + (k >> 1);
        next->edge_vertices[2 * half + 1] = level->edge_vertices[k];
        next->edge_sharpness[half] = level->end_sharpness[k];
    }
}

// Catmull-Clark and bilinear: one quad for each face-vertex.
//
//     3-----2        vertex i, edge point i, face point, edge point i-1. Of a quad, child i keeps
//     | 3|2 |        vertex i as its own vertex i, so that all descendants have their
//     |--F--|        parent's orientation; of any other polygon it is vertex 0.
//     | 0|1 |
//     0-----1        Face-vertex h makes face h, and the edge h from the face point to its edge.
static void sdv_split_quads(const sdv_level *level, sdv_level *next)
{
    int face_point = level->vertex_count, edge_point = face_point + level->face_count;
    for (int f = 0; f < level->face_count; f++, face_point++) {
        int start = sdv_face_start(level, f), end = sdv_face_end(level, f);
        for (int h = start; h < end; h++) {
            int previous = h > start ? h - 1 : end - 1, v = level->face_vertices[h];
            int e = level->face_edges[h], d = level->face_edges[previous];
            int vertices[4] = { v, edge_point + e, face_point, edge_point + d };
            int edges[4] = { sdv_half(level, e, v, 0), h, previous, sdv_half(level, d, v, 1) };
            int turn = end - start == 4 ? h - start : 0;
            for (int i = 0; i < 4; i++) {
                next->face_vertices[4 * h + ((i + turn) & 3)] = vertices[i];
                next->face_edges[4 * h + ((i + turn) & 3)] = edges[i];
            }
            next->edge_vertices[2 * h] = face_point;
            next->edge_vertices[2 * h + 1] = edge_point + e;
        }
    }
    sdv_split_edges(level, next, edge_point);
}

// Loop: four triangles, the middle one turned by half.
//
//         2
//        /2\             child i keeps vertex i; the middle child is e1 e2 e0
//      e2---e1
//      /0\3/1\           the edge inside next to vertex i is edge 3 f + i
//     0---e0--1
static void sdv_split_triangles(const sdv_level *level, sdv_level *next)
{
    for (int f = 0; f < level->face_count; f++) {
        const int *v = level->face_vertices + 3 * (size_t)f, *e = level->face_edges + 3 * (size_t)f;
        int p[3], half0[3], half1[3], inside = 3 * f;
        for (int i = 0; i < 3; i++) {
            p[i] = level->vertex_count + e[i];
            half0[i] = sdv_half(level, e[i], v[i], 0);
            half1[i] = 2 * (level->face_vertex_count + 2 * e[i]) + 1 - half0[i];
        }
        for (int i = 0; i < 3; i++) {
            next->edge_vertices[2 * (inside + i)] = p[i];
            next->edge_vertices[2 * (inside + i) + 1] = p[(i + 2) % 3];
        }
        int vertices[12] = { v[0], p[0], p[2],  p[0], v[1], p[1],  p[2], p[1], v[2],
                             p[1], p[2], p[0] };
        int edges[12] = { half0[0], inside, half1[2],       half1[0], half0[1], inside + 1,
                          inside + 2, half1[1], half0[2],   inside + 2, inside, inside + 1 };
        memcpy(next->face_vertices + 12 * (size_t)f, vertices, sizeof vertices);
        memcpy(next->face_edges + 12 * (size_t)f, edges, sizeof edges);
    }
    sdv_split_edges(level, next, level->vertex_count);
}

static void sdv_split(sdv_context *context, sdv_arena *arena, const sdv_level *level,
                      sdv_level *next, subdiv_scheme scheme)
{
    memset(next, 0, sizeof *next);
    int loop = scheme == SUBDIV_LOOP;
    next->face_size = loop ? 3 : 4;
    next->face_count = loop ? 4 * level->face_count : level->face_vertex_count;
    next->face_vertex_count = next->face_count * next->face_size;
    next->edge_count = level->face_vertex_count + 2 * level->edge_count;
    next->vertex_count = level->vertex_count + level->edge_count + (loop ? 0 : level->face_count);
    next->face_vertices = SDV_NEW(context, arena, int, next->face_vertex_count);
    next->face_edges = SDV_NEW(context, arena, int, next->face_vertex_count);
    next->edge_vertices = SDV_NEW(context, arena, int, 2 * (size_t)next->edge_count);
    next->edge_sharpness = SDV_NEW(context, arena, float, next->edge_count);
    next->vertex_sharpness = SDV_NEW(context, arena, float, next->vertex_count);
    if (context->result) return;
    if (loop) sdv_split_triangles(level, next);
    else sdv_split_quads(level, next);
    sdv_level_connect(context, arena, next);
}

// --------------------------------------------------------------------------------- >>order
// THE ORDER OF THE RESULT (see the top) as formulas. n is the number of segments of a cage edge;
// m = n / 2 that of the quads of an n-gon.

typedef struct sdv_order {
    sdv_level cage;                     // faces and edges alone
    int loop, n, m;
    int first_edge_point, first_face_point;
} sdv_order;

// Point t of n along the edge that leads on from face-vertex h.
static int sdv_edge_index(const sdv_order *order, int h, int t)
{
    const sdv_level *cage = &order->cage;
    int a = cage->face_vertices[h], b = cage->face_vertices[sdv_around(cage, h, 1)];
    if (t == 0) return a;
    if (t == order->n) return b;
    if (a > b) t = order->n - t;
    return order->first_edge_point + cage->face_edges[h] * (order->n - 1) + t - 1;
}

// The first point inside face f: every face has one centre, and m (m - 1) points for each of its
// vertices; a triangle under Loop (n - 1)(n - 2) / 2.
static int sdv_first_inside(const sdv_order *order, int f)
{
    int n = order->n, m = order->m;
    if (order->loop) return order->first_face_point + f * ((n - 1) * (n - 2) / 2);
    return order->first_face_point + f + sdv_face_start(&order->cage, f) * (m * (m - 1));
}

static int sdv_quad_index(const sdv_order *order, int f, int row, int column)
{
    int n = order->n, h = sdv_face_start(&order->cage, f);
    if (row == 0) return sdv_edge_index(order, h, column);
    if (row == n) return sdv_edge_index(order, h + 2, n - column);
    if (column == 0) return sdv_edge_index(order, h + 3, n - row);
    if (column == n) return sdv_edge_index(order, h + 1, row);
    return sdv_first_inside(order, f) + (row - 1) * (n - 1) + column - 1;
}

// In the quad at face-vertex h of an n-gon; its corners: vertex, edge point, centre, edge point.
static int sdv_ngon_index(const sdv_order *order, int h, int row, int column)
{
    const sdv_level *cage = &order->cage;
    int m = order->m, f = sdv_face_of(cage, h), start = sdv_face_start(cage, f);
    int size = sdv_face_end(cage, f) - start, previous = sdv_previous(cage, h);
    int centre = sdv_first_inside(order, f), spokes = centre + 1;
    if (row == 0) return sdv_edge_index(order, h, column);
    if (column == 0) return sdv_edge_index(order, previous, order->n - row);
    if (row == m && column == m) return centre;
    if (column == m) return spokes + (h - start) * (m - 1) + m - row - 1;
    if (row == m) return spokes + (previous - start) * (m - 1) + m - column - 1;
    return spokes + size * (m - 1) + (h - start) * (m - 1) * (m - 1) +
           (row - 1) * (m - 1) + column - 1;
}

static int sdv_triangle_index(const sdv_order *order, int f, int row, int column)
{
    int n = order->n, h = 3 * f;
    if (row == 0) return sdv_edge_index(order, h, column);
    if (column == 0) return sdv_edge_index(order, h + 2, n - row);
    if (row + column == n) return sdv_edge_index(order, h + 1, row);
    return sdv_first_inside(order, f) + (row - 1) * (n - 1) - row * (row - 1) / 2 + column - 1;
}

// Where the children of face x stand, x on the level before the last: of a quad with its points
// at (row, column) and one step on, the index at offset (i, j) in half steps, 0 to 2.
static void sdv_quad_place(const sdv_order *order, int level, int x, int index[3][3])
{
    const sdv_level *cage = &order->cage;
    int h = x >> 2 * (level - 1), f = sdv_face_of(cage, h), start = sdv_face_start(cage, f);
    int quad = sdv_face_end(cage, f) - start == 4;
    int row = 0, column = 0;
    for (int shift = 2 * (level - 1); shift >= 0; shift -= 2) {
        int child = (shift == 2 * (level - 1) ? (quad ? h - start : 0) : x >> shift) & 3;
        row = 2 * row + (child >> 1);
        column = 2 * column + (child == 1 || child == 2);
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            index[i][j] = quad ? sdv_quad_index(order, f, 2 * row + i, 2 * column + j)
                               : sdv_ngon_index(order, h, 2 * row + i, 2 * column + j);
}

// The same for a triangle: its vertex 0 is at (row, column), and step is 1, or -1 if it is turned.
static void sdv_triangle_place(const sdv_order *order, int level, int x, int index[3][3])
{
    int f = x >> 2 * level, row = 0, column = 0, step = 1;
    for (int shift = 2 * (level - 1); shift >= 0; shift -= 2) {
        int child = x >> shift & 3;
        row = 2 * row + (child >= 2 ? step : 0);
        column = 2 * column + (child & 1 ? step : 0);
        if (child == 3) step = -step;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3 - i; j++)
            index[i][j] = sdv_triangle_index(order, f, 2 * row + i * step, 2 * column + j * step);
}

// targets = places in the result of the last level's vertex points, face points and edge points.
static void sdv_find_targets(const sdv_order *order, const sdv_level *level, int depth,
                             int *targets)
{
    int *faces = targets + level->vertex_count;
    int *edges = faces + (order->loop ? 0 : level->face_count);
    static const int quad[4][4] = { {0,0, 0,1}, {0,2, 1,2}, {2,2, 2,1}, {2,0, 1,0} };
    static const int triangle[3][4] = { {0,0, 0,1}, {0,2, 1,1}, {2,0, 1,0} };
    if (depth == 0) {
        for (int v = 0; v < level->vertex_count; v++) targets[v] = v;
        for (int e = 0; e < level->edge_count; e++) edges[e] = order->first_edge_point + e;
        for (int f = 0; f < level->face_count && !order->loop; f++)
            faces[f] = order->first_face_point + f;
        return;
    }
    for (int v = 0; v < level->vertex_count; v++) targets[v] = v;  // those without faces stay
    for (int x = 0; x < level->face_count; x++) {
        int index[3][3] = { {0} };
        if (order->loop) sdv_triangle_place(order, depth, x, index);
        else sdv_quad_place(order, depth, x, index);
        for (int i = 0; i < level->face_size; i++) {
            const int *at = order->loop ? triangle[i] : quad[i];
            int h = x * level->face_size + i;
            targets[level->face_vertices[h]] = index[at[0]][at[1]];
            edges[level->face_edges[h]] = index[at[2]][at[3]];
        }
        if (!order->loop) faces[x] = index[1][1];
    }
}

// Quads between two rows of points, count along the row.
static int *sdv_quad_row(int *out, const int *low, const int *high, int count)
{
    for (int i = 0; i < count; i++, out += 4) {
        out[0] = low[i];
        out[1] = low[i + 1];
        out[2] = high[i + 1];
        out[3] = high[i];
    }
    return out;
}

// Triangles between a row of points and the shorter next one.
static int *sdv_triangle_row(int *out, const int *low, const int *high, int count)
{
    for (int i = 0; i < count; i++) {
        *out++ = low[i];
        *out++ = low[i + 1];
        *out++ = high[i];
        if (i + 1 == count) break;
        *out++ = high[i + 1];
        *out++ = high[i];
        *out++ = low[i + 1];
    }
    return out;
}

// The fine faces of cage face f; rows: room for 2 (n + 1) indices.
static int *sdv_fine_faces(const sdv_order *order, int f, int *rows, int *out)
{
    const sdv_level *cage = &order->cage;
    int start = sdv_face_start(cage, f), end = sdv_face_end(cage, f);
    int quad = !order->loop && end - start == 4;
    int n = quad || order->loop ? order->n : order->m;
    for (int h = start; h < (quad || order->loop ? start + 1 : end); h++) {
        int *low = rows, *high = rows + order->n + 1;
        for (int row = 0; row <= n; row++) {
            int last = order->loop ? n - row : n;
            for (int i = 0; i <= last; i++)
                high[i] = quad ? sdv_quad_index(order, f, row, i) :
                          order->loop ? sdv_triangle_index(order, f, row, i) :
                          sdv_ngon_index(order, h, row, i);
            if (row > 0) out = order->loop ? sdv_triangle_row(out, low, high, n - row + 1)
                                           : sdv_quad_row(out, low, high, n);
            int *swap = low;
            low = high;
            high = swap;
        }
    }
    return out;
}

// ------------------------------------------------------------------------------- >>prepare

struct subdiv_surface {
    sdv_arena arena;
    void     *user;
    int       levels;
    int       cage_vertex_count;
    size_t    most_points;              // that any step reads
    sdv_step *steps;                    // [levels]
    sdv_order order;
    unsigned char *hole;                // [cage face_count]
    int      *cage_face;                // [cage face_count] the user's face; NULL: the same
    subdiv_mesh fine;                   // the result without positions; without faces if levels > 0
};

static void sdv_copy(void *to, const void *from, size_t count, size_t item)
{
    if (count) memcpy(to, from, count * item);
}

// The faces of the cage, copied; under Loop cut into triangles when the options ask for it: fans
// around vertex 0, a choice that needs no positions. cage_face says what each was cut from.
static void sdv_copy_faces(sdv_context *context, subdiv_surface *surface, subdiv_mesh *work,
                           const subdiv_mesh *cage)
{
    size_t count = sdv_face_vertex_count(cage), triangles = count - 2 * (size_t)cage->face_count;
    int loop = cage->scheme == SUBDIV_LOOP, cut = 0;
    for (int f = 0; loop && f < cage->face_count; f++) cut |= sdv_face_size(cage, f) != 3;
    if (cut && triangles > INT_MAX) {
        sdv_fail(context, SUBDIV_ERROR_TOO_LARGE, "the faces make too many triangles");
        return;
    }
    if (cut) count = 3 * triangles;
    work->face_vertices = SDV_NEW(context, &surface->arena, int, count);
    work->face_sizes = NULL;
    if (loop) work->face_size = 3;
    if (!work->face_size)
        work->face_sizes = SDV_NEW(context, &surface->arena, int, cage->face_count);
    if (cut) surface->cage_face = SDV_NEW(context, &surface->arena, int, triangles);
    if (context->result) return;

    if (work->face_sizes)
        sdv_copy(work->face_sizes, cage->face_sizes, (size_t)cage->face_count, sizeof(int));
    if (!cut) {
        sdv_copy(work->face_vertices, cage->face_vertices, count, sizeof(int));
        return;
    }
    const int *v = cage->face_vertices;
    int *out = work->face_vertices;
    work->face_count = 0;
    for (int f = 0; f < cage->face_count; f++) {
        int size = sdv_face_size(cage, f);
        for (int i = 2; i < size; i++) {
            *out++ = v[0];
            *out++ = v[i - 1];
            *out++ = v[i];
            surface->cage_face[work->face_count++] = f;
        }
        v += size;
    }
}

// Holes of faces that were cut: all their triangles.
static void sdv_cut_holes(sdv_context *context, subdiv_surface *surface, subdiv_mesh *work,
                          const subdiv_mesh *cage)
{
    if (!surface->cage_face || !cage->hole_count) return;
    unsigned char *hole = SDV_NEW(context, &surface->arena, unsigned char, cage->face_count);
    work->holes = SDV_NEW(context, &surface->arena, int, work->face_count);
    if (context->result) return;
    memset(hole, 0, (size_t)cage->face_count);
    for (int i = 0; i < cage->hole_count; i++) hole[cage->holes[i]] = 1;
    work->hole_count = 0;
    for (int f = 0; f < work->face_count; f++)
        if (hole[surface->cage_face[f]]) work->holes[work->hole_count++] = f;
}

static void sdv_check_triangles(sdv_context *context, const subdiv_mesh *cage)
{
    for (int f = 0; f < cage->face_count; f++)
        if (sdv_face_size(cage, f) != 3) {
            sdv_fail_mesh(context, SUBDIV_ERROR_NOT_TRIANGLE, f, -1,
                          "face %d has %d vertices, and Loop needs triangles",
                          f, sdv_face_size(cage, f));
            return;
        }
}

// Does a result of so many levels fit? Asked before anything is built; edges < 0: not known yet.
static void sdv_check_size(sdv_context *context, const subdiv_mesh *work, int levels, int edges)
{
    uint64_t corners = sdv_face_vertex_count(work), faces = (uint64_t)work->face_count;
    uint64_t n = (uint64_t)1 << (levels < 30 ? levels : 30), m = n / 2;
    int loop = work->scheme == SUBDIV_LOOP;
    uint64_t fine = levels == 0 || corners == 0 ? faces : loop ? faces * n * n : corners * m * m;
    if (levels > 30 || fine > INT_MAX || (corners && n > 65536)) {
        sdv_fail(context, SUBDIV_ERROR_TOO_LARGE,
                 "%d levels of this mesh make more than %d faces", levels, INT_MAX);
        return;
    }
    if (edges < 0 || levels == 0) return;
    uint64_t inside = loop ? faces * ((n - 1) * (n - 2) / 2) : faces + corners * m * (m - 1);
    if ((uint64_t)work->vertex_count + (uint64_t)edges * (n - 1) + inside > INT_MAX)
        sdv_fail(context, SUBDIV_ERROR_TOO_LARGE,
                 "%d levels of this mesh make more than %d vertices", levels, INT_MAX);
}

// Sharpness that is left on the result and not implied by its shape.
static int sdv_survives(float sharpness)
{
    return sharpness > 0 && sharpness <= SUBDIV_INFINITE;
}

static void sdv_surviving_sharpness(sdv_context *context, subdiv_surface *surface,
                                    const sdv_level *level, const int *targets)
{
    subdiv_mesh *fine = &surface->fine;
    const int *edge_targets = targets + level->vertex_count;
    if (!surface->order.loop) edge_targets += level->face_count;
    int creases = 0, corners = 0;
    for (int k = 0; k < 2 * level->edge_count; k++)
        creases += sdv_survives(level->end_sharpness[k]);
    for (int v = 0; v < level->vertex_count; v++)
        corners += sdv_survives(level->next_sharpness[v]);
    fine->crease_vertices = SDV_NEW(context, &surface->arena, int, 2 * (size_t)creases);
    fine->crease_sharpness = SDV_NEW(context, &surface->arena, float, creases);
    fine->corner_vertices = SDV_NEW(context, &surface->arena, int, corners);
    fine->corner_sharpness = SDV_NEW(context, &surface->arena, float, corners);
    if (context->result) return;

    for (int k = 0; k < 2 * level->edge_count; k++) {
        if (!sdv_survives(level->end_sharpness[k])) continue;
        int i = fine->crease_count++;
        fine->crease_vertices[2 * i] = edge_targets[k >> 1];
        fine->crease_vertices[2 * i + 1] = targets[level->edge_vertices[k]];
        fine->crease_sharpness[i] = level->end_sharpness[k];
    }
    for (int v = 0; v < level->vertex_count; v++) {
        if (!sdv_survives(level->next_sharpness[v])) continue;
        int i = fine->corner_count++;
        fine->corner_vertices[i] = targets[v];
        fine->corner_sharpness[i] = level->next_sharpness[v];
    }
}

// All steps: masks of a level, then the next level, of which two are in memory at a time.
static void sdv_prepare_levels(sdv_context *context, subdiv_surface *surface, sdv_level *cage,
                               const subdiv_mesh *rules)
{
    sdv_arena arena = { NULL }, next_arena = { NULL };
    sdv_level level = *cage;
    for (int i = 0; i < surface->levels && !context->result; i++) {
        sdv_step *step = &surface->steps[i];
        level.end_sharpness = SDV_NEW(context, &arena, float, 2 * (size_t)level.edge_count);
        level.next_sharpness = SDV_NEW(context, &arena, float, level.vertex_count);
        if (context->result) break;
        sdv_level_fade(&level, rules->creasing);
        sdv_step_build(context, &surface->arena, step, &level, rules);
        size_t points = (size_t)level.vertex_count + (size_t)step->face_point_count;
        if (points > surface->most_points) surface->most_points = points;
        if (i + 1 < surface->levels) {
            sdv_level next;
            sdv_split(context, &next_arena, &level, &next, rules->scheme);
            sdv_arena_free(&arena);
            arena = next_arena;
            next_arena.blocks = NULL;
            level = next;
        } else {
            step->targets = SDV_NEW(context, &surface->arena, int,
                                    points + (size_t)level.edge_count);
            if (context->result) break;
            sdv_find_targets(&surface->order, &level, i, step->targets);
            sdv_surviving_sharpness(context, surface, &level, step->targets);
        }
    }
    sdv_arena_free(&arena);
    sdv_arena_free(&next_arena);
}

// What the result will be: counts and rules.
static void sdv_prepare_result(subdiv_surface *surface, const subdiv_mesh *work, int keep_holes)
{
    subdiv_mesh *fine = &surface->fine;
    sdv_order *order = &surface->order;
    int n = 1 << surface->levels;
    order->loop = work->scheme == SUBDIV_LOOP;
    order->n = n;
    order->m = n / 2;
    order->first_edge_point = work->vertex_count;
    order->first_face_point = work->vertex_count + order->cage.edge_count * (n - 1);
    fine->vertex_count = order->cage.face_count ? sdv_first_inside(order, order->cage.face_count)
                                                : work->vertex_count;
    fine->face_size = order->loop ? 3 : 4;
    for (int f = 0; f < order->cage.face_count; f++) {
        int size = sdv_face_end(&order->cage, f) - sdv_face_start(&order->cage, f);
        int parts = order->loop ? n * n : size * (order->m * order->m);
        if (!surface->hole[f] || keep_holes) fine->face_count += parts;
        if (surface->hole[f] && keep_holes) fine->hole_count += parts;
    }
}

// Level 0: everything as it is.
static void sdv_prepare_copy(sdv_context *context, subdiv_surface *surface, const subdiv_mesh *work)
{
    subdiv_mesh *fine = &surface->fine;
    size_t creases = (size_t)work->crease_count, corners = (size_t)work->corner_count;
    *fine = *work;
    fine->positions = NULL;
    fine->memory = NULL;
    fine->crease_vertices = SDV_NEW(context, &surface->arena, int, 2 * creases);
    fine->crease_sharpness = SDV_NEW(context, &surface->arena, float, creases);
    fine->corner_vertices = SDV_NEW(context, &surface->arena, int, corners);
    fine->corner_sharpness = SDV_NEW(context, &surface->arena, float, corners);
    fine->holes = SDV_NEW(context, &surface->arena, int, work->hole_count);
    if (context->result) return;
    sdv_copy(fine->crease_vertices, work->crease_vertices, 2 * creases, sizeof(int));
    sdv_copy(fine->crease_sharpness, work->crease_sharpness, creases, sizeof(float));
    sdv_copy(fine->corner_vertices, work->corner_vertices, corners, sizeof(int));
    sdv_copy(fine->corner_sharpness, work->corner_sharpness, corners, sizeof(float));
    sdv_copy(fine->holes, work->holes, (size_t)work->hole_count, sizeof(int));
}

static void sdv_prepare(sdv_context *context, subdiv_surface *surface, const subdiv_mesh *cage,
                        const subdiv_options *opt)
{
    subdiv_mesh work = *cage;
    surface->cage_vertex_count = cage->vertex_count;
    sdv_copy_faces(context, surface, &work, cage);
    sdv_cut_holes(context, surface, &work, cage);
    sdv_check_size(context, &work, surface->levels, -1);
    if (context->result) return;
    if (surface->levels == 0) {
        sdv_prepare_copy(context, surface, &work);
        return;
    }

    sdv_cage built;
    sdv_cage_build(context, &surface->arena, &built, &work);
    sdv_check_size(context, &work, surface->levels, built.level.edge_count);
    surface->steps = SDV_NEW(context, &surface->arena, sdv_step, surface->levels);
    if (context->result) return;
    surface->order.cage = built.level;
    surface->hole = built.hole;
    surface->fine.scheme = cage->scheme;
    surface->fine.boundary = cage->boundary;
    surface->fine.creasing = cage->creasing;
    surface->fine.triangles = cage->triangles;
    surface->fine.uv_rule = cage->uv_rule;
    sdv_prepare_result(surface, &work, opt && opt->keep_holes);
    sdv_prepare_levels(context, surface, &built.level, &work);
}

SUBDIV_DEF subdiv_result subdiv_prepare(subdiv_surface **surface, const subdiv_mesh *cage,
                                        int levels, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    if (surface) *surface = NULL;
    else sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "surface is NULL");
    if (levels < 0) sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "levels is %d", levels);
    if (!context.result) sdv_check_mesh(&context, cage);
    if (!context.result && cage->scheme == SUBDIV_LOOP && !(opt && opt->triangulate))
        sdv_check_triangles(&context, cage);
    if (context.result) return context.result;

    sdv_arena arena = { NULL };
    subdiv_surface *made = SDV_NEW(&context, &arena, subdiv_surface, 1);
    if (!made) return context.result;
    memset(made, 0, sizeof *made);
    made->arena = arena;
    made->levels = levels;
    sdv_prepare(&context, made, cage, opt);
    if (context.result) subdiv_surface_free(made);
    else *surface = made;
    return context.result;
}

// The surface is itself the arena's first block, so the arena is taken out before it is freed.
SUBDIV_DEF void subdiv_surface_free(subdiv_surface *surface)
{
    if (!surface) return;
    sdv_arena arena = surface->arena;
    sdv_arena_free(&arena);
}

// ------------------------------------------------------------------------------ >>evaluate

// out[i] = the weighted sum of row i, in one order of additions, so that its bits are always the
// same. Weights sum to 1, so p0 + w1 (p1 - p0) + w2 (p2 - p0) + ... is the same sum, whose rounding
// errors are those of the small differences: exact wherever the mesh stands.
static void sdv_apply(const sdv_rows *rows, const float *points, float *out, const int *targets)
{
    for (int i = 0; i < rows->count; i++) {
        size_t first = rows->starts[i], end = rows->starts[i + 1];
        const float *p0 = points + 3 * (size_t)rows->indices[first];
        float x = 0, y = 0, z = 0;
        for (size_t j = first + 1; j < end; j++) {
            const float *p = points + 3 * (size_t)rows->indices[j];
            float w = rows->weights[j];
            x += w * (p[0] - p0[0]);
            y += w * (p[1] - p0[1]);
            z += w * (p[2] - p0[2]);
        }
        float *q = out + 3 * (size_t)(targets ? targets[i] : i);
        q[0] = p0[0] + x;
        q[1] = p0[1] + y;
        q[2] = p0[2] + z;
    }
}

// One level: the step's face points are put behind the points that it starts from; then vertex
// points, face points and edge points go to out, in this order or to their targets.
static void sdv_apply_step(const sdv_step *step, float *points, float *out)
{
    int vertices = step->vertex_count, faces = step->face_point_count;
    float *face_points = points + 3 * (size_t)vertices;
    sdv_apply(&step->faces, points, face_points, NULL);
    for (int f = 0; f < faces; f++) {
        size_t target = (size_t)(step->targets ? step->targets[vertices + f] : vertices + f);
        memcpy(out + 3 * target, face_points + 3 * (size_t)f, 3 * sizeof(float));
    }
    sdv_rows part = step->points;
    part.count = vertices;
    sdv_apply(&part, points, out, step->targets);
    part.count = step->edge_count;
    part.starts += vertices;
    if (step->targets) sdv_apply(&part, points, out, step->targets + vertices + faces);
    else sdv_apply(&part, points, out + 3 * (size_t)(vertices + faces), NULL);
}

static void sdv_evaluate(sdv_context *context, const subdiv_surface *surface,
                         const float *positions, float *out)
{
    sdv_arena arena = { NULL };
    float *points = SDV_NEW(context, &arena, float, 3 * surface->most_points);
    float *next = SDV_NEW(context, &arena, float, 3 * surface->most_points);
    if (!context->result) {
        sdv_copy(points, positions, (size_t)surface->cage_vertex_count, 3 * sizeof(float));
        for (int i = 0; i < surface->levels; i++) {
            sdv_apply_step(&surface->steps[i], points, i + 1 < surface->levels ? next : out);
            float *swap = points;
            points = next;
            next = swap;
        }
    }
    sdv_arena_free(&arena);
}

// Lays arrays out in one block: first called with base NULL to add up the size.
static void *sdv_carve(char *base, size_t *size, size_t count, size_t item)
{
    char *array = base && count ? base + *size : NULL;
    *size += (count * item + 15) / 16 * 16;
    return array;
}

static size_t sdv_carve_mesh(subdiv_mesh *mesh, char *base, int result)
{
    size_t size = 0, vertices = (size_t)mesh->vertex_count, faces = (size_t)mesh->face_count;
    size_t creases = (size_t)mesh->crease_count, corners = (size_t)mesh->corner_count;
    size_t face_vertices = sdv_face_vertex_count(mesh);
    size_t sizes = mesh->face_size ? 0 : faces;
    mesh->positions = (float *)sdv_carve(base, &size, vertices, 3 * sizeof(float));
    mesh->face_vertices = (int *)sdv_carve(base, &size, face_vertices, sizeof(int));
    mesh->cage_faces = (int *)sdv_carve(base, &size, result ? faces : 0, sizeof(int));
    mesh->crease_vertices = (int *)sdv_carve(base, &size, creases, 2 * sizeof(int));
    mesh->crease_sharpness = (float *)sdv_carve(base, &size, creases, sizeof(float));
    mesh->corner_vertices = (int *)sdv_carve(base, &size, corners, sizeof(int));
    mesh->corner_sharpness = (float *)sdv_carve(base, &size, corners, sizeof(float));
    mesh->holes = (int *)sdv_carve(base, &size, (size_t)mesh->hole_count, sizeof(int));
    int *face_sizes = (int *)sdv_carve(base, &size, sizes, sizeof(int));
    if (base) mesh->face_sizes = face_sizes;
    return size;
}

// A mesh like the model, with room for positions and faces, of a result also for cage_faces; the
// lists that the model has are copied.
static void sdv_new_mesh(sdv_context *context, subdiv_mesh *mesh, const subdiv_mesh *model,
                         int result)
{
    *mesh = *model;
    sdv_block *block = sdv_allocate(context, sdv_carve_mesh(mesh, NULL, result));
    if (!block) {
        memset(mesh, 0, sizeof *mesh);
        return;
    }
    mesh->memory = block;
    sdv_carve_mesh(mesh, (char *)(block + 1), result);
    size_t creases = (size_t)model->crease_count, corners = (size_t)model->corner_count;
    if (model->crease_vertices) {
        sdv_copy(mesh->crease_vertices, model->crease_vertices, creases, 2 * sizeof(int));
        sdv_copy(mesh->crease_sharpness, model->crease_sharpness, creases, sizeof(float));
    }
    if (model->corner_vertices) {
        sdv_copy(mesh->corner_vertices, model->corner_vertices, corners, sizeof(int));
        sdv_copy(mesh->corner_sharpness, model->corner_sharpness, corners, sizeof(float));
    }
    if (mesh->face_sizes)
        sdv_copy(mesh->face_sizes, model->face_sizes, (size_t)model->face_count, sizeof(int));
}

// All fine faces in order, the faces of the cage they belong to, and which are holes.
static void sdv_fill_faces(const subdiv_surface *surface, subdiv_mesh *fine, int *rows)
{
    int *out = fine->face_vertices, face = 0, holes = 0;
    for (int f = 0; f < surface->order.cage.face_count; f++) {
        if (surface->hole[f] && !fine->hole_count) continue;
        int *end = sdv_fine_faces(&surface->order, f, rows, out);
        for (; out < end; out += fine->face_size, face++) {
            fine->cage_faces[face] = surface->cage_face ? surface->cage_face[f] : f;
            if (surface->hole[f]) fine->holes[holes++] = face;
        }
    }
}

static void sdv_fill_copy(const subdiv_surface *surface, subdiv_mesh *fine, const float *positions)
{
    const subdiv_mesh *model = &surface->fine;
    sdv_copy(fine->positions, positions, (size_t)fine->vertex_count, 3 * sizeof(float));
    sdv_copy(fine->face_vertices, model->face_vertices, sdv_face_vertex_count(fine), sizeof(int));
    sdv_copy(fine->holes, model->holes, (size_t)fine->hole_count, sizeof(int));
    for (int f = 0; f < fine->face_count; f++)
        fine->cage_faces[f] = surface->cage_face ? surface->cage_face[f] : f;
}

SUBDIV_DEF subdiv_result subdiv_surface_mesh(subdiv_mesh *fine, const subdiv_surface *surface,
                                             const float *positions, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    if (fine) memset(fine, 0, sizeof *fine);
    if (!fine || !surface) sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    else sdv_check_positions(&context, positions, surface->cage_vertex_count, FLT_MAX / 2);
    if (context.result) return context.result;

    subdiv_mesh made;
    sdv_arena scratch = { NULL };
    sdv_new_mesh(&context, &made, &surface->fine, 1);
    int *rows = SDV_NEW(&context, &scratch, int, 2 * ((size_t)surface->order.n + 1));
    if (!context.result && surface->levels == 0) {
        sdv_fill_copy(surface, &made, positions);
    } else if (!context.result) {
        sdv_fill_faces(surface, &made, rows);
        sdv_evaluate(&context, surface, positions, made.positions);
    }
    sdv_arena_free(&scratch);
    if (context.result) subdiv_mesh_free(&made);
    else *fine = made;
    return context.result;
}

SUBDIV_DEF subdiv_result subdiv_refine(subdiv_mesh *fine, const subdiv_mesh *cage, int levels,
                                       const subdiv_options *opt)
{
    subdiv_mesh out;
    subdiv_surface *surface = NULL;
    memset(&out, 0, sizeof out);
    if (!fine) {
        sdv_context context = sdv_begin(opt);
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "fine is NULL");
        return context.result;
    }
    subdiv_result result = subdiv_prepare(&surface, cage, levels, opt);
    if (!result) result = subdiv_surface_mesh(&out, surface, cage->positions, opt);
    subdiv_surface_free(surface);
    *fine = out;
    return result;
}

// ------------------------------------------------------------------------------- >>inspect

static void sdv_count_faces(subdiv_info *info, const subdiv_mesh *mesh)
{
    for (int f = 0; f < mesh->face_count; f++) {
        int size = sdv_face_size(mesh, f);
        if (size == 3) info->triangle_count++;
        else if (size == 4) info->quad_count++;
        else info->ngon_count++;
        if (size > info->max_face_size) info->max_face_size = size;
    }
}

// Creases and corners as the user's lists have them, before the shape adds its own.
static void sdv_count_sharp(subdiv_info *info, const sdv_level *level)
{
    for (int e = 0; e < level->edge_count; e++) {
        float s = level->edge_sharpness[e];
        info->crease_count += sdv_survives(s);
        info->infinite_crease_count += s == SUBDIV_INFINITE;
    }
    for (int v = 0; v < level->vertex_count; v++)
        info->corner_count += sdv_survives(level->vertex_sharpness[v]);
}

static void sdv_count_topology(subdiv_info *info, const sdv_cage *cage, subdiv_scheme scheme)
{
    const sdv_level *level = &cage->level;
    int regular = scheme == SUBDIV_LOOP ? 6 : 4;
    for (int e = 0; e < level->edge_count; e++) {
        info->boundary_edge_count += sdv_list_size(&level->edge_faces, e) == 1;
        info->nonmanifold_edge_count += cage->edge_odd[e];
    }
    for (int v = 0; v < level->vertex_count; v++) {
        int faces = sdv_list_size(&level->vertex_faces, v);
        int valence = sdv_list_size(&level->vertex_edges, v);
        if (valence > info->max_valence) info->max_valence = valence;
        if (faces == 0) info->isolated_vertex_count++;
        else if (cage->vertex_odd[v]) info->nonmanifold_vertex_count++;
        else if (valence == faces && valence != regular) info->extraordinary_vertex_count++;
    }
    for (int f = 0; f < level->face_count; f++) info->hole_count += cage->hole[f];
}

static int sdv_root(int *parent, int v)
{
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
}

// Pieces, by joining the ends of every edge.
static void sdv_count_components(subdiv_info *info, const sdv_level *level, int *parent)
{
    for (int v = 0; v < level->vertex_count; v++) parent[v] = v;
    for (int e = 0; e < level->edge_count; e++) {
        int a = sdv_root(parent, level->edge_vertices[2 * e]);
        int b = sdv_root(parent, level->edge_vertices[2 * e + 1]);
        parent[a > b ? a : b] = a > b ? b : a;
    }
    for (int v = 0; v < level->vertex_count; v++)
        info->component_count += parent[v] == v && sdv_list_size(&level->vertex_faces, v) > 0;
}

SUBDIV_DEF subdiv_result subdiv_inspect(subdiv_info *info, const subdiv_mesh *mesh,
                                        const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    if (info) memset(info, 0, sizeof *info);
    else sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "info is NULL");
    if (!context.result) sdv_check_all(&context, mesh);
    if (context.result) return context.result;

    sdv_arena arena = { NULL };
    sdv_cage cage;
    subdiv_mesh shape = *mesh;
    shape.boundary = SUBDIV_BOUNDARY_EDGE;   // so that only the mesh's own holes are holes
    sdv_cage_build(&context, &arena, &cage, &shape);
    int *parent = SDV_NEW(&context, &arena, int, mesh->vertex_count);
    if (!context.result) {
        info->vertex_count = mesh->vertex_count;
        info->edge_count = cage.level.edge_count;
        info->face_count = mesh->face_count;
        sdv_count_faces(info, mesh);
        sdv_count_topology(info, &cage, mesh->scheme);
        sdv_count_sharp(info, &cage.level);
        sdv_count_components(info, &cage.level, parent);
    }
    sdv_arena_free(&arena);
    return context.result;
}

// ------------------------------------------------------------------------------- >>numbers
// Text to the nearest float and back, independent of the locale. A double is close enough to the
// decimal to tell which float is nearest, unless it is so close to the middle between two floats
// that its own error could matter; then the decimal is compared with that middle exactly.

static double sdv_scale(double number, int64_t ten)     // number * 10^ten, to about 4 ulp
{
    static const double powers[] = { 1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11,
        1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };
    for (; ten > 22; ten -= 22) number *= 1e22;
    for (; ten < -22; ten += 22) number /= 1e22;
    return ten < 0 ? number / powers[-ten] : number * powers[ten];
}

typedef struct sdv_decimal {
    uint64_t head;                      // the first digits, up to 19
    int      head_count;
    int64_t  exponent;                  // the number is head * 10^exponent, or a little more if
    int      more;                      // there are more digits than head has: then
    const char *digits, *end;           // all digits, with leading zeros and a point
} sdv_decimal;

typedef struct sdv_big {                // an unsigned integer of up to 1536 bits
    uint32_t words[48];                 // lowest first
    int size;
} sdv_big;

static void sdv_big_step(sdv_big *big, uint32_t factor, uint32_t add)  // big = big * factor + add
{
    uint64_t carry = add;
    for (int i = 0; i < big->size; i++) {
        carry += (uint64_t)big->words[i] * factor;
        big->words[i] = (uint32_t)carry;
        carry >>= 32;
    }
    if (carry) big->words[big->size++] = (uint32_t)carry;
    SUBDIV_ASSERT(big->size < 48);
}

static void sdv_big_power(sdv_big *big, uint32_t base, int64_t power)  // big = big * base^power
{
    for (; power > 0; power--) sdv_big_step(big, base, 0);
}

static int sdv_big_compare(const sdv_big *a, const sdv_big *b)
{
    if (a->size != b->size) return a->size < b->size ? -1 : 1;
    for (int i = a->size - 1; i >= 0; i--)
        if (a->words[i] != b->words[i]) return a->words[i] < b->words[i] ? -1 : 1;
    return 0;
}

// -1, 0 or 1: the decimal is less than, equal to, greater than the middle of two floats. A middle
// has at most 113 digits, so behind the first 120 it only matters whether there is a nonzero one.
static int sdv_compare_decimal(const sdv_decimal *decimal, double middle)
{
    sdv_big left = { {0}, 0 }, right = { {0}, 0 };
    int count = 0, binary = 0, rest = 0;
    if (!decimal->more) {
        sdv_big_step(&left, 1, (uint32_t)(decimal->head >> 32));
        sdv_big_step(&left, 1u << 31, 0);
        sdv_big_step(&left, 2, (uint32_t)decimal->head);
        count = decimal->head_count;
    }
    for (const char *p = decimal->digits; decimal->more && p < decimal->end; p++) {
        if (*p == '.' || (count == 0 && *p == '0')) continue;
        if (count == 120) {
            rest |= *p != '0';
        } else {
            sdv_big_step(&left, 10, (uint32_t)(*p - '0'));
            count++;
        }
    }
    uint64_t half = (uint64_t)ldexp(frexp(middle, &binary), 53);    // middle = half * 2^(binary-53)
    sdv_big_step(&right, 1, (uint32_t)(half >> 32));
    sdv_big_step(&right, 1u << 31, 0);
    sdv_big_step(&right, 2, (uint32_t)half);
    int64_t ten = decimal->head_count + decimal->exponent - count;
    sdv_big_power(ten > 0 ? &left : &right, 10, ten > 0 ? ten : -ten);
    sdv_big_power(binary > 53 ? &right : &left, 2, binary > 53 ? binary - 53 : 53 - binary);
    int order = sdv_big_compare(&left, &right);
    return order == 0 ? rest : order;
}

// The nearest float; of two equally near the even one. Infinity if it is too large.
static float sdv_nearest_float(const sdv_decimal *decimal)
{
    int64_t magnitude = decimal->head_count + decimal->exponent;    // below 10^magnitude
    if (decimal->head == 0 || magnitude < -45) return 0;
    if (magnitude > 39) return (float)HUGE_VAL;
    double d = sdv_scale((double)decimal->head, decimal->exponent), middle;
    if (d >= FLT_MIN) {
        uint64_t bits;
        memcpy(&bits, &d, sizeof bits);
        int64_t low = (int64_t)(bits & 0x1fffffff) - 0x10000000;    // distance in ulp of the double
        if (low < -16 || low > 16) return (float)d;
        bits = (bits & ~(uint64_t)0x1fffffff) | 0x10000000;
        memcpy(&middle, &bits, sizeof middle);
    } else {
        double step = ldexp(1, -149), units = floor(d / step);      // denormals have even steps
        if (fabs(d / step - units - 0.5) > ldexp(units + 1, -48)) return (float)d;
        middle = (units + 0.5) * step;
    }
    return (float)(middle * (1 + sdv_compare_decimal(decimal, middle) * ldexp(1, -50)));
}

// Reads [+-]digits[.digits][e[+-]digits], the whole token. Returns 0 if it is anything else.
static int sdv_read_number(const char *p, const char *end, float *out)
{
    sdv_decimal decimal = { 0, 0, 0, 0, NULL, NULL };
    int negative = p < end && *p == '-', any = 0, point = 0;
    if (p < end && (*p == '-' || *p == '+')) p++;
    decimal.digits = p;
    for (; p < end && ((*p >= '0' && *p <= '9') || (*p == '.' && !point)); p++) {
        if (*p == '.') {
            point = 1;
            continue;
        }
        any = 1;
        if (decimal.head_count < 19) {
            decimal.head = decimal.head * 10 + (uint64_t)(*p - '0');
            decimal.head_count += decimal.head != 0;
            decimal.exponent -= point;
        } else {
            decimal.more = 1;
            decimal.exponent += !point;
        }
    }
    decimal.end = p;
    if (any && p < end && (*p == 'e' || *p == 'E')) {
        int64_t power = 0;
        int down = ++p < end && *p == '-';
        if (p < end && (*p == '-' || *p == '+')) p++;
        for (any = 0; p < end && *p >= '0' && *p <= '9'; p++, any = 1)
            if (power < INT64_MAX / 100) power = power * 10 + (*p - '0');
        decimal.exponent += down ? -power : power;
    }
    if (!any || p < end) return 0;
    *out = sdv_nearest_float(&decimal);
    if (negative) *out = -*out;
    return 1;
}

// The shortest of 1 to 9 digits that read back as the same float: digits * 10^ten.
static uint64_t sdv_shortest(float number, int *ten)
{
    double size = fabs((double)number);
    int e = (int)floor(log10(size));
    if (sdv_scale(size, -e) < 1) e--;
    if (sdv_scale(size, -e) >= 10) e++;
    sdv_decimal decimal = { 0, 0, 0, 0, NULL, NULL };
    // With 6 digits every float is hit that a shorter decimal hits; denormals have fewer.
    for (int count = size < FLT_MIN ? 1 : 6; count <= 9; count++) {
        *ten = e + 1 - count;
        decimal.head = (uint64_t)(sdv_scale(size, -*ten) + 0.5);
        decimal.exponent = *ten;
        decimal.head_count = count;
        if (sdv_nearest_float(&decimal) == (float)size) break;
    }
    for (; decimal.head % 10 == 0; decimal.head /= 10) ++*ten;
    return decimal.head;
}

// Writes a float, at most 16 characters; returns how many.
static size_t sdv_write_number(char *out, float number)
{
    char buffer[24], *end = buffer + sizeof buffer, *p = out;
    if (number < 0 || (number == 0 && 1 / number < 0)) *p++ = '-';
    if (number == 0) {
        *p++ = '0';
        return (size_t)(p - out);
    }
    int ten;
    char *digits = sdv_digits(end, sdv_shortest(number, &ten));
    int count = (int)(end - digits), point = count + ten;   // digits before the point
    if (point < -4 || point > 9) {
        *p++ = *digits++;
        if (digits < end) *p++ = '.';
        while (digits < end) *p++ = *digits++;
        *p++ = 'e';
        if (point < 1) *p++ = '-';
        char *power = sdv_digits(end, (uint64_t)(point < 1 ? 1 - point : point - 1));
        while (power < end) *p++ = *power++;
        return (size_t)(p - out);
    }
    if (point <= 0) {
        *p++ = '0';
        *p++ = '.';
        for (int i = point; i < 0; i++) *p++ = '0';
    }
    for (int i = 0; i < count; i++) {
        if (i == point && i > 0) *p++ = '.';
        *p++ = digits[i];
    }
    for (int i = count; i < point; i++) *p++ = '0';
    return (size_t)(p - out);
}

// ------------------------------------------------------------------------------ >>obj-read

typedef struct sdv_array {              // grows
    sdv_block *block;
    size_t count, capacity;             // in items
} sdv_array;

// Room for so many items in all; those that are there are kept.
static void sdv_grow(sdv_context *context, sdv_array *array, size_t capacity, size_t item)
{
    if (context->result) return;
    if (capacity > (size_t)PTRDIFF_MAX / item) {
        sdv_fail(context, SUBDIV_ERROR_MEMORY, "out of memory");
        return;
    }
    sdv_block *block = sdv_allocate(context, capacity * item);
    if (!block) return;
    if (array->block) {
        memcpy(block + 1, array->block + 1, array->count * item);
        SUBDIV_FREE(array->block, array->block->user);
    }
    array->block = block;
    array->capacity = capacity;
}

// One more item, not cleared; NULL when out of memory.
static void *sdv_push(sdv_context *context, sdv_array *array, size_t item)
{
    if (array->count == array->capacity)
        sdv_grow(context, array, array->capacity ? 2 * array->capacity : 64, item);
    if (context->result) return NULL;
    return (char *)(array->block + 1) + array->count++ * item;
}

static void sdv_push_int(sdv_context *context, sdv_array *array, int value)
{
    int *item = (int *)sdv_push(context, array, sizeof(int));
    if (item) *item = value;
}

static void sdv_push_float(sdv_context *context, sdv_array *array, float value)
{
    float *item = (float *)sdv_push(context, array, sizeof(float));
    if (item) *item = value;
}

static const void *sdv_items(const sdv_array *array)
{
    return array->block ? array->block + 1 : NULL;
}

static void sdv_array_free(sdv_array *array)
{
    if (array->block) SUBDIV_FREE(array->block, array->block->user);
    array->block = NULL;
}

typedef struct sdv_tag {                // an entry of a tag: kind 'c' crease, 'v' corner, 'h' hole
    int kind, a, b, line;
    float sharpness;
} sdv_tag;

typedef struct sdv_ahead {              // a face that names a vertex which is yet to come
    int line, vertex;
} sdv_ahead;

typedef struct sdv_obj {
    sdv_context *context;
    subdiv_read  read;
    void        *user;
    sdv_array    text;                  // what was read and not yet used: begin to text.count
    size_t       begin;
    int          ended;                 // nothing more to read
    int          line, next_line;       // of the statement, and of what follows
    subdiv_mesh  mesh;                  // rules and counts
    sdv_array    positions, face_sizes, face_vertices, tags, ahead;
    sdv_array    skipped;               // numbers of the file's faces that are not in the mesh
    sdv_array    ints, floats;          // of one tag
} sdv_obj;

static int sdv_is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\f' || c == '\v' || c == '\r';
}

// The next token of a statement; empty at its end or at a comment.
typedef struct sdv_token {
    const char *begin, *end;
} sdv_token;

static sdv_token sdv_next_token(const char **at, const char *end)
{
    const char *p = *at;
    sdv_token token;
    while (p < end && sdv_is_blank(*p)) p++;
    token.begin = p;
    if (p < end && *p == '#') p = token.begin = end;
    while (p < end && !sdv_is_blank(*p) && *p != '#') p++;
    token.end = *at = p;
    return token;
}

static int sdv_length(sdv_token token)
{
    ptrdiff_t size = token.end - token.begin;
    return size < 1000 ? (int)size : 1000;
}

static int sdv_token_is(sdv_token token, const char *text)
{
    size_t size = strlen(text);
    return (size_t)(token.end - token.begin) == size && memcmp(token.begin, text, size) == 0;
}

// Reads more text behind what is there. Used text makes room first.
static void sdv_read_more(sdv_obj *obj)
{
    sdv_array *text = &obj->text;
    char *data = (char *)(text->block + 1);
    memmove(data, data + obj->begin, text->count - obj->begin);
    text->count -= obj->begin;
    obj->begin = 0;
    if (text->count == text->capacity) {
        sdv_grow(obj->context, text, 2 * text->capacity, 1);
        if (obj->context->result) return;
        data = (char *)(text->block + 1);
    }
    size_t room = text->capacity - text->count;
    size_t size = obj->read(obj->user, data + text->count, room);
    if (size == 0) {
        obj->ended = 1;
    } else if (size > room) {
        sdv_fail(obj->context, SUBDIV_ERROR_IO, "reading failed");
    } else {
        text->count += size;
    }
}

// Where the line that goes on at p ends: at LF, CR LF or CR. NULL: not before end.
static char *sdv_line_end(char *p, char *end, int ended)
{
    char *newline = (char *)memchr(p, '\n', (size_t)(end - p));
    char *limit = newline ? newline : end;
    char *cr = (char *)memchr(p, '\r', (size_t)(limit - p));
    if (cr && cr + 1 < limit) return cr;
    return newline ? newline : ended ? end : NULL;
}

// The next statement: a line, joined with the next while it ends in a backslash that is not part
// of a comment. Returns 0 at the end of the text and after errors.
static int sdv_next_statement(sdv_obj *obj, const char **begin, const char **end)
{
    size_t scanned = 0, line = 0;       // what has no line end, where the last line began
    obj->line = obj->next_line;
    while (!obj->context->result) {
        char *data = (char *)(obj->text.block + 1) + obj->begin;
        char *last = data + (obj->text.count - obj->begin);
        if (data == last && obj->ended) return 0;
        char *stop = sdv_line_end(data + scanned, last, obj->ended);
        if (!stop) {
            scanned = last > data ? (size_t)(last - data) - 1 : 0;  // a CR may be the last byte
            sdv_read_more(obj);
            continue;
        }
        if (obj->next_line < INT_MAX) obj->next_line++;
        char *tail = stop > data && stop[-1] == '\r' ? stop - 1 : stop;
        if (tail > data + line && tail[-1] == '\\' &&
            !memchr(data + line, '#', (size_t)(tail - data) - line)) {
            scanned = line = (size_t)(stop - data) + (stop < last);
            memset(tail - 1, ' ', scanned - (size_t)(tail - 1 - data));
            if (stop < last) continue;
        }
        if (memchr(data, 0, (size_t)(stop - data)))
            sdv_fail_line(obj->context, SUBDIV_ERROR_SYNTAX, obj->line,
                          "binary data: not an OBJ file");
        *begin = data;
        *end = stop;
        obj->begin += (size_t)(stop - data) + (stop < last);
        return !obj->context->result;
    }
    return 0;
}

static void sdv_read_vertex(sdv_obj *obj, const char *at, const char *end)
{
    if (obj->mesh.vertex_count == INT_MAX)
        sdv_fail_line(obj->context, SUBDIV_ERROR_TOO_LARGE, obj->line, "too many vertices");
    for (int i = 0; i < 3 && !obj->context->result; i++) {
        sdv_token token = sdv_next_token(&at, end);
        float number = 0;
        if (token.begin == token.end)
            sdv_fail_line(obj->context, SUBDIV_ERROR_SYNTAX, obj->line,
                          "a vertex needs 3 coordinates, here are %d", i);
        else if (!sdv_read_number(token.begin, token.end, &number))
            sdv_fail_line(obj->context, SUBDIV_ERROR_SYNTAX, obj->line, "\"%t\" is not a number",
                          token.begin, sdv_length(token));
        else if (fabs((double)number) > FLT_MAX)
            sdv_fail_line(obj->context, SUBDIV_ERROR_NOT_FINITE, obj->line,
                          "\"%t\" is too large for a float", token.begin, sdv_length(token));
        sdv_push_float(obj->context, &obj->positions, number);
    }
    obj->mesh.vertex_count++;
}

// [+-]digits, saturating far outside of every range. Returns where it ends, NULL without digits.
static const char *sdv_read_index(const char *p, const char *end, int64_t *out)
{
    int negative = p < end && *p == '-', any = 0;
    int64_t number = 0;
    if (p < end && (*p == '-' || *p == '+')) p++;
    for (; p < end && *p >= '0' && *p <= '9'; p++, any = 1)
        if (number < INT64_MAX / 100) number = number * 10 + (*p - '0');
    *out = negative ? -number : number;
    return any ? p : NULL;
}

// v, v/t, v//n, v/t/n, and any of these with numbers left out behind a slash. Gives v alone.
static int sdv_read_face_vertex(sdv_token token, int64_t *v)
{
    const char *p = sdv_read_index(token.begin, token.end, v);
    for (int slashes = 0; p && p < token.end && *p == '/' && slashes < 2; slashes++) {
        int64_t unused;
        const char *behind = sdv_read_index(++p, token.end, &unused);
        if (behind) p = behind;
    }
    return p == token.end;
}

// One face-vertex: counted from 1, from the end if negative; vertices may follow their faces.
static void sdv_add_face_vertex(sdv_obj *obj, sdv_token token)
{
    int64_t v = 0;
    int count = obj->mesh.vertex_count;
    if (!sdv_read_face_vertex(token, &v)) {
        sdv_fail_line(obj->context, SUBDIV_ERROR_SYNTAX, obj->line,
                      "\"%t\" is not a face-vertex", token.begin, sdv_length(token));
        return;
    }
    int64_t index = v < 0 ? v + count : v - 1;
    if (index < 0 || index >= INT_MAX) {
        sdv_fail_line(obj->context, SUBDIV_ERROR_INDEX, obj->line,
                      v == 0 ? "vertex %t does not exist (the first is 1)"
                             : "vertex %t does not exist (the file has %d so far)",
                      token.begin, sdv_length(token), count);
        return;
    }
    sdv_push_int(obj->context, &obj->face_vertices, (int)index);
    if (index < count) return;

    // Only the largest so far need be remembered: the first that is too large is one of them.
    const sdv_ahead *ahead = (const sdv_ahead *)sdv_items(&obj->ahead);
    if (obj->ahead.count && ahead[obj->ahead.count - 1].vertex >= index) return;
    sdv_ahead *entry = (sdv_ahead *)sdv_push(obj->context, &obj->ahead, sizeof(sdv_ahead));
    if (!entry) return;
    entry->line = obj->line;
    entry->vertex = (int)index;
}

static void sdv_read_face(sdv_obj *obj, const char *at, const char *end)
{
    size_t first = obj->face_vertices.count;
    int limit = INT_MAX - (int)obj->skipped.count;
    sdv_token token = sdv_next_token(&at, end);
    for (; token.begin < token.end && !obj->context->result; token = sdv_next_token(&at, end))
        sdv_add_face_vertex(obj, token);
    size_t size = obj->face_vertices.count - first;
    if (obj->context->result) return;
    if (size > INT_MAX || obj->mesh.face_count == limit) {
        sdv_fail_line(obj->context, SUBDIV_ERROR_TOO_LARGE, obj->line, "too many faces");
    } else if (size < 3) {
        sdv_warn(obj->context, obj->line, "a face with %d vertices is skipped", (int)size);
        obj->face_vertices.count = first;
        sdv_push_int(obj->context, &obj->skipped, obj->mesh.face_count + (int)obj->skipped.count);
    } else {
        sdv_push_int(obj->context, &obj->face_sizes, (int)size);
        obj->mesh.face_count++;
    }
}

static void sdv_add_tag(sdv_obj *obj, int kind, int a, int b, float sharpness)
{
    sdv_tag *tag = (sdv_tag *)sdv_push(obj->context, &obj->tags, sizeof(sdv_tag));
    if (!tag) return;
    tag->kind = kind;
    tag->a = a;
    tag->b = b;
    tag->line = obj->line;
    tag->sharpness = sharpness > 0 ? sharpness : 0;
}

// Creases: pairs of vertices with one sharpness, or one each; or a chain with one for each link.
static int sdv_tag_creases(sdv_obj *obj, const int *v, int count, const float *s, int sharpnesses)
{
    int pairs = count >= 2 && count % 2 == 0 && (sharpnesses == 1 || sharpnesses == count / 2);
    int chain = count > 2 && sharpnesses == count - 1;
    if (!pairs && !chain) return 0;
    for (int i = 0; i + 1 < count; i += pairs ? 2 : 1)
        sdv_add_tag(obj, 'c', v[i], v[i + 1], s[sharpnesses == 1 ? 0 : pairs ? i / 2 : i]);
    return 1;
}

static int sdv_tag_corners(sdv_obj *obj, const int *v, int count, const float *s, int sharpnesses)
{
    if (count < 1 || (sharpnesses != 1 && sharpnesses != count)) return 0;
    for (int i = 0; i < count; i++)
        sdv_add_tag(obj, 'v', v[i], v[i], s[sharpnesses == 1 ? 0 : i]);
    return 1;
}

// A tag by its name; word: its first string. Returns 0 if it makes no sense.
static int sdv_use_tag(sdv_obj *obj, sdv_token name, sdv_token word)
{
    const int *ints = (const int *)sdv_items(&obj->ints);
    const float *floats = (const float *)sdv_items(&obj->floats);
    int int_count = (int)obj->ints.count, float_count = (int)obj->floats.count;
    int value = int_count == 1 ? ints[0] : -1;
    static const subdiv_boundary boundaries[] = { SUBDIV_BOUNDARY_NONE,
        SUBDIV_BOUNDARY_EDGE_AND_CORNER, SUBDIV_BOUNDARY_EDGE };
    static const subdiv_uv_rule uv_rules[] = { SUBDIV_UV_NONE, SUBDIV_UV_CORNERS_ONLY,
        SUBDIV_UV_CORNERS_PLUS1, SUBDIV_UV_CORNERS_PLUS2, SUBDIV_UV_BOUNDARIES, SUBDIV_UV_ALL };

    if (sdv_token_is(name, "crease"))
        return sdv_tag_creases(obj, ints, int_count, floats, float_count);
    if (sdv_token_is(name, "corner"))
        return sdv_tag_corners(obj, ints, int_count, floats, float_count);
    if (sdv_token_is(name, "hole")) {
        for (int i = 0; i < int_count; i++) sdv_add_tag(obj, 'h', ints[i], 0, 0);
        return int_count > 0;
    }
    if (sdv_token_is(name, "interpolateboundary")) {
        if (value < 0 || value > 2) return 0;
        obj->mesh.boundary = boundaries[value];
    } else if (sdv_token_is(name, "facevaryinginterpolateboundary")) {
        if (value < 0 || value > 5) return 0;
        obj->mesh.uv_rule = uv_rules[value];
    } else if (sdv_token_is(name, "creasemethod")) {
        if (!sdv_token_is(word, "normal") && !sdv_token_is(word, "chaikin")) return 0;
        obj->mesh.creasing = sdv_token_is(word, "chaikin") ? SUBDIV_CREASING_CHAIKIN
                                                           : SUBDIV_CREASING_UNIFORM;
    } else if (sdv_token_is(name, "smoothtriangles")) {
        if (!sdv_token_is(word, "catmark") && !sdv_token_is(word, "smooth")) return 0;
        obj->mesh.triangles = sdv_token_is(word, "smooth") ? SUBDIV_TRIANGLES_SMOOTH
                                                           : SUBDIV_TRIANGLES_CATMULL_CLARK;
    } else {
        return 0;
    }
    return 1;
}

// The counts of a tag, "ints/floats/strings".
static int sdv_read_tag_counts(sdv_token token, int64_t counts[3])
{
    const char *p = token.begin;
    for (int i = 0; i < 3; i++) {
        if (i > 0 && (p == token.end || *p++ != '/')) return 0;
        p = sdv_read_index(p, token.end, &counts[i]);
        if (!p || counts[i] < 0 || counts[i] > INT_MAX) return 0;
    }
    return p == token.end;
}

// t name ints/floats/strings ... Takes the values that are really there, whatever the counts say.
static int sdv_read_tag(sdv_obj *obj, const char *at, const char *end)
{
    int64_t counts[3], value;
    sdv_token name = sdv_next_token(&at, end), word = { end, end };
    if (!sdv_read_tag_counts(sdv_next_token(&at, end), counts)) return 0;
    obj->ints.count = obj->floats.count = 0;
    for (int64_t i = 0; i < counts[0] && !obj->context->result; i++) {
        sdv_token token = sdv_next_token(&at, end);
        if (token.begin == token.end) return 0;
        if (sdv_read_index(token.begin, token.end, &value) != token.end) return 0;
        if (value < 0 || value > INT_MAX) value = INT_MAX;     // found to be missing at the end
        sdv_push_int(obj->context, &obj->ints, (int)value);
    }
    for (int64_t i = 0; i < counts[1] && !obj->context->result; i++) {
        sdv_token token = sdv_next_token(&at, end);
        float number;
        if (!sdv_read_number(token.begin, token.end, &number)) return 0;
        sdv_push_float(obj->context, &obj->floats, number);
    }
    if (counts[2] > 0) word = sdv_next_token(&at, end);
    return obj->context->result || sdv_use_tag(obj, name, word);
}

static void sdv_read_statement(sdv_obj *obj, const char *at, const char *end)
{
    const char *start = at;
    sdv_token keyword = sdv_next_token(&at, end);
    if (sdv_token_is(keyword, "v")) {
        sdv_read_vertex(obj, at, end);
    } else if (sdv_token_is(keyword, "f") || sdv_token_is(keyword, "fo")) {
        sdv_read_face(obj, at, end);
    } else if (sdv_token_is(keyword, "t")) {
        if (!sdv_read_tag(obj, at, end))
            sdv_warn(obj->context, obj->line, "the tag \"%t\" is skipped",
                     start, (int)(end - start < 1000 ? end - start : 1000));
    }
}

static void sdv_skip_byte_order_mark(sdv_obj *obj)
{
    while (obj->text.count < 3 && !obj->ended && !obj->context->result) sdv_read_more(obj);
    if (obj->context->result || obj->text.count < 2) return;
    const unsigned char *text = (const unsigned char *)(obj->text.block + 1);
    if (obj->text.count >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) obj->begin = 3;
    if ((text[0] == 0xFF && text[1] == 0xFE) || (text[0] == 0xFE && text[1] == 0xFF))
        sdv_fail_line(obj->context, SUBDIV_ERROR_SYNTAX, 1, "UTF-16 text: not an OBJ file");
}

// What can only be said when everything is read.
static void sdv_check_obj(sdv_obj *obj)
{
    const sdv_ahead *ahead = (const sdv_ahead *)sdv_items(&obj->ahead);
    if (obj->mesh.vertex_count == 0)
        sdv_fail(obj->context, SUBDIV_ERROR_EMPTY, "the file has no vertices");
    for (size_t i = 0; i < obj->ahead.count; i++)
        if (ahead[i].vertex >= obj->mesh.vertex_count)
            sdv_fail_line(obj->context, SUBDIV_ERROR_INDEX, ahead[i].line,
                          "vertex %d does not exist (the file has %d)",
                          ahead[i].vertex + 1, obj->mesh.vertex_count);
}

// A face of the file is a face of the mesh, but for those that were skipped: -1.
static int sdv_mesh_face(const sdv_obj *obj, int face)
{
    const int *skipped = (const int *)sdv_items(&obj->skipped);
    int before = 0;
    for (size_t i = 0; i < obj->skipped.count && skipped[i] <= face; i++) {
        if (skipped[i] == face) return -1;
        before++;
    }
    return face - before < obj->mesh.face_count ? face - before : -1;
}

// Drops the tags whose vertices or faces do not exist and counts the rest.
static void sdv_check_tags(sdv_obj *obj)
{
    sdv_tag *tags = (sdv_tag *)(obj->tags.block + 1);
    size_t kept = 0;
    subdiv_mesh *mesh = &obj->mesh;
    for (size_t i = 0; i < obj->tags.count; i++) {
        sdv_tag tag = tags[i];
        int vertex = tag.a > tag.b ? tag.a : tag.b;
        if (tag.kind == 'h') {
            tag.a = sdv_mesh_face(obj, tags[i].a);
            if (tag.a < 0)
                sdv_warn(obj->context, tag.line, "hole: face %d does not exist", tags[i].a);
        } else if (vertex >= mesh->vertex_count) {
            sdv_warn(obj->context, tag.line, "tag: vertex %d does not exist (counted from 0)",
                     vertex);
            tag.a = -1;
        }
        if (tag.a < 0) continue;
        tags[kept++] = tag;
        if (tag.kind == 'c') mesh->crease_count++;
        else if (tag.kind == 'v') mesh->corner_count++;
        else mesh->hole_count++;
    }
    obj->tags.count = kept;
    if (kept > INT_MAX) sdv_fail(obj->context, SUBDIV_ERROR_TOO_LARGE, "too many tags");
}

static void sdv_fill_tags(const sdv_obj *obj, subdiv_mesh *mesh)
{
    const sdv_tag *tags = (const sdv_tag *)sdv_items(&obj->tags);
    int creases = 0, corners = 0, holes = 0;
    for (size_t i = 0; i < obj->tags.count; i++) {
        const sdv_tag *tag = &tags[i];
        if (tag->kind == 'c') {
            mesh->crease_vertices[2 * creases] = tag->a;
            mesh->crease_vertices[2 * creases + 1] = tag->b;
            mesh->crease_sharpness[creases++] = tag->sharpness;
        } else if (tag->kind == 'v') {
            mesh->corner_vertices[corners] = tag->a;
            mesh->corner_sharpness[corners++] = tag->sharpness;
        } else {
            mesh->holes[holes++] = tag->a;
        }
    }
}

// Everything that was read, in one block.
static void sdv_finish_obj(sdv_obj *obj, subdiv_mesh *out)
{
    if (!obj->context->result) sdv_check_obj(obj);
    if (!obj->context->result && obj->tags.count) sdv_check_tags(obj);
    if (obj->context->result) return;

    subdiv_mesh mesh = obj->mesh;
    const int *sizes = (const int *)sdv_items(&obj->face_sizes);
    mesh.face_size = mesh.face_count ? sizes[0] : 0;
    for (int f = 0; f < mesh.face_count; f++)
        if (sizes[f] != sizes[0]) mesh.face_size = 0;
    if (!mesh.face_size && mesh.face_count) mesh.face_sizes = (int *)(obj->face_sizes.block + 1);
    sdv_new_mesh(obj->context, out, &mesh, 0);
    if (obj->context->result) return;
    sdv_copy(out->positions, sdv_items(&obj->positions), obj->positions.count, sizeof(float));
    sdv_copy(out->face_vertices, sdv_items(&obj->face_vertices), obj->face_vertices.count,
             sizeof(int));
    sdv_fill_tags(obj, out);
}

static subdiv_result sdv_load(sdv_context *context, subdiv_mesh *mesh, subdiv_read read, void *user)
{
    if (mesh) memset(mesh, 0, sizeof *mesh);
    if (!mesh || !read) sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    if (context->result) return context->result;

    sdv_obj obj;
    memset(&obj, 0, sizeof obj);
    obj.context = context;
    obj.read = read;
    obj.user = user;
    obj.next_line = 1;
    sdv_grow(context, &obj.text, 1 << 18, 1);      // stays in the cache; grows for longer lines
    sdv_skip_byte_order_mark(&obj);
    const char *begin, *end;
    while (sdv_next_statement(&obj, &begin, &end)) sdv_read_statement(&obj, begin, end);
    sdv_finish_obj(&obj, mesh);

    sdv_array *arrays[] = { &obj.text, &obj.positions, &obj.face_sizes, &obj.face_vertices,
                            &obj.tags, &obj.ahead, &obj.skipped, &obj.ints, &obj.floats };
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) sdv_array_free(arrays[i]);
    return context->result;
}

SUBDIV_DEF subdiv_result subdiv_load_obj_callback(subdiv_mesh *mesh, subdiv_read read, void *user,
                                                  const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    return sdv_load(&context, mesh, read, user);
}

typedef struct sdv_memory {
    const char *text;
    size_t left;
} sdv_memory;

static size_t sdv_read_memory(void *user, void *bytes, size_t size)
{
    sdv_memory *memory = (sdv_memory *)user;
    if (size > memory->left) size = memory->left;
    sdv_copy(bytes, memory->text, size, 1);
    memory->text += size;
    memory->left -= size;
    return size;
}

SUBDIV_DEF subdiv_result subdiv_load_obj_memory(subdiv_mesh *mesh, const void *text, size_t size,
                                                const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_memory memory = { (const char *)text, size };
    return sdv_load(&context, mesh, text || size == 0 ? sdv_read_memory : NULL, &memory);
}

// ----------------------------------------------------------------------------- >>obj-write

typedef struct sdv_output {
    sdv_context *context;
    subdiv_write write;
    void        *user;
    char        *buffer;                // [SDV_OUTPUT_SIZE]
    size_t       used;
} sdv_output;

#define SDV_OUTPUT_SIZE 65536

static void sdv_flush(sdv_output *out)
{
    if (!out->context->result && out->used &&
        out->write(out->user, out->buffer, out->used) != out->used)
        sdv_fail(out->context, SUBDIV_ERROR_IO, "writing failed");
    out->used = 0;
}

static void sdv_write_text(sdv_output *out, const char *text)
{
    size_t size = strlen(text);         // literals only: short
    if (out->used + size > SDV_OUTPUT_SIZE) sdv_flush(out);
    memcpy(out->buffer + out->used, text, size);
    out->used += size;
}

static void sdv_write_float(sdv_output *out, float number)
{
    if (out->used + 32 > SDV_OUTPUT_SIZE) sdv_flush(out);
    out->buffer[out->used++] = ' ';
    out->used += sdv_write_number(out->buffer + out->used, number);
}

static void sdv_write_int(sdv_output *out, int64_t number)
{
    char digits[24], *end = digits + sizeof digits, *first = sdv_digits(end, (uint64_t)number);
    if (out->used + 32 > SDV_OUTPUT_SIZE) sdv_flush(out);
    out->buffer[out->used++] = ' ';
    memcpy(out->buffer + out->used, first, (size_t)(end - first));
    out->used += (size_t)(end - first);
}

static void sdv_write_sharpness(sdv_output *out, float sharpness)
{
    if (sharpness > SUBDIV_INFINITE) sharpness = SUBDIV_INFINITE;
    sdv_write_float(out, sharpness > 0 ? sharpness : 0);
    sdv_write_text(out, "\n");
}

static void sdv_write_rules(sdv_output *out, const subdiv_mesh *mesh)
{
    static const char *const boundaries[] = { "2\n", "1\n", "0\n" };
    static const char *const uv_rules[] = { "1\n", "2\n", "3\n", "4\n", "5\n", "0\n" };
    sdv_write_text(out, "t interpolateboundary 1/0/0 ");
    sdv_write_text(out, boundaries[mesh->boundary]);
    if (mesh->uv_rule != SUBDIV_UV_CORNERS_ONLY) {
        sdv_write_text(out, "t facevaryinginterpolateboundary 1/0/0 ");
        sdv_write_text(out, uv_rules[mesh->uv_rule]);
    }
    if (mesh->creasing == SUBDIV_CREASING_CHAIKIN)
        sdv_write_text(out, "t creasemethod 0/0/1 chaikin\n");
    if (mesh->triangles == SUBDIV_TRIANGLES_SMOOTH)
        sdv_write_text(out, "t smoothtriangles 0/0/1 smooth\n");
}

// One entry per tag, the form that every reader of these tags understands.
static void sdv_write_tags(sdv_output *out, const subdiv_mesh *mesh)
{
    if (!mesh->crease_count && !mesh->corner_count && !mesh->hole_count &&
        mesh->boundary == SUBDIV_BOUNDARY_EDGE && mesh->uv_rule == SUBDIV_UV_CORNERS_ONLY &&
        mesh->creasing == SUBDIV_CREASING_UNIFORM &&
        mesh->triangles == SUBDIV_TRIANGLES_CATMULL_CLARK) return;
    sdv_write_rules(out, mesh);
    for (int i = 0; i < mesh->crease_count; i++) {
        sdv_write_text(out, "t crease 2/1/0");
        sdv_write_int(out, mesh->crease_vertices[2 * i]);
        sdv_write_int(out, mesh->crease_vertices[2 * i + 1]);
        sdv_write_sharpness(out, mesh->crease_sharpness[i]);
    }
    for (int i = 0; i < mesh->corner_count; i++) {
        sdv_write_text(out, "t corner 1/1/0");
        sdv_write_int(out, mesh->corner_vertices[i]);
        sdv_write_sharpness(out, mesh->corner_sharpness[i]);
    }
    for (int i = 0; i < mesh->hole_count; i++) {
        sdv_write_text(out, "t hole 1/0/0");
        sdv_write_int(out, mesh->holes[i]);
        sdv_write_text(out, "\n");
    }
}

static void sdv_write_mesh(sdv_output *out, const subdiv_mesh *mesh)
{
    for (int v = 0; v < mesh->vertex_count && !out->context->result; v++) {
        sdv_write_text(out, "v");
        const float *p = mesh->positions + 3 * (size_t)v;
        for (int i = 0; i < 3; i++) sdv_write_float(out, p[i]);
        sdv_write_text(out, "\n");
    }
    const int *vertices = mesh->face_vertices;
    for (int f = 0; f < mesh->face_count && !out->context->result; f++) {
        sdv_write_text(out, "f");
        for (int i = sdv_face_size(mesh, f); i > 0; i--)
            sdv_write_int(out, (int64_t)*vertices++ + 1);
        sdv_write_text(out, "\n");
    }
}

static subdiv_result sdv_save(sdv_context *context, const subdiv_mesh *mesh, subdiv_write write,
                              void *user, const subdiv_options *opt)
{
    if (!write) sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    if (!context->result) sdv_check_all(context, mesh);

    sdv_arena arena = { NULL };
    sdv_output out = { context, write, user, NULL, 0 };
    out.buffer = SDV_NEW(context, &arena, char, SDV_OUTPUT_SIZE);
    if (!context->result) {
        sdv_write_mesh(&out, mesh);
        if (!opt || !opt->no_tags) sdv_write_tags(&out, mesh);
        sdv_flush(&out);
    }
    sdv_arena_free(&arena);
    return context->result;
}

SUBDIV_DEF subdiv_result subdiv_save_obj_callback(const subdiv_mesh *mesh, subdiv_write write,
                                                  void *user, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    return sdv_save(&context, mesh, write, user, opt);
}

typedef struct sdv_store {
    char *text;
    size_t size, capacity;
} sdv_store;

static size_t sdv_write_memory(void *user, const void *bytes, size_t size)
{
    sdv_store *store = (sdv_store *)user;
    if (store->size < store->capacity) {
        size_t room = store->capacity - store->size;
        sdv_copy(store->text + store->size, bytes, size < room ? size : room, 1);
    }
    store->size += size;
    return size;
}

SUBDIV_DEF subdiv_result subdiv_save_obj_memory(const subdiv_mesh *mesh, void *text,
                                                size_t capacity, size_t *size,
                                                const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_store store = { (char *)text, 0, capacity };
    if (size) *size = 0;
    if (!size || (capacity && !text))
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    else if (!sdv_save(&context, mesh, sdv_write_memory, &store, opt))
        *size = store.size;
    if (!context.result && capacity && capacity < store.size)
        sdv_fail(&context, SUBDIV_ERROR_TOO_LARGE, "the text does not fit the buffer");
    return context.result;
}

#ifndef SUBDIV_NO_STDIO

static size_t sdv_read_file(void *user, void *bytes, size_t size)
{
    FILE *file = (FILE *)user;
    size_t got = fread(bytes, 1, size, file);
    return got == 0 && ferror(file) ? (size_t)-1 : got;
}

static size_t sdv_write_file(void *user, const void *bytes, size_t size)
{
    return fwrite(bytes, 1, size, (FILE *)user);
}

SUBDIV_DEF subdiv_result subdiv_load_obj(subdiv_mesh *mesh, const char *path,
                                         const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    if (mesh) memset(mesh, 0, sizeof *mesh);
    if (!path) {
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "path is NULL");
        return context.result;
    }
    context.name = path;
    errno = 0;
    FILE *file = fopen(path, "rb");
    if (!file) {
        sdv_fail(&context, SUBDIV_ERROR_IO, "%s", strerror(errno));
        return context.result;
    }
    sdv_load(&context, mesh, sdv_read_file, file);
    fclose(file);
    return context.result;
}

SUBDIV_DEF subdiv_result subdiv_save_obj(const subdiv_mesh *mesh, const char *path,
                                         const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    if (!path) sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "path is NULL");
    else sdv_check_all(&context, mesh);            // before the file is overwritten
    if (context.result) return context.result;
    context.name = path;
    errno = 0;
    FILE *file = fopen(path, "wb");
    if (!file) {
        sdv_fail(&context, SUBDIV_ERROR_IO, "%s", strerror(errno));
        return context.result;
    }
    sdv_save(&context, mesh, sdv_write_file, file, opt);
    if (fclose(file) && !context.result) sdv_fail(&context, SUBDIV_ERROR_IO, "writing failed");
    return context.result;
}

#endif // SUBDIV_NO_STDIO

// ------------------------------------------------------------------------------- >>cleanup
#undef SDV_NEW
#undef SDV_IMPLIED
#undef SDV_OUTPUT_SIZE
#endif // SUBDIV_IMPLEMENTATION

/* Either of these two licences, as you like.

   1. MIT License. Copyright (c) 2026 the subdiv.h authors

   Permission is hereby granted, free of charge, to any person obtaining a copy of this software
   and associated documentation files (the "Software"), to deal in the Software without
   restriction, including without limitation the rights to use, copy, modify, merge, publish,
   distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the
   Software is furnished to do so, subject to the following conditions:

   The above copyright notice and this permission notice shall be included in all copies or
   substantial portions of the Software.

   THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT
   NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND
   NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM,
   DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
   OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.

   2. Public domain (The Unlicense, unlicense.org)

   This is free and unencumbered software released into the public domain. Anyone is free to copy,
   modify, publish, use, compile, sell, or distribute this software, either in source code form or
   as a compiled binary, for any purpose, commercial or non-commercial, and by any means.

   In jurisdictions that recognize copyright laws, the author or authors of this software dedicate
   any and all copyright interest in the software to the public domain. We make this dedication for
   the benefit of the public at large and to the detriment of our heirs and successors. We intend
   this dedication to be an overt act of relinquishment in perpetuity of all present and future
   rights to this software under copyright law.

   THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT
   NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND
   NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
   LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN
   CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE. */
