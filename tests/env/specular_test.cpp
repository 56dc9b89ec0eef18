// Specular reflection of the environment, as shaders evaluate it, against sums over every texel.
#include "renderer/skin/specular.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "renderer/scene/environment_clusters.h"
#include "tests/env/environments.h"
#include "tests/env/gpu_lookup.h"
#include "tests/env/texel_sums.h"

using namespace cutis;
using namespace cutis::test;
using glm::dvec3;

namespace {

// Normals of a sphere seen from +Z, on a grid of its disc, where N·V > 0.05.
std::vector<dvec3> sphereNormals(int size) {
    std::vector<dvec3> normals;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double a = (x + 0.5) / size * 2 - 1, b = (y + 0.5) / size * 2 - 1, z2 = 1 - a * a - b * b;
            if (z2 > 0.0025) normals.emplace_back(a, b, std::sqrt(z2));
        }
    return normals;
}

std::vector<LookupQuery> queriesOf(const std::vector<dvec3>& normals) {
    std::vector<LookupQuery> queries;
    for (const dvec3& n : normals) queries.push_back({glm::vec3(n), {0, 0, 1}});
    return queries;
}

// ∫ L f_s (N·ω) dω in double, texel by texel, without those where D is less than e^-40 of its peak: exponent
// tan²θ/m² > 40.
std::vector<dvec3> reflectTexels(const std::vector<Texel>& texels, const std::vector<dvec3>& normals,
                                 double m) {
    const dvec3 view(0, 0, 1);
    const double leastCos2 = 1 / (1 + 40 * m * m);
    return sumShares(texels, normals, [&](const dvec3& n, const Texel& texel) {
        const double cosine = glm::dot(n, texel.direction), along = cosine + n.z;  // N·h, |h|² = 2 (1 + V·L)
        if (cosine <= 0 || along * along <= leastCos2 * 2 * (1 + texel.direction.z)) return dvec3(0);
        return texel.flux * (cosine * skin::kelemenSpecular(n, view, texel.direction, m));
    });
}

double relativeL2(const std::vector<glm::vec3>& found, const std::vector<dvec3>& exact) {
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(found[i][c]) && found[i][c] >= 0);
        const dvec3 d = dvec3(found[i]) - exact[i];
        difference += glm::dot(d, d);
        sum += glm::dot(exact[i], exact[i]);
    }
    return std::sqrt(difference / sum);
}

}  // namespace

class SpecularOf : public testing::TestWithParam<std::string> {};

// Figure 10 of the model: a sphere, mirror-like to rough, relative L2 over its disc. The narrower the lobe,
// the more pixels it takes to meet every source.
constexpr double kLargestError = 0.03;

TEST_P(SpecularOf, sphereMatchesAllTexels) {
    const Environment& environment = blenderEnvironment(GetParam());
    const EnvironmentMaps maps = prefilterEnvironment(testDevice(), environment, std::vector{SkinSpecular{}});
    const std::vector<Texel> texels = listTexels(environment);
    for (const double m : {0.05, 0.1, 0.3, 0.6, 1.0}) {
        const auto normals = sphereNormals(m <= 0.1 ? 32 : 10);
        const auto exact = reflectTexels(texels, normals, m);
        const auto found =
            lookUp(maps, {.what = Lookup::skinSpecular, .roughness = float(m)}, queriesOf(normals));
        const double error = relativeL2(found, exact);
        std::printf("%s m %.2f: %.4f\n", GetParam().c_str(), m, error);
        EXPECT_LE(error, kLargestError) << "m = " << m;
    }
}

INSTANTIATE_TEST_SUITE_P(Blender, SpecularOf, testing::ValuesIn(kBlenderEnvironments),
                         [](const auto& i) { return i.param; });

// Radiance 1 everywhere reflects ρ_dt exactly, at any roughness and scale.
TEST(Specular, uniformEnvironmentReflectsTheAlbedo) {
    const EnvironmentMaps maps =
        prefilterEnvironment(testDevice(), uniformEnvironment(64, 32), std::vector{SkinSpecular{}});
    const auto normals = sphereNormals(40);
    for (const float m : {0.02f, 0.3f, 1.0f})
        for (const float s : {1.0f, 4.0f}) {
            const auto found =
                lookUp(maps, {.what = Lookup::skinSpecular, .roughness = m, .scale = s}, queriesOf(normals));
            for (std::size_t i = 0; i < normals.size(); ++i) {
                const double exact = std::min(1.0, s * skin::directionalAlbedo(normals[i].z, m));
                for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[i][c], exact, 3e-4) << normals[i].z;
            }
        }
}

// Turning the environment is turning normals and views the other way.
TEST(Specular, rotatedEnvironmentIsTheRotatedScene) {
    const EnvironmentMaps maps =
        prefilterEnvironment(testDevice(), blenderEnvironment("courtyard"), std::vector{SkinSpecular{}});
    std::vector<LookupQuery> still, turned;
    for (const dvec3& n : sphereNormals(24)) {
        still.push_back({glm::vec3(rotateAboutY(n, -65)), glm::vec3(rotateAboutY({0, 0, 1}, -65))});
        turned.push_back({glm::vec3(n), {0, 0, 1}});
    }
    for (const Lookup what : {Lookup::irradiance, Lookup::skinSpecular, Lookup::ggxSpecular}) {
        const auto a = lookUp(maps, {.what = what, .roughness = 0.2f}, still);
        const auto b =
            lookUp(maps, {.what = what, .roughness = 0.2f, .rotation = 65, .intensity = 3}, turned);
        for (std::size_t i = 0; i < a.size(); ++i)
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(b[i][c], 3 * a[i][c], 1e-3 * (3 * a[i][c] + 0.01));
    }
}
