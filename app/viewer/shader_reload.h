// Shaders that change while the viewer runs: compiled in the background and put to use, or not, with a
// message.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>

#include "app/viewer/shader_compiler.h"

namespace cutis::app {

class ShaderReload {
  public:
    // Nothing is watched where the folder is not there: in a program that was installed without its source.
    // `wake` is called on another thread when there is news.
    ShaderReload(std::filesystem::path folder, std::function<void()> wake);

    bool possible() const { return !files_.empty(); }
    // Compiles all shaders when a file has changed, or when asked to. To be called in every frame.
    void update(bool asked);
    bool compiling() const { return compiling_.valid(); }

    struct News {
        bool replaced = false;  // the next devices take the new ones
        std::string text;       // what to say
    };
    std::optional<News> take();

  private:
    std::filesystem::path folder_;
    std::function<void()> wake_;
    FileTimes files_;
    std::chrono::steady_clock::time_point looked_;
    std::future<CompiledShaders> compiling_;
};

}  // namespace cutis::app
