// Seams: which surface lies beyond the border of each UV island, texel by texel of the gutter around it.
//
// From the place of the border nearest to a gutter texel one walks over the surface, straight across edges as if their
// triangles lay in one plane, as far as the border's own triangle would reach to that texel. Distances along and across the
// border are then those of the skin, whatever scale and turn the layout gives the island beyond.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/frame/atlas.h"
#include "shaders/shared/atlas_tiles.h"

namespace cutis {

// The gutter at one resolution, row by row.
struct SeamMap {
    std::vector<shared::SeamTexel> texels;
    std::vector<glm::vec3> metrics;  // AtlasVertex::metric at the border, a texel
};

// At 1/2^shift of the atlas' resolution. profiles: a number for each chart; light goes on into charts of the same number alone.
SeamMap makeSeamMap(const Geometry& geometry, const SkinMesh& mesh, const Atlas& atlas, std::span<const int> profiles,
                    std::uint32_t shift);

}  // namespace cutis
