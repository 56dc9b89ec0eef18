// Skin that a picture does not show is not lit, and the picture is the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

struct Case {
    const char* name;
    bool lights, environment;
    int taps = 0;  // as RenderJob has them
};
const Case kCases[] = {{"lights", true, false},
                       {"environment", false, true},
                       {"lights_and_environment", true, true},
                       {"lights_and_two_taps", true, false, 2}};

class HiddenSkin : public ::testing::TestWithParam<Case> {};

// A head that hides its back, a small ball that light shines through, and a disc before a part of the head.
RenderJob hiddenJob(const Case& what) {
    SceneBuilder builder;
    const int skin = builder.addSkin(SceneBuilder::plainSkin(), {0.8, 0.6, 0.5});
    builder.addObject("head", makeSphere(120 * kMm, SphereMapping::cube), skin);
    builder.addObject("ear", makeSphere(5 * kMm, SphereMapping::latLong), skin,
                      glm::dmat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0.128, 0.01, 0.02, 1}));
    builder.addObject("disc", makeSphere(20 * kMm, SphereMapping::latLong), builder.addMatte(),
                      glm::dmat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0.1, 0}, {-0.02, -0.03, 0.14, 1}));
    builder.setOrthographicCamera({0.02, 0.05, 0.5}, {0, 0, 0}, 0.3);
    RenderJob job{.scene = builder.scene(), .width = 150, .height = 130, .taps = what.taps};
    if (what.lights) {
        job.lights = {directionalLight("behind", {-0.3, -0.1, 1}, 5),
                      rectLight("key", {0.3, 0.3, 0.4}, {-0.6, -0.6, -0.8}, 20, 0.1, 0.1, 6)};
    }
    if (what.environment) {
        job.environment = makeEnvironment(32, 16, [](const glm::dvec3& w) { return glm::dvec3(1 + 0.8 * w.y); });
    }
    return job;
}

TEST_P(HiddenSkin, IsNotLitAndThePictureIsTheSame) {
    RenderJob job = hiddenJob(GetParam());
    const Rendered pruned = render(job);
    job.prune = false;
    const Rendered all = render(job);
    // The same arithmetic texel by texel; a sum's order may differ by a rounding.
    double worst = 0;
    for (std::size_t i = 0; i < all.picture.values.size(); ++i) {
        worst = std::max<double>(worst, std::abs(all.picture.values[i] - pruned.picture.values[i]));
    }
    const std::string name = std::string("pruned, ") + GetParam().name;
    expectAtMost(name + ": largest difference", worst, 2e-6);
    const double share = pruned.stats.texelsLit / pruned.stats.texelsCovered;
    expectAtMost(name + ": share of texels lit", share, 0.93);
    EXPECT_GT(share, 0.3) << "less than what is seen";
    EXPECT_EQ(all.stats.texelsLit, all.stats.texelsCovered);
    EXPECT_EQ(pruned.stats.texelsCovered, all.stats.texelsCovered);
    EXPECT_EQ(pruned.stats.runsOf("visible"), 1);
    EXPECT_EQ(all.stats.runsOf("visible"), 0);
}

INSTANTIATE_TEST_SUITE_P(Cases, HiddenSkin, ::testing::ValuesIn(kCases),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace cutis::test
