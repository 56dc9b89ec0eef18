// Sums over every texel of an environment: the brute force that clusters and maps are checked against.
#pragma once

#include <algorithm>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/scene/light.h"

namespace cutis::test {

// Light of a texel, or of a part of it: RGB ∫ L dω.
struct Texel {
    glm::dvec3 direction, flux;
};

// Every texel at its centre with its exact solid angle; those of more than a thousandth of all light in 16×16
// parts.
std::vector<Texel> listTexels(const Environment& environment);

// For each normal n: Σ share(n, texel) over `texels`. A block of texels is summed for many normals before the
// next, since all of them, some 30 MB, fit no cache.
template <typename Share>
std::vector<glm::dvec3> sumShares(std::span<const Texel> texels, std::span<const glm::dvec3> normals,
                                  const Share& share) {
    constexpr std::size_t kBlock = 2048, kNormals = 16;
    std::vector<glm::dvec3> sums(normals.size(), glm::dvec3(0));
    parallelFor((normals.size() + kNormals - 1) / kNormals, [&](std::size_t group) {
        const std::size_t first = group * kNormals, last = std::min(normals.size(), first + kNormals);
        for (std::size_t begin = 0; begin < texels.size(); begin += kBlock) {
            const auto block = texels.subspan(begin, std::min(kBlock, texels.size() - begin));
            for (std::size_t k = first; k < last; ++k) {
                glm::dvec3 sum(0);
                for (const Texel& texel : block) sum += share(normals[k], texel);
                sums[k] += sum;
            }
        }
    });
    return sums;
}

// The same of share = L Ω weight(n·ω), over every texel of an environment.
std::vector<glm::dvec3> sumTexels(const Environment& environment, std::span<const glm::dvec3> normals,
                                  const std::function<double(double)>& weight);

}  // namespace cutis::test
