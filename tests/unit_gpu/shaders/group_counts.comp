#version 460
// Writes the arguments of a later indirect dispatch.
layout(local_size_x = 1) in;
layout(binding = 0) writeonly buffer Groups { uint groups[3]; };
layout(push_constant) uniform Push { uint count; } push;
void main() {
    groups[0] = push.count;
    groups[1] = groups[2] = 1;
}
