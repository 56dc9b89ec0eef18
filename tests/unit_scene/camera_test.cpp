#include "renderer/scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/core/error.h"
#include "renderer/scene/characters.h"

namespace cutis {
namespace {

// A column of skin, 1.8 m high and 0.6 m wide, at x, and the same again at x + 1.
Scene makePeople(int count) {
    Scene scene;
    Material skin;
    skin.skin = SkinMaterial{};
    scene.materials = {skin};
    Primitive box;
    for (int k = 0; k <= 18; ++k) {
        for (int i = 0; i < 4; ++i)
            box.positions.push_back({(i & 1 ? 0.3f : -0.3f), 0.1f * k, i & 2 ? 0.2f : -0.2f});
    }
    box.normals.assign(box.positions.size(), glm::vec3(0, 0, 1));
    box.indices = {0, 1, 2};
    box.material = 0;
    scene.meshes = {{"box", {box}}};
    for (int i = 0; i < count; ++i) {
        Node node;
        node.name = "p" + std::to_string(i);
        node.mesh = 0;
        node.local[3].x = i;
        scene.nodes.push_back(node);
    }
    prepareScene(scene);
    return scene;
}

// Picture coordinates in [-1, 1] of a world point.
glm::dvec2 project(const Camera& camera, const glm::dvec3& point) {
    const glm::dvec4 p = glm::inverse(camera.world) * glm::dvec4(point, 1);
    EXPECT_LT(p.z, -camera.znear);
    const double t = std::tan(camera.yfov / 2);
    return {p.x / (-p.z * t * camera.aspect), p.y / (-p.z * t)};
}

double farthest(const Camera& camera, const Bounds& bounds) {
    double reach = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec2 q =
            project(camera, {i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y,
                             i & 4 ? bounds.max.z : bounds.min.z});
        reach = std::max({reach, std::abs(q.x), std::abs(q.y)});
    }
    return reach;
}

TEST(AutoCamera, HoldsEveryHeadInsideFromAnywhereAtAnyAspect) {
    for (const int count : {1, 3, 9}) {
        const Scene scene = makePeople(count);
        for (const double aspect : {0.3, 1.0, 16.0 / 9, 5.0}) {
            for (const char* selector :
                 {"auto", "auto:90", "auto:-30,20", "auto:180,-45", "auto:10,90", "auto:0,-90"}) {
                const Camera camera = cameraFor(scene, selector, aspect);
                const double reach = farthest(camera, headBounds(scene, "*"));
                EXPECT_LT(reach, 0.95) << count << " " << aspect << " " << selector;
                EXPECT_GT(reach, 0.25) << "too far away: " << count << " " << aspect << " " << selector;
                EXPECT_NEAR(glm::determinant(glm::dmat3(camera.world)), 1, 1e-9);
            }
        }
    }
}

TEST(AutoCamera, ShowsHeadsAndShouldersNotFeet) {
    const Scene scene = makePeople(3);
    const Camera camera = cameraFor(scene, "auto", 1.5);
    EXPECT_LT(project(camera, {1, 0, 0}).y, -1.2);
    EXPECT_GT(project(camera, {1, 1.8, 0}).y, 0);
}

TEST(AutoCamera, AzimuthZeroIsInFrontAndGrowsTowardsX) {
    const Scene scene = makePeople(1);
    const auto looksTo = [&](const char* selector) {
        return -glm::dvec3(cameraFor(scene, selector, 1).world[2]);
    };
    EXPECT_LT(glm::distance(looksTo("auto"), glm::dvec3(0, 0, -1)), 1e-12);
    EXPECT_LT(glm::distance(looksTo("auto:90,0"), glm::dvec3(-1, 0, 0)), 1e-12);
    EXPECT_LT(glm::distance(looksTo("auto:0,90"), glm::dvec3(0, -1, 0)), 1e-12);
}

TEST(AutoCamera, WithoutCharactersShowsAllThereIs) {
    Scene scene = makePeople(2);
    scene.materials[0].skin.reset();
    prepareScene(scene);
    const double reach = farthest(cameraFor(scene, "", 1), scene.bounds);
    EXPECT_LT(reach, 0.9);
    EXPECT_GT(reach, 0.8);
    EXPECT_NO_THROW(cameraFor(Scene{}, "auto", 1));
}

TEST(CameraFor, NamesIndicesAndTheFirstByDefault) {
    Scene scene = makePeople(1);
    Camera wide, flat;
    wide.name = "wide";
    wide.yfov = 1;
    wide.aspect = 3;
    flat.name = "7";
    flat.orthographic = true;
    flat.xmag = 9;
    flat.ymag = 2;
    scene.cameras = {wide, flat};
    EXPECT_EQ(cameraFor(scene, "", 2).name, "wide");
    EXPECT_EQ(cameraFor(scene, "wide", 2).yfov, 1);
    EXPECT_EQ(cameraFor(scene, "0", 2).name, "wide");
    EXPECT_EQ(cameraFor(scene, "wide", 2).aspect, 2);
    EXPECT_EQ(cameraFor(scene, "7", 2).ymag, 2);
    EXPECT_EQ(cameraFor(scene, "1", 2).xmag, 4);
    EXPECT_EQ(cameraFor(scene, "auto", 2).name, "auto");
    try {
        cameraFor(scene, "wode", 2);
        FAIL() << "an unknown camera was accepted";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("did you mean 'wide'"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("'wide', '7', auto"), std::string::npos) << error.what();
    }
    for (const char* bad :
         {"2", "-1", "auto:x", "auto:", "auto:1,", "auto:1,2,3", "auto:1,91", "auto:nan", "auto:1e999"}) {
        EXPECT_THROW(cameraFor(scene, bad, 2), Error) << bad;
    }
}

}  // namespace
}  // namespace cutis
