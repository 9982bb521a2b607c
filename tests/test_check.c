// What subdiv_check finds: every finding against plain loops over all faces, and the words. And
// the counts of subdiv_inspect.
//
//     cc -I. tests/test_check.c -o build/test_check -lm && build/test_check

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/random_cage.h"
#include "lib/test.h"

enum { MAX_FINDINGS = 4096 };

typedef struct item {                 // a finding
    int  kind, face, other_face, vertex, other_vertex;
    char text[256];
} item;

typedef struct findings {
    int  count;
    item list[MAX_FINDINGS];
} findings;

static void add(findings *to, int kind, int face, int other_face, int vertex, int other_vertex)
{
    if (to->count == MAX_FINDINGS) abort();
    item *i = &to->list[to->count++];
    i->kind = kind;
    i->face = face;
    i->other_face = other_face;
    i->vertex = vertex;
    i->other_vertex = other_vertex;
    i->text[0] = 0;
}

static void keep(void *user, const subdiv_finding *f)
{
    findings *to = (findings *)user;
    add(to, f->kind, f->face, f->other_face, f->vertex, f->other_vertex);
    strcpy(to->list[to->count - 1].text, f->text);
}

// ------------------------------------------------------------------------------------ the oracle

static int at(const subdiv_mesh *m, int f, int i)
{
    int size = face_size(m, f);
    return face_vertices(m, f)[(i + size) % size];
}

typedef struct uses {                 // of an edge by faces
    int count, faces[64];             // times in all; the faces, each once
    int face_count, forward, twice;   // times from the lower end; a face has it more than once
} uses;

static uses uses_of(const subdiv_mesh *m, int a, int b)
{
    uses u = {0};
    const int *v = m->face_vertices;
    for (int f = 0; f < m->face_count; v += face_size(m, f++)) {
        int here = 0;
        for (int i = 0; i < face_size(m, f); i++) {
            int p = v[i], q = v[(i + 1) % face_size(m, f)];
            if (!(p == a && q == b) && !(p == b && q == a)) continue;
            u.forward += p < q;
            here++;
        }
        if (here && u.face_count < 64) u.faces[u.face_count++] = f;
        if (here > 1) u.twice = 1;
        u.count += here;
    }
    return u;
}

static int is_manifold_edge(const uses *u, int a, int b)
{
    return a != b && (u->count == 1 ||
                      (u->count == 2 && !u->twice && u->forward == 1));
}

// Is there no edge a-b before this place of this face?
static int is_first_use(const subdiv_mesh *m, int face, int place, int a, int b)
{
    for (int f = 0; f <= face; f++)
        for (int i = 0; i < (f < face ? face_size(m, f) : place); i++)
            if ((at(m, f, i) == a && at(m, f, i + 1) == b) ||
                (at(m, f, i) == b && at(m, f, i + 1) == a)) return 0;
    return 1;
}

static void expect_edges(const subdiv_mesh *m, findings *all, int flipped)
{
    for (int f = 0; f < m->face_count; f++) {
        for (int i = 0; i < face_size(m, f); i++) {
            int p = at(m, f, i), q = at(m, f, i + 1), a = p < q ? p : q, b = p < q ? q : p;
            uses u = uses_of(m, a, b);
            if (a == b || !is_first_use(m, f, i, a, b)) continue;
            if (!flipped && u.face_count > 2)
                add(all, SUBDIV_ODD_NONMANIFOLD_EDGE, u.faces[0], u.faces[1], a, b);
            if (flipped && u.count == 2 && u.face_count == 2 && u.forward != 1)
                add(all, SUBDIV_ODD_FLIPPED_FACE, u.faces[0], u.faces[1], a, b);
        }
    }
}

