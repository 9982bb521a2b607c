// The command line: what its rooms share. ../subdiv_cli.c reads the options and runs the work.
#ifndef CLI_H
#define CLI_H

#define _XOPEN_SOURCE 700             // clock_gettime, realpath and more, where there are pthreads

#include <limits.h>
#include <stdio.h>

#ifndef _WIN32
#define HAS_PTHREADS
#endif

#include "subdiv.h"

enum { DONE = 0, FAILED = 1, MISUSED = 2 };   // what the program returns
enum { LARGE = 1 << 24 };                     // vertices; results with more are streamed
enum { EXPLAIN_ALL = INT_MAX };               // instead of a point: there is none with this number

enum {
    SCHEME, LEVELS, BOUNDARY, CREASING, TRIANGLES, VERTEX_RULE, UV, LIMIT, TESSELLATE, CURVE,
    THREADS,
    CREASE_ANGLE, CREASE_GROUPS, CREASE_SEAMS, CREASE_SHARPNESS,
    EVAL, FOLDER, PICTURE, HTML, STREAM, PART, NO_TAGS, NO_UVS, MERGE_MATERIALS,
    TRIANGULATE, KEEP_HOLES, INFO, EXPLAIN, TIME, HELP, VERSION, OPTION_COUNT
};

typedef struct command {
    int         given[OPTION_COUNT];  // the value of each option; -1: not given
    float       numbers[OPTION_COUNT];    // of those with any number
    int         part_count;           // of PART
    const char *texts[OPTION_COUNT];      // of those with a text
    char      **files;                // all that are named
    int         file_count;
    const char *input, *output;       // of this run; NULL: not given
} command;

// What a run needs. main frees it.
typedef struct work {
    subdiv_mesh     cage, fine;
    subdiv_surface *surface;
    void           *merged;           // arrays of the cage
    float          *points, *colors;  // of curves, and the sizes and vertices of their polylines:
    int            *numbers;          // fine has these arrays
} work;

// ---------------------------------------------------------------------------------- subdiv_cli.c

int    read_number(const char *text);          // from 0 to INT_MAX, or -1
int    levels_of(const command *cmd);
int    pieces_of(const command *cmd);         // of each edge of the cage
int    report(const char *file, const subdiv_options *opt);      // prints an error

// --------------------------------------------------------------------------------------- steps.c

void   show_steps(int timed);
void   begin_step(const char *name);
void   end_step(int vertex_count);             // vertices that it worked on
void   end_progress(void);                     // before anything else is printed
extern size_t written;                         // bytes, in this step

// --------------------------------------------------------------------------------------- files.c

// A file that is being written. Under its final name it is always whole: until then it has another
// one, and is removed if writing fails or the program is stopped. Written in place is only what is
// no regular file, such as a device, or in a folder that takes no new files.
typedef struct output {
    FILE       *file;
    const char *name;                 // as it was given; NULL or "-": standard output
    const char *path;
    char        real[4096];           // the path behind links
    char        beside[4096 + 32];    // the name until the file is whole
} output;

void   catch_signals(void);
int    open_output(output *o, const char *name);
int    close_output(output *o, subdiv_result result, const char *input, const subdiv_options *opt);
int    flush_output(void);
size_t write_file(void *file, const void *bytes, size_t size);   // a subdiv_write
subdiv_result set_write_error(const subdiv_options *opt);        // with the reason, from errno
const char *file_name(const char *path);       // the last part of a path
int    is_regular(const char *path);           // can be read twice
int    is_same_file(const char *a, const char *b);
int    make_folder(const char *path);

// ------------------------------------------------------------------------------------- formats.c

enum { OBJ, PLY, STL, GLB, UNKNOWN };

// Writes a mesh. Gives it normals if the format needs them.
subdiv_result save_mesh(subdiv_mesh *mesh, int format, FILE *file, const subdiv_options *opt);

int    is_utf8(const char *text);

// Notes an error as the library does.
subdiv_result set_error(const subdiv_options *opt, subdiv_result code, const char *message);

// ----------------------------------------------------------------------------------- materials.c

// The materials of a mesh: number 0 is that of faces before any usemtl.
typedef struct materials {
    int          count;
    const char **names;               // [count]  in the mesh; names[0] is "default"
    int         *of_faces;            // [face_count of the mesh]
    int         *order;               // [face_count]  the faces, sorted by material
    void        *memory;              // all of it
} materials;

subdiv_result find_materials(materials *all, const subdiv_mesh *mesh, const subdiv_options *opt);
subdiv_result merge_materials(work *w, const subdiv_options *opt);      // of the cage
void   material_color(int material, float rgb[3]);             // one that tells it from others

// --------------------------------------------------------------------------------------- shape.c

// What is shown of meshes: the box around the points that faces and polylines have.
typedef struct frame {
    int    is_full;                   // there is such a point
    double low[3], high[3];
} frame;

// A mesh as it is shown: in the unit ball or, without a box, where it is. It has normals and the
// creases of its cage. Curves have no surface.
typedef struct shape {
    subdiv_mesh mesh;
    float      *positions;
    int        *creases;
} shape;

subdiv_result frame_mesh(frame *box, const subdiv_mesh *mesh, const subdiv_options *opt);
subdiv_result place_points(float *to, const subdiv_mesh *mesh, const frame *box,
                           const subdiv_options *opt);       // in the ball; others in its middle
subdiv_result make_shape(shape *s, const subdiv_mesh *mesh, const frame *box,
                         const subdiv_mesh *cage, const subdiv_surface *surface, int pieces,
                         const subdiv_options *opt);         // pieces: of each edge of the cage
void   free_shape(shape *s);

// ------------------------------------------------------------------------------- the other rooms

subdiv_result load(work *w, const command *cmd, const subdiv_options *opt);
void   start_threads(int count, subdiv_options *opt);
void   end_threads(void);
int    inspect(const subdiv_mesh *cage, const command *cmd, const subdiv_options *opt);
int    explain_all(const subdiv_mesh *cage, const command *cmd, const subdiv_options *opt);
int    draw_picture(work *w, const command *cmd, const subdiv_options *opt);
subdiv_result check_page(const command *cmd, double bytes, const subdiv_options *opt);  // at least
int    write_page(const work *w, const command *cmd, const subdiv_options *opt);
extern const char *const viewer_page[], *const viewer_script[], *const viewer_draw[];   // to NULL
subdiv_result refine_curves(work *w, const command *cmd, const subdiv_options *opt);
int    run_samples(work *w, const command *cmd, const subdiv_options *opt);

#endif
