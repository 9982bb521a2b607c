// Compares subdiv_refine with OpenSubdiv, level by level: the faces and their order, the holes, the
// map to the cage, the sharpness that is left, the positions, UVs, and up to level 3 the limit.
// Needs libosd (-losdCPU).
//
//     opensubdiv [--continuity] [--random N] [--seed S] [--levels a-b]
//                [--scheme catmull-clark|loop|bilinear] [file.obj ...]
//     opensubdiv --record DIR
//
// A file's scheme is that of its name, loop_ or bilinear_ in front, unless --scheme says otherwise.
// Each file is compared as it is and with every other boundary, creasing and triangle rule in turn.
// --continuity prints how smooth both are at extraordinary vertices. --record writes what OpenSubdiv
// makes of the cages in DIR, for tests/test_recorded.c.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>
#include <opensubdiv/version.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"

#include "exact_oracle.h"
#include "order.h"
#include "random_cage.h"
#include "test.h"

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

static const double position_tolerance = 1e-6;    // of the largest extent of the cage
static const double normal_tolerance = 1e-5;      // and what rounded points can make of it
static const double sharpness_tolerance = 1e-5;   // Chaikin adds up in the order of the edges
static const double angle_tolerance = 0.01;       // degrees
static const long long largest_result = 2000000;  // faces

struct Point {                        // what OpenSubdiv interpolates
    double p[3];
    void Clear() { p[0] = p[1] = p[2] = 0; }
    void AddWithWeight(const Point &q, double w)
    {
        for (int k = 0; k < 3; k++) p[k] += w * q.p[k];
    }
};

typedef std::map<std::pair<int, int>, float> Creases;  // by the ends, the lower first
typedef std::map<int, float> Corners;

// One level of OpenSubdiv's result and how it lies in the order of ours.
struct Level {
    std::vector<Point> points;             // by vertex
    std::vector<Point> uvs;                // by face-varying value
    std::vector<order_place> places;       // by face
    std::vector<char> edges_merely;        // by edge: infinite merely as it is a boundary or
    std::vector<char> vertices_merely;     // by vertex            non-manifold, not by the lists
};

struct Reference {
    std::unique_ptr<Far::TopologyRefiner> refiner;
    std::vector<Level> levels;
    std::vector<unsigned char> hidden;     // by cage face: a hole, marked or by the boundary rule
    int put_right = 0;                     // edge points where OpenSubdiv's are known to be wrong
    std::vector<char> alternating;         // by cage vertex: see find_alternating
    int alternating_count = 0;
};

struct Totals {
    long long cages = 0, uvs = 0, vertices = 0, faces = 0, creases = 0, corners = 0, hidden = 0;
    long long put_right = 0;
    long long limit_points = 0, limit_normals = 0, odd_sides = 0, no_normals = 0;
    double largest_error = 0, largest_limit_error = 0;
    std::map<std::string, long> skips;
};

static Totals totals;

// ------------------------------------------------------------------------ OpenSubdiv's result

static int face_size(const subdiv_mesh &mesh, int face)
{
    return mesh.face_size ? mesh.face_size : mesh.face_sizes[face];
}

