// Bodies whose texture coordinates do not give every place of the surface a place of its own.
#pragma once

#include "renderer/scene/scene.h"

namespace cutis::test {

// Both halves of the texture, left and right, on its left half: they meet where it folds.
Primitive mirrored(Primitive body);
// Without texture coordinates.
Primitive bare(Primitive body);
// With all of them in one point.
Primitive squeezed(Primitive body);
// Of a body of six equal faces: each takes the whole of the first one's place.
Primitive stacked(Primitive body);
// Of a body of six equal faces: each lies in a tile of the texture of its own, far from the others.
Primitive tiled(Primitive body);
// The first sixth of the vertices (a face of a body of six) with a tenth of the others' detail.
Primitive uneven(Primitive body);
// Each triangle an island of its own, in rows of equal ones.
Primitive shattered(const Primitive& body);

}  // namespace cutis::test
