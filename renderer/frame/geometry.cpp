#include "renderer/frame/geometry.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <span>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/core/parallel.h"
#include "renderer/core/warn_once.h"
#include "renderer/frame/skin_layout.h"
#include "renderer/scene/pose.h"

namespace cutis {
namespace {

// Appends where the atlas has the vertices of a primitive of skin; parts are numbered on over all primitives.
void appendLayout(Geometry& geometry, const Primitive& primitive, const SkinLayout& layout) {
    if (layout.empty()) {
        geometry.layoutUv.insert(geometry.layoutUv.end(), primitive.uv0.begin(), primitive.uv0.end());
        geometry.layoutParts.resize(geometry.layoutUv.size(), 0);
        return;
    }
    std::uint32_t before = 0;
    for (const std::uint32_t part : geometry.layoutParts) before = std::max(before, part);
    geometry.layoutUv.insert(geometry.layoutUv.end(), layout.uv.begin(), layout.uv.end());
    for (const std::uint32_t part : layout.parts) geometry.layoutParts.push_back(before + 1 + part);
}

// Appends a primitive to the streams: what no pose changes, and room for the rest.
void appendPrimitive(Geometry& geometry, const Primitive& primitive, const SkinLayout& layout, std::uint32_t draw) {
    const auto base = static_cast<std::uint32_t>(geometry.positions.size());
    const std::vector<std::uint32_t>& copies = geometry.draws[draw].copies = layout.copies;
    const std::size_t own = primitive.positions.size();
    geometry.positions.resize(base + own + copies.size());
    for (std::size_t k = 0; k < own + copies.size(); ++k) {
        const std::size_t i = k < own ? k : copies[k - own];
        shared::VertexAttributes a{};
        a.uv0 = primitive.uv0.empty() ? glm::vec2(0) : primitive.uv0[i];
        a.uv1 = primitive.uv1.empty() ? glm::vec2(0) : primitive.uv1[i];
        a.color = primitive.colors.empty() ? glm::vec4(1) : primitive.colors[i];
        geometry.attributes.push_back(a);
    }
    const std::vector<std::uint32_t>& indices = layout.empty() ? primitive.indices : layout.indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::uint32_t* t = &indices[i];
        geometry.indices.insert(geometry.indices.end(), {base + t[0], base + t[1], base + t[2]});
        geometry.triangleDraws.push_back(draw);
    }
}

// Puts one draw where `world` takes it. A transform that mirrors turns the triangles over, so that their front stays
// their front.
void placeDraw(Geometry& geometry, GeometryDraw& draw, const Primitive& primitive, const glm::dmat4& world) {
    const glm::dmat3 linear(world);
    const double determinant = glm::determinant(linear);
    // The cofactor matrix carries normals even where the transform flattens an axis and has no inverse.
    const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                              glm::cross(linear[0], linear[1]));
    const double side = determinant < 0 ? -1 : 1;
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        const glm::dvec3 p = glm::dvec3(world * glm::dvec4(primitive.positions[i], 1)) - geometry.origin;
        geometry.positions[draw.firstVertex + i] = glm::vec3(p);
        shared::VertexAttributes& a = geometry.attributes[draw.firstVertex + i];
        const glm::dvec3 n = cofactor * glm::dvec3(primitive.normals[i]) * side;
        const double length = glm::length(n);
        a.normal = length > 0 ? glm::vec3(n / length) : glm::vec3(primitive.normals[i]);
        if (primitive.tangents.empty()) continue;
        const glm::dvec3 t = linear * glm::dvec3(primitive.tangents[i]);
        const double tangentLength = glm::length(t);
        a.tangent = tangentLength > 0 ? glm::vec4(glm::vec3(t / tangentLength),
                                                  primitive.tangents[i].w * static_cast<float>(side))
                                      : glm::vec4(0);
    }
    const std::size_t own = draw.firstVertex + primitive.positions.size();
    for (std::size_t k = 0; k < draw.copies.size(); ++k) {
        geometry.positions[own + k] = geometry.positions[draw.firstVertex + draw.copies[k]];
        geometry.attributes[own + k].normal = geometry.attributes[draw.firstVertex + draw.copies[k]].normal;
        geometry.attributes[own + k].tangent = geometry.attributes[draw.firstVertex + draw.copies[k]].tangent;
    }
    if (draw.mirrored == (determinant < 0)) return;
    draw.mirrored = determinant < 0;
    for (std::uint32_t i = draw.firstIndex; i < draw.firstIndex + draw.indexCount; i += 3) {
        std::swap(geometry.indices[i + 1], geometry.indices[i + 2]);
    }
}

