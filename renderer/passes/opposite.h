// Thickness and the place on the other side of thin skin, a texel, from those of the vertices
// (frame/opposite.h). Shader: opposite.comp.
#pragma once

#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/resources.h"

namespace cutis {

// Fills surface.opposite where skin is seen, and marks the tiles that lie opposite. `vertices` holds a
// shared::OppositeVertex for each skin vertex.
void recordOpposite(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                    const gpu::Buffer& vertices, const AtlasTiles& tiles, SurfaceImages& surface);

}  // namespace cutis
