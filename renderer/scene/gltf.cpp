#include "renderer/scene/gltf.h"

#include <fnmatch.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "renderer/core/error.h"
#include "renderer/scene/characters.h"
#include "renderer/scene/codec_client.h"
#include "renderer/scene/gltf_parts.h"
#include "renderer/scene/pose.h"
#include "renderer/scene/skin_file.h"
#include "renderer/scene/skin_repair.h"

namespace cutis {
namespace {

std::string quotedNames(const std::vector<Material>& materials, bool skinOnly) {
    std::string names;
    for (const Material& material : materials) {
        if (skinOnly && !material.skin) continue;
        names += (names.empty() ? "'" : ", '") + material.name + "'";
    }
    return names;
}

// The words of a name in lower case: "HeadSkin_02" is head, skin.
std::vector<std::string> wordsOf(const std::string& name) {
    std::vector<std::string> words(1);
    char previous = 0;
    for (const char c : name) {
        const auto u = static_cast<unsigned char>(c);
        const bool starts = std::isupper(u) && std::islower(static_cast<unsigned char>(previous));
        if (!std::isalpha(u) || starts) words.emplace_back();
        if (std::isalpha(u)) words.back() += char(std::tolower(u));
        previous = c;
    }
    return words;
}

bool isNamedLikeSkin(const std::string& name) {
    return std::ranges::any_of(wordsOf(name), [](const std::string& word) {
        return word == "skin" || word == "head" || word == "face" || word == "body";
    });
}

void guessSkin(Scene& scene) {
    bool any = false;
    for (Material& material : scene.materials) {
        if (!isNamedLikeSkin(material.name)) continue;
        material.skin = SkinMaterial{};
        any = true;
    }
    if (!any) return;
    warn("no material has extras.skin: taken as skin by name: " + quotedNames(scene.materials, true) +
         " (--skin decides otherwise), " + scene.file.string());
}

void checkExtent(const Scene& scene) {
    constexpr double kLargest = 1e9;       // metres: what is farther away has no precision left on the GPU
    constexpr double kMostVertices = 1e9;  // counting each node's mesh
    double vertices = 0;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        const std::string where =
            scene.file.string() + (node.name.empty() ? "" : ", node \"" + node.name + "\"");
        for (int c = 0; c < 4; ++c) {
            for (int r = 0; r < 4; ++r) {
                if (std::abs(node.world[c][r]) <= kLargest) continue;
                throw Error("cannot load scene", "a node is scaled or moved beyond 1e9", where);
            }
        }
        if (node.mesh < 0) continue;
        for (const Primitive& p : scene.meshes[node.mesh].primitives) vertices += double(p.positions.size());
        if (vertices > kMostVertices)
            throw Error("cannot load scene", "it has more than 1e9 vertices", where);
    }
}

void checkBounds(const Scene& scene) {
    constexpr double kLargest = 1e9;
    if (scene.bounds.empty()) return;
    const glm::dvec3 reach = glm::max(glm::abs(scene.bounds.min), glm::abs(scene.bounds.max));
    if (reach.x <= kLargest && reach.y <= kLargest && reach.z <= kLargest) return;
    throw Error("cannot load scene", "its geometry reaches beyond 1e9 units", scene.file.string());
}

// For the layout of the atlas, which stays while the scene moves.
void keepRestPositions(Scene& scene) {
    if (scene.animations.empty()) return;
    for (Mesh& mesh : scene.meshes) {
        for (Primitive& p : mesh.primitives) {
            if (p.deformation) p.restPositions = p.positions;
        }
    }
}

}  // namespace

Scene loadGltf(const std::filesystem::path& path, const GltfOptions& options) {
    gltf::Document document(path);
    if (options.images && document.count("images") > 0) startCodec();
    Scene scene;
    scene.file = path;
    scene.name = path.stem().string();
    const gltf::NodeMap nodes = gltf::readNodes(document, scene);
    const gltf::MaterialMap materials = gltf::readMaterials(document, scene);
    updateWorldTransforms(scene);
    gltf::readMeshes(document, nodes, materials, scene);
    gltf::readAnimations(document, nodes, scene);
    checkExtent(scene);
    poseScene(scene, kAtRest, 0);
    keepRestPositions(scene);
    checkBounds(scene);
    if (options.images) gltf::readImages(document, materials.images, scene);
    if (options.skin && isSkinFile(*options.skin)) {
        const std::vector<std::optional<SkinMaterial>> skin = loadSkinFile(*options.skin, scene);
        for (std::size_t i = 0; i < skin.size(); ++i) scene.materials[i].skin = skin[i];
        findCharacters(scene);
    } else if (options.skin) {
        selectSkin(scene, *options.skin);
    } else {
        if (!materials.skinMarked) guessSkin(scene);
        findCharacters(scene);
    }
    turnSkinOutwards(scene);
    return scene;
}

void selectSkin(Scene& scene, const std::string& globOrNone) {
    const auto matches = [&](const Material& material) {
        return ::fnmatch(globOrNone.c_str(), material.name.c_str(), 0) == 0;
    };
    const bool none = globOrNone == "none";
    if (!none && std::ranges::none_of(scene.materials, matches)) {
        const std::string names = quotedNames(scene.materials, false);
        throw Error("no material is named like '" + globOrNone + "'",
                    names.empty() ? "the scene has none" : "there are " + names, scene.file.string());
    }
    for (Material& material : scene.materials) {
        if (none || !matches(material)) {
            material.skin.reset();
        } else if (!material.skin) {
            material.skin = SkinMaterial{};
        }
    }
    findCharacters(scene);
}

}  // namespace cutis
