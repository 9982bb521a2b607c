// What the fuzzers share: numbers from bytes, and what holds after every call of the library. A
// fuzzer ends in replay.h, which runs it without libFuzzer.
#ifndef FUZZ_H
#define FUZZ_H

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SUBDIV_IMPLEMENTATION
#include "heap.h"
#include "subdiv.h"
#include "tests/lib/same.h"

#define REQUIRE(condition) do { if (!(condition)) {                                     \
        fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); abort(); }      \
    } while (0)

static inline void *need(size_t size)     // memory of the fuzzer's own, of this very size
{
    void *block = malloc(size ? size : 1);
    if (!block) exit(0);
    return block;
}

static inline void *copy_of(const void *from, size_t count, size_t item)
{
    void *copy = from ? need(count * item) : NULL;
    if (copy && count) memcpy(copy, from, count * item);
    return copy;
}

// ------------------------------------------------------------------------------ numbers from bytes

typedef struct bytes {
    const uint8_t *at, *end;              // zeros follow the end
} bytes;

static inline int take(bytes *from)
{
    return from->at < from->end ? *from->at++ : 0;
}

static inline int below(bytes *from, int count)
{
    int n = take(from);
    if (count > 256) n += 256 * take(from);
    return count > 0 ? n % count : 0;
}

static inline int chance(bytes *from, int in)       // 1 of so many, 0 from bytes of 0
{
    return below(from, in) == in - 1;
}

static inline float any_float(bytes *from)
{
    uint32_t bits = 0;
    float value;
    for (int i = 0; i < 4; i++) bits = bits << 8 | (uint32_t)take(from);
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline int any_int(bytes *from)
{
    static const int special[] = { 0, -1, 1, -2, INT_MIN, INT_MAX, INT_MAX - 1, 1 << 30, 4, 65536 };
    int i = below(from, 16);
    return i < 10 ? special[i] : take(from);
}

// --------------------------------------------------------------------------- after a call, always

static subdiv_error error;

// Options whose error holds what an earlier call left there.
static inline subdiv_options fresh_options(void)
{
    subdiv_options opt = {0};
    memset(&error, 0, sizeof error);
    opt.error = &error;
    error.code = SUBDIV_ERROR_IO;
    error.line = error.face = error.vertex = 12345;
    strcpy(error.message, "stale");
    return opt;
}

// Code and message agree; what has no fault leaves no place. Returns whether the call succeeded.
static inline int settled(subdiv_result result)
{
    REQUIRE(result >= 0 && result < SUBDIV_RESULT_COUNT);
    REQUIRE(error.code == result);
    REQUIRE(memchr(error.message, 0, sizeof error.message));
    REQUIRE(memchr(error.warning, 0, sizeof error.warning));
    REQUIRE((error.message[0] != 0) == (result != SUBDIV_OK));
    REQUIRE((error.warning[0] != 0) == (error.warning_count > 0));
    REQUIRE(strcmp(error.message, "stale") != 0);
    REQUIRE(error.line >= 0 && error.line != 12345);
    REQUIRE(error.face != 12345 && error.vertex != 12345);
    if (!result) REQUIRE(error.line == 0 && error.face == -1 && error.vertex == -1);
    return result == SUBDIV_OK;
}

static inline int is_zero(const void *bytes, size_t size)
{
    const char *byte = (const char *)bytes;
    for (size_t i = 0; i < size; i++) if (byte[i]) return 0;
    return 1;
}

static inline int all_in(const int *numbers, size_t count, int low, int high)
{
    for (size_t i = 0; i < count; i++) if (numbers[i] < low || numbers[i] >= high) return 0;
    return count == 0 || numbers != NULL;
}

// Finite, and no larger than most.
static inline int all_within(const float *numbers, size_t count, float most)
{
    for (size_t i = 0; i < count; i++) if (!(fabsf(numbers[i]) <= most)) return 0;
    return count == 0 || numbers != NULL;
}

// Of length 1, or 0.
static inline int is_normal(const float *n)
{
    double squares = 0;
    for (int k = 0; k < 3; k++) squares += (double)n[k] * (double)n[k];
    return squares == 0 || fabs(squares - 1) < 1e-5;
}

static inline size_t face_vertex_sum(const subdiv_mesh *m)
{
    size_t sum = 0;
    for (int f = 0; f < m->face_count; f++) sum += (size_t)size_of_face(m, f);
    return sum;
}

// A mesh of the library: every array is there, every index in range, every number finite.
static inline void check_mesh(const subdiv_mesh *m)
{
    REQUIRE(m->vertex_count > 0 && m->face_count >= 0 && m->memory);
    REQUIRE(!m->face_size || m->face_size >= 3);
    REQUIRE(m->face_size || all_in(m->face_sizes, (size_t)m->face_count, 3, INT_MAX));
    size_t vertices = (size_t)m->vertex_count, sum = face_vertex_sum(m);
    REQUIRE(all_in(m->face_vertices, sum, 0, m->vertex_count));
    REQUIRE(all_in(m->crease_vertices, 2 * (size_t)m->crease_count, 0, m->vertex_count));
    REQUIRE(all_in(m->corner_vertices, (size_t)m->corner_count, 0, m->vertex_count));
    REQUIRE(all_in(m->holes, (size_t)m->hole_count, 0, m->face_count));
    REQUIRE(!m->uv_count || all_in(m->face_uvs, sum, -1, m->uv_count));
    REQUIRE(all_within(m->positions, 3 * vertices, FLT_MAX));
    REQUIRE(all_within(m->uvs, 2 * (size_t)m->uv_count, FLT_MAX));
    REQUIRE(!m->colors || all_within(m->colors, 3 * vertices, FLT_MAX));
    for (int i = 0; i < m->crease_count; i++) REQUIRE(!isnan(m->crease_sharpness[i]));
    for (int i = 0; i < m->corner_count; i++) REQUIRE(!isnan(m->corner_sharpness[i]));
    for (int i = 0; i < m->statement_count; i++) {
        REQUIRE(all_in(m->statement_faces + i, 1, i ? m->statement_faces[i - 1] : 0,
                       m->face_count + 1));
        REQUIRE(m->statements[i][0]);
    }
    for (size_t v = 0; v < vertices && m->normals; v++) REQUIRE(is_normal(m->normals + 3 * v));
}

// An output is whole, or zeroed after an error.
static inline int settled_mesh(subdiv_result result, const subdiv_mesh *made)
{
    if (settled(result)) check_mesh(made);
    else REQUIRE(mesh_is_zero(made));
    return result == SUBDIV_OK;
}

#endif
