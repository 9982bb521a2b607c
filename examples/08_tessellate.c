// Tessellates the octopus for a camera: cuts each edge of the cage into pieces that are about 8
// pixels long on the screen. The program prints how many faces this takes, how many more one rate
// for all edges would take, and that there are no gaps. It writes build/octopus_seen.obj.
//
//     cc -O2 -I. examples/08_tessellate.c -o build/08_tessellate -lm && build/08_tessellate
//
//     rates up to 20, 57323 faces; rate 20 for all, 272000 faces; 0 open edges

#include <math.h>
#include <stdio.h>
#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

typedef struct camera {
    float eye[3];
    double pixels;                  // that a thing as large as it is far away has on the screen
    double piece;                   // pixels
    int largest;                    // rate so far
} camera;

static double distance(const float *a, const float *b)
{
    double x = (double)(a[0] - b[0]), y = (double)(a[1] - b[1]), z = (double)(a[2] - b[2]);
    return sqrt(x * x + y * y + z * z);
}

// How long the edge is on the screen, in pieces, rounded up.
static int rate_of(void *user, int edge, const float *a, const float *middle, const float *b)
{
    camera *c = (camera *)user;
    double length = distance(a, middle) + distance(middle, b);
    double pieces = length / distance(middle, c->eye) * c->pixels / c->piece;
    int rate = (int)fmin(ceil(pieces), 1000);
    (void)edge;
    if (c->largest < rate) c->largest = rate;
    return rate;
}

int main(void)
{
    camera view = { { 0, 2, 4 }, 1000, 8, 0 };
    subdiv_mesh cage = {0}, seen = {0}, even = {0};
    subdiv_info info = {0};
    subdiv_tessellation how = {0};
    how.edge_rate = rate_of;
    how.user = &view;
    subdiv_result r = subdiv_load_obj(&cage, "examples/cages/octopus.obj", NULL);
    if (!r) r = subdiv_tessellate(&seen, &cage, &how, NULL);
    if (!r) r = subdiv_inspect(&info, &seen, NULL);
    if (!r) r = subdiv_save_obj(&seen, "build/octopus_seen.obj", NULL);

    how.edge_rate = NULL;
    how.rate = view.largest;
    if (!r) r = subdiv_tessellate(&even, &cage, &how, NULL);
    if (!r) printf("rates up to %d, %d faces; rate %d for all, %d faces; %d open edges\n",
                   view.largest, seen.face_count, view.largest, even.face_count,
                   info.boundary_edge_count);
    puts(subdiv_result_string(r));
    subdiv_mesh_free(&even);
    subdiv_mesh_free(&seen);
    subdiv_mesh_free(&cage);
    return (int)r;
}
