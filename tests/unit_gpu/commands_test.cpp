// Dispatches, automatic barriers, copies, timings.
#include "renderer/gpu/commands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/unit_gpu/fixture.h"
#include "tests/unit_gpu/interop_sample.h"

namespace cutis::gpu {
namespace {

using CommandsTest = GpuTest;

TEST_F(CommandsTest, DispatchWritesPatternWithConstantsAndPush) {
    // Sizes that are no multiple of the group: the last groups reach over the edge.
    const Image image = makeImage("pattern", 37, 11);
    const Program& program = device().program("pattern.comp", {{0, 2.0f}, {1, 16u}});
    EXPECT_EQ(program.localSize(), (std::array<std::uint32_t, 3>{16, 4, 1}));
    const Groups groups = groupsFor(program, 37, 11);
    EXPECT_EQ(groups.x, 3u);
    EXPECT_EQ(groups.y, 3u);
    Commands commands = device().begin();
    commands.dispatch(program, {{"target", image}}, 0.5f, groups);
    const Readback result = commands.readback(image);
    EXPECT_THROW(result.bytes(), std::logic_error);
    commands.submitAndWait();
    const std::vector<float> values = result.as<float>();
    ASSERT_EQ(values.size(), 37u * 11u);
    for (int y = 0; y < 11; ++y) {
        for (int x = 0; x < 37; ++x) ASSERT_EQ(values[y * 37 + x], 2.0f * float(x + 256 * y) + 0.5f);
    }
}

TEST_F(CommandsTest, ChainOfDispatchesSeesEachOthersWrites) {
    constexpr std::uint32_t kSize = 64;
    constexpr int kSteps = 40;
    const Image images[2] = {makeImage("even", kSize, kSize), makeImage("odd", kSize, kSize)};
    const Program& shift = device().program("shift.comp");
    Commands commands = device().begin();
    commands.upload(images[0], ramp(kSize * kSize));
    for (int step = 0; step < kSteps; ++step) {
        commands.dispatch(shift, {{"source", images[step % 2]}, {"target", images[(step + 1) % 2]}}, {},
                          groupsFor(shift, kSize, kSize));
    }
    const Readback result = commands.readback(images[kSteps % 2]);
    commands.submitAndWait();
    const std::vector<float> values = result.as<float>();
    for (std::uint32_t y = 0; y < kSize; ++y) {
        for (std::uint32_t x = 0; x < kSize; ++x) {
            ASSERT_EQ(values[y * kSize + x], float(y * kSize + (x + kSteps) % kSize + kSteps))
                << x << "," << y;
        }
    }
}

TEST_F(CommandsTest, OverwritingWaitsForReadersInOtherStages) {
    using shared::Mixed;
    const Buffer source(device(), {.name = "source", .bytes = 2 * sizeof(Mixed)});
    const Program& program = device().program("interop.comp");
    std::vector<Buffer> targets;
    std::vector<Readback> results;
    Commands commands = device().begin();
    for (int round = 0; round < 4; ++round) {
        // Written by a copy, read in compute, written by the next copy: nothing but the read orders the two.
        const Mixed mixed{{0, 0, 0}, float(round), glm::mat3(0), {0, 0}, {0, 0, 0}};
        targets.emplace_back(device(), BufferDesc{.name = "target", .bytes = 40});
        commands.upload(source, std::vector{mixed, mixed});
        commands.dispatch(program, {{"Source", source}, {"Target", targets.back()}}, mixed, {});
    }
    for (const Buffer& target : targets) results.push_back(commands.readback(target));
    commands.submitAndWait();
    for (int round = 0; round < 4; ++round) EXPECT_EQ(results[round].as<float>()[6], float(round));
}

TEST_F(CommandsTest, LayersAndMipsAreIndependent) {
    // Layer to layer and mip to mip of one image: each part has its own layout and history.
    const Image image = makeImage("parts", 16, 16, 3, 2);
    const Program& pattern = device().program("pattern.comp", {{1, 4u}});
    const Program& shift = device().program("shift.comp");
    const Program& sum = device().program("sample_sum.comp");
    const Buffer sums(device(), {.name = "sums", .bytes = 12});
    Commands commands = device().begin();
    commands.fill(sums);
    commands.dispatch(pattern, {{"target", image.mip(0).layer(0)}}, 7.0f, groupsFor(pattern, 16, 16));
    commands.dispatch(shift, {{"source", image.mip(0).layer(0)}, {"target", image.mip(0).layer(1)}}, {},
                      groupsFor(shift, 16, 16));
    commands.dispatch(shift, {{"source", image.mip(0).layer(1)}, {"target", image.mip(0).layer(2)}}, {},
                      groupsFor(shift, 16, 16));
    commands.clear(image.mip(1), {3, 0, 0, 0});
    commands.clear(image.mip(1).layer(1), {4, 0, 0, 0});
    for (int twice = 0; twice < 2; ++twice) {
        commands.dispatch(sum, {{"layers", sampled(image.mip(1), device().sampler())}, {"Sums", sums}}, {},
                          {1});
    }
    const Readback whole = commands.readback(image.mip(0)), mip = commands.readback(image.mip(1)),
                   total = commands.readback(sums);
    commands.submitAndWait();
    const std::vector<float> values = whole.as<float>();
    ASSERT_EQ(values.size(), 3u * 256u);
    for (int layer = 0; layer < 3; ++layer) {
        EXPECT_EQ(values[layer * 256 + 5 * 16 + 2], float(2 + layer + 256 * 5) + 7 + float(layer));
    }
    EXPECT_EQ(mip.as<float>().size(), 3u * 64u);
    EXPECT_EQ(total.as<float>(), (std::vector<float>{6, 8, 6}));
}

TEST_F(CommandsTest, CubeFacesAreLayers) {
    const Image cube(
        device(),
        {.name = "cube", .format = VK_FORMAT_R32_SFLOAT, .width = 4, .height = 4, .layers = 6, .cube = true});
    const Buffer values(device(), {.name = "values", .bytes = 24});
    const Program& program = device().program("cube.comp");
    Commands commands = device().begin();
    for (std::uint32_t face = 0; face < 6; ++face)
        commands.clear(cube.layer(face), {float(face + 1), 0, 0, 0});
    commands.dispatch(program, {{"cube", sampled(cube, device().sampler())}, {"Values", values}}, {}, {});
    const Readback result = commands.readback(values);
    commands.submitAndWait();
    EXPECT_EQ(result.as<float>(), (std::vector<float>{1, 2, 3, 4, 5, 6}));
}

TEST_F(CommandsTest, StructsSharedWithShadersHaveTheSameLayout) {
    using shared::Mixed;
    Mixed push{{1, 2, 3}, 4, glm::mat3(0), {5, 6}, {7, 8, 9}};
    push.m[2][1] = 10;
    Mixed second{{11, 12, 13}, 14, glm::mat3(0), {15, 16}, {17, 18, 19}};
    second.m[2][1] = 20;
    const Buffer source(device(), {.name = "source", .bytes = 2 * sizeof(Mixed)}),
        target(device(), {.name = "target", .bytes = 40});
    Commands commands = device().begin();
    commands.upload(source, std::vector{push, second});
    commands.dispatch(device().program("interop.comp"), {{"Source", source}, {"Target", target}}, push, {});
    const Readback result = commands.readback(target);
    commands.submitAndWait();
    EXPECT_EQ(result.as<float>(), (std::vector<float>{3, 4, 10, 6, 9, 13, 14, 20, 16, 19}));
}

TEST_F(CommandsTest, IndirectDispatchReadsCountsWrittenBefore) {
    const Buffer groups(device(), {.name = "groups", .bytes = 12, .indirect = true}),
        counter(device(), {.name = "counter", .bytes = 4});
    Commands commands = device().begin();
    commands.fill(counter, 5);
    commands.dispatch(device().program("group_counts.comp"), {{"Groups", groups}}, 37u, {});
    commands.dispatchIndirect(device().program("count.comp"), {{"Counter", counter}}, {}, groups);
    const Readback result = commands.readback(counter);
    EXPECT_THROW(
        commands.dispatchIndirect(device().program("count.comp"), {{"Counter", counter}}, {}, groups, 4),
        std::logic_error);
    commands.submitAndWait();
    EXPECT_EQ(result.as<std::uint32_t>()[0], 42u);
}

TEST_F(CommandsTest, LargeUploadsAreChunked) {
    // 80 MB of buffer and 2 × 8 MB of image through 64 MB of staging memory, in one recording with a pass
    // open.
    std::vector<std::uint32_t> words(20 << 20);
    std::iota(words.begin(), words.end(), 0u);
    const Buffer buffer(device(), {.name = "large", .bytes = words.size() * 4});
    const Image image = makeImage("large", 1401, 1400, 2);
    const std::vector<float> texels = ramp(1401 * 1400 * 2);
    Commands commands = device().begin();
    commands.beginPass("upload");
    commands.upload(buffer, words);
    commands.upload(image, texels);
    commands.endPass();
    const Readback fromBuffer = commands.readback(buffer), fromImage = commands.readback(image);
    commands.submitAndWait();
    EXPECT_TRUE(std::ranges::equal(fromBuffer.bytes(), std::as_bytes(std::span(words))));
    EXPECT_TRUE(std::ranges::equal(fromImage.bytes(), std::as_bytes(std::span(texels))));
    EXPECT_EQ(commands.timings().size(), 1u);
}

TEST_F(CommandsTest, UploadsAndCopiesCheckTheirSizes) {
    const Buffer small(device(), {.name = "small", .bytes = 16});
    const Image image = makeImage("image", 4, 4), other = makeImage("other", 4, 5);
    Commands commands = device().begin();
    EXPECT_THROW(commands.upload(small, ramp(5)), std::logic_error);
    EXPECT_THROW(commands.upload(small, ramp(4), 4), std::logic_error);
    EXPECT_THROW(commands.upload(image, ramp(15)), std::logic_error);
    EXPECT_THROW(commands.copy(small, small, 20), std::logic_error);
    EXPECT_THROW(commands.copy(image, other), std::logic_error);
    EXPECT_THROW(commands.readback(image), std::logic_error);  // never written
    commands.upload(small, ramp(0));
    commands.upload(small, ramp(2), 8);
}

TEST_F(CommandsTest, MipsAreAverages) {
    const Image image = makeImage("mips", 4, 4, 2, 3);
    Commands commands = device().begin();
    commands.upload(image, ramp(32));
    commands.generateMips(image);
    const Readback half = commands.readback(image.mip(1)), one = commands.readback(image.mip(2));
    commands.submitAndWait();
    EXPECT_EQ(half.as<float>(), (std::vector<float>{2.5, 4.5, 10.5, 12.5, 18.5, 20.5, 26.5, 28.5}));
    EXPECT_EQ(one.as<float>(), (std::vector<float>{7.5, 23.5}));
}

TEST_F(CommandsTest, CopiesImages) {
    const Image from = makeImage("from", 8, 8, 2, 2), to = makeImage("to", 8, 8, 2, 2);
    Commands commands = device().begin();
    commands.upload(from, ramp(128));
    commands.generateMips(from);
    commands.copy(from, to);
    const Readback result = commands.readback(to), mip = commands.readback(to.mip(1).layer(1));
    commands.submitAndWait();
    EXPECT_EQ(result.as<float>(), ramp(128));
    EXPECT_EQ(mip.as<float>()[0], 64 + 4.5f);
}

TEST_F(CommandsTest, HalfFloatAndDepthImagesClearAndReadBack) {
    const Image depth = makeImage("depth", 3, 3, 1, 1, VK_FORMAT_D32_SFLOAT),
                ids = makeImage("ids", 3, 3, 1, 1, VK_FORMAT_R32_UINT);
    Commands commands = device().begin();
    commands.clear(depth, ClearValue::depth(0.25f));
    commands.clear(ids, ClearValue::integers(0xfffffffeu));
    const Readback d = commands.readback(depth), i = commands.readback(ids);
    commands.submitAndWait();
    EXPECT_EQ(d.as<float>(), std::vector<float>(9, 0.25f));
    EXPECT_EQ(i.as<std::uint32_t>(), std::vector<std::uint32_t>(9, 0xfffffffeu));
}

TEST_F(CommandsTest, PassesAreTimedAndAddUp) {
    const Image image = makeImage("timed", 128, 128);
    const Program& program = device().program("pattern.comp", {{1, 8u}});
    Commands commands = device().begin();
    for (int i = 0; i < 300; ++i) {  // more queries than one pool has
        commands.beginPass(i % 3 == 0 ? "often" : "oftener");
        commands.dispatch(program, {{"target", image}}, 0.0f, groupsFor(program, 128, 128));
        commands.endPass();
    }
    EXPECT_THROW(commands.timings(), std::logic_error);
    commands.submitAndWait();
    const std::vector<PassTiming>& timings = commands.timings();
    ASSERT_EQ(timings.size(), 2u);
    EXPECT_EQ(timings[0].name, "often");
    EXPECT_EQ(timings[0].runs, 100);
    EXPECT_EQ(timings[1].runs, 200);
    // 16,384 stores take a microsecond at least, and the whole test seconds at most.
    EXPECT_GT(timings[0].milliseconds, 100 * 1e-4);
    EXPECT_LT(timings[0].milliseconds, 60e3);
}

TEST_F(CommandsTest, ResourcesMayGoWhileCommandsHoldThem) {
    const std::uint64_t before = device().bytesAllocated();
    Buffer counter(device(), {.name = "counter", .bytes = 4});
    Commands commands = device().begin();
    {
        const Buffer groups(device(), {.name = "groups", .bytes = 12, .indirect = true});
        commands.fill(counter);
        commands.dispatch(device().program("group_counts.comp"), {{"Groups", groups}}, 3u, {});
        commands.dispatchIndirect(device().program("count.comp"), {{"Counter", counter}}, {}, groups);
    }
    Readback result = commands.readback(counter);
    commands.submitAndWait();
    EXPECT_EQ(result.as<std::uint32_t>()[0], 3u);
    result = {};
    counter = {};
    EXPECT_EQ(device().bytesAllocated(), before);
}

TEST_F(CommandsTest, AbandonedCommandsLeaveResourcesAsTheyWere) {
    const Image image = makeImage("kept", 4, 4);
    {
        Commands commands = device().begin();
        commands.clear(image, {1, 0, 0, 0});
        commands.submitAndWait();
    }
    {
        Commands commands = device().begin();
        commands.dispatch(device().program("pattern.comp"), {{"target", image}}, 9.0f, {1, 1, 1});
    }
    Commands commands = device().begin();
    const Readback result = commands.readback(image);
    commands.submitAndWait();
    EXPECT_EQ(result.as<float>(), std::vector<float>(16, 1.0f));
}

TEST_F(CommandsTest, MisuseOfTheSequenceThrows) {
    Commands commands = device().begin();
    EXPECT_THROW(device().begin(), std::logic_error);
    EXPECT_THROW(commands.endPass(), std::logic_error);
    EXPECT_THROW(commands.endRendering(), std::logic_error);
    commands.beginPass("a");
    EXPECT_THROW(commands.beginPass("b"), std::logic_error);
    EXPECT_THROW(commands.submitAndWait(), std::logic_error);
    commands.endPass();
    commands.submitAndWait();
    EXPECT_THROW(commands.beginPass("late"), std::logic_error);
}

}  // namespace
}  // namespace cutis::gpu
