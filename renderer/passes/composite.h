// View and composite: what the camera sees, then its colour. Nothing else depends on the camera.
// Shaders: view.vert, view.frag; collect.comp, shade.comp, resolve.comp.
#pragma once

#include <array>

#include "renderer/passes/environment.h"
#include "renderer/passes/resources.h"

namespace cutis {

// In the order of kAovNames and of AOV_ in shade.comp. The last has no name: where in the atlas a pixel's
// skin is.
inline constexpr int kAovCount = 10;
inline constexpr int kAovDiffuse = 0, kAovSpecular = 1, kAovAtlas = 9;

struct PictureTarget {
    gpu::Image picture;  // RGBA32F
    gpu::Image aovs;     // a layer for each wanted AOV; empty when none is
    std::array<int, kAovCount> aovLayer;  // -1: not wanted
};

// A part of the picture, in pixels, with `supersampling`² samples a pixel.
struct ViewTile {
    glm::ivec2 origin{0}, size{0}, pictureSize{0};
    int supersampling = 2;
};

// What the steps of a tile hand to one another; every tile of a picture uses the same.
struct TileBuffers {
    int layers = 1;        // surfaces kept apart: seen through, and what is behind them
    gpu::Image triangles;  // which triangles the samples see, nearest layer first
    gpu::Image depth, peeledDepth[2];
    gpu::Buffer camera;
    gpu::Buffer points, skinList, otherList, counts, groups, shaded;
    gpu::Image pixels;
};

// Largest edge of a tile, in pixels, whose shading points fit the memory that a tile may take.
int tileSize(const SceneBuffers& scene, int supersampling);

// For tiles of up to `size` pixels.
TileBuffers makeTileBuffers(gpu::Device& device, const SceneBuffers& scene, const glm::ivec2& size, int supersampling);

// What the samples of a tile see: the opaque surfaces alone, or with all that is seen through.
void recordOpaqueView(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                      const shared::ViewCamera& camera, const ViewTile& tile, const TileBuffers& buffers);
void recordView(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                const shared::ViewCamera& camera, const ViewTile& tile, const TileBuffers& buffers);

struct CompositeInput {
    const SceneBuffers* scene;
    const TileBuffers* buffers;
    const SkinLight* skin = nullptr;  // nullptr: no skin
    const SurfaceImages* surface = nullptr;  // with skin
    const LightMaps* lights;          // without depth: no shadows
    const EnvironmentMaps* environment = nullptr;
    const EnvironmentVisibility* visibility = nullptr;  // with environment
    const gpu::Buffer* environmentSettings = nullptr;   // with environment
};

void recordComposite(gpu::Device& device, gpu::Commands& commands, const CompositeInput& input, const ViewTile& tile,
                     const PictureTarget& target);

}  // namespace cutis
