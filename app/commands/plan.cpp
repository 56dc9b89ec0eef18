// cutis plan: what a picture would run.
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "app/command.h"
#include "app/prepared.h"
#include "app/progress.h"
#include "app/stats_json.h"

namespace cutis::app {
namespace {

constexpr int kMeasuredFrames = 5;

std::string mebibytes(std::uint64_t bytes) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f MiB", static_cast<double>(bytes) / (1 << 20));
    return text;
}

std::string milliseconds(const PassStats& row) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f ms", medianMs(row));
    return text;
}

void printRow(const char* state, const std::string& name, const std::string& bytes, const std::string& time,
              const std::string& reason) {
    std::printf("  %-3s  %-22s  %12s  %11s  %s\n", state, name.c_str(), bytes.c_str(), time.c_str(), reason.c_str());
}

void printRows(const char* heading, const std::vector<PassStats>& on, const std::vector<LeftOut>& off) {
    std::printf("\n%s\n", heading);
    for (const PassStats& row : on) {
        printRow("on", row.name, row.bytes > 0 ? mebibytes(row.bytes) : "",
                 row.repeatedMs.empty() ? "" : milliseconds(row), row.reason);
    }
    for (const LeftOut& row : off) printRow("off", row.name, "", "", row.reason);
}

void print(const RenderStats& stats, const RenderSettings& settings) {
    std::printf("%s\n", stats.device.c_str());
    std::printf("picture %d x %d, atlas %d x %d at %.2f mm a texel\n", settings.width, settings.height, stats.atlasWidth,
                stats.atlasHeight, stats.atlasMmPerTexel);
    std::printf("%d lights in %d samples, %d light maps, %d characters, %d Gaussians\n", stats.lights,
                stats.lightSamples, stats.lightMaps, stats.characters, stats.gaussians);
    std::printf("GPU memory %s\n", mebibytes(stats.bytesGpu).c_str());
    printRows("before the frame", stats.prepared, stats.notPrepared);
    printRows("frame", stats.passes, stats.leftOut);
}

}  // namespace

int runPlan(const Request& request) {
    std::optional<Progress> progress(std::in_place);
    progress->setStage("loading");
    Prepared prepared(request);
    const RenderInput input = renderInput(prepared.inputs);
    RenderSettings settings = request.settings;
    settings.repeats = kMeasuredFrames;
    Renderer renderer(prepared.device, Renderer::Views::one);
    RenderStats stats;
    if (request.measure) {
        progress->setStage("measuring");
        stats = renderer.render(input, settings).stats;
    } else {
        progress->setStage("planning");
        stats = renderer.plan(input, settings);
    }
    progress.reset();
    if (request.json) {
        std::fputs(planToJson(stats, request.measure).c_str(), stdout);
    } else {
        print(stats, settings);
    }
    checkValidation(prepared.device);
    return 0;
}

}  // namespace cutis::app
