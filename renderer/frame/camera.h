// The camera as the composite uses it.
#pragma once

#include <glm/glm.hpp>

#include "renderer/scene/scene.h"
#include "shaders/shared/scene.h"

namespace cutis {

// Half extents of the picture at unit depth (perspective) or in metres (orthographic). The picture's own
// aspect wins over the camera's: what the camera frames vertically stays.
glm::dvec2 halfExtents(const Camera& camera, const glm::ivec2& pixels);

// Projection and rays of `camera` for a picture of that many pixels, relative to `origin`. The clipping planes are
// fitted to `bounds` within those of the camera.
shared::ViewCamera viewCamera(const Camera& camera, const glm::dvec3& origin, const Bounds& bounds,
                              const glm::ivec2& pixels);

// How large things appear.
class ViewCameraMetrics {
  public:
    ViewCameraMetrics(const Camera& camera, const glm::ivec2& pixels) : camera_(camera), pixels_(pixels) {}
    // Width of a pixel at a point in world space; at the eye or behind it, that at the near plane.
    double metresPerPixel(const glm::dvec3& point) const;
    // The same from where the camera stands, whichever way it looks.
    double metresPerPixelAtDistance(const glm::dvec3& point) const;

  private:
    double widthOfPixel(double depth) const;
    Camera camera_;
    glm::ivec2 pixels_;
};

}  // namespace cutis
