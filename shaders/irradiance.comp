#version 460
// All light that reaches each texel of skin: the environment's is added to that of all light samples
// (irradiance_lights.comp), and what enters is seen through the skin's albedo (DESIGN §1.1, §1.4).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
// features: ENVIRONMENT TRANSLUCENCY
#include "shared/atlas_tiles.h"
#include "shared/scene.h"
#include "lib/geometry.glsl"
#include "lib/octahedral.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform texture2D position;  // see surface.comp
layout(binding = 1) uniform texture2D normal;
layout(binding = 2) uniform texture2D albedo;
layout(binding = 3) uniform texture2D stretch;
layout(binding = 4, scalar) readonly buffer DrawBuffer { DrawInfo draws[]; };
layout(binding = 5, scalar) readonly buffer MaterialBuffer { Material materials[]; };
layout(binding = 6, rgba32f) uniform image2D irradiance;  // E'(rgb); a: island, 0 where uncovered
layout(binding = 7, rgba32f) uniform image2D incident;    // E before albedo and specular (rgb); a: thickness, mm
#ifdef TRANSLUCENCY
layout(binding = 8) uniform texture2D entry;  // see thickness.comp
#endif
#ifdef ENVIRONMENT
layout(binding = 9) uniform samplerCube environmentIrradiance;
layout(binding = 10) uniform samplerCubeArray environmentMatte;
layout(binding = 11) uniform sampler2D environmentOcclusion;  // rgb: share of its light that arrives, times a: coverage
layout(binding = 12, scalar) readonly buffer EnvironmentBuffer { EnvironmentSettingsData environment; };
#endif

layout(push_constant, scalar) uniform Push {
    TilePush tiles;
    uint lights;  // 1: their sums are there
} push;

#include "lib/atlas_tiles.glsl"

const float kNoThickness = 60000.0;  // mm

void main() {
    ivec2 texel;
    uint tile;
    if (!tileTexel(texel, tile)) return;
    vec4 place = texelFetch(position, texel, 0);
    if (place.w == 0.0) return;
    Material material = materials[draws[uint(place.w) - 1u].material];
    vec3 n = decodeOctahedral(texelFetch(normal, texel, 0).zw);  // with the normal map
    vec3 entering = vec3(0.0), arriving = vec3(0.0);
    if (push.lights != 0u) entering = imageLoad(irradiance, texel).rgb, arriving = imageLoad(incident, texel).rgb;
    float thickness = kNoThickness;
#ifdef TRANSLUCENCY
    thickness = texelFetch(entry, texel, 0).z;
#endif
#ifdef ENVIRONMENT
    vec4 share = textureLod(environmentOcclusion, (vec2(texel) + 0.5) / vec2(textureSize(position, 0)), 0.0);
    vec3 occlusion = share.a > 0.0 ? share.rgb / share.a : vec3(1.0);
    vec3 direction = vec3(environment.cosRotation * n.x - environment.sinRotation * n.z, n.y,
                          environment.sinRotation * n.x + environment.cosRotation * n.z);
    vec3 sky = textureLod(environmentIrradiance, direction, 0.0).rgb * environment.intensity;
    vec3 reflected = textureLod(environmentMatte, vec4(direction, float(material.matteLayer)), 0.0).rgb *
                     (environment.intensity * material.specularScale);
    arriving += sky * occlusion;
    entering += max(sky - reflected, 0.0) * occlusion;
#endif
    vec3 rho = texelFetch(albedo, texel, 0).rgb;
    // pow(0, 0) is undefined: black skin with mix 0 lets everything in, with any other mix nothing.
    vec3 before = material.mix <= 0.0 ? vec3(1.0) : pow(rho, vec3(material.mix));
    imageStore(irradiance, texel, vec4(entering * before, texelFetch(stretch, texel, 0).w));
    imageStore(incident, texel, vec4(arriving, thickness));
}
