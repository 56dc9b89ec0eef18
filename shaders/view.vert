#version 460
// Geometry as the picture's camera sees it.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// features: MASKED
#include "shared/scene.h"

layout(binding = 0, scalar) readonly buffer PositionBuffer { vec3 positions[]; };
layout(binding = 1, scalar) readonly buffer CameraBuffer { ViewCamera camera; };
#ifdef MASKED
layout(binding = 2, scalar) readonly buffer AttributeBuffer { VertexAttributes attributes[]; };
layout(location = 0) out vec4 outUv;
layout(location = 1) out float outAlpha;
#endif

void main() {
#ifdef MASKED
    outUv = vec4(attributes[gl_VertexIndex].uv0, attributes[gl_VertexIndex].uv1);
    outAlpha = attributes[gl_VertexIndex].color.a;
#endif
    gl_Position = camera.worldToClip * vec4(positions[gl_VertexIndex], 1.0);
}
