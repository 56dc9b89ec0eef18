// speed [--device NAME] [--scene FILE] [diffusion] [lights] [frames] [characters]: the tables of
// docs/speed.md.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <numeric>

#include "renderer/core/error.h"
#include "renderer/gpu/device.h"
#include "renderer/gpu/shader_library.h"
#include "tests/speed/speed.h"

namespace cutis::gpu {

std::span<const EmbeddedShader> speedShaders();

}  // namespace cutis::gpu

namespace cutis::speed {

Spread spreadOf(std::vector<double> values) {
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4));
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    return {values[values.size() / 2], values.front(), values.back()};
}

std::string toText(const Spread& spread) {
    char text[80];
    std::snprintf(text, sizeof text, "%.3f (%.3f to %.3f)", spread.median, spread.least, spread.most);
    return text;
}

Spread timeOf(const RenderStats& stats, const std::string& pass) {
    std::vector<double> sums;
    for (const PassStats& row : stats.passes) {
        if (!pass.empty() && row.name != pass) continue;
        sums.resize(std::max(sums.size(), row.repeatedMs.size()));
        for (std::size_t i = 0; i < row.repeatedMs.size(); ++i) sums[i] += row.repeatedMs[i];
    }
    return spreadOf(sums);
}

}  // namespace cutis::speed

int main(int argc, char** argv) {
    using namespace cutis;
    std::string device, scene = "data/default/default.gltf";
    std::vector<std::string> parts;
    for (int i = 1; i < argc; ++i) {
        if (!std::strcmp(argv[i], "--device") && i + 1 < argc)
            device = argv[++i];
        else if (!std::strcmp(argv[i], "--scene") && i + 1 < argc)
            scene = argv[++i];
        else
            parts.emplace_back(argv[i]);
    }
    const auto wanted = [&](const char* part) {
        return parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end();
    };
    try {
        gpu::addShaders(gpu::speedShaders());
        gpu::Device gpu({.select = device});
        const int repeats = gpu.info().type == "cpu" ? 4 : 40;
        std::printf("%s, %d repeats\n\n", gpu.info().name.c_str(), repeats);
        if (wanted("diffusion")) speed::printDiffusion(gpu, repeats);
        if (wanted("lights")) speed::printLights(gpu, repeats);
        if (wanted("frames")) speed::printFrames(gpu, scene, std::min(repeats, 20));
        if (wanted("characters")) speed::printCharacters(gpu, scene, std::min(repeats, 12));
    } catch (const Error& error) {
        std::fprintf(stderr, "speed: %s\n", error.what());
        return 1;
    }
    return 0;
}
