// Values of animation curves, against closed forms (glTF 2.0, appendix C).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/scene/pose.h"

namespace cutis {
namespace {

constexpr double kPi = std::numbers::pi;

AnimationSampler curve(Interpolation interpolation, std::size_t components, std::vector<float> times,
                       std::vector<float> values) {
    return {interpolation, components, std::move(times), std::move(values)};
}

// About z by that angle: x y z w.
std::vector<float> turn(double angle) {
    return {0, 0, float(std::sin(angle / 2)), float(std::cos(angle / 2))};
}

double angleOf(const std::vector<double>& q) {
    return 2 * std::atan2(q[2], q[3]);
}

template <class T>
std::vector<T> joined(std::vector<T> a, const std::vector<T>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

TEST(AnimationCurve, StepsHoldAKeyUntilTheNext) {
    const AnimationSampler c = curve(Interpolation::step, 3, {1, 2, 4}, {1, 0, 0, 2, 0, 0, 3, 0, 0});
    EXPECT_EQ(sampleCurve(c, false, 1.0)[0], 1);
    EXPECT_EQ(sampleCurve(c, false, 1.999)[0], 1);
    EXPECT_EQ(sampleCurve(c, false, 2.0)[0], 2);
    EXPECT_EQ(sampleCurve(c, false, 3.999)[0], 2);
    EXPECT_EQ(sampleCurve(c, false, 4.0)[0], 3);
}

TEST(AnimationCurve, LinesBetweenKeysAndNothingBeyondThem) {
    const AnimationSampler c = curve(Interpolation::linear, 2, {0.5f, 1.5f, 3.5f}, {0, 10, 2, 20, 6, 0});
    for (const auto& [time, first, second] : {std::array{-7.0, 0.0, 10.0},
                                              {0.5, 0.0, 10.0},
                                              {1.0, 1.0, 15.0},
                                              {1.5, 2.0, 20.0},
                                              {2.0, 3.0, 15.0},
                                              {99.0, 6.0, 0.0}}) {
        EXPECT_NEAR(sampleCurve(c, false, time)[0], first, 1e-12) << time;
        EXPECT_NEAR(sampleCurve(c, false, time)[1], second, 1e-12) << time;
    }
}

TEST(AnimationCurve, OneKeyIsAConstant) {
    for (const Interpolation i : {Interpolation::linear, Interpolation::step})
        EXPECT_EQ(sampleCurve(curve(i, 3, {2}, {4, 5, 6}), false, 1), (std::vector<double>{4, 5, 6}));
    const AnimationSampler cubic = curve(Interpolation::cubicSpline, 1, {2}, {100, 7, 100});
    EXPECT_EQ(sampleCurve(cubic, false, 3), std::vector<double>{7});
}

// Turning at one speed: the angle is linear in time.
TEST(AnimationCurve, RotationsTurnAtOneSpeed) {
    const AnimationSampler c =
        curve(Interpolation::linear, 4, {0, 2}, joined(turn(0.2), turn(0.2 + 0.7 * kPi)));
    for (double t = 0; t <= 2; t += 0.125) {
        const std::vector<double> q = sampleCurve(c, true, t);
        EXPECT_NEAR(angleOf(q), 0.2 + 0.35 * kPi * t, 1e-6) << t;
        EXPECT_NEAR(std::hypot(q[2], q[3]), 1, 1e-12);
    }
}

// q and -q are one rotation: from 10 to 40 degrees is 30 degrees, not 330.
TEST(AnimationCurve, RotationsTakeTheShorterWay) {
    std::vector<float> opposite = turn(40 * kPi / 180);
    for (float& v : opposite) v = -v;
    const AnimationSampler c =
        curve(Interpolation::linear, 4, {0, 1}, joined(turn(10 * kPi / 180), opposite));
    EXPECT_NEAR(std::abs(std::remainder(angleOf(sampleCurve(c, true, 0.5)), 2 * kPi)), 25 * kPi / 180, 1e-6);
}

// A Hermite spline through values and slopes of a cubic is that cubic.
TEST(AnimationCurve, CubicSplinesReproduceCubics) {
    const auto cubic = [](double t) { return 2 * t * t * t - 3 * t * t + t - 5; };
    const auto slope = [](double t) { return 6 * t * t - 6 * t + 1; };
    AnimationSampler c = curve(Interpolation::cubicSpline, 1, {-1, 0.5f, 3}, {});
    for (const float t : c.times) {
        for (const double v : {slope(t), cubic(t), slope(t)}) c.values.push_back(float(v));
    }
    for (double t = -1; t <= 3; t += 0.1) EXPECT_NEAR(sampleCurve(c, false, t)[0], cubic(t), 1e-5) << t;
    EXPECT_NEAR(sampleCurve(c, false, 5)[0], cubic(3), 1e-5);
}

TEST(AnimationCurve, CubicRotationsAreOfUnitLength) {
    const std::vector<float> none(4, 0);
    const AnimationSampler c =
        curve(Interpolation::cubicSpline, 4, {0, 1},
              joined(joined(joined(none, turn(0)), none), joined(joined(none, turn(2)), none)));
    const std::vector<double> q = sampleCurve(c, true, 0.5);
    EXPECT_NEAR(std::hypot(q[2], q[3]), 1, 1e-12);
    EXPECT_NEAR(angleOf(q), 1, 1e-6);  // by symmetry
}

}  // namespace
}  // namespace cutis
