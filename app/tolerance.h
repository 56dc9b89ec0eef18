// --tolerance: the cheapest setting that is known to be close enough.
#pragma once

#include <string>

#include "app/inputs.h"
#include "renderer/frame/renderer.h"
#include "renderer/gpu/device.h"
#include "renderer/measure/front.h"

namespace cutis::app {

// Keeps a finished measurement of these inputs on this device in the cache, by the content of the scene and
// its light.
void recordMeasurement(const Inputs& inputs, const gpu::DeviceInfo& device, const std::string& measureJson);

// What is known of the error of settings: for this scene on this device, else for the default scene.
struct KnownFront {
    MeasuredFront front;
    bool ofThisScene = false;
    std::string where() const;  // "the default scene at 480x270 on NVIDIA H200"
};
// Hashes the whole scene. Throws Error: what the cache holds cannot be read.
KnownFront knownFront(const Inputs& inputs, const gpu::DeviceInfo& device);

// Whether the cache holds a measurement of anything at all.
bool anyMeasurement();

// Puts into `settings`, and into the samples of the inputs' rig, the cheapest setting whose error of diffuse
// light is below `tolerance`: by the last measurement of these inputs on this device, else by one of the
// default scene. Says on stderr which it is, and how that is known. Throws Error when none is close enough.
void applyTolerance(double tolerance, Inputs& inputs, const gpu::DeviceInfo& device,
                    RenderSettings& settings);

}  // namespace cutis::app
