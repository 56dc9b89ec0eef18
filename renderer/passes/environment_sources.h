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

// All light of an environment in clusters (renderer/scene/environment_clusters.h). Interpolating max(cosθ, 0)
// between normals h apart is wrong by up to h/4 at the terminator, so sources that are bright together need a
// finer map of irradiance than the others.
struct EnvironmentSources {
    std::vector<shared::EnvironmentSource> sources;  // faint ones first
    std::uint32_t faint = 0;  // so many of them: a face of kCoarseFace texels is enough
    std::uint32_t face = 0;   // texels along a face that are enough for the bright ones
};
inline constexpr std::uint32_t kCoarseFace = 32;
EnvironmentSources environmentSources(const Environment& environment);

// An environment of at most 1024×512 texels as two parts that add up to it.
struct EnvironmentPeaks {
    int width = 0, height = 0;
    std::vector<glm::vec4> rest;  // lat-long radiance without peaks
    std::vector<shared::EnvironmentSource>
        peaks;  // the light taken out of the brightest texels, each a source
};

// Peaks are what exceeds the 256th brightest texel, or 8 times the mean where that is more.
EnvironmentPeaks separatePeaks(const Environment& environment);

// An environment as compact sources, at most 32, brighter than what is around them, and all else. Together
// they are the environment.
struct EnvironmentParts {
    std::vector<shared::EnvironmentSource> sources;
    Environment rest;
};
EnvironmentParts separateSources(const Environment& environment, double maxSpread);

// Largest rms radius in radians of the sources that surfaces of medium roughness, and rough ones, reflect
// apart (shaders/shared/environment.h). A source is reflected as if it were round and Gaussian, which shows
// once it is as wide as the surface's own lobe: at grazing views that is a fraction of m.
inline constexpr double kMediumSourceSpread = 0.012, kRoughSourceSpread = 0.05;

}  // namespace cutis
