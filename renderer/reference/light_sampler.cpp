#include "renderer/reference/light_sampler.h"

#include <cmath>
#include <limits>

#include "renderer/reference/directions.h"
#include "renderer/scene/light_samples.h"

namespace cutis::reference {
namespace {

// Radius within which a fraction u lies of the density 1 / (π² √(1-r²)) in the unit ball, whose projection
// along any axis is an even disc: with r = sin t its distribution is (2t - sin 2t) / π, t from 0 to π/2,
// solved by bisection.
double ballRadius(double u) {
    double low = 0, high = kPi / 2;
    for (int step = 0; step < 40; ++step) {
        const double t = 0.5 * (low + high);
        ((2 * t - std::sin(2 * t)) / kPi < u ? low : high) = t;
    }
    return std::sin(0.5 * (low + high));
}

glm::dvec3 pointInBall(const glm::dvec2& u, double radial) {
    const double z = 1 - 2 * u.x, across = std::sqrt(std::max(0.0, 1 - z * z)), phi = 2 * kPi * u.y;
    return ballRadius(radial) * glm::dvec3(across * std::cos(phi), across * std::sin(phi), z);
}

}  // namespace

LightSampler::LightSampler(const Rig& rig, const glm::dvec3& origin) {
    for (const Light& light : rig.lights) {
        if (!light.enabled) continue;
        Rig one;
        one.lights = {light};
        one.lights[0].samples = 1;  // the only sample is the light's centre
        Placed placed{light, sampleLights(one).at(0), {}, {}};
        placed.whole.position -= origin;
        placed.whole.radius = 0;  // what is sampled are points, not pieces
        const RectAxes axes = rectAxes(light.direction);
        placed.x = axes.x * (light.type == LightType::rect ? 0.5 * light.size.x : light.radius);
        placed.y = axes.y * (light.type == LightType::rect ? 0.5 * light.size.y : light.radius);
        lights_.push_back(placed);
    }
}

LightPoint LightSampler::pointOf(const Placed& placed, const glm::dvec3& offset, const glm::dvec3& p) const {
    LightSample sample = placed.whole;
    LightPoint point;
    point.shadow = sample.shadow;
    if (sample.directional) {
        point.direction = -sample.direction;
        point.distance = std::numeric_limits<double>::infinity();
        point.irradiance = sample.intensity;
        return point;
    }
    sample.position += offset;
    const glm::dvec3 towards = sample.position - p;
    point.distance = glm::length(towards);
    if (!(point.distance > 0)) return point;
    point.direction = towards / point.distance;
    point.irradiance = irradianceFrom(sample, p, point.direction);
    if (placed.light.type == LightType::rect) {
        const double cosine = -glm::dot(sample.direction, point.direction);
        const double area = placed.light.size.x * placed.light.size.y;
        if (cosine > 0) point.pdf = point.distance * point.distance / (area * cosine);
    }
    return point;
}

LightPoint LightSampler::sample(std::size_t i, const glm::dvec3& p, const RandomNumbers& random,
                                std::uint32_t purpose) const {
    const Placed& placed = lights_[i];
    glm::dvec3 offset(0);
    if (placed.light.type == LightType::rect) {
        const glm::dvec2 u = random.pair(purpose) * 2.0 - 1.0;
        offset = placed.x * u.x + placed.y * u.y;
    } else if (placed.light.type == LightType::spot && placed.light.radius > 0) {
        const glm::dvec2 u = random.pair(purpose);
        const double r = std::sqrt(u.x), phi = 2 * kPi * u.y;
        offset = placed.x * (r * std::cos(phi)) + placed.y * (r * std::sin(phi));
    } else if (placed.light.type == LightType::point && placed.light.radius > 0) {
        offset = placed.light.radius * pointInBall(random.pair(purpose), random.pair(purpose + 1).x);
    }
    return pointOf(placed, offset, p);
}

std::optional<LightPoint> LightSampler::find(std::size_t i, const glm::dvec3& p,
                                             const glm::dvec3& direction) const {
    const Placed& placed = lights_[i];
    if (placed.light.type != LightType::rect) return {};
    const double facing = -glm::dot(placed.whole.direction, direction);
    if (!(facing > 0)) return {};
    const double t = glm::dot(placed.whole.direction, p - placed.whole.position) / facing;
    if (!(t > 0)) return {};
    const glm::dvec3 offset = p + direction * t - placed.whole.position;
    if (std::abs(glm::dot(offset, placed.x)) > glm::dot(placed.x, placed.x) ||
        std::abs(glm::dot(offset, placed.y)) > glm::dot(placed.y, placed.y)) {
        return {};
    }
    return pointOf(placed, offset, p);
}

}  // namespace cutis::reference
