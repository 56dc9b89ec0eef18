// Materials, texture slots and skin parameters as loadGltf reads them.
#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "gltf_file.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/image_io.h"
#include "tests/support/process.h"
#include "warnings.h"

namespace cutis {
namespace {

using nlohmann::json;

// A textured triangle whose one material is `material`; textures 0 to 2 use samplers 0, 1 and none.
test::GltfFile fileWith(const json& material) {
    test::GltfFile file = test::triangleFile();
    auto& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_0"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1}, "VEC2", test::kFloat, 3);
    Image image;
    image.width = image.height = 1;
    image.texels.assign(4, std::byte(128));
    file.json["images"] = {{{"mimeType", "image/png"}, {"bufferView", file.addView(encodePng(image))}}};
    file.json["samplers"] = json::parse(R"([
        {"wrapS": 33071, "wrapT": 33648, "magFilter": 9728, "minFilter": 9728}, {"minFilter": 9729, "magFilter": 9729}])");
    file.json["textures"] =
        json::parse(R"([{"source": 0, "sampler": 0}, {"source": 0, "sampler": 1}, {"source": 0}])");
    file.json["materials"] = {material};
    file.json["meshes"][0]["primitives"][0]["material"] = 0;
    return file;
}

Scene load(const test::GltfFile& file) {
    const test::TemporaryFolder folder;
    return loadGltf(file.saveGlb(folder.path()));
}

TEST(GltfMaterial, EveryCoreFeature) {
    const Scene scene = load(fileWith(json::parse(R"({
        "name": "all", "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.25, "emissiveFactor": [1, 0.5, 0],
        "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 0.75], "metallicFactor": 0.1, "roughnessFactor": 0.7,
            "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0, "texCoord": 1}},
        "normalTexture": {"index": 1, "scale": 0.5}, "occlusionTexture": {"index": 2, "strength": 0.3},
        "emissiveTexture": {"index": 2},
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}, "KHR_materials_unlit": {}}})")));
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.name, "all");
    EXPECT_EQ(m.baseColor, glm::vec4(0.5f, 0.25f, 1, 0.75f));
    EXPECT_EQ(m.metallic, 0.1f);
    EXPECT_EQ(m.roughness, 0.7f);
    EXPECT_EQ(m.normalScale, 0.5f);
    EXPECT_EQ(m.occlusionStrength, 0.3f);
    EXPECT_EQ(m.emissive, glm::vec3(8, 4, 0));
    EXPECT_EQ(m.alphaMode, AlphaMode::mask);
    EXPECT_EQ(m.alphaCutoff, 0.25f);
    EXPECT_TRUE(m.doubleSided);
    EXPECT_TRUE(m.unlit);
    EXPECT_FALSE(m.skin);
    EXPECT_EQ(m.metallicRoughnessTexture.texCoord, 1);
    // One image: as colour with sampler 0, as data with samplers 0, 1 and none, as colour with none.
    EXPECT_EQ(scene.images.size(), 1u);
    ASSERT_EQ(scene.textures.size(), 5u);
    const auto textureOf = [&](const TextureSlot& slot) { return scene.textures.at(slot.texture); };
    EXPECT_TRUE(textureOf(m.baseColorTexture).srgb);
    EXPECT_TRUE(textureOf(m.emissiveTexture).srgb);
    EXPECT_FALSE(textureOf(m.metallicRoughnessTexture).srgb);
    EXPECT_FALSE(textureOf(m.normalTexture).srgb);
    EXPECT_FALSE(textureOf(m.occlusionTexture).srgb);
    EXPECT_EQ(textureOf(m.baseColorTexture).sampler,
              (Sampler{Wrap::clampToEdge, Wrap::mirroredRepeat, true, false}));
    EXPECT_EQ(textureOf(m.normalTexture).sampler, (Sampler{Wrap::repeat, Wrap::repeat, false, false}));
    EXPECT_EQ(textureOf(m.occlusionTexture).sampler, Sampler{});
}

