// The sun of an environment, or whatever stands out in it like one: taken out as a light of the rig.
#pragma once

#include <optional>

#include "renderer/scene/light.h"

namespace cutis {

struct EnvironmentSun {
    glm::dvec3 towards{0, 1, 0};  // unit; where it stands while the environment is not rotated
    glm::dvec3 irradiance{0};     // RGB of a surface that faces it, intensity not applied
    double radius = 0;            // of a disc as wide, radians
};

// What gives less than this share of all light (∫ L dω, R+G+B) is no sun: in a studio of several lamps as
// bright as each other, a single texel stands out by next to nothing.
inline constexpr double kLeastSunShare = 0.01;

// The one compact part that stands out (splitEnvironment with one sample); none where none does.
std::optional<EnvironmentSun> findSun(const Environment& environment);

// Takes the light of findSun out, and no more: what is left keeps its colour and is nowhere negative. What
// EnvironmentSettings::sunRemoved asks for.
void removeSun(Environment& environment);

// A directional light called "sun" that gives what the sun gives under these settings: with it and
// `sunRemoved`, the light of the whole is as before.
Light sunLight(const EnvironmentSun& sun, const EnvironmentSettings& settings);

}  // namespace cutis
