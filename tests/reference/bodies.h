// Bodies fine enough for an exact evaluation: what facets change is far below what is compared.
#pragma once

#include "renderer/scene/scene.h"

namespace cutis::test {

// A sphere round the origin of 6 · segments² · 2 triangles, from a cube with equal angles. Facets of angle δ
// = π / 2 / segments shorten distances and areas by about δ²/12; on 3 mm, 64 segments add 1e-4 of the light, 256 less than
// 2e-5.
Primitive makeFineSphere(double radius, int segments);

// A square of side `size` in the plane z = 0, facing +Z, in two halves of its own vertices; their vertex
// colours are 0 where x < 0 and 1 where x > 0.
Primitive makeHalvedPlate(double size);

}  // namespace cutis::test
