// Drawing into images.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/unit_gpu/fixture.h"
#include "tests/unit_gpu/interop_sample.h"

namespace cutis::gpu {
namespace {

using shared::Placing;
using shared::Vertex;

class Raster : public GpuTest {
  protected:
    static constexpr std::uint32_t kSize = 16;

    // A quad over the whole target at that depth: triangle 0 is its upper left half, triangle 1 its lower
    // right.
    static std::vector<Vertex> quad(float depth) {
        return {{{-1, -1, depth}}, {{1, -1, depth}}, {{-1, 1, depth}}, {{1, 1, depth}}};
    }
    static inline const std::vector<std::uint32_t> kQuadIndices{0, 1, 2, 2, 1, 3};

    RasterState state_{.colorFormats = {VK_FORMAT_R32_UINT}, .depthFormat = VK_FORMAT_D32_SFLOAT};
    Image color_ = makeImage("ids", kSize, kSize, 3, 1, VK_FORMAT_R32_UINT);
    Image depth_ = makeImage("depth", kSize, kSize, 1, 1, VK_FORMAT_D32_SFLOAT);
    Buffer vertices_{device(), {.name = "vertices", .bytes = 4 * sizeof(Vertex)}};
    Buffer indices_{device(), {.name = "indices", .bytes = 24, .index = true}};