static Sdc::Options sdc_options(const subdiv_mesh &cage)
{
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(
        cage.boundary == SUBDIV_BOUNDARY_NONE ? Sdc::Options::VTX_BOUNDARY_NONE :
        cage.boundary == SUBDIV_BOUNDARY_EDGE ? Sdc::Options::VTX_BOUNDARY_EDGE_ONLY :
                                                Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    options.SetCreasingMethod(cage.creasing == SUBDIV_CREASING_CHAIKIN
                              ? Sdc::Options::CREASE_CHAIKIN : Sdc::Options::CREASE_UNIFORM);
    const Sdc::Options::FVarLinearInterpolation uv_rules[] = {
        Sdc::Options::FVAR_LINEAR_CORNERS_ONLY, Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1,
        Sdc::Options::FVAR_LINEAR_CORNERS_PLUS2, Sdc::Options::FVAR_LINEAR_BOUNDARIES,
        Sdc::Options::FVAR_LINEAR_ALL, Sdc::Options::FVAR_LINEAR_NONE };
    options.SetFVarLinearInterpolation(uv_rules[cage.uv_rule]);
    options.SetTriangleSubdivision(cage.triangles == SUBDIV_TRIANGLES_SMOOTH
                                   ? Sdc::Options::TRI_SUB_SMOOTH : Sdc::Options::TRI_SUB_CATMARK);
    return options;
}

static Far::TopologyRefiner *make_refiner(const subdiv_mesh &cage, int levels)
{
    std::vector<int> sizes;
    for (int f = 0; f < cage.face_count; f++) sizes.push_back(face_size(cage, f));

    Far::TopologyDescriptor d;
    d.numVertices = cage.vertex_count;
    d.numFaces = cage.face_count;
    d.numVertsPerFace = sizes.data();
    d.vertIndicesPerFace = cage.face_vertices;
    d.numCreases = cage.crease_count;
    d.creaseVertexIndexPairs = cage.crease_vertices;
    d.creaseWeights = cage.crease_sharpness;
    d.numCorners = cage.corner_count;
    d.cornerVertexIndices = cage.corner_vertices;
    d.cornerWeights = cage.corner_sharpness;
    d.numHoles = cage.hole_count;
    d.holeIndices = cage.holes;
    Far::TopologyDescriptor::FVarChannel uvs;
    uvs.numValues = cage.uv_count;
    uvs.valueIndices = cage.face_uvs;
    d.numFVarChannels = cage.uv_count > 0;
    d.fvarChannels = &uvs;

    const Sdc::SchemeType scheme = cage.scheme == SUBDIV_LOOP ? Sdc::SCHEME_LOOP :
                                   cage.scheme == SUBDIV_BILINEAR ? Sdc::SCHEME_BILINEAR :
                                                                    Sdc::SCHEME_CATMARK;
    typedef Far::TopologyRefinerFactory<Far::TopologyDescriptor> Factory;
    Far::TopologyRefiner *refiner = Factory::Create(d, Factory::Options(scheme, sdc_options(cage)));
    if (!refiner) return nullptr;
    Far::TopologyRefiner::UniformOptions uniform(levels);
    uniform.fullTopologyInLastLevel = true;
    refiner->RefineUniform(uniform);
    return refiner;
}

// Where child j of a face lies. A quad's children keep the axes of their parent, and so do a
// triangle's first three; its middle child 3 is turned by half.
static order_place child_place(subdiv_scheme scheme, order_place parent, int siblings, bool is_cage,
                               int j)
{
    order_place p = parent;
    if (scheme == SUBDIV_LOOP) {
        const int turned = parent.turned, first = turned ? 1 : 0;
        const int rows[2][4] = { {0, 0, 1, 0}, {1, 1, 0, 1} };
        const int columns[2][4] = { {0, 1, 0, 0}, {1, 0, 1, 1} };
        p.row = 2 * parent.row + rows[first][j];
        p.column = 2 * parent.column + columns[first][j];
        p.turned = j == 3 ? !turned : turned;
    } else if (is_cage && siblings != 4) {
        p.quad = j;
    } else {
        p.row = 2 * parent.row + (j >= 2);
        p.column = 2 * parent.column + (j == 1 || j == 2);
    }
    return p;
}

static void find_places(Reference &ref, subdiv_scheme scheme, int l)
{
    const Far::TopologyLevel &level = ref.refiner->GetLevel(l);
    Level &here = ref.levels[(size_t)l];
    here.places.resize((size_t)level.GetNumFaces());
    if (l == 0) {
        for (int f = 0; f < level.GetNumFaces(); f++) {
            const order_place p = { f, 0, 0, 0, 0 };
            here.places[(size_t)f] = p;
            ref.hidden.push_back(level.IsFaceHole(f));
        }
        return;
    }
    const Far::TopologyLevel &parents = ref.refiner->GetLevel(l - 1);
    for (int f = 0; f < parents.GetNumFaces(); f++) {
        const Far::ConstIndexArray children = parents.GetFaceChildFaces(f);
        const order_place parent = ref.levels[(size_t)l - 1].places[(size_t)f];
        for (int j = 0; j < children.size(); j++)
            here.places[(size_t)children[j]] =
                child_place(scheme, parent, children.size(), l == 1, j);
    }
}

// What is infinite at level 0 though the lists of the cage do not say so, and its descendants.
static void find_merely_infinite(Reference &ref, const subdiv_mesh &cage, int l)
{
    const Far::TopologyLevel &level = ref.refiner->GetLevel(l);
    Level &here = ref.levels[(size_t)l];
    here.edges_merely.assign((size_t)level.GetNumEdges(), 0);
    here.vertices_merely.assign((size_t)level.GetNumVertices(), 0);
    if (l == 0) {
        for (int e = 0; e < level.GetNumEdges(); e++)
            here.edges_merely[(size_t)e] = level.GetEdgeSharpness(e) >= SUBDIV_INFINITE;
        for (int v = 0; v < level.GetNumVertices(); v++)
            here.vertices_merely[(size_t)v] = level.GetVertexSharpness(v) >= SUBDIV_INFINITE;
        for (int i = 0; i < cage.crease_count; i++) {
            const int e = level.FindEdge(cage.crease_vertices[2 * i],
                                         cage.crease_vertices[2 * i + 1]);
            if (e < 0) continue;
            here.edges_merely[(size_t)e] = cage.crease_sharpness[i] < SUBDIV_INFINITE
                                        && level.GetEdgeSharpness(e) >= SUBDIV_INFINITE;
        }
        for (int i = 0; i < cage.corner_count; i++) {
            const int v = cage.corner_vertices[i];
            here.vertices_merely[(size_t)v] = cage.corner_sharpness[i] < SUBDIV_INFINITE
                                           && level.GetVertexSharpness(v) >= SUBDIV_INFINITE;
        }
        return;
    }
    const Far::TopologyLevel &parents = ref.refiner->GetLevel(l - 1);
    const Level &above = ref.levels[(size_t)l - 1];
    for (int e = 0; e < parents.GetNumEdges(); e++) {
        const Far::ConstIndexArray children = parents.GetEdgeChildEdges(e);
        for (int j = 0; j < children.size(); j++)
            here.edges_merely[(size_t)children[j]] = above.edges_merely[(size_t)e];
    }
    for (int v = 0; v < parents.GetNumVertices(); v++)
        here.vertices_merely[(size_t)parents.GetVertexChildVertex(v)] =
            above.vertices_merely[(size_t)v];
}

// OpenSubdiv weights an edge point by the edge's sharpness s when its child is no crease. Under
// Chaikin's rule s can be more than 1, which extrapolates; subdiv.h takes 1 instead, the midpoint
// of the edge. No other point of the level depends on an edge point, so it can be put right here.
static int put_edge_points_right(const Far::TopologyLevel &parents, const Far::TopologyLevel &level,
                                 const std::vector<Point> &from, std::vector<Point> &to)
{
    int count = 0;
    for (int e = 0; e < parents.GetNumEdges(); e++) {
        const float s = parents.GetEdgeSharpness(e);
        const int child = parents.GetEdgeChildVertex(e);
        if (s <= 1 || s >= SUBDIV_INFINITE) continue;
        if (level.GetVertexRule(child) == Sdc::Crease::RULE_CREASE) continue;
        const Far::ConstIndexArray ends = parents.GetEdgeVertices(e);
        to[(size_t)child].Clear();
        to[(size_t)child].AddWithWeight(from[(size_t)ends[0]], 0.5);
        to[(size_t)child].AddWithWeight(from[(size_t)ends[1]], 0.5);
        count++;
    }
    return count;
}

static void find_points(Reference &ref, const subdiv_mesh &cage, int l)
{
    std::vector<Point> &points = ref.levels[(size_t)l].points;
    points.resize((size_t)ref.refiner->GetLevel(l).GetNumVertices());
    if (l == 0) {
        for (int i = 0; i < 3 * cage.vertex_count; i++)
            points[(size_t)i / 3].p[i % 3] = (double)cage.positions[i];
        return;
    }
    const std::vector<Point> &parents = ref.levels[(size_t)l - 1].points;
    const Far::PrimvarRefinerReal<double> primvars(*ref.refiner);
    Point *to = points.data();
    primvars.Interpolate(l, parents, to);
    if (cage.scheme != SUBDIV_BILINEAR)
        ref.put_right += put_edge_points_right(ref.refiner->GetLevel(l - 1),
                                               ref.refiner->GetLevel(l), parents, points);
}

static void find_uvs(Reference &ref, const subdiv_mesh &cage, int l)
{
    std::vector<Point> &uvs = ref.levels[(size_t)l].uvs;
    if (cage.uv_count == 0) return;
    uvs.resize((size_t)ref.refiner->GetLevel(l).GetNumFVarValues(0));
    if (l == 0) {
        for (int i = 0; i < 2 * cage.uv_count; i++)
            uvs[(size_t)i / 2].p[i % 2] = (double)cage.uvs[i];
        return;
    }
    const Far::PrimvarRefinerReal<double> primvars(*ref.refiner);
    Point *to = uvs.data();
    primvars.InterpolateFaceVarying(l, ref.levels[(size_t)l - 1].uvs, to, 0);
}

// Where the values around a vertex go A B A B, OpenSubdiv takes the second B for a third value: UVs
// are compared at all other vertices, and on level 1 alone, as they spread from there.
static void find_alternating(Reference &ref)
{
    const Far::TopologyLevel &level = ref.refiner->GetLevel(0);
    ref.alternating.assign((size_t)level.GetNumVertices(), 0);
    for (int v = 0; v < level.GetNumVertices() && level.GetNumFVarChannels(); v++) {
        const Far::ConstIndexArray faces = level.GetVertexFaces(v);
        const Far::ConstLocalIndexArray at = level.GetVertexFaceLocalIndices(v);
        std::vector<int> seen;
        for (int i = 0, last = -1; i < faces.size(); i++) {
            const int value = level.GetFaceFVarValues(faces[i], 0)[at[i]];
            const auto found = std::find(seen.begin(), seen.end(), value);
            if (found == seen.end()) seen.push_back(value);
            else if (value != last && seen.size() == 2 && value == seen[1]) ref.alternating[v] = 1;
            last = value;
        }
        ref.alternating_count += ref.alternating[v];
    }
}

// Around a vertex that a face uses twice, OpenSubdiv's walk can pass an edge twice and miss
// another. It then takes the vertex for manifold, with masks that fail an assertion or read past
// the ring.
static bool has_broken_ring(const Far::TopologyLevel &level)
{
    for (int v = 0; v < level.GetNumVertices(); v++) {
        const Far::ConstIndexArray ring = level.GetVertexEdges(v);
        if (level.IsVertexNonManifold(v)) continue;
        std::vector<int> edges(ring.begin(), ring.end());
        std::sort(edges.begin(), edges.end());
        if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return true;
    }
    return false;
}

// Returns why there is none, or NULL.
static const char *make_reference(Reference &ref, const subdiv_mesh &cage, int levels)
{
    ref.refiner.reset(make_refiner(cage, levels));
    if (!ref.refiner) return "cages that OpenSubdiv refuses";
    if (has_broken_ring(ref.refiner->GetLevel(0)))
        return "cages where OpenSubdiv takes a vertex that a face repeats for manifold";
    find_alternating(ref);
    ref.levels.resize((size_t)levels + 1);
    for (int l = 0; l <= levels; l++) {
        find_places(ref, cage.scheme, l);
        find_merely_infinite(ref, cage, l);
        find_points(ref, cage, l);
        find_uvs(ref, cage, l);
    }
    return nullptr;
}

// ---------------------------------------------------------------------------------- Comparing

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

// ------------------------------------------------------------------------------------- limits
//
// What is left out: OpenSubdiv's tangents write out of bounds at a non-manifold vertex that has
// more faces than edges; its masks at a smooth Catmull-Clark vertex of valence 2 leave the vertex
// where it is; its tangents beside an irregular number of faces along a crease are not those of the
// surface (see test_limit.c for ours). Of an interior crease it takes one side, of a corner one
// face; any will do.

struct Vector {
    double p[3];
};

static Vector minus(const Point &a, const Point &b)
{
    return { { a.p[0] - b.p[0], a.p[1] - b.p[1], a.p[2] - b.p[2] } };
}

static Vector cross(const Vector &a, const Vector &b)
{
    return { { a.p[1] * b.p[2] - a.p[2] * b.p[1], a.p[2] * b.p[0] - a.p[0] * b.p[2],
               a.p[0] * b.p[1] - a.p[1] * b.p[0] } };
}

static double length(const Vector &a)
{
    return std::sqrt(a.p[0] * a.p[0] + a.p[1] * a.p[1] + a.p[2] * a.p[2]);
}

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

static Sides possible_sides(const Far::TopologyLevel &level, const std::vector<Point> &points,
                            subdiv_scheme scheme, int v, const Point &t1, const Point &t2)
{
    const Far::ConstIndexArray edges = level.GetVertexEdges(v), faces = level.GetVertexFaces(v);
    const Sdc::Crease::Rule rule = level.GetVertexRule(v);
    Sides sides;
    if (rule == Sdc::Crease::RULE_CORNER || scheme == SUBDIV_BILINEAR) {
        for (int i = 0; i < faces.size(); i++) {
            const Far::ConstIndexArray f = level.GetFaceVertices(faces[i]);
            for (int j = 0, n = f.size(); j < n; j++)
                if (f[j] == v)
                    sides.tangents.push_back({ minus(points[(size_t)f[(j + 1) % n]],
                                                     points[(size_t)v]),
                                               minus(points[(size_t)f[(j + n - 1) % n]],
                                                     points[(size_t)v]) });
        }
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
    const Level limit = find_limit(*refiner, points, l, cage.scheme, t1, t2);

    subdiv_mesh fine = {};
    subdiv_options opt = {};
    opt.limit = 1;
    if (subdiv_refine(&fine, &cage, l, &opt)) {
        TEST_REPORT("subdiv_refine fails");
        return;
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

static void compare_level(const Reference &ref, const subdiv_mesh &cage, int l, bool keep_holes)
{
    subdiv_mesh fine = {};
    subdiv_error error = {};
    subdiv_options opt = {};
    order o;
    opt.keep_holes = keep_holes;
    opt.error = &error;
    if (!order_make(&o, &cage, l, keep_holes ? nullptr : ref.hidden.data()))
        TEST_REPORT("no memory");
    else if (subdiv_refine(&fine, &cage, l, &opt))
        TEST_REPORT("subdiv_refine fails: %s", error.message);
    else
        compare_result(ref, o, l, fine, keep_holes);
    if (!test_bad && l <= 3) compare_limit(ref, o, l, cage);
    if (test_bad) printf("    at level %d%s\n", l, keep_holes ? ", holes kept" : "");
    order_free(&o);
    subdiv_mesh_free(&fine);
}

// All levels of one cage, which counts as one test. Even levels keep the faces of holes.
static void compare_cage(const subdiv_mesh &cage, int first, int last, const std::string &name)
{
    Reference ref;
    test_bad = 0;
    test_context = name.c_str();
    if (const char *reason = make_reference(ref, cage, last)) {
        totals.skips[reason]++;
        return;
    }
    totals.cages++;
    totals.hidden += std::count(ref.hidden.begin(), ref.hidden.end(), 1);
    totals.put_right += ref.put_right;
    for (int l = first; l <= last && !test_bad; l++) compare_level(ref, cage, l, l % 2 == 0);
    if (test_bad) test_failed++;
    else test_passed++;
}

// --------------------------------------------------------------------------------- continuity
//
// Of the surface itself, along the edges at an extraordinary vertex: what OpenSubdiv's Bfr makes of
// the faces there is Gregory patches, after as many levels as it is asked for: smooth, but not the
// limit surface. exact_oracle.h knows that one.

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

static Vector vector_of(const float *p)
{
    return { { (double)p[0], (double)p[1], (double)p[2] } };
}

static double angle_between(const Vector &a, const Vector &b)
{
    const double d = a.p[0] * b.p[0] + a.p[1] * b.p[1] + a.p[2] * b.p[2];
    return std::atan2(length(cross(a, b)), d) * 57.29577951308232;
}

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
    oracle *exact;
    CHECK(oracle_open(&exact, &fan.mesh));
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
            CHECK(oracle_evaluate(exact, 0, 0, (double)u, (double)v, ORACLE_DEPTH, out));
            memcpy(e, out, sizeof out);
            for (int k = 0; k < 3; k++) e[0].p[k] -= place.point.p[k];
            worst.point = std::max(worst.point, length(e[0]));
            worst.normal = std::max(worst.normal, angle_between(place.normal, cross(e[1], e[2])));
        }
    }
    oracle_close(exact);
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

// -------------------------------------------------------------------------------------- Cages

static const char *file_part(const std::string &path)
{
    const size_t slash = path.find_last_of('/');
    return path.c_str() + (slash == std::string::npos ? 0 : slash + 1);
}

static subdiv_scheme scheme_of_name(const std::string &path)
{
    if (strncmp(file_part(path), "loop_", 5) == 0) return SUBDIV_LOOP;
    if (strncmp(file_part(path), "bilinear_", 9) == 0) return SUBDIV_BILINEAR;
    return SUBDIV_CATMULL_CLARK;
}

static bool load(subdiv_mesh &cage, const std::string &path)
{
    subdiv_error error = {};
    subdiv_options opt = {};
    opt.error = &error;
    if (subdiv_load_obj(&cage, path.c_str(), &opt)) {
        printf("%s\n", error.message);
        return false;
    }
    return true;
}

// The levels that keep the result in bounds.
static int last_level(const subdiv_mesh &cage, int last)
{
    long long faces = cage.face_count;
    int level = 0;
    while (level < last && faces * 4 <= largest_result) {
        faces *= 4;
        level++;
    }
    return level;
}

static void compare_file(const std::string &path, int scheme, int first, int last)
{
    subdiv_mesh cage = {};
    if (!load(cage, path)) {
        test_failed++;
        return;
    }
    cage.scheme = scheme >= 0 ? (subdiv_scheme)scheme : scheme_of_name(path);
    last = last_level(cage, last);
    compare_cage(cage, first, last, path);
    const subdiv_mesh original = cage;
    for (int b = 0; b < 3; b++) {
        cage.boundary = (subdiv_boundary)b;
        if (cage.boundary != original.boundary)
            compare_cage(cage, first, last, path + ", boundary " + std::to_string(b));
    }
    cage.boundary = original.boundary;
    cage.creasing = original.creasing == SUBDIV_CREASING_CHAIKIN ? SUBDIV_CREASING_UNIFORM
                                                                 : SUBDIV_CREASING_CHAIKIN;
    if (cage.crease_count)
        compare_cage(cage, first, last, path + ", creasing " + std::to_string(cage.creasing));
    cage.creasing = original.creasing;
    cage.triangles = original.triangles == SUBDIV_TRIANGLES_SMOOTH ? SUBDIV_TRIANGLES_CATMULL_CLARK
                                                                   : SUBDIV_TRIANGLES_SMOOTH;
    if (cage.scheme == SUBDIV_CATMULL_CLARK)
        compare_cage(cage, first, last, path + ", triangles " + std::to_string(cage.triangles));
    cage.triangles = original.triangles;
    for (int r = SUBDIV_UV_CORNERS_ONLY; r <= SUBDIV_UV_NONE && cage.uv_count; r++) {
        cage.uv_rule = (subdiv_uv_rule)r;
        compare_cage(cage, first, last, path + ", UV rule " + std::to_string(r));
    }
    subdiv_mesh_free(&cage);
}

static void compare_random(unsigned seed, int first, int last)
{
    random_cage *random = random_cage_new(seed, RANDOM_ALL);
    if (!random) {
        test_failed++;
        return;
    }
    compare_cage(random->mesh, first, last, "seed " + std::to_string(seed));
    random_cage_free(random);
}

// ---------------------------------------------------------------------------------- Recording

static const int recorded_level = 2;

static void write_record(FILE *file, const Reference &ref, const subdiv_mesh &cage)
{
    order o;
    CHECK(order_make(&o, &cage, recorded_level, ref.hidden.data()));
    const std::vector<int> ours = match_vertices(ref, o, recorded_level);
    const Level &level = ref.levels[(size_t)recorded_level];
    std::vector<Point> points(ours.size());
    for (size_t v = 0; v < ours.size(); v++) points[(size_t)ours[v]] = level.points[v];

    fprintf(file, "vertices %zu\n", points.size());
    for (const Point &q : points) fprintf(file, "%.9g %.9g %.9g\n", q.p[0], q.p[1], q.p[2]);
    const Creases creases = their_creases(ref, recorded_level, ours, false);
    fprintf(file, "creases %zu\n", creases.size());
    for (const auto &c : creases)
        fprintf(file, "%d %d %.9g\n", c.first.first, c.first.second, (double)c.second);
    const Corners corners = their_corners(ref, recorded_level, ours);
    fprintf(file, "corners %zu\n", corners.size());
    for (const auto &c : corners) fprintf(file, "%d %.9g\n", c.first, (double)c.second);
    fprintf(file, "hidden %d\n", (int)std::count(ref.hidden.begin(), ref.hidden.end(), 1));
    for (size_t f = 0; f < ref.hidden.size(); f++)
        if (ref.hidden[f]) fprintf(file, "%zu\n", f);

    std::vector<Point> t1, t2;
    const Level limit = find_limit(*ref.refiner, level.points, recorded_level, cage.scheme, t1, t2);
    for (size_t v = 0; v < ours.size(); v++) points[(size_t)ours[v]] = limit.points[v];
    fprintf(file, "limit %zu\n", points.size());
    for (const Point &q : points) fprintf(file, "%.9g %.9g %.9g\n", q.p[0], q.p[1], q.p[2]);
    order_free(&o);
}

static bool record_cage(const std::string &directory, const std::string &name)
{
    subdiv_mesh cage = {};
    Reference ref;
    if (!load(cage, directory + "/" + name + ".obj")) return false;
    cage.scheme = scheme_of_name(name);
    test_context = name.c_str();
    bool done = !make_reference(ref, cage, recorded_level) && ref.put_right == 0;
    FILE *file = done ? fopen((directory + "/" + name + ".txt").c_str(), "w") : nullptr;
    if (file) write_record(file, ref, cage);
    done = file && fclose(file) == 0 && !test_bad;
    if (!done) printf("%s: not recorded\n", name.c_str());
    subdiv_mesh_free(&cage);
    return done;
}

// DIR/list.txt names the cages, one a line.
static int record(const std::string &directory)
{
    FILE *list = fopen((directory + "/list.txt").c_str(), "r");
    char name[64];
    int count = 0;
    bool done = list != nullptr;
    while (done && fscanf(list, "%63s", name) == 1) {
        done = record_cage(directory, name);
        count += done;
    }
    if (list) fclose(list);
    printf("%d cages recorded from OpenSubdiv %d.%d.%d\n", count, OPENSUBDIV_VERSION_MAJOR,
           OPENSUBDIV_VERSION_MINOR, OPENSUBDIV_VERSION_PATCH);
    return !done;
}

// --------------------------------------------------------------------------------------- main

static void ignore_warning(const char *)
{
}

static int usage(void)
{
    printf("opensubdiv [--continuity] [--random N] [--seed S] [--levels a-b] "
           "[--scheme catmull-clark|loop|bilinear] [file.obj ...]\n"
           "opensubdiv --record DIR\n");
    return 2;
}

static int report(void)
{
    printf("%lld cages compared: %lld vertices, %lld faces, %lld creases, %lld corners, %lld faces hidden, "
           "largest error %.3g of the extent\n", totals.cages, totals.vertices,
           totals.faces, totals.creases, totals.corners, totals.hidden, totals.largest_error);
    printf("%lld limit points, largest error %.3g of the extent; %lld normals, %lld beside creases "
           "where OpenSubdiv's differ or are not to be had; %lld are 0\n", totals.limit_points,
           totals.largest_limit_error, totals.limit_normals, totals.odd_sides, totals.no_normals);
    printf("%lld edge points of OpenSubdiv put right, Chaikin weights above 1\n",
           totals.put_right);
    for (const auto &skip : totals.skips)
        printf("skipped: %ld %s\n", skip.second, skip.first.c_str());
    return test_end("opensubdiv");
}

int main(int argc, char **argv)
{
    const char *schemes[] = { "catmull-clark", "loop", "bilinear" };
    int random_count = 0, scheme = -1, first = 0, last = 0;
    unsigned seed = 1;
    bool continuity = false;
    std::vector<std::string> files;
    Far::SetWarningCallback(ignore_warning);
    for (int i = 1; i < argc; i++) {
        const std::string arg = argv[i], value = i + 1 < argc ? argv[i + 1] : "";
        if (arg.compare(0, 2, "--") != 0) {
            files.push_back(arg);
            continue;
        }
        if (arg == "--continuity") {
            continuity = true;
            continue;
        }
        if (arg == "--record") {
            return record(value);
        } else if (arg == "--random") {
            random_count = atoi(value.c_str());
        } else if (arg == "--seed") {
            seed = (unsigned)strtoul(value.c_str(), nullptr, 10);
        } else if (arg == "--levels") {
            if (sscanf(value.c_str(), "%d-%d", &first, &last) != 2 || first < 1 || last < first)
                return usage();
        } else if (arg == "--scheme") {
            for (int k = 0; k < 3; k++) if (value == schemes[k]) scheme = k;
            if (scheme < 0) return usage();
        } else {
            return usage();
        }
        i++;
    }
    if (random_count == 0 && files.empty() && !continuity) return usage();
    if (continuity) compare_continuity();
    for (int k = 0; k < random_count; k++)
        compare_random(seed + (unsigned)k, first ? first : 1, last ? last : 3);
    for (const std::string &path : files)
        compare_file(path, scheme, first ? first : 1, last ? last : 4);
    return report();
}
