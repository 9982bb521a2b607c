// A mesh of bytes, legal or wild. It is lent to the library with arrays of their own, each of just
// its size, and has to be the same when it is taken back.
#ifndef CAGE_H
#define CAGE_H

#include "fuzz.h"

enum { VERTICES = 48, FACES = 32, FACE_VERTICES = 256, TAGS = 16, UVS = 64, STATEMENTS = 4 };

typedef struct cage {
    subdiv_mesh mesh;                     // its arrays are those below
    int   vertices, faces, sum;           // before the mesh becomes wild; sum of the sizes
    int   creases, corners, holes, uvs, statements;
    float positions[3 * VERTICES], colors[3 * VERTICES], normals[3 * VERTICES];
    int   face_sizes[FACES], face_vertices[FACE_VERTICES], face_uvs[FACE_VERTICES];
    int   crease_vertices[2 * TAGS], corner_vertices[TAGS], hole[TAGS];
    float crease_sharpness[TAGS], corner_sharpness[TAGS], uv[2 * UVS];
    int   statement_faces[STATEMENTS];
    char *statement[STATEMENTS];
} cage;

static cage c;
static subdiv_mesh lent;                  // what the library gets: arrays that end where they end
static int wild;                          // something in the mesh or the arguments may be an error
static double weights_of_rule[2];

static void add_face(int size, const int *vertices)
{
    if (c.faces == FACES || c.sum + size > FACE_VERTICES) return;
    c.face_sizes[c.faces++] = size;
    memcpy(c.face_vertices + c.sum, vertices, (size_t)size * sizeof(int));
    c.sum += size;
}

static void add_quad(int triangles, int v0, int v1, int v2, int v3)
{
    const int v[4] = { v0, v1, v2, v3 }, w[3] = { v0, v2, v3 };
    add_face(triangles ? 3 : 4, v);
    if (triangles) add_face(3, w);
}

// A grid, which may be closed to a tube or a torus.
static void add_grid(bytes *b, int triangles)
{
    int w = 1 + below(b, 4), h = 1 + below(b, 4), closed = below(b, 4);
    int columns = w + !(closed & 1), rows = h + !(closed & 2);
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            int right = (x + 1) % columns, row = y * columns, next = (y + 1) % rows * columns;
            add_quad(triangles, row + x, row + right, next + right, next + x);
        }
    c.vertices = columns * rows;
}

// Faces around vertex 0, a full circle or less.
static void add_fan(bytes *b, int triangles)
{
    int count = 1 + below(b, 16), open = below(b, 2), step = 2 - triangles, rim = count * step;
    for (int i = 0; i < count; i++) {
        int v[4] = { 0, 1 + i * step, 2 + i * step, 1 + (i * step + 2) % (rim + open) };
        if (triangles) v[2] = 1 + (i + 1) % (rim + open);
        add_face(3 + !triangles, v);
    }
    c.vertices = 1 + rim + open;
}

// A polygon and what stands on its sides, with another one on top or without.
static void add_prism(bytes *b, int triangles)
{
    int n = 3 + below(b, 8), v[16];
    for (int i = 0; i < n; i++) {
        add_quad(triangles, i, (i + 1) % n, n + (i + 1) % n, n + i);
        v[i] = n + i;
    }
    if (below(b, 2)) add_face(triangles ? 3 : n, v);
    c.vertices = 2 * n;
}

static void add_soup(bytes *b, int triangles)
{
    c.vertices = 1 + below(b, VERTICES);
    for (int count = below(b, 12); count > 0; count--) {
        int size = triangles ? 3 : 3 + below(b, 6), v[8];
        for (int i = 0; i < size; i++) v[i] = below(b, c.vertices);
        add_face(size, v);
    }
}

// Makes the mesh odd in one place.
static void edit(bytes *b)
{
    int f = below(b, c.faces), start = 0, size = c.faces ? c.face_sizes[f] : 0;
    for (int i = 0; i < f; i++) start += c.face_sizes[i];
    int *v = c.face_vertices + start;
    switch (size ? below(b, 4) : 4) {
    case 0:
        v[below(b, size)] = below(b, c.vertices);
        break;
    case 1:
        for (int i = 0, j = size - 1; i < j; i++, j--) {
            int vertex = v[i];
            v[i] = v[j];
            v[j] = vertex;
        }
        break;
    case 2:
        add_face(size, v);
        break;
    case 3:
        c.sum -= c.face_sizes[--c.faces];
    }
}

static float a_sharpness(bytes *b)
{
    static const float usual[] = { 1, 2, 10, 0.5f, 2.75f, 9.99f, 11, 0, -1, 1e9f };
    int i = below(b, 12);
    float s = i < 10 ? usual[i] : any_float(b);
    return s == s || wild ? s : 1;
}

