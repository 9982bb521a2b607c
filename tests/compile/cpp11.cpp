// The implementation compiled as C++.
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "cube.h"

int main()
{
    subdiv_mesh mesh = {};
    subdiv_options opt = {};
    subdiv_error error = {};
    opt.error = &error;
    const char text[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n";
    if (subdiv_load_obj_memory(&mesh, text, sizeof text - 1, &opt) != SUBDIV_ERROR_INDEX) return 1;
    if (error.code != SUBDIV_ERROR_INDEX || error.line != 4) return 1;
    return !cube_is_right();
}
