// Light samples against closed forms.
#include "renderer/scene/light_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/core/error.h"

namespace cutis {
namespace {

constexpr double kPi = std::numbers::pi;

Light rectLight(const glm::dvec3& position, const glm::dvec3& direction, const glm::dvec2& size,
                int samples) {
    Light light;
    light.type = LightType::rect;
    light.position = position;
    light.direction = glm::normalize(direction);
    light.size = size;
    light.samples = samples;
    return light;
}

std::vector<LightSample> samplesOf(const Light& light) {
    Rig rig;
    rig.lights = {light};
    return sampleLights(rig);
}

double irradianceOf(const Light& light, const glm::dvec3& p, const glm::dvec3& n) {
    double sum = 0;
    for (const LightSample& sample : samplesOf(light)) sum += irradianceFrom(sample, p, n).x;
    return sum;
}

// Irradiance of a polygon of radiance 1 that lies above the receiver's horizon: ½ Σ angle · (n · edge normal)
// (Lambert 1760; Baum, Rushmeier & Winget, SIGGRAPH 1989, eq. 5).
double lambertPolygon(const std::vector<glm::dvec3>& corners, const glm::dvec3& p, const glm::dvec3& n) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(corners[i] - p);
        const glm::dvec3 b = glm::normalize(corners[(i + 1) % corners.size()] - p);
        sum += 0.5 * std::acos(glm::dot(a, b)) * glm::dot(n, glm::normalize(glm::cross(a, b)));
    }
    return std::abs(sum);
}

double lambertRect(const Light& light, const glm::dvec3& p, const glm::dvec3& n) {
    // The same frame by a different road: horizontal width, then height.
    const glm::dvec3 x =
        glm::normalize(glm::cross(light.direction, glm::dvec3(0, 1, 0))) * (light.size.x / 2);
    const glm::dvec3 y = glm::normalize(glm::cross(x, light.direction)) * (light.size.y / 2);
    const glm::dvec3 c = light.position;
    return lambertPolygon({c - x - y, c + x - y, c + x + y, c - x + y}, p, n);
}

// Howell's catalogue, B-3: element parallel to a rectangle a × b at distance c, below one of its corners.
double howellB3(double a, double b, double c) {
    const double x = a / c, y = b / c;
    return (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
            y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y))) /
           (2 * kPi);
}

TEST(RectLight, ReferenceFormulasAgree) {
    const Light light = rectLight({0, 1, 0.5}, {0, 0, -1}, {0.6, 0.9}, 1);
    const double polygon = lambertRect(light, {0, 1, 0}, {0, 0, 1});
    EXPECT_NEAR(polygon, kPi * 4 * howellB3(0.3, 0.45, 0.5), 1e-12);
}

struct RectCase {
    const char* name;
    glm::dvec3 direction, receiver, normal;  // the light's centre is at the origin
};

class RectFormFactor : public testing::TestWithParam<RectCase> {};

// Issue figure: within 1 % at 64 samples, parallel and tilted receivers, near and far.
TEST_P(RectFormFactor, WithinOnePercentAt64Samples) {
    const RectCase& c = GetParam();
    for (const glm::dvec2 size : {glm::dvec2(1, 1), glm::dvec2(0.6, 0.9), glm::dvec2(1.2, 0.3)}) {
        const Light light = rectLight({0, 0, 0}, c.direction, size, 64);
        const glm::dvec3 n = glm::normalize(c.normal);
        const double exact = lambertRect(light, c.receiver, n);
        ASSERT_GT(exact, 0);
        EXPECT_NEAR(irradianceOf(light, c.receiver, n) / exact, 1, 0.01) << size.x << " x " << size.y;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Receivers, RectFormFactor,
    testing::Values(RectCase{"parallel_near", {0, 0, -1}, {0, 0, -0.3}, {0, 0, 1}},
                    RectCase{"parallel_off_axis", {0, 0, -1}, {0.4, -0.2, -0.5}, {0, 0, 1}},
                    RectCase{"parallel_far", {0, 0, -1}, {1, 2, -8}, {0, 0, 1}},
                    RectCase{"tilted_near", {0, 0, -1}, {0.1, 0.1, -0.5}, {0.3, 0.2, 1}},
                    RectCase{"tilted_far", {0, 0, -1}, {0, 1, -5}, {1, -0.4, 0.8}},
                    RectCase{"turned_light", {0.8, -0.1, -0.5}, {0.9, -0.2, -0.7}, {-1, 0.4, 0.5}},
                    RectCase{"light_from_above", {0.2, -1, 0.1}, {0.1, -0.8, 0}, {0, 1, 0.3}}),
    [](const testing::TestParamInfo<RectCase>& test) { return std::string(test.param.name); });

// Few samples, as pictures use them: 2 m from a softbox, in front of it. As points they give 0.7 and 7 % too
// much.
TEST(RectLight, FewSamplesGiveTheLightOfItsArea) {
    for (const auto& [samples, limit] : {std::pair{9, 0.003}, std::pair{1, 0.02}}) {
        const Light light = rectLight({0, 0, 0}, {0, 0, -1}, {0.9, 1.2}, samples);
        for (const glm::dvec3& p :
             {glm::dvec3(0, 0, -2), glm::dvec3(0.3, 0.1, -2), glm::dvec3(-0.2, 0.4, -2.2)}) {
            const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, -0.4, 1));
            EXPECT_NEAR(irradianceOf(light, p, n) / lambertRect(light, p, n), 1, limit) << samples;
        }
    }
}

