// What is not skin: metallic-roughness materials under the same lights, and transparent ones in order.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr int kSize = 64;

Picture whiteRoom() {
    return makeEnvironment(64, 32, [](const glm::dvec3&) { return glm::dvec3(1); });
}

Rendered renderBall(const Material& material) {
    SceneBuilder builder;
    builder.addObject("ball", makeSphere(50 * kMm, SphereMapping::latLong), builder.addMaterial(material));
    builder.setOrthographicCamera({0, 0, 0.5}, {0, 0, 0}, 0.11);
    RenderJob job{.scene = builder.scene(), .width = kSize, .height = kSize};
    job.environment = whiteRoom();
    return render(job);
}

// A metal reflects a uniform room as its own colour, where Schlick's edge brightening has not begun.
TEST(Material, SmoothMetalInAWhiteRoomHasItsOwnColour) {
    Material gold;
    gold.name = "gold";
    gold.baseColor = {1.0f, 0.77f, 0.34f, 1};
    gold.metallic = 1, gold.roughness = 0.1f;
    const Rendered result = renderBall(gold);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(valueAt(result.picture, kSize / 2, kSize / 2, c), gold.baseColor[c], 0.02)
            << "channel " << c;
}

// A dielectric gives back albedo·(1 - F) + F of a white room, F between 4 % and that of single scattering.
TEST(Material, DielectricInAWhiteRoomGivesBackItsAlbedoAndAReflection) {
    Material grey;
    grey.name = "grey";
    grey.baseColor = {0.5f, 0.5f, 0.5f, 1};
    grey.metallic = 0, grey.roughness = 0.6f;
    const Rendered result = renderBall(grey);
    const double value = valueAt(result.picture, kSize / 2, kSize / 2);
    EXPECT_GT(value, 0.48);
    EXPECT_LT(value, 0.56);
}

// Nothing gains light: white, rough or smooth, metal or not, in a white room.
TEST(Material, NoneGainsLight) {
    for (const float metallic : {0.0f, 1.0f})
        for (const float roughness : {0.05f, 1.0f}) {
            Material white;
            white.name = "white";
            white.metallic = metallic, white.roughness = roughness;
            const Rendered result = renderBall(white);
            for (int y = 0; y < kSize; ++y)
                for (int x = 0; x < kSize; ++x)
                    ASSERT_LE(valueAt(result.picture, x, y), 1.02) << metallic << " " << roughness;
        }
}

Material flat(const std::string& name, const glm::vec4& color, AlphaMode mode) {
    Material material;
    material.name = name;
    material.baseColor = color;
    material.alphaMode = mode;
    material.unlit = true;
    material.doubleSided = true;
    return material;
}

// Sheets of unlit colour across the view at heights z, in the order given.
struct Sheet {
    Material material;
    double z;
};

Rendered renderSheets(const std::vector<Sheet>& sheets) {
    SceneBuilder builder;
    for (const Sheet& sheet : sheets)
        builder.addObject(sheet.material.name, makePlate(0.2), builder.addMaterial(sheet.material),
                          glm::translate(glm::dmat4(1), glm::dvec3(0, 0, sheet.z)));
    builder.setOrthographicCamera({0, 0, 0.5}, {0, 0, 0}, 0.1);
    RenderJob job{.scene = builder.scene(), .width = 16, .height = 16};
    return render(job);
}

void expectColor(const Rendered& result, const glm::dvec4& color) {
    for (int c = 0; c < 4; ++c)
        EXPECT_NEAR(valueAt(result.picture, 8, 8, c), color[c], 2e-3) << "channel " << c;
}

const Material kRed = flat("red", {1, 0, 0, 1}, AlphaMode::opaque);
const Material kGreen = flat("green", {0, 1, 0, 0.5f}, AlphaMode::blend);
const Material kBlue = flat("blue", {0, 0, 1, 0.25f}, AlphaMode::blend);

TEST(Transparency, BlendsOverWhatIsBehindInOrderOfDepth) {
    // Blue over green over red, whatever the order in the file: 0.25 B + 0.75 (0.5 G + 0.5 R).
    const glm::dvec4 expected(0.375, 0.375, 0.25, 1);
    expectColor(renderSheets({{kRed, 0}, {kGreen, 0.01}, {kBlue, 0.02}}), expected);
    expectColor(renderSheets({{kBlue, 0.02}, {kGreen, 0.01}, {kRed, 0}}), expected);
    // Green over blue over red.
    expectColor(renderSheets({{kBlue, 0.01}, {kRed, 0}, {kGreen, 0.02}}), {0.375, 0.5, 0.125, 1});
}

TEST(Transparency, IsHiddenByWhatIsOpaqueInFront) {
    expectColor(renderSheets({{kGreen, -0.01}, {kRed, 0}}), {1, 0, 0, 1});
}

TEST(Transparency, CoversInPartWhereNothingIsBehind) {
    EXPECT_NEAR(valueAt(renderSheets({{kGreen, 0}}).picture, 8, 8, 3), 0.5, 2e-3);
}

TEST(Transparency, MasksByTheCutoff) {
    Material mask = flat("mask", {0, 1, 0, 0.4f}, AlphaMode::mask);
    mask.alphaCutoff = 0.5f;
    expectColor(renderSheets({{kRed, 0}, {mask, 0.01}}), {1, 0, 0, 1});
    mask.alphaCutoff = 0.3f;  // passes: opaque, whatever its alpha
    expectColor(renderSheets({{kRed, 0}, {mask, 0.01}}), {0, 1, 0, 1});
}

}  // namespace
}  // namespace cutis::test
