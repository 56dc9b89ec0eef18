// What lies over metallic-roughness (docs/model.md, "Everything else"): closed forms, no gain of light, the
// exact reference, and what hair and glass do to the light behind them.
#include "renderer/reference/layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "shaders/shared/sheen.h"
#include "tests/reference/evaluate.h"
#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr double kPi = std::numbers::pi;

Picture whiteRoom() {
    return makeEnvironment(64, 32, [](const glm::dvec3&) { return glm::dvec3(1); });
}

// The share of light that the shader takes a sheen to reflect is a fit; the reference's is quadrature.
TEST(Sheen, ItsAlbedoIsFittedToQuadrature) {
    double worst = 0;
    for (double r = 0.1; r <= 1; r += 0.05) {
        for (double root = 0.1; root <= 1; root += 0.05) {
            const double mu = root * root, exact = std::min(reference::sheenAlbedo(mu, r), 1.0);
            const double fit = std::min<double>(shared::sheenAlbedo(float(mu), float(r)), 1);
            worst = std::max(worst, std::abs(fit - exact));
        }
    }
    expectAtMost("sheen: fit of its albedo", worst, 0.025);
}

// A sum over directions, in no way that the table is made: what the lobe reflects is that share, and never
// above 1.
TEST(Sheen, TheLobeReflectsItsAlbedo) {
    constexpr int kRows = 400, kColumns = 400;
    double worst = 0;
    for (const double r : {0.15, 0.3, 0.6, 1.0}) {
        for (const double mu : {0.1, 0.3, 0.7, 1.0}) {
            const glm::dvec3 n(0, 0, 1), v(std::sqrt(1 - mu * mu), 0, mu);
            double sum = 0;  // over equal parts of ∫ cosθ dω = π
            for (int i = 0; i < kRows; ++i)
                for (int j = 0; j < kColumns; ++j) {
                    const double sine = std::sqrt((i + 0.5) / kRows), phi = 2 * kPi * (j + 0.5) / kColumns;
                    const glm::dvec3 l(sine * std::cos(phi), sine * std::sin(phi),
                                       std::sqrt(1 - sine * sine));
                    sum += reference::sheenLobe(n, v, l, r) * kPi / (kRows * kColumns);
                }
            worst = std::max(worst, std::abs(sum - std::min(reference::sheenAlbedo(mu, r), 1.0)));
            EXPECT_LE(sum, 1.005) << r << " " << mu;
        }
    }
    expectAtMost("sheen: lobe against its albedo", worst, 0.005);
}

// White, dielectric without a reflection of its own.
Material plain(const std::string& name, double grey = 1) {
    Material material;
    material.name = name;
    material.baseColor = glm::vec4(glm::vec3(static_cast<float>(grey)), 1);
    material.metallic = 0;
    material.roughness = 1;
    material.dielectric.specular = 0;
    return material;
}

Material velvet(double grey, const glm::vec3& color, float roughness) {
    Material material = plain("velvet", grey);
    material.sheen = {.color = color, .roughness = roughness, .colorTexture = {}, .roughnessTexture = {}};
    return material;
}

Material coated(double grey, float roughness) {
    Material material = plain("coated", grey);
    material.clearcoat.factor = 1;
    material.clearcoat.roughness = roughness;
    return material;
}

Rendered renderBall(const Material& material) {
    SceneBuilder builder;
    builder.addObject("ball", makeSphere(50 * kMm, SphereMapping::latLong), builder.addMaterial(material));
    builder.setOrthographicCamera({0, 0, 0.5}, {0, 0, 0}, 0.11);
    RenderJob job{.scene = builder.scene(), .width = 48, .height = 48};
    job.environment = whiteRoom();
    return render(job);
}

