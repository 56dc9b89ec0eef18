#version 460
// Writes factor · (x + 256 y) + offset.
layout(local_size_x_id = 1, local_size_y = 4) in;
layout(constant_id = 0) const float factor = 1.0;
layout(binding = 0, r32f) uniform writeonly image2D target;
layout(push_constant) uniform Push { float offset; } push;
void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(target)))) return;
    imageStore(target, at, vec4(factor * float(at.x + 256 * at.y) + push.offset));
}
