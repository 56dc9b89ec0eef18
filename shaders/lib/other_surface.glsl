// What is not skin: glTF metallic-roughness and what its extensions lay over it (docs/model.md, "Everything else").
//
// The includer declares `push.lightCount`, lights[], lightViews[] with SHADOWS, and includes lib/metallic_roughness.glsl,
// lib/lights.glsl and, by feature, lib/light_maps.glsl, lib/environment.glsl and lib/material_textures.glsl.
#ifndef CUTIS_OTHER_SURFACE_GLSL
#define CUTIS_OTHER_SURFACE_GLSL

#include "lib/sheen.glsl"

layout(constant_id = 3) const uint LAYERS = 7u;  // LAYER_ bits: what no material of the scene has is not compiled

struct OtherSurface {
    vec3 n;             // shading normal
    vec3 matte;         // albedo of what is scattered back; what passes through and metal have none
    vec3 f0, f90;       // Fresnel of metal and dielectric together, at normal incidence and grazing
    float deepF0, deepF90;  // of the dielectric alone, its largest channel: what it reflects does not go on below
    float alpha;        // of GGX
    float occlusion;    // share of the environment
    vec3 through;       // share of the light that goes straight through the body
    vec3 sheen;         // colour
    float sheenRoughness;
    float underSheen;   // share of everything below that the sheen leaves
    vec3 coatNormal;
    float coat, coatAlpha;  // share of light that the coat reflects: factor times Fresnel
};

#ifdef TEXTURED
SurfaceUv uvHere;  // of the point that is shaded
#endif

// The texture of a slot there; white where there is none.
vec4 slotTexel(uint slot, TextureRef ref) {
#ifdef TEXTURED
    if ((TEXTURE_SLOTS & slot) != 0u && ref.group >= 0) return sampleMaterial(ref, uvHere);
#endif
    return vec4(1.0);
}

float largest(vec3 v) { return max(v.x, max(v.y, v.z)); }

// A lobe is at least as wide as the normals within the pixel, `spread` in units of alpha².
float widenedAlpha(float roughness, float spread) {
    float alpha = clamp(roughness, 0.0, 1.0);
    alpha *= alpha;
    return max(sqrt(clamp(alpha * alpha + spread, 0.0, 1.0)), 1e-3);
}

// n: with the normal map; tangent: for the coat's.
OtherSurface otherSurface(Material material, vec3 albedo, vec3 n, vec3 smoothNormal, vec4 tangent, vec3 view, float spread) {
    OtherSurface s;
    vec4 texel = slotTexel(SLOT_METALLIC_ROUGHNESS, material.metallicRoughnessTexture);
    float metallic = clamp(material.metallic * texel.b, 0.0, 1.0);
    float specular = material.specular * slotTexel(SLOT_SPECULAR, material.specularTexture).a;
    vec3 deep = min(material.reflectance * slotTexel(SLOT_SPECULAR_COLOR, material.specularColorTexture).rgb, 1.0) * specular;
    s.n = n;
    s.deepF0 = largest(deep);
    s.deepF90 = specular;
    s.f0 = mix(deep, albedo, metallic);
    s.f90 = vec3(mix(specular, 1.0, metallic));
    s.matte = albedo * (1.0 - metallic);
    s.alpha = widenedAlpha(material.roughness * texel.g, spread);
    s.occlusion = 1.0 + material.occlusionStrength * (slotTexel(SLOT_OCCLUSION, material.occlusionTexture).r - 1.0);
    s.through = vec3(0.0);
    if ((LAYERS & LAYER_THROUGH) != 0u) {
        float share = material.transmission * slotTexel(SLOT_TRANSMISSION, material.transmissionTexture).r;
        s.through = s.matte * (share * (1.0 - schlick(s.deepF0, s.deepF90, dot(n, view))));
        s.matte *= 1.0 - share;
    }
    s.sheen = vec3(0.0);
    s.underSheen = 1.0;
    if ((LAYERS & LAYER_SHEEN) != 0u) {
        s.sheen = material.sheen * slotTexel(SLOT_SHEEN_COLOR, material.sheenColorTexture).rgb;
        s.sheenRoughness = material.sheenRoughness * slotTexel(SLOT_SHEEN_ROUGHNESS, material.sheenRoughnessTexture).a;
        s.underSheen = 1.0 - largest(s.sheen) * min(sheenAlbedo(max(dot(n, view), 1e-4), s.sheenRoughness), 1.0);
    }
    s.coat = 0.0;
    s.coatNormal = smoothNormal;
    if ((LAYERS & LAYER_COAT) != 0u) {
#ifdef TEXTURED
        if ((TEXTURE_SLOTS & SLOT_COAT_NORMAL) != 0u && material.coatNormalTexture.group >= 0) {
            s.coatNormal = mappedNormal(smoothNormal, tangent, sampleMaterial(material.coatNormalTexture, uvHere).xy,
                                        material.coatNormalScale);
        }
#endif
        s.coatNormal = facingNormal(s.coatNormal, view, smoothNormal);
        s.coat = material.coat * slotTexel(SLOT_COAT, material.coatTexture).r * schlick(0.04, 1.0, dot(s.coatNormal, view));
        s.coatAlpha = widenedAlpha(material.coatRoughness * slotTexel(SLOT_COAT_ROUGHNESS, material.coatRoughnessTexture).g, spread);
    }
    s.through *= s.underSheen * (1.0 - s.coat);
    return s;
}

