// cutis reference as a process: files, messages, statuses. Its numbers are tested in tests/reference.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "renderer/scene/gltf_writer.h"
#include "renderer/scene/picture.h"
#include "tests/cli/program.h"

namespace cutis::test {
namespace {

class Reference : public testing::Test {
  protected:
    Reference() { writeGlb(twoHeads(), scene_); }

    TemporaryFolder folder_;
    std::string scene_ = folder_ / "heads.glb";
    std::string cache_ = folder_ / "cache";
    EnvironmentVariables ownCache_ = {{"CUTIS_CACHE_DIR", cache_}};
};

TEST_F(Reference, WritesAllThatIsAskedFor) {
    const ProcessResult run =
        runCutis({"reference", scene_, "--size", "32x18", "-o", folder_ / "a.exr", "-o", folder_ / "a.png",
                  "--halves", "--aov", "stderr,depth", "--error", "10%", "--stats", folder_ / "a.json"},
                 ownCache_);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out.find("standard error "), 0u) << run.out;
    const std::vector<std::string> expected = {"a.a.diffuse.exr", "a.a.exr", "a.b.diffuse.exr", "a.b.exr",
                                               "a.depth.exr",     "a.exr",   "a.json",          "a.png",
                                               "a.stderr.exr",    "cache",   "heads.glb"};
    EXPECT_EQ(filesIn(folder_.path()), expected);
    EXPECT_EQ(readPicture(folder_ / "a.stderr.exr").width, 32);
    const auto stats = nlohmann::json::parse(readText(folder_ / "a.json"));
    EXPECT_GT(stats.at("picture_error"), 0);
    EXPECT_LE(stats.at("picture_error"), 0.1);
    EXPECT_EQ(stats.at("nonfinite"), 0);
    EXPECT_EQ(stats.at("characters"), 2);
}

TEST_F(Reference, StopsWithItsStateWhenInterrupted) {
    // In the foreground timeout signals its child once; else once more as a member of its group, and a second interruption
    // ends the program at once.
    const ProcessResult run =
        runProcess({"/usr/bin/timeout", "--foreground", "--preserve-status", "-s", "INT", "6", CUTIS_PROGRAM, "reference",
                    scene_, "--size", "16x9", "-o", folder_ / "a.exr", "--budget", "1h"},
                   ownCache_);
    EXPECT_EQ(run.status, 130);
    EXPECT_NE(run.err.find("cutis: warning: interrupted after "), std::string::npos) << run.err;
    const std::vector<std::string> expected = {"cache", "heads.glb"};
    EXPECT_EQ(filesIn(folder_.path()), expected);
    EXPECT_EQ(filesIn(cache_).size(), 1u);
}

TEST_F(Reference, WrongOptions) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> table = {
        {{"--error", "0"}, "--error is '0'"},          {{"--error", "-1%"}, "--error is '-1%'"},
        {{"--error", "200%"}, "--error is '200%'"},    {{"--error", "%"}, "--error is '%'"},
        {{"--budget", "0s"}, "--budget is '0s'"},      {{"--budget", "s"}, "--budget is 's'"},
        {{"--budget", "soon"}, "--budget is 'soon'"},  {{"--aov", "stdder"}, "did you mean 'stderr'?"},
        {{"--halves=yes"}, "--halves takes no value"}, {{"--halves", "--stats", "a.b.exr"}, "two results"}};
    for (const auto& [options, part] : table) {
        std::vector<std::string> arguments = {"reference", "missing.glb", "-o", "a.exr"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        expectFailure(runCutis(arguments), 2, {part, "see cutis reference --help"});
    }
    expectFailure(runCutis({"render", "missing.glb", "-o", "a.exr", "--error", "1%"}), 2, {"--error"});
}

}  // namespace
}  // namespace cutis::test
