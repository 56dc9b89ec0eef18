// Camera control as arithmetic: what a drag, a wheel and a framing do.
#include <gtest/gtest.h>

#include "app/viewer/orbit_camera.h"
#include "renderer/scene/camera.h"
#include "tests/cli/program.h"

namespace cutis::test {
namespace {

using namespace app;

OrbitCamera someCamera() {
    OrbitCamera camera;
    camera.target = {0.3, 1.5, -0.2};
    camera.azimuth = 25;
    camera.elevation = 10;
    camera.distance = 2;
    return camera;
}

// The target is in the middle of the picture, at the camera's distance.
void expectCentred(const OrbitCamera& camera) {
    const glm::dvec3 seen = project(toCamera(camera, 1.5), 1.5, camera.target);
    EXPECT_NEAR(seen.x, 0.5, 1e-12);
    EXPECT_NEAR(seen.y, 0.5, 1e-12);
    EXPECT_NEAR(seen.z, camera.distance, 1e-12);
}

TEST(OrbitCamera, AzimuthZeroLooksFromPlusZ) {
    OrbitCamera camera;
    camera.distance = 3;
    EXPECT_NEAR(glm::length(glm::dvec3(toCamera(camera, 1).world[3]) - glm::dvec3(0, 0, 3)), 0, 1e-12);
    camera.azimuth = 90;
    EXPECT_NEAR(glm::length(glm::dvec3(toCamera(camera, 1).world[3]) - glm::dvec3(3, 0, 0)), 0, 1e-12);
}

TEST(OrbitCamera, TurningKeepsTheTargetInTheMiddle) {
    OrbitCamera camera = someCamera();
    orbitBy(camera, 120, -40, 480);
    EXPECT_DOUBLE_EQ(camera.azimuth, 25 - 45);
    EXPECT_DOUBLE_EQ(camera.elevation, 10 - 15);
    expectCentred(camera);
    orbitBy(camera, 0, 1e6, 480);
    EXPECT_EQ(camera.elevation, kMaxElevation);
    expectCentred(camera);
}

// What was in the middle is (dx, dy) pixels from it afterwards.
TEST(OrbitCamera, PanningFollowsTheMouse) {
    OrbitCamera camera = someCamera();
    const glm::dvec3 point = camera.target;
    const double height = 400, aspect = 1.5;
    panBy(camera, 30, -50, height);
    const glm::dvec3 seen = project(toCamera(camera, aspect), aspect, point);
    EXPECT_NEAR((seen.x - 0.5) * height * aspect, 30, 1e-9);
    EXPECT_NEAR((seen.y - 0.5) * height, -50, 1e-9);
}

TEST(OrbitCamera, DollyStaysInFrontOfTheTarget) {
    OrbitCamera camera = someCamera();
    dollyBy(camera, 1);
    EXPECT_DOUBLE_EQ(camera.distance, 1.8);
    dollyBy(camera, 10000);
    EXPECT_GT(camera.distance, 0);
    dollyBy(camera, -10000);
    EXPECT_LE(camera.distance, 1e5);
}

TEST(OrbitCamera, ComesBackFromACamera) {
    const OrbitCamera camera = someCamera();
    const OrbitCamera back = fromCamera(toCamera(camera, 1.7), camera.target);
    EXPECT_NEAR(glm::length(back.target - camera.target), 0, 1e-12);
    EXPECT_NEAR(back.azimuth, camera.azimuth, 1e-9);
    EXPECT_NEAR(back.elevation, camera.elevation, 1e-9);
    EXPECT_NEAR(back.distance, camera.distance, 1e-12);
    EXPECT_EQ(back.yfov, camera.yfov);
}

// What the viewer writes into a command line is the same camera there, to the 1e-5 that it is rounded to.
TEST(OrbitCamera, SelectorIsTheSameCamera) {
    const OrbitCamera camera = someCamera();
    const Camera shown = toCamera(camera, 1.5), read = cameraFor(twoHeads(), toSelector(camera), 1.5);
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(glm::length(shown.world[c] - read.world[c]), 0, 2e-5) << c;
    EXPECT_NEAR(shown.yfov, read.yfov, 1e-6);
}

// All of the subject is inside, and it fills the picture in one direction at least.
TEST(OrbitCamera, FramingsHoldTheirSubject) {
    const Scene scene = twoHeads();
    for (const double aspect : {0.5, 1.0, 2.0}) {
        OrbitCamera camera = someCamera();
        frameSubject(camera, scene, 0, Framing::full, aspect);
        const Bounds bounds = scene.characters[0].bounds;
        double farthest = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 p(corner & 1 ? bounds.max.x : bounds.min.x, corner & 2 ? bounds.max.y : bounds.min.y,
                               corner & 4 ? bounds.max.z : bounds.min.z);
            const glm::dvec3 seen = project(toCamera(camera, aspect), aspect, p);
            EXPECT_GT(seen.z, 0);
            farthest = std::max({farthest, std::abs(seen.x - 0.5), std::abs(seen.y - 0.5)});
        }
        EXPECT_LT(farthest, 0.5) << aspect;
        EXPECT_GT(farthest, 0.4) << aspect;
    }
    OrbitCamera one = someCamera(), all = someCamera();
    frameSubject(one, scene, 1, Framing::face, 1);
    frameSubject(all, scene, 1, Framing::group, 1);
    EXPECT_NEAR(one.target.x, 0.2, 1e-6);
    EXPECT_NEAR(all.target.x, 0, 1e-6);
    EXPECT_GT(all.distance, one.distance);
}

TEST(OrbitCamera, LensesAreThoseOfAFullFrame) {
    EXPECT_NEAR(glm::degrees(fieldOfView(50)), 26.99, 0.01);
    EXPECT_DOUBLE_EQ(focalLength(fieldOfView(85)), 85);
}

}  // namespace
}  // namespace cutis::test
