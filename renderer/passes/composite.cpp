#include "renderer/passes/composite.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "renderer/gpu/device.h"
#include "renderer/passes/light_views.h"

namespace cutis {
namespace {

// Surfaces seen through, one behind the other, that are kept apart.
constexpr int kPeeledLayers = 6;
// Shading points of a tile, whatever it holds: what bounds the memory of a picture of any size. So many that every device can
// bind what is known of each (Vulkan's least maxStorageBufferRange).
constexpr double kMaxPoints = double(1 << 27) / std::max(sizeof(shared::ShadingPoint), sizeof(shared::ShadedPoint));

struct ViewPush {
    std::uint32_t firstTriangle, material;
};

struct CollectPush {
    glm::ivec2 tileSize;
    int supersampling, layers;
};

struct ShadePush {
    glm::ivec2 tile, pictureSize;
    std::uint32_t lightCount;
    float step;
    std::uint32_t aovLayers0, aovLayers1;
};

struct ResolvePush {
    glm::ivec2 tile, tileSize;
    int diffuseLayer, specularLayer;
};

// The projection of the whole picture, narrowed to a tile of it.
shared::ViewCamera cameraOfTile(shared::ViewCamera camera, const ViewTile& tile) {
    const glm::vec2 picture(tile.pictureSize), size(tile.size), origin(tile.origin);
    const glm::vec2 scale = picture / size, shift = (picture - 2.0f * origin - size) / size;
    glm::mat4 narrow(1);
    narrow[0][0] = scale.x;
    narrow[1][1] = scale.y;
    narrow[3][0] = shift.x;
    narrow[3][1] = shift.y;
    camera.worldToClip = narrow * camera.worldToClip;
    return camera;
}

int layerCount(const SceneBuffers& scene) {
    return scene.seenThrough ? kPeeledLayers + 1 : 1;
}

struct PeelDepths {
    const gpu::Image *opaque, *previous;
};

void drawRange(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene, const gpu::Buffer& camera,
               const DrawRange& range, const PeelDepths* peel) {
    gpu::RasterState state;
    state.colorFormats = {VK_FORMAT_R32_UINT};
    state.depthFormat = VK_FORMAT_D32_SFLOAT;
    if (!range.doubleSided) state.cull = VK_CULL_MODE_BACK_BIT;
    std::string vertex = "view.vert", fragment = "view.frag";
    gpu::Bindings bindings{{"PositionBuffer", scene.positions}, {"CameraBuffer", camera}};
    if (range.cutOut) {
        vertex += "+MASKED";
        fragment += "+MASKED";
        bindings.push_back({"AttributeBuffer", scene.attributes});
        bindings.push_back({"MaterialBuffer", scene.materials});
    }
    gpu::Specialization constants;
    if (range.cutOut && scene.textured()) {
        fragment += "+TEXTURED";
        bindings.push_back({"materialTextures", scene.materialTextures});
        constants = {{0, scene.textureGroups}, {2, range.alphaGroup}};
    }
    if (peel) {
        fragment += "+PEEL";
        bindings.push_back({"opaqueDepth", *peel->opaque});
        bindings.push_back({"previousDepth", *peel->previous});
    }
    const gpu::DrawCall call{.first = range.firstIndex, .count = range.indexCount};
    commands.draw(device.program({vertex, fragment}, state, constants), bindings, ViewPush{range.firstIndex / 3, range.material},
                  {&call, 1}, &scene.indices);
}

}  // namespace

TileBuffers makeTileBuffers(gpu::Device& device, const SceneBuffers& scene, const glm::ivec2& size, int supersampling) {
    TileBuffers buffers;
    buffers.layers = layerCount(scene);
    const auto width = static_cast<std::uint32_t>(size.x * supersampling);
    const auto height = static_cast<std::uint32_t>(size.y * supersampling);
    const auto image = [&](const char* name, VkFormat format, std::uint32_t w, std::uint32_t h, int layers = 1) {
        return gpu::Image(device, {.name = name, .format = format, .width = w, .height = h,
                                   .layers = static_cast<std::uint32_t>(layers)});
    };
    buffers.triangles = image("view triangles", VK_FORMAT_R32_UINT, width, height, buffers.layers);
    buffers.depth = image("view depth", VK_FORMAT_D32_SFLOAT, width, height);
    if (buffers.layers > 1) {
        for (gpu::Image& peeled : buffers.peeledDepth) {
            peeled = image("peeled depth", VK_FORMAT_D32_SFLOAT, width, height);
        }
    }
    const std::uint64_t capacity = std::uint64_t(width) * height * buffers.layers;
    const auto buffer = [&](const char* name, std::uint64_t bytes, bool indirect = false) {
        return gpu::Buffer(device, {.name = name, .bytes = bytes, .indirect = indirect});
    };
    buffers.camera = buffer("camera", sizeof(shared::ViewCamera));
    buffers.points = buffer("shading points", capacity * sizeof(shared::ShadingPoint));
    buffers.skinList = buffer("skin points", capacity * 4);
    buffers.otherList = buffer("other points", capacity * 4);
    buffers.counts = buffer("point counts", 12);
    buffers.groups = buffer("point groups", 24, true);
    buffers.shaded = buffer("shaded points", capacity * sizeof(shared::ShadedPoint));
    buffers.pixels = image("pixel points", VK_FORMAT_R32G32_UINT, size.x, size.y);
    return buffers;
}

void recordOpaqueView(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                      const shared::ViewCamera& camera, const ViewTile& tile, const TileBuffers& buffers) {
    const shared::ViewCamera tileCamera = cameraOfTile(camera, tile);
    commands.upload(buffers.camera, std::vector{tileCamera});
    const auto width = static_cast<std::uint32_t>(tile.size.x * tile.supersampling);
    const auto height = static_cast<std::uint32_t>(tile.size.y * tile.supersampling);
    commands.beginRendering(
        {.colors = {{buffers.triangles.layer(buffers.layers - 1), gpu::ClearValue::integers(0)}},
         .depth = gpu::Attachment{buffers.depth, gpu::ClearValue::depth(1)}, .width = width, .height = height});
    for (const DrawRange& range : scene.ranges) {
        if (range.blended || !reaches(tileCamera.worldToClip, range.boundsMin, range.boundsMax)) continue;
        drawRange(device, commands, scene, buffers.camera, range, nullptr);
    }
    commands.endRendering();
}

void recordView(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                const shared::ViewCamera& camera, const ViewTile& tile, const TileBuffers& buffers) {
    recordOpaqueView(device, commands, scene, camera, tile, buffers);
    if (buffers.layers == 1) return;

    const shared::ViewCamera tileCamera = cameraOfTile(camera, tile);
    const auto width = static_cast<std::uint32_t>(tile.size.x * tile.supersampling);
    const auto height = static_cast<std::uint32_t>(tile.size.y * tile.supersampling);
    // Depth peeling (Everitt 2001): each layer is the nearest surface behind the one before.
    commands.clear(buffers.peeledDepth[1], gpu::ClearValue::depth(0));
    for (int layer = 0; layer < buffers.layers - 1; ++layer) {
        const PeelDepths peel{&buffers.depth, &buffers.peeledDepth[(layer + 1) % 2]};
        commands.beginRendering(
            {.colors = {{buffers.triangles.layer(layer), gpu::ClearValue::integers(0)}},
             .depth = gpu::Attachment{buffers.peeledDepth[layer % 2], gpu::ClearValue::depth(1)},
             .width = width, .height = height});
        for (const DrawRange& range : scene.ranges) {
            if (!range.blended || !reaches(tileCamera.worldToClip, range.boundsMin, range.boundsMax)) continue;
            drawRange(device, commands, scene, buffers.camera, range, &peel);
        }
        commands.endRendering();
    }
}

int tileSize(const SceneBuffers& scene, int supersampling) {
    const double pointsPerPixel = static_cast<double>(supersampling) * supersampling * layerCount(scene);
    const int edge = static_cast<int>(std::sqrt(kMaxPoints / pointsPerPixel));
    return std::max(8, edge / 8 * 8);
}

namespace {

void collectPoints(gpu::Device& device, gpu::Commands& commands, const CompositeInput& input, const ViewTile& tile) {
    const SceneBuffers& scene = *input.scene;
    const TileBuffers& buffers = *input.buffers;
    commands.fill(buffers.counts, 0);
    const gpu::Program& collect = device.program("collect.comp");
    commands.dispatch(collect,
                      {{"triangles", buffers.triangles},
                       {"IndexBuffer", scene.indices},
                       {"PositionBuffer", scene.positions},
                       {"TriangleDrawBuffer", scene.triangleDraws},
                       {"DrawBuffer", scene.draws},
                       {"PointBuffer", buffers.points},
                       {"SkinListBuffer", buffers.skinList},
                       {"OtherListBuffer", buffers.otherList},
                       {"CountBuffer", buffers.counts},
                       {"pixels", buffers.pixels}},
                      CollectPush{tile.size, tile.supersampling, buffers.layers},
                      gpu::groupsFor(collect, tile.size.x, tile.size.y));
    commands.dispatch(device.program("collect_groups.comp"),
                      {{"CountBuffer", buffers.counts}, {"GroupBuffer", buffers.groups}}, {}, {});
}

void shadePoints(gpu::Device& device, gpu::Commands& commands, const CompositeInput& input, const ViewTile& tile,
                 const PictureTarget& target, bool skin) {
    const SceneBuffers& scene = *input.scene;
    const TileBuffers& buffers = *input.buffers;
    const bool aovs = static_cast<bool>(target.aovs);
    // Skin that does not shine sees its light in the exitance alone.
    const bool matte = skin && !scene.skinShines;
    std::string shader = "shade.comp";
    gpu::Bindings bindings{{"PointBuffer", buffers.points},
                           {"ListBuffer", skin ? buffers.skinList : buffers.otherList},
                           {"CountBuffer", buffers.counts},
                           {"ShadedBuffer", buffers.shaded},
                           {"IndexBuffer", scene.indices},
                           {"PositionBuffer", scene.positions},
                           {"AttributeBuffer", scene.attributes},
                           {"TriangleDrawBuffer", scene.triangleDraws},
                           {"DrawBuffer", scene.draws},
                           {"MaterialBuffer", scene.materials},
                           {"CameraBuffer", buffers.camera},
                           {"LightBuffer", input.lights->samples}};
    if (skin) {
        shader += "+SKIN";
        bindings.push_back({"AlbedoTableBuffer", scene.albedoTable});
        bindings.push_back({"AtlasVertexBuffer", scene.atlasVertices});
        bindings.push_back({"exitance", input.skin->exitance});
        bindings.push_back({"surfaceNormal", input.surface->normal});
        if (aovs) bindings.push_back({"incident", input.skin->incident});
    }
    if (input.lights->depth && !matte) {
        shader += "+SHADOWS";
        if (skin) {
            bindings.push_back({"lightVisibility", input.skin->visibility});
        } else {
            bindings.push_back({"LightViewBuffer", input.lights->views});
            bindings.push_back({"lightDepthCompare", depthComparison(device, input.lights->depth)});
            bindings.push_back({"lightDepth", nearest(device, input.lights->depth)});
        }
    }
    if (input.environment && !matte) {
        shader += "+ENVIRONMENT";
        if (!skin) {
            bindings.push_back({"environmentIrradiance", bilinear(device, input.environment->irradiance)});
            bindings.push_back({"ProbeBuffer", input.visibility->probes});
        } else {
            bindings.push_back({"openSky", bilinear(device, input.visibility->openSky)});
        }
        bindings.push_back({"environmentRadiance", trilinear(device, input.environment->radiance)});
        bindings.push_back({"EnvironmentBuffer", *input.environmentSettings});
    }
    if (scene.textured()) {
        shader += "+TEXTURED";
        bindings.push_back({"materialTextures", scene.materialTextures});
    }
    if (aovs) {
        shader += "+AOVS";
        bindings.push_back({"aovs", target.aovs});
    }
    if (skin && !matte && scene.pores.tile) {
        const gpu::Buffer& rest = scene.pores.restPositions;
        shader += "+DETAIL";
        bindings.push_back({"RestPositionBuffer", rest ? rest : scene.positions});
        bindings.push_back({"PoreBuffer", scene.pores.materials});
        bindings.push_back({"detailSlopes", scene.pores.slopes});
    }
    ShadePush push{tile.origin, tile.pictureSize, matte ? 0 : input.lights->sampleCount, 1.0f, 0, 0};
    for (int i = 0; i < kAovCount; ++i) {
        const auto layer = static_cast<std::uint32_t>(target.aovLayer[i]) & 15u;
        (i < 8 ? push.aovLayers0 : push.aovLayers1) |= layer << (i % 8 * 4);
    }
    gpu::Specialization constants;
    if (scene.textured()) constants = scene.textureConstants();
    constants.push_back({3, scene.layers});
    const gpu::Program& program = device.program(shader, constants);
    commands.dispatchIndirect(program, bindings, push, buffers.groups, skin ? 0 : 12);
}

}  // namespace

void recordComposite(gpu::Device& device, gpu::Commands& commands, const CompositeInput& input, const ViewTile& tile,
                     const PictureTarget& target) {
    const TileBuffers& buffers = *input.buffers;
    collectPoints(device, commands, input, tile);
    bool skin = false, other = false;
    for (const DrawRange& range : input.scene->ranges) (range.skin && input.skin ? skin : other) = true;
    if (skin) shadePoints(device, commands, input, tile, target, true);
    if (other) shadePoints(device, commands, input, tile, target, false);
    const bool aovs = static_cast<bool>(target.aovs);
    gpu::Bindings bindings{{"pixels", buffers.pixels},
                           {"PointBuffer", buffers.points},
                           {"ShadedBuffer", buffers.shaded},
                           {"picture", target.picture}};
    if (aovs) bindings.push_back({"aovs", target.aovs});
    const gpu::Program& resolve = device.program(aovs ? "resolve.comp+AOVS" : "resolve.comp");
    commands.dispatch(resolve, bindings,
                      ResolvePush{tile.origin, tile.size, target.aovLayer[kAovDiffuse], target.aovLayer[kAovSpecular]},
                      gpu::groupsFor(resolve, tile.size.x, tile.size.y));
}

}  // namespace cutis
