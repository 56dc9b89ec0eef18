#include "renderer/scene/environment_sun.h"

#include <algorithm>
#include <utility>

#include "renderer/scene/environment_clusters.h"
#include "renderer/scene/environment_samples.h"

namespace cutis {

namespace {

double sumOf(const glm::dvec3& rgb) {
    return rgb.x + rgb.y + rgb.z;
}

// The sun and the rest; none where what stands out gives too little to be one.
std::optional<EnvironmentSplit> splitSun(const Environment& environment) {
    EnvironmentSplit split = splitEnvironment(environment, 1, 0, 1);
    if (split.samples.empty()) return std::nullopt;
    double whole = 0;
    for (const EnvironmentCluster& cluster : clusterEnvironment(environment, 1)) whole += sumOf(cluster.flux);
    if (sumOf(split.samples[0].intensity) < kLeastSunShare * whole) return std::nullopt;
    return split;
}

}  // namespace

std::optional<EnvironmentSun> findSun(const Environment& environment) {
    const std::optional<EnvironmentSplit> split = splitSun(environment);
    if (!split) return std::nullopt;
    const LightSample& sample = split->samples[0];
    return EnvironmentSun{-sample.direction, sample.intensity, sample.radius};
}

void removeSun(Environment& environment) {
    if (std::optional<EnvironmentSplit> split = splitSun(environment))
        environment.radiance = std::move(split->residual.radiance);
}

Light sunLight(const EnvironmentSun& sun, const EnvironmentSettings& settings) {
    Light light;
    light.name = "sun";
    light.type = LightType::directional;
    light.direction = -rotateAboutY(sun.towards, settings.rotation);
    const double largest = std::max({sun.irradiance.x, sun.irradiance.y, sun.irradiance.z});
    if (largest > 0) light.color = sun.irradiance / largest;
    light.intensity = largest * settings.intensity;
    return light;
}

}  // namespace cutis
