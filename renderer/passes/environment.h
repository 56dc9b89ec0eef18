// Prefiltered environments: what irradiance and specular reflection look up (DESIGN §1.1, §1.2).
// Shaders: environment_irradiance.comp, environment_radiance.comp, environment_filter.comp; lookups:
// lib/environment.glsl.
#pragma once

#include <span>
#include <vector>

#include "renderer/gpu/device.h"
#include "renderer/gpu/image.h"
#include "renderer/scene/light.h"
#include "shaders/shared/environment.h"

namespace cutis {

// The specular layer of one kind of skin.
struct SkinSpecular {
    float roughness = 0.3f;          // m, Beckmann rms slope
    float scale = 1;                 // s
    float narrower = 0, weight = 0;  // m of the second lobe, and its share; both 0: there is none
    bool operator==(const SkinSpecular&) const = default;
};

// Cubes of RGBA32F in the environment's own frame, at intensity 1: lookups turn the direction and scale the
// result.
struct EnvironmentMaps {
    gpu::Image irradiance;  // cube by surface normal: ∫ L (N·ω) dω
    gpu::Image matte;  // cube array, one layer each kind of skin: ∫ L min(ρ_dt(N·ω, m), 1/s) (N·ω) dω, so
                       // that irradiance - s·matte is what enters the skin; none without skin
    gpu::Image radiance;  // cube array, laid out by shaders/shared/environment.h
    std::vector<shared::EnvironmentSource>
        mediumSources;  // what the set ENVIRONMENT_MEDIUM of `radiance` lacks
    std::vector<shared::EnvironmentSource> roughSources;  // what ENVIRONMENT_ROUGH lacks
    double gpuMs = 0;  // spent on filtering: 0 when all came from the cache
};

// Filters on the device, or takes the result from the cache, where it is kept by the content of the
// environment. Submits its own commands: none may be recording. Throws Error when the device fails.
EnvironmentMaps prefilterEnvironment(gpu::Device& device, const Environment& environment,
                                     std::span<const SkinSpecular> skins);

}  // namespace cutis
