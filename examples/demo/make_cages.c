// Makes the cages of the demo: a little modelling kit (turn a profile, cap it, grow faces out of
// faces, sharpen a rim), then four models built with it.
//
//     cc examples/demo/make_cages.c -o build/make_cages -lm
//     build/make_cages DIRECTORY      writes octopus.obj camera.obj lotus.obj whale.obj
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_VERTICES = 2048, MAX_FACES = 2048, MAX_SHARP = 512 };

typedef struct vec { float x, y, z; } vec;

typedef struct cage {
    int  vertex_count, face_count, crease_count, corner_count;
    vec  position[MAX_VERTICES];
    int  face[MAX_FACES][4];          // the fourth is -1 in triangles
    const char *material[MAX_FACES];
    int  crease[MAX_SHARP][2], corner[MAX_SHARP];
    float crease_sharpness[MAX_SHARP], corner_sharpness[MAX_SHARP];
    int  triangles;                   // cut all quads to come in two
    const char *paint;                // the material of faces to come
} cage;

typedef struct set { int count, face[MAX_FACES]; } set;    // of faces

static const float pi = 3.14159265f;

static vec make(float x, float y, float z)  { vec v = {x, y, z}; return v; }
static vec add(vec a, vec b)                { return make(a.x + b.x, a.y + b.y, a.z + b.z); }
static vec scaled(vec a, float s)           { return make(a.x * s, a.y * s, a.z * s); }
static vec mix(vec a, vec b, float t)       { return add(scaled(a, 1 - t), scaled(b, t)); }
static float length(vec a)                  { return sqrtf(a.x * a.x + a.y * a.y + a.z * a.z); }

static vec cross(vec a, vec b)
{
    return make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// The point at this angle around the y axis; angle 0 is +z, a quarter turn is +x.
static vec around(float angle, float radius, float y)
{
    return make(radius * sinf(angle), y, radius * cosf(angle));
}

// ------------------------------------------------------------------------- the modelling kit

static int vertex(cage *c, vec p)
{
    c->position[c->vertex_count] = p;
    return c->vertex_count++;
}

static int face(cage *c, int v0, int v1, int v2, int v3)
{
    int *f = c->face[c->face_count];
    c->material[c->face_count] = c->paint;
    f[0] = v0;
    f[1] = v1;
    f[2] = v2;
    f[3] = c->triangles ? -1 : v3;
    if (c->triangles && v3 >= 0) {
        c->face_count++;
        return face(c, v0, v2, v3, -1);
    }
    return c->face_count++;
}

static int face_size(const cage *c, int f) { return c->face[f][3] < 0 ? 3 : 4; }

static vec middle(const cage *c, int f)
{
    vec sum = {0, 0, 0};
    for (int i = 0; i < face_size(c, f); i++) sum = add(sum, c->position[c->face[f][i]]);
    return scaled(sum, 1 / (float)face_size(c, f));
}

// The faces whose middle is in a box.
static set faces_in(const cage *c, vec low, vec high)
{
    set s = {0, {0}};
    for (int f = 0; f < c->face_count; f++) {
        vec m = middle(c, f);
        if (m.x >= low.x && m.x <= high.x && m.y >= low.y && m.y <= high.y &&
            m.z >= low.z && m.z <= high.z) s.face[s.count++] = f;
    }
    return s;
}

static set one(int f)
{
    set s = {1, {0}};
    s.face[0] = f;
    return s;
}

static void paint(cage *c, const set *s, const char *material)
{
    for (int i = 0; i < s->count; i++) c->material[s->face[i]] = material;
}

// The edges around a set of faces, in the direction of its faces. Returns how many.
static int rim(const cage *c, const set *s, int (*edge)[2])
{
    int count = 0;
    for (int i = 0; i < s->count; i++) {
        const int *f = c->face[s->face[i]];
        for (int k = 0, n = face_size(c, s->face[i]); k < n; k++) {
            int inside = 0;
            for (int j = 0; j < s->count; j++) {
                const int *g = c->face[s->face[j]];
                for (int l = 0, m = face_size(c, s->face[j]); l < m; l++) {
                    inside |= g[l] == f[(k + 1) % n] && g[(l + 1) % m] == f[k];
                }
            }
            if (inside) continue;
            edge[count][0] = f[k];
            edge[count++][1] = f[(k + 1) % n];
        }
    }
    return count;
}

static void crease(cage *c, int a, int b, float sharpness)
{
    c->crease[c->crease_count][0] = a;
    c->crease[c->crease_count][1] = b;
    c->crease_sharpness[c->crease_count++] = sharpness;
}

static void crease_rim(cage *c, const set *s, float sharpness)
{
    int edge[MAX_SHARP][2], count = rim(c, s, edge);
    for (int i = 0; i < count; i++) crease(c, edge[i][0], edge[i][1], sharpness);
}

static void corner(cage *c, int v, float sharpness)
{
    c->corner[c->corner_count] = v;
    c->corner_sharpness[c->corner_count++] = sharpness;
}

// Grows a set of faces out of the surface: its rim is doubled, and walls join the two. The new rim
// lies where the old one is until it is moved; its vertices are the last ones of the cage.
// Returns the first of them.
static int extrude(cage *c, const set *s)
{
    int edge[MAX_SHARP][2], twin[MAX_VERTICES], first = c->vertex_count, count = rim(c, s, edge);
    memset(twin, -1, sizeof twin);
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 2; k++) {
            int v = edge[i][k];
            if (twin[v] < 0) twin[v] = vertex(c, c->position[v]);
        }
    }
    for (int i = 0; i < s->count; i++) {
        int *f = c->face[s->face[i]];
        for (int k = 0; k < face_size(c, s->face[i]); k++) if (twin[f[k]] >= 0) f[k] = twin[f[k]];
    }
    for (int i = 0; i < count; i++) {
        int a = edge[i][0], b = edge[i][1];
        face(c, a, b, twin[b], twin[a]);
    }
    return first;
}

