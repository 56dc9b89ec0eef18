// Joints, weights and morph targets of a primitive.
#include <algorithm>
#include <cmath>

#include "renderer/core/error.h"
#include "renderer/scene/gltf_accessors.h"
#include "renderer/scene/gltf_parts.h"

namespace cutis::gltf {
namespace {

// Influences of each vertex of the file, all sets of four together; weights as they are.
std::vector<std::vector<Influence>> readInfluences(Document& document, const JsonView& attributes,
                                                   std::size_t joints, std::size_t count) {
    std::vector<std::vector<Influence>> influences;
    for (int set = 0;; ++set) {
        const std::string jointsName = "JOINTS_" + std::to_string(set),
                          weightsName = "WEIGHTS_" + std::to_string(set);
        const auto reference = attributes.find(jointsName.c_str());
        if (!reference) return influences;
        document.spend(count * (sizeof(std::vector<Influence>) + 4 * sizeof(Influence)), *reference);
        const auto indices = readAttribute(document, attributes, jointsName.c_str(), count, readJoints);
        const auto weights = readAttribute(document, attributes, weightsName.c_str(), count, readVec4);
        if (weights.empty()) reference->fail(weightsName + " is missing");
        influences.resize(count);
        for (std::size_t v = 0; v < count; ++v) {
            for (int k = 0; k < 4; ++k) {
                const bool counts = weights[v][k] > 0 && std::isfinite(weights[v][k]);
                const bool first = set == 0 && k == 0;  // what a vertex without weights will follow
                if (!counts && !first) continue;
                if (indices[v][k] >= joints) {
                    reference->fail("joint " + std::to_string(indices[v][k]) + " of " +
                                    std::to_string(joints));
                }
                influences[v].push_back({indices[v][k], counts ? weights[v][k] : 0.f});
            }
        }
    }
}

// Makes the weights of a vertex sum to 1; false when they were not meant to. Bytes leave them up to 1 % off.
bool normalizeWeights(std::vector<Influence>& influences) {
    double sum = 0;
    for (const Influence& influence : influences) sum += influence.weight;
    if (sum > 0) {
        std::erase_if(influences, [](const Influence& influence) { return influence.weight == 0; });
        for (Influence& influence : influences) influence.weight = float(influence.weight / sum);
    } else {
        influences.resize(1);
        influences[0].weight = 1;
    }
    return std::abs(sum - 1) <= 0.01;
}

void readSkinning(Document& document, const JsonView& entry, std::size_t joints,
                  const std::vector<std::uint32_t>& vertices, std::size_t count, Deformation& deformation) {
    std::vector<std::vector<Influence>> influences =
        readInfluences(document, entry.member("attributes"), joints, count);
    if (influences.empty()) return;
    std::size_t mended = 0;
    for (const std::uint32_t v : vertices) mended += !normalizeWeights(influences[v]);
    if (mended > 0) {
        warn("the weights of " + std::to_string(mended) + " vertices do not sum to 1 and are scaled, " +
             entry.where());
    }
    deformation.firstInfluence.push_back(0);
    for (const std::uint32_t v : vertices) {
        deformation.influences.insert(deformation.influences.end(), influences[v].begin(),
                                      influences[v].end());
        deformation.firstInfluence.push_back(std::uint32_t(deformation.influences.size()));
    }
}

// Differences that are NaN or infinite move nothing.
std::size_t dropNonfinite(std::vector<glm::vec3>& deltas) {
    std::size_t dropped = 0;
    for (glm::vec3& d : deltas) {
        if (std::isfinite(d.x) && std::isfinite(d.y) && std::isfinite(d.z)) continue;
        d = glm::vec3(0);
        ++dropped;
    }
    return dropped;
}

// Only the vertices that it moves: of a face's targets most move a few.
MorphTarget readTarget(Document& document, const JsonView& entry, const std::vector<std::uint32_t>& vertices,
                       std::size_t count, const Deformation& deformation) {
    std::vector<glm::vec3> positions = readAttribute(document, entry, "POSITION", count, readVec3), normals,
                           tangents;
    if (deformation.ownNormals) normals = readAttribute(document, entry, "NORMAL", count, readVec3);
    if (!deformation.tangents.empty()) tangents = readAttribute(document, entry, "TANGENT", count, readVec3);
    if (const std::size_t dropped =
            dropNonfinite(positions) + dropNonfinite(normals) + dropNonfinite(tangents)) {
        warn(std::to_string(dropped) + " NaN or infinite differences are left out, " + entry.where());
    }
    const auto at = [](const std::vector<glm::vec3>& deltas, std::uint32_t v) {
        return deltas.empty() ? glm::vec3(0) : deltas[v];
    };
    MorphTarget target;
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        const std::uint32_t v = vertices[i];
        const glm::vec3 none(0);
        if (at(positions, v) == none && at(normals, v) == none && at(tangents, v) == none) continue;
        target.vertices.push_back(i);
        target.positions.push_back(at(positions, v));
        if (!normals.empty()) target.normals.push_back(normals[v]);
        if (!tangents.empty()) target.tangents.push_back(tangents[v]);
    }
    return target;
}

}  // namespace

void readDeformation(Document& document, const JsonView& entry, std::size_t joints,
                     const std::vector<std::uint32_t>& vertices, std::size_t count, Primitive& p) {
    const auto targets = entry.find("targets");
    auto deformation = std::make_shared<Deformation>();
    if (joints > 0) readSkinning(document, entry, joints, vertices, count, *deformation);
    if (deformation->influences.empty() && (!targets || targets->size() == 0)) return;
    document.spend(p.positions.size() * (sizeof(glm::vec3) * 3 + sizeof(glm::vec4)), entry);
    deformation->positions = p.positions;
    deformation->normals = p.normals;
    deformation->tangents = p.tangents;
    deformation->ownNormals = entry.member("attributes").find("NORMAL").has_value();
    deformation->smoothNormals = entry.find("indices").has_value();
    if (targets) {
        for (const JsonView& target : targets->elements())
            deformation->targets.push_back(readTarget(document, target, vertices, count, *deformation));
    }
    p.deformation = std::move(deformation);
}

}  // namespace cutis::gltf
