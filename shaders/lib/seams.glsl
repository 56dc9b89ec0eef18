// The list of gutter texels of one resolution (frame/seam_map.h). The includer's work groups have 64 invocations along x;
// its push constants are called push and hold `uint count`.
#ifndef CUTIS_SEAMS_GLSL
#define CUTIS_SEAMS_GLSL

#include "shared/atlas_tiles.h"

layout(binding = 20, scalar) readonly buffer SeamBuffer { SeamTexel seamTexels[]; };

// This invocation's number in the list. False: it has none.
bool listedSeam(out uint at) {
    at = (gl_WorkGroupID.y * TILE_ROW + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    return at < push.count;
}

ivec2 texelOf(SeamTexel seam) { return ivec2(seam.texel & 0x3fffu, (seam.texel >> 14u) & 0x3fffu); }

// The first of the four texels that the place which lies there is read from; the others are (1, 0), (0, 1) and (1, 1) from it.
ivec2 sourceBase(SeamTexel seam) { return ivec2(seam.base & 0xffffu, seam.base >> 16u); }

bool isSource(SeamTexel seam, int i) { return ((seam.texel >> (28u + uint(i))) & 1u) != 0u; }

#endif
