// Layouts of skin that do not give every place its own: each texel of the atlas is owned once all the same,
// and packing takes seconds at the most.
#include "renderer/frame/atlas.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <vector>

#include "renderer/frame/spans.h"
#include "renderer/scene/characters.h"
#include "tests/support/awkward_layouts.h"
#include "tests/support/figure.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

struct Laid {
    Geometry geometry;
    SkinMesh mesh;
    Atlas atlas;
    double seconds = 0;
};

Laid layOut(const Primitive& skin, int size = 512) {
    SceneBuilder builder;
    builder.addObject("skin", skin, builder.addSkin(SceneBuilder::plainSkin()));
    Scene scene = builder.scene();
    prepareScene(scene);
    const auto start = std::chrono::steady_clock::now();
    Laid laid;
    laid.geometry = flattenScene(scene);
    laid.mesh = makeSkinMesh(laid.geometry);
    laid.atlas = layOutAtlas(scene, laid.mesh, laid.geometry, {.size = size, .reachMm = {8, 8}});
    laid.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return laid;
}

// Of the texels that hold skin, the share that two triangles claim.
double sharedTexels(const Laid& laid) {
    std::vector<int> claims(std::size_t(laid.atlas.size) * laid.atlas.size, 0);
    double texels = 0;
    for (std::uint32_t t = 0; t < laid.geometry.skinTriangleCount; ++t) {
        glm::dvec2 corner[3];
        for (int i = 0; i < 3; ++i) corner[i] = laid.atlas.vertices[laid.geometry.indices[t * 3 + i]].texel;
        texels += 0.5 * std::abs(cross2(corner[1] - corner[0], corner[2] - corner[0]));
        forEachCellWithin(corner[0], corner[1], corner[2], glm::ivec2(laid.atlas.size),
                          [&](int x, int y) { ++claims[std::size_t(y) * laid.atlas.size + x]; });
    }
    double held = 0, shared = 0;
    for (const int count : claims) held += count > 0, shared += count > 1;
    EXPECT_NEAR(held, texels, 0.1 * texels) << "triangles lie outside the atlas, or upon one another";
    EXPECT_GT(held, 0.15 * static_cast<double>(claims.size())) << "the atlas is hardly used";
    return shared / held;
}

Primitive latLongBall() {
    return makeSphere(0.05, SphereMapping::latLong);
}

Primitive box() {
    return makeBox(glm::dvec3(-0.05), glm::dvec3(0.05));
}

// The vertices at which a ball's texture coordinates end are those at which they begin: the last column of
// triangles leads back over all of the others.
Primitive closedBall() {
    ChartedMesh mesh(0);
    mesh.addPatch(48, 24, [](double s, double t) {
        const double polar = 3.1 * (t - 0.5), around = 6.283185307179586 * s;
        const glm::dvec3 n(std::cos(polar) * std::cos(around), std::sin(polar),
                           -std::cos(polar) * std::sin(around));
        return SurfacePoint{n * 0.05, n, {s, 1 - t}};
    });
    Primitive ball = mesh.finish();
    for (std::uint32_t& i : ball.indices) i = i % 49 == 48 ? i - 48 : i;
    return ball;
}

// A strip whose layout goes round twice, upon itself.
Primitive woundStrip() {
    ChartedMesh mesh(0);
    mesh.addPatch(96, 4, [](double s, double t) {
        const double angle = 12.566370614359172 * s, radius = 0.3 + 0.2 * t;
        return SurfacePoint{
            {0.2 * s, 0.02 * t, 0}, {0, 0, 1}, {radius * std::cos(angle), radius * std::sin(angle)}};
    });
    return mesh.finish();
}

// Its rectangle would be empty but for a thousandth.
Primitive sheared(Primitive body) {
    for (glm::vec2& uv : body.uv0) uv.x += 1000 * uv.y;
    return body;
}

void expectOwned(const char* name, const Primitive& skin) {
    const Laid laid = layOut(skin);
    expectAtMost(std::string("texels claimed twice, ") + name, sharedTexels(laid), 0.0005);
    reportFigure(std::string("islands, ") + name, static_cast<double>(laid.mesh.islands.size()));
}

