#include "renderer/passes/surface.h"

#include "renderer/gpu/device.h"
#include "renderer/passes/diffusion.h"
#include "renderer/passes/seams.h"

namespace cutis {
namespace {

struct PlacePush {
    glm::vec2 atlasSize, offset;  // texels
};

struct SurfacePush {
    shared::TilePush tiles;
};

gpu::Image atlasImage(gpu::Device& device, const char* name, VkFormat format, int size) {
    const auto n = static_cast<std::uint32_t>(size);
    return gpu::Image(device, {.name = name, .format = format, .width = n, .height = n});
}

// Which triangle owns each texel. Border triangles are drawn first, shifted by a texel and by half a texel
// each way; what covers a texel's centre is drawn last and stays.
void recordOwners(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                  const SurfaceImages& images) {
    gpu::RasterState state;
    state.colorFormats = {VK_FORMAT_R32_UINT};
    const gpu::Program& program = device.program({"surface.vert", "surface.frag"}, state);
    const auto size = static_cast<std::uint32_t>(images.size);
    commands.beginRendering(
        {.colors = {{images.triangles, gpu::ClearValue::integers(0)}}, .width = size, .height = size});
    const auto draw = [&](const gpu::Buffer& list, std::uint32_t triangles, glm::vec2 offset) {
        const gpu::DrawCall call{.count = triangles * 3};
        commands.draw(program,
                      {{"IndexBuffer", scene.indices},
                       {"TriangleList", list},
                       {"AtlasVertexBuffer", scene.atlasVertices}},
                      PlacePush{glm::vec2(static_cast<float>(images.size)), offset}, {&call, 1});
    };
    for (const float reach : {1.0f, 0.5f}) {
        for (int y = -1; y <= 1; ++y) {
            for (int x = -1; x <= 1; ++x) {
                if (x == 0 && y == 0) continue;
                draw(scene.borderTriangles, scene.borderTriangleCount, glm::vec2(x, y) * reach);
            }
        }
    }
    draw(scene.skinTriangles, scene.skinTriangleCount, glm::vec2(0));
    commands.endRendering();
}

}  // namespace

void recordSurface(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                   std::span<const ChartRange> charts, int size, const std::vector<std::uint32_t>& levelShifts,
                   AtlasTiles& tiles, SurfaceImages& images) {
    if (tiles.changed.empty()) {
        images = {};
        images.size = size;
        images.triangles = atlasImage(device, "surface triangles", VK_FORMAT_R32_UINT, size);
        images.position = atlasImage(device, "surface position", VK_FORMAT_R32G32B32A32_SFLOAT, size);
        images.normal = atlasImage(device, "surface normal", VK_FORMAT_R16G16B16A16_SFLOAT, size);
        images.albedo = atlasImage(device, "surface albedo", VK_FORMAT_R16G16B16A16_SFLOAT, size);
        images.stretch = atlasImage(device, "surface stretch", VK_FORMAT_R32G32B32A32_SFLOAT, size);
        recordOwners(device, commands, scene, images);
        tiles = recordCoveredTiles(device, commands, images.triangles, charts, levelShifts, scene.seams);
        commands.clear(images.position);
    }

    gpu::Bindings bindings{{"triangles", images.triangles},
                           {"IndexBuffer", scene.indices},
                           {"PositionBuffer", scene.positions},
                           {"AttributeBuffer", scene.attributes},
                           {"AtlasVertexBuffer", scene.atlasVertices},
                           {"TriangleDrawBuffer", scene.triangleDraws},
                           {"DrawBuffer", scene.draws},
                           {"MaterialBuffer", scene.materials},
                           {"position", images.position},
                           {"normal", images.normal},
                           {"albedo", images.albedo},
                           {"stretch", images.stretch},
                           {"TileStateBuffer", tiles.states}};
    if (scene.textured()) bindings.push_back({"materialTextures", scene.materialTextures});
    const gpu::Program& program = scene.textured()
                                      ? device.program("surface.comp+TEXTURED", scene.textureConstants())
                                      : device.program("surface.comp");
    dispatchTiles(commands, program, bindings, SurfacePush{}, tiles, tiles.seen());
    recordGutterStretch(device, commands, scene.seams, tiles, images);
    recordCoarseStretch(device, commands, tiles, images);
}

}  // namespace cutis
