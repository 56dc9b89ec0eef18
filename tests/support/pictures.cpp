#include "tests/support/pictures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace cutis::test {

double valueAt(const Picture& picture, int x, int y, int c) {
    const std::size_t pixel = static_cast<std::size_t>(y) * picture.width + x;
    return picture.values.at(pixel * picture.channels + c);
}

glm::dvec3 rgbAt(const Picture& picture, int x, int y) {
    return {valueAt(picture, x, y, 0), valueAt(picture, x, y, 1), valueAt(picture, x, y, 2)};
}

double relativeL2(const Picture& picture, const Picture& reference) {
    if (picture.width != reference.width || picture.height != reference.height)
        throw std::runtime_error("pictures of different sizes");
    NormRatio ratio;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double expected = valueAt(reference, x, y, c);
                ratio.add(valueAt(picture, x, y, c) - expected, expected);
            }
    return ratio.value();
}

double worstDifference(const Picture& a, const Picture& b) {
    if (a.values.size() != b.values.size()) throw std::runtime_error("pictures of different sizes");
    double worst = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        const double difference = std::abs(double(a.values[i]) - b.values[i]);
        if (std::isnan(difference)) return difference;  // which no limit holds for
        worst = std::max(worst, difference);
    }
    return worst;
}

void addPicture(Picture& sum, const Picture& addend) {
    if (sum.values.empty()) {
        sum = addend;
        return;
    }
    if (sum.values.size() != addend.values.size()) throw std::runtime_error("pictures of different sizes");
    for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += addend.values[i];
}

std::size_t countNonfinite(const Picture& picture) {
    std::size_t count = 0;
    for (const float value : picture.values) count += std::isfinite(value) ? 0 : 1;
    return count;
}

double NormRatio::value() const {
    return std::sqrt(above_ / below_);
}

glm::dvec3 latLongDirection(double u, double v) {
    const double longitude = (u - 0.5) * 2 * std::numbers::pi;  // 0 at -Z, growing towards +X
    const double latitude = (0.5 - v) * std::numbers::pi;
    return {std::sin(longitude) * std::cos(latitude), std::sin(latitude),
            -std::cos(longitude) * std::cos(latitude)};
}

Picture makeEnvironment(int width, int height, const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
    Picture picture{width, height, 3, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 value = radiance(latLongDirection((x + 0.5) / width, (y + 0.5) / height));
            for (int c = 0; c < 3; ++c) picture.values.push_back(static_cast<float>(value[c]));
        }
    return picture;
}

}  // namespace cutis::test
