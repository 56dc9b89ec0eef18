// The light of a picture: samples of the rig's lights, and the environment.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/frame/renderer.h"
#include "renderer/scene/environment_clusters.h"
#include "renderer/scene/environment_samples.h"
#include "renderer/scene/light.h"

namespace cutis {

struct FrameContext;

struct Lighting {
    std::vector<LightSample> samples;          // of the rig, then those drawn from the environment
    const Environment* environment = nullptr;  // what is left of it; nullptr: none
    std::vector<LeftOut> leftOut;              // lights, and why
    std::vector<bool> mapsNeeded;              // a shadowed sample and group of receivers

    // The environment as it was split last, neither turned nor dimmed.
    EnvironmentSplit split;
    const Environment* splitOf = nullptr;
    std::uint64_t splitRevision = 0;
    int splitSamples = 0;
};

// The directions in which the sky's visibility is found and what arrives around each, in the same order; neither turned nor
// dimmed.
struct SkyDirections {
    std::vector<VisibilityDirection> parts;
    std::vector<DirectionalFlux> arriving;
};

// Fills frame.lighting from the rig and the environment of the input. Without pruning, what is missing is there and
// black, so that every pass runs and nothing changes.
void readLighting(FrameContext& frame);

// Those of frame.lighting that have light maps.
std::vector<LightSample> shadowedSamples(const FrameContext& frame);

// Rows of the pass table: what shaders read of it.
void uploadLightSamples(FrameContext& frame);
void makeEnvironmentMaps(FrameContext& frame);
void makeSkyDirections(FrameContext& frame);
void uploadEnvironmentSettings(FrameContext& frame);

}  // namespace cutis
