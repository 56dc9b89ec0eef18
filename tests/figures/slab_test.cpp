// Figures 3 and 9: light through a slab, the thickness that it is computed from, and what stands in its way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/closed_forms.h"
#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLux = 2;
constexpr float kNoThickness = 60000;

// A light from behind (-Z) that leans by `degrees` towards +X on its way.
glm::dvec3 fromBehind(double degrees) {
    return {std::sin(degrees * kPi / 180), 0, std::cos(degrees * kPi / 180)};
}

double meanOf(const Picture& picture, int channel = 0) {
    double sum = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) sum += valueAt(picture, x, y, channel);
    return sum / (double(picture.width) * picture.height);
}

// The middle 40 mm, seen from +Z, of a slab of 120 mm whose front is the plane z = 0.
SceneBuilder slabScene(double thicknessMm) {
    SceneBuilder builder;
    builder.addObject("slab", makeBox(glm::dvec3(-60, -60, -thicknessMm) * kMm, glm::dvec3(60, 60, 0) * kMm),
                      builder.addSkin(SceneBuilder::plainSkin()));
    builder.setOrthographicCamera(glm::dvec3(0, 0, 100) * kMm, {0, 0, 0}, 40 * kMm);
    return builder;
}

RenderJob slabJob(const SceneBuilder& builder, std::vector<Light> lights) {
    RenderJob job{.scene = builder.scene(), .lights = std::move(lights), .width = 64, .height = 64};
    job.aovs = {"diffuse", "thickness"};
    return job;
}

class Slab : public ::testing::TestWithParam<double> {};

TEST_P(Slab, TransmitsTheProfileOfItsThickness) {
    const double thickness = GetParam();
    const Rendered result =
        render(slabJob(slabScene(thickness), {directionalLight("back", fromBehind(0), kLux)}));
    const double exact = slabTransmission(skin::threeLayerProfile(), 0, thickness) * kLux / kPi;
    double worst = 0, worstThickness = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            worst = std::max(worst, std::abs(valueAt(result.aov("diffuse"), x, y) / exact - 1));
            worstThickness =
                std::max(worstThickness, std::abs(valueAt(result.aov("thickness"), x, y) / thickness - 1));
        }
    const std::string name = "slab " + std::to_string(thickness).substr(0, 1) + " mm";
    expectAtMost(name + " mean", std::abs(meanOf(result.aov("diffuse")) / exact - 1), 0.03);
    expectAtMost(name + " worst pixel", worst, 0.03);
    expectAtMost(name + " thickness", worstThickness, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Thickness, Slab, ::testing::Values(1.0, 2.0, 4.0), [](const auto& instance) {
    return std::to_string(std::lround(instance.param)) + "_mm";
});

// The faces are parallel and their normals opposite, so that d'Eon's correction gives the slab's thickness
// for every angle: two lights through it are the sum of each alone, and each is its cosine times the closed
// form.
TEST(Slab, TwoLightsBehindItAdd) {
    const SceneBuilder builder = slabScene(2);
    const auto first = directionalLight("first", fromBehind(0), kLux);
    const auto second = directionalLight("second", fromBehind(35), 1.5 * kLux);
    const Picture alone = render(slabJob(builder, {first})).aov("diffuse");
    const Picture other = render(slabJob(builder, {second})).aov("diffuse");
    const Picture both = render(slabJob(builder, {first, second})).aov("diffuse");
    Picture sum = alone;
    addPicture(sum, other);
    expectAtMost("slab two lights", relativeL2(both, sum), 0.01);
    const double exact =
        slabTransmission(skin::threeLayerProfile(), 0, 2) * 1.5 * kLux * std::cos(35 * kPi / 180) / kPi;
    expectAtMost("slab 2 mm at 35 degrees", std::abs(meanOf(other) / exact - 1), 0.03);
}

TEST(Slab, LitFromTheFrontHasNoThickness) {
    const Rendered result = render(slabJob(slabScene(2), {directionalLight("front", {0, 0, -1}, kLux)}));
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) ASSERT_EQ(valueAt(result.aov("thickness"), x, y), kNoThickness);
    expectAtMost("slab front light", std::abs(meanOf(result.aov("diffuse")) * kPi / kLux - 1), 0.01);
}

// Front z = 0; back z = -2 mm where x < 0 and z = -5 mm where x > 0, with a wall between them.
Primitive makeSteppedSlab() {
    ChartedMesh mesh(10 * kMm);
    const auto quad = [&](glm::dvec3 corner, glm::dvec3 across, glm::dvec3 up) {
        mesh.addQuad(corner * kMm, across * kMm, up * kMm);
    };
    quad({-30, -30, 0}, {60, 0, 0}, {0, 60, 0});   // front
    quad({0, -30, -2}, {-30, 0, 0}, {0, 60, 0});   // thin back
    quad({30, -30, -5}, {-30, 0, 0}, {0, 60, 0});  // thick back
    quad({0, -30, -5}, {0, 0, 3}, {0, 60, 0});     // wall, facing -X
    quad({-30, -30, -2}, {0, 0, 2}, {0, 60, 0});   // ends
    quad({30, -30, 0}, {0, 0, -5}, {0, 60, 0});
    quad({-30, -30, -2}, {30, 0, 0}, {0, 0, 2});  // lower side
    quad({0, -30, -5}, {30, 0, 0}, {0, 0, 5});
    quad({-30, 30, 0}, {30, 0, 0}, {0, 0, -2});  // upper side
    quad({0, 30, 0}, {30, 0, 0}, {0, 0, -5});
    return mesh.finish();
}

