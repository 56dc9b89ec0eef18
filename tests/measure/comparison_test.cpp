#include "renderer/measure/comparison.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "renderer/core/files.h"

namespace cutis {
namespace {

ComparedPicture picture(const std::string& name, float value, float alpha = 1) {
    Picture made{4, 4, 4, {}};
    for (int i = 0; i < 16; ++i) made.values.insert(made.values.end(), {value, value, value, alpha});
    return {name, made, 0};
}

TEST(Comparison, FiguresAreThoseOfTheDifference) {
    const Difference difference = differenceOf(picture("half", 0.5f), picture("whole", 1));
    EXPECT_NEAR(difference.figures.relativeL2, 0.5, 1e-9);
    EXPECT_NEAR(difference.lightRatio, 0.5, 1e-9);
    EXPECT_NEAR(difference.map.values[5], 0.5, 1e-6);
    EXPECT_GT(difference.flip, 0.05);
    const Difference none = differenceOf(picture("a", 0.7f), picture("b", 0.7f));
    EXPECT_EQ(none.figures.relativeL2, 0);
    EXPECT_EQ(none.flip, 0);
}

TEST(Comparison, CountsPixelsThatEitherCovers) {
    EXPECT_EQ(differenceOf(picture("seen", 1, 1), picture("empty", 0, 0)).figures.values, 48u);
    EXPECT_EQ(differenceOf(picture("empty", 0, 0), picture("empty", 0, 0)).figures.values, 0u);
}

TEST(Comparison, WritesPicturesMapsFiguresAndAPage) {
    const auto folder = std::filesystem::temp_directory_path() / ("cutis-compare-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    writeComparison(folder, "A & B", {picture("all", 1), picture("key/light", 0.6f), picture("key light", 0.4f)});
    // Names that differ in what a file name cannot hold get files of their own.
    for (const char* name : {"all.png", "all.exr", "key-light.png", "key-light.exr", "key-light-difference.png",
                             "key-light-flip.png", "key-light-2.png", "key-light-2-flip.png", "compare.csv", "index.html"})
        EXPECT_GT(std::filesystem::file_size(folder / name), 50u) << name;
    const auto bytes = readFile(folder / "compare.json");
    const auto json = nlohmann::json::parse(reinterpret_cast<const char*>(bytes.data()),
                                            reinterpret_cast<const char*>(bytes.data()) + bytes.size());
    EXPECT_EQ(json["base"], "all");
    ASSERT_EQ(json["pictures"].size(), 2u);
    EXPECT_EQ(json["pictures"][0]["name"], "key/light");
    EXPECT_NEAR(json["pictures"][0]["rel_l2"], 0.4, 1e-6);
    EXPECT_NEAR(json["pictures"][1]["light_ratio"], 0.4, 1e-6);
    const auto page = readFile(folder / "index.html");
    EXPECT_NE(std::string(reinterpret_cast<const char*>(page.data()), page.size()).find("A &amp; B"), std::string::npos);
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace cutis
