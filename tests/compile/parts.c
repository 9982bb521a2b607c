// The implementation with parts left out by macros on the command line; in C and in C++.
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "cube.h"

int main(void)
{
    return !cube_is_right();
}
