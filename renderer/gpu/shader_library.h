// SPIR-V embedded at build time (shaders/CMakeLists.txt), found by name.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace cutis::gpu {

struct EmbeddedShader {
    std::string_view name;  // file name, "diffusion.comp", or the name of a variant
    std::span<const std::uint32_t> words;
};

// The module of that name, or an empty span.
std::span<const std::uint32_t> findShader(std::string_view name);

// Makes further modules known, for example a test's own. The span must outlive all devices.
void addShaders(std::span<const EmbeddedShader> shaders);

}  // namespace cutis::gpu
