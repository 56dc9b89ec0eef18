#include "renderer/reference/skin_model.h"

#include <algorithm>
#include <cmath>

#include "renderer/skin/energy.h"
#include "renderer/skin/profile.h"
#include "renderer/skin/specular.h"

namespace cutis::reference {
namespace {

// Entries of the table of ρ_dt: linear interpolation is then exact to about 1e-6.
constexpr int kAlbedoEntries = 8 * skin::kAlbedoRowSize;
// Widest Gaussian's standard deviations at which the profile ends: it holds all but exp(-24.5) of the light.
constexpr double kReach = 7;

// pow(0, 0) is 1: black skin with mix 0 lets everything in.
glm::dvec3 power(const glm::dvec3& albedo, double exponent) {
    if (exponent <= 0) return glm::dvec3(1);
    if (exponent == 0.5) return glm::sqrt(albedo);
    return glm::pow(albedo, glm::dvec3(exponent));
}

// Added to the probability of the widest Gaussian: light that has come through something thin is in its tail.
constexpr double kWidestShare = 0.12;
constexpr int kOffsets = 256;  // brackets of the sampled offset

// Σ_k p_k exp(-q / 2v_k): the share of offsets that are longer than √q.
double beyond(const std::vector<SkinModel::Term>& terms, double q) {
    double sum = 0;
    for (const SkinModel::Term& term : terms) sum += term.probability * std::exp(-0.5 * q / term.variance);
    return sum;
}

}  // namespace

SkinModel::SkinModel(const SkinMaterial& material, int gaussians)
    : material_(material),
      roughness_(std::max(material.roughness, skin::kMinRoughness)),
      narrower_(std::max(material.roughness * material.lobeRatio, skin::kMinRoughness)) {
    albedo_ = skin::mixedAlbedoRow(roughness_, narrower_, material.lobeWeight, kAlbedoEntries);
    meanAlbedo_ = skin::meanAlbedo(albedo_, material.specular);
    skin::Profile profile = skin::scaled(skin::sorted(material.profile), material.scale);
    if (gaussians > 0) profile = skin::reduced(profile, gaussians);
    double total = 0;
    for (const skin::Gaussian& g : profile.gaussians) {
        // Of all ways to choose among Gaussians, that in proportion to the root of Σ_rgb w² has the least
        // variance where they do not overlap.
        const double share = std::sqrt(glm::dot(g.weight, g.weight));
        if (!(share > 0)) continue;
        const double unit = material.mmPerUnit * material.mmPerUnit;
        terms_.push_back({g.variance / unit, g.weight, share});
        reach_ = std::max(reach_, kReach * std::sqrt(g.variance / unit));
        total += share;
    }
    for (Term& term : terms_) term.probability *= (1 - kWidestShare) / total;
    if (!terms_.empty()) terms_.back().probability += kWidestShare;

    // Squared offsets at u = i/kOffsets, each bisected to the last digit; the last bracket ends at the reach.
    for (int i = 0; i < kOffsets; ++i) {
        double low = 0, high = reach_ * reach_;
        for (int step = 0; step < 100; ++step) {
            const double middle = 0.5 * (low + high);
            (beyond(terms_, middle) > 1 - double(i) / kOffsets ? low : high) = middle;
        }
        offsets_.push_back(i == 0 ? 0 : low);
    }
    offsets_.push_back(reach_ * reach_);
}

double SkinModel::offsetAt(double u) const {
    // Newton on Σ p exp(-q/2v) = 1 - u, which is convex and falls: from the left it never overshoots.
    const double rest = 1 - u;
    double q = offsets_[std::min<std::size_t>(static_cast<std::size_t>(u * kOffsets), kOffsets - 1)];
    for (int step = 0; step < 30; ++step) {
        double value = 0, slope = 0;
        for (const Term& term : terms_) {
            const double e = term.probability * std::exp(-0.5 * q / term.variance);
            value += e;
            slope += 0.5 * e / term.variance;
        }
        const double next = std::min(q + (value - rest) / slope, offsets_.back());
        if (!(std::abs(next - q) > 1e-9 * next)) break;
        q = next;
    }
    return std::sqrt(std::max(q, 0.0));
}

double SkinModel::transmitted(double mu) const {
    return skin::transmittedFraction(material_.specular, skin::lookUpAlbedo(albedo_, mu));
}

double SkinModel::exitScale(double mu) const {
    return skin::exitScale(material_.specular, skin::lookUpAlbedo(albedo_, mu), meanAlbedo_);
}

std::vector<SkinModel::SpecularLobe> SkinModel::lobes(double removed) const {
    const auto left = [&](double m) { return std::sqrt(std::max(m * m - removed, 0.25 * m * m)); };
    if (!(material_.lobeWeight > 0)) return {{1, left(roughness_)}};
    return {{1 - material_.lobeWeight, left(roughness_)}, {material_.lobeWeight, left(narrower_)}};
}

double SkinModel::specular(const SpecularLobe& lobe, const glm::dvec3& n, const glm::dvec3& v,
                           const glm::dvec3& l) const {
    const double scale = skin::clampedScale(material_.specular, skin::lookUpAlbedo(albedo_, glm::dot(n, v)));
    return scale * lobe.share * skin::kelemenSpecular(n, v, l, lobe.roughness);
}

glm::dvec3 SkinModel::before(const glm::dvec3& albedo) const {
    return power(albedo, material_.mix);
}

glm::dvec3 SkinModel::after(const glm::dvec3& albedo) const {
    return power(albedo, 1 - material_.mix);
}

}  // namespace cutis::reference
