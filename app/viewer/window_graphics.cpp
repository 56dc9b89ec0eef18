#include "app/viewer/window_graphics.h"

// GLFW's Vulkan functions need Vulkan's header first.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "renderer/core/error.h"
#include "renderer/gpu/check.h"

namespace cutis::app {
namespace {

// Of the panels, which are transparent so that pictures in them lie under the interface; the view paints its
// own.
constexpr VkClearColorValue kBackground{{0.115f, 0.116f, 0.118f, 1}};
constexpr VkImageSubresourceRange kWhole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

bool canPresent(const gpu::Device& device) {
    return glfwGetPhysicalDevicePresentationSupport(device.instance(), device.physical(),
                                                    device.queueFamily()) == GLFW_TRUE;
}

// A GPU for computing alone cannot show windows, nor can any GPU on a virtual screen: the software device
// can.
std::unique_ptr<gpu::Device> openDevice(const std::string& select) {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (!names) throw Error("cannot open the viewer", "Vulkan cannot show pictures on this display");
    gpu::DeviceOptions options;
    options.instanceExtensions.assign(names, names + count);
    options.select = select;
    auto device = std::make_unique<gpu::Device>(options);
    if (canPresent(*device)) return device;
    for (const gpu::DeviceInfo& info : gpu::listDevices()) {
        if (!info.unsuitable.empty()) continue;
        options.select = std::to_string(info.index);
        device.reset();
        device = std::make_unique<gpu::Device>(options);
        if (canPresent(*device)) return device;
    }
    throw Error("cannot open the viewer", "no device can show pictures on this display");
}

void moveTo(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to) {
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    // A few transitions a frame: all commands may wait for all others.
    barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = kWhole;
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &info);
}

void copyPart(VkCommandBuffer commands, const gpu::Image& from, VkImage to, const VkExtent2D& extent,
              const PicturePart& part) {
    const int left = std::max({part.whole.x, part.clip.x, 0}), top = std::max({part.whole.y, part.clip.y, 0});
    const int right = std::min(
        {part.whole.x + part.whole.width, part.clip.x + part.clip.width, static_cast<int>(extent.width)});
    const int bottom = std::min(
        {part.whole.y + part.whole.height, part.clip.y + part.clip.height, static_cast<int>(extent.height)});
    if (right <= left || bottom <= top) return;
    const auto sourceX = [&](int x) {
        return static_cast<int>(std::lround(double(x - part.whole.x) * from.width() / part.whole.width));
    };
    const auto sourceY = [&](int y) {
        return static_cast<int>(std::lround(double(y - part.whole.y) * from.height() / part.whole.height));
    };
    VkImageBlit blit{};
    blit.srcSubresource = blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    blit.srcOffsets[0] = {sourceX(left), sourceY(top), 0};
    blit.srcOffsets[1] = {sourceX(right), sourceY(bottom), 1};
    blit.dstOffsets[0] = {left, top, 0};
    blit.dstOffsets[1] = {right, bottom, 1};
    if (blit.srcOffsets[0].x == blit.srcOffsets[1].x || blit.srcOffsets[0].y == blit.srcOffsets[1].y) return;
    vkCmdBlitImage(commands, from.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, VK_FILTER_LINEAR);
}

void checkInterface(VkResult result) {
    gpu::check(result, "drawing the interface");
}

}  // namespace

Window::Graphics::Graphics(GLFWwindow* window, const WindowOptions& options) {
    device = openDevice(options.device);
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    gpu::check(glfwCreateWindowSurface(device->instance(), window, nullptr, &surface), "opening the window");
    swapchain = std::make_unique<Swapchain>(*device, surface);
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = device->queueFamily();
    gpu::check(vkCreateCommandPool(device->handle(), &pool, nullptr, &pool_), "making a command pool");
    VkCommandBufferAllocateInfo commands{};
    commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    commands.commandPool = pool_;
    commands.commandBufferCount = 1;
    gpu::check(vkAllocateCommandBuffers(device->handle(), &commands, &commands_), "making commands");
    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    fence.flags = VK_FENCE_CREATE_SIGNALED_BIT;
    gpu::check(vkCreateFence(device->handle(), &fence, nullptr, &done_), "making a fence");
    VkSemaphoreCreateInfo semaphore{};
    semaphore.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    gpu::check(vkCreateSemaphore(device->handle(), &semaphore, nullptr, &acquired_), "making a semaphore");
}

Window::Graphics::~Graphics() {
    closeInterface();
    shown.clear();
    vkDestroySemaphore(device->handle(), acquired_, nullptr);
    vkDestroyFence(device->handle(), done_, nullptr);
    vkDestroyCommandPool(device->handle(), pool_, nullptr);
    swapchain.reset();
}

