#version 460
// Which of 32 directions see the sky from each probe: one bit a direction. A probe is a 2 × 2 block of atlas texels
// (PROBES of skin) or a vertex of what is not skin.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// features: VERTICES
#include "shared/atlas_tiles.h"
#include "shared/scene.h"
#include "lib/geometry.glsl"
#include "lib/octahedral.glsl"

#ifdef VERTICES
layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer PositionBuffer { vec3 positions[]; };
layout(binding = 1, scalar) readonly buffer AttributeBuffer { VertexAttributes attributes[]; };
layout(binding = 2, scalar) writeonly buffer VisibilityBuffer { uint visibility[]; };
#else
layout(local_size_x = 64) in;
layout(binding = 0) uniform texture2D position;
layout(binding = 1) uniform texture2D normal;
layout(binding = 2, r32ui) writeonly uniform uimage2DArray visibility;
layout(binding = 6, scalar) readonly buffer DrawBuffer { DrawInfo draws[]; };
layout(binding = 7, scalar) readonly buffer MaterialBuffer { Material materials[]; };
#endif
layout(binding = 3, scalar) readonly buffer LightViewBuffer { LightView lightViews[]; };
layout(binding = 4) uniform sampler2DArrayShadow lightDepthCompare;

layout(push_constant, scalar) uniform Push {
    TilePush tiles;   // of vertices, the receiver group alone
    uint firstView;   // of the first receiver group whose maps are there
    uint groupViews;  // of each group
    uint word;        // which 32 directions
    uint firstVertex, vertexCount, firstProbe, probeCount;  // of a draw
    float clearance;  // metres: how far a coarser mesh may stand above the surface
} push;

#ifndef VERTICES
#include "lib/atlas_tiles.glsl"
#endif
#include "lib/environment_probe.glsl"
#define LIGHT_MAPS_COMPARE_ONLY
#include "lib/light_maps.glsl"

// ownSide: whether the maps hold the side of the probe's own surface that faces the light.
uint visibilityBits(vec3 p, vec3 n, bool ownSide) {
    uint bits = 0u;
    // Views are found by push constants alone: a software device reads them once for all invocations.
    [[unroll]] for (uint i = 0u; i < 32u; ++i) {
        LightView view = lightViews[push.firstView + push.tiles.receiverGroup * push.groupViews + push.word * 32u + i];
        // Third row of an orthographic matrix: depth grows away from the sky.
        vec3 away = vec3(view.worldToClip[0].z, view.worldToClip[1].z, view.worldToClip[2].z);
        vec3 l = -normalize(away);
        // Normal maps tilt by no more than this.
        bool reaches = lightMapReaches(view, p, n, l, push.clearance, ownSide);
        bits |= dot(n, l) > -0.2 && reaches ? 1u << i : 0u;
    }
    return bits;
}

// No early returns: what is read at one place for all invocations, a software device reads once only where they all are
// sure to be at work.
void main() {
#ifdef VERTICES
    uint i = min(gl_GlobalInvocationID.x, push.vertexCount - 1u);
    uint vertex = push.firstVertex + i;
    visibility[push.word * push.probeCount + push.firstProbe + i] =
        visibilityBits(positions[vertex], attributes[vertex].normal, true);
#else
    ivec2 probe;
    bool listed = tileProbe(probe);
    ivec2 texel = probeTexel(probe);
    listed = listed && texel.x >= 0;
    texel = max(texel, ivec2(0));
    vec4 place = texelFetch(position, texel, 0);
    // Where charts meet, a probe belongs to the one that its texel is of.
    listed = listed && draws[max(uint(place.w), 1u) - 1u].chart == push.tiles.chart;
    ProbePoint point = probePoint(probe, texel);
    const uint kNotClosed = MATERIAL_DOUBLE_SIDED | MATERIAL_MASK | MATERIAL_BLEND;  // DrawRange::closed
    bool ownSide = (materials[draws[max(uint(place.w), 1u) - 1u].material].flags & kNotClosed) != 0u;
    uint bits = visibilityBits(point.position, point.smoothNormal, ownSide);
    if (listed) imageStore(visibility, ivec3(probe, push.word), uvec4(bits));
#endif
}
