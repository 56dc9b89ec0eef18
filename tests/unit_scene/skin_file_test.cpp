// Files that say which materials are skin: they come back as they were, and name what is wrong in them.
#include "renderer/scene/skin_file.h"

#include <gtest/gtest.h>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "tests/support/process.h"

namespace cutis::test {
namespace {

Scene threeMaterials() {
    Scene scene;
    for (const char* name : {"face", "shirt", "face"}) scene.materials.emplace_back().name = name;
    scene.materials[1].skin = SkinMaterial{};
    return scene;
}

class SkinFile : public testing::Test {
  protected:
    std::vector<std::optional<SkinMaterial>> load(const std::string& text) {
        writeFileAtomically(file_, text);
        return loadSkinFile(file_, scene_);
    }
    // What loading the text says is wrong.
    std::string refused(const std::string& text) {
        try {
            load(text);
        } catch (const Error& error) {
            return error.what();
        }
        return "nothing";
    }
    TemporaryFolder folder_;
    std::string file_ = folder_ / "look.skin.json";
    Scene scene_ = threeMaterials();
};

TEST_F(SkinFile, ComesBackAsItWas) {
    SkinMaterial other;
    other.scale = 0.7;
    other.profile.gaussians.pop_back();
    other.translucency = false;
    const std::vector<std::optional<SkinMaterial>> skin{std::nullopt, other, SkinMaterial{}};
    const auto loaded = load(skinFileText(skin, scene_));
    ASSERT_EQ(loaded.size(), 3u);
    EXPECT_FALSE(loaded[0]);
    ASSERT_TRUE(loaded[1] && loaded[2]);
    EXPECT_EQ(loaded[1]->scale, 0.7);
    EXPECT_EQ(loaded[1]->profile, other.profile);
    EXPECT_FALSE(loaded[1]->translucency);
    EXPECT_EQ(loaded[2]->scale, 1);
    EXPECT_EQ(loaded[2]->profile, skin::threeLayerProfile());
}

TEST_F(SkinFile, WhatItDoesNotNameStays) {
    const auto loaded = load(R"({"cutis_skin": 1, "materials": [{"name": "face", "skin": {"mix": 0.25}}]})");
    ASSERT_TRUE(loaded[0]);
    EXPECT_EQ(loaded[0]->mix, 0.25);
    EXPECT_TRUE(loaded[1]);
    EXPECT_FALSE(loaded[2]) << "one entry is one material";
}

TEST_F(SkinFile, SaysWhatIsWrong) {
    EXPECT_NE(refused("{").find("not JSON"), std::string::npos);
    EXPECT_NE(refused(R"({"materials": []})").find("cutis_skin"), std::string::npos);
    EXPECT_NE(refused(R"({"cutis_skin": 2, "materials": []})").find("must be 1"), std::string::npos);
    const std::string unknown = R"({"cutis_skin": 1, "materials": [{"name": "fase", "skin": true}]})";
    EXPECT_NE(refused(unknown).find("face"), std::string::npos) << refused(unknown);
    EXPECT_NE(
        refused(R"({"cutis_skin": 1, "materials": [{"name": "face", "skin": {"scale": -1}}]})").find("scale"),
        std::string::npos);
    EXPECT_NE(
        refused(R"({"cutis_skin": 1, "materials": [{"name": "face", "skin": true, "x": 1}]})").find("x"),
        std::string::npos);
}

}  // namespace
}  // namespace cutis::test
