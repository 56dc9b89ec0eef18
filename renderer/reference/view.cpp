#include "renderer/reference/view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cutis::reference {

View::View(const Camera& camera, const glm::dvec3& origin, int width, int height)
    : orthographic_(camera.orthographic), znear_(camera.znear), zfar_(camera.zfar), size_(width, height) {
    const double aspect = size_.x / size_.y;
    const double y =
        orthographic_ ? std::max(camera.ymag, camera.xmag / aspect) : std::tan(0.5 * camera.yfov);
    right_ = glm::normalize(glm::dvec3(camera.world[0])) * (y * aspect);
    up_ = glm::normalize(glm::dvec3(camera.world[1])) * y;
    forward_ = -glm::normalize(glm::dvec3(camera.world[2]));
    eye_ = glm::dvec3(camera.world[3]) - origin;
}

ViewRay View::rayThrough(const glm::dvec2& pixel) const {
    const glm::dvec2 ndc = pixel / size_ * 2.0 - 1.0;
    const glm::dvec3 lateral = ndc.x * right_ - ndc.y * up_;
    ViewRay ray;
    ray.from = orthographic_ ? eye_ + lateral : eye_;
    ray.direction = orthographic_ ? forward_ : glm::normalize(forward_ + lateral);
    const double cosine = glm::dot(ray.direction, forward_);
    ray.tNear = std::max(znear_, 0.0) / cosine;
    ray.tFar = zfar_ > 0 ? zfar_ / cosine : std::numeric_limits<double>::infinity();
    return ray;
}

}  // namespace cutis::reference
