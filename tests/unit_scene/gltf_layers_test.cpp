// The material extensions over metallic-roughness as loadGltf reads them.
#include <gtest/gtest.h>

#include "gltf_file.h"
#include "renderer/core/error.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/image_io.h"
#include "tests/support/process.h"
#include "warnings.h"

namespace cutis {
namespace {

using nlohmann::json;

// A textured triangle of one material with these extensions.
Scene load(const json& extensions) {
    test::GltfFile file = test::triangleFile();
    auto& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] =
        file.addAccessor<float>({0, 0, 1, 0, 0, 1}, "VEC2", test::kFloat, 3);
    Image image;
    image.width = image.height = 1;
    image.texels.assign(4, std::byte(128));
    file.json["images"] = {{{"mimeType", "image/png"}, {"bufferView", file.addView(encodePng(image))}}};
    file.json["textures"] = json::parse(R"([{"source": 0}])");
    file.json["materials"] = {{{"extensions", extensions}}};
    primitive["material"] = 0;
    for (const auto& [name, content] : extensions.items()) file.json["extensionsRequired"].push_back(name);
    const test::TemporaryFolder folder;
    return loadGltf(file.saveGlb(folder.path()));
}

TEST(GltfLayers, EveryField) {
    const test::CapturedWarnings warnings;
    const Scene scene = load(json::parse(R"({
        "KHR_materials_ior": {"ior": 1.4},
        "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [2, 1, 0.5],
            "specularTexture": {"index": 0}, "specularColorTexture": {"index": 0}},
        "KHR_materials_clearcoat": {"clearcoatFactor": 0.75, "clearcoatRoughnessFactor": 0.25,
            "clearcoatTexture": {"index": 0}, "clearcoatRoughnessTexture": {"index": 0},
            "clearcoatNormalTexture": {"index": 0, "scale": 0.5}},
        "KHR_materials_sheen": {"sheenColorFactor": [1, 0.5, 0.25], "sheenRoughnessFactor": 0.3,
            "sheenColorTexture": {"index": 0}, "sheenRoughnessTexture": {"index": 0}},
        "KHR_materials_transmission": {"transmissionFactor": 0.9, "transmissionTexture": {"index": 0}}})"));
    EXPECT_TRUE(warnings.all().empty());
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.dielectric.ior, 1.4f);
    EXPECT_EQ(m.dielectric.specular, 0.5f);
    EXPECT_EQ(m.dielectric.specularColor, glm::vec3(2, 1, 0.5f));
    EXPECT_EQ(m.clearcoat.factor, 0.75f);
    EXPECT_EQ(m.clearcoat.roughness, 0.25f);
    EXPECT_EQ(m.clearcoat.normalScale, 0.5f);
    EXPECT_EQ(m.sheen.color, glm::vec3(1, 0.5f, 0.25f));
    EXPECT_EQ(m.sheen.roughness, 0.3f);
    EXPECT_EQ(m.transmission, 0.9f);
    EXPECT_TRUE(m.seenThrough());
    EXPECT_FALSE(scene.meshes.at(0).primitives.at(0).tangents.empty()) << "the coat's normal map needs them";
    // Colours are sRGB, all else is data: which of the two each slot reads its image as.
    const std::pair<const TextureSlot*, bool> slots[] = {
        {&m.dielectric.specularTexture, false}, {&m.dielectric.specularColorTexture, true},
        {&m.clearcoat.texture, false},          {&m.clearcoat.roughnessTexture, false},
        {&m.clearcoat.normalTexture, false},    {&m.sheen.colorTexture, true},
        {&m.sheen.roughnessTexture, false},     {&m.transmissionTexture, false}};
    int place = 0;
    for (const auto& [slot, color] : slots) {
        ASSERT_TRUE(*slot);
        EXPECT_EQ(scene.textures.at(slot->texture).srgb, color) << "slot " << place;
        ++place;
    }
}

TEST(GltfLayers, WithoutThemNothingIsThere) {
    const Scene scene = load(json::parse(
        R"({"KHR_materials_clearcoat": {}, "KHR_materials_sheen": {}, "KHR_materials_transmission": {},
            "KHR_materials_ior": {}, "KHR_materials_specular": {}})"));
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.dielectric.ior, 1.5f);
    EXPECT_EQ(m.dielectric.specular, 1);
    EXPECT_EQ(m.dielectric.specularColor, glm::vec3(1));
    EXPECT_EQ(m.clearcoat.factor, 0);
    EXPECT_EQ(m.sheen.color, glm::vec3(0));
    EXPECT_EQ(m.transmission, 0);
    EXPECT_FALSE(m.seenThrough());
}

// As core factors are: what lies outside [0,1] is taken for the nearest value that does not.
TEST(GltfLayers, FactorsAreClamped) {
    const Material m = load(json::parse(R"({"KHR_materials_clearcoat": {"clearcoatFactor": 7},
        "KHR_materials_sheen": {"sheenColorFactor": [9, -1, 0.5], "sheenRoughnessFactor": -1},
        "KHR_materials_specular": {"specularColorFactor": [-1, 3, 1e30]},
        "KHR_materials_transmission": {"transmissionFactor": 2}})"))
                           .materials.at(0);
    EXPECT_EQ(m.clearcoat.factor, 1);
    EXPECT_EQ(m.sheen.color, glm::vec3(1, 0, 0.5f));
    EXPECT_EQ(m.sheen.roughness, 0);
    EXPECT_EQ(m.dielectric.specularColor, glm::vec3(0, 3, 1e6f));
    EXPECT_EQ(m.transmission, 1);
}

TEST(GltfLayers, WrongValuesAreRefusedWithTheirPath) {
    const std::pair<const char*, const char*> table[] = {
        {R"({"KHR_materials_ior": {"ior": 0.5}})", "KHR_materials_ior.ior"},
        {R"({"KHR_materials_ior": {"ior": -1}})", "KHR_materials_ior.ior"},
        {R"({"KHR_materials_ior": {"ior": "glass"}})", "KHR_materials_ior.ior"},
        {R"({"KHR_materials_ior": 3})", "KHR_materials_ior"},
        {R"({"KHR_materials_specular": {"specularColorFactor": [1, 1]}})",
         "KHR_materials_specular.specularColorFactor"},
        {R"({"KHR_materials_clearcoat": {"clearcoatFactor": "much"}})",
         "KHR_materials_clearcoat.clearcoatFactor"},
        {R"({"KHR_materials_clearcoat": {"clearcoatTexture": {"index": 9}}})",
         "KHR_materials_clearcoat.clearcoatTexture.index"},
        {R"({"KHR_materials_sheen": {"sheenColorFactor": 1}})", "KHR_materials_sheen.sheenColorFactor"},
        {R"({"KHR_materials_sheen": {"sheenRoughnessTexture": {"index": 0, "texCoord": 5}}})",
         "KHR_materials_sheen.sheenRoughnessTexture"},
        {R"({"KHR_materials_transmission": {"transmissionFactor": []}})",
         "KHR_materials_transmission.transmissionFactor"},
    };
    for (const auto& [extensions, path] : table) {
        try {
            load(json::parse(extensions));
            FAIL() << extensions << " was accepted";
        } catch (const Error& error) {
            EXPECT_TRUE(error.where().ends_with(std::string("materials[0].extensions.") + path))
                << extensions << "\n"
                << error.what();
        }
    }
}

}  // namespace
}  // namespace cutis
