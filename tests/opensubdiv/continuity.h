// How smooth the surface is along the edges at an extraordinary vertex: what OpenSubdiv's Bfr makes
// of the faces there is Gregory patches, after as many levels as it is asked for: smooth, but not
// the limit surface. exact_oracle.h knows that one.
#ifndef CONTINUITY_H
#define CONTINUITY_H

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>

#include "../lib/exact_oracle.h"
#include "result.h"
#include "vector.h"

namespace Bfr = OpenSubdiv::Bfr;

static const double angle_tolerance = 0.01;       // degrees

// Two rings of faces around vertex 0, uneven. In sector i, (a, b) lies a steps along edge i from
// vertex 0 and b steps along edge i + 1; face first_face(i) has vertex 0, edge i, edge i + 1.
struct Fan {
    subdiv_mesh mesh = {};
    int valence;
    std::vector<float> positions;
    std::vector<int> faces;

    int at(int i, int a, int b) const
    {
        if (a == 0 && b == 0) return 0;
        if (b == 0) return 1 + 6 * (i % valence) + a - 1;
        if (a == 0) return 1 + 6 * ((i + 1) % valence) + b - 1;
        return 1 + 6 * i + 2 + 2 * (a - 1) + b - 1;
    }
    int first_face(int i) const { return (i + valence) % valence * 4; }

    Fan(subdiv_scheme scheme, int n) : valence(n)
    {
        unsigned state = 1;
        positions.resize(3 * (size_t)(1 + 6 * n));
        for (int i = 0; i < n; i++)
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++) {
                    const double angle = 6.283185307179586 * (i + b / (a + b + 1e-9)) / n;
                    float *p = &positions[3 * (size_t)at(i, a, b)];
                    state = state * 1664525u + 1013904223u;
                    p[0] = (float)((a + b) * std::cos(angle));
                    p[1] = (float)((a + b) * std::sin(angle));
                    p[2] = (float)(state >> 16) / 65536.0f;
                }
        const int quads[4][4][2] = { { {0, 0}, {1, 0}, {1, 1}, {0, 1} },
                                     { {1, 0}, {2, 0}, {2, 1}, {1, 1} },
                                     { {0, 1}, {1, 1}, {1, 2}, {0, 2} },
                                     { {1, 1}, {2, 1}, {2, 2}, {1, 2} } };
        const int triangles[4][3][2] = { { {0, 0}, {1, 0}, {0, 1} }, { {1, 0}, {2, 0}, {1, 1} },
                                         { {1, 0}, {1, 1}, {0, 1} }, { {0, 1}, {1, 1}, {0, 2} } };
        mesh.scheme = scheme;
        mesh.face_size = scheme == SUBDIV_LOOP ? 3 : 4;
        for (int i = 0; i < n; i++)
            for (int f = 0; f < 4; f++)
                for (int k = 0; k < mesh.face_size; k++) {
                    const int *p = scheme == SUBDIV_LOOP ? triangles[f][k] : quads[f][k];
                    faces.push_back(at(i, p[0], p[1]));
                }
        mesh.vertex_count = 1 + 6 * n;
        mesh.positions = positions.data();
        mesh.face_count = 4 * n;
        mesh.face_vertices = faces.data();
    }
};

struct Place {
    Vector point, normal;
};

// How a surface does near vertex 0: the largest angle, in degrees, between the normals on both
// sides of an edge there; the largest angle to the exact normal, and distance to the exact point.
struct Quality {
    double between = 0, normal = 0, point = 0;
};

template <class Evaluate> static Quality quality_of(const Fan &fan, const Evaluate &evaluate)
{
    Quality worst;
    slow_mesh *exact = slow_cage(&fan.mesh, 0);
    for (int i = 0; i < fan.valence; i++) {
        const int f = fan.first_face(i), before = fan.first_face(i - 1);
        for (float r = 0.75f; r > 1e-4f; r *= 0.75f)
            worst.between = std::max(worst.between,
                                     angle_between(evaluate(f, r, 0.0f).normal,
                                                   evaluate(before, 0.0f, r).normal));
    }
    for (float u = 0.02f; u < 0.9f; u *= 1.7f) {
        for (float v = 0.03f; u + v < 1; v *= 1.8f) {
            const Place place = evaluate(0, u, v);
            double out[3][3];
            Vector e[3];
            oracle_evaluate(exact, 0, 0, (double)u, (double)v, out);
            memcpy(e, out, sizeof out);
            for (int k = 0; k < 3; k++) e[0].p[k] -= place.point.p[k];
            worst.point = std::max(worst.point, length(e[0]));
            worst.normal = std::max(worst.normal, angle_between(place.normal, cross(e[1], e[2])));
        }
    }
    slow_free(exact);
    return worst;
}

