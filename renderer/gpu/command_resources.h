// Inside gpu/: what recording needs again and again, kept by the device between one Commands and the next.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/gpu/buffer.h"

namespace cutis::gpu {

class Device;

// A piece of staging memory.
struct Staged {
    VkBuffer buffer = VK_NULL_HANDLE;
    std::uint64_t offset = 0;
    std::span<std::byte> bytes;
};

struct CommandResources {
    explicit CommandResources(Device& owner);
    ~CommandResources();
    CommandResources(const CommandResources&) = delete;
    CommandResources& operator=(const CommandResources&) = delete;

    // A set for the next command; all of them are gone after reset.
    VkDescriptorSet allocateSet(VkDescriptorSetLayout layout);
    // Up to `wanted` bytes, a multiple of `unit` (at most kStagingBlock); nothing when staging is full until
    // reset.
    std::optional<Staged> stage(std::uint64_t wanted, std::uint64_t unit);
    // Index of a new timestamp; see queryPool and kQueriesPerPool.
    std::uint32_t nextQuery(VkCommandBuffer commandBuffer);
    double queryMilliseconds(std::uint32_t from, std::uint32_t to) const;
    void writeTimestamp(VkCommandBuffer commandBuffer, std::uint32_t query) const;
    // The GPU has finished with everything.
    void reset();

    static constexpr std::uint64_t kStagingBlock = std::uint64_t(16) << 20;

    Device& device;
    bool recording = false;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    std::uint32_t queriesUsed = 0;  // reset when recording starts: timestamps outlive a flush

  private:
    static constexpr std::uint32_t kQueriesPerPool = 256;
    static constexpr std::size_t kStagingBlocks = 4;

    std::vector<VkDescriptorPool> setPools_;
    std::size_t setPool_ = 0;
    std::vector<Buffer> staging_;
    std::uint64_t stagingUsed_ = 0;  // over all blocks
    std::vector<VkQueryPool> queryPools_;
};

}  // namespace cutis::gpu
