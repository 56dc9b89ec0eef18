#include "renderer/gpu/memory.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>

#include "renderer/gpu/check.h"
#include "renderer/gpu/out_of_memory.h"

namespace cutis::gpu {

// One vkAllocateMemory with its free ranges, by offset; neighbouring free ranges are always merged.
struct MemoryBlock {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize bytes = 0;
    std::uint32_t type = 0;
    bool linear = false;
    bool own = false;  // made for one large allocation
    std::byte* mapped = nullptr;
    std::map<VkDeviceSize, VkDeviceSize> freeRanges;

    bool empty() const { return freeRanges.size() == 1 && freeRanges.begin()->second == bytes; }

    // First fit. Returns the offset, or nothing when no range is long enough.
    std::optional<VkDeviceSize> take(VkDeviceSize wanted, VkDeviceSize alignment) {
        for (auto range = freeRanges.begin(); range != freeRanges.end(); ++range) {
            const VkDeviceSize start = range->first, end = start + range->second;
            const VkDeviceSize aligned = (start + alignment - 1) / alignment * alignment;
            if (aligned + wanted > end) continue;
            freeRanges.erase(range);
            if (aligned > start) freeRanges[start] = aligned - start;
            if (aligned + wanted < end) freeRanges[aligned + wanted] = end - aligned - wanted;
            return aligned;
        }
        return std::nullopt;
    }

    void giveBack(VkDeviceSize offset, VkDeviceSize length) {
        auto next = freeRanges.lower_bound(offset);
        if (next != freeRanges.end() && next->first == offset + length) {
            length += next->second;
            next = freeRanges.erase(next);
        }
        if (next != freeRanges.begin()) {
            const auto previous = std::prev(next);
            if (previous->first + previous->second == offset) {
                previous->second += length;
                return;
            }
        }
        freeRanges[offset] = length;
    }
};

namespace {

constexpr VkDeviceSize kBlockBytes = VkDeviceSize(64) << 20;
// Large blocks that fall empty stay for the next frame, whose images are of about the same sizes: a driver
// takes tens of milliseconds for a gigabyte. At most this much, and this share of the heap.
constexpr VkDeviceSize kSpareBytes = VkDeviceSize(2) << 30, kSpareShare = 8;

std::string megabytes(VkDeviceSize bytes) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f MB", static_cast<double>(bytes) / 1e6);
    return text;
}

}  // namespace

MemoryAllocator::MemoryAllocator(VkPhysicalDevice physical, VkDevice device) : device_(device) {
    vkGetPhysicalDeviceMemoryProperties(physical, &properties_);
    VkPhysicalDeviceVulkan11Properties limits{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &limits};
    vkGetPhysicalDeviceProperties2(physical, &all);
    maxAllocation_ = limits.maxMemoryAllocationSize;
}

MemoryAllocator::~MemoryAllocator() {
    for (const auto& block : blocks_) vkFreeMemory(device_, block->memory, nullptr);
}

std::uint32_t MemoryAllocator::chooseType(std::uint32_t allowedTypes, MemoryUse use) const {
    constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    constexpr VkMemoryPropertyFlags kHost =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr VkMemoryPropertyFlags kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    const VkMemoryPropertyFlags required = use == MemoryUse::device ? 0 : kHost;
    VkMemoryPropertyFlags liked = 0;
    if (use == MemoryUse::device) liked = kLocal;
    if (use == MemoryUse::readback) liked = kCached;
    // Memory that the host can see is scarce on a discrete GPU, so it is taken only where it is asked for.
    constexpr VkMemoryPropertyFlags kVisible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
    const VkMemoryPropertyFlags disliked = use == MemoryUse::device ? kVisible : kLocal;
    int bestScore = -1;
    std::uint32_t best = 0;
    for (std::uint32_t i = 0; i < properties_.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags flags = properties_.memoryTypes[i].propertyFlags;
        if (!(allowedTypes & (1u << i)) || (flags & required) != required) continue;
        const int score = ((flags & liked) == liked ? 2 : 0) + ((flags & disliked) == 0 ? 1 : 0);
        if (score > bestScore) bestScore = score, best = i;
    }
    if (bestScore < 0) throw Error("device", "it has no memory of the kind needed");
    return best;
}

