#include "renderer/passes/environment_sources.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "renderer/core/parallel.h"
#include "renderer/scene/environment_cells.h"
#include "renderer/scene/environment_clusters.h"
#include "renderer/scene/environment_samples.h"

namespace cutis {
namespace {

constexpr std::size_t kMaxPeaks = 256;
constexpr double kPeakOverMean = 8;
constexpr int kMaxSources = 32;
constexpr double kNearby = 0.03;             // radians: sources this near share a terminator
constexpr double kCoarseTolerance = 0.0015;  // of the mean irradiance: error that faint sources may leave,
constexpr double kFineTolerance = 0.006;     // and bright ones

double sum(const glm::vec3& v) {
    return double(v.x) + v.y + v.z;
}

// Error of interpolation across the terminator of that much flux, over the mean irradiance; a face has 2/size
// per texel at its centre.
double terminatorError(double flux, double mean, std::uint32_t size) {
    return flux * (2.0 / size) / 4 / mean;
}

}  // namespace

EnvironmentSources environmentSources(const Environment& environment) {
    EnvironmentSources result;
    double total = 0;
    for (const EnvironmentCluster& cluster : clusterEnvironment(environment)) {
        result.sources.push_back({glm::vec3(cluster.flux), glm::vec3(cluster.centroid)});
        total += sum(result.sources.back().flux);
    }
    const double mean = total / 4;  // the mean of max(cosθ, 0) over the sphere is 1/4
    const float near = float(std::cos(kNearby));
    std::vector<double> nearby(result.sources.size(), 0);  // flux around each source
    parallelFor(nearby.size(), [&](std::size_t i) {
        for (const shared::EnvironmentSource& other : result.sources)
            if (glm::dot(result.sources[i].mean, other.mean) > near) nearby[i] += sum(other.flux);
    });
    std::vector<shared::EnvironmentSource> faint, bright;
    for (std::size_t i = 0; i < nearby.size(); ++i)
        (terminatorError(nearby[i], mean, kCoarseFace) <= kCoarseTolerance ? faint : bright)
            .push_back(result.sources[i]);
    result.faint = std::uint32_t(faint.size());
    result.sources = std::move(faint);
    result.sources.insert(result.sources.end(), bright.begin(), bright.end());

    const double largest = nearby.empty() ? 0 : *std::max_element(nearby.begin(), nearby.end());
    result.face = 256;
    for (const std::uint32_t size : {128u, 64u})
        if (terminatorError(largest, mean, size) <= kFineTolerance) result.face = size;
    return result;
}

EnvironmentPeaks separatePeaks(const Environment& environment) {
    const EnvironmentCells grid = sumEnvironment(
        environment, [&](std::size_t texel) { return glm::dvec3(environment.radiance[texel]); });
    const auto radiance = [](const FluxSums& cell) { return cell.weight() / cell.solidAngle; };
    std::vector<double> values;
    double flux = 0;
    for (const FluxSums& cell : grid.cells) {
        values.push_back(radiance(cell));
        flux += cell.weight();
    }
    const std::size_t rank = std::min(kMaxPeaks, values.size() - 1);
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(rank), values.end(), std::greater<>());
    const double threshold = std::max(values[rank], kPeakOverMean * flux / (4 * std::numbers::pi));

    EnvironmentPeaks result{grid.width, grid.height, {}, {}};
    for (const FluxSums& cell : grid.cells) {
        const double value = radiance(cell), kept = value > threshold ? threshold / value : 1;
        result.rest.emplace_back(glm::vec3(cell.flux * (kept / cell.solidAngle)), 1.0f);
        if (kept < 1)
            result.peaks.push_back(
                {glm::vec3(cell.flux * (1 - kept)), glm::vec3(glm::normalize(cell.moment))});
    }
    return result;
}

EnvironmentParts separateSources(const Environment& environment, double maxSpread) {
    EnvironmentSplit split = splitEnvironment(environment, kMaxSources, 0, 1, maxSpread);
    EnvironmentParts parts{{}, std::move(split.residual)};
    for (const LightSample& sample : split.samples) {
        const double variance = sample.radius * sample.radius / 2;  // of the angle, rad²
        parts.sources.push_back(
            {glm::vec3(sample.intensity), glm::vec3(-sample.direction * (1 - variance / 2))});
    }
    return parts;
}

}  // namespace cutis
