#include "renderer/passes/diffusion.h"

#include <algorithm>
#include <cmath>

#include "renderer/gpu/device.h"
#include "renderer/passes/seams.h"

namespace cutis {
namespace {

constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

struct BlurPush {
    shared::TilePush tiles;
    std::uint32_t level;
    int axis;
};

struct ReducePush {
    shared::TilePush tiles;
};

gpu::Image coarseImage(gpu::Device& device, const char* name, int atlasSize, std::uint32_t shift,
                       std::uint32_t layers = 1) {
    const auto size = (static_cast<std::uint32_t>(atlasSize) + (1u << shift) - 1) >> shift;
    return gpu::Image(device,
                      {.name = name, .format = kFormat, .width = size, .height = size, .layers = layers});
}

}  // namespace

std::vector<std::uint32_t> levelShifts(std::span<const ChartRange> charts, bool reduced) {
    std::vector<std::uint32_t> shifts;
    for (const ChartRange& chart : charts) {
        const std::vector<skin::Gaussian>& gaussians = chart.profile.gaussians;
        for (std::size_t k = 0; k < gaussians.size(); ++k) {
            if (k == shifts.size()) shifts.push_back(reduced ? kCoarseLevels : 0);
            const double texels = std::sqrt(gaussians[k].variance) / std::max(chart.coarsestMm, 1e-30);
            const double most = std::floor(std::log2(std::max(texels / kSmoothTexels, 1.0)));
            shifts[k] = static_cast<std::uint32_t>(std::min<double>(shifts[k], most));
        }
    }
    // The chain runs from fine to coarse, also where profiles differ.
    for (std::size_t k = shifts.size(); k-- > 1;) shifts[k - 1] = std::min(shifts[k - 1], shifts[k]);
    return shifts;
}

void recordCoarseStretch(gpu::Device& device, gpu::Commands& commands, const AtlasTiles& tiles,
                         SurfaceImages& surface) {
    for (std::uint32_t shift = 1; shift <= kCoarseLevels; ++shift) {
        if (std::find(tiles.shifts.begin(), tiles.shifts.end(), shift) == tiles.shifts.end()) continue;
        gpu::Image& coarse = surface.coarseStretch[shift - 1];
        if (tiles.changed.empty()) {
            coarse = coarseImage(device, "coarse stretch", surface.size, shift);
            commands.clear(coarse);
        }
        dispatchTiles(
            commands, device.program("diffusion_reduce.comp+STRETCH", {{0, shift}, {1, 1u << shift}}),
            {{"source", surface.stretch}, {"target", coarse}}, ReducePush{}, tiles, tiles.seen(), shift);
    }
}

void makeLevels(gpu::Device& device, gpu::Commands& commands, int atlasSize, const AtlasTiles& tiles,
                DiffusionLevels& levels) {
    if (levels.tiles == tiles.id) return;
    levels = {};
    levels.shifts = tiles.shifts;
    levels.tiles = tiles.id;
    const auto make = [&](gpu::Image& image, const char* name, std::uint32_t shift, std::uint32_t layers) {
        image = coarseImage(device, name, atlasSize, shift, layers);
        commands.clear(image);
    };
    for (std::uint32_t shift = 0; shift <= kCoarseLevels; ++shift) {
        const auto count =
            static_cast<std::uint32_t>(std::count(tiles.shifts.begin(), tiles.shifts.end(), shift));
        if (count == 0) continue;
        make(levels.images[shift], "diffusion levels", shift, count);
        make(levels.scratch[shift], "diffusion scratch", shift, 1);
        if (shift > 0) make(levels.reduced[shift], "reduced level", shift, 1);
    }
}

void recordDiffusion(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                     const SurfaceImages& surface, const AtlasTiles& tiles, int taps, SkinLight& light) {
    DiffusionLevels& levels = light.levels;
    makeLevels(device, commands, surface.size, tiles, levels);
    recordSeams(device, commands, scene.seams, light.irradiance, 0);
    // Level by level over all charts, so that one barrier serves them all.
    for (std::uint32_t level = 0; level < tiles.levels(); ++level) {
        const std::uint32_t shift = tiles.shifts[level], finer = 1u << (shift - tiles.finerShift(level));
        const gpu::Image& stretch = shift == 0 ? surface.stretch : surface.coarseStretch[shift - 1];
        gpu::ImageView source = level > 0 ? levels.view(level - 1) : light.irradiance.view();
        if (finer > 1) {
            dispatchTiles(commands, device.program("diffusion_reduce.comp", {{0, shift}, {1, finer}}),
                          {{"source", source}, {"target", levels.reduced[shift]}, {"stretch", stretch}},
                          ReducePush{}, tiles, tiles.scratch(level) + 1, shift);
            source = levels.reduced[shift].view();
        }
        const gpu::Program& program = device.program(
            "diffusion.comp", {{0, shift}, {1, finer}, {2, static_cast<std::uint32_t>(taps)}});
        const gpu::ImageView steps[] = {source, levels.scratch[shift].view(), levels.view(level)};
        for (int axis = 0; axis < 2; ++axis) {
            dispatchTiles(commands, program,
                          {{"source", steps[axis]},
                           {"stretch", stretch},
                           {"target", steps[axis + 1]},
                           {"GaussianBuffer", scene.gaussians}},
                          BlurPush{{}, level, axis}, tiles,
                          axis == 0 ? tiles.scratch(level) : tiles.level(level), shift);
        }
        recordSeams(device, commands, scene.seams, levels.view(level), shift);
    }
}

}  // namespace cutis
