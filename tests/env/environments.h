// Environments that the tests light things with.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/light.h"

namespace cutis::test {

// Names of the HDR environments of Debian's blender-data, without ".exr".
inline const std::vector<std::string> kBlenderEnvironments = {"city",  "courtyard", "forest",  "interior",
                                                              "night", "studio",    "sunrise", "sunset"};

// Loads one of them once and keeps it. Throws Error when the package is not installed.
const Environment& blenderEnvironment(const std::string& name);

// Radiance 1 everywhere.
Environment uniformEnvironment(int width, int height);

// A dim gradient of three colours with one texel of 30,000.
Environment sunnyEnvironment(int width, int height);

}  // namespace cutis::test
