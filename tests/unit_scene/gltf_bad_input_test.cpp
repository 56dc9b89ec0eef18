// Files that loadGltf must refuse with one line that says where, and never crash on.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "gltf_file.h"
#include "renderer/core/files.h"
#include "renderer/scene/gltf.h"
#include "tests/support/process.h"
#include "warnings.h"

namespace cutis {
namespace {

using nlohmann::json;
using test::GltfFile;

struct BadFile {
    const char* name;
    std::function<void(GltfFile&)> spoil;  // from a good file with a triangle, an image and a skin material
    const char* where;                     // the JSON path that the error must end with
};

void PrintTo(const BadFile& bad, std::ostream* out) {
    *out << bad.name;
}

GltfFile goodFile() {
    GltfFile file = test::triangleFile();
    file.json["materials"] = json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
    file.json["textures"] = json::parse(R"([{"source": 0, "sampler": 0}])");
    file.json["samplers"] = json::parse("[{}]");
    // A PNG of one pixel.
    file.json["images"] = json::parse(
        R"([{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNgAAAAAgABSK+kcQAAAABJRU5ErkJggg=="}])");
    file.json["meshes"][0]["primitives"][0]["material"] = 0;
    return file;
}

json& primitive(GltfFile& file) {
    return file.json["meshes"][0]["primitives"][0];
}