TEST(RectLight, EmitsFromItsFrontOnly) {
    const Light light = rectLight({0, 0, 0}, {0, 0, -1}, {1, 1}, 16);
    EXPECT_GT(irradianceOf(light, {0, 0, -1}, {0, 0, 1}), 0.5);
    EXPECT_EQ(irradianceOf(light, {0, 0, 1}, {0, 0, -1}), 0);
}

TEST(RectLight, WidthIsHorizontal) {
    for (const glm::dvec3 direction :
         {glm::dvec3(0, 0, -1), glm::dvec3(1, -0.7, 0.3), glm::dvec3(-0.2, 0.9, 0.1)}) {
        const Light light = rectLight({0, 2, 0}, direction, {2, 0.5}, 16);  // a grid of 8 × 2
        double reach = 0;
        for (const LightSample& sample : samplesOf(light)) {
            EXPECT_NEAR(glm::dot(sample.position - light.position, light.direction), 0, 1e-12);
            reach = std::max(reach, std::abs(sample.position.y - 2));
        }
        // The height's half, 0.25, less half a cell, tilted as the light is.
        EXPECT_NEAR(reach, 0.125 * std::hypot(light.direction.x, light.direction.z), 1e-12);
    }
}

TEST(RectLight, VerticalDirectionIsWellDefined) {
    for (const double y : {-1.0, 1.0}) {
        const RectAxes axes = rectAxes({0, y, 0});
        EXPECT_NEAR(glm::length(axes.x), 1, 1e-15);
        EXPECT_NEAR(glm::length(axes.y), 1, 1e-15);
        EXPECT_NEAR(glm::dot(axes.x, axes.y), 0, 1e-15);
        EXPECT_NEAR(axes.x.y, 0, 1e-15);
    }
}

// Any count: as much light as the rectangle has, centred on it and spread over it.
TEST(RectLight, AnyCountIsCentredAndSpread) {
    for (int n = 1; n <= 130; ++n) {
        const auto samples = samplesOf(rectLight({0, 0, 0}, {0, 0, -1}, {1, 1}, n));
        ASSERT_EQ(samples.size(), static_cast<std::size_t>(n));
        glm::dvec3 mean(0), square(0);
        double candela = 0;
        for (const LightSample& sample : samples) {
            mean += sample.position / double(n);
            square += sample.position * sample.position / double(n);
            candela += sample.intensity.x;
            EXPECT_TRUE(sample.cosineEmission);
            EXPECT_NEAR(sample.radius, 0.5 / std::sqrt(n), 1e-12);
            EXPECT_LT(std::max(std::abs(sample.position.x), std::abs(sample.position.y)), 0.5);
        }
        EXPECT_NEAR(candela, 1, 1e-12) << n;
        EXPECT_NEAR(glm::length(mean), 0, 1e-12) << n;
        // Midpoints of an a × b grid have the variance (1 - 1/a²)/12 along a, a lattice (1 - 1/n²)/12.
        const double tolerance = n == 1 ? 1.0 : n < 12 ? 0.26 : 0.12;
        EXPECT_NEAR(square.x * 12, 1, tolerance) << n;
        EXPECT_NEAR(square.y * 12, 1, tolerance) << n;
    }
}

