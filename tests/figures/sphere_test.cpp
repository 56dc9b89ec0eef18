// Figure 8: small spheres under one directional light, terminator and translucency included.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <ostream>
#include <string>

#include "tests/support/awkward_layouts.h"
#include "tests/support/closed_forms.h"
#include "tests/support/figure.h"
#include "tests/support/pictures.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

constexpr double kLux = 2;
constexpr int kSize = 200;

enum class Layout { plain, mirrored, bare, uneven, stacked, shattered };  // see tests/support/awkward_layouts.h

struct Case {
    double radiusMm;
    double viewDegrees;  // between the direction to the light and the direction to the camera
    SphereMapping mapping;
    Layout layout = Layout::plain;
};

Primitive ballOf(const Case& c) {
    Primitive ball = makeSphere(c.radiusMm * kMm, c.mapping);
    switch (c.layout) {
        case Layout::mirrored: return mirrored(std::move(ball));
        case Layout::bare: return bare(std::move(ball));
        case Layout::uneven: return uneven(std::move(ball));
        case Layout::stacked: return stacked(std::move(ball));
        case Layout::shattered: return shattered(ball);
        case Layout::plain: break;
    }
    return ball;
}

std::string nameOf(const Case& c) {
    return std::to_string(c.radiusMm).substr(0, 1) + "_mm_seen_at_" + std::to_string(int(c.viewDegrees)) +
           "_degrees_" + (c.mapping == SphereMapping::latLong ? "lat_long" : "cube") +
           std::array{"", "_mirrored", "_bare", "_uneven", "_stacked", "_shattered"}[static_cast<std::size_t>(c.layout)];
}

void PrintTo(const Case& c, std::ostream* out) {
    *out << nameOf(c);
}

class Sphere : public ::testing::TestWithParam<Case> {};

// ‖L - exact‖ / ‖exact - max(cosθ, 0)‖ over the whole visible disc, so that a picture without diffusion
// scores 100 %. The poles of the lat-long map lie 50° from the light's axis; its seam is out of sight of the
// 90° camera.
TEST_P(Sphere, FollowsItsClosedForm) {
    const Case& c = GetParam();
    const double pi = std::numbers::pi, elevation = 40 * pi / 180, view = c.viewDegrees * pi / 180;
    const glm::dvec3 toLight(std::cos(elevation), std::sin(elevation), 0);
    const glm::dvec3 eye = toLight * std::cos(view) + glm::dvec3(0, 0, 1) * std::sin(view);
    SceneBuilder builder;
    builder.addObject("ball", ballOf(c),
                      builder.addSkin(SceneBuilder::plainSkin()));
    builder.setOrthographicCamera(eye * (10 * c.radiusMm * kMm), {0, 0, 0}, 2.1 * c.radiusMm * kMm);
    RenderJob job{.scene = builder.scene(), .lights = {directionalLight("key", -toLight, kLux)}};
    job.width = job.height = kSize;
    job.aovs = {"diffuse", "position"};
    const Rendered result = render(job);

    const SphereDiffusion exact(skin::threeLayerProfile(), c.radiusMm);
    NormRatio perChannel[3], dark;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            if (valueAt(result.picture, x, y, 3) < 0.999) continue;
            const double cosine = dot(normalize(rgbAt(result.aov("position"), x, y)), toLight);
            for (int channel = 0; channel < 3; ++channel) {
                const double value = valueAt(result.aov("diffuse"), x, y, channel) * pi / kLux;
                const double expected = exact(cosine, channel);
                perChannel[channel].add(value - expected, expected - std::max(cosine, 0.0));
                if (channel == 0 && cosine < 0) dark.add(value - expected, expected);
            }
        }
    ASSERT_GT(perChannel[0].count(), 25000u);
    // A cube sphere has six UV islands, whose borders light crosses.
    expectAtMost("sphere " + nameOf(c) + " red", perChannel[0].value(), 0.25);
    reportFigure("sphere " + nameOf(c) + " green", perChannel[1].value());
    reportFigure("sphere " + nameOf(c) + " blue", perChannel[2].value());
    reportFigure("sphere " + nameOf(c) + " red beyond the terminator, relative", dark.value());
}

INSTANTIATE_TEST_SUITE_P(
    Cases, Sphere,
    ::testing::Values(Case{3, 90, SphereMapping::latLong}, Case{5, 90, SphereMapping::latLong},
                      Case{8, 90, SphereMapping::latLong}, Case{3, 135, SphereMapping::latLong},
                      Case{8, 135, SphereMapping::latLong}, Case{5, 45, SphereMapping::latLong},
                      Case{3, 90, SphereMapping::cube}, Case{8, 90, SphereMapping::cube},
                      Case{8, 90, SphereMapping::latLong, Layout::mirrored},
                      Case{8, 90, SphereMapping::latLong, Layout::bare},
                      Case{8, 90, SphereMapping::cube, Layout::uneven},
                      Case{8, 90, SphereMapping::cube, Layout::stacked},
                      Case{8, 90, SphereMapping::cube, Layout::shattered}),
    [](const auto& instance) { return nameOf(instance.param); });

}  // namespace
}  // namespace cutis::test
