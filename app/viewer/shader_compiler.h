// Shaders compiled while the program runs, from their source folder.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "renderer/gpu/shader_library.h"

namespace cutis::app {

struct CompiledShaders {
    gpu::ShaderModules modules;
    std::string error;  // of the first shader that is wrong: "shade.comp:12: ..."; empty: all are right
};

// Compiles the modules of those names, "shade.comp+SKIN+AOVS" with SKIN and AOVS defined, as the build does
// (shaders/CMakeLists.txt). On all cores.
CompiledShaders compileShaders(const std::filesystem::path& folder, std::span<const std::string> names);

// The first of the headers that shaders share with this program (structures, sizes, numbers of bindings) which is
// not what the program was built with, "shared/scene.h"; empty: all are. Shaders that include it do not fit.
std::string changedSharedHeader(const std::filesystem::path& folder);

// When each file below the folder was written last.
using FileTimes = std::map<std::string, std::filesystem::file_time_type>;
FileTimes shaderFiles(const std::filesystem::path& folder);

}  // namespace cutis::app
