#include "renderer/passes/diffusion.h"

#include <algorithm>

#include "renderer/gpu/device.h"

namespace cutis {
namespace {

struct BlurPush {
    glm::uvec4 rect;  // texels
    float variance, previous;  // mm²
    int axis;
};

}  // namespace

void recordDiffusion(gpu::Device& device, gpu::Commands& commands, const SurfaceImages& surface,
                     std::span<const ChartRange> charts, SkinLight& light) {
    const auto size = static_cast<std::uint32_t>(surface.size);
    std::uint32_t levels = 1;
    for (const ChartRange& chart : charts) {
        levels = std::max(levels, static_cast<std::uint32_t>(chart.profile.gaussians.size()));
    }
    const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    light.levels = gpu::Image(
        device, {.name = "diffusion levels", .format = format, .width = size, .height = size, .layers = levels});
    light.scratch = gpu::Image(device, {.name = "diffusion scratch", .format = format, .width = size, .height = size});
    const gpu::Program& program = device.program("diffusion.comp");
    // Level by level over all charts, so that one barrier serves them all.
    for (std::uint32_t level = 0; level < levels; ++level) {
        for (int axis = 0; axis < 2; ++axis) {
            for (const ChartRange& chart : charts) {
                const std::vector<skin::Gaussian>& gaussians = chart.profile.gaussians;
                if (level >= gaussians.size()) continue;
                const double previous = level > 0 ? gaussians[level - 1].variance : 0;
                const BlurPush push{chart.rect, static_cast<float>(gaussians[level].variance - previous),
                                    static_cast<float>(previous), axis};
                const gpu::ImageView source = axis == 1   ? light.scratch.view()
                                              : level > 0 ? light.levels.layer(level - 1)
                                                          : light.irradiance.view();
                const gpu::ImageView target = axis == 0 ? light.scratch.view() : light.levels.layer(level);
                commands.dispatch(program, {{"source", source}, {"stretch", surface.stretch}, {"target", target}}, push,
                                  gpu::groupsFor(program, chart.rect.z, chart.rect.w));
            }
        }
    }
}

}  // namespace cutis
