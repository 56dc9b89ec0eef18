// Device memory in large blocks, handed out in pieces and reused. What is large has a block of its own, kept for a while
// when it is empty.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cutis::gpu {

// device: the GPU alone; upload: the host writes; readback: the host reads (cached where there is such
// memory). Host memory is always coherent and stays mapped.
enum class MemoryUse { device, upload, readback };

struct MemoryBlock;

struct Allocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0, bytes = 0;
    std::byte* mapped = nullptr;  // host memory only
    MemoryBlock* block = nullptr;
};

class MemoryAllocator {
  public:
    MemoryAllocator(VkPhysicalDevice physical, VkDevice device);
    ~MemoryAllocator();
    MemoryAllocator(const MemoryAllocator&) = delete;
    MemoryAllocator& operator=(const MemoryAllocator&) = delete;

    // `linear`: a buffer (true) or an optimally tiled image (false); the two never share a block, which
    // satisfies bufferImageGranularity. `name` is what the memory is for. Throws Error when there is not
    // enough.
    Allocation allocate(const VkMemoryRequirements& needs, MemoryUse use, bool linear,
                        const std::string& name);
    void release(const Allocation& allocation);

    std::uint64_t bytesAllocated() const {
        return bytes_;
    }  // in live allocations, without what blocks have spare
    std::uint64_t peakBytes() const { return peak_; }
    void resetPeak() { peak_ = bytes_; }

  private:
    std::uint32_t chooseType(std::uint32_t allowedTypes, MemoryUse use) const;
    bool takesOwnBlock(std::uint32_t type, VkDeviceSize bytes) const;
    // Frees empty blocks of single allocations until they hold no more than `kept` bytes.
    void freeSpareBlocks(VkDeviceSize kept);
    MemoryBlock& addBlock(std::uint32_t type, bool linear, VkDeviceSize needed, const std::string& name);

    VkDevice device_;
    VkPhysicalDeviceMemoryProperties properties_{};
    VkDeviceSize maxAllocation_ = 0;
    std::vector<std::unique_ptr<MemoryBlock>> blocks_;
    std::uint64_t bytes_ = 0, peak_ = 0;
};

}  // namespace cutis::gpu
