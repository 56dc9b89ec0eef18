#include "renderer/reference/mesh.h"

#include <algorithm>
#include <glm/gtc/matrix_inverse.hpp>

#include "renderer/reference/directions.h"
#include "renderer/reference/textures.h"
#include "renderer/scene/pose.h"

namespace cutis::reference {
namespace {

template <class T>
glm::vec<T::length(), double> interpolated(const std::vector<T>& values,
                                           const std::array<std::uint32_t, 3>& t, double u, double v) {
    using D = glm::vec<T::length(), double>;
    return D(values[t[0]]) * (1 - u - v) + D(values[t[1]]) * u + D(values[t[2]]) * v;
}

// A transform that mirrors turns the triangles over, so that their front stays their front.
PlacedMesh place(const Scene& scene, const Primitive& primitive, const glm::dmat4& world,
                 const glm::dvec3& origin) {
    PlacedMesh mesh;
    mesh.scene = &scene;
    mesh.primitive = &primitive;
    mesh.material = &scene.materials[primitive.material];
    const glm::dmat3 linear(world);
    const bool mirrored = glm::determinant(linear) < 0;
    const double side = mirrored ? -1 : 1;
    // The cofactor matrix carries normals even where the transform flattens an axis and has no inverse.
    const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                              glm::cross(linear[0], linear[1]));
    mesh.positions.reserve(primitive.positions.size());
    mesh.normals.reserve(primitive.positions.size());
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        const glm::vec3 p(glm::dvec3(world * glm::dvec4(primitive.positions[i], 1)) - origin);
        mesh.positions.push_back({p.x, p.y, p.z, 0.f});
        mesh.normals.push_back(
            safeNormalize(cofactor * glm::dvec3(primitive.normals[i]) * side, primitive.normals[i]));
        if (primitive.tangents.empty()) continue;
        const glm::dvec4 tangent = primitive.tangents[i];
        mesh.tangents.emplace_back(safeNormalize(linear * glm::dvec3(tangent), glm::dvec3(0)),
                                   tangent.w * side);
    }
    mesh.indices = primitive.indices;
    if (mirrored) {
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    }
    return mesh;
}

}  // namespace

glm::dvec2 PlacedMesh::uvAt(int texCoord, std::uint32_t t, double u, double v) const {
    const std::vector<glm::vec2>& uv = texCoord == 1 ? primitive->uv1 : primitive->uv0;
    return uv.empty() ? glm::dvec2(0) : interpolated(uv, triangle(t), u, v);
}

glm::dvec4 PlacedMesh::colorAt(std::uint32_t t, double u, double v) const {
    return primitive->colors.empty() ? glm::dvec4(1) : interpolated(primitive->colors, triangle(t), u, v);
}

double PlacedMesh::alphaAt(std::uint32_t t, double u, double v) const {
    if (material->alphaMode == AlphaMode::opaque) return 1;
    double alpha = material->baseColor.a * colorAt(t, u, v).a;
    if (const TextureSlot& slot = material->baseColorTexture)
        alpha *= sampleAlpha(*scene, slot, uvAt(slot.texCoord, t, u, v));
    if (material->alphaMode == AlphaMode::mask) return alpha < material->alphaCutoff ? 0 : 1;
    return std::clamp(alpha, 0.0, 1.0);
}

PlacedScene placeScene(const Scene& scene) {
    PlacedScene placed;
    if (!scene.bounds.empty()) {
        placed.origin = scene.bounds.centre();
        placed.radius = 0.5 * glm::length(scene.bounds.size());
    }
    const std::vector<glm::dmat4> restWorlds = restWorldTransforms(scene);
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].mesh < 0) continue;
        for (const Primitive& primitive : scene.meshes[scene.nodes[node].mesh].primitives) {
            if (primitive.indices.empty()) continue;
            PlacedMesh mesh = place(scene, primitive, scene.nodes[node].world, placed.origin);
            mesh.character = scene.nodeCharacter.empty() ? -1 : scene.nodeCharacter[node];
            mesh.skin = mesh.material->skin.has_value() && mesh.character >= 0;
            if (mesh.skin && mesh.material->skin->detail > 0) {
                for (const glm::vec3& p :
                     primitive.restPositions.empty() ? primitive.positions : primitive.restPositions)
                    mesh.restPositions.emplace_back(restWorlds[node] * glm::dvec4(p, 1));
            }
            placed.meshes.push_back(std::move(mesh));
        }
    }
    return placed;
}

}  // namespace cutis::reference
