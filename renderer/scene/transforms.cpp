// World transforms of nodes and of what hangs on them.
#include "renderer/core/error.h"
#include "renderer/scene/characters.h"

namespace cutis {
namespace {

constexpr std::size_t kMaxDepth = 1000;  // of the node tree: keeps recursion over it safe

glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& fallback) {
    const double length = glm::length(v);
    return length > 1e-12 ? v / length : fallback;
}

// Rotation and translation of `world`: a camera or light is not scaled by its node.
glm::dmat4 rigidPart(const glm::dmat4& world) {
    const glm::dvec3 z = unitOr(glm::dvec3(world[2]), {0, 0, 1});
    const glm::dvec3 aside = glm::abs(z.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 x = unitOr(glm::dvec3(world[0]) - z * glm::dot(z, glm::dvec3(world[0])),
                                glm::normalize(aside - z * glm::dot(z, aside)));
    return {glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), world[3]};
}

[[noreturn]] void refuse(const Scene& scene, std::size_t node, const std::string& why) {
    throw Error("cannot use node tree", why,
                scene.file.empty() ? "nodes[" + std::to_string(node) + "]"
                                   : scene.file.string() + ", nodes[" + std::to_string(node) + "]");
}

}  // namespace

void updateWorldTransforms(Scene& scene) {
    struct Visit {
        int node;
        std::size_t depth;
    };
    std::vector<Visit> stack;
    std::vector<bool> seen(scene.nodes.size(), false);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].parent < 0) stack.push_back({int(i), 1});
    }
    std::size_t visited = 0;
    while (!stack.empty()) {
        const auto [index, depth] = stack.back();
        stack.pop_back();
        if (seen[index]) refuse(scene, index, "a node has two parents");
        if (depth > kMaxDepth)
            refuse(scene, index, "nodes nest more than " + std::to_string(kMaxDepth) + " deep");
        seen[index] = true;
        ++visited;
        Node& node = scene.nodes[index];
        node.world = node.parent < 0 ? node.local : scene.nodes[node.parent].world * node.local;
        if (node.camera >= 0) scene.cameras.at(node.camera).world = rigidPart(node.world);
        if (node.light >= 0) {
            Light& light = scene.lights.at(node.light);
            const glm::dmat4 frame = rigidPart(node.world);
            light.position = glm::dvec3(frame[3]);
            light.direction = -glm::dvec3(frame[2]);
        }
        for (const int child : node.children) {
            if (child < 0 || std::size_t(child) >= scene.nodes.size()) refuse(scene, index, "no such child");
            if (scene.nodes[child].parent != index) refuse(scene, child, "a node has two parents");
            stack.push_back({child, depth + 1});
        }
    }
    for (std::size_t i = 0; i < scene.nodes.size() && visited < scene.nodes.size(); ++i) {
        if (!seen[i]) refuse(scene, i, "nodes form a cycle");
    }
}

}  // namespace cutis
