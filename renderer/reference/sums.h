// What passes add up to, and what it says about the picture and its error. All of it is sums over passes, so
// that a run can end anywhere and another go on from there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/reference/reference.h"
#include "renderer/scene/picture.h"

namespace cutis::reference {

// Samples of one sequence in one pixel, added up. Radiance times coverage.
struct SampleSum {
    float picture[3] = {}, diffuse[3] = {}, coverage = 0;
};

struct PixelSum {
    SampleSum sequence[kSequences];
    float irradiance[3] = {};
};

class Sums {
  public:
    Sums(int width, int height)
        : width_(width), height_(height), rowPasses_(height), pixels_(std::size_t(width) * height) {}

    // Of the picture as a whole. Some rows may already have one more, where a pass was given up half-way.
    int passes() const;
    int passesOf(int row) const { return rowPasses_[row]; }
    // What one more pass found in a row, a sum a pixel. Different rows may be added at the same time.
    void addRow(int row, const std::vector<PixelSum>& found);

    // Means over all sequences (half -1), or over the even (0) or odd (1) ones.
    Picture picture(int half = -1) const;  // RGBA
    Picture diffuse(int half = -1) const;
    Picture specular() const;  // what of the picture is not diffuse
    Picture irradiance() const;

    // Standard error of one pixel's mean: √(s²/n) with the sample variance s² of the n sequences' means.
    Picture standardError() const;
    Picture diffuseStandardError() const;
    // √(Σ error²) / √(Σ value²) over all pixels and channels, the values' own noise taken off; 0 for a black
    // picture.
    double pictureError() const;
    double diffuseError() const;

    std::vector<std::byte> toBytes() const;
    // False, and nothing changed, where the bytes are not those of sums of this size.
    bool fromBytes(std::span<const std::byte> bytes);

  private:
    using Channels = float (SampleSum::*)[3];
    struct Estimate {
        double mean, varianceOfMean;
    };
    Estimate estimate(std::size_t pixel, Channels channels, int c) const;
    double samplesOf(std::size_t pixel, int half) const;
    Picture meanOf(Channels channels, int half) const;
    Picture errorOf(Channels channels) const;
    double relativeError(Channels channels) const;

    int width_, height_;
    std::vector<std::int32_t> rowPasses_;
    std::vector<PixelSum> pixels_;
};

}  // namespace cutis::reference
