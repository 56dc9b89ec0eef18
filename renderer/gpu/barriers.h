// Inside gpu/: the one place where barriers come from.
//
// A command says how it uses each buffer and image (`use`), then `record` emits what must stand before it:
// one vkCmdPipelineBarrier2 with the exact stages, accesses and layouts since the last use, or nothing.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/gpu/resources.h"

namespace cutis::gpu {

class BarrierTracker {
  public:
    // Uses of the next command. One resource may be named more than once; an image part in two layouts at
    // once, or read before anything wrote it, throws std::logic_error.
    void use(const std::shared_ptr<BufferObject>& buffer, const Access& access);
    void use(const ImageView& image, const Access& access);

    // Emits the barrier for all uses since the last call.
    void record(VkCommandBuffer commands);
    // Forgets those uses, when the command is not recorded after all.
    void drop();

    // What was recorded is on its way to the GPU: resources stay alive until the next call of release.
    void submitted();
    void release();
    // What was recorded never runs: every resource is again in the state that it had before.
    void rollBack();

  private:
    struct Touched {
        std::shared_ptr<void> keepAlive;
        Tracked* resource;
        std::vector<AccessState> before;
    };
    struct Use {
        std::shared_ptr<BufferObject> buffer;  // or
        ImageView image;
    };

    void touch(const std::shared_ptr<void>& keepAlive, Tracked& resource);
    void addImageBarriers(const ImageView& view);

    std::vector<Use> uses_;
    std::vector<Touched> touched_;
    std::uint64_t recording_ = 0;
    VkMemoryBarrier2 memory_{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    std::vector<VkImageMemoryBarrier2> images_;
};

}  // namespace cutis::gpu
