#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "renderer/gpu/device.h"
#include "renderer/measure/variants.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/environment.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/pose.h"
#include "renderer/scene/rig.h"
#include "tests/speed/speed.h"

namespace cutis::speed {
namespace {

// Three people, eight lights (the rig's and copies turned round them) under an environment.
struct Stage {
    Scene scene;
    Environment environment;
    RenderInput input;
    RenderSettings settings;
};

void loadStage(Stage& stage, const std::filesystem::path& sceneFile, bool gpu) {
    stage.scene = loadGltf(sceneFile);
    std::filesystem::path rigFile = sceneFile;
    rigFile.replace_extension(".rig.json");
    stage.input.rig = loadRig(rigFile);
    stage.environment = loadEnvironment(sceneFile.parent_path() / stage.input.rig.environment.file);
    resolvePlacements(stage.input.rig, stage.scene);
    repeatLights(stage.input.rig, stage.scene, 8);
    stage.settings.width = gpu ? 1920 : 1280;
    stage.settings.height = gpu ? 1080 : 720;
    stage.input.scene = &stage.scene;
    stage.input.environment = &stage.environment;
    stage.input.camera =
        cameraFor(stage.scene, "group", double(stage.settings.width) / stage.settings.height);
}

struct FrameTimes {
    Spread device, wall;
    std::string ran;
};

// Frames that follow each other, `change(i)` before each; the first two are not counted.
FrameTimes timeFrames(Renderer& renderer, const Stage& stage, int repeats,
                      const std::function<void(int)>& change) {
    std::vector<double> device, wall;
    FrameTimes times;
    for (int i = -2; i < repeats; ++i) {
        change(i);
        const RenderStats stats = renderer.render(stage.input, stage.settings).stats;
        if (i < 0) continue;
        double sum = 0;
        times.ran.clear();
        for (const PassStats& pass : stats.passes) {
            if (pass.runs == 0) continue;
            sum += pass.gpuMs;
            char text[80];
            std::snprintf(text, sizeof text, "%s%s %.2f", times.ran.empty() ? "" : ", ", pass.name.c_str(),
                          pass.gpuMs);
            times.ran += text;
        }
        device.push_back(sum);
        wall.push_back(stats.loadMs + stats.frameMs);
    }
    times.device = spreadOf(device);
    times.wall = spreadOf(wall);
    return times;
}

void printRow(const char* name, const FrameTimes& times) {
    std::printf("| %s | %s | %.1f | %s |\n", name, toText(times.device).c_str(), times.wall.median,
                times.ran.c_str());
}

void turnCamera(Camera& camera, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    glm::dmat4 turn(1);
    turn[0] = {std::cos(angle), 0, -std::sin(angle), 0};
    turn[2] = {std::sin(angle), 0, std::cos(angle), 0};
    camera.world = turn * camera.world;
}

}  // namespace

void printFrames(gpu::Device& device, const std::filesystem::path& sceneFile, int repeats) {
    Stage stage;
    loadStage(stage, sceneFile, device.info().type != "cpu");
    Renderer renderer(device);
    std::printf("\n%zu characters, %zu lights, environment, %d x %d\n\n", stage.scene.characters.size(),
                stage.input.rig.lights.size(), stage.settings.width, stage.settings.height);
    const RenderStats stats = renderer.render(stage.input, stage.settings).stats;
    std::printf("Atlas of %d², %.2f mm a texel, %llu texels lit, %.0f MB\n\n", stats.atlasWidth,
                stats.atlasMmPerTexel, static_cast<unsigned long long>(stats.atlasTexelsLit),
                double(stats.bytesGpu) / 1e6);
    std::printf(
        "| what changed | device, ms: median (least to most) | wall, ms | passes that ran, ms "
        "|\n|---|---|---|---|\n");
    const auto print = [&](const char* name, const std::function<void(int)>& change) {
        printRow(name, timeFrames(renderer, stage, repeats, change));
    };
    print("everything", [&](int) { renderer.forget(); });
    print("a light's place", [&](int i) { stage.input.rig.lights[1].position.x += i % 2 ? 0.01 : -0.01; });
    print("a light's intensity",
          [&](int i) { stage.input.rig.lights[1].intensity *= i % 2 ? 1.1 : 1 / 1.1; });
    print("the environment's rotation", [&](int) { stage.input.rig.environment.rotation += 5; });
    print("the camera", [&](int i) { turnCamera(stage.input.camera, i % 2 ? 1 : -1); });
    {
        // One character goes up and down by a millimetre.
        Stage moving = stage;
        moving.input.scene = &moving.scene;
        moving.input.environment = &moving.environment;
        const int root = moving.scene.characters.at(0).root;
        moving.scene.nodes[root].rest = toTransform(moving.scene.nodes[root].local);
        const glm::vec3 at = moving.scene.nodes[root].rest->translation;
        moving.scene.animations.push_back({"up",
                                           {{Interpolation::linear, 3, {0, 1}, {at.x, at.y, at.z, at.x, at.y + 0.001f, at.z}}},
                                           {{0, root, AnimatedProperty::translation}},
                                           1});
        Renderer movingRenderer(device);
        printRow("a character's pose", timeFrames(movingRenderer, moving, repeats, [&](int i) {
                     poseScene(moving.scene, 0, i % 2 ? 0.75 : 0.25);
                     ++moving.input.poseRevision;
                 }));
    }
    const FrameTimes skin =
        timeFrames(renderer, stage, repeats, [&](int i) { turnCamera(stage.input.camera, i % 2 ? 1 : -1); });
    Stage bare = stage;
    bare.input.scene = &bare.scene;
    bare.input.environment = &bare.environment;
    selectSkin(bare.scene, "none");
    Renderer bareRenderer(device);
    const FrameTimes none = timeFrames(bareRenderer, bare, repeats,
                                       [&](int i) { turnCamera(bare.input.camera, i % 2 ? 1 : -1); });
    printRow("the camera, nothing is skin", none);
    std::printf("\nCamera-only frame over that without skin: %.2f\n",
                skin.device.median / none.device.median);
}

void printCharacters(gpu::Device& device, const std::filesystem::path& sceneFile, int repeats) {
    std::printf("\n| characters | texels lit | frame, ms | ns a lit texel | MB |\n|---|---|---|---|---|\n");
    for (const int count : {1, 2, 4, 8, 16}) {
        Stage stage;
        loadStage(stage, sceneFile, device.info().type != "cpu");
        repeatCharacters(stage.scene, count);
        stage.settings.repeats = repeats;
        const RenderStats stats = renderPicture(device, stage.input, stage.settings).stats;
        const double frame = timeOf(stats, "").median;
        std::printf("| %d | %llu | %.2f | %.1f | %.0f |\n", count,
                    static_cast<unsigned long long>(stats.atlasTexelsLit), frame,
                    frame * 1e6 / double(stats.atlasTexelsLit), double(stats.bytesGpu) / 1e6);
    }
}

}  // namespace cutis::speed
