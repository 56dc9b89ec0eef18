#include "renderer/scene/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <memory>
#include <string_view>

#include "renderer/core/error.h"

namespace cutis {
namespace {

constexpr float kLargestHalf = 65504;
constexpr std::size_t kMaxPixelBytes = std::size_t(4) << 30;  // of one picture: 16384 x 16384 RGBA floats

[[noreturn]] void refuse(const std::string& name, std::string why) {
    while (!why.empty() && (why.back() == '\n' || why.back() == '.')) why.pop_back();
    throw Error("cannot read image", why.empty() ? "not an image" : why, name);
}

void checkSize(const OIIO::ImageSpec& spec, int maxWidth, int maxHeight, std::size_t bytesPerTexel,
               const std::string& name) {
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) refuse(name, "it has no pixels");
    const std::size_t texels = std::size_t(spec.width) * std::size_t(spec.height);
    if (spec.width > maxWidth || spec.height > maxHeight || spec.depth > 1 ||
        texels * bytesPerTexel > kMaxImageBytes) {
        refuse(name, "it has " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                         " texels, the limit is " + std::to_string(maxWidth) + " x " +
                         std::to_string(maxHeight) + " and 1 GiB");
    }
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

template <typename T>
std::vector<T> readChannels(OIIO::ImageInput& input, int channels, OIIO::TypeDesc type,
                            const std::string& name) {
    const OIIO::ImageSpec& spec = input.spec();
    std::vector<T> values(std::size_t(spec.width) * spec.height * channels);
    if (!input.read_image(0, 0, 0, channels, type, values.data())) refuse(name, input.geterror());
    return values;
}

void fillRgba8(Image& image, const std::vector<std::uint8_t>& values, int channels) {
    const ChannelMap map = mapChannels(channels);
    const std::size_t texels = std::size_t(image.width) * image.height;
    image.texels.resize(texels * 4);
    auto* out = reinterpret_cast<std::uint8_t*>(image.texels.data());
    for (std::size_t i = 0; i < texels; ++i, out += 4) {
        const std::uint8_t* in = values.data() + i * channels;
        for (int c = 0; c < 3; ++c) out[c] = in[map.rgb[c]];
        out[3] = map.alpha < 0 ? 255 : in[map.alpha];
        image.opaque &= out[3] == 255;
    }
}

float storable(float value) {
    return std::isnan(value) ? 0.f : std::clamp(value, -kLargestHalf, kLargestHalf);
}

void fillRgba16f(Image& image, const std::vector<float>& values, int channels) {
    const ChannelMap map = mapChannels(channels);
    const std::size_t texels = std::size_t(image.width) * image.height;
    image.texels.resize(texels * 8);
    for (std::size_t i = 0; i < texels; ++i) {
        const float* in = values.data() + i * channels;
        const glm::vec4 rgba(storable(in[map.rgb[0]]), storable(in[map.rgb[1]]), storable(in[map.rgb[2]]),
                             map.alpha < 0 ? 1.f : storable(in[map.alpha]));
        const std::uint64_t packed = glm::packHalf4x16(rgba);
        std::memcpy(image.texels.data() + i * 8, &packed, 8);
        image.opaque &= rgba.a >= 1;
    }
}

OIIO::ImageSpec straightAlpha() {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    return config;
}

std::uint32_t bigEndian(std::span<const std::byte> bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i) word = word << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
    return word;
}

// CRC-32 of ISO 3309, as PNG chunks carry it.
std::uint32_t crc32(std::span<const std::byte> bytes) {
    static const auto table = [] {
        std::array<std::uint32_t, 256> entries;
        for (std::uint32_t i = 0; i < 256; ++i) {
            entries[i] = i;
            for (int bit = 0; bit < 8; ++bit)
                entries[i] = entries[i] >> 1 ^ (entries[i] & 1 ? 0xedb88320u : 0);
        }
        return entries;
    }();
    std::uint32_t crc = ~0u;
    for (const std::byte b : bytes) crc = table[(crc ^ std::to_integer<std::uint32_t>(b)) & 0xff] ^ crc >> 8;
    return ~crc;
}

// Refuses a truncated or damaged PNG before libpng does, which would print lines of its own on stderr.
void checkPng(std::span<const std::byte> file, const std::string& name) {
    constexpr std::size_t kSignature = 8, kFrame = 12;  // length, type and CRC of a chunk
    constexpr std::uint32_t kEnd = 0x49454e44;          // IEND
    for (std::size_t at = kSignature;;) {
        if (at + kFrame > file.size() || bigEndian(file, at) > file.size() - at - kFrame) {
            refuse(name, "the PNG is truncated");
        }
        const std::size_t length = bigEndian(file, at);
        if (crc32(file.subspan(at + 4, length + 4)) != bigEndian(file, at + 8 + length)) {
            refuse(name, "the PNG is damaged: a checksum does not fit");
        }
        if (bigEndian(file, at + 4) == kEnd) return;
        at += kFrame + length;
    }
}

// A reader for a file in memory. ImageInput::open would look for the file on disk.
std::unique_ptr<OIIO::ImageInput> openMemory(const std::string& format, OIIO::Filesystem::IOProxy& proxy,
                                             const std::string& name) {
    auto input = OIIO::ImageInput::create(format);
    OIIO::ImageSpec spec;
    if (!input || !input->supports("ioproxy"))
        refuse(name, "OpenImageIO cannot read " + format + " from memory");
    input->set_ioproxy(&proxy);
    if (!input->open("image." + format, spec, straightAlpha())) refuse(name, input->geterror());
    return input;
}

}  // namespace