struct OtherLight {
    vec3 diffuse, specular;  // radiance to the eye
    vec3 irradiance;         // that arrives
};

// share: what the sky sends of its light to the point.
OtherLight reflectedLight(OtherSurface s, DrawInfo draw, vec3 p, vec3 smoothNormal, vec3 view, vec3 share) {
    OtherLight light = OtherLight(vec3(0.0), vec3(0.0), vec3(0.0));
    vec3 sheen = vec3(0.0), coat = vec3(0.0);
    for (uint i = 0u; i < push.lightCount; ++i) {
        LightSampleData lamp = lights[i];
        Incident from = incidentLight(lamp, p);
        float cosine = max(dot(s.n, from.direction), 0.0);
        float coatCosine = (LAYERS & LAYER_COAT) != 0u ? max(dot(s.coatNormal, from.direction), 0.0) : 0.0;
        if ((cosine <= 0.0 && coatCosine <= 0.0) || dot(smoothNormal, from.direction) <= 0.0) continue;
        float visible = 1.0;
#ifdef SHADOWS
        if ((lamp.flags & LIGHT_SHADOW) != 0u) {
            visible = lightMapVisibility(lightViews[lamp.firstView + draw.receiverGroup], p, smoothNormal,
                                         from.direction, lamp.radius, from.distance,
                                         (lamp.flags & LIGHT_DIRECTIONAL) != 0u, true);
        }
#endif
        vec3 e = from.irradiance * (cosine * visible);
        light.irradiance += e;
        vec3 h = normalize(from.direction + view);
        float vh = dot(view, h);
        light.diffuse += e * s.matte * ((1.0 - schlick(s.deepF0, s.deepF90, vh)) / kPi);
        light.specular += e * schlick(s.f0, s.f90, vh) * ggxVisibilityDistribution(s.n, view, from.direction, h, s.alpha);
        if ((LAYERS & LAYER_SHEEN) != 0u) sheen += e * s.sheen * sheenLobe(s.n, view, from.direction, s.sheenRoughness);
        if ((LAYERS & LAYER_COAT) != 0u) {
            coat += from.irradiance * (coatCosine * visible *
                                       ggxVisibilityDistribution(s.coatNormal, view, from.direction, h, s.coatAlpha));
        }
    }
#ifdef ENVIRONMENT
    vec3 sky = environmentIrradianceAt(s.n) * share * s.occlusion;
    light.irradiance += sky;
    light.diffuse += sky * s.matte * ((1.0 - schlick(s.deepF0, s.deepF90, max(dot(s.n, view), 1e-4))) / kPi);
    light.specular += environmentSpecularGgx(s.n, view, s.alpha, s.f0, s.f90, true) * s.occlusion;
    if ((LAYERS & LAYER_SHEEN) != 0u) {
        sheen += s.sheen * environmentSheen(s.n, view, s.sheenRoughness, largest(s.sheen) > 0.0) * s.occlusion;
    }
    if ((LAYERS & LAYER_COAT) != 0u) {
        coat += environmentSpecularGgx(s.coatNormal, view, s.coatAlpha, vec3(1.0), vec3(1.0), s.coat > 0.0) * s.occlusion;
    }
#endif
    light.diffuse *= s.underSheen * (1.0 - s.coat);
    light.specular = (light.specular * s.underSheen + sheen) * (1.0 - s.coat) + coat * s.coat;
    return light;
}

#endif
