#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "renderer/gpu/shader_library.h"

namespace cutis::gpu {
std::span<const EmbeddedShader> environmentTestShaders();
}

int main(int argc, char** argv) {
    // Maps come from the device, not from an earlier run's cache.
    const auto cache =
        std::filesystem::temp_directory_path() / ("cutis-environment-tests-" + std::to_string(getpid()));
    setenv("CUTIS_CACHE_DIR", cache.c_str(), 1);
    cutis::gpu::addShaders(cutis::gpu::environmentTestShaders());
    testing::InitGoogleTest(&argc, argv);
    const int status = RUN_ALL_TESTS();
    std::error_code ignored;
    std::filesystem::remove_all(cache, ignored);
    return status;
}
