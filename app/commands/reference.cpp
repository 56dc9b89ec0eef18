// cutis reference: the picture evaluated exactly.
#include "renderer/reference/reference.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/inputs.h"
#include "app/output_files.h"
#include "app/progress.h"
#include "app/signals.h"
#include "renderer/core/error.h"
#include "renderer/core/files.h"

namespace cutis::app {
namespace fs = std::filesystem;
namespace {

constexpr double kDefaultError = 0.005;

std::string percent(double fraction) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g %%", 100 * fraction);
    return text;
}

// "[######......] error 0.71 %, 42 s left" of the whole run; the pass under way where its end is not known
// yet.
std::string describe(const reference::Progress& progress) {
    const bool known = progress.secondsLeft >= 0;
    const double total = progress.seconds + progress.secondsLeft;
    const double share = known && total > 0 ? progress.seconds / total : progress.fraction;
    constexpr int kWidth = 24;
    const int full = std::clamp(static_cast<int>(share * kWidth), 0, kWidth);
    std::string text = "[";
    text.append(full, '#').append(kWidth - full, '.').append("] ");
    text += progress.error > 0 ? "error " + percent(progress.error)
                               : "pass " + std::to_string(progress.passes + 1);
    if (known) text += ", " + std::to_string(std::lround(progress.secondsLeft)) + " s left";
    return text;
}

std::string statsOf(const reference::Result& result, const Inputs& inputs, double loadMs) {
    int lights = 0;
    for (const Light& light : inputs.rig.lights) lights += light.enabled;
    const nlohmann::ordered_json json = {{"device", "CPU"},
                                         {"passes", result.passes},
                                         {"samples_per_pixel", result.passes * reference::kSamplesPerPass},
                                         {"picture_error", result.pictureError},
                                         {"diffuse_error", result.diffuseError},
                                         {"lights", lights},
                                         {"characters", inputs.scene.characters.size()},
                                         {"nonfinite", result.nonfinite},
                                         {"load_ms", loadMs},
                                         {"frame_ms", 1000 * result.seconds}};
    return json.dump(2) + '\n';
}

void writeResult(const reference::Result& result, const Request& request, const Inputs& inputs,
                 double loadMs) {
    for (const fs::path& output : request.outputs)
        writePicture(output, result.picture, inputs.rig.exposure + request.exposure);
    const fs::path& first = request.outputs.front();
    for (const std::string& name : request.settings.aovs)
        writeExr(aovFile(first, name), result.aovs.at(name));
    if (request.halves) {
        for (int half = 0; half < 2; ++half) {
            const std::string name(1, half == 0 ? 'a' : 'b');
            writeExr(aovFile(first, name), result.halves[half]);
            writeExr(aovFile(first, name + ".diffuse"), result.diffuseHalves[half]);
        }
    }
    if (!request.stats.empty()) writeFileAtomically(request.stats, statsOf(result, inputs, loadMs));
}

}  // namespace

int runReference(const Request& request) {
    const std::vector<fs::path> outputs = filesToWrite(request, "reference");
    for (const fs::path& output : outputs) checkWritable(output);

    const auto start = std::chrono::steady_clock::now();
    reference::Result result;
    Inputs inputs;
    double loadMs = 0;
    {
        Progress progress;
        progress.setStage("loading");
        inputs = loadInputs(request);
        checkInputsSurvive(inputs, outputs);
        loadMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();

        const reference::Input input{.scene = &inputs.scene,
                                     .rig = inputs.rig,
                                     .environment = inputs.environment ? &*inputs.environment : nullptr,
                                     .camera = inputs.camera};
        reference::Settings settings{.width = request.settings.width,
                                     .height = request.settings.height,
                                     .gaussians = request.settings.gaussians,
                                     .seed = request.settings.seed,
                                     .error = request.error.value_or(request.budget > 0 ? 0 : kDefaultError),
                                     .budget = request.budget,
                                     .aovs = request.settings.aovs};
        static std::atomic<bool> stop{false};
        reference::Hooks hooks;
        hooks.progress = [&](const reference::Progress& at) { progress.setStage(describe(at)); };
        hooks.stop = &stop;
        stopGentlyOnSignals(&stop);
        result = reference::evaluate(input, settings, hooks);
        stopGentlyOnSignals(nullptr);
        if (!result.interrupted) {
            progress.setStage("writing");
            writeResult(result, request, inputs, loadMs);
        }
    }
    if (result.interrupted) {
        warn("interrupted after " + std::to_string(result.passes) +
             (cacheFolder().empty() ? " passes, which are lost: there is no cache folder"
                                    : " passes; the same command goes on from there"));
        return endingStatus();
    }
    std::printf("standard error %s of the picture, %s of its diffuse light; %d samples a pixel, %.1f s\n",
                percent(result.pictureError).c_str(), percent(result.diffuseError).c_str(),
                result.passes * reference::kSamplesPerPass, result.seconds);
    if (result.nonfinite)
        warn(std::to_string(result.nonfinite) + " samples were not finite and count as black");
    return 0;
}

}  // namespace cutis::app
