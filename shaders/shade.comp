#version 460
// The light that each shading point sends to the eye. SKIN takes its diffuse light from the exitance texture; everything
// else is glTF metallic-roughness under the same lights and environment (DESIGN §1).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
// features: SKIN SHADOWS ENVIRONMENT TEXTURED AOVS
#include "shared/environment.h"
#include "shared/scene.h"
#include "lib/geometry.glsl"
#include "lib/octahedral.glsl"

layout(local_size_x = 64) in;

layout(binding = 0, scalar) readonly buffer PointBuffer { ShadingPoint points[]; };
layout(binding = 1, scalar) readonly buffer ListBuffer { uint list[]; };  // of points of this kind
layout(binding = 2, scalar) readonly buffer CountBuffer { uint pointCount, skinCount, otherCount; };
layout(binding = 3, scalar) writeonly buffer ShadedBuffer { ShadedPoint shaded[]; };
layout(binding = 4, scalar) readonly buffer IndexBuffer { uint indices[]; };
layout(binding = 5, scalar) readonly buffer PositionBuffer { vec3 positions[]; };
layout(binding = 6, scalar) readonly buffer AttributeBuffer { VertexAttributes attributes[]; };
layout(binding = 7, scalar) readonly buffer TriangleDrawBuffer { uint triangleDraws[]; };
layout(binding = 8, scalar) readonly buffer DrawBuffer { DrawInfo draws[]; };
layout(binding = 9, scalar) readonly buffer MaterialBuffer { Material materials[]; };
layout(binding = 10, scalar) readonly buffer CameraBuffer { ViewCamera camera; };
layout(binding = 11, scalar) readonly buffer LightBuffer { LightSampleData lights[]; };
#ifdef SKIN
layout(binding = 12, scalar) readonly buffer AlbedoTableBuffer { float albedoTable[]; };
layout(binding = 13, scalar) readonly buffer AtlasVertexBuffer { AtlasVertex atlasVertices[]; };
layout(binding = 14) uniform texture2D exitance;  // rgb: M; a: island
layout(binding = 27) uniform texture2D surfaceNormal;  // see surface.comp
#ifdef SHADOWS
layout(binding = 15) uniform texture2DArray lightVisibility;  // a layer a light (shared/light_share.h)
#endif
#ifdef AOVS
layout(binding = 16) uniform texture2D incident;
#endif
#elif defined(SHADOWS)
layout(binding = 17, scalar) readonly buffer LightViewBuffer { LightView lightViews[]; };
layout(binding = 18) uniform sampler2DArrayShadow lightDepthCompare;
layout(binding = 19) uniform sampler2DArray lightDepth;
#endif
#ifdef ENVIRONMENT
layout(binding = 21) uniform samplerCubeArray environmentRadiance;
layout(binding = 22, scalar) readonly buffer EnvironmentBuffer {
    EnvironmentSettingsData environment;
    EnvironmentSource environmentSources[];
};
#ifdef SKIN
#define ENVIRONMENT_SPECULAR_ONLY
layout(binding = 23) uniform sampler2D openSky;
#else
layout(binding = 20) uniform samplerCube environmentIrradiance;
layout(binding = 24, scalar) readonly buffer ProbeBuffer { vec4 probes[]; };
#endif
#endif
#ifdef TEXTURED
layout(binding = 25) uniform sampler2DArray materialTextures[MAX_TEXTURE_GROUPS];
#include "lib/material_textures.glsl"
#endif
#ifdef AOVS
layout(binding = 26, rgba32f) writeonly uniform image2DArray aovs;
#endif

layout(push_constant, scalar) uniform Push {
    ivec2 tile;         // pixel of the picture at the corner of this tile
    ivec2 pictureSize;  // pixels
    uint lightCount;
    float step;  // distance between shading points, in pixels
    // Layer of `aovs` that holds each, 15: not wanted; in the order of the AOV_ constants, four bits each.
    uint aovLayers0, aovLayers1;
} push;

const int AOV_IRRADIANCE = 2, AOV_THICKNESS = 3, AOV_ALBEDO = 4, AOV_NORMAL = 5,
          AOV_POSITION = 6, AOV_DEPTH = 7, AOV_CHARACTER = 8, AOV_ATLAS = 9;
const float kPi = 3.14159265358979;
const float kNoThickness = 60000.0;

#ifdef SKIN
#define ALBEDO_TABLE(i) albedoTable[i]
#endif
#include "lib/skin_specular.glsl"
#ifdef SKIN
#include "lib/atlas_lookup.glsl"
#endif
#include "lib/metallic_roughness.glsl"
#include "lib/lights.glsl"
#if defined(SHADOWS) && !defined(SKIN)
#include "lib/light_maps.glsl"
#endif

