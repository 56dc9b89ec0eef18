#include "renderer/measure/flip.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cutis {
namespace {

Picture uniform(int size, float r, float g, float b) {
    Picture picture{size, size, 3, {}};
    for (int i = 0; i < size * size; ++i) picture.values.insert(picture.values.end(), {r, g, b});
    return picture;
}

TEST(Flip, OfAPictureAndItselfIsZero) {
    Picture picture = uniform(32, 0.2f, 0.5f, 0.3f);
    for (std::size_t i = 0; i < picture.values.size(); i += 7) picture.values[i] = 0.9f;
    EXPECT_EQ(meanOf(flipMap(picture, picture)), 0);
}

// Uniform pictures have no features, and the filters change nothing: what is left is the colour difference by
// hand. Black and white: 100^0.7 = 25.119 lies beyond the bend at 0.4 · 203.3^0.7 = 16.5.
TEST(Flip, OfUniformColoursIsTheirRemappedDifference) {
    const double largest = std::pow(203.3, 0.7), bend = 0.4 * largest;
    const double expected = 0.95 + (std::pow(100, 0.7) - bend) / (largest - bend) * 0.05;
    EXPECT_NEAR(meanOf(flipMap(uniform(24, 0, 0, 0), uniform(24, 1, 1, 1))), expected, 1e-3);
    EXPECT_NEAR(meanOf(flipMap(uniform(24, 0, 1, 0), uniform(24, 0, 0, 1))), 1, 1e-6);
    // Greys of L* 50 and 51: below the bend.
    const auto luminance = [](double l) { return static_cast<float>(std::pow((l + 16) / 116, 3)); };
    EXPECT_NEAR(meanOf(flipMap(uniform(24, luminance(50), luminance(50), luminance(50)),
                               uniform(24, luminance(51), luminance(51), luminance(51)))),
                0.95 / bend, 1e-4);
}

// A chequerboard finer than the eye resolves looks like its mean.
TEST(Flip, SeesNoDifferenceBelowTheEyesResolution) {
    Picture board = uniform(64, 0, 0, 0);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) board.values[(y * 64 + x) * 3 + c] = (x + y) % 2 ? 0.6f : 0.4f;
    const Picture mean = uniform(64, 0.5f, 0.5f, 0.5f);
    const double far = flipMap(board, mean, 400).values[32 * 64 + 32],
                 near = flipMap(board, mean, 8).values[32 * 64 + 32];
    EXPECT_LT(far, 0.02);
    EXPECT_GT(near, 0.1);
}

// An edge that is missing counts for more than the same difference in colour spread out.
TEST(Flip, FeaturesRaiseTheDifference) {
    Picture edge = uniform(64, 0.5f, 0.5f, 0.5f);
    for (int y = 0; y < 64; ++y)
        for (int x = 32; x < 64; ++x)
            for (int c = 0; c < 3; ++c) edge.values[(y * 64 + x) * 3 + c] = 0.6f;
    const Picture map = flipMap(edge, uniform(64, 0.5f, 0.5f, 0.5f));
    EXPECT_GT(map.values[32 * 64 + 33], 1.1 * map.values[32 * 64 + 60]);
    EXPECT_NEAR(map.values[32 * 64 + 4], 0, 1e-3);
    for (float value : map.values) ASSERT_TRUE(value >= 0 && value <= 1);
}

TEST(Flip, RefusesDifferentSizes) {
    EXPECT_THROW(flipMap(uniform(4, 0, 0, 0), uniform(5, 0, 0, 0)), std::invalid_argument);
}

}  // namespace
}  // namespace cutis
