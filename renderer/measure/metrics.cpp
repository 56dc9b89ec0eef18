#include "renderer/measure/metrics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cutis {
namespace {

// Errors of neighbouring pixels go together, so that the jackknife leaves out whole tiles, spread over this
// many groups.
constexpr int kTile = 16, kGroups = 64;

struct Sums {
    double error = 0, reference = 0;  // Σ(a - r₁)(a - r₂), Σr₁r₂
    double ratio() const { return reference > 0 ? std::sqrt(std::max(error, 0.0) / reference) : 0; }
};

int groupOf(std::size_t pixel, int width) {
    const std::size_t column = pixel % width / kTile, row = pixel / width / kTile;
    // Golden-ratio steps in both directions put neighbouring tiles into different groups.
    const double place =
        0.6180339887498949 * static_cast<double>(column) + 0.7548776662466927 * static_cast<double>(row);
    return static_cast<int>((place - std::floor(place)) * kGroups);
}

double jackknifeError(const std::vector<Sums>& groups, const Sums& total) {
    std::vector<double> left;
    for (const Sums& group : groups) {
        if (group.reference == 0) continue;
        left.push_back(Sums{total.error - group.error, total.reference - group.reference}.ratio());
    }
    if (left.size() < 8) return 0;
    double mean = 0, squares = 0;
    for (double value : left) mean += value / static_cast<double>(left.size());
    for (double value : left) squares += (value - mean) * (value - mean);
    return std::sqrt(squares * static_cast<double>(left.size() - 1) / static_cast<double>(left.size()));
}

void checkSizes(const Picture& picture, const Picture& reference, const std::vector<bool>& covered) {
    const bool alike = picture.width == reference.width && picture.height == reference.height &&
                       covered.size() == static_cast<std::size_t>(picture.width) * picture.height;
    if (!alike || picture.channels < 3 || reference.channels < 3) {
        throw std::invalid_argument("pictures of different sizes cannot be compared");
    }
}

}  // namespace

std::vector<bool> coveredPixels(const Picture& coverage) {
    std::vector<bool> covered(static_cast<std::size_t>(coverage.width) * coverage.height);
    for (std::size_t i = 0; i < covered.size(); ++i) {
        covered[i] = coverage.values[(i + 1) * coverage.channels - 1] > 0;
    }
    return covered;
}

ErrorFigures compareToReference(const Picture& picture, const Reference& reference,
                                const std::vector<bool>& covered) {
    const Picture& mean = *reference.mean;
    const Picture& first = reference.first ? *reference.first : mean;
    const Picture& second = reference.second ? *reference.second : mean;
    for (const Picture* other : {&mean, &first, &second}) checkSizes(picture, *other, covered);
    ErrorFigures figures;
    Sums total;
    std::vector<Sums> groups(kGroups);
    std::vector<double> errors;
    double squares = 0, signedSum = 0, referenceSum = 0;
    for (std::size_t i = 0; i < covered.size(); ++i) {
        if (!covered[i]) continue;
        for (int c = 0; c < 3; ++c) {
            const double a = picture.values[i * picture.channels + c], r = mean.values[i * mean.channels + c];
            const double r1 = first.values[i * first.channels + c],
                         r2 = second.values[i * second.channels + c];
            if (!std::isfinite(a + r + r1 + r2)) {
                ++figures.nonfinite;
                continue;
            }
            Sums& group = groups[groupOf(i, picture.width)];
            group.error += (a - r1) * (a - r2);
            group.reference += r1 * r2;
            errors.push_back(std::abs(a - r));
            squares += (a - r1) * (a - r2);
            signedSum += a - r;
            referenceSum += r;
        }
    }
    figures.values = errors.size();
    if (errors.empty()) return figures;
    for (const Sums& group : groups) total = {total.error + group.error, total.reference + group.reference};
    const auto count = static_cast<double>(errors.size());
    figures.relativeL2 = total.ratio();
    figures.relativeL2Error = jackknifeError(groups, total);
    figures.rmse = std::sqrt(std::max(squares, 0.0) / count);
    figures.max = *std::max_element(errors.begin(), errors.end());
    const auto rank = errors.begin() + static_cast<std::ptrdiff_t>(std::ceil(0.99 * count)) - 1;
    std::nth_element(errors.begin(), rank, errors.end());
    if (referenceSum != 0) {
        figures.p99 = *rank * count / referenceSum;
        figures.bias = signedSum / referenceSum;
    }
    return figures;
}

Picture relativeErrorMap(const Picture& picture, const Picture& reference, const std::vector<bool>& covered) {
    checkSizes(picture, reference, covered);
    Picture map{picture.width, picture.height, 1, {}};
    map.values.resize(covered.size());
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < covered.size(); ++i) {
        if (!covered[i]) continue;
        double squares = 0;
        for (int c = 0; c < 3; ++c) {
            const double r = reference.values[i * reference.channels + c];
            const double apart = picture.values[i * picture.channels + c] - r;
            squares += apart * apart / 3;
            sum += std::isfinite(r) ? r / 3 : 0;
        }
        ++count;
        map.values[i] = static_cast<float>(std::sqrt(squares));
    }
    const double mean = count > 0 ? sum / static_cast<double>(count) : 0;
    for (float& value : map.values) value = mean > 0 ? static_cast<float>(value / mean) : 0;
    return map;
}

}  // namespace cutis
