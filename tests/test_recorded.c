// Refines small cages of every kind and compares with what OpenSubdiv made of them: the numbers in
// tests/oracle, see the README there. Runs in the root of the project.
//
//     cc -I. tests/test_recorded.c -o build/test_recorded -lm && build/test_recorded [DIRECTORY]

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

#include "lib/cages.h"
#include "lib/order.h"
#include "lib/test.h"

enum { LEVELS = 2, LEAST_CAGES = 57 };

static const double tolerance = 1e-6;             // of the largest extent of the cage

// The next part of the record: its name, then how many entries it has; -1 if it is not that.
static int read_count(FILE *file, const char *name)
{
    char word[16];
    int count = -1;
    if (fscanf(file, "%15s %d", word, &count) != 2 || strcmp(word, name) != 0) return -1;
    return count;
}

static void check_positions(FILE *file, const char *name, const subdiv_mesh *fine, double extent)
{
    const int count = read_count(file, name);
    CHECK_EQUAL(fine->vertex_count, count);
    for (int v = 0; v < count && !test_bad; v++) {
        for (int k = 0; k < 3; k++) {
            double x;
            CHECK(fscanf(file, "%lf", &x) == 1);
            if (test_bad) return;
            if (x == x) CHECK_NEAR(fine->positions[3 * v + k], x, tolerance * extent);
        }
    }
}

// The sharpness that a list has for an edge, or for a vertex (ends 1); 0 if none.
static float listed_sharpness(int count, int ends, const int *vertices, const float *sharpness,
                              int a, int b)
{
    for (int i = 0; i < count; i++) {
        const int *v = vertices + ends * i;
        const int w = ends == 2 ? v[1] : b;
        if ((v[0] == a && w == b) || (v[0] == b && w == a)) return sharpness[i];
    }
    return 0;
}

// Equal counts and every recorded entry found: the lists are the same, in whatever order.
static void check_creases(FILE *file, const subdiv_mesh *fine)
{
    const int count = read_count(file, "creases");
    CHECK_EQUAL(fine->crease_count, count);
    for (int i = 0; i < count && !test_bad; i++) {
        int a, b;
        double s;
        CHECK(fscanf(file, "%d %d %lf", &a, &b, &s) == 3);
        if (test_bad) return;
        CHECK_NEAR(listed_sharpness(fine->crease_count, 2, fine->crease_vertices,
                                    fine->crease_sharpness, a, b), s, 1e-5);
    }
}

static void check_corners(FILE *file, const subdiv_mesh *fine)
{
    const int count = read_count(file, "corners");
    CHECK_EQUAL(fine->corner_count, count);
    for (int i = 0; i < count && !test_bad; i++) {
        int v;
        double s;
        CHECK(fscanf(file, "%d %lf", &v, &s) == 2);
        if (test_bad) return;
        CHECK_NEAR(listed_sharpness(fine->corner_count, 1, fine->corner_vertices,
                                    fine->corner_sharpness, v, v), s, 1e-5);
    }
}

static void check_fine_face(const order *o, const subdiv_mesh *fine, order_place place)
{
    int points[4];
    const int size = order_face_points(o, place, points), f = order_face(o, place);
    CHECK_EQUAL(fine->face_size ? fine->face_size : fine->face_sizes[f], size);
    CHECK(memcmp(points, fine->face_vertices + f * size, sizeof(int) * (size_t)size) == 0);
    CHECK_EQUAL(fine->cage_faces[f], place.face);
}

static void check_cage_face(const order *o, const subdiv_mesh *fine, int face)
{
    const int grid = order_grid(o, face), is_triangle = o->cage->scheme == SUBDIV_LOOP;
    const int quads = order_is_ngon(o, face) ? order_face_size(o, face) : 1;
    for (int q = 0; q < quads; q++) {
        for (int r = 0; r < grid; r++) {
            for (int c = 0; c < (is_triangle ? grid - r : grid); c++) {
                order_place place = { 0, 0, 0, 0, 0 };
                place.face = face;
                place.quad = q;
                place.row = r;
                place.column = c;
                check_fine_face(o, fine, place);
                place.turned = 1;
                if (is_triangle && c + 1 < grid - r) check_fine_face(o, fine, place);
            }
        }
    }
}

// The record names the cage faces that are holes, by a tag or by the boundary rule.
static void check_faces(FILE *file, const subdiv_mesh *fine, const subdiv_mesh *cage)
{
    const int count = read_count(file, "hidden");
    unsigned char *hidden = (unsigned char *)calloc((size_t)cage->face_count, 1);
    order o = { 0 };
    CHECK(count >= 0 && hidden);
    for (int i = 0; i < count && !test_bad; i++) {
        int f;
        CHECK(fscanf(file, "%d", &f) == 1 && f >= 0 && f < cage->face_count);
        if (!test_bad) hidden[f] = 1;
    }
    if (!test_bad) CHECK(order_make(&o, cage, LEVELS, hidden));
    if (!test_bad) {
        CHECK_EQUAL(fine->face_count, o.face_count);
        for (int f = 0; f < cage->face_count && !test_bad; f++)
            if (!hidden[f]) check_cage_face(&o, fine, f);
    }
    order_free(&o);
    free(hidden);
}

static void check_cage(const char *directory, const char *name)
{
    char path[512];
    subdiv_mesh cage = { 0 }, fine = { 0 };
    subdiv_options opt = { 0 };
    snprintf(path, sizeof path, "%s/%s.obj", directory, name);
    CHECK_EQUAL(subdiv_load_obj(&cage, path, NULL), SUBDIV_OK);
    if (strncmp(name, "loop_", 5) == 0) cage.scheme = SUBDIV_LOOP;
    if (strncmp(name, "bilinear_", 9) == 0) cage.scheme = SUBDIV_BILINEAR;
    CHECK_EQUAL(subdiv_refine(&fine, &cage, LEVELS, NULL), SUBDIV_OK);

    snprintf(path, sizeof path, "%s/%s.txt", directory, name);
    FILE *file = fopen(path, "r");
    CHECK(file != NULL);
    if (!test_bad) check_positions(file, "vertices", &fine, mesh_extent(&cage));
    if (!test_bad) check_creases(file, &fine);
    if (!test_bad) check_corners(file, &fine);
    if (!test_bad) check_faces(file, &fine, &cage);
    subdiv_mesh_free(&fine);
    opt.limit = 1;
    CHECK_EQUAL(subdiv_refine(&fine, &cage, LEVELS, &opt), SUBDIV_OK);
    if (!test_bad) check_positions(file, "limit", &fine, mesh_extent(&cage));
    if (file) fclose(file);
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&cage);
}

// Every cage that the list names counts as a test of its own; this one sees that none got lost.
static void test_all_cages_are_there(void)
{
    CHECK(test_passed + test_failed >= LEAST_CAGES);
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : "tests/oracle";
    char path[512], name[64];
    snprintf(path, sizeof path, "%s/list.txt", directory);
    FILE *list = fopen(path, "r");
    while (list && fscanf(list, "%63s", name) == 1) {
        test_bad = 0;
        test_context = name;
        check_cage(directory, name);
        if (test_bad) test_failed++;
        else test_passed++;
    }
    if (list) fclose(list);
    RUN(test_all_cages_are_there);
    return test_end("recorded");
}
