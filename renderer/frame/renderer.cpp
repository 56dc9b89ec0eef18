#include "renderer/frame/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>

#include "renderer/core/error.h"
#include "renderer/frame/camera.h"
#include "renderer/frame/frame.h"
#include "renderer/gpu/device.h"
#include "renderer/passes/light_views.h"
#include "renderer/scene/environment_samples.h"
#include "renderer/scene/light_samples.h"

namespace cutis {

void uploadFrameLights(FrameContext& frame);

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Texels a little finer than the pixels where the character stands; never finer than the narrowest blur of skin.
// A character that the picture does not show needs hardly any.
double wantedMmPerTexel(const Character& character, const ViewCameraMetrics& metrics, bool inView) {
    constexpr double kFinest = 0.08, kOutOfView = 10;
    if (!inView) return kOutOfView;
    return std::max(kFinest, 0.9 * metrics.metresPerPixel(character.bounds.centre()) * 1000);
}

void prepareTarget(FrameContext& frame) {
    const auto width = static_cast<std::uint32_t>(frame.settings->width);
    const auto height = static_cast<std::uint32_t>(frame.settings->height);
    const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    frame.target.picture =
        gpu::Image(*frame.device, {.name = "picture", .format = format, .width = width, .height = height});
    frame.target.aovLayer.fill(-1);
    int layers = 0;
    for (int i = 0; i < kAovCount; ++i) {
        const auto& wanted = frame.settings->aovs;
        if (std::find(wanted.begin(), wanted.end(), kAovNames[i]) != wanted.end()) frame.target.aovLayer[i] = layers++;
    }
    if (layers > 0) {
        frame.target.aovs = gpu::Image(*frame.device, {.name = "aovs", .format = format, .width = width,
                                                       .height = height, .layers = static_cast<std::uint32_t>(layers)});
    }
}

// Channels that an AOV has of the four that the shader writes.
int aovChannels(int aov) {
    constexpr int kChannels[kAovCount] = {3, 3, 3, 1, 3, 3, 3, 1, 1};
    return kChannels[aov];
}

Picture toPicture(std::span<const float> rgba, int width, int height, int channels) {
    Picture picture{width, height, channels, {}};
    picture.values.resize(std::size_t(width) * height * channels);
    for (std::size_t i = 0; i < std::size_t(width) * height; ++i) {
        std::copy_n(&rgba[i * 4], channels, &picture.values[i * channels]);
    }
    return picture;
}

std::uint64_t countNonfinite(std::span<const float> values) {
    return static_cast<std::uint64_t>(
        std::count_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); }));
}

struct FrameReadbacks {
    gpu::Readback picture, aovs, exitance, tileCounts;
};

// `timings`: of each time that the frame was drawn.
void fillStats(const FrameContext& frame, const Plan& plan, const std::vector<std::vector<gpu::PassTiming>>& timings,
               RenderStats& stats) {
    stats.device = frame.device->info().name;
    for (std::size_t i = 0; i < plan.rows.size(); ++i) {
        PassStats pass{plan.rows[i]->name, 0, 0, plan.reasons[i]};
        for (const std::vector<gpu::PassTiming>& repeat : timings) {
            for (const gpu::PassTiming& timing : repeat) {
                if (timing.name != pass.name) continue;
                pass.runs = timing.runs;
                pass.gpuMs = timing.milliseconds;
                pass.repeatedMs.push_back(timing.milliseconds);
            }
        }
        stats.passes.push_back(pass);
    }
    stats.leftOut = plan.leftOut;
    if (!frame.needs[Need::translucency]) {
        stats.leftOut.push_back({"translucency", frame.needs.why(Need::translucency)});
    }
    stats.atlasWidth = stats.atlasHeight = frame.atlas.size;
    stats.atlasMmPerTexel = frame.atlas.mmPerTexel;
    for (const Light& light : frame.input->rig.lights) stats.lights += light.enabled;
    stats.lightSamples = static_cast<int>(frame.lightSamples.size());
    stats.characters = static_cast<int>(frame.input->scene->characters.size());
    stats.gaussians = frame.scene.gaussians;
    stats.bytesGpu = frame.device->peakBytes();
}

