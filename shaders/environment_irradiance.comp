#version 460
// Irradiance of the environment for every normal: a sum over its clusters. With MATTE, the part of it that skin of one
// roughness reflects specularly (DESIGN §1.1). With FINE, on top of the interpolated sum of other clusters.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// features: MATTE FINE
#include "shared/environment.h"
#include "lib/sampling.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0, scalar) readonly buffer SourceBuffer { EnvironmentSource sources[]; };
layout(binding = 1, rgba32f) writeonly uniform image2DArray target;  // six faces
#ifdef MATTE
layout(binding = 2, scalar) readonly buffer AlbedoTableBuffer { float albedoTable[]; };
#define ALBEDO_TABLE(i) albedoTable[i]
#include "lib/skin_specular.glsl"
#endif
#ifdef FINE
layout(binding = 3) uniform samplerCube coarse;
#endif

layout(push_constant, scalar) uniform Push {
    uint first, count;    // of `sources`
    float largestAlbedo;  // 1/s: what ρ_dt is cut off at
} push;

// One texel of every face: sources are loaded once for six normals.
void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    uint size = uint(imageSize(target).x);
    if (at.x >= size || at.y >= size) return;
    vec3 n[6], sum[6];
    for (uint face = 0u; face < 6u; ++face) {
        n[face] = normalize(cubeDirection(cubeFace(face), cubeTexelCentre(at, size)));
#ifdef FINE
        sum[face] = textureLod(coarse, n[face], 0.0).rgb;
#else
        sum[face] = vec3(0.0);
#endif
    }
    for (uint i = 0u; i < push.count; ++i) {
        EnvironmentSource source = sources[push.first + i];
        for (uint face = 0u; face < 6u; ++face) {
            float cosine = max(dot(n[face], source.mean), 0.0);
#ifdef MATTE
            cosine *= min(directionalAlbedo(cosine, 0u), push.largestAlbedo);
#endif
            sum[face] += source.flux * cosine;
        }
    }
    for (uint face = 0u; face < 6u; ++face) imageStore(target, ivec3(at, face), vec4(sum[face], 1.0));
}
