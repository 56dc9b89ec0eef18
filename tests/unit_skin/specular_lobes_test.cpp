// The fitted lobes against the lobe that they stand for.
#include "renderer/skin/specular_lobes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/skin/specular.h"
#include "shaders/shared/albedo_table.h"

using namespace cutis::skin;
using glm::dvec3;

namespace {


}  // namespace

class SpecularLobes : public testing::TestWithParam<double> {};

// How well the lobes stand for f_s under an environment is measured in tests/env/specular_test.cpp.
TEST_P(SpecularLobes, areWellFormed) {
    for (const auto& row : fitSpecularLobes(GetParam())) {
        ASSERT_EQ(int(row.size()), LOBES_IN_PLANE + LOBE_PAIRS);
        double sum = 0;
        for (const SpecularLobe& lobe : row) {
            EXPECT_NEAR(glm::length(lobe.direction), 1, 1e-9);
            EXPECT_TRUE(lobe.sigma > 0 && lobe.sigma < 2);
            EXPECT_GE(lobe.weight, 0);
            if (!lobe.paired) {
                EXPECT_EQ(lobe.direction.y, 0);
            }
            sum += lobe.weight;
        }
        EXPECT_NEAR(sum, 1, 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(Roughness, SpecularLobes, testing::Values(0.001, 0.05, 0.1, 0.3, 0.6, 1.0));

TEST(SpecularLobeTable, holdsTheFit) {
    const auto rows = fitSpecularLobes(0.25);
    for (int run = 0; run < 2; ++run) {  // fitted, then perhaps from the cache
        const std::vector<float> table = specularLobeTable(0.25);
        ASSERT_EQ(int(table.size()), LOBE_ROWS * LOBE_ROW_SIZE);
        const SpecularLobe& lobe = rows[7][5];
        const float* at = &table[7 * LOBE_ROW_SIZE + 5 * LOBE_FLOATS];
        EXPECT_FLOAT_EQ(at[0], float(lobe.direction.x));
        EXPECT_FLOAT_EQ(at[1], float(lobe.direction.y));
        EXPECT_FLOAT_EQ(at[3], float(lobe.sigma));
        EXPECT_FLOAT_EQ(at[4], float(lobe.weight));
    }
}
