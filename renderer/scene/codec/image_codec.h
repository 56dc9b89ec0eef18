// Image files through OpenImageIO: what the program `cutis-codec` does for cutis (see ../codec_client.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace cutis {

enum class SampleType : std::uint32_t { uint8, uint16, float32 };

// Pixels as a file has them: interleaved channels, row 0 at the top, alpha not multiplied into colour.
struct PixelLayout {
    int width = 0, height = 0, channels = 0;
    SampleType type = SampleType::uint8;  // decoded: uint8 for files of 8-bit integers, else float32
    bool isFloat = false;                 // decoded: the file holds floating-point numbers
    std::uint64_t bytes() const;          // of all samples
};

// What decoding refuses before it allocates.
struct PixelLimits {
    int width, height;
    int channels;         // those beyond it are not read
    std::uint64_t bytes;  // of all samples, decoded
};

namespace codec {

// Memory for so many bytes, where the samples shall lie.
using Allocate = std::function<std::byte*(std::uint64_t bytes)>;
// Told now and then, some 64 MB apart, how many bytes of samples are done.
using Progress = std::function<void(std::uint64_t decoded)>;

// So many threads for one image, whatever cores there are: each takes a stack and a heap of its own out of
// what the process may have. Before anything else here.
void limitThreads(int threads);

// Each returns why it failed, or nothing; none throws. The reader of a file is chosen by its content, among
// those of image_file.h: its name may be wrong, and OpenImageIO has readers of films and playlists, which
// open other files.
std::string decodeMemory(std::span<const std::byte> file, const PixelLimits&, PixelLayout&, const Allocate&,
                         const Progress&);
std::string decodeFile(const std::string& path, const PixelLimits&, PixelLayout&, const Allocate&,
                       const Progress&);
// Writes to `path`, whatever its name; `format` is an OpenImageIO format name ("png").
std::string encode(const std::string& format, const PixelLayout&, std::span<const std::byte> samples,
                   const std::string& path);

}  // namespace codec
}  // namespace cutis
