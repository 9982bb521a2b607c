// Uses, from C++, the implementation that two_files_a.c compiles as C.
#include "subdiv.h"
#include "cube.h"

int main()
{
    return !cube_is_right();
}
