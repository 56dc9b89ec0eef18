// A flattened scene on the device.
#pragma once

#include <vector>

#include "renderer/frame/atlas.h"
#include "renderer/frame/geometry.h"
#include "renderer/passes/environment.h"
#include "renderer/passes/resources.h"

namespace cutis {

struct UploadedScene {
    SceneBuffers buffers;
    std::vector<ChartRange> charts;         // one an atlas chart
    std::vector<SkinSpecular> skins;        // distinct specular layers, in the order of the matte maps
    bool translucent = false;               // some skin lets light through
    int gaussians = 0;                      // most of any chart
};

// `gaussians` > 0: profiles are reduced to that many Gaussians.
UploadedScene uploadScene(gpu::Device& device, gpu::Commands& commands, const Scene& scene, const Geometry& geometry,
                          const Atlas& atlas, int gaussians);

}  // namespace cutis
