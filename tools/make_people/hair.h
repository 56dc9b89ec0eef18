// Hair as MakeHuman has it: sheets with strands painted on, blended over what is behind.
#pragma once

#include "mesh.h"
#include "raster.h"
#include "recipe.h"

namespace cutis::people {

// The picture of a hair proxy in the recipe's colours, 4 channels.
Raster makeHairColors(const Raster& picture, const HairRecipe& recipe);

// Moves sheets that lie on the skin, or just in it, a few millimetres off: surfaces that nearly coincide
// shade each other in speckles. Both are in metres.
void liftHair(TriangleMesh& hair, const TriangleMesh& skin);

// Mean colour of what is opaque, linear.
glm::dvec3 meanHairColor(const Raster& colors);

// For each vertex of the skin above the eyes, the share hidden by the hair right above it: 1 - exp(-layers of
// hair), counted with a Gaussian of some millimetres. `skin` and `hair` are in metres, origin between the
// eyes.
std::vector<double> computeCover(const TriangleMesh& skin, const TriangleMesh& hair, const Raster& colors);

}  // namespace cutis::people
