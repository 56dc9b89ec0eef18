// The cases that make sense for any scene, `cutis measure --sweep stability`, on two bodies in one run of the
// program.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "extreme.h"
#include "renderer/measure/stability.h"
#include "renderer/scene/gltf_writer.h"
#include "tests/support/pictures.h"
#include "tests/support/process.h"

namespace cutis::test {
namespace {

using Json = nlohmann::json;

constexpr double kTimeout = 550;  // seconds, of a machine that has much else to do: it works for 30

// How far a case may be off in pictures of 16 x 16, most of whose error is at the rim: 1.3 times what it is.
// References go by their standard error, not by time, so the figures are the same on any machine.
struct Limit {
    double drift, error;
};

Limit limitOf(const std::string& name) {
    // Most of its light never comes back: what is seen are highlights.
    if (name == "profile 1000 times as wide") return {0.0055, 0.07};
    // Its light falls within a texel.
    if (name == "a bulb 1 mm before the skin") return {0.41, 0.91};
    if (name == "a bulb in the skin") return {0, 0};
    // A highlight far below a pixel, which nine samples of it meet or do not.
    if (name == "roughness 0.01, specular 1") return {0.097, 1.19};
    if (name == "roughness 0.01, specular 4") return {0.38, 4.6};
    // Nothing but highlights.
    if (name.starts_with("black")) return {0.016, 0.2};
    if (name == "512 lights") return {0.022, 0.088};
    if (name == "a sun of 1e9 beside 1e-6") return {0.017, 0.06};
    return {0.0055, 0.056};
}

TEST(Sweep, EveryCaseHolds) {
    const TemporaryFolder folder("cutis-sweep");
    SceneBuilder builder;
    builder.addObject("body", sphere(50 * kMm, SphereMapping::cube),
                      builder.addSkin(SkinMaterial(), {0.8, 0.6, 0.5}));
    builder.setOrthographicCamera({0, 0, 0.5}, {0, 0, 0}, 0.11);
    writeGlb(builder.scene(), folder / "scene.glb");
    writeExr(folder / "sky.exr",
             makeEnvironment(16, 8, [](const glm::dvec3& w) { return glm::dvec3(1 + w.y); }));
    std::ofstream(folder / "test.rig.json") << R"({"cutis_rig": 1, "environment": {"file": "sky.exr"},
        "lights": [{"type": "directional", "direction": [0.5, -0.5, -1], "intensity": 2},
                   {"type": "point", "position": [-0.4, 0.1, 0.3], "intensity": 0.2}]})";
    const ProcessResult run =
        runProcess({CUTIS_PROGRAM, "measure", folder / "scene.glb", "--rig", folder / "test.rig.json",
                    "--sweep", "stability", "--size", "16x16", "--error", "4%", "--repeats", "1", "--device",
                    "cpu", "-o", folder / "out"},
                   {{"CUTIS_CACHE_DIR", CUTIS_TEST_CACHE_DIR}}, kTimeout);
    ASSERT_EQ(run.status, 0) << run.err;
    std::printf("%s", run.out.c_str());
    EXPECT_NE(run.out.find(std::to_string(stabilityCases().size()) + " cases, none failed."),
              std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(folder / "out/index.html"));
    const Json rows = Json::parse(std::ifstream(folder / "out/measure.json"))["settings"];
    ASSERT_EQ(rows.size(), stabilityCases().size());
    for (const Json& row : rows) {
        const std::string name = row["name"];
        ASSERT_FALSE(row.contains("failure")) << row;
        EXPECT_NE(run.out.find(name), std::string::npos) << name;
        EXPECT_EQ(row["nonfinite"], 0) << name;
        const Limit limit = limitOf(name);
        EXPECT_LE(std::abs(row["bias"].get<double>()), limit.drift) << name;
        EXPECT_LE(row["rel_l2"].get<double>(), limit.error) << name;
    }
}

}  // namespace
}  // namespace cutis::test