// A ball light gives exactly the irradiance of the point light in its centre where all of it is above the
// horizon.
TEST(BallLight, EqualsThePointLightOutside) {
    Light light;
    light.position = {0.2, 1.5, 0.3};
    light.intensity = 8;
    const glm::dvec3 p(0, 0, 0), n(0, 1, 0);
    const double exact = irradianceOf(light, p, n);
    EXPECT_NEAR(exact, 8 * 1.5 / std::pow(glm::length(light.position), 3), 1e-12);
    light.radius = 0.3;
    for (const int samples : {0, 16, 64, 256}) {
        light.samples = samples;
        // Six samples, the default, are a coarse ball: 2 %; many are a good one: 0.5 %.
        EXPECT_NEAR(irradianceOf(light, p, n) / exact, 1, samples == 0 ? 0.02 : 0.005) << samples;
    }
}

// Seen from any side it is an even disc: the fraction within a circle of half the radius is a quarter.
TEST(BallLight, LooksLikeAnEvenDisc) {
    Light light;
    light.radius = 2;
    light.samples = 4096;
    const auto samples = samplesOf(light);
    for (const glm::dvec3 view :
         {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::normalize(glm::dvec3(1, 2, -1))}) {
        int inside = 0;
        for (const LightSample& sample : samples) {
            EXPECT_LE(glm::length(sample.position), 2.0);
            inside += glm::length(glm::cross(sample.position, view)) < 1;
        }
        EXPECT_NEAR(inside / 4096.0, 0.25, 0.01);
    }
}

TEST(SpotLight, ConeAndRangeFollowKhrLightsPunctual) {
    Light light;
    light.type = LightType::spot;
    light.innerConeAngle = 0.3;
    light.outerConeAngle = 0.6;
    light.range = 4;
    const auto at = [&](double angle, double distance) {
        const glm::dvec3 p = distance * glm::dvec3(std::sin(angle), 0, -std::cos(angle));
        return irradianceOf(light, p, -glm::normalize(p));
    };
    const double window = 1 - std::pow(0.25, 4);
    EXPECT_NEAR(at(0, 1), window, 1e-12);
    EXPECT_NEAR(at(0.29, 1), window, 1e-12);
    const double t = (std::cos(0.5) - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6));
    EXPECT_NEAR(at(0.5, 1), window * t * t, 1e-12);
    EXPECT_EQ(at(0.61, 1), 0);
    EXPECT_EQ(at(0, 4), 0);
}

TEST(SpotLight, RadiusIsADiscAcrossTheAxis) {
    Light light;
    light.type = LightType::spot;
    light.direction = glm::normalize(glm::dvec3(1, -2, 0.5));
    light.radius = 0.1;
    light.samples = 64;
    glm::dvec3 mean(0);
    double candela = 0, square = 0;
    for (const LightSample& sample : samplesOf(light)) {
        EXPECT_NEAR(glm::dot(sample.position, light.direction), 0, 1e-12);
        EXPECT_LE(glm::length(sample.position), 0.1);
        EXPECT_FALSE(sample.cosineEmission);
        mean += sample.position;
        candela += sample.intensity.y;
        square += glm::dot(sample.position, sample.position) / 64;
    }
    EXPECT_NEAR(glm::length(mean), 0, 1e-12);
    EXPECT_NEAR(candela, 1, 1e-12);
    EXPECT_NEAR(square / (0.01 / 2), 1, 0.04);  // an even disc has the mean square R²/2
}

