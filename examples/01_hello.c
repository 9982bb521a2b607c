// Refines an OBJ file by two levels and writes the smooth mesh, which has 16 faces for each quad of
// the cage. The program prints nothing, unless something is wrong with the file.
//
//     cc -O2 -I. examples/01_hello.c -o build/01_hello -lm && build/01_hello cage.obj fine.obj
//
//     cage.obj:44: vertex 912 does not exist (the file has 900)

#include <stdio.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

int main(int argc, char **argv)
{
    subdiv_mesh cage = {0}, fine = {0};
    subdiv_error error = {0};
    subdiv_options opt = {0};
    opt.error = &error;
    if (subdiv_load_obj(&cage, argc > 1 ? argv[1] : "cage.obj", &opt) ||
        subdiv_refine(&fine, &cage, 2, &opt) ||
        subdiv_save_obj(&fine, argc > 2 ? argv[2] : "fine.obj", &opt))
        printf("%s\n", error.message);
    subdiv_mesh_free(&fine);
    subdiv_mesh_free(&cage);
    return (int)error.code;
}