// A white room leaves a white ball white at the most, whatever lies over it; where the sheen takes nothing
// away it is white.
TEST(Layers, NoneGainsLightInAWhiteRoom) {
    Material both = velvet(1, glm::vec3(1), 0.5f);
    both.clearcoat.factor = 1;
    const std::vector<std::pair<const char*, Material>> cases{{"sheen 0.1", velvet(1, glm::vec3(1), 0.1f)},
                                                              {"sheen 1", velvet(1, glm::vec3(1), 1)},
                                                              {"coat 0", coated(1, 0)},
                                                              {"coat 1", coated(1, 1)},
                                                              {"both", both}};
    for (const auto& [name, material] : cases) {
        const Picture picture = renderBall(material).picture;
        double brightest = 0;
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x) brightest = std::max(brightest, valueAt(picture, x, y));
        expectAtMost(std::string("white room, ") + name + ": above 1", brightest - 1, 0.01);
        EXPECT_GT(valueAt(picture, 24, 24), 0.9) << name;
    }
}

// Of a uniform room a black ball shows the layer alone, at the centre at normal incidence.
TEST(Layers, AloneTheyReflectTheirAlbedo) {
    for (const float r : {0.3f, 0.6f, 1.0f}) {
        const glm::vec3 color(0.8f, 0.4f, 0.2f);
        const Picture picture = renderBall(velvet(0, color, r)).picture;
        for (int c = 0; c < 3; ++c) {
            const double exact = color[c] * reference::sheenAlbedo(1, r);
            expectAtMost("velvet " + std::to_string(r) + " channel " + std::to_string(c),
                         std::abs(valueAt(picture, 24, 24, c) - exact), 0.01);
        }
    }
    expectAtMost("coat on black", std::abs(valueAt(renderBall(coated(0, 0)).picture, 24, 24) - 0.04), 1e-4);
    expectAtMost("coat on white", std::abs(valueAt(renderBall(coated(1, 0)).picture, 24, 24) - 1), 0.001);
    // Index of refraction 2 reflects 1/9; its colour tints that; the factor scales all of it.
    Material glossy = plain("glossy", 0);
    glossy.roughness = 0.05f;
    glossy.dielectric = {.ior = 2,
                         .specular = 0.5f,
                         .specularColor = {1, 0.5f, 0},
                         .specularTexture = {},
                         .specularColorTexture = {}};
    const Picture picture = renderBall(glossy).picture;
    for (int c = 0; c < 3; ++c) {
        const double exact = 0.5 / 9 * glossy.dielectric.specularColor[c];
        expectAtMost("index of refraction 2, channel " + std::to_string(c),
                     std::abs(valueAt(picture, 24, 24, c) - exact), 1e-4);
    }
}

Material glass(const glm::vec3& color, float transmission) {
    Material material;
    material.name = "glass";
    material.baseColor = glm::vec4(color, 1);
    material.metallic = 0, material.roughness = 0;
    material.transmission = transmission;
    material.doubleSided = true;
    return material;
}

glm::dmat4 at(const glm::dvec3& place) {
    return glm::translate(glm::dmat4(1), place);
}

// Straight through two panes: the product of their colours and of what their faces do not reflect.
TEST(Glass, ShowsWhatIsBehindInItsColour) {
    SceneBuilder builder;
    Material lamp = plain("lamp");
    lamp.unlit = true;
    builder.addObject("lamp", makePlate(0.2), builder.addMaterial(lamp));
    builder.addObject("red", makePlate(0.2), builder.addMaterial(glass({1, 0.5f, 0.25f}, 0.75f)),
                      at({0, 0, 0.02}));
    builder.addObject("blue", makePlate(0.2), builder.addMaterial(glass({0.5f, 0.5f, 1}, 1)),
                      at({0, 0, 0.01}));
    builder.setOrthographicCamera({0, 0, 0.5}, {0, 0, 0}, 0.1);
    const Picture picture = render({.scene = builder.scene(), .width = 16, .height = 16}).picture;
    const glm::dvec3 exact = glm::dvec3(0.5, 0.25, 0.25) * (0.75 * 0.96 * 0.96);
    for (int c = 0; c < 3; ++c)
        expectAtMost("two panes, channel " + std::to_string(c),
                     std::abs(valueAt(picture, 8, 8, c) - exact[c]), 1e-5);
    EXPECT_NEAR(valueAt(picture, 8, 8, 3), 1, 1e-5) << "a lamp behind glass covers all the same";
}

