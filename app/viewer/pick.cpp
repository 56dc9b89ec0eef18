#include "app/viewer/pick.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/core/parallel.h"

namespace cutis::app {
namespace {

struct TriangleHit {
    double distance = std::numeric_limits<double>::infinity();
    double u = 0, v = 0;  // weights of the second and third corner
    std::size_t index = 0;
};

// Möller & Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
void meetTriangle(const Primitive& primitive, std::size_t index, const glm::dvec3& origin,
                  const glm::dvec3& direction, TriangleHit& nearest) {
    const auto corner = [&](std::size_t k) {
        return glm::dvec3(primitive.positions[primitive.indices[index + k]]);
    };
    const glm::dvec3 a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
    const glm::dvec3 p = glm::cross(direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0) return;
    const glm::dvec3 s = origin - a;
    const double u = glm::dot(s, p) / determinant;
    if (u < 0 || u > 1) return;
    const glm::dvec3 q = glm::cross(s, ab);
    const double v = glm::dot(direction, q) / determinant;
    if (v < 0 || u + v > 1) return;
    const double distance = glm::dot(ac, q) / determinant;
    if (distance > 0 && distance < nearest.distance) nearest = {distance, u, v, index};
}

struct Part {
    int node;
    const Primitive* primitive;
};

Hit hitOn(const Scene& scene, const Part& part, const TriangleHit& triangle, const Ray& ray) {
    const Primitive& primitive = *part.primitive;
    const auto normal = [&](std::size_t k) {
        return glm::dvec3(primitive.normals[primitive.indices[triangle.index + k]]);
    };
    const glm::dmat3 world(scene.nodes[static_cast<std::size_t>(part.node)].world);
    Hit hit;
    hit.distance = triangle.distance;
    hit.position = ray.origin + triangle.distance * ray.direction;
    hit.normal = (1 - triangle.u - triangle.v) * normal(0) + triangle.u * normal(1) + triangle.v * normal(2);
    hit.normal = glm::normalize(glm::transpose(glm::inverse(world)) * hit.normal);
    if (glm::dot(hit.normal, ray.direction) > 0) hit.normal = -hit.normal;
    hit.node = part.node;
    hit.material = primitive.material;
    return hit;
}

}  // namespace

Ray rayThrough(const Camera& camera, double aspect, double x, double y) {
    const double right = (2 * x - 1) * aspect, up = 1 - 2 * y;
    const glm::dmat3 axes(camera.world);
    if (camera.orthographic) {
        const glm::dvec3 across = axes * glm::dvec3(right * camera.ymag, up * camera.ymag, 0);
        return {glm::dvec3(camera.world[3]) + across, glm::normalize(-axes[2])};
    }
    const double tangent = std::tan(camera.yfov / 2);
    return {glm::dvec3(camera.world[3]),
            glm::normalize(axes * glm::dvec3(right * tangent, up * tangent, -1))};
}

std::optional<Hit> pick(const Scene& scene, const Ray& ray) {
    std::vector<Part> parts;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].mesh < 0) continue;
        for (const Primitive& primitive :
             scene.meshes[static_cast<std::size_t>(scene.nodes[node].mesh)].primitives) {
            const Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
            if (material.alphaMode == AlphaMode::opaque && !material.seenThrough())
                parts.push_back({static_cast<int>(node), &primitive});
        }
    }
    std::vector<TriangleHit> hits(parts.size());
    parallelFor(parts.size(), [&](std::size_t i) {
        // In the node's space, where the direction keeps its scale: distances along it are those of the
        // world.
        const glm::dmat4 toNode = glm::inverse(scene.nodes[static_cast<std::size_t>(parts[i].node)].world);
        const glm::dvec3 origin(toNode * glm::dvec4(ray.origin, 1)),
            direction = glm::dmat3(toNode) * ray.direction;
        for (std::size_t t = 0; t + 2 < parts[i].primitive->indices.size(); t += 3)
            meetTriangle(*parts[i].primitive, t, origin, direction, hits[i]);
    });
    const auto nearest = std::min_element(
        hits.begin(), hits.end(), [](const auto& a, const auto& b) { return a.distance < b.distance; });
    if (nearest == hits.end() || !std::isfinite(nearest->distance)) return std::nullopt;
    return hitOn(scene, parts[static_cast<std::size_t>(nearest - hits.begin())], *nearest, ray);
}

}  // namespace cutis::app
