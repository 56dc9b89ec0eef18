#include "renderer/gpu/command_resources.h"

#include <algorithm>

#include "renderer/core/error.h"
#include "renderer/gpu/check.h"
#include "renderer/gpu/device.h"

namespace cutis::gpu {
namespace {

VkDescriptorPool createSetPool(VkDevice device) {
    constexpr std::uint32_t kSets = 256;
    constexpr VkDescriptorPoolSize kSizes[] = {
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4096}, {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 2048},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 4096},         {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 512},
        {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 512},           {VK_DESCRIPTOR_TYPE_SAMPLER, 64}};
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = kSets;
    info.poolSizeCount = std::size(kSizes);
    info.pPoolSizes = kSizes;
    VkDescriptorPool pool;
    check(vkCreateDescriptorPool(device, &info, nullptr, &pool), "creating a descriptor pool");
    return pool;
}

}  // namespace

CommandResources::CommandResources(Device& owner) : device(owner) {
    VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    poolInfo.queueFamilyIndex = device.queueFamily();
    check(vkCreateCommandPool(device.handle(), &poolInfo, nullptr, &pool), "creating a command pool");
    VkCommandBufferAllocateInfo commandInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool,
                                            VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    check(vkAllocateCommandBuffers(device.handle(), &commandInfo, &commands), "creating a command buffer");
    const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    check(vkCreateFence(device.handle(), &fenceInfo, nullptr, &fence), "creating a fence");
}

CommandResources::~CommandResources() {
    for (const VkQueryPool queries : queryPools_) vkDestroyQueryPool(device.handle(), queries, nullptr);
    for (const VkDescriptorPool sets : setPools_) vkDestroyDescriptorPool(device.handle(), sets, nullptr);
    vkDestroyFence(device.handle(), fence, nullptr);
    vkDestroyCommandPool(device.handle(), pool, nullptr);
}

VkDescriptorSet CommandResources::allocateSet(VkDescriptorSetLayout layout) {
    VkDescriptorSet set = VK_NULL_HANDLE;
    for (;;) {
        const bool fresh = setPool_ == setPools_.size();
        if (fresh) setPools_.push_back(createSetPool(device.handle()));
        const VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr,
                                               setPools_[setPool_], 1, &layout};
        const VkResult result = vkAllocateDescriptorSets(device.handle(), &info, &set);
        if (result == VK_SUCCESS) return set;
        const bool full = result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL;
        if (fresh || !full) check(result, "allocating a descriptor set");
        ++setPool_;
    }
}

std::optional<Staged> CommandResources::stage(std::uint64_t wanted, std::uint64_t unit) {
    // Offsets of copies must be multiples of the texel size: 16 covers all formats.
    constexpr std::uint64_t kAlignment = 16;
    stagingUsed_ = (stagingUsed_ + kAlignment - 1) / kAlignment * kAlignment;
    std::uint64_t left = kStagingBlock - stagingUsed_ % kStagingBlock;
    if (left < unit) {
        stagingUsed_ += left;
        left = kStagingBlock;
    }
    const std::size_t block = stagingUsed_ / kStagingBlock;
    if (block == kStagingBlocks) return std::nullopt;
    if (block == staging_.size()) {
        staging_.emplace_back(
            device, BufferDesc{.name = "staging", .bytes = kStagingBlock, .memory = MemoryUse::upload});
    }
    const std::uint64_t bytes = std::min(wanted, left / unit * unit), offset = stagingUsed_ % kStagingBlock;
    stagingUsed_ += bytes;
    return Staged{staging_[block].handle(), offset, staging_[block].mapped().subspan(offset, bytes)};
}

std::uint32_t CommandResources::nextQuery(VkCommandBuffer commandBuffer) {
    if (queriesUsed == queryPools_.size() * kQueriesPerPool) {
        VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
        info.queryType = VK_QUERY_TYPE_TIMESTAMP;
        info.queryCount = kQueriesPerPool;
        VkQueryPool queries;
        check(vkCreateQueryPool(device.handle(), &info, nullptr, &queries), "creating a query pool");
        queryPools_.push_back(queries);
    }
    const std::uint32_t query = queriesUsed++;
    vkCmdResetQueryPool(commandBuffer, queryPools_[query / kQueriesPerPool], query % kQueriesPerPool, 1);
    return query;
}

void CommandResources::writeTimestamp(VkCommandBuffer commandBuffer, std::uint32_t query) const {
    vkCmdWriteTimestamp2(commandBuffer, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                         queryPools_[query / kQueriesPerPool], query % kQueriesPerPool);
}

double CommandResources::queryMilliseconds(std::uint32_t from, std::uint32_t to) const {
    const auto ticks = [&](std::uint32_t query) {
        std::uint64_t value = 0;
        check(vkGetQueryPoolResults(device.handle(), queryPools_[query / kQueriesPerPool],
                                    query % kQueriesPerPool, 1, sizeof value, &value, sizeof value,
                                    VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
              "reading timestamps");
        return value;
    };
    const std::uint64_t begin = ticks(from), end = ticks(to);
    return end > begin ? static_cast<double>(end - begin) * device.limits().timestampPeriod * 1e-6 : 0;
}

void CommandResources::reset() {
    check(vkResetCommandPool(device.handle(), pool, 0), "resetting commands");
    for (const VkDescriptorPool sets : setPools_) vkResetDescriptorPool(device.handle(), sets, 0);
    setPool_ = 0;
    stagingUsed_ = 0;
}

}  // namespace cutis::gpu
