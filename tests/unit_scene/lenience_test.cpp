// Files that break a rule harmlessly: they load with the warning that docs/scene-format.md promises.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

#include "gltf_file.h"
#include "renderer/frame/geometry.h"
#include "renderer/scene/gltf.h"
#include "tests/support/process.h"
#include "warnings.h"

namespace cutis {
namespace {

using nlohmann::json;
using test::GltfFile;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

json& primitive(GltfFile& file) {
    return file.json["meshes"][0]["primitives"][0];
}

void setAttribute(GltfFile& file, const char* name, const std::vector<float>& values, const char* type) {
    const std::size_t count = file.json["accessors"][0]["count"];
    primitive(file)["attributes"][name] = file.addAccessor<float>(values, type, test::kFloat, count);
}

void addSkinMaterial(GltfFile& file) {
    file.json["materials"] = json::parse(R"([{"extras": {"skin": true}}])");
    primitive(file)["material"] = 0;
}

// A tetrahedron of skin, its triangles clockwise from outside when `inwards`; its normals point outwards or
// not.
void makeTetrahedron(GltfFile& file, bool inwards, float normals) {
    const std::vector<float> p = {1, 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1};
    std::vector<float> n;
    for (const float x : p) n.push_back(normals * x / std::sqrt(3.f));
    primitive(file)["attributes"] = {{"POSITION", file.addAccessor<float>(p, "VEC3", test::kFloat, 4)},
                                     {"NORMAL", file.addAccessor<float>(n, "VEC3", test::kFloat, 4)}};
    std::vector<std::uint32_t> triangles = {0, 2, 1, 0, 3, 2, 0, 1, 3, 1, 2, 3};
    if (inwards)
        for (std::size_t t = 0; t < triangles.size(); t += 3) std::swap(triangles[t + 1], triangles[t + 2]);
    primitive(file)["indices"] = file.addAccessor<std::uint32_t>(triangles, "SCALAR", test::kUnsignedInt, 12);
    addSkinMaterial(file);
}

void addAnimation(GltfFile& file, const char* path, const std::vector<float>& times,
                  const std::vector<float>& values) {
    const int input =
        file.addAccessor<float>(times, "SCALAR", test::kFloat, times.size(), {{"min", {0}}, {"max", {1}}});
    const int output = file.addAccessor<float>(values, "VEC3", test::kFloat, values.size() / 3);
    file.json["animations"] = {{{"samplers", {{{"input", input}, {"output", output}}}},
                                {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}}};
}

struct BrokenRule {
    const char* warning;                     // part of it
    std::function<void(GltfFile&)> breakIt;  // from a file of one triangle
};

const BrokenRule kBrokenRules[] = {
    {"is not supported and left out", [](GltfFile& f) { f.json["extensionsUsed"] = {"EXT_nobody_knows"}; }},
    {"points and lines are left out", [](GltfFile& f) { primitive(f)["mode"] = 1; }},
    {"a primitive without positions is left out",
     [](GltfFile& f) { primitive(f)["attributes"] = json::object(); }},
    {"the last triangle is incomplete and left out",
     [](GltfFile& f) {
         primitive(f)["indices"] =
             f.addAccessor<std::uint32_t>({0, 1, 2, 0, 1}, "SCALAR", test::kUnsignedInt, 5);
     }},
    {"with NaN or infinite positions are left out",
     [](GltfFile& f) {
         primitive(f)["attributes"]["POSITION"] =
             f.addAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, kNaN, 0, 0}, "VEC3", test::kFloat, 4);
         primitive(f)["indices"] =
             f.addAccessor<std::uint32_t>({0, 1, 2, 0, 1, 3}, "SCALAR", test::kUnsignedInt, 6);
     }},
    {"a primitive without a triangle of any area is left out",
     [](GltfFile& f) {
         primitive(f)["indices"] = f.addAccessor<std::uint32_t>({0, 1, 1}, "SCALAR", test::kUnsignedInt, 3);
     }},
    {"NaN or infinite texture coordinates or colours are replaced",
     [](GltfFile& f) {
         setAttribute(f, "TEXCOORD_0", {0, 0, 1, kNaN, 0, 1}, "VEC2");
     }},
    {"a texture without an image of a supported kind is left out",
     [](GltfFile& f) {
         f.json["textures"] = json::parse("[{}]");
         f.json["materials"] =
             json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
         primitive(f)["material"] = 0;
     }},
    {"do not sum to 1 and are scaled",
     [](GltfFile& f) {
         primitive(f)["attributes"]["JOINTS_0"] =
             f.addAccessor<std::uint16_t>(std::vector<std::uint16_t>(12, 0), "VEC4", test::kUnsignedShort, 3);
         setAttribute(f, "WEIGHTS_0", {0.5, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
         f.json["skins"] = json::parse(R"([{"joints": [0]}])");
         f.json["nodes"][0]["skin"] = 0;
     }},
    {"NaN or infinite differences are left out",
     [](GltfFile& f) {
         const int target = f.addAccessor<float>({0, 0, 0, kNaN, 0, 0, 0, 0, 0}, "VEC3", test::kFloat, 3);
         primitive(f)["targets"] = {{{"POSITION", target}}};
     }},
    {"an animation of \"pointer\" is left out",
     [](GltfFile& f) {
         addAnimation(f, "pointer", {0, 1}, {0, 0, 0, 1, 0, 0});
     }},
    {"an animation of a mesh without morph targets is left out",
     [](GltfFile& f) {
         addAnimation(f, "weights", {0, 1}, {0, 0, 0, 1, 0, 0});
     }},
    {"an animation whose times do not increase is left out",
     [](GltfFile& f) {
         addAnimation(f, "translation", {1, 0}, {0, 0, 0, 1, 0, 0});
     }},
    {"an animation with NaN or infinite values is left out",
     [](GltfFile& f) {
         addAnimation(f, "translation", {0, 1}, {0, 0, 0, kNaN, 0, 0});
     }},
    {"taken as skin by name",
     [](GltfFile& f) {
         f.json["materials"] = json::parse(R"([{"name": "Head_Skin"}])");
         primitive(f)["material"] = 0;
     }},
    {"taken as skin by its diffuse transmission and volume",
     [](GltfFile& f) {
         f.json["extensionsUsed"] = {"KHR_materials_diffuse_transmission", "KHR_materials_volume"};
         f.json["materials"] = json::parse(
             R"([{"extensions": {"KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.5},
                                 "KHR_materials_volume": {"thicknessFactor": 0.01}}}])");
         primitive(f)["material"] = 0;
     }},
    {"skin that is inside out is turned over", [](GltfFile& f) { makeTetrahedron(f, true, -1); }},
    {"normals that point into skin are turned", [](GltfFile& f) { makeTetrahedron(f, false, -1); }},
    {"has no texture coordinates: its skin is laid out anew",
     [](GltfFile& f) {
         addSkinMaterial(f);
         f.json["meshes"][0]["name"] = "bare";
     }},
    {"its skin gets a layout of its own there",
     [](GltfFile& f) {
         setAttribute(f, "TEXCOORD_0", {0.5, 0.5, 0.5, 0.5, 0.5, 0.5}, "VEC2");
         addSkinMaterial(f);
         f.json["meshes"][0]["name"] = "squeezed";
     }},
};

