#version 460
// One direction of one Gaussian of the blur chain: takes the texture from variance v_{k-1} to v_k along one column of
// the Cholesky factor of the texel's covariance (DESIGN §1.4). Two dispatches, axis 0 then axis 1, make one level.
//
// A normalised convolution within the texel's own UV island: other texels have weight 0. The kernel is a sampled
// Gaussian whose discrete variance is corrected to be the continuous one exactly, so a chain of them has the
// profile's second moment however coarse the texels.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/atlas_tiles.h"
#include "shared/scene.h"

layout(local_size_x = 256) in;

layout(constant_id = 0) const uint SHIFT = 0;  // the level's resolution is 1/2^SHIFT of the atlas'
layout(constant_id = 1) const uint FINER = 1;  // what it is made from had so many times that

layout(binding = 0) uniform texture2D source;   // rgb; a: island, 0 where uncovered
layout(binding = 1) uniform texture2D stretch;  // a, b, c in texels of this level per millimetre; w: island
layout(binding = 2, rgba32f) writeonly uniform image2D target;

layout(binding = 3, scalar) readonly buffer GaussianBuffer { GaussianTerm gaussians[]; };

layout(push_constant, scalar) uniform Push {
    TilePush tiles;
    uint level;  // k
    int axis;    // 0: first column (a, b), 1: second column (0, c)
} push;

#include "lib/atlas_tiles.glsl"
#include "lib/blur_reach.glsl"

// A symmetric kernel of 2·count + 1 taps, `step` texels apart along the axis on which the direction is longest. Its weights,
// proportional to q^(i²) and each made from the one before, sum to 1, so that no sum of light is larger than the light.
struct Kernel {
    int count;
    int step;
    float q;
    float centre;      // weight
    float correction;  // moved from the centre to each first neighbour
};

// sigma: standard deviation in texels; smoothness: that of the source.
Kernel makeKernel(float sigma, float smoothness) {
    Kernel k;
    k.step = tapStep(sigma, smoothness);
    float taps = sigma / float(k.step);
    k.count = tapCount(taps);
    float variance = taps * taps;
    k.q = exp(-0.5 / max(variance, 1e-6));
    float sum = 1.0, moment = 0.0, weight = 1.0, ratio = k.q;
    for (int i = 1; i <= k.count; ++i) {
        weight *= ratio;
        ratio *= k.q * k.q;
        sum += 2.0 * weight;
        moment += 2.0 * weight * float(i * i);
    }
    k.centre = 1.0 / sum;
    k.correction = 0.5 * (variance - moment / sum);
    return k;
}

// Weights of a kernel, from its centre outwards.
struct Weights {
    float plain, ratio;
};

float firstWeight(Kernel k, out Weights w) {
    w = Weights(k.centre, k.q);
    return k.centre - 2.0 * k.correction;
}

// Of tap i, from 1 on.
float nextWeight(Kernel k, int i, inout Weights w) {
    w.plain *= w.ratio;
    w.ratio *= k.q * k.q;
    return i == 1 ? w.plain + k.correction : w.plain;
}

// Variance that linear interpolation between texels adds across the direction of the taps.
float interpolationVariance(Kernel k, float slope) {
    Weights w;
    firstWeight(k, w);
    float variance = 0.0;
    for (int i = 1; i <= k.count; ++i) {
        float f = fract(float(i * k.step) * slope);
        variance += 2.0 * nextWeight(k, i, w) * f * (1.0 - f);
    }
    return variance;
}

vec4 accumulated;
ivec2 chartLow, chartHigh;  // texels

void addTap(ivec2 at, float weight, float island) {
    if (any(lessThan(at, chartLow)) || any(greaterThanEqual(at, chartHigh))) return;
    vec4 value = texelFetch(source, at, 0);
    if (value.a == island) accumulated += vec4(value.rgb, 1.0) * weight;
}

