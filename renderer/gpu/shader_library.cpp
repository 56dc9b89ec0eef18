#include "renderer/gpu/shader_library.h"

#include <vector>

namespace cutis::gpu {

// Generated from everything under shaders/ that is a stage.
std::span<const EmbeddedShader> cutisShaders();

namespace {

std::vector<std::span<const EmbeddedShader>>& libraries() {
    static std::vector<std::span<const EmbeddedShader>> list{cutisShaders()};
    return list;
}

}  // namespace

std::span<const std::uint32_t> findShader(std::string_view name) {
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

}  // namespace cutis::gpu
