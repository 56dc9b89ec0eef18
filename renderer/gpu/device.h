// The Vulkan device: chosen, checked and opened once; owns memory, samplers, programs and what commands
// record into.
#pragma once

#include <vulkan/vulkan.h>

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/gpu/program.h"

namespace cutis::gpu {

class Commands;
class MemoryAllocator;
struct CommandResources;

struct DeviceInfo {
    std::string name, driver;
    std::string type;               // "discrete", "integrated", "virtual", "cpu" or "other"
    std::uint32_t index = 0;        // in the order in which Vulkan lists devices
    std::uint64_t memoryBytes = 0;  // of its largest device-local heap
    std::string unsuitable;         // empty: cutis runs on it; else why not
};

// All Vulkan devices of this machine, suitable or not. Throws Error when there is no Vulkan at all.
std::vector<DeviceInfo> listDevices();

// The device that `select` of DeviceOptions names. Throws Error as Device does.
DeviceInfo chosenDevice(const std::string& select);

struct DeviceOptions {
    // "cpu", an index, or part of a name in any case. Empty: $CUTIS_DEVICE, else the first discrete GPU, else
    // integrated, else virtual, else cpu.
    std::string select{};
    // Also on when $CUTIS_VALIDATION is 1. Messages go to stderr as `cutis: validation: TEXT` and are
    // counted.
    bool validation = false;
    // For a window: what its library needs. With VK_KHR_surface among them, VK_KHR_swapchain is enabled too.
    std::vector<const char*> instanceExtensions{};
};

// Warnings and errors of the validation layers since the program started, over all devices.
std::uint64_t validationMessages();

struct SamplerDesc {
    VkFilter filter = VK_FILTER_LINEAR;
    VkSamplerMipmapMode mipFilter = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    VkSamplerAddressMode u = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSamplerAddressMode v = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSamplerAddressMode w = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkBorderColor border = VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK;
    VkCompareOp compare = VK_COMPARE_OP_NEVER;  // other than NEVER: a shadow sampler
    float anisotropy = 1;                       // above 1 where the device can
    // No interpolation at all: for formats that cannot be filtered, such as most devices' D32_SFLOAT.
    static SamplerDesc nearest() {
        return {.filter = VK_FILTER_NEAREST, .mipFilter = VK_SAMPLER_MIPMAP_MODE_NEAREST};
    }
    auto operator<=>(const SamplerDesc&) const = default;
};

// Not for several threads. Every object made from it must be gone before it is.
class Device {
  public:
    // Throws Error: no such device, none that suits, validation asked for and its layer not installed.
    explicit Device(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const { return info_; }
    const VkPhysicalDeviceLimits& limits() const { return limits_; }
    VkInstance instance() const { return instance_; }
    VkPhysicalDevice physical() const { return physical_; }
    VkDevice handle() const { return device_; }
    VkQueue queue() const { return queue_; }
    std::uint32_t queueFamily() const { return queueFamily_; }
    VkPipelineCache pipelineCache() const { return pipelineCache_; }

    // Starts recording. One Commands at a time. Include renderer/gpu/commands.h to use it.
    Commands begin();

    // The compute program of that embedded shader, compiled at its first use. Lives as long as the device.
    const Program& program(std::string_view shader, const Specialization& constants = {});
    // The raster program of a vertex shader and, unless only depth is written, a fragment shader.
    const Program& program(const std::vector<std::string>& shaders, const RasterState& state,
                           const Specialization& constants = {});

    VkSampler sampler(const SamplerDesc& desc = {});

    // Of live buffers and images, in bytes, and the most there has been since resetPeak.
    std::uint64_t bytesAllocated() const;
    std::uint64_t peakBytes() const;
    void resetPeak();

    // What the device can do with optimally tiled images of that format.
    VkFormatFeatureFlags formatFeatures(VkFormat format) const;
    // Names an object for validation messages and debuggers.
    void setName(VkObjectType type, std::uint64_t handle, const std::string& name) const;

    // For the other files of this folder.
    MemoryAllocator& memory() { return *memory_; }
    CommandResources& commandResources() { return *commandResources_; }
    void beginLabel(VkCommandBuffer commands, const char* name) const;
    void endLabel(VkCommandBuffer commands) const;

  private:
    void open(const DeviceOptions& options);
    void loadPipelineCache();
    void savePipelineCache() const;
    void close();

    DeviceInfo info_;
    VkPhysicalDeviceLimits limits_{};
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::uint32_t queueFamily_ = 0;
    VkPipelineCache pipelineCache_ = VK_NULL_HANDLE;
    std::uint64_t pipelineCacheKey_ = 0, pipelineCacheHash_ = 0;
    bool anisotropy_ = false;
    PFN_vkSetDebugUtilsObjectNameEXT setObjectName_ = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel_ = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT endLabel_ = nullptr;

    std::unique_ptr<MemoryAllocator> memory_;
    std::unique_ptr<CommandResources> commandResources_;
    std::map<SamplerDesc, VkSampler> samplers_;
    std::map<std::string, std::unique_ptr<Program>> programs_;
};

}  // namespace cutis::gpu
