// Small random cages with everything that can be odd about a cage. The same seed and features give
// the same cage. A cage starts as one or two simple shapes, is edited a few times, gets its
// creases, corners and holes, and is renumbered at random.
#ifndef RANDOM_CAGE_H
#define RANDOM_CAGE_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "subdiv.h"

// What a cage may have. Each seed picks some of what is allowed.
enum {
    RANDOM_NGONS       = 1,           // faces other than quads, vertices of valence 2, poles
    RANDOM_BOUNDARIES  = 2,
    RANDOM_CREASES     = 4,
    RANDOM_CORNERS     = 8,
    RANDOM_HOLES       = 16,
    RANDOM_RULES       = 32,          // boundary, creasing and triangle rules other than 0
    RANDOM_LOOP        = 64,          // some cages are of triangles, for Loop
    RANDOM_BILINEAR    = 128,         // some cages are bilinear
    RANDOM_MANIFOLD    = 255,         // all of the above: every edge and vertex is manifold
    RANDOM_NONMANIFOLD = 256,         // fins, shared vertices, flipped and duplicate faces
    RANDOM_DEGENERATE  = 512,         // repeated vertices, isolated ones, creases without an edge
    RANDOM_UVS         = 1024,        // UVs with seams, any rule
    RANDOM_ALL         = 2047,
    RANDOM_LONG_SEAMS  = 2048         // besides all: UVs cut along planes
};

enum {
    RANDOM_MAX_VERTICES = 320,
    RANDOM_MAX_FACES    = 512,
    RANDOM_MAX_EDITED   = 60,         // faces; cutting them into triangles can make it more
    RANDOM_MAX_SIZE     = 8,          // vertices of a face
    RANDOM_MAX_EDGES    = 2048,
    RANDOM_MAX_CREASES  = 512,
    RANDOM_MAX_CORNERS  = 32,
    RANDOM_MAX_HOLES    = 16,
    RANDOM_MAX_UVS      = RANDOM_MAX_FACES * RANDOM_MAX_SIZE
};

typedef struct random_edge {
    int a, b, face_count;
} random_edge;

typedef struct random_cage {
    subdiv_mesh mesh;                 // the cage; its arrays are those below
    float positions[3 * RANDOM_MAX_VERTICES];
    int   face_sizes[RANDOM_MAX_FACES];
    int   face_vertices[RANDOM_MAX_FACES * RANDOM_MAX_SIZE];
    int   crease_vertices[2 * RANDOM_MAX_CREASES];
    float crease_sharpness[RANDOM_MAX_CREASES];
    int   corner_vertices[RANDOM_MAX_CORNERS];
    float corner_sharpness[RANDOM_MAX_CORNERS];
    int   holes[RANDOM_MAX_HOLES];
    float uvs[2 * RANDOM_MAX_UVS];
    int   face_uvs[RANDOM_MAX_FACES * RANDOM_MAX_SIZE];

    const unsigned char *bytes, *end; // what decides, before the generator does
    unsigned long long state;         // of the generator; the rest is the cage while it is made
    int features;
    int vertex_count, face_count;
    int overflow;                     // an edit met a limit and will be undone
    int faces[RANDOM_MAX_FACES][RANDOM_MAX_SIZE];
    int edge_count;
    random_edge edges[RANDOM_MAX_EDGES];
} random_cage;

// ---------------------------------------------------------------------------- Random numbers

