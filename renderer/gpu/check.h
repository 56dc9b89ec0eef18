// Vulkan result codes as errors.
#pragma once

#include <vulkan/vulkan.h>

#include <string>

namespace cutis::gpu {

// "out of device memory", "device lost", ... ; the number for codes that have no text here.
std::string resultText(VkResult result);

// Throws Error("device", ...) saying what was being done when `result` is a failure.
void check(VkResult result, const char* action);
void check(VkResult result, const std::string& action);

}  // namespace cutis::gpu
