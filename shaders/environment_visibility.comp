#version 460
// Which of 32 directions see the sky from each probe: one bit a direction. A probe is a 2 × 2 block of atlas texels
// (PROBES of skin) or a vertex of what is not skin.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
// features: VERTICES
#include "shared/scene.h"
#include "lib/geometry.glsl"
#include "lib/octahedral.glsl"

#ifdef VERTICES
layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer PositionBuffer { vec3 positions[]; };
layout(binding = 1, scalar) readonly buffer AttributeBuffer { VertexAttributes attributes[]; };
layout(binding = 2, scalar) writeonly buffer VisibilityBuffer { uint visibility[]; };
#else
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform texture2D position;
layout(binding = 1) uniform texture2D normal;
layout(binding = 2, r32ui) writeonly uniform uimage2DArray visibility;
layout(binding = 6, scalar) readonly buffer DrawBuffer { DrawInfo draws[]; };
#endif
layout(binding = 3, scalar) readonly buffer LightViewBuffer { LightView lightViews[]; };
layout(binding = 4) uniform sampler2DArrayShadow lightDepthCompare;

layout(push_constant, scalar) uniform Push {
    uint receiverGroup;  // whose views these are
    uint firstView;      // of the batch: 32 directions of this group
    uint count;          // directions in the batch
    uint batch;          // which 32 bits
    uint firstVertex, vertexCount, firstProbe, probeCount;
    uvec2 origin, size;  // of the probes of one chart
    float clearance;  // metres: how far a coarser mesh may stand above the surface
} push;

#include "lib/environment_probe.glsl"
#define LIGHT_MAPS_COMPARE_ONLY
#include "lib/light_maps.glsl"

uint visibilityBits(vec3 p, vec3 n) {
    uint bits = 0u;
    for (uint i = 0u; i < push.count; ++i) {
        LightView view = lightViews[push.firstView + i];
        // Third row of an orthographic matrix: depth grows away from the sky.
        vec3 away = vec3(view.worldToClip[0].z, view.worldToClip[1].z, view.worldToClip[2].z);
        vec3 l = -normalize(away);
        if (dot(n, l) <= -0.2) continue;  // normal maps tilt by no more than this
        if (lightMapReaches(view, p, n, l, push.clearance)) bits |= 1u << i;
    }
    return bits;
}

void main() {
#ifdef VERTICES
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.vertexCount) return;
    uint vertex = push.firstVertex + i;
    visibility[push.batch * push.probeCount + push.firstProbe + i] =
        visibilityBits(positions[vertex], attributes[vertex].normal);
#else
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, push.size))) return;
    ivec2 probe = ivec2(push.origin + gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(probe, imageSize(visibility).xy))) return;
    ivec2 texel = probeTexel(probe);
    if (texel.x < 0) return;
    vec4 place = texelFetch(position, texel, 0);
    if (draws[uint(place.w) - 1u].receiverGroup != push.receiverGroup) return;
    vec3 n = decodeOctahedral(texelFetch(normal, texel, 0).xy);
    imageStore(visibility, ivec3(probe, push.batch), uvec4(visibilityBits(place.xyz, n)));
#endif
}
