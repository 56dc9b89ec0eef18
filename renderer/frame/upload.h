// The scene on the device, in parts that change apart: each is a row of the pass table.
#pragma once

#include <vector>

#include "renderer/frame/atlas.h"
#include "renderer/frame/geometry.h"
#include "renderer/frame/textures.h"
#include "renderer/passes/environment.h"
#include "renderer/passes/resources.h"

namespace cutis {

struct FrameContext;
struct RenderSettings;

struct UploadedScene {
    SceneBuffers buffers;
    std::vector<TextureArrays::Place> texturePlaces;  // per Scene::textures
    std::vector<shared::DrawInfo> draws;              // as uploaded
    std::vector<ChartRange> charts;                   // one an atlas chart
    int gaussians = 0;                                // most of any chart
};

// Textures that some drawn material samples, without `prune` all of them. Skin has its own roughness, so its
// metallic-roughness map never is.
std::vector<TextureUse> textureUses(const Scene& scene, const Geometry& geometry, bool prune);
// Materials that are drawn as skin, each once, in the order of the draws.
std::vector<int> skinMaterials(const Scene& scene, const Geometry& geometry);
// Their distinct specular layers, in the order of the environment's matte maps.
std::vector<SkinSpecular> skinLayers(const Scene& scene, const Geometry& geometry);
// The diffusion profile of a skin material as it is used: scaled, without Gaussians of no weight, and, where `gaussians`
// > 0, reduced to that many.
skin::Profile profileOf(const Scene& scene, int material, int gaussians);

// How far, in mm, each material's skin is blurred across borders of UV islands: three standard deviations of its widest blur,
// rounded up in steps so that a profile which changes a little leaves the atlas as it is. 0: not skin.
std::vector<double> reachBeyondBorders(const Scene& scene, const Geometry& geometry, const RenderSettings& settings);

// The charts of the atlas as passes use them. With settings.prune, of skin that is not translucent the Gaussians whose variance a lookup between texels
// adds anyway (1/6 texel²) are one: their levels of diffusion would be the same texture. That is so where a texel is no
// smaller than AtlasChart::finestMm, on all but a fiftieth of them; there light stays sharper by less than half a texel.
std::vector<ChartRange> chartRanges(const Scene& scene, const Atlas& atlas, const RenderSettings& settings);
// A number for each chart, equal for those whose levels of diffusion hold light of equal variances.
std::vector<int> profileNumbers(const std::vector<ChartRange>& charts);
// Whether wide Gaussians are blurred at a lower resolution.
bool reducesLevels(const RenderSettings& settings);

// Rows of the pass table.
void uploadMeshes(FrameContext& frame);
void uploadSceneTextures(FrameContext& frame);
void uploadMaterials(FrameContext& frame);
void uploadPores(FrameContext& frame);
void uploadLayout(FrameContext& frame);
void uploadStretch(FrameContext& frame);
void uploadDraws(FrameContext& frame);
void findDrawRanges(FrameContext& frame);
void uploadProfiles(FrameContext& frame);
void uploadSeams(FrameContext& frame);
void uploadOccluders(FrameContext& frame);

// What the CPU does ahead of these (frame/ahead.h), with the scene at rest.
void makeLayout(FrameContext& frame);
void makeSeams(FrameContext& frame);
void makeOccluders(FrameContext& frame);

// They free what these rows wrote.
void forgetMeshes(FrameContext& frame);
void forgetTextures(FrameContext& frame);
void forgetPores(FrameContext& frame);
void forgetLayout(FrameContext& frame);
void forgetSeams(FrameContext& frame);

}  // namespace cutis
