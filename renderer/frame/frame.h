// Everything one frame holds while its passes are recorded.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/frame/atlas.h"
#include "renderer/frame/geometry.h"
#include "renderer/frame/plan.h"
#include "renderer/frame/upload.h"
#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/composite.h"
#include "renderer/passes/environment.h"
#include "renderer/passes/environment_visibility.h"
#include "renderer/passes/resources.h"
#include "renderer/scene/environment_clusters.h"
#include "renderer/scene/light.h"

namespace cutis {

// Texels along each side of the depth map of one direction of the sky.
inline constexpr int kVisibilityMapSize = 256;

struct FrameContext {
    gpu::Device* device = nullptr;
    gpu::Commands* commands = nullptr;
    const RenderInput* input = nullptr;
    const RenderSettings* settings = nullptr;
    Needs needs;

    Geometry geometry;
    Atlas atlas;
    UploadedScene scene;
    std::vector<LightSample> lightSamples;  // of the rig, then those drawn from the environment
    std::vector<Bounds> groups;             // of receivers
    double pixelsAcross = 0;                // the largest diagonal of a character in view, in pixels of the picture

    const Environment* environment = nullptr;  // what is left of it once light samples are drawn
    EnvironmentMaps environmentMaps;           // filled before recording: filtering submits its own commands
    std::vector<EnvironmentCluster> clusters;
    gpu::Buffer environmentSettings;

    SurfaceImages surface;
    gpu::Buffer oppositeVertices;
    AtlasTiles tiles;  // with surface
    LightMaps lights;
    EnvironmentVisibility visibility;
    double proxyError = 0;  // metres by which the sky's occluders may stand off the meshes
    SkinLight skin;
    shared::ViewCamera camera{};
    TileBuffers viewTile;  // made by whoever first looks through the camera
    PictureTarget target;

    // Back to what is uploaded and filtered: nothing of a frame that was drawn is left.
    void forgetFrame() {
        surface = {}, oppositeVertices = {}, tiles = {}, lights = {}, visibility = {}, skin = {}, viewTile = {}, target = {};
    }
};

}  // namespace cutis
