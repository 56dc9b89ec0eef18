// The rig format: what is read, what is refused and how, and that saving loses nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

#include "renderer/core/error.h"
#include "renderer/scene/presets.h"
#include "renderer/scene/rig.h"
#include "tests/support/process.h"

namespace cutis {
namespace {

const char* const kExample = R"({ "cutis_rig": 1, "name": "Rembrandt", "exposure": 0.5,
  "lights": [
    { "name": "key", "type": "spot", "enabled": true, "color": [1, 0.95, 0.9], "temperature": 5600,
      "intensity": 8, "inner_cone_angle": 0.3, "outer_cone_angle": 0.6, "radius": 0.05, "shadow": false,
      "place": { "subject": "Anna", "azimuth": 45, "elevation": 35, "distance": 1.2 } },
    { "name": "softbox", "type": "rect", "intensity": 20, "size": [0.6, 0.9], "samples": 8,
      "position": [-1, 1.8, 0.5], "direction": [0.8, -0.1, -0.5] } ],
  "environment": { "file": "studio.exr", "enabled": false, "intensity": 2, "rotation": 90, "shadow_samples": 5 } })";

std::string messageFor(const std::string& json) {
    try {
        parseRig(json, "bad.rig.json");
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

std::string withLight(const std::string& keys) {
    return R"({"cutis_rig": 1, "lights": [{"type": "point", "position": [0, 0, 0]}, {)" + keys + "}]}";
}

TEST(RigJson, ReadsEveryKey) {
    const Rig rig = parseRig(kExample, "example");
    EXPECT_EQ(rig.name, "Rembrandt");
    EXPECT_EQ(rig.exposure, 0.5);
    ASSERT_EQ(rig.lights.size(), 2u);
    const Light& key = rig.lights[0];
    EXPECT_EQ(key.name, "key");
    EXPECT_EQ(key.type, LightType::spot);
    EXPECT_EQ(key.color, glm::dvec3(1, 0.95, 0.9));
    EXPECT_EQ(key.temperature, 5600);
    EXPECT_EQ(key.intensity, 8);
    EXPECT_EQ(key.innerConeAngle, 0.3);
    EXPECT_EQ(key.outerConeAngle, 0.6);
    EXPECT_EQ(key.radius, 0.05);
    EXPECT_FALSE(key.shadow);
    EXPECT_EQ(key.place, (Placement{"Anna", 45, 35, 1.2}));
    const Light& softbox = rig.lights[1];
    EXPECT_EQ(softbox.type, LightType::rect);
    EXPECT_TRUE(softbox.enabled);
    EXPECT_EQ(softbox.size, glm::dvec2(0.6, 0.9));
    EXPECT_EQ(softbox.samples, 8);
    EXPECT_EQ(softbox.position, glm::dvec3(-1, 1.8, 0.5));
    EXPECT_NEAR(glm::length(softbox.direction), 1, 1e-15);
    EXPECT_NEAR(softbox.direction.x, 0.8 / std::sqrt(0.9), 1e-15);
    EXPECT_FALSE(softbox.place);
    EXPECT_EQ(rig.environment, (EnvironmentSettings{"studio.exr", false, 2, 90, 5}));
}

TEST(RigJson, SmallestRig) {
    EXPECT_EQ(parseRig(R"({"cutis_rig": 1})", "small"), Rig{});
}

struct BadRig {
    std::string json, expected;  // the expected part of the message
};

TEST(RigJson, RefusesWithFileAndPath) {
    const std::string spot = R"("type": "spot", "place": {}, )",
                      point = R"("type": "point", "position": [1, 2, 3], )";
    const std::string rect = R"("type": "rect", "place": {}, )";
    const BadRig table[] = {
        {"", "parse error"},
        {"[]", "must be an object"},
        {"{", "parse error"},
        {"{\"cutis_rig\": 1} x", "parse error"},
        {"{}", "cutis_rig is missing"},
        {R"({"cutis_rig": 2})", "cutis_rig is 2"},
        {R"({"cutis_rig": "1"})", "cutis_rig is \"1\""},
        {R"({"cutis_rig": 1, "exposur": 0})", "unknown key 'exposur' (did you mean 'exposure'?)"},
        {R"({"cutis_rig": 1, "exposure": "bright"})", "exposure is \"bright\", it must be a number"},
        {R"({"cutis_rig": 1, "exposure": 1e999})", "number overflow"},
        {R"({"cutis_rig": 1, "exposure": NaN})", "parse error"},
        {R"({"cutis_rig": 1, "exposure": 65})", "exposure is 65, it must be from -64.0 to 64.0"},
        {R"({"cutis_rig": 1, "name": 3})", "name is 3, it must be a text"},
        {R"({"cutis_rig": 1, "name": "a", "name": "b"})", "key 'name' is given twice"},
        {R"({"cutis_rig": 1, "lights": {}})", "lights is an object, it must be a list"},
        {R"({"cutis_rig": 1, "lights": [3]})", "lights[0] must be an object"},
        {R"({"cutis_rig": 1, "x": [[[[[[[[[[[1]]]]]]]]]]]})", "nested too deep"},
        {R"({"cutis_rig": 1, "environment": 1})", "environment must be an object"},
        {R"({"cutis_rig": 1, "environment": {"fil": "a"}})",
         "environment unknown key 'fil' (did you mean 'file'?)"},
        {R"({"cutis_rig": 1, "environment": {"intensity": -1}})", "environment.intensity is -1"},
        {R"({"cutis_rig": 1, "environment": {"shadow_samples": 1.5}})", "environment.shadow_samples is 1.5"},
        {R"({"cutis_rig": 1, "environment": {"shadow_samples": 4097}})",
         "environment.shadow_samples is 4097"},
        {R"({"cutis_rig": 1, "environment": {"rotation": true}})", "environment.rotation is true"},
        {withLight(R"("position": [0, 0, 0])"), "lights[1].type is missing"},
        {withLight(R"("type": "area")"), "lights[1].type is \"area\""},
        {withLight(R"("type": "Spot")"), "lights[1].type is \"Spot\""},
        {withLight(R"("type": 2)"), "lights[1].type is 2"},
        {withLight(R"("type": "point")"), "lights[1] needs a place or a position"},
        {withLight(R"("type": "directional")"), "lights[1] needs a place or a direction"},
        {withLight(R"("type": "spot", "position": [0, 0, 0])"), "lights[1] needs a place or a direction"},
        {withLight(spot + R"("direction": [0, 0, 1])"), "lights[1].direction and place exclude each other"},
        {withLight(spot + R"("intenstiy": 3)"),
         "lights[1] unknown key 'intenstiy' (did you mean 'intensity'?)"},
        {withLight(spot + R"("intensity": -0.5)"), "lights[1].intensity is -0.5, it must be from 0.0"},
        {withLight(spot + R"("intensity": 1e13)"), "lights[1].intensity is 1"},
        {withLight(spot + R"("intensity": null)"), "lights[1].intensity is null"},
        {withLight(spot + R"("enabled": 1)"), "lights[1].enabled is 1, it must be true or false"},
        {withLight(spot + R"("color": [1, 1])"),
         "lights[1].color is a list of 2, it must be a list of 3 numbers"},
        {withLight(spot + R"("color": [1, 1, -1])"), "lights[1].color[2] is -1"},
        {withLight(spot + R"("color": [1, "1", 1])"), "lights[1].color[1] is \"1\", it must be a number"},
        {withLight(spot + R"("color": "#ffffff")"), "lights[1].color is \"#ffffff\""},
        {withLight(spot + R"("temperature": 900)"), "lights[1].temperature is 900"},
        {withLight(spot + R"("temperature": 50000)"), "lights[1].temperature is 50000"},
        {withLight(spot + R"("inner_cone_angle": 0.8)"),
         "lights[1].inner_cone_angle is 0.8, it must not exceed"},
        {withLight(spot + R"("outer_cone_angle": 1.6)"), "lights[1].outer_cone_angle is 1.6"},
        {withLight(spot + R"("outer_cone_angle": 0)"), "lights[1].outer_cone_angle must be above 0"},
        {withLight(spot + R"("radius": -1)"), "lights[1].radius is -1"},
        {withLight(spot + R"("samples": 4097)"), "lights[1].samples is 4097"},
        {withLight(spot + R"("samples": 2.5)"), "lights[1].samples is 2.5, it must be a whole number"},
        {withLight(spot + R"("samples": 99999999999999999999)"), "lights[1].samples"},
        {withLight(rect), "parse error"},  // a comma before the brace
        {withLight(R"("type": "rect", "place": {})"),
         "lights[1].size must hold a width and a height above 0"},
        {withLight(rect + R"("size": [1, 0])"), "lights[1].size must hold a width and a height above 0"},
        {withLight(rect + R"("size": [1, -2])"), "lights[1].size[1] is -2"},
        {withLight(rect + R"("size": 1)"), "lights[1].size is 1, it must be a list of 2 numbers"},
        {withLight(point + R"("range": -1)"), "lights[1].range is -1"},
        {withLight(point + R"("direction": [0, 0, 0])"), "lights[1].direction has no length"},
        {withLight(R"("type": "point", "position": [0, 1e7, 0])"), "lights[1].position[1] is 1"},
        {withLight(R"("type": "spot", "place": {"elevation": 91})"), "lights[1].place.elevation is 91"},
        {withLight(R"("type": "spot", "place": {"distance": 0})"),
         "lights[1].place.distance is 0, it must be above 0.0"},
        {withLight(R"("type": "spot", "place": {"azimut": 0})"),
         "lights[1].place unknown key 'azimut' (did you mean"},
        {withLight(R"("type": "spot", "place": {"subject": null})"), "lights[1].place.subject is null"},
        {withLight(R"("type": "spot", "place": null)"), "lights[1].place must be an object"},
    };
    for (const BadRig& bad : table) {
        const std::string message = messageFor(bad.json);
        EXPECT_NE(message.find(bad.expected), std::string::npos) << bad.json << "\n  gave: " << message;
        EXPECT_EQ(message.find("cannot use rig: "), 0u) << message;
        EXPECT_NE(message.find(", bad.rig.json"), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

TEST(RigJson, RefusesTooManyLightsAndBytes) {
    const std::string light = R"({"type": "point", "position": [0, 0, 0]})";
    std::string list = light;
    for (std::size_t i = 1; i < kMaxLights; ++i) list += ", " + light;
    EXPECT_EQ(parseRig(R"({"cutis_rig": 1, "lights": [)" + list + "]}", "many").lights.size(), kMaxLights);
    EXPECT_NE(
        messageFor(R"({"cutis_rig": 1, "lights": [)" + list + ", " + light + "]}").find("has 4097 lights"),
        std::string::npos);
    EXPECT_NE(messageFor(std::string(kMaxRigBytes + 1, ' ')).find("bytes"), std::string::npos);
    EXPECT_NE(messageFor(std::string(1000000, '[')).find("nested too deep"), std::string::npos);
    std::string keys;
    for (int i = 0; i < 200; ++i) keys += ", \"key" + std::to_string(i) + "\": 0";
    EXPECT_NE(messageFor(R"({"cutis_rig": 1)" + keys + "}").find("more than 100 keys"), std::string::npos);
    EXPECT_NE(messageFor("{\"cutis_rig\": 1, \"name\": \"\xff\xfe\"}").find("parse error"),
              std::string::npos);
}

std::vector<std::string> warnings;

TEST(RigJson, WarnsOnceAboutKeysWithoutEffect) {
    warnings.clear();
    const WarningSink before = setWarningSink([](const std::string& text) { warnings.push_back(text); });
    const Rig rig = parseRig(
        withLight(R"("type": "point", "position": [0, 0, 0], "size": [1, 1], "outer_cone_angle": 1)"),
        "odd.rig.json");
    setWarningSink(before);
    EXPECT_EQ(rig.lights[1].size, glm::dvec2(1, 1));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(
        warnings[0],
        "rig odd.rig.json: lights[1].outer_cone_angle and 1 more have no effect on a light of this type");
}

TEST(RigJson, SavingAndLoadingGivesTheSameRig) {
    const Rig example = parseRig(kExample, "example");
    EXPECT_EQ(parseRig(rigToJson(example), "again"), example);
    for (const Preset& preset : presets()) {
        const Rig rig = presetRig(preset.name);
        EXPECT_EQ(parseRig(rigToJson(rig), preset.name), rig) << preset.name;
    }
}

// 300 rigs of random doubles, drawn over many orders of magnitude so that every bit of the mantissa is used.
TEST(RigJson, RandomRigsSurviveBitForBit) {
    std::mt19937 random(7);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random);
    };
    const auto magnitude = [&] { return std::pow(10, between(-12, 5)); };
    for (int round = 0; round < 300; ++round) {
        Rig rig;
        rig.name = "Umlaut \xc3\xa4 \"quoted\" \\ " + std::to_string(round);
        rig.exposure = between(-64, 64);
        rig.environment = {"a/b.exr", round % 2 == 0, magnitude(), between(-36000, 36000), round};
        for (int i = 0; i < 4; ++i) {
            Light light;
            light.name = std::to_string(i);
            light.type = static_cast<LightType>(i);
            light.enabled = random() % 2;
            light.shadow = random() % 2;
            light.color = {magnitude(), between(0, 1), 0};
            if (random() % 2) light.temperature = between(1000, 40000);
            light.intensity = magnitude();
            light.samples = static_cast<int>(random() % 4097);
            if (light.type == LightType::spot) {
                light.innerConeAngle = between(0, 0.7);
                light.outerConeAngle = between(0.7, 1.57);
            }
            if (light.type == LightType::rect)
                light.size = {magnitude(), magnitude()};
            else
                light.radius = magnitude();
            light.range = magnitude();
            if (random() % 2) {
                light.place = Placement{"*", between(-360, 360), between(-90, 90), magnitude()};
            } else {
                light.position = {between(-9, 9), -magnitude(), -0.0};
                light.direction = glm::normalize(glm::dvec3(between(-1, 1), between(-1, 1), between(-1, 1)));
            }
            rig.lights.push_back(light);
        }
        const WarningSink before = setWarningSink([](const std::string&) {});
        const Rig again = parseRig(rigToJson(rig), "again");
        setWarningSink(before);
        ASSERT_EQ(again, rig) << rigToJson(rig);
        EXPECT_TRUE(rig.lights[0].place || std::signbit(again.lights[0].position.z));
    }
}

TEST(RigJson, RefusesToSaveWhatItCouldNotLoad) {
    Rig rig;
    rig.lights.resize(1);
    rig.lights[0].intensity = std::nan("");
    EXPECT_THROW(rigToJson(rig), Error);
    rig.lights[0].intensity = -1;
    EXPECT_THROW(rigToJson(rig), Error);
    rig.lights[0].intensity = 1;
    rig.lights[0].name = "\xff";
    EXPECT_THROW(rigToJson(rig), Error);
}

TEST(RigJson, FilesAreWrittenWholeOrNotAtAll) {
    const test::TemporaryFolder folder;
    const std::filesystem::path path = folder / "a.rig.json";
    const Rig rig = parseRig(kExample, "example");
    saveRig(rig, path);
    EXPECT_EQ(loadRig(path), rig);
    Rig broken = rig;
    broken.lights[0].radius = -1;
    EXPECT_THROW(saveRig(broken, path), Error);
    EXPECT_EQ(loadRig(path), rig);
    EXPECT_THROW(saveRig(rig, folder / "missing/a.rig.json"), Error);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
    EXPECT_THROW(loadRig(folder / "absent.rig.json"), Error);
    EXPECT_THROW(loadRig(folder.path()), Error);
}

}  // namespace
}  // namespace cutis