// Moves all vertices of a set of faces, and scales them about their middle.
static void move(cage *c, const set *s, vec by, vec scale)
{
    int seen[MAX_VERTICES] = {0}, n = 0;
    vec sum = {0, 0, 0};
    for (int pass = 1; pass <= 2; pass++) {
        for (int i = 0; i < s->count; i++) {
            for (int k = 0; k < face_size(c, s->face[i]); k++) {
                int v = c->face[s->face[i]][k];
                vec *p = c->position + v, m = scaled(sum, 1 / (float)(n ? n : 1));
                if (seen[v] == pass) continue;
                seen[v] = pass;
                if (pass == 1) { sum = add(sum, *p); n++; continue; }
                p->x = m.x + by.x + (p->x - m.x) * scale.x;
                p->y = m.y + by.y + (p->y - m.y) * scale.y;
                p->z = m.z + by.z + (p->z - m.z) * scale.z;
            }
        }
    }
}

static void grow(cage *c, const set *s, vec by, float scale)
{
    extrude(c, s);
    move(c, s, by, make(scale, scale, scale));
}

static vec outward(const cage *c, int f)
{
    const int *v = c->face[f];
    vec a = add(c->position[v[2]], scaled(c->position[v[0]], -1));
    vec b = add(c->position[v[face_size(c, f) - 1]], scaled(c->position[v[1]], -1));
    vec n = cross(a, b);
    return scaled(n, 1 / length(n));
}

// A ring of n vertices around the y axis through centre. Returns the first.
static int ring(cage *c, vec centre, float radius, int n, float phase)
{
    for (int k = 0; k < n; k++) {
        vertex(c, add(centre, around(2 * pi * ((float)k + phase) / (float)n, radius, 0)));
    }
    return c->vertex_count - n;
}

