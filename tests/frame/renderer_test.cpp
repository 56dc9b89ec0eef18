// A renderer that keeps what it can, against one that starts afresh for each picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/core/error.h"
#include "tests/frame/small_scene.h"

namespace cutis::test {
namespace {

class KeepingRenderer : public SmallSceneTest {
  protected:
    KeepingRenderer() { input_.environment = nullptr; }

    // Renders with what was kept and afresh, holds one against the other, and returns the passes that ran.
    std::string render(int expectedMaps = -1) {
        const RenderResult kept = renderer_.render(input_, settings_);
        const RenderResult fresh = renderPicture(device(), input_, settings_);
        double worst = 0;
        EXPECT_EQ(kept.picture.values.size(), fresh.picture.values.size());
        for (std::size_t i = 0; i < fresh.picture.values.size(); ++i) {
            worst = std::max<double>(worst, std::abs(kept.picture.values[i] - fresh.picture.values[i]));
        }
        // The same arithmetic texel by texel; a sum's order may differ by a rounding. Radiances reach 1.
        EXPECT_LE(worst, 2e-6);
        EXPECT_EQ(kept.aovs.size(), fresh.aovs.size());
        EXPECT_TRUE(expectedMaps < 0 || kept.stats.lightMapsDrawn == expectedMaps) << kept.stats.lightMapsDrawn;
        std::string ran;
        for (const PassStats& pass : kept.stats.passes) {
            if (pass.runs > 0) ran += (ran.empty() ? "" : " ") + pass.name;
            EXPECT_EQ(pass.reason.rfind("unchanged: ", 0) == 0, pass.runs == 0) << pass.name;
        }
        return ran;
    }

    static constexpr const char* kAll =
        "surface light_maps thickness irradiance diffusion exitance composite";
    static constexpr const char* kLight = "irradiance diffusion exitance composite";
    static constexpr const char* kLightPlaces = "light_maps thickness irradiance diffusion exitance composite";
    static constexpr int kGroups = 4;  // head, ear, other and the wall: maps of a light sample

