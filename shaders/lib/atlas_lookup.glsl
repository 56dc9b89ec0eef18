// Looking the atlas up between texels: bilinear over the texels of one UV island only, since charts may lie side by side,
// and of these over those that face where the point does, since a texel of a thin rim may lie beyond its edge.
#ifndef CUTIS_ATLAS_LOOKUP_GLSL
#define CUTIS_ATLAS_LOOKUP_GLSL
#include "shared/light_share.h"

// Four texels and their shares, which sum to 1; all 0 where none of the four belongs to the island.
struct AtlasLookup {
    ivec2 base;
    vec4 weight;  // of base + (0,0), (1,0), (0,1), (1,1)
};

// What a texel whose normal is at this cosine to the point's counts: all up to 45 degrees, hardly anything from 90 on.
float facingShare(float cosine) { return max(smoothstep(0.0, 0.7, cosine), 1e-4); }

// `islands` holds the number of each texel's island in its alpha; `normals` is as surface.comp writes it. place: in texels;
// n: the smooth normal there.
AtlasLookup atlasLookup(texture2D islands, texture2D normals, vec2 place, float island, vec3 n) {
    ivec2 last = textureSize(islands, 0) - 1;
    vec2 grid = place - 0.5;
    AtlasLookup at;
    at.base = ivec2(floor(grid));
    vec2 f = grid - vec2(at.base);
    vec4 weight = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = clamp(at.base + ivec2(i & 1, i >> 1), ivec2(0), last);
        float share = facingShare(dot(decodeOctahedral(texelFetch(normals, texel, 0).xy), n));
        weight[i] *= texelFetch(islands, texel, 0).a == island ? share : 0.0;
    }
    float sum = weight.x + weight.y + weight.z + weight.w;
    at.weight = sum > 0.0 ? weight / sum : vec4(0.0);
    at.base = clamp(at.base, ivec2(0), last - 1);
    return at;
}

vec4 lookUp(texture2D image, AtlasLookup at) {
    return at.weight.x * texelFetch(image, at.base, 0) + at.weight.y * texelFetch(image, at.base + ivec2(1, 0), 0) +
           at.weight.z * texelFetch(image, at.base + ivec2(0, 1), 0) +
           at.weight.w * texelFetch(image, at.base + ivec2(1, 1), 0);
}

// Share of a light that arrives, by those of the four texels that face it; none where none does, since none of it is in their
// irradiance either.
float lightShare(texture2DArray image, AtlasLookup at, int layer) {
    vec4 stored = vec4(texelFetch(image, ivec3(at.base, layer), 0).r, texelFetch(image, ivec3(at.base + ivec2(1, 0), layer), 0).r,
                       texelFetch(image, ivec3(at.base + ivec2(0, 1), layer), 0).r,
                       texelFetch(image, ivec3(at.base + ivec2(1, 1), layer), 0).r);
    vec4 weight = at.weight * vec4(lessThan(stored, vec4(0.5 * (LIGHT_ARRIVES + LIGHT_FACED_AWAY))));
    float sum = weight.x + weight.y + weight.z + weight.w;
    return sum > 0.0 ? dot(weight, stored) / (sum * LIGHT_ARRIVES) : 0.0;
}

#endif
