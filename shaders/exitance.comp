#version 460
// Radiant exitance M of the skin at each texel: the blurred levels weighted by the profile, and, where light arrives
// from behind, the levels at its entry point weighted by what the thickness lets through (DESIGN §1.4).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
// features: TRANSLUCENCY BYTE_THICKNESS(TRANSLUCENCY) FULL HALF QUARTER
#include "shared/atlas_tiles.h"
#include "shared/scene.h"
#include "lib/octahedral.glsl"

layout(local_size_x = 256) in;

// Levels of the atlas' resolution, of half and of a quarter of it, a layer each: rgb; a: island, 0 where uncovered.
#ifdef FULL
layout(binding = 0) uniform texture2DArray levels;
#endif
#ifdef HALF
layout(binding = 8) uniform texture2DArray halfLevels;
#endif
#ifdef QUARTER
layout(binding = 9) uniform texture2DArray quarterLevels;
#endif
layout(binding = 1, scalar) readonly buffer GaussianBuffer { GaussianTerm gaussians[]; };
layout(binding = 2, rgba32f) writeonly uniform image2D exitance;  // rgb: M; a: island, 0 where uncovered
layout(binding = 10, scalar) buffer NonfiniteBuffer { uint nonfinite; };  // values
#ifdef TRANSLUCENCY
layout(binding = 3) uniform texture2D entry;     // xy: texels, x < 0: none; z: thickness, mm
layout(binding = 6) uniform texture2D position;  // metres
layout(binding = 7) uniform texture2D normal;
#endif
layout(binding = 5) uniform texture2D stretch;

layout(push_constant, scalar) uniform Push {
    TilePush tiles;
    uint firstHalf, firstQuarter;  // level that has at most this resolution
} push;

#include "lib/atlas_tiles.glsl"

// A level between its texels, blended over those of one island; `otherwise` where there are none.
vec3 levelAt(texture2DArray image, vec2 place, uint layer, float island, vec3 otherwise) {
    ivec2 last = textureSize(image, 0).xy - 1;
    vec2 grid = place - 0.5;
    ivec2 base = ivec2(floor(grid));
    vec2 f = grid - vec2(base);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        vec4 value = texelFetch(image, ivec3(clamp(base + offset, ivec2(0), last), layer), 0);
        float w = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
        if (value.a == island) sum += vec4(value.rgb, 1.0) * w;
    }
    return sum.a > 1e-3 ? sum.rgb / sum.a : otherwise;
}

#ifdef TRANSLUCENCY
// Length in mm of a step between two texels of one island, by the metric at one of them: |L⁻¹ d| with (JᵀJ)⁻¹ = L·Lᵀ.
float stepLength(vec2 d, vec3 factor) {
    float x = d.x / factor.x;
    return length(vec2(x, (d.y - factor.y * x) / factor.z));
}

vec2 place;       // texel at which light enters
float thickness;  // mm
float apart;      // mm from there, over the surface
float entryIsland;

// Share of a level at the entry point that shines through.
float shareThrough(float variance) {
    float away = clamp(apart / (6.0 * sqrt(variance)), 0.0, 1.0);
    return exp(-thickness * thickness / (2.0 * variance)) * away * away * (3.0 - 2.0 * away);
}
#endif

vec3 sum = vec3(0.0);
// The level before, at this texel and at the entry point: what stands where a coarser one has no texel of the island.
vec3 here, there;

// Levels first ≤ k < end of an image, texels of which are `scale` of the atlas'.
void addLevels(texture2DArray image, uint first, uint end, float scale, ivec2 texel, float island, AtlasChart chart) {
    for (uint k = first; k < min(end, chart.gaussianCount); ++k) {
        GaussianTerm term = gaussians[chart.firstGaussian + k];
        if (scale == 1.0) here = texelFetch(image, ivec3(texel, k - first), 0).rgb;
        else here = levelAt(image, (vec2(texel) + 0.5) * scale, k - first, island, here);
        sum += term.weight * here;
#ifdef TRANSLUCENCY
        // Wide Gaussians have the light from behind in their sum.
        float through = k < chart.blurredCount ? shareThrough(term.variance) : 0.0;
        if (through > 1e-6) {
            there = levelAt(image, place * scale, k - first, entryIsland, there);
            sum += term.weight * through * there;
        }
#endif
    }
}

void main() {
    ivec2 texel;
    uint tile;
    if (!tileBlock(0u, texel, tile)) return;
    AtlasChart chart = TILE_CHART;
    vec4 factor = texelFetch(stretch, texel, 0);
    float island = factor.w;
    if (island == 0.0) {
        imageStore(exitance, texel, vec4(0.0));
        return;
    }
#ifdef TRANSLUCENCY
    vec4 found = texelFetch(entry, texel, 0);
    place = found.xy;
    thickness = found.z;
#ifdef BYTE_THICKNESS
    // d'Eon & Luebke 2007, §14.5.3: exp(-20 t) in 8 bits, t in units of 100 mm. Nothing (0) is infinitely thick.
    float stored = round(255.0 * exp(-0.2 * thickness)) / 255.0;
    thickness = stored > 0.0 ? -5.0 * log(stored) : 60000.0;
#endif
    apart = 0.0;  // lets nothing through
    entryIsland = 0.0;
    there = vec3(0.0);
    if (place.x >= 0.0 && thickness < 60000.0) {
        // How far the entry point lies over the surface: light from nearby is in the local levels already.
        ivec2 entryTexel = ivec2(place);
        vec4 entryFactor = texelFetch(stretch, entryTexel, 0);
        entryIsland = entryFactor.w;
        if (entryIsland == island) {
            vec2 d = place - (vec2(texel) + 0.5);
            apart = 0.5 * (stepLength(d, factor.xyz) + stepLength(d, entryFactor.xyz));
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
    }
#endif
    here = vec3(0.0);
#ifdef FULL
    addLevels(levels, 0u, push.firstHalf, 1.0, texel, island, chart);
#endif
#ifdef HALF
    addLevels(halfLevels, push.firstHalf, push.firstQuarter, 0.5, texel, island, chart);
#endif
#ifdef QUARTER
    addLevels(quarterLevels, push.firstQuarter, chart.gaussianCount, 0.25, texel, island, chart);
#endif
    imageStore(exitance, texel, vec4(sum, island));
    // By their bits: compilers may take isnan and isinf to be false.
    bvec3 bad = equal(floatBitsToUint(sum) & 0x7f800000u, uvec3(0x7f800000u));
    if (any(bad)) atomicAdd(nonfinite, uint(bad.x) + uint(bad.y) + uint(bad.z));
}
