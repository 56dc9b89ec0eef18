#version 460
// What a light sample meets first. ENTRY: its place in the atlas as two 16-bit fractions, or ENTRY_ where it is not
// SKIN. MASKED: nothing where the material is cut out, and at that share of texels which it lets through.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// features: ENTRY SKIN(ENTRY) MASKED TEXTURED(MASKED)
#include "shared/scene.h"

#ifdef MASKED
layout(push_constant, scalar) uniform Push {
    uint view;
    float texelsToUnit;
    uint material;
    uint seed;
} push;

layout(binding = 4, scalar) readonly buffer MaterialBuffer { Material materials[]; };
#ifdef TEXTURED
layout(binding = 5) uniform sampler2DArray materialTextures[MAX_TEXTURE_GROUPS];
#endif
layout(location = 0) in vec4 inUv;
layout(location = 1) in vec4 inColor;
layout(location = 3) flat in uint inSurface;  // a vertex of the triangle
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
    // The pattern differs from view to view as well: the samples of an area light average it further.
    float threshold = coverageThreshold(uvec2(gl_FragCoord.xy), push.seed ^ inSurface);
    if (stoppedLight(push.material, inUv, inColor) < threshold) discard;
#endif
#ifdef ENTRY
#ifdef SKIN
    outEntry = min(packUnorm2x16(inAtlas), ENTRY_VEILED - 1u);
#elif defined(MASKED)
    bool cut = (materials[push.material].flags & MATERIAL_MASK) != 0u && materials[push.material].clear == 0.0;
    outEntry = cut ? ENTRY_NONE : ENTRY_VEILED;
#else
    outEntry = ENTRY_NONE;
#endif
#endif
}
