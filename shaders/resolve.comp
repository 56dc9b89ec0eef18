#version 460
// The picture from the shading points of each pixel, nearest first within a sample.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
// features: AOVS
#include "shared/scene.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform utexture2D pixels;  // first point and number of points
layout(binding = 1, scalar) readonly buffer PointBuffer { ShadingPoint points[]; };
layout(binding = 2, scalar) readonly buffer ShadedBuffer { ShadedPoint shaded[]; };
layout(binding = 3, rgba32f) writeonly uniform image2D picture;  // radiance times coverage; a: coverage
#ifdef AOVS
layout(binding = 4, rgba32f) writeonly uniform image2DArray aovs;
#endif

layout(push_constant, scalar) uniform Push {
    ivec2 tile, tileSize;  // pixels
    int diffuseLayer, specularLayer;  // of aovs; -1: not wanted
} push;

void main() {
    ivec2 local = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(local, push.tileSize))) return;
    uvec2 range = texelFetch(pixels, local, 0).xy;
    vec3 diffuse = vec3(0.0), specular = vec3(0.0), transmitted = vec3(1.0);
    float coverage = 0.0;
    for (uint i = range.x; i < range.x + range.y; ++i) {
        float weight = points[i].weight;
        if (weight > 0.0) transmitted = vec3(1.0);
        ShadedPoint point = shaded[i];
        vec3 share = abs(weight) * transmitted;
        diffuse += point.diffuse * share;
        specular += point.specular * share;
        coverage += dot(share * (1.0 - point.through), vec3(1.0 / 3.0));
        transmitted *= point.through;
    }
    // Weights that sum to one in floats may miss it by a rounding.
    if (coverage > 1.0 - 1e-6) coverage = 1.0;
    ivec2 pixel = push.tile + local;
    imageStore(picture, pixel, vec4(diffuse + specular, coverage));
#ifdef AOVS
    if (push.diffuseLayer >= 0) imageStore(aovs, ivec3(pixel, push.diffuseLayer), vec4(diffuse, coverage));
    if (push.specularLayer >= 0) imageStore(aovs, ivec3(pixel, push.specularLayer), vec4(specular, coverage));
#endif
}
