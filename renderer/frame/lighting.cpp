#include "renderer/frame/lighting.h"

#include <cmath>
#include <map>
#include <set>

#include "renderer/frame/frame.h"
#include "renderer/frame/light_reach.h"
#include "renderer/gpu/device.h"
#include "renderer/scene/light_samples.h"

namespace cutis {
namespace {

// The middle of the characters, or of a scene without any.
std::optional<glm::dvec3> subjectOf(const Scene& scene) {
    Bounds bounds;
    for (const Character& character : scene.characters) bounds.extend(character.bounds);
    if (bounds.empty()) bounds = scene.bounds;
    return bounds.empty() ? std::nullopt : std::optional(bounds.centre());
}

// A light that is this many times as far from the scene as the scene is large, and as strong all over it,
// shines in parallel, within 1 / kFar rad. As a point it would be known only by distances whose last digits
// are larger than what stands behind what: at 1,000 km floats are 60 mm apart.
constexpr double kFar = 2000, kAsStrong = 2e-3;

void makeFarParallel(std::vector<LightSample>& samples, const Bounds& scene) {
    if (scene.empty()) return;
    const double size = 0.5 * glm::length(scene.size());
    for (LightSample& sample : samples) {
        const glm::dvec3 away = scene.centre() - sample.position;
        const double distance = glm::length(away);
        if (sample.directional || !(distance > kFar * size)) continue;
        const glm::dvec3 direction = away / distance;
        const glm::dvec3 irradiance = irradianceFrom(sample, scene.centre(), -direction);
        bool even = true;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 p(corner & 1 ? scene.max.x : scene.min.x, corner & 2 ? scene.max.y : scene.min.y,
                               corner & 4 ? scene.max.z : scene.min.z);
            const glm::dvec3 off = glm::abs(irradianceFrom(sample, p, -direction) - irradiance);
            even = even && glm::all(glm::lessThanEqual(off, kAsStrong * irradiance));
        }
        if (!even || irradiance == glm::dvec3(0)) continue;
        sample = {.light = sample.light,
                  .directional = true,
                  .direction = direction,
                  .intensity = irradiance,
                  .shadow = sample.shadow,
                  .radius = sample.radius / distance};
    }
}

void splitOnce(Lighting& lighting, const RenderInput& input, int samples) {
    const bool known = lighting.splitOf == input.environment && lighting.splitSamples == samples &&
                       lighting.splitRevision == input.environmentRevision;
    if (known) return;
    lighting.splitOf = nullptr;
    lighting.split = splitEnvironment(*input.environment, samples, 0, 1);
    lighting.splitOf = input.environment;
    lighting.splitSamples = samples;
    lighting.splitRevision = input.environmentRevision;
}

void addToRuns(const shared::LightSampleData& sample, std::vector<LightRun>& runs, std::uint32_t index) {
    const bool sameLight = !runs.empty() && runs.back().light == sample.light;
    const bool shadow = (sample.flags & shared::LIGHT_SHADOW) != 0;
    if (!sameLight || runs.back().sampleCount == kLongestLightRun || runs.back().shadow != shadow) {
        runs.push_back({.firstSample = index, .firstView = sample.firstView, .light = sample.light, .shadow = shadow,
                        .startsLight = !sameLight});
    }
    ++runs.back().sampleCount;
}

// Samples that reach nothing light nothing.
void leaveOutDarkSamples(FrameContext& frame) {
    Lighting& lighting = frame.lighting;
    std::map<int, const char*> dark;
    std::set<int> lit;
    std::erase_if(lighting.samples, [&](const LightSample& sample) {
        const char* why = "nothing is there";
        for (const Bounds& group : frame.groups) {
            why = whyDark(sample, group);
            if (!why) break;
        }
        if (why) dark.emplace(sample.light, why);
        else lit.insert(sample.light);
        return why != nullptr;
    });
    for (const auto& [light, why] : dark) {
        if (!lit.contains(light)) lighting.leftOut.push_back({"light " + frame.input->rig.lights[light].name, why});
    }
}

// Without pruning, what is missing is there and black.
void addBlackLight(Lighting& lighting) {
    static const Environment kBlack{"black", 2, 1, std::vector<glm::vec3>(2, glm::vec3(0))};
    if (!lighting.environment) lighting.environment = &kBlack;
    if (lighting.samples.empty()) lighting.samples.push_back({.light = 0, .directional = true});
}

// A map is looked up where its sample reaches a group of receivers of which something is seen, or lit.
void findNeededMaps(FrameContext& frame) {
    Lighting& lighting = frame.lighting;
    lighting.mapsNeeded.clear();
    for (const LightSample& sample : lighting.samples) {
        if (!sample.shadow) continue;
        for (std::size_t g = 0; g < frame.groups.size(); ++g) {
            const bool needed = frame.groupsSeen[g] && mayReach(sample, frame.groups[g]);
            lighting.mapsNeeded.push_back(needed || !frame.settings->prune);
        }
    }
}

}  // namespace

