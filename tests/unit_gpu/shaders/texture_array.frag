#version 460
#extension GL_GOOGLE_include_directive : require
// Every pixel of a column samples its own texture of the array.
layout(binding = 1) uniform sampler2DArray textures[16];
#define CUTIS_TEXTURE_ARRAY textures
#include "lib/texture_array.glsl"
layout(location = 0) out float value;
void main() {
    value = sampleTextureArray(uint(gl_FragCoord.x), vec3(0.5, 0.5, 0.0), vec2(1.0 / 16.0), vec2(0.0)).x;
}
