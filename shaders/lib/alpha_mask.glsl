// Alpha of a material in raster shaders: what a mask cuts out, and what hair and lashes let through to lights.
// The includer declares materials[] and, with TEXTURED, materialTextures[].
#ifndef CUTIS_ALPHA_MASK_GLSL
#define CUTIS_ALPHA_MASK_GLSL

#ifdef TEXTURED
#define CUTIS_TEXTURE_ARRAY materialTextures
#include "lib/texture_array.glsl"
#endif

#ifdef TEXTURED
// Their change over one pixel is taken before any branch: within one, a software device holds nothing for the pixels of a
// quad outside the triangle.
vec4 maskTexel(TextureRef ref, vec4 uv, vec4 dx, vec4 dy) {
    if (ref.group < 0) return vec4(1.0);
    bool second = ref.texCoord == 1;
    vec3 place = vec3(second ? uv.zw : uv.xy, 1.0);
    vec2 ux = second ? dx.zw : dx.xy, uy = second ? dy.zw : dy.xy;
    return sampleTextureArray(uint(ref.group), vec3(dot(ref.u, place), dot(ref.v, place), float(ref.layer)),
                              vec2(dot(ref.u.xy, ux), dot(ref.v.xy, ux)),
                              vec2(dot(ref.u.xy, uy), dot(ref.v.xy, uy)));
}
#endif

// Base colour and alpha. uv: both texture coordinates; vertexColor: of the vertex.
vec4 surfaceColor(uint index, vec4 uv, vec4 vertexColor) {
    vec4 color = materials[index].baseColor * vertexColor;
#ifdef TEXTURED
    color *= maskTexel(materials[index].baseColorTexture, uv, dFdx(uv), dFdy(uv));
#endif
    return color;
}

// True where the material has no surface.
bool cutOut(uint index, vec4 uv, float vertexAlpha) {
    return surfaceColor(index, uv, vec4(vertexAlpha)).a < materials[index].alphaCutoff;
}

// The share of light that a surface stops, in [0,1]: what it covers, less what goes straight through that. One number for
// all colours, since a light map holds a surface or none.
float stoppedLight(uint index, vec4 uv, vec4 vertexColor) {
    vec4 color = surfaceColor(index, uv, vertexColor);
    float clear = materials[index].clear;
#ifdef TEXTURED
    clear *= maskTexel(materials[index].transmissionTexture, uv, dFdx(uv), dFdy(uv)).r;
#endif
    uint flags = materials[index].flags;
    float covered = (flags & MATERIAL_MASK) != 0u  ? (color.a < materials[index].alphaCutoff ? 0.0 : 1.0)
                    : (flags & MATERIAL_BLEND) != 0u ? color.a
                                                     : 1.0;
    return covered * (1.0 - clear * dot(clamp(color.rgb, 0.0, 1.0), vec3(1.0 / 3.0)));
}

uint hash(uint x) {  // PCG (O'Neill 2014)
    x = x * 747796405u + 2891336453u;
    x = ((x >> ((x >> 28u) + 4u)) ^ x) * 277803737u;
    return x >> 22u ^ x;
}

// For a surface that lets a part of the light through: the alpha from which it stops light at this texel of a map. Each
// square of four texels holds one threshold in each quarter of [0,1], so that averages over a few texels are even; their
// order is drawn anew for each square and `surface`, so that what two surfaces let through one behind the other is the
// product of both.
float coverageThreshold(uvec2 texel, uint surface) {
    uint random = hash(texel.x >> 1u ^ hash(texel.y >> 1u ^ hash(surface)));
    // Any order of four places is an affine map of two bits.
    uint alongX = 1u + random % 3u, alongY = 1u + (alongX + (random >> 8u & 1u)) % 3u;
    uint quarter = (random >> 9u ^ (texel.x & 1u) * alongX ^ (texel.y & 1u) * alongY) & 3u;
    return (float(quarter) + (float(random >> 16u) + 0.5) / 65536.0) / 4.0;
}

#endif