TEST(GltfMaterial, DefaultsAreThoseOfTheSpecification) {
    const Scene scene = load(fileWith(json::object()));
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.baseColor, glm::vec4(1));
    EXPECT_EQ(m.metallic, 1);
    EXPECT_EQ(m.roughness, 1);
    EXPECT_EQ(m.emissive, glm::vec3(0));
    EXPECT_EQ(m.alphaMode, AlphaMode::opaque);
    EXPECT_FALSE(m.baseColorTexture);
    EXPECT_TRUE(scene.textures.empty());
}

// The extension's example: offset (0, 1), rotation π/2, scale (0.5, 0.5) shows "only the lower left quadrant
// of the source image, rotated clockwise 90°". Its texCoord overrides the slot's.
TEST(GltfMaterial, TextureTransform) {
    const Scene scene =
        load(fileWith(json::parse(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions":
        {"KHR_texture_transform": {"offset": [0, 1], "rotation": 1.57079632679, "scale": [0.5, 0.5], "texCoord": 1}}}}})")));
    const TextureSlot& slot = scene.materials.at(0).baseColorTexture;
    EXPECT_EQ(slot.texCoord, 1);
    const auto at = [&](float u, float v) { return glm::vec2(slot.transform * glm::vec3(u, v, 1)); };
    // Top left of the surface shows the quadrant's bottom left corner, bottom left its bottom right one.
    EXPECT_LT(glm::distance(at(0, 0), glm::vec2(0, 1)), 1e-6f);
    EXPECT_LT(glm::distance(at(0, 1), glm::vec2(0.5f, 1)), 1e-6f);
    EXPECT_LT(glm::distance(at(1, 0), glm::vec2(0, 0.5f)), 1e-6f);
}

TEST(GltfSkinMaterial, ParametersAreRead) {
    const Scene scene = load(fileWith(json::parse(R"({"name": "glass", "extras": {"skin": {
        "profile": [{"variance_mm2": 2, "weight": [0.5, 0, 0]}, {"variance_mm2": 1, "weight": [0.5, 1, 1]}],
        "scale": 2, "mix": 0.25, "roughness": 0.4, "specular": 0.5, "translucency": false, "mm_per_unit": 10,
        "lobe_weight": 0.3, "lobe_ratio": 0.6, "detail": 1.25, "detail_scale": 5}}})")));
    ASSERT_TRUE(scene.materials.at(0).skin);
    const SkinMaterial& skin = *scene.materials[0].skin;
    ASSERT_EQ(skin.profile.gaussians.size(), 2u);
    EXPECT_EQ(skin.profile.gaussians[0], (skin::Gaussian{1, {0.5, 1, 1}}));
    EXPECT_EQ(skin.scale, 2);
    EXPECT_EQ(skin.mix, 0.25);
    EXPECT_EQ(skin.roughness, 0.4);
    EXPECT_EQ(skin.specular, 0.5);
    EXPECT_FALSE(skin.translucency);
    EXPECT_EQ(skin.mmPerUnit, 10);
    EXPECT_EQ(skin.lobeWeight, 0.3);
    EXPECT_EQ(skin.lobeRatio, 0.6);
    EXPECT_EQ(skin.detail, 1.25);
    EXPECT_EQ(skin.detailScale, 5);
    EXPECT_EQ(scene.characters.size(), 1u);
}

TEST(GltfSkinMaterial, TrueIsTheThreeLayerSkin) {
    const Scene scene = load(fileWith(json::parse(R"({"extras": {"skin": true}})")));
    ASSERT_TRUE(scene.materials.at(0).skin);
    EXPECT_EQ(scene.materials[0].skin->profile, skin::threeLayerProfile());
    EXPECT_EQ(scene.materials[0].skin->mix, 0.5);
}

