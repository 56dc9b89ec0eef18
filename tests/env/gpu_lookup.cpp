#include "tests/env/gpu_lookup.h"

#include <cmath>
#include <numbers>

#include "renderer/gpu/commands.h"
#include "renderer/skin/specular.h"
#include "renderer/skin/specular_lobes.h"
#include "shaders/shared/scene.h"

namespace cutis::test {

gpu::Device& testDevice() {
    static gpu::Device device({.select = "cpu", .validation = true});
    return device;
}

std::vector<glm::vec3> lookUp(const EnvironmentMaps& maps, const LookupSettings& settings,
                              std::span<const LookupQuery> queries) {
    struct Push {
        unsigned what, count;
        float roughness, scale;
    };
    gpu::Device& device = testDevice();
    gpu::Commands commands = device.begin();
    const gpu::Buffer input(device, {.name = "queries", .bytes = queries.size_bytes()});
    commands.upload(input, std::as_bytes(queries));
    const gpu::Buffer output(device, {.name = "results", .bytes = queries.size() * sizeof(glm::vec3)});
    const double angle = settings.rotation * std::numbers::pi / 180;
    const shared::EnvironmentSettingsData environment{
        float(std::cos(angle)), float(std::sin(angle)), float(settings.intensity),
        unsigned(maps.mediumSources.size()), unsigned(maps.roughSources.size())};
    std::vector<shared::EnvironmentSource> sources = maps.mediumSources;
    sources.insert(sources.end(), maps.roughSources.begin(), maps.roughSources.end());
    const gpu::Buffer settingsBuffer(
        device, {.name = "settings", .bytes = sizeof(environment) + sources.size() * sizeof(sources[0])});
    commands.upload(settingsBuffer, std::as_bytes(std::span(&environment, 1)));
    if (!sources.empty()) commands.upload(settingsBuffer, sources, sizeof(environment));
    std::vector<float> row = skin::directionalAlbedoRow(settings.roughness);
    const std::vector<float> lobes = skin::specularLobeTable(settings.roughness);
    row.insert(row.end(), lobes.begin(), lobes.end());
    const gpu::Buffer table(device, {.name = "table", .bytes = row.size() * sizeof(float)});
    commands.upload(table, row);
    const gpu::Program& program = device.program("environment_lookup.comp");
    const VkSampler sampler = device.sampler();
    commands.dispatch(
        program,
        {{"QueryBuffer", input},
         {"ResultBuffer", output},
         {"EnvironmentBuffer", settingsBuffer},
         {"AlbedoTableBuffer", table},
         {"environmentIrradiance", gpu::sampled(maps.irradiance, sampler)},
         {"environmentRadiance", gpu::sampled(maps.radiance, sampler)},
         {"environmentMatte", gpu::sampled(maps.matte, sampler)}},
        Push{unsigned(settings.what), unsigned(queries.size()), settings.roughness, settings.scale},
        gpu::groupsFor(program, std::uint32_t(queries.size())));
    gpu::Readback result = commands.readback(output);
    commands.submitAndWait();
    return result.as<glm::vec3>();
}

}  // namespace cutis::test
