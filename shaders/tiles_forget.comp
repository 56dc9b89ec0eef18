#version 460
// No tile of the atlas is needed yet.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/atlas_tiles.h"

layout(local_size_x = 64) in;

layout(binding = 0, scalar) buffer TileStateBuffer { AtlasTileState states[]; };

layout(push_constant, scalar) uniform Push {
    uint tileCount;
} push;

void main() {
    uint tile = gl_GlobalInvocationID.x;
    if (tile >= push.tileCount) return;
    states[tile].step = TILE_UNNEEDED;
    states[tile].needed[0] = states[tile].needed[1] = uvec2(0u);
}
