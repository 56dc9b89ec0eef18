#version 460
// Where the tiles of each step begin among those of their chart, and how many work groups they take with all steps
// before.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/atlas_tiles.h"

layout(local_size_x = 64) in;

// Of the steps of each chart: tiles; then where they begin.
layout(binding = 0, scalar) buffer TileCountBuffer { uint coveredTexels, litTexels, counts[]; };
layout(binding = 1, scalar) writeonly buffer TileDispatchBuffer { TileDispatch tileDispatches[]; };

layout(push_constant, scalar) uniform Push {
    uint chartCount, stepCount;
} push;

uvec3 groupsOf(uint count) { return uvec3(min(count, TILE_ROW), (count + TILE_ROW - 1u) / TILE_ROW, 1u); }

void main() {
    uint chart = gl_GlobalInvocationID.x;
    if (chart >= push.chartCount) return;
    uint end = 0u;
    for (uint step = chart * push.stepCount; step < (chart + 1u) * push.stepCount; ++step) {
        uint begin = end;
        end += counts[step];
        counts[step] = begin;
        for (uint shift = 0u; shift <= COARSEST_LEVEL + 1u; ++shift) {
            tileDispatches[step].groups[shift] = groupsOf((end + (1u << 2u * shift) - 1u) >> 2u * shift);
        }
        tileDispatches[step].tiles = end;
    }
}
