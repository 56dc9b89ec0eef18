// Edits of quality, profiles, background and the environment's sun, without a window.
#include <gtest/gtest.h>

#include "app/viewer/edits.h"
#include "renderer/measure/front.h"

namespace cutis::test {
namespace {

using namespace app;

Document oneSkin() {
    Document document;
    document.skin = {std::nullopt, SkinMaterial{}};
    document.rig.environment.file = "/sky.exr";
    return document;
}

TEST(LookEdits, TheSunBecomesALightInOneEdit) {
    EditList edits;
    edits.reset(oneSkin());
    Light sun;
    sun.name = "sun";
    sun.type = LightType::directional;
    int added = -1;
    edits.apply("Take the sun out", [&](Document& document) { added = takeSunOut(document, sun); });
    const Document& document = edits.document();
    EXPECT_EQ(added, 0);
    EXPECT_TRUE(document.rig.environment.sunRemoved);
    ASSERT_EQ(document.rig.lights.size(), 1u);
    EXPECT_EQ(document.solo.size(), 1u);
    EXPECT_TRUE(edits.unsaved()) << "it is part of the rig";
    edits.undo();
    EXPECT_FALSE(edits.document().rig.environment.sunRemoved);
    EXPECT_TRUE(edits.document().rig.lights.empty());
}

TEST(LookEdits, QualityAndBackgroundAreEditsButNoPartOfTheRig) {
    EditList edits;
    edits.reset(oneSkin());
    edits.apply("Quality", [](Document& document) { document.quality.gaussians = 3; });
    edits.apply("Background", [](Document& document) { document.background = Background::blurred; });
    EXPECT_FALSE(edits.unsaved());
    edits.undo();
    EXPECT_EQ(edits.document().background, Background::none);
    edits.undo();
    EXPECT_EQ(edits.document().quality, Quality{});
}

TEST(LookEdits, AToleranceTakesTheCheapestThatWasMeasured) {
    const MeasuredFront front{
        .device = "paper",
        .width = 100,
        .height = 100,
        .settings = {{{.name = "coarse", .irradianceSize = 256, .areaSamples = 2}, 0.1, 1},
                     {{.name = "default"}, 0.02, 5},
                     {{.name = "fine", .irradianceSize = 4096}, 0.01, 9}}};
    Light area;
    area.type = LightType::rect;
    area.size = {1, 1};
    const auto chosen = [&](double tolerance, int side) {
        Rig rig;
        rig.lights = {area};
        RenderSettings settings;
        settings.width = settings.height = side;
        applyQuality({.tolerance = tolerance}, front, rig, settings);
        return std::pair(settings.irradianceSize, rig.lights[0].samples);
    };
    EXPECT_EQ(chosen(0.2, 100), std::pair(256, 2));
    EXPECT_EQ(chosen(0.2, 200), std::pair(512, 2)) << "as fine beside the pixels of a larger picture";
    EXPECT_EQ(chosen(0.05, 100), std::pair(0, 0));
    EXPECT_EQ(chosen(0.001, 100), std::pair(4096, 0)) << "nothing is so close: the closest";
}

TEST(LookEdits, TheErrorOfAQualityIsKnownWhereItWasMeasured) {
    const MeasuredFront front = defaultFront();
    ASSERT_NE(measuredOf(Quality{}, front), nullptr);
    EXPECT_EQ(measuredOf(Quality{}, front)->setting.name, "default");
    EXPECT_EQ(measuredOf({.gaussians = 1}, front), nullptr);
}

TEST(LookEdits, AProfileNeverGivesBackMoreThanItGets) {
    Document document = oneSkin();
    skin::Profile profile;
    profile.gaussians = {{1, {0.5, 0.2, 0}}, {2, {1.5, 0.2, 0}}};
    setProfile(document, 1, profile);
    const skin::Profile& held = document.skin[1]->profile;
    EXPECT_NEAR(held.gaussians[0].weight.x, 0.25, 1e-12);
    EXPECT_NEAR(held.gaussians[1].weight.x, 0.75, 1e-12);
    EXPECT_EQ(held.gaussians[1].weight.y, 0.2) << "a channel below 1 stays";
    setProfile(document, 0, profile);
    EXPECT_FALSE(document.skin[0]) << "not skin";
    for (skin::Gaussian& gaussian : profile.gaussians) gaussian.weight = glm::dvec3(0);
    setProfile(document, 1, profile);
    EXPECT_NEAR(document.skin[1]->profile.gaussians[0].weight.x, 0.25, 1e-12)
        << "skin without light is refused";
}

TEST(LookEdits, NormalisedProfilesSumToOne) {
    skin::Profile profile;
    profile.gaussians = {{4, {0.5, 0.1, 0}}, {1, {0.5, 0.3, 0}}};
    const skin::Profile result = normalized(profile);
    EXPECT_EQ(result.gaussians[0].variance, 1) << "sorted";
    const glm::dvec3 total = skin::totalWeight(result);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(total[c], 1, 1e-12);
    EXPECT_NEAR(result.gaussians[0].weight.y, 0.75, 1e-12);
    EXPECT_EQ(result.gaussians[0].weight.z, 1) << "a channel without weight is not scattered";
}

TEST(LookEdits, GaussiansComeAndGo) {
    skin::Profile profile = skin::threeLayerProfile();
    const std::size_t count = profile.gaussians.size();
    addGaussian(profile);
    ASSERT_EQ(profile.gaussians.size(), count + 1);
    EXPECT_GT(profile.gaussians.back().variance, profile.gaussians[count - 1].variance);
    EXPECT_EQ(skin::totalWeight(profile), skin::totalWeight(skin::threeLayerProfile()));
    for (std::size_t i = 0; i < count + 5; ++i) removeGaussian(profile, 0);
    EXPECT_EQ(profile.gaussians.size(), 1u);
    for (int i = 0; i < 100; ++i) addGaussian(profile);
    EXPECT_EQ(profile.gaussians.size(), std::size_t(skin::kMaxGaussians));
}

}  // namespace
}  // namespace cutis::test
