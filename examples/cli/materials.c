// Materials: which faces have which, and --merge-materials.
#include "cli.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char word[] = "usemtl";

// Returns the number of the material of a statement, a new one if need be; -1: of another kind.
static int add_material(materials *all, const char *statement)
{
    size_t size = sizeof word - 1;
    if (strncmp(statement, word, size) != 0 || strspn(statement + size, " \t") == 0) return -1;
    const char *name = statement + size + strspn(statement + size, " \t");
    for (int i = 0; i < all->count; i++)
        if (i > 0 && strcmp(all->names[i], name) == 0) return i;
    all->names[all->count] = name;
    return all->count++;
}

// Sorts the faces by material, those of one material as they were. starts: [count + 1]
static void sort_faces(const materials *all, int face_count, int *starts)
{
    memset(starts, 0, ((size_t)all->count + 1) * sizeof *starts);
    for (int f = 0; f < face_count; f++) starts[all->of_faces[f] + 1]++;
    for (int i = 0; i < all->count; i++) starts[i + 1] += starts[i];
    for (int f = 0; f < face_count; f++) all->order[starts[all->of_faces[f]]++] = f;
}

subdiv_result find_materials(materials *all, const subdiv_mesh *mesh, const subdiv_options *opt)
{
    size_t most = (size_t)mesh->statement_count + 1, faces = (size_t)mesh->face_count;
    size_t names = most * sizeof *all->names;
    char *block = (char *)malloc(names + (2 * faces + most + 1) * sizeof(int));
    memset(all, 0, sizeof *all);
    if (block == NULL) return set_error(opt, SUBDIV_ERROR_MEMORY, "out of memory");
    all->memory = block;
    all->names = (const char **)(void *)block;
    all->of_faces = (int *)(void *)(block + names);
    all->order = all->of_faces + faces;
    all->names[all->count++] = "default";
    for (int f = 0, i = 0, material = 0; f < mesh->face_count; f++) {
        for (; i < mesh->statement_count && mesh->statement_faces[i] <= f; i++) {
            int found = add_material(all, mesh->statements[i]);
            if (found >= 0) material = found;
        }
        all->of_faces[f] = material;
    }
    sort_faces(all, mesh->face_count, all->order + faces);
    return SUBDIV_OK;
}

// Colours around the wheel, by the golden ratio, so that neighbours in the list differ most.
void material_color(int material, float rgb[3])
{
    float hue = 0.58f + 0.618034f * (float)(material > 1 ? material - 1 : 0);
    for (int k = 0; k < 3; k++) {
        float h = hue - (float)k / 3, away = fabsf(6 * (h - floorf(h)) - 3) - 1;
        float light = away < 0 ? 0 : away > 1 ? 1 : away;
        rgb[k] = 0.42f + 0.42f * light;
    }
}

// ---------------------------------------------------------------------------- --merge-materials

// What is in force for a face: the last statement of each of these kinds.
enum { GROUP, OBJECT, SMOOTHING, MATERIAL, KINDS };
static const char *const kinds[KINDS] = {"g", "o", "s", word};
static char defaults[KINDS][16] = {"g default", "o default", "s off", ""};     // before the first

static int kind_of(const char *statement)
{
    for (int k = 0; k < KINDS; k++) {
        size_t size = strlen(kinds[k]);
        if (strncmp(statement, kinds[k], size) == 0 && strchr(" \t", statement[size])) return k;
    }
    return KINDS;
}

// Faces without a statement between them.
typedef struct stretch {
    int    first, count, material;
    size_t start, size;               // of their face-vertices
    char  *in_force[KINDS];
} stretch;

static int compare_stretches(const void *a, const void *b)
{
    const stretch *s = (const stretch *)a, *t = (const stretch *)b;
    if (s->material != t->material) return s->material < t->material ? -1 : 1;
    return (s->first > t->first) - (s->first < t->first);
}

