// Hierarchies, cameras and punctual lights as loadGltf reads them.
#include <gtest/gtest.h>

#include "gltf_file.h"
#include "renderer/scene/gltf.h"
#include "tests/support/process.h"
#include "warnings.h"

namespace cutis {
namespace {

using nlohmann::json;

Scene load(const test::GltfFile& file) {
    const test::TemporaryFolder folder;
    return loadGltf(file.saveGlb(folder.path()));
}

// Parent after child in the file, TRS above a matrix: 90° about +Y, scaled by 2, moved by (1, 2, 3).
TEST(GltfNodes, TransformsCompose) {
    test::GltfFile file = test::triangleFile();
    file.json["nodes"] = json::parse(R"([
        {"name": "leaf", "mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,-1,1]},
        {"name": "root", "children": [0], "translation": [1, 2, 3], "scale": [2, 2, 2],
         "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476]}])");
    file.json["scenes"] = json::parse(R"([{"nodes": [1]}])");
    const Scene scene = load(file);
    EXPECT_EQ(scene.nodes[0].parent, 1);
    EXPECT_EQ(scene.nodes[1].children, std::vector<int>{0});
    // (1, 0, -1) · 2 = (2, 0, -2), turned: x' = z, z' = -x: (-2, 0, -2), moved: (-1, 2, 1).
    const glm::dvec3 p(scene.nodes[0].world * glm::dvec4(1, 0, 0, 1));
    EXPECT_LT(glm::distance(p, glm::dvec3(-1, 2, 1)), 1e-12);
}

TEST(GltfNodes, OnlyTheDefaultSceneIsLoaded) {
    test::GltfFile file = test::triangleFile();
    file.json["nodes"] =
        json::parse(R"([{"name": "a", "mesh": 0}, {"name": "b", "mesh": 0}, {"name": "c"}])");
    file.json["scenes"] = json::parse(R"([{"nodes": [0]}, {"name": "second", "nodes": [1, 2]}])");
    file.json["scene"] = 1;
    const Scene scene = load(file);
    ASSERT_EQ(scene.nodes.size(), 2u);
    EXPECT_EQ(scene.nodes[0].name, "b");
    EXPECT_EQ(scene.name, "second");
    EXPECT_EQ(scene.meshes.size(), 1u);
    file.json.erase("scene");
    file.json.erase("scenes");
    EXPECT_EQ(load(file).nodes.size(), 3u);
}

TEST(GltfNodes, CamerasKeepTheirLensAndLoseTheirNodesScale) {
    test::GltfFile file;
    file.json["cameras"] = json::parse(R"([
        {"type": "perspective", "name": "lens", "perspective": {"yfov": 0.5, "znear": 0.1, "zfar": 50, "aspectRatio": 2}},
        {"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 2, "znear": 0, "zfar": 10}}])");
    file.json["nodes"] = json::parse(R"([
        {"camera": 0, "name": "Close", "translation": [0, 0, 4], "scale": [3, 3, 3]}, {"camera": 0}, {"camera": 1}])");
    const Scene scene = load(file);
    ASSERT_EQ(scene.cameras.size(), 3u);
    EXPECT_EQ(scene.cameras[0].name, "Close");
    EXPECT_EQ(scene.cameras[1].name, "lens");
    EXPECT_EQ(scene.cameras[2].name, "camera 2");
    EXPECT_EQ(scene.cameras[0].yfov, 0.5);
    EXPECT_EQ(scene.cameras[0].zfar, 50);
    EXPECT_EQ(scene.cameras[0].aspect, 2);
    EXPECT_EQ(scene.cameras[0].world[3], glm::dvec4(0, 0, 4, 1));
    EXPECT_LT(glm::distance(glm::dvec3(scene.cameras[0].world[2]), glm::dvec3(0, 0, 1)), 1e-12);
    EXPECT_TRUE(scene.cameras[2].orthographic);
    EXPECT_EQ(scene.cameras[2].ymag, 2);
}

TEST(GltfNodes, PunctualLightsShineAlongTheirNodesMinusZ) {
    test::GltfFile file;
    file.json["extensionsUsed"] = {"KHR_lights_punctual"};
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(R"([
        {"type": "spot", "name": "key", "intensity": 40, "color": [1, 0.5, 0.25], "range": 9,
         "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.4}},
        {"type": "directional"}, {"type": "point", "intensity": 3}])");
    // Turned by -90° about X: -Z becomes -Y, straight down.
    file.json["nodes"] = json::parse(R"([
        {"translation": [0, 5, 0], "rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476],
         "extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"name": "sun", "extensions": {"KHR_lights_punctual": {"light": 1}}},
        {"extensions": {"KHR_lights_punctual": {"light": 2}}}])");
    const Scene scene = load(file);
    ASSERT_EQ(scene.lights.size(), 3u);
    const Light& key = scene.lights[0];
    EXPECT_EQ(key.type, LightType::spot);
    EXPECT_EQ(key.name, "key");
    EXPECT_EQ(key.intensity, 40);
    EXPECT_EQ(key.color, glm::dvec3(1, 0.5, 0.25));
    EXPECT_EQ(key.range, 9);
    EXPECT_EQ(key.innerConeAngle, 0.1);
    EXPECT_EQ(key.outerConeAngle, 0.4);
    EXPECT_EQ(key.position, glm::dvec3(0, 5, 0));
    EXPECT_LT(glm::distance(key.direction, glm::dvec3(0, -1, 0)), 1e-12);
    EXPECT_EQ(scene.lights[1].type, LightType::directional);
    EXPECT_EQ(scene.lights[1].name, "sun");
    EXPECT_EQ(scene.lights[1].intensity, 1);
    EXPECT_EQ(scene.lights[1].direction, glm::dvec3(0, 0, -1));
    EXPECT_EQ(scene.lights[2].type, LightType::point);
    EXPECT_EQ(scene.lights[2].name, "light 2");
}

}  // namespace
}  // namespace cutis
