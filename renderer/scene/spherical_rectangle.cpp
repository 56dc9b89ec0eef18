#include "renderer/scene/spherical_rectangle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cutis {

SphericalRectangle::SphericalRectangle(const glm::dvec3& centre, const glm::dvec3& x, const glm::dvec3& y,
                                       const glm::dvec2& size, const glm::dvec3& eye) {
    const glm::dvec3 towards = centre - eye;
    height_ = -std::abs(glm::dot(towards, glm::cross(x, y)));
    middle_ = {glm::dot(towards, x), glm::dot(towards, y)};
    low_ = middle_ - 0.5 * size;
    high_ = middle_ + 0.5 * size;
    // Normals of the planes through the eye and each side; their angles are those of the spherical rectangle.
    const glm::dvec3 v00(low_, height_), v01(low_.x, high_.y, height_), v10(high_.x, low_.y, height_),
        v11(high_, height_);
    const glm::dvec3 n0 = glm::normalize(glm::cross(v00, v10)), n1 = glm::normalize(glm::cross(v10, v11)),
                     n2 = glm::normalize(glm::cross(v11, v01)), n3 = glm::normalize(glm::cross(v01, v00));
    const auto angle = [](const glm::dvec3& a, const glm::dvec3& b) {
        return std::acos(std::clamp(-glm::dot(a, b), -1.0, 1.0));
    };
    b0_ = n0.z;
    b1_ = n2.z;
    k_ = 2 * std::numbers::pi - angle(n2, n3) - angle(n3, n0);
    solidAngle_ = angle(n0, n1) + angle(n1, n2) - k_;
}

glm::dvec2 SphericalRectangle::placeOf(const glm::dvec2& unit) const {
    const double around = unit.x * solidAngle_ + k_;
    const double f = (std::cos(around) * b0_ - b1_) / std::sin(around);
    const double c = std::clamp(std::copysign(1 / std::sqrt(f * f + b0_ * b0_), f), -1.0, 1.0);
    const double x = std::clamp(-c * height_ / std::sqrt(std::max(1 - c * c, 1e-300)), low_.x, high_.x);
    const double d = std::hypot(x, height_);
    const double h0 = low_.y / std::hypot(d, low_.y), h1 = high_.y / std::hypot(d, high_.y);
    const double h = h0 + unit.y * (h1 - h0);
    const double y = std::clamp(h * d / std::sqrt(std::max(1 - h * h, 1e-300)), low_.y, high_.y);
    return glm::dvec2(x, y) - middle_;
}

}  // namespace cutis
