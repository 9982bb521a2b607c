// Cages for the tests: builders with storage of their own, the edges of a mesh, and ways over the
// points and faces of a result. Nothing here calls the library.
#ifndef CAGES_H
#define CAGES_H

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "subdiv.h"
#include "order.h"

#ifndef CAGE_SCALE                                // a test may define more room
#define CAGE_SCALE 1
#endif
enum {
    CAGE_VERTICES = 320 * CAGE_SCALE, CAGE_FACES = 512 * CAGE_SCALE,
    CAGE_FACE_VERTICES = 4096 * CAGE_SCALE, CAGE_TAGS = 1024 * CAGE_SCALE
};

typedef struct test_cage {
    subdiv_mesh mesh;                             // its arrays are those below
    float positions[3 * CAGE_VERTICES];
    int   face_sizes[CAGE_FACES];
    int   face_vertices[CAGE_FACE_VERTICES];
    int   crease_vertices[2 * CAGE_TAGS];
    float crease_sharpness[CAGE_TAGS];
    int   corner_vertices[CAGE_TAGS];
    float corner_sharpness[CAGE_TAGS];
    int   holes[CAGE_FACES];
} test_cage;

// ------------------------------------------------------------------------------ meshes at large

// The length of the longest side of a box around a mesh.
static inline double mesh_extent(const subdiv_mesh *m)
{
    double largest = 0;
    for (int k = 0; k < 3; k++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int v = 0; v < m->vertex_count; v++) {
            low = fmin(low, (double)m->positions[3 * v + k]);
            high = fmax(high, (double)m->positions[3 * v + k]);
        }
        largest = fmax(largest, high - low);
    }
    return largest;
}

// The largest coordinate of a mesh in size.
static inline double mesh_reach(const subdiv_mesh *m)
{
    double size = 0;
    for (int i = 0; i < 3 * m->vertex_count; i++) size = fmax(size, fabs((double)m->positions[i]));
    return size;
}

static inline int face_size(const subdiv_mesh *m, int f)
{
    return m->face_size ? m->face_size : m->face_sizes[f];
}

static inline const int *face_vertices(const subdiv_mesh *m, int f)
{
    size_t start = 0;
    if (!m->face_vertices) return NULL;
    if (m->face_size) return m->face_vertices + (size_t)m->face_size * (size_t)f;
    for (int i = 0; i < f; i++) start += (size_t)m->face_sizes[i];
    return m->face_vertices + start;
}

static inline int face_vertex_count(const subdiv_mesh *m)
{
    return (int)(face_vertices(m, m->face_count) - m->face_vertices);
}

static inline int face_has(const subdiv_mesh *m, int f, int v)
{
    const int *q = face_vertices(m, f);
    for (int i = 0; i < face_size(m, f); i++) if (q[i] == v) return 1;
    return 0;
}

static inline int is_hole(const subdiv_mesh *m, int f)
{
    for (int i = 0; i < m->hole_count; i++) if (m->holes[i] == f) return 1;
    return 0;
}

// The sharpness that the lists of a mesh give; the later of two entries wins.
static inline float crease_sharpness(const subdiv_mesh *m, int a, int b)
{
    for (int i = m->crease_count - 1; i >= 0; i--) {
        const int *e = m->crease_vertices + 2 * i;
        if ((e[0] == a && e[1] == b) || (e[0] == b && e[1] == a)) return m->crease_sharpness[i];
    }
    return 0;
}

static inline float corner_sharpness(const subdiv_mesh *m, int v)
{
    for (int i = m->corner_count - 1; i >= 0; i--)
        if (m->corner_vertices[i] == v) return m->corner_sharpness[i];
    return 0;
}

// ------------------------------------------------------------------------------------ building

static inline void cage_clear(test_cage *c, subdiv_scheme scheme)
{
    subdiv_mesh *m = &c->mesh;
    memset(c, 0, sizeof *c);
    m->scheme = scheme;
    m->positions = c->positions;
    m->face_sizes = c->face_sizes;
    m->face_vertices = c->face_vertices;
    m->crease_vertices = c->crease_vertices;
    m->crease_sharpness = c->crease_sharpness;
    m->corner_vertices = c->corner_vertices;
    m->corner_sharpness = c->corner_sharpness;
    m->holes = c->holes;
}

