// What the program says and leaves behind when its device fails.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "renderer/scene/gltf_writer.h"
#include "renderer/scene/picture.h"
#include "tests/cli/program.h"

namespace cutis::test {
namespace {

class DeviceTrouble : public testing::Test {
  protected:
    DeviceTrouble() { writeGlb(twoHeads(), scene_); }

    // Under the layer of this folder, which makes the device fail as `trouble` says (layer.cpp).
    ProcessResult renderIn(const std::string& trouble, std::vector<std::string> options = {}) const {
        std::vector<std::string> arguments = {"render",   scene_, "--size", size_,
                                              "--device", "cpu",  "-o",     out_};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return run(trouble, arguments);
    }
    static ProcessResult run(const std::string& trouble, const std::vector<std::string>& arguments) {
        // Mesa's layer that orders devices crashes where there are none.
        return runCutis(arguments, {{"NODEVICE_SELECT", "1"},
                                    {"VK_ADD_LAYER_PATH", CUTIS_TROUBLE_LAYERS},
                                    {"VK_INSTANCE_LAYERS", "VK_LAYER_CUTIS_trouble"},
                                    {"CUTIS_TROUBLE", trouble}});
    }
    void expectNothingWritten() const {
        EXPECT_EQ(filesIn(folder_.path()), std::vector<std::string>{"heads.glb"});
    }

    TemporaryFolder folder_;
    std::string scene_ = folder_ / "heads.glb", out_ = folder_ / "a.exr", size_ = "64x36";
};

// Else the other tests would show nothing.
TEST_F(DeviceTrouble, TheLayerAloneChangesNothing) {
    expectSuccess(renderIn("none"));
}

TEST_F(DeviceTrouble, NoVulkanDriver) {
    const ProcessResult run =
        runCutis({"render", scene_, "-o", out_},
                 {{"VK_DRIVER_FILES", "/nonexistent"}, {"VK_ICD_FILENAMES", "/nonexistent"}});
    expectFailure(run, 1, {"no Vulkan driver found", "mesa-vulkan-drivers"});
    expectNothingWritten();
}

TEST_F(DeviceTrouble, NoDevice) {
    expectFailure(renderIn("no-device"), 1, {"device", "Vulkan finds none"});
    expectNothingWritten();
}

TEST_F(DeviceTrouble, NoDeviceThatSuits) {
    expectFailure(renderIn("old"), 1, {"it has Vulkan 1.2, cutis needs 1.3", "llvmpipe"});
    expectNothingWritten();
    const ProcessResult list = run("old", {"devices"});
    EXPECT_NE(list.out.find("cutis needs 1.3"), std::string::npos) << list.out;
}

TEST_F(DeviceTrouble, AFeatureIsMissing) {
    expectFailure(renderIn("feature"), 1, {"it lacks scalarBlockLayout", "llvmpipe"});
    expectNothingWritten();
}

// While it uploads, and while it draws.
TEST_F(DeviceTrouble, LostInTheMiddle) {
    for (const char* trouble : {"lost:1", "lost:2"}) {
        expectFailure(renderIn(trouble, {"--rig", "three-point"}), 1, {"the device was lost"});
        expectNothingWritten();
    }
}

constexpr const char* kSomeMemory = "memory:48000000";

TEST_F(DeviceTrouble, WithLessMemoryThePictureIsDrawnCoarserAndSaysSo) {
    size_ = "240x135";
    const std::vector<std::string> options = {"--rig", "three-point", "--stats", folder_ / "s.json"};
    expectSuccess(renderIn("none", options));
    const Picture whole = readPicture(out_);
    const auto atlas = [&] {
        return nlohmann::json::parse(readText(folder_ / "s.json"))["atlas"]["width"].get<int>();
    };
    const int finest = atlas();
    const ProcessResult run = renderIn(kSomeMemory, options);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err.find("cutis: warning: out of device memory"), 0u) << run.err;
    EXPECT_NE(run.err.find("drawing it coarser, with an atlas of"), std::string::npos) << run.err;
    EXPECT_LT(atlas(), finest);
    // The same picture, coarser.
    const Picture coarse = readPicture(out_);
    double difference = 0, light = 0;
    for (std::size_t i = 0; i < whole.values.size(); ++i) {
        difference += std::abs(coarse.values[i] - whole.values[i]);
        light += std::abs(whole.values[i]);
    }
    EXPECT_LT(difference, 0.1 * light);
}

TEST_F(DeviceTrouble, WhatTheUserFixedIsRefusedWithWhatWouldFit) {
    expectFailure(renderIn(kSomeMemory, {"--irradiance-size", "4096"}), 1,
                  {"out of device memory", "an atlas of", "texels would fit"});
    expectFailure(renderIn("memory:1000000"), 1, {"out of device memory", "not even a small picture"});
    expectNothingWritten();
}

}  // namespace
}  // namespace cutis::test
