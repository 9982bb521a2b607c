// Writes files so that one under its final name is always whole.
#include "cli.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include <sys/stat.h>
#ifdef _WIN32
#include <direct.h>
#define SEPARATORS "/\\"
#else
#include <unistd.h>
#define SEPARATORS "/"
#endif

// Everything on standard output has to arrive: a full disk is an error as any other.
int flush_output(void)
{
    if (fflush(stdout) == 0 && !ferror(stdout)) return DONE;
    end_progress();
    fputs("subdiv: standard output: writing failed\n", stderr);
    return FAILED;
}

// Once a write has failed, no other is tried, so that errno stays.
size_t write_file(void *user, const void *bytes, size_t size)
{
    FILE *file = (FILE *)user;
    if (ferror(file)) return 0;
    written += size;
    errno = 0;
    return fwrite(bytes, 1, size, file);
}

subdiv_result set_write_error(const subdiv_options *opt)
{
    char message[160];
    const char *reason = errno ? strerror(errno) : "";
    snprintf(message, sizeof message, "writing failed%s%s", *reason ? ": " : "", reason);
    return set_error(opt, SUBDIV_ERROR_IO, message);
}

const char *file_name(const char *path)
{
    const char *name = path;
    for (; *path; path++)
        if (strchr(SEPARATORS, *path)) name = path + 1;
    return name;
}

int is_regular(const char *path)
{
    struct stat file;
    return stat(path, &file) == 0 && (file.st_mode & S_IFMT) == S_IFREG;
}

int is_same_file(const char *a, const char *b)
{
    struct stat one, other;
    if (strcmp(a, "-") == 0 || strcmp(b, "-") == 0) return 0;
    if (strcmp(a, b) == 0) return 1;
    if (!is_regular(a) || stat(a, &one) || stat(b, &other)) return 0;
    return one.st_ino != 0 && one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

static const char *volatile unfinished;   // beside, while that file is open

#ifdef _WIN32
static FILE *open_beside(output *o)
{
    snprintf(o->beside, sizeof o->beside, "%s.tmp", o->path);
    unfinished = o->beside;
    return fopen(o->beside, "wb");
}

// Here rename does not replace. If it fails now, the file is still there under its other name.
static int rename_output(const output *o)
{
    remove(o->path);
    return rename(o->beside, o->path);
}
#else
static FILE *open_beside(output *o)
{
    struct stat old;
    if (strncmp(o->path, "/dev/", 5) != 0 && realpath(o->path, o->real)) o->path = o->real;
    int exists = lstat(o->path, &old) == 0;
    if (exists && (!S_ISREG(old.st_mode) || access(o->path, W_OK))) return NULL;
    snprintf(o->beside, sizeof o->beside, "%s.%ld.tmp", o->path, (long)getpid());
    unfinished = o->beside;
    FILE *file = fopen(o->beside, "wb");
    if (file && exists) chmod(o->beside, old.st_mode & 0777);
    return file;
}

static int rename_output(const output *o)
{
    return rename(o->beside, o->path);
}

// Ends the program after Ctrl-C, or when nobody reads what it writes, without a word.
static void stop(int number)
{
    const char *name = unfinished;
    (void)number;
    if (name) unlink(name);
    _exit(FAILED);
}
#endif

void catch_signals(void)
{
#ifndef _WIN32
    const int numbers[] = {SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGTERM};
    signal(SIGXFSZ, SIG_IGN);         // then a file that may not be so large is an error
    for (int i = 0; i < 5; i++)
        if (signal(numbers[i], stop) == SIG_IGN && numbers[i] != SIGPIPE)
            signal(numbers[i], SIG_IGN);
#endif
}

static int fail_output(const char *path)
{
    end_progress();
    fprintf(stderr, "subdiv: %s: %s\n", path, strerror(errno));
    return FAILED;
}

int make_folder(const char *path)
{
#ifdef _WIN32
    int failed = _mkdir(path);
#else
    int failed = mkdir(path, 0777);
#endif
    return failed && errno != EEXIST ? fail_output(path) : DONE;
}

int open_output(output *o, const char *name)
{
    o->name = o->path = name;
    o->file = stdout;
    if (name == NULL || strcmp(name, "-") == 0) return DONE;
    errno = 0;
    o->file = strlen(name) < sizeof o->real ? open_beside(o) : NULL;
    if (o->file == NULL) unfinished = NULL;
    if (o->file == NULL && errno != ENOSPC) o->file = fopen(o->path, "wb");
    if (o->file == NULL) return fail_output(name);
    setvbuf(o->file, NULL, _IONBF, 0);                // large blocks are written
    return DONE;
}

// Looks at how writing ended.
int close_output(output *o, subdiv_result result, const char *input, const subdiv_options *opt)
{
    if (o->file == stdout)
        return result && result != SUBDIV_ERROR_IO ? report(input, opt) : flush_output();
    int failed = fclose(o->file) != 0 || result;
    if (!failed && unfinished) failed = rename_output(o) != 0;
    if (failed && !result) fail_output(o->name);
    if (failed && unfinished) remove(o->beside);
    unfinished = NULL;
    if (result) return report(o->name, opt);
    return failed ? FAILED : DONE;
}
