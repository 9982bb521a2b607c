// One level of our result beside OpenSubdiv's: the order, faces, positions, UVs, and the sharpness
// that is left.
#ifndef RESULT_H
#define RESULT_H

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "../lib/test.h"
#include "reference.h"

static const double position_tolerance = 1e-6;    // of the largest extent of the cage
static const double sharpness_tolerance = 1e-5;   // Chaikin adds up in the order of the edges

struct Totals {
    long long cages = 0, uvs = 0, vertices = 0, faces = 0, creases = 0, corners = 0, hidden = 0;
    long long put_right = 0, blocked = 0;
    long long limit_points = 0, fading_limits = 0, limit_normals = 0, odd_sides = 0, no_normals = 0;
    double largest_error = 0, largest_limit_error = 0;
    std::map<std::string, long> skips;
};

static Totals totals;

// Our index of each vertex of OpenSubdiv, from the places of all faces, hidden ones too. Reports
// when the faces disagree or the two numberings are not one to one. A vertex of the cage has the
// same index in both at every level.
static std::vector<int> match_vertices(const Reference &ref, const order &o, int l)
{
    const Far::TopologyLevel &level = ref.refiner->GetLevel(l);
    std::vector<int> ours((size_t)level.GetNumVertices(), -1);
    std::vector<int> theirs((size_t)o.point_count, -1);
    CHECK_EQUAL(level.GetNumVertices(), o.point_count);
    for (int v = 0; v < o.cage->vertex_count; v++) ours[(size_t)v] = theirs[(size_t)v] = v;
    for (int f = 0; f < level.GetNumFaces(); f++) {
        const Far::ConstIndexArray v = level.GetFaceVertices(f);
        int points[4];
        const int size = order_face_points(&o, ref.levels[(size_t)l].places[(size_t)f], points);
        CHECK_EQUAL(v.size(), size);
        for (int i = 0; i < size; i++) {
            int &our = ours[(size_t)v[i]], &their = theirs[(size_t)points[i]];
            if (our < 0 && their < 0) {
                our = points[i];
                their = v[i];
            }
            if (our != points[i] || their != v[i])
                TEST_REPORT("the order gives point %d, OpenSubdiv's vertex %d is point %d",
                            points[i], v[i], our);
        }
    }
    CHECK(std::count(theirs.begin(), theirs.end(), -1) == 0);
    return ours;
}

static void compare_faces(const Reference &ref, const order &o, int l, const subdiv_mesh &fine,
                          bool keep_holes)
{
    const std::vector<order_place> &places = ref.levels[(size_t)l].places;
    const int size = o.cage->scheme == SUBDIV_LOOP ? 3 : 4;
    std::vector<char> is_hole((size_t)fine.face_count, 0);
    CHECK_EQUAL(fine.face_count, o.face_count);
    if (fine.face_count != o.face_count) return;

    for (int i = 0; i < fine.hole_count; i++) is_hole[(size_t)fine.holes[i]] = 1;
    if (!keep_holes) CHECK_EQUAL(fine.hole_count, 0);
    for (size_t i = 0; i < places.size(); i++) {
        const order_place p = places[i];
        const bool hidden = ref.hidden[(size_t)p.face];
        if (hidden && !keep_holes) continue;
        int points[4];
        const int f = order_face(&o, p);
        order_face_points(&o, p, points);
        CHECK_EQUAL(face_size(fine, f), size);
        if (memcmp(points, fine.face_vertices + size * f, sizeof(int) * (size_t)size) != 0)
            TEST_REPORT("fine face %d (face %d, quad %d, row %d, column %d) has other vertices",
                        f, p.face, p.quad, p.row, p.column);
        CHECK_EQUAL(fine.cage_faces[f], p.face);
        CHECK_EQUAL(is_hole[(size_t)f], hidden);
    }
}

