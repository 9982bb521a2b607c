// bench_obj: how fast OBJ files are read and written, beside what the machine needs for the bytes
// alone. One thread; a torus of 2 million quads, with positions only and with UVs and normals.
//
//     cc -O3 -I. examples/bench/obj.c -o build/bench_obj -lm && build/bench_obj      (POSIX)
//
// The file stands in /dev/shm, which is memory, or else in the current folder. Runs of ours and the
// machine's alternate, so that whatever slows the machine slows both.

#define _POSIX_C_SOURCE 200809L

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

enum { ROWS = 1414, COLUMNS = 1415, RUNS = 9, BLOCK = 1 << 16 };

typedef struct times {
    double ours[RUNS], limit[RUNS];
} times;

static const char *path;
static char  *text;                   // the bytes of the file
static size_t text_size;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void *allocate(size_t size)
{
    void *memory = malloc(size);
    if (memory == NULL) {
        fputs("bench_obj: out of memory\n", stderr);
        exit(1);
    }
    return memory;
}

static void expect(int good, const char *what)
{
    if (good) return;
    fprintf(stderr, "bench_obj: %s failed\n", what);
    unlink(path);
    exit(1);
}

static void make_torus(subdiv_mesh *mesh)
{
    const double turn = 6.283185307179586;
    size_t count = (size_t)ROWS * COLUMNS;
    memset(mesh, 0, sizeof *mesh);
    mesh->vertex_count = mesh->uv_count = mesh->face_count = ROWS * COLUMNS;
    mesh->face_size = 4;
    mesh->positions = (float *)allocate(3 * count * sizeof(float));
    mesh->normals = (float *)allocate(3 * count * sizeof(float));
    mesh->uvs = (float *)allocate(2 * count * sizeof(float));
    mesh->face_vertices = mesh->face_uvs = (int *)allocate(4 * count * sizeof(int));
    for (int r = 0; r < ROWS; r++) {
        for (int c = 0; c < COLUMNS; c++) {
            size_t v = (size_t)(r * COLUMNS + c);
            int below = (r + 1) % ROWS * COLUMNS, right = (c + 1) % COLUMNS;
            double angle = turn * r / ROWS, tilt = turn * c / COLUMNS;
            float *p = mesh->positions + 3 * v, *n = mesh->normals + 3 * v, *uv = mesh->uvs + 2 * v;
            int *f = mesh->face_vertices + 4 * v;
            n[0] = (float)(cos(tilt) * cos(angle));
            n[1] = (float)(cos(tilt) * sin(angle));
            n[2] = (float)sin(tilt);
            p[0] = (float)((3 + cos(tilt)) * cos(angle));
            p[1] = (float)((3 + cos(tilt)) * sin(angle));
            p[2] = n[2];
            uv[0] = (float)((double)r / ROWS);
            uv[1] = (float)((double)c / COLUMNS);
            f[0] = (int)v;
            f[1] = below + c;
            f[2] = below + right;
            f[3] = r * COLUMNS + right;
        }
    }
}

// The time to write bytes that are there to a file that is not.
static double raw_write(void)
{
    unlink(path);
    double start = now();
    int file = open(path, O_WRONLY | O_CREAT, 0600);
    for (size_t at = 0; at < text_size;) {
        size_t size = text_size - at < BLOCK ? text_size - at : BLOCK;
        ssize_t wrote = write(file, text + at, size);
        expect(wrote > 0, "writing");
        at += (size_t)wrote;
    }
    expect(close(file) == 0, "writing");
    return now() - start;
}

// The time to read the file into memory that is in use, and to find its lines.
static double raw_read(const subdiv_mesh *mesh)
{
    double start = now();
    int file = open(path, O_RDONLY);
    size_t at = 0;
    for (ssize_t got = 1; got > 0 && at < text_size; at += got > 0 ? (size_t)got : 0)
        got = read(file, text + at, text_size - at);
    expect(at == text_size && close(file) == 0, "reading");
    int lines = 0;
    for (char *p = text; (p = (char *)memchr(p, '\n', (size_t)(text + at - p))) != NULL; p++)
        lines++;
    double end = now();
    expect(lines == mesh->vertex_count * (mesh->normals ? 2 : 1) + mesh->uv_count + mesh->face_count,
           "counting");
    return end - start;
}

static double our_write(const subdiv_mesh *mesh)
{
    unlink(path);
    double start = now();
    expect(subdiv_save_obj(mesh, path, NULL) == SUBDIV_OK, "saving");
    return now() - start;
}

static double our_read(const subdiv_mesh *expected)
{
    subdiv_mesh mesh;
    double start = now();
    expect(subdiv_load_obj(&mesh, path, NULL) == SUBDIV_OK, "loading");
    double end = now();
    size_t size = 3 * sizeof(float) * (size_t)expected->vertex_count;
    expect(memcmp(mesh.positions, expected->positions, size) == 0, "comparing");
    subdiv_mesh_free(&mesh);
    return end - start;
}

static int compare_numbers(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print_row(const char *name, times *t)
{
    qsort(t->ours, RUNS, sizeof(double), compare_numbers);
    qsort(t->limit, RUNS, sizeof(double), compare_numbers);
    double ours = t->ours[RUNS / 2], limit = t->limit[RUNS / 2], bytes = (double)text_size;
    printf("  %-25s%9.0f%9.1f%9.1f%9.0f%9.1f%9.1fx\n", name, bytes / 1e6, 1e3 * ours,
           1e3 * t->ours[0], bytes / ours / 1e6, 1e3 * limit, ours / limit);
}

static void measure(const subdiv_mesh *mesh, const char *write_name, const char *read_name)
{
    times reading, writing;
    expect(subdiv_save_obj_memory(mesh, NULL, 0, &text_size, NULL) == SUBDIV_OK, "saving");
    text = (char *)allocate(text_size);
    expect(subdiv_save_obj_memory(mesh, text, text_size, &text_size, NULL) == SUBDIV_OK, "saving");
    for (int run = 0; run < RUNS; run++) {
        writing.limit[run] = raw_write();
        writing.ours[run] = our_write(mesh);
    }
    for (int run = 0; run < RUNS; run++) {
        reading.limit[run] = raw_read(mesh);
        reading.ours[run] = our_read(mesh);
    }
    print_row(write_name, &writing);
    print_row(read_name, &reading);
    free(text);
    unlink(path);
}

int main(void)
{
    subdiv_mesh mesh;
    path = access("/dev/shm", W_OK) == 0 ? "/dev/shm/subdiv_bench.obj" : "subdiv_bench.obj";
    make_torus(&mesh);
    printf("OBJ, %d vertices, %d quads, one thread, in the processor's time for it; medians\n"
           "limit   write() of the same bytes; read() of the file into memory in use, and memchr\n"
           "        for its lines\n\n", mesh.vertex_count, mesh.face_count);
    printf("  %-25s%9s%9s%9s%9s%9s%10s\n", "", "MB", "ms", "min", "MB/s", "limit", "ratio");
    subdiv_mesh plain = mesh;
    plain.uv_count = 0;
    plain.normals = NULL;
    measure(&plain, "write v", "read v");
    measure(&mesh, "write v vt vn", "read v vt vn");
    putchar('\n');
    free(mesh.positions);
    free(mesh.normals);
    free(mesh.uvs);
    free(mesh.face_vertices);
    return 0;
}