// Colours the face-vertices at v by fans: two that share an edge at v get the same.
static void expect_vertices(const subdiv_mesh *m, findings *all)
{
    for (int v = 0; v < m->vertex_count; v++) {
        int n = 0, faces[128], sides[128][2], fan[128], fans = 0, first[2] = {-1, -1}, good = 1;
        for (int f = 0; f < m->face_count; f++) {
            for (int i = 0; i < face_size(m, f); i++) {
                if (at(m, f, i) != v || n == 128) continue;
                faces[n] = f;
                sides[n][0] = at(m, f, i - 1);
                sides[n][1] = at(m, f, i + 1);
                fan[n] = n;
                n++;
            }
        }
        for (int i = 0; i < n && good; i++)
            for (int k = 0; k < 2 && good; k++) {
                uses u = uses_of(m, v, sides[i][k]);
                good = is_manifold_edge(&u, v, sides[i][k]);
            }
        if (!good) continue;
        for (int round = 0; round < n; round++)
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++)
                    if ((sides[i][0] == sides[j][1] || sides[i][1] == sides[j][0]) &&
                        fan[j] < fan[i]) fan[i] = fan[j];
        for (int i = 0; i < n; i++) {
            if (fan[i] != i) continue;
            if (fans < 2) first[fans] = faces[i];
            fans++;
        }
        if (fans > 1) add(all, SUBDIV_ODD_NONMANIFOLD_VERTEX, first[0], first[1], v, -1);
    }
}

static int how_often(const subdiv_mesh *m, int f, int v)
{
    int count = 0;
    for (int i = 0; i < face_size(m, f); i++) count += at(m, f, i) == v;
    return count;
}

static void expect_duplicates(const subdiv_mesh *m, findings *all)
{
    for (int f = 0; f < m->face_count; f++) {
        for (int g = 0; g < f; g++) {
            int same = face_size(m, f) == face_size(m, g);
            for (int i = 0; i < face_size(m, f) && same; i++)
                same = how_often(m, f, at(m, f, i)) == how_often(m, g, at(m, f, i));
            if (!same) continue;
            add(all, SUBDIV_ODD_DUPLICATE_FACE, f, g, -1, -1);
            break;
        }
    }
}

static void expect_repeated(const subdiv_mesh *m, findings *all)
{
    for (int f = 0; f < m->face_count; f++) {
        int size = face_size(m, f), row = -1, edge[2] = {-1, -1}, vertex = -1;
        for (int i = size - 1; i >= 0; i--) {
            int a = at(m, f, i), b = at(m, f, i + 1);
            if (a == b) row = a;
            for (int j = 0; j < size; j++) {
                if (j == i || a == b) continue;
                if (!(at(m, f, j) == a && at(m, f, j + 1) == b) &&
                    !(at(m, f, j) == b && at(m, f, j + 1) == a)) continue;
                // The first edge that the face has met before.
                if (j < i) edge[0] = a < b ? a : b, edge[1] = a < b ? b : a;
            }
        }
        for (int i = 0; i < size && vertex < 0; i++)
            for (int j = 0; j < i; j++) if (at(m, f, i) == at(m, f, j)) vertex = at(m, f, i);
        if (row >= 0) add(all, SUBDIV_ODD_REPEATED_VERTEX, f, -1, row, -1);
        else if (edge[0] >= 0) add(all, SUBDIV_ODD_REPEATED_VERTEX, f, -1, edge[0], edge[1]);
        else if (vertex >= 0) add(all, SUBDIV_ODD_REPEATED_VERTEX, f, -1, vertex, -1);
    }
}

// Triangles from the mean of the vertices add up to nothing.
static int has_no_area(const subdiv_mesh *m, int f)
{
    int size = face_size(m, f);
    double o[3] = {0}, n[3] = {0};
    for (int i = 0; i < size; i++)
        for (int k = 0; k < 3; k++) o[k] += m->positions[3 * at(m, f, i) + k] / (double)size;
    for (int i = 0; i < size; i++) {
        const float *p = m->positions + 3 * at(m, f, i), *q = m->positions + 3 * at(m, f, i + 1);
        for (int k = 0; k < 3; k++) {
            int j = (k + 1) % 3, l = (k + 2) % 3;
            n[k] += (p[j] - o[j]) * (q[l] - o[l]) - (p[l] - o[l]) * (q[j] - o[j]);
        }
    }
    return fabs(n[0]) + fabs(n[1]) + fabs(n[2]) < 1e-9;
}

