// Points and normals on the limit surface beside OpenSubdiv's.
//
// What is left out: OpenSubdiv's tangents write out of bounds at a non-manifold vertex that has
// more faces than edges; its masks at a smooth Catmull-Clark vertex of valence 2 leave the vertex
// where it is; its tangents beside an irregular number of faces along a crease are not those of the
// surface (see test_limit.c for ours). Sharpness that is left on the last level counts as infinite
// in OpenSubdiv's limit, and a dart as smooth: there the limit is not where refinement leads (see
// test_doors.c for ours). Of an interior crease it takes one side; any will do. A corner has the
// tangent plane of its creases where these are a single face apart (Loop: two).

#ifndef LIMIT_H
#define LIMIT_H

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include "result.h"
#include "vector.h"

static const double normal_tolerance = 1e-5;      // and what rounded points can make of it

// What may be the normal of a vertex: tangents, and whether all possible ones are there.
struct Sides {
    std::vector<std::pair<Vector, Vector>> tangents;
    bool all = true;
};

typedef std::vector<std::pair<int, double>> Weights;

static Vector weighed(const std::vector<Point> &points, const Weights &weights)
{
    Vector sum = {};
    for (const auto &w : weights)
        for (int k = 0; k < 3; k++) sum.p[k] += w.second * points[(size_t)w.first].p[k];
    return sum;
}

static int other_end(const Far::TopologyLevel &level, int edge, int v)
{
    const Far::ConstIndexArray ends = level.GetEdgeVertices(edge);
    return ends[0] == v ? ends[1] : ends[0];
}

// The tangents at v between edges i and i + k of its ring, a crease with a regular number of faces
// or a single one, as OpenSubdiv has them for one of the sides.
static void add_side(const Far::TopologyLevel &level, const std::vector<Point> &points, bool loop,
                     int v, int i, int k, Sides &sides)
{
    const Far::ConstIndexArray edges = level.GetVertexEdges(v), faces = level.GetVertexFaces(v);
    const auto end = [&](int j) { return other_end(level, edges[j % edges.size()], v); };
    const int a = end(i), b = end(i + k);
    Weights along = { { a, 1 }, { b, -1 } }, across;
    if (k == 1) {
        across = { { v, -2 }, { a, 1 }, { b, 1 } };
    } else if (loop && k == 3) {
        across = { { v, -2 }, { a, -1 }, { b, -1 }, { end(i + 1), 2 }, { end(i + 2), 2 } };
    } else if (loop && k == 2) {
        across = { { v, -1 }, { end(i + 1), 1 } };
    } else if (!loop && k == 2) {
        across = { { v, -4 }, { a, -1 }, { b, -1 }, { end(i + 1), 4 } };
        for (int j = i; j < i + 2; j++) {
            const Far::ConstIndexArray f = level.GetFaceVertices(faces[j % faces.size()]);
            across.push_back({ f[(f.FindIndex(v) + 2) % 4], 1 });
        }
    } else {
        sides.all = false;
        return;
    }
    sides.tangents.push_back({ weighed(points, along), weighed(points, across) });
}

// The tangents at a corner v: for each pair of sharp edges that follow each other in its ring. Where
// more than a face (Loop: two) lies between them, ours are means: see test_limit.c.
static void add_corner(const Far::TopologyLevel &level, const std::vector<Point> &points, bool loop,
                       int v, Sides &sides)
{
    const Far::ConstIndexArray edges = level.GetVertexEdges(v);
    std::vector<int> sharp;
    for (int i = 0; i < edges.size(); i++)
        if (level.GetEdgeSharpness(edges[i]) > 0) sharp.push_back(i);
    sides.all = !level.IsVertexNonManifold(v) && sharp.size() >= 2;
    for (size_t i = 0; i < sharp.size() && sides.all; i++) {
        const bool last = i + 1 == sharp.size();
        if (last && level.IsVertexBoundary(v)) break;
        const int next = last ? sharp[0] + edges.size() : sharp[i + 1];
        if (next - sharp[i] > (loop ? 2 : 1)) sides.all = false;
        else sides.tangents.push_back({
            minus(points[(size_t)other_end(level, edges[sharp[i]], v)], points[(size_t)v]),
            minus(points[(size_t)other_end(level, edges[next % edges.size()], v)],
                  points[(size_t)v]) });
    }
}

