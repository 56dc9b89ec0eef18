// Rig files (`*.rig.json`, docs/rig-format.md): lights and an environment that fit any scene.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "renderer/scene/light.h"
#include "renderer/scene/scene.h"

namespace cutis {

inline constexpr std::uint64_t kMaxRigBytes = std::uint64_t(16) << 20;
inline constexpr std::size_t kMaxLights = 4096;
inline constexpr int kMaxLightSamples = 4096;  // of one light, and of an environment's shadow_samples

// Throws Error naming the file and the JSON path (`lights[1].color[2]`) for anything that is not a rig: an
// unknown or repeated key, a wrong type, an impossible value, more than the limits above. Values that the
// type of their light does not use are kept, with a warning.
Rig loadRig(const std::filesystem::path& path);
// The same for a text; `name` stands for the file in messages.
Rig parseRig(const std::string& json, const std::string& name);

// The text of a rig file. Values that are at their defaults are left out; a light with a placement is written
// with it alone. Parsing the text gives the same rig, doubles bit for bit (position and direction of placed
// lights excepted, which resolvePlacements fills). Throws Error when the rig holds what a file may not (see
// loadRig).
std::string rigToJson(const Rig& rig);
// Writes rigToJson atomically. Throws Error.
void saveRig(const Rig& rig, const std::filesystem::path& path);

// Fills position and direction of lights with a placement: at `distance` from the centre of their subject's
// head, aimed at it. The head of `*` is that of all characters together, or the whole scene when it has no
// character. Throws Error for an unknown subject, listing the characters, and for an empty scene.
void resolvePlacements(Rig& rig, const Scene& scene);

// The scene's own lights (KHR_lights_punctual) as a rig.
Rig rigFromScene(const Scene& scene);

// A scene of the rig's enabled lights alone, for writing as KHR_lights_punctual. Placements must be resolved.
// Warns about what glTF cannot hold: temperatures become colours, a rect light the spot of equal candela on
// its axis, a radius and an environment are lost.
Scene sceneFromRig(const Rig& rig);

const char* lightTypeName(LightType type);

}  // namespace cutis
