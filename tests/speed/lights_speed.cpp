#include <cmath>
#include <cstdio>
#include <numbers>

#include "renderer/gpu/device.h"
#include "renderer/scene/characters.h"
#include "tests/speed/speed.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::speed {
namespace {

constexpr int kLightMap = 1024;

// A head-sized body that shadows itself, and `count` lights all round it.
RenderStats renderHead(gpu::Device& device, int count, int repeats) {
    test::SceneBuilder builder;
    builder.addObject("head", test::makeNosedSphere(0.1), builder.addSkin(test::SceneBuilder::plainSkin()));
    builder.setOrthographicCamera({0, 0, 1}, {0, 0, 0}, 0.25);
    RenderInput input;
    Scene scene = builder.scene();
    findCharacters(scene);
    input.scene = &scene;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * (i + 0.5) / count;
        input.rig.lights.push_back(test::spotLight("light " + std::to_string(i),
                                                   {2 * std::sin(angle), 0.5, 2 * std::cos(angle)},
                                                   {-std::sin(angle), -0.25, -std::cos(angle)}, 1, 0.2, 0.3));
    }
    input.rig.environment.enabled = false;
    input.camera = scene.cameras.at(0);
    return renderPicture(device, input,
                         {.width = 512,
                          .height = 512,
                          .irradianceSize = 1024,
                          .lightMapSize = kLightMap,
                          .repeats = repeats,
                          .aovs = {}})
        .stats;
}

}  // namespace

void printLights(gpu::Device& device, int repeats) {
    constexpr const char* kPasses[] = {"light_maps", "thickness", "irradiance", "diffusion", "composite", ""};
    std::printf("| lights |");
    for (const char* pass : kPasses) std::printf(" %s |", *pass ? pass : "frame");
    std::printf("\n|---|---|---|---|---|---|---|\n");
    for (const int count : {1, 2, 4, 8, 16, 32, 64}) {
        const RenderStats stats = renderHead(device, count, repeats);
        std::printf("| %d |", count);
        for (const char* pass : kPasses) std::printf(" %.3f |", timeOf(stats, pass).median);
        std::printf("\n");
    }
}

}  // namespace cutis::speed
