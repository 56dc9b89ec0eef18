// Image files through OpenImageIO, as a table of functions in a module that is loaded at its first use.
//
// Debian's libOpenImageIO brings 250 libraries and takes 0.3 s and 130 MB to load, which commands that touch
// no image, and hundreds of test processes, should not pay. The module shares no state with cutis and throws
// nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cutis {

enum class SampleType { uint8, uint16, float32 };

// Pixels as a file has them: interleaved channels, row 0 at the top, alpha not multiplied into colour.
struct Pixels {
    int width = 0, height = 0, channels = 0;
    SampleType type = SampleType::uint8;  // decoded: uint8 for files of 8-bit integers, else float32
    bool isFloat = false;                 // decoded: the file holds floating-point numbers
    std::vector<std::byte> samples;       // width · height · channels of `type`
};

// What decoding refuses before it allocates.
struct PixelLimits {
    int width, height;
    int channels;         // those beyond it are not read
    std::uint64_t bytes;  // of all samples, decoded
};

struct ImageCodec {
    // Each returns why it failed, or nothing. `format` is an OpenImageIO format name ("png").
    std::string (*decodeMemory)(std::span<const std::byte> file, const std::string& format,
                                const PixelLimits&, Pixels&);
    std::string (*decodeFile)(const std::string& path, const PixelLimits&, Pixels&);
    std::string (*encodePng)(const Pixels&, std::vector<std::byte>& file);
    std::string (*writeFile)(const std::string& path, const Pixels&);  // in the format of the extension
};

}  // namespace cutis

// The module's one symbol.
extern "C" const cutis::ImageCodec* cutisImageCodec();
