// What holds of any masks: with the header of tests/edited.sh, in which edited() says whether a
// mask gets other weights, for the masks as they are and with one changed at a time.
//
//     edited check FILE EDIT NEVER   checks, and writes points of a few cages to FILE
//     edited moves FILE OTHER CAGE   all points of the cage that the mask is for differ in both
//
// The checks: three times one level is three levels; the limit is where far refinement leads;
// SUBDIV_EXACT agrees with the limit or refuses; the text of subdiv_explain has the weights that
// are added up, and no formula NEVER.
#include <stdlib.h>
#include <string.h>

static const char *edit = "", *never = "";      // the edit; a formula that is not true of its masks

static int edited(const char *name)
{
    return strcmp(edit, name) == 0;
}

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/same.h"
#include "lib/test.h"
#include "lib/three.h"

// ------------------------------------------------------------------------------------ the limit

// Where three numbers lead whose differences shrink by the same factor each time [Aitken].
static double far(double a, double b, double c)
{
    double first = b - a, second = c - b;
    return fabs(first) > 2 * fabs(second) ? c + second * second / (first - second) : c;
}

// The vertices of the cage, as levels 5 to 7 go on and in the limit of level 1.
static void check_limit(const subdiv_mesh *cage)
{
    subdiv_mesh fine[3], limit = {0};
    subdiv_options opt = {0};
    opt.triangulate = 1;
    for (int i = 0; i < 3; i++) CHECK_EQUAL(subdiv_refine(&fine[i], cage, 5 + i, &opt), SUBDIV_OK);
    opt.limit = 1;
    CHECK_EQUAL(subdiv_refine(&limit, cage, 1, &opt), SUBDIV_OK);
    for (int i = 0; i < 3 * cage->vertex_count; i++)
        CHECK_NEAR(far((double)fine[0].positions[i], (double)fine[1].positions[i],
                       (double)fine[2].positions[i]), limit.positions[i], 1e-4 * mesh_reach(cage));
    for (int i = 0; i < 3; i++) subdiv_mesh_free(&fine[i]);
    subdiv_mesh_free(&limit);
}

// Corner 0 of each face of quads or triangles.
static void check_exact(const subdiv_mesh *cage)
{
    subdiv_mesh limit = {0};
    subdiv_surface *surface = NULL;
    subdiv_options opt = {0};
    subdiv_error error = {0};
    opt.error = &error;
    if (subdiv_prepare(&surface, cage, SUBDIV_EXACT, &opt)) {
        CHECK_EQUAL(error.code, SUBDIV_ERROR_ARGUMENT);
        CHECK(strstr(error.message, "mask") != NULL);
        CHECK(surface == NULL);
        return;
    }
    void *scratch = malloc(subdiv_scratch_size(surface, 3) + 1);
    opt.limit = 1;
    CHECK_EQUAL(subdiv_refine(&limit, cage, 1, &opt), SUBDIV_OK);
    CHECK_EQUAL(subdiv_evaluate_begin(surface, 3, cage->positions, 0, scratch, NULL), SUBDIV_OK);
    for (int f = 0, h = 0; f < cage->face_count; f++) {
        subdiv_location corner = { f, 0, 0, 0 };
        subdiv_derivatives out = {0};
        float p[3] = { 0, 0, 0 };
        out.points = p;
        CHECK_EQUAL(subdiv_evaluate_at(surface, 3, scratch, 1, &corner, &out, NULL), SUBDIV_OK);
        for (int k = 0; k < 3; k++)
            CHECK_NEAR(p[k], limit.positions[3 * cage->face_vertices[h] + k], 1e-5 * mesh_reach(cage));
        h += cage->face_size ? cage->face_size : cage->face_sizes[f];
    }
    free(scratch);
    subdiv_surface_free(surface);
    subdiv_mesh_free(&limit);
}

// ----------------------------------------------------------------------------------- explanations

