#include "app/viewer/shader_reload.h"

#include <utility>

namespace cutis::app {
namespace {

using namespace std::chrono_literals;
constexpr auto kPeriod = 1s;  // between two looks at the files

}  // namespace

ShaderReload::ShaderReload(std::filesystem::path folder, std::function<void()> wake)
    : folder_(std::move(folder)), wake_(std::move(wake)), files_(shaderFiles(folder_)) {}

void ShaderReload::update(bool asked) {
    if (!possible() || compiling()) return;
    const auto now = std::chrono::steady_clock::now();
    if (!asked && now - looked_ < kPeriod) return;
    looked_ = now;
    FileTimes files = shaderFiles(folder_);
    if (!asked && files == files_) return;
    files_ = std::move(files);
    compiling_ = std::async(std::launch::async, [folder = folder_, wake = wake_] {
        const std::vector<std::string> names = gpu::embeddedShaderNames();
        CompiledShaders compiled;
        const std::string changed = changedSharedHeader(folder);
        if (changed.empty()) {
            compiled = compileShaders(folder, names);
        } else {
            compiled.error =
                changed + " is not what this program was built with: build cutis again and start it anew";
        }
        wake();
        return compiled;
    });
}

std::optional<ShaderReload::News> ShaderReload::take() {
    if (!compiling() || compiling_.wait_for(0s) != std::future_status::ready) return std::nullopt;
    CompiledShaders compiled = compiling_.get();
    if (!compiled.error.empty()) return News{false, "Shaders stay as they were: " + compiled.error};
    const std::size_t count = compiled.modules.size();
    gpu::replaceShaders(std::move(compiled.modules));
    return News{true, std::to_string(count) + " shaders compiled"};
}

}  // namespace cutis::app