// Does OpenSubdiv's limit of a vertex lie elsewhere than far refinement?
static bool fades(const Far::TopologyLevel &level, int v)
{
    const auto semi = [](float s) { return s > 0 && s < 10; };
    bool result = semi(level.GetVertexSharpness(v)) ||
                  level.GetVertexRule(v) == Sdc::Crease::RULE_DART;
    for (int e : level.GetVertexEdges(v)) result = result || semi(level.GetEdgeSharpness(e));
    return result;
}

static Sides possible_sides(const Far::TopologyLevel &level, const std::vector<Point> &points,
                            subdiv_scheme scheme, int v, const Point &t1, const Point &t2)
{
    const Far::ConstIndexArray edges = level.GetVertexEdges(v), faces = level.GetVertexFaces(v);
    const Sdc::Crease::Rule rule = level.GetVertexRule(v);
    Sides sides;
    if (scheme == SUBDIV_BILINEAR) {
        for (int i = 0; i < faces.size(); i++) {
            const Far::ConstIndexArray f = level.GetFaceVertices(faces[i]);
            for (int j = 0, n = f.size(); j < n; j++)
                if (f[j] == v)
                    sides.tangents.push_back({ minus(points[(size_t)f[(j + 1) % n]],
                                                     points[(size_t)v]),
                                               minus(points[(size_t)f[(j + n - 1) % n]],
                                                     points[(size_t)v]) });
        }
    } else if (rule == Sdc::Crease::RULE_CORNER) {
        add_corner(level, points, scheme == SUBDIV_LOOP, v, sides);
    } else if (rule == Sdc::Crease::RULE_CREASE) {
        std::vector<int> sharp;
        for (int i = 0; i < edges.size(); i++)
            if (level.GetEdgeSharpness(edges[i]) > 0) sharp.push_back(i);
        sides.all = sharp.size() == 2 && !level.IsVertexNonManifold(v);
        if (!sides.all) return sides;
        const int k = sharp[1] - sharp[0], n = edges.size();
        const bool loop = scheme == SUBDIV_LOOP;
        add_side(level, points, loop, v, sharp[0], k, sides);
        if (!level.IsVertexBoundary(v)) add_side(level, points, loop, v, sharp[1], n - k, sides);
    } else {
        sides.all = faces.size() > 2;
        const Point zero = {};
        sides.tangents.push_back({ minus(t1, zero), minus(t2, zero) });
    }
    return sides;
}

// Is n the normal of one of the sides, as well as rounded points can tell?
static bool has_normal(const Sides &sides, double extent, const float *n)
{
    for (const auto &t : sides.tangents) {
        const Vector c = cross(t.first, t.second);
        const double size = length(c), thin = (length(t.first) + length(t.second)) * extent;
        double error = 0;
        if (size <= 1e-5 * thin) return true;
        for (int k = 0; k < 3; k++)
            error = std::max(error, std::fabs((double)n[k] - c.p[k] / size));
        if (error <= normal_tolerance + 4e-6 * thin / size) return true;
    }
    return false;
}

static Point valence_two(const Far::TopologyLevel &level, const std::vector<Point> &points, int v)
{
    const Far::ConstIndexArray edges = level.GetVertexEdges(v), faces = level.GetVertexFaces(v);
    Point p = {};
    p.AddWithWeight(points[(size_t)v], 4.0 / 14);
    for (int i = 0; i < 2; i++) {
        const Far::ConstIndexArray f = level.GetFaceVertices(faces[i]);
        p.AddWithWeight(points[(size_t)other_end(level, edges[i], v)], 4.0 / 14);
        p.AddWithWeight(points[(size_t)f[(f.FindIndex(v) + 2) % 4]], 1.0 / 14);
    }
    return p;
}

