// What the layer needs to know of the formats that cutis uses.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>

namespace cutis::gpu {

// How a shader sees a texel: `sampler2D`/`image2D`, `usampler2D`/`uimage2D` or `isampler2D`/`iimage2D`.
enum class TexelKind { real, unsignedInteger, signedInteger };

struct FormatInfo {
    VkFormat format = VK_FORMAT_UNDEFINED;
    const char* name = "";
    std::uint32_t bytesPerTexel = 0;
    TexelKind kind = TexelKind::real;
    bool depth = false;

    VkImageAspectFlags aspect() const {
        return depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    }
};

// Throws std::logic_error for a format that is not in the table.
const FormatInfo& formatInfo(VkFormat format);

}  // namespace cutis::gpu
