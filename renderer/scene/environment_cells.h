// A lat-long environment as a grid of sums, from which clusters are made. Internal to renderer/scene.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "renderer/scene/environment_clusters.h"

namespace cutis {

// Sums over the light of a rectangle of texels.
struct FluxSums {
    glm::dvec3 flux{0};    // RGB ∫ L dω
    glm::dvec3 moment{0};  // ∫ (L_R + L_G + L_B) ω dω
    double solidAngle = 0;

    double weight() const { return flux.x + flux.y + flux.z; }
    double spread() const;  // rms angle to the mean direction, weighted by R+G+B; 0 where black
    FluxSums& operator+=(const FluxSums& other);
};

// The image in cells of whole texels, at most 1024×512 of them.
struct EnvironmentCells {
    int width = 0, height = 0;
    std::vector<FluxSums> cells;
};

// `radianceAt(texel)` gives the radiance of texel index row · width + column.
EnvironmentCells sumEnvironment(const Environment& environment,
                                const std::function<glm::dvec3(std::size_t)>& radianceAt);

// Halves rectangles of cells, largest flux times spread first, until there are maxClusters.
std::vector<FluxSums> clusterCells(const EnvironmentCells& grid, std::size_t maxClusters);

}  // namespace cutis
