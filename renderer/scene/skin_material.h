// `material.extras.skin` of a glTF file (DESIGN §2.2) as data, and back.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "renderer/scene/json_view.h"
#include "renderer/scene/scene.h"

namespace cutis {

// The value of `extras.skin`: true (defaults), false (not skin) or an object of parameters. Throws Error
// naming the JSON path of an unknown key, a wrong type or an impossible value.
std::optional<SkinMaterial> parseSkinMaterial(const JsonView& value);

// What parseSkinMaterial turns into the same material again: `true`, or the parameters that are not the
// defaults.
nlohmann::json skinMaterialJson(const SkinMaterial& skin);

}  // namespace cutis
