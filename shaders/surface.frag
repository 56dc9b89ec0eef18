#version 460
// Which triangle owns an atlas texel: its number plus one.
layout(location = 0) flat in uint inTriangle;
layout(location = 0) out uint outTriangle;

void main() { outTriangle = inTriangle; }
