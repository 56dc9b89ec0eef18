#version 460
// Where light that arrives from behind enters the skin, and how much skin it crosses: merged by minimum over the light
// samples (DESIGN §1.4), a few of them at a time.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/atlas_tiles.h"
#include "shared/scene.h"
#include "lib/geometry.glsl"
#include "lib/octahedral.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 0) const uint SAMPLES = 4;

layout(binding = 0) uniform texture2D position;  // see surface.comp
layout(binding = 1) uniform texture2D normal;
layout(binding = 2, scalar) readonly buffer DrawBuffer { DrawInfo draws[]; };
layout(binding = 3, scalar) readonly buffer MaterialBuffer { Material materials[]; };
layout(binding = 4, scalar) readonly buffer LightBuffer { LightSampleData lights[]; };
layout(binding = 5, scalar) readonly buffer LightViewBuffer { LightView lightViews[]; };
layout(binding = 6) uniform texture2DArray lightDepth;
layout(binding = 7) uniform utexture2DArray lightEntry;
layout(binding = 8, rgba32f) uniform image2D entry;  // xy: place in the atlas, texels, x < 0: none; z: mm
layout(binding = 9, scalar) readonly buffer GaussianBuffer { GaussianTerm gaussians[]; };
layout(binding = 10, scalar) buffer TileStateBuffer { AtlasTileState states[]; };

layout(push_constant, scalar) uniform Push {
    TilePush tiles;
    uint entryStep;  // of the tiles where light enters
    uint firstSample;
    uint firstView, groupCount;  // views of the first sample; one a receiver group
    uint first, last;            // 1: there are no samples before, or after
} push;

#include "lib/atlas_tiles.glsl"
#include "lib/lights.glsl"
#define LIGHT_MAPS_PROJECTION_ONLY
#include "lib/light_maps.glsl"

#include "lib/entry_tiles.glsl"

const float kNoThickness = 60000.0;  // mm

// Of a distance in a light map, relative: two roundings of a depth, and one of a position.
const float kDepthRounding = 1e-5;

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
        // Behind a veil its light enters where neighbours see through it: how little of it does, the light there says.
        if (packed == ENTRY_VEILED) continue;
        if (packed == ENTRY_NONE) {
            // The nearest texel decides whether something that is not skin stands in the way.
            if (w > nearest) nearest = w, blocked = true;
            together = false;
            continue;
        }
        vec2 texelPlace = unpackUnorm2x16(packed) * atlasSize;
        float texelDepth = lightMapDistance(view, texelFetch(lightDepth, texel, 0).x);
        // Just beyond a silhouette the map may miss it and show what lies behind the point: no way in for its light.
        // Where the body has no thickness the way in lies at the point itself, to a rounding.
        if (texelDepth > here * (1.0 + kDepthRounding) || w == 0.0) continue;
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

// No early returns, and samples found by push constants alone: a software device then reads them once for all invocations.
void main() {
    ivec2 texel;
    uint tile;
    bool listed = tileTexel(texel, tile);
    vec4 place = texelFetch(position, texel, 0);
    listed = listed && place.w > 0.0;
    DrawInfo draw = draws[max(uint(place.w), 1u) - 1u];
    Material material = materials[draw.material];
    listed = listed && (material.flags & MATERIAL_TRANSLUCENT) != 0u;
    vec3 n = decodeOctahedral(texelFetch(normal, texel, 0).xy);
    vec3 p = place.xyz;
    vec4 before = push.first != 0u ? vec4(-1.0, -1.0, kNoThickness, 0.0) : imageLoad(entry, texel);
    EntryPoint thinnest = EntryPoint(before.z, before.xy);
    [[unroll]] for (uint i = 0u; i < SAMPLES; ++i) {
        LightSampleData light = lights[push.firstSample + i];
        LightView view = lightViews[push.firstView + i * push.groupCount + push.tiles.receiverGroup];
        Incident from = incidentLight(light, p);
        vec3 l = from.direction;
        // Distances in a perspective map run along its axis, the path of light runs along the ray.
        float axial = lightMapDistance(view, projectToLightMap(view, p).z);
        float rayScale = view.depthToDistance.y == 0.0 ? 1.0 : from.distance / max(axial, 1e-12);
        EntryPoint found = findEntry(view, p, n, l, rayScale, draw.character, material.mmPerUnit);
        if (dot(n, l) < 0.0 && max(from.irradiance.x, max(from.irradiance.y, from.irradiance.z)) > 0.0 &&
            found.thickness < thinnest.thickness) {
            thinnest = found;
        }
    }
    if (listed) imageStore(entry, texel, vec4(thinnest.texel, thinnest.thickness, 0.0));
    if (push.last != 0u && listed && thinnest.texel.x >= 0.0) markEntry(thinnest.texel, thinnest.thickness, push.entryStep);
}
