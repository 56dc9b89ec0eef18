// What share of uniform light the sheen lobe reflects (lib/sheen.glsl), shared by C++ and GLSL.
#ifndef CUTIS_SHARED_SHEEN_H
#define CUTIS_SHARED_SHEEN_H
#include "shared/interop.h"
#ifdef __cplusplus
#include <cmath>
#endif
CUTIS_SHARED_BEGIN

// Below this the lobe is nothing but an edge, and E no longer falls smoothly.
const float SHEEN_LEAST_ROUGHNESS = 0.1f;

// E(μ, r) = ∫ f (N·L) dω at N·V = μ of a lobe of colour 1; above 1 at grazing angles, where the lobe is scaled by 1/E.
// The half-vector farthest from the normal has sin²θ = (1 + sinθ_v) / 2, where the distribution is that to the power
// 1/2α, α = r²; what is left is smooth, a polynomial fitted to quadrature (reference/layers.h): to 0.022 at the worst,
// 0.012 rms, over r from 0.1 to 1.
CUTIS_SHARED_FUNCTION float sheenAlbedo(float mu, float roughness) {
#ifdef __cplusplus
    using std::exp, std::log, std::sqrt;
#endif
    float r = roughness < SHEEN_LEAST_ROUGHNESS ? SHEEN_LEAST_ROUGHNESS : roughness;
    float m = mu < 0.0f ? 0.0f : mu > 1.0f ? 1.0f : mu;
    float a = 1.2107f + r * (-6.9137f + r * (10.6234f - r * 4.9793f));
    float b = -17.4491f + r * (58.358f + r * (-76.625f + r * 33.2325f));
    float c = 18.9221f + r * (-76.4623f + r * (105.5077f - r * 46.9462f));
    float farthest = 0.5f * (1.0f + sqrt(1.0f - m * m));
    return exp(log(farthest) / (2.0f * r * r) + a + m * (b + m * c));
}

CUTIS_SHARED_END
#endif
