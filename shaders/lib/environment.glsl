// Light from the environment (DESIGN §1.1, §1.2): lookups into the maps of renderer/passes/environment.h, turned and
// scaled at run time.
//
// The includer declares, before this file,
//   samplerCube environmentIrradiance;              (not with ENVIRONMENT_SPECULAR_ONLY)
//   samplerCubeArray environmentRadiance;
//   EnvironmentSettingsData environment;            (shared/scene.h)
//   EnvironmentSource environmentSources[];         (shared/environment.h; medium, then rough)
//   float environmentVisibility(vec3 direction);    (share of the light from there that arrives)
// and, for skin, ALBEDO_TABLE as lib/skin_specular.glsl wants it.
#ifndef CUTIS_ENVIRONMENT_GLSL
#define CUTIS_ENVIRONMENT_GLSL

#include "shared/environment.h"
#include "lib/metallic_roughness.glsl"
#include "lib/sampling.glsl"
#include "lib/sheen.glsl"
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

// Number of the radiance lobe that has that σ in radians: between two lobes by variance.
float environmentLobeNumber(float sigma) {
    float variance = sigma * sigma;
    const float first = 2.0 * ENVIRONMENT_SPREAD * ENVIRONMENT_SPREAD;
    const float sharp = ENVIRONMENT_SPREAD_0 * ENVIRONMENT_SPREAD_0;
    if (variance <= first) return clamp((variance - sharp) / (first - sharp), 0.0, 1.0);
    float doublings = log2(variance / first), whole = floor(doublings);
    return min(1.0 + whole + exp2(doublings - whole) - 1.0, float(ENVIRONMENT_LOBES - 1u));
}

// Radiance from around a direction, averaged over a lobe; `set` is ENVIRONMENT_ALL, _MEDIUM or _ROUGH.
vec3 environmentRadianceAt(vec3 direction, float lobe, uint set) {
    vec3 d = toEnvironment(direction);
    lobe = max(lobe, float(environmentFirstLobe(set)));
    uint below = uint(lobe), above = min(below + 1u, ENVIRONMENT_LOBES - 1u);
    vec3 a = textureLod(environmentRadiance, vec4(d, float(environmentLobeCube(set, below))),
                        float(environmentLobeMip(below))).rgb;
    vec3 b = textureLod(environmentRadiance, vec4(d, float(environmentLobeCube(set, above))),
                        float(environmentLobeMip(above))).rgb;
    return mix(a, b, lobe - float(below)) * environment.intensity;
}

// A compact source of the environment as it stands in the world.
struct SourceLight {
    vec3 direction;  // unit, to the source
    vec3 flux;       // irradiance of a surface that faces it, visibility included
    float variance;  // of the angle to its centre, rad²
};

SourceLight environmentSource(uint i) {
    EnvironmentSource source = environmentSources[i];
    float len = length(source.mean);
    vec3 d = source.mean / len;
    d = vec3(environment.cosRotation * d.x + environment.sinRotation * d.z, d.y,
             environment.cosRotation * d.z - environment.sinRotation * d.x);
    return SourceLight(d, source.flux * (environment.intensity * environmentVisibility(d)), 2.0 - 2.0 * len);
}

// What a surface of some roughness (m or alpha) looks up, and the sources that it reflects apart from that.
struct EnvironmentView {
    uint set;
    uint first, end;  // of environmentSources
};
const EnvironmentView kNoView = EnvironmentView(ENVIRONMENT_ALL, 0u, 0u);

EnvironmentView environmentView(float roughness) {
    uint set = environmentSet(roughness), medium = environment.mediumSources;
    if (set == ENVIRONMENT_ALL) return EnvironmentView(set, 0u, 0u);
    if (set == ENVIRONMENT_MEDIUM) return EnvironmentView(set, 0u, medium);
    return EnvironmentView(set, medium, medium + environment.roughSources);
}

// The source's own extent widens the lobe: an angle δ is a slope δ/2.
float widenedRoughness(float roughness, SourceLight source) {
    return min(sqrt(roughness * roughness + 0.25 * source.variance), 1.0);
}

// Reflected radiance of a GGX surface (glTF metallic-roughness): filtered importance sampling (Křivánek & Colbert 2008)
// with `alpha` = roughness². Half-vectors at quantiles of D cosθ; each tap's lobe has the area that it stands for. 0 where it
// is not `wanted`: loops without a turn are all that a software device leaves out.
vec3 environmentSpecularGgx(vec3 n, vec3 v, float alpha, vec3 f0, vec3 f90, bool wanted) {
    const int kTaps = 16;
    mat3 frame = frameAlong(n, v);
    float nv = max(dot(n, v), 1e-3), a2 = alpha * alpha;
    EnvironmentView map = kNoView;
    if (wanted) map = environmentView(alpha);
    vec3 sum = vec3(0.0);
    for (int k = 0, end = wanted ? kTaps : 0; k < end; ++k) {
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
        sum += schlick(f0, f90, vh) * (weight * environmentVisibility(l)) *
               environmentRadianceAt(l, environmentLobeNumber(sigma), map.set);
    }
    sum /= float(kTaps);
    for (uint i = map.first; i < map.end; ++i) {
        SourceLight source = environmentSource(i);
        float nl = dot(n, source.direction);
        if (nl <= 0.0) continue;
        vec3 h = normalize(source.direction + v);
        sum += source.flux * (nl * ggxVisibilityDistribution(n, v, source.direction, h,
                                                             widenedRoughness(alpha, source))) *
               schlick(f0, f90, dot(v, h));
    }
    return sum;
}

