#version 460
#extension GL_GOOGLE_include_directive : require
#include "../interop_sample.h"
layout(binding = 0, scalar) readonly buffer Vertices { Vertex vertices[]; };
layout(push_constant, scalar) uniform PushBlock { Placing push; };
void main() {
    Vertex v = vertices[gl_VertexIndex];
    gl_Position = vec4(v.position.xy * push.scale + push.offset, v.position.z, 1.0);
}
