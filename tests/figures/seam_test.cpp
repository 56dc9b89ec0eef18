// Light across the borders of UV islands: a plate cut into twenty charts, each turned and scaled as it likes,
// under the edge of a shadow that runs across the cuts, against Σ w ½(1 + erf(x/√2v)).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/closed_forms.h"
#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr int kColumns = 5, kRows = 4, kSize = 180;
constexpr double kChartMm = 12, kViewMm = 24;
constexpr double kTurn =
    20 * std::numbers::pi / 180;  // of the cuts against the shadow's edge, which lies in x = 0

glm::dmat2 turned(double angle) {
    return {{std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}};
}

// Charts differ in scale by up to a half, and in how finely they are meshed: most of their edges meet in
// T-junctions.
Primitive makeCutPlate() {
    ChartedMesh mesh(2 * kMm);
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const int number = row * kColumns + column;
            const glm::dmat2 uvFromChart = turned(2.4 * number) * (1 + 0.25 * (number % 3));
            const int segments = 6 + number % 4;
            mesh.addPatch(segments, segments, [&](double s, double t) {
                const glm::dvec2 cut(column + s - 0.5 * kColumns, row + t - 0.5 * kRows);
                const glm::dvec2 place = turned(kTurn) * cut * (kChartMm * kMm);
                return SurfacePoint{{place, 0}, {0, 0, 1}, uvFromChart * glm::dvec2(place.x, -place.y)};
            });
        }
    }
    return mesh.finish();
}

// Distance in mm from a place on the plate to the nearest cut.
double fromCut(const glm::dvec2& mm) {
    const glm::dvec2 cut = turned(-kTurn) * mm / kChartMm + glm::dvec2(0.5 * kColumns, 0.5 * kRows);
    const glm::dvec2 away = glm::abs(cut - glm::round(cut));
    return kChartMm * std::min(away.x, away.y);
}

struct Errors {
    double near = 0,
           elsewhere = 0;  // root mean squares within 3 mm of a cut and farther away, red, of the lit side
};

Errors errorsOf(Primitive plate) {
    SceneBuilder builder;
    builder.addObject("plate", std::move(plate), builder.addSkin(SceneBuilder::plainSkin()));
    builder.addObject("shade", makeBox(glm::dvec3(-40, -40, 20) * kMm, glm::dvec3(0, 40, 21) * kMm),
                      builder.addMatte());
    builder.setOrthographicCamera(glm::dvec3(0, 0, 10) * kMm, {0, 0, 0}, kViewMm * kMm);
    RenderJob job{.scene = builder.scene(),
                  .lights = {directionalLight("key", {0, 0, -1}, std::numbers::pi)}};
    job.width = job.height = kSize;
    job.aovs = {"diffuse", "position"};
    const Rendered result = render(job);
    const skin::Profile profile = skin::threeLayerProfile();
    double squares[2] = {};
    int counts[2] = {};
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const glm::dvec2 mm = glm::dvec2(rgbAt(result.aov("position"), x, y)) / kMm;
            // Where edges meet in T-junctions a sample may fall between their triangles and see nothing.
            const bool covered = valueAt(result.picture, x, y, 3) > 0.999;
            if (!covered || std::abs(mm.x) < 0.4 || std::abs(mm.x) > 6) continue;
            const double error = valueAt(result.aov("diffuse"), x, y) - edgeResponse(profile, 0, mm.x);
            const int cut = fromCut(mm) < 3 ? 0 : 1;
            squares[cut] += error * error, ++counts[cut];
        }
    }
    return {std::sqrt(squares[0] / counts[0]), std::sqrt(squares[1] / counts[1])};
}

TEST(Seams, LightCrossesThem) {
    const Errors cut = errorsOf(makeCutPlate());
    const Errors whole = errorsOf(makePlate(kRows * kChartMm * kMm));
    reportFigure("seams, whole plate where cuts would be", whole.near);
    reportFigure("seams, whole plate elsewhere", whole.elsewhere);
    reportFigure("seams, cut plate elsewhere", cut.elsewhere);
    expectAtMost("seams, cut plate near cuts", cut.near, 0.001);
    expectAtMost("seams, near cuts over elsewhere", cut.near / cut.elsewhere, 1.5);
}

// mm over a sphere from the nearest edge of the six faces that makeSphere(…, cube) projects on it.
double fromCubeEdge(const glm::dvec3& direction, double radiusMm) {
    std::array<double, 3> axes{std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)};
    std::sort(axes.begin(), axes.end());
    return radiusMm * std::asin((axes[2] - axes[1]) / std::numbers::sqrt2);
}

// Errors of red, green and blue on a ball of 30 mm, of light 1 at normal incidence: within two texels of an
// edge of the cube, and elsewhere.
struct BallErrors {
    std::vector<double> near, elsewhere;
};

BallErrors errorsOfBall(SphereMapping mapping) {
    constexpr double kRadiusMm = 30;
    const glm::dvec3 toLight = normalize(glm::dvec3(0.75, 0.55, 0.4));
    SceneBuilder builder;
    builder.addObject("ball", makeSphere(kRadiusMm * kMm, mapping),
                      builder.addSkin(SceneBuilder::plainSkin()));
    builder.setOrthographicCamera(glm::dvec3(0.1, 0.2, 1) * 0.3, {0, 0, 0}, 2.05 * kRadiusMm * kMm);
    RenderJob job{.scene = builder.scene(), .lights = {directionalLight("key", -toLight, std::numbers::pi)}};
    job.width = job.height = 240;
    job.aovs = {"diffuse", "position"};
    const Rendered result = render(job);
    const SphereDiffusion exact(skin::threeLayerProfile(), kRadiusMm);
    BallErrors errors;
    for (int y = 0; y < job.height; ++y) {
        for (int x = 0; x < job.width; ++x) {
            if (valueAt(result.picture, x, y, 3) < 0.999) continue;
            const glm::dvec3 direction = normalize(rgbAt(result.aov("position"), x, y));
            const bool near = fromCubeEdge(direction, kRadiusMm) < 2 * result.stats.mmPerTexel;
            for (int c = 0; c < 3; ++c) {
                const double error =
                    valueAt(result.aov("diffuse"), x, y, c) - exact(dot(direction, toLight), c);
                (near ? errors.near : errors.elsewhere).push_back(std::abs(error));
            }
        }
    }
    return errors;
}

double quantile(std::vector<double>& values, double share) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

// The histogram of errors near seams is that of the places elsewhere, and of the same places on a ball of one
// chart.
TEST(Seams, ErrorsNearThemAreThoseElsewhere) {
    BallErrors cut = errorsOfBall(SphereMapping::cube), whole = errorsOfBall(SphereMapping::latLong);
    ASSERT_GT(cut.near.size(), 3000u);
    for (const double share : {0.5, 0.9, 0.99}) {
        const std::string name =
            "error of a ball of six charts, quantile " + std::to_string(share).substr(0, 4);
        const double near = quantile(cut.near, share), elsewhere = quantile(cut.elsewhere, share);
        reportFigure(name + " elsewhere", elsewhere);
        reportFigure(name + ", one chart, where cuts would be", quantile(whole.near, share));
        expectAtMost(name + " near cuts", near, 1.5 * elsewhere);
    }
}

}  // namespace
}  // namespace cutis::test
