#version 460
// One colour for all texels of the layers of an image of floats (Commands::clear).
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) writeonly uniform image2DArray target;

layout(push_constant) uniform Push {
    vec4 color;
} push;

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    if (all(lessThan(texel.xy, imageSize(target).xy))) imageStore(target, texel, push.color);
}
