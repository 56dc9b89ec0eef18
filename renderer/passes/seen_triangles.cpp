#include "renderer/passes/seen_triangles.h"

#include <algorithm>

#include "renderer/gpu/device.h"

namespace cutis {

gpu::Buffer makeSeenTriangles(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene) {
    gpu::Buffer seen(device, {.name = "seen triangles", .bytes = std::uint64_t(scene.skinTriangleCount) * 4});
    std::vector<std::uint32_t> marks(scene.skinTriangleCount, 0);
    for (const DrawRange& range : scene.ranges) {
        if (range.skin && range.blended)
            std::fill_n(marks.begin() + range.firstIndex / 3, range.indexCount / 3, 1u);
    }
    commands.upload(seen, marks);
    return seen;
}

void recordSeenTriangles(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                         const shared::ViewCamera& camera, const ViewTile& tile, const TileBuffers& buffers,
                         const gpu::Buffer& seen) {
    recordOpaqueView(device, commands, scene, camera, tile, buffers);
    const glm::uvec2 samples = glm::uvec2(tile.size) * static_cast<std::uint32_t>(tile.supersampling);
    const gpu::Program& program = device.program("seen_triangles.comp");
    commands.dispatch(
        program, {{"triangles", buffers.triangles.layer(buffers.layers - 1)}, {"SeenBuffer", seen}},
        glm::uvec3(samples, scene.skinTriangleCount), gpu::groupsFor(program, samples.x, samples.y));
}

}  // namespace cutis
