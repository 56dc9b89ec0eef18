#version 460
// Adds a sampled texel of every layer to sums[layer], by way of a buffer that is read and written.
layout(local_size_x = 8) in;
layout(binding = 0) uniform sampler2DArray layers;
layout(binding = 1) buffer Sums { float sums[]; };
void main() {
    uint layer = gl_GlobalInvocationID.x;
    if (layer < textureSize(layers, 0).z) sums[layer] += textureLod(layers, vec3(0.5, 0.5, layer), 0.0).r;
}