// Light that leans from -X by 45° passes under the step: the thick half, up to 2 mm from the step, is then
// lit through the thin back. Light that leans from +X by 30° enters through the thick back also where the
// slab is thin.
TEST(SteppedSlab, ThicknessIsTheSmallerPath) {
    SceneBuilder builder;
    builder.addObject("slab", makeSteppedSlab(), builder.addSkin(SceneBuilder::plainSkin()));
    builder.setOrthographicCamera(glm::dvec3(0, 0, 100) * kMm, {0, 0, 0}, 20 * kMm);
    const auto thicknessUnder = [&](std::vector<Light> lights) {
        RenderJob job{.scene = builder.scene(), .lights = std::move(lights), .width = 200, .height = 20};
        job.irradianceSize = 768;
        job.aovs = {"thickness", "position"};
        return render(job);
    };
    const auto fromLeft = directionalLight("from the left", fromBehind(45), kLux);
    const auto fromRight = directionalLight("from the right", fromBehind(-30), kLux);
    const Rendered left = thicknessUnder({fromLeft}), right = thicknessUnder({fromRight}),
                   both = thicknessUnder({fromLeft, fromRight});

    const double lean = std::tan(30 * kPi / 180);
    double worstLeft = 0, worstRight = 0, worstBoth = 0;
    int unlike = 0, count = 0;
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 200; ++x) {
            const double xMm = valueAt(both.aov("position"), x, y, 0) / kMm;
            const double a = valueAt(left.aov("thickness"), x, y), b = valueAt(right.aov("thickness"), x, y);
            const double merged = valueAt(both.aov("thickness"), x, y);
            ++count;
            if (std::abs(merged - std::min(a, b)) > 0.01 * std::min(a, b)) ++unlike;
            // Where both entry points are on a face parallel to the front; 0.4 mm away from where they jump.
            const bool leftKnown = xMm < 2 - 0.4 || xMm > 5 + 0.4;
            const bool rightKnown = (xMm > -2 * lean + 0.4) || xMm < -5 * lean - 0.4;
            const double leftExact = xMm < 2 ? 2 : 5, rightExact = xMm < -5 * lean ? 2 : 5;
            if (leftKnown) worstLeft = std::max(worstLeft, std::abs(a / leftExact - 1));
            if (rightKnown) worstRight = std::max(worstRight, std::abs(b / rightExact - 1));
            if (leftKnown && rightKnown)
                worstBoth = std::max(worstBoth, std::abs(merged / std::min(leftExact, rightExact) - 1));
        }
    expectAtMost("stepped slab left light", worstLeft, 0.03);
    expectAtMost("stepped slab right light", worstRight, 0.03);
    expectAtMost("stepped slab both lights", worstBoth, 0.03);
    expectAtMost("stepped slab pixels unlike the smaller path", double(unlike) / count, 0.02);
}

// A sheet as large as a hand stands 50 mm behind the left half of the slab's middle and shades it from the
// light.
class Occluder : public ::testing::TestWithParam<bool> {};

TEST_P(Occluder, RemovesTranslucency) {
    const bool anotherCharacter = GetParam();
    const auto light = directionalLight("back", fromBehind(0), kLux);
    const Picture open = render(slabJob(slabScene(2), {light})).aov("diffuse");

    SceneBuilder builder = slabScene(2);
    const int material = anotherCharacter ? builder.addSkin(SceneBuilder::plainSkin()) : builder.addMatte();
    builder.addObject("hand", makeBox(glm::dvec3(-90, -90, -55) * kMm, glm::dvec3(0, 90, -52) * kMm),
                      material);
    RenderJob job = slabJob(builder, {light});
    job.aovs = {"diffuse", "thickness", "position", "character"};
    const Rendered shaded = render(job);

    double shadedSum = 0, openSum = 0, litSum = 0, litOpenSum = 0, thinnest = kNoThickness;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const double xMm = valueAt(shaded.aov("position"), x, y, 0) / kMm;
            const double value = valueAt(shaded.aov("diffuse"), x, y), before = valueAt(open, x, y);
            // The entry levels are blurred over the shadow's edge by up to 2.7 mm: 9 mm is beyond 3 σ.
            if (xMm < -9) {
                shadedSum += value, openSum += before;
                thinnest = std::min(thinnest, valueAt(shaded.aov("thickness"), x, y));
            }
            if (xMm > 9) litSum += value, litOpenSum += before;
        }
    const std::string name = anotherCharacter ? "occluding character" : "occluding object";
    expectAtMost(name + " light left", shadedSum / openSum, 0.01);
    expectAtMost(name + " change beside it", std::abs(litSum / litOpenSum - 1), 0.03);
    EXPECT_GE(thinnest, 50) << "an occluder's surface is not a thickness of this character";
}

INSTANTIATE_TEST_SUITE_P(Kinds, Occluder, ::testing::Bool(), [](const auto& instance) {
    return std::string(instance.param ? "another_character" : "not_skin");
});

}  // namespace
}  // namespace cutis::test
