// Which tile of a chart holds a texel of the atlas.
#ifndef CUTIS_SEAM_TILES_GLSL
#define CUTIS_SEAM_TILES_GLSL

uint tileAt(AtlasChart chart, ivec2 texel) {
    ivec2 cell = texel / int(ATLAS_TILE) - ivec2(chart.firstCell);
    cell = clamp(cell, ivec2(0), ivec2(chart.cells) - 1);
    return chart.firstTile + uint(cell.y) * chart.cells.x + uint(cell.x);
}

#endif
