// A figure that walks: two legs of skin with a knee each, as a glTF file.
#pragma once

#include <filesystem>

namespace cutis::test {

// Writes NAME.glb into the folder and returns its path. The animation "walk" goes 0.6 m towards +Z in 2 s;
// hips and knees turn. Both legs are one mesh with a skin each, and one character "walker" beside a floor
// that stays. 442 vertices a leg.
std::filesystem::path writeWalkingBody(const std::filesystem::path& folder);

}  // namespace cutis::test
