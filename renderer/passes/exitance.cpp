#include "renderer/passes/exitance.h"

#include "renderer/gpu/device.h"

namespace cutis {
namespace {

struct ExitancePush {
    shared::TilePush tiles;
};

}  // namespace

void recordExitance(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                    const SurfaceImages& surface, const AtlasTiles& tiles, ThicknessStorage storage,
                    SkinLight& light) {
    const auto size = static_cast<std::uint32_t>(surface.size);
    light.exitance = gpu::Image(
        device, {.name = "exitance", .format = VK_FORMAT_R32G32B32A32_SFLOAT, .width = size, .height = size});
    gpu::Bindings bindings{{"levels", bilinear(device, light.levels)},
                           {"GaussianBuffer", scene.gaussians},
                           {"exitance", light.exitance}};
    const gpu::Image& entry = light.entry ? light.entry : surface.opposite;
    if (entry) {
        bindings.push_back({"entry", entry});
        bindings.push_back({"stretch", surface.stretch});
        bindings.push_back({"position", surface.position});
        bindings.push_back({"normal", surface.normal});
    }
    // Whatever is not seen must read as uncovered.
    commands.clear(light.exitance);
    const gpu::Program& program =
        device.program(!entry                               ? "exitance.comp"
                       : storage == ThicknessStorage::bytes ? "exitance.comp+TRANSLUCENCY+BYTE_THICKNESS"
                                                            : "exitance.comp+TRANSLUCENCY");
    dispatchTiles(commands, program, bindings, ExitancePush{}, tiles, tiles.seen());
}

}  // namespace cutis