// The quads between two rings, the second above the first.
static int band(cage *c, int low, int high, int n)
{
    for (int k = 0, l = 1; k < n; k++, l = (k + 1) % n) {
        face(c, low + k, low + l, high + l, high + k);
    }
    return c->face_count - n;
}

// Closes a ring of 4m vertices by m x m quads that swell by rise: no pole. A rise below 0 closes
// it from below.
static set cap(cage *c, int first, int m, float rise)
{
    int grid[9][9];
    set s = {0, {0}};
    const vec *p = c->position;
    for (int i = 0; i < m; i++) {
        grid[0][i] = first + i;
        grid[i][m] = first + m + i;
        grid[m][m - i] = first + 2 * m + i;
        grid[m - i][0] = first + 3 * m + i;
    }
    for (int j = 1; j < m; j++) {
        for (int i = 1; i < m; i++) {     // a Coons patch between the four sides
            float u = (float)i / (float)m, v = (float)j / (float)m;
            vec across = mix(p[grid[j][0]], p[grid[j][m]], u);
            vec along = mix(p[grid[0][i]], p[grid[m][i]], v);
            vec bilinear = mix(mix(p[grid[0][0]], p[grid[0][m]], u),
                               mix(p[grid[m][0]], p[grid[m][m]], u), v);
            vec q = add(add(across, along), scaled(bilinear, -1));
            q.y += rise * 16 * u * (1 - u) * v * (1 - v);
            grid[j][i] = vertex(c, q);
        }
    }
    for (int j = 0; j < m; j++) {
        for (int i = 0; i < m; i++) {
            int *g = grid[j] + i, *h = grid[j + 1] + i;
            s.face[s.count++] = rise < 0 ? face(c, g[0], h[0], h[1], g[1])
                                         : face(c, g[0], g[1], h[1], h[0]);
        }
    }
    return s;
}

static int save(const cage *c, const char *directory, const char *name, const char *comment)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s.obj", directory, name);
    FILE *file = fopen(path, "w");
    if (!file) { printf("%s: cannot be written\n", path); return 1; }
    fprintf(file, "# %s: %s; made by examples/demo/make_cages.c\n", name, comment);
    for (int v = 0; v < c->vertex_count; v++) {
        vec p = c->position[v];
        fprintf(file, "v %.4g %.4g %.4g\n", (double)p.x, (double)p.y, (double)p.z);
    }
    for (int f = 0; f < c->face_count; f++) {
        if (!f || strcmp(c->material[f], c->material[f - 1]) != 0) {
            fprintf(file, "usemtl %s\n", c->material[f]);
        }
        fputc('f', file);
        for (int i = 0; i < face_size(c, f); i++) fprintf(file, " %d", c->face[f][i] + 1);
        fputc('\n', file);
    }
    for (int i = 0; i < c->crease_count; i++) {
        fprintf(file, "t crease 2/1/0 %d %d %g\n", c->crease[i][0], c->crease[i][1],
                (double)c->crease_sharpness[i]);
    }
    for (int i = 0; i < c->corner_count; i++) {
        fprintf(file, "t corner 1/1/0 %d %g\n", c->corner[i], (double)c->corner_sharpness[i]);
    }
    int failed = fclose(file) != 0;
    printf("%s  %d vertices, %d faces, %d creases, %d corners\n", path, c->vertex_count,
           c->face_count, c->crease_count, c->corner_count);
    return failed;
}

// ------------------------------------------------------------------------------- octopus