static void add_tags(bytes *b)
{
    for (c.creases = c.sum ? below(b, TAGS) : 0; c.mesh.crease_count < c.creases; ) {
        int i = c.mesh.crease_count++, at = below(b, c.sum - 1);
        c.crease_vertices[2 * i] = c.face_vertices[at];
        c.crease_vertices[2 * i + 1] = c.face_vertices[at + 1];
        c.crease_sharpness[i] = a_sharpness(b);
    }
    for (c.corners = below(b, 4); c.mesh.corner_count < c.corners; c.mesh.corner_count++) {
        c.corner_vertices[c.mesh.corner_count] = below(b, c.vertices);
        c.corner_sharpness[c.mesh.corner_count] = a_sharpness(b);
    }
    for (c.holes = c.faces ? below(b, 4) : 0; c.mesh.hole_count < c.holes; c.mesh.hole_count++)
        c.hole[c.mesh.hole_count] = below(b, c.faces);
}

// UVs like the vertices, with some edited; or any at all, with or without gaps.
static void add_uvs(bytes *b)
{
    int kind = below(b, 4), gaps = below(b, 2);
    if (!kind) return;
    c.mesh.uv_count = c.uvs = VERTICES + below(b, UVS - VERTICES);
    for (int i = 0; i < c.sum; i++)
        c.face_uvs[i] = kind < 3 ? c.face_vertices[i] : below(b, c.uvs + gaps) - gaps;
    for (int i = kind == 2 && c.sum ? below(b, 16) : 0; i > 0; i--)
        c.face_uvs[below(b, c.sum)] = below(b, c.uvs + gaps) - gaps;
    for (int i = 0; i < 2 * c.uvs; i++) c.uv[i] = (float)(i * i % 37) / 37;
}

static void add_statements(bytes *b)
{
    static char texts[8][12] = { "g a", "usemtl b c", "s 1", "s off", "o", "mtllib \\", "s 2",
                                 "sx" };
    for (c.statements = below(b, STATEMENTS + 1); c.mesh.statement_count < c.statements; ) {
        int i = c.mesh.statement_count++, last = i ? c.statement_faces[i - 1] : 0;
        c.statement_faces[i] = last + below(b, c.faces - last + 1);
        c.statement[i] = texts[below(b, 7 + wild)];
    }
}

static float any_finite(bytes *b)
{
    float x = any_float(b);
    return x - x == 0 ? x : 1;
}

static void add_values(bytes *b)
{
    static const float scales[] = { 1, 1, 1, 1e-30f, 3e37f, 1, 1, 1 };
    int kind = below(b, 8), colors = below(b, 2);
    for (int i = 0; i < 3 * c.vertices; i++) {
        float x = (float)(i * i % 29) / 8 + (float)(take(b) - 128) / 64;
        c.positions[i] = kind == 7 ? any_finite(b) : scales[kind] * x + (kind == 6 ? 1e5f : 0);
        c.colors[i] = x;
        c.normals[i] = i % 3 == 1;
    }
    if (colors) c.mesh.colors = c.colors;
    if (below(b, 2)) c.mesh.normals = c.normals;
}

// Averages at regular vertices as the standard does not: weights of bytes, which sum to 1.
static void own_weights(void *user, int valence, double weights[3])
{
    const double *w = (const double *)user;
    REQUIRE(user == weights_of_rule && valence > 0);
    REQUIRE(weights[0] == 0 && weights[1] == 0 && weights[2] == 0);
    weights[1] = w[0] / valence;
    weights[2] = c.mesh.scheme == SUBDIV_LOOP ? 0 : w[1] / valence;
    weights[0] = 1 - weights[1] - weights[2];
}

static void set_rules(bytes *b)
{
    subdiv_mesh *m = &c.mesh;
    m->boundary = (subdiv_boundary)below(b, 3);
    m->creasing = (subdiv_creasing)below(b, 2);
    m->triangles = (subdiv_triangles)below(b, 2);
    m->uv_rule = (subdiv_uv_rule)below(b, 6);
    if (below(b, 4) == 3) m->vertex_rule = (subdiv_vertex_rule)below(b, 5);
    if (below(b, 8) != 7) return;
    weights_of_rule[0] = (double)below(b, 64) / 16;
    weights_of_rule[1] = (double)below(b, 64) / 16;
    m->vertex_weights = own_weights;
    m->vertex_user = weights_of_rule;
}