// The file's lights are these, and its first node shines with the first.
auto withLights(const char* lights) {
    return [lights](GltfFile& f) {
        f.json["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(lights);
        f.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    };
}

const BadFile kBadFiles[] = {
    {"no asset", [](GltfFile& f) { f.json.erase("asset"); }, ""},
    {"version 1", [](GltfFile& f) { f.json["asset"]["version"] = "1.0"; }, "asset.version"},
    {"version a number", [](GltfFile& f) { f.json["asset"]["version"] = 2.0; }, "asset.version"},
    {"minVersion 2.1", [](GltfFile& f) { f.json["asset"]["minVersion"] = "2.1"; }, "asset.minVersion"},
    {"basis", [](GltfFile& f) { f.json["extensionsRequired"] = {"KHR_texture_basisu"}; },
     "extensionsRequired[0]"},

    {"scene of no number", [](GltfFile& f) { f.json["scene"] = 7; }, "scene"},
    {"scene a string", [](GltfFile& f) { f.json["scene"] = "0"; }, "scene"},
    {"root out of range", [](GltfFile& f) { f.json["scenes"][0]["nodes"] = {5}; }, "scenes[0].nodes[0]"},
    {"root negative", [](GltfFile& f) { f.json["scenes"][0]["nodes"] = {-1}; }, "scenes[0].nodes[0]"},
    {"nodes an object", [](GltfFile& f) { f.json["nodes"] = json::object(); }, "nodes"},
    {"cycle of one", [](GltfFile& f) { f.json["nodes"] = json::parse(R"([{"children": [0]}])"); },
     "nodes[0]"},
    {"cycle of two",
     [](GltfFile& f) { f.json["nodes"] = json::parse(R"([{"children": [1]}, {"children": [0]}])"); },
     "nodes[0]"},
    {"two parents",
     [](GltfFile& f) { f.json["nodes"] = json::parse(R"([{"children": [2]}, {"children": [2]}, {}])"); },
     "nodes[1].children[0]"},
    {"a root with a parent",
     [](GltfFile& f) {
         f.json["nodes"] = json::parse(R"([{"children": [1]}, {}])");
         f.json["scenes"][0]["nodes"] = {0, 1};
     },
     "scenes[0].nodes[1]"},
    {"too deep",
     [](GltfFile& f) {
         f.json["nodes"] = json::array();
         for (int i = 0; i < 5000; ++i) f.json["nodes"].push_back({{"children", {i + 1}}});
         f.json["nodes"].push_back(json::object());
     },
     "nodes[1000]"},
    {"matrix of 15", [](GltfFile& f) { f.json["nodes"][0]["matrix"] = std::vector<int>(15, 1); },
     "nodes[0].matrix"},
    {"matrix not affine", [](GltfFile& f) { f.json["nodes"][0]["matrix"] = std::vector<int>(16, 1); },
     "nodes[0].matrix"},
    {"rotation 0",
     [](GltfFile& f) {
         f.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
     },
     "nodes[0].rotation"},
    {"scale a word",
     [](GltfFile& f) {
         f.json["nodes"][0]["scale"] = {1, "x", 1};
     },
     "nodes[0].scale[1]"},
    {"mesh out of range", [](GltfFile& f) { f.json["nodes"][0]["mesh"] = 1; }, "nodes[0].mesh"},
    {"camera out of range", [](GltfFile& f) { f.json["nodes"][0]["camera"] = 0; }, "nodes[0].camera"},

    {"no primitives", [](GltfFile& f) { f.json["meshes"][0] = json::object(); }, "meshes[0]"},
    {"primitive a number", [](GltfFile& f) { f.json["meshes"][0]["primitives"] = {3}; },
     "meshes[0].primitives[0]"},
    {"mode 7", [](GltfFile& f) { primitive(f)["mode"] = 7; }, "meshes[0].primitives[0].mode"},
    {"material out of range", [](GltfFile& f) { primitive(f)["material"] = 1; },
     "meshes[0].primitives[0].material"},
    {"accessor out of range", [](GltfFile& f) { primitive(f)["attributes"]["POSITION"] = 99; },
     "meshes[0].primitives[0].attributes.POSITION"},
    {"accessor a fraction", [](GltfFile& f) { primitive(f)["attributes"]["POSITION"] = 0.5; },
     "meshes[0].primitives[0].attributes.POSITION"},
    {"positions of scalars", [](GltfFile& f) { primitive(f)["attributes"]["POSITION"] = 1; },
     "meshes[0].primitives[0].attributes.POSITION"},
    {"indices of floats", [](GltfFile& f) { f.json["accessors"][1]["componentType"] = test::kFloat; },
     "meshes[0].primitives[0].indices"},
    {"indices of vectors", [](GltfFile& f) { primitive(f)["indices"] = 0; },
     "meshes[0].primitives[0].indices"},
    {"index out of range",
     [](GltfFile& f) {
         primitive(f)["indices"] = f.addAccessor<std::uint8_t>({0, 1, 3}, "SCALAR", test::kUnsignedByte, 3);
     },
     "meshes[0].primitives[0].indices"},
    {"fewer normals than positions",
     [](GltfFile& f) {
         primitive(f)["attributes"]["NORMAL"] = f.addAccessor<float>({0, 0, 1}, "VEC3", test::kFloat, 1);
     },
     "meshes[0].primitives[0].attributes.NORMAL"},
    {"colours as plain integers",
     [](GltfFile& f) {
         primitive(f)["attributes"]["COLOR_0"] =
             f.addAccessor<std::uint8_t>(std::vector<std::uint8_t>(9, 1), "VEC3", test::kUnsignedByte, 3);
     },
     "meshes[0].primitives[0].attributes.COLOR_0"},

    {"component type 5124", [](GltfFile& f) { f.json["accessors"][0]["componentType"] = 5124; },
     "accessors[0].componentType"},
    {"type VEC5", [](GltfFile& f) { f.json["accessors"][0]["type"] = "VEC5"; },
     "meshes[0].primitives[0].attributes.POSITION"},
    {"count 0", [](GltfFile& f) { f.json["accessors"][0]["count"] = 0; }, "accessors[0].count"},
    {"count -1", [](GltfFile& f) { f.json["accessors"][0]["count"] = -1; }, "accessors[0].count"},
    {"count 4", [](GltfFile& f) { f.json["accessors"][0]["count"] = 4; }, "accessors[0]"},
    {"count 2^31", [](GltfFile& f) { f.json["accessors"][0]["count"] = 2147483648u; }, "accessors[0]"},
    {"count 2^53", [](GltfFile& f) { f.json["accessors"][0]["count"] = 9007199254740992; },
     "accessors[0].count"},
    {"count 1e300", [](GltfFile& f) { f.json["accessors"][0]["count"] = 1e300; }, "accessors[0].count"},
    {"zeros without end",
     [](GltfFile& f) {
         f.json["accessors"][0].erase("bufferView");
         f.json["accessors"][0]["count"] = 4000000000u;
     },
     "meshes[0].primitives[0].attributes.POSITION"},
    {"accessor offset", [](GltfFile& f) { f.json["accessors"][0]["byteOffset"] = 4; }, "accessors[0]"},
    {"accessor offset 2^53", [](GltfFile& f) { f.json["accessors"][0]["byteOffset"] = 9007199254740992; },
     "accessors[0]"},
    {"accessor offset -4", [](GltfFile& f) { f.json["accessors"][0]["byteOffset"] = -4; },
     "accessors[0].byteOffset"},
    {"buffer view out of range", [](GltfFile& f) { f.json["accessors"][0]["bufferView"] = 9; },
     "accessors[0].bufferView"},
    {"view beyond its buffer", [](GltfFile& f) { f.json["bufferViews"][0]["byteLength"] = 1000; },
     "bufferViews[0]"},
    {"view at 2^53", [](GltfFile& f) { f.json["bufferViews"][0]["byteOffset"] = 9007199254740992; },
     "bufferViews[0]"},
    {"view of no buffer", [](GltfFile& f) { f.json["bufferViews"][0]["buffer"] = 1; },
     "bufferViews[0].buffer"},
    {"view without a length", [](GltfFile& f) { f.json["bufferViews"][0].erase("byteLength"); },
     "bufferViews[0]"},
    {"stride below the element", [](GltfFile& f) { f.json["bufferViews"][0]["byteStride"] = 4; },
     "bufferViews[0].byteStride"},
    {"stride 16 of 36 bytes", [](GltfFile& f) { f.json["bufferViews"][0]["byteStride"] = 16; },
     "accessors[0]"},
    {"sparse index out of range",
     [](GltfFile& f) {
         const int places = f.addView<std::uint8_t>({3}), values = f.addView<float>({0, 0, 0});
         f.json["accessors"][0]["sparse"] = {
             {"count", 1},
             {"indices", {{"bufferView", places}, {"componentType", test::kUnsignedByte}}},
             {"values", {{"bufferView", values}}}};
     },
     "accessors[0].sparse.indices"},
    {"sparse count",
     [](GltfFile& f) {
         f.json["accessors"][0]["sparse"] = {{"count", 4}};
     },
     "accessors[0].sparse"},

    {"texture out of range",
     [](GltfFile& f) { f.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 1; },
     "materials[0].pbrMetallicRoughness.baseColorTexture.index"},
    {"base colour of 3",
     [](GltfFile& f) {
         f.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1};
     },
     "materials[0].pbrMetallicRoughness.baseColorFactor"},
    {"alpha mode", [](GltfFile& f) { f.json["materials"][0]["alphaMode"] = "GLOW"; },
     "materials[0].alphaMode"},
    {"TEXCOORD_2",
     [](GltfFile& f) { f.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 2; },
     "materials[0].pbrMetallicRoughness.baseColorTexture"},
    {"image out of range", [](GltfFile& f) { f.json["textures"][0]["source"] = 1; }, "textures[0].source"},
    {"sampler out of range", [](GltfFile& f) { f.json["textures"][0]["sampler"] = 1; },
     "textures[0].sampler"},
    {"wrap mode", [](GltfFile& f) { f.json["samplers"][0]["wrapS"] = 1; }, "samplers[0].wrapS"},

    {"image missing", [](GltfFile& f) { f.json["images"][0]["uri"] = "nowhere.png"; }, "images[0].uri"},
    {"image without source", [](GltfFile& f) { f.json["images"][0] = json::object(); }, "images[0]"},
    {"image of text",
     [](GltfFile& f) { f.json["images"][0]["uri"] = "data:image/png;base64,aGVsbG8gd29ybGQh"; }, "images[0]"},
    {"image not base64", [](GltfFile& f) { f.json["images"][0]["uri"] = "data:image/png;base64,****"; },
     "images[0].uri"},
    {"image truncated",
     [](GltfFile& f) {
         f.json["images"][0]["uri"] =
             "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4";
     },
     "images[0]"},
    // The same PNG with 2^30 pixels a side in its header.
    {"image of 2^30 x 2^30",
     [](GltfFile& f) {
         f.json["images"][0]["uri"] =
             "data:image/"
             "png;base64,iVBORw0KGgoAAAANSUhEUkAAAABAAAAACAAAAAA6fptVAAAACklEQVR4nGNgAAAAAgABSK+"
             "kcQAAAABJRU5ErkJggg==";
     },
     "images[0]"},
    {"path above", [](GltfFile& f) { f.json["images"][0]["uri"] = "../secret.png"; }, "images[0].uri"},
    {"path above, encoded", [](GltfFile& f) { f.json["images"][0]["uri"] = "%2e%2e/secret.png"; },
     "images[0].uri"},
    {"path above, within", [](GltfFile& f) { f.json["images"][0]["uri"] = "a/../../secret.png"; },
     "images[0].uri"},
    {"path absolute", [](GltfFile& f) { f.json["images"][0]["uri"] = "/etc/passwd"; }, "images[0].uri"},
    {"path with NUL", [](GltfFile& f) { f.json["images"][0]["uri"] = "a%00.png"; }, "images[0].uri"},
    {"path by symlink", [](GltfFile& f) { f.json["images"][0]["uri"] = "link.png"; }, "images[0].uri"},
    {"path a folder", [](GltfFile& f) { f.json["images"][0]["uri"] = "."; }, "images[0].uri"},
    {"scheme file", [](GltfFile& f) { f.json["images"][0]["uri"] = "file:///etc/passwd"; }, "images[0].uri"},
    {"scheme http", [](GltfFile& f) { f.json["images"][0]["uri"] = "http://example.com/a.png"; },
     "images[0].uri"},

    {"far away",
     [](GltfFile& f) {
         f.json["nodes"][0]["translation"] = {1e300, 0, 0};
     },
     ""},
    {"far away by scale",
     [](GltfFile& f) {
         f.json["nodes"][0]["scale"] = {1e200, 1e200, 1e200};
     },
     ""},
    {"light out of range", withLights("[]"), "nodes[0].extensions.KHR_lights_punctual.light"},
    {"light of no kind", withLights(R"([{"type": "laser"}])"), "extensions.KHR_lights_punctual.lights[0].type"},
    // Beyond what sums in single precision hold.
    {"light of 1e300 candela", withLights(R"([{"type": "point", "intensity": 1e300}])"),
     "extensions.KHR_lights_punctual.lights[0].intensity"},
    {"light of colour 1e30", withLights(R"([{"type": "point", "color": [1, 1e30, 1]}])"),
     "extensions.KHR_lights_punctual.lights[0].color"},
};

