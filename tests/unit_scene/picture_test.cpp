#include "renderer/scene/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "renderer/core/error.h"
#include "renderer/scene/tonemap.h"
#include "tests/support/process.h"

namespace cutis {
namespace {

Picture makeRamp(int channels) {
    Picture picture{5, 3, channels, {}};
    for (int i = 0; i < 15 * channels; ++i)
        picture.values.push_back(std::exp2(float(i % 40) - 20) * (i % 3 ? 1 : -1));
    return picture;
}

TEST(Picture, ExrKeepsEveryBit) {
    const test::TemporaryFolder folder;
    for (const int channels : {1, 2, 3, 4, 6}) {
        Picture picture = makeRamp(channels);
        picture.values[0] = std::numeric_limits<float>::infinity();
        picture.values[1] = std::numeric_limits<float>::max();
        picture.values[2] = std::numeric_limits<float>::denorm_min();
        writeExr(folder / "a.exr", picture);
        const Picture back = readPicture(folder / "a.exr");
        EXPECT_EQ(back.width, 5);
        EXPECT_EQ(back.height, 3);
        ASSERT_EQ(back.channels, channels);
        EXPECT_EQ(back.values, picture.values) << channels;
    }
}

// Values computed by hand from the published equations: 0.5 - 0.04 = 0.46; 1 - 0.04 = 0.96 is above 0.76, so
// 1 - 0.24²/(0.96 + 0.24 - 0.76) = 0.869091; 0.04 - (0.04 - 6.25·0.04²) = 0.01.
TEST(Picture, PngIsToneMappedAndEncoded) {
    EXPECT_NEAR(toneMapNeutral(glm::vec3(0.5f)).r, 0.46f, 1e-6f);
    EXPECT_NEAR(toneMapNeutral(glm::vec3(1)).r, 0.869091f, 1e-6f);
    EXPECT_NEAR(toneMapNeutral(glm::vec3(0.04f)).r, 0.01f, 1e-6f);
    EXPECT_NEAR(encodeSrgb(0.46f), 0.708f, 0.001f);

    const test::TemporaryFolder folder;
    const float nan = std::nanf(""), inf = std::numeric_limits<float>::infinity();
    const Picture picture{4, 1, 4, {0.25f, 0.25f, 0.25f, 1, 0, 0, 0, 0, nan, -1, -inf, 1, inf, inf, inf, 1}};
    writePng(folder / "a.png", picture, 1);  // one stop up: 0.5
    const Picture back = readPicture(folder / "a.png");
    ASSERT_EQ(back.channels, 3);
    EXPECT_NEAR(back.values[0] * 255, 181, 0.01);  // 255 · 0.7080 = 180.5
    for (int i = 3; i < 9; ++i) EXPECT_EQ(back.values[i], 0);
    for (int i = 9; i < 12; ++i) EXPECT_EQ(back.values[i], 1);
}

// The curve is continuous, grows, keeps hue below its shoulder and tends to white.
TEST(Picture, ToneCurveHasNoSteps) {
    float previous = -1;
    for (float x = 0; x < 30; x += 0.001f) {
        const float y = toneMapNeutral(glm::vec3(x)).r;
        EXPECT_GE(y, previous - 1e-6f);  // rounding
        EXPECT_LT(y - previous, x > 0 ? 0.0011f : 2) << x;
        EXPECT_LT(y, 1);
        previous = y;
    }
    const glm::vec3 red = toneMapNeutral({1e6f, 1e3f, 1e3f});
    EXPECT_GT(red.g, 0.99f);
}

TEST(Picture, WhatCannotBeWrittenIsRefusedAndLeavesNothing) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(writeExr(folder / "absent" / "a.exr", makeRamp(3)), Error);
    EXPECT_THROW(writePng(folder / "absent" / "a.png", makeRamp(3), 0), Error);
    EXPECT_THROW(writeExr(folder / "a.nothing", makeRamp(3)), Error);
    EXPECT_THROW(writeExr(folder / "a.exr", Picture{2, 2, 3, {1, 2, 3}}), Error);
    EXPECT_THROW(writeExr(folder / "a.exr", Picture{0, 0, 3, {}}), Error);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    EXPECT_THROW(readPicture(folder / "absent.exr"), Error);
    EXPECT_THROW(readPicture(folder.path()), Error);
}

}  // namespace
}  // namespace cutis
