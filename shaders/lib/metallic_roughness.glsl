// glTF's metallic-roughness model (glTF 2.0, appendix B): GGX with height-correlated Smith masking, Schlick Fresnel.
#ifndef CUTIS_METALLIC_ROUGHNESS_GLSL
#define CUTIS_METALLIC_ROUGHNESS_GLSL

// Fresnel between f0 at normal incidence and f90 at grazing angles.
vec3 schlick(vec3 f0, vec3 f90, float cosine) {
    float x = clamp(1.0 - cosine, 0.0, 1.0), x2 = x * x;
    return f0 + (f90 - f0) * (x2 * x2 * x);
}
float schlick(float f0, float f90, float cosine) {
    float x = clamp(1.0 - cosine, 0.0, 1.0), x2 = x * x;
    return f0 + (f90 - f0) * (x2 * x2 * x);
}

// D · G / (4 (N·L)(N·V)). alpha: roughness squared. N·H comes through the cross product: 1 - (N·H)² has no digits
// left for a mirror.
float ggxVisibilityDistribution(vec3 n, vec3 v, vec3 l, vec3 h, float alpha) {
    float nl = max(dot(n, l), 1e-4), nv = max(dot(n, v), 1e-4), nh = max(dot(n, h), 0.0);
    float a2 = alpha * alpha;
    vec3 across = cross(n, h);
    float k = dot(across, across) + nh * nh * a2;
    float d = a2 / (3.14159265358979 * k * k);
    float smith = nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2);
    return d * 0.5 / smith;
}

#endif
