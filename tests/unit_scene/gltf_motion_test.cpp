// Skins, morph targets and animations as loadGltf reads them, right and wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "gltf_file.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/pose.h"
#include "tests/support/process.h"
#include "warnings.h"

namespace cutis {
namespace {

using test::GltfFile;
using test::TemporaryFolder;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

nlohmann::json& primitiveOf(GltfFile& file) {
    return file.json["meshes"][0]["primitives"][0];
}

Scene load(const GltfFile& file) {
    const TemporaryFolder folder;
    return loadGltf(file.saveGlb(folder.path()));
}

std::string errorOf(const GltfFile& file) {
    try {
        load(file);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

glm::dvec3 worldPosition(const Scene& scene, int node, std::size_t vertex) {
    const Node& n = scene.nodes[node];
    return glm::dvec3(n.world * glm::dvec4(scene.meshes[n.mesh].primitives[0].positions[vertex], 1));
}

// Adds a vertex attribute of 4 components.
template <class T>
void addAttribute(GltfFile& file, const char* name, const std::vector<T>& values, int type,
                  bool normalized = false) {
    const nlohmann::json more = normalized ? nlohmann::json{{"normalized", true}} : nlohmann::json::object();
    primitiveOf(file)["attributes"][name] = file.addAccessor(values, "VEC4", type, values.size() / 4, more);
}

// The triangle (0,0,0) (1,0,0) (0,1,0), bound to two joints: node 1, and node 2 below it. Vertex 2 follows
// both.
GltfFile skinnedFile() {
    GltfFile file = test::triangleFile();
    addAttribute<std::uint8_t>(file, "JOINTS_0", {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, test::kUnsignedByte);
    addAttribute<float>(file, "WEIGHTS_0", {1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}, test::kFloat);
    file.json["skins"] = {{{"joints", {1, 2}}, {"skeleton", 1}}};
    file.json["nodes"] = nlohmann::json::parse(R"([{"mesh": 0, "skin": 0}, {"children": [2]}, {}])");
    file.json["scenes"][0]["nodes"] = {0, 1};
    return file;
}

// Adds a channel of a new sampler to the file's one animation.
void animate(GltfFile& file, int node, const char* path, int input, int output,
             const char* interpolation = "LINEAR") {
    nlohmann::json& animation = file.json["animations"][0];
    animation["name"] = "walk";
    animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

int times(GltfFile& file, const std::vector<float>& values) {
    return file.addAccessor(values, "SCALAR", test::kFloat, values.size());
}

GltfFile walkingFile() {
    GltfFile file = skinnedFile();
    animate(file, 2, "translation", times(file, {0, 2}),
            file.addAccessor<float>({0, 0, 0, 0, 0, 4}, "VEC3", test::kFloat, 2));
    return file;
}

TEST(GltfMotion, AnAnimationMovesJointsAndTheyTheMesh) {
    Scene scene = load(walkingFile());
    ASSERT_EQ(scene.animations.size(), 1u);
    EXPECT_EQ(scene.animations[0].name, "walk");
    EXPECT_EQ(scene.animations[0].duration, 2);
    EXPECT_LT(glm::distance(worldPosition(scene, 0, 1), glm::dvec3(1, 0, 0)), 1e-6);
    poseScene(scene, 0, 1);
    EXPECT_LT(glm::distance(worldPosition(scene, 0, 0), glm::dvec3(0, 0, 0)), 1e-6);
    EXPECT_LT(glm::distance(worldPosition(scene, 0, 1), glm::dvec3(1, 0, 2)), 1e-6);
    EXPECT_LT(glm::distance(worldPosition(scene, 0, 2), glm::dvec3(0, 1, 1)), 1e-6);
    EXPECT_EQ(scene.meshes[0].primitives[0].restPositions[1], glm::vec3(1, 0, 0));
}

// Half the way up by weights in a second set, whatever their format.
TEST(GltfMotion, InfluencesOfEverySetAndFormat) {
    for (const int format : {test::kFloat, test::kUnsignedByte, test::kUnsignedShort}) {
        GltfFile file = walkingFile();
        addAttribute<std::uint16_t>(file, "JOINTS_0", std::vector<std::uint16_t>(12, 0),
                                    test::kUnsignedShort);
        addAttribute<std::uint8_t>(file, "JOINTS_1", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0},
                                   test::kUnsignedByte);
        for (const char* name : {"WEIGHTS_0", "WEIGHTS_1"}) {
            const std::vector<float> half{0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 0.5f, 0, 0, 0};
            std::vector<std::uint8_t> bytes;
            std::vector<std::uint16_t> shorts;
            for (const float h : half)
                bytes.push_back(std::uint8_t(h * 255)), shorts.push_back(std::uint16_t(h * 65535));
            if (format == test::kFloat) addAttribute(file, name, half, format);
            if (format == test::kUnsignedByte) addAttribute(file, name, bytes, format, true);
            if (format == test::kUnsignedShort) addAttribute(file, name, shorts, format, true);
        }
        test::CapturedWarnings warnings;
        Scene scene = load(file);
        EXPECT_TRUE(warnings.all().empty()) << format;
        poseScene(scene, 0, 2);
        EXPECT_LT(glm::distance(worldPosition(scene, 0, 0), glm::dvec3(0, 0, 2)), 1e-6) << format;
    }
}

// Without inverse bind matrices joints are bound where the world's centre is (glTF 2.0, §5.28.1).
TEST(GltfMotion, InverseBindMatrices) {
    GltfFile file = walkingFile();
    std::vector<float> matrices(32, 0);
    for (int i = 0; i < 32; i += 16) matrices[i] = matrices[i + 5] = matrices[i + 10] = matrices[i + 15] = 1;
    matrices[16 + 13] = -3;  // joint 1 was bound at y = 3
    file.json["skins"][0]["inverseBindMatrices"] = file.addAccessor(matrices, "MAT4", test::kFloat, 2);
    const Scene scene = load(file);
    EXPECT_LT(glm::distance(worldPosition(scene, 0, 1), glm::dvec3(1, -3, 0)), 1e-6);
    file.json["skins"][0]["inverseBindMatrices"] =
        file.addAccessor(std::vector<float>(16, 0), "MAT4", test::kFloat, 1);
    EXPECT_NE(errorOf(file).find("there are fewer matrices than joints"), std::string::npos);
    matrices[7] = kNaN;
    file.json["skins"][0]["inverseBindMatrices"] = file.addAccessor(matrices, "MAT4", test::kFloat, 2);
    EXPECT_NE(errorOf(file).find("matrix 0 is not finite"), std::string::npos) << errorOf(file);
}

// Joints that mirror a mesh, its node standing as it was, turn its triangles over: their front stays their
// front. Where node and joints hang on one root that mirrors, the node's transform does that.
TEST(GltfMotion, MirroredSkeletonsKeepTheFrontInFront) {
    const auto facing = [](const GltfFile& file) {
        const Scene scene = load(file);
        int node = 0;
        while (scene.nodes[node].mesh < 0) ++node;
        const Primitive& p = scene.meshes[scene.nodes[node].mesh].primitives[0];
        glm::dvec3 corner[3];
        for (int i = 0; i < 3; ++i) corner[i] = worldPosition(scene, node, p.indices[i]);
        const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        return glm::determinant(scene.nodes[node].world) < 0 ? -normal.z : normal.z;
    };
    GltfFile file = walkingFile();
    const double front = facing(file);
    ASSERT_NE(front, 0);
    file.json["nodes"].push_back({{"scale", {-1, 1, 1}}, {"children", {1}}});
    const int root = int(file.json["nodes"].size()) - 1;
    file.json["scenes"][0]["nodes"] = {0, root};
    EXPECT_NEAR(facing(file), front, 1e-6);
    file.json["nodes"][root]["children"] = {0, 1};
    file.json["scenes"][0]["nodes"] = {root};
    EXPECT_NEAR(facing(file), front, 1e-6);
}

TEST(GltfMotion, WeightsThatDoNotSumToOneAreScaledWithAWarning) {
    GltfFile file = walkingFile();
    addAttribute<float>(file, "WEIGHTS_0", {1, 0, 0, 0, 0, 0, 0, 0, 2, 2, kNaN, -1}, test::kFloat);
    test::CapturedWarnings warnings;
    Scene scene = load(file);
    EXPECT_EQ(warnings.count("the weights of 2 vertices do not sum to 1 and are scaled"), 1);
    poseScene(scene, 0, 2);
    EXPECT_LT(glm::distance(worldPosition(scene, 0, 1), glm::dvec3(1, 0, 4)),
              1e-6);  // follows its first joint
    EXPECT_LT(glm::distance(worldPosition(scene, 0, 2), glm::dvec3(0, 1, 2)), 1e-6);
}

// Target 0 moves vertex 1 by a sparse accessor, target 1 all of them.
GltfFile morphFile() {
    GltfFile file = test::triangleFile();
    const int place = file.addView<std::uint16_t>({1}), value = file.addView<float>({0, 0, 3});
    const int sparse =
        file.addAccessorJson(-1, "VEC3", test::kFloat, 3,
                             {{"sparse",
                               {{"count", 1},
                                {"indices", {{"bufferView", place}, {"componentType", test::kUnsignedShort}}},
                                {"values", {{"bufferView", value}}}}}});
    const int all = file.addAccessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", test::kFloat, 3);
    primitiveOf(file)["targets"] = {{{"POSITION", sparse}}, {{"POSITION", all}}};
    file.json["meshes"][0]["weights"] = {0.5, 0};
    file.json["nodes"] = nlohmann::json::parse(R"([{"mesh": 0}, {"mesh": 0, "weights": [1, 2]}])");
    file.json["scenes"][0]["nodes"] = {0, 1};
    return file;
}

TEST(GltfMotion, MorphTargetsSparseAndDenseWithWeightsOfMeshAndNode) {
    GltfFile file = morphFile();
    animate(file, 0, "weights", times(file, {0, 1}),
            file.addAccessor<std::uint8_t>({0, 0, 255, 51}, "SCALAR", test::kUnsignedByte, 4,
                                           {{"normalized", true}}));
    Scene scene = load(file);
    EXPECT_EQ(worldPosition(scene, 0, 1), glm::dvec3(1, 0, 1.5));
    EXPECT_EQ(worldPosition(scene, 0, 2), glm::dvec3(0, 1, 0));
    EXPECT_EQ(worldPosition(scene, 1, 1), glm::dvec3(1, 0, 5));
    EXPECT_EQ(worldPosition(scene, 1, 2), glm::dvec3(0, 1, 2));
    const Deformation& d = *scene.meshes[scene.nodes[0].mesh].primitives[0].deformation;
    EXPECT_EQ(d.targets[0].vertices, std::vector<std::uint32_t>{1});
    poseScene(scene, 0, 1);
    EXPECT_LT(glm::distance(worldPosition(scene, 0, 1), glm::dvec3(1, 0, 3.2)), 1e-6);
    EXPECT_EQ(worldPosition(scene, 1, 1), glm::dvec3(1, 0, 5));  // not animated: as it rests
}

// A triangle that only a target unfolds is there, and one that is a line by its indices is not.
TEST(GltfMotion, TargetsUnfoldWhatIsFlat) {
    GltfFile file = morphFile();
    primitiveOf(file)["attributes"]["POSITION"] =
        file.addAccessor<float>({0, 0, 0, 1, 0, 0, 2, 0, 0}, "VEC3", test::kFloat, 3);
    primitiveOf(file)["indices"] =
        file.addAccessor<std::uint16_t>({0, 1, 2, 0, 0, 1}, "SCALAR", test::kUnsignedShort, 6);
    const Scene scene = load(file);
    const Primitive& p = scene.meshes[scene.nodes[0].mesh].primitives[0];
    EXPECT_EQ(p.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    for (const glm::vec3& n : p.normals)
        EXPECT_NEAR(std::abs(n.y), 1, 1e-6);  // the triangle stands in y = 0 now
}

// 90 degrees about z in every format that a rotation may have, and what is normalized of scales and
// translations.
TEST(GltfMotion, ValuesOfEveryFormat) {
    const double h = std::sqrt(0.5);
    const auto rotated = [&](auto highest, int type, double tolerance) {
        using T = decltype(highest);
        GltfFile file = walkingFile();
        const auto half = T(std::lround(h * double(highest)));
        animate(file, 2, "rotation", times(file, {0}),
                file.addAccessor<T>(
                    {0, 0, half, half}, "VEC4", type, 1,
                    type == test::kFloat ? nlohmann::json::object() : nlohmann::json{{"normalized", true}}));
        Scene scene = load(file);
        poseScene(scene, 0, 0);
        EXPECT_LT(glm::distance(worldPosition(scene, 0, 1), glm::dvec3(0, 1, 0)), tolerance) << type;
    };
    rotated(std::int8_t(127), test::kByte, 1e-6);  // both components alike: rounding cancels
    rotated(std::uint8_t(255), test::kUnsignedByte, 1e-6);
    rotated(std::int16_t(32767), test::kShort, 1e-6);
    rotated(std::uint16_t(65535), test::kUnsignedShort, 1e-6);
    GltfFile file = walkingFile();
    animate(file, 2, "rotation", times(file, {0}),
            file.addAccessor<float>({0, 0, float(h), float(h)}, "VEC4", test::kFloat, 1));
    animate(file, 1, "scale", times(file, {0}),
            file.addAccessor<std::uint8_t>({51, 255, 255}, "VEC3", test::kUnsignedByte, 1,
                                           {{"normalized", true}}));
    Scene scene = load(file);
    poseScene(scene, 0, 1);
    EXPECT_LT(glm::distance(worldPosition(scene, 0, 1), glm::dvec3(0, 1, 2)), 1e-6);
    EXPECT_LT(glm::distance(worldPosition(scene, 0, 0), glm::dvec3(0, 0, 0)), 1e-6);
    EXPECT_NEAR(glm::length(glm::dvec3(scene.nodes[1].world[0])), 0.2, 1e-7);
}

TEST(GltfMotion, WhatCannotBeShownIsLeftOutWithAWarning) {
    struct Case {
        const char* warning;
        std::function<void(GltfFile&)> spoil;
    };
    const std::vector<Case> cases{
        {"times do not increase",
         [](GltfFile& f) {
             f.json["animations"][0]["samplers"][0]["input"] = times(f, {1, 0});
         }},
        {"times do not increase",
         [](GltfFile& f) {
             f.json["animations"][0]["samplers"][0]["input"] = times(f, {0, kNaN});
         }},
        {"NaN or infinite values",
         [](GltfFile& f) {
             f.json["animations"][0]["samplers"][0]["output"] =
                 f.addAccessor<float>({0, 0, 0, 0, 0, kNaN}, "VEC3", test::kFloat, 2);
         }},
        {"an animation of \"pointer\"",
         [](GltfFile& f) { f.json["animations"][0]["channels"][0]["target"]["path"] = "pointer"; }},
        {"without morph targets",
         [](GltfFile& f) { f.json["animations"][0]["channels"][0]["target"]["path"] = "weights"; }},
    };
    for (const Case& c : cases) {
        GltfFile file = walkingFile();
        c.spoil(file);
        test::CapturedWarnings warnings;
        const Scene scene = load(file);
        EXPECT_EQ(warnings.count(c.warning), 1) << c.warning;
        EXPECT_TRUE(scene.animations.at(0).channels.empty()) << c.warning;
    }
    // Of a node of another scene there is nothing to say.
    GltfFile file = walkingFile();
    file.json["nodes"].push_back(nlohmann::json::object());
    file.json["animations"][0]["channels"][0]["target"]["node"] = 3;
    EXPECT_TRUE(load(file).animations.at(0).channels.empty());
}

TEST(GltfMotion, WhatIsWrongIsOneClearLine) {
    struct Case {
        const char* error;
        std::function<void(GltfFile&)> spoil;
    };
    const std::vector<Case> cases{
        {"joint 2 of 2, ",
         [](GltfFile& f) {
             addAttribute<std::uint8_t>(f, "JOINTS_0", {0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0},
                                        test::kUnsignedByte);
         }},
        {"WEIGHTS_0 is missing", [](GltfFile& f) { primitiveOf(f)["attributes"].erase("WEIGHTS_0"); }},
        {"animations[0].channels[0].target.node",
         [](GltfFile& f) { f.json["animations"][0]["channels"][0]["target"]["node"] = 9; }},
        {"animations[0].channels[0].sampler",
         [](GltfFile& f) { f.json["animations"][0]["channels"][0]["sampler"] = 5; }},
        {"there is no interpolation \"BEZIER\"",
         [](GltfFile& f) { f.json["animations"][0]["samplers"][0]["interpolation"] = "BEZIER"; }},
        {"it has 6 numbers for 2 keys of 9",
         [](GltfFile& f) { f.json["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE"; }},
        {"a skin has at least one joint",
         [](GltfFile& f) { f.json["skins"][0]["joints"] = nlohmann::json::array(); }},
        {"skins[0].skeleton", [](GltfFile& f) { f.json["skins"][0]["skeleton"] = 12; }},
        {"2 elements for 3 positions",
         [](GltfFile& f) {
             primitiveOf(f)["targets"] = {
                 {{"POSITION", f.addAccessor<float>({0, 0, 0, 0, 0, 0}, "VEC3", test::kFloat, 2)}}};
         }},
    };
    for (const Case& c : cases) {
        GltfFile file = walkingFile();
        c.spoil(file);
        EXPECT_NE(errorOf(file).find(c.error), std::string::npos) << c.error << ": " << errorOf(file);
        EXPECT_EQ(errorOf(file).find('\n'), std::string::npos);
    }
}

}  // namespace
}  // namespace cutis
