#version 460
// The light that each shading point sends to the eye. SKIN takes its diffuse light from the exitance texture; everything
// else is a glTF material under the same lights and environment (DESIGN §1).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
// features: SKIN SHADOWS ENVIRONMENT TEXTURED AOVS DETAIL(SKIN)
#include "shared/environment.h"
#include "shared/scene.h"
#ifdef DETAIL
#include "shared/detail.h"
#endif
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
#ifdef DETAIL
layout(binding = 28, scalar) readonly buffer RestPositionBuffer { vec3 restPositions[]; };
layout(binding = 29) uniform sampler2D detailSlopes;
layout(binding = 30, scalar) readonly buffer PoreBuffer { Pores poresOf[]; };  // a material
#endif
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
    float alpha;             // coverage
    vec3 through;            // share of the light from behind that passes what is covered
    vec3 normal, albedo, position, irradiance, atlas;  // atlas: x, y in texels, 1 on skin
    float thickness, depth;
    uint character;
};

#ifdef DETAIL
#include "lib/detail.glsl"
#endif
#ifdef SKIN
#include "lib/skin_surface.glsl"
#else
#include "lib/other_surface.glsl"
#endif

Shade shadeAt(uint triangleIndex, vec2 pixel) {
    Shade shade;
    shade.diffuse = shade.specular = shade.irradiance = shade.atlas = vec3(0.0);
    shade.through = vec3(0.0);
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
    vec4 tangent = vec4(0.0);
#if defined(TEXTURED) || defined(DETAIL) || !defined(SKIN)
    Ray rx = cameraRay(pixel + vec2(push.step, 0.0)), ry = cameraRay(pixel + vec2(0.0, push.step));
    vec3 wx = barycentricOnRay(triangle, rx.origin, rx.direction);
    vec3 wy = barycentricOnRay(triangle, ry.origin, ry.direction);
#endif
#ifdef TEXTURED
    SurfaceUv uv = surfaceUv(w, wx, wy, va, vb, vc);
    if ((TEXTURE_SLOTS & SLOT_BASE_COLOR) != 0u && material.baseColorTexture.group >= 0) base *= sampleMaterial(material.baseColorTexture, uv);
    if ((TEXTURE_SLOTS & SLOTS_OF_NORMALS) != 0u) {
        tangent = interpolate(w, va.tangent, vb.tangent, vc.tangent);
        if (back) tangent = -tangent;
    }
    if ((TEXTURE_SLOTS & SLOT_NORMAL) != 0u && material.normalTexture.group >= 0) {
        n = mappedNormal(smoothNormal, tangent, sampleMaterial(material.normalTexture, uv).xy, material.normalScale);
    }
#ifndef SKIN
    uvHere = uv;
#endif
    if ((TEXTURE_SLOTS & SLOT_EMISSIVE) != 0u && material.emissiveTexture.group >= 0) emitted *= sampleMaterial(material.emissiveTexture, uv).rgb;
#endif
    n = facingNormal(n, view, smoothNormal);

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
    vec3 detailed = n;
    float removed = 0.0;
#ifdef DETAIL
    Triangle rest = Triangle(v, restPositions[v.x], restPositions[v.y], restPositions[v.z]);
    detailed = detailedNormal(poresOf[draw.material], material.normalTexture, triangle, rest, w, wx, wy, va, vb, vc,
                              smoothNormal, n, removed);
    detailed = facingNormal(detailed, view, smoothNormal);
#endif
    shadeSkin(shade, material, texel, atlasVertices[v.x].island, p, smoothNormal, n, detailed, removed, view);
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
    OtherSurface surface = otherSurface(material, shade.albedo, n, smoothNormal, tangent, view, spread);
    OtherLight light = reflectedLight(surface, draw, p, smoothNormal, view, share);
    shade.diffuse = light.diffuse;
    shade.specular = light.specular;
    shade.irradiance = light.irradiance;
    shade.through = surface.through;
    emitted *= 1.0 - surface.coat;
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
    shaded[index] = ShadedPoint(shade.diffuse * shade.alpha, shade.specular * shade.alpha,
                                mix(vec3(1.0), shade.through, shade.alpha));
#ifdef AOVS
    if ((list[i] & POINT_DATA) != 0u) storeAovs(pixel, shade);
#endif
}
