#version 460
// What share of the environment's light reaches each probe, given which directions it sees: the light of each visible
// direction over that of all, weighted by the cosine. And how open its sky is, for reflections.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
// features: VERTICES
#include "shared/scene.h"
#include "lib/geometry.glsl"
#include "lib/octahedral.glsl"

#ifdef VERTICES
layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer AttributeBuffer { VertexAttributes attributes[]; };
layout(binding = 1, scalar) readonly buffer VisibilityBuffer { uint visibility[]; };
layout(binding = 2, scalar) writeonly buffer ProbeBuffer { vec4 probes[]; };  // two a probe: share, sky
#else
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform texture2D position;
layout(binding = 1) uniform texture2D normal;
layout(binding = 2) uniform utexture2DArray visibility;
layout(binding = 3, rgba16f) writeonly uniform image2D occlusion;  // rgb: share · coverage; a: coverage
layout(binding = 4, rgba16f) writeonly uniform image2D openSky;    // xyz: mean open direction · openness; a: coverage
#endif
layout(binding = 5, scalar) readonly buffer DirectionBuffer { vec4 directions[]; };  // xyz: unit
layout(binding = 6, scalar) readonly buffer EnvironmentDirectionBuffer { EnvironmentDirection arriving[]; };

layout(push_constant, scalar) uniform Push {
    uint directionCount;
    uint firstVertex, vertexCount, firstProbe, probeCount;
} push;

#include "lib/environment_probe.glsl"

uint visibilityWord(uint word) {
#ifdef VERTICES
    return visibility[word * push.probeCount + push.firstProbe + gl_GlobalInvocationID.x];
#else
    return texelFetch(visibility, ivec3(gl_GlobalInvocationID.xy, word), 0).x;
#endif
}

// n: shading normal, of the light; s: smooth normal, of the sky.
void gather(vec3 n, vec3 s, out vec3 share, out vec3 open) {
    vec3 seen = vec3(0.0), all = vec3(0.0), openSum = vec3(0.0);
    float seenCosine = 0.0, allCosine = 0.0, openCount = 0.0, count = 0.0;
    uint word = 0u;
    for (uint i = 0u; i < push.directionCount; ++i) {
        if ((i & 31u) == 0u) word = visibilityWord(i >> 5);
        float visible = float((word >> (i & 31u)) & 1u);
        EnvironmentDirection from = arriving[i];
        vec3 contribution = from.flux * max(dot(n, from.direction), 0.0);
        all += contribution;
        seen += contribution * visible;
        vec3 d = directions[i].xyz;
        float cosine = max(dot(n, d), 0.0);
        allCosine += cosine;
        seenCosine += cosine * visible;
        if (dot(s, d) > 0.0) {
            count += 1.0;
            openCount += visible;
            openSum += d * visible;
        }
    }
    float uniformShare = allCosine > 0.0 ? seenCosine / allCosine : 1.0;
    share = vec3(all.x > 0.0 ? seen.x / all.x : uniformShare, all.y > 0.0 ? seen.y / all.y : uniformShare,
                 all.z > 0.0 ? seen.z / all.z : uniformShare);
    open = safeNormalize(openSum, s) * (count > 0.0 ? openCount / count : 1.0);
}

void main() {
    vec3 share, open;
#ifdef VERTICES
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.vertexCount) return;
    vec3 n = attributes[push.firstVertex + i].normal;
    gather(n, n, share, open);
    probes[(push.firstProbe + i) * 2u] = vec4(share, 1.0);
    probes[(push.firstProbe + i) * 2u + 1u] = vec4(open, 1.0);
#else
    ivec2 probe = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(probe, imageSize(occlusion)))) return;
    ivec2 texel = probeTexel(probe);
    if (texel.x < 0) {
        imageStore(occlusion, probe, vec4(0.0));
        imageStore(openSky, probe, vec4(0.0));
        return;
    }
    vec4 normals = texelFetch(normal, texel, 0);
    gather(decodeOctahedral(normals.zw), decodeOctahedral(normals.xy), share, open);
    imageStore(occlusion, probe, vec4(share, 1.0));
    imageStore(openSky, probe, vec4(open, 1.0));
#endif
}
