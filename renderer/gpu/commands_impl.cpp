#include "renderer/gpu/commands_impl.h"

#include <algorithm>
#include <stdexcept>

#include "renderer/core/error.h"
#include "renderer/gpu/check.h"

namespace cutis::gpu {
namespace {

[[noreturn]] void fail(const Program& program, std::string_view binding, const std::string& why) {
    throw std::logic_error("program " + program.name() + ": binding \"" + std::string(binding) + "\" " + why);
}

VkPipelineStageFlags2 pipelineStages(VkShaderStageFlags shaders) {
    VkPipelineStageFlags2 stages = 0;
    if (shaders & VK_SHADER_STAGE_COMPUTE_BIT) stages |= VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    if (shaders & VK_SHADER_STAGE_VERTEX_BIT) stages |= VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
    if (shaders & VK_SHADER_STAGE_FRAGMENT_BIT) stages |= VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    return stages;
}

// How a program uses what is bound there, from what its shaders declare.
Access accessOf(const BindingInfo& info) {
    const VkPipelineStageFlags2 stages = pipelineStages(info.stages);
    switch (info.type) {
        case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
            return {stages, VK_ACCESS_2_UNIFORM_READ_BIT, VK_IMAGE_LAYOUT_UNDEFINED, false};
        case VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER:
        case VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE:
            return {stages, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                    true};
        default:
            break;
    }
    VkAccessFlags2 access = 0;
    if (info.reads) access |= VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
    if (info.writes) access |= VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    const bool image = info.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    return {stages, access, image ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_UNDEFINED, !info.writes};
}

void checkBuffer(const Program& program, const BindingInfo& info, const Binding& given,
                 const Device& device) {
    if (!given.buffer) fail(program, info.name, "is a buffer, but an image or nothing is given");
    const bool uniform = info.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    const BufferDesc& desc = given.buffer->desc;
    if (uniform && !desc.uniform) fail(program, info.name, "needs a buffer with BufferDesc::uniform");
    const std::uint64_t limit =
        uniform ? device.limits().maxUniformBufferRange : device.limits().maxStorageBufferRange;
    if (desc.bytes > limit) {
        throw Error("device",
                    "buffer \"" + desc.name + "\" has " + std::to_string(desc.bytes) +
                        " bytes, shaders reach " + std::to_string(limit),
                    device.info().name);
    }
}

void checkImage(const Program& program, const BindingInfo& info, const SampledImage& given) {
    const ImageView& view = given.view;
    if (!view) fail(program, info.name, "is an image, but none is given");
    const ImageDesc& desc = view.object()->desc;
    const std::string image = "image \"" + desc.name + "\"";
    const bool storage = info.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    if (info.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER && !given.sampler) {
        fail(program, info.name, "is sampled: give " + image + " with a sampler");
    }
    if (info.type != VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER && given.sampler) {
        fail(program, info.name, "is not sampled: give " + image + " without a sampler");
    }
    const FormatInfo& format = view.object()->format;
    if (info.kind != format.kind || (info.format != VK_FORMAT_UNDEFINED && info.format != format.format)) {
        fail(program, info.name, "does not take the format " + std::string(format.name) + " of " + image);
    }
    const VkImageUsageFlags usage = storage ? VK_IMAGE_USAGE_STORAGE_BIT : VK_IMAGE_USAGE_SAMPLED_BIT;
    if (!(desc.usage & usage)) {
        fail(program, info.name,
             image + " (" + format.name + ") cannot be " + (storage ? "stored to" : "sampled"));
    }
    if (storage && view.mipCount() != 1)
        fail(program, info.name, "takes one mip, " + image + " is given with more");
    const std::uint32_t layers = view.layerCount();
    const bool fits = info.viewType == VK_IMAGE_VIEW_TYPE_2D     ? layers == 1
                      : info.viewType == VK_IMAGE_VIEW_TYPE_CUBE ? desc.cube && layers == 6
                      : info.viewType == VK_IMAGE_VIEW_TYPE_CUBE_ARRAY
                          ? desc.cube && layers % 6 == 0
                          : info.viewType == VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    if (!fits)
        fail(program, info.name, "does not fit " + image + " with " + std::to_string(layers) + " layers");
}

void checkPush(const Program& program, const PushData& push) {
    // The struct may end in padding to its alignment, which the shader's block has not.
    constexpr std::size_t kLargestAlignment = 16;
    const std::size_t given = push.bytes.size(), wanted = program.pushBytes();
    if (given < wanted || given >= wanted + kLargestAlignment || (wanted == 0 && given > 0)) {
        throw std::logic_error("program " + program.name() + " takes " + std::to_string(wanted) +
                               " bytes of push constants, " + std::to_string(given) + " are given");
    }
}

const Binding* findBinding(const Bindings& bindings, const std::string& name) {
    const auto found =
        std::find_if(bindings.begin(), bindings.end(), [&](const Binding& b) { return b.name == name; });
    return found == bindings.end() ? nullptr : &*found;
}

}  // namespace

Commands::Impl::Impl(Device& owner) : device(owner), resources(owner.commandResources()) {
    if (resources.recording) throw std::logic_error("another Commands of this device is still recording");
    resources.recording = true;
    resources.queriesUsed = 0;
    try {
        beginRecording();
    } catch (...) {
        resources.recording = false;
        throw;
    }
}

Commands::Impl::~Impl() {
    if (finished) return;
    // Also after a failed submission: nothing may still run when its resources go.
    vkQueueWaitIdle(device.queue());
    barriers.rollBack();
    try {
        resources.reset();
    } catch (const Error&) {
        // Only a lost device or an exhausted host gets here; the next call on it reports that.
    }
    resources.recording = false;
}

void Commands::Impl::requireRecording() const {
    if (finished) throw std::logic_error("commands are recorded after submitAndWait");
}

void Commands::Impl::requireNoRendering(const char* action) const {
    requireRecording();
    if (scope) throw std::logic_error(std::string(action) + " between beginRendering and endRendering");
}

VkDescriptorSet Commands::Impl::bind(const Program& program, const Bindings& bindings, const PushData& push) {
    checkPush(program, push);
    const std::vector<BindingInfo>& infos = program.bindings();
    for (const Binding& given : bindings) {
        if (std::none_of(infos.begin(), infos.end(),
                         [&](const BindingInfo& i) { return i.name == given.name; })) {
            fail(program, given.name, "does not exist");
        }
    }
    std::size_t imageCount = 0;
    for (const BindingInfo& info : infos) imageCount += info.count;
    std::vector<VkDescriptorImageInfo> images;
    std::vector<VkDescriptorBufferInfo> buffers;
    std::vector<VkWriteDescriptorSet> writes;
    images.reserve(imageCount);  // writes point into these two
    buffers.reserve(infos.size());
    const VkDescriptorSet set = infos.empty() ? VK_NULL_HANDLE : resources.allocateSet(program.setLayout());
    for (const BindingInfo& info : infos) {
        const Binding* given = findBinding(bindings, info.name);
        if (!given && !info.used) continue;
        if (!given) fail(program, info.name, "is not given");
        VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        write.dstSet = set;
        write.dstBinding = info.binding;
        write.descriptorCount = info.count;
        write.descriptorType = info.type;
        const Access access = accessOf(info);
        if (info.viewType == VK_IMAGE_VIEW_TYPE_MAX_ENUM) {
            checkBuffer(program, info, *given, device);
            barriers.use(given->buffer, access);
            buffers.push_back({given->buffer->handle, 0, VK_WHOLE_SIZE});
            write.pBufferInfo = &buffers.back();
        } else {
            if (given->images.empty()) fail(program, info.name, "is an image, but none is given");
            if (given->images.size() > info.count) {
                fail(program, info.name,
                     "has room for " + std::to_string(info.count) + " images, " +
                         std::to_string(given->images.size()) + " are given");
            }
            write.pImageInfo = images.data() + images.size();
            for (std::size_t i = 0; i < info.count; ++i) {
                const SampledImage& image = given->images[i < given->images.size() ? i : 0];
                if (i < given->images.size()) {
                    checkImage(program, info, image);
                    barriers.use(image.view, access);
                }
                images.push_back({image.sampler, image.view.handle(info.viewType), access.layout});
            }
        }
        writes.push_back(write);
    }
    vkUpdateDescriptorSets(device.handle(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                           nullptr);
    return set;
}

void Commands::Impl::prepareDispatch(const Program& program, const Bindings& bindings, const PushData& push) {
    if (!program.isCompute())
        throw std::logic_error("program " + program.name() + " is not a compute program");
    const VkDescriptorSet set = bind(program, bindings, push);
    barriers.record(resources.commands);
    vkCmdBindPipeline(resources.commands, VK_PIPELINE_BIND_POINT_COMPUTE, program.pipeline());
    if (set) {
        vkCmdBindDescriptorSets(resources.commands, VK_PIPELINE_BIND_POINT_COMPUTE, program.layout(), 0, 1,
                                &set, 0, nullptr);
    }
    if (program.pushBytes()) {
        vkCmdPushConstants(resources.commands, program.layout(), program.stages(), 0, program.pushBytes(),
                           push.bytes.data());
    }
}

void Commands::Impl::useForTransfer(const ImageView& image, bool writes) {
    barriers.use(image, {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                         writes ? VK_ACCESS_2_TRANSFER_WRITE_BIT : VK_ACCESS_2_TRANSFER_READ_BIT,
                         writes ? VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL : VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                         !writes});
}

void Commands::Impl::useForTransfer(const Buffer& buffer, bool writes) {
    if (!buffer) throw std::logic_error("a copy from or to no buffer");
    barriers.use(buffer.object(), {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                   writes ? VK_ACCESS_2_TRANSFER_WRITE_BIT : VK_ACCESS_2_TRANSFER_READ_BIT,
                                   VK_IMAGE_LAYOUT_UNDEFINED, false});
}

Staged Commands::Impl::stage(std::uint64_t wanted, std::uint64_t unit) {
    if (auto staged = resources.stage(wanted, unit)) return *staged;
    flush();
    return resources.stage(wanted, unit).value();
}

void Commands::Impl::beginRecording() {
    VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(resources.commands, &info), "recording commands");
    if (inPass) device.beginLabel(resources.commands, passes.back().name.c_str());
}

void Commands::Impl::submit() {
    if (inPass) device.endLabel(resources.commands);
    if (!readbacks.empty()) {
        VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
        barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
        barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
        barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
        VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        dependency.memoryBarrierCount = 1;
        dependency.pMemoryBarriers = &barrier;
        vkCmdPipelineBarrier2(resources.commands, &dependency);
    }
    check(vkEndCommandBuffer(resources.commands), "recording commands");
    VkCommandBufferSubmitInfo commandInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
    commandInfo.commandBuffer = resources.commands;
    VkSubmitInfo2 info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &commandInfo;
    check(vkQueueSubmit2(device.queue(), 1, &info, resources.fence), "submitting work");
    barriers.submitted();
    check(vkWaitForFences(device.handle(), 1, &resources.fence, VK_TRUE, UINT64_MAX),
          "waiting for the device");
    check(vkResetFences(device.handle(), 1, &resources.fence), "waiting for the device");
    barriers.release();
    resources.reset();
}

void Commands::Impl::flush() {
    submit();
    beginRecording();
}

void Commands::Impl::pause() {
    if (!stopAsked) return;
    flush();
    if (stopAsked()) throw Interrupted();
}

void Commands::Impl::collectTimings() {
    for (const PassRun& run : passes) {
        auto row = std::find_if(timings.begin(), timings.end(),
                                [&](const PassTiming& t) { return t.name == run.name; });
        if (row == timings.end()) row = timings.insert(timings.end(), PassTiming{run.name});
        ++row->runs;
        row->milliseconds += resources.queryMilliseconds(run.from, run.to);
    }
}

}  // namespace cutis::gpu
