#include "renderer/scene/pose.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/core/error.h"
#include "renderer/core/suggest.h"
#include "renderer/scene/characters.h"
#include "renderer/scene/deform.h"

namespace cutis {
namespace {

constexpr double kFarthest = 1e9;  // units: what is farther away has no precision left on the GPU

[[noreturn]] void refusePose(const Scene& scene, int animation, double seconds, const std::string& node) {
    char time[32];
    std::snprintf(time, sizeof time, "%g s", seconds);
    const std::string when =
        animation == kAtRest ? "at rest"
                             : "at " + std::string(time) + " of \"" + scene.animations[animation].name + "\"";
    throw Error("cannot pose scene", when + " it reaches beyond 1e9 units",
                scene.file.string() + (node.empty() ? "" : ", node \"" + node + "\""));
}

void applyChannel(const AnimationChannel& channel, const std::vector<double>& value, Transform& transform,
                  std::vector<double>& weights) {
    switch (channel.property) {
        case AnimatedProperty::translation:
            transform.translation = {value[0], value[1], value[2]};
            break;
        case AnimatedProperty::rotation:
            transform.rotation = {value[3], value[0], value[1], value[2]};
            break;
        case AnimatedProperty::scale:
            transform.scale = {value[0], value[1], value[2]};
            break;
        case AnimatedProperty::weights:
            weights = value;
            break;
    }
}

// Local transforms of nodes and, returned, the morph weights of each.
std::vector<std::vector<double>> poseNodes(Scene& scene, int animation, double seconds) {
    std::vector<std::vector<double>> weights;
    std::vector<Transform> transforms(scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        weights.push_back(scene.nodes[i].weights);
        if (scene.nodes[i].rest) transforms[i] = *scene.nodes[i].rest;
    }
    if (animation != kAtRest) {
        const Animation& moves = scene.animations.at(std::size_t(animation));
        for (const AnimationChannel& channel : moves.channels) {
            const bool rotation = channel.property == AnimatedProperty::rotation;
            applyChannel(channel, sampleCurve(moves.samplers[channel.sampler], rotation, seconds),
                         transforms[channel.node], weights[channel.node]);
        }
    }
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].rest) scene.nodes[i].local = toMatrix(transforms[i]);
    }
    return weights;
}

// What takes bound vertices to the space of their node, one a joint.
std::vector<glm::dmat4> jointMatrices(const Scene& scene, const Node& node) {
    std::vector<glm::dmat4> matrices;
    if (node.skin < 0) return matrices;
    const Skin& skin = scene.skins[node.skin];
    // A node flattened by a scale of 0 has no space to place anything in: what hangs on it is not there.
    const bool flat = std::abs(glm::determinant(node.world)) < 1e-30;
    const glm::dmat4 toNode = flat ? glm::dmat4(0) : glm::inverse(node.world);
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
        matrices.push_back(toNode * scene.nodes[skin.joints[i]].world * skin.inverseBind[i]);
    }
    return matrices;
}

}  // namespace

void poseScene(Scene& scene, int animation, double seconds) {
    const std::vector<std::vector<double>> weights = poseNodes(scene, animation, seconds);
    updateWorldTransforms(scene);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        for (int c = 0; c < 4; ++c) {
            for (int r = 0; r < 4; ++r) {
                if (!(std::abs(node.world[c][r]) <= kFarthest))
                    refusePose(scene, animation, seconds, node.name);
            }
        }
    }
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (node.mesh < 0) continue;
        std::vector<Primitive>& primitives = scene.meshes[node.mesh].primitives;
        if (std::none_of(primitives.begin(), primitives.end(),
                         [](const Primitive& p) { return p.deformation; }))
            continue;
        const std::vector<glm::dmat4> joints = jointMatrices(scene, node);
        for (Primitive& primitive : primitives) {
            if (primitive.deformation && !deform(primitive, weights[i], joints, kFarthest))
                refusePose(scene, animation, seconds, node.name);
        }
    }
    computeBounds(scene);
}

int findAnimation(const Scene& scene, const std::string& nameOrIndex) {
    std::vector<std::string> names;
    std::string list;
    for (const Animation& animation : scene.animations) {
        if (animation.name == nameOrIndex) return int(names.size());
        names.push_back(animation.name);
        list += (list.empty() ? "there are '" : ", '") + animation.name + "'";
    }
    std::size_t index = 0;
    const char* last = nameOrIndex.data() + nameOrIndex.size();
    const auto [end, error] = std::from_chars(nameOrIndex.data(), last, index);
    if (error == std::errc() && end == last && index < names.size()) return int(index);
    throw Error("no animation '" + nameOrIndex + "'" + didYouMean(nameOrIndex, names),
                list.empty() ? "the scene has none" : list, scene.file.string());
}

std::vector<glm::dmat4> restWorldTransforms(const Scene& scene) {
    std::vector<glm::dmat4> worlds(scene.nodes.size());
    std::vector<int> stack;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].parent < 0) stack.push_back(int(i));
    }
    while (!stack.empty()) {
        const int i = stack.back();
        stack.pop_back();
        const Node& node = scene.nodes[i];
        const glm::dmat4 local = node.rest ? toMatrix(*node.rest) : node.local;
        worlds[i] = node.parent < 0 ? local : worlds[node.parent] * local;
        stack.insert(stack.end(), node.children.begin(), node.children.end());
    }
    return worlds;
}

glm::dmat4 toMatrix(const Transform& t) {
    return glm::translate(glm::dmat4(1), t.translation) * glm::mat4_cast(t.rotation) *
           glm::scale(glm::dmat4(1), t.scale);
}

Transform toTransform(const glm::dmat4& matrix) {
    Transform t;
    t.translation = glm::dvec3(matrix[3]);
    const glm::dmat3 linear(matrix);
    for (int c = 0; c < 3; ++c) t.scale[c] = glm::length(linear[c]);
    if (glm::determinant(linear) < 0) t.scale.x = -t.scale.x;
    glm::dmat3 axes(1);
    for (int c = 0; c < 3; ++c) {
        if (t.scale[c] == 0) return t;  // no axis, no rotation
        axes[c] = linear[c] / t.scale[c];
    }
    if (std::abs(glm::determinant(axes)) < 1e-9) return t;
    // Sheared axes are no rotation: the second is turned upright on the first, and the third on both.
    axes[1] = glm::normalize(axes[1] - axes[0] * glm::dot(axes[0], axes[1]));
    axes[2] = glm::cross(axes[0], axes[1]);
    t.rotation = glm::normalize(glm::quat_cast(axes));
    return t;
}

}  // namespace cutis
