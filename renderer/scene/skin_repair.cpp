#include "renderer/scene/skin_repair.h"

#include <cmath>

#include "renderer/core/error.h"

namespace cutis {
namespace {

// Volume over area^(3/2): 0.094 for a sphere, 0.02 for a slab 20 times as wide as thick. Below this a mesh
// has no clear inside.
constexpr double kClearVolume = 0.005;
// Mean cosine between normals of vertices and of triangles: 0.99 on a head, 1/3 on a tetrahedron.
constexpr double kClearlyInwards = -0.25;

// Area of a mesh's holes over its own, up to which it has an inside: the neck of a bust is 0.07.
constexpr double kMostOpen = 0.2;

struct Enclosed {
    double volume = 0, area = 0;
    glm::dvec3 directed{0};  // sum of area times normal: that of the holes, turned about
    double agreement = 0;    // area-weighted mean of N · (normal of the triangle), times the area
};

glm::dvec3 centroidOf(const Mesh& mesh, const std::vector<bool>& counted) {
    glm::dvec3 sum(0);
    double count = 0;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        if (!counted[i]) continue;
        for (const glm::vec3& p : mesh.primitives[i].positions) sum += glm::dvec3(p);
        count += static_cast<double>(mesh.primitives[i].positions.size());
    }
    return count > 0 ? sum / count : sum;
}

Enclosed enclosedBy(const Mesh& mesh, const std::vector<bool>& counted) {
    const glm::dvec3 centre = centroidOf(mesh, counted);
    Enclosed sum;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        if (!counted[i]) continue;
        const Primitive& primitive = mesh.primitives[i];
        for (std::size_t t = 0; t + 2 < primitive.indices.size(); t += 3) {
            const std::uint32_t* v = &primitive.indices[t];
            const glm::dvec3 a = glm::dvec3(primitive.positions[v[0]]) - centre,
                             b = glm::dvec3(primitive.positions[v[1]]) - centre,
                             c = glm::dvec3(primitive.positions[v[2]]) - centre;
            const glm::dvec3 twice = glm::cross(b - a, c - a);  // normal times twice the area
            sum.volume += glm::dot(a, glm::cross(b, c)) / 6;
            sum.area += 0.5 * glm::length(twice);
            sum.directed += 0.5 * twice;
            for (int corner = 0; corner < 3; ++corner)
                sum.agreement += glm::dot(glm::dvec3(primitive.normals[v[corner]]), twice) / 6;
        }
    }
    return sum;
}

void turnTriangles(Primitive& primitive) {
    for (std::size_t t = 0; t + 2 < primitive.indices.size(); t += 3)
        std::swap(primitive.indices[t + 1], primitive.indices[t + 2]);
}

// The bitangent, cross(N, T) · w, stays.
void turnNormals(Primitive& primitive) {
    for (glm::vec3& normal : primitive.normals) normal = -normal;
    for (glm::vec4& tangent : primitive.tangents) tangent.w = -tangent.w;
}

}  // namespace

void turnSkinOutwards(Scene& scene) {
    for (Mesh& mesh : scene.meshes) {
        std::vector<bool> counted;
        for (const Primitive& primitive : mesh.primitives) {
            const Material& material = scene.materials[primitive.material];
            counted.push_back(material.skin && !material.doubleSided && !primitive.deformation);
        }
        const Enclosed enclosed = enclosedBy(mesh, counted);
        const double clear = kClearVolume * std::pow(enclosed.area, 1.5);
        if (!(std::abs(enclosed.volume) > clear) ||
            glm::length(enclosed.directed) > kMostOpen * enclosed.area)
            continue;
        const bool insideOut = enclosed.volume < 0;
        // After the triangles are turned, where they are.
        const bool normalsInwards =
            (insideOut ? -enclosed.agreement : enclosed.agreement) < kClearlyInwards * enclosed.area;
        if (!insideOut && !normalsInwards) continue;
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            if (!counted[i]) continue;
            if (insideOut) turnTriangles(mesh.primitives[i]);
            if (normalsInwards) turnNormals(mesh.primitives[i]);
        }
        warn(std::string(insideOut ? "skin that is inside out is turned over"
                                   : "normals that point into skin are turned") +
             ", mesh \"" + mesh.name + "\", " + scene.file.string());
    }
}

}  // namespace cutis
