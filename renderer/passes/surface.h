// Surface: what lies behind each atlas texel, once per pose. Shaders: surface.vert, surface.frag, surface.comp.
#pragma once

#include "renderer/passes/resources.h"

namespace cutis {

// Makes the images of an atlas of size × size texels and fills them.
SurfaceImages recordSurface(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene, int size);

}  // namespace cutis
