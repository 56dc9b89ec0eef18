// Scenes as binary glTF files.
#pragma once

#include <filesystem>

#include "renderer/scene/scene.h"

namespace cutis {

// Writes geometry, nodes, materials (with extras.skin), cameras, punctual lights and images (as PNG; rgba8
// only) so that loadGltf gives the same scene. Lights of type rect, which glTF lacks, are left out with a
// warning; a scene that moves is written in the pose that it is in. Written atomically. Throws Error, also
// when the scene has an rgba16f image or more than 4 GiB.
void writeGlb(const Scene& scene, const std::filesystem::path& path);

}  // namespace cutis