// The limit of the points of a level, which has to be the refiner's last; and tangents, unless it
// has no right ones.
static Level find_limit(const Far::TopologyRefiner &refiner, const std::vector<Point> &points,
                        int l, subdiv_scheme scheme, std::vector<Point> &t1,
                        std::vector<Point> &t2)
{
    const Far::TopologyLevel &level = refiner.GetLevel(l);
    const Far::PrimvarRefinerReal<double> primvars(refiner);
    Level limit;
    bool tangents = true;
    limit.points.resize(points.size());
    for (int v = 0; v < level.GetNumVertices(); v++)
        tangents = tangents && level.GetVertexFaces(v).size() <= level.GetVertexEdges(v).size();
    t1.resize(tangents ? points.size() : 0);
    t2.resize(t1.size());
    if (tangents) primvars.Limit(points, limit.points, t1, t2);
    else primvars.Limit(points, limit.points);
    for (int v = 0; v < level.GetNumVertices() && scheme == SUBDIV_CATMULL_CLARK; v++)
        if (level.GetVertexFaces(v).size() == 2 &&
            level.GetVertexRule(v) < Sdc::Crease::RULE_CREASE)
            limit.points[(size_t)v] = valence_two(level, points, v);
    return limit;
}

static void compare_limit(const Reference &ref, const order &o, int l, const subdiv_mesh &cage)
{
    const std::vector<int> ours = match_vertices(ref, o, l);
    const std::vector<Point> &points = ref.levels[(size_t)l].points;
    const std::unique_ptr<Far::TopologyRefiner> refiner(make_refiner(cage, l));
    const Far::TopologyLevel &level = refiner->GetLevel(l);
    const double extent = largest_extent(cage);
    std::vector<Point> t1, t2;
    Level limit = find_limit(*refiner, points, l, cage.scheme, t1, t2);

    subdiv_mesh fine = {};
    subdiv_options opt = {};
    opt.limit = 1;
    if (subdiv_refine(&fine, &cage, l, &opt)) {
        TEST_REPORT("subdiv_refine fails");
        return;
    }
    for (int v = 0; v < level.GetNumVertices() && cage.scheme != SUBDIV_BILINEAR; v++) {
        const float *p = fine.positions + 3 * ours[(size_t)v];
        if (!fades(level, v)) continue;
        for (int k = 0; k < 3; k++) limit.points[(size_t)v].p[k] = (double)p[k];
        totals.fading_limits++;
    }
    compare_positions(limit, ours, cage, fine, totals.largest_limit_error);
    for (int v = 0; v < level.GetNumVertices(); v++) {
        const float *n = fine.normals + 3 * ours[(size_t)v];
        const double size = std::sqrt((double)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
        if (!(size < 1e-30 || std::fabs(size - 1) < 1e-6))
            TEST_REPORT("the normal of vertex %d is %g long", ours[(size_t)v], size);
        totals.no_normals += size < 0.5;
        const bool smooth = level.GetVertexRule(v) < Sdc::Crease::RULE_CREASE;
        if (level.GetVertexFaces(v).size() == 0 || (smooth && t1.empty())) continue;
        if (cage.scheme != SUBDIV_BILINEAR && fades(level, v)) continue;
        const Point t[2] = { t1.empty() ? Point() : t1[(size_t)v],
                             t1.empty() ? Point() : t2[(size_t)v] };
        const Sides sides = possible_sides(level, points, cage.scheme, v, t[0], t[1]);
        const bool same = has_normal(sides, extent, n);
        if (!same && sides.all)
            TEST_REPORT("the normal of vertex %d is (%g %g %g)", ours[(size_t)v], (double)n[0],
                        (double)n[1], (double)n[2]);
        (same ? totals.limit_normals : totals.odd_sides)++;
    }
    totals.limit_points += (long long)points.size();
    subdiv_mesh_free(&fine);
}

#endif