static void expect_vertices_alone(const subdiv_mesh *m, findings *all)
{
    for (int f = 0; f < m->face_count; f++)
        if (has_no_area(m, f)) add(all, SUBDIV_ODD_NO_AREA, f, -1, -1, -1);
    for (int v = 0; v < m->vertex_count; v++) {
        int used = 0;
        for (int f = 0; f < m->face_count; f++) used |= face_has(m, f, v);
        if (!used) add(all, SUBDIV_ODD_UNUSED_VERTEX, -1, -1, v, -1);
    }
    for (int v = 0; v < m->vertex_count; v++) {
        const float *p = m->positions + 3 * v, *q = m->positions;
        int w = 0;
        while (!(p[0] == q[0] && p[1] == q[1] && p[2] == q[2])) q += 3, w++;
        if (w < v) add(all, SUBDIV_ODD_SAME_PLACE, -1, -1, v, w);
    }
}

static void expect_lists(const subdiv_mesh *m, findings *all)
{
    for (int i = 0; i < m->crease_count; i++) {
        const int *e = m->crease_vertices + 2 * i;
        if (uses_of(m, e[0], e[1]).count == 0)
            add(all, SUBDIV_ODD_STRAY_CREASE, -1, -1, e[0], e[1]);
    }
    for (int i = 0; i < m->crease_count; i++) {
        const int *e = m->crease_vertices + 2 * i;
        int a = e[0] < e[1] ? e[0] : e[1], b = e[0] < e[1] ? e[1] : e[0], twice = 0;
        for (int j = 0; j < i; j++) {
            const int *d = m->crease_vertices + 2 * j;
            twice |= (d[0] == a && d[1] == b) || (d[0] == b && d[1] == a);
        }
        if (twice && uses_of(m, a, b).count) add(all, SUBDIV_ODD_LISTED_TWICE, -1, -1, a, b);
    }
    for (int i = 0; i < m->corner_count; i++)
        for (int j = 0; j < i; j++) {
            if (m->corner_vertices[i] != m->corner_vertices[j]) continue;
            add(all, SUBDIV_ODD_LISTED_TWICE, -1, -1, m->corner_vertices[i], -1);
            break;
        }
    for (int i = 0; i < m->hole_count; i++)
        for (int j = 0; j < i; j++) {
            if (m->holes[i] != m->holes[j]) continue;
            add(all, SUBDIV_ODD_LISTED_TWICE, m->holes[i], -1, -1, -1);
            break;
        }
}

static void expect_uvs(const subdiv_mesh *m, findings *all)
{
    for (int f = 0; f < m->face_count && m->uv_count; f++) {
        const int *uv = m->face_uvs + (face_vertices(m, f) - m->face_vertices);
        int none = 0, size = face_size(m, f);
        for (int i = 0; i < size; i++) none += uv[i] == -1;
        if (none && none < size) add(all, SUBDIV_ODD_PARTIAL_UVS, f, -1, -1, -1);
    }
}

static void expect_all(const subdiv_mesh *m, findings *all)
{
    all->count = 0;
    expect_edges(m, all, 0);
    expect_edges(m, all, 1);
    expect_vertices(m, all);
    expect_duplicates(m, all);
    expect_repeated(m, all);
    expect_vertices_alone(m, all);
    expect_lists(m, all);
    expect_uvs(m, all);
}

// -------------------------------------------------------------------------------- random cages