void Window::Graphics::openInterface() {
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};  // the font
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    gpu::check(vkCreateDescriptorPool(device->handle(), &pool, nullptr, &descriptors_), "making descriptors");
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = device->instance();
    info.PhysicalDevice = device->physical();
    info.Device = device->handle();
    info.QueueFamily = device->queueFamily();
    info.Queue = device->queue();
    info.PipelineCache = device->pipelineCache();
    info.DescriptorPool = descriptors_;
    info.MinImageCount = info.ImageCount = 2;  // how many frames of vertices it keeps: we draw one at a time
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    info.CheckVkResultFn = checkInterface;
    ImGui_ImplVulkan_Init(&info, swapchain->renderPass());
    interface_ = true;
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    gpu::check(vkBeginCommandBuffer(commands_, &begin), "recording");
    ImGui_ImplVulkan_CreateFontsTexture(commands_);
    gpu::check(vkEndCommandBuffer(commands_), "recording");
    submit(commands_, VK_NULL_HANDLE, VK_NULL_HANDLE);
    waitForFrame();
    ImGui_ImplVulkan_DestroyFontUploadObjects();
}

void Window::Graphics::closeInterface() {
    vkDeviceWaitIdle(device->handle());
    if (interface_) ImGui_ImplVulkan_Shutdown();
    interface_ = false;
    if (descriptors_) vkDestroyDescriptorPool(device->handle(), descriptors_, nullptr);
    descriptors_ = VK_NULL_HANDLE;
}

void Window::Graphics::waitForFrame() {
    gpu::check(vkWaitForFences(device->handle(), 1, &done_, VK_TRUE, UINT64_MAX), "drawing the window");
}

void Window::Graphics::setPicture(int number, const DisplayPicture& picture) {
    Shown& target = shown[number];
    waitForFrame();  // which may still read what is replaced
    const auto width = static_cast<std::uint32_t>(picture.width);
    const auto height = static_cast<std::uint32_t>(picture.height);
    if (!target.image || target.image.width() != width || target.image.height() != height) {
        target = {};
        target.image =
            gpu::Image(*device, {.name = "window picture",
                                 .format = VK_FORMAT_R8G8B8A8_UNORM,
                                 .width = width,
                                 .height = height,
                                 .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    }
    target.staging = gpu::Buffer(
        *device,
        {.name = "window picture upload", .bytes = picture.rgba.size(), .memory = gpu::MemoryUse::upload});
    std::memcpy(target.staging.mapped().data(), picture.rgba.data(), picture.rgba.size());
    target.uploaded = false;
}

void Window::Graphics::upload(VkCommandBuffer commands) {
    for (auto& [number, slot] : shown) {
        if (!slot.image || slot.uploaded) continue;
        moveTo(commands, slot.image.handle(), VK_IMAGE_LAYOUT_UNDEFINED,
               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        copy.imageExtent = {slot.image.width(), slot.image.height(), 1};
        vkCmdCopyBufferToImage(commands, slot.staging.handle(), slot.image.handle(),
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
        moveTo(commands, slot.image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        slot.uploaded = true;
    }
}

void Window::Graphics::record(VkCommandBuffer commands, std::span<const PicturePart> parts) {
    upload(commands);
    const VkImage target = swapchain->image();
    moveTo(commands, target, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    vkCmdClearColorImage(commands, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &kBackground, 1, &kWhole);
    for (const PicturePart& part : parts) {
        const auto found = shown.find(part.picture);
        if (found == shown.end()) continue;
        // What was put there before must be there: pictures may lie over each other.
        moveTo(commands, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        copyPart(commands, found->second.image, target, swapchain->extent(), part);
    }
    moveTo(commands, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    VkRenderPassBeginInfo pass{};
    pass.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    pass.renderPass = swapchain->renderPass();
    pass.framebuffer = swapchain->framebuffer();
    pass.renderArea = {{0, 0}, swapchain->extent()};
    vkCmdBeginRenderPass(commands, &pass, VK_SUBPASS_CONTENTS_INLINE);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
    vkCmdEndRenderPass(commands);
}

void Window::Graphics::submit(VkCommandBuffer commands, VkSemaphore wait, VkSemaphore signal) {
    gpu::check(vkResetFences(device->handle(), 1, &done_), "drawing the window");
    const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.waitSemaphoreCount = wait ? 1 : 0;
    info.pWaitSemaphores = &wait;
    info.pWaitDstStageMask = &stage;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands;
    info.signalSemaphoreCount = signal ? 1 : 0;
    info.pSignalSemaphores = &signal;
    gpu::check(vkQueueSubmit(device->queue(), 1, &info, done_), "drawing the window");
}

void Window::Graphics::draw(std::span<const PicturePart> parts) {
    waitForFrame();
    if (!swapchain->acquire(acquired_)) {
        outOfDate = true;
        return;
    }
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    gpu::check(vkBeginCommandBuffer(commands_, &begin), "drawing the window");
    record(commands_, parts);
    gpu::check(vkEndCommandBuffer(commands_), "drawing the window");
    submit(commands_, acquired_, swapchain->drawn());
    outOfDate = !swapchain->present();
}

}  // namespace cutis::app
