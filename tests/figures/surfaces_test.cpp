// The bodies that figures are measured on: are they what the closed forms assume?
#include "tests/support/surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cutis::test {
namespace {

constexpr double kPi = std::numbers::pi;

struct Measures {
    double area = 0, uvArea = 0;                  // m²; of the unit square
    double leastDensity = 1e30, mostDensity = 0;  // uv area per m², over triangles
    double worstFacing = 1;  // least cosine between a triangle's normal and its vertices'
    bool insideUnitSquare = true;
    bool mirrored = false, unmirrored = false;
};

Measures measure(const Primitive& mesh) {
    Measures m;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        const glm::dvec3 p(mesh.positions[a]), q(mesh.positions[b]), r(mesh.positions[c]);
        const glm::dvec3 normal = cross(q - p, r - p);
        const glm::dvec2 u = mesh.uv0[b] - mesh.uv0[a], v = mesh.uv0[c] - mesh.uv0[a];
        const double area = length(normal) / 2, uvArea = (u.x * v.y - u.y * v.x) / 2;
        m.area += area, m.uvArea += std::abs(uvArea);
        (uvArea > 0 ? m.mirrored : m.unmirrored) = true;  // rows grow downwards
        m.leastDensity = std::min(m.leastDensity, std::abs(uvArea) / area);
        m.mostDensity = std::max(m.mostDensity, std::abs(uvArea) / area);
        for (const std::uint32_t vertex : {a, b, c})
            m.worstFacing = std::min(m.worstFacing, dot(normalize(normal), glm::dvec3(mesh.normals[vertex])));
    }
    for (const glm::vec2& uv : mesh.uv0)
        m.insideUnitSquare = m.insideUnitSquare && uv.x >= 0 && uv.y >= 0 && uv.x <= 1 && uv.y <= 1;
    return m;
}

void expectSound(const Measures& m, double area, double tolerance) {
    EXPECT_NEAR(m.area / area, 1, tolerance);
    EXPECT_GT(m.worstFacing, 0.9);
    EXPECT_TRUE(m.insideUnitSquare);
    EXPECT_TRUE(m.unmirrored);
    EXPECT_FALSE(m.mirrored);
    EXPECT_LT(m.uvArea, 1);
}

TEST(Surfaces, SpheresHaveTheAreaOfASphere) {
    expectSound(measure(makeSphere(0.1, SphereMapping::latLong)), 4 * kPi * 0.01, 2e-3);
    const Measures cube = measure(makeSphere(0.1, SphereMapping::cube));
    expectSound(cube, 4 * kPi * 0.01, 2e-3);
    EXPECT_LT(cube.mostDensity / cube.leastDensity, 1.5) << "equiangular";
}

TEST(Surfaces, BoxIsMappedWithoutDistortion) {
    const Measures m = measure(makeBox({-0.06, -0.06, -0.002}, {0.06, 0.06, 0}));
    expectSound(m, 2 * 0.12 * 0.12 + 4 * 0.12 * 0.002, 1e-5);
    EXPECT_NEAR(m.mostDensity / m.leastDensity, 1, 1e-2);
}

TEST(Surfaces, BowlHasTwoWallsAndARim) {
    const Measures m = measure(makeBowl(0.1, 0.01));
    expectSound(m, 2 * kPi * (0.01 + 0.0121) + kPi * (0.0121 - 0.01), 2e-3);
}

TEST(Surfaces, NosedSphereIsClosedAndFacesOutwards) {
    const Measures m = measure(makeNosedSphere(0.1));
    EXPECT_GT(m.area, 4 * kPi * 0.01);
    EXPECT_GT(m.worstFacing, 0.9);
    EXPECT_TRUE(m.insideUnitSquare);
}

// A shear keeps areas and moves u with y; the plate stays where it is.
TEST(Surfaces, PlateTakesItsTextureCoordinatesThroughTheGivenMap) {
    const Measures m = measure(makePlate(0.04, {{1, 0}, {1, 1}}));
    expectSound(m, 0.04 * 0.04, 1e-5);
    EXPECT_NEAR(m.mostDensity / m.leastDensity, 1, 1e-3);
    const Primitive plate = makePlate(0.04, {{1, 0}, {1, 1}});
    const auto [left, right] = std::minmax_element(plate.uv0.begin(), plate.uv0.end(),
                                                   [](const auto& a, const auto& b) { return a.x < b.x; });
    const auto [top, bottom] = std::minmax_element(plate.uv0.begin(), plate.uv0.end(),
                                                   [](const auto& a, const auto& b) { return a.y < b.y; });
    EXPECT_NEAR((right->x - left->x) / (bottom->y - top->y), 2, 1e-4) << "twice as wide as it is high";
}

}  // namespace
}  // namespace cutis::test