static inline int cage_vertex(test_cage *c, double x, double y, double z)
{
    int v = c->mesh.vertex_count++;
    if (v >= CAGE_VERTICES) abort();
    c->positions[3 * v] = (float)x;
    c->positions[3 * v + 1] = (float)y;
    c->positions[3 * v + 2] = (float)z;
    return v;
}

static inline void cage_face(test_cage *c, int size, const int *vertices)
{
    int start = face_vertex_count(&c->mesh), f = c->mesh.face_count++;
    if (f >= CAGE_FACES || start + size > CAGE_FACE_VERTICES) abort();
    c->face_sizes[f] = size;
    memcpy(c->face_vertices + start, vertices, sizeof(int) * (size_t)size);
}

static inline void cage_triangle(test_cage *c, int v0, int v1, int v2)
{
    int v[3];
    v[0] = v0, v[1] = v1, v[2] = v2;
    cage_face(c, 3, v);
}

// A quad, or two triangles under Loop.
static inline void cage_quad(test_cage *c, int v0, int v1, int v2, int v3)
{
    int v[4];
    v[0] = v0, v[1] = v1, v[2] = v2, v[3] = v3;
    if (c->mesh.scheme == SUBDIV_LOOP) cage_triangle(c, v0, v1, v2), cage_triangle(c, v0, v2, v3);
    else cage_face(c, 4, v);
}

static inline void cage_crease(test_cage *c, int a, int b, double sharpness)
{
    int i = c->mesh.crease_count++;
    if (i >= CAGE_TAGS) abort();
    c->crease_vertices[2 * i] = a;
    c->crease_vertices[2 * i + 1] = b;
    c->crease_sharpness[i] = (float)sharpness;
}

static inline void cage_corner(test_cage *c, int v, double sharpness)
{
    int i = c->mesh.corner_count++;
    if (i >= CAGE_TAGS) abort();
    c->corner_vertices[i] = v;
    c->corner_sharpness[i] = (float)sharpness;
}

static inline void cage_hole(test_cage *c, int f)
{
    if (c->mesh.hole_count >= CAGE_FACES) abort();
    c->holes[c->mesh.hole_count++] = f;
}

// Faces around vertex 0, as many as asked: quads (0, i, its far vertex, i+1), or triangles
// (0, i, i+1) under Loop. The ends of the spokes are 1, 2, ...; a closed fan makes 0 interior, an
// open one has a spoke more than faces and 0 on its boundary.
static inline void build_fan(test_cage *c, subdiv_scheme scheme, int faces, int closed)
{
    int spokes = closed ? faces : faces + 1;
    double turn = 8 * atan(1.0) / (closed ? faces : 2 * faces);
    cage_clear(c, scheme);
    cage_vertex(c, 0, 0, 0.5);
    for (int i = 0; i < spokes; i++) cage_vertex(c, cos(turn * i), sin(turn * i), 0);
    for (int i = 0; i < faces; i++) {
        int a = 1 + i, b = 1 + (i + 1) % spokes;
        if (scheme == SUBDIV_LOOP) cage_triangle(c, 0, a, b);
        else {
            double angle = turn * (i + 0.5);
            int far = cage_vertex(c, 1.5 * cos(angle), 1.5 * sin(angle), -0.2);
            cage_quad(c, 0, a, far, b);
        }
    }
}

// nx by ny quads (under Loop twice as many triangles); vertex (i, j) is i + (nx + 1) * j.
static inline void build_grid(test_cage *c, subdiv_scheme scheme, int nx, int ny)
{
    cage_clear(c, scheme);
    for (int j = 0; j <= ny; j++) for (int i = 0; i <= nx; i++) cage_vertex(c, i, j, 0);
    for (int j = 0; j < ny; j++) {
        for (int i = 0; i < nx; i++) {
            int v = i + (nx + 1) * j;
            cage_quad(c, v, v + 1, v + nx + 2, v + nx + 1);
        }
    }
}

