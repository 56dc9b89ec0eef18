// Exitance: the profile's sum of the blurred levels, light from behind included. Shader: exitance.comp.
#pragma once

#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/resources.h"

namespace cutis {

// bytes: as 8 bits of exp(-t/5 mm), as d'Eon & Luebke 2007 store it.
enum class ThicknessStorage { floats, bytes };

// Makes and fills light.exitance, and counts its values that are not finite in light.nonfinite.
void recordExitance(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                    const SurfaceImages& surface, const AtlasTiles& tiles, ThicknessStorage storage,
                    SkinLight& light);

}  // namespace cutis