// splitmix64, the usual generator with one word of state.
static inline unsigned random_bits(random_cage *c)
{
    unsigned long long z = (c->state += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return (unsigned)((z ^ (z >> 31)) >> 32);
}

// 0 <= result < n
static inline int random_below(random_cage *c, int n)
{
    unsigned bits = 0;
    if (c->end - c->bytes < 2) return (int)(random_bits(c) % (unsigned)n);
    if (n > 256) bits = 256u * *c->bytes++;
    return (int)((bits + *c->bytes++) % (unsigned)n);
}

static inline int random_chance(random_cage *c, int percent)
{
    return random_below(c, 100) < percent;
}

static inline float random_real(random_cage *c, float low, float high)
{
    return low + (high - low) * ((float)(random_bits(c) >> 8) / 16777216.0f);
}

// Every way in which sharpness is special: fractions, whole levels, forever and beyond.
static inline float random_sharpness(random_cage *c)
{
    switch (random_below(c, 8)) {
    case 0:  return random_real(c, 0.01f, 1);
    case 1:  return random_real(c, 0, 4);
    case 2:  return (float)(1 + random_below(c, 4));
    case 3:  return 0.25f * (float)random_below(c, 13);
    case 4:  return random_real(c, 4, 9.99f);
    case 5:  return random_real(c, 10, 100);
    default: return SUBDIV_INFINITE;
    }
}

// ------------------------------------------------------------------------- Vertices and faces

static inline int random_add_vertex(random_cage *c, float x, float y, float z)
{
    if (c->vertex_count == RANDOM_MAX_VERTICES) {
        c->overflow = 1;
        return 0;
    }
    float *p = &c->positions[3 * c->vertex_count];
    p[0] = x + random_real(c, -0.2f, 0.2f);
    p[1] = y + random_real(c, -0.2f, 0.2f);
    p[2] = z + random_real(c, -0.2f, 0.2f);
    return c->vertex_count++;
}

static inline int random_add_face(random_cage *c, int size, const int *vertices)
{
    if (c->face_count == RANDOM_MAX_FACES || size > RANDOM_MAX_SIZE) {
        c->overflow = 1;
        return 0;
    }
    c->face_sizes[c->face_count] = size;
    memcpy(c->faces[c->face_count], vertices, sizeof(int) * (size_t)size);
    return c->face_count++;
}

static inline void random_add_triangle(random_cage *c, int a, int b, int d)
{
    const int v[3] = { a, b, d };
    random_add_face(c, 3, v);
}

static inline void random_add_quad(random_cage *c, int a, int b, int d, int e)
{
    const int v[4] = { a, b, d, e };
    random_add_face(c, 4, v);
}

// The order of the faces is of no use here, so the last one fills the gap.
static inline void random_remove_face(random_cage *c, int f)
{
    const int last = --c->face_count;
    c->face_sizes[f] = c->face_sizes[last];
    memcpy(c->faces[f], c->faces[last], sizeof c->faces[f]);
}

// The vertex i places after the first; i may be as low as -size.
static inline int random_at(const random_cage *c, int f, int i)
{
    const int size = c->face_sizes[f];
    return c->faces[f][(i + size) % size];
}

static inline int random_find_in_face(const random_cage *c, int f, int v)
{
    for (int i = 0; i < c->face_sizes[f]; i++)
        if (c->faces[f][i] == v) return i;
    return -1;
}

// A vertex near the middle of a face, moved a little toward z.
static inline int random_add_centre(random_cage *c, int f)
{
    float p[3] = { 0, 0, 0 };
    const int size = c->face_sizes[f];
    for (int i = 0; i < size; i++)
        for (int k = 0; k < 3; k++) p[k] += c->positions[3 * c->faces[f][i] + k] / (float)size;
    return random_add_vertex(c, p[0], p[1], p[2] + 0.2f);
}

// The face that uses the edge a b in this direction, other than skip; or -1.
static inline int random_face_with(const random_cage *c, int a, int b, int skip)
{
    for (int f = 0; f < c->face_count; f++)
        for (int i = 0; i < c->face_sizes[f] && f != skip; i++)
            if (c->faces[f][i] == a && random_at(c, f, i + 1) == b) return f;
    return -1;
}

static inline void random_list_edges(random_cage *c)
{
    c->edge_count = 0;
    for (int f = 0; f < c->face_count; f++) {
        for (int i = 0; i < c->face_sizes[f]; i++) {
            const int v = c->faces[f][i], w = random_at(c, f, i + 1);
            const int a = v < w ? v : w, b = v < w ? w : v;
            int e = 0;
            while (e < c->edge_count && (c->edges[e].a != a || c->edges[e].b != b)) e++;
            if (e == RANDOM_MAX_EDGES) return;
            if (e == c->edge_count) {
                const random_edge edge = { a, b, 0 };
                c->edges[c->edge_count++] = edge;
            }
            c->edges[e].face_count++;
        }
    }
}

// ------------------------------------------------------------------------------ Is it manifold

// Does a walk from face to face around v, against the clock, meet all its faces?
static inline int random_is_one_fan(const random_cage *c, int v)
{
    int count = 0, start = -1, f, met = 0;
    for (f = 0; f < c->face_count; f++) {
        const int i = random_find_in_face(c, f, v);
        if (i < 0) continue;
        count++;
        if (start < 0 || random_face_with(c, random_at(c, f, i + 1), v, -1) < 0) start = f;
    }
    for (f = start; f >= 0; ) {
        const int before = random_at(c, f, random_find_in_face(c, f, v) - 1);
        met++;
        f = random_face_with(c, v, before, -1);
        if (f == start) break;
    }
    return met == count;
}

static inline int random_is_manifold(const random_cage *c)
{
    for (int f = 0; f < c->face_count; f++) {
        for (int i = 0; i < c->face_sizes[f]; i++) {
            const int v = c->faces[f][i];
            if (random_find_in_face(c, f, v) != i) return 0;
            if (random_face_with(c, v, random_at(c, f, i + 1), f) >= 0) return 0;
        }
    }
    for (int v = 0; v < c->vertex_count; v++)
        if (!random_is_one_fan(c, v)) return 0;
    return 1;
}

// -------------------------------------------------------------------------------------- Shapes

// k vertices around the z axis; returns the first.
static inline int random_ring(random_cage *c, int k, float radius, float z)
{
    const int first = c->vertex_count;
    for (int i = 0; i < k; i++) {
        const double angle = 6.283185307179586 * i / k;
        random_add_vertex(c, radius * (float)cos(angle), radius * (float)sin(angle), z);
    }
    return first;
}

static inline void random_shape_grid(random_cage *c)
{
    const int w = 1 + random_below(c, 6), h = 1 + random_below(c, 5), first = c->vertex_count;
    for (int y = 0; y <= h; y++)
        for (int x = 0; x <= w; x++) random_add_vertex(c, (float)x - 2, (float)y - 2, 0);
    for (int y = 0; y < h; y++) {
        for (int x = 0; x < w; x++) {
            const int v = first + y * (w + 1) + x;
            random_add_quad(c, v, v + 1, v + w + 2, v + w + 1);
        }
    }
}

static inline void random_shape_torus(random_cage *c)
{
    const int w = 3 + random_below(c, 5), h = 3 + random_below(c, 3), first = c->vertex_count;
    for (int y = 0; y < h; y++) {
        const double angle = 6.283185307179586 * y / h;
        random_ring(c, w, 2 + (float)cos(angle), (float)sin(angle));
    }
    for (int y = 0; y < h; y++) {
        for (int x = 0; x < w; x++) {
            const int right = (x + 1) % w, row = first + y * w, above = first + (y + 1) % h * w;
            random_add_quad(c, row + x, row + right, above + right, above + x);
        }
    }
}

// Two poles of valence k with k quads each: a cube when k is 3.
static inline void random_shape_trapezohedron(random_cage *c)
{
    const int k = random_chance(c, 50) ? 3 : 4 + random_below(c, 17);
    const int ring = random_ring(c, 2 * k, 1.5f, 0);
    const int top = random_add_vertex(c, 0, 0, 1.5f), bottom = random_add_vertex(c, 0, 0, -1.5f);
    for (int i = 0; i < k; i++) {
        const int left = ring + 2 * i, middle = left + 1, right = ring + (2 * i + 2) % (2 * k);
        const int next = ring + (2 * i + 3) % (2 * k);
        random_add_quad(c, top, left, middle, right);
        random_add_quad(c, bottom, next, right, middle);
    }
}

static inline void random_shape_prism(random_cage *c)
{
    const int k = 3 + random_below(c, 6);
    const int low = random_ring(c, k, 1, -1), high = random_ring(c, k, 1, 1);
    int top[RANDOM_MAX_SIZE], bottom[RANDOM_MAX_SIZE];
    for (int i = 0; i < k; i++) {
        const int next = (i + 1) % k;
        random_add_quad(c, low + i, low + next, high + next, high + i);
        top[i] = high + i;
        bottom[i] = low + k - 1 - i;
    }
    random_add_face(c, k, top);
    random_add_face(c, k, bottom);
}

// Two poles of triangles: a tetrahedron's cousin at 3, an octahedron at 4.
static inline void random_shape_bipyramid(random_cage *c)
{
    const int k = random_chance(c, 60) ? 3 + random_below(c, 4) : 7 + random_below(c, 20);
    const int ring = random_ring(c, k, 1.5f, 0);
    const int top = random_add_vertex(c, 0, 0, 1.5f), bottom = random_add_vertex(c, 0, 0, -1.5f);
    for (int i = 0; i < k; i++) {
        const int a = ring + i, b = ring + (i + 1) % k;
        random_add_triangle(c, a, b, top);
        random_add_triangle(c, b, a, bottom);
    }
}

// A polygon and its back: every vertex has valence 2.
static inline void random_shape_pillow(random_cage *c)
{
    const int k = 3 + random_below(c, 4), ring = random_ring(c, k, 1.5f, 0);
    int front[RANDOM_MAX_SIZE], back[RANDOM_MAX_SIZE];
    for (int i = 0; i < k; i++) {
        front[i] = ring + i;
        back[i] = ring + k - 1 - i;
    }
    random_add_face(c, k, front);
    random_add_face(c, k, back);
}

// -------------------------------------------------------------------------------------- Edits

static inline void random_edit_remove(random_cage *c)
{
    if (c->face_count > 1) random_remove_face(c, random_below(c, c->face_count));
}

// Cuts a face in two along a diagonal.
static inline void random_edit_split(random_cage *c)
{
    const int f = random_below(c, c->face_count), size = c->face_sizes[f];
    if (size < 4) return;
    const int start = random_below(c, size), part = 3 + random_below(c, size - 3);
    int one[RANDOM_MAX_SIZE], two[RANDOM_MAX_SIZE];
    for (int i = 0; i < part; i++) one[i] = random_at(c, f, (start + i) % size);
    for (int i = 0; i < size - part + 2; i++)
        two[i] = random_at(c, f, (start + part - 1 + i) % size);
    random_remove_face(c, f);
    random_add_face(c, part, one);
    random_add_face(c, size - part + 2, two);
}

// Makes two faces that share an edge one.
static inline void random_edit_merge(random_cage *c)
{
    const int f = random_below(c, c->face_count), i = random_below(c, c->face_sizes[f]);
    const int a = random_at(c, f, i), b = random_at(c, f, i + 1);
    const int g = random_face_with(c, b, a, f);
    if (g < 0 || c->face_sizes[f] + c->face_sizes[g] - 2 > RANDOM_MAX_SIZE) return;
    const int j = random_find_in_face(c, g, a);
    int v[2 * RANDOM_MAX_SIZE], size = 0;
    const int one = c->face_sizes[f], two = c->face_sizes[g];
    for (int k = 1; k < one; k++) v[size++] = random_at(c, f, (i + k) % one);
    for (int k = 0; k < two - 1; k++) v[size++] = random_at(c, g, (j + k) % two);
    for (int k = 0; k < size; k++)
        for (int m = 0; m < k; m++) if (v[k] == v[m]) return;
    random_remove_face(c, f > g ? f : g);
    random_remove_face(c, f > g ? g : f);
    random_add_face(c, size, v);
}

// Replaces face f by triangles to a new vertex.
static inline void random_cut_to_centre(random_cage *c, int f)
{
    const int size = c->face_sizes[f], centre = random_add_centre(c, f);
    int v[RANDOM_MAX_SIZE];
    memcpy(v, c->faces[f], sizeof v);
    random_remove_face(c, f);
    for (int i = 0; i < size; i++) random_add_triangle(c, v[i], v[(i + 1) % size], centre);
}

static inline void random_edit_centre(random_cage *c)
{
    random_cut_to_centre(c, random_below(c, c->face_count));
}

// Surrounds a smaller copy of a face with quads.
static inline void random_edit_inset(random_cage *c)
{
    const int f = random_below(c, c->face_count), size = c->face_sizes[f];
    const int centre = random_add_centre(c, f);
    int v[RANDOM_MAX_SIZE], inner[RANDOM_MAX_SIZE];
    memcpy(v, c->faces[f], sizeof v);
    for (int i = 0; i < size; i++) {
        const float *p = &c->positions[3 * v[i]], *q = &c->positions[3 * centre];
        inner[i] = random_add_vertex(c, (p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2);
    }
    random_remove_face(c, f);
    random_add_face(c, size, inner);
    for (int i = 0; i < size; i++) {
        const int next = (i + 1) % size;
        random_add_quad(c, v[i], v[next], inner[next], inner[i]);
    }
}

// Puts a vertex of valence 2 on an edge, in all its faces.
static inline void random_edit_split_edge(random_cage *c)
{
    const int f = random_below(c, c->face_count), i = random_below(c, c->face_sizes[f]);
    const int a = random_at(c, f, i), b = random_at(c, f, i + 1);
    const float *p = &c->positions[3 * a], *q = &c->positions[3 * b];
    const int middle = random_add_vertex(c, (p[0] + q[0]) / 2, (p[1] + q[1]) / 2,
                                         (p[2] + q[2]) / 2);
    for (int g = 0; g < c->face_count; g++) {
        for (int k = 0; k < c->face_sizes[g]; k++) {
            const int v = c->faces[g][k], w = random_at(c, g, k + 1);
            if (!(v == a && w == b) && !(v == b && w == a)) continue;
            if (c->face_sizes[g] == RANDOM_MAX_SIZE) {
                c->overflow = 1;
                return;
            }
            for (int m = c->face_sizes[g]++; m > k + 1; m--) c->faces[g][m] = c->faces[g][m - 1];
            c->faces[g][++k] = middle;
        }
    }
}

// A new face on an edge, in either direction: a fin if the edge has two faces.
static inline void random_edit_fin(random_cage *c)
{
    const int f = random_below(c, c->face_count), i = random_below(c, c->face_sizes[f]);
    const int flip = random_chance(c, 50);
    const int a = random_at(c, f, i + flip), b = random_at(c, f, i + 1 - flip);
    const float *p = &c->positions[3 * a], *q = &c->positions[3 * b];
    const int d = random_chance(c, 25) ? random_below(c, c->vertex_count)
                                       : random_add_vertex(c, p[0], p[1] + 0.5f, p[2] + 1);
    const int e = random_add_vertex(c, q[0], q[1] + 0.5f, q[2] + 1);
    if (d == a || d == b) return;
    if ((c->features & RANDOM_NGONS) && random_chance(c, 30)) random_add_triangle(c, b, a, d);
    else random_add_quad(c, b, a, d, e);
}

// A new face that touches the others at a single vertex.
static inline void random_edit_touch(random_cage *c)
{
    const int v = random_below(c, c->vertex_count);
    const float *p = &c->positions[3 * v];
    const int a = random_add_vertex(c, p[0] + 1, p[1], p[2] + 1);
    const int b = random_add_vertex(c, p[0] + 1, p[1] + 1, p[2] + 1);
    const int d = random_add_vertex(c, p[0], p[1] + 1, p[2] + 1);
    random_add_quad(c, v, a, b, d);
}

// Makes two vertices without a common face one.
static inline void random_edit_weld(random_cage *c)
{
    const int a = random_below(c, c->vertex_count), b = random_below(c, c->vertex_count);
    for (int f = 0; f < c->face_count; f++)
        if (random_find_in_face(c, f, a) >= 0 && random_find_in_face(c, f, b) >= 0) return;
    for (int f = 0; f < c->face_count; f++)
        for (int i = 0; i < c->face_sizes[f]; i++)
            if (c->faces[f][i] == b) c->faces[f][i] = a;
}

static inline void random_edit_flip(random_cage *c)
{
    const int f = random_below(c, c->face_count);
    for (int i = 0, j = c->face_sizes[f] - 1; i < j; i++, j--) {
        const int v = c->faces[f][i];
        c->faces[f][i] = c->faces[f][j];
        c->faces[f][j] = v;
    }
}

static inline void random_edit_duplicate(random_cage *c)
{
    const int f = random_below(c, c->face_count);
    random_add_face(c, c->face_sizes[f], c->faces[f]);
}

// Writes one vertex of a face over another, next to it or not.
static inline void random_edit_repeat(random_cage *c)
{
    const int f = random_below(c, c->face_count), size = c->face_sizes[f];
    const int from = random_below(c, size), to = random_below(c, size);
    c->faces[f][to] = c->faces[f][from];
}

typedef struct random_edit {
    int needs, weight;
    void (*edit)(random_cage *c);
} random_edit;

// One edit among those that the features allow.
static inline void random_do_edit(random_cage *c)
{
    const random_edit edits[] = {
        { RANDOM_BOUNDARIES,                      4, random_edit_remove },
        { RANDOM_NGONS,                           4, random_edit_split },
        { RANDOM_NGONS,                           4, random_edit_merge },
        { RANDOM_NGONS,                           2, random_edit_centre },
        { 0,                                      2, random_edit_inset },
        { RANDOM_NGONS,                           2, random_edit_split_edge },
        { RANDOM_NONMANIFOLD | RANDOM_BOUNDARIES, 3, random_edit_fin },
        { RANDOM_NONMANIFOLD | RANDOM_BOUNDARIES, 1, random_edit_touch },
        { RANDOM_NONMANIFOLD,                     2, random_edit_weld },
        { RANDOM_NONMANIFOLD,                     2, random_edit_flip },
        { RANDOM_NONMANIFOLD,                     1, random_edit_duplicate },
        { RANDOM_DEGENERATE,                      1, random_edit_repeat }
    };
    const int count = (int)(sizeof edits / sizeof edits[0]);
    int total = 0, pick, i = 0;
    for (int k = 0; k < count; k++)
        if ((edits[k].needs & c->features) == edits[k].needs) total += edits[k].weight;
    pick = random_below(c, total);
    for (;; i++) {
        if ((edits[i].needs & c->features) != edits[i].needs) continue;
        pick -= edits[i].weight;
        if (pick < 0) break;
    }
    edits[i].edit(c);
}

// Is the cage still one that was asked for?
static inline int random_is_allowed(const random_cage *c)
{
    const int odd = RANDOM_NONMANIFOLD | RANDOM_DEGENERATE;
    return !c->overflow && ((c->features & odd) || random_is_manifold(c));
}

static inline void random_undo(random_cage *c, const random_cage *before)
{
    const unsigned long long state = c->state;
    const unsigned char *bytes = c->bytes;
    *c = *before;
    c->state = state;
    c->bytes = bytes;
}

static inline void random_edit_some(random_cage *c, random_cage *before)
{
    for (int count = random_below(c, 9); count > 0; count--) {
        *before = *c;
        random_do_edit(c);
        if (!random_is_allowed(c) || c->face_count > RANDOM_MAX_EDITED) random_undo(c, before);
    }
}

// Cuts the faces into triangles: as a fan, or to a centre where a fan would not be allowed.
static inline void random_triangulate(random_cage *c, random_cage *before)
{
    for (int f = 0; f < c->face_count; ) {
        const int size = c->face_sizes[f], start = random_below(c, size);
        int v[RANDOM_MAX_SIZE];
        if (size == 3) {
            f++;
            continue;
        }
        for (int i = 0; i < size; i++) v[i] = random_at(c, f, (start + i) % size);
        *before = *c;
        random_remove_face(c, f);
        for (int i = 2; i < size; i++) random_add_triangle(c, v[0], v[i - 1], v[i]);
        if (random_is_allowed(c)) continue;
        random_undo(c, before);
        random_cut_to_centre(c, f);
    }
}

// ------------------------------------------------------------------------- Sharpness and holes

static inline void random_add_crease(random_cage *c, int a, int b, float sharpness)
{
    const int i = c->mesh.crease_count;
    if (i == RANDOM_MAX_CREASES || a == b) return;
    const int turn = random_chance(c, 50);
    c->crease_vertices[2 * i] = turn ? b : a;
    c->crease_vertices[2 * i + 1] = turn ? a : b;
    c->crease_sharpness[i] = sharpness;
    c->mesh.crease_count++;
}

// A crease from edge to edge: it ends in darts, crosses itself or others, or closes.
static inline void random_crease_walk(random_cage *c, int same)
{
    float sharpness = random_sharpness(c);
    int e = random_below(c, c->edge_count), at = c->edges[e].b;
    for (int length = 1 + random_below(c, 10); length > 0; length--) {
        random_add_crease(c, c->edges[e].a, c->edges[e].b, sharpness);
        if (!same) sharpness = random_sharpness(c);
        const int start = random_below(c, c->edge_count), from = e;
        for (int k = 0; k < c->edge_count; k++) {
            e = (start + k) % c->edge_count;
            if (e != from && (c->edges[e].a == at || c->edges[e].b == at)) break;
        }
        at = c->edges[e].a + c->edges[e].b - at;
        if (c->edges[e].a != at && c->edges[e].b != at) return;
    }
}

// All edges of a face.
static inline void random_crease_loop(random_cage *c, int same)
{
    const int f = random_below(c, c->face_count);
    float sharpness = random_sharpness(c);
    for (int i = 0; i < c->face_sizes[f]; i++) {
        random_add_crease(c, c->faces[f][i], random_at(c, f, i + 1), sharpness);
        if (!same) sharpness = random_sharpness(c);
    }
}

// Most edges at a vertex.
static inline void random_crease_star(random_cage *c, int same)
{
    const int v = c->faces[random_below(c, c->face_count)][0];
    float sharpness = random_sharpness(c);
    for (int e = 0; e < c->edge_count; e++) {
        if ((c->edges[e].a != v && c->edges[e].b != v) || random_chance(c, 30)) continue;
        random_add_crease(c, c->edges[e].a, c->edges[e].b, sharpness);
        if (!same) sharpness = random_sharpness(c);
    }
}

// Edges of the boundary, mostly forever: what makes the rule NONE keep the faces there.
static inline void random_crease_boundary(random_cage *c, int same)
{
    const int percent = random_chance(c, 30) ? 100 : 60;
    for (int e = 0; e < c->edge_count; e++) {
        if (c->edges[e].face_count != 1 || !random_chance(c, percent)) continue;
        const int forever = same || random_chance(c, 70);
        random_add_crease(c, c->edges[e].a, c->edges[e].b,
                          forever ? SUBDIV_INFINITE : random_sharpness(c));
    }
}

static inline void random_crease_scatter(random_cage *c, int same)
{
    const int percent = random_chance(c, 20) ? 100 : 5 + random_below(c, 40);
    const float sharpness = random_sharpness(c);
    for (int e = 0; e < c->edge_count; e++)
        if (random_chance(c, percent))
            random_add_crease(c, c->edges[e].a, c->edges[e].b,
                              same ? sharpness : random_sharpness(c));
}

static inline void random_add_creases(random_cage *c)
{
    void (*const patterns[])(random_cage *, int) = {
        random_crease_walk, random_crease_walk, random_crease_loop, random_crease_star,
        random_crease_boundary, random_crease_scatter
    };
    const int pattern_count = (int)(sizeof patterns / sizeof patterns[0]);
    int count = random_below(c, 4);
    for (count += random_below(c, 2); count > 0; count--) {
        const int pattern = random_below(c, pattern_count);
        patterns[pattern](c, random_chance(c, 50));
    }
}

static inline void random_add_corners(random_cage *c)
{
    for (int count = random_below(c, 6); count > 0; count--) {
        const int i = c->mesh.corner_count++;
        c->corner_vertices[i] = random_below(c, c->vertex_count);
        c->corner_sharpness[i] = random_sharpness(c);
    }
}

static inline void random_add_holes(random_cage *c)
{
    for (int count = random_below(c, 5); count > 0; count--)
        c->holes[c->mesh.hole_count++] = random_below(c, c->face_count);
}

// ------------------------------------------------------------------------------- Renumbering

// Numbers the vertices in use at random, and a few isolated ones if they are allowed.
static inline void random_renumber_vertices(random_cage *c, random_cage *before)
{
    int numbers[RANDOM_MAX_VERTICES], used[RANDOM_MAX_VERTICES] = { 0 }, count = 0;
    if ((c->features & RANDOM_DEGENERATE) && random_chance(c, 50))
        for (int k = random_below(c, 4); k > 0; k--) used[random_add_vertex(c, 1, 1, 1)] = 1;
    *before = *c;
    for (int f = 0; f < c->face_count; f++)
        for (int i = 0; i < c->face_sizes[f]; i++) used[c->faces[f][i]] = 1;
    for (int v = 0; v < c->vertex_count; v++)
        if (used[v]) numbers[count++] = v;
    for (int i = count - 1; i > 0; i--) {
        const int j = random_below(c, i + 1), v = numbers[i];
        numbers[i] = numbers[j];
        numbers[j] = v;
    }
    c->vertex_count = count;
    for (int i = 0; i < count; i++) {
        memcpy(&c->positions[3 * i], &before->positions[3 * numbers[i]], 3 * sizeof(float));
        used[numbers[i]] = i;
    }
    for (int f = 0; f < c->face_count; f++)
        for (int i = 0; i < c->face_sizes[f]; i++) c->faces[f][i] = used[c->faces[f][i]];
}

// Shuffles the faces and lets each start at a random vertex.
static inline void random_renumber_faces(random_cage *c, random_cage *before)
{
    *before = *c;
    for (int f = c->face_count - 1; f >= 0; f--) {
        const int from = random_below(c, f + 1), size = before->face_sizes[from];
        const int turn = random_below(c, size);
        for (int i = 0; i < size; i++) c->faces[f][i] = random_at(before, from, (i + turn) % size);
        c->face_sizes[f] = size;
        memcpy(before->faces[from], before->faces[f], sizeof before->faces[from]);
        before->face_sizes[from] = before->face_sizes[f];
    }
}

// Lays the faces out as the mesh wants them; equal sizes are given by face_size half of the time.
static inline void random_fill_mesh(random_cage *c)
{
    int count = 0, equal = 1;
    for (int f = 0; f < c->face_count; f++) {
        const int size = c->face_sizes[f];
        memcpy(&c->face_vertices[count], c->faces[f], sizeof(int) * (size_t)size);
        count += size;
        equal = equal && size == c->face_sizes[0];
    }
    c->mesh.vertex_count = c->vertex_count;
    c->mesh.positions = c->positions;
    c->mesh.face_count = c->face_count;
    c->mesh.face_vertices = c->face_vertices;
    if (equal && random_chance(c, 50)) c->mesh.face_size = c->face_sizes[0];
    else c->mesh.face_sizes = c->face_sizes;
    c->mesh.crease_vertices = c->crease_vertices;
    c->mesh.crease_sharpness = c->crease_sharpness;
    c->mesh.corner_vertices = c->corner_vertices;
    c->mesh.corner_sharpness = c->corner_sharpness;
    c->mesh.holes = c->holes;
}

// ---------------------------------------------------------------------------------------- UVs

// Gives the faces on one side of vertex v, along an axis, values of their own.
static inline void random_cut_uvs(random_cage *c, const int *start, int v, int *count)
{
    const int axis = random_below(c, 3);
    int own[RANDOM_MAX_UVS] = {0};
    for (int f = 0; f < c->face_count; f++) {
        const int first = c->face_vertices[start[f]];
        if (c->positions[3 * first + axis] < c->positions[3 * v + axis]) continue;
        for (int h = start[f]; h < start[f + 1]; h++) {
            int *value = &own[c->face_uvs[h]];
            if (!*value) *value = (*count)++;
            c->face_uvs[h] = *value;
        }
    }
}

// Cuts the UVs open: gives some of the faces a value of their own. Sometimes vertices share one.
static inline void random_add_uvs(random_cage *c)
{
    subdiv_mesh *m = &c->mesh;
    const int long_seams = c->features & RANDOM_LONG_SEAMS;
    const int total = c->vertex_count, many = !long_seams || random_chance(c, 50);
    const int cuts = random_below(c, many ? 2 + c->face_count : 4);
    int count = total, start[RANDOM_MAX_FACES + 1] = {0};
    for (int f = 0; f < c->face_count; f++) start[f + 1] = start[f] + c->face_sizes[f];
    for (int h = 0; h < start[c->face_count]; h++) c->face_uvs[h] = c->face_vertices[h];
    for (int i = 0; i < cuts && count + start[c->face_count] < RANDOM_MAX_UVS; i++) {
        const int f = random_below(c, c->face_count), size = c->face_sizes[f];
        const int h = start[f] + random_below(c, size), side = !many && random_chance(c, 80);
        const int kind = side ? 4 : random_below(c, 4);
        if (kind == 0) {                              // an island
            for (int j = 0; j < size; j++) c->face_uvs[start[f] + j] = count++;
        } else if (kind == 1) {                       // some faces at a vertex
            const int value = c->face_uvs[h];
            for (int g = 0; g < start[c->face_count]; g++)
                if (c->face_uvs[g] == value && random_chance(c, 50)) c->face_uvs[g] = count;
            count++;
        } else if (kind == 2) {                       // one face
            c->face_uvs[h] = count++;
        } else if (kind == 4) {
            random_cut_uvs(c, start, c->face_vertices[h], &count);
        } else if (random_chance(c, 20)) {            // shared by vertices
            c->face_uvs[h] = c->face_uvs[random_below(c, start[c->face_count])];
        }
    }
    for (int i = 0; i < 2 * count; i++) c->uvs[i] = random_real(c, 0, 1);
    m->uv_count = count;
    m->uvs = c->uvs;
    m->face_uvs = c->face_uvs;
    m->uv_rule = (subdiv_uv_rule)random_below(c, 6);
}

// ------------------------------------------------------------------------------------- Making

// Drops some of the allowed features, the odder ones more often.
static inline void random_choose_features(random_cage *c)
{
    const int keep[] = { 70, 70, 75, 50, 25, 75, 30, 10, 30, 15, 60 };
    for (int i = 0; i < 11; i++)
        if (!random_chance(c, keep[i])) c->features &= ~(1 << i);
    if (c->features & RANDOM_LOOP) c->mesh.scheme = SUBDIV_LOOP;
    else if (c->features & RANDOM_BILINEAR) c->mesh.scheme = SUBDIV_BILINEAR;
    if (c->features & RANDOM_RULES) {
        c->mesh.boundary = (subdiv_boundary)random_below(c, 3);
        c->mesh.creasing = (subdiv_creasing)random_below(c, 2);
        c->mesh.triangles = (subdiv_triangles)random_below(c, 2);
    }
}

static inline void random_add_shape(random_cage *c)
{
    const random_edit shapes[] = {
        { RANDOM_BOUNDARIES, 3, random_shape_grid },
        { 0,                 2, random_shape_torus },
        { 0,                 2, random_shape_trapezohedron },
        { RANDOM_NGONS,      3, random_shape_prism },
        { RANDOM_NGONS,      3, random_shape_bipyramid },
        { RANDOM_NGONS,      1, random_shape_pillow }
    };
    for (;;) {
        const random_edit *s = &shapes[random_below(c, 6)];
        if ((s->needs & c->features) != s->needs || random_below(c, 3) >= s->weight) continue;
        s->edit(c);
        return;
    }
}

static inline void random_cage_free(random_cage *c)
{
    free(c);
}

// features: RANDOM_ALL or less. The bytes decide as long as there are two. Returns NULL without
// memory.
static inline random_cage *random_cage_of(unsigned seed, int features, const unsigned char *bytes,
                                          size_t count)
{
    random_cage *c = (random_cage *)calloc(1, sizeof *c);
    random_cage *before = (random_cage *)calloc(1, sizeof *before);
    if (!c || !before) {
        free(c);
        free(before);
        return NULL;
    }
    c->state = seed;
    c->bytes = bytes;
    c->end = bytes + count;
    c->features = features;
    random_choose_features(c);
    random_add_shape(c);
    if (random_chance(c, 15)) random_add_shape(c);
    random_edit_some(c, before);
    if (c->mesh.scheme == SUBDIV_LOOP) random_triangulate(c, before);
    random_renumber_vertices(c, before);
    random_renumber_faces(c, before);

    random_list_edges(c);
    if (c->features & RANDOM_CREASES) random_add_creases(c);
    if (c->features & RANDOM_DEGENERATE) {
        const int b = random_below(c, c->vertex_count), a = random_below(c, c->vertex_count);
        random_add_crease(c, a, b, 2);
    }
    if (c->features & RANDOM_CORNERS) random_add_corners(c);
    if (c->features & RANDOM_HOLES) random_add_holes(c);
    random_fill_mesh(c);
    if (c->features & RANDOM_UVS) random_add_uvs(c);
    free(before);
    return c;
}

static inline random_cage *random_cage_new(unsigned seed, int features)
{
    static const unsigned char none[1] = { 0 };
    return random_cage_of(seed, features, none, 0);
}

#endif