// An arm grows from a quad of the skirt: a square tube led by a turtle that turns as it goes, down
// to the floor, along it, and up into a curl. Its lower wall carries suckers.
static void octopus_arm(cage *c, int start, float angle, float lift, float curl, float sway)
{
    enum { STEPS = 10 };
    set tip = one(start);
    int below[STEPS];
    vec p = middle(c, start);
    float pitch = lift, yaw = angle;
    c->paint = "coral";
    for (int i = 0; i < STEPS; i++) {
        float t = ((float)i + 1) / STEPS, thick = 0.27f * (1 - t) + 0.045f;
        pitch += t < 0.25f ? -0.40f : t < 0.5f ? 0.27f : curl * (t - 0.32f);
        yaw += sway * (t < 0.5f ? 1.0f : -0.5f);
        vec ahead = add(scaled(around(yaw, 1, 0), cosf(pitch)), make(0, sinf(pitch), 0));
        vec right = around(yaw + pi / 2, 1, 0), up = cross(ahead, right);
        p = add(p, scaled(ahead, 0.39f * (1 - 0.52f * t)));
        if (p.y < thick + 0.02f && t < 0.6f) p.y = thick + 0.02f;
        extrude(c, &tip);
        for (int k = 0; k < 4; k++) {
            float x = k == 1 || k == 2 ? thick : -thick, y = k >= 2 ? thick : -thick;
            c->position[c->face[start][k]] = add(p, add(scaled(right, x), scaled(up, y)));
        }
        below[i] = c->face_count - 4;
    }
    c->paint = "cream";
    for (int i = 0; i < STEPS; i++) {
        set wall = one(below[i]);
        paint(c, &wall, "cream");
        if (i < 5 || i > 7) continue;
        vec out = outward(c, below[i]);
        grow(c, &wall, scaled(out, 0.02f), 0.68f);
        c->paint = "sucker";          // an inner ring: the rim between two rings comes out round
        grow(c, &wall, scaled(out, -0.01f), 0.6f);
        paint(c, &wall, "sucker");
        c->paint = "cream";
    }
}

static void octopus(cage *c)
{
    static const float profile[][3] = {     // y, radius, z of the rings from below
        {0.16f, 0.62f, 0.0f}, {0.64f, 0.82f, 0.0f}, {1.02f, 0.62f, 0.02f}, {1.44f, 0.72f, 0.0f},
        {1.92f, 0.98f, -0.14f}, {2.42f, 1.06f, -0.34f}, {2.86f, 0.82f, -0.50f}
    };
    static const float arms[8][3] = {       // lift, curl, sway
        {0.10f, 1.9f, -0.17f}, {0.10f, 2.0f, -0.12f}, {0.15f, 1.7f, 0.12f}, {0.30f, 2.2f, 0.10f},
        {0.10f, 1.8f, -0.12f}, {0.35f, 2.1f, -0.10f}, {0.25f, 1.9f, -0.12f}, {0.15f, 1.7f, -0.09f}
    };
    enum { N = 16, RINGS = sizeof profile / sizeof *profile };
    int first[RINGS], bands[RINGS];
    c->paint = "coral";
    for (int i = 0; i < RINGS; i++) {
        first[i] = ring(c, make(0, profile[i][0], profile[i][2]), profile[i][1], N, -0.5f);
        if (i) bands[i] = band(c, first[i - 1], first[i], N);
    }
    cap(c, first[0], N / 4, -0.05f);
    cap(c, first[RINGS - 1], N / 4, 0.34f);
    for (int i = 0; i < 8; i++) {
        octopus_arm(c, bands[1] + 2 * i, 2 * pi * (float)i / 8, arms[i][0], arms[i][1], arms[i][2]);
    }
    for (int i = 0; i < 2; i++) {           // the eyes: a mound, a white, a pupil
        int f = bands[3] + (i ? 14 : 2);
        set eye = one(f);
        vec out = around(i ? -0.55f : 0.55f, 1, 0.10f);
        c->paint = "coral";
        grow(c, &eye, add(scaled(out, 0.14f), make(0, 0.12f, 0)), 1.75f);
        grow(c, &eye, scaled(out, 0.20f), 0.86f);
        c->paint = "white";
        grow(c, &eye, scaled(out, 0.05f), 0.84f);
        grow(c, &eye, scaled(out, 0.05f), 0.72f);
        c->paint = "black";
        grow(c, &eye, scaled(out, 0.03f), 0.60f);
        paint(c, &eye, "black");
    }
}

