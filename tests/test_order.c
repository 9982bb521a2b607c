// THE ORDER OF THE RESULT: every point and every face of a result stands where the header says.
// Bilinear refinement puts each point at a place that is known beforehand, so its index can be
// checked by its position. Loop does so too where all edges are infinitely sharp and all vertices
// corners, and Catmull-Clark on a regular planar grid with sharp corners.
//
//     cc -I. tests/test_order.c -o build/test_order -lm && build/test_order
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/test.h"

static test_cage cage;

// --------------------------------------------------------- the pictures of the header, in numbers

static void check_faces(const subdiv_mesh *fine, const int *expected, int count, int size)
{
    CHECK_EQUAL(fine->face_count, count);
    for (int f = 0; f < fine->face_count && f < count; f++) {
        CHECK_EQUAL(face_size(fine, f), size);
        for (int i = 0; i < size; i++)
            CHECK_EQUAL(face_vertices(fine, f)[i], expected[size * f + i]);
    }
}

static void check_position(const subdiv_mesh *fine, int v, double x, double y, double z)
{
    const float *p = fine->positions + 3 * v;
    if (v >= fine->vertex_count) {
        TEST_REPORT("vertex %d of %d", v, fine->vertex_count);
        return;
    }
    CHECK_NEAR(p[0], x, 1e-6);
    CHECK_NEAR(p[1], y, 1e-6);
    CHECK_NEAR(p[2], z, 1e-6);
}

static void unit_quad(subdiv_scheme scheme)
{
    cage_clear(&cage, scheme);
    cage_vertex(&cage, 0, 0, 0);
    cage_vertex(&cage, 1, 0, 0);
    cage_vertex(&cage, 1, 1, 0);
    cage_vertex(&cage, 0, 1, 0);
}

static void test_quad_once(void)
{
    static const int faces[] = {0, 4, 8, 7,  4, 1, 5, 8,  7, 8, 6, 3,  8, 5, 2, 6};
    subdiv_mesh fine = {0};
    unit_quad(SUBDIV_BILINEAR);
    cage_quad(&cage, 0, 1, 2, 3);
    CHECK_EQUAL(subdiv_refine(&fine, &cage.mesh, 1, NULL), SUBDIV_OK);
    check_faces(&fine, faces, 4, 4);
    subdiv_mesh_free(&fine);
}

static void test_quad_twice(void)
{
    static const int grid[5][5] = {
        { 0,  4,  5,  6,  1},
        {13, 16, 17, 18,  7},
        {14, 19, 20, 21,  8},
        {15, 22, 23, 24,  9},
        { 3, 12, 11, 10,  2}};
    int faces[16 * 4];
    subdiv_mesh fine = {0};
    unit_quad(SUBDIV_BILINEAR);
    cage_quad(&cage, 0, 1, 2, 3);
    CHECK_EQUAL(subdiv_refine(&fine, &cage.mesh, 2, NULL), SUBDIV_OK);
    CHECK_EQUAL(fine.vertex_count, 25);
    for (int r = 0; r < 5; r++)
        for (int c = 0; c < 5; c++) check_position(&fine, grid[r][c], c / 4.0, r / 4.0, 0);
    for (int r = 0; r < 4; r++) {
        for (int c = 0; c < 4; c++) {
            int *q = faces + 4 * (4 * r + c);
            q[0] = grid[r][c], q[1] = grid[r][c + 1];
            q[2] = grid[r + 1][c + 1], q[3] = grid[r + 1][c];
        }
    }
    check_faces(&fine, faces, 16, 4);
    subdiv_mesh_free(&fine);
}

static void test_loop_triangle_once(void)
{
    static const int faces[] = {0, 3, 5,  4, 5, 3,  3, 1, 4,  5, 4, 2};
    subdiv_mesh fine = {0};
    unit_quad(SUBDIV_LOOP);
    cage_triangle(&cage, 0, 1, 2);
    cage.mesh.vertex_count = 3;
    CHECK_EQUAL(subdiv_refine(&fine, &cage.mesh, 1, NULL), SUBDIV_OK);
    check_faces(&fine, faces, 4, 3);
    subdiv_mesh_free(&fine);
}

