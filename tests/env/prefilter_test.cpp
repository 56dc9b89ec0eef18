// Prefiltered maps on the device against sums over every texel.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "renderer/scene/environment_clusters.h"
#include "renderer/skin/specular.h"
#include "tests/env/environments.h"
#include "tests/env/gpu_lookup.h"
#include "tests/env/texel_sums.h"

using namespace cutis;
using namespace cutis::test;
using glm::dvec3;

namespace {

std::vector<LookupQuery> queriesOf(const std::vector<dvec3>& normals) {
    std::vector<LookupQuery> queries;
    for (const dvec3& n : normals) queries.push_back({glm::vec3(n), glm::vec3(n)});
    return queries;
}

// Largest |found - exact| over the mean of `exact`, over all channels; and that nothing is negative or not
// finite.
double worstOverMean(const std::vector<glm::vec3>& found, const std::vector<dvec3>& exact) {
    dvec3 worst(0), mean(0);
    for (std::size_t i = 0; i < exact.size(); ++i) {
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(found[i][c]) && found[i][c] >= 0) << i;
        worst = glm::max(worst, glm::abs(dvec3(found[i]) - exact[i]));
        mean += exact[i] / double(exact.size());
    }
    return std::max({worst.x / mean.x, worst.y / mean.y, worst.z / mean.z});
}

}  // namespace

class PrefilteredOf : public testing::TestWithParam<std::string> {};

// Figure 4 of the model: 1,000 normals, at most 1 % of the mean, never negative.
TEST_P(PrefilteredOf, irradianceMatchesAllTexels) {
    const Environment& environment = blenderEnvironment(GetParam());
    const EnvironmentMaps maps =
        prefilterEnvironment(testDevice(), environment, std::vector{SkinSpecular{0.3f, 1}});
    const auto normals = visibilityDirections(1000);
    const auto exact = sumTexels(environment, normals, [](double cosine) { return std::max(cosine, 0.0); });
    const auto found = lookUp(maps, {.what = Lookup::irradiance, .roughness = 0.3f}, queriesOf(normals));
    const double worst = worstOverMean(found, exact);
    std::printf("%s: face %u, gpu %.0f ms, irradiance error %.4f\n", GetParam().c_str(),
                maps.irradiance.width(), maps.gpuMs, worst);
    EXPECT_LE(worst, 0.01);
}

// The part that skin reflects: the same bound, relative to the irradiance from which it is subtracted.
TEST_P(PrefilteredOf, matteMatchesAllTexels) {
    const Environment& environment = blenderEnvironment(GetParam());
    const SkinSpecular skin{0.3f, 1};
    const EnvironmentMaps maps = prefilterEnvironment(testDevice(), environment, std::vector{skin});
    const auto normals = visibilityDirections(300);
    const std::vector<float> row = skin::directionalAlbedoRow(skin.roughness, 4096);
    const auto irradiance =
        sumTexels(environment, normals, [](double cosine) { return std::max(cosine, 0.0); });
    const auto exact = sumTexels(environment, normals, [&](double cosine) {
        return cosine > 0 ? cosine * (1 - skin::lookUpAlbedo(row, cosine)) : 0.0;
    });
    auto found = lookUp(maps, {.what = Lookup::irradiance, .roughness = 0.3f}, queriesOf(normals));
    const auto matte = lookUp(maps, {.what = Lookup::matte, .roughness = 0.3f}, queriesOf(normals));
    for (std::size_t i = 0; i < found.size(); ++i) found[i] -= matte[i];
    const double worst = worstOverMean(found, exact);
    std::printf("%s: entering error %.4f\n", GetParam().c_str(), worst);
    EXPECT_LE(worst, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Blender, PrefilteredOf, testing::ValuesIn(kBlenderEnvironments),
                         [](const auto& i) { return i.param; });
