// Scenes in the poses that their animations give them.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace cutis {

inline constexpr int kAtRest = -1;

// Puts the scene in the pose of an animation (an index into Scene::animations, or kAtRest) at a time in
// seconds: local and world transforms of nodes; positions, normals and tangents of what skins and morph
// targets deform; cameras and lights that hang on nodes; bounds of the scene and of its characters. It
// follows from Primitive::deformation, Node::rest and Node::weights alone, whatever pose the scene was in.
// Who is a character stays. Computed in double, on all cores. Throws Error where something leaves the range
// that can be drawn (10⁹ units).
//
// Vertices are moved as glTF 2.0 §3.7.3.3 has it, and normals by the inverse transpose of the same matrix.
// What is skinned is placed by its joints alone: positions stay in the space of their node, so that
// Node::world takes them to where the joints hold them.
void poseScene(Scene& scene, int animation, double seconds);

// An animation by its name or its number from 0. Throws Error, naming those that there are.
int findAnimation(const Scene& scene, const std::string& nameOrIndex);

// The value of a curve at a time (glTF 2.0, appendix C). Rotations are interpolated on the sphere and of unit
// length.
std::vector<double> sampleCurve(const AnimationSampler& sampler, bool rotation, double seconds);

// Node::world of every node as the scene rests, whatever pose it is in.
std::vector<glm::dmat4> restWorldTransforms(const Scene& scene);

glm::dmat4 toMatrix(const Transform& transform);
// What the matrix does without its shear, which a Transform cannot hold.
Transform toTransform(const glm::dmat4& matrix);

}  // namespace cutis