void takePictures(const FrameContext& frame, const FrameReadbacks& readbacks, RenderResult& result) {
    const int width = frame.settings->width, height = frame.settings->height;
    const std::vector<float> picture = readbacks.picture.as<float>();
    result.stats.nonfinite += countNonfinite(picture);
    result.picture = Picture{width, height, 4, picture};
    if (frame.target.aovs) {
        const std::vector<float> all = readbacks.aovs.as<float>();
        const std::size_t layerSize = std::size_t(width) * height * 4;
        for (int i = 0; i < kAovCount; ++i) {
            if (frame.target.aovLayer[i] < 0) continue;
            const std::span layer = std::span(all).subspan(frame.target.aovLayer[i] * layerSize, layerSize);
            result.stats.nonfinite += countNonfinite(layer);
            result.aovs[kAovNames[i]] = toPicture(layer, width, height, aovChannels(i));
        }
    }
    if (frame.skin.exitance) {
        const std::vector<float> exitance = readbacks.exitance.as<float>();
        result.stats.nonfinite += countNonfinite(exitance);
        const CoveredTexels texels = coveredTexels(readbacks.tileCounts);
        result.stats.atlasTexelsCovered = texels.all;
        result.stats.atlasTexelsLit = texels.lit;
    }
}

// Positions on the device are relative to the scene's origin.
void moveToWorld(RenderResult& result, const glm::dvec3& origin) {
    const auto found = result.aovs.find("position");
    if (found == result.aovs.end()) return;
    Picture& position = found->second;
    for (std::size_t i = 0; i < position.values.size() / 3; ++i) {
        if (result.picture.values[i * 4 + 3] <= 0) continue;
        for (int c = 0; c < 3; ++c) {
            position.values[i * 3 + c] = static_cast<float>(position.values[i * 3 + c] + origin[c]);
        }
    }
}

void prepareEnvironment(FrameContext& frame, const RenderInput& input, EnvironmentSplit& split) {
    const EnvironmentSettings& settings = input.rig.environment;
    if (!input.environment || !settings.enabled || !(settings.intensity > 0)) return;
    frame.environment = input.environment;
    if (settings.shadowSamples > 0) {
        split = splitEnvironment(*input.environment, settings.shadowSamples, settings.rotation, settings.intensity);
        frame.environment = &split.residual;
        frame.lightSamples.insert(frame.lightSamples.end(), split.samples.begin(), split.samples.end());
    }
}

void uploadEnvironment(FrameContext& frame) {
    const EnvironmentSettings& settings = frame.input->rig.environment;
    const double angle = settings.rotation * 3.14159265358979323846 / 180;
    std::vector<shared::EnvironmentSource> sources = frame.environmentMaps.mediumSources;
    const std::vector<shared::EnvironmentSource>& rough = frame.environmentMaps.roughSources;
    const auto mediumCount = static_cast<std::uint32_t>(sources.size());
    sources.insert(sources.end(), rough.begin(), rough.end());
    const std::vector<shared::EnvironmentSettingsData> data{{static_cast<float>(std::cos(angle)),
                                                             static_cast<float>(std::sin(angle)),
                                                             static_cast<float>(settings.intensity),
                                                             mediumCount, static_cast<std::uint32_t>(rough.size())}};
    frame.environmentSettings =
        gpu::Buffer(*frame.device, {.name = "environment settings",
                                    .bytes = sizeof(data[0]) + sources.size() * sizeof(sources[0])});
    frame.commands->upload(frame.environmentSettings, data);
    if (!sources.empty()) frame.commands->upload(frame.environmentSettings, sources, sizeof(data[0]));
}

// Draws the frame once, from nothing but the uploaded scene.
std::vector<gpu::PassTiming> drawFrame(FrameContext& frame, const Plan& plan, FrameReadbacks& readbacks) {
    frame.forgetFrame();
    readbacks = {};
    gpu::Commands commands = frame.device->begin();
    frame.commands = &commands;
    uploadFrameLights(frame);
    if (frame.needs[Need::environment]) uploadEnvironment(frame);
    prepareTarget(frame);
    for (const PassRow* row : plan.rows) {
        commands.beginPass(row->name);
        row->record(frame);
        commands.endPass();
    }
    readbacks.picture = commands.readback(frame.target.picture);
    if (frame.target.aovs) readbacks.aovs = commands.readback(frame.target.aovs);
    if (frame.skin.exitance) {
        readbacks.exitance = commands.readback(frame.skin.exitance);
        readbacks.tileCounts = commands.readback(frame.tiles.counts);
    }
    commands.submitAndWait();
    frame.commands = nullptr;
    return commands.timings();
}

}  // namespace

