// Choosing a device, memory, images and samplers.
#include "renderer/gpu/device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "renderer/core/error.h"
#include "tests/unit_gpu/fixture.h"

namespace cutis::gpu {
namespace {

// Sets an environment variable for one scope.
class ScopedVariable {
  public:
    ScopedVariable(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
    ~ScopedVariable() { unsetenv(name_); }
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;

  private:
    const char* name_;
};

TEST(Devices, ListHasTheSoftwareDevice) {
    const std::vector<DeviceInfo> devices = listDevices();
    const auto cpu =
        std::find_if(devices.begin(), devices.end(), [](const auto& d) { return d.type == "cpu"; });
    ASSERT_NE(cpu, devices.end());
    EXPECT_EQ(cpu->unsuitable, "");
    EXPECT_NE(cpu->name.find("llvmpipe"), std::string::npos);
    EXPECT_FALSE(cpu->driver.empty());
    EXPECT_GT(cpu->memoryBytes, 0u);
}

TEST(Devices, SelectedByTypeIndexAndPartOfName) {
    for (const char* select : {"cpu", "CPU", "LLVMpipe", "pipe"}) {
        EXPECT_EQ(Device({.select = select}).info().type, "cpu") << select;
    }
    for (const DeviceInfo& info : listDevices()) {
        if (info.unsuitable.empty()) {
            EXPECT_EQ(Device({.select = std::to_string(info.index)}).info().name, info.name);
        }
    }
}

TEST(Devices, UnknownSelectionNamesWhatThereIs) {
    for (const char* select : {"99", "no such device", "0x"}) {
        try {
            const Device device({.select = select});
            FAIL() << select;
        } catch (const Error& error) {
            EXPECT_EQ(error.subject(), "device");
            EXPECT_NE(error.why().find(select), std::string::npos) << error.what();
            EXPECT_NE(error.why().find("llvmpipe"), std::string::npos) << error.what();
        }
    }
}

TEST(Devices, EnvironmentVariableIsTheDefault) {
    const ScopedVariable choice("CUTIS_DEVICE", "no such device");
    EXPECT_THROW(Device(), Error);
    EXPECT_NO_THROW(Device({.select = "cpu"}));  // an explicit choice wins
}

TEST(Devices, WithoutAnyDriverThereIsOneLine) {
    const ScopedVariable drivers("VK_DRIVER_FILES", "/nonexistent"),
        older("VK_ICD_FILENAMES", "/nonexistent");
    try {
        listDevices();
        FAIL() << "devices without drivers";
    } catch (const Error& error) {
        EXPECT_EQ(error.subject(), "device");
        EXPECT_NE(error.why().find("driver"), std::string::npos) << error.what();
    }
}

TEST(Devices, ValidationWithoutItsLayerIsAnError) {
    const ScopedVariable layers("VK_LAYER_PATH", "/nonexistent");
    EXPECT_NO_THROW(Device({.select = "cpu"}));
    try {
        const Device device({.select = "cpu", .validation = true});
        FAIL() << "validation without its layer";
    } catch (const Error& error) {
        EXPECT_NE(error.why().find("VK_LAYER_KHRONOS_validation"), std::string::npos) << error.what();
    }
}

using Memory = GpuTest;

TEST_F(Memory, IsCountedAndReused) {
    const std::uint64_t before = device().bytesAllocated();
    device().resetPeak();
    constexpr std::uint64_t kBytes = 1 << 20;
    {
        std::vector<Buffer> buffers;
        for (int i = 0; i < 100; ++i)
            buffers.emplace_back(device(), BufferDesc{.name = "piece", .bytes = kBytes});
        EXPECT_GE(device().bytesAllocated() - before, 100 * kBytes);
        EXPECT_LT(device().bytesAllocated() - before, 101 * kBytes);
        // Holes of mixed sizes are found again.
        for (int i = 0; i < 100; i += 2) buffers[i] = {};
        for (int i = 0; i < 100; i += 2)
            buffers[i] = Buffer(device(), {.name = "piece", .bytes = kBytes / 2});
        for (int i = 1; i < 100; i += 2) buffers[i] = {};
    }
    EXPECT_EQ(device().bytesAllocated(), before);
    EXPECT_GE(device().peakBytes() - before, 100 * kBytes);
    device().resetPeak();
    EXPECT_EQ(device().peakBytes(), before);
}

TEST_F(Memory, PiecesDoNotOverlap) {
    std::vector<Buffer> buffers;
    std::uint32_t seed = 1;
    const auto next = [&] { return seed = seed * 1664525u + 1013904223u; };
    for (int round = 0; round < 400; ++round) {
        if (buffers.size() > 20) buffers.erase(buffers.begin() + next() % buffers.size());
        Buffer buffer(device(), {.name = "piece", .bytes = 4 + next() % 100000, .memory = MemoryUse::upload});
        for (const Buffer& other : buffers) {
            const std::byte *a = buffer.mapped().data(), *b = other.mapped().data();
            ASSERT_TRUE(a + buffer.bytes() <= b || b + other.bytes() <= a);
        }
        buffers.push_back(std::move(buffer));
    }
}

TEST_F(Memory, TooMuchIsAnErrorThatNamesTheImage) {
    // 16000² texels of 16 bytes: more than the software device says it has.
    try {
        const Image image(
            device(),
            {.name = "enormous", .format = VK_FORMAT_R32G32B32A32_SFLOAT, .width = 16000, .height = 16000});
        FAIL() << "an image beyond the device's memory was created";
    } catch (const Error& error) {
        EXPECT_EQ(error.subject(), "device");
        EXPECT_NE(std::string(error.what()).find("enormous"), std::string::npos) << error.what();
        EXPECT_NE(error.why().find("4096.0 MB asked for"), std::string::npos) << error.what();
    }
}

TEST_F(Memory, ImagesBeyondTheLimitsAreRefused) {
    EXPECT_THROW(makeImage("wide", 1 << 20, 1), Error);
    EXPECT_THROW(makeImage("deep", 1, 1, 1 << 20), Error);
    EXPECT_THROW(makeImage("empty", 0, 4), std::logic_error);
    EXPECT_THROW(makeImage("mips", 4, 4, 1, 4), std::logic_error);
    EXPECT_THROW(makeImage("format", 4, 4, 1, 1, VK_FORMAT_R64_SFLOAT), std::logic_error);
}

TEST_F(Memory, MipCounts) {
    EXPECT_EQ(fullMipCount(1, 1), 1u);
    EXPECT_EQ(fullMipCount(4, 4), 3u);
    EXPECT_EQ(fullMipCount(5, 3), 3u);
    EXPECT_EQ(fullMipCount(1024, 1), 11u);
}

TEST_F(Memory, SamplersAreShared) {
    const SamplerDesc repeat{.u = VK_SAMPLER_ADDRESS_MODE_REPEAT};
    EXPECT_EQ(device().sampler(), device().sampler());
    EXPECT_EQ(device().sampler(repeat), device().sampler(repeat));
    EXPECT_NE(device().sampler(), device().sampler(repeat));
}

}  // namespace
}  // namespace cutis::gpu
