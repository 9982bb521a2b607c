// --threads: a pool of threads for the library.
#include "cli.h"

#ifdef HAS_PTHREADS

#include <pthread.h>

enum { MAX_THREADS = 256 };

typedef struct pool {
    pthread_mutex_t mutex;            // of all that follows
    pthread_cond_t  work, done;       // there are jobs; none is running any more
    pthread_t       threads[MAX_THREADS];
    int             thread_count, quit;
    void          (*job)(void *context, int i);
    void           *context;
    int             next, count, running;
} pool;

static pool threads;

// Does jobs until all have been taken. The mutex is locked, but not during a job.
static void take_jobs(pool *p)
{
    while (p->next < p->count) {
        int i = p->next++;
        p->running++;
        pthread_mutex_unlock(&p->mutex);
        p->job(p->context, i);
        pthread_mutex_lock(&p->mutex);
        p->running--;
    }
}

static void *thread_main(void *user)
{
    pool *p = (pool *)user;
    pthread_mutex_lock(&p->mutex);
    while (!p->quit) {
        take_jobs(p);
        if (p->running == 0) pthread_cond_signal(&p->done);
        pthread_cond_wait(&p->work, &p->mutex);
    }
    pthread_mutex_unlock(&p->mutex);
    return NULL;
}

// A subdiv_run: the caller takes jobs as the threads do, then waits for theirs.
static void run_jobs(void *user, void (*job)(void *context, int i), void *context, int count)
{
    pool *p = (pool *)user;
    pthread_mutex_lock(&p->mutex);
    p->job = job;
    p->context = context;
    p->next = 0;
    p->count = count;
    pthread_cond_broadcast(&p->work);
    take_jobs(p);
    while (p->running > 0) pthread_cond_wait(&p->done, &p->mutex);
    pthread_mutex_unlock(&p->mutex);
}

// Starts count - 1 threads, or as many as there can be: whatever is missing, the others do.
void start_threads(int count, subdiv_options *opt)
{
    pool *p = &threads;
    pthread_mutex_init(&p->mutex, NULL);
    pthread_cond_init(&p->work, NULL);
    pthread_cond_init(&p->done, NULL);
    for (; p->thread_count < count - 1 && p->thread_count < MAX_THREADS; p->thread_count++)
        if (pthread_create(&p->threads[p->thread_count], NULL, thread_main, p)) break;
    if (p->thread_count == 0) return;
    opt->run = run_jobs;
    opt->user = p;
}

void end_threads(void)
{
    pool *p = &threads;
    pthread_mutex_lock(&p->mutex);
    p->quit = 1;
    pthread_cond_broadcast(&p->work);
    pthread_mutex_unlock(&p->mutex);
    for (int i = 0; i < p->thread_count; i++) pthread_join(p->threads[i], NULL);
    pthread_cond_destroy(&p->done);
    pthread_cond_destroy(&p->work);
    pthread_mutex_destroy(&p->mutex);
}

#else

void start_threads(int count, subdiv_options *opt)
{
    (void)count;
    (void)opt;
}

void end_threads(void)
{
}

#endif
