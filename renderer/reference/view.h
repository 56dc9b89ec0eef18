// Rays of the picture's camera.
#pragma once

#include <glm/glm.hpp>

#include "renderer/scene/scene.h"

namespace cutis::reference {

struct ViewRay {
    glm::dvec3 from{0}, direction{0, 0, -1};  // relative to the scene's centre; unit direction
    double tNear = 0, tFar = 0;               // where the clipping planes are met
};

class View {
  public:
    // The picture's aspect wins over the camera's: what the camera frames vertically stays.
    View(const Camera& camera, const glm::dvec3& origin, int width, int height);

    // Through a point of the picture in pixels, (0, 0) being its upper left corner.
    ViewRay rayThrough(const glm::dvec2& pixel) const;
    // Metres along the view axis.
    double depthOf(const glm::dvec3& p) const { return glm::dot(p - eye_, forward_); }

  private:
    bool orthographic_;
    double znear_, zfar_;
    glm::dvec3 eye_, right_, up_,
        forward_;  // right and up reach the picture's edges, at unit depth if perspective
    glm::dvec2 size_;
};

}  // namespace cutis::reference
