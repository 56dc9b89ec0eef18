// Surface: what lies behind each atlas texel, once per pose. Shaders: surface.vert, surface.frag,
// surface.comp.
#pragma once

#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/resources.h"

namespace cutis {

// Makes the images of an atlas of size × size texels and fills them; lists the tiles that hold surface.
// levelShifts: see passes/diffusion.h.
SurfaceImages recordSurface(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                            std::span<const ChartRange> charts, int size,
                            const std::vector<std::uint32_t>& levelShifts, AtlasTiles& tiles);

}  // namespace cutis
