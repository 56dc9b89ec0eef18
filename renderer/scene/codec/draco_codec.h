// Meshes compressed by Draco: what the program `cutis-codec` does for cutis (see ../codec_client.h).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "renderer/scene/codec/image_codec.h"

namespace cutis {

// A decoded mesh is one block: this, a DracoAttribute for each attribute, three uint32 a triangle, and for
// each attribute its float32 values, point by point.
struct DracoHeader {
    std::uint32_t points = 0, triangles = 0, attributes = 0;
};
struct DracoAttribute {
    std::uint32_t id = 0;  // as the file names it
    std::uint32_t components = 0;
};

namespace codec {

// Returns why it failed, or nothing. `maxBytes`, of the block; integers become floats as they are.
std::string decodeDraco(std::span<const std::byte> data, std::uint64_t maxBytes, const Allocate& allocate);

}  // namespace codec
}  // namespace cutis
