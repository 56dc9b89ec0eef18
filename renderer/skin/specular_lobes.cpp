#include "renderer/skin/specular_lobes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>

#include "renderer/core/files.h"
#include "renderer/skin/specular.h"
#include "shaders/shared/environment.h"

namespace cutis::skin {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSamples = 768;
constexpr int kFirstIterations = 150, kIterations = 40;
constexpr std::uint64_t kCacheVersion = 2;  // grows with every change of the fit

struct WeightedDirection {
    glm::dvec3 direction;
    double weight;
};

glm::dvec3 mirrored(const glm::dvec3& d) {
    return {d.x, -d.y, d.z};
}

// Reflected directions on one side of the plane of incidence, in the frame of the mirror direction, with the
// weights of the estimator of directionalAlbedo (specular.cpp); weights sum to 1.
std::vector<WeightedDirection> drawReflections(double mu, double m) {
    const double sigma = std::sqrt((1 - mu) * (1 + mu));
    const glm::dvec3 v(sigma, 0, mu);
    std::vector<WeightedDirection> drawn;
    double total = 0;
    for (int k = 0; k < kSamples; ++k) {
        const double u = (k + 0.5) / kSamples, phi = kPi * std::fmod(k * std::numbers::phi, 1.0);
        const double r = m * std::sqrt(-std::log(u)), cosine = 1 / std::sqrt(1 + r * r), sine = r * cosine;
        const glm::dvec3 h(sine * std::cos(phi), sine * std::sin(phi), cosine);
        const double vh = glm::dot(v, h);
        const double weight = vh > 0 ? (2 - mu / (vh * cosine)) * schlick(vh) : 0;
        if (weight <= 0) continue;
        const glm::dvec3 l = 2 * vh * h - v;
        drawn.push_back({{l.x * mu + l.z * sigma, l.y, l.z * mu - l.x * sigma}, weight});
        total += weight;
    }
    for (WeightedDirection& d : drawn) d.weight /= total;
    return drawn;
}

// exp(scale + sharpness (cosθ - 1)), with σ = sharpness^(-1/2), times `share` over its integral 2πσ²(1 -
// exp(-2/σ²)).
struct Gaussian {
    double scale, sharpness;

    Gaussian(double variance, double share)
        : scale(std::log(std::max(share, 1e-300) / (2 * kPi * variance * -std::expm1(-2 / variance)))),
          sharpness(1 / variance) {}
    double operator()(double cosine) const { return std::exp(scale + sharpness * (cosine - 1)); }
};

double prefilteredVariance(std::uint32_t lobe) {
    const double spread =
        lobe == 0 ? shared::ENVIRONMENT_SPREAD_0 : shared::ENVIRONMENT_SPREAD * std::exp2(0.5 * lobe);
    return spread * spread;
}

// A lobe as shaders see it: the two prefiltered ones of which it is between, mixed by variance.
struct LookedUpLobe {
    Gaussian narrow, wide;