// The triangle in the picture: 5 points on each side, 12 13 14 inside.
static void test_loop_triangle_twice(void)
{
    static const int rows[5][5] = {{0, 3, 4, 5, 1}, {9, 12, 13, 6}, {10, 14, 7}, {11, 8}, {2}};
    static const int faces[] = {
        0, 3, 9,  12, 9, 3,  3, 4, 12,  13, 12, 4,  4, 5, 13,  6, 13, 5,  5, 1, 6,
        9, 12, 10,  14, 10, 12,  12, 13, 14,  7, 14, 13,  13, 6, 7,
        10, 14, 11,  8, 11, 14,  14, 7, 8,
        11, 8, 2};
    subdiv_mesh fine = {0};
    cage_clear(&cage, SUBDIV_LOOP);
    cage_vertex(&cage, 0, 0, 0);
    cage_vertex(&cage, 1, 0, 0);
    cage_vertex(&cage, 0, 1, 0);
    cage_triangle(&cage, 0, 1, 2);
    for (int v = 0; v < 3; v++) cage_corner(&cage, v, SUBDIV_INFINITE);
    CHECK_EQUAL(subdiv_refine(&fine, &cage.mesh, 2, NULL), SUBDIV_OK);
    CHECK_EQUAL(fine.vertex_count, 15);
    for (int r = 0; r < 5; r++)
        for (int c = 0; c < 5 - r; c++) check_position(&fine, rows[r][c], c / 4.0, r / 4.0, 0);
    check_faces(&fine, faces, 16, 3);
    subdiv_mesh_free(&fine);
}

// The pentagon has 5 vertices, 5 edges, its centre, 5 spokes and 5 quads.
static void test_pentagon(void)
{
    static const int once[] = {
        0, 5, 10, 9,  1, 6, 10, 5,  2, 7, 10, 6,  3, 8, 10, 7,  4, 9, 10, 8};
    static const int twice_first_quad[] = {
        0, 5, 26, 17,  5, 6, 21, 26,  17, 26, 25, 18,  26, 21, 20, 25};
    static const int pentagon[] = {0, 1, 2, 3, 4};
    subdiv_mesh fine = {0};
    cage_clear(&cage, SUBDIV_BILINEAR);
    for (int i = 0; i < 5; i++) cage_vertex(&cage, cos(1.2566370614 * i), sin(1.2566370614 * i), 0);
    cage_face(&cage, 5, pentagon);
    CHECK_EQUAL(subdiv_refine(&fine, &cage.mesh, 1, NULL), SUBDIV_OK);
    CHECK_EQUAL(fine.vertex_count, 11);
    check_faces(&fine, once, 5, 4);
    subdiv_mesh_free(&fine);

    CHECK_EQUAL(subdiv_refine(&fine, &cage.mesh, 2, NULL), SUBDIV_OK);
    CHECK_EQUAL(fine.vertex_count, 31);
    CHECK_EQUAL(fine.face_count, 20);
    fine.face_count = fine.face_count > 4 ? 4 : fine.face_count;
    check_faces(&fine, twice_first_quad, 4, 4);
    check_position(&fine, 20, 0, 0, 0);
    for (int i = 0; i < 5; i++) {       // the spokes, then the middles of the quads at the vertices
        double a[2], b[2];
        for (int d = 0; d < 2; d++) {
            const float *p = cage.positions + d;
            a[d] = (p[3 * i] + p[3 * ((i + 1) % 5)]) / 2.0;
            b[d] = (p[3 * i] + p[3 * ((i + 4) % 5)]) / 2.0;
        }
        check_position(&fine, 21 + i, a[0] / 2, a[1] / 2, 0);
        check_position(&fine, 26 + i, (cage.positions[3 * i] + a[0] + b[0]) / 4,
                       (cage.positions[3 * i + 1] + a[1] + b[1]) / 4, 0);
    }
    subdiv_mesh_free(&fine);
}

