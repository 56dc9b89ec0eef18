#include "renderer/measure/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "renderer/core/parallel.h"
#include "renderer/scene/tonemap.h"

namespace cutis {
namespace {

constexpr double kPi = std::numbers::pi;
// Section 4 and its supplement: exponents and the remapping of colour differences.
constexpr double kColorExponent = 0.7, kFeatureExponent = 0.5;
constexpr double kRemapAt = 0.4, kRemapTo = 0.95;
constexpr double kFeatureWidth = 0.082;  // degrees

using Plane = std::vector<glm::dvec3>;

// Linear Rec.709 to CIE XYZ under D65 (IEC 61966-2-1).
glm::dvec3 toXyz(const glm::dvec3& rgb) {
    return {0.4124564 * rgb.r + 0.3575761 * rgb.g + 0.1804375 * rgb.b,
            0.2126729 * rgb.r + 0.7151522 * rgb.g + 0.0721750 * rgb.b,
            0.0193339 * rgb.r + 0.1191920 * rgb.g + 0.9503041 * rgb.b};
}

glm::dvec3 toRgb(const glm::dvec3& xyz) {
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

const glm::dvec3 kWhite = toXyz({1, 1, 1});

// The linear opponent space YCxCz of Zhang & Wandell, in which contrast sensitivity is known.
glm::dvec3 toOpponent(const glm::dvec3& rgb) {
    const glm::dvec3 v = toXyz(rgb) / kWhite;
    return {116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)};
}

glm::dvec3 fromOpponent(const glm::dvec3& opponent) {
    const double y = (opponent.x + 16) / 116;
    return toRgb(glm::dvec3(y + opponent.y / 500, y, y - opponent.z / 200) * kWhite);
}

// CIELAB with chroma scaled by lightness (Hunt's effect).
glm::dvec3 toHuntLab(const glm::dvec3& rgb) {
    const auto curve = [](double t) {
        constexpr double kDelta = 6.0 / 29;
        return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
    };
    const glm::dvec3 v = toXyz(rgb) / kWhite;
    const double fx = curve(v.x), fy = curve(v.y), fz = curve(v.z), lightness = 116 * fy - 16;
    return {lightness, 0.01 * lightness * 500 * (fx - fy), 0.01 * lightness * 200 * (fy - fz)};
}

double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

void forRows(int height, const std::function<void(int)>& row) {
    parallelFor(static_cast<std::size_t>(height), [&](std::size_t y) { row(static_cast<int>(y)); });
}

// Weights of the 2r+1 taps of a separable filter, one set a channel.
using Kernel = std::vector<glm::dvec3>;

// Both directions of a filter, rows by `across` and columns by `down`; the edge's pixels repeat outside.
Plane convolve(const Plane& plane, int width, int height, const Kernel& across, const Kernel& down) {
    Plane rows(plane.size()), result(plane.size());
    const int radius = static_cast<int>(across.size() / 2);
    forRows(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            glm::dvec3 sum(0);
            for (int i = -radius; i <= radius; ++i) {
                sum += across[i + radius] * plane[std::size_t(y) * width + std::clamp(x + i, 0, width - 1)];
            }
            rows[std::size_t(y) * width + x] = sum;
        }
    });
    forRows(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            glm::dvec3 sum(0);
            for (int i = -radius; i <= radius; ++i) {
                sum += down[i + radius] * rows[std::size_t(std::clamp(y + i, 0, height - 1)) * width + x];
            }
            result[std::size_t(y) * width + x] = sum;
        }
    });
    return result;
}

// A channel's contrast sensitivity is the sum of two Gaussians a·√(π/b)·exp(-π²(x² + y²)/b), x and y in
// degrees (table 1): a term's weight along each of the two directions is the root of its factor.
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity kLuminance{1, 0.0047, 0, 1e-5}, kRedGreen{1, 0.0053, 0, 1e-5},
    kBlueYellow{34.1, 0.04, 13.5, 0.025};

// What the eye resolves of an opponent plane.
Plane filterContrast(const Plane& opponent, int width, int height, double pixelsPerDegree) {
    constexpr double kWidest = 0.04;
    const int radius =
        static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * pixelsPerDegree));
    const auto term = [&](double a, double b, double x) {
        return std::sqrt(a * std::sqrt(kPi / b)) * std::exp(-kPi * kPi * x * x / b);
    };
    Kernel first, second;
    for (int i = -radius; i <= radius; ++i) {
        const double x = i / pixelsPerDegree;
        first.push_back({term(kLuminance.a1, kLuminance.b1, x), term(kRedGreen.a1, kRedGreen.b1, x),
                         term(kBlueYellow.a1, kBlueYellow.b1, x)});
        second.push_back({0, 0, term(kBlueYellow.a2, kBlueYellow.b2, x)});
    }
    glm::dvec3 firstSum(0), secondSum(0);
    for (const glm::dvec3& weight : first) firstSum += weight;
    for (const glm::dvec3& weight : second) secondSum += weight;
    const glm::dvec3 total = firstSum * firstSum + secondSum * secondSum;
    Plane result = convolve(opponent, width, height, first, first);
    const Plane wide = convolve(opponent, width, height, second, second);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = (result[i] + wide[i]) / total;
    return result;
}