    SmallScene small_;
    Scene& scene_ = small_.scene;
    Environment& sky_ = small_.sky;
    const int skin_ = small_.skinMaterial;
    RenderInput& input_ = small_.input;
    RenderSettings& settings_ = small_.settings;
    Renderer renderer_{device()};
};

TEST_F(KeepingRenderer, CameraAndPicture) {
    EXPECT_EQ(render(6 * kGroups), kAll);
    EXPECT_EQ(render(0), "");
    input_.camera = small_.cameraAt(0.05, 0.6);
    EXPECT_EQ(render(0), "composite");
    settings_.width = 100;
    EXPECT_EQ(render(0), "composite");
    settings_.aovs = {"irradiance", "normal"};
    EXPECT_EQ(render(0), "composite");
}

TEST_F(KeepingRenderer, Lights) {
    render();
    input_.rig.lights[0].position.x += 0.05;
    EXPECT_EQ(render(kGroups), kLightPlaces) << "moved";
    input_.rig.lights[2].intensity *= 2;
    input_.rig.lights[1].color = {1, 0.5, 0.2};
    EXPECT_EQ(render(0), kLight) << "brighter, and of another colour";
    input_.rig.lights[1].enabled = false;
    EXPECT_EQ(render(0), kLightPlaces) << "muted";
    input_.rig.lights[1].enabled = true;
    EXPECT_EQ(render(0), kLightPlaces) << "back";
    std::swap(input_.rig.lights[0], input_.rig.lights[2]);
    EXPECT_EQ(render(0), kLightPlaces) << "reordered";
    input_.rig.lights.push_back(pointLight("kicker", {-0.3, -0.2, 0.5}, 0.3));
    EXPECT_EQ(render(kGroups), kLightPlaces) << "added";
    input_.rig.lights.erase(input_.rig.lights.begin());
    EXPECT_EQ(render(0), kLightPlaces) << "deleted";
    input_.rig.lights[0].shadow = false;
    EXPECT_EQ(render(0), kLightPlaces) << "without shadow";
    input_.rig.lights.clear();
    EXPECT_EQ(render(0), "composite") << "none";
}

TEST_F(KeepingRenderer, Environment) {
    input_.environment = &sky_;
    EXPECT_EQ(render(), "surface light_maps thickness environment_visibility irradiance diffusion exitance composite");
    input_.rig.environment.intensity = 2;
    EXPECT_EQ(render(0), kLight);
    input_.rig.environment.rotation = 70;
    EXPECT_EQ(render(0), "environment_visibility irradiance diffusion exitance composite");
    sky_ = skyOf(1, 2);
    ++input_.environmentRevision;
    EXPECT_EQ(render(0), "environment_visibility irradiance diffusion exitance composite");
    input_.rig.environment.enabled = false;
    EXPECT_EQ(render(0), kLight);
    input_.rig.environment.enabled = true;
    input_.rig.environment.shadowSamples = 2;
    renderer_.render(input_, settings_);
    input_.rig.environment.intensity = 1;
    EXPECT_EQ(render(0), kLight) << "its samples stay where they are";
}

TEST_F(KeepingRenderer, Materials) {
    render();
    SkinMaterial& skin = *scene_.materials[skin_].skin;
    skin.roughness = 0.5;
    EXPECT_EQ(render(0), kLight);
    skin.mix = 1;
    EXPECT_EQ(render(0), kLight);
    skin.scale = 0.9;
    EXPECT_EQ(render(0), "thickness irradiance diffusion exitance composite");
    skin.profile.gaussians.resize(3);
    // Gutters become narrower, so the atlas is laid out anew; light maps hold places in it.
    EXPECT_EQ(render(6 * kGroups), "surface light_maps thickness irradiance diffusion exitance composite");
    skin.translucency = false;
    // Light maps lose their entry points, and more Gaussians are narrower than a texel.
    EXPECT_EQ(render(6 * kGroups), "surface light_maps irradiance diffusion exitance composite");
}

TEST_F(KeepingRenderer, Geometry) {
    render();
    scene_.nodes[2].local[3] = {0, 0.05, 0, 1};
    prepareScene(scene_);
    ++input_.sceneRevision;
    EXPECT_EQ(render(), kAll);
    scene_.materials[skin_].skin.reset();
    prepareScene(scene_);
    EXPECT_EQ(render(), "light_maps composite");
}

// Texels follow the view only when it asks for much finer or coarser ones.
TEST_F(KeepingRenderer, DetailStaysWhileTheCameraMoves) {
    settings_.irradianceSize = 0;
    const int first = renderer_.render(input_, settings_).stats.atlasWidth;
    input_.camera.xmag *= 1.4;
    input_.camera.ymag *= 1.4;
    RenderResult result = renderer_.render(input_, settings_);
    EXPECT_EQ(result.stats.atlasWidth, first);
    input_.camera.xmag *= 1.4;
    input_.camera.ymag *= 1.4;
    result = renderer_.render(input_, settings_);
    EXPECT_LT(result.stats.atlasWidth, first);
    settings_.detail = 2;
    EXPECT_GT(renderer_.render(input_, settings_).stats.atlasWidth, result.stats.atlasWidth);
}

TEST_F(KeepingRenderer, MemoryDoesNotGrow) {
    const auto turn = [&](int i) {
        input_.camera.xmag = input_.camera.ymag = 0.25 + 0.001 * (i % 2);
        input_.rig.lights[0].position.x = 0.4 + 0.01 * (i % 3);
        input_.rig.lights[1].enabled = i % 2 == 0;
        renderer_.render(input_, settings_);
    };
    for (int i = 0; i < 12; ++i) turn(i);
    const std::uint64_t before = device().bytesAllocated();
    for (int i = 0; i < 12; ++i) turn(i);
    EXPECT_EQ(device().bytesAllocated(), before);
    renderer_.forget();
    EXPECT_LT(device().bytesAllocated(), before);
}

TEST_F(KeepingRenderer, StartsAfreshAfterAnError) {
    render();
    const RenderSettings good = settings_;
    settings_.irradianceSize = 2;  // no room for the charts
    EXPECT_THROW(renderer_.render(input_, settings_), Error);
    settings_ = good;
    EXPECT_EQ(render(), kAll);
}

// Wherever it is, the next picture is right, whether the light is still what it was to be or as it was before.
TEST_F(KeepingRenderer, GoesOnFromWhereItWasInterrupted) {
    render();
    const RenderInput before = input_;
    int asked = 0, stop = 0;
    const auto renderUntil = [&](int step) {
        asked = 0, stop = step;
        settings_.stopAsked = [&] { return ++asked == stop; };
        input_.rig.lights[0].position.x += 0.01;
        input_.camera.xmag += 0.001;
        EXPECT_EQ(step > 0, [&] {
            try {
                renderer_.render(input_, settings_);
                return false;
            } catch (const Interrupted&) {
                return true;
            }
        }());
        settings_.stopAsked = {};
    };
    renderUntil(0);
    const int steps = asked;
    ASSERT_GT(steps, 20) << "too coarse to be of use";
    for (int step = 1; step < steps; step += steps / 5) {
        SCOPED_TRACE(step);
        renderUntil(step);
        if (step % 2 == 0) input_ = before;
        render();
    }
    // All but the last command has run: what follows from the light is there.
    renderUntil(steps);
    EXPECT_EQ(render(0), "composite");
}

// Repeats time all of the frame.
TEST_F(KeepingRenderer, RepeatsRunEveryRow) {
    render();
    settings_.repeats = 2;
    const RenderResult result = renderer_.render(input_, settings_);
    for (const PassStats& pass : result.stats.passes) EXPECT_EQ(pass.repeatedMs.size(), 2u) << pass.name;
    EXPECT_EQ(result.stats.lightMapsDrawn, 6 * kGroups);
    settings_.repeats = 1;
    EXPECT_EQ(render(0), "");
}

}  // namespace
}  // namespace cutis::test
