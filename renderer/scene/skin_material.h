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

// Skin as the extensions of a glTF material hint at it, where it has KHR_materials_diffuse_transmission and
// KHR_materials_volume (or KHR_materials_volume_scatter) and no KHR_materials_transmission: each channel falls off with the
// distance at which the volume leaves 1/e of its light. Throws Error.
std::optional<SkinMaterial> hintedSkin(const JsonView& material);

// What parseSkinMaterial turns into the same material again: `true`, or the parameters that are not the
// defaults.
nlohmann::json skinMaterialJson(const SkinMaterial& skin);

}  // namespace cutis
