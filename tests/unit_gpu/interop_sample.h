// Structs that the tests' shaders and C++ share.
#ifndef CUTIS_TESTS_INTEROP_SAMPLE_H
#define CUTIS_TESTS_INTEROP_SAMPLE_H
#include "shared/interop.h"
CUTIS_SHARED_BEGIN
struct Vertex {
    vec3 position;  // clip space
};
struct Placing {
    vec2 scale, offset;  // clip space
};
struct Mixed {
    vec3 a;
    float b;
    mat3 m;
    uvec2 c;
    float list[3];
};
CUTIS_SHARED_END
#endif
