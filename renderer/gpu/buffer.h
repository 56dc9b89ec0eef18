// Buffers: owned memory that shaders and copies read and write.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "renderer/gpu/memory.h"

namespace cutis::gpu {

class Device;
struct BufferObject;

struct BufferDesc {
    std::string name;                      // for messages
    std::uint64_t bytes = 0;               // 0 makes 16, since Vulkan has no empty buffers
    bool uniform = false;                  // also usable as a uniform block
    bool index = false;                    // also usable as an index buffer (uint32)
    bool indirect = false;                 // also usable by dispatchIndirect
    MemoryUse memory = MemoryUse::device;  // upload, readback: the host sees it through mapped()
};

// Move-only. May be destroyed while commands that use it are recorded: they keep what is behind it.
class Buffer {
  public:
    Buffer() = default;
    // Throws Error when there is not enough memory.
    Buffer(Device& device, BufferDesc desc);
    Buffer(Buffer&&) = default;
    Buffer& operator=(Buffer&&) = default;

    explicit operator bool() const { return object_ != nullptr; }
    const BufferDesc& desc() const;
    std::uint64_t bytes() const { return desc().bytes; }
    VkBuffer handle() const;
    // Host memory only, else empty. Write it before the commands that read it are submitted, and not while
    // they run.
    std::span<std::byte> mapped() const;

    const std::shared_ptr<BufferObject>& object() const { return object_; }

  private:
    std::shared_ptr<BufferObject> object_;
};

}  // namespace cutis::gpu
