#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "renderer/gpu/commands.h"
#include "renderer/gpu/device.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/characters.h"
#include "tests/speed/speed.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"

namespace cutis::speed {
namespace {

constexpr int kAtlas = 2048;
constexpr double kMmPerTexel = 0.15;

// Reading the irradiance texture and writing the result once: a copy between two images of its kind.
Spread copyTime(gpu::Device& device, int repeats) {
    const auto image = [&](const char* name) {
        return gpu::Image(
            device,
            {.name = name, .format = VK_FORMAT_R32G32B32A32_SFLOAT, .width = kAtlas, .height = kAtlas});
    };
    const gpu::Image from = image("copied"), to = image("copy");
    std::vector<double> times;
    for (int repeat = 0; repeat < repeats; ++repeat) {
        gpu::Commands commands = device.begin();
        commands.clear(from);
        const gpu::Program& copy = device.program("copy.comp");
        for (int i = 0; i < 10; ++i) {
            commands.beginPass("copy");
            commands.dispatch(copy, {{"source", from}, {"target", to}}, {},
                              gpu::groupsFor(copy, kAtlas, kAtlas));
            commands.endPass();
        }
        commands.submitAndWait();
        for (const gpu::PassTiming& timing : commands.timings())
            times.push_back(timing.milliseconds / timing.runs);
    }
    return spreadOf(times);
}

// Times of rows of the pass table when nothing but a light's colour changes from frame to frame.
std::map<std::string, Spread> timePlate(gpu::Device& device, bool translucency, int repeats) {
    test::SceneBuilder builder;
    SkinMaterial skin = test::SceneBuilder::plainSkin();
    skin.translucency = translucency;
    const double side = kAtlas * kMmPerTexel * test::kMm;
    builder.addObject("plate", test::makePlate(side), builder.addSkin(skin));
    builder.setOrthographicCamera({0, 0, 1}, {0, 0, 0}, side);
    RenderInput input;
    Scene scene = builder.scene();
    findCharacters(scene);
    input.scene = &scene;
    input.rig.lights = {test::directionalLight("light", {0.3, 0, -1}, 1)};
    input.rig.environment.enabled = false;
    input.camera = scene.cameras.at(0);
    const RenderSettings settings{
        .width = 512, .height = 512, .irradianceSize = kAtlas, .repeats = 1, .aovs = {}};
    Renderer renderer(device);
    std::map<std::string, std::vector<double>> times;
    RenderStats stats;
    for (int i = 0; i < repeats; ++i) {
        input.rig.lights[0].color.g = i % 2 ? 0.5 : 1;
        stats = renderer.render(input, settings).stats;
        for (const PassStats& row : stats.passes) {
            if (row.runs > 0) times[row.name].push_back(row.gpuMs);
        }
    }
    std::printf("<!-- %.3f mm a texel, %llu texels covered -->\n", stats.atlasMmPerTexel,
                static_cast<unsigned long long>(stats.atlasTexelsCovered));
    std::map<std::string, Spread> spreads;
    for (const auto& [name, values] : times) spreads[name] = spreadOf(values);
    return spreads;
}

}  // namespace

void printDiffusion(gpu::Device& device, int repeats) {
    const Spread floor = copyTime(device, repeats);
    std::printf(
        "| fully covered atlas of %d², six Gaussians | ms: median (least to most) | over the copy "
        "|\n|---|---|---|\n",
        kAtlas);
    std::printf("| copy of the irradiance texture, the floor | %s | 1 |\n", toText(floor).c_str());
    for (const bool translucency : {true, false}) {
        std::map<std::string, Spread> times = timePlate(device, translucency, repeats);
        const char* name = translucency ? "levels kept for translucency" : "no translucency";
        for (const char* pass : {"diffusion", "exitance"}) {
            const Spread time = times[pass];
            std::printf("| %s, %s | %s | %.1f |\n", pass, name, toText(time).c_str(),
                        time.median / floor.median);
        }
    }
}

}  // namespace cutis::speed
