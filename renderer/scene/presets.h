// Portrait lighting as photographers name it, placed relative to the head of any subject.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/light.h"

namespace cutis {

struct Preset {
    std::string name, summary;  // "three-point"; one line for `cutis rig list`
};

// All presets, in the order in which `cutis rig list` prints them.
const std::vector<Preset>& presets();

// True when presetRig knows the name. Case does not count, and blanks and underscores are hyphens.
bool isPreset(const std::string& name);

// The rig of a preset. The key gives the centre of the head an irradiance of 2.5, so that white skin facing
// it has a radiance of 0.8 at exposure 0; other lights are set by their ratio to it. Throws Error for an
// unknown name, listing the presets.
Rig presetRig(const std::string& name);

}  // namespace cutis
