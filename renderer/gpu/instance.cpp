#include "renderer/gpu/instance.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstring>

#include "renderer/core/error.h"
#include "renderer/gpu/check.h"

namespace cutis::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

std::atomic<std::uint64_t> messageCount{0};

VKAPI_ATTR VkBool32 VKAPI_CALL reportMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                             VkDebugUtilsMessageTypeFlagsEXT,
                                             const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
    ++messageCount;
    std::fprintf(stderr, "cutis: validation: %s\n", data->pMessage);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo() {
    VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    // Not GENERAL: there the loader tells about drivers that it skips, which is no fault of cutis.
    info.messageType =
        VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = reportMessage;
    return info;
}

bool hasLayer(const char* name) {
    std::uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    return std::any_of(layers.begin(), layers.end(),
                       [&](const auto& l) { return !std::strcmp(l.layerName, name); });
}

bool hasInstanceExtension(const char* layer, const char* name) {
    std::uint32_t count = 0;
    if (vkEnumerateInstanceExtensionProperties(layer, &count, nullptr) != VK_SUCCESS) return false;
    std::vector<VkExtensionProperties> list(count);
    vkEnumerateInstanceExtensionProperties(layer, &count, list.data());
    return std::any_of(list.begin(), list.end(),
                       [&](const auto& e) { return !std::strcmp(e.extensionName, name); });
}

struct WantedFeature {
    const char* name;
    VkBool32& (*member)(Features&);
    bool required;
};

#define CORE(feature) #feature, [](Features & f) -> VkBool32& { return f.base.features.feature; }
#define V11(feature) #feature, [](Features & f) -> VkBool32& { return f.v11.feature; }
#define V12(feature) #feature, [](Features & f) -> VkBool32& { return f.v12.feature; }
#define V13(feature) #feature, [](Features & f) -> VkBool32& { return f.v13.feature; }
constexpr WantedFeature kFeatures[] = {
    {CORE(geometryShader), true},  // gl_PrimitiveID in fragment shaders
    {CORE(shaderStorageImageWriteWithoutFormat), true},
    {CORE(shaderStorageImageExtendedFormats), true},
    {CORE(imageCubeArray), true},
    {CORE(depthClamp), true},
    {CORE(fragmentStoresAndAtomics), true},
    {CORE(independentBlend), false},
    {CORE(samplerAnisotropy), false},
    {CORE(shaderSampledImageArrayDynamicIndexing), false},
    {V11(shaderDrawParameters), true},
    {V11(multiview), false},
    {V12(scalarBlockLayout), true},
    {V13(dynamicRendering), true},
    {V13(synchronization2), true},
    {V13(maintenance4), true},                    // local sizes from specialization constants
    {V13(shaderDemoteToHelperInvocation), true},  // `discard` in SPIR-V 1.6
    {V13(shaderTerminateInvocation), true},
};
#undef CORE
#undef V11
#undef V12
#undef V13

const char* typeName(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return "discrete";
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return "integrated";
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return "virtual";
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return "cpu";
        default:
            return "other";
    }
}

// Empty, or why cutis cannot run on the device.
std::string whyUnsuitable(VkPhysicalDevice physical, const VkPhysicalDeviceProperties& properties) {
    if (properties.apiVersion < VK_API_VERSION_1_3) {
        return "it has Vulkan " + std::to_string(VK_API_VERSION_MAJOR(properties.apiVersion)) + "." +
               std::to_string(VK_API_VERSION_MINOR(properties.apiVersion)) + ", cutis needs 1.3";
    }
    Features features;
    std::string lacking;
    for (const std::string& name : chooseFeatures(physical, features))
        lacking += (lacking.empty() ? "" : ", ") + name;
    if (!lacking.empty()) return "it lacks " + lacking;
    VkPhysicalDeviceVulkan11Properties subgroups{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &subgroups};
    vkGetPhysicalDeviceProperties2(physical, &all);
    constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    if (!(subgroups.subgroupSupportedOperations & VK_SUBGROUP_FEATURE_BALLOT_BIT) ||
        (subgroups.subgroupSupportedStages & kStages) != kStages) {
        return "it lacks subgroup ballots in compute and fragment shaders";
    }
    if (findQueueFamily(physical) < 0) return "it has no queue for graphics and compute with timestamps";
    return {};
}

}  // namespace

