// Figure 11: environment irradiance where a body hides part of its own sky.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support/closed_forms.h"
#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec3 uniformSky(const glm::dvec3&) {
    return glm::dvec3(1);
}
// Bright towards +X and +Z; coloured, so that channels differ.
glm::dvec3 gradedSky(const glm::dvec3& w) {
    return {1 + 0.8 * w.x, 1 + 0.5 * w.z, 1 - 0.6 * w.y};
}

struct Sky {
    const char* name;
    glm::dvec3 (*radiance)(const glm::dvec3&);
};
const Sky kSkies[] = {{"uniform", uniformSky}, {"graded", gradedSky}};

RenderJob skyJob(const SceneBuilder& builder, const Sky& sky) {
    RenderJob job{.scene = builder.scene(), .width = 96, .height = 96};
    job.environment = makeEnvironment(64, 32, sky.radiance);
    job.aovs = {"irradiance", "position", "normal"};
    return job;
}

class OccludedSky : public ::testing::TestWithParam<int> {
  protected:
    const Sky& sky() const { return kSkies[GetParam()]; }

    // Relative L2 of the irradiance over the pixels that `holds` accepts, against quadrature with `visible`.
    void compare(
        const std::string& name, const Rendered& result,
        const std::function<bool(const glm::dvec3& position, const glm::dvec3& normal)>& holds,
        const std::function<bool(const glm::dvec3& position, const glm::dvec3& direction)>& visible) {
        NormRatio error, withoutVisibility;
        double worst = 0;
        for (int y = 0; y < result.picture.height; ++y)
            for (int x = 0; x < result.picture.width; ++x) {
                if (valueAt(result.picture, x, y, 3) < 0.999) continue;
                const glm::dvec3 position = rgbAt(result.aov("position"), x, y);
                const glm::dvec3 normal = normalize(rgbAt(result.aov("normal"), x, y));
                if (!holds(position, normal)) continue;
                const glm::dvec3 exact = integrateIrradiance(
                    normal,
                    [&](const glm::dvec3& w) {
                        return visible(position, w) ? sky().radiance(w) : glm::dvec3(0);
                    },
                    24);
                const glm::dvec3 open = integrateIrradiance(normal, sky().radiance, 8);
                const glm::dvec3 value = rgbAt(result.aov("irradiance"), x, y);
                for (int c = 0; c < 3; ++c) {
                    error.add(value[c] - exact[c], exact[c]);
                    withoutVisibility.add(open[c] - exact[c], exact[c]);
                    worst = std::max(worst, std::abs(value[c] / exact[c] - 1));
                }
            }
        ASSERT_GT(error.count(), 3000u);
        EXPECT_GT(withoutVisibility.value(), 0.1) << "nothing is hidden here: the test would say nothing";
        const std::string full = name + " under a " + sky().name + " sky";
        expectAtMost(full, error.value(), 0.05);
        reportFigure(full + " worst pixel", worst);
    }
};

// Inside a hemisphere a uniform sky of radiance 1 gives π/2 everywhere: the form factor from a sphere's inner
// wall to its missing cap is the cap's share of the sphere. Held 5° below the rim.
TEST_P(OccludedSky, InsideABowl) {
    const double radius = 100 * kMm;
    SceneBuilder builder;
    builder.addObject("bowl", makeBowl(radius, 10 * kMm), builder.addSkin(SceneBuilder::plainSkin()));
    builder.setOrthographicCamera({0, 0, 0.5}, {0, 0, 0}, 0.23);
    const Rendered result = render(skyJob(builder, sky()));
    compare(
        "bowl", result,
        [&](const glm::dvec3& p, const glm::dvec3&) {
            return length(p) < radius * 1.01 && p.z < -radius * std::sin(5 * kPi / 180);
        },
        [&](const glm::dvec3& p, const glm::dvec3& w) {
            if (w.z <= 0) return false;
            const glm::dvec3 leaves = p - w * (p.z / w.z);  // where it crosses the plane of the rim
            return leaves.x * leaves.x + leaves.y * leaves.y < radius * radius;
        });
    if (GetParam() == 0) {
        const Picture& irradiance = result.aov("irradiance");
        EXPECT_NEAR(valueAt(irradiance, 48, 48), kPi / 2, 0.05 * kPi / 2) << "the bottom of the bowl";
    }
}

