// Output: binary PLY, binary STL and GLB; OBJ is the library's own. All numbers are little-endian,
// on any machine.
#include "cli.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

// --------------------------------------------------------------------------------------- bytes

typedef struct writer {
    FILE         *file;
    int           failed;
    size_t        used;
    unsigned char buffer[1 << 16];
} writer;

static void flush(writer *w)
{
    if (w->used && write_file(w->file, w->buffer, w->used) != w->used) w->failed = 1;
    w->used = 0;
}

// Writes the lowest bytes of a number, the lowest first.
static void put(writer *w, unsigned long number, int bytes)
{
    if (w->used + 4 > sizeof w->buffer) flush(w);
    for (; bytes > 0; bytes--, number >>= 8) w->buffer[w->used++] = (unsigned char)(number & 255);
}

static void put_int(writer *w, int number)
{
    put(w, (unsigned long)(unsigned)number, 4);
}

static void put_floats(writer *w, const float *numbers, int count)
{
    unsigned bits;
    for (int i = 0; i < count; i++) {
        memcpy(&bits, numbers + i, sizeof bits);
        put(w, bits, 4);
    }
}

static void put_text(writer *w, const char *text)
{
    while (*text) put(w, (unsigned char)*text++, 1);
}

static subdiv_result end_writing(writer *w, const subdiv_options *opt)
{
    flush(w);
    return w->failed ? set_write_error(opt) : SUBDIV_OK;
}

subdiv_result set_error(const subdiv_options *opt, subdiv_result code, const char *message)
{
    opt->error->code = code;
    snprintf(opt->error->message, sizeof opt->error->message, "%s", message);
    return code;
}

static int face_size(const subdiv_mesh *mesh, int face)
{
    return mesh->face_size ? mesh->face_size : mesh->face_sizes[face];
}

static unsigned char_of(float color)
{
    return (unsigned)(255 * (color < 0 ? 0 : color > 1 ? 1 : color) + 0.5f);
}

// ----------------------------------------------------------------------------------------- PLY

static void put_ply_header(writer *w, const subdiv_mesh *mesh)
{
    char counts[128];
    put_text(w, "ply\nformat binary_little_endian 1.0\ncomment subdiv.h\n");
    snprintf(counts, sizeof counts, "element vertex %d\n", mesh->vertex_count);
    put_text(w, counts);
    put_text(w, "property float x\nproperty float y\nproperty float z\n");
    if (mesh->normals) put_text(w, "property float nx\nproperty float ny\nproperty float nz\n");
    if (mesh->colors)
        put_text(w, "property uchar red\nproperty uchar green\nproperty uchar blue\n");
    snprintf(counts, sizeof counts, "element face %d\n", mesh->face_count);
    put_text(w, counts);
    put_text(w, "property list int int vertex_indices\n");
    if (mesh->uv_count) put_text(w, "property list int float texcoord\n");
    put_text(w, "end_header\n");
}

// Polygons; the normal of a point is that of its first side.
static subdiv_result save_ply(writer *w, const subdiv_mesh *mesh, const subdiv_options *opt)
{
    const int *vertex = mesh->face_vertices, *uv = mesh->uv_count ? mesh->face_uvs : NULL;
    put_ply_header(w, mesh);
    for (size_t v = 0; v < (size_t)mesh->vertex_count; v++) {
        put_floats(w, mesh->positions + 3 * v, 3);
        if (mesh->normals) put_floats(w, mesh->normals + 3 * v, 3);
        for (size_t k = 0; k < 3 && mesh->colors; k++)
            put(w, char_of(mesh->colors[3 * v + k]), 1);
    }
    for (int f = 0; f < mesh->face_count; f++) {
        int size = face_size(mesh, f), with = uv ? 2 * size : 0;
        put_int(w, size);
        for (int i = 0; i < size; i++) put_int(w, *vertex++);
        if (uv == NULL) continue;
        for (int i = 0; i < size; i++)
            if (uv[i] < 0) with = 0;
        put_int(w, with);
        for (int i = 0; i < size; i++, uv++)
            if (with) put_floats(w, mesh->uvs + 2 * (size_t)*uv, 2);
    }
    return end_writing(w, opt);
}

// ----------------------------------------------------------------------------------------- STL

static void put_triangle(writer *w, const float *a, const float *b, const float *c)
{
    double n[3], length = 0;
    float normal[3];
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = ((double)b[i] - (double)a[i]) * ((double)c[j] - (double)a[j]) -
               ((double)b[j] - (double)a[j]) * ((double)c[i] - (double)a[i]);
        length += n[k] * n[k];
    }
    for (int k = 0; k < 3; k++) normal[k] = (float)(length > 0 ? n[k] / sqrt(length) : 0);
    put_floats(w, normal, 3);
    put_floats(w, a, 3);
    put_floats(w, b, 3);
    put_floats(w, c, 3);
    put(w, 0, 2);
}

