#version 460
// The picture: what each pixel sees, shaded. Skin takes its diffuse light from the exitance texture; everything else
// is glTF metallic-roughness under the same lights and environment (DESIGN §1).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
// features: SKIN SHADOWS ENVIRONMENT TEXTURED AOVS
#include "shared/scene.h"
#include "lib/geometry.glsl"
#include "lib/octahedral.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform utexture2DArray triangles;  // a layer of surfaces from the nearest; triangle + 1
layout(binding = 1, scalar) readonly buffer IndexBuffer { uint indices[]; };
layout(binding = 2, scalar) readonly buffer PositionBuffer { vec3 positions[]; };
layout(binding = 3, scalar) readonly buffer AttributeBuffer { VertexAttributes attributes[]; };
layout(binding = 4, scalar) readonly buffer TriangleDrawBuffer { uint triangleDraws[]; };
layout(binding = 5, scalar) readonly buffer DrawBuffer { DrawInfo draws[]; };
layout(binding = 6, scalar) readonly buffer MaterialBuffer { Material materials[]; };
layout(binding = 7, scalar) readonly buffer CameraBuffer { ViewCamera camera; };
layout(binding = 8, scalar) readonly buffer LightBuffer { LightSampleData lights[]; };
layout(binding = 9, rgba32f) writeonly uniform image2D picture;  // radiance times coverage; a: coverage
#ifdef SKIN
layout(binding = 10, scalar) readonly buffer AlbedoTableBuffer { float albedoTable[]; };
layout(binding = 11, scalar) readonly buffer AtlasVertexBuffer { AtlasVertex atlasVertices[]; };
layout(binding = 12) uniform sampler2D exitance;  // rgb: M; a: coverage
#ifdef AOVS
layout(binding = 13) uniform sampler2D incident;
#endif
#endif
#ifdef SHADOWS
layout(binding = 14, scalar) readonly buffer LightViewBuffer { LightView lightViews[]; };
layout(binding = 15) uniform sampler2DArrayShadow lightDepthCompare;
layout(binding = 16) uniform sampler2DArray lightDepth;
#endif
#ifdef ENVIRONMENT
layout(binding = 17) uniform samplerCube environmentIrradiance;
layout(binding = 18) uniform samplerCube environmentRadiance;
layout(binding = 19, scalar) readonly buffer EnvironmentBuffer { EnvironmentSettingsData environment; };
#ifdef SKIN
layout(binding = 20) uniform sampler2D openSky;
#endif
layout(binding = 21, scalar) readonly buffer ProbeBuffer { vec4 probes[]; };
#endif
#ifdef TEXTURED
layout(binding = 22) uniform sampler2DArray materialTextures[MAX_TEXTURE_GROUPS];
#include "lib/material_textures.glsl"
#endif
#ifdef AOVS
layout(binding = 23, rgba32f) writeonly uniform image2DArray aovs;
#endif

layout(push_constant, scalar) uniform Push {
    ivec2 tile;         // pixel of the picture at the corner of this tile
    ivec2 tileSize;     // pixels
    ivec2 pictureSize;  // pixels
    int supersampling;  // samples of `triangles` a pixel, along each axis
    int layers;         // of `triangles`
    uint lightCount;
    // Layer of `aovs` that holds each, -1: not wanted; in the order of the AOV_ constants, four bits each.
    uint aovLayers0, aovLayers1;
} push;

const int AOV_DIFFUSE = 0, AOV_SPECULAR = 1, AOV_IRRADIANCE = 2, AOV_THICKNESS = 3, AOV_ALBEDO = 4, AOV_NORMAL = 5,
          AOV_POSITION = 6, AOV_DEPTH = 7, AOV_CHARACTER = 8;
const float kPi = 3.14159265358979;
const float kNoThickness = 60000.0;

#ifdef SKIN
#define ALBEDO_TABLE(i) albedoTable[i]
#endif
#include "lib/skin_specular.glsl"
#include "lib/metallic_roughness.glsl"
#include "lib/lights.glsl"
#ifdef SHADOWS
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
    vec3 normal, albedo, position, irradiance;
    float thickness, depth;
    uint character;
};

float lightVisibility(LightSampleData light, uint receiverGroup, vec3 p, vec3 n, Incident from) {
#ifdef SHADOWS
    if ((light.flags & LIGHT_SHADOW) == 0u) return 1.0;
    return lightMapVisibility(lightViews[light.firstView + receiverGroup], p, n, from.direction, light.radius,
                              from.distance, (light.flags & LIGHT_DIRECTIONAL) != 0u);
#else
    return 1.0;
#endif
}