TEST(AtlasLayout, OwnsEveryTexelOnce) {
    expectOwned("ball", latLongBall());
    expectOwned("mirrored ball", mirrored(latLongBall()));
    expectOwned("stacked faces", stacked(box()));
    expectOwned("tiled faces", tiled(box()));
    expectOwned("uneven ball", uneven(makeSphere(0.05, SphereMapping::cube)));
    expectOwned("closed ball", closedBall());
    expectOwned("wound strip", woundStrip());
    expectOwned("ball squeezed into a point", squeezed(latLongBall()));
    expectOwned("sheared ball", sheared(latLongBall()));
    expectOwned("ball without texture coordinates", bare(latLongBall()));
    expectOwned("shattered ball", shattered(latLongBall()));
}

TEST(AtlasLayout, KeepsWhatServes) {
    const Laid laid = layOut(latLongBall());
    EXPECT_EQ(laid.mesh.islands.size(), 1u);
    EXPECT_EQ(laid.geometry.skinVertexCount, latLongBall().positions.size());
    for (std::size_t v = 0; v < laid.geometry.skinVertexCount; ++v) {
        ASSERT_EQ(laid.geometry.layoutUv[v], laid.geometry.attributes[v].uv0);
    }
}

TEST(AtlasLayout, TexturesKeepTheirCoordinates) {
    const Laid laid = layOut(mirrored(latLongBall()));
    for (const glm::vec2& uv : laid.geometry.layoutUv) EXPECT_LE(uv.x, 0.5f);
    const Primitive ball = mirrored(latLongBall());
    ASSERT_GT(laid.geometry.draws[0].copies.size(), 0u);
    for (std::size_t k = 0; k < laid.geometry.draws[0].copies.size(); ++k) {
        const std::uint32_t original = laid.geometry.draws[0].copies[k];
        EXPECT_EQ(laid.geometry.attributes[ball.positions.size() + k].uv0, ball.uv0[original]);
        EXPECT_EQ(laid.geometry.positions[ball.positions.size() + k], laid.geometry.positions[original]);
    }
}

TEST(AtlasLayout, TheFoldIsASeam) {
    const Laid laid = layOut(mirrored(latLongBall()));
    EXPECT_EQ(laid.mesh.islands.size(), 2u);
    EXPECT_GT(laid.mesh.seams, 100u);
    for (const UvIsland& island : laid.mesh.islands) EXPECT_TRUE(island.continued && island.overlaps);
}

TEST(AtlasLayout, EvensOutDetail) {
    const Laid laid = layOut(uneven(makeSphere(0.05, SphereMapping::cube)));
    ASSERT_EQ(laid.mesh.islands.size(), 6u);
    double least = 1e300, most = 0;
    for (const UvIsland& island : laid.mesh.islands) {
        double texels = 0;
        for (const std::uint32_t t : island.triangles) {
            glm::dvec2 corner[3];
            for (int i = 0; i < 3; ++i)
                corner[i] = laid.atlas.vertices[laid.geometry.indices[t * 3 + i]].texel;
            texels += std::abs(cross2(corner[1] - corner[0], corner[2] - corner[0]));
        }
        least = std::min(least, texels), most = std::max(most, texels);
    }
    EXPECT_LT(most, 1.2 * least);
}

Primitive millionTriangles() {
    ChartedMesh mesh(0.01);
    mesh.addPatch(708, 708, [](double s, double t) {
        return SurfacePoint{{s, t, 0.02 * std::sin(9 * s)}, {0, 0, 1}, {s, 1 - t}};
    });
    return mesh.finish();
}

TEST(AtlasLayout, AMillionTrianglesTakeSeconds) {
    const Laid laid = layOut(millionTriangles(), 1024);
    EXPECT_EQ(laid.mesh.islands.size(), 1u);
    EXPECT_EQ(laid.mesh.seams, 0u);
    expectAtMost("layout of a million triangles [s]", laid.seconds, 20);
}

// Seconds for a million triangles that need work.
TEST(AtlasLayout, AMillionAwkwardTriangles) {
    const Laid unwrapped = layOut(bare(millionTriangles()), 2048),
               cut = layOut(mirrored(millionTriangles()), 2048);
    expectAtMost("texels claimed twice, a million triangles without texture coordinates",
                 sharedTexels(unwrapped), 0.0005);
    expectAtMost("layout of a million triangles without texture coordinates [s]", unwrapped.seconds, 20);
    expectAtMost("texels claimed twice, a million folded triangles", sharedTexels(cut), 0.0005);
    expectAtMost("layout of a million folded triangles [s]", cut.seconds, 20);
}

}  // namespace
}  // namespace cutis::test