class Lenience : public testing::TestWithParam<BrokenRule> {};

TEST_P(Lenience, LoadsWithTheWarningThatTheDocsName) {
    const test::TemporaryFolder folder;
    GltfFile file = test::triangleFile();
    GetParam().breakIt(file);
    const test::CapturedWarnings warnings;
    const Scene scene = loadGltf(file.saveGlb(folder.path()));
    flattenScene(scene);
    EXPECT_EQ(warnings.count(GetParam().warning), 1) << GetParam().warning;
    std::ifstream page(CUTIS_SCENE_PAGE);
    std::stringstream text;
    text << page.rdbuf();
    EXPECT_NE(text.str().find(std::string("| `") + GetParam().warning + "` |"), std::string::npos)
        << "not in " << CUTIS_SCENE_PAGE;
}

INSTANTIATE_TEST_SUITE_P(Table, Lenience, testing::ValuesIn(kBrokenRules), [](const auto& test) {
    std::string name = std::to_string(test.index) + "_" + test.param.warning;
    std::ranges::replace_if(
        name, [](unsigned char c) { return !std::isalnum(c); }, '_');
    return name;
});

TEST(LenienceDocs, NameNoOtherRule) {
    std::ifstream page(CUTIS_SCENE_PAGE);
    std::size_t rows = 0;
    bool within = false;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("## ")) within = line == "## Rules that a file may break";
        rows += within && line.starts_with("| ") && !line.starts_with("| the file |");
    }
    EXPECT_EQ(rows, std::size(kBrokenRules));
}

// However it came, skin faces outwards.
TEST(SkinOutwards, AllFourWaysGiveTheSameBody) {
    for (const bool inwards : {false, true})
        for (const float normals : {1.f, -1.f}) {
            const test::TemporaryFolder folder;
            GltfFile file = test::triangleFile();
            makeTetrahedron(file, inwards, normals);
            const test::CapturedWarnings warnings;
            const Scene scene = loadGltf(file.saveGlb(folder.path()));
            EXPECT_EQ(warnings.all().size(), inwards || normals < 0 ? 1u : 0u);
            const Primitive& p = scene.meshes.at(0).primitives.at(0);
            for (std::size_t t = 0; t < p.indices.size(); t += 3) {
                const glm::vec3 a = p.positions[p.indices[t]], b = p.positions[p.indices[t + 1]],
                                c = p.positions[p.indices[t + 2]];
                EXPECT_GT(glm::dot(glm::cross(b - a, c - a), a + b + c), 0) << inwards << normals;
            }
            for (std::size_t v = 0; v < p.normals.size(); ++v)
                EXPECT_GT(glm::dot(p.normals[v], p.positions[v]), 0) << inwards << normals;
        }
}

}  // namespace
}  // namespace cutis
