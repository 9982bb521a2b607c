// The library in plain mode, private to this file. In the header of tests/plain.sh, each function
// of >>masks begins by telling called() its name.
#define SUBDIV_STATIC
#define SUBDIV_PLAIN
#define SUBDIV_IMPLEMENTATION
static void called(const char *function);
#include "subdiv.h"
#include "plain.h"

enum { FUNCTIONS = 64 };

static const char *names[FUNCTIONS];
static int counts[FUNCTIONS];

static int find(const char *function)
{
    int i = 0;
    while (i + 1 < FUNCTIONS && names[i] && strcmp(names[i], function) != 0) i++;
    return i;
}

static void called(const char *function)
{
    int i = find(function);
    names[i] = function;
    counts[i]++;
}

static void forget_calls(void)
{
    memset(counts, 0, sizeof counts);
}

static int calls(const char *function)
{
    return counts[find(function)];
}

const plain_mode plain = { subdiv_refine, subdiv_prepare, subdiv_surface_free, subdiv_scratch_size,
                           subdiv_evaluate_begin, subdiv_evaluate_faces, subdiv_refined_stencils,
                           forget_calls, calls };
