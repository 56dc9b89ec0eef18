// The real program on a virtual screen, driven by key and mouse events (tests/viewer/drive.sh).
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include "renderer/core/files.h"
#include "renderer/scene/gltf_writer.h"
#include "renderer/scene/picture.h"
#include "renderer/scene/rig.h"
#include "tests/cli/program.h"
#include "tests/support/lying_png.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"
#include "tests/unit_scene/gltf_file.h"

namespace cutis::test {
namespace {

struct Rectangle {
    int left, top, right, bottom;
};

// Standard deviation of the luma within a rectangle: 0 where there is one colour.
double contrast(const Picture& picture, const Rectangle& in) {
    double sum = 0, squares = 0, count = 0;
    for (int y = in.top; y < in.bottom; ++y) {
        for (int x = in.left; x < in.right; ++x) {
            const float* p = &picture.values[(std::size_t(y) * picture.width + x) * picture.channels];
            const double luma = 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
            sum += luma, squares += luma * luma, ++count;
        }
    }
    const double mean = sum / count;
    return std::sqrt(std::max(squares / count - mean * mean, 0.0));
}

double relativeL2(const Picture& a, const Picture& b) {
    double difference = 0, whole = 0;
    for (std::size_t i = 0; i < b.values.size(); ++i) {
        difference += std::pow(double(a.values[i]) - b.values[i], 2);
        whole += std::pow(double(b.values[i]), 2);
    }
    return std::sqrt(difference / whole);
}

Light spotAt(const std::string& name, double azimuth) {
    Light light;
    light.name = name;
    light.type = LightType::spot;
    light.intensity = 4;
    light.outerConeAngle = 0.6;
    light.place = Placement{"*", azimuth, 20, 1.5};
    return light;
}

// Smooth bodies: at a sharp edge light differs from texel to texel, and the viewer's atlas, which serves any
// view, has other texels than that of one picture.
Scene twoSpheres() {
    SceneBuilder builder;
    const int skin = builder.addSkin(SkinMaterial());
    for (const double x : {-0.2, 0.2}) {
        builder.addObject(x < 0 ? "left" : "right", makeSphere(0.1, SphereMapping::latLong), skin,
                          glm::translate(glm::dmat4(1), {x, 0.0, 0.0}));
    }
    return builder.scene();
}

// Adds an animation "turn" to a GLB: its first node turns about +Y by 40 degrees in 1 s. The node must have
// no rotation.
void addTurn(const std::string& file) {
    const std::vector<std::byte> bytes = readFile(file, 1 << 26);
    std::uint32_t length = 0;
    std::memcpy(&length, &bytes.at(12), sizeof length);
    const auto* begin = reinterpret_cast<const char*>(bytes.data()) + 20;
    nlohmann::json json = nlohmann::json::parse(begin, begin + length);
    std::string binary(begin + length + 8, reinterpret_cast<const char*>(bytes.data()) + bytes.size());
    const auto add = [&](const std::vector<float>& values, const char* type) {
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", values.size() * sizeof(float)}});
        binary.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
        json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                     {"componentType", 5126},
                                     {"count", 2},
                                     {"type", type}});
        return json["accessors"].size() - 1;
    };
    const std::size_t times = add({0, 1}, "SCALAR");
    json["accessors"].back()["min"] = {0};
    json["accessors"].back()["max"] = {1};
    const float half = 0.349066f;  // 20 degrees
    const std::size_t turns = add({0, 0, 0, 1, 0, std::sin(half), 0, std::cos(half)}, "VEC4");
    json["animations"] = {
        {{"name", "turn"},
         {"samplers", {{{"input", times}, {"output", turns}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
    json["nodes"][0].erase("matrix");
    json["nodes"][0]["translation"] = {-0.2, 0, 0};
    json["buffers"][0]["byteLength"] = binary.size();
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string whole(bytes.size() ? reinterpret_cast<const char*>(bytes.data()) : "", 20);
    const auto put = [&](std::uint32_t value) {
        whole.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    const auto textLength = static_cast<std::uint32_t>(text.size()),
               binaryLength = static_cast<std::uint32_t>(binary.size());
    whole.resize(8);
    put(28 + textLength + binaryLength), put(textLength), put(0x4e4f534a);
    whole += text;
    put(binaryLength), put(0x004e4942);
    whole += binary;
    writeText(file, whole);
}

// FOLDER/panel is what the panel saved of both lights against the second alone: `cutis compare` finds the
// same.
void expectTheCommandLineCompares(const std::string& scene, Rig rig, const TemporaryFolder& folder) {
    rig.lights[1].enabled = true;
    saveRig(rig, folder / "both.rig.json");
    rig.lights.erase(rig.lights.begin());
    saveRig(rig, folder / "one.rig.json");
    const Picture a = readPicture(folder / "panel/A-Rig.exr");
    expectSuccess(runCutis(
        {"compare", scene, "--a", folder / "both.rig.json", "--b", folder / "one.rig.json", "--device", "cpu",
         "--size", std::to_string(a.width) + 'x' + std::to_string(a.height), "-o", folder / "command"}));
    const auto figuresIn = [&](const std::string& report) {
        return nlohmann::json::parse(readText(folder / (report + "/compare.json")))["pictures"][0];
    };
    const nlohmann::json panel = figuresIn("panel"), command = figuresIn("command");
    // Pictures of two renderers, whose atlases differ (see above).
    for (const char* figure : {"rel_l2", "p99", "flip", "light_ratio"})
        EXPECT_NEAR(panel[figure].get<double>() / command[figure].get<double>(), 1, 5e-3) << figure;
    EXPECT_GT(panel["rel_l2"].get<double>(), 0.1);
    EXPECT_NE(readText(folder / "panel/index.html").find("A-Rig.png"), std::string::npos);
}

TEST(Screen, ARigIsMadeComparedUndoneAndSaved) {
    const TemporaryFolder folder;
    const std::string scene = folder / "heads.glb", rigFile = folder / "heads.rig.json";
    writeGlb(twoSpheres(), scene);
    addTurn(scene);
    Rig rig;
    rig.lights = {spotAt("key", 30), spotAt("rim", 150)};
    saveRig(rig, rigFile);

    const ProcessResult run =
        runProcess({"/bin/bash", CUTIS_DRIVE_SCRIPT, CUTIS_PROGRAM, scene, folder.path(), CUTIS_DROP_FILE},
                   {{"CUTIS_CACHE_DIR", folder / "cache"},
                    {"CUTIS_DATA_DIR", folder / "data"},
                    {"CUTIS_VALIDATION", "1"}},
                   150);
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_NE(run.out.find("title: cutis - heads.glb"), std::string::npos) << run.out;
    // Validation messages and errors go there: the bad files are the only ones.
    EXPECT_EQ(run.err.rfind("cutis: ", 0), 0u) << run.err;
    EXPECT_NE(run.err.find("bad.glb"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("bad.rig.json"), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 2) << run.err;

    // Three times a third of a stop brighter, one of them undone; the second light muted.
    const Rig saved = loadRig(rigFile);
    ASSERT_EQ(saved.lights.size(), 2u);
    EXPECT_NEAR(saved.lights[0].intensity, 4 * std::exp2(2 / 3.0), 1e-9);
    EXPECT_TRUE(saved.lights[0].enabled);
    EXPECT_FALSE(saved.lights[1].enabled);
    EXPECT_EQ(saved.lights[1].intensity, 4);

    // The picture is what the command line makes of the saved rig.
    const Picture shown = readPicture(folder / "picture.exr");
    const std::string size = std::to_string(shown.width) + 'x' + std::to_string(shown.height);
    expectSuccess(runCutis({"render", scene, "--rig", rigFile, "--animation", "turn", "--time", "0.125",
                            "--device", "cpu", "--size", size, "-o", folder / "command.exr"}));
    const Picture expected = readPicture(folder / "command.exr");
    ASSERT_EQ(shown.values.size(), expected.values.size());
    // The view goes through angles and back: some 1e-9 of a pixel, which may tip a sample over an edge.
    EXPECT_LT(relativeL2(shown, expected), 2e-3);

    expectTheCommandLineCompares(scene, saved, folder);

    const Picture screen = readPicture(folder / "screen.png");
    ASSERT_EQ(screen.width, 960);
    ASSERT_EQ(screen.height, 540);
    const int left = (screen.width - shown.width) / 2;
    EXPECT_GT(contrast(screen, {left, 100, screen.width - left, 450}), 0.03)
        << "no picture between the panels";
    EXPECT_GT(contrast(screen, {5, 30, left - 5, 300}), 0.03) << "no rig panel";
}

TEST(Screen, NothingHarmsItWhileItLoads) {
    const TemporaryFolder folder;
    const ProcessResult run =
        runProcess({"/bin/bash", CUTIS_DRIVE_LOADING_SCRIPT, CUTIS_PROGRAM, folder.path(), CUTIS_DROP_FILE},
                   {{"CUTIS_CACHE_DIR", folder / "cache"},
                    {"CUTIS_DATA_DIR", CUTIS_DATA_DIR},
                    {"CUTIS_VALIDATION", "1"}},
                   150);
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    for (const char* file : {"bad.glb", "bad.exr", "bad.rig.json"})
        EXPECT_NE(run.err.find(file), std::string::npos) << file << '\n' << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 3) << "nothing else is said: " << run.err;
    const Picture screen = readPicture(folder / "screen.png");
    EXPECT_GT(contrast(screen, {5, 30, 285, 250}), 0.03) << "the rig panel came all the same";
}

// Under a Vulkan layer that makes the device fail (tests/device_trouble/layer.cpp).
class ScreenInTrouble : public testing::Test {
  protected:
    ScreenInTrouble() {
        writeGlb(twoSpheres(), scene_);
        Rig rig;
        rig.lights = {spotAt("key", 30), spotAt("rim", 150)};
        saveRig(rig, rigFile_);
    }
    ProcessResult drive(const std::string& trouble) const {
        return runProcess({"/bin/bash", CUTIS_DRIVE_TROUBLE_SCRIPT, CUTIS_PROGRAM, scene_, folder_.path()},
                          {{"CUTIS_CACHE_DIR", folder_ / "cache"},
                           {"CUTIS_DATA_DIR", folder_ / "data"},
                           {"NODEVICE_SELECT", "1"},
                           {"VK_ADD_LAYER_PATH", CUTIS_TROUBLE_LAYERS},
                           {"VK_INSTANCE_LAYERS", "VK_LAYER_CUTIS_trouble"},
                           {"CUTIS_TROUBLE", trouble}},
                          150);
    }
    // The key light was made a stop brighter.
    void expectBrighter(const std::string& file) const {
        const Rig saved = loadRig(file);
        ASSERT_EQ(saved.lights.size(), 2u);
        EXPECT_NEAR(saved.lights[0].intensity, 8, 1e-9);
    }
    double pictureContrast() const {
        return contrast(readPicture(folder_ / "screen.png"), {330, 120, 630, 420});
    }

    const TemporaryFolder folder_;
    const std::string scene_ = folder_ / "heads.glb", rigFile_ = folder_ / "heads.rig.json";
};

TEST_F(ScreenInTrouble, ALostDeviceIsOpenedAnew) {
    const ProcessResult run = drive("crash:3");
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_NE(run.err.find("device was lost"), std::string::npos) << run.err;
    expectBrighter(rigFile_);
    EXPECT_GT(pictureContrast(), 0.03) << "the picture came all the same";
}

TEST_F(ScreenInTrouble, OutOfMemoryIsSaidAndTheRigKept) {
    const ProcessResult run = drive("memory:30000000");
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_NE(run.err.find("out of device memory"), std::string::npos) << run.err;
    expectBrighter(rigFile_);
}

// Without a device for the window there is nothing to go on with.
TEST_F(ScreenInTrouble, WhenTheWindowsDeviceIsLostTheRigIsRecovered) {
    const ProcessResult run = drive("window:" + (folder_ / "lost").string());
    EXPECT_EQ(run.status, 1) << run.out << run.err;
    EXPECT_NE(run.err.find("the device was lost"), std::string::npos) << run.err;
    const std::string left = folder_ / "cache/autosave.rig.json";
    ASSERT_TRUE(std::filesystem::is_regular_file(left)) << run.err;
    expectBrighter(left);
}

// A scene whose image makes its decoder spin or crash is refused, and nothing else is lost by it.
class ScreenAndBadDecoder : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(ScreenAndBadDecoder, TheRigIsKept) {
    const auto& [kind, why] = GetParam();
    const TemporaryFolder folder;
    const std::string scene = folder / "heads.glb", rigFile = folder / "heads.rig.json",
                      bad = folder / "bad.glb";
    writeGlb(twoSpheres(), scene);
    Rig rig;
    rig.lights = {spotAt("key", 30), spotAt("rim", 150)};
    saveRig(rig, rigFile);
    GltfFile file = triangleFile();
    file.json["materials"] =
        nlohmann::json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
    file.json["textures"] = nlohmann::json::parse(R"([{"source": 0}])");
    file.json["images"] = nlohmann::json::parse(R"([{"uri": "skin.png"}])");
    file.json["meshes"][0]["primitives"][0]["material"] = 0;
    file.saveGlb(folder.path(), "bad.glb");
    writeText(folder / "skin.png", lyingPng(16384, 8));

    const ProcessResult run = runProcess(
        {"/bin/bash", CUTIS_DRIVE_DECODER_SCRIPT, CUTIS_PROGRAM, scene, folder.path(), CUTIS_DROP_FILE, bad},
        {{"CUTIS_CACHE_DIR", folder / "cache"},
         {"CUTIS_DATA_DIR", folder / "data"},
         {"LD_PRELOAD", CUTIS_BAD_DECODER_LIBRARY},
         {"CUTIS_BAD_DECODER", kind}},
        150);
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << "nothing else is said: " << run.err;
    const Rig saved = loadRig(rigFile);
    ASSERT_EQ(saved.lights.size(), 2u);
    EXPECT_NEAR(saved.lights[0].intensity, 8, 1e-9);
    EXPECT_GT(contrast(readPicture(folder / "screen.png"), {330, 120, 630, 420}), 0.03)
        << "the picture is there";
}

INSTANTIATE_TEST_SUITE_P(Decoder, ScreenAndBadDecoder,
                         testing::Values(std::pair{"spin", "it takes its decoder too long"},
                                         std::pair{"crash", "its decoder crashed (Segmentation fault)"}),
                         [](const auto& test) { return test.param.first; });

// The same with three people, from the data that set-up fetched.
TEST(Screen, TheDefaultSceneIsLitSavedAndReproduced) {
    const TemporaryFolder folder;
    const ProcessResult run =
        runProcess({"/bin/bash", CUTIS_DRIVE_DEFAULT_SCRIPT, CUTIS_PROGRAM, folder.path()},
                   {{"CUTIS_CACHE_DIR", folder / "cache"},
                    {"CUTIS_DATA_DIR", CUTIS_DATA_DIR},
                    {"CUTIS_VALIDATION", "1"}},
                   300);
    ASSERT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_NE(run.out.find("title: cutis - default"), std::string::npos) << run.out;
    EXPECT_EQ(run.err, "") << "errors and validation messages go there";

    // Two thirds of a stop brighter, solo and no longer solo, three edits undone: one of the two steps is
    // left.
    const Rig shipped = loadRig(std::filesystem::path(CUTIS_DATA_DIR) / "default" / "default.rig.json");
    const Rig saved = loadRig(folder / "own.rig.json");
    ASSERT_EQ(saved.lights.size(), shipped.lights.size());
    for (std::size_t i = 0; i < saved.lights.size(); ++i) {
        const double expected = shipped.lights[i].intensity * (i == 0 ? std::exp2(1 / 3.0) : 1);
        EXPECT_NEAR(saved.lights[i].intensity, expected, 1e-9 * expected) << i;
        EXPECT_EQ(saved.lights[i].enabled, shipped.lights[i].enabled) << i;
    }

    const Picture shown = readPicture(folder / "picture.exr");
    const std::string size = std::to_string(shown.width) + 'x' + std::to_string(shown.height);
    expectSuccess(runCutis({"render", "default", "--rig", folder / "own.rig.json", "--device", "cpu",
                            "--size", size, "-o", folder / "command.exr"},
                           {{"CUTIS_DATA_DIR", CUTIS_DATA_DIR}}));
    const Picture expected = readPicture(folder / "command.exr");
    ASSERT_EQ(shown.values.size(), expected.values.size());
    // One renderer lights all skin, the other what is seen, in atlases that may differ in size.
    EXPECT_LT(relativeL2(shown, expected), 0.03);
    const Picture screen = readPicture(folder / "screen.png");
    ASSERT_EQ(screen.width, 820);
    const int left = (screen.width - shown.width) / 2;
    EXPECT_GT(contrast(screen, {left, 150, screen.width - left, 300}), 0.03)
        << "no picture between the panels";
}

}  // namespace
}  // namespace cutis::test
