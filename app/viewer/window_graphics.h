// Inside the window: one frame at a time of pictures and interface, in Vulkan.
#pragma once

#include <vulkan/vulkan.h>

#include <map>
#include <memory>
#include <span>

#include "app/viewer/swapchain.h"
#include "app/viewer/window.h"
#include "renderer/gpu/buffer.h"
#include "renderer/gpu/image.h"

struct GLFWwindow;

namespace cutis::app {

struct Window::Graphics {
    // Opens the device named in the options if it can show windows, else the first that can.
    Graphics(GLFWwindow* window, const WindowOptions& options);
    ~Graphics();
    Graphics(const Graphics&) = delete;
    Graphics& operator=(const Graphics&) = delete;

    // Dear ImGui's own resources, once its context and fonts are there.
    void openInterface();
    void closeInterface();
    void setPicture(int number, const DisplayPicture& picture);
    // Draws ImGui's draw data over the pictures and shows the result.
    void draw(std::span<const PicturePart> parts);

    struct Shown {
        gpu::Image image;     // sampled by nobody: copied into the window
        gpu::Buffer staging;  // its bytes until the next frame copies them
        bool uploaded = false;
    };

    std::unique_ptr<gpu::Device> device;
    std::unique_ptr<Swapchain> swapchain;
    std::map<int, Shown> shown;  // by number
    bool outOfDate = true;

  private:
    void record(VkCommandBuffer commands, std::span<const PicturePart> parts);
    void upload(VkCommandBuffer commands);
    void submit(VkCommandBuffer commands, VkSemaphore wait, VkSemaphore signal);
    void waitForFrame();

    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence done_ = VK_NULL_HANDLE;
    VkSemaphore acquired_ = VK_NULL_HANDLE;
    VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
    bool interface_ = false;
};

}  // namespace cutis::app
