// cutis render and cutis devices, as processes: files, messages, statuses. What the pictures show is tested
// elsewhere.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "renderer/scene/gltf_writer.h"
#include "renderer/scene/picture.h"
#include "renderer/scene/presets.h"
#include "renderer/scene/rig.h"
#include "tests/cli/program.h"

namespace cutis::test {
namespace {

using Json = nlohmann::json;

class Render : public testing::Test {
  protected:
    Render() { writeGlb(twoHeads(), scene_); }

    ProcessResult render(std::vector<std::string> options, const EnvironmentVariables& extra = {}) const {
        std::vector<std::string> arguments = {"render", scene_, "--size", "64x36", "--device", "cpu"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return runCutis(arguments, extra);
    }
    Json statsOf(std::vector<std::string> options) const {
        options.insert(options.end(), {"-o", folder_ / "s.exr", "--stats", folder_ / "s.json"});
        expectSuccess(render(options));
        return Json::parse(readText(folder_ / "s.json"));
    }

    TemporaryFolder folder_;
    std::string scene_ = folder_ / "heads.glb";
};

TEST_F(Render, WritesAllThatIsAskedFor) {
    expectSuccess(render({"-o", folder_ / "a.exr", "-o", folder_ / "b.png", "--aov", "depth,normal",
                          "--stats", folder_ / "a.json"}));
    const std::vector<std::string> expected = {"a.depth.exr",  "a.exr", "a.json",
                                               "a.normal.exr", "b.png", "heads.glb"};
    EXPECT_EQ(filesIn(folder_.path()), expected);
    for (const char* name : {"a.exr", "b.png", "a.depth.exr", "a.normal.exr"}) {
        const Picture picture = readPicture(folder_ / name);
        EXPECT_EQ(picture.width, 64) << name;
        EXPECT_EQ(picture.height, 36) << name;
    }
}

TEST_F(Render, StatsHaveExactlyTheirKeys) {
    const Json stats = statsOf({});
    const auto keysOf = [](const Json& object) {
        std::set<std::string> keys;
        for (const auto& [key, value] : object.items()) keys.insert(key);
        return keys;
    };
    using Keys = std::set<std::string>;
    EXPECT_EQ(keysOf(stats),
              (Keys{"device", "passes", "left_out", "atlas", "lights", "light_samples", "characters",
                    "gaussians", "bytes_gpu", "nonfinite", "load_ms", "frame_ms", "timeline"}));
    EXPECT_EQ(keysOf(stats["atlas"]), (Keys{"width", "height", "texels_covered", "texels_lit", "mm_per_texel"}));
    ASSERT_FALSE(stats["passes"].empty());
    for (const Json& pass : stats["passes"])
        EXPECT_EQ(keysOf(pass), (Keys{"name", "runs", "gpu_ms", "reason"}));
    ASSERT_FALSE(stats["left_out"].empty());
    for (const Json& left : stats["left_out"]) EXPECT_EQ(keysOf(left), (Keys{"name", "reason"}));
    EXPECT_EQ(stats["characters"], 2);
    EXPECT_EQ(stats["nonfinite"], 0);
    EXPECT_GT(stats["load_ms"], 0);
    EXPECT_GT(stats["frame_ms"], 0);
    std::set<std::string> spans;
    for (const Json& span : stats["timeline"]) {
        EXPECT_EQ(keysOf(span), (Keys{"name", "from_ms", "to_ms"}));
        EXPECT_GE(span["from_ms"], 0);
        EXPECT_GE(span["to_ms"], span["from_ms"]);
        spans.insert(span["name"]);
    }
    for (const char* name : {"libraries", "device", "scene", "geometry", "surface", "uploads", "frame", "writing"})
        EXPECT_TRUE(spans.contains(name)) << name;
    EXPECT_GT(stats["bytes_gpu"], 0);
}

// Which rig lights the picture, seen by its count of lights.
TEST_F(Render, ChoosesTheRig) {
    EXPECT_EQ(statsOf({})["lights"], 3) << "three-point";
    EXPECT_EQ(statsOf({"--rig", "single"})["lights"], 1);
    EXPECT_EQ(statsOf({"--rig", "none"})["lights"], 0);
    EXPECT_EQ(statsOf({"--rig", "three-point", "--light", "fill", "--light", "rim"})["lights"], 2);
    Rig beside = presetRig("clamshell");
    beside.lights[0].enabled = false;
    saveRig(beside, folder_ / "heads.rig.json");
    EXPECT_EQ(statsOf({})["lights"], 1) << "heads.rig.json, its key off";
    EXPECT_EQ(statsOf({"--light", "key", "--light", "reflector"})["lights"], 2) << "named lights are on";
    Scene lit = twoHeads();
    Node node;
    node.name = "bulb";
    node.light = 0;
    node.local[3] = {0, 0, 2, 1};
    lit.nodes.push_back(node);
    lit.lights.emplace_back().name = "bulb";
    writeGlb(lit, scene_);
    EXPECT_EQ(statsOf({})["lights"], 1) << "the scene's own";
    EXPECT_EQ(statsOf({"--rig", "scene", "--light", "bulb"})["lights"], 1);
    EXPECT_EQ(statsOf({"--rig", "rim"})["lights"], 3);
}

TEST_F(Render, RefusesInOneLine) {
    const std::string out = folder_ / "a.exr", missing = folder_ / "missing/a.exr";
    writeText(folder_ / "bad.rig.json",
              R"({"cutis_rig": 1, "lights": [{"type": "spot", "place": {"elevation": 95}}]})");
    writeText(folder_ / "env.rig.json", R"({"cutis_rig": 1, "environment": {"file": "sky.exr"}})");
    const struct {
        std::vector<std::string> options, parts;
    } table[] = {
        {{"-o", missing}, {"no such folder", "missing"}},
        {{"-o", out, "--stats", folder_ / "missing/s.json"}, {"no such folder", "missing"}},
        {{"-o", out, "--device", "no such gpu"}, {"no such gpu"}},
        {{"-o", out, "--rig", "three-pont"}, {"'three-pont'", "did you mean 'three-point'?"}},
        {{"-o", out, "--rig", folder_ / "none.rig.json"}, {"no such file", "none.rig.json"}},
        {{"-o", out, "--rig", folder_ / "bad.rig.json"}, {"lights[0].place.elevation is 95", "bad.rig.json"}},
        {{"-o", out, "--rig", folder_ / "env.rig.json"}, {(folder_ / "sky.exr").string()}},
        {{"-o", out, "--rig", "scene"}, {"the scene has no lights"}},
        {{"-o", out, "--light", "keys"}, {"'keys'", "did you mean 'key'?", "key, fill, rim"}},
        {{"-o", out, "--env", folder_ / "sky.hdr"}, {"sky.hdr"}},
        {{"-o", out, "--camera", "nobody"}, {"nobody"}},
        {{"-o", out, "--skin", "leather*"}, {"leather*"}},
    };
    for (const auto& row : table) {
        std::vector<std::string> options = row.options;
        const bool device = std::find(options.begin(), options.end(), "--device") != options.end();
        std::vector<std::string> arguments = {"render", scene_};
        if (!device) arguments.insert(arguments.end(), {"--device", "cpu"});
        arguments.insert(arguments.end(), options.begin(), options.end());
        expectFailure(runCutis(arguments), 1, row.parts);
    }
    expectFailure(runCutis({"render", folder_ / "no.glb", "-o", out}), 1, {"no such file", "no.glb"});
    EXPECT_EQ(filesIn(folder_.path()),
              (std::vector<std::string>{"bad.rig.json", "env.rig.json", "heads.glb"}));
}

// A map of each of 4096 samples for each of two heads, where an image of the software device has 2048 layers.
TEST_F(Render, SaysHowManySamplesWouldFit) {
    Rig rig;
    Light& light = rig.lights.emplace_back();
    light.name = "wall";
    light.type = LightType::rect;
    light.position = {0, 0, 2};
    light.size = {1, 1};
    light.samples = 4096;
    saveRig(rig, folder_ / "wall.rig.json");
    expectFailure(render({"--rig", folder_ / "wall.rig.json", "-o", folder_ / "a.exr"}), 1,
                  {"cannot light the scene", "8192 light maps", "1024 samples would fit"});
}

TEST_F(Render, NeverReplacesItsInputs) {
    const std::string sky = folder_ / "sky.exr";
    writeExr(sky, {2, 1, 3, {1, 1, 1, 1, 1, 1}});
    expectFailure(render({"--env", sky, "-o", sky}), 1, {"input", "sky.exr"});
    EXPECT_EQ(readPicture(sky).width, 2);
}

TEST_F(Render, DefaultSceneIsFoundInTheDataFolder) {
    const EnvironmentVariables data = {{"CUTIS_DATA_DIR", folder_ / "data"}};
    expectFailure(runCutis({"render", "default", "-o", folder_ / "a.exr"}, data), 1,
                  {"no default scene", "default.gltf"});
}

// Ctrl-C in the middle of the work: status 130, silence, and nothing left behind.
TEST_F(Render, EndsCleanlyOnInterrupt) {
    Rig slow;
    Light& light = slow.lights.emplace_back();
    light.type = LightType::rect;
    light.size = {1, 1};
    light.samples = 900;  // on 16 million texels: far more than a second's work
    light.place = Placement{};
    saveRig(slow, folder_ / "slow.rig.json");
    const ProcessResult run = runProcess(
        {"/usr/bin/timeout", "--preserve-status", "-s", "INT", "1", CUTIS_PROGRAM, "render", scene_, "--rig",
         folder_ / "slow.rig.json", "--irradiance-size", "4096", "--device", "cpu", "-o", folder_ / "a.exr"},
        {{"CUTIS_CACHE_DIR", CUTIS_TEST_CACHE_DIR}}, 60);
    EXPECT_EQ(run.status, 130);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err, "");
    EXPECT_EQ(filesIn(folder_.path()), (std::vector<std::string>{"heads.glb", "slow.rig.json"}));
}

TEST(Devices, ListsWhatThereIs) {
    const ProcessResult run = runCutis({"devices"});
    expectSuccess(run);
    EXPECT_NE(run.out.find("llvmpipe"), std::string::npos) << run.out;
    EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '*'), 1) << run.out;  // one is the default
}

TEST(Output, FullDiskIsAnError) {
    const ProcessResult run =
        runProcess({"/bin/sh", "-c", std::string(CUTIS_PROGRAM) + " rig list > /dev/full"});
    expectFailure(run, 1, {"standard output"});
}

}  // namespace
}  // namespace cutis::test
