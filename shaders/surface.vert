#version 460
// Draws skin triangles at their place in the atlas. `offset` shifts border triangles by up to a texel, so that every
// texel a bilinear lookup touches inside a chart belongs to a triangle.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/scene.h"

layout(binding = 0, scalar) readonly buffer IndexBuffer { uint indices[]; };
layout(binding = 1, scalar) readonly buffer TriangleList { uint triangleList[]; };
layout(binding = 2, scalar) readonly buffer AtlasVertexBuffer { AtlasVertex atlasVertices[]; };

layout(push_constant, scalar) uniform Push {
    vec2 atlasSize;  // texels
    vec2 offset;     // texels
} push;

layout(location = 0) flat out uint outTriangle;

void main() {
    uint triangle = triangleList[gl_VertexIndex / 3];
    vec2 texel = atlasVertices[indices[triangle * 3u + gl_VertexIndex % 3]].texel + push.offset;
    outTriangle = triangle + 1u;
    gl_Position = vec4(texel / push.atlasSize * 2.0 - 1.0, 0.5, 1.0);
}
