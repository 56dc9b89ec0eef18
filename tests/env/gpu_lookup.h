// lib/environment.glsl evaluated on the device for a list of normals and views.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/gpu/device.h"
#include "renderer/passes/environment.h"

namespace cutis::test {

enum class Lookup : unsigned { irradiance, matte, skinSpecular, ggxSpecular, radiance };

struct LookupQuery {
    glm::vec3 normal, view{0};
};

struct LookupSettings {
    Lookup what = Lookup::irradiance;
    float roughness = 0;  // m, alpha, or σ of the radiance's lobe
    float scale = 1;      // s or F0
    double rotation = 0;  // degrees
    double intensity = 1;
};

// One for all tests, on the CPU, with validation.
gpu::Device& testDevice();

std::vector<glm::vec3> lookUp(const EnvironmentMaps& maps, const LookupSettings& settings,
                              std::span<const LookupQuery> queries);

}  // namespace cutis::test
