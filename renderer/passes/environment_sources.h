// What the shaders of environment.h are given: an environment as sources of light, and as an image without
// its peaks.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/scene/light.h"
#include "shaders/shared/environment.h"

namespace cutis {

// All light of the environment as clusters (renderer/scene/environment_clusters.h).
std::vector<shared::EnvironmentSource> environmentSources(const Environment& environment);

// Texels along a face of the irradiance cube: the fewest of 64, 128 and 256 that keep interpolation across
// the terminator of the brightest source within 0.4 % of the mean irradiance. Interpolating max(cosθ, 0) in
// steps of h is wrong by up to h/4.
std::uint32_t irradianceFaceSize(std::span<const shared::EnvironmentSource> sources);

// An environment of at most 1024×512 texels as two parts that add up to it.
struct EnvironmentPeaks {
    int width = 0, height = 0;
    std::vector<glm::vec4> rest;  // lat-long radiance without peaks
    std::vector<shared::EnvironmentSource>
        peaks;  // the light taken out of the brightest texels, each a source
};

// Peaks are what exceeds the 512th brightest texel, or 8 times the mean where that is more.
EnvironmentPeaks separatePeaks(const Environment& environment);

}  // namespace cutis
