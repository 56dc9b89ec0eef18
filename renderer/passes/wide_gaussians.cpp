#include "renderer/passes/wide_gaussians.h"

#include "renderer/gpu/device.h"
#include "renderer/passes/seams.h"

namespace cutis {
namespace {

struct LightPush {
    std::uint32_t patchCount;
};

struct WidePush {
    shared::TilePush tiles;
    std::uint32_t firstPatch, patchCount;
    float variance;
    std::uint32_t facing;
};

}  // namespace

void recordWideGaussians(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                         const SurfaceImages& surface, const AtlasTiles& tiles, std::span<const ChartRange> charts,
                         const LightPatches& patches, SkinLight& light) {
    const gpu::Program& sum = device.program("patch_light.comp");
    commands.dispatch(sum,
                      {{"irradiance", light.irradiance},
                       {"PatchBuffer", patches.patches},
                       {"SampleBuffer", patches.samples},
                       {"LightBuffer", patches.light}},
                      LightPush{patches.count}, gpu::groupsFor(sum, patches.count));
    for (std::uint32_t level = 0; level < tiles.levels(); ++level) {
        const std::uint32_t shift = tiles.shifts[level];
        const gpu::Program& program = device.program("wide_gaussians.comp", {{0, shift}});
        const gpu::Bindings bindings =
            withTiles({{"position", surface.position},
                       {"normal", surface.normal},
                       {"stretch", surface.stretch},
                       {"coarseStretch", shift == 0 ? surface.stretch : surface.coarseStretch[shift - 1]},
                       {"target", light.levels.view(level)},
                       {"PatchBuffer", patches.patches},
                       {"LightBuffer", patches.light}},
                      tiles);
        bool any = false;
        for (std::uint32_t c = 0; c < charts.size(); ++c) {
            const std::vector<skin::Gaussian>& gaussians = charts[c].profile.gaussians;
            if (level < charts[c].blurred || level >= gaussians.size() || !tiles.runsOn(c)) continue;
            const WidePush push{tilePush(tiles, c, tiles.level(level)), patches.ofChart[c].first,
                                patches.ofChart[c].count, static_cast<float>(gaussians[level].variance),
                                charts[c].facing ? 1u : 0u};
            commands.dispatchIndirect(program, bindings, push, tiles.dispatches, tileGroups(program, push.tiles, shift));
            any = true;
        }
        if (any) recordSeams(device, commands, scene.seams, light.levels.view(level), shift);
    }
}

}  // namespace cutis
