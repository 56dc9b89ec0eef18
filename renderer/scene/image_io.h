// Image files in memory and on disk, all through OpenImageIO (see codec_client.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene/codec/image_codec.h"
#include "renderer/scene/picture.h"
#include "renderer/scene/scene.h"

namespace cutis {

inline constexpr int kMaxImageSize = 16384;                          // texels along either side
inline constexpr std::size_t kMaxImageBytes = std::size_t(1) << 30;  // of one image, decoded

// Decodes a file in memory: 8-bit files as rgba8, as stored; deeper ones as rgba16f, as stored (NaN becomes
// 0, ±Inf the largest half). Grey and RGB are expanded, alpha is not premultiplied. `floatFile` tells whether
// the file holds floating-point, hence linear, values. Throws Error naming `name`.
Image decodeImage(std::span<const std::byte> file, const std::string& name, bool* floatFile = nullptr);

// Bytes of texels that decodeImage() will make of a file, by its header, at most those of one image; 0 where
// it has none.
std::uint64_t decodedBytes(std::span<const std::byte> file);

// A PNG file of an rgba8 image; RGB without alpha when the image is opaque. Throws Error.
std::vector<std::byte> encodePng(const Image& image);

// A file's pixels as float, with all its channels; 8-bit and 16-bit values in [0, 1] as stored. `integers`
// tells whether the file holds whole numbers. Throws Error; checks the limits before it decodes.
Picture readPixels(const std::filesystem::path& path, int maxWidth, int maxHeight, bool* integers = nullptr);

// Pixels in memory: interleaved channels, row 0 at the top.
struct Pixels {
    PixelLayout layout;
    std::vector<std::byte> samples;
};

// Writes a file in the format of the extension: PNG, or EXR as zip-compressed floats. Written atomically.
// Throws Error.
void writePixels(const std::filesystem::path& path, const Pixels& pixels);

}  // namespace cutis
