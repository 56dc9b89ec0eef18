// How far skin is stretched in the pose that it is in: the one part of the atlas' layout that a pose changes.
#pragma once

#include <vector>

#include "renderer/frame/atlas.h"
#include "renderer/frame/geometry.h"

namespace cutis {

// The vertices of an atlas with the metric of the pose that the geometry is in: G = JᵀJ at each, the mean of
// its triangles' by their area in the atlas.
std::vector<shared::AtlasVertex> verticesInPose(const Scene& scene, const Geometry& geometry,
                                                const Atlas& atlas);

}  // namespace cutis
