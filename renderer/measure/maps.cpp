#include "renderer/measure/maps.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/image_io.h"

namespace cutis {

glm::vec3 heatColor(float value) {
    static constexpr float kStops[][3] = {{0, 0, 0},      {70, 10, 90},   {180, 30, 60},
                                          {240, 120, 10}, {255, 220, 80}, {255, 255, 255}};
    constexpr int kSteps = static_cast<int>(std::size(kStops)) - 1;
    const float place = std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) * kSteps : kSteps;
    const int step = std::min(static_cast<int>(place), kSteps - 1);
    const float part = place - static_cast<float>(step);
    glm::vec3 color;
    for (int c = 0; c < 3; ++c)
        color[c] = (kStops[step][c] + part * (kStops[step + 1][c] - kStops[step][c])) / 255;
    return color;
}

void writeMap(const std::filesystem::path& file, const Picture& map, double whole) {
    Pixels pixels{{map.width, map.height, 3}, {}};
    const float scale = static_cast<float>(1 / whole);
    for (const float value : map.values) {
        const glm::vec3 color = heatColor(value * scale);
        for (int c = 0; c < 3; ++c)
            pixels.samples.push_back(static_cast<std::byte>(std::lround(color[c] * 255)));
    }
    writePixels(file, pixels);
}

}  // namespace cutis