// -------------------------------------------------------------------------------- camera

// A box whose faces are grids of quads between the given coordinates.
static void box(cage *c, const float *x, int nx, const float *y, int ny, const float *z, int nz)
{
    static int id[16][16][16];
    for (int i = 0; i < nx; i++) for (int j = 0; j < ny; j++) for (int k = 0; k < nz; k++) {
        int inside = i % (nx - 1) && j % (ny - 1) && k % (nz - 1);
        id[i][j][k] = inside ? -1 : vertex(c, make(x[i], y[j], z[k]));
    }
    for (int i = 0; i + 1 < nx; i++) for (int j = 0; j + 1 < ny; j++) {
        int n = nz - 1;
        face(c, id[i][j][n], id[i + 1][j][n], id[i + 1][j + 1][n], id[i][j + 1][n]);
        face(c, id[i][j][0], id[i][j + 1][0], id[i + 1][j + 1][0], id[i + 1][j][0]);
    }
    for (int j = 0; j + 1 < ny; j++) for (int k = 0; k + 1 < nz; k++) {
        int n = nx - 1;
        face(c, id[n][j][k], id[n][j + 1][k], id[n][j + 1][k + 1], id[n][j][k + 1]);
        face(c, id[0][j][k], id[0][j][k + 1], id[0][j + 1][k + 1], id[0][j + 1][k]);
    }
    for (int k = 0; k + 1 < nz; k++) for (int i = 0; i + 1 < nx; i++) {
        int n = ny - 1;
        face(c, id[i][n][k], id[i][n][k + 1], id[i + 1][n][k + 1], id[i + 1][n][k]);
        face(c, id[i][0][k], id[i + 1][0][k], id[i + 1][0][k + 1], id[i][0][k + 1]);
    }
}

// Extrudes the faces of the lens to z, their rim to a circle around the z axis.
static void lens_ring(cage *c, const set *s, float radius, float z, float sharpness)
{
    extrude(c, s);
    for (int i = 0; i < 4 * s->count; i++) {
        vec *p = c->position + c->face[s->face[i / 4]][i % 4];
        float r = sqrtf(p->x * p->x + p->y * p->y);
        *p = r > 0 ? make(p->x * radius / r, p->y * radius / r, z) : make(0, 0, z);
    }
    if (sharpness > 0) crease_rim(c, s, sharpness);
}

static void camera_lens(cage *c, const set *s)
{
    static const struct { float radius, z, sharpness; const char *paint; } rings[] = {
        {0.58f, 0.42f, 10, "chrome"}, {0.58f, 0.60f, 10, "chrome"}, {0.49f, 0.60f, 10, "black"},
        {0.49f, 0.95f, 2, "black"}, {0.53f, 1.05f, 10, "chrome"}, {0.53f, 1.20f, 10, "chrome"},
        {0.45f, 1.20f, 10, "black"}, {0.38f, 1.06f, 10, "black"}, {0.25f, 1.13f, 0, "glass"}
    };
    for (size_t i = 0; i < sizeof rings / sizeof *rings; i++) {
        c->paint = rings[i].paint;
        lens_ring(c, s, rings[i].radius, rings[i].z, rings[i].sharpness);
    }
    paint(c, s, "glass");
}

// The hump above the lens: its four peaks stay crisp for longer than its edges.
static void camera_prism(cage *c, const set *s)
{
    c->paint = "chrome";
    extrude(c, s);
    move(c, s, make(0, 0.42f, 0), make(0.55f, 1, 0.8f));
    crease_rim(c, s, 1.5f);
    for (int i = 0; i < s->count; i++) {
        int peak = -1;
        float farthest = 0;
        for (int k = 0; k < 4; k++) {
            vec p = c->position[c->face[s->face[i]][k]];
            float far = fabsf(p.x) + fabsf(p.z);
            if (far > farthest) { farthest = far; peak = c->face[s->face[i]][k]; }
        }
        corner(c, peak, 3);
    }
}