// Edges count as they are met, and their points run from the lower-numbered end whatever the way
// the face takes.
static void test_shared_edge(void)
{
    static const double x[] = {0, 0, 1, 1, 2, 2};          // of the vertices 0 to 5
    static const int ends[7][2] = {{2, 3}, {0, 3}, {0, 1}, {1, 2}, {2, 4}, {4, 5}, {3, 5}};
    subdiv_mesh fine = {0};
    cage_clear(&cage, SUBDIV_BILINEAR);
    for (int v = 0; v < 6; v++) cage_vertex(&cage, x[v], v == 1 || v == 2 || v == 4, 0);
    cage_quad(&cage, 2, 3, 0, 1);
    cage_quad(&cage, 3, 2, 4, 5);       // meets the edge 2-3 again, then 2-4, 4-5, 5-3
    CHECK_EQUAL(subdiv_refine(&fine, &cage.mesh, 2, NULL), SUBDIV_OK);
    for (int e = 0; e < 7; e++) {
        for (int i = 1; i < 4; i++) {
            const float *a = cage.positions + 3 * ends[e][0], *b = cage.positions + 3 * ends[e][1];
            check_position(&fine, 6 + 3 * e + i - 1, a[0] + (b[0] - a[0]) * (i / 4.0),
                           a[1] + (b[1] - a[1]) * (i / 4.0), 0);
        }
    }
    subdiv_mesh_free(&fine);
}

// --------------------------------------------------------------------- every point of any cage

static void mix(double *to, double weight, const float *from)
{
    for (int d = 0; d < 3; d++) to[d] += weight * (double)from[d];
}

// Where the parameters of a place put it: bilinear in a quad, linear in a triangle of Loop, and
// bilinear in the quads between vertex, middles of edges and centre of any other polygon.
static void place_position(const order *o, order_place p, double *at)
{
    double n = order_grid(o, p.face), s = p.row / n, t = p.column / n;
    int size = order_face_size(o, p.face);
    const float *q[RANDOM_MAX_SIZE];
    for (int i = 0; i < size; i++)
        q[i] = o->cage->positions + 3 * order_face_vertex(o, p.face, i);
    at[0] = at[1] = at[2] = 0;
    if (o->cage->scheme == SUBDIV_LOOP) {
        mix(at, 1 - s - t, q[0]), mix(at, t, q[1]), mix(at, s, q[2]);
    } else if (size == 4) {
        mix(at, (1 - s) * (1 - t), q[0]), mix(at, (1 - s) * t, q[1]);
        mix(at, s * t, q[2]), mix(at, s * (1 - t), q[3]);
    } else {
        const float *after = q[(p.quad + 1) % size], *before = q[(p.quad + size - 1) % size];
        double to_next = (1 - s) * t, to_last = s * (1 - t);
        mix(at, (1 - s) * (1 - t) + (to_next + to_last) / 2, q[p.quad]);
        mix(at, to_next / 2, after), mix(at, to_last / 2, before);
        for (int i = 0; i < size; i++) mix(at, s * t / size, q[i]);
    }
}

static void check_points(const order *o, const subdiv_mesh *fine)
{
    CHECK_EQUAL(fine->vertex_count, o->point_count);
    if (fine->vertex_count != o->point_count) return;
    for (int f = 0; f < o->cage->face_count; f++) {
        order_place p = {0, 0, 0, 0, 0};
        p.face = f;
        do {
            const float *q = fine->positions + 3 * place_point(o, p);
            double at[3], off = 0;
            place_position(o, p, at);
            for (int d = 0; d < 3; d++) off = fmax(off, fabs((double)q[d] - at[d]));
            if (!(off < 4e-6))
                TEST_REPORT("face %d quad %d row %d column %d is off by %g", p.face, p.quad,
                            p.row, p.column, off);
        } while (place_next_point(o, &p));
    }
}

