// Rigs in scenes: placement on heads, presets, glTF lights.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/core/error.h"
#include "renderer/scene/characters.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/gltf_writer.h"
#include "renderer/scene/light_samples.h"
#include "renderer/scene/presets.h"
#include "renderer/scene/rig.h"
#include "tests/support/process.h"

namespace cutis {
namespace {

constexpr double kPi = std::numbers::pi;

// A box of skin, 0.2 m to each side, as the only mesh of a root node.
void addHead(Scene& scene, const std::string& name, const glm::dvec3& centre) {
    if (scene.materials.empty()) {
        scene.materials.emplace_back().skin = SkinMaterial{};
        Primitive box;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 p(corner & 1 ? 0.1f : -0.1f, corner & 2 ? 0.1f : -0.1f,
                              corner & 4 ? 0.1f : -0.1f);
            box.positions.push_back(p);
            box.normals.push_back(glm::normalize(p));
        }
        box.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                       2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
        box.material = 0;
        scene.meshes.push_back({"head", {box}});
    }
    Node node;
    node.name = name;
    node.mesh = 0;
    node.local[3] = glm::dvec4(centre, 1);
    scene.nodes.push_back(node);
    prepareScene(scene);
}

Rig placedRig(const Placement& place) {
    Rig rig;
    rig.lights.resize(1);
    rig.lights[0].name = "key";
    rig.lights[0].place = place;
    return rig;
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    EXPECT_NEAR(glm::distance(a, b), 0, tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(Placement, IsRelativeToTheSubjectsHead) {
    Scene scene;
    addHead(scene, "Anna", {1, 2, 3});
    addHead(scene, "Ben", {-1, 2, 3});
    const struct {
        Placement place;
        glm::dvec3 position;
    } table[] = {{{"Anna", 0, 0, 2}, {1, 2, 5}},  {{"Anna", 90, 0, 2}, {3, 2, 3}},
                 {{"Ben", 0, 90, 1}, {-1, 3, 3}}, {{"Ben", 180, 0, 1}, {-1, 2, 2}},
                 {{"*", -90, 0, 3}, {-3, 2, 3}},  {{"*", 45, 45, 2}, {1, 2 + std::sqrt(2.0), 4}}};
    for (const auto& row : table) {
        Rig rig = placedRig(row.place);
        resolvePlacements(rig, scene);
        const Light& light = rig.lights[0];
        expectNear(light.position, row.position, 1e-6);  // positions are single precision
        const glm::dvec3 head = row.place.subject == "Anna"  ? glm::dvec3(1, 2, 3)
                                : row.place.subject == "Ben" ? glm::dvec3(-1, 2, 3)
                                                             : glm::dvec3(0, 2, 3);
        expectNear(light.position + light.direction * row.place.distance, head, 1e-6);
    }
}

TEST(Placement, UnknownSubjectListsTheCharacters) {
    Scene scene;
    addHead(scene, "Anna", {0, 0, 0});
    addHead(scene, "Ben", {1, 0, 0});
    Rig rig = placedRig({"Carla", 0, 0, 1});
    try {
        resolvePlacements(rig, scene);
        FAIL() << "accepted";
    } catch (const Error& error) {
        const std::string message = error.what();
        for (const char* part : {"Carla", "Anna", "Ben"})
            EXPECT_NE(message.find(part), std::string::npos) << message;
    }
    EXPECT_THROW(resolvePlacements(rig, Scene{}), Error);
    Rig all = placedRig({});
    EXPECT_THROW(resolvePlacements(all, Scene{}), Error);
}

TEST(Presets, NamesAreForgiving) {
    EXPECT_EQ(presets().size(), 8u);
    EXPECT_EQ(presetRig("Three Point"), presetRig("three-point"));
    EXPECT_EQ(presetRig("REMBRANDT"), presetRig("rembrandt"));
    EXPECT_TRUE(isPreset("three_point"));
    EXPECT_FALSE(isPreset("four-point"));
    try {
        presetRig("rembrant");
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("did you mean 'rembrandt'?"), std::string::npos)
            << error.what();
    }
}

// Exposure 0 is right: white skin facing the brightest light has a radiance of 0.6 to 0.9 (rims, which graze,
// up to 1.4), whoever the subject is and wherever it stands.
TEST(Presets, AreWellExposed) {
    Scene scene;
    addHead(scene, "Anna", {3, 1.6, -2});
    for (const Preset& preset : presets()) {
        Rig rig = presetRig(preset.name);
        resolvePlacements(rig, scene);
        for (const Light& light : rig.lights) {
            glm::dvec3 e(0);
            Rig alone;
            alone.lights = {light};
            for (const LightSample& sample : sampleLights(alone))
                e += irradianceFrom(sample, {3, 1.6, -2}, -light.direction);
            const double radiance = glm::dot(e, glm::dvec3(0.2126, 0.7152, 0.0722)) / kPi;
            if (light.name == "key") {
                EXPECT_GT(radiance, 0.6) << preset.name;
                EXPECT_LT(radiance, 0.9) << preset.name;
            } else {
                EXPECT_GT(radiance, 0.04) << preset.name << ' ' << light.name;
                EXPECT_LT(radiance, 1.4) << preset.name << ' ' << light.name;
            }
        }
    }
}

TEST(GltfLights, SurviveExportAndImport) {
    Rig rig;
    rig.name = "export";
    Light point;
    point.name = "bulb";
    point.position = {1, 2, 3};
    point.color = {0.5, 1, 0.25};
    point.intensity = 12;
    point.range = 7;
    Light spot = point;
    spot.name = "spot";
    spot.type = LightType::spot;
    spot.innerConeAngle = 0.2;
    spot.outerConeAngle = 0.5;
    spot.direction = glm::normalize(glm::dvec3(1, -2, 0.5));
    Light sun;
    sun.name = "sun";
    sun.type = LightType::directional;
    sun.direction = {0, -1, 0};
    sun.temperature = 4000;
    sun.intensity = 3;
    rig.lights = {point, spot, sun};

    const test::TemporaryFolder folder;
    writeGlb(sceneFromRig(rig), folder / "lights.glb");
    const Rig again = rigFromScene(loadGltf(folder / "lights.glb"));
    ASSERT_EQ(again.lights.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const Light &a = rig.lights[i], &b = again.lights[i];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.type, b.type);
        // 1e-6: glTF's matrices and light properties are decimal text of at least single precision.
        expectNear(lightIntensity(a), lightIntensity(b), 1e-6 * a.intensity);
        expectNear(a.direction, b.direction, a.type == LightType::point ? 3 : 1e-6);
        if (a.type != LightType::directional) expectNear(a.position, b.position, 1e-6);
        if (a.type == LightType::spot) {
            EXPECT_NEAR(a.innerConeAngle, b.innerConeAngle, 1e-6);
            EXPECT_NEAR(a.outerConeAngle, b.outerConeAngle, 1e-6);
        }
        EXPECT_NEAR(a.range, b.range, 1e-6);
    }
}

std::vector<std::string> warnings;

TEST(GltfLights, RectBecomesASpotOfEqualCandela) {
    Rig rig;
    rig.lights.resize(2);
    rig.lights[0].type = LightType::rect;
    rig.lights[0].size = {0.5, 0.8};
    rig.lights[0].intensity = 10;
    rig.lights[0].direction = {0, 0, -1};
    rig.lights[1].enabled = false;
    rig.environment.file = "studio.exr";
    warnings.clear();
    const WarningSink before = setWarningSink([](const std::string& text) { warnings.push_back(text); });
    const Scene scene = sceneFromRig(rig);
    setWarningSink(before);
    EXPECT_EQ(warnings.size(), 3u);  // rect, environment, disabled
    ASSERT_EQ(scene.lights.size(), 1u);
    Rig spots;
    spots.lights = scene.lights;
    // Far off, where the rect is a point, both give the same irradiance on the axis.
    const glm::dvec3 p(0, 0, -100), n(0, 0, 1);
    double rect = 0, spot = 0;
    for (const LightSample& sample : sampleLights(rig)) rect += irradianceFrom(sample, p, n).x;
    for (const LightSample& sample : sampleLights(spots)) spot += irradianceFrom(sample, p, n).x;
    EXPECT_NEAR(spot / rect, 1, 1e-4);
}

}  // namespace
}  // namespace cutis