// What arrives on skin under a pane, of light straight from above.
Rendered underPane(const Material& pane) {
    SceneBuilder builder;
    builder.addObject("plate", makePlate(40 * kMm), builder.addSkin(SceneBuilder::plainSkin()));
    builder.addObject("pane", makePlate(120 * kMm), builder.addMaterial(pane), at({0, 0, 0.1}));
    builder.setOrthographicCamera({0, 0, 0.05}, {0, 0, 0}, 0.02);
    RenderJob job{.scene = builder.scene(), .width = 48, .height = 48, .irradianceSize = 256};
    job.lights = {directionalLight("sun", {0, 0, -1}, 1)};
    job.aovs = {"irradiance"};
    return render(job);
}

TEST(Glass, ItsShadowIsWhatItStops) {
    struct Case {
        const char* name;
        Material material;
        double passed, noise;
    };
    // A light map holds one number for all colours: the mean of what passes. Glass as clear as a cornea casts
    // no shadow.
    const Case cases[] = {{"tinted", glass({0.9f, 0.6f, 0.3f}, 0.5f), 0.5 * 0.96 * 0.6, 0.15},
                          {"cornea", glass({1, 1, 1}, 1), 1, 1e-5}};
    for (const Case& pane : cases) {
        const Picture irradiance = underPane(pane.material).aov("irradiance");
        double sum = 0, spread = 0;
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 48; ++x) {
                const double value = valueAt(irradiance, x, y);
                sum += value / (48 * 48), spread += (value - pane.passed) * (value - pane.passed) / (48 * 48);
            }
        expectAtMost(std::string("mean behind glass, ") + pane.name, std::abs(sum - pane.passed), 0.004);
        expectAtMost(std::string("spread behind glass, ") + pane.name, std::sqrt(spread), pane.noise);
    }
}

Material hair(double alpha, AlphaMode mode) {
    Material material = plain("hair", 0.2);
    material.baseColor.a = static_cast<float>(alpha);
    material.alphaMode = mode;
    material.doubleSided = true;
    return material;
}

// A slab of 2 mm lit from behind through a card, seen from the front.
Rendered slabBehind(const Material* card) {
    SceneBuilder builder;
    builder.addObject("slab", makeBox(glm::dvec3(-60, -60, -2) * kMm, glm::dvec3(60, 60, 0) * kMm),
                      builder.addSkin(SceneBuilder::plainSkin()));
    if (card) builder.addObject("card", makePlate(200 * kMm), builder.addMaterial(*card), at({0, 0, -0.02}));
    builder.setOrthographicCamera({0, 0, 0.1}, {0, 0, 0}, 40 * kMm);
    RenderJob job{.scene = builder.scene(), .width = 48, .height = 48};
    job.lights = {directionalLight("back", {0, 0, 1}, 1)};
    job.aovs = {"diffuse", "thickness"};
    return render(job);
}

double meanOf(const Picture& picture) {
    double sum = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) sum += valueAt(picture, x, y);
    return sum / (double(picture.width) * picture.height);
}

// Hair in front of a lit ear is no part of it: what shines through is dimmed once, by what the hair covers,
// and measures the ear's own thickness. What covers all of it leaves nothing to shine through.
TEST(Hair, IsNoTranslucentSource) {
    const Rendered open = slabBehind(nullptr);
    const double bright = meanOf(open.aov("diffuse"));
    ASSERT_GT(bright, 0.01);
    for (const double alpha : {0.25, 0.5}) {
        const Material card = hair(alpha, AlphaMode::blend);
        const Rendered veiled = slabBehind(&card);
        const std::string name = "behind hair of alpha " + std::to_string(alpha).substr(0, 4);
        expectAtMost(name + ": mean light", std::abs(meanOf(veiled.aov("diffuse")) / bright - (1 - alpha)),
                     0.02);
        double thinnest = 1e9;
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 48; ++x)
                thinnest = std::min(thinnest, valueAt(veiled.aov("thickness"), x, y));
        expectAtMost(name + ": thickness", std::abs(thinnest / 2 - 1), 1e-4);
    }
    for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
        const Material solid = hair(1, mode);
        const Rendered dark = slabBehind(&solid);
        EXPECT_LT(meanOf(dark.aov("diffuse")), 0.01 * bright);
        EXPECT_EQ(valueAt(dark.aov("thickness"), 24, 24), 60000) << "a card is no skin";
    }
}

