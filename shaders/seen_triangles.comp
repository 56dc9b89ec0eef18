#version 460
// Which triangles the samples of a tile of the picture see.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform utexture2D triangles;  // triangle + 1
layout(binding = 1, scalar) writeonly buffer SeenBuffer { uint seen[]; };

layout(push_constant, scalar) uniform Push {
    uvec2 size;  // samples
    uint triangleCount;  // that matter: the first ones
} push;

void main() {
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, push.size))) return;
    uint id = texelFetch(triangles, ivec2(gl_GlobalInvocationID.xy), 0).x;
    // Every writer writes the same.
    if (id != 0u && id <= push.triangleCount) seen[id - 1u] = 1u;
}
