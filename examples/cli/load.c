// Reads the cage.
#include "cli.h"

#include <string.h>

// Reads a file and leaves out its UVs: vt lines become comments, and f and l lines lose what stands
// behind a slash.
typedef struct reader {
    FILE *file;
    int   no_uvs;
    char  keyword;                    // of the line: 'f', also for l; 't' for vt; 0: not read yet;
                                      // 'v': a v whose next letter will tell; '?': any other
    int   in_slash, continued;        // behind a slash; a backslash was the last character
} reader;

// Takes one character of the text and returns it, another one in its place, or 0 for none.
static char filter_uvs(reader *r, char c)
{
    int is_end = c == '\n' || c == '\r', is_blank = c == ' ' || c == '\t' || is_end;
    if (is_end && !r->continued) r->keyword = 0;
    if (!is_end) r->continued = c == '\\';
    if (is_blank || c == '\\') r->in_slash = 0;
    if (is_blank && r->keyword != 'v') return (char)(r->keyword == 't' && !is_end ? 0 : c);
    switch (r->keyword) {
    case 0:
        r->keyword = (char)(c == 'v' ? 'v' : c == 'f' || c == 'l' ? 'f' : '?');
        return (char)(c == 'v' ? 0 : c);
    case 'f':
        if (c == '/') r->in_slash = 1;
        return (char)(r->in_slash ? 0 : c);
    case 't':
        return 0;
    default:
        return c;
    }
}

static size_t drop_uvs(reader *r, char *to, const char *from, size_t size)
{
    char *start = to;
    for (; size; size--, from++) {
        int held = r->keyword == 'v', is_vt = held && *from == 't';
        if (is_vt) r->keyword = 't', *to++ = '#';
        if (held && !is_vt) r->keyword = '?', *to++ = 'v';
        char c = filter_uvs(r, *from);
        if (c) *to++ = c;
    }
    return (size_t)(to - start);
}

// A subdiv_read. A v that is held back comes before its successor, so there is a byte of room.
static size_t read_file(void *user, void *bytes, size_t size)
{
    reader *r = (reader *)user;
    char *text = (char *)bytes;
    size_t n = 0;
    if (!r->no_uvs) {
        n = fread(text, 1, size, r->file);
    } else {
        for (size_t got = 1; n == 0 && got; ) {
            got = fread(text + 1, 1, size - 1, r->file);
            n = drop_uvs(r, text, text + 1, got);
        }
    }
    return n == 0 && ferror(r->file) ? (size_t)-1 : n;
}

static subdiv_result load_text(subdiv_mesh *cage, const char *path, int no_uvs,
                               const subdiv_options *opt)
{
    reader r = {0};
    int is_stdin = strcmp(path, "-") == 0;
    if (!is_stdin && !no_uvs) return subdiv_load_obj(cage, path, opt);
    r.no_uvs = no_uvs;
    r.file = is_stdin ? stdin : fopen(path, "rb");
    if (r.file == NULL) return subdiv_load_obj(cage, path, opt);     // which says why
    subdiv_result result = subdiv_load_obj_callback(cage, read_file, &r, opt);
    if (!is_stdin) fclose(r.file);
    return result;
}

// Whether the file can be read but for its UVs.
static int has_broken_uvs(const char *path)
{
    subdiv_mesh mesh = {0};
    int is_so = is_regular(path) && load_text(&mesh, path, 1, NULL) == SUBDIV_OK;
    subdiv_mesh_free(&mesh);
    return is_so;
}

subdiv_result load(work *w, const command *cmd, const subdiv_options *opt)
{
    const int *given = cmd->given;
    subdiv_mesh *cage = &w->cage;
    subdiv_result result = load_text(cage, cmd->input, given[NO_UVS] == 1, opt);
    size_t size = strlen(opt->error->message), room = sizeof opt->error->message - size;
    if (result && given[NO_UVS] < 0 && has_broken_uvs(cmd->input))
        snprintf(opt->error->message + size, room, "; --no-uvs reads the rest");
    if (given[SCHEME] >= 0) cage->scheme = (subdiv_scheme)given[SCHEME];
    if (given[BOUNDARY] >= 0) cage->boundary = (subdiv_boundary)given[BOUNDARY];
    if (given[CREASING] >= 0) cage->creasing = (subdiv_creasing)given[CREASING];
    if (given[TRIANGLES] >= 0) cage->triangles = (subdiv_triangles)given[TRIANGLES];
    if (given[VERTEX_RULE] >= 0) cage->vertex_rule = (subdiv_vertex_rule)given[VERTEX_RULE];
    if (given[UV] >= 0) cage->uv_rule = (subdiv_uv_rule)given[UV];
    return result || given[MERGE_MATERIALS] < 0 ? result : merge_materials(w, opt);
}
