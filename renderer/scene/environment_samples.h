// The brightest parts of an environment as light samples, which cast shadows and shine through skin.
#pragma once

#include <vector>

#include "renderer/scene/light.h"

namespace cutis {

struct EnvironmentSplit {
    std::vector<LightSample>
        samples;           // directional; `light` is -1 - k; `radius` the angular radius in radians
    Environment residual;  // what remains, not rotated, intensity not applied
};

// Largest rms radius, in radians, of the patches of environment that samples stand for: a wider source would
// show as separate hard shadows.
inline constexpr double kMaxSampleSpread = 0.2;

// At most n samples of `environment`, rotated by `rotationDegrees` about +Y and multiplied by `intensity`.
// Radiance above a threshold, keeping its colour, leaves the environment and is clustered into samples; the
// threshold is the lowest at which the region brighter than it falls into n compact patches
// (kMaxSampleSpread). So a sun is one sample with all of its flux, and more samples take more of the sky: all
// of it from about 50 on. Samples and residual together hold exactly the light of the environment, and the
// residual is nowhere negative. n ≤ 0: no samples, and the environment as it is; there are none either where
// no part stands out.
EnvironmentSplit splitEnvironment(const Environment& environment, int n, double rotationDegrees,
                                  double intensity, double maxSpread = kMaxSampleSpread);

}  // namespace cutis
