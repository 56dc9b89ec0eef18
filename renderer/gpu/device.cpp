#include "renderer/gpu/device.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/core/timeline.h"
#include "renderer/gpu/check.h"
#include "renderer/gpu/command_resources.h"
#include "renderer/gpu/commands.h"
#include "renderer/gpu/instance.h"
#include "renderer/gpu/memory.h"

namespace cutis::gpu {
namespace {

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

std::string lowercase(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

bool matches(const DeviceInfo& info, const std::string& select) {
    const bool isNumber = !select.empty() && std::all_of(select.begin(), select.end(), [](unsigned char c) {
        return std::isdigit(c) != 0;
    });
    if (isNumber) return std::to_string(info.index) == select;
    if (lowercase(select) == "cpu") return info.type == "cpu";
    return lowercase(info.name).find(lowercase(select)) != std::string::npos;
}

// Lower is preferred.
int rank(const DeviceInfo& info) {
    constexpr const char* kOrder[] = {"discrete", "integrated", "virtual", "cpu"};
    return static_cast<int>(std::find(std::begin(kOrder), std::end(kOrder), info.type) - std::begin(kOrder));
}

DeviceInfo chooseDevice(const std::vector<DeviceInfo>& devices, const std::string& asked) {
    const std::string select = asked.empty() ? environment("CUTIS_DEVICE") : asked;
    if (devices.empty()) throw Error("device", "Vulkan finds none");
    std::string names;
    const DeviceInfo* best = nullptr;
    const DeviceInfo* unsuitable = nullptr;
    for (const DeviceInfo& info : devices) {
        names += (names.empty() ? "" : "; ") + std::to_string(info.index) + " " + info.name;
        if (!matches(info, select)) continue;
        if (!info.unsuitable.empty()) {
            unsuitable = &info;
        } else if (!best || rank(info) < rank(*best)) {
            best = &info;
        }
    }
    if (best) return *best;
    if (unsuitable) throw Error("device", unsuitable->unsuitable, unsuitable->name);
    throw Error("device", "none matches \"" + select + "\" (there are: " + names + ")");
}

void appendNumber(std::string& key, std::uint32_t number) {
    key += ' ';
    key += std::to_string(number);
}

// Programs differ when their constants do.
void appendConstants(std::string& key, const Specialization& constants) {
    for (const SpecializationConstant& constant : constants) {
        appendNumber(key, constant.id);
        appendNumber(key, constant.bits);
    }
}

std::uint64_t hashOf(std::span<const std::byte> bytes) {
    return bytes.empty() ? 0 : hashBytes(bytes);
}

}  // namespace

Device::Device(const DeviceOptions& options) {
    const TimeSpan span("device");
    try {
        open(options);
        memory_ = std::make_unique<MemoryAllocator>(physical_, device_);
        loadPipelineCache();
        commandResources_ = std::make_unique<CommandResources>(*this);
    } catch (...) {
        close();
        throw;
    }
}

Device::~Device() {
    vkDeviceWaitIdle(device_);
    savePipelineCache();
    close();
}

void Device::close() {
    commandResources_.reset();
    programs_.clear();
    for (const auto& [desc, sampler] : samplers_) vkDestroySampler(device_, sampler, nullptr);
    if (pipelineCache_) vkDestroyPipelineCache(device_, pipelineCache_, nullptr);
    memory_.reset();
    if (device_) vkDestroyDevice(device_, nullptr);
    Instance instance{instance_, messenger_, false};
    destroyInstance(instance);
}

DeviceInfo chosenDevice(const std::string& select) {
    return chooseDevice(listDevices(), select);
}

void Device::open(const DeviceOptions& options) {
    const bool validation = options.validation || environment("CUTIS_VALIDATION") == "1";
    const Instance instance = createInstance(validation, options.instanceExtensions);
    instance_ = instance.handle;
    messenger_ = instance.messenger;

    const std::vector<VkPhysicalDevice> physicals = enumeratePhysicalDevices(instance_);
    std::vector<DeviceInfo> infos;
    for (std::uint32_t i = 0; i < physicals.size(); ++i) infos.push_back(describeDevice(physicals[i], i));
    info_ = chooseDevice(infos, options.select);
    physical_ = physicals[info_.index];
    queueFamily_ = static_cast<std::uint32_t>(findQueueFamily(physical_));

    Features features;
    chooseFeatures(physical_, features);
    anisotropy_ = features.base.features.samplerAnisotropy;
    const auto wants = [&](const char* name) {
        return std::any_of(options.instanceExtensions.begin(), options.instanceExtensions.end(),
                           [&](const char* extension) { return !std::strcmp(extension, name); });
    };
    std::vector<const char*> extensions;
    if (wants("VK_KHR_surface") && hasDeviceExtension(physical_, "VK_KHR_swapchain")) {
        extensions.push_back("VK_KHR_swapchain");
    }
    const float priority = 1;
    VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queueInfo.queueFamilyIndex = queueFamily_;
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features.base};
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queueInfo;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    check(vkCreateDevice(physical_, &info, nullptr, &device_), "opening " + info_.name);
    vkGetDeviceQueue(device_, queueFamily_, 0, &queue_);

    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical_, &properties);
    limits_ = properties.limits;
    const std::uint32_t identity[] = {properties.vendorID, properties.deviceID, properties.driverVersion};
    pipelineCacheKey_ = hashBytes(std::as_bytes(std::span(identity)),
                                  hashBytes(std::as_bytes(std::span(properties.pipelineCacheUUID))));
    if (instance.debugUtils) {
        const auto load = [&](const char* name) { return vkGetInstanceProcAddr(instance_, name); };
        setObjectName_ =
            reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(load("vkSetDebugUtilsObjectNameEXT"));
        beginLabel_ =
            reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(load("vkCmdBeginDebugUtilsLabelEXT"));
        endLabel_ = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(load("vkCmdEndDebugUtilsLabelEXT"));
    }
}

