// The tile of pores, and the row of two lobes.
#include "renderer/skin/detail.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/skin/specular.h"

namespace cutis::skin {
namespace {

TEST(DetailTile, HasTheStatedVarianceInEveryDirection) {
    const DetailTile& tile = detailTile();
    EXPECT_NEAR(tile.variance[0], kDetailVariance, 1e-6);
    glm::dvec2 mean(0), square(0);
    double mixed = 0;
    for (const glm::vec2& slope : tile.slopes[0]) {
        mean += glm::dvec2(slope);
        square += glm::dvec2(slope) * glm::dvec2(slope);
        mixed += double(slope.x) * slope.y;
    }
    const double count = double(tile.slopes[0].size());
    // A tile that repeats rises as much as it falls.
    EXPECT_LT(glm::length(mean / count), 1e-5);
    // By the same in x, in y and along the diagonals, to what 400 plates allow.
    EXPECT_NEAR(square.x / square.y, 1, 0.15);
    EXPECT_LT(std::abs(mixed) / (square.x + square.y), 0.05);
}

TEST(DetailTile, CoarserLevelsAreMeansAndFadeToNothing) {
    const DetailTile& tile = detailTile();
    for (int level = 1; level < kDetailLevels; ++level) {
        EXPECT_EQ(tile.slopes[level].size(), tile.slopes[level - 1].size() / 4);
        EXPECT_LE(tile.variance[level], tile.variance[level - 1]);
    }
    EXPECT_LT(tile.variance[kDetailLevels - 1], 1e-9);
    // kDetailWidest: from level 5 on nothing is missed.
    EXPECT_LT(tile.variance[5], 0.01 * tile.variance[0]);
}

// What a lookup between levels shows, from its formula and from the slopes themselves: to 4 % of all that
// there is, which is 1 % of the m² of a roughness of 0.3.
TEST(DetailTile, VarianceBetweenLevelsIsWhatLookupsShow) {
    const DetailTile& tile = detailTile();
    for (const double level : {0.0, 0.5, 1.3, 2.7}) {
        constexpr int kSide = 512;
        double sum = 0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const glm::dvec2 slope = tile.lookUp(level, (glm::dvec2(x, y) + 0.37) / double(kSide));
                sum += glm::dot(slope, slope);
            }
        EXPECT_NEAR(sum / (kSide * kSide), tile.varianceAt(level), 0.04 * kDetailVariance) << level;
    }
}

TEST(DetailTile, IsPeriodicAndTheSameEverywhere) {
    const DetailTile& tile = detailTile();
    const glm::dvec2 place(0.137, 0.731);
    EXPECT_LT(glm::distance(tile.lookUp(0, place), tile.lookUp(0, place + glm::dvec2(3, -2))), 1e-9);
    // No jump across the border of the tile: neighbours there differ as neighbours elsewhere do.
    double across = 0, within = 0;
    for (int i = 0; i < kDetailSize; ++i) {
        const double y = (i + 0.5) / kDetailSize, step = 1.0 / kDetailSize;
        across += glm::length(tile.lookUp(0, {1 - 0.5 * step, y}) - tile.lookUp(0, {0.5 * step, y}));
        within += glm::length(tile.lookUp(0, {0.4, y}) - tile.lookUp(0, {0.4 + step, y}));
    }
    EXPECT_LT(across, 2 * within);
}

TEST(DetailStrength, LeavesTheNarrowestLobeHalfItsWidth) {
    EXPECT_EQ(detailStrength(0.5, 0.3), 0.5);
    const double strength = detailStrength(100, 0.1);
    EXPECT_NEAR(strength * strength * kDetailVariance, 0.5 * 0.01, 1e-12);
}

TEST(TwoLobes, TheirAlbedoIsTheWeightedSum) {
    const std::vector<float> row = mixedAlbedoRow(0.4, 0.15, 0.3);
    for (const double mu : {0.05, 0.2, 0.6, 1.0}) {
        const double exact = 0.7 * directionalAlbedo(mu, 0.4) + 0.3 * directionalAlbedo(mu, 0.15);
        EXPECT_NEAR(lookUpAlbedo(row, mu), exact, 1e-3) << mu;
    }
    EXPECT_EQ(mixedAlbedoRow(0.4, 0.15, 0), directionalAlbedoRow(0.4));
}

}  // namespace
}  // namespace cutis::skin
