// One person, from recipe to glTF.
#pragma once

#include <filesystem>

#include "gltf_file.h"
#include "makehuman.h"
#include "raster.h"
#include "recipe.h"

namespace cutis::people {

// What all people are made from.
struct Sources {
    std::filesystem::path makeHuman;  // the unpacked npm package
    BaseMesh base;
    Raster fineMap;     // the 2048² skin map of morse-simulator-data
    Raster fineDetail;  // computeDetail(fineMap)
};

// `morseRig` is human_rig.blend. Throws Error.
Sources readSources(const std::filesystem::path& makeHuman, const std::filesystem::path& morseRig);

// Adds the person's meshes, materials and nodes to `file`, writes the textures into `folder`, and returns the
// root node. `lookAt` is the point in the world that the eyes look at. Throws Error.
int addPerson(GltfFile& file, const std::filesystem::path& folder, const Sources& sources,
              const PersonRecipe& person, const Recipe& recipe, const glm::dvec3& lookAt);

}  // namespace cutis::people
