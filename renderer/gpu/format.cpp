#include "renderer/gpu/format.h"

#include <stdexcept>
#include <string>

namespace cutis::gpu {
namespace {

constexpr TexelKind kReal = TexelKind::real;
constexpr TexelKind kUint = TexelKind::unsignedInteger;
constexpr TexelKind kSint = TexelKind::signedInteger;

constexpr FormatInfo kFormats[] = {
    {VK_FORMAT_R8_UNORM, "r8", 1, kReal},
    {VK_FORMAT_R8G8_UNORM, "rg8", 2, kReal},
    {VK_FORMAT_R8G8B8A8_UNORM, "rgba8", 4, kReal},
    {VK_FORMAT_R8G8B8A8_SNORM, "rgba8_snorm", 4, kReal},
    {VK_FORMAT_R8G8B8A8_SRGB, "rgba8_srgb", 4, kReal},
    {VK_FORMAT_B8G8R8A8_UNORM, "bgra8", 4, kReal},
    {VK_FORMAT_B8G8R8A8_SRGB, "bgra8_srgb", 4, kReal},
    {VK_FORMAT_R8_UINT, "r8ui", 1, kUint},
    {VK_FORMAT_R8G8B8A8_UINT, "rgba8ui", 4, kUint},
    {VK_FORMAT_R16_UNORM, "r16", 2, kReal},
    {VK_FORMAT_R16G16_UNORM, "rg16", 4, kReal},
    {VK_FORMAT_R16G16B16A16_UNORM, "rgba16", 8, kReal},
    {VK_FORMAT_R16G16_SNORM, "rg16_snorm", 4, kReal},
    {VK_FORMAT_R16G16B16A16_SNORM, "rgba16_snorm", 8, kReal},
    {VK_FORMAT_R16_SFLOAT, "r16f", 2, kReal},
    {VK_FORMAT_R16G16_SFLOAT, "rg16f", 4, kReal},
    {VK_FORMAT_R16G16B16A16_SFLOAT, "rgba16f", 8, kReal},
    {VK_FORMAT_R16_UINT, "r16ui", 2, kUint},
    {VK_FORMAT_R16G16_UINT, "rg16ui", 4, kUint},
    {VK_FORMAT_R16G16B16A16_UINT, "rgba16ui", 8, kUint},
    {VK_FORMAT_R32_SFLOAT, "r32f", 4, kReal},
    {VK_FORMAT_R32G32_SFLOAT, "rg32f", 8, kReal},
    {VK_FORMAT_R32G32B32A32_SFLOAT, "rgba32f", 16, kReal},
    {VK_FORMAT_R32_UINT, "r32ui", 4, kUint},
    {VK_FORMAT_R32G32_UINT, "rg32ui", 8, kUint},
    {VK_FORMAT_R32G32B32A32_UINT, "rgba32ui", 16, kUint},
    {VK_FORMAT_R32_SINT, "r32i", 4, kSint},
    {VK_FORMAT_R32G32_SINT, "rg32i", 8, kSint},
    {VK_FORMAT_R32G32B32A32_SINT, "rgba32i", 16, kSint},
    {VK_FORMAT_A2B10G10R10_UNORM_PACK32, "rgb10_a2", 4, kReal},
    {VK_FORMAT_B10G11R11_UFLOAT_PACK32, "r11f_g11f_b10f", 4, kReal},
    {VK_FORMAT_E5B9G9R9_UFLOAT_PACK32, "rgb9_e5", 4, kReal},
    {VK_FORMAT_D16_UNORM, "d16", 2, kReal, true},
    {VK_FORMAT_D32_SFLOAT, "d32f", 4, kReal, true},
};

}  // namespace

const FormatInfo& formatInfo(VkFormat format) {
    for (const FormatInfo& info : kFormats) {
        if (info.format == format) return info;
    }
    throw std::logic_error("format " + std::to_string(static_cast<int>(format)) +
                           " is not in the format table");
}

}  // namespace cutis::gpu
