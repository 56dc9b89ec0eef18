#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
// Every invocation samples another texture of the array: which one differs within each subgroup.
layout(local_size_x = 64) in;
layout(binding = 0) uniform sampler2DArray textures[16];
layout(binding = 1) readonly buffer Choice { uint choice[]; };
layout(binding = 2) writeonly buffer Values { vec4 values[]; };
#ifdef WATERFALL
vec4 fetch(uint index, vec3 at) {
    vec4 value = vec4(0.0);
    for (bool pending = true; pending;) {
        uint current = subgroupBroadcastFirst(index);
        if (current == index) {
            value = textureGrad(textures[current], at, vec2(0.0), vec2(0.0));
            pending = false;
        }
    }
    return value;
}
#else
#define CUTIS_TEXTURE_ARRAY textures
#include "lib/texture_array.glsl"
vec4 fetch(uint index, vec3 at) { return sampleTextureArray(index, at, vec2(0.0), vec2(0.0)); }
#endif
void main() {
    uint i = gl_GlobalInvocationID.x;
    values[i] = fetch(choice[i], vec3(0.5, 0.5, 1.0));
}
