#include "renderer/frame/geometry.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"

namespace cutis {
namespace {

// Copies one primitive into the streams, in world space. A transform that mirrors turns the triangles over, so that
// their front stays their front.
void appendPrimitive(Geometry& geometry, const Primitive& primitive, const glm::dmat4& world, std::uint32_t draw) {
    const auto base = static_cast<std::uint32_t>(geometry.positions.size());
    const glm::dmat3 linear(world);
    const double determinant = glm::determinant(linear);
    // The cofactor matrix carries normals even where the transform flattens an axis and has no inverse.
    const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                              glm::cross(linear[0], linear[1]));
    const double side = determinant < 0 ? -1 : 1;
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        const glm::dvec3 p = glm::dvec3(world * glm::dvec4(primitive.positions[i], 1)) - geometry.origin;
        geometry.positions.emplace_back(p);
        shared::VertexAttributes a{};
        const glm::dvec3 n = cofactor * glm::dvec3(primitive.normals[i]) * side;
        const double length = glm::length(n);
        a.normal = length > 0 ? glm::vec3(n / length) : glm::vec3(primitive.normals[i]);
        if (!primitive.tangents.empty()) {
            const glm::dvec3 t = linear * glm::dvec3(primitive.tangents[i]);
            const double tangentLength = glm::length(t);
            a.tangent = tangentLength > 0 ? glm::vec4(glm::vec3(t / tangentLength),
                                                      primitive.tangents[i].w * static_cast<float>(side))
                                          : glm::vec4(0);
        }
        a.uv0 = primitive.uv0.empty() ? glm::vec2(0) : primitive.uv0[i];
        a.uv1 = primitive.uv1.empty() ? glm::vec2(0) : primitive.uv1[i];
        a.color = primitive.colors.empty() ? glm::vec4(1) : primitive.colors[i];
        geometry.attributes.push_back(a);
    }
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const std::uint32_t* t = &primitive.indices[i];
        geometry.indices.push_back(base + t[0]);
        geometry.indices.push_back(base + (determinant < 0 ? t[2] : t[1]));
        geometry.indices.push_back(base + (determinant < 0 ? t[1] : t[2]));
        geometry.triangleDraws.push_back(draw);
    }
}

Bounds worldBounds(const Primitive& primitive, const glm::dmat4& world) {
    Bounds bounds;
    for (const glm::vec3& p : primitive.positions) bounds.extend(glm::dvec3(world * glm::dvec4(p, 1)));
    return bounds;
}

std::vector<GeometryDraw> collectDraws(const Scene& scene) {
    std::vector<GeometryDraw> draws;
    for (int node = 0; node < static_cast<int>(scene.nodes.size()); ++node) {
        const int mesh = scene.nodes[node].mesh;
        if (mesh < 0) continue;
        for (int i = 0; i < static_cast<int>(scene.meshes[mesh].primitives.size()); ++i) {
            const Primitive& primitive = scene.meshes[mesh].primitives[i];
            if (primitive.indices.empty()) continue;
            GeometryDraw draw;
            draw.node = node;
            draw.mesh = mesh;
            draw.primitive = i;
            draw.material = primitive.material;
            draw.character = scene.nodeCharacter.empty() ? -1 : scene.nodeCharacter[node];
            draw.skin = scene.materials[primitive.material].skin.has_value() && draw.character >= 0;
            draw.bounds = worldBounds(primitive, scene.nodes[node].world);
            draws.push_back(draw);
        }
    }
    std::stable_partition(draws.begin(), draws.end(), [](const GeometryDraw& d) { return d.skin; });
    return draws;
}

}  // namespace

