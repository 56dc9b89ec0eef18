// cutis render: one picture of a scene.
#include <unistd.h>

#include <chrono>
#include <future>
#include <set>
#include <vector>

#include "app/command.h"
#include "app/inputs.h"
#include "app/progress.h"
#include "app/stats_json.h"
#include "app/usage_error.h"
#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/gpu/device.h"

namespace cutis::app {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

// OUT.NAME.exr beside OUT.exr or OUT.png.
fs::path aovFile(const fs::path& output, const std::string& name) {
    fs::path file = output;
    return file.replace_extension("." + name + ".exr");
}

std::vector<fs::path> filesToWrite(const Request& request) {
    std::vector<fs::path> files = request.outputs;
    for (const std::string& name : request.settings.aovs)
        files.push_back(aovFile(request.outputs.front(), name));
    if (!request.stats.empty()) files.push_back(request.stats);
    std::set<fs::path> unique;
    for (const fs::path& file : files) {
        if (!unique.insert(file.lexically_normal()).second)
            throw UsageError("two results would be written to " + file.string(), "render");
    }
    return files;
}

// Before minutes of work, not after: can this be written at all?
void checkWritable(const fs::path& file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::error_code error;
    if (!fs::is_directory(folder, error)) throw Error("cannot write file", "no such folder", folder.string());
    if (access(folder.c_str(), W_OK) != 0)
        throw Error("cannot write file", "the folder is not writable", folder.string());
    if (fs::is_directory(file, error)) throw Error("cannot write file", "it is a folder", file.string());
}

// No output may replace what the picture is made from.
void checkInputsSurvive(const Inputs& inputs, const std::vector<fs::path>& outputs) {
    for (const fs::path& output : outputs) {
        for (const fs::path& input : {inputs.scene.file, inputs.rigFile, inputs.environmentFile}) {
            std::error_code error;
            if (!input.empty() && fs::equivalent(input, output, error))
                throw Error("cannot write file", "it is an input of this picture", output.string());
        }
    }
}

void writeResult(const RenderResult& result, const Request& request, double exposure) {
    for (const fs::path& output : request.outputs) {
        if (output.extension() == ".png" || output.extension() == ".PNG") {
            writePng(output, result.picture, exposure);
        } else {
            writeExr(output, result.picture);
        }
    }
    for (const std::string& name : request.settings.aovs)
        writeExr(aovFile(request.outputs.front(), name), result.aovs.at(name));
    if (!request.stats.empty()) writeFileAtomically(request.stats, statsToJson(result.stats));
}

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

int runRender(const Request& request) {
    const std::vector<fs::path> outputs = filesToWrite(request);
    for (const fs::path& output : outputs) checkWritable(output);

    Progress progress;
    progress.setStage("loading");
    const Clock::time_point start = Clock::now();
    // Opening the device and reading files have nothing to do with each other.
    std::future<Inputs> loading = std::async(std::launch::async, [&] { return loadInputs(request); });
    gpu::DeviceOptions deviceOptions;
    deviceOptions.select = request.device;
    gpu::Device device(deviceOptions);
    const Inputs inputs = loading.get();
    const double loadMs = millisecondsSince(start);
    checkInputsSurvive(inputs, outputs);

    progress.setStage("rendering");
    const RenderInput input{.scene = &inputs.scene,
                            .rig = inputs.rig,
                            .environment = inputs.environment ? &*inputs.environment : nullptr,
                            .camera = inputs.camera};
    RenderResult result = renderPicture(device, input, request.settings);
    result.stats.loadMs = loadMs;

    progress.setStage("writing");
    writeResult(result, request, inputs.rig.exposure + request.exposure);
    if (result.stats.nonfinite)
        warn(std::to_string(result.stats.nonfinite) + " values of the result are not finite");
    if (const std::uint64_t messages = gpu::validationMessages()) {
        throw Error("validation failed", std::to_string(messages) + " messages from the validation layers",
                    result.stats.device);
    }
    return 0;
}

}  // namespace cutis::app
