// Where each character's skin lies in the one atlas (DESIGN §1.4).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/frame/geometry.h"
#include "renderer/frame/skin_mesh.h"

namespace cutis {

// The UV layout of one skin material of one character, as a rectangle of the atlas.
struct AtlasChart {
    int character = -1, material = -1;
    glm::uvec4 rect{0};     // x, y, width, height in texels, gutters included
    double coarsestMm = 0;  // longest side of a texel, but for the largest fifth of them
    double finestMm = 0;    // shortest side of a texel, but for the smallest fiftieth of them
    double bodyMm2 = 0;     // area of all skin of the character, mm²
};

struct Atlas {
    int size = 0;  // texels along each side
    std::vector<AtlasChart> charts;
    std::vector<shared::AtlasVertex> vertices;   // one a skin vertex
    std::vector<std::uint32_t> borderTriangles;  // skin triangles that touch the border of their UV island
    std::vector<int> gutters;                    // texels around each island (SkinMesh::islands) that are its own
    double mmPerTexel = 0;                       // median over the surface's texels
};

struct AtlasOptions {
    int size = 0;  // exactly this, or 8 with skin on so few of its texels; 0: chosen
    std::vector<double> mmPerTexelWanted = {};  // a character; used when size is 0
    std::vector<double> reachMm = {};        // a material: how far skin's light is looked for beyond an island's border
    int maxSize = 4096;                      // bound when size is 0
};

// Sizes and packs the charts, places the skin's vertices in them, and sets DrawInfo::chart. Throws Error when the
// charts do not fit an atlas of the asked size.
Atlas layOutAtlas(const Scene& scene, const SkinMesh& mesh, Geometry& geometry, const AtlasOptions& options);

}  // namespace cutis
