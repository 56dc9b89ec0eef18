#version 460
// The tiles of the atlas in which the triangles that a picture shows are looked up.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/atlas_tiles.h"
#include "shared/scene.h"

layout(local_size_x = 64) in;

layout(binding = 0, scalar) readonly buffer SeenBuffer { uint seen[]; };  // a triangle: 1 when a sample sees it
layout(binding = 1, scalar) readonly buffer IndexBuffer { uint indices[]; };
layout(binding = 2, scalar) readonly buffer TriangleDrawBuffer { uint triangleDraws[]; };
layout(binding = 3, scalar) readonly buffer DrawBuffer { DrawInfo draws[]; };
layout(binding = 4, scalar) readonly buffer AtlasVertexBuffer { AtlasVertex atlasVertices[]; };
layout(binding = 5, scalar) readonly buffer AtlasChartBuffer { AtlasChart atlasCharts[]; };
layout(binding = 6, scalar) buffer TileStateBuffer { AtlasTileState states[]; };

layout(push_constant, scalar) uniform Push {
    uint triangleCount;  // of skin
} push;

// Bilinear lookups reach this far from a place.
const float kLookupReach = 1.5;  // texels

void main() {
    uint triangle = gl_GlobalInvocationID.x;
    if (triangle >= push.triangleCount || seen[triangle] == 0u) return;
    AtlasChart chart = atlasCharts[draws[triangleDraws[triangle]].chart];
    vec2 a = atlasVertices[indices[triangle * 3u]].texel, b = atlasVertices[indices[triangle * 3u + 1u]].texel,
         c = atlasVertices[indices[triangle * 3u + 2u]].texel;
    ivec2 first = ivec2(chart.firstCell), last = first + ivec2(chart.cells) - 1;
    ivec2 low = ivec2(floor((min(min(a, b), c) - kLookupReach) / float(ATLAS_TILE)));
    ivec2 high = ivec2(floor((max(max(a, b), c) + kLookupReach) / float(ATLAS_TILE)));
    low = clamp(low, first, last) - first;
    high = clamp(high, first, last) - first;
    for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
            uint tile = chart.firstTile + uint(y) * chart.cells.x + uint(x);
            if (states[tile].covered + states[tile].gutter > 0u) states[tile].step = 0u;
        }
    }
}
