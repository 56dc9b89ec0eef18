// Channels that hold one point of each pixel: an average of two surfaces means nothing.
#pragma once

#include <optional>
#include <vector>

#include "renderer/reference/ray_scene.h"
#include "renderer/reference/shading.h"
#include "renderer/reference/view.h"
#include "renderer/scene/picture.h"

namespace cutis::reference {

// The point that stands for a pixel: of the surface that most of its samples see, the one nearest to their
// middle. Surfaces that are seen through count only where nothing else is seen.
struct PixelPoint {
    Hit hit;
    glm::dvec3 view{0};  // unit, to the eye
};

std::optional<PixelPoint> findPixelPoint(const RayScene& rays, const View& view, int x, int y);

// One of albedo, normal, position, depth, character and thickness. 0 where there is no point.
Picture makeDataChannel(const std::string& name, const std::vector<std::optional<PixelPoint>>& points,
                        int width, int height, const RayScene& rays, const PlacedScene& placed,
                        const View& view, const Rig& rig);

}  // namespace cutis::reference
