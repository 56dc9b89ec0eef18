#version 460
// Which tiles of the atlas hold gutters that the surface beyond the border fills.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/atlas_tiles.h"

layout(local_size_x = 64) in;

layout(binding = 0, scalar) readonly buffer AtlasChartBuffer { AtlasChart atlasCharts[]; };
layout(binding = 1, scalar) buffer TileStateBuffer { AtlasTileState states[]; };

layout(push_constant, scalar) uniform Push {
    uint count;
} push;

#include "lib/seams.glsl"
#include "lib/seam_tiles.glsl"

void main() {
    uint at;
    if (!listedSeam(at)) return;
    SeamTexel seam = seamTexels[at];
    uint tile = tileAt(atlasCharts[seam.charts & 0xffffu], texelOf(seam));
    atomicAdd(states[tile].gutter, 1u);
    states[tile].step = 0u;
}