// Adds what random cages do not have: vertices in one place, entries listed twice, faces turned
// around and repeated, vertices repeated apart from each other, UVs.
static void add_oddities(random_cage *c, int *face_uvs, float *uvs)
{
    subdiv_mesh *m = &c->mesh;
    for (int i = random_below(c, 3); i > 0; i--) {
        float *p = c->positions + 3 * random_below(c, m->vertex_count);
        memcpy(p, c->positions + 3 * random_below(c, m->vertex_count), 3 * sizeof(float));
        if (random_chance(c, 50)) p[0] = -0.0f, c->positions[3 * random_below(c, 3)] = 0;
    }
    for (int i = random_below(c, 3); i > 0 && m->crease_count; i--) {
        int *e = m->crease_vertices + 2 * random_below(c, m->crease_count);
        int *d = m->crease_vertices + 2 * random_below(c, m->crease_count);
        d[0] = e[1], d[1] = e[0];
    }
    if (m->corner_count && random_chance(c, 50))
        m->corner_vertices[0] = m->corner_vertices[m->corner_count - 1];
    if (m->hole_count && random_chance(c, 50)) m->holes[0] = m->holes[m->hole_count - 1];
    for (int i = random_below(c, 4); i > 0 && m->face_count; i--) {
        int f = random_below(c, m->face_count), g = random_below(c, m->face_count);
        int size = face_size(m, f);
        int *to = m->face_vertices + (face_vertices(m, g) - m->face_vertices);
        if (size != face_size(m, g)) continue;
        int turn = random_below(c, size), back = random_chance(c, 50), from[RANDOM_MAX_SIZE];
        for (int k = 0; k < size; k++) from[k] = at(m, f, k);
        for (int k = 0; k < size; k++) to[k] = from[(turn + (back ? size - 1 - k : k)) % size];
    }
    for (int i = random_below(c, 3); i > 0 && m->face_count; i--) {
        int f = random_below(c, m->face_count), size = face_size(m, f);
        int *v = m->face_vertices + (face_vertices(m, f) - m->face_vertices);
        v[random_below(c, size)] = v[random_below(c, size)];
    }
    m->uv_count = random_chance(c, 50) ? 5 : 0;
    m->uvs = uvs;
    m->face_uvs = face_uvs;
    for (int i = 0; i < face_vertex_count(m); i++)
        face_uvs[i] = random_chance(c, 3) ? -1 : random_below(c, 5);
}

static void check_cage(const subdiv_mesh *m, int found[SUBDIV_ODDITY_COUNT])
{
    static findings expected, given;
    int counts[SUBDIV_ODDITY_COUNT], kinds[SUBDIV_ODDITY_COUNT] = {0};
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    expect_all(m, &expected);
    given.count = 0;
    CHECK_EQUAL(subdiv_check(counts, m, keep, &given, &opt), SUBDIV_OK);
    CHECK_EQUAL(error.warning_count, 0);
    CHECK_EQUAL(given.count, expected.count);
    for (int i = 0; i < given.count && i < expected.count; i++) {
        const item *a = &given.list[i], *b = &expected.list[i];
        if (a->kind != b->kind || a->face != b->face || a->other_face != b->other_face ||
            a->vertex != b->vertex || a->other_vertex != b->other_vertex) {
            TEST_REPORT("%s: not kind %d, faces %d %d, vertices %d %d", a->text, b->kind, b->face,
                        b->other_face, b->vertex, b->other_vertex);
            return;
        }
        kinds[a->kind]++;
    }
    for (int k = 0; k < SUBDIV_ODDITY_COUNT; k++) {
        CHECK_EQUAL(counts[k], kinds[k]);
        found[k] += kinds[k];
    }
    CHECK_EQUAL(subdiv_check(NULL, m, NULL, NULL, NULL), SUBDIV_OK);
}

static void test_random_cages(void)
{
    static int face_uvs[RANDOM_MAX_FACES * RANDOM_MAX_SIZE];
    static float uvs[10];
    int found[SUBDIV_ODDITY_COUNT] = {0};
    for (unsigned seed = 0; seed < 300; seed++) {
        char name[32];
        snprintf(name, sizeof name, "seed %u", seed);
        test_context = name;
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        if (!c) return;
        check_cage(&c->mesh, found);
        add_oddities(c, face_uvs, uvs);
        check_cage(&c->mesh, found);
        random_cage_free(c);
    }
    for (int k = 0; k < SUBDIV_ODDITY_COUNT; k++) {
        char name[32];
        snprintf(name, sizeof name, "kind %d", k);
        test_context = name;
        CHECK(found[k] >= 30);
    }
}

