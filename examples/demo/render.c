// Draws a mesh: a z-buffer of 3 x 3 samples a pixel, lit by many small lights with a shadow map
// each, which together make soft shadows, ambient occlusion and broad highlights. Each of the nine
// samples of a pixel sees another ninth of the lights; their average sees them all.
#include "render.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum {
    SAMPLES    = 3,                   // per pixel, in x and in y
    GROUPS     = SAMPLES * SAMPLES,
    KEY_LIGHTS = 4 * GROUPS,
    SKY_LIGHTS = 8 * GROUPS,
    LIGHTS     = KEY_LIGHTS + SKY_LIGHTS,
    MAP        = 352,                 // samples of a shadow map in x and in y
    NOTHING    = 255                  // the material of the backdrop
};

// ------------------------------------------------------------------------------- vectors

typedef struct vec { float x, y, z; } vec;

static vec vec_of(const float *p)           { vec v = {p[0], p[1], p[2]}; return v; }
static vec add(vec a, vec b)                { a.x += b.x; a.y += b.y; a.z += b.z; return a; }
static vec scaled(vec a, float s)           { a.x *= s; a.y *= s; a.z *= s; return a; }
static vec sub(vec a, vec b)                { return add(a, scaled(b, -1)); }
static float dot(vec a, vec b)              { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vec combine(vec a, float s, vec b, float t, vec c, float u)
{
    return add(add(scaled(a, s), scaled(b, t)), scaled(c, u));
}

static vec cross(vec a, vec b)
{
    vec v = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    return v;
}

static vec unit(vec a)
{
    float length = sqrtf(dot(a, a));
    return length > 0 ? scaled(a, 1 / length) : a;
}

// --------------------------------------------------------------------- edges and normals

// One side of an edge: a face-vertex whose edge runs to the next one; or an entry of the crease
// list, which has no face-vertex. Sorted, the sides of an edge are neighbours.
typedef struct side {
    int   low, high;                  // the ends
    int   here, next;                 // the face-vertices at the start and the end, or -1
    float sharpness;
} side;

static int compare_sides(const void *a, const void *b)
{
    const side *s = a, *t = b;
    if (s->low != t->low) return s->low < t->low ? -1 : 1;
    if (s->high != t->high) return s->high < t->high ? -1 : 1;
    return (s->here > t->here) - (s->here < t->here);
}

static side side_of(int a, int b, int here, int next, float sharpness)
{
    side s = {a < b ? a : b, a < b ? b : a, here, next, sharpness};
    return s;
}

static int face_size(const subdiv_mesh *mesh, int face)
{
    return mesh->face_size ? mesh->face_size : mesh->face_sizes[face];
}

static int count_face_vertices(const subdiv_mesh *mesh)
{
    int count = 0;
    for (int f = 0; f < mesh->face_count; f++) count += face_size(mesh, f);
    return count;
}

static side *sorted_sides(const subdiv_mesh *mesh, int *count)
{
    int face_vertices = count_face_vertices(mesh), k = 0;
    *count = face_vertices + mesh->crease_count;
    side *sides = malloc(((size_t)*count + 1) * sizeof *sides);
    if (!sides) return NULL;
    for (int f = 0; f < mesh->face_count; f++) {
        int size = face_size(mesh, f);
        for (int i = 0; i < size; i++) {
            int here = k + i, next = k + (i + 1) % size;
            sides[here] = side_of(mesh->face_vertices[here], mesh->face_vertices[next],
                                  here, next, 0);
        }
        k += size;
    }
    for (int c = 0; c < mesh->crease_count; c++) {
        const int *ends = mesh->crease_vertices + 2 * c;
        sides[k + c] = side_of(ends[0], ends[1], -1, -1, mesh->crease_sharpness[c]);
    }
    qsort(sides, (size_t)*count, sizeof *sides, compare_sides);
    return sides;
}

static int root(int *parent, int i)
{
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

// Twice the area vector of a face that need not be flat.
static vec face_normal(const subdiv_mesh *mesh, const int *face, int size)
{
    vec sum = {0, 0, 0}, origin = vec_of(mesh->positions + 3 * face[0]);
    for (int i = 1; i + 1 < size; i++) {
        vec a = sub(vec_of(mesh->positions + 3 * face[i]), origin);
        vec b = sub(vec_of(mesh->positions + 3 * face[i + 1]), origin);
        sum = add(sum, cross(a, b));
    }
    return sum;
}

// A normal for each face-vertex: the mesh's; or the face's own, or the mean over the faces around
// the vertex that can be reached without crossing a sharp edge.
static vec *face_vertex_normals(const subdiv_mesh *mesh, const side *sides, int side_count,
                                int flat)
{
    int count = count_face_vertices(mesh), k = 0;
    vec *normals = calloc((size_t)count + 1, sizeof *normals);
    int *parent = malloc(((size_t)count + 1) * sizeof *parent);
    if (!normals || !parent) { free(normals); free(parent); return NULL; }
    for (int i = 0; i < count && mesh->normals && !flat; i++) {
        int n = mesh->face_normals ? mesh->face_normals[i] : mesh->face_vertices[i];
        normals[i] = vec_of(mesh->normals + 3 * n);
    }
    if (mesh->normals && !flat) { free(parent); return normals; }
    for (int i = 0; i < count; i++) parent[i] = i;
    for (int i = 0; i + 1 < side_count && !flat; i++) {
        side s = sides[i], t = sides[i + 1];
        int sharp = s.here < 0 || (i && sides[i - 1].here < 0 && sides[i - 1].low == s.low &&
                                   sides[i - 1].high == s.high);
        if (sharp || s.low != t.low || s.high != t.high) continue;
        parent[root(parent, s.here)] = root(parent, t.next);
        parent[root(parent, s.next)] = root(parent, t.here);
    }
    for (int f = 0; f < mesh->face_count; k += face_size(mesh, f), f++) {
        vec n = face_normal(mesh, mesh->face_vertices + k, face_size(mesh, f));
        for (int i = 0; i < face_size(mesh, f); i++) {
            int r = root(parent, k + i);
            normals[r] = add(normals[r], n);
        }
    }
    for (int i = 0; i < count; i++) normals[i] = normals[root(parent, i)];
    for (int i = 0; i < count; i++) normals[i] = unit(normals[i]);
    free(parent);
    return normals;
}

// ---------------------------------------------------------------------------- rasterizing

typedef struct point { float x, y, near; vec normal; } point;  // near: larger is closer

typedef struct target {               // what is nearest at each sample
    int            width, height;
    float         *near;
    vec           *normal;            // NULL in shadow maps
    unsigned char *material;
    unsigned char *line;              // 0, or the number of a pen
} target;

// The first sample at or after x, and the last one at or before it, in a row of so many.
static int first_from(float x, int count)
{
    if (x <= 0) return 0;
    return x >= (float)count ? count : (int)x + ((float)(int)x < x);
}

static int last_until(float x, int count)
{
    if (x < 0) return -1;
    return x >= (float)count ? count - 1 : (int)x;
}

// As fminf and fmaxf, which are slow calls on some machines.
static float least(float a, float b) { return a < b ? a : b; }
static float most(float a, float b)  { return a > b ? a : b; }

static void draw_triangle(target *t, point a, point b, point c, int material)
{
    int x0 = first_from(least(least(a.x, b.x), c.x), t->width);
    int x1 = last_until(most(most(a.x, b.x), c.x), t->width);
    int y0 = first_from(least(least(a.y, b.y), c.y), t->height);
    int y1 = last_until(most(most(a.y, b.y), c.y), t->height);
    float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (x0 > x1 || y0 > y1 || fabsf(area) < 1e-9f) return;
    float ub = (c.y - a.y) / area, vb = (a.x - c.x) / area;   // the weights of b and c are linear
    float uc = (a.y - b.y) / area, vc = (b.x - a.x) / area;
    for (int y = y0; y <= y1; y++) {
        for (int x = x0; x <= x1; x++) {
            float dx = (float)x - a.x, dy = (float)y - a.y;
            float wb = ub * dx + vb * dy, wc = uc * dx + vc * dy, wa = 1 - wb - wc;
            if (wa < -1e-5f || wb < -1e-5f || wc < -1e-5f) continue;
            float near = wa * a.near + wb * b.near + wc * c.near;
            int i = y * t->width + x;
            if (near <= t->near[i]) continue;
            t->near[i] = near;
            if (!t->normal) continue;
            vec n = combine(a.normal, wa * a.near, b.normal, wb * b.near, c.normal, wc * c.near);
            t->normal[i] = scaled(n, area < 0 ? 1.0f : -1.0f);   // toward the eye: y points down
            t->material[i] = (unsigned char)material;
        }
    }
}

// A round-ended stroke where it is not hidden; the surface right under it does not hide it.
static void draw_line(target *t, point a, point b, float width, unsigned char pen)
{
    float r = width / 2, dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
    int x0 = first_from(least(a.x, b.x) - r, t->width);
    int x1 = last_until(most(a.x, b.x) + r, t->width);
    int y0 = first_from(least(a.y, b.y) - r, t->height);
    int y1 = last_until(most(a.y, b.y) + r, t->height);
    for (int y = y0; y <= y1; y++) {
        for (int x = x0; x <= x1; x++) {
            float px = (float)x - a.x, py = (float)y - a.y;
            float s = length2 > 0 ? most(0, least(1, (px * dx + py * dy) / length2)) : 0;
            float ex = px - s * dx, ey = py - s * dy;
            int i = y * t->width + x;
            if (ex * ex + ey * ey > r * r || pen < t->line[i]) continue;
            if ((a.near + s * (b.near - a.near)) * 1.0025f > t->near[i]) t->line[i] = pen;
        }
    }
}

static point project(const render_view *view, vec p)
{
    vec q = sub(p, vec_of(view->eye));
    float near = -1 / dot(q, vec_of(view->back));
    point r = {view->x + view->scale * near * dot(q, vec_of(view->right)),
               view->y - view->scale * near * dot(q, vec_of(view->up)), near, {0, 0, 0}};
    return r;
}

static void draw_faces(target *t, const subdiv_mesh *mesh, const vec *normals,
                       const render_view *view, const render_style *style)
{
    int k = 0;
    for (int f = 0; f < mesh->face_count; k += face_size(mesh, f), f++) {
        int material = style->face_materials[mesh->cage_faces ? mesh->cage_faces[f] : f];
        point p[3];
        for (int i = 0; i < face_size(mesh, f); i++) {
            int j = i < 2 ? i : 2;
            if (i > 2) p[1] = p[2];
            p[j] = project(view, vec_of(mesh->positions + 3 * mesh->face_vertices[k + i]));
            p[j].normal = normals[k + i];
            if (i >= 2) draw_triangle(t, p[0], p[1], p[2], material);
        }
    }
}

enum { PEN_EDGE = 1, PEN_SEMI_SHARP, PEN_SHARP, PEN_LINE };

static void draw_edges(target *t, const subdiv_mesh *mesh, const side *sides, int side_count,
                       const render_view *view, const render_style *style)
{
    for (int i = 0; i < side_count; i++) {
        side s = sides[i];
        if (i && sides[i - 1].low == s.low && sides[i - 1].high == s.high) continue;
        float width = s.sharpness > 0 ? style->crease_width : style->edge_width;
        int pen = s.sharpness >= SUBDIV_INFINITE ? PEN_SHARP :
                  s.sharpness > 0 ? PEN_SEMI_SHARP : PEN_EDGE;
        if (width <= 0) continue;
        draw_line(t, project(view, vec_of(mesh->positions + 3 * s.low)),
                  project(view, vec_of(mesh->positions + 3 * s.high)),
                  width * SAMPLES, (unsigned char)pen);
    }
    for (int i = 0; i < mesh->corner_count; i++) {
        point p = project(view, vec_of(mesh->positions + 3 * mesh->corner_vertices[i]));
        draw_line(t, p, p, 3 * style->crease_width * SAMPLES,
                  mesh->corner_sharpness[i] >= SUBDIV_INFINITE ? PEN_SHARP : PEN_SEMI_SHARP);
    }
}

static void draw_polylines(target *t, const subdiv_mesh *mesh, const render_view *view,
                           const render_style *style)
{
    const int *v = mesh->line_vertices;
    for (int i = 0; i < mesh->line_count; v += mesh->line_sizes[i++]) {
        point p = project(view, vec_of(mesh->positions + 3 * v[0])), q;
        for (int k = 1; k < mesh->line_sizes[i]; k++, p = q) {
            q = project(view, vec_of(mesh->positions + 3 * v[k]));
            draw_line(t, p, q, style->line_width * SAMPLES, PEN_LINE);
        }
    }
}

// -------------------------------------------------------------------------------- lights

typedef struct light { vec direction, tint; float power, on_ground; } light;

static const float golden = 2.39996323f;    // the golden angle spreads points evenly

// A large warm key light from the upper left, a cool sky, and a rim of light from behind. The
// lights turn with the camera.
static void make_lights(light *lights, const render_view *view)
{
    vec up = {0, 1, 0}, right = vec_of(view->right), front = unit(cross(right, up));
    vec key = unit(combine(right, -0.62f, up, 1.0f, front, 0.50f));
    vec rim = unit(combine(right, 0.75f, up, 0.45f, front, -0.85f));
    vec side1 = unit(cross(key, front)), side2 = cross(side1, key);
    for (int i = 0; i < KEY_LIGHTS; i++) {
        float r = 0.26f * sqrtf(((float)i + 0.5f) / KEY_LIGHTS), a = golden * (float)i;
        vec tint = {1.0f, 0.95f, 0.86f};
        lights[i].direction = unit(combine(key, 1, side1, r * cosf(a), side2, r * sinf(a)));
        lights[i].power = 1.75f * GROUPS / KEY_LIGHTS;
        lights[i].on_ground = lights[i].power * lights[i].direction.y;
        lights[i].tint = tint;
    }
    for (int i = 0; i < SKY_LIGHTS; i++) {
        float y = 1 - 1.15f * ((float)i + 0.5f) / SKY_LIGHTS, a = golden * (float)i;
        float r = sqrtf(1 - y * y);
        light *l = lights + KEY_LIGHTS + i;
        l->direction = combine(right, r * cosf(a), up, y, front, r * sinf(a));
        float behind = most(0, dot(l->direction, rim));
        vec tint = {0.86f, 0.94f, 1.06f};
        l->power = (1.15f + 3.2f * behind * behind * behind * behind) * GROUPS / SKY_LIGHTS;
        l->on_ground = y > 0 ? 1.15f * y * y * GROUPS / SKY_LIGHTS : 0;   // soft, without the rim
        l->tint = tint;
    }
}

typedef struct shadow { target map; vec centre, x, y, toward; float scale, texel; } shadow;

static point shadow_point(const shadow *s, vec p)
{
    vec q = sub(p, s->centre);
    point r = {dot(q, s->x) * s->scale + MAP / 2, dot(q, s->y) * s->scale + MAP / 2,
               dot(q, s->toward), {0, 0, 0}};
    return r;
}

static void draw_shadow_map(shadow *s, const subdiv_mesh *mesh, vec toward, point *projected)
{
    vec other = {0.31f, 0.23f, 0.92f};
    s->toward = toward;
    s->x = unit(cross(toward, other));
    s->y = cross(toward, s->x);
    for (int i = 0; i < MAP * MAP; i++) s->map.near[i] = -FLT_MAX;
    for (int v = 0; v < mesh->vertex_count; v++) {
        projected[v] = shadow_point(s, vec_of(mesh->positions + 3 * v));
    }
    const int *face = mesh->face_vertices;
    for (int f = 0; f < mesh->face_count; face += face_size(mesh, f), f++) {
        for (int i = 2; i < face_size(mesh, f); i++) {
            draw_triangle(&s->map, projected[face[0]], projected[face[i - 1]],
                          projected[face[i]], 0);
        }
    }
}

static int is_lit(const shadow *s, vec p, vec normal)
{
    point q = shadow_point(s, add(p, scaled(normal, 1.6f * s->texel)));
    if (q.x < 0 || q.y < 0 || q.x > MAP - 1 || q.y > MAP - 1) return 1;
    int i = (int)(q.y + 0.5f) * MAP + (int)(q.x + 0.5f);
    return q.near + 1.2f * s->texel >= s->map.near[i];
}

// ------------------------------------------------------------------------------- shading

typedef struct scene {
    target              view_target;
    vec                *received;     // the light at each sample; for the ground, x is what it
                                      // gets and y what it would get without the mesh
    const render_view  *view;
    const render_style *style;
    float               ground;
    shadow              shadow;
} scene;

// The direction from the eye through a sample, of depth 1.
static vec sample_ray(const render_view *view, int x, int y)
{
    return combine(vec_of(view->right), ((float)x - view->x) / view->scale,
                   vec_of(view->up), (view->y - (float)y) / view->scale, vec_of(view->back), -1);
}

static float highlight(vec normal, vec half)
{
    float c = most(0, dot(normal, half));
    c *= c; c *= c; c *= c; c *= c; c *= c;
    return c;
}

static void light_sample(scene *s, int x, int y, const light *l)
{
    int i = y * s->view_target.width + x;
    vec ray = sample_ray(s->view, x, y), eye = vec_of(s->view->eye), up = {0, 1, 0};
    vec *sum = &s->received[i];
    if (s->view_target.near[i] <= 0) {
        if (ray.y > -0.02f || l->on_ground <= 0) return;
        vec p = add(eye, scaled(ray, (s->ground - eye.y) / ray.y));
        sum->y += l->on_ground;
        if (is_lit(&s->shadow, p, up)) sum->x += l->on_ground;
        return;
    }
    vec n = s->view_target.normal[i];
    float c = dot(n, l->direction);
    if (c <= 0.02f) return;
    vec p = add(eye, scaled(ray, 1 / s->view_target.near[i]));
    if (!is_lit(&s->shadow, p, n)) return;
    const render_material *m = s->style->materials + s->view_target.material[i];
    vec albedo = {m->red * m->red, m->green * m->green, m->blue * m->blue};
    float shine = 0;
    if (m->gloss > 0) shine = m->gloss * highlight(n, unit(sub(l->direction, unit(ray))));
    sum->x += l->power * l->tint.x * (c * albedo.x + shine);
    sum->y += l->power * l->tint.y * (c * albedo.y + shine);
    sum->z += l->power * l->tint.z * (c * albedo.z + shine);
}

static int light_scene(scene *s, const subdiv_mesh *caster)
{
    light lights[LIGHTS];
    point *projected = malloc((size_t)caster->vertex_count * sizeof *projected);
    s->shadow.map.width = s->shadow.map.height = MAP;
    s->shadow.map.near = malloc(sizeof(float) * MAP * MAP);
    int ok = projected && s->shadow.map.near;
    make_lights(lights, s->view);
    for (int i = 0; i < LIGHTS && ok; i++) {
        draw_shadow_map(&s->shadow, caster, lights[i].direction, projected);
        for (int y = i % GROUPS / SAMPLES; y < s->view_target.height; y += SAMPLES) {
            for (int x = i % SAMPLES; x < s->view_target.width; x += SAMPLES) {
                light_sample(s, x, y, lights + i);
            }
        }
    }
    free(projected);
    free(s->shadow.map.near);
    return ok;
}

// The colour of one sample over what the picture shows there, for a screen.
static vec shade(const scene *s, int x, int y, vec backdrop)
{
    static const vec pens[] = {{0, 0, 0}, {0.16f, 0.18f, 0.22f}, {0.98f, 0.66f, 0.12f},
                               {0.94f, 0.30f, 0.16f}, {0.10f, 0.38f, 0.62f}};
    const target *t = &s->view_target;
    int i = y * t->width + x;
    vec got = s->received[i], colour = backdrop;
    if (t->near[i] > 0) {
        vec ray = unit(sample_ray(s->view, x, y)), n = t->normal[i];
        const render_material *m = s->style->materials + t->material[i];
        float f = 1 - fabsf(dot(ray, n)), rim = 0.10f * f * f * f * (0.3f + m->gloss);
        float bounce = 0.30f * (1 - n.y);
        got.x += rim + bounce * m->red * m->red;
        got.y += rim + bounce * m->green * m->green;
        got.z += rim + bounce * m->blue * m->blue;
        colour.x = sqrtf(1 - expf(-got.x * 1.2f));
        colour.y = sqrtf(1 - expf(-got.y * 1.2f));
        colour.z = sqrtf(1 - expf(-got.z * 1.2f));
        float grey = 0.3f * colour.x + 0.6f * colour.y + 0.1f * colour.z;
        vec greys = {grey, grey, grey};
        colour = add(scaled(colour, 1.22f), scaled(greys, -0.22f));   // as vivid as the paint
    } else if (got.y > 0) {
        float u = 2 * (float)x / (float)t->width - 1, v = 2 * (float)y / (float)t->height - 1;
        float rim = u * u * u * u + v * v * v * v;
        float fade = most(0, least(1, 2 * (1 - rim)));   // no shadow on the rim of the panel
        fade *= fade * (3 - 2 * fade);
        float dark = 0.66f * fade * (1 - sqrtf(got.x / got.y));
        colour = scaled(backdrop, 1 - most(0, dark - 0.02f));
    }
    int pen = t->line[i];
    float opacity = pen > PEN_EDGE ? 0.95f : pen ? s->style->edge_opacity : 0;
    return add(scaled(colour, 1 - opacity), scaled(pens[pen], opacity));
}

static void resolve(const scene *s, render_picture *picture, int left, int top)
{
    for (int y = 0; y < s->view_target.height / SAMPLES; y++) {
        for (int x = 0; x < s->view_target.width / SAMPLES; x++) {
            float *pixel = picture->rgb + 3 * ((top + y) * picture->width + left + x);
            vec sum = {0, 0, 0};
            for (int i = 0; i < GROUPS; i++) {
                sum = add(sum, shade(s, x * SAMPLES + i % SAMPLES, y * SAMPLES + i / SAMPLES,
                                     vec_of(pixel)));
            }
            pixel[0] = sum.x / GROUPS;
            pixel[1] = sum.y / GROUPS;
            pixel[2] = sum.z / GROUPS;
        }
    }
}

// ---------------------------------------------------------------------------- the picture

typedef struct box { vec low, high, centre; float radius; } box;

static box bounds(const subdiv_mesh *mesh)
{
    box b = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}, {0, 0, 0}, 0};
    for (int v = 0; v < mesh->vertex_count; v++) {
        vec p = vec_of(mesh->positions + 3 * v);
        b.low.x = least(b.low.x, p.x);  b.high.x = most(b.high.x, p.x);
        b.low.y = least(b.low.y, p.y);  b.high.y = most(b.high.y, p.y);
        b.low.z = least(b.low.z, p.z);  b.high.z = most(b.high.z, p.z);
    }
    vec diagonal = sub(b.high, b.low);
    b.centre = scaled(add(b.low, b.high), 0.5f);
    b.radius = 0.5f * sqrtf(dot(diagonal, diagonal));
    if (b.radius <= 0) b.radius = 1;  // all in one place
    return b;
}

