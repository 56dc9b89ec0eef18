// Skin parameters written back into a file: they load again as they were, and nothing else changes.
#include "renderer/scene/skin_writer.h"

#include <gtest/gtest.h>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/scene/gltf.h"
#include "tests/support/process.h"

namespace cutis::test {
namespace {

constexpr const char* kScene =
    R"({"asset":{"version":"2.0","extras":{"kept":1}},"extensionsUsed":["VENDOR_unknown"],)"
    R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
    R"({"attributes":{"POSITION":0},"material":1},{"attributes":{"POSITION":0},"material":2}]}],)"
    R"("materials":[{"name":"unused"},{"name":"face","extras":{"note":"mine"},)"
    R"("extensions":{"VENDOR_unknown":{"a":[1,2]}}},{"name":"shirt"}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],)"
    R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":)"
    R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

class SkinWriter : public testing::Test {
  protected:
    Scene scene() {
        writeFileAtomically(folder_.path() / "in.gltf", std::string(kScene));
        return loadGltf(folder_.path() / "in.gltf");
    }
    std::string textOf(const char* name) {
        const std::vector<std::byte> bytes = readFile(folder_.path() / name);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    TemporaryFolder folder_;
};

TEST_F(SkinWriter, ComesBackAsItWas) {
    Scene changed = scene();
    ASSERT_EQ(changed.materials.size(), 2u);
    changed.materials[0].skin = SkinMaterial{.scale = 0.75, .roughness = 0.25, .translucency = false};
    writeSkinExtras(changed, folder_.path() / "out.gltf");
    const Scene again = loadGltf(folder_.path() / "out.gltf");
    ASSERT_TRUE(again.materials[0].skin.has_value());
    EXPECT_EQ(again.materials[0].skin->scale, 0.75);
    EXPECT_EQ(again.materials[0].skin->roughness, 0.25);
    EXPECT_FALSE(again.materials[0].skin->translucency);
    EXPECT_FALSE(again.materials[1].skin.has_value());
    const std::string text = textOf("out.gltf");
    for (const char* kept : {"\"kept\": 1", "\"note\": \"mine\"", "VENDOR_unknown", "\"unused\""}) {
        EXPECT_NE(text.find(kept), std::string::npos) << kept;
    }
}

TEST_F(SkinWriter, WhatIsNoLongerSkinSaysSo) {
    Scene skin = scene();
    writeSkinExtras(skin, folder_.path() / "out.gltf");  // `face` is skin by its name
    Scene marked = loadGltf(folder_.path() / "out.gltf");
    ASSERT_TRUE(marked.materials[0].skin.has_value());
    marked.materials[0].skin.reset();
    writeSkinExtras(marked, folder_.path() / "none.gltf");
    EXPECT_FALSE(loadGltf(folder_.path() / "none.gltf").materials[0].skin.has_value());
}

// A volume that leaves exp(-1) of red after 2 mm, of green after 1 mm: red falls off over twice the distance.
TEST_F(SkinWriter, HintsAreSkin) {
    std::string text = kScene;
    const std::string unknown = R"("VENDOR_unknown":{"a":[1,2]})";
    text.replace(
        text.find(unknown), unknown.size(),
        R"("KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":0.5},"KHR_materials_volume":)"
        R"({"thicknessFactor":0.01,"attenuationDistance":0.002,)"
        R"("attenuationColor":[0.36787944,0.13533528,0.13533528]})");
    writeFileAtomically(folder_.path() / "hint.gltf", text);
    const Scene scene = loadGltf(folder_.path() / "hint.gltf");
    ASSERT_TRUE(scene.materials[0].skin.has_value());
    EXPECT_FALSE(scene.materials[1].skin.has_value());
    EXPECT_TRUE(scene.materials[0].skin->translucency);
    glm::dvec3 variance(0), total(0);
    for (const skin::Gaussian& g : scene.materials[0].skin->profile.gaussians) {
        variance += g.variance * g.weight, total += g.weight;
    }
    EXPECT_NEAR(total.r, 1, 1e-6);
    EXPECT_NEAR(total.b, 1, 1e-6);
    EXPECT_NEAR(variance.r, 4, 1e-4);  // mm²
    EXPECT_NEAR(variance.g, 1, 1e-4);
}

// With KHR_materials_volume_scatter the falloff is the effective attenuation's. A medium that looks 0.5 grey
// scatters 0.9117 of what it stops: light gets 1/√(3·0.0883) mean free paths; in a white one as far as is
// taken at the most.
TEST_F(SkinWriter, ScatteringIsAHint) {
    const auto varianceOf = [&](const std::string& scatter) {
        std::string text = kScene;
        const std::string unknown = R"("VENDOR_unknown":{"a":[1,2]})";
        text.replace(text.find(unknown), unknown.size(),
                     R"("KHR_materials_volume_scatter":)" + scatter +
                         R"(,"KHR_materials_volume":{"thicknessFactor":0.01,"attenuationDistance":0.001,)"
                         R"("attenuationColor":[0.36787944,0.36787944,0.36787944]})");
        writeFileAtomically(folder_.path() / "in.gltf", text);
        const Scene hinted = loadGltf(folder_.path() / "in.gltf");
        EXPECT_TRUE(hinted.materials[0].skin.has_value());
        glm::dvec3 variance(0);
        for (const skin::Gaussian& g : hinted.materials[0].skin->profile.gaussians)
            variance += g.variance * g.weight;
        return variance;
    };
    const glm::dvec3 grey = varianceOf(R"({"multiscatterColor":[0,0.5,1],"scatterAnisotropy":0})");
    EXPECT_NEAR(grey.r, 1 / 3.0, 1e-3);  // nothing scatters: 1/√3 mean free paths of 1 mm
    EXPECT_NEAR(grey.g, 1 / (3 * 0.0883), 0.01);
    EXPECT_NEAR(grey.b, 100 * 100, 1);  // mm², the longest
    const glm::dvec3 forward =
        varianceOf(R"({"multiscatterColorFactor":[0.5,0.5,0.5],"scatterAnisotropy":0.5})");
    EXPECT_NEAR(forward.g, 1 / (3 * 0.0883 * (0.0883 + 0.9117 * 0.5)), 0.02);
}

// `cutis skin export` of a file with hints: the extras say what the hints did, and the hints are still there.
TEST_F(SkinWriter, HintsComeBackAsExtras) {
    std::string text = kScene;
    const std::string unknown = R"("VENDOR_unknown":{"a":[1,2]})";
    text.replace(text.find(unknown), unknown.size(),
                 unknown + R"(,"KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":0},)"
                           R"("KHR_materials_volume":{"thicknessFactor":0.01,"attenuationDistance":0.002,)"
                           R"("attenuationColor":[0.5,0.2,0.1]})");
    writeFileAtomically(folder_.path() / "in.gltf", text);
    const Scene hinted = loadGltf(folder_.path() / "in.gltf");
    writeSkinExtras(hinted, folder_.path() / "out.gltf");
    const std::string written = textOf("out.gltf");
    for (const char* kept : {"KHR_materials_diffuse_transmission", "\"attenuationDistance\": 0.002",
                             "VENDOR_unknown", "\"note\": \"mine\"", "\"translucency\": false"}) {
        EXPECT_NE(written.find(kept), std::string::npos) << kept;
    }
    const Scene again = loadGltf(folder_.path() / "out.gltf");
    ASSERT_TRUE(again.materials[0].skin.has_value());
    EXPECT_TRUE(again.materials[0].skin->profile == hinted.materials[0].skin->profile);
    EXPECT_FALSE(again.materials[0].skin->translucency);
}

TEST_F(SkinWriter, RefusesAnotherFormat) {
    EXPECT_THROW(writeSkinExtras(scene(), folder_.path() / "out.glb"), Error);
}

}  // namespace
}  // namespace cutis::test
