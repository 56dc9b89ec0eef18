// Buffers, accessors and primitives as loadGltf reads them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gltf_file.h"
#include "renderer/scene/gltf.h"
#include "tests/support/process.h"
#include "warnings.h"

namespace cutis {
namespace {

using test::GltfFile;
using test::TemporaryFolder;
using test::triangleFile;

nlohmann::json& primitiveOf(GltfFile& file) {
    return file.json["meshes"][0]["primitives"][0];
}

Primitive loadPrimitive(const GltfFile& file) {
    const TemporaryFolder folder;
    const Scene scene = loadGltf(file.saveGlb(folder.path()));
    return scene.meshes.at(0).primitives.at(0);
}

void expectTriangle(const Scene& scene) {
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Primitive& p = scene.meshes[0].primitives.at(0);
    EXPECT_EQ(p.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(p.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(p.normals, std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
    EXPECT_EQ(p.material, 0);
    EXPECT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.bounds.max, glm::dvec3(1, 1, 0));
}

TEST(GltfContainer, BinaryEmbeddedAndSeparateAreTheSame) {
    const TemporaryFolder folder;
    expectTriangle(loadGltf(triangleFile().saveGlb(folder.path())));
    expectTriangle(loadGltf(triangleFile().saveEmbedded(folder.path())));
    expectTriangle(loadGltf(triangleFile().saveSeparate(folder.path())));
}

TEST(GltfContainer, UrisArePercentEncodedAndMayNameFoldersBelow) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "a b");
    const GltfFile file = triangleFile();
    test::writeBytes(folder / "a b" / "c.bin", file.binary.data(), file.binary.size());
    expectTriangle(loadGltf(file.saveSeparate(folder.path(), "a%20b/c.bin")));
}

// glTF 2.0, §3.6.1: a buffer's file may be longer than the buffer.
TEST(GltfContainer, BufferMayBeShorterThanItsFile) {
    const TemporaryFolder folder;
    const auto path = triangleFile().saveSeparate(folder.path());
    const std::vector<char> longer(1000, 0);
    std::vector<std::byte> bytes = triangleFile().binary;
    bytes.resize(1000);
    test::writeBytes(folder / "scene.bin", bytes.data(), bytes.size());
    expectTriangle(loadGltf(path));
}

TEST(GltfContainer, ExtensionsRequiredRefusedUsedWarned) {
    const TemporaryFolder folder;
    GltfFile file = triangleFile();
    file.json["extensionsUsed"] = {"EXT_nobody_knows", "KHR_materials_unlit"};
    {
        const test::CapturedWarnings warnings;
        expectTriangle(loadGltf(file.saveGlb(folder.path())));
        EXPECT_EQ(warnings.count("EXT_nobody_knows"), 1);
        EXPECT_EQ(warnings.count("KHR_materials_unlit"), 0);
    }
    file.json["extensionsRequired"] = {"KHR_materials_unlit", "EXT_nobody_knows"};
    try {
        loadGltf(file.saveGlb(folder.path()));
        FAIL() << "a required extension that nobody knows was accepted";
    } catch (const Error& error) {
        EXPECT_NE(error.why().find("EXT_nobody_knows"), std::string::npos);
        EXPECT_NE(error.where().find("extensionsRequired[1]"), std::string::npos);
    }
}

// The winding of glTF 2.0, §3.7.2.1, for five vertices on a zigzag.
TEST(GltfPrimitive, StripsAndFans) {
    GltfFile file;
    file.addAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3", test::kFloat, 5);
    file.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"mode", 5}}}}}};
    file.json["nodes"] = {{{"mesh", 0}}};
    Primitive strip = loadPrimitive(file);
    EXPECT_EQ(strip.indices, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2, 2, 3, 4}));
    for (const glm::vec3& normal : strip.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
    primitiveOf(file)["mode"] = 6;
    EXPECT_EQ(loadPrimitive(file).indices, (std::vector<std::uint32_t>{1, 2, 0, 2, 3, 0, 3, 4, 0}));
}

TEST(GltfPrimitive, PointsAndLinesAreLeftOutWithAWarning) {
    for (int mode = 0; mode < 4; ++mode) {
        GltfFile file = triangleFile();
        primitiveOf(file)["mode"] = mode;
        const TemporaryFolder folder;
        const test::CapturedWarnings warnings;
        const Scene scene = loadGltf(file.saveGlb(folder.path()));
        EXPECT_TRUE(scene.meshes.at(0).primitives.empty());
        EXPECT_EQ(warnings.count("meshes[0].primitives[0]"), 1);
    }
}

