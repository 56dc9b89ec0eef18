// Light from the environment (DESIGN §1.1, §1.2): lookups into the maps of renderer/passes/environment.h, turned and
// scaled at run time.
//
// The includer declares, before this file,
//   samplerCube environmentIrradiance, environmentRadiance;   (only the latter with ENVIRONMENT_SPECULAR_ONLY)
//   EnvironmentSettingsData environment;                    (shared/scene.h)
//   float environmentVisibility(vec3 direction);            (share of the light from there that arrives)
// and, for skin, ALBEDO_TABLE as lib/skin_specular.glsl wants it.
#ifndef CUTIS_ENVIRONMENT_GLSL
#define CUTIS_ENVIRONMENT_GLSL

#include "shared/environment.h"
#include "lib/sampling.glsl"
#include "lib/skin_specular.glsl"

// The world's direction in the environment's own frame: the environment is turned by the angle counter-clockwise about
// +Y, so the lookup turns back.
vec3 toEnvironment(vec3 d) {
    return vec3(environment.cosRotation * d.x - environment.sinRotation * d.z, d.y,
                environment.sinRotation * d.x + environment.cosRotation * d.z);
}

#ifndef ENVIRONMENT_SPECULAR_ONLY
// ∫ L (N·ω) dω over the upper hemisphere, nothing occluded.
vec3 environmentIrradianceAt(vec3 n) {
    return textureLod(environmentIrradiance, toEnvironment(n), 0.0).rgb * environment.intensity;
}
#endif

// Level of the radiance cube whose lobe has that σ in radians: between two levels by variance.
float environmentLevel(float sigma) {
    float x = max(log2(sigma / ENVIRONMENT_SPREAD), 0.0), whole = floor(x);
    float low = ENVIRONMENT_SPREAD * exp2(whole), high = 2.0 * low;
    if (whole < 1.0) {
        whole = 0.0;
        low = ENVIRONMENT_SPREAD_0;
        high = 2.0 * ENVIRONMENT_SPREAD;
    }
    float f = (sigma * sigma - low * low) / (high * high - low * low);
    return min(whole + clamp(f, 0.0, 1.0), float(ENVIRONMENT_LEVELS - 1u));
}

// Radiance from around a direction, averaged over a lobe of σ radians; level 0 for the environment as it is.
vec3 environmentRadianceAt(vec3 direction, float level) {
    return textureLod(environmentRadiance, toEnvironment(direction), level).rgb * environment.intensity;
}

// Reflected radiance of a GGX surface (glTF metallic-roughness): filtered importance sampling (Křivánek & Colbert 2008)
// with `alpha` = roughness². Half-vectors at quantiles of D cosθ; each tap's lobe has the area that it stands for.
vec3 environmentSpecularGgx(vec3 n, vec3 v, float alpha, vec3 f0) {
    const int kTaps = 16;
    mat3 frame = frameAlong(n, v);
    float nv = max(dot(n, v), 1e-3), a2 = alpha * alpha;
    vec3 sum = vec3(0.0);
    for (int k = 0; k < kTaps; ++k) {
        vec2 u = spiralPoint(k, kTaps);
        float tan2 = a2 * u.x / (1.0 - u.x), cosine = inversesqrt(1.0 + tan2), sine = sqrt(tan2) * cosine;
        vec3 h = frame * vec3(sine * cos(u.y), sine * sin(u.y), cosine);
        float vh = dot(v, h);
        vec3 l = 2.0 * vh * h - v;
        float nl = dot(n, l);
        if (vh <= 0.0 || nl <= 0.0) continue;
        // f (N·L) / pdf, pdf = D (N·H) / (4 V·H): D cancels. Smith's height-correlated G.
        float smith = nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2);
        float weight = 2.0 * nl * vh / (smith * cosine);
        float k2 = 1.0 + cosine * cosine * (a2 - 1.0);
        float pdf = a2 / (3.14159265358979 * k2 * k2) * cosine / (4.0 * vh);
        float sigma = min(sqrt(1.0 / (float(kTaps) * pdf * 4.0)), 0.5);
        float x = 1.0 - vh, x2 = x * x;
        vec3 fresnel = f0 + (1.0 - f0) * (x2 * x2 * x);
        sum += fresnel * (weight * environmentVisibility(l)) * environmentRadianceAt(l, environmentLevel(sigma));
    }
    return sum / float(kTaps);
}

#ifdef ALBEDO_TABLE
// Light through one lobe of the skin's table, `direction` in the columns of `frame`.
vec3 environmentLobe(mat3 frame, vec3 direction, float level) {
    vec3 l = frame * direction;
    return environmentVisibility(l) * environmentRadianceAt(l, level);
}

// Reflected radiance of skin, ∫ L f_s (N·ω) dω: `m` rms slope, `s` specular scale, `row` of the table of roughness m.
// The lobe f_s (N·ω) is the sum of smaller ones that renderer/skin/specular_lobes.h fits, between two rows of μ. Their
// weights sum to ρ_dt, so a uniform environment is reflected exactly.
vec3 environmentSpecularSkin(vec3 n, vec3 v, float m, float s, uint row) {
    float mu = clamp(dot(n, v), 1e-3, 1.0), sine = sqrt(1.0 - mu * mu);
    mat3 surface = frameAlong(n, v);
    mat3 frame = mat3(surface[0] * mu + n * sine, surface[1], n * mu - surface[0] * sine);  // z: mirror direction
    float x = sqrt(mu) * float(LOBE_ROWS - 1);
    uint j = min(uint(x), uint(LOBE_ROWS - 2));
    float f = x - float(j);
    uint at = row * uint(SKIN_TABLE_STRIDE) + uint(ALBEDO_ROW_SIZE) + j * uint(LOBE_ROW_SIZE);
    vec3 sum = vec3(0.0);
    float total = 0.0;
    for (int k = 0; k < LOBES_IN_PLANE + LOBE_PAIRS; ++k) {
        float lobe[LOBE_FLOATS];
        for (int i = 0; i < LOBE_FLOATS; ++i) {
            lobe[i] = mix(ALBEDO_TABLE(at), ALBEDO_TABLE(at + uint(LOBE_ROW_SIZE)), f);
            ++at;
        }
        vec3 direction = normalize(vec3(lobe[0], lobe[1], lobe[2]));
        float level = environmentLevel(lobe[3]);
        vec3 light = environmentLobe(frame, direction, level);
        if (k >= LOBES_IN_PLANE) {
            light = 0.5 * (light + environmentLobe(frame, vec3(direction.x, -direction.y, direction.z), level));
        }
        sum += lobe[4] * light;
        total += lobe[4];
    }
    return sum * (min(s * directionalAlbedo(mu, row), 1.0) / total);
}
#endif

#endif