void Device::loadPipelineCache() {
    const std::vector<std::byte> stored = readCache("pipelines", pipelineCacheKey_);
    pipelineCacheHash_ = hashOf(stored);
    VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    info.initialDataSize = stored.size();
    info.pInitialData = stored.data();
    check(vkCreatePipelineCache(device_, &info, nullptr, &pipelineCache_), "creating the pipeline cache");
}

void Device::savePipelineCache() const {
    std::size_t size = 0;
    if (vkGetPipelineCacheData(device_, pipelineCache_, &size, nullptr) != VK_SUCCESS) return;
    std::vector<std::byte> bytes(size);
    if (vkGetPipelineCacheData(device_, pipelineCache_, &size, bytes.data()) != VK_SUCCESS) return;
    bytes.resize(size);
    // A header alone holds no pipeline (lavapipe keeps its own cache elsewhere).
    if (size <= sizeof(VkPipelineCacheHeaderVersionOne) || hashOf(bytes) == pipelineCacheHash_) return;
    writeCache("pipelines", pipelineCacheKey_, bytes);
}

Commands Device::begin() {
    return Commands(*this);
}

const Program& Device::program(std::string_view shader, const Specialization& constants) {
    std::string key(shader);
    appendConstants(key, constants);
    std::unique_ptr<Program>& slot = programs_[key];
    if (!slot) slot = std::make_unique<Program>(*this, std::vector{std::string(shader)}, nullptr, constants);
    return *slot;
}

const Program& Device::program(const std::vector<std::string>& shaders, const RasterState& s,
                               const Specialization& constants) {
    std::string key;
    for (const std::string& shader : shaders) key += shader + '+';
    for (const VkFormat format : s.colorFormats) appendNumber(key, std::uint32_t(format));
    key += ';';
    const std::uint32_t fixed[] = {std::uint32_t(s.depthFormat),
                                   s.depthTest,
                                   s.depthWrite,
                                   std::uint32_t(s.depthCompare),
                                   s.depthClamp,
                                   std::bit_cast<std::uint32_t>(s.depthBias),
                                   s.cull,
                                   std::bit_cast<std::uint32_t>(s.depthBiasSlope),
                                   std::uint32_t(s.frontFace),
                                   std::bit_cast<std::uint32_t>(s.depthBiasClamp)};
    for (const std::uint32_t number : fixed) appendNumber(key, number);
    appendConstants(key, constants);
    std::unique_ptr<Program>& slot = programs_[key];
    if (!slot) slot = std::make_unique<Program>(*this, shaders, &s, constants);
    return *slot;
}

VkSampler Device::sampler(const SamplerDesc& desc) {
    VkSampler& sampler = samplers_[desc];
    if (sampler) return sampler;
    VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    info.magFilter = info.minFilter = desc.filter;
    info.mipmapMode = desc.mipFilter;
    info.addressModeU = desc.u;
    info.addressModeV = desc.v;
    info.addressModeW = desc.w;
    info.borderColor = desc.border;
    info.compareEnable = desc.compare != VK_COMPARE_OP_NEVER;
    info.compareOp = desc.compare;
    info.anisotropyEnable = anisotropy_ && desc.anisotropy > 1;
    info.maxAnisotropy = std::min(desc.anisotropy, limits_.maxSamplerAnisotropy);
    info.maxLod = VK_LOD_CLAMP_NONE;
    check(vkCreateSampler(device_, &info, nullptr, &sampler), "creating a sampler");
    return sampler;
}

std::uint64_t Device::bytesAllocated() const {
    return memory_->bytesAllocated();
}

std::uint64_t Device::peakBytes() const {
    return memory_->peakBytes();
}

void Device::resetPeak() {
    memory_->resetPeak();
}

VkFormatFeatureFlags Device::formatFeatures(VkFormat format) const {
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(physical_, format, &properties);
    return properties.optimalTilingFeatures;
}

void Device::setName(VkObjectType type, std::uint64_t handle, const std::string& name) const {
    if (!setObjectName_) return;
    // An empty one takes the name off: the validation layers remember those of objects that are no more, for ever.
    const VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT, nullptr, type, handle,
                                             name.empty() ? nullptr : name.c_str()};
    setObjectName_(device_, &info);
}

void Device::beginLabel(VkCommandBuffer commands, const char* name) const {
    if (!beginLabel_) return;
    VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
    label.pLabelName = name;
    beginLabel_(commands, &label);
}

void Device::endLabel(VkCommandBuffer commands) const {
    if (endLabel_) endLabel_(commands);
}

}  // namespace cutis::gpu