TEST(GltfPrimitive, VerticesThatNoTriangleUsesAreDropped) {
    GltfFile file;
    file.addAccessor<float>({9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", test::kFloat, 4);
    file.addAccessor<std::uint8_t>({1, 2, 3, 1, 1, 2}, "SCALAR", test::kUnsignedByte,
                                   6);  // the second is degenerate
    file.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
    file.json["nodes"] = {{{"mesh", 0}}};
    const Primitive p = loadPrimitive(file);
    EXPECT_EQ(p.positions.size(), 3u);
    EXPECT_EQ(p.indices, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(GltfPrimitive, TrianglesThatAreNotFiniteAreDropped) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    GltfFile file = triangleFile();
    const int positions =
        file.addAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, nan, 0, 0, 0, inf, 0}, "VEC3", test::kFloat, 5);
    const int indices =
        file.addAccessor<std::uint32_t>({0, 1, 2, 0, 1, 3, 4, 1, 0}, "SCALAR", test::kUnsignedInt, 9);
    primitiveOf(file)["attributes"]["POSITION"] = positions;
    primitiveOf(file)["indices"] = indices;
    const test::CapturedWarnings warnings;
    const Primitive p = loadPrimitive(file);
    EXPECT_EQ(p.indices.size(), 3u);
    EXPECT_EQ(p.positions.size(), 3u);
    EXPECT_EQ(warnings.count("2 triangles with NaN or infinite positions"), 1);
}

TEST(GltfAccessor, IntegerComponentsAreNormalizedAsTheSpecificationSays) {
    GltfFile file = triangleFile();
    auto& attributes = primitiveOf(file)["attributes"];
    const nlohmann::json normalized = {{"normalized", true}};
    attributes["TEXCOORD_0"] =
        file.addAccessor<std::uint8_t>({0, 0, 255, 51, 102, 255}, "VEC2", test::kUnsignedByte, 3, normalized);
    attributes["TEXCOORD_1"] = file.addAccessor<std::uint16_t>({0, 0, 65535, 13107, 26214, 65535}, "VEC2",
                                                               test::kUnsignedShort, 3, normalized);
    attributes["NORMAL"] =
        file.addAccessor<std::int8_t>({0, 0, 127, 0, 0, -128, 127, 0, 0}, "VEC3", test::kByte, 3, normalized);
    attributes["COLOR_0"] = file.addAccessor<std::uint8_t>({255, 0, 51, 0, 255, 0, 0, 0, 255}, "VEC3",
                                                           test::kUnsignedByte, 3, normalized);
    const Primitive p = loadPrimitive(file);
    const std::vector<glm::vec2> uv{{0, 0}, {1, 0.2f}, {0.4f, 1}};
    EXPECT_EQ(p.uv0, uv);
    EXPECT_EQ(p.uv1, uv);
    EXPECT_EQ(p.normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}}));
    EXPECT_EQ(p.colors, (std::vector<glm::vec4>{{1, 0, 0.2f, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}}));
}

// KHR_mesh_quantization: positions as integers, normalized or not; the node's scale makes up for it.
TEST(GltfAccessor, QuantizedPositions) {
    GltfFile file = triangleFile();
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    primitiveOf(file)["attributes"]["POSITION"] =
        file.addAccessor<std::int16_t>({0, 0, 0, 100, 0, 0, 0, -100, 0}, "VEC3", test::kShort, 3);
    EXPECT_EQ(loadPrimitive(file).positions[2], glm::vec3(0, -100, 0));
    primitiveOf(file)["attributes"]["POSITION"] = file.addAccessor<std::int16_t>(
        {0, 0, 0, 32767, 0, 0, 0, -32767, 0}, "VEC3", test::kShort, 3, {{"normalized", true}});
    EXPECT_EQ(loadPrimitive(file).positions[2], glm::vec3(0, -1, 0));
}