// Adds up the table of weights that explains a point: lines of a weight and its vertices, which may
// go on for more lines.
static void add_up(const char *text, const subdiv_mesh *cage, double *sum, double *weights)
{
    double weight = 0;
    sum[0] = sum[1] = sum[2] = *weights = 0;
    for (const char *line = text; line; line = strchr(line, '\n')) {
        line += *line == '\n';
        size_t blanks = strspn(line, " ");
        const char *vertices = line + blanks;
        char *end = (char *)(size_t)vertices;
        double number = *vertices == '\n' ? 0 : strtod(vertices, &end);
        if (*end == '/') number /= strtod(end + 1, &end);
        end += strspn(end, " ");
        if (strncmp(end, "vert", 4) == 0) {
            weight = number;
            vertices = end + strcspn(end, " \n");
        } else if (blanks < 14) {
            weight = 0;
        }
        for (; weight > 0; vertices = end) {
            while (*vertices == ' ') vertices++;
            if (*vertices < '0' || *vertices > '9') break;
            int v = (int)strtol(vertices, &end, 10);
            for (int k = 0; k < 3; k++) sum[k] += weight * (double)cage->positions[3 * v + k];
            *weights += weight;
        }
    }
}

static void check_explain(const subdiv_mesh *cage)
{
    subdiv_mesh fine = {0};
    char text[8192];
    CHECK_EQUAL(subdiv_refine(&fine, cage, 1, NULL), SUBDIV_OK);
    for (int i = 0; i < fine.vertex_count; i++) {
        double sum[3], weights;
        CHECK_EQUAL(subdiv_explain(text, sizeof text, cage, i, NULL), SUBDIV_OK);
        add_up(text, cage, sum, &weights);
        CHECK(!*never || !strstr(text, never));
        CHECK_NEAR(weights, 1, 1e-5);
        for (int k = 0; k < 3; k++)
            CHECK_NEAR(sum[k], fine.positions[3 * i + k], 1e-5 * mesh_reach(cage));
    }
    subdiv_mesh_free(&fine);
}

// -------------------------------------------------------------------------------------- cages

static void test_random(void)
{
    static char context[64];
    test_context = context;
    for (unsigned seed = 1; seed <= 40; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_MANIFOLD);
        sprintf(context, "random cage %u", seed);
        check_three_times_one(&c->mesh);
        c->mesh.crease_count = c->mesh.corner_count = 0;
        if (c->mesh.face_count <= 16) check_limit(&c->mesh);
        random_cage_free(c);
    }
}

// A prism of so many sides, whose vertices have valence 3, or with triangles for its sides an
// antiprism, with a crease around one end if asked for. No two points have anything in common.
static void build(test_cage *c, subdiv_scheme scheme, int sides, int crease)
{
    int ends[2][12], triangles = scheme == SUBDIV_LOOP || crease == 2;
    cage_clear(c, scheme);
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < sides; i++)
            ends[k][i] = cage_vertex(c, cos(6.2831853 * i / sides) + 0.03 * i + 0.1 * k,
                                     sin(6.2831853 * i / sides) - 0.02 * i, k + 0.01 * i * i);
    int top = cage_vertex(c, 0.1, 0.05, 1.5), bottom = cage_vertex(c, -0.05, 0.1, -0.4);
    for (int i = 0; i < sides; i++) {
        int j = (i + 1) % sides;
        if (triangles) cage_triangle(c, ends[0][i], ends[0][j], ends[1][i]);
        if (triangles) cage_triangle(c, ends[0][j], ends[1][j], ends[1][i]);
        if (!triangles) cage_quad(c, ends[0][i], ends[0][j], ends[1][j], ends[1][i]);
        cage_triangle(c, ends[1][i], ends[1][j], top);
        cage_triangle(c, ends[0][j], ends[0][i], bottom);
        if (crease == 1) cage_crease(c, ends[1][i], ends[1][j], SUBDIV_INFINITE);
    }
    if (crease == 2) c->mesh.triangles = SUBDIV_TRIANGLES_SMOOTH;
}

static const struct { const char *name; subdiv_scheme scheme; int crease; } cages[] = {
    { "smooth", SUBDIV_CATMULL_CLARK, 0 }, { "crease", SUBDIV_CATMULL_CLARK, 1 },
    { "triangles", SUBDIV_CATMULL_CLARK, 2 },
    { "loop", SUBDIV_LOOP, 0 }, { "loop_crease", SUBDIV_LOOP, 1 } };

enum { CAGES = sizeof cages / sizeof *cages };

static void test_cages(void)
{
    static test_cage c;
    for (int i = 0; i < CAGES; i++)
        for (int sides = 3; sides <= 7; sides++) {
            test_context = cages[i].name;
            build(&c, cages[i].scheme, sides, cages[i].crease);
            check_three_times_one(&c.mesh);
            check_limit(&c.mesh);
            check_exact(&c.mesh);
            check_explain(&c.mesh);
        }
}

