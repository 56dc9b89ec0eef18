// What measurements found of the settings of a scene, so that `cutis render --tolerance` can take the
// cheapest one that is close enough.
#pragma once

#include <string>
#include <vector>

#include "renderer/measure/sweep.h"

namespace cutis {

struct MeasuredSetting {
    Setting setting;
    double error = 0;         // relative L2 of `diffuse`, plus twice its standard error
    double milliseconds = 0;  // median of a frame
};

// Settings of one scene, measured on one device at one size of the picture.
struct MeasuredFront {
    std::string device;
    int width = 0, height = 0;
    std::vector<MeasuredSetting> settings;
};

// What measure.json (report.h) says in `text`. Rows that failed, or that changed the scene's lights or
// characters, are left out. Throws Error naming `file` and the JSON path.
MeasuredFront readFront(const std::string& text, const std::string& file);

// Measured on the default scene, for scenes of which nothing is known.
MeasuredFront defaultFront();

// The fastest setting whose error is not above `tolerance`, and the closest of all; nullptr when there is
// none.
const MeasuredSetting* cheapestWithin(const MeasuredFront& front, double tolerance);
const MeasuredSetting* closest(const MeasuredFront& front);

// The setting for a picture of another size than it was measured at: atlas and light maps grow with its
// pixels, so that they stay as fine beside them. They never shrink.
Setting settingForSize(const Setting& setting, const MeasuredFront& front, int width, int height);

}  // namespace cutis