TEST(GltfSkinMaterial, WithoutAMarkTheNameDecidesAndTheProgramSaysSo) {
    const std::pair<const char*, bool> names[] = {
        {"skin", true},   {"Anna_Head.001", true}, {"FaceMat", true},   {"body", true},
        {"HEAD", true},   {"surface", false},      {"somebody", false}, {"headlight", false},
        {"cloth", false}, {"femaleSkin2", true},   {"", false}};
    for (const auto& [name, isSkin] : names) {
        const test::CapturedWarnings warnings;
        const Scene scene = load(fileWith({{"name", name}}));
        EXPECT_EQ(scene.materials.at(0).skin.has_value(), isSkin) << name;
        EXPECT_EQ(warnings.count("taken as skin by name"), isSkin ? 1 : 0) << name;
    }
    const test::CapturedWarnings warnings;
    EXPECT_FALSE(
        load(fileWith(json::parse(R"({"name": "skin", "extras": {"skin": false}})"))).materials.at(0).skin);
    EXPECT_TRUE(warnings.all().empty());
}

TEST(GltfSkinMaterial, SelectSkin) {
    Scene scene = load(fileWith(json::parse(R"({"name": "Anna", "extras": {"skin": {"mix": 0.1}}})")));
    Material other;
    other.name = "Ben";
    scene.materials.push_back(other);
    selectSkin(scene, "[AB]*n*");
    EXPECT_EQ(scene.materials[0].skin->mix, 0.1);
    EXPECT_EQ(scene.materials[1].skin->mix, 0.5);
    selectSkin(scene, "Ben");
    EXPECT_FALSE(scene.materials[0].skin);
    EXPECT_TRUE(scene.characters.empty());
    selectSkin(scene, "none");
    EXPECT_FALSE(scene.materials[1].skin);
    try {
        selectSkin(scene, "Carl*");
        FAIL() << "a glob that matches nothing was accepted";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("'Anna', 'Ben'"), std::string::npos) << error.what();
    }
}

TEST(GltfSkinMaterial, WrongParametersAreRefusedWithTheirPath) {
    const std::pair<const char*, const char*> table[] = {
        {R"({"skin": 1})", "skin"},
        {R"({"skin": {"mixx": 0.5}})", "skin.mixx"},
        {R"({"skin": {"mix": 1.5}})", "skin.mix"},
        {R"({"skin": {"mix": "half"}})", "skin.mix"},
        {R"({"skin": {"roughness": 0}})", "skin.roughness"},
        {R"({"skin": {"specular": -1}})", "skin.specular"},
        {R"({"skin": {"scale": 0}})", "skin.scale"},
        {R"({"skin": {"lobe_weight": 1.5}})", "skin.lobe_weight"},
        {R"({"skin": {"lobe_ratio": 0}})", "skin.lobe_ratio"},
        {R"({"skin": {"detail": -1}})", "skin.detail"},
        {R"({"skin": {"detail_scale": 0}})", "skin.detail_scale"},
        {R"({"skin": {"mm_per_unit": -3}})", "skin.mm_per_unit"},
        {R"({"skin": {"translucency": 1}})", "skin.translucency"},
        {R"({"skin": {"profile": "four-layer"}})", "skin.profile"},
        {R"({"skin": {"profile": []}})", "skin.profile"},
        {R"({"skin": {"profile": [{"variance_mm2": 0, "weight": [1, 1, 1]}]}})",
         "skin.profile[0].variance_mm2"},
        {R"({"skin": {"profile": [{"variance_mm2": 1, "weight": [1, 1]}]}})", "skin.profile[0].weight"},
        {R"({"skin": {"profile": [{"variance_mm2": 1, "weight": [1, -1, 1]}]}})", "skin.profile[0].weight"},
        {R"({"skin": {"profile": [{"variance_mm2": 1}]}})", "skin.profile[0]"},
        {R"({"skin": {"profile": [{"variance_mm2": 1, "weight": [2, 1, 1]}]}})", "skin.profile"},
        {R"({"skin": {"profile": [{"variance_mm2": 1, "weight": [1, 1, 1], "name": 1}]}})",
         "skin.profile[0].name"},
    };
    for (const auto& [extras, path] : table) {
        try {
            load(fileWith({{"extras", json::parse(extras)}}));
            FAIL() << extras << " was accepted";
        } catch (const Error& error) {
            EXPECT_TRUE(error.where().ends_with(std::string("materials[0].extras.") + path)) << extras << "\n"
                                                                                             << error.what();
        }
    }
}

}  // namespace
}  // namespace cutis
