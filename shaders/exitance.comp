#version 460
// Radiant exitance M of the skin at each texel: the blurred levels weighted by the profile, and, where light arrives
// from behind, the levels at its entry point weighted by what the thickness lets through (DESIGN §1.4).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
// features: TRANSLUCENCY BYTE_THICKNESS(TRANSLUCENCY)
#include "shared/atlas_tiles.h"
#include "shared/scene.h"
#include "lib/octahedral.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2DArray levels;  // a layer a Gaussian: rgb; a: island, 0 where uncovered
layout(binding = 1, scalar) readonly buffer GaussianBuffer { GaussianTerm gaussians[]; };
layout(binding = 2, rgba32f) writeonly uniform image2D exitance;  // rgb: M; a: island, 0 where uncovered
#ifdef TRANSLUCENCY
layout(binding = 3) uniform texture2D entry;     // xy: texels, x < 0: none; z: thickness, mm
layout(binding = 5) uniform texture2D stretch;
layout(binding = 6) uniform texture2D position;  // metres
layout(binding = 7) uniform texture2D normal;
#endif

layout(push_constant, scalar) uniform Push {
    TilePush tiles;
} push;

#include "lib/atlas_tiles.glsl"
#ifdef TRANSLUCENCY
// Length in mm of a step between two texels of one island, by the metric at one of them: |L⁻¹ d| with (JᵀJ)⁻¹ = L·Lᵀ.
float stepLength(vec2 d, vec3 factor) {
    float x = d.x / factor.x;
    return length(vec2(x, (d.y - factor.y * x) / factor.z));
}

// A level at a place between texels, blended over covered texels of the entry point's own island.
vec3 levelAt(vec2 place, int layer) {
    ivec2 size = textureSize(levels, 0).xy;
    vec2 grid = place - 0.5;
    ivec2 base = ivec2(floor(grid));
    vec2 f = grid - vec2(base);
    float island = texelFetch(levels, ivec3(clamp(ivec2(place), ivec2(0), size - 1), layer), 0).a;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        vec4 value = texelFetch(levels, ivec3(clamp(base + offset, ivec2(0), size - 1), layer), 0);
        float w = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
        if (value.a == island) sum += vec4(value.rgb, 1.0) * w;
    }
    return sum.a > 0.0 ? sum.rgb / sum.a : vec3(0.0);
}
#endif

void main() {
    ivec2 texel;
    uint tile;
    if (!tileTexel(texel, tile)) return;
    AtlasChart chart = TILE_CHART;
    float island = texelFetch(levels, ivec3(texel, 0), 0).a;
    if (island == 0.0) {
        imageStore(exitance, texel, vec4(0.0));
        return;
    }
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < chart.gaussianCount; ++k) {
        sum += gaussians[chart.firstGaussian + k].weight * texelFetch(levels, ivec3(texel, int(k)), 0).rgb;
    }
#ifdef TRANSLUCENCY
    vec4 found = texelFetch(entry, texel, 0);
    vec2 place = found.xy;
    float thickness = found.z;
#ifdef BYTE_THICKNESS
    // d'Eon & Luebke 2007, §14.5.3: exp(-20 t) in 8 bits, t in units of 100 mm. Nothing (0) is infinitely thick.
    float stored = round(255.0 * exp(-0.2 * thickness)) / 255.0;
    thickness = stored > 0.0 ? -5.0 * log(stored) : 60000.0;
#endif
    if (place.x >= 0.0 && thickness < 60000.0) {
        // How far the entry point lies over the surface: light from nearby is in the local levels already.
        ivec2 entryTexel = ivec2(place);
        vec4 here = texelFetch(stretch, texel, 0), there = texelFetch(stretch, entryTexel, 0);
        float apart;
        if (here.w == there.w) {
            vec2 d = place - (vec2(texel) + 0.5);
            apart = 0.5 * (stepLength(d, here.xyz) + stepLength(d, there.xyz));
        } else {
            // Between islands the atlas measures nothing. A face that looks the other way is another side of the
            // body; one that looks the same way lies just across a seam, about as far as the straight line.
            vec3 n = decodeOctahedral(texelFetch(normal, texel, 0).xy);
            vec3 entryNormal = decodeOctahedral(texelFetch(normal, entryTexel, 0).xy);
            apart = dot(n, entryNormal) < 0.0
                        ? 1e30
                        : chart.mmPerUnit * distance(texelFetch(position, texel, 0).xyz,
                                                    texelFetch(position, entryTexel, 0).xyz);
        }
        for (uint k = 0u; k < chart.gaussianCount; ++k) {
            GaussianTerm term = gaussians[chart.firstGaussian + k];
            float away = clamp(apart / (6.0 * sqrt(term.variance)), 0.0, 1.0);
            float through = exp(-thickness * thickness / (2.0 * term.variance)) * away * away * (3.0 - 2.0 * away);
            if (through > 1e-6) sum += term.weight * through * levelAt(place, int(k));
        }
    }
#endif
    imageStore(exitance, texel, vec4(sum, island));
}
