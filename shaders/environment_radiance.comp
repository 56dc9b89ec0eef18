#version 460
// Level 0 of the radiance cube from a lat-long image. Peaks of a texel or two would be caught or missed by the samples of
// a cube texel, so the image comes without them, and each is spread over the four cube texels around it with exactly its
// flux.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/environment.h"
#include "lib/sampling.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D latLong;
layout(binding = 1, scalar) readonly buffer SourceBuffer { EnvironmentSource peaks[]; };
layout(binding = 2, rgba32f) writeonly uniform image2DArray target;  // six faces

layout(push_constant, scalar) uniform Push {
    uint peakCount;
} push;

const int kSamples = 3;  // along each axis
const float kPi = 3.14159265358979;

vec3 lookUp(vec3 d) {
    vec2 uv = vec2(0.5 + atan(d.x, -d.z) / (2.0 * kPi), atan(length(d.xz), d.y) / kPi);
    return textureLod(latLong, uv, 0.0).rgb;
}

void main() {
    uvec3 at = gl_GlobalInvocationID;
    uint size = uint(imageSize(target).x);
    if (at.x >= size || at.y >= size) return;
    CubeFace face = cubeFace(at.z);
    vec2 centre = cubeTexelCentre(at.xy, size);
    float texel = 2.0 / float(size);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < kSamples * kSamples; ++i) {
        vec2 offset = (vec2(i % kSamples, i / kSamples) + 0.5) / float(kSamples) - 0.5;
        sum += lookUp(cubeDirection(face, centre + offset * texel));
    }
    vec3 radiance = sum / float(kSamples * kSamples);
    vec3 n = normalize(cubeDirection(face, centre));
    float near = 1.0 - 2.0 * texel * texel;  // no farther than two texels
    for (uint i = 0u; i < push.peakCount; ++i) {
        vec3 p = peaks[i].mean;
        if (dot(n, p) < near) continue;
        float depth = dot(p, face.axis);
        vec2 st = vec2(dot(p, face.right), dot(p, face.down)) / depth;
        vec2 tent = max(1.0 - abs(st - centre) / texel, 0.0);
        radiance += peaks[i].flux * (tent.x * tent.y / cubeTexelSolidAngle(centre, size));
    }
    imageStore(target, ivec3(at), vec4(radiance, 1.0));
}