static void check_face_list(const order *o, const subdiv_mesh *fine, const unsigned char *hidden)
{
    int at = 0, loop = o->cage->scheme == SUBDIV_LOOP;
    CHECK_EQUAL(fine->face_count, o->face_count);
    for (int f = 0; f < o->cage->face_count; f++) {
        order_place p = {0, 0, 0, 0, 0};
        p.face = f;
        if (hidden && hidden[f]) continue;
        do {
            int points[4], same = at < fine->face_count && face_size(fine, at) == (loop ? 3 : 4);
            order_face_points(o, p, points);
            for (int i = 0; same && i < (loop ? 3 : 4); i++)
                same = face_vertices(fine, at)[i] == points[i];
            if (!same || fine->cage_faces[at] != f)
                TEST_REPORT("fine face %d is not that of face %d quad %d row %d column %d",
                            at, f, p.quad, p.row, p.column);
            at++;
        } while (place_next_face(o, &p));
    }
    CHECK_EQUAL(at, fine->face_count);
}

static void check_order(const subdiv_mesh *m, int levels, int points)
{
    static char context[80];
    unsigned char hidden[RANDOM_MAX_FACES] = {0};
    subdiv_mesh fine = {0};
    order o;
    sprintf(context, "%d vertices, %d faces, level %d", m->vertex_count, m->face_count, levels);
    test_context = context;
    for (int i = 0; i < m->hole_count; i++) hidden[m->holes[i]] = 1;
    CHECK(order_make(&o, m, levels, hidden));
    CHECK_EQUAL(subdiv_refine(&fine, m, levels, NULL), SUBDIV_OK);
    if (points) check_points(&o, &fine);
    check_face_list(&o, &fine, hidden);
    subdiv_mesh_free(&fine);
    order_free(&o);
    test_context = "";
}

// Moves every vertex a little, so that no two places of a result coincide.
static void bump(void)
{
    for (int i = 0; i < 3 * cage.mesh.vertex_count; i++)
        cage.positions[i] += 0.2f * (float)sin(12.9898 * i * i + 1);
}

// All edges infinitely sharp, all vertices corners: Loop then stays on the cage's own triangles.
static void sharpen_all(void)
{
    edge_list e = edges_make(&cage.mesh);
    for (int i = 0; i < e.count; i++)
        cage_crease(&cage, e.ends[2 * i], e.ends[2 * i + 1], SUBDIV_INFINITE);
    for (int v = 0; v < cage.mesh.vertex_count; v++) cage_corner(&cage, v, SUBDIV_INFINITE);
    edges_free(&e);
}

static void test_bilinear_points(void)
{
    for (int kind = 0; kind < 8; kind++) {
        switch (kind) {
        case 0: build_grid(&cage, SUBDIV_BILINEAR, 1, 1); break;
        case 1: build_grid(&cage, SUBDIV_BILINEAR, 3, 2); break;
        case 2: build_torus(&cage, SUBDIV_BILINEAR, 4, 3); break;
        case 3: build_tetrahedron(&cage, SUBDIV_BILINEAR); break;
        case 4: build_fins(&cage, SUBDIV_BILINEAR, 3, 2); break;
        case 5: build_pillow(&cage, SUBDIV_BILINEAR); break;
        case 6: build_bow_tie(&cage, SUBDIV_BILINEAR); break;
        default: build_prism(&cage, 5), cage.mesh.scheme = SUBDIV_BILINEAR; break;
        }
        bump();
        for (int levels = 1; levels <= 4; levels++) check_order(&cage.mesh, levels, 1);
    }
}

static void test_loop_points(void)
{
    for (int kind = 0; kind < 7; kind++) {
        switch (kind) {
        case 0: build_grid(&cage, SUBDIV_LOOP, 1, 1); break;
        case 1: build_grid(&cage, SUBDIV_LOOP, 3, 2); break;
        case 2: build_torus(&cage, SUBDIV_LOOP, 4, 3); break;
        case 3: build_tetrahedron(&cage, SUBDIV_LOOP); break;
        case 4: build_fins(&cage, SUBDIV_LOOP, 3, 2); break;
        case 5: build_bow_tie(&cage, SUBDIV_LOOP); break;
        default: build_icosahedron(&cage, SUBDIV_LOOP); break;
        }
        bump();
        sharpen_all();
        for (int levels = 1; levels <= 4; levels++) check_order(&cage.mesh, levels, 1);
    }
}