static inline void build_torus(test_cage *c, subdiv_scheme scheme, int nx, int ny)
{
    double tau = 8 * atan(1.0);
    cage_clear(c, scheme);
    for (int j = 0; j < ny; j++) {
        for (int i = 0; i < nx; i++) {
            double a = tau * i / nx, b = tau * j / ny, r = 0.7 + 0.3 * cos(b);
            cage_vertex(c, r * cos(a), r * sin(a), 0.3 * sin(b));
        }
    }
    for (int j = 0; j < ny; j++) {
        for (int i = 0; i < nx; i++) {
            int right = (i + 1) % nx, up = (j + 1) % ny;
            cage_quad(c, i + nx * j, right + nx * j, right + nx * up, i + nx * up);
        }
    }
}

// Two n-gons joined by n quads; the cube is the prism over a square.
static inline void build_prism(test_cage *c, int n)
{
    int top[16] = { 0 }, bottom[16] = { 0 };
    double turn = 8 * atan(1.0) / n;
    cage_clear(c, SUBDIV_CATMULL_CLARK);
    for (int i = 0; i < n; i++) top[i] = cage_vertex(c, cos(turn * i), sin(turn * i), 0.7);
    for (int i = 0; i < n; i++)
        bottom[n - 1 - i] = cage_vertex(c, cos(turn * i), sin(turn * i), -0.7);
    cage_face(c, n, top);
    cage_face(c, n, bottom);
    for (int i = 0; i < n; i++) cage_quad(c, i, n + i, n + (i + 1) % n, (i + 1) % n);
}

// Two fans of triangles on a common ring of n: an octahedron for n = 4.
static inline void build_bipyramid(test_cage *c, subdiv_scheme scheme, int n)
{
    double turn = 8 * atan(1.0) / n;
    cage_clear(c, scheme);
    cage_vertex(c, 0, 0, 1);
    cage_vertex(c, 0, 0, -1);
    for (int i = 0; i < n; i++) cage_vertex(c, cos(turn * i), sin(turn * i), 0);
    for (int i = 0; i < n; i++) {
        int a = 2 + i, b = 2 + (i + 1) % n;
        cage_triangle(c, 0, a, b);
        cage_triangle(c, 1, b, a);
    }
}

static inline void build_tetrahedron(test_cage *c, subdiv_scheme scheme)
{
    cage_clear(c, scheme);
    cage_vertex(c, 1, 1, 1);
    cage_vertex(c, -1, -1, 1);
    cage_vertex(c, -1, 1, -1);
    cage_vertex(c, 1, -1, -1);
    cage_triangle(c, 0, 2, 1);
    cage_triangle(c, 0, 3, 2);
    cage_triangle(c, 0, 1, 3);
    cage_triangle(c, 1, 2, 3);
}

// Poles 0 and 11, and two rings of five, 1 to 5 and 6 to 10.
static inline void build_icosahedron(test_cage *c, subdiv_scheme scheme)
{
    double turn = 8 * atan(1.0) / 5, z = sqrt(0.2), r = 2 * z;
    cage_clear(c, scheme);
    cage_vertex(c, 0, 0, 1);
    for (int i = 0; i < 5; i++) cage_vertex(c, r * cos(turn * i), r * sin(turn * i), z);
    for (int i = 0; i < 5; i++)
        cage_vertex(c, r * cos(turn * (i + 0.5)), r * sin(turn * (i + 0.5)), -z);
    cage_vertex(c, 0, 0, -1);
    for (int i = 0; i < 5; i++) {
        int a = 1 + i, b = 1 + (i + 1) % 5, d = 6 + i, e = 6 + (i + 1) % 5;
        cage_triangle(c, 0, a, b);
        cage_triangle(c, a, d, b);
        cage_triangle(c, b, d, e);
        cage_triangle(c, 11, e, d);
    }
}

// Two faces with two common edges, 1-0 and 0-2: 0 is interior with valence 2. Under Loop two
// triangles back to back, so all three vertices are.
static inline void build_pillow(test_cage *c, subdiv_scheme scheme)
{
    cage_clear(c, scheme);
    cage_vertex(c, 0, 0, 0.5);
    cage_vertex(c, -1, 0, 0);
    cage_vertex(c, 1, 0, 0.1);
    if (scheme == SUBDIV_LOOP) cage_triangle(c, 1, 0, 2), cage_triangle(c, 2, 0, 1);
    else {
        cage_vertex(c, 0, 1, 0);
        cage_vertex(c, 0.2, -1, 0);
        cage_quad(c, 1, 0, 2, 3);
        cage_quad(c, 2, 0, 1, 4);
    }
}