#ifdef ENVIRONMENT
// Cone of sky that the shaded point sees: axis and the cosine of its half angle.
vec3 skyAxis;
float skyCosine;

// Whether a reflected direction reaches the sky: the cone's edge is soft, since the cone stands for any shape.
float environmentVisibility(vec3 direction) {
    return clamp((dot(direction, skyAxis) - skyCosine) * 4.0 + 1.0, 0.0, 1.0);
}

void setSky(vec3 open, vec3 normal) {
    float openness = clamp(length(open), 0.0, 1.0);
    skyAxis = safeNormalize(open, normal);
    skyCosine = 1.0 - openness;  // a cone of that share of the hemisphere's solid angle
    // The normal map may tilt reflections below the smooth horizon of an open point.
    if (openness > 0.98) skyCosine = -1.0;
}

#include "lib/environment.glsl"
#endif

struct Ray {
    vec3 origin, direction;
};

Ray cameraRay(vec2 pixel) {
    vec2 ndc = pixel / vec2(push.pictureSize) * 2.0 - 1.0;
    vec3 lateral = ndc.x * camera.right - ndc.y * camera.up;
    return camera.orthographic != 0u ? Ray(camera.origin + lateral, camera.forward)
                                     : Ray(camera.origin, normalize(camera.forward + lateral));
}

Triangle fetchTriangle(uint index) {
    uvec3 v = uvec3(indices[index * 3u], indices[index * 3u + 1u], indices[index * 3u + 2u]);
    return Triangle(v, positions[v.x], positions[v.y], positions[v.z]);
}

struct Shade {
    vec3 diffuse, specular;  // radiance; what is emitted counts as diffuse
    float alpha;
    vec3 normal, albedo, position, irradiance, atlas;  // atlas: x, y in texels, 1 on skin
    float thickness, depth;
    uint character;
};

#ifdef SKIN
void shadeSkin(inout Shade shade, Material material, vec2 atlasTexel, float island, vec3 p, vec3 smoothNormal, vec3 n, vec3 view) {
    // Facing away from the viewer by the normal map alone: the closest direction that is still seen.
    float mu = max(dot(n, view), 1e-4);
    AtlasLookup at = atlasLookup(exitance, surfaceNormal, atlasTexel, island, smoothNormal);
    vec3 m = lookUp(exitance, at).rgb;
    vec3 after = material.mix >= 1.0 ? vec3(1.0) : pow(shade.albedo, vec3(1.0 - material.mix));
    float through = transmittedFraction(mu, material.specularScale, material.albedoRow) /
                    max(1.0 - material.meanAlbedo, 1e-4);
    shade.diffuse += after * m / kPi * through;
#ifdef AOVS
    shade.irradiance = lookUp(incident, at).rgb;
    shade.atlas = vec3(atlasTexel, 1.0);
    shade.thickness = texelFetch(incident, clamp(ivec2(atlasTexel), ivec2(0), textureSize(incident, 0) - 1), 0).a;
#endif
    float scale = clampedSpecularScale(material.specularScale, directionalAlbedo(mu, material.albedoRow));
    float visible = 1.0;
    uint current = 0xffffffffu;
    for (uint i = 0u; i < push.lightCount; ++i) {
        LightSampleData light = lights[i];
        Incident from = incidentLight(light, p);
        float cosine = dot(n, from.direction);
#ifdef SHADOWS
        // The share of each light that the irradiance pass found to arrive: of all its samples together.
        if (light.light != current) {
            current = light.light;
            visible = lightShare(lightVisibility, at, int(current));
        }
#endif
        if (cosine <= 0.0 || dot(smoothNormal, from.direction) <= 0.0) continue;
        float lobe = kelemenSpecular(n, view, from.direction, material.slope);
        shade.specular += from.irradiance * (cosine * scale * lobe * visible);
    }
#ifdef ENVIRONMENT
    vec4 open = textureLod(openSky, atlasTexel / vec2(textureSize(exitance, 0)), 0.0);
    setSky(open.a > 0.0 ? open.xyz / open.a : smoothNormal, smoothNormal);
    shade.specular += environmentSpecularSkin(n, view, material.slope, material.specularScale, material.albedoRow);
#endif
}
#endif

