// OpenSubdiv for bench.c: each task in the way that was found fastest on one thread.

#include <cmath>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>
#include <opensubdiv/version.h>

#include "bench.h"

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

template <int channels> struct Values {
    float value[channels];
    void Clear()
    {
        for (int k = 0; k < channels; k++) value[k] = 0;
    }
    void AddWithWeight(const Values &from, float weight)
    {
        for (int k = 0; k < channels; k++) value[k] += weight * from.value[k];
    }
};
typedef Values<3> Point;

// Unlike a std::vector these are not filled with zeros first, which would cost OpenSubdiv time.
template <class T> struct Array {
    T *at = nullptr;
    Array() {}
    Array(const Array &) = delete;
    Array &operator=(const Array &) = delete;
    ~Array() { free(); }
    void make(size_t count)
    {
        free();
        at = static_cast<T *>(std::malloc(count * sizeof(T)));
        if (!at) std::abort();
    }
    void free()
    {
        std::free(at);
        at = nullptr;
    }
};

struct peer {
    const subdiv_mesh *cage;
    int levels;
    std::vector<int> sizes;
    std::unique_ptr<Far::TopologyRefiner> refiner;
    std::unique_ptr<const Far::StencilTable> table;
    std::vector<Array<Point>> points;      // by level, for re-evaluation
    Array<Point> positions;                // of the last level
    Array<Point> limits[3];                // positions and tangents there; then the first tangent's
                                           // place has the normal
    Array<int> face_vertices;
    Array<float> out;
};