TEST(DirectionalLight, FallsWithTheCosine) {
    Light light;
    light.type = LightType::directional;
    light.direction = {0, -1, 0};
    light.color = {1, 0.5, 0};
    light.intensity = 3;
    const auto samples = samplesOf(light);
    ASSERT_EQ(samples.size(), 1u);
    const glm::dvec3 e = irradianceFrom(samples[0], {5, 6, 7}, glm::normalize(glm::dvec3(0, 1, 1)));
    EXPECT_NEAR(e.x, 3 * std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(e.y, 1.5 * std::sqrt(0.5), 1e-12);
    EXPECT_EQ(e.z, 0);
    EXPECT_EQ(irradianceFrom(samples[0], {0, 0, 0}, {0, -1, 0}).x, 0);
}

TEST(SampleLights, DefaultsAndDisabledLights) {
    Rig rig;
    rig.lights.resize(3);
    rig.lights[1].enabled = false;
    rig.lights[2] = rectLight({0, 0, 0}, {0, 0, -1}, {1, 1}, 0);
    const auto samples = sampleLights(rig);
    ASSERT_EQ(samples.size(), 10u);  // a point and the 9 of a rect
    EXPECT_EQ(samples[0].light, 0);
    EXPECT_EQ(samples[1].light, 2);
    rig.lights[0].radius = 0.1;
    EXPECT_EQ(sampleLights(rig).size(), 15u);
}

TEST(SampleLights, RefusesTooMany) {
    Rig rig;
    rig.lights.assign(100, rectLight({0, 0, 0}, {0, 0, -1}, {1, 1}, 1000));
    EXPECT_THROW(sampleLights(rig), Error);
    EXPECT_EQ(sampleLights(rig, {100000}).size(), 100000u);
}

// Chromaticities of black bodies: Wyszecki & Stiles, Color Science, 2nd ed., table 1(3.11).
// Of a light whose distance is small against it, cells of one size would all but miss what shines most.
TEST(RectSamples, LargeLightsAreDividedBySolidAngle) {
    const glm::dvec3 subject(0.1, 0, -0.5);
    const auto irradianceAt = [&](const Light& light, const glm::dvec3& towards) {
        Rig rig;
        rig.lights = {light};
        SamplingOptions options;
        options.subject = subject;
        double sum = 0;
        for (const LightSample& sample : sampleLights(rig, options))
            sum += irradianceFrom(sample, subject, towards).x;
        return sum;
    };
    const auto lightOfWidth = [](double width, int samples) {
        return rectLight({0, 0, 0}, {0, 0, -1}, {width, 0.8 * width}, samples);
    };
    for (const auto& [samples, tolerance] : {std::pair(9, 0.12), {64, 0.025}}) {
        for (const double width : {1.5, 5.0, 50.0, 1e4}) {
            const Light light = lightOfWidth(width, samples);
            EXPECT_NEAR(irradianceAt(light, {0, 0, 1}) / lambertRect(light, subject, {0, 0, 1}), 1, tolerance)
                << width;
        }
        // A half space of light, seen at a slant: the view factor of a plane to a half space that it is
        // tilted against.
        for (const glm::dvec3& towards : {glm::dvec3(0.6, 0, 0.8), {0, -0.8, 0.6}, {0.96, 0, 0.28}})
            EXPECT_NEAR(irradianceAt(lightOfWidth(1e4, samples), towards) / (kPi * (1 + towards.z) / 2), 1,
                        tolerance);
    }
}

TEST(ColorFromTemperature, LiesOnThePlanckianLocus) {
    const struct {
        double kelvin, x, y;
    } table[] = {{2000, .5267, .4133},  {2500, .4770, .4137},  {2856, .4476, .4074}, {3000, .4369, .4041},
                 {4000, .3805, .3767},  {5000, .3451, .3516},  {6000, .3221, .3318}, {6500, .3135, .3237},
                 {10000, .2807, .2884}, {20000, .2565, .2577}, {25000, .2525, .2523}};
    for (const auto& row : table) {
        const glm::dvec3 c = colorFromTemperature(row.kelvin);
        const double x = 0.4123908 * c.r + 0.3575843 * c.g + 0.1804808 * c.b;
        const double y = 0.2126390 * c.r + 0.7151687 * c.g + 0.0721923 * c.b;
        const double z = 0.0193308 * c.r + 0.1191948 * c.g + 0.9505322 * c.b;
        EXPECT_NEAR(y, 1, 1e-3) << row.kelvin;
        EXPECT_NEAR(x / (x + y + z), row.x, 0.003) << row.kelvin;
        EXPECT_NEAR(y / (x + y + z), row.y, 0.003) << row.kelvin;
    }
}

TEST(ColorFromTemperature, StaysInGamutAndRange) {
    for (const double kelvin : {-5.0, 0.0, 1000.0, 1500.0, 40000.0, 1e9}) {
        const glm::dvec3 c = colorFromTemperature(kelvin);
        EXPECT_GE(std::min({c.r, c.g, c.b}), 0) << kelvin;
        EXPECT_NEAR(glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722)), 1, 1e-12) << kelvin;
    }
}

TEST(LightIntensity, TemperatureMultipliesColor) {
    Light light;
    light.color = {1, 0.5, 0.25};
    light.intensity = 2;
    light.temperature = 3000;
    const glm::dvec3 tint = colorFromTemperature(3000), rgb = lightIntensity(light);
    EXPECT_DOUBLE_EQ(rgb.r, 2 * tint.r);
    EXPECT_DOUBLE_EQ(rgb.g, tint.g);
    EXPECT_DOUBLE_EQ(rgb.b, 0.5 * tint.b);
}

}  // namespace
}  // namespace cutis
