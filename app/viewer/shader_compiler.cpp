#include "app/viewer/shader_compiler.h"

#include <SPIRV/GlslangToSpv.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>

#include <fstream>
#include <iterator>
#include <mutex>
#include <optional>
#include <sstream>

#include "renderer/core/parallel.h"

namespace cutis::app {
namespace fs = std::filesystem;
namespace {

std::optional<std::string> readSource(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(stream), {});
}

// #include "lib/lights.glsl": from the shaders' folder, or beside the file that asks.
class Includer : public glslang::TShader::Includer {
  public:
    explicit Includer(const fs::path& folder) : folder_(folder) {}

    IncludeResult* includeLocal(const char* name, const char* by, std::size_t) override {
        for (const fs::path& file : {folder_ / name, fs::path(by).parent_path() / name}) {
            std::optional<std::string> text = readSource(file);
            if (!text) continue;
            auto* kept = new std::string(std::move(*text));
            return new IncludeResult(file.string(), kept->data(), kept->size(), kept);
        }
        return nullptr;
    }
    IncludeResult* includeSystem(const char* name, const char* by, std::size_t depth) override {
        return includeLocal(name, by, depth);
    }
    void releaseInclude(IncludeResult* result) override {
        if (!result) return;
        delete static_cast<std::string*>(result->userData);
        delete result;
    }

  private:
    const fs::path& folder_;
};

EShLanguage stageOf(const fs::path& file) {
    const std::string extension = file.extension().string();
    if (extension == ".comp") return EShLangCompute;
    return extension == ".vert" ? EShLangVertex : EShLangFragment;
}

// glslang's first error, with the file's name instead of its whole path.
std::string firstError(const std::string& file, const char* log) {
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("ERROR: ")) continue;
        std::string text = line.substr(7);
        if (const std::size_t slash = text.find_last_of('/', text.find(": ")); slash != text.npos)
            text.erase(0, slash + 1);
        return text;
    }
    return file + " cannot be compiled";
}

// Puts the module into `words`; returns what is wrong, or nothing.
std::string compile(const fs::path& folder, const std::string& name, std::vector<std::uint32_t>& words) {
    const std::string file = name.substr(0, name.find('+'));
    const fs::path path = folder / file;
    const std::optional<std::string> source = readSource(path);
    if (!source) return file + " cannot be read";
    std::string defines;
    for (std::size_t at = name.find('+'); at != name.npos;) {
        const std::size_t end = name.find('+', at + 1);
        defines += "#define " + name.substr(at + 1, end - at - 1) + " 1\n";
        at = end;
    }
    const EShLanguage stage = stageOf(path);
    glslang::TShader shader(stage);
    const char* text = source->c_str();
    const int length = static_cast<int>(source->size());
    const std::string where = path.string();
    const char* whole = where.c_str();
    shader.setStringsWithLengthsAndNames(&text, &length, &whole, 1);
    shader.setPreamble(defines.c_str());
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    constexpr auto kRules = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    Includer includer(folder);
    if (!shader.parse(GetDefaultResources(), 460, false, kRules, includer))
        return firstError(file, shader.getInfoLog());
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(kRules)) return firstError(file, program.getInfoLog());
    std::vector<unsigned> spirv;
    glslang::GlslangToSpv(*program.getIntermediate(stage), spirv);
    words.assign(spirv.begin(), spirv.end());
    return "";
}

}  // namespace

CompiledShaders compileShaders(const fs::path& folder, std::span<const std::string> names) {
    static const bool begun = glslang::InitializeProcess();
    CompiledShaders result;
    if (!begun) {
        result.error = "glslang does not start";
        return result;
    }
    std::mutex mutex;
    parallelFor(names.size(), [&](std::size_t i) {
        {
            const std::lock_guard lock(mutex);
            if (!result.error.empty()) return;
        }
        std::vector<std::uint32_t> words;
        const std::string problem = compile(folder, names[i], words);
        const std::lock_guard lock(mutex);
        if (problem.empty()) {
            result.modules[names[i]] = std::move(words);
        } else if (result.error.empty()) {
            result.error = problem;
        }
    });
    return result;
}

std::string changedSharedHeader(const fs::path& folder) {
    for (const gpu::SharedHeader& header : gpu::sharedHeaders())
        if (readSource(folder / header.name) != header.text) return std::string(header.name);
    return "";
}

FileTimes shaderFiles(const fs::path& folder) {
    FileTimes times;
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(folder, error)) {
        const std::string extension = entry.path().extension().string();
        for (const char* known : {".comp", ".vert", ".frag", ".glsl", ".h"})
            if (extension == known) times[entry.path().string()] = entry.last_write_time(error);
    }
    return times;
}

}  // namespace cutis::app
