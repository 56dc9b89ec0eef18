// A plain shirt grown from the body it covers, so that a bust ends in cloth and not in a cut.
#pragma once

#include "mesh.h"
#include "raster.h"

namespace cutis::people {

// How far below the neckline a point of the base mesh is, in metres along the cloth, about; negative: bare
// skin. `drop` lowers the neckline, in metres.
double belowNeckline(const glm::dvec3& baseDecimetres, double drop);

// `body` is the part to cover, in metres; `base` has the same faces on the unmorphed base mesh, in
// decimetres. Texture coordinates count tiles of makeKnit().
TriangleMesh makeShirt(const QuadMesh& body, const QuadMesh& base, double drop, unsigned seed);

// A tile of knitted cloth: tangent-space normals, 0.5 + 0.5 n.
Raster makeKnit(int size);

}  // namespace cutis::people
