// What a picture of many characters and lights takes of the device's memory, against the formula of docs/plan.md.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>

#include "renderer/scene/camera.h"
#include "renderer/scene/characters.h"
#include "tests/frame/small_scene.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr double kMB = 1e6;

// Heads in rows of four, each a character, and lights all round.
struct Crowd {
    Crowd(int heads, int lights) {
        const int skin = builder.addSkin(SkinMaterial());
        for (int i = 0; i < heads; ++i) {
            Primitive head = makeBox(glm::dvec3(-0.1), glm::dvec3(0.1));
            for (glm::vec3& p : head.positions) p += glm::vec3(0.3 * (i % 4 - 1.5), 0, -0.3 * (i / 4));
            builder.addObject("head " + std::to_string(i), head, skin);
        }
        scene = builder.scene();
        findCharacters(scene);
        input.scene = &scene;
        for (int i = 0; i < lights; ++i) {
            const double angle = 2 * std::numbers::pi * i / lights;
            input.rig.lights.push_back(pointLight("light " + std::to_string(i), {2 * std::sin(angle), 0.5, 2 * std::cos(angle)}, 1));
        }
        sky = skyOf(0.3, 4);
        input.environment = &sky;
        input.camera = cameraFor(scene, "auto", 1);
    }
    SceneBuilder builder;
    Scene scene;
    Environment sky;
    RenderInput input;
};

class Memory : public SmallSceneTest {
  protected:
    // By row.
    std::map<std::string, double> bytesOf(const Crowd& crowd, const RenderSettings& settings) {
        stats = Renderer(device(), Renderer::Views::one).plan(crowd.input, settings);
        std::map<std::string, double> bytes;
        for (const auto* rows : {&stats.prepared, &stats.passes}) {
            for (const PassStats& row : *rows) bytes[row.name] = static_cast<double>(row.bytes);
        }
        return bytes;
    }
    RenderStats stats;
};

// Nothing is drawn: rows are recorded, and take their memory.
TEST_F(Memory, SixteenCharactersAndSixtyFourLightsTakeWhatTheFormulaSays) {
    const Crowd crowd(16, 64);
    RenderSettings settings;
    settings.width = settings.height = 64;
    settings.irradianceSize = 1024;
    settings.lightMapSize = 64;
    const std::map<std::string, double> bytes = bytesOf(crowd, settings);
    ASSERT_EQ(stats.characters, 16);
    const double texels = 1024.0 * 1024, lights = 64, maps = lights * 16, gaussians = stats.gaussians;
    const std::map<std::string, double> formula{
        {"surface", 60 * texels},
        {"thickness", 16 * texels},
        {"environment_visibility", 20 * texels + 8 * 32 * 256.0 * 256 * 4},
        {"irradiance", (32 + lights) * texels},
        {"diffusion", 16 * (gaussians + 1) * texels},
        {"exitance", 16 * texels},
        {"light_maps", 8 * maps * 64 * 64},
    };
    for (const auto& [row, most] : formula) {
        ASSERT_TRUE(bytes.contains(row)) << row;
        std::printf("%-24s %8.2f MB of at most %8.2f\n", row.c_str(), bytes.at(row) / kMB, most / kMB);
        EXPECT_LE(bytes.at(row), most * 1.01 + 1e5) << row;
    }
    // It is no bound from afar: without levels of lower resolution it is what they take.
    EXPECT_GE(bytes.at("light_maps"), 0.95 * formula.at("light_maps"));
    EXPECT_GE(bytes.at("surface"), 0.85 * formula.at("surface"));
    EXPECT_GE(bytes.at("diffusion"), 0.3 * formula.at("diffusion"));
}

// Maps that would take more than 2 GiB become coarser, not the atlas.
TEST_F(Memory, LightMapsOfManyLightsBecomeCoarser) {
    RenderSettings settings;
    settings.width = settings.height = 64;
    settings.irradianceSize = 256;
    EXPECT_NEAR(bytesOf(Crowd(16, 16), settings).at("light_maps"), 8.0 * 256 * 1024 * 1024, 8e6) << "exactly 2 GiB";
    EXPECT_NEAR(bytesOf(Crowd(16, 17), settings).at("light_maps"), 8.0 * 272 * 512 * 512, 8e6);
}

}  // namespace
}  // namespace cutis::test
