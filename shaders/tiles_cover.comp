#version 460
// Which tiles of the atlas hold surface.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/atlas_tiles.h"

layout(local_size_x = 64) in;

layout(binding = 0) uniform utexture2D triangles;  // triangle + 1; 0: no surface
layout(binding = 1, scalar) readonly buffer AtlasChartBuffer { AtlasChart atlasCharts[]; };
layout(binding = 2, scalar) readonly buffer AtlasTileBuffer { AtlasTile atlasTiles[]; };
layout(binding = 3, scalar) writeonly buffer TileStateBuffer { AtlasTileState states[]; };

layout(push_constant, scalar) uniform Push {
    uint tileCount;
} push;

void main() {
    uint tile = gl_GlobalInvocationID.x;
    if (tile >= push.tileCount) return;
    uvec4 rect = atlasCharts[atlasTiles[tile].chart].rect;
    uvec2 corner = atlasTiles[tile].corner;
    uvec2 low = max(corner, rect.xy), high = min(corner + ATLAS_TILE, rect.xy + rect.zw);
    uint covered = 0u;
    for (uint y = low.y; y < high.y; ++y) {
        for (uint x = low.x; x < high.x; ++x) covered += texelFetch(triangles, ivec2(x, y), 0).x != 0u ? 1u : 0u;
    }
    states[tile] = AtlasTileState(covered, 0u, covered > 0u ? 0u : TILE_UNNEEDED, 0u, 0u, 0u, uvec2[2](uvec2(0u), uvec2(0u)));
}
