#include "renderer/passes/exitance.h"

#include <string>

#include "renderer/gpu/device.h"

namespace cutis {
namespace {

struct ExitancePush {
    shared::TilePush tiles;
    std::uint32_t firstHalf, firstQuarter;
};

}  // namespace

void recordExitance(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                    const SurfaceImages& surface, const AtlasTiles& tiles, ThicknessStorage storage,
                    SkinLight& light) {
    const auto size = static_cast<std::uint32_t>(surface.size);
    if (tiles.changed.empty()) {
        light.exitance = gpu::Image(
            device, {.name = "exitance", .format = VK_FORMAT_R32G32B32A32_SFLOAT, .width = size, .height = size});
        // Whatever is not seen must read as uncovered.
        commands.clear(light.exitance);
    }
    light.nonfinite = gpu::Buffer(device, {.name = "values that are not finite", .bytes = sizeof(std::uint32_t)});
    commands.fill(light.nonfinite, 0);
    gpu::Bindings bindings{{"stretch", surface.stretch},
                           {"GaussianBuffer", scene.gaussians},
                           {"exitance", light.exitance},
                           {"NonfiniteBuffer", light.nonfinite}};
    std::string shader = "exitance.comp";
    const gpu::Image& entry = light.entry ? light.entry : surface.opposite;
    if (entry) {
        shader += "+TRANSLUCENCY";
        if (storage == ThicknessStorage::bytes) shader += "+BYTE_THICKNESS";
        bindings.push_back({"entry", entry});
        bindings.push_back({"position", surface.position});
        bindings.push_back({"normal", surface.normal});
    }
    constexpr const char* kNames[] = {"levels", "halfLevels", "quarterLevels"};
    constexpr const char* kFeatures[] = {"+FULL", "+HALF", "+QUARTER"};
    for (std::uint32_t shift = 0; shift <= kCoarseLevels; ++shift) {
        if (!light.levels.images[shift]) continue;
        shader += kFeatures[shift];
        bindings.push_back({kNames[shift], light.levels.images[shift]});
    }
    dispatchTiles(commands, device.program(shader), bindings,
                  ExitancePush{{}, light.levels.first(1), light.levels.first(2)}, tiles, tiles.seen());
}

}  // namespace cutis
