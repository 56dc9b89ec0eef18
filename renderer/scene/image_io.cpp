#include "renderer/scene/image_io.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/scene/codec/image_file.h"
#include "renderer/scene/codec_client.h"

namespace cutis {
namespace {

constexpr float kLargestHalf = 65504;
constexpr std::uint64_t kMaxPixelBytes = std::uint64_t(4) << 30;  // of one picture: 16384² RGBA floats
constexpr int kMaxChannels = 64;

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
    throw Error("cannot read image", why, name);
}

// Channels of the file that stand for R, G, B and A; -1: absent.
struct ChannelMap {
    int rgb[3];
    int alpha;
};

ChannelMap mapChannels(int channels) {
    if (channels == 1) return {{0, 0, 0}, -1};
    if (channels == 2) return {{0, 0, 0}, 1};
    if (channels == 3) return {{0, 1, 2}, -1};
    return {{0, 1, 2}, 3};
}

void fillRgba8(Image& image, const CodecResult& pixels) {
    const int channels = pixels.layout.channels;
    const ChannelMap map = mapChannels(channels);
    const std::size_t texels = std::size_t(image.width) * image.height;
    image.texels.resize(texels * 4);
    const auto* in = reinterpret_cast<const std::uint8_t*>(pixels.data.bytes().data());
    auto* out = reinterpret_cast<std::uint8_t*>(image.texels.data());
    for (std::size_t i = 0; i < texels; ++i, in += channels, out += 4) {
        for (int c = 0; c < 3; ++c) out[c] = in[map.rgb[c]];
        out[3] = map.alpha < 0 ? 255 : in[map.alpha];
        image.opaque &= out[3] == 255;
    }
}

float storable(float value) {
    return std::isnan(value) ? 0.f : std::clamp(value, -kLargestHalf, kLargestHalf);
}

void fillRgba16f(Image& image, const CodecResult& pixels) {
    const int channels = pixels.layout.channels;
    const ChannelMap map = mapChannels(channels);
    const std::size_t texels = std::size_t(image.width) * image.height;
    image.texels.resize(texels * 8);
    const auto* in = reinterpret_cast<const float*>(pixels.data.bytes().data());
    for (std::size_t i = 0; i < texels; ++i, in += channels) {
        const glm::vec4 rgba(storable(in[map.rgb[0]]), storable(in[map.rgb[1]]), storable(in[map.rgb[2]]),
                             map.alpha < 0 ? 1.f : storable(in[map.alpha]));
        const std::uint64_t packed = glm::packHalf4x16(rgba);
        std::memcpy(image.texels.data() + i * 8, &packed, 8);
        image.opaque &= rgba.a >= 1;
    }
}

}  // namespace

Image decodeImage(std::span<const std::byte> file, const std::string& name, bool* floatFile) {
    const CodecResult pixels = decodeImageMemory(file, {kMaxImageSize, kMaxImageSize, 4, kMaxImageBytes});
    if (!pixels.why.empty()) refuse(name, pixels.why);
    Image image;
    image.name = name;
    image.width = pixels.layout.width;
    image.height = pixels.layout.height;
    image.format = pixels.layout.type == SampleType::uint8 ? TexelFormat::rgba8 : TexelFormat::rgba16f;
    if (image.format == TexelFormat::rgba8) {
        fillRgba8(image, pixels);
    } else {
        fillRgba16f(image, pixels);
    }
    if (floatFile) *floatFile = pixels.layout.isFloat;
    return image;
}

std::uint64_t decodedBytes(std::span<const std::byte> file) {
    PixelLayout layout = claimedLayout(file);
    // Of other formats the codec tells the size when it refuses to decode a single byte of it.
    if (layout.width <= 0) layout = decodeImageMemory(file, {kMaxImageSize, kMaxImageSize, 4, 0}).layout;
    if (layout.width <= 0 || layout.height <= 0) return 0;
    const std::uint64_t texel = layout.type == SampleType::uint8 ? 4 : 8;
    return std::min<std::uint64_t>(std::uint64_t(layout.width) * std::uint64_t(layout.height) * texel,
                                   kMaxImageBytes);
}

std::vector<std::byte> encodePng(const Image& image) {
    const std::size_t texels = std::size_t(image.width) * image.height;
    if (image.format != TexelFormat::rgba8 || image.texels.size() != texels * 4 || texels == 0) {
        throw Error("cannot write image", "only whole images of 8 bits can become PNG", image.name);
    }
    PixelLayout layout{image.width, image.height, image.opaque ? 3 : 4};
    std::vector<std::byte> samples;
    samples.reserve(layout.bytes());
    for (std::size_t i = 0; i < texels; ++i) {
        const auto texel = image.texels.begin() + std::ptrdiff_t(4 * i);
        samples.insert(samples.end(), texel, texel + layout.channels);
    }
    const CodecResult file = encodeImage("png", layout, samples);
    if (!file.why.empty()) throw Error("cannot write image", file.why, image.name);
    return {file.data.bytes().begin(), file.data.bytes().end()};
}

Picture readPixels(const std::filesystem::path& path, int maxWidth, int maxHeight, bool* integers) {
    const std::string name = path.string();
    std::error_code error;
    if (!std::filesystem::exists(path, error)) refuse(name, "no such file");
    if (!std::filesystem::is_regular_file(path, error)) refuse(name, "not a regular file");
    const CodecResult pixels = decodeImageFile(name, {maxWidth, maxHeight, kMaxChannels, kMaxPixelBytes});
    if (!pixels.why.empty()) refuse(name, pixels.why);
    const PixelLayout& layout = pixels.layout;
    const std::span<const std::byte> samples = pixels.data.bytes();
    Picture picture;
    picture.width = layout.width;
    picture.height = layout.height;
    picture.channels = layout.channels;
    picture.values.resize(std::size_t(layout.width) * layout.height * layout.channels);
    if (layout.type == SampleType::float32) {
        std::memcpy(picture.values.data(), samples.data(), samples.size());
    } else {
        std::ranges::transform(samples, picture.values.begin(),
                               [](std::byte b) { return float(std::to_integer<int>(b)) / 255; });
    }
    if (integers) *integers = !layout.isFloat;
    return picture;
}

void writePixels(const std::filesystem::path& path, const Pixels& pixels) {
    const std::string extension = path.extension().string();
    const std::string format = extension.substr(std::min<std::size_t>(extension.size(), 1));
    const CodecResult file = encodeImage(format, pixels.layout, pixels.samples);
    if (!file.why.empty()) throw Error("cannot write picture", file.why, path.string());
    writeFileAtomically(path, file.data.bytes());
}

}  // namespace cutis
