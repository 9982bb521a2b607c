// What OpenSubdiv makes of a cage: the faces, points and UVs of each level, and where they lie in
// the order of ours.
#ifndef REFERENCE_H
#define REFERENCE_H

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include "subdiv.h"
#include "../lib/order.h"

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

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
    int blocked = 0;                       // cage vertices that are sharp: see leads_through
};

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

// Does every sheet of faces at v reach two edges that are not manifold? A sheet is joined at edges
// that are.
static bool leads_through(const Far::TopologyLevel &level, int v)
{
    const Far::ConstIndexArray faces = level.GetVertexFaces(v);
    const Far::ConstLocalIndexArray at = level.GetVertexFaceLocalIndices(v);
    std::vector<int> sheet;
    for (int i = 0; i < faces.size(); i++) sheet.push_back(i);
    const auto edge = [&](int i, int side) {
        const Far::ConstIndexArray edges = level.GetFaceEdges(faces[i]);
        return edges[(at[i] + side * (edges.size() - 1)) % edges.size()];
    };
    for (int i = 0; i < faces.size(); i++)
        for (int j = 0; j < 4 * i; j++) {
            const int e = edge(i, j % 2), from = sheet[(size_t)i], to = sheet[(size_t)(j / 4)];
            if (e == edge(j / 4, j / 2 % 2) && !level.IsEdgeNonManifold(e))
                std::replace(sheet.begin(), sheet.end(), from, to);
        }
    std::vector<std::set<int>> reached((size_t)faces.size());
    for (int i = 0; i < 2 * faces.size(); i++)
        if (level.IsEdgeNonManifold(edge(i / 2, i % 2)))
            reached[(size_t)sheet[(size_t)i / 2]].insert(edge(i / 2, i % 2));
    for (int s : sheet) if (reached[(size_t)s].size() != 2) return false;
    return true;
}

// OpenSubdiv lets a crease of two non-manifold edges run through a vertex by the numbers of its
// faces and edges alone. Where a sheet of faces does not lead from the one to the other, it is told
// that the vertex is sharp: blocked counts these.
static Far::TopologyRefiner *make_refiner(const subdiv_mesh &cage, int levels, int *blocked = nullptr)
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
    const Factory::Options options(scheme, sdc_options(cage));
    std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(d, options));
    if (!refiner) return nullptr;
    const Far::TopologyLevel &level = refiner->GetLevel(0);
    std::vector<int> corners(cage.corner_vertices, cage.corner_vertices + cage.corner_count);
    std::vector<float> sharpness(cage.corner_sharpness, cage.corner_sharpness + cage.corner_count);
    for (int v = 0; v < cage.vertex_count; v++) {
        if (!level.IsVertexNonManifold(v) || level.GetVertexSharpness(v) >= SUBDIV_INFINITE ||
            leads_through(level, v)) continue;
        corners.push_back(v);
        sharpness.push_back(SUBDIV_INFINITE);
    }
    d.numCorners = (int)corners.size();
    d.cornerVertexIndices = corners.data();
    d.cornerWeights = sharpness.data();
    if (blocked) *blocked = d.numCorners - cage.corner_count;
    if (d.numCorners > cage.corner_count) refiner.reset(Factory::Create(d, options));
    Far::TopologyRefiner::UniformOptions uniform(levels);
    uniform.fullTopologyInLastLevel = true;
    refiner->RefineUniform(uniform);
    return refiner.release();
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
    ref.refiner.reset(make_refiner(cage, levels, &ref.blocked));
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

#endif
