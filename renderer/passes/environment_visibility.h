// Environment visibility: which directions see the sky from each piece of skin and each vertex of everything
// else, once per pose; and what share of the environment's light that leaves, once per environment (DESIGN
// §1.4). Shaders: environment_visibility.comp, environment_occlusion.comp.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/passes/atlas_tiles.h"
#include "renderer/passes/resources.h"
#include "renderer/scene/scene.h"

namespace cutis {

struct VisibilityInput {
    const SceneBuffers* scene;
    const SurfaceImages* surface = nullptr;       // nullptr: no skin
    const AtlasTiles* tiles = nullptr;            // with surface: where skin needs it
    std::span<const shared::DrawInfo> draws;      // as uploaded
    std::span<const std::uint32_t> vertexCounts;  // of each draw
    std::span<const Bounds> groups;               // receivers, world
    std::vector<bool> groupsSeen;                 // of them; some are. The others are left out
    std::vector<bool> groupsChanged;              // of them; the others keep what they have. Empty: all
    Bounds casters;                               // world
    glm::dvec3 origin{0};
    std::uint32_t probeCount = 0;  // vertices that are not skin
    int mapSize = 256;             // texels of a direction's depth map
    float clearance = 0;           // metres by which the meshes drawn may stand above the surface
};

// Fills the bits of `directions` (xyz: unit, towards the sky; w: solid angle that it stands for, sr;
// shared::VISIBILITY_DIRECTIONS of them), in what is there where not all groups have changed.
void recordEnvironmentVisibility(gpu::Device& device, gpu::Commands& commands, const VisibilityInput& input,
                                 std::span<const glm::vec4> directions, EnvironmentVisibility& visibility);

// Fills occlusion, openSky and probes from the bits and from what arrives around each direction (already
// rotated).
void recordEnvironmentOcclusion(gpu::Device& device, gpu::Commands& commands, const VisibilityInput& input,
                                std::span<const glm::vec4> directions,
                                std::span<const shared::EnvironmentDirection> arriving,
                                EnvironmentVisibility& visibility);

}  // namespace cutis