// Hunt-adjusted colour as the eye resolves it.
Plane perceivedColor(const Plane& opponent, int width, int height, double pixelsPerDegree) {
    Plane colors = filterContrast(opponent, width, height, pixelsPerDegree);
    for (glm::dvec3& color : colors) color = toHuntLab(glm::clamp(fromOpponent(color), 0.0, 1.0));
    return colors;
}

// Strengths of edges (x) and points (y) in the luminance of an opponent plane.
std::vector<glm::dvec2> findFeatures(const Plane& opponent, int width, int height, double pixelsPerDegree) {
    const double deviation = 0.5 * kFeatureWidth * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    // x: smoothing, y: first derivative, z: second derivative.
    Kernel kernel;
    glm::dvec3 positive(0), negative(0);
    for (int x = -radius; x <= radius; ++x) {
        const double g = std::exp(-x * x / (2 * deviation * deviation));
        const glm::dvec3 weights(g, -x * g, (x * x / (deviation * deviation) - 1) * g);
        kernel.push_back(weights);
        positive += glm::max(weights, 0.0);
        negative -= glm::min(weights, 0.0);
    }
    // Positive and negative weights of a derivative sum to 1 each, so that strengths lie in [0, 1].
    for (glm::dvec3& weights : kernel) {
        for (int c = 0; c < 3; ++c) weights[c] /= weights[c] >= 0 ? positive[c] : negative[c];
    }
    Kernel smooth, derive;
    for (const glm::dvec3& weights : kernel) {
        smooth.push_back({weights.x, weights.x, 0});
        derive.push_back({weights.y, weights.z, 0});
    }
    Plane luminance(opponent.size());
    for (std::size_t i = 0; i < luminance.size(); ++i) luminance[i] = glm::dvec3((opponent[i].x + 16) / 116);
    const Plane alongX = convolve(luminance, width, height, derive, smooth);
    const Plane alongY = convolve(luminance, width, height, smooth, derive);
    std::vector<glm::dvec2> features(opponent.size());
    for (std::size_t i = 0; i < features.size(); ++i) {
        features[i] = {std::hypot(alongX[i].x, alongY[i].x), std::hypot(alongX[i].y, alongY[i].y)};
    }
    return features;
}

// Large colour differences are compressed into the last twentieth of [0, 1].
double remapColorDifference(double difference) {
    static const double kLargest = std::pow(hyab(toHuntLab({0, 1, 0}), toHuntLab({0, 0, 1})), kColorExponent);
    const double bend = kRemapAt * kLargest;
    return difference < bend ? difference * kRemapTo / bend
                             : kRemapTo + (difference - bend) / (kLargest - bend) * (1 - kRemapTo);
}

Plane opponentPlane(const Picture& picture) {
    Plane plane(std::size_t(picture.width) * picture.height);
    for (std::size_t i = 0; i < plane.size(); ++i) {
        glm::dvec3 rgb;
        for (int c = 0; c < 3; ++c) rgb[c] = picture.values[i * picture.channels + c];
        plane[i] = toOpponent(glm::clamp(rgb, 0.0, 1.0));
    }
    return plane;
}

}  // namespace

Picture flipMap(const Picture& picture, const Picture& reference, double pixelsPerDegree) {
    const int width = picture.width, height = picture.height;
    if (width != reference.width || height != reference.height || picture.channels < 3 ||
        reference.channels < 3) {
        throw std::invalid_argument("pictures of different sizes cannot be compared");
    }
    const Plane first = opponentPlane(picture), second = opponentPlane(reference);
    const Plane firstColors = perceivedColor(first, width, height, pixelsPerDegree);
    const Plane secondColors = perceivedColor(second, width, height, pixelsPerDegree);
    const std::vector<glm::dvec2> firstFeatures = findFeatures(first, width, height, pixelsPerDegree);
    const std::vector<glm::dvec2> secondFeatures = findFeatures(second, width, height, pixelsPerDegree);
    Picture map{width, height, 1, {}};
    for (std::size_t i = 0; i < first.size(); ++i) {
        const double color =
            remapColorDifference(std::pow(hyab(firstColors[i], secondColors[i]), kColorExponent));
        const glm::dvec2 apart = glm::abs(firstFeatures[i] - secondFeatures[i]);
        const double feature = std::pow(std::max(apart.x, apart.y) / std::numbers::sqrt2, kFeatureExponent);
        map.values.push_back(static_cast<float>(std::pow(color, 1 - feature)));
    }
    return map;
}

double meanOf(const Picture& map) {
    double sum = 0;
    for (float value : map.values) sum += value;
    return map.values.empty() ? 0 : sum / static_cast<double>(map.values.size());
}

Picture displayLight(const Picture& sceneLinear, double exposure) {
    Picture shown{sceneLinear.width, sceneLinear.height, 3, {}};
    shown.values.resize(std::size_t(shown.width) * shown.height * 3);
    const auto scale = static_cast<float>(std::exp2(exposure));
    for (std::size_t i = 0; i < shown.values.size() / 3; ++i) {
        const float* from = &sceneLinear.values[i * sceneLinear.channels];
        const glm::vec3 color = toneMapNeutral(scale * glm::vec3(from[0], from[1], from[2]));
        for (int c = 0; c < 3; ++c) shown.values[i * 3 + c] = std::clamp(color[c], 0.0f, 1.0f);
    }
    return shown;
}

}  // namespace cutis
