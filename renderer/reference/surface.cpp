#include "renderer/reference/surface.h"

#include <algorithm>

#include "renderer/reference/directions.h"
#include "renderer/reference/textures.h"

namespace cutis::reference {
namespace {

// A tangent-space normal map's normal in world space (glTF: +X tangent, +Y bitangent, +Z normal).
glm::dvec3 turnedNormal(const glm::dvec3& n, const glm::dvec4& tangent, const glm::dvec3& texel,
                        double scale) {
    const glm::dvec3 local = texel * 2.0 - 1.0;
    glm::dvec3 t = glm::dvec3(tangent) - n * glm::dot(n, glm::dvec3(tangent));
    const double length = glm::length(t);
    if (!(length > 1e-6)) return n;
    t /= length;
    const glm::dvec3 b = glm::cross(n, t) * (tangent.w < 0 ? -1.0 : 1.0);
    return safeNormalize(t * (local.x * scale) + b * (local.y * scale) + n * local.z, n);
}

}  // namespace

glm::dvec4 textureAt(const Hit& hit, const TextureSlot& slot) {
    if (!slot) return glm::dvec4(1);
    return sampleTexture(*hit.mesh->scene, slot, hit.mesh->uvAt(slot.texCoord, hit.triangle, hit.u, hit.v));
}

SurfacePoint surfaceAt(const RayScene& rays, const Hit& hit, bool fromBack) {
    const PlacedMesh& mesh = *hit.mesh;
    const std::array<std::uint32_t, 3> vertex = mesh.triangle(hit.triangle);
    const double weight[3] = {1 - hit.u - hit.v, hit.u, hit.v};
    const double side = fromBack ? -1 : 1;
    glm::dvec3 corner[3], normal[3];
    SurfacePoint point;
    point.mesh = &mesh;
    point.material = mesh.material;
    for (int i = 0; i < 3; ++i) {
        corner[i] = mesh.position(vertex[i]);
        normal[i] = mesh.normals[vertex[i]] * side;
        point.position += weight[i] * corner[i];
        point.smooth += weight[i] * normal[i];
    }
    point.face = safeNormalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]) * side, normal[0]);
    point.smooth = safeNormalize(point.smooth, point.face);
    for (int i = 0; i < 3; ++i) {
        const double below = std::min(0.0, glm::dot(point.position - corner[i], normal[i]));
        point.outside += weight[i] * (point.position - below * normal[i]);
    }
    // Where the winding contradicts the normals, the normals know which side is out.
    const double out = glm::dot(point.face, point.smooth) < 0 ? -1 : 1;
    point.outside += point.face * (out * rays.clearance(point.position));

    point.normal = point.smooth;
    return point;
}

void readTextures(SurfacePoint& point, const Hit& hit, bool fromBack) {
    const PlacedMesh& mesh = *hit.mesh;
    point.base = glm::dvec4(mesh.material->baseColor) * mesh.colorAt(hit.triangle, hit.u, hit.v);
    if (mesh.material->baseColorTexture) point.base *= textureAt(hit, mesh.material->baseColorTexture);
    point.normal =
        mappedNormal(hit, mesh.material->normalTexture, mesh.material->normalScale, point.smooth, fromBack);
}

glm::dvec3 mappedNormal(const Hit& hit, const TextureSlot& slot, double scale, const glm::dvec3& smooth,
                        bool fromBack) {
    const PlacedMesh& mesh = *hit.mesh;
    if (!slot || mesh.tangents.empty()) return smooth;
    const std::array<std::uint32_t, 3> vertex = mesh.triangle(hit.triangle);
    const glm::dvec4 tangent = mesh.tangents[vertex[0]] * (1 - hit.u - hit.v) +
                               mesh.tangents[vertex[1]] * hit.u + mesh.tangents[vertex[2]] * hit.v;
    return turnedNormal(smooth, fromBack ? -tangent : tangent, glm::dvec3(textureAt(hit, slot)), scale);
}

}  // namespace cutis::reference
