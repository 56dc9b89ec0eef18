#include "renderer/scene/picture.h"

#include <OpenImageIO/imageio.h>

#include <cmath>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
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

void writeImage(const std::filesystem::path& path, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                const void* values) {
    writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
        const auto output = OIIO::ImageOutput::create(temporary.string());
        if (!output || !output->open(temporary.string(), spec) || !output->write_image(type, values) ||
            !output->close()) {
            throw Error("cannot write picture", output ? output->geterror() : OIIO::geterror(),
                        path.string());
        }
    });
}

std::vector<std::string> channelNames(int channels) {
    switch (channels) {
        case 1:
            return {"Y"};
        case 2:
            return {"Y", "A"};
        case 3:
            return {"R", "G", "B"};
        case 4:
            return {"R", "G", "B", "A"};
    }
    std::vector<std::string> names;
    for (int c = 0; c < channels; ++c) names.push_back("channel" + std::to_string(c));
    return names;
}

std::uint8_t quantize(float linear) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(encodeSrgb(linear), 0.f, 1.f)));
}

// A picture holds no NaN unless something is wrong; it must not become undefined behaviour in the conversion
// to 8 bits.
float finite(float value) {
    constexpr float kLargest = 1e30f;
    return std::isnan(value) ? 0.f : std::clamp(value, -kLargest, kLargest);
}

}  // namespace

void writeExr(const std::filesystem::path& path, const Picture& picture) {
    checkWhole(picture, path);
    OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, OIIO::TypeDesc::FLOAT);
    spec.channelnames = channelNames(picture.channels);
    if (picture.channels == 2 || picture.channels == 4) spec.alpha_channel = picture.channels - 1;
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    writeImage(path, spec, OIIO::TypeDesc::FLOAT, picture.values.data());
}

void writePng(const std::filesystem::path& path, const Picture& linear, double exposure) {
    checkWhole(linear, path);
    const float gain = static_cast<float>(std::exp2(exposure));
    const int n = linear.channels;
    std::vector<std::uint8_t> pixels(std::size_t(linear.width) * linear.height * 3);
    parallelFor(std::size_t(linear.height), [&](std::size_t y) {
        for (std::size_t i = y * linear.width; i < (y + 1) * linear.width; ++i) {
            const float* in = linear.values.data() + i * n;
            const glm::vec3 color = n < 3 ? glm::vec3(in[0]) : glm::vec3(in[0], in[1], in[2]);
            const glm::vec3 shown =
                toneMapNeutral({finite(color.r * gain), finite(color.g * gain), finite(color.b * gain)});
            for (int c = 0; c < 3; ++c) pixels[i * 3 + c] = quantize(shown[c]);
        }
    });
    OIIO::ImageSpec spec(linear.width, linear.height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    writeImage(path, spec, OIIO::TypeDesc::UINT8, pixels.data());
}

Picture readPicture(const std::filesystem::path& path) {
    return readPixels(path, kMaxImageSize, kMaxImageSize);
}

}  // namespace cutis
