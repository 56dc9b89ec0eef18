#version 460
// Geometry as a light sample sees it. TRANSLUCENT: with the place in the atlas of the skin that it lights first.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// features: SKIN MASKED
#include "shared/scene.h"

layout(binding = 0, scalar) readonly buffer PositionBuffer { vec3 positions[]; };
layout(binding = 1, scalar) readonly buffer LightViewBuffer { LightView lightViews[]; };
#ifdef MASKED
layout(binding = 2, scalar) readonly buffer AttributeBuffer { VertexAttributes attributes[]; };
layout(location = 0) out vec4 outUv;
layout(location = 1) out vec4 outColor;
layout(location = 3) flat out uint outSurface;
#endif
#ifdef SKIN
layout(binding = 3, scalar) readonly buffer AtlasVertexBuffer { AtlasVertex atlasVertices[]; };
layout(location = 2) out vec2 outAtlas;
#endif

layout(push_constant, scalar) uniform Push {
    uint view;
    float texelsToUnit;  // 1 / atlas size
    uint material;
    uint seed;  // of the view: the same wherever it stands in the buffer
} push;

void main() {
#ifdef MASKED
    outUv = vec4(attributes[gl_VertexIndex].uv0, attributes[gl_VertexIndex].uv1);
    outColor = attributes[gl_VertexIndex].color;
    outSurface = gl_VertexIndex;
#endif
#ifdef SKIN
    outAtlas = atlasVertices[gl_VertexIndex].texel * push.texelsToUnit;
#endif
    gl_Position = lightViews[push.view].worldToClip * vec4(positions[gl_VertexIndex], 1.0);
}