RenderResult renderPicture(gpu::Device& device, const RenderInput& input, const RenderSettings& settings) {
    const Clock::time_point start = Clock::now();
    device.resetPeak();
    const Scene& scene = *input.scene;
    FrameContext frame;
    frame.device = &device;
    frame.input = &input;
    frame.settings = &settings;
    frame.geometry = flattenScene(scene);
    frame.camera = viewCamera(input.camera, frame.geometry.origin, frame.geometry.bounds,
                              {settings.width, settings.height});
    const ViewCameraMetrics metrics(input.camera, {settings.width, settings.height});
    AtlasOptions atlasOptions{.size = settings.irradianceSize};
    for (const Character& character : scene.characters) {
        const glm::vec3 low(character.bounds.min - frame.geometry.origin), high(character.bounds.max - frame.geometry.origin);
        const bool inView = reaches(frame.camera.worldToClip, low, high);
        atlasOptions.mmPerTexelWanted.push_back(wantedMmPerTexel(character, metrics, inView));
        if (inView) {
            frame.pixelsAcross =
                std::max(frame.pixelsAcross, glm::length(character.bounds.size()) /
                                                 metrics.metresPerPixel(character.bounds.centre()));
        }
    }
    frame.atlas = layOutAtlas(scene, frame.geometry, atlasOptions);
    for (const ReceiverGroup& group : frame.geometry.receiverGroups) frame.groups.push_back(group.bounds);

    frame.lightSamples = sampleLights(input.rig);
    EnvironmentSplit split;
    prepareEnvironment(frame, input, split);
    // Without pruning, what is missing is there and black, so that every pass runs and nothing changes.
    const Environment black{"black", 2, 1, std::vector<glm::vec3>(2, glm::vec3(0))};
    if (!settings.prune) {
        if (!frame.environment) frame.environment = &black;
        if (frame.lightSamples.empty()) frame.lightSamples.push_back({.light = 0, .directional = true});
    }

    NeedsInput needs;
    needs.merge = settings.merge;
    needs.chain = settings.chain;
    needs.environment = frame.environment != nullptr;
    needs.prune = settings.prune;
    needs.lightSamples = static_cast<int>(frame.lightSamples.size());
    for (const LightSample& sample : frame.lightSamples) needs.shadowedSamples += sample.shadow;
    std::vector<bool> seen(scene.materials.size(), false);
    for (const GeometryDraw& draw : frame.geometry.draws) {
        needs.skinDraws += draw.skin;
        if (draw.skin && !seen[draw.material] && scene.materials[draw.material].skin->translucency) {
            ++needs.translucentSkinMaterials;
        }
        seen[draw.material] = true;
    }
    frame.needs = computeNeeds(needs);
    const Plan plan = makePlan(frame.needs);
    if (!frame.needs[Need::litSkin]) {
        // Skin that no light reaches is as black as anything else, and needs no atlas to be so.
        for (shared::DrawInfo& draw : frame.geometry.drawInfos) draw.chart = shared::NO_CHART;
    }

    if (frame.needs[Need::environment]) {
        // A third of a texel of the finest map that these meshes are drawn into.
        double texel = std::numeric_limits<double>::infinity();
        for (const Bounds& group : frame.groups) {
            texel = std::min(texel, glm::length(group.size()) / kVisibilityMapSize);
        }
        frame.proxyError = 0.3 * texel;
        addOcclusionProxies(frame.geometry, frame.proxyError);
    }

    RenderResult result;
    {
        gpu::Commands commands = device.begin();
        frame.commands = &commands;
        frame.scene = uploadScene(device, commands, scene, frame.geometry, frame.atlas, settings.gaussians);
        commands.submitAndWait();
    }
    if (frame.needs[Need::environment]) {
        frame.environmentMaps = prefilterEnvironment(device, *frame.environment, frame.scene.skins);
        frame.clusters = clusterEnvironment(*frame.environment);
    }
    result.stats.loadMs = millisecondsSince(start);

    Clock::time_point frameStart;
    FrameReadbacks readbacks;
    std::vector<std::vector<gpu::PassTiming>> timings;
    for (int repeat = 0; repeat < std::max(settings.repeats, 1); ++repeat) {
        frameStart = Clock::now();
        timings.push_back(drawFrame(frame, plan, readbacks));
    }
    result.stats.frameMs = millisecondsSince(frameStart);
    fillStats(frame, plan, timings, result.stats);
    takePictures(frame, readbacks, result);
    moveToWorld(result, frame.geometry.origin);
    return result;
}

}  // namespace cutis
