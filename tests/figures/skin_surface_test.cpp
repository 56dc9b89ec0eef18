// What the surface of skin reflects: two lobes, and pores that turn into roughness as they go out of sight.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/reference/evaluate.h"
#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

SkinMaterial shiny(double lobeWeight, double detail) {
    SkinMaterial skin = SceneBuilder::plainSkin();
    skin.specular = 1;
    skin.roughness = 0.35;
    skin.lobeWeight = lobeWeight;
    skin.lobeRatio = 0.5;
    skin.detail = detail;
    return skin;
}

SceneBuilder ballScene(const SkinMaterial& skin, double width) {
    SceneBuilder builder;
    builder.addObject("body", makeSphere(100 * kMm, SphereMapping::latLong), builder.addSkin(skin));
    builder.setOrthographicCamera({0, 0, 0.5}, {0, 0, 0}, width);
    return builder;
}

Picture whiteRoom() {
    return makeEnvironment(64, 32, [](const glm::dvec3&) { return glm::dvec3(1); });
}

// A white room leaves white skin white, with two lobes as with one, and with pores.
TEST(SkinSurface, TwoLobesAndPoresKeepTheWhiteFurnace) {
    RenderJob job{.scene = ballScene(shiny(0.4, 1), 0.21).scene(), .width = 100, .height = 100};
    job.environment = whiteRoom();
    job.aovs = {"normal"};
    const Rendered result = render(job);
    double largest = 0;
    for (int y = 0; y < job.height; ++y)
        for (int x = 0; x < job.width; ++x)
            if (valueAt(result.picture, x, y, 3) > 0.999 && valueAt(result.aov("normal"), x, y, 2) > 0.2)
                largest = std::max(largest, std::abs(valueAt(result.picture, x, y) - 1));
    expectAtMost("white furnace of two lobes with pores: maximum", largest, 0.01);
}

Light lamp() {
    return directionalLight("lamp", glm::normalize(glm::dvec3(-0.35, -0.2, -1)), 3);
}

Picture specularOf(const SceneBuilder& builder, int size) {
    RenderJob job{
        .scene = builder.scene(), .lights = {lamp()}, .width = size, .height = size, .irradianceSize = 256};
    job.aovs = {"specular"};
    return render(job).aov("specular");
}

Picture exactSpecularOf(const SceneBuilder& builder, int size, int passes) {
    return evaluate({.scene = builder.scene(),
                     .lights = {lamp()},
                     .width = size,
                     .height = size,
                     .passes = passes,
                     .aovs = {"specular"}})
        .aovs.at("specular");
}

TEST(SkinSurface, TwoLobesAgreeWithTheReference) {
    const SceneBuilder builder = ballScene(shiny(0.4, 0), 0.21);
    const Picture one = specularOf(ballScene(shiny(0, 0), 0.21), 64), two = specularOf(builder, 64);
    const Picture exact = exactSpecularOf(builder, 64, 4);
    expectAtMost("two lobes: relative L2 of the specular light", relativeL2(two, exact), 0.03);
    EXPECT_GT(relativeL2(one, exact), 0.2) << "the second lobe makes a difference";
}

double meanOf(const Picture& picture) {
    double sum = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            sum += valueAt(picture, x, y) / (double(picture.width) * picture.height);
    return sum;
}

// Twelve millimetres of a ball's highlight, in pixels of 0.03 mm, which show each pore, and of 1.5 mm, which
// show none: the same light in all. What is left is that pores are not quite Gaussian, and that slopes to one
// side are seen at another angle.
TEST(SkinSurface, PoresReflectAsMuchNearAsFar) {
    const SceneBuilder pored = ballScene(shiny(0, 1), 0.012);
    const Picture near = specularOf(pored, 384), far = specularOf(pored, 8),
                  none = specularOf(ballScene(shiny(0, 0), 0.012), 8);
    double low = 1e9, high = 0;
    for (int y = 0; y < 384; ++y)
        for (int x = 0; x < 384; ++x) {
            low = std::min(low, valueAt(near, x, y));
            high = std::max(high, valueAt(near, x, y));
        }
    reportFigure("pores: brightest over darkest pixel", high / low);
    EXPECT_GT(high, 1.2 * low) << "pores are seen";
    expectAtMost("pores: mean light near and far", std::abs(meanOf(near) / meanOf(far) - 1), 0.03);
    expectAtMost("pores: from afar as without", relativeL2(far, none), 0.01);
}

TEST(SkinSurface, PoresAgreeWithTheReference) {
    // Pixels of 0.02 mm, texels of the tile 0.031 mm.
    const SceneBuilder builder = ballScene(shiny(0, 1), 0.002);
    const Picture exact = exactSpecularOf(builder, 96, 2),
                  smooth = specularOf(ballScene(shiny(0, 0), 0.002), 96);
    expectAtMost("pores: relative L2 of the specular light", relativeL2(specularOf(builder, 96), exact),
                 0.05);
    EXPECT_GT(relativeL2(smooth, exact), 0.1) << "without them it is another picture";
}

}  // namespace
}  // namespace cutis::test