// A card that hovers 1 mm above skin that the light meets first: skin is lit from its front, and what lies on
// it makes no thickness.
TEST(Hair, AboveSkinIsNoThickness) {
    SceneBuilder builder;
    builder.addObject("plate", makeBox(glm::dvec3(-60, -60, -80) * kMm, glm::dvec3(60, 60, 0) * kMm),
                      builder.addSkin(SceneBuilder::plainSkin()));
    builder.addObject("card", makePlate(20 * kMm), builder.addMaterial(hair(0.5, AlphaMode::blend)),
                      at({0, 0, 0.001}));
    builder.setOrthographicCamera({0, 0, 0.1}, {0, 0, 0}, 40 * kMm);
    RenderJob job{.scene = builder.scene(), .width = 32, .height = 32};
    job.lights = {directionalLight("front", {0, 0, -1}, 1)};
    job.aovs = {"thickness"};
    const Rendered result = render(job);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) ASSERT_EQ(valueAt(result.aov("thickness"), x, y), 60000);
}

// A coated ball, a velvet one, a glass card and hair cards (blended, masked by a texture of stripes) over
// skin, under a lamp and a sky.
SceneBuilder zoo() {
    SceneBuilder builder;
    SkinMaterial skin = SceneBuilder::plainSkin();
    skin.specular = 1;
    builder.addObject("plate", makePlate(200 * kMm), builder.addSkin(skin, {0.8, 0.5, 0.4}));
    Material red = coated(1, 0.2f);
    red.baseColor = {0.7f, 0.05f, 0.05f, 1};
    red.roughness = 0.6f;
    red.dielectric = {};
    builder.addObject("coated", makeSphere(22 * kMm, SphereMapping::latLong), builder.addMaterial(red),
                      at({-0.055, 0.03, 0.03}));
    builder.addObject("velvet", makeSphere(22 * kMm, SphereMapping::latLong),
                      builder.addMaterial(velvet(0.1, {0.5f, 0.3f, 0.8f}, 0.4f)), at({0, 0.03, 0.03}));
    builder.addObject("glass", makePlate(40 * kMm), builder.addMaterial(glass({0.6f, 0.8f, 0.7f}, 0.9f)),
                      at({0.055, 0.03, 0.02}));
    builder.addObject("blend", makePlate(40 * kMm), builder.addMaterial(hair(0.6, AlphaMode::blend)),
                      at({-0.03, -0.035, 0.02}));
    builder.addObject("mask", makePlate(30 * kMm), builder.addMaterial(hair(0.9, AlphaMode::mask)),
                      at({0.03, -0.035, 0.01}));
    builder.setOrthographicCamera({0, 0, 0.5}, {0, 0, 0}, 0.18);
    return builder;
}

TEST(Layers, TheRendererAgreesWithTheReference) {
    const Picture sky = makeEnvironment(
        64, 32, [](const glm::dvec3& d) { return glm::dvec3(0.3, 0.4, 0.5) * (1.2 + d.y + 0.5 * d.x); });
    const std::vector<Light> lights{directionalLight("sun", glm::normalize(glm::dvec3(0.4, -0.5, -1)), 2)};
    RenderJob job{.scene = zoo().scene(), .lights = lights, .environment = sky, .width = 60, .height = 60};
    const Picture fast = render(job).picture;
    const reference::Result exact = evaluate({.scene = zoo().scene(),
                                              .lights = lights,
                                              .environment = sky,
                                              .width = 60,
                                              .height = 60,
                                              .passes = 8});
    reportFigure("zoo: noise of the reference", exact.pictureError);
    expectAtMost("zoo: relative L2 against the reference", relativeL2(fast, exact.picture), 0.05);
}

}  // namespace
}  // namespace cutis::test
