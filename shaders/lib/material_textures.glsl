// Material textures: `materialTextures` is declared by the includer. See TextureRef in shared/scene.h.
#ifndef CUTIS_MATERIAL_TEXTURES_GLSL
#define CUTIS_MATERIAL_TEXTURES_GLSL
#include "lib/geometry.glsl"

#define CUTIS_TEXTURE_ARRAY materialTextures
#include "lib/texture_array.glsl"

layout(constant_id = 1) const uint TEXTURE_SLOTS = 31;  // SLOT_ bits: lookups that no material makes are not compiled

// Both texture coordinates of a point and their change over one texel or pixel.
struct SurfaceUv {
    vec2 uv0, uv1;
    vec2 dx0, dy0, dx1, dy1;
};

// w: barycentric coordinates of the point; wx, wy: those one step to the right and below.
SurfaceUv surfaceUv(vec3 w, vec3 wx, vec3 wy, VertexAttributes a, VertexAttributes b, VertexAttributes c) {
    SurfaceUv s;
    s.uv0 = interpolate(w, a.uv0, b.uv0, c.uv0);
    s.uv1 = interpolate(w, a.uv1, b.uv1, c.uv1);
    s.dx0 = interpolate(wx - w, a.uv0, b.uv0, c.uv0);
    s.dy0 = interpolate(wy - w, a.uv0, b.uv0, c.uv0);
    s.dx1 = interpolate(wx - w, a.uv1, b.uv1, c.uv1);
    s.dy1 = interpolate(wy - w, a.uv1, b.uv1, c.uv1);
    return s;
}

vec4 sampleMaterial(TextureRef ref, SurfaceUv s) {
    bool second = ref.texCoord == 1;
    vec2 uv = second ? s.uv1 : s.uv0, dx = second ? s.dx1 : s.dx0, dy = second ? s.dy1 : s.dy0;
    vec3 at = vec3(dot(ref.u, vec3(uv, 1.0)), dot(ref.v, vec3(uv, 1.0)), float(ref.layer));
    vec2 gx = vec2(dot(ref.u.xy, dx), dot(ref.v.xy, dx)), gy = vec2(dot(ref.u.xy, dy), dot(ref.v.xy, dy));
    return sampleTextureArray(uint(ref.group), at, gx, gy);
}

// A tangent-space normal map's normal in world space (glTF: +X tangent, +Y bitangent, +Z normal). Maps hold unit
// vectors, and the device their x and y alone.
vec3 mappedNormal(vec3 n, vec4 tangent, vec2 texel, float scale) {
    vec2 xy = texel * 2.0 - 1.0;
    vec3 local = vec3(xy * scale, sqrt(max(1.0 - dot(xy, xy), 0.0)));
    vec3 t = tangent.xyz - n * dot(n, tangent.xyz);
    float len = length(t);
    if (!(len > 1e-6)) return n;
    t /= len;
    vec3 b = cross(n, t) * (tangent.w < 0.0 ? -1.0 : 1.0);
    return safeNormalize(t * local.x + b * local.y + n * local.z, n);
}

#endif
