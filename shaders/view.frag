#version 460
// Which triangle a sample of the picture sees: its number plus one. PEEL: the next surface behind the last one drawn,
// for what is seen through.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
// features: MASKED TEXTURED(MASKED) PEEL
#include "shared/scene.h"

layout(push_constant, scalar) uniform Push {
    uint firstTriangle;
    uint material;
} push;

#ifdef MASKED
layout(binding = 3, scalar) readonly buffer MaterialBuffer { Material materials[]; };
#ifdef TEXTURED
layout(binding = 4) uniform sampler2DArray materialTextures[MAX_TEXTURE_GROUPS];
#endif
layout(location = 0) in vec4 inUv;
layout(location = 1) in float inAlpha;
#include "lib/alpha_mask.glsl"
#endif
#ifdef PEEL
layout(binding = 5) uniform texture2D opaqueDepth;
layout(binding = 6) uniform texture2D previousDepth;
#endif

layout(location = 0) out uint outTriangle;

void main() {
#ifdef PEEL
    ivec2 at = ivec2(gl_FragCoord.xy);
    if (gl_FragCoord.z >= texelFetch(opaqueDepth, at, 0).x || gl_FragCoord.z <= texelFetch(previousDepth, at, 0).x) {
        discard;
    }
#endif
#ifdef MASKED
    if (cutOut(push.material, inUv, inAlpha)) discard;
#endif
    outTriangle = push.firstTriangle + uint(gl_PrimitiveID) + 1u;
}