#ifdef SKIN
void shadeSkin(inout Shade shade, Material material, DrawInfo draw, vec2 atlasTexel, vec3 p, vec3 smoothNormal, vec3 n,
               vec3 view) {
    // Facing away from the viewer by the normal map alone: the closest direction that is still seen.
    float mu = max(dot(n, view), 1e-4);
    vec2 at = atlasTexel / vec2(textureSize(exitance, 0));
    vec4 leaving = textureLod(exitance, at, 0.0);
    vec3 m = leaving.a > 0.0 ? leaving.rgb / leaving.a : vec3(0.0);
    vec3 after = material.mix >= 1.0 ? vec3(1.0) : pow(shade.albedo, vec3(1.0 - material.mix));
    float through = transmittedFraction(mu, material.specularScale, material.albedoRow) /
                    max(1.0 - material.meanAlbedo, 1e-4);
    shade.diffuse += after * m / kPi * through;
#ifdef AOVS
    vec4 arriving = textureLod(incident, at, 0.0);
    shade.irradiance = leaving.a > 0.0 ? arriving.rgb / leaving.a : vec3(0.0);
    shade.thickness = texelFetch(incident, clamp(ivec2(atlasTexel), ivec2(0), textureSize(incident, 0) - 1), 0).a;
#endif
    for (uint i = 0u; i < push.lightCount; ++i) {
        LightSampleData light = lights[i];
        Incident from = incidentLight(light, p);
        float cosine = dot(n, from.direction);
        if (cosine <= 0.0 || dot(smoothNormal, from.direction) <= 0.0) continue;
        float lobe = kelemenSpecular(n, view, from.direction, material.slope);
        if (lobe < 1e-6) continue;
        float scale = clampedSpecularScale(material.specularScale, directionalAlbedo(mu, material.albedoRow));
        shade.specular += from.irradiance * (cosine * scale * lobe *
                          lightVisibility(light, draw.receiverGroup, p, smoothNormal, from));
    }
#ifdef ENVIRONMENT
    vec4 open = textureLod(openSky, at, 0.0);
    setSky(open.a > 0.0 ? open.xyz / open.a : smoothNormal, smoothNormal);
    shade.specular += environmentSpecularSkin(n, view, material.slope, material.specularScale, material.albedoRow);
#endif
}
#endif

