// --eval: evaluates the limit surface at samples.
#include "cli.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Places to evaluate, and the lines they stand on.
typedef struct samples {
    subdiv_location *at;
    int             *lines;
    int              count, capacity;
} samples;

static int bad_sample(const command *cmd, int line, const char *text)
{
    fprintf(stderr, "subdiv: %s:%d: %s\n", cmd->texts[EVAL], line, text);
    return FAILED;
}

static int add_sample(samples *all, subdiv_location at, int line)
{
    if (all->count == all->capacity) {
        size_t capacity = 2 * (size_t)all->capacity + 1024;
        void *places = realloc(all->at, capacity * sizeof *all->at);
        if (places) all->at = (subdiv_location *)places;
        void *lines = realloc(all->lines, capacity * sizeof *all->lines);
        if (lines) all->lines = (int *)lines;
        if (!places || !lines || capacity > INT_MAX / 16) return FAILED;
        all->capacity = (int)capacity;
    }
    all->at[all->count] = at;
    all->lines[all->count++] = line;
    return DONE;
}

// Reads face u v or face/corner u v. Returns whether there is nothing else on the line.
static int read_sample(char *text, subdiv_location *at)
{
    char *words[4], *corner, *end_u, *end_v;
    int count = 0;
    for (char *p = strtok(text, " \t\r\n"); p && count < 4; p = strtok(NULL, " \t\r\n"))
        words[count++] = p;
    if (count != 3) return 0;
    corner = strchr(words[0], '/');
    if (corner) *corner++ = 0;
    at->face = read_number(words[0]);
    at->corner = corner ? read_number(corner) : 0;
    at->u = (float)strtod(words[1], &end_u);
    at->v = (float)strtod(words[2], &end_v);
    return at->face >= 0 && at->corner >= 0 && *end_u == 0 && *end_v == 0;
}

static int read_samples(FILE *file, const command *cmd, samples *all)
{
    char buffer[256], *text = buffer;
    for (int line = 1; fgets(buffer, sizeof buffer, file); line++, text = buffer) {
        subdiv_location at;
        int is_full = strlen(text) + 1 == sizeof buffer;
        if (strchr(text, '\n') == NULL && !feof(file))
            return bad_sample(cmd, line, is_full ? "too long" : "has a byte 0");
        if (line == 1 && strncmp(text, "\xEF\xBB\xBF", 3) == 0) text += 3;  // byte order mark
        text[strcspn(text, "#")] = 0;                                   // a comment
        if (text[strspn(text, " \t\r\n")] == 0) continue;
        if (!read_sample(text, &at))
            return bad_sample(cmd, line, "not 'face u v' or 'face/corner u v'");
        if (add_sample(all, at, line)) return bad_sample(cmd, line, "out of memory");
    }
    return ferror(file) ? bad_sample(cmd, 0, "reading failed") : DONE;
}

// What the library writes as three vertices, v x y z, is one line here.
static int print_sample_lines(char *text, size_t size)
{
    size_t end = 0;
    int vertices = 0;
    for (size_t i = 0; i < size; i++) {
        if (text[i] == 'v') i++;
        else text[end++] = (char)(text[i] == '\n' && ++vertices % 3 ? ' ' : text[i]);
    }
    fwrite(text, 1, end, stdout);
    return flush_output();
}

// Writes the numbers [9 * count] as the library does.
static int print_samples(float *numbers, const samples *all, const command *cmd)
{
    subdiv_mesh points = {0};
    size_t size = 0;
    points.vertex_count = 3 * all->count;
    points.positions = numbers;
    for (int i = 0; i < 9 * all->count; i++)
        if (!(fabsf(numbers[i]) <= FLT_MAX))
            return bad_sample(cmd, all->lines[i / 9], "its numbers are too large for floats");
    if (all->count == 0) return DONE;
    subdiv_save_obj_memory(&points, NULL, 0, &size, NULL);
    char *text = (char *)malloc(size);
    int result = FAILED;
    if (text && subdiv_save_obj_memory(&points, text, size, &size, NULL) == SUBDIV_OK)
        result = print_sample_lines(text, size);
    else fputs("subdiv: out of memory\n", stderr);
    free(text);
    return result;
}

// Names the line of the first sample that the library refuses.
static int report_samples(const work *w, const void *scratch, const samples *all,
                          const command *cmd, const subdiv_options *opt)
{
    const subdiv_derivatives nothing = {0};
    int i = 0;
    while (i + 1 < all->count && subdiv_evaluate_at(w->surface, 3, scratch, 1, &all->at[i],
                                                    &nothing, opt) == SUBDIV_OK) i++;
    subdiv_evaluate_at(w->surface, 3, scratch, 1, &all->at[i], &nothing, opt);
    const char *reason = strchr(opt->error->message, ':');
    return bad_sample(cmd, all->lines[i], reason ? reason + 2 : opt->error->message);
}

static int evaluate(work *w, const samples *all, const command *cmd, const subdiv_options *opt)
{
    begin_step("prepare");
    if (subdiv_prepare(&w->surface, &w->cage, SUBDIV_EXACT, opt)) return report(cmd->input, opt);
    end_step(w->cage.vertex_count);
    begin_step("evaluate");
    void *scratch = malloc(subdiv_scratch_size(w->surface, 3));
    float *numbers = (float *)malloc(9 * sizeof(float) * ((size_t)all->count + 1));
    int result = FAILED;
    if (scratch && numbers) {
        subdiv_derivatives out = {0};
        out.points = numbers;
        out.du = numbers + 3;
        out.dv = numbers + 6;
        out.stride = 9;
        if (subdiv_evaluate_begin(w->surface, 3, w->cage.positions, 0, scratch, opt))
            result = report(cmd->input, opt);
        else if (subdiv_evaluate_at(w->surface, 3, scratch, all->count, all->at, &out, opt))
            result = report_samples(w, scratch, all, cmd, opt);
        else result = print_samples(numbers, all, cmd);
        end_step(all->count);
    } else {
        fputs("subdiv: out of memory\n", stderr);
    }
    free(scratch);
    free(numbers);
    return result;
}

int run_samples(work *w, const command *cmd, const subdiv_options *opt)
{
    samples all = { NULL, NULL, 0, 0 };
    int is_stdin = strcmp(cmd->texts[EVAL], "-") == 0;
    FILE *file = is_stdin ? stdin : fopen(cmd->texts[EVAL], "r");
    int result = FAILED;
    begin_step("samples");
    if (!file) fprintf(stderr, "subdiv: %s: cannot be opened\n", cmd->texts[EVAL]);
    else result = read_samples(file, cmd, &all);
    if (file && !is_stdin) fclose(file);
    end_step(all.count);
    if (result == DONE) result = evaluate(w, &all, cmd, opt);
    free(all.at);
    free(all.lines);
    return result;
}
