// Alpha of a material in raster shaders: what a mask cuts out, and what hair and lashes let through to lights.
// The includer declares materials[], materialTextures[] and the two texture coordinates.
#ifndef CUTIS_ALPHA_MASK_GLSL
#define CUTIS_ALPHA_MASK_GLSL

#define CUTIS_TEXTURE_ARRAY materialTextures
#include "lib/texture_array.glsl"

// True where the material has no surface.
bool cutOut(uint index, vec2 uv0, vec2 uv1, float vertexAlpha) {
    TextureRef ref = materials[index].baseColorTexture;
    float alpha = materials[index].baseColor.a * vertexAlpha;
    if (ref.group >= 0) {
        vec3 uv = vec3(ref.texCoord == 1 ? uv1 : uv0, 1.0);
        vec3 at = vec3(dot(ref.u, uv), dot(ref.v, uv), float(ref.layer));
        alpha *= sampleTextureArray(uint(ref.group), at, dFdx(at.xy), dFdy(at.xy)).a;
    }
    return alpha < materials[index].alphaCutoff;
}

#endif
