#version 460
// What share of the environment's light reaches each probe, given which directions it sees: the light of each visible
// direction over that of all, weighted by the cosine. And how open its sky is, for reflections. Each dispatch adds 32
// directions to sums that are kept between them.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// features: VERTICES
#include "shared/atlas_tiles.h"
#include "shared/scene.h"
#include "lib/geometry.glsl"
#include "lib/octahedral.glsl"

layout(local_size_x = 64) in;

// Three vectors a probe: light of the visible directions, and the integral of their cosines (w); the same of all
// directions; integral of the visible directions above the surface, and their solid angle (w).
#ifdef VERTICES
layout(binding = 0, scalar) readonly buffer AttributeBuffer { VertexAttributes attributes[]; };
layout(binding = 1, scalar) readonly buffer VisibilityBuffer { uint visibility[]; };
layout(binding = 2, scalar) writeonly buffer ProbeBuffer { vec4 probes[]; };  // two a probe: share, sky
layout(binding = 3, scalar) buffer SumBuffer { vec4 sums[]; };
#else
layout(binding = 0) uniform texture2D position;
layout(binding = 1) uniform texture2D normal;
layout(binding = 2) uniform utexture2DArray visibility;
layout(binding = 3, rgba16f) writeonly uniform image2D occlusion;  // rgb: share · coverage; a: coverage
layout(binding = 4, rgba16f) writeonly uniform image2D openSky;    // xyz: mean open direction · openness; a: coverage
layout(binding = 7, scalar) readonly buffer DrawBuffer { DrawInfo draws[]; };
layout(binding = 8, rgba32f) uniform image2DArray sums;
#endif
layout(binding = 5, scalar) readonly buffer DirectionBuffer { vec4 directions[]; };  // xyz: unit; w: solid angle, sr
layout(binding = 6, scalar) readonly buffer EnvironmentDirectionBuffer { EnvironmentDirection arriving[]; };

layout(push_constant, scalar) uniform Push {
    TilePush tiles;
    uint word;  // which 32 directions
    uint firstVertex, vertexCount, firstProbe, probeCount;  // of a draw
} push;

#ifndef VERTICES
#include "lib/atlas_tiles.glsl"
#endif
#include "lib/environment_probe.glsl"

// n: shading normal, of the light; s: smooth normal, of the sky.
void addDirections(uint visible, vec3 n, vec3 s, inout vec4 seen, inout vec4 all, inout vec4 open) {
    // Directions are found by push constants alone: a software device reads them once for all invocations.
    [[unroll]] for (uint i = 0u; i < 32u; ++i) {
        EnvironmentDirection from = arriving[push.word * 32u + i];
        vec4 part = directions[push.word * 32u + i];
        vec4 light = vec4(from.flux * max(dot(n, from.direction), 0.0), part.w * max(dot(n, part.xyz), 0.0));
        float sees = float((visible >> i) & 1u), above = dot(s, part.xyz) > 0.0 ? 1.0 : 0.0;
        all += light;
        seen += light * sees;
        open += vec4(part.xyz, 1.0) * (part.w * sees * above);
    }
}

vec3 shareOf(vec4 seen, vec4 all) {
    float uniformShare = all.w > 0.0 ? seen.w / all.w : 1.0;
    return vec3(all.x > 0.0 ? seen.x / all.x : uniformShare, all.y > 0.0 ? seen.y / all.y : uniformShare,
                all.z > 0.0 ? seen.z / all.z : uniformShare);
}

vec3 openOf(vec4 open, vec3 s) {
    const float kHemisphere = 6.28318530717959;
    return safeNormalize(open.xyz, s) * min(open.w / kHemisphere, 1.0);
}

// No early returns: what is read at one place for all invocations, a software device reads once only where they all are
// sure to be at work.
void main() {
    vec4 seen = vec4(0.0), all = vec4(0.0), open = vec4(0.0);
#ifdef VERTICES
    uint i = min(gl_GlobalInvocationID.x, push.vertexCount - 1u);
    bool listed = i == gl_GlobalInvocationID.x;
    uint probe = push.firstProbe + i;
    vec3 n = attributes[push.firstVertex + i].normal;
    if (push.word > 0u) {
        seen = sums[probe * 3u];
        all = sums[probe * 3u + 1u];
        open = sums[probe * 3u + 2u];
    }
    addDirections(visibility[push.word * push.probeCount + probe], n, n, seen, all, open);
    if (listed) {
        sums[probe * 3u] = seen;
        sums[probe * 3u + 1u] = all;
        sums[probe * 3u + 2u] = open;
        probes[probe * 2u] = vec4(shareOf(seen, all), 1.0);
        probes[probe * 2u + 1u] = vec4(openOf(open, n), 1.0);
    }
#else
    ivec2 probe;
    bool listed = tileProbe(probe);
    ivec2 texel = probeTexel(probe);
    listed = listed && texel.x >= 0;
    texel = max(texel, ivec2(0));
    // Where charts meet, a probe belongs to the one that its texel is of.
    listed = listed && draws[max(uint(texelFetch(position, texel, 0).w), 1u) - 1u].chart == push.tiles.chart;
    ProbePoint point = probePoint(probe, texel);
    vec3 n = point.mappedNormal, s = point.smoothNormal;
    if (push.word > 0u) {
        seen = imageLoad(sums, ivec3(probe, 0));
        all = imageLoad(sums, ivec3(probe, 1));
        open = imageLoad(sums, ivec3(probe, 2));
    }
    addDirections(texelFetch(visibility, ivec3(probe, push.word), 0).x, n, s, seen, all, open);
    if (listed) {
        imageStore(sums, ivec3(probe, 0), seen);
        imageStore(sums, ivec3(probe, 1), all);
        imageStore(sums, ivec3(probe, 2), open);
        imageStore(occlusion, probe, vec4(shareOf(seen, all), 1.0));
        imageStore(openSky, probe, vec4(openOf(open, s), 1.0));
    }
#endif
}