static subdiv_result save_stl(writer *w, const subdiv_mesh *mesh, const subdiv_options *opt)
{
    char header[80] = "binary STL by subdiv.h";
    size_t count = 0;
    const int *face = mesh->face_vertices;
    for (int f = 0; f < mesh->face_count; f++) count += (size_t)face_size(mesh, f) - 2;
    if (count > 0xffffffff) return set_error(opt, SUBDIV_ERROR_TOO_LARGE, "too large for STL");
    for (int i = 0; i < 80; i++) put(w, (unsigned char)header[i], 1);
    put(w, (unsigned long)count, 4);
    for (int f = 0; f < mesh->face_count; face += face_size(mesh, f++))
        for (int i = 2; i < face_size(mesh, f); i++)
            put_triangle(w, mesh->positions + 3 * (size_t)face[0],
                         mesh->positions + 3 * (size_t)face[i - 1],
                         mesh->positions + 3 * (size_t)face[i]);
    return end_writing(w, opt);
}

// ----------------------------------------------------------------------------------------- GLB

typedef struct json {                 // text that grows
    char  *text;
    size_t size, room;
    int    failed;
} json;

static void add_bytes(json *j, const char *bytes, size_t size)
{
    if (j->size + size > j->room) {
        size_t room = 2 * (j->size + size) + 4096;
        char *text = (char *)realloc(j->text, room);
        if (text == NULL) j->failed = 1;
        if (text == NULL) return;
        j->text = text;
        j->room = room;
    }
    memcpy(j->text + j->size, bytes, size);
    j->size += size;
}

static void add(json *j, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    add_bytes(j, text, strlen(text));
}

// The bytes of a character of UTF-8, 0 if there is none.
static size_t utf8_size(const char *text)
{
    const unsigned char *p = (const unsigned char *)text;
    size_t size = p[0] < 0x80 ? 1 : p[0] < 0xc2 ? 0 : p[0] < 0xe0 ? 2 : p[0] < 0xf0 ? 3
                : p[0] < 0xf5 ? 4 : 0;
    for (size_t i = 1; i < size; i++)
        if (p[i] < 0x80 || p[i] > 0xbf) return 0;
    if ((p[0] == 0xe0 && p[1] < 0xa0) || (p[0] == 0xed && p[1] > 0x9f) ||
        (p[0] == 0xf0 && p[1] < 0x90) || (p[0] == 0xf4 && p[1] > 0x8f)) return 0;
    return size;
}

int is_utf8(const char *text)
{
    while (*text && utf8_size(text)) text += utf8_size(text);
    return *text == 0;
}

// Text that is not UTF-8 is taken for Latin-1.
static void add_string(json *j, const char *text)
{
    int utf8 = is_utf8(text);
    add(j, "\"");
    for (; *text; text++) {
        unsigned c = (unsigned char)*text;
        if (c < 32 || c == '"' || c == '\\' || c == 127 || (c > 127 && !utf8))
            add(j, "\\u%04x", c);
        else add_bytes(j, text, 1);
    }
    add(j, "\"");
}

// A vertex: a position, a normal, and a UV and a colour if the mesh has them. In floats:
enum { NORMAL_AT = 3, UV_AT = 6 };

static int color_at(const subdiv_mesh *mesh) { return mesh->uv_count ? UV_AT + 2 : UV_AT; }
static int stride_of(const subdiv_mesh *mesh) { return color_at(mesh) + (mesh->colors ? 3 : 0); }

// Makes the vertices what glTF expects: v grows downward, colours are linear, normals have length 1
// even where the surface has none.
static void convert_vertices(float *data, int count, const subdiv_mesh *mesh)
{
    int stride = stride_of(mesh);
    for (int i = 0; i < count; i++, data += stride) {
        float *n = data + NORMAL_AT, *c = data + color_at(mesh);
        if (n[0] == 0 && n[1] == 0 && n[2] == 0) n[2] = 1;
        if (mesh->uv_count) data[UV_AT + 1] = 1 - data[UV_AT + 1];
        for (int k = 0; k < 3 && mesh->colors; k++) {
            float s = c[k] < 0 ? 0 : c[k] > 1 ? 1 : c[k];
            c[k] = s <= 0.04045f ? s / 12.92f : powf((s + 0.055f) / 1.055f, 2.4f);
        }
    }
}

