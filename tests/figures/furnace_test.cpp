// Figure 1: white skin in a white room cannot be seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

// Diffuse and specular leave (1 - ρ_dt(N·V)) + ρ_dt(N·V) = 1 at every pixel (DESIGN §1.1). Held where N·V ≥
// 0.2, which on this picture is three pixels inside the silhouette.
class WhiteFurnace : public ::testing::TestWithParam<double> {};

TEST_P(WhiteFurnace, SphereIsOneEverywhere) {
    SkinMaterial skin;
    skin.roughness = GetParam();
    SceneBuilder builder;
    builder.addObject("body", makeSphere(100 * kMm, SphereMapping::latLong), builder.addSkin(skin));
    builder.setOrthographicCamera({0, 0, 0.5}, {0, 0, 0}, 0.21);
    RenderJob job{.scene = builder.scene(), .width = 240, .height = 240};
    job.environment = makeEnvironment(64, 32, [](const glm::dvec3&) { return glm::dvec3(1); });
    job.aovs = {"normal"};
    const Rendered result = render(job);

    double sum = 0, largest = 0;
    int count = 0;
    for (int y = 0; y < job.height; ++y)
        for (int x = 0; x < job.width; ++x) {
            if (valueAt(result.picture, x, y, 3) < 0.999 || valueAt(result.aov("normal"), x, y, 2) < 0.2)
                continue;
            for (int c = 0; c < 3; ++c) {
                const double error = std::abs(valueAt(result.picture, x, y, c) - 1);
                sum += error, largest = std::max(largest, error), ++count;
            }
        }
    ASSERT_GT(count, 3 * 30000);
    const std::string name = "white furnace m=" + std::to_string(GetParam()).substr(0, 4);
    expectAtMost(name + " mean", sum / count, 0.002);
    expectAtMost(name + " maximum", largest, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Roughness, WhiteFurnace, ::testing::Values(0.05, 0.1, 0.3, 0.6, 1.0),
                         [](const auto& instance) {
                             return "m_" + std::to_string(std::lround(instance.param * 100)) + "_hundredths";
                         });

}  // namespace
}  // namespace cutis::test
