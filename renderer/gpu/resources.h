// Inside gpu/: what stands behind Buffer and Image, with the last accesses that barriers are computed from.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "renderer/gpu/buffer.h"
#include "renderer/gpu/format.h"
#include "renderer/gpu/image.h"

namespace cutis::gpu {

// How a command uses a resource. `layout` matters for images only.
struct Access {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    bool needsContents = false;  // it reads what was there before
};

// The last accesses to a buffer or to one mip of one layer of an image.
struct AccessState {
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkPipelineStageFlags2 writeStages = 0;  // of the last write or layout transition
    VkAccessFlags2 writeAccess = 0;
    VkPipelineStageFlags2 visibleStages = 0;  // to which that write has been made visible,
    VkAccessFlags2 visibleAccess = 0;         // for every pair of a stage and an access in these two
    VkPipelineStageFlags2 readStages = 0;     // since that write
};

struct Tracked {
    std::vector<AccessState> states;
    std::vector<Access> pending;  // per state: uses by the command that is being recorded
    std::uint64_t recording = 0;  // the last recording that touched it
};

struct BufferObject : Tracked {
    BufferObject(Device& owner, BufferDesc description);
    ~BufferObject();
    BufferObject(const BufferObject&) = delete;
    BufferObject& operator=(const BufferObject&) = delete;

    Device& device;
    BufferDesc desc;
    VkBuffer handle = VK_NULL_HANDLE;
    Allocation memory;
};

struct ImageObject : Tracked {  // states: mip-major, [mip · layers + layer]
    ImageObject(Device& owner, ImageDesc description);
    ~ImageObject();
    ImageObject(const ImageObject&) = delete;
    ImageObject& operator=(const ImageObject&) = delete;

    Device& device;
    ImageDesc desc;
    const FormatInfo& format;
    VkImage handle = VK_NULL_HANDLE;
    Allocation memory;
    std::unordered_map<std::uint64_t, VkImageView> views;
};

}  // namespace cutis::gpu
