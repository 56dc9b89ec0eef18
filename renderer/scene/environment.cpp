#include "renderer/scene/environment.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/scene/image_io.h"
#include "renderer/scene/tonemap.h"

namespace cutis {
namespace {

// Negative values that carry less than this part of the light are left by the resampling that made the file,
// and mended without a word.
constexpr double kNegligible = 1e-4;

struct Findings {
    std::size_t nan = 0, negative = 0, infinite = 0;
    double light = 0, missing = 0;  // sums of the finite values above and below 0
    float largest = 0;              // finite
};

Findings examine(const std::vector<glm::vec3>& radiance) {
    Findings found;
    for (const glm::vec3& texel : radiance) {
        for (int c = 0; c < 3; ++c) {
            const float v = texel[c];
            if (std::isnan(v)) {
                ++found.nan;
            } else if (v < 0) {
                ++found.negative;
                found.missing -= v;
            } else if (std::isinf(v)) {
                ++found.infinite;
            } else {
                found.light += v;
                found.largest = std::max(found.largest, v);
            }
        }
    }
    return found;
}

}  // namespace

void sanitizeEnvironment(Environment& environment, bool warns) {
    const Findings found = examine(environment.radiance);
    if (found.nan + found.negative + found.infinite == 0) return;
    for (glm::vec3& texel : environment.radiance) {
        for (int c = 0; c < 3; ++c) {
            // Comparisons with NaN are false: it becomes 0 with the negative values.
            texel[c] = texel[c] > 0 ? std::min(texel[c], found.largest) : 0.f;
        }
    }
    std::string mended;
    const auto add = [&](std::size_t count, const char* what, const char* becomes) {
        if (count == 0) return;
        mended += (mended.empty() ? "" : ", ") + std::to_string(count) + " " + what +
                  (count == 1 ? " value becomes " : " values become ") + becomes;
    };
    add(found.nan, "NaN", "0");
    if (found.missing > kNegligible * found.light) add(found.negative, "negative", "0");
    add(found.infinite, "infinite", "the largest that is finite");
    if (warns && !mended.empty()) warn("environment " + environment.name + ": " + mended);
}

namespace {

// Light is taken from texel to texel as a point of its centre (samples, clusters), which is right only while
// texels are small: those of a coarser environment are each split into even parts.
void splitLargeTexels(Environment& environment) {
    constexpr int kWidth = 64, kHeight = 32;
    const int across = (kWidth + environment.width - 1) / environment.width;
    const int down = (kHeight + environment.height - 1) / environment.height;
    if (across == 1 && down == 1) return;
    const std::vector<glm::vec3> coarse = std::move(environment.radiance);
    const int coarseWidth = environment.width;
    environment.width *= across;
    environment.height *= down;
    environment.radiance.resize(std::size_t(environment.width) * environment.height);
    for (int y = 0; y < environment.height; ++y)
        for (int x = 0; x < environment.width; ++x)
            environment.radiance[std::size_t(y) * environment.width + x] =
                coarse[std::size_t(y / down) * coarseWidth + x / across];
}

}  // namespace

Environment loadEnvironment(const std::filesystem::path& path, bool warns) {
    bool integers = false;
    const Picture picture = readPixels(path, kMaxEnvironmentWidth, kMaxEnvironmentHeight, &integers);
    Environment environment;
    environment.name = path.filename().string();
    environment.width = picture.width;
    environment.height = picture.height;
    environment.radiance.resize(std::size_t(picture.width) * picture.height);
    const int n = picture.channels;
    parallelFor(std::size_t(picture.height), [&](std::size_t y) {
        for (std::size_t i = y * picture.width; i < (y + 1) * picture.width; ++i) {
            const float* in = picture.values.data() + i * n;
            glm::vec3 texel = n < 3 ? glm::vec3(in[0]) : glm::vec3(in[0], in[1], in[2]);
            for (int c = 0; c < 3 && integers; ++c) texel[c] = decodeSrgb(texel[c]);
            environment.radiance[i] = texel;
        }
    });
    sanitizeEnvironment(environment, warns);
    splitLargeTexels(environment);
    return environment;
}

}  // namespace cutis
