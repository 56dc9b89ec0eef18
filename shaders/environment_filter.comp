#version 460
// A wider lobe of the environment's radiance: one mip of a cube convolved with exp((cosθ - 1)/σ²) around each texel of
// another.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/environment.h"
#include "lib/sampling.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform samplerCube source;  // one mip
layout(binding = 1, rgba32f) writeonly uniform image2DArray target;  // six faces

layout(push_constant, scalar) uniform Push {
    float sigma;  // radians
    float reach;  // radians from the centre to the last sample
    int rings;    // samples along the reach
} push;

void main() {
    uvec3 at = gl_GlobalInvocationID;
    uint size = uint(imageSize(target).x);
    if (at.x >= size || at.y >= size) return;
    vec3 n = normalize(cubeDirection(cubeFace(at.z), cubeTexelCentre(at.xy, size)));
    mat3 frame = frameAlong(n, vec3(0.0));
    float step = push.reach / float(push.rings);
    vec3 sum = vec3(0.0);
    float total = 0.0;
    for (int j = -push.rings; j <= push.rings; ++j) {
        for (int i = -push.rings; i <= push.rings; ++i) {
            if (i * i + j * j > push.rings * push.rings) continue;
            vec2 p = vec2(i, j) * step;  // polar coordinates around n, laid out flat
            float angle = length(p);
            float stretch = angle > 1e-4 ? sin(angle) / angle : 1.0;  // area of the sphere per area of the layout
            float weight = exp((cos(angle) - 1.0) / (push.sigma * push.sigma)) * stretch;
            vec3 d = frame * vec3(p * stretch, cos(angle));
            sum += weight * textureLod(source, d, 0.0).rgb;
            total += weight;
        }
    }
    imageStore(target, ivec3(at), vec4(sum / total, 1.0));
}
