// Figure 2: a shadow edge on a plate, diffused, against Σ w ½(1 + erf(x/√2v)), whatever the texture
// coordinates do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/closed_forms.h"
#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr double kPlateMm = 40, kViewMm = 24, kPixelMm = 0.05;
constexpr int kWidth = 480, kHeight = 40;  // kViewMm × 2 mm
constexpr double kLux = 3;

struct Mapping {
    const char* name;
    glm::dmat2 uvFromPlate;  // columns: what a step along x and along y does to (u, v)
};

const Mapping kMappings[] = {
    {"straight", {{1, 0}, {0, 1}}},
    {"stretched along the edge", {{1, 0}, {0, 0.5}}},
    {"stretched across the edge", {{0.5, 0}, {0, 1}}},
    {"sheared by a half", {{1, 0}, {0.5, 1}}},
    {"sheared by one", {{1, 0}, {1, 1}}},
    {"rotated by 30 degrees",
     {{std::cos(std::numbers::pi / 6), std::sin(std::numbers::pi / 6)},
      {-std::sin(std::numbers::pi / 6), std::cos(std::numbers::pi / 6)}}},
};

// The plate in z = 0 under light along -Z; a shade 20 mm above it covers x < 0. The camera hangs between the
// two.
RenderJob edgeJob(const Mapping& mapping) {
    SceneBuilder builder;
    builder.addObject("plate", makePlate(kPlateMm * kMm, mapping.uvFromPlate),
                      builder.addSkin(SceneBuilder::plainSkin()));
    builder.addObject("shade", makeBox(glm::dvec3(-25, -25, 20) * kMm, glm::dvec3(0, 25, 21) * kMm),
                      builder.addMatte());
    builder.setOrthographicCamera(glm::dvec3(0, 0, 10) * kMm, {0, 0, 0}, kViewMm * kMm);
    RenderJob job{.scene = builder.scene(), .lights = {directionalLight("key", {0, 0, -1}, kLux)}};
    job.aovs = {"diffuse", "position"};
    return job;
}

double mmPerTexel(const Rendered& rendered) {
    return rendered.stats.mmPerTexel;
}

// The picture with an atlas of `target` mm a texel. The atlas holds the plate and a border, so that its size
// is close to inversely proportional to the figure that the program reports.
Rendered renderAt(RenderJob job, double target) {
    job.width = 48, job.height = 4, job.irradianceSize = 256;
    const std::vector<std::string> aovs = std::exchange(job.aovs, {});
    for (int attempt = 0; attempt < 3; ++attempt) {
        const double found = mmPerTexel(render(job));
        if (std::abs(found / target - 1) < 0.015) break;
        job.irradianceSize = static_cast<int>(std::lround(job.irradianceSize * found / target));
    }
    job.width = kWidth, job.height = kHeight, job.aovs = aovs;
    return render(job);
}

// A function of x, linear between rising samples.
struct Curve {
    std::vector<double> x, y;
    // Second moment of the derivative over |x| ≤ limit, by parts: ∫x² dy = limit²·(y(limit) - y(-limit)) -
    // 2∫x y dx.
    double derivativeSecondMoment(double limit) const {
        double integral = 0, low = 0, high = 0, lowest = 1e9, highest = -1e9;
        for (std::size_t i = 1; i < x.size(); ++i) {
            if (x[i - 1] < -limit || x[i] > limit) continue;
            integral += (x[i] - x[i - 1]) * (x[i] * y[i] + x[i - 1] * y[i - 1]) / 2;
            if (x[i - 1] < lowest) lowest = x[i - 1], low = y[i - 1];
            if (x[i] > highest) highest = x[i], high = y[i];
        }
        return highest * highest * high - lowest * lowest * low - 2 * integral;
    }
    double crossing(double level) const {
        for (std::size_t i = 1; i < x.size(); ++i)
            if (y[i - 1] < level && y[i] >= level)
                return x[i - 1] + (x[i] - x[i - 1]) * (level - y[i - 1]) / (y[i] - y[i - 1]);
        return std::numeric_limits<double>::quiet_NaN();
    }
};

class Edge : public ::testing::TestWithParam<std::tuple<int, double>> {};

