// How far a picture is from its reference.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/scene/picture.h"

namespace cutis {

// Figures over the red, green and blue values of the pixels compared. A value that is not finite, in the
// picture or in its reference, counts in `nonfinite` and in nothing else.
struct ErrorFigures {
    double relativeL2 = 0;  // √(Σ(a - r)² / Σr²)
    double relativeL2Error =
        0;            // standard error of it, by a jackknife over tiles of the picture; 0: not known
    double rmse = 0;  // √ of the mean of (a - r)²
    double max = 0;   // largest |a - r|
    double p99 = 0;   // 99th percentile of |a - r|, over the mean of r
    double bias = 0;  // mean of a - r, over the mean of r
    std::uint64_t nonfinite = 0;
    std::size_t values = 0;  // compared
};

// A picture's reference: its best estimate, and two independent halves of it where there are any. The product
// of the errors against both halves has the mean of the true squared error, since their own noise is
// independent.
struct Reference {
    const Picture* mean = nullptr;
    const Picture *first = nullptr, *second = nullptr;  // both or neither
};

// Which pixels count: those that `coverage`, the alpha of its last channel, shows at least in part.
std::vector<bool> coveredPixels(const Picture& coverage);

// Compares the colours of `picture` and its reference (three or four channels, equal size) where `covered`
// says so. With halves relativeL2 is √(Σ(a - r₁)(a - r₂) / Σr₁r₂), 0 where the estimate of the square is
// negative; max and p99 are against the mean. Throws std::invalid_argument when sizes differ.
ErrorFigures compareToReference(const Picture& picture, const Reference& reference,
                                const std::vector<bool>& covered);

// |a - r| of each pixel, over the mean of r over the pixels that count: what an error map shows. 0 elsewhere.
Picture relativeErrorMap(const Picture& picture, const Picture& reference, const std::vector<bool>& covered);

}  // namespace cutis
