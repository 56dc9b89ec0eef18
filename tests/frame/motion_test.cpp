// Scenes that move: what is kept from pose to pose, and that nothing jumps on the way.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "renderer/scene/camera.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/pose.h"
#include "tests/frame/small_scene.h"
#include "tests/support/figure.h"
#include "tests/support/process.h"
#include "tests/support/pictures.h"
#include "tests/support/walking_body.h"

namespace cutis::test {
namespace {

double rmsDifference(const Picture& a, const Picture& b) {
    double sum = 0;
    EXPECT_EQ(a.values.size(), b.values.size());
    for (std::size_t i = 0; i < b.values.size(); ++i) sum += std::pow(double(a.values[i]) - b.values[i], 2);
    return std::sqrt(sum / double(b.values.size()));
}

// Of the small scene the character "other" goes up 0.1 m in a second; all else stands still.
class MovingScene : public SmallSceneTest {
  protected:
    MovingScene() {
        Scene& scene = small_.scene;
        small_.input.environment = nullptr;
        // Shadows of what is seen through are drawn from thresholds, anew for every fit of a light map.
        scene.materials[small_.glassMaterial].alphaMode = AlphaMode::opaque;
        scene.nodes[kOther].rest = toTransform(scene.nodes[kOther].local);
        scene.animations.push_back({"up",
                                    {{Interpolation::linear, 3, {0, 1}, {0, 0, 0, 0, 0.1f, 0}}},
                                    {{0, kOther, AnimatedProperty::translation}},
                                    1});
    }

    RenderResult renderAt(double seconds) {
        poseScene(small_.scene, 0, seconds);
        ++small_.input.poseRevision;
        return renderer_.render(small_.input, small_.settings);
    }

