// Diffusion as d'Eon & Luebke 2007 print it (GPU Gems 3, ch. 14), so that reports show how far ours has come.
// Shader: published_diffusion.comp.
#pragma once

#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/resources.h"

namespace cutis {

// Makes and fills light.levels as recordDiffusion does: by seven fixed taps, stretched along u and along v
// alone. Its taps may read farther than the needed tiles reach: all tiles must be lit.
void recordPublishedDiffusion(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                              const SurfaceImages& surface, const AtlasTiles& tiles, SkinLight& light);

}  // namespace cutis
