// The specular lobe and its directional albedo against integration over light directions.
#include "renderer/skin/specular.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

using namespace cutis::skin;
using glm::dvec3;

namespace {

constexpr double kPi = std::numbers::pi;

// ∫∫ f(x, y) over a rectangle by Simpson's rule, subdivided until a cell agrees with its quarters.
// `mustSplit` forces subdivision where a narrow lobe may hide between samples.
template <typename F, typename Split>
double integrateAdaptively(const F& f, const Split& mustSplit, double x0, double x1, double y0, double y1,
                           double tolerance, int depth = 0) {
    const auto simpson = [&](double a0, double a1, double b0, double b1) {
        static const double w[3] = {1, 4, 1};
        double sum = 0;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                sum += w[i] * w[j] * f(a0 + 0.5 * i * (a1 - a0), b0 + 0.5 * j * (b1 - b0));
        return sum / 36 * (a1 - a0) * (b1 - b0);
    };
    const double xm = 0.5 * (x0 + x1), ym = 0.5 * (y0 + y1);
    const double whole = simpson(x0, x1, y0, y1);
    const double parts =
        simpson(x0, xm, y0, ym) + simpson(xm, x1, y0, ym) + simpson(x0, xm, ym, y1) + simpson(xm, x1, ym, y1);
    const bool settled = std::abs(whole - parts) < tolerance && !mustSplit(x0, x1, y0, y1);
    if (settled || depth >= 24) return parts;
    const double part = tolerance / 2;
    return integrateAdaptively(f, mustSplit, x0, xm, y0, ym, part, depth + 1) +
           integrateAdaptively(f, mustSplit, xm, x1, y0, ym, part, depth + 1) +
           integrateAdaptively(f, mustSplit, x0, xm, ym, y1, part, depth + 1) +
           integrateAdaptively(f, mustSplit, xm, x1, ym, y1, part, depth + 1);
}

// ρ_dt by brute force over the light's elevation and azimuth, refined around the mirror direction: nothing in
// common with the library but f_s itself.
double denseAlbedo(double mu, double m) {
    const double elevation = std::asin(mu);
    const dvec3 n(0, 0, 1), v(-std::cos(elevation), 0, mu);
    const auto f = [&](double e, double azimuth) {
        const dvec3 l(std::cos(e) * std::cos(azimuth), std::cos(e) * std::sin(azimuth), std::sin(e));
        return kelemenSpecular(n, v, l, m) * l.z * std::cos(e);
    };
    const auto mustSplit = [&](double e0, double e1, double a0, double a1) {
        const double e = std::clamp(elevation, e0, e1) - elevation,
                     across = std::cos(std::min(e1, elevation)) * a0;
        const double distance = std::hypot(e, across);
        return std::max(e1 - e0, a1 - a0) > std::max(0.25 * m, 0.25 * distance);
    };
    return 2 * integrateAdaptively(f, mustSplit, 0, kPi / 2, 0, kPi, 1e-5);
}

}  // namespace

TEST(Beckmann, projectedAreaIsOne) {
    for (double m : {1e-3, 0.02, 0.1, 0.3, 1.0}) {
        double sum = 0;
        const int n = 200000;
        const double reach = std::min(kPi / 2, std::atan(7 * m));
        for (int i = 0; i < n; ++i) {
            const double theta = (i + 0.5) / n * reach;
            sum += beckmann(std::cos(theta), m) * std::cos(theta) * std::sin(theta);
        }
        EXPECT_NEAR(sum * 2 * kPi * reach / n, 1, 1e-4) << "m = " << m;
    }
}

TEST(Beckmann, staysFiniteAtTheHorizon) {
    for (double m : {1e-3, 0.02, 0.3, 1.0})
        for (double c : {1.0, 1e-1, 1e-3, 1e-9, 1e-100, 1e-308, 0.0, -1.0}) {
            const double d = beckmann(c, m);
            EXPECT_TRUE(std::isfinite(d) && d >= 0) << c << " " << m;
            if (c < 1e-3) {
                EXPECT_EQ(d, 0) << c << " " << m;
            }
        }
}

TEST(Schlick, endsAtF0AndOne) {
    EXPECT_DOUBLE_EQ(schlick(1), 0.028);
    EXPECT_DOUBLE_EQ(schlick(0), 1);
    EXPECT_NEAR(schlick(0.5), 0.028 + 0.972 / 32, 1e-15);
}

