#include "renderer/measure/variants.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <string>

#include "renderer/scene/characters.h"

namespace cutis {
namespace {

constexpr double kGoldenAngle = std::numbers::pi * 0.7639320225002103;  // π (3 - √5)

// A copy of the tree under `node`, with its characters' meshes; returns its root.
int copyTree(Scene& scene, int node, int parent) {
    const int copy = static_cast<int>(scene.nodes.size());
    Node made = scene.nodes[node];
    const std::vector<int> children = made.children;
    made.parent = parent;
    made.children.clear();
    made.camera = made.light = -1;
    scene.nodes.push_back(made);
    for (int child : children) {
        const int childCopy = copyTree(scene, child, copy);
        scene.nodes[copy].children.push_back(childCopy);
    }
    return copy;
}

}  // namespace

void repeatLights(Rig& rig, const Scene& scene, int count) {
    std::vector<Light> own;
    for (const Light& light : rig.lights) {
        if (light.enabled) own.push_back(light);
    }
    if (own.empty()) return;
    const glm::dvec3 centre = scene.bounds.centre();
    const int shown = std::min(count, static_cast<int>(own.size()));
    const double rounds = static_cast<double>(count) / shown;
    rig.lights.clear();
    for (int i = 0; i < count; ++i) {
        Light light = own[i % own.size()];
        const int round = i / static_cast<int>(own.size());
        const glm::dmat3 turn(glm::rotate(glm::dmat4(1), round * kGoldenAngle, glm::dvec3(0, 1, 0)));
        light.position = centre + turn * (light.position - centre);
        light.direction = turn * light.direction;
        light.intensity /= rounds;
        light.place.reset();
        if (round > 0) light.name.append(" ").append(std::to_string(round + 1));
        rig.lights.push_back(light);
    }
}

void repeatCharacters(Scene& scene, int count) {
    const std::vector<Character> own = scene.characters;
    if (own.empty()) return;
    for (std::size_t c = static_cast<std::size_t>(count); c < own.size(); ++c) {
        for (int node : own[c].nodes) scene.nodes[node].mesh = -1;
    }
    const glm::dvec3 size = scene.bounds.size();
    for (int i = static_cast<int>(own.size()); i < count; ++i) {
        const int row = i / static_cast<int>(own.size());
        const int root = own[i % own.size()].root;
        const glm::dvec3 moved(0.37 * size.x / static_cast<double>(own.size()) * (row % 2),
                               0.2 * size.y * row, -1.1 * size.z * row);
        const int parent = scene.nodes[root].parent;
        const int copy = copyTree(scene, root, parent);
        if (parent >= 0) scene.nodes[parent].children.push_back(copy);
        const glm::dmat4 parentWorld = parent >= 0 ? scene.nodes[parent].world : glm::dmat4(1);
        scene.nodes[copy].local =
            glm::inverse(parentWorld) * glm::translate(glm::dmat4(1), moved) * scene.nodes[root].world;
        scene.nodes[copy].name.append(" ").append(std::to_string(row + 1));
    }
    prepareScene(scene);
}

}  // namespace cutis
