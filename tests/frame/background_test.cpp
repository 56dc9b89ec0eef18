// The environment behind a picture: what is seen in which direction, and how much of it shows.
#include "renderer/frame/background.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cutis::test {
namespace {

// Radiance 1 in the half towards -Z (x > 0 red, x < 0 green), nothing behind.
Environment halves() {
    Environment environment{"halves", 64, 32, std::vector<glm::vec3>(64 * 32, glm::vec3(0))};
    for (int y = 0; y < 32; ++y)
        for (int x = 16; x < 48; ++x)
            environment.radiance[std::size_t(y) * 64 + x] = x < 32 ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    return environment;
}

Picture emptyPicture(float alpha) {
    Picture picture{9, 5, 4, {}};
    for (int i = 0; i < 45; ++i) picture.values.insert(picture.values.end(), {0, 0, 0, alpha});
    return picture;
}

Camera lookingAlongMinusZ() {
    Camera camera;
    camera.yfov = 0.5;
    return camera;
}

TEST(Background, LiesWhereTheCameraLooks) {
    const Environment environment = halves();
    const BackgroundPainter painter(environment, Background::environment);
    Picture picture = emptyPicture(0);
    painter.paint(picture, lookingAlongMinusZ(), {.file = "x", .intensity = 3});
    EXPECT_NEAR(picture.values[0 * 4 + 1], 3, 1e-5) << "green on the left";
    EXPECT_NEAR(picture.values[8 * 4 + 0], 3, 1e-5) << "red on the right";
    EXPECT_EQ(picture.values[3], 0) << "alpha stays the coverage";
    Picture turned = emptyPicture(0);
    // Turned by 180 degrees the dark half lies there.
    painter.paint(turned, lookingAlongMinusZ(), {.file = "x", .intensity = 3, .rotation = 180});
    for (const float value : turned.values) EXPECT_EQ(value, 0);
    // A quarter counter-clockwise seen from above brings what lay at +X, the border of red and dark, to -Z:
    // red was between -Z and +X, and lies now on the left.
    Picture quarter = emptyPicture(0);
    painter.paint(quarter, lookingAlongMinusZ(), {.file = "x", .rotation = 90});
    EXPECT_NEAR(quarter.values[0], 1, 1e-5);
    EXPECT_NEAR(quarter.values[8 * 4], 0, 1e-5);
}

TEST(Background, ShowsWhereNothingCoversIt) {
    Environment environment{"even", 8, 4, std::vector<glm::vec3>(32, glm::vec3(2))};
    const BackgroundPainter painter(environment, Background::environment);
    for (const float alpha : {0.25f, 1.0f}) {
        Picture picture = emptyPicture(alpha);
        painter.paint(picture, lookingAlongMinusZ(), {.file = "x"});
        for (int i = 0; i < 45; ++i) EXPECT_NEAR(picture.values[i * 4], 2 * (1 - alpha), 1e-6);
    }
    Picture off = emptyPicture(0);
    painter.paint(off, lookingAlongMinusZ(), {.file = "x", .enabled = false});
    EXPECT_EQ(off.values[0], 0);
    BackgroundPainter(environment, Background::none).paint(off, lookingAlongMinusZ(), {.file = "x"});
    EXPECT_EQ(off.values[0], 0);
}

// Blurring keeps what is even to the quadrature's error, and keeps the light of an edge while softening it.
TEST(Background, BlurredIsSmoothAndAsBright) {
    const Environment even{"even", 64, 32, std::vector<glm::vec3>(64 * 32, glm::vec3(2))};
    Picture picture = emptyPicture(0);
    BackgroundPainter(even, Background::blurred).paint(picture, lookingAlongMinusZ(), {.file = "x"});
    for (int i = 0; i < 45; ++i) EXPECT_NEAR(picture.values[i * 4], 2, 0.04);
    const Environment environment = halves();
    Picture edge = emptyPicture(0);
    BackgroundPainter(environment, Background::blurred).paint(edge, lookingAlongMinusZ(), {.file = "x"});
    const float* middle = &edge.values[(2 * 9 + 4) * 4];
    EXPECT_NEAR(middle[0], 0.5, 0.05);
    EXPECT_NEAR(middle[1], 0.5, 0.05);
    const float* right = &edge.values[(2 * 9 + 8) * 4];  // 24 degrees off the edge, three deviations
    EXPECT_GT(right[0], 0.95);
}

}  // namespace
}  // namespace cutis::test