void main() {
    ivec2 texel;
    uint tile;
    if (!tileBlock(SHIFT, texel, tile)) return;
    AtlasChart chart = TILE_CHART;
    if (push.level >= chart.blurredCount) return;
    chartLow = ivec2(chart.rect.xy >> SHIFT);
    chartHigh = ivec2((chart.rect.xy + chart.rect.zw + (1u << SHIFT) - 1u) >> SHIFT);
    float previous = push.level > 0u ? gaussians[chart.firstGaussian + push.level - 1u].variance : 0.0;  // v_{k-1}, mm²
    float variance = gaussians[chart.firstGaussian + push.level].variance - previous;
    vec4 factor = texelFetch(stretch, texel, 0);
    if (factor.w == 0.0) {
        imageStore(target, texel, vec4(0.0));
        return;
    }
    // Covariance of the Gaussian in texels, per mm²: (JᵀJ)⁻¹ = L·Lᵀ.
    vec3 perMm = vec3(factor.x * factor.x, factor.x * factor.y, factor.y * factor.y + factor.z * factor.z);
    vec2 before, after;
    levelVariance(perMm.xz, previous, previous + variance, float(FINER), before, after);
    vec2 added = after - before;
    float mixed = perMm.y * variance;
    mixed = clamp(mixed, -sqrt(added.x * added.y), sqrt(added.x * added.y));
    // Columns (a, b) and (0, c) of the Cholesky factor of what is added.
    float a = sqrt(added.x), b = a > 0.0 ? mixed / a : 0.0;
    // The first column is skew: its taps fall between texels. What interpolation adds to the variance there is taken
    // off again: from the second column where it lies along v, from the first where it lies along u.
    bool steep = abs(b) > abs(a);
    float slope = steep ? a / b : a > 0.0 ? b / a : 0.0;
    float sigma1 = max(a, abs(b));
    float smoothness1 = sqrt(steep ? before.y : before.x), smoothness2 = sqrt(before.y);
    float sigma2 = sqrt(max(added.y - b * b, 0.0));
    bool skew = abs(slope) > 1e-3;
    if (skew) {
        float excess = interpolationVariance(makeKernel(sigma1, smoothness1), slope);
        if (!steep) {
            sigma2 = sqrt(max(sigma2 * sigma2 - excess, 0.0));
        } else {
            // Σ_uu shrinks by the excess; the factor of what is left keeps Σ_uv and Σ_vv.
            a = sqrt(max(added.x - excess, 1e-8));
            b = min(abs(mixed) / a, sqrt(added.y));
            sigma1 = b;
            slope = sign(slope) * a / max(b, 1e-6);
            sigma2 = sqrt(max(added.y - b * b, 0.0));
        }
    }
    Kernel k = push.axis == 0 ? makeKernel(sigma1, smoothness1) : makeKernel(sigma2, smoothness2);
    Weights weights;
    vec4 own = texelFetch(source, texel, 0);
    accumulated = vec4(own.rgb, 1.0) * firstWeight(k, weights);
    if (push.axis == 0 && skew) {
        for (int i = 1; i <= k.count; ++i) {
            float weight = nextWeight(k, i, weights);
            int along = i * k.step;
            float across = float(along) * slope;
            int cell = int(floor(across));
            float f = across - float(cell);
            for (int side = -1; side <= 1; side += 2) {
                ivec2 near = side * (steep ? ivec2(cell, along) : ivec2(along, cell));
                ivec2 next = side * (steep ? ivec2(1, 0) : ivec2(0, 1));
                addTap(texel + near, weight * (1.0 - f), factor.w);
                if (f > 0.0) addTap(texel + near + next, weight * f, factor.w);
            }
        }
    } else {
        // Along an axis of the atlas no tap falls between texels.
        ivec2 along = push.axis == 0 && !steep ? ivec2(k.step, 0) : ivec2(0, k.step);
        for (int i = 1; i <= k.count; ++i) {
            float weight = nextWeight(k, i, weights);
            addTap(texel + i * along, weight, factor.w);
            addTap(texel - i * along, weight, factor.w);
        }
    }
    // The centre tap belongs to the island, so there is weight to divide by, unless it was corrected away.
    vec3 value = accumulated.a > 1e-6 ? accumulated.rgb / accumulated.a : own.rgb;
    imageStore(target, texel, vec4(value, factor.w));
}
