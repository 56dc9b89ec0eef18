#include "renderer/measure/measurement.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>

#include "renderer/gpu/device.h"
#include "renderer/measure/flip.h"

namespace cutis {
namespace {

// Each pass and the sum of all, one value a run.
struct TimedRuns {
    std::vector<double> total;
    std::map<std::string, std::vector<double>> passes;

    // All repeats but the first, which compiles programs and fills caches.
    explicit TimedRuns(const RenderStats& stats) {
        for (const PassStats& pass : stats.passes) {
            if (pass.repeatedMs.empty()) continue;
            std::vector<double>& timed = passes[pass.name];
            timed.assign(pass.repeatedMs.begin() + 1, pass.repeatedMs.end());
            total.resize(timed.size(), 0);
            for (std::size_t i = 0; i < timed.size(); ++i) total[i] += timed[i];
        }
    }
};

void compare(const RenderResult& result, const SubjectReference& reference, double exposure,
             Measurement& row) {
    const bool halves = !reference.pictureHalves[0].values.empty();
    const auto against = [&](const Picture& mean, const Picture* parts) {
        return halves ? Reference{&mean, &parts[0], &parts[1]} : Reference{&mean};
    };
    const std::vector<bool> covered = coveredPixels(reference.picture);
    row.picture =
        compareToReference(result.picture, against(reference.picture, reference.pictureHalves), covered);
    row.diffuse = compareToReference(result.aovs.at("diffuse"),
                                     against(reference.diffuse, reference.diffuseHalves), covered);
    row.flip =
        meanOf(flipMap(displayLight(result.picture, exposure), displayLight(reference.picture, exposure)));
    row.referenceError = reference.standardError;
}

}  // namespace

Timing timingOf(std::vector<double> milliseconds) {
    if (milliseconds.empty()) return {};
    std::sort(milliseconds.begin(), milliseconds.end());
    const std::size_t n = milliseconds.size();
    return {(milliseconds[(n - 1) / 2] + milliseconds[n / 2]) / 2, milliseconds.front(), milliseconds.back()};
}

MeasuredSubject subjectOf(const MeasureInput& input) {
    MeasuredSubject subject{.scene = *input.scene,
                            .rig = input.rig,
                            .environment = {},
                            .camera = input.camera,
                            .quality = {.width = input.width, .height = input.height, .aovs = {"diffuse"}}};
    if (input.environment) subject.environment = *input.environment;
    return subject;
}

// A GPU that has slept, while a reference was made, takes tenths of a second to reach its clock rate.
void wake(gpu::Device& device, const RenderInput& input, const RenderSettings& settings) {
    if (device.info().type == "cpu") return;
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + std::chrono::milliseconds(300);
    while (Clock::now() < end) renderPicture(device, input, settings);
}

RenderResult measureRow(gpu::Device& device, const MeasureInput& input, const MeasuredSubject& subject,
                        const SubjectReference& reference, Measurement& row) {
    const RenderInput render{.scene = &subject.scene,
                             .rig = subject.rig,
                             .environment = subject.environment ? &*subject.environment : nullptr,
                             .camera = subject.camera};
    RenderSettings quality = subject.quality;
    quality.repeats = input.repeats + 1;
    wake(device, render, quality);
    RenderResult result = renderPicture(device, render, quality);
    const TimedRuns runs(result.stats);
    row.gpu = timingOf(runs.total);
    for (const auto& [name, values] : runs.passes) row.passes[name] = timingOf(values);
    row.bytesGpu = result.stats.bytesGpu;
    row.nonfinite = result.stats.nonfinite;
    row.atlasSize = result.stats.atlasWidth;
    row.lightSamples = result.stats.lightSamples;
    row.gaussians = result.stats.gaussians;
    compare(result, reference, input.exposure, row);
    return result;
}

std::vector<Measurement> measureSettings(gpu::Device& device, const MeasureInput& input,
                                         const std::vector<Setting>& settings, const MeasureHooks& hooks) {
    std::vector<Measurement> rows;
    Setting subjectSetting;
    SubjectReference reference;
    bool known = false;
    for (const Setting& setting : settings) {
        Measurement row{.setting = setting};
        RenderResult result;
        try {
            MeasuredSubject subject = subjectOf(input);
            applySetting(setting, subject.scene, subject.rig, subject.quality);
            if (!known || !setting.sameSubject(subjectSetting)) {
                known = false;
                reference = hooks.reference(subject);
                subjectSetting = setting;
                known = true;
            }
            result = measureRow(device, input, subject, reference, row);
        } catch (const std::exception& error) {
            row = {.setting = setting, .failure = error.what()};
            result = {};
        }
        hooks.row(row, result.picture, result.aovs["diffuse"], reference);
        rows.push_back(row);
    }
    markParetoFront(rows);
    return rows;
}

void markParetoFront(std::vector<Measurement>& rows) {
    for (Measurement& row : rows) {
        row.paretoFront = row.failure.empty();
        for (const Measurement& other : rows) {
            if (!other.failure.empty() || !other.setting.sameSubject(row.setting)) continue;
            const bool noWorse =
                other.gpu.median <= row.gpu.median && other.diffuse.relativeL2 <= row.diffuse.relativeL2;
            const bool better =
                other.gpu.median < row.gpu.median || other.diffuse.relativeL2 < row.diffuse.relativeL2;
            if (noWorse && better) row.paretoFront = false;
        }
    }
}

const Measurement* cheapestWithin(const std::vector<Measurement>& rows, double tolerance) {
    const Measurement* cheapest = nullptr;
    for (const Measurement& row : rows) {
        if (!row.failure.empty() || row.diffuse.nonfinite > 0) continue;
        if (row.diffuse.relativeL2 + 2 * row.diffuse.relativeL2Error > tolerance) continue;
        if (!cheapest || row.gpu.median < cheapest->gpu.median) cheapest = &row;
    }
    return cheapest;
}

}  // namespace cutis
