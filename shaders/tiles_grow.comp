#version 460
// Adds the texels that one direction of one blur reads (axis 1: diffusion.comp's second column, axis 0: its first), or
// those within a texel of 1/2^shift of the resolution (axis 2), of those needed so far, and the tiles that hold them.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/atlas_tiles.h"
#include "shared/scene.h"

layout(local_size_x = 64) in;

layout(binding = 0, scalar) readonly buffer AtlasChartBuffer { AtlasChart atlasCharts[]; };
layout(binding = 1, scalar) readonly buffer AtlasTileBuffer { AtlasTile atlasTiles[]; };
layout(binding = 2, scalar) readonly buffer GaussianBuffer { GaussianTerm gaussians[]; };
layout(binding = 3, scalar) buffer TileStateBuffer { AtlasTileState states[]; };

layout(push_constant, scalar) uniform Push {
    uint tileCount;
    uint step;  // what is added is needed at this one
    uint level;
    uint axis;
    uint shift, finerShift;  // the level's resolution is 1/2^shift of the atlas'; that of what it is made from
    uint turn;               // of AtlasTileState::needed: what is read
} push;

#include "lib/blur_reach.glsl"
#include "lib/tile_texels.glsl"

void main() {
    uint tile = gl_GlobalInvocationID.x;
    if (tile >= push.tileCount || states[tile].step >= push.step) return;
    AtlasTileState state = states[tile];
    AtlasChart chart = atlasCharts[atlasTiles[tile].chart];
    uvec2 texels = neededTexels(state, push.turn);
    if (texels == uvec2(0u)) return;
    ivec2 reach = ivec2(1 << push.shift);
    if (push.axis < 2u) {
        reach = ivec2(0);
        if (push.level < chart.blurredCount) {
            float variance = gaussians[chart.firstGaussian + push.level].variance;
            float previous = push.level > 0u ? gaussians[chart.firstGaussian + push.level - 1u].variance : 0.0;
            vec3 perMm = vec3(uintBitsToFloat(state.perMmU), uintBitsToFloat(state.perMmV), uintBitsToFloat(state.perMmMixed));
            perMm /= float(1u << 2u * push.shift);
            reach = blurReach(perMm, previous, variance, float(1u << push.shift - push.finerShift), push.axis);
            reach <<= int(push.shift);
        }
    }
    // Whole texels of this level and of what it is made from.
    ivec2 low, high;
    boundsOf(texels, low, high);
    int block = 1 << int(push.shift);
    ivec2 corner = ivec2(atlasTiles[tile].corner);
    low = corner + low / block * block - reach;
    high = corner + high / block * block + block - 1 + reach;
    ivec2 first = ivec2(chart.firstCell), last = first + ivec2(chart.cells) - 1;
    // Coordinates below zero round towards it, which the clamp hides.
    ivec2 lowCell = clamp(low / int(ATLAS_TILE), first, last), highCell = clamp(high / int(ATLAS_TILE), first, last);
    for (int y = lowCell.y; y <= highCell.y; ++y) {
        for (int x = lowCell.x; x <= highCell.x; ++x) {
            uint other = chart.firstTile + uint(y - first.y) * chart.cells.x + uint(x - first.x);
            if (states[other].covered + states[other].gutter == 0u) continue;
            ivec2 origin = ivec2(x, y) * int(ATLAS_TILE);
            ivec2 from = max(low - origin, 0), to = min(high - origin, int(ATLAS_TILE) - 1);
            if (any(greaterThan(from, to))) continue;
            uvec2 added = texelsWithin(from, to);
            atomicOr(states[other].needed[1u - push.turn].x, added.x);
            atomicOr(states[other].needed[1u - push.turn].y, added.y);
            atomicMin(states[other].step, push.step);
        }
    }
}
