// --tolerance: the cheapest setting that is known to be close enough.
#pragma once

#include <string>

#include "app/inputs.h"
#include "renderer/frame/renderer.h"
#include "renderer/gpu/device.h"

namespace cutis::app {

// Keeps a finished measurement of these inputs on this device in the cache, by the content of the scene and
// its light.
void recordMeasurement(const Inputs& inputs, const gpu::DeviceInfo& device, const std::string& measureJson);

// Puts into `settings`, and into the samples of the inputs' rig, the cheapest setting whose error of diffuse
// light is below `tolerance`: by the last measurement of these inputs on this device, else by one of the
// default scene. Says on stderr which it is, and how that is known. Throws Error when none is close enough.
void applyTolerance(double tolerance, Inputs& inputs, const gpu::DeviceInfo& device,
                    RenderSettings& settings);

}  // namespace cutis::app
