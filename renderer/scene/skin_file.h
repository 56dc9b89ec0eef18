// Which materials of a scene are skin and how each scatters, as a file (*.skin.json) that stands in for what
// the scene says:
//   { "cutis_skin": 1, "materials": [ { "name": "face", "skin": { "scale": 0.8 } },
//                                     { "name": "shirt", "skin": false } ] }
// `skin` is what material.extras.skin of a glTF file may be. Materials that the file does not name stay as
// they are.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace cutis {

// By its name: whether it ends in .json.
bool isSkinFile(const std::string& name);

// The skin of each material of the scene as the file has it: of several materials of one name the first entry
// is the first one's. Throws Error naming the file and the JSON path: no such material, an impossible value.
std::vector<std::optional<SkinMaterial>> loadSkinFile(const std::filesystem::path& file, const Scene& scene);

// What loadSkinFile turns into the same again, for all materials of the scene.
std::string skinFileText(const std::vector<std::optional<SkinMaterial>>& skin, const Scene& scene);

}  // namespace cutis
