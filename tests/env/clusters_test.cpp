// Clusters against sums over every texel.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/scene/environment_clusters.h"
#include "tests/env/environments.h"

using namespace cutis;
using namespace cutis::test;
using glm::dvec3;

namespace {

constexpr double kPi = std::numbers::pi;

// Irradiance at normal n, texel by texel; each texel is one direction with its exact solid angle. A bright
// texel that straddles the horizon is cut into 16×16.
dvec3 irradianceOfTexels(const Environment& e, const dvec3& n) {
    dvec3 sum(0);
    for (int y = 0; y < e.height; ++y) {
        const double solidAngle =
            (std::cos(kPi * y / e.height) - std::cos(kPi * (y + 1) / e.height)) * 2 * kPi / e.width;
        for (int x = 0; x < e.width; ++x) {
            const dvec3 radiance(e.radiance[std::size_t(y) * e.width + x]);
            const double cosine =
                glm::dot(n, environmentDirection((x + 0.5) / e.width, (y + 0.5) / e.height));
            if (std::abs(cosine) < 0.01 && radiance.x > 10) {
                double part = 0;
                for (int i = 0; i < 256; ++i) {
                    const double u = (x + (i % 16 + 0.5) / 16) / e.width,
                                 v = (y + (i / 16 + 0.5) / 16) / e.height;
                    part += std::max(glm::dot(n, environmentDirection(u, v)), 0.0) / 256;
                }
                sum += radiance * (solidAngle * part);
            } else {
                sum += radiance * (solidAngle * std::max(cosine, 0.0));
            }
        }
    }
    return sum;
}

}  // namespace

TEST(EnvironmentDirection, followsTheModel) {
    const auto expectDirection = [](double u, double v, const dvec3& expected) {
        EXPECT_LT(glm::length(environmentDirection(u, v) - expected), 1e-12) << u << " " << v;
    };
    expectDirection(0.5, 0.5, {0, 0, -1});  // the centre column lies towards -Z
    expectDirection(0.75, 0.5, {1, 0, 0});  // +X to the right of it
    expectDirection(0.25, 0.5, {-1, 0, 0});
    expectDirection(0.3, 0, {0, 1, 0});  // row 0 is +Y
    for (double u : {0.01, 0.4, 0.99})
        for (double v : {0.02, 0.5, 0.8}) {
            const glm::dvec2 back = environmentCoordinates(environmentDirection(u, v));
            EXPECT_NEAR(back.x, u, 1e-12);
            EXPECT_NEAR(back.y, v, 1e-12);
        }
}

TEST(EnvironmentDirection, rotatesCounterClockwiseSeenFromAbove) {
    // Seen from above, with -Z up the page, +X is to the right: a quarter turn counter-clockwise takes +X to
    // -Z.
    EXPECT_LT(glm::length(rotateAboutY({1, 0, 0}, 90) - dvec3(0, 0, -1)), 1e-12);
    EXPECT_LT(glm::length(rotateAboutY({0, 0.6, 0.8}, 90) - dvec3(0.8, 0.6, 0)), 1e-12);
}

TEST(Clusters, uniformEnvironmentGivesPiEverywhere) {
    const auto clusters = clusterEnvironment(uniformEnvironment(256, 128));
    EXPECT_EQ(clusters.size(), kMaxEnvironmentClusters);
    double flux = 0, solidAngle = 0;
    for (const auto& c : clusters) flux += c.flux.y, solidAngle += c.solidAngle;
    EXPECT_NEAR(flux, 4 * kPi, 1e-9);
    EXPECT_NEAR(solidAngle, 4 * kPi, 1e-9);
    for (const dvec3& n : visibilityDirections(200))
        EXPECT_NEAR(irradianceFrom(clusters, n).x, kPi, kPi * 1e-3);
}

TEST(Clusters, sunIsAClusterOfItsOwn) {
    const Environment e = sunnyEnvironment(512, 256);
    const auto clusters = clusterEnvironment(e);
    const EnvironmentCluster* brightest = &clusters[0];
    for (const auto& c : clusters)
        if (c.flux.x > brightest->flux.x) brightest = &c;
    const double solidAngle = (std::cos(kPi * 64 / 256) - std::cos(kPi * 65 / 256)) * 2 * kPi / 512;
    EXPECT_NEAR(brightest->flux.x, 30000 * solidAngle, 1e-6 * 30000 * solidAngle);
    const dvec3 direction = environmentDirection((170 + 0.5) / 512, (64 + 0.5) / 256);
    EXPECT_GT(glm::dot(direction, glm::normalize(brightest->centroid)), 1 - 1e-6);
}

TEST(Clusters, blackEnvironmentHasNone) {
    EXPECT_TRUE(clusterEnvironment({"black", 8, 4, std::vector<glm::vec3>(32, glm::vec3(0))}).empty());
}

TEST(Clusters, largeAndOddImagesKeepAllFlux) {
    for (const auto& [w, h] :
         {std::pair(2047, 1023), std::pair(3000, 7), std::pair(1, 1), std::pair(5, 900)}) {
        double flux = 0;
        for (const auto& c : clusterEnvironment(uniformEnvironment(w, h))) flux += c.flux.z;
        EXPECT_NEAR(flux, 4 * kPi, 1e-6) << w << "x" << h;
    }
}

class ClustersOf : public testing::TestWithParam<std::string> {};