static void add_materials(json *j, const materials *all, const subdiv_mesh *mesh)
{
    add(j, "\"materials\":[");
    for (int i = 0; i < all->count; i++) {
        float rgb[3] = {1, 1, 1};
        if (!mesh->colors) material_color(i, rgb);
        add(j, "%s{\"name\":", i ? "," : "");
        add_string(j, all->names[i]);
        add(j, ",\"doubleSided\":true,\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
            "\"roughnessFactor\":0.6,\"baseColorFactor\":[%.3f,%.3f,%.3f,1]}}",
            (double)(rgb[0] * rgb[0]), (double)(rgb[1] * rgb[1]), (double)(rgb[2] * rgb[2]));
    }
    add(j, "],");
}

// The triangles of one material after the other: a primitive each. starts: the first triangle of
// each face
static void add_primitives(json *j, const materials *all, const subdiv_mesh *mesh,
                           const int *starts, json *accessors, int accessor)
{
    size_t offset = 0;
    add(j, "\"meshes\":[{\"primitives\":[");
    for (int i = 0; i < mesh->face_count; accessor++) {
        int material = all->of_faces[all->order[i]], first = i;
        size_t count = 0;
        for (; i < mesh->face_count && all->of_faces[all->order[i]] == material; i++)
            count += 3 * (size_t)(starts[all->order[i] + 1] - starts[all->order[i]]);
        add(j, "%s{\"attributes\":{\"POSITION\":0,\"NORMAL\":1", first ? "," : "");
        if (mesh->uv_count) add(j, ",\"TEXCOORD_0\":2");
        if (mesh->colors) add(j, ",\"COLOR_0\":%d", mesh->uv_count ? 3 : 2);
        add(j, "},\"indices\":%d,\"material\":%d}", accessor, material);
        add(accessors, ",{\"bufferView\":1,\"byteOffset\":%.0f,\"componentType\":5125,"
            "\"count\":%.0f,\"type\":\"SCALAR\"}", 4 * (double)offset, (double)count);
        offset += count;
    }
    add(j, "]}],");
}

static void add_accessor(json *j, const char *type, int at, int count)
{
    add(j, "%s{\"bufferView\":0,\"byteOffset\":%d,\"componentType\":5126,\"count\":%d,"
        "\"type\":\"%s\"", at ? "," : "", 4 * at, count, type);
}

// The vertices' accessors; that of positions tells their bounds.
static int add_accessors(json *j, const subdiv_mesh *mesh, int count)
{
    float low[3], high[3];
    memcpy(low, mesh->positions, sizeof low);
    memcpy(high, mesh->positions, sizeof high);
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++) {
        float x = mesh->positions[i];
        if (x < low[i % 3]) low[i % 3] = x;
        if (x > high[i % 3]) high[i % 3] = x;
    }
    add_accessor(j, "VEC3", 0, count);
    add(j, ",\"min\":[%.9g,%.9g,%.9g],\"max\":[%.9g,%.9g,%.9g]}", (double)low[0], (double)low[1],
        (double)low[2], (double)high[0], (double)high[1], (double)high[2]);
    add_accessor(j, "VEC3", NORMAL_AT, count);
    add(j, "}");
    if (mesh->uv_count) add_accessor(j, "VEC2", UV_AT, count), add(j, "}");
    if (mesh->colors) add_accessor(j, "VEC3", color_at(mesh), count), add(j, "}");
    return 2 + (mesh->uv_count > 0) + (mesh->colors != NULL);
}

// What a GLB file is made of.
typedef struct glb {
    subdiv_buffer buffer;
    materials     all;
    float        *data;               // [stride_of(mesh) * vertex_count of the buffer]
    int          *starts;             // [face_count + 1]  the first triangle of each face
    json          head, accessors;
} glb;

static subdiv_result describe_glb(glb *g, const subdiv_mesh *mesh, const subdiv_options *opt)
{
    int count = g->buffer.vertex_count, stride = stride_of(mesh);
    double vertices = 4.0 * stride * count, indices = 4.0 * g->buffer.index_count;
    json *j = &g->head;
    if (vertices + indices > 4e9)
        return set_error(opt, SUBDIV_ERROR_TOO_LARGE, "too large for GLB");
    add(j, "{\"asset\":{\"version\":\"2.0\",\"generator\":\"subdiv.h\"},\"scene\":0,"
        "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],");
    add_materials(j, &g->all, mesh);
    int accessor = add_accessors(&g->accessors, mesh, count);
    add_primitives(j, &g->all, mesh, g->starts, &g->accessors, accessor);
    add(j, "\"accessors\":[");
    add_bytes(j, g->accessors.text, g->accessors.size);
    add(j, "],\"bufferViews\":[{\"buffer\":0,\"byteLength\":%.0f,\"byteStride\":%d,"
        "\"target\":34962},{\"buffer\":0,\"byteOffset\":%.0f,\"byteLength\":%.0f,"
        "\"target\":34963}],\"buffers\":[{\"byteLength\":%.0f}]}", vertices, 4 * stride, vertices,
        indices, vertices + indices);
    while (j->size % 4) add(j, " ");
    return j->failed || g->accessors.failed ? set_error(opt, SUBDIV_ERROR_MEMORY, "out of memory")
                                            : SUBDIV_OK;
}

