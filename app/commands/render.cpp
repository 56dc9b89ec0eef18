// cutis render: one picture of a scene.
#include <chrono>
#include <future>
#include <vector>

#include "app/command.h"
#include "app/inputs.h"
#include "app/output_files.h"
#include "app/progress.h"
#include "app/stats_json.h"
#include "app/tolerance.h"
#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/gpu/device.h"

namespace cutis::app {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

void writeResult(const RenderResult& result, const Request& request, double exposure) {
    for (const fs::path& output : request.outputs) writePicture(output, result.picture, exposure);
    for (const std::string& name : request.settings.aovs)
        writeExr(aovFile(request.outputs.front(), name), result.aovs.at(name));
    if (!request.stats.empty()) writeFileAtomically(request.stats, statsToJson(result.stats));
}

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

int runRender(const Request& request) {
    const std::vector<fs::path> outputs = filesToWrite(request, "render");
    for (const fs::path& output : outputs) checkWritable(output);

    Progress progress;
    progress.setStage("loading");
    const Clock::time_point start = Clock::now();
    // Opening the device and reading files have nothing to do with each other.
    std::future<Inputs> loading = std::async(std::launch::async, [&] { return loadInputs(request); });
    gpu::DeviceOptions deviceOptions;
    deviceOptions.select = request.device;
    gpu::Device device(deviceOptions);
    Inputs inputs = loading.get();
    const double loadMs = millisecondsSince(start);
    checkInputsSurvive(inputs, outputs);

    RenderSettings settings = request.settings;
    if (request.tolerance) applyTolerance(*request.tolerance, inputs, device.info(), settings);

    progress.setStage("rendering");
    const RenderInput input{.scene = &inputs.scene,
                            .rig = inputs.rig,
                            .environment = inputs.environment ? &*inputs.environment : nullptr,
                            .camera = inputs.camera};
    RenderResult result = renderPicture(device, input, settings);
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
