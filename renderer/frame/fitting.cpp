#include "renderer/frame/fitting.h"

#include <algorithm>
#include <optional>
#include <string>

namespace cutis {
namespace {

// A light map of the first coarser picture; half of what the program takes at least.
constexpr int kFirstLightMap = 512, kLeastLightMap = 64;
constexpr double kLeastDetail = 1.0 / 64;
constexpr int kLeastAtlas = 16, kLeastPicture = 16;

// What it would take, without drawing; nothing where there is no room.
std::optional<RenderStats> planWithin(gpu::Device& device, const RenderInput& input,
                                      const RenderSettings& settings) {
    try {
        return Renderer(device, Renderer::Views::one).plan(input, settings);
    } catch (const gpu::OutOfMemory&) {
        return std::nullopt;
    }
}

// The same picture with what the program chooses half as fine; nothing where there is nothing left to choose.
std::optional<RenderSettings> coarser(const RenderSettings& settings, bool lightMapsFixed) {
    RenderSettings less = settings;
    if (settings.irradianceSize == 0) less.detail /= 2;
    if (!lightMapsFixed)
        less.lightMapSize = settings.lightMapSize ? settings.lightMapSize / 2 : kFirstLightMap;
    const bool atlasCan = settings.irradianceSize == 0 && less.detail >= kLeastDetail;
    const bool mapsCan = !lightMapsFixed && less.lightMapSize >= kLeastLightMap;
    if (!atlasCan) less.detail = settings.detail;
    if (!mapsCan) less.lightMapSize = settings.lightMapSize;
    return atlasCan || mapsCan ? std::optional(less) : std::nullopt;
}

// Coarsens step by step until there is room.
std::optional<RenderSettings> coarseEnough(gpu::Device& device, const RenderInput& input,
                                           const RenderSettings& settings, RenderStats& plan) {
    // Sizes below kFirstLightMap are those of an earlier step; larger ones are the user's.
    const bool lightMapsFixed = settings.lightMapSize > kFirstLightMap;
    std::optional<RenderSettings> tried = coarser(settings, lightMapsFixed);
    for (; tried; tried = coarser(*tried, lightMapsFixed)) {
        if (const auto found = planWithin(device, input, *tried)) {
            plan = *found;
            return tried;
        }
    }
    return std::nullopt;
}

// As options of the command line.
std::string whatWouldFit(gpu::Device& device, const RenderInput& input, const RenderSettings& settings) {
    RenderStats plan;
    for (RenderSettings less = settings; less.irradianceSize / 2 >= kLeastAtlas;) {
        less.irradianceSize /= 2;
        if (planWithin(device, input, less) || coarseEnough(device, input, less, plan))
            return "an atlas of " + std::to_string(less.irradianceSize) + " texels would fit";
    }
    RenderSettings less = settings;
    less.irradianceSize = 0;
    while (less.width / 2 >= kLeastPicture && less.height / 2 >= kLeastPicture) {
        less.width /= 2, less.height /= 2;
        if (planWithin(device, input, less) || coarseEnough(device, input, less, plan))
            return "a picture of " + std::to_string(less.width) + " x " + std::to_string(less.height) +
                   " would fit";
    }
    return "not even a small picture of this scene would fit";
}

}  // namespace

RenderSettings settingsThatFit(gpu::Device& device, const RenderInput& input, const RenderSettings& settings,
                               const gpu::OutOfMemory& problem) {
    RenderStats plan;
    if (const auto found = coarseEnough(device, input, settings, plan)) {
        warn(problem.why() + "; drawing it coarser, with an atlas of " + std::to_string(plan.atlasWidth) +
             " texels and light maps of at most " + std::to_string(found->lightMapSize));
        return *found;
    }
    throw Error(problem.subject(), problem.why() + "; " + whatWouldFit(device, input, settings),
                problem.where());
}

}  // namespace cutis
