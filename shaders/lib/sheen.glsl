// The sheen of KHR_materials_sheen: microfacets that stand up from the surface (Estevez & Kulla, "Production Friendly
// Microfacet Sheen BRDF", 2017), with their distribution and their masking.
#ifndef CUTIS_SHEEN_GLSL
#define CUTIS_SHEEN_GLSL

#include "shared/sheen.h"

// Their fit L(x) of the masking; t = (1 - α)².
float sheenMaskingFit(float x, float t) {
    float a = mix(21.5473, 25.3245, t), b = mix(3.82987, 3.32435, t), c = mix(0.19823, 0.16801, t);
    return a / (1.0 + b * pow(x, c)) + mix(-1.97760, -1.27393, t) * x + mix(-4.32054, -4.85967, t);
}

float sheenMasking(float cosine, float alpha) {
    float t = (1.0 - alpha) * (1.0 - alpha);
    return exp(cosine < 0.5 ? sheenMaskingFit(cosine, t)
                            : 2.0 * sheenMaskingFit(0.5, t) - sheenMaskingFit(max(1.0 - cosine, 0.0), t));
}

// D · V at colour 1, in 1/sr, scaled so that it reflects no more than arrives.
float sheenLobe(vec3 n, vec3 v, vec3 l, float roughness) {
    float r = max(roughness, SHEEN_LEAST_ROUGHNESS), alpha = r * r;
    float nl = max(dot(n, l), 1e-4), nv = max(dot(n, v), 1e-4);
    vec3 h = normalize(l + v), across = cross(n, h);
    float d = (2.0 + 1.0 / alpha) * pow(min(dot(across, across), 1.0), 0.5 / alpha) / (2.0 * 3.14159265358979);
    float shown = 1.0 / ((1.0 + sheenMasking(nv, alpha) + sheenMasking(nl, alpha)) * 4.0 * nv * nl);
    return d * shown / max(sheenAlbedo(nv, roughness), 1.0);
}

#endif