TEST(GltfAccessor, InterleavedViews) {
    GltfFile file = triangleFile();
    const int view = file.addView<float>({0, 0, 0, 0.5f, 0.25f, /**/ 2, 0, 0, 1, 0, /**/ 0, 2, 0, 0, 1}, 20);
    auto& attributes = primitiveOf(file)["attributes"];
    attributes["POSITION"] = file.addAccessorJson(view, "VEC3", test::kFloat, 3);
    attributes["TEXCOORD_0"] = file.addAccessorJson(view, "VEC2", test::kFloat, 3, {{"byteOffset", 12}});
    const Primitive p = loadPrimitive(file);
    EXPECT_EQ(p.positions, (std::vector<glm::vec3>{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}));
    EXPECT_EQ(p.uv0, (std::vector<glm::vec2>{{0.5f, 0.25f}, {1, 0}, {0, 1}}));
}

TEST(GltfAccessor, SparseValuesReplaceStoredOnesOrZeros) {
    GltfFile file = triangleFile();
    const int places = file.addView<std::uint8_t>({1, 2}), values = file.addView<float>({3, 0, 0, 0, 3, 0});
    const nlohmann::json sparse = {
        {"sparse",
         {{"count", 2},
          {"indices", {{"bufferView", places}, {"componentType", test::kUnsignedByte}}},
          {"values", {{"bufferView", values}}}}}};
    const std::vector<glm::vec3> expected{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}};
    primitiveOf(file)["attributes"]["POSITION"] =
        file.addAccessor<float>({0, 0, 0, 9, 9, 9, 9, 9, 9}, "VEC3", test::kFloat, 3, sparse);
    EXPECT_EQ(loadPrimitive(file).positions, expected);
    primitiveOf(file)["attributes"]["POSITION"] = file.addAccessorJson(-1, "VEC3", test::kFloat, 3, sparse);
    EXPECT_EQ(loadPrimitive(file).positions, expected);
}

TEST(GltfAccessor, IndicesOfEverySizeAndNone) {
    for (const bool indexed : {true, false}) {
        GltfFile file = triangleFile();
        if (!indexed) primitiveOf(file).erase("indices");
        EXPECT_EQ(loadPrimitive(file).indices, (std::vector<std::uint32_t>{0, 1, 2}));
    }
    GltfFile file = triangleFile();
    primitiveOf(file)["indices"] =
        file.addAccessor<std::uint8_t>({2, 0, 1}, "SCALAR", test::kUnsignedByte, 3);
    EXPECT_EQ(loadPrimitive(file).indices, (std::vector<std::uint32_t>{2, 0, 1}));
    primitiveOf(file)["indices"] =
        file.addAccessor<std::uint32_t>({1, 2, 0}, "SCALAR", test::kUnsignedInt, 3);
    EXPECT_EQ(loadPrimitive(file).indices, (std::vector<std::uint32_t>{1, 2, 0}));
}

// Two joints, one moved by (0, 0, 5): a vertex of weight ½ each moves half the way, whatever its node's
// transform.
TEST(GltfSkin, ASkinnedMeshIsPosedByItsJointsNotItsNode) {
    GltfFile file = triangleFile();
    auto& attributes = primitiveOf(file)["attributes"];
    attributes["JOINTS_0"] =
        file.addAccessor<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4", test::kUnsignedByte, 3);
    attributes["WEIGHTS_0"] =
        file.addAccessor<float>({1, 0, 0, 0, 0, 1, 0, 0, 0.5f, 0.5f, 0, 0}, "VEC4", test::kFloat, 3);
    file.json["skins"] = {{{"joints", {1, 2}}}};
    file.json["nodes"] = nlohmann::json::parse(
        R"([{"mesh": 0, "skin": 0, "translation": [7, 7, 7]}, {}, {"translation": [0, 0, 5]}])");
    file.json["scenes"][0]["nodes"] = {0, 1, 2};
    const TemporaryFolder folder;
    const Scene scene = loadGltf(file.saveGlb(folder.path()));
    const Node& node = scene.nodes[0];
    const std::vector<glm::vec3> expected{{0, 0, 0}, {1, 0, 5}, {0, 1, 2.5f}};
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 world(node.world *
                               glm::dvec4(scene.meshes[node.mesh].primitives[0].positions[i], 1));
        EXPECT_LT(glm::distance(world, glm::dvec3(expected[i])), 1e-6) << i;
    }
}

}  // namespace
}  // namespace cutis
