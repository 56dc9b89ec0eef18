// What a run promises besides its numbers: the same bits again, halves, interruption, going on.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>

#include "renderer/scene/camera.h"
#include "renderer/scene/characters.h"
#include "tests/reference/evaluate.h"
#include "tests/support/pictures.h"
#include "tests/support/process.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

class ReferenceRun : public ::testing::Test {
  protected:
    ReferenceRun() {
        setenv("CUTIS_CACHE_DIR", folder_.path().c_str(), 1);
        SceneBuilder builder;
        builder.addObject("ball", makeSphere(0.05, SphereMapping::cube),
                          builder.addSkin(SkinMaterial{}, {.8, .5, .4}));
        builder.setOrthographicCamera({0, 0, 1}, {0, 0, 0}, 0.12);
        scene_ = builder.scene();
        prepareScene(scene_);
        input_.scene = &scene_;
        input_.rig.lights = {
            rectLight("key", {0.5, 0.5, 1}, glm::normalize(glm::dvec3(-0.5, -0.5, -1)), 3, 0.4, 0.4, 1)};
        input_.camera = cameraFor(scene_, "", 1);
    }
    ~ReferenceRun() override { unsetenv("CUTIS_CACHE_DIR"); }

    reference::Settings settings(int passes, bool resume, std::uint32_t seed = 0) const {
        return {.width = 16,
                .height = 16,
                .seed = seed,
                .error = 0,
                .maxPasses = passes,
                .resume = resume,
                .aovs = {"diffuse", "specular", "stderr", "irradiance"}};
    }

    TemporaryFolder folder_;
    Scene scene_;
    reference::Input input_;
};

TEST_F(ReferenceRun, GoesOnWhereItWas) {
    const auto whole = reference::evaluate(input_, settings(3, false));
    EXPECT_EQ(whole.passes, 3);
    EXPECT_EQ(reference::evaluate(input_, settings(1, true)).passes, 1);
    const auto continued = reference::evaluate(input_, settings(3, true));
    EXPECT_EQ(continued.passes, 3);
    EXPECT_EQ(continued.picture.values, whole.picture.values);
    for (const auto& [name, picture] : whole.aovs)
        EXPECT_EQ(continued.aovs.at(name).values, picture.values) << name;
    // What is there is not computed again, and another seed or light is another picture.
    EXPECT_EQ(reference::evaluate(input_, settings(2, true)).passes, 3);
    EXPECT_EQ(reference::evaluate(input_, settings(2, true, 1)).passes, 2);
    input_.rig.lights[0].intensity = 4;
    EXPECT_EQ(reference::evaluate(input_, settings(2, true)).passes, 2);
}

TEST_F(ReferenceRun, StopsAndKeepsWhatIsDone) {
    std::atomic<bool> stop{false};
    reference::Hooks hooks;
    hooks.stop = &stop;
    hooks.progress = [&](const reference::Progress& at) { stop = at.passes >= 2; };
    const auto stopped = reference::evaluate(input_, settings(100000, true), hooks);
    EXPECT_TRUE(stopped.interrupted);
    EXPECT_TRUE(stopped.picture.values.empty());
    EXPECT_GE(stopped.passes, 2);
    // Rows of the pass that was given up count in the next one.
    const auto continued = reference::evaluate(input_, settings(stopped.passes + 1, true));
    EXPECT_FALSE(continued.interrupted);
    EXPECT_EQ(continued.passes, stopped.passes + 1);
    EXPECT_EQ(continued.picture.values,
              reference::evaluate(input_, settings(stopped.passes + 1, false)).picture.values);
}

TEST_F(ReferenceRun, ReachesTheErrorOrTheBudget) {
    reference::Settings to = settings(0, false);
    to.error = 0.03;
    const auto accurate = reference::evaluate(input_, to);
    EXPECT_LE(accurate.pictureError, 0.03);
    EXPECT_LE(accurate.diffuseError, 0.03);
    EXPECT_GT(accurate.pictureError, 0.002) << "far more work than was asked for";
    to.error = 0;
    to.budget = 0.5;
    const auto brief = reference::evaluate(input_, to);
    EXPECT_GE(brief.passes, 1);
    EXPECT_LT(brief.seconds, 20);
}

// The halves average to the whole, share nothing, and differ by what the standard error says: the mean square
// of their difference is 4 standard errors squared.
TEST_F(ReferenceRun, HalvesAreIndependentHalves) {
    const auto result = reference::evaluate(input_, settings(4, false));
    double difference2 = 0, error2 = 0;
    for (std::size_t i = 0; i < result.diffuseHalves[0].values.size(); ++i) {
        const double a = result.diffuseHalves[0].values[i], b = result.diffuseHalves[1].values[i];
        EXPECT_NEAR(0.5 * (a + b), result.aovs.at("diffuse").values[i], 1e-5 * (1 + a));
        difference2 += (a - b) * (a - b);
        error2 += std::pow(result.diffuseStandardError.values[i], 2);
    }
    EXPECT_NEAR(difference2 / (4 * error2), 1, 0.35);
    EXPECT_GT(difference2, 0);
}

TEST_F(ReferenceRun, ChannelsAddUp) {
    const auto result = reference::evaluate(input_, settings(2, false));
    for (int i = 0; i < 256; ++i)
        for (int c = 0; c < 3; ++c) {
            const double sum = valueAt(result.aovs.at("diffuse"), i % 16, i / 16, c) +
                               valueAt(result.aovs.at("specular"), i % 16, i / 16, c);
            EXPECT_NEAR(sum, valueAt(result.picture, i % 16, i / 16, c), 1e-5);
        }
    EXPECT_EQ(valueAt(result.picture, 0, 0, 3), 0);
    EXPECT_EQ(valueAt(result.picture, 8, 8, 3), 1);
}

}  // namespace
}  // namespace cutis::test
