// One person, from recipe to glTF.
#pragma once

#include <filesystem>

#include "gltf_file.h"
#include "makehuman.h"
#include "recipe.h"

namespace cutis::people {

struct Sources {
    std::filesystem::path makeHuman;  // the unpacked npm package
    std::filesystem::path morseSkin;  // human_rig.blend of morse-simulator-data
};

// Adds the person's meshes, materials and nodes to `file`, writes the textures into `folder`, and returns the
// root node. `lookAt` is the point in the world that the eyes look at. Throws Error.
int addPerson(GltfFile& file, const std::filesystem::path& folder, const Sources& sources,
              const BaseMesh& base, const PersonRecipe& person, const Recipe& recipe,
              const glm::dvec3& lookAt);

}  // namespace cutis::people