// Breaks one thing. A count that is larger than its array would be a lie, not an error.
static void poke(bytes *b)
{
    subdiv_mesh *m = &c.mesh;
    int *counts[] = { &m->vertex_count, &m->face_count, &m->crease_count, &m->corner_count,
                      &m->hole_count, &m->uv_count, &m->statement_count, &m->face_size };
    int *indices[] = { m->face_vertices, m->face_uvs, m->crease_vertices, m->corner_vertices,
                       m->holes, m->statement_faces, m->face_sizes };
    float *numbers[] = { m->positions, m->uvs, m->colors, m->normals, m->crease_sharpness };
    float *number;
    int i, *index;
    switch (below(b, 6)) {
    case 0:
        i = below(b, 8);
        *counts[i] = below(b, 2) ? below(b, *counts[i]) : -1 - take(b);
        break;
    case 1: case 2:
        i = below(b, 7);
        if (!indices[i]) break;
        index = &indices[i][below(b, i < 2 ? c.sum : i == 6 ? c.faces : 4)];
        *index = i == 6 && below(b, 2) ? below(b, *index) : i == 6 ? -1 - take(b) : any_int(b);
        break;
    case 3:
        i = below(b, 5);
        if (!numbers[i]) break;
        number = &numbers[i][below(b, i < 1 ? 3 * c.vertices : 4)];
        *number = any_float(b);
        // Larger UVs and colours may give what is not finite.
        if ((i == 1 || i == 2) && fabsf(*number) <= FLT_MAX) *number /= 4096;
        break;
    case 4:
        i = below(b, 6);
        if (i == 0) m->scheme = (subdiv_scheme)any_int(b);
        if (i == 1) m->boundary = (subdiv_boundary)any_int(b);
        if (i == 2) m->creasing = (subdiv_creasing)any_int(b);
        if (i == 3) m->triangles = (subdiv_triangles)any_int(b);
        if (i == 4) m->uv_rule = (subdiv_uv_rule)any_int(b);
        if (i == 5) m->vertex_rule = (subdiv_vertex_rule)any_int(b);
        break;
    default:
        i = below(b, 8);
        if (i == 0) m->positions = NULL;
        if (i == 1) m->face_vertices = NULL;
        if (i == 2) m->face_sizes = NULL;
        if (i == 3) m->crease_sharpness = NULL;
        if (i == 4) m->corner_vertices = NULL;
        if (i == 5) m->holes = NULL;
        if (i == 6) m->face_uvs = NULL;
        if (i == 7) m->statements = NULL;
    }
}

static void make_cage(bytes *b)
{
    subdiv_mesh *m = &c.mesh;
    memset(&c, 0, sizeof c);
    m->scheme = (subdiv_scheme)below(b, 3);
    int shape = below(b, 5), triangles = m->scheme == SUBDIV_LOOP && !chance(b, 8);
    if (shape == 0) add_grid(b, triangles);
    else if (shape == 1) add_fan(b, triangles);
    else if (shape == 2) add_prism(b, triangles);
    else add_soup(b, triangles);
    for (int edits = below(b, 4); edits > 0; edits--) edit(b);
    if (chance(b, 4) && c.vertices < VERTICES) c.vertices++;            // one without faces
    set_rules(b);
    add_tags(b);
    add_uvs(b);
    add_statements(b);
    add_values(b);
    int sizes = 0;
    for (int f = 0; f < c.faces; f++) sizes |= c.face_sizes[f] != c.face_sizes[0];
    m->vertex_count = c.vertices;
    m->face_count = c.faces;
    m->face_size = sizes || chance(b, 8) ? 0 : c.face_sizes[0];
    m->positions = c.positions;
    m->face_sizes = c.face_sizes;
    m->face_vertices = c.face_vertices;
    m->crease_vertices = c.crease_vertices;
    m->crease_sharpness = c.crease_sharpness;
    m->corner_vertices = c.corner_vertices;
    m->corner_sharpness = c.corner_sharpness;
    m->holes = c.hole;
    m->uvs = c.uv;
    m->face_uvs = c.face_uvs;
    m->statement_faces = c.statement_faces;
    m->statements = c.statement;
    for (int pokes = wild ? 1 + below(b, 3) : 0; pokes > 0; pokes--) poke(b);
}

#define ARRAYS(DO)                                                                          \
    DO(positions, 3 * c.vertices) DO(colors, 3 * c.vertices) DO(normals, 3 * c.vertices)    \
    DO(face_sizes, c.faces) DO(face_vertices, c.sum) DO(face_uvs, c.sum)                    \
    DO(crease_vertices, 2 * c.creases) DO(crease_sharpness, c.creases)                      \
    DO(corner_vertices, c.corners) DO(corner_sharpness, c.corners) DO(holes, c.holes)       \
    DO(uvs, 2 * c.uvs) DO(statement_faces, c.statements) DO(statements, c.statements)

static void lend(void)
{
    lent = c.mesh;
#define LEND(name, count) lent.name = copy_of(c.mesh.name, (size_t)(count), sizeof *lent.name);
    ARRAYS(LEND)
}

// Inputs are as they were.
static void take_back(void)
{
#define COMPARE(name, count)                                                                \
    if (lent.name) REQUIRE(same_bytes(lent.name, c.mesh.name, count, sizeof *lent.name));   \
    free(lent.name);                                                                        \
    lent.name = c.mesh.name;
    ARRAYS(COMPARE)
    REQUIRE(memcmp(&lent, &c.mesh, sizeof lent) == 0);
}

#endif
