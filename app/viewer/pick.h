// What lies under the mouse.
#pragma once

#include <optional>

#include "renderer/scene/scene.h"

namespace cutis::app {

struct Ray {
    glm::dvec3 origin{0}, direction{0, 0, -1};  // world metres; direction of unit length
};

// Through the point (x, y) of the picture, each in [0, 1] from its top left.
Ray rayThrough(const Camera& camera, double aspect, double x, double y);

struct Hit {
    glm::dvec3 position{0};  // world metres
    glm::dvec3 normal{0};    // interpolated from the vertices, of unit length, towards the ray's origin
    double distance = 0;     // metres from the ray's origin
    int node = -1, material = -1;
};

// The nearest triangle of an opaque material that the ray meets: hair and lashes, which are seen through, do
// not count. Tests every triangle, on all cores: some milliseconds for a million.
std::optional<Hit> pick(const Scene& scene, const Ray& ray);

}  // namespace cutis::app
