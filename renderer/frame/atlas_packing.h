// Where UV islands lie within their chart, and charts within the atlas.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace cutis {

// A UV island as it is packed.
struct IslandShape {
    std::uint32_t island = 0;          // index into SkinMesh::islands
    glm::dvec2 uvMin{0}, uvMax{0};
    bool continued = false;            // the surface goes on beyond its border
    bool overlaps = false;             // it lies upon another one
    glm::dvec2 scale{1};               // by which its texels are made finer than those of the chart, along u and v
    // Filled by packing
    glm::dvec2 place{0};  // of uvMin, in texels from the chart's corner
    int gutter = 0;       // texels kept free around it
};

// The islands of one skin material of one character.
struct ChartShape {
    glm::dvec2 mmPerUv{1};  // along u and v, on average
    double reachMm = 0;     // how far light that crosses a border is looked for
    double texelsPerMm = 0;  // wanted
    std::vector<IslandShape> islands;
    // Filled by packing
    glm::dvec2 texelsPerUv{0};
    glm::uvec4 rect{0};  // x, y, width, height in texels, gutters included
};

// Packs charts into an atlas of size × size texels at `scale` times the texels a mm that they want; false when they do
// not fit. A chart is taken apart where the surface goes on from island to island, where islands overlap or have a scale of
// their own, and where most of its layout is empty: each island gets a gutter as wide as its light needs, capped by half of
// its own size. The layout of others stays.
bool packCharts(std::vector<ChartShape>& charts, int size, double scale);

// The smallest size up to `largest` that holds the charts as they want to be; 0: none does.
int packSmallest(std::vector<ChartShape>& charts, int largest);

}  // namespace cutis