class GltfBadInput : public testing::TestWithParam<BadFile> {};

TEST_P(GltfBadInput, IsRefusedWithItsPath) {
    const test::TemporaryFolder outside, folder;
    test::writeBytes(outside / "secret.png", "secret", 6);
    std::filesystem::create_symlink(outside / "secret.png", folder / "link.png");
    GltfFile file = goodFile();
    GetParam().spoil(file);
    const auto path = file.saveGlb(folder.path());
    try {
        loadGltf(path);
        FAIL() << "was accepted";
    } catch (const Error& error) {
        EXPECT_TRUE(error.where().starts_with(path.string())) << error.what();
        EXPECT_TRUE(error.where().ends_with(GetParam().where)) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

INSTANTIATE_TEST_SUITE_P(Table, GltfBadInput, testing::ValuesIn(kBadFiles), [](const auto& test) {
    std::string name = std::to_string(test.index) + "_" + test.param.name;
    std::ranges::replace_if(
        name, [](unsigned char c) { return !std::isalnum(c); }, '_');
    return name;
});

TEST(GltfGoodInput, TheFileThatTheTableSpoilsIsGood) {
    const test::TemporaryFolder folder;
    const test::CapturedWarnings warnings;
    const Scene scene = loadGltf(goodFile().saveGlb(folder.path()));
    EXPECT_EQ(scene.images.at(0).width, 1);
    EXPECT_TRUE(warnings.all().empty());
}

// Cut anywhere, a file is refused; never is there a crash or a read beyond it (the sanitizer build looks).
TEST(GltfBadInputBytes, EveryTruncationIsRefused) {
    const test::TemporaryFolder folder;
    const auto bytes = readFile(goodFile().saveGlb(folder.path()));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        test::writeBytes(folder / "cut.glb", bytes.data(), size);
        EXPECT_THROW(loadGltf(folder / "cut.glb"), Error) << size;
    }
}

// Every byte of the file replaced in turn: it loads or is refused, and what loads is sound.
TEST(GltfBadInputBytes, NoChangedByteDoesHarm) {
    const test::TemporaryFolder folder;
    const test::CapturedWarnings warnings;
    const auto bytes = readFile(goodFile().saveGlb(folder.path()));
    int refused = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        for (const int value : {0x39, 0xff}) {  // a digit, and no ASCII
            auto changed = bytes;
            changed[i] = std::byte(value);
            test::writeBytes(folder / "changed.glb", changed.data(), changed.size());
            try {
                for (const Mesh& mesh : loadGltf(folder / "changed.glb").meshes) {
                    for (const Primitive& p : mesh.primitives) {
                        for (const std::uint32_t index : p.indices) ASSERT_LT(index, p.positions.size());
                    }
                }
            } catch (const Error&) {
                ++refused;
            }
        }
    }
    EXPECT_GT(refused, int(bytes.size()));
}

