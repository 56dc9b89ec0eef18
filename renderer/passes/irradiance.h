// Irradiance: all light on each texel of skin in one texture. Shader: irradiance.comp.
#pragma once

#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/environment.h"
#include "renderer/passes/resources.h"

namespace cutis {

struct IrradianceInput {
    const SceneBuffers* scene;
    const SurfaceImages* surface;
    const AtlasTiles* tiles;
    const LightMaps* lights =
        nullptr;  // nullptr: no lights; without depth: no shadows; without entry: no translucency
    const EnvironmentMaps* environment = nullptr;
    const EnvironmentVisibility* visibility = nullptr;  // with environment
    const gpu::Buffer* environmentSettings = nullptr;   // with environment
};

// Makes and fills light.irradiance, light.incident and, with shadows, light.visibility.
void recordIrradiance(gpu::Device& device, gpu::Commands& commands, const IrradianceInput& input,
                      SkinLight& light);

}  // namespace cutis
