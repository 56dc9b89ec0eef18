#include "renderer/gpu/commands.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "renderer/gpu/commands_impl.h"

namespace cutis::gpu {
namespace {

VkRenderingAttachmentInfo attachmentInfo(const Attachment& attachment, VkImageLayout layout) {
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = attachment.view.handle(VK_IMAGE_VIEW_TYPE_2D);
    info.imageLayout = layout;
    info.loadOp = attachment.clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    if (attachment.clear) info.clearValue = attachment.clear->value;
    return info;
}

// Attachments are one mip of one layer, large enough, and of the formats that the program was made for.
void checkAttachment(const Attachment& attachment, VkExtent2D extent) {
    if (!attachment.view) throw std::logic_error("a render target without image");
    if (attachment.view.mipCount() != 1 || attachment.view.layerCount() != 1) {
        throw std::logic_error("render target \"" + attachment.view.name() +
                               "\" must be one mip of one layer");
    }
    if (attachment.view.width() < extent.width || attachment.view.height() < extent.height) {
        throw std::logic_error("render target \"" + attachment.view.name() +
                               "\" is smaller than what is drawn");
    }
}

void checkFormats(const Program& program, const RenderTargets& targets) {
    const RasterState& state = program.rasterState();
    bool same = state.colorFormats.size() == targets.colors.size();
    for (std::size_t i = 0; same && i < targets.colors.size(); ++i) {
        same = state.colorFormats[i] == targets.colors[i].view.format();
    }
    const VkFormat depth = targets.depth ? targets.depth->view.format() : VK_FORMAT_UNDEFINED;
    if (!same || depth != state.depthFormat) {
        throw std::logic_error("program " + program.name() +
                               " was made for other formats than these render targets");
    }
}

}  // namespace

Groups groupsFor(const Program& program, std::uint32_t width, std::uint32_t height, std::uint32_t depth) {
    const auto& size = program.localSize();
    if (!program.isCompute())
        throw std::logic_error("program " + program.name() + " is not a compute program");
    return {(width + size[0] - 1) / size[0], (height + size[1] - 1) / size[1],
            (depth + size[2] - 1) / size[2]};
}

Commands::Commands(Device& device) : impl_(std::make_unique<Impl>(device)) {}

Commands::~Commands() = default;

void Commands::beginPass(std::string_view name) {
    impl_->requireNoRendering("beginPass");
    if (impl_->inPass) throw std::logic_error("passes do not nest: " + impl_->passes.back().name);
    const VkCommandBuffer commands = impl_->resources.commands;
    const std::uint32_t from = impl_->resources.nextQuery(commands),
                        to = impl_->resources.nextQuery(commands);
    impl_->passes.push_back({std::string(name), from, to});
    impl_->inPass = true;
    impl_->device.beginLabel(commands, impl_->passes.back().name.c_str());
    impl_->resources.writeTimestamp(commands, from);
}

void Commands::endPass() {
    impl_->requireNoRendering("endPass");
    if (!impl_->inPass) throw std::logic_error("endPass without beginPass");
    impl_->resources.writeTimestamp(impl_->resources.commands, impl_->passes.back().to);
    impl_->device.endLabel(impl_->resources.commands);
    impl_->inPass = false;
}

void Commands::dispatch(const Program& program, const Bindings& bindings, const PushData& push,
                        const Groups& groups) {
    impl_->requireNoRendering("dispatch");
    const std::uint32_t* limits = impl_->device.limits().maxComputeWorkGroupCount;
    if (groups.x > limits[0] || groups.y > limits[1] || groups.z > limits[2]) {
        throw std::logic_error("program " + program.name() +
                               " is given more workgroups than the device takes");
    }
    impl_->naming([&] { impl_->prepareDispatch(program, bindings, push); });
    vkCmdDispatch(impl_->resources.commands, groups.x, groups.y, groups.z);
    impl_->pause();
}

void Commands::dispatchIndirect(const Program& program, const Bindings& bindings, const PushData& push,
                                const Buffer& groups, std::uint64_t offset) {
    impl_->requireNoRendering("dispatchIndirect");
    constexpr std::uint64_t kBytes = sizeof(VkDispatchIndirectCommand);
    if (!groups || !groups.desc().indirect || offset % 4 != 0 || offset + kBytes > groups.bytes()) {
        throw std::logic_error("program " + program.name() + " is given no group counts at that place");
    }
    impl_->naming([&] {
        impl_->barriers.use(groups.object(),
                            {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT,
                             VK_IMAGE_LAYOUT_UNDEFINED, false});
        impl_->prepareDispatch(program, bindings, push);
    });
    vkCmdDispatchIndirect(impl_->resources.commands, groups.handle(), offset);
    impl_->pause();
}

void Commands::beginRendering(const RenderTargets& targets) {
    impl_->requireNoRendering("beginRendering");
    if (targets.colors.empty() && !targets.depth) throw std::logic_error("rendering without targets");
    const ImageView& first = targets.colors.empty() ? targets.depth->view : targets.colors[0].view;
    if (!first) throw std::logic_error("a render target without image");
    VkExtent2D extent{targets.width, targets.height};
    if (extent.width == 0) extent = {first.width(), first.height()};
    for (const Attachment& color : targets.colors) checkAttachment(color, extent);
    if (targets.depth) checkAttachment(*targets.depth, extent);
    impl_->naming([&] {
        for (const Attachment& color : targets.colors) {
            const VkAccessFlags2 load = color.clear ? 0 : VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT;
            impl_->barriers.use(color.view, {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                             VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | load,
                                             VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, !color.clear});
        }
        if (targets.depth) {
            impl_->barriers.use(
                targets.depth->view,
                {VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                 VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
                 VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, !targets.depth->clear});
        }
    });
    impl_->scope.emplace(Impl::RenderScope{targets, extent, {}});
}

void Commands::draw(const Program& program, const Bindings& bindings, const PushData& push,
                    std::span<const DrawCall> calls, const Buffer* indices) {
    impl_->requireRecording();
    if (!impl_->scope) throw std::logic_error("draw without beginRendering");
    impl_->naming([&] {
        if (program.isCompute())
            throw std::logic_error("program " + program.name() + " is a compute program");
        checkFormats(program, impl_->scope->targets);
        Impl::Draw draw;
        draw.program = &program;
        draw.set = impl_->bind(program, bindings, push);
        draw.push.assign(push.bytes.begin(), push.bytes.end());
        draw.calls.assign(calls.begin(), calls.end());
        if (indices) {
            if (!*indices || !indices->desc().index)
                throw std::logic_error("draw needs a buffer with BufferDesc::index");
            impl_->barriers.use(indices->object(),
                                {VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT,
                                 VK_IMAGE_LAYOUT_UNDEFINED, false});
            draw.indices = indices->handle();
        }
        impl_->scope->draws.push_back(std::move(draw));
    });
}

void Commands::endRendering() {
    impl_->requireRecording();
    if (!impl_->scope) throw std::logic_error("endRendering without beginRendering");
    const Impl::RenderScope scope = std::move(*impl_->scope);
    impl_->scope.reset();
    const VkCommandBuffer commands = impl_->resources.commands;
    impl_->barriers.record(commands);

    std::vector<VkRenderingAttachmentInfo> colors;
    for (const Attachment& color : scope.targets.colors) {
        colors.push_back(attachmentInfo(color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL));
    }
    VkRenderingAttachmentInfo depth{};
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = scope.extent;
    info.layerCount = 1;
    info.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
    info.pColorAttachments = colors.data();
    if (scope.targets.depth) {
        depth = attachmentInfo(*scope.targets.depth, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
        info.pDepthAttachment = &depth;
    }
    vkCmdBeginRendering(commands, &info);
    const VkViewport viewport{0, 0, float(scope.extent.width), float(scope.extent.height), 0, 1};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &info.renderArea);
    const Program* bound = nullptr;
    VkBuffer boundIndices = VK_NULL_HANDLE;
    for (const Impl::Draw& draw : scope.draws) {
        const VkPipelineLayout layout = draw.program->layout();
        if (draw.program != bound) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, draw.program->pipeline());
            bound = draw.program;
        }
        if (draw.set) {
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &draw.set, 0,
                                    nullptr);
        }
        if (draw.program->pushBytes()) {
            vkCmdPushConstants(commands, layout, draw.program->stages(), 0, draw.program->pushBytes(),
                               draw.push.data());
        }
        if (draw.indices && draw.indices != boundIndices) {
            vkCmdBindIndexBuffer(commands, draw.indices, 0, VK_INDEX_TYPE_UINT32);
            boundIndices = draw.indices;
        }
        for (const DrawCall& call : draw.calls) {
            if (draw.indices) {
                vkCmdDrawIndexed(commands, call.count, call.instances, call.first, call.vertexOffset,
                                 call.firstInstance);
            } else {
                vkCmdDraw(commands, call.count, call.instances, call.first, call.firstInstance);
            }
        }
    }
    vkCmdEndRendering(commands);
    impl_->pause();
}

void Commands::draw(const Program& program, const RenderTargets& targets, const Bindings& bindings,
                    const PushData& push, std::span<const DrawCall> calls, const Buffer* indices) {
    beginRendering(targets);
    draw(program, bindings, push, calls, indices);
    endRendering();
}

void Commands::stopWhen(StopAsked asked) {
    impl_->stopAsked = std::move(asked);
}

void Commands::submitAndWait() {
    impl_->requireNoRendering("submitAndWait");
    if (impl_->inPass) throw std::logic_error("pass " + impl_->passes.back().name + " is not ended");
    impl_->submit();
    impl_->collectTimings();
    for (const auto& readback : impl_->readbacks) readback->ready = true;
    impl_->readbacks.clear();
    impl_->finished = true;
    impl_->resources.recording = false;
}

const std::vector<PassTiming>& Commands::timings() const {
    if (!impl_->finished) throw std::logic_error("timings before submitAndWait");
    return impl_->timings;
}

VkCommandBuffer Commands::handle() const {
    return impl_->resources.commands;
}

}  // namespace cutis::gpu
