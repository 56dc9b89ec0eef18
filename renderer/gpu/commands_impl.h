// Inside gpu/: the state of Commands while it records.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/gpu/barriers.h"
#include "renderer/gpu/command_resources.h"
#include "renderer/gpu/commands.h"

namespace cutis::gpu {

struct Readback::State {
    Buffer buffer;
    std::uint64_t bytes = 0;
    bool ready = false;
};

struct Commands::Impl {
    explicit Impl(Device& owner);
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    // Draws wait here until the scope ends: what they read must be made ready before rendering begins.
    struct Draw {
        const Program* program = nullptr;
        VkDescriptorSet set = VK_NULL_HANDLE;
        std::vector<std::byte> push;
        std::vector<DrawCall> calls;
        VkBuffer indices = VK_NULL_HANDLE;
    };
    struct RenderScope {
        RenderTargets targets;
        VkExtent2D extent{};
        std::vector<Draw> draws;
    };
    struct PassRun {
        std::string name;
        std::uint32_t from = 0, to = 0;  // queries
    };

    void requireRecording() const;
    void requireNoRendering(const char* action) const;

    // Checks bindings and push constants against the program, tells the barrier tracker, and returns a set
    // that holds them.
    VkDescriptorSet bind(const Program& program, const Bindings& bindings, const PushData& push);
    // Records barriers, pipeline, set and push constants of a compute program.
    void prepareDispatch(const Program& program, const Bindings& bindings, const PushData& push);

    // Runs `body`, which names uses; on an exception none of them stays.
    template <class Body>
    auto naming(const Body& body) {
        try {
            return body();
        } catch (...) {
            barriers.drop();
            scope.reset();
            throw;
        }
    }
    void useForTransfer(const ImageView& image, bool writes);
    void useForTransfer(const Buffer& buffer, bool writes);

    // A piece of staging memory of up to `wanted` bytes, in multiples of `unit`; makes room when there is
    // none.
    Staged stage(std::uint64_t wanted, std::uint64_t unit);
    void beginRecording();
    void submit();
    void flush();
    // Where somebody may ask to stop: runs what was recorded, and asks.
    void pause();
    void collectTimings();

    Device& device;
    CommandResources& resources;
    BarrierTracker barriers;
    bool finished = false;
    StopAsked stopAsked;  // empty: nobody asks
    std::optional<RenderScope> scope;
    bool inPass = false;
    std::vector<PassRun> passes;
    std::vector<PassTiming> timings;
    std::vector<std::shared_ptr<Readback::State>> readbacks;
};

}  // namespace cutis::gpu
