// A picture in memory and on disk.
#pragma once

#include <filesystem>
#include <vector>

namespace cutis {

// Float channels, interleaved, row 0 at the top.
struct Picture {
    int width = 0, height = 0, channels = 4;
    std::vector<float> values;  // width · height · channels
};

// Scene-linear float32 EXR (.exr). Written atomically. Throws Error.
void writeExr(const std::filesystem::path& path, const Picture& picture);
// Exposed by 2^exposure, neutral tone curve, sRGB, 8 bits (.png). Written atomically. Throws Error.
void writePng(const std::filesystem::path& path, const Picture& linear, double exposure);
// Any format that OpenImageIO reads, as float RGBA or as many channels as the file has. Throws Error.
Picture readPicture(const std::filesystem::path& path);

}  // namespace cutis
