// Light maps: for each light sample and group of receivers, the depth of what it lights first and, for translucency,
// that surface's place in the atlas (DESIGN §1.4). Shaders: light_map.vert, light_map.frag.
#pragma once

#include <span>

#include "renderer/passes/resources.h"

namespace cutis {

// Draws `views` into the layers of `depth` (and `entry` when it is there). Views are numbered as in the buffer.
struct LightMapTargets {
    const gpu::Image* depth;
    const gpu::Image* entry = nullptr;
    const gpu::Buffer* viewBuffer;
    std::span<const shared::LightView> views;  // all of the buffer
    std::uint32_t firstView = 0, viewCount = 0;
    int atlasSize = 0;     // with entry
    // Draw coarser forms of the meshes, and of closed skin only what faces away from the light: it casts the same
    // shadows, and none on its own lit side, so that nothing needs to be lifted off it.
    bool proxies = false;
};
void recordLightMaps(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                     const LightMapTargets& targets);

}  // namespace cutis
