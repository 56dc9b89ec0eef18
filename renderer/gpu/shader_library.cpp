#include "renderer/gpu/shader_library.h"

#include <list>
#include <mutex>

namespace cutis::gpu {

// Generated from everything under shaders/ that is a stage.
std::span<const EmbeddedShader> cutisShaders();

namespace {

std::vector<std::span<const EmbeddedShader>>& libraries() {
    static std::vector<std::span<const EmbeddedShader>> list{cutisShaders()};
    return list;
}

// All that ever replaced others, the last in use: a device may still hold an earlier one.
struct Replaced {
    std::mutex mutex;
    std::list<ShaderModules> generations;
};

Replaced& replaced() {
    static Replaced all;
    return all;
}

}  // namespace

std::span<const std::uint32_t> findShader(std::string_view name) {
    {
        Replaced& all = replaced();
        const std::lock_guard lock(all.mutex);
        if (!all.generations.empty()) {
            const auto found = all.generations.back().find(name);
            if (found != all.generations.back().end()) return found->second;
        }
    }
    for (const std::span<const EmbeddedShader> library : libraries()) {
        for (const EmbeddedShader& shader : library) {
            if (shader.name == name) return shader.words;
        }
    }
    return {};
}

void addShaders(std::span<const EmbeddedShader> shaders) {
    libraries().push_back(shaders);
}

std::vector<std::string> embeddedShaderNames() {
    std::vector<std::string> names;
    for (const EmbeddedShader& shader : cutisShaders()) names.emplace_back(shader.name);
    return names;
}

void replaceShaders(ShaderModules modules) {
    Replaced& all = replaced();
    const std::lock_guard lock(all.mutex);
    all.generations.push_back(std::move(modules));
}

}  // namespace cutis::gpu
