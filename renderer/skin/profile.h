// Diffusion profiles as sums of Gaussians (d'Eon, Luebke & Enderton 2007, §4). Everything is in millimetres and double.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace cutis::skin {

struct Gaussian {
    double variance;    // mm²
    glm::dvec3 weight;  // RGB
    bool operator==(const Gaussian&) const = default;
};

// Σ_k w_k G(v_k, r), sorted by growing variance. Weights of each channel sum to 1 for an energy-conserving profile.
struct Profile {
    std::vector<Gaussian> gaussians;
    bool operator==(const Profile&) const = default;
};

// The six Gaussians of three-layer skin (d'Eon & Luebke, GPU Gems 3, ch. 14, fig. 14-13).
Profile threeLayerProfile();

}  // namespace cutis::skin
