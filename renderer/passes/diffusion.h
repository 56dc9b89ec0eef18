// Diffusion: the chain of separable Gaussian blurs over the atlas, once however many lights (DESIGN §1.4).
// Shader: diffusion.comp.
#pragma once

#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/resources.h"

namespace cutis {

// Makes and fills light.levels: layer k holds the irradiance blurred to variance v_k of each chart's own
// profile.
void recordDiffusion(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                     const SurfaceImages& surface, const AtlasTiles& tiles, SkinLight& light);

}  // namespace cutis
