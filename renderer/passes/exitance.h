// Exitance: the profile's sum of the blurred levels, light from behind included. Shader: exitance.comp.
#pragma once

#include <span>

#include "renderer/passes/resources.h"

namespace cutis {

// Makes and fills light.exitance.
void recordExitance(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                    const SurfaceImages& surface, std::span<const ChartRange> charts, SkinLight& light);

}  // namespace cutis
