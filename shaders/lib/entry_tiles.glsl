// Tiles of the atlas at which light enters that shines through what is seen. The includer declares position (see
// surface.comp), draws[], gaussians[] and states[], and includes lib/atlas_tiles.glsl.
#ifndef CUTIS_ENTRY_TILES_GLSL
#define CUTIS_ENTRY_TILES_GLSL

// What an entry point lends its light is read there, between texels: those tiles are needed too.
void markEntry(vec2 place, float thickness, uint entryStep) {
    uint owner = uint(texelFetch(position, ivec2(place), 0).w);
    if (owner == 0u) return;
    AtlasChart chart = atlasCharts[draws[owner - 1u].chart];
    // Behind this much skin exitance.comp lets nothing through: exp(-t²/2v) < 1e-6.
    float widest = gaussians[chart.firstGaussian + chart.gaussianCount - 1u].variance;
    if (thickness * thickness > 27.7 * widest) return;
    ivec2 first = ivec2(chart.firstCell), last = first + ivec2(chart.cells) - 1;
    ivec2 low = clamp(ivec2(floor((place - 1.5) / float(ATLAS_TILE))), first, last) - first;
    ivec2 high = clamp(ivec2(floor((place + 1.5) / float(ATLAS_TILE))), first, last) - first;
    for (int i = 0; i < 4; ++i) {
        uint x = uint((i & 1) == 0 ? low.x : high.x), y = uint(i < 2 ? low.y : high.y);
        uint tile = chart.firstTile + y * chart.cells.x + x;
        if (states[tile].step > entryStep) atomicMin(states[tile].step, entryStep);
    }
}

#endif