static double largest_extent(const subdiv_mesh &mesh)
{
    double largest = 0;
    for (int k = 0; k < 3; k++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int v = 0; v < mesh.vertex_count; v++) {
            low = std::min(low, (double)mesh.positions[3 * v + k]);
            high = std::max(high, (double)mesh.positions[3 * v + k]);
        }
        largest = std::max(largest, high - low);
    }
    return largest;
}

static void compare_positions(const Level &level, const std::vector<int> &ours,
                              const subdiv_mesh &cage, const subdiv_mesh &fine,
                              double &largest)
{
    const double extent = largest_extent(cage);
    for (size_t v = 0; v < ours.size(); v++) {
        const float *p = fine.positions + 3 * ours[v];
        double error = 0;
        for (int k = 0; k < 3; k++)
            error = std::max(error, std::fabs((double)p[k] - level.points[v].p[k]));
        if (!(error <= position_tolerance * extent)) {
            const double *q = level.points[v].p;
            TEST_REPORT("vertex %d is at (%.7g %.7g %.7g), OpenSubdiv's at (%.7g %.7g %.7g)",
                        ours[v], (double)p[0], (double)p[1], (double)p[2], q[0], q[1], q[2]);
        } else if (error > 0) {
            largest = std::max(largest, error / extent);
        }
    }
}

// The same values at each vertex of each face; equal indices where OpenSubdiv's are.
static void compare_uvs(const Reference &ref, const order &o, int l, const subdiv_mesh &fine,
                        const std::vector<int> &ours_of, bool keep_holes)
{
    const Level &here = ref.levels[(size_t)l];
    const Far::TopologyLevel &level = ref.refiner->GetLevel(l);
    const int size = o.cage->scheme == SUBDIV_LOOP ? 3 : 4;
    std::vector<int> ours(here.uvs.size(), -1), theirs((size_t)fine.uv_count, -1);
    double extent = 0;
    for (int k = 0; k < 2; k++) {
        float low = o.cage->uvs[k], high = low;
        for (int i = 0; i < o.cage->uv_count; i++) {
            low = std::min(low, o.cage->uvs[2 * i + k]);
            high = std::max(high, o.cage->uvs[2 * i + k]);
        }
        extent = std::max(extent, (double)high - (double)low);
    }
    for (int i = 0; i < level.GetNumFaces(); i++) {
        const order_place p = here.places[(size_t)i];
        if (ref.hidden[(size_t)p.face] && !keep_holes) continue;
        const int *own = fine.face_uvs + size * order_face(&o, p);
        const Far::ConstIndexArray their = level.GetFaceFVarValues(i, 0);
        for (int j = 0; j < size; j++) {
            const int vertex = ours_of[(size_t)level.GetFaceVertices(i)[j]];
            if (vertex < o.cage->vertex_count && ref.alternating[(size_t)vertex]) continue;
            const int a = own[j], b = their[j];
            if (a < 0 || a >= fine.uv_count) {
                TEST_REPORT("fine face %d has UV %d of %d", order_face(&o, p), a, fine.uv_count);
                return;
            }
            if (l > 0 && ours[(size_t)b] < 0 && theirs[(size_t)a] < 0) {
                ours[(size_t)b] = a;
                theirs[(size_t)a] = b;
                totals.uvs++;
            }
            if (l > 0 && (ours[(size_t)b] != a || theirs[(size_t)a] != b))
                TEST_REPORT("a vertex of face %d has UV %d, OpenSubdiv's %d is UV %d",
                            p.face, a, b, ours[(size_t)b]);
            for (int k = 0; k < 2; k++) {
                const double error = fabs((double)fine.uvs[2 * a + k] - here.uvs[(size_t)b].p[k]);
                if (!(error <= position_tolerance * extent))
                    TEST_REPORT("face %d: a UV is %.7g, OpenSubdiv's %.7g", p.face,
                                (double)fine.uvs[2 * a + k], here.uvs[(size_t)b].p[k]);
            }
        }
    }
}

