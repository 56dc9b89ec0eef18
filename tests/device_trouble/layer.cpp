// A Vulkan layer that makes a device fail as $CUTIS_TROUBLE says, so that tests meet what a machine at hand
// does not do:
//   no-device      Vulkan lists none
//   old            every device has Vulkan 1.2
//   feature        every device lacks scalarBlockLayout
//   memory:BYTES   allocations beyond BYTES in all fail, out of device memory
//   lost:N         the Nth submission and all later ones find the device lost
//   crash:N        the same, until another device is created
//   window:FILE    once FILE exists, submissions by vkQueueSubmit do, which only a window's frames use
// See "Layer Interface to the Loader" of the Vulkan loader's documentation.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

namespace {

struct Trouble {
    std::string kind, text;  // what stands before and after the colon
    std::uint64_t value = 0;
};

Trouble readTrouble() {
    const char* text = std::getenv("CUTIS_TROUBLE");
    Trouble trouble;
    trouble.kind = text ? text : "";
    if (const std::size_t colon = trouble.kind.find(':'); colon != std::string::npos) {
        trouble.text = trouble.kind.substr(colon + 1);
        trouble.value = std::strtoull(trouble.text.c_str(), nullptr, 10);
        trouble.kind.resize(colon);
    }
    return trouble;
}

const Trouble& trouble() {
    static const Trouble read = readTrouble();
    return read;
}

bool troubled(const char* kind) {
    return trouble().kind == kind;
}

// Functions of the next layer or the driver. They are looked up while an instance or device is created:
// afterwards the loader answers with the first layer's. One instance, and devices of one driver, whose
// functions are the same, are all that the tests need.
struct Next {
    PFN_vkGetInstanceProcAddr getInstance = nullptr;
    PFN_vkCreateDevice createDevice = nullptr;
    PFN_vkEnumeratePhysicalDevices enumeratePhysicalDevices = nullptr;
    PFN_vkGetPhysicalDeviceProperties2 getProperties2 = nullptr;
    PFN_vkGetPhysicalDeviceFeatures2 getFeatures2 = nullptr;
    PFN_vkGetDeviceProcAddr getDevice = nullptr;
    PFN_vkAllocateMemory allocateMemory = nullptr;
    PFN_vkFreeMemory freeMemory = nullptr;
    PFN_vkQueueSubmit queueSubmit = nullptr;
    PFN_vkQueueSubmit2 queueSubmit2 = nullptr;
};
Next next;

std::mutex mutex;
std::map<VkDeviceMemory, VkDeviceSize> allocations;
std::uint64_t allocated = 0, submissions = 0;
bool crashed = false, mended = false;

// The loader's link to the next layer or the driver, in the chain of a create call.
template <class Info>
Info* linkOf(const void* chain, VkStructureType type) {
    auto* info = static_cast<Info*>(const_cast<void*>(chain));
    while (info && !(info->sType == type && info->function == VK_LAYER_LINK_INFO))
        info = static_cast<Info*>(const_cast<void*>(info->pNext));
    return info;
}

template <class Function>
void find(Function& function, VkInstance instance, const char* name) {
    function = reinterpret_cast<Function>(next.getInstance(instance, name));
}

template <class Function>
void find(Function& function, VkDevice device, const char* name) {
    function = reinterpret_cast<Function>(next.getDevice(device, name));
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info,
                                              const VkAllocationCallbacks* allocator, VkInstance* instance) {
    auto* link =
        linkOf<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    if (!link) return VK_ERROR_INITIALIZATION_FAILED;
    next.getInstance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    PFN_vkCreateInstance create = nullptr;
    find(create, VkInstance{}, "vkCreateInstance");
    const VkResult result = create(info, allocator, instance);
    if (result != VK_SUCCESS) return result;
    find(next.createDevice, *instance, "vkCreateDevice");
    find(next.enumeratePhysicalDevices, *instance, "vkEnumeratePhysicalDevices");
    find(next.getProperties2, *instance, "vkGetPhysicalDeviceProperties2");
    find(next.getFeatures2, *instance, "vkGetPhysicalDeviceFeatures2");
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkDevice* device) {
    auto* link = linkOf<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    if (!link) return VK_ERROR_INITIALIZATION_FAILED;
    next.getDevice = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const VkResult result = next.createDevice(physical, info, allocator, device);
    if (result != VK_SUCCESS) return result;
    find(next.allocateMemory, *device, "vkAllocateMemory");
    find(next.freeMemory, *device, "vkFreeMemory");
    find(next.queueSubmit, *device, "vkQueueSubmit");
    find(next.queueSubmit2, *device, "vkQueueSubmit2");
    const std::lock_guard lock(mutex);
    mended = crashed;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL enumeratePhysicalDevices(VkInstance instance, std::uint32_t* count,
                                                        VkPhysicalDevice* devices) {
    if (!troubled("no-device")) return next.enumeratePhysicalDevices(instance, count, devices);
    *count = 0;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL getProperties2(VkPhysicalDevice physical,
                                          VkPhysicalDeviceProperties2* properties) {
    next.getProperties2(physical, properties);
    if (troubled("old")) properties->properties.apiVersion = VK_API_VERSION_1_2;
}

VKAPI_ATTR void VKAPI_CALL getFeatures2(VkPhysicalDevice physical, VkPhysicalDeviceFeatures2* features) {
    next.getFeatures2(physical, features);
    if (!troubled("feature")) return;
    for (auto* entry = static_cast<VkBaseOutStructure*>(features->pNext); entry; entry = entry->pNext) {
        if (entry->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES)
            reinterpret_cast<VkPhysicalDeviceVulkan12Features*>(entry)->scalarBlockLayout = VK_FALSE;
    }
}

VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks* allocator,
                                              VkDeviceMemory* memory) {
    const std::lock_guard lock(mutex);
    if (troubled("memory") && allocated + info->allocationSize > trouble().value)
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    const VkResult result = next.allocateMemory(device, info, allocator, memory);
    if (result == VK_SUCCESS) {
        allocations[*memory] = info->allocationSize;
        allocated += info->allocationSize;
    }
    return result;
}

VKAPI_ATTR void VKAPI_CALL freeMemory(VkDevice device, VkDeviceMemory memory,
                                      const VkAllocationCallbacks* allocator) {
    const std::lock_guard lock(mutex);
    if (const auto known = allocations.find(memory); known != allocations.end()) {
        allocated -= known->second;
        allocations.erase(known);
    }
    next.freeMemory(device, memory, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit2(VkQueue queue, std::uint32_t count, const VkSubmitInfo2* infos,
                                            VkFence fence) {
    const std::lock_guard lock(mutex);
    if (troubled("lost") && ++submissions >= trouble().value) return VK_ERROR_DEVICE_LOST;
    if (troubled("crash") && !mended && ++submissions >= trouble().value) {
        crashed = true;
        return VK_ERROR_DEVICE_LOST;
    }
    return next.queueSubmit2(queue, count, infos, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                           VkFence fence) {
    if (troubled("window") && std::filesystem::exists(trouble().text)) return VK_ERROR_DEVICE_LOST;
    return next.queueSubmit(queue, count, infos, fence);
}

struct Entry {
    const char* name;
    PFN_vkVoidFunction function;
    bool ofDevice;
};

template <class Function>
Entry entry(const char* name, Function function, bool ofDevice) {
    return {name, reinterpret_cast<PFN_vkVoidFunction>(function), ofDevice};
}

PFN_vkVoidFunction findOwn(const char* name, bool ofDevice);

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceFunction(VkDevice device, const char* name) {
    if (const PFN_vkVoidFunction own = findOwn(name, true)) return own;
    return next.getDevice(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceFunction(VkInstance instance, const char* name) {
    if (const PFN_vkVoidFunction own = findOwn(name, false)) return own;
    return next.getInstance ? next.getInstance(instance, name) : nullptr;
}

PFN_vkVoidFunction findOwn(const char* name, bool ofDevice) {
    static const Entry entries[] = {
        entry("vkGetInstanceProcAddr", getInstanceFunction, false),
        entry("vkCreateInstance", createInstance, false),
        entry("vkCreateDevice", createDevice, false),
        entry("vkEnumeratePhysicalDevices", enumeratePhysicalDevices, false),
        entry("vkGetPhysicalDeviceProperties2", getProperties2, false),
        entry("vkGetPhysicalDeviceFeatures2", getFeatures2, false),
        entry("vkGetDeviceProcAddr", getDeviceFunction, true),
        entry("vkAllocateMemory", allocateMemory, true),
        entry("vkFreeMemory", freeMemory, true),
        entry("vkQueueSubmit", queueSubmit, true),
        entry("vkQueueSubmit2", queueSubmit2, true),
    };
    for (const Entry& own : entries)
        if ((own.ofDevice || !ofDevice) && !std::strcmp(own.name, name)) return own.function;
    return nullptr;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) VkResult vkNegotiateLoaderLayerInterfaceVersion(
    VkNegotiateLayerInterface* negotiated) {
    negotiated->loaderLayerInterfaceVersion = 2;
    negotiated->pfnGetInstanceProcAddr = getInstanceFunction;
    negotiated->pfnGetDeviceProcAddr = getDeviceFunction;
    negotiated->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
