#version 460
// The light that falls on each patch of skin: the sum of its samples.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/light_patches.h"

layout(local_size_x = 64) in;

layout(binding = 0) uniform texture2D irradiance;  // E'(rgb); a: island, 0 where uncovered
layout(binding = 1, scalar) readonly buffer PatchBuffer { LightPatch patches[]; };
layout(binding = 2, scalar) readonly buffer SampleBuffer { PatchSample samples[]; };
layout(binding = 3, scalar) writeonly buffer LightBuffer { vec3 light[]; };  // E' times area, a patch

layout(push_constant, scalar) uniform Push {
    uint patchCount;
} push;

// Between the texels of the sample's island, which they and the gutters around it name; a: how much of the four that are.
vec4 irradianceAt(PatchSample at) {
    ivec2 last = textureSize(irradiance, 0) - 1;
    vec2 grid = at.place - 0.5;
    ivec2 base = ivec2(floor(grid));
    vec2 f = grid - vec2(base);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        vec4 value = texelFetch(irradiance, clamp(base + offset, ivec2(0), last), 0);
        float w = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
        if (value.a == at.island) sum += vec4(value.rgb, 1.0) * w;
    }
    return sum;
}

void main() {
    uint at = gl_GlobalInvocationID.x;
    if (at >= push.patchCount) return;
    LightPatch part = patches[at];
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < part.sampleCount; ++i) {
        PatchSample piece = samples[part.firstSample + i];
        sum += irradianceAt(piece) * piece.area;
    }
    // Where a piece is narrower than a texel, the rest of the patch stands for it.
    light[at] = sum.a > 0.0 ? sum.rgb * (part.area / sum.a) : vec3(0.0);
}
