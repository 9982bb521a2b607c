// For the tests of OBJ: loading a text in every way, saving to memory, random numbers. Include it
// after subdiv.h.
#ifndef OBJ_H
#define OBJ_H

#include <stdlib.h>
#include <string.h>

#include "same.h"
#include "test.h"

// A square, and a cage to hang tags on: a quad and a triangle that share an edge.
#define V4 "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
#define CAGE V4 "v 0 0 1\nf 1 2 3 4\nf 1 5 2\n"

static unsigned random_state = 2463534242u;

static inline unsigned random_bits(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 17;
    random_state ^= random_state << 5;
    return random_state;
}

static inline float from_bits(unsigned bits)
{
    float f;
    memcpy(&f, &bits, sizeof f);
    return f;
}

static inline unsigned to_bits(float f)
{
    unsigned bits;
    memcpy(&bits, &f, sizeof bits);
    return bits;
}

static inline float random_float(void)
{
    for (;;) {
        float f = from_bits(random_bits());
        if (f - f == 0) return f;     // finite
    }
}

// A text handed out in pieces of at most step bytes.
typedef struct pieces {
    const char *text;
    size_t size, at, step;
} pieces;

static inline size_t read_piece(void *user, void *bytes, size_t size)
{
    pieces *p = (pieces *)user;
    size_t n = p->size - p->at;
    if (n > p->step) n = p->step;
    if (n > size) n = size;
    if (n) memcpy(bytes, p->text + p->at, n);
    p->at += n;
    return n;
}

// Loads a text from memory, and in pieces of 1 and of 7 bytes; all must agree.
static inline subdiv_result load_bytes(subdiv_mesh *mesh, const char *text, size_t size,
                                       subdiv_error *error)
{
    subdiv_options opt = {0};
    memset(error, 0, sizeof *error);
    opt.error = error;
    memset(mesh, 0x55, sizeof *mesh);
    subdiv_result result = subdiv_load_obj_memory(mesh, text, size, &opt);
    CHECK_EQUAL(error->code, result);
    if (result) CHECK(mesh_is_zero(mesh));
    for (size_t step = 1; step <= 7; step += 6) {
        pieces p = {text, size, 0, step};
        subdiv_mesh other;
        subdiv_error other_error = {0};
        memset(&other, 0x55, sizeof other);
        opt.error = &other_error;
        CHECK_EQUAL(subdiv_load_obj_callback(&other, read_piece, &p, &opt), result);
        CHECK(same_mesh(mesh, &other));
        CHECK_EQUAL(other_error.code, error->code);
        CHECK_EQUAL(other_error.line, error->line);
        CHECK_EQUAL(other_error.warning_count, error->warning_count);
        CHECK_TEXT(other_error.message, error->message);
        CHECK_TEXT(other_error.warning, error->warning);
        subdiv_mesh_free(&other);
    }
    return result;
}

static inline subdiv_result load(subdiv_mesh *mesh, const char *text, subdiv_error *error)
{
    return load_bytes(mesh, text, strlen(text), error);
}

// Appends to a text that is large enough.
static inline void append(char *text, size_t *size, const char *piece)
{
    size_t n = strlen(piece);
    memcpy(text + *size, piece, n);
    *size += n;
}

// Saves to memory that the caller frees.
static inline char *save_text(const subdiv_mesh *mesh, size_t *size, const subdiv_options *opt)
{
    CHECK_EQUAL(subdiv_save_obj_memory(mesh, NULL, 0, size, opt), SUBDIV_OK);
    char *text = (char *)malloc(*size + 1);
    size_t again = 0;
    CHECK_EQUAL(subdiv_save_obj_memory(mesh, text, *size, &again, opt), SUBDIV_OK);
    CHECK_EQUAL(again, *size);
    text[*size] = 0;
    return text;
}

#endif
