// Diffusion: the chain of separable Gaussian blurs over the atlas, once however many lights (DESIGN §1.4).
// Shaders: diffusion.comp, diffusion_reduce.comp.
#pragma once

#include <span>

#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/resources.h"

namespace cutis {

// The resolution of each level of diffusion, 1/2^shift of the atlas': the lowest at which its Gaussian still
// has a standard deviation of kSmoothTexels, on every chart, but for the largest fifth of texels; there the blur is as narrow as a lookup allows.
std::vector<std::uint32_t> levelShifts(std::span<const ChartRange> charts, bool reduced);
inline constexpr double kSmoothTexels = 1.25;

// Makes surface.coarseStretch for the resolutions of these tiles' levels.
void recordCoarseStretch(gpu::Device& device, gpu::Commands& commands, const AtlasTiles& tiles,
                         SurfaceImages& surface);

// Fills light.levels, which it makes where they are not those of `tiles`: level k holds the irradiance blurred to variance v_k of each chart's own
// profile. taps: on either side of a blur, at the most.
void recordDiffusion(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                     const SurfaceImages& surface, const AtlasTiles& tiles, int taps, SkinLight& light);

// Makes the levels of `tiles` where there are others. Texels without surface are read wherever they are, and say so from then on,
// as nobody writes them. Those that are not needed keep what they had: whatever reads them is not needed either.
void makeLevels(gpu::Device& device, gpu::Commands& commands, int atlasSize, const AtlasTiles& tiles,
                DiffusionLevels& levels);

}  // namespace cutis
