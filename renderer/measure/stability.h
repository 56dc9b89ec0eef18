// Stiff and extreme variants of a scene: what `cutis measure --sweep stability` tries. tests/stability holds
// bodies of which more is known against closed forms.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/measure/measurement.h"

namespace cutis {

struct StabilityCase {
    std::string name;
    std::function<void(MeasuredSubject&)> change;
    // Above 0: the picture must be that of the unchanged scene times this, so that its reference serves. 0:
    // it shows something else, with a reference of its own.
    double factor = 0;
};

// Cases that make sense for any scene; the first one changes nothing. They change all skin, all lights and
// the environment alike.
std::vector<StabilityCase> stabilityCases();

// Renders each case with all data channels. A case that throws, or whose values are not finite or below zero,
// is a row that says so. Rows come in the order of `cases`; those of factor > 0 need the first to have a
// reference.
std::vector<Measurement> measureStability(gpu::Device& device, const MeasureInput& input,
                                          const std::vector<StabilityCase>& cases, const MeasureHooks& hooks);

}  // namespace cutis