static subdiv_result write_glb(writer *w, const glb *g, const subdiv_mesh *mesh,
                               const subdiv_options *opt)
{
    const int *indices = (const int *)g->buffer.indices;
    size_t floats = (size_t)stride_of(mesh) * (size_t)g->buffer.vertex_count;
    unsigned long binary = (unsigned long)(4 * (floats + (size_t)g->buffer.index_count));
    put_text(w, "glTF");
    put(w, 2, 4);
    put(w, (unsigned long)(12 + 8 + g->head.size + 8 + binary), 4);
    put(w, (unsigned long)g->head.size, 4);
    put_text(w, "JSON");
    for (size_t i = 0; i < g->head.size; i++) put(w, (unsigned char)g->head.text[i], 1);
    put(w, binary, 4);
    put_text(w, "BIN");
    put(w, 0, 1);
    for (size_t i = 0; i < floats; i++) put_floats(w, g->data + i, 1);
    for (int f = 0; f < mesh->face_count; f++)
        for (int t = 3 * g->starts[g->all.order[f]]; t < 3 * g->starts[g->all.order[f] + 1]; t++)
            put_int(w, indices[t]);
    return end_writing(w, opt);
}

static subdiv_result fill_glb(glb *g, const subdiv_mesh *mesh, const subdiv_options *opt)
{
    subdiv_vertices out = {0};
    size_t count = (size_t)g->buffer.vertex_count;
    out.stride = stride_of(mesh);
    g->data = (float *)malloc((size_t)out.stride * count * sizeof *g->data);
    g->starts = (int *)malloc(((size_t)mesh->face_count + 1) * sizeof *g->starts);
    if (!g->data || !g->starts) return set_error(opt, SUBDIV_ERROR_MEMORY, "out of memory");
    g->starts[0] = 0;
    for (int f = 0; f < mesh->face_count; f++)
        g->starts[f + 1] = g->starts[f] + face_size(mesh, f) - 2;
    out.positions = g->data;
    out.normals = g->data + NORMAL_AT;
    out.uvs = mesh->uv_count ? g->data + UV_AT : NULL;
    out.colors = mesh->colors ? g->data + color_at(mesh) : NULL;
    subdiv_result result = subdiv_fill_buffer(&g->buffer, mesh, &out, opt);
    if (!result) convert_vertices(g->data, g->buffer.vertex_count, mesh);
    return result;
}

static subdiv_result save_glb(writer *w, subdiv_mesh *mesh, const subdiv_options *opt)
{
    glb g = {0};
    subdiv_result result = SUBDIV_OK;
    if (mesh->face_count == 0)
        return set_error(opt, SUBDIV_ERROR_EMPTY, "no faces, but GLB needs some");
    if (!mesh->normals) result = subdiv_normals(mesh, opt);
    if (!result) result = subdiv_make_buffer(&g.buffer, mesh, 4, opt);
    if (!result) result = find_materials(&g.all, mesh, opt);
    if (!result) result = fill_glb(&g, mesh, opt);
    if (!result) result = describe_glb(&g, mesh, opt);
    if (!result) result = write_glb(w, &g, mesh, opt);
    subdiv_buffer_free(&g.buffer);
    free(g.all.memory);
    free(g.data);
    free(g.starts);
    free(g.head.text);
    free(g.accessors.text);
    return result;
}

subdiv_result save_mesh(subdiv_mesh *mesh, int format, FILE *file, const subdiv_options *opt)
{
    if (format == OBJ) return subdiv_save_obj_callback(mesh, write_file, file, opt);
    writer *w = (writer *)malloc(sizeof *w);
    if (w == NULL) return set_error(opt, SUBDIV_ERROR_MEMORY, "out of memory");
    w->file = file;
    w->failed = 0;
    w->used = 0;
    subdiv_result result = format == PLY ? save_ply(w, mesh, opt)
                         : format == STL ? save_stl(w, mesh, opt) : save_glb(w, mesh, opt);
    free(w);
    return result;
}
