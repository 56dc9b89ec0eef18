// The window: GLFW, Dear ImGui, and pictures that lie behind the interface. One at a time, on the main
// thread.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/viewer/display_picture.h"

struct GLFWwindow;

namespace cutis::gpu {
class Device;
}

namespace cutis::app {

// A rectangle in pixels, from the top left.
struct PixelRect {
    int x = 0, y = 0, width = 0, height = 0;
    bool contains(double px, double py) const {
        return px >= x && py >= y && px < x + width && py < y + height;
    }
};

// The part of a picture that lies within `clip`, when all of it fills `whole`.
struct PicturePart {
    int picture = 0;  // as setPicture named it
    PixelRect whole, clip;
};

// A key that went down; GLFW's key and modifier bits.
struct KeyPress {
    int key = 0, modifiers = 0;
    bool again = false;  // it is being held, and the system repeats it
};

struct WindowOptions {
    std::string title;
    int width = 1280, height = 720;  // pixels
    double uiScale = 0;              // 0: what the desktop asks for
    std::string device;              // as gpu::DeviceOptions takes it, when that can show windows
};

class Window {
  public:
    // Throws Error: no display, no device that can show pictures on it.
    explicit Window(const WindowOptions& options);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // Sleeps until something happens, `seconds` at most.
    void waitEvents(double seconds);
    // Ends a waitEvents. From any thread.
    static void wake();

    // Starts a frame of the interface; false while there is nothing to draw on (minimised).
    bool beginFrame();
    // Draws the pictures and then the interface on top.
    void endFrame(std::span<const PicturePart> parts);

    // Keeps the picture under that number, in place of what was there.
    void setPicture(int number, const DisplayPicture& picture);

    void hide();
    void setTitle(const std::string& title);
    void setClipboard(const std::string& text);
    // The user asked to close the window; taking it clears it.
    bool takeCloseRequest();
    std::vector<KeyPress> takeKeys();
    std::vector<std::filesystem::path> takeDrops();

    double uiScale() const { return uiScale_; }
    int width() const;  // of the framebuffer, pixels
    int height() const;
    std::string deviceName() const;

  private:
    struct Graphics;
    void openInterface();
    void beginInterfaceFrame();

    GLFWwindow* window_ = nullptr;
    double uiScale_ = 1;
    std::unique_ptr<Graphics> graphics_;
    std::vector<KeyPress> keys_, unseenKeys_;  // not taken yet; not shown to Dear ImGui yet
    struct {
        bool control = false, shift = false;
    } heldModifiers_;
    std::vector<std::filesystem::path> drops_;
};

}  // namespace cutis::app