std::string imageFormat(std::span<const std::byte> file) {
    const std::string_view head(reinterpret_cast<const char*>(file.data()),
                                std::min<std::size_t>(file.size(), 12));
    const auto starts = [&](std::string_view magic) { return head.starts_with(magic); };
    if (starts("\x89PNG")) return "png";
    if (starts("\xff\xd8\xff")) return "jpeg";
    if (starts("RIFF") && head.substr(8) == "WEBP") return "webp";
    if (starts(std::string_view("II*\0", 4)) || starts(std::string_view("MM\0*", 4))) return "tiff";
    if (starts("\x76\x2f\x31\x01")) return "openexr";
    if (starts("#?")) return "hdr";
    if (starts("BM")) return "bmp";
    if (starts("GIF8")) return "gif";
    return {};
}

Image decodeImage(std::span<const std::byte> file, const std::string& name, bool* floatFile) {
    const std::string format = imageFormat(file);
    if (format.empty()) refuse(name, "not an image of a known format");
    if (format == "png") checkPng(file, name);
    OIIO::Filesystem::IOMemReader reader(const_cast<std::byte*>(file.data()), file.size());
    // The reader is chosen by content: the extension of a file or the MIME type of a buffer may be wrong.
    const auto input = openMemory(format, reader, name);
    const OIIO::ImageSpec spec = input->spec();
    const bool eightBit = spec.format == OIIO::TypeDesc::UINT8;
    checkSize(spec, kMaxImageSize, kMaxImageSize, eightBit ? 4 : 8, name);

    const int channels = std::min(spec.nchannels, 4);
    Image image;
    image.name = name;
    image.width = spec.width;
    image.height = spec.height;
    image.format = eightBit ? TexelFormat::rgba8 : TexelFormat::rgba16f;
    if (eightBit) {
        fillRgba8(image, readChannels<std::uint8_t>(*input, channels, OIIO::TypeDesc::UINT8, name), channels);
    } else {
        fillRgba16f(image, readChannels<float>(*input, channels, OIIO::TypeDesc::FLOAT, name), channels);
    }
    if (floatFile) *floatFile = spec.format.is_floating_point();
    return image;
}

std::vector<std::byte> encodePng(const Image& image) {
    const std::size_t texels = std::size_t(image.width) * image.height;
    if (image.format != TexelFormat::rgba8 || image.texels.size() != texels * 4 || texels == 0) {
        throw Error("cannot write image", "only whole images of 8 bits can become PNG", image.name);
    }
    const int channels = image.opaque ? 3 : 4;
    OIIO::ImageSpec spec(image.width, image.height, channels, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    std::vector<unsigned char> file;
    OIIO::Filesystem::IOVecOutput sink(file);
    const auto output = OIIO::ImageOutput::create("image.png", &sink);
    if (!output || !output->open("image.png", spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, image.texels.data(), 4) || !output->close()) {
        throw Error("cannot write image", output ? output->geterror() : OIIO::geterror(), image.name);
    }
    const auto bytes = std::as_bytes(std::span(file));
    return {bytes.begin(), bytes.end()};
}

Picture readPixels(const std::filesystem::path& path, int maxWidth, int maxHeight, bool* integers) {
    const std::string name = path.string();
    std::error_code error;
    if (!std::filesystem::exists(path, error)) refuse(name, "no such file");
    if (!std::filesystem::is_regular_file(path, error)) refuse(name, "not a regular file");
    const OIIO::ImageSpec config = straightAlpha();
    const auto input = OIIO::ImageInput::open(name, &config);
    if (!input) refuse(name, OIIO::geterror());
    const OIIO::ImageSpec spec = input->spec();
    checkSize(spec, maxWidth, maxHeight, 1, name);
    const std::size_t bytes = std::size_t(spec.width) * spec.height * spec.nchannels * sizeof(float);
    if (bytes > kMaxPixelBytes) refuse(name, "its pixels take more than 4 GiB");
    Picture picture;
    picture.width = spec.width;
    picture.height = spec.height;
    picture.channels = spec.nchannels;
    picture.values = readChannels<float>(*input, spec.nchannels, OIIO::TypeDesc::FLOAT, name);
    if (integers) *integers = !spec.format.is_floating_point();
    return picture;
}

}  // namespace cutis
