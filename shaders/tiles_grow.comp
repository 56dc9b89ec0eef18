#version 460
// Adds the tiles that one direction of one blur reads (axis 1: diffusion.comp's second column, axis 0: its first), or
// those within a texel of 1/2^shift of the resolution (axis 2), of the tiles needed so far.
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
} push;

#include "lib/blur_reach.glsl"

void main() {
    uint tile = gl_GlobalInvocationID.x;
    if (tile >= push.tileCount || states[tile].step >= push.step) return;
    AtlasTileState state = states[tile];
    AtlasChart chart = atlasCharts[atlasTiles[tile].chart];
    ivec2 reach = ivec2(1 << push.shift);
    if (push.axis < 2u) {
        if (push.level >= chart.gaussianCount) return;
        float variance = gaussians[chart.firstGaussian + push.level].variance;
        float previous = push.level > 0u ? gaussians[chart.firstGaussian + push.level - 1u].variance : 0.0;
        vec3 perMm = vec3(uintBitsToFloat(state.perMmU), uintBitsToFloat(state.perMmV), uintBitsToFloat(state.perMmMixed));
        perMm /= float(1u << 2u * push.shift);
        reach = blurReach(perMm, previous, variance, float(1u << push.shift - push.finerShift), push.axis) << int(push.shift);
    }
    ivec2 corner = ivec2(atlasTiles[tile].corner), edge = corner + int(ATLAS_TILE) - 1;
    ivec2 first = ivec2(chart.firstCell), last = first + ivec2(chart.cells) - 1;
    // Coordinates below zero round towards it, which the clamp hides.
    ivec2 low = clamp((corner - reach) / int(ATLAS_TILE), first, last) - first;
    ivec2 high = clamp((edge + reach) / int(ATLAS_TILE), first, last) - first;
    for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
            uint other = chart.firstTile + uint(y) * chart.cells.x + uint(x);
            if (states[other].covered + states[other].gutter > 0u) atomicMin(states[other].step, push.step);
        }
    }
}
