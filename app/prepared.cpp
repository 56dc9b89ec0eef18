#include "app/prepared.h"

#include "renderer/core/error.h"

namespace cutis::app {

Prepared::Prepared(const Request& request)
    : loading_(std::async(std::launch::async, [&] { return loadInputs(request); })),
      device({.select = request.device}),
      inputs(loading_.get()) {}

RenderInput renderInput(const Inputs& inputs) {
    return {.scene = &inputs.scene,
            .poseRevision = inputs.poseRevision,
            .rig = inputs.rig,
            .environment = inputs.environment ? &*inputs.environment : nullptr,
            .camera = inputs.camera};
}

void checkValidation(const gpu::Device& device) {
    if (const std::uint64_t messages = gpu::validationMessages()) {
        throw Error("validation failed", std::to_string(messages) + " messages from the validation layers",
                    device.info().name);
    }
}

}  // namespace cutis::app
