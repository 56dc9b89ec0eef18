// cutis measure: error against run time.
#include <atomic>
#include <cstdio>

#include "app/command.h"
#include "app/output_folder.h"
#include "app/prepared.h"
#include "app/progress.h"
#include "app/signals.h"
#include "app/tolerance.h"
#include "app/usage_error.h"
#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/measure/maps.h"
#include "renderer/measure/measurement.h"
#include "renderer/measure/report.h"
#include "renderer/measure/stability.h"
#include "renderer/reference/reference.h"

namespace cutis::app {
namespace fs = std::filesystem;
namespace {

// White in error maps: this share of the mean diffuse light.
constexpr double kWholeError = 0.2;

// Not settings of one picture, but other scenes and lights: measureStability.
constexpr const char* kStability = "stability";

std::vector<Setting> chooseSweep(const std::string& name) {
    for (const std::string& known : sweepNames())
        if (known == name) return builtInSweep(name);
    return loadSweep(name);
}

// Thrown where an interruption ended the reference: no std::exception, so that it is no failure of one
// setting.
struct Interrupted {};

// The exact picture. It keeps its own state in the cache, by the content of all that it shows, so that asking
// again for the same costs nothing.
SubjectReference makeReference(const MeasuredSubject& subject, const Request& request, Progress& progress) {
    const reference::Input input{.scene = &subject.scene,
                                 .rig = subject.rig,
                                 .environment = subject.environment ? &*subject.environment : nullptr,
                                 .camera = subject.camera};
    const reference::Settings settings{
        .width = subject.quality.width,
        .height = subject.quality.height,
        .seed = request.settings.seed,
        .error = request.error.value_or(request.budget > 0 ? 0 : reference::Settings{}.error),
        .budget = request.budget,
        .aovs = {"diffuse"}};
    static std::atomic<bool> stop{false};
    reference::Hooks hooks;
    hooks.stop = &stop;
    hooks.progress = [&](const reference::Progress& at) {
        char text[64];
        std::snprintf(text, sizeof text, "reference, standard error %.2f %%", 100 * at.error);
        progress.setStage(text);
    };
    stopGentlyOnSignals(&stop);
    reference::Result result = reference::evaluate(input, settings, hooks);
    stopGentlyOnSignals(nullptr);
    if (result.interrupted) throw Interrupted{};
    SubjectReference made{.picture = std::move(result.picture),
                          .diffuse = std::move(result.aovs.at("diffuse"))};
    for (int half = 0; half < 2; ++half) {
        made.pictureHalves[half] = std::move(result.halves[half]);
        made.diffuseHalves[half] = std::move(result.diffuseHalves[half]);
    }
    made.standardError = result.diffuseError;
    return made;
}

// A row of a sweep of settings as it is printed.
std::string settingLine(const Measurement& row) {
    char text[96];
    std::snprintf(text, sizeof text, "%-28s ", row.setting.name.c_str());
    if (!row.failure.empty()) return text + ("failed: " + row.failure);
    std::snprintf(text, sizeof text, "%-28s %.2f %% in %.2f ms", row.setting.name.c_str(),
                  100 * row.diffuse.relativeL2, row.gpu.median);
    return text;
}

}  // namespace

int runMeasure(const Request& request) {
    const fs::path folder = request.outputs.front();
    const bool stability = request.sweep == kStability;
    const std::vector<Setting> settings = stability ? std::vector<Setting>{} : chooseSweep(request.sweep);
    const std::vector<StabilityCase> cases = stability ? stabilityCases() : std::vector<StabilityCase>{};
    prepareOutputFolder(folder, "measure.json");
    Progress progress;
    progress.setStage("loading");
    Prepared prepared(request);
    const Inputs& inputs = prepared.inputs;
    gpu::Device& device = prepared.device;

    const MeasureInput input{.scene = &inputs.scene,
                             .rig = inputs.rig,
                             .environment = inputs.environment ? &*inputs.environment : nullptr,
                             .camera = inputs.camera,
                             .width = request.measureSize.width,
                             .height = request.measureSize.height,
                             .exposure = inputs.rig.exposure + request.exposure,
                             .repeats = request.repeats};
    const ReportInfo info{
        .kind = stability ? ReportKind::stability : ReportKind::sweep,
        .title = (stability ? "Stiff and extreme cases: " + request.operands.front()
                            : "Error against run time: " + request.operands.front() + ", " + request.sweep),
        .device = device.info().name,
        .command = commandLine(),
        .width = input.width,
        .height = input.height,
        .repeats = request.repeats,
        .tolerance = request.tolerance};
    // From the start the folder is known as this report's, so that an interrupted run can be started again.
    writeFileAtomically(folder / "measure.json", reportJson({}, info));
    for (const char* name : {"pictures", "errors"}) fs::create_directories(folder / name);
    std::vector<Measurement> rows;
    MeasureHooks hooks;
    hooks.reference = [&](const MeasuredSubject& subject) {
        return makeReference(subject, request, progress);
    };
    hooks.row = [&](const Measurement& row, const Picture& picture, const Picture& diffuse,
                    const SubjectReference& reference) {
        const std::size_t index = rows.size();
        rows.push_back(row);
        progress.setStage("measured " + std::to_string(rows.size()) + " of " +
                          std::to_string(settings.size() + cases.size()));
        if (row.failure.empty()) {
            writePng(folder / pictureFile(index, row), picture, input.exposure);
            const std::vector<bool> covered = coveredPixels(reference.picture);
            writeMap(folder / errorFile(index, row), relativeErrorMap(diffuse, reference.diffuse, covered),
                     kWholeError);
        }
        std::printf("%s\n", (stability ? stabilityLine(row) : settingLine(row)).c_str());
        std::fflush(stdout);
    };
    try {
        if (stability) std::printf("%s\n", stabilityHeading().c_str());
        rows = stability ? measureStability(device, input, cases, hooks)
                         : measureSettings(device, input, settings, hooks);
    } catch (const Interrupted&) {
        warn("interrupted; the same command goes on with the reference from there");
        return endingStatus();
    }
    progress.setStage("writing");
    if (!stability) recordMeasurement(inputs, device.info(), reportJson(rows, info));
    writeReport(folder, rows, info);
    for (const std::string& paragraph : reportText(rows, info)) std::printf("%s\n", paragraph.c_str());
    checkValidation(device);
    return 0;
}

}  // namespace cutis::app
