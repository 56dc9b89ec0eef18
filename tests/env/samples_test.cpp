// Environments split into light samples and a residual.
#include <gtest/gtest.h>

#include <numbers>

#include "renderer/scene/environment_clusters.h"
#include "renderer/scene/environment_samples.h"
#include "tests/env/environments.h"

using namespace cutis;
using namespace cutis::test;
using glm::dvec3;

namespace {

dvec3 fluxOf(const Environment& e) {
    const double pi = std::numbers::pi;
    dvec3 sum(0);
    for (int y = 0; y < e.height; ++y) {
        const double solidAngle =
            (std::cos(pi * y / e.height) - std::cos(pi * (y + 1) / e.height)) * 2 * pi / e.width;
        for (int x = 0; x < e.width; ++x) sum += dvec3(e.radiance[std::size_t(y) * e.width + x]) * solidAngle;
    }
    return sum;
}

void expectSameEnergy(const Environment& e, const EnvironmentSplit& split, double intensity) {
    dvec3 together = intensity * fluxOf(split.residual);
    for (const LightSample& s : split.samples) together += s.intensity;
    const dvec3 all = intensity * fluxOf(e);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(together[c], all[c], 1e-9 * all[c]);
    for (std::size_t i = 0; i < e.radiance.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            ASSERT_GE(split.residual.radiance[i][c], 0);
            ASSERT_LE(split.residual.radiance[i][c], e.radiance[i][c]);
        }
}

}  // namespace

TEST(SplitEnvironment, sunIsOneSampleWithItsFlux) {
    const Environment e = sunnyEnvironment(512, 256);
    const EnvironmentSplit split = splitEnvironment(e, 1, 30, 2);
    ASSERT_EQ(split.samples.size(), 1u);
    const LightSample& sun = split.samples[0];
    EXPECT_EQ(sun.light, -1);
    EXPECT_TRUE(sun.directional && sun.shadow);
    const double pi = std::numbers::pi;
    const double solidAngle = (std::cos(pi * 64 / 256) - std::cos(pi * 65 / 256)) * 2 * pi / 512;
    EXPECT_NEAR(sun.intensity.x, 2 * 30000 * solidAngle, 0.01 * 2 * 30000 * solidAngle);
    const dvec3 towards = rotateAboutY(environmentDirection(170.5 / 512, 64.5 / 256), 30);
    EXPECT_GT(glm::dot(-sun.direction, towards), std::cos(0.01));
    EXPECT_LT(sun.radius, 0.1);
    expectSameEnergy(e, split, 2);
}

TEST(SplitEnvironment, noneLeavesTheEnvironment) {
    const Environment e = sunnyEnvironment(64, 32);
    for (int n : {0, -3}) {
        const EnvironmentSplit split = splitEnvironment(e, n, 0, 1);
        EXPECT_TRUE(split.samples.empty());
        EXPECT_EQ(split.residual.radiance, e.radiance);
    }
    const Environment black{"black", 8, 4, std::vector<glm::vec3>(32, glm::vec3(0))};
    EXPECT_TRUE(splitEnvironment(black, 4, 0, 1).samples.empty());
}

TEST(SplitEnvironment, manySamplesTakeAll) {
    const Environment e = uniformEnvironment(128, 64);
    const EnvironmentSplit split = splitEnvironment(e, 256, 0, 1);
    EXPECT_EQ(split.samples.size(), 256u);
    EXPECT_EQ(fluxOf(split.residual), dvec3(0));
    dvec3 irradiance(0);
    for (const LightSample& s : split.samples) irradiance += s.intensity * std::max(0.0, -s.direction.y);
    EXPECT_NEAR(irradiance.x, std::numbers::pi, 0.05);
}

class SplitOf : public testing::TestWithParam<std::string> {};

TEST_P(SplitOf, keepsEnergyAndStaysCompact) {
    const Environment& e = blenderEnvironment(GetParam());
    double previous = -1;
    for (int n : {1, 4, 16, 64}) {
        const EnvironmentSplit split = splitEnvironment(e, n, -40, 0.7);
        EXPECT_LE(int(split.samples.size()), n);
        EXPECT_GE(split.samples.size(), 1u);
        expectSameEnergy(e, split, 0.7);
        double taken = 0, spread = 0;
        for (const LightSample& s : split.samples) {
            EXPECT_NEAR(glm::length(s.direction), 1, 1e-9);
            taken += s.intensity.x + s.intensity.y + s.intensity.z;
            spread += (s.intensity.x + s.intensity.y + s.intensity.z) * s.radius * s.radius / 2;
        }
        EXPECT_LE(std::sqrt(spread / taken), 1.1 * kMaxSampleSpread);
        EXPECT_GT(taken, 0.99 * previous) << n << " samples take less than fewer did";
        previous = taken;
        RecordProperty("taken_by_" + std::to_string(n),
                       std::to_string(taken / (0.7 * glm::dot(fluxOf(e), dvec3(1)))));
    }
}

INSTANTIATE_TEST_SUITE_P(Blender, SplitOf, testing::ValuesIn(kBlenderEnvironments),
                         [](const auto& i) { return i.param; });
