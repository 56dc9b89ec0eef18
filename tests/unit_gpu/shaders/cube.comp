#version 460
// Samples the cube along its six axes.
layout(local_size_x = 1) in;
layout(binding = 0) uniform samplerCube cube;
layout(binding = 1) writeonly buffer Values { float values[]; };
void main() {
    const vec3 axes[6] = {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, 1), vec3(0, 0, -1)};
    for (int face = 0; face < 6; ++face) values[face] = textureLod(cube, axes[face], 0.0).r;
}
