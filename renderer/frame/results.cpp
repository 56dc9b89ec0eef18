#include "renderer/frame/results.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "renderer/gpu/device.h"

namespace cutis {
namespace {

// Channels that an AOV has of the four that the shader writes.
int aovChannels(int aov) {
    constexpr int kChannels[kAovCount] = {3, 3, 3, 1, 3, 3, 3, 1, 1, 3};
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

const char* nameOf(Input input) {
    constexpr const char* kNames[] = {
        "geometry",      "pose",        "textures",    "materials",          "skin's specular layer", "pores", "albedo mix",           "profiles",
        "levels", "chain", "atlas size",  "light map size", "needed light maps", "characters in view",     "places of lights",      "intensities of lights", "environment",
        "rotation of the environment", "intensity of the environment", "camera", "picture size", "data channels"};
    static_assert(std::size(kNames) == kInputCount);
    return kNames[static_cast<int>(input)];
}

const char* nameOf(Resource resource) {
    constexpr const char* kNames[] = {"filtered environment", "environment settings", "directions of the sky", "meshes", "occluders of the sky",
                                      "textures", "materials", "pores", "atlas layout", "draws", "ranges of draws", "profiles", "stretch", "seams", "light patches", "opposite sides",
                                      "lights", "view buffers", "picture's memory", "surface", "seen triangles",
                                      "light maps", "thickness", "needed texels", "visibility of the sky", "irradiance",
                                      "blurred levels", "exitance", "picture"};
    static_assert(std::size(kNames) == static_cast<std::size_t>(Resource::picture) + 1);  // the last of them
    return kNames[static_cast<int>(resource)];
}

}  // namespace

std::string describeReads(const PassRow& row) {
    std::string list;
    const auto add = [&](const char* name) { list += (list.empty() ? "" : ", ") + std::string(name); };
    for (const Input input : row.inputs) add(nameOf(input));
    for (const Resource resource : row.reads) add(nameOf(resource));
    return list;
}

Readbacks recordReadbacks(const FrameContext& frame, bool lit) {
    Readbacks readbacks;
    readbacks.picture = frame.commands->readback(frame.target.picture);
    if (frame.target.aovs) readbacks.aovs = frame.commands->readback(frame.target.aovs);
    readbacks.inspect = recordInspect(frame);
    readbacks.skin = lit && frame.skin.exitance;
    if (readbacks.skin) {
        readbacks.nonfinite = frame.commands->readback(frame.skin.nonfinite);
        readbacks.tileCounts = frame.commands->readback(frame.tiles.counts);
    }
    return readbacks;
}

void takePictures(const FrameContext& frame, const Readbacks& readbacks, SkinFigures& skin, RenderResult& result) {
    const int width = frame.settings->width, height = frame.settings->height;
    result.picture = Picture{width, height, 4, readbacks.picture.as<float>()};
    result.stats.nonfinite += countNonfinite(result.picture.values);
    if (frame.target.aovs) {
        const std::vector<float> all = readbacks.aovs.as<float>();
        const std::size_t layerSize = std::size_t(width) * height * 4;
        for (int i = 0; i < kAovCount; ++i) {
            if (frame.target.aovLayer[i] < 0) continue;
            const std::span layer = std::span(all).subspan(frame.target.aovLayer[i] * layerSize, layerSize);
            result.stats.nonfinite += countNonfinite(layer);
            Picture values = toPicture(layer, width, height, aovChannels(i));
            if (i == kAovAtlas) {
                result.aovs[kInspectedName] =
                    lookUpInspected(frame.settings->inspect, readbacks.inspect, values);
            } else {
                result.aovs[kAovNames[i]] = std::move(values);
            }
        }
    }
    if (readbacks.skin) {
        const CoveredTexels texels = coveredTexels(readbacks.tileCounts);
        skin = {texels.all, texels.lit, readbacks.nonfinite.as<std::uint32_t>().at(0)};
    } else if (!frame.skin.exitance) {
        skin = {};
    }
    result.stats.nonfinite += skin.nonfinite;
    result.stats.atlasTexelsCovered = skin.texelsCovered;
    result.stats.atlasTexelsLit = skin.texelsLit;
    moveToWorld(result, frame.geometry.origin);
}

namespace {

std::string countOf(std::size_t some, std::size_t all) { return std::to_string(some) + " of " + std::to_string(all); }

// What is left out of rows that run, in words.
void addParts(const FrameContext& frame, std::vector<LeftOut>& list) {
    const Scene& scene = *frame.input->scene;
    for (const LeftOut& part : leftOutWithinRows(frame.needs)) list.push_back(part);
    list.insert(list.end(), frame.lighting.leftOut.begin(), frame.lighting.leftOut.end());
    for (std::size_t c = 0; c < scene.characters.size(); ++c) {
        if (frame.groupsSeen[c]) continue;
        list.push_back({"character " + scene.characters[c].name,
                        "out of view: it has no light maps and its skin is not lit; it casts shadows"});
    }
    const std::vector<bool>& maps = frame.lighting.mapsNeeded;
    const auto unneeded = static_cast<std::size_t>(std::count(maps.begin(), maps.end(), false));
    if (unneeded > 0) list.push_back({"light maps", countOf(unneeded, maps.size()) + " reach nothing that is seen"});
    const std::vector<TextureUse> uses = textureUses(scene, frame.geometry, frame.settings->prune);
    const auto unused = static_cast<std::size_t>(std::count(uses.begin(), uses.end(), TextureUse::none));
    if (unused > 0) list.push_back({"textures", countOf(unused, uses.size()) + " are never sampled"});
    std::size_t gaussians = 0;
    for (const int material : skinMaterials(scene, frame.geometry)) {
        gaussians = std::max(gaussians, scene.materials[material].skin->profile.gaussians.size());
    }
    const auto kept = static_cast<std::size_t>(frame.scene.gaussians);
    if (!frame.atlas.charts.empty() && kept < gaussians && frame.settings->gaussians == 0) {
        list.push_back({"gaussians", countOf(gaussians - kept, gaussians) +
                                         " have no weight, or blur less than a lookup between texels does"});
    }
}

}  // namespace

void fillStats(const FrameContext& frame, const Plan& plan, RenderStats& stats) {
    stats.device = frame.device->info().name;
    stats.leftOut = plan.leftOut;
    stats.notPrepared = plan.leftOutBefore;
    addParts(frame, stats.leftOut);
    stats.atlasWidth = stats.atlasHeight = frame.atlas.size;
    stats.atlasMmPerTexel = frame.atlas.mmPerTexel;
    for (const Light& light : frame.input->rig.lights) stats.lights += light.enabled;
    stats.lightSamples = static_cast<int>(frame.lighting.samples.size());
    stats.characters = static_cast<int>(frame.input->scene->characters.size());
    stats.gaussians = frame.atlas.charts.empty() ? 0 : frame.scene.gaussians;
    stats.lightMaps = static_cast<int>(frame.lights.viewList.size());
    stats.bytesGpu = frame.device->peakBytes();
}

}  // namespace cutis