// A curve of both rules: three levels are three times one, and its vertices, after 12 levels, are at
// the limit. Under Chaikin a vertex goes on as the edge between its two points.
static const float curve[5] = { 0.1f, 2.3f, -1.7f, 5.9f, 0.6f };

static void test_curves(void)
{
    static float fine[5 << 12];
    const subdiv_curve_ends closed = SUBDIV_ENDS_CLOSED;
    subdiv_options opt = {0};
    opt.limit = 1;
    for (int rule = 0; rule < 2; rule++) {
        subdiv_curve_rule r = (subdiv_curve_rule)rule;
        float three[40], once[40], limit[5];
        subdiv_curve(r, closed, 3, 1, 5, curve, 0, three, 0, NULL);
        subdiv_curve(r, closed, 1, 1, 5, curve, 0, once, 0, NULL);
        subdiv_curve(r, closed, 1, 1, 10, once, 0, once, 0, NULL);
        subdiv_curve(r, closed, 1, 1, 20, once, 0, once, 0, NULL);
        CHECK(memcmp(three, once, sizeof once) == 0);
        subdiv_curve(r, closed, 12, 1, 5, curve, 0, fine, 0, NULL);
        subdiv_curve(r, closed, 0, 1, 5, curve, 0, limit, 0, &opt);
        for (int i = 0; i < 5; i++) {
            int middle = (2 * i + 1) << 11;
            double at = rule ? ((double)fine[middle - 1] + (double)fine[middle]) / 2
                             : (double)fine[i << 12];
            CHECK_NEAR(at, limit[i], 1e-3);
        }
    }
}

// ---------------------------------------------------------------------------------- what moves

static int is_on_crease(const subdiv_mesh *cage, int v)
{
    int on = 0;
    for (int i = 0; i < 2 * cage->crease_count; i++) on |= cage->crease_vertices[i] == v;
    return on;
}

// The points of level 3 or, of cages with a crease, its vertices.
static void write_points(FILE *file)
{
    static test_cage c;
    for (int i = 0; i < CAGES; i++) {
        subdiv_mesh fine = {0};
        build(&c, cages[i].scheme, 5, cages[i].crease);
        CHECK_EQUAL(subdiv_refine(&fine, &c.mesh, 3, NULL), SUBDIV_OK);
        for (int v = 0; v < fine.vertex_count; v++)
            if (cages[i].crease != 1 || is_on_crease(&c.mesh, v))
                fprintf(file, "%s %a %a %a\n", cages[i].name, (double)fine.positions[3 * v],
                        (double)fine.positions[3 * v + 1], (double)fine.positions[3 * v + 2]);
        subdiv_mesh_free(&fine);
    }
    float cut[40];
    subdiv_curve(SUBDIV_CURVE_CHAIKIN, SUBDIV_ENDS_CLOSED, 3, 1, 5, curve, 0, cut, 0, NULL);
    for (int i = 0; i < 40; i++) fprintf(file, "chaikin %a 0 0\n", (double)cut[i]);
}

static int count_still(FILE *a, FILE *b, const char *name, int *points)
{
    char x[200], y[200], start[32];
    int still = 0;
    sprintf(start, "%s ", name);
    while (fgets(x, sizeof x, a) && fgets(y, sizeof y, b)) {
        if (strncmp(x, start, strlen(start)) != 0) continue;
        ++*points;
        still += strcmp(x, y) == 0;
    }
    return still;
}

static int check(const char *path)
{
    FILE *file = fopen(path, "w");
    if (!file) return 1;
    RUN(test_random);
    RUN(test_cages);
    RUN(test_curves);
    write_points(file);
    fclose(file);
    return test_end("edited");
}

static int moves(const char *path, const char *other_path, const char *cage)
{
    FILE *file = fopen(path, "r"), *other = fopen(other_path, "r");
    int points = 0, still = file && other ? count_still(file, other, cage, &points) : 0;
    if (file) fclose(file);
    if (other) fclose(other);
    if (still || !points) printf("%d of %d points do not move\n", still, points);
    return still || !points;
}

int main(int count, char **arguments)
{
    if (count != 5) return 1;
    if (strcmp(arguments[1], "moves") == 0)
        return moves(arguments[2], arguments[3], arguments[4]);
    edit = arguments[3];
    never = arguments[4];
    return check(arguments[2]);
}
