// Validation messages are seen and counted: without this, the zero that other tests expect would mean
// nothing.
#include <gtest/gtest.h>

#include "renderer/gpu/commands.h"

namespace cutis::gpu {
namespace {

TEST(Validation, CountsAnInvalidCall) {
    const Device device({.select = "cpu", .validation = true});
    const std::uint64_t before = validationMessages();
    const VkBufferCreateInfo empty{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};  // no size, no usage
    VkBuffer buffer = VK_NULL_HANDLE;
    testing::internal::CaptureStderr();
    if (vkCreateBuffer(device.handle(), &empty, nullptr, &buffer) == VK_SUCCESS) {
        vkDestroyBuffer(device.handle(), buffer, nullptr);
    }
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_GT(validationMessages(), before);
    EXPECT_EQ(text.rfind("cutis: validation: ", 0), 0u) << text;
}

TEST(Validation, CountsAMissingBarrier) {
    Device device({.select = "cpu", .validation = true});
    const Buffer buffer(device, {.name = "raced", .bytes = 64});
    Commands commands = device.begin();
    commands.fill(buffer, 1);
    const std::uint64_t before = validationMessages();
    testing::internal::CaptureStderr();
    // Behind the layer's back: a second write with nothing between.
    vkCmdFillBuffer(commands.handle(), buffer.handle(), 0, VK_WHOLE_SIZE, 2);
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_GT(validationMessages(), before);
    EXPECT_NE(text.find("WRITE_AFTER_WRITE"), std::string::npos) << text;
}

TEST(Validation, IsOffUnlessAskedFor) {
    const std::uint64_t before = validationMessages();
    const Device device({.select = "cpu"});
    const VkBufferCreateInfo empty{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                   nullptr,
                                   0,
                                   64,
                                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                   VK_SHARING_MODE_EXCLUSIVE,
                                   3,
                                   nullptr};
    VkBuffer buffer = VK_NULL_HANDLE;
    ASSERT_EQ(vkCreateBuffer(device.handle(), &empty, nullptr, &buffer), VK_SUCCESS);
    vkDestroyBuffer(device.handle(), buffer, nullptr);
    EXPECT_EQ(validationMessages(), before);
}

TEST(Validation, EnvironmentVariableTurnsItOn) {
    setenv("CUTIS_VALIDATION", "1", 1);
    const Device device({.select = "cpu"});
    unsetenv("CUTIS_VALIDATION");
    const std::uint64_t before = validationMessages();
    const VkBufferCreateInfo empty{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    VkBuffer buffer = VK_NULL_HANDLE;
    testing::internal::CaptureStderr();
    if (vkCreateBuffer(device.handle(), &empty, nullptr, &buffer) == VK_SUCCESS) {
        vkDestroyBuffer(device.handle(), buffer, nullptr);
    }
    testing::internal::GetCapturedStderr();
    EXPECT_GT(validationMessages(), before);
}

}  // namespace
}  // namespace cutis::gpu
