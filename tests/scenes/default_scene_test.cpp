// The default scene, from the data that set-up fetched. Without the data this fails: run tools/test.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <vector>

#include "renderer/scene/gltf.h"
#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"

namespace cutis::test {
namespace {

TEST(DefaultScene, RendersThreePeople) {
    const std::filesystem::path scene = std::filesystem::path(CUTIS_DATA_DIR) / "default" / "default.gltf";
    ASSERT_TRUE(std::filesystem::exists(scene)) << scene << " is missing: set-up (tools/test) fetches it";
    const int width = 480, height = 270;
    const Rendered result =
        renderFile(scene, {}, width, height, {"character", "irradiance", "diffuse", "thickness"});
    EXPECT_EQ(result.stats.nonfinite, 0);
    EXPECT_GE(result.stats.characters, 3);
    EXPECT_EQ(countNonfinite(result.picture), 0u);

    std::map<int, int> pixelsOfCharacter;
    std::map<int, glm::dvec3> light;
    std::vector<double> luminances;
    int covered = 0, thin = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            covered += valueAt(result.picture, x, y, 3) > 0.5;
            const int character = static_cast<int>(std::lround(valueAt(result.aov("character"), x, y)));
            if (character == 0) continue;
            ++pixelsOfCharacter[character];
            light[character] += rgbAt(result.picture, x, y);
            luminances.push_back(dot(rgbAt(result.picture, x, y), {0.2126, 0.7152, 0.0722}));
            const double thickness = valueAt(result.aov("thickness"), x, y);
            thin += thickness > 0 && thickness < 10;
        }
    const double pixels = double(width) * height;
    EXPECT_GT(covered / pixels, 0.15);
    ASSERT_GE(pixelsOfCharacter.size(), 3u);
    for (const auto& [character, count] : pixelsOfCharacter)
        EXPECT_GT(count / pixels, 0.02) << "character " << character << " is hardly seen";
    EXPECT_GT(thin, 20) << "nothing thin is lit from behind: no ear glows";

    // A plausible exposure: half of the skin between deep shadow and white, and none of it absurd.
    std::sort(luminances.begin(), luminances.end());
    const double median = luminances[luminances.size() / 2], top = luminances[luminances.size() * 99 / 100];
    reportFigure("default scene median skin luminance", median);
    reportFigure("default scene 99th percentile of skin luminance", top);
    EXPECT_GT(median, 0.02);
    EXPECT_LT(median, 1);
    EXPECT_LT(top, 10);
    EXPECT_GT(top / median, 1.3) << "lit skin has a bright side";

    // Skin is reddish under a rig that is near white, and the three complexions differ.
    std::vector<double> means;
    for (const auto& [character, sum] : light) {
        EXPECT_GT(sum.r, sum.b) << "character " << character;
        means.push_back(sum.g / pixelsOfCharacter[character]);
    }
    const auto [least, most] = std::minmax_element(means.begin(), means.end());
    EXPECT_GT(*most / *least, 1.1);
}

// What is not skin: each pair of eyes lies behind clear corneas, and shirts have a sheen.
TEST(DefaultScene, EyesHaveCorneasAndShirtsASheen) {
    const std::filesystem::path file = std::filesystem::path(CUTIS_DATA_DIR) / "default" / "default.gltf";
    const Scene scene = loadGltf(file, {.skin = {}, .images = false});
    int corneas = 0, shirts = 0;
    for (const Node& node : scene.nodes) {
        if (node.mesh < 0) continue;
        const Material& material = scene.materials[scene.meshes[node.mesh].primitives.at(0).material];
        corneas += node.name.ends_with("cornea") && material.transmission == 1 && !material.skin;
        shirts += node.name.ends_with("shirt") && material.sheen.color.r > 0;
    }
    EXPECT_EQ(corneas, 6);
    EXPECT_EQ(shirts, 3);
}

}  // namespace
}  // namespace cutis::test
