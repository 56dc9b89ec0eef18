#include "renderer/reference/sums.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace cutis::reference {
namespace {

struct Header {
    std::uint32_t version, width, height, sequences;
    std::uint64_t pixels;  // that are not all zero and follow, each after its index
};
constexpr std::uint32_t kVersion = 3;

// Sequences of a half, or all of them.
bool belongs(int sequence, int half) {
    return half < 0 || sequence % 2 == half;
}

}  // namespace

int Sums::passes() const {
    return *std::min_element(rowPasses_.begin(), rowPasses_.end());
}

double Sums::samplesOf(std::size_t pixel, int half) const {
    return double(rowPasses_[pixel / width_]) * kSamplesPerPass / (half < 0 ? 1 : 2);
}

void Sums::addRow(int row, const std::vector<PixelSum>& found) {
    for (int x = 0; x < width_; ++x) {
        PixelSum& pixel = pixels_[std::size_t(row) * width_ + x];
        for (int s = 0; s < kSequences; ++s) {
            SampleSum& to = pixel.sequence[s];
            const SampleSum& from = found[x].sequence[s];
            to.coverage += from.coverage;
            for (int c = 0; c < 3; ++c) to.picture[c] += from.picture[c], to.diffuse[c] += from.diffuse[c];
        }
        for (int c = 0; c < 3; ++c) pixel.irradiance[c] += found[x].irradiance[c];
    }
    ++rowPasses_[row];
}

Picture Sums::meanOf(Channels channels, int half) const {
    Picture result{width_, height_, 3, std::vector<float>(pixels_.size() * 3)};
    for (std::size_t i = 0; passes() > 0 && i < pixels_.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            double sum = 0;
            for (int s = 0; s < kSequences; ++s) {
                if (belongs(s, half)) sum += (pixels_[i].sequence[s].*channels)[c];
            }
            result.values[i * 3 + c] = static_cast<float>(sum / samplesOf(i, half));
        }
    }
    return result;
}

Picture Sums::picture(int half) const {
    const Picture rgb = meanOf(&SampleSum::picture, half);
    Picture result{width_, height_, 4, std::vector<float>(pixels_.size() * 4)};
    for (std::size_t i = 0; passes() > 0 && i < pixels_.size(); ++i) {
        std::copy_n(&rgb.values[i * 3], 3, &result.values[i * 4]);
        double coverage = 0;
        for (int s = 0; s < kSequences; ++s) {
            if (belongs(s, half)) coverage += pixels_[i].sequence[s].coverage;
        }
        coverage /= samplesOf(i, half);
        // Sums of floats that should be one may miss it by a rounding.
        result.values[i * 4 + 3] = coverage > 1 - 1e-6 ? 1.f : static_cast<float>(coverage);
    }
    return result;
}

Picture Sums::diffuse(int half) const {
    return meanOf(&SampleSum::diffuse, half);
}

Picture Sums::specular() const {
    Picture result = meanOf(&SampleSum::picture, -1);
    const Picture matte = diffuse();
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        // What is left of two roundings to float where nothing reflects is no light.
        const float left = result.values[i] - matte.values[i];
        result.values[i] = left > 1e-6f * matte.values[i] ? left : 0;
    }
    return result;
}

Picture Sums::irradiance() const {
    Picture result{width_, height_, 3, std::vector<float>(pixels_.size() * 3)};
    for (std::size_t i = 0; passes() > 0 && i < pixels_.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            result.values[i * 3 + c] = static_cast<float>(pixels_[i].irradiance[c] / samplesOf(i, -1));
        }
    }
    return result;
}

Sums::Estimate Sums::estimate(std::size_t pixel, Channels channels, int c) const {
    const double perSequence = std::max(samplesOf(pixel, -1) / kSequences, 1.0);
    double sum = 0, squares = 0;
    for (const SampleSum& sequence : pixels_[pixel].sequence) sum += (sequence.*channels)[c] / perSequence;
    const double mean = sum / kSequences;
    for (const SampleSum& sequence : pixels_[pixel].sequence) {
        const double apart = (sequence.*channels)[c] / perSequence - mean;
        squares += apart * apart;
    }
    return {mean, squares / (kSequences - 1) / kSequences};
}

Picture Sums::errorOf(Channels channels) const {
    Picture result{width_, height_, 3, std::vector<float>(pixels_.size() * 3)};
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            result.values[i * 3 + c] = static_cast<float>(std::sqrt(estimate(i, channels, c).varianceOfMean));
        }
    }
    return result;
}

Picture Sums::standardError() const {
    return errorOf(&SampleSum::picture);
}

Picture Sums::diffuseStandardError() const {
    return errorOf(&SampleSum::diffuse);
}

double Sums::relativeError(Channels channels) const {
    double error2 = 0, value2 = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const Estimate e = estimate(i, channels, c);
            error2 += e.varianceOfMean;
            value2 += e.mean * e.mean - e.varianceOfMean;  // E[mean²] = value² + variance
        }
    }
    return value2 > 0 ? std::sqrt(error2 / value2) : 0;
}

double Sums::pictureError() const {
    return relativeError(&SampleSum::picture);
}

double Sums::diffuseError() const {
    return relativeError(&SampleSum::diffuse);
}

std::vector<std::byte> Sums::toBytes() const {
    const PixelSum black{};
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        if (std::memcmp(&pixels_[i], &black, sizeof black) != 0)
            kept.push_back(static_cast<std::uint32_t>(i));
    }
    const Header header{kVersion, static_cast<std::uint32_t>(width_), static_cast<std::uint32_t>(height_),
                        kSequences, kept.size()};
    std::vector<std::byte> bytes(sizeof header + rowPasses_.size() * sizeof(std::int32_t) +
                                 kept.size() * (sizeof(std::uint32_t) + sizeof(PixelSum)));
    std::byte* to = bytes.data();
    const auto put = [&to](const void* from, std::size_t size) {
        std::memcpy(to, from, size);
        to += size;
    };
    put(&header, sizeof header);
    put(rowPasses_.data(), rowPasses_.size() * sizeof(std::int32_t));
    for (std::uint32_t i : kept) {
        put(&i, sizeof i);
        put(&pixels_[i], sizeof(PixelSum));
    }
    return bytes;
}

bool Sums::fromBytes(std::span<const std::byte> bytes) {
    Header header{};
    if (bytes.size() < sizeof header) return false;
    std::memcpy(&header, bytes.data(), sizeof header);
    const std::size_t start = sizeof header + rowPasses_.size() * sizeof(std::int32_t);
    constexpr std::size_t kEntry = sizeof(std::uint32_t) + sizeof(PixelSum);
    if (header.version != kVersion || header.width != static_cast<std::uint32_t>(width_) ||
        header.height != static_cast<std::uint32_t>(height_) || header.sequences != kSequences ||
        header.pixels > pixels_.size() || bytes.size() != start + header.pixels * kEntry) {
        return false;
    }
    std::vector<PixelSum> pixels(pixels_.size());
    for (std::uint64_t k = 0; k < header.pixels; ++k) {
        const std::byte* from = bytes.data() + start + k * kEntry;
        std::uint32_t index = 0;
        std::memcpy(&index, from, sizeof index);
        if (index >= pixels.size()) return false;
        std::memcpy(&pixels[index], from + sizeof index, sizeof(PixelSum));
    }
    pixels_ = std::move(pixels);
    std::memcpy(rowPasses_.data(), bytes.data() + sizeof header, start - sizeof header);
    return true;
}

}  // namespace cutis::reference
