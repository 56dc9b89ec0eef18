// Profiles: moments, closed forms against direct integration, reduction and refusals.
#include "renderer/skin/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/core/error.h"

using namespace cutis;
using namespace cutis::skin;

namespace {

// ∫ f over [a, b] by the midpoint rule: slow, and unlike anything in the library.
template <typename F>
glm::dvec3 midpoint(double a, double b, int n, F&& f) {
    glm::dvec3 sum(0);
    for (int i = 0; i < n; ++i) sum += f(a + (b - a) * (i + 0.5) / n);
    return sum * ((b - a) / n);
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
}

}  // namespace

TEST(Profile, threeLayersConserveEnergy) {
    expectNear(totalWeight(threeLayerProfile()), glm::dvec3(1), 1e-12);
}

TEST(Profile, integratesToItsWeightAndSecondMoment) {
    const Profile p = threeLayerProfile();
    const double pi = std::numbers::pi;
    // r = e^x: narrow and wide Gaussians alike.
    const auto moment = [&](int power) {
        return midpoint(std::log(1e-4), std::log(30.0), 20000, [&](double x) {
            const double r = std::exp(x);
            return 2 * pi * r * r * std::pow(r, power) * evaluate(p, r);
        });
    };
    expectNear(moment(0), totalWeight(p), 1e-4);
    expectNear(moment(2), 2.0 * secondMoment(p), 1e-4);
}

TEST(Profile, edgeResponseIsTheIntegralOverAHalfPlane) {
    const Profile p = threeLayerProfile();
    for (double x : {-4.0, -0.3, 0.0, 0.05, 1.7}) {
        // Lines through the lit half plane: ∫ over y of G(v, r) is a Gaussian of one dimension, here summed
        // directly.
        const glm::dvec3 direct = midpoint(-30, x, 60000, [&](double d) {
            glm::dvec3 line(0);
            for (const Gaussian& g : p.gaussians)
                line += g.weight *
                        (std::exp(-d * d / (2 * g.variance)) / std::sqrt(2 * std::numbers::pi * g.variance));
            return line;
        });
        expectNear(edgeResponse(p, x), direct, 1e-5);
        expectNear(edgeResponse(p, x) + edgeResponse(p, -x), totalWeight(p), 1e-12);
    }
}

TEST(Profile, slabTransmissionIsTheIntegralOverTheLitFace) {
    const Profile p = threeLayerProfile();
    for (double t : {0.25, 1.0, 2.0, 4.0}) {
        const glm::dvec3 direct = midpoint(0, 40, 100000, [&](double r) {
            return 2 * std::numbers::pi * r * evaluate(p, std::sqrt(r * r + t * t));
        });
        expectNear(slabTransmission(p, t), direct, 1e-6);
    }
}

TEST(Profile, scalesLengths) {
    const Profile p = threeLayerProfile(), half = scaled(p, 0.5);
    expectNear(secondMoment(half), 0.25 * secondMoment(p), 1e-12);
    expectNear(evaluate(half, 0.35), 4.0 * evaluate(p, 0.7), 1e-12);
    expectNear(edgeResponse(half, 0.35), edgeResponse(p, 0.7), 1e-12);
}

TEST(Profile, reductionKeepsWeightAndSecondMoment) {
    const Profile p = threeLayerProfile();
    double previous = std::numeric_limits<double>::infinity();
    for (int k = 1; k <= 6; ++k) {
        const Profile r = reduced(p, k);
        ASSERT_EQ(int(r.gaussians.size()), k);
        expectNear(totalWeight(r), totalWeight(p), 1e-12);
        const glm::dvec3 a = secondMoment(r), b = secondMoment(p);
        EXPECT_NEAR(a.x + a.y + a.z, b.x + b.y + b.z, 1e-12);
        for (int i = 1; i < k; ++i) EXPECT_LT(r.gaussians[i - 1].variance, r.gaussians[i].variance);
        const glm::dvec3 squared = midpoint(-20, 20, 20000, [&](double x) {
            const glm::dvec3 d = edgeResponse(r, x) - edgeResponse(p, x);
            return d * d;
        });
        const double error = squared.x + squared.y + squared.z;
        EXPECT_LT(error, previous) << k << " Gaussians";
        previous = error > 0 ? error : -1;
    }
    EXPECT_EQ(reduced(p, 6), p);
    EXPECT_EQ(reduced(p, 100), p);
}

// The documented rule: no other cut into runs of neighbours has a smaller summed error of its runs; on this
// profile it is also the best by the error of the whole.
TEST(Profile, reductionTakesTheBestCut) {
    const Profile p = threeLayerProfile();
    const auto errorOf = [&](const Profile& r) {
        const glm::dvec3 e = midpoint(-20, 20, 8000, [&](double x) {
            const glm::dvec3 d = edgeResponse(r, x) - edgeResponse(p, x);
            return d * d;
        });
        return e.x + e.y + e.z;
    };
    const double chosen = errorOf(reduced(p, 2));
    for (std::size_t cut = 1; cut < 6; ++cut) {
        Profile lower, upper;
        lower.gaussians.assign(p.gaussians.begin(), p.gaussians.begin() + cut);
        upper.gaussians.assign(p.gaussians.begin() + cut, p.gaussians.end());
        Profile other = reduced(lower, 1);
        other.gaussians.push_back(reduced(upper, 1).gaussians[0]);
        EXPECT_GE(errorOf(other), chosen * (1 - 1e-9)) << "cut at " << cut;
    }
}

TEST(Profile, sortsAndJoinsEqualVariances) {
    const Profile p{{{2, {0.1, 0, 0}}, {1, {0.2, 0, 0}}, {2, {0.3, 0, 0}}}};
    const Profile s = sorted(p);
    ASSERT_EQ(s.gaussians.size(), 2u);
    EXPECT_EQ(s.gaussians[0].variance, 1);
    EXPECT_DOUBLE_EQ(s.gaussians[1].weight.x, 0.4);
}

TEST(Profile, refusesWhatIsImpossible) {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    EXPECT_NO_THROW(validate(threeLayerProfile(), "here"));
    const Profile bad[] = {{},
                           {{{0, {1, 1, 1}}}},
                           {{{-1, {1, 1, 1}}}},
                           {{{nan, {1, 1, 1}}}},
                           {{{inf, {1, 1, 1}}}},
                           {{{1, {-0.1, 1, 1}}}},
                           {{{1, {1, nan, 1}}}},
                           {{{1, {0, 0, 0}}}},
                           {std::vector<Gaussian>(kMaxGaussians + 1, Gaussian{1, {1, 1, 1}})}};
    for (const Profile& p : bad) {
        try {
            validate(p, "materials[3]");
            ADD_FAILURE() << "accepted";
        } catch (const Error& e) {
            EXPECT_EQ(e.where(), "materials[3]");
        }
    }
}
