// Which settings a measurement tries.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/frame/renderer.h"
#include "renderer/scene/scene.h"

namespace cutis {

// One row of a measurement: what it changes of the scene, its rig and the quality. 0 leaves the program's
// choice, unless noted.
struct Setting {
    std::string name;
    int irradianceSize = 0;       // texels along each side of the atlas
    int gaussians = 0;            // of the profile
    int lightMapSize = 0;         // texels along each side
    int areaSamples = 0;          // light samples of each area light
    int environmentSamples = -1;  // directions of the environment that cast shadows; -1: the rig's
    std::string merge = "min";    // or "opposite"
    std::string chain = "exact";  // or "published"
    int taps = 0;                 // of each blur, on either side at the most
    int lights = 0;      // the rig's lights repeated, turned about the subject, until there are so many
    int characters = 0;  // the scene's characters repeated, side by side, until there are so many
    bool operator==(const Setting&) const = default;

    // Whether both show the same scene in the same light, so that one reference serves both.
    bool sameSubject(const Setting& other) const;
};

// Columns of tables: one a field of Setting but its name.
struct SettingField {
    const char* name;
    std::string (*text)(const Setting&);  // "auto" for the program's choice
};
const std::vector<SettingField>& settingFields();

// The built-in sweeps: "quality", "lights" (1 to 64), "characters" (1 to 16) and "size" (of the atlas, 256 to
// 8192).
const std::vector<std::string>& sweepNames();
// Throws std::invalid_argument when there is no sweep of that name.
std::vector<Setting> builtInSweep(const std::string& name);
// {"cutis_sweep": 1, "settings": [{"name": "coarse", "irradiance_size": 512}, …]}, with the names of
// settingFields. Throws Error with the file and the JSON path.
std::vector<Setting> loadSweep(const std::filesystem::path& file);

// What `setting` makes of a scene, a rig and a quality.
void applySetting(const Setting& setting, Scene& scene, Rig& rig, RenderSettings& quality);

}  // namespace cutis
