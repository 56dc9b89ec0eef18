#version 460
// All light that reaches each texel of skin: every light sample and the environment summed into one texture, and the
// thickness under the texel merged by minimum over the light samples (DESIGN §1.4). OPPOSITE: thickness is known already.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
// features: OPPOSITE ENVIRONMENT LIGHTS SHADOWS(LIGHTS) TRANSLUCENCY(SHADOWS)
#include "shared/scene.h"
#include "lib/geometry.glsl"
#include "lib/octahedral.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D position;  // see surface.comp
layout(binding = 1) uniform sampler2D normal;
layout(binding = 2) uniform sampler2D albedo;
layout(binding = 3) uniform sampler2D stretch;
layout(binding = 4, scalar) readonly buffer DrawBuffer { DrawInfo draws[]; };
layout(binding = 5, scalar) readonly buffer MaterialBuffer { Material materials[]; };
layout(binding = 6, scalar) readonly buffer AlbedoTableBuffer { float albedoTable[]; };
layout(binding = 7, rgba32f) writeonly uniform image2D irradiance;  // E'(rgb); a: island, 0 where uncovered
layout(binding = 8, rgba32f) writeonly uniform image2D incident;    // E before albedo and specular (rgb); a: thickness, mm
#ifdef LIGHTS
layout(binding = 9, scalar) readonly buffer LightBuffer { LightSampleData lights[]; };
#endif
#ifdef SHADOWS
layout(binding = 10, scalar) readonly buffer LightViewBuffer { LightView lightViews[]; };
layout(binding = 11) uniform sampler2DArrayShadow lightDepthCompare;
layout(binding = 12) uniform sampler2DArray lightDepth;
layout(binding = 19) writeonly uniform image2DArray lightVisibility;  // a layer a light: the share of it that arrives
#endif
#ifdef TRANSLUCENCY
layout(binding = 13) uniform utexture2DArray lightEntry;
layout(binding = 14, rg32f) writeonly uniform image2D entry;  // place in the atlas, in texels, of the merged entry point
#endif
#ifdef OPPOSITE
layout(binding = 20) uniform sampler2D opposite;  // z: thickness from the shape alone, mm
#endif
#ifdef ENVIRONMENT
layout(binding = 15) uniform samplerCube environmentIrradiance;
layout(binding = 16) uniform samplerCubeArray environmentMatte;
layout(binding = 17) uniform sampler2D environmentOcclusion;  // rgb: share of its light that arrives, times a: coverage
layout(binding = 18, scalar) readonly buffer EnvironmentBuffer { EnvironmentSettingsData environment; };
#endif

layout(push_constant, scalar) uniform Push {
    uint lightCount;
} push;

#define ALBEDO_TABLE(i) albedoTable[i]
#include "lib/skin_specular.glsl"
#include "lib/lights.glsl"
#ifdef SHADOWS
#include "lib/light_maps.glsl"
#endif

const float kNoThickness = 60000.0;  // mm

#ifdef TRANSLUCENCY
struct EntryPoint {
    float thickness;  // mm
    vec2 texel;
};

