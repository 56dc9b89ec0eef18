#include "renderer/passes/published_diffusion.h"

#include "renderer/gpu/device.h"

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
    const auto size = static_cast<std::uint32_t>(surface.size);
    const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    light.levels = gpu::Image(device, {.name = "diffusion levels",
                                       .format = format,
                                       .width = size,
                                       .height = size,
                                       .layers = tiles.levels});
    light.scratch =
        gpu::Image(device, {.name = "diffusion scratch", .format = format, .width = size, .height = size});
    // Texels without surface are read wherever they are, and must say so.
    commands.clear(light.levels);
    commands.clear(light.scratch);
    const gpu::Program& program = device.program("published_diffusion.comp");
    for (std::uint32_t level = 0; level < tiles.levels; ++level) {
        for (int axis = 0; axis < 2; ++axis) {
            const gpu::ImageView source = axis == 1   ? light.scratch.view()
                                          : level > 0 ? light.levels.layer(level - 1)
                                                      : light.irradiance.view();
            const gpu::ImageView target = axis == 0 ? light.scratch.view() : light.levels.layer(level);
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
