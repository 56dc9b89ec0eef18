// Images and the parts of them that commands work on.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <string>

namespace cutis::gpu {

class Device;
struct ImageObject;

struct ImageDesc {
    std::string name{};  // for messages
    VkFormat format = VK_FORMAT_UNDEFINED;
    std::uint32_t width = 0, height = 0;
    std::uint32_t layers = 1, mips = 1;
    bool cube = false;  // layers are faces, a multiple of 6, and can be sampled as samplerCube(Array)
    VkImageUsageFlags usage = 0;  // 0: sampled, copies, and storage and attachment where the format can
};

// Mip levels down to 1 × 1.
std::uint32_t fullMipCount(std::uint32_t width, std::uint32_t height);

// A range of mips and layers of an image, by value. Whether it is seen as 2-D, array or cube follows from the
// shader that it is bound to.
class ImageView {
  public:
    ImageView() = default;
    ImageView(std::shared_ptr<ImageObject> object, std::uint32_t firstMip, std::uint32_t mips,
              std::uint32_t firstLayer, std::uint32_t layers);

    // Relative to this range. Throw std::logic_error when they leave it.
    ImageView mip(std::uint32_t index) const { return range(index, 1, 0, layers_); }
    ImageView layer(std::uint32_t index) const { return range(0, mips_, index, 1); }
    ImageView layers(std::uint32_t first, std::uint32_t count) const { return range(0, mips_, first, count); }

    explicit operator bool() const { return object_ != nullptr; }
    std::uint32_t firstMip() const { return firstMip_; }
    std::uint32_t mipCount() const { return mips_; }
    std::uint32_t firstLayer() const { return firstLayer_; }
    std::uint32_t layerCount() const { return layers_; }
    std::uint32_t width() const;  // of its first mip
    std::uint32_t height() const;
    VkFormat format() const;
    const std::string& name() const;  // of the image
    // Made at first use, kept with the image.
    VkImageView handle(VkImageViewType type) const;

    const std::shared_ptr<ImageObject>& object() const { return object_; }

  private:
    ImageView range(std::uint32_t firstMip, std::uint32_t mips, std::uint32_t firstLayer,
                    std::uint32_t layers) const;

    std::shared_ptr<ImageObject> object_;
    std::uint32_t firstMip_ = 0, mips_ = 0, firstLayer_ = 0, layers_ = 0;
};

// Move-only. May be destroyed while commands that use it are recorded: they keep what is behind it.
class Image {
  public:
    Image() = default;
    // Throws Error when the device cannot have it (size, layers) or has not enough memory; std::logic_error
    // for an impossible description.
    Image(Device& device, ImageDesc desc);
    Image(Image&&) = default;
    Image& operator=(Image&&) = default;

    explicit operator bool() const { return object_ != nullptr; }
    const ImageDesc& desc() const;
    std::uint32_t width() const { return desc().width; }
    std::uint32_t height() const { return desc().height; }
    VkImage handle() const;

    ImageView view() const;  // all of it
    operator ImageView() const { return view(); }
    ImageView mip(std::uint32_t index) const { return view().mip(index); }
    ImageView layer(std::uint32_t index) const { return view().layer(index); }
    ImageView layers(std::uint32_t first, std::uint32_t count) const { return view().layers(first, count); }

  private:
    std::shared_ptr<ImageObject> object_;
};

}  // namespace cutis::gpu
