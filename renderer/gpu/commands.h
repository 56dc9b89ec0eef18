// Work for the GPU, recorded in order and run at once. Barriers follow from what each shader declares
// (readonly, writeonly, sampled, attached): nobody writes them by hand, so declare what is true.
//
//     gpu::Device device;
//     gpu::Image source(device, {.name = "source", .format = VK_FORMAT_R16G16B16A16_SFLOAT, .width = w,
//     .height = h}); gpu::Image target(device, {.name = "target", .format = VK_FORMAT_R16G16B16A16_SFLOAT,
//     .width = w, .height = h}); const gpu::Program& blur = device.program("blur.comp");
//
//     gpu::Commands commands = device.begin();
//     commands.upload(source, texels);
//     commands.beginPass("diffusion");
//     commands.dispatch(blur, {{"source", gpu::sampled(source, device.sampler())}, {"target", target}},
//                       BlurPush{...}, gpu::groupsFor(blur, w, h));
//     commands.endPass();
//     gpu::Readback result = commands.readback(target);
//     commands.submitAndWait();
//     result.bytes();        // tightly packed rows
//     commands.timings();    // {"diffusion", 1, 0.37}
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/interrupted.h"
#include "renderer/gpu/binding.h"
#include "renderer/gpu/buffer.h"
#include "renderer/gpu/device.h"
#include "renderer/gpu/image.h"
#include "renderer/gpu/program.h"

namespace cutis::gpu {

// All passes of one name. `milliseconds` is GPU time from the first command's start to the last one's end.
struct PassTiming {
    std::string name;
    int runs = 0;
    double milliseconds = 0;
};

// What a readback will have brought once its commands have run.
class Readback {
  public:
    // Throws std::logic_error before submitAndWait.
    std::span<const std::byte> bytes() const;
    template <class T>
    std::vector<T> as() const {
        const std::span<const std::byte> raw = bytes();
        std::vector<T> values(raw.size() / sizeof(T));
        std::memcpy(values.data(), raw.data(), values.size() * sizeof(T));
        return values;
    }

  private:
    friend class Commands;
    struct State;
    std::shared_ptr<State> state_;
};

// Workgroups that cover so many invocations.
Groups groupsFor(const Program& program, std::uint32_t width, std::uint32_t height = 1,
                 std::uint32_t depth = 1);

// Recording throws std::logic_error for programming errors (a binding missing or unknown, of the wrong kind
// or format, sizes that do not fit) and Error when the device fails or runs out of memory. Commands that are
// destroyed before submitAndWait never run, apart from large uploads, and leave resources as they were.
class Commands {
  public:
    explicit Commands(Device& device);
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    // Names what follows for timings() and debuggers. Passes of one name add up; they do not nest.
    void beginPass(std::string_view name);
    void endPass();

    // Bindings: every one that the program uses, and no other. A storage image or attachment takes one mip; a
    // sampled image takes the range of the view.
    void dispatch(const Program& program, const Bindings& bindings, const PushData& push,
                  const Groups& groups);
    // Three uint32 group counts at `offset` of `groups` (BufferDesc::indirect).
    void dispatchIndirect(const Program& program, const Bindings& bindings, const PushData& push,
                          const Buffer& groups, std::uint64_t offset = 0);

    // Draws into the same targets: the draws between begin and end are seen as one command, so one of them
    // may not read what another writes through storage.
    void beginRendering(const RenderTargets& targets);
    void draw(const Program& program, const Bindings& bindings, const PushData& push,
              std::span<const DrawCall> calls, const Buffer* indices = nullptr);
    void endRendering();
    // All three in one.
    void draw(const Program& program, const RenderTargets& targets, const Bindings& bindings,
              const PushData& push, std::span<const DrawCall> calls, const Buffer* indices = nullptr);

    void clear(const ImageView& image, const ClearValue& value = {});
    void fill(const Buffer& buffer, std::uint32_t value = 0);

    // Copies to the GPU. The bytes are taken at once. Images: one mip (the view's first), all its layers,
    // tightly packed. Uploads beyond the staging memory submit what was recorded so far and wait for it.
    void upload(const Buffer& buffer, std::span<const std::byte> bytes, std::uint64_t offset = 0);
    void upload(const ImageView& image, std::span<const std::byte> bytes);
    template <class T>
    void upload(const Buffer& buffer, const std::vector<T>& values, std::uint64_t offset = 0) {
        upload(buffer, std::as_bytes(std::span(values)), offset);
    }
    template <class T>
    void upload(const ImageView& image, const std::vector<T>& values) {
        upload(image, std::as_bytes(std::span(values)));
    }
    // Fills mips 1 and up of all layers from mip 0 by repeated 2 × 2 averages (in linear light for sRGB
    // formats).
    void generateMips(const Image& image);

    void copy(const Buffer& from, const Buffer& to, std::uint64_t bytes, std::uint64_t fromOffset = 0,
              std::uint64_t toOffset = 0);
    void copy(const ImageView& from, const ImageView& to);  // same sizes, mips, layers and bytes per texel

    // Copies to the host. Images: one mip (the view's first), all its layers, tightly packed.
    Readback readback(const Buffer& buffer);
    Readback readback(const ImageView& image);

    // From now on each dispatch and each set of draws is run and waited for by itself, and `asked` is called after it: where
    // it says true, recording throws Interrupted. What was recorded until then has run.
    void stopWhen(StopAsked asked);

    // Runs everything and waits. Nothing can be recorded afterwards.
    void submitAndWait();

    // After submitAndWait, in the order of each name's first pass.
    const std::vector<PassTiming>& timings() const;

    // The command buffer, for code that records by itself (a user interface). It changes with large uploads.
    VkCommandBuffer handle() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace cutis::gpu