#ifndef SKIN
void shadeMetallicRoughness(inout Shade shade, DrawInfo draw, vec3 p, vec3 smoothNormal, vec3 n,
                            vec3 view, float metallic, float alpha, float occlusion, vec3 share) {
    vec3 f0 = mix(vec3(0.04), shade.albedo, metallic);
    vec3 matte = shade.albedo * (1.0 - metallic);
    float mu = max(dot(n, view), 1e-4);
    for (uint i = 0u; i < push.lightCount; ++i) {
        LightSampleData light = lights[i];
        Incident from = incidentLight(light, p);
        float cosine = dot(n, from.direction);
        if (cosine <= 0.0 || dot(smoothNormal, from.direction) <= 0.0) continue;
        float visible = 1.0;
#ifdef SHADOWS
        if ((light.flags & LIGHT_SHADOW) != 0u) {
            visible = lightMapVisibility(lightViews[light.firstView + draw.receiverGroup], p, smoothNormal,
                                         from.direction, light.radius, from.distance,
                                         (light.flags & LIGHT_DIRECTIONAL) != 0u, true);
        }
#endif
        vec3 e = from.irradiance * (cosine * visible);
        shade.irradiance += e;
        vec3 h = normalize(from.direction + view);
        vec3 fresnel = schlick(f0, dot(view, h));
        shade.diffuse += e * matte * (1.0 - fresnel) / kPi;
        shade.specular += e * fresnel * ggxVisibilityDistribution(n, view, from.direction, h, alpha);
    }
#ifdef ENVIRONMENT
    vec3 sky = environmentIrradianceAt(n) * share * occlusion;
    shade.irradiance += sky;
    shade.diffuse += sky * matte * (1.0 - schlick(f0, mu)) / kPi;
    shade.specular += environmentSpecularGgx(n, view, alpha, f0) * occlusion;
#endif
}

#endif

Shade shadeAt(uint triangleIndex, vec2 pixel) {
    Shade shade;
    shade.diffuse = shade.specular = shade.irradiance = shade.atlas = vec3(0.0);
    shade.thickness = 0.0;
    uint drawIndex = triangleDraws[triangleIndex];
    DrawInfo draw = draws[drawIndex];
    Material material = materials[draw.material];
    Triangle triangle = fetchTriangle(triangleIndex);
    Ray ray = cameraRay(pixel);
    vec3 w = clampBarycentric(barycentricOnRay(triangle, ray.origin, ray.direction));
    uvec3 v = triangle.vertex;
    VertexAttributes va = attributes[v.x], vb = attributes[v.y], vc = attributes[v.z];
    vec3 p = interpolate(w, triangle.a, triangle.b, triangle.c);
    vec3 face = safeNormalize(cross(triangle.b - triangle.a, triangle.c - triangle.a), va.normal);
    vec3 smoothNormal = safeNormalize(interpolate(w, va.normal, vb.normal, vc.normal), face);
    vec3 view = -ray.direction;
    bool back = dot(face, view) < 0.0;
    if (back) smoothNormal = -smoothNormal;

    vec4 base = material.baseColor * interpolate(w, va.color, vb.color, vc.color);
    vec3 n = smoothNormal, emitted = material.emissive;
    float metallic = material.metallic, roughness = material.roughness, occlusion = 1.0;
#if defined(TEXTURED) || !defined(SKIN)
    Ray rx = cameraRay(pixel + vec2(push.step, 0.0)), ry = cameraRay(pixel + vec2(0.0, push.step));
    vec3 wx = barycentricOnRay(triangle, rx.origin, rx.direction);
    vec3 wy = barycentricOnRay(triangle, ry.origin, ry.direction);
#endif
#ifdef TEXTURED
    SurfaceUv uv = surfaceUv(w, wx, wy, va, vb, vc);
    if ((TEXTURE_SLOTS & SLOT_BASE_COLOR) != 0u && material.baseColorTexture.group >= 0) base *= sampleMaterial(material.baseColorTexture, uv);
#ifndef SKIN
    if ((TEXTURE_SLOTS & SLOT_METALLIC_ROUGHNESS) != 0u && material.metallicRoughnessTexture.group >= 0) {
        vec4 t = sampleMaterial(material.metallicRoughnessTexture, uv);
        roughness *= t.g;
        metallic *= t.b;
    }
#endif
    if ((TEXTURE_SLOTS & SLOT_NORMAL) != 0u && material.normalTexture.group >= 0) {
        vec4 tangent = interpolate(w, va.tangent, vb.tangent, vc.tangent);
        n = mappedNormal(smoothNormal, back ? -tangent : tangent, sampleMaterial(material.normalTexture, uv).xy,
                         material.normalScale);
    }
#ifndef SKIN
    if ((TEXTURE_SLOTS & SLOT_OCCLUSION) != 0u && material.occlusionTexture.group >= 0) {
        occlusion = 1.0 + material.occlusionStrength * (sampleMaterial(material.occlusionTexture, uv).r - 1.0);
    }
#endif
    if ((TEXTURE_SLOTS & SLOT_EMISSIVE) != 0u && material.emissiveTexture.group >= 0) emitted *= sampleMaterial(material.emissiveTexture, uv).rgb;
#endif
    // A normal that looks away from the viewer, by interpolation or by the map, is bent back to the horizon.
    float facing = dot(n, view);
    if (facing < 0.02) n = safeNormalize(n + view * (0.02 - facing), smoothNormal);

    shade.alpha = (material.flags & MATERIAL_BLEND) != 0u ? clamp(base.a, 0.0, 1.0) : 1.0;
    shade.albedo = clamp(base.rgb, 0.0, 1.0);
    shade.normal = n;
    shade.position = p;
    shade.depth = dot(p - camera.origin, camera.forward);
    shade.character = draw.character;
    if ((material.flags & MATERIAL_UNLIT) != 0u) {
        shade.diffuse = base.rgb;
        return shade;
    }
#ifdef SKIN
    vec2 texel = interpolate(w, atlasVertices[v.x].texel, atlasVertices[v.y].texel, atlasVertices[v.z].texel);
    shadeSkin(shade, material, texel, atlasVertices[v.x].island, p, smoothNormal, n, view);
#else
    vec3 share = vec3(1.0);
#ifdef ENVIRONMENT
    uint first = draw.firstProbe - draw.firstVertex;  // wraps: only the sum matters
    uvec3 probe = (v + first) * 2u;
    share = interpolate(w, probes[probe.x].xyz, probes[probe.y].xyz, probes[probe.z].xyz);
    vec3 open = interpolate(w, probes[probe.x + 1u].xyz, probes[probe.y + 1u].xyz, probes[probe.z + 1u].xyz);
    setSky(back ? smoothNormal : open, smoothNormal);
#endif
    // A lobe is at least as wide as the normals within the pixel: without this a silhouette sparkles (Tokuyoshi &
    // Kaplanyan 2019; their bound of 0.18 on what is added to alpha²).
    vec3 nx = interpolate(wx - w, va.normal, vb.normal, vc.normal);
    vec3 ny = interpolate(wy - w, va.normal, vb.normal, vc.normal);
    float spread = min(0.5 * (dot(nx, nx) + dot(ny, ny)), 0.18);
    float alpha = clamp(roughness, 0.0, 1.0);
    alpha = sqrt(clamp(alpha * alpha * alpha * alpha + spread, 0.0, 1.0));
    shadeMetallicRoughness(shade, draw, p, smoothNormal, n, view, clamp(metallic, 0.0, 1.0), max(alpha, 1e-3),
                           occlusion, share);
#endif
    shade.diffuse += emitted;
    return shade;
}

