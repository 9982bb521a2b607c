// The other of the two files, see private_a.c.
#define SUBDIV_STATIC
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "cube.h"

int cube_is_right_in_b(void);

int cube_is_right_in_b(void)
{
    return cube_is_right();
}
