// Runs a fuzzer without libFuzzer, with any compiler: each seed, then so many mutations of them.
//
//     build/fuzz_NAME 300 tests/fuzz/seeds/NAME/*         or 0, for the files alone
//
// A failure names its input: the seed and the number of the mutation, which is always the same one.
#ifndef REPLAY_H
#define REPLAY_H
#ifndef LIBFUZZER

#include <signal.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { REPLAY_MOST = 1 << 16 };

static const char *replay_file = "";
static int replay_run;
static uint64_t replay_state = 1;

static void replay_failed(int signal_number)
{
    fprintf(stderr, "FAILED  %s, mutation %d\n", replay_file, replay_run);
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

static size_t replay_below(size_t count)
{
    replay_state = replay_state * 6364136223846793005u + 1442695040888963407u;
    return count ? (size_t)(replay_state >> 33) % count : 0;
}

// Changes a byte, or cuts, doubles or moves a part.
static size_t replay_mutate(uint8_t *data, size_t size)
{
    size_t at = replay_below(size), to = replay_below(size), part = 1 + replay_below(16);
    size_t most = size - (at > to ? at : to);
    if (part > most) part = most;
    switch (replay_below(size < REPLAY_MOST - 16 ? 6 : 3)) {
    case 0:
        memmove(data + at, data + at + part, size - at - part);
        return size - part;
    case 1:
        memmove(data + to, data + at, part);
        return size;
    case 2: case 3:
        if (size) data[at] ^= (uint8_t)(1 << replay_below(8));
        return size;
    case 4:
        if (size) data[at] = (uint8_t)replay_below(256);
        return size;
    default:
        memmove(data + at + part, data + at, size - at);
        return size + part;
    }
}

static size_t replay_load(const char *path, uint8_t *data)
{
    FILE *file = fopen(path, "rb");
    size_t size = file ? fread(data, 1, REPLAY_MOST, file) : 0;
    if (!file) {
        perror(path);
        exit(1);
    }
    fclose(file);
    replay_file = path;
    return size;
}

int main(int argc, char **argv)
{
    static uint8_t data[REPLAY_MOST];
    int runs = argc > 1 ? atoi(argv[1]) : 0, files = argc - 2;
    signal(SIGABRT, replay_failed);
    signal(SIGSEGV, replay_failed);
    for (int i = 0; i < files + runs && files > 0; i++) {
        size_t size = replay_load(argv[2 + i % files], data);
        replay_run = i < files ? 0 : i - files + 1;
        for (size_t k = i < files ? 0 : 1 + replay_below(6); k > 0; k--)
            size = replay_mutate(data, size);
        uint8_t *exact = (uint8_t *)copy_of(data, size, 1);
        LLVMFuzzerTestOneInput(exact, size);
        free(exact);
    }
    const char *slash = strrchr(argv[0], '/');
    printf("%s, %d inputs  %d passed, %d failed\n", slash ? slash + 1 : argv[0], files + runs,
           files > 0, files < 1);
    return files < 1;
}

#endif
#endif
