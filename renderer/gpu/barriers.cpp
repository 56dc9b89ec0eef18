#include "renderer/gpu/barriers.h"

#include <atomic>
#include <optional>
#include <stdexcept>

namespace cutis::gpu {
namespace {

constexpr VkAccessFlags2 kWrites =
    VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;

// Numbers recordings over all devices, so that a resource can tell whether the current one has touched it.
std::uint64_t nextRecording() {
    static std::atomic<std::uint64_t> counter{0};
    return ++counter;
}

struct Dependency {
    VkPipelineStageFlags2 fromStages = 0;
    VkAccessFlags2 fromAccess = 0;
    VkPipelineStageFlags2 toStages = 0;
    VkAccessFlags2 toAccess = 0;
    VkImageLayout oldLayout = VK_IMAGE_LAYOUT_UNDEFINED, newLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    bool operator==(const Dependency&) const = default;
};

// Moves `state` past the access `next`; returns what must be waited for before it.
std::optional<Dependency> advance(AccessState& state, const Access& next) {
    const bool writes = next.access & kWrites, transition = next.layout != state.layout;
    Dependency dependency{state.writeStages, state.writeAccess, next.stages,
                          next.access,       state.layout,      next.layout};
    if (writes || transition) {
        // Earlier reads need only have finished, earlier writes must also be available.
        dependency.fromStages |= state.readStages;
        const bool needed = transition || dependency.fromStages != 0;
        // A transition writes the image, at the latest before next.stages: later accesses chain on those
        // stages.
        state = {next.layout, next.stages, next.access & kWrites, 0, 0, 0};
        if (!writes) state.visibleStages = state.readStages = next.stages, state.visibleAccess = next.access;
        if (!needed) return std::nullopt;
        return dependency;
    }
    state.readStages |= next.stages;
    const bool visible =
        (next.stages & ~state.visibleStages) == 0 && (next.access & ~state.visibleAccess) == 0;
    if (state.writeStages == 0 || visible) return std::nullopt;
    // Named again together with the new pair, so that every stage still goes with every access.
    dependency.toStages = state.visibleStages |= next.stages;
    dependency.toAccess = state.visibleAccess |= next.access;
    return dependency;
}

// Adds a use to what the same command already does with the resource.
void merge(Access& pending, const Access& access, const std::string& name) {
    if (pending.stages != 0 && pending.layout != access.layout) {
        throw std::logic_error("image \"" + name +
                               "\" is used in two ways by one command (sampled or attached and " +
                               "stored, or copied onto itself)");
    }
    pending.stages |= access.stages;
    pending.access |= access.access;
    pending.layout = access.layout;
}

// Calls body(index into states) for every mip and layer of a view.
template <class Body>
void forEachPart(const ImageView& view, const Body& body) {
    const std::uint32_t allLayers = view.object()->desc.layers;
    for (std::uint32_t mip = view.firstMip(); mip < view.firstMip() + view.mipCount(); ++mip) {
        for (std::uint32_t layer = view.firstLayer(); layer < view.firstLayer() + view.layerCount();
             ++layer) {
            body(std::size_t(mip) * allLayers + layer, mip, layer);
        }
    }
}

}  // namespace

void BarrierTracker::touch(const std::shared_ptr<void>& keepAlive, Tracked& resource) {
    if (recording_ == 0) recording_ = nextRecording();
    if (resource.recording == recording_) return;
    resource.recording = recording_;
    touched_.push_back({keepAlive, &resource, resource.states});
}

void BarrierTracker::use(const std::shared_ptr<BufferObject>& buffer, const Access& access) {
    touch(buffer, *buffer);
    uses_.push_back({buffer, {}});
    merge(buffer->pending[0], access, buffer->desc.name);
}

void BarrierTracker::use(const ImageView& image, const Access& access) {
    ImageObject& object = *image.object();
    touch(image.object(), object);
    uses_.push_back({nullptr, image});
    forEachPart(image, [&](std::size_t part, std::uint32_t, std::uint32_t) {
        if (access.needsContents && object.states[part].layout == VK_IMAGE_LAYOUT_UNDEFINED) {
            throw std::logic_error("image \"" + object.desc.name +
                                   "\" is read before anything has written it");
        }
        merge(object.pending[part], access, object.desc.name);
    });
}

void BarrierTracker::addImageBarriers(const ImageView& view) {
    ImageObject& object = *view.object();
    std::optional<Dependency> first;
    const std::size_t begin = images_.size();
    forEachPart(view, [&](std::size_t part, std::uint32_t mip, std::uint32_t layer) {
        Access& pending = object.pending[part];
        if (pending.stages == 0) return;  // handled with an earlier use by the same command
        const std::optional<Dependency> dependency = advance(object.states[part], pending);
        pending = {};
        if (!dependency) return;
        // Neighbouring layers with the same history share a barrier.
        const bool extends =
            first && *first == *dependency && images_.size() > begin &&
            images_.back().subresourceRange.baseMipLevel == mip &&
            images_.back().subresourceRange.baseArrayLayer + images_.back().subresourceRange.layerCount ==
                layer;
        first = dependency;
        if (extends) {
            ++images_.back().subresourceRange.layerCount;
            return;
        }
        VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
        barrier.srcStageMask = dependency->fromStages;
        barrier.srcAccessMask = dependency->fromAccess;
        barrier.dstStageMask = dependency->toStages;
        barrier.dstAccessMask = dependency->toAccess;
        barrier.oldLayout = dependency->oldLayout;
        barrier.newLayout = dependency->newLayout;
        barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = object.handle;
        barrier.subresourceRange = {object.format.aspect(), mip, 1, layer, 1};
        images_.push_back(barrier);
    });
}

void BarrierTracker::record(VkCommandBuffer commands) {
    for (const Use& use : uses_) {
        if (!use.buffer) {
            addImageBarriers(use.image);
            continue;
        }
        Access& pending = use.buffer->pending[0];
        if (pending.stages == 0) continue;
        if (const auto dependency = advance(use.buffer->states[0], pending)) {
            // Buffers share one memory barrier: queue families and layouts aside, it does what theirs would.
            memory_.srcStageMask |= dependency->fromStages;
            memory_.srcAccessMask |= dependency->fromAccess;
            memory_.dstStageMask |= dependency->toStages;
            memory_.dstAccessMask |= dependency->toAccess;
        }
        pending = {};
    }
    uses_.clear();
    if (memory_.dstStageMask == 0 && images_.empty()) return;
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = memory_.dstStageMask ? 1 : 0;
    info.pMemoryBarriers = &memory_;
    info.imageMemoryBarrierCount = static_cast<std::uint32_t>(images_.size());
    info.pImageMemoryBarriers = images_.data();
    vkCmdPipelineBarrier2(commands, &info);
    memory_ = {VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    images_.clear();
}

void BarrierTracker::drop() {
    for (const Use& use : uses_) {
        if (use.buffer) {
            use.buffer->pending[0] = {};
        } else {
            forEachPart(use.image, [&](std::size_t part, std::uint32_t, std::uint32_t) {
                use.image.object()->pending[part] = {};
            });
        }
    }
    uses_.clear();
}

void BarrierTracker::submitted() {
    recording_ = 0;
}

void BarrierTracker::release() {
    touched_.clear();
}

void BarrierTracker::rollBack() {
    drop();
    for (Touched& touched : touched_) touched.resource->states = std::move(touched.before);
    touched_.clear();
    recording_ = 0;
}

}  // namespace cutis::gpu
