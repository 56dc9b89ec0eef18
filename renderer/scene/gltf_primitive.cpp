#include <algorithm>
#include <cmath>
#include <numeric>

#include "renderer/core/error.h"
#include "renderer/scene/gltf_accessors.h"
#include "renderer/scene/gltf_parts.h"
#include "renderer/scene/mesh_repair.h"

namespace cutis::gltf {
namespace {

enum Mode : std::int64_t { kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6 };

std::vector<std::uint32_t> readVertexOrder(Document& document, const JsonView& primitive,
                                           std::size_t vertices) {
    const auto reference = primitive.find("indices");
    if (!reference) {
        if (vertices > 0xffffffffu) primitive.fail("it has more than 2^32 vertices");
        std::vector<std::uint32_t> order(vertices);
        std::iota(order.begin(), order.end(), 0u);
        return order;
    }
    std::vector<std::uint32_t> order = readIndices(document, *reference);
    for (const std::uint32_t i : order) {
        if (i >= vertices) {
            reference->fail("index " + std::to_string(i) + " of " + std::to_string(vertices) + " vertices");
        }
    }
    return order;
}

// Triangles of a list, strip or fan in the winding that glTF 2.0, §3.7.2.1 gives them.
std::vector<std::uint32_t> toTriangles(Document& document, const JsonView& primitive,
                                       std::vector<std::uint32_t> order, std::int64_t mode) {
    if (mode == kTriangles) {
        if (order.size() % 3 != 0) warn("the last triangle is incomplete and left out, " + primitive.where());
        order.resize(order.size() / 3 * 3);
        return order;
    }
    std::vector<std::uint32_t> triangles;
    if (order.size() < 3) return triangles;
    document.spend((order.size() - 2) * 3 * sizeof(std::uint32_t), primitive);
    triangles.reserve((order.size() - 2) * 3);
    for (std::size_t i = 0; i + 2 < order.size(); ++i) {
        const std::size_t odd = i % 2;
        if (mode == kTriangleStrip) {
            triangles.insert(triangles.end(), {order[i], order[i + 1 + odd], order[i + 2 - odd]});
        } else {
            triangles.insert(triangles.end(), {order[i + 1], order[i + 2], order[0]});
        }
    }
    return triangles;
}

// Unit tangents with a sign, or none at all when one of them is unusable: they are then computed.
void checkTangents(Primitive& p) {
    for (glm::vec4& t : p.tangents) {
        const float length = glm::length(glm::vec3(t));
        if (!(length > 1e-6f) || !std::isfinite(length) || !(std::abs(t.w) > 0)) return p.tangents.clear();
        t = glm::vec4(glm::vec3(t) / length, t.w < 0 ? -1.f : 1.f);
    }
}

template <typename T>
std::size_t replaceNonfinite(std::vector<T>& values, float replacement) {
    std::size_t replaced = 0;
    for (T& v : values) {
        for (int c = 0; c < T::length(); ++c) {
            if (std::isfinite(v[c])) continue;
            v[c] = replacement;
            ++replaced;
        }
    }
    return replaced;
}

// Colours as linear RGBA in [0, 1]; an integer accessor that is not normalized would be 255 times too bright.
std::vector<glm::vec4> readVertexColors(Document& document, const JsonView& reference) {
    const JsonView accessor = document.resolve(reference, "accessors");
    constexpr std::int64_t kFloat = 5126;
    if (accessor.member("componentType").integer() != kFloat && !accessor.boolean("normalized", false)) {
        reference.fail("colours as integers must be normalized");
    }
    return readColors(document, reference);
}

void warnOfRepairs(const JsonView& primitive, const RepairCounts& dropped, std::size_t replaced) {
    if (dropped.nonfinite) {
        warn(std::to_string(dropped.nonfinite) + " triangles with NaN or infinite positions are left out, " +
             primitive.where());
    }
    if (replaced) {
        warn(std::to_string(replaced) + " NaN or infinite texture coordinates or colours are replaced, " +
             primitive.where());
    }
}

}  // namespace

std::optional<Primitive> readPrimitive(Document& document, const JsonView& primitive, std::size_t joints,
                                       const Material& material) {
    std::int64_t mode = kTriangles;
    if (const auto value = primitive.find("mode")) {
        mode = value->integer();
        if (mode < 0 || mode > kTriangleFan)
            value->fail("no primitive mode has the number " + std::to_string(mode));
    }
    if (mode < kTriangles) {
        warn("points and lines are left out, " + primitive.where());
        return std::nullopt;
    }
    const JsonView attributes = primitive.member("attributes");
    const auto position = attributes.find("POSITION");
    if (!position) {
        warn("a primitive without positions is left out, " + primitive.where());
        return std::nullopt;
    }

    decompressPrimitive(document, primitive);
    Primitive p;
    p.positions = readVec3(document, *position);
    const std::size_t count = p.positions.size();
    p.normals = readAttribute(document, attributes, "NORMAL", count, readVec3);
    if (material.tangentTexture()) p.tangents = readAttribute(document, attributes, "TANGENT", count, readVec4);
    p.uv0 = readAttribute(document, attributes, "TEXCOORD_0", count, readVec2);
    p.uv1 = readAttribute(document, attributes, "TEXCOORD_1", count, readVec2);
    p.colors = readAttribute(document, attributes, "COLOR_0", count, readVertexColors);
    p.indices = toTriangles(document, primitive, readVertexOrder(document, primitive, count), mode);

    const bool smooth = primitive.find("indices").has_value();
    const RepairCounts dropped = dropBadTriangles(p, primitive.find("targets").has_value());
    std::vector<std::uint32_t> vertices = dropUnusedVertices(p);
    const std::size_t replaced =
        replaceNonfinite(p.uv0, 0) + replaceNonfinite(p.uv1, 0) + replaceNonfinite(p.colors, 1);
    warnOfRepairs(primitive, dropped, replaced);
    if (p.indices.empty()) {
        warn("a primitive without a triangle of any area is left out, " + primitive.where());
        return std::nullopt;
    }
    completeNormals(p, smooth);
    checkTangents(p);
    if (material.tangentTexture() && p.tangents.empty()) {
        for (const std::uint32_t original : computeTangents(p, material.tangentTexture()))
            vertices.push_back(vertices[original]);
    }
    readDeformation(document, primitive, joints, vertices, count, p);
    return p;
}

}  // namespace cutis::gltf
