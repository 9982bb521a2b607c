// OBJ through memory where there are no files. The driver looks whether anything of stdio is left.
#define SUBDIV_NO_STDIO
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "cube.h"

#if defined(EOF) || defined(BUFSIZ)
#error subdiv.h has included stdio.h
#endif

int main(void)
{
    const char text[] = "v 0 0 0\nv 1 0 0\nv 0 1.5 0\nf 1 2 3\n";
    char saved[sizeof text];
    size_t size = 0;
    subdiv_mesh mesh;
    if (subdiv_load_obj_memory(&mesh, text, sizeof text - 1, NULL)) return 1;
    if (subdiv_save_obj_memory(&mesh, saved, sizeof saved, &size, NULL)) return 1;
    subdiv_mesh_free(&mesh);
    if (size != sizeof text - 1 || memcmp(saved, text, size) != 0) return 1;
    return !cube_is_right();
}
