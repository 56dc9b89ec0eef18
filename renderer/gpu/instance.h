// Inside gpu/: the Vulkan instance, its validation messages, and which physical devices suit cutis.
#pragma once

#include <vulkan/vulkan.h>

#include <string>
#include <vector>

#include "renderer/gpu/device.h"

namespace cutis::gpu {

struct Instance {
    VkInstance handle = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;  // with validation only
    bool debugUtils = false;
};

// Throws Error when there is no Vulkan, or validation is asked for and its layer is absent.
Instance createInstance(bool validation, const std::vector<const char*>& extensions);
void destroyInstance(Instance& instance);

// Features that cutis enables: `base` heads the chain to hand to Vulkan.
struct Features {
    VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &v13};
    VkPhysicalDeviceVulkan11Features v11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES, &v12};
    VkPhysicalDeviceFeatures2 base{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &v11};
    Features() = default;
    Features(const Features&) = delete;
    Features& operator=(const Features&) = delete;
};

// Turns on in `enabled` what cutis wants and `physical` has. Returns what cutis needs and it lacks.
std::vector<std::string> chooseFeatures(VkPhysicalDevice physical, Features& enabled);

std::vector<VkPhysicalDevice> enumeratePhysicalDevices(VkInstance instance);
DeviceInfo describeDevice(VkPhysicalDevice physical, std::uint32_t index);
// The first queue family for graphics, compute and timestamps, or -1.
int findQueueFamily(VkPhysicalDevice physical);
bool hasDeviceExtension(VkPhysicalDevice physical, const char* name);

}  // namespace cutis::gpu
