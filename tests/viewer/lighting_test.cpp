// Picking, placing lights by what they do, the mixer and overlays: no window, no device.
#include <gtest/gtest.h>

#include "app/viewer/mixer.h"
#include "app/viewer/orbit_camera.h"
#include "app/viewer/overlay.h"
#include "app/viewer/pick.h"
#include "app/viewer/place_by_light.h"
#include "renderer/frame/renderer.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/characters.h"
#include "tests/cli/program.h"

namespace cutis::test {
namespace {

using namespace app;

TEST(Pick, FindsTheNearestOpaqueSurfaceUnderTheMouse) {
    Scene scene = twoHeads();
    const Bounds anna = headBounds(scene, "Anna");
    const Camera camera = orbitCamera(anna.centre(), 0, 0, 2, 0.35, 1);
    const Ray ray = rayThrough(camera, 1, 0.5, 0.5);
    const std::optional<Hit> hit = pick(scene, ray);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(glm::length(hit->position - glm::dvec3(anna.centre().x, anna.centre().y, anna.max.z)), 0,
                1e-6);
    EXPECT_NEAR(hit->distance, 2 - anna.size().z / 2, 1e-6);
    EXPECT_GT(hit->normal.z, 0);
    EXPECT_EQ(scene.characters[std::size_t(scene.nodeCharacter[std::size_t(hit->node)])].name, "Anna");
    EXPECT_FALSE(pick(scene, rayThrough(camera, 1, 0.02, 0.02)));
    for (Material& material : scene.materials) material.alphaMode = AlphaMode::blend;
    EXPECT_FALSE(pick(scene, ray)) << "what is seen through does not count";
}

TEST(Pick, RayGoesWhereTheCameraProjectsFrom) {
    const Camera camera = orbitCamera({0.3, 1.2, -0.4}, 40, 15, 2, 0.5, 1.5);
    const glm::dvec3 point(0.5, 1.0, -0.2);
    const glm::dvec3 seen = project(camera, 1.5, point);
    const Ray ray = rayThrough(camera, 1.5, seen.x, seen.y);
    EXPECT_NEAR(glm::length(glm::cross(point - ray.origin, ray.direction)), 0, 1e-12);
}

Hit pointOfSkin() {
    Hit hit;
    hit.position = {0.05, 1.6, 0.1};
    hit.normal = glm::normalize(glm::dvec3(0.3, 0.2, 1));
    return hit;
}

const glm::dvec3 kEye(0.2, 1.7, 2.5), kHead(0, 1.6, 0);

glm::dvec3 placeOf(const Light& light) {
    const double az = glm::radians(light.place->azimuth), el = glm::radians(light.place->elevation);
    return kHead + light.place->distance *
                       glm::dvec3(std::sin(az) * std::cos(el), std::sin(el), std::cos(az) * std::cos(el));
}

// The mirror condition: the normal lies half way between light and eye.
double offMirror(const Hit& hit, const glm::dvec3& towardsLight) {
    const glm::dvec3 half = glm::normalize(towardsLight) + glm::normalize(kEye - hit.position);
    return glm::length(glm::cross(glm::normalize(half), hit.normal));
}

TEST(PlaceByLight, TheHighlightLiesAtThePoint) {
    const Hit hit = pointOfSkin();
    Light placed;
    placed.type = LightType::spot;
    placed.place = Placement{"*", -120, 10, 1.4};
    placeByLight(placed, PlaceBy::highlight, hit, kEye, kHead);
    EXPECT_NEAR(offMirror(hit, placeOf(placed) - hit.position), 0, 1e-9);
    EXPECT_NEAR(placed.place->distance, 1.4, 1e-9);

    Light free;
    free.type = LightType::rect;
    free.position = {2, 2, 0};
    const double before = glm::length(free.position - hit.position);
    placeByLight(free, PlaceBy::highlight, hit, kEye, kHead);
    EXPECT_NEAR(offMirror(hit, free.position - hit.position), 0, 1e-9);
    EXPECT_NEAR(glm::length(free.position - hit.position), before, 1e-9);
    EXPECT_NEAR(glm::length(glm::normalize(hit.position - free.position) - free.direction), 0, 1e-9);

    Light sun;
    sun.type = LightType::directional;
    placeByLight(sun, PlaceBy::highlight, hit, kEye, kHead);
    EXPECT_NEAR(offMirror(hit, -sun.direction), 0, 1e-9);
}

TEST(PlaceByLight, TheShadowBeginsAtThePointOnTheSideOfTheLight) {
    const Hit hit = pointOfSkin();
    Light light;
    light.type = LightType::point;
    light.place = Placement{"*", 40, 20, 1.4};
    const glm::dvec3 before = placeOf(light) - hit.position;
    placeByLight(light, PlaceBy::shadowEdge, hit, kEye, kHead);
    const glm::dvec3 after = placeOf(light) - hit.position;
    EXPECT_NEAR(glm::dot(glm::normalize(after), hit.normal), 0, 1e-9);
    EXPECT_GT(glm::dot(after, before), 0);
}

Document mixedDocument() {
    Document document;
    addLight(document, LightType::spot);
    addLight(document, LightType::point);
    document.rig.environment.file = "/studio.exr";
    return document;
}

std::shared_ptr<const Picture> plain(float red, float alpha) {
    return std::make_shared<const Picture>(Picture{2, 1, 4, {red, 0, 0, alpha, red, 0, 0, alpha}});
}

TEST(Aim, TheLightStandsFreeAndShinesAtThePoint) {
    Document document;
    Light& light = document.rig.lights.at(static_cast<std::size_t>(addLight(document, LightType::spot)));
    const double intensity = light.intensity;
    aimAt(light, {0, 2, 1}, {0, 1, 0});
    EXPECT_FALSE(light.place);
    EXPECT_EQ(light.position, glm::dvec3(0, 2, 1));
    EXPECT_NEAR(glm::length(light.direction - glm::normalize(glm::dvec3(0, -1, -1))), 0, 1e-12);
    EXPECT_EQ(light.intensity, intensity);
    aimAt(light, {0, 1, 0}, {0, 1, 0});  // nowhere to shine to: nothing happens
    EXPECT_EQ(light.position, glm::dvec3(0, 2, 1));
}

TEST(Mixer, APictureIsTheSumOfItsLights) {
    Document document = mixedDocument();
    std::vector<Contribution> own = contributionsOf(document);
    ASSERT_EQ(own.size(), 3u);
    EXPECT_TRUE(own[2].ofEnvironment);
    own[0].picture = plain(1, 0.5f);
    own[1].picture = plain(2, 0.5f);
    own[2].picture = plain(4, 1);
    EXPECT_FLOAT_EQ(mix(own, document).values[0], 7);
    EXPECT_FLOAT_EQ(mix(own, document).values[3], 1);
    document.rig.lights[0].intensity *= 3;
    document.rig.lights[1].enabled = false;
    document.rig.environment.intensity *= 0.5;
    EXPECT_TRUE(canMix(own, document));
    EXPECT_FLOAT_EQ(mix(own, document).values[0], 3 * 1 + 0 + 0.5f * 4);
    document.solo = {false, true};
    EXPECT_FLOAT_EQ(mix(own, document).values[0], 2) << "solo wins over mute, and turns the environment off";
}

TEST(Mixer, WhatIsMoreThanColourAndIntensityNeedsANewPicture) {
    const Document document = mixedDocument();
    const std::vector<Contribution> own = contributionsOf(document);
    EXPECT_TRUE(canMix(own, document));
    Document moved = document;
    moved.rig.lights[1].place->azimuth += 1;
    EXPECT_FALSE(canMix(own, moved));
    Document turned = document;
    turned.rig.environment.rotation = 10;
    EXPECT_FALSE(canMix(own, turned));
    Document fewer = document;
    deleteLight(fewer, 0);
    EXPECT_FALSE(canMix(own, fewer));
    Document warmer = document;
    warmer.rig.lights[0].temperature = 3000;
    EXPECT_TRUE(canMix(own, warmer));
    const glm::dvec3 share = shareOf(own[0], 0, warmer);
    EXPECT_GT(share.r, share.b);
}

TEST(Mixer, ALightThatIsOffHasAPictureAllTheSame) {
    Document document = mixedDocument();
    document.rig.lights[0].enabled = false;
    document.rig.lights[1].intensity = 0;
    const std::vector<Contribution> own = contributionsOf(document);
    for (const Contribution& contribution : own) {
        const Rig alone = aloneRig(document, contribution);
        if (contribution.ofEnvironment) continue;
        ASSERT_EQ(alone.lights.size(), 1u);
        EXPECT_TRUE(alone.lights[0].enabled);
        EXPECT_GT(alone.lights[0].intensity, 0);
        EXPECT_TRUE(alone.environment.file.empty());
    }
    EXPECT_EQ(shareOf(own[1], 1, document), glm::dvec3(0));
}

TEST(Overlay, ColoursMeanWhatTheyAreSaidToMean) {
    const Picture normal{2, 1, 3, {0, 0, 1, 0, 0, 0}};
    const DisplayPicture shown = showAov({"normal", {}}, normal, 0);
    EXPECT_EQ(std::vector<std::uint8_t>(shown.rgba.begin(), shown.rgba.begin() + 3),
              (std::vector<std::uint8_t>{128, 128, 255}));
    EXPECT_EQ(shown.rgba[6], 0) << "where nothing is";
    const Picture thickness{3, 1, 1, {0.001f, 60000, 0}};
    EXPECT_EQ(showAov({"thickness", {}}, thickness, 0).rgba[0], 255);
    EXPECT_EQ(showAov({"thickness", {}}, thickness, 0).rgba[4], 0);
    const Picture stretch{3, 1, 3, {1, 1, 1, 9, 9, 9, 0, 0, 0}};
    const Shown stretched{kInspectedName, {Inspect::What::stretch, 0}};
    EXPECT_EQ(showAov(stretched, stretch, 0).rgba[0], 0);
    EXPECT_EQ(showAov(stretched, stretch, 0).rgba[4], 255);
    const Picture map{3, 1, 1, {0, 0.5f, 9}};
    EXPECT_EQ(showMap(map, 1).rgba[0], 0);
    EXPECT_EQ(showMap(map, 1).rgba[8], 255);
    for (const Overlay& overlay : overlays()) {
        if (*overlay.aov == 0) continue;
        const bool known = std::any_of(std::begin(kAovNames), std::end(kAovNames),
                                       [&](const char* name) { return std::string(name) == overlay.aov; });
        EXPECT_NE(known, overlay.inspect != Inspect::What::none) << overlay.label;
        EXPECT_EQ(known, std::string(overlay.aov) != kInspectedName) << overlay.label;
    }
}

}  // namespace
}  // namespace cutis::test
