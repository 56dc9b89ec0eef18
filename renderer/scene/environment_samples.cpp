#include "renderer/scene/environment_samples.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/environment_cells.h"

namespace cutis {
namespace {

// What stays of a texel when radiance above `threshold` (of the largest channel) leaves it.
glm::vec3 remainder(const glm::vec3& radiance, float threshold) {
    const float largest = std::max({radiance.x, radiance.y, radiance.z});
    if (largest <= threshold) return radiance;
    return glm::min(radiance * (threshold / largest), radiance);
}

// What leaves the environment, in n clusters.
std::vector<FluxSums> clusterExcess(const Environment& environment, float threshold, std::size_t n) {
    const EnvironmentCells grid = sumEnvironment(environment, [&](std::size_t texel) {
        const glm::vec3& radiance = environment.radiance[texel];
        return glm::dvec3(radiance) - glm::dvec3(remainder(radiance, threshold));
    });
    return clusterCells(grid, n);
}

// Whether the region brighter than the threshold falls into n compact pieces. By area, not by light: the
// light of a sun would hide how much of the sky comes with it.
bool isCompact(const Environment& environment, float threshold, std::size_t n, double maxSpread) {
    const EnvironmentCells grid = sumEnvironment(environment, [&](std::size_t texel) {
        const glm::vec3& radiance = environment.radiance[texel];
        return glm::dvec3(std::max({radiance.x, radiance.y, radiance.z}) > threshold);
    });
    double sum = 0, area = 0;
    for (const FluxSums& piece : clusterCells(grid, n)) {
        sum += piece.weight() * piece.spread() * piece.spread();
        area += piece.weight();
    }
    return sum <= area * maxSpread * maxSpread;
}

// Up where all of it cancels: a faint ring around a compact source.
glm::dvec3 meanDirection(const FluxSums& cluster) {
    const double length = glm::length(cluster.moment);
    return length > 0 ? cluster.moment / length : glm::dvec3(0, 1, 0);
}

}  // namespace

EnvironmentSplit splitEnvironment(const Environment& environment, int n, double rotationDegrees,
                                  double intensity, double maxSpread) {
    EnvironmentSplit split{{}, environment};
    float largest = 0;
    for (const glm::vec3& radiance : environment.radiance)
        largest = std::max({largest, radiance.x, radiance.y, radiance.z});
    if (n <= 0 || !(largest > 0)) return split;

    // The region grows as the threshold falls: bisection of its logarithm over six decades, after trying to
    // take all.
    float threshold = 0;
    if (!isCompact(environment, 0, std::size_t(n), maxSpread)) {
        float low = largest * 1e-6f;
        threshold = largest;
        for (int step = 0; step < 12; ++step) {
            const float middle = std::sqrt(low * threshold);
            (isCompact(environment, middle, std::size_t(n), maxSpread) ? threshold : low) = middle;
        }
    }
    for (const FluxSums& cluster : clusterExcess(environment, threshold, std::size_t(n))) {
        LightSample sample;
        sample.light = -1 - int(split.samples.size());
        sample.directional = true;
        sample.direction = -rotateAboutY(meanDirection(cluster), rotationDegrees);
        sample.intensity = cluster.flux * intensity;
        sample.radius = std::sqrt(2.0) * cluster.spread();  // a disc's rms radius is its radius over √2
        split.samples.push_back(sample);
    }
    for (glm::vec3& radiance : split.residual.radiance) radiance = remainder(radiance, threshold);
    return split;
}

}  // namespace cutis