std::uint64_t validationMessages() {
    return messageCount;
}

Instance createInstance(bool validation, const std::vector<const char*>& wantedExtensions) {
    Instance instance;
    std::vector<const char*> extensions = wantedExtensions;
    std::vector<const char*> layers;
    if (validation) {
        if (!hasLayer(kValidationLayer)) {
            throw Error("device", std::string("validation is asked for, but ") + kValidationLayer +
                                      " is not installed");
        }
        layers.push_back(kValidationLayer);
    }
    for (const char* name : wantedExtensions) {
        if (!hasInstanceExtension(nullptr, name)) throw Error("device", std::string("Vulkan lacks ") + name);
    }
    instance.debugUtils =
        hasInstanceExtension(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) ||
        (validation && hasInstanceExtension(kValidationLayer, VK_EXT_DEBUG_UTILS_EXTENSION_NAME));
    if (instance.debugUtils) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);

    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = application.pEngineName = "cutis";
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &application;
    const VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronization;
    // In the chain too, so that messages about creating and destroying the instance itself are counted.
    VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo();
    if (validation) {
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
        messenger.pNext = &features;
        info.pNext = &messenger;
    }
    info.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
    info.ppEnabledLayerNames = layers.data();
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    const VkResult result = vkCreateInstance(&info, nullptr, &instance.handle);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
        throw Error("device",
                    "no Vulkan driver found (Debian: install mesa-vulkan-drivers, which has a software one)");
    }
    check(result, "creating the Vulkan instance");
    if (validation) {
        const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance.handle, "vkCreateDebugUtilsMessengerEXT"));
        messenger.pNext = nullptr;
        check(create(instance.handle, &messenger, nullptr, &instance.messenger),
              "creating the debug messenger");
    }
    return instance;
}

void destroyInstance(Instance& instance) {
    if (instance.messenger) {
        const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance.handle, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(instance.handle, instance.messenger, nullptr);
    }
    if (instance.handle) vkDestroyInstance(instance.handle, nullptr);
    instance = {};
}

std::vector<std::string> chooseFeatures(VkPhysicalDevice physical, Features& enabled) {
    Features available;
    vkGetPhysicalDeviceFeatures2(physical, &available.base);
    std::vector<std::string> lacking;
    for (const WantedFeature& feature : kFeatures) {
        feature.member(enabled) = feature.member(available);
        if (feature.required && !feature.member(available)) lacking.push_back(feature.name);
    }
    return lacking;
}

std::vector<VkPhysicalDevice> enumeratePhysicalDevices(VkInstance instance) {
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "listing devices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "listing devices");
    devices.resize(count);
    return devices;
}

DeviceInfo describeDevice(VkPhysicalDevice physical, std::uint32_t index) {
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver};
    vkGetPhysicalDeviceProperties2(physical, &properties);
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    DeviceInfo info;
    info.name = properties.properties.deviceName;
    info.driver =
        std::string(driver.driverName) + (driver.driverInfo[0] ? std::string(" ") + driver.driverInfo : "");
    info.type = typeName(properties.properties.deviceType);
    info.index = index;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        if (!(memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)) continue;
        info.memoryBytes = std::max<std::uint64_t>(info.memoryBytes, memory.memoryHeaps[i].size);
    }
    info.unsuitable = whyUnsuitable(physical, properties.properties);
    return info;
}

int findQueueFamily(VkPhysicalDevice physical) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & kNeeded) == kNeeded && families[i].timestampValidBits > 0) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

bool hasDeviceExtension(VkPhysicalDevice physical, const char* name) {
    std::uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> list(count);
    vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, list.data());
    return std::any_of(list.begin(), list.end(),
                       [&](const auto& e) { return !std::strcmp(e.extensionName, name); });
}

std::vector<DeviceInfo> listDevices() {
    Instance instance = createInstance(false, {});
    std::vector<DeviceInfo> list;
    try {
        for (const VkPhysicalDevice physical : enumeratePhysicalDevices(instance.handle)) {
            list.push_back(describeDevice(physical, static_cast<std::uint32_t>(list.size())));
        }
    } catch (...) {
        destroyInstance(instance);
        throw;
    }
    destroyInstance(instance);
    return list;
}

}  // namespace cutis::gpu
