#version 460
#extension GL_GOOGLE_include_directive : require
#include "../interop_sample.h"
layout(local_size_x = 1) in;
layout(binding = 0, scalar) readonly buffer Source { Mixed source[]; };
layout(binding = 1, scalar) writeonly buffer Target { float target[]; };
layout(push_constant, scalar) uniform PushBlock { Mixed push; };
// Every field of push and of the second element, so that a wrong offset or stride shows.
void write(int first, Mixed m) {
    target[first] = m.a.z;
    target[first + 1] = m.b;
    target[first + 2] = m.m[2][1];
    target[first + 3] = float(m.c.y);
    target[first + 4] = m.list[2];
}
void main() {
    write(0, push);
    write(5, source[1]);
}