// Nothing is odd about what is closed, or has a boundary, as it should be.
static void test_nothing_odd(void)
{
    static test_cage c;
    int found[SUBDIV_ODDITY_COUNT] = {0};
    build_torus(&c, SUBDIV_CATMULL_CLARK, 5, 6);
    check_cage(&c.mesh, found);
    build_icosahedron(&c, SUBDIV_LOOP);
    check_cage(&c.mesh, found);
    build_grid(&c, SUBDIV_CATMULL_CLARK, 4, 3);
    cage_crease(&c, 1, 2, 3);
    cage_corner(&c, 5, 1);
    cage_hole(&c, 0);
    check_cage(&c.mesh, found);
    build_prism(&c, 9);
    c.mesh.scheme = SUBDIV_LOOP;                    // refinement would ask for triangles
    check_cage(&c.mesh, found);
    build_pillow(&c, SUBDIV_CATMULL_CLARK);
    check_cage(&c.mesh, found);
    for (int k = 0; k < SUBDIV_ODDITY_COUNT; k++) CHECK_EQUAL(found[k], 0);
}

// ------------------------------------------------------------------------------------- the counts

// Fans of faces, edges and sharp edges at a vertex, and what there is among the edges.
typedef struct around {
    int faces, edges, boundary, nonmanifold, fans;
} around;

static around look_around(const subdiv_mesh *m, int v)
{
    around a = {0, 0, 0, 0, 0};
    int sides[128][2], fan[128];
    for (int f = 0; f < m->face_count; f++) {
        for (int i = 0; i < face_size(m, f); i++) {
            if (at(m, f, i) != v || a.faces == 128) continue;
            sides[a.faces][0] = at(m, f, i - 1);
            sides[a.faces][1] = at(m, f, i + 1);
            fan[a.faces] = a.faces;
            a.faces++;
        }
    }
    for (int w = 0; w < m->vertex_count; w++) {
        uses u = uses_of(m, v, w);
        if (u.count == 0) continue;
        a.edges++;
        a.boundary += u.count == 1;
        a.nonmanifold += !is_manifold_edge(&u, v, w);
    }
    for (int round = 0; round < a.faces; round++)
        for (int i = 0; i < a.faces; i++)
            for (int j = 0; j < a.faces; j++)
                if ((sides[i][0] == sides[j][1] || sides[i][1] == sides[j][0]) && fan[j] < fan[i])
                    fan[i] = fan[j];
    for (int i = 0; i < a.faces; i++) a.fans += fan[i] == i;
    return a;
}

static int count_components(const subdiv_mesh *m)
{
    int *piece = int_array(m->vertex_count, -1), count = 0;
    for (int f = 0; f < m->face_count; f++) {
        if (piece[at(m, f, 0)] >= 0) continue;
        piece[at(m, f, 0)] = count++;
        for (int grown = 1; grown;) {
            grown = 0;
            for (int g = 0; g < m->face_count; g++) {
                int known = -1;
                for (int i = 0; i < face_size(m, g); i++)
                    if (piece[at(m, g, i)] >= 0) known = piece[at(m, g, i)];
                for (int i = 0; i < face_size(m, g) && known >= 0; i++) {
                    grown |= piece[at(m, g, i)] < 0;
                    piece[at(m, g, i)] = known;
                }
            }
        }
    }
    free(piece);
    return count;
}

static void expect_info(const subdiv_mesh *m, subdiv_info *info)
{
    edge_list edges = edges_make(m);
    memset(info, 0, sizeof *info);
    info->vertex_count = m->vertex_count;
    info->edge_count = edges.count;
    info->face_count = m->face_count;
    info->component_count = count_components(m);
    for (int f = 0; f < m->face_count; f++) {
        int size = face_size(m, f);
        info->triangle_count += size == 3;
        info->quad_count += size == 4;
        info->ngon_count += size > 4;
        if (size > info->max_face_size) info->max_face_size = size;
        info->hole_count += is_hole(m, f);
    }
    for (int e = 0; e < edges.count; e++) {
        int a = edges.ends[2 * e], b = edges.ends[2 * e + 1];
        uses u = uses_of(m, a, b);
        int manifold = is_manifold_edge(&u, a, b);
        float s = crease_sharpness(m, a, b);
        info->boundary_edge_count += u.count == 1;
        info->nonmanifold_edge_count += !manifold;
        info->crease_count += s > 0;
        info->infinite_crease_count += s >= SUBDIV_INFINITE;
    }
    for (int v = 0; v < m->vertex_count; v++) {
        around a = look_around(m, v);
        int odd = a.nonmanifold || a.fans > 1, regular = m->scheme == SUBDIV_LOOP ? 6 : 4;
        info->isolated_vertex_count += a.faces == 0;
        info->nonmanifold_vertex_count += odd;
        info->extraordinary_vertex_count += a.faces && !odd && !a.boundary && a.edges != regular;
        info->corner_count += corner_sharpness(m, v) > 0;
        if (a.edges > info->max_valence) info->max_valence = a.edges;
    }
    edges_free(&edges);
}