    static constexpr int kOther = 2;  // node
    SmallScene small_;
    Renderer renderer_{device(), Renderer::Views::one};
};

std::string rowsThatRan(const RenderStats& stats) {
    std::string ran;
    for (const PassStats& pass : stats.passes) {
        if (pass.runs > 0) ran += (ran.empty() ? "" : " ") + pass.name;
    }
    return ran;
}

// The same as a renderer that never saw another pose, and as one that is given the pose as a scene at rest.
TEST_F(MovingScene, APoseIsDrawnAsIfThereWereNoOther) {
    renderAt(0);
    const RenderResult kept = renderAt(0.7);
    const RenderResult fresh = renderPicture(device(), small_.input, small_.settings);
    EXPECT_LE(worstDifference(kept.picture, fresh.picture), 2e-6);
    EXPECT_EQ(kept.stats.atlasWidth, fresh.stats.atlasWidth);
    EXPECT_EQ(kept.stats.atlasMmPerTexel, fresh.stats.atlasMmPerTexel);
    // The same scene that cannot move: only its light maps are fitted otherwise, which shows along the edges of shadows.
    small_.scene.animations.clear();
    const RenderResult baked = renderPicture(device(), small_.input, small_.settings);
    expectAtMost("root mean square difference of radiance, posed against baked",
                 rmsDifference(kept.picture, baked.picture), 3e-3);
}

TEST_F(MovingScene, OnlyMapsThatShowWhatMovedAreDrawn) {
    const int all = renderAt(0).stats.lightMapsDrawn;
    EXPECT_EQ(all, 24) << "six samples, four groups";
    const RenderStats moved = renderAt(0.3).stats;
    // Those of "other" itself, and of whatever its bounds may shade: at least the wall behind.
    EXPECT_GE(moved.lightMapsDrawn, 6);
    expectAtMost("light maps drawn of 24", moved.lightMapsDrawn, 18);
    for (const PassStats& row : moved.prepared) {
        const bool follows =
            row.name == "meshes" || row.name == "stretch" || row.name == "draws" || row.name == "draw_ranges";
        EXPECT_EQ(row.runs > 0, follows) << row.name;
    }
    // Beyond the last key nothing moves any more.
    renderAt(1.0);
    EXPECT_EQ(rowsThatRan(renderAt(5.0).stats), "");
    EXPECT_EQ(renderAt(0.3).stats.atlasTexelsCovered, moved.atlasTexelsCovered);
}

// Where every view counts, what stands still and in nobody's light or sky is not lit again, and looks as if it were.
TEST_F(MovingScene, OnlyWhatMovedAndWhatItShadesIsLitAgain) {
    for (const bool everything : {false, true}) {
        SCOPED_TRACE(everything ? "all lights and a sky" : "light from above");
        if (everything) small_.input.environment = &small_.sky;
        const Rig rig = small_.input.rig;
        if (!everything) small_.input.rig.lights = {directionalLight("down", {0, -1, 0}, 2)};
        Renderer renderer(device(), Renderer::Views::any);
        const auto pose = [&](double seconds) {
            poseScene(small_.scene, 0, seconds);
            ++small_.input.poseRevision;
            return renderer.render(small_.input, small_.settings);
        };
        pose(0);
        pose(0.2);
        const RenderResult kept = pose(0.7);
        int rows = 0;
        for (const PassStats& pass : kept.stats.passes) {
            const std::size_t at = pass.reason.find("of 4 groups, ");
            if (at == std::string::npos) continue;
            ++rows;
            const int changed = std::stoi(pass.reason.substr(at + 13));
            EXPECT_GE(changed, 1) << pass.name;
            EXPECT_LE(changed, everything ? 4 : 2) << pass.name;
        }
        EXPECT_GE(rows, everything ? 6 : 5) << "of surface, thickness, sky, irradiance, diffusion, exitance";
        Renderer fresh(device(), Renderer::Views::any);
        EXPECT_LE(worstDifference(kept.picture, fresh.render(small_.input, small_.settings).picture), 2e-6);
        small_.input.rig = rig;
    }
}

// A pose that was drawn in part, and then the one before it again: what was lit for the other must not stay.
TEST_F(MovingScene, APoseThatWasInterruptedLeavesNothingBehind) {
    Renderer renderer(device(), Renderer::Views::any);
    int asked = 0, stop = 0;
    const auto pose = [&](double seconds) {
        poseScene(small_.scene, 0, seconds);
        ++small_.input.poseRevision;
        asked = 0;
        return renderer.render(small_.input, small_.settings);
    };
    pose(0.7);
    small_.settings.stopAsked = [&] { return ++asked == stop; };
    pose(0.2);
    const int steps = asked;
    for (stop = steps / 4; stop < 2 * steps / 3; stop += steps / 4) {
        SCOPED_TRACE(stop);
        EXPECT_THROW(pose(0.7), Interrupted);
        const int at = std::exchange(stop, 0);
        const RenderResult kept = pose(0.2);
        stop = at;
        Renderer fresh(device(), Renderer::Views::any);
        RenderSettings settings = small_.settings;
        settings.stopAsked = {};
        EXPECT_LE(worstDifference(kept.picture, fresh.render(small_.input, settings).picture), 2e-6);
    }
}

// As fine as the nearest of the pictures to come asks, from the first on.
TEST_F(MovingScene, AnticipatedPicturesShareOneAtlas) {
    small_.settings.irradianceSize = 0;
    const Camera near = small_.cameraAt(-0.05, 0.2), far = small_.cameraAt(-0.05, 0.8);
    const auto widthFrom = [&](const Camera& camera) {
        small_.input.camera = camera;
        return renderer_.render(small_.input, small_.settings).stats.atlasWidth;
    };
    const int nearWidth = widthFrom(near), farWidth = widthFrom(far);
    EXPECT_LT(farWidth, nearWidth);
    renderer_.forget();
    for (const Camera& camera : {far, near}) {
        small_.input.camera = camera;
        renderer_.anticipate(small_.input, small_.settings);
    }
    EXPECT_EQ(widthFrom(far), nearWidth);
    EXPECT_EQ(widthFrom(near), nearWidth);
}

// Irradiance on the legs of a walking figure. From frame to frame it changes as the legs turn in the light;
// were texels to jump, a tenth of the time would change it as much as the whole.
TEST_F(SmallSceneTest, NothingJumpsOnTheSkinOfAWalker) {
    const TemporaryFolder folder;
    Scene scene = loadGltf(writeWalkingBody(folder.path()));
    ASSERT_EQ(scene.characters.size(), 1u);
    Renderer renderer(device(), Renderer::Views::one);
    RenderInput input{.scene = &scene};
    input.rig.lights = {directionalLight("sun", normalize(glm::dvec3(-0.5, -0.6, -1)), 3)};
    input.camera = cameraFor(scene, "orbit:0,0.45,0.3,20,5,3,20", 0.75);
    RenderSettings settings;
    settings.width = 60, settings.height = 80;
    settings.aovs = {"irradiance"};
    settings.lightMapSize = 512;
    const auto irradianceAt = [&](double seconds) {
        poseScene(scene, 0, seconds);
        ++input.poseRevision;
        return renderer.render(input, settings);
    };
    // Root mean square over what is seen of the skin in both, relative to its mean.
    const auto change = [&](const Picture& a, const Picture& b) {
        double sum = 0, mean = 0;
        int pixels = 0;
        for (std::size_t i = 0; i < a.values.size(); ++i) {
            if (!(a.values[i] > 0 && b.values[i] > 0)) continue;
            sum += std::pow(double(a.values[i]) - b.values[i], 2), mean += a.values[i], ++pixels;
        }
        EXPECT_GT(pixels, 300);
        return std::sqrt(sum / pixels) / (mean / pixels);
    };
    double frames = 0, tenths = 0;
    RenderResult before = irradianceAt(0.5);
    const int width = before.stats.atlasWidth;
    for (int frame = 13; frame < 17; ++frame) {
        const RenderResult soon = irradianceAt((frame - 0.9) / 24), next = irradianceAt(frame / 24.0);
        tenths = std::max(tenths, change(before.aovs.at("irradiance"), soon.aovs.at("irradiance")));
        frames = std::max(frames, change(before.aovs.at("irradiance"), next.aovs.at("irradiance")));
        EXPECT_EQ(next.stats.atlasWidth, width);
        EXPECT_EQ(next.stats.nonfinite, 0u);
        before = next;
    }
    expectAtMost("largest change of irradiance in a 24th of a second", frames, 0.25);
    expectAtMost("in a tenth of that", tenths, 0.5 * frames);
}

}  // namespace
}  // namespace cutis::test
