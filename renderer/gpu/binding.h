// What a command is given: resources by the names that the shader uses, push constants, render targets.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "renderer/gpu/buffer.h"
#include "renderer/gpu/image.h"

namespace cutis::gpu {

// An image with the way to sample it (Device::sampler).
struct SampledImage {
    ImageView view{};
    VkSampler sampler = VK_NULL_HANDLE;
};
inline SampledImage sampled(ImageView view, VkSampler sampler) {
    return {std::move(view), sampler};
}

// One resource, or an array of sampled images, under the name that it has in the shader. An array shorter
// than the shader's repeats its first element; an empty one is an error.
class Binding {
  public:
    Binding(std::string_view shaderName, const Buffer& given) : name(shaderName), buffer(given.object()) {}
    Binding(std::string_view shaderName, ImageView view) : name(shaderName) {
        images.push_back({std::move(view)});
    }
    Binding(std::string_view shaderName, const Image& image) : Binding(shaderName, image.view()) {}
    Binding(std::string_view shaderName, SampledImage image) : name(shaderName) {
        images.push_back(std::move(image));
    }
    Binding(std::string_view shaderName, std::span<const SampledImage> array)
        : name(shaderName), images(array.begin(), array.end()) {}
    Binding(std::string_view shaderName, const std::vector<SampledImage>& array)
        : Binding(shaderName, std::span(array)) {}

    std::string_view name;
    std::shared_ptr<BufferObject> buffer;  // or
    std::vector<SampledImage> images;
};
using Bindings = std::vector<Binding>;  // `{{"source", image}, {"lights", buffer}}`

// The bytes of any trivially copyable struct; `{}` for none. Its size must be the push constant block's (a
// struct of shaders/shared in a block with layout(scalar)).
struct PushData {
    std::span<const std::byte> bytes;
    PushData() = default;
    template <class T>
    requires(std::is_trivially_copyable_v<T> && !std::is_same_v<T, PushData>) PushData(const T& value)
        : bytes(std::as_bytes(std::span(&value, 1))) {}
};

struct Groups {
    std::uint32_t x = 1, y = 1, z = 1;
};

// A clear value for any format: floats for real texels, the integers as they are, depth.
struct ClearValue {
    VkClearValue value{};
    ClearValue() = default;  // zero
    ClearValue(float r, float g, float b, float a) { value.color = {.float32 = {r, g, b, a}}; }
    static ClearValue depth(float d) { return ClearValue(d, 0, 0, 0); }
    static ClearValue integers(std::uint32_t r, std::uint32_t g = 0, std::uint32_t b = 0,
                               std::uint32_t a = 0) {
        ClearValue result;
        result.value.color = {.uint32 = {r, g, b, a}};
        return result;
    }
};

// One mip of an image that is drawn into; without `clear`, onto what is there.
struct Attachment {
    ImageView view{};
    std::optional<ClearValue> clear{};
};

struct RenderTargets {
    std::vector<Attachment> colors{};
    std::optional<Attachment> depth{};
    std::uint32_t width = 0, height = 0;  // 0: the first attachment's size
};

struct DrawCall {
    std::uint32_t first = 0;  // index with an index buffer, else vertex
    std::uint32_t count = 0;  // of indices or vertices
    std::int32_t vertexOffset = 0;
    std::uint32_t firstInstance = 0, instances = 1;
};

}  // namespace cutis::gpu
