// --animation, --time and --frames.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "renderer/scene/gltf_writer.h"
#include "renderer/scene/picture.h"
#include "tests/cli/program.h"
#include "tests/support/pictures.h"
#include "tests/support/walking_body.h"

namespace cutis::test {
namespace {

class Frames : public testing::Test {
  protected:
    ProcessResult cutis(const std::string& command, std::vector<std::string> options) const {
        std::vector<std::string> arguments = {command,    scene_,  "--size",   "48x32",
                                              "--device", "cpu",   "--camera", "orbit:0,0.5,0.3,60,10,3,30",
                                              "--rig",    "single"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return runCutis(arguments);
    }
    Picture read(const std::string& name) const { return readPicture(folder_ / name); }

    TemporaryFolder folder_;
    std::string scene_ = writeWalkingBody(folder_.path()).string();
};

// Frame 6 of a range is what --time 6/24 shows, and the files are named for their frames.
TEST_F(Frames, ARangeIsOneFileAFrame) {
    expectSuccess(cutis("render", {"--animation", "walk", "--frames", "5-6", "-o", folder_ / "f.%04d.exr",
                                   "--aov", "depth", "--stats", folder_ / "s.%d.json"}));
    const std::vector<std::string> expected = {"f.0005.depth.exr", "f.0005.exr", "f.0006.depth.exr",
                                               "f.0006.exr",       "s.5.json",   "s.6.json",
                                               "walker.glb"};
    EXPECT_EQ(filesIn(folder_.path()), expected);
    expectSuccess(cutis("render", {"--time", "0.25", "-o", folder_ / "one.exr", "--aov", "depth"}));
    EXPECT_LE(worstDifference(read("f.0006.depth.exr"), read("one.depth.exr")), 1e-5);
    EXPECT_GT(worstDifference(read("f.0005.depth.exr"), read("f.0006.depth.exr")), 1e-3);
    const auto stats = nlohmann::json::parse(readText(folder_ / "s.6.json"));
    EXPECT_EQ(stats.at("nonfinite"), 0);
}

TEST_F(Frames, RendererAndReferencePoseAlike) {
    for (const char* command : {"render", "reference"}) {
        std::vector<std::string> options = {
            "--animation", "0",        "--time", "0.75",
            "--aov",       "position", "-o",     folder_ / (std::string(command) + ".exr")};
        if (command == std::string("reference")) options.insert(options.end(), {"--budget", "1s"});
        const ProcessResult run = cutis(command, options);
        EXPECT_EQ(run.status, 0) << run.err;
    }
    // Silhouettes are antialiased otherwise; within them the surface is one.
    const Picture a = read("render.position.exr"), b = read("reference.position.exr");
    int same = 0, both = 0;
    for (std::size_t i = 0; i + 2 < a.values.size(); i += std::size_t(a.channels)) {
        double d = 0, size = 0;
        for (int c = 0; c < 3; ++c)
            d += std::abs(a.values[i + c] - b.values[i + c]), size += std::abs(a.values[i + c]);
        both += size > 0;
        same += size > 0 && d < 0.02;
    }
    EXPECT_GT(both, 300);
    EXPECT_GT(same, 0.8 * both);
}

TEST_F(Frames, WhatCannotBeIsOneLine) {
    const std::string out = folder_ / "o.%04d.exr";
    expectFailure(cutis("render", {"--animation", "wlak", "-o", folder_ / "o.exr"}), 1,
                  {"no animation 'wlak'", "did you mean 'walk'", "walker.glb"});
    expectFailure(cutis("render", {"--animation", "1", "-o", folder_ / "o.exr"}), 1, {"there are 'walk'"});
    expectFailure(cutis("render", {"--frames", "9-3", "-o", out}), 2, {"--frames", "in order"});
    expectFailure(cutis("render", {"--frames", "1-", "-o", out}), 2, {"--frames", "A-B"});
    expectFailure(cutis("render", {"--frames", "1-2", "-o", folder_ / "o.exr"}), 2,
                  {"needs a place for the frame's number"});
    expectFailure(cutis("render", {"--frames", "1-2", "-o", out, "--stats", folder_ / "s.json"}), 2,
                  {"s.json"});
    expectFailure(cutis("render", {"--frames", "1-2", "--time", "1", "-o", out}), 2, {"--frames and --time"});
    expectFailure(cutis("render", {"--fps", "25", "-o", folder_ / "o.exr"}), 2, {"--fps"});
    expectFailure(cutis("plan", {"--frames", "1-2"}), 2, {"--frames"});
    const std::string still = folder_ / "still.glb";
    writeGlb(twoHeads(), still);
    expectFailure(runCutis({"render", still, "--time", "1", "-o", folder_ / "o.exr"}), 1,
                  {"cannot use --time", "no animation", "still.glb"});
    expectFailure(runCutis({"render", still, "--animation", "walk", "-o", folder_ / "o.exr"}), 1,
                  {"the scene has none"});
    EXPECT_EQ(filesIn(folder_.path()), (std::vector<std::string>{"still.glb", "walker.glb"}));
}

}  // namespace
}  // namespace cutis::test
