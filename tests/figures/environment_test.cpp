// Figure 10, environments: which way they lie, and that turning one is turning the scene the other way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <ostream>
#include <string>

#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr double kPi = std::numbers::pi;

// A smooth room: grey, a warm window to the right of the view, a cool floor.
glm::dvec3 room(const glm::dvec3& w) {
    const auto lobe = [&](const glm::dvec3& axis, double sharpness) {
        return std::exp(sharpness * (dot(w, normalize(axis)) - 1));
    };
    return glm::dvec3(0.2) + glm::dvec3(6, 5, 4) * lobe({1, 0.4, 0.3}, 20) +
           glm::dvec3(0.2, 0.4, 0.8) * lobe({0, -1, 0.2}, 3);
}

TEST(EnvironmentRotation, EqualsTheRotatedScene) {
    const double degrees = 37;
    const auto jobTurned = [](double sceneDegrees, double environmentDegrees) {
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1), sceneDegrees * kPi / 180, glm::dvec3(0, 1, 0));
        SceneBuilder builder;
        builder.addObject("head", makeNosedSphere(80 * kMm), builder.addSkin(SkinMaterial{}, {0.8, 0.6, 0.5}),
                          turn);
        Material metal;
        metal.name = "ball", metal.metallic = 1, metal.roughness = 0.3f;
        builder.addObject("ball", makeSphere(20 * kMm, SphereMapping::latLong), builder.addMaterial(metal),
                          turn * glm::translate(glm::dmat4(1), glm::dvec3(0.07, -0.05, 0.09)));
        builder.setOrthographicCamera(glm::dvec3(turn * glm::dvec4(0.1, 0.1, 0.5, 1)), {0, 0, 0}, 0.24);
        RenderJob job{.scene = builder.scene(), .width = 160, .height = 160, .irradianceSize = 256};
        job.environment = makeEnvironment(128, 64, room);
        job.environmentRotation = environmentDegrees;
        return job;
    };
    const Picture turnedEnvironment = render(jobTurned(0, degrees)).picture;
    const Picture turnedScene = render(jobTurned(-degrees, 0)).picture;
    expectAtMost("rotated environment against rotated scene", relativeL2(turnedEnvironment, turnedScene),
                 0.01);
    // The turn shows: the same picture without it is another one.
    EXPECT_GT(relativeL2(render(jobTurned(0, 0)).picture, turnedScene), 0.1);
}

// One small patch of light lights the side of a ball that faces it: E(N) = L Ω max(N·ω, 0).
struct Patch {
    const char* name;
    double column, row;  // in [0,1] of the lat-long picture
    double rotation;     // degrees
    glm::dvec3 towards;  // where the light must come from
};

void PrintTo(const Patch& patch, std::ostream* out) {
    *out << patch.name;
}

class EnvironmentOrientation : public ::testing::TestWithParam<Patch> {};

TEST_P(EnvironmentOrientation, LightsTheSideThatFacesIt) {
    const Patch& patch = GetParam();
    const glm::dvec3 axis = latLongDirection(patch.column, patch.row);
    const double cosRadius = std::cos(10 * kPi / 180), radiance = 20;
    const Picture environment = makeEnvironment(
        256, 128, [&](const glm::dvec3& w) { return glm::dvec3(dot(w, axis) > cosRadius ? radiance : 0); });
    // What the texels hold, rather than the ideal cap: their share of the sphere, weighted by direction.
    glm::dvec3 flux(0);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 256; ++x) {
            const double v0 = y / 128.0, v1 = (y + 1) / 128.0;
            const double solidAngle = 2 * kPi / 256 * (std::cos(v0 * kPi) - std::cos(v1 * kPi));
            flux += latLongDirection((x + 0.5) / 256, (y + 0.5) / 128) *
                    (solidAngle * valueAt(environment, x, y));
        }

    // Two cameras, so that each side of the ball is seen by one.
    NormRatio error;
    glm::dvec3 centre(0);
    for (const double side : {1.0, -1.0}) {
        SceneBuilder builder;
        builder.addObject("ball", makeSphere(100 * kMm, SphereMapping::cube),
                          builder.addSkin(SceneBuilder::plainSkin()));
        builder.setOrthographicCamera({0, 0, side * 0.5}, {0, 0, 0}, 0.21);
        RenderJob job{.scene = builder.scene(), .width = 100, .height = 100};
        job.environment = environment;
        job.environmentRotation = patch.rotation;
        job.aovs = {"irradiance", "normal"};
        const Rendered result = render(job);
        for (int y = 0; y < 100; ++y)
            for (int x = 0; x < 100; ++x) {
                if (valueAt(result.picture, x, y, 3) < 0.999) continue;
                const glm::dvec3 normal = rgbAt(result.aov("normal"), x, y);
                const double exact = std::max(0.0, dot(normal, patch.towards)) * length(flux);
                // Near its horizon a patch of 10° is partly set: the point formula does not hold there.
                if (std::abs(dot(normal, patch.towards)) < std::sin(12 * kPi / 180)) continue;
                const double value = valueAt(result.aov("irradiance"), x, y);
                error.add(value - exact, exact);
                centre += normal * value;
            }
    }
    EXPECT_GT(dot(normalize(centre), patch.towards), 0.98);
    expectAtMost(std::string("environment patch ") + patch.name, error.value(), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Patches, EnvironmentOrientation,
                         ::testing::Values(Patch{"centre", 0.5, 0.5, 0, {0, 0, -1}},
                                           Patch{"right", 0.75, 0.5, 0, {1, 0, 0}},
                                           Patch{"top", 0.5, 0.0, 0, {0, 1, 0}},
                                           // Counter-clockwise seen from above takes -Z to -X, and +X to -Z.
                                           Patch{"centre turned by 90", 0.5, 0.5, 90, {-1, 0, 0}},
                                           Patch{"right turned by 90", 0.75, 0.5, 90, {0, 0, -1}}),
                         [](const auto& instance) {
                             std::string name = instance.param.name;
                             std::replace(name.begin(), name.end(), ' ', '_');
                             return name;
                         });

// Its intensity is a factor, and --env none leaves nothing.
TEST(Environment, IsBlackWithoutOne) {
    SceneBuilder builder;
    builder.addObject("ball", makeSphere(100 * kMm, SphereMapping::cube), builder.addSkin(SkinMaterial{}));
    builder.setOrthographicCamera({0, 0, 0.5}, {0, 0, 0}, 0.21);
    RenderJob job{.scene = builder.scene(), .width = 32, .height = 32};
    const Rendered result = render(job);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) ASSERT_EQ(rgbAt(result.picture, x, y), glm::dvec3(0));
}

}  // namespace
}  // namespace cutis::test
