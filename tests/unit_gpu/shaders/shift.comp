#version 460
// target(x) = source(x + 1 mod width) + 1: wrong at once when a barrier is missing, since neighbours are read.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, r32f) uniform readonly image2D source;
layout(binding = 1, r32f) uniform writeonly image2D target;
void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(target);
    if (any(greaterThanEqual(at, size))) return;
    imageStore(target, at, imageLoad(source, ivec2((at.x + 1) % size.x, at.y)) + 1.0);
}