MemoryBlock& MemoryAllocator::addBlock(std::uint32_t type, bool linear, VkDeviceSize needed,
                                       const std::string& name) {
    const VkDeviceSize heap = properties_.memoryHeaps[properties_.memoryTypes[type].heapIndex].size;
    const auto fail = [&](VkResult result) {
        const std::string why = resultText(result) + ": " + megabytes(needed) + " asked for, " +
                                megabytes(bytes_) + " in use, the device has " + megabytes(heap);
        if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY) throw OutOfMemory("device", why, name);
        throw Error("device", why, name);
    };
    if (needed > std::min(heap, maxAllocation_)) fail(VK_ERROR_OUT_OF_DEVICE_MEMORY);
    auto block = std::make_unique<MemoryBlock>();
    const VkDeviceSize shared = std::min(kBlockBytes, heap / 16);
    block->own = takesOwnBlock(type, needed);
    block->bytes = block->own ? needed : shared;
    block->type = type;
    block->linear = linear;
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, block->bytes, type};
    VkResult result = vkAllocateMemory(device_, &info, nullptr, &block->memory);
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY) {
        freeSpareBlocks(0);
        result = vkAllocateMemory(device_, &info, nullptr, &block->memory);
    }
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY && block->bytes > needed) {
        info.allocationSize = block->bytes = needed;
        result = vkAllocateMemory(device_, &info, nullptr, &block->memory);
    }
    if (result != VK_SUCCESS) fail(result);
    if (properties_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) {
        void* mapped = nullptr;
        result = vkMapMemory(device_, block->memory, 0, VK_WHOLE_SIZE, 0, &mapped);
        if (result != VK_SUCCESS) {
            vkFreeMemory(device_, block->memory, nullptr);
            fail(result);
        }
        block->mapped = static_cast<std::byte*>(mapped);
    }
    block->freeRanges[0] = block->bytes;
    blocks_.push_back(std::move(block));
    return *blocks_.back();
}

Allocation MemoryAllocator::allocate(const VkMemoryRequirements& needs, MemoryUse use, bool linear,
                                     const std::string& name) {
    const std::uint32_t type = chooseType(needs.memoryTypeBits, use);
    MemoryBlock* home = nullptr;
    std::optional<VkDeviceSize> offset;
    const bool own = takesOwnBlock(type, needs.size);
    for (const auto& block : blocks_) {
        if (block->type != type || block->linear != linear || block->own != own) continue;
        // A spare block that is much too large would be missed by what it was made for.
        if (own && block->bytes > needs.size + needs.size / 2) continue;
        if ((offset = block->take(needs.size, needs.alignment))) {
            home = block.get();
            break;
        }
    }
    if (!home) {
        home = &addBlock(type, linear, needs.size, name);
        offset = home->take(needs.size, needs.alignment);
    }
    bytes_ += needs.size;
    peak_ = std::max(peak_, bytes_);
    return {home->memory, *offset, needs.size, home->mapped ? home->mapped + *offset : nullptr, home};
}

void MemoryAllocator::release(const Allocation& allocation) {
    if (!allocation.block) return;
    MemoryBlock& block = *allocation.block;
    block.giveBack(allocation.offset, allocation.bytes);
    bytes_ -= allocation.bytes;
    if (!block.empty()) return;
    if (block.own) {
        const VkDeviceSize heap = properties_.memoryHeaps[properties_.memoryTypes[block.type].heapIndex].size;
        freeSpareBlocks(std::min(kSpareBytes, heap / kSpareShare));
        return;
    }
    // One empty shared block of each kind is kept; a second one goes back.
    const bool another = std::any_of(blocks_.begin(), blocks_.end(), [&](const auto& other) {
        return other.get() != &block && !other->own && other->type == block.type &&
               other->linear == block.linear && other->empty();
    });
    if (!another) return;
    vkFreeMemory(device_, block.memory, nullptr);
    std::erase_if(blocks_, [&](const auto& other) { return other.get() == &block; });
}

// The oldest go first.
void MemoryAllocator::freeSpareBlocks(VkDeviceSize kept) {
    VkDeviceSize spare = 0;
    for (const auto& block : blocks_) spare += block->own && block->empty() ? block->bytes : 0;
    std::erase_if(blocks_, [&](const auto& block) {
        if (spare <= kept || !block->own || !block->empty()) return false;
        spare -= block->bytes;
        vkFreeMemory(device_, block->memory, nullptr);
        return true;
    });
}

bool MemoryAllocator::takesOwnBlock(std::uint32_t type, VkDeviceSize bytes) const {
    // Nothing would fit beside it for long.
    const VkDeviceSize heap = properties_.memoryHeaps[properties_.memoryTypes[type].heapIndex].size;
    return bytes > std::min(kBlockBytes, heap / 16) / 2;
}

}  // namespace cutis::gpu
