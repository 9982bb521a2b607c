// The allocator of the fuzzers, which counts, and small limits of the library, so that little input
// gets far. Under the address sanitizer the bytes between arrays are out of bounds. To save time
// the implementation is compiled with this once for all fuzzers:
//
//     cc -include tests/fuzz/heap.h -DSUBDIV_IMPLEMENTATION -x c -c subdiv.h
#ifndef HEAP_H
#define HEAP_H

#include <stdlib.h>
#include <string.h>

extern int heap_live;                     // blocks of the library in use
extern size_t heap_most;                  // larger blocks are refused

void *heap_malloc(size_t size, void *user);
void heap_free(void *block, void *user);

#define SUBDIV_MALLOC(size, user) heap_malloc(size, user)
#define SUBDIV_FREE(block, user)  heap_free(block, user)
#define SDV_JOB_POINTS  16                // several jobs
#define SDV_FULL_LEVELS 2                 // frames on level 3, as deep levels have

#ifdef __has_feature
#if __has_feature(address_sanitizer)
#include <sanitizer/asan_interface.h>
#define SDV_GUARD(bytes, size) __asan_poison_memory_region(bytes, size)
#endif
#endif

#if defined(SUBDIV_IMPLEMENTATION) && !defined(SUBDIV_IMPLEMENTED)
int heap_live;
size_t heap_most = (size_t)1 << 28;

void *heap_malloc(size_t size, void *user)
{
    void *block = size <= heap_most ? malloc(size) : NULL;
    (void)user;
    if (block) memset(block, 0xa5, size);           // nobody may count on zeros
    heap_live += block != NULL;
    return block;
}

void heap_free(void *block, void *user)
{
    (void)user;
    heap_live -= block != NULL;
    free(block);
}
#endif
#endif
