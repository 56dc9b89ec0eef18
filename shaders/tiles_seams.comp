#version 460
// Adds the texels, and the tiles that hold them, at which gutters that are needed so far go on.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/atlas_tiles.h"

layout(local_size_x = 64) in;

layout(binding = 0, scalar) readonly buffer AtlasChartBuffer { AtlasChart atlasCharts[]; };
layout(binding = 1, scalar) buffer TileStateBuffer { AtlasTileState states[]; };

layout(push_constant, scalar) uniform Push {
    uint count;
    uint step;   // what is added is needed at this one
    uint shift;  // the list is of 1/2^shift of the atlas' resolution
    uint turn;   // of AtlasTileState::needed
} push;

#include "lib/seams.glsl"
#include "lib/seam_tiles.glsl"
#include "lib/tile_texels.glsl"

// The texels of the tile that one of this resolution stands for.
uvec2 blockAt(ivec2 texel) {
    ivec2 low = (texel << int(push.shift)) % int(ATLAS_TILE);
    return texelsWithin(low, low + (1 << int(push.shift)) - 1);
}

void main() {
    uint at;
    if (!listedSeam(at)) return;
    SeamTexel seam = seamTexels[at];
    AtlasTileState state = states[tileAt(atlasCharts[seam.charts & 0xffffu], texelOf(seam) << int(push.shift))];
    if (state.step >= push.step || (neededTexels(state, push.turn) & blockAt(texelOf(seam))) == uvec2(0u)) return;
    AtlasChart chart = atlasCharts[seam.charts >> 16u];
    // Sources are no gutter texels, so what is added here is not what others of this dispatch look at.
    for (int i = 0; i < 4; ++i) {
        if (!isSource(seam, i)) continue;
        ivec2 source = sourceBase(seam) + ivec2(i & 1, i >> 1);
        uint tile = tileAt(chart, source << int(push.shift));
        uvec2 added = blockAt(source);
        atomicOr(states[tile].needed[push.turn].x, added.x);
        atomicOr(states[tile].needed[push.turn].y, added.y);
        atomicMin(states[tile].step, push.step);
    }
}
