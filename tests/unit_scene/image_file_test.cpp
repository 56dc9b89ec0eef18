// Image files that are cut off or claim more than they hold: refused before a decoder makes up the rest.
#include <gtest/gtest.h>

#include <random>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/scene/environment.h"
#include "renderer/scene/image_io.h"
#include "tests/support/lying_png.h"
#include "tests/support/process.h"

namespace cutis {
namespace {

enum class Content { flat, noise };

// A file of width × height texels in the format of that name's extension.
std::string encoded(const char* name, int width, int height, int channels, Content content) {
    const test::TemporaryFolder folder;
    Pixels pixels{{width, height, channels, SampleType::uint8}, {}};
    pixels.samples.resize(pixels.layout.bytes(), std::byte(100));
    std::mt19937 random(1);
    if (content == Content::noise)
        for (std::byte& b : pixels.samples) b = static_cast<std::byte>(random() & 255);
    writePixels(folder / name, pixels);
    const std::vector<std::byte> file = readFile(folder / name);
    return {reinterpret_cast<const char*>(file.data()), file.size()};
}

// What decoding says is wrong with a file, as a texture and as an environment; nothing when it is read.
void expectRead(const std::string& file, const char* name, const char* why) {
    const auto expect = [&](const std::string& said) {
        if (*why)
            EXPECT_NE(said.find(why), std::string::npos) << name << ", " << file.size() << " bytes: " << said;
        else
            EXPECT_EQ(said, "") << name;
    };
    const auto wrongWith = [](const auto& read) -> std::string {
        try {
            read();
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    };
    const test::TemporaryFolder folder;
    writeFileAtomically(folder / name, file);
    expect(wrongWith([&] { decodeImage(std::as_bytes(std::span(file)), name); }));
    expect(wrongWith([&] { loadEnvironment(folder / name); }));
}

TEST(ImageFile, CutOffFilesOfAnyFormatAreRefused) {
    for (const char* name : {"a.png", "a.jpg", "a.webp", "a.tif", "a.bmp"}) {
        const std::string file = encoded(name, 60, 40, 3, Content::noise);
        expectRead(file, name, "");
        for (const double part : {0.2, 0.5, 0.9})
            expectRead(file.substr(0, std::size_t(part * double(file.size()))), name, "cannot read image");
    }
}

TEST(ImageFile, AJpegEndsWithItsMarker) {
    const std::string file = encoded("a.jpg", 60, 40, 3, Content::noise);
    for (std::size_t bytes = 3; bytes < file.size(); bytes += 101)
        ASSERT_THROW(decodeImage(std::as_bytes(std::span(file).first(bytes)), "a.jpg"), Error) << bytes;
    expectRead(file.substr(0, file.size() - 2), "a.jpg", "truncated");
    expectRead(file + "some camera's notes", "a.jpg", "");
}

// Even of one colour: a bit for each code of each block, which the bound must not exceed.
TEST(ImageFile, AJpegMayHoldAsLittleAsItsFormatAllows) {
    for (const int channels : {1, 3})
        for (const auto& [width, height] : {std::pair{1, 1}, {8, 8}, {9, 17}, {640, 480}})
            expectRead(encoded("a.jpg", width, height, channels, Content::flat), "a.jpg", "");
}

TEST(ImageFile, AJpegThatClaimsMoreThanItsDataCanHoldIsRefused) {
    const std::string file = encoded("a.jpg", 64, 64, 3, Content::flat);
    expectRead(test::lyingJpeg(file, 64, 64), "a.jpg", "");
    expectRead(test::lyingJpeg(file, 5400, 2700), "a.jpg", "cannot hold 5400 x 2700 texels");
}

TEST(ImageFile, AnEnvironmentIsToldByContent) {
    expectRead(encoded("a.png", 60, 40, 3, Content::noise), "a.exr", "");
    expectRead("ffconcat version 1.0\nfile other.exr\nduration 1\n", "a.avi",
               "not an image of a known format");
    expectRead("", "a.null", "not an image of a known format");
}

}  // namespace
}  // namespace cutis
