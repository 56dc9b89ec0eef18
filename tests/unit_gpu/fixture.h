// A device with validation and synchronization validation, one for all tests; after each test there must have
// been no message.
#pragma once

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "renderer/gpu/commands.h"

namespace cutis::gpu {

class GpuTest : public testing::Test {
  protected:
    static Device& device() {
        static Device shared({.select = "cpu", .validation = true});
        return shared;
    }

    static Image makeImage(const char* name, std::uint32_t width, std::uint32_t height,
                           std::uint32_t layers = 1, std::uint32_t mips = 1,
                           VkFormat format = VK_FORMAT_R32_SFLOAT) {
        return Image(device(), {.name = name,
                                .format = format,
                                .width = width,
                                .height = height,
                                .layers = layers,
                                .mips = mips});
    }

    void SetUp() override {
        device();
        messagesBefore_ = validationMessages();
    }
    void TearDown() override {
        EXPECT_EQ(validationMessages(), messagesBefore_) << "validation messages, see above";
    }

  private:
    std::uint64_t messagesBefore_ = 0;
};

// 0, 1, 2, ...
inline std::vector<float> ramp(std::size_t count) {
    std::vector<float> values(count);
    std::iota(values.begin(), values.end(), 0.0f);
    return values;
}

}  // namespace cutis::gpu