// The sharpness that OpenSubdiv has left, under our numbers; without the edges of hidden faces
// alone when these are left out.
static Creases their_creases(const Reference &ref, int l, const std::vector<int> &ours,
                             bool keep_holes)
{
    const Far::TopologyLevel &level = ref.refiner->GetLevel(l);
    Creases creases;
    for (int e = 0; e < level.GetNumEdges(); e++) {
        const float s = level.GetEdgeSharpness(e);
        if (s <= 0 || ref.levels[(size_t)l].edges_merely[(size_t)e]) continue;
        bool seen = keep_holes;
        const Far::ConstIndexArray faces = level.GetEdgeFaces(e);
        for (int i = 0; i < faces.size(); i++) seen = seen || !level.IsFaceHole(faces[i]);
        if (!seen) continue;
        const Far::ConstIndexArray ends = level.GetEdgeVertices(e);
        creases[std::minmax(ours[(size_t)ends[0]], ours[(size_t)ends[1]])] = s;
    }
    return creases;
}

static Corners their_corners(const Reference &ref, int l, const std::vector<int> &ours)
{
    const Far::TopologyLevel &level = ref.refiner->GetLevel(l);
    Corners corners;
    for (int v = 0; v < level.GetNumVertices(); v++) {
        const float s = level.GetVertexSharpness(v);
        if (s > 0 && !ref.levels[(size_t)l].vertices_merely[(size_t)v])
            corners[ours[(size_t)v]] = s;
    }
    return corners;
}

// Every entry of one list must be in the other; what is missing has sharpness 0.
static void compare_sharpness(const Creases &creases, const Corners &corners,
                              const subdiv_mesh &fine)
{
    Creases our_creases;
    Corners our_corners;
    for (int i = 0; i < fine.crease_count; i++) {
        const int *v = fine.crease_vertices + 2 * i;
        CHECK(our_creases.emplace(std::minmax(v[0], v[1]), fine.crease_sharpness[i]).second);
    }
    for (int i = 0; i < fine.corner_count; i++)
        CHECK(our_corners.emplace(fine.corner_vertices[i], fine.corner_sharpness[i]).second);

    std::map<std::pair<int, int>, std::pair<float, float>> both;
    for (const auto &c : creases) both[c.first].first = c.second;
    for (const auto &c : our_creases) both[c.first].second = c.second;
    for (const auto &c : corners) both[std::make_pair(c.first, -1)].first = c.second;
    for (const auto &c : our_corners) both[std::make_pair(c.first, -1)].second = c.second;
    for (const auto &c : both) {
        const double their = (double)c.second.first, our = (double)c.second.second;
        if (!(std::fabs(their - our) <= sharpness_tolerance))
            TEST_REPORT("the sharpness of %s %d %d is %.9g, OpenSubdiv's %.9g",
                        c.first.second < 0 ? "vertex" : "edge", c.first.first, c.first.second, our,
                        their);
    }
    totals.creases += (long long)creases.size();
    totals.corners += (long long)corners.size();
}

static void compare_result(const Reference &ref, const order &o, int l, const subdiv_mesh &fine,
                           bool keep_holes)
{
    const std::vector<int> ours = match_vertices(ref, o, l);
    CHECK_EQUAL(fine.vertex_count, o.point_count);
    if (test_bad) return;
    compare_faces(ref, o, l, fine, keep_holes);
    compare_sharpness(their_creases(ref, l, ours, keep_holes), their_corners(ref, l, ours), fine);
    compare_positions(ref.levels[(size_t)l], ours, *o.cage, fine,
                      totals.largest_error);
    if (o.cage->uv_count && !ref.put_right &&   // (their UVs are wrong there, too)
        (l <= 1 || ref.alternating_count == 0)) compare_uvs(ref, o, l, fine, ours, keep_holes);
    totals.vertices += fine.vertex_count;
    totals.faces += fine.face_count;
}

#endif
