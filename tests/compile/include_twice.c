// The header first without and then twice with SUBDIV_IMPLEMENTATION, as happens when several
// headers of a project include it: one implementation.
#include "subdiv.h"
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "subdiv.h"
#include "cube.h"

int main(void)
{
    return !cube_is_right();
}
