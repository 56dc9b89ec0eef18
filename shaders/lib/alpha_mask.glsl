// Alpha of a material in raster shaders: what a mask cuts out, and what hair and lashes let through to lights.
// The includer declares materials[], materialTextures[] and the two texture coordinates.
#ifndef CUTIS_ALPHA_MASK_GLSL
#define CUTIS_ALPHA_MASK_GLSL

#define CUTIS_TEXTURE_ARRAY materialTextures
#include "lib/texture_array.glsl"

// True where the material has no surface.
bool cutOut(uint index, vec2 uv0, vec2 uv1, float vertexAlpha) {
    // Before any branch: within one, a software device may hold nothing for the pixels of a quad outside the triangle.
    vec4 dx = vec4(dFdx(uv0), dFdx(uv1)), dy = vec4(dFdy(uv0), dFdy(uv1));
    TextureRef ref = materials[index].baseColorTexture;
    float alpha = materials[index].baseColor.a * vertexAlpha;
    if (ref.group >= 0) {
        bool second = ref.texCoord == 1;
        vec3 uv = vec3(second ? uv1 : uv0, 1.0);
        vec2 ux = second ? dx.zw : dx.xy, uy = second ? dy.zw : dy.xy;
        vec3 at = vec3(dot(ref.u, uv), dot(ref.v, uv), float(ref.layer));
        vec2 ax = vec2(dot(ref.u.xy, ux), dot(ref.v.xy, ux)), ay = vec2(dot(ref.u.xy, uy), dot(ref.v.xy, uy));
        alpha *= sampleTextureArray(uint(ref.group), at, ax, ay).a;
    }
    return alpha < materials[index].alphaCutoff;
}

#endif
