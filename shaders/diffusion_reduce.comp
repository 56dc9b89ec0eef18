#version 460
// Half or a quarter of the resolution, for levels of the blur that are smooth there: the mean of the texels that belong to
// the island of each block.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
// features: STRETCH
#include "shared/atlas_tiles.h"

layout(local_size_x = 256) in;

layout(constant_id = 0) const uint SHIFT = 1;  // the target's resolution is 1/2^SHIFT of the atlas'
layout(constant_id = 1) const uint FINER = 2;  // the source's is so many times the target's

layout(binding = 0) uniform texture2D source;  // a: island, 0 where uncovered. STRETCH: see surface.comp
layout(binding = 1, rgba32f) writeonly uniform image2D target;
#ifndef STRETCH
layout(binding = 2) uniform texture2D stretch;  // at the target's resolution
#endif

layout(push_constant, scalar) uniform Push {
    TilePush tiles;
} push;

#include "lib/atlas_tiles.glsl"

void main() {
    ivec2 texel;
    uint tile;
    if (!tileBlock(SHIFT, texel, tile)) return;
    ivec2 corner = texel * int(FINER);
#ifdef STRETCH
    // A block has the shape, and the island, of its covered texel nearest to its middle.
    float middle = 0.5 * float(FINER - 1u), nearest = 1e9;
    vec4 found = vec4(0.0);
    for (uint i = 0u; i < FINER * FINER; ++i) {
        ivec2 offset = ivec2(i % FINER, i / FINER);
        vec4 value = texelFetch(source, corner + offset, 0);
        vec2 away = vec2(offset) - middle;
        if (value.w != 0.0 && dot(away, away) < nearest) nearest = dot(away, away), found = value;
    }
    imageStore(target, texel, vec4(found.xyz / float(FINER), found.w));
#else
    float island = texelFetch(stretch, texel, 0).w;
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < FINER * FINER; ++i) {
        vec4 value = texelFetch(source, corner + ivec2(i % FINER, i / FINER), 0);
        if (value.a == island) sum += vec4(value.rgb, 1.0);
    }
    imageStore(target, texel, island == 0.0 || sum.a == 0.0 ? vec4(0.0) : vec4(sum.rgb / sum.a, island));
#endif
}
