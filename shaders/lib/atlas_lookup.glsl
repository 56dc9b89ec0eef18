// Looking the atlas up between texels: bilinear over the texels of one UV island only, since charts may lie side by side.
#ifndef CUTIS_ATLAS_LOOKUP_GLSL
#define CUTIS_ATLAS_LOOKUP_GLSL

// Four texels and their shares, which sum to 1; all 0 where none of the four belongs to the island.
struct AtlasLookup {
    ivec2 base;
    vec4 weight;  // of base + (0,0), (1,0), (0,1), (1,1)
};

// `islands` holds the number of each texel's island in its alpha. place: in texels.
AtlasLookup atlasLookup(texture2D islands, vec2 place, float island) {
    ivec2 last = textureSize(islands, 0) - 1;
    vec2 grid = place - 0.5;
    AtlasLookup at;
    at.base = ivec2(floor(grid));
    vec2 f = grid - vec2(at.base);
    vec4 weight = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = clamp(at.base + ivec2(i & 1, i >> 1), ivec2(0), last);
        if (texelFetch(islands, texel, 0).a != island) weight[i] = 0.0;
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

vec4 lookUp(texture2DArray image, AtlasLookup at, int layer) {
    return at.weight.x * texelFetch(image, ivec3(at.base, layer), 0) +
           at.weight.y * texelFetch(image, ivec3(at.base + ivec2(1, 0), layer), 0) +
           at.weight.z * texelFetch(image, ivec3(at.base + ivec2(0, 1), layer), 0) +
           at.weight.w * texelFetch(image, ivec3(at.base + ivec2(1, 1), layer), 0);
}

#endif
