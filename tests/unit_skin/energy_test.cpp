// The coupled matte: what the specular layer takes from the diffused light it gives back.
#include "renderer/skin/energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "renderer/skin/specular.h"

using namespace cutis::skin;

class WhiteFurnace : public testing::TestWithParam<std::tuple<double, double>> {};

// Albedo 1 under radiance 1 from everywhere, diffusion that conserves energy: E' = ∫ (1 - sρ) μ dω, M = E',
// and what leaves towards any view, M/π · X(μ) + s'∫ f_s μ_L dω, is 1. The specular part is integrated from
// f_s over light directions.
TEST_P(WhiteFurnace, reflectsExactlyWhatArrives) {
    const auto [m, s] = GetParam();
    const double pi = std::numbers::pi;
    double entering = 0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
        const double mu = (i + 0.5) / n;
        entering += 2 * pi * mu * transmittedFraction(s, directionalAlbedo(mu, m)) / n;
    }
    const double mean = meanAlbedo(m, s);
    for (double mu : {0.05, 0.2, 0.5, 0.9, 1.0}) {
        const glm::dvec3 normal(0, 0, 1), view(std::sqrt(1 - mu * mu), 0, mu);
        const double albedo = directionalAlbedo(mu, m);
        double specular = 0;
        const int steps = 800;
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j) {
                const double elevation = pi / 2 * (i + 0.5) / steps, phi = pi * (j + 0.5) / steps;
                const double z = std::sin(elevation), r = std::cos(elevation);
                const glm::dvec3 light(r * std::cos(phi), r * std::sin(phi), z);
                specular += kelemenSpecular(normal, view, light, m) * z * r;
            }
        specular *= clampedScale(s, albedo) * pi * pi / (double(steps) * steps);  // half of the azimuths
        const double radiance = entering / pi * exitScale(s, albedo, mean) + specular;
        EXPECT_NEAR(radiance, 1, 5e-4) << "mu = " << mu;
    }
}

INSTANTIATE_TEST_SUITE_P(Roughness, WhiteFurnace,
                         testing::Combine(testing::Values(0.1, 0.3, 0.6, 1.0), testing::Values(1.0, 3.0)));

TEST(ExitScale, hasMeanOne) {
    for (double m : {0.05, 0.3, 1.0})
        for (double s : {0.0, 1.0, 10.0}) {
            const double mean = meanAlbedo(m, s);
            double sum = 0;
            const int n = 4000;
            for (int i = 0; i < n; ++i) {
                const double mu = (i + 0.5) / n;
                sum += 2 * mu * exitScale(s, directionalAlbedo(mu, m), mean) / n;
            }
            EXPECT_NEAR(sum, 1, 1e-4) << m << " " << s;
        }
}

TEST(ExitScale, isZeroWhereNothingEnters) {
    EXPECT_EQ(transmittedFraction(40, 0.5), 0);
    EXPECT_EQ(exitScale(40, 0.5, 1), 0);
}
// ∫ G dA over a sphere from one of its points, by rings of equal area, and over a disc from its centre.
TEST(GatheredShare, isExactOnSpheresAndDiscs) {
    const double pi = std::numbers::pi, radius = 50;
    for (const double variance : {1.0, 100.0, 2500.0, 1e4, 1e7}) {
        constexpr int kRings = 200000;
        double onSphere = 0, onDisc = 0;
        for (int i = 0; i < kRings; ++i) {
            const double share = (i + 0.5) / kRings;  // of the area, from the point outwards
            onSphere += std::exp(-4 * radius * radius * share / (2 * variance));
            onDisc += std::exp(-radius * radius * share / (2 * variance));
        }
        const double sphereArea = 4 * pi * radius * radius, discArea = pi * radius * radius;
        const double unit = 1 / (2 * pi * variance * kRings);
        EXPECT_NEAR(gatheredShare(variance, sphereArea), onSphere * sphereArea * unit, 1e-4) << variance;
        EXPECT_NEAR(gatheredShare(variance, discArea), onDisc * discArea * unit, 1e-4) << variance;
    }
    // Of skin on a head nothing is lost, and of Gaussians far wider than a body next to nothing kept.
    EXPECT_EQ(gatheredShare(7.41, 1e5), 1);
    EXPECT_NEAR(gatheredShare(1e12, 1e5) * 2 * pi * 1e12 / 1e5, 1, 1e-6);
}

