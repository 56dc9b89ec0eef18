#include "renderer/scene/deform.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "renderer/core/parallel.h"
#include "renderer/scene/mesh_repair.h"

namespace cutis {
namespace {

constexpr std::uint32_t kBlock = 4096;  // vertices that a thread takes at a time

// Vertices first to last of one primitive, morphed.
struct Block {
    std::uint32_t first = 0, last = 0;
    std::vector<glm::dvec3> positions, normals, tangents;  // tangents may be empty
};

glm::vec3 unitOr(const glm::dvec3& v, const glm::vec3& fallback) {
    const double length = glm::length(v);
    return length > 1e-20 && std::isfinite(length) ? glm::vec3(v / length) : fallback;
}

void addDeltas(std::vector<glm::dvec3>& values, const std::vector<glm::vec3>& deltas,
               const MorphTarget& target, const Block& block, double weight) {
    if (deltas.empty() || values.empty()) return;
    const auto begin = std::lower_bound(target.vertices.begin(), target.vertices.end(), block.first);
    for (auto v = begin; v != target.vertices.end() && *v < block.last; ++v) {
        values[*v - block.first] += weight * glm::dvec3(deltas[std::size_t(v - target.vertices.begin())]);
    }
}

Block morphed(const Deformation& d, std::uint32_t first, std::span<const double> weights) {
    Block block{
        first, std::min<std::uint32_t>(first + kBlock, std::uint32_t(d.positions.size())), {}, {}, {}};
    const auto take = [&](auto& to, const auto& from) {
        for (std::uint32_t v = block.first; v < block.last && !from.empty(); ++v) to.emplace_back(from[v]);
    };
    take(block.positions, d.positions), take(block.normals, d.normals), take(block.tangents, d.tangents);
    for (std::size_t t = 0; t < std::min(weights.size(), d.targets.size()); ++t) {
        if (weights[t] == 0) continue;
        const MorphTarget& target = d.targets[t];
        addDeltas(block.positions, target.positions, target, block, weights[t]);
        addDeltas(block.normals, target.normals, target, block, weights[t]);
        addDeltas(block.tangents, target.tangents, target, block, weights[t]);
    }
    return block;
}

// Of the morphed shape, where the file has none.
std::vector<glm::vec3> recomputedNormals(const Primitive& primitive,
                                         const std::vector<glm::vec3>& positions) {
    Primitive shape;
    shape.positions = positions;
    shape.indices = primitive.indices;
    completeNormals(shape, primitive.deformation->smoothNormals);
    return std::move(shape.normals);
}

// glTF 2.0, §3.7.3.3.
glm::dmat4 blendedMatrix(const Deformation& d, std::uint32_t vertex, std::span<const glm::dmat4> joints) {
    glm::dmat4 blended(0);
    for (std::uint32_t i = d.firstInfluence[vertex]; i < d.firstInfluence[vertex + 1]; ++i) {
        blended += joints[d.influences[i].joint] * double(d.influences[i].weight);
    }
    return blended;
}

// The inverse transpose up to a positive factor, and defined where a bone flattens an axis.
glm::dmat3 normalMatrix(const glm::dmat3& m) {
    const glm::dmat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::determinant(m) < 0 ? -cofactor : cofactor;
}

bool storeBlock(Primitive& p, const Block& block, std::span<const glm::dmat4> joints, double farthest) {
    const Deformation& d = *p.deformation;
    bool fine = true;
    for (std::uint32_t v = block.first; v < block.last; ++v) {
        const std::uint32_t i = v - block.first;
        glm::dvec3 position = block.positions[i], normal = block.normals[i];
        glm::dvec3 tangent = block.tangents.empty() ? glm::dvec3(0) : block.tangents[i];
        double side = 1;
        if (!d.firstInfluence.empty()) {
            const glm::dmat4 m = blendedMatrix(d, v, joints);
            const glm::dmat3 directions(m);
            position = glm::dvec3(m * glm::dvec4(position, 1));
            normal = normalMatrix(directions) * normal;
            tangent = directions * tangent;
            side = glm::determinant(directions) < 0 ? -1 : 1;
        }
        for (int c = 0; c < 3; ++c) fine &= std::abs(position[c]) <= farthest;
        p.positions[v] = glm::vec3(position);
        p.normals[v] = unitOr(normal, d.normals[v]);
        if (block.tangents.empty()) continue;
        p.tangents[v] = glm::vec4(unitOr(tangent, glm::vec3(d.tangents[v])), d.tangents[v].w * float(side));
    }
    return fine;
}

}  // namespace

bool mirrors(std::span<const glm::dmat4> joints) {
    const auto count = std::count_if(joints.begin(), joints.end(),
                                     [](const glm::dmat4& m) { return glm::determinant(glm::dmat3(m)) < 0; });
    return 2 * static_cast<std::size_t>(count) > joints.size();
}

bool deform(Primitive& p, std::span<const double> weights, std::span<const glm::dmat4> joints,
            double farthest) {
    const Deformation& d = *p.deformation;
    const std::size_t vertices = d.positions.size(), blocks = (vertices + kBlock - 1) / kBlock;
    p.positions.resize(vertices), p.normals.resize(vertices), p.tangents.resize(d.tangents.size());
    const bool morphs = std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0; });
    std::vector<glm::vec3> normals;
    if (morphs && !d.ownNormals) {
        std::vector<glm::vec3> positions(vertices);
        parallelFor(blocks, [&](std::size_t b) {
            const Block block = morphed(d, std::uint32_t(b * kBlock), weights);
            std::copy(block.positions.begin(), block.positions.end(), positions.begin() + block.first);
        });
        normals = recomputedNormals(p, positions);
        // Triangles of what its joints mirror are stored the other way round.
        if (mirrors(joints))
            for (glm::vec3& n : normals) n = -n;
    }
    std::atomic<bool> fine = true;
    parallelFor(blocks, [&](std::size_t b) {
        Block block = morphed(d, std::uint32_t(b * kBlock), weights);
        for (std::uint32_t v = block.first; v < block.last && !normals.empty(); ++v)
            block.normals[v - block.first] = normals[v];
        if (!storeBlock(p, block, joints, farthest)) fine = false;
    });
    return fine;
}

}  // namespace cutis
