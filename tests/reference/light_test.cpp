// Light that arrives: lights with area, environments with suns, shadows of what lets light through.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/reference/evaluate.h"
#include "tests/support/closed_forms.h"
#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSize = 6;

// A plate of 0.4 m in the plane z = 0, seen from the front.
SceneBuilder plateScene() {
    SceneBuilder builder;
    builder.addObject("plate", makePlate(0.4), builder.addSkin(SceneBuilder::plainSkin()));
    builder.setOrthographicCamera({0, 0, 1}, {0, 0, 0}, 0.3);
    return builder;
}

// A card in front of the plate, out of the camera's way: light from +X +Z passes through it.
SceneBuilder cardScene(AlphaMode mode, float alpha) {
    SceneBuilder builder = plateScene();
    Material card;
    card.name = "card";
    card.baseColor = {1, 1, 1, alpha};
    card.alphaMode = mode;
    card.doubleSided = true;
    glm::dmat4 place(1);
    place[3] = glm::dvec4(1, 0, 1, 1);
    builder.addObject("card", makePlate(0.9), builder.addMaterial(card), place);
    return builder;
}

TEST(ReferenceLight, RectLightFollowsLambert) {
    const glm::dvec3 centre(0.3, 0.2, 0.5), direction = glm::normalize(glm::dvec3(-0.5, -0.3, -1));
    const auto result = evaluate({.scene = plateScene().scene(),
                                  .lights = {rectLight("key", centre, direction, 3, 0.4, 0.6, 1)},
                                  .width = kSize,
                                  .height = kSize,
                                  .passes = 32,
                                  .aovs = {"irradiance", "position"}});
    const auto corners = rectCorners(centre, direction, 0.4, 0.6);
    NormRatio figure;
    for (int i = 0; i < kSize * kSize; ++i) {
        const glm::dvec3 p = rgbAt(result.aovs.at("position"), i % kSize, i / kSize);
        const double exact = polygonIrradiance(p, {0, 0, 1}, {corners.begin(), corners.end()}, 3);
        figure.add(valueAt(result.aovs.at("irradiance"), i % kSize, i / kSize) - exact, exact);
    }
    expectAtMost("reference rect light, irradiance, relative L2", figure.value(), 0.003);
}

// A sun of one texel in a sky of smooth light, half of it below the plate.
TEST(ReferenceLight, EnvironmentIsSummedExactly) {
    constexpr int kWidth = 64, kHeight = 32;
    Picture sky = makeEnvironment(kWidth, kHeight,
                                  [](const glm::dvec3& d) { return glm::dvec3(1.5 + d.x, 1, 1 + d.y); });
    for (int c = 0; c < 3; ++c) sky.values[(10 * kWidth + 50) * 3 + c] = 500;
    const auto result = evaluate({.scene = plateScene().scene(),
                                  .environment = sky,
                                  .width = kSize,
                                  .height = kSize,
                                  .passes = 32,
                                  .aovs = {"irradiance"}});
    // Every texel is constant: midpoints of 8 × 8 parts of each, of the upper hemisphere of +Z.
    constexpr int kParts = 8;
    glm::dvec3 exact(0);
    for (int y = 0; y < kHeight * kParts; ++y) {
        for (int x = 0; x < kWidth * kParts; ++x) {
            const double v = (y + 0.5) / (kHeight * kParts), u = (x + 0.5) / (kWidth * kParts);
            const double solidAngle =
                std::sin(kPi * v) * 2 * kPi * kPi / (double(kWidth) * kHeight * kParts * kParts);
            exact +=
                rgbAt(sky, x / kParts, y / kParts) * std::max(latLongDirection(u, v).z, 0.0) * solidAngle;
        }
    }
    NormRatio figure;
    for (int i = 0; i < kSize * kSize; ++i)
        for (int c = 0; c < 3; ++c)
            figure.add(rgbAt(result.aovs.at("irradiance"), i % kSize, i / kSize)[c] - exact[c], exact[c]);
    expectAtMost("reference environment with a sun, irradiance, relative L2", figure.value(), 0.01);
}

TEST(ReferenceLight, WhatIsSeenThroughLetsLightThrough) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(-1, 0, -1));
    const auto share = [&](AlphaMode mode, float alpha) {
        const auto result = evaluate({.scene = cardScene(mode, alpha).scene(),
                                      .lights = {directionalLight("key", direction, 2)},
                                      .width = kSize,
                                      .height = kSize,
                                      .passes = 1,
                                      .aovs = {"irradiance"}});
        return valueAt(result.aovs.at("irradiance"), 3, 3) / (2 * std::sqrt(0.5));
    };
    EXPECT_NEAR(share(AlphaMode::blend, 0.25f), 0.75, 1e-6);
    EXPECT_NEAR(share(AlphaMode::mask, 0.25f), 1, 1e-6);
    EXPECT_NEAR(share(AlphaMode::mask, 0.75f), 0, 1e-6);
    EXPECT_NEAR(share(AlphaMode::opaque, 0.25f), 0, 1e-6);
}

// With more lights than a point asks about, some are asked by chance: the sum stays what it is.
TEST(ReferenceLight, ManyLightsSumExactly) {
    std::vector<Light> lights;
    double exact = 0;
    for (int i = 0; i < 60; ++i) {
        const double angle = 0.1 * i, lux = 1 + i % 7;
        const glm::dvec3 towards =
            glm::normalize(glm::dvec3(std::cos(angle), std::sin(angle), 0.3 + 0.02 * i));
        lights.push_back(directionalLight("light " + std::to_string(i), -towards, lux));
        exact += lux * towards.z;
    }
    const auto result = evaluate({.scene = plateScene().scene(),
                                  .lights = lights,
                                  .width = kSize,
                                  .height = kSize,
                                  .passes = 16,
                                  .aovs = {"irradiance"}});
    double mean = 0;
    for (int i = 0; i < kSize * kSize; ++i)
        mean += valueAt(result.aovs.at("irradiance"), i % kSize, i / kSize);
    expectAtMost("reference 60 lights, irradiance, relative error",
                 std::abs(mean / (kSize * kSize) / exact - 1), 0.003);
}

}  // namespace
}  // namespace cutis::test
