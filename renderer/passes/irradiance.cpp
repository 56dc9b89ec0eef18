#include "renderer/passes/irradiance.h"

#include <algorithm>
#include <string>

#include "renderer/gpu/device.h"
#include "shared/light_share.h"

namespace cutis {
namespace {

struct LightsPush {
    shared::TilePush tiles;
    std::uint32_t firstSample, light, starts, startsLight, firstView, groupCount;
};

struct IrradiancePush {
    shared::TilePush tiles;
    std::uint32_t lights;
};

// Adds the light samples, a few at a time, and makes light.visibility when any has a map.
void recordLights(gpu::Device& device, gpu::Commands& commands, const IrradianceInput& input,
                  SkinLight& light) {
    const LightMaps& lights = *input.lights;
    gpu::Bindings bindings{{"position", input.surface->position},
                           {"normal", input.surface->normal},
                           {"DrawBuffer", input.scene->draws},
                           {"MaterialBuffer", input.scene->materials},
                           {"AlbedoTableBuffer", input.scene->albedoTable},
                           {"LightBuffer", lights.samples},
                           {"irradiance", light.irradiance},
                           {"incident", light.incident}};
    gpu::Bindings shadowed = bindings;
    if (lights.depth) {
        if (input.tiles->changed.empty()) {
            const auto size = static_cast<std::uint32_t>(input.surface->size);
            light.visibility = gpu::Image(device, {.name = "light visibility",
                                                   .format = VK_FORMAT_R8_UNORM,
                                                   .width = size,
                                                   .height = size,
                                                   .layers = std::max(lights.lightCount, 1u)});
            // Lights without shadow arrive.
            commands.clear(light.visibility, gpu::ClearValue(shared::LIGHT_ARRIVES, 0, 0, 1));
        }
        shadowed.push_back({"LightViewBuffer", lights.views});
        shadowed.push_back({"lightVisibility", light.visibility});
        shadowed.push_back({"lightDepthCompare", depthComparison(device, lights.depth)});
        shadowed.push_back({"lightDepth", nearest(device, lights.depth)});
    }
    const AtlasTiles& tiles = *input.tiles;
    for (const LightRun& run : lights.runs) {
        const std::string shader = run.shadow ? "irradiance_lights.comp+SHADOWS" : "irradiance_lights.comp";
        const LightsPush push{{},
                              run.firstSample,
                              run.light,
                              &run == &lights.runs.front() ? 1u : 0u,
                              run.startsLight ? 1u : 0u,
                              run.firstView,
                              lights.groupCount};
        dispatchTiles(commands, device.program(shader, {{0, run.sampleCount}}),
                      run.shadow ? shadowed : bindings, push, tiles, tiles.lit());
    }
}

}  // namespace

void recordIrradiance(gpu::Device& device, gpu::Commands& commands, const IrradianceInput& input,
                      SkinLight& light) {
    if (input.tiles->changed.empty()) {
        const auto size = static_cast<std::uint32_t>(input.surface->size);
        const auto make = [&](gpu::Image& image, const char* name) {
            image = gpu::Image(
                device, {.name = name, .format = VK_FORMAT_R32G32B32A32_SFLOAT, .width = size, .height = size});
            // What lies beyond the needed tiles is read with weight 0.
            commands.clear(image);
        };
        make(light.irradiance, "irradiance");
        make(light.incident, "incident");
    }
    if (input.lights) recordLights(device, commands, input, light);

    std::string shader = "irradiance.comp";
    gpu::Bindings bindings{{"position", input.surface->position}, {"normal", input.surface->normal},
                           {"albedo", input.surface->albedo},     {"stretch", input.surface->stretch},
                           {"DrawBuffer", input.scene->draws},    {"MaterialBuffer", input.scene->materials},
                           {"irradiance", light.irradiance},      {"incident", light.incident}};
    if (input.environment) {
        shader += "+ENVIRONMENT";
        bindings.push_back({"environmentIrradiance", bilinear(device, input.environment->irradiance)});
        bindings.push_back({"environmentMatte", bilinear(device, input.environment->matte)});
        bindings.push_back({"environmentOcclusion", bilinear(device, input.visibility->occlusion)});
        bindings.push_back({"EnvironmentBuffer", *input.environmentSettings});
    }
    if (const gpu::Image& entry = light.entry ? light.entry : input.surface->opposite) {
        shader += "+TRANSLUCENCY";
        bindings.push_back({"entry", entry});
    }
    dispatchTiles(commands, device.program(shader), bindings, IrradiancePush{{}, input.lights && !input.lights->runs.empty() ? 1u : 0u}, *input.tiles,
                  input.tiles->lit());
}

}  // namespace cutis
