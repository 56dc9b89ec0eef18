#include "renderer/scene/environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "renderer/scene/picture.h"
#include "renderer/scene/tonemap.h"
#include "tests/support/process.h"
#include "warnings.h"

namespace cutis {
namespace {

Picture makePicture(int width, int height, int channels, float value) {
    Picture picture{width, height, channels, {}};
    picture.values.assign(std::size_t(width) * height * channels, value);
    return picture;
}

TEST(Environment, RowsStartAtTheTop) {
    const test::TemporaryFolder folder;
    Picture picture = makePicture(80, 40, 3, 0);
    for (int i = 0; i < 3 * 80 * 40; ++i) picture.values[i] = float(i);
    writeExr(folder / "sky.exr", picture);
    const test::CapturedWarnings warnings;
    const Environment environment = loadEnvironment(folder / "sky.exr");
    EXPECT_EQ(environment.name, "sky.exr");
    EXPECT_EQ(environment.width, 80);
    EXPECT_EQ(environment.height, 40);
    ASSERT_EQ(environment.radiance.size(), 3200u);
    EXPECT_EQ(environment.radiance[0], glm::vec3(0, 1, 2));
    EXPECT_EQ(environment.radiance[3199], glm::vec3(9597, 9598, 9599));
    EXPECT_TRUE(warnings.all().empty());
}

TEST(Environment, LargeTexelsAreSplitEvenly) {
    const test::TemporaryFolder folder;
    Picture picture = makePicture(3, 2, 3, 0);
    for (int i = 0; i < 18; ++i) picture.values[i] = float(i);
    writeExr(folder / "sky.exr", picture);
    const Environment environment = loadEnvironment(folder / "sky.exr");
    ASSERT_EQ(environment.width, 66);
    ASSERT_EQ(environment.height, 32);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 66; ++x) {
            const float first = float(3 * (y / 16 * 3 + x / 22));
            ASSERT_EQ(environment.radiance[y * 66 + x], glm::vec3(first, first + 1, first + 2));
        }
}

TEST(Environment, IsSanitizedWithOneWarning) {
    const test::TemporaryFolder folder;
    const float nan = std::nanf(""), inf = std::numeric_limits<float>::infinity();
    Picture picture = makePicture(2, 2, 4, 1);
    picture.values = {nan, 1, 2, 1, -3, -inf, 5, 1, inf, 33952, inf, 1, 0, nan, -0.f, 1};
    writeExr(folder / "bad.exr", picture);
    const test::CapturedWarnings warnings;
    const Environment environment = loadEnvironment(folder / "bad.exr");
    const auto quarter = [&](int x, int y) {  // of the file's 2 x 2 texels
        return environment.radiance[y * environment.height / 2 * environment.width + x * environment.width / 2];
    };
    EXPECT_EQ(quarter(0, 0), glm::vec3(0, 1, 2));
    EXPECT_EQ(quarter(1, 0), glm::vec3(0, 0, 5));
    EXPECT_EQ(quarter(0, 1), glm::vec3(33952));
    EXPECT_EQ(quarter(1, 1), glm::vec3(0));
    ASSERT_EQ(warnings.all().size(), 1u);
    EXPECT_EQ(warnings.count(
                  "bad.exr: 2 NaN values become 0, 2 negative values become 0, 2 infinite values become the "
                  "largest that is finite"),
              1)
        << warnings.all()[0];
}

TEST(Environment, NegativeValuesOfResamplingAreMendedWithoutAWord) {
    Environment environment{"ringing", 2, 1, {{1, 2, 3}, {1, -1e-5f, 1}}};
    const test::CapturedWarnings warnings;
    sanitizeEnvironment(environment);
    EXPECT_EQ(environment.radiance[1], glm::vec3(1, 0, 1));
    EXPECT_TRUE(warnings.all().empty());
    environment.radiance[1].y = -1;
    sanitizeEnvironment(environment);
    EXPECT_EQ(warnings.count("ringing: 1 negative value becomes 0"), 1);
}

TEST(Environment, OneChannelIsGreyAndIntegersAreSrgb) {
    const test::TemporaryFolder folder;
    writeExr(folder / "grey.exr", makePicture(2, 1, 1, 7));
    EXPECT_EQ(loadEnvironment(folder / "grey.exr").radiance[1], glm::vec3(7));
    // Black stays black and white white under the tone curve's 0.04 and its shoulder; grey tells the transfer
    // apart.
    writePng(folder / "grey.png", makePicture(2, 1, 3, 0.24f), 0);
    EXPECT_NEAR(loadEnvironment(folder / "grey.png").radiance[0].r, 0.2f, 0.004f);
}

TEST(Environment, WhatIsNoneIsRefused) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(loadEnvironment(folder / "absent.exr"), Error);
    EXPECT_THROW(loadEnvironment(folder.path()), Error);
    writePng(folder / "tall.png", makePicture(1, kMaxEnvironmentHeight + 1, 1, 0), 0);
    EXPECT_THROW(loadEnvironment(folder / "tall.png"), Error);
}

}  // namespace
}  // namespace cutis