// Sheets that meet in one line of so many edges, the vertices 0, 1, ..., length. Three sheets or
// more make those edges non-manifold.
static inline void build_fins(test_cage *c, subdiv_scheme scheme, int sheets, int length)
{
    cage_clear(c, scheme);
    for (int i = 0; i <= length; i++) cage_vertex(c, i, 0, 0);
    for (int s = 0; s < sheets; s++) {
        double angle = 8 * atan(1.0) * s / sheets;
        int start = c->mesh.vertex_count;
        for (int i = 0; i <= length; i++) cage_vertex(c, i, cos(angle), sin(angle));
        for (int i = 0; i < length; i++) cage_quad(c, i, i + 1, start + i + 1, start + i);
    }
}

// Two faces that share the vertex 0 and nothing else.
static inline void build_bow_tie(test_cage *c, subdiv_scheme scheme)
{
    cage_clear(c, scheme);
    cage_vertex(c, 0, 0, 0);
    for (int side = -1; side <= 1; side += 2) {
        int a = cage_vertex(c, side, -1, 0), b = cage_vertex(c, 2 * side, 0, 0.3);
        int d = cage_vertex(c, side, 1, 0);
        if (scheme == SUBDIV_LOOP) cage_triangle(c, 0, a, d);
        else cage_quad(c, 0, a, b, d);
    }
}

// --------------------------------------------------------------------------------------- edges

typedef struct edge_list {
    int  count;
    int *ends;                        // [2 * count]  the lower-numbered first
    int *faces;                       // [count]      how many
    int *half;                        // [2 * count]  the face-vertex where it starts up, down; -1
    int *of;                          // [face-vertices]  the edge from each to the next
    int *next, *previous, *face;      // [face-vertices]  around the face; the face
    int  twisted;                     // edges that two faces run through in the same direction
    int *slots, slot_count;           // a hash table of edges
} edge_list;

static inline int *int_array(int count, int value)
{
    int *a = (int *)malloc(sizeof *a * (size_t)(count + 1));
    if (!a) abort();
    for (int i = 0; i < count; i++) a[i] = value;
    return a;
}

// The slot of an edge: its own, or the free one where it would go.
static inline int edges_slot(const edge_list *e, int low, int high)
{
    unsigned at = (unsigned)low * 2654435761u ^ (unsigned)high * 40503u;
    for (;; at++) {
        int slot = (int)(at % (unsigned)e->slot_count), edge = e->slots[slot];
        if (edge < 0 || (e->ends[2 * edge] == low && e->ends[2 * edge + 1] == high)) return slot;
    }
}

// The edge between two vertices, or -1.
static inline int edges_find(const edge_list *e, int a, int b)
{
    return e->slots[edges_slot(e, a < b ? a : b, a < b ? b : a)];
}

// The edges of a mesh in the order in which its faces first meet them.
static inline edge_list edges_make(const subdiv_mesh *m)
{
    int total = face_vertex_count(m), start = 0;
    edge_list e;
    memset(&e, 0, sizeof e);
    e.ends = int_array(2 * total, 0);
    e.faces = int_array(total, 0);
    e.half = int_array(2 * total, -1);
    e.of = int_array(total, 0);
    e.next = int_array(total, 0);
    e.previous = int_array(total, 0);
    e.face = int_array(total, 0);
    e.slot_count = 2 * total + 1;
    e.slots = int_array(e.slot_count, -1);
    for (int f = 0; f < m->face_count; start += face_size(m, f), f++) {
        for (int i = 0, n = face_size(m, f); i < n; i++) {
            int j = start + i, k = start + (i + 1) % n;
            int a = m->face_vertices[j], b = m->face_vertices[k], down = a > b;
            int slot = edges_slot(&e, down ? b : a, down ? a : b);
            if (e.slots[slot] < 0) {
                e.ends[2 * e.count] = down ? b : a;
                e.ends[2 * e.count + 1] = down ? a : b;
                e.slots[slot] = e.count++;
            }
            e.of[j] = e.slots[slot];
            e.faces[e.of[j]]++;
            if (e.half[2 * e.of[j] + down] >= 0) e.twisted++;
            e.half[2 * e.of[j] + down] = j;
            e.next[j] = k, e.previous[k] = j, e.face[j] = f;
        }
    }
    return e;
}

