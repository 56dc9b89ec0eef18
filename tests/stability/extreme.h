// Stiff and extreme cases: small pictures that `cutis render` makes, and what must hold of each.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <ostream>
#include <string>

#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {

// Every value of the picture and of its AOVs must be finite and none below zero; besides, of the pixels that
// see the surface at N·V of leastCosine and more:
struct Bounds3 {
    glm::dvec3 least{0}, most{std::numeric_limits<double>::infinity()};  // radiance
    static Bounds3 near(double value, double tolerance) {
        return {glm::dvec3(value - tolerance), glm::dvec3(value + tolerance)};
    }
    static Bounds3 atMost(double value) { return {glm::dvec3(0), glm::dvec3(value)}; }
};

// A picture that several cases are compared with; it is made when the first one asks.
using Expected = std::function<const Picture&()>;
Expected rendered(std::function<RenderJob()> job);

struct Extreme {
    std::string name;  // letters, digits and underscores
    std::function<RenderJob()> job;
    Bounds3 bounds = {};
    // A picture that must equal `factor` times this one, within a relative L2 of `tolerance`.
    Expected other = {};
    double factor = 1, tolerance = 0;
    // What each pixel must show by the normal that it sees, within the same.
    std::function<glm::dvec3(const glm::dvec3& normal)> exact = {};
    // Pixels that see the surface at this N·V or more are held to the bounds.
    double leastCosine = 0.2;
    int leastPixels = 100;  // so many, or all
};

void PrintTo(const Extreme& extreme, std::ostream* out);

// Renders the case and checks all of it. Prints name, least and most radiance, error where something is
// known, and seconds. Where CUTIS_STABILITY_PICTURES names a folder, the picture is left there, to be looked
// at.
void check(const Extreme& extreme);

// A picture of 48 x 48 pixels, 0.21 m across, seen from +Z.
inline constexpr int kPixels = 48;
RenderJob pictureOf(SceneBuilder builder);
// A sphere round the origin, of triangles about as large as pixels.
Primitive sphere(double radius = 100 * kMm, SphereMapping mapping = SphereMapping::latLong);
// A sphere of radius 100 mm in the picture.
RenderJob sphereJob(const SkinMaterial& skin, const glm::dvec3& albedo = glm::dvec3(1));
RenderJob inUniformLight(RenderJob job);  // of radiance 1
RenderJob inLight(RenderJob job, std::vector<Light> lights);

}  // namespace cutis::test

#define CUTIS_EXTREME_CASES(group, cases)                                \
    class group : public testing::TestWithParam<Extreme> {};             \
    TEST_P(group, Holds) {                                               \
        check(GetParam());                                               \
    }                                                                    \
    INSTANTIATE_TEST_SUITE_P(Stability, group, testing::ValuesIn(cases), \
                             [](const auto& instance) { return instance.param.name; })