    const Program& program() { return device().program({"triangles.vert", "triangles.frag"}, state_); }
    RenderTargets targets(std::uint32_t layer) {
        return {.colors = {{color_.layer(layer), ClearValue::integers(0)}},
                .depth = {{depth_, ClearValue::depth(1)}}};
    }
};

TEST_F(Raster, PrimitiveIdsOfAnIndexedQuad) {
    Commands commands = device().begin();
    commands.upload(vertices_, quad(0.5f));
    commands.upload(indices_, kQuadIndices);
    const DrawCall call{.count = 6};
    commands.draw(program(), targets(1), {{"Vertices", vertices_}}, Placing{{1, 1}, {0, 0}},
                  std::span(&call, 1), &indices_);
    const Readback ids = commands.readback(color_.layer(1)), depth = commands.readback(depth_);
    commands.submitAndWait();
    const std::vector<std::uint32_t> values = ids.as<std::uint32_t>();
    for (std::uint32_t y = 0; y < kSize; ++y) {
        for (std::uint32_t x = 0; x < kSize; ++x) {
            if (x + y == kSize - 1) continue;  // pixel centres on the diagonal
            ASSERT_EQ(values[y * kSize + x], x + y < kSize - 1 ? 1u : 2u) << x << "," << y;
        }
    }
    EXPECT_EQ(depth.as<float>(), std::vector<float>(kSize * kSize, 0.5f));
}

TEST_F(Raster, SeveralDrawsInOneScopeWithDepthTest) {
    Commands commands = device().begin();
    commands.upload(vertices_, quad(0.5f));
    commands.upload(indices_, kQuadIndices);
    const DrawCall first{.first = 0, .count = 3}, both{.count = 6};
    commands.beginRendering(targets(0));
    // The left half of the target, triangles 1 and 2; then all of it at the same depth, which fails where it
    // was drawn.
    commands.draw(program(), {{"Vertices", vertices_}}, Placing{{0.5f, 1}, {-0.5f, 0}}, std::span(&both, 1),
                  &indices_);
    commands.draw(program(), {{"Vertices", vertices_}}, Placing{{4, 4}, {1, 1}}, std::span(&first, 1),
                  &indices_);
    commands.endRendering();
    // Onto what is there.
    RenderTargets again = targets(0);
    again.colors[0].clear.reset();
    again.depth->clear.reset();
    commands.draw(program(), again, {{"Vertices", vertices_}}, Placing{{0.25f, 0.25f}, {0, 0}},
                  std::span(&both, 1), &indices_);
    const Readback ids = commands.readback(color_.layer(0));
    commands.submitAndWait();
    const std::vector<std::uint32_t> values = ids.as<std::uint32_t>();
    EXPECT_EQ(values[0], 1u);
    EXPECT_EQ(values[15 * kSize + 7], 2u);
    EXPECT_EQ(values[3 * kSize + 12], 1u);
    EXPECT_EQ(std::count(values.begin(), values.end(), 0u), 0);
}

TEST_F(Raster, DepthIsSampledAndStoredAfterwards) {
    // Attachment, then storage read in compute: other layouts and stages, no barrier written by hand.
    const Image picture = makeImage("picture", kSize, kSize), source = makeImage("source", kSize, kSize);
    state_.colorFormats = {VK_FORMAT_R32_UINT};
    const Program& sum = device().program("sample_sum.comp");
    const Program& shift = device().program("shift.comp");
    const Buffer sums(device(), {.name = "sums", .bytes = 4});
    const DrawCall call{.count = 6};
    Commands commands = device().begin();
    commands.upload(vertices_, quad(0.75f));
    commands.upload(indices_, kQuadIndices);
    commands.fill(sums);
    commands.clear(source);
    for (int twice = 0; twice < 2; ++twice) {
        commands.draw(program(), targets(2), {{"Vertices", vertices_}}, Placing{{1, 1}, {0, 0}},
                      std::span(&call, 1), &indices_);
        commands.dispatch(
            sum, {{"layers", sampled(depth_, device().sampler(SamplerDesc::nearest()))}, {"Sums", sums}}, {},
            {});
        commands.dispatch(shift, {{"source", source}, {"target", picture}}, {},
                          groupsFor(shift, kSize, kSize));
    }
    const Readback result = commands.readback(sums);
    commands.submitAndWait();
    EXPECT_EQ(result.as<float>()[0], 1.5f);
}

TEST_F(Raster, DepthAlone) {
    const Program& depthOnly = device().program(
        {"triangles.vert"}, {.depthFormat = VK_FORMAT_D32_SFLOAT, .cull = VK_CULL_MODE_BACK_BIT});
    Commands commands = device().begin();
    commands.upload(vertices_, quad(0.25f));
    const DrawCall calls[] = {{.count = 3}};  // without indices; the first triangle is clockwise on screen
    const RenderTargets target{.depth = {{depth_, ClearValue::depth(1)}}};
    commands.draw(depthOnly, target, {{"Vertices", vertices_}}, Placing{{1, 1}, {0, 0}}, calls);
    const Readback culled = commands.readback(depth_);
    commands.draw(depthOnly, target, {{"Vertices", vertices_}}, Placing{{-1, 1}, {0, 0}}, calls);
    const Readback drawn = commands.readback(depth_);
    commands.submitAndWait();
    EXPECT_EQ(culled.as<float>(), std::vector<float>(kSize * kSize, 1.0f));
    const std::vector<float> values = drawn.as<float>();
    EXPECT_NEAR(double(std::count(values.begin(), values.end(), 0.25f)), kSize * kSize / 2.0, kSize / 2.0);
}

TEST_F(Raster, FragmentsSampleATextureArrayEachByItsOwnIndex) {
    const Program& program = device().program({"triangles.vert", "texture_array.frag"},
                                              RasterState{.colorFormats = {VK_FORMAT_R32_SFLOAT}});
    const Image target = makeImage("target", kSize, kSize);
    std::vector<Image> images;
    std::vector<SampledImage> array;
    Commands commands = device().begin();
    for (std::uint32_t i = 0; i < 16; ++i) {
        images.push_back(makeImage("texture", 16, 16, 1, 5));
        commands.clear(images[i], {float(i + 1), 0, 0, 0});
        array.push_back(sampled(images[i], device().sampler()));
    }
    commands.upload(vertices_, quad(0.5f));
    commands.upload(indices_, kQuadIndices);
    const DrawCall call{.count = 6};
    commands.draw(program, {.colors = {{target, ClearValue()}}},
                  {{"Vertices", vertices_}, {"textures", array}}, Placing{{1, 1}, {0, 0}},
                  std::span(&call, 1), &indices_);
    const Readback result = commands.readback(target);
    commands.submitAndWait();
    const std::vector<float> values = result.as<float>();
    for (std::uint32_t i = 0; i < kSize * kSize; ++i) ASSERT_EQ(values[i], float(i % kSize + 1)) << i;
}

TEST_F(Raster, MisuseThrows) {
    const DrawCall call{.count = 3};
    Commands commands = device().begin();
    commands.upload(vertices_, quad(0.5f));
    const Bindings bindings{{"Vertices", vertices_}};
    const Placing push{{1, 1}, {0, 0}};
    EXPECT_THROW(commands.draw(program(), bindings, push, std::span(&call, 1)), std::logic_error);
    // Formats that the program was not made for.
    EXPECT_THROW(commands.draw(program(), {.colors = {{color_.layer(0), ClearValue()}}}, bindings, push,
                               std::span(&call, 1)),
                 std::logic_error);
    // Loading what nothing has written, all layers at once, a buffer that is not for indices.
    EXPECT_THROW(commands.draw(program(),
                               {.colors = {{color_.layer(0), {}}}, .depth = {{depth_, ClearValue::depth(1)}}},
                               bindings, push, std::span(&call, 1)),
                 std::logic_error);
    EXPECT_THROW(commands.beginRendering({.colors = {{color_, ClearValue()}}}), std::logic_error);
    EXPECT_THROW(commands.draw(program(), targets(0), bindings, push, std::span(&call, 1), &vertices_),
                 std::logic_error);
    EXPECT_THROW(commands.draw(program(), targets(0), bindings, {}, std::span(&call, 1)), std::logic_error);
    commands.beginRendering(targets(0));
    EXPECT_THROW(commands.clear(color_), std::logic_error);
    commands.endRendering();
    commands.submitAndWait();
}

}  // namespace
}  // namespace cutis::gpu
