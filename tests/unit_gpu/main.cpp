#include <gtest/gtest.h>

#include <cstdlib>

#include "renderer/gpu/shader_library.h"

namespace cutis::gpu {
std::span<const EmbeddedShader> unitGpuShaders();
}

int main(int argc, char** argv) {
    // The tests choose device and validation themselves.
    unsetenv("CUTIS_DEVICE");
    unsetenv("CUTIS_VALIDATION");
    cutis::gpu::addShaders(cutis::gpu::unitGpuShaders());
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
