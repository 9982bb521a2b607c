// The plain case: declarations and implementation in one C file.
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "cube.h"

int main(void)
{
    return !cube_is_right();
}
