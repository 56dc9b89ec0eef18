// Surface: what lies behind each atlas texel, once per pose. Shaders: surface.vert, surface.frag,
// surface.comp.
#pragma once

#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/resources.h"

namespace cutis {

// Makes the images of an atlas of size × size texels and fills them; lists the tiles that hold surface.
SurfaceImages recordSurface(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                            std::span<const ChartRange> charts, int size, AtlasTiles& tiles);

}  // namespace cutis
