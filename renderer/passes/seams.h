// Seams: light goes on beyond the borders of UV islands, through gutters that hold what lies there on the surface. Shaders:
// seams.comp, seams_stretch.comp, tiles_gutter.comp, tiles_seams.comp. Without lists all of these record nothing.
#pragma once

#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/resources.h"

namespace cutis {

// Counts the gutter texels of each tile, and makes those tiles needed.
void recordGutterTiles(gpu::Device& device, gpu::Commands& commands, const SeamLists& seams, const AtlasTiles& tiles);

// Gives the gutters' texels their stretch and the number of the island that they extend.
void recordGutterStretch(gpu::Device& device, gpu::Commands& commands, const SeamLists& seams, const AtlasTiles& tiles,
                         const SurfaceImages& surface);

// Makes the tiles needed at `step` at which gutters needed before go on, at 1/2^shift of the resolution. turn: see
// AtlasTileState::needed.
void recordSeamTiles(gpu::Device& device, gpu::Commands& commands, const SeamLists& seams, const AtlasTiles& tiles,
                     std::uint32_t step, std::uint32_t shift, std::uint32_t turn);

// Fills the gutters of an image of light (rgb; a: island) at 1/2^shift of the atlas' resolution.
void recordSeams(gpu::Device& device, gpu::Commands& commands, const SeamLists& seams, const gpu::ImageView& light,
                 std::uint32_t shift);

}  // namespace cutis
