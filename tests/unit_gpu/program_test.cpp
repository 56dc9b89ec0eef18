// Reflection, and what is refused when bindings do not fit.
#include "renderer/gpu/program.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <stdexcept>

#include "renderer/gpu/reflection.h"
#include "renderer/gpu/shader_library.h"
#include "tests/unit_gpu/fixture.h"

namespace cutis::gpu {
namespace {

const BindingInfo& find(const ShaderReflection& reflection, const std::string& name) {
    for (const BindingInfo& info : reflection.bindings) {
        if (info.name == name) return info;
    }
    throw std::runtime_error("no binding " + name);
}

TEST(Reflection, StorageImagesAndConstants) {
    const ShaderReflection r = reflect(findShader("pattern.comp"), "pattern.comp");
    EXPECT_EQ(r.stage, VK_SHADER_STAGE_COMPUTE_BIT);
    EXPECT_EQ(r.pushBytes, 4u);
    EXPECT_EQ(r.localSize, (std::array<std::uint32_t, 3>{1, 4, 1}));
    EXPECT_EQ(r.localSizeIds[0], 1);
    EXPECT_EQ(r.localSizeIds[1], -1);
    ASSERT_EQ(r.bindings.size(), 1u);
    EXPECT_EQ(r.bindings[0].type, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    EXPECT_EQ(r.bindings[0].format, VK_FORMAT_R32_SFLOAT);
    EXPECT_EQ(r.bindings[0].viewType, VK_IMAGE_VIEW_TYPE_2D);
    EXPECT_TRUE(r.bindings[0].writes);
    EXPECT_FALSE(r.bindings[0].reads);
}

TEST(Reflection, BuffersSamplersAndArrays) {
    const ShaderReflection r = reflect(findShader("texture_array.comp"), "texture_array.comp");
    EXPECT_EQ(find(r, "textures").count, 16u);
    EXPECT_EQ(find(r, "textures").type, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    EXPECT_EQ(find(r, "textures").viewType, VK_IMAGE_VIEW_TYPE_2D_ARRAY);
    EXPECT_TRUE(find(r, "Choices").reads);
    EXPECT_FALSE(find(r, "Choices").writes);
    EXPECT_FALSE(find(r, "Values").reads);
    EXPECT_TRUE(find(r, "Values").writes);
    const ShaderReflection both = reflect(findShader("count.comp"), "count.comp");
    EXPECT_TRUE(find(both, "Counter").reads);
    EXPECT_TRUE(find(both, "Counter").writes);
    EXPECT_EQ(find(reflect(findShader("cube.comp"), "cube.comp"), "cube").viewType, VK_IMAGE_VIEW_TYPE_CUBE);
}

TEST(Reflection, PushConstantsHaveScalarSize) {
    // vec3, float, mat3, uvec2 and float[3]: 12 + 4 + 36 + 8 + 12 bytes.
    EXPECT_EQ(reflect(findShader("interop.comp"), "interop.comp").pushBytes, 72u);
    EXPECT_EQ(reflect(findShader("triangles.vert"), "triangles.vert").pushBytes, 16u);
    EXPECT_EQ(reflect(findShader("triangles.frag"), "triangles.frag").pushBytes, 0u);
}

TEST(Reflection, DamagedModulesAreRefused) {
    const std::span<const std::uint32_t> whole = findShader("interop.comp");
    EXPECT_THROW(reflect({}, "empty"), std::logic_error);
    EXPECT_THROW(reflect(whole.subspan(1), "shifted"), std::logic_error);
    EXPECT_THROW(reflect(whole.first(6), "cut"), std::logic_error);
    EXPECT_TRUE(findShader("no such shader").empty());
}

class ProgramTest : public GpuTest {
  protected:
    // The message of the logic_error that `body` throws.
    static std::string messageOf(const std::function<void()>& body) {
        try {
            body();
        } catch (const std::logic_error& error) {
            return error.what();
        }
        return "nothing thrown";
    }
    static bool contains(const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    }
};

TEST_F(ProgramTest, IsCompiledOnce) {
    EXPECT_EQ(&device().program("pattern.comp"), &device().program("pattern.comp"));
    EXPECT_NE(&device().program("pattern.comp"), &device().program("pattern.comp", {{0, 3.0f}}));
    EXPECT_EQ(&device().program("pattern.comp", {{0, 3.0f}}), &device().program("pattern.comp", {{0, 3.0f}}));
}

TEST_F(ProgramTest, UnknownShadersAndConstantsThrow) {
    EXPECT_TRUE(contains(messageOf([] { device().program("nothing.comp"); }), "nothing.comp"));
    EXPECT_TRUE(contains(messageOf([] { device().program("pattern.comp", {{7, 1u}}); }), "constant_id 7"));
    EXPECT_THROW(device().program("triangles.vert"), std::logic_error);
    EXPECT_THROW(device().program({"pattern.comp"}, RasterState{}), std::logic_error);
    EXPECT_THROW(device().program({"triangles.frag"}, RasterState{}), std::logic_error);
}

TEST_F(ProgramTest, BindingsMustFit) {
    const Program& shift = device().program("shift.comp");
    const Program& sum = device().program("sample_sum.comp");
    const Image image = makeImage("image", 4, 4), twin = makeImage("twin", 4, 4),
                layered = makeImage("layered", 4, 4, 2), mipped = makeImage("mipped", 4, 4, 1, 2),
                half = makeImage("half", 4, 4, 1, 1, VK_FORMAT_R16_SFLOAT),
                integer = makeImage("integer", 4, 4, 1, 1, VK_FORMAT_R32_UINT);
    const Buffer buffer(device(), {.name = "buffer", .bytes = 64});
    const VkSampler sampler = device().sampler();
    Commands commands = device().begin();
    for (const Image* written : {&image, &twin, &layered, &mipped, &half, &integer}) commands.clear(*written);
    const auto shiftWith = [&](const Bindings& bindings) {
        return messageOf([&] { commands.dispatch(shift, bindings, {}, {}); });
    };
    const auto sumWith = [&](const Bindings& bindings) {
        return messageOf([&] { commands.dispatch(sum, bindings, {}, {}); });
    };
    EXPECT_EQ(shiftWith({{"source", image}}), "program shift.comp: binding \"target\" is not given");
    EXPECT_EQ(shiftWith({{"source", image}, {"target", twin}, {"extra", image}}),
              "program shift.comp: binding \"extra\" does not exist");
    EXPECT_TRUE(contains(shiftWith({{"source", buffer}, {"target", twin}}), "\"source\" is an image"));
    EXPECT_TRUE(contains(shiftWith({{"source", Image()}, {"target", twin}}), "\"source\" is an image"));
    EXPECT_TRUE(contains(shiftWith({{"source", half}, {"target", twin}}), "r16f"));
    EXPECT_TRUE(contains(shiftWith({{"source", integer}, {"target", twin}}), "r32ui"));
    EXPECT_TRUE(contains(shiftWith({{"source", layered}, {"target", twin}}), "2 layers"));
    EXPECT_TRUE(contains(shiftWith({{"source", mipped}, {"target", twin}}), "one mip"));
    EXPECT_TRUE(
        contains(shiftWith({{"source", sampled(image, sampler)}, {"target", twin}}), "without a sampler"));
    EXPECT_TRUE(contains(sumWith({{"layers", image}, {"Sums", buffer}}), "with a sampler"));
    EXPECT_TRUE(contains(sumWith({{"layers", sampled(integer, sampler)}, {"Sums", buffer}}), "r32ui"));
    EXPECT_TRUE(
        contains(sumWith({{"layers", sampled(image, sampler)}, {"Sums", image}}), "\"Sums\" is a buffer"));
    EXPECT_TRUE(contains(messageOf([&] {
                             commands.dispatch(shift, {{"source", image}, {"target", twin}}, 1.0f, {});
                         }),
                         "0 bytes of push constants, 4 are given"));
    EXPECT_TRUE(contains(messageOf([&] {
                             commands.dispatch(shift, {}, {}, {0xffffffffu, 1, 1});
                         }),
                         "workgroups"));
    // After all that, the same commands still work.
    EXPECT_EQ(shiftWith({{"source", image}, {"target", twin}}), "nothing thrown");
    commands.submitAndWait();
}

TEST_F(ProgramTest, OneImageInTwoRolesOrUnwrittenIsRefused) {
    const Program& shift = device().program("shift.comp");
    const Program& sum = device().program("sample_sum.comp");
    const Image image = makeImage("image", 4, 4), unwritten = makeImage("unwritten", 4, 4);
    const Buffer buffer(device(), {.name = "buffer", .bytes = 64});
    Commands commands = device().begin();
    EXPECT_TRUE(contains(messageOf([&] {
                             commands.dispatch(shift, {{"source", unwritten}, {"target", image}}, {}, {});
                         }),
                         "\"unwritten\" is read before anything has written it"));
    EXPECT_THROW(commands.dispatch(
                     sum, {{"layers", sampled(unwritten, device().sampler())}, {"Sums", buffer}}, {}, {}),
                 std::logic_error);
    commands.clear(image);
    EXPECT_THROW(commands.copy(image, image), std::logic_error);
    commands.submitAndWait();
}

// lib/texture_array.glsl: an index that differs within each subgroup, over textures with mips (whose sampling
// by gradients aborts in the software device's compiler).
class TextureArray : public GpuTest {
  protected:
    struct Choice {
        std::uint32_t texture;
        float texels;
    };
};

TEST_F(TextureArray, EveryInvocationGetsItsOwnTextureAndMip) {
    constexpr std::uint32_t kTextures = 16, kCount = 1024, kMips = 7;
    std::vector<Choice> choice(kCount);
    for (std::uint32_t i = 0; i < kCount; ++i) {
        choice[i] = {(i * 7 + i / 16) % kTextures, std::exp2(float(i / 3 % kMips))};
    }
    const Buffer choices(device(), {.name = "choices", .bytes = kCount * sizeof(Choice)}),
        values(device(), {.name = "values", .bytes = kCount * sizeof(glm::vec4)});
    std::vector<Image> images;
    std::vector<SampledImage> array;
    Commands commands = device().begin();
    for (std::uint32_t i = 0; i < kTextures; ++i) {
        images.push_back(makeImage("texture", 64, 64, 2, kMips, VK_FORMAT_R32G32B32A32_SFLOAT));
        commands.clear(images[i].layer(0), {-1, -1, -1, -1});
        for (std::uint32_t mip = 0; mip < kMips; ++mip) {
            commands.clear(images[i].mip(mip).layer(1), {float(i), float(i * i), float(mip), 0.5f});
        }
        array.push_back(sampled(images[i], device().sampler()));
    }
    commands.upload(choices, choice);
    commands.dispatch(device().program("texture_array.comp"),
                      {{"textures", array}, {"Choices", choices}, {"Values", values}}, {}, {kCount / 64});
    const Readback result = commands.readback(values);
    commands.submitAndWait();
    const std::vector<glm::vec4> got = result.as<glm::vec4>();
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const float t = float(choice[i].texture);
        EXPECT_EQ(glm::vec2(got[i]), glm::vec2(t, t * t)) << i;
        // log2 and the fraction between mips are approximate.
        EXPECT_NEAR(got[i].z, std::max(std::log2(choice[i].texels) - 0.5f, 0.0f), 0.01f) << i;
        EXPECT_EQ(got[i].w, 0.5f) << i;
    }
}

TEST_F(TextureArray, SrgbTexturesWithMipsCompile) {
    // The format of colour textures, whose decoding takes a path of its own in the software device.
    std::vector<Image> images;
    std::vector<SampledImage> array;
    const Buffer choices(device(), {.name = "choices", .bytes = 64 * sizeof(Choice)}),
        values(device(), {.name = "values", .bytes = 64 * sizeof(glm::vec4)});
    Commands commands = device().begin();
    for (std::uint32_t i = 0; i < 3; ++i) {
        images.push_back(makeImage("colour", 64, 32, 2, 7, VK_FORMAT_R8G8B8A8_SRGB));
        commands.clear(images[i], {0.5f, 0.25f, float(i) / 2, 1});
        array.push_back(sampled(images[i], device().sampler({.u = VK_SAMPLER_ADDRESS_MODE_REPEAT})));
    }
    std::vector<Choice> choice(64);
    for (std::uint32_t i = 0; i < 64; ++i) choice[i] = {i % 3, float(i)};
    commands.upload(choices, choice);
    commands.dispatch(device().program("texture_array.comp"),
                      {{"textures", array}, {"Choices", choices}, {"Values", values}}, {}, {});
    const Readback result = commands.readback(values);
    commands.submitAndWait();
    const std::vector<glm::vec4> got = result.as<glm::vec4>();
    for (std::uint32_t i = 0; i < 64; ++i) {
        // A step of sRGB in 8 bits is at most 0.009 in linear light.
        EXPECT_NEAR(got[i].x, 0.5f, 0.009f) << i;
        EXPECT_NEAR(got[i].y, 0.25f, 0.009f) << i;
        EXPECT_NEAR(got[i].z, float(i % 3) / 2, 0.009f) << i;
    }
}

TEST_F(TextureArray, ShortArraysRepeatTheFirstTexture) {
    const Image image = makeImage("only", 1, 1, 2, 1, VK_FORMAT_R32G32B32A32_SFLOAT);
    const Buffer choices(device(), {.name = "choices", .bytes = 64 * sizeof(Choice)}),
        values(device(), {.name = "values", .bytes = 64 * sizeof(glm::vec4)});
    const std::vector<SampledImage> one{sampled(image, device().sampler())}, tooMany(17, one[0]);
    const Program& program = device().program("texture_array.comp");
    Commands commands = device().begin();
    commands.clear(image, {2, 3, 4, 5});
    commands.upload(choices, std::vector<Choice>(64, {9, 1}));
    const auto dispatch = [&](const std::vector<SampledImage>& array) {
        commands.dispatch(program, {{"textures", array}, {"Choices", choices}, {"Values", values}}, {}, {});
    };
    EXPECT_THROW(dispatch({}), std::logic_error);
    EXPECT_THROW(dispatch(tooMany), std::logic_error);
    dispatch(one);
    const Readback result = commands.readback(values);
    commands.submitAndWait();
    EXPECT_EQ(result.as<glm::vec4>(), std::vector<glm::vec4>(64, glm::vec4(2, 3, 4, 5)));
}

}  // namespace
}  // namespace cutis::gpu
