#version 460
// Adds all tiles of the bodies whose light is summed over all of their skin (passes/wide_gaussians.h).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/atlas_tiles.h"

layout(local_size_x = 64) in;

layout(binding = 0, scalar) readonly buffer AtlasChartBuffer { AtlasChart atlasCharts[]; };
layout(binding = 1, scalar) readonly buffer AtlasTileBuffer { AtlasTile atlasTiles[]; };
layout(binding = 2, scalar) buffer TileStateBuffer { AtlasTileState states[]; };

layout(push_constant, scalar) uniform Push {
    uint tileCount;
    uint step;  // what is added is needed at this one
} push;

void main() {
    uint tile = gl_GlobalInvocationID.x;
    if (tile >= push.tileCount) return;
    if (atlasCharts[atlasTiles[tile].chart].litWhole == 0u || states[tile].covered + states[tile].gutter == 0u) return;
    states[tile].needed[0] = states[tile].needed[1] = uvec2(0xffffffffu);
    states[tile].step = min(states[tile].step, push.step);
}
