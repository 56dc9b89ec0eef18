// cutis render: one picture of a scene.
#include <chrono>
#include <vector>

#include "app/command.h"
#include "app/output_files.h"
#include "app/prepared.h"
#include "app/progress.h"
#include "app/stats_json.h"
#include "app/tolerance.h"
#include "renderer/core/error.h"
#include "renderer/core/files.h"

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
    Prepared prepared(request);
    Inputs& inputs = prepared.inputs;
    gpu::Device& device = prepared.device;
    const double loadMs = millisecondsSince(start);
    checkInputsSurvive(inputs, outputs);

    RenderSettings settings = request.settings;
    if (request.tolerance) applyTolerance(*request.tolerance, inputs, device.info(), settings);

    progress.setStage("rendering");
    const RenderInput input = renderInput(inputs);
    RenderResult result = renderPicture(device, input, settings);
    result.stats.loadMs = loadMs;
    if (inputs.environment)
        BackgroundPainter(*inputs.environment, request.background)
            .paint(result.picture, inputs.camera, inputs.rig.environment);

    progress.setStage("writing");
    writeResult(result, request, inputs.rig.exposure + request.exposure);
    if (result.stats.nonfinite)
        warn(std::to_string(result.stats.nonfinite) + " values of the result are not finite");
    checkValidation(device);
    return 0;
}

}  // namespace cutis::app
