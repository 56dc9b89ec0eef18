// Sums over every texel of an environment: the brute force that clusters and maps are checked against.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/scene/light.h"

namespace cutis::test {

// For each normal n: Σ L Ω weight(n·ω) over all texels, each at its centre with its exact solid angle; texels
// of more than a thousandth of all light are cut into 16×16.
std::vector<glm::dvec3> sumTexels(const Environment& environment, std::span<const glm::dvec3> normals,
                                  const std::function<double(double)>& weight);

}  // namespace cutis::test
