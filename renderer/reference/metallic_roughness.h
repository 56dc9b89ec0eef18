// What is not skin: glTF's metallic-roughness model (glTF 2.0, appendix B) with GGX, height-correlated Smith
// masking. In double; shaders/lib/metallic_roughness.glsl is the twin.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace cutis::reference {

// D, 1/sr: ∫ D cosθ dω = 1. alpha: roughness squared.
inline double ggxDistribution(double cosine, double alpha) {
    if (!(cosine > 0)) return 0;
    const double a2 = alpha * alpha, k = 1 + cosine * cosine * (a2 - 1);
    return a2 / (std::numbers::pi * k * k);
}

// D · G / (4 (N·L)(N·V)).
inline double ggx(const glm::dvec3& n, const glm::dvec3& v, const glm::dvec3& l, const glm::dvec3& h,
                  double alpha) {
    const double nl = std::max(glm::dot(n, l), 1e-4), nv = std::max(glm::dot(n, v), 1e-4), a2 = alpha * alpha;
    const double smith = nl * std::sqrt(nv * nv * (1 - a2) + a2) + nv * std::sqrt(nl * nl * (1 - a2) + a2);
    return ggxDistribution(glm::dot(n, h), alpha) * 0.5 / smith;
}

}  // namespace cutis::reference