void shadeMetallicRoughness(inout Shade shade, Material material, DrawInfo draw, vec3 p, vec3 smoothNormal, vec3 n,
                            vec3 view, float metallic, float roughness, float occlusion, vec3 share) {
    vec3 f0 = mix(vec3(0.04), shade.albedo, metallic);
    vec3 matte = shade.albedo * (1.0 - metallic);
    float alpha = max(roughness * roughness, 1e-3);
    float mu = max(dot(n, view), 1e-4);
    for (uint i = 0u; i < push.lightCount; ++i) {
        LightSampleData light = lights[i];
        Incident from = incidentLight(light, p);
        float cosine = dot(n, from.direction);
        if (cosine <= 0.0 || dot(smoothNormal, from.direction) <= 0.0) continue;
        vec3 e = from.irradiance * (cosine * lightVisibility(light, draw.receiverGroup, p, smoothNormal, from));
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

// `pixel` is where on the picture; `step` the distance to the neighbouring shading points, in pixels.
Shade shadeAt(uint triangleIndex, vec2 pixel, float step) {
    Shade shade;
    shade.diffuse = shade.specular = shade.irradiance = vec3(0.0);
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
#ifdef TEXTURED
    Ray rx = cameraRay(pixel + vec2(step, 0.0)), ry = cameraRay(pixel + vec2(0.0, step));
    SurfaceUv uv = surfaceUv(w, barycentricOnRay(triangle, rx.origin, rx.direction),
                             barycentricOnRay(triangle, ry.origin, ry.direction), va, vb, vc);
    if (material.baseColorTexture.group >= 0) base *= sampleMaterial(material.baseColorTexture, uv);
    if (material.metallicRoughnessTexture.group >= 0) {
        vec4 t = sampleMaterial(material.metallicRoughnessTexture, uv);
        roughness *= t.g;
        metallic *= t.b;
    }
    if (material.normalTexture.group >= 0) {
        vec4 tangent = interpolate(w, va.tangent, vb.tangent, vc.tangent);
        n = mappedNormal(smoothNormal, back ? -tangent : tangent, sampleMaterial(material.normalTexture, uv).xyz,
                         material.normalScale);
    }
    if (material.occlusionTexture.group >= 0) {
        occlusion = 1.0 + material.occlusionStrength * (sampleMaterial(material.occlusionTexture, uv).r - 1.0);
    }
    if (material.emissiveTexture.group >= 0) emitted *= sampleMaterial(material.emissiveTexture, uv).rgb;
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
    if (draw.chart != NO_CHART) {
        vec2 texel = interpolate(w, atlasVertices[v.x].texel, atlasVertices[v.y].texel, atlasVertices[v.z].texel);
        shadeSkin(shade, material, draw, texel, p, smoothNormal, n, view);
        shade.diffuse += emitted;
        return shade;
    }
#endif
    vec3 share = vec3(1.0);
#ifdef ENVIRONMENT
    uint first = draw.firstProbe - draw.firstVertex;  // wraps: only the sum matters
    uvec3 probe = (v + first) * 2u;
    share = interpolate(w, probes[probe.x].xyz, probes[probe.y].xyz, probes[probe.z].xyz);
    vec3 open = interpolate(w, probes[probe.x + 1u].xyz, probes[probe.y + 1u].xyz, probes[probe.z + 1u].xyz);
    setSky(back ? smoothNormal : open, smoothNormal);
#endif
    shadeMetallicRoughness(shade, material, draw, p, smoothNormal, n, view, clamp(metallic, 0.0, 1.0),
                           clamp(roughness, 0.0, 1.0), occlusion, share);
    shade.diffuse += emitted;
    return shade;
}

#ifdef AOVS
void storeAov(ivec2 pixel, int aov, vec4 value) {
    uint layer = ((aov < 8 ? push.aovLayers0 : push.aovLayers1) >> ((aov & 7) * 4)) & 15u;
    if (layer != 15u) imageStore(aovs, ivec3(pixel, int(layer)), value);
}

void storeAovs(ivec2 pixel, vec4 diffuse, vec4 specular, Shade seen, float coverage) {
    storeAov(pixel, AOV_DIFFUSE, diffuse);
    storeAov(pixel, AOV_SPECULAR, specular);
    bool any = coverage > 0.0;
    storeAov(pixel, AOV_IRRADIANCE, any ? vec4(seen.irradiance, coverage) : vec4(0.0));
    storeAov(pixel, AOV_THICKNESS, any ? vec4(vec3(seen.thickness), coverage) : vec4(0.0));
    storeAov(pixel, AOV_ALBEDO, any ? vec4(seen.albedo, coverage) : vec4(0.0));
    storeAov(pixel, AOV_NORMAL, any ? vec4(seen.normal, coverage) : vec4(0.0));
    storeAov(pixel, AOV_POSITION, any ? vec4(seen.position, coverage) : vec4(0.0));
    storeAov(pixel, AOV_DEPTH, any ? vec4(vec3(seen.depth), coverage) : vec4(0.0));
    storeAov(pixel, AOV_CHARACTER, any ? vec4(vec3(float(seen.character)), coverage) : vec4(0.0));
}
#endif

void main() {
    ivec2 local = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(local, push.tileSize))) return;
    ivec2 pixel = push.tile + local;
    int n = push.supersampling, total = n * n;
    float sampleStep = 1.0 / float(n), share = sampleStep * sampleStep;
    vec4 diffuse = vec4(0.0), specular = vec4(0.0);
    float coverage = 0.0, largest = 0.0;
    Shade seen;
    uint done = 0u;
    for (int s = 0; s < total; ++s) {
        if ((done >> s & 1u) != 0u) continue;
        ivec2 sub = ivec2(s % n, s / n);
        vec2 at = (vec2(sub) + 0.5) * sampleStep;
        float transmitted = 1.0, weight = share;
        for (int layer = 0; layer < push.layers && transmitted > 1e-3; ++layer) {
            uint id = texelFetch(triangles, ivec3(local * n + sub, layer), 0).x;
            if (id == 0u) continue;
            if (push.layers == 1) {
                // Samples of this pixel that see the same smooth piece of surface are shaded once, at their mean.
                uint draw = triangleDraws[id - 1u];
                Triangle first = fetchTriangle(id - 1u);
                vec3 face = safeNormalize(cross(first.b - first.a, first.c - first.a), vec3(0.0));
                float size = length(first.b - first.a) + length(first.c - first.a);
                vec2 sum = at;
                int count = 1;
                for (int t = s + 1; t < total; ++t) {
                    if ((done >> t & 1u) != 0u) continue;
                    ivec2 other = ivec2(t % n, t / n);
                    uint otherId = texelFetch(triangles, ivec3(local * n + other, 0), 0).x;
                    if (otherId == 0u) continue;
                    if (otherId != id) {
                        if (triangleDraws[otherId - 1u] != draw) continue;
                        Triangle second = fetchTriangle(otherId - 1u);
                        vec3 otherFace = safeNormalize(cross(second.b - second.a, second.c - second.a), vec3(0.0));
                        float otherSize = length(second.b - second.a) + length(second.c - second.a);
                        if (dot(face, otherFace) < 0.85 || distance(first.a, second.a) > 2.0 * (size + otherSize)) continue;
                    }
                    done |= 1u << t;
                    sum += (vec2(other) + 0.5) * sampleStep;
                    ++count;
                }
                at = sum / float(count);
                weight = share * float(count);
            }
            Shade shade = shadeAt(id - 1u, vec2(pixel) + at, push.layers == 1 ? 1.0 : sampleStep);
            float a = transmitted * shade.alpha * weight;
            diffuse += vec4(shade.diffuse * a, a);
            specular += vec4(shade.specular * a, a);
            coverage += a;
            transmitted *= 1.0 - shade.alpha;
            // Data channels hold the surface that covers most of the pixel: an average of two means nothing.
            if (a > largest) largest = a, seen = shade;
        }
    }
    imageStore(picture, pixel, vec4(diffuse.rgb + specular.rgb, coverage));
#ifdef AOVS
    storeAovs(pixel, diffuse, specular, seen, coverage);
#endif
}
