// Exitance: the profile's sum of the blurred levels, light from behind included. Shader: exitance.comp.
#pragma once

#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/resources.h"

namespace cutis {

// Makes and fills light.exitance.
void recordExitance(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                    const SurfaceImages& surface, const AtlasTiles& tiles, SkinLight& light);

}  // namespace cutis
