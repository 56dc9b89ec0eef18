// A sun that is taken out of its environment: the light of both together is that of the whole.
#include "renderer/scene/environment_sun.h"

#include <gtest/gtest.h>

#include "renderer/scene/environment_clusters.h"
#include "renderer/scene/light_samples.h"

namespace cutis {
namespace {

// A sky of radiance 1, and a sun of 4 x 4 texels round 30 degrees above -Z.
Environment sunnySky(const glm::vec3& sun) {
    Environment sky{"sky", 128, 64, std::vector<glm::vec3>(128 * 64, glm::vec3(1))};
    for (int y = 19; y < 23; ++y)
        for (int x = 62; x < 66; ++x) sky.radiance[std::size_t(y) * 128 + x] = sun;
    return sky;
}

glm::dvec3 irradianceOf(const Environment& environment, const glm::dvec3& n, double rotation) {
    return irradianceFrom(clusterEnvironment(environment), rotateAboutY(n, -rotation));
}

TEST(EnvironmentSun, IsFoundWhereItStands) {
    const std::optional<EnvironmentSun> sun = findSun(sunnySky({2000, 1500, 1000}));
    ASSERT_TRUE(sun);
    // Rows 19 to 22 of 64 lie round v = 21/64: an elevation of 90 - 180 * 21/64 = 30.9 degrees.
    EXPECT_NEAR(glm::degrees(std::asin(sun->towards.y)), 30.9, 0.1);
    EXPECT_NEAR(sun->towards.x, 0, 1e-6);
    EXPECT_LT(sun->towards.z, 0);
    // What stands above the sky: (2000 - 1) over its solid angle, which is cos(30.9) * (4 * 2.8125 degrees)².
    const double texel = 2 * 3.14159265 / 128, area = 16 * texel * texel * std::cos(glm::radians(30.94));
    EXPECT_NEAR(sun->irradiance.x, 1999 * area, 0.01 * 1999 * area);
    EXPECT_NEAR(sun->irradiance.y / sun->irradiance.x, 0.75, 0.01);
}

TEST(EnvironmentSun, AnEvenSkyHasNone) {
    EXPECT_FALSE(findSun(Environment{"sky", 64, 32, std::vector<glm::vec3>(64 * 32, glm::vec3(0))}));
}

// Two lamps, one of them a hundredth brighter: what stands out is a hundredth of a half of the light, and
// stays where it is.
TEST(EnvironmentSun, OneOfTwoLampsIsNone) {
    Environment studio{"studio", 64, 32, std::vector<glm::vec3>(64 * 32, glm::vec3(0))};
    studio.radiance[16 * 64 + 16] = glm::vec3(100);
    studio.radiance[16 * 64 + 48] = glm::vec3(101);
    EXPECT_FALSE(findSun(studio));
    Environment rest = studio;
    removeSun(rest);
    EXPECT_EQ(rest.radiance, studio.radiance);
    // As bright as three of the other, it is one.
    studio.radiance[16 * 64 + 48] = glm::vec3(300);
    EXPECT_TRUE(findSun(studio));
}

// The sun is 10 degrees wide: its light, as if from one direction, differs from the exact one by that width
// squared at most, some 0.3 %.
TEST(EnvironmentSun, LightIsTheSameInAll) {
    const Environment whole = sunnySky({2000, 1500, 1000});
    const EnvironmentSettings settings{.file = "sky.exr", .enabled = true, .intensity = 0.7, .rotation = 40};
    const Light sun = sunLight(*findSun(whole), settings);
    EXPECT_EQ(sun.type, LightType::directional);
    Rig rig;
    rig.lights = {sun};
    Environment rest = whole;
    removeSun(rest);
    for (const glm::dvec3& n : {glm::dvec3(0, 1, 0), glm::normalize(glm::dvec3(1, 0.2, -1)),
                                glm::normalize(glm::dvec3(0.3, 0.5, 1))}) {
        const glm::dvec3 expected = irradianceOf(whole, n, settings.rotation) * settings.intensity;
        glm::dvec3 sum = irradianceOf(rest, n, settings.rotation) * settings.intensity;
        for (const LightSample& sample : sampleLights(rig)) sum += irradianceFrom(sample, glm::dvec3(0), n);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], expected[c], 3e-3 * expected[c]) << c;
        EXPECT_LT(irradianceOf(rest, n, settings.rotation).x,
                  0.5 * irradianceOf(whole, glm::dvec3(0, 1, 0), 0).x);
    }
    for (const glm::vec3& radiance : rest.radiance)
        EXPECT_GE(std::min({radiance.x, radiance.y, radiance.z}), 0.0f);
}

}  // namespace
}  // namespace cutis
