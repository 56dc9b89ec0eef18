#version 460
// Light goes on beyond the borders of UV islands: each texel of a gutter gets the value of the place that lies there on the
// surface, with the number of the island that it extends. Blurs then read it as one of the island's own.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;

layout(binding = 0, rgba32f) uniform image2D light;  // rgb; a: island, 0 where uncovered

layout(push_constant, scalar) uniform Push {
    uint count;
} push;

#include "lib/seams.glsl"

// Of the differences between four texels: how far beyond them a value may lie.
const float kMostBeyond = 0.75;

void main() {
    uint at;
    if (!listedSeam(at)) return;
    SeamTexel seam = seamTexels[at];
    // Only texels whose centres lie on the island there are read: this pass writes none of them.
    ivec2 base = sourceBase(seam);
    vec2 f = seam.place - 0.5 - vec2(base);
    vec4 sum = vec4(0.0), few = vec4(0.0);
    vec3 low = vec3(1e30), high = vec3(0.0);
    bool all = true;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        vec4 value = isSource(seam, i) ? imageLoad(light, base + offset) : vec4(0.0);
        float w = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
        all = all && value.a != 0.0;
        sum += vec4(value.rgb, 1.0) * w;
        low = min(low, value.rgb), high = max(high, value.rgb);
        // Where the nearest of them lie a whole texel away they count all the same.
        if (value.a != 0.0) few += vec4(value.rgb, 1.0) * max(w, 1e-4);
    }
    // Between the border and the last centres before it light goes on as it does beside them, but for the edges of shadows.
    vec3 margin = kMostBeyond * (high - low);
    vec3 found = clamp(sum.rgb, max(low - margin, vec3(0.0)), high + margin);
    if (!all) found = few.a > 0.0 ? few.rgb / few.a : vec3(0.0);
    imageStore(light, texelOf(seam), few.a > 0.0 ? vec4(found, seam.island) : vec4(0.0));
}
