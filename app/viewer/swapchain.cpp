#include "app/viewer/swapchain.h"

#include <algorithm>
#include <cstdint>

#include "renderer/core/error.h"
#include "renderer/gpu/check.h"

namespace cutis::app {
namespace {

// Codes are written as they are: the picture and the interface are sRGB already.
VkSurfaceFormatKHR chooseFormat(VkPhysicalDevice physical, VkSurfaceKHR surface) {
    std::uint32_t count = 0;
    gpu::check(vkGetPhysicalDeviceSurfaceFormatsKHR(physical, surface, &count, nullptr), "listing formats");
    std::vector<VkSurfaceFormatKHR> formats(count);
    gpu::check(vkGetPhysicalDeviceSurfaceFormatsKHR(physical, surface, &count, formats.data()),
               "listing formats");
    for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM})
        for (const VkSurfaceFormatKHR& format : formats)
            if (format.format == wanted) return format;
    throw Error("cannot open the viewer", "the window has no 8-bit colour format");
}

}  // namespace

Swapchain::Swapchain(gpu::Device& device, VkSurfaceKHR surface) : device_(device), surface_(surface) {
    try {
        format_ = chooseFormat(device.physical(), surface);
        makeRenderPass();
    } catch (...) {
        vkDestroySurfaceKHR(device.instance(), surface, nullptr);
        throw;
    }
}

Swapchain::~Swapchain() {
    vkDeviceWaitIdle(device_.handle());
    destroyFrames();
    if (swapchain_) vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
    vkDestroyRenderPass(device_.handle(), renderPass_, nullptr);
    vkDestroySurfaceKHR(device_.instance(), surface_, nullptr);
}

void Swapchain::makeRenderPass() {
    VkAttachmentDescription color{};
    color.format = format_.format;
    color.samples = VK_SAMPLE_COUNT_1_BIT;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    color.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    color.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1;
    info.pAttachments = &color;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    gpu::check(vkCreateRenderPass(device_.handle(), &info, nullptr, &renderPass_), "making a render pass");
}

void Swapchain::resize(std::uint32_t width, std::uint32_t height) {
    vkDeviceWaitIdle(device_.handle());
    destroyFrames();
    VkSurfaceCapabilitiesKHR can;
    gpu::check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical(), surface_, &can),
               "asking what the window can show");
    // Most systems say how large the images must be; others leave it to us.
    extent_ = can.currentExtent;
    if (extent_.width == UINT32_MAX) {
        extent_.width = std::clamp(width, can.minImageExtent.width, can.maxImageExtent.width);
        extent_.height = std::clamp(height, can.minImageExtent.height, can.maxImageExtent.height);
    }
    if (extent_.width == 0 || extent_.height == 0 || width == 0 || height == 0) return;
    if (!(can.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT))
        throw Error("cannot open the viewer", "the window takes no copies of pictures");

    VkSwapchainCreateInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
    info.surface = surface_;
    info.minImageCount = std::max(can.minImageCount, 2u);
    if (can.maxImageCount) info.minImageCount = std::min(info.minImageCount, can.maxImageCount);
    info.imageFormat = format_.format;
    info.imageColorSpace = format_.colorSpace;
    info.imageExtent = extent_;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.preTransform = can.currentTransform;
    info.compositeAlpha = can.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                              ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                              : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;  // always there, and draws no faster than the screen shows
    info.clipped = VK_TRUE;
    info.oldSwapchain = swapchain_;
    VkSwapchainKHR made = VK_NULL_HANDLE;
    const VkResult result = vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &made);
    if (swapchain_) vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
    swapchain_ = made;
    gpu::check(result, "making the swapchain");
    makeFrames();
}

void Swapchain::makeFrames() {
    std::uint32_t count = 0;
    gpu::check(vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, nullptr), "listing images");
    std::vector<VkImage> images(count);
    gpu::check(vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, images.data()),
               "listing images");
    for (const VkImage image : images) {
        Frame& frame = frames_.emplace_back();
        frame.image = image;
        VkImageViewCreateInfo view{};
        view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        view.image = image;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = format_.format;
        view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        gpu::check(vkCreateImageView(device_.handle(), &view, nullptr, &frame.view), "making an image view");
        VkFramebufferCreateInfo framebuffer{};
        framebuffer.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
        framebuffer.renderPass = renderPass_;
        framebuffer.attachmentCount = 1;
        framebuffer.pAttachments = &frame.view;
        framebuffer.width = extent_.width;
        framebuffer.height = extent_.height;
        framebuffer.layers = 1;
        gpu::check(vkCreateFramebuffer(device_.handle(), &framebuffer, nullptr, &frame.framebuffer),
                   "making a framebuffer");
        VkSemaphoreCreateInfo semaphore{};
        semaphore.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
        gpu::check(vkCreateSemaphore(device_.handle(), &semaphore, nullptr, &frame.drawn),
                   "making a semaphore");
    }
}

void Swapchain::destroyFrames() {
    for (const Frame& frame : frames_) {
        vkDestroySemaphore(device_.handle(), frame.drawn, nullptr);
        vkDestroyFramebuffer(device_.handle(), frame.framebuffer, nullptr);
        vkDestroyImageView(device_.handle(), frame.view, nullptr);
    }
    frames_.clear();
}

bool Swapchain::acquire(VkSemaphore acquired) {
    const VkResult result =
        vkAcquireNextImageKHR(device_.handle(), swapchain_, UINT64_MAX, acquired, VK_NULL_HANDLE, &current_);
    if (result == VK_ERROR_OUT_OF_DATE_KHR) return false;
    // A suboptimal image is there, and its semaphore will signal: show it, resize afterwards.
    if (result != VK_SUBOPTIMAL_KHR) gpu::check(result, "taking the window's next image");
    return true;
}

bool Swapchain::present() {
    VkPresentInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &frames_[current_].drawn;
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain_;
    info.pImageIndices = &current_;
    const VkResult result = vkQueuePresentKHR(device_.queue(), &info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) return false;
    gpu::check(result, "showing the window's image");
    return true;
}

}  // namespace cutis::app
