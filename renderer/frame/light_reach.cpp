#include "renderer/frame/light_reach.h"

#include <algorithm>
#include <cmath>

namespace cutis {
namespace {

// Rounding of the device's float32 must not light what is dark here.
constexpr double kSlack = 1e-4;

bool behind(const LightSample& sample, const Bounds& box) {
    const glm::dvec3 size = box.size();
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner = box.min + size * glm::dvec3(i & 1, i >> 1 & 1, i >> 2);
        const glm::dvec3 to = corner - sample.position;
        if (glm::dot(to, sample.direction) > -kSlack * glm::length(to)) return false;
    }
    return true;
}

bool beyondRange(const LightSample& sample, const Bounds& box) {
    const glm::dvec3 nearest = glm::clamp(sample.position, box.min, box.max);
    return sample.range > 0 && glm::length(nearest - sample.position) > sample.range * (1 + kSlack);
}

// By the sphere around the box.
bool outsideCone(const LightSample& sample, const Bounds& box) {
    if (sample.cosOuter <= -1) return false;
    const glm::dvec3 to = box.centre() - sample.position;
    const double distance = glm::length(to), radius = 0.5 * glm::length(box.size());
    if (distance <= radius) return false;
    const double angle = std::acos(std::clamp(glm::dot(to, sample.direction) / distance, -1.0, 1.0));
    const double outer = std::acos(std::min(sample.cosOuter, 1.0));
    return angle - std::asin(radius / distance) > outer + kSlack;
}

}  // namespace

const char* whyDark(const LightSample& sample, const Bounds& box) {
    if (sample.intensity == glm::dvec3(0)) return "it gives no light";
    if (box.empty()) return "nothing is there";
    if (sample.directional) return nullptr;
    if (beyondRange(sample, box)) return "its range ends before anything";
    if (sample.cosineEmission && behind(sample, box)) return "everything is behind it";
    if (outsideCone(sample, box)) return "everything is outside its cone";
    return nullptr;
}

}  // namespace cutis
