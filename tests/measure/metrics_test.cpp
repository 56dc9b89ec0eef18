#include "renderer/measure/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace cutis {
namespace {

Picture makePicture(int width, int height, float value) {
    return {width, height, 3, std::vector<float>(std::size_t(width) * height * 3, value)};
}

std::vector<bool> all(const Picture& picture) {
    return std::vector<bool>(std::size_t(picture.width) * picture.height, true);
}

TEST(Metrics, OfAConstantOffset) {
    const Picture reference = makePicture(8, 4, 2);
    const ErrorFigures figures =
        compareToReference(makePicture(8, 4, 2.5f), {.mean = &reference}, all(reference));
    EXPECT_NEAR(figures.relativeL2, 0.25, 1e-12);
    EXPECT_NEAR(figures.rmse, 0.5, 1e-12);
    EXPECT_NEAR(figures.max, 0.5, 1e-12);
    EXPECT_NEAR(figures.p99, 0.25, 1e-12);
    EXPECT_NEAR(figures.bias, 0.25, 1e-12);
    EXPECT_EQ(figures.nonfinite, 0u);
    EXPECT_EQ(figures.values, 96u);
}

TEST(Metrics, PercentileLeavesTheWorstHundredthOut) {
    const Picture reference = makePicture(10, 10, 1);
    Picture picture = reference;
    for (int c = 0; c < 3; ++c) picture.values[c] = 4;  // one pixel of a hundred
    EXPECT_NEAR(compareToReference(picture, {.mean = &reference}, all(reference)).p99, 0, 1e-12);
    picture.values[3] = 2;  // and one value more
    const ErrorFigures figures = compareToReference(picture, {.mean = &reference}, all(reference));
    EXPECT_NEAR(figures.p99, 1, 1e-12);
    EXPECT_NEAR(figures.max, 3, 1e-12);
}

TEST(Metrics, OnlyCoveredPixelsCountAndNonfiniteOnesAreCounted) {
    Picture coverage{2, 2, 4, std::vector<float>(16, 0)};
    coverage.values[3] = 1, coverage.values[7] = 0.25f, coverage.values[11] = 0.5f;
    const std::vector<bool> covered = coveredPixels(coverage);
    EXPECT_EQ(covered, (std::vector<bool>{true, true, true, false}));
    const Picture reference = makePicture(2, 2, 1);
    Picture picture = reference;
    picture.values[1] = std::numeric_limits<float>::quiet_NaN();
    picture.values[11] = 100;  // not covered
    const ErrorFigures figures = compareToReference(picture, {.mean = &reference}, covered);
    EXPECT_EQ(figures.nonfinite, 1u);
    EXPECT_EQ(figures.values, 8u);
    EXPECT_EQ(figures.max, 0);
}

// The reference's own noise, 10 % a value, would add √0.5 · 10 % to an error of 2 % measured against the mean
// of the halves; against both halves it does not.
TEST(Metrics, HalvesTakeTheReferencesNoiseOut) {
    constexpr int kSize = 256;
    std::mt19937 random(7);
    std::normal_distribution<float> noise(0, 0.1f), error(0, 0.02f);
    Picture picture = makePicture(kSize, kSize, 1), first = picture, second = picture, mean = picture;
    for (std::size_t i = 0; i < picture.values.size(); ++i) {
        picture.values[i] += error(random), first.values[i] += noise(random),
            second.values[i] += noise(random);
        mean.values[i] = (first.values[i] + second.values[i]) / 2;
    }
    const ErrorFigures naive = compareToReference(picture, {.mean = &mean}, all(mean));
    const ErrorFigures honest =
        compareToReference(picture, {.mean = &mean, .first = &first, .second = &second}, all(mean));
    EXPECT_NEAR(naive.relativeL2, std::sqrt(0.02 * 0.02 + 0.1 * 0.1 / 2), 0.001);
    // Σ of 196,608 products of noise: the square's standard error is 0.01/443, the root's 5.6e-4.
    EXPECT_NEAR(honest.relativeL2Error, 5.6e-4, 2e-4);
    EXPECT_NEAR(honest.relativeL2, 0.02, 3 * honest.relativeL2Error);
}

TEST(Metrics, ErrorMapIsOverTheMean) {
    const Picture reference = makePicture(2, 1, 4);
    Picture picture = reference;
    picture.values[0] = picture.values[1] = picture.values[2] = 5;
    const Picture map = relativeErrorMap(picture, reference, all(reference));
    EXPECT_NEAR(map.values[0], 0.25, 1e-6);
    EXPECT_EQ(map.values[1], 0);
}

TEST(Metrics, RefusesDifferentSizes) {
    const Picture reference = makePicture(2, 2, 1);
    EXPECT_THROW(compareToReference(makePicture(4, 1, 1), {.mean = &reference}, all(reference)),
                 std::invalid_argument);
}

}  // namespace
}  // namespace cutis
