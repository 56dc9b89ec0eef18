// Scene-linear radiance as the bytes of a screen: what writePng writes, in memory.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/picture.h"

namespace cutis::app {

struct DisplayPicture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  // sRGB, row 0 at the top, alpha 255
};

// Exposed by 2^exposure, neutral tone curve, sRGB, over black; on all cores.
DisplayPicture toDisplay(const Picture& linear, double exposure);

}  // namespace cutis::app
