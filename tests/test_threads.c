// Every public call, on random cages, with threads and without: the same results. Built with
// -fsanitize=thread it finds what two threads write at once.
//
//     cc -I. tests/test_threads.c -o build/test_threads -lm -pthread && build/test_threads
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/every_call.h"
#include "lib/random_cage.h"
#include "lib/test.h"

enum { THREADS = 3 };

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;       // of next
static int lent;                        // how often the library asked for threads

typedef struct work {
    void (*job)(void *, int);
    void *context;
    int next, count;
} work;

static int take(work *w)
{
    pthread_mutex_lock(&mutex);
    int i = w->next++;
    pthread_mutex_unlock(&mutex);
    return i;
}

static void *work_on(void *user)
{
    work *w = (work *)user;
    for (int i = take(w); i < w->count; i = take(w)) w->job(w->context, i);
    return NULL;
}

static void run(void *user, void (*job)(void *context, int i), void *context, int count)
{
    pthread_t threads[THREADS];
    work w = { job, context, 0, count };
    (void)user;
    lent++;
    for (int i = 0; i < THREADS; i++)
        if (pthread_create(&threads[i], NULL, work_on, &w)) abort();
    for (int i = 0; i < THREADS; i++) pthread_join(threads[i], NULL);
}

static void no_more(const char *call) { (void)call; }

static void test_threads(void)
{
    static char seed_text[40];
    subdiv_options alone = { 0 }, threads = { 0 };
    threads.run = run;
    test_context = seed_text;
    for (unsigned seed = 1; seed <= 10; seed++) {
        random_cage *c = random_cage_new(seed, RANDOM_ALL);
        if (!c) abort();
        sprintf(seed_text, "cage %u", seed);
        CHECK(every_call(&c->mesh, 3, &threads, no_more) ==
              every_call(&c->mesh, 3, &alone, no_more));
        random_cage_free(c);
    }
    CHECK(lent > 20);
}

int main(void)
{
    RUN(test_threads);
    return test_end("test_threads");
}
