// Error against run time: renders a scene with one setting after another and compares each picture with its
// reference.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/frame/renderer.h"
#include "renderer/measure/metrics.h"
#include "renderer/measure/sweep.h"

namespace cutis {

// Median and spread of repeated runs, in milliseconds.
struct Timing {
    double median = 0, min = 0, max = 0;
};
Timing timingOf(std::vector<double> milliseconds);

// What the settings of one subject are compared with. Pictures of the size of the measurement.
struct SubjectReference {
    Picture picture, diffuse;                    // best estimates
    Picture pictureHalves[2] = {}, diffuseHalves[2] = {};  // independent; empty when there are none
    double standardError = 0;                    // relative, of `diffuse` over all covered pixels
};

// One row of the report.
struct Measurement {
    Setting setting;
    std::string failure = {};  // one line; empty: it went well
    Timing gpu = {};           // sum over the passes
    std::map<std::string, Timing> passes = {};
    std::uint64_t bytesGpu = 0, nonfinite = 0;
    int atlasSize = 0, lightSamples = 0, gaussians = 0;
    ErrorFigures picture = {}, diffuse = {};
    double flip = 0;            // mean over all pixels, as shown on a screen
    double referenceError = 0;  // SubjectReference::standardError
    bool paretoFront = false;   // no other row is both faster and closer in `diffuse`
};

struct MeasureInput {
    const Scene* scene = nullptr;
    Rig rig;  // placements resolved
    const Environment* environment = nullptr;
    Camera camera;
    int width = 480, height = 270;
    double exposure = 0;  // of the pictures shown, EV
    int repeats = 3;      // timed runs of each setting, after one that warms up
};

// What one row shows, for the row to change.
struct MeasuredSubject {
    Scene scene;
    Rig rig;
    std::optional<Environment> environment;
    Camera camera;
    RenderSettings quality;
};
MeasuredSubject subjectOf(const MeasureInput& input);

struct MeasureHooks {
    // The reference of a subject: called once for all settings that show the same.
    std::function<SubjectReference(const MeasuredSubject&)> reference;
    // Called with each finished row, its picture and its diffuse light (both empty when it failed).
    std::function<void(const Measurement&, const Picture& picture, const Picture& diffuse, const SubjectReference&)> row;
};

// A setting that fails becomes a row that says so. Rows come in the order of `settings`.
std::vector<Measurement> measureSettings(gpu::Device& device, const MeasureInput& input,
                                         const std::vector<Setting>& settings, const MeasureHooks& hooks);

// Draws one subject and fills in the figures of its row. Throws Error.
RenderResult measureRow(gpu::Device& device, const MeasureInput& input, const MeasuredSubject& subject,
                        const SubjectReference& reference, Measurement& row);

// Marks the rows of the Pareto front of gpu.median against diffuse.relativeL2, within each subject.
void markParetoFront(std::vector<Measurement>& rows);

// The row with the smallest median time whose diffuse error, plus twice its uncertainty, is below
// `tolerance`; nullptr when there is none.
const Measurement* cheapestWithin(const std::vector<Measurement>& rows, double tolerance);

}  // namespace cutis
