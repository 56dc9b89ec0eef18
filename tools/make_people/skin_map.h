// The maps of one person's skin: MakeHuman's low-resolution albedo spread over a map of its own, with what a
// camera sees between its texels (pores, creases, freckles, uneven blood and pigment) added, and a normal map
// of the same relief.
#pragma once

#include <vector>

#include "mesh.h"
#include "raster.h"
#include "recipe.h"

namespace cutis::people {

// From MakeHuman's texture coordinates (whole body, head lying on its side) to ours (head upright on top with
// its face enlarged, shoulders below). Charts keep their neighbours; `u` of the head and the shoulders never
// overlap.
glm::dvec2 layoutUv(glm::dvec2 source);

// The parts of MakeHuman's map.
bool onHead(glm::dvec2 source);
bool onShoulders(glm::dvec2 source);

// What lies under each texel.
struct Surfels {
    int size = 0;                                   // texels along a side
    std::vector<glm::vec3> position;                // metres
    std::vector<glm::vec3> positionDu, positionDv;  // metres a texel
    std::vector<glm::vec2> source;                  // on MakeHuman's map
    std::vector<float> cover;                       // share hidden under hair
    std::vector<char> covered;
};

// Draws the mesh into its own texture space.
Surfels rasterizeSurfels(const TriangleMesh& mesh, int size);

struct SkinMaps {
    Raster albedo;  // linear, 3 channels
    Raster normal;  // tangent space, 0.5 + 0.5 n, 3 channels
};

// Natural logarithm of a map over its own blur: the detail that it can lend to another map of the same
// layout.
Raster computeDetail(const Raster& map);

// `source` is MakeHuman's map; `detail`, if any, what a finer map of the same layout lends it; `scalp` the
// colour that covered skin takes on.
SkinMaps makeSkinMaps(const Surfels& surfels, const Raster& source, const Raster* detail,
                      const SkinRecipe& recipe, const glm::dvec3& scalp, unsigned seed);

}  // namespace cutis::people
