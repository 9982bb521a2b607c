// --time, and progress on a terminal: the steps of a run.
#include "cli.h"

#include <time.h>

#ifdef HAS_PTHREADS
#include <signal.h>
#include <sys/time.h>
#include <unistd.h>
#endif

static int         timed;             // steps are to be printed
static const char *step;              // the running one
static double      start;
size_t             written;

static double milliseconds(void)
{
#if defined(HAS_PTHREADS)
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
#elif defined(TIME_UTC)
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
#else
    return 1e3 * (double)clock() / CLOCKS_PER_SEC;      // Windows: of the wall, not the processor
#endif
}

#ifdef HAS_PTHREADS
static volatile sig_atomic_t seconds; // that the timer has counted
static volatile sig_atomic_t shown;   // there is a line to erase

static char *put_text(char *p, const char *text)
{
    while (*text) *p++ = *text++;
    return p;
}

static char *put_number(char *p, size_t number)
{
    size_t power = 1;
    while (number / power > 9) power *= 10;
    for (; power; power /= 10) *p++ = (char)('0' + number / power % 10);
    return p;
}

// Says each second what the program is at. It runs in the middle of other functions, so it calls
// none that may not be entered twice.
static void show_progress(int number)
{
    char line[128], *p = put_text(line, "\rsubdiv: ");
    (void)number;
    p = put_number(put_text(put_text(p, step), ", "), (size_t)++seconds);
    p = put_text(p, " s");
    if (written) p = put_text(put_number(put_text(p, ", "), written >> 20), " MB");
    shown = write(2, line, (size_t)(p - line)) > 0;
}

static void set_timer(int period)
{
    struct itimerval timer = {{0, 0}, {0, 0}};
    timer.it_value.tv_sec = timer.it_interval.tv_sec = period;
    setitimer(ITIMER_REAL, &timer, NULL);
}

void show_steps(int print_times)
{
    struct sigaction action = {0};
    timed = print_times;
    if (!isatty(2)) return;
    action.sa_handler = show_progress;
    action.sa_flags = SA_RESTART;
    step = "start";
    if (sigaction(SIGALRM, &action, NULL) == 0) set_timer(1);
}

void end_progress(void)
{
    if (shown) fputs("\r\033[K", stderr);
    shown = 0;
}
#else
void show_steps(int print_times)
{
    timed = print_times;
}

void end_progress(void)
{
}
#endif

void begin_step(const char *name)
{
    step = name;
    written = 0;
    start = milliseconds();
}

void end_step(int vertex_count)
{
    double ms = milliseconds() - start;
    end_progress();
    if (timed) fprintf(stderr, "%s %.3f ms %.2f ns/vertex\n", step, ms, 1e6 * ms / vertex_count);
}
