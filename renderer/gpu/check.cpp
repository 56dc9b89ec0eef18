#include "renderer/gpu/check.h"

#include "renderer/gpu/out_of_memory.h"

namespace cutis::gpu {

std::string resultText(VkResult result) {
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "out of host memory";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "out of device memory";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "initialization failed";
        case VK_ERROR_DEVICE_LOST:
            return "the device was lost (driver crash or time-out)";
        case VK_ERROR_MEMORY_MAP_FAILED:
            return "memory could not be mapped";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "layer not present";
        case VK_ERROR_EXTENSION_NOT_PRESENT:
            return "extension not present";
        case VK_ERROR_FEATURE_NOT_PRESENT:
            return "feature not present";
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return "no compatible driver";
        case VK_ERROR_TOO_MANY_OBJECTS:
            return "too many objects";
        case VK_ERROR_FORMAT_NOT_SUPPORTED:
            return "format not supported";
        case VK_ERROR_FRAGMENTED_POOL:
            return "fragmented pool";
        case VK_ERROR_OUT_OF_POOL_MEMORY:
            return "out of pool memory";
        default:
            return "Vulkan result " + std::to_string(static_cast<int>(result));
    }
}

void check(VkResult result, const char* action) {
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY) throw OutOfMemory("device", resultText(result), action);
    if (result < 0) throw Error("device", resultText(result), action);
}

void check(VkResult result, const std::string& action) {
    check(result, action.c_str());
}

}  // namespace cutis::gpu
