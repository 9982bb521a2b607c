// Macros of the user's own: a decoration of the functions, an allocator and an assert. And one of
// two files with an implementation of their own each, linked together.
#include <stddef.h>
#include <stdlib.h>

static int asserts, allocations;

static void *counted_malloc(size_t size)
{
    allocations++;
    return malloc(size);
}

#define SUBDIV_DEF static inline
#define SUBDIV_MALLOC(size, user)  ((void)(user), counted_malloc(size))
#define SUBDIV_FREE(pointer, user) ((void)(user), allocations--, free(pointer))
#define SUBDIV_ASSERT(condition)   ((condition) ? (void)asserts++ : abort())
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "cube.h"

int cube_is_right_in_b(void);

int main(void)
{
    int used = cube_is_right();
    return !used || allocations != 0 || !cube_is_right_in_b();
}