// A knob: a turned part of its own, standing on the body.
static void knob(cage *c, vec at, float radius, float height, float sharpness)
{
    int a = ring(c, at, radius, 8, 0.5f), b = ring(c, add(at, make(0, height, 0)), radius, 8, 0.5f);
    band(c, a, b, 8);
    set below = cap(c, a, 2, -0.001f), above = cap(c, b, 2, 0.001f);
    crease_rim(c, &below, 10);
    crease_rim(c, &above, sharpness);
}

static void camera(cage *c)
{
    static const float x[] = {-1.75f, -1.15f, -0.68f, 0, 0.68f, 1.15f, 1.75f};
    static const float y[] = {-1.02f, -0.74f, 0, 0.62f, 0.98f}, z[] = {-0.42f, 0.0f, 0.42f};
    c->paint = "chrome";
    box(c, x, 7, y, 5, z, 3);
    set top = faces_in(c, make(-9, 0.97f, -9), make(9, 9, 9));
    set bottom = faces_in(c, make(-9, -9, -9), make(9, -1.01f, 9));
    set leather = faces_in(c, make(-9, -0.74f, -9), make(9, 0.62f, 9));
    set lens = faces_in(c, make(-0.6f, -0.7f, 0.4f), make(0.6f, 0.6f, 9));
    set prism = faces_in(c, make(-0.68f, 0.97f, -9), make(0.68f, 9, 9));
    set window = faces_in(c, make(0.7f, 0.65f, 0.4f), make(1.1f, 0.9f, 9));
    paint(c, &leather, "leather");
    crease_rim(c, &top, 2.5f);
    crease_rim(c, &bottom, 2.5f);
    camera_lens(c, &lens);
    camera_prism(c, &prism);
    grow(c, &window, make(0, 0.03f, 0), 0.55f);
    crease_rim(c, &window, 10);
    c->paint = "black";
    grow(c, &window, make(0, 0, -0.05f), 1);
    crease_rim(c, &window, 10);
    paint(c, &window, "glass");
    c->paint = "chrome";
    knob(c, make(-1.25f, 0.97f, 0), 0.30f, 0.20f, 10);
    knob(c, make(1.30f, 0.97f, 0.05f), 0.26f, 0.16f, 10);
    c->paint = "red";
    knob(c, make(0.88f, 0.97f, 0.12f), 0.11f, 0.14f, 1.5f);
}

// --------------------------------------------------------------------------------- lotus

// A petal: an open sheet of 2 x 4 quads, cupped and rising, with a sharp tip.
static void petal(cage *c, float angle, float reach, float width, float rise, float cup)
{
    static const float wide[] = {0.24f, 0.66f, 1.0f, 0.80f, 0.20f};
    int first = c->vertex_count;
    for (int i = 0; i <= 4; i++) {
        float t = (float)i / 4, tip = i == 4 ? 0.12f * reach : 0;
        float out = 0.22f + reach * t * cosf(rise * t * 0.6f);
        float y = 0.14f + reach * t * sinf(rise * t);
        for (int j = -1; j <= 1; j++) {
            vec p = around(angle, out + (j ? 0 : tip), y + (j ? cup * wide[i] : 0));
            vertex(c, add(p, around(angle + pi / 2, (float)j * width * wide[i], 0)));
        }
    }
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 2; j++) {
            int a = first + 3 * i + j;
            face(c, a, a + 3, a + 4, a + 1);
        }
    }
    corner(c, first + 13, 10);
}

