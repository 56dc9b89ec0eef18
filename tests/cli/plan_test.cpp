// cutis plan, as a process.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "renderer/scene/gltf_writer.h"
#include "tests/cli/program.h"

namespace cutis::test {
namespace {

using Json = nlohmann::json;

class PlanCommand : public testing::Test {
  protected:
    PlanCommand() { writeGlb(twoHeads(), scene_); }

    ProcessResult plan(std::vector<std::string> options) const {
        std::vector<std::string> arguments = {"plan", scene_, "--size", "64x36", "--rig", "single", "--device", "cpu"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return runCutis(arguments, {{"CUTIS_VALIDATION", "1"}});
    }
    Json json(std::vector<std::string> options) const {
        options.push_back("--json");
        const ProcessResult run = plan(options);
        expectSuccess(run);
        return Json::parse(run.out);
    }
    static Json row(const Json& plan, const std::string& name) {
        for (const Json& row : plan.at("rows")) {
            if (row.at("name") == name) return row;
        }
        ADD_FAILURE() << "no row " << name;
        return {};
    }

    TemporaryFolder folder_;
    std::string scene_ = folder_ / "heads.glb";
};

TEST_F(PlanCommand, ListsRowsWithReasonsAndBytes) {
    const ProcessResult run = plan({});
    expectSuccess(run);
    for (const char* text : {"before the frame", "light_maps", "no environment", "GPU memory"}) {
        EXPECT_NE(run.out.find(text), std::string::npos) << text << " is not in " << run.out;
    }
    const Json pruned = json({});
    for (const Json& row : pruned.at("rows")) EXPECT_FALSE(row.at("reason").get<std::string>().empty()) << row;
    EXPECT_TRUE(row(pruned, "diffusion").at("on"));
    // Levels of RGBA float texels at most, and not none.
    EXPECT_GT(row(pruned, "diffusion").at("bytes"), 1000);
    EXPECT_TRUE(row(pruned, "diffusion").at("ms").is_null());
    EXPECT_FALSE(row(pruned, "environment_visibility").at("on"));
    EXPECT_EQ(row(pruned, "environment_visibility").at("reason"), "no environment");
    EXPECT_FALSE(row(pruned, "transparency").at("on"));
    EXPECT_TRUE(filesIn(folder_.path()) == std::vector<std::string>{"heads.glb"});
}

TEST_F(PlanCommand, BeginsWithTheKeysOfStats) {
    using OrderedJson = nlohmann::ordered_json;
    const OrderedJson plan = OrderedJson::parse(json({}).dump());
    std::set<std::string> keys;
    for (const auto& [key, value] : plan.items()) keys.insert(key);
    EXPECT_EQ(keys, (std::set<std::string>{"device", "passes", "left_out", "atlas", "lights", "light_samples",
                                           "characters", "gaussians", "bytes_gpu", "nonfinite", "load_ms", "frame_ms",
                                           "rows"}));
}

TEST_F(PlanCommand, MeasuresAndRunsEverything) {
    const Json measured = json({"--measure"});
    for (const Json& row : measured.at("rows")) {
        const bool ran = row.at("when") == "frame" && row.at("on") == true;
        EXPECT_TRUE(!ran || row.at("ms") > 0) << row;
    }
    EXPECT_GT(measured.at("frame_ms"), 0);
    const Json all = json({"--no-prune"});
    EXPECT_TRUE(row(all, "environment_visibility").at("on"));
    EXPECT_GT(all.at("bytes_gpu"), measured.at("bytes_gpu"));
}

}  // namespace
}  // namespace cutis::test
