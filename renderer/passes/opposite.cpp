#include "renderer/passes/opposite.h"

#include "renderer/gpu/device.h"

namespace cutis {
namespace {

struct OppositePush {
    shared::TilePush tiles;
    std::uint32_t entryStep;
};

}  // namespace

void recordOpposite(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                    const gpu::Buffer& vertices, const AtlasTiles& tiles, SurfaceImages& surface) {
    const auto size = static_cast<std::uint32_t>(surface.size);
    surface.opposite = gpu::Image(
        device,
        {.name = "opposite side", .format = VK_FORMAT_R32G32B32A32_SFLOAT, .width = size, .height = size});
    // Texels that are not seen are read as far as a lookup between texels goes.
    commands.clear(surface.opposite, gpu::ClearValue(-1, -1, kNoThickness, 0));
    dispatchTiles(commands, device.program("opposite.comp"),
                  {{"triangles", surface.triangles},
                   {"IndexBuffer", scene.indices},
                   {"AtlasVertexBuffer", scene.atlasVertices},
                   {"OppositeBuffer", vertices},
                   {"opposite", surface.opposite},
                   {"position", surface.position},
                   {"DrawBuffer", scene.draws},
                   {"GaussianBuffer", scene.gaussians},
                   {"TileStateBuffer", tiles.states}},
                  OppositePush{{}, tiles.entries()}, tiles, tiles.seen());
}

}  // namespace cutis
