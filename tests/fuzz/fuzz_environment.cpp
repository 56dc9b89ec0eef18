// Environments of any image format. One that loads has finite values that are not negative.
#include <cmath>
#include <cstdlib>

#include "fuzz.h"
#include "renderer/scene/environment.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cutis;
    fuzz::expectCleanly([&] {
        const Environment environment = loadEnvironment(fuzz::inputFile({data, size}, "input.exr"));
        for (const glm::vec3& texel : environment.radiance)
            for (int c = 0; c < 3; ++c)
                if (!std::isfinite(texel[c]) || texel[c] < 0) std::abort();
    });
    return 0;
}
