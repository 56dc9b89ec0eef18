// Passes over the needed tiles of a chart of the atlas (passes/atlas_tiles.h). The includer's work groups have 64 invocations, 8 × 8
// for tileTexel, or 256 along x; its push constants begin with `TilePush tiles`, and are called push.
#ifndef CUTIS_ATLAS_TILES_GLSL
#define CUTIS_ATLAS_TILES_GLSL

#include "shared/atlas_tiles.h"

layout(binding = 40, scalar) readonly buffer AtlasChartBuffer { AtlasChart atlasCharts[]; };
layout(binding = 41, scalar) readonly buffer AtlasTileBuffer { AtlasTile atlasTiles[]; };
layout(binding = 42, scalar) readonly buffer TileListBuffer { uint tileList[]; };
layout(binding = 43, scalar) readonly buffer TileDispatchBuffer { TileDispatch tileDispatches[]; };

// Reads of the includer's chart are the same for all invocations.
#define TILE_CHART atlasCharts[push.tiles.chart]

// Number `at` of the tiles of this dispatch.
uint listedTile(uint at) {
    uint count = tileDispatches[push.tiles.dispatch].tiles;
    uint tile = tileList[TILE_CHART.firstTile + min(at, max(count, 1u) - 1u)];
    return at < count ? tile : TILE_UNNEEDED;
}

// This invocation's texel of this work group's tile. False: nothing to do.
bool tileTexel(out ivec2 texel, out uint tile) {
    tile = listedTile(gl_WorkGroupID.y * TILE_ROW + gl_WorkGroupID.x);
    if (tile == TILE_UNNEEDED) return false;
    uvec2 at = atlasTiles[tile].corner + gl_LocalInvocationID.xy;
    texel = ivec2(at);
    uvec4 rect = TILE_CHART.rect;
    return all(greaterThanEqual(at, rect.xy)) && all(lessThan(at, rect.xy + rect.zw));
}

// The same at 1/2^shift of the resolution, so many tiles a work group as its invocations are texels of: a texel stands for a block
// of 2^shift × 2^shift, and is one of the atlas in any case.
bool tileBlock(uint shift, out ivec2 texel, out uint tile) {
    uint perTile = 64u >> 2u * shift, side = ATLAS_TILE >> shift;
    uint perGroup = gl_WorkGroupSize.x * gl_WorkGroupSize.y / perTile;
    tile = listedTile((gl_WorkGroupID.y * TILE_ROW + gl_WorkGroupID.x) * perGroup + gl_LocalInvocationIndex / perTile);
    uint within = gl_LocalInvocationIndex % perTile;
    uvec2 at = (atlasTiles[tile == TILE_UNNEEDED ? 0u : tile].corner >> shift) + uvec2(within % side, within / side);
    texel = ivec2(at);
    if (tile == TILE_UNNEEDED) return false;
    uvec4 rect = TILE_CHART.rect;
    uvec2 low = at << shift;
    return all(greaterThan(low + (1u << shift), rect.xy)) && all(lessThan(low, rect.xy + rect.zw));
}

// The same for probes of the sky's visibility, which stand for blocks of 2 × 2 texels, also for those just beyond the chart.
bool tileProbe(out ivec2 probe) {
    uint tile;
    tileBlock(1u, probe, tile);
    return tile != TILE_UNNEEDED;
}

#endif
