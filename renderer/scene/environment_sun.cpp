#include "renderer/scene/environment_sun.h"

#include <algorithm>

#include "renderer/scene/environment_clusters.h"
#include "renderer/scene/environment_samples.h"

namespace cutis {

std::optional<EnvironmentSun> findSun(const Environment& environment) {
    const EnvironmentSplit split = splitEnvironment(environment, 1, 0, 1);
    if (split.samples.empty()) return std::nullopt;
    const LightSample& sample = split.samples[0];
    return EnvironmentSun{-sample.direction, sample.intensity, sample.radius};
}

void removeSun(Environment& environment) {
    environment.radiance = splitEnvironment(environment, 1, 0, 1).residual.radiance;
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
