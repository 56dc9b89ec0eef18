// The images that a window shows in turn, with what drawing into them needs.
#pragma once

#include <vulkan/vulkan.h>

#include <vector>

#include "renderer/gpu/device.h"

namespace cutis::app {

// Made for one size of the window: call resize whenever that changes, or Vulkan says that it is out of date.
class Swapchain {
  public:
    // Takes over the surface. Throws Error when the device cannot show pictures on it.
    Swapchain(gpu::Device& device, VkSurfaceKHR surface);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    // Waits for the device. With either side 0, as of a minimised window, there are no images until it grows.
    void resize(std::uint32_t width, std::uint32_t height);
    bool empty() const { return frames_.empty(); }
    VkExtent2D extent() const { return extent_; }
    std::uint32_t imageCount() const { return static_cast<std::uint32_t>(frames_.size()); }
    // Draws over what is there, in layout COLOR_ATTACHMENT_OPTIMAL, and leaves it ready to present.
    VkRenderPass renderPass() const { return renderPass_; }

    // The next image to draw into; false: it is out of date, resize first. The image is free once `acquired`
    // signals.
    bool acquire(VkSemaphore acquired);
    VkImage image() const { return frames_[current_].image; }
    VkFramebuffer framebuffer() const { return frames_[current_].framebuffer; }
    // What the drawing must signal for present to wait on.
    VkSemaphore drawn() const { return frames_[current_].drawn; }
    // False: it is out of date.
    bool present();

  private:
    struct Frame {
        VkImage image = VK_NULL_HANDLE;
        VkImageView view = VK_NULL_HANDLE;
        VkFramebuffer framebuffer = VK_NULL_HANDLE;
        VkSemaphore drawn = VK_NULL_HANDLE;
    };
    void makeRenderPass();
    void makeFrames();
    void destroyFrames();

    gpu::Device& device_;
    VkSurfaceKHR surface_;
    VkSurfaceFormatKHR format_{};
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkRenderPass renderPass_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
    std::vector<Frame> frames_;
    std::uint32_t current_ = 0;
};

}  // namespace cutis::app
