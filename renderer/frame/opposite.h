// The other side of thin skin, found from the shape alone: for each vertex the nearest skin of the same character that
// lies behind it through its flesh.
//
// The exact transfer between two parallel sheets a thickness t apart is each Gaussian's blur of the far sheet, weighted
// by exp(-t²/2v), read where the perpendicular meets it (DESIGN §1.4): it does not depend on where light comes from, so
// that one place and one thickness a texel serve any number of lights, and the result is linear in them.
#pragma once

#include <vector>

#include "renderer/frame/atlas.h"
#include "renderer/frame/geometry.h"
#include "renderer/passes/resources.h"

namespace cutis {

// One a skin vertex; indices as in Atlas::vertices. Vertices without another side within reach have a thickness of
// kNoThickness and the island 0.
std::vector<shared::OppositeVertex> findOpposite(const Scene& scene, const Geometry& geometry, const Atlas& atlas);

}  // namespace cutis
