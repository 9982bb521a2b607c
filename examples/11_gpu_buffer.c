// Makes a vertex buffer of the camera, whose creases are hard edges, and fills it again in every
// frame while the camera bends. A vertex is 8 floats: position, normal and UV. The program prints
// what the buffer has and how long a frame takes, and writes the last one to build/camera_bent.obj,
// with a v and a vn for each vertex.
//
//     cc -O2 -I. examples/11_gpu_buffer.c -o build/11_gpu_buffer -lm && build/11_gpu_buffer
//
//     14344 points, 15176 vertices, 28672 triangles
//     0.52 ms a frame: no error

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

static void bend(float *out, const subdiv_mesh *rest, float amount)
{
    for (int i = 0; i < 3 * rest->vertex_count; i += 3) {
        float x = rest->positions[i], y = rest->positions[i + 1], angle = amount * x;
        out[i] = x * cosf(angle) - y * sinf(angle);
        out[i + 1] = x * sinf(angle) + y * cosf(angle);
        out[i + 2] = rest->positions[i + 2];
    }
}

static void write_buffer(const subdiv_buffer *buffer, const float *data)
{
    const int *v = (const int *)buffer->indices;
    FILE *file = fopen("build/camera_bent.obj", "w");
    if (!file) return;
    for (int i = 0; i < buffer->vertex_count; i++, data += 8)
        fprintf(file, "v %g %g %g\nvn %g %g %g\n", (double)data[0], (double)data[1],
                (double)data[2], (double)data[3], (double)data[4], (double)data[5]);
    for (int i = 0; i < buffer->index_count; i += 3)
        fprintf(file, "f %d//%d %d//%d %d//%d\n", v[i] + 1, v[i] + 1, v[i + 1] + 1, v[i + 1] + 1,
                v[i + 2] + 1, v[i + 2] + 1);
    fclose(file);
}

int main(void)
{
    subdiv_mesh cage = {0}, fine = {0};
    subdiv_surface *surface = NULL;
    subdiv_buffer buffer = {0};
    subdiv_options opt = {0};
    opt.limit = 1;
    subdiv_result r = subdiv_load_obj(&cage, "examples/cages/camera.obj", NULL);
    if (!r) r = subdiv_prepare(&surface, &cage, 3, &opt);
    if (!r) r = subdiv_surface_mesh(&fine, surface, cage.positions, &opt);
    if (!r) r = subdiv_make_buffer(&buffer, &fine, 4, &opt);
    if (r) return puts(subdiv_result_string(r)), 1;
    printf("%d points, %d vertices, %d triangles\n", buffer.point_count, buffer.vertex_count,
           buffer.index_count / 3);

    float *data = (float *)calloc((size_t)buffer.vertex_count, 8 * sizeof(float));
    float *bent = (float *)malloc(3 * sizeof(float) * (size_t)cage.vertex_count);
    void *scratch = malloc(subdiv_scratch_size(surface, 3));
    if (!data || !bent || !scratch) return 1;
    subdiv_vertices out = {0};
    out.positions = data;
    out.normals = data + 3;
    out.stride = 8;
    if (fine.uv_count) out.uvs = data + 6;
    r = subdiv_fill_buffer(&buffer, &fine, &out, NULL);
    clock_t start = clock();
    for (int frame = 0; frame < 100 && !r; frame++) {
        bend(bent, &cage, 0.006f * (float)frame);
        r = subdiv_evaluate_buffer(&buffer, surface, bent, &out, scratch, NULL);
    }
    printf("%.2f ms a frame: %s\n", 10.0 * (double)(clock() - start) / CLOCKS_PER_SEC,
           subdiv_result_string(r));
    write_buffer(&buffer, data);
    free(scratch);
    free(bent);
    free(data);
    subdiv_buffer_free(&buffer);
    subdiv_mesh_free(&fine);
    subdiv_surface_free(surface);
    subdiv_mesh_free(&cage);
    return (int)r;
}