TEST(Kelemen, isReciprocalAndZeroBelowTheSurface) {
    const dvec3 n(0, 0, 1);
    const dvec3 a = glm::normalize(dvec3(0.3, -0.2, 0.5)), b = glm::normalize(dvec3(-0.7, 0.1, 0.4));
    EXPECT_GT(kelemenSpecular(n, a, b, 0.5), 0);
    EXPECT_DOUBLE_EQ(kelemenSpecular(n, a, b, 0.5), kelemenSpecular(n, b, a, 0.5));
    EXPECT_EQ(kelemenSpecular(n, a, dvec3(b.x, b.y, -b.z), 0.5), 0);
    EXPECT_EQ(kelemenSpecular(n, n, -n, 0.5), 0);
    // At normal incidence and exitance h·h = 4: f = D(1) F0 / 4.
    EXPECT_NEAR(kelemenSpecular(n, n, n, 0.3), 0.028 / (4 * kPi * 0.09), 1e-12);
}

// Figure 5 of the model: the table against dense quadrature, within 0.002, in [0,1].
class DirectionalAlbedo : public testing::TestWithParam<double> {};

TEST_P(DirectionalAlbedo, tableMatchesDenseQuadrature) {
    const double m = GetParam();
    const std::vector<float> row = directionalAlbedoRow(m);
    double worst = 0, worstTable = 0;
    for (double mu : {0.01, 0.0137, 0.02, 0.033, 0.05, 0.08, 0.123, 0.2, 0.31, 0.45, 0.6, 0.77, 0.9, 1.0}) {
        const double dense = std::min(denseAlbedo(mu, m), 1.0);
        worst = std::max(worst, std::abs(directionalAlbedo(mu, m) - dense));
        worstTable = std::max(worstTable, std::abs(lookUpAlbedo(row, mu) - dense));
    }
    RecordProperty("exact", std::to_string(worst));
    RecordProperty("table", std::to_string(worstTable));
    EXPECT_LE(worst, 2e-4);
    EXPECT_LE(worstTable, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Roughness, DirectionalAlbedo,
                         testing::Values(0.02, 0.035, 0.05, 0.1, 0.17, 0.3, 0.45, 0.6, 0.8, 1.0));

TEST(DirectionalAlbedo, staysInRangeOnExtremeInput) {
    for (double m : {0.0, 1e-6, 1e-3, 0.01, 0.1, 1.0, 5.0})
        for (double mu : {-1.0, 0.0, 1e-30, 1e-9, 1e-4, 1e-3, 0.1, 0.999999, 1.0, 2.0}) {
            const double rho = directionalAlbedo(mu, m);
            EXPECT_TRUE(rho >= 0 && rho <= 1) << mu << " " << m << ": " << rho;
        }
}

TEST(DirectionalAlbedo, isAMirrorWhereTheLobeIsNarrow) {
    for (double mu : {0.1, 0.3, 1.0}) EXPECT_NEAR(directionalAlbedo(mu, 1e-3), schlick(mu), 2e-4) << mu;
}

// The table between its nodes, down to the narrowest lobe and to grazing angles that dense quadrature cannot
// reach.
TEST(DirectionalAlbedo, rowInterpolatesWithin2e3) {
    for (double m : {1e-3, 5e-3, 0.02, 0.1, 1.0}) {
        const std::vector<float> row = directionalAlbedoRow(m);
        ASSERT_EQ(int(row.size()), kAlbedoRowSize);
        double worst = 0;
        for (int i = 0; i < 2000; ++i) {
            const double mu = std::pow(10.0, -4 + 4 * i / 1999.0);
            worst = std::max(worst, std::abs(lookUpAlbedo(row, mu) - directionalAlbedo(mu, m)));
        }
        EXPECT_LE(worst, 0.002) << "m = " << m;
    }
}

TEST(DirectionalAlbedo, meanMatchesDirectIntegration) {
    for (double m : {0.02, 0.3, 1.0})
        for (double s : {0.5, 1.0, 4.0}) {
            double direct = 0;
            const int n = 4000;
            for (int i = 0; i < n; ++i) {
                const double mu = (i + 0.5) / n;
                direct += 2 * mu * std::min(1.0, s * directionalAlbedo(mu, m)) / n;
            }
            EXPECT_NEAR(meanAlbedo(m, s), direct, 2e-5) << m << " " << s;
            EXPECT_NEAR(meanAlbedo(directionalAlbedoRow(m), s), direct, 1e-4) << m << " " << s;
        }
}

TEST(DirectionalAlbedo, rowIsQuick) {
    const auto start = std::chrono::steady_clock::now();
    directionalAlbedoRow(0.3);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    EXPECT_LT(took.count(), 250);  // 4 ms on an idle core, some 100 with sanitizers
}

TEST(ClampedScale, neverExceedsOne) {
    EXPECT_DOUBLE_EQ(clampedScale(1, 0.5), 1);
    EXPECT_DOUBLE_EQ(clampedScale(3, 0.5), 2);
    EXPECT_DOUBLE_EQ(clampedScale(0, 1), 0);
    EXPECT_DOUBLE_EQ(clampedScale(7, 0), 7);
}
