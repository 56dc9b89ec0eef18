// Lat-long environments from files.
#pragma once

#include <filesystem>

#include "renderer/scene/light.h"

namespace cutis {

// Largest environment, in texels.
inline constexpr int kMaxEnvironmentWidth = 16384, kMaxEnvironmentHeight = 8192;

// Loads an image (.hdr, .exr or any other that OpenImageIO reads) as lat-long radiance; 2:1 is usual, not
// required. NaN and negative components become 0, +Inf becomes the file's largest finite value; one warning
// gives the counts. Images of integers are taken as sRGB. One of less
// than 64 x 32 texels has each split into as many even parts as it takes. Without `warns` there is no warning. Throws
// Error.
Environment loadEnvironment(const std::filesystem::path& path, bool warns = true);

// The same for values that are there already: sanitizes in place and warns once, naming `name`.
void sanitizeEnvironment(Environment& environment, bool warns = true);

}  // namespace cutis
