#include "app/viewer/display_picture.h"

#include <cmath>

#include "renderer/core/parallel.h"
#include "renderer/scene/tonemap.h"

namespace cutis::app {

DisplayPicture toDisplay(const Picture& linear, double exposure) {
    DisplayPicture display{linear.width, linear.height, {}};
    const std::size_t width = static_cast<std::size_t>(linear.width);
    const std::size_t channels = static_cast<std::size_t>(linear.channels);
    display.rgba.resize(width * static_cast<std::size_t>(linear.height) * 4, 255);
    const float gain = static_cast<float>(std::exp2(exposure));
    parallelFor(static_cast<std::size_t>(linear.height), [&](std::size_t y) {
        for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
            const float* in = &linear.values[i * channels];
            glm::vec3 color(in[0], in[channels > 1 ? 1 : 0], in[channels > 2 ? 2 : 0]);
            for (int c = 0; c < 3; ++c)  // a pixel that is not finite shows as black, not as noise
                if (!std::isfinite(color[c])) color[c] = 0;
            color = toneMapNeutral(color * gain);
            for (int c = 0; c < 3; ++c) {
                const float code = encodeSrgb(std::min(color[c], 1.0f));
                display.rgba[i * 4 + static_cast<std::size_t>(c)] =
                    static_cast<std::uint8_t>(code * 255 + 0.5f);
            }
        }
    });
    return display;
}

}  // namespace cutis::app
