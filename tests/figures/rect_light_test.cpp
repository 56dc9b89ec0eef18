// Figure 10, area lights: irradiance of a rect light of 64 samples against its form factor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/closed_forms.h"
#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr double kWidth = 0.6, kHeight = 0.9, kRadiance = 5;

struct Receiver {
    const char* name;
    glm::dvec3 position, normal;
};

// The receiver is a plate of 20 mm at the origin of a frame that the light is placed in.
double worstError(const Receiver& receiver, const glm::dvec3& lightPosition,
                  const glm::dvec3& lightDirection) {
    const glm::dvec3 z = normalize(receiver.normal);
    const glm::dvec3 x = normalize(cross(std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), z));
    const glm::dvec3 y = cross(z, x);
    SceneBuilder builder;
    builder.addObject(
        "plate", makePlate(20 * kMm), builder.addSkin(SceneBuilder::plainSkin()),
        glm::dmat4(glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(receiver.position, 1)));
    builder.setOrthographicCamera(receiver.position + z * 0.1, receiver.position, 18 * kMm, y);
    RenderJob job{.scene = builder.scene()};
    job.lights = {rectLight("softbox", lightPosition, lightDirection, kRadiance, kWidth, kHeight, 64)};
    job.width = job.height = 32;
    job.irradianceSize = 64;
    job.aovs = {"irradiance", "position"};
    const Rendered result = render(job);
    EXPECT_EQ(result.stats.lightSamples, 64);

    const auto corners = rectCorners(lightPosition, lightDirection, kWidth, kHeight);
    double worst = 0;
    for (int j = 0; j < 32; ++j)
        for (int i = 0; i < 32; ++i) {
            const double exact = polygonIrradiance(rgbAt(result.aov("position"), i, j), z,
                                                   {corners.begin(), corners.end()}, kRadiance);
            worst = std::max(worst, std::abs(valueAt(result.aov("irradiance"), i, j) / exact - 1));
        }
    return worst;
}

TEST(RectLight, MatchesItsFormFactor) {
    const Receiver receivers[] = {
        {"parallel near", {0.1, -0.1, 0.6}, {0, 0, 1}},
        {"parallel far", {0.5, 0.3, -1}, {0, 0, 1}},
        {"tilted near", {0.2, 0, 0.5}, {0.6, 0.2, 0.7}},
        {"tilted far", {-0.8, 0.2, -0.5}, {0.9, -0.3, 0.5}},
    };
    for (const Receiver& receiver : receivers)
        expectAtMost(std::string("rect light ") + receiver.name, worstError(receiver, {0, 0, 1}, {0, 0, -1}),
                     0.01);
}

// As in the example of DESIGN §2.3: its width stays horizontal however it is aimed.
TEST(RectLight, KeepsItsWidthHorizontalWhenItIsAimed) {
    const glm::dvec3 position(-1, 1.8, 0.5), direction(0.8, -0.6, -0.5);
    expectAtMost("rect light aimed", worstError({"", {0, 1.2, 0}, -direction}, position, direction), 0.01);
}

TEST(RectLight, EmitsFromItsFrontOnly) {
    SceneBuilder builder;
    builder.addObject("plate", makePlate(20 * kMm), builder.addSkin(SceneBuilder::plainSkin()));
    builder.setOrthographicCamera({0, 0, 0.1}, {0, 0, 0}, 18 * kMm);
    RenderJob job{.scene = builder.scene()};
    job.lights = {rectLight("turned away", {0, 0, 1}, {0, 0, 1}, kRadiance, kWidth, kHeight, 4)};
    job.width = job.height = 16;
    job.aovs = {"irradiance"};
    const Rendered result = render(job);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) ASSERT_EQ(valueAt(result.aov("irradiance"), x, y), 0);
}

}  // namespace
}  // namespace cutis::test
