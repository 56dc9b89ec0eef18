// Float images of the data maker.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

namespace cutis::people {

// Interleaved floats, row 0 at the top. Colours are linear unless a name says otherwise.
struct Raster {
    int width = 0, height = 0, channels = 3;
    std::vector<float> values;

    Raster() = default;
    Raster(int w, int h, int c) : width(w), height(h), channels(c), values(std::size_t(w) * h * c) {}
    float* at(int x, int y) { return &values[(std::size_t(y) * width + x) * channels]; }
    const float* at(int x, int y) const { return &values[(std::size_t(y) * width + x) * channels]; }
};

double decodeSrgb(double encoded);
double encodeSrgb(double linear);

// An 8-bit image with its colours (the first three channels) decoded to linear. Throws Error.
Raster readColors(const std::filesystem::path& path);
// The same from an image file that starts `offset` bytes into a gzip-compressed file. Throws Error.
Raster readPackedColors(const std::filesystem::path& gzipFile, std::size_t offset);

// 8 bits a channel. `srgb` encodes the first three channels; without it values are stored as they are. Throws
// Error.
void writePng8(const std::filesystem::path& path, const Raster& image, bool srgb);

// Lanczos-3 at texture coordinates in [0,1], clamped at the border and to the range of the nearest texels, so
// that it does not ring.
glm::dvec3 sampleLanczos(const Raster& image, glm::dvec2 uv);

}  // namespace cutis::people