TEST(GltfBadInputBytes, NestingWithoutEnd) {
    const test::TemporaryFolder folder;
    const std::string deep(1000000, '[');
    const std::string open = R"({"asset": {"version": "2.0"}, "extras": )";
    test::writeBytes(folder / "open.gltf", (open + deep).data(), open.size() + deep.size());
    EXPECT_THROW(loadGltf(folder / "open.gltf"), Error);
    const std::string closed = open + deep + std::string(deep.size(), ']') + "}";
    test::writeBytes(folder / "closed.gltf", closed.data(), closed.size());
    EXPECT_THROW(loadGltf(folder / "closed.gltf"), Error);
    const std::string shallow = open + std::string(200, '[') + std::string(200, ']') + "}";
    test::writeBytes(folder / "shallow.gltf", shallow.data(), shallow.size());
    EXPECT_TRUE(loadGltf(folder / "shallow.gltf").nodes.empty());
    const std::string brackets = open + "\"\\\"" + deep + "\"}";  // in a string they are text
    test::writeBytes(folder / "brackets.gltf", brackets.data(), brackets.size());
    EXPECT_TRUE(loadGltf(folder / "brackets.gltf").nodes.empty());
}

TEST(GltfBadInputBytes, NoFileOrAFolder) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(loadGltf(folder / "absent.glb"), Error);
    EXPECT_THROW(loadGltf(folder.path()), Error);
}

}  // namespace
}  // namespace cutis
