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

// Scene-linear float32 EXR (.exr), channels named Y, YA, RGB or RGBA by their number. Written atomically.
// Throws Error.
void writeExr(const std::filesystem::path& path, const Picture& picture);
// Exposed by 2^exposure, neutral tone curve, sRGB, 8 bits (.png). Colours are taken as premultiplied and
// shown over black. Written atomically. Throws Error.
void writePng(const std::filesystem::path& path, const Picture& linear, double exposure);
// Any format that OpenImageIO reads, with as many channels as the file has; integers as stored, in [0, 1] (a
// PNG stays sRGB). At most 16384 x 16384. Throws Error.
Picture readPicture(const std::filesystem::path& path);

}  // namespace cutis