// The counts of random cages against plain loops; every other one gets a vertex without faces, and
// a crease that is no edge.
static void test_counts(void)
{
    for (unsigned seed = 0; seed < 300; seed++) {
        char name[32];
        snprintf(name, sizeof name, "seed %u", seed);
        test_context = name;
        random_cage *c = random_cage_new(seed, RANDOM_ALL & ~RANDOM_DEGENERATE);
        if (!c) return;
        subdiv_mesh *m = &c->mesh;
        if (seed % 2 && m->vertex_count < RANDOM_MAX_VERTICES) {
            m->vertex_count++;
            if (m->crease_count) m->crease_vertices[0] = m->vertex_count - 1;
        }
        subdiv_info expected, info;
        expect_info(m, &expected);
        CHECK_EQUAL(subdiv_inspect(&info, m, NULL), SUBDIV_OK);
        const int *a = &info.vertex_count, *b = &expected.vertex_count;
        for (size_t i = 0; i < sizeof info / sizeof *a; i++)
            if (a[i] != b[i]) TEST_REPORT("count %d is %d, not %d", (int)i, a[i], b[i]);
        random_cage_free(c);
    }
}

// ------------------------------------------------------------------------------------- the words

static findings words;

static void expect_text(int kind, const char *text)
{
    for (int i = 0; i < words.count; i++)
        if (words.list[i].kind == kind && strcmp(words.list[i].text, text) == 0) return;
    TEST_REPORT("no finding says \"%s\"", text);
    for (int i = 0; i < words.count; i++) TEST_REPORT("there is \"%s\"", words.list[i].text);
}

static void say(const test_cage *c, int count)
{
    words.count = 0;
    CHECK_EQUAL(subdiv_check(NULL, &c->mesh, keep, &words, NULL), SUBDIV_OK);
    CHECK_EQUAL(words.count, count);
}