Geometry flattenScene(const Scene& scene) {
    Geometry geometry;
    geometry.draws = collectDraws(scene);
    std::uint64_t vertices = 0, indices = 0;
    for (const GeometryDraw& draw : geometry.draws) {
        const Primitive& primitive = scene.meshes[draw.mesh].primitives[draw.primitive];
        vertices += primitive.positions.size();
        indices += primitive.indices.size();
        geometry.bounds.extend(draw.bounds);
        if (draw.skin && primitive.uv0.empty()) {
            throw Error("cannot render skin", "it has no texture coordinates (TEXCOORD_0)",
                        "mesh \"" + scene.meshes[draw.mesh].name + "\"");
        }
    }
    if (vertices > 0xfffffff0u || indices > 0xfffffff0u) {
        throw Error("scene too large", std::to_string(vertices) + " vertices and " + std::to_string(indices / 3) +
                    " triangles do not fit 32-bit indices", scene.file.string());
    }
    geometry.origin = geometry.bounds.empty() ? glm::dvec3(0) : geometry.bounds.centre();
    geometry.positions.reserve(vertices);
    geometry.attributes.reserve(vertices);
    geometry.indices.reserve(indices);
    geometry.triangleDraws.reserve(indices / 3);

    // Groups: every character, then the rest when there is any.
    geometry.receiverGroups.resize(scene.characters.size());
    bool rest = false;
    for (const GeometryDraw& draw : geometry.draws) rest |= draw.character < 0;
    if (rest) geometry.receiverGroups.emplace_back();

    for (std::size_t k = 0; k < geometry.draws.size(); ++k) {
        GeometryDraw& draw = geometry.draws[k];
        const Primitive& primitive = scene.meshes[draw.mesh].primitives[draw.primitive];
        draw.firstVertex = static_cast<std::uint32_t>(geometry.positions.size());
        draw.vertexCount = static_cast<std::uint32_t>(primitive.positions.size());
        draw.firstIndex = static_cast<std::uint32_t>(geometry.indices.size());
        appendPrimitive(geometry, primitive, scene.nodes[draw.node].world, static_cast<std::uint32_t>(k));
        draw.indexCount = static_cast<std::uint32_t>(geometry.indices.size()) - draw.firstIndex;
        shared::DrawInfo info{};
        info.material = static_cast<std::uint32_t>(draw.material);
        info.character = static_cast<std::uint32_t>(draw.character + 1);
        info.receiverGroup = draw.character >= 0 ? static_cast<std::uint32_t>(draw.character)
                                                 : static_cast<std::uint32_t>(scene.characters.size());
        info.chart = shared::NO_CHART;
        info.firstVertex = draw.firstVertex;
        if (draw.skin) {
            geometry.skinVertexCount = draw.firstVertex + draw.vertexCount;
            geometry.skinTriangleCount = (draw.firstIndex + draw.indexCount) / 3;
        } else {
            info.firstProbe = geometry.probeCount;
            geometry.probeCount += draw.vertexCount;
        }
        geometry.receiverGroups[info.receiverGroup].bounds.extend(draw.bounds);
        geometry.drawInfos.push_back(info);
    }
    return geometry;
}

std::vector<std::uint32_t> makeOcclusionProxies(Geometry& geometry, double error) {
    std::vector<std::vector<unsigned>> proxies(geometry.draws.size());
    parallelFor(geometry.draws.size(), [&](std::size_t d) {
        const GeometryDraw& draw = geometry.draws[d];
        std::vector<unsigned> local(draw.indexCount);
        for (std::uint32_t i = 0; i < draw.indexCount; ++i) {
            local[i] = geometry.indices[draw.firstIndex + i] - draw.firstVertex;
        }
        const float* positions = &geometry.positions[draw.firstVertex].x;
        const float scale = meshopt_simplifyScale(positions, draw.vertexCount, sizeof(glm::vec3));
        std::vector<unsigned>& proxy = proxies[d];
        proxy.resize(draw.indexCount);
        const float relative = scale > 0 ? static_cast<float>(error) / scale : 0.0f;
        float reached = 0;
        proxy.resize(meshopt_simplify(proxy.data(), local.data(), local.size(), positions, draw.vertexCount,
                                      sizeof(glm::vec3), 3, relative, 0, &reached));
    });
    std::vector<std::uint32_t> indices;
    for (std::size_t d = 0; d < geometry.draws.size(); ++d) {
        GeometryDraw& draw = geometry.draws[d];
        draw.firstProxyIndex = static_cast<std::uint32_t>(indices.size());
        draw.proxyIndexCount = static_cast<std::uint32_t>(proxies[d].size());
        for (unsigned index : proxies[d]) indices.push_back(index + draw.firstVertex);
    }
    return indices;
}

}  // namespace cutis