// Does a ray meet a box? (Slab test.)
bool meetsBox(const glm::dvec3& from, const glm::dvec3& w, const glm::dvec3& min, const glm::dvec3& max) {
    double near = 0, far = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (min[axis] - from[axis]) / w[axis], b = (max[axis] - from[axis]) / w[axis];
        near = std::max(near, std::min(a, b)), far = std::min(far, std::max(a, b));
    }
    return near < far;
}

// A floor in z = 0 and a roof over its half x < 0, 25 mm above it: of the same character, as a brow is.
TEST_P(OccludedSky, UnderAnOverhang) {
    const glm::dvec3 roofMin = glm::dvec3(-60, -60, 25) * kMm, roofMax = glm::dvec3(0, 60, 30) * kMm;
    SceneBuilder builder;
    const int skin = builder.addSkin(SceneBuilder::plainSkin());
    // One mesh: the charts of floor and roof side by side in one atlas.
    ChartedMesh mesh(10 * kMm);
    mesh.addQuad(glm::dvec3(-60, -60, 0) * kMm, {0.12, 0, 0}, {0, 0.12, 0}, 24);
    const glm::dvec3 size = roofMax - roofMin, x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
    mesh.addQuad(roofMin + z, x, y);
    mesh.addQuad(roofMin + x, -x, y);
    mesh.addQuad(roofMin + x + z, -z, y);
    mesh.addQuad(roofMin, z, y);
    mesh.addQuad(roofMin + y + z, x, -z);
    mesh.addQuad(roofMin, x, z);
    builder.addObject("brow", mesh.finish(), skin);
    // From the open side, low enough to look under the roof.
    builder.setOrthographicCamera({0.3, 0, 0.2}, {0, 0, 0}, 0.1, {0, 0, 1});
    const Rendered result = render(skyJob(builder, sky()));
    compare(
        "overhang", result,
        [](const glm::dvec3& p, const glm::dvec3& n) {
            return std::abs(p.z) < 0.5 * kMm && n.z > 0.99 && std::abs(p.x) < 50 * kMm &&
                   std::abs(p.y) < 50 * kMm;
        },
        [&](const glm::dvec3& p, const glm::dvec3& w) { return !meetsBox(p, w, roofMin, roofMax); });
}

// The same roof as an object of its own that is not skin: a hat shades a head.
TEST_P(OccludedSky, UnderAHat) {
    const glm::dvec3 roofMin = glm::dvec3(-60, -60, 25) * kMm, roofMax = glm::dvec3(0, 60, 30) * kMm;
    SceneBuilder builder;
    builder.addObject("floor", makePlate(120 * kMm), builder.addSkin(SceneBuilder::plainSkin()));
    builder.addObject("hat", makeBox(roofMin, roofMax), builder.addMatte());
    builder.setOrthographicCamera({0.3, 0, 0.2}, {0, 0, 0}, 0.1, {0, 0, 1});
    const Rendered result = render(skyJob(builder, sky()));
    compare(
        "hat", result,
        [](const glm::dvec3& p, const glm::dvec3& n) {
            return std::abs(p.z) < 0.5 * kMm && n.z > 0.99 && std::abs(p.x) < 50 * kMm &&
                   std::abs(p.y) < 50 * kMm;
        },
        [&](const glm::dvec3& p, const glm::dvec3& w) { return !meetsBox(p, w, roofMin, roofMax); });
}

INSTANTIATE_TEST_SUITE_P(Skies, OccludedSky, ::testing::Range(0, 2),
                         [](const auto& instance) { return std::string(kSkies[instance.param].name); });

}  // namespace
}  // namespace cutis::test