static void test_words(void)
{
    static test_cage c;
    build_fins(&c, SUBDIV_CATMULL_CLARK, 3, 1);
    say(&c, 1);
    expect_text(SUBDIV_ODD_NONMANIFOLD_EDGE, "edge 0-1 has 3 faces: 0, 1, 2");
    build_fins(&c, SUBDIV_CATMULL_CLARK, 12, 1);
    say(&c, 1);
    expect_text(SUBDIV_ODD_NONMANIFOLD_EDGE, "edge 0-1 has 12 faces: 0, 1, 2, 3, 4, 5, 6, 7, ...");
    build_fins(&c, SUBDIV_CATMULL_CLARK, 8, 1);
    say(&c, 1);
    expect_text(SUBDIV_ODD_NONMANIFOLD_EDGE, "edge 0-1 has 8 faces: 0, 1, 2, 3, 4, 5, 6, 7");
    build_fins(&c, SUBDIV_CATMULL_CLARK, 2, 1);     // both run from 0 to 1
    say(&c, 1);
    expect_text(SUBDIV_ODD_FLIPPED_FACE, "faces 0 and 1 run along edge 0-1 in the same direction");
    build_bow_tie(&c, SUBDIV_CATMULL_CLARK);
    say(&c, 1);
    expect_text(SUBDIV_ODD_NONMANIFOLD_VERTEX,
                "the faces at vertex 0 form 2 fans, one with face 0, one with face 1");
    build_pillow(&c, SUBDIV_LOOP);
    say(&c, 1);
    expect_text(SUBDIV_ODD_DUPLICATE_FACE, "face 1 has the same vertices as face 0");

    const int row[] = {0, 1, 1, 2}, edge[] = {3, 4, 5, 4}, apart[] = {6, 7, 8, 6, 9, 7, 10};
    const int line[] = {11, 12, 13};
    cage_clear(&c, SUBDIV_CATMULL_CLARK);
    for (int v = 0; v < 11; v++) cage_vertex(&c, v, v * v % 7, v * v % 5);
    for (int v = 0; v < 4; v++) cage_vertex(&c, 0, 0, v % 3 - 0.5);
    cage_face(&c, 4, row);
    cage_face(&c, 4, edge);
    cage_face(&c, 7, apart);
    cage_face(&c, 3, line);
    cage_crease(&c, 0, 2, 1);
    cage_crease(&c, 5, 9, 1);
    cage_crease(&c, 2, 0, 1);
    cage_corner(&c, 8, 1);
    cage_corner(&c, 8, 1);
    cage_hole(&c, 1);
    cage_hole(&c, 0);
    cage_hole(&c, 1);
    int face_uvs[18] = {0, 0, -1, 0, -1, -1, -1, -1};
    float uv[2] = {0, 0};
    c.mesh.uv_count = 1;
    c.mesh.uvs = uv;
    c.mesh.face_uvs = face_uvs;
    say(&c, 14);
    expect_text(SUBDIV_ODD_REPEATED_VERTEX, "face 0 has vertex 1 twice in a row");
    expect_text(SUBDIV_ODD_REPEATED_VERTEX, "face 1 has edge 4-5 more than once");
    expect_text(SUBDIV_ODD_REPEATED_VERTEX, "face 2 has vertex 6 more than once");
    expect_text(SUBDIV_ODD_NONMANIFOLD_VERTEX,
                "the faces at vertex 6 form 2 fans, one with face 2, one with face 2");
    expect_text(SUBDIV_ODD_NONMANIFOLD_VERTEX,
                "the faces at vertex 7 form 2 fans, one with face 2, one with face 2");
    expect_text(SUBDIV_ODD_NO_AREA, "face 1 has no area");
    expect_text(SUBDIV_ODD_NO_AREA, "face 3 has no area");
    expect_text(SUBDIV_ODD_UNUSED_VERTEX, "no face has vertex 14");
    expect_text(SUBDIV_ODD_SAME_PLACE, "vertex 14 is at the same place as vertex 11");
    expect_text(SUBDIV_ODD_STRAY_CREASE, "crease 1: no edge joins vertices 5 and 9");
    expect_text(SUBDIV_ODD_LISTED_TWICE, "creases 0 and 2 are both edge 0-2");
    expect_text(SUBDIV_ODD_LISTED_TWICE, "corners 0 and 1 are both vertex 8");
    expect_text(SUBDIV_ODD_LISTED_TWICE, "holes 0 and 2 are both face 1");
    expect_text(SUBDIV_ODD_PARTIAL_UVS, "face 0 has UVs at 3 of its 4 vertices");
}

// --------------------------------------------------------------------------------- a sea of odds

// As many as n of each kind, which squares would make endless.
static void check_sea(int n, const int *face, int size, int expected_kind, int expected)
{
    int counts[SUBDIV_ODDITY_COUNT];
    subdiv_mesh m = {0};
    m.vertex_count = n;
    m.positions = (float *)calloc((size_t)n * 3, sizeof(float));
    m.face_count = n / size;
    m.face_size = size;
    m.face_vertices = int_array(n, 0);
    for (int i = 0; i < n; i++) m.face_vertices[i] = face ? face[i % size] : i;
    m.crease_count = n / 2;
    m.crease_vertices = int_array(n, 1);
    m.crease_sharpness = (float *)calloc((size_t)n, sizeof(float));
    m.corner_count = n;
    m.corner_vertices = int_array(n, 2);
    m.corner_sharpness = m.crease_sharpness;
    m.hole_count = n;
    m.holes = int_array(n, 0);
    CHECK_EQUAL(subdiv_check(counts, &m, NULL, NULL, NULL), SUBDIV_OK);
    CHECK_EQUAL(counts[expected_kind], expected);
    CHECK_EQUAL(counts[SUBDIV_ODD_SAME_PLACE], n - 1);
    CHECK(counts[SUBDIV_ODD_LISTED_TWICE] >= 2 * (n - 1));
    free(m.positions);
    free(m.face_vertices);
    free(m.crease_vertices);
    free(m.crease_sharpness);
    free(m.corner_vertices);
    free(m.holes);
}

