#include "renderer/scene/codec/image_codec.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include "renderer/scene/codec/image_file.h"

namespace cutis::codec {
namespace {

OIIO::TypeDesc typeOf(SampleType type) {
    switch (type) {
        case SampleType::uint8:
            return OIIO::TypeDesc::UINT8;
        case SampleType::uint16:
            return OIIO::TypeDesc::UINT16;
        case SampleType::float32:
            break;
    }
    return OIIO::TypeDesc::FLOAT;
}

std::string orUnknown(std::string why) {
    while (!why.empty() && (why.back() == '\n' || why.back() == '.')) why.pop_back();
    return why.empty() ? "not an image" : why;
}

OIIO::ImageSpec straightAlpha() {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    return config;
}

// For OpenImageIO, which tells the portion that is done and goes on where this returns false.
struct Progressing {
    const Progress& progress;
    double bytes;
    static bool tell(void* self, float portion) {
        const auto& all = *static_cast<const Progressing*>(self);
        all.progress(static_cast<std::uint64_t>(all.bytes * portion));
        return false;
    }
};

std::string readPixels(OIIO::ImageInput& input, const PixelLimits& limits, PixelLayout& pixels,
                       const Allocate& allocate, const Progress& progress) {
    const OIIO::ImageSpec spec = input.spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) return "it has no pixels";
    pixels.width = spec.width;
    pixels.height = spec.height;
    pixels.channels = std::min(spec.nchannels, limits.channels);
    pixels.type = spec.format == OIIO::TypeDesc::UINT8 ? SampleType::uint8 : SampleType::float32;
    pixels.isFloat = spec.format.is_floating_point();
    if (spec.width > limits.width || spec.height > limits.height || spec.depth > 1 ||
        pixels.bytes() > limits.bytes) {
        return "it has " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
               " texels, the limit is " + std::to_string(limits.width) + " x " +
               std::to_string(limits.height) + " and " + std::to_string(limits.bytes >> 20) + " MiB decoded";
    }
    std::byte* samples = allocate(pixels.bytes());
    Progressing progressing{progress, static_cast<double>(pixels.bytes())};
    constexpr OIIO::stride_t close = OIIO::AutoStride;
    const bool read = input.read_image(0, 0, 0, pixels.channels, typeOf(pixels.type), samples, close, close,
                                       close, &Progressing::tell, &progressing);
    if (read) return {};
    return orUnknown(input.geterror());
}

// The bytes of a file on disk. Where another program cuts the file off meanwhile, reading them is a bus
// error, which ends this process alone.
class MappedFile {
  public:
    explicit MappedFile(const std::string& path) {
        const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
        struct stat status {};
        if (descriptor < 0 || ::fstat(descriptor, &status) != 0) {
            why_ = std::strerror(errno);
        } else if (status.st_size > 0) {
            const auto size = static_cast<std::size_t>(status.st_size);
            void* mapped = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
            if (mapped == MAP_FAILED) {
                why_ = std::strerror(errno);
            } else {
                bytes_ = {static_cast<const std::byte*>(mapped), size};
            }
        }
        if (descriptor >= 0) ::close(descriptor);
    }
    ~MappedFile() {
        if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
    }
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    std::span<const std::byte> bytes() const { return bytes_; }
    const std::string& why() const { return why_; }  // it cannot be read; empty when it can

  private:
    std::span<const std::byte> bytes_;
    std::string why_;
};

// The exceptions of OpenImageIO and of the libraries below it end here.
template <typename Work>
std::string guarded(const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return "it needs more memory than it may take";
    } catch (const std::exception& error) {
        return orUnknown(error.what());
    }
}

OIIO::ImageSpec specOf(const PixelLayout& pixels) {
    OIIO::ImageSpec spec(pixels.width, pixels.height, pixels.channels, typeOf(pixels.type));
    if (pixels.channels <= 2) spec.channelnames = {"Y", "A"};
    spec.channelnames.resize(std::size_t(pixels.channels));
    spec.alpha_channel = pixels.channels == 2 || pixels.channels == 4 ? pixels.channels - 1 : -1;
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("oiio:ColorSpace", pixels.type == SampleType::float32 ? "Linear" : "sRGB");
    if (pixels.type == SampleType::float32) spec.attribute("compression", "zip");
    return spec;
}

}  // namespace

void limitThreads(int threads) {
    OIIO::attribute("threads", threads);
    OIIO::attribute("exr_threads", threads);
}

std::string decodeMemory(std::span<const std::byte> file, const PixelLimits& limits, PixelLayout& pixels,
                         const Allocate& allocate, const Progress& progress) {
    return guarded([&]() -> std::string {
        const std::string format = imageFormat(file);
        if (format.empty()) return "not an image of a known format";
        if (const std::string damage = findDamage(file, format); !damage.empty()) return damage;
        OIIO::Filesystem::IOMemReader reader(const_cast<std::byte*>(file.data()), file.size());
        // ImageInput::open would look for a file of that name on disk.
        const auto input = OIIO::ImageInput::create(format);
        if (!input || !input->supports("ioproxy"))
            return "OpenImageIO cannot read " + format + " from memory";
        input->set_ioproxy(&reader);
        OIIO::ImageSpec spec;
        if (!input->open("image." + format, spec, straightAlpha())) return orUnknown(input->geterror());
        return readPixels(*input, limits, pixels, allocate, progress);
    });
}

std::string decodeFile(const std::string& path, const PixelLimits& limits, PixelLayout& pixels,
                       const Allocate& allocate, const Progress& progress) {
    const MappedFile file(path);
    if (!file.why().empty()) return file.why();
    return decodeMemory(file.bytes(), limits, pixels, allocate, progress);
}

std::string encode(const std::string& format, const PixelLayout& pixels, std::span<const std::byte> samples,
                   const std::string& path) {
    return guarded([&] {
        const auto output = OIIO::ImageOutput::create(format);
        if (!output) return orUnknown(OIIO::geterror());
        const bool written = output->open(path, specOf(pixels)) &&
                             output->write_image(typeOf(pixels.type), samples.data()) && output->close();
        return written ? std::string() : orUnknown(output->geterror());
    });
}

}  // namespace cutis::codec
