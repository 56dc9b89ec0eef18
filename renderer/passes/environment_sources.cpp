#include "renderer/passes/environment_sources.h"

#include <algorithm>
#include <functional>
#include <numbers>

#include "renderer/scene/environment_cells.h"
#include "renderer/scene/environment_clusters.h"

namespace cutis {
namespace {

constexpr std::size_t kMaxPeaks = 512;
constexpr double kPeakOverMean = 8;
constexpr double kTerminatorTolerance = 0.004;

double sum(const glm::vec3& v) {
    return double(v.x) + v.y + v.z;
}

// Largest flux (R+G+B) within a few texels of any bright source: what one terminator carries.
double brightestNeighbourhood(std::span<const shared::EnvironmentSource> sources) {
    constexpr std::size_t kCandidates = 64;
    constexpr float kNear = 0.9998f;  // cos 0.02
    std::vector<const shared::EnvironmentSource*> brightest;
    for (const auto& source : sources) brightest.push_back(&source);
    const std::size_t count = std::min(kCandidates, brightest.size());
    std::partial_sort(brightest.begin(), brightest.begin() + std::ptrdiff_t(count), brightest.end(),
                      [](auto* a, auto* b) { return sum(a->flux) > sum(b->flux); });
    double largest = 0;
    for (std::size_t i = 0; i < count; ++i) {
        double flux = 0;
        for (const auto& other : sources)
            if (glm::dot(brightest[i]->mean, other.mean) > kNear) flux += sum(other.flux);
        largest = std::max(largest, flux);
    }
    return largest;
}

}  // namespace

std::vector<shared::EnvironmentSource> environmentSources(const Environment& environment) {
    std::vector<shared::EnvironmentSource> sources;
    for (const EnvironmentCluster& cluster : clusterEnvironment(environment))
        sources.push_back({glm::vec3(cluster.flux), glm::vec3(cluster.centroid)});
    return sources;
}

std::uint32_t irradianceFaceSize(std::span<const shared::EnvironmentSource> sources) {
    double total = 0;
    for (const auto& source : sources) total += sum(source.flux);
    const double mean = total / 4;  // the mean of max(cosθ, 0) over the sphere is 1/4
    const double largest = brightestNeighbourhood(sources);
    for (const std::uint32_t size : {64u, 128u})
        if (largest * (2.0 / size) / 4 <= kTerminatorTolerance * mean) return size;
    return 256;
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

}  // namespace cutis
