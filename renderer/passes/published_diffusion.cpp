#include "renderer/passes/published_diffusion.h"

#include "renderer/gpu/device.h"
#include "renderer/passes/diffusion.h"

namespace cutis {
namespace {

struct BlurPush {
    shared::TilePush tiles;
    std::uint32_t level;
    int axis;
};

}  // namespace

void recordPublishedDiffusion(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                              const SurfaceImages& surface, const AtlasTiles& tiles, SkinLight& light) {
    makeLevels(device, commands, surface.size, tiles, light.levels);
    // It has all levels at full resolution.
    const gpu::Image& scratch = light.levels.scratch[0];
    const gpu::Program& program = device.program("published_diffusion.comp");
    for (std::uint32_t level = 0; level < tiles.levels(); ++level) {
        for (int axis = 0; axis < 2; ++axis) {
            const gpu::ImageView source = axis == 1   ? scratch.view()
                                          : level > 0 ? light.levels.view(level - 1)
                                                      : light.irradiance.view();
            const gpu::ImageView target = axis == 0 ? scratch.view() : light.levels.view(level);
            dispatchTiles(commands, program,
                          {{"source", source},
                           {"stretch", surface.stretch},
                           {"target", target},
                           {"GaussianBuffer", scene.gaussians}},
                          BlurPush{{}, level, axis}, tiles, tiles.lit());
        }
    }
}

}  // namespace cutis
