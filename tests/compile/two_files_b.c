// Uses the implementation of two_files_a.c. The header may be included more than once.
#include "subdiv.h"
#include "subdiv.h"
#include "cube.h"

int main(void)
{
    return !cube_is_right() || strcmp(subdiv_result_string(SUBDIV_OK), "no error") != 0;
}
