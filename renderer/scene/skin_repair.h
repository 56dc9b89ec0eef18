// What skin must be to be lit as skin, where its file has it otherwise.
#pragma once

#include "renderer/scene/scene.h"

namespace cutis {

// Skin bounds flesh, so its front is its outside. A mesh whose skin encloses its inside the other way round
// (its volume, by the divergence theorem about the centroid, is negative) is turned over, and normals that
// point to the inside of a mesh are turned about, each with a warning. Open and flat meshes that enclose
// hardly anything, two-sided materials and meshes that deform stay as they are.
void turnSkinOutwards(Scene& scene);

}  // namespace cutis
