// --info: prints what the cage is made of, and what is odd about it. --explain all: the rules and
// masks of all points.
#include "cli.h"

#include <stdlib.h>
#include <string.h>

// How many faces there are of each size.
static int print_face_sizes(const subdiv_mesh *mesh, int max_face_size)
{
    int *count = (int *)calloc((size_t)max_face_size + 1, sizeof *count);
    if (count == NULL) {
        fputs("subdiv: out of memory\n", stderr);
        return FAILED;
    }
    for (int f = 0; f < mesh->face_count; f++)
        count[mesh->face_size ? mesh->face_size : mesh->face_sizes[f]]++;
    for (int size = 3; size <= max_face_size; size++)
        if (count[size]) printf("  of %-21d%d\n", size, count[size]);
    free(count);
    return DONE;
}

// How many statements there are of each kind.
static void print_statements(const subdiv_mesh *mesh)
{
    static const char *const words[] = {"g", "o", "s", "usemtl", "mtllib"};
    printf("%-26s%d\n", "statements", mesh->statement_count);
    for (int k = 0; k < 5; k++) {
        size_t size = strlen(words[k]);
        int count = 0;
        for (int i = 0; i < mesh->statement_count; i++)
            count += strncmp(mesh->statements[i], words[k], size) == 0 &&
                     strchr(" \t", mesh->statements[i][size]) != NULL;
        if (count) printf("  %-24s%d\n", words[k], count);
    }
}

// A float with the fewest digits that tell it from others, behind a blank.
static void print_float(float value)
{
    char text[32];
    for (int digits = 6; digits <= 9; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, (double)value);
        if ((float)atof(text) == value) break;
    }
    printf(" %s", text);
}

static void print_bounding_box(const subdiv_mesh *mesh)
{
    float low[3], high[3];
    for (int k = 0; k < 3; k++) low[k] = high[k] = mesh->positions[k];
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++) {
        float x = mesh->positions[i];
        if (x < low[i % 3]) low[i % 3] = x;
        if (x > high[i % 3]) high[i % 3] = x;
    }
    printf("%-25s", "bounding box");
    for (int k = 0; k < 3; k++) print_float(low[k]);
    printf(" to");
    for (int k = 0; k < 3; k++) print_float(high[k]);
    printf("\n");
}

enum { SHOWN = 10 };                  // findings of each kind

typedef struct findings {
    int  counts[SUBDIV_ODDITY_COUNT];
    int  line_counts[SUBDIV_ODDITY_COUNT];
    char lines[SUBDIV_ODDITY_COUNT][SHOWN][256];
} findings;

static void keep_finding(void *user, const subdiv_finding *finding)
{
    findings *all = (findings *)user;
    int *count = &all->line_counts[finding->kind];
    if (*count == SHOWN) return;
    snprintf(all->lines[finding->kind][(*count)++], sizeof **all->lines, "%s", finding->text);
}

static void print_findings(const findings *all)
{
    int total = 0;
    for (int kind = 0; kind < SUBDIV_ODDITY_COUNT; kind++) total += all->counts[kind];
    printf("%-26s%d\n", "oddities", total);
    if (total) printf("  (faces, vertices and tags are counted from 0)\n");
    for (int kind = 0; kind < SUBDIV_ODDITY_COUNT; kind++) {
        for (int i = 0; i < all->line_counts[kind]; i++) printf("  %s\n", all->lines[kind][i]);
        if (all->counts[kind] > SHOWN) printf("  and %d more\n", all->counts[kind] - SHOWN);
    }
}

static int print_info(const subdiv_mesh *mesh, const subdiv_info *info, const findings *odd)
{
    const struct { const char *name; int value; } rows[] = {
        {"boundary edges", info->boundary_edge_count},
        {"non-manifold edges", info->nonmanifold_edge_count},
        {"non-manifold vertices", info->nonmanifold_vertex_count},
        {"isolated vertices", info->isolated_vertex_count},
        {"extraordinary vertices", info->extraordinary_vertex_count},
        {"largest valence", info->max_valence},
        {"creases", info->crease_count},
        {"creases that never fade", info->infinite_crease_count},
        {"corners", info->corner_count},
        {"holes", info->hole_count},
        {"polylines", mesh->line_count},
        {"components", info->component_count},
        {"UVs", mesh->uv_count},
        {"vertices with colours", mesh->colors ? mesh->vertex_count : 0},
    };
    printf("%-26s%d\n%-26s%d\n%-26s%d\n", "vertices", info->vertex_count, "edges",
           info->edge_count, "faces", info->face_count);
    if (print_face_sizes(mesh, info->max_face_size)) return FAILED;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        printf("%-26s%d\n", rows[i].name, rows[i].value);
    print_statements(mesh);
    print_bounding_box(mesh);
    print_findings(odd);
    return flush_output();
}

// Inspects the cage; its warnings count only if no refinement is going to repeat them.
int inspect(const subdiv_mesh *cage, const command *cmd, const subdiv_options *opt)
{
    subdiv_info info;
    findings odd = {{0}, {0}, {{{0}}}};
    subdiv_error before = *opt->error;
    if (subdiv_inspect(&info, cage, opt) ||
        subdiv_check(odd.counts, cage, keep_finding, &odd, opt)) return report(cmd->input, opt);
    if (cmd->output) *opt->error = before;
    return print_info(cage, &info, &odd);
}

// Prints what all points are, with their masks, a line each.
int explain_all(const subdiv_mesh *cage, const command *cmd, const subdiv_options *opt)
{
    static const char *const kinds[] = { "vertex", "edge", "face" };
    static const char *const rules[] = { "smooth", "dart", "crease", "corner" };
    static const char *const reasons[] = { "nothing-sharp", "linear", "no-faces", "boundary",
        "non-manifold", "single-face", "own-sharpness", "sharp-edges" };
    subdiv_explanation e;
    if (subdiv_explain_points(&e, cage, opt)) return report(cmd->input, opt);
    puts("# point, what of: its rule, the next level's, the share of the first, why | its mask");
    for (int i = 0; i < e.count; i++) {
        const subdiv_point *p = &e.points[i];
        printf("%d %s ", i, kinds[p->kind]);
        if (p->kind == SUBDIV_EDGE_POINT) printf("%d-%d", p->ends[0], p->ends[1]);
        else printf("%d", p->parent);
        printf(": %s %s %g %s |", rules[p->rule], rules[p->next], p->weight, reasons[p->reason]);
        for (size_t k = e.masks.offsets[i]; k < e.masks.offsets[i + 1]; k++)
            printf(" %d:%.9g", e.masks.indices[k], (double)e.masks.weights[k]);
        putchar('\n');
    }
    subdiv_explanation_free(&e);
    return flush_output();
}
