#version 460
// Adds the light of a few samples of one light to each texel of skin: what arrives, what enters, and the share of the
// light that is not stopped.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
// features: SHADOWS
#include "shared/atlas_tiles.h"
#include "shared/light_share.h"
#include "shared/scene.h"
#include "lib/geometry.glsl"
#include "lib/octahedral.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint SAMPLES = 4;

layout(binding = 0) uniform texture2D position;  // see surface.comp
layout(binding = 1) uniform texture2D normal;
layout(binding = 2, scalar) readonly buffer DrawBuffer { DrawInfo draws[]; };
layout(binding = 3, scalar) readonly buffer MaterialBuffer { Material materials[]; };
layout(binding = 4, scalar) readonly buffer AlbedoTableBuffer { float albedoTable[]; };
layout(binding = 5, scalar) readonly buffer LightBuffer { LightSampleData lights[]; };
// Sums over all samples so far; in alpha, of the samples of this light.
layout(binding = 6, rgba32f) uniform image2D irradiance;  // what enters (rgb); a: what would arrive if nothing stood in the way
layout(binding = 7, rgba32f) uniform image2D incident;    // what arrives (rgb); a: the same of this light
#ifdef SHADOWS
layout(binding = 8, scalar) readonly buffer LightViewBuffer { LightView lightViews[]; };
layout(binding = 9) uniform sampler2DArrayShadow lightDepthCompare;
layout(binding = 10) uniform sampler2DArray lightDepth;
layout(binding = 11) writeonly uniform image2DArray lightVisibility;  // a layer a light (shared/light_share.h)
#endif

layout(push_constant, scalar) uniform Push {
    TilePush tiles;
    uint firstSample;
    uint light;       // that the samples belong to
    uint starts, startsLight;  // 1: these are the first samples of all, and of the light
    uint firstView, groupCount;  // views of the first sample; one a receiver group
} push;

#include "lib/atlas_tiles.glsl"
#define ALBEDO_TABLE(i) albedoTable[i]
#include "lib/skin_specular.glsl"
#include "lib/lights.glsl"
#ifdef SHADOWS
#include "lib/light_maps.glsl"
#endif

vec3 p, smoothNormal, n;  // of the surface itself: shadows; with the normal map: shading
Material material;
bool listed;
vec4 entering, arriving;

void addSample(uint i) {
    LightSampleData light = lights[push.firstSample + i];
#ifdef SHADOWS
    LightView view = lightViews[push.firstView + i * push.groupCount + push.tiles.receiverGroup];
#endif
    Incident from = incidentLight(light, p);
    vec3 l = from.direction;
    float cosine = dot(smoothNormal, l) > 0.0 ? max(dot(n, l), 0.0) : 0.0;
    float visible = 1.0;
#ifdef SHADOWS
    visible = lightMapVisibility(view, p, smoothNormal, l, light.radius, from.distance,
                                 (light.flags & LIGHT_DIRECTIONAL) != 0u, listed && cosine > 0.0);
#endif
    vec3 e = from.irradiance * (cosine * visible);
    float sent = cosine * max(from.irradiance.x, max(from.irradiance.y, from.irradiance.z));
    entering.a += sent;
    arriving += vec4(e, sent * visible);
    entering.rgb += e * transmittedFraction(cosine, material.specularScale, material.albedoRow);
}

// No early returns, no loop over samples, and these found by push constants alone: a software device then reads them once
// for all invocations.
void main() {
    ivec2 texel;
    uint tile;
    listed = tileTexel(texel, tile);
    vec4 place = texelFetch(position, texel, 0);
    listed = listed && place.w > 0.0;
    material = materials[draws[max(uint(place.w), 1u) - 1u].material];
    vec4 packedNormals = texelFetch(normal, texel, 0);
    smoothNormal = decodeOctahedral(packedNormals.xy);
    n = decodeOctahedral(packedNormals.zw);
    p = place.xyz;
    entering = imageLoad(irradiance, texel);
    arriving = imageLoad(incident, texel);
    if (push.starts != 0u) entering = arriving = vec4(0.0);
    if (push.startsLight != 0u) entering.a = arriving.a = 0.0;
    addSample(0u);
    if (SAMPLES > 1u) addSample(1u);
    if (SAMPLES > 2u) addSample(2u);
    if (SAMPLES > 3u) addSample(3u);
    if (listed) {
        imageStore(irradiance, texel, entering);
        imageStore(incident, texel, arriving);
#ifdef SHADOWS
        imageStore(lightVisibility, ivec3(texel, int(push.light)),
                   vec4(entering.a > 0.0 ? arriving.a / entering.a * LIGHT_ARRIVES : LIGHT_FACED_AWAY));
#endif
    }
}
