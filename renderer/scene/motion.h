// What moves a scene, as plain data: skins, morph targets and animations. See pose.h for what is done with
// it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

namespace cutis {

struct Transform {
    glm::dvec3 translation{0};
    glm::dquat rotation{1, 0, 0, 0};  // of unit length
    glm::dvec3 scale{1};
};

// A skeleton as meshes are bound to it. Several skins may share joints.
struct Skin {
    std::string name;
    std::vector<int> joints;  // indices into Scene::nodes
    std::vector<glm::dmat4>
        inverseBind;  // one a joint: from the mesh's space to the joint's as they were bound
};

struct Influence {
    std::uint32_t joint;  // index into Skin::joints
    float weight;
};

// What a morph target of weight 1 adds to the vertices that it moves.
struct MorphTarget {
    std::vector<std::uint32_t> vertices;  // ascending; the others stay
    std::vector<glm::vec3> positions;     // one for each of `vertices`; so are these, or none:
    std::vector<glm::vec3> normals, tangents;
};

// How a primitive follows its skin and its morph targets. Never changes once it is loaded: poses are computed
// from it.
struct Deformation {
    std::vector<glm::vec3> positions, normals;  // before anything moves them; one a vertex
    std::vector<glm::vec4> tangents;            // or none
    bool ownNormals = true;     // false: the file has none; they follow from the morphed positions,
    bool smoothNormals = true;  // the same for vertices at one place
    std::vector<MorphTarget> targets;
    std::vector<std::uint32_t> firstInfluence;  // per vertex, and one more for the end; empty without a skin
    std::vector<Influence> influences;          // weights of a vertex sum to 1
};

enum class Interpolation { linear, step, cubicSpline };
enum class AnimatedProperty { translation, rotation, scale, weights };

// A curve through keys. Before the first key and after the last it stays where it is there.
struct AnimationSampler {
    Interpolation interpolation = Interpolation::linear;
    std::size_t components = 3;  // of a value: 3, 4 (a quaternion, x y z w), or one a morph target
    std::vector<float> times;    // seconds, not decreasing; at least one
    std::vector<float> values;   // one a key; of a cubic spline three: slope in, value, slope out
};

struct AnimationChannel {
    int sampler = -1;  // index into Animation::samplers
    int node = -1;     // index into Scene::nodes
    AnimatedProperty property = AnimatedProperty::translation;
};

struct Animation {
    std::string name;
    std::vector<AnimationSampler> samplers;
    std::vector<AnimationChannel> channels;
    double duration = 0;  // seconds: time of the last key
};

}  // namespace cutis