void readLighting(FrameContext& frame) {
    const RenderInput& input = *frame.input;
    const EnvironmentSettings& settings = input.rig.environment;
    Lighting& lighting = frame.lighting;
    SamplingOptions sampling;
    sampling.seed = frame.settings->seed;
    sampling.subject = subjectOf(*input.scene);
    lighting.samples = sampleLights(input.rig, sampling);
    makeFarParallel(lighting.samples, input.scene->bounds);
    lighting.leftOut.clear();
    if (frame.settings->prune) leaveOutDarkSamples(frame);
    lighting.environment = nullptr;
    if (input.environment && settings.enabled && settings.intensity > 0) {
        lighting.environment = input.environment;
        if (settings.shadowSamples > 0) {
            splitOnce(lighting, input, settings.shadowSamples);
            lighting.environment = &lighting.split.residual;
            for (LightSample sample : lighting.split.samples) {
                sample.direction = rotateAboutY(sample.direction, settings.rotation);
                sample.intensity *= settings.intensity;
                lighting.samples.push_back(sample);
            }
        }
    }
    if (!frame.settings->prune) addBlackLight(lighting);
    findNeededMaps(frame);
}

std::vector<LightSample> shadowedSamples(const FrameContext& frame) {
    std::vector<LightSample> shadowed;
    for (const LightSample& sample : frame.lighting.samples) {
        if (sample.shadow) shadowed.push_back(sample);
    }
    return shadowed;
}

void uploadLightSamples(FrameContext& frame) {
    LightMaps& lights = frame.lights;
    std::vector<shared::LightSampleData> samples;
    std::uint32_t shadowed = 0;
    int lastLight = 0;
    lights.runs.clear();
    lights.lightCount = 0;
    for (const LightSample& from : frame.lighting.samples) {
        shared::LightSampleData to{};
        to.position = glm::vec3(from.position - frame.geometry.origin);
        to.direction = glm::vec3(from.direction);
        to.intensity = glm::vec3(from.intensity);
        to.cosInner = static_cast<float>(from.cosInner);
        to.cosOuter = static_cast<float>(from.cosOuter);
        to.range = static_cast<float>(from.range);
        to.radius = static_cast<float>(from.radius);
        if (from.directional) to.flags |= shared::LIGHT_DIRECTIONAL;
        if (from.cosineEmission) to.flags |= shared::LIGHT_COSINE;
        if (from.shadow) {
            to.flags |= shared::LIGHT_SHADOW;
            to.firstView = shadowed++ * static_cast<std::uint32_t>(frame.groups.size());
        }
        if (samples.empty() || from.light != lastLight) to.light = lights.lightCount++;
        else to.light = lights.lightCount - 1;
        lastLight = from.light;
        addToRuns(to, lights.runs, static_cast<std::uint32_t>(samples.size()));
        samples.push_back(to);
    }
    lights.groupCount = static_cast<std::uint32_t>(frame.groups.size());
    lights.sampleCount = static_cast<std::uint32_t>(samples.size());
    lights.samples =
        gpu::Buffer(*frame.device, {.name = "light samples", .bytes = samples.size() * sizeof(samples[0])});
    if (!samples.empty()) frame.commands->upload(lights.samples, samples);
}

void makeEnvironmentMaps(FrameContext& frame) {
    frame.environmentMaps = prefilterEnvironment(*frame.device, *frame.lighting.environment,
                                                 skinLayers(*frame.input->scene, frame.geometry));
}

void makeSkyDirections(FrameContext& frame) {
    const Environment& environment = *frame.lighting.environment;
    frame.sky.parts = visibilityDirections(environment, shared::VISIBILITY_DIRECTIONS, frame.settings->seed);
    std::vector<glm::dvec3> directions;
    for (const VisibilityDirection& part : frame.sky.parts) directions.push_back(part.direction);
    // Shares do not depend on how strong the light is.
    frame.sky.arriving = fluxPerDirection(clusterEnvironment(environment), directions, 0, 1);
}

void uploadEnvironmentSettings(FrameContext& frame) {
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

}  // namespace cutis
