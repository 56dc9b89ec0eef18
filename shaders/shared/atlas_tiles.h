// The atlas in tiles of 8 × 8 texels: passes run on those that a picture needs, and no others.
#ifndef CUTIS_SHARED_ATLAS_TILES_H
#define CUTIS_SHARED_ATLAS_TILES_H
#include "shared/interop.h"
CUTIS_SHARED_BEGIN

const uint ATLAS_TILE = 8u;             // texels along each side
const uint TILE_UNNEEDED = 0xffffffffu;  // as AtlasTileState::step
const uint COARSEST_LEVEL = 2u;          // a diffusion level has at least 1/2² of the atlas' resolution
const uint TILE_ROW = 32768u;           // tiles along x of a dispatch: devices bound the groups along one axis

// A rectangle of the atlas: the UV layout of one skin material of one character.
struct AtlasChart {
    uvec4 rect;       // x, y, width, height in texels
    uvec2 firstCell;  // first cell of the atlas' grid of tiles that holds a part of it
    uvec2 cells;
    uint firstTile;   // the chart's tiles follow one another, row by row of its cells
    uint firstGaussian, gaussianCount;
    uint blurredCount;  // of them; the others are wide beside the body (passes/wide_gaussians.h)
    uint litWhole;  // 1: some Gaussian of its body's skin is wide, which then takes the light of all of it
    float mmPerUnit;
};

// A cell of the grid as one chart uses it; where charts meet, each has a tile of its own.
struct AtlasTile {
    uvec2 corner;  // texels
    uint chart;
};

struct AtlasTileState {
    uint covered;  // texels of the chart that hold surface
    uint gutter;   // texels beyond the border of an island onto which the surface goes on from there
    uint step;     // how early the tile is needed: see passes/atlas_tiles.h
    // Largest covariance in texels² of a Gaussian of 1 mm²: along u, along v, and between them, as the bits of floats.
    uint perMmU, perMmV, perMmMixed;
    // Which of its texels are needed so far, row by row, a bit each; steps of growth read one and write the other in turns.
    uvec2 needed[2];
};

// A texel beyond the border of a UV island, and the place on another island, or further on the same one, that lies there on
// the surface (frame/seam_map.h).
struct SeamTexel {
    uint texel;    // x | y << 14; from bit 28: which of the four texels from `base` on belong to that island
    uint base;     // x | y << 16: the first of four texels around `place`, or beside it where those are not all the island's
    vec2 place;    // in texels, of the resolution that the texel is of
    float island;  // 1-based: the one that the texel extends
    uint charts;   // that of the texel | that of `place` << 16
};

// The tiles of one chart that are needed up to one step, and the work groups for them.
struct TileDispatch {
    uvec3 groups[COARSEST_LEVEL + 2];  // one for 4^i tiles: 64 texels of 1/2^i of the resolution, or 256 of twice that
    uint tiles;
};

// What a pass over tiles is pushed first. All its invocations work on one chart: a software device reads what push
// constants alone point at once for all of them.
struct TilePush {
    uint chart;
    uint dispatch;  // index of its TileDispatch
    uint receiverGroup;
};

CUTIS_SHARED_END
#endif
