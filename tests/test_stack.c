// No call takes more than 16 KB of stack: every public call, on random cages, at a vertex of many
// faces and on deep levels, runs on a stack whose bytes show how far down it has been written.
//
//     cc -O2 -I. tests/test_stack.c -o build/test_stack -lm -pthread && build/test_stack
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <stdint.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/cages.h"
#include "lib/every_call.h"
#include "lib/random_cage.h"
#include "lib/test.h"

enum { STACK = 1 << 20, PAINT = 0xa5, MOST = 16384 };

static unsigned char *stack;            // grows downwards, as on all machines we know of
static int deepest;
static char deepest_call[60];

// Measures from its own frame, which is where that of the call was.
static void measure(const char *call)
{
    unsigned char here;
    size_t top = (size_t)((uintptr_t)&here - (uintptr_t)stack), touched = 0;
    while (stack[touched] == PAINT) touched++;
    int depth = (int)(top - touched);
    if (depth > deepest) {
        deepest = depth;
        sprintf(deepest_call, "%.*s", (int)strcspn(call, "("), call);
    }
    for (; touched + 512 < top; touched++) stack[touched] = PAINT;
}

typedef struct task { const subdiv_mesh *cage; int levels; } task;

static void *call_all(void *user)
{
    const task *t = (const task *)user;
    subdiv_options opt = { 0 };
    every_call(t->cage, t->levels, &opt, measure);
    deepest = 0;                        // the first time, calls of libc's functions are linked
    every_call(t->cage, t->levels, &opt, measure);
    return NULL;
}

static void check_stack(const char *name, const subdiv_mesh *cage, int levels)
{
    task t = { cage, levels };
    pthread_attr_t attributes;
    pthread_t thread;
    void *block;
    if (posix_memalign(&block, 65536, STACK)) abort();
    stack = (unsigned char *)block;
    memset(stack, PAINT, STACK);
    pthread_attr_init(&attributes);
    if (pthread_attr_setstack(&attributes, stack, STACK)) abort();
    if (pthread_create(&thread, &attributes, call_all, &t)) abort();
    pthread_join(thread, NULL);
    pthread_attr_destroy(&attributes);
    free(block);
    if (deepest > MOST)
        TEST_REPORT("%s, %d levels: %s takes %d bytes", name, levels, deepest_call, deepest);
    CHECK(deepest > 2000);
}

static void test_random_cages(void)
{
    for (unsigned seed = 1; seed <= 6; seed++) {
        char name[20];
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        if (!c) abort();
        sprintf(name, "cage %u", seed);
        check_stack(name, &c->mesh, 1 + (int)(seed % 5));
        random_cage_free(c);
    }
}

static void test_many_faces(void)
{
    static test_cage cage;
    build_fan(&cage, SUBDIV_CATMULL_CLARK, 60, 1);
    check_stack("60 quads around a vertex", &cage.mesh, 4);
    build_bipyramid(&cage, SUBDIV_LOOP, 60);
    check_stack("60 triangles around a vertex", &cage.mesh, 4);
}

static void test_deep_levels(void)
{
    static test_cage cage;
    build_fan(&cage, SUBDIV_CATMULL_CLARK, 3, 1);
    check_stack("3 quads around a vertex", &cage.mesh, 6);
    build_tetrahedron(&cage, SUBDIV_LOOP);
    check_stack("a tetrahedron", &cage.mesh, 6);
}

int main(void)
{
    int optimised = 1;
#if defined(__GNUC__) && !defined(__OPTIMIZE__)
    optimised = 0;
    puts("test_stack: built without optimisation, SKIPPED");
#endif
    if (optimised) RUN(test_random_cages);
    if (optimised) RUN(test_many_faces);
    if (optimised) RUN(test_deep_levels);
    return test_end("test_stack");
}
