// Scenes that each lack something: what is left out, and that the picture is the one in which everything ran.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <set>

#include "renderer/frame/light_reach.h"
#include "renderer/scene/light_samples.h"
#include "tests/frame/small_scene.h"

namespace cutis::test {
namespace {

// A small scene that lacks nothing, for cases to take something from.
struct Case {
    const char* name;
    std::function<void(SmallScene&)> lack;
    std::set<std::string> leftOut;  // names of rows and parts, beyond what the full scene leaves out
    double bound = 2e-6;            // largest difference of radiances, which reach 1: a sum's order may differ
};

const std::vector<Case>& cases() {
    static const std::vector<Case> all{
        {"nothing", [](SmallScene&) {}, {}},
        {"no environment", [](SmallScene&) {}, {}},
        {"no lights",
         [](SmallScene& s) {
             s.input.rig.lights.clear();
             s.input.environment = &s.sky;
         },
         {"light_maps", "thickness", "translucency", "area_lights"}},
        {"no shadows",
         [](SmallScene& s) {
             for (Light& light : s.input.rig.lights) light.shadow = false;
         },
         {"light_maps", "thickness", "translucency"}},
        {"no area lights", [](SmallScene& s) { s.input.rig.lights.erase(s.input.rig.lights.begin() + 2); },
         {"area_lights"}},
        {"no translucency",
         [](SmallScene& s) { s.skin().translucency = false; },
         {"gaussians", "thickness", "translucency"}},
        {"no skin",
         [](SmallScene& s) {
             s.scene.materials[s.skinMaterial].skin.reset();
             prepareScene(s.scene);
         },
         {"surface", "visible", "thickness", "needed_texels", "irradiance", "diffusion", "exitance", "translucency",
          "skin_specular"}},
        {"no transparency",
         [](SmallScene& s) { s.scene.materials[s.glassMaterial].alphaMode = AlphaMode::opaque; },
         {"transparency"}},
        {"no specular", [](SmallScene& s) { s.skin().specular = 0; }, {"skin_specular"}},
        {"a Gaussian without weight",
         [](SmallScene& s) { s.skin().profile.gaussians[3].weight = glm::dvec3(0); },
         {"gaussians"}},
        {"Gaussians narrower than a texel",
         [](SmallScene& s) {
             s.settings.irradianceSize = 48;
             s.skin().translucency = false;
         },
         {"gaussians", "thickness", "translucency"},
         // The smallest fiftieth of texels stays sharper. Texels are 11 mm here.
         3e-3},
        {"a character out of view",
         [](SmallScene& s) { s.input.camera = s.cameraAt(0.25); },
         {"character other", "light maps"}},
        {"a light out of range",
         [](SmallScene& s) {
             s.input.rig.lights[0].range = 0.1;
         },
         {"light key"}},
        {"a light behind which all stand",
         [](SmallScene& s) { s.input.rig.lights[2].direction = normalize(glm::dvec3(-0.7, 0.5, 0.5)); },
         {"light box", "area_lights"}},
        {"a spot that misses one",
         [](SmallScene& s) {
             Light& spot = s.input.rig.lights[0];
             spot = spotLight("spot", {0.4, 0.3, 0.5}, normalize(glm::dvec3(-0.4, -0.3, -0.5)), 1, 0.05, 0.1);
         },
         {"light maps"}},
        {"a texture that nothing samples",
         [](SmallScene& s) { s.scene.materials[s.skinMaterial].baseColorTexture = {}; },
         {"textures"}},
    };
    return all;
}

std::set<std::string> namesOf(const std::vector<LeftOut>& list) {
    std::set<std::string> names;
    for (const LeftOut& left : list) {
        EXPECT_FALSE(left.reason.empty()) << left.name;
        names.insert(left.name);
    }
    return names;
}

// Lists of what is seen, which only pruning keeps.
constexpr std::uint64_t kBookkeeping = 4096;

double sumMs(const RenderStats& stats) {
    double sum = 0;
    for (const PassStats& pass : stats.passes) sum += pass.gpuMs;
    return sum;
}

class LeftOutParts : public SmallSceneTest {};

TEST_F(LeftOutParts, WhatIsLeftOutChangesNothing) {
    std::set<std::string> always;  // left out of the full scene too
    std::printf("%-34s %9s %9s %9s %9s %9s\n", "scene", "ms", "ms, all", "MiB", "MiB, all", "change");
    for (const Case& what : cases()) {
        SCOPED_TRACE(what.name);
        SmallScene scene;
        const bool full = what.name == std::string("nothing");
        if (!full) scene.input.environment = nullptr;  // the costliest pass, here, by far
        what.lack(scene);
        const RenderResult pruned = renderPicture(device(), scene.input, scene.settings);
        scene.settings.prune = false;
        const RenderResult all = renderPicture(device(), scene.input, scene.settings);
        ASSERT_EQ(pruned.picture.values.size(), all.picture.values.size());
        double worst = 0, brightest = 0;
        for (std::size_t i = 0; i < all.picture.values.size(); ++i) {
            worst = std::max<double>(worst, std::abs(all.picture.values[i] - pruned.picture.values[i]));
            brightest = std::max<double>(brightest, all.picture.values[i]);
        }
        EXPECT_LE(worst, what.bound);
        EXPECT_GT(brightest, 0.1);
        std::set<std::string> left = namesOf(pruned.stats.leftOut);
        if (full) always = left;
        for (const std::string& name : always) left.erase(name);
        std::set<std::string> expected = what.leftOut;
        if (!scene.input.environment) expected.insert("environment_visibility");
        for (const std::string& name : always) expected.erase(name);
        EXPECT_EQ(left, expected);
        constexpr double kMiB = 1 << 20;
        std::printf("%-34s %9.1f %9.1f %9.2f %9.2f %9.1e\n", what.name, sumMs(pruned.stats), sumMs(all.stats),
                    static_cast<double>(pruned.stats.bytesGpu) / kMiB, static_cast<double>(all.stats.bytesGpu) / kMiB,
                    worst);
        EXPECT_LE(pruned.stats.bytesGpu, all.stats.bytesGpu + kBookkeeping);
    }
}

// What is called dark is dark, and what shines into the box is not.
TEST(LightReach, IsNeverWrongAboutDarkness) {
    Bounds box;
    box.extend(glm::dvec3(-0.2, -0.1, -0.3));
    box.extend(glm::dvec3(0.2, 0.3, 0.1));
    Rig rig;
    int dark = 0, lit = 0;
    for (int i = 0; i < 400; ++i) {
        const double a = 0.7 * i, r = 0.35 + 0.002 * i;
        Light light = i % 2 ? rectLight("rect", {}, {}, 1, 0.1, 0.1, 1) : spotLight("spot", {}, {}, 1, 0.2, 0.5);
        light.position = glm::dvec3(std::cos(a), 0.6 * std::sin(1.7 * a), std::sin(a)) * r;
        light.direction = normalize(glm::dvec3(std::sin(2.3 * a), std::cos(0.9 * a), std::cos(3.1 * a)));
        light.range = i % 3 ? 0 : 0.2;
        rig.lights = {light};
        const LightSample sample = sampleLights(rig)[0];
        double most = 0;
        for (int k = 0; k < 1000; ++k) {
            const glm::dvec3 f(k % 10, k / 10 % 10, k / 100);
            const glm::dvec3 p = box.min + box.size() * (f / 9.0);
            most = std::max(most, irradianceFrom(sample, p, normalize(sample.position - p)).x);
        }
        (mayReach(sample, box) ? lit : dark)++;
        EXPECT_TRUE(most == 0 || mayReach(sample, box)) << i;
    }
    EXPECT_GT(dark, 100);
    EXPECT_GT(lit, 100);
}

}  // namespace
}  // namespace cutis::test
