#version 460
// Adds the tiles that hold what lies beyond the borders of UV islands, for the gutters of the tiles needed so far.
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
} push;

#include "lib/seams.glsl"
#include "lib/seam_tiles.glsl"

void main() {
    uint at;
    if (!listedSeam(at)) return;
    SeamTexel seam = seamTexels[at];
    if (states[tileAt(atlasCharts[seam.charts & 0xffffu], texelOf(seam) << push.shift)].step >= push.step) return;
    AtlasChart chart = atlasCharts[seam.charts >> 16u];
    for (int i = 0; i < 4; ++i) {
        if (!isSource(seam, i)) continue;
        uint tile = tileAt(chart, (sourceBase(seam) + ivec2(i & 1, i >> 1)) << push.shift);
        if (states[tile].step > push.step) atomicMin(states[tile].step, push.step);
    }
}
