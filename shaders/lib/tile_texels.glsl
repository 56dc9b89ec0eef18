// Sets of texels of one tile: a bit each, row by row.
#ifndef CUTIS_TILE_TEXELS_GLSL
#define CUTIS_TILE_TEXELS_GLSL

const uint kLastEntryStep = 1u;  // AtlasTiles::entries: all texels of tiles up to this step are needed

// Texels low ≤ at ≤ high, within the tile.
uvec2 texelsWithin(ivec2 low, ivec2 high) {
    uint row = ((1u << uint(high.x - low.x + 1)) - 1u) << uint(low.x);
    uvec2 texels = uvec2(0u);
    for (int y = low.y; y <= high.y; ++y) {
        if (y < 4) texels.x |= row << uint(8 * y);
        else texels.y |= row << uint(8 * (y - 4));
    }
    return texels;
}

// The smallest rectangle that holds them; there is one at least.
void boundsOf(uvec2 texels, out ivec2 low, out ivec2 high) {
    uint rows = texels.x | texels.y;
    rows |= rows >> 16u;
    rows = (rows | rows >> 8u) & 0xffu;
    low.x = findLSB(rows);
    high.x = findMSB(rows);
    low.y = texels.x != 0u ? findLSB(texels.x) / 8 : 4 + findLSB(texels.y) / 8;
    high.y = texels.y != 0u ? 4 + findMSB(texels.y) / 8 : findMSB(texels.x) / 8;
}

uvec2 neededTexels(AtlasTileState state, uint turn) {
    return state.step <= kLastEntryStep ? uvec2(0xffffffffu) : state.needed[turn];
}

#endif
