#include "renderer/skin/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/core/error.h"

namespace cutis::skin {
namespace {

double sum(const glm::dvec3& v) {
    return v.x + v.y + v.z;
}

// Gaussians [first, last) as one.
Gaussian merged(const Profile& profile, std::size_t first, std::size_t last) {
    Gaussian result{0, glm::dvec3(0)};
    double plain = 0;
    for (std::size_t i = first; i < last; ++i) {
        const Gaussian& g = profile.gaussians[i];
        result.weight += g.weight;
        result.variance += sum(g.weight) * g.variance;
        plain += g.variance;
    }
    const double total = sum(result.weight);
    result.variance = total > 0 ? result.variance / total : plain / double(last - first);
    return result;
}

// ∫ |edge response of Gaussians [first, last) - that of their merger|² dx, summed over the channels, in mm.
// A difference of edge responses is Σ c_i Φ(x/σ_i) with Σ c_i = 0, and ∫ (Σ c_i Φ_i)² dx = -½ Σ_ij c_i c_j
// E|X_i - X_j| with independent X_i ~ N(0, v_i), where E|X_i - X_j| = √(2(v_i + v_j)/π).
double mergeError(const Profile& profile, std::size_t first, std::size_t last) {
    std::vector<Gaussian> terms(profile.gaussians.begin() + first, profile.gaussians.begin() + last);
    terms.push_back(merged(profile, first, last));
    terms.back().weight *= -1.0;
    double error = 0;
    for (const Gaussian& a : terms)
        for (const Gaussian& b : terms)
            error -= 0.5 * glm::dot(a.weight, b.weight) *
                     std::sqrt(2 * (a.variance + b.variance) / std::numbers::pi);
    return std::max(error, 0.0);
}

}  // namespace

Profile threeLayerProfile() {
    return {{{0.0064, {0.233, 0.455, 0.649}},
             {0.0484, {0.100, 0.336, 0.344}},
             {0.187, {0.118, 0.198, 0}},
             {0.567, {0.113, 0.007, 0.007}},
             {1.99, {0.358, 0.004, 0}},
             {7.41, {0.078, 0, 0}}}};
}

void validate(const Profile& profile, const std::string& where) {
    const auto refuse = [&](const std::string& why) { throw Error("skin profile", why, where); };
    if (profile.gaussians.empty()) refuse("it has no Gaussians");
    if (profile.gaussians.size() > kMaxGaussians)
        refuse("it has more than " + std::to_string(kMaxGaussians) + " Gaussians");
    double total = 0;
    for (const Gaussian& g : profile.gaussians) {
        if (!(g.variance > 0) || !std::isfinite(g.variance))
            refuse("a variance is not a positive finite number");
        for (int c = 0; c < 3; ++c)
            if (!(g.weight[c] >= 0) || !std::isfinite(g.weight[c]))
                refuse("a weight is not a finite number of at least 0");
        total += sum(g.weight);
    }
    if (!(total > 0)) refuse("all its weights are 0");
}

Profile sorted(const Profile& profile) {
    Profile result = profile;
    std::stable_sort(result.gaussians.begin(), result.gaussians.end(),
                     [](const Gaussian& a, const Gaussian& b) { return a.variance < b.variance; });
    std::vector<Gaussian> unique;
    for (const Gaussian& g : result.gaussians)
        if (!unique.empty() && unique.back().variance == g.variance)
            unique.back().weight += g.weight;
        else
            unique.push_back(g);
    return {unique};
}

Profile scaled(const Profile& profile, double scale) {
    Profile result = profile;
    for (Gaussian& g : result.gaussians) g.variance *= scale * scale;
    return result;
}

Profile reduced(const Profile& profile, int k) {
    const std::size_t n = profile.gaussians.size(), runs = std::size_t(std::max(k, 1));
    if (runs >= n) return profile;
    // best[r][i]: least error of the first i Gaussians as r runs; cut[r][i]: where the last of these runs
    // begins.
    const double infinity = std::numeric_limits<double>::infinity();
    std::vector best(runs + 1, std::vector<double>(n + 1, infinity));
    std::vector cut(runs + 1, std::vector<std::size_t>(n + 1, 0));
    best[0][0] = 0;
    for (std::size_t r = 1; r <= runs; ++r)
        for (std::size_t i = r; i <= n; ++i)
            for (std::size_t first = r - 1; first < i; ++first) {
                const double error = best[r - 1][first] + mergeError(profile, first, i);
                if (error < best[r][i]) best[r][i] = error, cut[r][i] = first;
            }
    Profile result;
    for (std::size_t r = runs, last = n; r > 0; last = cut[r--][last])
        result.gaussians.push_back(merged(profile, cut[r][last], last));
    std::reverse(result.gaussians.begin(), result.gaussians.end());
    return result;
}

glm::dvec3 evaluate(const Profile& profile, double r) {
    glm::dvec3 result(0);
    for (const Gaussian& g : profile.gaussians)
        result += g.weight * (std::exp(-r * r / (2 * g.variance)) / (2 * std::numbers::pi * g.variance));
    return result;
}

glm::dvec3 totalWeight(const Profile& profile) {
    glm::dvec3 result(0);
    for (const Gaussian& g : profile.gaussians) result += g.weight;
    return result;
}

glm::dvec3 secondMoment(const Profile& profile) {
    glm::dvec3 result(0);
    for (const Gaussian& g : profile.gaussians) result += g.weight * g.variance;
    return result;
}

glm::dvec3 edgeResponse(const Profile& profile, double x) {
    glm::dvec3 result(0);
    for (const Gaussian& g : profile.gaussians)
        result += g.weight * (0.5 * std::erfc(-x / std::sqrt(2 * g.variance)));
    return result;
}

glm::dvec3 slabTransmission(const Profile& profile, double t) {
    glm::dvec3 result(0);
    for (const Gaussian& g : profile.gaussians) result += g.weight * std::exp(-t * t / (2 * g.variance));
    return result;
}

}  // namespace cutis::skin
