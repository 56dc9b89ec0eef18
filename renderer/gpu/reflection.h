// What a SPIR-V module says about its interface: bindings by name, push constants, local size.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderer/gpu/format.h"

namespace cutis::gpu {

struct BindingInfo {
    std::string name;  // the variable's; of a block without instance name, the block's
    std::uint32_t binding = 0;
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_MAX_ENUM;
    std::uint32_t count = 1;            // array length
    VkShaderStageFlags stages = 0;      // that use it
    bool used = false;                  // by any instruction; one that is not used need not be bound
    bool reads = true, writes = false;  // what a storage image or buffer allows (readonly, writeonly)
    // Images only:
    VkImageViewType viewType = VK_IMAGE_VIEW_TYPE_MAX_ENUM;
    VkFormat format = VK_FORMAT_UNDEFINED;  // of a storage image; undefined: any
    TexelKind kind = TexelKind::real;
};

struct ShaderReflection {
    std::string name;
    VkShaderStageFlagBits stage = VK_SHADER_STAGE_COMPUTE_BIT;
    std::vector<BindingInfo> bindings;
    std::uint32_t pushBytes = 0;
    std::array<std::uint32_t, 3> localSize{};              // compute; before specialization
    std::array<std::int64_t, 3> localSizeIds{-1, -1, -1};  // the constant that sets it, or -1
    std::vector<std::uint32_t> constantIds;                // specialization constants
};

// Reads a module that glslang compiled with its names. Throws std::logic_error for what the layer does not
// support (descriptor sets other than 0, texel buffers, 1-D images) or a damaged module.
ShaderReflection reflect(std::span<const std::uint32_t> words, const std::string& name);

}  // namespace cutis::gpu
