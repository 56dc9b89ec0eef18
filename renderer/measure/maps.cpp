#include "renderer/measure/maps.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/image_io.h"

namespace cutis {

void writeMap(const std::filesystem::path& file, const Picture& map, double whole) {
    static constexpr unsigned char kStops[][3] = {{0, 0, 0},      {70, 10, 90},   {180, 30, 60},
                                                  {240, 120, 10}, {255, 220, 80}, {255, 255, 255}};
    constexpr int kSteps = static_cast<int>(std::size(kStops)) - 1;
    Pixels pixels{{map.width, map.height, 3}, {}};
    for (float value : map.values) {
        const double place = std::isfinite(value) ? std::clamp(value / whole, 0.0, 1.0) * kSteps : kSteps;
        const int step = std::min(static_cast<int>(place), kSteps - 1);
        for (int c = 0; c < 3; ++c) {
            const double color = kStops[step][c] + (place - step) * (kStops[step + 1][c] - kStops[step][c]);
            pixels.samples.push_back(static_cast<std::byte>(std::lround(color)));
        }
    }
    writePixels(file, pixels);
}

}  // namespace cutis
