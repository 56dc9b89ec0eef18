// Directions and the frames they are sampled in.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace cutis::reference {

inline constexpr double kPi = std::numbers::pi;

// Two unit vectors that complete the unit vector n to a right-handed basis (Duff et al. 2017).
struct Frame {
    glm::dvec3 t, b, n;
    explicit Frame(const glm::dvec3& normal) : n(normal) {
        const double s = n.z >= 0 ? 1 : -1, a = -1 / (s + n.z), c = n.x * n.y * a;
        t = {1 + s * n.x * n.x * a, s * c, -s * n.x};
        b = {c, s + n.y * n.y * a, -n.y};
    }
    glm::dvec3 toWorld(const glm::dvec3& v) const { return t * v.x + b * v.y + n * v.z; }
};

// normalize() that answers `fallback` where there is no direction.
inline glm::dvec3 safeNormalize(const glm::dvec3& v, const glm::dvec3& fallback) {
    const double length = glm::length(v);
    return length > 0 ? v / length : fallback;
}

// About +Z with pdf = cosθ / π.
inline glm::dvec3 sampleCosine(const glm::dvec2& u) {
    const double r = std::sqrt(u.x), phi = 2 * kPi * u.y;
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0, 1 - u.x))};
}

}  // namespace cutis::reference