static void test_a_sea_of_oddities(void)
{
    enum { n = 90000 };
    const int same[] = {0, 1, 2}, point[] = {5, 5, 5, 5}, there_and_back[] = {3, 4, 3, 4};
    int *fan = int_array(n, 0), *zigzag = int_array(n, 0);
    check_sea(n, same, 3, SUBDIV_ODD_DUPLICATE_FACE, n / 3 - 1);
    check_sea(n, point, 4, SUBDIV_ODD_REPEATED_VERTEX, n / 4);
    check_sea(n, there_and_back, 4, SUBDIV_ODD_REPEATED_VERTEX, n / 4);
    check_sea(n, NULL, 3, SUBDIV_ODD_NO_AREA, n / 3);
    for (int i = 0; i < n; i++) fan[i] = i % 3 ? i : 7;         // all at vertex 7
    check_sea(n, fan, n, SUBDIV_ODD_REPEATED_VERTEX, 1);
    for (int i = 0; i < n; i++) zigzag[i] = i & 1;
    check_sea(n, zigzag, n, SUBDIV_ODD_REPEATED_VERTEX, 1);
    free(fan);
    free(zigzag);
}

// --------------------------------------------------------------------------------------- errors

static void test_errors(void)
{
    static test_cage c;
    const struct { int vertex; float x; subdiv_result code; const char *token; } cases[] = {
        {99, 0, SUBDIV_ERROR_INDEX, "99"}, {-1, 0, SUBDIV_ERROR_INDEX, "-1"},
        {0, (float)NAN, SUBDIV_ERROR_NOT_FINITE, "vertex 3"},
        {0, HUGE_VALF, SUBDIV_ERROR_NOT_FINITE, "vertex 3"}
    };
    int counts[SUBDIV_ODDITY_COUNT];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        subdiv_error error = {0};
        subdiv_options opt = {0};
        opt.error = &error;
        build_bow_tie(&c, SUBDIV_CATMULL_CLARK);
        c.face_vertices[0] = cases[i].vertex;
        c.positions[9] = cases[i].x;
        memset(counts, 1, sizeof counts);
        words.count = 0;
        CHECK_EQUAL(subdiv_check(counts, &c.mesh, keep, &words, &opt), cases[i].code);
        CHECK_EQUAL(error.code, cases[i].code);
        CHECK(strstr(error.message, cases[i].token) != NULL);
        CHECK_EQUAL(words.count, 0);
        for (int k = 0; k < SUBDIV_ODDITY_COUNT; k++) CHECK_EQUAL(counts[k], 0);
    }
    build_bow_tie(&c, SUBDIV_CATMULL_CLARK);
    CHECK_EQUAL(subdiv_check(counts, NULL, NULL, NULL, NULL), SUBDIV_ERROR_ARGUMENT);
    c.mesh.uv_count = 1;
    CHECK_EQUAL(subdiv_check(counts, &c.mesh, NULL, NULL, NULL), SUBDIV_ERROR_ARGUMENT);
    c.mesh.uv_count = c.mesh.vertex_count = 0;
    CHECK_EQUAL(subdiv_check(counts, &c.mesh, NULL, NULL, NULL), SUBDIV_ERROR_EMPTY);
}

int main(void)
{
    RUN(test_random_cages);
    RUN(test_nothing_odd);
    RUN(test_counts);
    RUN(test_words);
    RUN(test_a_sea_of_oddities);
    RUN(test_errors);
    return test_end("test_check");
}