static void store(float *p, vec v) { p[0] = v.x; p[1] = v.y; p[2] = v.z; }

void render_view_fit(render_view *view, const subdiv_mesh *mesh, float yaw, float pitch,
                     int width, int height)
{
    const float degree = 3.14159265f / 180;
    box b = bounds(mesh);
    vec back = {sinf(yaw * degree) * cosf(pitch * degree), sinf(pitch * degree),
                cosf(yaw * degree) * cosf(pitch * degree)};
    vec right = {cosf(yaw * degree), 0, -sinf(yaw * degree)};
    store(view->back, back);
    store(view->right, right);
    store(view->up, cross(back, right));
    store(view->eye, add(b.centre, scaled(back, 4.2f * b.radius)));
    view->scale = 1;
    view->x = view->y = 0;
    float x0 = FLT_MAX, x1 = -FLT_MAX, y0 = FLT_MAX, y1 = -FLT_MAX;
    for (int v = 0; v < mesh->vertex_count; v++) {
        point p = project(view, vec_of(mesh->positions + 3 * v));
        x0 = least(x0, p.x);  x1 = most(x1, p.x);
        y0 = least(y0, p.y);  y1 = most(y1, p.y);
    }
    x1 = most(x1, x0 + 1e-3f);        // of a single point
    y1 = most(y1, y0 + 1e-3f);
    view->scale = 0.90f * least((float)width / (x1 - x0), (float)height / (y1 - y0));
    view->x = (float)width / 2 - view->scale * (x0 + x1) / 2;
    view->y = (float)height / 2 - view->scale * (y0 + y1) / 2;
}

