// A layout for surfaces that have none: parts that face about one way, each seen from there.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/frame/layout_triangles.h"

namespace cutis {

struct Unwrapped {
    std::vector<glm::vec2> places;      // a corner of each triangle; lengths are those on the body over its size
    std::vector<std::uint32_t> charts;  // a triangle: the number of the part that it belongs to
    std::uint32_t count = 0;            // of parts
    double size = 1;                    // of the body, in the units of the positions
};

// Each triangle is seen along that of twelve directions which the surface around it faces most: lengths shrink by no more
// than a factor of three, on most of a smooth body by no more than 1.26. No part lies upon itself. corners: positions of the
// corners of each triangle; neighbours: over the surface.
Unwrapped unwrap(std::span<const glm::vec3> corners, const Neighbours& neighbours);

}  // namespace cutis
