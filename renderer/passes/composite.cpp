#include "renderer/passes/composite.h"

#include <string>

#include "renderer/gpu/device.h"

namespace cutis {
namespace {

// Surfaces seen through, one behind the other, that are kept apart.
constexpr int kPeeledLayers = 8;

struct ViewPush {
    std::uint32_t firstTriangle, material;
};

struct CompositePush {
    glm::ivec2 tile, tileSize, pictureSize;
    int supersampling, layers;
    std::uint32_t lightCount, aovLayers0, aovLayers1;
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
    if (range.masked && !range.blended) {
        vertex += "+MASKED";
        fragment += "+MASKED";
        bindings.push_back({"AttributeBuffer", scene.attributes});
        bindings.push_back({"MaterialBuffer", scene.materials});
        bindings.push_back({"materialTextures", scene.materialTextures});
    }
    if (peel) {
        fragment += "+PEEL";
        bindings.push_back({"opaqueDepth", *peel->opaque});
        bindings.push_back({"previousDepth", *peel->previous});
    }
    const gpu::DrawCall call{.first = range.firstIndex, .count = range.indexCount};
    commands.draw(device.program({vertex, fragment}, state), bindings, ViewPush{range.firstIndex / 3, range.material},
                  {&call, 1}, &scene.indices);
}

}  // namespace

ViewImages recordView(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                      const shared::ViewCamera& camera, const ViewTile& tile) {
    bool blended = false;
    for (const DrawRange& range : scene.ranges) blended |= range.blended;
    ViewImages view;
    view.layers = blended ? kPeeledLayers + 1 : 1;
    const auto width = static_cast<std::uint32_t>(tile.size.x * tile.supersampling);
    const auto height = static_cast<std::uint32_t>(tile.size.y * tile.supersampling);
    view.triangles = gpu::Image(device, {.name = "view triangles", .format = VK_FORMAT_R32_UINT, .width = width,
                                         .height = height, .layers = static_cast<std::uint32_t>(view.layers)});
    view.camera = gpu::Buffer(device, {.name = "camera", .bytes = sizeof(shared::ViewCamera)});
    commands.upload(view.camera, std::vector{cameraOfTile(camera, tile)});
    const auto depthImage = [&](const char* name) {
        return gpu::Image(device, {.name = name, .format = VK_FORMAT_D32_SFLOAT, .width = width, .height = height});
    };

    const gpu::Image opaque = depthImage("view depth");
    commands.beginRendering({.colors = {{view.triangles.layer(view.layers - 1), gpu::ClearValue::integers(0)}},
                             .depth = gpu::Attachment{opaque, gpu::ClearValue::depth(1)}});
    for (const DrawRange& range : scene.ranges) {
        if (!range.blended) drawRange(device, commands, scene, view.camera, range, nullptr);
    }
    commands.endRendering();
    if (!blended) return view;

    // Depth peeling (Everitt 2001): each layer is the nearest surface behind the one before.
    gpu::Image depths[2] = {depthImage("peeled depth 0"), depthImage("peeled depth 1")};
    commands.clear(depths[1], gpu::ClearValue::depth(0));
    for (int layer = 0; layer < kPeeledLayers; ++layer) {
        const PeelDepths peel{&opaque, &depths[(layer + 1) % 2]};
        commands.beginRendering({.colors = {{view.triangles.layer(layer), gpu::ClearValue::integers(0)}},
                                 .depth = gpu::Attachment{depths[layer % 2], gpu::ClearValue::depth(1)}});
        for (const DrawRange& range : scene.ranges) {
            if (range.blended) drawRange(device, commands, scene, view.camera, range, &peel);
        }
        commands.endRendering();
    }
    return view;
}

void recordComposite(gpu::Device& device, gpu::Commands& commands, const CompositeInput& input, const ViewTile& tile,
                     const PictureTarget& target) {
    const SceneBuffers& scene = *input.scene;
    std::string shader = "composite.comp";
    gpu::Bindings bindings{{"triangles", input.view->triangles},  {"IndexBuffer", scene.indices},
                           {"PositionBuffer", scene.positions},   {"AttributeBuffer", scene.attributes},
                           {"TriangleDrawBuffer", scene.triangleDraws}, {"DrawBuffer", scene.draws},
                           {"MaterialBuffer", scene.materials},   {"CameraBuffer", input.view->camera},
                           {"LightBuffer", input.lights->samples}, {"picture", target.picture}};
    const bool skin = input.skin != nullptr, aovs = static_cast<bool>(target.aovs);
    if (skin) {
        shader += "+SKIN";
        bindings.push_back({"AlbedoTableBuffer", scene.albedoTable});
        bindings.push_back({"AtlasVertexBuffer", scene.atlasVertices});
        bindings.push_back({"exitance", bilinear(device, input.skin->exitance)});
        if (aovs) bindings.push_back({"incident", bilinear(device, input.skin->incident)});
    }
    if (input.lights->depth) {
        shader += "+SHADOWS";
        bindings.push_back({"LightViewBuffer", input.lights->views});
        bindings.push_back({"lightDepthCompare", depthComparison(device, input.lights->depth)});
        bindings.push_back({"lightDepth", nearest(device, input.lights->depth)});
    }
    if (input.environment) {
        shader += "+ENVIRONMENT";
        bindings.push_back({"environmentIrradiance", bilinear(device, input.environment->irradiance)});
        bindings.push_back({"environmentRadiance", trilinear(device, input.environment->radiance)});
        bindings.push_back({"EnvironmentBuffer", *input.environmentSettings});
        bindings.push_back({"ProbeBuffer", input.visibility->probes});
        if (skin) bindings.push_back({"openSky", bilinear(device, input.visibility->openSky)});
    }
    if (scene.textured()) {
        shader += "+TEXTURED";
        bindings.push_back({"materialTextures", scene.materialTextures});
    }
    if (aovs) {
        shader += "+AOVS";
        bindings.push_back({"aovs", target.aovs});
    }
    CompositePush push{tile.origin, tile.size, tile.pictureSize, tile.supersampling, input.view->layers,
                       input.lights->sampleCount, 0, 0};
    for (int i = 0; i < kAovCount; ++i) {
        const auto layer = static_cast<std::uint32_t>(target.aovLayer[i]) & 15u;
        (i < 8 ? push.aovLayers0 : push.aovLayers1) |= layer << (i % 8 * 4);
    }
    const gpu::Program& program = device.program(shader);
    commands.dispatch(program, bindings, push, gpu::groupsFor(program, tile.size.x, tile.size.y));
}

}  // namespace cutis
