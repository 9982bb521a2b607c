/* subdiv.h - v0.1 - subdivision surfaces in one C header - MIT or public domain, see the end

   The library takes a cage: a mesh of polygons, with creases, corners and holes if you like. It
   refines the cage by Catmull-Clark, Loop or bilinear subdivision, as often as you ask. The rules
   are those of the papers below and of OpenSubdiv; tests compare every vertex with OpenSubdiv.
   The library has no GPU code and no hierarchical edits; it never prints and never exits.

   DO THIS
   In ONE C or C++ file, define SUBDIV_IMPLEMENTATION before the #include: this creates the
   implementation. Everywhere else just #include "subdiv.h". You need C99 or C++11 and the standard
   library (-lm). If your program is a single file, define SUBDIV_STATIC, too: the compiler then
   leaves out the functions you do not call and takes about half the time. In a larger program give
   the implementation a file of its own, so that it is compiled once.

   QUICK START: one call
       #include <stdio.h>
       #define SUBDIV_STATIC
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
       float P[] = {-1,-1,-1, 1,-1,-1, 1,1,-1, -1,1,-1, -1,-1,1, 1,-1,1, 1,1,1, -1,1,1};
       int   F[] = {0,3,2,1, 4,5,6,7, 0,1,5,4, 1,2,6,5, 2,3,7,6, 3,0,4,7};
       int   E[] = {4,5, 5,6, 6,7, 7,4};               // the four edges of the top
       float S[] = {2, 2, 2, SUBDIV_INFINITE};         // for how many levels each stays sharp

       subdiv_mesh cube = {0};
       cube.vertex_count = 8;  cube.positions = P;
       cube.face_count   = 6;  cube.face_size = 4;  cube.face_vertices    = F;
       cube.crease_count = 4;  cube.crease_vertices = E;  cube.crease_sharpness = S;

   CONTENTS                     search for the tag, for instance >>masks
   Public:   >>config  >>types    macros you may define; mesh, options, errors
             >>refine             a cage into a finer mesh, in one call or in two steps
             >>animation          new values on the same topology, in every frame
             >>limit              the limit surface at the points of the result
             >>buffers            vertex buffers to draw, filled again in every frame
             >>exact              the limit surface anywhere
             >>stencils           points as sums of cage vertices; explains points
             >>tessellation       meshes of the limit surface, each edge cut as you like
             >>curves             corner cutting and B-spline curves
             >>creases            from angles, smoothing groups, UV seams and chains
             >>inspect  >>obj     what a cage is made of, what is odd about it; OBJ files
   Inside:   >>platform  >>memory  >>errors  >>validate     the ground everything stands on
             >>level     a mesh with its edges and sharpness; >>cage makes level 0 from polygons
           * >>sharpness how creases and corners fade
           * >>masks     THE LECTURE: face, edge and vertex points of every scheme
             >>curves    the masks of creases, along curves
             >>order     where each point of the result stands
             >>rows      masks written out as weights of points; >>lines: those of finer levels
             >>face-varying  UVs: a topology of their own
             >>prepare   what makes a surface: >>limit-rows  >>fill  >>create
           * >>grids     the general step: points of a level from those of the level before
             >>results   what makes the result: >>limit-surface  >>evaluate  >>results-as-meshes
           * >>calls     subdiv_refine and the other functions of >>refine, >>animation, >>limit
             >>split     levels as meshes; >>plain makes all points of such levels, for SUBDIV_PLAIN
             >>exact-surface  the limit between the points: >>patches  >>nests  >>leaves
                         >>locations  >>cells  >>polynomials  >>samples
             >>stencils  >>tiles  >>tile-points  >>tessellator  >>normals  >>vertex-buffers
             >>generators  >>inspection  >>oddities  >>numbers  >>obj-read  >>obj-write  >>explain
             >>cleanup
   Students: read examples/README.md and examples/00_lecture.c first, then >>masks and the other
   sections with a star; skip the rest. These calls lead to a mask: subdiv_refine > sdv_prepare >
   sdv_prepare_rows > sdv_fill_level > sdv_vertex_row > sdv_vertex_mask > sdv_smooth_vertex >
   sdv_catmull_clark_vertex. These lead to the sum: subdiv_refine > sdv_make_mesh >
   subdiv_evaluate > sdv_make_all > sdv_make_range > sdv_make_points > sdv_make_batches >
   sdv_batch_sum. Under SUBDIV_PLAIN, these lead to the masks of all points of all levels:
   sdv_prepare_rows > sdv_plain_rows > sdv_split_step > sdv_split_rows > sdv_vertex_row.

   WORDS
   cage            the mesh you start from            level      how often it has been refined
   face-vertex     one vertex of one face; others call it a face corner or a half-edge
   valence         number of edges at a vertex; 4 is regular for quads, 6 for triangles
   extraordinary   an interior vertex of another valence
   boundary        an edge with one face
   non-manifold    an edge with three or more faces, or with two wound against each other; a vertex
                   at such an edge, or whose faces are not one fan
   face point, edge point, vertex point    what a face, an edge, a vertex becomes one level down
   even, odd       Loop's names: even = vertex points, odd = edge points
   mask            the weights that make such a point from the points around it
   sharpness       for how many levels an edge or vertex stays sharp; 0 smooth, >= 10 forever
   crease          a sharp edge                       corner     a sharp vertex
   dart            a vertex where one crease ends     semi-sharp 0 < sharpness < 10
   sector          the faces around a vertex from one infinitely sharp edge to the next
   limit           the smooth surface that refinement tends to

   THE ORDER OF THE RESULT, a promise
   With n = 2^levels:
   * The vertices of the cage come first: vertex i stays vertex i.
   * The n-1 points inside each edge come next, from its lower-numbered end to the other. Edges are
     in the order in which the faces first meet them (face 0's edge 0-1, 1-2, ...).
   * The points inside each face come last, face by face:

       a quad                3 . . . 2       a triangle under Loop      2
       row by row from       . 7 8 9 .       row by row from            . .
       edge 0-1 to 2-3,      . 4 5 6 .       edge 0-1 to vertex 2       . 3 .
       each from edge 3-0    . 1 2 3 .                                  . 1 2 .
       to 1-2                0 . . . 1                                  0 . . . 1

     Any other polygon under Catmull-Clark or bilinear has its centre first; then the inside of each
     spoke i, from the centre to the middle of edge i (from vertex i to i+1); then the inside of the
     quad at each vertex i, row by row as above. The corners of this quad are vertex i, the middle
     of edge i, the centre and the middle of edge i-1.
   * The fine faces of cage face f are one contiguous range, in the order of f. They go row by row,
     those of an n-gon quad by quad. A quad in row r and column c is (r,c) (r,c+1) (r+1,c+1)
     (r+1,c). In a row of triangles, those like the parent, (r,c) (r,c+1) (r+1,c), alternate with
     those upside down, (r+1,c+1) (r+1,c) (r,c+1). Holes have no faces, but their points stay.

   WHERE IT DIFFERS FROM OPENSUBDIV
   * Chaikin creasing: where an end of a crease turns smooth, the crease rule is weighted by the
     sharpness, but at most by 1. OpenSubdiv has no such bound: above 1, it extrapolates.
   * Limit: OpenSubdiv counts sharpness that is left on the last level as infinite, and a dart as
     smooth, so its limit is not where refinement leads. It leaves a smooth Catmull-Clark vertex of
     valence 2 where it is. Its tangents at a crease or boundary are wrong unless there are 1 or 2
     faces (Loop: 1 to 3) on that side. Its tangents at a corner are two edges. Where a vertex has
     more faces than edges, it writes tangents out of bounds.
   * A crease of two non-manifold edges runs through a vertex only if every sheet of faces there
     leads from one edge to the other; else the vertex is sharp. OpenSubdiv only counts faces.
   * UVs: where values around a vertex go A B A B, OpenSubdiv takes the second B for a third value.
   * Defaults: the boundary is "edge", not "none"; the rule for UVs is "corners only", not "all".
     Indices are checked. Valence has no limit.

   MEMORY, THREADS, LIMITS
   * A mesh made by the library is one block, which subdiv_mesh_free frees. It also frees the crease
     lists and normals that the library adds to a mesh of yours. Arrays that you filled in are never
     written or freed. Output is overwritten, not freed.
   * An error zeroes the output. A mesh that was to be changed, and arrays of yours that were to be
     filled, stay as they were. Where a call can fail halfway, its comment says so.
   * The library keeps no state, so different threads may call it at once. One call uses the threads
     that you lend it. The same input gives the same bits on any number of threads, with SIMD and
     without, from any compiler and on any platform that rounds each operation as IEEE 754 does:
     not on x87, which 32-bit x86 uses without -msse2 -mfpmath=sse, and not with -ffast-math.
   * A call takes less than 16 KB of stack, if it is compiled with optimisation. Nothing recurses
     deeper for a larger mesh.
   * A result has up to 2^31-1 vertices and faces, a cage up to 2^30 face-vertices. Larger ones are
     refused before they are built.
   * Positions of meshes may be as large as floats go. UVs, colours and values to evaluate have to
     be below 2^116 (8e34) in size, or sums may overflow.

   REFERENCES
   [CC78]  Catmull, Clark: Recursively generated B-spline surfaces on arbitrary topological meshes
   [DS78]  Doo, Sabin: Behaviour of recursive division surfaces near extraordinary points
   [Chaikin74] Chaikin: An algorithm for high-speed curve generation
   [Loop87] Loop: Smooth subdivision surfaces based on triangles
   [HDD94] Hoppe, DeRose, et al.: Piecewise smooth surface reconstruction
   [Warren95] Warren: Subdivision methods for geometric design
   [DKT98] DeRose, Kass, Truong: Subdivision surfaces in character animation
   [HKD93] Halstead, Kass, DeRose: Efficient, fair interpolation using Catmull-Clark surfaces
   [BLZ00] Biermann, Levin, Zorin: Piecewise smooth subdivision surfaces with normal control
   [Stam98] Stam: Evaluation of Loop subdivision surfaces
   [OSD]   OpenSubdiv 3.5, Sdc and Far: the rules where the papers are silent */

#ifndef SUBDIV_H
#define SUBDIV_H

// -------------------------------------------------------------------------------- >>config
// Define these before the #include, in the file with SUBDIV_IMPLEMENTATION:
//
//     SUBDIV_STATIC                  functions are private to that file, compiled only if called
//     SUBDIV_DEF                     your own decoration of the public functions
//     SUBDIV_MALLOC(size, user)      your own allocator: define both or neither; align as malloc
//     SUBDIV_FREE(pointer, user)     does. user is opt->user
//     SUBDIV_ASSERT(condition)       checks the library's own logic; assert by default
//     SUBDIV_NO_STDIO                no FILE: OBJ through memory and callbacks alone
//     SUBDIV_NO_HUGE_PAGES           Linux: pages of the usual size for large blocks
//     SUBDIV_NO_SIMD                 plain C instead of SSE2, NEON or WebAssembly SIMD
//     SUBDIV_PLAIN                   no shortcuts, for classrooms and tests: all levels are meshes,
//                                    and a breakpoint in a mask stops at every point. Slow; equal
//                                    results but for rounding. SUBDIV_EXACT still uses polynomials
//
// Define these to leave whole sections out, declarations included. The percentages say how much of
// the code each saves (gcc -O2); compile time falls about as much:
//
//     SUBDIV_NO_EXACT                >>exact (but subdiv_surface_locations), >>tessellation,
//                                    subdiv_stencils_at                             (31 %)
//     SUBDIV_NO_TOOLS                >>creases, >>inspect, subdiv_explain, _points  (10 %)
//     SUBDIV_NO_OBJ                  >>obj                                          (11 %)

#define SUBDIV_VERSION 1              // 100 * major + minor

#include <stddef.h>

#ifndef SUBDIV_DEF
#if defined(SUBDIV_STATIC)
#define SUBDIV_DEF static inline            // inline: no warning about unused functions
#elif defined(__cplusplus)
#define SUBDIV_DEF extern "C"
#else
#define SUBDIV_DEF extern
#endif
#endif

// --------------------------------------------------------------------------------- >>types

#define SUBDIV_INFINITE 10.0f         // this sharpness or more never fades

// The code and text of every result. Any function may fail with ARGUMENT (a needed pointer is NULL,
// a count is negative, a value is out of range, a surface was prepared for something else) or
// MEMORY. A function that reads a mesh checks it: EMPTY, INDEX, FACE, NOT_FINITE, TOO_LARGE (see
// LIMITS) and, if it refines, NOT_TRIANGLE. Comments of functions name further causes only.
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
    SUBDIV_BOUNDARY_EDGE_AND_CORNER,  // a smooth curve with corners at vertices of a single face
    SUBDIV_BOUNDARY_NONE              // faces that touch an unsharpened boundary become holes
} subdiv_boundary;

typedef enum subdiv_creasing {
    SUBDIV_CREASING_UNIFORM,          // sharpness falls by 1 a level
    SUBDIV_CREASING_CHAIKIN           // sharpness is also averaged along the crease [DKT98]
} subdiv_creasing;

typedef enum subdiv_triangles {
    SUBDIV_TRIANGLES_CATMULL_CLARK,   // triangles of a Catmull-Clark cage have no rule of their own
    SUBDIV_TRIANGLES_SMOOTH           // triangles of a Catmull-Clark cage come out rounder [OSD]
} subdiv_triangles;

// How UVs and other face-varying values behave at seams and boundaries. A seam is an edge whose
// faces have different values at one of its ends.
typedef enum subdiv_uv_rule {
    SUBDIV_UV_CORNERS_ONLY,           // smooth, but sharp where one face alone has a value
    SUBDIV_UV_CORNERS_PLUS1,          // also where 3 or more values meet, or 2 values and a crease
    SUBDIV_UV_CORNERS_PLUS2,          // also at ends of seams, and where 2 values meet, one of them
                                      // sharp
    SUBDIV_UV_BOUNDARIES,             // seams and boundaries straight, all else smooth
    SUBDIV_UV_ALL,                    // everything linear
    SUBDIV_UV_NONE                    // smooth everywhere
} subdiv_uv_rule;

// How smooth vertices move: rules to play with, as lectures do. n is the valence, v the vertex, R
// the mean of the midpoints of its edges (Loop: of its neighbours), Q the mean of the face points
// around it. All results follow the rule but UVs, which keep the standard one. SUBDIV_EXACT and
// tessellation refuse a rule that is not the standard one at regular vertices, such as DOO_SABIN.
typedef enum subdiv_vertex_rule {
    SUBDIV_VERTEX_STANDARD,           // Q/n + 2 R/n + (n-3)/n v [CC78]; Loop: [Loop87]
    SUBDIV_VERTEX_AVERAGED,           // Catmull-Clark: Q/4 + R/2 + v/4, the older rule [CC78]
    SUBDIV_VERTEX_DOO_SABIN,          // Catmull-Clark: Q/n + R/n + (n-2)/n v [DS78]
    SUBDIV_VERTEX_WARREN,             // Loop: each neighbour 3/(8n), 3/16 if n = 3 [Warren95]
    SUBDIV_VERTEX_FIVE_EIGHTHS        // Loop: v 5/8, each neighbour 3/(8n), for every n
} subdiv_vertex_rule;

// A rule of your own: sets the weights of v, R and Q (Loop: of v and R) for a valence, 1 or more.
// All weights are 0 before the call. Weights that are not finite after it, or do not sum to 1, are
// an error that names the valence. The library calls your function only while it prepares (1 level
// or more, a limit or SUBDIV_EXACT) or explains: for the regular valence, for those of all vertices
// that may be smooth on some level and, under Catmull-Clark, for the sizes of faces.
typedef void (*subdiv_vertex_weights)(void *user, int valence, double weights[3]);

// A mesh: the cage that goes in and the result that comes out. Zero it, then fill what you have.
// The mesh says what the surface is; the options say what to compute. All numbers are finite, but
// sharpness may be infinite. UVs and colours should be below 2^116 in size, or sums may overflow.
typedef struct subdiv_mesh {
    int    vertex_count;
    float *positions;                 // [3 * vertex_count]   x y z

    int    face_count;
    int    face_size;                 // vertices of every face; or 0: see face_sizes
    int   *face_sizes;                // [face_count]         vertices of each face, at least 3
    int   *face_vertices;             // [sum of sizes]       counted from 0, counter-clockwise
                                      //                      (but see left_handed)

    int    crease_count;
    int   *crease_vertices;           // [2 * crease_count]   the ends of an edge, either order
    float *crease_sharpness;          // [crease_count]       in levels; below 0 is 0, with a
                                      //                      warning; of two entries the later wins
    int    corner_count;
    int   *corner_vertices;           // [corner_count]
    float *corner_sharpness;          // [corner_count]       as crease_sharpness
    int    hole_count;
    int   *holes;                     // [hole_count]         invisible: they only shape the surface

    int    uv_count;
    float *uvs;                       // [2 * uv_count]       u v
    int   *face_uvs;                  // [sum of sizes]       the UV of each face-vertex; -1: none.
                                      //                      Seams are where indices differ, even
                                      //                      of equal UVs: see subdiv_join_values
    float *colors;                    // [3 * vertex_count]   r g b, refined as positions, or NULL
    int    normal_count;              // used only with face_normals
    float *normals;                   // [3 * normal_count]   of length 1 (or 0), or NULL
    int   *face_normals;              // [sum of sizes]       the normal of each face-vertex; NULL:
                                      //                      vertex i has normal i
    int    statement_count;           // OBJ's g, o, s, usemtl and mtllib, as they stand in the file
    int   *statement_faces;           // [statement_count]    the face that each precedes, in order;
                                      //                      face_count: after all faces
    char **statements;                // [statement_count]    "usemtl stone": keyword, blank, text
    int    line_count;                // OBJ's l; of results, only level 0 has lines
    int   *line_sizes;                // [line_count]         vertices of each polyline, at least 2
    int   *line_vertices;             // [sum of sizes]       closed: the last one is the first

    subdiv_scheme    scheme;
    subdiv_boundary  boundary;
    subdiv_creasing  creasing;
    subdiv_triangles triangles;
    subdiv_uv_rule   uv_rule;
    subdiv_vertex_rule vertex_rule;
    subdiv_vertex_weights vertex_weights;     // instead of vertex_rule; or NULL
    void *vertex_user;                // handed to vertex_weights; results keep both

    int  *cage_faces;                 // [face_count]         results only: the face of the cage
                                      //                      that each face is a part of
    void *memory;                     // the library's own, or NULL: the arrays are yours
    int   left_handed;                // faces are clockwise: normals point the other way. Results
                                      // are clockwise and left_handed, too
} subdiv_mesh;

// Receives what went wrong, and where. Zero it once. Every call that gets it overwrites code, place
// and message. Warnings (something odd was skipped) add up, and the first one is kept.
typedef struct subdiv_error {
    int  line;                        // of the OBJ file, from 1; 0 = none
    subdiv_result code;
    int  face, vertex;                // of the mesh, from 0; -1 = none
    char message[256];                // "cage.obj:44: vertex 912 does not exist (...)"
    int  warning_count;
    char warning[256];
} subdiv_error;

// Lends threads to the library: calls job(context, 0) to job(context, count - 1), each once, in any
// order and on any threads, and returns when all have returned. Results do not depend on the order.
typedef void (*subdiv_run)(void *user, void (*job)(void *context, int i), void *context, int count);

// Says how to compute. NULL and {0} are right for most people.
typedef struct subdiv_options {
    int           triangulate;        // Loop: cut larger faces into fans instead of refusing them
    int           keep_holes;         // keep the faces of holes, listed in the result's holes
    int           linear;             // split only: points stay on the cage's faces and edges
    int           limit;              // points on the limit surface, with normals (see >>limit)
    int           no_tags;            // OBJ: write no tags for creases, corners, holes and rules
    subdiv_error *error;
    void         *user;               // handed to SUBDIV_MALLOC, SUBDIV_FREE and run
    subdiv_run    run;                // your threads; NULL: the caller's alone
    int           one_normal;         // limit, tessellation, subdiv_normals: one normal a point
    int           part, part_count;   // stream OBJ: write one part, from 0 to part_count - 1;
                                      // part_count 0: write all
} subdiv_options;

// Returns the text of a result, such as "index out of range". Never NULL.
SUBDIV_DEF const char *subdiv_result_string(subdiv_result result);

// Frees what the library allocated for the mesh and zeroes the struct. Your own arrays stay. A copy
// of the struct has the same memory: free one of the two.
SUBDIV_DEF void subdiv_mesh_free(subdiv_mesh *mesh);

// -------------------------------------------------------------------------------- >>refine
// Refines a cage by this many levels; 0 copies it. fine is in THE ORDER OF THE RESULT, with
// cage_faces filled. Each level cuts a quad or Loop triangle into 4 faces, any other n-gon into n
// quads. The crease and corner lists of fine hold the sharpness that is left, so fine is a cage
// again: refining by 2 levels is refining by 1 level twice. Only what a mesh cannot express is
// lost: holes, unless opt->keep_holes keeps them; an edge along which two faces are wound against
// each other; a face that has an edge twice or a vertex twice in a row; under Loop, two faces on
// the same three vertices; and, at a vertex where two UVs meet under the rules "plus 1" and
// "plus 2", which of their semi-sharp creases faded away first. Lines are left out.
//
// fine must not be the cage itself. A crease between vertices that share no edge is skipped with a
// warning; level 0 keeps it.
SUBDIV_DEF subdiv_result subdiv_refine(subdiv_mesh *fine, const subdiv_mesh *cage, int levels,
                                       const subdiv_options *opt);

// Refines in two steps. subdiv_prepare does all that does not depend on positions; afterwards you
// may free the cage. subdiv_surface_mesh makes the result for positions [3 * cage vertex_count]:
// call it as often as you like, also from several threads at once.
typedef struct subdiv_surface subdiv_surface;
SUBDIV_DEF subdiv_result subdiv_prepare(subdiv_surface **surface, const subdiv_mesh *cage,
                                        int levels, const subdiv_options *opt);
SUBDIV_DEF subdiv_result subdiv_surface_mesh(subdiv_mesh *fine, const subdiv_surface *surface,
                                             const float *positions, const subdiv_options *opt);
SUBDIV_DEF void subdiv_surface_free(subdiv_surface *surface);

// ----------------------------------------------------------------------------- >>animation
// Prepare a surface once and evaluate it often: into arrays of your own, with any number of
// channels (floats) a vertex. Use it for positions in every frame and for all other data of
// vertices. A surface prepared with opt->linear has its points in the same order but interpolates
// linearly: use it for data that must not overshoot. Look up data of faces by cage_faces.

// Return the sizes of the result. face_size is 4, or 3 under Loop; on level 0 it is the cage's.
// All functions that return a number return 0 for a surface that is NULL.
SUBDIV_DEF int subdiv_surface_vertex_count(const subdiv_surface *surface);
SUBDIV_DEF int subdiv_surface_face_count(const subdiv_surface *surface);
SUBDIV_DEF int subdiv_surface_face_size(const subdiv_surface *surface);

// Writes the faces of the result, which do not depend on positions: face_vertices [face_size *
// face_count] and, unless NULL, cage_faces [face_count]. Error ARGUMENT: face_size is 0.
SUBDIV_DEF subdiv_result subdiv_surface_faces(const subdiv_surface *surface, int *face_vertices,
                                              int *cage_faces, const subdiv_options *opt);

// Writes the edges of the cage in THE ORDER OF THE RESULT: ends [2 * edge_count], of each edge the
// lower-numbered vertex first. Under opt->triangulate they are the edges of the triangles. A
// surface of 0 levels has none.
SUBDIV_DEF int subdiv_surface_edge_count(const subdiv_surface *surface);
SUBDIV_DEF void subdiv_surface_edges(const subdiv_surface *surface, int *ends);

// Prepares a surface of face-varying values: as with UVs, each face-vertex has one of value_count
// values, 1 or more; indices [sum of face sizes] says which one, -1 stands for none. rule says what
// happens at seams. You may prepare any number of such surfaces.
//
// subdiv_evaluate takes [value_count] values of any number of channels and makes [vertex_count];
// subdiv_surface_faces gives the indices of values, -1 where there are none. Value i stays value i
// at the first cage vertex that has it. From level 1 on, other vertices that share it have values
// of their own, numbered from value_count, and subdiv_evaluate_faces counts only the cage faces
// that have a value at each vertex. opt->limit changes nothing here.
SUBDIV_DEF subdiv_result subdiv_prepare_face_varying(subdiv_surface **surface,
                                                     const subdiv_mesh *cage, int value_count,
                                                     const int *indices, subdiv_uv_rule rule,
                                                     int levels, const subdiv_options *opt);

// Finds equal values: firsts [value_count] is, for each of values [channels * value_count], the
// number of the first one that equals it in all channels; its own, if it is not a number. If your
// UVs come without indices, one for each face-vertex, take firsts as face_uvs: then seams are where
// values differ.
SUBDIV_DEF subdiv_result subdiv_join_values(int *firsts, int channels, int value_count,
                                            const float *values, const subdiv_options *opt);

// Returns the bytes of scratch memory that evaluating this many channels takes. Up to level 4 the
// size grows with the result; from there on it only doubles with each level, as the number of
// points on the cage's edges does. SIZE_MAX: more than the machine can address.
SUBDIV_DEF size_t subdiv_scratch_size(const subdiv_surface *surface, int channels);

// Evaluates every point of the result: out [out_stride * vertex_count] from in [in_stride * cage
// vertex_count]. Strides are in floats, 0 stands for channels; other floats of out stay as they
// are. scratch has subdiv_scratch_size bytes, aligned as float: then nothing is allocated. If it is
// NULL, the call allocates it. Values should be below 2^116 in size, or sums may overflow.
SUBDIV_DEF subdiv_result subdiv_evaluate(const subdiv_surface *surface, int channels,
                                         const float *in, int in_stride,
                                         float *out, int out_stride,
                                         void *scratch, const subdiv_options *opt);

// Evaluates in pieces. First, evaluate_begin fills scratch. Then each call of evaluate_faces makes
// the points that belong to cage faces first_face to first_face + face_count - 1 (under
// opt->triangulate, of the triangles), in any order and on any threads. All faces together make
// each point once, with the same bits as subdiv_evaluate. Error INDEX: no such faces or points.
//
// Only points first_point to first_point + point_count - 1 are written, the first one to out[0], so
// that a part of the result needs memory for that part alone. The points inside cage face f are
// first_inside(f) to first_inside(f + 1) - 1; points of vertices and edges precede first_inside(0).
SUBDIV_DEF subdiv_result subdiv_evaluate_begin(const subdiv_surface *surface, int channels,
                                               const float *in, int in_stride,
                                               void *scratch, const subdiv_options *opt);
SUBDIV_DEF subdiv_result subdiv_evaluate_faces(const subdiv_surface *surface, int channels,
                                               const void *scratch,
                                               int first_face, int face_count,
                                               int first_point, int point_count,
                                               float *out, int out_stride,
                                               const subdiv_options *opt);
SUBDIV_DEF int subdiv_surface_cage_face_count(const subdiv_surface *surface);
SUBDIV_DEF int subdiv_first_inside(const subdiv_surface *surface, int cage_face);

// --------------------------------------------------------------------------------- >>limit
// With opt->limit, subdiv_refine moves every point of the result to the limit surface and gives
// fine its unit normals [HKD93] [Loop87] [HDD94]. A surface prepared with opt->limit makes such
// meshes, and every evaluation of it gives limit values, of any channels. UVs of such a mesh stay
// those of the refined mesh. Do not use it as a cage: its points belong to an endlessly fine mesh.
//
// Every level, >>exact and >>tessellation give the same points and normals, as there is one limit
// surface: sharpness that is left on the last level fades on the way to it.
//
// A point has one normal and two tangents. On a crease they belong to the side of the first face
// there that is no hole. Each other side of an infinitely sharp crease has a normal of its own, for
// shading that shows the edge, unless opt->one_normal is set. If there are such sides, fine has
// face_normals: normals 0 to vertex_count - 1 are those of the points, the others follow. (On a
// linear surface each edge of the cage is a crease.)
//
// Some vertices have no tangent plane. For shading, the normal of some of these lies between those
// around: at a corner with more than 2 faces (Loop: 3) between two creases, or without creases; at
// a crease with more than 4 faces (Loop: 6) on that side; and between two quads back to back. The
// normal is 0 without faces, between two triangles back to back, where a tangent is 0 or both are
// parallel (to within rounding), and where the vertex rule makes a spike, as "five-eighths" does at
// valence 3. Error ARGUMENT: the vertex_weights of some valence lead to no limit.

// Where to write the results: arrays with this many floats a point, or NULL.
typedef struct subdiv_limit {
    float *positions;                 // [3]  x y z
    float *normals;                   // [3]  of length 1, or 0
    float *tangents;                  // [6]  two, of any direction and length in the tangent plane;
                                      //      the first x the second is along the normal, or
                                      //      against that of a left-handed cage
    int    stride;                    // floats from point to point in all four; 0: they are dense
    float *sides;                     // [3]  normals from number vertex_count on: of other sides of
                                      //      creases, whatever the range of points
} subdiv_limit;

// Returns the number of normals: one for each point, and those of the other sides of creases. 0:
// the surface was prepared without opt->limit.
SUBDIV_DEF int subdiv_surface_normal_count(const subdiv_surface *surface);

// Writes the normal of each face-vertex of the result: face_normals [sum of face sizes].
SUBDIV_DEF subdiv_result subdiv_surface_face_normals(const subdiv_surface *surface,
                                                     int *face_normals, const subdiv_options *opt);

// Evaluate limit positions, normals and tangents from positions in [in_stride * cage vertex_count]:
// all at once, as subdiv_evaluate does, or in pieces, after subdiv_evaluate_begin for 3 channels.
// Error ARGUMENT: the surface was prepared without opt->limit.
SUBDIV_DEF subdiv_result subdiv_evaluate_limit(const subdiv_surface *surface,
                                               const float *in, int in_stride,
                                               const subdiv_limit *out,
                                               void *scratch, const subdiv_options *opt);
SUBDIV_DEF subdiv_result subdiv_evaluate_limit_faces(const subdiv_surface *surface,
                                                     const void *scratch,
                                                     int first_face, int face_count,
                                                     int first_point, int point_count,
                                                     const subdiv_limit *out,
                                                     const subdiv_options *opt);

// Gives any mesh normals: at each vertex the sum of its faces' normals, weighted by their areas and
// scaled to length 1; or 0 if there is none. Each side of an infinitely sharp crease, and each fan
// of faces at non-manifold places, has its own, as in a limit, unless opt->one_normal is set, which
// is faster. Arrays that have the room are filled, else the mesh gets new ones. Error TOO_LARGE:
// more than 2^30 face-vertices, without opt->one_normal.
SUBDIV_DEF subdiv_result subdiv_normals(subdiv_mesh *mesh, const subdiv_options *opt);

// Gives a mesh such normals, whatever opt->one_normal says. Splits them also where the normals of
// an edge's two faces differ by more than this many degrees, 0 to 180: see subdiv_crease_by_angle.
SUBDIV_DEF subdiv_result subdiv_normals_by_angle(subdiv_mesh *mesh, float degrees,
                                                 const subdiv_options *opt);

// ------------------------------------------------------------------------------- >>buffers
// Makes what a GPU draws of a mesh: triangles, and vertices as you lay them out, split where the
// surface is creased or UVs have a seam. Make a buffer once; then fill its vertices once from the
// mesh and, if it moves, in each frame from a surface:
//
//     subdiv_surface_mesh(&mesh, surface, positions, &opt);   // prepared with opt.limit
//     subdiv_make_buffer(&buffer, &mesh, 4, &opt);
//     float *data = malloc(8 * sizeof(float) * buffer.vertex_count);
//     subdiv_vertices out = {0};
//     out.positions = data;  out.normals = data + 3;  out.stride = 8;
//     if (mesh.uv_count) out.uvs = data + 6;
//     subdiv_fill_buffer(&buffer, &mesh, &out, &opt);
//     subdiv_evaluate_buffer(&buffer, surface, moved, &out, scratch, &opt);       // each frame
//
// Tangents for normal maps, if you need them, come from another surface of the cage, prepared for
// SUBDIV_EXACT: subdiv_tangents_at writes them with the same stride. The location of vertex i is
// that of face-vertex buffer.face_vertices[i]: see subdiv_surface_locations.
typedef struct subdiv_buffer {
    int    vertex_count;              // vertex i is point i of the mesh; copies of points follow
    int    point_count, normal_count; // of the mesh; vertex i < normal_count has normal i
    int   *points;                    // [vertex_count]  the point of each vertex,
    int   *normals;                   // [vertex_count]  its normal
    int   *uvs;                       // [vertex_count]  and its UV, or -1
    int    index_count;               // 3 for each triangle
    int    index_size;                // bytes of an index: 2 or 4
    void  *indices;                   // [index_count]   unsigned short or int
    void  *memory;                    // the library's own
    int   *face_vertices;             // [vertex_count]  a face-vertex that has it; 0 if none has
} subdiv_buffer;

// Where to write the vertices: arrays with this many floats a vertex, or NULL.
typedef struct subdiv_vertices {
    float *positions;                 // [3]  x y z
    float *normals;                   // [3]
    float *uvs;                       // [2]  0 0 without a UV
    float *colors;                    // [3]  r g b
    int    stride;                    // floats from vertex to vertex in all of them; 0: dense
} subdiv_vertices;

// Makes the buffer of a mesh: a result, or any mesh without face_normals or with those of
// subdiv_normals. Cuts faces into fans around their first vertex. Turns triangles of a left-handed
// mesh round, so that all are counter-clockwise. index_size is 2 or 4. Error TOO_LARGE: also more
// than 65536 vertices with 2 bytes.
SUBDIV_DEF subdiv_result subdiv_make_buffer(subdiv_buffer *buffer, const subdiv_mesh *mesh,
                                            int index_size, const subdiv_options *opt);
SUBDIV_DEF void subdiv_buffer_free(subdiv_buffer *buffer);

// Fills the vertices from the mesh that the buffer was made of. Error ARGUMENT: the mesh does not
// have what is to be written.
SUBDIV_DEF subdiv_result subdiv_fill_buffer(const subdiv_buffer *buffer, const subdiv_mesh *mesh,
                                            const subdiv_vertices *out, const subdiv_options *opt);

// Fills positions and normals from a surface whose mesh the buffer was made of, for positions
// [3 * cage vertex_count]; leaves UVs and colours as they are. scratch is as in subdiv_evaluate,
// for 3 channels: with it, nothing is allocated. Error ARGUMENT: the surface has other points or
// normals than the buffer, or was prepared without opt->limit and out->normals is not NULL.
SUBDIV_DEF subdiv_result subdiv_evaluate_buffer(const subdiv_buffer *buffer,
                                                const subdiv_surface *surface,
                                                const float *positions, const subdiv_vertices *out,
                                                void *scratch, const subdiv_options *opt);

// --------------------------------------------------------------------------------- >>exact
// Evaluates the limit surface at any point of any face: values, derivatives and normals. They are
// exact, also at and arbitrarily near extraordinary vertices, creases and boundaries. A regular
// face is a bicubic B-spline, under Loop a quartic box spline [Stam98]. Error ARGUMENT: the vertex
// rule makes regular faces anything else, or leaves a vertex without a limit.
//
//     subdiv_prepare(&surface, &cage, SUBDIV_EXACT, &opt);
//     void *scratch = malloc(subdiv_scratch_size(surface, 3));
//     subdiv_evaluate_begin(surface, 3, cage.positions, 0, scratch, &opt);
//     subdiv_location middle = { 7, 0, 0.5f, 0.5f };                      // of face 7
//     subdiv_derivatives out = {0};
//     out.points = point;  out.normals = normal;                          // float [3] each
//     subdiv_evaluate_at(surface, 3, scratch, 1, &middle, &out, &opt);
//
// u and v on a quad and on a triangle under Loop; vertex 0 is at u = v = 0:
//
//     3-----2       2             Any other n-gon is n quads, one at each vertex i. The quad's
//     |     |       | \           vertices 0 to 3 are vertex i, the middle of the edge that leads
//   v |     |     v |   \         on from there, the centre, and the middle of the edge before:
//     0-----1       0-----1       counter-clockwise.
//        u             u
#define SUBDIV_EXACT (-1)             // as levels of subdiv_prepare and _prepare_face_varying

typedef struct subdiv_location {
    int   face, corner;               // from 0; corner i: on the quad at vertex i of an n-gon; in
    float u, v;                       // other faces 0. 0 <= u, v <= 1; Loop: u + v <= 1
} subdiv_location;

// Tells where the points [vertex_count] and face-vertices [sum of face sizes] of a result are; one
// may be NULL. A face-vertex is on the face of the cage that its face is a part of. A point is on
// the first face around it, on a hole only if there is no other face, and on face -1 if no face has
// a surface; on level 0 it is on the first face, hole or not. With opt->keep_holes, faces that
// boundary "none" drops have face-vertices, too, though subdiv_evaluate_at gives zeros there. Error
// ARGUMENT: the surface is one of face-varying values, or prepared for SUBDIV_EXACT.
SUBDIV_DEF subdiv_result subdiv_surface_locations(const subdiv_surface *surface,
                                                  subdiv_location *points,
                                                  subdiv_location *face_vertices,
                                                  const subdiv_options *opt);

#ifndef SUBDIV_NO_EXACT
// Where to write the results: arrays with all channels of each location, or NULL.
typedef struct subdiv_derivatives {
    float *points, *du, *dv, *duu, *duv, *dvv;
    float *normals;                   // [3] of length 1, or 0: of the first three channels
    int    stride;                    // floats from location to location in all; 0: they are dense
} subdiv_derivatives;

// Evaluates count locations of a surface prepared for SUBDIV_EXACT, after subdiv_evaluate_begin. It
// only reads scratch: call it as often as you like and on any threads. Faces are those of the cage
// (under opt->triangulate: triangles), holes included. Faces that boundary "none" drops, and faces
// without face-varying values, have no surface: they give zeros.
//
// Points that faces share have the same bits on each of them: at a vertex; along an edge, where one
// face has t and the other 1 - t (closer to a vertex than t = 0.001, only if 1 - t is exact); and,
// in an n-gon, along the edges and at the vertices between its quads.
//
// Derivatives are with respect to u and v; on a crease they belong to the face's side. Beyond the
// range of floats they are not finite. The normal is along du x dv; against it if the cage is
// left-handed. At some vertices, results differ from those close by:
//
// * Extraordinary: close by, du and dv go to 0 or infinity like (2 l)^j at u = 2^-j, where l is the
//   subdominant eigenvalue. At the vertex this factor is left out: du x dv is along the normal. The
//   second derivatives are 0.
// * Infinitely sharp corner or dart: as above, and the lengths of du and dv mean nothing.
// * 4 faces (Loop: 6) on a side of a crease: normals close by tend to that of the vertex, but
//   slowly; with more faces they do not (see >>limit).
//
// Errors: ARGUMENT if normals have fewer than 3 channels, the surface was not prepared for
// SUBDIV_EXACT or subdiv_evaluate_begin has not filled scratch for it. Three errors may come after
// part of out has been written: INDEX for a location that does not exist, ARGUMENT for one outside
// its face by more than rounding, and MEMORY, as samples close to an extraordinary vertex take
// some: one call for many of them shares most of the work.
SUBDIV_DEF subdiv_result subdiv_evaluate_at(const subdiv_surface *surface, int channels,
                                            const void *scratch, int count,
                                            const subdiv_location *locations,
                                            const subdiv_derivatives *out,
                                            const subdiv_options *opt);

// Makes tangents for normal maps at count locations, after subdiv_evaluate_begin for 3 channels:
// tangents [stride * count], stride 0 stands for 4. x y z is the direction in which the first of
// the cage's UVs grows and the second stays, at right angles to the normal and of length 1. The
// second one grows along w times normal x tangent, where w is 1 or -1. All four are 0 where normal
// or UVs give no direction. Where one side of the UVs mirrors the other, let each have indices of
// its own: vertices that both share have no direction or, under the rule "all", that of one side.
// Each call evaluates the UVs of the whole cage: ask for many locations at once. Errors: as
// subdiv_evaluate_at, and ARGUMENT if the cage has no UVs.
SUBDIV_DEF subdiv_result subdiv_tangents_at(const subdiv_surface *surface, const void *scratch,
                                            int count, const subdiv_location *locations,
                                            float *tangents, int stride,
                                            const subdiv_options *opt);
#endif // SUBDIV_NO_EXACT

// ------------------------------------------------------------------------------ >>stencils
// Writes points of a surface as weighted sums of the cage's vertices, in plain arrays, for GPUs,
// solvers and fitting:
//
//     point i = sum of weights[k] * (vertex indices[k])     k from offsets[i] to offsets[i + 1] - 1
//
// The weights of a point add up to 1, those of a derivative to 0, to within 1e-6 of the largest.
// Weights no larger than the rounding of others are left out. On a surface of face-varying values,
// indices are numbers of values.
typedef struct subdiv_stencils {
    int     count;
    size_t *offsets;                  // [count + 1]
    int    *indices;                  // [offsets[count]]  rising in each stencil
    float  *weights;                  // [offsets[count]]  of the point
    float  *du, *dv;                  // [offsets[count]]  of its two tangents, or NULL
    void   *memory;                   // the library's own, one block
    float  *duu, *duv, *dvv;          // [offsets[count]]  of its second derivatives, or NULL
} subdiv_stencils;

// Makes the stencils of points first_point to first_point + point_count - 1 of the result. If the
// surface was prepared with opt->limit, these are limit points, with tangents. Each call looks at
// the whole surface and takes 30 to 100 bytes of scratch memory for each point of the whole result,
// besides the stencils: ask for many points at once. Error INDEX: no such points.
SUBDIV_DEF subdiv_result subdiv_refined_stencils(subdiv_stencils *stencils,
                                                 const subdiv_surface *surface,
                                                 int first_point, int point_count,
                                                 const subdiv_options *opt);

#ifndef SUBDIV_NO_EXACT
// Makes the stencils of all that subdiv_evaluate_at gives for count locations, but for normals.
// Stencils of a face without a surface are empty. Errors: as subdiv_evaluate_at.
SUBDIV_DEF subdiv_result subdiv_stencils_at(subdiv_stencils *stencils,
                                            const subdiv_surface *surface, int count,
                                            const subdiv_location *locations,
                                            const subdiv_options *opt);
#endif // SUBDIV_NO_EXACT

// Frees what the library allocated and zeroes the struct.
SUBDIV_DEF void subdiv_stencils_free(subdiv_stencils *stencils);

#ifndef SUBDIV_NO_TOOLS
typedef enum subdiv_point_kind {
    SUBDIV_VERTEX_POINT, SUBDIV_EDGE_POINT, SUBDIV_FACE_POINT
} subdiv_point_kind;

typedef enum subdiv_rule { SUBDIV_SMOOTH, SUBDIV_DART, SUBDIV_CREASE, SUBDIV_CORNER } subdiv_rule;

typedef enum subdiv_reason {          // why a rule holds
    SUBDIV_NOTHING_SHARP,
    SUBDIV_LINEAR,                    // nothing is smoothed, so vertices stay and edges are halved
    SUBDIV_NO_FACES,
    SUBDIV_BOUNDARY,                  // of a vertex: it is on a curve of boundary edges
    SUBDIV_NONMANIFOLD,
    SUBDIV_SINGLE_FACE,               // a vertex with one face, under boundary "edge and corner"
    SUBDIV_OWN_SHARPNESS,             // the edge or vertex is in the cage's lists
    SUBDIV_SHARP_EDGES                // that meet at the vertex
} subdiv_reason;

// How a point of the mesh refined once is made.
typedef struct subdiv_point {
    subdiv_point_kind kind;
    int   parent;                     // the number of the cage's vertex, edge or face
    int   ends[2];                    // of the edge; of a vertex, the other ends of its first two
                                      // sharp edges; -1 where there is none
    int   faces[2];                   // the first two of an edge; -1 where there is none
    int   valence;                    // faces at the vertex, or of the edge; vertices of the face
    int   sharp_edges;                // at the vertex
    float sharpness;                  // of the edge or vertex itself, at most SUBDIV_INFINITE
    subdiv_rule   rule, next;         // now and on the next level
    subdiv_reason reason;
    double weight;                    // of the rule in the mask; the rest is that of next
} subdiv_point;

typedef struct subdiv_explanation {
    int             count;
    subdiv_point   *points;           // [count]
    subdiv_stencils masks;            // of the cage's vertices in each point
    void           *memory;           // the library's own
} subdiv_explanation;

// Explains all points of the mesh refined once, as data for pictures and programs, in THE ORDER OF
// THE RESULT. For the points of a later level let the cage be the mesh of the level before.
SUBDIV_DEF subdiv_result subdiv_explain_points(subdiv_explanation *explanation,
                                               const subdiv_mesh *cage, const subdiv_options *opt);
SUBDIV_DEF void subdiv_explanation_free(subdiv_explanation *explanation);

// Writes the same about one point as text for the classroom: what it is, which rule holds there and
// why, the formula, the paper and the mask, in fractions where possible. The text has lines of up
// to 80 characters and ends with 0; 2000 bytes are enough except for large faces and valences.
// Errors leave text empty: INDEX for no such point, TOO_LARGE if the text does not fit, ARGUMENT if
// capacity is 0.
SUBDIV_DEF subdiv_result subdiv_explain(char *text, size_t capacity, const subdiv_mesh *cage,
                                        int point, const subdiv_options *opt);
#endif // SUBDIV_NO_TOOLS

#ifndef SUBDIV_NO_EXACT
// --------------------------------------------------------------------------- >>tessellation
// Makes a mesh of the limit surface. You choose the rate of each edge of the cage: the number of
// pieces that it is cut into. Faces share the points of their edges, so there are no cracks. To
// begin with, set rate in a subdiv_tessellation to 5 and leave the rest 0.

// Returns the rate of an edge, or 0 for no answer. a, middle and b [3] are points of the edge on
// the limit surface, a at its lower-numbered vertex. The library calls it once for each edge that
// has a surface, in order, on the caller's thread.
typedef int (*subdiv_edge_rate)(void *user, int edge, const float *a, const float *middle,
                                const float *b);

// Says how to tessellate. Zero it, fill what you want; NULL and 0 are no answers. A rate is the
// first answer in its list:
//     an edge    edge_rate, edge_rates, the largest rate of its faces in face_rates, rate, 1
//     a face     face_rates, the rates of its edges
typedef struct subdiv_tessellation {
    int  rate;                        // of all edges
    const int *edge_rates;            // [edge_count of the cage], as in subdiv_surface_edges
    const int *face_rates;            // [face_count of the cage]
    subdiv_edge_rate edge_rate;
    void *user;                       // handed to edge_rate
    int   triangles;                  // cut quads, from their first vertex to their third
} subdiv_tessellation;

// Tessellates a cage. fine gets limit positions, normals, cage_faces, statements, and UVs (seams
// respected) and colours on their own limit. Holes are treated as by subdiv_refine. Do not use fine
// as a cage: it has no creases and corners. fine must not be the cage itself. how may be NULL.
//
// Points are in THE ORDER OF THE RESULT, with rate - 1 points inside each edge. The points inside a
// face are those inside a grid, row by row. A rate of the face replaces c and r:
//
//     a quad                   c x r pieces: c the larger rate of edges 0-1, 2-3; r of the others
//     a triangle under Loop    r pieces a side: r the largest rate of its edges
//     any other polygon        a quad at each vertex, with r / 2 pieces a side, rounded up
//
// If all edges are cut like the sides of the grid, the faces are those of the grid. So a rate of
// 2^k everywhere makes the faces of subdiv_refine by k levels with opt->limit and, where there is a
// surface, the same points and normals, to rounding. (Polygons that are not quads need an even rate
// for this; at rate 1 they are fans around their centres.)
//
// Otherwise the grid has at least 2 pieces a side, in a triangle 3, and loses its outermost faces.
// Strips join the faces that remain with each edge and come after them, from edge 0-1 on: triangles
// and, where two pieces are opposite, quads. A quad with rate 1 on two opposite edges has
// no points inside, unless its face rate asks for some: its other two edges are joined directly.
// Rates that are far apart make thin triangles and, at curved edges, some that are folded over.
//
//     o---o---o---o---o       a quad of rates 3, 4, 4, 4: the 2 x 2 inner quads of 4 x 4; at edge
//     | \ |   |   | / |       0-1, below, 5 triangles; at each other edge a triangle, 2 quads and a
//     o---+---+---+---o       triangle
//     |   |   |   |   |
//     o---+---+---+---o
//     |   |   |   |   |
//     o---+---+---+---o
//     | / \ /   \ / \ |
//     o----o-----o----o
//
// On a crease, a normal belongs to the side that >>limit names. Where boundary "none" drops the
// surface, only vertices are left.
SUBDIV_DEF subdiv_result subdiv_tessellate(subdiv_mesh *fine, const subdiv_mesh *cage,
                                           const subdiv_tessellation *how,
                                           const subdiv_options *opt);

// Tessellates a surface prepared for SUBDIV_EXACT, as often as you like, with positions
// [3 * cage vertex_count]. Error ARGUMENT: it was prepared for something else.
SUBDIV_DEF subdiv_result subdiv_surface_tessellate(subdiv_mesh *fine,
                                                   const subdiv_surface *surface,
                                                   const float *positions,
                                                   const subdiv_tessellation *how,
                                                   const subdiv_options *opt);
#endif // SUBDIV_NO_EXACT

// -------------------------------------------------------------------------------- >>curves
// Refines a curve: points, each joined to the next. Refined again and again, it tends to a spline.
typedef enum subdiv_curve_rule {
    SUBDIV_CURVE_B_SPLINE,            // cubic, as boundaries and creases are: a vertex moves to
                                      // (a + 6v + b) / 8, an edge gets a point (a + b) / 2 [HDD94]
    SUBDIV_CURVE_CHAIKIN              // quadratic: a vertex becomes two, (a + 3v) / 4 and
                                      // (3v + b) / 4, which cut its corner off [Chaikin74]
} subdiv_curve_rule;

typedef enum subdiv_curve_ends {      // each level makes of n points       B-spline    Chaikin
    SUBDIV_ENDS_KEPT,                 // open: the first and last stay      2n - 1      2n
    SUBDIV_ENDS_CUT,                  // open: the outermost are left out   2n - 3      2n - 2
    SUBDIV_ENDS_CLOSED                // the last is joined to the first    2n          2n
} subdiv_curve_ends;

// Returns how many points a curve has after this many levels; 0 if subdiv_curve refuses them.
SUBDIV_DEF int subdiv_curve_point_count(subdiv_curve_rule rule, subdiv_curve_ends ends,
                                        int point_count, int levels);

// Refines a curve by this many levels: out [out_stride * subdiv_curve_point_count] from in
// [in_stride * point_count], with channels and strides as subdiv_evaluate has them. out may be in,
// with the same stride, but may not overlap it otherwise. Nothing is allocated. With opt->limit,
// points then move to the spline: to (a + 4v + b) / 6, under Chaikin to (a + 6v + b) / 8. The first
// and the last point of an open curve stay, so cut ends are not on the spline. The boundary of a
// refined surface is such a curve, with the same bits unless the cage is small and far from 0.
// Errors: EMPTY, TOO_LARGE; ARGUMENT also if the ends of fewer than 3 points are to be cut.
SUBDIV_DEF subdiv_result subdiv_curve(subdiv_curve_rule rule, subdiv_curve_ends ends, int levels,
                                      int channels, int point_count, const float *in,
                                      int in_stride, float *out, int out_stride,
                                      const subdiv_options *opt);

#ifndef SUBDIV_NO_TOOLS
// ------------------------------------------------------------------------------- >>creases
// Add edges to the mesh's crease list. The functions named crease_by find them: an edge that is
// listed already keeps the larger sharpness; boundary and non-manifold edges, which are sharp by
// themselves, are never added. Other entries stay. A list that changes is replaced by a new one. To
// try several angles, use copies of the struct with memory = NULL: freeing a copy then frees its
// new list alone. Error NOT_FINITE: also if sharpness is not a number.

// Finds edges where the normals of the two faces differ by more than this many degrees, 0 to 180;
// up to 0.001 degrees more is taken for rounding. Faces without area have no normal, so no creases.
SUBDIV_DEF subdiv_result subdiv_crease_by_angle(subdiv_mesh *mesh, float degrees, float sharpness,
                                                const subdiv_options *opt);

// Finds edges whose two faces are not in the same smoothing group, by the mesh's statements "s 1",
// "s off". Under "s off" or "s 0", and before the first such statement, a face is in no group: all
// its edges are found. A mesh without any such statement gets a warning and no creases.
SUBDIV_DEF subdiv_result subdiv_crease_by_smoothing_groups(subdiv_mesh *mesh, float sharpness,
                                                           const subdiv_options *opt);

// Finds edges where the UVs of the two faces differ at an end, or one face has none there. Equal
// values with different indices do not differ. A mesh without UVs gets a warning and no creases.
SUBDIV_DEF subdiv_result subdiv_crease_by_uv_seams(subdiv_mesh *mesh, float sharpness,
                                                   const subdiv_options *opt);

// Adds chains of edges, as USD has them, behind the list, so that they win over earlier entries.
// lengths [chain_count]: how many vertices each has, 2 or more; vertices [sum of lengths], chain by
// chain; sharpness [sharpness_count]: one for each chain, or one for each edge of all chains. An
// edge that no face has is skipped with a warning. Errors and warnings name the chain.
SUBDIV_DEF subdiv_result subdiv_crease_chains(subdiv_mesh *mesh, int chain_count,
                                              const int *lengths, const int *vertices,
                                              int sharpness_count, const float *sharpness,
                                              const subdiv_options *opt);

// ------------------------------------------------------------------------------- >>inspect
// The parts of a cage.
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
    int crease_count;                    // edges that the crease list makes sharp
    int infinite_crease_count;           // edges that it makes sharp forever
    int corner_count;                    // vertices that the corner list makes sharp
    int hole_count;                      // faces marked as holes
    int component_count;                 // pieces that share no vertex, without isolated vertices
} subdiv_info;

// Counts what a cage is made of. A Loop cage may hold any faces.
SUBDIV_DEF subdiv_result subdiv_inspect(subdiv_info *info, const subdiv_mesh *mesh,
                                        const subdiv_options *opt);

// Oddities of a mesh: allowed, but seldom meant.
typedef enum subdiv_oddity {
    SUBDIV_ODD_NONMANIFOLD_EDGE,         // more than two faces at edge vertex - other_vertex
    SUBDIV_ODD_FLIPPED_FACE,             // face and other_face run the same way along this edge
    SUBDIV_ODD_NONMANIFOLD_VERTEX,       // face and other_face are in different fans at vertex;
                                         // reported only if no edge there is non-manifold
    SUBDIV_ODD_DUPLICATE_FACE,           // earlier other_face has the same vertices in any order
    SUBDIV_ODD_REPEATED_VERTEX,          // face has vertex, or edge vertex - other_vertex, twice
    SUBDIV_ODD_NO_AREA,                  // face is no thicker than rounding of its coordinates
    SUBDIV_ODD_UNUSED_VERTEX,            // no face has vertex
    SUBDIV_ODD_SAME_PLACE,               // vertex is exactly where the earlier other_vertex is:
                                         // faces that seem to touch may be apart
    SUBDIV_ODD_STRAY_CREASE,             // a crease from vertex to other_vertex: no face's edge
    SUBDIV_ODD_LISTED_TWICE,             // a crease, corner or hole; the later entry counts
    SUBDIV_ODD_PARTIAL_UVS,              // face has UVs at some of its vertices only
    SUBDIV_ODDITY_COUNT
} subdiv_oddity;

typedef struct subdiv_finding {
    subdiv_oddity kind;
    int face, other_face;                // from 0; -1: none
    int vertex, other_vertex;
    const char *text;                    // "edge 3-7 has 3 faces: 1, 5, 9"; valid only in report
} subdiv_finding;

typedef void (*subdiv_report)(void *user, const subdiv_finding *finding);

// Reports oddities kind by kind, in the order above, and counts the kinds in counts
// [SUBDIV_ODDITY_COUNT]. Either of report and counts may be NULL. The time is proportional to the
// mesh, however odd it is. A mesh that subdiv_refine refuses is an error here, too, and nothing is
// reported; but a Loop cage may hold any faces.
SUBDIV_DEF subdiv_result subdiv_check(int *counts, const subdiv_mesh *mesh, subdiv_report report,
                                      void *user, const subdiv_options *opt);
#endif // SUBDIV_NO_TOOLS

#ifndef SUBDIV_NO_OBJ
// ----------------------------------------------------------------------------------- >>obj
// Reads Wavefront OBJ, block by block, never going back:
//
//     v x y z [w], v x y z r g b [a]       w and a are ignored; vertices without a colour are white
//                                          if others have one
//     vt u [v [w]]                         v is 0 if it is missing, w is ignored
//     f v/vt/vn ...                        in all forms, with negative indices, before or after
//                                          what it names; any number of vertices
//     l v/vt ...                           a polyline; vt is ignored
//     g o s usemtl mtllib                  kept as they stand, with the face that follows; # begins
//                                          a comment only between blanks (not in "Material #25")
//     t name ints/floats/strings ...       OpenSubdiv's tags, counted from 0:
//
//     t crease 2/1/0 v0 v1 sharpness       t hole 1/0/0 face         t smoothtriangles 0/0/1 smooth
//     t corner 1/1/0 v sharpness           t creasemethod 0/0/1 chaikin
//     t interpolateboundary 1/0/0 k        k: 0 none, 1 edge and corner, 2 edge
//     t facevaryinginterpolateboundary 1/0/0 k      k: 0 none, 1 to 3 corners, 4 boundaries, 5 all
//
// The mesh has UVs if any face names a vt at each of its vertices. Other faces then have the UV -1,
// with one warning for faces that name some vt, and one for faces that name none. Normals are
// ignored. Faces of fewer than three vertices, lines of fewer than two and tags that make no sense
// are skipped with a warning each. One warning counts the points (p), one the free-form statements,
// one the unknown ones. Anything else that would change the mesh is an error that names line and
// token. Errors: IO, SYNTAX, INDEX, NOT_FINITE, EMPTY, TOO_LARGE.
SUBDIV_DEF subdiv_result subdiv_load_obj_memory(subdiv_mesh *mesh, const void *text, size_t size,
                                                const subdiv_options *opt);

// Stores up to size bytes, more than 0, and returns how many; 0 at the end, (size_t)-1 on failure.
typedef size_t (*subdiv_read)(void *user, void *bytes, size_t size);
SUBDIV_DEF subdiv_result subdiv_load_obj_callback(subdiv_mesh *mesh, subdiv_read read, void *user,
                                                  const subdiv_options *opt);

// Writes v (with colours), vt and vn, then f with the statements between, then l, then tags unless
// there is nothing but defaults. Faces without UVs have no vt. Faces of a left-handed mesh are
// turned round, as those of OBJ are counter-clockwise; their first vertex stays the first. Numbers
// have the fewest digits that read back as the same float, in any locale. Error IO.
//
// To memory: *size becomes the size of the whole text, without a terminating 0. Call with capacity
// 0 to get the size alone; any other capacity that is too small is error TOO_LARGE, and text holds
// the beginning.
SUBDIV_DEF subdiv_result subdiv_save_obj_memory(const subdiv_mesh *mesh, void *text,
                                                size_t capacity, size_t *size,
                                                const subdiv_options *opt);

// Takes size bytes and returns how many it kept; fewer than size is a failure.
typedef size_t (*subdiv_write)(void *user, const void *bytes, size_t size);
SUBDIV_DEF subdiv_result subdiv_save_obj_callback(const subdiv_mesh *mesh, subdiv_write write,
                                                  void *user, const subdiv_options *opt);

// Refines and writes at once, cage face by cage face: the text that subdiv_save_obj writes of
// subdiv_surface_mesh. From level 1 on, the mesh is never in memory as a whole. If opt->part_count
// is set, writes only part opt->part. All parts, joined in order, are the whole text: several
// processes or machines can share the work, each with a surface of the whole cage. Parts take about
// equally long. Level 0 is all in the first part. Error ARGUMENT: there is no such part.
SUBDIV_DEF subdiv_result subdiv_stream_obj_callback(const subdiv_surface *surface,
                                                    const float *positions, subdiv_write write,
                                                    void *user, const subdiv_options *opt);

// Files. Paths are UTF-8, on Windows too. Saving replaces a regular file when the new one is whole.
// Until then the new one is beside it: fine.obj.0.tmp, or the next free number. An error removes
// the new one and leaves the old as it was. Permissions stay. Devices, pipes, links, and files in
// folders that take no new ones, are written in place: an error may leave a part of the text.
#ifndef SUBDIV_NO_STDIO
SUBDIV_DEF subdiv_result subdiv_load_obj(subdiv_mesh *mesh, const char *path,
                                         const subdiv_options *opt);
SUBDIV_DEF subdiv_result subdiv_save_obj(const subdiv_mesh *mesh, const char *path,
                                         const subdiv_options *opt);
SUBDIV_DEF subdiv_result subdiv_stream_obj(const subdiv_surface *surface, const float *positions,
                                           const char *path, const subdiv_options *opt);
#endif
#endif // SUBDIV_NO_OBJ

// ------------------------------------------ End of the public API. You can stop reading here.
#endif // SUBDIV_H

#if defined(SUBDIV_IMPLEMENTATION) && !defined(SUBDIV_IMPLEMENTED)
#define SUBDIV_IMPLEMENTED

// ------------------------------------------------------------------------------ >>platform

// Silences the warnings of C++ about casts that C needs.
#if defined(__GNUC__) && defined(__cplusplus)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#ifndef __clang__
#pragma GCC diagnostic ignored "-Wuseless-cast"
#endif
#endif

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>
#ifndef SUBDIV_NO_STDIO
#include <errno.h>
#include <stdio.h>
#if (defined(__GNUC__) || defined(__TINYC__)) && (defined(__unix__) || defined(__APPLE__))
#include <sys/stat.h>
#define SDV_POSIX
#endif
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

// Forces functions inline that inner loops call for each point. Their speed then does not depend on
// the compiler's judgement, and constant arguments make each call a loop of its own kind.
#if defined(__GNUC__)
#define SDV_INLINE static inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define SDV_INLINE static __forceinline
#else
#define SDV_INLINE static inline
#endif

// sdv_four holds four floats: all the SIMD there is. Below, plain C says what each operation does.
// SIMD rounds as plain C does, so the results' bits are the same with and without. (32-bit ARM goes
// without: its NEON has no numbers below FLT_MIN.)
#if defined(SUBDIV_NO_SIMD)
#elif defined(__SSE2__) || defined(_M_X64)
#include <emmintrin.h>
#define SDV_SIMD
typedef __m128 sdv_four;
SDV_INLINE sdv_four sdv_load(const float *p)             { return _mm_loadu_ps(p); }
SDV_INLINE void sdv_store(float *p, sdv_four a)          { _mm_storeu_ps(p, a); }
SDV_INLINE sdv_four sdv_all(float x)                     { return _mm_set1_ps(x); }
SDV_INLINE sdv_four sdv_of(float a, float b, float c, float d) { return _mm_setr_ps(a, b, c, d); }
SDV_INLINE sdv_four sdv_plus(sdv_four a, sdv_four b)     { return _mm_add_ps(a, b); }
SDV_INLINE sdv_four sdv_minus(sdv_four a, sdv_four b)    { return _mm_sub_ps(a, b); }
SDV_INLINE sdv_four sdv_times(sdv_four a, sdv_four b)    { return _mm_mul_ps(a, b); }
SDV_INLINE sdv_four sdv_over(sdv_four a, sdv_four b)     { return _mm_div_ps(a, b); }
SDV_INLINE sdv_four sdv_sqrt(sdv_four a)                 { return _mm_sqrt_ps(a); }
SDV_INLINE int sdv_less(sdv_four a, sdv_four b)
{
    return _mm_movemask_ps(_mm_cmplt_ps(a, b)) == 15;
}
SDV_INLINE void sdv_store_three(float *p, sdv_four a)
{
    _mm_storel_pi((__m64 *)p, a);
    _mm_store_ss(p + 2, _mm_movehl_ps(a, a));
}
SDV_INLINE void sdv_transpose(sdv_four *a)
{
    _MM_TRANSPOSE4_PS(a[0], a[1], a[2], a[3]);
}
#elif defined(__aarch64__) || defined(_M_ARM64)
#include <arm_neon.h>
#define SDV_SIMD
typedef float32x4_t sdv_four;
SDV_INLINE sdv_four sdv_load(const float *p)             { return vld1q_f32(p); }
SDV_INLINE void sdv_store(float *p, sdv_four a)          { vst1q_f32(p, a); }
SDV_INLINE sdv_four sdv_all(float x)                     { return vdupq_n_f32(x); }
SDV_INLINE sdv_four sdv_of(float a, float b, float c, float d)
{
    float x[4] = { a, b, c, d };
    return vld1q_f32(x);
}
SDV_INLINE sdv_four sdv_plus(sdv_four a, sdv_four b)     { return vaddq_f32(a, b); }
SDV_INLINE sdv_four sdv_minus(sdv_four a, sdv_four b)    { return vsubq_f32(a, b); }
SDV_INLINE sdv_four sdv_times(sdv_four a, sdv_four b)    { return vmulq_f32(a, b); }
SDV_INLINE sdv_four sdv_over(sdv_four a, sdv_four b)     { return vdivq_f32(a, b); }
SDV_INLINE sdv_four sdv_sqrt(sdv_four a)                 { return vsqrtq_f32(a); }
SDV_INLINE int sdv_less(sdv_four a, sdv_four b)
{
    return vminvq_u32(vcltq_f32(a, b)) != 0;
}
SDV_INLINE void sdv_store_three(float *p, sdv_four a)
{
    vst1_f32(p, vget_low_f32(a));
    vst1q_lane_f32(p + 2, a, 2);
}
SDV_INLINE void sdv_transpose(sdv_four *a)
{
    float32x4x2_t ab = vtrnq_f32(a[0], a[1]), cd = vtrnq_f32(a[2], a[3]);
    for (int i = 0; i < 2; i++) {
        a[i] = vcombine_f32(vget_low_f32(ab.val[i]), vget_low_f32(cd.val[i]));
        a[2 + i] = vcombine_f32(vget_high_f32(ab.val[i]), vget_high_f32(cd.val[i]));
    }
}
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#define SDV_SIMD
typedef v128_t sdv_four;
SDV_INLINE sdv_four sdv_load(const float *p)             { return wasm_v128_load(p); }
SDV_INLINE void sdv_store(float *p, sdv_four a)          { wasm_v128_store(p, a); }
SDV_INLINE sdv_four sdv_all(float x)                     { return wasm_f32x4_splat(x); }
SDV_INLINE sdv_four sdv_of(float a, float b, float c, float d)
{
    return wasm_f32x4_make(a, b, c, d);
}
SDV_INLINE sdv_four sdv_plus(sdv_four a, sdv_four b)     { return wasm_f32x4_add(a, b); }
SDV_INLINE sdv_four sdv_minus(sdv_four a, sdv_four b)    { return wasm_f32x4_sub(a, b); }
SDV_INLINE sdv_four sdv_times(sdv_four a, sdv_four b)    { return wasm_f32x4_mul(a, b); }
SDV_INLINE sdv_four sdv_over(sdv_four a, sdv_four b)     { return wasm_f32x4_div(a, b); }
SDV_INLINE sdv_four sdv_sqrt(sdv_four a)                 { return wasm_f32x4_sqrt(a); }
SDV_INLINE int sdv_less(sdv_four a, sdv_four b)
{
    return wasm_i32x4_all_true(wasm_f32x4_lt(a, b));
}
SDV_INLINE void sdv_store_three(float *p, sdv_four a)
{
    wasm_v128_store64_lane(p, a, 0);
    wasm_v128_store32_lane(p + 2, a, 2);
}
SDV_INLINE void sdv_transpose(sdv_four *a)
{
    v128_t low[2], high[2];
    for (int i = 0; i < 2; i++) {
        low[i] = wasm_i32x4_shuffle(a[2 * i], a[2 * i + 1], 0, 4, 1, 5);
        high[i] = wasm_i32x4_shuffle(a[2 * i], a[2 * i + 1], 2, 6, 3, 7);
    }
    a[0] = wasm_i64x2_shuffle(low[0], low[1], 0, 2);
    a[1] = wasm_i64x2_shuffle(low[0], low[1], 1, 3);
    a[2] = wasm_i64x2_shuffle(high[0], high[1], 0, 2);
    a[3] = wasm_i64x2_shuffle(high[0], high[1], 1, 3);
}
#endif

#ifndef SDV_SIMD
typedef struct sdv_four { float x[4]; } sdv_four;

SDV_INLINE sdv_four sdv_of(float a, float b, float c, float d)
{
    sdv_four four = { { a, b, c, d } };
    return four;
}

SDV_INLINE sdv_four sdv_load(const float *p)             { return sdv_of(p[0], p[1], p[2], p[3]); }
SDV_INLINE sdv_four sdv_all(float x)                     { return sdv_of(x, x, x, x); }
SDV_INLINE void sdv_store(float *p, sdv_four a)          { memcpy(p, a.x, 4 * sizeof *p); }
SDV_INLINE void sdv_store_three(float *p, sdv_four a)    { memcpy(p, a.x, 3 * sizeof *p); }

SDV_INLINE sdv_four sdv_plus(sdv_four a, sdv_four b)
{
    for (int i = 0; i < 4; i++) a.x[i] += b.x[i];
    return a;
}

SDV_INLINE sdv_four sdv_minus(sdv_four a, sdv_four b)
{
    for (int i = 0; i < 4; i++) a.x[i] -= b.x[i];
    return a;
}

SDV_INLINE sdv_four sdv_times(sdv_four a, sdv_four b)
{
    for (int i = 0; i < 4; i++) a.x[i] *= b.x[i];
    return a;
}

SDV_INLINE sdv_four sdv_over(sdv_four a, sdv_four b)
{
    for (int i = 0; i < 4; i++) a.x[i] /= b.x[i];
    return a;
}

SDV_INLINE sdv_four sdv_sqrt(sdv_four a)
{
    for (int i = 0; i < 4; i++) a.x[i] = sqrtf(a.x[i]);
    return a;
}

// Whether a < b in all four lanes.
SDV_INLINE int sdv_less(sdv_four a, sdv_four b)
{
    int less = 1;
    for (int i = 0; i < 4; i++) less &= a.x[i] < b.x[i];
    return less;
}

// Transposes four vectors: lane j of vector i becomes lane i of vector j.
SDV_INLINE void sdv_transpose(sdv_four *a)
{
    sdv_four from[4] = { a[0], a[1], a[2], a[3] };
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) a[j].x[i] = from[i].x[j];
}
#endif

SDV_INLINE void sdv_prefetch(const float *p)
{
#ifdef __GNUC__
    __builtin_prefetch(p);
#else
    (void)p;
#endif
}

// From here on no compiler fuses multiplications and additions, which would round once instead of
// twice. gcc has a pragma of its own; it is left out where the target cannot fuse them.
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__) && (defined(__FP_FAST_FMA) || defined(__FP_FAST_FMAF))
#pragma GCC push_options
#pragma GCC optimize("fp-contract=off")
#endif

// SDV_SEPARATE is 1 under the address sanitizer: each array is then a block of its own, so that the
// sanitizer sees accesses beside it.
#if defined(__SANITIZE_ADDRESS__)
#define SDV_SEPARATE 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SDV_SEPARATE 1
#endif
#endif
#ifndef SDV_SEPARATE
#define SDV_SEPARATE 0
#endif

// SDV_GUARD is told, under SDV_SEPARATE, of the bytes between the arrays of a mesh: fuzzers poison
// them.
#ifndef SDV_GUARD
#define SDV_GUARD(bytes, size) ((void)(bytes), (void)(size))
#endif

// Allocates count items of a type from an arena: see sdv_new.
#define SDV_NEW(context, arena, type, count) \
    ((type *)sdv_new(context, arena, (size_t)(count), sizeof(type)))

// -------------------------------------------------------------------------------- >>memory
// Arrays come from arenas: chains of blocks that are freed together. The context remembers a failed
// allocation, so a function may ask for several arrays and look at context->result once.

typedef struct sdv_block {              // the head of a block; the memory to use is behind it
    struct sdv_block *next;             // of the same arena, or NULL
    void *user;                         // handed to SUBDIV_FREE
} sdv_block;

typedef struct sdv_arena {
    sdv_block *blocks;                  // the newest first
    char      *free;                    // the unused end of the newest block
    size_t     left;                    // bytes there
    size_t     chunk;                   // bytes of the next block at least; doubles with each
} sdv_arena;

// Returns an empty arena. With chunk 0 each block is just as large as it has to be.
static sdv_arena sdv_new_arena(size_t chunk)
{
    sdv_arena arena = { NULL, NULL, 0, 0 };
    arena.chunk = chunk;
    return arena;
}

// Returns an empty arena for short-lived arrays: few and large blocks, which suit huge pages.
static sdv_arena sdv_scratch(void)
{
    return sdv_new_arena((size_t)1 << 16);
}

typedef struct sdv_context {            // the state of one call of the library
    subdiv_result result;               // the first error; nothing is done after it
    subdiv_error *error;                // opt->error, or NULL
    void         *user;                 // opt->user
    const char   *name;                 // of the OBJ file, for messages, or NULL
} sdv_context;

static void sdv_fail(sdv_context *context, subdiv_result code, const char *format, ...);

// Asks Linux for huge pages: to touch a large block page by page costs more than to fill it.
static void sdv_huge_pages(void *memory, size_t size)
{
    uintptr_t page = (uintptr_t)1 << 21, first = ((uintptr_t)memory + page - 1) & ~(page - 1);
    uintptr_t end = ((uintptr_t)memory + size) & ~(page - 1);
    if (end <= first) return;
#if defined(__linux__) && defined(__GNUC__) && !defined(SUBDIV_NO_HUGE_PAGES)
    extern int sdv_madvise(void *address, size_t size, int advice) __asm__("madvise");
    sdv_madvise((void *)first, end - first, 14);                // MADV_HUGEPAGE
#endif
}

// Returns the bytes of count items, or more than sdv_allocate can get if they are too many.
static size_t sdv_bytes(size_t count, size_t item)
{
    return count <= (size_t)PTRDIFF_MAX / item ? count * item : (size_t)PTRDIFF_MAX;
}

// Allocates a block with room for size bytes. NULL when out of memory, and after an error.
static sdv_block *sdv_allocate(sdv_context *context, size_t size)
{
    sdv_block *block = NULL;
    if (!context->result && size <= (size_t)PTRDIFF_MAX - sizeof(sdv_block))
        block = (sdv_block *)SUBDIV_MALLOC(size + sizeof(sdv_block), context->user);
    if (!block) {
        sdv_fail(context, SUBDIV_ERROR_MEMORY, "out of memory");
        return NULL;
    }
    sdv_huge_pages(block, size);
    block->next = NULL;
    block->user = context->user;
    return block;
}

static void sdv_add_block(sdv_context *context, sdv_arena *arena, size_t size)
{
    sdv_block *block = sdv_allocate(context, size);
    if (!block) return;
    block->next = arena->blocks;
    arena->blocks = block;
    arena->free = (char *)(block + 1);
    arena->left = size;
}

// Makes sure that the next arrays of an arena, size bytes in all, come from one block.
static void sdv_reserve(sdv_context *context, sdv_arena *arena, size_t size)
{
    if (SDV_SEPARATE || size <= arena->left) return;
    sdv_add_block(context, arena, size < arena->chunk ? arena->chunk : size);
    arena->chunk *= 2;
}

// Allocates count items, not cleared. Never NULL while context->result is SUBDIV_OK.
static void *sdv_new(sdv_context *context, sdv_arena *arena, size_t count, size_t item)
{
    size_t size = sdv_bytes(count, item);
    if (SDV_SEPARATE) sdv_add_block(context, arena, size);
    else sdv_reserve(context, arena, size = (size + 16) / 16 * 16);
    if (context->result) return NULL;
    char *array = arena->free;
    arena->free += size;
    arena->left -= size;
    return array;
}

static void sdv_arena_free(sdv_arena *arena)
{
    while (arena->blocks) {
        sdv_block *block = arena->blocks;
        arena->blocks = block->next;
        SUBDIV_FREE(block, block->user);
    }
    arena->free = NULL;
    arena->left = 0;
}

typedef struct sdv_array {              // an array that grows, in a block of its own
    sdv_block *block;                   // its items; NULL: none so far
    size_t count, capacity;             // in items
} sdv_array;

static void sdv_copy(void *to, const void *from, size_t count, size_t item)
{
    if (count) memcpy(to, from, count * item);
}

static void *sdv_items(const sdv_array *array)
{
    return array->block ? array->block + 1 : NULL;
}

static void sdv_array_free(sdv_array *array)
{
    if (array->block) SUBDIV_FREE(array->block, array->block->user);
    array->block = NULL;
}

// Moves an array to a larger block, with room for capacity items in all. Returns 0 when out of
// memory.
static int sdv_grow(sdv_context *context, sdv_array *array, size_t capacity, size_t item)
{
    sdv_block *block = sdv_allocate(context, sdv_bytes(capacity, item));
    if (!block) return 0;
    sdv_copy(block + 1, sdv_items(array), array->count, item);
    sdv_array_free(array);
    array->block = block;
    array->capacity = capacity;
    return 1;
}

// Returns the place behind the last item, with room for more; NULL when out of memory.
SDV_INLINE void *sdv_array_room(sdv_context *context, sdv_array *array, size_t more, size_t item)
{
    if (array->capacity - array->count <= more &&
        !sdv_grow(context, array, 2 * (array->count + more), item)) return NULL;
    return (char *)(array->block + 1) + array->count * item;
}

// Appends count cleared items and returns the first of them. NULL when out of memory.
static void *sdv_append(sdv_context *context, sdv_array *array, size_t count, size_t item)
{
    void *room = sdv_array_room(context, array, count, item);
    if (!room) return NULL;
    memset(room, 0, count * item);
    array->count += count;
    return room;
}

// Moves the items of a growing array to an arena and frees the array.
static void *sdv_keep_array(sdv_context *context, sdv_arena *arena, sdv_array *array, size_t item)
{
    void *kept = sdv_new(context, arena, array->count, item);
    if (kept) sdv_copy(kept, sdv_items(array), array->count, item);
    sdv_array_free(array);
    return kept;
}

#define SDV_KEEP(context, arena, type, array) \
    ((type *)sdv_keep_array(context, arena, array, sizeof(type)))

// Copies count items to an arena. NULL if from is NULL or there is no memory.
static void *sdv_duplicate(sdv_context *context, sdv_arena *arena, const void *from, size_t count,
                           size_t item)
{
    void *copy = from ? sdv_new(context, arena, count, item) : NULL;
    if (copy) sdv_copy(copy, from, count, item);
    return copy;
}

// Frees the blocks of a struct that the user holds.
static void sdv_free_memory(void *memory)
{
    sdv_arena owned = sdv_new_arena(0);
    owned.blocks = (sdv_block *)memory;
    sdv_arena_free(&owned);
}

SUBDIV_DEF void subdiv_mesh_free(subdiv_mesh *mesh)
{
    if (!mesh) return;
    sdv_free_memory(mesh->memory);
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

// Begins a call of the library, without an error so far.
static sdv_context sdv_begin(const subdiv_options *opt)
{
    sdv_context context = { SUBDIV_OK, opt ? opt->error : NULL, opt ? opt->user : NULL, NULL };
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
    size_t size, capacity;              // capacity 0: something did not fit
} sdv_text;

static void sdv_put(sdv_text *out, const char *text, size_t size)
{
    size_t i = 0;
    while (i < size && out->size + 1 < out->capacity) out->text[out->size++] = text[i++];
    if (i < size) out->capacity = 0;
    out->text[out->size] = 0;
}

// Writes the decimal digits of a number, at most 20, backwards from end; returns the first.
static char *sdv_digits(char *end, uint64_t number)
{
    do {
        *--end = (char)('0' + number % 10);
        number /= 10;
    } while (number);
    return end;
}

// Adds text as printf does, without locale or stdio. %d: int; %s: text; %t: two pointers, the text
// from the one to the other, cut short after 40 bytes.
static void sdv_format(sdv_text *out, const char *format, va_list args)
{
    for (const char *p = format; *p; p++) {
        if (*p != '%') {
            sdv_put(out, p, 1);
        } else if (*++p == 'd') {
            char digits[24], *end = digits + sizeof digits;
            int number = va_arg(args, int);
            char *first = sdv_digits(end, (uint64_t)(number < 0 ? -(int64_t)number : number));
            if (number < 0) *--first = '-';
            sdv_put(out, first, (size_t)(end - first));
        } else {
            const char *text = va_arg(args, const char *);
            const char *end = *p == 't' ? va_arg(args, const char *) : text + strlen(text);
            int cut = *p == 't' && end - text > 40;
            sdv_put(out, text, cut ? 40 : (size_t)(end - text));
            if (cut) sdv_put(out, "...", 3);
        }
    }
}

static void sdv_say(sdv_text *out, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    sdv_format(out, format, args);
    va_end(args);
}

// Writes a message after the file and line that it is about, if any: "cage.obj:44: ". Keeps the end
// of a long path.
static void sdv_say_at(char text[256], const char *name, int line, const char *format,
                       va_list args)
{
    sdv_text out = { text, 0, 256 };
    size_t size = name ? strlen(name) : 0;
    if (size > 100) sdv_say(&out, "...%s:", name + size - 100);
    else if (name) sdv_say(&out, "%s:", name);
    if (line) sdv_say(&out, name ? "%d:" : "line %d:", line);
    if (name || line) sdv_put(&out, " ", 1);
    sdv_format(&out, format, args);
}

// Notes an error and its place, if it is the first one of a call.
static void sdv_fail_at(sdv_context *context, subdiv_result code, int line, int face, int vertex,
                        const char *format, va_list args)
{
    subdiv_error *error = context->error;
    if (context->result) return;
    context->result = code;
    if (!error) return;
    error->code = code;
    error->line = line;
    error->face = face;
    error->vertex = vertex;
    sdv_say_at(error->message, context->name, line, format, args);
}

static void sdv_fail(sdv_context *context, subdiv_result code, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    sdv_fail_at(context, code, 0, -1, -1, format, args);
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

// Counts a warning, and keeps the text of the first one.
static void sdv_warn(sdv_context *context, int line, const char *format, ...)
{
    subdiv_error *error = context->error;
    if (!error || error->warning_count == INT_MAX || error->warning_count++ > 0) return;
    va_list args;
    va_start(args, format);
    sdv_say_at(error->warning, context->name, line, format, args);
    va_end(args);
}

// ------------------------------------------------------------------------------ >>validate
// Everything after this section may trust the mesh: all arrays are there, all indices in range.

SDV_INLINE int sdv_face_size(const subdiv_mesh *mesh, int face)
{
    return mesh->face_size ? mesh->face_size : mesh->face_sizes[face];
}

// Counts the face-vertices of all faces.
static size_t sdv_face_vertex_count(const subdiv_mesh *mesh)
{
    if (mesh->face_size) return (size_t)mesh->face_count * (size_t)mesh->face_size;
    size_t count = 0;
    for (int f = 0; f < mesh->face_count; f++) count += (size_t)mesh->face_sizes[f];
    return count;
}

// Checks that every array with a count is there.
static void sdv_check_arrays(sdv_context *context, const subdiv_mesh *mesh)
{
    const struct { const char *name; int count; const void *array; } arrays[] = {
        { "face_vertices",    mesh->face_count,                         mesh->face_vertices },
        { "face_sizes",       mesh->face_size ? 0 : mesh->face_count,   mesh->face_sizes },
        { "crease_vertices",  mesh->crease_count,                       mesh->crease_vertices },
        { "crease_sharpness", mesh->crease_count,                       mesh->crease_sharpness },
        { "corner_vertices",  mesh->corner_count,                       mesh->corner_vertices },
        { "corner_sharpness", mesh->corner_count,                       mesh->corner_sharpness },
        { "holes",            mesh->hole_count,                         mesh->holes },
        { "uvs",              mesh->uv_count,                           mesh->uvs },
        { "face_uvs",         mesh->uv_count ? mesh->face_count : 0,    mesh->face_uvs },
        { "statement_faces",  mesh->statement_count,                    mesh->statement_faces },
        { "statements",       mesh->statement_count,                    mesh->statements },
        { "line_sizes",       mesh->line_count,                         mesh->line_sizes },
        { "line_vertices",    mesh->line_count,                         mesh->line_vertices }
    };
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        if (arrays[i].count < 0 || (arrays[i].count > 0 && !arrays[i].array))
            sdv_fail(context, SUBDIV_ERROR_ARGUMENT, arrays[i].count < 0 ? "%s: the count is %d"
                     : "%s is NULL, its count %d", arrays[i].name, arrays[i].count);
}

static const char *const sdv_vertex_rules[] = { "standard", "averaged", "doo-sabin", "warren",
                                                "five-eighths" };

static void sdv_check_rules(sdv_context *context, const subdiv_mesh *mesh)
{
    const struct { const char *name; int value, count; } rules[] = {
        { "scheme",    (int)mesh->scheme,    SUBDIV_BILINEAR + 1 },
        { "boundary",  (int)mesh->boundary,  SUBDIV_BOUNDARY_NONE + 1 },
        { "creasing",  (int)mesh->creasing,  SUBDIV_CREASING_CHAIKIN + 1 },
        { "triangles", (int)mesh->triangles, SUBDIV_TRIANGLES_SMOOTH + 1 },
        { "uv_rule",   (int)mesh->uv_rule,   SUBDIV_UV_NONE + 1 },
        { "vertex_rule", (int)mesh->vertex_rule, SUBDIV_VERTEX_FIVE_EIGHTHS + 1 }
    };
    subdiv_vertex_rule rule = mesh->vertex_rule;
    int loop = rule >= SUBDIV_VERTEX_WARREN;
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        if (rules[i].value < 0 || rules[i].value >= rules[i].count)
            sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "%s has no value %d",
                     rules[i].name, rules[i].value);
    if (!context->result && rule && mesh->scheme != (loop ? SUBDIV_LOOP : SUBDIV_CATMULL_CLARK))
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "vertex rule \"%s\" is for %s alone",
                 sdv_vertex_rules[rule], loop ? "Loop" : "Catmull-Clark");
}

// Finds the first of count numbers, each of 4 bytes, whose masked bits are below low or not below
// high; count if there is none. For such a number one of two differences has bit 31 set, so a block
// of numbers needs no branch for each.
enum { SDV_CHECKED = 256 };

static size_t sdv_find_outside(const void *numbers, size_t count, uint32_t mask, int low, int high)
{
    const char *number = (const char *)numbers;
    uint32_t least = (uint32_t)low, most = (uint32_t)high - 1, bad = 0, n;
    size_t i = 0;
    for (; count - i >= SDV_CHECKED && !(bad >> 31); i += SDV_CHECKED)
        for (size_t k = 0; k < SDV_CHECKED; k++) {
            memcpy(&n, number + 4 * (i + k), 4);
            bad |= ((n & mask) - least) | (most - (n & mask));
        }
    if (bad >> 31) i -= SDV_CHECKED;
    for (; i < count; i++) {
        memcpy(&n, number + 4 * i, 4);
        if ((((n & mask) - least) | (most - (n & mask))) >> 31) break;
    }
    return i;
}

// Finds the first float of this exponent, biased as in its bits, or more; count if there is none.
enum { SDV_ENDLESS = 255 };             // infinite or not a number
enum { SDV_HUGE = 243 };                // 2^116 or more

static size_t sdv_find_exponent(const float *numbers, size_t count, int exponent)
{
    return sdv_find_outside(numbers, count, 0x7fffffff, 0, exponent << 23);
}

// Checks the vertex, UV or other value of each face-vertex, of which there are count. With low = -1
// a face-vertex may have none.
static void sdv_check_indices(sdv_context *context, const subdiv_mesh *mesh, const int *indices,
                              int low, int count, const char *message)
{
    size_t all = sdv_face_vertex_count(mesh), end = 0;
    size_t i = sdv_find_outside(indices, all, 0xffffffff, low, count);
    int f = -1;
    if (i == all) return;
    while (end <= i) end += (size_t)sdv_face_size(mesh, ++f);
    sdv_fail_mesh(context, SUBDIV_ERROR_INDEX, f, low ? -1 : indices[i], message, f, indices[i],
                  count);
}

static void sdv_check_faces(sdv_context *context, const subdiv_mesh *mesh)
{
    for (int f = 0; f < (mesh->face_size > 2 ? 0 : mesh->face_count); f++) {
        int size = sdv_face_size(mesh, f);
        if (size < 3) {
            sdv_fail_mesh(context, SUBDIV_ERROR_FACE, f, -1, "face %d has %d vertices", f, size);
            return;
        }
    }
    sdv_check_indices(context, mesh, mesh->face_vertices, 0, mesh->vertex_count,
                      "face %d: vertex %d does not exist (the mesh has %d)");
    if (mesh->uv_count)
        sdv_check_indices(context, mesh, mesh->face_uvs, -1, mesh->uv_count,
                          "face %d: UV %d does not exist (the mesh has %d)");
    if (mesh->normals && mesh->face_normals)
        sdv_check_indices(context, mesh, mesh->face_normals, 0, mesh->normal_count,
                          "face %d: normal %d does not exist (the mesh has %d)");
}

// Checks a list of creases, corners or, without sharpness, of holes. A sharpness may be infinite.
static void sdv_check_list(sdv_context *context, const char *what, int count, const int *items,
                           int ends, int most, const float *sharpness)
{
    for (int i = 0; i < count && !context->result; i++, items += ends) {
        for (int j = 0; j < ends; j++)
            if (items[j] < 0 || items[j] >= most)
                sdv_fail_mesh(context, SUBDIV_ERROR_INDEX, sharpness ? -1 : items[j],
                              sharpness ? items[j] : -1,
                              "%s %d: %s %d does not exist (the mesh has %d)", what, i,
                              sharpness ? "vertex" : "face", items[j], most);
        if (sharpness && sharpness[i] != sharpness[i])
            sdv_fail_mesh(context, SUBDIV_ERROR_NOT_FINITE, -1, items[0],
                          "%s %d: the sharpness is not a number", what, i);
    }
}

static void sdv_check_lines(sdv_context *context, const subdiv_mesh *mesh)
{
    const int *v = mesh->line_vertices;
    for (int i = 0; i < mesh->line_count && !context->result; i++) {
        int size = mesh->line_sizes[i];
        if (size < 2) sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "polyline %d has %d vertices", i,
                               size);
        for (int k = 0; k < size; k++, v++)
            if (*v < 0 || *v >= mesh->vertex_count)
                sdv_fail_mesh(context, SUBDIV_ERROR_INDEX, -1, *v, "polyline %d: vertex %d does "
                              "not exist (the mesh has %d)", i, *v, mesh->vertex_count);
    }
}

static int sdv_ends_word(char c)
{
    return c == 0 || c == ' ' || c == '\t';
}

// Do two texts begin with the same word?
static int sdv_same_word(const char *a, const char *b)
{
    while (!sdv_ends_word(*a) && *a == *b) a++, b++;
    return sdv_ends_word(*a) && sdv_ends_word(*b);
}

// Checks that each statement is one line, of a kind that is kept: any other would change the file
// that is written.
static void sdv_check_statements(sdv_context *context, const subdiv_mesh *mesh)
{
    static const char *const words[] = { "g", "o", "s", "usemtl", "mtllib" };
    for (int i = 0, last = 0; i < mesh->statement_count && !context->result; i++) {
        const char *text = mesh->statements[i];
        int face = mesh->statement_faces[i], known = 0;
        if (face < last || face > mesh->face_count)
            sdv_fail_mesh(context, SUBDIV_ERROR_INDEX, face, -1,
                          face < last ? "statement %d: face %d is not in order"
                                      : "statement %d: face %d does not exist", i, face);
        for (int k = 0; k < 5 && text; k++) known |= sdv_same_word(text, words[k]);
        if (!known || strpbrk(text, "\r\n"))
            sdv_fail(context, SUBDIV_ERROR_ARGUMENT,
                     "statement %d is not a line with g, o, s, usemtl or mtllib", i);
        last = face;
    }
}

// Returns how many normals a mesh has.
static int sdv_normal_count(const subdiv_mesh *mesh)
{
    return !mesh->normals ? 0 : mesh->face_normals ? mesh->normal_count : mesh->vertex_count;
}

// Checks count vectors of so many numbers each: 3 for a vertex, 2 for a UV.
static void sdv_check_finite(sdv_context *context, const char *what, int width,
                             const float *values, int count)
{
    size_t all = (size_t)width * (size_t)count, i = sdv_find_exponent(values, all, SDV_ENDLESS);
    if (i == all) return;
    int v = (int)(i / (size_t)width);
    sdv_fail_mesh(context, SUBDIV_ERROR_NOT_FINITE, -1, width == 3 ? v : -1,
                  "%s %d: number %d is not finite", what, v, (int)(i % (size_t)width));
}

static void sdv_check_positions(sdv_context *context, const float *positions, int count)
{
    if (count > 0 && !positions) sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "positions is NULL");
    else sdv_check_finite(context, "vertex", 3, positions, count);
}

// Checks everything but the positions, UVs, colours and normals themselves.
static void sdv_check_mesh(sdv_context *context, const subdiv_mesh *mesh)
{
    if (!mesh) {
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "the mesh is NULL");
        return;
    }
    if (mesh->vertex_count == 0) sdv_fail(context, SUBDIV_ERROR_EMPTY, "the mesh has no vertices");
    if (mesh->vertex_count < 0)
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "vertex_count is %d", mesh->vertex_count);
    if (mesh->face_count == 0 && mesh->face_size && mesh->face_size < 3)
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "face_size is %d", mesh->face_size);
    sdv_check_arrays(context, mesh);
    sdv_check_rules(context, mesh);
    uint64_t size = mesh->face_size > 0 ? (uint64_t)mesh->face_size : 0;
    if (size * (uint64_t)mesh->face_count > PTRDIFF_MAX / sizeof(int))
        sdv_fail(context, SUBDIV_ERROR_TOO_LARGE, "the faces have too many vertices together");
    if (context->result) return;

    sdv_check_faces(context, mesh);
    sdv_check_statements(context, mesh);
    sdv_check_lines(context, mesh);
    sdv_check_list(context, "crease", mesh->crease_count, mesh->crease_vertices, 2,
                   mesh->vertex_count, mesh->crease_sharpness);
    sdv_check_list(context, "corner", mesh->corner_count, mesh->corner_vertices, 1,
                   mesh->vertex_count, mesh->corner_sharpness);
    sdv_check_list(context, "hole", mesh->hole_count, mesh->holes, 1, mesh->face_count, NULL);
}

// Checks everything but the positions.
static void sdv_check_data(sdv_context *context, const subdiv_mesh *mesh)
{
    sdv_check_mesh(context, mesh);
    if (context->result) return;
    sdv_check_finite(context, "UV", 2, mesh->uvs, mesh->uv_count);
    sdv_check_finite(context, "color", 3, mesh->colors, mesh->colors ? mesh->vertex_count : 0);
    sdv_check_finite(context, "normal", 3, mesh->normals, sdv_normal_count(mesh));
}

// Checks everything.
static void sdv_check_all(sdv_context *context, const subdiv_mesh *mesh)
{
    sdv_check_data(context, mesh);
    if (!context->result) sdv_check_positions(context, mesh->positions, mesh->vertex_count);
}

// --------------------------------------------------------------------------------- >>level
// A level is a mesh with the sharpness of its edges and vertices: all that refinement needs to
// know, and all that the next level inherits.
//
// More words, for the inside:
//     order       formulas for where each point of the result stands, on the grids of cage faces
//     row         the points that one new point is made from, with weights; batch: rows alike
//     work point  a point that later points are made from: of any level before the result
//     line        the points inside an edge of the cage
//     grid        the points of a quad or Loop triangle of the cage, in rows and columns; any other
//                 polygon has one for each vertex
//     frame       the inner points beside a grid's sides: deep levels keep no other inner points
//     patch       a regular face with its control points; strip: a part of one between creases
//     core        of SUBDIV_EXACT: the faces that become leaves (others are there for their masks)
//     rough       a face of the core that is no patch on this level; SUBDIV_PLAIN: any face
//     nest        a vertex that stays irregular on every level, and the faces around it
//     leaf        of SUBDIV_EXACT: a patch or a face of a nest
//     cell        of SUBDIV_EXACT: a part of a cage face, from which the leaf at (u, v) is found
//     tile        a face with rates of its own; home: the face that makes a shared point
//
// A face-vertex h is an index into face_vertices. It stands for three things: a face, one of its
// vertices, and the edge from there to the next vertex, the edge that "leads on". An edge is a ring
// of face-vertices, one for each face that has it, in rising order:
//
//     +---<---+
//     |   q   |       between two faces:  across[h] = q, across[q] = h
//     +--->---+       on a boundary:      across[h] = h
//     |   h   |       non-manifold:       a ring of three or more
//     +---<---+

typedef struct sdv_rules {              // how every level is refined
    int loop;                           // faces split into 4 triangles, else into quads
    int linear;                         // nothing is smoothed
    int straight;                       // boundaries stay straight
    int limit;                          // the result is on the limit surface
    int left_handed;                    // normals are turned round
    subdiv_creasing creasing;
    subdiv_triangles triangles;
    subdiv_vertex_rule vertex_rule;
    const struct sdv_mask *vertex_masks; // of each valence, by vertex_weights; or NULL
} sdv_rules;

typedef struct sdv_place {              // where a face is on a grid of its cage face (see >>order)
    int h;                              // the cage face-vertex of the grid
    int row, column, step;              // of vertex 0; step -1: a triangle turned by half
} sdv_place;

typedef struct sdv_level {
    // The mesh.
    int vertex_count, face_count, face_vertex_count;
    int face_size;                      // of all faces; 0: see face_starts
    int *face_starts;                   // [face_count + 1]     the first face-vertex of each face
    int *face_of;                       // [face_vertex_count]  (both for face_size 0 alone)
    int *face_vertices;                 // [face_vertex_count]
    int *across;                        // [face_vertex_count]  the next in the ring of an edge
    int *vertex_first;                  // [vertex_count]       the first face-vertex there, or -1
    int *vertex_next;                   // [face_vertex_count]  the next one at its vertex, or -1
    int *vertex_faces;                  // [vertex_count]       the number of face-vertices there
    int *face_edges;                    // [face_vertex_count]  numbers of edges: level 0 alone
    int *edge_first;                    // [edge_count]         the first face-vertex of each edge
    int *edge_at;                       // [vertex_count]       the last edge listed there, or -1
    struct sdv_listed_edge *edges;      // [edge_count]         (both for level 0 of positions)
    int  edge_count;

    // The sharpness of edges and vertices.
    float *sharpness;                   // [face_vertex_count]  of the edge that leads on
    float *half_sharpness;              // [face_vertex_count]  one level down, of the half of this
                                        //                      edge at its vertex; NULL: sdv_fade
    float *vertex_sharpness;            // [vertex_count]
    unsigned char *creased;             // [vertex_count]       has a sharp edge

    // The fading of face-varying values along with the cage: see >>face-varying.
    int *partner;                       // [vertex_count]       the vertex it fades with, or -1;
                                        //                      NULL: each fades by itself
    float *seam;                        // [vertex_count]       of those with a partner: the largest
                                        //                      sharpness of a semi-sharp seam there
    int *origin, origin_count;          // [vertex_count]       its vertex of the cage, or -1; NULL:
    float *sums;                        // [2 * origin_count]   not needed. See sdv_chaikin_sums

    // The work points of vertices and faces.
    int    first_point;                 // vertex v is work point first_point + v
    const struct sdv_order *order;      // where the cage's points stand on a later level, or NULL
    int   *face_point;                  // [face_count]         work points of the face points

    // Faces and vertices under SUBDIV_EXACT and SUBDIV_PLAIN: see >>split.
    sdv_place *places;                  // [face_count]         where they are; NULL on level 0
    unsigned char *core;                // [face_count]         becomes leaves
    unsigned char *rough;               // [face_count]         in the core, and not a patch
    unsigned char *kinds;               // [vertex_count]       how the surface goes on: sdv_kind
} sdv_level;

// A face has the face-vertices from sdv_face_start up to, but without, sdv_face_end.
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
    if (level->face_size == 3) return (int)((unsigned)h / 3);
    return level->face_of[h];
}

// Return the face-vertices before and after h in its face.
static inline int sdv_previous(const sdv_level *level, int h)
{
    if (level->face_size == 4) return (h & ~3) | ((h + 3) & 3);
    if (level->face_size == 3) return (unsigned)h % 3 == 0 ? h + 2 : h - 1;
    const int *start = level->face_starts + level->face_of[h];
    return h > start[0] ? h - 1 : start[1] - 1;
}

static inline int sdv_next(const sdv_level *level, int h)
{
    if (level->face_size == 4) return (h & ~3) | ((h + 1) & 3);
    if (level->face_size == 3) return (unsigned)h % 3 == 2 ? h - 2 : h + 1;
    const int *start = level->face_starts + level->face_of[h];
    return h + 1 < start[1] ? h + 1 : start[0];
}

// Returns the first face-vertex of the quad of h.
static inline int sdv_quad_start(const sdv_level *level, int h)
{
    return level->face_size ? h & ~3 : level->face_starts[level->face_of[h]];
}

// Returns the number of vertices of the face of h.
static int sdv_size_of(const sdv_level *level, int h)
{
    if (level->face_size) return level->face_size;
    int face = sdv_face_of(level, h);
    return sdv_face_end(level, face) - sdv_face_start(level, face);
}

static int sdv_edge_faces(const sdv_level *level, int h)
{
    int count = 1;
    for (int k = level->across[h]; k != h; k = level->across[k]) count++;
    return count;
}

// Picks one face-vertex for each edge at a vertex, so that each edge is met once. Ask it for each
// face-vertex h at the vertex, with outgoing 1: its edge leads on from there; and for the one
// before each, with outgoing 0: its edge leads to the vertex. An edge between two faces that are
// wound alike is met where it leads on, any other at the last face-vertex of its ring.
static int sdv_is_edge_at(const sdv_level *level, int h, int outgoing)
{
    int q = level->across[h];
    if (q != h && level->across[q] == h && level->face_vertices[q] != level->face_vertices[h])
        return outgoing;
    return q <= h;
}

// Allocates what each level has besides face_vertices; chaikin: also half_sharpness.
static void sdv_level_new(sdv_context *context, sdv_arena *arena, sdv_level *level, int chaikin)
{
    size_t vertices = (size_t)level->vertex_count, faces = (size_t)level->face_count;
    size_t face_vertices = (size_t)level->face_vertex_count;
    sdv_reserve(context, arena, 20 * face_vertices + 32 * faces + 16 * vertices + 1024);
    level->across = SDV_NEW(context, arena, int, face_vertices);
    level->vertex_first = SDV_NEW(context, arena, int, vertices);
    level->vertex_next = SDV_NEW(context, arena, int, face_vertices);
    level->vertex_faces = SDV_NEW(context, arena, int, vertices);
    level->sharpness = SDV_NEW(context, arena, float, face_vertices);
    if (chaikin) level->half_sharpness = SDV_NEW(context, arena, float, face_vertices);
    level->vertex_sharpness = SDV_NEW(context, arena, float, vertices);
    level->creased = SDV_NEW(context, arena, unsigned char, vertices);
    level->face_point = SDV_NEW(context, arena, int, faces);
    level->core = SDV_NEW(context, arena, unsigned char, faces);
    level->rough = SDV_NEW(context, arena, unsigned char, faces);
    level->kinds = SDV_NEW(context, arena, unsigned char, vertices);
    if (!context->result) memset(level->creased, 0, vertices);
}

// Lists the face-vertices at each vertex, in rising order, and counts them.
static void sdv_level_count(sdv_level *level)
{
    const int *vertices = level->face_vertices;
    int *first = level->vertex_first, *next = level->vertex_next, *count = level->vertex_faces;
    for (int v = 0; v < level->vertex_count; v++) {
        first[v] = -1;
        count[v] = 0;
    }
    for (int h = level->face_vertex_count - 1; h >= 0; h--) {
        int v = vertices[h];
        next[h] = first[v];
        first[v] = h;
        count[v]++;
    }
}

// ---------------------------------------------------------------------------------- >>cage
// From polygons to level 0: find the edges, what is non-manifold, and what is sharp: by the
// user's lists, by being a boundary, by being non-manifold.

// Sharpness that follows from the shape and is not the user's. Forever like every sharpness from
// 10 on, but not written into results: the next call finds it again.
#define SDV_IMPLIED 11.0f

typedef struct sdv_cage {
    sdv_level level;
    unsigned char *edge_nonmanifold;    // [edge_count]
    unsigned char *vertex_nonmanifold;  // [vertex_count]
    unsigned char *hole;                // [face_count]
} sdv_cage;

// The end with fewer faces: edges are looked for there, as a vertex may have a huge valence. Of two
// with as many faces the first, so that it is the same one from both.
static int sdv_smaller_end(const sdv_level *level, int a, int b)
{
    int more = level->vertex_faces[a] - level->vertex_faces[b];
    return more < 0 || (more == 0 && a < b) ? a : b;
}

typedef struct sdv_listed_edge {        // at its smaller end
    int other;                          // the other end
    int next;                           // the next edge there, or -1
    int last;                           // the last face-vertex of its ring
} sdv_listed_edge;

// The edge at a vertex whose smaller end that is, or -1.
static inline int sdv_listed(const sdv_level *level, int v, int other)
{
    int e = level->edge_at[v];
    while (e >= 0 && level->edges[e].other != other) e = level->edges[e].next;
    return e;
}

// The edge between two vertices, the first one if there are several, or -1.
static int sdv_find_edge(const sdv_level *level, int a, int b)
{
    int v = sdv_smaller_end(level, a, b);
    return sdv_listed(level, v, v == a ? b : a);
}

// Takes face-vertex h as the first of a new edge, at v, its smaller end.
static inline int sdv_new_edge(sdv_level *level, int h, int v, int other)
{
    int e = level->edge_count++;
    sdv_listed_edge edge = { other, level->edge_at[v], h };
    level->face_edges[h] = e;
    level->edge_first[e] = level->across[h] = h;
    level->edges[e] = edge;
    return e;
}

// Takes h as the last one of the ring of edge e.
static inline void sdv_join_edge(sdv_level *level, int e, int h)
{
    int *last = &level->edges[e].last;
    level->face_edges[h] = e;
    level->across[h] = level->edge_first[e];
    level->across[*last] = h;
    *last = h;
}

// Numbers the edges in the order in which the faces meet them. An edge is non-manifold when
// three or more faces share it, when two faces run along it in the same direction, when both its
// ends are the same vertex, or when one face has it twice: then each later time is an edge of its
// own.
static void sdv_cage_edges(sdv_cage *cage)
{
    sdv_level *level = &cage->level;
    const int *vertices = level->face_vertices;
    for (int v = 0; v < level->vertex_count; v++) level->edge_at[v] = -1;
    for (int f = 0; f < level->face_count; f++) {
        int start = sdv_face_start(level, f), end = sdv_face_end(level, f), b = vertices[start];
        for (int h = start; h < end; h++) {
            int a = b;
            b = vertices[h + 1 < end ? h + 1 : start];
            int v = sdv_smaller_end(level, a, b), other = v == a ? b : a;
            int e = sdv_listed(level, v, other), first = e < 0 ? -1 : level->edge_first[e];
            int joins = e >= 0 && a != b && level->edges[e].last < start;
            int manifold = joins ? level->across[first] == first && vertices[first] != a
                                 : e < 0 && a != b;
            if (joins) sdv_join_edge(level, e, h);
            else if (e < 0) level->edge_at[v] = sdv_new_edge(level, h, v, other);
            else sdv_new_edge(level, h, v, other);
            if (manifold) continue;
            if (e >= 0) cage->edge_nonmanifold[e] = 1;
            cage->edge_nonmanifold[level->face_edges[h]] = 1;
        }
    }
}

// Do the faces at v, whose edges are all manifold, form one fan? From face to face around v, to
// the left and, if that ends at a boundary, to the right.
static int sdv_is_fan(const sdv_level *level, int v)
{
    int first = level->vertex_first[v], h = first, met = 1;
    if (first < 0) return 0;
    for (;; met++) {
        int before = sdv_previous(level, h), left = level->across[before];
        if (left == first) return met == level->vertex_faces[v];
        if (left == before) break;
        h = left;
    }
    for (h = first; level->across[h] != h; met++) h = sdv_next(level, level->across[h]);
    return met == level->vertex_faces[v];
}

static void sdv_sharpen_edge(sdv_level *level, int e, float sharpness)
{
    int first = level->edge_first[e], h = first;
    do level->sharpness[h] = sharpness;
    while ((h = level->across[h]) != first);
}

static float sdv_clamp_sharpness(float s)
{
    return s > SUBDIV_INFINITE ? SUBDIV_INFINITE : s > 0 ? s : 0;
}

// The user's creases, each at the first face-vertex of its edge, and corners. A crease that is no
// edge is skipped.
static void sdv_user_sharpness(sdv_context *context, sdv_level *level, const subdiv_mesh *mesh)
{
    memset(level->sharpness, 0, (size_t)level->face_vertex_count * sizeof(float));
    memset(level->vertex_sharpness, 0, (size_t)level->vertex_count * sizeof(float));
    for (int i = 0; i < mesh->crease_count; i++) {
        const int *ends = mesh->crease_vertices + 2 * (size_t)i;
        int a = ends[0], b = ends[1], e = sdv_find_edge(level, a, b);
        float s = sdv_clamp_sharpness(mesh->crease_sharpness[i]);
        if (mesh->crease_sharpness[i] < 0)
            sdv_warn(context, 0, "crease %d: edge %d-%d has a sharpness below 0", i, a, b);
        if (e < 0) sdv_warn(context, 0, "crease %d: no edge joins vertices %d and %d", i, a, b);
        else level->sharpness[level->edge_first[e]] = s;
    }
    for (int i = 0; i < mesh->corner_count; i++) {
        int v = mesh->corner_vertices[i];
        level->vertex_sharpness[v] = sdv_clamp_sharpness(mesh->corner_sharpness[i]);
        if (mesh->corner_sharpness[i] < 0)
            sdv_warn(context, 0, "corner %d: vertex %d has a sharpness below 0", i, v);
    }
}

static int sdv_is_boundary(const sdv_level *level, int h)
{
    return level->across[h] == h;
}

// Boundary "none": every face at a vertex with an unsharpened boundary edge becomes a hole, and is
// no part of the surface either.
enum { SDV_DROPPED = 2 };

static void sdv_open_boundary(sdv_cage *cage)
{
    const sdv_level *level = &cage->level;
    const int *vertices = level->face_vertices;
    unsigned char *open = cage->vertex_nonmanifold;             // which is not yet known
    memset(open, 0, (size_t)level->vertex_count);
    for (int h = 0; h < level->face_vertex_count; h++)
        if (sdv_is_boundary(level, h) && level->sharpness[h] < SUBDIV_INFINITE)
            open[vertices[h]] = open[vertices[sdv_next(level, h)]] = 1;
    for (int h = 0; h < level->face_vertex_count; h++)
        if (open[vertices[h]]) cage->hole[sdv_face_of(level, h)] = SDV_DROPPED;
}

// Around a vertex: how many edges, and of them boundary and non-manifold ones.
typedef struct sdv_edges_at {
    int count, boundary, nonmanifold;
    int room;                           // tcc 0.9.27 takes 16 bytes from a function that returns 12
} sdv_edges_at;

static sdv_edges_at sdv_count_edges_at(const sdv_cage *cage, int v)
{
    const sdv_level *level = &cage->level;
    sdv_edges_at edges = { 0, 0, 0, 0 };
    for (int k = level->vertex_first[v]; k >= 0; k = level->vertex_next[k]) {
        int two[2] = { k, sdv_previous(level, k) };
        for (int i = 0; i < 2; i++) {
            if (!sdv_is_edge_at(level, two[i], i == 0)) continue;
            edges.count++;
            edges.boundary += sdv_is_boundary(level, two[i]);
            edges.nonmanifold += cage->edge_nonmanifold[level->face_edges[two[i]]];
        }
    }
    return edges;
}

// Does a crease of two non-manifold edges run through v? Then each sheet of faces there leads from
// the one edge to the other, and there are at least three. Walks from the first face of each sheet
// to its last, counter-clockwise; faces of a ring are not met.
static int sdv_is_nonmanifold_crease(const sdv_cage *cage, int v)
{
    const sdv_level *level = &cage->level;
    const unsigned char *odd = cage->edge_nonmanifold;
    sdv_edges_at edges = sdv_count_edges_at(cage, v);
    int met = 0;
    if (edges.nonmanifold != 2 || edges.boundary > 0) return 0;
    for (int h = level->vertex_first[v]; h >= 0; h = level->vertex_next[h]) {
        int from = level->face_edges[h], last = sdv_previous(level, h);
        if (!odd[from]) continue;
        for (met++; !odd[level->face_edges[last]]; met++)
            last = sdv_previous(level, level->across[last]);
        if (level->face_edges[last] == from) return 0;
    }
    return met == level->vertex_faces[v] && met > edges.count;
}

// Adds what is sharp by shape [OSD]: boundary and non-manifold edges; under "edge and corner" the
// vertices with one face; non-manifold vertices, but for a non-manifold edge that runs through.
// Gives the sharpness of an edge to all its face-vertices, and marks the ends of sharp edges.
static void sdv_implied_sharpness(sdv_cage *cage, subdiv_boundary boundary)
{
    sdv_level *level = &cage->level;
    unsigned char *nonmanifold = cage->vertex_nonmanifold;
    memset(nonmanifold, 0, (size_t)level->vertex_count);
    for (int e = 0; e < level->edge_count; e++) {
        int h = level->edge_first[e], odd = cage->edge_nonmanifold[e];
        float s = level->sharpness[h];
        if ((odd || sdv_is_boundary(level, h)) && s < SUBDIV_INFINITE) s = SDV_IMPLIED;
        if (s <= 0) continue;
        sdv_sharpen_edge(level, e, s);
        int a = level->face_vertices[h], b = level->face_vertices[sdv_next(level, h)];
        if (odd) nonmanifold[a] = nonmanifold[b] = 1;
        level->creased[a] = level->creased[b] = 1;
    }
    for (int v = 0; v < level->vertex_count; v++) {
        if (!nonmanifold[v] && !sdv_is_fan(level, v)) nonmanifold[v] = 1;
        if (level->vertex_sharpness[v] >= SUBDIV_INFINITE) continue;
        int single = boundary == SUBDIV_BOUNDARY_EDGE_AND_CORNER && level->vertex_faces[v] == 1 &&
                     sdv_count_edges_at(cage, v).count == 2;
        if (single || (nonmanifold[v] && !sdv_is_nonmanifold_crease(cage, v)))
            level->vertex_sharpness[v] = SDV_IMPLIED;
    }
}

// Faces, as face-vertices; starts and faces of face-vertices where sizes are not all 3 or all 4.
static void sdv_cage_faces(sdv_context *context, sdv_arena *arena, sdv_level *level,
                           const subdiv_mesh *mesh)
{
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

static void sdv_level_fade(sdv_level *level);                   // see >>sharpness

// Level 0 of a valid mesh, whose face_vertices it borrows. keep gets what >>order needs and holes,
// scratch the rest.
static void sdv_cage_build(sdv_context *context, sdv_arena *keep, sdv_arena *scratch,
                           sdv_cage *cage, const subdiv_mesh *mesh)
{
    sdv_level *level = &cage->level;
    memset(cage, 0, sizeof *cage);
    sdv_cage_faces(context, keep, level, mesh);
    if (context->result) return;
    level->face_edges = SDV_NEW(context, keep, int, level->face_vertex_count);
    cage->hole = SDV_NEW(context, keep, unsigned char, level->face_count);
    sdv_level_new(context, scratch, level, mesh->creasing == SUBDIV_CREASING_CHAIKIN);
    level->edge_first = SDV_NEW(context, scratch, int, level->face_vertex_count);
    level->edge_at = SDV_NEW(context, scratch, int, level->vertex_count);
    level->edges = SDV_NEW(context, scratch, sdv_listed_edge, level->face_vertex_count);
    cage->edge_nonmanifold = SDV_NEW(context, scratch, unsigned char, level->face_vertex_count);
    cage->vertex_nonmanifold = SDV_NEW(context, scratch, unsigned char, level->vertex_count);
    if (context->result) return;

    memset(cage->edge_nonmanifold, 0, (size_t)level->face_vertex_count);
    sdv_level_count(level);
    sdv_cage_edges(cage);
    memset(cage->hole, 0, (size_t)level->face_count);
    for (int i = 0; i < mesh->hole_count; i++) cage->hole[mesh->holes[i]] = 1;
    sdv_user_sharpness(context, level, mesh);
    if (mesh->boundary == SUBDIV_BOUNDARY_NONE && mesh->scheme != SUBDIV_BILINEAR)
        sdv_open_boundary(cage);
    sdv_implied_sharpness(cage, mesh->boundary);
    sdv_level_fade(level);
}

// ----------------------------------------------------------------------------- >>sharpness
// How creases and corners fade from level to level [DKT98], and what is left of them at a vertex.

// Uniform: one less each level. What is infinite stays.
static float sdv_fade(float sharpness)
{
    if (sharpness >= SUBDIV_INFINITE) return sharpness;
    return sharpness > 1 ? sharpness - 1 : 0;
}

// Chaikin, for the half of an edge at one of its ends, where sum and count are of all semi-sharp
// edges: a quarter of the sharpness comes from the others.
//
//     s' = max(0, 3/4 s + 1/4 mean(others) - 1)
static float sdv_fade_chaikin(float s, float sum, int count)
{
    if (s <= 0 || s >= SUBDIV_INFINITE) return s;
    if (count > 1) s = 0.75f * s + 0.25f * ((sum - s) / (float)(count - 1));
    return s > 1 ? s - 1 : 0;
}

static int sdv_is_semi_sharp(float sharpness)
{
    return sharpness > 0 && sharpness < SUBDIV_INFINITE;
}

// Adds up the sharpness of the semi-sharp edges that lead on from v, and counts them. These are all
// semi-sharp edges at v, as only a manifold edge between two faces is semi-sharp.
static void sdv_sum_semi_sharp(const sdv_level *level, const float *sharpness, int v, float *sums)
{
    sums[0] = sums[1] = 0;
    for (int h = level->vertex_first[v]; h >= 0; h = level->vertex_next[h]) {
        if (!sdv_is_semi_sharp(sharpness[h])) continue;
        sums[0] += sharpness[h];
        sums[1] += 1;
    }
}

// Fades the halves of all edges, each at its vertex. Only Chaikin's depend on other edges.
static void sdv_level_fade(sdv_level *level)
{
    float *half = level->half_sharpness, own[2];
    if (!half) return;
    memset(half, 0, (size_t)level->face_vertex_count * sizeof(float));
    for (int v = 0; v < level->vertex_count; v++) {
        if (!level->creased[v]) continue;
        int origin = level->origin ? level->origin[v] : -1;
        const float *sums = origin >= 0 ? level->sums + 2 * (size_t)origin : own;
        if (origin < 0) sdv_sum_semi_sharp(level, level->sharpness, v, own);
        for (int h = level->vertex_first[v]; h >= 0; h = level->vertex_next[h])
            half[h] = sdv_fade_chaikin(level->sharpness[h], sums[0], (int)sums[1]);
    }
}

// The sharpness of the edge that leads to a vertex from the one before, where it ends.
static float sdv_sharpness_before(const sdv_level *level, int before)
{
    int q = level->across[before];
    return level->across[q] == before ? level->sharpness[q] : level->sharpness[before];
}

// The sharpness that an edge has one level down, in its half at one vertex. sdv_half: the edge that
// leads on from h, at the vertex of h; sdv_half_before: the edge of before, where it ends.
static float sdv_half(const sdv_level *level, int h)
{
    float s = level->sharpness[h];
    return level->half_sharpness && sdv_is_semi_sharp(s) ? level->half_sharpness[h] : sdv_fade(s);
}

static float sdv_half_before(const sdv_level *level, int before)
{
    float s = sdv_sharpness_before(level, before);
    return sdv_is_semi_sharp(s) ? sdv_half(level, level->across[before]) : s;
}

// The rule for a vertex is the number of its sharp edges: 0 smooth, 1 dart, 2 crease, 3 or more
// corner. A sharp vertex is a corner, whatever its edges. Sharp vertices always fade uniformly.
typedef enum sdv_rule { SDV_SMOOTH, SDV_DART, SDV_CREASE, SDV_CORNER } sdv_rule;

static sdv_rule sdv_vertex_rule(float vertex_sharpness, int sharp_edges)
{
    if (vertex_sharpness > 0 || sharp_edges >= 3) return SDV_CORNER;
    if (sharp_edges == 2) return SDV_CREASE;
    return sharp_edges == 1 ? SDV_DART : SDV_SMOOTH;
}

// A vertex between two levels: its rule now and on the next level. When they differ, the vertex
// point is a blend, weight of this level's rule against 1 - weight of the next one's.
typedef struct sdv_fading {
    sdv_rule rule, next;
    double weight;                      // mean sharpness of what fades away here, at most 1
} sdv_fading;

// The sharp edges at a vertex: how many now, on the next level and forever, the sum of the
// sharpness of those that fade away until the next level, and of those that are semi-sharp there.
typedef struct sdv_sharp_edges {
    int   now, next, forever;
    float ending;
    int   semi;
    float sum;
} sdv_sharp_edges;

// half: what is left of an edge one level down.
static void sdv_meet_edge(sdv_sharp_edges *edges, float sharpness, float half)
{
    if (sharpness <= 0) return;
    edges->now++;
    edges->next += half > 0;
    edges->forever += sharpness >= SUBDIV_INFINITE;
    if (half <= 0) edges->ending += sharpness;
    if (!sdv_is_semi_sharp(half)) return;
    edges->semi++;
    edges->sum += half;
}

static sdv_sharp_edges sdv_count_sharp_edges(const sdv_level *level, int v)
{
    sdv_sharp_edges edges = { 0, 0, 0, 0, 0, 0 };
    for (int h = level->vertex_first[v]; h >= 0 && level->creased[v]; h = level->vertex_next[h]) {
        int two[2] = { h, sdv_previous(level, h) };
        for (int i = 0; i < 2; i++)
            if (sdv_is_edge_at(level, two[i], i == 0))
                sdv_meet_edge(&edges, level->sharpness[two[i]], sdv_half(level, two[i]));
    }
    return edges;
}

// How a vertex fades, by its own sharpness and its edges.
static sdv_fading sdv_fading_of(float sharpness, const sdv_sharp_edges *edges)
{
    float left = sdv_fade(sharpness), sum = edges->ending;
    int ends = sharpness > 0 && left <= 0, count = edges->now - edges->next + ends;
    float mean = count ? (ends ? sharpness + sum : sum) / (float)count : 0;
    sdv_fading fading;
    fading.rule = sdv_vertex_rule(sharpness, edges->now);
    fading.next = sdv_vertex_rule(left, edges->next);
    fading.weight = (double)(mean < 1 ? mean : 1);
    return fading;
}

// Is nothing at a vertex semi-sharp?
static int sdv_vertex_settled(const sdv_level *level, int v)
{
    int semi = sdv_is_semi_sharp(level->vertex_sharpness[v]);
    for (int h = level->vertex_first[v]; h >= 0 && level->creased[v]; h = level->vertex_next[h])
        semi |= sdv_is_semi_sharp(level->sharpness[h]) ||
                sdv_is_semi_sharp(level->sharpness[sdv_previous(level, h)]);
    return !semi;
}

// The sharpness that is left, one level down, of the seam at a vertex with a partner.
static float sdv_seam_left(const sdv_level *level, int v)
{
    float s = level->seam[v];
    if (!level->half_sharpness) return sdv_fade(s);
    const float *sums = level->sums + 2 * (size_t)level->origin[v];
    return sdv_fade_chaikin(s, sums[0], (int)sums[1]);
}

// How a vertex fades. One of UVs with a partner fades as that does, but, while its seam stays
// semi-sharp, a level later [OSD].
static sdv_fading sdv_vertex_fading(const sdv_level *level, int v)
{
    int partner = level->partner ? level->partner[v] : -1, own = partner >= 0 ? partner : v;
    sdv_fading fading = { SDV_SMOOTH, SDV_SMOOTH, 0 };
    if (!level->creased[own] && level->vertex_sharpness[own] <= 0) return fading;
    sdv_sharp_edges edges = sdv_count_sharp_edges(level, own);
    fading = sdv_fading_of(level->vertex_sharpness[own], &edges);
    if (partner >= 0 && sdv_seam_left(level, v) > 0) fading.next = fading.rule;
    return fading;
}

// The next face-vertex at the same vertex, counter-clockwise, also across a sharp edge. -1 if there
// is none.
static int sdv_around(const sdv_level *level, int h)
{
    int before = sdv_previous(level, h), across = level->across[before];
    return across == before || level->face_vertices[across] != level->face_vertices[h] ? -1
                                                                                       : across;
}

#if !defined(SUBDIV_NO_EXACT) || !defined(SUBDIV_NO_TOOLS)
// The face-vertex on the other side of the smooth edge that leads on from h: the same edge, led
// back. -1 across a sharp edge.
static int sdv_across(const sdv_level *level, int h)
{
    int q = level->across[h];
    return level->sharpness[h] > 0 || q == h ? -1 : q;
}

// The next face-vertex at the same vertex, clockwise and counter-clockwise, or -1.
static int sdv_clockwise(const sdv_level *level, int h)
{
    int across = sdv_across(level, h);
    return across < 0 ? -1 : sdv_next(level, across);
}

static int sdv_counter_clockwise(const sdv_level *level, int h)
{
    int before = sdv_previous(level, h), q = level->across[before];
    return q == before || sdv_sharpness_before(level, before) > 0 ? -1 : q;
}
#endif

// --------------------------------------------------------------------------------- >>masks
// Every rule of refinement, once. A mask is a set of weights that sum to 1. Refinement multiplies
// the points around by these weights and adds them up, whatever the points are. Change a weight
// here, and every point, limit, stencil and explanation follows, as the weights are scaled to sum
// to 1 again (but the face point's, which has to stay 1/n); SUBDIV_EXACT refuses a mask that makes
// no spline.
//
//     point = self v + edge (sum of neighbours) + face (sum of face points)
//                    + crease (sum of the two neighbours along the crease)

typedef struct sdv_mask {
    double self;                        // the vertex itself; for an edge point: each of its ends
    double edge;                        // each vertex at the other end of an edge
    double face;                        // each face point (Loop: each vertex opposite the edge)
    double crease;                      // on top of edge: the two neighbours along the crease
} sdv_mask;

// Scales a mask to sum to 1. ends: 1 of a vertex point, 2 of an edge point; edges, faces: counts.
static sdv_mask sdv_scaled(sdv_mask mask, int ends, int edges, int faces)
{
    double sum = ends * mask.self + edges * mask.edge + faces * mask.face + 2 * mask.crease;
    double scale = fabs(sum - 1) < 1e-9 ? 1 : 1 / sum;      // 1: to the same bits
    sdv_mask scaled = { scale * mask.self, scale * mask.edge, scale * mask.face,
                        scale * mask.crease };
    return scaled;
}

// Face point [CC78]: the mean of the face's n vertices. Returns the weight of each.
//
//     1/n----1/n
//      |  F  |               F = (v0 + v1 + ... ) / n
//     1/n----1/n
static double sdv_face_weight(int n)
{
    return 1.0 / n;
}

// Edge point on a crease or boundary, and any edge point under bilinear: the midpoint.
//
//     1/2---E---1/2          E = (a + b) / 2
static sdv_mask sdv_crease_edge(void)
{
    sdv_mask mask = { 0.5, 0, 0, 0 };
    return sdv_scaled(mask, 2, 0, 0);
}

// Smooth edge point, Catmull-Clark [CC78]: the mean of the two ends and the two face points. Where
// an edge has another number of faces, their points share one half [OSD].
//
//        f0
//     a--E--b                E = (a + b + f0 + f1) / 4
//        f1
static sdv_mask sdv_catmull_clark_edge(int faces)
{
    sdv_mask mask = { 0.25, 0, 0.5 / faces, 0 };
    return sdv_scaled(mask, 2, 0, faces);
}

// Smooth edge point beside one or two triangles, with SUBDIV_TRIANGLES_SMOOTH [OSD]. A triangle has
// w = 0.47, another face w = 1/4. Each face point weighs the mean of the two w; the ends share the
// rest.
static sdv_mask sdv_smooth_triangle_edge(int triangles)
{
    double face = 0.5 * (0.47 * triangles + 0.25 * (2 - triangles));
    sdv_mask mask = { 0.5 - face, 0, face, 0 };
    return sdv_scaled(mask, 2, 0, 2);
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
    return sdv_scaled(mask, 2, 0, faces);
}

// Vertex point of a corner: the vertex stays where it is.
static sdv_mask sdv_corner_vertex(void)
{
    sdv_mask mask = { 1, 0, 0, 0 };
    return sdv_scaled(mask, 1, 0, 0);
}

// Vertex point on a crease or boundary: the cubic B-spline curve along it [HDD94].
//
//     1/8---3/4---1/8        V = (a + 6v + b) / 8
static sdv_mask sdv_crease_vertex(void)
{
    sdv_mask mask = { 0.75, 0, 0, 0.125 };
    return sdv_scaled(mask, 1, 0, 0);
}

// Smooth vertex point, Catmull-Clark, valence n [CC78]: V = (Q + 2R + (n - 3) v) / n, with Q the
// mean of the face points and R the mean of the edges' midpoints, (v + e) / 2 each:
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
    return sdv_scaled(mask, 1, n, n);
}

// Returns the cosine of k/n of a full turn, 0 <= k <= n, plus this many quarter turns. (Cosines of
// C libraries differ in their last bits.) Reduces the angle, exactly for whole k and n, to x of at
// most an eighth of a turn, and sums the series of cos x or sin x. The error is below 2^-52.
static double sdv_circle(double k, double n, int quarters)
{
    double whole = floor(4 * k / n), rest = 4 * k - whole * n, sum = 1;
    int quarter = ((int)whole + quarters) % 4, back = 2 * rest > n, sine = back != quarter % 2;
    double x = (back ? n - rest : rest) / n * (3.14159265358979323846 / 2);
    for (int i = 16 + sine; i > 1; i -= 2) sum = 1 - x * x / (i * (i - 1)) * sum;
    if (sine) sum *= x;
    return quarter == 1 || quarter == 2 ? 0 - sum : sum;
}

static double sdv_cosine(double k, double n) { return sdv_circle(k, n, 0); }
static double sdv_sine(double k, double n)   { return sdv_circle(k, n, 3); }

// Smooth even point, Loop, valence n [Loop87]:
//
//       b---b
//      / \ / \               V = (1 - n b) v + b (sum of neighbours)
//     b---V---b
//      \ / \ /               b = (5/8 - (3/8 + cos(2 pi/n) / 4)^2) / n,  1/16 for n = 6
//       b---b
static sdv_mask sdv_loop_vertex(int n)
{
    double c = 0.375 + 0.25 * sdv_cosine(1, n);
    double b = n == 6 ? 0.0625 : (0.625 - c * c) / n;
    sdv_mask mask = { 1 - n * b, b, 0, 0 };
    return sdv_scaled(mask, 1, n, 0);
}

// Any rule for smooth vertices that weighs means: r R + q Q + (1 - r - q) v. R is the mean of the
// edges' midpoints (Loop: of the neighbours), Q that of the face points.
static sdv_mask sdv_means_vertex(int loop, int n, double r, double q)
{
    double edge = loop ? r / n : r / (2.0 * n), face = q / n;
    sdv_mask mask = { 1 - n * (edge + face), edge, face, 0 };
    return mask;
}

// The rules that are not the standard one [CC78], [DS78], [Warren95]: see subdiv_vertex_rule.
static sdv_mask sdv_ruled_vertex(subdiv_vertex_rule rule, int n)
{
    if (rule == SUBDIV_VERTEX_AVERAGED) return sdv_means_vertex(0, n, 0.5, 0.25);
    if (rule == SUBDIV_VERTEX_DOO_SABIN) return sdv_means_vertex(0, n, 1.0 / n, 1.0 / n);
    return sdv_means_vertex(1, n, rule == SUBDIV_VERTEX_WARREN && n == 3 ? 0.5625 : 0.375, 0);
}

// Blends a sharp mask with this weight and a smooth one with the rest [DKT98].
static sdv_mask sdv_blend(double weight, sdv_mask sharp, sdv_mask smooth)
{
    sdv_mask mask;
    mask.self = weight * sharp.self + (1 - weight) * smooth.self;
    mask.edge = weight * sharp.edge + (1 - weight) * smooth.edge;
    mask.face = weight * sharp.face + (1 - weight) * smooth.face;
    mask.crease = weight * sharp.crease + (1 - weight) * smooth.crease;
    return mask;
}

// Return the smooth masks of the scheme. (Bilinear has no smooth points and uses neither.)
static sdv_mask sdv_smooth_vertex(const sdv_rules *rules, int faces)
{
    if (rules->vertex_masks) return rules->vertex_masks[faces];
    if (rules->vertex_rule) return sdv_ruled_vertex(rules->vertex_rule, faces);
    return rules->loop ? sdv_loop_vertex(faces) : sdv_catmull_clark_vertex(faces);
}

static sdv_mask sdv_smooth_edge(const sdv_rules *rules, int faces)
{
    return rules->loop ? sdv_loop_edge(faces) : sdv_catmull_clark_edge(faces);
}

// Returns the mask of a vertex point: that of its rule or, where the next level has another rule, a
// blend of the two.
static sdv_mask sdv_vertex_mask(const sdv_rules *rules, sdv_fading fading, int faces)
{
    sdv_mask masks[SDV_CORNER + 1];
    if (faces == 0) return sdv_corner_vertex();
    masks[SDV_SMOOTH] = masks[SDV_DART] = sdv_smooth_vertex(rules, faces);
    masks[SDV_CREASE] = sdv_crease_vertex();
    masks[SDV_CORNER] = sdv_corner_vertex();
    if (rules->linear) return masks[SDV_CORNER];
    if (fading.rule < SDV_CREASE || fading.rule == fading.next) return masks[fading.rule];
    return sdv_blend(fading.weight, masks[fading.rule], masks[fading.next]);
}

// Returns the mask of an edge point: that of a crease while both halves of a sharp edge stay sharp,
// a blend with the smooth mask where a half turns smooth. triangles: how many of the edge's two
// faces are triangles, under SUBDIV_TRIANGLES_SMOOTH; else 0.
static sdv_mask sdv_edge_mask(const sdv_rules *rules, float sharpness, int stays_sharp,
                              int faces, int triangles)
{
    if (rules->linear || (sharpness > 0 && stays_sharp)) return sdv_crease_edge();
    sdv_mask smooth = triangles && !rules->loop ? sdv_smooth_triangle_edge(triangles)
                                                : sdv_smooth_edge(rules, faces);
    if (sharpness <= 0) return smooth;
    return sdv_blend((double)(sharpness < 1 ? sharpness : 1), sdv_crease_edge(), smooth);
}

// Limit masks say where a vertex ends up when refinement goes on forever, and how the surface lies
// there. They are left eigenvectors of one step of refinement around the vertex: for the point, of
// eigenvalue 1; for tangents, whose weights sum to 0, of the next largest. So they follow from the
// masks above, whatever weights these have. They are for levels from 1 on, where all faces are
// quads (Loop: triangles), and for vertices where nothing fades any more: see >>limit-rows.
//
// Limit point of a smooth vertex, valence n [HKD93], [Loop87], from the weights of the vertex mask
// (v.edge, v.face) and of the edge mask (self, face). Regular: 4/9, 1/9, 1/36; Loop 1/2, 1/12.
//
//     f----e----f            P = (v + y (sum of e) + z (sum of f)) / (1 + n (y + z))
//     |    |    |
//     e----v----e            y = (v.edge + 2/3 v.face) / (1/2 - face/3)
//     |    |    |            z = (v.face + 2 face y) / 3
//     f----e----f            Loop:  y = v.edge / (1 - self - 2 face)    z = 0
static sdv_mask sdv_smooth_limit(const sdv_rules *rules, int n)
{
    sdv_mask v = sdv_smooth_vertex(rules, n), edge = sdv_smooth_edge(rules, 2);
    double y = rules->loop ? v.edge / (1 - edge.self - 2 * edge.face)
                           : (v.edge + 2 * v.face / 3) / (0.5 - edge.face / 3);
    double z = rules->loop ? 0 : (v.face + 2 * edge.face * y) / 3, all = 1 + n * (y + z);
    sdv_mask mask = { 1 / all, y / all, z / all, 0 };
    return mask;
}

// Limit point on a crease or boundary: on the curve along it, a cubic B-spline [HDD94].
//
//     1/6---2/3---1/6        P = (v + y (a + b)) / (1 + 2 y)      y = v.crease / (1 - self)
static sdv_mask sdv_crease_limit(void)
{
    double y = sdv_crease_vertex().crease / (1 - sdv_crease_edge().self), all = 1 + 2 * y;
    sdv_mask mask = { 1 / all, 0, 0, y / all };
    return mask;
}

// Points of Chaikin's corner cutting [Chaikin74]: a vertex of a curve becomes two, one on each of
// its edges. self: the vertex, edge: the other end.
//
//     1/4----P-3/4-P----1/4        P = (a + 3v) / 4 and (3v + b) / 4
static sdv_mask sdv_chaikin_point(void)
{
    sdv_mask mask = { 0.75, 0.25, 0, 0 };
    return sdv_scaled(mask, 1, 1, 0);
}

// Limit point of such a vertex, on a quadratic B-spline: the midpoint of its two points. They make
// an edge, and what each cut leaves of an edge has the same midpoint.
//
//     1/8---6/8---1/8        P = self v + edge/2 (a + b)
static sdv_mask sdv_chaikin_limit(void)
{
    sdv_mask mask = { sdv_chaikin_point().self, 0, 0, sdv_chaikin_point().edge / 2 };
    return mask;
}

// A wave around a vertex is a set of weights that one step of refinement only scales, by the
// eigenvalue L. Neighbour i weighs 4 cos(i a). The vertex f across a quad weighs g times the sum of
// the cosines of the neighbours beside it. With self and face the weights of the edge mask:
//
//     L = (b + sqrt(b^2 - 16 self)) / 8      b = 1 + 4 self + 2 face (1 + cos a)
//     g = 4 face / (4 L - 1)                 Loop:  L = self + 2 face cos a
typedef struct sdv_wave {
    double factor, face;                // L and g
} sdv_wave;

// Returns the wave of n neighbours, a = 2 pi/n. For fewer than 3, g is left 0.
static sdv_wave sdv_wave_of(const sdv_rules *rules, double n)
{
    sdv_mask edge = sdv_smooth_edge(rules, 2);
    double cosine = sdv_cosine(1, n), b = 1 + 4 * edge.self + 2 * edge.face * (1 + cosine);
    sdv_wave wave = { edge.self + 2 * edge.face * cosine, 0 };
    if (rules->loop) return wave;
    wave.factor = (b + sqrt(b * b - 16 * edge.self)) / 8;
    if (n > 2) wave.face = 4 * edge.face / (4 * wave.factor - 1);
    return wave;
}

// A spike is the same all around: one step of refinement is a 2 x 2 matrix for the means of e and f
// less v, with two eigenvalues, of sum T and product D. Loop has only one eigenvalue:
//
//     T = 3/4 - P - 3/4 Q    D = (1/2 - P - Q/2) (1/4 - face/2)    P, Q = n times v.edge, v.face
//     Loop:  self + 2 face - P
//
// Returns the size of the larger one. If it is below 1, the vertex has a limit. If it is below L of
// the wave a = 2 pi/n, that wave outlasts the spike: the vertex has a tangent plane [Loop87].
static double sdv_spike_of(const sdv_rules *rules, int n)
{
    sdv_mask v = sdv_smooth_vertex(rules, n), edge = sdv_smooth_edge(rules, 2);
    double p = n * v.edge, q = n * v.face, half = (0.75 - p - 0.75 * q) / 2;
    double d = (0.5 - p - q / 2) * (0.25 - edge.face / 2), root = half * half - d;
    if (rules->loop) return fabs(edge.self + 2 * edge.face - p);
    return root < 0 ? sqrt(d) : fabs(half) + sqrt(root);
}

// Tangents t0 t1 at a smooth vertex, a = 2 pi/n [HKD93], [Loop87]: weights of v, of each e and of
// each f, counter-clockwise from any e. t0 x t1 is along the normal; their lengths mean nothing.
//
//     t0 = sum of  4 cos(i a) e_i + g (cos(i a) + cos((i+1) a)) f_i       t1: the same with sin
//
// f_i stands between e_i and e_(i+1); Loop has no f. Valence 2 has only one such wave. Two quads
// back to back have no tangent plane: e_0 - e_1 and f_0 - f_1 span the mean of their planes. Two
// triangles make a cusp and have no t1. A spike has neither.
static void sdv_smooth_tangents(const sdv_rules *rules, int n, double *t0, double *t1)
{
    sdv_wave wave = sdv_wave_of(rules, n);
    double g = wave.face, room = wave.factor - sdv_spike_of(rules, n);
    t0[0] = t1[0] = 0;
    for (int i = 0; i < n; i++) {
        t0[1 + i] = 4 * sdv_cosine(i, n);
        t1[1 + i] = n > 2 ? 4 * sdv_sine(i, n) : 0;
    }
    for (int i = 0; i < n && !rules->loop; i++) {
        int next = 1 + (i + 1) % n;
        t0[1 + n + i] = g / 4 * (t0[1 + i] + t0[next]);
        t1[1 + n + i] = n == 2 ? 1 - 2 * i : g / 4 * (t1[1 + i] + t1[next]);
    }
    for (int i = 0; i <= (rules->loop ? n : 2 * n) && room < (n > 2 ? 1e-9 : -1e-9); i++)
        t0[i] = t1[i] = 0;
}

// Tangents at a crease or boundary, for the side with k faces, from the mask of its vertex point.
// e_0 and e_k are on the crease, so t0 = e_0 - e_k. t1 leads across ([BLZ00] and [HDD94] have
// others, as their faces refine in other ways). It is half a wave, a = pi/k, with weights x of the
// two ends and y of v that make it an eigenvector:
//
//     t1 = sum of  4 sin(i a) e_i + g (sin(i a) + sin((i+1) a)) f_i  +  x (e_0 + e_k) + y v
//
//     (L - c) x - v.crease y = p       c: self of the edge mask on a crease
//     (L - v.self) y - 2 c x = q       p, q: what the wave gives to e_0 and to v
//     p = (g / 4 + face) sin a         q = (4 self + 2 face + g / 2) r
//     Loop:  p = 4 face sin a          q = 4 self r         r = (1 + cos a) / sin a = cot a/2
//
// At a regular vertex k = 2, so t1 = 4 e_1 + f_0 + f_1 - e_0 - e_2 - 4v; Loop k = 3. A single face
// fills a straight angle: t1 = e_0 + e_1 - 2v, the way the curve bends.
//
// A corner between two creases has such tangents, by the mask of its vertex point. Where the wave
// shrinks faster than the creases, only their plane remains: t1 = e_0 + e_k - 2v. Where it shrinks
// as fast (L = c), it turns to that plane a little on each level: t1 is where it is after some
// three thousand. Where it shrinks more slowly, the surface ends in a spike, which has no tangent
// plane; t0 and t1 span the mean of its faces' planes.
static void sdv_crease_tangents(const sdv_rules *rules, sdv_mask v, int k, double *t0, double *t1)
{
    sdv_mask edge = sdv_smooth_edge(rules, 2);
    double r = sdv_cosine(1, 4.0 * k) / sdv_sine(1, 4.0 * k), sine = sdv_sine(1, 2.0 * k);
    double c = sdv_crease_edge().self;
    sdv_wave wave = sdv_wave_of(rules, 2.0 * k);
    double g = wave.face, end = wave.factor - c, middle = wave.factor - v.self;
    int corner = v.crease <= 0, plane = k == 1 || (corner && end < -1e-9);
    if (corner && end < 0.0003) end = 0.0003;
    double p = rules->loop ? 4 * edge.face * sine : (g / 4 + edge.face) * sine;
    double q = (rules->loop ? 4 * edge.self : 4 * edge.self + 2 * edge.face + g / 2) * r;
    double determinant = end * middle - 2 * c * v.crease;
    for (int i = 0; i <= k; i++) {
        t0[1 + i] = 0;
        t1[1 + i] = plane ? 0 : 4 * sdv_sine(i, 2.0 * k);
    }
    for (int i = 0; i < k && !rules->loop; i++) {
        t0[2 + k + i] = 0;
        t1[2 + k + i] = g / 4 * (t1[1 + i] + t1[2 + i]);
    }
    t0[0] = 0;
    t0[1] = 1;
    t0[1 + k] = -1;
    t1[0] = plane ? -2 : (end * q + 2 * c * p) / determinant;
    t1[1] = t1[1 + k] = plane ? 1 : (middle * p + v.crease * q) / determinant;
}

// Returns the limit mask of a vertex that has a rule and so many faces. A corner stays.
static sdv_mask sdv_limit_mask(const sdv_rules *rules, sdv_rule rule, int faces)
{
    if (rule == SDV_CORNER || rules->linear) return sdv_corner_vertex();
    return rule == SDV_CREASE ? sdv_crease_limit() : sdv_smooth_limit(rules, faces);
}

// Whether the masks of regular vertices and edges are those of cubic B-splines (Loop: of box
// splines). SUBDIV_EXACT relies on it: its patches are such splines.
static int sdv_is_spline(const sdv_rules *rules)
{
    static const double splines[2][6] = { { 0.5, 0.0625, 0.0625, 0.25, 0.25, 0.125 },
                                          { 0.625, 0.0625, 0, 0.375, 0.125, 0.125 } };
    sdv_mask v = sdv_smooth_vertex(rules, rules->loop ? 6 : 4), edge = sdv_smooth_edge(rules, 2);
    double weights[6] = { v.self, v.edge, v.face, edge.self, edge.face,
                          sdv_crease_vertex().crease }, off = 0;
    for (int i = 0; i < 6; i++) off += fabs(weights[i] - splines[rules->loop][i]);
    return rules->linear || off < 1e-9;
}

// ---------------------------------------------------------------------------------- >>curves
// A curve is refined channel by channel, in place, from its last point to the first: so a new point
// takes the place of an old one when that is no longer needed.

static void sdv_check_values(sdv_context *context, const void *surface, int channels,
                             const void *values, int *stride);        // see >>evaluate

// Adds up a mask for a vertex and the two beside it, as >>rows does.
static float sdv_curve_vertex(sdv_mask mask, float v, float a, float b)
{
    float w = (float)mask.crease;
    return v + (w * (a - v) + w * (b - v));
}

// Makes the next level of n points. Each becomes two: its vertex point and that of the edge behind
// it, under Chaikin one on either side. At the ends of an open curve some of them are missing.
static void sdv_refine_curve(subdiv_curve_rule rule, subdiv_curve_ends ends, int n, float *points,
                             size_t stride)
{
    float middle = (float)sdv_crease_edge().self, corner = (float)sdv_chaikin_point().edge;
    float back = points[stride * (size_t)(n - 1)], after = points[0], made[2];
    int open = ends != SUBDIV_ENDS_CLOSED, cut = ends == SUBDIV_ENDS_CUT;
    int spline = rule == SUBDIV_CURVE_B_SPLINE;
    for (int i = n - 1; i >= 0; i--) {
        int first = open && i == 0, last = open && i == n - 1;
        float v = points[stride * (size_t)i];
        float before = first ? v : i > 0 ? points[stride * (size_t)(i - 1)] : back;
        if (last) after = v;
        made[0] = sdv_curve_vertex(first || last ? sdv_corner_vertex() : sdv_crease_vertex(),
                                   v, before, after);
        made[1] = v + (spline ? middle : corner) * (after - v);
        if (!spline) made[0] = v + corner * (before - v);
        for (int k = first && cut; k < 2 - last * (spline + cut); k++)
            points[stride * (size_t)(2 * i + k - cut)] = made[k];
        after = v;
    }
}

// Moves n points to the limit, but for the ends of an open curve.
static void sdv_limit_curve(subdiv_curve_rule rule, int open, int n, float *points, size_t stride)
{
    sdv_mask mask = rule == SUBDIV_CURVE_CHAIKIN ? sdv_chaikin_limit() : sdv_crease_limit();
    float front = points[0], before = open ? front : points[stride * (size_t)(n - 1)];
    for (int i = open; i < n - open; i++) {
        float *v = points + stride * (size_t)i, after = i + 1 < n ? v[stride] : front, now = *v;
        *v = sdv_curve_vertex(mask, now, before, after);
        before = now;
    }
}

// Returns how many points n points become. So many as `stay` always stay; what is more doubles.
static int sdv_count_curve(sdv_context *context, subdiv_curve_rule rule, subdiv_curve_ends ends,
                           int n, int levels)
{
    int cut = ends == SUBDIV_ENDS_CUT, spline = rule == SUBDIV_CURVE_B_SPLINE;
    int stay = ends == SUBDIV_ENDS_CLOSED ? 0 : spline + 2 * cut;
    if ((unsigned)rule > SUBDIV_CURVE_CHAIKIN || (unsigned)ends > SUBDIV_ENDS_CLOSED || n < 0 ||
        levels < 0 || (n > 0 && n < 3 && cut))
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "no curve has rule %d, ends %d and %d points on "
                 "level %d", (int)rule, (int)ends, n, levels);
    if (n == 0) sdv_fail(context, SUBDIV_ERROR_EMPTY, "the curve has no points");
    if (levels > 30 || (!context->result && ((int64_t)(n - stay) << levels) + stay > INT_MAX))
        sdv_fail(context, SUBDIV_ERROR_TOO_LARGE, "%d levels are too many of %d points", levels, n);
    return context->result ? 0 : ((n - stay) << levels) + stay;
}

SUBDIV_DEF int subdiv_curve_point_count(subdiv_curve_rule rule, subdiv_curve_ends ends,
                                        int point_count, int levels)
{
    sdv_context context = sdv_begin(NULL);
    return sdv_count_curve(&context, rule, ends, point_count, levels);
}

SUBDIV_DEF subdiv_result subdiv_curve(subdiv_curve_rule rule, subdiv_curve_ends ends, int levels,
                                      int channels, int point_count, const float *in,
                                      int in_stride, float *out, int out_stride,
                                      const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_check_values(&context, out, channels, in, &in_stride);
    sdv_check_values(&context, out, channels, out, &out_stride);
    int count = sdv_count_curve(&context, rule, ends, point_count, levels);
    for (int k = 0; k < channels && count; k++) {
        size_t stride = (size_t)out_stride;
        for (size_t i = 0; i < (size_t)point_count; i++)
            out[stride * i + (size_t)k] = in[(size_t)in_stride * i + (size_t)k];
        for (int level = 0; level < levels; level++)
            sdv_refine_curve(rule, ends, sdv_count_curve(&context, rule, ends, point_count, level),
                             out + k, stride);
        if (opt && opt->limit)
            sdv_limit_curve(rule, ends != SUBDIV_ENDS_CLOSED, count, out + k, stride);
    }
    return context.result;
}

// ----------------------------------------------------------------------------------- >>order
// THE ORDER OF THE RESULT (see the top) as formulas. A cage face has a grid: a quad or a Loop
// triangle one of n = 2^levels segments a side, any other polygon one of m = n / 2 segments for
// each of its vertices. Corners and, between them, sides have these numbers:
//
//     3---2---2     2            Side 0 is row 0, side 3 is column 0. A triangle has no corner 3
//     |       |     | \          and no side 2.
//     3       1     3   1
//     |       |     |     \      The points inside a side or a row are evenly spaced in the result:
//     0---0---1     0---0---1    a first index and a step give all of them.

enum { SDV_MOST_LEVELS = 16 };          // 0 to 15: level 16 of a quad has 2^32 faces
#ifndef SDV_FULL_LEVELS                 // (tests ask for fewer)
#define SDV_FULL_LEVELS 3               // levels up to here keep whole grids, deeper ones frames
#endif

typedef struct sdv_side {               // the points inside a side of a grid
    int first, step;                    // point t has index first + step * t, 0 < t < segments
} sdv_side;

typedef struct sdv_grid {               // the indices of the points of a grid
    int columns, rows;                  // segments along a side
    int triangle;                       // row r has columns 0 to columns - r
    int inside;                         // the index of row 1, column 1
    int corner[4];
    sdv_side side[4];                   // t is the column on sides 0 and 2, the row on 1 and 3
    int frame;                          // its inside is a frame: see sdv_frame_point
} sdv_grid;

typedef struct sdv_order {              // the indices of all points of a level or of the result
    sdv_level cage;                     // faces and edges alone
    int loop, n, m;
    int first_edge_point, first_inside_point;
    int count;                          // of points
    int frame;                          // all grids are frames
    const int *quads;                   // [faces + 1] of frames: how many quads come before each
} sdv_order;                            // face; NULL: all faces are quads

// Returns a side of size segments whose points have indices first, first + 1, ..., seen from the
// end where they begin or, backwards, from the other.
static inline sdv_side sdv_seen_side(int first, int size, int backwards)
{
    sdv_side side = { backwards ? first - 1 + size : first - 1, backwards ? -1 : 1 };
    return side;
}

// Returns a cage edge seen from its lower-numbered end or, backwards, from the other.
static inline sdv_side sdv_seen_edge(const sdv_order *order, int edge, int backwards)
{
    int n = order->n;
    return sdv_seen_side(order->first_edge_point + edge * (n - 1), n, backwards);
}

// Returns the cage edge that leads on from face-vertex h, seen from h or from its other end.
static inline sdv_side sdv_edge_side(const sdv_order *order, int h, int backwards)
{
    const sdv_level *cage = &order->cage;
    int a = cage->face_vertices[h], b = cage->face_vertices[sdv_next(cage, h)];
    return sdv_seen_edge(order, cage->face_edges[h], (a > b) != backwards);
}

// Returns the first point inside face f. Whole: a face has 1 + m (m - 1) * vertices points inside,
// a triangle under Loop (n - 1)(n - 2) / 2. Frames: a quad has 4 (n - 2), a triangle 3 (n - 3), any
// other polygon its centre, the points of its spokes and the frames of its quads.
static int sdv_first_inside(const sdv_order *order, int f)
{
    int n = order->n, m = order->m, first = order->first_inside_point;
    if (order->loop) return first + f * (order->frame ? 3 * (n - 3) : (n - 1) * (n - 2) / 2);
    int sides = sdv_face_start(&order->cage, f);
    if (!order->frame) return first + f + sides * (m * (m - 1));
    int quads = order->quads ? order->quads[f] : f;
    return first + quads * 4 * (n - 2) + f - quads + (sides - 4 * quads) * (m - 1 + 4 * (m - 2));
}

// Returns the cage face that has the point inside it.
static int sdv_face_inside(const sdv_order *order, int point)
{
    int low = 0, high = order->cage.face_count;
    while (low + 1 < high) {
        int middle = low + (high - low) / 2;
        if (sdv_first_inside(order, middle) <= point) low = middle;
        else high = middle;
    }
    return low;
}

// Whether face f has one grid for each of its vertices.
static int sdv_is_ngon(const sdv_order *order, int f)
{
    return !order->loop && sdv_face_end(&order->cage, f) - sdv_face_start(&order->cage, f) != 4;
}

// Returns how many grids face f has.
static int sdv_grids_of(const sdv_order *order, int f)
{
    return sdv_is_ngon(order, f) ? sdv_face_end(&order->cage, f) - sdv_face_start(&order->cage, f)
                                 : 1;
}

// Fills in the grid of a face that has one, from its first face-vertex h on. Its sides are edges:
// sides 2 and 3 run against the order of the face's vertices.
static void sdv_face_grid(const sdv_order *order, int h, sdv_grid *grid)
{
    const int *v = order->cage.face_vertices + h, *e = order->cage.face_edges + h;
    int last = order->loop ? 2 : 3;
    grid->columns = grid->rows = order->n;
    grid->triangle = order->loop;
    for (int i = 0; i <= last; i++) grid->corner[i] = v[i];
    grid->side[0] = sdv_seen_edge(order, e[0], v[0] > v[1]);
    grid->side[1] = sdv_seen_edge(order, e[1], v[1] > v[2]);
    grid->side[2] = sdv_seen_edge(order, e[2], v[2] <= v[last]);
    grid->side[3] = sdv_seen_edge(order, e[last], v[last] <= v[0]);
}

// Returns the first point inside grid i of a polygon with so many sides. Its centre comes first,
// then the points inside its spokes, each of m segments, then those inside its grids.
static int sdv_inside_ngon(int centre, int sides, int m, int i)
{
    return centre + 1 + sides * (m - 1) + i * (m - 1) * (m - 1);
}

// Fills in grid i of an n-gon. Corners: the vertex, the middle of the edge, the centre, the middle
// of the edge before. Sides: half of the edge, two spokes, half of the edge before.
static void sdv_ngon_grid(int vertex, sdv_side edge, sdv_side edge_before, int centre, int sides,
                          int m, int i, sdv_grid *grid)
{
    int spokes = centre + 1, before = i > 0 ? i - 1 : sides - 1;
    grid->columns = grid->rows = m;
    grid->triangle = grid->frame = 0;
    grid->inside = sdv_inside_ngon(centre, sides, m, i);
    grid->side[0] = edge;
    grid->side[1] = sdv_seen_side(spokes + i * (m - 1), m, 1);
    grid->side[2] = sdv_seen_side(spokes + before * (m - 1), m, 1);
    grid->side[3] = edge_before;
    grid->corner[0] = vertex;
    grid->corner[1] = edge.first + edge.step * m;
    grid->corner[2] = centre;
    grid->corner[3] = edge_before.first + edge_before.step * m;
}

// Returns the first point inside grid i of face f.
static int sdv_inside_grid(const sdv_order *order, int f, int i)
{
    const sdv_level *cage = &order->cage;
    int first = sdv_first_inside(order, f), m = order->m;
    if (!sdv_is_ngon(order, f)) return first;
    int sides = sdv_face_end(cage, f) - sdv_face_start(cage, f);
    return order->frame ? first + 1 + sides * (m - 1) + i * 4 * (m - 2)
                        : sdv_inside_ngon(first, sides, m, i);
}

// Fills in the grid at face-vertex h: the first one of its face, if the face has a single grid.
static void sdv_grid_at(const sdv_order *order, int h, sdv_grid *grid)
{
    const sdv_level *cage = &order->cage;
    int f = sdv_face_of(cage, h), start = sdv_face_start(cage, f);
    if (!sdv_is_ngon(order, f)) sdv_face_grid(order, h, grid);
    else sdv_ngon_grid(cage->face_vertices[h], sdv_edge_side(order, h, 0),
                       sdv_edge_side(order, sdv_previous(cage, h), 1), sdv_first_inside(order, f),
                       sdv_face_end(cage, f) - start, order->m, h - start, grid);
    grid->inside = sdv_inside_grid(order, f, h - start);
    grid->frame = order->frame;
}

static int sdv_side_index(const sdv_grid *grid, int side, int t)
{
    return grid->side[side].first + grid->side[side].step * t;
}

// Returns the index of a point inside a whole grid. Row 1, column 1 has index first, and the others
// follow row by row; in a triangle each row is one point shorter.
static int sdv_inside_point(int first, int columns, int triangle, int row, int column)
{
    int64_t r = row - 1, cut = triangle ? r * row / 2 : 0;
    return (int)(first + r * (columns - 1) - cut) + column - 1;
}

// Returns the index of a point of a frame: the ring of points beside a grid's sides. Deep levels
// keep no other points inside a grid. sdv_frame_rows makes them. Only points beside the spokes of a
// polygon are asked for: those in the last row or column of a quad's frame.
//
//     o . . . o
//     . 6 5 4 .       the frame of a quad with n = 4: points 0 to 4 (n - 2) - 1, counter-clockwise
//     . 7   3 .       from row 1, column 1 on; that of a triangle has 3 (n - 3) points
//     . 0 1 2 .
//     o . . . o
static int sdv_frame_point(const sdv_grid *grid, int row, int column)
{
    int n = grid->columns;
    return grid->inside + (column == n - 1 ? n - 3 + row : 3 * n - 5 - column);
}

static int sdv_inside_index(const sdv_grid *grid, int row, int column)
{
    if (grid->frame) return sdv_frame_point(grid, row, column);
    return sdv_inside_point(grid->inside, grid->columns, grid->triangle, row, column);
}

// Returns the index of a point. The last row of a triangle is one point, at its right end.
static int sdv_grid_index(const sdv_grid *grid, int row, int column)
{
    int top = row == grid->rows, right = column + grid->triangle * row == grid->columns;
    if ((row == 0 || top) && (column == 0 || right)) return grid->corner[top ? 3 - right : right];
    if (row == 0) return sdv_side_index(grid, 0, column);
    if (right) return sdv_side_index(grid, 1, row);
    if (top) return sdv_side_index(grid, 2, column);
    if (column == 0) return sdv_side_index(grid, 3, row);
    return sdv_inside_index(grid, row, column);
}

typedef struct sdv_row {                // a part of a row of points
    sdv_side line;                      // the points between its two ends
    int size, left, right;              // segments; the two ends
} sdv_row;

// Returns a row from column first to column last. Its points are evenly spaced; its two ends may
// stand elsewhere.
static sdv_row sdv_grid_row(const sdv_grid *grid, int row, int first, int last)
{
    sdv_row points = { { sdv_inside_index(grid, row, 0), 1 }, last - first, 0, 0 };
    if (row == 0) points.line = grid->side[0];
    else if (!grid->triangle && row == grid->rows) points.line = grid->side[2];
    points.line.first += points.line.step * first;
    points.left = sdv_grid_index(grid, row, first);
    points.right = sdv_grid_index(grid, row, last);
    return points;
}

static int *sdv_put_face3(int *out, int a, int b, int c)
{
    out[0] = a;
    out[1] = b;
    out[2] = c;
    return out + 3;
}

static int *sdv_put_face4(int *out, int a, int b, int c, int d)
{
    out[0] = a;
    out[1] = b;
    out[2] = c;
    out[3] = d;
    return out + 4;
}

// Writes the fine faces between two rows of points, low and high: quads a b c d. The loop takes the
// rows' ends for points of their lines; they are corrected behind it. Its counters are unsigned,
// as they may step beyond INT_MAX at the end.
//
//     d c
//     a b
static int *sdv_quad_faces(const sdv_row *low, const sdv_row *high, int *out)
{
    unsigned along = (unsigned)low->line.step, above = (unsigned)high->line.step;
    unsigned a = (unsigned)low->line.first, d = (unsigned)high->line.first;
    unsigned b = a + along, c = d + above;
    int *first = out;
    for (int i = 0; i < low->size; i++, out += 4) {
        out[0] = (int)a;
        out[1] = (int)b;
        out[2] = (int)c;
        out[3] = (int)d;
        a += along;
        b += along;
        c += above;
        d += above;
    }
    first[0] = low->left;
    first[3] = high->left;
    out[-3] = low->right;
    out[-2] = high->right;
    return out;
}

// Writes the fine faces between two rows of points: triangles a b d, each but the last followed by
// c d b, turned by half.
static int *sdv_triangle_faces(const sdv_row *low, const sdv_row *high, int *out)
{
    int a = low->left, d = high->left;
    int b = low->line.first + low->line.step, c = high->line.first + high->line.step;
    for (int i = 1; i < low->size; i++) {
        if (i == high->size) c = high->right;
        out = sdv_put_face3(out, a, b, d);
        out = sdv_put_face3(out, c, d, b);
        a = b;
        d = c;
        b += low->line.step;
        c += high->line.step;
    }
    return sdv_put_face3(out, a, low->right, d);
}

// Writes the fine faces between two rows and two columns of points. In a triangle each row ends one
// column earlier than the one below.
static int *sdv_grid_faces(const sdv_grid *grid, int bottom, int top, int left, int right,
                           int *out)
{
    int triangle = grid->triangle;
    sdv_row low = sdv_grid_row(grid, bottom, left, right - bottom * triangle);
    for (int row = bottom + 1; row <= top; row++) {
        sdv_row high = sdv_grid_row(grid, row, left, right - row * triangle);
        out = triangle ? sdv_triangle_faces(&low, &high, out) : sdv_quad_faces(&low, &high, out);
        low = high;
    }
    return out;
}

// Writes the fine faces of cage face f on level 1, where every edge has one point inside.
static int *sdv_level_1_faces(const sdv_order *order, int f, int *out)
{
    int start = sdv_face_start(&order->cage, f), size = sdv_face_end(&order->cage, f) - start;
    const int *v = order->cage.face_vertices + start, *edges = order->cage.face_edges + start;
    int first = order->first_edge_point, centre = sdv_first_inside(order, f);
    int e0 = first + edges[0], e1 = first + edges[1], e2 = first + edges[2];
    int last = first + edges[size - 1];
    if (order->loop) {
        out = sdv_put_face3(out, v[0], e0, e2);
        out = sdv_put_face3(out, e1, e2, e0);
        out = sdv_put_face3(out, e0, v[1], e1);
        return sdv_put_face3(out, e2, e1, v[2]);
    }
    if (size == 4) {
        out = sdv_put_face4(out, v[0], e0, centre, last);
        out = sdv_put_face4(out, e0, v[1], e1, centre);
        out = sdv_put_face4(out, last, centre, e2, v[3]);
        return sdv_put_face4(out, centre, e1, v[2], e2);
    }
    for (int i = 0; i < size; i++) {
        out = sdv_put_face4(out, v[i], first + edges[i], centre, last);
        last = first + edges[i];
    }
    return out;
}

// An infinitely sharp crease has a normal on each side. That of its first side is the normal of the
// point. Those of the others stand behind the points' normals: first those at vertices of the cage,
// then those inside its edges, as points inside edges stand.
typedef struct sdv_sides {
    int  vertices, edges;               // how many other sides vertices and edges have
    int *vertex, *edge;                 // [face-vertices] the number of such a side that its face
                                        //      is on, at its vertex and at its edge; or -1
    int *vertex_home, *edge_home;       // [vertices, edges] the face-vertex that makes each
} sdv_sides;

// Returns how many normals there are but the points', with n - 1 points inside an edge.
static int64_t sdv_count_sides(const sdv_sides *sides, int n)
{
    return sides->vertices + (int64_t)sides->edges * (n - 1);
}

// Returns where the normals of the points inside the edge of h stand, as seen from its face, behind
// those of the points themselves.
static int sdv_side_shift(const sdv_order *order, const sdv_sides *sides, int h)
{
    int along = order->n - 1, edge = order->cage.face_edges[h], side = sides->edge[h];
    if (side < 0) return 0;
    return order->count + sides->vertices + side * along - order->first_edge_point - edge * along;
}

// Replaces the points of the grid at face-vertex h by their normals as seen from its face.
static void sdv_see_sides(const sdv_order *order, const sdv_sides *sides, int h, sdv_grid *grid)
{
    const sdv_level *cage = &order->cage;
    int ngon = sdv_is_ngon(order, sdv_face_of(cage, h)), corners = ngon ? 1 : order->loop ? 3 : 4;
    for (int i = 0; i < corners; i++) {
        int side = order->loop && i == 2 ? 3 : i;
        grid->side[side].first += sdv_side_shift(order, sides, h + i);
        if (sides->vertex[h + i] >= 0) grid->corner[i] = order->count + sides->vertex[h + i];
    }
    if (!ngon) return;
    int before = sdv_side_shift(order, sides, sdv_previous(cage, h));
    grid->side[3].first += before;
    grid->corner[1] += sdv_side_shift(order, sides, h);         // the middles of two edges
    grid->corner[3] += before;
}

// Writes the fine faces of cage face f: points or, with sides, normals. Returns the place behind.
static int *sdv_fine_faces(const sdv_order *order, const sdv_sides *sides, int f, int *out)
{
    int start = sdv_face_start(&order->cage, f), grids = sdv_grids_of(order, f);
    if (order->n == 2 && !sides) return sdv_level_1_faces(order, f, out);
    for (int h = start; h < start + grids; h++) {
        sdv_grid grid;
        sdv_grid_at(order, h, &grid);
        if (sides) sdv_see_sides(order, sides, h, &grid);
        out = sdv_grid_faces(&grid, 0, grid.rows, 0, grid.columns, out);
    }
    return out;
}

// ---------------------------------------------------------------------------------- >>rows
// A row is a mask written out: the index of the point it makes (the target), the work points to add
// up, and their weights. The work points of all levels stand in one array: level 0, then level 1,
// and so on. So to evaluate a row, one need not know about levels.
//
// As weights sum to 1, a row's sum is
//
//     p0 + w1 (p1 - p0) + w2 (p2 - p0) + ...
//
// whose rounding errors are those of the small differences: exact wherever the mesh stands. Most
// masks have one or two weights beside the first: p0 + w ((p1 - p0) + (p2 - p0) + ..).
//
// Rows of the same shape stand in a batch, whose loop needs no branch for a point and keeps weights
// in registers. Batches stand in blocks. A block has the rows of SDV_BLOCK_FACES cage faces, so
// that any range of faces can be made alone.

#ifdef SUBDIV_PLAIN                     // asks a mask for every point, see >>plain
enum { SDV_IS_PLAIN = 1 };
#else
enum { SDV_IS_PLAIN = 0 };
#endif

// Four weights are enough: of the first points, of neighbours along a crease, of others, of faces.
enum { SDV_RUNS = 4 };

typedef struct sdv_runs {               // the weights of a row, each for a run of its points
    float weight[SDV_RUNS];
    int   count[SDV_RUNS];              // points of each run
    int   blend;                        // of two rules, by weights that hardly any other row has
} sdv_runs;

enum { SDV_BLOCK_FACES = 128 };

typedef struct sdv_shape {              // how rows of a batch look
    int   count[3];                     // behind the first point so many points of each weight
    float weight[3];
    int   own;                          // floats of its own that each row has behind its points:
                                        //     3 weights or, of a limit, as sdv_batch.limit
    int   regular;                      // of a limit: smooth, with the regular number of faces
} sdv_shape;

typedef struct sdv_batch {              // rows of the same shape
    sdv_shape shape;
    int       rows;
    const int *items;                   // of each row the target, the points, three floats if own
    const unsigned char *faces;         // [rows] which face of the block a row belongs to, rising
    const float *limit;                 // [3][points] of a limit: weights of the point and of two
} sdv_batch;                            // tangents, or sdv_own_limit; else NULL

static const float sdv_own_limit[1] = { 0 };            // of rows that have weights of their own

typedef struct sdv_batches {            // the rows of one step of refinement, or of the limit
    int        rows, blocks;
    int       *starts;                  // [blocks + 1] the first batch of each block
    sdv_batch *items;
} sdv_batches;

typedef struct sdv_open_batch {         // a batch being written, emptied behind each block
    sdv_shape shape;
    const float *limit;                 // see sdv_batch
    int   stride;                       // ints of a row
    int   rows, room;                   // rows there, and rows that there is room for
    int  *items;
    unsigned char *faces;
} sdv_open_batch;

typedef struct sdv_writer {             // writes rows into batches
    sdv_context *context;
    sdv_arena   *arena;                 // finished batches go there
    sdv_arena    scratch;               // of open batches
    sdv_array    open;                  // sdv_open_batch: one for each shape so far
    int          known[256];            // numbers of open batches by the hash of their shape, or -1
    sdv_array    batches, starts;       // sdv_batch, int
    sdv_array    strips;                // sdv_strips: of SUBDIV_EXACT, see >>patches
    int          rows, face;            // rows written; the cage face that new rows belong to
    int         *points;                // room for the points of a row
    sdv_shape    shape;                 // of the last row that was looked up
    int         *smooth;                // [most + 1] open batches of smooth vertices with so many
    int          most;                  // faces, or -1; the most faces at a vertex or sides
    int          crease, corner, sharp_edge;        // open batches of vertices and edges that stay
    int          smooth_edge;                   // sharp and of smooth edges of the cage, or -1
} sdv_writer;

// The most faces that a vertex has, on this level or any later one.
static int sdv_most_faces(const sdv_level *cage)
{
    int most = 6;                                   // Loop: around any new vertex
    for (int v = 0; v < cage->vertex_count; v++)
        if (cage->vertex_faces[v] > most) most = cage->vertex_faces[v];
    for (int f = 0; f < cage->face_count && !cage->face_size; f++) {
        int size = sdv_face_end(cage, f) - sdv_face_start(cage, f);
        if (size > most) most = size;
    }
    return most;
}

// Begins a writer of rows for a cage and the levels that are made of it.
static void sdv_writer_new(sdv_context *context, sdv_arena *arena, const sdv_level *cage,
                           sdv_writer *writer)
{
    int most = sdv_most_faces(cage);
    memset(writer, 0, sizeof *writer);
    writer->context = context;
    writer->arena = arena;
    writer->scratch = sdv_scratch();
    writer->most = most;
    // A vertex, its faces and, on a crease or not manifold, up to twice as many neighbours.
    writer->points = SDV_NEW(context, &writer->scratch, int, 16 + 4 * (size_t)most);
    writer->smooth = SDV_NEW(context, &writer->scratch, int, (size_t)most + 1);
    writer->crease = writer->corner = writer->sharp_edge = writer->smooth_edge = -1;
    for (int i = 0; i < 256; i++) writer->known[i] = -1;
    for (int i = 0; i <= most && !context->result; i++) writer->smooth[i] = -1;
}

static int sdv_row_points(const sdv_shape *shape)
{
    return 1 + shape->count[0] + shape->count[1] + shape->count[2];
}

static int sdv_same_shape(const sdv_shape *a, const sdv_shape *b)
{
    return memcmp(a->count, b->count, sizeof a->count) == 0 && a->own == b->own &&
           (a->own || memcmp(a->weight, b->weight, sizeof a->weight) == 0);
}

// Returns the number of the open batch for rows of a shape and, of a limit, of these weights. Makes
// one where none is known: of shapes with the same hash, only the latest is. -1: out of memory.
static int sdv_find_open(sdv_writer *writer, const sdv_shape *shape, const float *limit)
{
    uint32_t bits[3] = { 0, 0, 0 }, hash = 0;
    sdv_open_batch *open = (sdv_open_batch *)sdv_items(&writer->open);
    if (!shape->own) memcpy(bits, shape->weight, sizeof bits);
    if (limit) memcpy(&hash, limit, sizeof hash);
    for (int i = 0; i < 3; i++) hash = (hash ^ bits[i] ^ (uint32_t)shape->count[i]) * 2654435761u;
    int *known = &writer->known[hash >> 24];
    if (*known >= 0 && open[*known].limit == limit && sdv_same_shape(&open[*known].shape, shape))
        return *known;
    open = (sdv_open_batch *)sdv_append(writer->context, &writer->open, 1, sizeof *open);
    if (!open) return -1;
    open->shape = *shape;
    open->limit = limit;
    open->stride = 1 + sdv_row_points(shape) + shape->own;
    return *known = (int)writer->open.count - 1;
}

static void sdv_grow_open(sdv_writer *writer, sdv_open_batch *open)
{
    size_t room = open->room ? 2 * (size_t)open->room : 64, stride = (size_t)open->stride;
    int *items = SDV_NEW(writer->context, &writer->scratch, int, room * stride);
    unsigned char *faces = SDV_NEW(writer->context, &writer->scratch, unsigned char, room);
    if (writer->context->result) return;
    sdv_copy(items, open->items, (size_t)open->rows * stride, sizeof *items);
    sdv_copy(faces, open->faces, (size_t)open->rows, 1);
    open->items = items;
    open->faces = faces;
    open->room = (int)room;
}

// Adds a row with this target to an open batch. Returns the place for its points.
SDV_INLINE int *sdv_put_row(sdv_writer *writer, int number, int target)
{
    if (number < 0) return writer->points;
    sdv_open_batch *open = (sdv_open_batch *)sdv_items(&writer->open) + number;
    if (open->rows == open->room) sdv_grow_open(writer, open);
    if (open->rows == open->room) return writer->points;       // out of memory
    int *row = open->items + (size_t)open->stride * (size_t)open->rows;
    open->faces[open->rows++] = (unsigned char)(writer->face % SDV_BLOCK_FACES);
    row[0] = target;
    return row + 1;
}

// Adds a row of a shape, whose points are in writer->points, to an open batch.
static void sdv_copy_row(sdv_writer *writer, int number, const sdv_shape *shape, int target)
{
    int points = sdv_row_points(shape), *row = sdv_put_row(writer, number, target);
    if (row == writer->points) return;
    for (int i = 0; i < points; i++) row[i] = writer->points[i];
    if (shape->own) memcpy(row + points, shape->weight, sizeof shape->weight);
}

// Adds the row whose points are in writer->points to the open batch of a shape. Returns its number.
static int sdv_add_shape(sdv_writer *writer, const sdv_shape *shape, const float *limit,
                         int target)
{
    int number = sdv_find_open(writer, shape, limit);
    sdv_copy_row(writer, number, shape, target);
    return number;
}

// Returns the shape of a row: its runs without the first point, joined where weights are equal.
static sdv_shape sdv_shape_of(const sdv_runs *runs)
{
    sdv_shape shape;
    int first = 1, n = -1;
    memset(&shape, 0, sizeof shape);
    for (int i = 0; i < SDV_RUNS; i++) {
        int count = runs->count[i];
        if (count == 0) continue;
        count -= first;
        first = 0;
        if (count == 0) continue;
        uint32_t a, b;
        if (n >= 0) {
            memcpy(&a, &shape.weight[n], sizeof a);
            memcpy(&b, &runs->weight[i], sizeof b);
        }
        if (n < 0 || a != b) n++;
        shape.count[n] += count;
        shape.weight[n] = runs->weight[i];
    }
    shape.own = runs->blend && n >= 0 ? 3 : 0;
    return shape;
}

// Adds the row whose points are in writer->points. Returns the number of its open batch.
static int sdv_add_runs(sdv_writer *writer, const sdv_runs *runs, int target)
{
    writer->shape = sdv_shape_of(runs);
    return sdv_add_shape(writer, &writer->shape, NULL, target);
}

// Copies open batches to the batches of a new block and empties them.
static void sdv_end_block(sdv_writer *writer)
{
    sdv_context *context = writer->context;
    sdv_open_batch *open = (sdv_open_batch *)sdv_items(&writer->open);
    int *start = (int *)sdv_array_room(context, &writer->starts, 1, sizeof *start);
    if (!start) return;
    *start = (int)writer->batches.count;
    writer->starts.count++;
    for (size_t i = 0; i < writer->open.count && !context->result; i++) {
        size_t rows = (size_t)open[i].rows, size = rows * (size_t)open[i].stride;
        if (rows == 0) continue;
        int *items = SDV_NEW(context, writer->arena, int, size);
        unsigned char *faces = SDV_NEW(context, writer->arena, unsigned char, rows);
        sdv_batch *batch = (sdv_batch *)sdv_append(context, &writer->batches, 1, sizeof *batch);
        if (!batch || context->result) return;
        sdv_copy(items, open[i].items, size, sizeof *items);
        sdv_copy(faces, open[i].faces, rows, 1);
        batch->shape = open[i].shape;
        batch->limit = open[i].limit;
        batch->rows = open[i].rows;
        batch->items = items;
        batch->faces = faces;
        writer->rows += open[i].rows;
        open[i].rows = 0;
    }
}

// Says that the rows added from now on belong to a cage face; ends a block where a new one begins.
static void sdv_batch_face(sdv_writer *writer, int face)
{
    if (face / SDV_BLOCK_FACES != writer->face / SDV_BLOCK_FACES) sdv_end_block(writer);
    writer->face = face;
}

// Ends the last block and hands all batches over. The writer can then begin with others.
static void sdv_end_batches(sdv_writer *writer, sdv_batches *made)
{
    sdv_context *context = writer->context;
    sdv_end_block(writer);
    made->blocks = (int)writer->starts.count;
    made->rows = writer->rows;
    sdv_end_block(writer);                                     // an empty one: where the last ends
    made->starts = SDV_KEEP(context, writer->arena, int, &writer->starts);
    made->items = SDV_KEEP(context, writer->arena, sdv_batch, &writer->batches);
    memset(&writer->starts, 0, sizeof writer->starts);
    memset(&writer->batches, 0, sizeof writer->batches);
    writer->rows = writer->face = 0;
}

static void sdv_writer_free(sdv_writer *writer)
{
    sdv_array_free(&writer->open);
    sdv_array_free(&writer->strips);
    sdv_arena_free(&writer->scratch);
}

// Adds the row that makes point target, the face point of f.
static void sdv_face_row(const sdv_level *level, int f, int target, sdv_writer *writer)
{
    int start = sdv_face_start(level, f), end = sdv_face_end(level, f);
    int *point = writer->points;
    int size = end - start;
    sdv_runs runs = { { (float)sdv_face_weight(size), 0, 0, 0 }, { size, 0, 0, 0 }, 0 };
    for (int h = start; h < end; h++) *point++ = level->first_point + level->face_vertices[h];
    sdv_add_runs(writer, &runs, target);
}

// Replace a mask's weights of face points by weights of the vertices of these faces, all quads.
static sdv_mask sdv_spread_vertex(sdv_mask mask, int faces)
{
    mask.self += faces * mask.face / 4;
    mask.edge += 2 * mask.face / 4;
    mask.face /= 4;
    return mask;
}

static sdv_mask sdv_spread_edge(sdv_mask mask, int faces)
{
    mask.self += faces * mask.face / 4;
    mask.face /= 4;
    return mask;
}

// Returns the point inside face f that is next to its vertex i; on level 1 the centre.
static int sdv_inside_corner(const sdv_order *order, int f, int i)
{
    int inside = sdv_first_inside(order, f), n = order->n;
    if (n == 2) return inside;
    if (sdv_is_ngon(order, f)) return sdv_inside_grid(order, f, i);
    if (order->frame) return inside + i * (n - 2);
    return inside + (i >= 2 ? (n - 2) * (n - 1) : 0) + (i == 1 || i == 2 ? n - 2 : 0);
}

// Return a point next to the vertex of h: along the edge that leads on, along the one before, or
// across the face.
static inline int sdv_point_ahead(const sdv_level *level, int h)
{
    if (!level->order) return level->first_point + level->face_vertices[sdv_next(level, h)];
    sdv_side side = sdv_edge_side(level->order, h, 0);
    return level->first_point + side.first + side.step;
}

static int sdv_point_behind(const sdv_level *level, int h)
{
    int before = sdv_previous(level, h);
    if (!level->order) return level->first_point + level->face_vertices[before];
    sdv_side side = sdv_edge_side(level->order, before, 1);
    return level->first_point + side.first + side.step;
}

static inline int sdv_point_across(const sdv_level *level, int h)
{
    int f = sdv_face_of(level, h), first = level->first_point;
    if (!level->order) return first + level->face_vertices[sdv_next(level, sdv_next(level, h))];
    return first + sdv_inside_corner(level->order, f, h - sdv_face_start(level, f));
}

// Appends the neighbours of v along its sharp edges (sharp 1) or along the others (0). An edge is
// sharp if it is so now or, where a corner turns into a crease, on the next level. One that no face
// leads along from v is a boundary or not manifold: sharp forever.
static int *sdv_add_neighbours(const sdv_level *level, int v, sdv_rule rule, int sharp, int *point)
{
    for (int h = level->vertex_first[v]; h >= 0; h = level->vertex_next[h]) {
        float s = rule == SDV_CREASE ? level->sharpness[h] : sdv_half(level, h);
        if (sdv_is_edge_at(level, h, 1) && (s > 0) == sharp) *point++ = sdv_point_ahead(level, h);
        if (sharp && sdv_is_edge_at(level, sdv_previous(level, h), 0))
            *point++ = sdv_point_behind(level, h);
    }
    return point;
}

// Returns where the writer keeps the open batch for a vertex's rule; NULL where two rules blend.
static int *sdv_known_batch(sdv_writer *writer, sdv_fading fading, int faces)
{
    if (fading.rule < SDV_CREASE) return &writer->smooth[faces];
    if (fading.rule != fading.next) return NULL;
    return fading.rule == SDV_CREASE ? &writer->crease : &writer->corner;
}

// Appends the neighbours of v, if edges, and a point for each of its faces, if faces.
SDV_INLINE int *sdv_add_ring(const sdv_level *level, int v, int edges, int faces, int *point)
{
    int *across = edges ? point + level->vertex_faces[v] : point;
    for (int h = level->vertex_first[v]; h >= 0; h = level->vertex_next[h]) {
        if (edges) *point++ = sdv_point_ahead(level, h);
        if (faces) *across++ = level->order ? sdv_point_across(level, h)
                                            : level->face_point[sdv_face_of(level, h)];
    }
    return faces ? across : point;
}

// Adds the row that makes point target from vertex v and the points around it. Without a crease
// each edge at v lies between two faces. Later levels have no face points: see >>lines.
static void sdv_vertex_row(const sdv_level *level, const sdv_rules *rules, int v, int target,
                           sdv_writer *writer)
{
    int faces = level->vertex_faces[v], spread = level->order && !rules->loop;
    sdv_fading fading = sdv_vertex_fading(level, v);
    int *known = SDV_IS_PLAIN || rules->linear ? NULL : sdv_known_batch(writer, fading, faces);
    if (known && *known >= 0) {
        int *row = sdv_put_row(writer, *known, target);
        row[0] = level->first_point + v;
        if (fading.rule < SDV_CREASE) sdv_add_ring(level, v, 1, !rules->loop, row + 1);
        if (fading.rule == SDV_CREASE) sdv_add_neighbours(level, v, SDV_CREASE, 1, row + 1);
        return;
    }
    sdv_mask mask = sdv_vertex_mask(rules, fading, faces);
    if (spread) mask = sdv_spread_vertex(mask, faces);
    int *point = writer->points, *ends[SDV_RUNS];
    sdv_runs runs = { { (float)mask.self, (float)(mask.edge + mask.crease), (float)mask.edge,
                        (float)mask.face },
                      { 0, 0, 0, 0 }, fading.rule != fading.next && fading.rule >= SDV_CREASE };
    if (mask.self != 0) *point++ = level->first_point + v;
    ends[0] = point;
    if (mask.crease != 0) point = sdv_add_neighbours(level, v, fading.rule, 1, point);
    ends[1] = point;
    if (mask.crease == 0) point = sdv_add_ring(level, v, mask.edge != 0, 0, point);
    else if (mask.edge != 0) point = sdv_add_neighbours(level, v, fading.rule, 0, point);
    ends[2] = point;
    ends[3] = sdv_add_ring(level, v, 0, mask.face != 0, point);
    for (int i = 0; i < SDV_RUNS; i++)
        runs.count[i] = (int)(ends[i] - (i > 0 ? ends[i - 1] : writer->points));
    int number = sdv_add_runs(writer, &runs, target);
    if (known && mask.self != 0 && (mask.edge != 0 || fading.rule >= SDV_CREASE)) *known = number;
}

// Adds the row that makes point target from the edge of h: from its ends and, on each side, from
// the face point or, under Loop, the vertex opposite.
static void sdv_edge_row(const sdv_level *level, const sdv_rules *rules, int h, int target,
                         sdv_writer *writer)
{
    int triangles = 0, beside = 2, k = h, *known = NULL, *point = writer->points;
    int smooth_triangles = rules->triangles == SUBDIV_TRIANGLES_SMOOTH;
    float sharpness = level->sharpness[h];
    int stays_sharp = sharpness > 0 && sdv_half(level, h) > 0 && sdv_half_before(level, h) > 0;
    sdv_runs runs = { { 0, 0, 0, 0 }, { 2, 0, 0, 0 }, sharpness > 0 && !stays_sharp };
    if (stays_sharp) known = &writer->sharp_edge;
    if (sharpness <= 0 && !smooth_triangles && !rules->linear) known = &writer->smooth_edge;
    if (SDV_IS_PLAIN) known = NULL;
    if (known && *known >= 0) {
        point = sdv_put_row(writer, *known, target);
        if (stays_sharp) beside = 0;
    } else {
        int faces = sdv_edge_faces(level, h);
        if (faces == 2 && smooth_triangles)
            triangles = (sdv_size_of(level, h) == 3) + (sdv_size_of(level, level->across[h]) == 3);
        sdv_mask mask = sdv_edge_mask(rules, sharpness, stays_sharp, faces, triangles);
        runs.weight[0] = (float)mask.self;
        runs.weight[3] = (float)mask.face;
        beside = runs.count[3] = mask.face != 0 ? faces : 0;
    }
    point[0] = level->first_point + level->face_vertices[h];
    point[1] = level->first_point + level->face_vertices[sdv_next(level, h)];
    for (int i = 0; i < beside; i++, k = level->across[k])
        point[2 + i] = rules->loop ?
            level->first_point + level->face_vertices[sdv_previous(level, k)] :
            level->face_point[sdv_face_of(level, k)];
    if (known && *known >= 0) return;
    int number = sdv_add_runs(writer, &runs, target);
    if (known) *known = number;
}

// --------------------------------------------------------------------------------- >>lines
// From level 1 on, topology is arithmetic. The points of a level stand in THE ORDER OF THE RESULT,
// and the neighbours of each follow from where it stands:
//
//     inside a face      on its grid, where all is regular and smooth: see >>grids
//     on an edge         a line of points, between the rows of points beside it
//     at a vertex        the first point along each edge, the first one inside each face
//
//     . . . . .   left   (of an edge's first face)        Loop     . . . .     left
//     v-o-o-o-v   line                                            v-o-o-o-v
//     . . . . .   right                                            . . . .     right
//
// Rows of lines need no face points. A face point is the mean of its face's four vertices, so its
// weight in a mask goes to them in equal parts: to ends of edges and to points across faces.
//
// The next level's lines follow from this level's lines and the points beside them, and so do the
// points beside the next level's lines. So deep levels keep lines and frames alone.

typedef struct sdv_last_row {           // of a line that is or was sharp: most rows are like it
    float     key[5];                   // all that the shape depends on: see sdv_sharp_rows
    sdv_shape shape;
    int       batch;                    // -1: none yet
} sdv_last_row;

typedef struct sdv_filler {             // writes the rows from one level to the next
    sdv_writer  writer;
    sdv_level   *level;                 // the cage, with the sharpness that is left on this level
    const sdv_rules *rules;
    sdv_order    from, to;              // of this level, of the next one
    int          base;                  // where the points of this level start,
    int          target;                // where those of the next one start
    int         *line, *left, *right;   // [n + 1] the points of a line and those beside it
    int         *made;                  // [2 n + 1] points of the next level, beside a line of it
    int          odd, even;             // open batches: of edge and vertex points on smooth lines,
    int          face;                  // of face points
    sdv_last_row sharp[2];              // of vertex points, of edge points
    struct sdv_pieces *pieces;          // NULL: no edge is semi-sharp
} sdv_filler;

typedef struct sdv_pieces {             // the sharpness of semi-sharp edges, piece by piece
    int   *number;                      // [edges] the number of an edge among these, or -1
    int    count;                       // of these edges; each has n pieces on this level
    float *now, *next;                  // [n * count] on this level, [2 n * count] on the next
} sdv_pieces;

typedef struct sdv_edge_line {          // the edge of face-vertex h, cut into n pieces
    int h, n;
    float sharpness;                    // of every piece, if it is 0 or forever;
    const float *now, *next;            // else of each piece, and of each half; or NULL
} sdv_edge_line;

static sdv_edge_line sdv_line_at(const sdv_filler *fill, int h)
{
    const sdv_level *level = fill->level;
    sdv_edge_line line = { h, fill->from.n, level->sharpness[h], NULL, NULL };
    int number = fill->pieces ? fill->pieces->number[level->face_edges[h]] : -1;
    if (number < 0) return line;
    line.now = fill->pieces->now + (size_t)number * (size_t)line.n;
    line.next = fill->pieces->next + 2 * (size_t)number * (size_t)line.n;
    return line;
}

// Finds the row and column of point t beside a side of a grid, counter-clockwise.
static void sdv_beside_side(int n, int triangle, int side, int t, int *row, int *column)
{
    int last = n - 1, back = triangle ? last - t : n - t;
    if (side == 0) *row = 1, *column = t;
    else if (side == 1) *row = t, *column = triangle ? back : last;
    else if (side == 2 && !triangle) *row = last, *column = back;
    else *row = back, *column = 1;
}

// Writes the points beside a side of a grid, counter-clockwise, point t to at[step * t]. inside:
// the first point inside the grid.
static void sdv_put_beside(const sdv_order *order, int n, int inside, int side, int step, int *at)
{
    int triangle = order->loop, last = n - 1 - triangle, row, column;
    int along = side == 0 ? 1 : side == 1 ? n - 1 : side == 2 ? -1 : 1 - n, first = inside;
    if (order->frame) along = 1;
    if (order->frame) first += side * (last - 1);
    else first += side == 0 ? 0 : side == 1 ? n - 2 : side == 2 ? n * (n - 2) : (n - 2) * (n - 1);
    for (int t = 1; t <= last && (!triangle || order->frame); t++, first += along)
        at[step * t] = first;
    for (int t = 1; t <= last && triangle && !order->frame; t++) {
        sdv_beside_side(n, 1, side, t, &row, &column);
        at[step * t] = sdv_inside_point(inside, n, 1, row, column);
    }
    if (order->frame && side == 3 - triangle) at[step * last] = inside;        // the ring closes
}

// Writes the points inside the face of h that are beside its edge, from h on or backwards, and at
// both ends those on the edges before and after it. n + 1 points; Loop: n.
static void sdv_points_beside(const sdv_order *order, int base, int h, int backwards, int *out)
{
    const sdv_level *cage = &order->cage;
    int f = sdv_face_of(cage, h), start = sdv_face_start(cage, f), i = h - start;
    int sides = sdv_face_end(cage, f) - start, last = order->loop ? order->n - 1 : order->n;
    int m = order->m, before = i > 0 ? i - 1 : sides - 1, next = i + 1 < sides ? i + 1 : 0;
    int step = backwards ? -1 : 1, *at = backwards ? out + last : out;
    int inside = base + sdv_first_inside(order, f);
    const int *v = cage->face_vertices + start, *e = cage->face_edges + start;
    sdv_side a = sdv_seen_edge(order, e[before], v[before] <= v[i]);
    sdv_side b = sdv_seen_edge(order, e[next], v[next] > v[next + 1 < sides ? next + 1 : 0]);
    at[0] = base + a.first + a.step;
    at[step * last] = base + b.first + b.step;
    if (!sdv_is_ngon(order, f)) {
        sdv_put_beside(order, order->n, inside, i, step, at);
        return;
    }
    sdv_put_beside(order, m, base + sdv_inside_grid(order, f, i), 0, step, at);
    at[step * m] = m == 1 ? inside : inside + 1 + i * (m - 1) + m - 2;         // on the spoke
    sdv_put_beside(order, m, base + sdv_inside_grid(order, f, next), 3, step, at + step * m);
}

// Writes the n + 1 points of the edge of h, with its ends.
static void sdv_points_on_edge(const sdv_order *order, int base, int h, int *out)
{
    const sdv_level *cage = &order->cage;
    sdv_side side = sdv_edge_side(order, h, 0);
    out[0] = base + cage->face_vertices[h];
    for (int t = 1; t < order->n; t++) out[t] = base + side.first + side.step * t;
    out[order->n] = base + cage->face_vertices[sdv_next(cage, h)];
}

// Writes the points at piece j of a line: its ends, then the points beside it.
SDV_INLINE void sdv_points_at_piece(const sdv_filler *fill, int loop, int j, int *points)
{
    const int *p = fill->line, *left = fill->left, *right = fill->right;
    points[0] = p[j];
    points[1] = p[j + 1];
    points[2] = left[j];
    points[3] = loop ? right[j] : left[j + 1];
    if (loop) return;
    points[4] = right[j];
    points[5] = right[j + 1];
}

// Writes point t of a line and those around it: along it, beside it, and across the faces there.
SDV_INLINE void sdv_points_around(const sdv_filler *fill, int loop, int t, int *points)
{
    const int *p = fill->line, *left = fill->left, *right = fill->right;
    points[0] = p[t];
    points[1] = p[t - 1];
    points[2] = p[t + 1];
    points[3] = left[loop ? t - 1 : t];
    points[4] = right[loop ? t - 1 : t];
    points[5] = left[loop ? t : t - 1];
    points[6] = right[loop ? t : t - 1];
    if (loop) return;
    points[7] = left[t + 1];
    points[8] = right[t + 1];
}

// Adds the rows of a smooth line: of the odd points, one on each piece, and of the even ones.
SDV_INLINE void sdv_smooth_rows(sdv_filler *fill, int loop, int n, sdv_side target)
{
    int at = target.first + target.step;
    for (int j = 0; j < n; j++, at += 2 * target.step)
        sdv_points_at_piece(fill, loop, j, sdv_put_row(&fill->writer, fill->odd, at));
    at = target.first + 2 * target.step;
    for (int t = 1; t < n; t++, at += 2 * target.step)
        sdv_points_around(fill, loop, t, sdv_put_row(&fill->writer, fill->even, at));
}

// Return the shapes of rows on a line, from what sharpness says there: of an edge point, from that
// of its piece and of the two halves one level down; of a vertex point, from that of the pieces
// before and after it, of their halves at it, and of the point itself. whole: with all points, also
// those without weight, as sdv_smooth_rows writes them.
static sdv_shape sdv_odd_shape(const sdv_rules *rules, const float *key, int whole)
{
    sdv_mask mask = sdv_edge_mask(rules, key[0], key[1] > 0 && key[2] > 0, 2, 0);
    if (!rules->loop) mask = sdv_spread_edge(mask, 2);
    int beside = whole || mask.face != 0;
    sdv_runs runs = { { (float)mask.self, 0, 0, (float)mask.face },
                      { 2, 0, 0, beside ? rules->loop ? 2 : 4 : 0 }, beside && !whole };
    return sdv_shape_of(&runs);
}

static sdv_shape sdv_even_shape(const sdv_rules *rules, const float *key, int whole)
{
    int loop = rules->loop, regular = loop ? 6 : 4;
    sdv_sharp_edges sharp = { 0, 0, 0, 0, 0, 0 };
    for (int k = 0; k < 2; k++) sdv_meet_edge(&sharp, key[k], key[2 + k]);
    sdv_mask mask = sdv_vertex_mask(rules, sdv_fading_of(key[4], &sharp), regular);
    if (!loop) mask = sdv_spread_vertex(mask, regular);
    int around = whole || mask.face != 0 || mask.edge != 0, along = mask.crease != 0 || around;
    sdv_runs runs = { { (float)mask.self, (float)(mask.edge + mask.crease), (float)mask.edge,
                        (float)mask.face },
                      { 1, along ? 2 : 0, around ? regular - 2 : 0, around && !loop ? 4 : 0 },
                      around && !whole };
    return sdv_shape_of(&runs);
}

// Adds the rows of a line that is or was sharp.
static void sdv_sharp_rows(sdv_filler *fill, const sdv_edge_line *line, sdv_side target)
{
    const sdv_rules *rules = fill->rules;
    float s = line->sharpness;
    int straight = rules->straight && fill->level->across[line->h] == line->h;
    for (int k = 1; k < 2 * line->n; k++) {
        int odd = k % 2, at = k / 2;
        float key[5] = { s, s, s, s, straight && !odd ? SDV_IMPLIED : 0 };
        if (line->now && odd) key[0] = line->now[at];
        if (line->now && !odd) memcpy(key, line->now + at - 1, 2 * sizeof *key);
        if (line->next) memcpy(key + 2 - odd, line->next + k - 1, 2 * sizeof *key);
        if (odd) sdv_points_at_piece(fill, rules->loop, at, fill->writer.points);
        else sdv_points_around(fill, rules->loop, at, fill->writer.points);
        sdv_last_row *row = &fill->sharp[odd];
        if (row->batch < 0 || memcmp(key, row->key, sizeof key) != 0) {
            memcpy(row->key, key, sizeof key);
            row->shape = odd ? sdv_odd_shape(rules, key, 0) : sdv_even_shape(rules, key, 0);
            row->batch = sdv_find_open(&fill->writer, &row->shape, NULL);
        }
        sdv_copy_row(&fill->writer, row->batch, &row->shape, target.first + target.step * k);
    }
}

// Adds the rows of the points inside an edge, h being its first face-vertex.
static void sdv_line_rows(sdv_filler *fill, int h)
{
    sdv_edge_line line = sdv_line_at(fill, h);
    int beside = (line.sharpness <= 0 || line.now) && !fill->rules->linear;
    int across = fill->level->across[h], base = fill->base;
    sdv_side target = sdv_edge_side(&fill->to, h, 0);
    sdv_points_on_edge(&fill->from, base, h, fill->line);
    if (beside) sdv_points_beside(&fill->from, base, h, 0, fill->left);
    if (beside) sdv_points_beside(&fill->from, base, across, 1, fill->right);
    target.first += fill->target;
    if (!beside || line.now) sdv_sharp_rows(fill, &line, target);
    else if (fill->rules->loop) sdv_smooth_rows(fill, 1, line.n, target);
    else sdv_smooth_rows(fill, 0, line.n, target);
}

// Finds the points of spoke i of an n-gon, from the middle of edge i to the centre, and those
// beside it: left in the grid at vertex i, right in the grid at vertex i + 1.
static void sdv_spoke_points(sdv_filler *fill, int f, int i)
{
    const sdv_order *order = &fill->from;
    const sdv_level *cage = &order->cage;
    int start = sdv_face_start(cage, f), sides = sdv_face_end(cage, f) - start, m = order->m;
    sdv_grid left, right;
    sdv_grid_at(order, start + i, &left);
    sdv_grid_at(order, start + (i + 1 < sides ? i + 1 : 0), &right);
    for (int t = 0; t <= m; t++) {
        fill->line[t] = fill->base + sdv_grid_index(&left, t, m);
        fill->left[t] = fill->base + sdv_grid_index(&left, t, m - 1);
        fill->right[t] = fill->base + sdv_grid_index(&right, m - 1, t);
    }
}

// Adds the rows of points first to last between a line and the points beside it: face points and
// edge points or, under Loop, edge points alone. Row t makes point fill->made[t]; -1: no row.
static void sdv_beside_rows(sdv_filler *fill, const int *beside, int first, int last)
{
    const int *line = fill->line, *made = fill->made;
    int loop = fill->rules->loop;
    for (int t = first; t <= last; t++) {
        int k = t / 2, odd = t % 2, next = odd ? k + 1 : k - 1, face = odd && !loop;
        if (made[t] < 0) continue;
        int *row = sdv_put_row(&fill->writer, face ? fill->face : fill->odd,
                               fill->target + made[t]);
        row[0] = line[loop ? k + odd : k];
        row[1] = beside[k];
        row[2] = line[loop ? k + !odd : next];
        row[3] = beside[next];
        if (loop || odd) continue;
        row[4] = line[k + 1];
        row[5] = beside[k + 1];
    }
}

// Adds the rows that make the frames of face f on the next level: beside its edges and its spokes.
static void sdv_frame_rows(sdv_filler *fill, int f)
{
    const sdv_order *from = &fill->from, *to = &fill->to;
    int start = sdv_face_start(&from->cage, f), sides = sdv_face_end(&from->cage, f) - start;
    int n = from->n, ngon = sdv_is_ngon(from, f);
    for (int i = 0; i < sides; i++) {
        sdv_points_on_edge(from, fill->base, start + i, fill->line);
        sdv_points_beside(from, fill->base, start + i, 0, fill->left);
        sdv_points_beside(to, 0, start + i, 0, fill->made);
        if (ngon) fill->made[n] = -1;                          // it is on a spoke
        sdv_beside_rows(fill, fill->left, 1, 2 * n - 2 - from->loop);
    }
    for (int i = 0; i < sides && ngon; i++) {
        sdv_grid left, right;
        sdv_grid_at(to, start + i, &left);
        sdv_grid_at(to, start + (i + 1 < sides ? i + 1 : 0), &right);
        sdv_spoke_points(fill, f, i);
        for (int t = 2; t < n; t++) fill->made[t] = sdv_inside_index(&left, t, n - 1);
        sdv_beside_rows(fill, fill->left, 2, n - 1);
        for (int t = 2; t < n; t++) fill->made[t] = sdv_inside_index(&right, n - 1, t);
        sdv_beside_rows(fill, fill->right, 2, n - 2);
    }
}

// ----------------------------------------------------------------------------- >>face-varying
// UVs and other values at the vertices of faces, which may have another one in each face around a
// vertex. They are a surface over a topology of their own: the faces of the cage, cut open along
// seams. Its vertices are the pairs of a vertex and a value there; an edge is a seam if its faces
// have different values at one of its ends.
//
//      A | B        a seam with values A and B at its lower end: two vertices of this topology,
//      --+--        both on its boundary
//
// Seams are boundaries: smooth curves, or sharp where the rule says corner [OSD]. Everything else
// is as on the cage, creases, corners and all masks; so prepare and evaluate work as they are.

typedef struct sdv_seams {
    const sdv_cage *cage;
    const int *values;                  // [face-vertices of the cage] -1: none
    int value_count;
    subdiv_uv_rule rule;
    unsigned char *seam;                // [edges of the cage]
    int *own;                           // [face-vertices of the cage] here, or -1
    int *home;                          // [face-vertices here] on the cage
    sdv_level level;
    int *source;                        // [level.vertex_count] its value
} sdv_seams;

// The value at vertex v of the face that leads on from h along an edge at v; -1 unless the face has
// one at each of its vertices.
static int sdv_value_at(const sdv_seams *seams, int h, int v)
{
    const sdv_level *cage = &seams->cage->level;
    int at = cage->face_vertices[h] == v ? h : sdv_next(cage, h);
    return seams->own[at] < 0 ? -1 : seams->values[at];
}

static void sdv_find_seams(sdv_seams *seams)
{
    const sdv_level *cage = &seams->cage->level;
    for (int e = 0; e < cage->edge_count; e++) {
        int first = cage->edge_first[e], h = first, differ = 0;
        int a = cage->face_vertices[h], b = cage->face_vertices[sdv_next(cage, h)];
        while ((h = cage->across[h]) != first)
            differ |= sdv_value_at(seams, h, a) != sdv_value_at(seams, first, a) ||
                      sdv_value_at(seams, h, b) != sdv_value_at(seams, first, b);
        seams->seam[e] = (unsigned char)differ;
    }
}

// Takes the faces with a value at each vertex; own_face [faces of the cage] are their numbers here,
// or -1.
static void sdv_seam_faces(sdv_context *context, sdv_arena *keep, sdv_seams *seams, int *own_face)
{
    const sdv_level *cage = &seams->cage->level;
    sdv_level *level = &seams->level;
    int most = cage->face_vertex_count, mixed = !cage->face_size, h = 0;
    level->face_size = cage->face_size;
    level->face_vertices = SDV_NEW(context, keep, int, most);
    level->face_edges = SDV_NEW(context, keep, int, most);
    if (mixed) level->face_starts = SDV_NEW(context, keep, int, (size_t)cage->face_count + 1);
    if (mixed) level->face_of = SDV_NEW(context, keep, int, most);
    for (int f = 0; f < cage->face_count && !context->result; f++) {
        int start = sdv_face_start(cage, f), end = sdv_face_end(cage, f), has = 1, first = h;
        for (int k = start; k < end; k++) has &= seams->values[k] >= 0;
        own_face[f] = has ? level->face_count++ : -1;
        for (int k = start; k < end; k++) {
            seams->own[k] = has ? h : -1;
            if (!has) continue;
            if (mixed) level->face_of[h] = own_face[f];
            seams->home[h++] = k;
        }
        if (has && mixed) level->face_starts[own_face[f]] = first;
    }
    if (!context->result && mixed) level->face_starts[level->face_count] = h;
    level->face_vertex_count = h;
}

// The first vertex with a value has the value's number; others that share it come after all.
static void sdv_seam_vertices(sdv_context *context, sdv_arena *keep, sdv_arena *scratch,
                              sdv_seams *seams)
{
    const sdv_level *cage = &seams->cage->level;
    sdv_level *level = &seams->level;
    int *at = SDV_NEW(context, scratch, int, seams->value_count);       // the last vertex with it,
    int *own = SDV_NEW(context, scratch, int, seams->value_count);      // and what it is there
    size_t most = (size_t)seams->value_count + (size_t)level->face_vertex_count;
    seams->source = SDV_NEW(context, keep, int, most);
    if (context->result) return;
    level->vertex_count = seams->value_count;
    for (int i = 0; i < seams->value_count; i++) {
        at[i] = -1;
        seams->source[i] = i;
    }
    for (int v = 0; v < cage->vertex_count; v++) {
        for (int h = cage->vertex_first[v]; h >= 0; h = cage->vertex_next[h]) {
            if (seams->own[h] < 0) continue;
            int value = seams->values[h];
            if (at[value] != v) {
                own[value] = at[value] < 0 ? value : level->vertex_count++;
                seams->source[own[value]] = value;
                at[value] = v;
            }
            level->face_vertices[seams->own[h]] = own[value];
        }
    }
}

// Edges in the order in which the faces meet them. Those of the cage that are no seam stay.
static void sdv_seam_edges(sdv_seams *seams)
{
    const sdv_level *cage = &seams->cage->level;
    sdv_level *level = &seams->level;
    for (int h = 0; h < level->face_vertex_count; h++) level->face_edges[h] = -1;
    for (int h = 0; h < level->face_vertex_count; h++) {
        int at = seams->home[h], seam = seams->seam[cage->face_edges[at]];
        level->across[h] = seam ? h : seams->own[cage->across[at]];
        level->sharpness[h] = seam ? SDV_IMPLIED : cage->sharpness[at];
        if (level->sharpness[h] > 0)
            level->creased[level->face_vertices[h]] =
                level->creased[level->face_vertices[sdv_next(level, h)]] = 1;
        if (level->face_edges[h] >= 0) continue;
        int e = level->edge_count++, k = at;
        level->edge_first[e] = h;
        do level->face_edges[seams->own[k]] = e;
        while (!seam && (k = cage->across[k]) != at);
    }
}

// The values and faces around a vertex of the cage, by which a rule decides.
typedef struct sdv_surroundings {
    int values;                         // how many different ones
    int faces, all;                     // those with values, and all
    int seam, boundary, nonmanifold;    // is it on one?
    int own[2];                         // the first two vertices of this topology
    float semi_sharp;                   // the largest sharpness of the semi-sharp seams
} sdv_surroundings;

static sdv_surroundings sdv_look_around(const sdv_seams *seams, int v)
{
    const sdv_level *cage = &seams->cage->level, *level = &seams->level;
    sdv_surroundings around = { 0, 0, 0, 0, 0, 0, { -1, -1 }, 0 };
    around.all = cage->vertex_faces[v];
    around.nonmanifold = seams->cage->vertex_nonmanifold[v];
    for (int h = cage->vertex_first[v]; h >= 0; h = cage->vertex_next[h]) {
        int before = sdv_previous(cage, h), own = seams->own[h];
        int seam = seams->seam[cage->face_edges[h]];
        float s = cage->sharpness[h];
        around.seam |= seam | seams->seam[cage->face_edges[before]];
        if (seam && sdv_is_semi_sharp(s) && s > around.semi_sharp) around.semi_sharp = s;
        around.boundary |= sdv_is_boundary(cage, h) | sdv_is_boundary(cage, before);
        if (own < 0) continue;
        around.faces++;
        int vertex = level->face_vertices[own];
        if (level->vertex_first[vertex] != own) continue;           // seen before
        if (around.values < 2) around.own[around.values] = vertex;
        around.values++;
    }
    around.seam |= around.nonmanifold && around.values > 1;
    return around;
}

// Is an edge inside the fan at a vertex sharp forever; or semi-sharp, -1?
static int sdv_inner_crease(const sdv_level *level, int vertex)
{
    int semi = 0;
    for (int h = level->vertex_first[vertex]; h >= 0; h = level->vertex_next[h]) {
        if (sdv_is_boundary(level, h) || level->sharpness[h] <= 0) continue;
        if (level->sharpness[h] >= SUBDIV_INFINITE) return 1;
        semi = -1;
    }
    return semi;
}

// Corner by the rules "plus 1" and "plus 2": where more than two values meet; where two meet and
// one is a corner for another reason than its number of faces; by "plus 2" also for that reason.
static int sdv_is_shared_corner(const sdv_seams *seams, const sdv_surroundings *around)
{
    const sdv_level *level = &seams->level;
    if (around->values != 2) return around->values > 2;
    for (int i = 0; i < 2; i++) {
        int vertex = around->own[i];
        if (sdv_inner_crease(level, vertex) > 0 || !sdv_is_fan(level, vertex)) return 1;
        if (seams->rule == SUBDIV_UV_CORNERS_PLUS2 && level->vertex_faces[vertex] == 1) return 1;
    }
    return 0;
}

// Is a value on a seam or boundary a corner, where around knows the others?
static int sdv_is_uv_corner(const sdv_seams *seams, const sdv_surroundings *around, int vertex)
{
    const sdv_level *level = &seams->level;
    subdiv_uv_rule rule = seams->rule;
    int both = rule == SUBDIV_UV_CORNERS_PLUS1 || rule == SUBDIV_UV_CORNERS_PLUS2;
    int dart = around->values == 1 && !around->boundary && around->faces == around->all;
    if (rule == SUBDIV_UV_BOUNDARIES && (around->seam || around->boundary)) return 1;
    if (rule != SUBDIV_UV_NONE && around->faces == 1 && around->boundary) return 1;
    if (!around->seam) return 0;
    if (around->nonmanifold || !sdv_is_fan(level, vertex)) return 1;
    if (rule != SUBDIV_UV_NONE && level->vertex_faces[vertex] == 1) return 1;
    if (rule == SUBDIV_UV_CORNERS_PLUS2 && dart) return 1;
    return both && sdv_is_shared_corner(seams, around);
}

static void sdv_seam_sharpness(sdv_seams *seams)
{
    const sdv_level *cage = &seams->cage->level;
    sdv_level *level = &seams->level;
    int plus = seams->rule == SUBDIV_UV_CORNERS_PLUS1 || seams->rule == SUBDIV_UV_CORNERS_PLUS2;
    for (int i = 0; i < level->vertex_count; i++) level->vertex_sharpness[i] = 0;
    for (int v = 0; v < cage->vertex_count; v++) {
        sdv_surroundings around = sdv_look_around(seams, v);
        for (int h = cage->vertex_first[v]; h >= 0; h = cage->vertex_next[h]) {
            int own = seams->own[h], vertex = own < 0 ? -1 : level->face_vertices[own];
            if (own < 0 || level->vertex_first[vertex] != own) continue;
            level->vertex_sharpness[vertex] = sdv_is_uv_corner(seams, &around, vertex)
                ? SDV_IMPLIED : cage->vertex_sharpness[v];
        }
        if (!plus || !around.seam || around.values != 2) continue;
        // Two values at a seam are semi-sharp together, unless the vertex itself is sharp. The one
        // that is so by itself fades first if the seam is semi-sharp, too.
        int a = around.own[0], b = around.own[1];
        int of_a = sdv_inner_crease(level, a) < 0, of_b = sdv_inner_crease(level, b) < 0;
        int without = of_a ? b : a;
        if (of_a == of_b || level->vertex_sharpness[without] > 0) continue;
        level->partner[without] = of_a ? a : b;
        level->seam[without] = around.semi_sharp;
    }
}

// Chaikin's averages reach across seams: so they take the sums at the vertices of the cage, on each
// level, sums [levels + 1][2 * vertex_count]. What happens at a vertex depends on nothing else.
static void sdv_chaikin_sums(sdv_context *context, sdv_arena *keep, sdv_arena *scratch,
                             sdv_seams *seams, int levels)
{
    const sdv_level *cage = &seams->cage->level;
    sdv_level *level = &seams->level;
    size_t count = 2 * (size_t)cage->vertex_count;
    float *sums = level->sums = SDV_NEW(context, keep, float, count * ((size_t)levels + 1));
    float *s = SDV_NEW(context, scratch, float, cage->face_vertex_count);
    level->origin = SDV_NEW(context, scratch, int, level->vertex_count);
    level->origin_count = cage->vertex_count;
    if (context->result) return;
    for (int i = 0; i < level->vertex_count; i++) level->origin[i] = -1;
    for (int h = 0; h < level->face_vertex_count; h++)
        level->origin[level->face_vertices[h]] = cage->face_vertices[seams->home[h]];
    sdv_copy(s, cage->sharpness, (size_t)cage->face_vertex_count, sizeof(float));
    for (int i = 0; i <= levels; i++) {
        for (int v = 0; v < cage->vertex_count; v++, sums += 2) {
            sdv_sum_semi_sharp(cage, s, v, sums);
            for (int h = cage->vertex_first[v]; h >= 0; h = cage->vertex_next[h])
                s[h] = sdv_fade_chaikin(s[h], sums[0], (int)sums[1]);
        }
    }
}

// Level 0 of the values. Arenas as for sdv_cage_build: to keep goes source, too.
static void sdv_seams_build(sdv_context *context, sdv_arena *keep, sdv_arena *scratch,
                            sdv_seams *seams, int *own_face, int levels)
{
    const sdv_level *cage = &seams->cage->level;
    sdv_level *level = &seams->level;
    int chaikin = cage->half_sharpness != NULL;
    seams->seam = SDV_NEW(context, scratch, unsigned char, cage->edge_count);
    seams->own = SDV_NEW(context, scratch, int, cage->face_vertex_count);
    seams->home = SDV_NEW(context, scratch, int, cage->face_vertex_count);
    if (context->result) return;
    sdv_seam_faces(context, keep, seams, own_face);
    if (context->result) return;
    sdv_find_seams(seams);
    sdv_seam_vertices(context, keep, scratch, seams);
    sdv_level_new(context, scratch, level, chaikin);
    level->edge_first = SDV_NEW(context, scratch, int, level->face_vertex_count);
    level->partner = SDV_NEW(context, scratch, int, level->vertex_count);
    level->seam = SDV_NEW(context, scratch, float, level->vertex_count);
    if (chaikin) sdv_chaikin_sums(context, keep, scratch, seams, levels);
    if (context->result) return;
    for (int i = 0; i < level->vertex_count; i++) level->partner[i] = -1;
    sdv_level_count(level);
    sdv_seam_edges(seams);
    sdv_seam_sharpness(seams);
    sdv_level_fade(level);
}

// Scatters the bits of a number, for hashing.
static uint64_t sdv_mix(uint64_t x)
{
    x = (x ^ (x >> 32)) * 0xd6e8feb86659fd93u;
    x = (x ^ (x >> 32)) * 0xd6e8feb86659fd93u;
    return x ^ (x >> 32);
}

static int sdv_same_values(const float *a, const float *b, int channels)
{
    for (int c = 0; c < channels; c++)
        if (a[c] != b[c]) return 0;
    return 1;
}

// Finds the first of values that equals each. heads [mask + 1] is a hash table: of each hash the
// latest number; next [count] the one before each, or -1.
static void sdv_find_firsts(const float *values, int channels, int count, int *heads, size_t mask,
                            int *next, int *firsts)
{
    for (size_t i = 0; i <= mask; i++) heads[i] = -1;
    for (int i = 0; i < count; i++) {
        const float *value = values + (size_t)channels * (size_t)i;
        uint64_t hash = 0;
        for (int c = 0; c < channels; c++) {
            float x = value[c] + 0.0f;                              // no -0
            uint32_t bits;
            memcpy(&bits, &x, sizeof bits);
            hash = sdv_mix(hash + bits + 1);
        }
        int *head = &heads[(size_t)hash & mask], first = *head;
        while (first >= 0 &&
               !sdv_same_values(values + (size_t)channels * (size_t)first, value, channels))
            first = next[first];
        firsts[i] = first < 0 ? i : first;
        if (first >= 0 || !sdv_same_values(value, value, channels)) continue;   // NaN equals none
        next[i] = *head;
        *head = i;
    }
}

SUBDIV_DEF subdiv_result subdiv_join_values(int *firsts, int channels, int value_count,
                                            const float *values, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_arena arena = sdv_scratch();
    size_t mask = 1;
    if (channels < 1 || value_count < 0)
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "channels is %d, value_count %d", channels,
                 value_count);
    else if (value_count > 0 && (!values || !firsts))
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    while (mask < (size_t)(context.result ? 0 : value_count)) mask = 2 * mask + 1;
    int *heads = SDV_NEW(&context, &arena, int, mask + 1);
    int *next = SDV_NEW(&context, &arena, int, context.result ? 0 : value_count);
    if (!context.result)
        sdv_find_firsts(values, channels, value_count, heads, mask, next, firsts);
    sdv_arena_free(&arena);
    return context.result;
}

// ------------------------------------------------------------------------------- >>prepare

// The functions that prepare and evaluate a surface for SUBDIV_EXACT. Only calls that may make such
// a surface name them, so programs without these calls do not get their code.
typedef struct sdv_exact_calls {
    void (*create)(sdv_context *context, subdiv_surface *surface);
    void (*prepare)(sdv_context *context, subdiv_surface *surface, sdv_level *cage,
                    const unsigned char *hole, sdv_arena *arena);
    size_t (*size)(const subdiv_surface *surface, int channels);
    void (*begin)(const subdiv_surface *surface, int channels, const float *in, size_t in_stride,
                  void *scratch, const subdiv_options *opt);
} sdv_exact_calls;

static const sdv_exact_calls *sdv_find_exact_calls(void);       // NULL under SUBDIV_NO_EXACT

struct subdiv_surface {
    // Every surface.
    sdv_arena arena;                    // its first block holds this struct
    sdv_arena points;                   // holds what only makes points: rows, patches
    int       levels;
    sdv_rules rules;
    sdv_order order;                    // of the result, and the topology of the cage
    int       cage_vertex_count, cage_face_count;
    int       face_count;               // of the cage, also faces without values
    int      *cage_face;                // [face_count] the user's face; NULL: the same
    int       borrows;                  // the faces are the user's, not copied, and no locations
                                        // are looked up: the surface lives for a single call

    // Making the points, from level 1 on.
    int       work_count;               // work points
    sdv_batches *refine;                // [levels] the rows to each next level; without orders:
                                        // [2 levels] the rows of face points, of other points
    sdv_order *orders;                  // [levels + 1] of each level; NULL: all points have rows,
                                        // as under SUBDIV_EXACT and SUBDIV_PLAIN
    int      *bases;                    // [levels + 2] the first work point of each level
    int      *quads;                    // see sdv_order
    sdv_batches limit_rows;             // from the last level to the limit; SUBDIV_PLAIN: to any
                                        // result
    sdv_sides   sides;                  // of a limit and of SUBDIV_EXACT: see sdv_sides; and the
    sdv_batches side_rows;              // rows of a limit's. All 0: there are none
    subdiv_surface *at_level_1;         // makes the limit of level 0; else NULL
    struct sdv_exact *exact;            // of SUBDIV_EXACT, see >>exact-surface; else NULL
    const struct sdv_exact_calls *exact_calls;

    // The result before its points are made; not of SUBDIV_EXACT.
    subdiv_mesh fine;                   // without positions; without faces if levels > 0
    unsigned char *hole;                // [face_count]
    int      *first_face;               // [face_count + 1] the first fine face of each face; NULL:
                                        // none are left out, see sdv_first_fine_face

    // Data that the result carries along.
    subdiv_surface *uv;                 // UVs: a surface of their own; or NULL
    float    *uvs, *colors;             // of the cage

    // Surfaces of face-varying values alone.
    int       is_values;                // made by subdiv_prepare_face_varying
    int      *source;                   // [cage_vertex_count] which of the user's values each
                                        // vertex takes; NULL: the same
    int      *own_face;                 // [face_count] the face of order, -1: without values; NULL:
};                                      // the same

// Cuts faces into fans around vertex 0. v has one item for each face-vertex, out three a triangle.
static void sdv_cut(const subdiv_mesh *cage, const int *v, int *out)
{
    for (int f = 0; f < cage->face_count; f++) {
        int size = sdv_face_size(cage, f);
        for (int i = 2; i < size; i++) {
            *out++ = v[0];
            *out++ = v[i - 1];
            *out++ = v[i];
        }
        v += size;
    }
}

// Gives work the faces of the cage, copied or borrowed. Under Loop, larger faces are cut into fans
// around vertex 0, a choice that needs no positions; cage_face says what each is cut from.
static void sdv_copy_faces(sdv_context *context, subdiv_surface *surface, subdiv_mesh *work,
                           const subdiv_mesh *cage)
{
    size_t count = sdv_face_vertex_count(cage), triangles = count - 2 * (size_t)cage->face_count;
    int loop = cage->scheme == SUBDIV_LOOP, cut = 0;
    for (int f = 0; loop && cage->face_size != 3 && f < cage->face_count; f++)
        cut |= sdv_face_size(cage, f) != 3;
    if (cut && triangles > INT_MAX) {
        sdv_fail(context, SUBDIV_ERROR_TOO_LARGE, "the faces make too many triangles");
        return;
    }
    if (cut) count = 3 * triangles;
    if (loop) work->face_size = 3;
    if (work->face_size) work->face_sizes = NULL;
    if (surface->borrows && !cut) return;
    work->face_vertices = SDV_NEW(context, &surface->arena, int, count);
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
    sdv_cut(cage, cage->face_vertices, work->face_vertices);
    work->face_count = 0;
    for (int f = 0; f < cage->face_count; f++)
        for (int i = sdv_face_size(cage, f); i > 2; i--)
            surface->cage_face[work->face_count++] = f;
}

// Makes all triangles of a hole holes, if faces were cut.
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
    for (int f = 0; f < cage->face_count && cage->face_size != 3; f++)
        if (sdv_face_size(cage, f) != 3) {
            sdv_fail_mesh(context, SUBDIV_ERROR_NOT_TRIANGLE, f, -1,
                          "face %d has %d vertices, and Loop needs triangles",
                          f, sdv_face_size(cage, f));
            return;
        }
}

// Fails if a result of so many levels is too large. edges: of the cage; -1: not counted yet.
static void sdv_check_size(sdv_context *context, const subdiv_mesh *work, int levels, int edges)
{
    uint64_t face_vertices = sdv_face_vertex_count(work), faces = (uint64_t)work->face_count;
    uint64_t n = (uint64_t)1 << (levels < 30 ? levels : 30), m = n / 2;
    int loop = work->scheme == SUBDIV_LOOP;
    uint64_t fine = loop ? faces * n * n : face_vertices * m * m;
    if (levels == 0) fine = faces;
    if (levels > 30)
        sdv_fail(context, SUBDIV_ERROR_TOO_LARGE, "%d levels are too many, at most 30 fit", levels);
    if (fine > INT_MAX || (face_vertices && n > 65536)) {     // or the products would wrap
        sdv_fail(context, SUBDIV_ERROR_TOO_LARGE,
                 "%d levels of this mesh make more than %d faces", levels, INT_MAX);
        return;
    }
    if (edges < 0 || levels == 0) return;
    uint64_t inside = loop ? faces * ((n - 1) * (n - 2) / 2) : faces + face_vertices * m * (m - 1);
    if ((uint64_t)work->vertex_count + (uint64_t)edges * (n - 1) + inside > INT_MAX)
        sdv_fail(context, SUBDIV_ERROR_TOO_LARGE,
                 "%d levels of this mesh make more than %d vertices", levels, INT_MAX);
}

// Whether the result lists a sharpness: some is left, and it is not implied by the mesh's shape.
static int sdv_survives(float sharpness)
{
    return sharpness > 0 && sharpness <= SUBDIV_INFINITE;
}

// Whether edge e has a face that is not left out of the result.
static int sdv_edge_is_seen(const subdiv_surface *surface, const sdv_level *cage, int e)
{
    int seen = surface->fine.hole_count > 0, first = cage->edge_first[e], h = first;
    do seen |= !surface->hole[sdv_face_of(cage, h)];
    while ((h = cage->across[h]) != first);
    return seen;
}

// ------------------------------------------------------------------------------ >>limit-rows
// A limit row makes a point of the limit and its two tangents from points of the last level.
//
// The edges at a vertex that are sharp forever part its faces into sectors, each with a limit of
// its own. A sector is open, from one such edge to the next, or all around the vertex; so is that
// of a dart, whose first edge is the sharp one. The points of a sector are the vertex, its
// neighbours counter-clockwise and, under Catmull-Clark, the vertices across its faces. A step of
// refinement makes the same points of the next level from these alone: it is a matrix.
//
// Where nothing fades, the masks of >>masks are the limit. Elsewhere the sharpness is faded level
// by level until nothing does. The rows of weights there, times the matrices of all the steps that
// led there, the last one first, are the rows for the points of the last level.

typedef struct sdv_ray {                // an edge at the vertex: its sharpness and, one level down,
    float now, half, behind;            // that of its half there and of the half behind that
} sdv_ray;

typedef struct sdv_sector {
    int      first;                     // its first face-vertex
    int      faces, edges;              // an open sector has one edge more than faces
    sdv_ray *rays;                      // [edges]
    float    corner;                    // the sharpness of the vertex
    const sdv_sharp_edges *sharp;       // of all sectors at the vertex, on this and later levels;
                                        //      NULL: there is no other, and nobody asked yet
} sdv_sector;

enum { SDV_FADE_LEVELS = 11 };          // after so many, all that is semi-sharp is gone
enum { SDV_DART_STEPS = 2000 };         // at most so many lead to the limit of a dart

static int sdv_sector_points(const sdv_rules *rules, const sdv_sector *s)
{
    return 1 + s->edges + (rules->loop ? 0 : s->faces);
}

// Makes a sector of a rule, where nothing fades.
static void sdv_settle(sdv_sector *s, sdv_rule rule, int faces, int open)
{
    const float forever = SUBDIV_INFINITE;
    const sdv_ray smooth = { 0, 0, 0 }, sharp = { forever, forever, forever };
    static const sdv_sharp_edges edges[] = {
        { 0, 0, 0, 0, 0, 0 }, { 1, 1, 1, 0, 0, 0 }, { 2, 2, 2, 0, 0, 0 }
    };
    s->faces = faces;
    s->edges = faces + open;
    s->corner = rule == SDV_CORNER ? SUBDIV_INFINITE : 0;
    s->sharp = &edges[open ? 2 : rule == SDV_DART];
    for (int i = 0; i < s->edges; i++) s->rays[i] = smooth;
    if (open || rule == SDV_DART) s->rays[0] = sharp;
    if (open) s->rays[faces] = sharp;
}

// Does anything fade that the sector depends on? At corners those are its own edges alone.
static int sdv_sector_fades(const sdv_sector *s)
{
    int fades = sdv_is_semi_sharp(s->corner);
    if (s->corner < SUBDIV_INFINITE && s->sharp) fades |= s->sharp->now > s->sharp->forever;
    for (int i = 0; i < s->edges; i++) fades |= sdv_is_semi_sharp(s->rays[i].now);
    return fades;
}

// Makes the rays of the next level. edges: all at the vertex, on this level. to may be from.
static void sdv_fade_rays(const sdv_rules *rules, const sdv_sharp_edges *edges,
                          const sdv_ray *from, int count, sdv_ray *to)
{
    int chaikin = rules->creasing == SUBDIV_CREASING_CHAIKIN;   // uniform: no edge counts others
    int semi = chaikin ? edges->semi : 0;
    float sum = chaikin ? edges->sum : 0;
    for (int i = 0; i < count; i++) {
        float s = from[i].half, other = from[i].behind;
        to[i].now = s;
        to[i].half = sdv_fade_chaikin(s, sum, semi);
        to[i].behind = sdv_fade_chaikin(s, s + other, 1 + (chaikin && other > 0));
    }
}

// Counts the sharp edges at a vertex, of which these are the rays: on this level and on the later
// ones, up to edges[SDV_FADE_LEVELS]. The rays fade.
static void sdv_fade_edges(const sdv_rules *rules, sdv_ray *rays, int count, sdv_sharp_edges *edges)
{
    memset(edges, 0, (SDV_FADE_LEVELS + 1) * sizeof *edges);
    for (int i = 0; i <= SDV_FADE_LEVELS; i++, edges++) {
        if (i > 0 && edges[-1].semi == 0) {             // nothing fades any more
            edges->now = edges->next = edges->forever = edges[-1].forever;
            continue;
        }
        for (int k = 0; k < count; k++) sdv_meet_edge(edges, rays[k].now, rays[k].half);
        sdv_fade_rays(rules, edges, rays, count, rays);
    }
}

// Makes the sector of the next level. to has room for its rays.
static void sdv_fade_sector(const sdv_rules *rules, const sdv_sector *from, sdv_sector *to)
{
    sdv_ray *rays = to->rays;
    *to = *from;
    to->rays = rays;
    to->corner = sdv_fade(from->corner);
    sdv_fade_rays(rules, from->sharp, from->rays, from->edges, rays);
    to->sharp++;
}

// Multiplies a row of weights by the matrix of a step: w weighs a sector's points on the next
// level, out those on this level.
static void sdv_step_back(const sdv_rules *rules, const sdv_sector *s, const double *w, double *out)
{
    int n = s->faces, edges = s->edges, loop = rules->loop;
    double *edge = out + 1, *across = edge + edges;
    sdv_fading fading = sdv_fading_of(s->corner, s->sharp);
    sdv_mask vertex = sdv_vertex_mask(rules, fading, n);
    out[0] = w[0] * vertex.self;
    for (int i = 0; i < edges; i++) edge[i] = w[0] * vertex.edge;
    for (int i = 0; i < n && !loop; i++) across[i] = w[0] * vertex.face + w[1 + edges + i];
    for (int i = 0; i < edges; i++) {
        const sdv_ray *ray = &s->rays[i];
        sdv_mask mask = sdv_edge_mask(rules, ray->now, ray->half > 0 && ray->behind > 0, 2, 0);
        int left = i < n ? i : -1, right = i > 0 ? i - 1 : edges == n ? n - 1 : -1;
        if ((fading.rule == SDV_CREASE ? ray->now : ray->half) > 0) edge[i] += w[0] * vertex.crease;
        out[0] += w[1 + i] * mask.self;
        edge[i] += w[1 + i] * mask.self;
        if (left >= 0) (loop ? &edge[(i + 1) % edges] : &across[left])[0] += w[1 + i] * mask.face;
        if (right >= 0) (loop ? &edge[right] : &across[right])[0] += w[1 + i] * mask.face;
    }
    for (int i = 0; i < n && !loop; i++) {              // so far these weigh the face points
        across[i] *= sdv_face_weight(4);
        out[0] += across[i];
        edge[i] += across[i];
        edge[(i + 1) % edges] += across[i];
    }
}

// Multiplies the rows of a limit by the matrix of a step: the point's and those of two tangents,
// which may have any length. room [points].
static void sdv_rows_back(const sdv_rules *rules, const sdv_sector *s, double *rows, double *room)
{
    int points = sdv_sector_points(rules, s);
    for (int k = 0; k < 3; k++, rows += points) {
        double most = k > 0 ? 0 : 1, sum = 0;
        sdv_step_back(rules, s, rows, room);
        for (int i = 1; i < points; i++) {
            most = fabs(room[i]) > most ? fabs(room[i]) : most;
            sum += room[i];
        }
        if (k > 0) room[0] = -sum;                      // rounding must not add up
        for (int i = 0; i < points; i++) rows[i] = most > 0 ? room[i] / most : 0;
    }
}

// Makes the rows [3][points] of a sector's limit where nothing fades.
static void sdv_settled_rows(const sdv_rules *rules, const sdv_sector *s, double *rows,
                             double *room)
{
    int n = s->faces, open = s->edges > n, points = sdv_sector_points(rules, s);
    double *t0 = rows + points, *t1 = t0 + points;
    sdv_rule rule = sdv_vertex_rule(s->corner, s->sharp->now);
    sdv_mask mask = sdv_limit_mask(rules, rule, n);
    for (int i = 0; i < 3 * points; i++) rows[i] = 0;
    rows[0] = mask.self;
    for (int i = 1; i <= s->edges; i++)
        rows[i] = mask.edge + (i == 1 || i == s->edges ? mask.crease : 0);
    for (int i = 1 + s->edges; i < points; i++) rows[i] = mask.face;
    sdv_mask vertex = rule == SDV_CREASE ? sdv_crease_vertex() : sdv_corner_vertex();
    if (open) sdv_crease_tangents(rules, vertex, n, t0, t1);
    else sdv_smooth_tangents(rules, n, t0, t1);
    // A dart has no closed form. The more faces, the more alike are the waves, and the longer it
    // takes until the slowest is left.
    int steps = n < 44 ? 64 + n * n : SDV_DART_STEPS;
    for (int i = 0; i < steps && rule == SDV_DART; i++) sdv_rows_back(rules, s, rows, room);
}

// Makes the rows of the limit of sector states[0]: goes on to the level where nothing fades, and
// back. states [SDV_FADE_LEVELS + 1] have room for rays, room for points.
static void sdv_sector_rows(const sdv_rules *rules, sdv_sector *states, double *rows, double *room)
{
    int level = 0;
    for (; level < SDV_FADE_LEVELS && sdv_sector_fades(&states[level]); level++)
        sdv_fade_sector(rules, &states[level], &states[level + 1]);
    sdv_settled_rows(rules, &states[level], rows, room);
    while (level-- > 0) sdv_rows_back(rules, &states[level], rows, room);
}

// Kinds of limit rows whose weights depend on the number of faces alone, as nothing fades. Those of
// an open sector are SDV_CREASE and SDV_WEDGE. The tangents of a linear surface are two edges.
enum { SDV_WEDGE = SDV_CORNER + 1, SDV_LINEAR, SDV_LIMIT_KINDS };

enum { SDV_FADED = 16 };

typedef struct sdv_faded {              // a sector that fades, and its rows
    sdv_sector sector;
    sdv_sharp_edges *sharp;             // of its own: the sector's
    double    *rows;                    // NULL: none yet
} sdv_faded;

typedef struct sdv_limit_writer {       // writes limit rows
    sdv_writer *writer;
    const sdv_level *level;             // the last
    const sdv_rules *rules;
    const sdv_filler *fill;
    int        *known;                  // [SDV_LIMIT_KINDS * (most + 1)] open batches, or -1
    double     *rows, *room;            // of a sector: [3][points], [points]
    sdv_sector  states[SDV_FADE_LEVELS + 1];    // a sector, on the last level and on later ones
    sdv_faded   faded[SDV_FADED];       // the latest ones that fade, by a hash
    const sdv_sharp_edges **sharp;      // [vertex_count] NULL: not known yet; else see
                                        //      sdv_find_sharp_edges
    sdv_sharp_edges *own;               // those of the sector alone
    unsigned char *last;                // [vertex_count] twice its last rule, and is it settled?
                                        //      UCHAR_MAX: not known yet
} sdv_limit_writer;

// Returns the open batch for rows of a kind; -1: out of memory. It has the weights [3][points] for
// the position and either tangent. They are made the first time, under SUBDIV_PLAIN each time.
static int sdv_settled_batch(sdv_limit_writer *limit, int kind, int faces)
{
    static const double linear[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    const double *rows = kind == SDV_LINEAR ? linear : limit->rows;
    sdv_sector *s = &limit->states[0];
    int *known = &limit->known[kind * (limit->writer->most + 1) + faces], points = 3;
    sdv_shape shape;
    if (*known >= 0 && !SDV_IS_PLAIN) return *known;
    if (kind != SDV_LINEAR) {
        sdv_settle(s, kind == SDV_WEDGE ? SDV_CORNER : (sdv_rule)kind, faces,
                   kind == SDV_CREASE || kind == SDV_WEDGE);
        sdv_settled_rows(limit->rules, s, limit->rows, limit->room);
        points = sdv_sector_points(limit->rules, s);
    }
    if (*known >= 0) return *known;
    float *weights = SDV_NEW(limit->writer->context, limit->writer->arena, float, 3 * points);
    for (int i = 0; i < 3 * points && weights; i++) weights[i] = (float)rows[i];
    memset(&shape, 0, sizeof shape);
    shape.count[0] = points - 1;
    shape.regular = kind == SDV_SMOOTH && faces == (limit->rules->loop ? 6 : 4);
    return *known = weights ? sdv_find_open(limit->writer, &shape, weights) : -1;
}

// Adds a limit row of a kind. Its points are in limit->writer->points.
static void sdv_settled_row(sdv_limit_writer *limit, int kind, int faces, int target)
{
    int number = sdv_settled_batch(limit, kind, faces);
    const sdv_open_batch *open = (const sdv_open_batch *)sdv_items(&limit->writer->open);
    if (number >= 0) sdv_copy_row(limit->writer, number, &open[number].shape, target);
}

// Returns the rule of a vertex when all has faded.
static sdv_rule sdv_last_rule(const sdv_level *level, int v)
{
    float corner = level->vertex_sharpness[v];
    return sdv_vertex_rule(corner < SUBDIV_INFINITE ? 0 : corner,
                           sdv_count_sharp_edges(level, v).forever);
}

// Finds the sector, of a vertex with this last rule, that has the face of h.
static void sdv_find_sector(const sdv_level *level, int h, sdv_rule rule, sdv_sector *s)
{
    int v = level->face_vertices[h], first = h, at = -1, q;
    s->first = h;
    s->faces = s->edges = level->vertex_faces[v];
    if (!level->creased[v] && level->vertex_sharpness[v] < SUBDIV_INFINITE) return;
    while (level->sharpness[first] < SUBDIV_INFINITE && at != h) {     // clockwise
        at = sdv_next(level, level->across[first]);
        if (at != h) first = at;
    }
    int open = at != h && rule != SDV_DART;
    if (at == h)                        // all around: begin at a sharp edge, so more are alike
        for (first = h; level->sharpness[first] <= 0 && sdv_around(level, first) != h; )
            first = sdv_around(level, first);
    s->faces = 1;
    for (at = first; ; at = q, s->faces++) {
        int before = sdv_previous(level, at);
        q = level->across[before];
        if (q == first || sdv_sharpness_before(level, before) >= SUBDIV_INFINITE) break;
    }
    s->first = first;
    s->edges = s->faces + open;
}

// Writes the points of a sector, without the vertex.
static void sdv_add_sector(const sdv_level *level, const sdv_sector *s, int loop, int *point)
{
    int *across = point + s->edges;
    for (int i = 0, h = s->first; i < s->faces; i++) {
        *point++ = sdv_point_ahead(level, h);
        if (!loop) *across++ = sdv_point_across(level, h);
        if (i + 1 == s->edges - 1) *point = sdv_point_behind(level, h);
        h = sdv_around(level, h);
    }
}

// Finds how the edge of h fades at the vertex of h or, with end 1, where it ends. (No result: tcc
// 0.9.27 spoils one of three floats.)
static void sdv_find_ray(const sdv_limit_writer *limit, int h, int end, sdv_ray *ray)
{
    const sdv_level *level = limit->level;
    float s = end ? sdv_sharpness_before(level, h) : level->sharpness[h];
    ray->now = s;
    ray->half = end ? sdv_half_before(level, h) : sdv_half(level, h);
    ray->behind = end ? sdv_half(level, h) : sdv_half_before(level, h);
    if (!limit->fill || !level->half_sharpness || !sdv_is_semi_sharp(s)) return;
    sdv_edge_line line = sdv_line_at(limit->fill, h);
    int first = level->edge_first[level->face_edges[h]];
    int v = level->face_vertices[end ? sdv_next(level, h) : h];
    ray->behind = line.next[level->face_vertices[first] == v ? 1 : 2 * line.n - 2];
}

// Returns the sharp edges at vertex v, [SDV_FADE_LEVELS + 1]: on this level and on all later ones.
static const sdv_sharp_edges *sdv_find_sharp_edges(sdv_limit_writer *limit, int v)
{
    const sdv_level *level = limit->level;
    sdv_writer *writer = limit->writer;
    sdv_ray *rays = limit->states[0].rays;
    int count = 0;
    if (limit->sharp[v]) return limit->sharp[v];
    sdv_sharp_edges *edges = SDV_NEW(writer->context, &writer->scratch, sdv_sharp_edges,
                                     SDV_FADE_LEVELS + 1);
    if (!edges) return NULL;
    for (int k = level->vertex_first[v]; k >= 0; k = level->vertex_next[k])
        for (int end = 0; end < 2; end++) {
            int h = end ? sdv_previous(level, k) : k;
            if (!sdv_is_edge_at(level, h, !end)) continue;
            sdv_find_ray(limit, h, end, &rays[count]);
            count += rays[count].now > 0;
        }
    sdv_fade_edges(limit->rules, rays, count, edges);
    return limit->sharp[v] = edges;
}

// Finds how the edges of a sector and its vertex fade.
static void sdv_find_rays(sdv_limit_writer *limit, sdv_sector *s)
{
    const sdv_level *level = limit->level;
    int v = level->face_vertices[s->first];
    s->corner = limit->last[v] / 2 == SDV_CORNER ? SUBDIV_INFINITE : level->vertex_sharpness[v];
    s->sharp = s->faces < level->vertex_faces[v] ? sdv_find_sharp_edges(limit, v) : NULL;
    for (int i = 0, at = s->first; i < s->edges; i++) {
        int before = sdv_previous(level, at), end = i == s->faces;
        sdv_find_ray(limit, end ? before : at, end, &s->rays[i]);
        if (i + 1 < s->faces) at = level->across[before];
    }
}

static int sdv_same_sector(const sdv_sector *a, const sdv_sector *b)
{
    return a->edges == b->edges && a->faces == b->faces &&
           memcmp(&a->corner, &b->corner, sizeof a->corner) == 0 &&
           memcmp(a->rays, b->rays, (size_t)a->edges * sizeof *a->rays) == 0 &&
           !a->sharp == !b->sharp &&
           (!a->sharp || memcmp(a->sharp, b->sharp, (SDV_FADE_LEVELS + 1) * sizeof *a->sharp) == 0);
}

// Returns the rows of sector states[0], which fades. Makes them unless a sector like it was there.
static const double *sdv_find_fading_rows(sdv_limit_writer *limit)
{
    sdv_sector *s = &limit->states[0];
    sdv_context *context = limit->writer->context;
    sdv_arena *scratch = &limit->writer->scratch;
    uint32_t hash = (uint32_t)s->faces, bits[3];
    for (int i = 0; i < s->edges; i++) {
        memcpy(bits, &s->rays[i], sizeof bits);
        hash = ((hash * 2654435761u ^ bits[0]) * 2654435761u ^ bits[1]) * 2654435761u ^ bits[2];
    }
    sdv_faded *known = &limit->faded[(hash * 2654435761u) >> 28];
    sdv_sector *of = &known->sector;
    if (known->rows && !SDV_IS_PLAIN && sdv_same_sector(of, s)) return known->rows;
    size_t most = (size_t)limit->writer->most, levels = SDV_FADE_LEVELS + 1;
    for (int i = 1; i <= SDV_FADE_LEVELS && !limit->states[i].rays; i++)
        limit->states[i].rays = SDV_NEW(context, scratch, sdv_ray, 3 * most + 1);
    if (!known->rows) of->rays = SDV_NEW(context, scratch, sdv_ray, 3 * most + 1);
    if (!known->rows) known->sharp = SDV_NEW(context, scratch, sdv_sharp_edges, levels);
    if (!known->rows) known->rows = SDV_NEW(context, scratch, double, 3 * (2 * most + 2));
    if (context->result) return NULL;
    sdv_ray *rays = of->rays;
    *of = *s;
    of->rays = (sdv_ray *)memcpy(rays, s->rays, (size_t)s->edges * sizeof *rays);
    if (s->sharp) {
        of->sharp = (sdv_sharp_edges *)memcpy(known->sharp, s->sharp, levels * sizeof *s->sharp);
    } else {
        rays = (sdv_ray *)memcpy(limit->states[1].rays, s->rays, (size_t)s->edges * sizeof *rays);
        sdv_fade_edges(limit->rules, rays, s->edges, limit->own);
        s->sharp = limit->own;
    }
    sdv_sector_rows(limit->rules, limit->states, known->rows, limit->room);
    return known->rows;
}

// Adds the limit row of sector states[0], which fades: with weights of its own. Its points are in
// limit->writer->points.
static void sdv_fading_row(sdv_limit_writer *limit, int target)
{
    sdv_writer *writer = limit->writer;
    int points = sdv_sector_points(limit->rules, &limit->states[0]);
    sdv_shape shape;
    memset(&shape, 0, sizeof shape);
    shape.count[0] = points - 1;
    shape.own = 3 * points;
    const double *rows = sdv_find_fading_rows(limit);
    if (!rows) return;
    int *row = sdv_put_row(writer, sdv_find_open(writer, &shape, sdv_own_limit), target);
    if (row == writer->points) return;
    for (int i = 0; i < points; i++) row[i] = writer->points[i];
    for (int i = 0; i < 3 * points; i++) {
        float weight = (float)rows[i];
        memcpy(row + points + i, &weight, sizeof weight);
    }
}

// Is the face of h a hole, or a part of one?
static int sdv_in_hole(const subdiv_surface *surface, const sdv_level *level, int h)
{
    int f = sdv_face_of(level, h);
    if (level->places) f = sdv_face_of(&surface->order.cage, level->places[f].h);
    return surface->hole[f];
}

// Returns the face-vertex of the first face that is no hole among those that follow h: at a vertex
// by vertex_next, at an edge by across. On a crease the limit is that of its side.
static int sdv_first_seen(const subdiv_surface *surface, const sdv_level *level, const int *next,
                          int h)
{
    int best = h;
    for (int k = next[h]; sdv_in_hole(surface, level, best) && k >= 0 && k != h; k = next[k])
        if (sdv_in_hole(surface, level, k) < sdv_in_hole(surface, level, best)) best = k;
    return best;
}

// Adds the limit row of the vertex of h: that of the sector that has the face of h.
static void sdv_limit_row(sdv_limit_writer *limit, int h, int target)
{
    const sdv_level *level = limit->level;
    int v = level->face_vertices[h], *points = limit->writer->points;
    points[0] = level->first_point + v;
    if (limit->rules->linear) {
        points[1] = sdv_point_ahead(level, h);
        points[2] = sdv_point_behind(level, h);
        sdv_settled_row(limit, SDV_LINEAR, 0, target);
        return;
    }
    if (limit->last[v] == UCHAR_MAX)
        limit->last[v] = (unsigned char)(2 * (int)sdv_last_rule(level, v) +
                                         sdv_vertex_settled(level, v));
    sdv_sector *s = &limit->states[0];
    sdv_rule rule = (sdv_rule)(limit->last[v] / 2);
    int corner = rule == SDV_CORNER, settled = limit->last[v] & 1;
    sdv_find_sector(level, h, rule, s);
    sdv_add_sector(level, s, limit->rules->loop, points + 1);
    if (!settled) sdv_find_rays(limit, s);
    if (limit->writer->context->result) return;
    if (settled || !sdv_sector_fades(s)) {
        int wedge = corner && s->edges > s->faces;
        sdv_settled_row(limit, wedge ? SDV_WEDGE : (int)rule, s->faces, target);
        return;
    }
    sdv_fading_row(limit, target);
}

// fill: of the level, if its points stand on lines; else NULL.
static void sdv_begin_limit(sdv_writer *writer, const sdv_rules *rules, const sdv_level *level,
                            const sdv_filler *fill, sdv_limit_writer *limit)
{
    sdv_context *context = writer->context;
    sdv_arena *scratch = &writer->scratch;
    size_t most = (size_t)writer->most, known = SDV_LIMIT_KINDS * (most + 1);
    memset(limit, 0, sizeof *limit);
    limit->writer = writer;
    limit->level = level;
    limit->rules = rules;
    limit->fill = fill;
    limit->last = SDV_NEW(context, scratch, unsigned char, level->vertex_count);
    if (limit->last) memset(limit->last, UCHAR_MAX, (size_t)level->vertex_count);
    limit->known = SDV_NEW(context, scratch, int, known);
    limit->rows = SDV_NEW(context, scratch, double, 3 * (2 * most + 2));
    limit->room = SDV_NEW(context, scratch, double, 2 * most + 2);
    limit->states[0].rays = SDV_NEW(context, scratch, sdv_ray, 3 * most + 1);
    limit->sharp = SDV_NEW(context, scratch, const sdv_sharp_edges *, level->vertex_count);
    limit->own = SDV_NEW(context, scratch, sdv_sharp_edges, SDV_FADE_LEVELS + 1);
    for (size_t i = 0; i < known && !context->result; i++) limit->known[i] = -1;
    for (int v = 0; v < level->vertex_count && !context->result; v++) limit->sharp[v] = NULL;
}

// ------------------------------------------------------------------------------------ >>fill
// Makes the rows of a surface: those of the cage's vertices and edges, then level by level those of
// vertices and lines, and finally those of the limit.

// Returns the order of the points of a level.
static sdv_order sdv_order_at(const subdiv_surface *surface, int level, int frame)
{
    sdv_order order = surface->order;
    int n = 1 << level, vertices = surface->cage_vertex_count;
    order.loop = surface->rules.loop;
    order.n = n;
    order.m = n / 2;
    order.first_edge_point = vertices;
    order.first_inside_point = vertices + order.cage.edge_count * (n - 1);
    order.frame = frame;
    order.quads = surface->quads;
    order.count = order.cage.face_count && level ? sdv_first_inside(&order, order.cage.face_count)
                                                 : vertices;
    return order;
}

static void sdv_set_order(subdiv_surface *surface)
{
    surface->order = sdv_order_at(surface, surface->exact ? 0 : surface->levels, 0);
    surface->fine.vertex_count = surface->order.count;
}

// Counts the quads before each face, for frames.
static void sdv_count_quads(sdv_context *context, subdiv_surface *surface)
{
    const sdv_level *cage = &surface->order.cage;
    int *quads = SDV_NEW(context, &surface->points, int, (size_t)cage->face_count + 1);
    if (context->result) return;
    quads[0] = 0;
    for (int f = 0; f < cage->face_count; f++)
        quads[f + 1] = quads[f] + (sdv_face_end(cage, f) - sdv_face_start(cage, f) == 4);
    surface->quads = quads;
}

// Returns the first of the cage's face points. They are work points, as edge and vertex points are
// made from them: on level 1, at their places there or, if level 1 is the result, behind level 0.
static int sdv_first_face_point(const subdiv_surface *surface)
{
    int last = surface->levels == 1 && !surface->rules.limit;
    return surface->bases[1] + (last ? 0 : sdv_order_at(surface, 1, 0).first_inside_point);
}

// Gives the semi-sharp edges of the cage their pieces: on level 0 one each.
static void sdv_new_pieces(sdv_context *context, sdv_arena *arena, const sdv_level *cage, int n,
                           sdv_pieces *pieces)
{
    memset(pieces, 0, sizeof *pieces);
    for (int e = 0; e < cage->edge_count; e++)
        pieces->count += sdv_is_semi_sharp(cage->sharpness[cage->edge_first[e]]);
    if (pieces->count == 0) return;
    size_t count = (size_t)pieces->count;
    pieces->number = SDV_NEW(context, arena, int, cage->edge_count);
    pieces->now = SDV_NEW(context, arena, float, count * (size_t)n);
    pieces->next = SDV_NEW(context, arena, float, count * (size_t)n);
    for (int e = 0, i = 0; e < cage->edge_count && !context->result; e++) {
        float s = cage->sharpness[cage->edge_first[e]];
        pieces->number[e] = sdv_is_semi_sharp(s) ? i : -1;
        if (sdv_is_semi_sharp(s)) pieces->next[i++] = s;
    }
}

// Counts the creases of the result, piece by piece, and lists them once it has room.
static size_t sdv_surviving_creases(subdiv_surface *surface, const sdv_level *cage,
                                    const sdv_pieces *pieces)
{
    subdiv_mesh *fine = &surface->fine;
    size_t count = 0;
    for (int e = 0; e < cage->edge_count; e++) {
        int number = pieces->count ? pieces->number[e] : -1, h = cage->edge_first[e];
        if (number < 0 && !sdv_survives(cage->sharpness[h])) continue;
        if (!sdv_edge_is_seen(surface, cage, e)) continue;
        int from = cage->face_vertices[h], end = cage->face_vertices[sdv_next(cage, h)];
        int n = surface->order.n;
        const float *of_edge = number < 0 ? NULL : pieces->next + (size_t)number * (size_t)n;
        sdv_side side = sdv_seen_edge(&surface->order, e, from > end);
        for (int j = 0, to; j < n; j++, from = to) {
            float s = of_edge ? of_edge[j] : cage->sharpness[h];
            to = j + 1 == n ? end : side.first + side.step * (j + 1);
            if (!sdv_survives(s)) continue;
            if (fine->crease_vertices) {
                fine->crease_vertices[2 * count] = from;
                fine->crease_vertices[2 * count + 1] = to;
                fine->crease_sharpness[count] = s;
            }
            count++;
        }
    }
    return count;
}

// Gives the result the user's creases and corners that are left on the last level.
static void sdv_surviving_sharpness(sdv_context *context, subdiv_surface *surface,
                                    const sdv_level *cage, const sdv_pieces *pieces)
{
    subdiv_mesh *fine = &surface->fine;
    size_t creases = sdv_surviving_creases(surface, cage, pieces);
    int corners = 0;
    for (int v = 0; v < cage->vertex_count; v++) corners += sdv_survives(cage->vertex_sharpness[v]);
    if (creases > INT_MAX) sdv_fail(context, SUBDIV_ERROR_TOO_LARGE, "too many creases");
    fine->crease_vertices = SDV_NEW(context, &surface->arena, int, 2 * creases);
    fine->crease_sharpness = SDV_NEW(context, &surface->arena, float, creases);
    fine->corner_vertices = SDV_NEW(context, &surface->arena, int, corners);
    fine->corner_sharpness = SDV_NEW(context, &surface->arena, float, corners);
    if (context->result) return;
    if (creases) sdv_surviving_creases(surface, cage, pieces);
    fine->crease_count = (int)creases;
    for (int v = 0; v < cage->vertex_count; v++) {
        if (!sdv_survives(cage->vertex_sharpness[v])) continue;
        fine->corner_vertices[fine->corner_count] = v;
        fine->corner_sharpness[fine->corner_count++] = cage->vertex_sharpness[v];
    }
}

// Goes on to the next level: halves become pieces, and the halves of these are found. Those at an
// edge's ends fade as the vertex there says, others by their neighbours.
static void sdv_fade_lines(const sdv_level *level, int n, sdv_pieces *pieces)
{
    float *swap = pieces->now;
    pieces->now = pieces->next;
    pieces->next = swap;
    for (int e = 0; e < level->edge_count; e++) {
        int i = pieces->number[e], h = level->edge_first[e];
        if (i < 0) continue;
        const float *now = pieces->now + (size_t)i * (size_t)n;
        float *next = pieces->next + 2 * (size_t)i * (size_t)n;
        for (int j = 0; j < 2 * n; j++) {
            int beside = j & 1 ? j / 2 + 1 : j / 2 - 1;     // the piece that this half meets
            float s = now[j / 2], other = beside < 0 || beside == n ? 0 : now[beside];
            if (!level->half_sharpness) next[j] = sdv_fade(s);
            else if (beside < 0) next[j] = sdv_half(level, h);
            else if (beside == n) next[j] = sdv_half_before(level, h);
            else next[j] = sdv_fade_chaikin(s, s + other, 1 + (other > 0));
        }
    }
}

// Gives the cage the sharpness that is left on the next level, at the ends of its edges.
static void sdv_fade_cage(sdv_level *level)
{
    for (int v = 0; v < level->vertex_count; v++) {
        if (!level->creased[v] && level->vertex_sharpness[v] <= 0) continue;
        if (level->partner && level->partner[v] >= 0) level->seam[v] = sdv_seam_left(level, v);
        level->vertex_sharpness[v] = sdv_fade(level->vertex_sharpness[v]);
        for (int h = level->vertex_first[v]; h >= 0; h = level->vertex_next[h])
            level->sharpness[h] = sdv_half(level, h);
    }
    if (level->sums) level->sums += 2 * (size_t)level->origin_count;
    sdv_level_fade(level);
}

// Begins the rows from one level to the next: finds the open batches of smooth points.
static void sdv_begin_fill(sdv_filler *fill, const subdiv_surface *surface, int level, int last)
{
    static const float smooth[5] = { 0, 0, 0, 0, 0 };
    const sdv_runs runs = { { (float)sdv_face_weight(4), 0, 0, 0 }, { 4, 0, 0, 0 }, 0 };
    sdv_shape odd = sdv_odd_shape(fill->rules, smooth, 1), face = sdv_shape_of(&runs);
    sdv_shape even = sdv_even_shape(fill->rules, smooth, 1);
    fill->odd = sdv_find_open(&fill->writer, &odd, NULL);
    fill->even = sdv_find_open(&fill->writer, &even, NULL);
    fill->face = sdv_find_open(&fill->writer, &face, NULL);
    fill->from = surface->orders[level];
    fill->to = last ? surface->order : surface->orders[level + 1];
    fill->base = fill->level->first_point = surface->bases[level];
    fill->target = last ? 0 : surface->bases[level + 1];
    fill->level->order = level ? &fill->from : NULL;
    fill->sharp[0].batch = fill->sharp[1].batch = -1;
    for (int i = 0; i <= fill->writer.most && level <= 1; i++) fill->writer.smooth[i] = -1;
}

// Finds sector states[0] of point t of a semi-sharp line.
static void sdv_line_sector(sdv_limit_writer *limit, const sdv_edge_line *line, int t)
{
    sdv_sector *s = &limit->states[0];
    int loop = limit->rules->loop;
    const sdv_ray ahead = { line->now[t], line->next[2 * t], line->next[2 * t + 1] };
    const sdv_ray back = { line->now[t - 1], line->next[2 * t - 1], line->next[2 * t - 2] };
    sdv_settle(s, SDV_SMOOTH, loop ? 6 : 4, 0);
    s->rays[0] = ahead;
    s->rays[loop ? 3 : 2] = back;
    s->sharp = NULL;
}

// Adds the limit row of point t of a line. A crease gets the limit of the side to its left. Linear
// surfaces have two edges for tangents. line: where it is semi-sharp; else NULL.
static void sdv_limit_line_row(sdv_limit_writer *limit, int t, int sharp, const sdv_edge_line *line,
                               int target)
{
    const sdv_filler *fill = limit->fill;
    const int *p = fill->line, *left = fill->left, *right = fill->right;
    int loop = fill->rules->loop, *points = limit->writer->points, n = 0;
    int kind = sharp ? SDV_CREASE : SDV_SMOOTH;
    points[n++] = p[t];
    points[n++] = p[t + 1];
    points[n++] = left[t];
    if (fill->rules->linear) {
        sdv_settled_row(limit, SDV_LINEAR, 0, target);
        return;
    }
    if (loop) points[n++] = left[t - 1];
    points[n++] = p[t - 1];
    if (!sharp) points[n++] = right[loop ? t - 1 : t];
    if (!sharp && loop) points[n++] = right[t];
    if (!loop) points[n++] = left[t + 1];
    if (!loop) points[n++] = left[t - 1];
    if (!loop && !sharp) points[n++] = right[t - 1];
    if (!loop && !sharp) points[n++] = right[t + 1];
    int fades = line && (line->now[t - 1] > 0 || line->now[t] > 0);
    if (fades) sdv_line_sector(limit, line, t);
    if (fades) sdv_fading_row(limit, target);
    else sdv_settled_row(limit, kind, (loop ? 3 : 2) << !sharp, target);
}

// Adds the limit rows of the points inside the edge of h as seen from its face. target: with where
// they stand, seen from h.
static void sdv_limit_line(sdv_limit_writer *limit, int h, sdv_side target)
{
    const sdv_level *level = limit->level;
    const sdv_filler *fill = limit->fill;
    sdv_edge_line line = sdv_line_at(fill, h);
    sdv_points_on_edge(&fill->from, fill->base, h, fill->line);
    sdv_points_beside(&fill->from, fill->base, h, 0, fill->left);
    if (line.sharpness <= 0 || line.now)
        sdv_points_beside(&fill->from, fill->base, level->across[h], 1, fill->right);
    for (int t = 1; t < line.n; t++)
        sdv_limit_line_row(limit, t, !line.now && line.sharpness > 0, line.now ? &line : NULL,
                           target.first + target.step * t);
}

// Adds the limit rows of the points inside the edge of h, on the side that is seen first.
static void sdv_limit_edge(sdv_limit_writer *limit, const subdiv_surface *surface, int h)
{
    const sdv_level *level = limit->level;
    if (limit->rules->linear || level->sharpness[h] >= SUBDIV_INFINITE)
        h = sdv_first_seen(surface, level, level->across, h);
    sdv_limit_line(limit, h, sdv_edge_side(&limit->fill->to, h, 0));
}

// Adds the row of the centre of an n-gon with so many sides, whose points are in writer->points.
static void sdv_centre_row(sdv_filler *fill, int sides, int target)
{
    sdv_fading smooth = { SDV_SMOOTH, SDV_SMOOTH, 0 };
    sdv_mask mask = sdv_spread_vertex(sdv_vertex_mask(fill->rules, smooth, sides), sides);
    int around = mask.edge != 0 ? sides : 0;
    sdv_runs runs = { { (float)mask.self, 0, (float)mask.edge, (float)mask.face },
                      { 1, 0, around, around }, 0 };
    sdv_add_runs(&fill->writer, &runs, target);
}

// Adds the rows of the points inside the spokes of an n-gon, and of its centre: of the next level
// or, if limit is not NULL, of the limit.
static void sdv_spoke_rows(sdv_filler *fill, sdv_limit_writer *limit, int f)
{
    const sdv_level *cage = &fill->from.cage;
    int start = sdv_face_start(cage, f), sides = sdv_face_end(cage, f) - start, m = fill->from.m;
    int centre = fill->target + sdv_first_inside(&fill->to, f), size = fill->to.m;
    int *points = fill->writer.points, *around = points + 9;   // wait behind those of line rows
    for (int i = 0; i < sides; i++) {
        sdv_side target = sdv_seen_side(centre + 1 + i * (size - 1), size, 1);
        sdv_spoke_points(fill, f, i);
        if (!limit) sdv_smooth_rows(fill, 0, m, target);
        for (int t = 1; t < m && limit; t++)
            sdv_limit_line_row(limit, t, 0, NULL, target.first + target.step * t);
        around[0] = fill->line[m];
        around[1 + i] = fill->line[m - 1];
        around[1 + sides + i] = (limit ? fill->right : fill->left)[m - 1];
    }
    memmove(points, around, (1 + 2 * (size_t)sides) * sizeof *points);
    if (!limit) {
        sdv_centre_row(fill, sides, centre);
    } else if (fill->rules->linear) {       // two edges of the quad at vertex 0
        points[2] = points[1];
        points[1] = points[sides];
        sdv_settled_row(limit, SDV_LINEAR, 0, centre);
    } else sdv_settled_row(limit, SDV_SMOOTH, sides, centre);
}

// Adds the row that makes point target of the result, or of a limit, a copy of a work point.
static void sdv_stay_row(sdv_writer *writer, int limit, int point, int target)
{
    static const float stay[3] = { 1, 0, 0 };
    sdv_shape alone;
    memset(&alone, 0, sizeof alone);
    writer->points[0] = point;
    sdv_add_shape(writer, &alone, limit ? stay : NULL, target);
}

// Adds the rows that make level + 1, face by face: those of the vertices and edges that no earlier
// face has, and those of points inside the face that no grid makes. limit: rows from the last level
// to the limit instead; NULL: no.
static void sdv_fill_level(sdv_filler *fill, subdiv_surface *surface, int level,
                           sdv_limit_writer *limit)
{
    sdv_writer *writer = &fill->writer;
    const sdv_level *cage = fill->level;
    const sdv_rules *rules = fill->rules;
    sdv_begin_fill(fill, surface, level, level + 1 >= surface->levels + rules->limit);
    for (int v = 0; v < cage->vertex_count; v++) {
        if (cage->vertex_first[v] >= 0) continue;
        sdv_stay_row(writer, limit != NULL, fill->base + v, limit ? v : fill->target + v);
    }
    for (int f = 0; f < cage->face_count && !writer->context->result; f++) {
        int start = sdv_face_start(cage, f), end = sdv_face_end(cage, f);
        sdv_batch_face(writer, f);
        for (int h = start; h < end; h++) {
            int v = cage->face_vertices[h], e = cage->face_edges[h];
            if (cage->vertex_first[v] == h && limit)
                sdv_limit_row(limit, sdv_first_seen(surface, cage, cage->vertex_next, h), v);
            else if (cage->vertex_first[v] == h)
                sdv_vertex_row(cage, rules, v, fill->target + v, writer);
            if (cage->edge_first[e] != h) continue;
            if (limit) sdv_limit_edge(limit, surface, h);
            else if (level > 0) sdv_line_rows(fill, h);
            else sdv_edge_row(cage, rules, h, fill->target + fill->to.first_edge_point + e, writer);
        }
        if (level > 0 && sdv_is_ngon(&fill->from, f)) sdv_spoke_rows(fill, limit, f);
        if (fill->to.frame) sdv_frame_rows(fill, f);
    }
    sdv_end_batches(writer, limit ? &surface->limit_rows : &surface->refine[level]);
}

// Adds the limit rows of all sides of creases but the first, each at the face that makes it.
static void sdv_fill_sides(sdv_limit_writer *limit, subdiv_surface *surface)
{
    const sdv_sides *sides = &surface->sides;
    const sdv_level *cage = limit->level;
    int count = sides->vertex ? cage->face_vertex_count : 0, points = surface->order.count;
    int along = surface->order.n - 1;
    for (int h = 0; h < count && !limit->writer->context->result; h++) {
        int v = sides->vertex[h], e = sides->edge[h], first = points + sides->vertices + e * along;
        int back = cage->face_vertices[h] > cage->face_vertices[sdv_next(cage, h)];
        sdv_batch_face(limit->writer, sdv_face_of(cage, h));
        if (v >= 0 && sides->vertex_home[v] == h) sdv_limit_row(limit, h, points + v);
        if (e >= 0 && sides->edge_home[e] == h)
            sdv_limit_line(limit, h, sdv_seen_side(first, along + 1, back));
    }
    sdv_end_batches(limit->writer, &surface->side_rows);
}

// Finds the first work point of each level. The last level has work points for a limit alone.
// whole: with whole grids on all levels, no frames.
static int *sdv_find_bases(sdv_context *context, sdv_arena *arena, const subdiv_surface *surface,
                           int whole)
{
    int levels = surface->levels, faces = surface->rules.loop ? 0 : surface->order.cage.face_count;
    int *bases = SDV_NEW(context, arena, int, levels + 2);
    if (!context->result) bases[0] = 0;
    for (int i = 0; i <= levels && !context->result; i++) {
        int last = i == levels && !surface->rules.limit;
        int points = whole ? sdv_order_at(surface, i, 0).count : surface->orders[i].count;
        double count = !last ? (double)points : i == 1 ? (double)faces : 0;
        if (bases[i] + count > INT_MAX)
            sdv_fail(context, SUBDIV_ERROR_TOO_LARGE,
                     "the levels of this mesh have too many points");
        else bases[i + 1] = bases[i] + (int)count;
    }
    return bases;
}

// Finds the orders of all levels, deep ones with frames, and the work points of each.
static void sdv_find_orders(sdv_context *context, subdiv_surface *surface, sdv_level *cage)
{
    int levels = surface->levels;
    if (levels > SDV_FULL_LEVELS && cage->face_size != 4) sdv_count_quads(context, surface);
    surface->orders = SDV_NEW(context, &surface->points, sdv_order, (size_t)levels + 1);
    for (int i = 0; i <= levels && !context->result; i++)
        surface->orders[i] = sdv_order_at(surface, i, i > SDV_FULL_LEVELS);
    surface->bases = sdv_find_bases(context, &surface->points, surface, 0);
    surface->work_count = context->result ? 0 : surface->bases[levels + 1];
    int point = context->result ? 0 : sdv_first_face_point(surface);
    for (int f = 0; f < cage->face_count; f++) cage->face_point[f] = point + f;
}

// Makes the rows of all levels and of the result under SUBDIV_PLAIN.
static void sdv_plain_rows(sdv_context *context, subdiv_surface *surface, const sdv_level *cage,
                           sdv_writer *writer, sdv_arena *scratch);

// Makes all rows of a surface. sharpness: the result lists the creases and corners that are left.
static void sdv_prepare_rows(sdv_context *context, subdiv_surface *surface, sdv_level *cage,
                             int sharpness, sdv_arena *scratch)
{
    int levels = surface->levels, limit = surface->rules.limit;
    size_t n = (size_t)1 << levels, line = cage->face_count ? n + 1 : 0;
    sdv_pieces pieces;
    sdv_filler fill;
    memset(&fill, 0, sizeof fill);
    sdv_writer_new(context, &surface->points, cage, &fill.writer);
    fill.line = SDV_NEW(context, scratch, int, line);
    fill.left = SDV_NEW(context, scratch, int, line);
    fill.right = SDV_NEW(context, scratch, int, line);
    fill.made = SDV_NEW(context, scratch, int, line);
    surface->refine = SDV_NEW(context, &surface->points, sdv_batches,
                              SDV_IS_PLAIN ? 2 * levels : levels);
    sdv_new_pieces(context, scratch, cage, (int)n << limit, &pieces);
    fill.level = cage;
    fill.rules = &surface->rules;
    fill.pieces = pieces.count ? &pieces : NULL;
    if (SDV_IS_PLAIN) sdv_plain_rows(context, surface, cage, &fill.writer, scratch);
    else sdv_find_orders(context, surface, cage);
    for (int i = 0; i < levels && !context->result; i++) {
        if (fill.pieces) sdv_fade_lines(cage, 1 << i, &pieces);
        if (!SDV_IS_PLAIN) sdv_fill_level(&fill, surface, i, NULL);
        sdv_fade_cage(cage);
    }
    if (!context->result && sharpness) sdv_surviving_sharpness(context, surface, cage, &pieces);
    if (limit && fill.pieces && !context->result) sdv_fade_lines(cage, (int)n, &pieces);
    if (limit && !SDV_IS_PLAIN && !context->result) {
        sdv_limit_writer of_limit;
        sdv_begin_limit(&fill.writer, &surface->rules, cage, &fill, &of_limit);
        sdv_fill_level(&fill, surface, levels, &of_limit);
        sdv_fill_sides(&of_limit, surface);
    }
    sdv_writer_free(&fill.writer);
}

// Returns the first fine face of face f; of the face behind the last one, how many there are.
static int sdv_first_fine_face(const subdiv_surface *surface, int f)
{
    const sdv_order *order = &surface->order;
    if (surface->first_face) return surface->first_face[f];
    int64_t n = order->n, m = order->m;         // without faces n may be 2^30
    return (int)(order->loop ? f * n * n : sdv_face_start(&order->cage, f) * m * m);
}

// Counts the faces of the result, and those that are holes.
static void sdv_count_fine_faces(sdv_context *context, subdiv_surface *surface, int keep_holes)
{
    subdiv_mesh *fine = &surface->fine;
    int holes = 0, count = 0, *first_face;
    fine->face_size = surface->order.loop ? 3 : 4;
    for (int f = 0; f < surface->face_count; f++) holes += surface->hole[f] != 0;
    fine->face_count = sdv_first_fine_face(surface, surface->face_count);
    if (!holes) return;
    first_face = SDV_NEW(context, &surface->arena, int, (size_t)surface->face_count + 1);
    if (context->result) return;
    for (int f = 0; f < surface->face_count; f++) {
        int parts = sdv_first_fine_face(surface, f + 1) - sdv_first_fine_face(surface, f);
        first_face[f] = count;
        if (!surface->hole[f] || keep_holes) count += parts;
        if (surface->hole[f] && keep_holes) fine->hole_count += parts;
    }
    first_face[surface->face_count] = count;
    fine->face_count = count;
    surface->first_face = first_face;
}

// Gives all faces of a sector the number of its side.
static void sdv_mark_side(const sdv_level *cage, const sdv_sector *s, int number, int *side)
{
    for (int i = 0, h = s->first; i < s->faces; i++, h = sdv_around(cage, h)) side[h] = number;
}

// May the face of h be in the result?
static int sdv_is_seen(const subdiv_surface *surface, const sdv_level *cage, int h)
{
    int hole = surface->hole[sdv_face_of(cage, h)];
    return !hole || (surface->exact ? hole != SDV_DROPPED : surface->fine.hole_count > 0);
}

// Finds the sector of the face of h. Each edge of a linear surface is a crease.
static void sdv_find_side(const subdiv_surface *surface, const sdv_level *cage, int h,
                          sdv_rule rule, sdv_sector *s)
{
    s->first = h;
    s->faces = 1;
    if (!surface->rules.linear) sdv_find_sector(cage, h, rule, s);
}

// Numbers the sides of the creases at vertex v, but the first and those without a face in the
// result.
static void sdv_number_vertex_sides(const subdiv_surface *surface, const sdv_level *cage, int v,
                                    sdv_sides *sides)
{
    int first = cage->vertex_first[v], *side = sides->vertex;
    sdv_sector s;
    if (first < 0) return;
    sdv_rule rule = sdv_last_rule(cage, v);
    sdv_find_side(surface, cage, sdv_first_seen(surface, cage, cage->vertex_next, first), rule, &s);
    if (s.faces == cage->vertex_faces[v]) return;
    sdv_mark_side(cage, &s, INT_MAX, side);
    for (int h = first; h >= 0; h = cage->vertex_next[h]) {
        if (side[h] >= 0 || !sdv_is_seen(surface, cage, h)) continue;
        sdv_find_side(surface, cage, h, rule, &s);
        sdv_mark_side(cage, &s, sides->vertices, side);
        sides->vertex_home[sides->vertices++] = h;
    }
    for (int h = first; h >= 0; h = cage->vertex_next[h]) if (side[h] == INT_MAX) side[h] = -1;
}

// Finds the sides of infinitely sharp creases: those of a limit, or of SUBDIV_EXACT.
static void sdv_find_sides(sdv_context *context, sdv_arena *arena, subdiv_surface *surface,
                           const sdv_level *cage)
{
    sdv_sides *sides = &surface->sides;
    size_t count = (size_t)cage->face_vertex_count;
    float least = surface->rules.linear ? 0 : SUBDIV_INFINITE;     // of a crease
    int any = 0;
    for (int h = 0; h < cage->face_vertex_count; h++)
        any |= cage->across[h] != h && cage->sharpness[h] >= least;
    for (int v = 0; v < cage->vertex_count && !any; v++)
        any |= cage->vertex_first[v] >= 0 && !sdv_is_fan(cage, v);
    if (!any) return;
    sides->vertex = SDV_NEW(context, arena, int, count);
    sides->edge = SDV_NEW(context, arena, int, count);
    sides->vertex_home = SDV_NEW(context, arena, int, count);
    sides->edge_home = SDV_NEW(context, arena, int, count);
    if (context->result) return;
    for (size_t i = 0; i < count; i++) sides->vertex[i] = sides->edge[i] = -1;
    for (int v = 0; v < cage->vertex_count; v++)
        sdv_number_vertex_sides(surface, cage, v, sides);
    for (int e = 0; e < cage->edge_count; e++) {
        int first = cage->edge_first[e], h = first;
        if (cage->sharpness[h] < least) continue;
        int own = sdv_first_seen(surface, cage, cage->across, h);
        do {
            if (h == own || !sdv_is_seen(surface, cage, h)) continue;
            sides->edge[h] = sides->edges;
            sides->edge_home[sides->edges++] = h;
        } while ((h = cage->across[h]) != first);
    }
    int64_t all = sdv_count_sides(sides, surface->order.n) + surface->order.count;
    if (all > INT_MAX)
        sdv_fail(context, SUBDIV_ERROR_TOO_LARGE, "the sides of creases have too many normals");
    surface->fine.normal_count = (int)all;
}

// Prepares what makes the points of a surface. For SUBDIV_EXACT, whose result has no points and no
// faces, that frees scratch. sharpness: see sdv_prepare_rows.
static void sdv_prepare_points(sdv_context *context, subdiv_surface *surface, sdv_level *cage,
                               const unsigned char *hole, int sharpness, sdv_arena *scratch)
{
    if (!surface->exact) {
        sdv_prepare_rows(context, surface, cage, sharpness, scratch);
        return;
    }
    surface->fine.vertex_count = surface->fine.face_count = surface->fine.hole_count = 0;
    surface->fine.normal_count = 0;
    surface->first_face = NULL;
    surface->exact_calls->prepare(context, surface, cage, hole, scratch);
}

// ---------------------------------------------------------------------------------- >>create
// Makes a surface from a cage and options.

typedef struct sdv_values {             // face-varying values to refine
    int        count;
    const int *indices;                 // [face-vertices] -1: none
    subdiv_uv_rule rule;
} sdv_values;

typedef struct sdv_request {            // says what surface to make
    const subdiv_mesh *cage;
    int                levels;
    const subdiv_options *opt;
    const sdv_exact_calls *exact;       // NULL: SUBDIV_EXACT is no number of levels
    int                borrows;         // see subdiv_surface
    int                alone;           // of these values alone, not of positions and UVs
    sdv_values         values;
} sdv_request;

static sdv_request sdv_request_of(const subdiv_mesh *cage, int levels,
                                  const sdv_exact_calls *exact, int borrows,
                                  const subdiv_options *opt)
{
    sdv_request request;
    memset(&request, 0, sizeof request);
    request.cage = cage;
    request.levels = levels;
    request.opt = opt;
    request.exact = exact;
    request.borrows = borrows;
    return request;
}

// Checks a request and the topology of its cage.
static void sdv_check_request(sdv_context *context, subdiv_surface **surface,
                              const sdv_request *r)
{
    const subdiv_mesh *cage = r->cage;
    if (surface) *surface = NULL;
    else sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "surface is NULL");
    if (r->levels < 0 && !(r->levels == SUBDIV_EXACT && r->exact))
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "levels is %d", r->levels);
    if (!context->result) sdv_check_data(context, cage);
    if (!context->result && cage->scheme == SUBDIV_LOOP && !(r->opt && r->opt->triangulate))
        sdv_check_triangles(context, cage);
}

// Checks a request for values alone.
static void sdv_check_alone(sdv_context *context, const sdv_request *r)
{
    const subdiv_mesh *cage = r->cage;
    if (context->result || !r->alone) return;
    if (r->values.count < 1 || !r->values.indices) {
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT,
                 r->values.indices ? "value_count is %d" : "indices is NULL", r->values.count);
    } else if (r->values.rule < 0 || r->values.rule > SUBDIV_UV_NONE) {
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "rule is %d", (int)r->values.rule);
    } else {
        sdv_check_indices(context, cage, r->values.indices, -1, r->values.count,
                          "face %d: value %d does not exist (there are %d)");
    }
}

static subdiv_surface *sdv_new_surface(sdv_context *context, const sdv_request *request)
{
    sdv_arena arena = sdv_new_arena(0);
    subdiv_surface *surface = SDV_NEW(context, &arena, subdiv_surface, 1);
    if (!surface) return NULL;
    memset(surface, 0, sizeof *surface);
    surface->arena = arena;
    surface->levels = request->levels;
    surface->borrows = request->borrows;
    surface->exact_calls = request->exact;
    if (surface->levels == SUBDIV_EXACT) request->exact->create(context, surface);
    return surface;
}

// Copies the cage to work, its faces cut if need be. Begins the surface of its values.
static void sdv_take_cage(sdv_context *context, subdiv_surface *surface, const sdv_request *request,
                          subdiv_mesh *work, sdv_values *values)
{
    const subdiv_mesh *cage = request->cage;
    const sdv_values uvs = { cage->uv_count, cage->face_uvs, cage->uv_rule };
    *work = *cage;
    *values = request->alone ? request->values : uvs;
    if (values->count > 0) surface->uv = sdv_new_surface(context, request);
    surface->cage_vertex_count = cage->vertex_count;
    if (!context->result) sdv_copy_faces(context, surface, work, cage);
    if (!context->result) sdv_cut_holes(context, surface, work, cage);
    if (context->result) return;
    sdv_check_size(context, work, surface->exact ? 0 : surface->levels, -1);
    surface->cage_face_count = surface->face_count = work->face_count;
    if (!surface->uv || !surface->cage_face || context->result) return;
    int *indices = SDV_NEW(context, &surface->arena, int, sdv_face_vertex_count(work));
    if (!context->result) sdv_cut(cage, values->indices, indices);
    values->indices = indices;
    surface->uv->cage_face = (int *)sdv_duplicate(context, &surface->uv->arena, surface->cage_face,
                                                  (size_t)work->face_count, sizeof(int));
}

// Gives a surface of values the rules and fine faces of the surface of positions.
static void sdv_share_rules(sdv_context *context, subdiv_surface *made,
                            const subdiv_surface *surface)
{
    made->rules = surface->rules;
    made->order = surface->order;
    made->fine = surface->fine;
    made->fine.crease_count = made->fine.corner_count = made->fine.hole_count = 0;
    made->face_count = surface->face_count;
    made->first_face = SDV_NEW(context, &made->arena, int, (size_t)surface->face_count + 1);
    made->own_face = SDV_NEW(context, &made->arena, int, surface->face_count);
    if (context->result) return;
    for (int f = 0; f <= surface->face_count; f++)
        made->first_face[f] = sdv_first_fine_face(surface, f);
}

// Prepares a surface of values that goes with a surface of positions.
static void sdv_prepare_values(sdv_context *context, subdiv_surface *made,
                               const subdiv_surface *surface, const subdiv_mesh *work,
                               const sdv_cage *cage, const sdv_values *values)
{
    sdv_arena scratch = sdv_scratch();
    sdv_seams seams;
    subdiv_mesh shape = *work;
    memset(&seams, 0, sizeof seams);
    seams.cage = cage;
    seams.values = values->indices;
    seams.value_count = values->count;
    seams.rule = values->rule;
    sdv_share_rules(context, made, surface);
    if (!context->result)
        sdv_seams_build(context, &made->arena, &scratch, &seams, made->own_face, made->levels);
    shape.vertex_count = seams.level.vertex_count;
    sdv_check_size(context, &shape, made->exact ? 0 : made->levels, seams.level.edge_count);
    if (context->result) {
        sdv_arena_free(&scratch);
        return;
    }
    made->source = seams.source;
    made->cage_vertex_count = seams.level.vertex_count;
    made->cage_face_count = seams.level.face_count;
    made->order.cage = seams.level;
    made->rules.vertex_rule = SUBDIV_VERTEX_STANDARD;
    made->rules.vertex_masks = NULL;
    made->rules.linear |= values->rule == SUBDIV_UV_ALL;
    // The exact limit needs no rule for straight edges: their points are on a straight crease.
    made->rules.straight = values->rule == SUBDIV_UV_BOUNDARIES && !made->exact;
    made->rules.limit = 0;
    sdv_set_order(made);
    sdv_prepare_points(context, made, &seams.level, cage->hole, 0, &scratch);
    sdv_arena_free(&scratch);
}

// The arrays that a new mesh has on top of its model's: a result cage_faces, a limit normals, too.
typedef enum sdv_extras { SDV_PLAIN, SDV_RESULT, SDV_LIMIT } sdv_extras;

static void sdv_new_mesh(sdv_context *context, subdiv_mesh *mesh, const subdiv_mesh *model,
                         sdv_extras extras);                    // see >>results-as-meshes

// Prepares level 0: a copy of the cage, without what goes with the surface. indices: of its
// vertices or values, of which there are count.
static void sdv_prepare_copy(sdv_context *context, subdiv_surface *surface, const subdiv_mesh *work,
                             const int *indices, int count)
{
    subdiv_mesh kept = *work, *fine = &surface->fine;
    kept.uv_count = kept.normal_count = kept.statement_count = 0;
    kept.colors = kept.normals = NULL;
    kept.face_normals = NULL;
    sdv_new_mesh(context, fine, &kept, SDV_PLAIN);
    if (context->result) return;
    sdv_copy(fine->face_vertices, indices, sdv_face_vertex_count(work), sizeof(int));
    sdv_copy(fine->holes, work->holes, (size_t)work->hole_count, sizeof(int));
    fine->positions = NULL;
    fine->vertex_count = surface->cage_vertex_count = surface->work_count = count;
    surface->cage_face_count = surface->face_count = work->face_count;
}

// Copies the statements. Each stands before the first fine face of its face, or of the next face
// that has any.
static void sdv_keep_statements(sdv_context *context, subdiv_surface *surface,
                                const subdiv_mesh *cage)
{
    subdiv_mesh *fine = &surface->fine;
    size_t count = (size_t)cage->statement_count, size = 0;
    for (size_t i = 0; i < count; i++) size += strlen(cage->statements[i]) + 1;
    char *text = SDV_NEW(context, &surface->arena, char, size);
    fine->statement_count = cage->statement_count;
    fine->statement_faces = SDV_NEW(context, &surface->arena, int, count);
    fine->statements = SDV_NEW(context, &surface->arena, char *, count);
    for (size_t i = 0, f = 0; i < count && !context->result; i++) {
        int face = cage->statement_faces[i];
        size_t faces = (size_t)surface->face_count;
        while (f < faces && (surface->cage_face ? surface->cage_face[f] : (int)f) < face) f++;
        int same = surface->levels == 0 || surface->exact;
        fine->statement_faces[i] = same ? (int)f : sdv_first_fine_face(surface, (int)f);
        fine->statements[i] = strcpy(text, cage->statements[i]);
        text += strlen(text) + 1;
    }
}

// Copies the UVs, colours and statements that go with the surface.
static void sdv_keep_data(sdv_context *context, subdiv_surface *surface, const subdiv_mesh *cage)
{
    subdiv_mesh *fine = &surface->fine;
    size_t uvs = 2 * (size_t)cage->uv_count;
    size_t colors = cage->colors ? 3 * (size_t)cage->vertex_count : 0;
    sdv_arena *arena = &surface->arena;
    surface->uvs = (float *)sdv_duplicate(context, arena, cage->uvs, uvs, sizeof(float));
    surface->colors = (float *)sdv_duplicate(context, arena, cage->colors, colors, sizeof(float));
    if (context->result) return;
    fine->uv_count = surface->uv ? surface->uv->fine.vertex_count : 0;
    fine->uvs = fine->normals = NULL;
    fine->face_uvs = fine->face_normals = NULL;
    fine->colors = surface->colors;
    sdv_keep_statements(context, surface, cage);
}

// May a vertex be smooth, or the end of a single crease, on this level or a later one?
static int sdv_may_be_smooth(const sdv_level *level, int v)
{
    return level->vertex_sharpness[v] < SUBDIV_INFINITE &&
           sdv_count_sharp_edges(level, v).forever < 2;
}

// Asks the callback of a mesh for the mask of a valence, unless it is known. limit: such a vertex
// needs a limit.
static void sdv_ask_weights(sdv_context *context, const subdiv_mesh *mesh, int limit,
                            const sdv_rules *rules, sdv_mask *masks, int n)
{
    double w[3] = { 0, 0, 0 };
    if (n == 0 || masks[n].self + masks[n].edge + masks[n].face != 0 || context->result) return;
    mesh->vertex_weights(mesh->vertex_user, n, w);
    if (rules->loop) w[2] = 0;
    masks[n] = sdv_means_vertex(rules->loop, n, w[1], w[2]);
    int finite = fabs(w[0]) + fabs(w[1]) + fabs(w[2]) <= (double)FLT_MAX;
    const char *what = !finite ? "are not finite" :
                       !(fabs(w[0] + w[1] + w[2] - 1) < 1e-6) ? "do not sum to 1" :
                       limit && !(sdv_spike_of(rules, n) < 1 - 1e-9) ? "lead to no limit" : NULL;
    if (what) sdv_fail(context, finite ? SUBDIV_ERROR_ARGUMENT : SUBDIV_ERROR_NOT_FINITE,
                       "vertex_weights: the weights for valence %d %s", n, what);
}

// Sets the vertex rule of a cage, and asks a callback for all valences of smooth vertices.
static void sdv_set_vertex_rule(sdv_context *context, sdv_arena *arena, const subdiv_mesh *mesh,
                                const sdv_level *cage, int limit, sdv_rules *rules)
{
    size_t count = (size_t)sdv_most_faces(cage) + 1;
    rules->vertex_rule = mesh->vertex_weights ? SUBDIV_VERTEX_STANDARD : mesh->vertex_rule;
    if (!mesh->vertex_weights || rules->linear) return;
    sdv_mask *masks = SDV_NEW(context, arena, sdv_mask, count);
    if (!masks) return;
    memset(masks, 0, count * sizeof *masks);
    rules->vertex_masks = masks;
    sdv_ask_weights(context, mesh, limit, rules, masks, rules->loop ? 6 : 4);
    for (int v = 0; v < cage->vertex_count; v++)
        if (sdv_may_be_smooth(cage, v))
            sdv_ask_weights(context, mesh, limit, rules, masks, cage->vertex_faces[v]);
    for (int f = 0; f < cage->face_count && !rules->loop; f++)
        sdv_ask_weights(context, mesh, limit, rules, masks,
                        sdv_face_end(cage, f) - sdv_face_start(cage, f));
}

// Sets the rules of a surface from the cage and the options, and counts what the result will have.
static void sdv_set_rules(sdv_context *context, subdiv_surface *surface,
                          const sdv_request *request, const sdv_cage *built)
{
    const subdiv_mesh *cage = request->cage;
    const subdiv_options *opt = request->opt;
    surface->order.cage = built->level;
    surface->hole = built->hole;
    surface->fine.scheme = cage->scheme;
    surface->fine.boundary = cage->boundary;
    surface->fine.creasing = cage->creasing;
    surface->fine.triangles = cage->triangles;
    surface->fine.uv_rule = cage->uv_rule;
    surface->fine.vertex_rule = cage->vertex_rule;
    surface->fine.vertex_weights = cage->vertex_weights;
    surface->fine.vertex_user = cage->vertex_user;
    surface->fine.left_handed = surface->rules.left_handed = cage->left_handed != 0;
    surface->rules.loop = cage->scheme == SUBDIV_LOOP;
    surface->rules.linear = cage->scheme == SUBDIV_BILINEAR || (opt && opt->linear);
    surface->rules.creasing = cage->creasing;
    surface->rules.triangles = cage->triangles;
    if (!request->alone)
        sdv_set_vertex_rule(context, &surface->arena, cage, &built->level,
                            surface->rules.limit || surface->exact, &surface->rules);
    sdv_set_order(surface);
    sdv_count_fine_faces(context, surface, opt && opt->keep_holes);
    surface->fine.normal_count = surface->rules.limit ? surface->order.count : 0;
    if ((surface->rules.limit || surface->exact) && !request->alone && !(opt && opt->one_normal))
        sdv_find_sides(context, &surface->arena, surface, &built->level);
}

// Makes a surface for the positions and for the values that go with them, or for values alone.
static subdiv_result sdv_prepare(subdiv_surface **surface, const sdv_request *request)
{
    sdv_context context = sdv_begin(request->opt);
    sdv_arena scratch = sdv_scratch();
    subdiv_mesh work;
    sdv_values values = request->values;
    sdv_cage built;
    sdv_check_request(&context, surface, request);
    sdv_check_alone(&context, request);
    subdiv_surface *made = context.result ? NULL : sdv_new_surface(&context, request);
    if (!made) return context.result;
    int levels = request->levels, exact = levels == SUBDIV_EXACT;
    made->rules.limit = !exact && !request->alone && request->opt && request->opt->limit;
    if (!context.result) sdv_take_cage(&context, made, request, &work, &values);
    if (levels == 0 && !context.result)
        sdv_prepare_copy(&context, made, &work, work.face_vertices, work.vertex_count);
    if (levels == 0 && !context.result && made->uv)
        sdv_prepare_copy(&context, made->uv, &work, values.indices, values.count);
    if (levels != 0 && !context.result) {
        sdv_cage_build(&context, &made->arena, &scratch, &built, &work);
        if (!exact) sdv_check_size(&context, &work, levels, built.level.edge_count);
    }
    if (levels != 0 && !context.result) sdv_set_rules(&context, made, request, &built);
    if (exact && !context.result && !sdv_is_spline(&made->rules))
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "SUBDIV_EXACT and tessellation need the masks "
                 "of splines at regular vertices, and vertex rule \"%s\" has others",
                 made->rules.vertex_masks ? "vertex_weights"
                                          : sdv_vertex_rules[made->rules.vertex_rule]);
    if (levels != 0 && made->uv && !context.result)
        sdv_prepare_values(&context, made->uv, made, &work, &built, &values);
    if (levels != 0 && !request->alone && !context.result)
        sdv_prepare_points(&context, made, &built.level, built.hole,
                           work.crease_count || work.corner_count, &scratch);
    sdv_arena_free(&scratch);
    if (!context.result && !request->alone) sdv_keep_data(&context, made, request->cage);
    if (!context.result && levels == 0 && made->rules.limit) {
        sdv_request first = *request;
        subdiv_options keep = *request->opt;
        keep.keep_holes = 1;                    // as level 0 does
        first.opt = &keep;
        first.levels = 1;
        context.result = sdv_prepare(&made->at_level_1, &first);
        if (!context.result)
            made->fine.normal_count = work.vertex_count + made->at_level_1->sides.vertices;
    }
    if (context.result) subdiv_surface_free(made);
    else *surface = made;
    return context.result;
}

// --------------------------------------------------------------------------------- >>results
// Writes the points of a result, four channels at a time.

typedef struct sdv_window {             // the points to write, up to four channels of each
    float *values;                      // where point first goes; NULL: not wanted
    size_t stride;                      // floats from point to point
    int    lanes;                       // 1 to 4 channels
    int    first, count;                // points first to first + count - 1 are written
    int    clip;                        // points outside this range come, too, and are left out
    struct sdv_tangents *tangents;      // of a limit: where normals and tangents go, or NULL
    int    all;                         // of a limit: all points and normals go, but no tangents
    sdv_four origin;                    // from where points are seen: see sdv_find_origin
    sdv_four unmoved;                   // 1 in channels where that is 0, else 0
} sdv_window;

static sdv_window sdv_window_of(float *values, size_t stride, int lanes, int first, int count,
                                int clip)
{
    sdv_window window = { values, stride, lanes, first, count, clip, NULL, 0,
                          sdv_all(0), sdv_all(1) };
    return window;
}

// Points that will be written are seen from origin [4].
static void sdv_see_from(sdv_window *window, const float *origin)
{
    float unmoved[4];
    for (int k = 0; k < 4; k++) unmoved[k] = fabsf(origin[k]) > 0 ? 0 : 1;
    window->origin = sdv_load(origin);
    window->unmoved = sdv_load(unmoved);
}

SDV_INLINE void sdv_store_some(float *p, sdv_four a, int lanes)
{
    if (lanes == 4) {
        sdv_store(p, a);
    } else if (lanes == 3) {
        sdv_store_three(p, a);
    } else {
        float x[4];
        sdv_store(x, a);
        p[0] = x[0];
        if (lanes == 2) p[1] = x[1];
    }
}

// Writes point index of the result, if the window wants it.
SDV_INLINE void sdv_put_whole(const sdv_window *out, int index, sdv_four a)
{
    int i = index - out->first;
    if (i >= 0 && i < out->count && out->values)
        sdv_store_some(out->values + out->stride * (size_t)i, a, out->lanes);
}

// Writes a point that is seen from the window's origin.
SDV_INLINE void sdv_put_point(const sdv_window *out, int index, sdv_four a)
{
    sdv_put_whole(out, index, sdv_plus(out->origin, a));
}

// ------------------------------------------------------------------------- >>limit-surface
// Writes the normals and tangents of the limit's points. Rows and grids make the tangents; normals
// are made from these, four at a time.

typedef struct sdv_tangents {           // goes with an sdv_window, or with samples
    float *normals, *tangents;          // where they go, or NULL
    size_t stride, tangent_stride;      // floats from point to point
    int      count;                     // points that wait until there are four;
    int      at[4];                     // their places in the window, or their numbers
    sdv_four along[4], across[4];       // their tangents,
    int      from[4];                   // and the work points that they are made from, or -1:
    const float *work;                  // rounding is in proportion to their size
    int      left_handed;               // normals are turned round
} sdv_tangents;

static double sdv_dot3(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void sdv_cross(const double *a, const double *b, double *n)
{
    n[0] = a[1] * b[2] - a[2] * b[1];
    n[1] = a[2] * b[0] - a[0] * b[2];
    n[2] = a[0] * b[1] - a[1] * b[0];
}

// Scales a vector to length 1. The vector 0 stays.
SDV_INLINE void sdv_make_unit(const double *n, float *unit)
{
    double squares = sdv_dot3(n, n), scale = squares > 0 ? 1 / sqrt(squares) : 0;
    for (int k = 0; k < 3; k++) unit[k] = scale > 0 ? (float)(n[k] * scale) : 0;
}

// Where faces are folded onto each other, the tangent across the fold is 0 but for rounding: its
// square is no more than so much of the other's and of that of the point's distance to the origin.
static const double sdv_fold = 1e-10, sdv_fold_origin = 1.6e-11;

// Scales a x b to length 1 or, where it is no more than rounding, to 0: where a square is less than
// fold, and where parallel, the largest squared sine of such an angle. Doubles hold the squares of
// products of all floats.
static void sdv_unit_cross(const double *a, const double *b, double parallel, double fold,
                           float *unit)
{
    double n[3], aa = sdv_dot3(a, a), bb = sdv_dot3(b, b);
    sdv_cross(a, b, n);
    if (sdv_dot3(n, n) <= parallel * aa * bb || aa < fold || bb < fold) n[0] = n[1] = n[2] = 0;
    sdv_make_unit(n, unit);
}

// Makes the unit normal of tangents a and b, which rounding may have turned by 1e-6. from: the work
// point that they are made from, or NULL.
static void sdv_unit_normal(const float *a, const float *b, const float *from, float *normal)
{
    const float zero[3] = { 0, 0, 0 }, *of[3] = { a, b, from ? from : zero };
    double x[3][3];
    for (int i = 0; i < 9; i++) x[i / 3][i % 3] = (double)of[i / 3][i % 3];
    sdv_unit_cross(x[0], x[1], 1e-12, sdv_fold_origin * sdv_dot3(x[2], x[2]) +
                   sdv_fold * (sdv_dot3(x[0], x[0]) + sdv_dot3(x[1], x[1])), normal);
}

SDV_INLINE sdv_four sdv_dot(const sdv_four *a, const sdv_four *b)
{
    return sdv_plus(sdv_plus(sdv_times(a[0], b[0]), sdv_times(a[1], b[1])), sdv_times(a[2], b[2]));
}

SDV_INLINE void sdv_cross_four(const sdv_four *a, const sdv_four *b, sdv_four *n)
{
    n[0] = sdv_minus(sdv_times(a[1], b[2]), sdv_times(a[2], b[1]));
    n[1] = sdv_minus(sdv_times(a[2], b[0]), sdv_times(a[0], b[2]));
    n[2] = sdv_minus(sdv_times(a[0], b[1]), sdv_times(a[1], b[0]));
}

// Makes the unit normals of four pairs of tangents, channel by channel. Floats suffice unless their
// products are too small or too large, a or b may be a fold's, or they are almost parallel: n n =
// a a b b sin^2, and a small sine costs digits. from: the work point of each, or -1; or NULL.
SDV_INLINE void sdv_unit_normals(const sdv_four *a, const sdv_four *b, const int *from,
                                 const float *work, sdv_four *n)
{
    const float least_sin2 = 1.0f / 64, thin = 1e-6f;
    sdv_cross_four(a, b, n);
    sdv_four nn = sdv_dot(n, n), aa = sdv_dot(a, a), bb = sdv_dot(b, b), aabb = sdv_times(aa, bb);
    sdv_four sum = sdv_plus(aa, bb), thins = sdv_times(sdv_all(thin), sdv_times(sum, sum));
    sdv_four least = sdv_plus(sdv_all(1e-30f), thins);
    sdv_four scale = sdv_over(sdv_all(1), sdv_sqrt(nn));
    n[0] = sdv_times(n[0], scale);
    n[1] = sdv_times(n[1], scale);
    n[2] = sdv_times(n[2], scale);
    if (sdv_less(least, aabb) && sdv_less(sdv_times(sdv_all(least_sin2), aabb), nn)) return;
    float squares[3][4], vectors[3][3][4], lane[3][3];
    const sdv_four *of[3] = { n, a, b };
    sdv_store(squares[0], least);
    sdv_store(squares[1], aabb);
    sdv_store(squares[2], nn);
    for (int i = 0; i < 9; i++) sdv_store(vectors[i / 3][i % 3], of[i / 3][i % 3]);
    for (int k = 0; k < 4; k++) {
        if (squares[0][k] < squares[1][k] && least_sin2 * squares[1][k] < squares[2][k]) continue;
        const float *point = from && from[k] >= 0 ? work + 4 * (size_t)from[k] : NULL;
        for (int i = 0; i < 9; i++) lane[i / 3][i % 3] = vectors[i / 3][i % 3][k];
        sdv_unit_normal(lane[1], lane[2], point, lane[0]);
        for (int i = 0; i < 3; i++) vectors[0][i][k] = lane[0][i];
    }
    for (int i = 0; i < 3; i++) n[i] = sdv_load(vectors[0][i]);
}

// Writes the normals of four points to places at in the window, from their tangents. from: see
// sdv_unit_normals.
static void sdv_put_normals(const sdv_tangents *tangents, const int *at, sdv_four *along,
                            sdv_four *across, const int *from)
{
    sdv_four n[4];
    int left = tangents->left_handed;
    float *normals = tangents->normals;
    sdv_transpose(along);
    sdv_transpose(across);
    sdv_unit_normals(left ? across : along, left ? along : across, from, tangents->work, n);
    n[3] = n[2];
    sdv_transpose(n);
    sdv_store_three(normals + tangents->stride * (size_t)at[0], n[0]);
    sdv_store_three(normals + tangents->stride * (size_t)at[1], n[1]);
    sdv_store_three(normals + tangents->stride * (size_t)at[2], n[2]);
    sdv_store_three(normals + tangents->stride * (size_t)at[3], n[3]);
}

// Writes the tangents and normals of the points that wait. If they are fewer than four, the last
// one's normal is made again.
static void sdv_flush_tangents(sdv_tangents *tangents)
{
    int count = tangents->count;
    if (count == 0) return;
    tangents->count = 0;
    for (int i = 0; i < count && tangents->tangents; i++) {
        float *to = tangents->tangents + tangents->tangent_stride * (size_t)tangents->at[i];
        sdv_store_three(to, tangents->along[i]);
        sdv_store_three(to + 3, tangents->across[i]);
    }
    if (!tangents->normals) return;
    for (int i = count; i % 4 > 0; i++) {
        tangents->at[i] = tangents->at[i - 1];
        tangents->from[i] = tangents->from[i - 1];
        tangents->along[i] = tangents->along[i - 1];
        tangents->across[i] = tangents->across[i - 1];
    }
    sdv_put_normals(tangents, tangents->at, tangents->along, tangents->across, tangents->from);
}

// Makes a point wait with its tangents. from: its work point, or -1.
SDV_INLINE void sdv_add_tangents(sdv_tangents *tangents, int at, sdv_four along, sdv_four across,
                                 int from)
{
    int i = tangents->count++;
    tangents->at[i] = at;
    tangents->along[i] = along;
    tangents->across[i] = across;
    tangents->from[i] = from;
    if (i == 3) sdv_flush_tangents(tangents);
}

// Makes a point wait if the window has it.
SDV_INLINE void sdv_put_tangents(const sdv_window *out, int index, sdv_four along,
                                 sdv_four across, int from)
{
    int at = index - out->first;
    if (at >= 0 && at < out->count) sdv_add_tangents(out->tangents, at, along, across, from);
}

// Writes a point of the limit, and makes it wait for its normal, if the window wants them.
SDV_INLINE void sdv_put_limit(const sdv_window *out, int index, sdv_four p, sdv_four along,
                              sdv_four across, int from)
{
    if (out->all) {
        sdv_store_three(out->values + out->stride * (size_t)index, p);
        sdv_add_tangents(out->tangents, index, along, across, from);
        return;
    }
    sdv_put_whole(out, index, p);
    if (out->tangents) sdv_put_tangents(out, index, along, across, from);
}

// --------------------------------------------------------------------------------- >>grids
// The general step makes the points of a level from those of the level before, by masks alone: in
// batches of rows and, inside faces, grid by grid.

// Returns the sum of p - p0 over n points. n is a constant in calls for rows that occur often.
SDV_INLINE sdv_four sdv_run_sum(const int *points, int n, sdv_four p0, const float *work)
{
    sdv_four sum = sdv_all(0);
    for (; n >= 4; n -= 4, points += 4) {
        sdv_four a = sdv_minus(sdv_load(work + 4 * (size_t)points[0]), p0);
        sdv_four b = sdv_minus(sdv_load(work + 4 * (size_t)points[1]), p0);
        sdv_four c = sdv_minus(sdv_load(work + 4 * (size_t)points[2]), p0);
        sdv_four d = sdv_minus(sdv_load(work + 4 * (size_t)points[3]), p0);
        sum = sdv_plus(sum, sdv_plus(sdv_plus(a, b), sdv_plus(c, d)));
    }
    if (n & 2) {
        sdv_four a = sdv_minus(sdv_load(work + 4 * (size_t)points[0]), p0);
        sum = sdv_plus(sum, sdv_plus(a, sdv_minus(sdv_load(work + 4 * (size_t)points[1]), p0)));
        points += 2;
    }
    if (n & 1) sum = sdv_plus(sum, sdv_minus(sdv_load(work + 4 * (size_t)points[0]), p0));
    return sum;
}

// Returns the sum of a row as >>rows says: p0 + w0 (sum of p - p0) + ...
SDV_INLINE sdv_four sdv_batch_sum(const int *points, int n0, int n1, int n2, const float *w,
                                  const float *work)
{
    const sdv_four p0 = sdv_load(work + 4 * (size_t)points[0]);
    sdv_four made = p0;
    points++;
    if (n0) made = sdv_plus(made, sdv_times(sdv_all(w[0]), sdv_run_sum(points, n0, p0, work)));
    points += n0;
    if (n1) made = sdv_plus(made, sdv_times(sdv_all(w[1]), sdv_run_sum(points, n1, p0, work)));
    points += n1;
    if (n2) made = sdv_plus(made, sdv_times(sdv_all(w[2]), sdv_run_sum(points, n2, p0, work)));
    return made;
}

// Makes rows first to end - 1 of a batch. own: rows have their own weights; clip: see sdv_window.
SDV_INLINE void sdv_rows_of(const sdv_batch *batch, int first, int end, int n0, int n1, int n2,
                            int own, int clip, const float *work, const sdv_window *out)
{
    const int width = 1 + n0 + n1 + n2, stride = 1 + width + own, lanes = out->lanes;
    const int *row = batch->items + (size_t)stride * (size_t)first;
    const size_t step = out->stride;
    const sdv_four origin = out->origin;
    float *values = out->values;
    float w[3] = { batch->shape.weight[0], batch->shape.weight[1], batch->shape.weight[2] };
    for (int i = first; i < end; i++, row += stride) {
        if (own) memcpy(w, row + 1 + width, sizeof w);
        sdv_four p = sdv_batch_sum(row + 1, n0, n1, n2, w, work);
        if (clip) sdv_put_point(out, row[0], p);
        else sdv_store_some(values + step * (size_t)row[0], sdv_plus(origin, p), lanes);
    }
}

// Makes rows first to end - 1 of a batch. Shapes that occur often have loops of their own.
static void sdv_make_rows(const sdv_batch *batch, int first, int end, const float *work,
                          const sdv_window *out)
{
    const int *n = batch->shape.count;
    if (out->clip) sdv_rows_of(batch, first, end, n[0], n[1], n[2], batch->shape.own, 1, work, out);
    else if (batch->shape.own || n[2])
        sdv_rows_of(batch, first, end, n[0], n[1], n[2], batch->shape.own, 0, work, out);
    else if (n[0] == 3 && n[1] == 0) sdv_rows_of(batch, first, end, 3, 0, 0, 0, 0, work, out);
    else if (n[0] == 8 && n[1] == 0) sdv_rows_of(batch, first, end, 8, 0, 0, 0, 0, work, out);
    else if (n[0] == 4 && n[1] == 4) sdv_rows_of(batch, first, end, 4, 4, 0, 0, 0, work, out);
    else if (n[0] == 1 && n[1] == 4) sdv_rows_of(batch, first, end, 1, 4, 0, 0, 0, work, out);
    else if (n[0] == 6 && n[1] == 0) sdv_rows_of(batch, first, end, 6, 0, 0, 0, 0, work, out);
    else if (n[0] == 1 && n[1] == 2) sdv_rows_of(batch, first, end, 1, 2, 0, 0, 0, work, out);
    else if (n[0] == 2 && n[1] == 0) sdv_rows_of(batch, first, end, 2, 0, 0, 0, 0, work, out);
    else if (n[0] == 1 && n[1] == 0) sdv_rows_of(batch, first, end, 1, 0, 0, 0, 0, work, out);
    else if (n[0] == 0 && n[1] == 0) sdv_rows_of(batch, first, end, 0, 0, 0, 0, 0, work, out);
    else sdv_rows_of(batch, first, end, n[0], n[1], 0, 0, 0, work, out);
}

// The weights of the limit at a regular smooth vertex: for the point, of the vertex, its neighbours
// and, under Catmull-Clark, the vertices across its faces; for tangents, of pairs of opposite ones.
typedef struct sdv_ring_weights {
    sdv_four self, edge, face, along[2], across[2];
} sdv_ring_weights;

// Picks a ring's weights from a limit mask [3][points], whose points are in sdv_add_fan's order.
static sdv_ring_weights sdv_ring_of(const float *w, int loop)
{
    sdv_ring_weights ring;
    const float *t0 = w + (loop ? 7 : 9), *t1 = t0 + (loop ? 7 : 9);
    ring.self = sdv_all(w[0]);
    ring.edge = sdv_all(w[1]);
    ring.face = sdv_all(w[loop ? 1 : 5]);
    ring.along[0] = sdv_all(t0[1]);
    ring.along[1] = sdv_all(t0[loop ? 2 : 5]);
    ring.across[0] = sdv_all(t1[2]);
    ring.across[1] = sdv_all(t1[loop ? 2 : 5]);
    return ring;
}

// Adds up the points p[1], p[2], ... around a vertex: their part of its limit point, two tangents.
SDV_INLINE void sdv_limit_ring(const sdv_ring_weights *w, int loop, const sdv_four *p,
                               sdv_four *sums)
{
    sdv_four edges = sdv_plus(sdv_plus(p[1], p[loop ? 4 : 3]), sdv_plus(p[2], p[loop ? 5 : 4]));
    if (loop) {
        sdv_four d1 = sdv_minus(p[2], p[5]), d2 = sdv_minus(p[3], p[6]);
        sums[0] = sdv_times(w->edge, sdv_plus(edges, sdv_plus(p[3], p[6])));
        sums[1] = sdv_plus(sdv_times(w->along[0], sdv_minus(p[1], p[4])),
                           sdv_times(w->along[1], sdv_minus(d1, d2)));
        sums[2] = sdv_times(w->across[0], sdv_plus(d1, d2));
        return;
    }
    sdv_four d0 = sdv_minus(p[5], p[7]), d1 = sdv_minus(p[8], p[6]);
    sdv_four faces = sdv_plus(sdv_plus(p[5], p[7]), sdv_plus(p[8], p[6]));
    sums[0] = sdv_plus(sdv_times(w->edge, edges), sdv_times(w->face, faces));
    sums[1] = sdv_plus(sdv_times(w->along[0], sdv_minus(p[1], p[3])),
                       sdv_times(w->along[1], sdv_plus(d0, d1)));
    sums[2] = sdv_plus(sdv_times(w->across[0], sdv_minus(p[2], p[4])),
                       sdv_times(w->across[1], sdv_minus(d0, d1)));
}

// Returns the weights of a limit row of a batch.
static const float *sdv_limit_weights_of(const sdv_batch *batch, const int *row)
{
    const void *own = row + 1 + sdv_row_points(&batch->shape);
    return batch->shape.own ? (const float *)own : batch->limit;
}

// Loads two points as seen from p0.
SDV_INLINE void sdv_load_two(const int *points, const float *work, sdv_four p0, sdv_four *p)
{
    p[0] = sdv_minus(sdv_load(work + 4 * (size_t)points[0]), p0);
    p[1] = sdv_minus(sdv_load(work + 4 * (size_t)points[1]), p0);
}

// Makes a limit row: a point and two tangents.
SDV_INLINE void sdv_limit_row_sums(const float *weights, const int *points, int width,
                                   const sdv_ring_weights *ring, const float *work, sdv_four *p,
                                   sdv_four *t0, sdv_four *t1)
{
    const float *w = weights, *w0 = w + width, *w1 = w0 + width;
    const sdv_four p0 = sdv_load(work + 4 * (size_t)points[0]);
    sdv_four sums[3] = { sdv_all(0), sdv_all(0), sdv_all(0) };
    if (ring) {
        sdv_four d[9];
        sdv_load_two(points + 1, work, p0, d + 1);
        sdv_load_two(points + 3, work, p0, d + 3);
        sdv_load_two(points + 5, work, p0, d + 5);
        if (width == 9) sdv_load_two(points + 7, work, p0, d + 7);
        sdv_limit_ring(ring, width == 7, d, sums);
    }
    for (int k = 1; k < width && !ring; k++) {
        sdv_four d = sdv_minus(sdv_load(work + 4 * (size_t)points[k]), p0);
        sums[0] = sdv_plus(sums[0], sdv_times(sdv_all(w[k]), d));
        sums[1] = sdv_plus(sums[1], sdv_times(sdv_all(w0[k]), d));
        sums[2] = sdv_plus(sums[2], sdv_times(sdv_all(w1[k]), d));
    }
    *p = sdv_plus(p0, sums[0]);
    *t0 = sums[1];
    *t1 = sums[2];
}

// Makes rows first to end - 1 of a batch of limit rows: points and, if wanted, tangents.
SDV_INLINE void sdv_limit_rows_of(const sdv_batch *batch, int first, int end, int width,
                                  int regular, const float *work, const sdv_window *out)
{
    const int own = regular ? 0 : batch->shape.own, stride = 1 + width + own;
    const float *weights = batch->limit;
    const int *row = batch->items + (size_t)stride * (size_t)first;
    sdv_ring_weights ring;
    if (regular) ring = sdv_ring_of(weights, width == 7);
    if (out->tangents) out->tangents->work = work;
    sdv_four p, t0, t1;
    for (int i = first; i < end; i++, row += stride) {
        if (own) weights = sdv_limit_weights_of(batch, row);
        sdv_limit_row_sums(weights, row + 1, width, regular ? &ring : NULL, work, &p, &t0, &t1);
        sdv_put_limit(out, row[0], sdv_plus(out->origin, p), t0, t1, row[1]);
    }
}

// Makes rows first to end - 1 of a batch of limit rows. Regular ones have loops of their own.
static void sdv_make_limit_rows(const sdv_batch *batch, int first, int end, const float *work,
                                const sdv_window *out)
{
    int width = 1 + batch->shape.count[0], regular = batch->shape.regular;
    if (regular && width == 9) sdv_limit_rows_of(batch, first, end, 9, 1, work, out);
    else if (regular) sdv_limit_rows_of(batch, first, end, 7, 1, work, out);
    else sdv_limit_rows_of(batch, first, end, width, 0, work, out);
}

// Returns the first row of a batch that belongs to this face of its block or to a later one.
static int sdv_first_row(const sdv_batch *batch, int face)
{
    int low = 0, high = batch->rows;
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (batch->faces[middle] < face) low = middle + 1;
        else high = middle;
    }
    return low;
}

// Makes the rows that belong to cage faces face to end - 1.
static void sdv_make_batches(const sdv_batches *batches, const float *work, int face, int end,
                             const sdv_window *out)
{
    for (int b = face / SDV_BLOCK_FACES; b < batches->blocks && b * SDV_BLOCK_FACES < end; b++) {
        int before = face - b * SDV_BLOCK_FACES, behind = end - b * SDV_BLOCK_FACES;
        for (int i = batches->starts[b]; i < batches->starts[b + 1]; i++) {
            const sdv_batch *batch = &batches->items[i];
            int first = before > 0 ? sdv_first_row(batch, before) : 0;
            int last = behind < SDV_BLOCK_FACES ? sdv_first_row(batch, behind) : batch->rows;
            if (batch->limit) sdv_make_limit_rows(batch, first, last, work, out);
            else sdv_make_rows(batch, first, last, work, out);
        }
    }
}

// Inside a grid all is regular and smooth: its points are made without rows, region by region.
//
//     . o---o---o  top      A region has the points of some cells (o) and, unless the grid begins
//       |   |   |           there, a row and a column of points before them (.). It makes the next
//     . o---o---o  bottom   level's points on the cells, but not on the last row and column of o,
//     . .   .   .           where other regions begin. Points are seen from a corner of the grid,
//      left   right         the origin, so that sums lose nothing by where the mesh stands.
enum { SDV_REGION = 16 };               // cells along a side

typedef struct sdv_cells {              // the cells between such rows and columns of points
    int left, right, bottom, top;
} sdv_cells;

typedef struct sdv_region {               // the points of some cells, with the points before them
    sdv_cells cells;
    int       row, column, width;       // of the first point, and points in a row
    sdv_four *points;
} sdv_region;

typedef struct sdv_region_out {         // where the points go that a region makes
    const sdv_window *out;
    int      first, columns, triangle;  // see sdv_inside_point
    sdv_four origin;                    // of the region or, when its points are written, of these
} sdv_region_out;

typedef struct sdv_grid_step {          // the masks of a step inside grids
    sdv_mask vertex, edge;              // of what is regular and smooth
    float    face;                      // the weight of a face point
    int      loop;
} sdv_grid_step;

static sdv_grid_step sdv_regular_masks(const sdv_rules *rules)
{
    const sdv_fading smooth = { SDV_SMOOTH, SDV_SMOOTH, 0 };
    sdv_grid_step step;
    step.loop = rules->loop;
    step.vertex = sdv_vertex_mask(rules, smooth, rules->loop ? 6 : 4);
    step.edge = sdv_edge_mask(rules, 0, 0, 2, 0);
    step.face = (float)sdv_face_weight(4);
    return step;
}

static const sdv_four *sdv_region_at(const sdv_region *region, int row, int column)
{
    return region->points + (row - region->row) * region->width + (column - region->column);
}

// Loads points first to last of a side, less origin. from, to: the corners at its ends.
static void sdv_load_side(const sdv_grid *grid, int side, int from, int to, int first, int last,
                          const float *work, sdv_four origin, sdv_four *p)
{
    int n = grid->columns, t = first ? first : 1, step = 4 * grid->side[side].step;
    const float *point = work + 4 * (ptrdiff_t)sdv_side_index(grid, side, t);
    if (first == 0) *p++ = sdv_minus(sdv_load(work + 4 * (size_t)grid->corner[from]), origin);
    for (; t <= last && t < n; t++, point += step) *p++ = sdv_minus(sdv_load(point), origin);
    if (last == n) *p = sdv_minus(sdv_load(work + 4 * (size_t)grid->corner[to]), origin);
}

// Writes count points from index on, as far as the window has them.
static void sdv_put_points(const sdv_window *out, int index, int count, const sdv_four *p)
{
    int i = index - out->first, skip = i < 0 ? -i : 0;
    size_t stride = out->stride;
    if (count > out->count - i) count = out->count - i;
    if (skip >= count) return;
    float *to = out->values + (ptrdiff_t)stride * (i + skip);
    for (int k = skip; k < count; k++, to += stride) sdv_store_some(to, p[k], out->lanes);
}

// Writes count points from index on as they are made. Direct: to the window, four lanes each, where
// the next point overwrites the fourth. Else: to some room, and to the window when all are made.
typedef struct sdv_points_run {
    const sdv_window *out;
    int       index, count;
    int       direct;
    float    *to;                       // where the next point goes
    size_t    step;                     // floats from point to point there
    sdv_four *room;
} sdv_points_run;

SDV_INLINE sdv_points_run sdv_begin_run(const sdv_window *out, int index, int count, sdv_four *room)
{
    sdv_points_run run = { out, index, count, 0, (float *)(void *)room, 4, room };
    run.direct = !out->clip && (out->lanes == 4 || (out->lanes == 3 && out->stride == 3));
    if (!run.direct) return run;
    run.to = out->values + out->stride * (size_t)index;
    run.step = out->stride;
    return run;
}

SDV_INLINE sdv_points_run sdv_begin_row(const sdv_region_out *to, int row, int column, int count,
                                        sdv_four *room)
{
    int index = sdv_inside_point(to->first, to->columns, to->triangle, row, column);
    return sdv_begin_run(to->out, index, count, room);
}

SDV_INLINE void sdv_put_next(sdv_points_run *run, sdv_four p)
{
    sdv_store(run->to, p);
    run->to += run->step;
}

SDV_INLINE void sdv_put_last(sdv_points_run *run, sdv_four p)
{
    if (run->direct && run->step == 3) sdv_store_three(run->to, p);
    else sdv_store(run->to, p);
    if (!run->direct) sdv_put_points(run->out, run->index, run->count, run->room);
}

// Rows a, b and c of points in a region, and the face points f and g between them. Row b becomes a
// row of vertex points and edge points. Between b and c comes one of edge points and face points:
//
//     c   v---e---v           e = self (v + v) + face (f + f)
//         e   g   e
//     b   v---e---v           v = self v + edge (sum of v around) + face (sum of f around)
//         e   f   e
//     a   v---e---v
typedef struct sdv_lines {
    const sdv_four *a, *b, *c, *f, *g;  // of the first column; f, g: of quads
    sdv_four origin, self, beside, corner, edge, across;        // weights: see sdv_begin_lines
} sdv_lines;

static sdv_lines sdv_begin_lines(const sdv_grid_step *step, sdv_four origin)
{
    sdv_lines q;
    q.a = q.b = q.c = q.f = q.g = NULL;
    q.origin = origin;
    q.self = sdv_all((float)step->vertex.self);
    q.beside = sdv_all((float)step->vertex.edge);
    q.corner = sdv_all((float)step->vertex.face);
    q.edge = sdv_all((float)step->edge.self);
    q.across = sdv_all((float)step->edge.face);
    return q;
}

SDV_INLINE void sdv_face_points(const sdv_four *a, const sdv_four *b, int cells, float weight,
                                sdv_four *f)
{
    sdv_four w = sdv_all(weight), left = sdv_plus(a[0], b[0]);
    for (int c = 0; c < cells; c++) {
        sdv_four right = sdv_plus(a[c + 1], b[c + 1]);
        f[c] = sdv_times(w, sdv_plus(left, right));
        left = right;
    }
}

// Makes the row on b for cells k to end - 1. At cell 0 there is no vertex point: it is on a side.
SDV_INLINE void sdv_vertex_points(const sdv_lines *q, int k, int end, sdv_points_run *run)
{
    const sdv_four *a = q->a, *b = q->b, *c = q->c, *f = q->f, *g = q->g;
    sdv_four fours = k ? sdv_plus(f[k - 1], g[k - 1]) : sdv_all(0);
    for (int first = k == 0; ; k++, first = 0) {
        sdv_four next = sdv_plus(f[k], g[k]);
        sdv_four e = sdv_plus(sdv_times(q->edge, sdv_plus(b[k], b[k + 1])),
                              sdv_times(q->across, next));
        if (!first) {
            sdv_four around = sdv_plus(sdv_plus(b[k - 1], b[k + 1]), sdv_plus(a[k], c[k]));
            sdv_four v = sdv_plus(sdv_times(q->self, b[k]), sdv_times(q->beside, around));
            v = sdv_plus(v, sdv_times(q->corner, sdv_plus(fours, next)));
            sdv_put_next(run, sdv_plus(q->origin, v));
        }
        e = sdv_plus(q->origin, e);
        if (k + 1 == end) {
            sdv_put_last(run, e);
            return;
        }
        sdv_put_next(run, e);
        fours = next;
    }
}

// Makes the row between b and c for cells k to end - 1.
SDV_INLINE void sdv_edge_points(const sdv_lines *q, int k, int end, sdv_points_run *run)
{
    const sdv_four *b = q->b, *c = q->c, *g = q->g;
    for (;; k++) {
        if (k > 0) {
            sdv_four e = sdv_plus(sdv_times(q->edge, sdv_plus(b[k], c[k])),
                                  sdv_times(q->across, sdv_plus(g[k - 1], g[k])));
            sdv_put_next(run, sdv_plus(q->origin, e));
        }
        sdv_four face = sdv_plus(q->origin, g[k]);
        if (k + 1 == end) {
            sdv_put_last(run, face);
            return;
        }
        sdv_put_next(run, face);
    }
}

// Makes an edge point inside a triangle. On row b there are vertex points and edge points, between
// b and the row above, c, the edge points of the two other directions:
//
//     c   v---e---v
//          \  |\  |          e = self (v + v) + face (the two v opposite)
//           e e e e
//            \|  \|          v = self v + edge (sum of the six v around)
//     b   v---e---v
SDV_INLINE sdv_four sdv_triangle_edge(const sdv_lines *q, sdv_four p0, sdv_four p1,
                                      sdv_four beside0, sdv_four beside1)
{
    sdv_four e = sdv_plus(sdv_times(q->edge, sdv_plus(p0, p1)),
                          sdv_times(q->across, sdv_plus(beside0, beside1)));
    return sdv_plus(q->origin, e);
}

// Makes the row on b for cells k to end - 1.
SDV_INLINE void sdv_triangle_vertices(const sdv_lines *q, int k, int end, sdv_points_run *run)
{
    const sdv_four *a = q->a, *b = q->b, *c = q->c;
    for (;; k++) {
        if (k > 0) {
            sdv_four around = sdv_plus(sdv_plus(b[k - 1], b[k + 1]), sdv_plus(c[k - 1], c[k]));
            around = sdv_plus(around, sdv_plus(a[k], a[k + 1]));
            sdv_four v = sdv_plus(sdv_times(q->self, b[k]), sdv_times(q->beside, around));
            sdv_put_next(run, sdv_plus(q->origin, v));
        }
        sdv_four e = sdv_triangle_edge(q, b[k], b[k + 1], a[k + 1], c[k]);
        if (k + 1 == end) {
            sdv_put_last(run, e);
            return;
        }
        sdv_put_next(run, e);
    }
}

// Makes the row between b and c. whole: up to the long side, whose own edge point is not made here.
SDV_INLINE void sdv_triangle_edges(const sdv_lines *q, int k, int end, int whole,
                                   sdv_points_run *run)
{
    const sdv_four *b = q->b, *c = q->c;
    for (;; k++) {
        if (k > 0) {
            sdv_four e = sdv_triangle_edge(q, b[k], c[k], b[k + 1], c[k - 1]);
            if (whole && k + 1 == end) {
                sdv_put_last(run, e);
                return;
            }
            sdv_put_next(run, e);
        }
        sdv_four e = sdv_triangle_edge(q, b[k + 1], c[k], b[k], c[k + 1]);
        if (k + 1 == end) {
            sdv_put_last(run, e);
            return;
        }
        sdv_put_next(run, e);
    }
}

// Makes the next level's points on the cells of a region of a grid of n segments a side.
// loop is a constant in calls.
SDV_INLINE void sdv_refine_cells_of(const sdv_region *region, int n, int loop,
                                const sdv_grid_step *step, const sdv_region_out *to)
{
    sdv_four faces[2][SDV_REGION + 1], made[2 * SDV_REGION];
    sdv_lines q = sdv_begin_lines(step, to->origin);
    const sdv_cells *cells = &region->cells;
    int skip = cells->left > 0, low = cells->left - skip;
    int column = skip ? 2 * cells->left : 1;
    for (int r = cells->bottom; r < cells->top && (!loop || r < n - cells->left); r++) {
        int end = loop && n - r < cells->right ? n - r : cells->right, whole = loop && end == n - r;
        int count = 2 * end - column;
        q.a = r > 0 ? sdv_region_at(region, r - 1, low) : NULL;
        q.b = sdv_region_at(region, r, low);
        q.c = sdv_region_at(region, r + 1, low);
        q.f = faces[(r + 1) % 2];
        q.g = faces[r % 2];
        end -= low;
        if (!loop && r == cells->bottom && r > 0)
            sdv_face_points(q.a, q.b, end, step->face, faces[(r + 1) % 2]);
        if (!loop) sdv_face_points(q.b, q.c, end, step->face, faces[r % 2]);
        if (r > 0) {
            sdv_points_run run = sdv_begin_row(to, 2 * r, column, count, made);
            if (loop) sdv_triangle_vertices(&q, skip, end, &run);
            else sdv_vertex_points(&q, skip, end, &run);
        }
        if (count == whole) continue;
        sdv_points_run run = sdv_begin_row(to, 2 * r + 1, column, count - whole, made);
        if (loop) sdv_triangle_edges(&q, skip, end, whole, &run);
        else sdv_edge_points(&q, skip, end, &run);
    }
}

static void sdv_refine_cells(const sdv_region *region, int n, const sdv_grid_step *step,
                             const sdv_region_out *to)
{
    if (step->loop) sdv_refine_cells_of(region, n, 1, step, to);
    else sdv_refine_cells_of(region, n, 0, step, to);
}

// Makes the 9 points of level 2 inside a quad from its points on level 1, p, e and F; inside any
// other polygon, those that are not on its spokes: the face points. quad is a constant.
//
//     p3---e2---p2      face points f, an edge point on each line from F to an e, and the vertex
//     |  f3| f2 |       point of F
//     e3---F---e1
//     |  f0| f1 |
//     p0---e0---p1
SDV_INLINE void sdv_refine_four(const sdv_order *order, int f, int quad, const sdv_grid_step *step,
                                int target, const float *work, const sdv_window *out)
{
    const int start = sdv_face_start(&order->cage, f);
    const int sides = quad ? 4 : sdv_face_end(&order->cage, f) - start;
    const int *v = order->cage.face_vertices + start, *edges = order->cage.face_edges + start;
    const float *on_edges = work + 4 * (size_t)order->first_edge_point;
    const sdv_four origin = sdv_load(work + 4 * (size_t)sdv_first_inside(order, f));
    const sdv_four half = sdv_all((float)step->edge.self), across = sdv_all((float)step->edge.face);
    sdv_four e[4], face[4], edge[4], made[9], room[9], sum = sdv_all(0), fours = sum;
    sdv_four before = sdv_minus(sdv_load(on_edges + 4 * (size_t)edges[sides - 1]), origin);
    for (int i = 0; i < sides; i++) {   // F is the origin: it adds 0
        sdv_four p = sdv_minus(sdv_load(work + 4 * (size_t)v[i]), origin);
        sdv_four next = sdv_minus(sdv_load(on_edges + 4 * (size_t)edges[i]), origin);
        p = sdv_times(sdv_all(step->face), sdv_plus(p, sdv_plus(next, before)));
        before = next;
        if (quad) e[i] = next, face[i] = p;
        else sdv_put_point(out, target + i, sdv_plus(origin, p));
    }
    if (!quad) return;
    for (int i = 0; i < 4; i++) {
        edge[i] = sdv_plus(sdv_times(half, e[i]),
                           sdv_times(across, sdv_plus(face[i], face[(i + 1) & 3])));
        sum = sdv_plus(sum, e[i]);
        fours = sdv_plus(fours, face[i]);
    }
    made[0] = face[0];
    made[1] = edge[0];
    made[2] = face[1];
    made[3] = edge[3];
    made[4] = sdv_plus(sdv_times(sdv_all((float)step->vertex.edge), sum),
                       sdv_times(sdv_all((float)step->vertex.face), fours));
    made[5] = edge[1];
    made[6] = face[3];
    made[7] = edge[2];
    made[8] = face[2];
    sdv_points_run run = sdv_begin_run(out, target, 9, room);
    for (int i = 0; i < 9; i++) made[i] = sdv_plus(out->origin, sdv_plus(origin, made[i]));
    for (int i = 0; i < 8; i++) sdv_put_next(&run, made[i]);
    sdv_put_last(&run, made[8]);
}

// Makes the 3 points of level 2 inside a triangle: the edge points of e0 e1 e2, its middle triangle
// on level 1, whose edges lie across from the face's vertices.
SDV_INLINE void sdv_refine_three(const sdv_order *order, int f, const sdv_grid_step *step,
                                 int target, const float *work, const sdv_window *out)
{
    const int *v = order->cage.face_vertices + 3 * (size_t)f;
    const int *edges = order->cage.face_edges + 3 * (size_t)f;
    const float *on_edges = work + 4 * (size_t)order->first_edge_point;
    sdv_four e[3], d[3], room[3];
    sdv_lines q = sdv_begin_lines(step, sdv_load(on_edges + 4 * (size_t)edges[0]));
    e[0] = sdv_all(0);
    for (int i = 0; i < 3; i++) {
        d[i] = sdv_minus(sdv_load(work + 4 * (size_t)v[i]), q.origin);
        if (i > 0) e[i] = sdv_minus(sdv_load(on_edges + 4 * (size_t)edges[i]), q.origin);
    }
    sdv_points_run run = sdv_begin_run(out, target, 3, room);
    const sdv_four all = out->origin;
    sdv_put_next(&run, sdv_plus(all, sdv_triangle_edge(&q, e[0], e[2], d[0], e[1])));
    sdv_put_next(&run, sdv_plus(all, sdv_triangle_edge(&q, e[0], e[1], d[1], e[2])));
    sdv_put_last(&run, sdv_plus(all, sdv_triangle_edge(&q, e[2], e[1], d[2], e[0])));
}

typedef struct sdv_grid_limit {         // the limit of what is regular and smooth
    float w[3 * 9];                     // see sdv_ring_of
    int   linear;                       // tangents are the edges to points 1 and 2
} sdv_grid_limit;

static sdv_grid_limit sdv_regular_limit(const sdv_rules *rules)
{
    sdv_grid_limit limit;
    sdv_ray rays[6];
    sdv_sector s = { 0, 0, 0, rays, 0, NULL };
    double rows[3 * 9], room[9];
    sdv_settle(&s, SDV_SMOOTH, rules->loop ? 6 : 4, 0);
    sdv_settled_rows(rules, &s, rows, room);
    limit.linear = rules->linear;
    for (int i = 0, n = sdv_sector_points(rules, &s); i < 3 * n; i++)
        limit.w[i] = (float)(rules->linear ? i == 0 || i == n + 1 || i == 2 * n + 2 : rows[i]);
    return limit;
}

// Makes the limit point of b[0], a point of row b between rows a and c, and two tangents.
SDV_INLINE void sdv_limit_point(const sdv_ring_weights *w, int loop, int linear, const sdv_four *a,
                                const sdv_four *b, const sdv_four *c, sdv_four *sums)
{
    const sdv_four of_quads[9] = { b[0], b[1], c[0], b[-1], a[0], c[1], c[-1], a[-1], a[1] };
    const sdv_four of_triangles[7] = { b[0], b[1], c[0], c[-1], b[-1], a[0], a[1] };
    if (loop) sdv_limit_ring(w, 1, of_triangles, sums);
    else sdv_limit_ring(w, 0, of_quads, sums);
    sums[0] = sdv_plus(sdv_times(w->self, b[0]), sums[0]);
    if (!linear) return;
    sums[0] = b[0];
    sums[1] = sdv_minus(b[1], b[0]);
    sums[2] = sdv_minus(c[0], b[0]);
}

// Makes the limit of count points of row b, which stand from index on: four at a time if all are
// wanted.
SDV_INLINE void sdv_limit_row_points(const sdv_grid_limit *limit, int loop, const sdv_four *a,
                                     const sdv_four *b, const sdv_four *c, int count, int index,
                                     sdv_four origin, const sdv_window *out)
{
    const sdv_ring_weights w = sdv_ring_of(limit->w, loop);
    sdv_four sums[3], along[4], across[4];
    for (; out->all && count >= 4; count -= 4, index += 4) {
        float *to = out->values + out->stride * (size_t)index;
        for (int i = 0; i < 4; i++, a++, b++, c++, to += out->stride) {
            sdv_limit_point(&w, loop, limit->linear, a, b, c, sums);
            sdv_store_three(to, sdv_plus(origin, sums[0]));
            along[i] = sums[1];
            across[i] = sums[2];
        }
        const int at[4] = { index, index + 1, index + 2, index + 3 };
        sdv_put_normals(out->tangents, at, along, across, NULL);
    }
    for (; count > 0; count--, index++, a++, b++, c++) {
        sdv_limit_point(&w, loop, limit->linear, a, b, c, sums);
        sdv_put_limit(out, index, sdv_plus(origin, sums[0]), sums[1], sums[2], -1);
    }
}

// Makes the limit points of a region of a grid of n segments a side, and their tangents.
static void sdv_limit_region(const sdv_region *region, int n, const sdv_grid_limit *limit,
                             const sdv_region_out *to)
{
    const sdv_cells *cells = &region->cells;
    int first = cells->left ? cells->left : 1, row = cells->bottom ? cells->bottom : 1;
    const sdv_four *b = sdv_region_at(region, row, first);
    for (; row < cells->top; row++, b += region->width) {
        const sdv_four *a = b - region->width, *c = b + region->width;
        int end = to->triangle && n - row < cells->right ? n - row : cells->right;
        if (end <= first) return;
        int index = sdv_inside_point(to->first, to->columns, to->triangle, row, first);
        if (to->triangle)
            sdv_limit_row_points(limit, 1, a, b, c, end - first, index, to->origin, to->out);
        else sdv_limit_row_points(limit, 0, a, b, c, end - first, index, to->origin, to->out);
    }
}

// Makes the limit of the face points of quads on level 1, each in the middle of 2 x 2 cells.
static void sdv_limit_centres(const sdv_grid_limit *limit, const sdv_order *order,
                              const float *points, int face, int end, const sdv_window *out)
{
    const float *on_edges = points + 4 * (size_t)order->first_edge_point;
    const sdv_ring_weights w = sdv_ring_of(limit->w, 0);
    for (int f = face; f < end; f++) {
        if (sdv_is_ngon(order, f)) continue;
        const int *v = order->cage.face_vertices + sdv_face_start(&order->cage, f);
        const int *edges = order->cage.face_edges + sdv_face_start(&order->cage, f);
        int index = sdv_first_inside(order, f);
        const sdv_four p0 = sdv_load(points + 4 * (size_t)index);
        sdv_four p[9], sums[3];
        for (int i = 0; i < 4; i++) {           // counter-clockwise from edge 1, on the right
            p[1 + i] = sdv_minus(sdv_load(on_edges + 4 * (size_t)edges[(i + 1) & 3]), p0);
            p[5 + i] = sdv_minus(sdv_load(points + 4 * (size_t)v[(i + 2) & 3]), p0);
        }
        sdv_limit_ring(&w, 0, p, sums);
        if (limit->linear) {
            sums[0] = sdv_all(0);
            sums[1] = p[1];
            sums[2] = p[2];
        }
        sdv_put_limit(out, index, sdv_plus(out->origin, sdv_plus(p0, sums[0])), sums[1], sums[2],
                      -1);
    }
}

// Beyond SDV_FULL_LEVELS, grids have frames for work points. A region inside such a grid is made
// from the cells that it needs of the last whole level, level by level, in room that stays in the
// processor's nearest cache.
typedef struct sdv_interior {             // makes the points inside grids
    const subdiv_surface *surface;
    const float *work;
    int level, full;                    // made from this level; the last whole level up to it
    const sdv_grid_limit *limit;        // makes the limit of level; NULL: makes the next level
    sdv_grid_step step;
    sdv_grid grids[SDV_MOST_LEVELS - SDV_FULL_LEVELS];  // one face's, of levels full to level
} sdv_interior;

enum { SDV_LARGE_REGION = 21, SDV_SMALL_REGION = 13 };              // points along a side

// Returns the cells of a level of n segments from which cells of the next level are made.
static sdv_cells sdv_cells_before(sdv_cells next, int n)
{
    sdv_cells cells = { (next.left + 1) / 2 - 1, next.right / 2 + 1, (next.bottom + 1) / 2 - 1,
                        next.top / 2 + 1 };
    if (cells.left < 0) cells.left = 0;
    if (cells.bottom < 0) cells.bottom = 0;
    if (cells.right > n) cells.right = n;
    if (cells.top > n) cells.top = n;
    return cells;
}

// Loads the points of a region that are on the grid's sides, up to a last row and column.
static void sdv_load_sides(const sdv_grid *grid, const float *points, sdv_four origin,
                           const sdv_region *region, int last_row, int last_column)
{
    int n = grid->columns, first = region->column, r = region->row;
    sdv_four *p = region->points;
    if (r == 0) {
        sdv_load_side(grid, 0, 0, 1, first, last_column, points, origin, p);
        p += region->width;
        r = 1;
    }
    const float *left = points + 4 * (ptrdiff_t)sdv_side_index(grid, 3, r);
    const float *right = points + 4 * (ptrdiff_t)sdv_side_index(grid, 1, r);
    for (; r <= last_row && r < n; r++, p += region->width) {
        int column = grid->triangle ? n - r : n;
        if (first == 0) *p = sdv_minus(sdv_load(left), origin);
        if (first <= column && column <= last_column)
            p[column - first] = sdv_minus(sdv_load(right), origin);
        left += 4 * grid->side[3].step;
        right += 4 * grid->side[1].step;
    }
    if (last_row < n) return;
    if (!grid->triangle) sdv_load_side(grid, 2, 3, 2, first, last_column, points, origin, p);
    else if (first == 0) *p = sdv_minus(sdv_load(points + 4 * (size_t)grid->corner[2]), origin);
}

// Loads all points of a whole grid as a region, which may have more of them than its cells need.
static void sdv_load_grid(const sdv_grid *grid, const float *points, sdv_four origin,
                          sdv_region *region)
{
    int n = grid->columns;
    const float *from = points + 4 * (size_t)grid->inside;
    sdv_four *p = region->points + n + 2;
    region->row = region->column = 0;
    region->width = n + 1;
    sdv_load_sides(grid, points, origin, region, n, n);
    for (int r = 1; r < n; r++, p += n + 1)
        for (int c = 1; c < (grid->triangle ? n - r : n); c++, from += 4)
            p[c - 1] = sdv_minus(sdv_load(from), origin);
}

// Makes the points of a region inside a grid from a region of the level before, of n segments.
static void sdv_refine_region(const sdv_region *from, int n, const sdv_grid_step *step,
                              sdv_region *region)
{
    const sdv_cells *cells = &from->cells;
    sdv_window out = sdv_window_of((float *)(void *)region->points, 4, 4, 0, INT_MAX, 0);
    region->row = 2 * cells->bottom;
    region->column = 2 * cells->left;
    region->width = 2 * (cells->right - cells->left) + 1;
    int first = (1 - region->row) * region->width + 1 - region->column;
    sdv_region_out to = { &out, first, region->width + 1, 0, sdv_all(0) };
    sdv_refine_cells(from, n, step, &to);
}

// Makes the points on cells of level in->level. Regions of earlier levels take turns in two rooms.
static void sdv_make_region(const sdv_interior *in, sdv_cells cells, sdv_region_out *to)
{
    sdv_four room[SDV_LARGE_REGION * SDV_LARGE_REGION], other[SDV_SMALL_REGION * SDV_SMALL_REGION];
    sdv_cells needed[SDV_MOST_LEVELS - SDV_FULL_LEVELS];
    sdv_region region, before;
    int last = in->level - in->full;
    needed[last] = cells;
    for (int i = last; i > 0; i--)
        needed[i - 1] = sdv_cells_before(needed[i], in->grids[i - 1].columns);
    const float *points = in->work + 4 * (size_t)in->surface->bases[in->full];
    to->origin = sdv_times(to->out->unmoved, sdv_load(points + 4 * (size_t)in->grids[0].corner[0]));
    region.cells = needed[0];
    region.points = last % 2 ? other : room;
    sdv_load_grid(&in->grids[0], points, to->origin, &region);
    for (int i = 1; i <= last; i++) {
        const sdv_grid *grid = &in->grids[i];
        before = region;
        region.cells = needed[i];
        region.points = (last - i) % 2 ? other : room;
        sdv_refine_region(&before, grid->columns / 2, &in->step, &region);
        sdv_load_sides(grid, in->work + 4 * (size_t)in->surface->bases[in->full + i], to->origin,
                       &region, 2 * before.cells.top, 2 * before.cells.right);
    }
    to->origin = sdv_plus(to->origin, to->out->origin);
    if (in->limit) sdv_limit_region(&region, in->grids[last].columns, in->limit, to);
    else sdv_refine_cells(&region, in->grids[last].columns, &in->step, to);
}

// Makes the points inside grid i of face f.
static void sdv_make_grid(sdv_interior *in, const sdv_order *order, int target, int f, int i,
                          const sdv_window *out)
{
    int first = target + sdv_inside_grid(order, f, i);
    sdv_region_out to = { out, first, 0, in->step.loop, sdv_all(0) };
    int h = sdv_face_start(&order->cage, f) + i, n = 0;
    for (int level = in->full; level <= in->level; level++) {
        sdv_grid_at(&in->surface->orders[level], h, &in->grids[level - in->full]);
        n = in->grids[level - in->full].columns;
    }
    to.columns = in->limit ? n : 2 * n;
    for (int bottom = 0; bottom < n; bottom += SDV_REGION)
        for (int left = 0; left < (to.triangle ? n - bottom : n); left += SDV_REGION) {
            sdv_cells cells = { left, left + SDV_REGION, bottom, bottom + SDV_REGION };
            if (cells.right > n) cells.right = n;
            if (cells.top > n) cells.top = n;
            sdv_make_region(in, cells, &to);
        }
}

// Makes the points inside the grids of cage faces face to end - 1: of the level after the one given
// or, if limit is not NULL, of its limit. They go where the order says, from target on.
static void sdv_make_grids(const subdiv_surface *surface, int level, const sdv_grid_limit *limit,
                           const float *work, int face, int end, const sdv_order *order,
                           int target, const sdv_window *out)
{
    sdv_interior in;
    const sdv_order *from = &surface->orders[level];
    const float *points = work + 4 * (size_t)surface->bases[level];
    in.surface = surface;
    in.work = work;
    in.level = level;
    in.full = level < SDV_FULL_LEVELS ? level : SDV_FULL_LEVELS;
    in.limit = limit;
    in.step = sdv_regular_masks(&surface->rules);
    if (end > surface->cage_face_count) end = surface->cage_face_count;
    if (level == 1 && limit) {              // triangles have no points inside
        if (!from->loop) sdv_limit_centres(limit, from, points, face, end, out);
        return;
    }
    for (int f = face; f < end; f++) {
        int at = target + sdv_inside_grid(order, f, 0), grids = sdv_grids_of(order, f);
        if (level == 1 && from->loop) sdv_refine_three(from, f, &in.step, at, points, out);
        else if (level == 1 && grids > 1)
            sdv_refine_four(from, f, 0, &in.step, at, points, out);
        else if (level == 1) sdv_refine_four(from, f, 1, &in.step, at, points, out);
        else for (int i = 0; i < grids; i++) sdv_make_grid(&in, order, target, f, i, out);
    }
}

// Makes the face points of cage faces face to end - 1, which are work points. A result of 1 level
// has no other points inside faces: sdv_copy_face_points copies them.
static void sdv_make_face_points(const subdiv_surface *surface, float *work, int face, int end)
{
    const sdv_level *cage = &surface->order.cage;
    int point = sdv_first_face_point(surface);
    if (end > cage->face_count) end = cage->face_count;
    for (int f = face; f < end; f++) {
        int start = sdv_face_start(cage, f), size = sdv_face_end(cage, f) - start;
        const int *v = cage->face_vertices + start;
        const float w = (float)sdv_face_weight(size);
        sdv_store(work + 4 * ((size_t)point + (size_t)f),
                  size == 4 ? sdv_batch_sum(v, 3, 0, 0, &w, work)
                            : sdv_batch_sum(v, size - 1, 0, 0, &w, work));
    }
}

// Copies the face points of cage faces face to end - 1 to a result of 1 level.
static void sdv_copy_face_points(const subdiv_surface *surface, const float *work, int face,
                                 int end, const sdv_window *out)
{
    const float *from = work + 4 * (size_t)sdv_first_face_point(surface);
    int first = surface->order.first_inside_point;
    if (end > surface->cage_face_count) end = surface->cage_face_count;
    for (int f = face; f < end; f++) sdv_put_point(out, first + f, sdv_load(from + 4 * (size_t)f));
}

// Makes the points of level + 1 that belong to cage faces face to end - 1.
static void sdv_refine_faces(const subdiv_surface *surface, int level, const float *work, int face,
                             int end, int target, const sdv_window *out)
{
    sdv_make_batches(&surface->refine[level], work, face, end, out);
    if (level == 0 && surface->levels == 1 && !surface->rules.limit && !surface->rules.loop)
        sdv_copy_face_points(surface, work, face, end, out);
    if (level == 0) return;
    int last = level + 1 == surface->levels && !surface->rules.limit;
    const sdv_order *to = last ? &surface->order : &surface->orders[level + 1];
    if (!to->frame) sdv_make_grids(surface, level, NULL, work, face, end, to, target, out);
}

// Makes the points of the result that belong to cage faces face to end - 1.
static void sdv_make_faces(const subdiv_surface *surface, const float *work, int face, int end,
                           const sdv_window *out)
{
    sdv_make_batches(&surface->limit_rows, work, face, end, out);
    if (SDV_IS_PLAIN) return;
    if (surface->rules.limit) {
        sdv_grid_limit limit = sdv_regular_limit(&surface->rules);
        sdv_make_grids(surface, surface->levels, &limit, work, face, end, &surface->order, 0, out);
        return;
    }
    sdv_refine_faces(surface, surface->levels - 1, work, face, end, 0, out);
}

// -------------------------------------------------------------------------------- >>evaluate
// Takes values through a surface. Batches and grids make the work points, level by level. The last
// step makes the points of the result, cage face by cage face and in any order, since each point is
// made once and from work points alone.

typedef struct sdv_evaluation {         // what the jobs of an evaluation share
    const subdiv_surface *surface;
    const subdiv_limit *limit;          // or NULL: then the values go to out
    int          channels;
    const float *in;                    // channels a vertex
    size_t       in_stride;
    float       *work;                  // [4 * work_count + 4] for every four channels: their work
    float       *out;                   // points, seen from the point behind all these
    size_t       out_stride;
    int          first_point, end_point;        // of the result: those that are written
    int          first_face, end_face;          // of the cage: those whose points are made
    int          sides;                 // normals of the other sides of creases
    int          step;                  // makes level step + 1; -1: the cage's face points
    int          jobs;
} sdv_evaluation;

// Runs jobs on the user's threads, or one after the other here.
static void sdv_run(const subdiv_options *opt, void (*job)(void *, int), void *context, int jobs)
{
    if (opt && opt->run && jobs > 1) opt->run(opt->user, job, context, jobs);
    else for (int i = 0; i < jobs; i++) job(context, i);
}

// Returns where job i's share of count things starts.
static int sdv_share(int count, int i, int jobs)
{
    return (int)((int64_t)count * i / jobs);
}

enum { SDV_MOST_JOBS = 256 };
// A job has at least so many points or faces: to wake a thread takes as long as thousands of them.
// (Tests ask for smaller jobs.)
#ifndef SDV_JOB_POINTS
#define SDV_JOB_POINTS 8192
#endif

// Returns how many jobs to cut work into, each with at least so much; 1 if no threads are lent.
static int sdv_jobs(const subdiv_options *opt, int64_t work, int64_t least)
{
    int64_t jobs = opt && opt->run ? work / least : 1;
    return jobs > SDV_MOST_JOBS ? SDV_MOST_JOBS : jobs < 1 ? 1 : (int)jobs;
}

// Returns where job i's share of cage faces first to end - 1 starts, in whole blocks if possible.
static int sdv_share_faces(int first, int end, int i, int jobs)
{
    int block = first / SDV_BLOCK_FACES, blocks = (end - 1) / SDV_BLOCK_FACES + 1 - block;
    int face = (block + sdv_share(blocks, i, jobs)) * SDV_BLOCK_FACES;
    if (blocks < jobs) return first + sdv_share(end - first, i, jobs);
    return face < first ? first : face < end ? face : end;
}

// The work points of a channel and the three after it.
static float *sdv_work_of(const sdv_evaluation *e, int channel)
{
    return e->work + (size_t)channel * ((size_t)e->surface->work_count + 1);
}

// Loads four channels of vertex v from c on; left: how many there are.
SDV_INLINE sdv_four sdv_input(const sdv_evaluation *e, int v, int c, int left)
{
    int from = e->surface->source ? e->surface->source[v] : v;
    const float *in = e->in + e->in_stride * (size_t)from + c;
    return sdv_of(in[0], left > 1 ? in[1] : 0, left > 2 ? in[2] : 0, left > 3 ? in[3] : 0);
}

// Finds the point from which four channels are seen, so that sums lose nothing where a cage is
// small and far away: in channels where the vertices, a thousand of them, are much nearer to the
// first vertex than to 0, that vertex; else 0.
static void sdv_find_origin(const sdv_evaluation *e, int c)
{
    int count = e->surface->cage_vertex_count, step = count / 1024 + 1, seen = 0;
    float first[4], squares[4];
    sdv_four origin = sdv_input(e, 0, c, e->channels - c), sum = sdv_all(0);
    for (int v = 0; v < count; v += step, seen++) {
        sdv_four d = sdv_minus(sdv_input(e, v, c, e->channels - c), origin);
        sum = sdv_plus(sum, sdv_times(d, d));
    }
    sdv_store(first, origin);
    sdv_store(squares, sum);
    for (int k = 0; k < 4; k++)
        if (!(64 * (double)squares[k] < seen * (double)first[k] * (double)first[k])) first[k] = 0;
    memcpy(sdv_work_of(e, c) + 4 * (size_t)e->surface->work_count, first, sizeof first);
}

// Makes the work points of level 0: values of the cage's vertices, four channels each.
static void sdv_input_job(void *context, int job)
{
    const sdv_evaluation *e = (const sdv_evaluation *)context;
    int v = sdv_share(e->surface->cage_vertex_count, job, e->jobs);
    int end = sdv_share(e->surface->cage_vertex_count, job + 1, e->jobs);
    for (int c = 0; c < e->channels; c += 4) {
        int lanes = e->channels - c;
        float *work = sdv_work_of(e, c), *to = work + 4 * (size_t)v;
        const sdv_four origin = sdv_load(work + 4 * (size_t)e->surface->work_count);
        for (int i = v; i < end; i++, to += 4)
            sdv_store(to, sdv_minus(sdv_input(e, i, c, lanes), origin));
    }
}

// Makes a level from the one before or, at first, the cage's face points, for a share of its faces.
static void sdv_level_job(void *context, int job)
{
    const sdv_evaluation *e = (const sdv_evaluation *)context;
    const subdiv_surface *surface = e->surface;
    int faces = surface->cage_face_count ? surface->cage_face_count : 1;
    int face = sdv_share_faces(0, faces, job, e->jobs);
    int end = sdv_share_faces(0, faces, job + 1, e->jobs);
    for (int c = 0; c < e->channels; c += 4) {
        float *work = sdv_work_of(e, c);
        sdv_window out = sdv_window_of(work, 4, 4, 0, surface->work_count, 0);
        if (SDV_IS_PLAIN) sdv_make_batches(&surface->refine[e->step], work, face, end, &out);
        else if (e->step < 0) sdv_make_face_points(surface, work, face, end);
        else sdv_refine_faces(surface, e->step, work, face, end, surface->bases[e->step + 1], &out);
    }
}

// Makes all work points: those of level 0 from the input, the others level by level.
static void sdv_make_work(sdv_evaluation *e, const subdiv_options *opt)
{
    const subdiv_surface *surface = e->surface;
    int last = SDV_IS_PLAIN ? 2 * surface->levels : surface->levels - !surface->rules.limit;
    for (int c = 0; c < e->channels && surface->cage_vertex_count; c += 4) sdv_find_origin(e, c);
    e->jobs = sdv_jobs(opt, surface->cage_vertex_count, 4096);
    sdv_run(opt, sdv_input_job, e, e->jobs);
    for (e->step = SDV_IS_PLAIN || surface->rules.loop ? 0 : -1; e->step < last; e->step++) {
        int level = e->step < 0 ? 0 : e->step + 1;
        e->jobs = SDV_IS_PLAIN ? 1 : sdv_jobs(opt, surface->bases[level + 1] -
                                                   surface->bases[level], SDV_JOB_POINTS);
        sdv_run(opt, sdv_level_job, e, e->jobs);
    }
}

// Where four channels of the result go, from c on.
static sdv_window sdv_result_window(const sdv_evaluation *e, int c)
{
    int lanes = e->channels - c < 4 ? e->channels - c : 4, count = e->end_point - e->first_point;
    sdv_window out = sdv_window_of(e->out + c, e->out_stride, lanes, e->first_point, count,
                                   count < e->surface->fine.vertex_count);
    sdv_see_from(&out, sdv_work_of(e, c) + 4 * (size_t)e->surface->work_count);
    return out;
}

// Makes the limit points that belong to cage faces face to end - 1, with normals and tangents, and
// the normals of the other sides of creases there.
static void sdv_make_limit_faces(const sdv_evaluation *e, int face, int end)
{
    const subdiv_surface *surface = e->surface;
    const subdiv_limit *limit = e->limit;
    int points = surface->fine.vertex_count, count = e->end_point - e->first_point;
    size_t stride = limit->stride ? (size_t)limit->stride : 3;
    sdv_tangents tangents;
    sdv_window out = sdv_window_of(limit->positions, stride, 3, e->first_point, count,
                                   count < points);
    sdv_window sides = sdv_window_of(NULL, stride, 3, points, e->sides, 1);
    memset(&tangents, 0, sizeof tangents);
    tangents.normals = limit->normals;
    tangents.tangents = limit->tangents;
    tangents.stride = stride;
    tangents.tangent_stride = limit->stride ? stride : 6;
    tangents.left_handed = surface->rules.left_handed;
    sdv_see_from(&out, e->work + 4 * (size_t)surface->work_count);
    if (limit->normals || limit->tangents) out.tangents = &tangents;
    out.all = limit->positions && limit->normals && !limit->tangents && !out.clip;
    sdv_make_faces(surface, e->work, face, end, &out);
    sdv_flush_tangents(&tangents);
    if (!limit->sides || !e->sides) return;
    tangents.normals = limit->sides;
    tangents.tangents = NULL;
    sides.tangents = &tangents;
    sdv_make_batches(&surface->side_rows, e->work, face, end, &sides);
    sdv_flush_tangents(&tangents);
}

// Makes the points of the result that belong to a share of the cage's faces.
static void sdv_face_job(void *context, int job)
{
    const sdv_evaluation *e = (const sdv_evaluation *)context;
    int face = sdv_share_faces(e->first_face, e->end_face, job, e->jobs);
    int end = sdv_share_faces(e->first_face, e->end_face, job + 1, e->jobs);
    if (e->limit) sdv_make_limit_faces(e, face, end);
    for (int c = 0; c < (e->limit ? 0 : e->channels); c += 4) {
        sdv_window out = sdv_result_window(e, c);
        sdv_make_faces(e->surface, sdv_work_of(e, c), face, end, &out);
    }
}

// Copies the work points of level 0, which has no rows, to the result.
static void sdv_copy_work(const sdv_evaluation *e)
{
    for (int c = 0; c < e->channels; c += 4) {
        sdv_window out = sdv_result_window(e, c);
        for (int v = e->first_point; v < e->end_point; v++)
            sdv_put_point(&out, v, sdv_load(sdv_work_of(e, c) + 4 * (size_t)v));
    }
}

// Makes the points of the result from the work points.
static void sdv_make_points(sdv_evaluation *e, const subdiv_options *opt)
{
    const subdiv_surface *surface = e->surface;
    if (surface->levels == 0) {
        if (e->first_face == 0 && (e->end_face > 0 || surface->cage_face_count == 0))
            sdv_copy_work(e);
        return;
    }
    if (surface->cage_face_count == 0) e->end_face = 1;    // vertices without faces go with face 0
    if (e->end_face == e->first_face) return;
    e->jobs = sdv_jobs(opt, surface->fine.vertex_count, SDV_JOB_POINTS);
    sdv_run(opt, sdv_face_job, e, e->jobs);
}

// Returns the surface that makes the points: another one for a limit on level 0.
static const subdiv_surface *sdv_maker(const subdiv_surface *surface)
{
    return surface->at_level_1 ? surface->at_level_1 : surface;
}

// Whether so many bytes a channel are addressable, on a machine of 32 bits, too.
static int sdv_addressable(int channels, double bytes)
{
    return ((double)channels + 3) * bytes < (double)(SIZE_MAX / 2);
}

// Checks the channels and an array, and its stride. A stride of 0 becomes the number of channels.
// surface: or something else that must be there.
static void sdv_check_values(sdv_context *context, const void *surface, int channels,
                             const void *values, int *stride)
{
    if (!surface || !values) sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    else if (channels < 1) sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "channels is %d", channels);
    if (*stride == 0) *stride = channels;
    if (*stride < channels)
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "a stride of %d floats is less than %d channels",
                 *stride, channels);
}

// Fails for a surface of SUBDIV_EXACT, which has no points to make.
static void sdv_check_result(sdv_context *context, const subdiv_surface *surface)
{
    if (!context->result && surface->exact)
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT,
                 "the surface was prepared for SUBDIV_EXACT, not for levels from 0 up");
}

// Checks that a surface makes a mesh. others: the call's other arguments are there.
static void sdv_check_mesh_surface(sdv_context *context, const subdiv_surface *surface, int others)
{
    if (!others || !surface) sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    else if (surface->is_values)
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "the surface is one of face-varying values");
    else sdv_check_result(context, surface);
}

static void sdv_check_range(sdv_context *context, const subdiv_surface *surface,
                            int first_face, int face_count, int first_point, int point_count)
{
    int faces = surface->cage_face_count, points = surface->fine.vertex_count;
    if (first_face < 0 || face_count < 0 || first_face > faces - face_count)
        sdv_fail(context, SUBDIV_ERROR_INDEX, "the cage has %d faces", faces);
    if (first_point < 0 || point_count < 0 || first_point > points - point_count)
        sdv_fail(context, SUBDIV_ERROR_INDEX, "the result has %d points", points);
}

// ----------------------------------------------------------------------- >>results-as-meshes
// Makes meshes that own their arrays, and fills these.

// Lays an array out in a block behind the others. With base NULL only adds up the size.
static void *sdv_carve(char *base, size_t *size, size_t count, size_t item)
{
    char *array = base && count ? base + *size : NULL;
    size_t end = *size + count * item;
    *size = (end + 15) / 16 * 16 + 16 * SDV_SEPARATE;
    if (base && SDV_SEPARATE) SDV_GUARD(base + end, *size - end);
    return array;
}

// Lays out an array and copies the items of another one, unless that is NULL.
static void *sdv_carve_copy(char *base, size_t *size, const void *from, size_t count, size_t item)
{
    void *array = sdv_carve(base, size, count, item);
    if (array && from) sdv_copy(array, from, count, item);
    return array;
}

// Carves and copies an array of so many numbers an item.
#define SDV_CARVE(type, from, count, numbers) \
    ((type *)sdv_carve_copy(base, &size, from, count, (numbers) * sizeof(type)))

// Lays out the arrays of a mesh with the counts of a model, see sdv_new_mesh. Returns the size of
// the block.
static size_t sdv_carve_mesh(subdiv_mesh *mesh, const subdiv_mesh *model, char *base,
                             sdv_extras extras)
{
    size_t size = 0, vertices = (size_t)model->vertex_count, faces = (size_t)model->face_count;
    size_t creases = (size_t)model->crease_count, corners = (size_t)model->corner_count;
    size_t face_vertices = sdv_face_vertex_count(model), uvs = (size_t)model->uv_count, text = 0;
    size_t statements = (size_t)model->statement_count, colors = model->colors ? vertices : 0;
    size_t normals = extras == SDV_LIMIT ? (size_t)model->normal_count
                                         : (size_t)sdv_normal_count(model);
    int split = extras == SDV_LIMIT && normals > vertices;
    size_t lines = (size_t)model->line_count, line_vertices = 0;
    for (size_t i = 0; i < statements; i++) text += strlen(model->statements[i]) + 1;
    mesh->positions = SDV_CARVE(float, NULL, vertices, 3);
    mesh->face_vertices = SDV_CARVE(int, NULL, face_vertices, 1);
    mesh->face_sizes = SDV_CARVE(int, model->face_sizes, model->face_size ? 0 : faces, 1);
    mesh->cage_faces = SDV_CARVE(int, NULL, extras ? faces : 0, 1);
    mesh->crease_vertices = SDV_CARVE(int, model->crease_vertices, creases, 2);
    mesh->crease_sharpness = SDV_CARVE(float, model->crease_sharpness, creases, 1);
    mesh->corner_vertices = SDV_CARVE(int, model->corner_vertices, corners, 1);
    mesh->corner_sharpness = SDV_CARVE(float, model->corner_sharpness, corners, 1);
    mesh->holes = SDV_CARVE(int, NULL, (size_t)model->hole_count, 1);
    mesh->uvs = SDV_CARVE(float, model->uvs, uvs, 2);
    mesh->face_uvs = SDV_CARVE(int, model->face_uvs, uvs ? face_vertices : 0, 1);
    mesh->colors = SDV_CARVE(float, extras ? NULL : model->colors, colors, 3);
    mesh->normals = SDV_CARVE(float, extras ? NULL : model->normals, normals, 3);
    mesh->face_normals = SDV_CARVE(int, model->face_normals,
                                   split || model->face_normals ? face_vertices : 0, 1);
    for (size_t i = 0; i < lines; i++) line_vertices += (size_t)model->line_sizes[i];
    mesh->line_sizes = SDV_CARVE(int, model->line_sizes, lines, 1);
    mesh->line_vertices = SDV_CARVE(int, model->line_vertices, line_vertices, 1);
    mesh->statement_faces = SDV_CARVE(int, model->statement_faces, statements, 1);
    mesh->statements = SDV_CARVE(char *, NULL, statements, 1);
    char *texts = SDV_CARVE(char, NULL, text, 1);
    for (size_t i = 0; texts && i < statements; i++) {
        mesh->statements[i] = strcpy(texts, model->statements[i]);
        texts += strlen(texts) + 1;
    }
    return size;
}

// Makes a mesh with the counts of a model. Positions, face_vertices, holes and extras get room; all
// else that the model has is copied.
static void sdv_new_mesh(sdv_context *context, subdiv_mesh *mesh, const subdiv_mesh *model,
                         sdv_extras extras)
{
    *mesh = *model;
    sdv_block *block = sdv_allocate(context, sdv_carve_mesh(mesh, model, NULL, extras));
    if (!block) {
        memset(mesh, 0, sizeof *mesh);
        return;
    }
    mesh->memory = block;
    sdv_carve_mesh(mesh, model, (char *)(block + 1), extras);
}

// The face of the user's cage that a face was cut from.
static int sdv_user_face(const subdiv_surface *surface, int f)
{
    return surface->cage_face ? surface->cage_face[f] : f;
}

typedef struct sdv_faces_out {          // what the jobs that write fine faces share
    const subdiv_surface *surface;
    const sdv_sides *sides;             // writes normals instead of points; NULL: points
    int *face_vertices, *cage_faces;    // cage_faces: or NULL
    int  jobs;
} sdv_faces_out;

static void sdv_fine_faces_job(void *context, int job)
{
    const sdv_faces_out *out = (const sdv_faces_out *)context;
    const subdiv_surface *surface = out->surface;
    int end = sdv_share(surface->face_count, job + 1, out->jobs);
    for (int f = sdv_share(surface->face_count, job, out->jobs); f < end; f++) {
        int first = sdv_first_fine_face(surface, f), last = sdv_first_fine_face(surface, f + 1);
        int own = surface->own_face ? surface->own_face[f] : f;
        size_t size = (size_t)surface->fine.face_size;
        if (first == last) continue;
        int *vertices = out->face_vertices + (size_t)first * size;
        if (own >= 0) sdv_fine_faces(&surface->order, out->sides, own, vertices);
        for (size_t i = 0; own < 0 && i < (size_t)(last - first) * size; i++) vertices[i] = -1;
        for (int i = first; i < last && out->cage_faces; i++)
            out->cage_faces[i] = sdv_user_face(surface, f);
    }
}

static void sdv_make_fine_faces(const subdiv_surface *surface, const sdv_sides *sides,
                                int *face_vertices, int *cage_faces, const subdiv_options *opt)
{
    const subdiv_mesh *fine = &surface->fine;
    sdv_faces_out out = { surface, sides, face_vertices, cage_faces, 1 };
    if (surface->levels > 0) {
        out.jobs = sdv_jobs(opt, fine->face_count, SDV_JOB_POINTS);
        sdv_run(opt, sdv_fine_faces_job, &out, out.jobs);
        return;
    }
    size_t count = sdv_face_vertex_count(fine);
    sdv_copy(face_vertices, fine->face_vertices, count, sizeof(int));
    for (size_t h = 0; h < count && sides; h++)
        if (sides->vertex[h] >= 0) face_vertices[h] = fine->vertex_count + sides->vertex[h];
    for (int f = 0; f < fine->face_count && cage_faces; f++)
        cage_faces[f] = sdv_user_face(surface, f);
}

// Lists the fine faces that are holes, in order.
static void sdv_list_holes(const subdiv_surface *surface, int *holes)
{
    if (surface->levels == 0) {
        sdv_copy(holes, surface->fine.holes, (size_t)surface->fine.hole_count, sizeof(int));
        return;
    }
    for (int f = 0; f < surface->cage_face_count && surface->fine.hole_count; f++) {
        int end = surface->hole[f] ? sdv_first_fine_face(surface, f + 1) : 0;
        for (int i = sdv_first_fine_face(surface, f); i < end; i++) *holes++ = i;
    }
}

// Multiplies values by a factor. Sums of differences of huge coordinates could overflow: a power of
// two makes these smaller, without loss, and the result larger again, but no larger than the cage.
static void sdv_multiply(float *values, size_t count, float factor)
{
    for (size_t i = 0; i < count && factor != 1; i++) {
        double value = (double)values[i] * (double)factor, most = (double)FLT_MAX;
        values[i] = (float)(value > most ? most : value < -most ? -most : value);   // if rounded up
    }
}

// Checks the positions of a cage. Makes a smaller copy of huge ones. Returns the factor back.
static float sdv_shrink_huge(sdv_context *context, sdv_arena *arena, const subdiv_surface *surface,
                      const float **positions)
{
    size_t count = 3 * (size_t)surface->cage_vertex_count;
    if (*positions && sdv_find_exponent(*positions, count, SDV_HUGE) == count) return 1;
    sdv_check_positions(context, *positions, surface->cage_vertex_count);
    if (context->result || (surface->levels == 0 && !surface->rules.limit)) return 1;
    float *copy = SDV_NEW(context, arena, float, count);
    if (context->result) return 1;
    memcpy(copy, *positions, count * sizeof(float));
    sdv_multiply(copy, count, 1.0f / 4096);
    *positions = copy;
    return 4096;
}

// Makes the UVs and colours of the result.
static subdiv_result sdv_make_data(subdiv_mesh *made, const subdiv_surface *surface,
                                   const subdiv_options *opt)
{
    subdiv_result result = SUBDIV_OK;
    if (surface->uv)
        result = subdiv_evaluate(surface->uv, 2, surface->uvs, 2, made->uvs, 2, NULL, opt);
    if (surface->colors && !result)
        result = subdiv_evaluate(surface, 3, surface->colors, 3, made->colors, 3, NULL, opt);
    return result;
}

// Makes the result a mesh. once: the same surface if it makes nothing else, or NULL. Its rows are
// then freed before the faces are written, so that memory never holds both.
static subdiv_result sdv_make_mesh(subdiv_mesh *fine, const subdiv_surface *surface,
                                   subdiv_surface *once, const float *positions,
                                   const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    if (fine) memset(fine, 0, sizeof *fine);
    sdv_check_mesh_surface(&context, surface, fine != NULL);
    if (context.result) return context.result;

    subdiv_mesh made;
    memset(&made, 0, sizeof made);
    sdv_arena arena = sdv_scratch();
    float factor = sdv_shrink_huge(&context, &arena, surface, &positions);
    int limit = surface->rules.limit;
    if (!context.result)
        sdv_new_mesh(&context, &made, &surface->fine, limit ? SDV_LIMIT : SDV_RESULT);
    if (!context.result) {
        subdiv_limit out = { made.positions, made.normals, NULL, 0, NULL };
        if (limit) out.sides = made.normals + 3 * (size_t)made.vertex_count;
        context.result = limit ?
            subdiv_evaluate_limit(surface, positions, 3, &out, NULL, opt) :
            subdiv_evaluate(surface, 3, positions, 3, made.positions, 3, NULL, opt);
    }
    if (!context.result) context.result = sdv_make_data(&made, surface, opt);
    sdv_arena_free(&arena);
    if (once) sdv_arena_free(&once->points);
    if (once && once->uv) sdv_arena_free(&once->uv->points);
    if (!context.result) {
        sdv_multiply(made.positions, 3 * (size_t)made.vertex_count, factor);
        sdv_make_fine_faces(surface, NULL, made.face_vertices, made.cage_faces, opt);
        if (surface->uv) sdv_make_fine_faces(surface->uv, NULL, made.face_uvs, NULL, opt);
        if (made.face_normals)
            sdv_make_fine_faces(surface, &sdv_maker(surface)->sides, made.face_normals, NULL, opt);
        sdv_list_holes(surface, made.holes);
    }
    if (context.result) subdiv_mesh_free(&made);
    else *fine = made;
    return context.result;
}

// Checks and zeroes the mesh that is to be made of a cage.
static void sdv_begin_mesh(sdv_context *context, subdiv_mesh *fine, const subdiv_mesh *cage)
{
    if (!fine || fine == cage)
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, fine ? "fine is the cage" : "fine is NULL");
    else memset(fine, 0, sizeof *fine);
}

// ----------------------------------------------------------------------------------- >>calls
// The public functions of >>refine, >>animation and >>limit that build on the sections above, and
// subdiv_surface_locations. subdiv_refine prepares a surface, then makes its mesh:
//
//     sdv_prepare        the cage's topology (sdv_cage_build), then its rows (sdv_prepare_rows): on
//                        each level sdv_fill_level > sdv_vertex_row > sdv_vertex_mask
//     sdv_make_mesh      the arrays of the result, its points by subdiv_evaluate, UVs and faces
//     subdiv_evaluate    sdv_make_work, then sdv_make_points: rows and grids add up the points

SUBDIV_DEF subdiv_result subdiv_refine(subdiv_mesh *fine, const subdiv_mesh *cage, int levels,
                                       const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    subdiv_surface *surface = NULL;
    sdv_request request = sdv_request_of(cage, levels, NULL, 1, opt);
    sdv_begin_mesh(&context, fine, cage);
    if (!context.result && cage && cage->positions && cage->vertex_count > 0)
        sdv_check_positions(&context, cage->positions, cage->vertex_count);    // before the work
    if (!context.result) context.result = sdv_prepare(&surface, &request);
    if (!context.result)
        context.result = sdv_make_mesh(fine, surface, surface, cage->positions, opt);
    subdiv_surface_free(surface);
    return context.result;
}

SUBDIV_DEF subdiv_result subdiv_surface_mesh(subdiv_mesh *fine, const subdiv_surface *surface,
                                             const float *positions, const subdiv_options *opt)
{
    return sdv_make_mesh(fine, surface, NULL, positions, opt);
}

SUBDIV_DEF subdiv_result subdiv_prepare(subdiv_surface **surface, const subdiv_mesh *cage,
                                        int levels, const subdiv_options *opt)
{
    sdv_request request = sdv_request_of(cage, levels, sdv_find_exact_calls(), 0, opt);
    return sdv_prepare(surface, &request);
}

// Prepares the cage with these values as its UVs, and keeps the surface of the values alone.
SUBDIV_DEF subdiv_result subdiv_prepare_face_varying(subdiv_surface **surface,
                                                     const subdiv_mesh *cage, int value_count,
                                                     const int *indices, subdiv_uv_rule rule,
                                                     int levels, const subdiv_options *opt)
{
    sdv_request request = sdv_request_of(cage, levels, sdv_find_exact_calls(), 0, opt);
    request.alone = 1;
    request.values.count = value_count;
    request.values.indices = indices;
    request.values.rule = rule;
    subdiv_result result = sdv_prepare(surface, &request);
    if (result) return result;
    subdiv_surface *shape = *surface;
    *surface = shape->uv;
    (*surface)->is_values = 1;
    shape->uv = NULL;
    subdiv_surface_free(shape);
    return SUBDIV_OK;
}

// Frees a surface. It is itself in the first block of its arena, so the arena is copied first.
SUBDIV_DEF void subdiv_surface_free(subdiv_surface *surface)
{
    if (!surface) return;
    subdiv_surface_free(surface->uv);
    subdiv_surface_free(surface->at_level_1);
    subdiv_mesh_free(&surface->fine);
    sdv_arena arena = surface->arena;
    sdv_arena_free(&surface->points);
    sdv_arena_free(&arena);
}

SUBDIV_DEF int subdiv_surface_vertex_count(const subdiv_surface *surface)
{
    return surface ? surface->fine.vertex_count : 0;
}

SUBDIV_DEF int subdiv_surface_face_count(const subdiv_surface *surface)
{
    return surface ? surface->fine.face_count : 0;
}

SUBDIV_DEF int subdiv_surface_face_size(const subdiv_surface *surface)
{
    return surface ? surface->fine.face_size : 0;
}

SUBDIV_DEF int subdiv_surface_cage_face_count(const subdiv_surface *surface)
{
    return surface ? surface->cage_face_count : 0;
}

SUBDIV_DEF int subdiv_surface_edge_count(const subdiv_surface *surface)
{
    return surface ? surface->order.cage.edge_count : 0;
}

SUBDIV_DEF void subdiv_surface_edges(const subdiv_surface *surface, int *ends)
{
    if (!surface || !ends) return;
    const sdv_level *cage = &surface->order.cage;
    for (int h = 0; h < cage->face_vertex_count && cage->edge_count; h++) {
        int a = cage->face_vertices[h], b = cage->face_vertices[sdv_next(cage, h)];
        ends[2 * cage->face_edges[h]] = a < b ? a : b;
        ends[2 * cage->face_edges[h] + 1] = a < b ? b : a;
    }
}

SUBDIV_DEF int subdiv_first_inside(const subdiv_surface *surface, int cage_face)
{
    int faces = subdiv_surface_cage_face_count(surface);
    if (faces == 0 || surface->levels == 0 || surface->exact)
        return subdiv_surface_vertex_count(surface);
    int face = cage_face < 0 ? 0 : cage_face < faces ? cage_face : faces;
    return sdv_first_inside(&surface->order, face);
}

SUBDIV_DEF subdiv_result subdiv_surface_faces(const subdiv_surface *surface, int *face_vertices,
                                              int *cage_faces, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    if (!surface || !face_vertices)
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    else if (!surface->fine.face_size && surface->fine.face_count)
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "the faces are of several sizes");
    sdv_check_result(&context, surface);
    if (!context.result) sdv_make_fine_faces(surface, NULL, face_vertices, cage_faces, opt);
    return context.result;
}

// Writes the locations of a grid's points that have none yet, and those of the face-vertices of its
// faces: quads, or triangles and those upside down. Returns the place behind the last.
static subdiv_location *sdv_put_locations(const sdv_grid *grid, int face, int corner,
                                          subdiv_location *points, subdiv_location *out)
{
    static const unsigned char steps[3][4][2] = {               // of row and column
        { {0,0}, {0,1}, {1,1}, {1,0} }, { {0,0}, {0,1}, {1,0}, {0,0} },
        { {1,1}, {1,0}, {0,1}, {0,0} } };
    int triangle = grid->triangle;
    float u = 1.0f / (float)grid->columns, v = 1.0f / (float)grid->rows;
    for (int row = 0; row <= grid->rows && points; row++)
        for (int column = 0; column <= grid->columns - row * triangle; column++) {
            subdiv_location at = { face, corner, u * (float)column, v * (float)row };
            subdiv_location *point = &points[sdv_grid_index(grid, row, column)];
            if (point->face < 0) *point = at;
        }
    for (int row = 0; row < grid->rows && out; row++)
        for (int k = 0; k < (triangle ? 2 * (grid->columns - row) - 1 : grid->columns); k++)
            for (int i = 0; i < 4 - triangle; i++) {
                const unsigned char *step = steps[triangle ? 1 + k % 2 : 0][i];
                subdiv_location at = { face, corner, u * (float)((k >> triangle) + step[1]),
                                       v * (float)(row + step[0]) };
                *out++ = at;
            }
    return out;
}

// Writes the locations of a cage, see subdiv_surface_locations.
static void sdv_put_cage_locations(const subdiv_mesh *cage, subdiv_location *points,
                                   subdiv_location *out)
{
    for (int f = 0, h = 0; f < cage->face_count; f++) {
        int size = sdv_face_size(cage, f), loop = cage->scheme == SUBDIV_LOOP;
        int whole = size == (loop ? 3 : 4);
        for (int i = 0; i < size; i++, h++) {
            int u = whole && (i == 1 || (i == 2 && !loop)), v = whole && i >= 2;
            subdiv_location at = { f, whole ? 0 : i, (float)u, (float)v };
            if (points && points[cage->face_vertices[h]].face < 0)
                points[cage->face_vertices[h]] = at;
            if (out) out[h] = at;
        }
    }
}

SUBDIV_DEF subdiv_result subdiv_surface_locations(const subdiv_surface *surface,
                                                  subdiv_location *points,
                                                  subdiv_location *face_vertices,
                                                  const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_check_mesh_surface(&context, surface, 1);
    if (context.result) return context.result;
    for (int i = 0; i < surface->fine.vertex_count && points; i++) {
        const subdiv_location none = { -1, 0, 0, 0 };
        points[i] = none;
    }
    if (surface->levels == 0) sdv_put_cage_locations(&surface->fine, points, face_vertices);
    const sdv_order *order = &surface->order;
    for (int i = 0; i < (surface->levels ? 2 * surface->face_count : 0); i++) {
        int f = i % surface->face_count, holes = i >= surface->face_count;  // holes come last
        int start = sdv_face_start(&order->cage, f), grids = sdv_grids_of(order, f);
        int fine = sdv_first_fine_face(surface, f) < sdv_first_fine_face(surface, f + 1);
        for (int k = 0; k < grids && fine != holes; k++) {
            sdv_grid grid;
            sdv_grid_at(order, start + k, &grid);
            subdiv_location *end = sdv_put_locations(
                &grid, f, k, surface->hole[f] == SDV_DROPPED ? NULL : points,
                fine ? face_vertices : NULL);
            if (end) face_vertices = end;
        }
    }
    return context.result;
}

SUBDIV_DEF int subdiv_surface_normal_count(const subdiv_surface *surface)
{
    return surface ? surface->fine.normal_count : 0;
}

SUBDIV_DEF subdiv_result subdiv_surface_face_normals(const subdiv_surface *surface,
                                                     int *face_normals, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    if (!surface || !face_normals)
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    else if (!surface->rules.limit)
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "the surface was prepared without opt->limit");
    if (context.result) return context.result;
    const sdv_sides *sides = &sdv_maker(surface)->sides;
    sdv_make_fine_faces(surface, sides->vertex ? sides : NULL, face_normals, NULL, opt);
    return SUBDIV_OK;
}

SUBDIV_DEF size_t subdiv_scratch_size(const subdiv_surface *surface, int channels)
{
    if (!surface || channels < 1) return 0;
    if (surface->exact) return surface->exact_calls->size(surface, channels);
    surface = sdv_maker(surface);
    double points = (double)surface->work_count + 1;
    if (!sdv_addressable(channels, sizeof(float) * points)) return SIZE_MAX;
    return ((size_t)channels + 3) / 4 * 4 * sizeof(float) * ((size_t)surface->work_count + 1);
}

// Makes, from the values in scratch, the points of the result that belong to a range of cage faces
// and are in a range of points. Writes them to out, or to limit. Returns the context's result.
static subdiv_result sdv_make_range(sdv_context *context, const subdiv_surface *surface,
                                    int channels, const void *scratch, int first_face,
                                    int face_count, int first_point, int point_count, float *out,
                                    int out_stride, const subdiv_limit *limit,
                                    const subdiv_options *opt)
{
    sdv_evaluation evaluation;
    if (!context->result)
        sdv_check_range(context, surface, first_face, face_count, first_point, point_count);
    if (context->result) return context->result;
    memset(&evaluation, 0, sizeof evaluation);
    evaluation.surface = sdv_maker(surface);
    evaluation.channels = channels;
    evaluation.work = (float *)(size_t)scratch;     // only read
    evaluation.first_point = first_point;
    evaluation.end_point = first_point + point_count;
    evaluation.first_face = first_face;
    evaluation.end_face = first_face + face_count;
    evaluation.sides = surface->fine.normal_count - surface->fine.vertex_count;
    evaluation.out = out;
    evaluation.out_stride = (size_t)out_stride;
    evaluation.limit = limit;
    sdv_make_points(&evaluation, opt);
    return SUBDIV_OK;
}

SUBDIV_DEF subdiv_result subdiv_evaluate_begin(const subdiv_surface *surface, int channels,
                                               const float *in, int in_stride,
                                               void *scratch, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_check_values(&context, surface, channels, in, &in_stride);
    sdv_check_values(&context, surface, channels, scratch, &in_stride);
    if (context.result) return context.result;
    if (surface->exact) {
        surface->exact_calls->begin(surface, channels, in, (size_t)in_stride, scratch, opt);
        return SUBDIV_OK;
    }
    sdv_evaluation evaluation;
    memset(&evaluation, 0, sizeof evaluation);
    evaluation.surface = sdv_maker(surface);
    evaluation.channels = channels;
    evaluation.in = in;
    evaluation.in_stride = (size_t)in_stride;
    evaluation.work = (float *)scratch;
    sdv_make_work(&evaluation, opt);
    return SUBDIV_OK;
}

SUBDIV_DEF subdiv_result subdiv_evaluate_faces(const subdiv_surface *surface, int channels,
                                               const void *scratch,
                                               int first_face, int face_count,
                                               int first_point, int point_count,
                                               float *out, int out_stride,
                                               const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_check_values(&context, surface, channels, out, &out_stride);
    sdv_check_values(&context, surface, channels, scratch, &out_stride);
    sdv_check_result(&context, surface);
    return sdv_make_range(&context, surface, channels, scratch, first_face, face_count,
                          first_point, point_count, out, out_stride, NULL, opt);
}

// Makes all points of the result from values of the cage. Writes them to out, or to limit.
// Allocates scratch if it is NULL. Returns the context's result.
static subdiv_result sdv_make_all(sdv_context *context, const subdiv_surface *surface,
                                  int channels, const float *in, int in_stride, float *out,
                                  int out_stride, const subdiv_limit *limit, void *scratch,
                                  const subdiv_options *opt)
{
    sdv_arena arena = sdv_scratch();
    if (!context->result && !scratch)
        scratch = sdv_new(context, &arena, subdiv_scratch_size(surface, channels), 1);
    if (!context->result)
        context->result = subdiv_evaluate_begin(surface, channels, in, in_stride, scratch, opt);
    if (!context->result)
        sdv_make_range(context, surface, channels, scratch, 0, surface->cage_face_count, 0,
                       surface->fine.vertex_count, out, out_stride, limit, opt);
    sdv_arena_free(&arena);
    return context->result;
}

SUBDIV_DEF subdiv_result subdiv_evaluate(const subdiv_surface *surface, int channels,
                                         const float *in, int in_stride,
                                         float *out, int out_stride,
                                         void *scratch, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_check_values(&context, surface, channels, in, &in_stride);
    sdv_check_values(&context, surface, channels, out, &out_stride);
    sdv_check_result(&context, surface);
    return sdv_make_all(&context, surface, channels, in, in_stride, out, out_stride, NULL, scratch,
                        opt);
}

static void sdv_check_limit(sdv_context *context, const subdiv_surface *surface,
                            const subdiv_limit *out)
{
    if (!surface || !out) {
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
        return;
    }
    int least = out->tangents ? 6 : 3;
    sdv_check_result(context, surface);
    if (!surface->rules.limit)
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "the surface was prepared without opt->limit");
    if (out->stride && out->stride < least)
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "a stride of %d floats is less than %d",
                 out->stride, least);
}

SUBDIV_DEF subdiv_result subdiv_evaluate_limit_faces(const subdiv_surface *surface,
                                                     const void *scratch,
                                                     int first_face, int face_count,
                                                     int first_point, int point_count,
                                                     const subdiv_limit *out,
                                                     const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_check_limit(&context, surface, out);
    if (!scratch) sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "scratch is NULL");
    return sdv_make_range(&context, surface, 3, scratch, first_face, face_count, first_point,
                          point_count, NULL, 0, out, opt);
}

SUBDIV_DEF subdiv_result subdiv_evaluate_limit(const subdiv_surface *surface,
                                               const float *in, int in_stride,
                                               const subdiv_limit *out,
                                               void *scratch, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_check_limit(&context, surface, out);
    if (!context.result) sdv_check_values(&context, surface, 3, in, &in_stride);
    return sdv_make_all(&context, surface, 3, in, in_stride, NULL, 0, out, scratch, opt);
}

// --------------------------------------------------------------------------------- >>split
// The next level as a mesh, of which only a part is made: what touches an active vertex. All of it
// would do, and does under SUBDIV_PLAIN; but where a region is regular, a patch is its surface (see
// >>patches). Active are the vertices of rough faces, those that are not yet regular. A face-vertex
// makes a child face if its vertex is active: the children of such a face and the ring of faces
// around them.

typedef struct sdv_split {
    unsigned char *active;              // [vertex_count]
    int *vertex, *face, *edge;          // [vertices, faces, face-vertices] their points as vertices
                                        //      of the next level, or -1
    int *child;                         // [face-vertices; Loop: and one per face] of each child the
                                        //      face-vertex that stands for its parent's, or -1
    int vertex_points, face_points, edge_points, faces;
} sdv_split;

// Is h the face-vertex that stands for its edge where each edge is meant once? It is the last one
// of its ring.
static int sdv_is_edge(const sdv_level *level, int h)
{
    return level->across[h] <= h;
}

// The place of face f, on the grid of face-vertex h if the level is the cage.
static sdv_place sdv_place_of(const sdv_level *level, int f, int h)
{
    sdv_place first = { h, 0, 0, 1 };
    return level->places ? level->places[f] : first;
}

// Makes room for what the next level has of a level.
static void sdv_split_new(sdv_context *context, sdv_arena *arena, const sdv_level *level,
                          sdv_split *split)
{
    size_t vertices = (size_t)level->vertex_count, faces = (size_t)level->face_count;
    memset(split, 0, sizeof *split);
    sdv_reserve(context, arena, 8 * (size_t)level->face_vertex_count + 8 * (vertices + faces) + 64);
    split->active = SDV_NEW(context, arena, unsigned char, level->vertex_count);
    split->face = SDV_NEW(context, arena, int, faces);
    split->vertex = SDV_NEW(context, arena, int, vertices);
    split->edge = SDV_NEW(context, arena, int, level->face_vertex_count);
    split->child = SDV_NEW(context, arena, int, (size_t)level->face_vertex_count + faces);
}

static void sdv_find_active(const sdv_level *level, sdv_split *split)
{
    memset(split->active, 0, (size_t)level->vertex_count);
    for (int f = 0; f < level->face_count; f++) {
        int end = level->rough[f] ? sdv_face_end(level, f) : 0;
        for (int h = sdv_face_start(level, f); h < end; h++)
            split->active[level->face_vertices[h]] = 1;
    }
    for (int v = 0; v < level->vertex_count && level->partner; v++)
        if (split->active[v] && level->partner[v] >= 0) split->active[level->partner[v]] = 1;
}

// Numbers the children: each face-vertex has one where its vertex is active, and knows the
// face-vertex in it that continues it. Of a quad, child i keeps vertex i as its own vertex i, so
// that all descendants have their parent's orientation, and so with triangles; of any other polygon
// it becomes vertex 0. The middle child of a triangle is there for two active vertices.
static void sdv_number_faces(const sdv_level *level, sdv_split *split, int loop)
{
    int face = 0, size = loop ? 3 : 4;
    for (int f = 0; f < level->face_count; f++) {
        int active = 0, start = sdv_face_start(level, f), end = sdv_face_end(level, f);
        int *child = split->child + start + (loop ? f : 0), turn = end - start == size;
        for (int i = 0; i < end - start; i++) {
            child[i] = -1;
            if (!split->active[level->face_vertices[start + i]]) continue;
            child[i] = size * face++ + (turn ? i : 0);
            active++;
        }
        if (loop) child[3] = active >= 2 ? size * face++ : -1;
    }
    split->faces = face;
}

// Numbers what the next level will have: vertex points, face points (none under Loop), edge points.
static void sdv_number_points(const sdv_level *level, sdv_split *split, int loop)
{
    int next = 0;
    for (int v = 0; v < level->vertex_count; v++) split->vertex[v] = split->active[v] ? next++ : -1;
    split->vertex_points = next;
    for (int f = 0; f < level->face_count && !loop; f++) {
        int active = 0, end = sdv_face_end(level, f);
        for (int h = sdv_face_start(level, f); h < end; h++)
            active |= split->active[level->face_vertices[h]];
        split->face[f] = active ? next++ : -1;
    }
    split->face_points = next - split->vertex_points;
    for (int h = 0; h < level->face_vertex_count; h++) {
        if (!sdv_is_edge(level, h)) continue;
        int active = split->active[level->face_vertices[h]] |
                     split->active[level->face_vertices[sdv_next(level, h)]];
        int point = active ? next++ : -1, k = h;
        do split->edge[k] = point;
        while ((k = level->across[k]) != h);
    }
    split->edge_points = next - split->vertex_points - split->face_points;
}

// Sets what a point of the next level has, if the point is there.
static void sdv_split_point(sdv_level *next, int point, float sharpness, int faces)
{
    if (point < 0) return;
    next->vertex_sharpness[point] = sharpness;
    next->vertex_faces[point] = faces;
}

// Gives vertex, edge and face points what they inherit; each child has 2 (Loop: 3) faces at an edge
// point.
static void sdv_split_points(const sdv_level *level, const sdv_split *split, sdv_level *next,
                             const sdv_rules *rules)
{
    for (int v = 0; v < level->vertex_count; v++)
        sdv_split_point(next, split->vertex[v], sdv_fade(level->vertex_sharpness[v]),
                        level->vertex_faces[v]);
    for (int f = 0; f < level->face_count && !rules->loop; f++)
        sdv_split_point(next, split->face[f], 0, sdv_face_end(level, f) - sdv_face_start(level, f));
    for (int h = 0; h < level->face_vertex_count; h++)
        if (sdv_is_edge(level, h))
            sdv_split_point(next, split->edge[h],
                            rules->straight && level->across[h] == h ? SDV_IMPLIED : 0,
                            (rules->loop ? 3 : 2) * sdv_edge_faces(level, h));
}

// Splits partners and origins, which only surfaces of values have: only vertex points get them.
static void sdv_split_partners(sdv_context *context, sdv_arena *arena, const sdv_level *level,
                               const sdv_split *split, sdv_level *next)
{
    if (level->partner) next->partner = SDV_NEW(context, arena, int, next->vertex_count);
    if (level->partner) next->seam = SDV_NEW(context, arena, float, next->vertex_count);
    if (level->origin) next->origin = SDV_NEW(context, arena, int, next->vertex_count);
    if (context->result) return;
    next->origin_count = level->origin_count;
    next->sums = level->sums ? level->sums + 2 * (size_t)level->origin_count : NULL;
    for (int i = 0; i < next->vertex_count; i++) {
        if (next->partner) next->partner[i] = -1;
        if (next->origin) next->origin[i] = -1;
    }
    for (int v = 0; v < level->vertex_count; v++) {
        int point = split->vertex[v];
        if (point < 0) continue;
        if (next->origin) next->origin[point] = level->origin[v];
        if (!next->partner || level->partner[v] < 0) continue;
        next->partner[point] = split->vertex[level->partner[v]];
        next->seam[point] = sdv_seam_left(level, v);
    }
}

// Returns the face-vertex of a quad or triangle that is i places after h.
static inline int sdv_turn(int size, int h, int i)
{
    if (size == 4) return (h & ~3) | ((h + i) & 3);
    int at = (int)((unsigned)h % 3), to = at + i;
    return h - at + (to < 3 ? to : to - 3);
}

// Makes the child at face-vertex h. Its first edge, from the vertex on, is along the edge of h, and
// its last edge is along the edge before h: across these two are children of the neighbours.
//
//     Catmull-Clark           Loop        2          child at vertex 0:
//     3-----2                            /2\                vertex
//     | 3|2 |  F face point            e2---e1              edge point of edge 0
//     |--F--|                          /0\3/1\              (Catmull-Clark: face point)
//     | 0|1 |                         0---e0--1             edge point of the edge before
//     0-----1
static void sdv_split_vertex(const sdv_level *level, const sdv_split *split, sdv_level *next,
                             int size, int h, int child)
{
    const int *own = split->child, *vertices = level->face_vertices;
    int loop = size == 3, before = sdv_previous(level, h), v = vertices[h];
    int q = level->across[h], p = level->across[before], last = sdv_turn(size, child, size - 1);
    int on_q = vertices[q] == v ? q : sdv_next(level, q);        // the face-vertices at v across
    int on_p = vertices[p] == v ? p : sdv_next(level, p);
    int child_q = own[loop ? on_q + sdv_face_of(level, on_q) : on_q];
    int child_p = own[loop ? on_p + sdv_face_of(level, on_p) : on_p];
    float ahead = sdv_half(level, h), behind = sdv_half_before(level, before);

    next->face_vertices[child] = split->vertex[v];
    next->face_vertices[sdv_turn(size, child, 1)] = split->edge[h];
    next->face_vertices[last] = split->edge[before];
    if (on_q != q) child_q = sdv_turn(size, child_q, size - 1);
    if (on_p != p) child_p = sdv_turn(size, child_p, size - 1);
    next->across[child] = q == h ? child : child_q;
    next->across[last] = p == before ? last : child_p;
    next->sharpness[child] = ahead;
    next->sharpness[last] = behind;
    if (ahead > 0) next->creased[split->vertex[v]] = next->creased[split->edge[h]] = 1;
    if (behind > 0) next->creased[split->vertex[v]] = next->creased[split->edge[before]] = 1;
}

// Makes an edge between two children of a face, which is smooth. other < 0: there is only one
// child.
static void sdv_split_inside(sdv_level *next, int at, int other)
{
    next->across[at] = other < 0 ? at : other;
    next->sharpness[at] = 0;
}

// Returns the place of vertex i of a face; 3 of a triangle: across from vertex 0.
static sdv_place sdv_vertex_place(sdv_place face, int loop, int i)
{
    face.row += face.step * (i >= 2);
    face.column += face.step * (loop ? i & 1 : i == 1 || i == 2);
    return face;
}

// Sets the place of the child of face f at vertex i, or in Loop of the middle child, number 3,
// which is turned. grid: the face-vertex whose grid the child is on if f is a face of the cage.
static void sdv_place_child(const sdv_level *level, int f, int grid, int i, sdv_level *next,
                            int child)
{
    int loop = next->face_size == 3;
    sdv_place place = sdv_place_of(level, f, grid);
    place.row *= 2;
    place.column *= 2;
    place = sdv_vertex_place(place, loop, i);
    if (loop && i == 3) place.step = -place.step;
    next->places[child] = place;
    next->core[child] = level->rough[f];
}

// The middle child is e1 e2 e0: its edge i lies across from child i + 2.
static void sdv_split_middle(const sdv_split *split, sdv_level *next, int f)
{
    const int *child = split->child + 4 * (size_t)f, *edge = split->edge + 3 * (size_t)f;
    for (int i = 0; i < 3; i++) {
        int at = child[3] + i, beside = child[(i + 2) % 3];
        next->face_vertices[at] = edge[(i + 1) % 3];
        sdv_split_inside(next, at, beside < 0 ? -1 : sdv_turn(3, beside, 1));
    }
}

// Makes the children of face f.
static void sdv_split_face(const sdv_level *level, const sdv_split *split, sdv_level *next,
                           int size, int f)
{
    int start = sdv_face_start(level, f), count = sdv_face_end(level, f) - start, loop = size == 3;
    const int *children = split->child + start + (loop ? f : 0);
    for (int i = 0; i < count; i++) {
        int child = children[i], h = start + i;
        if (child < 0) continue;
        sdv_split_vertex(level, split, next, size, h, child);
        if (loop) {
            int middle = children[3] < 0 ? -1 : children[3] + (i + 1) % 3;
            sdv_split_inside(next, sdv_turn(3, child, 1), middle);
        } else {
            int after = children[i + 1 < count ? i + 1 : 0];
            int before = children[i > 0 ? i - 1 : count - 1];
            next->face_vertices[sdv_turn(4, child, 2)] = split->face[f];
            sdv_split_inside(next, sdv_turn(4, child, 1), after < 0 ? -1 : sdv_turn(4, after, 2));
            sdv_split_inside(next, sdv_turn(4, child, 2), before < 0 ? -1 : sdv_turn(4, before, 1));
        }
        sdv_place_child(level, f, count == size ? start : h, count == size ? i : 0, next,
                        child / size);
    }
    if (!loop || children[3] < 0) return;
    sdv_split_middle(split, next, f);
    sdv_place_child(level, f, start, 3, next, children[3] / 3);
}

static void sdv_split_level(sdv_context *context, sdv_arena *arena, const sdv_level *level,
                            const sdv_split *split, sdv_level *next, const sdv_rules *rules)
{
    int loop = rules->loop;
    memset(next, 0, sizeof *next);
    next->face_size = loop ? 3 : 4;
    next->face_count = split->faces;
    next->face_vertex_count = next->face_count * next->face_size;
    next->vertex_count = split->vertex_points + split->face_points + split->edge_points;
    next->first_point = level->first_point + level->vertex_count;
    sdv_level_new(context, arena, next, level->half_sharpness != NULL);
    next->face_vertices = SDV_NEW(context, arena, int, next->face_vertex_count);
    next->places = SDV_NEW(context, arena, sdv_place, next->face_count);
    sdv_split_partners(context, arena, level, split, next);
    if (context->result) return;
    for (int f = 0; f < level->face_count; f++)
        sdv_split_face(level, split, next, loop ? 3 : 4, f);
    sdv_level_count(next);
    sdv_split_points(level, split, next, rules);
    sdv_level_fade(next);
}

// Writes the rows from a level to the next: face points first, as the others are made from them.
// Among the points of the next level, vertex points come first, then face points, then edge points.
static void sdv_split_rows(sdv_level *level, const sdv_rules *rules, const sdv_split *split,
                           sdv_writer *writer, sdv_batches *refine)
{
    int next = level->first_point + level->vertex_count, faces = next + split->vertex_points;
    int edges = faces + split->face_points;
    for (int f = 0; f < level->face_count && !rules->loop && !writer->context->result; f++) {
        level->face_point[f] = next + split->face[f];
        if (split->face[f] >= 0) sdv_face_row(level, f, level->face_point[f], writer);
    }
    sdv_end_batches(writer, &refine[0]);
    for (int v = 0; v < level->vertex_count && !writer->context->result; v++)
        if (split->active[v]) sdv_vertex_row(level, rules, v, next++, writer);
    for (int h = 0; h < level->face_vertex_count && !writer->context->result; h++)
        if (split->edge[h] >= 0 && sdv_is_edge(level, h))
            sdv_edge_row(level, rules, h, edges++, writer);
    sdv_end_batches(writer, &refine[1]);
}

// Makes the next level of a level, and the rows to it.
static void sdv_split_step(sdv_writer *writer, const sdv_rules *rules, sdv_level *level,
                           sdv_split *split, sdv_level *next, sdv_batches *refine,
                           sdv_arena *next_arena, sdv_arena *scratch)
{
    sdv_context *context = writer->context;
    sdv_split_new(context, scratch, level, split);
    if (context->result) return;
    sdv_find_active(level, split);
    sdv_number_faces(level, split, rules->loop);
    sdv_number_points(level, split, rules->loop);
    sdv_split_rows(level, rules, split, writer, refine);
    if (!context->result) sdv_split_level(context, next_arena, level, split, next, rules);
}

// --------------------------------------------------------------------------------- >>plain
// SUBDIV_PLAIN refines without lines, grids and frames: every level is a mesh, split whole, and a
// mask is asked for every point, even if the same one is known. The last rows bring the points of
// the last level, or their limit, into THE ORDER OF THE RESULT.

// Adds the rows of the result, each at the first face that has the point. done [their count], 0 to
// begin with: those of the normals of all sides of creases but the first instead; NULL: no.
static void sdv_plain_result(const subdiv_surface *surface, const sdv_level *cage,
                             sdv_limit_writer *limit, unsigned char *done)
{
    const sdv_level *level = limit->level;
    sdv_writer *writer = limit->writer;
    int loop = surface->rules.loop, size = loop ? 3 : 4, limits = surface->rules.limit;
    int points = surface->order.count;
    for (int v = 0; v < cage->vertex_count && !done; v++)
        if (cage->vertex_first[v] < 0) sdv_stay_row(writer, limits, v, v);
    for (int f = 0; f < level->face_count && !writer->context->result; f++) {
        sdv_place place = level->places[f];
        sdv_grid grid;
        sdv_grid_at(&surface->order, place.h, &grid);
        if (done) sdv_see_sides(&surface->order, &surface->sides, place.h, &grid);
        sdv_batch_face(writer, sdv_face_of(cage, place.h));
        for (int i = 0; i < size; i++) {
            int h = size * f + i, v = level->face_vertices[h];
            if (!done && level->vertex_first[v] != h) continue;
            sdv_place at = sdv_vertex_place(place, loop, i);
            int target = sdv_grid_index(&grid, at.row, at.column), side = target - points;
            if (done && (side < 0 || done[side]++)) continue;
            if (done) sdv_limit_row(limit, h, target);
            else if (limits)
                sdv_limit_row(limit, sdv_first_seen(surface, level, level->vertex_next, h), target);
            else sdv_stay_row(writer, 0, level->first_point + v, target);
        }
    }
}

static void sdv_plain_rows(sdv_context *context, subdiv_surface *surface, const sdv_level *cage,
                           sdv_writer *writer, sdv_arena *scratch)
{
    sdv_level level = *cage, next = level;
    sdv_limit_writer limit;
    sdv_split split;
    for (int i = 0; i < surface->levels && !context->result; i++, level = next) {
        double points = level.first_point + 2.0 * level.vertex_count + level.face_count;
        memset(level.rough, 1, (size_t)level.face_count);      // so that all of it is split
        if (points + 4.0 * level.face_vertex_count > INT_MAX)
            sdv_fail(context, SUBDIV_ERROR_TOO_LARGE, "SUBDIV_PLAIN: a level has too many points");
        else sdv_split_step(writer, &surface->rules, &level, &split, &next,
                            &surface->refine[2 * i], scratch, scratch);
    }
    if (context->result) return;
    surface->work_count = level.first_point + level.vertex_count;
    sdv_begin_limit(writer, &surface->rules, &level, NULL, &limit);
    sdv_plain_result(surface, cage, &limit, NULL);
    sdv_end_batches(writer, &surface->limit_rows);
    size_t sides = (size_t)sdv_count_sides(&surface->sides, surface->order.n);
    unsigned char *done = SDV_NEW(context, scratch, unsigned char, sides);
    if (sides && done) memset(done, 0, sides);
    if (sides && done) sdv_plain_result(surface, cage, &limit, done);
    sdv_end_batches(writer, &surface->side_rows);
}

#ifndef SUBDIV_NO_EXACT
// ------------------------------------------------------------------------------- >>patches
// A face whose surroundings are regular, and stay so, has a polynomial as its limit surface: that
// of the 4 x 4 control points around it (Loop: 12 points). An edge that stays sharp forever parts
// the surface; beyond it the control points are mirrored, so that a face beside a boundary or
// crease is regular too:
//
//     Catmull-Clark   outside = 2 edge - inside            Loop   outside = a + b - inside
//
// So the edge is the B-spline curve, on every level: the masks of a crease make it.

typedef struct sdv_patch {
    int h;                              // the cage face-vertex of its grid (see >>order)
    int row, column;                    // of vertex 0 on that grid, in segments of the last level
    signed char step;                   // -1 for a triangle that is turned by half
    unsigned char sharp;                // bit i: edge i is sharp
    unsigned char fan[3];               // Loop: how the fan at vertex i goes on, an sdv_fan
    unsigned char up, along;            // quads: the strips it is cut into, see sdv_strips; or 0
    unsigned char level;                // of its face
    int polynomial;                     // the number of its first polynomial
    int points[16];                     // its control points, as work points (Loop has 12 of them);
} sdv_patch;                            //      for those that are mirrored, any

// The places of a face's own vertices among the control points of its patch.
static const int sdv_quad_own[4] = { 5, 6, 10, 9 }, sdv_triangle_own[3] = { 4, 5, 8 };

static int sdv_control_points(const sdv_rules *rules)
{
    return rules->loop ? 12 : 16;
}

// A quad whose edge is semi-sharp, as the crease goes straight on with the same sharpness, is still
// a product of curves. Across the crease, of sharpness s, the rows of control points
//
//     low      p0 | p1   p2   p3     the crease is row p1; high: p0   p1   p2 | p3, it is p2
//
// stay those of a sharp edge for c = ceil(s) levels, from where on they are a smooth B-spline's:
// inside, those beside a mirrored row; outside, p1 + (p0 - p1) / 2^c, as the row beside the edge
// goes half the way to it on each level; and the edge itself, p1, but for a fraction f of the
// last level (c - 1 levels before it) that blends:
//
//     p1 + (1 - f)/8 (inside - 2 p1 + outside)       of level c - 1
//
// So the quad is cut into strips: beside the crease those of level c whose control rows it changes,
// one segment wide (two if there is a fraction), and the rest, which does not know that the edge
// will ever be smooth. (A triangle is no such product: along the crease, what is beside it in
// Loop is not one polynomial but one for each segment of level c.)
//
// Strips are measured in segments of so many levels, as semi-sharp creases are smooth by then.
enum { SDV_STRIP_LEVELS = 10 };

typedef struct sdv_strip {
    int    from, to;                    // segments that it covers
    int    origin, unit;                // its own segment: where it starts, how long it is
    double rows[4][4];                  // its control rows, as sums of the patch's
} sdv_strip;

typedef struct sdv_strips {
    float low, high;                    // sharpness of the two edges, 0: not semi-sharp
    int   count;
    sdv_strip items[5];
} sdv_strips;

// Weighs p0 to p3 for the control point at t of the level with segments of length h, by the
// polynomial of sdv_cubic.
static void sdv_cubic_weights(double t, double h, double *w)
{
    double s = (1 - h * h) / 6 + t * t / 2, c = t * (t * t - h * h) / 6;
    w[0] = s - t / 2 - c;
    w[1] = 1 - 2 * s + 3 * c;
    w[2] = s + t / 2 - 3 * c;
    w[3] = c;
}

// Weighs p0 to p3 for row i of level c, counted from the low edge, while the edges are sharp.
static void sdv_sharp_row(const sdv_strips *strips, int c, int i, double *row)
{
    double h = ldexp(1, -c), *w = row;
    sdv_cubic_weights(i * h, h, w);
    if (strips->low > 0) {                              // p0 = 2 p1 - p2
        w[1] += 2 * w[0];
        w[2] -= w[0];
        w[0] = 0;
    }
    if (strips->high > 0) {                             // p3 = 2 p2 - p1
        w[2] += 2 * w[3];
        w[1] -= w[3];
        w[3] = 0;
    }
}

// Weighs p0 to p3 for the row of level c that is outside of row p[edge], as seen from inside.
static void sdv_outside_row(int c, int edge, double *row)
{
    double h = ldexp(1, -c);
    for (int k = 0; k < 4; k++) row[k] = 0;
    row[edge] = 1 - h;
    row[edge == 1 ? 0 : 3] = h;
}

// Weighs p0 to p3 for row i of level c, on which the edges are smooth.
static void sdv_strip_row(const sdv_strips *strips, int c, int i, double *row)
{
    int last = 1 << c, low = i <= 0, edge = low ? 1 : 2;
    double s = (double)(low ? strips->low : strips->high), fraction = s - floor(s);
    double outside[4], inside[4];
    sdv_sharp_row(strips, c, i, row);
    if (s <= 0 || (i > 0 && i < last)) return;
    if (i < 0 || i > last) sdv_outside_row(c, edge, row);
    if (i < 0 || i > last || fraction <= 0) return;
    sdv_outside_row(c - 1, edge, outside);
    sdv_sharp_row(strips, c - 1, low ? 1 : last / 2 - 1, inside);
    for (int k = 0; k < 4; k++)
        row[k] += (1 - fraction) / 8 * (inside[k] - 2 * (k == edge) + outside[k]);
}

// Adds the strip from segment first to last of level c. A smooth strip is one segment of its own;
// any other strip is a part of the patch's segment.
static void sdv_add_strip(sdv_strips *strips, int c, int first, int last, int smooth)
{
    sdv_strip *strip = &strips->items[strips->count++];
    int length = 1 << (SDV_STRIP_LEVELS - c);
    strip->from = first * length;
    strip->to = (last + 1) * length;
    strip->unit = smooth ? length : 1 << SDV_STRIP_LEVELS;
    strip->origin = smooth ? strip->from : 0;
    for (int j = 0; j < 4; j++) {
        if (smooth) sdv_strip_row(strips, c, first + j - 1, strip->rows[j]);
        else sdv_sharp_row(strips, 0, j - 1, strip->rows[j]);
    }
}

static sdv_strips sdv_cut_strips(float low, float high)
{
    double s = (double)(low > high ? low : high);
    int c = (int)ceil(s), width = s > floor(s) ? 2 : 1;
    int end = 1 << c, left = c && low > 0 ? width : 0, right = end - (c && high > 0 ? width : 0);
    sdv_strips strips;
    memset(&strips, 0, sizeof strips);
    strips.low = low;
    strips.high = high;
    if (left > right) left = right = end;
    for (int i = 0; i < left; i++) sdv_add_strip(&strips, c, i, i, 1);
    if (left < right) sdv_add_strip(&strips, c, left, right - 1, 0);
    for (int i = right; i < end; i++) sdv_add_strip(&strips, c, i, i, 1);
    return strips;
}

// How the surface goes on at a vertex, on all levels. Bits, so that a face may have those
// of all its vertices.
typedef enum sdv_kind {
    SDV_ROUGH = 1, SDV_FREE = 2, SDV_LINED = 4, SDV_EDGED = 8, SDV_PINNED = 16
} sdv_kind;

// Are all faces at v of the regular size, and so many?
static int sdv_has_regular_faces(const sdv_level *level, int v, int count, int size)
{
    if (level->vertex_faces[v] != count) return 0;
    if (level->face_size) return level->face_size == size;
    for (int h = level->vertex_first[v]; h >= 0; h = level->vertex_next[h])
        if (sdv_size_of(level, h) != size) return 0;
    return 1;
}

// Do two creases that cross fade each for itself? Then the blend of the vertex point, which is by
// the mean of what ends on this level, is that of one crease, or there is none.
static int sdv_cross_freely(float a, float b, const sdv_rules *rules)
{
    int whole = a <= floorf(a) && b <= floorf(b);
    if (a <= 0 || b <= 0 || a >= SUBDIV_INFINITE || b >= SUBDIV_INFINITE) return 1;
    if (rules->creasing == SUBDIV_CREASING_CHAIKIN) return whole && a <= b && a >= b;
    return whole || ceilf(a) < ceilf(b) || ceilf(a) > ceilf(b);
}

// Do creases go straight on through a regular vertex, with the same sharpness?
static int sdv_is_lined(const sdv_level *level, const sdv_rules *rules, int v)
{
    int first = level->vertex_first[v], h = first;
    float s[4];
    if (rules->loop || level->vertex_sharpness[v] > 0) return 0;
    if (!sdv_has_regular_faces(level, v, 4, 4)) return 0;
    for (int i = 0; i < 4; i++, h = sdv_around(level, h)) {
        if (h < 0 || (i > 0 && h == first) || level->across[level->across[h]] != h) return 0;
        s[i] = level->sharpness[h];
    }
    return h == first && memcmp(s, s + 2, 2 * sizeof *s) == 0 &&
           sdv_cross_freely(s[0], s[1], rules);
}

// Returns the kind of a vertex where something is sharp. Edged: it is on a crease that stays sharp.
// Pinned: it is a corner that stays one. Lined: it is on semi-sharp creases that go straight on, or
// end where a crease that stays sharp runs across. Anything else is rough.
static sdv_kind sdv_sharp_kind(const sdv_level *level, const sdv_rules *rules, int v, int dependent)
{
    sdv_sharp_edges edges = sdv_count_sharp_edges(level, v);
    int sharp = edges.now, stay = edges.forever;
    float s = level->vertex_sharpness[v];
    if (stay > 2 || s >= SUBDIV_INFINITE) return SDV_PINNED;
    int others = level->origin && level->origin[v] >= 0 &&      // across a seam
                 level->sums[2 * (size_t)level->origin[v] + 1] > (float)(sharp - stay);
    if (stay < sharp && !dependent && !others) {
        int ends = stay == 2 && sharp == 3 && s <= 0 && sdv_has_regular_faces(level, v, 2, 4);
        if (sdv_is_lined(level, rules, v) || (ends && !rules->loop)) return SDV_LINED;
    }
    return stay < sharp || s > 0 || sharp != 2 ? SDV_ROUGH : SDV_EDGED;
}

// Returns the kind of a vertex. Where nothing is sharp it is rough or free: free if it has the
// regular valence and its faces the regular size.
static sdv_kind sdv_vertex_kind(const sdv_level *level, const sdv_rules *rules, int v)
{
    int dependent = level->partner && level->partner[v] >= 0, loop = rules->loop;
    if (rules->linear) return SDV_FREE;
    if (dependent) v = level->partner[v];
    if (level->vertex_sharpness[v] > 0 || level->creased[v])
        return sdv_sharp_kind(level, rules, v, dependent);
    return sdv_has_regular_faces(level, v, loop ? 6 : 4, loop ? 3 : 4) ? SDV_FREE : SDV_ROUGH;
}

// A face's place among the faces at its vertex: in a ring without sharp edges; between two sharp
// edges first, in the middle or last, counter-clockwise; alone in a corner.
typedef enum sdv_fan { SDV_FAN_ROUGH, SDV_FAN_RING, SDV_FAN_FIRST, SDV_FAN_MIDDLE, SDV_FAN_LAST,
                       SDV_FAN_CORNER } sdv_fan;

static sdv_fan sdv_find_fan(const sdv_level *level, sdv_kind kind, int h, int loop)
{
    int faces = loop ? 3 : 2, size = loop ? 3 : 4, right = h, left = h, count = 1;
    if (kind == SDV_FREE) return SDV_FAN_RING;
    if (kind == SDV_LINED)
        return level->vertex_faces[level->face_vertices[h]] == 4 ? SDV_FAN_RING : SDV_FAN_FIRST;
    if (kind == SDV_ROUGH) return SDV_FAN_ROUGH;
    for (int i = sdv_clockwise(level, h); i >= 0 && count <= faces; i = sdv_clockwise(level, i)) {
        right = i;
        count += sdv_size_of(level, i) == size ? 1 : faces;
    }
    for (int i = sdv_counter_clockwise(level, h); i >= 0 && count <= faces;
         i = sdv_counter_clockwise(level, i)) {
        left = i;
        count += sdv_size_of(level, i) == size ? 1 : faces;
    }
    if (kind == SDV_PINNED) return count == 1 ? SDV_FAN_CORNER : SDV_FAN_ROUGH;
    if (count != faces) return SDV_FAN_ROUGH;
    return right == h ? SDV_FAN_FIRST : left == h ? SDV_FAN_LAST : SDV_FAN_MIDDLE;
}

static int sdv_point_at(const sdv_level *level, int h)
{
    return level->first_point + level->face_vertices[h];
}

// The 4 x 4 control points. Each open edge adds the two points of the face across it, and each
// vertex between two of them, which is in a ring, the one diagonally across. Sharp edges are
// closed, and those beyond which nothing is needed.
//
//     12 13 14 15          vertices 0 to 3 are points 5 6 10 9
//      8  9 10 11
//      4  5  6  7
//      0  1  2  3
static inline void sdv_gather_quad(const sdv_level *level, int h, sdv_patch *patch)
{
    static const signed char diagonal[4] = { 0, 3, 15, 12 };
    static const signed char beside[4] = { 1, 7, 14, 8 }, next[4] = { 2, 11, 13, 4 };
    const int *vertices = level->face_vertices, *across = level->across;
    int first = level->first_point, closed = patch->sharp, *points = patch->points;
    for (int i = 0; i < 16 && closed; i++) points[i] = first + vertices[h];
    points[5] = first + vertices[h];
    points[6] = first + vertices[h + 1];
    points[10] = first + vertices[h + 2];
    points[9] = first + vertices[h + 3];
    for (int i = 0; i < 4; i++) {
        if (closed >> i & 1) continue;
        int q = across[h + i], quad = sdv_quad_start(level, q), turn = q - quad;
        int corner = across[quad + ((turn + 1) & 3)];               // from vertex i on
        points[beside[i]] = first + vertices[quad + ((turn + 2) & 3)];
        points[next[i]] = first + vertices[quad + ((turn + 3) & 3)];
        if (closed >> ((i + 3) & 3) & 1) continue;
        quad = sdv_quad_start(level, corner);
        points[diagonal[i]] = first + vertices[quad + ((corner - quad + 3) & 3)];
    }
}

// The 12 control points. The neighbours of a point are to its right and left, above and below,
// above left and below right.
//
//     row  2     9 10                vertices 0 1 2 are points 4 5 8
//     row  1     6  8 11
//     row  0     3  4  5  7
//     row -1        0  1  2
//       column  -1  0  1  2
//
// Lists the ring of vertex i, counter-clockwise: its two neighbours in the face, the one across
// edge i-1, two more, the one across edge i.
static const int sdv_triangle_ring[3][6] = {
    { 5, 8, 6, 3, 0, 1 }, { 8, 4, 1, 2, 7, 11 }, { 4, 5, 11, 10, 9, 6 } };

static void sdv_gather_triangle(const sdv_level *level, int h, sdv_patch *patch)
{
    const unsigned char *fan = patch->fan;
    const int *vertices = level->face_vertices, *across = level->across;
    int first = level->first_point, *points = patch->points;
    for (int i = 0; i < 12; i++) points[i] = first + vertices[h];
    for (int i = 0; i < 3; i++) {
        int after = i < 2 ? i + 1 : 0, q = across[h + i];
        points[sdv_triangle_own[i]] = first + vertices[h + i];
        if (patch->sharp >> i & 1) continue;
        int at = sdv_next(level, q), before = sdv_previous(level, q);
        points[sdv_triangle_ring[i][5]] = first + vertices[before];
        if (fan[i] == SDV_FAN_RING || fan[i] == SDV_FAN_LAST)
            points[sdv_triangle_ring[i][4]] = first + vertices[sdv_previous(level, across[at])];
        if (fan[after] == SDV_FAN_RING || fan[after] == SDV_FAN_FIRST)
            points[sdv_triangle_ring[after][3]] =
                first + vertices[sdv_previous(level, across[before])];
    }
}

// Bilinear: the vertices of the face; the other control points have no weight.
static void sdv_gather_linear(const sdv_level *level, int h, int size, sdv_patch *patch)
{
    const int *own = size == 4 ? sdv_quad_own : sdv_triangle_own;
    for (int i = 0; i < 16; i++) patch->points[i] = sdv_point_at(level, h);
    for (int i = 0; i < size; i++) patch->points[own[i]] = sdv_point_at(level, h + i);
}

// Finds the control points of a patch, whose face starts with face-vertex h.
static inline void sdv_gather(const sdv_level *level, const sdv_rules *rules, int h,
                              sdv_patch *patch)
{
    if (rules->linear) sdv_gather_linear(level, h, rules->loop ? 3 : 4, patch);
    else if (rules->loop) sdv_gather_triangle(level, h, patch);
    else sdv_gather_quad(level, h, patch);
}

// Returns the number of the strips between two edges of these sharpnesses; 0 if both are semi-sharp
// and differ, or if there are too many strips already.
static int sdv_find_strips(sdv_writer *writer, float low, float high)
{
    sdv_strips *strips = (sdv_strips *)sdv_items(&writer->strips);
    int count = (int)writer->strips.count;
    if (low > 0 && high > 0 && (low < high || low > high)) return 0;
    for (int i = count; i > 0; i--) {
        float d = strips[i - 1].low - low, e = strips[i - 1].high - high;
        if (d * d + e * e <= 0) return i;
    }
    strips = (sdv_strips *)sdv_array_room(writer->context, &writer->strips, 1, sizeof *strips);
    if (!strips || count == UCHAR_MAX) return 0;
    *strips = sdv_cut_strips(low, high);
    return (int)++writer->strips.count;
}

// Looks at the edges and vertices of a face, unless all is free: which edges are sharp to the end,
// which semi-sharp, and how its vertices' fans go on. Does it have a patch?
static int sdv_find_fans(sdv_writer *writer, const sdv_level *level, const sdv_rules *rules,
                         int h, int size, sdv_patch *patch)
{
    const unsigned char *kinds = level->kinds;
    float semi[4] = { 0, 0, 0, 0 };
    for (int i = 0; i < size; i++) {
        float s = level->sharpness[h + i];
        if (sdv_is_semi_sharp(s)) semi[i] = s;
        else patch->sharp |= (unsigned char)((s > 0) << i);
        sdv_kind kind = (sdv_kind)kinds[level->face_vertices[h + i]];
        sdv_fan fan = sdv_find_fan(level, kind, h + i, rules->loop);
        if (fan == SDV_FAN_ROUGH) return 0;
        if (rules->loop) patch->fan[i] = (unsigned char)fan;
    }
    if (semi[0] + semi[1] + semi[2] + semi[3] <= 0) return 1;
    for (int i = 0; i < size; i++) {
        int at = h + i, next = h + (i + 1) % size;
        if (semi[i] > 0 && (kinds[level->face_vertices[at]] != SDV_LINED ||
                            kinds[level->face_vertices[next]] != SDV_LINED)) return 0;
    }
    patch->up = (unsigned char)sdv_find_strips(writer, semi[0], semi[2]);
    patch->along = (unsigned char)sdv_find_strips(writer, semi[3], semi[1]);
    return patch->up && patch->along;
}

// Makes the patch of face f, if it has one. free: so are all its vertices.
static int sdv_make_patch(sdv_writer *writer, const sdv_level *level, const sdv_rules *rules,
                          int f, int is_free, sdv_patch *patch)
{
    int h = sdv_face_start(level, f), size = rules->loop ? 3 : 4;
    sdv_place place = sdv_place_of(level, f, h);
    memset(patch, 0, sizeof *patch);
    memset(patch->fan, SDV_FAN_RING, sizeof patch->fan);
    patch->h = place.h;
    patch->row = place.row;
    patch->column = place.column;
    patch->step = (signed char)place.step;
    return is_free || sdv_find_fans(writer, level, rules, h, size, patch);
}

// Returns the kinds of a face's vertices, or rough if the face does not have the regular size.
static inline int sdv_face_kinds(const sdv_level *level, int f, int size)
{
    const unsigned char *kinds = level->kinds;
    int start = sdv_face_start(level, f);
    const int *v = level->face_vertices + start;
    if (sdv_face_end(level, f) - start != size) return SDV_ROUGH;
    int found = kinds[v[0]] | kinds[v[1]] | kinds[v[2]];
    return size == 4 ? found | kinds[v[3]] : found;
}

// Adds the patches of a level, in the order of its faces, and marks faces of the core without a
// patch as rough. There are at most as many patches as faces whose vertices are not rough; that is
// about how many there are, so the array is of this size, and a bit larger only if a later level
// adds to it.
static void sdv_find_patches(sdv_writer *writer, sdv_level *level, const sdv_rules *rules,
                             sdv_array *patches)
{
    sdv_context *context = writer->context;
    int size = rules->loop ? 3 : 4;
    size_t most = patches->count + (size_t)level->face_count;
    memcpy(level->rough, level->core, (size_t)level->face_count);
    for (int v = 0; v < level->vertex_count; v++)
        level->kinds[v] = (unsigned char)sdv_vertex_kind(level, rules, v);
    for (int f = 0; f < level->face_count; f++)
        most -= !level->core[f] || (sdv_face_kinds(level, f, size) & SDV_ROUGH);
    if (most > patches->capacity)
        sdv_grow(context, patches, patches->count ? most + most / 4 : most, sizeof(sdv_patch));
    for (int f = 0; f < level->face_count && !context->result; f++) {
        int h = sdv_face_start(level, f), found = sdv_face_kinds(level, f, size);
        if (!level->core[f] || (found & SDV_ROUGH)) continue;
        sdv_patch *patch = (sdv_patch *)sdv_items(patches) + patches->count;
        if (!sdv_make_patch(writer, level, rules, f, found == SDV_FREE, patch)) continue;
        sdv_gather(level, rules, h, patch);
        level->rough[f] = 0;
        patches->count++;
    }
}

// -------------------------------------------------------------------------- >>exact-surface
// The limit surface anywhere. The cage is refined where it is not regular, until every face left
// is a patch, whose polynomial is the surface, or in a nest: the faces around one irregular vertex
// that look the same on every level from here on, half as large. They are the faces of a closed
// ring, or those between two sharp edges.
//
//     +-------+-------+        Of the four children of a face in a nest, three are patches (p), the
//     |       |       |        fourth is in the nest of the next level. Which points that level
//     |   p   |   p   |        has and how they follow is the same at all such vertices, and is
//     |       |       |        kept once: a nest kind. What the vertex itself has is subtracted and
//     +---+---+-------+        the rest doubled at every step, so that nothing gets lost, however
//     | n | p |       |        near a sample is. The polynomials of a few levels are kept, too.
//     +---+---+   p   |
//     | n | n |       |
//     v---+---+-------+
//
// Patches and faces of nests are the leaves; cells find the one that has a location.

enum { SDV_EXACT_LEVELS = 13 };         // sharpness is gone after 10, see sdv_fade; the last
                                        // ones set the rings of vertices apart
enum { SDV_NEST_DEPTH = 4 };            // levels of a nest whose polynomials are kept
enum { SDV_SLOTS = 16 };                // coefficients of a polynomial; Loop needs 14 of them

// The powers of x and y of each coefficient.
static const unsigned char sdv_powers[2][SDV_SLOTS][2] = {
    { {0,0}, {1,0}, {2,0}, {3,0}, {0,1}, {1,1}, {2,1}, {3,1},
      {0,2}, {1,2}, {2,2}, {3,2}, {0,3}, {1,3}, {2,3}, {3,3} },
    { {0,0}, {1,0}, {2,0}, {3,0}, {0,1}, {1,1}, {2,1}, {3,1},
      {0,2}, {1,2}, {0,3}, {1,3}, {0,4}, {4,0}, {0,0}, {0,0} } };

// Points of a nest: the vertex; then of each face, counter-clockwise, as far as two faces away,
//
//     Catmull-Clark   5   4        Loop      .        the vertex v, and what continues the last
//                     .   2   3              . 2      face of a nest that is no ring: its 0, 1.
//                     v . 0 . 1              v 0 1
typedef struct sdv_nest_kind {
    int      faces, ring;
    sdv_rule rule;                      // of the vertex; a dart's ring starts at its sharp edge
    int      points;
    int      work_count;                // the points, and those of the next level
    sdv_batches refine[2];              // the rows: to face points, to the others
    int     *below;                     // [points] the same points of the next level's nest
    sdv_patch *patches;                 // for each turn of the faces: three of each face
    double  *limit;                     // [3 * points] weights of the limit and of two tangents
} sdv_nest_kind;

typedef struct sdv_nest {
    int kind, first;                    // where its points start
    int face;                           // the first of its faces, in order
} sdv_nest;

typedef struct sdv_nest_face {
    int nest, turn;                     // the vertex of the nest is its vertex number turn
    int level;
    sdv_place place;                    // on the grid of its cage face
} sdv_nest_face;

typedef struct sdv_exact {
    sdv_patch *patches;                 // [patch_count] level by level
    sdv_strips *strips;                 // of semi-sharp patches, counted from 1
    int patch_count;
    int polynomial_count;               // of patches; those of nests' faces come behind
    unsigned *cells;                    // see >>cells
    int *home;                          // [vertices and edges of the cage] the face-vertex whose
                                        //      face evaluates what several faces have, or -1
    unsigned char *hole;                // [faces of the cage] 1, or SDV_DROPPED: without a surface
    sdv_nest_kind *kinds;
    sdv_nest *nests;
    int *nest_points;                   // work points
    sdv_nest_face *nest_faces;
    int kind_count, nest_count, nest_point_count, nest_face_count;
    int most_work;                      // of the kinds' work_counts
} sdv_exact;

// Makes an exact surface; arrays grow.
typedef struct sdv_exact_maker {
    sdv_writer     *writer;
    subdiv_surface *surface;
    sdv_array patches, kinds, nests, nest_points, nest_faces;
} sdv_exact_maker;

// Makes the point of a row, in doubles: points of fine levels differ in their last digits alone.
SDV_INLINE void sdv_exact_row(const sdv_shape *shape, const int *row, const float *weights,
                              double *work)
{
    double *out = work + 4 * (size_t)row[0], p0[4], sum[4] = { 0, 0, 0, 0 };
    memcpy(p0, work + 4 * (size_t)row[1], sizeof p0);
    row += 2;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < shape->count[k]; i++) {
            const double *p = work + 4 * (size_t)*row++;
            for (int c = 0; c < 4; c++) sum[c] += (double)weights[k] * (p[c] - p0[c]);
        }
    for (int c = 0; c < 4; c++) out[c] = p0[c] + sum[c];
}

// Makes job number job's share of the points of batches.
static void sdv_make_exact_rows(const sdv_batches *batches, double *work, int job, int jobs)
{
    for (int b = 0; b < batches->starts[batches->blocks]; b++) {
        const sdv_batch *batch = &batches->items[b];
        int points = sdv_row_points(&batch->shape), own = batch->shape.own;
        int i = sdv_share(batch->rows, job, jobs), end = sdv_share(batch->rows, job + 1, jobs);
        size_t stride = 1 + (size_t)points + (size_t)own;
        const int *row = batch->items + stride * (size_t)i;
        for (float w[3]; i < end; i++, row += stride) {
            memcpy(w, own ? (const void *)(row + 1 + points) : batch->shape.weight, sizeof w);
            sdv_exact_row(&batch->shape, row, w, work);
        }
    }
}

// Makes the work points of an exact surface: the cage's from the input, all others step by step.
typedef struct sdv_exact_work {
    const subdiv_surface *surface;
    int          channels;
    const float *in;
    size_t       in_stride;
    double      *points;                // [4 * work_count] for every four channels
    int          step, jobs;
} sdv_exact_work;

static void sdv_exact_input(const sdv_exact_work *e)
{
    const int *source = e->surface->source;
    for (int c = 0; c < e->channels; c += 4) {
        double *out = e->points + (size_t)c * (size_t)e->surface->work_count;
        for (int v = 0; v < e->surface->cage_vertex_count; v++, out += 4) {
            const float *in = e->in + e->in_stride * (size_t)(source ? source[v] : v) + c;
            for (int k = 0; k < 4; k++) out[k] = k < e->channels - c ? (double)in[k] : 0;
        }
    }
}

static void sdv_exact_step_job(void *context, int job)
{
    const sdv_exact_work *e = (const sdv_exact_work *)context;
    for (int c = 0; c < e->channels; c += 4)
        sdv_make_exact_rows(&e->surface->refine[e->step],
                            e->points + (size_t)c * (size_t)e->surface->work_count, job, e->jobs);
}

static void sdv_make_exact_work(sdv_exact_work *e, const subdiv_options *opt)
{
    sdv_exact_input(e);
    for (e->step = 0; e->step < 2 * SDV_EXACT_LEVELS; e->step++) {
        if (e->surface->refine[e->step].rows == 0) continue;
        e->jobs = sdv_jobs(opt, e->surface->refine[e->step].rows, 4096);
        sdv_run(opt, sdv_exact_step_job, e, e->jobs);
    }
}

// --------------------------------------------------------------------------------- >>nests
// Nests: what is the same at many vertices, made once from a small mesh, and where they are.

// Lists the points of a nest, from the face of h on, a face-vertex at the nest's vertex.
static void sdv_nest_points(const sdv_level *level, int h, int faces, int ring, int loop, int *out)
{
    *out++ = sdv_point_at(level, h);
    for (int i = 0; i < faces; i++) {
        int next = sdv_next(level, h), beside = level->across[next];
        int outer = sdv_previous(level, beside), last = i + 1 == faces && !ring;
        int tip = level->across[loop ? sdv_next(level, beside) : outer];
        int end = loop ? level->across[outer] : level->across[sdv_next(level, next)];
        *out++ = sdv_point_at(level, next);
        if (loop) {
            *out++ = sdv_point_at(level, sdv_previous(level, tip));
            *out++ = sdv_point_at(level, outer);
        } else {
            *out++ = sdv_point_at(level, sdv_next(level, sdv_next(level, beside)));
            *out++ = sdv_point_at(level, sdv_next(level, next));
            *out++ = sdv_point_at(level, outer);
            *out++ = sdv_point_at(level, sdv_next(level, sdv_next(level, tip)));
            *out++ = sdv_point_at(level, sdv_previous(level, tip));
        }
        if (last) {
            *out++ = sdv_point_at(level, sdv_previous(level, h));
            *out++ = sdv_point_at(level, sdv_previous(level, end));
        }
        if (!last) h = sdv_around(level, h);
    }
}

// The faces of a nest and those around it, as a mesh: for each face of the nest four faces.
static void sdv_nest_mesh(const sdv_nest_kind *kind, int loop, int *faces)
{
    static const int quads[16] = { -1, 0, 2, 6, 0, 1, 3, 2, 2, 3, 4, 5, 6, 2, 5, 7 };
    static const int triangles[12] = { -1, 0, 6, 0, 2, 6, 0, 1, 2, 6, 2, 7 };
    int width = loop ? 3 : 6, size = loop ? 12 : 16;
    for (int i = 0; i < kind->faces; i++) {
        int first = 1 + width * i, next = i + 1 == kind->faces && kind->ring ? 1 : first + width;
        for (int j = 0; j < size; j++) {
            int k = loop ? triangles[j] : quads[j];         // 6, 7: the next face's 0, 1
            *faces++ = k < 0 ? 0 : k < 6 ? first + k : next + k - 6;
        }
    }
}

// Measures the weights of a tangent, where those of a regular vertex have size 1: sums the squares
// of the edges' weights, which are wave times a cosine or sine, and of the faces' weights. inner
// leaves out the first and the last edge.
static double sdv_tangent_size(const double *t, int edges, int faces, int inner, double wave)
{
    double size = 0;
    for (int i = inner; i < edges - inner; i++) size += t[1 + i] * t[1 + i] / wave;
    for (int i = 0; i < faces; i++) size += t[1 + edges + i] * t[1 + edges + i];
    return size;
}

// Makes the weights of the limit point and of two tangents, along the first edge and a quarter turn
// away, scaled so that at a regular vertex they are the derivatives.
static void sdv_nest_limit(sdv_context *context, const sdv_rules *rules, sdv_nest_kind *kind,
                           sdv_arena *arena, sdv_arena *scratch)
{
    int n = kind->faces, open = !kind->ring, width = rules->loop ? 3 : 6, edges = n + open;
    int across = rules->loop ? 0 : n, points = 1 + edges + across;
    double *rows = SDV_NEW(context, scratch, double, 4 * (size_t)points), size[3] = { 1, 0, 0 };
    sdv_sector sector;
    sector.rays = SDV_NEW(context, scratch, sdv_ray, edges);
    kind->limit = SDV_NEW(context, arena, double, 3 * (size_t)kind->points);
    if (context->result) return;
    sdv_settle(&sector, kind->rule, n, open);
    sdv_settled_rows(rules, &sector, rows, rows + 3 * points);
    size[1] = sdv_tangent_size(rows + points, edges, across, 0, open ? 1 : 4);
    size[2] = sdv_tangent_size(rows + 2 * points, edges, across, open, 4);
    for (int k = 0; k < 3; k++, rows += points) {
        double *w = kind->limit + k * kind->points, scale = size[k] > 0 ? 1 / size[k] : 1;
        for (int i = 0; i < kind->points; i++) w[i] = 0;
        w[0] = scale * rows[0];
        for (int i = 0; i < edges; i++) w[1 + width * i] = scale * rows[1 + i];
        for (int i = 0; i < across; i++) w[3 + width * i] = scale * rows[1 + edges + i];
    }
}

// Turns a patch of a nest by one vertex: control point k becomes number sdv_turned_points[k].
static const unsigned char sdv_turned_points[2][16] = {
    { 12, 8, 4, 0, 13, 9, 5, 1, 14, 10, 6, 2, 15, 11, 7, 3 },
    { 9, 6, 3, 10, 8, 4, 11, 0, 5, 7, 2, 1, 0, 0, 0, 0 } };

static sdv_patch sdv_turn_patch(const sdv_rules *rules, const sdv_patch *from)
{
    const unsigned char *turned = sdv_turned_points[rules->loop];
    int sides = rules->loop ? 3 : 4, sharp = from->sharp;
    sdv_patch patch = *from;
    for (int i = 0; i < sdv_control_points(rules); i++) patch.points[i] = from->points[turned[i]];
    patch.sharp = (unsigned char)((sharp << 1 | sharp >> (sides - 1)) & ((1 << sides) - 1));
    for (int i = 0; i < 3; i++) patch.fan[(i + 1) % 3] = from->fan[i];
    return patch;
}

// Keeps the patches of a nest, which are as seen from its vertex, and adds all that faces see which
// have the vertex as their number 1, 2 or 3.
static void sdv_nest_turns(sdv_context *context, sdv_arena *arena, const sdv_rules *rules,
                           const sdv_patch *seen, sdv_nest_kind *kind)
{
    int count = 3 * kind->faces, all = count * (rules->loop ? 3 : 4);
    kind->patches = SDV_NEW(context, arena, sdv_patch, all);
    for (int i = 0; i < all && kind->patches; i++)
        kind->patches[i] = i < count ? seen[i] : sdv_turn_patch(rules, &kind->patches[i - count]);
}

// Parts the two triangles around a vertex of valence 2: gives each an edge of its own across from
// the vertex, where a mesh would have one that both and their neighbours share. The pairs are that
// edge's face-vertices in the faces of sdv_nest_mesh.
static void sdv_part_triangles(sdv_level *level, int dart)
{
    static const int pairs[2][2] = { { 1, 5 }, { 13, 17 } };
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++) {
            level->across[pairs[i][k]] = pairs[i][1 - k];
            level->sharpness[pairs[i][k]] = 0;
            level->vertex_sharpness[1 + 3 * i] = 0;
            level->creased[1 + 3 * i] = (unsigned char)(dart && i == 0);
        }
}

// Makes a cage of the faces of a kind of nest and the faces around them. The nest's are the core.
static void sdv_nest_cage(sdv_context *context, sdv_arena *arena, const sdv_nest_kind *kind,
                          int loop, sdv_cage *cage)
{
    int crease[4] = { 0, 1, 1, 2 }, faces = 4 * kind->faces;
    float forever[2] = { SUBDIV_INFINITE, SUBDIV_INFINITE };
    subdiv_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    mesh.vertex_count = kind->points;
    mesh.face_count = faces;
    mesh.face_size = loop ? 3 : 4;
    mesh.face_vertices = SDV_NEW(context, arena, int, 4 * (size_t)faces);
    mesh.crease_count = kind->rule == SDV_DART ? 2 : 0;
    mesh.crease_vertices = crease;
    mesh.corner_count = kind->rule == SDV_CORNER;
    mesh.corner_vertices = crease;
    mesh.crease_sharpness = mesh.corner_sharpness = forever;
    if (!context->result) sdv_nest_mesh(kind, loop, mesh.face_vertices);
    if (!context->result) sdv_cage_build(context, arena, arena, cage, &mesh);
    if (context->result) return;
    if (loop && kind->faces == 2 && kind->ring)
        sdv_part_triangles(&cage->level, kind->rule == SDV_DART);
    for (int f = 0; f < faces; f++) cage->level.core[f] = cage->level.rough[f] = f % 4 == 0;
}

// Builds a kind: one step of refinement of a small mesh.
static void sdv_build_nest_kind(sdv_exact_maker *maker, sdv_nest_kind *kind, sdv_arena *scratch)
{
    sdv_context *context = maker->writer->context;
    sdv_arena *arena = &maker->surface->arena;
    const sdv_rules *rules = &maker->surface->rules;
    sdv_array patches = { NULL, 0, 0 };
    sdv_cage cage;
    sdv_split split;
    sdv_level next;
    kind->points = 1 + (rules->loop ? 3 : 6) * kind->faces + (kind->ring ? 0 : 2);
    kind->below = SDV_NEW(context, arena, int, kind->points);
    if (!context->result) sdv_nest_cage(context, scratch, kind, rules->loop, &cage);
    if (context->result) return;
    sdv_split_step(maker->writer, rules, &cage.level, &split, &next, kind->refine, scratch,
                   scratch);
    if (context->result) return;
    kind->work_count = next.first_point + next.vertex_count;
    sdv_find_patches(maker->writer, &next, rules, &patches);
    SUBDIV_ASSERT(context->result || (int)patches.count == 3 * kind->faces);
    if (!context->result)
        sdv_nest_turns(context, arena, rules, (const sdv_patch *)sdv_items(&patches), kind);
    sdv_array_free(&patches);
    if (context->result) return;
    sdv_nest_points(&next, split.child[0], kind->faces, kind->ring, rules->loop, kind->below);
    sdv_nest_limit(context, rules, kind, arena, scratch);
}

static int sdv_find_nest_kind(sdv_exact_maker *maker, int faces, int ring, sdv_rule rule)
{
    const sdv_nest_kind *known = (const sdv_nest_kind *)sdv_items(&maker->kinds);
    sdv_arena scratch = sdv_scratch();
    sdv_nest_kind kind;
    int count = (int)maker->kinds.count;
    for (int i = 0; i < count; i++)
        if (known[i].faces == faces && known[i].ring == ring && known[i].rule == rule) return i;
    memset(&kind, 0, sizeof kind);
    kind.faces = faces;
    kind.ring = ring;
    kind.rule = rule;
    sdv_build_nest_kind(maker, &kind, &scratch);
    sdv_arena_free(&scratch);
    sdv_nest_kind *made = (sdv_nest_kind *)sdv_append(maker->writer->context, &maker->kinds, 1,
                                                      sizeof kind);
    if (made) *made = kind;
    return count;
}

// Returns the rule of a vertex that may have nests, as nothing is semi-sharp there or at its
// partner; else SDV_NO_NEST.
enum { SDV_NO_NEST = SDV_CORNER + 1 };

static int sdv_nest_rule(const sdv_level *level, int v)
{
    int partner = level->partner ? level->partner[v] : -1;
    if (!sdv_vertex_settled(level, v) || (partner >= 0 && !sdv_vertex_settled(level, partner)))
        return SDV_NO_NEST;
    return (int)sdv_vertex_fading(level, v).rule;
}

// Is the vertex of h regular as seen from its face, with nothing semi-sharp?
static sdv_fan sdv_fan_at(const sdv_level *level, int loop, int h)
{
    sdv_kind kind = (sdv_kind)level->kinds[level->face_vertices[h]];
    return kind == SDV_LINED ? SDV_FAN_ROUGH : sdv_find_fan(level, kind, h, loop);
}

// Are the neighbours in the faces from h on regular, creased only along the first and last edge?
static int sdv_is_nest(const sdv_level *level, int loop, int h, int faces, int ring)
{
    for (int i = 0; i < faces; i++) {
        int next = sdv_next(level, h), before = sdv_previous(level, h);
        sdv_fan fan = sdv_fan_at(level, loop, next);
        if (i > 0 || ring ? fan != SDV_FAN_RING : fan == SDV_FAN_ROUGH || fan == SDV_FAN_CORNER)
            return 0;
        if (loop ? level->sharpness[next] > 0
                 : sdv_fan_at(level, loop, sdv_next(level, next)) != SDV_FAN_RING) return 0;
        fan = sdv_fan_at(level, loop, before);
        if (i + 1 == faces && !ring && (fan == SDV_FAN_ROUGH || fan == SDV_FAN_CORNER)) return 0;
        if (i + 1 < faces) h = sdv_around(level, h);
    }
    return 1;
}

// Makes a nest of so many faces from h on, counter-clockwise. They become leaves.
static void sdv_new_nest(sdv_exact_maker *maker, sdv_level *level, int depth, int h, int faces,
                         int ring, sdv_rule rule)
{
    sdv_context *context = maker->writer->context;
    int number = (int)maker->nests.count, kind = sdv_find_nest_kind(maker, faces, ring, rule);
    sdv_nest *nest = (sdv_nest *)sdv_append(context, &maker->nests, 1, sizeof *nest);
    if (context->result) return;
    size_t count = (size_t)((const sdv_nest_kind *)sdv_items(&maker->kinds))[kind].points;
    nest->kind = kind;
    nest->first = (int)maker->nest_points.count;
    nest->face = (int)maker->nest_faces.count;
    int *points = (int *)sdv_append(context, &maker->nest_points, count, sizeof *points);
    sdv_nest_face *face = (sdv_nest_face *)sdv_append(context, &maker->nest_faces, (size_t)faces,
                                                      sizeof *face);
    if (context->result) return;
    sdv_nest_points(level, h, faces, ring, maker->surface->rules.loop, points);
    for (int i = 0; i < faces; i++, face++) {
        int f = sdv_face_of(level, h), start = sdv_face_start(level, f);
        face->nest = number;
        face->turn = h - start;
        face->level = depth;
        face->place = sdv_place_of(level, f, start);
        level->rough[f] = 0;
        if (i + 1 < faces) h = sdv_counter_clockwise(level, h);
    }
}

// Looks for a nest at the vertex of h, which has this rule, and marks its face-vertices as seen.
static void sdv_find_nest(sdv_exact_maker *maker, sdv_level *level, int depth, int h,
                          int rule, unsigned char *seen)
{
    int first = h, last, faces = 1, i;
    while ((i = sdv_clockwise(level, first)) >= 0 && i != h) first = i;
    int ring = i == h;
    seen[last = first] = 1;
    for (; (i = sdv_counter_clockwise(level, last)) >= 0 && i != first; faces++) seen[last = i] = 1;
    if (rule == SDV_NO_NEST || !sdv_is_nest(level, maker->surface->rules.loop, first, faces, ring))
        return;
    int dart = rule == SDV_DART, plain = rule == (ring ? SDV_SMOOTH : SDV_CREASE);
    sdv_new_nest(maker, level, depth, first, faces, ring || dart,
                 dart || plain ? (sdv_rule)rule : SDV_CORNER);
}

// Turns the rough faces of nests into leaves.
static void sdv_find_nests(sdv_exact_maker *maker, sdv_level *level, int depth)
{
    sdv_context *context = maker->writer->context;
    sdv_arena scratch = sdv_scratch();
    unsigned char *seen = SDV_NEW(context, &scratch, unsigned char, level->face_vertex_count);
    signed char *rules = SDV_NEW(context, &scratch, signed char, level->vertex_count);
    if (!context->result) memset(seen, 0, (size_t)level->face_vertex_count);
    if (!context->result) memset(rules, -1, (size_t)level->vertex_count);
    for (int h = 0; h < level->face_vertex_count && !context->result; h++) {
        if (!level->rough[sdv_face_of(level, h)] || seen[h] ||
            sdv_fan_at(level, maker->surface->rules.loop, h) != SDV_FAN_ROUGH) continue;
        signed char *rule = &rules[level->face_vertices[h]];
        if (*rule < 0) *rule = (signed char)sdv_nest_rule(level, level->face_vertices[h]);
        sdv_find_nest(maker, level, depth, h, *rule, seen);
    }
    sdv_arena_free(&scratch);
}

// -------------------------------------------------------------------------------- >>leaves
// Preparing an exact surface, level by level.

// Do the leaves of this level fit, and the next level, with at most four children a face-vertex?
static void sdv_check_exact_size(sdv_context *context, const subdiv_surface *surface,
                                 const sdv_level *level)
{
    double most = 4.0 * level->face_vertex_count + 4.0 * level->vertex_count;
    if (most + surface->work_count > INT_MAX / 2 ||
        surface->exact->polynomial_count > INT_MAX / 8 - level->face_count)
        sdv_fail(context, SUBDIV_ERROR_TOO_LARGE, "the levels of this mesh make too many points");
}

// How many polynomials a patch has: one, or one for each place where its strips cross.
static int sdv_patch_parts(const sdv_strips *strips, const sdv_patch *patch)
{
    return patch->up ? strips[patch->along - 1].count * strips[patch->up - 1].count : 1;
}

// Finds the patches of a level and numbers their polynomials.
static void sdv_exact_patches(sdv_exact_maker *maker, int depth, sdv_level *level)
{
    sdv_exact *exact = maker->surface->exact;
    sdv_find_patches(maker->writer, level, &maker->surface->rules, &maker->patches);
    const sdv_strips *strips = (const sdv_strips *)sdv_items(&maker->writer->strips);
    sdv_patch *patches = (sdv_patch *)sdv_items(&maker->patches);
    for (; exact->patch_count < (int)maker->patches.count; exact->patch_count++) {
        sdv_patch *patch = &patches[exact->patch_count];
        patch->level = (unsigned char)depth;
        patch->polynomial = exact->polynomial_count;
        exact->polynomial_count += sdv_patch_parts(strips, patch);
    }
}

// Turns the patches and nests of a level into leaves, and makes the next level of the faces that
// are left, if there are any.
static void sdv_exact_level(sdv_exact_maker *maker, int depth, sdv_level *level, sdv_level *next,
                            sdv_arena *next_arena)
{
    subdiv_surface *surface = maker->surface;
    sdv_context *context = maker->writer->context;
    sdv_arena scratch = sdv_scratch();
    sdv_split split;
    int loop = surface->rules.loop, regular = level->face_size == (loop ? 3 : 4);
    sdv_check_exact_size(context, surface, level);
    sdv_exact_patches(maker, depth, level);
    if (regular && !context->result) sdv_find_nests(maker, level, depth);
    surface->work_count = level->first_point + level->vertex_count;
    next->face_count = 0;
    if (context->result || !memchr(level->rough, 1, (size_t)level->face_count)) return;
    SUBDIV_ASSERT(depth + 1 < SDV_EXACT_LEVELS);
    sdv_split_step(maker->writer, &surface->rules, level, &split, next,
                   &surface->refine[2 * depth], next_arena, &scratch);
    sdv_arena_free(&scratch);
}

// Hands the block of a growing array to an arena, at the size that it has, and returns its items.
static void *sdv_adopt(sdv_arena *arena, sdv_array *array)
{
    void *items = sdv_items(array);
    if (items) array->block->next = arena->blocks;
    if (items) arena->blocks = array->block;
    array->block = NULL;
    return items;
}

// Keeps what has been made, at its size.
static void sdv_keep_exact(sdv_context *context, sdv_exact_maker *maker)
{
    subdiv_surface *surface = maker->surface;
    sdv_exact *exact = surface->exact;
    sdv_arena *arena = &surface->arena;
    exact->patches = (sdv_patch *)sdv_adopt(&surface->points, &maker->patches);
    exact->kind_count = (int)maker->kinds.count;
    exact->nest_count = (int)maker->nests.count;
    exact->nest_point_count = (int)maker->nest_points.count;
    exact->nest_face_count = (int)maker->nest_faces.count;
    exact->kinds = SDV_KEEP(context, arena, sdv_nest_kind, &maker->kinds);
    exact->nests = SDV_KEEP(context, arena, sdv_nest, &maker->nests);
    exact->nest_points = SDV_KEEP(context, arena, int, &maker->nest_points);
    exact->nest_faces = SDV_KEEP(context, arena, sdv_nest_face, &maker->nest_faces);
    exact->strips = SDV_KEEP(context, arena, sdv_strips, &maker->writer->strips);
    for (int i = 0; i < exact->kind_count && !context->result; i++)
        if (exact->kinds[i].work_count > exact->most_work)
            exact->most_work = exact->kinds[i].work_count;
}

// -------------------------------------------------------------------------------- >>locations
// Where a location is on a leaf, and which polynomial of the leaf is there.

// Goes down to the child of a face that has (x, y), and returns its number. A middle triangle is
// turned by half, and the scale changes its sign.
SDV_INLINE int sdv_descend(int loop, double *x, double *y, double *scale)
{
    int right = *x >= 0.5, up = *y >= 0.5, child = right ^ (up * 3);
    if (loop && !right && !up && *x + *y >= 0.5) {
        *x = 1 - 2 * *x;
        *y = 1 - 2 * *y;
        *scale *= -2;
        return 3;
    }
    if (loop) child = right ? 1 : 2 * up;
    if (loop) up = child == 2;
    *x = 2 * *x - right;
    *y = 2 * *y - up;
    *scale *= 2;
    return child;
}

// A place (u, v) of a face is at (x, y) as seen from its vertex number turn:
//
//     x = t[4] + t[0] u + t[1] v          y = t[5] + t[2] u + t[3] v
static const signed char sdv_turns[2][4][6] = {
    { {1, 0, 0, 1, 0, 0}, {0, 1, -1, 0, 0, 1}, {-1, 0, 0, -1, 1, 1}, {0, -1, 1, 0, 1, 0} },
    { {1, 0, 0, 1, 0, 0}, {0, 1, -1, -1, 0, 1}, {-1, -1, 1, 0, 1, 0}, {0, 0, 0, 0, 0, 0} } };

static void sdv_turn_place(int loop, int turn, double u, double v, double *x, double *y)
{
    const signed char *t = sdv_turns[loop][turn];
    *x = t[4] + t[0] * u + t[1] * v;
    *y = t[5] + t[2] * u + t[3] * v;
}

// The number of the first polynomial of a child of a nest's face.
SDV_INLINE size_t sdv_nest_polynomial_number(const sdv_exact *exact, int face, int depth,
                                             int child)
{
    return (size_t)exact->polynomial_count +
           3 * ((size_t)depth * (size_t)exact->nest_face_count + (size_t)face) + (size_t)child - 1;
}

// The vertices of a grid: row, column.
static const int sdv_corners[2][5][2] = {
    { {0, 0}, {0, 1}, {1, 1}, {1, 0}, {0, 0} }, { {0, 0}, {0, 1}, {1, 0}, {0, 0}, {0, 0} } };

// The part of its face's grid that a leaf of the exact surface, or one of its polynomials, covers:
// a rectangle or, under Loop, the lower half of a square or, turned, the upper half.
typedef struct sdv_area {
    int     bits;                       // 2^bits units are a side of the grid: it is, in these,
    int64_t left, right, bottom, top;   // from left to right and from bottom to top
    int     step;                       // -1: turned
    double  sx, sy, x, y;               // coordinates of its polynomial: step (sx t - x),
} sdv_area;                             // where t is from 0 to 1 along a side of the grid

// The square (or triangle) whose vertex 0 is at (x, y).
SDV_INLINE sdv_area sdv_area_at(int bits, int64_t x, int64_t y, int step)
{
    int64_t left = step > 0 ? x : x - 1, bottom = step > 0 ? y : y - 1;
    double scale = (double)((int64_t)1 << bits);
    sdv_area area = { bits, left, left + 1, bottom, bottom + 1, step, scale, scale,
                      (double)x, (double)y };
    return area;
}

// The quarter of an area at its vertex i, or in Loop the middle one, number 3, which is turned.
SDV_INLINE sdv_area sdv_child_area(const sdv_area *area, int loop, int i)
{
    int middle = loop && i == 3, step = area->step, turned = step < 0;
    int right = middle ? 1 : sdv_corners[loop][i][1], up = middle ? 1 : sdv_corners[loop][i][0];
    return sdv_area_at(area->bits + 1, 2 * (area->left + turned) + step * right,
                       2 * (area->bottom + turned) + step * up, middle ? -step : step);
}

// The area of a face of a nest after so many levels, as seen from the vertex of the nest (child 0);
// or of one of its other children on the next level.
static sdv_area sdv_nest_area(int loop, int ngon, const sdv_nest_face *face, int depth, int child)
{
    const int *at = sdv_corners[loop][face->turn];
    const sdv_place *place = &face->place;
    sdv_area area = sdv_area_at(face->level - ngon, place->column, place->row, place->step);
    for (; depth > 0; depth--) area = sdv_child_area(&area, loop, face->turn);
    int middle = loop && child == 3, i = middle ? 3 : (child + face->turn) % (loop ? 3 : 4);
    if (child) return sdv_child_area(&area, loop, i);
    area.x += area.step * at[1];
    area.y += area.step * at[0];
    return area;
}

// A coordinate, clamped to [0, 1].
SDV_INLINE float sdv_on_face(float u)
{
    u = u > 0 ? u : 0;
    return u < 1 ? u : 1;
}

// The leaf that a location is on, and the polynomial of the leaf.
typedef struct sdv_leaf {
    const sdv_patch *patch;             // its leaf is a patch
    int    nest_face;                   // or a face of a nest, or -1: its face has no surface
    int    below_kept;                  // levels down in a nest, if that is below polynomials kept:
                                        // x, y are on that level, as seen from the vertex
    size_t polynomial;
    double x, y, sx, sy;                // of the coordinates on the face, times sx and sy
} sdv_leaf;

// Finds the strip that a coordinate is on, and turns it into the coordinate on the strip's segment.
SDV_INLINE int sdv_find_strip(const sdv_strips *strips, double *x, double *scale)
{
    const double whole = 1 << SDV_STRIP_LEVELS;
    int i = 0;
    while (i + 1 < strips->count && *x * whole >= strips->items[i].to) i++;
    *x = (*x * whole - strips->items[i].origin) / strips->items[i].unit;
    *scale *= whole / strips->items[i].unit;
    return i;
}

// Finds the part of a patch, cut into strips, that a location is on.
static void sdv_find_part(const subdiv_surface *surface, sdv_leaf *leaf)
{
    const sdv_strips *along = &surface->exact->strips[leaf->patch->along - 1];
    int row = sdv_find_strip(&surface->exact->strips[leaf->patch->up - 1], &leaf->y, &leaf->sy);
    int column = sdv_find_strip(along, &leaf->x, &leaf->sx);
    leaf->polynomial += (size_t)(row * along->count + column);
}

// Finds a place on a face of a nest as seen from the vertex.
static void sdv_nest_place(int loop, int turn, double u, double v, double *x, double *y)
{
    sdv_turn_place(loop, turn, u, v, x, y);
    if (*x < 0) *x = 0;
    if (*y < 0) *y = 0;
}

// Returns on how many levels down (x, y), as seen from the vertex, still is in the nest. The vertex
// is on all levels, of which any will do.
static int sdv_nest_levels(int loop, double x, double y)
{
    int down;
    if (x <= 0 && y <= 0) return SDV_NEST_DEPTH;
    frexp(loop ? x + y : x > y ? x : y, &down);
    return down > 0 ? 0 : -down;
}

// Finds the child that a location on a face of a nest is on, on the level that has it, as seen from
// the vertex. The place on the child is as seen from the face again.
static void sdv_find_in_nest(const sdv_exact *exact, int loop, sdv_leaf *leaf)
{
    int turn = exact->nest_faces[leaf->nest_face].turn, depth = 0;
    double x, y, scale = leaf->sx;
    sdv_turn_place(loop, turn, leaf->x, leaf->y, &x, &y);
    while ((loop ? x + y : x > y ? x : y) < 0.5) {
        if (++depth == SDV_NEST_DEPTH) {
            sdv_nest_place(loop, turn, leaf->x, leaf->y, &x, &y);
            leaf->below_kept = sdv_nest_levels(loop, x, y);
            leaf->x = ldexp(x, leaf->below_kept);
            leaf->y = ldexp(y, leaf->below_kept);
            return;
        }
        x *= 2;
        y *= 2;
        scale *= 2;
    }
    int child = sdv_descend(loop, &x, &y, &scale);
    sdv_turn_place(loop, turn ? (loop ? 3 : 4) - turn : 0, x, y, &leaf->x, &leaf->y);
    leaf->sx = leaf->sy = scale;
    leaf->polynomial = sdv_nest_polynomial_number(exact, leaf->nest_face, depth, child);
}

// Finds the polynomial of a leaf that a location is on.
static void sdv_find_polynomial(const subdiv_surface *surface, sdv_leaf *leaf)
{
    if (leaf->patch && leaf->patch->up) sdv_find_part(surface, leaf);
    if (leaf->nest_face >= 0) sdv_find_in_nest(surface->exact, surface->rules.loop, leaf);
}

// ------------------------------------------------------------------------------------ >>cells
// Cells find the polynomial of a location in two steps for almost all of them, as a walk down from
// level to level has its branches mispredicted. Each face, or quad of an n-gon, is one cell or, if
// it has more than one polynomial, a grid of 16 cells, each of which may be a grid again.
//
//     +--+--+--+--+     A cell is a number: 2 first + 1 of a grid whose cells are those from first
//     |  |  |  |  |     on. Or it has the number of the polynomial that is all over it, and which
//     +--+--+--+--+     part of the face that covers: one in 2^across columns and 2^up rows (they
//     |  |  |  |  |     differ where strips cross); in Loop whether it is a turned triangle. Or it
//     +--+--+--+--+     has the number of a leaf: if it is smaller than the cells of the second
//     |  |  |  |  |     grid, or is as small and has more than one polynomial.
//     +--+--+--+--+
//     |  |  |  |  |     Loop: the triangle below the diagonal of a square has the square's number,
//     +--+--+--+--+     the one above that of the opposite square (15 less it), behind the long
//                       side, where there is no triangle.

enum { SDV_CELL_LEVELS = 4 };           // of two grids
#define SDV_CELL_BITS 8                 // of what is not the polynomial's number
#define SDV_CELL_LEAF 0xe0000000u       // this plus 2 i: the cell has leaf number i
#define SDV_CELL_NONE 0xfffffffeu       // the face has no surface
#define SDV_CELL_FAR 1u                 // what a look-up of many locations has no polynomial for

// How many polynomials a cell can number; locations on later ones are looked up by their leaves.
// (Tests ask for fewer.)
#ifndef SDV_CELL_POLYNOMIALS
#define SDV_CELL_POLYNOMIALS (SDV_CELL_LEAF >> SDV_CELL_BITS)
#endif

// The cells of a grid that the children of its face's children have, child by child.
static const unsigned char sdv_grid_cells[2][16] = {
    { 0, 1, 5, 4, 2, 3, 7, 6, 10, 11, 15, 14, 8, 9, 13, 12 },
    { 0, 1, 4, 15, 2, 3, 6, 13, 8, 9, 12, 7, 10, 11, 14, 5 } };

typedef struct sdv_cell_maker {
    sdv_context *context;
    const subdiv_surface *surface;
    sdv_array cells;
    size_t    root;                     // the cell of the whole face that the leaf at hand is on,
    unsigned  leaf;                     // and the cell of the leaf
} sdv_cell_maker;

// The cell of the face, or of the quad of an n-gon, that has the grid of face-vertex h.
SDV_INLINE int sdv_root_cell(const sdv_level *cage, int loop, int h)
{
    return cage->face_size == (loop ? 3 : 4) ? sdv_face_of(cage, h) : h;
}

// Returns which cell of a grid has an area; the grid is that of a face so many levels up.
static size_t sdv_cell_in_grid(const sdv_area *area, int loop, int levels)
{
    int shift = levels - 2, rest = (1 << shift) - 1;
    int x = (int)area->left, y = (int)area->bottom, i = (y >> shift & 3) << 2 | (x >> shift & 3);
    return (size_t)(loop && (x & rest) + (y & rest) + (area->step < 0) > rest ? 15 - i : i);
}

// The first cell of the grid that cell number i is, or becomes.
static size_t sdv_open_grid(sdv_cell_maker *maker, size_t i)
{
    size_t first = maker->cells.count;
    if (maker->context->result) return 0;
    unsigned cell = ((unsigned *)sdv_items(&maker->cells))[i];
    if (cell & 1) return cell / 2;
    if (first >= SDV_CELL_LEAF / 2)
        sdv_fail(maker->context, SUBDIV_ERROR_TOO_LARGE, "this mesh has too many faces");
    if (!sdv_append(maker->context, &maker->cells, 16, sizeof cell)) return 0;
    ((unsigned *)sdv_items(&maker->cells))[i] = 2 * (unsigned)first + 1;
    return first;
}

// Sets the cell of an area, in a grid for every two levels; after an odd number of levels it has
// four cells.
static void sdv_set_cell(sdv_cell_maker *maker, const sdv_area *area, unsigned cell)
{
    int loop = maker->surface->rules.loop, levels = area->bits;
    size_t i = maker->root, first;
    for (; levels > 1; levels -= 2)
        i = sdv_open_grid(maker, i) + sdv_cell_in_grid(area, loop, levels);
    first = levels ? sdv_open_grid(maker, i) : i;
    if (maker->context->result) return;
    unsigned *cells = (unsigned *)sdv_items(&maker->cells);
    if (levels == 0) cells[i] = cell;
    for (int k = 0; k < 4 && levels; k++) {
        sdv_area part = sdv_child_area(area, loop, k);
        cells[first + sdv_cell_in_grid(&part, loop, 2)] = cell;
    }
}

// Sets the cell of an area with one polynomial, or leaves it to its leaf. From the lowest bit on:
// 0, as it is no grid; 3 bits across; 3 up; turned; the number.
static void sdv_set_polynomial(sdv_cell_maker *maker, const sdv_area *area, size_t polynomial,
                               int across, int up)
{
    unsigned cell = (unsigned)polynomial << SDV_CELL_BITS | (unsigned)(area->step < 0) << 7 |
                    (unsigned)up << 4 | (unsigned)across << 1;
    sdv_set_cell(maker, area, polynomial < SDV_CELL_POLYNOMIALS ? cell : maker->leaf);
}

// The strip that reaches from one segment to another, or -1.
static int sdv_strip_over(const sdv_strips *strips, int from, int to)
{
    for (int i = 0; i < strips->count; i++)
        if (strips->items[i].from <= from && to <= strips->items[i].to) return i;
    return -1;
}

// Sets the cells of an area on a patch, of a level, that is cut into strips: a single cell if one
// part of the patch covers the area.
static void sdv_set_cut(sdv_cell_maker *maker, const sdv_area *area, const sdv_patch *patch,
                        int level)
{
    const sdv_strips *along = &maker->surface->exact->strips[patch->along - 1];
    const sdv_strips *up = &maker->surface->exact->strips[patch->up - 1];
    int parts = 1 << (area->bits - level), size = (1 << SDV_STRIP_LEVELS) / parts;
    int x = (int)(area->left % parts) * size, y = (int)(area->bottom % parts) * size;
    int i = sdv_strip_over(along, x, x + size), j = sdv_strip_over(up, y, y + size);
    if (i >= 0 && j >= 0) {
        int columns = level, rows = level;
        for (int n = 1 << SDV_STRIP_LEVELS; n > along->items[i].unit; n /= 2) columns++;
        for (int n = 1 << SDV_STRIP_LEVELS; n > up->items[j].unit; n /= 2) rows++;
        size_t polynomial = (size_t)patch->polynomial + (size_t)(j * along->count + i);
        sdv_set_polynomial(maker, area, polynomial, columns, rows);
        return;
    }
    for (int k = 0; k < 4 && area->bits < SDV_CELL_LEVELS; k++) {
        sdv_area part = sdv_child_area(area, 0, k);
        sdv_set_cut(maker, &part, patch, level);
    }
    if (area->bits == SDV_CELL_LEVELS) sdv_set_cell(maker, area, maker->leaf);
}

static void sdv_set_patch(sdv_cell_maker *maker, const sdv_patch *patch, int ngon)
{
    int level = patch->level - ngon;
    sdv_area area = sdv_area_at(level, patch->column, patch->row, patch->step);
    if (level > SDV_CELL_LEVELS) sdv_set_cell(maker, &area, maker->leaf);
    else if (patch->up) sdv_set_cut(maker, &area, patch, level);
    else sdv_set_polynomial(maker, &area, (size_t)patch->polynomial, level, level);
}

// Sets the cells of a nest's face: level by level those of the children that are patches.
static void sdv_set_nest_face(sdv_cell_maker *maker, int i, int ngon)
{
    const sdv_exact *exact = maker->surface->exact;
    const sdv_nest_face *face = &exact->nest_faces[i];
    int loop = maker->surface->rules.loop, sides = loop ? 3 : 4;
    sdv_area area = sdv_area_at(face->level - ngon, face->place.column, face->place.row,
                                face->place.step);
    for (int depth = 0; area.bits < SDV_CELL_LEVELS && depth < SDV_NEST_DEPTH; depth++) {
        for (int child = 1; child < 4; child++) {
            int at = loop && child == 3 ? 3 : (child + face->turn) % sides;
            sdv_area part = sdv_child_area(&area, loop, at);
            sdv_set_polynomial(maker, &part, sdv_nest_polynomial_number(exact, i, depth, child),
                               part.bits, part.bits);
        }
        area = sdv_child_area(&area, loop, face->turn);
    }
    sdv_set_cell(maker, &area, maker->leaf);
}

// Sets the cells of all leaves, whose numbers are those of patches, then those of nests' faces.
static void sdv_set_leaves(sdv_cell_maker *maker)
{
    const sdv_level *cage = &maker->surface->order.cage;
    const sdv_exact *exact = maker->surface->exact;
    int loop = maker->surface->rules.loop, patches = exact->patch_count;
    maker->leaf = SDV_CELL_LEAF;
    for (int i = 0; i < patches + exact->nest_face_count && !maker->context->result; i++) {
        int h = i < patches ? exact->patches[i].h : exact->nest_faces[i - patches].place.h;
        int ngon = sdv_is_ngon(&maker->surface->order, sdv_face_of(cage, h));
        maker->root = (size_t)sdv_root_cell(cage, loop, h);
        if (i < patches) sdv_set_patch(maker, &exact->patches[i], ngon);
        else sdv_set_nest_face(maker, i - patches, ngon);
        maker->leaf += 2;
    }
}

// Finds the holes and the homes of vertices and edges: the first face there that is no hole, or
// else the first hole that has a surface. hole: of the user's faces.
static void sdv_find_homes(sdv_context *context, subdiv_surface *surface, const unsigned char *hole)
{
    const sdv_level *cage = &surface->order.cage;
    sdv_exact *exact = surface->exact;
    int homes = cage->vertex_count + cage->edge_count;
    int *home = exact->home = SDV_NEW(context, &surface->arena, int, homes);
    exact->hole = SDV_NEW(context, &surface->arena, unsigned char, cage->face_count);
    if (context->result) return;
    for (int f = 0; f < surface->face_count; f++) {
        int own = surface->own_face ? surface->own_face[f] : f;
        if (own >= 0) exact->hole[own] = hole[f];
    }
    for (int i = 0; i < homes; i++) home[i] = -1;
    for (int kind = 1; kind >= 0; kind--)
        for (int h = cage->face_vertex_count - 1; h >= 0; h--) {
            if (exact->hole[sdv_face_of(cage, h)] != kind) continue;
            home[cage->face_vertices[h]] = home[cage->vertex_count + cage->face_edges[h]] = h;
        }
}

// Makes the cells of all faces, and one more for faces without values, which have no surface, just
// as those that boundary "none" drops.
static void sdv_make_cells(sdv_context *context, subdiv_surface *surface)
{
    const sdv_level *cage = &surface->order.cage;
    sdv_exact *exact = surface->exact;
    sdv_cell_maker maker = { context, surface, { NULL, 0, 0 }, 0, 0 };
    int loop = surface->rules.loop, roots = cage->face_vertex_count + 1;
    unsigned *cells = (unsigned *)sdv_append(context, &maker.cells, (size_t)roots, sizeof *cells);
    for (int i = 0; i < roots && cells; i++) cells[i] = SDV_CELL_NONE;
    sdv_set_leaves(&maker);
    exact->cells = SDV_KEEP(context, &surface->arena, unsigned, &maker.cells);
    for (int h = 0; h < cage->face_vertex_count && !context->result; h++)
        if (exact->hole[sdv_face_of(cage, h)] == SDV_DROPPED)
            exact->cells[sdv_root_cell(cage, loop, h)] = SDV_CELL_NONE;
}

// The cell of a face, or of the quad at its corner; *odd: there is no such corner.
SDV_INLINE int sdv_first_cell(const subdiv_surface *surface, int loop, int f, int corner,
                              unsigned *odd)
{
    const sdv_level *cage = &surface->order.cage;
    int size = loop ? 3 : 4, corners = 1, first;
    if (surface->own_face) f = surface->own_face[f];
    if (f < 0) {
        *odd |= corner < 0;
        return cage->face_vertex_count;
    }
    first = cage->face_size == size ? f : sdv_face_start(cage, f);
    if (cage->face_size != size) corners = sdv_face_end(cage, f) - first;
    if (corners == size) corners = 1;
    *odd |= (unsigned)corner >= (unsigned)corners;
    return first + ((unsigned)corner < (unsigned)corners ? corner : 0);
}

// Fails unless location i is there.
static void sdv_check_location(sdv_context *context, const subdiv_surface *surface, int i,
                               subdiv_location at)
{
    const float under = -1e-6f, over = 1 + 1e-6f;
    int loop = surface->rules.loop;
    unsigned odd = 0;
    if (at.face < 0 || at.face >= surface->face_count) {
        sdv_fail(context, SUBDIV_ERROR_INDEX, "location %d: face %d does not exist (of %d)", i,
                 at.face, surface->face_count);
        return;
    }
    sdv_first_cell(surface, loop, at.face, at.corner, &odd);
    if (odd)
        sdv_fail(context, SUBDIV_ERROR_INDEX, "location %d: face %d has no corner %d", i, at.face,
                 at.corner);
    if (!(at.u >= under && at.v >= under && at.u <= over && at.v <= over) ||
        (loop && at.u + at.v > over))
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "location %d: u, v are not on the face", i);
}

static void sdv_check_locations(sdv_context *context, const subdiv_surface *surface, int count,
                                const subdiv_location *locations)
{
    for (int i = 0; i < count && !context->result; i++)
        sdv_check_location(context, surface, i, locations[i]);
}

// Locations are looked up in batches of so many, in loops without branches, which compilers
// vectorize.
enum { SDV_LOOKUP = 32 };

typedef struct sdv_lookup {
    int   face[SDV_LOOKUP], corner[SDV_LOOKUP];
    float u[SDV_LOOKUP], v[SDV_LOOKUP];
    float left[SDV_LOOKUP], bottom[SDV_LOOKUP];         // of their squares of the last level
    int   first[SDV_LOOKUP], second[SDV_LOOKUP];        // their numbers in the two grids
    float inside[SDV_LOOKUP];
    unsigned cells[SDV_LOOKUP];
    float x[SDV_LOOKUP], y[SDV_LOOKUP], sx[SDV_LOOKUP], sy[SDV_LOOKUP];     // see sdv_where
} sdv_lookup;

// Loads locations and clamps them to their faces. Do all faces exist, and was no location moved?
SDV_INLINE int sdv_load_locations(const subdiv_surface *surface, int loop,
                                  const subdiv_location *locations, int count, sdv_lookup *l)
{
    unsigned faces = (unsigned)surface->face_count, odd = 0;
    for (int k = 0; k < count; k++) {
        l->face[k] = locations[k].face;
        l->corner[k] = locations[k].corner;
        l->x[k] = locations[k].u;
        l->y[k] = locations[k].v;
    }
    for (int k = 0; k < count; k++) {
        float u = sdv_on_face(l->x[k]), v = sdv_on_face(l->y[k]);
        l->u[k] = u;
        l->v[k] = loop && !(v < 1 - u) ? 1 - u : v;
    }
    for (int k = 0; k < count; k++) {
        unsigned now[2], before[2];                     // bits, as these loops vectorize better
        memcpy(&now[0], &l->u[k], sizeof(float));
        memcpy(&now[1], &l->v[k], sizeof(float));
        memcpy(&before[0], &l->x[k], sizeof(float));
        memcpy(&before[1], &l->y[k], sizeof(float));
        odd |= (now[0] ^ before[0]) | (now[1] ^ before[1]);
        odd |= (unsigned)l->face[k] >= faces;
    }
    return !odd;
}

// Finds which square of the second grid each location is in, or which triangle above its diagonal.
// The upper two bits of x and y say which cell of the first grid that is in, and the lower two bits
// which cell of the second: 4 y + x or, in a triangle above the diagonal, 15 less that.
SDV_INLINE void sdv_find_squares(sdv_lookup *l, int count, int loop)
{
    const int side = 1 << SDV_CELL_LEVELS;
    for (int k = 0; k < count; k++) {
        float u = l->u[k] * (float)side, v = l->v[k] * (float)side;
        int x = (int)u, y = (int)v, above = 0, most = side - 1;
        y -= y >> SDV_CELL_LEVELS;                      // 1 is in the last one
        if (loop) most -= y;
        x = x < most ? x : most;
        if (loop) above = (u - (float)x + (v - (float)y) >= 1) & (x < most);
        int first_above = loop & ((x & 3) + (y & 3) + above > 3);
        l->left[k] = (float)x;
        l->bottom[k] = (float)y;
        l->first[k] = ((y & 12) | x >> 2) ^ (-first_above & 15);
        l->second[k] = ((y & 3) << 2 | (x & 3)) ^ (-above & 15);
    }
}

// Replaces faces by their first cells. Are all corners there?
SDV_INLINE int sdv_find_roots(const subdiv_surface *surface, int loop, int count, sdv_lookup *l)
{
    unsigned odd = 0;
    if (!surface->own_face && surface->order.cage.face_size == (loop ? 3 : 4))
        for (int k = 0; k < count; k++) odd |= (unsigned)l->corner[k];
    else
        for (int k = 0; k < count; k++)
            l->face[k] = sdv_first_cell(surface, loop, l->face[k], l->corner[k], &odd);
    return !odd;
}

// How close to a vertex coordinates along edges are not rounded, as points there may move faster.
#define SDV_CLOSE 0.001f

// Returns 0 or less if a place on a face is on an edge. On the long side of a triangle, u may be
// 1 - v after rounding.
SDV_INLINE float sdv_edge_gap(int loop, float u, float v)
{
    float low = u < v ? u : v, high = u < v ? v : u, gap = 1 - high;
    float rounded = 1 - low - high + (low > SDV_CLOSE ? 0.0f : 1.0f);
    if (loop) gap -= low;
    if (loop) gap = rounded < gap ? rounded : gap;
    return low < gap ? low : gap;
}

// Finds the polynomials of locations. Those on edges, which several faces have, are left out.
SDV_INLINE void sdv_find_cells(const subdiv_surface *surface, int loop, int count, sdv_lookup *l)
{
    const unsigned *cells = surface->exact->cells;
    for (int k = 0; k < count; k++) l->inside[k] = sdv_edge_gap(loop, l->u[k], l->v[k]);
    for (int k = 0; k < count; k++) {
        unsigned cell = cells[l->face[k]], grid = 0u - (cell & 1);
        cell = (cell & ~grid) | (cells[((cell >> 1) + (unsigned)l->first[k]) & grid] & grid);
        if (cell & 1) {                                                     // hardly ever
            cell = cells[(cell >> 1) + (unsigned)l->second[k]];
            if (cell & 1) cell = SDV_CELL_NONE;
        }
        l->cells[k] = cell < SDV_CELL_LEAF && l->inside[k] > 0 ? cell : SDV_CELL_FAR;
    }
}

// Finds where locations are on what their polynomials cover, by its scales 2^across and 2^up, whose
// bits are put together.
SDV_INLINE void sdv_find_places(sdv_lookup *l, int count, int loop)
{
    const float unit = 1.0f / (1 << SDV_CELL_LEVELS);
    for (int k = 0; k < count; k++) {
        uint32_t across = ((l->cells[k] >> 1 & 7) + 127) << 23;
        uint32_t up = loop ? across : ((l->cells[k] >> 4 & 7) + 127) << 23;
        memcpy(&l->sx[k], &across, sizeof across);
        memcpy(&l->sy[k], &up, sizeof up);
    }
    for (int k = 0; k < count; k++) {
        float sx = l->sx[k], sy = l->sy[k];
        float x = l->u[k] * sx - (float)(int)(l->left[k] * sx * unit);
        float y = l->v[k] * sy - (float)(int)(l->bottom[k] * sy * unit);
        float turned = (float)(int)(l->cells[k] >> 7 & 1), sign = 1 - 2 * turned;
        l->x[k] = loop ? sign * (x - turned) : x;
        l->y[k] = loop ? sign * (y - turned) : y;
        l->sx[k] = loop ? sign * sx : sx;
        l->sy[k] = loop ? sign * sy : sy;
    }
}

// Looks up the cells of locations and where they are on those. Returns 0 if a location does not
// exist.
SDV_INLINE int sdv_look_up(const subdiv_surface *surface, int loop,
                           const subdiv_location *locations, int count, sdv_lookup *l)
{
    sdv_context here = { SUBDIV_OK, NULL, NULL, NULL };
    if (!sdv_load_locations(surface, loop, locations, count, l))
        sdv_check_locations(&here, surface, count, locations);
    if (here.result) return 0;
    sdv_find_squares(l, count, loop);
    int found = sdv_find_roots(surface, loop, count, l);
    sdv_find_cells(surface, loop, count, l);
    sdv_find_places(l, count, loop);
    return found;
}

// Returns the patch that has a polynomial.
static const sdv_patch *sdv_find_patch(const sdv_exact *exact, int polynomial)
{
    int i = 0;
    for (int end = exact->patch_count; i + 1 < end; ) {
        int middle = i + (end - i) / 2;
        if (exact->patches[middle].polynomial <= polynomial) i = middle;
        else end = middle;
    }
    return &exact->patches[i];
}

// Sets the leaf of a cell, by the leaf's number or the polynomial's. Returns the leaf's level.
static int sdv_leaf_of_cell(const subdiv_surface *surface, unsigned cell, sdv_leaf *leaf)
{
    const sdv_exact *exact = surface->exact;
    int is_leaf = cell >= SDV_CELL_LEAF;
    int number = (int)(is_leaf ? (cell - SDV_CELL_LEAF) / 2 : cell >> SDV_CELL_BITS);
    int kept = number - exact->polynomial_count;
    if (is_leaf && number >= exact->patch_count) leaf->nest_face = number - exact->patch_count;
    else if (!is_leaf && kept >= 0) leaf->nest_face = kept / 3 % exact->nest_face_count;
    if (leaf->nest_face >= 0) return exact->nest_faces[leaf->nest_face].level;
    leaf->patch = is_leaf ? &exact->patches[number] : sdv_find_patch(exact, number);
    leaf->polynomial = (size_t)leaf->patch->polynomial;
    return leaf->patch->level;
}

// A place on a face of the cage, or on the quad of an n-gon.
typedef struct sdv_spot {
    int    grid;                        // its face-vertex, of other faces the first one; -1: a
                                        // face without values
    double u, v;
} sdv_spot;

static sdv_spot sdv_spot_of(const subdiv_surface *surface, const subdiv_location *at)
{
    int f = surface->own_face ? surface->own_face[at->face] : at->face;
    double u = (double)sdv_on_face(at->u), v = (double)sdv_on_face(at->v);
    sdv_spot spot = { -1, u, surface->rules.loop && u + v > 1 ? 1 - u : v };
    if (f >= 0) spot.grid = sdv_face_start(&surface->order.cage, f) + at->corner;
    return spot;
}

// The cell of the whole face, or quad, that a place is on.
static unsigned sdv_first_cell_of(const subdiv_surface *surface, const sdv_spot *spot)
{
    int loop = surface->rules.loop;
    return spot->grid < 0 ? SDV_CELL_NONE :
           surface->exact->cells[sdv_root_cell(&surface->order.cage, loop, spot->grid)];
}

// Rounds a coordinate along an edge as 1 - t does, by which it is seen from the other end.
static double sdv_snap(double t)
{
    return t < 0.5 && t > (double)SDV_CLOSE ? 1 - (double)(float)(1 - t) : t;
}

// The place on the edge that leads on from h, after t of it.
static sdv_spot sdv_spot_on_edge(const sdv_order *order, int h, double t)
{
    int f = sdv_face_of(&order->cage, h), ngon = sdv_is_ngon(order, f), sides = order->loop ? 3 : 4;
    int start = sdv_face_start(&order->cage, f), turn = h - start, at_end = ngon && t > 0.5;
    sdv_spot spot = { ngon ? h : start, at_end ? 0 : 2 * t, at_end ? 2 - 2 * t : 0 };
    if (at_end) spot.grid = sdv_next(&order->cage, h);
    if (!ngon) sdv_turn_place(order->loop, turn ? sides - turn : 0, t, 0, &spot.u, &spot.v);
    return spot;
}

// The place after t of the edge of h, on the face that evaluates it for all.
static sdv_spot sdv_home_on_edge(const subdiv_surface *surface, int h, double t)
{
    const sdv_order *order = &surface->order;
    const sdv_level *cage = &order->cage;
    const int *home = surface->exact->home, *vertices = cage->face_vertices;
    int ends[2] = { vertices[h], vertices[sdv_next(cage, h)] };
    int k = ends[0] == ends[1] ? h : home[cage->vertex_count + cage->face_edges[h]];
    if (t <= 0 || t >= 1) return sdv_spot_on_edge(order, home[ends[t > 0]], 0);
    return sdv_spot_on_edge(order, k, vertices[k] == ends[0] ? t : 1 - t);
}

// Finds where a place on an edge, or on a spoke of an n-gon, is evaluated: on the first face that
// has it, or the first quad. Returns 0 for a place inside a face.
static int sdv_find_home(const subdiv_surface *surface, const sdv_spot *at, sdv_spot *home)
{
    const sdv_level *cage = &surface->order.cage;
    int loop = surface->rules.loop, h = at->grid;
    float u = (float)at->u, v = (float)at->v;
    if (sdv_edge_gap(loop, u, v) > 0 || sdv_first_cell_of(surface, at) == SDV_CELL_NONE) return 0;
    int side = v <= 0 ? 0 : u <= 0 && v < 1 ? 3 : loop || u >= 1 ? 1 : 2;
    int ngon = !loop && sdv_size_of(cage, h) != 4;
    double t = side % 2 ? at->v : at->u;            // on sides 2 and 3 from the end
    if (!ngon) h += side - (loop && side == 3);
    else if (side >= 2) h = sdv_previous(cage, h);
    if (ngon && (side == 1 || side == 2)) {
        sdv_spot spoke = { h, 1, sdv_snap(t) };
        if (spoke.v >= 1) spoke.grid = sdv_face_start(cage, sdv_face_of(cage, h));  // the centre
        *home = spoke.v > 0 ? spoke : sdv_home_on_edge(surface, h, 0.5);
        return 1;
    }
    t = sdv_snap(ngon ? t / 2 : t);
    *home = sdv_home_on_edge(surface, h, side < 2 ? t : 1 - t);
    return 1;
}

// Finds the leaf of a place: down to its cell, then once more as far down as the leaf is.
static sdv_leaf sdv_locate(const subdiv_surface *surface, const sdv_spot *at)
{
    int loop = surface->rules.loop;
    unsigned cell = sdv_first_cell_of(surface, at);
    sdv_leaf leaf;
    memset(&leaf, 0, sizeof leaf);
    leaf.nest_face = -1;
    if (cell == SDV_CELL_NONE) return leaf;
    for (double x = at->u, y = at->v, scale = 1; cell & 1; ) {
        int child = sdv_descend(loop, &x, &y, &scale);
        child = 4 * child + sdv_descend(loop, &x, &y, &scale);
        cell = surface->exact->cells[(cell >> 1) + sdv_grid_cells[loop][child]];
    }
    int level = sdv_leaf_of_cell(surface, cell, &leaf);
    level -= !loop && sdv_size_of(&surface->order.cage, at->grid) != 4;
    leaf.x = at->u;
    leaf.y = at->v;
    leaf.sx = 1;
    for (int i = 0; i < level; i++) sdv_descend(loop, &leaf.x, &leaf.y, &leaf.sx);
    leaf.sy = leaf.sx;
    return leaf;
}

static void sdv_new_exact(sdv_context *context, subdiv_surface *surface)
{
    sdv_exact *exact = SDV_NEW(context, &surface->arena, sdv_exact, 1);
    surface->levels = SDV_EXACT_LEVELS;
    surface->refine = SDV_NEW(context, &surface->points, sdv_batches, 2 * SDV_EXACT_LEVELS);
    if (context->result) return;
    memset(exact, 0, sizeof *exact);
    memset(surface->refine, 0, 2 * SDV_EXACT_LEVELS * sizeof *surface->refine);
    surface->exact = exact;
}

static void sdv_prepare_exact(sdv_context *context, subdiv_surface *surface, sdv_level *cage,
                              const unsigned char *hole, sdv_arena *arena)
{
    sdv_arena next_arena = sdv_scratch();
    sdv_level level = *cage, next = level;
    sdv_writer writer;
    sdv_exact_maker maker;
    memset(&maker, 0, sizeof maker);
    sdv_writer_new(context, &surface->points, cage, &writer);
    maker.writer = &writer;
    maker.surface = surface;
    if (!context->result) {
        memset(level.core, 1, (size_t)level.face_count);
        surface->work_count = level.vertex_count;
    }
    for (int i = 0; level.face_count && !context->result; i++) {
        sdv_exact_level(&maker, i, &level, &next, &next_arena);
        sdv_arena_free(arena);
        *arena = next_arena;
        next_arena = sdv_scratch();
        level = next;
    }
    sdv_keep_exact(context, &maker);
    if (!context->result) sdv_find_homes(context, surface, hole);
    if (!context->result && !surface->borrows) sdv_make_cells(context, surface);
    sdv_writer_free(&writer);
    sdv_arena_free(arena);
}

// --------------------------------------------------------------------------- >>polynomials
// Makes the polynomials of all leaves, with which an evaluation of the exact surface begins.

// A step of Horner's scheme, for a polynomial, its first derivative and half its second one.
SDV_INLINE void sdv_horner_step(sdv_four *p, sdv_four t, sdv_four next)
{
    p[2] = sdv_plus(sdv_times(p[2], t), p[1]);
    p[1] = sdv_plus(sdv_times(p[1], t), p[0]);
    p[0] = sdv_plus(sdv_times(p[0], t), next);
}

// Evaluates a polynomial and its derivatives, of degree 1 to 4, with coefficients c[0], c[step], ..
// Its first steps leave out what is 0; what is not asked for below, the compiler leaves out.
SDV_INLINE void sdv_horner(const sdv_four *c, int step, int degree, sdv_four t, sdv_four *p)
{
    sdv_four highest = c[degree * step];
    p[0] = sdv_plus(sdv_times(highest, t), c[(degree - 1) * step]);
    p[1] = highest;
    p[2] = sdv_all(0);
    if (degree == 1) return;
    p[2] = highest;
    p[1] = sdv_plus(sdv_times(highest, t), p[0]);
    p[0] = sdv_plus(sdv_times(p[0], t), c[(degree - 2) * step]);
    if (degree >= 3) sdv_horner_step(p, t, c[(degree - 3) * step]);
    if (degree == 4) sdv_horner_step(p, t, c[0]);
}

// A row of a surface, a polynomial in x alone, and its derivatives in x and y; or, turned, a
// column.
typedef struct sdv_curve {
    sdv_four a[5], along[4], across[4];
} sdv_curve;

// Makes the row at y = at or, turned, the column at x = at. c[i + n j] is the coefficient of x^i
// y^j, n = 4 or, under Loop, 5. loop, turned and tangents are constants: what is not asked for, the
// compiler leaves out.
SDV_INLINE void sdv_make_curve(const sdv_four *c, int loop, int turned, int tangents, float at,
                               sdv_curve *curve)
{
    int n = 4 + loop, step = turned ? 1 : n, next = turned ? n : 1;
    sdv_four p[5][3], t = sdv_all(at);
    sdv_horner(c, step, 3 + loop, t, p[0]);
    sdv_horner(c + next, step, 3, t, p[1]);
    sdv_horner(c + 2 * next, step, loop ? 1 : 3, t, p[2]);
    sdv_horner(c + 3 * next, step, loop ? 1 : 3, t, p[3]);
    p[4][0] = loop ? c[4 * next] : sdv_all(0);
    for (int i = 0; i < 5; i++) curve->a[i] = p[i][0];
    for (int i = 0; i < 4 && tangents; i++) {
        curve->along[i] = sdv_times(sdv_all((float)(i + 1)), p[i + 1][0]);
        curve->across[i] = p[i][1];
    }
}

// Finds the strips, along the rows and up the columns, that cross in a part of a patch.
static void sdv_find_strips_of(const sdv_strips *strips, const sdv_patch *patch, int part,
                               const sdv_strip *cross[2])
{
    int columns = strips[patch->along - 1].count;
    cross[0] = &strips[patch->along - 1].items[part % columns];
    cross[1] = &strips[patch->up - 1].items[part / columns];
}

// Mirrors a point over a sharp edge: p[to] = p[a] + p[b] - p[inside].
static void sdv_mirror(double (*p)[4], int to, int a, int b, int inside)
{
    for (int c = 0; c < 4; c++) p[to][c] = p[a][c] + p[b][c] - p[inside][c];
}

// Mirrors the control points of a quad over its sharp edges: first to the left and right in all
// rows that are known, then below and above.
static void sdv_mirror_quad(int sharp, double (*p)[4])
{
    for (int i = 0; i < 16 && sharp; i += 4) {
        if (sharp & 8) sdv_mirror(p, i, i + 1, i + 1, i + 2);
        if (sharp & 2) sdv_mirror(p, i + 3, i + 2, i + 2, i + 1);
    }
    for (int i = 0; i < 4 && sharp; i++) {
        if (sharp & 1) sdv_mirror(p, i, 4 + i, 4 + i, 8 + i);
        if (sharp & 4) sdv_mirror(p, 12 + i, 8 + i, 8 + i, 4 + i);
    }
}

// Mirrors the control points of a triangle. Around vertex v, counter-clockwise, stand r[0] and
// r[1], the other vertices of the face; r[2] across the edge before; r[3], r[4]; r[5] across the
// edge after.
static void sdv_mirror_triangle(const sdv_patch *patch, double (*p)[4])
{
    for (int i = 0; i < 3; i++) {
        const int *r = sdv_triangle_ring[i], v = sdv_triangle_own[i], fan = patch->fan[i];
        if (fan == SDV_FAN_RING) continue;
        if (patch->sharp >> i & 1) sdv_mirror(p, r[5], v, r[0], r[1]);
        if (patch->sharp >> (i + 2) % 3 & 1) sdv_mirror(p, r[2], v, r[1], r[0]);
        if (fan == SDV_FAN_FIRST) sdv_mirror(p, r[4], v, r[3], r[2]);
        if (fan == SDV_FAN_LAST) sdv_mirror(p, r[3], v, r[4], r[5]);
        if (fan == SDV_FAN_MIDDLE) sdv_mirror(p, r[3], v, r[2], r[1]);
        if (fan == SDV_FAN_MIDDLE) sdv_mirror(p, r[4], v, r[5], r[0]);
        if (fan == SDV_FAN_CORNER) sdv_mirror(p, r[3], v, v, r[0]);
        if (fan == SDV_FAN_CORNER) sdv_mirror(p, r[4], v, v, r[1]);
    }
}

// Replaces the points of a line by sums of them.
static void sdv_combine(double (*p)[4], int step, const double (*rows)[4])
{
    for (int c = 0; c < 4; c++) {
        double a[4] = { p[0][c], p[step][c], p[2 * step][c], p[3 * step][c] };
        for (int j = 0; j < 4; j++)
            p[j * step][c] = rows[j][0] * a[0] + rows[j][1] * a[1] + rows[j][2] * a[2] +
                             rows[j][3] * a[3];
    }
}

// Replaces the control points around a segment of a uniform cubic B-spline by the coefficients of
// the limit curve, from t = 0 to 1:
//
//     p1 + s / 6  +  (p2 - p0) / 2 t  +  s / 2 t^2  +  (p3 - 3 p2 + 3 p1 - p0) / 6 t^3
//     s = p0 - 2 p1 + p2
//
// Bilinear: p1 + (p2 - p1) t.
SDV_INLINE void sdv_cubic(double (*p)[4], int step, int linear)
{
    for (int c = 0; c < 4; c++) {
        double p0 = p[0][c], p1 = p[step][c], p2 = p[2 * step][c], p3 = p[3 * step][c];
        double d0 = p1 - p0, d1 = p2 - p1, d2 = p3 - p2, s = d1 - d0;
        p[0][c] = linear ? p1 : p1 + s * (1.0 / 6);
        p[step][c] = linear ? d1 : 0.5 * (d0 + d1);
        p[2 * step][c] = linear ? 0 : 0.5 * s;
        p[3 * step][c] = linear ? 0 : (d2 - d1 - s) * (1.0 / 6);
    }
}

// Replaces the control points of a quad by the coefficients of its polynomial.
SDV_INLINE void sdv_bicubic(double (*p)[4], int linear)
{
    for (int i = 0; i < 4; i++) sdv_cubic(p + i, 4, linear);
    for (int i = 0; i < 16; i += 4) sdv_cubic(p + i, 1, linear);
}

// The limit surface of a regular triangle is a quartic box spline [Stam98], a polynomial of its 12
// control points, numbered as in sdv_gather_triangle.
SDV_INLINE void sdv_box_spline(const double (*p)[4], double (*c)[4])
{
    for (int k = 0; k < 4; k++) {
        double p0 = p[0][k], p1 = p[1][k], p2 = p[2][k], p3 = p[3][k], p4 = p[4][k], p5 = p[5][k];
        double p6 = p[6][k], p7 = p[7][k], p8 = p[8][k], p9 = p[9][k], p11 = p[11][k];
        double x = p3 + p5, y = p0 + p8, z = p1 + p6, dx = p5 - p3, dy = p8 - p0, dz = p1 - p6;
        c[0][k] = (6 * p4 + x + y + z) * (1.0 / 12);
        c[1][k] = (2 * dx + dy + dz) * (1.0 / 6);
        c[2][k] = x * 0.5 - p4;
        c[3][k] = (p0 + p2 + p6 + p11 + 4 * p4 - 2 * (p1 + x + p8)) * (1.0 / 6);
        c[4][k] = (2 * dy + dx - dz) * (1.0 / 6);
        c[5][k] = (x + y - z) * 0.5 - p4;
        c[6][k] = (p6 + p11 - x) * 0.5 + p4 - p8;
        c[8][k] = y * 0.5 - p4;
        c[9][k] = (p1 + p11 - y) * 0.5 + p4 - p5;
        c[10][k] = (p1 + p3 + p9 + p11 + 4 * p4 - 2 * (p6 + p5 + y)) * (1.0 / 6);
        c[12][k] = (2 * (p5 + p6) + p0 + p[10][k] - (p1 + p3 + p4 + p8 + p9 + p11)) * (1.0 / 12);
        c[13][k] = (2 * (p1 + p8) + p3 + p7 - (p0 + p2 + p4 + p5 + p6 + p11)) * (1.0 / 12);
        c[7][k] = 2 * c[13][k];
        c[11][k] = 2 * c[12][k];
        c[14][k] = c[15][k] = 0;
    }
}

// Makes the coefficients of a linear triangle.
static void sdv_plane(const double (*p)[4], double (*c)[4])
{
    memset(c, 0, SDV_SLOTS * sizeof *c);
    for (int k = 0; k < 4; k++) {
        c[0][k] = p[4][k];
        c[1][k] = p[5][k] - p[4][k];
        c[4][k] = p[8][k] - p[4][k];
    }
}

// Loads the control points of a patch.
SDV_INLINE void sdv_load_points(const sdv_patch *patch, const double *work, int count,
                                double (*p)[4])
{
    for (int k = 0; k < count; k++)
        memcpy(p[k], work + 4 * (size_t)patch->points[k], 4 * sizeof *work);
}

// Makes the polynomial of a patch, or of a part of it: four channels of the coefficients of
// sdv_powers, from work points. The coordinates of a part are those of its strips' own segments. In
// doubles, as a part may be a thousandth of the patch.
static void sdv_make_polynomial(const subdiv_surface *surface, const sdv_patch *patch, int part,
                                const double *work, double (*c)[4])
{
    int linear = surface->rules.linear;
    double p[12][4];
    if (surface->rules.loop) {
        sdv_load_points(patch, work, 12, p);
        sdv_mirror_triangle(patch, p);
        if (linear) sdv_plane((const double (*)[4])p, c);
        else sdv_box_spline((const double (*)[4])p, c);
        return;
    }
    sdv_load_points(patch, work, 16, c);
    sdv_mirror_quad(patch->sharp, c);
    if (patch->up) {
        const sdv_strip *cross[2];
        sdv_find_strips_of(surface->exact->strips, patch, part, cross);
        for (int i = 0; i < 16; i += 4)
            sdv_combine(c + i, 1, (const double (*)[4])cross[0]->rows);
        for (int i = 0; i < 4; i++) sdv_combine(c + i, 4, (const double (*)[4])cross[1]->rows);
    }
    if (linear) sdv_bicubic(c, 1);
    else sdv_bicubic(c, 0);
}

// A nest's points, four channels at a time, as seen from its vertex: base + shrink w.
typedef struct sdv_nest_state {
    const subdiv_surface *surface;
    const sdv_nest_kind *kind;
    const int    *points;               // of the first level, among the work points
    const double *work;
    double *w;                          // [4 * work_count] its points, then those of the next level
    double  base[4], shrink;
} sdv_nest_state;

enum { SDV_NEST_STACK = 256 };          // work points; nests with more take memory

// Takes a nest, in which w has no points yet.
static void sdv_nest_begin(sdv_nest_state *s, const subdiv_surface *surface, int number,
                           const double *work, double *w)
{
    const sdv_nest *nest = &surface->exact->nests[number];
    s->surface = surface;
    s->kind = &surface->exact->kinds[nest->kind];
    s->points = surface->exact->nest_points + nest->first;
    s->work = work;
    s->w = w;
    s->shrink = 1;
}

static void sdv_nest_load(sdv_nest_state *s)
{
    memcpy(s->base, s->work + 4 * (size_t)s->points[0], sizeof s->base);
    for (int i = 0; i < s->kind->points; i++)
        for (int c = 0; c < 4; c++)
            s->w[4 * i + c] = s->work[4 * (size_t)s->points[i] + (size_t)c] - s->base[c];
}

// Makes the points of a nest's next level.
static void sdv_nest_refine(sdv_nest_state *s)
{
    for (int i = 0; i < 2; i++) sdv_make_exact_rows(&s->kind->refine[i], s->w, 0, 1);
}

// Goes on to the next level of a nest, whose points have been made.
static void sdv_nest_descend(sdv_nest_state *s)
{
    const sdv_nest_kind *kind = s->kind;
    double vertex[4];
    for (int c = 0; c < 4; c++) vertex[c] = s->w[4 * kind->below[0] + c];
    for (int c = 0; c < 4; c++) s->base[c] += s->shrink * vertex[c];
    for (int i = 0; i < kind->points; i++)
        for (int c = 0; c < 4; c++)
            s->w[4 * i + c] = 2 * (s->w[4 * kind->below[i] + c] - vertex[c]);
    s->shrink /= 2;
}

// The patch of a child of a nest's face, after a refinement.
static const sdv_patch *sdv_nest_patch(const sdv_nest_kind *kind, int face, int child, int turn)
{
    return &kind->patches[3 * (turn * kind->faces + face) + child - 1];
}

// The scratch memory of an evaluation. Work points are doubles, as points of a fine level differ in
// their last digits alone. kept has the base of each nest after its last polynomials, and its
// points as seen from the base.
typedef struct sdv_exact_memory {
    double *work;                       // [4 * work_count] for every four channels
    double *nest;                       // [4 * most_work]
    double *kept;                       // [4 * (nest_count + nest_point_count)] for every four
    const subdiv_surface **begun;       // the surface that all this was made for
    float  *polynomials;                // [SDV_SLOTS] each, channel by channel
} sdv_exact_memory;

enum { SDV_CACHE_LINE = 64 };

static size_t sdv_exact_kept_count(const sdv_exact *exact)
{
    return (size_t)exact->nest_count + (size_t)exact->nest_point_count;
}

static size_t sdv_exact_polynomial_count(const sdv_exact *exact)
{
    return (size_t)exact->polynomial_count + 3 * SDV_NEST_DEPTH * (size_t)exact->nest_face_count;
}

// Carves scratch memory from base, or NULL. Returns how many bytes that takes, with room for an
// alignment, and for loads of four floats that end behind the last polynomial.
static size_t sdv_carve_exact(const subdiv_surface *surface, int channels, char *base,
                              sdv_exact_memory *memory)
{
    const sdv_exact *exact = surface->exact;
    size_t size = 0, fours = ((size_t)channels + 3) / 4, line = SDV_CACHE_LINE;
    size_t polynomials = (size_t)channels * sdv_exact_polynomial_count(exact);
    if (base) base += (line - (uintptr_t)base % line) % line;
    memory->work = SDV_CARVE(double, NULL, 4 * fours, (size_t)surface->work_count);
    memory->nest = SDV_CARVE(double, NULL, 4, (size_t)exact->most_work);
    memory->kept = SDV_CARVE(double, NULL, 4 * fours, sdv_exact_kept_count(exact));
    memory->begun = SDV_CARVE(const subdiv_surface *, NULL, 1, 1);
    size = (size + line - 1) / line * line;
    memory->polynomials = SDV_CARVE(float, NULL, SDV_SLOTS * polynomials + 4, 1);
    return size + line;
}

static size_t sdv_exact_size(const subdiv_surface *surface, int channels)
{
    const sdv_exact *exact = surface->exact;
    sdv_exact_memory memory;
    double doubles = (double)surface->work_count + (double)sdv_exact_kept_count(exact) +
                     (double)exact->most_work;
    double floats = (double)SDV_SLOTS * (double)sdv_exact_polynomial_count(exact);
    if (!sdv_addressable(channels, sizeof(double) * doubles + sizeof(float) * floats))
        return SIZE_MAX;
    return sdv_carve_exact(surface, channels, NULL, &memory);
}

// Jobs of an evaluation.
typedef struct sdv_exact_evaluation {
    const subdiv_surface *surface;
    int channels;
    sdv_exact_memory memory;
    int jobs;
    int count;                          // locations, and where what is asked of each goes: value,
    const subdiv_location *locations;   // du, dv, duu, duv, dvv; or NULL
    float *out[6], *normals;
    size_t stride, normal_stride;
    int order;                          // of the highest derivative
    const struct sdv_exact_evaluation *parts;   // the same but for values alone, or without values
    unsigned char *failed;              // [jobs] which got no memory,
    unsigned char *refused;             // [jobs] which met a location that is not there
    void *user;                         // of the allocator
} sdv_exact_evaluation;

// Keeps the coefficients of so many channels of a polynomial: out [lanes * SDV_SLOTS]. nest: they
// are as seen from its vertex; or NULL.
static void sdv_keep_polynomial(const double *c, const sdv_nest_state *nest, int lanes, float *out)
{
    double shrink = nest ? nest->shrink : 1;
    float room[4 * SDV_SLOTS], *slots = lanes == 4 ? out : room;
    for (int i = 0; i < 4 * SDV_SLOTS; i++) slots[i] = (float)(shrink * c[i]);
    for (int l = 0; l < 4 && nest; l++) slots[l] = (float)(nest->base[l] + shrink * c[l]);
    for (int k = 0; k < SDV_SLOTS && lanes < 4; k++, out += lanes) {    // overwrites other lanes
        if (k + 4 <= SDV_SLOTS) sdv_store(out, sdv_load(slots + 4 * k));
        else sdv_store_some(out, sdv_load(slots + 4 * k), lanes);
    }
}

// Finds polynomial number i, from channel c on.
static float *sdv_polynomial_at(const sdv_exact_evaluation *e, size_t i, int c)
{
    return e->memory.polynomials + SDV_SLOTS * ((size_t)e->channels * i + (size_t)c);
}

// Finds the kept state of a nest, of channels from c on.
static double *sdv_kept_nest(const sdv_exact_evaluation *e, int number, int c)
{
    const sdv_exact *exact = e->surface->exact;
    return e->memory.kept + (size_t)c * sdv_exact_kept_count(exact) +
           4 * ((size_t)exact->nests[number].first + (size_t)number);
}

static int sdv_lanes_from(int channels, int c)
{
    return channels - c < 4 ? channels - c : 4;
}

// Makes the polynomials of a patch.
static void sdv_patch_polynomials(const sdv_exact_evaluation *e, const sdv_patch *patch)
{
    const subdiv_surface *surface = e->surface;
    int parts = sdv_patch_parts(surface->exact->strips, patch);
    double made[SDV_SLOTS][4];
    for (int c = 0; c < e->channels; c += 4)
        for (int k = 0; k < parts; k++) {
            sdv_make_polynomial(surface, patch, k,
                                e->memory.work + (size_t)c * (size_t)surface->work_count, made);
            sdv_keep_polynomial(made[0], NULL, sdv_lanes_from(e->channels, c),
                                sdv_polynomial_at(e, (size_t)patch->polynomial + (size_t)k, c));
        }
}

// Makes the polynomials of a nest: on each of SDV_NEST_DEPTH levels those of the three children of
// every face that are patches. w [4 * work_count].
static void sdv_nest_polynomials(const sdv_exact_evaluation *e, int number, double *w)
{
    const sdv_exact *exact = e->surface->exact;
    int first = exact->nests[number].face;
    double made[SDV_SLOTS][4];
    for (int c = 0; c < e->channels; c += 4) {
        sdv_nest_state s;
        sdv_nest_begin(&s, e->surface, number,
                       e->memory.work + (size_t)c * (size_t)e->surface->work_count, w);
        sdv_nest_load(&s);
        for (int depth = 0; depth < SDV_NEST_DEPTH; depth++) {
            sdv_nest_refine(&s);
            for (int i = 0; i < 3 * s.kind->faces; i++) {
                int face = i / 3, child = i % 3 + 1, turn = exact->nest_faces[first + face].turn;
                size_t at = sdv_nest_polynomial_number(exact, first + face, depth, child);
                sdv_make_polynomial(s.surface, sdv_nest_patch(s.kind, face, child, turn), 0, w,
                                    made);
                sdv_keep_polynomial(made[0], &s, sdv_lanes_from(e->channels, c),
                                    sdv_polynomial_at(e, at, c));
            }
            sdv_nest_descend(&s);
        }
        double *kept = sdv_kept_nest(e, number, c);
        memcpy(kept, s.base, sizeof s.base);
        memcpy(kept + 4, w, 4 * sizeof(double) * (size_t)s.kind->points);
    }
}

static void sdv_exact_patches_job(void *context, int job)
{
    const sdv_exact_evaluation *e = (const sdv_exact_evaluation *)context;
    const subdiv_surface *surface = e->surface;
    int first = sdv_share(surface->exact->patch_count, job, e->jobs);
    int end = sdv_share(surface->exact->patch_count, job + 1, e->jobs);
    for (int i = first; i < end; i++) sdv_patch_polynomials(e, &surface->exact->patches[i]);
}

static int sdv_nest_work(const sdv_exact *exact, int nest)
{
    return exact->kinds[exact->nests[nest].kind].work_count;
}

static void sdv_exact_nests_job(void *context, int job)
{
    const sdv_exact_evaluation *e = (const sdv_exact_evaluation *)context;
    const sdv_exact *exact = e->surface->exact;
    double w[4 * SDV_NEST_STACK];
    int end = sdv_share(exact->nest_count, job + 1, e->jobs);
    for (int i = sdv_share(exact->nest_count, job, e->jobs); i < end; i++)
        if (sdv_nest_work(exact, i) <= SDV_NEST_STACK) sdv_nest_polynomials(e, i, w);
}

static void sdv_exact_begin(const subdiv_surface *surface, int channels, const float *in,
                            size_t in_stride, void *scratch, const subdiv_options *opt)
{
    sdv_exact_work work = { surface, channels, in, in_stride, NULL, 0, 1 };
    sdv_exact_evaluation e;
    memset(&e, 0, sizeof e);
    e.surface = surface;
    e.channels = channels;
    sdv_carve_exact(surface, channels, (char *)scratch, &e.memory);
    work.points = e.memory.work;
    sdv_make_exact_work(&work, opt);
    const sdv_exact *exact = e.surface->exact;
    e.jobs = sdv_jobs(opt, exact->patch_count, 256);
    sdv_run(opt, sdv_exact_patches_job, &e, e.jobs);
    e.jobs = sdv_jobs(opt, exact->nest_count, 16);
    sdv_run(opt, sdv_exact_nests_job, &e, e.jobs);
    for (int i = 0; i < exact->nest_count; i++)         // they are few, and there is room for one
        if (sdv_nest_work(exact, i) > SDV_NEST_STACK) sdv_nest_polynomials(&e, i, e.memory.nest);
    *e.memory.begun = surface;
}

static const sdv_exact_calls *sdv_find_exact_calls(void)
{
    static const sdv_exact_calls calls = { sdv_new_exact, sdv_prepare_exact, sdv_exact_size,
                                           sdv_exact_begin };
    return &calls;
}

// ------------------------------------------------------------------------------- >>samples
// Samples: which polynomial a location is on, and what that has there; or down into a nest.

// A location's place on a polynomial: sx times u and sy times v, less where the polynomial starts.
typedef struct sdv_where {
    float x, y, sx, sy;
} sdv_where;

// Evaluates rows, which are the coefficients of powers of y with their derivatives in x: p, du, dv,
// duu, duv, dvv, as everywhere here. Up to order n only the first (n + 1)(n + 2) / 2 need be set.
SDV_INLINE void sdv_put_columns(sdv_four (*rows)[3], int loop, const sdv_where *at, int order,
                                sdv_four *out)
{
    sdv_four y = sdv_all(at->y), sx = sdv_all(at->sx), sy = sdv_all(at->sy), p[3];
    sdv_horner(&rows[0][0], 3, 3 + loop, y, p);
    out[0] = p[0];
    out[2] = sdv_times(sy, p[1]);
    out[5] = sdv_times(sdv_times(sy, sy), sdv_plus(p[2], p[2]));
    if (order == 0) return;
    sdv_horner(&rows[0][1], 3, 3, y, p);
    out[1] = sdv_times(sx, p[0]);
    out[4] = sdv_times(sdv_times(sx, sy), p[1]);
    if (order == 1) return;
    sdv_horner(&rows[0][2], 3, loop ? 1 : 3, y, p);
    out[3] = sdv_times(sdv_times(sx, sx), sdv_plus(p[0], p[0]));
}

// Evaluates coefficients c [SDV_SLOTS] in x: rows have the first and half the second derivatives.
SDV_INLINE void sdv_quad_rows(const sdv_four *c, sdv_four x, sdv_four (*rows)[3])
{
    sdv_horner(c, 1, 3, x, rows[0]);
    sdv_horner(c + 4, 1, 3, x, rows[1]);
    sdv_horner(c + 8, 1, 3, x, rows[2]);
    sdv_horner(c + 12, 1, 3, x, rows[3]);
}

// Evaluates the coefficients of a triangle in x, see sdv_powers.
SDV_INLINE void sdv_triangle_rows(const sdv_four *c, sdv_four x, sdv_four (*rows)[3])
{
    const sdv_four first[5] = { c[0], c[1], c[2], c[3], c[13] };
    sdv_horner(first, 1, 4, x, rows[0]);
    sdv_horner(c + 4, 1, 3, x, rows[1]);
    sdv_horner(c + 8, 1, 1, x, rows[2]);
    sdv_horner(c + 10, 1, 1, x, rows[3]);
    rows[4][0] = c[12];
}

// Loads four coefficients of up to four channels.
SDV_INLINE void sdv_load_four(const float *data, int lanes, sdv_four *c)
{
    c[0] = sdv_load(data);
    c[1] = sdv_load(data + lanes);
    c[2] = sdv_load(data + 2 * lanes);
    c[3] = sdv_load(data + 3 * lanes);
}

// Evaluates up to four channels of a polynomial.
SDV_INLINE void sdv_polynomial_values(const float *data, int loop, int lanes, const sdv_where *at,
                                      int order, sdv_four *out)
{
    sdv_four c[SDV_SLOTS], rows[5][3], x = sdv_all(at->x);
    sdv_load_four(data, lanes, c);
    sdv_load_four(data + 4 * lanes, lanes, c + 4);
    sdv_load_four(data + 8 * lanes, lanes, c + 8);
    sdv_load_four(data + 12 * lanes, lanes, c + 12);
    if (loop) sdv_triangle_rows(c, x, rows);
    else sdv_quad_rows(c, x, rows);
    sdv_put_columns(rows, loop, at, order, out);
}

// Makes the polynomial of unit vectors: lane i is what control point first + i weighs in it.
static void sdv_unit_polynomial(const subdiv_surface *surface, const sdv_patch *patch, int part,
                                int first, double (*c)[4])
{
    double units[16][4] = { { 0 } };
    sdv_patch unit = *patch;
    for (int i = 0; i < 16; i++) unit.points[i] = i;
    for (int i = 0; i < 4; i++) units[first + i][i] = 1;
    sdv_make_polynomial(surface, &unit, part, units[0], c);
}

// The powers of a coordinate, and their derivatives times those of the coordinate.
static void sdv_find_powers(double x, double scale, double (*powers)[5])
{
    for (int d = 0; d < 3; d++) powers[d][0] = d == 0;
    for (int i = 0; i < 4; i++)
        for (int d = 0; d < 3; d++)
            powers[d][i + 1] = x * powers[d][i] + (d ? d * scale * powers[d - 1][i] : 0);
}

// Evaluates a polynomial and its derivatives in doubles.
static void sdv_sum_powers(const double (*c)[4], int loop, double x, double y, double sx, double sy,
                           int order, double (*out)[4])
{
    static const unsigned char derivatives[6][2] = { {0,0}, {1,0}, {0,1}, {2,0}, {1,1}, {0,2} };
    const unsigned char (*powers)[2] = sdv_powers[loop];
    double across[3][5], up[3][5];
    sdv_find_powers(x, sx, across);
    sdv_find_powers(y, sy, up);
    for (int d = 0; d < (order + 1) * (order + 2) / 2; d++) {
        const double *xs = across[derivatives[d][0]], *ys = up[derivatives[d][1]];
        double sum[4] = { 0, 0, 0, 0 };
        for (int k = 0; k < SDV_SLOTS; k++) {
            double weight = xs[powers[k][0]] * ys[powers[k][1]];
            for (int l = 0; l < 4; l++) sum[l] += weight * c[k][l];
        }
        memcpy(out[d], sum, sizeof sum);
    }
}

// Writes what is asked for of a patch, at location i, of channels from c on. Its normal waits for
// others.
SDV_INLINE void sdv_put_lanes(const sdv_exact_evaluation *e, const float *data, int loop,
                              int lanes, int order, const sdv_where *at, int c, size_t i,
                              sdv_tangents *normals)
{
    sdv_four values[6];
    data += SDV_SLOTS * c;
    sdv_polynomial_values(data, loop, lanes, at, order, values);
    for (int k = 0; k < (order + 1) * (order + 2) / 2; k++)
        if (e->out[k]) sdv_store_some(e->out[k] + e->stride * i + c, values[k], lanes);
    if (order > 0 && e->normals && c == 0)
        sdv_add_tangents(normals, (int)i, values[1], values[2], -1);
}

static void sdv_put_channels(const sdv_exact_evaluation *e, const float *data, int loop,
                             const sdv_where *at, size_t i, sdv_tangents *normals)
{
    for (int c = 0; c < e->channels; c += 4) {
        int lanes = sdv_lanes_from(e->channels, c);
        if (e->order == 0) sdv_put_lanes(e, data, loop, lanes, 0, at, c, i, normals);
        else if (e->order == 1) sdv_put_lanes(e, data, loop, lanes, 1, at, c, i, normals);
        else sdv_put_lanes(e, data, loop, lanes, 2, at, c, i, normals);
    }
}

// A sample in a nest, four channels at a time.
typedef struct sdv_nest_sample {
    sdv_nest_state state;
    int     nest, face, vertex;         // vertex: the sample is there
    const sdv_patch *like;              // a patch whose sharp edges are those of the units; or NULL
    double  units[4][SDV_SLOTS][4];     // from sdv_unit_polynomial
    int     made;                       // 4 face + child, whose polynomial is here; or -1: not even
    double  c[SDV_SLOTS][4];            // the points of the next level are made
    double  values[6][4];               // what comes out; derivatives are those in x and y
    double  tangents[2][4];             // for the normal
} sdv_nest_sample;

// Applies the limit masks of a nest: of its vertex, as seen from its first level, and of two
// tangents.
static void sdv_nest_masks(const sdv_nest_state *s, double (*limit)[4])
{
    const sdv_nest_kind *kind = s->kind;
    const double *base = s->work + 4 * (size_t)s->points[0];
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 4; c++) {
            limit[k][c] = 0;
            for (int i = 0; i < kind->points; i++)
                limit[k][c] += kind->limit[k * kind->points + i] *
                               (s->work[4 * (size_t)s->points[i] + (size_t)c] - base[c]);
        }
}

// Makes the polynomial of a patch of a nest from what each point weighs. On an edge the points
// beside it weigh nothing at all, or cancel out: as seen from the vertex, the surface may grow
// without bound there, while along the edge it does not.
static void sdv_nest_polynomial(sdv_nest_sample *s, const sdv_patch *patch)
{
    const subdiv_surface *surface = s->state.surface;
    int count = sdv_control_points(&surface->rules);
    if (!s->like || s->like->sharp != patch->sharp ||
        memcmp(s->like->fan, patch->fan, sizeof patch->fan) != 0)
        for (int i = 0; i < count; i += 4)
            sdv_unit_polynomial(surface, patch, 0, i, s->units[i / 4]);
    s->like = patch;
    for (int k = 0; k < SDV_SLOTS; k++) {
        double sum[4] = { 0, 0, 0, 0 };
        for (int i = 0; i < count; i++)
            for (int c = 0; c < 4; c++)
                sum[c] += s->units[i / 4][k][i % 4] * s->state.w[4 * patch->points[i] + c];
        memcpy(s->c[k], sum, sizeof sum);
    }
}

// Evaluates the child of a nest's face at (x, y), which is not in the next nest.
static void sdv_nest_child(sdv_nest_sample *s, double x, double y, int order)
{
    const sdv_nest_state *state = &s->state;
    int loop = state->surface->rules.loop;
    double scale = 1;
    int child = sdv_descend(loop, &x, &y, &scale), number = 4 * s->face + child;
    if (s->made < 0) sdv_nest_refine(&s->state);
    if (s->made != number) sdv_nest_polynomial(s, sdv_nest_patch(state->kind, s->face, child, 0));
    s->made = number;
    sdv_sum_powers((const double (*)[4])s->c, loop, x, y, scale, scale, order, s->values);
    for (int c = 0; c < 4; c++) {
        s->values[0][c] = state->base[c] + state->shrink * s->values[0][c];
        for (int d = 3; d < 6 && order > 1; d++) s->values[d][c] /= state->shrink;
    }
    memcpy(s->tangents, s->values[1], sizeof s->tangents);
}

// Goes on to a level of a nest, counted from its first one.
static void sdv_nest_go_down(sdv_nest_sample *s, int level)
{
    for (double shrink = ldexp(1, -level); s->state.shrink > shrink; s->made = -1) {
        if (s->made < 0) sdv_nest_refine(&s->state);
        sdv_nest_descend(&s->state);
    }
}

// Evaluates the vertex of a nest by its limit masks. Second derivatives are 0.
static void sdv_nest_vertex(sdv_nest_sample *s)
{
    const sdv_nest_kind *kind = s->state.kind;
    double n = (kind->ring ? 1.0 : 2.0) * kind->faces, along[2], across[2], limit[3][4];
    sdv_nest_masks(&s->state, limit);
    for (int i = 0; i < 2; i++) {
        along[i] = sdv_cosine(s->face + i, n);
        across[i] = sdv_sine(s->face + i, n);
    }
    for (int c = 0; c < 4; c++) {
        s->values[0][c] = s->state.work[4 * (size_t)s->state.points[0] + (size_t)c] + limit[0][c];
        for (int i = 0; i < 2; i++)
            s->values[1 + i][c] = along[i] * limit[1][c] + across[i] * limit[2][c];
    }
    memcpy(s->tangents, limit[1], sizeof s->tangents);
    memset(s->values[3], 0, 3 * sizeof s->values[3]);
}

// Near a vertex with one face on a side of its crease tangents are parallel. There the normal is
// that of the vertex, whose second tangent is how the crease bends.
static void sdv_nest_normal(sdv_nest_sample *s)
{
    const double *a = s->tangents[0], *b = s->tangents[1];
    double limit[3][4], n[3];
    sdv_cross(a, b, n);
    int parallel = sdv_dot3(n, n) <= 1e-10 * sdv_dot3(a, a) * sdv_dot3(b, b);
    if (s->state.kind->rule != SDV_CREASE || !parallel) return;
    sdv_nest_masks(&s->state, limit);
    memcpy(s->tangents, limit[1], sizeof s->tangents);
}

// Turns derivatives in x and y into those in u and v, with the scale of the face. values: the point
// and behind it its derivatives, a stride apart.
static void sdv_turn_derivatives(double *values, int stride, const signed char *t, double scale,
                                 int order)
{
    double ss = scale * scale, *du = values + stride, *dv = du + stride, dx = *du, dy = *dv;
    *du = scale * (t[0] * dx + t[2] * dy);
    *dv = scale * (t[1] * dx + t[3] * dy);
    if (order < 2) return;
    double *duu = dv + stride, *duv = duu + stride, *dvv = duv + stride;
    double dxx = *duu, dxy = *duv, dyy = *dvv;
    *duu = ss * (t[0] * t[0] * dxx + 2 * t[0] * t[2] * dxy + t[2] * t[2] * dyy);
    *duv = ss * (t[0] * t[1] * dxx + (t[0] * t[3] + t[1] * t[2]) * dxy + t[2] * t[3] * dyy);
    *dvv = ss * (t[1] * t[1] * dxx + 2 * t[1] * t[3] * dxy + t[3] * t[3] * dyy);
}

static void sdv_put_nest_sample(const sdv_exact_evaluation *e, const sdv_nest_sample *s, int c,
                                size_t i)
{
    for (int k = 0; k < 6; k++)
        for (int l = 0; l < 4 && c + l < e->channels && e->out[k]; l++) {
            double value = s->values[k][l], most = (double)FLT_MAX, large = k > 0 ? HUGE_VAL : most;
            e->out[k][e->stride * i + (size_t)(c + l)] =
                (float)(value > most ? large : value < -most ? -large : value);
        }
    if (!e->normals || c > 0) return;
    int left = e->surface->rules.left_handed;
    const double *a = s->tangents[left], *b = s->tangents[!left];
    double fold = s->vertex ? sdv_fold * (sdv_dot3(a, a) + sdv_dot3(b, b)) : 0;
    sdv_unit_cross(a, b, 1e-28, fold, e->normals + e->normal_stride * i);
}

// Starts where sdv_nest_polynomials has ended.
static void sdv_load_kept(const sdv_exact_evaluation *e, int nest, int c, sdv_nest_sample *s)
{
    const double *kept = sdv_kept_nest(e, nest, c);
    sdv_nest_state *state = &s->state;
    s->nest = nest;
    s->made = -1;
    sdv_nest_begin(state, e->surface, nest,
                   e->memory.work + (size_t)c * (size_t)e->surface->work_count, state->w);
    state->shrink = ldexp(1, -SDV_NEST_DEPTH);
    memcpy(state->base, kept, sizeof state->base);
    memcpy(state->w, kept + 4, 4 * sizeof(double) * (size_t)state->kind->points);
}

// Samples nearer to the vertices of nests than polynomials are kept wait until there are many, or
// no others are left. Then they are sorted: all those of a nest share one way down, and those of a
// patch its polynomial.
enum { SDV_QUEUE = 2048 };

typedef struct sdv_waiting {
    double x, y;                        // on their level, as seen from the vertex; 0: the vertex
    float  scale;                       // of the leaf
    int    face, i;                     // of a nest; the location's number
    const sdv_exact_evaluation *asked;  // what is asked of it
} sdv_waiting;

typedef struct sdv_queue {
    sdv_context  context;
    sdv_arena    arena;
    int          room, count;
    sdv_waiting *items;                 // [room] NULL before the first one
    uint32_t    *keys;                  // [room] from the highest bit: nest, level, face, quarter
    int         *order[2];              // [room] sorted, and while they are
    double      *w;                     // [4 * most_work] for a nest
    sdv_tangents normals;               // of other samples, which wait as those of limits do
} sdv_queue;

// Makes an empty queue for a job's share of the locations.
static void sdv_queue_new(const sdv_exact_evaluation *e, size_t share, sdv_queue *queue)
{
    memset(queue, 0, sizeof *queue);
    queue->context.user = e->user;
    queue->room = share < SDV_QUEUE ? (int)share : SDV_QUEUE;
    queue->normals.normals = e->normals;
    queue->normals.stride = e->normal_stride;
    queue->normals.left_handed = e->surface->rules.left_handed;
}

// Sorts a queue byte by byte, from the lowest one on.
static void sdv_sort_queue(sdv_queue *queue)
{
    for (int k = 0; k < queue->count; k++) queue->order[0][k] = k;
    for (int byte = 0; byte < 4 && queue->count > 1; byte++) {
        const int *from = queue->order[byte & 1];
        int *to = queue->order[~byte & 1], starts[257] = { 0 };
        for (int k = 0; k < queue->count; k++) starts[(queue->keys[k] >> 8 * byte & 255) + 1]++;
        for (int k = 0; k < 255; k++) starts[k + 1] += starts[k];
        for (int k = 0; k < queue->count; k++)
            to[starts[queue->keys[from[k]] >> 8 * byte & 255]++] = from[k];
    }
}

// Evaluates a sample that waited, four channels from c on.
static void sdv_sample_nest(const sdv_waiting *at, int level, int c, sdv_nest_sample *s)
{
    const sdv_exact_evaluation *e = at->asked;
    const sdv_nest_face *face = &e->surface->exact->nest_faces[at->face];
    if (s->nest != face->nest) sdv_load_kept(e, face->nest, c, s);
    s->face = at->face - e->surface->exact->nests[face->nest].face;
    s->vertex = at->x <= 0 && at->y <= 0;
    if (s->vertex) {
        sdv_nest_vertex(s);
    } else {
        sdv_nest_go_down(s, level);
        sdv_nest_child(s, at->x, at->y, e->order);
    }
    if (e->normals && c == 0) sdv_nest_normal(s);
    const signed char *turn = sdv_turns[e->surface->rules.loop][face->turn];
    for (int i = 0; i < 4; i++)
        sdv_turn_derivatives(&s->values[0][i], 4, turn, (double)at->scale, e->order);
    sdv_put_nest_sample(e, s, c, (size_t)at->i);
}

// Evaluates the samples of a queue.
static void sdv_empty_queue(const sdv_exact_evaluation *e, sdv_queue *queue)
{
    sdv_nest_sample s;
    s.state.w = queue->w;
    s.like = NULL;
    sdv_sort_queue(queue);
    for (int c = 0; c < e->channels; c += 4) {
        s.nest = -1;
        for (int k = 0; k < queue->count; k++) {
            int i = queue->order[0][k];
            sdv_sample_nest(&queue->items[i], (int)(queue->keys[i] >> 12 & 255), c, &s);
        }
    }
    queue->count = 0;
}

// Adds a sample to the queue.
static void sdv_enqueue(const sdv_exact_evaluation *e, const sdv_leaf *leaf, size_t i,
                        sdv_queue *queue)
{
    const sdv_exact *exact = e->surface->exact;
    sdv_waiting at = { leaf->x, leaf->y, (float)leaf->sx, leaf->nest_face, (int)i, e };
    if (!queue->items) {
        queue->items = SDV_NEW(&queue->context, &queue->arena, sdv_waiting, queue->room);
        queue->keys = SDV_NEW(&queue->context, &queue->arena, uint32_t, queue->room);
        for (int k = 0; k < 2; k++)
            queue->order[k] = SDV_NEW(&queue->context, &queue->arena, int, queue->room);
        queue->w = SDV_NEW(&queue->context, &queue->arena, double, 4 * (size_t)exact->most_work);
    }
    if (queue->context.result) return;
    if (queue->count == queue->room) sdv_empty_queue(e, queue);
    queue->items[queue->count] = at;
    queue->keys[queue->count++] =
        (uint32_t)exact->nest_faces[at.face].nest << 20 | (uint32_t)leaf->below_kept << 12 |
        ((uint32_t)at.face & 1023) << 2 | (uint32_t)(at.y >= 0.5) << 1 | (uint32_t)(at.x >= 0.5);
}

// Writes the zeros of a face without a surface.
static void sdv_put_zeros(const sdv_exact_evaluation *e, size_t i)
{
    for (int k = 0; k < 6; k++)
        for (int c = 0; c < e->channels && e->out[k]; c++) e->out[k][e->stride * i + (size_t)c] = 0;
    for (int c = 0; c < 3 && e->normals; c++) e->normals[e->normal_stride * i + (size_t)c] = 0;
}

// Evaluates a place by its leaf.
static void sdv_put_spot(const sdv_exact_evaluation *e, int loop, const sdv_spot *spot, size_t i,
                         sdv_queue *queue)
{
    sdv_leaf leaf = sdv_locate(e->surface, spot);
    sdv_find_polynomial(e->surface, &leaf);
    sdv_where at = { (float)leaf.x, (float)leaf.y, (float)leaf.sx, (float)leaf.sy };
    if (leaf.below_kept)
        sdv_enqueue(e, &leaf, i, queue);
    else if (leaf.patch || leaf.nest_face >= 0)
        sdv_put_channels(e, sdv_polynomial_at(e, leaf.polynomial, 0), loop, &at, i,
                         &queue->normals);
    else
        sdv_put_zeros(e, i);
}

// Evaluates a location whose cell has no polynomial, or one on an edge: its point at home, so that
// it has the same bits on all faces, and its derivatives on its own face.
static void sdv_put_location(const sdv_exact_evaluation *e, int loop, size_t i, sdv_queue *queue)
{
    sdv_spot spot = sdv_spot_of(e->surface, &e->locations[i]), home;
    int shared = e->out[0] && sdv_find_home(e->surface, &spot, &home);
    if (shared) sdv_put_spot(&e->parts[0], loop, &home, i, queue);
    if (!shared || e->order > 0) sdv_put_spot(shared ? &e->parts[1] : e, loop, &spot, i, queue);
}

// A batch of locations that are looked up, and where their polynomials are.
typedef struct sdv_sample_batch {
    int count;
    sdv_lookup at;
    const float *data[SDV_LOOKUP];
} sdv_sample_batch;

SDV_INLINE int sdv_find_some(const sdv_exact_evaluation *e, int loop, size_t i, int count,
                             sdv_sample_batch *batch)
{
    size_t width = SDV_SLOTS * (size_t)e->channels;
    batch->count = 0;
    if (!sdv_look_up(e->surface, loop, e->locations + i, count, &batch->at)) return 0;
    batch->count = count;
    for (int k = 0; k < count; k++)
        batch->data[k] = e->memory.polynomials + width * (batch->at.cells[k] >> SDV_CELL_BITS);
    return 1;
}

// Looks up the next batch of the locations from i to end. Where it is a whole one, loops have a
// constant count. Returns 0 if a location is not there.
static int sdv_find_batch(const sdv_exact_evaluation *e, size_t i, size_t end,
                          sdv_sample_batch *batch)
{
    int loop = e->surface->rules.loop;
    if (end - i < SDV_LOOKUP) return sdv_find_some(e, loop, i, (int)(end - i), batch);
    if (loop) return sdv_find_some(e, 1, i, SDV_LOOKUP, batch);
    return sdv_find_some(e, 0, i, SDV_LOOKUP, batch);
}

// Evaluates a batch of locations from i on, and fetches the polynomials of the next batch. lanes,
// order: constants for what is asked for most; lanes 0: whatever e asks for.
SDV_INLINE void sdv_put_batch(const sdv_exact_evaluation *e, int loop, int lanes, int order,
                              const sdv_sample_batch *batch, const sdv_sample_batch *next, size_t i,
                              sdv_queue *queue)
{
    const sdv_lookup *l = &batch->at;
    size_t third = SDV_SLOTS * (size_t)e->channels / 3;
    int count = batch->count, fetched = next->count;
    sdv_tangents *normals = &queue->normals;
    for (int k = 0; k < count; k++, i++) {
        sdv_where at = { l->x[k], l->y[k], l->sx[k], l->sy[k] };
        if (k < fetched) {
            sdv_prefetch(next->data[k]);
            sdv_prefetch(next->data[k] + third);
            sdv_prefetch(next->data[k] + 2 * third);
        }
        if (l->cells[k] == SDV_CELL_FAR) sdv_put_location(e, loop, i, queue);
        else if (lanes) sdv_put_lanes(e, batch->data[k], loop, lanes, order, &at, 0, i, normals);
        else sdv_put_channels(e, batch->data[k], loop, &at, i, normals);
    }
}

// Evaluates a job's share of the locations, one batch after the other.
static void sdv_locations_job(void *context, int job)
{
    sdv_exact_evaluation *e = (sdv_exact_evaluation *)context;
    size_t i = (size_t)sdv_share(e->count, job, e->jobs);
    size_t end = (size_t)sdv_share(e->count, job + 1, e->jobs);
    int loop = e->surface->rules.loop, order = e->channels == 3 ? e->order : 2;
    sdv_sample_batch batches[2], *batch = batches, *next = batches + 1;
    sdv_queue queue;
    sdv_queue_new(e, end - i, &queue);
    e->refused[job] = (unsigned char)!sdv_find_batch(e, i, end, next);
    while (i < end && !e->refused[job]) {
        sdv_sample_batch *last = batch;
        batch = next;
        next = last;
        i += (size_t)batch->count;
        e->refused[job] = (unsigned char)!sdv_find_batch(e, i, end, next);
        size_t first = i - (size_t)batch->count;
        if (loop && order == 0) sdv_put_batch(e, 1, 3, 0, batch, next, first, &queue);
        else if (loop && order == 1) sdv_put_batch(e, 1, 3, 1, batch, next, first, &queue);
        else if (order == 0) sdv_put_batch(e, 0, 3, 0, batch, next, first, &queue);
        else if (order == 1) sdv_put_batch(e, 0, 3, 1, batch, next, first, &queue);
        else sdv_put_batch(e, loop, 0, 0, batch, next, first, &queue);
    }
    if (queue.count) sdv_empty_queue(e, &queue);
    sdv_flush_tangents(&queue.normals);
    e->failed[job] = queue.context.result != SUBDIV_OK;
    sdv_arena_free(&queue.arena);
}

static void sdv_check_exact(sdv_context *context, const subdiv_surface *surface, int channels,
                            int count, const subdiv_location *locations,
                            const subdiv_derivatives *out)
{
    if (context->result) return;
    int values = out->points || out->du || out->dv || out->duu || out->duv || out->dvv;
    if (!surface->exact)
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "the surface was not prepared for SUBDIV_EXACT");
    else if (count < 0 || (count > 0 && !locations))
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, count < 0 ? "count is %d" : "locations is NULL",
                 count);
    else if (out->normals && channels < 3)
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "normals of %d channels", channels);
    else if (out->stride && ((values && out->stride < channels) ||
                             (out->normals && out->stride < 3) || out->stride < 0))
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "a stride of %d floats is too small", out->stride);
}

SUBDIV_DEF subdiv_result subdiv_evaluate_at(const subdiv_surface *surface, int channels,
                                            const void *scratch, int count,
                                            const subdiv_location *locations,
                                            const subdiv_derivatives *out,
                                            const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    int stride = 0;
    sdv_check_values(&context, surface, channels, scratch, &stride);
    if (!out) sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "out is NULL");
    sdv_check_exact(&context, surface, channels, count, locations, out);
    if (context.result) return context.result;
    sdv_exact_evaluation e, parts[2];
    unsigned char failed[SDV_MOST_JOBS] = { 0 }, refused[SDV_MOST_JOBS] = { 0 };
    float *to[6] = { out->points, out->du, out->dv, out->duu, out->duv, out->dvv };
    memset(&e, 0, sizeof e);
    e.surface = surface;
    e.channels = channels;
    sdv_carve_exact(surface, channels, (char *)(size_t)scratch, &e.memory);     // only read
    if (*e.memory.begun != surface)
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "subdiv_evaluate_begin has not filled scratch");
    if (context.result) return context.result;
    e.count = count;
    e.locations = locations;
    memcpy(e.out, to, sizeof to);
    e.normals = out->normals;
    e.stride = (size_t)(out->stride ? out->stride : channels);
    e.normal_stride = (size_t)(out->stride ? out->stride : 3);
    e.order = to[3] || to[4] || to[5] ? 2 : to[1] || to[2] || out->normals ? 1 : 0;
    e.failed = failed;
    e.refused = refused;
    e.user = context.user;
    e.jobs = sdv_jobs(opt, count, 1024);
    parts[0] = parts[1] = e;
    memset(parts[0].out + 1, 0, sizeof to - sizeof to[0]);
    parts[0].normals = parts[1].out[0] = NULL;
    parts[0].order = 0;
    e.parts = parts;
    sdv_run(opt, sdv_locations_job, &e, e.jobs);
    if (memchr(refused, 1, sizeof refused))
        sdv_check_locations(&context, surface, count, locations);
    else if (memchr(failed, 1, sizeof failed))
        sdv_fail(&context, SUBDIV_ERROR_MEMORY, "out of memory");
    return context.result;
}

// Makes a tangent from du, dv and the normal of a point, behind each other, then du, dv of its UVs.
static void sdv_make_tangent(const float *f, int left_handed, float *out)
{
    double su = (double)f[9], tu = (double)f[10], sv = (double)f[11], tv = (double)f[12];
    double area = su * tv - sv * tu, sign = area < 0 ? -1 : 1, n[3], t[3];
    for (int k = 0; k < 3; k++) {
        n[k] = (double)f[6 + k];
        t[k] = sign * (tv * (double)f[k] - tu * (double)f[3 + k]);
    }
    double along = sdv_dot3(n, t);
    int none = fabs(area) <= 1e-6 * (fabs(su * tv) + fabs(sv * tu)) || !(sdv_dot3(n, n) > 0);
    for (int k = 0; k < 3; k++) t[k] = none ? 0 : t[k] - along * n[k];
    sdv_make_unit(t, out);
    out[3] = sdv_dot3(t, t) > 0 ? (float)(left_handed ? -sign : sign) : 0;
}

enum { SDV_TANGENTS = 1 << 14 };        // locations at a time

SUBDIV_DEF subdiv_result subdiv_tangents_at(const subdiv_surface *surface, const void *scratch,
                                            int count, const subdiv_location *locations,
                                            float *tangents, int stride,
                                            const subdiv_options *opt)
{
    enum { WIDTH = 13 };
    sdv_context context = sdv_begin(opt);
    sdv_arena arena = sdv_scratch();
    const subdiv_surface *uv = surface ? surface->uv : NULL;
    if (stride == 0) stride = 4;
    sdv_check_values(&context, surface, 4, tangents, &stride);
    if (!uv) sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "the surface has no UVs");
    float *f = SDV_NEW(&context, &arena, float, WIDTH * SDV_TANGENTS);
    void *uv_scratch = SDV_NEW(&context, &arena, char, subdiv_scratch_size(uv, 2));
    if (!context.result)
        context.result = subdiv_evaluate_begin(uv, 2, surface->uvs, 2, uv_scratch, opt);
    for (int left = count; !context.result; left -= SDV_TANGENTS, locations += SDV_TANGENTS) {
        const subdiv_derivatives of = { NULL, f, f + 3, NULL, NULL, NULL, f + 6, WIDTH };
        const subdiv_derivatives of_uv = { NULL, f + 9, f + 11, NULL, NULL, NULL, NULL, WIDTH };
        int some = left < SDV_TANGENTS ? left : SDV_TANGENTS;
        context.result = subdiv_evaluate_at(surface, 3, scratch, some, locations, &of, opt);
        if (!context.result)
            context.result = subdiv_evaluate_at(uv, 2, uv_scratch, some, locations, &of_uv, opt);
        if (context.result) break;
        for (int i = 0; i < some; i++, tangents += stride)
            sdv_make_tangent(f + WIDTH * i, surface->rules.left_handed, tangents);
        if (left <= SDV_TANGENTS) break;                // after one call at least, which checks
    }
    sdv_arena_free(&arena);
    return context.result;
}
#else
static const sdv_exact_calls *sdv_find_exact_calls(void)
{
    return NULL;
}
#endif // SUBDIV_NO_EXACT

// ------------------------------------------------------------------------------ >>stencils
// No rule is here a second time: rows have weights, and what a patch does to its control points
// shows when it evaluates unit vectors, one control point 1 and all others 0. So a point is a sum
// of work points, and each of these, through its row, a sum of others, down to the cage's. These
// sums are kept, but for long ones: near a vertex of high valence there are many.

typedef struct sdv_entry {
    double weight;
    int    vertex;                      // of the cage, or a value's number
} sdv_entry;

enum { SDV_LONGEST_KNOWN = 64, SDV_LONG = -1 };
enum { SDV_PARTS = 6 };                 // a point and its first and second derivatives

typedef struct sdv_stencil_row {        // a row: points and their weights
    int     count;
    int    *points;
    double *weights;                    // [count]; of a limit [3 * count]: of the point, of its
    int     limit;                      // tangents
} sdv_stencil_row;

typedef struct sdv_stencil_maker {
    sdv_context *context;
    const subdiv_surface *surface;
    sdv_arena  arena;

    sdv_grid_step  masks;               // inside grids
    sdv_grid_limit limit;               // of a limit

    int       *bases;                   // [levels + 2] where levels start; here all are whole,
    int        work_count;              // and have so many points

    sdv_array  known;                   // sdv_entry: of all work points that are known,
    size_t    *starts;                  // [work_count] where each one's start, and
    int       *sizes;                   // [work_count] how many there are; 0: not known yet,
                                        // SDV_LONG: too many to be kept

    int        parts;                   // 6 at locations, 3 with tangents, else 1
    int        size;                    // the sum that is being made: so many
    int       *vertices;                // [work_count] vertices, or long work points, with
    double    *sums;                    // [work_count * parts] weights, and where
    int       *places;                  // [work_count] each stands, or -1

    const sdv_batch **batches;          // of work points, then the result's points: where the row
    const int **rows;                   // of each is; NULL: on a grid, or in a face of the cage
    unsigned char *steps;               // of each point: made before those with a higher one
    int        longest;                 // points of a row at most
    sdv_stencil_row *room;              // rows: one for each step

    size_t    *offsets;                 // [points + 1] what is made
    sdv_array  indices, weights;        // ints, floats [parts] each
} sdv_stencil_maker;

// Finds the grid, row and column of a point inside a grid. Returns the grid's face-vertex.
static int sdv_find_on_grid(const sdv_order *order, int index, int *row, int *column)
{
    const sdv_level *cage = &order->cage;
    int f = sdv_face_inside(order, index), start = sdv_face_start(cage, f), grid = 0;
    int n = sdv_is_ngon(order, f) ? order->m : order->n, length = n - 1;
    int size = order->frame ? 4 * (n - 2) : length * length;
    index -= sdv_inside_grid(order, f, 0);
    if (n != order->n) {
        grid = index / size;
        index -= grid * size;
    }
    if (order->frame) {
        int along = n - 2 - order->loop;
        sdv_beside_side(n, order->loop, index / along, index % along + 1, row, column);
        return start + grid;
    }
    *row = 1;
    if (order->loop) for (length--; index >= length; index -= length--) ++*row;
    else *row += index / length;
    *column = 1 + (order->loop ? index : index % length);
    return start + grid;
}

// A work point's number if no level were a frame.
static int sdv_whole_point(const sdv_stencil_maker *make, int point)
{
    const subdiv_surface *surface = make->surface;
    int level = 0, row, column;
    if (!surface->orders) return point;
    while (level < surface->levels && point >= surface->bases[level + 1]) level++;
    const sdv_order *from = &surface->orders[level];
    int base = make->bases[level];
    point -= surface->bases[level];
    if (!from->frame || point < from->first_inside_point) return base + point;
    sdv_order to = sdv_order_at(surface, level, 0);
    int f = sdv_face_inside(from, point);
    if (point < sdv_inside_grid(from, f, 0))                   // the centre, or on a spoke
        return base + sdv_first_inside(&to, f) + point - sdv_first_inside(from, f);
    sdv_grid grid;
    int h = sdv_find_on_grid(from, point, &row, &column);
    sdv_grid_at(&to, h, &grid);
    return base + sdv_inside_index(&grid, row, column);
}

// Points of level i are of step 2 i, and face points of the cage of step 1. Without orders, face
// points have a step of their own on all levels. The result's points are of the last step.
static int sdv_last_step(const sdv_stencil_maker *make)
{
    return 2 * make->surface->levels + 1;
}

// Notes where the rows of a step are.
static void sdv_note_batches(sdv_stencil_maker *make, const sdv_batches *batches, int step)
{
    int result = step == sdv_last_step(make);
    for (int b = 0; b < (batches->rows ? batches->starts[batches->blocks] : 0); b++) {
        const sdv_batch *batch = &batches->items[b];
        const int *row = batch->items, points = sdv_row_points(&batch->shape);
        if (points > make->longest) make->longest = points;
        for (int i = 0; i < batch->rows; i++, row += 1 + points + batch->shape.own) {
            int at = result ? make->work_count + row[0] : sdv_whole_point(make, row[0]);
            make->batches[at] = batch;
            make->rows[at] = row;
            make->steps[at] = (unsigned char)step;
        }
    }
}

static void sdv_note_rows(sdv_stencil_maker *make)
{
    const subdiv_surface *surface = make->surface;
    int levels = surface->levels, last = sdv_last_step(make);
    size_t work = (size_t)make->work_count, count = work + (size_t)surface->fine.vertex_count;
    make->batches = SDV_NEW(make->context, &make->arena, const sdv_batch *, count);
    make->rows = SDV_NEW(make->context, &make->arena, const int *, count);
    make->steps = SDV_NEW(make->context, &make->arena, unsigned char, count);
    if (make->context->result) return;
    for (size_t i = 0; i < count; i++) make->rows[i] = NULL;
    memset(make->steps + work, last, count - work);
    sdv_note_batches(make, &surface->limit_rows, last);
    for (int i = 0; i < 2 * levels && !surface->orders; i++)
        sdv_note_batches(make, &surface->refine[i], i + 1);
    if (!surface->orders) return;
    for (int i = 0; i <= levels; i++)
        memset(make->steps + make->bases[i], 2 * i,
               (size_t)make->bases[i + 1] - (size_t)make->bases[i]);
    for (int i = 0; i < levels; i++)
        sdv_note_batches(make, &surface->refine[i],
                         i + 1 < levels || surface->rules.limit ? 2 * i + 2 : last);
    if (!surface->rules.loop)
        memset(make->steps + sdv_first_face_point(surface), 1, (size_t)surface->cage_face_count);
}

static void sdv_stencil_maker_new(sdv_context *context, sdv_stencil_maker *make,
                                  const subdiv_surface *surface, int points)
{
    int parts = surface->exact ? SDV_PARTS : surface->rules.limit ? 3 : 1;
    memset(make, 0, sizeof *make);
    make->context = context;
    make->surface = surface;
    make->parts = parts;
    make->arena = sdv_scratch();
    make->work_count = surface->work_count;
    if (surface->orders) {
        make->bases = sdv_find_bases(context, &make->arena, surface, 1);
        if (!context->result) make->work_count = make->bases[surface->levels + 1];
    }
    size_t work = (size_t)make->work_count;
    make->starts = SDV_NEW(context, &make->arena, size_t, work);
    make->sizes = SDV_NEW(context, &make->arena, int, work);
    make->vertices = SDV_NEW(context, &make->arena, int, work);
    make->sums = SDV_NEW(context, &make->arena, double, work * (size_t)parts);
    make->places = SDV_NEW(context, &make->arena, int, work);
    make->offsets = SDV_NEW(context, &make->arena, size_t, (size_t)points + 1);
    if (context->result) return;
    memset(make->sizes, 0, work * sizeof(int));
    for (size_t i = 0; i < work; i++) make->places[i] = -1;
    make->offsets[0] = 0;
    make->longest = 9;
    make->masks = sdv_regular_masks(&surface->rules);
    if (surface->rules.limit) make->limit = sdv_regular_limit(&surface->rules);
    for (int f = 0; f < surface->order.cage.face_count; f++) {
        int size = sdv_face_end(&surface->order.cage, f) - sdv_face_start(&surface->order.cage, f);
        if (size > make->longest) make->longest = size;
    }
    sdv_note_rows(make);
    make->room = SDV_NEW(context, &make->arena, sdv_stencil_row, sdv_last_step(make) + 1);
    for (int i = 0; i <= sdv_last_step(make) && !context->result; i++) {
        make->room[i].points = SDV_NEW(context, &make->arena, int, make->longest);
        make->room[i].weights = SDV_NEW(context, &make->arena, double,
                                        (size_t)parts * (size_t)make->longest);
    }
}

static void sdv_add_to_sum(sdv_stencil_maker *make, int vertex, double factor, const double *w)
{
    int *place = &make->places[vertex], parts = make->parts;
    double *sum = make->sums + (size_t)parts * (size_t)(*place < 0 ? make->size : *place);
    if (*place < 0) {
        make->vertices[*place = make->size++] = vertex;
        for (int i = 0; i < parts; i++) sum[i] = 0;
    }
    for (int i = 0; i < parts; i++) sum[i] += factor * w[i];
}

// Adds a work point that is known or long, w [parts] times.
static void sdv_add_work_point(sdv_stencil_maker *make, int point, const double *w)
{
    const subdiv_surface *surface = make->surface;
    int cage = point < surface->cage_vertex_count;
    if (cage || make->sizes[point] == SDV_LONG) {
        sdv_add_to_sum(make, cage && surface->source ? surface->source[point] : point, 1, w);
        return;
    }
    const sdv_entry *entry = (const sdv_entry *)sdv_items(&make->known) + make->starts[point];
    for (int i = 0; i < make->sizes[point]; i++)
        sdv_add_to_sum(make, entry[i].vertex, entry[i].weight, w);
}

static void sdv_end_sum(sdv_stencil_maker *make)
{
    for (int i = 0; i < make->size; i++) make->places[make->vertices[i]] = -1;
    make->size = 0;
}

// Gives the first point of a row what the others leave of a total of 1 or, for a tangent, of 0.
static void sdv_set_first_weight(sdv_stencil_row *row, int part)
{
    double *w = row->weights + part * row->count;
    w[0] = part == 0;
    for (int i = row->count - 1; i > 0; i--) w[0] -= w[i];
}

// Gives the points of a row their weights: behind the first one, counts[k] points have weight w[k].
static void sdv_set_weights(sdv_stencil_row *row, const int *counts, const double *w)
{
    row->limit = 0;
    row->count = 1;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < counts[k]; i++) row->weights[row->count++] = w[k];
    sdv_set_first_weight(row, 0);
}

// Gives the points of a limit row their weights w [3 * count].
static void sdv_set_limit_weights(sdv_stencil_row *row, int count, const float *w)
{
    row->limit = 1;
    row->count = count;
    for (int i = 0; i < 3 * count; i++) row->weights[i] = (double)w[i];
    for (int part = 0; part < 3; part++) sdv_set_first_weight(row, part);
}

static void sdv_batch_row(const sdv_stencil_maker *make, const sdv_batch *batch, const int *row,
                          sdv_stencil_row *out)
{
    int count = sdv_row_points(&batch->shape);
    for (int i = 0; i < count; i++) out->points[i] = sdv_whole_point(make, row[1 + i]);
    if (batch->limit) {
        sdv_set_limit_weights(out, count, sdv_limit_weights_of(batch, row));
        return;
    }
    const void *own = row + 1 + count;
    const float *w = batch->shape.own ? (const float *)own : batch->shape.weight;
    const double weights[3] = { (double)w[0], (double)w[1], (double)w[2] };
    sdv_set_weights(out, batch->shape.count, weights);
}

// The points of a level that a point inside a grid of the next level is made of, as steps of a row
// and of a column from the one at or before it. By 2 up + right, which say whether it is between
// two rows, between two columns: a vertex point, edge points, a face point (Loop: the edge point on
// the long side of a square). First those with the mask's weight self, then edge, then face.
static const signed char sdv_grid_mask_points[2][4][9][2] = {
    { { {0,0}, {0,1}, {1,0}, {0,-1}, {-1,0}, {1,1}, {1,-1}, {-1,-1}, {-1,1} },
      { {0,0}, {0,1}, {-1,0}, {-1,1}, {1,0}, {1,1} },
      { {0,0}, {1,0}, {0,-1}, {1,-1}, {0,1}, {1,1} },
      { {0,0}, {0,1}, {1,0}, {1,1} } },
    { { {0,0}, {0,1}, {1,0}, {1,-1}, {0,-1}, {-1,0}, {-1,1} },
      { {0,0}, {0,1}, {1,0}, {-1,1} },
      { {0,0}, {1,0}, {0,1}, {1,-1} },
      { {0,1}, {1,0}, {0,0}, {1,1} } } };

// How many there are of each weight, without the first point.
static const int sdv_grid_mask_counts[2][4][3] = {
    { {0,4,4}, {1,0,4}, {1,0,4}, {3,0,0} }, { {0,6,0}, {1,0,2}, {1,0,2}, {1,0,2} } };

// The row of a point of a level that is on a grid, from 2 on, or of a limit, from the same level.
static void sdv_grid_row_of(const sdv_stencil_maker *make, int level, int limit, int index,
                            sdv_stencil_row *out)
{
    const subdiv_surface *surface = make->surface;
    int before = limit ? level : level - 1, half = limit ? 1 : 2;
    int row, column, loop = make->masks.loop;
    sdv_order to = sdv_order_at(surface, level, 0), from = sdv_order_at(surface, before, 0);
    int h = sdv_find_on_grid(&to, index, &row, &column);
    int kind = limit ? 0 : 2 * (row % 2) + column % 2;
    const int *counts = sdv_grid_mask_counts[loop][kind];
    const signed char (*steps)[2] = sdv_grid_mask_points[loop][kind];
    int count = 1 + counts[0] + counts[1] + counts[2];
    sdv_grid grid;
    sdv_grid_at(&from, h, &grid);
    for (int i = 0; i < count; i++)
        out->points[i] = make->bases[before] + sdv_grid_index(&grid, row / half + steps[i][0],
                                                              column / half + steps[i][1]);
    if (limit) {
        sdv_set_limit_weights(out, count, make->limit.w);
        return;
    }
    sdv_mask mask = kind ? make->masks.edge : make->masks.vertex;
    if (!loop) mask = kind ? sdv_spread_edge(mask, 2) : sdv_spread_vertex(mask, 4);
    if (!loop && kind == 3) mask.self = (double)make->masks.face;
    const double w[3] = { mask.self, mask.edge, mask.face };
    sdv_set_weights(out, counts, w);
}

// The row of a face point of the cage.
static void sdv_face_stencil(const subdiv_surface *surface, int f, sdv_stencil_row *out)
{
    const sdv_level *cage = &surface->order.cage;
    int start = sdv_face_start(cage, f), size = sdv_face_end(cage, f) - start;
    const int counts[3] = { size - 1, 0, 0 };
    const double w[3] = { (double)(float)sdv_face_weight(size), 0, 0 };
    for (int i = 0; i < size; i++) out->points[i] = cage->face_vertices[start + i];
    sdv_set_weights(out, counts, w);
}

// Finds the row of a point: a work point or, behind all these, one of the result. It is in the room
// of its step.
static const sdv_stencil_row *sdv_row_of(const sdv_stencil_maker *make, int point)
{
    const subdiv_surface *surface = make->surface;
    int step = make->steps[point], level = step / 2, first = make->work_count;
    int limit = surface->rules.limit && step == sdv_last_step(make);
    sdv_stencil_row *room = &make->room[step];
    if (make->rows[point]) {
        sdv_batch_row(make, make->batches[point], make->rows[point], room);
    } else if (level > 1 || limit) {
        if (point < first) first = make->bases[level];
        sdv_grid_row_of(make, level, limit, point - first, room);
    } else {
        first += surface->order.first_inside_point;
        if (level == 0) first = sdv_first_face_point(surface);
        sdv_face_stencil(surface, point - first, room);
    }
    return room;
}

// Adds the points of a row, w times.
static void sdv_add_row(sdv_stencil_maker *make, const sdv_stencil_row *row, const double *w)
{
    double product[SDV_PARTS];
    int part = row->limit ? row->count : 0;
    for (int i = row->count - 1; i >= 0; i--) {
        for (int k = 0; k < make->parts; k++) product[k] = row->weights[part * k + i] * w[k];
        sdv_add_work_point(make, row->points[i], product);
    }
}

// Makes a sum known, that of a work point.
static void sdv_keep_sum(sdv_stencil_maker *make, int point)
{
    sdv_entry *entry = (sdv_entry *)sdv_array_room(make->context, &make->known,
                                                   (size_t)make->size, sizeof *entry);
    for (int i = 0; i < make->size && entry; i++) {
        entry[i].vertex = make->vertices[i];
        entry[i].weight = make->sums[make->parts * i];
    }
    make->starts[point] = make->known.count;
    make->sizes[point] = make->size;
    if (entry) make->known.count += (size_t)make->size;
}

// Makes work points known, each after those that it is made from.
static void sdv_compose(sdv_stencil_maker *make, const int *points, int count)
{
    const double one[SDV_PARTS] = { 1 };
    for (; count > 0; count--, points++) {
        int point = *points, any_long = 0;
        if (point < make->surface->cage_vertex_count || make->sizes[point]) continue;
        const sdv_stencil_row *row = sdv_row_of(make, point);
        sdv_compose(make, row->points, row->count);
        if (make->context->result) return;
        for (int i = 0; i < row->count; i++) any_long |= make->sizes[row->points[i]] == SDV_LONG;
        if (!any_long) sdv_add_row(make, row, one);
        if (any_long || make->size > SDV_LONGEST_KNOWN) make->sizes[point] = SDV_LONG;
        else sdv_keep_sum(make, point);
        sdv_end_sum(make);
    }
}

// Takes number i out of the sum; the last one gets its place.
static void sdv_take_from_sum(sdv_stencil_maker *make, int i, double *w)
{
    int last = --make->size;
    for (int k = 0; k < make->parts; k++) {
        double *sum = make->sums + k;
        w[k] = sum[make->parts * i];
        sum[make->parts * i] = sum[make->parts * last];
    }
    make->places[make->vertices[last]] = i;
    make->places[make->vertices[i]] = -1;
    make->vertices[i] = make->vertices[last];
}

// Replaces each long point by what it is made of, once: when all that are made of it have been.
static void sdv_expand_sum(sdv_stencil_maker *make)
{
    int step = 0;
    for (int i = 0; i < make->size; i++)
        if (make->vertices[i] >= make->surface->cage_vertex_count &&
            make->steps[make->vertices[i]] > step) step = make->steps[make->vertices[i]];
    for (; step > 0; step--)
        for (int i = 0; i < make->size; ) {
            int point = make->vertices[i];
            double w[SDV_PARTS];
            if (point < make->surface->cage_vertex_count || make->steps[point] != step) {
                i++;
                continue;
            }
            const sdv_stencil_row *row = sdv_row_of(make, point);
            sdv_take_from_sum(make, i, w);
            sdv_add_row(make, row, w);
        }
}

// Gives what is missing from the total to the largest of count weights.
static void sdv_balance(double *weights, int count, int stride, double total)
{
    double *largest = weights;
    for (int i = 0; i < count; i++, weights += stride) {
        if (fabs(*weights) > fabs(*largest)) largest = weights;
        total -= *weights;
    }
    if (fabs(total) < HUGE_VAL) *largest += total;
}

// Makes weights 0 that are no more than rounding of the largest one. Among more than 16 weights the
// limit is lower, so that all weights left out add up to less than 2e-6 of the largest.
static void sdv_clean_part(sdv_stencil_maker *make, int part)
{
    double *sums = make->sums + part, largest = 0;
    int parts = make->parts;
    if (make->size == 0) return;                    // a face without a surface
    for (int i = 0; i < make->size; i++) largest = fmax(largest, fabs(sums[parts * i]));
    double rounding = (double)FLT_EPSILON * largest * fmin(1, 16.0 / make->size);
    for (int i = 0; i < make->size; i++) {
        double *w = &sums[parts * i];
        *w = fabs(*w) <= rounding ? 0 : (double)(float)*w;
    }
    sdv_balance(sums, make->size, parts, part == 0 ? 1 : 0);
}

static void sdv_sort(int *numbers, int count)
{
    int gap = 1;
    while (gap < count / 3) gap = 3 * gap + 1;
    for (; gap > 0; gap /= 3) {
        for (int i = gap; i < count; i++) {
            int number = numbers[i], at = i;
            for (; at >= gap && numbers[at - gap] > number; at -= gap)
                numbers[at] = numbers[at - gap];
            numbers[at] = number;
        }
    }
}

// Makes the sum stencil i.
static void sdv_write_stencil(sdv_stencil_maker *make, int i)
{
    sdv_expand_sum(make);
    size_t parts = (size_t)make->parts, size = (size_t)make->size;
    int *index = (int *)sdv_array_room(make->context, &make->indices, size, sizeof(int));
    float *weight = (float *)sdv_array_room(make->context, &make->weights, parts * size,
                                            sizeof(float));
    if (!index || !weight) return;
    for (int k = 0; k < make->parts; k++) sdv_clean_part(make, k);
    sdv_sort(make->vertices, make->size);
    for (int j = 0; j < make->size; j++) {
        int vertex = make->vertices[j], any = 0;
        const double *sum = make->sums + parts * (size_t)make->places[vertex];
        for (size_t k = 0; k < parts; k++) any |= fabs(weight[k] = (float)sum[k]) > 0;
        weight += any ? parts : 0;
        if (any) *index++ = vertex;
        make->indices.count += (size_t)any;
    }
    make->weights.count = parts * make->indices.count;
    make->offsets[i + 1] = make->indices.count;
    sdv_end_sum(make);
}

static size_t sdv_carve_stencils(const sdv_stencil_maker *make, subdiv_stencils *stencils,
                                 char *base)
{
    size_t size = 0, entries = make->indices.count, tangents = make->parts > 1 ? entries : 0;
    size_t seconds = make->parts > 3 ? entries : 0;
    stencils->offsets = SDV_CARVE(size_t, make->offsets, (size_t)stencils->count + 1, 1);
    stencils->indices = SDV_CARVE(int, sdv_items(&make->indices), entries, 1);
    stencils->weights = SDV_CARVE(float, NULL, entries, 1);
    stencils->du = SDV_CARVE(float, NULL, tangents, 1);
    stencils->dv = SDV_CARVE(float, NULL, tangents, 1);
    stencils->duu = SDV_CARVE(float, NULL, seconds, 1);
    stencils->duv = SDV_CARVE(float, NULL, seconds, 1);
    stencils->dvv = SDV_CARVE(float, NULL, seconds, 1);
    return size;
}

// Makes stencils of all that was made, in one block of its own, and frees the maker.
static void sdv_end_stencils(sdv_stencil_maker *make, int count, subdiv_stencils *stencils)
{
    subdiv_stencils made;
    memset(&made, 0, sizeof made);
    made.count = count;
    sdv_block *block = make->context->result ? NULL
                     : sdv_allocate(make->context, sdv_carve_stencils(make, &made, NULL));
    if (block) {
        const float *weights = (const float *)sdv_items(&make->weights);
        made.memory = block;
        sdv_carve_stencils(make, &made, (char *)(block + 1));
        float *parts[SDV_PARTS] = { made.weights, made.du, made.dv, made.duu, made.duv, made.dvv };
        for (size_t i = 0; i < make->indices.count; i++)
            for (int k = 0; k < make->parts; k++) parts[k][i] = *weights++;
        *stencils = made;
    }
    sdv_array_free(&make->known);
    sdv_array_free(&make->indices);
    sdv_array_free(&make->weights);
    sdv_arena_free(&make->arena);
}

// Point i of the result.
static void sdv_add_point(sdv_stencil_maker *make, int i)
{
    const double one[3] = { 1, 0, 0 }, all[3] = { 1, 1, 1 };
    if (make->surface->levels == 0) {
        sdv_add_work_point(make, i, one);
        return;
    }
    const sdv_stencil_row *row = sdv_row_of(make, make->work_count + i);
    sdv_compose(make, row->points, row->count);
    if (!make->context->result) sdv_add_row(make, row, row->limit ? all : one);
}

SUBDIV_DEF subdiv_result subdiv_refined_stencils(subdiv_stencils *stencils,
                                                 const subdiv_surface *surface,
                                                 int first_point, int point_count,
                                                 const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    if (stencils) memset(stencils, 0, sizeof *stencils);
    if (!stencils || !surface) sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    if (surface) sdv_check_result(&context, surface);
    if (!context.result) sdv_check_range(&context, surface, 0, 0, first_point, point_count);
    if (context.result) return context.result;
    sdv_stencil_maker make;
    sdv_stencil_maker_new(&context, &make, sdv_maker(surface), point_count);
    for (int i = 0; i < point_count && !context.result; i++) {
        sdv_add_point(&make, first_point + i);
        if (!context.result) sdv_write_stencil(&make, i);
    }
    sdv_end_stencils(&make, point_count, stencils);
    return context.result;
}

SUBDIV_DEF void subdiv_stencils_free(subdiv_stencils *stencils)
{
    if (!stencils) return;
    sdv_free_memory(stencils->memory);
    memset(stencils, 0, sizeof *stencils);
}

#ifndef SUBDIV_NO_EXACT
// Finds how a part of a patch weighs its control points in a point and its derivatives. weights
// [16], of which Loop has 12.
static void sdv_patch_weights(const subdiv_surface *surface, const sdv_patch *patch, int part,
                              const sdv_leaf *at, double (*weights)[SDV_PARTS])
{
    double c[SDV_SLOTS][4], values[SDV_PARTS][4];
    for (int i = 0; i < sdv_control_points(&surface->rules); i++) {
        if (i % 4 == 0) {
            sdv_unit_polynomial(surface, patch, part, i, c);
            sdv_sum_powers((const double (*)[4])c, surface->rules.loop, at->x, at->y, at->sx,
                           at->sy, 2, values);
        }
        for (int k = 0; k < SDV_PARTS; k++) weights[i][k] = values[k][i % 4];
    }
}

// Adds work points, weights [SDV_PARTS * count] times.
static void sdv_add_work_points(sdv_stencil_maker *make, const int *points, int count,
                                const double *weights)
{
    sdv_compose(make, points, count);
    for (int i = 0; i < count && !make->context->result; i++)
        sdv_add_work_point(make, points[i], weights + SDV_PARTS * i);
}

// Adds the control points of a patch, or of the part of it that a location is on.
static void sdv_add_leaf_patch(sdv_stencil_maker *make, sdv_leaf leaf)
{
    const subdiv_surface *surface = make->surface;
    double weights[16][SDV_PARTS];
    sdv_find_polynomial(surface, &leaf);
    sdv_patch_weights(surface, leaf.patch, (int)leaf.polynomial - leaf.patch->polynomial, &leaf,
                      weights);
    sdv_add_work_points(make, leaf.patch->points, sdv_control_points(&surface->rules), weights[0]);
}

// In a nest, weights go the way back from the patch to the nest's points: each point that a row
// makes gives its weights to the points of the row, which takes as long as one evaluation. Weights
// w [SDV_PARTS * work_count] are those of a point and its derivatives as seen from the vertex: of
// the nest's points, then of the points of the next level.

// Gives the weights of a row's point to the points that the row sums. Nothing fades in a nest, so
// its rows have no weights of their own.
static void sdv_unrefine_row(const sdv_shape *shape, const int *row, double *w)
{
    const int *point = row + sdv_row_points(shape);         // the last one
    const double *from = w + SDV_PARTS * (size_t)row[0];
    double left = 1;
    for (int k = 3; k-- > 0; ) {
        for (int i = 0; i < shape->count[k]; i++, point--)
            for (int c = 0; c < SDV_PARTS; c++)
                w[SDV_PARTS * *point + c] += (double)shape->weight[k] * from[c];
        left -= shape->count[k] * (double)shape->weight[k];
    }
    for (int c = 0; c < SDV_PARTS; c++) w[SDV_PARTS * *point + c] += left * from[c];
}

static void sdv_unrefine_nest(const sdv_nest_kind *kind, double *w)
{
    for (int k = 2; k-- > 0; )
        for (int b = 0; b < kind->refine[k].starts[kind->refine[k].blocks]; b++) {
            const sdv_batch *batch = &kind->refine[k].items[b];
            const int *row = batch->items;
            for (int i = 0; i < batch->rows; i++, row += 1 + sdv_row_points(&batch->shape))
                sdv_unrefine_row(&batch->shape, row, w);
        }
}

// Goes back from a nest to the level before: sdv_nest_descend backwards. The point is base + shrink
// w: shrink is halved when w is doubled, and as base follows the vertex, the vertex has what the
// others leave of 1. Derivatives are those of w.
static void sdv_ascend_nest(const sdv_nest_kind *kind, double *w)
{
    static const double doubled[SDV_PARTS] = { 1, 2, 2, 4, 4, 4 };
    double *vertex = w + SDV_PARTS * kind->below[0];
    for (int i = SDV_PARTS * kind->points; i < SDV_PARTS * kind->work_count; i++) w[i] = 0;
    vertex[0] = 1;
    for (int i = 0; i < SDV_PARTS * kind->points; i++) {
        int part = i % SDV_PARTS;
        double weight = doubled[part] * w[i];
        w[i] = 0;
        w[SDV_PARTS * kind->below[i / SDV_PARTS] + part] += weight;
        vertex[part] -= weight;
    }
}

// Adds the weights of the child of a nest's face at (x, y), which is not in the next nest.
static void sdv_weigh_child(const subdiv_surface *surface, const sdv_nest_kind *kind, int face,
                            double x, double y, double *w)
{
    double weights[16][SDV_PARTS], scale = 1;
    int child = sdv_descend(surface->rules.loop, &x, &y, &scale);
    const sdv_patch *patch = sdv_nest_patch(kind, face, child, 0);
    sdv_leaf at = { patch, -1, 0, 0, x, y, scale, scale };
    sdv_patch_weights(surface, patch, 0, &at, weights);
    for (int i = 0; i < sdv_control_points(&surface->rules); i++)
        for (int k = 0; k < SDV_PARTS; k++) w[SDV_PARTS * patch->points[i] + k] += weights[i][k];
}

// Sets the weights of the vertex of a nest, as sdv_nest_vertex does.
static void sdv_weigh_masks(const sdv_nest_kind *kind, int face, double *w)
{
    const double *limit = kind->limit, *t0 = limit + kind->points, *t1 = t0 + kind->points;
    double n = (kind->ring ? 1.0 : 2.0) * kind->faces;
    for (int i = 0; i < SDV_PARTS * kind->points; i++) w[i] = 0;
    for (int i = 0; i < kind->points; i++) w[SDV_PARTS * i] = limit[i];
    for (int k = 0; k < 2; k++) {
        double along = sdv_cosine(face + k, n), across = sdv_sine(face + k, n);
        for (int i = 0; i < kind->points; i++)
            w[SDV_PARTS * i + 1 + k] = along * t0[i] + across * t1[i];
    }
}

// Weighs the points of a nest at (x, y) on a face of it, as sdv_sample_nest does.
static void sdv_weigh_nest(const subdiv_surface *surface, const sdv_nest_kind *kind, int face,
                           double x, double y, double *w)
{
    int down = sdv_nest_levels(surface->rules.loop, x, y);
    if (x <= 0 && y <= 0) {
        sdv_weigh_masks(kind, face, w);
        return;
    }
    for (int i = 0; i < SDV_PARTS * kind->work_count; i++) w[i] = 0;
    sdv_weigh_child(surface, kind, face, ldexp(x, down), ldexp(y, down), w);
    sdv_unrefine_nest(kind, w);
    for (int i = 0; i < down; i++) {
        sdv_ascend_nest(kind, w);
        sdv_unrefine_nest(kind, w);
    }
}

// Adds the points of a nest.
static void sdv_add_leaf_nest(sdv_stencil_maker *make, const sdv_leaf *leaf, double *w)
{
    const subdiv_surface *surface = make->surface;
    const sdv_exact *exact = surface->exact;
    const sdv_nest_face *face = &exact->nest_faces[leaf->nest_face];
    const sdv_nest *nest = &exact->nests[face->nest];
    const sdv_nest_kind *kind = &exact->kinds[nest->kind];
    const signed char *t = sdv_turns[surface->rules.loop][face->turn];
    double x, y;
    sdv_nest_place(surface->rules.loop, face->turn, leaf->x, leaf->y, &x, &y);
    sdv_weigh_nest(surface, kind, leaf->nest_face - nest->face, x, y, w);
    for (int i = 0; i < kind->points; i++)
        sdv_turn_derivatives(w + SDV_PARTS * i, 1, t, leaf->sx, 2);
    sdv_add_work_points(make, exact->nest_points + nest->first, kind->points, w);
}

SUBDIV_DEF subdiv_result subdiv_stencils_at(subdiv_stencils *stencils,
                                            const subdiv_surface *surface, int count,
                                            const subdiv_location *locations,
                                            const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    subdiv_derivatives none;
    memset(&none, 0, sizeof none);
    if (stencils) memset(stencils, 0, sizeof *stencils);
    if (!stencils || !surface) sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    else sdv_check_exact(&context, surface, 4, count, locations, &none);
    if (!context.result) sdv_check_locations(&context, surface, count, locations);
    if (context.result) return context.result;
    sdv_stencil_maker make;
    sdv_stencil_maker_new(&context, &make, surface, count);
    double *w = SDV_NEW(&context, &make.arena, double,
                        SDV_PARTS * (size_t)surface->exact->most_work);
    for (int i = 0; i < count && !context.result; i++) {
        sdv_spot spot = sdv_spot_of(surface, &locations[i]);
        sdv_leaf leaf = sdv_locate(surface, &spot);
        if (leaf.nest_face >= 0) sdv_add_leaf_nest(&make, &leaf, w);
        else if (leaf.patch) sdv_add_leaf_patch(&make, leaf);
        if (!context.result) sdv_write_stencil(&make, i);
    }
    sdv_end_stencils(&make, count, stencils);
    return context.result;
}
#endif // SUBDIV_NO_EXACT

#ifndef SUBDIV_NO_EXACT
// ---------------------------------------------------------------------------------- >>tiles
// THE ORDER OF THE RESULT with a rate for each edge and for the inside of each face. A tile is a
// face of the cage with a grid of its own: a quad has columns x rows pieces, a triangle under Loop
// columns pieces a side, any other polygon one quad of columns x columns pieces for each of its
// vertices. Where the edges cut the face as its grid does, the face is that grid. Elsewhere the
// grid loses its outermost pieces, and strips join the outline of the other pieces, the ring, with
// the edges:
//
//     +--o-----o--+                ring: here 2 pieces and corners, which are joined with the
//     | /|\   /|\ |                vertices of the face
//     |/ | \ / | \|
//     o--+--o--+--o                edge: here 3 pieces

typedef struct sdv_inside {
    int columns, rows;                  // of the grid
    int margin;                         // pieces that strips replace at column 0 and row 0,
    int last;                           // and at the last column and row
    int across;                         // the one side that is joined with the side across, or -1
    int most;                           // pieces along a side, of the grid or of an edge
} sdv_inside;

typedef struct sdv_tiling {             // points of a cage, or of the topology of its UVs
    const sdv_level *cage;
    const unsigned char *hole;          // [face_count]
    int         loop;
    int        *edge_rates;             // [edge_count]
    sdv_inside *insides;                // [face_count]
    int        *starts;                 // [edge_count + face_count + 1] the first point inside each
    const int  *home;                   // see sdv_exact
    int         count;                  // of points
    const sdv_sides *sides;             // writes normals instead of points; NULL: points
    int        *side_starts;            // [sides->edges] the first normal of each
    int         normal_count;
} sdv_tiling;

typedef struct sdv_tile {               // one face of a tiling
    const sdv_tiling *tiling;
    const int *vertices, *edges;        // [sides]
    int first, sides;                   // its face-vertices
    int inside;                         // its first point
    int loop, ngon;
    sdv_inside *grid;
} sdv_tile;

static sdv_tile sdv_tile_at(const sdv_tiling *tiling, int f)
{
    const sdv_level *cage = tiling->cage;
    sdv_tile tile;
    tile.tiling = tiling;
    tile.first = sdv_face_start(cage, f);
    tile.sides = sdv_face_end(cage, f) - tile.first;
    tile.vertices = cage->face_vertices + tile.first;
    tile.edges = cage->face_edges + tile.first;
    tile.inside = tiling->starts[cage->edge_count + f];
    tile.loop = tiling->loop;
    tile.ngon = !tile.loop && tile.sides != 4;
    tile.grid = &tiling->insides[f];
    return tile;
}

static int sdv_edge_rate(const sdv_tile *tile, int side)
{
    return tile->tiling->edge_rates[tile->edges[side]];
}

// Returns the other side of a crease that the tile is on at its vertex i, or its side i; or -1.
static int sdv_vertex_side(const sdv_tile *tile, int i)
{
    return tile->tiling->sides ? tile->tiling->sides->vertex[tile->first + i] : -1;
}

static int sdv_edge_side_of(const sdv_tile *tile, int i)
{
    return tile->tiling->sides ? tile->tiling->sides->edge[tile->first + i] : -1;
}

// Returns the point at vertex i, or its normal.
static int sdv_tile_vertex(const sdv_tile *tile, int i)
{
    int side = sdv_vertex_side(tile, i);
    return side < 0 ? tile->vertices[i] : tile->tiling->count + side;
}

// Pieces of the grid along a side.
static int64_t sdv_side_rate(const sdv_tile *tile, int side)
{
    if (tile->ngon) return 2 * (int64_t)tile->grid->columns;
    return side % 2 ? tile->grid->rows : tile->grid->columns;
}

static int sdv_is_regular(const sdv_tile *tile)
{
    for (int i = 0; i < tile->sides; i++)
        if (sdv_edge_rate(tile, i) != sdv_side_rate(tile, i)) return 0;
    return 1;
}

// Finds the grid of a face: of its rate or, if that is 0, of the rates of its edges. A grid with
// strips has at least one point inside, to which they lead. A quad of one row or column, as two of
// its rates are 1, needs none: its other sides are joined with each other.
static void sdv_find_inside(const sdv_tiling *tiling, int f, int rate)
{
    sdv_tile tile = sdv_tile_at(tiling, f);
    sdv_inside *grid = tile.grid;
    int quad = !tile.loop && !tile.ngon, most[2] = { 1, 1 };    // of the even and the odd sides
    for (int i = 0; i < tile.sides; i++) {
        int *m = &most[quad && i % 2], edge = sdv_edge_rate(&tile, i);
        if (edge > *m) *m = edge;
    }
    grid->columns = rate ? rate : most[0];
    grid->rows = rate ? rate : most[1];
    if (tile.ngon) grid->columns = grid->columns / 2 + grid->columns % 2;
    if (!quad) grid->rows = grid->columns;
    int least = tile.ngon || sdv_is_regular(&tile) ? 1 : tile.loop ? 3 : 2;
    if (grid->columns < least && (!quad || most[0] > 1)) grid->columns = least;
    if (grid->rows < least && (!quad || most[1] > 1)) grid->rows = least;
    grid->margin = !sdv_is_regular(&tile);
    grid->across = !quad || !grid->margin ? -1 : grid->rows == 1 ? 0 : grid->columns == 1 ? 1 : -1;
    if (grid->across == 0) grid->columns = sdv_edge_rate(&tile, 2);
    if (grid->across == 1) grid->rows = sdv_edge_rate(&tile, 3);
    int edge = most[0] > most[1] ? most[0] : most[1], pieces = (edge - 1) / (1 + tile.ngon) + 1;
    grid->most = grid->columns > grid->rows ? grid->columns : grid->rows;
    if (pieces > grid->most) grid->most = pieces;
    grid->last = tile.ngon ? 0 : grid->margin << tile.loop;
}

// How many points are inside a face.
static uint64_t sdv_count_inside(const sdv_tiling *tiling, int f)
{
    sdv_tile tile = sdv_tile_at(tiling, f);
    uint64_t columns = (uint64_t)tile.grid->columns, rows = (uint64_t)tile.grid->rows;
    if (tile.loop) return (columns - 1) * (columns - 2) / 2;
    if (!tile.ngon) return (columns - 1) * (rows - 1);
    if (columns > 65536) return INT_MAX;                    // or the product would wrap
    return 1 + (uint64_t)tile.sides * columns * (columns - 1);
}

// The points on a side, from its first vertex or, backwards, the other.
static sdv_side sdv_tile_side(const sdv_tile *tile, int side, int backwards)
{
    int a = tile->vertices[side], b = tile->vertices[side + 1 < tile->sides ? side + 1 : 0];
    int other = sdv_edge_side_of(tile, side);
    int start = other < 0 ? tile->tiling->starts[tile->edges[side]]
                          : tile->tiling->side_starts[other];
    return sdv_seen_side(start, sdv_edge_rate(tile, side), (a > b) != backwards);
}

// Fills in the grid of a face (of an n-gon: of its quad at vertex i). Its sides are the edges of
// the face: with strips, not as the grid is cut.
static void sdv_tile_grid(const sdv_tile *tile, int i, sdv_grid *grid)
{
    int last = tile->sides - 1;
    if (tile->ngon) {
        sdv_ngon_grid(sdv_tile_vertex(tile, i), sdv_tile_side(tile, i, 0),
                      sdv_tile_side(tile, i > 0 ? i - 1 : last, 1), tile->inside, tile->sides,
                      tile->grid->columns, i, grid);
        return;
    }
    grid->columns = tile->grid->columns;
    grid->rows = tile->grid->rows;
    grid->triangle = tile->loop;
    grid->frame = 0;
    grid->inside = tile->inside;
    for (int k = 0; k <= last; k++) {
        grid->corner[k] = sdv_tile_vertex(tile, k);
        grid->side[k] = sdv_tile_side(tile, k, k >= 2);
    }
    grid->side[3] = grid->side[last];
}

// The place where faces are written; if an array is NULL, they are only counted.
typedef struct sdv_faces_at {
    int  triangles;                     // quads are cut
    int *vertices, *sizes;
    size_t faces, face_vertices;
} sdv_faces_at;

// size 3: the triangle a b c.
static inline void sdv_put_face(sdv_faces_at *out, int size, int a, int b, int c, int d)
{
    int *v = out->vertices ? out->vertices + out->face_vertices : NULL;
    if (v && size == 3) sdv_put_face3(v, a, b, c);
    else if (v) sdv_put_face4(v, a, b, c, d);
    if (out->sizes) out->sizes[out->faces] = size;
    out->faces++;
    out->face_vertices += (size_t)size;
}

// Cuts quads in two, from the last on, and returns where the triangles end.
static int *sdv_cut_quads(int *faces, const int *end)
{
    size_t count = (size_t)(end - faces) / 4;
    for (size_t i = count; i-- > 0;) {
        const int *q = faces + 4 * i;
        int a = q[0], b = q[1], c = q[2], d = q[3];
        sdv_put_face3(sdv_put_face3(faces + 6 * i, a, b, c), a, c, d);
    }
    return faces + 6 * count;
}

// Puts the faces that are pieces of the grid.
static void sdv_put_inside(const sdv_tile *tile, sdv_faces_at *out)
{
    const sdv_inside *in = tile->grid;
    int grids = tile->ngon ? tile->sides : in->across < 0, cut = out->triangles && !tile->loop;
    int margin = in->margin, right = in->columns - in->last, top = in->rows - in->last;
    size_t size = out->triangles ? 3 : 4;
    size_t pieces = (size_t)grids * (size_t)(right - margin) * (size_t)(top - margin);
    int *faces = out->vertices ? out->vertices + out->face_vertices : NULL;
    for (int i = 0; i < grids && pieces && faces; i++) {
        sdv_grid grid;
        sdv_tile_grid(tile, i, &grid);
        int *end = sdv_grid_faces(&grid, margin, top, margin, right + tile->loop * margin, faces);
        faces = cut ? sdv_cut_quads(faces, end) : end;
    }
    if (cut) pieces *= 2;
    for (size_t i = 0; i < pieces && out->sizes; i++) out->sizes[out->faces + i] = (int)size;
    out->faces += pieces;
    out->face_vertices += size * pieces;
}

// Point j of the ring along a side, from the ring's corner at vertex 0 of that side on. Of an n-gon
// the grids are those at the side's two vertices.
static int sdv_ring_point(const sdv_tile *tile, int side, const sdv_grid grids[2], int j)
{
    const sdv_inside *in = tile->grid;
    if (tile->ngon && j >= in->columns)
        return sdv_grid_index(&grids[1], 2 * in->columns - 1 - j, 1);
    if (tile->ngon) return sdv_grid_index(grids, 1, j + 1);
    const int (*at)[2] = sdv_corners[tile->loop] + side;
    int row = (at[0][0] ? in->rows - in->last : in->margin) + j * (at[1][0] - at[0][0]);
    int column = (at[0][1] ? in->columns - in->last : in->margin) + j * (at[1][1] - at[0][1]);
    return sdv_grid_index(grids, row, column);
}

// The strip between a side and the ring, which is above it: whichever piece has its middle first is
// joined to the point reached on the other line, and two at once are a quad. In halves of a piece,
// middle i of n is 2i + 1 along the side, and those of the ring are 2 behind (in a triangle's,
// which is narrower, 3). The side across is as long as a ring with one more piece at either end.
static void sdv_put_strip(const sdv_tile *tile, int side, const sdv_grid grids[2],
                          sdv_faces_at *out)
{
    int next = side + 1 < tile->sides ? side + 1 : 0, pieces = sdv_edge_rate(tile, side);
    int rate = (int)sdv_side_rate(tile, side), inset = 2 + tile->loop;
    int more = tile->grid->across == side, ring = rate - inset + more;
    sdv_side edge = sdv_tile_side(tile, side, 0);
    int a = sdv_tile_vertex(tile, side), d = sdv_ring_point(tile, side, grids, -more);
    for (int i = 0, j = -more; i < pieces || j < ring;) {
        int64_t here = (2 * (int64_t)i + 1) * rate;
        int64_t there = (2 * (int64_t)j + 1 + inset) * pieces;
        int on = i < pieces && (j == ring || here <= there);
        int up = j < ring && (i == pieces || there <= here);
        i += on;
        j += up;
        int b = i == pieces ? sdv_tile_vertex(tile, next) : edge.first + edge.step * i;
        int c = up ? sdv_ring_point(tile, side, grids, j) : d;
        int quad = on && up && !out->triangles;
        if (on && up) sdv_put_face(out, quad ? 4 : 3, a, b, c, d);
        if (!quad) sdv_put_face(out, 3, a, up ? c : b, d, d);
        if (on) a = b;
        d = c;
    }
}

// Puts all faces of a tile.
static void sdv_put_tile(const sdv_tiling *tiling, int f, sdv_faces_at *out)
{
    sdv_tile tile = sdv_tile_at(tiling, f);
    sdv_grid grids[2];
    sdv_put_inside(&tile, out);
    for (int i = 0; i < tile.sides && tile.grid->margin; i++) {
        if (tile.ngon || i == 0) sdv_tile_grid(&tile, i, &grids[0]);
        if (tile.ngon) sdv_tile_grid(&tile, (i + 1) % tile.sides, &grids[1]);
        if (tile.grid->across < 0 || tile.grid->across == i) sdv_put_strip(&tile, i, grids, out);
    }
}

// Makes a tiling without rates.
static sdv_tiling sdv_new_tiling(sdv_context *context, sdv_arena *arena,
                                 const subdiv_surface *surface)
{
    const sdv_level *cage = &surface->order.cage;
    size_t edges = (size_t)cage->edge_count, faces = (size_t)cage->face_count;
    sdv_tiling tiling;
    memset(&tiling, 0, sizeof tiling);
    tiling.cage = cage;
    tiling.hole = surface->exact->hole;
    tiling.home = surface->exact->home;
    tiling.loop = surface->rules.loop;
    tiling.edge_rates = SDV_NEW(context, arena, int, edges);
    tiling.insides = SDV_NEW(context, arena, sdv_inside, faces);
    tiling.starts = SDV_NEW(context, arena, int, edges + faces + 1);
    if (!context->result) memset(tiling.starts, 0, (edges + faces + 1) * sizeof(int));
    return tiling;
}

// Finds where the points stand: those inside each edge, then those inside each face; none where
// there is no surface. Returns how many there are.
static int sdv_place_points(sdv_context *context, sdv_tiling *tiling)
{
    const sdv_level *cage = tiling->cage;
    int edges = cage->edge_count, all = edges + cage->face_count;
    uint64_t count = (uint64_t)cage->vertex_count;
    for (int i = 0; i < all && count <= INT_MAX; i++) {
        int f = i - edges, home = f < 0 ? tiling->home[cage->vertex_count + i] : -1;
        tiling->starts[i] = (int)count;
        if (home >= 0) count += (uint64_t)tiling->edge_rates[i] - 1;
        if (f >= 0 && tiling->hole[f] != SDV_DROPPED) count += sdv_count_inside(tiling, f);
    }
    if (count > INT_MAX)
        sdv_fail(context, SUBDIV_ERROR_TOO_LARGE,
                 "these rates make more than %d vertices", INT_MAX);
    return tiling->count = tiling->starts[all] = context->result ? 0 : (int)count;
}

// Finds where the normals of the other sides of creases stand: behind those of the points, first
// those at vertices. Returns how many normals there are.
static int sdv_place_sides(sdv_context *context, sdv_arena *arena, sdv_tiling *tiling,
                           const sdv_sides *sides)
{
    int64_t count = (int64_t)tiling->count + sides->vertices;
    tiling->sides = sides;
    tiling->side_starts = SDV_NEW(context, arena, int, sides->edges);
    for (int i = 0; i < sides->edges && count <= INT_MAX && !context->result; i++) {
        tiling->side_starts[i] = (int)count;
        count += tiling->edge_rates[tiling->cage->face_edges[sides->edge_home[i]]] - 1;
    }
    if (count > INT_MAX)
        sdv_fail(context, SUBDIV_ERROR_TOO_LARGE, "these rates make more than %d normals", INT_MAX);
    return tiling->normal_count = context->result ? 0 : (int)count;
}

// --------------------------------------------------------------------------- >>tile-points
// The points of a tiling on the limit surface, leaf by leaf of the tree.

// Makes work points of SUBDIV_EXACT from values of up to four channels.
static sdv_exact_work sdv_begin_source(sdv_context *context, sdv_arena *arena,
                                       const subdiv_surface *surface, int channels,
                                       const float *in, const subdiv_options *opt)
{
    sdv_exact_work source = { surface, channels, in, (size_t)channels, NULL, 0, 1 };
    source.points = SDV_NEW(context, arena, double, 4 * (size_t)surface->work_count);
    if (source.points) sdv_make_exact_work(&source, opt);
    return source;
}

// A leaf of the exact surface covers an area of the grid of its face (a turned triangle the upper
// half of a square, any other triangle the lower), and makes the points that are there. A point
// between two areas belongs to the one that is nearer to the middle of the grid or, if it is on an
// edge of the face, of the edge:
//
//     +---+---+       So the face of a nest that is left after some levels has no points but its
//     | > | < |       vertex as soon as it is as small as the pieces of the grid. In triangles the
//     +---+---+       middle is where u, v and 1 - u - v are 1/3: no line between areas, which
//     | > | < |       are at multiples of 2^-bits, is there.
//     +---+---+

// The maker of a tiling's points. Each job has a copy.
typedef struct sdv_leaf_points {
    const sdv_tiling *tiling;
    const sdv_exact_work *source;
    void    *user;                      // of the allocator
    int      jobs;
    unsigned char *failed;              // [jobs]
    int      points;                    // the first points of the tiling, or all of them and the
    sdv_window out;                     // normals of other sides
    sdv_tangents tangents;              // of these
    // The leaf at hand, or a part of it:
    sdv_tile tile;
    int      corner;                    // whose quad of an n-gon it is
    sdv_grid grid;
    sdv_area area;
    const sdv_patch *patch;
    const sdv_nest_state *nest;         // whose points the patch has, or NULL
    sdv_nest_sample *vertex;            // not NULL: the last face of a nest, instead of a patch
    int      part, ready;               // part: its number, if the patch is cut into strips
    sdv_four polynomial[25];            // made for the first line: then it is ready
} sdv_leaf_points;

static int64_t sdv_units(const sdv_area *area)
{
    return (int64_t)1 << area->bits;
}

// The part of a quad where two strips cross.
static sdv_area sdv_area_of_part(sdv_area area, const sdv_strip *along, const sdv_strip *up)
{
    const int64_t whole = 1 << SDV_STRIP_LEVELS;
    int64_t x = area.left * whole, y = area.bottom * whole;
    sdv_area made = { area.bits + SDV_STRIP_LEVELS, x + along->from, x + along->to, y + up->from,
                      y + up->to, area.step, area.sx * ((double)whole / along->unit),
                      area.sy * ((double)whole / up->unit),
                      (area.x * (double)whole + along->origin) / along->unit,
                      (area.y * (double)whole + up->origin) / up->unit };
    return made;
}

// Makes the polynomial of a nest's innermost faces: the plane of its vertex.
static void sdv_vertex_plane(sdv_nest_sample *vertex, double (*c)[4])
{
    sdv_nest_vertex(vertex);
    memset(c, 0, SDV_SLOTS * sizeof *c);
    memcpy(c[0], vertex->values[0], sizeof *c);
    memcpy(c[1], vertex->tangents[0], sizeof *c);
    memcpy(c[4], vertex->tangents[1], sizeof *c);
}

// Makes the polynomial of the leaf at hand.
static void sdv_make_leaf_polynomial(sdv_leaf_points *l)
{
    int loop = l->tile.loop;
    const double *work = l->nest ? l->nest->w : l->source->points;
    double c[SDV_SLOTS][4];
    float slots[4 * SDV_SLOTS];
    if (l->vertex) sdv_vertex_plane(l->vertex, c);
    else sdv_make_polynomial(l->source->surface, l->patch, l->part, work, c);
    sdv_keep_polynomial(c[0], l->vertex ? NULL : l->nest, 4, slots);
    if (!loop) memcpy(l->polynomial, slots, sizeof slots);
    for (int k = 0; k < 14 && loop; k++)
        l->polynomial[sdv_powers[1][k][0] + 5 * sdv_powers[1][k][1]] = sdv_load(slots + 4 * k);
}

// Points k from first to last on a line of the grid, at (u + k du, v + k dv).
typedef struct sdv_line_points {
    int64_t first, last;
    double  u, v, du, dv;
    int     index, step;                // of point first, and from point to point
} sdv_line_points;

// Puts points of a line: a row at v = t or, turned, a column at u = t.
SDV_INLINE void sdv_put_tile_line(const sdv_leaf_points *l, int loop, int turned, int tangents,
                                  const sdv_line_points *points, float t, double from, double by)
{
    const sdv_window *out = &l->out;
    sdv_curve curve;
    int index = points->index;
    sdv_make_curve(l->polynomial, loop, turned, tangents, t, &curve);
    for (int64_t k = points->first; k <= points->last; k++, index += points->step) {
        sdv_four x = sdv_all((float)(from + (double)k * by)), p[3], along[3], across[3];
        sdv_horner(curve.a, 1, 3 + loop, x, p);
        if (index < l->points)
            sdv_store_some(out->values + out->stride * (size_t)index, p[0], out->lanes);
        if (!tangents) continue;
        sdv_horner(curve.along, 1, 3, x, along);
        sdv_horner(curve.across, 1, 3, x, across);
        sdv_put_tangents(out, index, turned ? across[0] : along[0], turned ? along[0] : across[0],
                         -1);
    }
}

// Puts the points of a row, a column or else a slanted side, which only triangles have: there each
// point makes a row.
static void sdv_put_line(sdv_leaf_points *l, const sdv_line_points *line)
{
    if (line->first > line->last || line->index >= l->out.count) return;
    const sdv_area *area = &l->area;
    double u = area->step * (area->sx * line->u - area->x), du = area->step * area->sx * line->du;
    double v = area->step * (area->sy * line->v - area->y), dv = area->step * area->sy * line->dv;
    int row = fabs(dv) <= 0, column = fabs(du) <= 0 && !row, loop = l->tile.loop;
    int tangents = l->out.tangents != NULL;
    sdv_line_points part = *line;
    if (!l->ready++) sdv_make_leaf_polynomial(l);
    if (column && loop) sdv_put_tile_line(l, 1, 1, tangents, line, (float)u, v, dv);
    else if (column) sdv_put_tile_line(l, 0, 1, tangents, line, (float)u, v, dv);
    else if (!loop) sdv_put_tile_line(l, 0, 0, tangents, line, (float)v, u, du);
    else for (; part.first <= line->last; part.first = part.last + 1, part.index += part.step) {
        if (!row) part.last = part.first;
        sdv_put_tile_line(l, 1, 0, tangents, &part, (float)(v + (double)part.first * dv), u, du);
    }
}

typedef struct sdv_ticks { int64_t first, last; } sdv_ticks;

// The ticks of a side are its points k / rate, k = 1, 2, ... Counts those that belong to the areas
// before x, a place in units; the middle is at so many sixths of the grid. half: the side is a half
// of the edge that has the rate.
static int64_t sdv_ticks_before(const sdv_area *area, int64_t x, int sixths, int64_t rate, int half)
{
    int behind = 6 * x <= sixths * sdv_units(area);             // a tick at x belongs there
    return x > 0 ? (x * rate - behind) >> (area->bits + half) : 0;
}

// Finds the ticks inside a side that belong to an area from low to high.
static sdv_ticks sdv_find_ticks(const sdv_area *area, int64_t low, int64_t high, int sixths,
                                int rate, int half)
{
    sdv_ticks ticks = { sdv_ticks_before(area, low, sixths, rate, half) + 1,
                        sdv_ticks_before(area, high, sixths, rate, half) };
    if (ticks.last == rate) ticks.last--;
    return ticks;
}

// Puts the points inside the grid, row by row. In triangles u + v has ticks as u and v have.
static void sdv_put_area_inside(sdv_leaf_points *l)
{
    const sdv_area *area = &l->area;
    int columns = l->tile.grid->columns, rows = l->tile.grid->rows, loop = l->tile.loop;
    if (columns == 1 || rows == 1) return;
    int64_t slant = area->left + area->bottom + (area->step < 0);
    sdv_ticks along = sdv_find_ticks(area, area->left, area->right, 3 - loop, columns, 0);
    sdv_ticks up = sdv_find_ticks(area, area->bottom, area->top, 3 - loop, rows, 0), slanted = up;
    if (loop) slanted = sdv_find_ticks(area, slant, slant + 1, 4, columns, 0);
    for (int64_t j = up.first; j <= up.last; j++) {
        sdv_line_points row = { along.first, along.last, 0, (double)j / rows, 1.0 / columns, 0,
                                0, 1 };
        if (loop && row.first < slanted.first - j) row.first = slanted.first - j;
        if (loop && row.last > slanted.last - j) row.last = slanted.last - j;
        row.index = sdv_inside_point(l->grid.inside, columns, loop, (int)j, (int)row.first);
        sdv_put_line(l, &row);
    }
}

// Puts the points on a side of the grid, if this is where they are made. Of an n-gon's quad the
// sides are half an edge, the spoke that leads on from there, the spoke before, which the quad
// before makes, and half an edge without its middle.
static void sdv_put_area_side(sdv_leaf_points *l, int side)
{
    const sdv_area *area = &l->area;
    const sdv_tile *tile = &l->tile;
    const sdv_tiling *tiling = tile->tiling;
    int ngon = tile->ngon, spoke = ngon && side == 1, half = ngon && !spoke, backwards = side >= 2;
    const int *a = sdv_corners[tile->loop][side + backwards];
    const int *b = sdv_corners[tile->loop][side + !backwards];
    int before = l->corner > 0 ? l->corner - 1 : tile->sides - 1;
    int edge = !ngon ? side : side == 3 ? before : l->corner;
    int rate = spoke ? tile->grid->columns : sdv_edge_rate(tile, edge);
    int other = sdv_edge_side_of(tile, edge);
    int home = other >= 0 ? tiling->sides->edge_home[other]
                          : tiling->home[tiling->cage->vertex_count + tile->edges[edge]];
    if (ngon && side == 2) return;
    if (!spoke && home != tile->first + edge) return;
    sdv_ticks ticks = a[0] != b[0] ? sdv_find_ticks(area, area->bottom, area->top, 3, rate, half)
                                   : sdv_find_ticks(area, area->left, area->right, 3, rate, half);
    if (half && backwards && 2 * ticks.last == rate) ticks.last--;
    double step = (double)(1 + half) / rate;
    sdv_line_points line = { ticks.first, ticks.last, (double)a[1], (double)a[0],
                             (b[1] - a[1]) * step, (b[0] - a[0]) * step,
                             sdv_side_index(&l->grid, side, (int)ticks.first),
                             l->grid.side[side].step };
    sdv_put_line(l, &line);
}

// Puts a vertex of the grid, if this is where it is made: one of the face, or an n-gon's centre.
static void sdv_put_area_corner(sdv_leaf_points *l, int i)
{
    const sdv_tile *tile = &l->tile;
    const int *at = sdv_corners[tile->loop][i];
    int h = tile->ngon ? l->corner : i, centre = tile->ngon && i == 2;
    int other = sdv_vertex_side(tile, h);
    int here = (other >= 0 ? tile->tiling->sides->vertex_home[other]
                           : tile->tiling->home[tile->vertices[h]]) == tile->first + h;
    sdv_line_points point = { 0, 0, (double)at[1], (double)at[0], 0, 0, l->grid.corner[i], 0 };
    if (centre ? l->corner == 0 : here && (!tile->ngon || i == 0)) sdv_put_line(l, &point);
}

static void sdv_put_area(sdv_leaf_points *l)
{
    const sdv_area *area = &l->area;
    int loop = l->tile.loop, sides = loop ? 3 : 4;
    int64_t units = sdv_units(area), end = loop ? area->left + area->bottom + 1 : area->right;
    int meets[4] = { area->bottom == 0, end == units, loop ? area->left == 0 : area->top == units,
                     area->left == 0 };
    l->ready = 0;
    sdv_put_area_inside(l);
    for (int i = 0; i < sides && area->step > 0; i++) {
        if (!meets[i]) continue;
        sdv_put_area_side(l, i);
        if (meets[i > 0 ? i - 1 : sides - 1]) sdv_put_area_corner(l, i);
    }
}

// Takes the face of face-vertex h. Returns 0 if it has no surface.
static int sdv_begin_leaf(sdv_leaf_points *l, int h)
{
    const sdv_tiling *tiling = l->tiling;
    int f = sdv_face_of(tiling->cage, h);
    if (tiling->hole[f] == SDV_DROPPED) return 0;
    l->tile = sdv_tile_at(tiling, f);
    l->corner = l->tile.ngon ? h - l->tile.first : 0;
    sdv_tile_grid(&l->tile, l->corner, &l->grid);
    return 1;
}

static void sdv_put_patch_points(sdv_leaf_points *l, const sdv_patch *patch)
{
    const sdv_strips *strips = l->source->surface->exact->strips;
    const sdv_strip *cross[2];
    if (!sdv_begin_leaf(l, patch->h)) return;
    sdv_area area = sdv_area_at(patch->level - l->tile.ngon, patch->column, patch->row,
                                patch->step);
    int parts = sdv_patch_parts(strips, patch);
    l->patch = patch;
    for (l->part = 0; l->part < parts; l->part++) {
        if (patch->up) sdv_find_strips_of(strips, patch, l->part, cross);
        l->area = patch->up ? sdv_area_of_part(area, cross[0], cross[1]) : area;
        sdv_put_area(l);
    }
}

// Counts the levels after which a face of a nest has no points but its vertex: it is smaller than
// all pieces, or as large as the smallest one and in a corner of the grid, where other points
// belong to areas that are nearer to the middle.
static int sdv_nest_depth(const sdv_tile *tile, const sdv_nest_face *face)
{
    int most = tile->grid->most;
    sdv_area area = sdv_nest_area(tile->loop, tile->ngon, face, 0, 0);
    int64_t units = sdv_units(&area), x = (int64_t)area.x, y = (int64_t)area.y;
    int corner = (x == 0 || x == units) && (y == 0 || y == units), depth = 0;
    // The middle of an edge belongs to one of its two halves.
    for (; units < most || (units == most && (!corner || units <= 2)); units *= 2) depth++;
    return depth;
}

// Puts the points of a nest: level by level those of the children that are patches, then those of
// the faces that are left, from the points of the first level, as samples have them.
static void sdv_put_nest_points(sdv_leaf_points *l, int number, double *w)
{
    const subdiv_surface *surface = l->source->surface;
    const sdv_nest_face *faces = surface->exact->nest_faces + surface->exact->nests[number].face;
    sdv_nest_sample vertex;
    sdv_nest_state *nest = &vertex.state;
    int most = 0;
    sdv_nest_begin(nest, surface, number, l->source->points, w);
    sdv_nest_load(nest);
    for (int i = 0; i < nest->kind->faces; i++) {
        sdv_tile tile = sdv_tile_at(l->tiling, sdv_face_of(l->tiling->cage, faces[i].place.h));
        int depth = sdv_nest_depth(&tile, &faces[i]);
        if (depth > most) most = depth;
    }
    l->nest = nest;
    l->part = 0;
    vertex.made = -1;
    vertex.like = NULL;
    for (int depth = 0; depth <= most; depth++) {
        int last = depth == most;
        if (!last) sdv_nest_refine(nest);
        l->vertex = last ? &vertex : NULL;
        for (int i = 0; i < nest->kind->faces; i++) {
            vertex.face = i;
            if (!sdv_begin_leaf(l, faces[i].place.h)) continue;
            for (int child = last ? 0 : 1; child <= (last ? 0 : 3); child++) {
                l->area = sdv_nest_area(l->tile.loop, l->tile.ngon, &faces[i], depth, child);
                if (child) l->patch = sdv_nest_patch(nest->kind, i, child, faces[i].turn);
                sdv_put_area(l);
            }
        }
        if (!last) sdv_nest_descend(nest);
    }
}

// Patches of all levels, then nests.
static void sdv_tile_points_job(void *context, int job)
{
    sdv_leaf_points l = *(const sdv_leaf_points *)context;
    const subdiv_surface *surface = l.source->surface;
    const sdv_exact *exact = surface->exact;
    int patches = exact->patch_count, count = patches + exact->nest_count;
    int i = sdv_share(count, job, l.jobs), end = sdv_share(count, job + 1, l.jobs);
    sdv_context here = { SUBDIV_OK, NULL, l.user, NULL };
    sdv_arena arena = sdv_new_arena(0);
    double *w = NULL;
    if (l.tangents.normals) l.out.tangents = &l.tangents;
    for (; i < end && i < patches; i++) sdv_put_patch_points(&l, &exact->patches[i]);
    for (; i < end && !here.result; i++) {
        if (!w) w = SDV_NEW(&here, &arena, double, 4 * (size_t)exact->most_work);
        if (w) sdv_put_nest_points(&l, i - patches, w);
    }
    sdv_flush_tangents(&l.tangents);
    l.failed[job] = here.result != SUBDIV_OK;
    sdv_arena_free(&arena);
}

// Makes the first count points of a tiling and, unless NULL, their normals.
static void sdv_make_tile_points(sdv_context *context, const subdiv_options *opt,
                                 const sdv_tiling *tiling, const sdv_exact_work *source,
                                 float *points, float *normals, int count)
{
    const sdv_exact *exact = source->surface->exact;
    size_t channels = (size_t)source->channels;
    unsigned char failed[SDV_MOST_JOBS] = { 0 };
    sdv_leaf_points l;
    if (context->result) return;
    memset(&l, 0, sizeof l);
    l.tiling = tiling;
    l.source = source;
    l.user = context->user;
    l.jobs = sdv_jobs(opt, (int64_t)exact->patch_count + exact->nest_count, 64);
    l.failed = failed;
    l.points = count;
    if (tiling->sides && normals) count = tiling->normal_count;
    l.out = sdv_window_of(points, channels, source->channels, 0, count, 0);
    l.tangents.normals = normals;
    l.tangents.stride = 3;
    l.tangents.left_handed = source->surface->rules.left_handed;
    sdv_run(opt, sdv_tile_points_job, &l, l.jobs);
    if (memchr(failed, 1, sizeof failed))
        sdv_fail(context, SUBDIV_ERROR_MEMORY, "out of memory");
    for (int v = 0; v < tiling->cage->vertex_count; v++) {      // those without faces stay
        if (tiling->home[v] >= 0) continue;
        for (size_t c = 0; c < channels; c++)
            points[channels * (size_t)v + c] = (float)source->points[4 * (size_t)v + c];
        if (normals) memset(normals + 3 * (size_t)v, 0, 3 * sizeof(float));
    }
}

// --------------------------------------------------------------------------- >>tessellator
// From rates to a mesh.

// A tessellation at work.
typedef struct sdv_tessellator {
    const subdiv_surface *surface;
    const subdiv_tessellation *how;
    const subdiv_options *opt;
    sdv_arena  arena;
    sdv_tiling points, normals, uvs;
    sdv_exact_work positions;
    int        triangles;
    sdv_faces_at *first;                // [face_count + 1] where the faces of each begin
    subdiv_mesh mesh;                   // the result
    int        jobs;
} sdv_tessellator;

// The rate of face f in the user's list, or 0.
static int sdv_face_rate(const sdv_tessellator *t, int f)
{
    return t->how->face_rates ? t->how->face_rates[sdv_user_face(t->surface, f)] : 0;
}

// Gives an edge its rate, unless that is 0.
static void sdv_set_edge_rate(sdv_context *context, sdv_tessellator *t, int e, int rate)
{
    if (rate < 0) sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "edge %d: the rate is %d", e, rate);
    if (rate) t->points.edge_rates[e] = rate;
}

// Gives edges the rates that the user has listed: edge by edge, face by face, or for all.
static void sdv_set_edge_rates(sdv_context *context, sdv_tessellator *t)
{
    const sdv_level *cage = t->points.cage;
    const subdiv_tessellation *how = t->how;
    int *rates = t->points.edge_rates;
    memset(rates, 0, (size_t)cage->edge_count * sizeof(int));
    for (int h = 0; h < cage->face_vertex_count; h++) {
        int f = sdv_face_of(cage, h), rate = sdv_face_rate(t, f);
        int *edge = &rates[cage->face_edges[h]];
        if (rate > *edge) *edge = rate;
        if (rate >= 0) continue;
        f = sdv_user_face(t->surface, f);
        sdv_fail_mesh(context, SUBDIV_ERROR_ARGUMENT, f, -1, "face %d: the rate is %d", f, rate);
    }
    for (int e = 0; e < cage->edge_count; e++) {
        if (how->edge_rates) sdv_set_edge_rate(context, t, e, how->edge_rates[e]);
        if (!rates[e]) rates[e] = how->rate ? how->rate : 1;
    }
}

// Asks the user for the rates of edges, by their ends and middles: the points at rate 2.
static void sdv_ask_edge_rates(sdv_context *context, sdv_tessellator *t, float factor)
{
    sdv_tiling halves = t->points;
    const sdv_level *cage = halves.cage;
    halves.edge_rates = SDV_NEW(context, &t->arena, int, cage->edge_count);
    for (int e = 0; e < cage->edge_count && !context->result; e++) halves.edge_rates[e] = 2;
    for (int f = 0; f < cage->face_count; f++) {
        sdv_inside *grid = &halves.insides[f];
        grid->columns = grid->rows = 1;
        grid->most = sdv_tile_at(&halves, f).ngon ? 1 : 2;
    }
    if (!context->result) sdv_place_points(context, &halves);
    if (context->result) return;
    int count = halves.starts[cage->edge_count];
    float *points = SDV_NEW(context, &t->arena, float, 3 * (size_t)count);
    sdv_make_tile_points(context, t->opt, &halves, &t->positions, points, NULL, count);
    if (!context->result) sdv_multiply(points, 3 * (size_t)count, factor);
    for (int e = 0; e < cage->edge_count && !context->result; e++) {
        int h = halves.home[cage->vertex_count + e];
        if (h < 0) continue;
        int a = cage->face_vertices[h], b = cage->face_vertices[sdv_next(cage, h)];
        const float *low = points + 3 * (size_t)(a < b ? a : b);
        const float *high = points + 3 * (size_t)(a < b ? b : a);
        const float *middle = points + 3 * (size_t)halves.starts[e];
        sdv_set_edge_rate(context, t, e, t->how->edge_rate(t->how->user, e, low, middle, high));
    }
}

// UVs have the rates of the faces and edges that they are on.
static void sdv_tile_uvs(sdv_context *context, sdv_tessellator *t)
{
    const subdiv_surface *uv = t->surface->uv;
    const sdv_level *from = t->points.cage, *to = &uv->order.cage;
    t->uvs = sdv_new_tiling(context, &t->arena, uv);
    for (int f = 0; f < from->face_count && !context->result; f++) {
        int own = uv->own_face[f], start = sdv_face_start(from, f);
        if (own < 0) continue;
        t->uvs.insides[own] = t->points.insides[f];
        for (int h = sdv_face_start(to, own), i = 0; h < sdv_face_end(to, own); h++, i++)
            t->uvs.edge_rates[to->face_edges[h]] =
                t->points.edge_rates[from->face_edges[start + i]];
    }
    if (!context->result) t->mesh.uv_count = sdv_place_points(context, &t->uvs);
}

// Counts the faces of each face of the cage, and writes their sizes if there is room for them.
static void sdv_count_tiles(sdv_context *context, sdv_tessellator *t)
{
    int faces = t->points.cage->face_count;
    sdv_faces_at out = { t->triangles, NULL, t->mesh.face_sizes, 0, 0 };
    t->mesh.hole_count = 0;
    for (int f = 0; f < faces && out.faces <= INT_MAX; f++) {
        int hole = t->surface->hole[f];
        t->first[f] = out;
        if (hole == SDV_DROPPED || (hole && !(t->opt && t->opt->keep_holes))) continue;
        sdv_put_tile(&t->points, f, &out);
        if (hole) t->mesh.hole_count += (int)(out.faces - t->first[f].faces);
    }
    if (out.faces > INT_MAX)
        sdv_fail(context, SUBDIV_ERROR_TOO_LARGE,
                 "these rates make more than %d faces", INT_MAX);
    t->first[faces] = out;
    t->mesh.face_count = (int)out.faces;
}

// Finds out what the result will be like, all but its numbers. Statements stand before the first
// face of their face, or of the next one that has any.
static void sdv_plan_tiles(sdv_context *context, sdv_tessellator *t)
{
    const int *from = t->surface->fine.statement_faces;
    int faces = t->points.cage->face_count, statements = t->surface->fine.statement_count;
    int *to = t->mesh.statement_faces = SDV_NEW(context, &t->arena, int, statements);
    t->first = SDV_NEW(context, &t->arena, sdv_faces_at, (size_t)faces + 1);
    t->mesh.face_sizes = NULL;
    if (!context->result) sdv_count_tiles(context, t);
    if (context->result) return;
    for (int i = 0; i < statements; i++) to[i] = (int)t->first[from[i]].faces;
    sdv_faces_at all = t->first[faces];
    t->mesh.face_size = t->triangles ? 3 : all.face_vertices == 4 * all.faces ? 4 : 0;
    if (t->mesh.face_size) return;
    t->mesh.face_sizes = SDV_NEW(context, &t->arena, int, all.faces);
    if (!context->result) sdv_count_tiles(context, t);
}

static void sdv_tile_job(void *context, int job)
{
    const sdv_tessellator *t = (const sdv_tessellator *)context;
    const subdiv_surface *uv = t->surface->uv;
    int faces = t->points.cage->face_count, end = sdv_share(faces, job + 1, t->jobs);
    for (int f = sdv_share(faces, job, t->jobs); f < end; f++) {
        sdv_faces_at out = t->first[f], normals = out, uvs = out;
        if (t->first[f + 1].faces == out.faces) continue;
        out.vertices = t->mesh.face_vertices;
        sdv_put_tile(&t->points, f, &out);
        normals.vertices = t->mesh.face_normals;
        if (normals.vertices) sdv_put_tile(&t->normals, f, &normals);
        for (size_t i = t->first[f].faces; i < out.faces; i++)
            t->mesh.cage_faces[i] = sdv_user_face(t->surface, f);
        uvs.vertices = t->mesh.face_uvs;
        if (uv && uv->own_face[f] >= 0) sdv_put_tile(&t->uvs, uv->own_face[f], &uvs);
        while (uv && uvs.face_vertices < out.face_vertices) uvs.vertices[uvs.face_vertices++] = -1;
    }
}

// The points of the result, its UVs and colours.
static void sdv_make_samples(sdv_context *context, sdv_tessellator *t)
{
    const subdiv_surface *surface = t->surface, *uv = surface->uv;
    subdiv_mesh *mesh = &t->mesh;
    sdv_make_tile_points(context, t->opt, &t->normals, &t->positions, mesh->positions,
                         mesh->normals, mesh->vertex_count);
    if (surface->colors) {
        sdv_exact_work colors = sdv_begin_source(context, &t->arena, surface, 3, surface->colors,
                                                 t->opt);
        sdv_make_tile_points(context, t->opt, &t->points, &colors, mesh->colors, NULL,
                             mesh->vertex_count);
    }
    if (uv) {
        sdv_exact_work uvs = sdv_begin_source(context, &t->arena, uv, 2, surface->uvs, t->opt);
        sdv_make_tile_points(context, t->opt, &t->uvs, &uvs, mesh->uvs, NULL, mesh->uv_count);
    }
}

static void sdv_tessellate(sdv_context *context, sdv_tessellator *t, const float *positions,
                           float factor)
{
    const subdiv_surface *surface = t->surface;
    subdiv_mesh made, *mesh = &t->mesh;
    int faces = surface->order.cage.face_count, *holes;
    t->points = sdv_new_tiling(context, &t->arena, surface);
    t->positions = sdv_begin_source(context, &t->arena, surface, 3, positions, t->opt);
    if (context->result) return;
    sdv_set_edge_rates(context, t);
    if (t->how->edge_rate && !context->result) sdv_ask_edge_rates(context, t, factor);
    if (context->result) return;
    for (int f = 0; f < faces; f++) sdv_find_inside(&t->points, f, sdv_face_rate(t, f));
    *mesh = surface->fine;
    mesh->crease_count = mesh->corner_count = 0;
    mesh->vertex_count = mesh->normal_count = sdv_place_points(context, &t->points);
    t->normals = t->points;
    if (surface->sides.vertex && !(t->opt && t->opt->one_normal))
        mesh->normal_count = sdv_place_sides(context, &t->arena, &t->normals, &surface->sides);
    if (surface->uv && !context->result) sdv_tile_uvs(context, t);
    if (!context->result) sdv_plan_tiles(context, t);
    if (!context->result) sdv_new_mesh(context, &made, mesh, SDV_LIMIT);
    if (context->result) return;
    *mesh = made;
    holes = mesh->holes;
    for (int f = 0; f < faces && mesh->hole_count; f++)
        for (size_t i = t->first[f].faces; i < t->first[f + 1].faces && surface->hole[f]; i++)
            *holes++ = (int)i;
    t->jobs = sdv_jobs(t->opt, mesh->face_count, SDV_JOB_POINTS);
    sdv_run(t->opt, sdv_tile_job, t, t->jobs);
    sdv_make_samples(context, t);
    sdv_multiply(mesh->positions, 3 * (size_t)mesh->vertex_count, factor);
    if (context->result) subdiv_mesh_free(mesh);
}

SUBDIV_DEF subdiv_result subdiv_surface_tessellate(subdiv_mesh *fine,
                                                   const subdiv_surface *surface,
                                                   const float *positions,
                                                   const subdiv_tessellation *how,
                                                   const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    subdiv_tessellation plain;
    sdv_tessellator t;
    memset(&plain, 0, sizeof plain);
    memset(&t, 0, sizeof t);
    if (!how) how = &plain;
    if (fine) memset(fine, 0, sizeof *fine);
    if (!fine || !surface) sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    else if (surface->is_values)
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "the surface is one of face-varying values");
    else if (!surface->exact)
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "the surface was not prepared for SUBDIV_EXACT");
    if (how->rate < 0) sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "the rate is %d", how->rate);
    if (context.result) return context.result;

    t.surface = surface;
    t.how = how;
    t.opt = opt;
    t.arena = sdv_scratch();
    t.triangles = how->triangles || surface->rules.loop;
    float factor = sdv_shrink_huge(&context, &t.arena, surface, &positions);
    if (!context.result) sdv_tessellate(&context, &t, positions, factor);
    if (!context.result) *fine = t.mesh;
    sdv_arena_free(&t.arena);
    return context.result;
}

SUBDIV_DEF subdiv_result subdiv_tessellate(subdiv_mesh *fine, const subdiv_mesh *cage,
                                           const subdiv_tessellation *how,
                                           const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    subdiv_surface *surface = NULL;
    sdv_request request = sdv_request_of(cage, SUBDIV_EXACT, sdv_find_exact_calls(), 1, opt);
    sdv_begin_mesh(&context, fine, cage);
    if (!context.result) context.result = sdv_prepare(&surface, &request);
    if (!context.result)
        context.result = subdiv_surface_tessellate(fine, surface, cage->positions, how, opt);
    subdiv_surface_free(surface);
    return context.result;
}
#endif // SUBDIV_NO_EXACT

// -------------------------------------------------------------------------------- >>normals
// Normals of any mesh, from its faces alone.

// Computes the normal of a face by Newell's method, as long as twice its area. Returns how long
// rounding of the coordinates could make it: by FLT_EPSILON / 2 of their size each.
//
//     N = sum of (p - o) x (q - o) over the edges p q of the face, o any point; |N| = 2 area
static double sdv_area_normal(const float *positions, const int *vertices, int size, double n[3])
{
    const float *o = positions + 3 * (size_t)vertices[0];
    double p[3] = { 0, 0, 0 }, largest = 0, perimeter = 0;
    n[0] = n[1] = n[2] = 0;
    for (int i = 0; i < size; i++) {
        const float *next = positions + 3 * (size_t)vertices[i + 1 < size ? i + 1 : 0];
        double q[3], squares = 0;
        for (int k = 0; k < 3; k++) {
            q[k] = (double)next[k] - (double)o[k];
            squares += (q[k] - p[k]) * (q[k] - p[k]);
            if (fabs((double)next[k]) > largest) largest = fabs((double)next[k]);
        }
        for (int k = 0; k < 3; k++)
            n[k] += p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3];
        memcpy(p, q, sizeof p);
        perimeter += sqrt(squares);
    }
    return 2 * (double)FLT_EPSILON * largest * perimeter;
}

// Computes the normal of face f, 1 long; 0 if the face is as thin as rounding.
static void sdv_face_normal(const float *positions, const sdv_level *level, int f, double normal[3])
{
    int start = sdv_face_start(level, f), size = sdv_face_end(level, f) - start;
    double n[3], error = sdv_area_normal(positions, level->face_vertices + start, size, n);
    double length = sqrt(sdv_dot3(n, n));
    for (int k = 0; k < 3; k++) normal[k] = length > error ? n[k] / length : 0;
}

// The largest angle that is no crease.
typedef struct sdv_bend {
    double cosine, sine;
} sdv_bend;

// Returns the bend of so many degrees. Up to 0.001 degrees more are rounding.
static sdv_bend sdv_largest_bend(sdv_context *context, float degrees)
{
    int valid = degrees >= 0 && degrees <= 180;
    double most = valid ? fmin((double)degrees + 0.001, 180) : 0;
    sdv_bend bend = { sdv_cosine(most, 360), sdv_sine(most, 360) };
    if (!valid) sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "degrees has to be from 0 to 180");
    return bend;
}

// Is the angle between two faces larger, by their normals? The sine of the difference tells angles
// apart that a cosine blurs: the small ones.
static int sdv_is_bent(const double *a, const double *b, const sdv_bend *most)
{
    double n[3];
    sdv_cross(a, b, n);
    return sqrt(sdv_dot3(n, n)) * most->cosine > sdv_dot3(a, b) * most->sine;
}

// Makes edges sharp along which faces are bent by more than so much.
static void sdv_sharpen_bends(sdv_context *context, sdv_arena *arena, const float *positions,
                              sdv_level *level, const sdv_bend *most)
{
    double *normals = SDV_NEW(context, arena, double, 3 * (size_t)level->face_count);
    for (int f = 0; f < level->face_count && normals; f++)
        sdv_face_normal(positions, level, f, normals + 3 * (size_t)f);
    for (int h = 0; h < level->face_vertex_count && normals; h++) {
        int g = level->across[h], f = sdv_face_of(level, h);
        if (g == h || !sdv_is_bent(normals + 3 * (size_t)f,
                                   normals + 3 * (size_t)sdv_face_of(level, g), most)) continue;
        level->sharpness[h] = level->sharpness[g] = SUBDIV_INFINITE;
        level->creased[level->face_vertices[h]] = level->creased[level->face_vertices[g]] = 1;
    }
}

// Finds the sides of creases of a mesh. most: of bends that are no creases; NULL: all are none.
static sdv_sides sdv_find_mesh_sides(sdv_context *context, sdv_arena *arena,
                                     const subdiv_mesh *mesh, const sdv_bend *most)
{
    subdiv_surface shape;
    sdv_cage cage;
    memset(&shape, 0, sizeof shape);
    sdv_cage_build(context, arena, arena, &cage, mesh);
    if (most && !context->result)
        sdv_sharpen_bends(context, arena, mesh->positions, &cage.level, most);
    if (context->result) return shape.sides;
    shape.hole = cage.hole;
    shape.fine.hole_count = 1;                                  // which are part of the mesh
    shape.order.cage = cage.level;
    shape.order.n = 1;
    shape.order.count = mesh->vertex_count;
    sdv_find_sides(context, arena, &shape, &cage.level);
    return shape.sides;
}

// Sums the normals of faces: for each normal [3] in sums.
static void sdv_sum_normals(const subdiv_mesh *mesh, const sdv_sides *sides, double *sums)
{
    size_t h = 0;
    for (int f = 0; f < mesh->face_count; f++) {
        int size = sdv_face_size(mesh, f);
        double n[3];
        sdv_area_normal(mesh->positions, mesh->face_vertices + h, size, n);
        for (int i = 0; i < size; i++, h++) {
            int side = sides->vertex ? sides->vertex[h] : -1, v = mesh->face_vertices[h];
            double *sum = sums + 3 * (size_t)(side < 0 ? v : mesh->vertex_count + side);
            for (int k = 0; k < 3; k++) sum[k] += mesh->left_handed ? -n[k] : n[k];
        }
    }
}

// Makes normals, split as sdv_find_mesh_sides says or, with one_normal, not at all.
static void sdv_make_normals(sdv_context *context, subdiv_mesh *mesh, const sdv_bend *most,
                             int one_normal)
{
    sdv_arena scratch = sdv_scratch(), owned = sdv_new_arena(0);
    const sdv_sides none = { 0, 0, NULL, NULL, NULL, NULL };
    sdv_sides sides = one_normal ? none : sdv_find_mesh_sides(context, &scratch, mesh, most);
    size_t vertices = (size_t)mesh->vertex_count, count = vertices + (size_t)sides.vertices;
    size_t faces = sides.vertices ? sdv_face_vertex_count(mesh) : 0;
    int room = mesh->normals &&
               (!faces || (mesh->face_normals && mesh->normal_count == (int)count));
    float *normals = mesh->normals;
    int *face_normals = faces ? mesh->face_normals : NULL;
    double *sums = SDV_NEW(context, &scratch, double, 3 * count);
    owned.blocks = (sdv_block *)mesh->memory;
    if (!room && !context->result) {
        char *made = SDV_NEW(context, &owned, char,
                             3 * count * sizeof *normals + faces * sizeof *face_normals);
        normals = (float *)(void *)made;
        if (made && faces) face_normals = (int *)(void *)(made + 3 * count * sizeof *normals);
    }
    if (!context->result) {
        memset(sums, 0, 3 * count * sizeof *sums);
        sdv_sum_normals(mesh, &sides, sums);
        for (size_t i = 0; i < 3 * count; i += 3) sdv_make_unit(sums + i, normals + i);
        for (size_t h = 0; h < faces; h++)
            face_normals[h] = sides.vertex[h] < 0 ? mesh->face_vertices[h]
                                                  : mesh->vertex_count + sides.vertex[h];
        mesh->normals = normals;
        mesh->normal_count = (int)count;
        mesh->face_normals = face_normals;
        mesh->memory = owned.blocks;
    }
    sdv_arena_free(&scratch);
}

// Checks a mesh but for its normals, which may be anything.
static void sdv_check_shape(sdv_context *context, const subdiv_mesh *mesh)
{
    subdiv_mesh shape;
    if (mesh) shape = *mesh;
    shape.normals = NULL;
    sdv_check_all(context, mesh ? &shape : NULL);
}

SUBDIV_DEF subdiv_result subdiv_normals(subdiv_mesh *mesh, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_check_shape(&context, mesh);
    if (!context.result) sdv_make_normals(&context, mesh, NULL, opt && opt->one_normal);
    return context.result;
}

SUBDIV_DEF subdiv_result subdiv_normals_by_angle(subdiv_mesh *mesh, float degrees,
                                                 const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_check_shape(&context, mesh);
    sdv_bend most = sdv_largest_bend(&context, degrees);
    if (!context.result) sdv_make_normals(&context, mesh, &most, 0);
    return context.result;
}

// -------------------------------------------------------------------------- >>vertex-buffers
// The vertices of a buffer are the normals of its mesh, each with its first UV. For each other UV
// that face-vertices with this normal have, a copy follows behind all normals.

typedef struct sdv_buffer_maker {
    const subdiv_mesh *mesh;
    const int *normals;                 // [count] the normal of each face-vertex
    int  count, normal_count;           // face-vertices; normals
    int *first;                         // [normal_count + 1] where the UVs of each start in
    int *uvs;                           // [count] rising, and none twice; INT_MAX behind them
    int *copy;                          // [normal_count] the vertex of each one's second UV
} sdv_buffer_maker;

// Lists the UVs of each normal. Returns how many vertices there are.
static int64_t sdv_list_uvs(sdv_buffer_maker *make)
{
    const int *face_uvs = make->mesh->uv_count ? make->mesh->face_uvs : NULL;
    int *first = make->first, *uvs = make->uvs;
    int64_t vertices = make->normal_count;
    memset(first, 0, ((size_t)make->normal_count + 1) * sizeof *first);
    for (int h = 0; h < make->count; h++) first[make->normals[h]]++;
    for (int n = 1; n <= make->normal_count; n++) first[n] += first[n - 1];
    for (int h = 0; h < make->count; h++)
        uvs[--first[make->normals[h]]] = face_uvs ? face_uvs[h] : -1;
    for (int n = 0; n < make->normal_count; n++) {
        int from = first[n], end = first[n + 1], to = from;
        sdv_sort(uvs + from, end - from);
        for (int i = from; i < end; i++)
            if (i == from || uvs[i] != uvs[to - 1]) uvs[to++] = uvs[i];
        make->copy[n] = (int)vertices;
        vertices += to > from ? to - from - 1 : 0;
        while (to < end) uvs[to++] = INT_MAX;
        if (vertices > INT_MAX) break;
    }
    return vertices;
}

// Returns the vertex of face-vertex h.
static int sdv_vertex_of(const sdv_buffer_maker *make, int h)
{
    int n = make->normals[h], first = make->first[n], low = first, high = make->first[n + 1];
    int uv = make->mesh->uv_count ? make->mesh->face_uvs[h] : -1;
    while (low + 1 < high) {
        int middle = low + (high - low) / 2;
        if (make->uvs[middle] <= uv) low = middle;
        else high = middle;
    }
    return low > first ? make->copy[n] + low - first - 1 : n;
}

static size_t sdv_carve_buffer(subdiv_buffer *buffer, char *base)
{
    size_t size = 0, vertices = (size_t)buffer->vertex_count;
    buffer->points = SDV_CARVE(int, NULL, vertices, 1);
    buffer->normals = SDV_CARVE(int, NULL, vertices, 1);
    buffer->uvs = SDV_CARVE(int, NULL, vertices, 1);
    buffer->face_vertices = SDV_CARVE(int, NULL, vertices, 1);
    buffer->indices = SDV_CARVE(char, NULL, (size_t)buffer->index_count,
                                (size_t)buffer->index_size);
    return size;
}

// Fills in what each vertex is and cuts faces into triangles.
static void sdv_cut_faces(const sdv_buffer_maker *make, subdiv_buffer *buffer)
{
    const subdiv_mesh *mesh = make->mesh;
    unsigned short *indices2 = (unsigned short *)buffer->indices;
    int *indices4 = (int *)buffer->indices, h = 0;
    size_t at = 0;
    for (int v = 0; v < buffer->vertex_count; v++) {        // those without faces
        buffer->points[v] = v < buffer->point_count ? v : 0;
        buffer->normals[v] = v < buffer->normal_count ? v : 0;
        buffer->uvs[v] = -1;
        buffer->face_vertices[v] = 0;
    }
    for (int f = 0; f < mesh->face_count; f++) {
        int size = sdv_face_size(mesh, f), triangle[3] = { 0, 0, 0 };
        for (int i = 0; i < size; i++, h++) {
            int v = sdv_vertex_of(make, h);
            buffer->points[v] = mesh->face_vertices[h];
            buffer->normals[v] = make->normals[h];
            buffer->uvs[v] = mesh->uv_count ? mesh->face_uvs[h] : -1;
            buffer->face_vertices[v] = h;
            triangle[i == 0 ? 0 : 1] = triangle[i == 0 ? 0 : 2];
            triangle[i == 0 ? 0 : 2] = v;
            for (int k = 0; k < 3 && i >= 2; k++, at++) {
                int corner = triangle[mesh->left_handed && k > 0 ? 3 - k : k];
                if (buffer->index_size == 2) indices2[at] = (unsigned short)corner;
                else indices4[at] = corner;
            }
        }
    }
}

// Are the normals of face-vertices numbered as those of results?
static int sdv_is_result(const subdiv_mesh *mesh, const int *normals, int count)
{
    for (int h = 0; h < count; h++)
        if (normals[h] < mesh->vertex_count && normals[h] != mesh->face_vertices[h]) return 0;
    return 1;
}

SUBDIV_DEF subdiv_result subdiv_make_buffer(subdiv_buffer *buffer, const subdiv_mesh *mesh,
                                            int index_size, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_arena arena = sdv_scratch();
    sdv_buffer_maker make;
    if (buffer) memset(buffer, 0, sizeof *buffer);
    else sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "buffer is NULL");
    sdv_check_mesh(&context, mesh);
    if (index_size != 2 && index_size != 4)
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "index_size is %d", index_size);
    if (context.result) return context.result;
    size_t count = sdv_face_vertex_count(mesh);
    int64_t indices = 3 * ((int64_t)count - 2 * (int64_t)mesh->face_count);
    if (indices > INT_MAX)
        sdv_fail(&context, SUBDIV_ERROR_TOO_LARGE, "the mesh has too many triangles");
    make.mesh = mesh;
    make.normals = mesh->normals && mesh->face_normals ? mesh->face_normals : mesh->face_vertices;
    make.count = (int)count;
    make.normal_count = mesh->normals ? sdv_normal_count(mesh) : mesh->vertex_count;
    if (!context.result && !sdv_is_result(mesh, make.normals, make.count))
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "face_normals are not those of a result");
    make.first = SDV_NEW(&context, &arena, int, (size_t)make.normal_count + 1);
    make.uvs = SDV_NEW(&context, &arena, int, count);
    make.copy = SDV_NEW(&context, &arena, int, make.normal_count);
    int64_t vertices = context.result ? 0 : sdv_list_uvs(&make);
    if (vertices > (index_size == 2 ? 65536 : INT_MAX))
        sdv_fail(&context, SUBDIV_ERROR_TOO_LARGE, "the buffer has more than %d vertices",
                 index_size == 2 ? 65536 : INT_MAX);
    subdiv_buffer made = { (int)vertices, mesh->vertex_count, make.normal_count, NULL, NULL, NULL,
                           context.result ? 0 : (int)indices, index_size, NULL, NULL, NULL };
    sdv_block *block = context.result ? NULL
                     : sdv_allocate(&context, sdv_carve_buffer(&made, NULL));
    if (block) {
        made.memory = block;
        sdv_carve_buffer(&made, (char *)(block + 1));
        sdv_cut_faces(&make, &made);
        *buffer = made;
    }
    sdv_arena_free(&arena);
    return context.result;
}

SUBDIV_DEF void subdiv_buffer_free(subdiv_buffer *buffer)
{
    if (!buffer) return;
    sdv_free_memory(buffer->memory);
    memset(buffer, 0, sizeof *buffer);
}

// Copies vectors of so many floats: that of vertex i, from first on, is the one numbered items[i].
static void sdv_copy_vectors(float *to, int stride, int width, int first, int end, const int *items,
                       const float *from, int from_stride)
{
    for (int i = first; i < end && to; i++) {
        float *out = to + (size_t)stride * (size_t)i;
        for (int c = 0; c < width; c++)
            out[c] = items[i] < 0 ? 0 : from[(size_t)from_stride * (size_t)items[i] + (size_t)c];
    }
}

// Checks the arguments of a call that fills a buffer.
static void sdv_check_vertices(sdv_context *context, const subdiv_buffer *buffer,
                               const subdiv_vertices *out)
{
    if (!buffer || !out) sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    int least = !out ? 0 : out->positions || out->normals || out->colors ? 3 : out->uvs ? 2 : 0;
    if (out && out->stride && out->stride < least)
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "a stride of %d floats is less than %d",
                 out->stride, least);
}

SUBDIV_DEF subdiv_result subdiv_fill_buffer(const subdiv_buffer *buffer, const subdiv_mesh *mesh,
                                            const subdiv_vertices *out, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_check_vertices(&context, buffer, out);
    if (!mesh) sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "the mesh is NULL");
    if (context.result) return context.result;
    int normals = mesh->normals ? sdv_normal_count(mesh) : mesh->vertex_count;
    int count = buffer->vertex_count, three = out->stride ? out->stride : 3;
    int two = out->stride ? out->stride : 2;
    if (mesh->vertex_count != buffer->point_count || normals != buffer->normal_count)
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "the buffer was made of another mesh");
    const char *missing = out->positions && !mesh->positions ? "positions"
                        : out->normals && !mesh->normals ? "normals"
                        : out->uvs && (!mesh->uv_count || !mesh->uvs) ? "UVs"
                        : out->colors && !mesh->colors ? "colors" : NULL;
    if (missing) sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "the mesh has no %s", missing);
    for (int i = 0; i < count && out->uvs && !context.result; i++)
        if (buffer->uvs[i] >= mesh->uv_count)
            sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "the mesh has no UV %d", buffer->uvs[i]);
    if (context.result) return context.result;
    sdv_copy_vectors(out->positions, three, 3, 0, count, buffer->points, mesh->positions, 3);
    sdv_copy_vectors(out->normals, three, 3, 0, count, buffer->normals, mesh->normals, 3);
    sdv_copy_vectors(out->uvs, two, 2, 0, count, buffer->uvs, mesh->uvs, 2);
    sdv_copy_vectors(out->colors, three, 3, 0, count, buffer->points, mesh->colors, 3);
    return SUBDIV_OK;
}

SUBDIV_DEF subdiv_result subdiv_evaluate_buffer(const subdiv_buffer *buffer,
                                                const subdiv_surface *surface,
                                                const float *positions, const subdiv_vertices *out,
                                                void *scratch, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_check_vertices(&context, buffer, out);
    sdv_check_mesh_surface(&context, surface, positions != NULL);
    if (context.result) return context.result;
    int points = surface->fine.vertex_count, limit = surface->rules.limit;
    int normals = limit ? surface->fine.normal_count : points, end = buffer->vertex_count;
    if (points != buffer->point_count || normals != buffer->normal_count)
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "the buffer was made of another surface's mesh");
    if (out->normals && !limit)
        sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "the surface was prepared without opt->limit");
    if (context.result) return context.result;
    int stride = out->stride ? out->stride : 3;
    float *p = out->positions, *n = out->normals;
    subdiv_limit to = { p, n, NULL, stride, n ? n + (size_t)stride * (size_t)points : NULL };
    if (limit)
        context.result = subdiv_evaluate_limit(surface, positions, 3, &to, scratch, opt);
    else if (p)
        context.result = subdiv_evaluate(surface, 3, positions, 3, p, stride, scratch, opt);
    if (context.result) return context.result;
    sdv_copy_vectors(p, stride, 3, points, end, buffer->points, p, stride);
    sdv_copy_vectors(n, stride, 3, normals, end, buffer->normals, n, stride);
    return SUBDIV_OK;
}

#ifndef SUBDIV_NO_TOOLS
// ---------------------------------------------------------------------------- >>generators
// Creases from the mesh itself: each generator asks one question of two faces that share an edge.
// Boundary and non-manifold edges are sharp by shape: no question is asked about them.

typedef struct sdv_generator {
    subdiv_mesh *mesh;
    float sharpness;                    // of the creases that are found
    sdv_arena arena;
    sdv_cage cage;                      // without creases and corners
    double *normals;                    // [3 * face_count]  of length 1, or 0 for no area
    sdv_bend most;                      // the largest angle that is no crease
    const char **groups;                // [face_count]      smoothing groups; "": none
} sdv_generator;

// Is the edge sharp along which one face runs from face-vertex h, the other back from g?
typedef int (*sdv_question)(const sdv_generator *generator, int h, int g);

// Builds a cage without the mesh's creases and corners, so that only edges without two faces are
// sharp; and without the boundary rule, so that only the mesh's own holes are holes.
static void sdv_plain_cage(sdv_context *context, sdv_arena *arena, sdv_cage *cage,
                           const subdiv_mesh *mesh)
{
    subdiv_mesh shape = *mesh;
    shape.crease_count = shape.corner_count = 0;
    shape.boundary = SUBDIV_BOUNDARY_EDGE;
    sdv_cage_build(context, arena, arena, cage, &shape);
}

static void sdv_generator_begin(sdv_context *context, sdv_generator *generator,
                                subdiv_mesh *mesh, float sharpness)
{
    memset(generator, 0, sizeof *generator);
    generator->mesh = mesh;
    generator->sharpness = sharpness;
    if (sharpness != sharpness)
        sdv_fail(context, SUBDIV_ERROR_NOT_FINITE, "the sharpness is not a number");
    if (!context->result) sdv_plain_cage(context, &generator->arena, &generator->cage, mesh);
}

// Gives the mesh a new list: its own, with room for more entries behind these.
static void sdv_lengthen_list(sdv_context *context, subdiv_mesh *mesh, size_t more)
{
    sdv_arena owned = sdv_new_arena(0);
    size_t count = (size_t)mesh->crease_count;
    if (count + more > INT_MAX / 2) sdv_fail(context, SUBDIV_ERROR_TOO_LARGE, "too many creases");
    owned.blocks = (sdv_block *)mesh->memory;
    int *vertices = (int *)sdv_new(context, &owned, count + more, 2 * sizeof(int) + sizeof(float));
    if (context->result) return;
    float *sharpness = (float *)(void *)(vertices + 2 * (count + more));
    sdv_copy(vertices, mesh->crease_vertices, count, 2 * sizeof(int));
    sdv_copy(sharpness, mesh->crease_sharpness, count, sizeof(float));
    mesh->crease_vertices = vertices;
    mesh->crease_sharpness = sharpness;
    mesh->memory = owned.blocks;
}

// Adds an entry to a list that has the room.
static void sdv_add_crease(subdiv_mesh *mesh, int a, int b, float sharpness)
{
    int *ends = mesh->crease_vertices + 2 * (size_t)mesh->crease_count;
    ends[0] = a;
    ends[1] = b;
    mesh->crease_sharpness[mesh->crease_count++] = sharpness;
}

// Asks about every edge. Gives the mesh a longer list if any is found: the list that it had, with
// the sharpness raised of entries that are found, then the other edges that are found, in order.
static void sdv_add_found_edges(sdv_context *context, sdv_generator *generator,
                                sdv_question is_crease)
{
    const sdv_level *level = &generator->cage.level;
    subdiv_mesh *mesh = generator->mesh;
    int *entry = SDV_NEW(context, &generator->arena, int, level->edge_count);
    int *found = SDV_NEW(context, &generator->arena, int, level->edge_count);
    size_t finds = 0;
    if (context->result) return;
    for (int e = 0; e < level->edge_count; e++) {
        int h = level->edge_first[e], g = sdv_across(level, h);
        if (g >= 0 && is_crease(generator, h, g)) found[finds++] = e;
        entry[e] = -1;
    }
    for (int i = 0; i < mesh->crease_count; i++) {
        const int *ends = mesh->crease_vertices + 2 * (size_t)i;
        int e = sdv_find_edge(level, ends[0], ends[1]);
        if (e >= 0) entry[e] = i;                   // the last one counts
    }
    if (finds > 0) sdv_lengthen_list(context, mesh, finds);
    for (size_t i = 0; i < finds && !context->result; i++) {
        int e = found[i], h = level->edge_first[e];
        float *known = mesh->crease_sharpness + entry[e];
        if (entry[e] < 0)
            sdv_add_crease(mesh, level->face_vertices[h],
                           level->face_vertices[sdv_next(level, h)], generator->sharpness);
        else if (*known < generator->sharpness) *known = generator->sharpness;
    }
}

// Asks the question, unless it is NULL.
static subdiv_result sdv_generator_end(sdv_context *context, sdv_generator *generator,
                                       sdv_question is_crease)
{
    if (!context->result && is_crease) sdv_add_found_edges(context, generator, is_crease);
    sdv_arena_free(&generator->arena);
    return context->result;
}

// Is an edge bent, along which one face runs from h and the other back from g?
static int sdv_is_bent_edge(const sdv_generator *generator, int h, int g)
{
    const sdv_level *level = &generator->cage.level;
    return sdv_is_bent(generator->normals + 3 * (size_t)sdv_face_of(level, h),
                       generator->normals + 3 * (size_t)sdv_face_of(level, g), &generator->most);
}

SUBDIV_DEF subdiv_result subdiv_crease_by_angle(subdiv_mesh *mesh, float degrees, float sharpness,
                                                const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_generator generator;
    sdv_check_all(&context, mesh);
    sdv_bend most = sdv_largest_bend(&context, degrees);
    sdv_generator_begin(&context, &generator, mesh, sharpness);
    if (!context.result)
        generator.normals = SDV_NEW(&context, &generator.arena, double,
                                    3 * (size_t)mesh->face_count);
    for (int f = 0; !context.result && f < mesh->face_count; f++)
        sdv_face_normal(mesh->positions, &generator.cage.level, f,
                        generator.normals + 3 * (size_t)f);
    generator.most = most;
    return sdv_generator_end(&context, &generator, sdv_is_bent_edge);
}

// Finds the word that names a smoothing group: "1" in "s 1"; "" for "s off" and "s 0" (some
// programs write "s null"). NULL for other statements.
static const char *sdv_smoothing_group(const char *statement)
{
    if (!sdv_same_word(statement, "s")) return NULL;
    const char *word = statement + 1;
    while (*word == ' ' || *word == '\t') word++;
    while (*word == '0') word++;
    return sdv_same_word(word, "off") || sdv_same_word(word, "null") ? "" : word;
}

// Finds the group of every face. Returns 0 if the statements name none, not even "off".
static int sdv_smoothing_groups(const subdiv_mesh *mesh, const char **groups)
{
    const char *group = "";
    int next = 0, any = 0;
    for (int f = 0; f < mesh->face_count; f++) {
        for (; next < mesh->statement_count && mesh->statement_faces[next] <= f; next++) {
            const char *named = sdv_smoothing_group(mesh->statements[next]);
            if (!named) continue;
            group = named;
            any = 1;
        }
        groups[f] = group;
    }
    return any;
}

// Are two faces in different smoothing groups, or the first one in none?
static int sdv_groups_differ(const sdv_generator *generator, int h, int g)
{
    const sdv_level *level = &generator->cage.level;
    const char *a = generator->groups[sdv_face_of(level, h)];
    return sdv_ends_word(*a) || !sdv_same_word(a, generator->groups[sdv_face_of(level, g)]);
}

SUBDIV_DEF subdiv_result subdiv_crease_by_smoothing_groups(subdiv_mesh *mesh, float sharpness,
                                                           const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_generator generator;
    sdv_check_mesh(&context, mesh);
    sdv_generator_begin(&context, &generator, mesh, sharpness);
    if (!context.result)
        generator.groups = SDV_NEW(&context, &generator.arena, const char *, mesh->face_count);
    int known = !context.result && sdv_smoothing_groups(mesh, generator.groups);
    if (!context.result && !known) sdv_warn(&context, 0, "the mesh has no smoothing groups");
    return sdv_generator_end(&context, &generator, known ? sdv_groups_differ : NULL);
}

// Do two face-vertices have different UVs, or only one of them any?
static int sdv_uvs_differ(const subdiv_mesh *mesh, int h, int g)
{
    int i = mesh->face_uvs[h], j = mesh->face_uvs[g];
    if (i < 0 || j < 0 || i == j) return i != j;
    const float *a = mesh->uvs + 2 * (size_t)i, *b = mesh->uvs + 2 * (size_t)j;
    return a[0] != b[0] || a[1] != b[1];
}

static int sdv_is_seam(const sdv_generator *generator, int h, int g)
{
    const sdv_level *level = &generator->cage.level;
    return sdv_uvs_differ(generator->mesh, h, sdv_next(level, g)) ||
           sdv_uvs_differ(generator->mesh, sdv_next(level, h), g);
}

SUBDIV_DEF subdiv_result subdiv_crease_by_uv_seams(subdiv_mesh *mesh, float sharpness,
                                                   const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_generator generator;
    sdv_check_data(&context, mesh);
    sdv_generator_begin(&context, &generator, mesh, sharpness);
    int known = !context.result && mesh->uv_count > 0;
    if (!context.result && !known) sdv_warn(&context, 0, "the mesh has no UVs");
    return sdv_generator_end(&context, &generator, known ? sdv_is_seam : NULL);
}

// Checks chains of creases.
static void sdv_check_chains(sdv_context *context, const subdiv_mesh *mesh, int chain_count,
                             const int *lengths, const int *vertices, int sharpness_count,
                             const float *sharpness)
{
    int64_t edges = 0;
    if (chain_count < 0) sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "chain_count is %d", chain_count);
    if (chain_count > 0 && (!lengths || !vertices || !sharpness))
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    for (int i = 0; i < chain_count && !context->result; i++) {
        if (lengths[i] < 2) sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "chain %d has %d vertices", i,
                                     lengths[i]);
        else edges += lengths[i] - 1;
    }
    if (sharpness_count != chain_count && sharpness_count != edges)
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "sharpness_count is %d, but there are %d chains "
                 "with %d edges", sharpness_count, chain_count,
                 edges > INT_MAX ? INT_MAX : (int)edges);
    for (int i = 0; i < chain_count && !context->result; vertices += lengths[i++]) {
        int own = sharpness_count == chain_count ? 1 : lengths[i] - 1;
        for (int k = 0; k < lengths[i]; k++)
            if (vertices[k] < 0 || vertices[k] >= mesh->vertex_count)
                sdv_fail_mesh(context, SUBDIV_ERROR_INDEX, -1, vertices[k], "chain %d: vertex %d "
                              "does not exist (the mesh has %d)", i, vertices[k],
                              mesh->vertex_count);
        for (int k = 0; k < own; k++, sharpness++)
            if (*sharpness != *sharpness)
                sdv_fail_mesh(context, SUBDIV_ERROR_NOT_FINITE, -1, vertices[k],
                              "chain %d: the sharpness at %d is not a number", i, k);
    }
}

SUBDIV_DEF subdiv_result subdiv_crease_chains(subdiv_mesh *mesh, int chain_count,
                                              const int *lengths, const int *vertices,
                                              int sharpness_count, const float *sharpness,
                                              const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_generator generator;
    size_t edges = 0;
    sdv_check_mesh(&context, mesh);
    if (!context.result) sdv_check_chains(&context, mesh, chain_count, lengths, vertices,
                                          sharpness_count, sharpness);
    sdv_generator_begin(&context, &generator, mesh, 0);
    for (int i = 0; i < chain_count && !context.result; i++) edges += (size_t)lengths[i] - 1;
    if (edges > 0) sdv_lengthen_list(&context, mesh, edges);
    for (int i = 0; i < chain_count && !context.result; i++, vertices++) {
        for (int k = 1; k < lengths[i]; k++, vertices++) {
            int a = vertices[0], b = vertices[1];
            if (sdv_find_edge(&generator.cage.level, a, b) >= 0)
                sdv_add_crease(mesh, a, b, *sharpness);
            else sdv_warn(&context, 0, "chain %d: no edge joins vertices %d and %d", i, a, b);
            sharpness += sharpness_count != chain_count || k == lengths[i] - 1;
        }
    }
    return sdv_generator_end(&context, &generator, NULL);
}

// ---------------------------------------------------------------------------- >>inspection

// Counts edges, vertices and faces of a cage that has the sharpness of the lists alone.
static void sdv_count_parts(subdiv_info *info, const sdv_cage *cage, int regular)
{
    const sdv_level *level = &cage->level;
    for (int e = 0; e < level->edge_count; e++) {
        int h = level->edge_first[e];
        info->boundary_edge_count += sdv_is_boundary(level, h);
        info->nonmanifold_edge_count += cage->edge_nonmanifold[e];
        info->crease_count += level->sharpness[h] > 0;
        info->infinite_crease_count += level->sharpness[h] >= SUBDIV_INFINITE;
    }
    for (int v = 0; v < level->vertex_count; v++) {
        int faces = level->vertex_faces[v], valence = sdv_count_edges_at(cage, v).count;
        if (valence > info->max_valence) info->max_valence = valence;
        if (faces == 0) info->isolated_vertex_count++;
        else if (cage->vertex_nonmanifold[v]) info->nonmanifold_vertex_count++;
        else if (valence == faces && valence != regular) info->extraordinary_vertex_count++;
        info->corner_count += level->vertex_sharpness[v] > 0;
    }
    for (int f = 0; f < level->face_count; f++) {
        int size = sdv_face_end(level, f) - sdv_face_start(level, f);
        if (size > info->max_face_size) info->max_face_size = size;
        info->triangle_count += size == 3;
        info->quad_count += size == 4;
        info->ngon_count += size > 4;
        info->hole_count += cage->hole[f];
    }
}

// Finds the vertex that stands for the piece of v, and shortens the way to it.
static int sdv_root(int *parent, int v)
{
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
}

// Counts the pieces: joins the ends of every edge.
static void sdv_count_components(subdiv_info *info, const sdv_level *level, int *parent)
{
    for (int v = 0; v < level->vertex_count; v++) parent[v] = v;
    for (int e = 0; e < level->edge_count; e++) {
        int h = level->edge_first[e];
        int a = sdv_root(parent, level->face_vertices[h]);
        int b = sdv_root(parent, level->face_vertices[sdv_next(level, h)]);
        parent[a > b ? a : b] = a > b ? b : a;
    }
    for (int v = 0; v < level->vertex_count; v++)
        info->component_count += parent[v] == v && level->vertex_faces[v] > 0;
}

SUBDIV_DEF subdiv_result subdiv_inspect(subdiv_info *info, const subdiv_mesh *mesh,
                                        const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    if (info) memset(info, 0, sizeof *info);
    else sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "info is NULL");
    if (!context.result) sdv_check_all(&context, mesh);
    if (context.result) return context.result;

    sdv_arena arena = sdv_scratch();
    sdv_cage cage;
    sdv_plain_cage(&context, &arena, &cage, mesh);
    int *parent = SDV_NEW(&context, &arena, int, mesh->vertex_count);
    if (!context.result) sdv_user_sharpness(&context, &cage.level, mesh);
    if (!context.result) {
        info->vertex_count = mesh->vertex_count;
        info->edge_count = cage.level.edge_count;
        info->face_count = mesh->face_count;
        sdv_count_parts(info, &cage, mesh->scheme == SUBDIV_LOOP ? 6 : 4);
        sdv_count_components(info, &cage.level, parent);
    }
    sdv_arena_free(&arena);
    return context.result;
}

// ------------------------------------------------------------------------------ >>oddities
// Finds what subdiv_check reports, kind by kind. Each kind looks once at every face, edge, vertex
// or entry.

typedef struct sdv_checker {
    const subdiv_mesh *mesh;
    sdv_cage cage;                      // without creases and corners
    int *counts;
    subdiv_report report;
    void *user;
    int *ends;                          // [2 * edge_count]  vertices of each edge, the lower first
    unsigned char *repeats;             // [edge_count]  1: the first edge of several that have the
                                        //               same ends, as a face has it twice; 2: later
    int *crease_edges;                  // [crease_count]  -1: no edge
    int *last;                          // [max of vertices, face-vertices]  marks of items
    int *heads;                         // [mask + 1]  a hash table of items: the latest of each
    int *next;                          // [as last]   hash, and the one before each item; or -1
    size_t mask;
} sdv_checker;

static void sdv_found(const sdv_checker *checker, subdiv_oddity kind, int face, int other_face,
                      int vertex, int other_vertex, const char *format, ...)
{
    char text[256];
    subdiv_finding finding = { kind, face, other_face, vertex, other_vertex, text };
    if (checker->counts && checker->counts[kind] < INT_MAX) checker->counts[kind]++;
    if (!checker->report) return;
    va_list args;
    va_start(args, format);
    sdv_text out = { text, 0, sizeof text };
    sdv_format(&out, format, args);
    va_end(args);
    checker->report(checker->user, &finding);
}

// Reports edges with more than two faces. (An edge that a face has twice counts once for it.)
static void sdv_report_nonmanifold_edges(const sdv_checker *checker)
{
    const sdv_level *level = &checker->cage.level;
    for (int e = 0; e < level->edge_count; e++) {
        const int *ends = checker->ends + 2 * (size_t)e;
        int first = level->edge_first[e], count = sdv_edge_faces(level, first), h = first;
        if (count < 3) continue;
        char text[128];
        sdv_text faces = { text, 0, sizeof text };
        for (int i = 0; i < count && i < 8; i++, h = level->across[h])
            sdv_say(&faces, i ? ", %d" : "%d", sdv_face_of(level, h));
        if (count > 8) sdv_say(&faces, ", ...");
        sdv_found(checker, SUBDIV_ODD_NONMANIFOLD_EDGE, sdv_face_of(level, first),
                  sdv_face_of(level, level->across[first]), ends[0], ends[1],
                  "edge %d-%d has %d faces: %s", ends[0], ends[1], count, text);
    }
}

// Reports two faces that run the same way along an edge, unless one of them has it twice.
static void sdv_report_flipped_faces(const sdv_checker *checker)
{
    const sdv_level *level = &checker->cage.level;
    for (int e = 0; e < level->edge_count; e++) {
        const int *ends = checker->ends + 2 * (size_t)e;
        int h = level->edge_first[e], k = level->across[h];
        if (k == h || level->across[k] != h || checker->repeats[e] == 1) continue;
        if (level->face_vertices[h] != level->face_vertices[k]) continue;
        int f = sdv_face_of(level, h), g = sdv_face_of(level, k);
        sdv_found(checker, SUBDIV_ODD_FLIPPED_FACE, f, g, ends[0], ends[1],
                  "faces %d and %d run along edge %d-%d in the same direction", f, g, ends[0],
                  ends[1]);
    }
}

// Marks the face-vertices of the fan of h around its vertex.
static void sdv_mark_fan(const sdv_level *level, int h, int *marks)
{
    for (int at = h; at >= 0 && !marks[at]; at = sdv_clockwise(level, at)) marks[at] = 1;
    int at = sdv_counter_clockwise(level, h);
    for (; at >= 0 && !marks[at]; at = sdv_counter_clockwise(level, at)) marks[at] = 1;
}

// Reports vertices whose faces are several fans, though all edges there are manifold.
static void sdv_report_nonmanifold_vertices(const sdv_checker *checker)
{
    const sdv_cage *cage = &checker->cage;
    const sdv_level *level = &cage->level;
    for (int h = 0; h < level->face_vertex_count; h++) checker->last[h] = 0;
    for (int v = 0; v < level->vertex_count; v++) {
        if (!cage->vertex_nonmanifold[v] || sdv_count_edges_at(cage, v).nonmanifold) continue;
        int fans = 0, face[2] = { -1, -1 };
        for (int h = level->vertex_first[v]; h >= 0; h = level->vertex_next[h]) {
            if (checker->last[h]) continue;
            if (fans < 2) face[fans] = sdv_face_of(level, h);
            fans++;
            sdv_mark_fan(level, h, checker->last);
        }
        if (fans > 1)
            sdv_found(checker, SUBDIV_ODD_NONMANIFOLD_VERTEX, face[0], face[1], v, -1,
                      "the faces at vertex %d form %d fans, one with face %d, one with face %d",
                      v, fans, face[0], face[1]);
    }
}

// Do two faces have the same vertices, each as often? checker->last is 0, before and after.
static int sdv_same_vertices(const sdv_checker *checker, int f, int g)
{
    const sdv_level *level = &checker->cage.level;
    int size = sdv_face_end(level, f) - sdv_face_start(level, f), same = 1;
    if (sdv_face_end(level, g) - sdv_face_start(level, g) != size) return 0;
    const int *a = level->face_vertices + sdv_face_start(level, f);
    const int *b = level->face_vertices + sdv_face_start(level, g);
    for (int i = 0; i < size; i++) {
        checker->last[a[i]]++;
        checker->last[b[i]]--;
    }
    for (int i = 0; i < size; i++) {
        if (checker->last[a[i]] || checker->last[b[i]]) same = 0;
        checker->last[a[i]] = checker->last[b[i]] = 0;
    }
    return same;
}

static void sdv_report_duplicate_faces(const sdv_checker *checker)
{
    const sdv_level *level = &checker->cage.level;
    for (int v = 0; v < level->vertex_count; v++) checker->last[v] = 0;
    for (size_t i = 0; i <= checker->mask; i++) checker->heads[i] = -1;
    for (int f = 0; f < level->face_count; f++) {
        uint64_t sum = 0;                           // the same in any order
        for (int h = sdv_face_start(level, f); h < sdv_face_end(level, f); h++)
            sum += sdv_mix((uint64_t)level->face_vertices[h] + 1);
        int *head = &checker->heads[(size_t)sdv_mix(sum) & checker->mask], first = *head;
        while (first >= 0 && !sdv_same_vertices(checker, first, f)) first = checker->next[first];
        if (first >= 0) {
            sdv_found(checker, SUBDIV_ODD_DUPLICATE_FACE, f, first, -1, -1,
                      "face %d has the same vertices as face %d", f, first);
            continue;
        }
        checker->next[f] = *head;
        *head = f;
    }
}

// Reports the worst that each face repeats: a vertex twice in a row, an edge, or just a vertex.
static void sdv_report_repeated_vertices(const sdv_checker *checker)
{
    const sdv_level *level = &checker->cage.level;
    for (int v = 0; v < level->vertex_count; v++) checker->last[v] = -1;
    for (int f = 0; f < level->face_count; f++) {
        int in_row = -1, edge = -1, vertex = -1;
        for (int h = sdv_face_start(level, f); h < sdv_face_end(level, f); h++) {
            int v = level->face_vertices[h], e = level->face_edges[h];
            if (in_row < 0 && v == level->face_vertices[sdv_next(level, h)]) in_row = v;
            if (edge < 0 && checker->repeats[e] == 2) edge = e;
            if (vertex < 0 && checker->last[v] == f) vertex = v;
            checker->last[v] = f;
        }
        const int *ends = edge < 0 ? NULL : checker->ends + 2 * (size_t)edge;
        if (in_row >= 0)
            sdv_found(checker, SUBDIV_ODD_REPEATED_VERTEX, f, -1, in_row, -1,
                      "face %d has vertex %d twice in a row", f, in_row);
        else if (ends)
            sdv_found(checker, SUBDIV_ODD_REPEATED_VERTEX, f, -1, ends[0], ends[1],
                      "face %d has edge %d-%d more than once", f, ends[0], ends[1]);
        else if (vertex >= 0)
            sdv_found(checker, SUBDIV_ODD_REPEATED_VERTEX, f, -1, vertex, -1,
                      "face %d has vertex %d more than once", f, vertex);
    }
}

static void sdv_report_no_area(const sdv_checker *checker)
{
    const sdv_level *level = &checker->cage.level;
    for (int f = 0; f < level->face_count; f++) {
        double n[3];
        sdv_face_normal(checker->mesh->positions, level, f, n);
        if (n[0] == 0 && n[1] == 0 && n[2] == 0)
            sdv_found(checker, SUBDIV_ODD_NO_AREA, f, -1, -1, -1, "face %d has no area", f);
    }
}

static void sdv_report_unused_vertices(const sdv_checker *checker)
{
    const sdv_level *level = &checker->cage.level;
    for (int v = 0; v < level->vertex_count; v++)
        if (level->vertex_faces[v] == 0)
            sdv_found(checker, SUBDIV_ODD_UNUSED_VERTEX, -1, -1, v, -1,
                      "no face has vertex %d", v);
}

static void sdv_report_same_places(const sdv_checker *checker)
{
    int *first = checker->last;
    sdv_find_firsts(checker->mesh->positions, 3, checker->mesh->vertex_count, checker->heads,
                    checker->mask, checker->next, first);
    for (int v = 0; v < checker->mesh->vertex_count; v++)
        if (first[v] != v)
            sdv_found(checker, SUBDIV_ODD_SAME_PLACE, -1, -1, v, first[v],
                      "vertex %d is at the same place as vertex %d", v, first[v]);
}

static void sdv_report_stray_creases(const sdv_checker *checker)
{
    const subdiv_mesh *mesh = checker->mesh;
    for (int i = 0; i < mesh->crease_count; i++) {
        const int *ends = mesh->crease_vertices + 2 * (size_t)i;
        checker->crease_edges[i] = sdv_find_edge(&checker->cage.level, ends[0], ends[1]);
        if (checker->crease_edges[i] < 0)
            sdv_found(checker, SUBDIV_ODD_STRAY_CREASE, -1, -1, ends[0], ends[1],
                      "crease %d: no edge joins vertices %d and %d", i, ends[0], ends[1]);
    }
}

// Reports the entries of each list that name the same edge, vertex or face once more.
static void sdv_report_listed_twice(const sdv_checker *checker)
{
    const subdiv_mesh *mesh = checker->mesh;
    const struct { const char *text; const int *items; int count, all; } lists[] = {
        { "creases %d and %d are both edge %d-%d", checker->crease_edges, mesh->crease_count,
          checker->cage.level.edge_count },
        { "corners %d and %d are both vertex %d", mesh->corner_vertices, mesh->corner_count,
          mesh->vertex_count },
        { "holes %d and %d are both face %d", mesh->holes, mesh->hole_count, mesh->face_count }
    };
    for (int k = 0, *last = checker->last; k < 3; k++) {
        for (int i = 0; i < lists[k].all; i++) last[i] = -1;
        for (int i = 0; i < lists[k].count; i++) {
            int item = lists[k].items[i];
            if (item < 0) continue;
            int a = k ? item : checker->ends[2 * item], b = k ? -1 : checker->ends[2 * item + 1];
            if (last[item] >= 0)
                sdv_found(checker, SUBDIV_ODD_LISTED_TWICE, k == 2 ? a : -1, -1, k < 2 ? a : -1, b,
                          lists[k].text, last[item], i, a, b);
            last[item] = i;
        }
    }
}

static void sdv_report_partial_uvs(const sdv_checker *checker)
{
    const sdv_level *level = &checker->cage.level;
    for (int f = 0; f < level->face_count && checker->mesh->uv_count > 0; f++) {
        int start = sdv_face_start(level, f), size = sdv_face_end(level, f) - start, count = 0;
        for (int i = 0; i < size; i++) count += checker->mesh->face_uvs[start + i] >= 0;
        if (count > 0 && count < size)
            sdv_found(checker, SUBDIV_ODD_PARTIAL_UVS, f, -1, -1, -1,
                      "face %d has UVs at %d of its %d vertices", f, count, size);
    }
}

// Finds the ends of each edge, and the edges that a face has more than once.
static void sdv_find_ends(const sdv_checker *checker)
{
    const sdv_level *level = &checker->cage.level;
    for (int e = 0; e < level->edge_count; e++) {
        int h = level->edge_first[e], a = level->face_vertices[h];
        int b = level->face_vertices[sdv_next(level, h)], *ends = checker->ends + 2 * (size_t)e;
        int first = checker->cage.edge_nonmanifold[e] ? sdv_find_edge(level, a, b) : e;
        ends[0] = a < b ? a : b;
        ends[1] = a < b ? b : a;
        checker->repeats[e] = 0;
        if (first == e) continue;
        checker->repeats[first] = 1;
        checker->repeats[e] = 2;
    }
}

static void sdv_checker_begin(sdv_context *context, sdv_arena *arena, sdv_checker *checker,
                              const subdiv_mesh *mesh)
{
    const sdv_level *level = &checker->cage.level;
    checker->mesh = mesh;
    sdv_plain_cage(context, arena, &checker->cage, mesh);
    int edges = level->edge_count, vertices = mesh->vertex_count;
    int items = level->face_vertex_count > vertices ? level->face_vertex_count : vertices;
    checker->mask = 1;
    while (checker->mask < (size_t)items) checker->mask = 2 * checker->mask + 1;
    checker->ends = SDV_NEW(context, arena, int, 2 * (size_t)edges);
    checker->repeats = SDV_NEW(context, arena, unsigned char, edges);
    checker->crease_edges = SDV_NEW(context, arena, int, mesh->crease_count);
    checker->last = SDV_NEW(context, arena, int, items);
    checker->heads = SDV_NEW(context, arena, int, checker->mask + 1);
    checker->next = SDV_NEW(context, arena, int, items);
    if (!context->result) sdv_find_ends(checker);
}

SUBDIV_DEF subdiv_result subdiv_check(int *counts, const subdiv_mesh *mesh, subdiv_report report,
                                      void *user, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_arena arena = sdv_scratch();
    sdv_checker checker;
    memset(&checker, 0, sizeof checker);
    checker.counts = counts;
    checker.report = report;
    checker.user = user;
    for (int i = 0; counts && i < SUBDIV_ODDITY_COUNT; i++) counts[i] = 0;
    sdv_check_all(&context, mesh);
    if (!context.result) sdv_checker_begin(&context, &arena, &checker, mesh);
    if (!context.result) {
        sdv_report_nonmanifold_edges(&checker);
        sdv_report_flipped_faces(&checker);
        sdv_report_nonmanifold_vertices(&checker);
        sdv_report_duplicate_faces(&checker);
        sdv_report_repeated_vertices(&checker);
        sdv_report_no_area(&checker);
        sdv_report_unused_vertices(&checker);
        sdv_report_same_places(&checker);
        sdv_report_stray_creases(&checker);
        sdv_report_listed_twice(&checker);
        sdv_report_partial_uvs(&checker);
    }
    sdv_arena_free(&arena);
    return context.result;
}
#endif // SUBDIV_NO_TOOLS

#if !defined(SUBDIV_NO_OBJ) || !defined(SUBDIV_NO_TOOLS)
// ------------------------------------------------------------------------------- >>numbers
// Reads text as the nearest float and writes a float as its shortest text, whatever the locale. 53
// or 64 bits are enough unless a number is so close to where the answer changes that their error
// could matter. Then large integers decide.

static const double sdv_tens[] = { 1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12,
    1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };

// Returns number * 10^ten, to about 4 ulp.
static double sdv_scale(double number, int64_t ten)
{
    for (; ten > 22; ten -= 22) number *= 1e22;
    for (; ten < -22; ten += 22) number /= 1e22;
    return ten < 0 ? number / sdv_tens[-ten] : number * sdv_tens[ten];
}

typedef struct sdv_decimal {            // head * 10^exponent, or a little more
    uint64_t head;                      // the first digits, up to 19
    int      head_count;
    int64_t  exponent;
    int      more;                      // there are more digits than head has
    const char *digits, *end;           // if more: all digits, with leading zeros and a point
} sdv_decimal;

typedef struct sdv_big {                // an unsigned integer of up to 1536 bits
    uint32_t words[48];                 // lowest first, 0 from size on
    int size;
} sdv_big;

static sdv_big sdv_big_of(uint64_t number)
{
    sdv_big big = { { (uint32_t)number, (uint32_t)(number >> 32) }, 2 };
    return big;
}

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
    for (int i = 47; i >= 0; i--)
        if (a->words[i] != b->words[i]) return a->words[i] < b->words[i] ? -1 : 1;
    return 0;
}

// Returns -1, 0 or 1: the decimal is less than, equal to or greater than the middle of two floats.
// A middle has at most 113 digits, so of those behind the first 120 only one that is not 0 matters.
static int sdv_compare_decimal(const sdv_decimal *decimal, double middle)
{
    int count = decimal->more ? 0 : decimal->head_count, binary = 0, rest = 0;
    sdv_big left = sdv_big_of(decimal->more ? 0 : decimal->head);
    for (const char *p = decimal->digits; decimal->more && p < decimal->end; p++) {
        if (*p == '.' || (count == 0 && *p == '0')) continue;
        if (count == 120) {
            rest |= *p != '0';
        } else {
            sdv_big_step(&left, 10, (uint32_t)(*p - '0'));
            count++;
        }
    }
    // middle = right * 2^(binary-53)
    sdv_big right = sdv_big_of((uint64_t)ldexp(frexp(middle, &binary), 53));
    int64_t ten = decimal->head_count + decimal->exponent - count;
    sdv_big_power(ten > 0 ? &left : &right, 10, ten > 0 ? ten : -ten);
    sdv_big_power(binary > 53 ? &right : &left, 2, binary > 53 ? binary - 53 : 53 - binary);
    int order = sdv_big_compare(&left, &right);
    return order == 0 ? rest : order;
}

// Returns the nearest float, of two equally near the even one, and infinity if it is too large.
static float sdv_nearest_float(const sdv_decimal *decimal)
{
    int64_t magnitude = decimal->head_count + decimal->exponent;    // below 10^magnitude
    if (decimal->head == 0 || magnitude < -45) return 0;
    if (magnitude > 39) return (float)HUGE_VAL;
    double d = sdv_scale((double)decimal->head, decimal->exponent), middle;
    if (d >= (double)FLT_MIN) {
        uint64_t bits;
        memcpy(&bits, &d, sizeof bits);
        int64_t above = (int64_t)(bits & 0x1fffffff) - 0x10000000;  // the middle, in ulp of d
        if (above < -16 || above > 16) return (float)d;
        bits -= (uint64_t)above;
        memcpy(&middle, &bits, sizeof middle);
    } else {
        double step = ldexp(1, -149), units = floor(d / step);      // denormals have even steps
        if (fabs(d / step - units - 0.5) > ldexp(units + 1, -48)) return (float)d;
        middle = (units + 0.5) * step;
    }
    return (float)(middle * (1 + sdv_compare_decimal(decimal, middle) * ldexp(1, -50)));
}

// Finds, by trial, the fewest digits, 1 to 9, that read back as the same float: digits * 10^ten.
static uint32_t sdv_shortest(float number, int *ten)
{
    double size = (double)number;
    int e = (int)floor(log10(size)), binary;
    int twice_above = frexp(size, &binary) == 0.5;  // the next float is farther above than below
    if (sdv_scale(size, -e) < 1) e--;
    if (sdv_scale(size, -e) >= 10) e++;
    sdv_decimal decimal = { 0, 0, 0, 0, NULL, NULL };
    // With 6 digits every float is hit that a shorter decimal hits; denormals have fewer.
    for (int count = size < (double)FLT_MIN ? 1 : 6; count <= 9; count++) {
        *ten = e + 1 - count;
        decimal.head = (uint64_t)(sdv_scale(size, -*ten) + 0.5);
        decimal.exponent = *ten;
        decimal.head_count = count;
        if (sdv_nearest_float(&decimal) == number) break;
        decimal.head += (uint64_t)twice_above;
        if (twice_above && sdv_nearest_float(&decimal) == number) break;
    }
    return (uint32_t)decimal.head;
}

// Writes digits * 10^ten in at most 15 characters: 1200, 12, 0.0012 or 1.2e-8. Returns their end.
static char *sdv_write_decimal(char *p, uint32_t digits, int ten)
{
    for (; digits && digits % 10 == 0; digits /= 10) ten++;
    char buffer[24], *end = buffer + sizeof buffer, *first = sdv_digits(end, digits);
    int count = (int)(end - first), point = count + ten;    // digits before the point
    if (point > 9 || point < -4) {
        ten = point - 1;
        point = 1;
    } else {
        ten = 0;
    }
    for (int i = point < 1 ? point - 1 : 0; i < count || i < point; i++) {
        if (i == point) *p++ = '.';
        *p++ = (char)(i < 0 || i >= count ? '0' : first[i]);
    }
    if (ten == 0) return p;
    *p++ = 'e';
    if (ten < 0) *p++ = '-';
    for (first = sdv_digits(end, (uint64_t)(ten < 0 ? -ten : ten)); first < end;) *p++ = *first++;
    return p;
}

// Writes the shortest text of any float, by trial. Returns where it ends.
static char *sdv_write_exactly(char *p, float number)
{
    float size = fabsf(number);
    uint32_t digits = 0;
    int ten = 0;
    if (copysignf(1, number) < 0) *p++ = '-';
    if (size > 0) digits = sdv_shortest(size, &ten);
    return sdv_write_decimal(p, digits, ten);
}

#endif // numbers

#ifndef SUBDIV_NO_OBJ
static int sdv_is_digit(char c)
{
    return c >= '0' && c <= '9';
}

// Reads [+-]digits, of a huge number only the first. Returns where they end, NULL without digits.
SDV_INLINE const char *sdv_read_integer(const char *p, int64_t *out)
{
    const char sign = *p, *first = p += sign == '-' || sign == '+';
    uint64_t number = 0, digit;
    for (; (digit = (unsigned char)*p - (uint64_t)'0') < 10; p++)
        if (number < INT64_MAX / 100) number = number * 10 + digit;
    *out = sign == '-' ? -(int64_t)number : (int64_t)number;
    return p > first ? p : NULL;
}

// Reads most numbers at once: up to 18 digits without an exponent, if the float is the same a bit
// below and a bit above the double. Returns where they end, NULL for others.
SDV_INLINE const char *sdv_read_short_number(const char *p, float *out)
{
    static const double units[] = { 1, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10,
                                    1e-11, 1e-12, 1e-13, 1e-14, 1e-15, 1e-16, 1e-17, 1e-18 };
    static const double signs[] = { 1, -1 };
    const double error = 2e-15;
    size_t negative = *p == '-', count = 0, decimals = 0;
    uint64_t head = 0, digit;
    for (p += negative; (digit = (unsigned char)p[count] - (uint64_t)'0') < 10; count++)
        head = head * 10 + digit;
    p += count;
    if (*p == '.') {
        for (p++; (digit = (unsigned char)p[decimals] - (uint64_t)'0') < 10; decimals++)
            head = head * 10 + digit;
        p += decimals;
    }
    if (count + decimals - 1 > 17) return NULL;
    double d = (double)(int64_t)head * units[decimals] * signs[negative];
    *out = (float)(d * (1 - error));
    return *out == (float)(d * (1 + error)) ? p : NULL;
}

// Reads [+-]digits[.digits][e[+-]digits], any number of digits. Returns where it ends, NULL if it
// is anything else.
static const char *sdv_read_number(const char *p, float *out)
{
    const char *end = sdv_read_short_number(p, out);
    if (end && *end != 'e' && *end != 'E') return end;
    int negative = *p == '-', point = 0, count = 0;
    int64_t power = 0;
    if (*p == '-' || *p == '+') p++;
    sdv_decimal decimal = { 0, 0, 0, 0, p, p };
    for (; sdv_is_digit(*p) || (*p == '.' && !point); p++) {
        if (*p == '.') {
            point = 1;
        } else if (count++, decimal.head_count < 19) {
            decimal.head = decimal.head * 10 + (uint64_t)(*p - '0');
            decimal.head_count += decimal.head != 0;
            decimal.exponent -= point;
        } else {
            decimal.more = 1;
            decimal.exponent += !point;
        }
    }
    decimal.end = p;
    if (*p == 'e' || *p == 'E') p = sdv_read_integer(p + 1, &power);
    if (count == 0 || !p) return NULL;
    decimal.exponent += power;
    *out = sdv_nearest_float(&decimal);
    if (negative) *out = -*out;
    return p;
}

typedef struct sdv_figures {            // tables for writing many numbers
    int      tens[256];                 // [exponent of a float] the next is 1 to 10 units of
                                        // 10^tens away, the gap
    uint64_t gaps[256];                 // in units of 10^tens / 2^36; 0: find the text by trial
    uint32_t quads[10000];              // 0000 to 9999, the first digit in the lowest byte
} sdv_figures;

static void sdv_make_figures(sdv_figures *figures)
{
    memset(figures->gaps, 0, sizeof figures->gaps);
    for (int exponent = 2; exponent < 255; exponent++) {
        int binary = exponent - 150;                            // 1233/4096 is log10(2)
        int ten = (binary * 1233 + 256 * 4096) / 4096 - 256;
        double gap = sdv_scale(ldexp(1, binary), -ten);
        figures->gaps[exponent] = (uint64_t)(ldexp(gap, 36) + 0.5);
        figures->tens[exponent] = ten;
    }
    for (uint32_t i = 0; i < 10000; i++)
        figures->quads[i] = 0x30303030 + (i / 1000 | i / 100 % 10 << 8 | i / 10 % 10 << 16 |
                                          i % 10 << 24);
}

// Returns a number below 10^8 as text with all 8 digits, the first one in the lowest byte.
SDV_INLINE uint64_t sdv_eight_digits(const sdv_figures *figures, uint32_t number)
{
    uint32_t high = number / 10000;
    return figures->quads[high] | (uint64_t)figures->quads[number - 10000 * high] << 32;
}

// Finds the first and the last of 8 digits that is not 0. There is one.
SDV_INLINE void sdv_find_digits(uint64_t text, int *first, int *last)
{
    uint64_t others = text ^ 0x3030303030303030u;
#if defined(__GNUC__)
    *first = __builtin_ctzll(others) / 8;
    *last = (63 - __builtin_clzll(others)) / 8;
#else
    for (*first = 0; !(others >> 8 * *first & 255);) ++*first;
    for (*last = 7; !(others >> 8 * *last);) --*last;
#endif
}

SDV_INLINE void sdv_store_eight(char *p, uint64_t text)
{
    const uint16_t one = 1;
    if (*(const unsigned char *)&one)                           // the lowest byte first
        memcpy(p, &text, sizeof text);
    else
        for (int i = 0; i < 8; i++) p[i] = (char)(text >> 8 * i & 255);
}

// Writes a blank and the shortest text, mostly at once. They have at most 17 characters; up to 8
// more may be spoiled. Returns where they end.
//
// All numbers up to half a gap away read back as this float, and gaps are 1 to 10 units of 10^ten.
// So at most one multiple of 10 is among them. It has fewer digits than all others; without it, the
// nearest multiple of 1 is the answer. A power of 2 counts as the last number before it, plus one:
// its gap is the one below. Above there is more room, which only matters if nothing is found.
SDV_INLINE char *sdv_write_float(const sdv_figures *figures, char *p, const float *number)
{
    const uint64_t one = (uint64_t)1 << 36, doubt = one >> 11;
    uint32_t bits;
    memcpy(&bits, number, sizeof bits);
    uint32_t exponent = (bits - 1) >> 23 & 255, mantissa = ((bits - 1) & 0x7fffff) + 0x800001;
    uint64_t gap = figures->gaps[exponent], size = mantissa * gap, high = size + gap / 2;
    uint32_t tens = (uint32_t)(high >> 36) / 10, ones = (uint32_t)((size + one / 2) >> 36);
    uint64_t below_high = high - 10 * tens * one, outside = below_high - gap;
    uint32_t inside = (uint32_t)(outside >> 63);
    *p++ = ' ';
    if (below_high - doubt > 10 * one - 2 * doubt || outside + doubt < 2 * doubt ||
        inside < mantissa >> 24) return sdv_write_exactly(p, *number);      // also if gap is 0
    uint32_t digits = ones ^ ((ones ^ tens) & (0 - inside));
    int ten = figures->tens[exponent] + (int)inside;

    *p = '-';
    p += bits >> 31;
    if (digits >= 100000000) return sdv_write_decimal(p, digits, ten);
    uint64_t text = sdv_eight_digits(figures, digits);
    int zeros, last;
    sdv_find_digits(text, &zeros, &last);
    int count = last + 1 - zeros, point = 8 - zeros + ten;
    text >>= 8 * zeros;
    if (point > 0 && ten < 0) {
        sdv_store_eight(p, text);
        p[point] = '.';
        sdv_store_eight(p + point + 1, text >> 8 * point);
        return p + (count > point ? count + 1 : point);         // 1.2 or 12
    }
    if (point <= 0 && point >= -4) {
        memcpy(p, "0.0000", 6);
        sdv_store_eight(p + 2 - point, text);
        return p + 2 - point + count;
    }
    return sdv_write_decimal(p, digits, ten);
}

// Writes a number from 0 on, and may spoil up to 10 characters. Returns where it ends.
SDV_INLINE char *sdv_write_index(const sdv_figures *figures, char *p, int number)
{
    if (number >= 100000000) {
        char digits[16], *end = digits + sizeof digits;
        for (const char *d = sdv_digits(end, (uint64_t)number); d < end;) *p++ = *d++;
        return p;
    }
    uint64_t text = sdv_eight_digits(figures, (uint32_t)number);
    int zeros = 7, last = 7;
    if (number) sdv_find_digits(text, &zeros, &last);
    sdv_store_eight(p, text >> 8 * zeros);
    return p + 8 - zeros;
}

// ------------------------------------------------------------------------------ >>obj-read
// The text comes in blocks. Statements are read where they lie in the buffer, once all of their
// lines are there; what is left of a block moves to the front before the next one is read. Behind
// the text there are always line ends, so nothing has to look whether the text is over.

// -------- OpenSubdiv's tags, as the reader finds and the writer writes them

enum { SDV_CREASES, SDV_CORNERS, SDV_HOLES, SDV_LISTS, SDV_RULES = 4 };

static const char *const sdv_list_tags[SDV_LISTS] = { "t crease 2/1/0", "t corner 1/1/0",
                                                      "t hole 1/0/0" };

// The tags of a mesh's rules: boundary, uv_rule, creasing, triangles. values: in the enum's order.
static const struct { const char *text, *values[7]; } sdv_rule_tags[SDV_RULES] = {
    { "t interpolateboundary 1/0/0 ", { "2", "1", "0" } },
    { "t facevaryinginterpolateboundary 1/0/0 ", { "1", "2", "3", "4", "5", "0" } },
    { "t creasemethod 0/0/1 ", { "normal", "chaikin" } },
    { "t smoothtriangles 0/0/1 ", { "catmark", "smooth" } } };

static void sdv_forget_errno(void)
{
#ifndef SUBDIV_NO_STDIO
    errno = 0;
#endif
}

// Fails because reading or writing failed. Often the system knows why.
static void sdv_fail_io(sdv_context *context, const char *what)
{
#ifndef SUBDIV_NO_STDIO
    if (errno) sdv_fail(context, SUBDIV_ERROR_IO, "%s: %s", what, strerror(errno));
#endif
    sdv_fail(context, SUBDIV_ERROR_IO, what);       // unless it has failed already
}

// Appends an item.
static void sdv_push(sdv_context *context, sdv_array *array, const void *item, size_t size)
{
    if (array->count == array->capacity &&
        !sdv_grow(context, array, 2 * array->count + 16, size)) return;
    memcpy((char *)(array->block + 1) + array->count++ * size, item, size);
}

// Appends the same item, of 4 bytes, until the array has count items.
static void sdv_fill(sdv_context *context, sdv_array *array, size_t count, const void *item)
{
    while (array->count < count && !context->result) sdv_push(context, array, item, 4);
}

// A large list stays where it is written: to move it would touch more memory. It is an arena whose
// blocks have SDV_FIRST bytes, twice as many, and so on. All are full but the newest.
enum { SDV_FIRST = 12288 };             // a multiple of all items

static size_t sdv_series_size(const sdv_arena *series)
{
    return series->chunk - SDV_FIRST - series->left;
}

SDV_INLINE void sdv_series_add(sdv_context *context, sdv_arena *series, const void *item,
                               size_t size)
{
    if (series->left == 0) {
        sdv_add_block(context, series, series->chunk);
        if (context->result) return;
        series->chunk *= 2;
    }
    memcpy(series->free, item, size);
    series->free += size;
    series->left -= size;
}

static void sdv_series_free_last(sdv_arena *series)
{
    sdv_block *last = series->blocks;
    series->blocks = last->next;
    series->chunk /= 2;
    series->free = series->blocks ? (char *)(series->blocks + 1) + series->chunk / 2 : NULL;
    series->left = 0;
    SUBDIV_FREE(last, last->user);
}

// Drops the last bytes.
static void sdv_series_drop(sdv_arena *series, size_t size)
{
    for (size_t in_last; size > (in_last = series->chunk / 2 - series->left); size -= in_last)
        sdv_series_free_last(series);
    if (size == 0) return;                                  // free may be NULL
    series->free -= size;
    series->left += size;
}

// Moves all items to an array, if there is one.
static void sdv_series_take(sdv_arena *series, void *to)
{
    for (; to && series->blocks; sdv_series_free_last(series))
        memcpy((char *)to + series->chunk / 2 - SDV_FIRST, series->blocks + 1,
               series->chunk / 2 - series->left);
}

typedef struct sdv_tag {                // one crease, corner or hole
    int kind, line;
    int at[2];                          // two vertices, or twice the same vertex or face
    float sharpness;
} sdv_tag;

typedef struct sdv_ahead {              // a face that names a vertex or vt which is yet to come
    int line, index;
} sdv_ahead;

typedef enum sdv_statement {
    SDV_VERTEX, SDV_UV, SDV_FACE, SDV_LINE, SDV_TAG, SDV_KEPT, SDV_PASSED, SDV_POINT,
    SDV_FREE_FORM, SDV_UNKNOWN, SDV_BARE_FACE, SDV_MIXED_FACE, SDV_STATEMENT_KINDS
} sdv_statement;                        // bare faces have no vt, mixed ones some, others all

typedef struct sdv_obj {
    sdv_context *context;
    subdiv_read  read;
    void        *user;
    sdv_array    text;                  // the buffer: begin to text.count is not yet used, and
    size_t       begin, complete;       // begin to complete are whole statements
    int          ended;                 // nothing more to read
    int          line, next_line;       // of the statement, and of what follows
    subdiv_mesh  mesh;                  // its face count and size, then all of it
    int          rules[SDV_RULES];
    sdv_arena    points[2], indices[2]; // series of vertices, of UVs, and of those of faces
    sdv_array    colors, face_sizes, line_sizes, line_vertices;
    sdv_array    ahead[2];              // of vertices, of UVs
    sdv_array    skipped;               // numbers of the file's faces that are not in the mesh
    int          counts[SDV_STATEMENT_KINDS];   // of vertices, UVs, faces, and what is skipped
    int          lines[SDV_STATEMENT_KINDS];    // of the first one, but for vertices and UVs
    sdv_array    statement_faces, statement_text, statements;
    sdv_array    ints, floats;          // of one tag
    sdv_array    tags;                  // all creases, corners and holes, in the file's order; and
    sdv_array    lists[SDV_LISTS], sharpness[SDV_LISTS];    // as the mesh has them
} sdv_obj;

static void sdv_fail_line(const sdv_obj *obj, subdiv_result code, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    sdv_fail_at(obj->context, code, obj->line, -1, -1, format, args);
    va_end(args);
}

// Finds where the last whole statement in the text ends, from first on: after a line end without a
// backslash. A CR at the very end does not count, as an LF may follow it. 0: there is none.
static size_t sdv_find_complete(const char *text, size_t first, size_t count)
{
    for (size_t i = count; i-- > first;) {
        if (text[i] != '\n' && (text[i] != '\r' || i + 1 == count)) continue;
        size_t last = i > 0 && text[i] == '\n' && text[i - 1] == '\r' ? i - 1 : i;
        if (last == 0 || text[last - 1] != '\\') return i + 1;
    }
    return 0;
}

// Reads more text behind what is there. Used text makes room first.
static void sdv_read_more(sdv_obj *obj)
{
    sdv_array *text = &obj->text;
    char *data = (char *)sdv_items(text);
    if (obj->begin) memmove(data, data + obj->begin, text->count - obj->begin);
    text->count -= obj->begin;
    obj->begin = obj->complete = 0;
    if (text->capacity - text->count < 3) sdv_grow(obj->context, text, 2 * text->capacity, 1);
    if (obj->context->result) return;
    data = (char *)sdv_items(text);
    size_t old = text->count, room = text->capacity - old - 2;
    sdv_forget_errno();
    size_t size = obj->read(obj->user, data + old, room);
    if (size > room) {
        sdv_fail_io(obj->context, "reading failed");
        return;
    }
    text->count += size;
    memset(data + text->count, '\n', 2);
    if (size) obj->complete = sdv_find_complete(data, old ? old - 1 : 0, text->count);
    else if (old) obj->complete = old + 2;      // 2 line ends: the last line may end in a backslash
    obj->ended = size == 0;
}

// -------- tokens

SDV_INLINE int sdv_is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\f' || c == '\v';
}

SDV_INLINE int sdv_is_newline(char c)
{
    return c == '\n' || c == '\r';
}

// Whether the statement ends here, with a line end or a comment.
SDV_INLINE int sdv_at_end(const char *p)
{
    return sdv_is_newline(*p) || *p == '#';
}

SDV_INLINE int sdv_continues(const char *p)          // the statement, on the next line
{
    return *p == '\\' && sdv_is_newline(p[1]);
}

SDV_INLINE const char *sdv_skip_newline(const char *p)
{
    return p + (p[0] == '\r' && p[1] == '\n' ? 2 : 1);
}

SDV_INLINE const char *sdv_next_line(sdv_obj *obj, const char *p)
{
    if (obj->next_line < INT_MAX) obj->next_line++;
    return sdv_skip_newline(p);
}

static const char *sdv_skip_blanks(sdv_obj *obj, const char *p)
{
    while (sdv_is_blank(*p) || sdv_continues(p)) p = *p == '\\' ? sdv_next_line(obj, p + 1) : p + 1;
    return p;
}

// Goes to the next token of a statement; returns 0 if there is none. Mostly one blank is before it.
SDV_INLINE int sdv_find_token(sdv_obj *obj, const char **at)
{
    const char *p = *at;
    if (*p == ' ' && (unsigned char)(p[1] - '-') <= '9' - '-') {
        *at = p + 1;
        return 1;
    }
    if (*p != '\n') p = sdv_skip_blanks(obj, p);
    *at = p;
    return !sdv_at_end(p);
}

// Whether a token ends before p. "-1.#IND" is one token, and not a number.
static int sdv_ends_token(const char *p)
{
    if ((unsigned char)*p > '#') return sdv_continues(p);
    return sdv_is_newline(*p) || sdv_is_blank(*p) || (*p == '#' && p[-1] != '.') || *p == 0;
}

typedef struct sdv_token {
    const char *begin, *end;
} sdv_token;

// Returns the token at p; empty at the end of the statement.
static sdv_token sdv_token_at(const char *p)
{
    sdv_token token = { p, p };
    if (sdv_at_end(p) || *p == 0) return token;
    do token.end++; while (!sdv_ends_token(token.end));
    return token;
}

static sdv_token sdv_next_token(sdv_obj *obj, const char **at)
{
    sdv_token token = sdv_token_at(sdv_skip_blanks(obj, *at));
    *at = token.end;
    return token;
}

// Whether the text begins with the same token.
static int sdv_token_is(sdv_token token, const char *text)
{
    while (token.begin < token.end && *token.begin == *text) token.begin++, text++;
    return token.begin == token.end && (*text == 0 || *text == ' ');
}

// Fails because of the token at p, the message's %t.
static void sdv_refuse(sdv_obj *obj, subdiv_result code, const char *p, const char *message)
{
    sdv_token token = sdv_token_at(p);
    if (*token.end == 0)
        sdv_fail_line(obj, SUBDIV_ERROR_SYNTAX, "binary data: not an OBJ file");
    else
        sdv_fail_line(obj, code, message, p, token.end);
}

// Skips the rest of a statement, whatever it is. Returns NULL after an error.
static const char *sdv_skip_statement(sdv_obj *obj, const char *p)
{
    for (int comment = 0;; p++) {
        while ((unsigned char)(*p - '$') < '\\' - '$' || *p == ' ') p++;
        if (*p == '#') comment = 1;
        if (sdv_is_newline(*p)) return sdv_next_line(obj, p);
        if (!comment && sdv_continues(p)) {
            p = sdv_next_line(obj, p + 1) - 1;
        } else if (*p == 0) {
            sdv_refuse(obj, SUBDIV_ERROR_SYNTAX, p, "");
            return NULL;
        }
    }
}

// -------- vertices and faces. Each of these functions returns where it stopped reading.

// Reads a number in any form, or refuses the token and returns NULL.
static const char *sdv_read_odd_number(sdv_obj *obj, const char *p, float *number)
{
    const char *end = sdv_read_number(p, number);
    if (!end || !sdv_ends_token(end))
        sdv_refuse(obj, SUBDIV_ERROR_SYNTAX, p, "\"%t\" is not a number");
    else if (fabs((double)*number) > (double)FLT_MAX)
        sdv_refuse(obj, SUBDIV_ERROR_NOT_FINITE, p, "\"%t\" is too large for a float");
    return obj->context->result ? NULL : end;
}

// Reads and counts numbers, at most so many.
SDV_INLINE const char *sdv_read_numbers(sdv_obj *obj, const char *p, float *numbers, int most,
                                    int *count)
{
    int n = 0;
    for (const char *end; n < most; p = end, n++) {
        end = *p == ' ' ? sdv_read_short_number(p + 1, &numbers[n]) : NULL;
        if (end && (*end == ' ' || *end == '\n')) continue;
        if (!sdv_find_token(obj, &p)) break;
        end = sdv_read_odd_number(obj, p, &numbers[n]);
        if (!end) break;
    }
    *count = n;
    return p;
}

// Reads x y z, then nothing, or w, or r g b, or r g b and alpha; of a vt u, u v or u v w.
SDV_INLINE const char *sdv_read_point(sdv_obj *obj, const char *p, int uv)
{
    static const float white = 1;
    float numbers[8] = { 0, 0, 0, 0, 0, 0, 0, 0 };
    int *made = &obj->counts[uv], count;
    p = sdv_read_numbers(obj, p, numbers, uv ? 3 : 8, &count);
    if (obj->context->result) return p;
    if (count < (uv ? 1 : 3))
        sdv_fail_line(obj, SUBDIV_ERROR_SYNTAX, uv ? "a vt needs 1 to 3 numbers"
                      : "a vertex needs 3 coordinates, here are %d", count);
    if (*made == INT_MAX)
        sdv_fail_line(obj, SUBDIV_ERROR_TOO_LARGE, "too many %s", uv ? "vt" : "vertices");
    sdv_series_add(obj->context, &obj->points[uv], numbers, (uv ? 2 : 3) * sizeof(float));
    if (count == 6 || count == 7) {
        sdv_fill(obj->context, &obj->colors, 3 * (size_t)*made, &white);
        for (int i = 3; i < 6; i++)
            sdv_push(obj->context, &obj->colors, &numbers[i], sizeof(float));
    }
    ++*made;
    return p;
}

// Skips an integer, if there is one.
SDV_INLINE const char *sdv_skip_integer(const char *p)
{
    if ((*p == '-' || *p == '+') && sdv_is_digit(p[1])) p++;
    while (sdv_is_digit(*p)) p++;
    return p;
}

// Notes an index whose vertex or vt is yet to come. Only an index that is larger than all before it
// need be noted, as the first one that is too large in the end is one of these.
static void sdv_note_ahead(sdv_obj *obj, int uv, int index)
{
    sdv_array *ahead = &obj->ahead[uv];
    const sdv_ahead *entries = (const sdv_ahead *)sdv_items(ahead);
    sdv_ahead entry = { obj->line, index };
    if (ahead->count == 0 || entries[ahead->count - 1].index < index)
        sdv_push(obj->context, ahead, &entry, sizeof entry);
}

// Reads the index of a vertex or vt, counted from 1 or, if negative, back from the last so far.
// Returns where it ends, NULL if there is none.
static const char *sdv_read_any_index(sdv_obj *obj, const char *p, int uv, int *out)
{
    int64_t number;
    int count = obj->counts[uv];
    const char *end = sdv_read_integer(p, &number), *behind = end;
    if (!end) return NULL;
    int64_t index = number + (number < 0 ? count : -1);
    *out = (int)index;
    if (index >= count && index < INT_MAX) sdv_note_ahead(obj, uv, *out);
    if (index >= 0 && index < INT_MAX) return end;
    for (int i = uv; i < 2 && *behind == '/'; i++) behind = sdv_skip_integer(behind + 1);
    if (sdv_ends_token(behind))                     // otherwise the caller refuses the face-vertex
        sdv_fail_line(obj, SUBDIV_ERROR_INDEX,
                      number == 0 ? "%s %t does not exist (the first is 1)"
                                  : "%s %t does not exist (the file has %d so far)",
                      uv ? "vt" : "vertex", p, end, count);
    return end;
}

SDV_INLINE const char *sdv_read_index(sdv_obj *obj, const char *p, int uv, int *out)
{
    unsigned count = (unsigned)obj->counts[uv];
    unsigned number = 0, digit;
    const char *first = p;
    for (; (digit = (unsigned char)*p - (unsigned)'0') < 10; p++) number = number * 10 + digit;
    *out = (int)(number - 1);
    return p - first < 10 && number - 1 < count ? p : sdv_read_any_index(obj, first, uv, out);
}

static void sdv_count(sdv_obj *obj, sdv_statement kind)
{
    if (obj->counts[kind] == 0) obj->lines[kind] = obj->line;
    if (obj->counts[kind] < INT_MAX) obj->counts[kind]++;
}

// Counts a face whose vertices are kept already; uvs: how many of them have a vt.
static void sdv_add_face(sdv_obj *obj, size_t size, size_t uvs)
{
    subdiv_mesh *mesh = &obj->mesh;
    sdv_count(obj, uvs == size ? SDV_FACE : uvs ? SDV_MIXED_FACE : SDV_BARE_FACE);
    if (mesh->face_count == 0) mesh->face_size = (int)size;
    if (obj->face_sizes.count || mesh->face_size != (int)size) {
        int face_size = (int)size;
        sdv_fill(obj->context, &obj->face_sizes, (size_t)mesh->face_count, &mesh->face_size);
        sdv_push(obj->context, &obj->face_sizes, &face_size, sizeof face_size);
    }
    mesh->face_count++;
}

// Gives -1 to the face-vertices so far that have no UVs, except the last ones.
static void sdv_fill_uvs(sdv_obj *obj, size_t last)
{
    const int none = -1;
    size_t size = sdv_series_size(&obj->indices[0]) - last * sizeof(int);
    while (sdv_series_size(&obj->indices[1]) < size && !obj->context->result)
        sdv_series_add(obj->context, &obj->indices[1], &none, sizeof none);
}

static const char *sdv_read_face(sdv_obj *obj, const char *p)
{
    size_t size = 0, uvs = 0;
    for (; sdv_find_token(obj, &p); size++) {
        int v, t;
        const char *end = sdv_read_index(obj, p, 0, &v), *uv = NULL;
        if (end && *end == '/') {
            if (*++end != '/') uv = sdv_read_index(obj, end, 1, &t);
            if (uv) end = uv;
            if (*end == '/') end = sdv_skip_integer(end + 1);   // normals do not matter
        }
        if (!end || (*end != ' ' && *end != '\n' && !sdv_ends_token(end))) {
            sdv_refuse(obj, SUBDIV_ERROR_SYNTAX, p, "\"%t\" is not a face-vertex");
            return p;
        }
        sdv_series_add(obj->context, &obj->indices[0], &v, sizeof v);
        if (uv) {
            if (uvs++ == 0 && obj->counts[SDV_FACE] < obj->mesh.face_count)
                sdv_fill_uvs(obj, size + 1);
            sdv_series_add(obj->context, &obj->indices[1], &t, sizeof t);
        }
        p = end;
    }
    if (obj->context->result) return p;
    int number = obj->mesh.face_count + (int)obj->skipped.count;
    if (uvs && (uvs < size || size < 3)) sdv_series_drop(&obj->indices[1], uvs * sizeof(int));
    if (size > INT_MAX || number == INT_MAX) {
        sdv_fail_line(obj, SUBDIV_ERROR_TOO_LARGE, "too many faces");
    } else if (size < 3) {
        sdv_warn(obj->context, obj->line, "skipped: a face has 3 vertices or more, not %d",
                 (int)size);
        sdv_push(obj->context, &obj->skipped, &number, sizeof number);
        sdv_series_drop(&obj->indices[0], size * sizeof(int));
    } else {
        sdv_add_face(obj, size, uvs);
    }
    return p;
}

static const char *sdv_read_line(sdv_obj *obj, const char *p)
{
    size_t first = obj->line_vertices.count;
    for (int v; !obj->context->result && sdv_find_token(obj, &p); ) {
        const char *end = sdv_read_index(obj, p, 0, &v);
        if (end && *end == '/') end = sdv_skip_integer(end + 1);        // UVs do not matter
        if (end && sdv_ends_token(end)) sdv_push(obj->context, &obj->line_vertices, &v, sizeof v);
        else sdv_refuse(obj, SUBDIV_ERROR_SYNTAX, p, "\"%t\" is not a vertex of a line");
        p = end;
    }
    if (obj->context->result) return NULL;
    size_t count = obj->line_vertices.count - first;
    int size = count < INT_MAX ? (int)count : INT_MAX;
    if (size == INT_MAX || obj->line_sizes.count == INT_MAX)
        sdv_fail_line(obj, SUBDIV_ERROR_TOO_LARGE, "too many lines");
    if (size > 1) sdv_push(obj->context, &obj->line_sizes, &size, sizeof size);
    else sdv_warn(obj->context, obj->line, "skipped: a line has 2 vertices or more, not %d", size);
    if (size < 2) obj->line_vertices.count = first;
    return p;
}

// -------- tags

// Notes a tag of creases, corners or holes. All share one sharpness or each has its own; creases
// may be a chain of vertices, with one for each link. Returns 0 if it is anything else.
static int sdv_use_list(sdv_obj *obj, int kind)
{
    const int *at = (const int *)sdv_items(&obj->ints);
    const float *s = (const float *)sdv_items(&obj->floats);
    int width = kind == SDV_CREASES ? 2 : 1, ints = (int)obj->ints.count;
    int floats = (int)obj->floats.count;
    int chain = width == 2 && ints > 2 && floats == ints - 1, count = chain ? floats : ints / width;
    if (count == 0 || (ints % width && !chain)) return 0;
    if (kind != SDV_HOLES && floats != 1 && floats != count) return 0;
    for (int i = 0; i < count; i++, at += chain ? 1 : width) {
        sdv_tag tag = { kind, obj->line, { at[0], at[width - 1] }, 0 };
        if (kind != SDV_HOLES) tag.sharpness = s[floats == 1 ? 0 : i];
        if (tag.sharpness < 0)
            sdv_warn(obj->context, obj->line, "a sharpness below 0 is read as 0");
        if (!(tag.sharpness > 0)) tag.sharpness = 0;
        sdv_push(obj->context, &obj->tags, &tag, sizeof tag);
    }
    return 1;
}

// Uses a tag by its name; word is its first string. Returns 0 if it makes no sense.
static int sdv_use_tag(sdv_obj *obj, sdv_token name, sdv_token word)
{
    int value = obj->ints.count == 1 ? *(const int *)sdv_items(&obj->ints) : -1;
    for (int kind = 0; kind < SDV_LISTS; kind++)
        if (sdv_token_is(name, sdv_list_tags[kind] + 2)) return sdv_use_list(obj, kind);
    for (int i = 0; i < SDV_RULES; i++) {
        if (!sdv_token_is(name, sdv_rule_tags[i].text + 2)) continue;
        for (int k = 0; sdv_rule_tags[i].values[k]; k++) {
            const char *text = sdv_rule_tags[i].values[k];
            if (sdv_is_digit(*text) ? value != *text - '0' : !sdv_token_is(word, text)) continue;
            obj->rules[i] = k;
            return 1;
        }
    }
    return 0;
}

// Reads the counts of a tag, "ints/floats/strings". Returns 0 if it is anything else.
static int sdv_read_tag_counts(sdv_token token, int64_t counts[3])
{
    const char *p = token.begin;
    for (int i = 0; i < 3; i++) {
        if (i > 0 && (p == token.end || *p++ != '/')) return 0;
        p = sdv_read_integer(p, &counts[i]);
        if (!p || counts[i] < 0 || counts[i] > INT_MAX) return 0;
    }
    return p == token.end;
}

// Reads name ints/floats/strings ... and uses the tag. Makes room for the values that are there,
// not for those that the counts promise. Returns 0 if it makes no sense.
static int sdv_read_values(sdv_obj *obj, const char **at)
{
    int64_t counts[3], value;
    sdv_token name = sdv_next_token(obj, at), word = { *at, *at };
    if (!sdv_read_tag_counts(sdv_next_token(obj, at), counts)) return 0;
    obj->ints.count = obj->floats.count = 0;
    for (int64_t i = 0; i < counts[0] && !obj->context->result; i++) {
        sdv_token token = sdv_next_token(obj, at);
        if (sdv_read_integer(token.begin, &value) != token.end || value < 0) return 0;
        int index = value < INT_MAX ? (int)value : INT_MAX;     // found to be missing at the end
        sdv_push(obj->context, &obj->ints, &index, sizeof index);
    }
    for (int64_t i = 0; i < counts[1] && !obj->context->result; i++) {
        sdv_token token = sdv_next_token(obj, at);
        float number = SUBDIV_INFINITE;
        if (!sdv_token_is(token, "inf") && sdv_read_number(token.begin, &number) != token.end)
            return 0;
        sdv_push(obj->context, &obj->floats, &number, sizeof number);
    }
    if (counts[2] > 0) word = sdv_next_token(obj, at);
    return obj->context->result || sdv_use_tag(obj, name, word);
}

static const char *sdv_read_tag(sdv_obj *obj, sdv_token keyword)
{
    const char *p = keyword.end, *end = keyword.end;
    if (sdv_read_values(obj, &p)) return p;
    while (!sdv_at_end(end)) end++;
    sdv_warn(obj->context, obj->line, "the tag \"%t\" is skipped", keyword.begin, end);
    return p;
}

// -------- statements

// Keeps "usemtl stone" as it stands in the file, names with blanks and all, joined where it goes on
// in the next line. A # begins a comment if blanks are around it, as some names are "Material #25";
// smoothing groups have no names, so there any # will do. Returns what is behind, or NULL.
static const char *sdv_keep_statement(sdv_obj *obj, sdv_token keyword)
{
    const char *next = sdv_skip_statement(obj, keyword.end), *p = keyword.begin;
    int any = *p == 's', blank = 0;
    if (!next) return NULL;
    char *text = (char *)sdv_array_room(obj->context, &obj->statement_text,
                                        (size_t)(next - p) + 2, 1), *end = text;
    if (!text) return NULL;
    while (p < keyword.end) *end++ = *p++;
    *end++ = ' ';
    for (const char *name = end; p < next; p++) {
        if (*p == '#' && (any || p == keyword.end || (blank && sdv_ends_token(p + 1)))) break;
        blank = sdv_is_blank(*p) || sdv_is_newline(*p) || sdv_continues(p);
        if (sdv_continues(p)) p = sdv_skip_newline(p + 1) - 1;
        if (!blank || end > name) *end++ = (char)(sdv_is_newline(*p) ? ' ' : *p);
    }
    while (sdv_is_blank(end[-1])) end--;
    *end++ = 0;
    obj->statement_text.count += (size_t)(end - text);
    sdv_push(obj->context, &obj->statement_faces, &obj->mesh.face_count, sizeof(int));
    return next;
}

static sdv_statement sdv_statement_kind(sdv_token keyword)
{
    static const char *const words[] = { "v", "vt", "f fo", "l", "t", "g o s usemtl mtllib", "vn",
        "p", "vp cstype deg bmat step curv curv2 surf parm trim hole scrv sp end con ctech stech" };
    const char ctrl_z = 26;                         // ends the text of old editors
    if (keyword.begin == keyword.end || *keyword.begin == ctrl_z) return SDV_PASSED;
    for (int kind = SDV_VERTEX; kind < SDV_UNKNOWN; kind++) {
        for (const char *p = words[kind]; *p;) {
            if (sdv_token_is(keyword, p)) return (sdv_statement)kind;
            while (*p && *p++ != ' ') {}
        }
    }
    return SDV_UNKNOWN;
}

// Recognizes the statements that make up most of a file, at once.
SDV_INLINE sdv_statement sdv_usual_kind(const char *p)
{
    if (*p == 'v' && p[1] == ' ') return SDV_VERTEX;
    if (*p == 'f' && p[1] == ' ') return SDV_FACE;
    if (*p == 'v' && p[1] == 't' && p[2] == ' ') return SDV_UV;
    if (*p == 'v' && p[1] == 'n' && p[2] == ' ') return SDV_PASSED;
    return SDV_UNKNOWN;
}

// Returns what is behind, or NULL after an error.
static const char *sdv_read_statement(sdv_obj *obj, const char *p)
{
    sdv_statement kind = sdv_usual_kind(p);
    sdv_token keyword = { p, kind == SDV_UV || kind == SDV_PASSED ? p + 2 : p + 1 };
    obj->line = obj->next_line;
    if (kind == SDV_UNKNOWN) {
        keyword = sdv_token_at(sdv_skip_blanks(obj, p));
        kind = sdv_statement_kind(keyword);
    }
    p = keyword.end;
    if (kind == SDV_VERTEX) {
        p = sdv_read_point(obj, p, 0);
    } else if (kind == SDV_FACE) {
        p = sdv_read_face(obj, p);
    } else if (kind == SDV_UV) {
        p = sdv_read_point(obj, p, 1);
    } else if (kind == SDV_LINE) {
        p = sdv_read_line(obj, p);
    } else if (kind == SDV_KEPT) {
        return sdv_keep_statement(obj, keyword);
    } else if (kind == SDV_TAG) {
        p = sdv_read_tag(obj, keyword);
    } else {
        sdv_count(obj, kind);
        if (obj->line == 1 && strncmp(keyword.begin, "version https://git-lfs", 23) == 0)
            sdv_fail_line(obj, SUBDIV_ERROR_SYNTAX, "a Git LFS pointer, not the file itself");
    }
    if (obj->context->result) return NULL;
    return *p == '\n' ? sdv_next_line(obj, p) : sdv_skip_statement(obj, p);
}

// -------- the whole file

static void sdv_skip_byte_order_mark(sdv_obj *obj)
{
    while (obj->text.count < 3 && !obj->ended && !obj->context->result) sdv_read_more(obj);
    if (obj->context->result || obj->text.count < 2) return;
    const unsigned char *text = (const unsigned char *)sdv_items(&obj->text);
    if (obj->text.count >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) obj->begin = 3;
    if ((text[0] == 0xFF && text[1] == 0xFE) || (text[0] == 0xFE && text[1] == 0xFF))
        sdv_fail_line(obj, SUBDIV_ERROR_SYNTAX, "UTF-16 text: not an OBJ file");
}

static void sdv_read_statements(sdv_obj *obj)
{
    while (!obj->context->result) {
        const char *text = (const char *)sdv_items(&obj->text), *p = text + obj->begin;
        const char *end = text + obj->complete;
        while (p && p < end) p = sdv_read_statement(obj, p);
        if (!p || obj->ended) return;
        obj->begin = (size_t)(p - text);
        sdv_read_more(obj);
    }
}

// Checks what can only be said when everything is read.
static void sdv_check_obj(sdv_obj *obj)
{
    if (obj->counts[SDV_VERTEX] == 0)
        sdv_fail(obj->context, SUBDIV_ERROR_EMPTY, "the file has no vertices");
    for (int uv = 0; uv < 2; uv++) {
        const sdv_ahead *ahead = (const sdv_ahead *)sdv_items(&obj->ahead[uv]);
        int count = obj->counts[uv];
        for (size_t i = 0; i < obj->ahead[uv].count; i++) {
            obj->line = ahead[i].line;
            if (ahead[i].index >= count)
                sdv_fail_line(obj, SUBDIV_ERROR_INDEX, "%s %d does not exist (the file has %d)",
                              uv ? "vt" : "vertex", ahead[i].index + 1, count);
        }
    }
    if (obj->statement_faces.count > INT_MAX)
        sdv_fail(obj->context, SUBDIV_ERROR_TOO_LARGE, "too many statements");
    if (obj->tags.count > INT_MAX) sdv_fail(obj->context, SUBDIV_ERROR_TOO_LARGE, "too many tags");
}

static void sdv_warn_counted(sdv_obj *obj)
{
    static const struct { int kind; const char *text; } odd[] = {
        { SDV_MIXED_FACE,
          "%d of %d faces have a vt at some of their vertices only: they get no UVs" },
        { SDV_BARE_FACE,  "%d of %d faces have no UVs" },
        { SDV_POINT,      "%d points (p) are skipped" },
        { SDV_FREE_FORM,  "%d free-form statements (curves and surfaces) are skipped" },
        { SDV_UNKNOWN,    "%d statements with unknown keywords are skipped" } };
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        int kind = odd[i].kind, count = obj->counts[kind];
        if (count)
            sdv_warn(obj->context, obj->lines[kind], odd[i].text, count, obj->mesh.face_count);
    }
}

// Returns the mesh's number of a face of the file; -1 if it was skipped or does not exist.
static int sdv_mesh_face(const sdv_obj *obj, int face)
{
    const int *skipped = (const int *)sdv_items(&obj->skipped);
    size_t low = 0, high = obj->skipped.count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (skipped[middle] == face) return -1;
        if (skipped[middle] < face) low = middle + 1;
        else high = middle;
    }
    return face - (int)low < obj->mesh.face_count ? face - (int)low : -1;
}

// Makes the lists of the mesh from the tags, except those that name what does not exist.
static void sdv_sort_tags(sdv_obj *obj)
{
    const sdv_tag *tags = (const sdv_tag *)sdv_items(&obj->tags);
    for (size_t i = 0; i < obj->tags.count; i++) {
        int kind = tags[i].kind, a = tags[i].at[0], b = tags[i].at[1], most = a > b ? a : b;
        if (kind == SDV_HOLES) a = sdv_mesh_face(obj, a);
        if (kind == SDV_HOLES ? a < 0 : most >= obj->mesh.vertex_count) {
            sdv_warn(obj->context, tags[i].line,
                     kind == SDV_HOLES ? "hole: face %d does not exist"
                                       : "tag: vertex %d does not exist (counted from 0)", most);
            continue;
        }
        sdv_push(obj->context, &obj->lists[kind], &a, sizeof a);
        if (kind == SDV_CREASES) sdv_push(obj->context, &obj->lists[kind], &b, sizeof b);
        sdv_push(obj->context, &obj->sharpness[kind], &tags[i].sharpness, sizeof(float));
    }
    subdiv_mesh *mesh = &obj->mesh;
    mesh->crease_count = (int)obj->sharpness[SDV_CREASES].count;
    mesh->crease_vertices = (int *)sdv_items(&obj->lists[SDV_CREASES]);
    mesh->crease_sharpness = (float *)sdv_items(&obj->sharpness[SDV_CREASES]);
    mesh->corner_count = (int)obj->sharpness[SDV_CORNERS].count;
    mesh->corner_vertices = (int *)sdv_items(&obj->lists[SDV_CORNERS]);
    mesh->corner_sharpness = (float *)sdv_items(&obj->sharpness[SDV_CORNERS]);
    mesh->hole_count = (int)obj->lists[SDV_HOLES].count;
}

static void sdv_finish_statements(sdv_obj *obj)
{
    char *text = (char *)sdv_items(&obj->statement_text);
    for (size_t i = 0; i < obj->statement_faces.count; i++, text += strlen(text) + 1)
        sdv_push(obj->context, &obj->statements, &text, sizeof text);
    obj->mesh.statement_count = (int)obj->statement_faces.count;
    obj->mesh.statement_faces = (int *)sdv_items(&obj->statement_faces);
    obj->mesh.statements = (char **)sdv_items(&obj->statements);
}

// Makes the mesh, a single block, of everything that was read.
static void sdv_finish_obj(sdv_obj *obj, subdiv_mesh *out)
{
    static const float white = 1;
    subdiv_mesh *mesh = &obj->mesh;
    if (!obj->context->result) sdv_check_obj(obj);
    if (obj->context->result) return;
    mesh->vertex_count = obj->counts[SDV_VERTEX];
    mesh->uv_count = obj->counts[SDV_UV];
    mesh->boundary = (subdiv_boundary)obj->rules[0];
    mesh->uv_rule = (subdiv_uv_rule)obj->rules[1];
    mesh->creasing = (subdiv_creasing)obj->rules[2];
    mesh->triangles = (subdiv_triangles)obj->rules[3];
    sdv_sort_tags(obj);
    if (obj->face_sizes.count) mesh->face_size = 0;
    mesh->face_sizes = (int *)sdv_items(&obj->face_sizes);
    if (obj->colors.count)
        sdv_fill(obj->context, &obj->colors, 3 * (size_t)mesh->vertex_count, &white);
    mesh->colors = (float *)sdv_items(&obj->colors);
    // A mesh has UVs if any of its faces has. Only then are bare faces odd.
    if (obj->counts[SDV_FACE]) sdv_fill_uvs(obj, 0);
    else mesh->uv_count = obj->counts[SDV_BARE_FACE] = 0;
    mesh->line_count = (int)obj->line_sizes.count;
    mesh->line_sizes = (int *)sdv_items(&obj->line_sizes);
    mesh->line_vertices = (int *)sdv_items(&obj->line_vertices);
    sdv_finish_statements(obj);
    sdv_warn_counted(obj);
    if (!obj->context->result) sdv_new_mesh(obj->context, out, mesh, SDV_PLAIN);
    if (obj->context->result) return;
    sdv_series_take(&obj->points[0], out->positions);
    sdv_series_take(&obj->points[1], out->uvs);
    sdv_series_take(&obj->indices[0], out->face_vertices);
    sdv_series_take(&obj->indices[1], out->face_uvs);
    sdv_copy(out->holes, sdv_items(&obj->lists[SDV_HOLES]), (size_t)out->hole_count, sizeof(int));
}

static subdiv_result sdv_load_text(sdv_context *context, subdiv_mesh *mesh, subdiv_read read,
                                   void *user)
{
    if (mesh) memset(mesh, 0, sizeof *mesh);
    if (!mesh || !read) sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    if (context->result) return context->result;

    sdv_obj obj;
    memset(&obj, 0, sizeof obj);
    obj.context = context;
    obj.read = read;
    obj.user = user;
    obj.line = obj.next_line = 1;
    for (int uv = 0; uv < 2; uv++) obj.points[uv] = obj.indices[uv] = sdv_new_arena(SDV_FIRST);
    sdv_grow(context, &obj.text, 1 << 18, 1);      // stays in the cache; grows for longer lines
    sdv_skip_byte_order_mark(&obj);
    sdv_read_statements(&obj);
    sdv_finish_obj(&obj, mesh);

    for (int uv = 0; uv < 2; uv++) {
        sdv_arena_free(&obj.points[uv]);
        sdv_arena_free(&obj.indices[uv]);
    }
    sdv_array *arrays[] = { &obj.text, &obj.colors, &obj.face_sizes, &obj.line_sizes,
        &obj.line_vertices, &obj.ahead[0], &obj.ahead[1],
        &obj.skipped, &obj.statement_faces, &obj.statement_text, &obj.statements, &obj.ints,
        &obj.floats, &obj.tags, &obj.lists[0], &obj.lists[1], &obj.lists[2], &obj.sharpness[0],
        &obj.sharpness[1], &obj.sharpness[2] };
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) sdv_array_free(arrays[i]);
    return context->result;
}

SUBDIV_DEF subdiv_result subdiv_load_obj_callback(subdiv_mesh *mesh, subdiv_read read, void *user,
                                                  const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    return sdv_load_text(&context, mesh, read, user);
}

static size_t sdv_read_memory(void *user, void *bytes, size_t size)
{
    sdv_token *left = (sdv_token *)user;
    size_t most = (size_t)(left->end - left->begin);
    if (size > most) size = most;
    sdv_copy(bytes, left->begin, size, 1);
    left->begin += size;
    return size;
}

SUBDIV_DEF subdiv_result subdiv_load_obj_memory(subdiv_mesh *mesh, const void *text, size_t size,
                                                const subdiv_options *opt)
{
    if (size == 0) text = "";                               // it may be NULL
    sdv_token left = { (const char *)text, text ? (const char *)text + size : NULL };
    return subdiv_load_obj_callback(mesh, text ? sdv_read_memory : NULL, &left, opt);
}

// ----------------------------------------------------------------------------- >>obj-write

typedef struct sdv_output {
    sdv_context *context;
    subdiv_write write;
    void        *user;
    const subdiv_options *opt;
    const sdv_figures *figures;
    char        *buffer;                // [SDV_OUTPUT_SIZE]
    size_t       used;
    int          left_handed;           // faces are turned round, as OBJ has them counter-clockwise
    int64_t      begin, end;            // of a stream: what is to be written, in units of time,
    int64_t      at;                    // and where the next lines begin, see sdv_take
} sdv_output;

enum {
    SDV_OUTPUT_SIZE = 16384,            // stays in the nearest cache
    SDV_PIECE_SIZE = 256                // more than any line but those of faces and statements
};

static void sdv_flush(sdv_output *out)
{
    sdv_forget_errno();
    if (!out->context->result && out->used &&
        out->write(out->user, out->buffer, out->used) != out->used)
        sdv_fail_io(out->context, "writing failed");
    out->used = 0;
}

// Returns room for SDV_PIECE_SIZE bytes; sdv_end says how many of them were written.
static char *sdv_room(sdv_output *out)
{
    if (out->used > SDV_OUTPUT_SIZE - SDV_PIECE_SIZE) sdv_flush(out);
    return out->buffer + out->used;
}

static void sdv_end(sdv_output *out, const char *end)
{
    out->used = (size_t)(end - out->buffer);
}

static void sdv_write_text(sdv_output *out, const char *text)
{
    for (size_t left = strlen(text), size; left; left -= size, text += size) {
        char *p = sdv_room(out);
        size = left < SDV_PIECE_SIZE ? left : (size_t)SDV_PIECE_SIZE;
        memcpy(p, text, size);
        sdv_end(out, p + size);
    }
}

static char *sdv_write_floats(const sdv_figures *figures, char *p, const float *numbers, int count)
{
    for (int i = 0; i < count; i++) p = sdv_write_float(figures, p, &numbers[i]);
    return p;
}

// Writes creases, corners or holes, each as a tag of its own, which every reader understands.
static void sdv_write_list(sdv_output *out, int kind, int count, const int *indices,
                           const float *sharpness)
{
    for (int i = 0; i < count && !out->context->result; i++) {
        sdv_write_text(out, sdv_list_tags[kind]);
        char *p = sdv_room(out);
        for (int k = kind == SDV_CREASES ? 2 : 1; k > 0; k--) {
            *p++ = ' ';
            p = sdv_write_index(out->figures, p, *indices++);
        }
        if (sharpness) {
            *p++ = ' ';
            p = sdv_write_exactly(p, sdv_clamp_sharpness(sharpness[i]));
        }
        *p++ = '\n';
        sdv_end(out, p);
    }
}

// Writes nothing if all is as usual, else always the boundary, as readers differ in their defaults.
static void sdv_write_tags(sdv_output *out, const subdiv_mesh *mesh)
{
    const int rules[SDV_RULES] = { (int)mesh->boundary, (int)mesh->uv_rule, (int)mesh->creasing,
                                   (int)mesh->triangles };
    int any = mesh->crease_count || mesh->corner_count || mesh->hole_count;
    for (int i = 0; i < SDV_RULES; i++) any |= rules[i];
    if (!any || (out->opt && out->opt->no_tags)) return;
    for (int i = 0; i < SDV_RULES; i++) {
        if (i > 0 && rules[i] == 0) continue;
        sdv_write_text(out, sdv_rule_tags[i].text);
        sdv_write_text(out, sdv_rule_tags[i].values[rules[i]]);
        sdv_write_text(out, "\n");
    }
    sdv_write_list(out, SDV_CREASES, mesh->crease_count, mesh->crease_vertices,
                   mesh->crease_sharpness);
    sdv_write_list(out, SDV_CORNERS, mesh->corner_count, mesh->corner_vertices,
                   mesh->corner_sharpness);
    sdv_write_list(out, SDV_HOLES, mesh->hole_count, mesh->holes, NULL);
}

// Writes lines of width numbers, and behind them 3 of more unless that is NULL: v x y z r g b.
static void sdv_write_lines(sdv_output *out, const char *keyword, int width, const float *values,
                            const float *more, int count)
{
    const size_t length = strlen(keyword);
    for (int i = 0; i < count && !out->context->result; i++, values += width) {
        char *p = sdv_room(out);
        memcpy(p, keyword, 2);
        p += length;
        p = sdv_write_floats(out->figures, p, values, width);
        if (more) p = sdv_write_floats(out->figures, p, more + 3 * (size_t)i, 3);
        *p++ = '\n';
        sdv_end(out, p);
    }
}

// Writes faces, or lines, of one size: f a, a/t, a//a or a/t/a. uvs may be NULL; a face with a -1
// there has none. normals: of all face-vertices, or NULL.
static void sdv_write_faces(sdv_output *out, char keyword, const int *vertices, const int *uvs,
                            const int *normals, int size, int count)
{
    const sdv_figures *figures = out->figures;
    const char *full = out->buffer + SDV_OUTPUT_SIZE - SDV_PIECE_SIZE;
    int turned = out->left_handed && keyword == 'f';
    for (int f = 0; f < count && !out->context->result; f++, vertices += size) {
        const int *t = uvs ? uvs + (size_t)f * (size_t)size : NULL;
        for (int i = 0; i < size && t; i++)
            if (t[i] < 0) t = NULL;
        char *p = sdv_room(out);
        *p++ = keyword;
        for (int k = 0; k < size; k++) {
            int i = turned && k > 0 ? size - k : k;
            if (p > full) {
                sdv_end(out, p);
                p = sdv_room(out);
            }
            *p++ = ' ';
            p = sdv_write_index(figures, p, vertices[i] + 1);
            if (!t && !normals) continue;
            *p++ = '/';
            if (t) p = sdv_write_index(figures, p, t[i] + 1);
            if (!normals) continue;
            *p++ = '/';
            p = sdv_write_index(figures, p, normals[i] + 1);
        }
        *p++ = '\n';
        sdv_end(out, p);
        if (normals) normals += size;
    }
}

// The number of the first statement behind a face, from number i on.
static int sdv_next_statement(const subdiv_mesh *mesh, int i, int face)
{
    while (i < mesh->statement_count && mesh->statement_faces[i] <= face) i++;
    return i;
}

// Writes the statements before a face, from number i on. Returns the number of the next.
static int sdv_write_statements(sdv_output *out, const subdiv_mesh *mesh, int i, int face)
{
    for (int end = sdv_next_statement(mesh, i, face); i < end; i++) {
        const char *text = mesh->statements[i];
        sdv_write_text(out, text);
        // A backslash at the end of a line would join it with the next.
        sdv_write_text(out, *text && text[strlen(text) - 1] == '\\' ? " \n" : "\n");
    }
    return i;
}

static void sdv_write_mesh(sdv_output *out, const subdiv_mesh *mesh)
{
    const int *vertices = mesh->face_vertices, *uvs = mesh->uv_count ? mesh->face_uvs : NULL;
    const int *normals = !mesh->normals ? NULL : mesh->face_normals ? mesh->face_normals : vertices;
    sdv_write_lines(out, "v", 3, mesh->positions, mesh->colors, mesh->vertex_count);
    sdv_write_lines(out, "vt", 2, mesh->uvs, NULL, mesh->uv_count);
    sdv_write_lines(out, "vn", 3, mesh->normals, NULL, sdv_normal_count(mesh));
    int statement = 0, next;
    for (int f = 0; f < mesh->face_count && !out->context->result; f = next) {
        statement = sdv_write_statements(out, mesh, statement, f);
        next = statement < mesh->statement_count ? mesh->statement_faces[statement]
                                                 : mesh->face_count;
        if (!mesh->face_size) next = f + 1;
        int size = sdv_face_size(mesh, f);
        sdv_write_faces(out, 'f', vertices, uvs, normals, size, next - f);
        size_t written = (size_t)(next - f) * (size_t)size;
        vertices += written;
        if (uvs) uvs += written;
        if (normals) normals += written;
    }
    sdv_write_statements(out, mesh, statement, mesh->face_count);
    vertices = mesh->line_vertices;
    for (int i = 0; i < mesh->line_count; vertices += mesh->line_sizes[i++])
        sdv_write_faces(out, 'l', vertices, NULL, NULL, mesh->line_sizes[i], 1);
    sdv_write_tags(out, mesh);
}

// A stream consists of lines v, vt, vn, then f. An index takes one unit of time to write, a float
// three, and what stands behind the faces one.
enum { SDV_STREAM_POINTS = 1 << 20, SDV_FLOAT_TIME = 3 };

typedef struct sdv_range { int first, end; } sdv_range;

// Returns which of the next lines belong to the part, those that end in it, and goes on behind them
// all. Each takes so much time.
static sdv_range sdv_take(sdv_output *out, int lines, int time)
{
    int64_t place[2] = { out->begin - out->at, out->end - out->at };
    for (int i = 0; i < 2; i++) {
        place[i] = place[i] < 0 ? 0 : place[i] / time;
        if (place[i] > lines) place[i] = lines;
    }
    sdv_range range = { (int)place[0], (int)place[1] };
    out->at += (int64_t)lines * time;
    return range;
}

typedef struct sdv_stream {             // of the points of a surface, a window at a time
    sdv_output *out;
    const subdiv_surface *surface;
    int    width;                       // numbers a point
    int    inside;                      // the first point inside a face
    char  *scratch;
    float *window;                      // [width] a point
    float *sides;                       // the window has normals; here go those of other sides
} sdv_stream;

static sdv_stream sdv_begin_stream(sdv_output *out, sdv_arena *arena, const subdiv_surface *surface,
                                   const float *values, int width, float *sides)
{
    sdv_context *context = out->context;
    int most = surface->fine.vertex_count, inside = subdiv_first_inside(surface, 0);
    if (most > SDV_STREAM_POINTS) most = SDV_STREAM_POINTS;
    sdv_stream stream = { out, surface, width, inside, NULL, NULL, sides };
    stream.scratch = SDV_NEW(context, arena, char, subdiv_scratch_size(surface, width));
    stream.window = SDV_NEW(context, arena, float, (size_t)width * (size_t)most);
    if (!context->result)
        context->result = subdiv_evaluate_begin(surface, width, values, width, stream.scratch,
                                                out->opt);
    return stream;
}

// Evaluates the window that begins with point first, and returns the point behind it, at most end.
// Any face may make points of vertices and edges; points inside faces, which come behind those, are
// made by the faces that they are in.
static int sdv_stream_window(const sdv_stream *stream, int first, int end)
{
    const subdiv_surface *surface = stream->surface;
    const subdiv_options *opt = stream->out->opt;
    const subdiv_limit normals = { NULL, stream->window, NULL, 0, stream->sides };
    int face = 0, faces = surface->cage_face_count, width = stream->width;
    if (end - first > SDV_STREAM_POINTS) end = first + SDV_STREAM_POINTS;
    if (first >= stream->inside) {
        face = sdv_face_inside(&surface->order, first);
        faces = sdv_face_inside(&surface->order, end - 1) + 1 - face;
    }
    if (stream->sides)
        subdiv_evaluate_limit_faces(surface, stream->scratch, face, faces, first, end - first,
                                    &normals, opt);
    else subdiv_evaluate_faces(surface, width, stream->scratch, face, faces, first, end - first,
                               stream->window, width, opt);
    return end;
}

// Writes those points of a surface that belong to the part. The first three numbers of each are a
// position, to be multiplied by factor. With sides, writes the points' normals instead.
static void sdv_stream_points(sdv_output *out, sdv_arena *arena, const subdiv_surface *surface,
                              const char *keyword, int width, const float *values, float factor,
                              float *sides)
{
    sdv_range part = sdv_take(out, surface->fine.vertex_count, SDV_FLOAT_TIME * width);
    if (part.first == part.end) return;
    sdv_stream stream = sdv_begin_stream(out, arena, surface, values, width, sides);
    for (int first = part.first, end; first < part.end && !out->context->result; first = end) {
        end = sdv_stream_window(&stream, first, part.end);
        for (int i = 0; i < end - first && factor != 1; i++)
            sdv_multiply(stream.window + (size_t)i * (size_t)width, 3, factor);
        sdv_write_lines(out, keyword, width, stream.window, NULL, end - first);
    }
}

// Writes the normals of other sides of creases. Only points of vertices and edges have such; all of
// these are evaluated, as the part may have none of them.
static void sdv_stream_sides(sdv_output *out, sdv_arena *arena, const subdiv_surface *surface,
                             const float *positions, float *sides, int count)
{
    sdv_range part = sdv_take(out, count, SDV_FLOAT_TIME * 3);
    if (part.first == part.end) return;
    sdv_stream stream = sdv_begin_stream(out, arena, surface, positions, 3, sides);
    for (int first = 0; first < stream.inside && !out->context->result; )
        first = sdv_stream_window(&stream, first, stream.inside);
    sdv_write_lines(out, "vn", 3, sides + 3 * (size_t)part.first, NULL, part.end - part.first);
}

// Returns positions with the colour behind each, or alone if there are no colours.
static const float *sdv_join_colors(sdv_context *context, sdv_arena *arena,
                                    const subdiv_surface *surface, const float *positions)
{
    size_t count = (size_t)surface->cage_vertex_count;
    if (!surface->colors || context->result) return positions;
    float *joined = SDV_NEW(context, arena, float, 6 * count);
    for (size_t v = 0; v < count && joined; v++) {
        memcpy(joined + 6 * v, positions + 3 * v, 3 * sizeof(float));
        memcpy(joined + 6 * v + 3, surface->colors + 3 * v, 3 * sizeof(float));
    }
    return joined;
}

// Returns how many indices the line of a fine face has.
static int sdv_face_indices(const subdiv_surface *surface)
{
    return surface->fine.face_size * (1 + (surface->uv != NULL) + surface->rules.limit);
}

// Writes the faces, a row of a grid at a time, and before them their statements: rows whose first
// face is in the part. row, uvs and normals have room for the indices of a row.
static void sdv_stream_faces(sdv_output *out, const subdiv_surface *surface, int *row, int *uvs,
                             int *normals)
{
    const sdv_order *order = &surface->order;
    const subdiv_surface *uv = surface->uv;
    const sdv_sides *sides = surface->sides.vertex ? &surface->sides : NULL;
    const int *seen = !surface->rules.limit ? NULL : sides ? normals : row;
    int size = surface->fine.face_size, statement = 0;
    sdv_range part = sdv_take(out, surface->fine.face_count, sdv_face_indices(surface));
    for (int f = 0; f < surface->cage_face_count && !out->context->result; f++) {
        int first = sdv_first_fine_face(surface, f);
        if (first == sdv_first_fine_face(surface, f + 1)) continue;
        if (first < part.first) statement = sdv_next_statement(&surface->fine, statement, first);
        if (sdv_first_fine_face(surface, f + 1) <= part.first || first >= part.end) continue;
        int start = sdv_face_start(&order->cage, f), end = sdv_face_end(&order->cage, f);
        int own = uv ? uv->own_face[f] : -1, grids = sdv_is_ngon(order, f) ? end - start : 1;
        statement = sdv_write_statements(out, &surface->fine, statement, first);
        for (int g = 0; g < grids; g++) {
            sdv_grid grid, uv_grid, normal_grid;
            sdv_grid_at(order, start + g, &grid);
            normal_grid = grid;
            if (sides) sdv_see_sides(order, sides, start + g, &normal_grid);
            if (own >= 0)
                sdv_grid_at(&uv->order, sdv_face_start(&uv->order.cage, own) + g, &uv_grid);
            for (int i = 0; i < grid.rows && !out->context->result; i++) {
                int *last = sdv_grid_faces(&grid, i, i + 1, 0, grid.columns, row);
                int at = first, count = (int)(last - row) / size;
                first += count;
                if (at < part.first || at >= part.end) continue;
                if (own >= 0) sdv_grid_faces(&uv_grid, i, i + 1, 0, uv_grid.columns, uvs);
                if (sides) sdv_grid_faces(&normal_grid, i, i + 1, 0, grid.columns, normals);
                sdv_write_faces(out, 'f', row, own >= 0 ? uvs : NULL, seen, size, count);
            }
        }
    }
}

// Writes what stands behind the faces, in the last part.
static void sdv_stream_end(sdv_output *out, const subdiv_mesh *fine)
{
    sdv_range part = sdv_take(out, 1, 1);
    if (part.first == part.end) return;
    int statement = sdv_next_statement(fine, 0, fine->face_count - 1);
    sdv_write_statements(out, fine, statement, fine->face_count);
    sdv_write_tags(out, fine);
}

// The number of the part to be written, 0 for all.
static int sdv_part(const subdiv_options *opt)
{
    return opt && opt->part_count ? opt->part : 0;
}

// Sets where the part begins and ends in a text that takes so much time: at time * part / count,
// which is added up from two terms because the product might not fit.
static void sdv_cut_stream(sdv_output *out, int64_t time)
{
    const subdiv_options *opt = out->opt;
    int64_t part = sdv_part(opt), count = opt && opt->part_count ? opt->part_count : 1;
    out->begin = time / count * part + time % count * part / count;
    out->end = time / count * (part + 1) + time % count * (part + 1) / count;
}

static void sdv_stream_surface(sdv_output *out, sdv_arena *arena, const subdiv_surface *surface,
                               const float *positions)
{
    sdv_context *context = out->context;
    subdiv_mesh fine = surface->fine;
    float factor = sdv_shrink_huge(context, arena, surface, &positions);
    size_t size = fine.face_count ? 8 * (size_t)surface->order.n : 0;
    int *row = SDV_NEW(context, arena, int, size), *uvs = SDV_NEW(context, arena, int, size);
    int *normals = SDV_NEW(context, arena, int, size), other = fine.normal_count;
    if (surface->rules.limit) other -= fine.vertex_count;
    float *sides = SDV_NEW(context, arena, float, 3 * (size_t)other);
    fine.holes = SDV_NEW(context, arena, int, fine.hole_count);
    const float *values = sdv_join_colors(context, arena, surface, positions);
    if (context->result) return;
    sdv_list_holes(surface, fine.holes);
    int width = surface->colors ? 6 : 3;
    int64_t floats = width * (int64_t)fine.vertex_count;
    if (surface->uv) floats += 2 * (int64_t)surface->uv->fine.vertex_count;
    if (surface->rules.limit) floats += 3 * (int64_t)fine.normal_count;
    sdv_cut_stream(out, SDV_FLOAT_TIME * floats +
                        (int64_t)fine.face_count * sdv_face_indices(surface) + 1);
    sdv_stream_points(out, arena, surface, "v", width, values, factor, NULL);
    if (surface->uv) sdv_stream_points(out, arena, surface->uv, "vt", 2, surface->uvs, 1, NULL);
    if (surface->rules.limit) {
        sdv_stream_points(out, arena, surface, "vn", 3, positions, 1, sides);
        sdv_stream_sides(out, arena, surface, positions, sides, other);
    }
    sdv_stream_faces(out, surface, row, uvs, normals);
    sdv_stream_end(out, &fine);
}

// Writes a mesh or, if that is NULL, a surface with positions while it is refined.
static subdiv_result sdv_write_obj(sdv_context *context, const subdiv_mesh *mesh,
                                   const subdiv_surface *surface, const float *positions,
                                   subdiv_write write, void *user, const subdiv_options *opt)
{
    subdiv_mesh copy;
    memset(&copy, 0, sizeof copy);
    if (context->result) return context->result;
    if (surface && surface->levels == 0) {                      // no larger than the cage
        if (sdv_part(opt) == 0)
            context->result = subdiv_surface_mesh(&copy, surface, positions, opt);
        mesh = &copy;
    }
    sdv_arena arena = sdv_scratch();
    sdv_figures *figures = SDV_NEW(context, &arena, sdv_figures, 1);
    sdv_output out = { context, write, user, opt, figures, NULL, 0, 0, 0, 0, 0 };
    out.left_handed = mesh ? mesh->left_handed : surface->rules.left_handed;
    out.buffer = SDV_NEW(context, &arena, char, SDV_OUTPUT_SIZE);
    if (!context->result) {
        sdv_make_figures(figures);
        if (mesh) sdv_write_mesh(&out, mesh);
        else sdv_stream_surface(&out, &arena, surface, positions);
        sdv_flush(&out);
    }
    sdv_arena_free(&arena);
    subdiv_mesh_free(&copy);
    return context->result;
}

SUBDIV_DEF subdiv_result subdiv_save_obj_callback(const subdiv_mesh *mesh, subdiv_write write,
                                                  void *user, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    if (!write) sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "an argument is NULL");
    else sdv_check_all(&context, mesh);
    return sdv_write_obj(&context, mesh, NULL, NULL, write, user, opt);
}

// Checks the arguments of a stream. others: those that are not checked here are there.
static void sdv_check_stream(sdv_context *context, const subdiv_surface *surface,
                             const float *positions, int others, const subdiv_options *opt)
{
    sdv_check_mesh_surface(context, surface, others);
    if (!context->result) sdv_check_positions(context, positions, surface->cage_vertex_count);
    if (!opt || !opt->part_count || context->result) return;
    if (opt->part < 0 || opt->part >= opt->part_count)
        sdv_fail(context, SUBDIV_ERROR_ARGUMENT, "there is no part %d of %d, counted from 0",
                 opt->part, opt->part_count);
}

SUBDIV_DEF subdiv_result subdiv_stream_obj_callback(const subdiv_surface *surface,
                                                    const float *positions, subdiv_write write,
                                                    void *user, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_check_stream(&context, surface, positions, write != NULL, opt);
    return sdv_write_obj(&context, NULL, surface, positions, write, user, opt);
}

// Keeps what fits the sdv_text; its size is that of all.
static size_t sdv_write_memory(void *user, const void *bytes, size_t size)
{
    sdv_text *store = (sdv_text *)user;
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
    sdv_text store = { (char *)text, 0, capacity };
    subdiv_write write = size && (text || !capacity) ? sdv_write_memory : NULL;
    subdiv_result result = subdiv_save_obj_callback(mesh, write, &store, opt);
    if (size) *size = result ? 0 : store.size;
    if (result || !capacity || capacity >= store.size) return result;
    sdv_context context = sdv_begin(opt);
    sdv_fail(&context, SUBDIV_ERROR_TOO_LARGE, "the text does not fit the buffer");
    return context.result;
}

#ifndef SUBDIV_NO_STDIO

// Paths are UTF-8, which Windows has to be told.
#ifdef _WIN32
#ifdef __cplusplus
extern "C" {
#endif
__declspec(dllimport) int __stdcall MultiByteToWideChar(unsigned, unsigned long, const char *, int,
                                                        wchar_t *, int);
__declspec(dllimport) int __stdcall MoveFileExW(const wchar_t *, const wchar_t *, unsigned long);
#ifdef __cplusplus
}
#endif

static wchar_t *sdv_wide(sdv_context *context, sdv_arena *arena, const char *path)
{
    const unsigned utf8 = 65001;
    int size = MultiByteToWideChar(utf8, 8, path, -1, NULL, 0);    // 8: nothing invalid
    if (size == 0) sdv_fail(context, SUBDIV_ERROR_IO, "the path is not UTF-8");
    wchar_t *wide = SDV_NEW(context, arena, wchar_t, size);
    if (wide) MultiByteToWideChar(utf8, 8, path, -1, wide, size);
    return wide;
}

static FILE *sdv_open_path(sdv_context *context, const char *path, const char *mode)
{
    const wchar_t wide_mode[] = { (wchar_t)mode[0], (wchar_t)mode[1], 0 };
    sdv_arena arena = sdv_scratch();
    const wchar_t *wide = sdv_wide(context, &arena, path);
    FILE *file = wide && mode[2] ? _wfopen(wide, L"rb") : NULL;     // not every runtime knows x
    if (file) {
        fclose(file);
        file = NULL;
        errno = EEXIST;
    } else if (wide) {
        file = _wfopen(wide, wide_mode);
    }
    sdv_arena_free(&arena);
    return file;
}

// Gives a file another name, also if there is a file of that name. Removes the file if it fails, or
// if to is NULL. Returns whether it has the name.
static int sdv_rename(const sdv_context *context, const char *from, const char *to)
{
    sdv_context own = { SUBDIV_OK, NULL, context->user, NULL };     // the call may have failed
    sdv_arena arena = sdv_scratch();
    const wchar_t *wide_from = sdv_wide(&own, &arena, from);
    const wchar_t *wide_to = to ? sdv_wide(&own, &arena, to) : NULL;
    int done = wide_to && MoveFileExW(wide_from, wide_to, 1);       // 1: replaces
    if (!done && wide_from) _wremove(wide_from);
    sdv_arena_free(&arena);
    return done;
}
#else
static FILE *sdv_open_path(sdv_context *context, const char *path, const char *mode)
{
    (void)context;
    return fopen(path, mode);
}

static int sdv_rename(const sdv_context *context, const char *from, const char *to)
{
    (void)context;
    if (to && rename(from, to) == 0) return 1;
    remove(from);
    return 0;
}
#endif

// Opens a file, without a buffer of its own: the library reads and writes in large blocks. Messages
// name the file from now on.
static FILE *sdv_open(sdv_context *context, const char *path, const char *mode)
{
    context->name = path;
    sdv_forget_errno();
    FILE *file = sdv_open_path(context, path, mode);
    if (file) setvbuf(file, NULL, _IONBF, 0);
    else sdv_fail(context, SUBDIV_ERROR_IO, "%s", strerror(errno));
    return file;
}

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
    FILE *file = path && mesh ? sdv_open(&context, path, "rb") : NULL;
    sdv_load_text(&context, mesh, file ? sdv_read_file : NULL, file);
    if (file) fclose(file);
    return context.result;
}

// May another file take the place of this one? Either it is a regular file that may be written, or
// there is none.
static int sdv_is_replaceable(sdv_context *context, const char *path)
{
#if defined(SDV_POSIX)
#ifdef __APPLE__
    extern long sdv_readlink(const char *path, char *text, size_t size) __asm__("_readlink");
#else
    extern long sdv_readlink(const char *path, char *text, size_t size) __asm__("readlink");
#endif
    struct stat old;
    char text;
    if (sdv_readlink(path, &text, 1) >= 0) return 0;
    if (stat(path, &old) == 0 && !S_ISREG(old.st_mode)) return 0;
#elif !defined(_WIN32)
    return 0;                                   // rename need not replace what is there
#endif
    FILE *file = sdv_open_path(context, path, "r+");
    if (file) fclose(file);
    return file || errno == ENOENT;
}

// Opens a new file beside a path and stores its name, of which size bytes are kept. NULL if the
// path is to be written in place, and on failure.
static FILE *sdv_open_beside(sdv_context *context, const char *path, char *name, size_t size)
{
    FILE *file = NULL;
    if (!sdv_is_replaceable(context, path)) return NULL;
    errno = EEXIST;
    for (int i = 0; i < 100 && !file && errno == EEXIST; i++) {
        sdv_text out = { name, 0, size };
        sdv_say(&out, "%s.%d.tmp", path, i);
        file = sdv_open_path(context, name, "wbx");
    }
#ifdef SDV_POSIX
    struct stat old;
    if (file && stat(path, &old) == 0) chmod(name, old.st_mode & 0777);
#endif
    if (file) setvbuf(file, NULL, _IONBF, 0);
    else if (errno == ENOSPC) sdv_fail_io(context, "writing failed");
    return file;
}

static subdiv_result sdv_write_path(sdv_context *context, const subdiv_mesh *mesh,
                                    const subdiv_surface *surface, const float *positions,
                                    const char *path, const subdiv_options *opt)
{
    if (context->result) return context->result;            // bad arguments leave a file as it is
    sdv_arena arena = sdv_scratch();
    size_t size = strlen(path) + 16;
    char *beside = SDV_NEW(context, &arena, char, size);
    context->name = path;
    for (int done = !beside, again = 0; !done && !context->result; again = 1) {
        FILE *file = again ? NULL : sdv_open_beside(context, path, beside, size);
        done = !file;
        if (!file) file = sdv_open(context, path, "wb");
        if (!file) break;
        sdv_write_obj(context, mesh, surface, positions, sdv_write_file, file, opt);
        if (fclose(file)) sdv_fail_io(context, "writing failed");
        if (!done) done = sdv_rename(context, beside, context->result ? NULL : path);
    }
    sdv_arena_free(&arena);
    return context->result;
}

SUBDIV_DEF subdiv_result subdiv_save_obj(const subdiv_mesh *mesh, const char *path,
                                         const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    if (!path) sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "path is NULL");
    else sdv_check_all(&context, mesh);
    return sdv_write_path(&context, mesh, NULL, NULL, path, opt);
}

SUBDIV_DEF subdiv_result subdiv_stream_obj(const subdiv_surface *surface, const float *positions,
                                           const char *path, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_check_stream(&context, surface, positions, path != NULL, opt);
    return sdv_write_path(&context, NULL, surface, positions, path, opt);
}

#endif // SUBDIV_NO_STDIO
#endif // SUBDIV_NO_OBJ

#ifndef SUBDIV_NO_TOOLS
// -------------------------------------------------------------------------------- >>explain
// Tells as data what >>sharpness and >>masks decide for a point, and puts these data into words.

typedef struct sdv_group {              // of vertices that weigh the same
    char text[32];                      // their weight
    const int *vertices;
    int size;
} sdv_group;

typedef struct sdv_explainer {
    sdv_context *context;
    sdv_arena    arena;
    sdv_cage     cage;
    subdiv_surface *surface;            // of the cage, refined once
    const sdv_rules *rules;
    int         *room;                  // for the neighbours of a vertex
    subdiv_stencils masks;
    subdiv_point point;                 // to write about,
    sdv_text    *out;                   // there
    sdv_group   *groups;                // [group_count] its mask, cut into groups
    int          group_count;
} sdv_explainer;

static const struct { const char *tag, *title; } sdv_papers[] = {
    { "[CC78]", "Catmull, Clark: Recursively generated B-spline surfaces on arbitrary\n"
                "       topological meshes, 1978" },
    { "[DS78]", "Doo, Sabin: Behaviour of recursive division surfaces near extraordinary\n"
                "       points, 1978" },
    { "[Warren95]", "Warren: Subdivision methods for geometric design, 1995" },
    { "[Loop87]", "Loop: Smooth subdivision surfaces based on triangles, 1987" },
    { "[HDD94]", "Hoppe, DeRose, et al.: Piecewise smooth surface reconstruction, 1994" },
    { "[DKT98]", "DeRose, Kass, Truong: Subdivision surfaces in character animation, 1998" },
    { "[OSD]", "OpenSubdiv 3.5: the rules where the papers are silent" }
};

// Writes a number as a fraction, if it is a simple one as far as floats can tell; else as a float.
static const char *sdv_fraction(double number, char text[32])
{
    sdv_text out = { text, 0, 32 };
    for (int q = 1; q <= 400; q++) {
        int p = (int)(number * q + 0.5);
        if (p == 0 || fabs(number * q - p) > (double)FLT_EPSILON * p) continue;
        sdv_say(&out, q > 1 ? "%d/%d" : "%d", p, q);
        return text;
    }
    *sdv_write_exactly(text, (float)number) = 0;
    return text;
}

// Whether a mask has these weights, as the formula of a paper does.
static int sdv_has_weights(sdv_mask mask, double self, double edge, double face, double crease)
{
    return fabs(mask.self - self) + fabs(mask.edge - edge) + fabs(mask.face - face) +
           fabs(mask.crease - crease) < 1e-9;
}

// ---- the data

static void sdv_find_vertex_point(const sdv_explainer *x, subdiv_point *p)
{
    const sdv_level *level = &x->cage.level;
    int v = p->parent;
    float sharpness = level->vertex_sharpness[v];
    sdv_fading fading = sdv_vertex_fading(level, v);
    p->valence = level->vertex_faces[v];
    p->sharp_edges = (int)(sdv_add_neighbours(level, v, SDV_CREASE, 1, x->room) - x->room);
    for (int i = 0; i < p->sharp_edges && i < 2; i++) p->ends[i] = x->room[i];
    p->sharpness = fminf(sharpness, SUBDIV_INFINITE);
    p->rule = (subdiv_rule)(x->rules->linear ? SDV_CORNER : fading.rule);
    p->next = (subdiv_rule)(x->rules->linear ? SDV_CORNER : fading.next);
    if (p->rule >= SUBDIV_CREASE && p->rule != p->next) p->weight = fading.weight;
    p->reason = x->rules->linear ? SUBDIV_LINEAR :
                p->rule == SUBDIV_SMOOTH ? SUBDIV_NOTHING_SHARP :
                p->valence == 0 ? SUBDIV_NO_FACES :
                sharpness > SUBDIV_INFINITE ? x->cage.vertex_nonmanifold[v] ? SUBDIV_NONMANIFOLD
                                                                            : SUBDIV_SINGLE_FACE :
                sharpness > 0 ? SUBDIV_OWN_SHARPNESS :
                p->rule == SUBDIV_CREASE && sdv_count_edges_at(&x->cage, v).boundary == 2
                    ? SUBDIV_BOUNDARY : SUBDIV_SHARP_EDGES;
}

static void sdv_find_edge_point(const sdv_explainer *x, subdiv_point *p)
{
    const sdv_level *level = &x->cage.level;
    int h = level->edge_first[p->parent], a = level->face_vertices[h];
    int b = level->face_vertices[sdv_next(level, h)];
    float sharpness = level->sharpness[h];
    int stays_sharp = sdv_half(level, h) > 0 && sdv_half_before(level, h) > 0;
    p->ends[0] = a < b ? a : b;
    p->ends[1] = a < b ? b : a;
    p->faces[0] = sdv_face_of(level, h);
    if (!sdv_is_boundary(level, h)) p->faces[1] = sdv_face_of(level, level->across[h]);
    p->valence = sdv_edge_faces(level, h);
    p->sharpness = fminf(sharpness, SUBDIV_INFINITE);
    p->rule = x->rules->linear || sharpness > 0 ? SUBDIV_CREASE : SUBDIV_SMOOTH;
    p->next = x->rules->linear || stays_sharp ? SUBDIV_CREASE : SUBDIV_SMOOTH;
    if (p->rule != p->next && sharpness < 1) p->weight = (double)sharpness;
    p->reason = x->rules->linear ? SUBDIV_LINEAR :
                x->cage.edge_nonmanifold[p->parent] ? SUBDIV_NONMANIFOLD :
                sdv_is_boundary(level, h) ? SUBDIV_BOUNDARY :
                sharpness > 0 ? SUBDIV_OWN_SHARPNESS : SUBDIV_NOTHING_SHARP;
}

// Finds of what a point is made, and how.
static subdiv_point sdv_find_point(const sdv_explainer *x, int point)
{
    static const char *const names[] = { "vertices", "edges", "faces" };
    const sdv_level *level = &x->cage.level;
    const int counts[] = { level->vertex_count, level->edge_count, level->face_count };
    subdiv_point p = { SUBDIV_VERTEX_POINT, point, { -1, -1 }, { -1, -1 }, 0, 0, 0, SUBDIV_SMOOTH,
                       SUBDIV_SMOOTH, SUBDIV_NOTHING_SHARP, 1 };
    char ranges[256];
    sdv_text out = { ranges, 0, sizeof ranges };
    for (int i = 0, first = 0; i < (x->rules->loop ? 2 : 3); first += counts[i++]) {
        p.kind = (subdiv_point_kind)i;
        if (point >= first && point - first < counts[i]) {
            p.parent = point - first;
            if (i == SUBDIV_VERTEX_POINT) sdv_find_vertex_point(x, &p);
            else if (i == SUBDIV_EDGE_POINT) sdv_find_edge_point(x, &p);
            else p.valence = sdv_face_end(level, p.parent) - sdv_face_start(level, p.parent);
            return p;
        }
        if (counts[i] > 0)
            sdv_say(&out, "%s%d to %d of %s", i ? ", " : "", first, first + counts[i] - 1,
                    names[i]);
    }
    sdv_fail(x->context, SUBDIV_ERROR_INDEX, "refined once, the mesh has no point %d, but %s",
             point, ranges);
    return p;
}

// Prepares the cage's surface of level 1, whose stencils are the masks, and builds the cage again,
// as a surface does not keep all of it.
static void sdv_begin_explainer(sdv_context *context, sdv_explainer *x, const subdiv_mesh *cage,
                                const subdiv_options *opt)
{
    subdiv_options refined = { 0, 0, 0, 0, 0, NULL, NULL, NULL, 0, 0, 0 };
    sdv_request request = sdv_request_of(cage, 1, NULL, 1, &refined);
    memset(x, 0, sizeof *x);
    x->context = context;
    x->arena = sdv_scratch();
    if (opt) refined = *opt;
    refined.limit = 0;
    if (!context->result) context->result = sdv_prepare(&x->surface, &request);
    if (context->result) return;
    subdiv_mesh work = *cage;
    int warnings = context->error ? context->error->warning_count : 0;
    x->rules = &x->surface->rules;
    sdv_copy_faces(context, x->surface, &work, cage);
    if (!context->result) sdv_cage_build(context, &x->arena, &x->arena, &x->cage, &work);
    if (context->error) context->error->warning_count = warnings;       // the same ones again
    if (!context->result)
        x->room = SDV_NEW(context, &x->arena, int, 2 * (size_t)sdv_most_faces(&x->cage.level));
}

static void sdv_end_explainer(sdv_explainer *x)
{
    subdiv_stencils_free(&x->masks);
    subdiv_surface_free(x->surface);
    sdv_arena_free(&x->arena);
}

SUBDIV_DEF subdiv_result subdiv_explain_points(subdiv_explanation *explanation,
                                               const subdiv_mesh *cage, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_explainer x;
    subdiv_explanation made;
    sdv_arena owned = sdv_new_arena(0);
    if (!explanation) sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, "explanation is NULL");
    else memset(explanation, 0, sizeof *explanation);
    sdv_begin_explainer(&context, &x, cage, opt);
    made.count = subdiv_surface_vertex_count(x.surface);
    made.points = context.result ? NULL : SDV_NEW(&context, &owned, subdiv_point, made.count);
    made.memory = owned.blocks;
    for (int i = 0; i < made.count && !context.result; i++) made.points[i] = sdv_find_point(&x, i);
    if (!context.result)
        context.result = subdiv_refined_stencils(&made.masks, x.surface, 0, made.count, opt);
    if (context.result) sdv_arena_free(&owned);
    else *explanation = made;
    sdv_end_explainer(&x);
    return context.result;
}

SUBDIV_DEF void subdiv_explanation_free(subdiv_explanation *explanation)
{
    if (!explanation) return;
    sdv_free_memory(explanation->memory);
    subdiv_stencils_free(&explanation->masks);
    memset(explanation, 0, sizeof *explanation);
}

// ---- the mask

// Sorts the mask, heavy vertices first, and puts those of the same weight in a group.
static void sdv_find_groups(sdv_explainer *x)
{
    float *w = x->masks.weights;
    int *vertices = x->masks.indices, count = (int)x->masks.offsets[1];
    float least = 0;                                // of the last group
    sdv_group *group = x->groups = SDV_NEW(x->context, &x->arena, sdv_group, count);
    for (int i = 0; i < count; i++) {
        float weight = w[i];
        int at = i, v = vertices[i];
        for (; at > 0 && w[at - 1] < weight - 1e-6f * fabsf(weight); at--) {
            w[at] = w[at - 1];
            vertices[at] = vertices[at - 1];
        }
        w[at] = weight;
        vertices[at] = v;
    }
    for (int i = 0; i < count && !x->context->result; i++, group->size++) {
        if (i > 0 && w[i] > least) continue;
        group = &x->groups[x->group_count++];
        sdv_fraction((double)w[i], group->text);
        group->vertices = vertices + i;
        group->size = 0;
        least = w[i] - 1e-6f * fabsf(w[i]);
    }
}

// Writes one line for each weight, with all the vertices that have it. Longer ones go on under it.
static void sdv_say_table(sdv_explainer *x)
{
    static const char blanks[] = "                                                ";
    size_t width = 6;                               // of the weights
    for (int g = 0; g < x->group_count; g++)
        if (strlen(x->groups[g].text) > width) width = strlen(x->groups[g].text);
    for (int g = 0; g < x->group_count; g++) {
        const sdv_group *group = &x->groups[g];
        size_t start = x->out->size;
        sdv_say(x->out, "    %s", group->text);
        sdv_put(x->out, blanks, width + 2 - strlen(group->text));
        sdv_say(x->out, group->size == 1 ? "vertex" : "vertices");
        for (int i = 0; i < group->size; i++) {
            if (x->out->size > start + 68) {
                sdv_say(x->out, "\n");
                start = x->out->size;
                sdv_put(x->out, blanks, width + 14);
            }
            sdv_say(x->out, " %d", group->vertices[i]);
        }
        sdv_say(x->out, "\n");
    }
}

// Pictures of the usual masks, known by how many vertices share each weight: a to c stand for the
// weights, heavy ones first.
static const struct sdv_picture { subdiv_point_kind kind; int sizes[4]; const char *text; }
sdv_pictures[] = {
    { SUBDIV_FACE_POINT, { 4, 0, 0, 0 },
      "     a----------a\n"
      "     |          |\n"
      "     |    F     |\n"
      "     |          |\n"
      "     a----------a\n" },
    { SUBDIV_FACE_POINT, { 3, 0, 0, 0 },
      "          a\n"
      "         / \\\n"
      "        / F \\\n"
      "       /     \\\n"
      "     a---------a\n" },
    { SUBDIV_EDGE_POINT, { 2, 0, 0, 0 },
      "     a----- E ------a\n" },
    { SUBDIV_EDGE_POINT, { 2, 4, 0, 0 },
      "     b--------------b\n"
      "     |              |\n"
      "     a----- E ------a\n"
      "     |              |\n"
      "     b--------------b\n" },
    { SUBDIV_EDGE_POINT, { 2, 2, 0, 0 },
      "            b\n"
      "        /      \\\n"
      "       /        \\\n"
      "     a----- E ------a\n"
      "       \\        /\n"
      "        \\      /\n"
      "            b\n" },
    { SUBDIV_VERTEX_POINT, { 1, 2, 0, 0 },
      "     b----------a----------b\n" },
    { SUBDIV_VERTEX_POINT, { 1, 4, 4, 0 },
      "     c----------b----------c\n"
      "     |          |          |\n"
      "     b----------a----------b\n"
      "     |          |          |\n"
      "     c----------b----------c\n" },
    { SUBDIV_VERTEX_POINT, { 1, 6, 0, 0 },
      "          b----------b\n"
      "        /    \\     /    \\\n"
      "     b----------a----------b\n"
      "        \\    /     \\    /\n"
      "          b----------b\n" }
};

// Does a picture show the mask, and is there room in it for the weights?
static int sdv_fits(const sdv_explainer *x, const struct sdv_picture *picture)
{
    if (picture->kind != x->point.kind || x->group_count > 3) return 0;
    for (int g = 0; g < x->group_count; g++)
        if (picture->sizes[g] != x->groups[g].size || strlen(x->groups[g].text) > 6) return 0;
    return picture->sizes[x->group_count] == 0;
}

// Draws a picture, with the weights in place of the letters and a blank on either side.
static void sdv_draw(sdv_explainer *x, const char *picture)
{
    for (size_t size; *picture; picture += size + 1) {
        char line[40];
        size = strcspn(picture, "\n");
        memset(line, ' ', sizeof line);
        memcpy(line, picture, size);
        for (size_t i = 0; i < size; i++) {
            if (line[i] < 'a' || line[i] > 'c') continue;
            const char *text = x->groups[line[i] - 'a'].text;
            size_t length = strlen(text), from = i - length / 2;
            memcpy(line + from, text, length);
            line[from - 1] = line[from + length] = ' ';
        }
        size_t end = sizeof line;
        while (line[end - 1] == ' ') end--;
        sdv_put(x->out, line, end);
        sdv_say(x->out, "\n");
    }
    sdv_say(x->out, "\n");
}

static void sdv_say_mask(sdv_explainer *x)
{
    const char *gap = "\n";
    sdv_say(x->out, "\nIts mask: the weights of the cage's vertices, which add up to 1.\n\n");
    for (size_t i = 0; i < sizeof sdv_pictures / sizeof *sdv_pictures; i++)
        if (sdv_fits(x, &sdv_pictures[i])) sdv_draw(x, sdv_pictures[i].text);
    sdv_say_table(x);
    for (size_t i = 0; i < sizeof sdv_papers / sizeof *sdv_papers; i++) {
        if (!strstr(x->out->text, sdv_papers[i].tag)) continue;
        sdv_say(x->out, "%s%s %s\n", gap, sdv_papers[i].tag, sdv_papers[i].title);
        gap = "";
    }
}

// ---- vertices

// Writes the blend of two formulas, which are named by a letter each.
static void sdv_say_blend(sdv_explainer *x, const char *name, double weight, const char *sharp,
                          const char *smooth)
{
    char more[32], less[32];
    sdv_say(x->out, "\n    %s = %s %s + %s %s  [DKT98]\n", name, sdv_fraction(weight, more), sharp,
            sdv_fraction(1 - weight, less), smooth);
}

// Writes the weights of a vertex mask, in two lines where one would be too long.
static void sdv_say_weights(sdv_explainer *x, sdv_mask mask)
{
    const char *const names[] = { "v", "(a + b)", "(e1 + ... + en)", "(f1 + ... + fn)" };
    double weights[] = { mask.self, mask.crease, mask.edge, mask.face };
    size_t column = strlen("    V = ");
    char number[32], text[64];
    for (int i = 0; i < 4; i++) {
        sdv_text term = { text, 0, sizeof text };
        if (fabs(weights[i]) <= 0) continue;
        sdv_say(&term, "%s%s %s", i ? " + " : "", sdv_fraction(weights[i], number), names[i]);
        if (column + term.size > 80) {
            sdv_say(x->out, "\n       ");
            column = strlen("       ");
        }
        sdv_put(x->out, text, term.size);
        column += term.size;
    }
    sdv_say(x->out, "\n");
}

// Writes the formula of a rule of the vertex, of valence n: that of the paper, if the mask has it.
// Formulas are numbered as in subdiv_vertex_rule, then come Loop, creases and corners.
enum { SDV_SAYS_LOOP = SUBDIV_VERTEX_FIVE_EIGHTHS + 1, SDV_SAYS_CREASE, SDV_SAYS_CORNER };

static void sdv_say_formula(sdv_explainer *x, const char *name, subdiv_rule rule)
{
    sdv_fading stays = { (sdv_rule)rule, (sdv_rule)rule, 0 };
    int loop = x->rules->loop, k = (int)x->rules->vertex_rule, n = x->point.valence;
    sdv_mask mask = sdv_vertex_mask(x->rules, stays, n);
    double w = 1.0 / ((double)n * n), warren = n == 3 ? 0.1875 : 0.375 / n;
    double c = 0.375 + 0.25 * (n ? sdv_cosine(1, n) : 0), b = (0.625 - c * c) / n;
    const struct { const char *text; double self, edge, face, crease; } formulas[] = {
        { "(n-2)/n v + (e1 + ... + en)/n^2 + (f1 + ... + fn)/n^2", (n - 2.0) / n, w, w, 0 },
        { "Q/4 + R/2 + v/4  [CC78]\n", 0.5, 0.25 / n, 0.25 / n, 0 },
        { "Q/n + R/n + (n-2)/n v  [DS78]\n", 1 - 1.5 / n, 0.5 / n / n, w, 0 },
        { "(1 - n b) v + b (e1 + ... + en)  [Warren95]\n    b = 3/(8n), or 3/16 for n = 3\n",
          1 - n * warren, warren, 0, 0 },
        { "5/8 v + 3/(8n) (e1 + ... + en)\n", 0.625, 0.375 / n, 0, 0 },
        { "(1 - n b) v + b (e1 + ... + en)  [Loop87]\n"
          "    b = (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n", 1 - n * b, b, 0, 0 },
        { "(a + 6 v + b) / 8  [HDD94]\n", 0.75, 0, 0, 0.125 },
        { "v\n", 1, 0, 0, 0 }
    };
    char text[32];
    if (k == 0 && loop) k = SDV_SAYS_LOOP;
    if (rule == SUBDIV_CREASE) k = SDV_SAYS_CREASE;
    if (rule == SUBDIV_CORNER) k = SDV_SAYS_CORNER;
    int known = sdv_has_weights(mask, formulas[k].self, formulas[k].edge, formulas[k].face,
                                formulas[k].crease);
    sdv_say(x->out, "    %s = %s", name, known ? formulas[k].text : "");
    if (!known) sdv_say_weights(x, mask);
    else if (k == 0) sdv_say(x->out, ", n = %d  [CC78]\n", n);
    else if (k == SDV_SAYS_LOOP)
        sdv_say(x->out, " = %s for n = %d\n", sdv_fraction(mask.edge, text), n);
    else if (k < SDV_SAYS_LOOP)
        sdv_say(x->out, "%s    n = %d, by the vertex rule \"%s\"\n",
                loop ? "" : "    Q = (f1 + ... + fn)/n, R = v/2 + (e1 + ... + en)/(2n)\n", n,
                sdv_vertex_rules[k]);
}

// Says what the letters in the formulas of two rules stand for.
static void sdv_say_letters(sdv_explainer *x, subdiv_rule rule, subdiv_rule next)
{
    int crease = rule == SUBDIV_CREASE || next == SUBDIV_CREASE;
    int smooth = rule < SUBDIV_CREASE || next < SUBDIV_CREASE;
    sdv_say(x->out, "\nHere v is the vertex%s%s%s.\n",
            crease ? " and a, b are its neighbours along the crease" : "",
            !smooth ? "" :
            crease ? ";\nthe e are all its neighbours" : ", the e are its neighbours",
            smooth && !x->rules->loop ? ", the f the face points there" : "");
}

static const char *sdv_name_sharpness(float sharpness, char text[48])
{
    sdv_text out = { text, 0, 48 };
    char number[32];
    *sdv_write_exactly(number, sharpness) = 0;
    sdv_say(&out, sharpness >= SUBDIV_INFINITE ? "sharp forever" : "of sharpness %s", number);
    return text;
}

// Why a vertex (a corner, if not smooth) or an edge has its rule.
static const char *const sdv_reasons[][2] = {
    { "Vertex %d is interior, of valence %d, and smooth.\n",
      "Edge %d-%d is smooth, between the faces %d and %d.\n" },
    { "Refinement is linear: vertex %d stays where it is.\n",
      "Refinement is linear: the edge point is the middle of edge %d-%d.\n" },
    { "Vertex %d has no faces: it stays where it is.\n", NULL },
    { NULL, "Edge %d-%d is on the boundary, which is a crease.\n" },
    { "Vertex %d is a corner: the surface is non-manifold there.\n",
      "Edge %d-%d is non-manifold, and so a crease.\n" },
    { "Vertex %d is a corner: it has one face, and the rule is \"edge and corner\".\n", NULL },
    { "Vertex %d is a corner, %s.\n", "Edge %d-%d is a crease, %s.%s\n" },
    { "Vertex %d is a corner: %d sharp edges meet there.\n", NULL }
};

static void sdv_say_vertex_rule(sdv_explainer *x)
{
    const subdiv_point *p = &x->point;
    const char *reason = sdv_reasons[p->reason][0];
    int v = p->parent;
    char text[48];
    if (p->rule == SUBDIV_DART)
        sdv_say(x->out, "Vertex %d is a dart: the crease %d-%d ends there.\n"
                "It moves as if it were smooth.\n", v, v, p->ends[0]);
    else if (p->rule == SUBDIV_CREASE)
        sdv_say(x->out, "Vertex %d is on %s: it moves along the curve of the edges\n"
                "%d-%d and %d-%d%s.\n", v,
                p->reason == SUBDIV_BOUNDARY ? "the boundary" : "a crease", v, p->ends[0], v,
                p->ends[1], sdv_has_weights(sdv_crease_vertex(), 0.75, 0, 0, 0.125) ?
                ", a cubic B-spline" : "");
    else if (p->reason == SUBDIV_OWN_SHARPNESS)
        sdv_say(x->out, reason, v, sdv_name_sharpness(p->sharpness, text));
    else
        sdv_say(x->out, reason, v, p->rule == SUBDIV_SMOOTH ? p->valence : p->sharp_edges);
}

static void sdv_explain_vertex(sdv_explainer *x)
{
    static const char *const names[] = { "smooth", "a dart", "on a crease", "a corner" };
    static const char *const letters[] = { "S", "S", "C", "K" };
    const subdiv_point *p = &x->point;
    subdiv_rule rule = p->rule, next = p->weight < 1 ? p->next : rule;
    char mean[32];
    sdv_say(x->out, "vertex point of vertex %d.\n", p->parent);
    sdv_say_vertex_rule(x);
    if (next != rule) {
        sdv_say(x->out, "On the next level it is %s. What fades away has a mean sharpness of\n%s, "
                "and so much of the point is still sharp:\n", names[next],
                sdv_fraction(p->weight, mean));
        sdv_say_blend(x, "V", p->weight, letters[rule], letters[next]);
        sdv_say_formula(x, letters[rule], rule);
        sdv_say_formula(x, letters[next], next);
    } else {
        sdv_say(x->out, "\n");
        sdv_say_formula(x, "V", rule);
    }
    if (next != SUBDIV_CORNER || rule != next) sdv_say_letters(x, rule, next);
}

// ---- edges

// Writes the formula of the smooth point of the edge: that of the paper, if the mask has it.
static void sdv_say_smooth_edge(sdv_explainer *x, const char *name)
{
    int triangles = 0, loop = x->rules->loop;
    for (int i = 0; i < 2 && !loop && x->rules->triangles == SUBDIV_TRIANGLES_SMOOTH; i++)
        triangles += sdv_face_end(&x->cage.level, x->point.faces[i]) -
                     sdv_face_start(&x->cage.level, x->point.faces[i]) == 3;
    sdv_mask mask = sdv_edge_mask(x->rules, 0, 0, 2, triangles);
    char ends[32], faces[32];
    sdv_say(x->out, "    %s = ", name);
    if (loop && sdv_has_weights(mask, 0.375, 0, 0.125, 0))
        sdv_say(x->out, "(3 a + 3 b + c + d) / 8  [Loop87]\n");
    else if (!loop && sdv_has_weights(mask, 0.25, 0, 0.25, 0))
        sdv_say(x->out, "(a + b + f + g) / 4  [CC78]\n");
    else
        sdv_say(x->out, "%s (a + b) + %s (%s)%s\n", sdv_fraction(mask.self, ends),
                sdv_fraction(mask.face, faces), loop ? "c + d" : "f + g",
                triangles ? "  [OSD]" : "");
}

static void sdv_say_edge_rule(sdv_explainer *x)
{
    const subdiv_point *p = &x->point;
    const char *reason = sdv_reasons[p->reason][1];
    char text[48];
    if (p->reason != SUBDIV_OWN_SHARPNESS)
        sdv_say(x->out, reason, p->ends[0], p->ends[1], p->faces[0], p->faces[1]);
    else
        sdv_say(x->out, reason, p->ends[0], p->ends[1], sdv_name_sharpness(p->sharpness, text),
                p->next == p->rule ? "" : p->weight >= 1 ? "\nIt ends before the next level." :
                "\nIt ends before the next level, and so much of the point is still sharp:");
}

static void sdv_explain_edge(sdv_explainer *x)
{
    const subdiv_point *p = &x->point;
    int midpoint = p->rule == SUBDIV_CREASE && p->weight >= 1;
    sdv_say(x->out, "edge point of edge %d-%d.\n", p->ends[0], p->ends[1]);
    sdv_say_edge_rule(x);
    if (midpoint) {
        sdv_say(x->out, "\n    E = (a + b) / 2\n");
    } else if (p->rule == SUBDIV_SMOOTH) {
        sdv_say(x->out, "\n");
        sdv_say_smooth_edge(x, "E");
    } else {
        sdv_say_blend(x, "E", p->weight, "C", "S");
        sdv_say(x->out, "    C = (a + b) / 2\n");
        sdv_say_smooth_edge(x, "S");
    }
    sdv_say(x->out, "\nHere a and b are the ends of the edge%s.\n", midpoint ? "" :
            x->rules->loop ? ", and c and d the vertices opposite" :
            ", and f and g the face points beside it");
}

SUBDIV_DEF subdiv_result subdiv_explain(char *text, size_t capacity, const subdiv_mesh *cage,
                                        int point, const subdiv_options *opt)
{
    sdv_context context = sdv_begin(opt);
    sdv_text out = { text, 0, capacity };
    sdv_explainer x;
    if (text && capacity) text[0] = 0;
    else sdv_fail(&context, SUBDIV_ERROR_ARGUMENT, text ? "capacity is 0" : "text is NULL");
    sdv_begin_explainer(&context, &x, cage, opt);
    x.out = &out;
    if (!context.result) x.point = sdv_find_point(&x, point);
    if (!context.result)
        context.result = subdiv_refined_stencils(&x.masks, x.surface, point, 1, opt);
    if (!context.result) sdv_find_groups(&x);
    if (!context.result) {
        const subdiv_point *p = &x.point;
        sdv_say(&out, "Point %d of the mesh refined once is the ", point);
        if (p->kind == SUBDIV_VERTEX_POINT) sdv_explain_vertex(&x);
        else if (p->kind == SUBDIV_EDGE_POINT) sdv_explain_edge(&x);
        else sdv_say(&out, "face point of face %d.\nFace %d has %d vertices; its face point is "
                     "their mean.\n\n    F = (v1 + ... + vn) / n, n = %d  [CC78]\n", p->parent,
                     p->parent, p->valence, p->valence);
        sdv_say_mask(&x);
        if (out.capacity == 0)
            sdv_fail(&context, SUBDIV_ERROR_TOO_LARGE, "the text does not fit");
    }
    if (context.result && text && capacity) text[0] = 0;
    sdv_end_explainer(&x);
    return context.result;
}
#endif // SUBDIV_NO_TOOLS

// ------------------------------------------------------------------------------- >>cleanup
#if defined(__clang__)
#pragma STDC FP_CONTRACT DEFAULT
#elif defined(__GNUC__) && (defined(__FP_FAST_FMA) || defined(__FP_FAST_FMAF))
#pragma GCC pop_options
#endif

#undef SDV_INLINE
#undef SDV_SIMD
#undef SDV_SEPARATE
#undef SDV_POSIX
#undef SDV_GUARD
#undef SDV_NEW
#undef SDV_KEEP
#undef SDV_CARVE
#undef SDV_IMPLIED
#undef SDV_FULL_LEVELS
#undef SDV_JOB_POINTS
#undef SDV_CELL_BITS
#undef SDV_CELL_LEAF
#undef SDV_CELL_NONE
#undef SDV_CELL_FAR
#undef SDV_CLOSE
#undef SDV_CELL_POLYNOMIALS

#if defined(__GNUC__) && defined(__cplusplus)
#pragma GCC diagnostic pop
#endif
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
