// cutis render: one picture of a scene.
#include <chrono>
#include <vector>

#include "app/command.h"
#include "app/frame_files.h"
#include "app/output_files.h"
#include "app/prepared.h"
#include "app/progress.h"
#include "app/stats_json.h"
#include "app/tolerance.h"
#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/core/timeline.h"
#include "renderer/frame/fitting.h"

namespace cutis::app {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

void writeResult(RenderResult& result, const Request& request, const Inputs& inputs) {
    const double exposure = inputs.rig.exposure + request.exposure;
    if (inputs.environment)
        BackgroundPainter(*inputs.environment, request.background)
            .paint(result.picture, inputs.camera, inputs.rig.environment);
    {
        const TimeSpan span("writing");
        for (const fs::path& output : request.outputs) writePicture(output, result.picture, exposure);
        for (const std::string& name : request.settings.aovs)
            writeExr(aovFile(request.outputs.front(), name), result.aovs.at(name));
    }
    if (!request.stats.empty()) writeFileAtomically(request.stats, statsToJson(result.stats));
}

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void warnOfNonfinite(std::uint64_t values) {
    if (values) warn(std::to_string(values) + " values of the result are not finite");
}

// One picture a frame, by one renderer: what does not move is kept from one to the next.
void renderFrames(const Request& request, const RenderSettings& settings, Prepared& prepared, double loadMs,
                  Progress& progress) {
    const Request::FrameRange& frames = *request.frames;
    Inputs& inputs = prepared.inputs;
    for (int frame = frames.first; frame <= frames.last; ++frame)
        checkInputsSurvive(inputs, filesToWrite(requestOfFrame(request, frame), "render"));
    Renderer renderer(prepared.device, Renderer::Views::one);
    progress.setStage("posing");
    for (int frame = frames.first; frame <= frames.last; ++frame) {
        setTime(inputs, request, timeOfFrame(request, frame));
        renderer.anticipate(renderInput(inputs), settings);
    }
    std::uint64_t nonfinite = 0;
    for (int frame = frames.first; frame <= frames.last; ++frame) {
        progress.setStage("frame " + std::to_string(frame) + " of " + std::to_string(frames.last));
        setTime(inputs, request, timeOfFrame(request, frame));
        RenderResult result = renderer.render(renderInput(inputs), settings);
        if (frame == frames.first) result.stats.loadMs = loadMs;
        writeResult(result, requestOfFrame(request, frame), inputs);
        nonfinite += result.stats.nonfinite;
    }
    warnOfNonfinite(nonfinite);
}

void renderOne(const Request& request, const RenderSettings& settings, Prepared& prepared, double loadMs,
               Progress& progress) {
    progress.setStage("rendering");
    const Inputs& inputs = prepared.inputs;
    RenderResult result = renderPicture(prepared.device, renderInput(inputs), settings);
    result.stats.loadMs = loadMs;
    progress.setStage("writing");
    writeResult(result, request, inputs);
    warnOfNonfinite(result.stats.nonfinite);
}

}  // namespace

int runRender(const Request& request) {
    const std::vector<fs::path> outputs = filesToWrite(request, "render");
    for (const fs::path& output : outputs) checkWritable(output);

    Progress progress;
    progress.setStage("loading");
    const Clock::time_point start = Clock::now();
    Prepared prepared(request);
    const double loadMs = millisecondsSince(start);
    checkInputsSurvive(prepared.inputs, outputs);

    RenderSettings settings = request.settings;
    if (request.tolerance) applyTolerance(*request.tolerance, prepared.inputs, prepared.device.info(), settings);
    const auto draw = request.frames ? renderFrames : renderOne;
    for (bool drawn = false; !drawn;) {
        try {
            draw(request, settings, prepared, loadMs, progress);
            drawn = true;
        } catch (const gpu::OutOfMemory& problem) {
            settings = settingsThatFit(prepared.device, renderInput(prepared.inputs), settings, problem);
        }
    }
    checkValidation(prepared.device);
    return 0;
}

}  // namespace cutis::app
