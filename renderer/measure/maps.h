// One-channel pictures as colours.
#pragma once

#include <filesystem>

#include "renderer/scene/picture.h"

namespace cutis {

// Writes a PNG: black 0, through purple, red and yellow, to white at `whole` and beyond; what is not finite
// is white. Throws Error.
void writeMap(const std::filesystem::path& file, const Picture& map, double whole);

}  // namespace cutis
