// Figures 6 and 7: light adds, and however much of it there is, it is diffused once.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

// Opaque skin with specular, a nose that casts a shadow, and an eye of glass-like plastic beside it.
RenderJob headJob(int size) {
    SkinMaterial skin;
    skin.translucency = false;
    Material eye;
    eye.name = "eye";
    eye.metallic = 0, eye.roughness = 0.3f;
    SceneBuilder builder;
    builder.addObject("head", makeNosedSphere(80 * kMm), builder.addSkin(skin, {0.8, 0.6, 0.5}));
    builder.addObject("eye", makeSphere(15 * kMm, SphereMapping::latLong), builder.addMaterial(eye),
                      glm::dmat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0.035, 0.03, 0.075, 1}));
    builder.setOrthographicCamera(glm::dvec3(0.1, 0.1, 0.5), {0, 0, 0}, 0.2);
    RenderJob job{.scene = builder.scene(), .width = size, .height = size, .irradianceSize = 256};
    return job;
}

TEST(Superposition, TwoLightsOfDifferentKindsAdd) {
    RenderJob job = headJob(200);
    const auto key = directionalLight("key", {0.7, -0.5, -0.6}, 3);
    const auto fill = spotLight("fill", {-0.4, 0.2, 0.5}, {0.4, -0.2, -0.5}, 1.5, 0.1, 0.25);
    job.lights = {key};
    const Picture first = render(job).picture;
    job.lights = {fill};
    const Picture second = render(job).picture;
    Picture sum = first;
    addPicture(sum, second);
    job.lights = {key, fill};
    const Picture both = render(job).picture;
    expectAtMost("superposition of two lights", relativeL2(both, sum), 0.001);
    // Each light alone matters, or the sum would say nothing.
    EXPECT_GT(relativeL2(both, first), 0.1);
    EXPECT_GT(relativeL2(both, second), 0.1);
}

// Two runs of one job are one picture, to the bit.
TEST(Superposition, ARepeatedRunGivesTheSamePicture) {
    RenderJob job = headJob(96);
    job.lights = {directionalLight("key", {0.7, -0.5, -0.6}, 3)};
    EXPECT_EQ(render(job).picture.values, render(job).picture.values);
}

std::vector<Light> sixteenLights() {
    std::vector<Light> lights;
    for (int i = 0; i < 16; ++i) {
        const double azimuth = i * 2 * std::numbers::pi / 16, elevation = 0.9 * std::sin(1.7 * i);
        const glm::dvec3 position(std::sin(azimuth) * std::cos(elevation) * 0.6, std::sin(elevation) * 0.6,
                                  std::cos(azimuth) * std::cos(elevation) * 0.6);
        const std::string name = "light " + std::to_string(i);
        switch (i % 4) {
            case 0:
                lights.push_back(pointLight(name, position, 0.4));
                break;
            case 1:
                lights.push_back(directionalLight(name, -position, 0.8));
                break;
            case 2:
                lights.push_back(spotLight(name, position, -position, 0.5, 0.1, 0.3));
                break;
            default:
                lights.push_back(rectLight(name, position, -position, 5, 0.2, 0.3, 4));
        }
    }
    return lights;
}

TEST(OneDiffusion, SixteenLightsAndAnEnvironmentAreDiffusedOnce) {
    RenderJob job = headJob(96);
    const std::vector<Light> lights = sixteenLights();
    const Picture environment = makeEnvironment(
        64, 32, [](const glm::dvec3& w) { return glm::dvec3(0.5 + 0.3 * w.x, 0.5 + 0.4 * w.y, 0.6); });

    Picture sum;
    for (const Light& light : lights) {
        job.lights = {light};
        const Rendered alone = render(job);
        EXPECT_EQ(alone.stats.runsOf("diffusion"), 1) << light.name;
        addPicture(sum, alone.picture);
    }
    job.lights.clear();
    job.environment = environment;
    const Rendered ambient = render(job);
    EXPECT_EQ(ambient.stats.runsOf("diffusion"), 1);
    addPicture(sum, ambient.picture);

    job.lights = lights;
    const Rendered all = render(job);
    EXPECT_EQ(all.stats.runsOf("diffusion"), 1);
    EXPECT_EQ(all.stats.lights, 16);
    EXPECT_EQ(all.stats.lightSamples, 12 + 4 * 4);
    expectAtMost("superposition of sixteen lights and an environment", relativeL2(all.picture, sum), 0.001);
}

// Nothing to diffuse, nothing diffused.
TEST(OneDiffusion, DoesNotRunWithoutSkin) {
    SceneBuilder builder;
    builder.addObject("ball", makeSphere(50 * kMm, SphereMapping::latLong), builder.addMatte());
    builder.setOrthographicCamera({0, 0, 0.5}, {0, 0, 0}, 0.12);
    RenderJob job{.scene = builder.scene(), .lights = {directionalLight("key", {0, -0.3, -1}, 3)}};
    job.width = job.height = 64;
    const Rendered result = render(job);
    EXPECT_EQ(result.stats.runsOf("diffusion"), 0);
    EXPECT_GT(valueAt(result.picture, 32, 32), 0.1);
}

}  // namespace
}  // namespace cutis::test