static Quality their_quality(const Fan &fan, int level)
{
    const std::unique_ptr<Far::TopologyRefiner> refiner(make_refiner(fan.mesh, 0));
    Bfr::SurfaceFactory::Options options;
    options.SetApproxLevelSmooth(level);
    const Bfr::RefinerSurfaceFactory<> factory(*refiner, options);
    std::vector<Bfr::Surface<float>> surfaces((size_t)fan.mesh.face_count);
    std::vector<std::vector<float>> points(surfaces.size());
    const Bfr::Surface<float>::PointDescriptor dense(3);
    for (int i = 0; i < fan.valence; i++) {
        const size_t f = (size_t)fan.first_face(i);
        CHECK(factory.InitVertexSurface((int)f, &surfaces[f]));
        points[f].resize(3 * (size_t)surfaces[f].GetNumPatchPoints());
        surfaces[f].PreparePatchPoints(fan.mesh.positions, dense, points[f].data(), dense);
    }
    return quality_of(fan, [&](int f, float u, float v) {
        const float uv[2] = { u, v };
        float p[3], du[3], dv[3];
        surfaces[(size_t)f].Evaluate(uv, points[(size_t)f].data(), dense, p, du, dv);
        return Place{ vector_of(p), cross(vector_of(du), vector_of(dv)) };
    });
}

static Quality our_quality(const Fan &fan)
{
    subdiv_surface *surface = nullptr;
    CHECK_EQUAL(subdiv_prepare(&surface, &fan.mesh, SUBDIV_EXACT, nullptr), SUBDIV_OK);
    std::vector<char> scratch(subdiv_scratch_size(surface, 3));
    CHECK_EQUAL(subdiv_evaluate_begin(surface, 3, fan.mesh.positions, 0, scratch.data(), nullptr),
                SUBDIV_OK);
    const Quality quality = quality_of(fan, [&](int f, float u, float v) {
        const subdiv_location at = { f, 0, u, v };
        subdiv_derivatives out = {};
        float p[3], normal[3];
        out.points = p;
        out.normals = normal;
        CHECK_EQUAL(subdiv_evaluate_at(surface, 3, scratch.data(), 1, &at, &out, nullptr),
                    SUBDIV_OK);
        return Place{ vector_of(p), vector_of(normal) };
    });
    subdiv_surface_free(surface);
    return quality;
}

static void print_quality(const Quality &q)
{
    printf("  %8.4f%9.4f%9.1e", q.between, q.normal, q.point);
}

static void compare_continuity()
{
    const int valences[] = { 3, 4, 5, 6, 7, 8, 10, 12, 16, 20, 30, 40, 50 };
    const char *schemes[] = { "Catmull-Clark", "Loop" };
    printf("Near an extraordinary vertex: the largest angle between the normals on both sides of\n"
           "an edge, the largest to the exact normal, in degrees, and the largest distance to the\n"
           "exact point, where edges of the cage are about 1 long\n"
           "               valence  subdiv.h                    OpenSubdiv's Bfr, 1 level   "
           "2 levels (default)\n");
    for (int scheme = 0; scheme < 2; scheme++) {
        for (const int valence : valences) {
            const Fan fan((subdiv_scheme)scheme, valence);
            const std::string name = std::string(schemes[scheme]) + ", valence "
                                   + std::to_string(valence);
            test_bad = 0;
            test_context = name.c_str();
            const Quality ours = our_quality(fan);
            printf("%-14s%8d", schemes[scheme], valence);
            print_quality(ours);
            print_quality(their_quality(fan, 1));
            print_quality(their_quality(fan, 2));
            printf("\n");
            CHECK_NEAR(ours.between, 0, angle_tolerance);
            CHECK_NEAR(ours.normal, 0, angle_tolerance);
            CHECK_NEAR(ours.point, 0, position_tolerance * largest_extent(fan.mesh));
            (test_bad ? test_failed : test_passed)++;
        }
    }
}

#endif
