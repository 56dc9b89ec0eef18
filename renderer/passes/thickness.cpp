#include "renderer/passes/thickness.h"

#include <algorithm>
#include <iterator>

#include "renderer/gpu/device.h"

namespace cutis {
namespace {

struct ThicknessPush {
    shared::TilePush tiles;
    std::uint32_t entryStep, firstSample, firstView, groupCount, first, last;
};

}  // namespace

void recordThickness(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                     const SurfaceImages& surface, const LightMaps& lights, const AtlasTiles& tiles,
                     SkinLight& light) {
    if (tiles.changed.empty()) {
        const auto size = static_cast<std::uint32_t>(surface.size);
        light.entry = gpu::Image(
            device,
            {.name = "entry points", .format = VK_FORMAT_R32G32B32A32_SFLOAT, .width = size, .height = size});
        // Texels that are not seen are read as far as a lookup between texels goes.
        commands.clear(light.entry, gpu::ClearValue(-1, -1, kNoThickness, 0));
    }
    const gpu::Bindings bindings{{"position", surface.position},      {"normal", surface.normal},
                                 {"DrawBuffer", scene.draws},         {"MaterialBuffer", scene.materials},
                                 {"GaussianBuffer", scene.gaussians}, {"LightBuffer", lights.samples},
                                 {"LightViewBuffer", lights.views},   {"lightDepth", lights.depth},
                                 {"lightEntry", lights.entry},        {"entry", light.entry},
                                 {"TileStateBuffer", tiles.states}};
    std::vector<LightRun> runs;
    std::copy_if(lights.runs.begin(), lights.runs.end(), std::back_inserter(runs),
                 [](const LightRun& run) { return run.shadow; });
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const ThicknessPush push{{},
                                 tiles.entries(),
                                 runs[i].firstSample,
                                 runs[i].firstView,
                                 lights.groupCount,
                                 i == 0 ? 1u : 0u,
                                 i + 1 == runs.size() ? 1u : 0u};
        dispatchTiles(commands, device.program("thickness.comp", {{0, runs[i].sampleCount}}), bindings, push,
                      tiles, tiles.seen());
    }
}

}  // namespace cutis
