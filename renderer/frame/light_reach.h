// Which bodies the light of a sample can reach: those of which no point gets light from it need no light map, and a sample
// that reaches nothing is left out.
#pragma once

#include <string>

#include "renderer/scene/light.h"
#include "renderer/scene/scene.h"

namespace cutis {

// Why no point of the box is lit by the sample, in words; nullptr: some point may be. Never wrong about darkness: then the
// irradiance of irradianceFrom (scene/light_samples.h) is 0 in all of the box.
const char* whyDark(const LightSample& sample, const Bounds& box);
inline bool mayReach(const LightSample& sample, const Bounds& box) { return !whyDark(sample, box); }

}  // namespace cutis
