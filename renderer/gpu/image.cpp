#include "renderer/gpu/image.h"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

#include "renderer/core/error.h"
#include "renderer/gpu/check.h"
#include "renderer/gpu/device.h"
#include "renderer/gpu/resources.h"

namespace cutis::gpu {
namespace {

// Everything that cutis may do with an image of that format: sampling and copies, and storage and attachment
// where the device can.
VkImageUsageFlags defaultUsage(const Device& device, const FormatInfo& format) {
    const VkFormatFeatureFlags features = device.formatFeatures(format.format);
    VkImageUsageFlags usage =
        VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if (features & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) usage |= VK_IMAGE_USAGE_STORAGE_BIT;
    if (features & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT) usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (features & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) {
        usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    }
    return usage;
}

void checkDescription(const Device& device, const ImageDesc& desc) {
    const std::string what = "image \"" + desc.name + "\"";
    if (desc.width == 0 || desc.height == 0 || desc.layers == 0 || desc.mips == 0 ||
        desc.mips > fullMipCount(desc.width, desc.height) ||
        (desc.cube && (desc.layers % 6 != 0 || desc.width != desc.height))) {
        throw std::logic_error(what + " has an impossible size");
    }
    const VkPhysicalDeviceLimits& limits = device.limits();
    const std::uint32_t largest = desc.cube ? limits.maxImageDimensionCube : limits.maxImageDimension2D;
    if (std::max(desc.width, desc.height) > largest || desc.layers > limits.maxImageArrayLayers) {
        throw Error("device",
                    what + " would be " + std::to_string(desc.width) + "x" + std::to_string(desc.height) +
                        " with " + std::to_string(desc.layers) + " layers, the limits are " +
                        std::to_string(largest) + " and " + std::to_string(limits.maxImageArrayLayers) +
                        " layers",
                    device.info().name);
    }
}

std::uint64_t bytesOf(const ImageDesc& desc, const FormatInfo& format) {
    std::uint64_t texels = 0;
    for (std::uint32_t mip = 0; mip < desc.mips; ++mip) {
        texels += std::uint64_t(std::max(1u, desc.width >> mip)) * std::max(1u, desc.height >> mip);
    }
    return texels * desc.layers * format.bytesPerTexel;
}

void checkFormat(const Device& device, const VkImageCreateInfo& info, std::uint64_t bytes,
                 const std::string& what) {
    VkImageFormatProperties properties;
    check(vkGetPhysicalDeviceImageFormatProperties(device.physical(), info.format, info.imageType,
                                                   info.tiling, info.usage, info.flags, &properties),
          what);
    if (bytes > properties.maxResourceSize) {
        throw Error("device",
                    what + " would take " + std::to_string(bytes / 1'000'000) + " MB, the limit is " +
                        std::to_string(properties.maxResourceSize / 1'000'000) + " MB",
                    device.info().name);
    }
}

}  // namespace

std::uint32_t fullMipCount(std::uint32_t width, std::uint32_t height) {
    return static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
}

ImageObject::ImageObject(Device& owner, ImageDesc description)
    : device(owner), desc(std::move(description)), format(formatInfo(desc.format)) {
    checkDescription(device, desc);
    if (desc.usage == 0) desc.usage = defaultUsage(device, format);
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.flags = desc.cube ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = desc.format;
    info.extent = {desc.width, desc.height, 1};
    info.mipLevels = desc.mips;
    info.arrayLayers = desc.layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = desc.usage;
    const std::string what = "image \"" + desc.name + "\"";
    checkFormat(device, info, bytesOf(desc, format), what);
    check(vkCreateImage(device.handle(), &info, nullptr, &handle), what);
    try {
        VkMemoryRequirements needs;
        vkGetImageMemoryRequirements(device.handle(), handle, &needs);
        memory = device.memory().allocate(needs, MemoryUse::device, false, what);
        check(vkBindImageMemory(device.handle(), handle, memory.memory, memory.offset), what);
    } catch (...) {
        device.memory().release(memory);
        vkDestroyImage(device.handle(), handle, nullptr);
        throw;
    }
    device.setName(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(handle), desc.name);
    states.resize(std::size_t(desc.mips) * desc.layers);
    pending.resize(states.size());
}

ImageObject::~ImageObject() {
    for (const auto& [key, view] : views) {
        device.setName(VK_OBJECT_TYPE_IMAGE_VIEW, reinterpret_cast<std::uint64_t>(view), {});
        vkDestroyImageView(device.handle(), view, nullptr);
    }
    device.setName(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(handle), {});
    vkDestroyImage(device.handle(), handle, nullptr);
    device.memory().release(memory);
}

Image::Image(Device& device, ImageDesc desc)
    : object_(std::make_shared<ImageObject>(device, std::move(desc))) {}

const ImageDesc& Image::desc() const {
    return object_->desc;
}

VkImage Image::handle() const {
    return object_->handle;
}

ImageView Image::view() const {
    if (!object_) return {};
    return {object_, 0, object_->desc.mips, 0, object_->desc.layers};
}

ImageView::ImageView(std::shared_ptr<ImageObject> object, std::uint32_t firstMip, std::uint32_t mips,
                     std::uint32_t firstLayer, std::uint32_t layers)
    : object_(std::move(object)),
      firstMip_(firstMip),
      mips_(mips),
      firstLayer_(firstLayer),
      layers_(layers) {}

ImageView ImageView::range(std::uint32_t firstMip, std::uint32_t mips, std::uint32_t firstLayer,
                           std::uint32_t layers) const {
    if (!object_) throw std::logic_error("a part of no image");
    if (mips == 0 || layers == 0 || firstMip + mips > mips_ || firstLayer + layers > layers_) {
        throw std::logic_error("image \"" + name() + "\" has no such mip or layer");
    }
    return {object_, firstMip_ + firstMip, mips, firstLayer_ + firstLayer, layers};
}

std::uint32_t ImageView::width() const {
    return std::max(1u, object_->desc.width >> firstMip_);
}

std::uint32_t ImageView::height() const {
    return std::max(1u, object_->desc.height >> firstMip_);
}

VkFormat ImageView::format() const {
    return object_->desc.format;
}

const std::string& ImageView::name() const {
    return object_->desc.name;
}

VkImageView ImageView::handle(VkImageViewType type) const {
    const std::uint64_t key = std::uint64_t(firstMip_) | std::uint64_t(mips_) << 8 |
                              std::uint64_t(firstLayer_) << 16 | std::uint64_t(layers_) << 32 |
                              std::uint64_t(type) << 48;
    VkImageView& view = object_->views[key];
    if (view) return view;
    VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.image = object_->handle;
    info.viewType = type;
    info.format = object_->desc.format;
    info.subresourceRange = {object_->format.aspect(), firstMip_, mips_, firstLayer_, layers_};
    check(vkCreateImageView(object_->device.handle(), &info, nullptr, &view),
          "a view of image \"" + name() + "\"");
    object_->device.setName(VK_OBJECT_TYPE_IMAGE_VIEW, reinterpret_cast<std::uint64_t>(view), name());
    return view;
}

}  // namespace cutis::gpu
