#include "renderer/reference/lighting.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/reference/directions.h"
#include "renderer/reference/metallic_roughness.h"
#include "renderer/skin/specular.h"

namespace cutis::reference {
namespace {

// Purposes of random pairs; lights take two each from kFirstLight on.
enum Purpose : std::uint32_t { kStrategy, kCell, kPlace, kLobe, kEnvironmentAgain, kFirstLight };

// Of a scene of many lights, each point asks about as many as matter to it: a light is asked with a
// probability of this often its share of the unoccluded light, and counts for the rest of the times.
constexpr double kLightsAsked = 16;

bool above(const SurfacePoint& point, const glm::dvec3& n, const glm::dvec3& direction) {
    return glm::dot(n, direction) > 0 && glm::dot(point.smooth, direction) > 0;
}

double brightest(const glm::dvec3& c) {
    return std::max({c.r, c.g, c.b});
}

}  // namespace

glm::dvec3 Lobe::sample(const glm::dvec3& n, const glm::dvec2& u) const {
    const double tan2 = ggx ? width * width * u.x / (1 - u.x) : -width * width * std::log(1 - u.x);
    const double cosine = 1 / std::sqrt(1 + tan2), sine = std::sqrt(tan2) * cosine, phi = 2 * kPi * u.y;
    const glm::dvec3 h = Frame(n).toWorld({sine * std::cos(phi), sine * std::sin(phi), cosine});
    return 2 * glm::dot(view, h) * h - view;
}

double Lobe::pdf(const glm::dvec3& n, const glm::dvec3& direction) const {
    const glm::dvec3 sum = direction + view;
    const double length = glm::length(sum);
    if (!(length > 0)) return 0;
    const double cosine = std::min(glm::dot(n, sum) / length, 1.0);
    // |h|/2 is V·H of the unit half-vector: dω = 4 (V·H) dω_H.
    return (ggx ? ggxDistribution(cosine, width) : skin::beckmann(cosine, width)) * std::max(cosine, 0.0) /
           (2 * length);
}

glm::dvec3 Lighting::visibility(const SurfacePoint& point, const LightPoint& light) const {
    if (!light.shadow) return glm::dvec3(1);
    if (std::isinf(light.distance)) {
        return rays_->transmittance(point.outside, light.direction, std::numeric_limits<double>::infinity());
    }
    return rays_->transmittance(point.outside, light.direction, light.distance);
}

void Lighting::gatherLights(const SurfacePoint& point, const glm::dvec3& n, const Lobe* lobe,
                            const RandomNumbers& random, std::vector<Incident>& incident) const {
    thread_local std::vector<LightPoint> points;
    points.clear();
    double total = 0;
    for (std::size_t i = 0; i < lights_.count(); ++i) {
        const auto purpose = static_cast<std::uint32_t>(kFirstLight + 2 * i);
        LightPoint light = lights_.sample(i, point.outside, random, purpose);
        if (above(point, n, light.direction)) {
            light.irradiance *= glm::dot(n, light.direction);
        } else {
            light.irradiance = glm::dvec3(0);
        }
        total += brightest(light.irradiance);
        points.push_back(light);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        LightPoint& light = points[i];
        const double share = brightest(light.irradiance);
        if (!(share > 0)) continue;
        if (lobe && light.pdf > 0)
            light.irradiance *= light.pdf / (light.pdf + lobe->pdf(n, light.direction));
        const double asked = std::min(1.0, kLightsAsked * share / total);
        // The second number of `depth` is no one else's.
        if (asked < 1 && random.pair(static_cast<std::uint32_t>(kFirstLight + 2 * i + 1)).y >= asked)
            continue;
        const glm::dvec3 visible = visibility(point, light);
        if (brightest(visible) > 0)
            incident.push_back({light.direction, light.irradiance * visible / asked, false});
    }
}

// A direction of the lobe that meets a rect light, with the same balance of densities as above.
void Lighting::gatherLobe(const SurfacePoint& point, const glm::dvec3& n, const Lobe& lobe,
                          const glm::dvec2& u, std::vector<Incident>& incident) const {
    const glm::dvec3 direction = lobe.sample(n, u);
    if (!above(point, n, direction)) return;
    const double cosine = glm::dot(n, direction), pdf = lobe.pdf(n, direction);
    for (std::size_t i = 0; i < lights_.count(); ++i) {
        const auto light = lights_.find(i, point.outside, direction);
        if (!light || !(light->pdf > 0)) continue;
        const glm::dvec3 visible = visibility(point, *light);
        if (!(brightest(visible) > 0)) continue;
        // Radiance is irradiance · pdf of the light's own sampling.
        incident.push_back(
            {direction, light->irradiance * visible * (light->pdf * cosine / (light->pdf + pdf)), false});
    }
}

void Lighting::gatherEnvironment(const SurfacePoint& point, const glm::dvec3& n, const Lobe* lobe,
                                 const RandomNumbers& random, std::vector<Incident>& incident) const {
    // One direction from a mixture of densities. The cosine's share keeps weights bounded wherever the others
    // are thin.
    const double lobeShare = lobe ? 0.5 : 0, cosineShare = 0.03, lightShare = 1 - lobeShare - cosineShare;
    const double strategy = random.pair(kStrategy).x;
    glm::dvec3 direction;
    if (strategy < lightShare) {
        direction = environment_.sample(n, random.pair(kCell), random.pair(kPlace));
    } else if (strategy < lightShare + cosineShare) {
        direction = Frame(n).toWorld(sampleCosine(random.pair(kPlace)));
    } else {
        direction = lobe->sample(n, random.pair(kPlace));
    }
    if (!above(point, n, direction)) return;
    const double cosine = glm::dot(n, direction);
    const EnvironmentSampler::Sky sky = environment_.lookUp(n, direction);
    const double pdf =
        lightShare * sky.pdf + cosineShare * cosine / kPi + (lobe ? lobeShare * lobe->pdf(n, direction) : 0);
    if (!(pdf > 0) || !(brightest(sky.radiance) > 0)) return;
    const glm::dvec3 visible =
        rays_->transmittance(point.outside, direction, std::numeric_limits<double>::infinity());
    if (brightest(visible) > 0)
        incident.push_back({direction, sky.radiance * visible * (cosine / pdf), true});
}

void Lighting::gather(const SurfacePoint& point, const glm::dvec3& n, const Lobe* lobe,
                      const RandomNumbers& random, std::vector<Incident>& incident) const {
    incident.clear();
    gatherLights(point, n, lobe, random, incident);
    if (lobe) gatherLobe(point, n, *lobe, random.pair(kLobe), incident);
    if (environment_.empty()) return;
    gatherEnvironment(point, n, lobe, random, incident);
    if (lobe) return;
    // What diffuses is worth a second direction of the sky: most of the noise is whether the one drawn is
    // open.
    gatherEnvironment(point, n, lobe, random.branch(kEnvironmentAgain), incident);
    for (Incident& from : incident) {
        if (from.environment) from.irradiance *= 0.5;
    }
}

}  // namespace cutis::reference
