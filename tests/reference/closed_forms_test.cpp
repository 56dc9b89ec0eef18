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
        // In a long run what a mesh's facets change and sums of floats round is no longer below the noise.
        if (longRuns()) return;
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
TEST_P(ReferenceSphere, FollowsItsClosedForm) {
    const SphereCase& c = GetParam();
    SceneBuilder builder;
    builder.addObject("ball", makeFineSphere(c.radius * kMm, c.segments),
                      builder.addSkin(SceneBuilder::plainSkin()));
    constexpr int kSize = 12;
    builder.setOrthographicCamera({0, 0, 10 * c.radius * kMm}, {0, 0, 0}, c.span * kMm);
    const auto result = evaluate({.scene = builder.scene(),
                                  .lights = {directionalLight("key", {-1, 0, 0}, kLux)},
                                  .width = kSize,
                                  .height = kSize,
                                  .passes = passesFor(128),
                                  .aovs = {"diffuse"}});
    const SphereDiffusion exact(skin::threeLayerProfile(), c.radius);
    Comparison comparison;
    for (int x = 0; x < kSize; ++x) {
        // x over the radius is the cosine to the light.
        const auto cosine = [&](double px) { return (px / kSize - 0.5) * c.span / c.radius; };
        double undiffused = 0;
        const glm::dvec3 mean = meanOverPixel(x, 0, 16, [&](double px, double) {
            undiffused += std::max(cosine(px), 0.0) / 256;
            return glm::dvec3(exact(cosine(px), 0), exact(cosine(px), 1), exact(cosine(px), 2));
        });
        for (int y = 0; y < kSize; ++y)
            if (valueAt(result.picture, x, y, 3) == 1) comparison.add(result, x, y, mean, undiffused);
    }
    comparison.expect("sphere of " + std::to_string(int(c.radius)) + " mm", c.limit, 60, 0.6);
}

INSTANTIATE_TEST_SUITE_P(Cases, ReferenceSphere,
                         ::testing::Values(SphereCase{3, 5.7, 64, 0.01}, SphereCase{5, 9.5, 64, 0.015},
                                           SphereCase{8, 15.2, 96, 0.03}, SphereCase{20, 16, 128, 0.05},
                                           SphereCase{100, 16, 256, 0.05}));

}  // namespace
}  // namespace cutis::test
