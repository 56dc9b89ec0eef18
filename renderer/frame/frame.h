// Everything that pictures are made with: kept from one to the next, as far as it is still good.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/frame/atlas.h"
#include "renderer/frame/detail.h"
#include "renderer/frame/geometry.h"
#include "renderer/frame/kept.h"
#include "renderer/frame/light_map_layers.h"
#include "renderer/frame/lighting.h"
#include "renderer/frame/plan.h"
#include "renderer/frame/seam_map.h"
#include "renderer/frame/upload.h"
#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/composite.h"
#include "renderer/passes/environment.h"
#include "renderer/passes/environment_visibility.h"
#include "renderer/passes/resources.h"
#include "renderer/passes/wide_gaussians.h"
#include "renderer/scene/light.h"

namespace cutis {

// Texels along each side of the depth map of one direction of the sky.
inline constexpr int kVisibilityMapSize = 256;
// Samples of a pixel along each side.
inline constexpr int kSupersampling = 3;

struct FrameContext {
    gpu::Device* device = nullptr;
    gpu::Commands* commands = nullptr;  // open while a row records, unless it runs alone
    const RenderInput* input = nullptr;
    const RenderSettings* settings = nullptr;
    bool anyView = false;
    Needs needs;
    const Changes* changes = nullptr;  // of what the row that records reads

    // Known before anything is planned
    Geometry geometry;
    SkinMesh skinMesh;             // of geometry
    std::vector<Bounds> groups;    // of receivers
    std::vector<bool> groupsSeen;  // in view, or all where every view counts
    shared::ViewCamera camera{};
    Detail detail;
    Lighting lighting;
    int wideGaussians = 0;  // Gaussians that are wide beside the body whose skin they blur

    // Made before the frame
    EnvironmentMaps environmentMaps;
    SkyDirections sky;
    gpu::Buffer environmentSettings;
    double proxyError = 0;  // metres by which the sky's occluders may stand off the meshes
    Atlas atlas;
    std::vector<std::uint32_t> occluderIndices;      // until they are uploaded
    std::array<SeamMap, kCoarseLevels + 1> seamMaps;  // of each resolution of diffusion, until they are uploaded
    UploadedScene scene;
    LightPatches patches;
    gpu::Buffer oppositeVertices;
    TileBuffers viewTile;
    PictureTarget target;

    // Written by passes
    SurfaceImages surface;
    AtlasTiles tiles;  // with surface
    LightMaps lights;
    LightMapLayers lightMapLayers;
    EnvironmentVisibility visibility;
    SkinLight skin;
};

}  // namespace cutis
