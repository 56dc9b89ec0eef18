// Vertices as skins and morph targets move them.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "renderer/scene/scene.h"

namespace cutis {

// Fills positions, normals and tangents of a primitive from its deformation. `weights` are those of its morph
// targets (missing ones are 0); `joints`, one a joint of its skin, take bound vertices to where the joint
// holds them. False when a position is not finite or beyond `farthest` in some coordinate.
bool deform(Primitive& primitive, std::span<const double> weights, std::span<const glm::dmat4> joints,
            double farthest);

// Whether most of these joint matrices make mirror images of what they move.
bool mirrors(std::span<const glm::dmat4> joints);

}  // namespace cutis
