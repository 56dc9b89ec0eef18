#version 460
// Work groups for the two lists of shading points.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 1) in;

layout(binding = 0, scalar) readonly buffer CountBuffer { uint pointCount, skinCount, otherCount; };
layout(binding = 1, scalar) writeonly buffer GroupBuffer { uvec3 skinGroups, otherGroups; };

void main() {
    skinGroups = uvec3((skinCount + 63u) / 64u, 1u, 1u);
    otherGroups = uvec3((otherCount + 63u) / 64u, 1u, 1u);
}
