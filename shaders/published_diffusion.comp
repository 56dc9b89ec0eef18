#version 460
// One direction of one Gaussian of the blur chain as d'Eon & Luebke 2007 print it (GPU Gems 3, §14.4.3), for
// comparison with diffusion.comp: seven fixed taps, as far apart as the Gaussian's standard deviation times the
// stretch along u or v. None of diffusion.comp's corrections is here. Two dispatches, axis 0 then axis 1, make one level.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/atlas_tiles.h"
#include "shared/scene.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform texture2D source;   // rgb; a: island, 0 where uncovered
layout(binding = 1) uniform texture2D stretch;  // a, b, c in texels per millimetre; w: island
layout(binding = 2, rgba32f) writeonly uniform image2D target;

layout(binding = 3, scalar) readonly buffer GaussianBuffer { GaussianTerm gaussians[]; };

layout(push_constant, scalar) uniform Push {
    TilePush tiles;
    uint level;  // k
    int axis;    // 0: along u, 1: along v
} push;

#include "lib/atlas_tiles.glsl"

// As printed. They sum to 1.001, and their variance is 1.08 times that of the Gaussian.
const float kCurve[7] = float[](0.006, 0.061, 0.242, 0.383, 0.242, 0.061, 0.006);

// Bilinear, as the texture unit of the listing. rgb: light; a: share of the four texels that hold skin.
vec4 tapAt(vec2 place, ivec2 low, ivec2 high) {
    vec2 grid = place - 0.5;
    ivec2 base = ivec2(floor(grid));
    vec2 f = grid - vec2(base);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec2 at = base + offset;
        if (any(lessThan(at, low)) || any(greaterThanEqual(at, high))) continue;
        vec4 value = texelFetch(source, at, 0);
        float w = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
        if (value.a != 0.0) sum += vec4(value.rgb, 1.0) * w;
    }
    return sum;
}

void main() {
    ivec2 texel;
    uint tile;
    if (!tileTexel(texel, tile)) return;
    AtlasChart chart = TILE_CHART;
    if (push.level >= chart.gaussianCount) return;
    ivec2 low = ivec2(chart.rect.xy), high = low + ivec2(chart.rect.zw);
    float previous = push.level > 0u ? gaussians[chart.firstGaussian + push.level - 1u].variance : 0.0;
    float variance = gaussians[chart.firstGaussian + push.level].variance - previous;
    vec4 factor = texelFetch(stretch, texel, 0);
    if (factor.w == 0.0) {
        imageStore(target, texel, vec4(0.0));
        return;
    }
    // Texels per millimetre along u and along v: 1/|dP/du| and 1/|dP/dv|. With (JᵀJ)⁻¹ = L·Lᵀ and L = ((a, 0), (b, c)),
    // |dP/du|² = (b² + c²)/(ac)² and |dP/dv|² = 1/c².
    float perMm = push.axis == 0 ? factor.x * factor.z / length(factor.yz) : factor.z;
    vec2 spacing = sqrt(variance) * perMm * (push.axis == 0 ? vec2(1, 0) : vec2(0, 1));
    vec2 centre = vec2(texel) + 0.5;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 7; ++i) sum += kCurve[i] * tapAt(centre + float(i - 3) * spacing, low, high);
    // §14.5.2 fades scattering out beside seams, where taps meet texels without skin: what those miss is local light.
    vec3 own = texelFetch(source, texel, 0).rgb;
    imageStore(target, texel, vec4(sum.rgb + max(1.0 - sum.a, 0.0) * own, factor.w));
}
