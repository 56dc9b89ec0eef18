#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <memory>

#include "mesh.h"

namespace cutis::people {
namespace {

namespace Far = OpenSubdiv::Far;

// What OpenSubdiv interpolates: anything with Clear and AddWithWeight.
template <class Vector>
struct Element {
    Vector value{0};
    void Clear(void* = nullptr) { value = Vector(0); }
    void AddWithWeight(const Element& source, double weight) { value += weight * source.value; }
};

template <class Vector>
std::vector<Element<Vector>> wrap(const std::vector<Vector>& values) {
    std::vector<Element<Vector>> out(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) out[i].value = values[i];
    return out;
}

template <class Vector>
std::vector<Vector> unwrap(const std::vector<Element<Vector>>& values) {
    std::vector<Vector> out(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) out[i] = values[i].value;
    return out;
}

std::unique_ptr<Far::TopologyRefiner> makeRefiner(const QuadMesh& mesh, int levels) {
    std::vector<int> counts(mesh.faces.size(), 4), vertices, uvs;
    for (const QuadMesh::Face& face : mesh.faces) {
        vertices.insert(vertices.end(), face.vertex.begin(), face.vertex.end());
        uvs.insert(uvs.end(), face.uv.begin(), face.uv.end());
    }
    Far::TopologyDescriptor::FVarChannel channel;
    channel.numValues = int(mesh.uvs.size());
    channel.valueIndices = uvs.data();
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = int(mesh.positions.size());
    descriptor.numFaces = int(mesh.faces.size());
    descriptor.numVertsPerFace = counts.data();
    descriptor.vertIndicesPerFace = vertices.data();
    descriptor.numFVarChannels = 1;
    descriptor.fvarChannels = &channel;

    using OpenSubdiv::Sdc::Options;
    Options options;
    options.SetVtxBoundaryInterpolation(Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    options.SetFVarLinearInterpolation(Options::FVAR_LINEAR_CORNERS_PLUS1);
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    std::unique_ptr<Far::TopologyRefiner> refiner(
        Factory::Create(descriptor, Factory::Options(OpenSubdiv::Sdc::SCHEME_CATMARK, options)));
    Far::TopologyRefiner::UniformOptions uniform(levels);
    uniform.fullTopologyInLastLevel = true;  // limit stencils need it
    refiner->RefineUniform(uniform);
    return refiner;
}

}  // namespace

QuadMesh subdivide(const QuadMesh& mesh, int levels) {
    const auto refiner = makeRefiner(mesh, levels);
    const Far::PrimvarRefiner primvars(*refiner);
    auto positions = wrap(mesh.positions);
    auto uvs = wrap(mesh.uvs);
    for (int level = 1; level <= levels; ++level) {
        const Far::TopologyLevel& topology = refiner->GetLevel(level);
        std::vector<Element<glm::dvec3>> finer(topology.GetNumVertices());
        std::vector<Element<glm::dvec2>> finerUvs(topology.GetNumFVarValues(0));
        primvars.Interpolate(level, positions, finer);
        primvars.InterpolateFaceVarying(level, uvs, finerUvs, 0);
        positions = std::move(finer);
        uvs = std::move(finerUvs);
    }
    std::vector<Element<glm::dvec3>> limit(positions.size()), du(positions.size()), dv(positions.size());
    primvars.Limit(positions, limit, du, dv);

    QuadMesh out;
    out.positions = unwrap(limit);
    out.uvs = unwrap(uvs);
    const Far::TopologyLevel& topology = refiner->GetLevel(levels);
    for (int f = 0; f < topology.GetNumFaces(); ++f) {
        const auto v = topology.GetFaceVertices(f);
        const auto t = topology.GetFaceFVarValues(f, 0);
        out.faces.push_back({{v[0], v[1], v[2], v[3]}, {t[0], t[1], t[2], t[3]}});
    }
    out.normals = computeNormals(out);
    for (std::size_t i = 0; i < out.normals.size(); ++i) {
        const glm::dvec3 n = glm::cross(du[i].value, dv[i].value);
        if (glm::length(n) > 1e-12 * glm::length(du[i].value) * glm::length(dv[i].value) &&
            glm::dot(n, n) > 0)
            out.normals[i] = glm::normalize(n);
    }
    return out;
}

}  // namespace cutis::people
