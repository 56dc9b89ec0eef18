// The skin of bodies in patches, for Gaussians that are wide beside them (passes/wide_gaussians.h).
#pragma once

#include <span>
#include <vector>

#include "renderer/frame/atlas.h"
#include "renderer/passes/resources.h"
#include "shaders/shared/light_patches.h"

namespace cutis {

struct FrameContext;
struct RenderSettings;

// Whether a Gaussian (variance in mm²) is wide beside a body whose skin has that area in mm²: on a sphere, from 0.35 radii of
// standard deviation on. Those of skin on a head are narrower by far.
inline constexpr double kWideShare = 0.01;
inline bool isWide(double variance, double area) { return variance > kWideShare * area; }

// How many Gaussians of any body's skin are: none in the published chain, which blurs them all.
int countWideGaussians(const Scene& scene, const Geometry& geometry, const RenderSettings& settings);

struct PatchList {
    std::vector<shared::LightPatch> patches;
    std::vector<shared::PatchSample> samples;
};

// Adds the skin of one character as it stands, in cubes whose side is 1/32 of the root of its area: a third of the narrowest wide
// Gaussian's standard deviation. Their samples are at most 512² and one more for each patch and island that share such a block.
void appendPatches(const Scene& scene, const Geometry& geometry, const Atlas& atlas, int character, PatchList& list);

// Rows of the pass table.
void uploadLightPatches(FrameContext& frame);
void forgetLightPatches(FrameContext& frame);

}  // namespace cutis