Bounds worldBounds(const std::vector<glm::vec3>& positions, const glm::dmat4& world) {
    Bounds bounds;
    for (const glm::vec3& p : positions) bounds.extend(glm::dvec3(world * glm::dvec4(p, 1)));
    return bounds;
}

// Positions of the primitive as the scene rests.
const std::vector<glm::vec3>& restOf(const Primitive& primitive) {
    return primitive.restPositions.empty() ? primitive.positions : primitive.restPositions;
}

// Grown outwards to a grid of an eighth of the scene's size at rest.
Bounds inSteps(const Bounds& bounds, const glm::dvec3& origin, const Bounds& rest) {
    const double step = 0.125 * glm::length(rest.size());
    if (bounds.empty() || !(step > 0)) return bounds;
    return {origin + glm::floor((bounds.min - origin) / step) * step,
            origin + glm::ceil((bounds.max - origin) / step) * step};
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
            draws.push_back(draw);
        }
    }
    std::stable_partition(draws.begin(), draws.end(), [](const GeometryDraw& d) { return d.skin; });
    return draws;
}

// One a draw; those of what is not skin are empty.
std::vector<SkinLayout> layOutDraws(const Scene& scene, const std::vector<GeometryDraw>& draws) {
    std::vector<SkinLayout> layouts(draws.size());
    parallelFor(draws.size(), [&](std::size_t k) {
        if (draws[k].skin) layouts[k] = layOutSkin(scene.meshes[draws[k].mesh].primitives[draws[k].primitive]);
    });
    return layouts;
}

// mm², a character, at rest.
std::vector<double> skinAreas(const Scene& scene, const Geometry& geometry) {
    const std::vector<glm::vec3>& positions = geometry.restPositions.empty() ? geometry.positions : geometry.restPositions;
    std::vector<double> areas(scene.characters.size(), 0);
    for (std::size_t t = 0; t < geometry.skinTriangleCount; ++t) {
        const GeometryDraw& draw = geometry.draws[geometry.triangleDraws[t]];
        const double mmPerUnit = scene.materials[draw.material].skin->mmPerUnit;
        const std::uint32_t* v = &geometry.indices[t * 3];
        const glm::dvec3 p = positions[v[0]];
        const glm::dvec3 p1 = (glm::dvec3(positions[v[1]]) - p) * mmPerUnit;
        const glm::dvec3 p2 = (glm::dvec3(positions[v[2]]) - p) * mmPerUnit;
        areas[draw.character] += 0.5 * glm::length(glm::cross(p1, p2));
    }
    return areas;
}

}  // namespace

