// Figure 1 of the exact reference: diffusion against closed forms, and whether its standard error covers its
// error.
#include "tests/support/closed_forms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "tests/reference/bodies.h"
#include "tests/reference/evaluate.h"
#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLux = 2;

// The aim is 0.5 % of the diffusion's own effect, ‖L - exact‖ / ‖exact - undiffused‖. How far noise lets a
// run of a few seconds get is each case's own limit; CUTIS_LONG_TESTS=1 takes the minutes that the aim needs.
constexpr double kAim = 0.005;
constexpr int kLongerRuns = 40;

bool longRuns() {
    const char* asked = std::getenv("CUTIS_LONG_TESTS");
    return asked && std::string(asked) == "1";
}

int passesFor(int passes) {
    return longRuns() ? kLongerRuns * passes : passes;
}

// Eight sequences of samples: (value - exact) / standard error follows Student's t with seven degrees of
// freedom.
constexpr double kStudentSquare = 7.0 / 5.0;

// Values of M for unit irradiance against their closed form. Pixels of one column have the same exact value
// here, so the figure is of the means over columns, while each pixel counts for what its own standard error
// promises.
class Comparison {
  public:
    // `exact` and `undiffused` are means over the pixel.
    void add(const reference::Result& result, int x, int y, const glm::dvec3& exact, double undiffused) {
        Column& column = columns_[x];
        ++column.count;
        for (int c = 0; c < 3; ++c) {
            const double value = valueAt(result.aovs.at("diffuse"), x, y, c) * kPi / kLux;
            const double standardError = valueAt(result.diffuseStandardError, x, y, c) * kPi / kLux;
            column.error[c] += value - exact[c];
            column.effect[c] += exact[c] - undiffused;
            // Rare samples, where hardly any light is left, and roundings, where nothing varies, are no
            // normal errors.
            if (exact[c] > 0.01 && standardError > 1e-5) cover_.add(value, exact[c], standardError);
        }
    }
    // limit: of a short run. coverSlack: how far the mean square of error over standard error may be off,
    // relatively.
    void expect(const std::string& name, double limit, std::size_t leastCount, double coverSlack) const {
        NormRatio figure;
        for (const auto& [x, column] : columns_)
            for (int c = 0; c < 3; ++c)
                for (int i = 0; i < column.count; ++i)
                    figure.add(column.error[c] / column.count, column.effect[c] / column.count);
        expectAtMost("reference " + name + ", of the diffusion's effect", figure.value(),
                     longRuns() ? kAim : limit);
        if (cover_.count() > 0) {
            reportFigure("reference " + name + ", mean of error / standard error", cover_.mean());
            reportFigure("reference " + name + ", mean square of it", cover_.meanSquare());
        }
        // What long runs of large spheres leave is mostly below what counts.
        if (longRuns() && cover_.count() < leastCount) return;
        ASSERT_GE(cover_.count(), leastCount) << name;
        // Pixels share no random number; the channels of one do.
        const double independent = static_cast<double>(cover_.count()) / 3;
        EXPECT_LT(std::abs(cover_.mean()), 4 * std::sqrt(kStudentSquare / independent)) << name;
        EXPECT_GT(cover_.meanSquare(), kStudentSquare * (1 - coverSlack)) << name;
        EXPECT_LT(cover_.meanSquare(), kStudentSquare * (1 + coverSlack)) << name;
    }

  private:
    struct Column {
        int count = 0;
        glm::dvec3 error{0}, effect{0};
    };
    std::map<int, Column> columns_;
    ErrorCover cover_;
};

// Mean of f over a pixel's area by its values at n × n midpoints; pixel units.
glm::dvec3 meanOverPixel(int x, int y, int n, const std::function<glm::dvec3(double, double)>& f) {
    glm::dvec3 sum(0);
    for (int i = 0; i < n * n; ++i) sum += f(x + (i % n + 0.5) / n, y + (i / n + 0.5) / n);
    return sum / double(n * n);
}

