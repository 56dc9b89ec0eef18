// Gives every place of skin a place of its own in the atlas, whatever texture coordinates the file has:
// layouts are cut where they lie upon themselves, and made where there are none. Textures are still read at
// the file's own coordinates, and light crosses the cuts (frame/seam_map.h).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace cutis {

// How a primitive is laid out; empty where its own texture coordinates serve as they are.
struct SkinLayout {
    std::vector<std::uint32_t>
        indices;  // of its triangles; numbers from the primitive's vertex count on are copies
    std::vector<std::uint32_t> copies;  // of which vertex
    std::vector<glm::vec2> uv;          // of all vertices
    std::vector<std::uint32_t> parts;   // of all vertices: those of different parts are of different islands
    std::string remark;                 // what was wrong with it, for the user; empty: nothing
    bool empty() const { return indices.empty(); }
};

// Islands of a primitive, in the pose at rest:
// - folded ones (mirrored halves that share one half of the texture) are cut where they fold,
// - other ones that lie upon themselves are cut into parts that do not,
// - those without texture coordinates, squeezed into points and lines, or sheared, are laid out anew
//   (frame/unwrap.h), as is a primitive whose every few triangles are an island.
SkinLayout layOutSkin(const Primitive& primitive);

}  // namespace cutis
