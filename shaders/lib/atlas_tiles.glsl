// Passes over the needed tiles of a chart of the atlas (passes/atlas_tiles.h). The includer's work groups have 64
// invocations, 8 × 8 for texels; its push constants begin with `TilePush tiles`, and are called push.
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

// The same for probes, which stand for blocks of 2 × 2 texels: 16 a tile, four tiles a work group. The probe is one of the
// atlas in any case.
bool tileProbe(out ivec2 probe) {
    uint tile = listedTile((gl_WorkGroupID.y * TILE_ROW + gl_WorkGroupID.x) * 4u + gl_LocalInvocationIndex / 16u);
    uint within = gl_LocalInvocationIndex % 16u;
    probe = ivec2(atlasTiles[tile == TILE_UNNEEDED ? 0u : tile].corner / 2u + uvec2(within % 4u, within / 4u));
    return tile != TILE_UNNEEDED;
}

#endif
