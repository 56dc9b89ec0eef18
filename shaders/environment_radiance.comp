#version 460
// The radiance cube from a lat-long image. Peaks of a texel or two would be caught or missed by the samples of
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

const int kSamples = 2;  // along each axis
const float kPi = 3.14159265358979;

vec3 lookUp(vec3 d) {
    vec2 uv = vec2(0.5 + atan(d.x, -d.z) / (2.0 * kPi), atan(length(d.xz), d.y) / kPi);
    return textureLod(latLong, uv, 0.0).rgb;
}

// One texel of every face: peaks are loaded once for six directions.
void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    uint size = uint(imageSize(target).x);
    if (at.x >= size || at.y >= size) return;
    vec2 centre = cubeTexelCentre(at, size);
    float texel = 2.0 / float(size);
    vec3 radiance[6];
    for (uint face = 0u; face < 6u; ++face) {
        radiance[face] = vec3(0.0);
        for (int i = 0; i < kSamples * kSamples; ++i) {
            vec2 offset = (vec2(i % kSamples, i / kSamples) + 0.5) / float(kSamples) - 0.5;
            radiance[face] += lookUp(cubeDirection(cubeFace(face), centre + offset * texel));
        }
        radiance[face] /= float(kSamples * kSamples);
    }
    float share = 1.0 / cubeTexelSolidAngle(centre, size);
    for (uint i = 0u; i < push.peakCount; ++i) {
        vec3 p = peaks[i].mean;
        for (uint face = 0u; face < 6u; ++face) {
            CubeFace f = cubeFace(face);
            // Where the peak is seen on the face's plane; behind it, or just beyond its edge, the tent is 0 or shared with
            // the neighbouring face.
            float depth = dot(p, f.axis);
            vec2 st = vec2(dot(p, f.right), dot(p, f.down)) / max(depth, 1e-3);
            vec2 tent = max(1.0 - abs(st - centre) / texel, 0.0);
            if (depth > 0.5 && tent.x * tent.y > 0.0) radiance[face] += peaks[i].flux * (tent.x * tent.y * share);
        }
    }
    for (uint face = 0u; face < 6u; ++face) imageStore(target, ivec3(at, face), vec4(radiance[face], 1.0));
}
