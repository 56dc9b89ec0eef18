// The closed forms that pictures are held against, each against a second derivation or brute force.
#include "tests/support/closed_forms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/pictures.h"

namespace cutis::test {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(ClosedForms, EdgeIsTheIntegralOfItsLineSpread) {
    const skin::Profile profile = skin::threeLayerProfile();
    double sum = 0;  // ∫ line spread from -20 mm to 1 mm
    const int steps = 200000;
    for (int i = 0; i < steps; ++i) {
        const double x = -20 + 21.0 * (i + 0.5) / steps;
        for (const skin::Gaussian& g : profile.gaussians)
            sum += g.weight.x * std::exp(-x * x / (2 * g.variance)) / std::sqrt(2 * kPi * g.variance) * 21.0 /
                   steps;
    }
    EXPECT_NEAR(edgeResponse(profile, 0, 1), sum, 1e-8);
    EXPECT_NEAR(edgeResponse(profile, 0, 0), 0.5, 1e-12);
}

TEST(ClosedForms, SlabIsThePlaneIntegralOfTheProfile) {
    const skin::Profile profile = skin::threeLayerProfile();
    for (const double thickness : {0.5, 2.0}) {
        double sum = 0;
        const int steps = 200000;
        for (int i = 0; i < steps; ++i) {
            const double r = 30.0 * (i + 0.5) / steps, squared = r * r + thickness * thickness;
            for (const skin::Gaussian& g : profile.gaussians)
                sum += g.weight.x * std::exp(-squared / (2 * g.variance)) / (2 * kPi * g.variance) * 2 * kPi *
                       r * 30.0 / steps;
        }
        EXPECT_NEAR(slabTransmission(profile, 0, thickness), sum, 1e-8);
    }
}

TEST(ClosedForms, SphereSeriesAgreesWithBruteForce) {
    const skin::Profile profile = skin::threeLayerProfile();
    for (const double radius : {3.0, 5.0, 8.0}) {
        const SphereDiffusion exact(profile, radius);
        for (const double cosTheta : {1.0, 0.7, 0.2, 0.0, -0.1, -0.5, -1.0})
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(exact(cosTheta, channel),
                            integrateSphereDiffusion(profile, radius, cosTheta, channel, 500), 5e-5)
                    << radius << " mm, cosine " << cosTheta << ", channel " << channel;
    }
}

TEST(ClosedForms, SphereBecomesTheClampedCosineWhenItIsLarge) {
    const SphereDiffusion exact(skin::threeLayerProfile(), 1000);
    for (const double cosTheta : {0.9, 0.4, -0.4})
        EXPECT_NEAR(exact(cosTheta, 0), std::max(cosTheta, 0.0), 2e-4) << cosTheta;
}

TEST(ClosedForms, PolygonIrradianceAgreesWithQuadratureAndKnownFormFactors) {
    // A coaxial, parallel square of side 2 at distance 1 (Siegel & Howell, configuration B-5).
    const double side = 1 / std::sqrt(2.0);
    const double formFactor = 4 * (1 / (2 * kPi)) * 2 * side * std::atan(side);
    const auto square = rectCorners({0, 0, 1}, {0, 0, -1}, 2, 2);
    EXPECT_NEAR(polygonIrradiance({0, 0, 0}, {0, 0, 1}, {square.begin(), square.end()}, 1), kPi * formFactor,
                1e-12);

    // A tilted receiver that the rectangle partly sinks behind.
    const glm::dvec3 point(0.3, -0.2, 0), normal = normalize(glm::dvec3(1, 0.4, 0.5));
    const glm::dvec3 centre(-0.2, 0.1, 0.8), direction = normalize(glm::dvec3(0.1, -0.2, -1));
    const auto corners = rectCorners(centre, direction, 1.2, 0.9);
    const int steps = 2000;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double s = (i + 0.5) / steps, t = (j + 0.5) / steps;
            const glm::dvec3 from =
                corners[0] + (corners[1] - corners[0]) * s + (corners[3] - corners[0]) * t - point;
            const double squared = dot(from, from);
            const double received = std::max(0.0, dot(from, normal)),
                         emitted = std::max(0.0, -dot(from, direction));
            sum += received * emitted / (squared * squared);
        }
    EXPECT_NEAR(polygonIrradiance(point, normal, {corners.begin(), corners.end()}, 1),
                sum * 1.2 * 0.9 / (double(steps) * steps), 1e-4);
}

TEST(ClosedForms, RectIsAsWideAsItIsHorizontal) {
    const auto corners = rectCorners({1, 2, 3}, {0.8, -0.1, -0.5}, 0.6, 0.9);
    EXPECT_NEAR(length(corners[1] - corners[0]), 0.6, 1e-12);
    EXPECT_NEAR(corners[1].y, corners[0].y, 1e-12);
    EXPECT_NEAR(length(corners[2] - corners[1]), 0.9, 1e-12);
    EXPECT_GT(corners[2].y, corners[1].y);
}

TEST(ClosedForms, HemisphereQuadratureIntegratesLinearRadiance) {
    // ∫ (1 + a·ω)(N·ω) dω = π + (2π/3) a·N
    const glm::dvec3 a(0.2, -0.3, 0.4), normal = normalize(glm::dvec3(1, 2, -1));
    const glm::dvec3 value = integrateIrradiance(
        normal, [&](const glm::dvec3& w) { return glm::dvec3(1 + dot(a, w)); }, 200);
    EXPECT_NEAR(value.x, kPi + 2 * kPi / 3 * dot(a, normal), 1e-4);
}

TEST(ClosedForms, LatLongLooksTowardsMinusZWithPlusXOnItsRight) {
    EXPECT_LT(length(latLongDirection(0.5, 0.5) - glm::dvec3(0, 0, -1)), 1e-12);
    EXPECT_LT(length(latLongDirection(0.75, 0.5) - glm::dvec3(1, 0, 0)), 1e-12);
    EXPECT_LT(length(latLongDirection(0.3, 0) - glm::dvec3(0, 1, 0)), 1e-12);
}

}  // namespace
}  // namespace cutis::test