static Sdc::Options sdc_options(const subdiv_mesh &cage)
{
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(
        cage.boundary == SUBDIV_BOUNDARY_NONE ? Sdc::Options::VTX_BOUNDARY_NONE :
        cage.boundary == SUBDIV_BOUNDARY_EDGE ? Sdc::Options::VTX_BOUNDARY_EDGE_ONLY :
                                                Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    options.SetCreasingMethod(cage.creasing == SUBDIV_CREASING_CHAIKIN
                              ? Sdc::Options::CREASE_CHAIKIN : Sdc::Options::CREASE_UNIFORM);
    options.SetTriangleSubdivision(cage.triangles == SUBDIV_TRIANGLES_SMOOTH
                                   ? Sdc::Options::TRI_SUB_SMOOTH : Sdc::Options::TRI_SUB_CATMARK);
    return options;
}

static peer *open_peer(const subdiv_mesh *cage, int levels)
{
    peer *p = new peer;
    p->cage = cage;
    p->levels = levels;
    for (int f = 0; f < cage->face_count; f++)
        p->sizes.push_back(cage->face_size ? cage->face_size : cage->face_sizes[f]);
    return p;
}

static void close_peer(peer *p)
{
    delete p;
}

static void make_points(peer *p)
{
    std::vector<Array<Point>>((size_t)p->levels + 1).swap(p->points);
    for (int l = 1; l <= p->levels; l++)
        p->points[(size_t)l].make((size_t)p->refiner->GetLevel(l).GetNumVertices());
}

// Where a vertex has more faces than edges, Limit would write its tangents out of bounds.
static int prepare_limit(peer *p)
{
    const Far::TopologyLevel &last = p->refiner->GetLevel(p->levels);
    for (int v = 0; v < last.GetNumVertices(); v++)
        if (last.GetVertexFaces(v).size() > last.GetVertexEdges(v).size()) return 0;
    make_points(p);
    for (Array<Point> &limit : p->limits) limit.make((size_t)last.GetNumVertices());
    return 1;
}

static int prepare(peer *p, int limit)
{
    const subdiv_mesh &cage = *p->cage;
    Far::TopologyDescriptor d;
    d.numVertices = cage.vertex_count;
    d.numFaces = cage.face_count;
    d.numVertsPerFace = p->sizes.data();
    d.vertIndicesPerFace = cage.face_vertices;
    d.numCreases = cage.crease_count;
    d.creaseVertexIndexPairs = cage.crease_vertices;
    d.creaseWeights = cage.crease_sharpness;
    d.numCorners = cage.corner_count;
    d.cornerVertexIndices = cage.corner_vertices;
    d.cornerWeights = cage.corner_sharpness;
    d.numHoles = cage.hole_count;
    d.holeIndices = cage.holes;

    const Sdc::SchemeType scheme = cage.scheme == SUBDIV_LOOP ? Sdc::SCHEME_LOOP :
                                   cage.scheme == SUBDIV_BILINEAR ? Sdc::SCHEME_BILINEAR :
                                                                    Sdc::SCHEME_CATMARK;
    typedef Far::TopologyRefinerFactory<Far::TopologyDescriptor> Factory;
    p->refiner.reset(Factory::Create(d, Factory::Options(scheme, sdc_options(cage))));
    if (!p->refiner) return 0;
    Far::TopologyRefiner::UniformOptions uniform(p->levels);
    uniform.fullTopologyInLastLevel = limit;
    p->refiner->RefineUniform(uniform);
    return !limit || prepare_limit(p);
}

// Only two levels of points live at a time.
static void find_positions(peer *p)
{
    const Far::PrimvarRefiner primvars(*p->refiner);
    const Point *from = reinterpret_cast<const Point *>(p->cage->positions);
    Array<Point> above;
    for (int l = 1; l <= p->levels; l++) {
        p->positions.make((size_t)p->refiner->GetLevel(l).GetNumVertices());
        Point *to = p->positions.at;
        primvars.Interpolate(l, from, to);
        if (l < p->levels) std::swap(above.at, p->positions.at);
        from = above.at;
    }
}

static int make_result(peer *p)
{
    find_positions(p);
    const Far::TopologyLevel &last = p->refiner->GetLevel(p->levels);
    p->face_vertices.make((size_t)last.GetNumFaceVertices());
    int *to = p->face_vertices.at;
    for (int f = 0; f < last.GetNumFaces(); f++) {
        const Far::ConstIndexArray v = last.GetFaceVertices(f);
        for (int i = 0; i < v.size(); i++) *to++ = v[i];
    }
    return last.GetNumVertices();
}

static void discard(peer *p)
{
    p->refiner.reset();
    p->table.reset();
    p->points.clear();
    p->positions.free();
    p->face_vertices.free();
    p->out.free();
    for (Array<Point> &limit : p->limits) limit.free();
}

static void make_tables(peer *p)
{
    Far::StencilTableFactory::Options options;
    options.generateIntermediateLevels = false;
    p->table.reset(Far::StencilTableFactory::Create(*p->refiner, options));
    make_points(p);
    p->out.make(4 * (size_t)p->refiner->GetLevel(p->levels).GetNumVertices());
}

static const float *chained(peer *p, const float *in)
{
    const Far::PrimvarRefiner primvars(*p->refiner);
    const Point *from = reinterpret_cast<const Point *>(in);
    for (int l = 1; l <= p->levels; l++) {
        Point *to = p->points[(size_t)l].at;
        primvars.Interpolate(l, from, to);
        from = to;
    }
    return from->value;
}

// Osd::CpuEvaluator does the same, slower: its library is compiled for any number of channels.
static const float *stencils(peer *p, int channels, const float *in)
{
    if (channels == 3)
        p->table->UpdateValues(reinterpret_cast<const Values<3> *>(in),
                               reinterpret_cast<Values<3> *>(p->out.at));
    else
        p->table->UpdateValues(reinterpret_cast<const Values<4> *>(in),
                               reinterpret_cast<Values<4> *>(p->out.at));
    return p->out.at;
}

static void normals(peer *p)
{
    const Far::PrimvarRefiner primvars(*p->refiner);
    Point *position = p->limits[0].at, *u = p->limits[1].at, *v = p->limits[2].at;
    primvars.Limit(p->points[(size_t)p->levels].at, position, u, v);
    const int count = p->refiner->GetLevel(p->levels).GetNumVertices();
    for (int i = 0; i < count; i++) {
        const float *a = u[i].value, *b = v[i].value;
        const Point n = { { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                            a[0] * b[1] - a[1] * b[0] } };
        const float square = n.value[0] * n.value[0] + n.value[1] * n.value[1]
                           + n.value[2] * n.value[2];
        const float scale = square > 0 ? 1 / std::sqrt(square) : 0;
        for (int k = 0; k < 3; k++) u[i].value[k] = scale * n.value[k];
    }
}

#define TEXT(x) #x
#define VERSION(a, b, c) TEXT(a) "." TEXT(b) "." TEXT(c)

const peer_library opensubdiv = {
    "OpenSubdiv " VERSION(OPENSUBDIV_VERSION_MAJOR, OPENSUBDIV_VERSION_MINOR,
                          OPENSUBDIV_VERSION_PATCH),
    open_peer, close_peer, prepare, make_result, discard, make_tables, chained, stencils,
    normals
};
