// Sums over every texel of an environment: the brute force that clusters and maps are checked against.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/scene/light.h"

namespace cutis::test {

// Light of a texel, or of a part of it: RGB ∫ L dω.
struct Texel {
    glm::dvec3 direction, flux;
};

// Every texel at its centre with its exact solid angle; those of more than a thousandth of all light in 16×16
// parts.
std::vector<Texel> listTexels(const Environment& environment);

// For each normal n: Σ L Ω weight(n·ω) over them.
std::vector<glm::dvec3> sumTexels(const Environment& environment, std::span<const glm::dvec3> normals,
                                  const std::function<double(double)>& weight);

}  // namespace cutis::test
