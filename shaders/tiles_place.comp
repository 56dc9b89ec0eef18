#version 460
// The list of needed tiles of each chart of the atlas: those of the first step first.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/atlas_tiles.h"

layout(local_size_x = 64) in;

layout(binding = 0, scalar) readonly buffer TileStateBuffer { AtlasTileState states[]; };
layout(binding = 1, scalar) buffer TileCountBuffer { uint coveredTexels, litTexels, counts[]; };  // where the next tile goes
layout(binding = 2, scalar) writeonly buffer TileListBuffer { uint tileList[]; };
layout(binding = 3, scalar) readonly buffer AtlasTileBuffer { AtlasTile atlasTiles[]; };
layout(binding = 4, scalar) readonly buffer AtlasChartBuffer { AtlasChart atlasCharts[]; };

layout(push_constant, scalar) uniform Push {
    uint tileCount, stepCount;
} push;

void main() {
    uint tile = gl_GlobalInvocationID.x;
    if (tile >= push.tileCount) return;
    uint step = states[tile].step;
    if (step == TILE_UNNEEDED) return;
    uint chart = atlasTiles[tile].chart;
    tileList[atlasCharts[chart].firstTile + atomicAdd(counts[chart * push.stepCount + step], 1u)] = tile;
}
