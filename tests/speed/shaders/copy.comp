#version 460
// Each texel once from one image to the other: what the device can move, told from what its copy commands do.
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 64, local_size_y = 4) in;

layout(binding = 0) uniform texture2D source;
layout(binding = 1, rgba32f) writeonly uniform image2D target;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    imageStore(target, texel, texelFetch(source, texel, 0));
}
