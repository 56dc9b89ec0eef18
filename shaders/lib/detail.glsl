// Pores: what turns skin's normal where the view comes closer than textures resolve, and the roughness that it takes in
// exchange (renderer/skin/detail.h). Part of shade.comp.
#ifndef CUTIS_DETAIL_GLSL
#define CUTIS_DETAIL_GLSL

#include "shared/detail.h"

// Gradient of the relief at a place in tiles, from the three planes across the axes: weights that fall to nothing where the
// plane does not face the surface, over their length, which keeps the variance of a sum of independent slopes.
vec3 detailGradient(vec3 place, vec3 n, float level) {
    vec3 weight = n * n;
    weight *= weight;
    vec2 x = textureLod(detailSlopes, place.yz, level).xy, y = textureLod(detailSlopes, place.zx, level).xy,
         z = textureLod(detailSlopes, place.xy, level).xy;
    return (weight.x * vec3(0.0, x) + weight.y * vec3(y.y, 0.0, y.x) + weight.z * vec3(z, 0.0)) / length(weight);
}

// E|s|² that lookups at this level show.
float detailVariance(Pores pores, float level) {
    float clamped = clamp(level, 0.0, float(DETAIL_LEVELS - 1));
    int below = min(int(clamped), DETAIL_LEVELS - 2);
    float kept = 1.0 - (clamped - float(below));
    kept *= kept;
    return kept * pores.variance[below] + (1.0 - kept) * pores.variance[below + 1];
}

// Columns: along the first edge, across it, normal.
mat3 triangleFrame(vec3 a, vec3 b, vec3 c) {
    vec3 n = safeNormalize(cross(b - a, c - a), vec3(0.0, 0.0, 1.0)), t = safeNormalize(b - a, vec3(1.0, 0.0, 0.0));
    return mat3(t, cross(n, t), n);
}

// What the normal map of a triangle shows of it: the level whose texels are as wide as the map's. `tiles`: area of the triangle.
float mappedDetailLevel(Pores pores, TextureRef ref, float tiles, VertexAttributes a, VertexAttributes b, VertexAttributes c) {
    if (!(pores.normalTexels > 0.0)) return float(DETAIL_LEVELS - 1);
    vec2 e = ref.texCoord == 1 ? b.uv1 - a.uv1 : b.uv0 - a.uv0, f = ref.texCoord == 1 ? c.uv1 - a.uv1 : c.uv0 - a.uv0;
    float turned = abs(ref.u.x * ref.v.y - ref.u.y * ref.v.x);
    float texels = abs(e.x * f.y - e.y * f.x) * 0.5 * turned * pores.normalTexels;
    return 0.5 * log2(max(tiles * float(DETAIL_SIZE * DETAIL_SIZE) / max(texels, 1e-12), 1.0));
}

// The normal with what is resolved of the relief; `removed`: what of E|s|² is so shown, and no longer roughness.
// map: of normals; posed, rest: the triangle; w, wx, wy: barycentric, here and one step to the right and below.
vec3 detailedNormal(Pores pores, TextureRef map, Triangle posed, Triangle rest, vec3 w, vec3 wx, vec3 wy, VertexAttributes va,
                    VertexAttributes vb, VertexAttributes vc, vec3 smoothNormal, vec3 n, out float removed) {
    float tiles = pores.tiles;
    vec3 place = interpolate(w, rest.a, rest.b, rest.c) * tiles + pores.offset;
    vec3 dx = interpolate(wx - w, rest.a, rest.b, rest.c) * tiles, dy = interpolate(wy - w, rest.a, rest.b, rest.c) * tiles;
    // Two pixels a texel, by the pixel's longer side: what is near a pixel's size would show as a pattern.
    float seen = 1.0 + 0.5 * log2(max(max(dot(dx, dx), dot(dy, dy)) * float(DETAIL_SIZE * DETAIL_SIZE), 0.25));
    float area = 0.5 * length(cross(rest.b - rest.a, rest.c - rest.a)) * tiles * tiles;
    float mapped = min(mappedDetailLevel(pores, map, area, va, vb, vc), float(DETAIL_LEVELS - 1));
    seen = min(seen, mapped);
    removed = detailVariance(pores, seen) - detailVariance(pores, mapped);
    // The relief lies on the skin at rest, and moves with it.
    mat3 before = triangleFrame(rest.a, rest.b, rest.c), now = triangleFrame(posed.a, posed.b, posed.c);
    vec3 restNormal = before * (smoothNormal * now);
    vec3 gradient = detailGradient(place, restNormal, seen) - detailGradient(place, restNormal, mapped);
    gradient = now * (gradient * before) * pores.strength;
    return normalize(n - (gradient - n * dot(n, gradient)));
}

#endif
