#include "renderer/frame/stretch.h"

#include <cmath>
#include <unordered_map>

namespace cutis {
namespace {

// Vertices at one place of one island are one, however the file split them: the first of them, per vertex.
std::vector<std::uint32_t> weldByPlace(const std::vector<shared::AtlasVertex>& vertices) {
    struct Hash {
        std::size_t operator()(const glm::vec3& k) const {
            std::size_t h = 0;
            for (int c = 0; c < 3; ++c) h = h * 0x9e3779b97f4a7c15u + std::hash<float>{}(k[c]);
            return h ^ (h >> 29);
        }
    };
    std::unordered_map<glm::vec3, std::uint32_t, Hash> first;
    first.reserve(vertices.size());
    std::vector<std::uint32_t> weld;
    weld.reserve(vertices.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
        weld.push_back(first.try_emplace(glm::vec3(vertices[v].texel, vertices[v].island), v).first->second);
    }
    return weld;
}

// G of a triangle as (G00, G01, G11), and its area in texels; 0 where it has none.
glm::dvec4 metricOf(const Geometry& geometry, const Atlas& atlas, const std::uint32_t* v, double mmPerUnit) {
    const glm::dvec2 place = atlas.vertices[v[0]].texel;
    const glm::dvec2 e1 = glm::dvec2(atlas.vertices[v[1]].texel) - place;
    const glm::dvec2 e2 = glm::dvec2(atlas.vertices[v[2]].texel) - place;
    const double det = e1.x * e2.y - e1.y * e2.x;
    if (!(std::abs(det) > 1e-12)) return glm::dvec4(0);
    const glm::dvec3 p = geometry.positions[v[0]];
    const glm::dvec3 p1 = (glm::dvec3(geometry.positions[v[1]]) - p) * mmPerUnit;
    const glm::dvec3 p2 = (glm::dvec3(geometry.positions[v[2]]) - p) * mmPerUnit;
    const glm::dvec3 du = (p1 * e2.y - p2 * e1.y) / det, dv = (p2 * e1.x - p1 * e2.x) / det;
    return {glm::dot(du, du), glm::dot(du, dv), glm::dot(dv, dv), 0.5 * std::abs(det)};
}

}  // namespace

std::vector<shared::AtlasVertex> verticesInPose(const Scene& scene, const Geometry& geometry,
                                                const Atlas& atlas) {
    const std::vector<std::uint32_t> weld = weldByPlace(atlas.vertices);
    std::vector<glm::dvec4> sums(weld.size(), glm::dvec4(0));
    for (std::size_t t = 0; t < geometry.skinTriangleCount; ++t) {
        const std::uint32_t* v = &geometry.indices[t * 3];
        const int material = geometry.draws[geometry.triangleDraws[t]].material;
        const glm::dvec4 g = metricOf(geometry, atlas, v, scene.materials[material].skin->mmPerUnit);
        for (int i = 0; i < 3; ++i) sums[weld[v[i]]] += glm::dvec4(glm::dvec3(g) * g.w, g.w);
    }
    std::vector<shared::AtlasVertex> vertices = atlas.vertices;
    for (std::size_t v = 0; v < weld.size(); ++v) {
        const glm::dvec4 sum = sums[weld[v]];
        if (sum.w > 0) vertices[v].metric = glm::vec3(glm::dvec3(sum) / sum.w);
    }
    return vertices;
}

}  // namespace cutis
