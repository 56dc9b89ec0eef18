// What passes read and write: the resources of a frame, each with the pass that fills it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/gpu/buffer.h"
#include "renderer/gpu/commands.h"
#include "renderer/gpu/image.h"
#include "renderer/gpu/program.h"
#include "renderer/skin/profile.h"
#include "shaders/shared/atlas_tiles.h"
#include "shaders/shared/scene.h"

namespace cutis {

inline constexpr std::uint32_t kCoarseLevels = shared::COARSEST_LEVEL;

// A run of triangles drawn with one call.
struct DrawRange {
    std::uint32_t firstIndex = 0, indexCount = 0;
    std::uint32_t firstProxyIndex = 0, proxyIndexCount = 0;  // a coarser form in proxyIndices, for the sky's shadows
    std::uint32_t material = 0;
    bool skin = false;     // takes light in
    bool cutOut = false;   // its material's alpha cuts it out
    bool blended = false;  // seen through
    bool masked = false;   // either: light maps ask its material what it stops
    bool clear = false;    // stops no light that would be worth a map
    bool doubleSided = false;
    bool closed = false;  // skin that bounds flesh: no light passes one side without meeting the other
    bool sealed = false;  // and all round, without an open edge: light from outside meets a side that faces it first
    std::uint32_t alphaGroup = 0xffffffffu;  // of material textures, that holds its alpha; all bits set: none
    glm::vec3 boundsMin{0}, boundsMax{0};    // metres from the scene's origin
};

// Gutter texels beyond borders of UV islands, at full, half and a quarter of the atlas' resolution (frame/seam_map.h).
struct SeamLists {
    std::array<gpu::Buffer, kCoarseLevels + 1> texels;  // shared::SeamTexel
    std::array<std::uint32_t, kCoarseLevels + 1> counts{};
    gpu::Buffer metrics;  // of those at full resolution: AtlasVertex::metric at the border
};

// Pores of skin; empty where none are seen.
struct PoreBuffers {
    gpu::Buffer materials;        // shared::Pores, one a material
    gpu::Buffer restPositions;    // of a scene that can move
    gpu::Image tile;              // slopes (renderer/skin/detail.h), all levels
    gpu::SampledImage slopes{};   // of tile
};

// The scene on the device, uploaded once (frame/upload.cpp).
struct SceneBuffers {
    gpu::Buffer indices, proxyIndices, positions, attributes, atlasVertices, triangleDraws, draws, materials;
    gpu::Buffer albedoTable;                     // rows of ρ_dt, one a distinct skin roughness
    gpu::Buffer gaussians;                       // of all charts
    gpu::Buffer skinTriangles, borderTriangles;  // triangle numbers
    std::uint32_t skinTriangleCount = 0, borderTriangleCount = 0;
    SeamLists seams;
    std::vector<gpu::Image> textureArrays;
    std::vector<gpu::SampledImage> materialTextures;  // MAX_TEXTURE_GROUPS of them, or none
    std::vector<DrawRange> ranges;
    bool seenThrough = true;  // some range may be blended
    bool skinShines = true;   // some skin may have a specular layer
    std::uint32_t layers = 0;  // LAYER_ bits, specialization constant 3 of what shades
    PoreBuffers pores;
    std::uint32_t textureGroups = 0,
                  textureSlots = 0;  // specialization constants 0 and 1 of what samples textures
    gpu::Specialization textureConstants() const { return {{0, textureGroups}, {1, textureSlots}}; }
    bool textured() const { return !materialTextures.empty(); }
};

struct ChartRange {
    glm::uvec4 rect{0};
    std::uint32_t firstGaussian = 0;
    skin::Profile profile;  // in mm², scaled and reduced as the frame uses it
    std::uint32_t blurred = 0;  // so many of its Gaussians, the narrowest, are; the others are wide (passes/wide_gaussians.h)
    bool facing = false;        // not translucent: it gets light of skin that faces where it does
    float mmPerUnit = 1000;
    double coarsestMm = 0;  // longest side of a texel, but for the largest fifth of them
    std::uint32_t receiverGroup = 0;
};

// Filled by recordSurface and recordOpposite.
struct SurfaceImages {
    int size = 0;
    gpu::Image triangles, position, normal, albedo, stretch;
    std::array<gpu::Image, kCoarseLevels>
        coarseStretch;    // at half and at a quarter of the resolution, where levels have it
    gpu::Image opposite;  // only when thickness comes from the shape alone
};

// Samples of one light, one after the other, as many as a dispatch takes.
struct LightRun {
    std::uint32_t firstSample = 0, sampleCount = 0;
    std::uint32_t firstView = 0;  // of the first sample; only with shadow
    std::uint32_t light = 0;
    bool shadow = false;
    bool startsLight = false;
};
inline constexpr std::uint32_t kLongestLightRun = 4;

// Filled by recordLightMaps. Layer = LightView::layer.
struct LightMaps {
    int size = 0;
    std::vector<LightRun> runs;
    std::uint32_t groupCount = 0;  // of receivers: views of a sample
    gpu::Buffer samples, views;
    std::vector<shared::LightView> viewList;  // as uploaded
    int drawn = 0;                            // of them, this time
    std::uint32_t sampleCount = 0;
    std::uint32_t lightCount = 0;  // that the samples belong to
    gpu::Image depth;
    gpu::Image entry;  // only with translucency
};

// Filled by recordEnvironmentVisibility and recordEnvironmentOcclusion.
struct EnvironmentVisibility {
    int directions = 0;
    gpu::Image visibility;          // half the atlas' size, a layer for each 32 directions
    gpu::Image occlusion, openSky;  // half the atlas' size
    gpu::Buffer vertexVisibility, probes;
};

inline constexpr float kNoThickness = 60000;  // mm

// The irradiance blurred to variance v_k, k from 0. Levels lie at full, half or a quarter of the atlas'
// resolution, never finer than the one before.
struct DiffusionLevels {
    std::array<gpu::Image, kCoarseLevels + 1> images;  // by resolution; a layer a level
    std::vector<std::uint32_t> shifts;                 // of each level: its side is the atlas' / 2^shift
    // By resolution: between the two directions of a blur, and what a level there is made from.
    std::array<gpu::Image, kCoarseLevels + 1> scratch, reduced;
    std::uint64_t tiles = 0;  // AtlasTiles::id of those that they were made for
    std::uint32_t first(std::uint32_t shift) const;    // level that has at most this resolution
    gpu::ImageView view(std::uint32_t level) const;
};

// Filled by recordThickness, recordIrradiance, recordDiffusion and recordExitance.
struct SkinLight {
    gpu::Image
        entry;  // place in the atlas in texels and thickness in mm; only when that comes from light maps
    gpu::Image irradiance;  // E' and the island
    gpu::Image incident;    // E and the thickness
    gpu::Image visibility;  // a layer a light: share of it that arrives; only with shadows
    DiffusionLevels levels;
    gpu::Image exitance;
    gpu::Buffer nonfinite;  // number of its values that are not finite
};

// Texels as they are, clamped at the edge.
gpu::SampledImage nearest(gpu::Device& device, const gpu::Image& image);
// Between texels' centres: bilinear, clamped at the edge.
gpu::SampledImage bilinear(gpu::Device& device, const gpu::Image& image);
// The same between mip levels too.
gpu::SampledImage trilinear(gpu::Device& device, const gpu::Image& image);
// For comparing depths: bilinear over four comparisons, lit outside the map.
gpu::SampledImage depthComparison(gpu::Device& device, const gpu::Image& image);

}  // namespace cutis