// A planar regular grid with sharp corners refines to the planar regular grid, smooth as it is.
static void test_regular_grids(void)
{
    for (int scheme = SUBDIV_CATMULL_CLARK; scheme <= SUBDIV_LOOP; scheme++) {
        build_grid(&cage, (subdiv_scheme)scheme, 3, 2);
        cage_corner(&cage, 0, SUBDIV_INFINITE);
        cage_corner(&cage, 3, SUBDIV_INFINITE);
        cage_corner(&cage, 8, SUBDIV_INFINITE);
        cage_corner(&cage, 11, SUBDIV_INFINITE);
        for (int levels = 1; levels <= 4; levels++) check_order(&cage.mesh, levels, 1);
    }
}

// The edges of the cage, as the faces meet them.
static void check_edges(const subdiv_mesh *m)
{
    edge_list e = edges_make(m);
    int *ends = int_array(2 * e.count, -1);
    subdiv_surface *surface;
    CHECK_EQUAL(subdiv_prepare(&surface, m, 1, NULL), SUBDIV_OK);
    CHECK_EQUAL(subdiv_surface_edge_count(surface), e.count);
    subdiv_surface_edges(surface, ends);
    CHECK(memcmp(ends, e.ends, sizeof *ends * 2 * (size_t)e.count) == 0);
    subdiv_surface_free(surface);
    free(ends);
    edges_free(&e);
}

static void test_edges(void)
{
    for (unsigned seed = 0; seed < 100; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL & ~RANDOM_DEGENERATE);
        if (!c) abort();
        check_edges(&c->mesh);
        random_cage_free(c);
    }
}

// Without its faces a hole leaves a gap in the faces and none in the points.
static void test_holes(void)
{
    for (int f = 0; f < 6; f++) {
        build_prism(&cage, 4);
        cage.mesh.scheme = SUBDIV_BILINEAR;
        cage_hole(&cage, f);
        cage_hole(&cage, 3);
        check_order(&cage.mesh, 2, 1);
    }
}

// Under Loop larger faces can be cut into fans, each around the first vertex of its face. All the
// triangles of a fan count as parts of the face.
static void test_triangulate(void)
{
    static const int pentagon[] = {3, 2, 5, 6, 4}, of[] = {0, 0, 1, 1, 1, 2};
    static test_cage cut;
    subdiv_options opt = {0};
    subdiv_mesh fine = {0}, expected = {0};
    for (int i = 0; i < 2; i++) {
        test_cage *c = i ? &cut : &cage;
        cage_clear(c, SUBDIV_LOOP);
        for (int v = 0; v < 7; v++) cage_vertex(c, v % 3, v / 3 + 0.1 * v, 0.3 * v * v);
        if (i) {
            for (int k = 1; k < 3; k++) cage_triangle(c, 0, k, k + 1);
            for (int k = 1; k < 4; k++) cage_triangle(c, 3, pentagon[k], pentagon[k + 1]);
        } else {
            static const int quad[] = {0, 1, 2, 3};
            cage_face(c, 4, quad);
            cage_face(c, 5, pentagon);
        }
        cage_triangle(c, 2, 1, 5);
    }
    opt.triangulate = 1;
    CHECK_EQUAL(subdiv_refine(&fine, &cage.mesh, 2, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_refine(&expected, &cut.mesh, 2, NULL), SUBDIV_OK);
    CHECK_EQUAL(fine.vertex_count, expected.vertex_count);
    CHECK_EQUAL(fine.face_count, 16 * 6);
    for (int v = 0; v < 3 * fine.vertex_count; v++)
        CHECK_NEAR(fine.positions[v], expected.positions[v], 0);
    check_faces(&fine, expected.face_vertices, expected.face_count, 3);
    for (int f = 0; f < fine.face_count; f++) CHECK_EQUAL(fine.cage_faces[f], of[f / 16]);
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&expected);
}

int main(void)
{
    RUN(test_quad_once);
    RUN(test_quad_twice);
    RUN(test_loop_triangle_once);
    RUN(test_loop_triangle_twice);
    RUN(test_pentagon);
    RUN(test_shared_edge);
    RUN(test_bilinear_points);
    RUN(test_loop_points);
    RUN(test_regular_grids);
    RUN(test_edges);
    RUN(test_holes);
    RUN(test_triangulate);
    return test_end("order");
}
