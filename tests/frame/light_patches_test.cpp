// Gaussians that are wide beside the body: the patches that they sum, and that a renderer which keeps what it has drawn shows
// them as one that draws them first.
#include "renderer/frame/light_patches.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/frame/plan.h"
#include "renderer/scene/pose.h"
#include "renderer/skin/energy.h"
#include "tests/frame/small_scene.h"
#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

// The sum over patches of area times Gaussian, on a sphere, against 1 - exp(-A / 2πv). Theirs is the narrowest Gaussian that is
// wide and some that are wider.
TEST(LightPatches, GatherWhatASphereGathers) {
    SceneBuilder builder;
    builder.addObject("ball", makeSphere(0.1, SphereMapping::cube), builder.addSkin(SceneBuilder::plainSkin()));
    Scene scene = builder.scene();
    prepareScene(scene);
    Geometry geometry = flattenScene(scene);
    const SkinMesh mesh = makeSkinMesh(geometry);
    const Atlas atlas = layOutAtlas(scene, mesh, geometry, {.size = 128, .reachMm = {8, 8}});
    PatchList list;
    appendPatches(scene, geometry, atlas, 0, list);
    const double area = geometry.skinMm2[0];
    EXPECT_NEAR(area, 4 * std::numbers::pi * 1e4, 200);
    EXPECT_GT(list.patches.size(), 1000u);
    EXPECT_LT(list.patches.size(), 4000u);

    double patches = 0, samples = 0;
    std::uint32_t next = 0;
    for (const shared::LightPatch& patch : list.patches) {
        EXPECT_EQ(patch.firstSample, next);
        EXPECT_GT(patch.sampleCount, 0u);
        next += patch.sampleCount;
        patches += patch.area;
        EXPECT_GT(glm::dot(patch.normal, glm::normalize(patch.centre)), 0.99f);
    }
    EXPECT_EQ(next, list.samples.size());
    for (const shared::PatchSample& sample : list.samples) {
        samples += sample.area;
        EXPECT_TRUE(sample.place.x > 0 && sample.place.x < 128 && sample.place.y > 0 && sample.place.y < 128);
    }
    EXPECT_NEAR(patches / area, 1, 1e-5);
    EXPECT_NEAR(samples / area, 1, 1e-5);

    for (const double variance : {kWideShare * area, 0.1 * area, area, 100 * area}) {
        double worst = 0;
        const double expected = skin::gatheredShare(variance, area);
        for (std::size_t at = 0; at < geometry.positions.size(); at += 97) {
            double sum = 0;
            for (const shared::LightPatch& patch : list.patches) {
                const double d = 1000 * glm::distance(patch.centre, geometry.positions[at]);
                sum += patch.area * std::exp(-d * d / (2 * variance)) / (2 * std::numbers::pi * variance);
            }
            worst = std::max(worst, std::abs(sum / expected - 1));
        }
        expectAtMost("gathered of even light, relative to what a sphere gathers", worst, 0.002);
    }
}

TEST(LightPatches, TheNeedIsThereOnlyWithWideGaussians) {
    NeedsInput input{.skinDraws = 1, .lightSamples = 1};
    Needs needs = computeNeeds(input);
    EXPECT_FALSE(needs[Need::wideGaussians]);
    input.wideGaussians = 2;
    needs = computeNeeds(input);
    EXPECT_TRUE(needs[Need::wideGaussians]);
    EXPECT_EQ(needs.why(Need::wideGaussians), "2 Gaussians wide beside the body");
}

// Of the small scene, wide beside the ear and not beside the head; "other" goes up 0.1 m in a second.
class WideGaussians : public SmallSceneTest {
  protected:
    WideGaussians() {
        small_.input.environment = nullptr;
        small_.scene.materials[small_.glassMaterial].alphaMode = AlphaMode::opaque;
        small_.skin().profile.gaussians.back().variance = 300;
    }
    SmallScene small_;
};

TEST_F(WideGaussians, AreDrawnFromWhatIsKeptAsAnew) {
    Scene& scene = small_.scene;
    scene.nodes[2].rest = toTransform(scene.nodes[2].local);
    scene.animations.push_back({"up",
                                {{Interpolation::linear, 3, {0, 1}, {0, 0, 0, 0, 0.1f, 0}}},
                                {{0, 2, AnimatedProperty::translation}},
                                1});
    Renderer renderer(device(), Renderer::Views::any);
    const auto draw = [&](Renderer& with) { return with.render(small_.input, small_.settings); };
    const RenderResult first = draw(renderer);
    EXPECT_TRUE(std::any_of(first.stats.passes.begin(), first.stats.passes.end(),
                            [](const PassStats& pass) { return pass.name == "wide_gaussians" && pass.runs == 1; }));
    const auto expectAsAnew = [&](const char* what) {
        SCOPED_TRACE(what);
        const Picture kept = draw(renderer).picture;
        Renderer fresh(device(), Renderer::Views::any);
        EXPECT_LE(worstDifference(kept, draw(fresh).picture), 2e-6);
    };
    small_.input.rig.lights[0].intensity *= 3;
    expectAsAnew("another light");
    poseScene(scene, 0, 0.6);
    ++small_.input.poseRevision;
    expectAsAnew("another pose");
    small_.skin().profile.gaussians.back().variance = 0.02;
    expectAsAnew("no Gaussian is wide any more");
    small_.skin().profile.gaussians.back().variance = 3000;
    expectAsAnew("wide beside the head too");
}

TEST_F(WideGaussians, AreTheSameWithEverythingOn) {
    const RenderResult pruned = renderPicture(device(), small_.input, small_.settings);
    small_.settings.prune = false;
    const RenderResult all = renderPicture(device(), small_.input, small_.settings);
    EXPECT_LE(worstDifference(pruned.picture, all.picture), 2e-6);
}

}  // namespace
}  // namespace cutis::test
