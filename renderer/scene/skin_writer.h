// `material.extras.skin` written back into a glTF file that may hold anything else.
#pragma once

#include <filesystem>

#include "renderer/scene/scene.h"

namespace cutis {

// Writes a copy of the file that `scene` was loaded from, in which extras.skin of the materials says what
// they are in `scene`; all else stays as it is, extensions that cutis does not know among it. Materials that
// are not skin and have no extras.skin stay without. `output` has the extension of the file, and lies beside
// it where the file refers to others. Written atomically. Throws Error.
void writeSkinExtras(const Scene& scene, const std::filesystem::path& output);

}  // namespace cutis