// The light that a sheen of colour 1 reflects: the lobe is smooth, so directions by the cosine see it all; their sum is
// brought to its albedo, which makes a uniform environment exact. 0 where it is not `wanted`, likewise.
vec3 environmentSheen(vec3 n, vec3 v, float roughness, bool wanted) {
    const int kTaps = 16;
    mat3 frame = frameAlong(n, v);
    float scale = max(sheenAlbedo(max(dot(n, v), 1e-4), roughness), 1e-6), total = 0.0;
    vec3 sum = vec3(0.0);
    for (int k = 0, end = wanted ? kTaps : 0; k < end; ++k) {
        vec2 u = spiralPoint(k, kTaps);
        float sine = sqrt(u.x), cosine = sqrt(1.0 - u.x);
        vec3 l = frame * vec3(sine * cos(u.y), sine * sin(u.y), cosine);
        float weight = sheenLobe(n, v, l, roughness);
        // Each stands for a solid angle of π / (N cosθ).
        float sigma = min(sqrt(3.14159265358979 / (4.0 * float(kTaps) * cosine)), 0.5);
        total += weight;
        sum += environmentRadianceAt(l, environmentLobeNumber(sigma), ENVIRONMENT_ROUGH) * (weight * environmentVisibility(l));
    }
    sum *= min(scale, 1.0) / max(total, 1e-12);
    EnvironmentView map = kNoView;
    if (wanted) map = environmentView(1.0);
    for (uint i = map.first; i < map.end; ++i) {
        SourceLight source = environmentSource(i);
        float nl = dot(n, source.direction);
        if (nl > 0.0) sum += source.flux * (nl * sheenLobe(n, v, source.direction, roughness));
    }
    return sum;
}

#ifdef ALBEDO_TABLE
// Light through one lobe of the skin's table, `direction` in the columns of `frame`.
vec3 environmentThroughLobe(mat3 frame, vec3 direction, float lobe, uint set) {
    vec3 l = frame * direction;
    return environmentVisibility(l) * environmentRadianceAt(l, lobe, set);
}

// Radiance that a lobe of skin reflects, ∫ L f_s (N·ω) dω: `m` rms slope, `scale` of f_s, `reflected` of a uniform environment,
// `row` of the table of roughness m. `narrowed`: by what m is less here than that of the row. 0 where it is not `wanted`.
// The lobe f_s (N·ω) is the sum of smaller ones that renderer/skin/specular_lobes.h fits, between two rows of μ. Their
// weights sum to ρ_dt, so a uniform environment is reflected exactly.
vec3 environmentSpecularSkin(vec3 n, vec3 v, float m, float narrowed, float scale, float reflected, uint row, bool wanted) {
    float mu = clamp(dot(n, v), 1e-3, 1.0), sine = sqrt(1.0 - mu * mu);
    mat3 surface = frameAlong(n, v);
    mat3 frame = mat3(surface[0] * mu + n * sine, surface[1], n * mu - surface[0] * sine);  // z: mirror direction
    float x = sqrt(mu) * float(LOBE_ROWS - 1);
    uint j = min(uint(x), uint(LOBE_ROWS - 2));
    float f = x - float(j);
    uint at = row * uint(SKIN_TABLE_STRIDE) + uint(ALBEDO_ROW_SIZE) + j * uint(LOBE_ROW_SIZE);
    m *= narrowed;
    EnvironmentView map = kNoView;
    if (wanted) map = environmentView(m);
    vec3 sum = vec3(0.0);
    float total = 0.0;
    for (int k = 0, end = wanted ? LOBES_IN_PLANE + LOBE_PAIRS : 0; k < end; ++k) {
        float entry[LOBE_FLOATS];
        for (int i = 0; i < LOBE_FLOATS; ++i) {
            entry[i] = mix(ALBEDO_TABLE(at), ALBEDO_TABLE(at + uint(LOBE_ROW_SIZE)), f);
            ++at;
        }
        // Angles to the mirror direction go with the slopes.
        vec3 direction = normalize(vec3(narrowed * vec2(entry[0], entry[1]), entry[2]));
        float lobe = environmentLobeNumber(narrowed * entry[3]);
        vec3 light = environmentThroughLobe(frame, direction, lobe, map.set);
        if (k >= LOBES_IN_PLANE) {
            vec3 mirrored = vec3(direction.x, -direction.y, direction.z);
            light = 0.5 * (light + environmentThroughLobe(frame, mirrored, lobe, map.set));
        }
        sum += entry[4] * light;
        total += entry[4];
    }
    sum *= reflected / max(total, 1e-12);
    for (uint i = map.first; i < map.end; ++i) {
        SourceLight source = environmentSource(i);
        float lobe = kelemenSpecular(n, v, source.direction, widenedRoughness(m, source));
        sum += source.flux * (scale * lobe * max(dot(n, source.direction), 0.0));
    }
    return sum;
}
#endif

#endif
