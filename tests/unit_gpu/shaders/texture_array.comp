#version 460
#extension GL_GOOGLE_include_directive : require
// Every invocation samples another texture of the array: which one differs within each subgroup.
struct Choice {
    uint texture_;
    float texels;  // over which one step to the right or down goes, in texels of mip 0 of a texture that is 64 wide and high
};
layout(local_size_x = 64) in;
layout(binding = 0) uniform sampler2DArray textures[16];
layout(binding = 1) readonly buffer Choices { Choice choices[]; };
layout(binding = 2) writeonly buffer Values { vec4 values[]; };
#define CUTIS_TEXTURE_ARRAY textures
#include "lib/texture_array.glsl"
void main() {
    uint i = gl_GlobalInvocationID.x;
    Choice choice = choices[i];
    values[i] = sampleTextureArray(choice.texture_, vec3(0.5, 0.5, 1.0), vec2(choice.texels / 64.0, 0.0), vec2(0.0, choice.texels / 64.0));
}