#ifdef AOVS
void storeAov(ivec2 pixel, int aov, vec3 value) {
    uint layer = ((aov < 8 ? push.aovLayers0 : push.aovLayers1) >> ((aov & 7) * 4)) & 15u;
    if (layer != 15u) imageStore(aovs, ivec3(pixel, int(layer)), vec4(value, 1.0));
}

// Data channels hold the surface that covers most of the pixel: an average of two means nothing.
void storeAovs(ivec2 pixel, Shade seen) {
    storeAov(pixel, AOV_IRRADIANCE, seen.irradiance);
    storeAov(pixel, AOV_THICKNESS, vec3(seen.thickness));
    storeAov(pixel, AOV_ALBEDO, seen.albedo);
    storeAov(pixel, AOV_NORMAL, seen.normal);
    storeAov(pixel, AOV_POSITION, seen.position);
    storeAov(pixel, AOV_DEPTH, vec3(seen.depth));
    storeAov(pixel, AOV_CHARACTER, vec3(float(seen.character)));
    storeAov(pixel, AOV_ATLAS, seen.atlas);
}
#endif

void main() {
    uint i = gl_GlobalInvocationID.x;
#ifdef SKIN
    if (i >= skinCount) return;
#else
    if (i >= otherCount) return;
#endif
    uint index = list[i] & ~POINT_DATA;
    ShadingPoint point = points[index];
    ivec2 pixel = push.tile + ivec2(point.pixel & 0xffffu, point.pixel >> 16);
    Shade shade = shadeAt(point.triangle, vec2(pixel) + unpackUnorm2x16(point.offset));
    shaded[index] = ShadedPoint(shade.diffuse, shade.alpha, shade.specular);
#ifdef AOVS
    if ((list[i] & POINT_DATA) != 0u) storeAovs(pixel, shade);
#endif
}