static int new_target(target *t, int width, int height)
{
    size_t count = (size_t)width * (size_t)height;
    t->width = width;
    t->height = height;
    t->near = calloc(count, sizeof *t->near);
    t->normal = calloc(count, sizeof *t->normal);
    t->material = malloc(count);
    t->line = calloc(count, 1);
    return t->near && t->normal && t->material && t->line;
}

static void free_target(target *t)
{
    free(t->near);
    free(t->normal);
    free(t->material);
    free(t->line);
}

int render_mesh(render_picture *picture, int left, int top, int width, int height,
                const subdiv_mesh *mesh, const render_view *view, const render_style *style)
{
    scene s = {0};
    render_view fine = *view;         // the view in samples instead of pixels
    box b = bounds(mesh);
    int side_count = 0, samples = width * height * GROUPS;
    side *sides = sorted_sides(mesh, &side_count);
    vec *normals = sides ? face_vertex_normals(mesh, sides, side_count, style->flat) : NULL;
    fine.scale *= SAMPLES;
    fine.x *= SAMPLES;
    fine.y *= SAMPLES;
    s.view = &fine;
    s.style = style;
    s.ground = b.low.y - style->lift;
    s.shadow.centre = b.centre;
    s.shadow.texel = 2 * b.radius / MAP;
    s.shadow.scale = (MAP - 4) / most(2 * b.radius, FLT_MIN);
    s.received = calloc((size_t)samples, sizeof *s.received);
    int ok = new_target(&s.view_target, width * SAMPLES, height * SAMPLES) && normals && s.received;
    if (ok) {
        draw_faces(&s.view_target, mesh, normals, &fine, style);
        for (int i = 0; i < samples; i++) s.view_target.normal[i] = unit(s.view_target.normal[i]);
        draw_edges(&s.view_target, mesh, sides, side_count, &fine, style);
        draw_polylines(&s.view_target, mesh, &fine, style);
        ok = light_scene(&s, style->caster ? style->caster : mesh);
    }
    if (ok) resolve(&s, picture, left, top);
    free_target(&s.view_target);
    free(s.received);
    free(normals);
    free(sides);
    return ok;
}