TEST(ReferenceEdge, FollowsItsClosedForm) {
    SkinMaterial skin = SceneBuilder::plainSkin();
    skin.mix = 1;  // albedo, black on one side, acts on light going in alone
    SceneBuilder builder;
    builder.addObject("plate", makeHalvedPlate(0.2), builder.addSkin(skin));
    constexpr int kSize = 32;
    constexpr double kSpan = 16;  // mm across
    builder.setOrthographicCamera({0, 0, 1}, {0, 0, 0}, kSpan * kMm);
    const auto result = evaluate({.scene = builder.scene(),
                                  .lights = {directionalLight("key", {0, 0, -1}, kLux)},
                                  .width = kSize,
                                  .height = kSize,
                                  .passes = passesFor(16),
                                  .aovs = {"diffuse"}});
    Comparison comparison;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            // Midpoints are exact enough away from the step; the two pixels beside it hold σ = 0.08 mm, so 64
            // of them.
            const glm::dvec3 exact = meanOverPixel(x, 0, 64, [&](double px, double) {
                const double at = (px / kSize - 0.5) * kSpan;
                glm::dvec3 value;
                for (int c = 0; c < 3; ++c) value[c] = edgeResponse(skin.profile, c, at);
                return value;
            });
            comparison.add(result, x, y, exact, x < kSize / 2 ? 0 : 1);
        }
    }
    comparison.expect("half-plane", 0.015, 400, 0.4);
}

class ReferenceSlab : public ::testing::TestWithParam<double> {};

// Lit from behind: all the light there is has come through.
TEST_P(ReferenceSlab, FollowsItsClosedForm) {
    const double thickness = GetParam();
    const SkinMaterial skin = SceneBuilder::plainSkin();
    SceneBuilder builder;
    builder.addObject("slab", makeBox({-0.05, -0.05, -thickness * kMm}, {0.05, 0.05, 0}),
                      builder.addSkin(skin));
    constexpr int kSize = 16;
    builder.setOrthographicCamera({0, 0, 1}, {0, 0, 0}, 0.02);
    const auto result = evaluate({.scene = builder.scene(),
                                  .lights = {directionalLight("back", {0, 0, 1}, kLux)},
                                  .width = kSize,
                                  .height = kSize,
                                  .passes = passesFor(24),
                                  .aovs = {"diffuse"}});
    Comparison comparison;
    glm::dvec3 exact;
    for (int c = 0; c < 3; ++c) exact[c] = slabTransmission(skin.profile, c, thickness);
    for (int i = 0; i < kSize * kSize; ++i) comparison.add(result, i % kSize, i / kSize, exact, 0);
    comparison.expect("slab of " + std::to_string(thickness).substr(0, 3) + " mm", kAim, 100, 0.6);
}

INSTANTIATE_TEST_SUITE_P(Cases, ReferenceSlab, ::testing::Values(0.5, 1.0, 3.0));

struct SphereCase {
    double radius;  // mm
    double span;    // mm across the picture
    int segments;   // of the mesh
    double limit;   // of a short run
};

void PrintTo(const SphereCase& c, std::ostream* out) {
    *out << c.radius << " mm";
}

class ReferenceSphere : public ::testing::TestWithParam<SphereCase> {};

// One directional light, seen at right angles to it, so that the terminator is in the middle: all of a small
// sphere, of a large one as much as diffusion changes.
ReferenceJob sphereJob(const SphereCase& c, int size, int passes) {
    SceneBuilder builder;
    builder.addObject("ball", makeFineSphere(c.radius * kMm, c.segments),
                      builder.addSkin(SceneBuilder::plainSkin()));
    builder.setOrthographicCamera({0, 0, 10 * c.radius * kMm}, {0, 0, 0}, c.span * kMm);
    return {.scene = builder.scene(),
            .lights = {directionalLight("key", {-1, 0, 0}, kLux)},
            .width = size,
            .height = size,
            .passes = passes,
            .aovs = {"diffuse"}};
}

