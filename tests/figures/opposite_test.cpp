// Thickness from the shape alone (--merge opposite): slabs and what lights them, against the same closed forms as light
// maps, and what light maps cannot do.
#include <gtest/gtest.h>

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

glm::dvec3 fromBehind(double degrees) {
    return {std::sin(degrees * kPi / 180), 0, std::cos(degrees * kPi / 180)};
}

// The middle 40 mm of a slab whose front is the plane z = 0, seen from +Z.
RenderJob slabJob(double thicknessMm) {
    SceneBuilder builder;
    builder.addObject("slab", makeBox(glm::dvec3(-60, -60, -thicknessMm) * kMm, glm::dvec3(60, 60, 0) * kMm),
                      builder.addSkin(SceneBuilder::plainSkin()));
    builder.setOrthographicCamera(glm::dvec3(0, 0, 100) * kMm, {0, 0, 0}, 40 * kMm);
    RenderJob job{.scene = builder.scene(), .width = 64, .height = 64};
    job.aovs = {"diffuse", "thickness"};
    job.merge = "opposite";
    return job;
}

double worstRatio(const Picture& picture, double exact) {
    double worst = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) worst = std::max(worst, std::abs(valueAt(picture, x, y) / exact - 1));
    return worst;
}

// Any number of lights from any side behind it: their cosines add, and the thickness is that of the slab.
TEST(OppositeSide, SlabTransmitsLightsFromAllAngles) {
    for (const double thickness : {1.0, 2.0, 4.0}) {
        RenderJob job = slabJob(thickness);
        double lux = 0;
        for (const double degrees : {0.0, 35.0, -60.0}) {
            job.lights.push_back(directionalLight("at " + std::to_string(degrees), fromBehind(degrees), 2));
            lux += 2 * std::cos(degrees * kPi / 180);
        }
        const Rendered result = render(job);
        const double exact = slabTransmission(skin::threeLayerProfile(), 0, thickness) * lux / kPi;
        const std::string name = "opposite side, slab " + std::to_string(thickness).substr(0, 1) + " mm";
        expectAtMost(name, worstRatio(result.aov("diffuse"), exact), 0.03);
        expectAtMost(name + " thickness", worstRatio(result.aov("thickness"), thickness), 1e-4);
        EXPECT_EQ(result.stats.runsOf("opposite"), 1);
    }
}

// Light maps know nothing of the environment: with them, the back's half of this is missing.
TEST(OppositeSide, TheEnvironmentShinesThrough) {
    RenderJob job = slabJob(2);
    job.environment = makeEnvironment(16, 8, [](const glm::dvec3&) { return glm::dvec3(1); });
    const double exact = 1 + slabTransmission(skin::threeLayerProfile(), 0, 2);
    expectAtMost("opposite side, slab in a uniform environment", worstRatio(render(job).aov("diffuse"), exact), 0.03);
    job.merge = "min";
    EXPECT_GT(worstRatio(render(job).aov("diffuse"), exact), 0.05);
}

// What stands behind the slab takes the light from its back, and is no other side of it itself.
TEST(OppositeSide, AnotherCharacterBehindIsNoOtherSide) {
    SceneBuilder builder;
    const int skin = builder.addSkin(SceneBuilder::plainSkin());
    builder.addObject("slab", makeBox(glm::dvec3(-60, -60, -4) * kMm, glm::dvec3(60, 60, 0) * kMm), skin);
    builder.addObject("hand", makeBox(glm::dvec3(-60, -60, -20) * kMm, glm::dvec3(60, 60, -12) * kMm), skin);
    builder.setOrthographicCamera(glm::dvec3(0, 0, 100) * kMm, {0, 0, 0}, 40 * kMm);
    RenderJob job{.scene = builder.scene(), .lights = {directionalLight("back", fromBehind(0), 2)}, .width = 32, .height = 32};
    job.aovs = {"diffuse", "thickness"};
    job.merge = "opposite";
    const Rendered result = render(job);
    expectAtMost("opposite side before another character, thickness", worstRatio(result.aov("thickness"), 4), 1e-4);
    double largest = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) largest = std::max(largest, valueAt(result.aov("diffuse"), x, y));
    expectAtMost("opposite side in shadow", largest, 1e-4);
}

// Two halves of a body that face each other through air, as lips do, are not two sides of one sheet.
TEST(OppositeSide, FacesAcrossAGapAreNotOpposite) {
    SceneBuilder builder;
    ChartedMesh mesh(10 * kMm);
    // Two thick plates 1 mm apart: their inner faces look at each other.
    mesh.addQuad(glm::dvec3(-30, -30, 0) * kMm, glm::dvec3(60, 0, 0) * kMm, glm::dvec3(0, 60, 0) * kMm);
    mesh.addQuad(glm::dvec3(30, -30, 1) * kMm, glm::dvec3(-60, 0, 0) * kMm, glm::dvec3(0, 60, 0) * kMm);
    builder.addObject("gap", mesh.finish(), builder.addSkin(SceneBuilder::plainSkin()));
    builder.setOrthographicCamera(glm::dvec3(0, 0, 0.9) * kMm, {0, 0, 0}, 20 * kMm);
    RenderJob job{.scene = builder.scene(), .lights = {directionalLight("side", {0.9, 0, -0.1}, 2)}, .width = 16, .height = 16};
    job.aovs = {"thickness"};
    job.merge = "opposite";
    const Rendered result = render(job);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) ASSERT_EQ(valueAt(result.aov("thickness"), x, y), 60000);
}

}  // namespace
}  // namespace cutis::test
