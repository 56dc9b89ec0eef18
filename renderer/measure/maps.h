// One-channel pictures as colours.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>

#include "renderer/scene/picture.h"

namespace cutis {

// Black (0) through purple, red and yellow to white (1 and more, or what is not finite), as code values in [0, 1].
glm::vec3 heatColor(float value);

// Writes a PNG in these colours, white at `whole`. Throws Error.
void writeMap(const std::filesystem::path& file, const Picture& map, double whole);

}  // namespace cutis
