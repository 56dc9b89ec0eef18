// Images of every format, depth and number of channels, from buffers and from files.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/packing.hpp>

#include "gltf_file.h"
#include "renderer/core/files.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/image_io.h"
#include "renderer/scene/tonemap.h"
#include "tests/support/process.h"

namespace cutis {
namespace {

using nlohmann::json;

// Writes a 4 x 2 image whose channels are `values` everywhere.
template <typename T>
void writeImage(const std::filesystem::path& path, const std::vector<T>& values) {
    Pixels pixels;
    pixels.layout = {4, 2, int(values.size())};
    pixels.layout.type = sizeof(T) == 1   ? SampleType::uint8
                  : sizeof(T) == 2 ? SampleType::uint16
                                   : SampleType::float32;
    const auto bytes = std::as_bytes(std::span(values));
    for (int i = 0; i < 8; ++i) pixels.samples.insert(pixels.samples.end(), bytes.begin(), bytes.end());
    writePixels(path, pixels);
}

glm::vec4 firstTexel(const Image& image) {
    if (image.format == TexelFormat::rgba8) {
        const auto* t = reinterpret_cast<const std::uint8_t*>(image.texels.data());
        return glm::vec4(t[0], t[1], t[2], t[3]) / 255.f;
    }
    std::uint64_t packed;
    std::memcpy(&packed, image.texels.data(), sizeof packed);
    return glm::unpackHalf4x16(packed);
}

Image decode(const std::filesystem::path& path) {
    const auto file = readFile(path);
    return decodeImage(file, path.filename().string());
}

void expectImage(const Image& image, TexelFormat format, const glm::vec4& texel, float tolerance,
                 bool opaque) {
    EXPECT_EQ(image.width, 4);
    EXPECT_EQ(image.height, 2);
    EXPECT_EQ(image.format, format);
    EXPECT_EQ(image.texels.size(), format == TexelFormat::rgba8 ? 32u : 64u);
    EXPECT_LT(glm::distance(firstTexel(image), texel), tolerance) << image.name;
    EXPECT_EQ(image.opaque, opaque);
}

constexpr float kExact = 1e-6f, kHalf = 5e-4f;  // half floats have 11 bits: 2^-11 below 1

TEST(Images, ChannelsAreExpandedAndAlphaIsStraight) {
    const test::TemporaryFolder folder;
    writeImage<std::uint8_t>(folder / "1.png", {51});
    writeImage<std::uint8_t>(folder / "2.png", {51, 102});
    writeImage<std::uint8_t>(folder / "3.png", {51, 102, 153});
    writeImage<std::uint8_t>(folder / "4.png", {255, 102, 153, 51});
    expectImage(decode(folder / "1.png"), TexelFormat::rgba8, {0.2f, 0.2f, 0.2f, 1}, kExact, true);
    expectImage(decode(folder / "2.png"), TexelFormat::rgba8, {0.2f, 0.2f, 0.2f, 0.4f}, kExact, false);
    expectImage(decode(folder / "3.png"), TexelFormat::rgba8, {0.2f, 0.4f, 0.6f, 1}, kExact, true);
    expectImage(decode(folder / "4.png"), TexelFormat::rgba8, {1, 0.4f, 0.6f, 0.2f}, kExact, false);
}

TEST(Images, Formats) {
    const test::TemporaryFolder folder;
    const std::vector<std::uint8_t> values{51, 102, 153};
    writeImage(folder / "a.jpg", values);
    writeImage(folder / "a.webp", values);
    writeImage(folder / "a.tif", values);
    writeImage(folder / "a.bmp", values);
    constexpr float kLossy = 0.02f;  // JPEG and WebP of one flat colour
    expectImage(decode(folder / "a.jpg"), TexelFormat::rgba8, {0.2f, 0.4f, 0.6f, 1}, kLossy, true);
    expectImage(decode(folder / "a.webp"), TexelFormat::rgba8, {0.2f, 0.4f, 0.6f, 1}, kLossy, true);
    expectImage(decode(folder / "a.tif"), TexelFormat::rgba8, {0.2f, 0.4f, 0.6f, 1}, kExact, true);
    expectImage(decode(folder / "a.bmp"), TexelFormat::rgba8, {0.2f, 0.4f, 0.6f, 1}, kExact, true);
}

TEST(Images, DeepOnesBecomeHalfFloats) {
    const test::TemporaryFolder folder;
    const float nan = std::nanf("");
    writeImage<std::uint16_t>(folder / "a.png", {13107, 26214, 65535});
    writeImage<std::uint16_t>(folder / "a.tif", {13107, 26214, 65535, 32768});
    writeImage<float>(folder / "a.exr", {0.25f, 300, nan});
    writeImage<float>(folder / "b.exr", {1e9f, -1e9f, 0.5f});
    expectImage(decode(folder / "a.png"), TexelFormat::rgba16f, {0.2f, 0.4f, 1, 1}, kHalf, true);
    expectImage(decode(folder / "a.tif"), TexelFormat::rgba16f, {0.2f, 0.4f, 1, 0.5f}, kHalf, false);
    expectImage(decode(folder / "a.exr"), TexelFormat::rgba16f, {0.25f, 300, 0, 1}, kExact, true);
    expectImage(decode(folder / "b.exr"), TexelFormat::rgba16f, {65504, -65504, 0.5f, 1}, kExact, true);
}

TEST(Images, TheFormatIsToldByContentNotByName) {
    const test::TemporaryFolder folder;
    writeImage<std::uint8_t>(folder / "a.png", {51, 102, 153});
    std::filesystem::rename(folder / "a.png", folder / "a.jpg");
    expectImage(decode(folder / "a.jpg"), TexelFormat::rgba8, {0.2f, 0.4f, 0.6f, 1}, kExact, true);
}

// A triangle whose base colour and normal map are texture 0; returns the scene.
Scene loadWithImage(const test::TemporaryFolder& folder, const json& image, bool asColor, bool asData) {
    test::GltfFile file = test::triangleFile();
    file.json["images"] = {image};
    file.json["textures"] = {{{"source", 0}}};
    json material = json::object();
    if (asColor) material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    if (asData) material["normalTexture"]["index"] = 0;
    file.json["materials"] = {material};
    file.json["meshes"][0]["primitives"][0]["material"] = 0;
    return loadGltf(file.saveEmbedded(folder.path()));
}

TEST(GltfImages, FromAFileAndFromADataUriOfAnyFormat) {
    const test::TemporaryFolder folder;
    writeImage<std::uint8_t>(folder / "a.webp", {51, 102, 153});
    const Scene file = loadWithImage(folder, {{"uri", "a.webp"}}, true, false);
    EXPECT_EQ(file.images.at(0).name, "a.webp");
    const std::string uri = "data:image/webp;base64," + test::encodeBase64(readFile(folder / "a.webp"));
    const Scene embedded = loadWithImage(folder, {{"uri", uri}}, true, false);
    EXPECT_EQ(embedded.images.at(0).name, "images[0]");
    EXPECT_EQ(embedded.images[0].texels, file.images[0].texels);
    EXPECT_TRUE(file.textures.at(0).srgb);
}

// EXT_texture_webp: whoever reads WebP takes the extension's image, not the one given for those who do not.
TEST(GltfImages, AWebpTextureIsTakenFromItsExtension) {
    const test::TemporaryFolder folder;
    writeImage<std::uint8_t>(folder / "a.webp", {51, 102, 153});
    writeImage<std::uint8_t>(folder / "a.png", {255, 255, 255});
    for (const bool fallback : {true, false}) {
        test::GltfFile file = test::triangleFile();
        file.json["images"] = {{{"uri", "a.png"}}, {{"uri", "a.webp"}}};
        file.json["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}}};
        if (fallback) file.json["textures"][0]["source"] = 0;
        file.json["extensionsUsed"] = {"EXT_texture_webp"};
        if (!fallback) file.json["extensionsRequired"] = {"EXT_texture_webp"};
        file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
        file.json["meshes"][0]["primitives"][0]["material"] = 0;
        const Scene scene = loadGltf(file.saveEmbedded(folder.path()));
        ASSERT_EQ(scene.images.size(), 1u);
        EXPECT_EQ(scene.images[0].name, "a.webp");
        EXPECT_TRUE(scene.materials[0].baseColorTexture);
    }
}

// Sixteen bits of sRGB have no texture format of their own: they are made linear, the same image as data is
// not.
TEST(GltfImages, DeepColoursAreMadeLinear) {
    const test::TemporaryFolder folder;
    writeImage<std::uint16_t>(folder / "a.png", {32768, 32768, 32768});
    const Scene scene = loadWithImage(folder, {{"uri", "a.png"}}, true, true);
    const Texture color = scene.textures.at(scene.materials[0].baseColorTexture.texture);
    const Texture data = scene.textures.at(scene.materials[0].normalTexture.texture);
    EXPECT_FALSE(color.srgb);
    EXPECT_NEAR(firstTexel(scene.images[color.image]).r, decodeSrgb(0.5f), kHalf);
    EXPECT_NEAR(firstTexel(scene.images[data.image]).r, 0.5f, kHalf);

    writeImage<float>(folder / "a.exr", {0.5f, 0.5f, 0.5f});
    const Scene linear = loadWithImage(folder, {{"uri", "a.exr"}}, true, false);
    EXPECT_FALSE(linear.textures.at(0).srgb);
    EXPECT_EQ(firstTexel(linear.images.at(0)).r, 0.5f);
}

TEST(GltfImages, EntriesOfOneFileAreOneImage) {
    const test::TemporaryFolder folder;
    writeImage<std::uint8_t>(folder / "a.png", {51, 102, 153});
    test::GltfFile file = test::triangleFile();
    file.json["images"] = {{{"uri", "a.png"}}, {{"uri", "a.png"}}};
    file.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
    file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                               {"emissiveTexture", {{"index", 1}}}}};
    file.json["meshes"][0]["primitives"][0]["material"] = 0;
    EXPECT_EQ(loadGltf(file.saveEmbedded(folder.path())).images.size(), 1u);
}

TEST(GltfImages, UnusedOnesAreNotEvenLookedFor) {
    const test::TemporaryFolder folder;
    EXPECT_TRUE(loadWithImage(folder, {{"uri", "absent.png"}}, false, false).images.empty());
}

}  // namespace
}  // namespace cutis
