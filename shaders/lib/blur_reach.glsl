// How far diffusion.comp reads, at the most.
#ifndef CUTIS_BLUR_REACH_GLSL
#define CUTIS_BLUR_REACH_GLSL

layout(constant_id = 2) const int MAX_TAPS = 12;  // on either side; where a Gaussian is wider, they lie farther apart
const float kReach = 3.5;  // standard deviations
// Variance, in texels², that bilinear lookup adds along each axis: ∫ f (1 - f) df.
const float kLookupVariance = 1.0 / 6.0;

// Texels between the taps of a kernel of standard deviation `sigma` over a source smooth over `smoothness`, both in texels: a
// source that is smooth over σ_s can be sampled every σ_s, since what would alias is below exp(-2π²).
int tapStep(float sigma, float smoothness) {
    return max(max(int(smoothness), 1), int(ceil(sigma * kReach / (float(MAX_TAPS) + 0.5))));
}

// Taps on either side; sigma: standard deviation in taps. What is cut off is beyond three of them, below 2e-4 of the weight.
int tapCount(float sigma) { return clamp(int(sigma * kReach + 0.5), 1, MAX_TAPS); }

// How far such a kernel reaches; sigma and smoothness not below those of any texel. Its last tap lies within kReach·σ and half
// a step, where it has more than one.
float kernelReach(float sigma, float smoothness) {
    float step = float(tapStep(sigma, smoothness));
    return step == 1.0 ? float(tapCount(sigma)) : max(floor(sigma * kReach + 0.5 * step), step);
}

// Variances of a level's texture, in its texels² along two axes, before and after its blur from `previous` to `next` mm²; perMm:
// those of a Gaussian of 1 mm². Whoever looks a level up between texels adds kLookupVariance to it, so the texture has that
// much less, and is left as it is while it would be below nothing. What the level is made from is `finer` times as fine: there a lookup
// adds less, and the mean over finer² of its texels adds the variance of a box.
void levelVariance(vec2 perMm, float previous, float next, float finer, out vec2 before, out vec2 after) {
    float ratio = finer * finer;
    before = max(previous * perMm - kLookupVariance / ratio, 0.0) + (ratio - 1.0) / (12.0 * ratio);
    after = max(next * perMm - kLookupVariance, before);
}

// Texels of a level along u and v that are read away from a texel by one direction (diffusion.comp's axis) of its blur.
// perMm: covariance in texels² of a Gaussian of 1 mm², along u, along v and between them, not below that of any texel.
ivec2 blurReach(vec3 perMm, float previous, float next, float finer, uint axis) {
    vec2 before, after;
    levelVariance(perMm.xy, previous, next, finer, before, after);
    float added = next - previous;
    vec2 sigma = sqrt(min(after, added * perMm.xy));
    if (sigma.x == 0.0 && sigma.y == 0.0) return ivec2(0);
    vec2 smoothness = sqrt(before);
    if (axis == 1u) return ivec2(0, int(min(kernelReach(sigma.y, smoothness.y), 1e6)));
    vec2 along = vec2(kernelReach(sigma.x, smoothness.x), 0.0);
    if (perMm.z > 0.0) {
        // Skew taps end within the same distances, and fall between two texels across their direction.
        along = vec2(kernelReach(sigma.x, max(smoothness.x, smoothness.y)),
                     kernelReach(sigma.y, max(smoothness.x, smoothness.y))) + 1.0;
    }
    return ivec2(min(along, 1e6));
}

#endif
