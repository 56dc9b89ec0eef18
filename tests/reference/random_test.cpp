// The random numbers: stratified within a sequence, independent between sequences and purposes.
#include "renderer/reference/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace cutis::test {
namespace {

using reference::RandomNumbers;

// Any 64 = 2^a · 2^b boxes of the square hold exactly one of 64 consecutive samples that start at a multiple
// of 64.
TEST(ReferenceRandom, PairsAreNets) {
    for (std::uint64_t key : {1u, 77u}) {
        for (std::uint32_t first : {0u, 64u, 640u}) {
            for (int a = 0; a <= 6; ++a) {
                std::set<std::array<int, 2>> boxes;
                for (std::uint32_t i = first; i < first + 64; ++i) {
                    const glm::dvec2 u = RandomNumbers(RandomNumbers::mix(key), i).pair(3);
                    ASSERT_TRUE(u.x > 0 && u.x < 1 && u.y > 0 && u.y < 1);
                    boxes.insert({int(u.x * (1 << a)), int(u.y * (1 << (6 - a)))});
                }
                EXPECT_EQ(boxes.size(), 64u) << key << ' ' << first << ' ' << a;
            }
        }
    }
}

// Over many sequences, numbers of one sample for different purposes, parts and keys are uncorrelated: the
// standard error of a correlation of 4,000 is 0.016.
TEST(ReferenceRandom, PurposesAndSequencesAreIndependent) {
    constexpr int kCount = 4000;
    double mean = 0, across[4] = {};
    for (int i = 0; i < kCount; ++i) {
        const RandomNumbers a(RandomNumbers::mix(i), 5), b(RandomNumbers::mix(i), 6),
            c(RandomNumbers::mix(i + 1), 5);
        const double x = a.pair(0).x - 0.5;
        mean += a.pair(0).x / kCount;
        const double others[4] = {a.pair(0).y, a.pair(1).x, a.branch(0).pair(0).x, c.pair(0).x};
        for (int k = 0; k < 4; ++k) across[k] += x * (others[k] - 0.5) * 12 / kCount;
        EXPECT_NE(a.pair(0).x, b.pair(0).x);
    }
    EXPECT_NEAR(mean, 0.5, 4 * 0.29 / std::sqrt(kCount));
    for (double correlation : across) EXPECT_NEAR(correlation, 0, 0.065);
}

}  // namespace
}  // namespace cutis::test
