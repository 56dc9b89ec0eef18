#include "renderer/passes/opposite.h"

#include "renderer/gpu/device.h"

namespace cutis {

void recordOpposite(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                    const gpu::Buffer& vertices, SurfaceImages& surface) {
    const auto size = static_cast<std::uint32_t>(surface.size);
    surface.opposite = gpu::Image(
        device,
        {.name = "opposite side", .format = VK_FORMAT_R32G32B32A32_SFLOAT, .width = size, .height = size});
    const gpu::Program& program = device.program("opposite.comp");
    commands.dispatch(program,
                      {{"triangles", surface.triangles},
                       {"IndexBuffer", scene.indices},
                       {"AtlasVertexBuffer", scene.atlasVertices},
                       {"OppositeBuffer", vertices},
                       {"opposite", surface.opposite}},
                      {}, gpu::groupsFor(program, size, size));
}

}  // namespace cutis