static inline void edges_free(edge_list *e)
{
    free(e->ends), free(e->faces), free(e->half), free(e->of);
    free(e->next), free(e->previous), free(e->face), free(e->slots);
    memset(e, 0, sizeof *e);
}

static inline int boundary_edge_count(const edge_list *e)
{
    int count = 0;
    for (int i = 0; i < e->count; i++) count += e->faces[i] == 1;
    return count;
}

// The face-vertex of the face across the edge that starts at face-vertex j, or -1.
static inline int edges_twin(const edge_list *e, const subdiv_mesh *m, int j)
{
    int down = m->face_vertices[j] > m->face_vertices[e->next[j]];
    return e->half[2 * e->of[j] + !down];
}

// Every edge has one or two faces wound alike, and the faces of every vertex are one fan.
static inline int is_manifold(const subdiv_mesh *m)
{
    edge_list e = edges_make(m);
    int total = face_vertex_count(m), good = !e.twisted;
    int *left = int_array(m->vertex_count, 0);    // faces of the vertex not yet seen in its fan
    for (int j = 0; j < total; j++) left[m->face_vertices[j]]++;
    for (int j = 0; j < total && good; j++) {
        int v = m->face_vertices[j], start = j, at, twin;
        if (left[v] <= 0) continue;
        while ((twin = edges_twin(&e, m, start)) >= 0 && e.next[twin] != j) start = e.next[twin];
        for (at = start; at >= 0; ) {
            left[v]--;
            at = edges_twin(&e, m, e.previous[at]);
            if (at == start) break;
        }
        good = left[v] == 0;
    }
    free(left);
    edges_free(&e);
    return good;
}

// --------------------------------------------------------------------- places on the cage's faces

// All the points of a face, one by one, from the place {face, 0, 0, 0, 0}; 0 at the end.
static inline int place_next_point(const order *o, order_place *p)
{
    int steps = order_grid(o, p->face), ngon = order_is_ngon(o, p->face);
    if (++p->column <= (o->cage->scheme == SUBDIV_LOOP ? steps - p->row : steps)) return 1;
    p->column = 0;
    if (++p->row <= steps) return 1;
    p->row = 0;
    return ++p->quad < (ngon ? order_face_size(o, p->face) : 1);
}

// All the fine faces of a face in their order, likewise.
static inline int place_next_face(const order *o, order_place *p)
{
    int steps = order_grid(o, p->face), ngon = order_is_ngon(o, p->face);
    if (o->cage->scheme == SUBDIV_LOOP) {
        p->turned = !p->turned && p->column < steps - p->row - 1;
        if (p->turned) return 1;
        if (++p->column < steps - p->row) return 1;
    } else if (++p->column < steps) return 1;
    p->column = 0;
    if (++p->row < steps) return 1;
    p->row = 0;
    return ++p->quad < (ngon ? order_face_size(o, p->face) : 1);
}

static inline int place_point(const order *o, order_place p)
{
    return order_point(o, p.face, p.quad, p.row, p.column);
}

// The place so many rows and columns further on in a fine face that is itself a grid of so many
// steps. A turned triangle starts at its far side and counts backwards.
static inline order_place place_within(order_place p, int steps, int row, int column)
{
    p.row = p.turned ? (p.row + 1) * steps - row : p.row * steps + row;
    p.column = p.turned ? (p.column + 1) * steps - column : p.column * steps + column;
    p.turned = 0;
    return p;
}

// The same place seen from a face whose list of vertices starts one later.
static inline order_place place_rotate(const order *o, order_place p)
{
    int n = o->n, r = p.row, c = p.column, size = order_face_size(o, p.face);
    if (o->cage->scheme == SUBDIV_LOOP) p.row = n - r - c, p.column = r;
    else if (size == 4) p.row = n - c, p.column = r;
    else p.quad = (p.quad + size - 1) % size;
    return p;
}

// The same place seen from a face wound the other way that starts at the same vertex.
static inline order_place place_flip(const order *o, order_place p)
{
    int r = p.row, size = order_face_size(o, p.face);
    p.row = p.column, p.column = r;
    if (order_is_ngon(o, p.face)) p.quad = (size - p.quad) % size;
    return p;
}

#endif
