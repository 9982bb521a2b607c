// OpenSubdiv for bench.c: each task in the way that was found fastest on one thread.

#include <cmath>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/bfr/tessellation.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>
#include <opensubdiv/version.h>

#include "bench.h"

namespace Bfr = OpenSubdiv::Bfr;
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
typedef Bfr::Surface<float> Surface;

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
    std::vector<Surface> surfaces;         // by face
    std::vector<size_t> first_patch_point; // by face
    std::vector<float> patch_points;       // x y z
    std::vector<int> sample_faces;
    std::vector<float> sample_uvs;         // u v
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

static int make_refiner(peer *p)
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
    return p->refiner != nullptr;
}

static int prepare(peer *p, int limit)
{
    if (!make_refiner(p)) return 0;
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
    p->surfaces.clear();
    p->first_patch_point.clear();
    p->patch_points.clear();
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

// ------------------------------------------------------------------------------ the surface itself

static int make_surfaces(peer *p)
{
    if (!make_refiner(p)) return 0;
    const Bfr::RefinerSurfaceFactory<> factory(*p->refiner);
    const int face_count = p->cage->face_count;
    const Surface::PointDescriptor dense(3);
    p->surfaces.resize((size_t)face_count);
    size_t size = 0;
    for (int f = 0; f < face_count; f++) {
        Surface &surface = p->surfaces[(size_t)f];
        p->first_patch_point.push_back(size);
        if (factory.InitVertexSurface(f, &surface)) size += 3 * (size_t)surface.GetNumPatchPoints();
    }
    p->patch_points.resize(size);
    for (int f = 0; f < face_count; f++) {
        const Surface &surface = p->surfaces[(size_t)f];
        float *points = p->patch_points.data() + p->first_patch_point[(size_t)f];
        if (surface.IsValid()) surface.PreparePatchPoints(p->cage->positions, dense, points, dense);
    }
    return 1;
}

// Sub-faces lie apart in the parameters that Bfr has for faces of other than 4 vertices.
static void locate(peer *p, int count, const subdiv_location *at)
{
    p->sample_faces.resize((size_t)count);
    p->sample_uvs.resize(2 * (size_t)count);
    for (int i = 0; i < count; i++) {
        const Surface &surface = p->surfaces[(size_t)at[i].face];
        const float uv[2] = { at[i].u, at[i].v };
        float *to = &p->sample_uvs[2 * (size_t)i];
        to[0] = uv[0];
        to[1] = uv[1];
        p->sample_faces[(size_t)i] = at[i].face;
        if (surface.IsValid() && surface.GetParameterization().HasSubFaces())
            surface.GetParameterization().ConvertNormalizedSubFaceToCoord(at[i].corner, uv, to);
    }
}

static void sample(peer *p, float *points, float *du, float *dv)
{
    const Surface::PointDescriptor dense(3);
    for (size_t i = 0; i < p->sample_faces.size(); i++) {
        const size_t f = (size_t)p->sample_faces[i];
        const Surface &surface = p->surfaces[f];
        const float *uv = &p->sample_uvs[2 * i], *from = &p->patch_points[p->first_patch_point[f]];
        if (!surface.IsValid()) continue;
        if (du) surface.Evaluate(uv, from, dense, points + 3 * i, du + 3 * i, dv + 3 * i);
        else surface.Evaluate(uv, from, dense, points + 3 * i);
    }
}

// The parameters of a face's points depend on its size alone, so they are made once for each.
static void tessellate(peer *p, int rate, float *points, float *du, float *dv)
{
    if (!make_refiner(p)) return;
    const Bfr::RefinerSurfaceFactory<> factory(*p->refiner);
    const Surface::PointDescriptor dense(3);
    std::vector<std::vector<float>> uvs;
    std::vector<float> patch;
    Surface surface;
    for (int f = 0; f < p->cage->face_count; f++) {
        const size_t size = (size_t)p->sizes[(size_t)f];
        if (!factory.InitVertexSurface(f, &surface)) continue;
        if (uvs.size() <= size) uvs.resize(size + 1);
        if (uvs[size].empty()) {
            const Bfr::Tessellation pattern(surface.GetParameterization(), rate);
            uvs[size].resize(2 * (size_t)pattern.GetNumCoords());
            pattern.GetCoords(uvs[size].data());
        }
        patch.resize(3 * (size_t)surface.GetNumPatchPoints());
        surface.PreparePatchPoints(p->cage->positions, dense, patch.data(), dense);
        for (size_t i = 0; i < uvs[size].size(); i += 2, points += 3) {
            const float *uv = &uvs[size][i];
            if (du) surface.Evaluate(uv, patch.data(), dense, points, du, dv);
            else surface.Evaluate(uv, patch.data(), dense, points);
            du += du ? 3 : 0;
            dv += dv ? 3 : 0;
        }
    }
}

#define TEXT(x) #x
#define VERSION(a, b, c) TEXT(a) "." TEXT(b) "." TEXT(c)

const peer_library opensubdiv = {
    "OpenSubdiv " VERSION(OPENSUBDIV_VERSION_MAJOR, OPENSUBDIV_VERSION_MINOR,
                          OPENSUBDIV_VERSION_PATCH),
    open_peer, close_peer, prepare, make_result, discard, make_tables, chained, stencils,
    normals, make_surfaces, locate, sample, tessellate
};
