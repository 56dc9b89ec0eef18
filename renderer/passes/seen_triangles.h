// Which triangles of skin a picture shows: light that falls elsewhere is not worth computing. Shader:
// seen_triangles.comp.
#pragma once

#include "renderer/passes/composite.h"
#include "renderer/passes/resources.h"

namespace cutis {

// A mark for each skin triangle, 0; but 1 for skin that is seen through, whose layers are not looked at.
gpu::Buffer makeSeenTriangles(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene);

// Sets to 1 those that samples of the tile see. Draws the tile's opaque surfaces into `buffers`.
void recordSeenTriangles(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                         const shared::ViewCamera& camera, const ViewTile& tile, const TileBuffers& buffers,
                         const gpu::Buffer& seen);

}  // namespace cutis
