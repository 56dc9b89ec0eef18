// Levels of Gaussians that are wide beside the body. A blur of charts takes light round a body only as far as they go on
// beyond one another's borders; a Gaussian in space takes it all round. So the irradiance is summed over some thousand patches of the
// body's skin, and each texel of the level is the sum of their light times the Gaussian of the straight distance:
// ∫ G(v, |x-y|) E'(y) dA, by patches whose side is at most a third of a standard deviation.
// Shaders: patch_light.comp, wide_gaussians.comp.
#pragma once

#include <span>

#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/resources.h"

namespace cutis {

// Uploaded by the row of that name (frame/light_patches.h).
struct LightPatches {
    gpu::Buffer patches;  // shared::LightPatch, those of one body after those of another
    gpu::Buffer samples;  // shared::PatchSample, likewise patch by patch
    gpu::Buffer light;    // a vec3 a patch, W·mm²/m²: filled by recordWideGaussians
    std::uint32_t count = 0;
    struct Range {
        std::uint32_t first = 0, count = 0;
    };
    std::vector<Range> ofChart;  // the patches of the body that a chart is of; none where it has no wide Gaussian
};

// Fills, of each chart, the levels from its ChartRange::blurred on. The others, and the irradiance with its gutters, are there.
void recordWideGaussians(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                         const SurfaceImages& surface, const AtlasTiles& tiles, std::span<const ChartRange> charts,
                         const LightPatches& patches, SkinLight& light);

}  // namespace cutis