// Where the light of a sample that arrives from behind enters the skin, from its translucent shadow map. The four
// neighbours of the map are blended only when they lie on one piece of the same character's surface: between pieces
// an average place in the atlas means nothing.
EntryPoint findEntry(LightView view, vec3 p, vec3 n, vec3 l, float rayScale, uint character, float mmPerUnit) {
    EntryPoint none = EntryPoint(kNoThickness, vec2(0.0));
    vec3 at = projectToLightMap(view, p);
    if (any(lessThan(at.xy, vec2(0.0))) || any(greaterThan(at.xy, vec2(1.0)))) return none;
    float here = lightMapDistance(view, at.z);
    ivec2 size = textureSize(lightEntry, 0).xy;
    vec2 grid = at.xy * vec2(size) - 0.5;
    ivec2 base = ivec2(floor(grid));
    vec2 f = grid - vec2(base);
    vec2 atlasSize = vec2(textureSize(position, 0));
    vec2 place = vec2(0.0);
    float depth = 0.0, weight = 0.0, nearest = 0.0;
    vec2 nearestPlace = vec2(0.0);
    float nearestDepth = 0.0;
    bool blocked = true;  // by something that is not skin
    bool together = true;
    vec2 reference = vec2(-1.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec3 texel = ivec3(clamp(base + offset, ivec2(0), size - 1), int(view.layer));
        float w = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
        uint packed = texelFetch(lightEntry, texel, 0).x;
        if (packed == 0xffffffffu) {
            // The nearest texel decides whether something that is not skin stands in the way.
            if (w > nearest) nearest = w, blocked = true;
            together = false;
            continue;
        }
        vec2 texelPlace = unpackUnorm2x16(packed) * atlasSize;
        float texelDepth = lightMapDistance(view, texelFetch(lightDepth, texel, 0).x);
        // Just beyond a silhouette the map may miss it and show what lies behind the point: no way in for its light.
        if (texelDepth > here || w == 0.0) continue;
        if (w > nearest) nearest = w, nearestPlace = texelPlace, nearestDepth = texelDepth, blocked = false;
        if (reference.x < 0.0) reference = texelPlace;
        if (distance(reference, texelPlace) > 16.0) together = false;
        place += w * texelPlace;
        depth += w * texelDepth;
        weight += w;
    }
    if (blocked) return none;
    if (together) {
        place /= weight;
        depth /= weight;
    } else {
        place = nearestPlace;
        depth = nearestDepth;
    }
    ivec2 entryTexel = clamp(ivec2(place), ivec2(0), ivec2(atlasSize) - 1);
    float owner = texelFetch(position, entryTexel, 0).w;
    // Light that meets another character first is shadow, not a source.
    if (owner == 0.0 || draws[uint(owner) - 1u].character != character) return none;
    vec3 entryNormal = decodeOctahedral(texelFetch(normal, entryTexel, 0).xy);
    float path = max((here - depth) * rayScale, 0.0) * mmPerUnit;
    // d'Eon & Luebke 2007, §14.5.3: where light leaves through a face opposite to the one it entered, thickness is
    // what the normals measure, not the slanted ray. They take the cosine at the exit, which vanishes at the
    // terminator even if the entry point lies deep across a head; the larger cosine of the two ends is the same on
    // parallel faces, and does not.
    float opposite = clamp(-dot(entryNormal, n), 0.0, 1.0);
    float cosine = clamp(max(-dot(n, l), dot(entryNormal, l)), 0.0, 1.0);
    return EntryPoint(path * mix(1.0, cosine, opposite), place);
}
#endif

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, textureSize(position, 0)))) return;
    vec4 place = texelFetch(position, texel, 0);
    if (place.w == 0.0) {
        imageStore(irradiance, texel, vec4(0.0));
        imageStore(incident, texel, vec4(0.0));
        return;
    }
    DrawInfo draw = draws[uint(place.w) - 1u];
    Material material = materials[draw.material];
    vec4 packedNormals = texelFetch(normal, texel, 0);
    vec3 smoothNormal = decodeOctahedral(packedNormals.xy);  // of the surface itself: shadows and thickness
    vec3 n = decodeOctahedral(packedNormals.zw);             // with the normal map: shading
    vec3 p = place.xyz;

    vec3 arriving = vec3(0.0), entering = vec3(0.0);
    float thickness = kNoThickness;
    vec2 entryTexel = vec2(-1.0);
#ifdef LIGHTS
    float sentOfLight = 0.0, arrivedOfLight = 0.0;
    for (uint i = 0u; i < push.lightCount; ++i) {
        LightSampleData light = lights[i];
        Incident from = incidentLight(light, p);
        vec3 l = from.direction;
        float facing = dot(smoothNormal, l), cosine = dot(n, l);
#ifdef SHADOWS
        bool shadowed = (light.flags & LIGHT_SHADOW) != 0u;
#endif
        if (facing > 0.0 && cosine > 0.0) {
            float visible = 1.0;
#ifdef SHADOWS
            if (shadowed) {
                visible = lightMapVisibility(lightViews[light.firstView + draw.receiverGroup], p, smoothNormal, l,
                                             light.radius, from.distance, (light.flags & LIGHT_DIRECTIONAL) != 0u);
            }
#endif
            vec3 e = from.irradiance * (cosine * visible);
#ifdef SHADOWS
            float sent = cosine * max(from.irradiance.x, max(from.irradiance.y, from.irradiance.z));
            sentOfLight += sent;
            arrivedOfLight += sent * visible;
#endif
            arriving += e;
            entering += e * transmittedFraction(cosine, material.specularScale, material.albedoRow);
        }
#ifdef TRANSLUCENCY
        if (shadowed && facing < 0.0 && (material.flags & MATERIAL_TRANSLUCENT) != 0u &&
            max(from.irradiance.x, max(from.irradiance.y, from.irradiance.z)) > 0.0) {
            LightView view = lightViews[light.firstView + draw.receiverGroup];
            // Distances in a perspective map run along its axis, the path of light runs along the ray.
            float axial = lightMapDistance(view, projectToLightMap(view, p).z);
            float rayScale = view.depthToDistance.y == 0.0 ? 1.0 : from.distance / max(axial, 1e-12);
            EntryPoint found = findEntry(view, p, smoothNormal, l, rayScale, draw.character, material.mmPerUnit);
            if (found.thickness < thickness) {
                thickness = found.thickness;
                entryTexel = found.texel;
            }
        }
#endif
#ifdef SHADOWS
        if (i + 1u == push.lightCount || lights[i + 1u].light != light.light) {
            float share = sentOfLight > 0.0 ? arrivedOfLight / sentOfLight : 1.0;
            imageStore(lightVisibility, ivec3(texel, int(light.light)), vec4(share));
            sentOfLight = arrivedOfLight = 0.0;
        }
#endif
    }
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
#ifdef OPPOSITE
    thickness = texelFetch(opposite, texel, 0).z;
#endif
    imageStore(incident, texel, vec4(arriving, thickness));
#ifdef TRANSLUCENCY
    imageStore(entry, texel, vec4(entryTexel, 0.0, 0.0));
#endif
}
