// The name of a picture's saved state: a hash of everything that the estimate depends on.
#pragma once

#include <cstdint>

#include "renderer/reference/mesh.h"
#include "renderer/reference/reference.h"

namespace cutis::reference {

std::uint64_t contentKey(const Input& input, const Settings& settings, const PlacedScene& placed);

}  // namespace cutis::reference
