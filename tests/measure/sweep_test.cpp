#include "renderer/measure/sweep.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <set>

#include "renderer/core/error.h"
#include "renderer/measure/variants.h"
#include "renderer/scene/characters.h"

namespace cutis {
namespace {

class SweepFile : public ::testing::Test {
  protected:
    std::filesystem::path file_ =
        std::filesystem::temp_directory_path() / ("cutis-sweep-" + std::to_string(getpid()) + ".json");
    ~SweepFile() override { std::filesystem::remove(file_); }
    std::vector<Setting> load(const std::string& text) {
        std::ofstream(file_) << text;
        return loadSweep(file_);
    }
    std::string refusal(const std::string& text) {
        try {
            load(text);
        } catch (const Error& error) {
            return error.what();
        }
        return "accepted";
    }
};

TEST(Sweeps, StartWithTheDefaultWhereQualityVariesAndHaveDistinctNames) {
    for (const std::string& name : sweepNames()) {
        const std::vector<Setting> settings = builtInSweep(name);
        EXPECT_GE(settings.size(), 5u) << name;
        std::set<std::string> names;
        for (const Setting& setting : settings)
            EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
    }
    EXPECT_EQ(builtInSweep("quality")[0], Setting{.name = "default"});
    EXPECT_EQ(builtInSweep("lights").back().lights, 64);
    EXPECT_EQ(builtInSweep("characters").back().characters, 16);
    EXPECT_EQ(builtInSweep("size").back().irradianceSize, 8192);
    EXPECT_THROW(builtInSweep("nonsense"), std::invalid_argument);
}

TEST_F(SweepFile, IsReadAndChecked) {
    const std::vector<Setting> settings = load(
        R"({"cutis_sweep":1,"settings":[{"name":"a"},{"name":"b","irradiance_size":512,"environment_samples":0}]})");
    ASSERT_EQ(settings.size(), 2u);
    EXPECT_EQ(settings[0], Setting{.name = "a"});
    EXPECT_EQ(settings[1].irradianceSize, 512);
    EXPECT_EQ(settings[1].environmentSamples, 0);
    const auto says = [&](const std::string& text, const char* part) {
        const std::string what = refusal(text);
        EXPECT_NE(what.find(part), std::string::npos) << what;
    };
    says("{", "not JSON");
    says(R"({"cutis_sweep":2,"settings":[]})", "cutis_sweep");
    says(R"({"cutis_sweep":1,"settings":[]})", "settings");
    says(R"({"cutis_sweep":1,"settings":[{"name":"a","taps":0}]})", "settings[0].taps");
    says(R"({"cutis_sweep":1,"settings":[{"name":"a","gaussians":0}]})", "settings[0].gaussians");
    says(R"({"cutis_sweep":1,"settings":[{"name":"a"},{"name":"a"}]})", "settings[1].name");
    says(R"({"cutis_sweep":1,"settings":[{"name":"a","merge":"max"}]})", "settings[0].merge");
    says(R"({"cutis_sweep":1,"settings":[{"name":"a","chain":"printed"}]})", "settings[0].chain");
}

TEST(Settings, ChangeQualityAndAreaLightsAlone) {
    Scene scene;
    Rig rig;
    rig.lights = {
        {.name = "softbox", .type = LightType::rect}, {.name = "bulb", .radius = 0.1}, {.name = "point"}};
    RenderSettings quality;
    applySetting({.name = "x",
                  .irradianceSize = 512,
                  .gaussians = 2,
                  .lightMapSize = 256,
                  .areaSamples = 7,
                  .environmentSamples = 3,
                  .taps = 5},
                 scene, rig, quality);
    EXPECT_EQ(quality.irradianceSize, 512);
    EXPECT_EQ(quality.gaussians, 2);
    EXPECT_EQ(quality.lightMapSize, 256);
    EXPECT_EQ(quality.taps, 5);
    EXPECT_EQ(rig.lights[0].samples, 7);
    EXPECT_EQ(rig.lights[1].samples, 7);
    EXPECT_EQ(rig.lights[2].samples, 0);
    EXPECT_EQ(rig.environment.shadowSamples, 3);
}

TEST(Variants, LightsAreRepeatedAndKeepTheirSum) {
    Scene scene;
    scene.bounds.extend(glm::dvec3(-1)), scene.bounds.extend(glm::dvec3(1));
    Rig rig;
    rig.lights = {{.name = "key", .intensity = 8, .position = {0, 0, 2}, .direction = {0, 0, -1}},
                  {.name = "off", .enabled = false, .intensity = 100},
                  {.name = "fill", .intensity = 2, .position = {2, 0, 0}, .direction = {-1, 0, 0}}};
    Rig one = rig, eight = rig;
    repeatLights(one, scene, 1);
    ASSERT_EQ(one.lights.size(), 1u);
    EXPECT_EQ(one.lights[0].intensity, 8);
    repeatLights(eight, scene, 8);
    ASSERT_EQ(eight.lights.size(), 8u);
    double sum = 0;
    std::set<std::string> names;
    for (const Light& light : eight.lights) {
        sum += light.intensity;
        EXPECT_TRUE(names.insert(light.name).second) << light.name;
        EXPECT_NEAR(glm::length(light.position), 2, 1e-12);
        EXPECT_NEAR(glm::dot(light.direction, -light.position / 2.0), 1, 1e-12) << "aims at the centre";
    }
    EXPECT_NEAR(sum, 10, 1e-12);
}

// One triangle of skin a character.
Scene twoCharacters() {
    Scene scene;
    Material skin;
    skin.skin = SkinMaterial{};
    scene.materials = {skin};
    Primitive triangle;
    triangle.positions = {{0, 0, 0}, {0.1f, 0, 0}, {0, 0.1f, 0.1f}};
    triangle.normals.assign(3, {0, 0, 1});
    triangle.indices = {0, 1, 2};
    triangle.material = 0;
    scene.meshes = {{"face", {triangle}}};
    for (double x : {0.0, 1.0}) {
        Node node;
        node.name = x == 0 ? "Ann" : "Bob";
        node.mesh = 0;
        node.local[3] = {x, 0, 0, 1};
        scene.nodes.push_back(node);
    }
    prepareScene(scene);
    return scene;
}

TEST(Variants, CharactersAreLeftOutAndRepeatedApart) {
    for (int count : {1, 2, 5, 16}) {
        Scene scene = twoCharacters();
        ASSERT_EQ(scene.characters.size(), 2u);
        repeatCharacters(scene, count);
        ASSERT_EQ(scene.characters.size(), static_cast<std::size_t>(count));
        for (std::size_t i = 0; i < scene.characters.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_NE(scene.characters[i].bounds.min, scene.characters[j].bounds.min);
    }
}

}  // namespace
}  // namespace cutis
