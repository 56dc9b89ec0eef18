// Pores of skin at full resolution: the definition of renderer/skin/detail.h. shaders/lib/detail.glsl is the
// twin, which shows as much of them as a pixel resolves.
#pragma once

#include <glm/glm.hpp>

#include "renderer/reference/ray_scene.h"
#include "renderer/reference/surface.h"

namespace cutis::reference {

struct Pores {
    glm::dvec3 normal;   // the shading normal turned by their slopes
    double removed = 0;  // E|s|² of these slopes, which the roughness no longer stands for
};

// Of a point of skin, whose textures are read.
Pores poresAt(const Hit& hit, const SurfacePoint& point);

}  // namespace cutis::reference
