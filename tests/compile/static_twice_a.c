// One of two files with an implementation of their own each, linked together.
#define SUBDIV_STATIC
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "cube.h"

int cube_is_right_in_b(void);

int main(void)
{
    return !cube_is_right() || !cube_is_right_in_b();
}
