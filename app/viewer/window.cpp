#include "app/viewer/window.h"

#include "app/viewer/style.h"
#include "app/viewer/window_graphics.h"

// After Vulkan's header, which window_graphics.h brings.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "renderer/core/error.h"

namespace cutis::app {
namespace {

constexpr int kMinWidth = 800, kMinHeight = 480;

// GLFW's last error in the words that it has for it.
std::string lastGlfwError() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "GLFW gives no reason";
}

Window& windowOf(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

double contentScale(GLFWwindow* window) {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window, &x, &y);
    return std::clamp(static_cast<double>(std::max(x, y)), 1.0, 4.0);
}

}  // namespace

Window::Window(const WindowOptions& options) {
    glfwInitHint(GLFW_JOYSTICK_HAT_BUTTONS, GLFW_FALSE);
    if (!glfwInit()) throw Error("cannot open the viewer", "there is no display", lastGlfwError());
    try {
        if (!glfwVulkanSupported())
            throw Error("cannot open the viewer", "there is no Vulkan", lastGlfwError());
        glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
        window_ = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
        if (!window_) throw Error("cannot open the viewer", "no window", lastGlfwError());
        glfwSetWindowSizeLimits(window_, kMinWidth, kMinHeight, GLFW_DONT_CARE, GLFW_DONT_CARE);
        glfwSetWindowUserPointer(window_, this);
        uiScale_ = options.uiScale > 0 ? options.uiScale : contentScale(window_);
        graphics_ = std::make_unique<Graphics>(window_, options);
        openInterface();
    } catch (...) {
        graphics_.reset();
        glfwTerminate();
        throw;
    }
}

Window::~Window() {
    graphics_->closeInterface();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    graphics_.reset();
    glfwTerminate();
}

void Window::openInterface() {
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int modifiers) {
        if (action == GLFW_RELEASE) return;
        const KeyPress press{key, modifiers, action == GLFW_REPEAT};
        windowOf(window).keys_.push_back(press);
        windowOf(window).unseenKeys_.push_back(press);
    });
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
        for (int i = 0; i < count; ++i) windowOf(window).drops_.emplace_back(paths[i]);
    });
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // panels have their places
    applyStyle(uiScale_);
    ImGui_ImplGlfw_InitForVulkan(window_, true);  // calls our callbacks too
    graphics_->openInterface();
}

void Window::waitEvents(double seconds) {
    glfwWaitEventsTimeout(seconds);
}

void Window::wake() {
    glfwPostEmptyEvent();
}

bool Window::beginFrame() {
    if (width() == 0 || height() == 0) return false;
    const VkExtent2D extent = graphics_->swapchain->extent();
    const bool resized =
        static_cast<int>(extent.width) != width() || static_cast<int>(extent.height) != height();
    if (graphics_->outOfDate || resized || graphics_->swapchain->empty()) {
        graphics_->swapchain->resize(static_cast<std::uint32_t>(width()),
                                     static_cast<std::uint32_t>(height()));
        graphics_->outOfDate = false;
        if (graphics_->swapchain->empty()) return false;
    }
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    beginInterfaceFrame();
    return true;
}

// Dear ImGui sees only how keys stand when a frame begins: those that went down and up since the last one are
// shown to it as down.
void Window::beginInterfaceFrame() {
    ImGuiIO& io = ImGui::GetIO();
    for (const KeyPress& press : unseenKeys_) {
        if (press.key < 0 || press.key >= IM_ARRAYSIZE(io.KeysDown)) continue;
        io.KeysDown[press.key] = true;
        io.KeyCtrl |= (press.modifiers & GLFW_MOD_CONTROL) != 0;
        io.KeyShift |= (press.modifiers & GLFW_MOD_SHIFT) != 0;
    }
    ImGui::NewFrame();
    const auto down = [&](int key) { return glfwGetKey(window_, key) == GLFW_PRESS; };
    for (const KeyPress& press : std::exchange(unseenKeys_, {}))
        if (press.key >= 0 && press.key < IM_ARRAYSIZE(io.KeysDown)) io.KeysDown[press.key] = down(press.key);
    // What this frame's panels ask of io.KeyCtrl must still be true: the backend sets it anew at the next
    // event.
    heldModifiers_ = {down(GLFW_KEY_LEFT_CONTROL) || down(GLFW_KEY_RIGHT_CONTROL),
                      down(GLFW_KEY_LEFT_SHIFT) || down(GLFW_KEY_RIGHT_SHIFT)};
}

void Window::endFrame(std::span<const PicturePart> parts) {
    ImGui::Render();
    ImGui::GetIO().KeyCtrl = heldModifiers_.control;
    ImGui::GetIO().KeyShift = heldModifiers_.shift;
    graphics_->draw(parts);
}

void Window::setPicture(int number, const DisplayPicture& picture) {
    graphics_->setPicture(number, picture);
}

void Window::hide() {
    glfwHideWindow(window_);
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::setClipboard(const std::string& text) {
    glfwSetClipboardString(window_, text.c_str());
}

bool Window::takeCloseRequest() {
    const bool asked = glfwWindowShouldClose(window_);
    glfwSetWindowShouldClose(window_, GLFW_FALSE);
    return asked;
}

std::vector<KeyPress> Window::takeKeys() {
    return std::exchange(keys_, {});
}

std::vector<std::filesystem::path> Window::takeDrops() {
    return std::exchange(drops_, {});
}

int Window::width() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return width;
}

int Window::height() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return height;
}

std::string Window::deviceName() const {
    return graphics_->device->info().name;
}

}  // namespace cutis::app
