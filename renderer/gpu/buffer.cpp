#include "renderer/gpu/buffer.h"

#include <utility>

#include "renderer/gpu/check.h"
#include "renderer/gpu/device.h"
#include "renderer/gpu/resources.h"

namespace cutis::gpu {

BufferObject::BufferObject(Device& owner, BufferDesc description)
    : device(owner), desc(std::move(description)) {
    constexpr std::uint64_t kSmallest = 16;
    if (desc.bytes == 0) desc.bytes = kSmallest;
    // vkCmdFillBuffer and copies of words want multiples of 4.
    desc.bytes = (desc.bytes + 3) / 4 * 4;
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = desc.bytes;
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                 VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (desc.uniform) info.usage |= VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    if (desc.index) info.usage |= VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
    if (desc.indirect) info.usage |= VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    const std::string what = "buffer \"" + desc.name + "\"";
    check(vkCreateBuffer(device.handle(), &info, nullptr, &handle), what);
    try {
        VkMemoryRequirements needs;
        vkGetBufferMemoryRequirements(device.handle(), handle, &needs);
        memory = device.memory().allocate(needs, desc.memory, true, what);
        check(vkBindBufferMemory(device.handle(), handle, memory.memory, memory.offset), what);
    } catch (...) {
        device.memory().release(memory);
        vkDestroyBuffer(device.handle(), handle, nullptr);
        throw;
    }
    device.setName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(handle), desc.name);
    states.resize(1);
    pending.resize(1);
}

BufferObject::~BufferObject() {
    device.setName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(handle), {});
    vkDestroyBuffer(device.handle(), handle, nullptr);
    device.memory().release(memory);
}

Buffer::Buffer(Device& device, BufferDesc desc)
    : object_(std::make_shared<BufferObject>(device, std::move(desc))) {}

const BufferDesc& Buffer::desc() const {
    return object_->desc;
}

VkBuffer Buffer::handle() const {
    return object_->handle;
}

std::span<std::byte> Buffer::mapped() const {
    if (object_->desc.memory == MemoryUse::device) return {};
    return {object_->memory.mapped, object_->desc.bytes};
}

}  // namespace cutis::gpu
