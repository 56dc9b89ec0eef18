// What every command that renders begins and ends with.
#pragma once

#include <future>

#include "app/inputs.h"
#include "renderer/frame/frame.h"
#include "renderer/gpu/device.h"

namespace cutis::app {

// Scene, rig, environment and camera of a request, and the device that it names. Files are read while the
// device opens, as they have nothing to do with each other.
class Prepared {
    std::future<Inputs> loading_;  // begun first

  public:
    // Throws Error.
    explicit Prepared(const Request& request);

    gpu::Device device;
    Inputs inputs;
};

// Refers to `inputs`, which must outlive it.
RenderInput renderInput(const Inputs& inputs);

// Throws Error when the validation layers had anything to say.
void checkValidation(const gpu::Device& device);

}  // namespace cutis::app
