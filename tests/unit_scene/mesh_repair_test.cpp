#include "renderer/scene/mesh_repair.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cutis {
namespace {

// A unit sphere of n x 2n quads with a seam of doubled vertices at u = 0 = 1. u grows eastwards, v from the
// north pole down.
Primitive makeSphere(int n) {
    Primitive p;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= 2 * n; ++i) {
            const double theta = M_PI * j / n, phi = M_PI * (i % (2 * n)) / n;
            const double radius = j % n == 0 ? 0 : std::sin(theta);  // sin π is not quite 0
            p.positions.push_back({radius * std::sin(phi), std::cos(theta), radius * std::cos(phi)});
            p.uv0.push_back({i / (2.f * n), float(j) / n});
        }
    }
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < 2 * n; ++i) {
            const std::uint32_t a = j * (2 * n + 1) + i, b = a + 1, c = a + 2 * n + 1, d = c + 1;
            p.indices.insert(p.indices.end(), {a, c, b, b, c, d});
        }
    }
    dropBadTriangles(p);
    dropUnusedVertices(p);
    return p;
}

// A square facing +Z whose texture coordinates show an image upright: u to the right, v down.
Primitive makeSquare() {
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    p.normals.assign(4, glm::vec3(0, 0, 1));
    p.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    p.indices = {0, 1, 2, 0, 2, 3};
    return p;
}

TEST(Normals, OfASphereAreRadialAlsoAtTheSeam) {
    Primitive p = makeSphere(32);
    completeNormals(p, true);
    for (std::size_t i = 0; i < p.positions.size(); ++i) {
        // Weighted by angle, a regular grid's error is of second order: (π/32)²/4 = 0.0024.
        EXPECT_LT(glm::distance(p.normals[i], p.positions[i]), 0.0025f) << i;
        EXPECT_NEAR(glm::length(p.normals[i]), 1, 1e-6);
    }
}

// A cube's corner cut into one, two and two triangles: weights by angle do not depend on the cut, weights by
// area or by number of triangles do.
TEST(Normals, DoNotDependOnTheTriangulation) {
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}};
    p.indices = {0, 2, 1, 2, 4, 1, /* z = 0 */ 0, 1, 5, 0, 5, 3, /* y = 0 */ 0, 3, 6, 0, 6, 2 /* x = 0 */};
    completeNormals(p, true);
    EXPECT_LT(glm::distance(p.normals[0], glm::normalize(glm::vec3(-1))), 1e-6f);
}

TEST(Normals, WithoutSharedVerticesAreFlat) {
    Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    p.indices = {0, 1, 2, 3, 4, 5};
    completeNormals(p, false);
    EXPECT_EQ(p.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(p.normals[3], glm::vec3(1, 0, 0));
}

TEST(Normals, OnlyUnusableOnesAreReplaced) {
    Primitive p = makeSquare();
    p.normals = {{0, 0, 0}, {0, 3, 4}, {std::nanf(""), 0, 0}, {0, 0, INFINITY}};
    completeNormals(p, true);
    EXPECT_EQ(p.normals[0], glm::vec3(0, 0, 1));
    EXPECT_LT(glm::distance(p.normals[1], glm::vec3(0, 0.6f, 0.8f)), 1e-6f);
    EXPECT_EQ(p.normals[2], glm::vec3(0, 0, 1));
    EXPECT_EQ(p.normals[3], glm::vec3(0, 0, 1));
}

// Green is up in a glTF normal map and up is where v falls.
TEST(Tangents, OfAnUprightSquareFollowTheImage) {
    Primitive p = makeSquare();
    computeTangents(p, {0, 0, glm::mat3(1)});
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec3 t(p.tangents[i]);
        EXPECT_LT(glm::distance(t, glm::vec3(1, 0, 0)), 1e-6f);
        EXPECT_LT(glm::distance(glm::cross(p.normals[i], t) * p.tangents[i].w, glm::vec3(0, 1, 0)), 1e-6f);
    }
}

TEST(Tangents, FollowTheSlotsTransformAndCoordinates) {
    Primitive p = makeSquare();
    p.uv1 = p.uv0;
    p.uv0.assign(4, glm::vec2(0));
    // u' = v, v' = -u: u' grows downwards, v' falls to the right.
    computeTangents(p, {0, 1, glm::mat3(0, -1, 0, 1, 0, 0, 0, 0, 1)});
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec3 t(p.tangents[i]);
        EXPECT_LT(glm::distance(t, glm::vec3(0, -1, 0)), 1e-6f);
        EXPECT_LT(glm::distance(glm::cross(p.normals[i], t) * p.tangents[i].w, glm::vec3(1, 0, 0)), 1e-6f);
    }
}

TEST(Tangents, OfASpherePointEast) {
    Primitive p = makeSphere(32);
    completeNormals(p, true);
    computeTangents(p, {0, 0, glm::mat3(1)});
    for (std::size_t i = 0; i < p.positions.size(); ++i) {
        const glm::vec3 n = p.normals[i], t(p.tangents[i]);
        EXPECT_NEAR(glm::length(t), 1, 1e-5);
        EXPECT_NEAR(glm::dot(n, t), 0, 1e-5);
        if (std::abs(n.y) > 0.99f) continue;  // east has no meaning at the poles
        const glm::vec3 east = glm::normalize(glm::vec3(n.z, 0, -n.x));
        EXPECT_GT(glm::dot(t, east), 0.99f) << i;
        EXPECT_GT((glm::cross(n, t) * p.tangents[i].w).y, 0) << i;
    }
}

// Two triangles that mirror each other's texture along their common edge: the two vertices there are split.
TEST(Tangents, MirroredHalvesDoNotShareVertices) {
    Primitive p;
    p.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}};
    p.normals.assign(4, glm::vec3(0, 0, 1));
    p.uv0 = {{0, 1}, {0, 0}, {1, 1}, {1, 1}};
    p.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}};
    p.indices = {0, 2, 1, 0, 1, 3};
    computeTangents(p, {0, 0, glm::mat3(1)});
    ASSERT_EQ(p.positions.size(), 6u);
    ASSERT_EQ(p.colors.size(), 6u);
    for (std::size_t k = 0; k < 6; ++k) {
        const std::uint32_t i = p.indices[k];
        const glm::vec3 expected(k < 3 ? 1 : -1, 0, 0);
        EXPECT_LT(glm::distance(glm::vec3(p.tangents[i]), expected), 1e-6f) << k;
        const glm::vec3 up = glm::cross(p.normals[i], glm::vec3(p.tangents[i])) * p.tangents[i].w;
        EXPECT_LT(glm::distance(up, glm::vec3(0, 1, 0)), 1e-6f) << k;
    }
    EXPECT_EQ(p.colors[p.indices[3]], glm::vec4(1, 0, 0, 1));
}

TEST(Tangents, WithoutCoordinatesAreStillFrames) {
    Primitive p = makeSquare();
    p.uv0.clear();
    computeTangents(p, {0, 0, glm::mat3(1)});
    for (const glm::vec4& t : p.tangents) {
        EXPECT_NEAR(glm::length(glm::vec3(t)), 1, 1e-6);
        EXPECT_NEAR(t.z, 0, 1e-6);
        EXPECT_EQ(std::abs(t.w), 1);
    }
}

}  // namespace
}  // namespace cutis
