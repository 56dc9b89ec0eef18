#include "extreme.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "tests/support/pictures.h"

namespace cutis::test {
namespace {

void checkFinite(const std::string& name, const Picture& picture) {
    EXPECT_EQ(countNonfinite(picture), 0u) << name;
}

// The least and the most of the first three channels where the surface is seen, and how many pixels that are.
struct Range {
    glm::dvec3 least{std::numeric_limits<double>::infinity()}, most{-std::numeric_limits<double>::infinity()};
    int pixels = 0;
};

Range rangeOf(const Rendered& result, double leastCosine) {
    Range range;
    for (int y = 0; y < result.picture.height; ++y)
        for (int x = 0; x < result.picture.width; ++x) {
            if (valueAt(result.picture, x, y, 3) < 0.999 ||
                valueAt(result.aov("normal"), x, y, 2) < leastCosine)
                continue;
            range.least = glm::min(range.least, rgbAt(result.picture, x, y));
            range.most = glm::max(range.most, rgbAt(result.picture, x, y));
            ++range.pixels;
        }
    return range;
}

// Relative L2 over the pixels that see nothing but the surface.
double errorAgainst(const std::function<glm::dvec3(const glm::dvec3&)>& exact, const Rendered& result) {
    double difference = 0, whole = 0;
    for (int y = 0; y < result.picture.height; ++y)
        for (int x = 0; x < result.picture.width; ++x) {
            if (valueAt(result.picture, x, y, 3) < 0.999) continue;
            const glm::dvec3 expected = exact(rgbAt(result.aov("normal"), x, y));
            const glm::dvec3 off = rgbAt(result.picture, x, y) - expected;
            difference += glm::dot(off, off), whole += glm::dot(expected, expected);
        }
    return std::sqrt(difference / whole);
}

}  // namespace

Expected rendered(std::function<RenderJob()> job) {
    const auto picture = std::make_shared<std::optional<Picture>>();
    return [picture, job = std::move(job)]() -> const Picture& {
        if (!*picture) *picture = render(job()).picture;
        return **picture;
    };
}

void PrintTo(const Extreme& extreme, std::ostream* out) {
    *out << extreme.name;
}

RenderJob pictureOf(SceneBuilder builder) {
    if (builder.scene().cameras.empty()) builder.setOrthographicCamera({0, 0, 0.5}, {0, 0, 0}, 0.21);
    return {.scene = builder.scene(), .width = kPixels, .height = kPixels};
}

Primitive sphere(double radius, SphereMapping mapping) {
    return makeSphere(radius, mapping, glm::dmat3(1), 1 / 3.0);
}

RenderJob sphereJob(const SkinMaterial& skin, const glm::dvec3& albedo) {
    SceneBuilder builder;
    builder.addObject("body", sphere(), builder.addSkin(skin, albedo));
    return pictureOf(builder);
}

RenderJob inUniformLight(RenderJob job) {
    job.environment = makeEnvironment(16, 8, [](const glm::dvec3&) { return glm::dvec3(1); });
    return job;
}

RenderJob inLight(RenderJob job, std::vector<Light> lights) {
    job.lights = std::move(lights);
    return job;
}

void check(const Extreme& extreme) {
    const auto start = std::chrono::steady_clock::now();
    RenderJob job = extreme.job();
    job.aovs = {"diffuse", "specular", "irradiance", "thickness", "normal", "position", "depth"};
    const Rendered result = render(job);
    if (const char* folder = std::getenv("CUTIS_STABILITY_PICTURES")) {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        const std::string group = test->test_suite_name();
        writeExr(
            std::filesystem::path(folder) / (group.substr(group.find('/') + 1) + '-' + extreme.name + ".exr"),
            result.picture);
    }
    checkFinite("picture", result.picture);
    for (const auto& [name, picture] : result.aovs) checkFinite(name, picture);
    for (const char* name : {"diffuse", "specular", "irradiance"})
        for (const float value : result.aov(name).values) ASSERT_GE(value, 0) << name;
    const Range range = rangeOf(result, extreme.leastCosine);
    const int leastPixels = std::min(extreme.leastPixels, job.width * job.height);
    EXPECT_GE(range.pixels, leastPixels) << "nearly nothing is seen";
    for (int c = 0; c < 3 && range.pixels > 0; ++c) {
        EXPECT_GE(range.least[c], extreme.bounds.least[c]) << "channel " << c;
        EXPECT_LE(range.most[c], extreme.bounds.most[c]) << "channel " << c;
    }
    double error = 0;
    if (extreme.exact) {
        EXPECT_LE(error = errorAgainst(extreme.exact, result), extreme.tolerance);
    }
    if (extreme.other) {
        Picture expected = extreme.other();
        for (std::size_t i = 0; i < expected.values.size(); ++i)
            if (i % 4 != 3) expected.values[i] *= static_cast<float>(extreme.factor);
        EXPECT_LE(error = relativeL2(result.picture, expected), extreme.tolerance);
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::printf("stability: %-40s %.6g to %.6g, error %.3g, in %.1f s\n", extreme.name.c_str(),
                glm::min(range.least.x, glm::min(range.least.y, range.least.z)),
                glm::max(range.most.x, glm::max(range.most.y, range.most.z)), error, seconds.count());
}

}  // namespace cutis::test
