// Hostile files, given to the program itself: each is refused in one line that names it, within 5 s of work
// and 1 GiB, and leaves nothing behind. What the loaders refuse field by field is in unit_scene and unit_rig.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <functional>

#include "renderer/scene/gltf_writer.h"
#include "renderer/scene/image_io.h"
#include "renderer/scene/picture.h"
#include "tests/cli/program.h"
#include "tests/support/lying_png.h"
#include "tests/support/pictures.h"
#include "tests/unit_scene/gltf_file.h"

namespace cutis::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double kMostSeconds = 5;                // of processor time
constexpr std::uint64_t kMostBytes = 1ull << 30;  // resident

std::string littleEndian(std::uint32_t value) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 255);
    return bytes;
}

// Skin of one triangle, its base colour an image.
GltfFile skinFile() {
    GltfFile file = triangleFile();
    file.json["materials"] = Json::parse(
        R"([{"extras": {"skin": true}, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
    file.json["textures"] = Json::parse(R"([{"source": 0}])");
    file.json["images"] = Json::parse(R"([{"uri": "skin.png"}])");
    file.json["meshes"][0]["primitives"][0]["material"] = 0;
    return file;
}

using Where = const fs::path&;

// Writes scene.glb, its JSON changed.
std::function<void(Where)> glb(const std::function<void(Json&)>& change) {
    return [change](Where folder) {
        GltfFile file = skinFile();
        file.json.erase("textures"), file.json.erase("images"), file.json.erase("materials");
        file.json["meshes"][0]["primitives"][0].erase("material");
        change(file.json);
        file.saveGlb(folder);
    };
}

std::function<void(Where)> imageUri(const std::string& uri) {
    return [uri](Where folder) {
        GltfFile file = skinFile();
        file.json["images"][0]["uri"] = uri;
        file.saveGlb(folder);
    };
}

std::function<void(Where)> image(const std::string& bytes) {
    return [bytes](Where folder) {
        skinFile().saveGlb(folder);
        writeText(folder / "skin.png", bytes);
    };
}

// scene.glb with its bytes changed.
std::function<void(Where)> bytesOf(const std::function<void(std::string&)>& change) {
    return [change](Where folder) {
        writeGlb(twoHeads(), folder / "scene.glb");
        std::string bytes = readText(folder / "scene.glb");
        change(bytes);
        writeText(folder / "scene.glb", bytes);
    };
}

// A good scene, and a file beside it.
std::function<void(Where)> beside(const std::string& name, const std::string& bytes) {
    return [=](Where folder) {
        writeGlb(twoHeads(), folder / "scene.glb");
        writeText(folder / name, bytes);
    };
}

void cutSky(Where folder) {
    writeGlb(twoHeads(), folder / "scene.glb");
    writeExr(folder / "sky.exr", makeEnvironment(64, 32, [](const glm::dvec3& d) { return d * d; }));
    const std::string whole = readText(folder / "sky.exr");
    writeText(folder / "sky.exr", whole.substr(0, whole.size() / 2));
}

// Three gigabytes that take no room on disk.
void writeZeros(const fs::path& path) {
    writeText(path, {});
    fs::resize_file(path, 3'000'000'000);
}

// Some hundred bytes that claim 15 million texels: decoders of JPEG make up what is not there.
void lyingJpegSky(Where folder) {
    writeGlb(twoHeads(), folder / "scene.glb");
    writePixels(folder / "small.jpg", {{16, 16, 3, SampleType::uint8}, std::vector<std::byte>(16 * 16 * 3)});
    writeText(folder / "sky.jpg", lyingJpeg(readText(folder / "small.jpg"), 5400, 2700));
    fs::remove(folder / "small.jpg");
}

// What libraries of films take for a list of pictures elsewhere.
void listedSky(Where folder) {
    writeGlb(twoHeads(), folder / "scene.glb");
    writeExr(folder / "other.exr", makeEnvironment(64, 32, [](const glm::dvec3& d) { return d * d; }));
    writeText(folder / "sky.avi", "ffconcat version 1.0\nfile other.exr\nduration 1\n");
}

// An OpenEXR header (openexr.com, "File Layout") of a picture of 2^31 by 2^31.
std::string endlessExr() {
    const auto attribute = [](const char* name, const char* type, const std::string& value) {
        return std::string(name) + '\0' + type + '\0' +
               littleEndian(static_cast<std::uint32_t>(value.size())) + value;
    };
    const std::string window =
        littleEndian(0) + littleEndian(0) + littleEndian(0x7ffffffe) + littleEndian(0x7ffffffe);
    const std::string channel =
        std::string("R\0", 2) + littleEndian(2) + littleEndian(0) + littleEndian(1) + littleEndian(1);
    return littleEndian(20000630) + littleEndian(2) + attribute("channels", "chlist", channel + '\0') +
           attribute("compression", "compression", std::string(1, '\3')) +
           attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window) +
           attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
           attribute("pixelAspectRatio", "float", littleEndian(0x3f800000)) +
           attribute("screenWindowCenter", "v2f", littleEndian(0) + littleEndian(0)) +
           attribute("screenWindowWidth", "float", littleEndian(0x3f800000)) + '\0';
}

struct Hostile {
    const char* name;
    std::function<void(Where)> write;
    std::vector<std::string> parts;         // of the message
    std::vector<std::string> options = {};  // "@" becomes the folder
};

void PrintTo(const Hostile& hostile, std::ostream* out) {
    *out << hostile.name;
}

std::vector<Hostile> hostiles() {
    const std::vector<std::string> sky = {"--env", "@/sky.exr"}, rig = {"--rig", "@/a.rig.json"};
    return {
        {"empty", bytesOf([](std::string& b) { b.clear(); }), {"scene.glb"}},
        {"cut_off", bytesOf([](std::string& b) { b.resize(b.size() / 2); }), {"scene.glb"}},
        {"length_lies", bytesOf([](std::string& b) { b.replace(8, 4, "\xff\xff\xff\xff"); }), {"scene.glb"}},
        {"first_chunk_lies",
         bytesOf([](std::string& b) { b.replace(12, 4, "\xff\xff\xff\x7f"); }),
         {"scene.glb"}},
        {"first_chunk_is_no_json", bytesOf([](std::string& b) { b.replace(16, 4, "JUNK"); }), {"scene.glb"}},
        {"nested_without_end",
         [](Where folder) {
             writeText(folder / "scene.glb",
                       R"({"asset":{"version":"2.0"},"extras":)" + std::string(30'000'000, '['));
         },
         {"scene.glb"}},
        {"zeros_without_end",
         glb([](Json& j) {
             j["accessors"][0].erase("bufferView"), j["accessors"][0]["count"] = 4'000'000'000u;
         }),
         {"scene.glb", "attributes.POSITION"}},
        {"accessor_out_of_bounds",
         glb([](Json& j) { j["accessors"][0]["count"] = 4; }),
         {"scene.glb", "accessors[0]"}},
        {"view_out_of_bounds",
         glb([](Json& j) { j["bufferViews"][0]["byteLength"] = 1u << 31; }),
         {"scene.glb", "bufferViews[0]"}},
        {"cyclic_nodes",
         glb([](Json& j) { j["nodes"] = Json::parse(R"([{"children":[1],"mesh":0},{"children":[0]}])"); }),
         {"scene.glb", "nodes[0]"}},
        // A mesh of a million vertices in two thousand places.
        {"instances_without_end",
         [](Where folder) {
             GltfFile file = triangleFile();
             std::vector<float> corners;
             for (int i = 0; i < 999'999; ++i) {
                 corners.insert(corners.end(),
                                {static_cast<float>(i % 3 == 1), static_cast<float>(i % 3 == 2),
                                 1e-6f * static_cast<float>(i / 3)});
             }
             Json& primitive = file.json["meshes"][0]["primitives"][0];
             primitive.erase("indices");
             primitive["attributes"]["POSITION"] = file.addAccessor(corners, "VEC3", kFloat, 999'999);
             file.json["nodes"] = Json::array(), file.json["scenes"][0]["nodes"] = Json::array();
             for (int i = 0; i < 2000; ++i)
                 file.json["nodes"].push_back({{"mesh", 0}}), file.json["scenes"][0]["nodes"].push_back(i);
             file.saveGlb(folder);
         },
         {"scene.glb"}},
        {"path_that_leaves", imageUri("../../etc/passwd"), {"scene.glb", "images[0].uri"}},
        {"path_from_the_root", imageUri("/etc/passwd"), {"scene.glb", "images[0].uri"}},
        {"uri_with_a_scheme", imageUri("https://example.com/skin.png"), {"scene.glb", "images[0].uri"}},
        {"link_that_leads_out",
         [](Where folder) {
             skinFile().saveGlb(folder);
             fs::create_symlink("/etc/passwd", folder / "skin.png");
         },
         {"scene.glb", "images[0].uri"}},
        {"image_of_text", image("no image at all, but long enough to be one"), {"scene.glb", "images[0]"}},
        // 17 GB and 2 GB decoded, from 80 bytes.
        {"image_of_65536_texels", image(lyingPng(65536, 8)), {"scene.glb", "images[0]"}},
        {"image_of_2_gigabytes", image(lyingPng(16384, 16)), {"scene.glb", "images[0]"}},
        {"image_shorter_than_it_says", image(lyingPng(4096, 8)), {"scene.glb", "images[0]"}},
        // A gigabyte each, from 80 bytes.
        {"six_images_of_a_gigabyte",
         [](Where folder) {
             GltfFile file = skinFile();
             for (int i = 0; i < 6; ++i) {
                 const std::string name = std::to_string(i) + ".png";
                 writeText(folder / name, lyingPng(16384, 8));
                 file.json["images"][i] = {{"uri", name}};
                 file.json["textures"][i] = {{"source", i}};
                 file.json["materials"][i] = file.json["materials"][0];
                 file.json["materials"][i]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = i;
                 file.json["meshes"][0]["primitives"][i] = file.json["meshes"][0]["primitives"][0];
                 file.json["meshes"][0]["primitives"][i]["material"] = i;
             }
             file.saveGlb(folder);
         },
         {"scene.glb", "its images have more than 4 GiB"}},
        {"image_of_3_gigabytes_of_nothing",
         [](Where folder) {
             skinFile().saveGlb(folder);
             writeZeros(folder / "skin.png");
         },
         {"scene.glb", "images[0]"}},
        {"scene_of_3_gigabytes_of_nothing",
         [](Where folder) { writeZeros(folder / "scene.glb"); },
         {"scene.glb", "not glTF"}},
        {"extension_that_commands_the_terminal",
         glb([](Json& j) {
             j["extensionsRequired"] = {
                 "\x1b[2J\xc2\x9b"
                 "2Jnone"};
         }),
         {"scene.glb", "extensionsRequired[0]"}},
        {"sky_cut_off", cutSky, {"sky.exr"}, sky},
        {"sky_of_jpeg_that_lies",
         lyingJpegSky,
         {"sky.jpg", "cannot hold 5400 x 2700 texels"},
         {"--env", "@/sky.jpg"}},
        {"sky_that_names_another",
         listedSky,
         {"sky.avi", "not an image of a known format"},
         {"--env", "@/sky.avi"}},
        {"sky_without_end", beside("sky.exr", endlessExr()), {"sky.exr"}, sky},
        {"sky_of_zeros", beside("sky.exr", std::string(1 << 20, '\0')), {"sky.exr"}, sky},
        {"sky_that_lies",
         beside("sky.exr",
                "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8192 +X 16384\n" + std::string(64, '\x7f')),
         {"sky.exr"},
         sky},
        {"rig_of_wrong_types",
         beside("a.rig.json",
                R"({"cutis_rig": 1, "lights": [{"type": "spot", "intensity": "much", "place": {}}]})"),
         {"a.rig.json", "lights[0].intensity"},
         rig},
        {"seventy_thousand_lights_of_one_name",
         glb([](Json& j) {
             j["extensionsUsed"] = {"KHR_lights_punctual"};
             j["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"name", "bulb"}}};
             for (int i = 1; i <= 70'000; ++i) {
                 j["nodes"][i] = {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}};
                 j["scenes"][0]["nodes"].push_back(i);
             }
         }),
         {"too many light samples"},
         {"--rig", "scene"}},
        // Sixteen megabytes, the most that is read of a rig.
        {"rig_of_five_million_lights",
         [](Where folder) {
             writeGlb(twoHeads(), folder / "scene.glb");
             std::string objects = R"({"cutis_rig": 1, "lights": [{})";
             while (objects.size() < (16 << 20) - 8) objects += ",{}";
             writeText(folder / "a.rig.json", objects + "]}");
         },
         {"a.rig.json", "lights, the limit is"},
         rig},
        {"rig_of_a_key_without_end",
         beside("a.rig.json", R"({"cutis_rig": 1, ")" + std::string(1'000'000, 'a') + R"(": 0})"),
         {"a.rig.json", "unknown key"},
         rig},
        {"rig_nested_without_end", beside("a.rig.json", std::string(1'000'000, '[')), {"a.rig.json"}, rig},
        {"rig_of_zeros", beside("a.rig.json", std::string(1'000'000, '\0')), {"a.rig.json"}, rig},
        {"scene_that_is_a_pipe",
         [](Where folder) { ASSERT_EQ(::mkfifo((folder / "scene.glb").c_str(), 0600), 0); },
         {"scene.glb"}},
    };
}

class HostileFile : public testing::TestWithParam<Hostile> {};

TEST_P(HostileFile, IsRefusedSoonAndLeavesNothing) {
    const TemporaryFolder folder;
    GetParam().write(folder.path());
    const std::vector<std::string> before = filesIn(folder.path());
    std::vector<std::string> arguments = {
        "render",  folder / "scene.glb", "--size", "32x18",         "--device", "cpu",
        "--stats", folder / "s.json",    "-o",     folder / "a.exr"};
    for (std::string option : GetParam().options) {
        if (option.starts_with('@')) option.replace(0, 1, folder.path());
        arguments.push_back(option);
    }
    const ProcessResult run = runCutis(arguments);
    expectFailure(run, 1, GetParam().parts);
    EXPECT_LE(run.cpuSeconds, kMostSeconds);
    EXPECT_LE(run.peakBytes, kMostBytes);
    EXPECT_EQ(filesIn(folder.path()), before);
    std::printf("hostile: %-28s %4.0f MB, %.2f s: %s", GetParam().name,
                static_cast<double>(run.peakBytes) / 1e6, run.cpuSeconds, run.err.c_str());
}

INSTANTIATE_TEST_SUITE_P(Table, HostileFile, testing::ValuesIn(hostiles()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace cutis::test