    double operator()(double cosine) const { return narrow(cosine) + wide(cosine); }
};

LookedUpLobe lookedUp(const SpecularLobe& lobe, double m) {
    const double variance = lobe.sigma * lobe.sigma, share = lobe.paired ? lobe.weight / 2 : lobe.weight;
    std::uint32_t below = shared::environmentFirstLobe(shared::environmentSet(float(m)));
    while (below + 2 < shared::ENVIRONMENT_LOBES && prefilteredVariance(below + 1) < variance) ++below;
    const double a = prefilteredVariance(below), b = prefilteredVariance(below + 1);
    const double f = std::clamp((variance - a) / (b - a), 0.0, 1.0);
    return {Gaussian(a, share * (1 - f)), Gaussian(b, share * f)};
}

// One step: every sample is shared out among the lobes by what they contribute there; each lobe then takes
// the mean direction, spread and weight of its share. The length of the mean of unit vectors is coth(1/σ²) -
// σ² ≈ 1 - σ².
void improveLobes(std::vector<SpecularLobe>& lobes, const std::vector<WeightedDirection>& samples, double m) {
    const std::size_t n = lobes.size();
    std::vector<LookedUpLobe> density;
    std::vector<double> part(2 * n), weight(n, 0);
    std::vector<glm::dvec3> moment(n, glm::dvec3(0));
    for (const SpecularLobe& lobe : lobes) density.push_back(lookedUp(lobe, m));
    for (const WeightedDirection& sample : samples) {
        double total = 0;
        for (std::size_t k = 0; k < n; ++k) {
            const SpecularLobe& lobe = lobes[k];
            part[2 * k] = density[k](glm::dot(sample.direction, lobe.direction));
            part[2 * k + 1] =
                lobe.paired ? density[k](glm::dot(sample.direction, mirrored(lobe.direction))) : 0;
            total += part[2 * k] + part[2 * k + 1];
        }
        if (!(total > 0)) continue;
        for (std::size_t k = 0; k < n; ++k) {
            const double here = part[2 * k] / total * sample.weight,
                         there = part[2 * k + 1] / total * sample.weight;
            weight[k] += here + there;
            moment[k] += here * sample.direction + there * mirrored(sample.direction);
        }
    }
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) {
        SpecularLobe& lobe = lobes[k];
        lobe.weight = weight[k];
        sum += weight[k];
        if (!lobe.paired) moment[k].y = 0;  // the other half of the samples cancels it
        const double length = glm::length(moment[k]);
        if (!(weight[k] > 1e-9) || !(length > 0)) continue;
        lobe.direction = moment[k] / length;
        lobe.sigma = std::sqrt(std::max(1 - length / weight[k], 1e-8));
    }
    for (SpecularLobe& lobe : lobes) lobe.weight /= sum;
}

// Spread over the lobe at normal incidence, whose directions are about m√2 apart from the normal.
std::vector<SpecularLobe> startingLobes(double m) {
    std::vector<SpecularLobe> lobes;
    const double share = 1.0 / (LOBES_IN_PLANE + 2 * LOBE_PAIRS);
    for (int k = 0; k < LOBES_IN_PLANE; ++k) {
        const double x = 1.5 * m * (2.0 * k / (LOBES_IN_PLANE - 1) - 1);
        lobes.push_back({glm::normalize(glm::dvec3(x, 0, 1)), 0.8 * m, share, false});
    }
    for (int k = 0; k < LOBE_PAIRS; ++k) {
        const double angle = kPi * (k + 0.5) / LOBE_PAIRS, r = 1.4 * m;
        const glm::dvec3 direction(r * std::cos(angle), r * std::sin(angle), 1);
        lobes.push_back({glm::normalize(direction), 0.8 * m, 2 * share, true});
    }
    return lobes;
}

}  // namespace

std::vector<std::vector<SpecularLobe>> fitSpecularLobes(double m) {
    m = std::clamp(m, kMinRoughness, 1.0);
    std::vector<std::vector<SpecularLobe>> rows(LOBE_ROWS);
    std::vector<SpecularLobe> lobes = startingLobes(m);
    for (int j = LOBE_ROWS - 1; j >= 0; --j) {
        const double t = double(j) / (LOBE_ROWS - 1);
        const std::vector<WeightedDirection> samples = drawReflections(std::max(t * t, 1e-3), m);
        const int iterations = j == LOBE_ROWS - 1 ? kFirstIterations : kIterations;
        for (int i = 0; i < iterations; ++i) improveLobes(lobes, samples, m);
        rows[j] = lobes;
    }
    return rows;
}

std::vector<float> specularLobeTable(double m) {
    std::vector<float> table(LOBE_ROWS * LOBE_ROW_SIZE);
    const std::uint64_t key = hashBytes(std::as_bytes(std::span(&m, 1)), kCacheVersion);
    const std::vector<std::byte> cached = readCache("specular-lobes", key);
    if (cached.size() == table.size() * sizeof(float)) {
        std::memcpy(table.data(), cached.data(), cached.size());
        return table;
    }
    std::size_t at = 0;
    for (const std::vector<SpecularLobe>& row : fitSpecularLobes(m))
        for (const SpecularLobe& lobe : row) {
            for (int axis = 0; axis < 3; ++axis) table[at++] = float(lobe.direction[axis]);
            table[at++] = float(lobe.sigma);
            table[at++] = float(lobe.weight);
        }
    writeCache("specular-lobes", key, std::as_bytes(std::span(table)));
    return table;
}

}  // namespace cutis::skin