// A round leaf on the water with a notch: 14 of 15 sectors of a disc, its rim a little raised.
static void pad(cage *c, float radius, float turn)
{
    enum { SECTORS = 14, RINGS = 4 };
    static const float reach[RINGS] = {0.12f, 0.5f, 0.9f, 1.0f};
    static const float height[RINGS] = {0.02f, 0, 0.02f, 0.07f};
    int first = c->vertex_count;
    for (int i = 0; i <= SECTORS; i++) {
        float a = turn + 2 * pi * (float)i / (SECTORS + 1);
        for (int j = 0; j < RINGS; j++) vertex(c, around(a, radius * reach[j], height[j]));
    }
    for (int i = 0; i < SECTORS; i++) {
        for (int j = 0; j + 1 < RINGS; j++) {
            int a = first + RINGS * i + j;
            face(c, a, a + 1, a + 1 + RINGS, a + RINGS);
        }
    }
    corner(c, first + RINGS - 1, 10);
    corner(c, first + RINGS * (SECTORS + 1) - 1, 10);
}

static void lotus(cage *c)
{
    static const struct {
        int count;
        float start, reach, width, rise, cup;
        const char *paint;
    } rows[] = {
        {8, 0.5f, 1.42f, 0.46f, 0.34f, 0.14f, "rose"},
        {8, 0.0f, 1.28f, 0.42f, 0.80f, 0.18f, "petal"},
        {7, 0.3f, 1.08f, 0.36f, 1.15f, 0.20f, "blush"}
    };
    for (int r = 0; r < 3; r++) {
        c->paint = rows[r].paint;
        for (int k = 0; k < rows[r].count; k++) {
            petal(c, 2 * pi * ((float)k + rows[r].start) / (float)rows[r].count, rows[r].reach,
                  rows[r].width, rows[r].rise, rows[r].cup);
        }
    }
    c->paint = "yellow";
    int a = ring(c, make(0, 0.14f, 0), 0.12f, 8, 0.5f);
    int b = ring(c, make(0, 0.44f, 0), 0.27f, 8, 0.5f);
    band(c, a, b, 8);
    set top = cap(c, b, 2, 0.05f);
    cap(c, a, 2, -0.02f);
    crease_rim(c, &top, 2);
    c->paint = "leaf";
    pad(c, 1.75f, 0.9f);
}

// --------------------------------------------------------------------------------- whale

enum { AROUND = 12, STATIONS = 11 };

// The hull: stations along z, and AROUND lines that run along it. Every other line is shifted by
// half a station, which makes triangles of valence 6.
static vec hull(float t, int line)
{
    static const float station[STATIONS + 1][4] = {   // z, y, half width, half height
        {2.00f, 0.05f, 0.42f, 0.30f}, {1.60f, 0.02f, 0.78f, 0.62f}, {1.05f, 0.00f, 0.95f, 0.82f},
        {0.45f, 0.00f, 0.98f, 0.86f}, {-0.15f, 0.02f, 0.90f, 0.80f}, {-0.75f, 0.10f, 0.72f, 0.66f},
        {-1.30f, 0.24f, 0.50f, 0.48f}, {-1.80f, 0.46f, 0.30f, 0.31f}, {-2.20f, 0.74f, 0.22f, 0.17f},
        {-2.48f, 1.00f, 0.62f, 0.10f}, {-2.72f, 1.22f, 1.15f, 0.08f}, {-2.78f, 1.36f, 0.80f, 0.03f}
    };
    int i = t >= STATIONS ? STATIONS - 1 : (int)t;
    const float *p = station[i], *q = station[i + 1];
    float s[4], u = t - (float)i, a = 2 * pi * (float)line / AROUND;
    for (int k = 0; k < 4; k++) s[k] = p[k] + u * (q[k] - p[k]);
    float side = fabsf(sinf(a)), sweep = t > 8.5f ? 0.42f * (side - 0.4f) : 0;
    return make(s[2] * sinf(a), s[1] + s[3] * cosf(a) + 0.5f * sweep, s[0] - sweep);
}

