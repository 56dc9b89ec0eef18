// Surface: what lies behind each atlas texel, once per pose. Shaders: surface.vert, surface.frag,
// surface.comp.
#pragma once

#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/resources.h"

namespace cutis {

// Makes the images of an atlas of size × size texels and fills them; lists the tiles that hold surface. With tiles.changed, images and
// lists stay, as where the surface lies in the atlas does not change with the pose.
// levelShifts: see passes/diffusion.h.
void recordSurface(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                            std::span<const ChartRange> charts, int size,
                            const std::vector<std::uint32_t>& levelShifts, AtlasTiles& tiles, SurfaceImages& images);

}  // namespace cutis
