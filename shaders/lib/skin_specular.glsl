// Specular reflection of skin (DESIGN §1.2), the twin of renderer/skin/specular.h, where the equations are derived.
//
// For the tables of shared/albedo_table.h, declare a storage buffer of floats, SKIN_TABLE_STRIDE for each roughness, and,
// before including this file, how to read value i of it:  #define ALBEDO_TABLE(i) albedoTable[i]
#ifndef CUTIS_SKIN_SPECULAR_GLSL
#define CUTIS_SKIN_SPECULAR_GLSL

#include "shared/albedo_table.h"

const float kSkinF0 = 0.028;
const float kMinSkinRoughness = 1e-3;

// D at tan²θ and cosθ of the half-vector, 1/sr. Taking tan² apart from cos keeps narrow lobes exact in float32, where
// 1 - cos²θ has no digits left.
float beckmannDistribution(float tan2, float cosTheta, float m) {
    float m2 = m * m;
    float exponent = tan2 / m2;
    if (!(cosTheta > 0.0) || !(exponent < 80.0)) return 0.0;  // 1/cos⁴ may overflow where exp underflows
    float cos2 = cosTheta * cosTheta;
    return exp(-exponent) / (3.14159265358979 * m2 * cos2 * cos2);
}

float schlickFresnel(float cosTheta, float f0) {
    float x = clamp(1.0 - cosTheta, 0.0, 1.0);
    float x2 = x * x;
    return f0 + (1.0 - f0) * x2 * x2 * x;
}

// f_s at specular scale 1, in 1/sr: D(N·H) F(V·H) / (h·h), h = L + V not normalised. Unit vectors away from the surface;
// 0 unless V and L are both above it.
float kelemenSpecular(vec3 N, vec3 V, vec3 L, float m) {
    vec3 h = L + V;
    float hh = dot(h, h);
    if (!(dot(N, L) > 0.0) || !(dot(N, V) > 0.0) || !(hh > 1e-12)) return 0.0;
    float len = sqrt(hh);
    vec3 H = h / len;
    float cosTheta = dot(N, H);
    vec3 across = cross(N, H);
    float tan2 = dot(across, across) / max(cosTheta * cosTheta, 1e-20);
    return beckmannDistribution(tan2, cosTheta, max(m, kMinSkinRoughness)) * schlickFresnel(0.5 * len, kSkinF0) / hh;
}

// min(s, 1/ρ_dt): what to scale f_s and ρ_dt by, so that s·ρ_dt never exceeds 1.
float clampedSpecularScale(float s, float albedo) {
    return s * albedo > 1.0 ? 1.0 / albedo : s;
}

#ifdef ALBEDO_TABLE
// ρ_dt(μ, m) of the row of roughness m: linear interpolation in √μ.
float directionalAlbedo(float mu, uint row) {
    float x = sqrt(clamp(mu, 0.0, 1.0)) * float(ALBEDO_ROW_SIZE - 1);
    uint i = min(uint(x), uint(ALBEDO_ROW_SIZE - 2));
    uint at = row * uint(SKIN_TABLE_STRIDE) + i;
    return mix(ALBEDO_TABLE(at), ALBEDO_TABLE(at + 1u), x - float(i));
}

// 1 - s·ρ_dt, in [0,1].
float transmittedFraction(float mu, float s, uint row) {
    return 1.0 - clamp(s * directionalAlbedo(mu, row), 0.0, 1.0);
}
#endif

#endif