void followPose(const Scene& scene, Geometry& geometry) {
    const bool moves = !geometry.restPositions.empty();
    parallelFor(geometry.draws.size(), [&](std::size_t k) {
        GeometryDraw& draw = geometry.draws[k];
        const Primitive& primitive = scene.meshes[draw.mesh].primitives[draw.primitive];
        const glm::dmat4& world = scene.nodes[draw.node].world;
        placeDraw(geometry, draw, primitive, world);
        draw.bounds = worldBounds(primitive.positions, world);
        if (!moves) return;
        const auto bytesOf = [&](const auto& stream) {
            return std::as_bytes(std::span(stream).subspan(draw.firstVertex, draw.vertexCount));
        };
        draw.pose = hashBytes(bytesOf(geometry.attributes), hashBytes(bytesOf(geometry.positions)));
    });
    geometry.bounds = {};
    for (ReceiverGroup& group : geometry.receiverGroups) group.bounds = {};
    for (std::size_t k = 0; k < geometry.draws.size(); ++k) {
        geometry.bounds.extend(geometry.draws[k].bounds);
        geometry.receiverGroups[geometry.drawInfos[k].receiverGroup].bounds.extend(geometry.draws[k].bounds);
    }
    Bounds rest;
    for (const ReceiverGroup& group : geometry.receiverGroups) rest.extend(group.restBounds);
    geometry.casters = moves ? inSteps(geometry.bounds, geometry.origin, rest) : geometry.bounds;
}

Geometry flattenScene(const Scene& scene) {
    Geometry geometry;
    geometry.draws = collectDraws(scene);
    const std::vector<glm::dmat4> restWorlds = restWorldTransforms(scene);
    Bounds rest;
    std::uint64_t vertices = 0, indices = 0;
    for (GeometryDraw& draw : geometry.draws) {
        const Primitive& primitive = scene.meshes[draw.mesh].primitives[draw.primitive];
        vertices += primitive.positions.size();
        indices += primitive.indices.size();
        draw.bounds = worldBounds(restOf(primitive), restWorlds[draw.node]);
        rest.extend(draw.bounds);
    }
    const std::vector<SkinLayout> layouts = layOutDraws(scene, geometry.draws);
    for (std::size_t k = 0; k < layouts.size(); ++k) {
        vertices += layouts[k].copies.size();
        if (layouts[k].remark.empty()) continue;
        warnOnce("mesh \"" + scene.meshes[geometry.draws[k].mesh].name + "\" " + layouts[k].remark);
    }
    if (vertices > 0xfffffff0u || indices > 0xfffffff0u) {
        throw Error("scene too large", std::to_string(vertices) + " vertices and " + std::to_string(indices / 3) +
                    " triangles do not fit 32-bit indices", scene.file.string());
    }
    geometry.origin = rest.empty() ? glm::dvec3(0) : rest.centre();
    geometry.positions.reserve(vertices);
    geometry.attributes.reserve(vertices);
    geometry.indices.reserve(indices);
    geometry.triangleDraws.reserve(indices / 3);

    // Groups: every character, then the rest when there is any.
    geometry.receiverGroups.resize(scene.characters.size());
    bool others = false;
    for (const GeometryDraw& draw : geometry.draws) others |= draw.character < 0;
    if (others) geometry.receiverGroups.emplace_back();

    for (std::size_t k = 0; k < geometry.draws.size(); ++k) {
        GeometryDraw& draw = geometry.draws[k];
        const Primitive& primitive = scene.meshes[draw.mesh].primitives[draw.primitive];
        draw.firstVertex = static_cast<std::uint32_t>(geometry.positions.size());
        draw.vertexCount = static_cast<std::uint32_t>(primitive.positions.size() + layouts[k].copies.size());
        draw.firstIndex = static_cast<std::uint32_t>(geometry.indices.size());
        appendPrimitive(geometry, primitive, layouts[k], static_cast<std::uint32_t>(k));
        if (draw.skin) appendLayout(geometry, primitive, layouts[k]);
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
        geometry.receiverGroups[info.receiverGroup].restBounds.extend(draw.bounds);
        geometry.drawInfos.push_back(info);
        if (scene.animations.empty()) continue;
        const std::vector<glm::vec3>& positions = restOf(primitive);
        for (std::size_t i = 0; i < draw.vertexCount; ++i) {
            const glm::vec3 p = positions[i < positions.size() ? i : draw.copies[i - positions.size()]];
            geometry.restPositions.emplace_back(glm::dvec3(restWorlds[draw.node] * glm::dvec4(p, 1)) - geometry.origin);
        }
    }
    followPose(scene, geometry);
    geometry.skinMm2 = skinAreas(scene, geometry);
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
