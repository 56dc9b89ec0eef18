#include "renderer/passes/irradiance.h"

#include <algorithm>
#include <string>

#include "renderer/gpu/device.h"

namespace cutis {

void recordIrradiance(gpu::Device& device, gpu::Commands& commands, const IrradianceInput& input, SkinLight& light) {
    const auto size = static_cast<std::uint32_t>(input.surface->size);
    const auto image = [&](const char* name, VkFormat format) {
        return gpu::Image(device, {.name = name, .format = format, .width = size, .height = size});
    };
    light.irradiance = image("irradiance", VK_FORMAT_R32G32B32A32_SFLOAT);
    light.incident = image("incident", VK_FORMAT_R32G32B32A32_SFLOAT);

    std::string shader = "irradiance.comp";
    gpu::Bindings bindings{{"position", bilinear(device, input.surface->position)},
                           {"normal", bilinear(device, input.surface->normal)},
                           {"albedo", bilinear(device, input.surface->albedo)},
                           {"stretch", bilinear(device, input.surface->stretch)},
                           {"DrawBuffer", input.scene->draws},
                           {"MaterialBuffer", input.scene->materials},
                           {"AlbedoTableBuffer", input.scene->albedoTable},
                           {"irradiance", light.irradiance},
                           {"incident", light.incident}};
    if (input.surface->opposite) {
        shader += "+OPPOSITE";
        bindings.push_back({"opposite", bilinear(device, input.surface->opposite)});
    }
    std::uint32_t lightCount = 0;
    if (input.environment) {
        shader += "+ENVIRONMENT";
        bindings.push_back({"environmentIrradiance", bilinear(device, input.environment->irradiance)});
        bindings.push_back({"environmentMatte", bilinear(device, input.environment->matte)});
        bindings.push_back({"environmentOcclusion", bilinear(device, input.visibility->occlusion)});
        bindings.push_back({"EnvironmentBuffer", *input.environmentSettings});
    }
    if (input.lights) {
        shader += "+LIGHTS";
        lightCount = input.lights->sampleCount;
        bindings.push_back({"LightBuffer", input.lights->samples});
        if (input.lights->depth) {
            shader += "+SHADOWS";
            bindings.push_back({"LightViewBuffer", input.lights->views});
            light.visibility = gpu::Image(device, {.name = "light visibility", .format = VK_FORMAT_R8_UNORM,
                                                   .width = size, .height = size,
                                                   .layers = std::max(input.lights->lightCount, 1u)});
            commands.clear(light.visibility);
            bindings.push_back({"lightVisibility", light.visibility});
            bindings.push_back({"lightDepthCompare", depthComparison(device, input.lights->depth)});
            bindings.push_back({"lightDepth", nearest(device, input.lights->depth)});
        }
        if (input.lights->entry) {
            shader += "+TRANSLUCENCY";
            light.entry = image("entry points", VK_FORMAT_R32G32_SFLOAT);
            bindings.push_back({"lightEntry", input.lights->entry});
            bindings.push_back({"entry", light.entry});
        }
    }
    const gpu::Program& program = device.program(shader);
    commands.dispatch(program, bindings, lightCount, gpu::groupsFor(program, size, size));
}

}  // namespace cutis
