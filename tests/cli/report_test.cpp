// cutis compare and cutis measure: a folder of results that is complete, and never somebody else's.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "renderer/scene/gltf_writer.h"
#include "tests/cli/program.h"

namespace cutis::test {
namespace {

using Json = nlohmann::json;

class Report : public testing::Test {
  protected:
    Report() { writeGlb(twoHeads(), scene_); }

    ProcessResult run(const std::string& command, std::vector<std::string> options) const {
        std::vector<std::string> arguments = {command, scene_, "--size", "64x36", "--device", "cpu"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return runCutis(arguments);
    }

    TemporaryFolder folder_;
    std::string scene_ = folder_ / "heads.glb", out_ = folder_ / "out";
};

TEST_F(Report, CompareShowsEachLightAlone) {
    expectSuccess(run("compare", {"--rig", "three-point", "-o", out_}));
    const Json json = Json::parse(readText(out_ + "/compare.json"));
    EXPECT_EQ(json["base"], "all");
    ASSERT_EQ(json["pictures"].size(), 3u);
    double light = 0;
    for (const Json& picture : json["pictures"]) light += picture["light_ratio"].get<double>();
    EXPECT_NEAR(light, 1, 0.02) << "the lights do not add up";
    const std::vector<std::string> files = filesIn(out_);
    EXPECT_TRUE(std::count(files.begin(), files.end(), "index.html"));
    EXPECT_TRUE(std::count(files.begin(), files.end(), "key-flip.png"));
    // An earlier report may be written over.
    expectSuccess(run("compare", {"--a", "rim", "--b", "split", "-o", out_}));
    EXPECT_EQ(Json::parse(readText(out_ + "/compare.json"))["pictures"].size(), 1u);
}

TEST_F(Report, NothingElseIsWrittenOver) {
    writeText(folder_ / "precious.txt", "mine");
    expectFailure(run("compare", {"-o", folder_.path()}), 1, {"cannot write report", "holds other files"});
    expectFailure(run("measure", {"-o", scene_}), 1, {"cannot write report", "not a folder"});
    expectFailure(run("measure", {"-o", folder_ / "no" / "such"}), 1, {"cannot write report"});
}

TEST_F(Report, MistakesAreUsageErrors) {
    expectFailure(run("compare", {"--a", "rim", "-o", out_}), 2, {"--a and --b"});
    expectFailure(run("compare", {"--a", "rim", "--b", "split", "--rig", "loop", "-o", out_}), 2, {"--rig"});
    expectFailure(run("measure", {"--repeats", "0", "-o", out_}), 2, {"--repeats"});
    expectFailure(run("measure", {"--tolerance", "-1%", "-o", out_}), 2, {"--tolerance"});
    expectFailure(run("measure", {"--sweep", "nonsense", "-o", out_}), 1, {"nonsense"});
}

TEST_F(Report, MeasureHasARowForEverySettingAndGoesOnAfterAFailure) {
    const std::string sweep = folder_ / "sweep.json";
    writeText(sweep, R"({"cutis_sweep":1,"settings":[{"name":"default"},{"name":"one gaussian","gaussians":1},
                        {"name":"too small","irradiance_size":8,"characters":64}]})");
    const ProcessResult result =
        run("measure", {"--sweep", sweep, "--budget", "1s", "--repeats", "1", "--tolerance", "90%", "-o", out_});
    EXPECT_EQ(result.status, 0) << result.err;
    const Json json = Json::parse(readText(out_ + "/measure.json"));
    ASSERT_EQ(json["settings"].size(), 3u);
    EXPECT_GT(json["settings"][0]["gpu_ms"].get<double>(), 0);
    EXPECT_GT(json["settings"][1]["diffuse_rel_l2"].get<double>(), json["settings"][0]["diffuse_rel_l2"].get<double>());
    EXPECT_TRUE(json["settings"][2].contains("failure")) << json["settings"][2];
    EXPECT_TRUE(json["cheapest_within_tolerance"].is_string());
    for (const char* name : {"index.html", "measure.csv", "measure.svg", "measure.png", "pictures", "errors"})
        EXPECT_TRUE(std::filesystem::exists(out_ + "/" + name)) << name;
}

// What measure found of a scene is what render goes by; of another scene it knows what holds for the default one.
TEST_F(Report, RenderTakesTheCheapestSettingThatWasMeasuredWithinATolerance) {
    const std::string sweep = folder_ / "sweep.json", picture = folder_ / "picture.exr", stats = folder_ / "stats.json";
    writeText(sweep, R"({"cutis_sweep":1,"settings":[{"name":"two","gaussians":2,"irradiance_size":128}]})");
    const auto renderWithin = [&](const char* tolerance, const char* rig) {
        return run("render", {"--tolerance", tolerance, "--rig", rig, "--stats", stats, "-o", picture});
    };
    const ProcessResult measured =
        run("measure", {"--sweep", sweep, "--rig", "loop", "--budget", "1s", "--repeats", "1", "-o", out_});
    ASSERT_EQ(measured.status, 0) << measured.err;
    const ProcessResult rendered = renderWithin("100%", "loop");
    EXPECT_EQ(rendered.status, 0) << rendered.err;
    EXPECT_NE(rendered.err.find("taking 'two', measured on this scene at 64x36"), std::string::npos) << rendered.err;
    EXPECT_EQ(Json::parse(readText(stats))["gaussians"], 2);
    EXPECT_EQ(Json::parse(readText(stats))["atlas"]["width"], 128);
    expectFailure(renderWithin("0.001%", "loop"), 1, {"no setting is within 0.001 %", "'two'", "--tolerance"});
    // Another light is another measurement.
    const ProcessResult other = renderWithin("100%", "split");
    EXPECT_EQ(other.status, 0) << other.err;
    EXPECT_NE(other.err.find("measured on the default scene"), std::string::npos) << other.err;
}

}  // namespace
}  // namespace cutis::test
