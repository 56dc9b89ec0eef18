#version 460
// The shape of a millimetre in the texels of gutters: that of the border which they lie beyond.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

#include "shared/atlas_tiles.h"

layout(binding = 0, rgba32f) writeonly uniform image2D stretch;  // see surface.comp
layout(binding = 1, scalar) readonly buffer MetricBuffer { vec3 metrics[]; };  // AtlasVertex::metric at the border
layout(binding = 2, scalar) readonly buffer AtlasChartBuffer { AtlasChart atlasCharts[]; };
layout(binding = 3, scalar) buffer TileStateBuffer { AtlasTileState states[]; };

layout(push_constant, scalar) uniform Push {
    uint count;
} push;

#include "lib/metric.glsl"
#include "lib/seams.glsl"
#include "lib/seam_tiles.glsl"
#include "lib/tile_stretch.glsl"

void main() {
    uint at;
    if (!listedSeam(at)) return;
    SeamTexel seam = seamTexels[at];
    vec3 factor = inverseMetricFactor(metrics[at]);
    imageStore(stretch, texelOf(seam), vec4(factor, seam.island));
    noteStretch(tileAt(atlasCharts[seam.charts & 0xffffu], texelOf(seam)), factor);
}
