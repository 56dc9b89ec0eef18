// A wrong command line ends with status 2 and one line that names what is wrong.
#include <gtest/gtest.h>

#include "renderer/scene/gltf_writer.h"
#include "tests/cli/program.h"

namespace cutis::test {
namespace {

struct Wrong {
    std::vector<std::string> arguments;
    std::vector<std::string> parts;  // of the message
};

TEST(Usage, WrongCommandLines) {
    const std::vector<Wrong> table = {
        {{""}, {"unknown command ''"}},
        {{"rendr"}, {"unknown command 'rendr'", "did you mean 'render'?"}},
        {{"scene.obj"}, {"unknown command 'scene.obj'"}},
        {{"--sizes", "1x1"}, {"unknown option --sizes", "did you mean '--size'?", "see cutis view --help"}},
        {{"view", "a.glb", "b.glb"}, {"'b.glb' is too much"}},
        {{"view", "--ui-scale", "0"}, {"--ui-scale is '0'"}},
        {{"help", "nothing"}, {"unknown command 'nothing'"}},
        {{"rig"}, {"cutis rig needs one of list, show, check, export", "see cutis rig --help"}},
        {{"rig", "lst"}, {"unknown command 'rig lst'", "did you mean 'list'?"}},
        {{"rig", "list", "x"}, {"'x' is too much"}},
        {{"rig", "show"}, {"RIG is missing"}},
        {{"rig", "export", "rim"}, {"-o FILE is missing"}},
        {{"rig", "export", "rim", "-o", "a.exr"}, {"--output", "a.exr"}},
        {{"devices", "--device", "cpu"}, {"unknown option --device", "see cutis devices --help"}},
    };
    for (const Wrong& wrong : table) expectFailure(runCutis(wrong.arguments), 2, wrong.parts);
}

// `cutis` is the viewer: without a display it is one clear line, and so is a scene that is not there.
TEST(Usage, ViewerNeedsADisplayAndAScene) {
    const TemporaryFolder folder;
    const std::string scene = folder / "heads.glb", missing = folder / "missing.glb";
    writeGlb(twoHeads(), scene);
    const EnvironmentVariables noDisplay = {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}};
    expectFailure(runCutis({scene}, noDisplay), 1, {"cannot open the viewer", "there is no display"});
    expectFailure(runCutis({"view", scene}, noDisplay), 1, {"there is no display"});
    expectFailure(runCutis({missing}, noDisplay), 1, {"no such file", "missing.glb"});
    const EnvironmentVariables noData = {{"DISPLAY", ""}, {"CUTIS_DATA_DIR", folder / "data"}};
    expectFailure(runCutis({}, noData), 1, {"no default scene"});
}

TEST(Usage, WrongOptionsOfRender) {
    const std::string long1000(1000, '9');
    const std::vector<Wrong> table = {
        {{"--output"}, {"--output needs a value"}},
        {{"-o"}, {"needs a value"}},
        {{"-o", "b.jpg"}, {"--output", "b.jpg", ".exr or .png"}},
        {{"-o", ""}, {"--output is empty"}},
        {{"-o", "a.png"}, {"--output", "twice"}},
        {{"-o", "./a.png"}, {"--output", "twice"}},
        {{"--sizes", "1x1"}, {"unknown option --sizes", "did you mean '--size'?"}},
        {{"-x"}, {"unknown option -x"}},
        {{"more.glb"}, {"'more.glb' is too much"}},
        {{"--size"}, {"--size needs a value"}},
        {{"--size", "0x0"}, {"--size is '0x0'"}},
        {{"--size", "640"}, {"--size is '640'"}},
        {{"--size", "640X480"}, {"--size"}},
        {{"--size", "-1x5"}, {"--size"}},
        {{"--size", "1x5x"}, {"--size"}},
        {{"--size", " 1x5"}, {"--size"}},
        {{"--size", "16385x1"}, {"--size"}},
        {{"--size", "16384x16384"}, {"--size", "pixels"}},
        {{"--size", long1000 + "x1"}, {"--size"}},
        {{"--size", "8x8", "--size", "8x8"}, {"--size is given twice"}},
        {{"--exposure", "nan"}, {"--exposure is 'nan'"}},
        {{"--exposure", "inf"}, {"--exposure is 'inf'"}},
        {{"--exposure", "1e999"}, {"--exposure"}},
        {{"--exposure", "65"}, {"--exposure"}},
        {{"--exposure", "1,5"}, {"--exposure is '1,5'"}},
        {{"--exposure", "0x10"}, {"--exposure"}},
        {{"--env-intensity", "-1"}, {"--env-intensity is '-1'"}},
        {{"--env-rotation", "north"}, {"--env-rotation is 'north'"}},
        {{"--env", "none", "--env-rotation", "3"}, {"--env none", "--env-rotation"}},
        {{"--env-intensity", "3", "--env", "none"}, {"--env none", "--env-intensity"}},
        {{"--rig", "none", "--light", "key"}, {"--rig none", "--light"}},
        {{"--rig", "rim", "--rig", "rim"}, {"--rig is given twice"}},
        {{"--rig", ""}, {"--rig is empty"}},
        {{"--gaussians", "0"}, {"--gaussians is '0'"}},
        {{"--gaussians", "2.5"}, {"--gaussians is '2.5'"}},
        {{"--irradiance-size", "0"}, {"--irradiance-size is '0'"}},
        {{"--irradiance-size", "1000000"}, {"--irradiance-size"}},
        {{"--merge", "max"}, {"--merge is 'max'"}},
        {{"--chain", "printed"}, {"--chain is 'printed'"}},
        {{"--tolerance", "0"}, {"--tolerance is '0'"}},
        {{"--tolerance", "1%", "--gaussians", "3"}, {"--tolerance", "exclude each other"}},
        {{"--seed", "-1"}, {"--seed is '-1'"}},
        {{"--seed", "4294967296"}, {"--seed"}},
        {{"--aov", "normals"}, {"--aov", "'normals'", "did you mean 'normal'?"}},
        {{"--aov", "normal,"}, {"--aov"}},
        {{"--aov", ""}, {"--aov"}},
        {{"--aov", "normal,depth,normal"}, {"--aov", "'normal' twice"}},
        {{"--no-prune", "--no-prune"}, {"--no-prune is given twice"}},
        {{"--no-prune=no"}, {"--no-prune takes no value"}},
        {{"-o", "a.depth.exr", "--aov", "depth"}, {"two results", "a.depth.exr"}},
        {{"--stats", "./a.png"}, {"two results", "a.png"}},
    };
    for (const Wrong& wrong : table) {
        std::vector<std::string> arguments = {"render", "missing.glb", "-o", "a.png"};
        arguments.insert(arguments.end(), wrong.arguments.begin(), wrong.arguments.end());
        std::vector<std::string> parts = wrong.parts;
        parts.push_back("see cutis render --help");
        expectFailure(runCutis(arguments), 2, parts);
    }
    expectFailure(runCutis({"render", "-o", "a.png"}), 2, {"SCENE is missing"});
    expectFailure(runCutis({"render", "", "-o", "a.png"}), 2, {"SCENE is empty"});
    expectFailure(runCutis({"render", "a.glb"}), 2, {"-o FILE is missing"});
}

// Spellings that must be understood: they fail only because the scene is not there.
TEST(Usage, AcceptedSpellings) {
    const std::vector<std::vector<std::string>> table = {{"--exposure=-1.5"},
                                                         {"--exposure", "-1.5"},
                                                         {"--exposure", "+2"},
                                                         {"--size=16x9"},
                                                         {"--env-rotation", "-90"},
                                                         {"--light", "a", "--light", "b"},
                                                         {"--aov", "depth,normal"},
                                                         {"--camera", "auto:-30,10"},
                                                         {"--no-prune"},
                                                         {"--gaussians", "3", "--seed", "4294967295"}};
    const TemporaryFolder folder;
    for (const auto& options : table) {
        std::vector<std::string> arguments = {"render", "-o", folder / "a.png"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        arguments.push_back(folder / "missing.glb");
        expectFailure(runCutis(arguments), 1, {"no such file", "missing.glb"});
    }
    EXPECT_TRUE(filesIn(folder.path()).empty());
}

}  // namespace
}  // namespace cutis::test
