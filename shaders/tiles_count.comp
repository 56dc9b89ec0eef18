#version 460
// How many tiles of each chart of the atlas are needed at each step.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/atlas_tiles.h"

layout(local_size_x = 64) in;

layout(binding = 0, scalar) readonly buffer TileStateBuffer { AtlasTileState states[]; };
// Covered texels, all and needed; then the tiles of a step, chart by chart.
layout(binding = 1, scalar) buffer TileCountBuffer { uint coveredTexels, litTexels, counts[]; };
layout(binding = 2, scalar) readonly buffer AtlasTileBuffer { AtlasTile atlasTiles[]; };

layout(push_constant, scalar) uniform Push {
    uint tileCount, stepCount, litStep;
} push;

void main() {
    uint tile = gl_GlobalInvocationID.x;
    if (tile >= push.tileCount) return;
    AtlasTileState state = states[tile];
    if (state.covered > 0u) {
        atomicAdd(coveredTexels, state.covered);
        if (state.step <= push.litStep) atomicAdd(litTexels, state.covered);
    }
    if (state.step != TILE_UNNEEDED) atomicAdd(counts[atlasTiles[tile].chart * push.stepCount + state.step], 1u);
}