// 0.2 % of the mean over normals leaves most of the 1 % of the whole chain to the maps.
TEST_P(ClustersOf, irradianceMatchesAllTexels) {
    const Environment& e = blenderEnvironment(GetParam());
    const auto clusters = clusterEnvironment(e);
    dvec3 worst(0), mean(0);
    const auto normals = visibilityDirections(40);
    for (const dvec3& n : normals) {
        const dvec3 exact = irradianceOfTexels(e, n);
        worst = glm::max(worst, glm::abs(irradianceFrom(clusters, n) - exact));
        mean += exact / double(normals.size());
    }
    for (int c = 0; c < 3; ++c) EXPECT_LE(worst[c], 0.002 * mean[c]) << "channel " << c;
    RecordProperty("worst_over_mean", std::to_string(worst.y / mean.y));
}

INSTANTIATE_TEST_SUITE_P(Blender, ClustersOf, testing::ValuesIn(kBlenderEnvironments),
                         [](const auto& i) { return i.param; });

TEST(VisibilityDirections, areEvenAndUnit) {
    const auto directions = visibilityDirections(128);
    dvec3 sum(0);
    double nearest = 4;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        EXPECT_NEAR(glm::length(directions[i]), 1, 1e-12);
        sum += directions[i];
        for (std::size_t j = 0; j < i; ++j)
            nearest = std::min(nearest, glm::distance(directions[i], directions[j]));
    }
    EXPECT_LT(glm::length(sum) / 128, 0.01);
    EXPECT_GT(nearest, 0.2);  // a perfect packing of 128 would have 0.31
}

// rms over normals and round occluders of the error of what arrives, over what would arrive with nothing in
// the way: a share by `directions` against all clusters.
double occlusionError(const std::vector<EnvironmentCluster>& clusters, const std::vector<dvec3>& directions) {
    const auto arriving = fluxPerDirection(clusters, directions, 0, 1);
    const auto normals = visibilityDirections(60), occluders = visibilityDirections(47);
    double squares = 0;
    int count = 0;
    for (const dvec3& n : normals)
        for (const dvec3& axis : occluders) {
            const double edge = std::cos(0.4 + 0.5 * (count % 7) / 7.0);
            double open = 0, exact = 0, all = 0, seen = 0;
            for (const EnvironmentCluster& c : clusters) {
                const double e = (c.flux.x + c.flux.y + c.flux.z) * std::max(dot(n, c.centroid), 0.0);
                open += e;
                exact += dot(axis, c.centroid) > edge ? 0 : e;
            }
            for (std::size_t i = 0; i < directions.size(); ++i) {
                const dvec3& flux = arriving[i].flux;
                const double e = (flux.x + flux.y + flux.z) * std::max(dot(n, arriving[i].direction), 0.0);
                all += e;
                seen += dot(axis, directions[i]) > edge ? 0 : e;
            }
            if (!(open > 0 && all > 0)) continue;
            squares += std::pow(seen / all - exact / open, 2);
            ++count;
        }
    return std::sqrt(squares / count);
}

TEST(VisibilityDirections, ofAnEvenSkyAreTheLattice) {
    const auto lattice = visibilityDirections(64);
    const auto found = visibilityDirections(uniformEnvironment(128, 64), 64);
    ASSERT_EQ(found.size(), 64u);
    for (std::size_t i = 0; i < 64; ++i) EXPECT_LT(glm::distance(found[i].direction, lattice[i]), 1e-3) << i;
    for (const Environment& tiny : {uniformEnvironment(1, 1), uniformEnvironment(3, 2)})
        EXPECT_EQ(visibilityDirections(tiny, 128).size(), 128u);
}

class VisibilityOf : public testing::TestWithParam<std::string> {};

// As many directions tell more where they lie where the light is.
TEST_P(VisibilityOf, directionsFollowTheLight) {
    const Environment environment = blenderEnvironment(GetParam());
    const auto clusters = clusterEnvironment(environment, 2000);
    std::vector<dvec3> adapted;
    double solidAngle = 0;
    for (const VisibilityDirection& d : visibilityDirections(environment, 128)) {
        EXPECT_NEAR(length(d.direction), 1, 1e-12);
        EXPECT_GE(d.solidAngle, 0);
        EXPECT_LT(d.solidAngle, 0.8) << "a gap in the sky";
        adapted.push_back(d.direction);
        solidAngle += d.solidAngle;
    }
    ASSERT_EQ(adapted.size(), 128u);
    EXPECT_NEAR(solidAngle, 4 * kPi, 1e-6);
    const double even = occlusionError(clusters, visibilityDirections(128)),
                 error = occlusionError(clusters, adapted);
    std::printf("occlusion error of %s: even directions %.4f, these %.4f\n", GetParam().c_str(), even, error);
    EXPECT_LT(error, 0.02);
    EXPECT_LT(error, even);
}

INSTANTIATE_TEST_SUITE_P(Blender, VisibilityOf, testing::ValuesIn(kBlenderEnvironments),
                         [](const auto& i) { return i.param; });

TEST(FluxPerDirection, keepsFluxAndTurnsWithTheEnvironment) {
    const Environment e = sunnyEnvironment(512, 256);
    const auto clusters = clusterEnvironment(e);
    const auto directions = visibilityDirections(128);
    dvec3 all(0);
    for (const auto& c : clusters) all += c.flux;
    const auto shares = fluxPerDirection(clusters, directions, 75, 2.5);
    dvec3 shared(0);
    const DirectionalFlux* brightest = &shares[0];
    for (const auto& s : shares) {
        shared += s.flux;
        EXPECT_NEAR(glm::length(s.direction), 1, 1e-12);
        if (s.flux.x > brightest->flux.x) brightest = &s;
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shared[c], 2.5 * all[c], 1e-9 * all[c]);
    const dvec3 sun = rotateAboutY(environmentDirection(170.5 / 512, 64.5 / 256), 75);
    EXPECT_GT(glm::dot(brightest->direction, sun), std::cos(0.05));
}
