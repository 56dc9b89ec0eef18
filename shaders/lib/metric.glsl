// The shape of a millimetre in texels.
#ifndef CUTIS_METRIC_GLSL
#define CUTIS_METRIC_GLSL

// (JᵀJ)⁻¹ = L·Lᵀ with L = ((a, 0), (b, c)), in texels per millimetre. G is JᵀJ. The ratio of G's eigenvalues is
// bounded: a needle of a triangle (or one without area) has no meaningful direction of its own.
vec3 inverseMetricFactor(vec3 g) {
    const float kMaxStretch = 1e4;
    float mean = 0.5 * (g.x + g.z);
    if (!(mean > 0.0)) return vec3(0.0);
    float radius = length(vec2(0.5 * (g.x - g.z), g.y));
    float smallest = mean - radius, floorValue = (mean + radius) / kMaxStretch;
    if (smallest < floorValue) g.xz += floorValue - smallest;
    float det = g.x * g.z - g.y * g.y;
    float a = sqrt(g.z / det);
    return vec3(a, -g.y / (det * a), inversesqrt(g.z));
}

#endif