TEST_P(Edge, FollowsTheErrorFunction) {
    const auto& [mappingIndex, target] = GetParam();
    const Mapping& mapping = kMappings[mappingIndex];
    const Rendered result = renderAt(edgeJob(mapping), target);
    ASSERT_NEAR(mmPerTexel(result) / target, 1, 0.03);
    const Picture &diffuse = result.aov("diffuse"), &position = result.aov("position");
    const skin::Profile profile = skin::threeLayerProfile();
    const bool coarse = target > 0.3;

    double plateau = 0;
    int plateauCount = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const double xMm = valueAt(position, x, y, 0) / kMm;
            ASSERT_NEAR(xMm, (x + 0.5) * kPixelMm - kViewMm / 2, 0.01) << "position AOV";
            if (xMm > 9) plateau += valueAt(diffuse, x, y), ++plateauCount;
        }
    plateau /= plateauCount;

    NormRatio perChannel[3];
    Curve measured, exact;
    for (int x = 0; x < kWidth; ++x) {
        double columnX = 0, columnL = 0;
        for (int y = 0; y < kHeight; ++y) {
            const double xMm = valueAt(position, x, y, 0) / kMm;
            const double step = xMm > 0 ? 1 : 0;
            if (std::abs(xMm) > 0.4 && std::abs(xMm) < 6)
                for (int c = 0; c < 3; ++c) {
                    const double edge = edgeResponse(profile, c, xMm);
                    perChannel[c].add(valueAt(diffuse, x, y, c) / plateau - edge, edge - step);
                }
            columnX += xMm / kHeight, columnL += valueAt(diffuse, x, y) / plateau / kHeight;
        }
        measured.x.push_back(columnX), measured.y.push_back(columnL);
        exact.x.push_back(columnX), exact.y.push_back(edgeResponse(profile, 0, columnX));
    }

    const std::string name =
        std::string("edge ") + mapping.name + " " + std::to_string(target).substr(0, 3) + " mm";
    expectAtMost(name + " red", perChannel[0].value(), coarse ? 0.08 : 0.05);
    reportFigure(name + " green", perChannel[1].value());
    expectAtMost(name + " place [mm]", std::abs(measured.crossing(0.5)), 0.06);
    const double moment = exact.derivativeSecondMoment(10);
    expectAtMost(name + " second moment", std::abs(measured.derivativeSecondMoment(10) / moment - 1),
                 coarse ? 0.04 : 0.02);
    expectAtMost(name + " plateau", std::abs(plateau * std::numbers::pi / kLux - 1), 0.01);
}

// The mean of a picture's columns over x in mm, over what the lit side far from the edge shows.
Curve columnMeans(const Rendered& result) {
    const Picture &diffuse = result.aov("diffuse"), &position = result.aov("position");
    Curve curve;
    double plateau = 0;
    int count = 0;
    for (int x = 0; x < kWidth; ++x) {
        double at = 0, light = 0;
        for (int y = 0; y < kHeight; ++y) {
            at += valueAt(position, x, y, 0) / kMm / kHeight;
            light += valueAt(diffuse, x, y) / kHeight;
        }
        if (at > 11) plateau += light, ++count;
        curve.x.push_back(at), curve.y.push_back(light);
    }
    for (double& y : curve.y) y /= plateau / count;
    return curve;
}

// The chain as printed widens every Gaussian: its seven weights have 1.079 times their variance, and lengths along u
// and v alone miss the shear. Of u = x + y, v = y they give x the variance 1 + 1/2.
TEST(PublishedChain, HasTheVarianceOfItsListing) {
    const double listed = 2 * (0.006 * 9 + 0.061 * 4 + 0.242) / 1.001;
    for (const auto& [mapping, widened] : {std::pair{0, listed}, std::pair{4, 1.5 * listed}}) {
        RenderJob job = edgeJob(kMappings[mapping]);
        job.chain = "published";
        const Curve measured = columnMeans(renderAt(job, 0.1));
        skin::Profile profile = skin::threeLayerProfile();
        for (skin::Gaussian& gaussian : profile.gaussians) gaussian.variance *= widened;
        Curve expected;
        NormRatio red;
        for (std::size_t i = 0; i < measured.x.size(); ++i) {
            expected.x.push_back(measured.x[i]);
            expected.y.push_back(edgeResponse(profile, 0, measured.x[i]));
            if (std::abs(measured.x[i]) > 0.4 && std::abs(measured.x[i]) < 6)
                red.add(measured.y[i] - expected.y[i], expected.y[i] - (measured.x[i] > 0 ? 1 : 0));
        }
        const std::string name = std::string("published chain, ") + kMappings[mapping].name;
        expectAtMost(name + ", red", red.value(), 0.05);
        expectAtMost(name + ", second moment",
                     std::abs(measured.derivativeSecondMoment(10) / expected.derivativeSecondMoment(10) - 1), 0.03);
    }
}

// Fewer taps lie farther apart and keep the variance: the shape alone becomes coarser.
TEST(Taps, KeepTheSecondMoment) {
    RenderJob job = edgeJob(kMappings[0]);
    const Curve all = columnMeans(renderAt(job, 0.1));
    job.taps = 2;
    const Curve few = columnMeans(renderAt(job, 0.1));
    NormRatio change;
    for (std::size_t i = 0; i < all.y.size(); ++i) change.add(few.y[i] - all.y[i], all.y[i]);
    EXPECT_GT(change.value(), 1e-4) << "the setting reaches the blurs";
    expectAtMost("2 taps: change of the edge", change.value(), 0.03);
    expectAtMost("2 taps: second moment",
                 std::abs(few.derivativeSecondMoment(10) / all.derivativeSecondMoment(10) - 1), 0.02);
}

std::string testName(const ::testing::TestParamInfo<std::tuple<int, double>>& instance) {
    const auto& [mapping, target] = instance.param;
    std::string name = kMappings[mapping].name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name + "_at_" + std::to_string(std::lround(target * 1000)) + "_micrometres";
}

INSTANTIATE_TEST_SUITE_P(Mappings, Edge,
                         ::testing::Combine(::testing::Range(0, 6), ::testing::Values(0.1, 0.2, 0.4)),
                         testName);

}  // namespace
}  // namespace cutis::test
