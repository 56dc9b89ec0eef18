#version 460
// One level of diffusion of a chart whose body is not much wider than its Gaussian: at each texel the sum over all patches of
// the body's skin of their light times the Gaussian of the straight distance, which is what the model asks for
// (docs/model.md).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/atlas_tiles.h"
#include "shared/light_patches.h"
#include "shared/scene.h"
#include "lib/octahedral.glsl"

layout(local_size_x = 256) in;

layout(constant_id = 0) const uint SHIFT = 0;  // the level's resolution is 1/2^SHIFT of the atlas'

layout(binding = 0) uniform texture2D position;        // see surface.comp
layout(binding = 1) uniform texture2D normal;
layout(binding = 2) uniform texture2D stretch;         // w: island
layout(binding = 3) uniform texture2D coarseStretch;   // the same at the level's resolution
layout(binding = 4, rgba32f) writeonly uniform image2D target;
layout(binding = 5, scalar) readonly buffer PatchBuffer { LightPatch patches[]; };
layout(binding = 6, scalar) readonly buffer LightBuffer { vec3 light[]; };  // of each, E' times area in mm²

layout(push_constant, scalar) uniform Push {
    TilePush tiles;
    uint firstPatch, patchCount;  // of the body
    float variance;               // mm²
    uint facing;                  // 1: only of patches that face where the texel does
} push;

#include "lib/atlas_tiles.glsl"

// A patch spans some angle, so it leaves by and by.
const float kFacingRamp = 0.2;

void main() {
    ivec2 texel;
    uint tile;
    bool listed = tileBlock(SHIFT, texel, tile);
    float mmPerUnit = TILE_CHART.mmPerUnit;
    float island = texelFetch(coarseStretch, texel, 0).w;
    ivec2 last = textureSize(position, 0) - 1;
    vec3 p = vec3(0.0), n = vec3(0.0);
    float covered = 0.0;
    for (int i = 0; i < 1 << 2 * int(SHIFT); ++i) {
        ivec2 at = min((texel << int(SHIFT)) + ivec2(i & (1 << int(SHIFT)) - 1, i >> int(SHIFT)), last);
        vec4 place = texelFetch(position, at, 0);
        float own = place.w != 0.0 && texelFetch(stretch, at, 0).w == island ? 1.0 : 0.0;
        p += own * place.xyz;
        n += own * decodeOctahedral(texelFetch(normal, at, 0).xy);
        covered += own;
    }
    p /= max(covered, 1.0);
    n = normalize(n + vec3(0.0, 0.0, 1e-12));
    // exp(-d²/2v) / 2πv, as a power of 2.
    float perSquare = -0.5 * 1.44269504 * mmPerUnit * mmPerUnit / push.variance;
    float ramp = push.facing != 0u ? 0.5 / kFacingRamp : 0.0, least = push.facing != 0u ? 0.5 : 1.0;
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < push.patchCount; ++i) {
        LightPatch part = patches[push.firstPatch + i];
        vec3 apart = part.centre - p;
        float share = clamp(least + ramp * dot(n, part.normal), 0.0, 1.0);
        sum += light[push.firstPatch + i] * (share * exp2(perSquare * dot(apart, apart)));
    }
    sum /= 6.28318531 * push.variance;
    if (listed) imageStore(target, texel, covered > 0.0 ? vec4(sum, island) : vec4(0.0));
}