// Means over the pixels of each column of such a picture.
struct SphereColumn {
    glm::dvec3 exact;
    double undiffused = 0;
};

std::vector<SphereColumn> sphereColumns(const SphereCase& c, int size) {
    const SphereDiffusion exact(skin::threeLayerProfile(), c.radius);
    std::vector<SphereColumn> columns(size);
    for (int x = 0; x < size; ++x) {
        columns[x].exact = meanOverPixel(x, 0, 16, [&](double px, double) {
            const double cosine = (px / size - 0.5) * c.span / c.radius;  // to the light
            columns[x].undiffused += std::max(cosine, 0.0) / 256;
            return glm::dvec3(exact(cosine, 0), exact(cosine, 1), exact(cosine, 2));
        });
    }
    return columns;
}

TEST_P(ReferenceSphere, FollowsItsClosedForm) {
    const SphereCase& c = GetParam();
    constexpr int kSize = 12;
    ReferenceJob job = sphereJob(c, kSize, passesFor(128));
    // Random numbers go by seed and pixel: with one seed for all, the spheres would all show the same draw.
    job.seed = static_cast<std::uint32_t>(c.radius);
    const auto result = evaluate(job);
    const std::vector<SphereColumn> columns = sphereColumns(c, kSize);
    Comparison comparison;
    for (int x = 0; x < kSize; ++x)
        for (int y = 0; y < kSize; ++y)
            if (valueAt(result.picture, x, y, 3) == 1)
                comparison.add(result, x, y, columns[x].exact, columns[x].undiffused);
    comparison.expect("sphere of " + std::to_string(int(c.radius)) + " mm", c.limit, 60, 0.6);
}

// Over the 80 pixels of one picture the mean square of error over standard error is 1.4 ± 0.3 (Student's t with seven degrees
// of freedom: its square has the variance 7.84). Over these it tells a standard error that is 7 % too small or too large.
TEST(ReferenceStandardError, CoversTheErrorOfASphere) {
    constexpr int kSize = 24, kSeeds = 8;
    const SphereCase sphere{3, 5.7, 192, 0};
    const std::vector<SphereColumn> columns = sphereColumns(sphere, kSize);
    ReferenceJob job = sphereJob(sphere, kSize, 16);
    ErrorCover cover;
    for (int seed = 0; seed < kSeeds; ++seed) {
        job.seed = 100 + static_cast<std::uint32_t>(seed);
        const auto result = evaluate(job);
        for (int x = 0; x < kSize; ++x)
            for (int y = 0; y < kSize; ++y)
                if (valueAt(result.picture, x, y, 3) == 1 && columns[x].exact.r > 0.01)
                    cover.add(valueAt(result.aovs.at("diffuse"), x, y, 0) * kPi / kLux, columns[x].exact.r,
                              valueAt(result.diffuseStandardError, x, y, 0) * kPi / kLux);
    }
    const double count = static_cast<double>(cover.count()), squareVariance = 9.8 - kStudentSquare * kStudentSquare;
    ASSERT_GT(count, 2500);
    expectAtMost("reference standard error, |mean of error over it|", std::abs(cover.mean()),
                 4 * std::sqrt(kStudentSquare / count));
    expectAtMost("reference standard error, |mean square of error over it - 1.4|",
                 std::abs(cover.meanSquare() - kStudentSquare), 4 * std::sqrt(squareVariance / count));
}

INSTANTIATE_TEST_SUITE_P(Cases, ReferenceSphere,
                         ::testing::Values(SphereCase{3, 5.7, 192, 0.01}, SphereCase{5, 9.5, 192, 0.015},
                                           SphereCase{8, 15.2, 192, 0.03}, SphereCase{20, 16, 256, 0.05},
                                           SphereCase{100, 16, 256, 0.05}));

}  // namespace
}  // namespace cutis::test
