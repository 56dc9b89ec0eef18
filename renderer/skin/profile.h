// Diffusion profiles as sums of Gaussians (d'Eon, Luebke & Enderton 2007, §4). Everything is in millimetres
// and double.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace cutis::skin {

struct Gaussian {
    double variance;    // mm²
    glm::dvec3 weight;  // RGB
    bool operator==(const Gaussian&) const = default;
};

// Σ_k w_k G(v_k, r), sorted by growing variance. Weights of each channel sum to 1 for an energy-conserving
// profile.
struct Profile {
    std::vector<Gaussian> gaussians;
    bool operator==(const Profile&) const = default;
};

// More Gaussians than this is refused: no fit of a real profile needs more, and each one costs a blur.
inline constexpr int kMaxGaussians = 32;

// The six Gaussians of three-layer skin (d'Eon & Luebke, GPU Gems 3, ch. 14, fig. 14-13).
Profile threeLayerProfile();

// Throws Error, naming `where`, unless there are 1 to kMaxGaussians Gaussians, variances are positive and
// finite, weights are non-negative and finite, and at least one weight is positive.
void validate(const Profile& profile, const std::string& where);

// By growing variance; Gaussians of equal variance become one.
Profile sorted(const Profile& profile);

// All lengths multiplied by `scale` > 0, hence variances by scale².
Profile scaled(const Profile& profile, double scale);

// At most k ≥ 1 Gaussians of the same total weight per channel. Runs of neighbours merge into one, whose
// variance is the mean of theirs weighted by R+G+B, so that the second moment summed over the channels is
// kept too. Of all ways to cut the list into k runs it takes the one with the least squared error of the
// response to an edge.
Profile reduced(const Profile& profile, int k);

// R(r) = Σ w G(v, r), in 1/mm².
glm::dvec3 evaluate(const Profile& profile, double r);

// Σ w_k: what a plane of irradiance 1 scatters back.
glm::dvec3 totalWeight(const Profile& profile);

// Σ w_k v_k, in mm²: the variance along one axis; ∫ r² R dA is twice that.
glm::dvec3 secondMoment(const Profile& profile);

// Σ w ½(1 + erf(x / √(2v))): a plane lit where x > 0, seen x mm from the edge.
glm::dvec3 edgeResponse(const Profile& profile, double x);

// Σ w exp(-t² / 2v): a slab of thickness t mm, evenly lit from behind (d'Eon et al. 2007, §6: ∫ G(v,
// √(r²+t²)) dA).
glm::dvec3 slabTransmission(const Profile& profile, double t);

}  // namespace cutis::skin
