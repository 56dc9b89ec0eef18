#include "renderer/scene/picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/scene/image_io.h"
#include "renderer/scene/tonemap.h"

namespace cutis {
namespace {

void checkWhole(const Picture& picture, const std::filesystem::path& path) {
    const std::size_t expected = std::size_t(picture.width) * picture.height * picture.channels;
    if (picture.width < 1 || picture.height < 1 || picture.channels < 1 ||
        picture.values.size() != expected) {
        throw Error("cannot write picture", "it has no pixels or not as many as its size says",
                    path.string());
    }
}

std::byte quantize(float linear) {
    return static_cast<std::byte>(std::lround(255 * std::clamp(encodeSrgb(linear), 0.f, 1.f)));
}

// A picture holds no NaN unless something is wrong; it must not become undefined behaviour in the conversion
// to 8 bits.
float finite(float value) {
    constexpr float kLargest = 1e30f;
    return std::isnan(value) ? 0.f : std::clamp(value, -kLargest, kLargest);
}

Pixels emptyPixels(const Picture& picture, int channels, SampleType type) {
    Pixels pixels{{picture.width, picture.height, channels, type}, {}};
    pixels.samples.resize(pixels.layout.bytes());
    return pixels;
}

}  // namespace

void writeExr(const std::filesystem::path& path, const Picture& picture) {
    checkWhole(picture, path);
    Pixels pixels = emptyPixels(picture, picture.channels, SampleType::float32);
    std::memcpy(pixels.samples.data(), picture.values.data(), pixels.samples.size());
    writePixels(path, pixels);
}

void writePng(const std::filesystem::path& path, const Picture& linear, double exposure) {
    checkWhole(linear, path);
    const float gain = static_cast<float>(std::exp2(exposure));
    const int n = linear.channels;
    Pixels pixels = emptyPixels(linear, 3, SampleType::uint8);
    parallelFor(std::size_t(linear.height), [&](std::size_t y) {
        for (std::size_t i = y * linear.width; i < (y + 1) * linear.width; ++i) {
            const float* in = linear.values.data() + i * n;
            const glm::vec3 color = n < 3 ? glm::vec3(in[0]) : glm::vec3(in[0], in[1], in[2]);
            const glm::vec3 shown =
                toneMapNeutral({finite(color.r * gain), finite(color.g * gain), finite(color.b * gain)});
            for (int c = 0; c < 3; ++c) pixels.samples[i * 3 + c] = quantize(shown[c]);
        }
    });
    writePixels(path, pixels);
}

Picture readPicture(const std::filesystem::path& path) {
    return readPixels(path, kMaxImageSize, kMaxImageSize);
}

}  // namespace cutis
