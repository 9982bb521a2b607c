// Lends the library three threads. The program prints that the octopus takes less time with them
// and has the same bits.
//
//     cc -O2 -I. examples/07_threads.c -o build/07_threads -lm -pthread && build/07_threads
//
//     alone 20.7 ms, with three threads 12.7 ms, the same bits

#define _POSIX_C_SOURCE 200809L
#include <pthread.h>                    // and time.h
#include <stdio.h>
#include <string.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

// The pool: whoever is free takes the next job. With OpenMP all of it is one loop in run:
//     #pragma omp parallel for schedule(dynamic)
//     for (int i = 0; i < count; i++) job(context, i);
static struct todo { void (*job)(void *, int); void *context; int next, ended, count; } todo;
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;       // of todo
static pthread_cond_t wake = PTHREAD_COND_INITIALIZER, done = PTHREAD_COND_INITIALIZER;

static void *work(void *is_thread)      // the caller of run works until done, a thread for ever
{
    pthread_mutex_lock(&mutex);
    while (is_thread || todo.ended < todo.count) {
        if (todo.next == todo.count) pthread_cond_wait(is_thread ? &wake : &done, &mutex);
        if (todo.next == todo.count) continue;
        int i = todo.next++;
        pthread_mutex_unlock(&mutex);
        todo.job(todo.context, i);
        pthread_mutex_lock(&mutex);
        if (++todo.ended == todo.count) pthread_cond_signal(&done);
    }
    pthread_mutex_unlock(&mutex);
    return NULL;
}

static void run(void *user, void (*job)(void *context, int i), void *context, int count)
{
    (void)user;
    pthread_mutex_lock(&mutex);
    todo = (struct todo){job, context, 0, 0, count};
    pthread_cond_broadcast(&wake);
    pthread_mutex_unlock(&mutex);
    work(NULL);
}

int main(void)
{
    static subdiv_mesh cage, fine[2];
    static subdiv_surface *surface;
    pthread_t thread;
    subdiv_options opt = {0};
    if (subdiv_load_obj(&cage, "examples/cages/octopus.obj", &opt)) return 1;
    if (subdiv_prepare(&surface, &cage, 6, &opt)) return 1;
    for (int i = 0; i < 3; i++) pthread_create(&thread, NULL, work, &todo);
    for (int i = 0; i < 2; i++) {
        struct timespec a, b;
        if (subdiv_surface_mesh(&fine[i], surface, cage.positions, &opt)) return 1;
        clock_gettime(CLOCK_MONOTONIC, &a);
        subdiv_evaluate(surface, 3, cage.positions, 0, fine[i].positions, 0, NULL, &opt);
        clock_gettime(CLOCK_MONOTONIC, &b);
        printf("%s %.1f ms, ", i ? "with three threads" : "alone",
               1e3 * (double)(b.tv_sec - a.tv_sec) + 1e-6 * (double)(b.tv_nsec - a.tv_nsec));
        opt.run = run;
    }
    size_t size = 3 * sizeof(float) * (size_t)fine[0].vertex_count;
    int same = memcmp(fine[0].positions, fine[1].positions, size) == 0;
    puts(same ? "the same bits" : "but other bits");
    return !same;
}