// Returns the number of stretches, sorted by material.
static int list_stretches(stretch *list, const subdiv_mesh *mesh, const materials *all)
{
    stretch next = {0, 0, 0, 0, 0, {defaults[0], defaults[1], defaults[2], defaults[3]}};
    int count = 0;
    for (int i = 0; i <= mesh->statement_count; i++) {
        int is_end = i == mesh->statement_count;
        int end = is_end ? mesh->face_count : mesh->statement_faces[i];
        for (; next.first + next.count < end; next.count++)
            next.size += (size_t)(mesh->face_size ? mesh->face_size
                                  : mesh->face_sizes[next.first + next.count]);
        if (next.count) {
            next.material = all->of_faces[next.first];
            list[count++] = next;
            next.first = end;
            next.start += next.size;
            next.size = 0;
            next.count = 0;
        }
        int kind = is_end ? KINDS : kind_of(mesh->statements[i]);
        if (kind < KINDS) next.in_force[kind] = mesh->statements[i];
    }
    qsort(list, (size_t)count, sizeof *list, compare_stretches);
    return count;
}

static void add_statement(subdiv_mesh *to, int face, char *text)
{
    to->statement_faces[to->statement_count] = face;
    to->statements[to->statement_count++] = text;
}

// Copies stretches to a mesh, with the statements that change what is in force. places: where each
// face goes
static void copy_stretches(subdiv_mesh *to, const subdiv_mesh *from, const stretch *list,
                           int count, int *places)
{
    char *now[KINDS] = {defaults[0], defaults[1], defaults[2], defaults[3]};
    size_t end = 0;
    int face = 0;
    for (int i = 0; i < from->statement_count; i++)             // mtllib
        if (kind_of(from->statements[i]) == KINDS) add_statement(to, 0, from->statements[i]);
    for (const stretch *s = list; s < list + count; s++) {
        size_t bytes = s->size * sizeof(int);
        for (int k = 0; k < KINDS; k++)
            if (strcmp(s->in_force[k], now[k]) != 0)
                add_statement(to, face, now[k] = s->in_force[k]);
        memcpy(to->face_vertices + end, from->face_vertices + s->start, bytes);
        if (from->uv_count) memcpy(to->face_uvs + end, from->face_uvs + s->start, bytes);
        end += s->size;
        for (int f = s->first; f < s->first + s->count; f++, face++) {
            if (!from->face_size) to->face_sizes[face] = from->face_sizes[f];
            places[f] = face;
        }
    }
    for (int i = 0; i < from->hole_count; i++) to->holes[i] = places[from->holes[i]];
}

subdiv_result merge_materials(work *w, const subdiv_options *opt)
{
    subdiv_mesh *cage = &w->cage, to = *cage;
    materials all;
    size_t statements = (size_t)cage->statement_count, faces = (size_t)cage->face_count;
    size_t most = (KINDS + 1) * (statements + 1), size = 0;
    if (find_materials(&all, cage, opt)) return SUBDIV_ERROR_MEMORY;
    for (int f = 0; f < cage->face_count; f++)
        size += (size_t)(cage->face_size ? cage->face_size : cage->face_sizes[f]);
    stretch *list = (stretch *)malloc((statements + 1) * sizeof *list + most * sizeof(char *) +
                          (2 * size + 2 * faces + (size_t)cage->hole_count + most) * sizeof(int));
    if (list) {
        int count = list_stretches(list, cage, &all);
        to.statements = (char **)(list + statements + 1);
        to.statement_faces = (int *)(to.statements + most);
        to.face_vertices = to.statement_faces + most;
        to.face_uvs = to.face_vertices + size;
        to.face_sizes = to.face_uvs + size;
        to.holes = to.face_sizes + faces;
        if (cage->face_size) to.face_sizes = NULL;
        to.statement_count = 0;
        copy_stretches(&to, cage, list, count, to.holes + cage->hole_count);
        *cage = to;
    }
    w->merged = list;
    free(all.memory);
    return list ? SUBDIV_OK : set_error(opt, SUBDIV_ERROR_MEMORY, "out of memory");
}
