// Sampling one of several textures by an index that differs between neighbouring invocations.
//
// Many devices, Mesa's software one among them, cannot index an array of samplers by a value that is not constant, so
// the index selects among constant ones. Define CUTIS_TEXTURE_ARRAY as the name of the array, declared with 16
// elements, before including this:
//
//     layout(binding = 7) uniform sampler2DArray materialTextures[16];
//     #define CUTIS_TEXTURE_ARRAY materialTextures
//     #include "lib/texture_array.glsl"
#ifndef CUTIS_TEXTURE_ARRAY_GLSL
#define CUTIS_TEXTURE_ARRAY_GLSL

// How many of the textures there are: lookups into the rest are not compiled. A software device runs every branch for
// every invocation, so that a texture that is not there would cost as much as one that is.
layout(constant_id = 0) const uint TEXTURE_GROUPS = 16;
// Where one texture is all that is ever looked up: which.
layout(constant_id = 2) const uint ONLY_TEXTURE_GROUP = 0xffffffffu;

// Square of the width, in texels, over which a mip should average for a pixel whose footprint has these sides: that of
// the square of equal area, or a quarter of the longer side where that is more. Half a mip finer than that, since lookups
// between texels and mips blur by as much again.
float filterWidth2(vec2 x, vec2 y) {
    float longer2 = max(dot(x, x), dot(y, y));
    return 0.5 * max(abs(x.x * y.y - x.y * y.x), longer2 / 16.0);
}

// at: texture coordinates and layer; dx, dy: their change over one pixel. They choose the mip here: devices compute it
// from gradients each in its own way, and pictures should agree.
vec4 sampleTextureArray(uint index, vec3 at, vec2 dx, vec2 dy) {
    vec4 value = vec4(0.0);
#define CUTIS_SAMPLE(i) \
    if (i < TEXTURE_GROUPS && (ONLY_TEXTURE_GROUP == 0xffffffffu || ONLY_TEXTURE_GROUP == i) && index == i) { \
        vec2 size = vec2(textureSize(CUTIS_TEXTURE_ARRAY[i], 0).xy); \
        value = textureLod(CUTIS_TEXTURE_ARRAY[i], at, 0.5 * log2(max(filterWidth2(dx * size, dy * size), 1e-12))); \
    }
    CUTIS_SAMPLE(0u) CUTIS_SAMPLE(1u) CUTIS_SAMPLE(2u) CUTIS_SAMPLE(3u)
    CUTIS_SAMPLE(4u) CUTIS_SAMPLE(5u) CUTIS_SAMPLE(6u) CUTIS_SAMPLE(7u)
    CUTIS_SAMPLE(8u) CUTIS_SAMPLE(9u) CUTIS_SAMPLE(10u) CUTIS_SAMPLE(11u)
    CUTIS_SAMPLE(12u) CUTIS_SAMPLE(13u) CUTIS_SAMPLE(14u) CUTIS_SAMPLE(15u)
#undef CUTIS_SAMPLE
    return value;
}

#endif
