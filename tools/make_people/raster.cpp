#include "raster.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "renderer/core/error.h"

namespace cutis::people {
namespace {

namespace fs = std::filesystem;

Raster readOpen(OIIO::ImageInput& input, const std::string& where) {
    const OIIO::ImageSpec& spec = input.spec();
    if (spec.width < 1 || spec.height < 1 || spec.width > 16384 || spec.height > 16384 || spec.nchannels < 3)
        throw Error("image", "not a colour image of a sane size", where);
    Raster image(spec.width, spec.height, std::min(spec.nchannels, 4));
    if (!input.read_image(0, 0, 0, image.channels, OIIO::TypeDesc::FLOAT, image.values.data()))
        throw Error("image", input.geterror(), where);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        if (image.channels < 4 || i % 4 != 3) image.values[i] = float(decodeSrgb(image.values[i]));
    return image;
}

}  // namespace

double decodeSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double encodeSrgb(double linear) {
    linear = std::clamp(linear, 0.0, 1.0);
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

Raster readColors(const fs::path& path) {
    OIIO::ImageSpec unassociated;
    unassociated["oiio:UnassociatedAlpha"] = 1;
    const auto input = OIIO::ImageInput::open(path.string(), &unassociated);
    if (!input) throw Error("image", OIIO::geterror(), path.string());
    return readOpen(*input, path.string());
}

Raster readPackedColors(const fs::path& gzipFile, std::size_t offset) {
    constexpr std::size_t kLargestFile = std::size_t(64) << 20;
    const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(gzipFile.c_str(), "rb"), gzclose);
    if (!file) throw Error("image", "cannot be opened", gzipFile.string());
    std::vector<unsigned char> bytes(kLargestFile);
    const int size = gzread(file.get(), bytes.data(), unsigned(bytes.size()));
    if (size < 0 || std::size_t(size) <= offset)
        throw Error("image", "holds no packed image", gzipFile.string());
    OIIO::Filesystem::IOMemReader reader(bytes.data() + offset, std::size_t(size) - offset);
    OIIO::ImageSpec unassociated;
    unassociated["oiio:UnassociatedAlpha"] = 1;
    const auto input = OIIO::ImageInput::create("png");
    OIIO::ImageSpec spec;
    if (!input || !input->set_ioproxy(&reader) || !input->open("packed.png", spec, unassociated))
        throw Error("image", input ? input->geterror() : OIIO::geterror(), gzipFile.string());
    return readOpen(*input, gzipFile.string());
}

void writePng8(const fs::path& path, const Raster& image, bool srgb) {
    std::vector<std::uint8_t> bytes(image.values.size());
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const bool color = srgb && !(image.channels == 4 && i % 4 == 3);
        const double value = color ? encodeSrgb(image.values[i]) : std::clamp<double>(image.values[i], 0, 1);
        bytes[i] = std::uint8_t(std::lround(255 * value));
    }
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
    spec["oiio:UnassociatedAlpha"] = 1;
    spec["png:compressionLevel"] = 6;
    const auto output = OIIO::ImageOutput::create(path.string());
    if (!output || !output->open(path.string(), spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, bytes.data()) || !output->close())
        throw Error("image", output ? output->geterror() : OIIO::geterror(), path.string());
}

glm::dvec3 sampleLanczos(const Raster& image, glm::dvec2 uv) {
    constexpr int kLobes = 3;
    constexpr double kPi = 3.14159265358979323846;
    const auto kernel = [](double x) {
        if (std::abs(x) < 1e-9) return 1.0;
        if (std::abs(x) >= kLobes) return 0.0;
        return kLobes * std::sin(kPi * x) * std::sin(kPi * x / kLobes) / (kPi * kPi * x * x);
    };
    const double x = uv.x * image.width - 0.5, y = uv.y * image.height - 0.5;
    const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    glm::dvec3 sum(0), low(1e9), high(-1e9);
    double total = 0, across[2 * kLobes], down[2 * kLobes];
    for (int i = 0; i < 2 * kLobes; ++i) {
        across[i] = kernel(x - (x0 + 1 - kLobes + i));
        down[i] = kernel(y - (y0 + 1 - kLobes + i));
    }
    for (int j = 1 - kLobes; j <= kLobes; ++j) {
        for (int i = 1 - kLobes; i <= kLobes; ++i) {
            const float* texel =
                image.at(std::clamp(x0 + i, 0, image.width - 1), std::clamp(y0 + j, 0, image.height - 1));
            const glm::dvec3 value(texel[0], texel[1], texel[2]);
            const double weight = across[i + kLobes - 1] * down[j + kLobes - 1];
            sum += weight * value;
            total += weight;
            if (i >= 0 && i <= 1 && j >= 0 && j <= 1)
                low = glm::min(low, value), high = glm::max(high, value);
        }
    }
    return glm::clamp(sum / total, low, high);
}

}  // namespace cutis::people
