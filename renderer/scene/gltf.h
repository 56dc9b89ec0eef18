// glTF 2.0 files (.gltf and .glb) as scenes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "renderer/scene/scene.h"

namespace cutis {

struct GltfOptions {
    // What is skin, as for selectSkin, or a file of skin_file.h. Unset: what material.extras.skin says, else the name, with a warning.
    std::optional<std::string> skin;
    bool images = true;  // false: leave Scene::images without texels
};

// Loads the file's default scene: nodes, meshes, skins, animations, materials, images, cameras and lights, all checked,
// at rest (see poseScene), with world transforms, bounds and characters filled in. Nothing outside the file's folder is read. Only what the
// scene reaches is decoded. Missing normals are computed smooth over shared vertices (glTF asks for flat
// ones: on skin facets are never what was meant); missing tangents are computed where a normal map wants
// them. Throws Error naming the file and the JSON path, such as
// `meshes[0].primitives[1].attributes.POSITION`.
Scene loadGltf(const std::filesystem::path& path, const GltfOptions& options = {});

// Decides which materials are skin: those whose name matches the glob (`*`, `?`, `[a-z]`; case counts), or
// none for "none". Materials that were skin keep their parameters, others get the defaults. Characters are
// found anew. Throws Error when the glob matches no material, listing their names.
void selectSkin(Scene& scene, const std::string& globOrNone);

}  // namespace cutis
