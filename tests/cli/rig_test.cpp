// cutis rig, as a process.
#include "renderer/scene/rig.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "renderer/scene/gltf.h"
#include "renderer/scene/gltf_writer.h"
#include "renderer/scene/picture.h"
#include "renderer/scene/presets.h"
#include "tests/cli/program.h"

namespace cutis::test {
namespace {

TEST(RigCommand, ListsEveryPreset) {
    const ProcessResult run = runCutis({"rig", "list"});
    expectSuccess(run);
    for (const Preset& preset : presets()) {
        EXPECT_NE(run.out.find(preset.name + ' '), std::string::npos) << preset.name;
        EXPECT_NE(run.out.find(preset.summary + '\n'), std::string::npos) << preset.name;
    }
}

TEST(RigCommand, ShowsPresetsAsRigFiles) {
    for (const Preset& preset : presets()) {
        const ProcessResult run = runCutis({"rig", "show", preset.name});
        expectSuccess(run);
        EXPECT_EQ(parseRig(run.out, preset.name), presetRig(preset.name));
    }
    EXPECT_EQ(runCutis({"rig", "show", "REMBRANDT"}).out, runCutis({"rig", "show", "rembrandt"}).out);
    expectFailure(runCutis({"rig", "show", "rembrant"}), 1, {"'rembrant'", "did you mean 'rembrandt'?"});
}

TEST(RigCommand, ChecksFiles) {
    const TemporaryFolder folder;
    const std::string rig = folder / "a.rig.json";
    writeText(rig, rigToJson(presetRig("three-point")));
    const ProcessResult good = runCutis({"rig", "check", rig});
    expectSuccess(good);
    EXPECT_NE(good.out.find("3 lights"), std::string::npos) << good.out;

    writeText(
        rig,
        R"({"cutis_rig": 1, "lights": [{"type": "point", "position": [0, 0, 0], "color": [1, 1, -1]}]})");
    expectFailure(runCutis({"rig", "check", rig}), 1, {"lights[0].color[2] is -1", rig});
    writeText(rig, R"({"cutis_rig": 1, "lihgts": []})");
    expectFailure(runCutis({"rig", "check", rig}), 1, {"'lihgts'", "did you mean 'lights'?", rig});
    writeText(rig, R"({"cutis_rig": 1, "environment": {"file": "missing.exr"}})");
    expectFailure(runCutis({"rig", "check", rig}), 1, {"missing.exr"});
    expectFailure(runCutis({"rig", "check", folder / "missing.rig.json"}), 1,
                  {"no such file", "missing.rig.json"});
    expectFailure(runCutis({"rig", "check", folder.path()}), 1, {"not a regular file"});
}

TEST(RigCommand, ChecksSubjectsAgainstAScene) {
    const TemporaryFolder folder;
    writeGlb(twoHeads(), folder / "heads.glb");
    Rig rig = presetRig("single");
    rig.lights[0].place->subject = "Anna";
    saveRig(rig, folder / "a.rig.json");
    expectSuccess(runCutis({"rig", "check", folder / "a.rig.json", "--scene", folder / "heads.glb"}));
    rig.lights[0].place->subject = "Carla";
    saveRig(rig, folder / "a.rig.json");
    expectFailure(runCutis({"rig", "check", folder / "a.rig.json", "--scene", folder / "heads.glb"}), 1,
                  {"Carla", "Anna", "Ben"});
}

// preset → glTF lights → rig → glTF lights: the lights stay where they are and as bright as they are.
TEST(RigCommand, ExportsToGltfAndBack) {
    const TemporaryFolder folder;
    writeGlb(twoHeads(), folder / "heads.glb");
    const ProcessResult out =
        runCutis({"rig", "export", "rim", "--scene", folder / "heads.glb", "-o", folder / "lights.glb"});
    EXPECT_EQ(out.status, 0);
    EXPECT_NE(out.err.find("cutis: warning: 1 rect light is written as spots"), std::string::npos) << out.err;
    const Scene lights = loadGltf(folder / "lights.glb");
    ASSERT_EQ(lights.lights.size(), 3u);

    expectSuccess(runCutis({"rig", "export", folder / "lights.glb", "-o", folder / "back.rig.json"}));
    const Rig back = loadRig(folder / "back.rig.json");
    EXPECT_EQ(back.lights, lights.lights);

    Rig rim = presetRig("rim");
    resolvePlacements(rim, twoHeads());
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(back.lights[i].name, rim.lights[i].name);
        EXPECT_EQ(back.lights[i].type, LightType::spot);
        // Positions pass through single precision.
        EXPECT_NEAR(glm::distance(back.lights[i].position, rim.lights[i].position), 0, 1e-6);
        EXPECT_NEAR(glm::distance(back.lights[i].direction, rim.lights[i].direction), 0, 1e-6);
    }
}

TEST(RigCommand, ExportSaysWhatItNeeds) {
    const TemporaryFolder folder;
    writeGlb(twoHeads(), folder / "heads.glb");
    expectFailure(runCutis({"rig", "export", "rim", "-o", folder / "a.glb"}), 1, {"rim left", "--scene"});
    expectFailure(runCutis({"rig", "export", folder / "heads.glb", "-o", folder / "a.rig.json"}), 1,
                  {"the scene has no lights"});
    expectFailure(runCutis({"rig", "export", "rim", "-o", folder / "missing/a.rig.json"}), 1,
                  {"no such folder", "missing"});
    EXPECT_EQ(filesIn(folder.path()), std::vector<std::string>{"heads.glb"});
}

}  // namespace
}  // namespace cutis::test
