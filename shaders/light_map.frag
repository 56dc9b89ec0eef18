#version 460
// What a light sample meets first. ENTRY: its place in the atlas as two 16-bit fractions, all bits set where it is not
// SKIN. MASKED: nothing where the material is cut out.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// features: ENTRY SKIN(ENTRY) MASKED
#include "shared/scene.h"

#ifdef MASKED
layout(push_constant, scalar) uniform Push {
    uint view;
    float texelsToUnit;
    uint material;
} push;

layout(binding = 4, scalar) readonly buffer MaterialBuffer { Material materials[]; };
layout(binding = 5) uniform sampler2DArray materialTextures[MAX_TEXTURE_GROUPS];
layout(location = 0) in vec4 inUv;
layout(location = 1) in float inAlpha;
#include "lib/alpha_mask.glsl"
#endif
#ifdef SKIN
layout(location = 2) in vec2 inAtlas;
#endif
#ifdef ENTRY
layout(location = 0) out uint outEntry;
#endif

void main() {
#ifdef MASKED
    if (cutOut(push.material, inUv.xy, inUv.zw, inAlpha)) discard;
#endif
#ifdef ENTRY
#ifdef SKIN
    outEntry = min(packUnorm2x16(inAtlas), 0xfffffffeu);
#else
    outEntry = 0xffffffffu;
#endif
#endif
}
