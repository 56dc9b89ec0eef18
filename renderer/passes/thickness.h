// Thickness: where light that arrives from behind enters what is seen of the skin (DESIGN §1.4). Shader:
// thickness.comp.
#pragma once

#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/resources.h"

namespace cutis {

// Fills SkinLight::entry, and marks the tiles where entry points lie.
void recordThickness(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                     const SurfaceImages& surface, const LightMaps& lights, const AtlasTiles& tiles,
                     SkinLight& light);

}  // namespace cutis