// Grows the rhombus of two triangles into a fin.
static void fin(cage *c, int f, int g, int steps, vec by, vec scale)
{
    set root = {2, {0}};
    root.face[0] = f;
    root.face[1] = g;
    for (int i = 0; i < steps; i++) {
        extrude(c, &root);
        move(c, &root, by, scale);
    }
}

static void eye(cage *c, vec at, float r)
{
    int v = vertex(c, add(at, make(0, r, 0)));
    ring(c, at, r, 4, 0);
    vertex(c, add(at, make(0, -r, 0)));
    for (int k = 1, l = 2; k <= 4; k++, l = k % 4 + 1) {
        face(c, v, v + k, v + l, -1);
        face(c, v + 5, v + l, v + k, -1);
    }
}

// Closes an end of the hull: from each line that is not shifted to the next one, over the shifted
// line between them, and to the pole.
static void whale_end(cage *c, const int *line, int pole, int front)
{
    for (int k = 1; k < AROUND; k += 2) {
        int next = (k + 2) % AROUND, between = line[(k + 1) % AROUND];
        int a = line[front ? next : k], b = line[front ? k : next];
        c->paint = front && k == 5 ? "belly" : "blue";
        face(c, a, between, b, -1);
        c->paint = "blue";
        face(c, pole, a, b, -1);
    }
}

static void whale(cage *c)
{
    int first[AROUND], last[AROUND];   // the ends of each line
    int cell[AROUND][STATIONS];        // the first of two triangles
    c->triangles = 1;
    for (int k = 0; k < AROUND; k++) {
        int shifted = k % 2 == 0;
        first[k] = c->vertex_count;
        for (int i = 0; i <= STATIONS - shifted; i++) {
            vertex(c, hull((float)i + (shifted ? 0.5f : 0), k));
        }
        last[k] = c->vertex_count - 1;
    }
    for (int k = 0; k < AROUND; k++) {
        for (int i = 0; i < STATIONS; i++) {
            int shifted = k % 2 == 0, a = first[k] + i, b = first[(k + 1) % AROUND] + i;
            c->paint = k >= 4 && k < 8 && i < 8 ? "belly" : "blue";
            cell[k][i] = face(c, a, b, shifted ? b + 1 : a + 1, -1);
            if (i + 1 < STATIONS) face(c, shifted ? a : b, b + 1, a + 1, -1);
        }
    }
    whale_end(c, first, vertex(c, make(0, 0.05f, 2.22f)), 1);
    whale_end(c, last, vertex(c, make(0, 1.32f, -2.50f)), 0);
    c->paint = "blue";
    fin(c, cell[3][3], cell[3][3] + 1, 3, make(0.34f, -0.12f, -0.16f), make(0.8f, 0.6f, 0.86f));
    fin(c, cell[8][3], cell[8][3] + 1, 3, make(-0.34f, -0.12f, -0.16f), make(0.8f, 0.6f, 0.86f));
    fin(c, cell[11][5] + 1, cell[0][5] + 1, 2, make(0, 0.13f, -0.16f), make(0.4f, 1, 0.7f));
    c->paint = "black";
    eye(c, make(0.81f, -0.10f, 1.32f), 0.13f);
    eye(c, make(-0.81f, -0.10f, 1.32f), 0.13f);
}

int main(int argc, char **argv)
{
    static cage cages[4];
    if (argc != 2) {
        fprintf(stderr, "usage: make_cages DIRECTORY\n");
        return 2;
    }
    const char *directory = argv[1];
    octopus(cages);
    camera(cages + 1);
    lotus(cages + 2);
    whale(cages + 3);
    return save(cages, directory, "octopus", "one closed surface of quads") |
           save(cages + 1, directory, "camera", "quads, with creases of many kinds and corners") |
           save(cages + 2, directory, "lotus", "open sheets, with corners on the boundary") |
           save(cages + 3, directory, "whale", "triangles, for Loop subdivision");
}
