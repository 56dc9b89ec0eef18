// SPIR-V embedded at build time (shaders/CMakeLists.txt), found by name.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cutis::gpu {

struct EmbeddedShader {
    std::string_view name;  // file name, "diffusion.comp", or the name of a variant
    std::span<const std::uint32_t> words;
};

// The module of that name, or an empty span. It stays until the program ends.
std::span<const std::uint32_t> findShader(std::string_view name);

// Makes further modules known, for example a test's own. The span must outlive all devices.
void addShaders(std::span<const EmbeddedShader> shaders);

// Names of all modules that are embedded.
std::vector<std::string> embeddedShaderNames();

// A header that shaders share with the program, whole, as it was when the program was built.
struct SharedHeader {
    std::string_view name, text;  // name: below shaders/, "shared/scene.h"
};
std::span<const SharedHeader> sharedHeaders();

// While shaders are being written: findShader gives these in place of the embedded ones, to devices opened
// from now on. An empty map brings those back. From any thread.
using ShaderModules = std::map<std::string, std::vector<std::uint32_t>, std::less<>>;
void replaceShaders(ShaderModules modules);

}  // namespace cutis::gpu
